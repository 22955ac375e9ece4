/* transfer_tile.c: light of a tile's pixels, from the receivers around them. Layer 7. */
#include <lambent/transfer.h>

#include <string.h>

#include "../lane/kernels.h"
#include "../raster/tile.h"
#include "air.h"
#include "blend.h"
#include "halvings.h"

#if LMB_TRANSFER

/* --- corners ------------------------------------------------------------------------------------------------------ */

static void set_leaf_corners(lmb_transfer_leaf *leaf, const lmb_transfer_light *light, const lmb_transfer *t,
                             uint32_t place)
{
    const uint32_t *corner = t->section[LMB_TRANSFER_CORNERS] + LMB_TRANSFER_CORNER_WORDS * (size_t)place;
    leaf->is_directed = place >= t->leaves;
    for (int k = 0; k < 3; ++k) {
        if (leaf->is_directed) {
            transfer_blend(leaf->corner[k], light,
                           t->section[LMB_TRANSFER_BLENDS] + LMB_TRANSFER_BLEND_WORDS * (size_t)corner[k]);
        } else {
            memcpy(leaf->corner[k], light->receiver[corner[k]], 3 * sizeof leaf->corner[k][0]);
        }
    }
}

/* --- leaves ------------------------------------------------------------------------------------------------------- */

static float weight_at(const float w[3], float b1, float b2) { return w[0] + w[1] * b1 + w[2] * b2; }

/* Enters the half that contains a point. The kept corner on the halved edge loses the other corner's weight, which is
 * doubled because that corner is now the middle of the edge. All these numbers are whole, except in cuts. */
static void enter_pixel_half(lmb_transfer_step *s, const transfer_halving *h, float b1, float b2)
{
    const int from = h->from, to = halving_to(from), other = 3 - from - to;
    float more[3];
    for (int c = 0; c < 3; ++c) {
        more[c] = s->weight[from][c] - h->ratio * s->weight[to][c];
    }
    s->second = weight_at(more, b1, b2) < 0.0f;
    const transfer_half half = half_of(h, s->second);
    for (int c = 0; c < 3; ++c) {
        s->side[c] = s->second ? -more[c] : more[c];
        s[1].weight[half.keeps][c] = s->second ? half.less * s->side[c] : s->side[c];
        s[1].weight[half.moves][c] = half.more * s->weight[half.moves][c];
        s[1].weight[other][c] = s->weight[other][c];
    }
    s[1].at = h->first + (uint32_t)s->second;
}

/* Returns 0 if cuts in a damaged file have made the weights too large. Halvings without a cut at most triple them: 40
 * of these stay finite, so they need no check. */
static int are_weights(const lmb_transfer_step *s)
{
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        sum += absf(s->weight[0][c]) + absf(s->weight[1][c]) + absf(s->weight[2][c]);
    }
    return sum < 1e18f;
}

/* Counts the steps of the previous descent that a point shares. */
static uint32_t shared_steps(const lmb_transfer_met *s, float b1, float b2)
{
    uint32_t i = 0;
    for (; i < s->depth; ++i) {
        const float side = weight_at(s->step[i].side, b1, b2);
        if (!(s->step[i].second ? side > 0.0f : side >= 0.0f)) {
            break;
        }
    }
    return i;
}

/* Descends to the leaf that contains a point of the triangle, the last of the steps. Returns the leaf's place, or
 * LMB_TRANSFER_NONE if it lies too deep. */
static uint32_t enter_leaf(lmb_transfer_met *s, const lmb_transfer *t, uint32_t root, float b1, float b2)
{
    const uint32_t *node = t->section[LMB_TRANSFER_DIVISIONS];
    static const float whole[3][3] = {{1, -1, -1}, {0, 1, 0}, {0, 0, 1}};
    if (s->root != root + 1) {
        s->root = root + 1;
        s->depth = 0;
        s->step[0].at = root;
        memcpy(s->step[0].weight, whole, sizeof whole);
    }
    uint32_t i = shared_steps(s, b1, b2);
    uint32_t word = node[s->step[i].at];
    for (; i < LMB_TRANSFER_MAX_HALVINGS && (word & LMB_TRANSFER_LEAF) == 0; ++i) {
        const transfer_halving h = halving_of(t, word);
        const uint32_t *half = node + h.first, first = half[0], second = half[1];
        enter_pixel_half(&s->step[i], &h, b1, b2);
        if (h.part != 0.5f && !are_weights(&s->step[i + 1])) {
            break;
        }
        word = s->step[i].second ? second : first;
    }
    s->depth = i;
    return (word & LMB_TRANSFER_LEAF) != 0 ? word & ~LMB_TRANSFER_LEAF : LMB_TRANSFER_NONE;
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Arguments of a call. */
typedef struct job {
    const lmb_kernels *kernels;
    lmb_glossy *glossy; /* or NULL */
    lmb_transfer_met *met;
    const lmb_transfer_light *light;
    const lmb_transfer *transfer;
    const lmb_tile *tile;
} job;

/* Lights one side of a triangle leaf by leaf: the leaf of the first remaining pixel lights all pixels on it. */
static void light_tile_side(lmb_irradiance *inout, const job *j, uint32_t root, uint64_t pixels)
{
    lmb_transfer_met *s = j->met;
    lmb_transfer_leaf leaf;
    while (pixels != 0) {
        const int first = lowest_bit_64(pixels);
        const uint32_t place = enter_leaf(s, j->transfer, root, s->weight[0][first],
                                          s->weight[1][first]);
        uint64_t own = (uint64_t)1 << first;
        if (place != LMB_TRANSFER_NONE) {
            leaf.weight = (const float(*)[3])s->step[s->depth].weight;
            set_leaf_corners(&leaf, j->light, j->transfer, place);
            own = j->kernels->transfer_leaf(inout, j->glossy, s->weight, j->tile, pixels, &leaf);
        }
        pixels &= ~own;
    }
}

/* Returns the pixels of `left` on the first pixel's side of a triangle, lit if that side receives light. */
static uint64_t light_first(lmb_irradiance *inout, const job *j, const lmb_scene *scene, uint64_t left)
{
    const int first = lowest_bit_64(left);
    const uint32_t id = j->tile->id[first];
    if (lmb_transfer_moves(j->transfer, id)) {
        lmb_transfer_air_pixel(inout, j->light, j->transfer, j->tile, first);
        return (uint64_t)1 << first;
    }
    const lmb_transfer_triangle *triangle =
        id > j->transfer->count[LMB_TRANSFER_SURFACES] ? NULL : transfer_triangle_kept(&j->met->kept, scene, id);
    if (triangle == NULL) {
        return (uint64_t)1 << first;
    }
    const uint64_t own = j->kernels->transfer_side(j->met->weight, j->tile, left, triangle);
    const uint32_t back = dot3(triangle->normal, tile_vec(j->tile->face, first)) < 0.0f;
    const uint32_t root =
        j->transfer->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1) + 2 + back];
    if (root != LMB_TRANSFER_NONE) {
        light_tile_side(inout, j, root, own);
    }
    return own;
}

lmb_status lmb_transfer_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_kernels *kernels,
                             lmb_transfer_scratch *scratch, const lmb_transfer_light *light,
                             const lmb_transfer *transfer, const lmb_scene *scene, const lmb_tile *tile)
{
    if (inout == NULL || kernels == NULL || scratch == NULL || light == NULL || light->receiver == NULL ||
        transfer == NULL || transfer->section[0] == NULL || scene == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    const job j = {kernels, glossy, &scratch->met, light, transfer, tile};
    for (uint64_t left = kernels->resolve_shown(tile->id); left != 0;) {
        left &= ~light_first(inout, &j, scene, left);
    }
    return LMB_OK;
}

#endif
