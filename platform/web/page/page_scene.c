/* page_scene.c: the page's open scene: opened with the tool's options, drawn in steps, measured, and inspected. */
#include "page_calls.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../../src/tree/tree.h"
#include "../../../tools/picture/grey.h"
#include "../../../tools/picture/metrics.h"
#include "../../../tools/picture/picture.h"
#include "../../../tools/relief/verb_relief.h"
#include "../../../tools/mix/verb_mix.h"
#include "../../../tools/relight/verb_relight.h"
#include "../../../tools/render/render_draw.h"
#include "../../../tools/render/render_exposure.h"
#include "../../../tools/render/verb_render.h"

enum { WORDS = 200, STEPS = 16, CUT_NODES = 4096 };

/* A command line in its own memory, because options point into it. */
typedef struct command {
    char *text;
    char *word[WORDS + 1];
    int count;
} command;

static struct state {
    render_job job, best; /* best: for errors; shares the job's scene */
    command line;
    lmb_light *lights; /* copies of the scene's lights, which may move */
    int is_open, has_best;
    render_job *drawn; /* the current frame, job's or best's; NULL: none */
    uint8_t *pixels;   /* RGBA */
    uint8_t *shown;
    int32_t shown_width, shown_height;
    int32_t band;      /* next band */
    float exposure_ev, trim, rmse;
    float cut[CUT_NODES * PAGE_NODE];
    int32_t cut_count;
    lmb_status failed[POOL_MAX];
    report r;
} state;

void *page_take(size_t bytes) { return malloc(bytes > 0 ? bytes : 1); }
void page_give(void *memory) { free(memory); }
int page_ready(void) { return lmb_build_check() == LMB_OK; }
const char *page_report(void) { return state.r.text; }

static void begin_report(void) { memset(&state.r, 0, sizeof state.r); }

/* --- command lines ------------------------------------------------------------------------------------------------ */

static void command_free(command *c)
{
    free(c->text);
    memset(c, 0, sizeof *c);
}

static int command_read(command *out, const char *words)
{
    memset(out, 0, sizeof *out);
    out->text = malloc(strlen(words) + 1);
    if (out->text == NULL) {
        return report_fail(&state.r, "out of memory");
    }
    strcpy(out->text, words);
    for (char *at = out->text; at != NULL && *at != '\0' && out->count < WORDS;) {
        char *end = strchr(at, '\n');
        out->word[out->count++] = at;
        at = end != NULL ? end + 1 : NULL;
        if (end != NULL) {
            *end = '\0';
        }
    }
    return out->count > 0 || report_fail(&state.r, "no words");
}

/* Baking takes minutes and needs the tool's readers of photos, so the page has no relief baker. */
int verb_relief_bake(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return report_fail(&state.r, "a page bakes no relief; use `lambent relief bake`") + 2;
}

int page_run(const char *words)
{
    static const struct verb {
        const char *name;
        int (*run)(int argc, char **argv);
    } verbs[] = {{"relight", verb_relight}, {"relief", verb_relief}, {"mix", verb_mix}};
    command c;
    int status = 2;
    begin_report();
    if (command_read(&c, words)) {
        for (size_t i = 0; i < sizeof verbs / sizeof *verbs; ++i) {
            if (strcmp(verbs[i].name, c.word[0]) == 0) {
                status = verbs[i].run(c.count, c.word);
            }
        }
    }
    command_free(&c);
    return status;
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

/* The best frame's job shares scene and lights. */
static void close_best(void)
{
    if (state.has_best) {
        memset(&state.best.many_lights, 0, sizeof state.best.many_lights);
        render_job_free(&state.best);
    }
    memset(&state.best, 0, sizeof state.best);
    state.has_best = 0;
}

static void close_scene(void)
{
    close_best();
    render_job_free(&state.job);
    memset(&state.job, 0, sizeof state.job);
    free(state.lights);
    free(state.pixels);
    free(state.shown);
    state.lights = NULL;
    state.pixels = state.shown = NULL;
    state.drawn = NULL;
    state.is_open = 0;
    command_free(&state.line);
}

/* Copies the lights, so that they may move even if the scene is constant. */
static int own_lights(void)
{
    lmb_scene *s = &state.job.scene;
    const size_t bytes = s->light_count * sizeof *state.lights;
    state.lights = malloc(bytes > 0 ? bytes : 1);
    if (state.lights == NULL) {
        return report_fail(&state.r, "out of memory");
    }
    if (bytes > 0) {
        memcpy(state.lights, s->lights, bytes);
    }
    s->lights = state.lights;
    return 1;
}

static int open_scene(const char *words)
{
    render_job *j = &state.job;
    if (!command_read(&state.line, words)) {
        return 0;
    }
    if (render_options_parse(&j->o, state.line.count, state.line.word, &state.r) != OPTIONS_RUN) {
        return report_fail(&state.r, "these options show their help, and draw nothing");
    }
    j->o.has_sky = 1;
    if (!render_job_load(j, &state.r) || !render_job_set(j, &state.r) || !own_lights()) {
        return 0;
    }
    state.pixels = malloc((size_t)j->linear.width * (size_t)j->linear.height * 4);
    state.exposure_ev = j->o.exposure_ev;
    return state.pixels != NULL || report_fail(&state.r, "out of memory");
}

int page_open(const char *words)
{
    begin_report();
    close_scene();
    state.is_open = open_scene(words);
    if (!state.is_open) {
        close_scene();
    }
    return state.is_open;
}

static void put_vector(double *to, lmb_vec3 v)
{
    to[0] = (double)v.x;
    to[1] = (double)v.y;
    to[2] = (double)v.z;
}

static double progress_of(const render_job *j)
{
    const char *name;
    if (j == NULL) {
        return 0.0;
    }
    const double bands = (double)((j->frame.view.frame_height + LMB_TILE - 1) / LMB_TILE);
    return j->render->stage < LMB_STAGE_BANDS
               ? 0.5 * ((double)j->render->stage + (double)lmb_render_progress(&name, j->render)) / LMB_STAGE_BANDS
               : 0.5 + 0.5 * (double)state.band / bands;
}

const double *page_numbers(uint32_t light)
{
    static double n[PAGE_NUMBERS];
    const render_job *j = &state.job;
    const lmb_view *v = &j->middle;
    memset(n, 0, sizeof n);
    if (!state.is_open) {
        return n;
    }
    n[PAGE_WIDTH] = j->o.view.width;
    n[PAGE_HEIGHT] = j->o.view.height;
    n[PAGE_TRIANGLES] = lmb_scene_triangles(&j->scene);
    n[PAGE_LIGHTS] = j->scene.light_count;
    n[PAGE_BAKED] = j->o.transfer != NULL;
    n[PAGE_THREADS] = j->workers.threads;
    put_vector(n + PAGE_EYE, v->eye);
    put_vector(n + PAGE_RIGHT, v->right);
    put_vector(n + PAGE_UP, v->up);
    put_vector(n + PAGE_BACK, v->back);
    n[PAGE_HALF_WIDTH] = (double)v->half_width;
    n[PAGE_HALF_HEIGHT] = (double)v->half_height;
    put_vector(n + PAGE_LOW, j->scene.bounds_min);
    put_vector(n + PAGE_HIGH, j->scene.bounds_max);
    if (light < j->scene.light_count) {
        n[PAGE_LIGHT] = state.lights[light].kind;
        put_vector(n + PAGE_LIGHT + 1, state.lights[light].position);
        put_vector(n + PAGE_LIGHT + 4, state.lights[light].direction);
    }
    n[PAGE_PROGRESS] = progress_of(state.drawn);
    n[PAGE_TRIM] = (double)state.trim;
    n[PAGE_RMSE] = (double)state.rmse;
    n[PAGE_DROPPED] = j->stats.triangles_dropped;
    n[PAGE_MEMORY] = (double)(j->bytes + j->many_lights.bytes);
    return n;
}

int page_look(float ex, float ey, float ez, float tx, float ty, float tz)
{
    const lmb_vec3 eye = {ex, ey, ez}, target = {tx, ty, tz}, up = {0.0f, 1.0f, 0.0f};
    lmb_view look, *v = &state.job.middle;
    if (!state.is_open || lmb_view_look_at(&look, eye, target, up, 1.0f, 8, 8) != LMB_OK) {
        return 0;
    }
    v->eye = look.eye;
    v->right = look.right;
    v->up = look.up;
    v->back = look.back;
    return 1;
}

int page_put_light(uint32_t i, float x, float y, float z, float dx, float dy, float dz)
{
    if (!state.is_open || i >= state.job.scene.light_count) {
        return 0;
    }
    const lmb_light before = state.lights[i];
    lmb_light *l = &state.lights[i];
    l->position = (lmb_vec3){x, y, z};
    l->direction = (lmb_vec3){dx, dy, dz};
    l->revision += 1;
    if (lmb_scene_check(&state.job.scene) != LMB_OK) {
        *l = before;
        return 0;
    }
    return 1;
}

/* --- a frame, in steps -------------------------------------------------------------------------------------------- */

/* Sets up the current scene with the best settings. */
static int open_best(void)
{
    render_job *b = &state.best;
    const render_job *j = &state.job;
    b->scene = j->scene;
    b->middle = j->middle;
    if (state.has_best) {
        return 1;
    }
    b->o = j->o;
    b->o.quality = LMB_QUALITY_BEST;
    b->o.transfer = NULL;
    b->o.shadow_map = b->o.tree = b->o.conservative = 0;
    b->o.error = b->o.visibility = 0.0f;
    b->o.gather_step = 1;
    memset(&b->o.grouping, 0, sizeof b->o.grouping);
    b->o.grouping.method = LMB_GROUP_CUT;
    b->o.occlusion = LMB_OCCLUSION_EXACT;
    b->eyes = 1;
    b->many_lights.tree = j->many_lights.tree;
    b->gathers_sky = j->gathers_sky;
    b->workers.threads = j->workers.threads;
    state.has_best = 1;
    if (!render_job_take(b, &state.r)) {
        close_best();
    }
    return state.has_best;
}

static lmb_surface screen(void)
{
    lmb_surface s;
    memset(&s, 0, sizeof s);
    s.data = state.pixels;
    s.width = state.job.linear.width;
    s.height = state.job.linear.height;
    s.stride_bytes = 4 * s.width;
    s.format = LMB_RGBA8;
    return s;
}

int page_begin(int target, int show)
{
    begin_report();
    state.drawn = NULL;
    state.cut_count = 0;
    if (!state.is_open || (target == PAGE_TO_BEST && !open_best())) {
        return 0;
    }
    render_job *j = target == PAGE_TO_BEST ? &state.best : &state.job;
    render_job_eye(j, &j->frame, &j->linear, 0);
    j->frame.show = show;
    j->frame.exposure_ev = 0.0f;
    if (target == PAGE_TO_SCREEN) {
        j->frame.out = screen();
        j->frame.exposure_ev = state.exposure_ev;
    }
    memset(&j->stats, 0, sizeof j->stats);
    const lmb_status status = lmb_render_reuse(j->render, &j->frame);
    if (status != LMB_OK) {
        return report_fail(&state.r, "%s: drawing stopped: %s", state.job.o.scene, lmb_status_name(status));
    }
    state.drawn = j;
    state.band = 0;
    return 1;
}

typedef struct work {
    render_job *job;
    int32_t first, parts;
} work;

static void keep(int worker, lmb_status status)
{
    if (status != LMB_OK) {
        state.failed[worker] = status;
    }
}

static void draw_part(void *user, int part, int worker)
{
    const work *w = user;
    keep(worker, lmb_render_part(w->job->render, &w->job->workers.scratches[worker], part, w->parts, NULL));
}

static void draw_band(void *user, int part, int worker)
{
    const work *w = user;
    const lmb_frame *f = &w->job->render->frame;
    lmb_band_scratch *scratch = &w->job->workers.scratches[worker];
    keep(worker, lmb_render_band(w->job->render, scratch, &f->eye, &f->out, w->first + part));
}

static lmb_status share(work *w, int parts, pool_job job)
{
    memset(state.failed, 0, sizeof state.failed);
    w->parts = parts;
    pool_run(w->job->workers.threads, parts, job, w);
    for (int i = 0; i < POOL_MAX; ++i) {
        if (state.failed[i] != LMB_OK) {
            return state.failed[i];
        }
    }
    return LMB_OK;
}

static lmb_status step_stage(work *w)
{
    const int threads = w->job->workers.threads;
    lmb_render *r = w->job->render;
    if (threads == 1 || !lmb_render_has_parts(r)) {
        return lmb_render_step(r, STEPS);
    }
    const lmb_status status = share(w, threads, draw_part);
    return status != LMB_OK ? status : lmb_render_parts_done(r, threads);
}

static lmb_status step_bands(work *w, int bands)
{
    const int32_t all = (w->job->frame.view.frame_height + LMB_TILE - 1) / LMB_TILE;
    const int32_t left = all - state.band, count = bands < left ? bands : left;
    w->first = state.band;
    state.band += count;
    const lmb_status status = share(w, count, draw_band);
    return status == LMB_OK && state.band < all ? LMB_MORE : status;
}

int page_step(int bands)
{
    work w = {state.drawn, 0, 0};
    if (w.job == NULL) {
        return -1;
    }
    const int is_light = w.job->render->stage < LMB_STAGE_BANDS;
    const lmb_status status = is_light ? step_stage(&w) : step_bands(&w, bands > 0 ? bands : 1);
    if (status == LMB_OK || status == LMB_MORE) {
        return status == LMB_MORE || is_light;
    }
    state.drawn = NULL;
    report_fail(&state.r, "%s: drawing stopped: %s", state.job.o.scene, lmb_status_name(status));
    return -1;
}

float page_exposure(void)
{
    if (state.is_open && state.job.o.exposure_auto && !render_exposure(&state.exposure_ev, &state.job, &state.r)) {
        state.exposure_ev = 0.0f;
    }
    return state.exposure_ev;
}

void page_set_exposure(float ev) { state.exposure_ev = ev; }
float page_exposure_now(void) { return state.exposure_ev; }

static int put_codes(uint8_t *rgba, const image *from, float ev)
{
    const size_t n = (size_t)from->width * (size_t)from->height;
    uint8_t *codes = picture_codes(from, ev, PICTURE_CLIPPED);
    for (size_t i = 0; codes != NULL && i < n; ++i) {
        memcpy(rgba + 4 * i, codes + 3 * i, 3);
        rgba[4 * i + 3] = 255;
    }
    free(codes);
    return codes != NULL || report_fail(&state.r, "out of memory");
}

int page_to_pixels(void) { return state.is_open && put_codes(state.pixels, &state.job.linear, state.exposure_ev); }

uint8_t *page_pixels(void) { return state.pixels; }

const char *page_hash(void)
{
    static char text[20];
    const lmb_surface s = screen();
    const uint64_t hash = lmb_surface_hash(&s);
    snprintf(text, sizeof text, "%08lx%08lx", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
    return text;
}

int page_measure(void)
{
    metrics m;
    metrics_input in;
    begin_report();
    if (!state.has_best) {
        return report_fail(&state.r, "the best frame is not drawn yet");
    }
    memset(&in, 0, sizeof in);
    in.test = state.job.linear.pixels;
    in.truth = state.best.linear.pixels;
    in.width = state.best.linear.width;
    in.height = state.best.linear.height;
    in.channels = state.best.linear.channels;
    if (!metrics_measure(&m, &in, &state.r)) {
        return 0;
    }
    state.trim = (float)m.trim;
    state.rmse = (float)m.rmse;
    return 1;
}

/* --- pictures other than light ------------------------------------------------------------------------------------ */

static void grey(image *p)
{
    float near_m, far_m;
    switch (state.job.o.show) {
    case SHOW_DEPTH: grey_depths(p); break;
    case SHOW_EYE_DISTANCE:
    case SHOW_LIGHT_DISTANCE: grey_distances(p, &near_m, &far_m); break;
    case SHOW_OCCLUSION: grey_shares(p); break;
    case SHOW_NORMAL: grey_normals(p); break;
    default: break;
    }
}

uint8_t *page_show(void)
{
    render_job *j = &state.job;
    begin_report();
    if (!state.is_open || !render_draw(j, &state.r)) {
        return NULL;
    }
    grey(&j->linear);
    if (j->linear.channels == 1 && !image_widen(&j->linear, &state.r)) {
        return NULL;
    }
    free(state.shown);
    state.shown = malloc((size_t)j->linear.width * (size_t)j->linear.height * 4);
    state.shown_width = j->linear.width;
    state.shown_height = j->linear.height;
    if (state.shown == NULL || !put_codes(state.shown, &j->linear, 0.0f)) {
        report_fail(&state.r, "out of memory");
        free(state.shown);
        state.shown = NULL;
    }
    return state.shown;
}

int32_t page_show_width(void) { return state.shown_width; }
int32_t page_show_height(void) { return state.shown_height; }

/* --- the cut of a pixel ------------------------------------------------------------------------------------------- */

/* Keeps only the pixels of the tile that show the same surface. */
static int keep_surface(lmb_tile *tile, int pixel)
{
    const uint32_t id = tile->id[pixel];
    int32_t hits = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != id) {
            tile->id[k] = 0;
            tile->depth[k] = 0.0f;
        }
        hits += tile->id[k] != 0;
    }
    tile->hits = hits;
    return id != 0;
}

static int bits(uint64_t v)
{
    int n = 0;
    for (; v != 0; v &= v - 1) {
        ++n;
    }
    return n;
}


static void put_node(float *out, const lmb_tree *tree, const lmb_cut *cut, int32_t i, int pixels)
{
    const lmb_node_ref ref = cut->ref[i];
    const lmb_node *node = ref.level > 0 ? tree_node(tree, ref) : NULL;
    const lmb_vec3 at = node != NULL ? node->centre : tree_texel(tree, ref.face, ref.x, ref.y)->position;
    const float numbers[PAGE_NODE] = {at.x, at.y, at.z, node != NULL ? node->radius : 0.0f, cut->value[i],
                                      (float)bits(cut->visible[i]) / (float)pixels, ref.level, ref.face, ref.x, ref.y};
    memcpy(out, numbers, sizeof numbers);
}

const float *page_cut(int32_t x, int32_t y)
{
    render_job *j = &state.job;
    const lmb_frame *f = state.is_open && j->render != NULL ? &j->render->frame : NULL;
    state.cut_count = 0;
    if (f == NULL || f->tree.texel == NULL || j->render->stage < LMB_STAGE_BANDS || x < 0 || y < 0 ||
        x >= f->view.frame_width || y >= f->view.frame_height) {
        return state.cut;
    }
    lmb_band_scratch *s = j->frame.scratch;
    lmb_cut *cut = &s->gather.cut;
    if (lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, &f->eye, x & -LMB_TILE, y & -LMB_TILE) != LMB_OK ||
        !keep_surface(&s->tile, y % LMB_TILE * LMB_TILE + x % LMB_TILE)) {
        return state.cut;
    }
    lmb_cut_params how;
    memset(&how, 0, sizeof how);
    how.error = f->error;
    how.visibility = f->visibility;
    how.bvh = &f->bvh;
    memset(&s->indirect, 0, sizeof s->indirect);
    cut->count = 0;
    if (lmb_gather_cut(&s->indirect, f->kernels, cut, &s->tile, &f->tree, &how) != LMB_OK) {
        return state.cut;
    }
    for (int32_t i = 0; i < cut->count && state.cut_count < CUT_NODES; ++i) {
        if (cut->ref[i].level <= tree_root_level(&f->tree) && cut->visible[i] != 0 && cut->value[i] > 0.0f) {
            put_node(state.cut + PAGE_NODE * state.cut_count++, &f->tree, cut, i, s->tile.hits);
        }
    }
    return state.cut;
}

int32_t page_cut_count(void) { return state.cut_count; }
int32_t page_cut_size(void) { return state.job.frame.tree.size; }
