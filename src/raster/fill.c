/* fill.c: fills the tiles of a window with a set-up triangle that has holes. Layer 3.
 *
 * The value of an edge at the corners of a tile shows whether the tile is outside, partly covered or inside. If the
 * whole tile is inside an edge, the edge is dropped (its sums become 0), which also keeps the sums over the tile in 32
 * bits. Depth is computed in binary64 at each tile's first pixel, so results do not depend on windows or the order of
 * tiles. */
#include "fill.h"

#include "plane.h"
#include "resolve.h"
#include "target.h"
#include "texels.h"
#include "texture.h"

/* Max texels read per pixel of a triangle's tiles, to test whether it is all hole; FEW_TEXELS: if a kernel fills it. */
#define MAX_TEXELS_A_TILE   8u
#define FEW_TEXELS 2u
#define MIN_BLEND_THRESHOLD (1.0f / 512.0f) /* thresholds of a surface that blends: min and max */
#define MAX_BLEND_THRESHOLD (511.0f / 512.0f)
#define MIN_PLANE_SLOPE     0.05f /* least of a tile's slopes, of the largest, to test all pixels at once */
#define BARYCENTRIC_MARGIN  (1.0f / 64.0f) /* part of the barycentrics of a tile or block, for rounding */

/* Depths that draw_ahead stores are less than those of the main draw, by a factor or by codes of 16 bits. Depths are
 * normal numbers (over 1e-36 in perspective), so the factor always lowers them. */
#define FACTOR_BEHIND (1.0f - 1.0f / 4194304.0f)
#define CODES_BEHIND  2.0f
#define MIN_TILES_AHEAD 8 /* triangles of fewer tiles are not drawn ahead */

#define ALPHA_MARGIN 1.001f /* of alpha, for rounding of samples, of their weights and of codes */

/* Max texels read to test whether a tile is all hole or all solid. Its 64 pixels read 256. */
#define TILE_TEXELS 128u

/* Blocks of tiles are tested at once, then halved. Triangles of fewer than MIN_BLOCK_TILES have none. */
enum { BLOCK_COLUMNS = 8, BLOCK_ROWS = 4, BLOCK_HALVINGS = 4, MIN_BLOCK_TILES = 8 };
#define BLOCK_TEXELS 1024u /* max texels read for one block */

/* A miss is a block that is neither hole nor solid. If a triangle has used up its misses, no block is halved. */
enum {
    MIN_MISSES = 2,
    MISS_TILES = 64,  /* tiles of the triangle that allow one more miss */
    EARNED_TILES = 4, /* tiles in hole or solid blocks that allow one more miss */
    WHOLE_MISSES = 3  /* further misses until blocks are not tested either */
};

/* Pieces of the current tile that need no test of single pixels. Before the first pixel passes the depth test the tile
 * is not examined. */
enum { COVERS_SOME = 0, COVERS_UNKNOWN = 4 };

/* The triangle's surface, and the rays of the current tile. */
typedef struct masked_surface {
#if LMB_TREES
    lmb_masked_job job; /* whole if `batches`; otherwise only `behind` is set */
    int16_t batches;    /* 1: the kernels fill whole tiles */
    int16_t luck;       /* whether tests of texels by pairs of rows paid so far */
    int misses;         /* blocks that may still be neither hole nor solid before no more are tested */
#endif
    lmb_rays rays;
    lmb_plane plane;
    lmb_resolve_alpha alpha;
    int blends;
    uint32_t id;
    int32_t x, y; /* of the current tile, px */
    const lmb_texture *texture; /* RGBA8, or NULL */
    int part; /* of the current tile: COVERS_SOME, COVERS_UNKNOWN, LMB_COVERS_NONE or LMB_COVERS_ALL */
} masked_surface;

#if LMB_MULTISAMPLE
/* A 32-bit hash of a surface and a square of pixels. */
static uint32_t hash_square(uint32_t own, uint32_t x, uint32_t y)
{
    const uint32_t place = x * 2246822519u + y * 3266489917u;
    uint32_t h = (own ^ place) * 668265263u;
    h = (h ^ h >> 15) * 2246822519u;
    return h ^ h >> 13;
}

/* The rank of a pixel among 64, from the ranks of its quarters in the squares of 8 x 8, 4 x 4 and 2 x 2. The smallest
 * square counts most, as in Bayer's matrix. Each surface has its own order of the quarters of each square, so each
 * surface fills every square evenly, and surfaces in front of each other are independent. With equal or shifted ranks,
 * three layers of 0.25 would cover 0.25 to 0.75 instead of 0.58. */
static uint32_t rank_of(uint32_t own, uint32_t x, uint32_t y)
{
    uint32_t rank = 0;
    for (int bit = 2; bit >= 0; --bit) {
        const uint32_t right = x >> bit & 1u, low = y >> bit & 1u, quarter = (right ^ low) << 1 | low;
        const uint32_t order = hash_square(own + (uint32_t)bit, x >> (bit + 1), y >> (bit + 1)) >> 30;
        rank |= (quarter ^ order) << (4 - 2 * bit);
    }
    return rank;
}

/* Least alpha at which pixel (x, y) of the tile shows a surface that blends: 1/512 .. 511/512.
 *
 * The samples of a pixel lie in different columns, one in each of as many strips as there are samples, and so do their
 * thresholds. With several samples, each pixel also has its own start and its own step through the strips, because two
 * surfaces that both show in a run of strips would overlap by any amount. */
static float threshold(const masked_surface *s, const lmb_view *v, int32_t x, int32_t y)
{
    const uint32_t own = s->id * 2654435761u, px = (uint32_t)(s->x + x), py = (uint32_t)(s->y + y);
    const uint32_t way = (v->sample_x | v->sample_y) != 0 ? hash_square(own + 3, px, py) : 0;
    const uint32_t quarter = way >> 30, step = way >> 26 & 14u, column = (uint32_t)(v->sample_x + 128); /* step: - 1 */
    const uint32_t part = hash_square(own + 4, px >> 3, py >> 3) >> 30; /* of a rank; differs between squares */
    const uint32_t at = column + (column >> 4) * step * 16 + 4 * rank_of(own, px, py) + part + 64 * quarter;
    return ((float)(at & 255u) + 0.5f) * (1.0f / 256.0f);
}
#endif

#if LMB_TREES
/* The plane's barycentrics at the corner (x, y) of the tile, and the ray's slope to the plane. */
static float corner_point(float b[2], const lmb_plane *p, const lmb_rays *rays, float x, float y)
{
    const lmb_vec3 origin = add3(rays->origin, add3(mul3(rays->ox, x), mul3(rays->oy, y)));
    const lmb_vec3 ray = add3(rays->direction, add3(mul3(rays->rx, x), mul3(rays->ry, y)));
    const float slope = dot3(p->plane, ray), ahead = dot3(p->plane, sub3(p->corner, origin));
    const lmb_vec3 q = sub3(add3(origin, mul3(ray, ahead / (slope * slope < 1e-36f ? 1e-18f : slope))), p->corner);
    b[0] = dot3(q, p->g1);
    b[1] = dot3(q, p->g2);
    return slope;
}

/* Tests several tiles at once, from the first pixel of the rays on. If all rays meet the plane on the same side and far
 * from the horizon, the barycentrics of all pixels lie between those of the corners. */
NOINLINE int tiles_part(const masked_surface *s, const lmb_fill_context *c, int32_t columns, int32_t rows,
                        uint32_t texels)
{
    const float right = (float)(LMB_TILE * columns - 1), bottom = (float)(LMB_TILE * rows - 1);
    const int blends = LMB_MULTISAMPLE && s->blends;
    float low[2], high[2], slope_min = 0.0f, slope_max = 0.0f;
    for (int i = 0; i < 4; ++i) {
        float b[2];
        const float slope = corner_point(b, &s->plane, &s->rays, i & 1 ? right : 0.0f, i & 2 ? bottom : 0.0f);
        slope_min = i == 0 ? slope : minf(slope_min, slope);
        slope_max = i == 0 ? slope : maxf(slope_max, slope);
        for (int k = 0; k < 2; ++k) {
            low[k] = i == 0 ? b[k] : minf(low[k], b[k]);
            high[k] = i == 0 ? b[k] : maxf(high[k], b[k]);
        }
    }
    if (!(slope_min > MIN_PLANE_SLOPE * slope_max && slope_max > 0.0f) &&
        !(slope_max < MIN_PLANE_SLOPE * slope_min && slope_min < 0.0f)) {
        return COVERS_SOME;
    }
    for (int k = 0; k < 2; ++k) {
        const float wider = BARYCENTRIC_MARGIN * (high[k] - low[k]);
        if (!is_sane(low[k]) || !is_sane(high[k])) {
            return COVERS_SOME;
        }
        low[k] -= wider;
        high[k] += wider;
    }
    return lmb_resolve_coverage(&s->alpha, c->scene, low, high, blends ? MIN_BLEND_THRESHOLD : s->alpha.cutoff,
                                blends ? MAX_BLEND_THRESHOLD : s->alpha.cutoff, &texels);
}
#endif

#if LMB_MULTISAMPLE
/* 1 if a surface that blends is shown at pixel (x, y) of the tile. */
static int blends_at(const masked_surface *s, const lmb_fill_context *c, int32_t x, int32_t y)
{
    return lmb_resolve_blend_alpha(&s->alpha, c->scene, &s->plane, &s->rays, x, y) >= threshold(s, c->view, x, y);
}
#endif

/* 1 if the surface is opaque at pixel (x, y) of the tile. */
static int stands_at(masked_surface *s, const lmb_fill_context *c, int32_t x, int32_t y)
{
    float b1, b2;
#if LMB_TREES
    s->part = s->part == COVERS_UNKNOWN ? tiles_part(s, c, 1, 1, TILE_TEXELS) : s->part;
    if (s->part != COVERS_SOME) {
        return s->part == LMB_COVERS_ALL;
    }
#endif
#if LMB_MULTISAMPLE
    if (s->blends) {
        return blends_at(s, c, x, y);
    }
#endif
#if LMB_TREES
    if (s->texture != NULL) {
        plane_point(&b1, &b2, &s->plane, &s->rays, (float)x, (float)y);
        b1 = clampf(b1, 0.0f, 1.0f);
        b2 = clampf(b2, 0.0f, 1.0f - b1);
        const float a = texels_alpha(s->texture, resolve_mix3(s->alpha.u, b1, b2), resolve_mix3(s->alpha.v, b1, b2));
        return a * resolve_mix3(s->alpha.corner, b1, b2) >= s->alpha.cutoff;
    }
#endif
    lmb_resolve_point(&b1, &b2, &s->plane, &s->rays, (float)x, (float)y);
    return lmb_resolve_opaque(&s->alpha, c->scene, b1, b2);
}

/* Same values as masked.inl. */
static float target_depth_at(const lmb_fill_job *job, const masked_surface *s, int32_t x, int32_t y)
{
    const float d = (job->d + job->dy * (float)y) + job->dx * (float)x, held = minf(maxf(d, job->d_min), job->d_max);
#if LMB_TREES
    return minf(held * s->job.behind, held);
#else
    (void)s;
    return held;
#endif
}

static float depth_code_of(const lmb_fill_job *job, float d)
{
    return floorf(maxf(minf(65535.0f, d * job->d_scale + job->d_bias), 0.0f));
}

static void put_id(const lmb_fill_tile *tile, int32_t at, uint32_t id)
{
    if (tile->id_format == LMB_ID32) {
        ((uint32_t *)tile->id)[at] = id;
    } else if (tile->id_format == LMB_ID16) {
        ((uint16_t *)tile->id)[at] = (uint16_t)id;
    }
}

/* The triangle covers pixel (x, y): draws it if it is nearer and opaque. */
static void fill_pixel(const lmb_fill_context *c, const lmb_fill_tile *tile, const lmb_fill_job *job,
                       masked_surface *s, int32_t x, int32_t y)
{
    const int32_t at = y * tile->depth_step + x;
    const float d = target_depth_at(job, s, x, y);
    if (tile->depth_format == LMB_DEPTH32F) {
        float *was = (float *)tile->depth + at;
        if (!(*was < d) || !stands_at(s, c, x, y)) {
            return;
        }
        *was = d;
    } else {
        uint16_t *was = (uint16_t *)tile->depth + at;
        const float code = depth_code_of(job, d);
        if (!((float)*was < code) || !stands_at(s, c, x, y)) {
            return;
        }
        *was = (uint16_t)code;
    }
    put_id(tile, y * tile->id_step + x, job->id);
}

/* Pixels one by one. Opaque scenes never come here. */
static void fill_tile_masked(const lmb_fill_context *c, const lmb_fill_tile *tile, const lmb_fill_job *job,
                             masked_surface *s)
{
    const int32_t *e = job->e, *ex = job->ex, *ey = job->ey;
    for (int32_t y = 0; y < LMB_TILE && s->part != LMB_COVERS_NONE; ++y) {
        int32_t e0 = e[0] + ey[0] * y, e1 = e[1] + ey[1] * y, e2 = e[2] + ey[2] * y;
        for (int32_t x = 0; x < LMB_TILE; ++x, e0 += ex[0], e1 += ex[1], e2 += ex[2]) {
            if ((e0 | e1 | e2) >= 0) {
                fill_pixel(c, tile, job, s, x, y);
            }
        }
    }
}

/* Returns 1 and sets edge i of the job, or 0 if the tile lies outside. e: at the tile's first pixel. */
static inline int enter_edge(lmb_fill_job *job, const lmb_setup *s, int i, int64_t e)
{
    const int32_t reach = LMB_TILE - 1, ex = s->ex[i], ey = s->ey[i];
    const int64_t low = e + reach * ((ex < 0 ? ex : 0) + (ey < 0 ? ey : 0));
    if (e + reach * ((ex > 0 ? ex : 0) + (ey > 0 ? ey : 0)) < 0) {
        return 0;
    }
    job->e[i] = low >= 0 ? 0 : (int32_t)e;
    job->ex[i] = low >= 0 ? 0 : ex;
    job->ey[i] = low >= 0 ? 0 : ey;
    return 1;
}

/* The same of all edges. (x, y): the tile's first pixel, 24.8. */
static int enter_tile(lmb_fill_job *job, const lmb_setup *s, int32_t x_24_8, int32_t y_24_8)
{
    for (int i = 0; i < 3; ++i) {
        if (!enter_edge(job, s, i, setup_edge(s, i, x_24_8, y_24_8))) {
            return 0;
        }
    }
    return 1;
}

/* Depth at a tile's first pixel. */
static float masked_tile_depth(const lmb_setup *s, int32_t x_24_8, int32_t y_24_8)
{
    return (float)(s->d_origin + s->d_x * (x_24_8 * (1.0 / 256.0)) + s->d_y * (y_24_8 * (1.0 / 256.0)));
}

/* First and last tile, inside the window, of a box in 24.8 from the frame's centre. origin: position of the frame's
 * pixel 0, 24.8. */
static void tile_span(int32_t *first, int32_t *last, int32_t low_24_8, int32_t high_24_8, int32_t origin,
                      int32_t window, int32_t size)
{
    int32_t low_px = ((low_24_8 - origin) >> 8) - window, high_px = ((high_24_8 - origin) >> 8) - window;
    *first = maxi(low_px, 0) >> 3;
    *last = mini(high_px, size - 1) >> 3; /* -1 >> 3 is -1: nothing */
}

/* Sets all but the rays of a tile. Returns 0 if there is no such triangle. */
NOINLINE int set_surface(masked_surface *out, const lmb_fill_context *c, uint32_t id)
{
    lmb_triangle triangle;
    if (!lmb_triangle_fetch(&triangle, c->scene, id)) {
        return 0;
    }
    lmb_resolve_rays(&out->rays, c->view, c->target->x0, c->target->y0);
    lmb_resolve_plane(&out->plane, triangle.corner, &out->rays);
    lmb_resolve_alpha_of(&out->alpha, &triangle);
    out->texture = out->alpha.texture >= 0 ? &c->scene->textures[out->alpha.texture] : NULL;
    out->texture = out->texture != NULL && texels_are_rgba8(out->texture) ? out->texture : NULL;
    return 1;
}

#if LMB_TREES
/* The least code 0 .. 256 of alpha that is at least `alpha`. */
static int32_t code_limit(float alpha)
{
    const float code = clampf(alpha * 255.0f, 0.0f, 256.0f);
    const int32_t whole = (int32_t)code;
    return whole + ((float)whole < code);
}

/* Sets the kernel's job, if there is a kernel for the surface. */
static void set_masked_job(masked_surface *s, const lmb_fill_context *c)
{
    lmb_masked_job *j = &s->job;
    s->batches = c->kernels->fill_masked != NULL && s->texture != NULL && !(LMB_MULTISAMPLE && s->blends);
    s->luck = 0;
    j->texture = s->texture;
    j->rays = &s->rays;
    j->corner = s->plane.corner;
    j->plane = s->plane.plane;
    j->g1 = s->plane.g1;
    j->g2 = s->plane.g2;
    j->w_min = s->plane.w_min;
    j->w_max = s->plane.w_max;
    j->cutoff = s->alpha.cutoff;
    j->behind = c->is_ahead ? FACTOR_BEHIND : 1.0f;
    for (int k = 0; k < 3; ++k) {
        j->alpha[k] = s->alpha.corner[k];
        j->u[k] = s->alpha.u[k];
        j->v[k] = s->alpha.v[k];
    }
    const float largest = maxf(maxf(j->alpha[0], j->alpha[1]), j->alpha[2]),
                smallest = minf(minf(j->alpha[0], j->alpha[1]), j->alpha[2]);
    const int is_weighed = smallest > 0.0f && is_sane(largest);
    j->hole = is_weighed ? code_limit(j->cutoff / (largest * ALPHA_MARGIN)) : 0;
    j->solid = is_weighed ? code_limit(j->cutoff * ALPHA_MARGIN / smallest) : 256;
}

/* 1 if the surface is entirely a hole. Reading a texel costs about a fiftieth of drawing a pixel, so more texels than
 * pixels may be read. A surface that blends is solid from the least threshold on. */
NOINLINE int is_surface_hole(const masked_surface *s, const lmb_fill_context *c, int32_t tiles)
{
    const uint32_t each = LMB_TILE_PIXELS * (s->batches ? FEW_TEXELS : MAX_TEXELS_A_TILE);
    uint32_t texels = tiles > 0 ? (uint32_t)mini(tiles, 1 << 20) * each : 0;
    lmb_resolve_alpha alpha = s->alpha;
    if (LMB_MULTISAMPLE && s->blends) {
        alpha.cutoff = MIN_BLEND_THRESHOLD;
    }
    return lmb_resolve_is_hole(&alpha, c->scene, &texels);
}
#endif

/* First and last tiles, in the window. */
typedef struct tile_range {
    int32_t x0, y0, x1, y1;
} tile_range;

#if LMB_TREES
/* As tiles_part, for a block of tiles. */
static int block_part(masked_surface *s, const lmb_fill_context *c, const tile_range *block)
{
    const int32_t columns = block->x1 - block->x0 + 1, rows = block->y1 - block->y0 + 1;
    lmb_resolve_rays(&s->rays, c->view, c->target->x0 + block->x0 * LMB_TILE, c->target->y0 + block->y0 * LMB_TILE);
    const int part = tiles_part(s, c, columns, rows, BLOCK_TEXELS);
    s->misses += part == COVERS_SOME ? -1 : columns * rows / EARNED_TILES;
    return part;
}

/* 1 if the triangle lies beside a block. */
static int is_beside(const lmb_setup *s, const lmb_fill_context *c, const tile_range *block)
{
    const int32_t x = (c->target->x0 + block->x0 * LMB_TILE) * 256 + view_origin_x(c->view);
    const int32_t y = (c->target->y0 + block->y0 * LMB_TILE) * 256 + view_origin_y(c->view);
    const int32_t right = LMB_TILE * (block->x1 - block->x0 + 1) - 1, down = LMB_TILE * (block->y1 - block->y0 + 1) - 1;
    for (int i = 0; i < 3; ++i) {
        const int64_t ex = s->ex[i], ey = s->ey[i];
        if (setup_edge(s, i, x, y) + right * (ex > 0 ? ex : 0) + down * (ey > 0 ? ey : 0) < 0) {
            return 1;
        }
    }
    return 0;
}
#endif

/* Sets the job and the surface for tile (tx, ty) of the window. Returns 0 if the triangle lies beside it. */
static int set_tile(lmb_fill_tile *out, lmb_fill_job *job, masked_surface *surface, const lmb_fill_context *c,
                    const lmb_setup *s, int32_t tx, int32_t ty)
{
    const int32_t x = c->target->x0 + tx * LMB_TILE, y = c->target->y0 + ty * LMB_TILE;
    const int32_t x_24_8 = x * 256 + view_origin_x(c->view), y_24_8 = y * 256 + view_origin_y(c->view);
    if (!enter_tile(job, s, x_24_8, y_24_8)) {
        return 0;
    }
    *out = lmb_target_tile(c->target, tx, ty);
#if LMB_TREES
    out->id_format = c->is_ahead ? LMB_FORMAT_NONE : out->id_format;
#endif
    job->d = masked_tile_depth(s, x_24_8, y_24_8);
    if (LMB_MULTISAMPLE) {
        surface->x = x;
        surface->y = y;
    }
#if LMB_TREES
    if (surface->batches) {
        return 1; /* the rays are set if they are used */
    }
#endif
    lmb_resolve_rays(&surface->rays, c->view, x, y);
    return 1;
}

#if LMB_TREES
/* Parts of a triangle's tiles that are still to be filled. parts_next returns one part, and the caller fills it,
 * because one function for both would need more stack. */
typedef struct tile_parts {
    int16_t left[BLOCK_HALVINGS + 1][4]; /* x0, y0, x1, y1 */
    int16_t count;
    int16_t x, y; /* the current block's first tile; x < 0: the parts are no blocks */
    int16_t tiles; /* of the current block */
} tile_parts;

static void parts_put(tile_parts *inout, const tile_range *all, int32_t columns, int32_t rows)
{
    int16_t *left = inout->left[inout->count++];
    left[0] = inout->x;
    left[1] = inout->y;
    left[2] = (int16_t)mini(inout->x + columns - 1, all->x1);
    left[3] = (int16_t)mini(inout->y + rows - 1, all->y1);
    inout->tiles = (int16_t)mini((left[2] - left[0] + 1) * (left[3] - left[1] + 1), 32767);
}

/* all: the triangle's tiles, at least one. */
static void parts_begin(tile_parts *out, const tile_range *all, masked_surface *surface)
{
    const int32_t columns = all->x1 - all->x0 + 1, rows = all->y1 - all->y0 + 1;
    const int by_blocks = surface->batches && columns * rows >= MIN_BLOCK_TILES;
    surface->misses = by_blocks ? MIN_MISSES + columns * rows / MISS_TILES : -WHOLE_MISSES;
    out->count = 0;
    out->x = (int16_t)all->x0;
    out->y = (int16_t)all->y0;
    parts_put(out, all, by_blocks ? BLOCK_COLUMNS : columns, by_blocks ? BLOCK_ROWS : rows);
    out->x = by_blocks ? out->x : -1;
}

/* Takes the next block. Returns 0 if there is none. */
static int parts_next_block(tile_parts *inout, const tile_range *all)
{
    if (inout->x < 0) {
        return 0;
    }
    inout->x = (int16_t)(inout->x + BLOCK_COLUMNS);
    if (inout->x > all->x1) {
        inout->x = (int16_t)all->x0;
        inout->y = (int16_t)(inout->y + BLOCK_ROWS);
    }
    if (inout->y > all->y1) {
        return 0;
    }
    parts_put(inout, all, BLOCK_COLUMNS, BLOCK_ROWS);
    return 1;
}

/* Replaces the last part by its halves. */
static void parts_halve(tile_parts *inout)
{
    int16_t *first = inout->left[inout->count - 1], *second = inout->left[inout->count++];
    const int axis = first[2] - first[0] >= first[3] - first[1] ? 0 : 1;
    const int16_t middle = (int16_t)(first[axis] + (first[axis + 2] - first[axis] + 1) / 2);
    for (int i = 0; i < 4; ++i) {
        second[i] = first[i];
    }
    second[axis + 2] = (int16_t)(middle - 1);
    first[axis] = middle;
}

/* Returns the next part that is solid or cannot be halved, and skips parts that are holes. Returns 0 at the end. */
NOINLINE int parts_next(tile_range *out, tile_parts *inout, const tile_range *all, masked_surface *surface,
                        const lmb_fill_context *c, const lmb_setup *s)
{
    while (inout->count > 0 || parts_next_block(inout, all)) {
        const int16_t *last = inout->left[inout->count - 1];
        const tile_range at = {last[0], last[1], last[2], last[3]};
        const int32_t tiles = (at.x1 - at.x0 + 1) * (at.y1 - at.y0 + 1);
        const int32_t limit = tiles == inout->tiles ? -WHOLE_MISSES : 0;
        int part = LMB_COVERS_NONE;
        if (!is_beside(s, c, &at)) {
            part = surface->misses > limit && tiles >= 2 ? block_part(surface, c, &at) : COVERS_SOME;
        }
        if (part == COVERS_SOME && surface->misses > 0 && tiles > 2) {
            parts_halve(inout);
            continue;
        }
        --inout->count;
        if (part != LMB_COVERS_NONE) {
            surface->job.is_solid = part == LMB_COVERS_ALL;
            *out = at;
            return 1;
        }
    }
    return 0;
}
#endif

#if LMB_TREES
enum {
    MIN_PAIR_PIXELS = 9, /* of a tile: with fewer, pairs of rows are not tested */
    MAX_LUCK = 8,
    UNLUCKY_EACH = 8 /* without luck, only some tiles test pairs of rows */
};

/* Tile (tx, ty) of the window by the kernels. */
NOINLINE void fill_by_kernels(const lmb_fill_context *c, const lmb_fill_tile *tile, const lmb_fill_job *job,
                            masked_surface *s, int32_t tx, int32_t ty)
{
    uint64_t seen = c->kernels->masked_seen(tile, job, &s->job);
    if (seen == 0) {
        return;
    }
    const int is_inside = (job->ex[0] | job->ex[1] | job->ex[2] | job->ey[0] | job->ey[1] | job->ey[2]) == 0;
    lmb_masked_parts parts = {0, s->job.is_solid ? ~UINT64_C(0) : 0, 0};
    if (!s->job.is_solid) {
        lmb_resolve_rays(&s->rays, c->view, c->target->x0 + tx * LMB_TILE, c->target->y0 + ty * LMB_TILE);
        if (c->kernels->masked_parts != NULL && is_inside && (s->luck >= 0 || (tx + ty) % UNLUCKY_EACH == 0) &&
            count_bits_64(seen) >= MIN_PAIR_PIXELS) {
            c->kernels->masked_parts(&parts, &s->job, seen);
            s->luck = (int16_t)mini(maxi(s->luck + parts.gain, -MAX_LUCK), MAX_LUCK);
        }
    }
    seen &= ~parts.hole;
    if (seen != 0) {
        c->kernels->fill_masked(tile, job, &s->job, seen, parts.solid);
    }
}
#endif

/* Fills the triangle's tiles in a range. */
static void fill_range(const lmb_fill_context *c, const lmb_setup *s, lmb_fill_job *job, masked_surface *surface,
                       const tile_range *range, int part)
{
    for (int32_t ty = range->y0; ty <= range->y1; ++ty) {
        for (int32_t tx = range->x0; tx <= range->x1; ++tx) {
            lmb_fill_tile tile;
            if (set_tile(&tile, job, surface, c, s, tx, ty)) {
#if LMB_TREES
                if (surface->batches) {
                    fill_by_kernels(c, &tile, job, surface, tx, ty);
                    continue;
                }
#endif
                surface->part = part;
                fill_tile_masked(c, &tile, job, surface);
            }
        }
    }
}

void lmb_fill_masked(const lmb_fill_context *c, const lmb_setup *s, uint32_t id, int blends)
{
    const lmb_target *target = c->target;
    tile_range all;
    lmb_fill_job job;
    masked_surface surface;
    if (!set_surface(&surface, c, id)) {
        return;
    }
    if (LMB_MULTISAMPLE) {
        surface.blends = blends;
        surface.id = id;
    }
    const int32_t origin_x = view_origin_x(c->view), origin_y = view_origin_y(c->view);
    tile_span(&all.x0, &all.x1, s->x_min, s->x_max, origin_x, target->x0, target->depth.width);
    tile_span(&all.y0, &all.y1, s->y_min, s->y_max, origin_y, target->y0, target->depth.height);
    job.dx = (float)s->d_x;
    job.dy = (float)s->d_y;
    job.d_min = s->d_min;
    job.d_max = s->d_max;
    job.d_scale = c->window.d_scale;
    job.d_bias = c->window.d_bias;
    job.id = id;
#if LMB_TREES
    const int32_t tiles = (all.x1 - all.x0 + 1) * (all.y1 - all.y0 + 1);
    if (all.x1 < all.x0 || all.y1 < all.y0 || (c->is_ahead && tiles < MIN_TILES_AHEAD)) {
        return;
    }
    job.d_bias -= c->is_ahead ? CODES_BEHIND : 0.0f;
    set_masked_job(&surface, c);
    if (is_surface_hole(&surface, c, tiles)) {
        return;
    }
    const int part = all.x1 > all.x0 || all.y1 > all.y0 ? COVERS_UNKNOWN : COVERS_SOME;
    tile_parts parts;
    tile_range range;
    parts_begin(&parts, &all, &surface);
    while (parts_next(&range, &parts, &all, &surface, c, s)) {
        fill_range(c, s, &job, &surface, &range, part);
    }
#else
    fill_range(c, s, &job, &surface, &all, COVERS_SOME);
#endif
}
