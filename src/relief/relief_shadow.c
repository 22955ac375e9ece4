/* relief_shadow.c: the complex surface in its shadow map, and the shadow test. Layer 5. [P7 P8 P9]
 *
 * Williams (1978): the shadow map holds depths of the complex surface, warped like the eye's picture. A point is in
 * shadow if the map has a nearer surface. The point is the candidate of the chosen view (P8), so it projects to the map
 * texels that show it. The point's plane is evaluated at the middles of the four texels around the projection, so
 * slopes need no bias. The remaining error is curvature and the warp's own error. */
#include <lambent/relief.h>

#include "../base/light_kind.h"
#include "../base/vec.h"
#include "../direct/part.h"
#include "../direct/shadow.h"
#include "../raster/target.h"
#include "../raster/tile.h"
#include "mend.h"

#if LMB_RELIEF

#define MAX_BEHIND_TEXELS 1.0f /* max texels of a lit receiver behind the surface in the map */
#define MAX_SLOPE_TEXELS  4.0f /* max texels by which a receiver's plane is extrapolated */
#define MIN_PLANE_COSINE  1e-3f

/* --- the map ------------------------------------------------------------------------------------------------------ */

static float depth_of(const lmb_view *v, float z)
{
    const float d =
        v->kind == LMB_PERSPECTIVE ? v->near_m / maxf(z, v->near_m) : (v->far_m - z) / (v->far_m - v->near_m);
    return clampf(d, 0.0f, 1.0f);
}

static void store_depths(const lmb_target *face, const lmb_view *v, const lmb_tile *tile)
{
    const lmb_fill_tile to = lmb_target_tile(face, tile->x / LMB_TILE, tile->y / LMB_TILE);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        ((float *)to.depth)[k / LMB_TILE * to.depth_step + k % LMB_TILE] =
            tile->id[k] != 0 ? depth_of(v, tile->depth[k]) : 0.0f;
    }
}

static lmb_status shadow_row(const lmb_target *face, const lmb_view *view, lmb_tile *tile, const lmb_kernels *kernels,
                             const lmb_relief *relief, const lmb_relief_how *how, int32_t y)
{
    lmb_scene scene;
    lmb_relief_scene(&scene, relief);
    for (int32_t x = 0; x < face->depth.width; x += LMB_TILE) {
        lmb_status status = lmb_resolve_tile(tile, kernels, view, &scene, face, x, y);
        if (status == LMB_OK) {
            status = lmb_relief_tile(tile, kernels, relief, view, how, NULL);
        }
        if (status != LMB_OK) {
            return status;
        }
        store_depths(face, view, tile);
    }
    return LMB_OK;
}

lmb_status lmb_relief_shadow_rows(const lmb_shadow_map *map, const lmb_kernels *kernels, lmb_tile *tile,
                                  const lmb_relief *relief, const lmb_relief_how *how, int32_t first, int32_t past)
{
    if (map == NULL || tile == NULL || kernels == NULL || relief == NULL || first < 0 || first > past ||
        past > map->faces * (map->size / LMB_TILE)) {
        return LMB_ERR_ARG;
    }
    if (map->face[0].depth.format != LMB_DEPTH32F) {
        return LMB_ERR_FORMAT;
    }
    for (int32_t row = first; row < past; ++row) {
        const int32_t rows = map->size / LMB_TILE, f = row / rows;
        if ((map->drawn >> f & 1u) != 0) {
            const lmb_status status =
                shadow_row(&map->face[f], &map->view[f], tile, kernels, relief, how, row % rows * LMB_TILE);
            if (status != LMB_OK) {
                return status;
            }
        }
    }
    return LMB_OK;
}

/* --- the shadow test ---------------------------------------------------------------------------------------------- */

/* A point in one face of a map. */
typedef struct receiver {
    const lmb_view *view;
    const lmb_target *face;
    int32_t size;       /* texels a side */
    float x, y, w;      /* texels; m along the face's axis */
    float texel;        /* m, side of a texel at that depth */
    lmb_vec3 at, plane; /* m; unit */
} receiver;

/* Returns 0 if the receiver lies outside the map. */
static int find_receiver(receiver *r, const lmb_shadow_map *map, const lmb_light *light, const lmb_tile *tile, int k)
{
    r->at = tile_vec(tile->position, k);
    r->plane = tile_vec(tile->face, k);
    const int32_t f = light_kind_is(light->kind, LIGHT_FAR) ? lmb_shadow_map_part(map, r->at)
                                                            : shadow_map_face(map, sub3(r->at, light->position));
    const lmb_view *v = r->view = &map->view[f];
    const lmb_vec3 d = sub3(r->at, v->eye);
    const float size = (float)map->size;
    r->face = &map->face[f];
    r->size = map->size;
    r->w = -dot3(v->back, d);
    const float unit = v->kind == LMB_PERSPECTIVE ? r->w : 1.0f;
    if (!(unit > 0.0f) || (map->drawn >> f & 1u) == 0) {
        return 0;
    }
    r->x = (dot3(v->right, d) / (unit * v->half_width) * 0.5f + 0.5f) * size;
    r->y = (0.5f - dot3(v->up, d) / (unit * v->half_height) * 0.5f) * size;
    r->texel = 2.0f * v->half_width / size * unit;
    return r->x >= 0.0f && r->y >= 0.0f && r->x <= size && r->y <= size;
}

/* Depth of the receiver's plane at the middle of texel x, y. */
static float plane_depth(const receiver *r, int32_t x, int32_t y)
{
    const lmb_view *v = r->view;
    const float size = (float)r->size;
    const float sx = ((float)(2 * x + 1) / size - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * y + 1) / size) * v->half_height;
    const lmb_vec3 across = add3(mul3(v->right, sx), mul3(v->up, sy));
    const int perspective = v->kind == LMB_PERSPECTIVE;
    const lmb_vec3 from = perspective ? v->eye : add3(v->eye, across),
                   ray = perspective ? sub3(across, v->back) : mul3(v->back, -1.0f);
    const float slope = dot3(r->plane, ray), max = MAX_SLOPE_TEXELS * r->texel;
    if (absf(slope) < MIN_PLANE_COSINE) {
        return r->w;
    }
    return clampf(dot3(r->plane, sub3(r->at, from)) / slope, r->w - max, r->w + max);
}

static int texel_lit(const receiver *r, int32_t x, int32_t y)
{
    x = mini(maxi(x, 0), r->size - 1);
    y = mini(maxi(y, 0), r->size - 1);
    const lmb_fill_tile t = lmb_target_tile(r->face, x / LMB_TILE, y / LMB_TILE);
    const float d = ((const float *)t.depth)[y % LMB_TILE * t.depth_step + x % LMB_TILE];
    return d == 0.0f || lmb_depth_view_z(r->view, d) >= plane_depth(r, x, y) - MAX_BEHIND_TEXELS * r->texel;
}

static int is_receiver_lit(const receiver *r)
{
    const float fx = r->x - 0.5f, fy = r->y - 0.5f, x0 = floorf(fx), y0 = floorf(fy), u = fx - x0, v = fy - y0;
    const float weight[4] = {(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v};
    float lit = 0.0f;
    for (int q = 0; q < 4; ++q) {
        lit += texel_lit(r, (int32_t)x0 + (q & 1), (int32_t)y0 + (q >> 1)) ? weight[q] : 0.0f;
    }
    return lit >= 0.5f;
}

/* If a pixel differs from three or more neighbours that all agree (lit or unlit), it becomes like them: such a speck is
 * the edge of a texel, not of an object. */
static uint64_t without_specks(uint64_t lit, uint64_t shown)
{
    uint64_t out = lit;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const uint64_t own = (uint64_t)1 << k, others = lmb_relief_beside(k) & shown;
        const uint64_t same = (lit & own) != 0 ? lit & others : others & ~lit;
        if ((shown & own) != 0 && count_bits_64(others) >= 3 && same == 0) {
            out ^= own;
        }
    }
    return out;
}

uint64_t lmb_relief_lit(const lmb_shadow_map *map, const lmb_light *light, const lmb_tile *tile)
{
    uint64_t out = 0, shown = 0;
    receiver r;
    const int is_given = map != NULL && light != NULL && tile != NULL;
    for (int k = 0; is_given && k < LMB_TILE_PIXELS; ++k) {
        shown |= (uint64_t)(tile->id[k] != 0) << k;
        if (tile->id[k] != 0 && (!find_receiver(&r, map, light, tile, k) || is_receiver_lit(&r))) {
            out |= (uint64_t)1 << k;
        }
    }
    return without_specks(out, shown);
}

#endif
