/* target.c: memory layout of a window's tiles, and 16-bit depth codes. Layer 3. */
#include "target.h"

#include "../base/surface_check.h"
#include "../base/vec.h"

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

static void cut_rows(lmb_surface *s, int32_t first, int32_t count)
{
    const int32_t left = s->height - first * LMB_TILE;
    s->data = tile_address(s, 0, first, 0);
    s->height = left < count * LMB_TILE ? left : count * LMB_TILE;
}

void lmb_target_rows(lmb_target *out, const lmb_target *target, int32_t first, int32_t count)
{
    *out = *target;
    out->y0 += first * LMB_TILE;
    cut_rows(&out->depth, first, count);
    if (out->id.data != NULL) {
        cut_rows(&out->id, first, count);
    }
}

lmb_fill_window lmb_target_window(const lmb_target *t, const lmb_view *view)
{
    const int32_t depth_bytes = lmb_pixel_bytes(t->depth.format), id_bytes = lmb_pixel_bytes(t->id.format);
    const int tiled_depth = t->depth.layout == LMB_TILED, tiled_id = t->id.layout == LMB_TILED;
    lmb_fill_window w;
    w.first = lmb_target_tile(t, 0, 0);
    w.depth_tile = depth_bytes * (tiled_depth ? LMB_TILE_PIXELS : LMB_TILE);
    w.depth_row = t->depth.stride_bytes * (tiled_depth ? 1 : LMB_TILE);
    w.id_tile = id_bytes * (tiled_id ? LMB_TILE_PIXELS : LMB_TILE);
    w.id_row = t->id.stride_bytes * (tiled_id ? 1 : LMB_TILE);
    w.tiles_x = (t->depth.width + LMB_TILE - 1) / LMB_TILE;
    w.tiles_y = (t->depth.height + LMB_TILE - 1) / LMB_TILE;
    w.x0 = t->x0;
    w.y0 = t->y0;
    w.origin_x = view_origin_x(view);
    w.origin_y = view_origin_y(view);
    w.d_scale = w.d_bias = 0.0f;
#if LMB_CULLING
    w.farthest = NULL;
    w.bounds = LMB_BOUNDS_IDLE;
#endif
    if (t->depth.format == LMB_DEPTH16) {
        lmb_depth16_coding(&w.d_scale, &w.d_bias, view);
    }
    return w;
}

NOINLINE int is_unit(lmb_vec3 v)
{
    float d2 = dot3(v, v);
    return d2 > 0.99f && d2 < 1.01f;
}

/* So that 1 / length is finite. */
#define MIN_M 1e-30f

/* -128 .. 127; in builds with one sample a pixel, 0: the centre. */
static int is_in_pixel(int32_t sample)
{
    return LMB_MULTISAMPLE ? (uint32_t)sample + 128u < 256u : sample == 0;
}

int lmb_view_is_valid(const lmb_view *v)
{
    return v->half_width > MIN_M && v->half_height > MIN_M && v->half_width < 1e30f && v->half_height < 1e30f &&
           (v->near_m > MIN_M || (v->kind == LMB_ORTHOGRAPHIC && v->near_m < -MIN_M)) && is_unit(v->right) &&
           is_unit(v->up) && is_unit(v->back) && is_place(v->eye) &&
           v->frame_width > 0 && v->frame_height > 0 && v->frame_width <= LMB_MAX_FRAME &&
           v->frame_height <= LMB_MAX_FRAME && is_in_pixel(v->sample_x) && is_in_pixel(v->sample_y) &&
           (v->kind == LMB_PERSPECTIVE || (v->kind == LMB_ORTHOGRAPHIC && v->far_m > v->near_m));
}

/* 1 if the window consists of whole tiles inside the frame, except that the last tiles may extend past it. */
static int is_window(const lmb_target *t, const lmb_view *view)
{
    return t->x0 >= 0 && t->y0 >= 0 && t->x0 % LMB_TILE == 0 && t->y0 % LMB_TILE == 0 &&
           t->x0 <= view->frame_width + LMB_TILE - 1 - t->depth.width &&
           t->y0 <= view->frame_height + LMB_TILE - 1 - t->depth.height;
}

static lmb_status check_ids(const lmb_target *t, uint32_t triangles)
{
    if (t->id.format != LMB_ID16 && t->id.format != LMB_ID32) {
        return LMB_ERR_FORMAT;
    }
    if (!lmb_surface_is_valid(&t->id) || t->id.width != t->depth.width || t->id.height != t->depth.height) {
        return LMB_ERR_ARG;
    }
    return t->id.format == LMB_ID16 && triangles > 65535u ? LMB_ERR_CAPACITY : LMB_OK;
}

lmb_status lmb_target_check(const lmb_target *t, const lmb_view *view, uint32_t triangles)
{
    const lmb_surface *d = &t->depth;
    if (!lmb_view_is_valid(view) || d->data == NULL) {
        return LMB_ERR_ARG;
    }
    if ((d->format != LMB_DEPTH32F && d->format != LMB_DEPTH16) ||
        (d->format == LMB_DEPTH16 && !(view->far_m > view->near_m))) {
        return LMB_ERR_FORMAT;
    }
    if (!lmb_surface_is_valid(d) || !is_window(t, view)) {
        return LMB_ERR_ARG;
    }
    return t->id.data != NULL ? check_ids(t, triangles) : LMB_OK;
}
