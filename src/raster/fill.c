/* fill.c: a set-up triangle with holes into the tiles of a window. Floor 3.
 *
 * Tiles are out, partly covered or wholly inside each edge by the edge's value at the tile's corners. An edge that
 * the whole tile lies inside of is left out of the kernel (its sums become 0), which also keeps the kernel's sums in
 * 32 bits. Depth is taken at each tile's first pixel in binary64, so windows and tile order change nothing. */
#include "fill.h"

#include <string.h>

#include "resolve.h"
#include "target.h"

/* A tile's own copy, for the masked path. */
typedef struct tile_copy {
    union {
        float f32[LMB_TILE_PIXELS];
        uint16_t u16[LMB_TILE_PIXELS];
    } depth;
    union {
        uint32_t u32[LMB_TILE_PIXELS];
        uint16_t u16[LMB_TILE_PIXELS];
    } id;
} tile_copy;

static void copy_rows(void *to, int32_t to_step, const void *from, int32_t from_step, int32_t bytes)
{
    for (int y = 0; y < LMB_TILE; ++y) {
        memcpy((uint8_t *)to + (ptrdiff_t)y * to_step * bytes, (const uint8_t *)from + (ptrdiff_t)y * from_step * bytes,
               (size_t)(LMB_TILE * bytes));
    }
}

/* The triangle's own surface, and the rays of the tile at hand. */
typedef struct masked_surface {
    lmb_rays rays;
    lmb_plane plane;
    lmb_resolve_alpha alpha;
} masked_surface;

/* At pixel k of the tile: surface, or a hole? */
static int stands_at(const masked_surface *s, const lmb_scene *scene, int k)
{
    float b1, b2;
    lmb_resolve_point(&b1, &b2, &s->plane, &s->rays, (float)(k % LMB_TILE), (float)(k / LMB_TILE));
    return lmb_resolve_opaque(&s->alpha, scene, b1, b2);
}

/* Fill a copy of the tile, then keep only the changed pixels whose alpha passes. Opaque scenes never come here. */
static void fill_tile_masked(const lmb_fill_context *c, const lmb_fill_tile *tile, const lmb_fill_job *job,
                             const masked_surface *s)
{
    tile_copy copy;
    lmb_fill_tile aside = *tile;
    int32_t bytes = tile->depth_format == LMB_DEPTH16 ? 2 : 4, id_bytes = tile->id_format == LMB_ID16 ? 2 : 4;
    aside.depth = &copy.depth;
    aside.depth_step = LMB_TILE;
    copy_rows(&copy.depth, LMB_TILE, tile->depth, tile->depth_step, bytes);
    if (tile->id != NULL) {
        aside.id = &copy.id;
        aside.id_step = LMB_TILE;
        copy_rows(&copy.id, LMB_TILE, tile->id, tile->id_step, id_bytes);
    }
    c->kernels->fill(&aside, job);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        uint8_t *was = (uint8_t *)tile->depth + ((k / LMB_TILE) * tile->depth_step + k % LMB_TILE) * bytes;
        const uint8_t *now = (const uint8_t *)&copy.depth + k * bytes;
        if (memcmp(was, now, (size_t)bytes) != 0 && stands_at(s, c->scene, k)) {
            memcpy(was, now, (size_t)bytes);
            if (tile->id != NULL) {
                memcpy((uint8_t *)tile->id + ((k / LMB_TILE) * tile->id_step + k % LMB_TILE) * id_bytes,
                       (const uint8_t *)&copy.id + k * id_bytes, (size_t)id_bytes);
            }
        }
    }
}

/* 1 and the job's edges, or 0 where the tile lies outside one. e is each edge at the tile's first pixel. */
static int enter_tile(lmb_fill_job *job, const lmb_setup *s, const int64_t e[3])
{
    const int64_t reach = LMB_TILE - 1;
    for (int i = 0; i < 3; ++i) {
        int64_t ex = s->ex[i], ey = s->ey[i];
        int64_t low = e[i] + reach * ((ex < 0 ? ex : 0) + (ey < 0 ? ey : 0));
        int64_t high = e[i] + reach * ((ex > 0 ? ex : 0) + (ey > 0 ? ey : 0));
        if (high < 0) {
            return 0;
        }
        job->e[i] = low >= 0 ? 0 : (int32_t)e[i];
        job->ex[i] = low >= 0 ? 0 : s->ex[i];
        job->ey[i] = low >= 0 ? 0 : s->ey[i];
    }
    return 1;
}

/* First and last tile, inside the window, of a box in 24.8 from the frame's middle. */
static void tile_span(int32_t *first, int32_t *last, int32_t low_24_8, int32_t high_24_8, int32_t frame, int32_t origin,
                      int32_t size)
{
    int32_t low_px = ((low_24_8 + frame * 128) >> 8) - origin, high_px = ((high_24_8 + frame * 128) >> 8) - origin;
    *first = maxi(low_px, 0) >> 3;
    *last = mini(high_px, size - 1) >> 3; /* -1 >> 3 is -1: nothing */
}

void lmb_fill_masked(const lmb_fill_context *c, const lmb_setup *s, uint32_t id)
{
    const lmb_target *target = c->target;
    int32_t tx0, tx1, ty0, ty1;
    lmb_fill_job job;
    lmb_triangle triangle;
    masked_surface surface;
    if (!lmb_triangle_fetch(&triangle, c->scene, id)) {
        return;
    }
    lmb_resolve_rays(&surface.rays, c->view, target->x0, target->y0);
    lmb_resolve_plane(&surface.plane, triangle.corner, &surface.rays);
    lmb_resolve_alpha_of(&surface.alpha, &triangle);
    tile_span(&tx0, &tx1, s->x_min, s->x_max, c->view->frame_width, target->x0, target->depth.width);
    tile_span(&ty0, &ty1, s->y_min, s->y_max, c->view->frame_height, target->y0, target->depth.height);
    job.dx = (float)s->d_x;
    job.dy = (float)s->d_y;
    job.d_min = s->d_min;
    job.d_max = s->d_max;
    job.d_scale = c->window.d_scale;
    job.d_bias = c->window.d_bias;
    job.id = id;
    for (int32_t ty = ty0; ty <= ty1; ++ty) {
        int32_t y = target->y0 + ty * LMB_TILE, y_24_8 = y * 256 + 128 - c->view->frame_height * 128;
        int32_t x = target->x0 + tx0 * LMB_TILE, x_24_8 = x * 256 + 128 - c->view->frame_width * 128;
        int64_t e[3];
        for (int i = 0; i < 3; ++i) {
            e[i] = setup_edge(s, i, x_24_8, y_24_8);
        }
        for (int32_t tx = tx0; tx <= tx1; ++tx, x_24_8 += LMB_TILE * 256) {
            if (enter_tile(&job, s, e)) {
                lmb_fill_tile tile = lmb_target_tile(target, tx, ty);
                job.d = (float)(s->d_origin + s->d_x * (x_24_8 * (1.0 / 256.0)) + s->d_y * (y_24_8 * (1.0 / 256.0)));
                lmb_resolve_rays(&surface.rays, c->view, target->x0 + tx * LMB_TILE, y);
                fill_tile_masked(c, &tile, &job, &surface);
            }
            for (int i = 0; i < 3; ++i) {
                e[i] += (int64_t)s->ex[i] * LMB_TILE;
            }
        }
    }
}
