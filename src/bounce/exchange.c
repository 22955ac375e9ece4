/* exchange.c: elements receive light by the same cuts as pixels, and send it on. Floor 6. */
#include <lambent/elements.h>

#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "tree.h"

int32_t lmb_elements_tiles(const lmb_elements *elements)
{
    return elements == NULL ? 0 : (int32_t)((elements->count + LMB_TILE_PIXELS - 1) / LMB_TILE_PIXELS);
}

/* 64 elements as if they were a tile's pixels. */
static void set_tile(lmb_tile *tile, const lmb_elements *e, uint32_t first)
{
    memset(tile, 0, sizeof *tile);
    for (uint32_t k = 0; k < LMB_TILE_PIXELS && first + k < e->count; ++k) {
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

static lmb_status receive_tile(const lmb_elements *e, const lmb_kernels *kernels, lmb_cut *scratch, lmb_tile *tile,
                               const lmb_tree *lights, lmb_cutting cutting, uint32_t first)
{
    lmb_irradiance received, fresh;
    lmb_status status = LMB_OK;
    memset(&received, 0, sizeof received);
    memset(&fresh, 0, sizeof fresh);
    set_tile(tile, e, first);
    for (int32_t k = 0; k < tile->hits; ++k) {
        for (int c = 0; c < 3; ++c) {
            received.rgb[c][k] = e->data[first + (uint32_t)k].received[c];
        }
    }
    cutting.least = e->level;
    cutting.beside = &received;
    if (lights != NULL) {
        status = lmb_gather_cut(&fresh, kernels, scratch, tile, lights, &cutting);
        cutting.beside = &fresh; /* with lights: the first bounce, when nothing was received before */
    }
    if (status == LMB_OK) {
        status = lmb_gather_cut(&fresh, kernels, scratch, tile, &e->tree, &cutting);
    }
    for (int32_t k = 0; k < tile->hits; ++k) {
        for (int c = 0; c < 3; ++c) {
            e->data[first + (uint32_t)k].fresh[c] = fresh.rgb[c][k];
        }
    }
    return status;
}

lmb_status lmb_elements_receive(const lmb_elements *elements, const lmb_kernels *kernels, lmb_cut *scratch,
                                lmb_tile *tile, const lmb_tree *lights, const lmb_cutting *cutting, int32_t first,
                                int32_t past)
{
    lmb_status status = LMB_OK;
    if (elements == NULL || elements->data == NULL || elements->tree.element == NULL || kernels == NULL ||
        scratch == NULL || tile == NULL || cutting == NULL || first < 0 || past > lmb_elements_tiles(elements)) {
        return LMB_ERR_ARG;
    }
    for (int32_t i = first; i < past && status == LMB_OK; ++i) {
        status = receive_tile(elements, kernels, scratch, tile, lights, *cutting, (uint32_t)i * LMB_TILE_PIXELS);
    }
    return status;
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
            t->flux[c] = e->albedo[c] * e->area * (last ? e->received[c] : e->fresh[c]);
            t->flux[c] += last ? LMB_PI * e->area * e->emission[c] : 0.0f;
        }
    }
    return lmb_tree_sum(&inout->tree, 0);
}
