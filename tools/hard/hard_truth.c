/* hard_truth.c: references for hard cases: rays, light and one bounce in double, triangle by triangle. */
#include <math.h>

#include "hard_stage.h"

#define PI 3.14159265358979323846

/* --- random numbers: PCG XSH-RR (O'Neill 2014) -------------------------------------------------------------------- */

uint32_t hard_random(uint64_t *state)
{
    const uint64_t s = *state;
    const uint32_t x = (uint32_t)(((s >> 18) ^ s) >> 27), turn = (uint32_t)(s >> 59);
    *state = s * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (x >> turn) | (x << ((32u - turn) & 31u));
}

double hard_uniform(uint64_t *state, double low, double high)
{
    return low + (high - low) * ((double)hard_random(state) / 4294967296.0);
}

dvec hard_direction(uint64_t *state)
{
    const double z = hard_uniform(state, -1.0, 1.0), a = hard_uniform(state, 0.0, 2.0 * PI), r = sqrt(1.0 - z * z);
    return dvec_of(r * cos(a), r * sin(a), z);
}

/* --- rays --------------------------------------------------------------------------------------------------------- */

static dvec read3(lmb_vec3 v) { return dvec_of((double)v.x, (double)v.y, (double)v.z); }

dvec hard_ray(dvec *from, const lmb_view *v, double x, double y)
{
    const double sx = (2.0 * x / v->frame_width - 1.0) * (double)v->half_width,
                 sy = (1.0 - 2.0 * y / v->frame_height) * (double)v->half_height;
    const dvec across = dvec_add(dvec_mul(read3(v->right), sx), dvec_mul(read3(v->up), sy));
    const dvec ahead = dvec_mul(read3(v->back), -1.0);
    *from = v->kind == LMB_PERSPECTIVE ? read3(v->eye) : dvec_add(read3(v->eye), across);
    return v->kind == LMB_PERSPECTIVE ? dvec_add(across, ahead) : ahead;
}

dvec hard_surface(dvec *normal, const hard_stage *s, int32_t x, int32_t y, uint32_t id)
{
    const dvec *c = s->world[id - 1], n = dvec_unit(dvec_turn(c[0], c[1], c[2]));
    dvec from, ray = hard_ray(&from, &s->view, x + 0.5, y + 0.5);
    const double t = dvec_dot(dvec_sub(c[0], from), n) / dvec_dot(ray, n);
    *normal = dvec_dot(ray, n) < 0.0 ? n : dvec_mul(n, -1.0);
    return dvec_add(from, dvec_mul(ray, t));
}

/* Moeller and Trumbore's test of the open segment; ends within a billionth count as on the triangle. */
static int crosses(const dvec t[3], dvec from, dvec way)
{
    const dvec e1 = dvec_sub(t[1], t[0]), e2 = dvec_sub(t[2], t[0]), p = dvec_cross(way, e2), d = dvec_sub(from, t[0]);
    const double det = dvec_dot(e1, p);
    if (det == 0.0) {
        return 0;
    }
    const double u = dvec_dot(d, p) / det;
    const dvec q = dvec_cross(d, e1);
    const double v = dvec_dot(way, q) / det, at = dvec_dot(e2, q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > 1e-9 && at < 1.0 - 1e-9;
}

int hard_occluded(const hard_stage *s, dvec from, dvec to, uint32_t a, uint32_t b)
{
    const dvec way = dvec_sub(to, from);
    for (uint32_t i = 0; i < s->count; ++i) {
        if (i + 1 != a && i + 1 != b && crosses(s->world[i], from, way)) {
            return 1;
        }
    }
    return 0;
}

/* --- light -------------------------------------------------------------------------------------------------------- */

/* Relative intensity towards `way` (from the light): the smoothstep between the cones. */
static double spot_share(const lmb_light *l, dvec way)
{
    const double outer = (double)l->cos_outer, width = (double)l->cos_inner - outer;
    const double t = (dvec_dot(dvec_unit(way), read3(l->direction)) - outer) / fmax(width, 1e-6);
    const double c = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return c * c * (3.0 - 2.0 * c);
}

double hard_true_direct(const hard_stage *s, dvec at, dvec normal, uint32_t id)
{
    const lmb_light *l = &s->light;
    const int sun = l->kind == LMB_LIGHT_DIRECTIONAL;
    const dvec low = read3(s->scene.bounds_min), high = read3(s->scene.bounds_max);
    const double far = 2.0 * dvec_length(dvec_sub(high, low));
    const dvec to = sun ? dvec_mul(read3(l->direction), -far) : dvec_sub(read3(l->position), at);
    const double d = dvec_length(to), cosine = dvec_dot(to, normal) / d;
    if (!(cosine > 0.0) || hard_occluded(s, at, dvec_add(at, to), id, 0)) {
        return 0.0;
    }
    const double share = l->kind == LMB_LIGHT_SPOT ? spot_share(l, dvec_mul(to, -1.0)) : 1.0;
    return (double)l->intensity[0] * share * cosine / (sun ? 1.0 : d * d);
}

/* Clips a polygon by the plane through `at`, which adds at most one corner. */
static int before_plane(dvec *out, dvec at, dvec normal, const dvec *corner, int count)
{
    int n = 0;
    for (int i = 0; i < count; ++i) {
        const dvec a = dvec_sub(corner[i], at), b = dvec_sub(corner[(i + 1) % count], at);
        const double da = dvec_dot(a, normal), db = dvec_dot(b, normal);
        if (da >= 0.0) {
            out[n++] = a;
        }
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
            out[n++] = dvec_mix(a, b, da / (da - db));
        }
    }
    return n;
}

/* Lambert's sum over the edges: the angle of each times the cosine between edge plane and normal. */
double hard_true_factor(dvec at, dvec normal, const dvec *corner, int count)
{
    dvec p[10];
    const int n = before_plane(p, at, normal, corner, count);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        const dvec a = p[i], b = p[(i + 1) % n], c = dvec_cross(a, b);
        const double length = dvec_length(c);
        sum += length > 0.0 ? dvec_dot(c, normal) / length * atan2(length, dvec_dot(a, b)) : 0.0;
    }
    return fabs(sum) / (2.0 * PI);
}

/* Light from a piece of triangle t around `from` on a surface element. */
static double one_piece(const hard_stage *s, uint32_t t, dvec from, double area, double albedo, dvec at, dvec normal,
                        uint32_t id)
{
    const dvec *c = s->world[t], out = dvec_unit(dvec_turn(c[0], c[1], c[2])), way = dvec_sub(from, at);
    const double d2 = dvec_dot(way, way), cos_at = dvec_dot(way, normal);
    const double side = dvec_dot(way, out) < 0.0 ? 1.0 : -1.0;
    if (!(cos_at > 0.0) || !(d2 > 0.0)) {
        return 0.0;
    }
    const double received = hard_true_direct(s, from, dvec_mul(out, side), t + 1);
    if (received == 0.0 || hard_occluded(s, at, from, id, t + 1)) {
        return 0.0;
    }
    return received * albedo / PI * area * cos_at * fabs(dvec_dot(way, out)) / (d2 * d2);
}

static double albedo_of(const hard_stage *s, uint32_t t)
{
    uint32_t k = 0;
    while (k + 1 < s->parts && s->first[k + 1] <= t) {
        ++k;
    }
    return (double)s->material[k].albedo[0];
}

/* Divides the triangle into n x n parts of equal area, each represented by its middle: n (n + 1) / 2 have the same
 * orientation, the others are reversed. */
static double one_triangle(const hard_stage *s, uint32_t t, dvec at, dvec normal, uint32_t id, int n)
{
    const dvec *c = s->world[t], u = dvec_mul(dvec_sub(c[1], c[0]), 1.0 / n),
               v = dvec_mul(dvec_sub(c[2], c[0]), 1.0 / n);
    const double area = 0.5 * dvec_length(dvec_cross(u, v)), albedo = albedo_of(s, t);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k + i < n; ++k) {
            for (int turned = 0; turned < (k + i + 1 < n ? 2 : 1); ++turned) {
                const double o = turned ? 2.0 / 3.0 : 1.0 / 3.0;
                const dvec from = dvec_add(c[0], dvec_add(dvec_mul(u, i + o), dvec_mul(v, k + o)));
                sum += one_piece(s, t, from, area, albedo, at, normal, id);
            }
        }
    }
    return sum;
}

double hard_true_bounce(const hard_stage *s, dvec at, dvec normal, uint32_t id, int n)
{
    double sum = 0.0;
    for (uint32_t t = 0; t < s->count; ++t) {
        sum += t + 1 != id ? one_triangle(s, t, at, normal, id, n) : 0.0;
    }
    return sum;
}
