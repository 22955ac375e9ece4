/* elements_many_lights.c: light of many lights on elements, which then send the first bounce. Layer 6. [V3] */
#include <lambent/elements.h>

#include <string.h>

#include "../base/vec.h"
#include "tree.h"

#if LMB_TREES

static lmb_status light_receiver_tile(const lmb_elements *e, const lmb_element_scratch *r,
                                      lmb_many_lights_scratch *scratch, const lmb_many_lights_query *query,
                                      uint32_t first)
{
    memset(r->fresh, 0, sizeof *r->fresh);
    lmb_elements_as_tile(r->tile, e, first, LMB_TILE_PIXELS);
    const lmb_status status = lmb_many_lights_direct_tile(r->fresh, r->kernels, scratch, r->tile, query);
    for (uint32_t k = 0; k < (uint32_t)r->tile->hits; ++k) {
        for (int c = 0; c < 3; ++c) {
            e->data[first + k].fresh[c] += r->fresh->rgb[c][k];
        }
    }
    return status;
}

lmb_status lmb_many_lights_elements(const lmb_elements *elements, const lmb_element_scratch *own_scratch,
                                    lmb_many_lights_scratch *scratch, const lmb_many_lights_query *query, int32_t first,
                                    int32_t past)
{
    lmb_status status = LMB_OK;
    lmb_many_lights_query own;
    if (elements == NULL || elements->data == NULL || elements->tree.element == NULL || own_scratch == NULL ||
        own_scratch->kernels == NULL || own_scratch->tile == NULL || own_scratch->fresh == NULL || scratch == NULL ||
        query == NULL || first < 0 || past < first || past > lmb_elements_tiles(elements)) {
        return LMB_ERR_ARG;
    }
    own = *query;
    own.each = 1; /* elements along a curve have no corner pixels */
    for (int32_t i = first; i < past && status == LMB_OK; ++i) {
        status = light_receiver_tile(elements, own_scratch, scratch, &own, (uint32_t)i * LMB_TILE_PIXELS);
    }
    return status;
}

lmb_status lmb_many_lights_elements_done(lmb_elements *inout)
{
    double area = 0.0, sent = 0.0;
    if (inout == NULL || inout->data == NULL || inout->tree.element == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = 0; i < inout->count; ++i) {
        const lmb_element *e = &inout->data[i];
        area += (double)e->area;
        for (int c = 0; c < 3; ++c) {
            sent += (double)(e->area * e->albedo[c] * e->fresh[c]);
        }
    }
    inout->level += area > 0.0 ? (float)(sent / area) : 0.0f;
    return LMB_OK;
}

#endif
