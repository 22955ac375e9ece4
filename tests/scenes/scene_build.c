/* scene_build.c: functions that build scenes: random numbers, solids, walls with openings, lights. */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- numbers ------------------------------------------------------------------------------------------------------ */

svec unit(svec a) { return times(a, 1.0 / sqrt(dot_of(a, a))); }

/* A Taylor series after reduction to a quarter turn, because libraries differ in the last bit. */
double sine(double degrees)
{
    double turns = degrees / 360.0, x, term, sum;
    turns -= floor(turns);
    if (turns > 0.75) {
        turns -= 1.0;
    } else if (turns > 0.25) {
        turns = 0.5 - turns;
    }
    x = turns * 6.283185307179586;
    sum = term = x;
    for (int k = 1; k < 11; ++k) {
        term *= -x * x / (double)((2 * k) * (2 * k + 1));
        sum += term;
    }
    return sum;
}

double cosine(double degrees) { return sine(degrees + 90.0); }

/* PCG XSH-RR (O'Neill 2014). */
static uint32_t random_bits(made_scene *s)
{
    const uint64_t r = s->random;
    const uint32_t x = (uint32_t)(((r >> 18) ^ r) >> 27), turn = (uint32_t)(r >> 59);
    s->random = r * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (x >> turn) | (x << ((32u - turn) & 31u));
}

double any_between(made_scene *s, double low, double high)
{
    return low + (high - low) * ((double)random_bits(s) / 4294967296.0);
}

static double lattice(int x, int y, int z, uint32_t seed)
{
    uint32_t h = (uint32_t)x * 0x8da6b343u ^ (uint32_t)y * 0xd8163841u ^ (uint32_t)z * 0xcb1ab31fu ^ seed * 0x9e3779b9u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    h ^= h >> 15;
    return (double)h / 2147483648.0 - 1.0;
}

static double ease(double t) { return t * t * (3.0 - 2.0 * t); }

double smooth_noise(svec p, uint32_t seed)
{
    const double fx = floor(p.x), fy = floor(p.y), fz = floor(p.z);
    const double t[3] = {ease(p.x - fx), ease(p.y - fy), ease(p.z - fz)};
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        const double share = (i ? t[0] : 1.0 - t[0]) * (j ? t[1] : 1.0 - t[1]) * (l ? t[2] : 1.0 - t[2]);
        sum += share * lattice((int)fx + i, (int)fy + j, (int)fz + l, seed);
    }
    return sum;
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

int paint(made_scene *s, double red, double green, double blue)
{
    const int m = s->material_count++;
    s->albedo[m][0] = red;
    s->albedo[m][1] = green;
    s->albedo[m][2] = blue;
    return m;
}

static void grow(made_scene *s)
{
    s->room = s->room > 0 ? 2 * s->room : 4096;
    s->corners = realloc(s->corners, sizeof *s->corners * 3 * s->room);
    s->materials = realloc(s->materials, s->room);
    if (s->corners == NULL || s->materials == NULL) {
        fprintf(stderr, "scenes: not enough memory for %u triangles\n", (unsigned)s->room);
        exit(1);
    }
}

void triangle(made_scene *s, int material, svec a, svec b, svec c)
{
    if (s->triangles == s->room) {
        grow(s);
    }
    svec *to = s->corners + (size_t)s->triangles * 3;
    to[0] = a;
    to[1] = b;
    to[2] = c;
    s->materials[s->triangles++] = (uint8_t)material;
}

void quad(made_scene *s, int material, svec a, svec b, svec c, svec d)
{
    triangle(s, material, a, b, c);
    triangle(s, material, a, c, d);
}

/* --- solids ------------------------------------------------------------------------------------------------------- */

void slab(made_scene *s, int material, svec a, svec u, svec v, svec w)
{
    const svec au = plus(a, u), av = plus(a, v), auv = plus(au, v);
    quad(s, material, a, av, auv, au);
    quad(s, material, plus(a, w), plus(au, w), plus(auv, w), plus(av, w));
    quad(s, material, a, au, plus(au, w), plus(a, w));
    quad(s, material, av, plus(av, w), plus(auv, w), auv);
    quad(s, material, a, plus(a, w), plus(av, w), av);
    quad(s, material, au, auv, plus(auv, w), plus(au, w));
}

void box(made_scene *s, int material, svec low, svec high)
{
    const svec d = less(high, low);
    slab(s, material, low, at(d.x, 0, 0), at(0, d.y, 0), at(0, 0, d.z));
}

void crate(made_scene *s, int material, svec foot, svec size, double degrees)
{
    const svec u = times(at(cosine(degrees), 0, sine(degrees)), size.x);
    const svec w = times(at(-sine(degrees), 0, cosine(degrees)), size.z);
    slab(s, material, less(foot, times(plus(u, w), 0.5)), u, at(0, size.y, 0), w);
}

void shell(made_scene *s, int floor, int wall_paint, int ceiling, svec low, svec high)
{
    const svec x = at(high.x - low.x, 0, 0), y = at(0, high.y - low.y, 0), z = at(0, 0, high.z - low.z);
    panel(s, floor, low, x, z, NULL, 0);
    panel(s, ceiling, plus(low, y), x, z, NULL, 0);
    panel(s, wall_paint, low, x, y, NULL, 0);
    panel(s, wall_paint, plus(low, z), x, y, NULL, 0);
    panel(s, wall_paint, low, z, y, NULL, 0);
    panel(s, wall_paint, plus(low, x), z, y, NULL, 0);
}

void tube(made_scene *s, int material, svec a, svec b, double radius_a, double radius_b, int sides)
{
    const svec d = unit(less(b, a)), other = fabs(d.y) < 0.9 ? at(0, 1, 0) : at(1, 0, 0);
    const svec u = unit(cross_of(other, d)), v = cross_of(d, u);
    for (int k = 0; k < sides; ++k) {
        const double t0 = 360.0 * k / sides, t1 = 360.0 * ((k + 1) % sides) / sides;
        const svec r0 = plus(times(u, cosine(t0)), times(v, sine(t0)));
        const svec r1 = plus(times(u, cosine(t1)), times(v, sine(t1)));
        quad(s, material, plus(a, times(r0, radius_a)), plus(a, times(r1, radius_a)), plus(b, times(r1, radius_b)),
             plus(b, times(r0, radius_b)));
    }
}

static svec on_ball(svec centre, double radius, double turn, double height)
{
    return plus(centre, times(at(cosine(turn) * cosine(height), sine(height), sine(turn) * cosine(height)), radius));
}

void ball(made_scene *s, int material, svec centre, double radius, int rings)
{
    for (int j = 0; j < rings; ++j) {
        const double h0 = -90.0 + 180.0 * j / rings, h1 = -90.0 + 180.0 * (j + 1) / rings;
        for (int i = 0; i < 2 * rings; ++i) {
            const double t0 = 180.0 * i / rings, t1 = 180.0 * ((i + 1) % (2 * rings)) / rings;
            const svec a = on_ball(centre, radius, t0, h0), b = on_ball(centre, radius, t1, h0);
            const svec c = on_ball(centre, radius, t1, h1), d = on_ball(centre, radius, t0, h1);
            if (j + 1 < rings) {
                triangle(s, material, a, c, d);
            }
            if (j > 0) {
                triangle(s, material, a, b, c);
            }
        }
    }
}

/* --- walls with openings ------------------------------------------------------------------------------------------ */

enum { CUTS = 256 };

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The distinct positions along one edge at which a panel is cut. */
static int cuts_of(double *cut, double length, const opening *holes, int count, int along_v)
{
    int n = 0, kept = 0;
    cut[n++] = 0.0;
    cut[n++] = length;
    for (int i = 0; i < count; ++i) {
        cut[n++] = along_v ? holes[i].v0 : holes[i].u0;
        cut[n++] = along_v ? holes[i].v1 : holes[i].u1;
    }
    qsort(cut, (size_t)n, sizeof *cut, rising);
    for (int i = 0; i < n; ++i) {
        if (kept == 0 || cut[i] > cut[kept - 1]) {
            cut[kept++] = cut[i];
        }
    }
    return kept;
}

static int is_open(double u, double v, const opening *holes, int count)
{
    for (int i = 0; i < count; ++i) {
        if (u > holes[i].u0 && u < holes[i].u1 && v > holes[i].v0 && v < holes[i].v1) {
            return 1;
        }
    }
    return 0;
}

void panel(made_scene *s, int material, svec a, svec u, svec v, const opening *holes, int count)
{
    double cu[CUTS], cv[CUTS];
    const double lu = sqrt(dot_of(u, u)), lv = sqrt(dot_of(v, v));
    const int nu = cuts_of(cu, lu, holes, count, 0), nv = cuts_of(cv, lv, holes, count, 1);
    for (int j = 0; j + 1 < nv; ++j) {
        const svec low = plus(a, times(v, cv[j] / lv)), high = plus(a, times(v, cv[j + 1] / lv));
        for (int i = 0; i + 1 < nu; ++i) {
            const svec left = times(u, cu[i] / lu), right = times(u, cu[i + 1] / lu);
            if (!is_open(0.5 * (cu[i] + cu[i + 1]), 0.5 * (cv[j] + cv[j + 1]), holes, count)) {
                quad(s, material, plus(low, left), plus(low, right), plus(high, right), plus(high, left));
            }
        }
    }
}

/* The four sides of a rectangle in the plane u, v, extruded along w. */
static void sides(made_scene *s, int material, svec a, svec u, svec v, svec w)
{
    const svec c[5] = {a, plus(a, u), plus(plus(a, u), v), plus(a, v), a};
    for (int k = 0; k < 4; ++k) {
        quad(s, material, c[k], c[k + 1], plus(c[k + 1], w), plus(c[k], w));
    }
}

void wall(made_scene *s, int material, svec a, svec u, svec v, svec w, const opening *holes, int count)
{
    const svec eu = unit(u), ev = unit(v);
    panel(s, material, a, u, v, holes, count);
    panel(s, material, plus(a, w), u, v, holes, count);
    sides(s, material, a, u, v, w);
    for (int i = 0; i < count; ++i) {
        const opening *h = &holes[i];
        sides(s, material, plus(a, plus(times(eu, h->u0), times(ev, h->v0))), times(eu, h->u1 - h->u0),
              times(ev, h->v1 - h->v0), w);
    }
}

/* --- lights and the view ------------------------------------------------------------------------------------------ */

static scene_light *new_light(made_scene *s, int kind, double strength)
{
    scene_light *l = &s->lights[s->light_count++];
    l->kind = kind;
    l->direction = at(0, -1, 0);
    l->rgb[0] = l->rgb[1] = l->rgb[2] = strength;
    return l;
}

void spot(made_scene *s, svec from, svec towards, double watts_per_sr, double inner_deg, double outer_deg)
{
    scene_light *l = new_light(s, SCENE_SPOT, watts_per_sr);
    l->position = from;
    l->direction = less(towards, from);
    l->inner_deg = inner_deg;
    l->outer_deg = outer_deg;
}

void point(made_scene *s, svec from, double watts_per_sr) { new_light(s, SCENE_POINT, watts_per_sr)->position = from; }

void sun(made_scene *s, svec direction, double watts_per_m2)
{
    new_light(s, SCENE_SUN, watts_per_m2)->direction = direction;
}

void look(made_scene *s, svec eye, svec target, double fov_deg)
{
    s->eye = eye;
    s->target = target;
    s->up = at(0, 1, 0);
    s->fov_deg = fov_deg;
    s->near_m = 0.01;
}

void sun_through(made_scene *s, svec low, svec high)
{
    s->open_low = low;
    s->open_high = high;
}
