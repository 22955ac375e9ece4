/* dvec.h: a vector of three doubles, for measurements finer than the library's float. */
#ifndef DVEC_H
#define DVEC_H

#include <float.h>
#include <math.h>

typedef struct dvec {
    double x, y, z;
} dvec;

static inline dvec dvec_of(double x, double y, double z)
{
    dvec v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline dvec dvec_read(const float *p) { return dvec_of((double)p[0], (double)p[1], (double)p[2]); }
/* Clamped to the range of float, because C defines no conversion beyond it. */
static inline float dvec_narrow(double v)
{
    return v > (double)FLT_MAX ? FLT_MAX : v > -(double)FLT_MAX ? (float)v : -FLT_MAX;
}

static inline void dvec_write(float *p, dvec v)
{
    p[0] = dvec_narrow(v.x);
    p[1] = dvec_narrow(v.y);
    p[2] = dvec_narrow(v.z);
}

static inline dvec dvec_add(dvec a, dvec b) { return dvec_of(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline dvec dvec_sub(dvec a, dvec b) { return dvec_of(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline dvec dvec_mul(dvec a, double s) { return dvec_of(a.x * s, a.y * s, a.z * s); }
static inline double dvec_dot(dvec a, dvec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double dvec_length(dvec a) { return sqrt(dvec_dot(a, a)); }

static inline dvec dvec_cross(dvec a, dvec b)
{
    return dvec_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* a + t (b - a) */
static inline dvec dvec_mix(dvec a, dvec b, double t) { return dvec_add(a, dvec_mul(dvec_sub(b, a), t)); }

/* The normal of a, b, c (counter-clockwise), with a length of twice the area. */
static inline dvec dvec_turn(dvec a, dvec b, dvec c) { return dvec_cross(dvec_sub(b, a), dvec_sub(c, a)); }

/* Unit length; 0 if there is no direction. */
static inline dvec dvec_unit(dvec a)
{
    const double length = dvec_length(a);
    return length > 0 ? dvec_mul(a, 1 / length) : dvec_of(0, 0, 0);
}

#endif
