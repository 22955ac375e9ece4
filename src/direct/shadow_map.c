/* shadow_map.c: a shadow map: fits its views, draws its faces, and computes the power through a texel. Layer 4. */
#include <lambent/map.h>

#include <string.h>

#include "../base/light_kind.h"
#include "../base/memory_check.h"
#include "../base/vec.h"
#include "../base/vertex.h"
#include "../raster/target.h"
#include "part.h"
#include "texel.h"

#define LANE_ONE
#define KERNEL(name) name##_of_one
#include "../lane/lane_scalar.h"
#include "../lane/lane.h"
#include "texel.inl"

#define COS_50 0.64278761f   /* half angle up to which a spot has a single perspective face */
#define COS_CORNER 0.57735027f /* of the angle between axis and corner of a cube face */
#define SIN_CORNER 0.81649658f

int32_t lmb_shadow_map_faces(const lmb_light *light, const lmb_scene *scene)
{
    if (light == NULL || scene == NULL) {
        return 0;
    }
    if (light_kind_is(light->kind, LIGHT_FAR)) {
        return LMB_TREES ? maxi(scene->core.faces, 1) : 1;
    }
    const int is_narrow = light_kind_is(light->kind, LIGHT_CONED) && !(light->cos_outer < COS_50);
    return light_kind_is(light->kind, LIGHT_PLACED) && !is_narrow ? 6 : 1;
}

static int is_map(int32_t size, int32_t id_format)
{
    return size >= LMB_TILE && size <= LMB_MAX_SIDE && size % LMB_TILE == 0 &&
           (id_format == LMB_ID16 || id_format == LMB_ID32);
}

size_t lmb_shadow_map_bytes(int32_t faces, int32_t size, int32_t id_format)
{
    if (!is_map(size, id_format) || faces < 1 || faces > 6) {
        return 0;
    }
    return (size_t)faces * (lmb_surface_bytes(LMB_DEPTH32F, size, size) + lmb_surface_bytes(id_format, size, size));
}

/* Axes of a view along `forward`: up is the world axis least along it. */
static void set_view_axes(lmb_view *v, lmb_vec3 forward)
{
    lmb_vec3 a = vec3(absf(forward.x), absf(forward.y), absf(forward.z));
    lmb_vec3 up = a.y <= a.x && a.y <= a.z ? vec3(0, 1, 0) : a.x <= a.z ? vec3(1, 0, 0) : vec3(0, 0, 1);
    v->back = mul3(forward, -1.0f);
    v->right = normalize3(cross3(up, v->back));
    v->up = cross3(v->back, v->right);
}

typedef struct light_box {
    lmb_vec3 low, high;
} light_box;

static float diagonal_of(lmb_vec3 low, lmb_vec3 high) { return maxf(length3(sub3(high, low)), 1e-24f); }

static light_box box_mix(lmb_vec3 low, lmb_vec3 high, lmb_vec3 wide_low, lmb_vec3 wide_high, float share)
{
    light_box b;
    b.low = add3(low, mul3(sub3(wide_low, low), share));
    b.high = add3(high, mul3(sub3(wide_high, high), share));
    return b;
}

/* Contents of face f of a sun's map: the core; boxes of a sixteenth of a sixteenth .. of the wide one's size; the wide
 * one; the whole scene. */
static light_box box_of_face(const lmb_scene *scene, int32_t f, int32_t faces)
{
    const light_box all = {scene->bounds_min, scene->bounds_max};
    if (!LMB_TREES || f == faces - 1) {
        return all;
    }
    const lmb_core *c = &scene->core;
    const lmb_vec3 more = add3(sub3(c->wide_low, all.low), sub3(all.high, c->wide_high));
    const int32_t last = faces - 1 - (largest3(more) > 0.0f); /* index of the wide one */
    const float core = largest3(sub3(c->high, c->low)), wide = largest3(sub3(c->wide_high, c->wide_low));
    float size = wide;
    for (int32_t i = f; i < last; ++i) {
        size *= 0.0625f;
    }
    return box_mix(c->low, c->high, c->wide_low, c->wide_high,
                   f == 0 || !(wide > core) ? 0.0f : clampf((size - core) / (wide - core), 0.0f, 1.0f));
}

static lmb_vec3 half_size_of_box(const light_box *b) { return mul3(sub3(b->high, b->low), 0.5f); }

/* Half the extent along an axis of a box of half extents `half`. */
static float reach_along(lmb_vec3 axis, lmb_vec3 half)
{
    return absf(axis.x) * half.x + absf(axis.y) * half.y + absf(axis.z) * half.z;
}

/* An orthographic view along the light's axes that contains the whole box. */
static void fit_directional(lmb_view *v, const lmb_light *light, const light_box *b)
{
    const lmb_vec3 half = half_size_of_box(b);
    const float margin = 1e-3f * diagonal_of(b->low, b->high);
    set_view_axes(v, light->direction);
    const float deep = reach_along(v->back, half) + margin;
    v->kind = LMB_ORTHOGRAPHIC;
    v->half_width = reach_along(v->right, half) + margin;
    v->half_height = reach_along(v->up, half) + margin;
    v->near_m = margin;
    v->far_m = margin + 2.0f * deep;
    v->eye = add3(mul3(add3(b->low, b->high), 0.5f), mul3(v->back, deep + margin));
}

#if LMB_TREES
/* The same for one of several boxes. The view is as deep as the scene, to contain casters above and receivers below.
 * The eye is at the box's centre, which keeps coordinates small. */
static void fit_part(lmb_view *v, const lmb_light *light, const light_box *b, const lmb_scene *scene)
{
    const light_box all = {scene->bounds_min, scene->bounds_max};
    fit_directional(v, light, b);
    v->eye = mul3(add3(b->low, b->high), 0.5f);
    const float up = dot3(v->back, sub3(mul3(add3(all.low, all.high), 0.5f), v->eye));
    const float deep = reach_along(v->back, half_size_of_box(&all)) + 1e-3f * diagonal_of(all.low, all.high);
    v->near_m = -up - deep;
    v->far_m = deep - up;
}

static int is_same_corner(lmb_vec3 a, lmb_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Extends the extents along a view's right, up and back, from the eye. */
static void widen_by(lmb_vec3 *low, lmb_vec3 *high, const lmb_view *v, lmb_vec3 p)
{
    const lmb_vec3 to = sub3(p, v->eye), at = vec3(dot3(v->right, to), dot3(v->up, to), dot3(v->back, to));
    *low = min3(*low, at);
    *high = max3(*high, at);
}

/* The single face of a sun's map, fitted to the vertices along the face's axes: with a box along world axes, texels
 * would be as much wider as the scene is rotated. If bounds are wider than the vertices, for moving objects or a
 * relief's surface, the map covers the bounds. */
static void fit_vertices(lmb_view *v, const lmb_scene *scene)
{
    const lmb_vec3 max = vec3(FLT_MAX, FLT_MAX, FLT_MAX), min = mul3(max, -1.0f);
    lmb_vec3 low = max, high = min, own_low = max, own_high = min;
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        const lmb_instance *in = &scene->instances[i];
        const lmb_mesh *mesh = &scene->meshes[in->mesh];
        for (uint32_t k = 0; k < mesh->vertex_count; ++k) {
            const lmb_vec3 p = transform_point(&in->to_world, mesh_position(mesh, k));
            if (is_place(p)) {
                own_low = min3(own_low, p);
                own_high = max3(own_high, p);
                widen_by(&low, &high, v, p);
            }
        }
    }
    if (!is_same_corner(own_low, scene->bounds_min) || !is_same_corner(own_high, scene->bounds_max)) {
        return;
    }
    const float margin = v->near_m;
    v->half_width = 0.5f * (high.x - low.x) + margin;
    v->half_height = 0.5f * (high.y - low.y) + margin;
    v->far_m = 3.0f * margin + (high.z - low.z);
    v->eye = add3(v->eye, add3(mul3(v->right, 0.5f * (low.x + high.x)),
                               add3(mul3(v->up, 0.5f * (low.y + high.y)), mul3(v->back, high.z + 2.0f * margin))));
}
#endif

#if LMB_TREES
#define MAX_FACE_WIDENING 1.25f /* limit for widening a face to end at a texel border of the next */

/* Along one axis: centre and half width of a face, relative to the centre of the next face with cells of width
 * `cell`. */
static int align_axis(float *middle, float *half, float whole, float cell)
{
    const float first = floorf((*middle - *half + whole) / cell),
                past = -floorf(-(*middle + *half + whole) / cell), wide = 0.5f * (past - first) * cell;
    if (!(wide <= MAX_FACE_WIDENING * *half)) {
        return 0;
    }
    *middle = (0.5f * (first + past)) * cell - whole;
    *half = wide;
    return 1;
}

/* Aligns the border of a face to texel borders of the next coarser face, for trees down to an eighth of the map's
 * resolution, or as far as the face widens only a little. */
static void align(lmb_view *inner, const lmb_view *outer, int32_t size)
{
    const lmb_vec3 to = sub3(inner->eye, outer->eye);
    const float x0 = dot3(outer->right, to), y0 = dot3(outer->up, to);
    for (int32_t texels = 8; texels > 0; texels /= 2) {
        const float cells = (float)(size / texels);
        float x = x0, y = y0, half_x = inner->half_width, half_y = inner->half_height;
        if (align_axis(&x, &half_x, outer->half_width, 2.0f * outer->half_width / cells) &&
            align_axis(&y, &half_y, outer->half_height, 2.0f * outer->half_height / cells)) {
            inner->half_width = half_x;
            inner->half_height = half_y;
            inner->eye = add3(inner->eye, add3(mul3(outer->right, x - x0), mul3(outer->up, y - y0)));
            return;
        }
    }
}
#endif

static void fit_spot(lmb_view *v, const lmb_light *light)
{
    float c = light->cos_outer;
    set_view_axes(v, light->direction);
    v->half_width = v->half_height = sqrtf(maxf(1.0f - c * c, 1e-8f)) / c;
}

/* Tolerance for a light in a ceiling that rounding puts behind it: relative to the room's size and to the distance from
 * the origin. */
static float nearest_shown(const lmb_light *light, const lmb_scene *scene)
{
    const lmb_core *c = &scene->core;
    const float size = LMB_TREES && c->faces > 0 ? diagonal_of(c->low, c->high)
                                                 : diagonal_of(scene->bounds_min, scene->bounds_max);
    return maxf(1e-5f * size, 9.5367432e-7f * largest3(light->position));
}

static lmb_vec3 cube_axis(int32_t face)
{
    float sign = face & 1 ? -1.0f : 1.0f;
    return vec3(face / 2 == 0 ? sign : 0.0f, face / 2 == 1 ? sign : 0.0f, face / 2 == 2 ? sign : 0.0f);
}

/* 1 if a spot's cone meets a face of a cube. That is so if the angle between the axes is at most the cone's half angle
 * plus the angle of the face's corner, a sum under 180 degrees; tested by the cosine of the sum. */
static int meets_face(const lmb_light *light, int32_t face)
{
    const float c = light->cos_outer, s = sqrtf(1.0f - c * c);
    return dot3(light->direction, cube_axis(face)) >= c * COS_CORNER - s * SIN_CORNER;
}

static void fit_views(lmb_shadow_map *map, const lmb_light *light, const lmb_scene *scene)
{
    map->drawn = 0;
    for (int32_t f = 0; f < map->faces; ++f) {
        lmb_view *v = &map->view[f];
        v->eye = light->position;
        v->kind = LMB_PERSPECTIVE;
        v->half_width = v->half_height = 1.0f;
        v->near_m = nearest_shown(light, scene);
        v->far_m = 0.0f;
        v->frame_width = v->frame_height = map->size;
        int meets = 1;
        if (light_kind_is(light->kind, LIGHT_FAR)) {
            const light_box b = box_of_face(scene, f, map->faces);
            fit_directional(v, light, &b);
#if LMB_TREES
            if (map->faces > 1) {
                fit_part(v, light, &b, scene);
            } else {
                fit_vertices(v, scene);
            }
#endif
        } else if (map->faces == 1) {
            fit_spot(v, light);
        } else {
            set_view_axes(v, cube_axis(f));
            meets = !light_kind_is(light->kind, LIGHT_CONED) || meets_face(light, f);
        }
        map->drawn |= (uint32_t)meets << f;
    }
#if LMB_TREES
    for (int32_t f = map->faces - 2; f >= 0 && light_kind_is(light->kind, LIGHT_FAR); --f) {
        align(&map->view[f], &map->view[f + 1], map->size);
    }
#endif
}

int32_t lmb_shadow_map_part(const lmb_shadow_map *map, lmb_vec3 at)
{
    int32_t f = 0;
    for (; LMB_TREES && f + 1 < map->faces; ++f) {
        const lmb_view *v = &map->view[f];
        const lmb_vec3 to = sub3(at, v->eye);
        const float edge = 1.0f - 4.0f / (float)map->size;
        if (absf(dot3(v->right, to)) < edge * v->half_width && absf(dot3(v->up, to)) < edge * v->half_height) {
            break;
        }
    }
    return f;
}

lmb_status lmb_shadow_map_init(lmb_shadow_map *out, const lmb_light *light, const lmb_scene *scene, int32_t size,
                               int32_t id_format, void *memory, size_t bytes)
{
    if (out == NULL || light == NULL || scene == NULL || !is_map(size, id_format)) {
        return LMB_ERR_ARG;
    }
    size_t depth_bytes = lmb_surface_bytes(LMB_DEPTH32F, size, size),
           id_bytes = lmb_surface_bytes(id_format, size, size);
    int32_t faces = lmb_shadow_map_faces(light, scene);
    lmb_status status = check_memory(memory, bytes, (size_t)faces * (depth_bytes + id_bytes));
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->faces = faces;
    out->size = size;
    for (int32_t f = 0; f < faces; ++f) {
        uint8_t *place = (uint8_t *)memory + (size_t)f * (depth_bytes + id_bytes);
        status = lmb_surface_init(&out->face[f].depth, LMB_DEPTH32F, size, size, place, depth_bytes);
        if (status == LMB_OK) {
            status = lmb_surface_init(&out->face[f].id, id_format, size, size, place + depth_bytes, id_bytes);
        }
        if (status != LMB_OK) {
            return status;
        }
    }
    fit_views(out, light, scene);
    return LMB_OK;
}

lmb_status lmb_shadow_map_clear(const lmb_shadow_map *map)
{
    if (map == NULL) {
        return LMB_ERR_ARG;
    }
    for (int32_t f = 0; f < map->faces; ++f) {
        lmb_surface_clear(&map->face[f].depth);
        lmb_surface_clear(&map->face[f].id);
    }
    return LMB_OK;
}

lmb_status lmb_shadow_map_draw(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene,
                               uint32_t first_id, uint32_t count, lmb_stats *stats)
{
    lmb_status status = map == NULL ? LMB_ERR_ARG : LMB_OK;
    for (int32_t f = 0; status == LMB_OK && f < map->faces; ++f) {
        if ((map->drawn >> f) & 1u) {
            status = lmb_draw(&map->face[f], kernels, &map->view[f], scene, first_id, count, 0, stats);
        }
    }
    return status;
}

/* Draws the tile rows from .. to - 1 of one face. */
static lmb_status draw_map_rows(const lmb_shadow_map *map, int32_t face, const lmb_kernels *kernels,
                                const lmb_scene *scene, int32_t from, int32_t to, lmb_stats *stats)
{
    lmb_target window;
    lmb_target_rows(&window, &map->face[face], from, to - from);
    lmb_surface_clear(&window.depth);
    lmb_surface_clear(&window.id);
    if (((map->drawn >> face) & 1u) == 0) {
        return LMB_OK;
    }
    return lmb_draw(&window, kernels, &map->view[face], scene, 1, UINT32_MAX - 1, 0, from == 0 ? stats : NULL);
}

lmb_status lmb_shadow_map_rows(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene,
                               int32_t first, int32_t past, lmb_stats *stats)
{
    lmb_status status = LMB_OK;
    if (map == NULL || kernels == NULL || scene == NULL || first < 0 || past < first ||
        past > map->faces * (map->size / LMB_TILE)) {
        return LMB_ERR_ARG;
    }
    const int32_t rows = map->size / LMB_TILE;
    for (int32_t f = 0; f < map->faces && status == LMB_OK; ++f) {
        const int32_t from = maxi(first - f * rows, 0), to = mini(past - f * rows, rows);
        if (from < to) {
            status = draw_map_rows(map, f, kernels, scene, from, to, stats);
        }
    }
    return status;
}

void lmb_texel_row_of(lmb_texel_row *out, const lmb_light *light, const lmb_shadow_map *map, int32_t face, int32_t y)
{
    const lmb_view *v = &map->view[face];
    memset(out, 0, sizeof *out);
    out->right = v->right;
    out->up = v->up;
    out->back = v->back;
    out->direction = light->direction;
    out->cos_outer = light->cos_outer;
    out->cone = light->cos_inner - light->cos_outer;
    out->side_x = 2.0f * v->half_width / (float)map->size;
    out->side_y = 2.0f * v->half_height / (float)map->size;
    out->sy = texel_sy(v, map->size, y);
    out->is_far = light_kind_is(light->kind, LIGHT_FAR);
    out->is_coned = light_kind_is(light->kind, LIGHT_CONED);
#if LMB_TREES
    /* Texels of a sun's map with their centre in a finer face are left to that face. The test uses only the centre:
     * faces usually end between texels (align), and otherwise the overlap with neighbours and the omitted light cancel
     * on average. A test by area would leave a dark ring around the face. */
    if (face > 0 && v->kind == LMB_ORTHOGRAPHIC) {
        const lmb_view *finer = v - 1;
        const lmb_vec3 to = sub3(finer->eye, v->eye);
        out->finer_x = dot3(v->right, to);
        out->finer_half = absf(out->sy - dot3(v->up, to)) < finer->half_height ? finer->half_width : 0.0f;
    }
#endif
}

void lmb_light_texel_power(float out[3], const lmb_light *light, const lmb_shadow_map *map, int32_t face, int32_t x,
                           int32_t y)
{
    lmb_texel_row row;
    float power;
    if (out == NULL) {
        return;
    }
    out[0] = out[1] = out[2] = 0.0f;
    if (light == NULL || map == NULL || (uint32_t)face >= (uint32_t)map->faces || (uint32_t)x >= (uint32_t)map->size ||
        (uint32_t)y >= (uint32_t)map->size) {
        return;
    }
    const float sx = texel_sx(&map->view[face], map->size, x);
    lmb_texel_row_of(&row, light, map, face, y);
    texel_powers_of_one(&power, &sx, 1, &row);
    for (int c = 0; c < 3; ++c) {
        out[c] = texel_flux(light->intensity[c], power);
    }
}
