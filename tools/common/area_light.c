/* area_light.c: replaces a light that has a size by many lights without one, for soft shadows. */
#include "area_light.h"

#include <math.h>

/* Positions on a disc: each is turned by the golden angle, at radii with equal area between. A second turn,
 * irrational to the first, gives the third axis. Such points are even on the sphere in four dimensions, and the
 * projection of that to three looks like an even disc from every side. Turns are products, because the last bits of
 * sines differ between libraries. */
static const double turn[2][2] = {{-0.73736887807831974, 0.67549029426152385},  /* 0.381966 of a circle */
                                  {-0.19797456015568693, -0.98020715847782003}}; /* e */

static void step(double at[2], const double by[2])
{
    const double c = at[0] * by[0] - at[1] * by[1];
    at[1] = at[0] * by[1] + at[1] * by[0];
    at[0] = c;
}

/* Two directions perpendicular to an axis and to each other. */
static void across(double u[3], double v[3], lmb_vec3 axis)
{
    const double d[3] = {(double)axis.x, (double)axis.y, (double)axis.z};
    const int thin = fabs(d[0]) < fabs(d[1]) ? (fabs(d[0]) < fabs(d[2]) ? 0 : 2) : fabs(d[1]) < fabs(d[2]) ? 1 : 2;
    double length = 0.0;
    for (int i = 0; i < 3; ++i) {
        u[i] = (i == thin) - d[i] * d[thin];
        length += u[i] * u[i];
    }
    for (int i = 0; i < 3; ++i) {
        u[i] /= sqrt(length);
    }
    for (int i = 0; i < 3; ++i) {
        v[i] = d[(i + 1) % 3] * u[(i + 2) % 3] - d[(i + 2) % 3] * u[(i + 1) % 3];
    }
}

static lmb_vec3 moved(lmb_vec3 v, const double by[3])
{
    const lmb_vec3 out = {(float)((double)v.x + by[0]), (float)((double)v.y + by[1]), (float)((double)v.z + by[2])};
    return out;
}

static lmb_vec3 unit(lmb_vec3 v)
{
    const double l = sqrt((double)v.x * (double)v.x + (double)v.y * (double)v.y + (double)v.z * (double)v.z);
    const lmb_vec3 out = {(float)((double)v.x / l), (float)((double)v.y / l), (float)((double)v.z / l)};
    return out;
}

void area_light(lmb_light *out, int32_t count, const lmb_light *from, float size)
{
    const int is_sun = from->kind == LMB_LIGHT_DIRECTIONAL;
    const double reach = is_sun ? tan((double)size * 0.5 * 0.017453292519943295) : 0.5 * (double)size;
    double u[3], v[3], at[2][2] = {{1, 0}, {1, 0}};
    across(u, v, from->direction);
    for (int32_t i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count, radius = reach * sqrt(t);
        const double ahead = from->kind == LMB_LIGHT_POINT ? reach * sqrt(1.0 - t) * at[1][0] : 0.0;
        double by[3];
        for (int k = 0; k < 3; ++k) {
            const double d = k == 0 ? (double)from->direction.x : k == 1 ? (double)from->direction.y
                                                                        : (double)from->direction.z;
            by[k] = radius * (at[0][0] * u[k] + at[0][1] * v[k]) + ahead * d;
        }
        out[i] = *from;
        out[i].position = is_sun ? from->position : moved(from->position, by);
        out[i].direction = is_sun ? unit(moved(from->direction, by)) : from->direction;
        for (int c = 0; c < 3; ++c) {
            out[i].intensity[c] = from->intensity[c] / (float)count;
        }
        step(at[0], turn[0]);
        step(at[1], turn[1]);
    }
}
