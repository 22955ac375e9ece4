/* transfer_materials.c: the mean albedos of elements, from the scene's materials. Layer 9. */
#include <lambent/transfer.h>

#include <string.h>

#include "../radiosity/piece.h"

#if LMB_TRANSFER

enum { WAITING = 48 }; /* second halves on the way down: files have at most 40 halvings one in the other */

typedef struct waiting {
    surface_piece piece;
    uint32_t node;
} waiting;

/* One half of a piece: edge `from`'s middle in place of corner k. */
static void halve(surface_piece *p, int from, int k)
{
    const int to = from == 2 ? 0 : from + 1;
    const lmb_vec3 mid = mul3(add3(p->corner[from], p->corner[to]), 0.5f);
    const float b1 = 0.5f * (p->b1[from] + p->b1[to]), b2 = 0.5f * (p->b2[from] + p->b2[to]);
    p->corner[k] = mid;
    p->b1[k] = b1;
    p->b2[k] = b2;
}

/* Sums by area, in light->albedo; areas in light->power[..][0]. */
static void add_piece(const lmb_transfer_light *light, const piece_source *s, const surface_piece *p, uint32_t element)
{
    const float area = 0.5f * length3(piece_across(p->corner));
    float albedo[3];
    const float standing = area * lmb_source_albedo(albedo, s, p, area / s->area);
    for (int c = 0; c < 3; ++c) {
        light->albedo[element][c] += standing * albedo[c];
    }
    light->power[element][0] += standing;
}

/* All pieces below a root; the halves that wait lie in `stack`. `left`: how many there may be yet, over all roots: in
 * damaged files halves may share theirs, and ways down be more than anyone can go. */
static void add_pieces(const lmb_transfer_light *light, const lmb_transfer *t, const piece_source *s, uint32_t root,
                       uint32_t *left)
{
    const uint32_t *node = t->section[LMB_TRANSFER_PIECES];
    waiting stack[WAITING];
    int count = 1;
    memset(&stack[0], 0, sizeof stack[0]);
    memcpy(stack[0].piece.corner, s->triangle.corner, sizeof stack[0].piece.corner);
    stack[0].piece.b1[1] = stack[0].piece.b2[2] = 1.0f;
    stack[0].node = root;
    while (count > 0 && *left > 0) {
        waiting here = stack[--count];
        --*left;
        while ((node[here.node] & LMB_TRANSFER_LEAF) == 0 && count < WAITING) {
            const int from = (int)(node[here.node] >> LMB_TRANSFER_EDGE_BIT & 3u), to = from == 2 ? 0 : from + 1;
            const uint32_t first = node[here.node] & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
            stack[count] = here;
            halve(&stack[count].piece, from, from);
            stack[count++].node = first + 1;
            halve(&here.piece, from, to);
            here.node = first;
        }
        if (node[here.node] & LMB_TRANSFER_LEAF) {
            add_piece(light, s, &here.piece, node[here.node] & ~LMB_TRANSFER_LEAF);
        }
    }
}

lmb_status lmb_transfer_materials(const lmb_transfer_light *light, const lmb_transfer *t, const lmb_scene *scene)
{
    if (light == NULL || light->albedo == NULL || light->power == NULL || t == NULL ||
        t->section[0] == NULL || scene == NULL) {
        return LMB_ERR_ARG;
    }
    const uint32_t elements = t->count[LMB_TRANSFER_AREAS], all = t->count[LMB_TRANSFER_SURFACES];
    uint32_t left = t->count[LMB_TRANSFER_PIECES];
    memset(light->albedo, 0, elements * sizeof *light->albedo);
    memset(light->power, 0, elements * sizeof *light->power);
    for (uint32_t id = 1; id <= all; ++id) {
        piece_source s;
        const uint32_t *root = t->section[LMB_TRANSFER_SURFACES] + LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1);
        const int exists = lmb_source_open(&s, scene, id);
        for (int back = 0; back < 2 && exists; ++back) {
            if (root[back] != LMB_TRANSFER_NONE) {
                add_pieces(light, t, &s, root[back], &left);
            }
        }
    }
    for (uint32_t i = 0; i < elements; ++i) {
        const float per = light->power[i][0] > 0.0f ? 1.0f / light->power[i][0] : 0.0f;
        for (int c = 0; c < 3; ++c) {
            light->albedo[i][c] = minf(light->albedo[i][c] * per, 1.0f);
        }
    }
    memset(light->power, 0, elements * sizeof *light->power);
    return LMB_OK;
}

#endif
