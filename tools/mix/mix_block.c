/* mix_block.c: small pictures of an object from many directions, which show the blocked parts of the environment. */
#include "mix_block.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WAY_SIDE = 64, MARGIN = 2 /* texels around the object */ };

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* Calls of fminf and fmaxf took a twentieth of a placement. */
static float min_of(float a, float b) { return a < b ? a : b; }
static float max_of(float a, float b) { return a > b ? a : b; }

static lmb_vec3 less(lmb_vec3 a, lmb_vec3 b) { return (lmb_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }

static lmb_vec3 cross(lmb_vec3 a, lmb_vec3 b)
{
    return (lmb_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static lmb_vec3 unit(lmb_vec3 a)
{
    const float by = 1.0f / sqrtf(fmaxf(dot(a, a), 1e-30f));
    return (lmb_vec3){a.x * by, a.y * by, a.z * by};
}

/* --- the object --------------------------------------------------------------------------------------------------- */

static int is_finite(const float *corner)
{
    float sum = 0.0f;
    for (int i = 0; i < 9; ++i) {
        sum += corner[i] * 0.0f;
    }
    return sum == 0.0f;
}

/* Copies all corners, and finds the mean albedo. */
static void copy_triangles(mix_block *b, const lmb_scene *s)
{
    const uint32_t count = lmb_scene_triangles(s);
    double area_of_all = 0.0, albedo[3] = {0, 0, 0};
    for (uint32_t i = 0; i < count; ++i) {
        lmb_triangle t;
        lmb_vec3 normal;
        float area = 0.0f, *to = b->corner + 9 * (size_t)b->triangles;
        if (!lmb_triangle_fetch(&t, s, i + 1)) {
            continue;
        }
        memcpy(to, t.corner, 9 * sizeof *to);
        b->triangles += is_finite(to) ? 1 : 0;
        if (lmb_triangle_shape(&normal, &area, &t)) {
            float rgb[3] = {t.material->albedo[0], t.material->albedo[1], t.material->albedo[2]};
            area_of_all += (double)area;
            for (int c = 0; c < 3; ++c) {
                albedo[c] += (double)area * (double)(t.material->texture >= 0 ? 0.5f * rgb[c] : rgb[c]);
            }
        }
    }
    for (int c = 0; c < 3; ++c) {
        b->albedo[c] = area_of_all > 0.0 ? (float)(albedo[c] / area_of_all) : 0.5f;
    }
}

static void find_sphere(mix_block *b)
{
    lmb_vec3 low = {FLT_MAX, FLT_MAX, FLT_MAX}, high = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    float far = 0.0f;
    for (size_t i = 0; i < 3 * (size_t)b->triangles; ++i) {
        const float *p = b->corner + 3 * i;
        low = (lmb_vec3){fminf(low.x, p[0]), fminf(low.y, p[1]), fminf(low.z, p[2])};
        high = (lmb_vec3){fmaxf(high.x, p[0]), fmaxf(high.y, p[1]), fmaxf(high.z, p[2])};
    }
    if (b->triangles == 0) {
        return;
    }
    b->middle = (lmb_vec3){0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    for (size_t i = 0; i < 3 * (size_t)b->triangles; ++i) {
        const lmb_vec3 p = {b->corner[3 * i], b->corner[3 * i + 1], b->corner[3 * i + 2]}, d = less(p, b->middle);
        far = fmaxf(far, dot(d, d));
    }
    b->radius = sqrtf(far);
}

/* Directions on a Fibonacci spiral. */
static lmb_vec3 way_of(int32_t i)
{
    const float y = 1.0f - (2.0f * (float)i + 1.0f) / (float)MIX_BLOCK_WAYS, level = sqrtf(1.0f - y * y),
                turn = 2.3999632f * (float)i;
    return (lmb_vec3){level * cosf(turn), y, level * sinf(turn)};
}

int mix_block_make(mix_block *out, const lmb_scene *scene)
{
    const size_t triangles = lmb_scene_triangles(scene), bytes = mix_block_bytes(WAY_SIDE);
    memset(out, 0, sizeof *out);
    out->corner = malloc((9 * triangles + 1) * sizeof *out->corner);
    out->memory = malloc(MIX_BLOCK_WAYS * bytes);
    if (out->corner == NULL || out->memory == NULL) {
        mix_block_free(out);
        return 0;
    }
    copy_triangles(out, scene);
    find_sphere(out);
    for (int32_t i = 0; i < MIX_BLOCK_WAYS; ++i) {
        mix_block_look(&out->way[i], out, way_of(i), 0, WAY_SIDE, (char *)out->memory + (size_t)i * bytes);
    }
    return 1;
}

void mix_block_free(mix_block *b)
{
    free(b->corner);
    free(b->memory);
    memset(b, 0, sizeof *b);
}

/* --- a view ------------------------------------------------------------------------------------------------------- */

size_t mix_block_bytes(int32_t side)
{
    const size_t n = (size_t)side;
    return (n * n + (n + 1) * (n + 1)) * sizeof(float);
}

/* Position in texels, and the key, which is affine over a triangle in the picture: of a point light it grows like
 * 1 / distance and, at the middle, by one per unit. */
static lmb_vec3 project(const mix_block_view *v, lmb_vec3 p)
{
    const lmb_vec3 d = less(p, v->middle);
    const float x = dot(v->x, d), y = dot(v->y, d), to = dot(v->to, d), half = 0.5f * (float)v->side;
    if (!v->is_near) {
        return (lmb_vec3){half + v->per_unit * x, half + v->per_unit * y, to};
    }
    const float by = v->away / max_of(v->away - to, 1e-3f * v->away);
    return (lmb_vec3){half + v->per_unit * x * by, half + v->per_unit * y * by, v->away * by};
}

static void draw_triangle(const mix_block_view *v, const lmb_vec3 p[3])
{
    const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y),
                side = (float)v->side;
    const float x0 = max_of(min_of(min_of(p[0].x, p[1].x), p[2].x), 0.0f),
                x1 = min_of(max_of(max_of(p[0].x, p[1].x), p[2].x), side),
                y0 = max_of(min_of(min_of(p[0].y, p[1].y), p[2].y), 0.0f),
                y1 = min_of(max_of(max_of(p[0].y, p[1].y), p[2].y), side);
    if (!(fabsf(area) > 1e-12f)) {
        return;
    }
    const float by = 1.0f / area;
    for (int32_t y = (int32_t)ceilf(y0 - 0.5f); (float)y + 0.5f <= y1 && y < v->side; ++y) {
        for (int32_t x = (int32_t)ceilf(x0 - 0.5f); (float)x + 0.5f <= x1 && x < v->side; ++x) {
            const float dx = (float)x + 0.5f - p[0].x, dy = (float)y + 0.5f - p[0].y,
                        b = (dx * (p[2].y - p[0].y) - (p[2].x - p[0].x) * dy) * by,
                        c = ((p[1].x - p[0].x) * dy - dx * (p[1].y - p[0].y)) * by;
            if (b >= 0.0f && c >= 0.0f && b + c <= 1.0f) {
                float *key = &v->key[y * v->side + x];
                *key = max_of(*key, p[0].z + b * (p[1].z - p[0].z) + c * (p[2].z - p[0].z));
            }
        }
    }
}

static void sum_up(mix_block_view *v)
{
    const int32_t n = v->side + 1;
    memset(v->sum, 0, (size_t)n * sizeof *v->sum);
    for (int32_t y = 0; y < v->side; ++y) {
        float row = 0.0f;
        v->sum[(y + 1) * n] = 0.0f;
        for (int32_t x = 0; x < v->side; ++x) {
            row += v->key[y * v->side + x] > -FLT_MAX ? 1.0f : 0.0f;
            v->sum[(y + 1) * n + x + 1] = v->sum[y * n + x + 1] + row;
        }
    }
}

int mix_block_look(mix_block_view *v, const mix_block *b, lmb_vec3 to, int is_near, int32_t side, void *memory)
{
    const lmb_vec3 off = less(to, b->middle);
    memset(v, 0, sizeof *v);
    v->away = sqrtf(dot(off, off));
    v->is_near = is_near;
    v->to = unit(is_near ? off : to);
    v->x = unit(fabsf(v->to.y) < 0.9f ? (lmb_vec3){v->to.z, 0, -v->to.x} : (lmb_vec3){0, -v->to.z, v->to.y});
    v->y = cross(v->to, v->x);
    v->middle = b->middle;
    v->side = side;
    v->key = memory;
    v->sum = v->key + (size_t)side * (size_t)side;
    if (is_near && !(v->away > 1.05f * b->radius)) {
        return 0;
    }
    const float grows = is_near ? v->away / sqrtf(v->away * v->away - b->radius * b->radius) : 1.0f;
    v->per_unit = (0.5f * (float)side - MARGIN) / max_of(grows * b->radius, 1e-30f);
    for (int32_t i = 0; i < side * side; ++i) {
        v->key[i] = -FLT_MAX;
    }
    for (uint32_t i = 0; i < b->triangles; ++i) {
        lmb_vec3 p[3];
        for (int k = 0; k < 3; ++k) {
            const float *c = b->corner + 9 * (size_t)i + 3 * k;
            p[k] = project(v, (lmb_vec3){c[0], c[1], c[2]});
        }
        draw_triangle(v, p);
    }
    v->low = FLT_MAX;
    v->high = -FLT_MAX;
    for (int32_t i = 0; i < side * side; ++i) {
        v->low = v->key[i] > -FLT_MAX ? min_of(v->low, v->key[i]) : v->low;
        v->high = max_of(v->high, v->key[i]);
    }
    sum_up(v);
    return 1;
}

/* --- questions ---------------------------------------------------------------------------------------------------- */

/* The sum up to a place between texels. */
static float summed(const mix_block_view *v, float x, float y)
{
    const int32_t n = v->side + 1;
    const float side = (float)v->side, u = min_of(max_of(x, 0.0f), side - 1e-3f),
                w = min_of(max_of(y, 0.0f), side - 1e-3f);
    const int32_t i = (int32_t)u, k = (int32_t)w;
    const float s = u - (float)i, t = w - (float)k, *at = v->sum + k * n + i;
    const float above = at[0] + s * (at[1] - at[0]), below = at[n] + s * (at[n + 1] - at[n]);
    return above + t * (below - above);
}

float mix_block_soft(const mix_block_view *v, lmb_vec3 p, float spread)
{
    const lmb_vec3 at = project(v, p);
    const float far = max_of(0.5f * (v->low + v->high) - at.z, 0.0f), half = max_of(far * spread * v->per_unit, 0.5f),
                side = (float)v->side;
    if (at.z > v->high || at.x + half <= 0.0f || at.y + half <= 0.0f || at.x - half >= side || at.y - half >= side) {
        return 0.0f;
    }
    const float covered = summed(v, at.x + half, at.y + half) - summed(v, at.x - half, at.y + half) -
                          summed(v, at.x + half, at.y - half) + summed(v, at.x - half, at.y - half);
    return min_of(max_of(covered / (4.0f * half * half), 0.0f), 1.0f);
}

float mix_block_hard(const mix_block_view *v, lmb_vec3 p, float bias)
{
    const lmb_vec3 at = project(v, p);
    const float u = at.x - 0.5f, w = at.y - 0.5f;
    if (!(u >= 0.0f) || !(w >= 0.0f) || !(u < (float)(v->side - 1)) || !(w < (float)(v->side - 1)) ||
        at.z + bias >= v->high) {
        return 0.0f;
    }
    const int32_t i = (int32_t)u, k = (int32_t)w;
    const float s = u - (float)i, t = w - (float)k, *key = v->key + k * v->side + i, limit = at.z + bias;
    const float a = key[0] > limit ? 1.0f : 0.0f, b = key[1] > limit ? 1.0f : 0.0f,
                c = key[v->side] > limit ? 1.0f : 0.0f, d = key[v->side + 1] > limit ? 1.0f : 0.0f,
                above = a + s * (b - a), below = c + s * (d - c);
    return above + t * (below - above);
}
