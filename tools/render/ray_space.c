/* ray_space.c: the nearest triangle on a ray, by the library's BVH. */
#include "ray_space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int ray_space_make(ray_space *s, const lmb_scene *scene, report *r)
{
    const uint32_t triangles = lmb_scene_triangles(scene);
    const size_t bytes = lmb_bvh_bytes(triangles > 0 ? triangles : 1);
    memset(s, 0, sizeof *s);
    s->scene = scene;
    s->memory = malloc(bytes > 0 ? bytes : 1);
    const int fits = s->memory != NULL && bytes > 0 &&
                     lmb_bvh_init(&s->bvh, triangles > 0 ? triangles : 1, s->memory, bytes) == LMB_OK &&
                     lmb_bvh_build(&s->bvh, scene) == LMB_OK;
    s->stack = fits ? malloc((s->bvh.node_count + 1) * sizeof *s->stack) : NULL;
    if (s->stack == NULL) {
        ray_space_free(s);
        return report_fail(r, "not enough memory to trace the scene");
    }
    return 1;
}

void ray_space_free(ray_space *s)
{
    free(s->memory);
    free(s->stack);
    memset(s, 0, sizeof *s);
}

/* Distance of a crossing, or 0, and the weights of corners 1 and 2 there. Doubles, because the exactness rules of the
 * library do not apply to this report. */
static double crossing(float part[2], const lmb_bvh_triangle *t, const double from[3], const double along[3],
                       double noise)
{
    double edge[2][3], to[3], p[3], q[3];
    const double corner[3][3] = {{(double)t->corner[0].x, (double)t->corner[0].y, (double)t->corner[0].z},
                                 {(double)t->corner[1].x, (double)t->corner[1].y, (double)t->corner[1].z},
                                 {(double)t->corner[2].x, (double)t->corner[2].y, (double)t->corner[2].z}};
    const double normal[3] = {(double)t->normal.x, (double)t->normal.y, (double)t->normal.z};
    for (int c = 0; c < 3; ++c) {
        edge[0][c] = corner[1][c] - corner[0][c];
        edge[1][c] = corner[2][c] - corner[0][c];
        to[c] = from[c] - corner[0][c];
    }
    if (fabs(to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2]) <= noise) {
        return 0.0;
    }
    for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        p[c] = along[a] * edge[1][b] - along[b] * edge[1][a];
        q[c] = to[a] * edge[0][b] - to[b] * edge[0][a];
    }
    const double det = edge[0][0] * p[0] + edge[0][1] * p[1] + edge[0][2] * p[2];
    const double u = to[0] * p[0] + to[1] * p[1] + to[2] * p[2];
    const double v = along[0] * q[0] + along[1] * q[1] + along[2] * q[2];
    const double far_m = edge[1][0] * q[0] + edge[1][1] * q[1] + edge[1][2] * q[2];
    const double sign = det < 0.0 ? -1.0 : 1.0;
    const int is_inside = det != 0.0 && sign * u >= 0.0 && sign * v >= 0.0 && sign * (u + v) <= sign * det;
    if (!is_inside) {
        return 0.0;
    }
    part[0] = (float)(u / det);
    part[1] = (float)(v / det);
    return fmax(far_m / det, 0.0);
}

/* Alpha at barycentric coordinates, which rounding may have moved outside. */
static float alpha_at(const lmb_scene *scene, const lmb_triangle *t, const float part[2])
{
    const float b1 = fminf(fmaxf(part[0], 0.0f), 1.0f), b2 = fminf(fmaxf(part[1], 0.0f), 1.0f - b1);
    float of[3][3] = {{0.0f}}, at[3], texel[4] = {0.0f, 0.0f, 0.0f, 1.0f}; /* alpha, u, v */
    for (int k = 0; k < 3; ++k) {
        lmb_vertex v;
        if (lmb_mesh_vertex(&v, t->mesh, t->vertex[k])) {
            of[0][k] = t->material->alpha * v.colour[3];
            of[1][k] = v.uv[0];
            of[2][k] = v.uv[1];
        }
    }
    for (int c = 0; c < 3; ++c) {
        at[c] = of[c][0] + ((of[c][1] - of[c][0]) * b1 + (of[c][2] - of[c][0]) * b2);
    }
    if (t->material->texture >= 0) {
        lmb_texture_sample(texel, &scene->textures[t->material->texture], at[1], at[2], 0.0f);
    }
    return at[0] * texel[3];
}

/* 1 if a triangle of the BVH has no hole there. */
static int is_opaque(const lmb_scene *scene, const lmb_bvh_triangle *t, const float part[2])
{
    lmb_triangle masked;
    if ((t->id & LMB_BVH_MASKED) == 0) {
        return 1;
    }
    return lmb_triangle_fetch(&masked, scene, t->id & ~LMB_BVH_MASKED) &&
           ((masked.material->flags & LMB_ALPHA_MASK) == 0 ||
            alpha_at(scene, &masked, part) >= masked.material->alpha_cutoff);
}

static int meets_box(const lmb_boxes *b, int k, const double from[3], const double along[3], double reach)
{
    double low = 0.0, high = reach;
    for (int c = 0; c < 3; ++c) {
        const double l = (double)b->low[c][k] - from[c], h = (double)b->high[c][k] - from[c];
        if (along[c] == 0.0) {
            if (l > 0.0 || h < 0.0) {
                return 0;
            }
            continue;
        }
        const double a = l / along[c], z = h / along[c];
        low = fmax(low, fmin(a, z));
        high = fmin(high, fmax(a, z));
    }
    return low <= high;
}

uint32_t ray_nearest(float *far_m, ray_space *s, lmb_vec3 origin, lmb_vec3 way, float noise, float reach_m)
{
    const double from[3] = {(double)origin.x, (double)origin.y, (double)origin.z};
    const double along[3] = {(double)way.x, (double)way.y, (double)way.z};
    double reach = (double)reach_m;
    uint32_t found = 0, count = s->bvh.node_count > 0;
    s->stack[0] = 0;
    while (count > 0) {
        const lmb_boxes *b = &s->bvh.node[s->stack[--count]];
        for (int k = 0; k < LMB_BOXES; ++k) {
            if (b->low[0][k] > b->high[0][k] || !meets_box(b, k, from, along, reach)) {
                continue;
            }
            if (b->count[k] == 0) {
                s->stack[count++] = b->first[k];
            }
            for (uint32_t i = 0; i < b->count[k]; ++i) {
                const lmb_bvh_triangle *t = &s->bvh.triangle[b->first[k] + i];
                float part[2];
                const double at = crossing(part, t, from, along, (double)noise);
                if (at > 0.0 && at < reach && is_opaque(s->scene, t, part)) {
                    reach = at;
                    found = b->first[k] + i + 1;
                }
            }
        }
    }
    *far_m = (float)reach;
    return found;
}
