/* ladder.c: a ladder of settings, the cost of each, and the choice for a budget.
 *
 * The cost of a rung and the difference to the next are sampled; errors are not known beyond this. */
#include "ladder.h"

#include <lambent/lambent.h>
#include <string.h>

#define GROWTH 2.2 /* ratio of pairs and segments between consecutive rungs: 1.3 to 3 */

/* From draft on these are the tool's presets, plus one finer than `best`. */
static const struct step {
    int32_t tree;
    float error, visibility;
} steps[LADDER_RUNGS] = {
    {16, 0.5f, 0.5f},     {32, 0.25f, 0.25f},    {64, 0.12f, 0.12f},    {128, 0.06f, 0.06f},
    {256, 0.02f, 0.015f}, {1024, 0.01f, 0.005f}, {1024, 0.01f, 0.002f}, {1024, 0.005f, 0.0005f},
};

/* A tree's shadow map: as fine as the picture, within the limits of the tree and facts->max. */
static int32_t map_for(int32_t tree, const ladder_facts *f)
{
    int32_t map = tree;
    while (map < f->wanted_map && 2 * map <= f->max && 2 * map <= 8 * tree) {
        map *= 2;
    }
    return map;
}

void ladder_at(ladder_settings *out, const ladder_facts *facts, int32_t rung)
{
    const struct step *at = &steps[rung < 0 ? 0 : rung < LADDER_RUNGS ? rung : LADDER_RUNGS - 1];
    for (out->tree = at->tree; out->tree > facts->max && out->tree > LMB_TILE; out->tree /= 2) {
    }
    out->shadow_map = map_for(out->tree, facts);
    out->error = at->error;
    out->visibility = at->visibility;
    out->occlusion = LMB_OCCLUSION_EXACT;
}

/* The facts may be absurd: negative numbers and NaN become 0. */
static uint64_t count_of(double n, uint64_t max) { return n >= (double)max ? max : n > 0.0 ? (uint64_t)n : 0; }

/* The light of elements takes a second cut, assumed to be as large. */
void ladder_cost_of(ladder_choice *out, const ladder_facts *f, double pairs, double segments, uint64_t fixed)
{
    const ladder_settings *s = &out->settings;
    const double texels = f->faces * (double)s->shadow_map * (double)s->shadow_map, pixels = f->tiles * LMB_TILE_PIXELS;
    const double cuts = f->elements > 0.0 ? 2.0 : 1.0;
    memset(out->op, 0, sizeof out->op);
    out->op[LMB_OP_TRIANGLES] = f->triangles * (f->faces + 1.0);
    out->op[LMB_OP_TEXELS] = texels + pixels;
    out->op[LMB_OP_BVH] = f->triangles;
    out->op[LMB_OP_RESOLVED] = texels + pixels;
    out->op[LMB_OP_SUMMED] = f->faces * (double)s->tree * (double)s->tree;
    out->op[LMB_OP_ELEMENTS] = f->elements > 0.0 ? f->triangles : 0.0;
    out->op[LMB_OP_LIGHTING] = pixels * f->lights;
    out->op[LMB_OP_CUTS] = cuts * f->tiles + f->elements / LMB_TILE_PIXELS * (f->bounces - 1.0);
    out->op[LMB_OP_PAIRS] = cuts * pairs;
    out->op[LMB_OP_SEGMENTS] = f->convex ? 0.0 : cuts * segments;
    out->op[LMB_OP_STORED] = pixels;
    out->work = 0.0;
    for (int i = 0; i < LMB_OPS; ++i) {
        out->work += out->op[i] * lmb_plan_units(i);
    }
    const uint32_t faces = f->faces > 1.0 ? (uint32_t)count_of(f->faces, UINT32_MAX) : 1;
    out->bytes = fixed + count_of(texels * 8.0, UINT64_C(1) << 62) + (uint64_t)lmb_tree_bytes(faces, s->tree);
}

void ladder_cost(ladder_choice *out, const ladder_facts *facts, int32_t rung, uint64_t fixed)
{
    double growth = 1.0;
    int32_t near = rung;
    while (near > 0 && facts->rung[near].places == 0) {
        --near;
        growth *= GROWTH;
    }
    memset(out, 0, sizeof *out);
    out->rung = rung;
    ladder_at(&out->settings, facts, rung);
    ladder_cost_of(out, facts, growth * facts->tiles * (double)facts->rung[near].pairs,
                   growth * facts->tiles * (double)facts->rung[near].segments, fixed);
    out->error = facts->rung[rung].error;
}

/* Factor by which the budget is exceeded: 1 or less if it is met. */
static double over(const ladder_choice *c, const ladder_budget *b)
{
    const double work = b->work > 0.0 ? c->work / b->work : 0.0;
    const double bytes = b->bytes > 0 ? (double)c->bytes / (double)b->bytes : 0.0;
    return work > bytes ? work : bytes;
}

/* Finer rungs have smaller errors, sampled or not. So the first rung that meets the error is the cheapest. If none
 * does, the last that work and bytes allow is the closest. */
int ladder_choose(ladder_choice *out, const ladder_facts *facts, const ladder_budget *budget, uint64_t fixed)
{
    int keeps = 0;
    for (int32_t i = 0; i < LADDER_RUNGS - 1 && facts->max >= LMB_TILE && !keeps; ++i) {
        ladder_choice c;
        ladder_cost(&c, facts, i, fixed);
        const int fits = over(&c, budget) <= 1.0;
        keeps = budget->error > 0.0f && c.error >= 0.0f && c.error <= budget->error;
        c.meets = fits && (keeps || !(budget->error > 0.0f));
        if (i == 0 || fits || (!out->meets && over(&c, budget) < over(out, budget))) {
            *out = c;
        }
    }
    return facts->max >= LMB_TILE;
}
