/* mix_sun.c: a light for a photo without given ones: estimated from shadows or shading, or a weak default. */
#include "mix_cast.h"
#include "mix_frames.h"
#include "mix_turn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- direction ---------------------------------------------------------------------------------------------------- */

static float along(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 sum(float a, lmb_vec3 x, float b, lmb_vec3 y)
{
    const lmb_vec3 out = {a * x.x + b * y.x, a * x.y + b * y.y, a * x.z + b * y.z};
    return out;
}

static lmb_vec3 to_camera(const mix_job *j, lmb_vec3 v)
{
    return (lmb_vec3){along(j->axes.right, v), along(j->axes.up, v), along(j->axes.back, v)};
}

static int is_of_world(const mix_job *j) { return j->o.at == MIX_AT_WORLD; }

/* The middle of the object's foot, in camera space. An object in world coordinates has no anchor, so the box is
 * used. */
static lmb_vec3 foot_of(const mix_job *j)
{
    lmb_vec3 low, high;
    if (!is_of_world(j)) {
        return j->anchor;
    }
    mix_object_box(&low, &high, j);
    return to_camera(j, (lmb_vec3){0.5f * (low.x + high.x), low.y, 0.5f * (low.z + high.z)});
}

/* Metres per unit: files in world coordinates are in metres. */
static float scale_of(const mix_job *j) { return is_of_world(j) ? 1.0f : j->scale; }

/* Level, towards the viewer; for a wall, out of it. */
static lmb_vec3 in_front(const mix_job *j)
{
    const lmb_vec3 foot = lmb_axes_turn(&j->axes, foot_of(j));
    const lmb_vec3 v = j->hangs ? lmb_axes_turn(&j->axes, j->facing) : (lmb_vec3){-foot.x, 0, -foot.z};
    const float level = hypotf(v.x, v.z);
    return level > 0.0f ? (lmb_vec3){v.x / level, 0, v.z / level} : (lmb_vec3){0, 0, 1};
}

/* The default sun: overhead, with a shadow under the object; on a wall, 45 degrees out of it. */
static lmb_vec3 overhead(const mix_job *j)
{
    const lmb_vec3 up = {0, 1, 0};
    return j->hangs ? sum(0.70710678f, in_front(j), 0.70710678f, up) : up;
}

/* --- an environment that is too dark ------------------------------------------------------------------------------ */

/* Few surfaces reflect more than WHITE. If the photo shows surfaces brighter than the environment could make them,
 * light comes from outside the picture, so environment and sun are scaled up. Lamps and windows are brighter than
 * white, so the BRIGHTEST quantile is used. */
#define WHITE     0.8f
#define BRIGHTEST 0.95
#define MORE_MAX  4.0f
#define NEAR      0.5f /* m, added to the object's size: light varies from place to place */

static float grey(const float *rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; }

static float grey_around(const mix_job *j, lmb_vec3 normal)
{
    float rgb[3];
    lmb_env_irradiance(rgb, &j->env[0], normal);
    return grey(rgb);
}

/* The mean brightness of a block's measured pixels, and the normal in the middle. Returns 0 if few pixels are measured
 * or the block is farther than `near` from the foot. */
static int block_seen(float *brightness, lmb_vec3 *normal, const mix_job *j, int32_t x0, int32_t y0, lmb_vec3 foot,
                      float near)
{
    const int32_t w = j->frame.camera.width, at = (y0 + LMB_TILE / 2) * w + x0 + LMB_TILE / 2;
    const uint8_t label = j->planes.label[at];
    float all = 0.0f;
    int32_t n = 0;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t i = (y0 + k / LMB_TILE) * w + x0 + k % LMB_TILE;
        if (j->cloud.inverse[i] > 0.0f) {
            all += grey(j->frame.light.pixels + 3 * (size_t)i);
            ++n;
        }
    }
    *brightness = all / fmaxf((float)n, 1.0f);
    *normal = lmb_axes_turn(&j->axes, label > 0 ? j->planes.plane[label - 1].normal : j->cloud.normal[at]);
    const lmb_vec3 off = sum(1.0f, lmb_cloud_point(&j->cloud, at % w, at / w), -1.0f, foot);
    return n > LMB_TILE_PIXELS / 2 && j->cloud.inverse[at] > 0.0f && along(off, off) < near * near;
}

static int by_value(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The factor by which all light exceeds the environment plus a sun from there with normal irradiance `sun`. Returns 0
 * if memory is short. */
static float brighter(const mix_job *j, lmb_vec3 from, float sun)
{
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height;
    const lmb_vec3 foot = foot_of(j);
    const float near = NEAR + mix_extent_of(j).longest * scale_of(j);
    float *more = malloc((size_t)(w / LMB_TILE + 1) * (size_t)(h / LMB_TILE + 1) * sizeof *more);
    size_t n = 0;
    if (more == NULL) {
        return 0.0f;
    }
    for (int32_t y = 0; y + LMB_TILE <= h; y += LMB_TILE) {
        for (int32_t x = 0; x + LMB_TILE <= w; x += LMB_TILE) {
            lmb_vec3 normal;
            float brightness;
            if (block_seen(&brightness, &normal, j, x, y, foot, near)) {
                const float light = grey_around(j, normal) + sun * fmaxf(along(normal, from), 0.0f);
                more[n] = 3.14159265f / WHITE * brightness / fmaxf(light, 1e-9f);
                n += isfinite(more[n]) ? 1 : 0; /* NaN cannot be sorted */
            }
        }
    }
    if (n > 0) {
        qsort(more, n, sizeof *more, by_value);
    }
    const float out = n > 0 ? more[(size_t)(BRIGHTEST * (double)(n - 1))] : 1.0f;
    free(more);
    return fminf(fmaxf(out, 1.0f), MORE_MAX);
}

/* The share of brightness variance that a sun's shadows must explain: from UNSURE on the sun counts, from SURE on in
 * full; likewise for a near light, with what falloff explains added, or by falloff, if no shadow is in view. An
 * uncertain sun is WIDE, degrees, and has WEAK times the environment's irradiance. */
#define UNSURE      0.2f
#define SURE        0.3f
#define LAMP_UNSURE 0.9f
#define LAMP_SURE   1.1f
#define FALLOFF_UNSURE 0.75f
#define FALLOFF_SURE   0.9f
#define WIDE        80.0f
#define WEAK        0.35f
#define SHARE_MAX   3.0f
#define FACES       0.17f /* minimum cosine to the surface under the object */

/* If nothing shows the light, about half of it comes from lamps outside the picture, and their shadows are unknown. So
 * the object darkens real surfaces only by this share of what it blocks of the surroundings. */
#define DARKENS 0.5f

typedef struct guess {
    lmb_vec3 from;
    float share, size, sure;
    int is_near;
} guess;

static float ramp(float x, float low, float high) { return fminf(fmaxf((x - low) / (high - low), 0.0f), 1.0f); }

/* Returns 0 if memory is short. */
static int guess_of(guess *out, const mix_job *j, lmb_vec3 faces)
{
    mix_cast light;
    if (!mix_find_cast(&light, j, lmb_axes_turn(&j->axes, foot_of(j)))) {
        return 0;
    }
    memset(out, 0, sizeof *out);
    out->is_near = light.is_near;
    if (along(light.to, faces) > FACES) {
        out->sure = light.is_near ? fmaxf(ramp(light.explained, LAMP_UNSURE, LAMP_SURE),
                                          ramp(light.explained - light.by_shadows, FALLOFF_UNSURE, FALLOFF_SURE))
                                  : ramp(light.by_shadows, UNSURE, SURE);
    }
    out->from = out->sure > 0.0f ? light.to : overhead(j);
    out->size = out->sure > 0.0f ? light.size : WIDE;
    out->share = fmaxf(out->sure * fminf(light.share, SHARE_MAX), WEAK);
    return 1;
}

/* The sun of a sequence's first frame. */
static float kept_sun(lmb_light *out, float *softens, const mix_job *j)
{
    const float *m = j->from_world.m;
    const lmb_vec3 d = j->kept->sun.direction;
    *out = j->kept->sun;
    out->direction = (lmb_vec3){m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                                m[2] * d.x + m[6] * d.y + m[10] * d.z};
    *softens = j->kept->softens;
    return j->kept->sun_size;
}

float mix_guess_sun(lmb_light *out, float *softens, const mix_job *j)
{
    if (j->kept != NULL && j->kept->frames > 0 && j->kept->has_sun) {
        return kept_sun(out, softens, j);
    }
    float around[3];
    guess g;
    const lmb_vec3 faces = j->hangs ? in_front(j) : (lmb_vec3){0, 1, 0};
    if (!guess_of(&g, j, faces)) {
        return -1.0f;
    }
    const lmb_vec3 from = g.from;
    const float more = j->o.world != NULL ? 1.0f : brighter(j, from, g.share * grey_around(j, faces)),
                by[3] = {more, more, more};
    if (!(more > 0.0f)) {
        return -1.0f;
    }
    lmb_env_dim(&j->env[0], &j->env[0], by);
    const lmb_mat4 world = mix_back(&j->from_world);
    const lmb_vec3 way = mix_turn(&world, (lmb_vec3){-from.x, -from.y, -from.z});
    memset(out, 0, sizeof *out);
    out->kind = LMB_LIGHT_DIRECTIONAL;
    out->direction = (lmb_vec3){-from.x, -from.y, -from.z};
    out->cos_inner = out->cos_outer = 1.0f;
    *softens = (1.0f - g.sure) * (1.0f - DARKENS);
    lmb_env_irradiance(around, &j->env[0], faces);
    for (int c = 0; c < 3; ++c) {
        out->intensity[c] = g.share * around[c];
    }
    report_note(j->o.is_quiet,
                "no light given: %s, %.2f as strong as the surroundings; --light sun:0,0,0:%.3f,%.3f,%.3f:%.3f,%.3f,"
                "%.3f:%.0f",
                g.sure > 0.0f && g.is_near ? "took a near light from the photo's shadows and falloff"
                : g.sure > 0.0f ? "took a sun from the photo's shadows"
                                : "nothing shows where light comes from, so took a weak one from above",
                (double)g.share, (double)way.x, (double)way.y, (double)way.z, (double)out->intensity[0],
                (double)out->intensity[1], (double)out->intensity[2], (double)g.size);
    report_note(!j->o.is_verbose || !(more > 1.0f),
                "the surroundings count %.2f times as bright as in the photo; with --light they do not", (double)more);
    return g.size;
}

const lmb_irradiance *mix_soften(lmb_irradiance *room, const lmb_irradiance *with, const lmb_irradiance *without,
                                 float softens)
{
    *room = *with;
    for (int32_t i = 0; i < 3 * LMB_TILE_PIXELS; ++i) {
        float *left = &room->rgb[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS];
        const float before = without->rgb[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS];
        if (*left < before) {
            const float blocked = (before - *left) / before;
            *left = before * (1.0f - blocked * (1.0f - softens * (1.0f - blocked)));
        }
    }
    return room;
}
