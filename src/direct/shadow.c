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
 * If none of the four shows the receiver's own triangle, tips of other triangles between the texels are sought.
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

/* Returns 0 if the receiver is outside the map: nothing can shadow it there (spots: it is outside the cone). */
static int find_place(lit_place *out, const lmb_shadow_map *map, const lmb_light *light, lmb_vec3 p)
{
    const int directional = light_kind_is(light->kind, LIGHT_FAR);
    int32_t f =
        LMB_TREES && directional ? lmb_shadow_map_part(map, p) : shadow_map_face(map, sub3(p, light->position));
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
#if LMB_FACETS
    out->tips.id = 0;
#endif
}

static void use_face(lmb_shadow_query *query, const lit_place *at)
{
    if (at->face != query->face) {
        query->face = at->face;
        query->window = lmb_target_window(&query->map->face[at->face], at->view);
    }
}

/* The ids of the four texels around the place. Returns 1 if all are the receiver's own. */
static int four_ids(uint32_t seen[4], lmb_shadow_query *query, const lit_place *at, uint32_t own)
{
    const float left = at->x - 0.5f, top = at->y - 0.5f; /* above -1 */
    const int32_t x0 = (int32_t)left - (left < 0.0f), y0 = (int32_t)top - (top < 0.0f), last = query->map->size - 1;
    int same = 1;
    use_face(query, at);
    for (int q = 0; q < 4; ++q) {
        seen[q] = texel_id(&query->window, (uint32_t)mini(maxi(x0 + (q & 1), 0), last),
                           (uint32_t)mini(maxi(y0 + (q >> 1), 0), last));
        same &= seen[q] == own;
    }
    return same;
}

#if LMB_FACETS

/* --- tips of triangles ---------------------------------------------------------------------------------------------
 *
 * The tip of a triangle, as in the corner of a closed room, may cover a place but none of the four texels around it.
 * The receiver's triangle has a corner there too, if the walls of the room share their corners. The map is read along
 * lines from the corners of the receiver's triangle through the place: there, a tip that covers the place is wider. A
 * triangle named there shadows the place only if the exact test finds it over the place. */

#define MIN_TIP_REACH 4.0f /* texels across the receiver's triangle; smaller triangles are not searched */
enum { MAX_TIP_STEPS = 8 /* 1, 2, 4 .. 128 texels beyond the place */, MAX_TIPS_ASKED = 12 };

/* Position of a place in the view of a face, texels. Returns 0 if it is behind the light. */
static int place_on_map(float *x, float *y, const lmb_view *v, lmb_vec3 p)
{
    const lmb_vec3 d = sub3(p, v->eye);
    const float unit = v->kind == LMB_PERSPECTIVE ? -dot3(v->back, d) : 1.0f, size = (float)v->frame_width;
    if (!(unit > 0.0f)) {
        return 0;
    }
    *x = (dot3(v->right, d) / (unit * v->half_width) * 0.5f + 0.5f) * size;
    *y = (0.5f - dot3(v->up, d) / (unit * v->half_height) * 0.5f) * size;
    return 1;
}

/* Depth of a plane over a place of a face: (c + cx x + cy y) / (d + dx x + dy y) m, with x and y in texels. */
typedef struct map_plane {
    float c, cx, cy, d, dx, dy;
} map_plane;

static map_plane plane_over_texels(const lmb_view *v, const lmb_receiver *r)
{
    const float size = (float)v->frame_width, right = dot3(r->face, v->right) * v->half_width,
                up = dot3(r->face, v->up) * v->half_height, ahead = -dot3(r->face, v->back),
                height = dot3(r->face, sub3(r->position, v->eye)), x = 2.0f * right / size, y = -2.0f * up / size;
    const map_plane seen = {height, 0.0f, 0.0f, ahead - right + up, x, y},
                    level = {height + right - up, -x, -y, ahead, 0.0f, 0.0f};
    return v->kind == LMB_PERSPECTIVE ? seen : level;
}

/* The places of the corners of triangle `id` in a face. */
static void find_own_tips(lmb_shadow_query *query, const lit_place *at, uint32_t id)
{
    lmb_own_tips *t = &query->tips;
    lmb_triangle own;
    t->id = id;
    t->face = at->face;
    t->reach = 0.0f;
    if (lmb_triangle_fetch(&own, query->scene, id) && place_on_map(&t->x[0], &t->y[0], at->view, own.corner[0]) &&
        place_on_map(&t->x[1], &t->y[1], at->view, own.corner[1]) &&
        place_on_map(&t->x[2], &t->y[2], at->view, own.corner[2])) {
        const float wide = maxf(maxf(t->x[0], t->x[1]), t->x[2]) - minf(minf(t->x[0], t->x[1]), t->x[2]),
                    high = maxf(maxf(t->y[0], t->y[1]), t->y[2]) - minf(minf(t->y[0], t->y[1]), t->y[2]);
        t->reach = maxf(wide, high);
    }
}

/* Returns 1 if the tip of another triangle shadows the receiver. Call it if none of the four texels around the place
 * shows the receiver's own triangle. */
NOINLINE int is_in_tip(lmb_shadow_query *query, const lmb_receiver *r, const lit_place *at)
{
    const lmb_view *v = at->view;
    const float size = (float)v->frame_width, noise = noise_of_receiver(query, r);
    const lmb_own_tips *own = &query->tips;
    float x[3], y[3], away[3];
    uint32_t asked[MAX_TIPS_ASKED], count = 0;
    if (own->id != r->id || own->face != at->face) {
        find_own_tips(query, at, r->id);
    }
    if (!(own->reach >= MIN_TIP_REACH)) {
        return 0;
    }
    for (int c = 0; c < 3; ++c) {
        x[c] = at->x - own->x[c];
        y[c] = at->y - own->y[c];
        away[c] = x[c] * x[c] + y[c] * y[c];
    }
    const map_plane plane = plane_over_texels(v, r);
    for (int turn = 0; turn < 3; ++turn) { /* the nearest corner first */
        const int c = away[0] <= away[1] && away[0] <= away[2] ? 0 : away[1] <= away[2] ? 1 : 2;
        const float scale = 1.0f / maxf(sqrtf(away[c]), 1e-3f);
        float step = 1.0f;
        away[c] = FLT_MAX;
        for (int i = 0; i < MAX_TIP_STEPS && step < own->reach; ++i, step *= 2.0f) {
            const float to_x = at->x + x[c] * scale * step, to_y = at->y + y[c] * scale * step;
            if (!(to_x >= 0.0f && to_y >= 0.0f && to_x < size && to_y < size)) {
                break;
            }
            const uint32_t column = (uint32_t)to_x, row = (uint32_t)to_y, id = texel_id(&query->window, column, row);
            uint32_t k = 0;
            if (id == r->id) {
                return 0; /* the light reaches the triangle nearby */
            }
            while (k < count && asked[k] != id) {
                ++k;
            }
            if (id == 0 || k < count || k == MAX_TIPS_ASKED) {
                continue;
            }
            const float px = (float)column + 0.5f, py = (float)row + 0.5f;
            if (lmb_depth_view_z(v, texel_depth(&query->window, column, row)) + noise <
                (plane.c + plane.cx * px + plane.cy * py) / (plane.d + plane.dx * px + plane.dy * py)) {
                asked[count++] = id;
                if (ask_triangle(query, id, r, at, noise) == TEXEL_SHADOWS) {
                    return 1;
                }
            }
        }
        if (count == 0) {
            return 0; /* nothing in front of the receiver's plane */
        }
    }
    return 0;
}

#endif

#if LMB_FACETS

/* --- pixels that the texels around them do not decide ------------------------------------------------------------- */

/* Returns 1 if one of the four texels around the place shows a surface in front of the receiver's plane. Otherwise the
 * surface is flat or convex around the place, and a triangle that shadows the place rarely misses all four. */
static int is_behind_some(lmb_shadow_query *query, const lmb_receiver *r)
{
    lit_place at;
    if (!find_place(&at, query->map, query->light, r->position)) {
        return 0;
    }
    use_face(query, &at);
    const lmb_view *v = at.view;
    const int is_wide = v->kind == LMB_PERSPECTIVE;
    const float noise = noise_of_receiver(query, r), left = at.x - 0.5f, top = at.y - 0.5f; /* above -1 */
    const map_plane plane = plane_over_texels(v, r);
    const float side = plane.d + plane.dx * at.x + plane.dy * at.y < 0.0f ? 1.0f : -1.0f;
    const int32_t x0 = (int32_t)left - (left < 0.0f), y0 = (int32_t)top - (top < 0.0f), last = query->map->size - 1;
    for (int q = 0; q < 4; ++q) {
        const int32_t x = mini(maxi(x0 + (q & 1), 0), last), y = mini(maxi(y0 + (q >> 1), 0), last);
        const float d = texel_depth(&query->window, (uint32_t)x, (uint32_t)y), px = (float)x + 0.5f,
                    py = (float)y + 0.5f, slope = plane.d + plane.dx * px + plane.dy * py;
        const float z = is_wide ? v->near_m / d : v->far_m - d * (v->far_m - v->near_m);
        if (d != 0.0f &&
            side * (slope * z - (plane.c + plane.cx * px + plane.cy * py)) > noise * absf(slope)) {
            return 1;
        }
    }
    return 0;
}

enum { MAX_FEW_LIT = 16 };

/* Returns 1 if the map is sure of no lit pixel of a tile, or few are lit. */
static int has_few_lit(const lmb_lit_pixels *l)
{
    return (l->lit & ~(l->doubtful | l->beside)) == 0 || count_bits_64(l->lit) <= MAX_FEW_LIT;
}

uint64_t lmb_shadow_unsure(lmb_shadow_query *query, const lmb_tile *tile, const lmb_lit_pixels *found, int is_brief)
{
    const uint64_t more = found->lit & (found->lit - 1); /* than one */
    uint64_t out = 0, asked = found->doubtful;
    if ((more & (more - 1)) == 0) {
        return found->lit;
    }
    if (found->beside != 0 && has_few_lit(found)) {
        asked |= found->beside;
    }
    if (!is_brief) {
        return asked;
    }
    for (; asked != 0; asked &= asked - 1) {
        const int k = lowest_bit_64(asked);
        const lmb_receiver r = {tile_vec(tile->position, k), tile_vec(tile->face, k), tile->id[k]};
        out |= (uint64_t)is_behind_some(query, &r) << k;
    }
    return out;
}

#endif

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
        return (over || lit_by_depth(query, &at, r, noise)) && !is_in_tip(query, r, &at) ? LMB_LIT_IN_DOUBT : 0;
    }
    return LMB_LIT_BESIDE;
#else
    return over || lit_by_depth(query, &at, r, noise);
#endif
}

#if LMB_SHADOW_LANES

/* --- a tile ------------------------------------------------------------------------------------------------------- */

static lmb_receiver receiver_in_tile(const lmb_tile *tile, int k)
{
    const lmb_receiver r = {tile_vec(tile->position, k), tile_vec(tile->face, k), tile->id[k]};
    return r;
}

static int is_lit_at(lmb_shadow_query *query, const lmb_tile *tile, int k)
{
    const lmb_receiver r = receiver_in_tile(tile, k);
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

/* Masks of LMB_SHADOW_PIXELS pixels, as in lmb_lit_pixels. unclear: those that need lmb_is_lit. */
typedef struct shadow_lit {
    uint32_t lit, doubtful, beside, unclear;
} shadow_lit;

/* Returns the pixels that tips of triangles shadow, among lit ones around which the map shows only other triangles. */
NOINLINE uint32_t in_tips(lmb_shadow_query *query, const lmb_tile *tile, int first, uint32_t doubtful)
{
    uint32_t out = 0;
    for (; doubtful != 0; doubtful &= doubtful - 1) {
        const int k = lowest_bit(doubtful);
        const lmb_receiver r = receiver_in_tile(tile, first + k);
        lit_place at;
        if (find_place(&at, query->map, query->light, r.position)) {
            use_face(query, &at);
            out |= (uint32_t)is_in_tip(query, &r, &at) << k;
        }
    }
    return out;
}

NOINLINE shadow_lit lit_of_some(const lmb_shadow_query *query, const lmb_kernels *kernels, const lmb_tile *tile,
                                int first, uint32_t asked)
{
    uint32_t seen[4][LMB_SHADOW_PIXELS], in;
    shadow_lit out = {0, 0, 0, 0};
    for (uint32_t left = asked; left != 0; left &= ~in) {
        const int k = lowest_bit(left);
        const int32_t f =
            shadow_map_face(query->map, sub3(tile_vec(tile->position, first + k), query->light->position));
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
        out.beside |= lit & to.own;
        out.unclear |= some & ~clear;
        in |= 1u << k;
    }
    return out;
}

void lmb_shadow_lit(lmb_lit_pixels *out, lmb_shadow_query *query, const lmb_kernels *kernels, const lmb_tile *tile,
                    uint64_t asked)
{
    const int nested = query->map->faces > 1 && light_kind_is(query->light->kind, LIGHT_FAR);
    uint64_t unclear = nested ? asked : 0;
    out->lit = out->doubtful = out->beside = 0;
    for (int first = 0; first < LMB_TILE_PIXELS && !nested; first += LMB_SHADOW_PIXELS) {
        const uint32_t some = (uint32_t)(asked >> first) & ((1u << LMB_SHADOW_PIXELS) - 1);
        const shadow_lit l = lit_of_some(query, kernels, tile, first, some);
        out->lit |= (uint64_t)l.lit << first;
        out->doubtful |= (uint64_t)l.doubtful << first;
        out->beside |= (uint64_t)l.beside << first;
        unclear |= (uint64_t)l.unclear << first;
    }
    for (int first = 0; first < LMB_TILE_PIXELS && out->doubtful != 0; first += LMB_SHADOW_PIXELS) {
        const uint32_t some = (uint32_t)(out->doubtful >> first) & ((1u << LMB_SHADOW_PIXELS) - 1);
        const uint64_t dark = some != 0 ? (uint64_t)in_tips(query, tile, first, some) << first : 0;
        out->lit &= ~dark;
        out->doubtful &= ~dark;
    }
    for (; unclear != 0; unclear &= unclear - 1) {
        const int k = lowest_bit_64(unclear), lit = is_lit_at(query, tile, k);
        out->lit |= (uint64_t)(lit != 0) << k;
        out->doubtful |= (uint64_t)(lit == LMB_LIT_IN_DOUBT) << k;
        out->beside |= (uint64_t)(lit == LMB_LIT_BESIDE) << k;
    }
}

#endif
