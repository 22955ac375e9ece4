/* transfer_many_lights.c: light of many lights on elements, with the same cuts as pixels. Layer 7. [V3] */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/exact.h"
#include "links.h"

#if LMB_TRANSFER && LMB_TREES

/* Fills a tile with the elements, up to a tile's worth, that have a place. number[k]: the element of pixel k. */
static void set_element_tile(lmb_tile *tile, uint32_t number[LMB_TILE_PIXELS], const lmb_transfer_light *light,
                             uint32_t first, uint32_t past)
{
    memset(tile, 0, sizeof *tile);
    for (uint32_t i = first; i < past; ++i) {
        const lmb_transfer_place *p = &light->place[i];
        const float position[3] = {p->position.x, p->position.y, p->position.z};
        const float normal[3] = {p->normal.x, p->normal.y, p->normal.z};
        const int32_t k = tile->hits;
        if (!(p->area > 0.0f)) {
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            tile->position[c][k] = position[c];
            tile->normal[c][k] = tile->face[c][k] = normal[c];
        }
        tile->depth[k] = 1.0f;
        tile->id[k] = 1;
        number[k] = i;
        ++tile->hits;
    }
}

static lmb_status light_element_tile(const lmb_transfer_light *light, const lmb_transfer *t,
                                     const lmb_element_scratch *own, lmb_many_lights_scratch *scratch,
                                     const lmb_many_lights_query *query, uint32_t first)
{
    const uint32_t left = t->count[LMB_TRANSFER_AREAS] - first;
    uint32_t number[LMB_TILE_PIXELS];
    set_element_tile(own->tile, number, light, first, first + (left < LMB_TILE_PIXELS ? left : LMB_TILE_PIXELS));
    if (own->tile->hits == 0) {
        return LMB_OK;
    }
    memset(own->fresh, 0, sizeof *own->fresh);
    const lmb_status status = lmb_many_lights_direct_tile(own->fresh, own->kernels, scratch, own->tile, query);
    for (int32_t k = 0; k < own->tile->hits; ++k) {
        float area;
        memcpy(&area, t->section[LMB_TRANSFER_AREAS] + number[k], sizeof area);
        for (int c = 0; c < 3; ++c) {
            light->power[number[k]][c] += area * own->fresh->rgb[c][k];
        }
    }
    return status;
}

lmb_status lmb_transfer_many_lights(const lmb_transfer_light *light, const lmb_element_scratch *own_scratch,
                                    lmb_many_lights_scratch *scratch, const lmb_transfer *t,
                                    const lmb_many_lights_query *query, int32_t first, int32_t past)
{
    lmb_status status = LMB_OK;
    if (!transfer_is_laid_out(light, t) || light->place == NULL || own_scratch == NULL ||
        own_scratch->kernels == NULL || own_scratch->tile == NULL || own_scratch->fresh == NULL || scratch == NULL ||
        query == NULL || first < 0 || past < first || past > lmb_transfer_tiles(t)) {
        return LMB_ERR_ARG;
    }
    lmb_many_lights_query own = *query;
    own.each = 1; /* elements along a curve have no corner pixels */
    for (int32_t i = first; i < past && status == LMB_OK; ++i) {
        status = light_element_tile(light, t, own_scratch, scratch, &own, (uint32_t)i * LMB_TILE_PIXELS);
    }
    return status;
}

#endif
