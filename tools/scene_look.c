/* scene_look.c: a scene solved by four trees, and its light at a few tiles by a ladder of settings. */
#include "scene_look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MIDDLE_LOOK = LMB_FACT_STEPS, OTHER_LOOK, LOOKS };
enum { LOOK_TREE = 256, MIDDLE = 2 /* rung: error 0.1 */ };
enum { FINER = 2 /* of the tree that errors are told against */, LOOK_TEXELS = 1 << 22 /* of it, over all faces */ };

/* A job's frame with the look's own maps, tree and blockers. */
typedef struct looker {
    const render_job *job;
    lmb_frame frame;
    lmb_render *render;
    lmb_look *look;     /* [5]: the finest at each step's places, a middle one, another */
    lmb_survey *places; /* [LMB_FACT_STEPS] */
    void *map, *tree, *blockers;
} looker;

static void set_rung(lmb_frame *f, float rung)
{
    f->error = LMB_FACT_FINEST;
    for (int i = 0; i < (int)rung; ++i) {
        f->error *= 2.0f;
    }
    f->visible = LMB_FACT_VISIBLE * f->error;
}

/* Solve the light by a tree and map of `size`, and draw what the eye sees. */
static lmb_status solve(looker *l, int32_t size)
{
    lmb_frame *f = &l->frame;
    const uint32_t faces = f->tree.face_cap;
    lmb_status status = lmb_tree_init(&f->tree, faces, size, l->tree, lmb_tree_bytes(faces, size));
    f->light_map = size;
    if (status == LMB_OK) {
        status = lmb_render_begin(l->render, f);
    }
    while (status == LMB_OK && l->render->stage < LMB_STAGE_BANDS) {
        status = lmb_render_step(l->render, 64);
        status = status == LMB_MORE ? LMB_OK : status;
    }
    return status;
}

/* By other settings of the same light, at the places for step 1 << `at`. Only what a picture has changes: the eye
 * stands. */
static lmb_status take(looker *l, lmb_look *out, int at, float rung, int32_t step, int32_t occlusion)
{
    lmb_frame *f = &l->render->frame;
    set_rung(f, rung);
    f->gather_step = step;
    f->occlusion = occlusion;
    return lmb_render_look(out, l->render, f->scratch, &l->places[at]);
}

/* Where to look, by each step: by the coarsest tree and the largest error. */
static lmb_status take_surveys(lmb_facts *out, looker *l)
{
    lmb_frame *f = &l->render->frame;
    lmb_status status = solve(l, out->tree >> (LMB_FACT_TREES - 1));
    for (int i = 0; i < LMB_FACT_STEPS && status == LMB_OK; ++i) {
        set_rung(f, (float)(LMB_FACT_RUNGS - 1));
        f->gather_step = 1 << i;
        status = lmb_render_survey(&l->places[i], l->render, f->scratch);
    }
    out->shown = l->places[0].shown;
    return status;
}

static void set_facts(lmb_facts *out, int step, int tree, int i, const lmb_look *look)
{
    const double per = look->pixels > 0.0 ? 1.0 / look->pixels : 0.0;
    out->pairs[step][tree][i] = (float)(look->pairs * per);
    out->segments[step][tree][i] = (float)(look->segments * per);
}

/* The finest rung is as far from the next as by the finest tree at every pixel. */
static void guess_finest(float (*table)[LMB_FACT_TREES][LMB_FACT_RUNGS], int step, int tree)
{
    const float next = table[0][0][1];
    table[step][tree][0] = next > 0.0f ? table[step][tree][1] * table[0][0][0] / next : 0.0f;
}

static float ratio(float a, float b) { return b > 0.0f ? a / b : 0.0f; }

/* Every other rung, between two that were looked at: its part of step 1's is the mean, by ratios, of theirs. */
static void guess_rungs(float (*table)[LMB_FACT_TREES][LMB_FACT_RUNGS], int step, int tree)
{
    const float *full = table[0][tree];
    float *part = table[step][tree];
    for (int i = 2; i < LMB_FACT_RUNGS - 1; i += 2) {
        part[i] = full[i] * sqrtf(ratio(part[i - 1], full[i - 1]) * ratio(part[i + 1], full[i + 1]));
    }
}

static void guess(lmb_facts *out, int step, int tree)
{
    float *error = out->error[step][tree];
    for (int i = 2; i < LMB_FACT_RUNGS - 1 && step > 0; i += 2) {
        error[i] = sqrtf(error[i - 1] * error[i + 1]);
    }
    if (step > 0) {
        guess_rungs(out->pairs, step, tree);
        guess_rungs(out->segments, step, tree);
    }
    guess_finest(out->pairs, step, tree);
    guess_finest(out->segments, step, tree);
    error[0] = error[1];
}

/* Rungs of one tree and step, against the finest at every pixel: all by the finest tree at every pixel, all but the
 * finest by the others, and every other of these where pixels are left out. */
static lmb_status take_ladder(lmb_facts *out, looker *l, int step, int tree)
{
    lmb_look *other = &l->look[OTHER_LOOK];
    const int is_first = step == 0 && tree == 0;
    lmb_status status = LMB_OK;
    for (int i = is_first ? 0 : 1; i < LMB_FACT_RUNGS && status == LMB_OK; i += step == 0 ? 1 : 2) {
        status = take(l, other, step, (float)i, 1 << step, LMB_OCCLUSION_EXACT);
        set_facts(out, step, tree, i, other);
        out->error[step][tree][i] = lmb_look_error(other, &l->look[step]);
    }
    if (!is_first) {
        guess(out, step, tree);
    }
    return status;
}

/* What nothing that blocks is off, against a middle rung. */
static lmb_status take_open(lmb_facts *out, looker *l)
{
    lmb_look *middle = &l->look[MIDDLE_LOOK], *other = &l->look[OTHER_LOOK];
    lmb_status status = take(l, middle, 0, MIDDLE, 1, LMB_OCCLUSION_EXACT);
    if (status == LMB_OK) {
        status = take(l, other, 0, MIDDLE, 1, LMB_OCCLUSION_NONE);
        out->open_error = lmb_look_error(other, middle);
        out->open_pairs = middle->pairs > 0.0 ? (float)(other->pairs / middle->pairs) : 1.0f;
    }
    return status;
}

static lmb_status take_trees(lmb_facts *out, looker *l)
{
    lmb_status status = take_surveys(out, l);
    status = status == LMB_OK ? solve(l, FINER * out->tree) : status;
    for (int step = 0; step < LMB_FACT_STEPS && status == LMB_OK; ++step) {
        status = take(l, &l->look[step], step, 0.0f, 1, LMB_OCCLUSION_EXACT);
    }
    for (int tree = 0; tree < LMB_FACT_TREES && status == LMB_OK; ++tree) {
        status = solve(l, out->tree >> tree);
        status = status == LMB_OK && tree == 0 ? take_open(out, l) : status;
        for (int step = 0; step < LMB_FACT_STEPS && status == LMB_OK; ++step) {
            status = take_ladder(out, l, step, tree);
        }
    }
    return status;
}

/* What needs no look. */
static void set_counts(lmb_facts *out, const lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    const lmb_view *v = &f->view;
    lmb_hull hull;
    out->triangles = (double)r->triangles;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        for (uint32_t bits = r->maps[i].drawn; bits != 0; bits >>= 1) {
            out->faces += bits & 1u ? 1.0 : 0.0;
        }
        out->lights += (r->light_state[i] & LMB_LIGHT_DARK) == 0 ? 1.0 : 0.0;
    }
    out->tiles = (double)((v->frame_width + 7) / 8) * (double)((v->frame_height + 7) / 8);
    out->bounces = (double)(f->bounces + (r->shines ? 1 : 0));
    out->elements = f->elements.data != NULL ? (double)f->elements.cap : 0.0;
    lmb_hull_find(&hull, f->scene);
    out->convex = hull.count > 0;
    for (out->wanted_map = 64; out->wanted_map < v->frame_width && out->wanted_map < 4096; out->wanted_map *= 2) {
    }
}

/* `finer`: times as fine as its tree is the finest that is solved. */
static int set_memory(looker *l, lmb_facts *out, int32_t finer, report *r)
{
    lmb_frame *f = &l->frame;
    const uint32_t faces = f->tree.face_cap, triangles = lmb_scene_triangles(f->scene);
    while (finer > 1 && out->tree > 64 &&
           (double)(finer * out->tree) * (double)(finer * out->tree) * (double)faces > LOOK_TEXELS) {
        out->tree /= 2;
    }
    const int32_t most = finer * out->tree;
    f->map_bytes = (size_t)faces * lmb_light_map_bytes(1, most, f->id_format);
    f->map_memory = l->map = malloc(f->map_bytes);
    l->tree = malloc(lmb_tree_bytes(faces, most));
    l->blockers = malloc(lmb_blockers_bytes(triangles));
    l->render = calloc(1, sizeof *l->render);
    l->look = malloc(LOOKS * sizeof *l->look);
    l->places = malloc(LMB_FACT_STEPS * sizeof *l->places);
    return (l->map != NULL && l->tree != NULL && l->blockers != NULL && l->render != NULL && l->look != NULL &&
            l->places != NULL &&
            lmb_blockers_init(&f->blockers, triangles, l->blockers, lmb_blockers_bytes(triangles)) == LMB_OK) ||
           report_fail(r, "not enough memory to look at the scene; without a budget it is drawn without");
}

/* As fine as the picture, in bounds. */
static int32_t look_tree(int32_t width)
{
    int32_t tree = 64;
    while (tree < width && tree < LOOK_TREE) {
        tree *= 2;
    }
    return tree;
}

/* Pairs and segments alone, by the job's own settings: every rung is that one. Where to look, by the largest error. */
static lmb_status take_own(lmb_facts *out, looker *l)
{
    lmb_look *look = &l->look[0];
    lmb_frame *f = &l->render->frame;
    lmb_status status = solve(l, out->tree);
    const float error = f->error, visible = f->visible;
    if (status == LMB_OK) {
        set_rung(f, (float)(LMB_FACT_RUNGS - 1));
        status = lmb_render_survey(&l->places[0], l->render, f->scratch);
    }
    if (status == LMB_OK) {
        f->error = error;
        f->visible = visible;
        status = lmb_render_look(look, l->render, f->scratch, &l->places[0]);
    }
    for (int i = 0; i < LMB_FACT_STEPS * LMB_FACT_TREES * LMB_FACT_RUNGS && status == LMB_OK; ++i) {
        set_facts(out, i / LMB_FACT_RUNGS / LMB_FACT_TREES, i / LMB_FACT_RUNGS % LMB_FACT_TREES, i % LMB_FACT_RUNGS,
                  look);
    }
    out->shown = l->places[0].shown;
    out->open_pairs = 1.0f;
    return status;
}

int scene_look(lmb_facts *out, const render_job *j, report *r)
{
    const int chooses = has_budget(&j->o.budget, j->o.budget_ms);
    looker l;
    memset(out, 0, sizeof *out);
    memset(&l, 0, sizeof l);
    l.job = j;
    l.frame = j->frame;
    l.frame.show = j->frame.show == LMB_SHOW_FULL ? LMB_SHOW_FULL : LMB_SHOW_INDIRECT;
    l.frame.occlusion = chooses ? LMB_OCCLUSION_EXACT : j->frame.occlusion;
    l.frame.gather_step = chooses ? 1 : j->frame.gather_step;
    l.frame.stats = NULL;
    l.frame.many = NULL;
    if (l.frame.tree.texel == NULL || l.frame.grouping.method != LMB_GROUP_CUT) {
        return 1; /* nothing bounces, or by groups, whose pairs are not counted */
    }
    out->tree = chooses ? look_tree(j->frame.view.frame_width) : j->frame.tree.size;
    int ok = set_memory(&l, out, chooses ? FINER : 1, r);
    if (ok) {
        const lmb_status status = chooses ? take_trees(out, &l) : take_own(out, &l);
        ok = status == LMB_OK || report_fail(r, "%s: looking at it stopped: %s", j->o.scene, lmb_status_name(status));
    }
    if (ok) {
        set_counts(out, l.render);
    }
    free(l.map);
    free(l.tree);
    free(l.blockers);
    free(l.render);
    free(l.look);
    free(l.places);
    return ok;
}
