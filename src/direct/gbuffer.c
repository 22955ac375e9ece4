/* gbuffer.c: a band of the viewer's attributes as pixels, for hosts, --show and tests. Layer 4. */
#include <lambent/map.h>

#include <string.h>

#include "../base/exact.h"

static int is_surface(const lmb_surface *s, int32_t format, const lmb_view *view)
{
    return s == NULL || (s->data != NULL && s->format == format && s->width == view->frame_width &&
                         s->height == view->frame_height);
}

/* Stores a tile's values in the pixels of `s`, as many for each as it has channels. */
static void store_channels(const lmb_surface *s, const float (*values)[LMB_TILE_PIXELS], int32_t channels,
                           const lmb_tile *t)
{
    for (int32_t k = 0; s != NULL && k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = t->x + k % LMB_TILE, y = t->y + k / LMB_TILE;
        if (x < s->width && y < s->height) {
            float *p = (float *)(void *)((uint8_t *)s->data + (ptrdiff_t)y * s->stride_bytes) + channels * x;
            for (int32_t c = 0; c < channels; ++c) {
                p[c] = values[c][k];
            }
        }
    }
}

lmb_status lmb_gbuffer_band(const lmb_surface *depth, const lmb_surface *normal, const lmb_surface *albedo,
                            const lmb_kernels *kernels, lmb_tile *tile, const lmb_view *view, const lmb_scene *scene,
                            const lmb_target *target, int32_t band)
{
    if (tile == NULL || kernels == NULL || view == NULL || scene == NULL || target == NULL || band < 0 ||
        band >= (view->frame_height + LMB_TILE - 1) / LMB_TILE) {
        return LMB_ERR_ARG;
    }
    if (!is_surface(depth, LMB_R32F, view) || !is_surface(normal, LMB_RGB32F, view) ||
        !is_surface(albedo, LMB_RGB32F, view)) {
        return LMB_ERR_FORMAT;
    }
    const lmb_tile *shown = tile;
    for (int32_t x = target->x0; x < target->x0 + target->depth.width; x += LMB_TILE) {
        lmb_status status = depth == NULL && normal == NULL
                                ? lmb_resolve_albedo(tile, kernels, view, scene, target, x, band * LMB_TILE)
                                : lmb_resolve_tile(tile, kernels, view, scene, target, x, band * LMB_TILE);
        if (status != LMB_OK) {
            return status;
        }
        store_channels(depth, &shown->depth, 1, shown);
        store_channels(normal, shown->normal, 3, shown);
        store_channels(albedo, shown->albedo, 3, shown);
    }
    return LMB_OK;
}
