/* gouraud_light.c: the light at a triangle's corner, and its colour. Layer 10. */
#include "gouraud_light.h"

#include "../base/codec.h"
#include "../base/light_kind.h"
#include "../light/shadow.h"
#include "../raster/texture.h"

#if LMB_TRANSFER

/* Irradiance of one light on a plane of the normal, per intensity, as light/direct.inl. */
static float arriving(const lmb_light *light, lmb_vec3 at, lmb_vec3 normal)
{
    lmb_vec3 to = mul3(light->direction, -1.0f);
    float e = 1.0f;
    if (!light_kind_is(light->kind, LIGHT_FAR)) {
        to = sub3(light->position, at);
        e = 1.0f / maxf(dot3(to, to), 1e-24f);
        to = mul3(to, sqrtf(e));
        if (light_kind_is(light->kind, LIGHT_CONED)) {
            const float width = maxf(light->cos_inner - light->cos_outer, 1e-6f);
            const float t = clampf((-dot3(to, light->direction) - light->cos_outer) / width, 0.0f, 1.0f);
            e *= t * t * (3.0f - 2.0f * t);
        }
    }
    return e * maxf(dot3(normal, to), 0.0f);
}

void lmb_gouraud_direct(float inout[3], const lmb_gouraud *g, lmb_vec3 at, lmb_vec3 normal, uint32_t id, int is_exact)
{
    lmb_receiver r;
    r.position = at;
    r.face = normal;
    r.id = id;
    for (uint32_t i = 0; g->maps != NULL && i < g->scene->light_count; ++i) {
        const lmb_light *light = &g->scene->lights[i];
        const float e = arriving(light, at, normal);
        lmb_shadow_query query;
        lmb_shadow_ask(&query, &g->maps[i], light, g->scene, g->view.eye);
        if (e > 0.0f && (is_exact ? lmb_is_lit(&query, &r) : lmb_is_lit_by_depth(&query, &r))) {
            for (int c = 0; c < 3; ++c) {
                inout[c] += light->intensity[c] * e;
            }
        }
    }
}

void lmb_gouraud_blend(float inout[3], const lmb_gouraud *g, uint32_t blend, lmb_vec3 normal)
{
    const uint32_t *b = g->transfer->section[LMB_TRANSFER_BLENDS] + LMB_TRANSFER_BLEND_WORDS * (size_t)blend;
    const float *c0 = g->light->cluster[b[0] & 0xffffu], *c1 = g->light->cluster[b[0] >> 16],
                *c2 = g->light->cluster[b[1] & 0xffffu], *c3 = g->light->cluster[b[1] >> 16];
    const float per = 1.0f / 255.0f, s0 = (float)(b[2] & 255u) * per, s1 = (float)(b[2] >> 8 & 255u) * per,
                s2 = (float)(b[2] >> 16 & 255u) * per, s3 = (float)(b[2] >> 24) * per;
    float along[9];
    for (int c = 0; c < 9; ++c) {
        along[c] = s0 * c0[c] + s1 * c1[c] + s2 * c2[c] + s3 * c3[c];
    }
    for (int c = 0; c < 3; ++c) {
        const float *a = along + 3 * c;
        inout[c] += maxf(a[0] * normal.x + a[1] * normal.y + a[2] * normal.z, 0.0f);
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

/* The curve of compose/encode.inl, not rounded: codes are mixed. */
static float code_of(float linear)
{
    const float x = clampf(linear, 0.0f, 1.0f), root = sqrtf(x);
    float curve = -78.940811f * root + 214.911713f;
    curve = curve * root - 240.93952f;
    curve = curve * root + 369.214329f;
    curve = curve * root - 9.43618988f;
    return clampf(x < 0.0031308f ? 12.92f * 255.0f * x : curve, 0.0f, 255.0f);
}

void lmb_gouraud_colour(float out[3], const float e[3], const float albedo[3], float gain)
{
    for (int c = 0; c < 3; ++c) {
        out[c] = code_of(e[c] * albedo[c] * gain);
    }
}

#endif
