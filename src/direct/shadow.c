/* shadow.c: tests by the shadow map whether a point of a surface is lit. Layer 4. [V7]
 *
 * The depth in a map is valid only at the centre of a texel. Elsewhere it needs a bias, which leaks light or causes
 * acne. Ids are valid everywhere: the triangles named by the four texels around the point are tested at the point's own
 * position in the map. A triangle that lies over this position, with the point behind its plane, shadows the point.
 *
 * The four centres surround the point, so a straight shadow edge that covers the point covers one of them: edges are
 * correct to a fraction of a texel. If none of the four triangles lies over the point (triangles smaller than texels),
 * the nearest texel's depth is compared with the receiver's plane at the centre of the texel, which needs no slope
 * bias. Half a texel's width along the light is allowed for the curvature of finely tessellated surfaces.
 *
 * Rejected: depth with a slope-scaled bias (bunny_room: acne or 2 cm of detachment, nothing between). */
#include "shadow.h"

#include <string.h>

#include "../base/light_kind.h"
#include "../base/vec.h"
#include "../raster/plane.h"
#include "../raster/resolve.h"
#include "../raster/target.h"
#include "../raster/tile.h"
#include "part.h"

/* Position of the receiver in a face. */
typedef struct lit_place {
    const lmb_view *view;
    int32_t face;
    float x, y; /* texels */
    float w;    /* m along the face's axis */
    lmb_vec3 towards; /* from the receiver to the light; directional: unit length */
} lit_place;

static int32_t choose_shadow_face(const lmb_shadow_map *map, lmb_vec3 d)
{
    lmb_vec3 a = vec3(absf(d.x), absf(d.y), absf(d.z));
    if (map->faces == 1) {
        return 0;
    }
    if (a.x >= a.y && a.x >= a.z) {
        return d.x < 0.0f;
    }
    return a.y >= a.z ? 2 + (d.y < 0.0f) : 4 + (d.z < 0.0f);
}

/* Returns 0 if the receiver is outside the map: nothing can shadow it there (spots: it is outside the cone). */
static int find_place(lit_place *out, const lmb_shadow_map *map, const lmb_light *light, lmb_vec3 p)
{
    const int directional = light_kind_is(light->kind, LIGHT_FAR);
    int32_t f =
        LMB_TREES && directional ? lmb_shadow_map_part(map, p) : choose_shadow_face(map, sub3(p, light->position));
    const lmb_view *v = &map->view[f];
    lmb_vec3 d = sub3(p, v->eye);
    float w = -dot3(v->back, d), size = (float)map->size;
    float unit = v->kind == LMB_PERSPECTIVE ? w : 1.0f;
    if (!(unit > 0.0f) || ((map->drawn >> f) & 1u) == 0) {
        return 0;
    }
    out->view = v;
    out->face = f;
    out->x = (dot3(v->right, d) / (unit * v->half_width) * 0.5f + 0.5f) * size;
    out->y = (0.5f - dot3(v->up, d) / (unit * v->half_height) * 0.5f) * size;
    out->w = w;
    out->towards = directional ? v->back : sub3(light->position, p);
    return out->x >= 0.0f && out->y >= 0.0f && out->x <= size && out->y <= size;
}

/* x, y: not negative. */
static uint32_t texel_id(const lmb_fill_window *map, uint32_t x, uint32_t y)
{
    const uint8_t *tile = (const uint8_t *)map->first.id + (ptrdiff_t)(y / LMB_TILE) * map->id_row +
                          (ptrdiff_t)(x / LMB_TILE) * map->id_tile;
    const uint32_t at = (y % LMB_TILE) * (uint32_t)map->first.id_step + x % LMB_TILE;
    return map->first.id_format == LMB_ID16 ? ((const uint16_t *)(const void *)tile)[at]
                                            : ((const uint32_t *)(const void *)tile)[at];
}

static float texel_depth(const lmb_fill_window *map, uint32_t x, uint32_t y)
{
    const uint8_t *tile = (const uint8_t *)map->first.depth + (ptrdiff_t)(y / LMB_TILE) * map->depth_row +
                          (ptrdiff_t)(x / LMB_TILE) * map->depth_tile;
    return ((const float *)(const void *)tile)[(y % LMB_TILE) * (uint32_t)map->first.depth_step + x % LMB_TILE];
}

/* Possible rounding of the position, m: 2^-15 of the pixel's distance for the position in the triangle's plane, because
 * edges are snapped to fractions of a pixel; 2^-22 of the coordinates for a few roundings of the resolve. */
static float noise_of_receiver(const lmb_shadow_query *query, const lmb_receiver *r)
{
    return SHADOW_NOISE_PIXEL * length3(sub3(r->position, query->view->eye)) +
           SHADOW_NOISE_PLACE * length3(r->position);
}

/* Results of a ray from a place to the light against a triangle. TEXEL_THROUGH is an extra bit: the triangle's plane
 * contains the place. */
enum { TEXEL_BESIDE = 0, TEXEL_OVER = 1, TEXEL_SHADOWS = 2, TEXEL_THROUGH = 4 };

/* Tests whether a triangle lies over a place in the map, with the place behind the triangle's plane. n: normal of the
 * triangle, of any length. noise: m, of the place. */
static int ask_from(lmb_vec3 *n, const lmb_shadow_query *query, const lmb_triangle *t, lmb_vec3 p, const lit_place *at,
                    float noise)
{
    lmb_vec3 a = sub3(t->corner[0], p), b = sub3(t->corner[1], p), c = sub3(t->corner[2], p);
    *n = cross3(sub3(b, a), sub3(c, a));
    const float nn = dot3(*n, *n);
    if (!(nn > 1e-36f)) {
        return TEXEL_BESIDE;
    }
    float height = dot3(*n, a) / sqrtf(nn); /* of the plane over the place, m, signed */
    const int through = absf(height) <= noise ? TEXEL_THROUGH : 0;
    /* Signs of the ray to the light against the edges: all equal if it passes inside. */
    float e0 = dot3(at->towards, cross3(b, c)), e1 = dot3(at->towards, cross3(c, a)),
          e2 = dot3(at->towards, cross3(a, b));
    if (!((e0 >= 0.0f && e1 >= 0.0f && e2 >= 0.0f) || (e0 <= 0.0f && e1 <= 0.0f && e2 <= 0.0f))) {
        return TEXEL_BESIDE | through;
    }
    float rise = dot3(*n, at->towards) / sqrtf(nn); /* slope towards the light, on the same scale */
    float sum = e0 + e1 + e2;
    if (height * rise <= 0.0f || through || sum == 0.0f) {
        return TEXEL_OVER | through; /* the plane is behind the place, or contains it */
    }
    if (absf(height) >= absf(rise) && at->view->kind == LMB_PERSPECTIVE) {
        return TEXEL_OVER; /* beyond the light */
    }
    return lmb_triangle_opaque(t, query->scene, e1 / sum, e2 / sum) ? TEXEL_SHADOWS : TEXEL_BESIDE;
}

/* For a receiver on the line of two triangles, as on a floor at the foot of a wall, only rounding would decide which
 * side of the wall it is on. A wall lit from behind would have bright specks along the foot. The eye sees the receiver,
 * so a place a little nearer to the eye, by at most 64 times the noise, is on the receiver's side and is tested too. */
static int ask_triangle(const lmb_shadow_query *query, uint32_t id, const lmb_receiver *r, const lit_place *at,
                        float noise)
{
    lmb_triangle t;
    lmb_vec3 n;
    if (!lmb_triangle_fetch(&t, query->scene, id)) {
        return TEXEL_BESIDE;
    }
    const int answer = ask_from(&n, query, &t, r->position, at, noise);
    if ((answer & TEXEL_THROUGH) != 0) {
        const lmb_view *v = query->view;
        const lmb_vec3 way = v->kind == LMB_PERSPECTIVE ? sub3(v->eye, r->position) : v->back;
        const float change = absf(dot3(n, way)), length = sqrtf(dot3(n, n));
        if (16.0f * change >= length * length3(way) &&
            ask_from(&n, query, &t, add3(r->position, mul3(way, 4.0f * noise * length / change)), at, noise) ==
                TEXEL_SHADOWS) {
            return TEXEL_SHADOWS;
        }
    }
    return answer & (TEXEL_OVER | TEXEL_SHADOWS);
}

/* Compares the nearest texel's surface with the receiver's plane at the centre of the texel. noise: m, of the
 * receiver's position. */
static int lit_by_depth(const lmb_shadow_query *query, const lit_place *at, const lmb_receiver *r, float noise)
{
    const int32_t last = query->map->size - 1, x = mini((int32_t)at->x, last), y = mini((int32_t)at->y, last);
    const lmb_view *v = at->view;
    float size = (float)v->frame_width, d = texel_depth(&query->window, (uint32_t)x, (uint32_t)y);
    if (d == 0.0f) {
        return 1;
    }
    float sx = ((float)(2 * x + 1) / size - 1.0f) * v->half_width,
          sy = (1.0f - (float)(2 * y + 1) / size) * v->half_height;
    lmb_vec3 across = add3(mul3(v->right, sx), mul3(v->up, sy));
    int perspective = v->kind == LMB_PERSPECTIVE;
    lmb_vec3 from = perspective ? v->eye : add3(v->eye, across),
             ray = perspective ? sub3(across, v->back) : mul3(v->back, -1.0f);
    float slope = dot3(r->face, ray), texel = 2.0f * v->half_width / size * (perspective ? at->w : 1.0f);
    /* On a plane seen edge-on the centre of the texel carries no information. Nor does the plane of a curved surface
     * more than 16 texels behind the point; in front of it there may be a convex edge. */
    if (absf(slope) < 1e-3f) {
        return 1;
    }
    float own = minf(dot3(r->face, sub3(r->position, from)) / slope, at->w + 16.0f * texel);
    return lmb_depth_view_z(v, d) >= own - texel - noise;
}

void lmb_shadow_ask(lmb_shadow_query *out, const lmb_shadow_map *map, const lmb_light *light, const lmb_scene *scene,
                    const lmb_view *view)
{
    out->map = map;
    out->light = light;
    out->scene = scene;
    out->view = view;
    out->face = -1;
}

/* The ids of the four texels around the place. Returns 1 if all are the receiver's own. */
static int four_ids(uint32_t seen[4], lmb_shadow_query *query, const lit_place *at, uint32_t own)
{
    const float left = at->x - 0.5f, top = at->y - 0.5f; /* above -1 */
    const int32_t x0 = (int32_t)left - (left < 0.0f), y0 = (int32_t)top - (top < 0.0f), last = query->map->size - 1;
    int same = 1;
    if (at->face != query->face) {
        query->face = at->face;
        query->window = lmb_target_window(&query->map->face[at->face], at->view);
    }
    for (int q = 0; q < 4; ++q) {
        seen[q] = texel_id(&query->window, (uint32_t)mini(maxi(x0 + (q & 1), 0), last),
                           (uint32_t)mini(maxi(y0 + (q >> 1), 0), last));
        same &= seen[q] == own;
    }
    return same;
}

int lmb_is_lit(lmb_shadow_query *query, const lmb_receiver *r)
{
    lit_place at;
    int over = 0;
    uint32_t seen[4];
#if LMB_FACETS
    int own = 0;
#endif
    if (!find_place(&at, query->map, query->light, r->position) || four_ids(seen, query, &at, r->id)) {
        return 1;
    }
    const float noise = noise_of_receiver(query, r);
    for (int q = 0; q < 4; ++q) {
        int known = 0;
        for (int p = 0; p < q; ++p) {
            known |= seen[p] == seen[q];
        }
        if (seen[q] == r->id) {
            over = 1;
#if LMB_FACETS
            own = 1;
#endif
        } else if (seen[q] != 0 && !known) {
            int answer = ask_triangle(query, seen[q], r, &at, noise);
            if (answer == TEXEL_SHADOWS) {
                return 0;
            }
            over |= answer == TEXEL_OVER;
        }
    }
#if LMB_FACETS
    if (!own) {
        return over || lit_by_depth(query, &at, r, noise) ? LMB_LIT_IN_DOUBT : 0;
    }
#endif
    return over || lit_by_depth(query, &at, r, noise);
}

#if LMB_SHADOW_LANES

/* --- a tile ------------------------------------------------------------------------------------------------------- */

static int is_lit_at(lmb_shadow_query *query, const lmb_tile *tile, int k)
{
    lmb_receiver r;
    r.position = tile_vec(tile->position, k);
    r.face = tile_vec(tile->face, k);
    r.id = tile->id[k];
    return lmb_is_lit(query, &r);
}

/* Masks of pixels of a tile. */
typedef struct shadow_some {
    uint32_t own;     /* a texel shows the pixel's own triangle */
    uint32_t shadows, over;
    uint32_t unclear; /* need lmb_is_lit */
} shadow_some;

/* Tests the pairs. first: the pixel of bit 0. */
static void ask_shadow_pairs(shadow_some *inout, lmb_shadow_pairs *pairs, const lmb_kernels *kernels,
                             const lmb_tile *tile, int first)
{
    lmb_shadow_answers answers;
    kernels->shadow_ask(&answers, pairs, tile);
    for (int i = 0; i < pairs->count; ++i) {
        const int at = pairs->pixel[i] - first;
        inout->unclear |= (answers.through >> i & 1u) << at;
        inout->shadows |= (answers.shadows >> i & 1u) << at;
        inout->over |= (answers.over >> i & 1u) << at;
    }
    pairs->count = 0;
}

/* Adds a pair of a pixel and a triangle. Returns 0 if the triangle has holes or does not exist. */
NOINLINE int add_shadow_pair(lmb_shadow_pairs *pairs, uint32_t ids[LMB_SHADOW_PAIRS], const lmb_scene *scene,
                             int pixel, uint32_t id)
{
    const int to = pairs->count;
    lmb_triangle t;
    int same = to - 1;
    while (same >= 0 && ids[same] != id) {
        --same;
    }
    if (same >= 0) {
        for (int i = 0; i < 9; ++i) {
            pairs->corner[i / 3][i % 3][to] = pairs->corner[i / 3][i % 3][same];
        }
    } else {
        if (!lmb_triangle_fetch(&t, scene, id) || (t.material->flags & LMB_ALPHA_MASK) != 0) {
            return 0;
        }
        for (int c = 0; c < 3; ++c) {
            pairs->corner[c][0][to] = t.corner[c].x;
            pairs->corner[c][1][to] = t.corner[c].y;
            pairs->corner[c][2][to] = t.corner[c].z;
        }
    }
    ids[to] = id;
    pairs->pixel[to] = pixel;
    ++pairs->count;
    return 1;
}

/* Tests the pixels `some`. first: the pixel of bit 0. */
static shadow_some ask_some(const lmb_shadow_query *query, const lmb_kernels *kernels, const lmb_tile *tile, int first,
                            uint32_t some, uint32_t (*seen)[LMB_SHADOW_PIXELS], const lmb_view *map_view)
{
    const int is_far = light_kind_is(query->light->kind, LIGHT_FAR);
    shadow_some out = {0, 0, 0, 0};
    lmb_shadow_pairs pairs;
    uint32_t ids[LMB_SHADOW_PAIRS];
    memset(&pairs, 0, sizeof pairs);
    pairs.is_far = is_far;
    pairs.is_wide = map_view->kind == LMB_PERSPECTIVE;
    pairs.light = is_far ? map_view->back : query->light->position;
    pairs.eye = query->view->eye;
    for (uint32_t bits = some; bits != 0; bits &= bits - 1) {
        const int at = lowest_bit(bits);
        for (int q = 0; q < 4; ++q) {
            const uint32_t id = seen[q][at];
            int known = 0;
            for (int p = 0; p < q; ++p) {
                known |= seen[p][at] == id;
            }
            if (id == tile->id[first + at]) {
                out.own |= 1u << at;
            } else if (id != 0 && !known && !add_shadow_pair(&pairs, ids, query->scene, first + at, id)) {
                out.unclear |= 1u << at;
            }
            if (pairs.count == LMB_SHADOW_PAIRS) {
                ask_shadow_pairs(&out, &pairs, kernels, tile, first);
            }
        }
    }
    ask_shadow_pairs(&out, &pairs, kernels, tile, first);
    return out;
}

/* A face of the map for the kernel. */
static lmb_shadow_job shadow_job_of(const lmb_shadow_query *query, int32_t face)
{
    const lmb_shadow_map *map = query->map;
    const lmb_fill_window w = lmb_target_window(&map->face[face], &map->view[face]);
    const int is_16 = w.first.id_format == LMB_ID16, bytes = is_16 ? 2 : 4;
    const lmb_shadow_job job = {.view = &map->view[face],
                                .id = w.first.id,
                                .row = w.id_row / bytes,
                                .tile = w.id_tile / bytes,
                                .step = w.first.id_step,
                                .is_16 = is_16,
                                .face = map->faces > 1 ? face : -1,
                                .light = query->light->position,
                                .size = (float)map->size};
    return job;
}

/* Masks of LMB_SHADOW_PIXELS pixels: lit, lit in doubt, and those that need lmb_is_lit. */
typedef struct shadow_lit {
    uint32_t lit, doubtful, unclear;
} shadow_lit;

NOINLINE shadow_lit lit_of_some(const lmb_shadow_query *query, const lmb_kernels *kernels, const lmb_tile *tile,
                                int first, uint32_t asked)
{
    uint32_t seen[4][LMB_SHADOW_PIXELS], in;
    shadow_lit out = {0, 0, 0};
    for (uint32_t left = asked; left != 0; left &= ~in) {
        const int k = lowest_bit(left);
        const int32_t f =
            choose_shadow_face(query->map, sub3(tile_vec(tile->position, first + k), query->light->position));
        in = 1u << k;
        if ((query->map->drawn >> f & 1u) == 0) { /* nothing shadows it */
            out.lit |= in;
            continue;
        }
        const lmb_shadow_job job = shadow_job_of(query, f);
        const uint32_t own = kernels->shadow_own(&in, seen, tile, first, left, &job), some = in & ~own;
        const shadow_some to = ask_some(query, kernels, tile, first, some, seen, job.view);
        const uint32_t clear = some & ~to.unclear & (to.shadows | to.own | to.over), lit = clear & ~to.shadows;
        out.lit |= own | lit;
        out.doubtful |= lit & ~to.own;
        out.unclear |= some & ~clear;
        in |= 1u << k;
    }
    return out;
}

uint64_t lmb_shadow_lit(uint64_t *doubtful, lmb_shadow_query *query, const lmb_kernels *kernels, const lmb_tile *tile,
                        uint64_t asked)
{
    const int nested = query->map->faces > 1 && light_kind_is(query->light->kind, LIGHT_FAR);
    uint64_t out = 0, unclear = nested ? asked : 0;
    *doubtful = 0;
    for (int first = 0; first < LMB_TILE_PIXELS && !nested; first += LMB_SHADOW_PIXELS) {
        const uint32_t some = (uint32_t)(asked >> first) & ((1u << LMB_SHADOW_PIXELS) - 1);
        const shadow_lit l = lit_of_some(query, kernels, tile, first, some);
        out |= (uint64_t)l.lit << first;
        *doubtful |= (uint64_t)l.doubtful << first;
        unclear |= (uint64_t)l.unclear << first;
    }
    for (; unclear != 0; unclear &= unclear - 1) {
        const int k = lowest_bit_64(unclear), lit = is_lit_at(query, tile, k);
        out |= (uint64_t)(lit != 0) << k;
        *doubtful |= (uint64_t)(lit == LMB_LIT_IN_DOUBT) << k;
    }
    return out;
}

#endif
