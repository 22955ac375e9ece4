/* world_sphere.c: a picture of the whole sphere -> the faces of a cube, in which small lamps keep their light. */
#include "world_sphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979
#define LAMP_CONTRAST 4.0f /* times the darkest of eight neighbours: the rest is light of lamps */

/* Samples per texel and axis: towards the poles, and if the first samples differ much or a little. */
enum { MAX_PLACES = 16, MANY_PLACES = 8, SOME_PLACES = 4 };

#ifdef WORLD_WITHOUT_LAMPS /* smaller: small lamps may have 5 % too much light, and be lost at the poles */
enum { HAS_LAMPS = 0 };
#else
enum { HAS_LAMPS = 1 };
#endif

enum { LOOK, SPREAD, SCALE }; /* passes: only look for lamps, sum their spread, scale their light */

/* Small lamps among the pixels. */
typedef struct lamps {
    float *part;     /* of a pixel's light, 0 .. 1 */
    double *spread;  /* solid angle over which samples spread a pixel's light, sr */
    uint8_t *places; /* samples per axis of each texel of the cube that has light of lamps; 0: none */
    int pass, any;   /* any: a sample had light of lamps */
} lamps;

void world_pixel(float out[4], const stored_picture *p, size_t at)
{
    out[3] = 1.0f;
    for (int c = 0; c < 3; ++c) {
        if (p->light.pixels != NULL) {
            out[c] = p->light.pixels[p->light.channels == 1 ? at : 3 * at + (size_t)c];
        } else {
            out[c] = p->light_of[p->codes.texels[4 * at + (size_t)c]];
        }
    }
    if (p->light.pixels == NULL) {
        out[3] = (float)p->codes.texels[4 * at + 3] * (1.0f / 255.0f);
    }
}

static double pixel_area(const stored_picture *p, int32_t y)
{
    return 2 * PI / p->width * (cos(PI * y / p->height) - cos(PI * (y + 1) / p->height));
}

/* --- lamps -------------------------------------------------------------------------------------------------------- */

static float light_of_pixel(const stored_picture *p, int32_t x, int32_t y)
{
    float rgba[4];
    world_pixel(rgba, p, (size_t)y * (size_t)p->width + (size_t)((x + p->width) % p->width));
    return rgba[3] * (rgba[0] + rgba[1] + rgba[2]);
}

/* Part of a pixel's light over LAMP_CONTRAST times the darkest neighbour. */
static float lamp_part(const stored_picture *p, int32_t x, int32_t y)
{
    const float light = light_of_pixel(p, x, y);
    float darkest = light;
    for (int k = 0; k < 9 && light > 0.0f; ++k) {
        const int32_t row = y + k / 3 - 1;
        if (row >= 0 && row < p->height) {
            darkest = fminf(darkest, light_of_pixel(p, x + k % 3 - 1, row));
        }
    }
    const float limit = LAMP_CONTRAST * fmaxf(darkest, 0.0f);
    return light > limit ? 1.0f - limit / light : 0.0f;
}

static int find_lamps(lamps *out, const stored_picture *p, int32_t side)
{
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    memset(out, 0, sizeof *out);
    out->part = malloc(pixels * sizeof *out->part);
    out->spread = calloc(pixels, sizeof *out->spread);
    out->places = calloc(6 * (size_t)side * (size_t)side, 1);
    for (size_t i = 0; out->part != NULL && i < pixels; ++i) {
        out->part[i] = lamp_part(p, (int32_t)(i % (size_t)p->width), (int32_t)(i / (size_t)p->width));
    }
    return out->part != NULL && out->spread != NULL && out->places != NULL;
}

static void lamps_free(lamps *l)
{
    free(l->part);
    free(l->spread);
    free(l->places);
}

/* --- samples ------------------------------------------------------------------------------------------------------ */

/* As defined in lambent/probe.h. */
static void face_point(double d[3], int face, double s, double t)
{
    const double p[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    memcpy(d, p[face], sizeof p[face]);
}

/* Solid angle of texel `at`, sr, as world.c sums it. */
static double texel_area(int32_t at, int32_t side)
{
    const double s = (2 * (at % side) + 1.0) / side - 1, t = (2 * (at / side) + 1.0) / side - 1;
    return 4.0 / side / side / pow(1 + s * s + t * t, 1.5);
}

/* Adds the light of pixel `at`, times alpha, and alpha. `area`: of the sample, sr. */
static void add_pixel(double sum[4], lamps *l, const stored_picture *p, size_t at, double weight, double area)
{
    float rgba[4];
    double scale = 1.0;
    world_pixel(rgba, p, at);
    if (HAS_LAMPS && l->part[at] > 0.0f) {
        l->any = 1;
        if (l->pass == SPREAD) {
            l->spread[at] += weight * area;
        } else if (l->pass == SCALE && l->spread[at] > 0.0) {
            scale += (double)l->part[at] * (pixel_area(p, (int32_t)(at / (size_t)p->width)) / l->spread[at] - 1.0);
        }
    }
    for (int c = 0; c < 4; ++c) {
        sum[c] += weight * (double)(c < 3 ? rgba[c] * rgba[3] : rgba[3]) * (c < 3 ? scale : 1.0);
    }
}

/* Bilinear, across the seam, light weighted by alpha. */
static void sphere_at(double sum[4], lamps *l, const stored_picture *p, const double d[3], double area)
{
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double u = (0.5 + atan2(d[0], -d[2]) / (2 * PI)) * p->width - 0.5,
                 v = acos(d[1] / length) / PI * p->height - 0.5;
    const double x0 = floor(u), y0 = floor(v), fx = u - x0, fy = v - y0;
    for (int k = 0; k < 4; ++k) {
        const int32_t x = ((int32_t)x0 + (k & 1) + p->width) % p->width;
        int32_t y = (int32_t)y0 + (k >> 1);
        y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
        add_pixel(sum, l, p, (size_t)y * (size_t)p->width + (size_t)x, (k & 1 ? fx : 1 - fx) * (k >> 1 ? fy : 1 - fy),
                  area);
    }
}

/* Pixels near the poles are narrower, and samples must not miss a sun of one pixel. */
static int places_of(const double d[3])
{
    if (!HAS_LAMPS) {
        return d[0] * d[0] + d[2] * d[2] < 0.1 * d[1] * d[1] ? MANY_PLACES : 2;
    }
    const double across = sqrt(d[0] * d[0] + d[2] * d[2]), length = sqrt(across * across + d[1] * d[1]);
    return MAX_PLACES * across < 2.0 * length ? MAX_PLACES : 2 * (int)(length / across + 0.4);
}

/* The mean of places x places samples over texel `at` of a face; the smallest and the largest of their light. */
static void mean_at(double sum[4], double range[2], lamps *l, const stored_picture *p, int face, int32_t at,
                    int32_t side, int places)
{
    const double area = HAS_LAMPS ? texel_area(at, side) / (places * places) : 0.0;
    sum[0] = sum[1] = sum[2] = sum[3] = 0.0;
    range[0] = 1e30;
    range[1] = 0.0;
    if (HAS_LAMPS) {
        l->any = 0;
    }
    for (int k = 0; k < places * places; ++k) {
        double one[4] = {0, 0, 0, 0}, d[3];
        face_point(d, face, (2 * (at % side) + (2 * (k % places) + 1.0) / places) / side - 1,
                   (2 * (at / side) + (2 * (k / places) + 1.0) / places) / side - 1);
        sphere_at(one, l, p, d, area);
        const double light = one[0] + one[1] + one[2];
        range[0] = light < range[0] ? light : range[0];
        range[1] = light > range[1] ? light : range[1];
        for (int c = 0; c < 4; ++c) {
            sum[c] += one[c] / (places * places);
        }
    }
}

/* --- faces -------------------------------------------------------------------------------------------------------- */

static void put_texel(world_pictures *own, int face, int32_t at, const double sum[4])
{
    for (int c = 0; c < 3; ++c) {
        own->face[face][3 * (size_t)at + (size_t)c] = sum[3] > 0.0 ? (float)(sum[c] / sum[3]) : 0.0f;
    }
    if (own->alpha[face] != NULL) {
        own->alpha[face][at] = (float)sum[3];
    }
}

/* The mean over texel `at`. If it has light of lamps, adds to their spread. */
static void set_texel(world_pictures *own, lamps *l, const stored_picture *p, int face, int32_t at, int32_t side)
{
    double sum[4], range[2], d[3];
    face_point(d, face, (2 * (at % side) + 1.0) / side - 1, (2 * (at / side) + 1.0) / side - 1);
    int places = places_of(d);
    if (HAS_LAMPS) {
        l->pass = LOOK;
    }
    mean_at(sum, range, l, p, face, at, side, places);
    const int more = range[1] > 4.0 * range[0] ? MANY_PLACES : range[1] > 1.5 * range[0] ? SOME_PLACES : 0;
    if ((HAS_LAMPS && l->any) || places < more) {
        places = places < more ? more : places;
        if (HAS_LAMPS) {
            l->pass = SPREAD;
        }
        mean_at(sum, range, l, p, face, at, side, places);
    }
    if (HAS_LAMPS) {
        l->places[(size_t)face * (size_t)side * (size_t)side + (size_t)at] = (uint8_t)(l->any ? places : 0);
    }
    put_texel(own, face, at, sum);
}

/* Adds the light of a pixel that no sample met, as beside a pole, to the texel around it. */
static void put_missed(world_pictures *own, const lamps *l, const stored_picture *p, size_t pixel, int32_t side)
{
    const int32_t y = (int32_t)(pixel / (size_t)p->width);
    const double north = PI * (y + 0.5) / p->height,
                 east = 2 * PI * ((double)(pixel % (size_t)p->width) + 0.5) / p->width;
    const double d[3] = {-sin(north) * sin(east), cos(north), sin(north) * cos(east)};
    for (int face = 0; face < 6; ++face) {
        double axis[3], right[3], low[3], s = 0.0, t = 0.0, length = 0.0;
        float rgba[4];
        face_point(axis, face, 0, 0);
        face_point(right, face, 1, 0);
        face_point(low, face, 0, 1);
        for (int c = 0; c < 3; ++c) {
            length += axis[c] * d[c];
            s += (right[c] - axis[c]) * d[c];
            t += (low[c] - axis[c]) * d[c];
        }
        if (!(length > 0.0 && fabs(s) <= length && fabs(t) <= length)) {
            continue;
        }
        const int32_t x = (int32_t)fmin((s / length + 1) * 0.5 * side, side - 1.0),
                      row = (int32_t)fmin((t / length + 1) * 0.5 * side, side - 1.0), at = row * side + x;
        world_pixel(rgba, p, pixel);
        for (int c = 0; c < 3; ++c) {
            own->face[face][3 * (size_t)at + (size_t)c] +=
                (float)((double)(l->part[pixel] * rgba[3] * rgba[c]) * pixel_area(p, y) / texel_area(at, side));
        }
        return;
    }
}

int world_sphere(world_pictures *own, int32_t side, const stored_picture *p, const char *path, report *r)
{
    const size_t texels = (size_t)side * (size_t)side, pixels = (size_t)p->width * (size_t)p->height;
    lamps l;
    const int ok = !HAS_LAMPS || find_lamps(&l, p, side) || report_fail(r, "%s: out of memory", path);
    for (size_t i = 0; ok && i < 6 * texels; ++i) {
        set_texel(own, &l, p, (int)(i / texels), (int32_t)(i % texels), side);
    }
    if (HAS_LAMPS) {
        l.pass = SCALE;
    }
    for (size_t i = 0; HAS_LAMPS && ok && i < 6 * texels; ++i) {
        if (l.places[i] > 0) {
            double sum[4], range[2];
            mean_at(sum, range, &l, p, (int)(i / texels), (int32_t)(i % texels), side, l.places[i]);
            put_texel(own, (int)(i / texels), (int32_t)(i % texels), sum);
        }
    }
    for (size_t i = 0; HAS_LAMPS && ok && i < pixels; ++i) {
        if (l.part[i] > 0.0f && !(l.spread[i] > 0.0)) {
            put_missed(own, &l, p, i, side);
        }
    }
    if (HAS_LAMPS) {
        lamps_free(&l);
    }
    return ok;
}
