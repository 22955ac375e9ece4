/* radiosity_bounce.c: elements receive light through the same cuts as pixels, and reflect it. Layer 6. */
#include <lambent/elements.h>

#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "tree.h"
#include "piece.h"

#if LMB_TREES

static uint32_t minu(uint32_t a, uint32_t b) { return a < b ? a : b; }

int32_t lmb_elements_tiles(const lmb_elements *elements)
{
    return elements == NULL ? 0 : (int32_t)((elements->count + LMB_TILE_PIXELS - 1) / LMB_TILE_PIXELS);
}

/* --- groups of receivers --------------------------------------------------------------------------------------------
 *
 * Elements that share a cut should lie close together: the cut is refined for the nearest of them, and segments to
 * distant ones traverse everything between. Seconds per bounce with groups of 4, 16, 64: Cornell 0.5, 0.32, 0.36;
 * bunny_room, where the curve jumps from walls to the bunny, 1.1, 2.9, 6.6. So a group has 16 elements if these are a
 * compact piece of surface, otherwise 4. */

enum { MANY_TOGETHER = 16, FEW_TOGETHER = 4 };
#define MAX_COMPACT_DIAGONAL2 8.0f /* max squared diagonal of their box / area: 2 for a square, 4.25 for 4 x 1 */

static int are_compact(const lmb_elements *e, uint32_t first, uint32_t count)
{
    const lmb_vec3 at = e->data[first].corner[0];
    float low[3] = {at.x, at.y, at.z}, high[3] = {at.x, at.y, at.z}, area = 0.0f, diagonal2 = 0.0f;
    for (uint32_t i = first; i < first + count && i < e->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const float p[3] = {e->data[i].corner[k].x, e->data[i].corner[k].y, e->data[i].corner[k].z};
            for (int c = 0; c < 3; ++c) {
                low[c] = minf(low[c], p[c]);
                high[c] = maxf(high[c], p[c]);
            }
        }
        area += e->data[i].area;
    }
    for (int c = 0; c < 3; ++c) {
        diagonal2 += (high[c] - low[c]) * (high[c] - low[c]);
    }
    return diagonal2 <= MAX_COMPACT_DIAGONAL2 * area;
}

void lmb_elements_as_tile(lmb_tile *tile, const lmb_elements *e, uint32_t first, uint32_t count)
{
    memset(tile, 0, sizeof *tile);
    for (uint32_t k = 0; k < count && first + k < e->count; ++k) {
        const lmb_texel *t = &e->tree.texel[tree_along_z(&e->tree, first + k)];
        const float position[3] = {t->position.x, t->position.y, t->position.z};
        const float normal[3] = {t->normal.x, t->normal.y, t->normal.z};
        for (int c = 0; c < 3; ++c) {
            tile->position[c][k] = position[c];
            tile->normal[c][k] = tile->face[c][k] = normal[c];
        }
        tile->depth[k] = 1.0f;
        tile->id[k] = 1;
        ++tile->hits;
    }
}

/* --- a bounce ----------------------------------------------------------------------------------------------------- */

static lmb_status receive_tile(const lmb_elements *e, const lmb_element_scratch *r, const lmb_tree *lights,
                               lmb_cut_params cut_params, uint32_t first, uint32_t count)
{
    lmb_status status = LMB_OK;
    memset(r->received, 0, sizeof *r->received);
    memset(r->fresh, 0, sizeof *r->fresh);
    lmb_elements_as_tile(r->tile, e, first, count);
    for (int32_t k = 0; k < r->tile->hits; ++k) {
        for (int c = 0; c < 3; ++c) {
            r->received->rgb[c][k] = e->data[first + (uint32_t)k].received[c];
        }
    }
    cut_params.lower = e->level;
    cut_params.beside = r->received;
    if (lights != NULL) {
        status = lmb_gather_cut(r->fresh, r->kernels, r->cut, r->tile, lights, &cut_params);
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            r->received->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] +=
                r->fresh->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
        }
    }
    if (status == LMB_OK) {
        status = lmb_gather_cut(r->fresh, r->kernels, r->cut, r->tile, &e->tree, &cut_params);
    }
    for (int32_t k = 0; k < r->tile->hits; ++k) {
        for (int c = 0; c < 3; ++c) {
            e->data[first + (uint32_t)k].fresh[c] = r->fresh->rgb[c][k];
        }
    }
    return status;
}

static int is_ready(const lmb_element_scratch *r)
{
    return r != NULL && r->kernels != NULL && r->cut != NULL && r->tile != NULL && r->received != NULL &&
           r->fresh != NULL;
}

lmb_status lmb_elements_receive(const lmb_elements *elements, const lmb_element_scratch *own_scratch,
                                const lmb_tree *lights, const lmb_cut_params *cut_params, int32_t first, int32_t past)
{
    lmb_status status = LMB_OK;
    if (elements == NULL || elements->data == NULL || elements->tree.element == NULL || !is_ready(own_scratch) ||
        cut_params == NULL || first < 0 || past < first || past > lmb_elements_tiles(elements)) {
        return LMB_ERR_ARG;
    }
    const uint32_t end = minu((uint32_t)past * LMB_TILE_PIXELS, elements->count);
    for (uint32_t i = (uint32_t)first * LMB_TILE_PIXELS; i < end && status == LMB_OK;) {
        const uint32_t count =
            i % MANY_TOGETHER == 0 && are_compact(elements, i, MANY_TOGETHER) ? MANY_TOGETHER : FEW_TOGETHER;
        status = receive_tile(elements, own_scratch, lights, *cut_params, i, count);
        i += count;
    }
    return status;
}

/* --- the bounces that would follow -------------------------------------------------------------------------------- */

/* Flux of a channel that the shadow maps send, W. */
static double sent_by(const lmb_tree *lights, int channel)
{
    double sum = 0.0;
    for (uint32_t f = 0; lights != NULL && f < lights->faces; ++f) {
        sum += (double)tree_level(lights, f, tree_root_level(lights))->flux[channel];
    }
    return sum;
}

/* Share of a channel's light that survived the last bounce. With B before and B' after the bounce, light between
 * elements gives sum of A B' B' / sum of A B' B. It weights each element by the light still there, because light that
 * left into the open does not represent the rest. Light from maps has no position among the elements; then the ratio is
 * the total reflected over the total received. */
static double kept_by_elements(const lmb_elements *e, double by_lights, int channel)
{
    double kept = 0.0, before = 0.0;
    for (uint32_t i = 0; i < e->count; ++i) {
        const lmb_element *p = &e->data[i];
        const double sent = (double)(p->albedo[channel] * p->fresh[channel]), area = (double)p->area,
                     came = (double)e->tree.texel[tree_along_z(&e->tree, i)].flux[channel];
        kept += by_lights > 0.0 ? area * sent : area * sent * sent;
        before += by_lights > 0.0 ? came : sent * came;
    }
    before += by_lights;
    return kept >= before ? (before > 0.0 ? 1.0 : 0.0) : kept / before;
}

/* r + r^2 + .. + r^count. */
static float powers(double r, int32_t count)
{
    double sum = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        sum = (sum + 1.0) * r;
    }
    return (float)sum;
}

lmb_status lmb_elements_rest_of(lmb_elements *inout, const double sent[3], int32_t bounces)
{
    if (inout == NULL || inout->data == NULL || inout->tree.element == NULL || bounces < 0 ||
        bounces > LMB_MAX_BOUNCES) {
        return LMB_ERR_ARG;
    }
    for (int c = 0; c < 3; ++c) {
        const float more = powers(kept_by_elements(inout, sent[c], c), bounces);
        for (uint32_t i = 0; i < inout->count; ++i) {
            inout->data[i].fresh[c] *= 1.0f + more;
        }
    }
    return LMB_OK;
}

lmb_status lmb_elements_rest(lmb_elements *inout, const lmb_tree *lights, int32_t bounces)
{
    const double sent[3] = {sent_by(lights, 0), sent_by(lights, 1), sent_by(lights, 2)};
    return lmb_elements_rest_of(inout, sent, bounces);
}

lmb_status lmb_elements_send(lmb_elements *inout, int32_t last)
{
    if (inout == NULL || inout->data == NULL || inout->tree.element == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = 0; i < inout->count; ++i) {
        lmb_element *e = &inout->data[i];
        lmb_texel *t = &inout->tree.texel[tree_along_z(&inout->tree, i)];
        for (int c = 0; c < 3; ++c) {
            e->received[c] += e->fresh[c];
            const float sent = e->albedo[c] * e->area * (last ? e->received[c] : e->fresh[c]);
            t->flux[c] = flux_or_none(sent + (last ? LMB_PI * e->area * e->emission[c] : 0.0f));
        }
    }
    return lmb_tree_sum(&inout->tree, 0);
}

#endif
