/* resolve.c: ids of a tile -> position, normal, albedo, each triangle once over the tile's pixels. Floor 3. */
#include "resolve.h"

#include <string.h>

#include "../base/vertex.h"
#include "paint.h"
#include "target.h"
#include "texture.h"

void lmb_resolve_rays(lmb_resolve_job *job, const lmb_view *v, int32_t x, int32_t y)
{
    const lmb_vec3 none = vec3(0.0f, 0.0f, 0.0f);
    float per_x = 2.0f * v->half_width / (float)v->frame_width, per_y = 2.0f * v->half_height / (float)v->frame_height;
    float sx = ((float)(2 * x + 1 - v->frame_width) * 0.5f) * per_x;
    float sy = ((float)(v->frame_height - 2 * y - 1) * 0.5f) * per_y;
    lmb_vec3 first = add3(mul3(v->right, sx), mul3(v->up, sy));
    lmb_vec3 step_x = mul3(v->right, per_x), step_y = mul3(v->up, -per_y);
    int perspective = v->kind == LMB_PERSPECTIVE;
    job->eye = v->eye;
    job->origin = perspective ? none : first;
    job->ox = perspective ? none : step_x;
    job->oy = perspective ? none : step_y;
    job->direction = perspective ? sub3(first, v->back) : mul3(v->back, -1.0f);
    job->rx = perspective ? step_x : none;
    job->ry = perspective ? step_y : none;
}

/* The plane and the barycentric gradients, scaled by the longest edge so that squares of tiny edges stay normal. */
static void set_plane(lmb_resolve_job *job, const lmb_triangle *t, const lmb_view *v)
{
    lmb_vec3 e1 = sub3(t->corner[1], t->corner[0]), e2 = sub3(t->corner[2], t->corner[0]);
    float longest = sqrtf(maxf(dot3(e1, e1), dot3(e2, e2)));
    float shrink = longest > 1e-12f ? 1.0f / longest : 0.0f;
    e1 = mul3(e1, shrink);
    e2 = mul3(e2, shrink);
    lmb_vec3 n = cross3(e1, e2);
    float nn = dot3(n, n), gain = nn > 1e-24f ? shrink / nn : 0.0f;
    job->corner = sub3(t->corner[0], v->eye);
    job->g1 = mul3(cross3(e2, n), gain);
    job->g2 = mul3(cross3(n, e1), gain);
    job->plane = nn > 1e-24f ? mul3(n, 1.0f / sqrtf(nn)) : v->back;
    float seen = v->kind == LMB_PERSPECTIVE ? dot3(job->plane, job->corner) : -dot3(job->plane, v->back);
    job->face = seen > 0.0f ? mul3(job->plane, -1.0f) : job->plane;
    job->w_min = job->w_max = -dot3(v->back, job->corner);
    for (int k = 1; k < 3; ++k) {
        float w = -dot3(v->back, sub3(t->corner[k], v->eye));
        job->w_min = minf(job->w_min, w);
        job->w_max = maxf(job->w_max, w);
    }
    job->w_min = maxf(job->w_min, v->kind == LMB_PERSPECTIVE ? v->near_m : job->w_min);
    job->w_max = maxf(job->w_max, job->w_min);
}

/* Normals go by the cofactors of the transform: right for uneven scales, and mirrors only flip them. */
static lmb_vec3 transform_normal(const lmb_mat4 *t, lmb_vec3 n)
{
    const float *m = t->m;
    lmb_vec3 a = vec3(m[0], m[1], m[2]), b = vec3(m[4], m[5], m[6]), c = vec3(m[8], m[9], m[10]);
    return normalize3(add3(add3(mul3(cross3(b, c), n.x), mul3(cross3(c, a), n.y)), mul3(cross3(a, b), n.z)));
}

static void set_corners(lmb_resolve_job *job, lmb_resolve_alpha *alpha, const lmb_triangle *t)
{
    job->smooth = t->mesh->normals != NULL;
    for (int k = 0; k < 3; ++k) {
        float uv[2], colour[4];
        mesh_uv(t->mesh, t->vertex[k], uv);
        mesh_colour(t->mesh, t->vertex[k], colour);
        job->uv[0][k] = uv[0];
        job->uv[1][k] = uv[1];
        for (int c = 0; c < 3; ++c) {
            job->albedo[c][k] = t->material->albedo[c] * colour[c];
        }
        alpha->corner[k] = t->material->alpha * colour[3];
        job->normal[k] = job->smooth ? transform_normal(&t->instance->to_world, mesh_normal(t->mesh, t->vertex[k]))
                                     : job->face;
    }
    alpha->cutoff = t->material->flags & LMB_ALPHA_MASK ? t->material->alpha_cutoff : 0.0f;
    alpha->texture = t->material->texture;
}

void lmb_resolve_setup(lmb_resolve_job *job, lmb_resolve_alpha *alpha, const lmb_view *view, const lmb_triangle *t)
{
    job->id = t->id;
    set_plane(job, t, view);
    set_corners(job, alpha, t);
}

void lmb_resolve_point(float *b1, float *b2, const lmb_resolve_job *job, float x, float y)
{
    lmb_vec3 origin = add3(job->origin, add3(mul3(job->ox, x), mul3(job->oy, y)));
    lmb_vec3 ray = add3(job->direction, add3(mul3(job->rx, x), mul3(job->ry, y)));
    float slope = dot3(job->plane, ray);
    float w = slope * slope < 1e-36f ? job->w_max : dot3(job->plane, sub3(job->corner, origin)) / slope;
    lmb_vec3 q = sub3(add3(origin, mul3(ray, clampf(w, job->w_min, job->w_max))), job->corner);
    *b1 = dot3(q, job->g1);
    *b2 = dot3(q, job->g2);
}


static int opaque_at(const lmb_resolve_alpha *alpha, const lmb_scene *scene, const float u[3], const float v[3], float b1,
                     float b2)
{
    b1 = clampf(b1, 0.0f, 1.0f);
    b2 = clampf(b2, 0.0f, 1.0f - b1);
    float a = resolve_mix3(alpha->corner, b1, b2), texel[4];
    if (alpha->texture >= 0) {
        lmb_texture_sample(texel, &scene->textures[alpha->texture], resolve_mix3(u, b1, b2), resolve_mix3(v, b1, b2), 0.0f);
        a *= texel[3];
    }
    return a >= alpha->cutoff;
}

int lmb_resolve_opaque(const lmb_resolve_job *job, const lmb_resolve_alpha *alpha, const lmb_scene *scene, float x,
                       float y)
{
    float b1, b2;
    lmb_resolve_point(&b1, &b2, job, x, y);
    return opaque_at(alpha, scene, job->uv[0], job->uv[1], b1, b2);
}

int lmb_triangle_opaque(const lmb_triangle *t, const lmb_scene *scene, float b1, float b2)
{
    lmb_resolve_alpha alpha;
    float u[3], v[3];
    if ((t->material->flags & LMB_ALPHA_MASK) == 0) {
        return 1;
    }
    for (int k = 0; k < 3; ++k) {
        float uv[2], colour[4];
        mesh_uv(t->mesh, t->vertex[k], uv);
        mesh_colour(t->mesh, t->vertex[k], colour);
        u[k] = uv[0];
        v[k] = uv[1];
        alpha.corner[k] = t->material->alpha * colour[3];
    }
    alpha.cutoff = t->material->alpha_cutoff;
    alpha.texture = t->material->texture;
    return opaque_at(&alpha, scene, u, v, b1, b2);
}

/* Ids of the tile's pixels inside window and frame; others 0. */
static void read_ids(lmb_tile *out, const lmb_target *target, int32_t frame_width, int32_t frame_height)
{
    lmb_fill_tile t = lmb_target_tile(target, (out->x - target->x0) / LMB_TILE, (out->y - target->y0) / LMB_TILE);
    int32_t width = mini(target->x0 + target->depth.width, frame_width) - out->x;
    int32_t height = mini(target->y0 + target->depth.height, frame_height) - out->y;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        int32_t x = k % LMB_TILE, y = k / LMB_TILE, at = y * t.id_step + x;
        uint32_t id = t.id_format == LMB_ID16 ? ((const uint16_t *)t.id)[at] : ((const uint32_t *)t.id)[at];
        out->id[k] = x < width && y < height ? id : 0;
    }
}

static int32_t count_hits(const lmb_tile *t)
{
    int32_t hits = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        hits += t->id[k] != 0;
    }
    return hits;
}

lmb_status lmb_resolve_tile(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                            const lmb_target *target, int32_t x, int32_t y)
{
    if (out == NULL || kernels == NULL || view == NULL || scene == NULL || target == NULL || target->id.data == NULL ||
        lmb_target_check(target, view, 0) != LMB_OK || x < target->x0 || y < target->y0 ||
        x >= target->x0 + target->id.width || y >= target->y0 + target->id.height || x % LMB_TILE != 0 ||
        y % LMB_TILE != 0) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    out->x = x;
    out->y = y;
    read_ids(out, target, view->frame_width, view->frame_height);
    uint64_t left = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        left |= (uint64_t)(out->id[k] != 0) << k;
    }
    lmb_resolve_job job;
    lmb_resolve_rays(&job, view, x, y);
    for (int k = 0; k < LMB_TILE_PIXELS && left >> k != 0; ++k) {
        lmb_triangle triangle;
        lmb_resolve_alpha alpha;
        if (((left >> k) & 1u) == 0) {
            continue;
        }
        if (!lmb_triangle_fetch(&triangle, scene, out->id[k])) {
            out->id[k] = 0; /* an id surface from another scene */
            continue;
        }
        lmb_resolve_setup(&job, &alpha, view, &triangle);
        left &= ~kernels->resolve(out, &job);
        lmb_paint_tile(out, &job, &triangle, scene);
    }
    out->hits = count_hits(out);
    return LMB_OK;
}
