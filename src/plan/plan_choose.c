/* plan_choose.c: settings for a budget, by what a look at the scene found and a fitted model. Floor 8.
 *
 * Errors of the cut, of the map and of what is filled in between pixels are taken as independent: their squares add.
 * Each is the look's own figure times one number that was fitted over scenes (plan_model.inc). */
#include <lambent/plan.h>

#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "plan_model.h"
#include "stages.h"
#include "wants.h"

#if LMB_PLAN && LMB_TREES


#define COARSE 2.0f /* by how much a tree's error grows at least, for each halving beyond the look's: from 64 texels
                       down things are smaller than texels (cornell by 8: 4 times what its fall from 256 to 64 said) */

/* Between rungs by equal ratios; past the ends as the ends. */
static double at_rung(const float *rung, float k)
{
    const float in = clampf(k, 0.0f, (float)(LMB_FACT_RUNGS - 1));
    const int i = mini((int)in, LMB_FACT_RUNGS - 2);
    const float a = maxf(rung[i], 1e-12f), b = maxf(rung[i + 1], 1e-12f);
    return (double)(a * lmb_exp2((in - (float)i) * lmb_log2(b / a)));
}

static float rung_of(float error) { return lmb_log2(maxf(error, 1e-6f) / LMB_FACT_FINEST); }

/* Doublings from the look's finest tree to this one. */
static float octaves(const lmb_facts *f, int32_t tree) { return lmb_log2((float)tree / (float)f->tree); }

/* A table's number at a rung and a tree: between the looks' trees by equal ratios; beyond them the last ratio goes
 * on. */
static double at_tree(const float (*table)[LMB_FACT_RUNGS], float k, float doublings)
{
    const float last = (float)(LMB_FACT_TREES - 1), t = clampf(-doublings, 0.0f, last);
    const int i = mini((int)t, LMB_FACT_TREES - 2);
    const double a = at_rung(table[i], k), b = at_rung(table[i + 1], k);
    const float per = lmb_log2(clampf((float)(b / a), 0.1f, 1.2f));
    const float beyond = doublings > 0.0f ? -doublings : -doublings > last ? -doublings - last : 0.0f;
    return a * (double)lmb_exp2(per * (t - (float)i + beyond));
}

void lmb_model_light(double *pairs, double *segments, const lmb_facts *f, const lmb_settings *s,
                     double pixels)
{
    const float doublings = octaves(f, s->tree);
    const int step = s->gather_step / 2, exact = s->occlusion == LMB_OCCLUSION_EXACT;
    const double shown = pixels * (double)f->shown;
    const float asked = rung_of(s->visible / LMB_FACT_VISIBLE);
    *pairs = shown * at_tree(f->pairs[step], rung_of(s->error), doublings) *
             (exact ? 1.0 : (double)f->open_pairs);
    *segments = exact ? shown * at_tree(f->segments[step], asked, doublings) : 0.0;
}

void lmb_facts_count(double *pairs, double *segments, const lmb_facts *facts, const lmb_frame *f)
{
    if (pairs == NULL || segments == NULL) {
        return;
    }
    *pairs = *segments = 0.0;
    if (facts == NULL || f == NULL || facts->tree < 1) {
        return;
    }
    lmb_settings s = {f->light_map, f->tree.size, f->error, f->visible, f->gather_step, f->occlusion};
    const lmb_view *v = &f->view;
    const int32_t across = (v->frame_width + LMB_TILE - 1) / LMB_TILE;
    if (wants_cut(f)) {
        lmb_model_light(pairs, segments, facts, &s, (double)across * (double)band_count(v) * LMB_TILE_PIXELS);
    }
}

/* What the tree that errors are told against is off by itself is a part of what the next coarser one is off from it. */
float lmb_model_error(const plan_model *m, const lmb_facts *f, const lmb_settings *s)
{
    const float doublings = octaves(f, s->tree), k = rung_of(s->error);
    const int tree = mini((int)maxf(0.5f - doublings, 0.0f), LMB_FACT_TREES - 1), step = s->gather_step / 2;
    const double cut = at_rung(f->error[0][tree], k) * (double)m->cut;
    const double all = step > 0 ? at_rung(f->error[step][tree], k) * (double)m->step : cut;
    const double own = (double)(f->error[0][0][0] * m->map * lmb_exp2(-maxf(doublings, 0.0f)));
    const float growth = clampf(f->error[0][2][1] / maxf(f->error[0][1][1], 1e-6f), COARSE, 2.0f * COARSE);
    const double coarser = (double)lmb_exp2(lmb_log2(growth) * maxf(-2.0f - doublings, 0.0f));
    const double open = s->occlusion == LMB_OCCLUSION_EXACT ? 0.0 : (double)f->open_error;
    return sqrtf((float)(all * all + cut * cut * (coarser * coarser - 1.0) + own * own + open * open));
}

void lmb_model_cost(lmb_choice *out, const plan_model *m, const lmb_facts *f, uint64_t fixed)
{
    const lmb_settings *s = &out->settings;
    const double texels = f->faces * (double)s->light_map * (double)s->light_map, pixels = f->tiles * LMB_TILE_PIXELS;
    const int exact = s->occlusion == LMB_OCCLUSION_EXACT;
    memset(out->op, 0, sizeof out->op);
    out->op[LMB_OP_TRIANGLES] = f->triangles * (f->faces + 1.0);
    out->op[LMB_OP_TEXELS] = texels + pixels;
    out->op[LMB_OP_BLOCKERS] = exact ? f->triangles : 0.0;
    out->op[LMB_OP_RESOLVED] = texels + pixels * (s->gather_step > 1 ? 3.0 : 1.0);
    out->op[LMB_OP_SUMMED] = f->faces * (double)s->tree * (double)s->tree;
    out->op[LMB_OP_ELEMENTS] = f->elements > 0.0 ? f->triangles : 0.0;
    out->op[LMB_OP_LIT] = pixels * f->lights;
    out->op[LMB_OP_CUTS] = f->tiles / (double)(s->gather_step * s->gather_step) * (f->elements > 0.0 ? 2.0 : 1.0) +
                           f->elements / LMB_TILE_PIXELS * (f->bounces - 1.0);
    lmb_model_light(&out->op[LMB_OP_PAIRS], &out->op[LMB_OP_SEGMENTS], f, s, pixels);
    out->op[LMB_OP_SEGMENTS] = f->convex ? 0.0 : out->op[LMB_OP_SEGMENTS];
    out->op[LMB_OP_STORED] = pixels;
    out->work = 0.0;
    for (int i = 0; i < LMB_OPS; ++i) {
        out->work += out->op[i] * (double)m->units[i];
    }
    out->error = lmb_model_error(m, f, s);
    const uint32_t faces = f->faces > 1.0 ? (uint32_t)f->faces : 1;
    out->bytes = fixed + (uint64_t)(texels * 8.0) + (uint64_t)lmb_tree_bytes(faces, s->tree);
}

/* By how much the budget is not met: 1 or less where it is. */
static double over(const lmb_choice *c, const lmb_budget *b)
{
    const double work = b->work > 0.0 ? c->work / b->work : 0.0;
    const double bytes = b->bytes > 0 ? (double)c->bytes / (double)b->bytes : 0.0;
    const double error = b->error > 0.0f ? (double)c->error / (double)b->error : 0.0;
    return work > bytes ? (work > error ? work : error) : bytes > error ? bytes : error;
}

/* Is `a` to be taken rather than `b`? */
static int is_better(const lmb_choice *a, const lmb_choice *b, const lmb_budget *budget)
{
    const double x = over(a, budget), y = over(b, budget);
    if (x > 1.0 || y > 1.0) {
        const double most = x > 1.0 && y > 1.0 ? 0.98 : 1.0;
        if (x < y * most || y < x * most) {
            return x < y;
        }
    }
    if (budget->error > 0.0f) {
        return a->work < b->work;
    }
    return a->error < b->error * 0.98f || (a->error < b->error * 1.02f && a->work < b->work);
}

/* A tree's map: as fine as the picture, where the tree and `most` let it be. */
static int32_t map_for(int32_t tree, int32_t wanted, int32_t most)
{
    int32_t map = tree;
    while (map < wanted && 2 * map <= most && 2 * map <= 8 * tree) {
        map *= 2;
    }
    return map;
}

lmb_status lmb_plan_choose(lmb_choice *out, const lmb_facts *facts, const lmb_budget *budget, uint64_t fixed,
                           int32_t most)
{
    static const int32_t steps[3] = {1, 2, 4};
    if (out == NULL || facts == NULL || budget == NULL || facts->tree < LMB_TILE || most < LMB_TILE) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    out->work = -1.0;
    for (int32_t tree = LMB_TILE; tree <= most && tree <= facts->tree; tree *= 2) {
        for (int i = 0; i < 6 * (2 * LMB_FACT_RUNGS - 1); ++i) {
            lmb_choice c;
            memset(&c, 0, sizeof c);
            c.settings.tree = tree;
            c.settings.light_map = map_for(tree, facts->wanted_map, most);
            c.settings.error = LMB_FACT_FINEST * lmb_exp2(0.5f * (float)(i / 6));
            c.settings.visible = LMB_FACT_VISIBLE * c.settings.error;
            c.settings.gather_step = steps[i % 3];
            c.settings.occlusion = i / 3 % 2 == 0 ? LMB_OCCLUSION_EXACT : LMB_OCCLUSION_NONE;
            lmb_model_cost(&c, &lmb_model, facts, fixed);
            if (out->work < 0.0 || is_better(&c, out, budget)) {
                *out = c;
            }
        }
    }
    out->meets = over(out, budget) <= 1.0;
    return LMB_OK;
}

#endif
