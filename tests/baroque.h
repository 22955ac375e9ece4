/* baroque.h: ornate shapes in code, of any number of triangles: an urn, drapery, scrolls, a knot of beaded ribbons. A
 * seed changes their numbers and turns them; two seeds share nothing but the kind. They have folds, undercuts and
 * ornament down to a hundredth of their size, which is what reliefs find hard. */
#ifndef BAROQUE_H
#define BAROQUE_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../tools/common/dvec.h"
#include "../tools/mesh/simplify.h"

enum { BAROQUE_URN, BAROQUE_DRAPERY, BAROQUE_SCROLLS, BAROQUE_KNOT, BAROQUE_KINDS };

#define BAROQUE_TURN 6.283185307179586

typedef struct baroque_shape {
    triangle_mesh mesh; /* positions and indices; room for as many as `most` */
    uint32_t random;
    double pick[8];     /* 0 .. 1, by the seed */
    double turn[9];     /* rotation, by rows */
    int part;           /* of the kind, for its surfaces */
} baroque_shape;

/* A place of a surface: u goes around, v along, both 0 .. 1. */
typedef dvec (*baroque_surface)(const baroque_shape *s, double u, double v);

static inline double baroque_random(baroque_shape *s)
{
    s->random = s->random * 1664525u + 1013904223u;
    return (double)(s->random >> 8) / 16777216.0;
}

static inline double baroque_ramp(double low, double high, double x)
{
    const double t = x <= low ? 0.0 : x >= high ? 1.0 : (x - low) / (high - low);
    return t * t * (3.0 - 2.0 * t);
}

/* Turns the triangles from number `first` on where they look inwards: reliefs need faces that look outwards. */
static inline void baroque_outwards(triangle_mesh *m, uint32_t first)
{
    double sum = 0.0;
    for (uint32_t t = first; t < m->triangle_count; ++t) {
        const uint32_t *i = m->indices + 3 * (size_t)t;
        sum += dvec_dot(dvec_read(m->positions + 3 * (size_t)i[0]),
                        dvec_cross(dvec_read(m->positions + 3 * (size_t)i[1]),
                                   dvec_read(m->positions + 3 * (size_t)i[2])));
    }
    for (uint32_t t = first; t < m->triangle_count && sum < 0.0; ++t) {
        uint32_t *i = m->indices + 3 * (size_t)t, was = i[1];
        i[1] = i[2];
        i[2] = was;
    }
}

/* across x along squares; u comes round to the first column, and both ends are closed where the surface is a point
 * there. */
static inline void baroque_add(baroque_shape *s, baroque_surface surface, uint32_t across, uint32_t along)
{
    triangle_mesh *m = &s->mesh;
    const uint32_t first = m->vertex_count, triangle = m->triangle_count;
    for (uint32_t k = 0; k <= along; ++k) {
        for (uint32_t i = 0; i < across; ++i) {
            const dvec p = surface(s, (double)i / across, (double)k / along);
            const double *t = s->turn;
            float *to = m->positions + 3 * (size_t)m->vertex_count++;
            to[0] = (float)(t[0] * p.x + t[1] * p.y + t[2] * p.z);
            to[1] = (float)(t[3] * p.x + t[4] * p.y + t[5] * p.z);
            to[2] = (float)(t[6] * p.x + t[7] * p.y + t[8] * p.z);
        }
    }
    for (uint32_t k = 0; k < along; ++k) {
        for (uint32_t i = 0; i < across; ++i) {
            const uint32_t a = first + k * across + i, b = first + k * across + (i + 1) % across;
            const uint32_t square[6] = {a, a + across, b + across, a, b + across, b};
            memcpy(m->indices + 3 * (size_t)m->triangle_count, square, sizeof square);
            m->triangle_count += 2;
        }
    }
    baroque_outwards(m, triangle);
}

/* A place on a tube around a curve, whose direction is found by a step along it; `up` is nowhere along the curve. */
static inline dvec baroque_tube(dvec at, dvec ahead, dvec up, double u, double radius)
{
    const dvec along = dvec_unit(dvec_sub(ahead, at)), side = dvec_unit(dvec_cross(along, up)),
               top = dvec_cross(side, along);
    const double a = BAROQUE_TURN * u;
    return dvec_add(at, dvec_add(dvec_mul(side, radius * cos(a)), dvec_mul(top, radius * sin(a))));
}

/* --- an urn: gadroons below, leaves in relief around, a fluted neck, two handles ---------------------------------- */

static inline dvec baroque_urn_body(const baroque_shape *s, double u, double v)
{
    const double y = 2.0 * v - 1.0, a = BAROQUE_TURN * u, ends = sqrt(fmax(0.0, 1.0 - pow(fabs(y), 12.0)));
    const double belly = 0.34 + 0.28 * exp(-12.0 * (y + 0.05) * (y + 0.05)) + 0.16 * baroque_ramp(0.55, 0.95, y)
                         + 0.2 * baroque_ramp(-0.7, -0.95, y) - 0.16 * exp(-60.0 * (y + 0.62) * (y + 0.62));
    const double gadroons = fabs(sin((8.0 + floor(5.0 * s->pick[0])) * (a + 1.5 * y)));
    const double low = 1.0 - baroque_ramp(-0.25, -0.15, y), high = baroque_ramp(0.4, 0.5, y);
    const double leaf = sin(7.0 * a + 6.0 * sin(9.0 * y + s->pick[1])) * sin(25.0 * y + 3.0 * sin(7.0 * a));
    const double veins = 0.012 * sin(60.0 * y + 8.0 * sin(7.0 * a));
    const double flutes = pow(fabs(sin(12.0 * a)), 0.5);
    const double middle = (1.0 - low) * (1.0 - high);
    const double r = belly + 0.06 * low * gadroons + middle * (0.06 * baroque_ramp(-0.1, 0.3, leaf) + veins)
                     + 0.04 * high * flutes + 0.05 * exp(-900.0 * (y - 0.45) * (y - 0.45))
                     + 0.05 * exp(-900.0 * (y + 0.22) * (y + 0.22));
    return (dvec){r * ends * cos(a), 1.3 * y, -r * ends * sin(a)};
}

static inline dvec baroque_handle_at(const baroque_shape *s, double t)
{
    const double a = 1.1 * BAROQUE_TURN * t, side = s->part ? -1.0 : 1.0, r = 0.36 * (1.0 - 0.45 * t);
    return (dvec){side * (0.72 + r * sin(a) * 0.9), 0.55 + 0.55 * (0.4 - t) + r * cos(a) * 0.7,
                  0.18 * (s->pick[2] - 0.5) * sin(3.0 * a)};
}

static inline dvec baroque_handle(const baroque_shape *s, double u, double v)
{
    const double ends = sqrt(fmax(0.0, 1.0 - pow(fabs(2.0 * v - 1.0), 8.0)));
    const double r = 0.055 * ends * (1.0 + 0.3 * sin(5.0 * BAROQUE_TURN * u + 40.0 * v) + 0.15 * sin(90.0 * v));
    return baroque_tube(baroque_handle_at(s, v), baroque_handle_at(s, v + 1e-4), (dvec){0.1, 0.05, 1.0},
                        u, r);
}

/* --- drapery: a tall body under folds that hang, turn over and meet ----------------------------------------------- */

static inline dvec baroque_cloth(const baroque_shape *s, double u, double v)
{
    const double y = 2.0 * v - 1.0, a = BAROQUE_TURN * u, ends = sqrt(fmax(0.0, 1.0 - pow(fabs(y), 10.0)));
    const double hang = 1.0 - baroque_ramp(-0.9, 0.7, y), folds = 9.0 + floor(4.0 * s->pick[0]);
    const double phase = folds * a + 2.2 * sin(2.5 * y + 6.0 * s->pick[1]) + 1.2 * sin(2.0 * a + 3.0 * y);
    const double fold = sin(phase + 0.75 * sin(phase)), over = cos(phase);
    const double fine = 0.014 * sin(3.0 * phase + 9.0 * y) + 0.01 * sin(31.0 * y + 4.0 * sin(5.0 * a));
    const double sash = exp(-90.0 * pow(y - 0.25 + 0.12 * sin(a + 5.0 * s->pick[2]), 2.0));
    const double swag = sin(14.0 * y + 2.0 * sin(2.0 * a)) * baroque_ramp(0.2, 0.6, y) * 0.04;
    const double r = 0.3 + 0.22 * hang + (0.05 + 0.13 * hang) * fold + fine + swag
                     + sash * (0.1 + 0.02 * sin(60.0 * y + 6.0 * a));
    const double turned = a + (0.05 + 0.16 * hang) * over * 1.1; /* folds lean over their neighbours */
    return (dvec){r * ends * cos(turned), 1.4 * y, -r * ends * sin(turned)};
}

static inline dvec baroque_ball(const baroque_shape *s, double u, double v)
{
    const double a = BAROQUE_TURN * u, b = 0.5 * BAROQUE_TURN * v;
    const double curls = 0.03 * sin(9.0 * a + 5.0 * sin(6.0 * b)) * sin(14.0 * b + 3.0 * sin(4.0 * a)) * sin(b);
    const double r = 0.27 + curls + 0.02 * s->pick[3] * sin(3.0 * a) * sin(b);
    return (dvec){r * sin(b) * cos(a), 1.58 - r * cos(b), -r * sin(b) * sin(a)};
}

/* --- scrolls: fluted spirals like acanthus out of a ball ---------------------------------------------------------- */

enum { BAROQUE_LEAVES = 10 };

static inline dvec baroque_core(const baroque_shape *s, double u, double v)
{
    const double a = BAROQUE_TURN * u, b = 0.5 * BAROQUE_TURN * v;
    const double r = 0.5 + 0.035 * sin(11.0 * a + 4.0 * sin(5.0 * b)) * sin(12.0 * b) * sin(b)
                     + 0.012 * sin(40.0 * b + 9.0 * sin(3.0 * a + s->pick[4])) * sin(b);
    return (dvec){r * sin(b) * cos(a), -1.1 * r * cos(b), -r * sin(b) * sin(a)};
}

static inline dvec baroque_scroll_at(const baroque_shape *s, double t, dvec *across)
{
    const double n = (s->part + 0.5) / BAROQUE_LEAVES, y = 1.0 - 2.0 * n, ring = sqrt(1.0 - y * y);
    const double a = 2.399963 * s->part + BAROQUE_TURN * s->pick[5];
    const dvec out = {ring * cos(a), y, ring * sin(a)};
    const dvec side = dvec_unit(dvec_cross(out, (dvec){0.31 + s->pick[6], 0.92, -0.2}));
    const dvec up = dvec_cross(side, out);
    const double curl = 1.6 * BAROQUE_TURN * pow(t, 1.3), r = 0.27 * exp(-1.9 * t);
    *across = side;
    return dvec_add(dvec_mul(out, 0.45 + 0.42 * baroque_ramp(0.0, 0.45, t) + r * sin(curl)),
                    dvec_mul(up, r * (cos(curl) - 1.0) + 0.3 * t));
}

static inline dvec baroque_scroll(const baroque_shape *s, double u, double v)
{
    dvec side;
    const dvec at = baroque_scroll_at(s, v, &side), ahead = baroque_scroll_at(s, v + 1e-4, &side);
    const double ends = sqrt(fmax(0.0, 1.0 - pow(fabs(2.0 * v - 1.0), 10.0))), taper = 0.11 * (1.0 - 0.7 * v);
    const double lobes = 1.0 + 0.22 * fabs(sin(3.0 * BAROQUE_TURN * u))
                         + 0.3 * fabs(sin(30.0 * v)) * sin(BAROQUE_TURN * u);
    const double flat = 0.8 + 0.9 * fabs(cos(BAROQUE_TURN * u));
    return baroque_tube(at, ahead, side, u, taper * ends * lobes * flat);
}

/* --- a knot of ribbons and a string of beads through it ---------------------------------------------------------- */

static inline dvec baroque_knot_at(const baroque_shape *s, double t)
{
    const double a = BAROQUE_TURN * t, p = s->part ? 2.0 : 3.0, q = s->part ? 5.0 : 4.0 + floor(2.0 * s->pick[0]);
    const double own = s->part ? 0.42 : 0.3, r = 0.8 + own * cos(q * a + s->pick[1]);
    return (dvec){r * cos(p * a), 1.15 * own * sin(q * a + s->pick[1]) * 1.4, r * sin(p * a)};
}

static inline dvec baroque_knot(const baroque_shape *s, double u, double v)
{
    const double beads = s->part ? 0.045 * (0.35 + 0.65 * fabs(sin(60.0 * BAROQUE_TURN * v))) : 0.0;
    const double twist = u + 6.0 * v, w = BAROQUE_TURN * twist;
    const double rope = 0.085 * (1.0 + 0.28 * sin(4.0 * BAROQUE_TURN * (u + 9.0 * v))
                                 + 0.12 * sin(70.0 * BAROQUE_TURN * v));
    const double ribbon = rope * (0.7 + 0.6 * fabs(cos(w)));
    return baroque_tube(baroque_knot_at(s, v), baroque_knot_at(s, v + 1e-5), (dvec){0.02, 1.0, 0.03}, u,
                        s->part ? beads : ribbon);
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

/* A rotation of three angles; the first seed stands upright. */
static inline void baroque_set_turn(baroque_shape *s, uint32_t seed)
{
    const double k = seed > 1 ? BAROQUE_TURN : 0.0;
    const double a = k * baroque_random(s), b = k * baroque_random(s), c = k * baroque_random(s);
    const double ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b), cc = cos(c), sc = sin(c);
    const double turn[9] = {ca * cb, ca * sb * sc - sa * cc, ca * sb * cc + sa * sc,
                            sa * cb, sa * sb * sc + ca * cc, sa * sb * cc - ca * sc, -sb, cb * sc, cb * cc};
    memcpy(s->turn, turn, sizeof turn);
}

/* `fine` squares across the largest surface: 1 to 5 fine^2 triangles. triangle_mesh_free releases it; no normals. */
static inline triangle_mesh baroque(int kind, uint32_t seed, uint32_t fine)
{
    baroque_shape s;
    const size_t most = 8 * (size_t)fine * (size_t)fine + 4096;
    memset(&s, 0, sizeof s);
    s.random = seed * 2654435761u + (uint32_t)kind;
    for (int i = 0; i < 8; ++i) {
        s.pick[i] = baroque_random(&s);
    }
    baroque_set_turn(&s, seed);
    s.mesh.positions = malloc(most * 3 * sizeof(float));
    s.mesh.indices = malloc(most * 3 * sizeof(uint32_t));
    if (s.mesh.positions == NULL || s.mesh.indices == NULL) {
        abort();
    }
    if (kind == BAROQUE_URN || kind == BAROQUE_DRAPERY) {
        baroque_add(&s, kind == BAROQUE_URN ? baroque_urn_body : baroque_cloth, fine, fine);
    }
    if (kind == BAROQUE_DRAPERY) {
        baroque_add(&s, baroque_ball, fine / 2, fine / 2);
    }
    for (s.part = 0; s.part < 2 && (kind == BAROQUE_URN || kind == BAROQUE_KNOT); ++s.part) {
        if (kind == BAROQUE_URN) {
            baroque_add(&s, baroque_handle, fine / 10, fine / 2);
        } else {
            baroque_add(&s, baroque_knot, fine / 8, 4 * fine);
        }
    }
    if (kind == BAROQUE_SCROLLS) {
        baroque_add(&s, baroque_core, fine / 2, fine / 2);
        for (s.part = 0; s.part < BAROQUE_LEAVES; ++s.part) {
            baroque_add(&s, baroque_scroll, fine / 6, fine / 2);
        }
    }
    return s.mesh;
}

#endif
