/* relief_views.c: chooses a relief's views, and measures how much of the surface they show. [P11] */
#include "relief_bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

enum { CANDIDATES = 98, TURNS = 30 };

#define UPRIGHT 0.97f

#define MARGIN_TEXELS 2.0f /* empty, around the mesh, so that texels at the edge have neighbours */

static lmb_vec3 vertex(const triangle_mesh *m, uint32_t v)
{
    const float *p = m->positions + 3 * (size_t)v;
    return vec3(p[0], p[1], p[2]);
}

/* Extents along an axis. */
static void extent(const triangle_mesh *m, lmb_vec3 axis, float *low, float *high)
{
    *low = 3e38f;
    *high = -3e38f;
    for (uint32_t v = 0; v < m->vertex_count; ++v) {
        const float d = dot3(vertex(m, v), axis);
        if (is_sane(d)) {
            *low = minf(*low, d);
            *high = maxf(*high, d);
        }
    }
}

/* Rotates the view about its axis to minimize the picture, which makes texels finest. An upright view is preferred if
 * it is about as small. */
static void turn_view(lmb_view *v, const triangle_mesh *mesh)
{
    const lmb_vec3 right = v->right, up = v->up;
    float min = 3e38f;
    for (int i = 0; i < TURNS; ++i) {
        const float a = 1.57079633f * (float)i / (float)TURNS, c = cosf(a), s = sinf(a);
        const lmb_vec3 x = add3(mul3(right, c), mul3(up, s)), y = sub3(mul3(up, c), mul3(right, s));
        float x0, x1, y0, y1;
        extent(mesh, x, &x0, &x1);
        extent(mesh, y, &y0, &y1);
        if ((x1 - x0) * (y1 - y0) < min) {
            min = (i == 0 ? UPRIGHT : 1.0f) * (x1 - x0) * (y1 - y0);
            v->right = normalize3(x);
            v->up = normalize3(y);
        }
    }
}

lmb_view relief_fit(const triangle_mesh *mesh, lmb_vec3 direction, int32_t size)
{
    const lmb_vec3 up = fabsf(direction.y) > 0.99f ? vec3(0.0f, 0.0f, 1.0f) : vec3(0.0f, 1.0f, 0.0f);
    const float margin = (float)size / ((float)size - 2.0f * MARGIN_TEXELS);
    lmb_view v;
    float x0, x1, y0, y1, z0, z1;
    memset(&v, 0, sizeof v);
    v.back = normalize3(direction);
    v.right = normalize3(cross3(up, v.back));
    v.up = normalize3(cross3(v.back, v.right));
    turn_view(&v, mesh);
    extent(mesh, v.right, &x0, &x1);
    extent(mesh, v.up, &y0, &y1);
    extent(mesh, v.back, &z0, &z1);
    const float deep = maxf(z1 - z0, 1e-3f * maxf(x1 - x0, y1 - y0)), air = 0.01f * deep;
    v.eye = add3(add3(mul3(v.right, 0.5f * (x0 + x1)), mul3(v.up, 0.5f * (y0 + y1))), mul3(v.back, z1 + 2.0f * air));
    v.half_width = 0.5f * (x1 - x0) * margin + 1e-6f * deep;
    v.half_height = 0.5f * (y1 - y0) * margin + 1e-6f * deep;
    v.near_m = air;
    v.far_m = deep + 3.0f * air;
    v.kind = LMB_ORTHOGRAPHIC;
    v.frame_width = v.frame_height = size;
    return v;
}

int relief_reach(lmb_view *inout, const triangle_mesh *mesh)
{
    float low, high;
    extent(mesh, inout->back, &low, &high);
    const float eye = dot3(inout->eye, inout->back), deep = high - low;
    inout->far_m = 1.01f * (eye - low) + 0.01f * deep;
    inout->near_m = maxf(0.99f * (eye - high) - 0.01f * deep, 1e-3f * inout->far_m);
    return eye > low;
}

/* Lattice points on a cube's surface: faces, edges and corners have 1, 2 and 3 nonzero coordinates. */
static int32_t cube_directions(lmb_vec3 *out, int faces, int edges, int corners)
{
    int32_t n = 0;
    for (int axes = 1; axes <= 3; ++axes) {
        for (int i = 0; i < 27; ++i) {
            const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
            const int own = (x != 0) + (y != 0) + (z != 0);
            if (own == axes && (own == 1 ? faces : own == 2 ? edges : corners)) {
                out[n++] = normalize3(vec3((float)x, (float)y, (float)z));
            }
        }
    }
    return n;
}

void relief_directions(lmb_vec3 *out, int32_t count)
{
    if (count == 6 || count == 14 || count == 18 || count == 26) {
        cube_directions(out, 1, count >= 18, count == 14 || count == 26);
        return;
    }
    for (int32_t i = 0; i < count; ++i) { /* equal areas by height, golden angles around */
        const double y = 1.0 - (2.0 * i + 1.0) / count, a = 2.39996322972865332 * i, s = sqrt(1.0 - y * y);
        out[i] = vec3((float)(s * cos(a)), (float)y, (float)(s * sin(a)));
    }
}

/* --- visibility in a view ----------------------------------------------------------------------------------------- */

static uint32_t code_at(const relief_bake *bake, const relief_picture *p, int32_t x, int32_t y)
{
    const uint8_t *t = p->texels + 4 * ((size_t)y * (size_t)p->view.frame_width + (size_t)x);
    const uint32_t low = t[0] | (uint32_t)t[1] << 8;
    return bake->format == LMB_RELIEF_FULL ? low | (uint32_t)t[2] << 16 : low;
}

/* Depth, m along the view's axis, of a code other than 0. */
static float depth_of(const relief_bake *bake, const lmb_view *v, uint32_t code)
{
    const float d = (float)code / (bake->format == LMB_RELIEF_FULL ? 16777215.0f : 65535.0f);
    const float min = v->near_m / v->far_m;
    return v->kind == LMB_PERSPECTIVE ? v->near_m / (min + (1.0f - min) * d) : v->far_m - (v->far_m - v->near_m) * d;
}

/* The cosine between the normal and the direction to the view if the point is visible there; else 0. */
static float sees(const relief_bake *bake, const relief_picture *p, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_view *v = &p->view;
    const lmb_vec3 d = sub3(at, v->eye);
    const int perspective = v->kind == LMB_PERSPECTIVE;
    const float w = -dot3(v->back, d), unit = perspective ? w : 1.0f;
    const float cosine = perspective ? -dot3(normal, normalize3(d)) : dot3(normal, v->back);
    if (!(w > 0.0f) || cosine < 0.05f) {
        return 0.0f;
    }
    const float x = (dot3(v->right, d) / (unit * v->half_width) * 0.5f + 0.5f) * (float)v->frame_width,
                y = (0.5f - dot3(v->up, d) / (unit * v->half_height) * 0.5f) * (float)v->frame_height;
    if (!(x >= 0.0f && y >= 0.0f && x < (float)v->frame_width && y < (float)v->frame_height)) {
        return 0.0f;
    }
    const uint32_t code = code_at(bake, p, (int32_t)x, (int32_t)y);
    const float texel =
        2.0f * unit * maxf(v->half_width / (float)v->frame_width, v->half_height / (float)v->frame_height);
    const float slope = sqrtf(maxf(1.0f - cosine * cosine, 0.0f)) / cosine;
    return code != 0 && depth_of(bake, v, code) > w - texel * (0.5f + slope) ? cosine : 0.0f;
}

/* Middle, normal and area of a triangle; 0 for a degenerate one. */
static float triangle_of(const triangle_mesh *m, uint32_t t, lmb_vec3 *middle, lmb_vec3 *normal)
{
    const uint32_t *i = m->indices + 3 * (size_t)t;
    const lmb_vec3 a = vertex(m, i[0]), b = vertex(m, i[1]), c = vertex(m, i[2]);
    const lmb_vec3 n = cross3(sub3(b, a), sub3(c, a));
    const float twice = length3(n);
    *middle = mul3(add3(add3(a, b), c), 1.0f / 3.0f);
    *normal = twice > 0.0f ? mul3(n, 1.0f / twice) : n;
    return 0.5f * twice;
}

int relief_cover(relief_coverage *out, const relief_bake *bake, const triangle_mesh *mesh, report *r)
{
    double area = 0.0, unseen = 0.0, slanted = 0.0;
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        lmb_vec3 at, n;
        const double own = (double)triangle_of(mesh, t, &at, &n);
        float best = 0.0f;
        if (!(own > 0.0 && own < HUGE_VAL)) { /* non-finite corners draw nothing */
            continue;
        }
        for (int32_t i = 0; i < bake->views; ++i) {
            best = maxf(best, sees(bake, &bake->picture[i], at, n));
        }
        area += own;
        unseen += best > 0.0f ? 0.0 : own;
        slanted += best > 0.5f ? 0.0 : own;
    }
    out->unseen = area > 0.0 ? unseen / area : 0.0;
    out->slanted = area > 0.0 ? slanted / area : 0.0;
    return area > 0.0 || report_fail(r, "a model without surface");
}

/* --- greedy choice ------------------------------------------------------------------------------------------------ */

/* The gain of a view: area, weighted by the improvement of the cosine. best: the best cosine of each triangle so
 * far. */
static double gain(const relief_bake *one, const triangle_mesh *mesh, float *best, int keep)
{
    double sum = 0.0;
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        lmb_vec3 at, n;
        const float own = triangle_of(mesh, t, &at, &n), now = sees(one, &one->picture[0], at, n);
        if (now > best[t]) {
            sum += (double)(own * (now - best[t]));
            best[t] = keep ? now : best[t];
        }
    }
    return sum;
}

static int best_view(int32_t *out, relief_bake *drawn, const triangle_mesh *mesh, float *best, uint8_t *used)
{
    double max = -1.0;
    for (int32_t i = 0; i < CANDIDATES; ++i) {
        const double g = used[i] ? -1.0 : gain(&drawn[i], mesh, best, 0);
        if (g > max) {
            max = g;
            *out = i;
        }
    }
    used[*out] = 1;
    gain(&drawn[*out], mesh, best, 1);
    return 1;
}

static int draw_all(relief_bake *drawn, const lmb_vec3 *direction, const triangle_mesh *mesh, const lmb_scene *scene,
                    int32_t size, report *r)
{
    for (int32_t i = 0; i < CANDIDATES; ++i) {
        const lmb_view v = relief_fit(mesh, direction[i], size);
        drawn[i].format = LMB_RELIEF_PACKED;
        if (!relief_add(&drawn[i], scene, &v, r)) {
            return 0;
        }
    }
    return 1;
}

int relief_greedy(lmb_vec3 *out, int32_t count, const triangle_mesh *mesh, const lmb_scene *scene, int32_t size,
                  report *r)
{
    lmb_vec3 direction[CANDIDATES];
    uint8_t used[CANDIDATES] = {0};
    relief_bake *drawn = calloc(CANDIDATES, sizeof *drawn);
    float *best = calloc(mesh->triangle_count > 0 ? mesh->triangle_count : 1, sizeof *best);
    relief_directions(direction, CANDIDATES);
    int ok = drawn != NULL && best != NULL ? draw_all(drawn, direction, mesh, scene, size < 128 ? size : 128, r)
                                           : report_fail(r, "not enough memory to choose views");
    for (int32_t i = 0; i < count && ok; ++i) {
        int32_t chosen = 0;
        best_view(&chosen, drawn, mesh, best, used);
        out[i] = direction[chosen];
    }
    for (int32_t i = 0; i < CANDIDATES && drawn != NULL; ++i) {
        relief_bake_free(&drawn[i]);
    }
    free(drawn);
    free(best);
    return ok;
}
