/* gouraud_light.c: the light at a triangle's corner, and the colour. Layer 8. */
#include "gouraud_light.h"

#include "../base/codec.h"
#include "../base/light_kind.h"
#include "../direct/shadow.h"
#include "../direct/part.h"
#include "../raster/texture.h"

#if LMB_TRANSFER

/* Irradiance of one light on a plane with this normal, per intensity, as in direct/direct.inl. */
static float arriving(const lmb_light *light, lmb_vec3 at, lmb_vec3 normal)
{
    lmb_vec3 to = mul3(light->direction, -1.0f);
    float e = 1.0f;
    if (!light_kind_is(light->kind, LIGHT_FAR)) {
        to = sub3(light->position, at);
        const float d2 = dot3(to, to), left = light_within(d2, light_range2(light));
        e = 1.0f / maxf(d2, 1e-24f);
        to = mul3(to, sqrtf(e));
        e *= left;
        if (light_kind_is(light->kind, LIGHT_CONED)) {
            const float width = maxf(light->cos_inner - light->cos_outer, 1e-6f);
            const float t = clampf((-dot3(to, light->direction) - light->cos_outer) / width, 0.0f, 1.0f);
            e *= t * t * (3.0f - 2.0f * t);
        }
    }
    return e * maxf(dot3(normal, to), 0.0f);
}

static int32_t face_towards(const lmb_shadow_map *map, const lmb_light *light, lmb_vec3 at)
{
    if (map->faces == 1) {
        return 0;
    }
    if (light_kind_is(light->kind, LIGHT_FAR)) {
        return LMB_TREES ? lmb_shadow_map_part(map, at) : 0;
    }
    return (int32_t)side_of3(sub3(at, light->position));
}

/* Tests the surface at the centre of the texel against the receiver's plane there, like the last resort of
 * direct/shadow.c. It is off by up to a texel, which does not show if corners are closer together than texels. 1
 * outside the map. */
static int is_corner_lit(const lmb_shadow_map *map, const lmb_light *light, lmb_vec3 at, lmb_vec3 normal)
{
    const int32_t face = face_towards(map, light, at);
    const lmb_view *v = &map->view[face];
    const int is_far = v->kind == LMB_ORTHOGRAPHIC;
    const lmb_vec3 d = sub3(at, v->eye);
    const float w = -dot3(v->back, d), unit = is_far ? 1.0f : w, half = 0.5f * (float)map->size;
    if (!(unit > 0.0f) || ((map->drawn >> face) & 1u) == 0) {
        return 1;
    }
    const float side_x = v->half_width / half, side_y = v->half_height / half; /* of a texel, at distance 1 */
    const float x = half + dot3(v->right, d) / (unit * side_x), y = half - dot3(v->up, d) / (unit * side_y);
    if (!(x >= 0.0f && y >= 0.0f && x < 2.0f * half && y < 2.0f * half)) {
        return 1;
    }
    const lmb_surface *depths = &map->face[face].depth;
    const float *row = (const float *)(const void *)((const uint8_t *)depths->data + (int32_t)y * depths->stride_bytes),
                depth = row[(int32_t)x];
    const float sx = ((float)(int32_t)x + 0.5f - half) * side_x, sy = (half - 0.5f - (float)(int32_t)y) * side_y;
    const float across = sx * dot3(normal, v->right) + sy * dot3(normal, v->up), back = dot3(normal, v->back);
    const float slope = is_far ? -back : across - back, texel = side_x * unit;
    if (depth == 0.0f || absf(slope) < 1e-3f) {
        return 1;
    }
    const float own = (dot3(normal, d) - (is_far ? across : 0.0f)) / slope;
    return lmb_depth_view_z(v, depth) >= minf(own, w + 16.0f * texel) - texel;
}

/* Tests with the triangles that the map names. */
static int is_lit_exactly(const lmb_gouraud *g, uint32_t i, lmb_vec3 at, lmb_vec3 normal, uint32_t id)
{
    const lmb_receiver r = {at, normal, id};
    lmb_shadow_query query;
    lmb_shadow_ask(&query, &g->maps[i], &g->scene->lights[i], g->scene, &g->view);
    return lmb_is_lit(&query, &r);
}

void lmb_gouraud_direct(float inout[3], const lmb_gouraud *g, lmb_vec3 at, lmb_vec3 normal, uint32_t id, int is_exact)
{
    for (uint32_t i = 0; g->maps != NULL && i < g->scene->light_count; ++i) {
        const lmb_light *light = &g->scene->lights[i];
        const float e = arriving(light, at, normal);
        if (e > 0.0f &&
            (is_exact ? is_lit_exactly(g, i, at, normal, id) : is_corner_lit(&g->maps[i], light, at, normal))) {
            for (int c = 0; c < 3; ++c) {
                inout[c] += light->intensity[c] * e;
            }
        }
    }
}

void lmb_gouraud_blend(float inout[3], const lmb_gouraud *g, uint32_t blend, lmb_vec3 normal)
{
    const uint32_t *b = g->transfer->section[LMB_TRANSFER_BLENDS] + LMB_TRANSFER_BLEND_WORDS * (size_t)blend;
    float along[3] = {0.0f, 0.0f, 0.0f};
    for (int k = 0; k < 4; ++k) {
        const float *a = g->light->cluster[b[k / 2] >> 16 * (k % 2) & 0xffffu];
        const lmb_vec3 n = mul3(normal, (float)(b[2] >> 8 * k & 255u) * (1.0f / 255.0f));
        along[0] += a[0] * n.x + a[1] * n.y + a[2] * n.z;
        along[1] += a[3] * n.x + a[4] * n.y + a[5] * n.z;
        along[2] += a[6] * n.x + a[7] * n.y + a[8] * n.z;
    }
    for (int c = 0; c < 3; ++c) {
        inout[c] += maxf(along[c], 0.0f);
    }
}

void lmb_gouraud_albedo(float out[3], const lmb_scene *scene, const lmb_material *m)
{
    float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    if (m->texture >= 0) {
        const lmb_texture *t = &scene->textures[m->texture];
        lmb_texture smallest = *t;
        smallest.filter = LMB_TRILINEAR;
        lmb_texture_sample(texel, &smallest, 0.5f, 0.5f, (float)(t->levels - 1));
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = m->albedo[c] * texel[c];
    }
}

/* The curve of frame/encode.inl without rounding, because codes are interpolated. */
static float code_of_light(float linear)
{
    const float x = clampf(linear, 0.0f, 1.0f), root = sqrtf(x);
    float curve = -78.940811f * root + 214.911713f;
    curve = curve * root - 240.93952f;
    curve = curve * root + 369.214329f;
    curve = curve * root - 9.43618988f;
    return x < 0.0031308f ? 12.92f * 255.0f * x : minf(curve, 255.0f);
}

void lmb_gouraud_colour(float out[3], const float e[3], const float albedo[3], float gain)
{
    for (int c = 0; c < 3; ++c) {
        out[c] = code_of_light(e[c] * albedo[c] * gain);
    }
}

#endif
