/* elements_live.c: elements as senders and receivers of single points' light. Layer 6.                          [ours]
 *
 * An element's flux is spread over the triangle: nearby, the tree divides the triangle into sixteen parts, and these
 * again. So later bounces and emitted light reach pixels and elements through one kernel, with one set of segments for
 * all light. */
#include <lambent/elements.h>

#include <string.h>

#include "../base/vec.h"
#include "../live/live_part.h"
#include "../raster/triangle.h"
#include "tree.h"
#include "piece.h"

#if LMB_LIVE

static void set_element_point(lmb_live_point *out, const lmb_element *e, const lmb_texel *t, uint32_t i)
{
    memset(out, 0, sizeof *out);
    out->position = t->position;
    out->normal = t->normal;
    memcpy(out->flux, t->flux, sizeof out->flux);
    out->area = e->area;
    out->id = e->id;
    out->column = (uint16_t)(i & 0xffffu);
    out->row = (uint16_t)(i >> 16);
    out->face = LMB_LIVE_ELEMENT;
    out->light = LMB_MAX_LIGHTS;
    out->shows = 0xffff;
}

lmb_status lmb_elements_live(lmb_live *inout, const lmb_elements *elements)
{
    if (inout == NULL || inout->point == NULL || elements == NULL || elements->data == NULL ||
        elements->tree.element == NULL) {
        return LMB_ERR_ARG;
    }
    if (elements->count > inout->element_cap) {
        return LMB_ERR_CAPACITY;
    }
    lmb_live_point *out = inout->point + live_slots(inout->face_cap, inout->side);
    for (uint32_t i = 0; i < elements->count; ++i) {
        set_element_point(&out[i], &elements->data[i], &elements->tree.texel[tree_along_z(&elements->tree, i)], i);
    }
    inout->element = elements->data;
    inout->elements = elements->count;
    return LMB_OK;
}

lmb_status lmb_elements_receive_live(const lmb_elements *elements, const lmb_kernels *kernels,
                                     lmb_live_scratch *scratch, const lmb_live *live, const lmb_bvh *bvh,
                                     int32_t first, int32_t past)
{
    lmb_status status = LMB_OK;
    if (elements == NULL || elements->data == NULL || elements->tree.element == NULL || first < 0 || past < first ||
        past > lmb_elements_tiles(elements)) {
        return LMB_ERR_ARG;
    }
    if (scratch != NULL) {
        lmb_live_forget(scratch);
    }
    for (uint32_t i = (uint32_t)first * LMB_TILE_PIXELS;
         i < (uint32_t)past * LMB_TILE_PIXELS && i < elements->count && status == LMB_OK; ++i) {
        const lmb_texel *t = &elements->tree.texel[tree_along_z(&elements->tree, i)];
        lmb_element *e = &elements->data[i];
        const lmb_live_receiver at = {t->position, t->normal, t->normal, e->id, lmb_place_noise(t->position, 1.0f),
                                      vec3(0, 0, 0), (float)(i * 5u % 9u) * (1.0f / 9.0f)};
        status = lmb_live_receive_again(e->fresh, kernels, scratch, live, bvh, &at);
    }
    return status;
}

lmb_status lmb_elements_rest_live(lmb_elements *inout, const lmb_live *live, int32_t bounces)
{
    return live == NULL ? LMB_ERR_ARG : lmb_elements_rest_of(inout, live->sent, bounces);
}

#endif
