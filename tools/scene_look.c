/* scene_look.c: a scene solved by three trees, and its light at a few tiles by a ladder of settings. */
#include "scene_look.h"

#include <stdlib.h>
#include <string.h>

enum { LOOK_TREE = 256, LOOK_TEXELS = 1 << 21 /* over all faces */, MIDDLE = 2 /* rung: error 0.1 */ };

/* A job's frame with the look's own maps, tree and blockers. */
typedef struct looker {
    const render_job *job;
    lmb_frame frame;
    lmb_render *render;
    lmb_look *look; /* [3]: the finest, another, a middle one */
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

/* By other settings of the same light. Only what a picture has changes: the eye stands. */
static lmb_status take(looker *l, lmb_look *out, float rung, int32_t step, int32_t occlusion)
{
    lmb_frame *f = &l->render->frame;
    set_rung(f, rung);
    f->gather_step = step;
    f->occlusion = occlusion;
    return lmb_render_look(out, l->render, f->scratch);
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

/* All rungs but the finest by one tree and step; at every pixel, against `fine`. */
static lmb_status take_ladder(lmb_facts *out, looker *l, int step, int tree, const lmb_look *fine)
{
    lmb_look *other = &l->look[1];
    lmb_status status = LMB_OK;
    for (int i = 1; i < LMB_FACT_RUNGS && status == LMB_OK; ++i) {
        status = take(l, other, (float)i, 1 << step, LMB_OCCLUSION_EXACT);
        set_facts(out, step, tree, i, other);
        if (step == 0) {
            out->error[tree][i] = lmb_look_error(other, fine);
        }
    }
    if (step > 0 || tree > 0) {
        guess_finest(out->pairs, step, tree);
        guess_finest(out->segments, step, tree);
    }
    out->error[tree][0] = tree > 0 ? out->error[tree][1] : 0.5f * out->error[0][1];
    return status;
}

/* What fewer pixels, and nothing that blocks, are off, against a middle rung. */
static lmb_status take_others(lmb_facts *out, looker *l)
{
    lmb_look *middle = &l->look[2], *other = &l->look[1];
    lmb_status status = take(l, middle, MIDDLE, 1, LMB_OCCLUSION_EXACT);
    for (int i = 1; i < LMB_FACT_STEPS && status == LMB_OK; ++i) {
        status = take(l, other, MIDDLE, 1 << i, LMB_OCCLUSION_EXACT);
        out->step_error[i] = lmb_look_error(other, middle);
    }
    if (status == LMB_OK) {
        status = take(l, other, MIDDLE, 1, LMB_OCCLUSION_NONE);
        out->open_error = lmb_look_error(other, middle);
        out->open_pairs = middle->pairs > 0.0 ? (float)(other->pairs / middle->pairs) : 1.0f;
    }
    return status;
}

static lmb_status take_trees(lmb_facts *out, looker *l)
{
    lmb_look *fine = &l->look[0];
    lmb_status status = solve(l, out->tree);
    status = status == LMB_OK ? take(l, fine, 0.0f, 1, LMB_OCCLUSION_EXACT) : status;
    set_facts(out, 0, 0, 0, fine);
    out->shown = fine->shown;
    status = status == LMB_OK ? take_others(out, l) : status;
    for (int tree = 0; tree < LMB_FACT_TREES && status == LMB_OK; ++tree) {
        status = tree > 0 ? solve(l, out->tree >> tree) : status;
        for (int step = 0; step < LMB_FACT_STEPS && status == LMB_OK; ++step) {
            status = take_ladder(out, l, step, tree, fine);
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
    out->bounces = (double)f->bounces;
    out->elements = f->elements.data != NULL ? (double)f->elements.cap : 0.0;
    lmb_hull_find(&hull, f->scene);
    out->convex = hull.count > 0;
    for (out->wanted_map = 64; out->wanted_map < v->frame_width && out->wanted_map < 4096; out->wanted_map *= 2) {
    }
}

static int set_memory(looker *l, lmb_facts *out, report *r)
{
    lmb_frame *f = &l->frame;
    const uint32_t faces = f->tree.face_cap, triangles = lmb_scene_triangles(f->scene);
    while (out->tree > 64 && (double)out->tree * (double)out->tree * (double)faces > LOOK_TEXELS) {
        out->tree /= 2;
    }
    f->map_bytes = (size_t)faces * lmb_light_map_bytes(1, out->tree, f->id_format);
    f->map_memory = l->map = malloc(f->map_bytes);
    l->tree = malloc(lmb_tree_bytes(faces, out->tree));
    l->blockers = malloc(lmb_blockers_bytes(triangles));
    l->render = calloc(1, sizeof *l->render);
    l->look = malloc(3 * sizeof *l->look);
    return (l->map != NULL && l->tree != NULL && l->blockers != NULL && l->render != NULL && l->look != NULL &&
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

/* Pairs and segments alone, by the job's own settings: every rung is that one. */
static lmb_status take_own(lmb_facts *out, looker *l)
{
    lmb_look *look = &l->look[0];
    lmb_status status = solve(l, out->tree);
    if (status == LMB_OK) {
        status = lmb_render_look(look, l->render, l->frame.scratch);
    }
    for (int i = 0; i < LMB_FACT_STEPS * LMB_FACT_TREES * LMB_FACT_RUNGS && status == LMB_OK; ++i) {
        set_facts(out, i / LMB_FACT_RUNGS / LMB_FACT_TREES, i / LMB_FACT_RUNGS % LMB_FACT_TREES, i % LMB_FACT_RUNGS,
                  look);
    }
    out->shown = look->shown;
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
    l.frame.show = LMB_SHOW_INDIRECT;
    l.frame.occlusion = chooses ? LMB_OCCLUSION_EXACT : j->frame.occlusion;
    l.frame.gather_step = chooses ? 1 : j->frame.gather_step;
    l.frame.stats = NULL;
    l.frame.many = NULL;
    if (l.frame.tree.texel == NULL || l.frame.grouping.method != LMB_GROUP_CUT) {
        return 1; /* nothing bounces, or by groups, whose pairs are not counted */
    }
    out->tree = chooses ? look_tree(j->frame.view.frame_width) : j->frame.tree.size;
    int ok = set_memory(&l, out, r);
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
    return ok;
}
