/* tile.h: operations on a tile's pixels for several modules. Sets of pixels are 64 bits, one each. Layer 3. */
#ifndef LMB_RASTER_TILE_H
#define LMB_RASTER_TILE_H

#include <lambent/raster.h>

#include "../base/vec.h"

#define TILE_COS_25 0.90630779f
#define TILE_GAP    0.6f /* two parts that span less than this share of the whole are two surfaces */
#define TILE_FLAT   0.5f /* height over a surface's first pixel, as a share of the distance to it */

static inline lmb_vec3 tile_vec(const float (*p)[LMB_TILE_PIXELS], int k) { return vec3(p[0][k], p[1][k], p[2][k]); }

static inline void tile_set_vec(float (*p)[LMB_TILE_PIXELS], int k, lmb_vec3 v)
{
    p[0][k] = v.x;
    p[1][k] = v.y;
    p[2][k] = v.z;
}

/* Copies the pixel data that a gather reads. */
static inline void tile_put_pixel(lmb_tile *out, int to, const lmb_tile *in, int from)
{
    for (int c = 0; c < 3; ++c) {
        out->position[c][to] = in->position[c][from];
        out->face[c][to] = in->face[c][from];
        out->normal[c][to] = in->normal[c][from];
    }
    out->depth[to] = in->depth[from];
    out->id[to] = in->id[from];
}

/* The pixels with a surface. */
static inline uint64_t tile_pixels(const lmb_tile *tile)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out |= (uint64_t)(tile->id[k] != 0) << k;
    }
    return out;
}

/* The box of the positions of the pixels; an empty one for no pixels. */
static inline void tile_box(lmb_vec3 *low, lmb_vec3 *high, const lmb_tile *tile, uint64_t pixels)
{
    *low = vec3(3e38f, 3e38f, 3e38f);
    *high = vec3(-3e38f, -3e38f, -3e38f);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const lmb_vec3 p = tile_vec(tile->position, lowest_bit_64(bits));
        *low = min3(*low, p);
        *high = max3(*high, p);
    }
}

/* The pixels of `left` on the plane of the first one: normals within 25 degrees. */
static inline uint64_t tile_plane(const lmb_tile *tile, uint64_t left)
{
    const int first = lowest_bit_64(left);
    const lmb_vec3 at = tile_vec(tile->position, first), n = tile_vec(tile->face, first);
    uint64_t out = (uint64_t)1 << first;
    for (uint64_t bits = left; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(tile_vec(tile->position, k), at);
        const float height = dot3(n, d);
        if (dot3(n, tile_vec(tile->face, k)) >= TILE_COS_25 && height * height <= TILE_FLAT * TILE_FLAT * dot3(d, d)) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

/* The pixels nearer to the first one than to the one farthest from it. */
static inline uint64_t tile_near_half(const lmb_tile *tile, uint64_t pixels)
{
    const lmb_vec3 first = tile_vec(tile->position, lowest_bit_64(pixels));
    lmb_vec3 far = first;
    uint64_t out = 0;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const lmb_vec3 p = tile_vec(tile->position, lowest_bit_64(bits)), d = sub3(p, first), e = sub3(far, first);
        far = dot3(d, d) > dot3(e, e) ? p : far;
    }
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 p = tile_vec(tile->position, k), d = sub3(p, first), e = sub3(p, far);
        out |= (uint64_t)(dot3(d, d) <= dot3(e, e)) << k;
    }
    return out;
}

static inline float tile_extent(const lmb_tile *tile, uint64_t pixels)
{
    lmb_vec3 low, high;
    tile_box(&low, &high, tile, pixels);
    return pixels != 0 ? length3(sub3(high, low)) : 0.0f;
}

/* The pixels of `left` on one surface with the first one: on the same plane, with no wide gap between. A surface is
 * bounded by a box: without that rule, the box of a floor before and behind a table would contain the table too. */
static inline uint64_t tile_surface(const lmb_tile *tile, uint64_t left)
{
    uint64_t out = tile_plane(tile, left), half = tile_near_half(tile, out);
    while (tile_extent(tile, half) + tile_extent(tile, out & ~half) < TILE_GAP * tile_extent(tile, out)) {
        out = half;
        half = tile_near_half(tile, out);
    }
    return out;
}

#endif
