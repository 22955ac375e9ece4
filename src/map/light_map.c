/* light_map.c: a light's map: its views fitted, its faces drawn, the power that goes through a texel. Floor 4. */
#include <lambent/map.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../base/poly.h"
#include "../base/vec.h"
#include "../raster/target.h"

#define COS_50 0.64278761f   /* half angle up to which one perspective face serves a spot */
#define CUBE_CORNER 0.9553167f /* rad between a cube face's axis and its corner */
#define FLUX_FLOOR 8.2718061e-25f /* 2^-80 W: less is nothing, so that kernels meet no denormal */

int32_t lmb_light_map_faces(const lmb_light *light)
{
    return light->kind == LMB_LIGHT_POINT || (light->kind == LMB_LIGHT_SPOT && light->cos_outer < COS_50) ? 6 : 1;
}

static int is_map(int32_t size, int32_t id_format)
{
    return size >= LMB_TILE && size <= LMB_MAX_SIDE && size % LMB_TILE == 0 &&
           (id_format == LMB_ID16 || id_format == LMB_ID32);
}

size_t lmb_light_map_bytes(int32_t faces, int32_t size, int32_t id_format)
{
    if (!is_map(size, id_format) || faces < 1 || faces > 6) {
        return 0;
    }
    return (size_t)faces * (lmb_surface_bytes(LMB_DEPTH32F, size, size) + lmb_surface_bytes(id_format, size, size));
}

/* Axes for looking along `forward`: up from the world axis that is least along it. */
static void set_axes(lmb_view *v, lmb_vec3 forward)
{
    lmb_vec3 a = vec3(absf(forward.x), absf(forward.y), absf(forward.z));
    lmb_vec3 up = a.y <= a.x && a.y <= a.z ? vec3(0, 1, 0) : a.x <= a.z ? vec3(1, 0, 0) : vec3(0, 0, 1);
    v->back = mul3(forward, -1.0f);
    v->right = normalize3(cross3(up, v->back));
    v->up = cross3(v->back, v->right);
}

static float scene_diagonal(const lmb_scene *scene)
{
    return maxf(length3(sub3(scene->bounds_max, scene->bounds_min)), 1e-6f);
}

/* The box of the scene's bounds along the light's axes: an orthographic view that holds every vertex. */
static void fit_directional(lmb_view *v, const lmb_light *light, const lmb_scene *scene)
{
    lmb_vec3 lo = scene->bounds_min, hi = scene->bounds_max;
    lmb_vec3 centre = mul3(add3(lo, hi), 0.5f), half = mul3(sub3(hi, lo), 0.5f);
    float margin = 1e-3f * scene_diagonal(scene);
    set_axes(v, light->direction);
    lmb_vec3 axis[3] = {v->right, v->up, v->back};
    float extent[3];
    for (int i = 0; i < 3; ++i) {
        extent[i] = absf(axis[i].x) * half.x + absf(axis[i].y) * half.y + absf(axis[i].z) * half.z + margin;
    }
    v->kind = LMB_ORTHOGRAPHIC;
    v->half_width = extent[0];
    v->half_height = extent[1];
    v->near_m = margin;
    v->far_m = margin + 2.0f * extent[2];
    v->eye = add3(centre, mul3(v->back, extent[2] + margin));
}

static void fit_spot(lmb_view *v, const lmb_light *light)
{
    float c = light->cos_outer;
    set_axes(v, light->direction);
    v->half_width = v->half_height = sqrtf(maxf(1.0f - c * c, 1e-8f)) / c;
}

static lmb_vec3 cube_axis(int32_t face)
{
    float sign = face & 1 ? -1.0f : 1.0f;
    return vec3(face / 2 == 0 ? sign : 0.0f, face / 2 == 1 ? sign : 0.0f, face / 2 == 2 ? sign : 0.0f);
}

static void fit_views(lmb_light_map *map, const lmb_light *light, const lmb_scene *scene)
{
    map->drawn = 0;
    for (int32_t f = 0; f < map->faces; ++f) {
        lmb_view *v = &map->view[f];
        v->eye = light->position;
        v->kind = LMB_PERSPECTIVE;
        v->half_width = v->half_height = 1.0f;
        v->near_m = maxf(1e-5f * scene_diagonal(scene), 1e-6f);
        v->far_m = 0.0f;
        v->frame_width = v->frame_height = map->size;
        int meets = 1;
        if (light->kind == LMB_LIGHT_DIRECTIONAL) {
            fit_directional(v, light, scene);
        } else if (map->faces == 1) {
            fit_spot(v, light);
        } else {
            set_axes(v, cube_axis(f));
            if (light->kind == LMB_LIGHT_SPOT) {
                float reach = lmb_acos(light->cos_outer) + CUBE_CORNER;
                meets = dot3(light->direction, cube_axis(f)) >= (reach < 3.1415927f ? lmb_cos(reach) : -1.0f);
            }
        }
        map->drawn |= (uint32_t)meets << f;
    }
}

lmb_status lmb_light_map_init(lmb_light_map *out, const lmb_light *light, const lmb_scene *scene, int32_t size,
                              int32_t id_format, void *memory, size_t bytes)
{
    if (out == NULL || light == NULL || scene == NULL || !is_map(size, id_format)) {
        return LMB_ERR_ARG;
    }
    size_t depth_bytes = lmb_surface_bytes(LMB_DEPTH32F, size, size),
           id_bytes = lmb_surface_bytes(id_format, size, size);
    int32_t faces = lmb_light_map_faces(light);
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

lmb_status lmb_light_map_clear(const lmb_light_map *map)
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

lmb_status lmb_light_map_draw(const lmb_light_map *map, const lmb_kernels *kernels, const lmb_scene *scene,
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

/* The tile rows from .. to - 1 of one face. */
static lmb_status draw_rows(const lmb_light_map *map, int32_t face, const lmb_kernels *kernels, const lmb_scene *scene,
                            int32_t from, int32_t to, lmb_stats *stats)
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

lmb_status lmb_light_map_rows(const lmb_light_map *map, const lmb_kernels *kernels, const lmb_scene *scene,
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
            status = draw_rows(map, f, kernels, scene, from, to, stats);
        }
    }
    return status;
}

/* Fall-off of a spot towards `ray` (any length), averaged over the 2x2 quarter centres of a texel by the caller. */
static float spot_share(const lmb_light *light, lmb_vec3 ray)
{
    float cosine = dot3(light->direction, ray) / length3(ray);
    float width = light->cos_inner - light->cos_outer;
    if (cosine <= light->cos_outer) {
        return 0.0f;
    }
    float t = width > 1e-6f ? clampf((cosine - light->cos_outer) / width, 0.0f, 1.0f) : 1.0f;
    return t * t * (3.0f - 2.0f * t);
}

/* Solid angle of a texel of side p at distance 1, its centre l away: p^2 / l^3 times the second-order term of the
 * integral of 1 / |x|^3 over the square. Differences of corner formulas cancel in binary32; this does not. */
static float texel_solid_angle(float p, float x, float y)
{
    float l2 = 1.0f + x * x + y * y, l = sqrtf(l2);
    return p * p / (l2 * l) * (1.0f + p * p * (1.0f / 24.0f) * (9.0f * (l2 - 1.0f) - 6.0f) / (l2 * l2));
}

void lmb_light_texel_power(float out[3], const lmb_light *light, const lmb_light_map *map, int32_t face, int32_t x,
                           int32_t y)
{
    const lmb_view *v = &map->view[face];
    float px = 2.0f * v->half_width / (float)map->size, py = 2.0f * v->half_height / (float)map->size;
    float sx = ((float)(2 * x + 1 - map->size) * 0.5f) * px, sy = ((float)(map->size - 2 * y - 1) * 0.5f) * py;
    float power = light->kind == LMB_LIGHT_DIRECTIONAL ? px * py : texel_solid_angle(px, sx, sy);
    if (light->kind == LMB_LIGHT_SPOT) {
        float share = 0.0f;
        for (int q = 0; q < 4; ++q) {
            float qx = sx + (q & 1 ? 0.25f : -0.25f) * px, qy = sy + (q & 2 ? 0.25f : -0.25f) * py;
            share += spot_share(light, sub3(add3(mul3(v->right, qx), mul3(v->up, qy)), v->back));
        }
        power *= share * 0.25f;
    }
    for (int c = 0; c < 3; ++c) {
        float w = light->intensity[c] * power;
        out[c] = w < FLUX_FLOOR ? 0.0f : w;
    }
}
