/* transfer_tile.c: the light of a tile's pixels, from the receivers around them. Layer 9. */
#include <lambent/transfer.h>

#include <string.h>

#include "halvings.h"

#if LMB_TRANSFER

/* What neighbouring pixels share: their triangle, its side, and three corners with their light. */
typedef struct here {
    const lmb_transfer_light *light;
    const lmb_transfer *transfer;
    transfer_triangle triangle; /* id 0: none */
    uint32_t root;
    int is_mesh, has_leaf;
    float to_leaf[3][3];        /* from the triangle's weights to the leaf's */
    float corner[3][9];         /* light at the corners: of a leaf R, G, B; of a mesh by direction */
} here;

/* --- corners ------------------------------------------------------------------------------------------------------ */

static void blend(float out[9], const lmb_transfer_light *light, const uint32_t *b)
{
    memset(out, 0, 9 * sizeof *out);
    for (int k = 0; k < 4; ++k) {
        const float *cluster = light->cluster[b[k / 2] >> 16 * (k % 2) & 0xffffu];
        const float share = (float)(b[2] >> 8 * k & 255u) * (1.0f / 255.0f);
        for (int c = 0; c < 9; ++c) {
            out[c] += share * cluster[c];
        }
    }
}

static void set_corners(here *h, uint32_t place)
{
    const lmb_transfer *t = h->transfer;
    const uint32_t *corner = t->section[LMB_TRANSFER_CORNERS] + LMB_TRANSFER_CORNER_WORDS * (size_t)place;
    h->is_mesh = place >= t->leaves;
    h->has_leaf = 1;
    for (int k = 0; k < 3; ++k) {
        if (h->is_mesh) {
            blend(h->corner[k], h->light,
                  t->section[LMB_TRANSFER_BLENDS] + LMB_TRANSFER_BLEND_WORDS * (size_t)corner[k]);
        } else {
            memcpy(h->corner[k], h->light->receiver[corner[k]], 3 * sizeof h->corner[k][0]);
        }
    }
}

/* Down to the leaf that holds the weights, with the matrix of all halvings on the way. */
static void enter_leaf(here *h, const float weights[3])
{
    const uint32_t *node = h->transfer->section[LMB_TRANSFER_DIVISIONS];
    float w[3] = {weights[0], weights[1], weights[2]};
    uint32_t at = h->root;
    memset(h->to_leaf, 0, sizeof h->to_leaf);
    h->to_leaf[0][0] = h->to_leaf[1][1] = h->to_leaf[2][2] = 1.0f;
    while ((node[at] & LMB_TRANSFER_LEAF) == 0) {
        const int from = (int)(node[at] >> LMB_TRANSFER_EDGE_BIT & 3u), to = from == 2 ? 0 : from + 1;
        const int keeps = w[from] >= w[to] ? from : to, moves = keeps == from ? to : from;
        for (int c = 0; c < 3; ++c) {
            h->to_leaf[keeps][c] -= h->to_leaf[moves][c];
            h->to_leaf[moves][c] *= 2.0f;
        }
        at = halving_enter(w, node[at]);
    }
    set_corners(h, node[at] & ~LMB_TRANSFER_LEAF);
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* 0 where nothing receives light. */
static int enter_triangle(here *h, const lmb_scene *scene, uint32_t id, lmb_vec3 face)
{
    h->has_leaf = 0;
    h->root = LMB_TRANSFER_NONE;
    if (id > h->transfer->count[LMB_TRANSFER_SURFACES] || !transfer_triangle_of(&h->triangle, scene, id)) {
        h->triangle.id = id;
        return 0;
    }
    const uint32_t back = dot3(h->triangle.normal, face) < 0.0f;
    h->root = h->transfer->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (id - 1) + 2 + back];
    return h->root != LMB_TRANSFER_NONE;
}

/* The weights of the leaf's corners; 0 where the point lies on another leaf. */
static int leaf_weights(float out[3], const here *h, const float w[3])
{
    int inside = 1;
    for (int k = 0; k < 3; ++k) {
        out[k] = h->to_leaf[k][0] * w[0] + h->to_leaf[k][1] * w[1] + h->to_leaf[k][2] * w[2];
        inside &= out[k] >= 0.0f;
    }
    return inside;
}

static void light_pixel(float out[3], here *h, lmb_vec3 p, lmb_vec3 n)
{
    float w[3], own[3];
    transfer_weights(w, &h->triangle, p);
    if (!h->has_leaf || !leaf_weights(own, h, w)) {
        enter_leaf(h, w);
        leaf_weights(own, h, w);
    }
    for (int c = 0; c < 3; ++c) {
        float e = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const float *at = h->corner[k] + (h->is_mesh ? 3 * c : c);
            e += own[k] * (h->is_mesh ? n.x * at[0] + n.y * at[1] + n.z * at[2] : at[0]);
        }
        out[c] = maxf(e, 0.0f);
    }
}

lmb_status lmb_transfer_tile(lmb_irradiance *inout, const lmb_transfer_light *light, const lmb_transfer *transfer,
                             const lmb_scene *scene, const lmb_tile *tile)
{
    here h;
    lmb_vec3 face = vec3(0.0f, 0.0f, 0.0f);
    if (inout == NULL || light == NULL || light->receiver == NULL || transfer == NULL ||
        transfer->section[0] == NULL || scene == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    memset(&h, 0, sizeof h);
    h.light = light;
    h.transfer = transfer;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 own = vec3(tile->face[0][k], tile->face[1][k], tile->face[2][k]);
        float e[3];
        if (tile->id[k] == 0) {
            continue;
        }
        if (tile->id[k] != h.triangle.id || dot3(own, face) < 0.0f) {
            enter_triangle(&h, scene, tile->id[k], own);
            face = own;
        }
        if (h.root == LMB_TRANSFER_NONE) {
            continue;
        }
        light_pixel(e, &h, vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]),
                    vec3(tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]));
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] += e[c];
        }
    }
    return LMB_OK;
}

#endif
