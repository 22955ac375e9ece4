/* gbuffer.c: a band of the viewer's attributes as pixels, for hosts, --show and tests. Layer 4. */
#include <lambent/map.h>

#include <string.h>

#include "../base/exact.h"

static int is_surface(const lmb_surface *s, int32_t format, const lmb_view *view)
{
    return s == NULL || (s->data != NULL && s->format == format && s->width == view->frame_width &&
                         s->height == view->frame_height);
}

static void store(const lmb_surface *s, int32_t x, int32_t y, const float *a, const float *b, const float *c, int k)
{
    float *p = (float *)(void *)((uint8_t *)s->data + (ptrdiff_t)y * s->stride_bytes) + (b != NULL ? 3 * x : x);
    p[0] = a[k];
    if (b != NULL) {
        p[1] = b[k];
        p[2] = c[k];
    }
}

static void store_tile(const lmb_surface *depth, const lmb_surface *normal, const lmb_surface *albedo,
                       const lmb_view *v, const lmb_tile *t)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        int32_t x = t->x + k % LMB_TILE, y = t->y + k / LMB_TILE;
        if (x < v->frame_width && y < v->frame_height) {
            if (depth != NULL) {
                store(depth, x, y, t->depth, NULL, NULL, k);
            }
            if (normal != NULL) {
                store(normal, x, y, t->normal[0], t->normal[1], t->normal[2], k);
            }
            if (albedo != NULL) {
                store(albedo, x, y, t->albedo[0], t->albedo[1], t->albedo[2], k);
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
    for (int32_t x = target->x0; x < target->x0 + target->depth.width; x += LMB_TILE) {
        lmb_status status = depth == NULL && normal == NULL
                                ? lmb_resolve_albedo(tile, kernels, view, scene, target, x, band * LMB_TILE)
                                : lmb_resolve_tile(tile, kernels, view, scene, target, x, band * LMB_TILE);
        if (status != LMB_OK) {
            return status;
        }
        store_tile(depth, normal, albedo, view, tile);
    }
    return LMB_OK;
}
