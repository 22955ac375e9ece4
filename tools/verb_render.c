/* verb_render.c: `lambent render`: a scene in, a picture with bounced light out. */
#include "verb_render.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../platform/host/host.h"
#include "crew.h"
#include "demo_scene.h"
#include "grey.h"
#include "many_lights.h"
#include "map_picture.h"
#include "model.h"
#include "picture.h"
#include "render_options.h"
#include "render_view.h"

#define ELEMENTS   16384
#define MAP_TEXELS (2u << 20) /* over all lights' maps, by default: 16 MiB */

/* One run, from the options to the picture. Everything here is freed by job_free. */
typedef struct job {
    render_options o;
    model loaded;
    model_notes notes;
    lmb_scene scene; /* the loaded or built-in one, with the lights of this run */
    lmb_light sun;
    lmb_view middle; /* between the eyes */
    int32_t eyes;    /* 1, or 2: side by side in the picture */
    many_lights many;
    lmb_frame frame; /* its view and out: those of the eye at hand */
    lmb_render *render;
    int lit; /* the light stages of `render` are done */
    crew crew;
    lmb_stats stats;
    image linear;
    void *map_memory, *point_memory, *owner_memory, *blocker_memory, *element_memory, *depth_memory, *id_memory;
    size_t bytes; /* of the above and the state */
    double load_s, write_s, total_s;
    double indirect_share;
} job;

static void job_free(job *j)
{
    free(j->map_memory);
    free(j->point_memory);
    free(j->blocker_memory);
    free(j->owner_memory);
    free(j->element_memory);
    free(j->depth_memory);
    free(j->id_memory);
    free(j->frame.groups);
    free(j->crew.scratches);
    free(j->render);
    image_free(&j->linear);
    many_lights_free(&j->many);
    model_free(&j->loaded);
}

static void *take(job *j, size_t bytes, report *r)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    j->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted; try a smaller --size or --light-map",
                    (double)bytes / 1048576.0);
    }
    return p;
}

/* --- scene and lights --------------------------------------------------------------------------------------------- */

static int load_scene(job *j, report *r)
{
    if (strcmp(j->o.scene, "demo") == 0) {
        j->scene = *demo_scene();
        return !j->o.glossy || report_fail(r, "--glossy: the demo's materials have no lobe; give a glTF scene");
    }
    if (!model_load(&j->loaded, j->o.scene, j->o.scene_name, &j->notes, r)) {
        return 0;
    }
    if (j->o.glossy && !model_make_glossy(&j->loaded)) {
        return report_fail(r, "--glossy: %s: only glTF's materials have a lobe", j->o.scene);
    }
    j->scene = j->loaded.scene;
    return lmb_scene_triangles(&j->scene) > 0 ||
           report_fail(r, "%s: nothing to draw: no triangles; `lambent info` says what is in it", j->o.scene);
}

/* Once nothing but memory can fail: an error is a line on its own. */
static void tell_notes(const job *j)
{
    for (uint32_t i = 0; i < j->notes.count; ++i) {
        fprintf(stderr, "lambent: note: %s\n", j->notes.line[i]);
    }
}

/* Is there light without lamps? */
static int lights_itself(const job *j) { return j->o.grouping.method == LMB_GROUP_CUT && lmb_scene_shines(&j->scene); }

static void set_lights(job *j)
{
    if (j->o.light_count > 0) {
        j->scene.lights = j->o.lights;
        j->scene.light_count = j->o.light_count;
    } else if (j->scene.light_count == 0 && !lights_itself(j)) {
        lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f, LMB_LIGHT_DIRECTIONAL,
                         0};
        j->sun = sun;
        j->scene.lights = &j->sun;
        j->scene.light_count = 1;
        fprintf(stderr, "lambent: no light in %s: a sun of 3 W/m2 from the upper right; --light sets others\n",
                j->o.scene);
    }
}

/* Point lights that are too many for maps, or that were asked to, go into a tree. */
static int set_many_lights(job *j, report *r)
{
    const uint32_t bounce = j->o.show == LMB_SHOW_DIRECT ? 0 : (uint32_t)j->o.bounce_lights;
    const uint32_t cells = j->o.many_cells > 0 ? (uint32_t)j->o.many_cells : MANY_LIGHTS_CELLS;
    if (j->scene.light_count > LMB_MAX_LIGHTS || j->o.many_cells > 0) {
        if (!many_lights_take(&j->many, &j->scene, cells, bounce, r)) {
            return 0;
        }
    }
    if (j->many.tree.lights > 0) {
        j->frame.many = &j->many.tree;
        j->frame.many_bounce = j->many.bounce;
        j->frame.many_error = j->o.light_error;
        fprintf(stderr, "lambent: %u point lights in %u cells; when light bounces, %u stand for them (--many-lights)\n",
                (unsigned)j->many.tree.lights, (unsigned)j->many.tree.cell_count, (unsigned)j->many.bounce);
    }
    return j->scene.light_count <= LMB_MAX_LIGHTS ||
           report_fail(r,
                       "%s: %u lights that want a map; this build draws up to %d at once; remove spots or suns, give "
                       "others by --light, or fewer --bounce-lights",
                       j->o.scene, (unsigned)j->scene.light_count, LMB_MAX_LIGHTS);
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static uint32_t total_faces(const lmb_scene *s)
{
    uint32_t faces = 0;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        faces += (uint32_t)lmb_light_map_faces(&s->lights[i]);
    }
    return faces;
}

static int32_t choose_light_map(const job *j, uint32_t faces)
{
    uint32_t size = 1024;
    while (size > 64 && (uint64_t)size * size * faces > MAP_TEXELS) {
        size /= 2;
    }
    return j->o.light_map != 0 ? j->o.light_map : (int32_t)size;
}

static int take_maps(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    uint32_t faces = total_faces(&j->scene);
    f->light_map = choose_light_map(j, faces);
    for (uint32_t i = 0; i < j->scene.light_count; ++i) {
        f->map_bytes += lmb_light_map_bytes(lmb_light_map_faces(&j->scene.lights[i]), f->light_map, f->id_format);
    }
    f->map_memory = j->map_memory = take(j, f->map_bytes, r);
    return f->map_memory != NULL;
}

/* What blocks light, for those that ask every triangle. */
static int take_blockers(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    const uint32_t triangles = lmb_scene_triangles(&j->scene);
    const size_t bytes = lmb_blockers_bytes(triangles);
    if ((f->occlusion != LMB_OCCLUSION_EXACT || j->o.show == LMB_SHOW_DIRECT) && f->many == NULL) {
        return 1;
    }
    j->blocker_memory = take(j, bytes, r);
    return j->blocker_memory != NULL &&
           lmb_blockers_init(&f->blockers, triangles, j->blocker_memory, bytes) == LMB_OK;
}

static int take_elements(job *j, report *r)
{
    const uint32_t n = j->o.elements != 0 ? (uint32_t)j->o.elements : ELEMENTS;
    if (j->o.bounces <= 1 && !lmb_scene_shines(&j->scene)) {
        return 1;
    }
    j->element_memory = take(j, lmb_elements_bytes(n), r);
    return j->element_memory != NULL &&
           lmb_elements_init(&j->frame.elements, n, j->element_memory, lmb_elements_bytes(n)) == LMB_OK;
}

/* The tree of light. */
static int take_tree(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    const uint32_t lit = total_faces(&j->scene), faces = lit > 0 ? lit : 1;
    const int32_t finest = f->light_map < 4096 ? f->light_map : 4096, least = f->light_map / 8;
    const int32_t size = j->o.tree > finest ? finest : j->o.tree < least ? least : j->o.tree;
    const size_t bytes = lmb_tree_bytes(faces, size);
    if (bytes == 0 || f->light_map % size != 0) {
        return report_fail(r, "--grouping cut: --light-map must be a power of two, not %d", (int)f->light_map);
    }
    j->point_memory = take(j, bytes, r);
    return j->point_memory != NULL && lmb_tree_init(&f->tree, faces, size, j->point_memory, bytes) == LMB_OK &&
           take_elements(j, r);
}

/* Who holds a texel's light: asked for only where it is shown. */
static int take_owners(job *j, report *r)
{
    lmb_points *p = &j->frame.points;
    const uint64_t texels = (uint64_t)j->frame.light_map * (uint64_t)j->frame.light_map * total_faces(&j->scene);
    if (texels > UINT32_MAX / 16) {
        return report_fail(r, "%.0f texels are too many to show; use a smaller --light-map", (double)texels);
    }
    p->owner = j->owner_memory = take(j, (size_t)texels * sizeof *p->owner, r);
    p->owner_cap = (uint32_t)texels;
    return p->owner != NULL;
}

/* Room for every block to hold all the surfaces that the library tells apart. */
static int take_points(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    int32_t block = f->grouping.block != 0 ? f->grouping.block : LMB_TILE;
    uint32_t side = (uint32_t)(f->light_map / block);
    uint64_t n = (uint64_t)side * side * 4u * total_faces(&j->scene);
    if (n > 64000000u) {
        return report_fail(r, "%.0f first points are too many; use a larger --block or a smaller --light-map",
                           (double)n);
    }
    n = n > 0 ? n : 1;
    size_t bytes = lmb_points_bytes((uint32_t)n, side);
    j->point_memory = take(j, bytes, r);
    f->groups = take(j, sizeof *f->groups, r);
    return j->point_memory != NULL && f->groups != NULL &&
           lmb_points_init(&f->points, (uint32_t)n, side, j->point_memory, bytes) == LMB_OK;
}

/* What holds the light that bounces, as far as it is shown. */
static int take_light(job *j, report *r)
{
    const int dark = total_faces(&j->scene) == 0 && !lights_itself(j);
    if (j->o.show == LMB_SHOW_DIRECT || j->o.show == SHOW_LIGHT_DISTANCE || dark) {
        return 1;
    }
    if (j->frame.grouping.method == LMB_GROUP_CUT) {
        return take_tree(j, r);
    }
    return take_points(j, r) && (!shows_map(j->o.show) || take_owners(j, r));
}

/* Where in a picture of all eyes one eye's goes. */
static lmb_surface eye_surface(const job *j, const image *whole, int32_t eye)
{
    lmb_surface s;
    memset(&s, 0, sizeof s);
    s.data = whole->pixels + (size_t)eye * (size_t)(j->o.view.width * whole->channels);
    s.width = j->o.view.width;
    s.height = whole->height;
    s.stride_bytes = whole->width * whole->channels * (int32_t)sizeof(float);
    s.format = whole->channels == 1 ? LMB_R32F : LMB_RGB32F;
    return s;
}

static void set_eye(const job *j, lmb_frame *f, const image *whole, int32_t eye)
{
    const float right_m = j->o.stereo_m * ((float)eye - 0.5f * (float)(j->eyes - 1));
    f->view = view_from(&j->middle, right_m, &j->scene);
    f->out = eye_surface(j, whole, eye);
}

static int take_picture(job *j, image *out, report *r)
{
    size_t bytes = (size_t)(j->o.view.width * j->eyes) * (size_t)j->o.view.height * 3 * sizeof(float);
    out->pixels = take(j, bytes, r);
    out->width = j->o.view.width * j->eyes;
    out->height = j->o.view.height;
    out->channels = 3;
    if (out->pixels != NULL) {
        memset(out->pixels, 0, bytes);
    }
    return out->pixels != NULL;
}

static int take_frame(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    int32_t w = j->o.view.width, h = j->o.view.height;
    size_t depth = lmb_surface_bytes(LMB_DEPTH32F, w, h), id = lmb_surface_bytes(f->id_format, w, h);
    j->depth_memory = take(j, depth, r);
    j->id_memory = take(j, id, r);
    f->scratch = j->crew.scratches = take(j, sizeof *f->scratch * (size_t)j->crew.threads, r);
    j->render = take(j, sizeof *j->render, r);
    if (!take_picture(j, &j->linear, r) || r->text[0] != '\0') {
        return 0;
    }
    memset(j->render, 0, sizeof *j->render);
    lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, w, h, j->depth_memory, depth);
    lmb_surface_init(&f->eye.id, f->id_format, w, h, j->id_memory, id);
    set_eye(j, f, &j->linear, 0);
    return 1;
}

static int set_frame(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    if (!render_view(&j->middle, &j->o, &j->loaded, &j->scene, r)) {
        return 0;
    }
    j->eyes = j->o.stereo_m > 0.0f ? 2 : 1;
    if (j->o.view.width * j->eyes > LMB_MAX_SIDE) {
        return report_fail(r, "--stereo: two views of %d px are wider than %d; try a smaller --size",
                           (int)j->o.view.width, LMB_MAX_SIDE);
    }
    tell_notes(j);
    set_lights(j);
    if (!shows_attribute(j->o.show) && !set_many_lights(j, r)) {
        return 0;
    }
    j->crew.threads = j->o.threads > 0 ? j->o.threads : pool_processors();
    j->crew.threads = j->crew.threads > POOL_MAX ? POOL_MAX : j->crew.threads;
    f->kernels = j->o.kernels;
    f->scene = &j->scene;
    f->show = j->o.show < SHOW_DEPTH ? j->o.show : j->o.show == SHOW_OCCLUSION ? LMB_SHOW_IRRADIANCE : LMB_SHOW_FULL;
    f->grouping = j->o.grouping;
    f->occlusion = j->o.occlusion;
    f->steps = j->o.steps;
    f->error = j->o.error;
    f->proven = j->o.proven;
    f->bounces = j->o.bounces;
    f->visible = j->o.visible;
    f->gather_step = j->o.gather_step;
    f->id_format = LMB_ID32;
    f->stats = &j->stats;
    if (shows_attribute(j->o.show)) {
        return take_frame(j, r);
    }
    if (j->o.show == SHOW_POINTS && f->grouping.join <= 0.0f) {
        f->grouping.join = 1e-30f; /* first points as they are: none is so near another */
    }
    if (total_faces(&j->scene) == 0) { /* no map, no bounce */
        f->occlusion = LMB_OCCLUSION_NONE;
    }
    return take_maps(j, r) && take_blockers(j, r) && take_light(j, r) && take_frame(j, r);
}

/* --- drawing ------------------------------------------------------------------------------------------------------ */

static void show_progress(const lmb_render *render, double since)
{
    const char *name;
    float part = lmb_render_progress(&name, render);
    double passed = host_seconds() - since;
    char bar[21];
    for (int i = 0; i < 20; ++i) {
        bar[i] = (float)i < part * 20.0f ? '#' : '.';
    }
    bar[20] = '\0';
    if (render->stage == LMB_STAGE_BANDS && part > 0.02f) {
        fprintf(stderr, "\r%-12s [%s] %3.0f %%  %.0f s left   ", name, bar, (double)part * 100.0,
                passed / (double)part - passed);
    } else {
        fprintf(stderr, "\r%-12s [%s] %3.0f %%               ", name, bar, (double)part * 100.0);
    }
}

typedef struct watcher {
    int32_t stage;
    double start, stage_start, shown; /* s; shown 0: nothing was */
} watcher;

/* What stopped a frame, in words. The memory is sized here, so little can. */
static int explain(const job *j, lmb_status status, int stage, report *r)
{
    if (status == LMB_ERR_CAPACITY && stage == LMB_STAGE_GROUPS) {
        return report_fail(r, "--grouping none: %u discs do not fit %d groups; use a smaller --light-map, or zones",
                           (unsigned)j->stats.first_points, LMB_MAX_GROUPS);
    }
    return report_fail(r, "%s: rendering stopped: %s", j->o.scene, lmb_status_name(status));
}

/* A second of silence first, then ten times a second. */
static void watch(void *user, const lmb_render *at)
{
    watcher *w = user;
    const double now = host_seconds();
    if (at->stage != w->stage) {
        w->stage = at->stage;
        w->stage_start = now;
    }
    if (now - w->start > 1.0 && now - w->shown > 0.1) {
        show_progress(at, w->stage_start);
        w->shown = now;
    }
}

/* The frame `how` for all eyes; the light's stages once a run. */
static lmb_status draw_eyes(job *j, crew *c, int32_t *stage, lmb_frame how, const image *into)
{
    lmb_status status = LMB_OK;
    for (int32_t eye = 0; eye < j->eyes && status == LMB_OK; ++eye) {
        set_eye(j, &how, into, eye);
        status = j->lit ? crew_again(c, stage, j->render, &how) : crew_render(c, stage, j->render, &how);
        j->lit = 1;
    }
    return status;
}

static int draw(job *j, report *r)
{
    watcher w = {LMB_STAGE_LIGHT_MAP, host_seconds(), 0.0, 0.0};
    w.stage_start = w.start;
    j->crew.tell = host_watched() ? watch : NULL;
    j->crew.user = &w;
    int32_t stage;
    lmb_status status = draw_eyes(j, &j->crew, &stage, j->frame, &j->linear);
    if (w.shown > 0.0) {
        fprintf(stderr, "\r%60s\r", "");
    }
    return status == LMB_OK || explain(j, status, stage, r);
}

/* The same frame once more, shown otherwise, by the same light: but elements that send theirs do it by one occlusion.
 * Neither told nor timed. */
static int draw_once_more(job *j, image *out, lmb_frame how, report *r)
{
    crew again = j->crew;
    int32_t stage;
    again.tell = NULL;
    how.stats = NULL;
    j->lit = how.elements.data == NULL || how.occlusion == j->frame.occlusion;
    if (!take_picture(j, out, r)) {
        return 0;
    }
    lmb_status status = draw_eyes(j, &again, &stage, how, out);
    return status == LMB_OK || explain(j, status, stage, r);
}

/* The share of the light that is blocked: 1 - with / without, over the sum of the channels. */
static int draw_occlusion(job *j, report *r)
{
    image open = {0, 0, 0, NULL};
    lmb_frame f = j->frame;
    const size_t n = (size_t)j->linear.width * (size_t)j->linear.height;
    float *p = j->linear.pixels;
    f.occlusion = LMB_OCCLUSION_NONE;
    if (!draw(j, r) || !draw_once_more(j, &open, f, r)) {
        image_free(&open);
        return 0;
    }
    for (size_t i = 0; i < n; ++i) {
        const float *all = open.pixels + 3 * i;
        const float with = p[3 * i] + p[3 * i + 1] + p[3 * i + 2], without = all[0] + all[1] + all[2];
        p[i] = without > 0.0f ? fminf(fmaxf(1.0f - with / without, 0.0f), 1.0f) : 0.0f;
    }
    j->linear.channels = 1;
    image_free(&open);
    return 1;
}

/* The light's stages as far as they are shown, and their picture in place of the eye's. */
static int draw_map(job *j, report *r)
{
    const int display = !picture_is_linear(picture_format(j->o.out));
    const int32_t past = j->o.show == SHOW_GROUPS   ? LMB_STAGE_VIEW
                         : j->o.show == SHOW_POINTS ? LMB_STAGE_GROUPS
                                                    : LMB_STAGE_POINTS;
    int32_t stage;
    lmb_status status = crew_light(&j->crew, &stage, j->render, &j->frame, past);
    if (status != LMB_OK) {
        return explain(j, status, stage, r);
    }
    image_free(&j->linear);
    return j->o.show == SHOW_GROUPS   ? map_groups(&j->linear, j->render, display, r)
           : j->o.show == SHOW_POINTS ? map_points(&j->linear, j->render, display, r)
                                      : map_distances(&j->linear, j->render, r);
}

/* Attributes of what one eye sees, instead of light: the view alone is drawn. */
static lmb_status draw_attribute(job *j)
{
    lmb_frame *f = &j->frame;
    const lmb_surface *depth = f->out.format == LMB_R32F ? &f->out : NULL;
    const lmb_surface *normal = j->o.show == SHOW_NORMAL ? &f->out : NULL;
    const lmb_surface *albedo = j->o.show == SHOW_ALBEDO ? &f->out : NULL;
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    lmb_status status =
        lmb_draw(&f->eye, f->kernels, &f->view, &j->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK, &j->stats);
    for (int32_t band = 0; status == LMB_OK && band < (f->view.frame_height + 7) / 8; ++band) {
        status =
            lmb_gbuffer_band(depth, normal, albedo, &f->scratch->tile, f->kernels, &f->view, &j->scene, &f->eye, band);
    }
    if (j->o.show == SHOW_EYE_DISTANCE) {
        distance_of_depth(f->out.data, f->out.width, f->out.height, (size_t)j->linear.width, &f->view);
    }
    return status;
}

static int draw_attributes(job *j, report *r)
{
    lmb_status status = LMB_OK;
    j->linear.channels = j->o.show == SHOW_DEPTH || j->o.show == SHOW_EYE_DISTANCE ? 1 : 3;
    for (int32_t eye = 0; eye < j->eyes && status == LMB_OK; ++eye) {
        set_eye(j, &j->frame, &j->linear, eye);
        status = draw_attribute(j);
    }
    return status == LMB_OK || report_fail(r, "%s: drawing stopped: %s", j->o.scene, lmb_status_name(status));
}

/* What is no light, for display formats. Reflectance, points and groups are in 0 .. 1 already. */
static void grey_for_display(job *j)
{
    float near_m, far_m;
    switch (j->o.show) {
    case SHOW_DEPTH: grey_depths(&j->linear); break;
    case SHOW_EYE_DISTANCE:
    case SHOW_LIGHT_DISTANCE:
        grey_distances(&j->linear, &near_m, &far_m);
        if (far_m > 0.0f) {
            fprintf(stderr, "lambent: from %.4g m (white) to %.4g m (dark grey)\n", (double)near_m, (double)far_m);
        }
        break;
    case SHOW_OCCLUSION: grey_shares(&j->linear); break;
    case SHOW_NORMAL: grey_normals(&j->linear); break;
    default: break;
    }
}

static double mean(const image *p)
{
    double sum = 0.0;
    size_t n = (size_t)p->width * (size_t)p->height * 3;
    for (size_t i = 0; i < n; ++i) {
        sum += (double)p->pixels[i];
    }
    return sum / (double)n;
}

/* --- reporting ---------------------------------------------------------------------------------------------------- */

/* Nodes of the lights' tree that pixels took, and shadow tests, over all threads. */
typedef struct asked_lights {
    double nodes, tests;
} asked_lights;

static asked_lights sum_asked(const job *j)
{
    asked_lights sum = {0.0, 0.0};
    for (int i = 0; i < j->crew.threads && j->many.tree.lights > 0; ++i) {
        sum.nodes += (double)j->crew.scratches[i].many.nodes;
        sum.tests += (double)j->crew.scratches[i].many.tests;
    }
    return sum;
}

static int write_stats(const job *j, report *r)
{
    static const char *const names[] = {"light_maps", "blockers", "first_points", "groups",
                                        "bounces",    "view",     "bands"};
    char text[2048];
    int n = 0;
    const lmb_stats *s = &j->stats;
    const asked_lights lit = sum_asked(j);
    n += snprintf(text + n, sizeof text - (size_t)n,
                  "{\n  \"width\": %d, \"height\": %d, \"views\": %d,\n  \"seconds\": {\"load\": %.6f",
                  (int)j->linear.width, (int)j->linear.height, (int)j->eyes, j->load_s);
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        n += snprintf(text + n, sizeof text - (size_t)n, ", \"%s\": %.6f", names[i], j->crew.stage_s[i]);
    }
    n += snprintf(text + n, sizeof text - (size_t)n, ", \"write\": %.6f, \"total\": %.6f},\n", j->write_s, j->total_s);
    n += snprintf(
        text + n, sizeof text - (size_t)n,
        "  \"scene_triangles\": %u, \"triangles_read\": %u, \"triangles_drawn\": %u, \"triangles_dropped\": %u,\n"
        "  \"lights\": %u, \"light_map\": %d, \"first_points\": %u, \"discs\": %u, \"groups\": %u, \"regroups\": %u,\n"
        "  \"pairs\": %.0f, \"segments\": %.0f, \"elements\": %u, \"element_m\": %.6g,\n",
        (unsigned)lmb_scene_triangles(&j->scene), (unsigned)s->triangles, (unsigned)s->triangles_drawn,
        (unsigned)s->triangles_dropped, (unsigned)j->scene.light_count, (int)j->frame.light_map,
        (unsigned)s->first_points, (unsigned)s->discs, (unsigned)s->groups, (unsigned)s->regroups,
        (double)s->pairs, (double)s->segments, (unsigned)j->render->frame.elements.count,
        (double)j->render->frame.elements.side);
    n += snprintf(text + n, sizeof text - (size_t)n,
                  "  \"flux_lit_w\": %.9g, \"flux_grouped_w\": %.9g, \"energy_kept\": %.9g,\n"
                  "  \"many_lights\": %u, \"light_cells\": %u, \"light_nodes\": %.0f, \"shadow_tests\": %.0f,\n"
                  "  \"light_stream_s\": %.6f, \"light_tree_s\": %.6f,\n"
                  "  \"bytes\": %.0f, \"model_bytes\": %.0f, \"loading_bytes\": %.0f,\n"
                  "  \"backend\": \"%s\"\n}\n",
                  s->flux_lit, s->flux_grouped, s->flux_lit > 0.0 ? s->flux_grouped / s->flux_lit : 1.0,
                  (unsigned)j->many.tree.lights, (unsigned)j->many.tree.cell_count, lit.nodes, lit.tests,
                  j->many.stream_s, j->many.build_s,
                  (double)(j->bytes + j->many.bytes), (double)j->loaded.facts.memory_bytes,
                  (double)j->loaded.facts.loading_bytes, lmb_kernels_name(j->frame.kernels));
    return file_write(j->o.stats, text, (size_t)n, r);
}

static void tell_demo(const job *j)
{
    const char *name;
    lmb_render at = *j->render;
    printf("%s: %d x %d, %u triangles, %u groups\n", j->o.out, (int)j->linear.width, (int)j->linear.height,
           (unsigned)lmb_scene_triangles(&j->scene), (unsigned)j->stats.groups);
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        at.stage = i;
        lmb_render_progress(&name, &at);
        printf("  %-13s %8.1f ms\n", name, j->crew.stage_s[i] * 1e3);
    }
    printf("  %.1f %% of the light in the picture is indirect\n", j->indirect_share * 100.0);
}

/* How much of the picture's light has bounced: the same frame again, direct light only, which costs little. */
static int measure_share(job *j, report *r)
{
    const double full = mean(&j->linear);
    image direct = {0, 0, 0, NULL};
    lmb_frame f = j->frame;
    f.show = LMB_SHOW_DIRECT;
    const int ok = draw_once_more(j, &direct, f, r);
    j->indirect_share = ok && full > 0.0 ? 1.0 - mean(&direct) / full : 0.0;
    image_free(&direct);
    return ok;
}

static int save(job *j, report *r)
{
    float ev = j->o.exposure_ev;
    int linear = picture_is_linear(picture_format(j->o.out));
    if (j->o.show >= SHOW_DEPTH) {
        ev = 0.0f;
        if (!linear) {
            grey_for_display(j);
        }
        if (j->linear.channels == 1 && picture_format(j->o.out) != PICTURE_PFM && !image_widen(&j->linear, r)) {
            return 0;
        }
    } else if (j->o.exposure_auto && !linear) {
        ev = picture_auto_exposure(&j->linear) + 0.0f; /* no minus zero */
        fprintf(stderr, "lambent: exposure %+.3g EV (auto)\n", (double)ev);
    }
    return picture_write(j->o.out, &j->linear, ev, r);
}

static int draw_what_is_shown(job *j, report *r)
{
    return shows_attribute(j->o.show)    ? draw_attributes(j, r)
           : shows_map(j->o.show)        ? draw_map(j, r)
           : j->o.show == SHOW_OCCLUSION ? draw_occlusion(j, r)
                                         : draw(j, r);
}

/* Strict zones: what they lost [V20]. */
static void tell_loss(const job *j)
{
    const double lost = j->stats.flux_lit - j->stats.flux_grouped;
    if ((j->frame.grouping.flags & LMB_ZONES_STRICT) && j->stats.groups > 0) {
        fprintf(stderr, "lambent: note: --misfits drop lost %.3g %% of the light that bounces\n",
                j->stats.flux_lit > 0.0 ? fmax(lost, 0.0) / j->stats.flux_lit * 100.0 : 0.0);
    }
}

static int run(job *j, report *r)
{
    double start = host_seconds();
    if (!file_can_write(j->o.out, r) || (j->o.stats != NULL && !file_can_write(j->o.stats, r)) || !load_scene(j, r)) {
        return 0;
    }
    j->load_s = host_seconds() - start;
    if (!set_frame(j, r) || !draw_what_is_shown(j, r)) {
        return 0;
    }
    tell_loss(j);
    if (j->stats.triangles_dropped > 0) {
        fprintf(stderr, "lambent: note: %u triangles dropped: vertices not finite or over 2^20 m away\n",
                (unsigned)j->stats.triangles_dropped);
    }
    int demo = strcmp(j->o.scene, "demo") == 0 && j->o.show == LMB_SHOW_FULL;
    if (demo && !measure_share(j, r)) {
        return 0;
    }
    double before = host_seconds();
    if (!save(j, r)) {
        return 0;
    }
    j->write_s = host_seconds() - before;
    j->total_s = host_seconds() - start;
    if (j->o.stats != NULL && !write_stats(j, r)) {
        return 0;
    }
    if (demo) {
        tell_demo(j);
    }
    return 1;
}

int verb_render(int argc, char **argv)
{
    report r = {""};
    static job j; /* too large for a small stack: the options hold 64 lights */
    memset(&j, 0, sizeof j);
    if (!render_options_parse(&j.o, argc, argv, &r)) {
        fprintf(stderr, "lambent render: %s\n", r.text);
        return 2;
    }
    if (j.o.help) {
        for (int i = 0; i < RENDER_USAGE_PARTS; ++i) {
            fputs(render_usage[i], stdout);
        }
        return 0;
    }
    if (picture_format(j.o.out) == PICTURE_UNKNOWN) {
        fprintf(stderr, "lambent render: %s: the name must end in .png, .ppm, .pfm or .hdr\n", j.o.out);
        return 2;
    }
    int ok = run(&j, &r);
    if (!ok) {
        fprintf(stderr, "lambent render: %s\n", r.text);
    }
    job_free(&j);
    return ok ? 0 : 1;
}
