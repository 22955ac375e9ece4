/* transfer_materials.c: mean albedo and emission of elements, from the scene's materials. Layer 7. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/poly.h"
#include "../tree/piece.h"
#include "halvings.h"

#if LMB_TRANSFER

enum { MAX_WAITING_HALVES = LMB_TRANSFER_MAX_HALVINGS + 1 }; /* pending second halves */

/* A part of a triangle: barycentrics of the corners, and share of the area. */
typedef struct material_part {
    float b1[3], b2[3], share;
    uint32_t node;
} material_part;

/* Corner k of the half moves to the point that divides the edge. */
static void enter_piece_half(material_part *p, const transfer_halving *h, int second)
{
    const int from = h->from, to = halving_to(from), k = second ? from : to;
    const float rest = 1.0f - h->part;
    const float b1 = rest * p->b1[from] + h->part * p->b1[to], b2 = rest * p->b2[from] + h->part * p->b2[to];
    p->b1[k] = b1;
    p->b2[k] = b2;
    p->share *= second ? rest : h->part;
    p->node = h->first + (uint32_t)second;
}

/* Adds area-weighted sums to light->albedo and emission, and areas to light->power[..][0]. */
static void add_part(const lmb_transfer_light *light, const piece_source *s, const material_part *p, uint32_t element)
{
    surface_piece piece;
    float albedo[3], emission[3];
    memset(&piece, 0, sizeof piece);
    memcpy(piece.b1, p->b1, sizeof piece.b1);
    memcpy(piece.b2, p->b2, sizeof piece.b2);
    const float standing = s->area * p->share * lmb_source_albedo(albedo, s, &piece, p->share);
    lmb_source_emission(emission, s, &piece);
    for (int c = 0; c < 3; ++c) {
        light->albedo[element][c] += standing * albedo[c];
        light->emission[element][c] += standing * emission[c];
    }
    light->power[element][0] += standing;
}

/* The largest part sets an element's position; ties go to the first. */
static void set_place(lmb_transfer_place *out, const piece_source *s, const material_part *p, float side)
{
    const lmb_vec3 *corner = s->triangle.corner;
    const float third = 1.0f / 3.0f;
    const float b1 = (p->b1[0] + p->b1[1] + p->b1[2]) * third, b2 = (p->b2[0] + p->b2[1] + p->b2[2]) * third;
    if (!(s->area * p->share > out->area)) {
        return;
    }
    out->area = s->area * p->share;
    out->normal = mul3(s->normal, side);
    out->position = add3(corner[0], add3(mul3(sub3(corner[1], corner[0]), b1), mul3(sub3(corner[2], corner[0]), b2)));
}

/* Adds all parts below a root; pending halves lie in `stack`. `left`: remaining visits over all roots. In damaged files
 * halves may share children, and then the number of paths explodes. */
static void add_piece_parts(const lmb_transfer_light *light, const lmb_transfer *t, const piece_source *s, int back,
                            uint32_t root, uint32_t *left)
{
    const uint32_t *node = t->section[LMB_TRANSFER_PIECES];
    material_part stack[MAX_WAITING_HALVES];
    int count = 1;
    memset(&stack[0], 0, sizeof stack[0]);
    stack[0].b1[1] = stack[0].b2[2] = stack[0].share = 1.0f;
    stack[0].node = root;
    while (count > 0 && *left > 0) {
        material_part here = stack[--count];
        --*left;
        while ((node[here.node] & LMB_TRANSFER_LEAF) == 0 && count < MAX_WAITING_HALVES) {
            const transfer_halving h = halving_of(t, node[here.node]);
            stack[count] = here;
            enter_piece_half(&stack[count++], &h, 1);
            enter_piece_half(&here, &h, 0);
        }
        if (node[here.node] & LMB_TRANSFER_LEAF) {
            const uint32_t element = node[here.node] & ~LMB_TRANSFER_LEAF;
            add_part(light, s, &here, element);
            if (light->place != NULL) {
                set_place(&light->place[element], s, &here, back ? -1.0f : 1.0f);
            }
        }
    }
}

static float area_of_element(const lmb_transfer *t, uint32_t element)
{
    float area;
    memcpy(&area, t->section[LMB_TRANSFER_AREAS] + element, sizeof area);
    return area;
}

/* Converts area-weighted sums to means. */
static void end_means(const lmb_transfer_light *light, const lmb_transfer *t)
{
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_AREAS]; ++i) {
        const float per = light->power[i][0] > 0.0f ? 1.0f / light->power[i][0] : 0.0f, area = area_of_element(t, i);
        for (int c = 0; c < 3; ++c) {
            light->albedo[i][c] = minf(light->albedo[i][c] * per, 1.0f);
            light->emission[i][c] = area > 0.0f ? minf(LMB_PI * light->emission[i][c] / area, 1e30f) : 0.0f;
        }
    }
}

static void set_coarse(const lmb_transfer_light *light, const lmb_transfer *t)
{
    const uint32_t count = t->count[LMB_TRANSFER_COARSE], *first = t->section[LMB_TRANSFER_COARSE];
    memset(light->coarse, 0, count * sizeof *light->coarse);
    for (uint32_t i = 0, e = 0; i < count; ++i) {
        lmb_transfer_coarse *coarse = &light->coarse[i];
        const uint32_t past =
            i + 1 < count ? first[LMB_TRANSFER_COARSE_WORDS * (size_t)(i + 1)] : t->count[LMB_TRANSFER_AREAS];
        for (; e < past; ++e) {
            const float area = area_of_element(t, e);
            coarse->area += area;
            for (int c = 0; c < 3; ++c) {
                coarse->albedo[c] += light->albedo[e][c] * area;
            }
        }
        const float per = coarse->area > 0.0f ? 1.0f / coarse->area : 0.0f;
        for (int c = 0; c < 3; ++c) {
            coarse->albedo[c] = minf(coarse->albedo[c] * per, 1.0f);
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
    memset(light->emission, 0, elements * sizeof *light->emission);
    memset(light->power, 0, elements * sizeof *light->power);
    if (light->place != NULL) {
        memset(light->place, 0, elements * sizeof *light->place);
    }
    for (uint32_t id = 1; id <= all; ++id) {
        piece_source s;
        const uint32_t *root = t->section[LMB_TRANSFER_SURFACES] + LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1);
        const int exists = lmb_source_open(&s, scene, id);
        for (int back = 0; back < 2 && exists; ++back) {
            if (root[back] != LMB_TRANSFER_NONE) {
                add_piece_parts(light, t, &s, back, root[back], &left);
            }
        }
    }
    end_means(light, t);
    set_coarse(light, t);
    memset(light->power, 0, elements * sizeof *light->power);
    return LMB_OK;
}

#endif
