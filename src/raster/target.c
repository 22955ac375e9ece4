/* target.c: where a window's tiles lie in memory, and how 16 bits code depth. Floor 3. */
#include "target.h"

void lmb_depth16_coding(float *scale, float *bias, const lmb_view *view)
{
    float d_far = view->kind == LMB_PERSPECTIVE ? view->near_m / view->far_m : 0.0f;
    *scale = 65534.0f / (1.0f - d_far);
    *bias = 1.0f - d_far * *scale;
}

static void *tile_address(const lmb_surface *s, int32_t tile_x, int32_t tile_y, int32_t bytes)
{
    uint8_t *data = (uint8_t *)s->data;
    return s->layout == LMB_TILED
               ? data + (ptrdiff_t)tile_y * s->stride_bytes + (ptrdiff_t)tile_x * LMB_TILE_PIXELS * bytes
               : data + (ptrdiff_t)tile_y * LMB_TILE * s->stride_bytes + (ptrdiff_t)tile_x * LMB_TILE * bytes;
}

lmb_fill_tile lmb_target_tile(const lmb_target *target, int32_t tile_x, int32_t tile_y)
{
    lmb_fill_tile t;
    int32_t depth_bytes = lmb_pixel_bytes(target->depth.format), id_bytes = lmb_pixel_bytes(target->id.format);
    t.depth = tile_address(&target->depth, tile_x, tile_y, depth_bytes);
    t.depth_step = target->depth.layout == LMB_TILED ? LMB_TILE : target->depth.stride_bytes / depth_bytes;
    t.depth_format = target->depth.format;
    t.id = NULL;
    t.id_step = 0;
    t.id_format = LMB_FORMAT_NONE;
    if (target->id.data != NULL) {
        t.id = tile_address(&target->id, tile_x, tile_y, id_bytes);
        t.id_step = target->id.layout == LMB_TILED ? LMB_TILE : target->id.stride_bytes / id_bytes;
        t.id_format = target->id.format;
    }
    return t;
}
