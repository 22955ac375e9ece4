/* transfer_tile.c: the light of a tile's pixels, from the receivers around them. Layer 9. */
#include <lambent/transfer.h>

#include <string.h>

#include "blend.h"
#include "halvings.h"

#if LMB_TRANSFER

/* What pixels of one triangle share, and what those on one of its leaves do. */
typedef struct here {
    const lmb_transfer_light *light;
    const lmb_transfer *transfer;
    const lmb_tile *tile;
    transfer_triangle triangle;
    uint32_t root;
    float b1[LMB_TILE_PIXELS], b2[LMB_TILE_PIXELS]; /* weights of its second and third corner */
    int is_mesh;
    float to_leaf[3][3]; /* from the triangle's weights to the leaf's */
    float corner[3][9];  /* light at the leaf's corners: R, G, B; of a mesh each along x, y, z */
} here;

/* --- corners ------------------------------------------------------------------------------------------------------ */

static void set_corners(here *h, uint32_t place)
{
    const lmb_transfer *t = h->transfer;
    const uint32_t *corner = t->section[LMB_TRANSFER_CORNERS] + LMB_TRANSFER_CORNER_WORDS * (size_t)place;
    h->is_mesh = place >= t->leaves;
    for (int k = 0; k < 3; ++k) {
        if (h->is_mesh) {
            transfer_blend(h->corner[k], h->light,
                           t->section[LMB_TRANSFER_BLENDS] + LMB_TRANSFER_BLEND_WORDS * (size_t)corner[k]);
        } else {
            memcpy(h->corner[k], h->light->receiver[corner[k]], 3 * sizeof h->corner[k][0]);
        }
    }
}

/* Down to the leaf that holds pixel k, with the matrix of all halvings on the way. 0 where it lies too deep. */
static int enter_leaf(here *h, int k)
{
    const uint32_t *node = h->transfer->section[LMB_TRANSFER_DIVISIONS];
    float w[3] = {1.0f - h->b1[k] - h->b2[k], h->b1[k], h->b2[k]};
    uint32_t at = h->root;
    memset(h->to_leaf, 0, sizeof h->to_leaf);
    h->to_leaf[0][0] = h->to_leaf[1][1] = h->to_leaf[2][2] = 1.0f;
    for (int i = 0; i < LMB_TRANSFER_MAX_HALVINGS && (node[at] & LMB_TRANSFER_LEAF) == 0; ++i) {
        const int from = (int)(node[at] >> LMB_TRANSFER_EDGE_BIT & 3u), to = from == 2 ? 0 : from + 1;
        const int keeps = w[from] >= w[to] ? from : to, moves = keeps == from ? to : from;
        for (int c = 0; c < 3; ++c) {
            h->to_leaf[keeps][c] -= h->to_leaf[moves][c];
            h->to_leaf[moves][c] *= 2.0f;
        }
        at = halving_enter(w, node[at]);
    }
    if ((node[at] & LMB_TRANSFER_LEAF) == 0) {
        return 0;
    }
    set_corners(h, node[at] & ~LMB_TRANSFER_LEAF);
    return 1;
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* 0 where nothing receives light. */
static int enter_triangle(here *h, const lmb_scene *scene, int k)
{
    const uint32_t id = h->tile->id[k];
    if (id > h->transfer->count[LMB_TRANSFER_SURFACES] || !transfer_triangle_of(&h->triangle, scene, id)) {
        return 0;
    }
    const lmb_vec3 face = vec3(h->tile->face[0][k], h->tile->face[1][k], h->tile->face[2][k]);
    const uint32_t back = dot3(h->triangle.normal, face) < 0.0f;
    h->root = h->transfer->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (id - 1) + 2 + back];
    return h->root != LMB_TRANSFER_NONE;
}

/* The weights of all pixels on the triangle's plane; those of other triangles mean nothing. */
static void set_weights(here *h)
{
    const lmb_vec3 o = h->triangle.corner, u = h->triangle.along[0], v = h->triangle.along[1];
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float x = h->tile->position[0][k] - o.x, y = h->tile->position[1][k] - o.y,
                    z = h->tile->position[2][k] - o.z;
        const float b1 = clampf(u.x * x + u.y * y + u.z * z, 0.0f, 1.0f);
        h->b1[k] = b1;
        h->b2[k] = clampf(v.x * x + v.y * y + v.z * z, 0.0f, 1.0f - b1);
    }
}

/* Of all pixels those on the leaf: where no corner's weight is under 0. One row of the matrix at a time. */
static uint64_t on_leaf(const here *h)
{
    float smallest[LMB_TILE_PIXELS];
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float b1 = h->b1[k], b2 = h->b2[k], b0 = 1.0f - b1 - b2;
        const float w0 = h->to_leaf[0][0] * b0 + h->to_leaf[0][1] * b1 + h->to_leaf[0][2] * b2;
        const float w1 = h->to_leaf[1][0] * b0 + h->to_leaf[1][1] * b1 + h->to_leaf[1][2] * b2;
        const float w2 = h->to_leaf[2][0] * b0 + h->to_leaf[2][1] * b1 + h->to_leaf[2][2] * b2;
        smallest[k] = minf(minf(w0, w1), w2);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out |= (uint64_t)(smallest[k] >= 0.0f) << k;
    }
    return out;
}

/* Light is linear on a leaf: the corners' light by the triangle's own weights. `each` numbers a corner. */
static void at_triangle(float out[3][9], const here *h, int each)
{
    for (int i = 0; i < 3; ++i) {
        for (int c = 0; c < each; ++c) {
            out[i][c] = h->to_leaf[0][i] * h->corner[0][c] + h->to_leaf[1][i] * h->corner[1][c] +
                        h->to_leaf[2][i] * h->corner[2][c];
        }
    }
}

/* Of a mesh what arrives along the pixel's normal; else the corners lie on its plane. */
static void light_pixels(lmb_irradiance *inout, const here *h, uint64_t pixels)
{
    float at[3][9];
    at_triangle(at, h, h->is_mesh ? 9 : 3);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const float b1 = h->b1[k], b2 = h->b2[k], b0 = 1.0f - b1 - b2;
        for (int c = 0; c < 3; ++c) {
            float e = h->is_mesh ? 0.0f : b0 * at[0][c] + b1 * at[1][c] + b2 * at[2][c];
            for (int a = 3 * c; h->is_mesh && a < 3 * c + 3; ++a) {
                e += h->tile->normal[a - 3 * c][k] * (b0 * at[0][a] + b1 * at[1][a] + b2 * at[2][a]);
            }
            inout->rgb[c][k] += maxf(e, 0.0f);
        }
    }
}

/* Of `left` the pixels of the first one's triangle, on the same side of it. */
static uint64_t alike(const lmb_tile *t, uint64_t left, int first)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float same =
            t->face[0][k] * t->face[0][first] + t->face[1][k] * t->face[1][first] + t->face[2][k] * t->face[2][first];
        out |= (uint64_t)(t->id[k] == t->id[first] && same > 0.0f) << k;
    }
    return (out & left) | (uint64_t)1 << first;
}

/* Leaf by leaf: that of the first pixel left lights all pixels on it. */
static void light_triangle(lmb_irradiance *inout, here *h, uint64_t pixels)
{
    set_weights(h);
    while (pixels != 0) {
        const int first = lowest_bit_64(pixels);
        uint64_t own = (uint64_t)1 << first;
        if (enter_leaf(h, first)) {
            own |= on_leaf(h) & pixels;
            light_pixels(inout, h, own);
        }
        pixels &= ~own;
    }
}

lmb_status lmb_transfer_tile(lmb_irradiance *inout, const lmb_transfer_light *light, const lmb_transfer *transfer,
                             const lmb_scene *scene, const lmb_tile *tile)
{
    here h;
    uint64_t left = 0;
    if (inout == NULL || light == NULL || light->receiver == NULL || transfer == NULL || transfer->section[0] == NULL ||
        scene == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    h.light = light;
    h.transfer = transfer;
    h.tile = tile;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        left |= (uint64_t)(tile->id[k] != 0) << k;
    }
    while (left != 0) {
        const int first = lowest_bit_64(left);
        const uint64_t own = alike(tile, left, first);
        if (enter_triangle(&h, scene, first)) {
            light_triangle(inout, &h, own);
        }
        left &= ~own;
    }
    return LMB_OK;
}

#endif
