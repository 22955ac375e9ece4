/* tree.c: a shadow map -> first points, and their sums upward. Layer 6.                             [V5 V6 V7 V15] */
#include "tree.h"

#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "../direct/footprint.h"
#include "../direct/texel.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "box.h"
#include "facets.h"

#if LMB_TREES

#define COSINE_ROUNDING 3e-7f /* of a cosine */
enum { NO_PIXEL = -1 };
#define GOLDEN_STEP 40503u /* 2^16 / 1.618034 */

size_t lmb_tree_bytes(uint32_t faces, int32_t size)
{
    if (size < LMB_TILE || size > 4096 || (size & (size - 1)) != 0 || faces == 0 || faces > 65535u) {
        return 0;
    }
    const size_t face = (size_t)size * (size_t)size * sizeof(lmb_texel) + tree_nodes(size) * sizeof(lmb_node) +
                        sizeof(lmb_view) + sizeof(lmb_target);
    return faces > (size_t)-1 / face ? 0 : faces * face;
}

lmb_status lmb_tree_init(lmb_tree *out, uint32_t faces, int32_t size, void *memory, size_t bytes)
{
    const size_t needed = lmb_tree_bytes(faces, size);
    const lmb_status status = check_array(out, memory, bytes, needed);
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->size = size;
    out->face_cap = faces;
    out->texel = (lmb_texel *)memory;
    out->node = (lmb_node *)(void *)(tree_shown(out) + faces);
    out->view = (lmb_view *)(void *)(out->node + faces * tree_nodes(size));
    return LMB_OK;
}

/* --- texels ------------------------------------------------------------------------------------------------------- */

/* 1 if a point moved along a plane by no more than a footprint may stretch. Near the plane's horizon it moves away from
 * the light or behind it; in a plane that a sun sees edge-on it moves along the rays. 0 for NaN. */
static int is_near_by(const lmb_view *v, lmb_vec3 from, lmb_vec3 to, int32_t size)
{
    const int is_cone = v->kind == LMB_PERSPECTIVE;
    const float w = is_cone ? dot3(v->back, sub3(v->eye, from)) : 1.0f;
    const float moved = is_cone ? dot3(v->back, sub3(v->eye, to)) : 1.0f;
    return moved > 0.5f * w && length3(sub3(to, from)) * GRAZE < 2.0f * v->half_width / (float)size * w;
}

/* The point in the plane of pixel k over the centre of a texel of the map. */
static lmb_vec3 at_middle(const lmb_tile *t, int k, const lmb_view *v, float sx, float sy)
{
    return footprint_over(v, tile_vec(t->position, k), tile_vec(t->face, k), sx, sy);
}

/* 1 if the surface of pixel k meets that of another pixel before a point in the plane of k. That is so if the way to
 * the point crosses the other plane: in a corner the point is behind a wall, and on a ridge it is in the air. Crossings
 * below rounding do not count, because they block nothing. */
static int surface_ends_before(const lmb_tile *t, int k, int other, const lmb_view *v, lmb_vec3 place)
{
    const lmb_vec3 normal = tile_vec(t->face, other), on = tile_vec(t->position, other);
    const float here = dot3(normal, sub3(tile_vec(t->position, k), on)), there = dot3(normal, sub3(place, on));
    return here * there < 0.0f && absf(there) > lmb_place_noise(place, length3(sub3(place, v->eye)));
}

/* Of the four pixels around a texel's centre, of which k is the last, returns one with a surface that shows at the
 * centre; NO_PIXEL if unknown. If surfaces lie in front of each other and do not meet, any will do. at_end: pixels at
 * the end of their surface, from lmb_tile_onto_triangles. */
static int pixel_of_middle(const lmb_tile *t, uint64_t at_end, int k, const lmb_view *v, float sx, float sy)
{
    const int around[4] = {k, k - 1, k - LMB_TILE, k - LMB_TILE - 1};
    for (int i = 0; i < 4; ++i) {
        const lmb_vec3 place = at_middle(t, around[i], v, sx, sy);
        int ends = t->id[around[i]] == 0 || (at_end >> around[i] & 1u);
        for (int j = 0; j < 4 && !ends; ++j) {
            ends = t->id[around[j]] != 0 && surface_ends_before(t, around[i], around[j], v, place);
        }
        if (!ends) {
            return around[i];
        }
    }
    return NO_PIXEL;
}

/* 1 if the surfaces of pixels a and b are connected, flat or bent. */
static int plane_goes_on(const lmb_tile *t, int a, int b, const lmb_view *v, float sx, float sy)
{
    if (t->id[a] == t->id[b] || t->id[a] == 0 || t->id[b] == 0) {
        return t->id[a] == t->id[b];
    }
    const lmb_vec3 d = sub3(tile_vec(t->position, a), tile_vec(t->position, b)), n = tile_vec(t->face, b);
    const float height = dot3(n, d);
    return (dot3(n, tile_vec(t->face, a)) >= TILE_COS_25 && height * height <= TILE_FLAT * TILE_FLAT * dot3(d, d)) ||
           surface_ends_before(t, a, b, v, at_middle(t, a, v, sx, sy));
}

/* 0 .. 2^16 - 1, uniform along each row and each column. Bits are reversed along columns, so that values do not alias
 * along a slanted line as plain multiples do. */
static uint32_t turn_of(int32_t x, int32_t y)
{
    static const uint8_t reversed[8] = {0, 4, 2, 6, 1, 5, 3, 7};
    const uint32_t down = (uint32_t)reversed[y & 7] << 13 | (uint32_t)reversed[y >> 3 & 7] << 10;
    return (down + (uint32_t)x * GOLDEN_STEP) & 0xffffu;
}

/* A texel takes the surface at its centre, pixel own, or a surface in front of or behind it, in proportion to its
 * pixels. Otherwise an edge along the map's axes is off along the whole length, and a pillar of three texels loses a
 * sixth of its light. */
static int pixel_in_turn(const lmb_tile *t, int own, int k, int32_t each, const lmb_view *v, int32_t x, int32_t y,
                         float sx, float sy)
{
    const int first = k - each / 2 * (LMB_TILE + 1), pixels = each * each;
    uint64_t apart = 0;
    for (int i = 0; i < pixels; ++i) {
        const int at = first + i / each * LMB_TILE + i % each;
        apart |= (uint64_t)!plane_goes_on(t, at, own, v, sx, sy) << at;
    }
    int turn = (int)(turn_of(x, y) * (uint32_t)pixels >> 16);
    for (; turn > 0 && apart != 0; --turn) {
        apart &= apart - 1;
    }
    return apart != 0 ? lowest_bit_64(apart) : own;
}

/* The pixel for a texel, and whether that pixel's plane extends to the texel's centre. k: the last of the four around
 * the centre. */
static int choose_pixel(int *goes, const lmb_tile *t, uint64_t at_end, int k, const lmb_shadow_map *coarse,
                        int32_t face, int32_t x, int32_t y, float sx, float sy)
{
    const lmb_view *v = &coarse->view[face];
    const int32_t each = coarse->face[face].id.width / coarse->size;
    if (each == 1) {
        *goes = !(at_end >> k & 1u);
        return k;
    }
    const int found = pixel_of_middle(t, at_end, k, v, sx, sy), own = found != NO_PIXEL ? found : k;
    const int turn = pixel_in_turn(t, own, k, each, v, x, y, sx, sy);
    *goes = found != NO_PIXEL && turn == own;
    return turn;
}

/* Sets a texel of the tree: at the centre, or at a pixel if the plane of the pixel is edge-on or ends before the
 * centre. */
static void set_texel(lmb_texel *out, const lmb_tile *t, uint64_t at_end, int k, const lmb_light *light,
                      const lmb_shadow_map *coarse, int32_t tests, int32_t face, int32_t x, int32_t y)
{
    const lmb_view *v = &coarse->view[face];
    const float size = (float)coarse->size, sx = ((float)(2 * x + 1) / size - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * y + 1) / size) * v->half_height;
    float power[3];
    int goes;
    const int own = choose_pixel(&goes, t, at_end, k, coarse, face, x, y, sx, sy);
    memset(out, 0, sizeof *out);
    memset(out->side, SIDE_WHOLE, sizeof out->side);
    if (t->id[own] == 0) {
        return;
    }
    lmb_light_texel_power(power, light, coarse, face, x, y);
    out->normal = tile_vec(t->face, own);
    out->position = tile_vec(t->position, own);
    const lmb_vec3 moved = at_middle(t, own, v, sx, sy);
    if (goes && is_near_by(v, out->position, moved, coarse->size)) {
        out->position = moved;
    }
    light_end_power(power, light, out->position);
    for (int c = 0; c < 3; ++c) {
        out->flux[c] = flux_or_none(power[c] * t->albedo[c][own]);
    }
    (void)tests;
#if LMB_FACETS
    const int32_t each = coarse->face[face].id.width / coarse->size;
    if (each > 1) {
        lmb_facets_mark(out, t, own, k - each / 2 * (LMB_TILE + 1), each, v, coarse->size, tests);
    }
#endif
}

static int divides(int32_t small, int32_t large)
{
    return large == small || large == 2 * small || large == 4 * small || large == 8 * small;
}

lmb_status lmb_tree_texels(const lmb_tree *tree, const lmb_kernels *kernels, lmb_tile *scratch, const lmb_scene *scene,
                           const lmb_light *light, const lmb_shadow_map *map, int32_t face, uint32_t into,
                           int32_t first, int32_t past)
{
    lmb_status status = LMB_OK;
    if (tree == NULL || tree->texel == NULL || kernels == NULL || scratch == NULL || scene == NULL || light == NULL ||
        map == NULL || face < 0 || face >= map->faces || !divides(tree->size, map->size) || first < 0 || past < first ||
        past > map->size / LMB_TILE) {
        return LMB_ERR_ARG;
    }
    if (into >= tree->face_cap) {
        return LMB_ERR_CAPACITY;
    }
    const int32_t size = tree->size, each = map->size / size;
    lmb_shadow_map coarse = *map;
    coarse.size = size;
    if (first == 0 && past > 0) { /* by one part only: with few rows, many parts have none */
        tree->view[into] = map->view[face];
        tree_shown(tree)[into] = map->face[face];
    }
    for (int32_t i = first * map->size; i < past * map->size && status == LMB_OK; i += LMB_TILE) {
        const int32_t x0 = i % map->size, y0 = i / map->size * LMB_TILE;
        status = lmb_resolve_tile(scratch, kernels, &map->view[face], scene, &map->face[face], x0, y0);
        const uint64_t at_end = status == LMB_OK ? lmb_tile_onto_triangles(scratch, scene) : 0;
        for (int k = 0; k < LMB_TILE_PIXELS && status == LMB_OK; ++k) {
            const int32_t x = x0 + k % LMB_TILE, y = y0 + k / LMB_TILE;
            if (x % each == each / 2 && y % each == each / 2) {
                set_texel(&tree->texel[((size_t)into * (size_t)size + (size_t)(y / each)) * (size_t)size +
                                       (size_t)(x / each)],
                          scratch, at_end, k, light, &coarse, tree->tests, face, x / each, y / each);
            }
        }
    }
    return status;
}

/* --- a texel's quad ----------------------------------------------------------------------------------------------- */

static const uint8_t whole_sides[4] = {SIDE_WHOLE, SIDE_WHOLE, SIDE_WHOLE, SIDE_WHOLE};

static const uint8_t *sides_of(const lmb_texel *t) { return facets_are_several(t) ? whole_sides : t->side; }

/* Box of the texel's cell, and of cells of neighbours that it may have a part in. u, v: whole sides. */
static void set_texel_box(lmb_node *out, const lmb_texel *t, lmb_vec3 u, lmb_vec3 v)
{
    const uint8_t *side = sides_of(t);
    float reach[4];
    for (int i = 0; i < 4; ++i) {
        reach[i] = side[i] == SIDE_WHOLE ? 0.5f : 1.5f;
    }
    const float right = reach[SIDE_RIGHT] - reach[SIDE_LEFT], up = reach[SIDE_UP] - reach[SIDE_DOWN];
    const lmb_vec3 centre = add3(t->position, mul3(add3(mul3(u, right), mul3(v, up)), 0.5f));
    u = mul3(u, 0.5f * (reach[SIDE_LEFT] + reach[SIDE_RIGHT]));
    v = mul3(v, 0.5f * (reach[SIDE_UP] + reach[SIDE_DOWN]));
    out->middle = centre;
    out->across = box_across(t->normal, longer3(u, v));
    const lmb_vec3 axis[3] = {t->normal, out->across, cross3(t->normal, out->across)};
    for (int i = 0; i < 3; ++i) {
        out->half[i] = absf(dot3(axis[i], u)) + absf(dot3(axis[i], v));
    }
    out->radius = sqrtf(dot3(u, u) + dot3(v, v) + 2.0f * absf(dot3(u, v)));
}

/* Extent of a box along a direction from its middle. */
static float reach_of_node(const lmb_node *n, lmb_vec3 along)
{
    const float box = absf(dot3(n->normal, along)) * n->half[0] + absf(dot3(n->across, along)) * n->half[1] +
                      absf(dot3(cross3(n->normal, n->across), along)) * n->half[2];
    return minf(box, n->radius);
}

/* Extends the box of a texel in which several surfaces show to all of them. */
static void add_facets_box(lmb_node *inout, const lmb_texel *t, const lmb_view *v, int32_t size)
{
    const facets_extent e = facets_extent_of(t, v, size);
    const lmb_vec3 middle = add3(t->position, mul3(e.ray, 0.5f * (e.up - e.down)));
    box_span box = box_begin(inout->middle, t->normal, box_across(t->normal, e.ray));
    for (int i = 0; i < 3; ++i) {
        box_add(&box, i, 0.0f, reach_of_node(inout, box.axis[i]));
        box_add(&box, i, dot3(box.axis[i], sub3(middle, inout->middle)),
                0.5f * (e.up + e.down) * absf(dot3(box.axis[i], e.ray)) + e.wide);
    }
    inout->middle = box_middle(&box);
    inout->across = box.axis[1];
    for (int i = 0; i < 3; ++i) {
        inout->half[i] = box_half(&box, i);
    }
    inout->radius = length3(vec3(inout->half[0], inout->half[1], inout->half[2]));
    inout->cosine = facets_cosine(t);
}

/* For several joined specks, the box of the largest one; only specks beside it are left out. */
static void set_element_box(lmb_node *out, const lmb_texel *t, const lmb_element *e)
{
    const lmb_vec3 a = sub3(e->corner[1], e->corner[0]), b = sub3(e->corner[2], e->corner[0]);
    box_span box = box_begin(t->position, t->normal, box_across(t->normal, longer3(longer3(a, b), sub3(a, b))));
    box_add_point(&box, t->position);
    for (int i = 0; i < 3; ++i) {
        box_add_point(&box, e->corner[i]);
    }
    out->middle = box_middle(&box);
    out->across = box.axis[1];
    out->radius = length3(sub3(t->position, out->middle));
    for (int i = 0; i < 3; ++i) {
        out->half[i] = box_half(&box, i);
        out->radius = maxf(out->radius, length3(sub3(e->corner[i], out->middle)));
    }
}

/* boxed: also computes the box of a whole texel's light. */
static int texel_quad(lmb_node *out, lmb_vec3 *u, lmb_vec3 *v, const lmb_tree *tree, uint32_t face, int32_t x,
                      int32_t y, int boxed)
{
    const lmb_texel *t = tree_texel(tree, face, x, y);
    const lmb_element *element = tree_element(tree, x, y);
    memset(out, 0, sizeof *out);
    *u = *v = vec3(0, 0, 0);
    if (!(flux_sum(t->flux) > 0.0f)) {
        return 0;
    }
    out->normal = t->normal;
    out->cosine = out->agreement = 1.0f;
    out->texel = (uint32_t)y * (uint32_t)tree->size + (uint32_t)x;
    if (element != NULL) {
        out->centre = t->position;
        set_element_box(out, t, element);
        memcpy(out->flux, t->flux, sizeof out->flux);
        out->area = element->area;
        return 0;
    }
    const uint8_t *side = sides_of(t);
    const int several = side == whole_sides, is_whole = several || tree_is_whole(t);
    const float wide = (float)(side[SIDE_LEFT] + side[SIDE_RIGHT]), right = (float)(side[SIDE_RIGHT] - side[SIDE_LEFT]),
                high = (float)(side[SIDE_UP] + side[SIDE_DOWN]), down = (float)(side[SIDE_DOWN] - side[SIDE_UP]);
    footprint_sides(u, v, &tree->view[face], tree->size, t->position, t->normal);
    if (boxed || !is_whole) {
        set_texel_box(out, t, *u, *v);
    }
    if (boxed && several) {
        add_facets_box(out, t, &tree->view[face], tree->size);
    }
    out->centre = add3(t->position, sub3(mul3(*u, right / 512.0f), mul3(*v, down / 512.0f)));
    *u = mul3(*u, wide / 512.0f);
    *v = mul3(*v, high / 512.0f);
    float share = 1.0f;
    int is_crease = 0;
    out->area = 4.0f * length3(cross3(*u, *v));
    if (!is_whole) {
        const float rectangle = wide * high / 65536.0f;
        is_crease = t->share >= 0.0f;
        share = is_crease ? t->share : rectangle;
        out->area *= share / rectangle;
    }
    for (int c = 0; c < 3; ++c) {
        out->flux[c] = t->flux[c] * share;
    }
    return is_crease;
}

int lmb_tree_texel_quad(lmb_node *out, lmb_vec3 *u, lmb_vec3 *v, const lmb_tree *tree, uint32_t face, int32_t x,
                        int32_t y)
{
    return texel_quad(out, u, v, tree, face, x, y, 0);
}

void lmb_tree_texel_node(lmb_node *out, const lmb_tree *tree, uint32_t face, int32_t x, int32_t y)
{
    lmb_vec3 u, v;
    texel_quad(out, &u, &v, tree, face, x, y, 1);
}

/* --- sums --------------------------------------------------------------------------------------------------------- */

/* cos(a + b), rounded down; -1 if a + b is over 180 degrees. */
static float cosine_of_sum(float a, float b)
{
    a -= COSINE_ROUNDING;
    b -= COSINE_ROUNDING;
    const float sines = sqrtf(maxf(1.0f - a * a, 0.0f) * maxf(1.0f - b * b, 0.0f));
    return a + b <= 0.0f ? -1.0f : clampf(a * b - sines, -1.0f, 1.0f);
}

/* 1 if all normals equal the first one bit by bit. */
static int is_node_flat(const lmb_node child[4], const lmb_node *first)
{
    int flat = 1;
    for (int i = 0; i < 4; ++i) {
        const lmb_vec3 a = child[i].normal, b = first->normal;
        flat &= !(flux_sum(child[i].flux) > 0.0f) ||
                (child[i].cosine == 1.0f && a.x == b.x && a.y == b.y && a.z == b.z);
    }
    return flat;
}

/* Direction in which the node's parts lie apart: left to right or top to bottom, whichever is longer; 0: one part. */
static lmb_vec3 mean_axis_of(const lmb_node child[4], const lmb_node *first)
{
    lmb_vec3 sum[4]; /* left, right, top, bottom */
    float count[4] = {0, 0, 0, 0};
    for (int i = 0; i < 4; ++i) {
        sum[i] = vec3(0, 0, 0);
    }
    for (int i = 0; i < 4; ++i) {
        if (flux_sum(child[i].flux) > 0.0f) {
            const lmb_vec3 at = sub3(child[i].middle, first->middle);
            sum[i & 1] = add3(sum[i & 1], at);
            sum[2 + (i >> 1)] = add3(sum[2 + (i >> 1)], at);
            count[i & 1] += 1.0f;
            count[2 + (i >> 1)] += 1.0f;
        }
    }
    lmb_vec3 way[2];
    for (int i = 0; i < 2; ++i) {
        const float from = count[2 * i], to = count[2 * i + 1];
        way[i] = from * to > 0.0f ? sub3(mul3(sum[2 * i + 1], 1.0f / to), mul3(sum[2 * i], 1.0f / from))
                                  : vec3(0, 0, 0);
    }
    return longer3(way[0], way[1]);
}

static void join_boxes(lmb_node *out, const lmb_node child[4], const lmb_node *first)
{
    const lmb_vec3 way = mean_axis_of(child, first);
    box_span box = box_begin(first->middle, out->normal,
                             box_across(out->normal, dot3(way, way) > 0.0f ? way : first->across));
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3 && flux_sum(child[i].flux) > 0.0f; ++k) {
            box_add(&box, k, dot3(box.axis[k], sub3(child[i].middle, box.from)), reach_of_node(&child[i], box.axis[k]));
        }
    }
    out->middle = box_middle(&box);
    out->across = box.axis[1];
    for (int i = 0; i < 3; ++i) {
        out->half[i] = box_half(&box, i);
    }
    for (int i = 0; i < 4; ++i) {
        if (flux_sum(child[i].flux) > 0.0f) {
            out->radius = maxf(out->radius, length3(sub3(child[i].middle, out->middle)) + child[i].radius);
        }
    }
    out->radius = minf(out->radius, length3(vec3(out->half[0], out->half[1], out->half[2])));
}

static void merge(lmb_node *out, const lmb_node child[4], const lmb_tree *tree, uint32_t face)
{
    lmb_vec3 normal = vec3(0, 0, 0), centre = vec3(0, 0, 0), origin = vec3(0, 0, 0);
    const lmb_node *first = NULL;
    float weight = 0.0f, nearest = 3e38f;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 4; ++i) {
        const lmb_node *n = &child[i];
        const float w = flux_sum(n->flux);
        if (w > 0.0f) {
            first = first != NULL ? first : n;
            origin = first->centre; /* differences, so that no precision is lost far from the origin */
            centre = add3(centre, mul3(sub3(n->centre, origin), w));
            normal = add3(normal, mul3(n->normal, w * n->agreement));
            weight += w;
            out->area += n->area;
            for (int c = 0; c < 3; ++c) {
                out->flux[c] += n->flux[c];
            }
        }
    }
    if (first == NULL) {
        return;
    }
    const int flat = is_node_flat(child, first);
    out->centre = add3(origin, mul3(centre, 1.0f / weight));
    out->cosine = dot3(normal, normal) > 1e-37f ? 1.0f : -1.0f;
    out->normal = flat || out->cosine < 0.0f ? first->normal : normalize3(normal);
    out->agreement = flat ? 1.0f : minf(length3(normal) / weight, 1.0f);
    join_boxes(out, child, first);
    for (int i = 0; i < 4; ++i) {
        if (flux_sum(child[i].flux) > 0.0f) {
            const uint32_t size = (uint32_t)tree->size, at = child[i].texel;
            const lmb_vec3 d =
                sub3(tree_texel(tree, face, (int32_t)(at % size), (int32_t)(at / size))->position, out->centre);
            const float turn = clampf(dot3(out->normal, child[i].normal), -1.0f, 1.0f);
            out->cosine = flat ? 1.0f : minf(out->cosine, cosine_of_sum(turn, child[i].cosine));
            if (dot3(d, d) < nearest) {
                nearest = dot3(d, d);
                out->texel = at;
            }
        }
    }
}

/* Stores how much light of texels in which planes meet is their own. Each node with such a texel reads it. */
static void set_face_shares(const lmb_tree *tree, uint32_t face)
{
    lmb_texel *all = tree->texel + (size_t)face * (size_t)tree->size * (size_t)tree->size;
    for (int32_t i = 0; i < tree->size * tree->size; ++i) {
        if (flux_sum(all[i].flux) > 0.0f && !facets_are_several(&all[i]) && !tree_is_whole(&all[i])) {
            const lmb_node_ref at = {(uint16_t)face, (uint16_t)(i % tree->size), (uint16_t)(i / tree->size), 0};
            all[i].share = lmb_crease_share(tree, at);
        }
    }
}

lmb_status lmb_tree_sum(const lmb_tree *tree, uint32_t face)
{
    if (tree == NULL || tree->texel == NULL || face >= tree->face_cap) {
        return LMB_ERR_ARG;
    }
    if (tree->element == NULL) {
        lmb_crease_find(tree, face);
        set_face_shares(tree, face);
    }
    for (int level = 1; level <= tree_root_level(tree); ++level) {
        const int32_t side = tree->size >> level;
        lmb_node *out = tree_level(tree, face, level);
        const lmb_node *below = level > 1 ? tree_level(tree, face, level - 1) : NULL;
        for (int32_t y = 0; y < side; ++y) {
            for (int32_t x = 0; x < side; ++x) {
                lmb_node child[4];
                for (int32_t i = 0; i < 4; ++i) {
                    const int32_t cx = 2 * x + (i & 1), cy = 2 * y + (i >> 1);
                    if (below != NULL) {
                        child[i] = below[cy * 2 * side + cx];
                    } else {
                        lmb_tree_texel_node(&child[i], tree, face, cx, cy);
                    }
                }
                merge(&out[y * side + x], child, tree, face);
            }
        }
    }
    return LMB_OK;
}

#endif
