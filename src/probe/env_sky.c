/* env_sky.c: a clear sky as a cube of far light, and such a cube as lights. Layer 5. */
#include <string.h>

#include <lambent/env.h>

#include "../base/half.h"
#include "../base/poly.h"
#include "cube.h"

#if LMB_TREES

static int is_sky_env(const lmb_env *env) { return env != NULL && env->texels != NULL && env->size > 0; }

static uint32_t texels_of(const lmb_env *env, int32_t level)
{
    const uint32_t n = (uint32_t)(env->size >> level);
    return 6 * n * n;
}

static lmb_vec3 direction_of_texel(cube_place p, int32_t n) { return cube_direction(p.face, p.x, p.y, n); }

/* sr, of a texel of faces with n x n: area on the cube over the cube of the distance. */
static float solid_angle_of_place(cube_place p, int32_t n)
{
    const float s = cube_coordinate(p.x, n), t = cube_coordinate(p.y, n), d2 = 1.0f + s * s + t * t;
    return 4.0f / ((float)n * (float)n) / (d2 * sqrtf(d2));
}

static void read_env_texel(float rgb[3], const lmb_env *env, int32_t level, uint32_t i)
{
    const uint16_t *texel = env->texels + 4 * (env->at[level] + (size_t)i);
    rgb[0] = half_decode(texel[0]);
    rgb[1] = half_decode(texel[1]);
    rgb[2] = half_decode(texel[2]);
}

/* --- a clear sky -------------------------------------------------------------------------------------------------- */

/* Luminance or a chromaticity over the sky: value at the zenith, and change with the angles from the zenith and the
 * sun. */
typedef struct perez {
    float a, b, c, d, e; /* of the model */
    float zenith;        /* value there / formula there */
} perez;

static float exp_of(float x) { return lmb_exp2(x * 1.44269504f); }

/* height: cosine of the angle from the zenith; turn: from the sun. */
static float perez_at(const perez *p, float height, float turn)
{
    const float from_zenith = 1.0f + p->a * exp_of(p->b / maxf(height, 0.01f));
    return from_zenith * (1.0f + p->c * exp_of(p->d * lmb_acos(turn)) + p->e * turn * turn);
}

static perez perez_of(const float by_turbidity[10], float turbidity, float at_zenith, float sun_height)
{
    float k[5];
    for (int i = 0; i < 5; ++i) {
        k[i] = by_turbidity[2 * i] * turbidity + by_turbidity[2 * i + 1];
    }
    perez p = {k[0], k[1], k[2], k[3], k[4], 1.0f};
    p.zenith = at_zenith / perez_at(&p, 1.0f, sun_height);
    return p;
}

/* A chromaticity at the zenith: a polynomial in turbidity and the sun's angle from the zenith. */
static float zenith_of(const float k[12], float turbidity, float angle)
{
    float row[3];
    for (int i = 0; i < 3; ++i) {
        row[i] = ((k[4 * i] * angle + k[4 * i + 1]) * angle + k[4 * i + 2]) * angle + k[4 * i + 3];
    }
    return (row[0] * turbidity + row[1]) * turbidity + row[2];
}

typedef struct sky {
    perez luminance, x, y;
    lmb_vec3 to_sun;
} sky;

static sky sky_of(lmb_vec3 to_sun, float t)
{
    static const float luminance[10] = {0.1787f, -1.4630f, -0.3554f, 0.4275f,  -0.0227f,
                                        5.3251f, 0.1206f,  -2.5771f, -0.0670f, 0.3703f};
    static const float x[10] = {-0.0193f, -0.2592f, -0.0665f, 0.0008f,  -0.0004f,
                                0.2125f,  -0.0641f, -0.8989f, -0.0033f, 0.0452f};
    static const float y[10] = {-0.0167f, -0.2608f, -0.0950f, 0.0092f,  -0.0079f,
                                0.2102f,  -0.0441f, -1.6537f, -0.0109f, 0.0529f};
    static const float zenith_x[12] = {0.00166f, -0.00375f, 0.00209f, 0.0f,     -0.02903f, 0.06377f,
                                       -0.03202f, 0.00394f, 0.11693f, -0.21196f, 0.06052f, 0.25886f};
    static const float zenith_y[12] = {0.00275f, -0.00610f, 0.00317f, 0.0f,     -0.04214f, 0.08970f,
                                       -0.04153f, 0.00516f, 0.15346f, -0.26756f, 0.06670f, 0.26688f};
    sky s;
    const float lowest = 0.0871557427f; /* the cosine of 85 degrees */
    lmb_vec3 d = normalize3(to_sun);
    if (!(d.y >= lowest)) {
        d = normalize3(vec3(d.x, lowest * sqrtf(d.x * d.x + d.z * d.z), d.z));
    }
    s.to_sun = d;
    const float angle = lmb_acos(d.y);
    const float chi = (4.0f / 9.0f - t / 120.0f) * (LMB_PI - 2.0f * angle);
    const float bright = (4.0453f * t - 4.9710f) * lmb_tan(chi) - 0.2155f * t + 2.4192f;
    s.luminance = perez_of(luminance, t, maxf(bright, 0.0f), d.y);
    s.x = perez_of(x, t, zenith_of(zenith_x, t, angle), d.y);
    s.y = perez_of(y, t, zenith_of(zenith_y, t, angle), d.y);
    return s;
}

/* Linear RGB of Rec. 709 from CIE xyY. */
static void sky_at(float rgb[3], const sky *s, lmb_vec3 d, float scale)
{
    static const float to_rgb[3][3] = {{3.2404542f, -1.5371385f, -0.4985314f},
                                       {-0.9692660f, 1.8760108f, 0.0415560f},
                                       {0.0556434f, -0.2040259f, 1.0572252f}};
    const float turn = clampf(dot3(d, s->to_sun), -1.0f, 1.0f);
    const float bright = s->luminance.zenith * perez_at(&s->luminance, d.y, turn) * scale;
    const float x = s->x.zenith * perez_at(&s->x, d.y, turn), y = s->y.zenith * perez_at(&s->y, d.y, turn);
    const float big_x = bright * x / y, big_z = bright * (1.0f - x - y) / y;
    for (int c = 0; c < 3; ++c) {
        rgb[c] = maxf(to_rgb[c][0] * big_x + to_rgb[c][1] * bright + to_rgb[c][2] * big_z, 0.0f);
    }
}

lmb_status lmb_env_sky(const lmb_env *env, lmb_vec3 to_sun, float turbidity, float scale, const float ground[3])
{
    if (!is_sky_env(env) || ground == NULL || !(dot3(to_sun, to_sun) > 0.0f && dot3(to_sun, to_sun) < 1e30f) ||
        !(scale >= 0.0f)) {
        return LMB_ERR_ARG;
    }
    const sky s = sky_of(to_sun, turbidity > 2.0f ? minf(turbidity, 10.0f) : 2.0f);
    for (uint32_t i = 0; i < texels_of(env, 0); ++i) {
        float rgb[3];
        const cube_place p = cube_nth((int32_t)i, env->size);
        const lmb_vec3 d = direction_of_texel(p, env->size);
        if (d.y > 0.0f) {
            sky_at(rgb, &s, d, scale);
        } else {
            memcpy(rgb, ground, sizeof rgb);
        }
        lmb_env_set(env, p.face, p.x, p.y, rgb);
    }
    return LMB_OK;
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

#define SUN_COSINE 0.99862953f /* of 3 degrees */
#define SUN_OVER   8.0f        /* times the mean radiance */
#define SUN_SHARE  0.1f        /* of all light */

static float sum3(const float v[3]) { return v[0] + v[1] + v[2]; }

/* The brightest texel of level 0, and the sum of radiance x solid angle. */
static uint32_t sort_brightest(float *all, const lmb_env *env)
{
    uint32_t best = 0;
    float highest = 0.0f;
    double sum = 0.0;
    for (uint32_t i = 0; i < texels_of(env, 0); ++i) {
        float rgb[3];
        read_env_texel(rgb, env, 0, i);
        sum += (double)(sum3(rgb) * solid_angle_of_place(cube_nth((int32_t)i, env->size), env->size));
        if (sum3(rgb) > highest) {
            highest = sum3(rgb);
            best = i;
        }
    }
    *all = (float)sum;
    return best;
}

/* Share of a texel's radiance above the limit, the same for all channels. */
static float share_over(const float rgb[3], float limit)
{
    const float all = sum3(rgb);
    return all > limit ? (all - limit) / all : 0.0f;
}

/* Adds the light above the limit of the texels around `middle` to *out, or removes it from the cube. */
static void gather_sun(lmb_light *out, const lmb_env *env, lmb_vec3 middle, float limit, int take)
{
    for (uint32_t i = 0; i < texels_of(env, 0); ++i) {
        float rgb[3];
        const cube_place p = cube_nth((int32_t)i, env->size);
        const lmb_vec3 d = direction_of_texel(p, env->size);
        read_env_texel(rgb, env, 0, i);
        const float share = share_over(rgb, limit), angle = solid_angle_of_place(p, env->size);
        if (share == 0.0f || dot3(d, middle) < SUN_COSINE) {
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            out->intensity[c] += rgb[c] * share * angle;
            rgb[c] *= 1.0f - share;
        }
        out->direction = sub3(out->direction, mul3(d, sum3(rgb) / (1.0f - share) * share * angle));
        if (take) {
            lmb_env_set(env, p.face, p.x, p.y, rgb);
        }
    }
}

static lmb_light sun_of(const lmb_env *env, lmb_vec3 middle, float limit, int take)
{
    lmb_light sun;
    memset(&sun, 0, sizeof sun);
    sun.kind = LMB_LIGHT_DIRECTIONAL;
    sun.cos_inner = sun.cos_outer = 1.0f;
    gather_sun(&sun, env, middle, limit, take);
    sun.direction = normalize3(sun.direction);
    return sun;
}

int lmb_env_take_sun(lmb_light *out, const lmb_env *env)
{
    float all;
    if (out == NULL || !is_sky_env(env)) {
        return 0;
    }
    const lmb_vec3 middle = direction_of_texel(cube_nth((int32_t)sort_brightest(&all, env), env->size), env->size);
    const float limit = SUN_OVER * all / (4.0f * LMB_PI);
    const lmb_light sun = sun_of(env, middle, limit, 0);
    if (!(sum3(sun.intensity) >= SUN_SHARE * all) || !(all > 0.0f)) {
        return 0;
    }
    *out = sun_of(env, middle, limit, 1);
    return 1;
}

uint32_t lmb_env_lights(lmb_light *out, uint32_t cap, const lmb_env *env, int32_t level)
{
    uint32_t count = 0;
    if (out == NULL || !is_sky_env(env) || level < 0 || level >= env->levels) {
        return 0;
    }
    const int32_t n = env->size >> level;
    for (uint32_t i = 0; i < texels_of(env, level); ++i) {
        lmb_light l;
        memset(&l, 0, sizeof l);
        read_env_texel(l.intensity, env, level, i);
        if (sum3(l.intensity) == 0.0f) {
            continue;
        }
        if (count == cap) {
            return 0;
        }
        l.kind = LMB_LIGHT_DIRECTIONAL;
        l.cos_inner = l.cos_outer = 1.0f;
        l.direction = mul3(direction_of_texel(cube_nth((int32_t)i, n), n), -1.0f);
        for (int c = 0; c < 3; ++c) {
            l.intensity[c] *= solid_angle_of_place(cube_nth((int32_t)i, n), n);
        }
        out[count++] = l;
    }
    return count;
}

#endif
