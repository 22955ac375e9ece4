/* inject_around.c: what surfaces throw back of the light around them, as voxels' light. Floor 6.               [M7] */
#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "../raster/texture.h"
#include "../raster/triangle.h"
#include <lambent/mixed.h>

#if LMB_MIXED && LMB_VOXELS

enum { MOST_PARTS = 64 }; /* a triangle's side is divided by at most */

/* Of three corners' values, the one at barycentrics (b1, b2). */
static float mix(float a, float b, float c, float b1, float b2) { return a + (b - a) * b1 + (c - a) * b2; }

static void corner_uv(float out[2], const lmb_mesh *m, uint32_t vertex)
{
    for (int i = 0; i < 2; ++i) {
        out[i] = m->uv_format == LMB_UV_U16
                     ? (float)((const uint16_t *)m->uvs)[2 * (size_t)vertex + (size_t)i] * m->uv_scale[i] / 65535.0f
                     : ((const float *)m->uvs)[2 * (size_t)vertex + (size_t)i];
    }
}

static void albedo_at(float out[3], const lmb_triangle *t, const lmb_scene *scene, float b1, float b2)
{
    const lmb_mesh *m = t->mesh;
    float texel[4] = {1, 1, 1, 1};
    if (t->material->texture >= 0 && m->uvs != NULL) {
        const lmb_texture *texture = &scene->textures[t->material->texture];
        float uv[3][2];
        for (int k = 0; k < 3; ++k) {
            corner_uv(uv[k], m, t->vertex[k]);
        }
        lmb_texture_sample(texel, texture, mix(uv[0][0], uv[1][0], uv[2][0], b1, b2),
                           mix(uv[0][1], uv[1][1], uv[2][1], b1, b2), (float)(texture->levels - 1));
    }
    for (int c = 0; c < 3; ++c) {
        float colour = 1.0f;
        if (m->colours != NULL) {
            const uint8_t *at = m->colours + c;
            colour = mix((float)at[4 * (size_t)t->vertex[0]], (float)at[4 * (size_t)t->vertex[1]],
                         (float)at[4 * (size_t)t->vertex[2]], b1, b2) * (1.0f / 255.0f);
        }
        out[c] = clampf(t->material->albedo[c] * colour * texel[c], 0.0f, 1.0f);
    }
}

/* A triangle in n x n alike parts: part (i, j) stands upright where i + j < n, upside down else. */
typedef struct parts {
    const lmb_triangle *triangle;
    const lmb_scene *scene;
    lmb_vec3 normal;
    float area, light[3]; /* of a part, m2; W/m2 that reaches it */
    int32_t n;
} parts;

static void part_at(lmb_texel *out, const parts *p, int32_t i, int32_t j)
{
    const int up = i + j < p->n;
    const float step = 1.0f / (float)p->n, third = up ? 1.0f / 3.0f : 2.0f / 3.0f;
    const float x = (float)(up ? i : p->n - 1 - i) + third, y = (float)(up ? j : p->n - 1 - j) + third;
    const lmb_vec3 *c = p->triangle->corner;
    float albedo[3];
    albedo_at(albedo, p->triangle, p->scene, x * step, y * step);
    memset(out, 0, sizeof *out);
    out->position = add3(c[0], add3(mul3(sub3(c[1], c[0]), x * step), mul3(sub3(c[2], c[0]), y * step)));
    out->normal = p->normal;
    for (int k = 0; k < 3; ++k) {
        out->flux[k] = albedo[k] * p->light[k] * p->area;
    }
}

static lmb_status inject_triangle(lmb_voxels *inout, int32_t field, const lmb_triangle *t, const lmb_scene *scene,
                                  const lmb_env *env)
{
    parts p = {t, scene, {0, 0, 0}, 0.0f, {0, 0, 0}, 1};
    lmb_status status = LMB_OK;
    if (!lmb_triangle_shape(&p.normal, &p.area, t)) {
        return LMB_OK;
    }
    const float side = maxf(length3(sub3(t->corner[1], t->corner[0])), length3(sub3(t->corner[2], t->corner[0])));
    p.n = mini((int32_t)(side / inout->leaf) + 1, MOST_PARTS);
    p.area /= (float)(p.n * p.n);
    lmb_env_irradiance(p.light, env, p.normal);
    for (int32_t k = 0; k < p.n * p.n && status == LMB_OK; ++k) {
        lmb_texel one;
        part_at(&one, &p, k % p.n, k / p.n);
        status = lmb_voxels_inject(inout, field, &one, 1);
    }
    return status;
}

lmb_status lmb_around_inject(lmb_voxels *inout, int32_t field, const lmb_scene *scene, uint32_t first_id,
                             uint32_t count, const lmb_env *env)
{
    if (inout == NULL || scene == NULL || env == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = 0; i < count; ++i) {
        lmb_triangle t;
        if (lmb_triangle_fetch(&t, scene, first_id + i)) {
            const lmb_status status = inject_triangle(inout, field, &t, scene, env);
            if (status != LMB_OK) {
                return status;
            }
        }
    }
    return LMB_OK;
}

#endif
