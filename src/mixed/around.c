/* around.c: light of the environment that surfaces reflect, as first points for voxels. Layer 6. [M7] */
#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "../base/vertex.h"
#include "../raster/texture.h"
#include "../raster/triangle.h"
#include "../raster/tile.h"
#include <lambent/mixed.h>

#if LMB_MIXED

#define MAX_RATIO 4.0f /* max growth of the light at a point: cones are coarse if almost no light came before */

#define FAR_SHARE 0.15f   /* of the distance from the object: points this close share one result */
#define MIN_SHARED_COSINE 0.98f   /* min cosine between the normals of points that share one result */

enum { MAX_PARTS = 64 }; /* max parts along a triangle's side */

/* Interpolates the values of three corners at barycentrics (b1, b2). */
static float mix_at_corners(float a, float b, float c, float b1, float b2) { return a + (b - a) * b1 + (c - a) * b2; }

static void corner_uv(float out[2], const lmb_mesh *m, uint32_t vertex)
{
    for (int i = 0; i < 2; ++i) {
        out[i] = m->uv_format == LMB_UV_U16
                     ? (float)((const uint16_t *)m->uvs)[2 * (size_t)vertex + (size_t)i] * m->uv_scale[i] / 65535.0f
                     : ((const float *)m->uvs)[2 * (size_t)vertex + (size_t)i];
    }
}

/* Mip level with texels about the size of a part: a side of the triangle, in texels, divided by n. */
static float level_of(const lmb_texture *texture, float uv[3][2], int32_t n)
{
    float texels = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float u = (uv[k][0] - uv[(k + 1) % 3][0]) * (float)texture->width,
                    v = (uv[k][1] - uv[(k + 1) % 3][1]) * (float)texture->height;
        texels = maxf(texels, u * u + v * v);
    }
    return clampf(0.5f * lmb_log2(maxf(texels, 1e-6f)) - lmb_log2((float)n), 0.0f, (float)(texture->levels - 1));
}

static void albedo_at_texel(float out[3], const lmb_triangle *t, const lmb_scene *scene, int32_t n, float b1, float b2)
{
    const lmb_mesh *m = t->mesh;
    float texel[4] = {1, 1, 1, 1};
    if (t->material->texture >= 0 && m->uvs != NULL) {
        const lmb_texture *texture = &scene->textures[t->material->texture];
        float uv[3][2];
        for (int k = 0; k < 3; ++k) {
            corner_uv(uv[k], m, t->vertex[k]);
        }
        lmb_texture_sample(texel, texture, mix_at_corners(uv[0][0], uv[1][0], uv[2][0], b1, b2),
                           mix_at_corners(uv[0][1], uv[1][1], uv[2][1], b1, b2), level_of(texture, uv, n));
    }
    for (int c = 0; c < 3; ++c) {
        float colour = 1.0f;
        if (m->colours != NULL) {
            const uint8_t *at = m->colours + c;
            colour = mesh_colours_are_wide(m)
                         ? mix_at_corners(mesh_wide_colour(m, t->vertex[0], c), mesh_wide_colour(m, t->vertex[1], c),
                                          mesh_wide_colour(m, t->vertex[2], c), b1, b2)
                         : mix_at_corners((float)at[4 * (size_t)t->vertex[0]], (float)at[4 * (size_t)t->vertex[1]],
                                          (float)at[4 * (size_t)t->vertex[2]], b1, b2) *
                               (1.0f / 255.0f);
        }
        out[c] = clampf(t->material->albedo[c] * colour * texel[c], 0.0f, 1.0f);
    }
}

/* A triangle in n x n congruent parts: part (i, j) is upright if i + j < n, otherwise upside down. */
typedef struct parts {
    const lmb_triangle *triangle;
    const lmb_scene *scene;
    lmb_vec3 normal;
    float area, light[3]; /* of a part, m2; irradiance of a part, W/m2 */
    int32_t n;
} parts;

static void put_part_at(lmb_texel *out, const parts *p, int32_t i, int32_t j)
{
    const int up = i + j < p->n;
    const float step = 1.0f / (float)p->n, third = up ? 1.0f / 3.0f : 2.0f / 3.0f;
    const float x = (float)(up ? i : p->n - 1 - i) + third, y = (float)(up ? j : p->n - 1 - j) + third;
    const lmb_vec3 *c = p->triangle->corner;
    float albedo[3];
    albedo_at_texel(albedo, p->triangle, p->scene, p->n, x * step, y * step);
    memset(out, 0, sizeof *out);
    out->position = add3(c[0], add3(mul3(sub3(c[1], c[0]), x * step), mul3(sub3(c[2], c[0]), y * step)));
    out->normal = p->normal;
    for (int k = 0; k < 3; ++k) {
        out->flux[k] = albedo[k] * p->light[k] * p->area;
    }
}

/* Writes as many parts as fit; returns the number of all. */
static size_t put_triangle_parts(lmb_texel *out, size_t cap, const lmb_triangle *t, const lmb_scene *scene, float leaf,
                                 const lmb_env *env)
{
    parts p = {t, scene, {0, 0, 0}, 0.0f, {0, 0, 0}, 1};
    if (!lmb_triangle_shape(&p.normal, &p.area, t)) {
        return 0;
    }
    const float side = maxf(length3(sub3(t->corner[1], t->corner[0])), length3(sub3(t->corner[2], t->corner[0])));
    p.n = (int32_t)minf(side / leaf, (float)(MAX_PARTS - 1)) + 1;
    p.area /= (float)(p.n * p.n);
    const size_t count = (size_t)p.n * (size_t)p.n;
    if (cap > 0) {
        lmb_env_irradiance(p.light, env, p.normal);
    }
    for (size_t k = 0; k < count && k < cap; ++k) {
        put_part_at(&out[k], &p, (int32_t)k % p.n, (int32_t)k / p.n);
    }
    return count;
}

size_t lmb_around_points(lmb_texel *out, size_t cap, const lmb_scene *scene, uint32_t first_id, uint32_t count,
                         float leaf, const lmb_env *env)
{
    size_t n = 0;
    if (scene == NULL || env == NULL || !(leaf > 0.0f) || (out == NULL && cap > 0)) {
        return 0;
    }
    const uint32_t all = lmb_scene_triangles(scene);
    for (uint32_t i = 0; i < count && first_id + i <= all; ++i) {
        lmb_triangle t;
        if (lmb_triangle_fetch(&t, scene, first_id + i)) {
            n += put_triangle_parts(n < cap ? out + n : NULL, n < cap ? cap - n : 0, &t, scene, leaf, env);
        }
    }
    return n;
}

/* --- reflected light ---------------------------------------------------------------------------------------------- */

static void put_tile_point(lmb_tile *tile, int32_t k, const lmb_texel *from)
{
    tile_set_vec(tile->position, k, from->position);
    tile_set_vec(tile->face, k, from->normal);
    tile_set_vec(tile->normal, k, from->normal);
    tile->depth[k] = 1.0f;
    tile->id[k] = 1;
}

/* Consecutive points with similar normals that lie close together share the result of the first. */
static size_t run_end(const lmb_texel *all, size_t first, size_t count, float near)
{
    size_t i = first + 1;
    for (; i < count; ++i) {
        const lmb_vec3 d = sub3(all[i].position, all[first].position);
        if (dot3(d, d) > near * near || dot3(all[i].normal, all[first].normal) < MIN_SHARED_COSINE) {
            break;
        }
    }
    return i;
}

static void scale_run(lmb_texel *inout, size_t first, size_t past, const float was[3], const float now[3])
{
    for (int c = 0; c < 3; ++c) {
        const float ratio = was[c] > 1e-9f ? clampf(now[c] / was[c], 0.0f, MAX_RATIO) : 1.0f;
        for (size_t i = first; i < past; ++i) {
            inout[i].flux[c] *= ratio;
        }
    }
}

size_t lmb_around_gather(lmb_around_scratch *out, const lmb_texel *points, size_t from, size_t count, float near_m,
                         lmb_vec3 about)
{
    if (out == NULL || (points == NULL && count > 0)) {
        return count;
    }
    memset(&out->tile, 0, sizeof out->tile);
    memset(&out->before, 0, sizeof out->before);
    memset(&out->now, 0, sizeof out->now);
    for (out->count = 0; out->count < LMB_TILE_PIXELS && from < count; ++out->count) {
        put_tile_point(&out->tile, out->count, &points[from]);
        out->first[out->count] = from;
        const float far = length3(sub3(points[from].position, about));
        from = run_end(points, from, count, maxf(near_m, FAR_SHARE * far));
    }
    out->first[out->count] = from;
    return from;
}

lmb_status lmb_around_scale(lmb_texel *inout, const lmb_around_scratch *scratch, const lmb_env *env)
{
    if (inout == NULL || scratch == NULL) {
        return LMB_ERR_ARG;
    }
    for (int32_t k = 0; k < scratch->count; ++k) {
        float was[3] = {scratch->before.rgb[0][k], scratch->before.rgb[1][k], scratch->before.rgb[2][k]};
        const float now[3] = {scratch->now.rgb[0][k], scratch->now.rgb[1][k], scratch->now.rgb[2][k]};
        if (env != NULL) {
            lmb_env_irradiance(was, env, inout[scratch->first[k]].normal);
        }
        scale_run(inout, scratch->first[k], scratch->first[k + 1], was, now);
    }
    return LMB_OK;
}

#endif
