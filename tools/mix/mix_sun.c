/* mix_sun.c: a sun for a photo that is given no light: one whose shadow shows, as dark as the photo's own shadows. */
#include "mix_frames.h"
#include "mix_turn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- strength ----------------------------------------------------------------------------------------------------- */

enum { BINS = 96, BINS_A_STOP = 8 };

/* Where no shadow tells, light still comes from one side more than from others: rooms and grounds of measure-sun want nine
 * tenths of what comes from everywhere. Told surroundings have their own sides. A contrast of more stops is a picture's on
 * a wall, not a shadow's; the plane that the object stands on says more, and has few pictures. */
#define SHARE_MIN  0.9f
#define SHARE_TOLD 0.3f
#define SHARE_MAX 4.0f
#define WALL_STOPS  2.0
#define FLOOR_STOPS 3.5
#define FLOOR_COUNTS 4.0

/* Where two classes of a histogram are farthest apart for how many are in each: Otsu's threshold. Returns by how many
 * bins their means differ; *clear: the part of the variance that lies between them. */
static double parting(const double bin[BINS], double *clear)
{
    double all = 0.0, sum = 0.0, square = 0.0, n = 0.0, part = 0.0, best = 0.0, apart = 0.0;
    for (int i = 0; i < BINS; ++i) {
        all += bin[i];
        sum += bin[i] * i;
        square += bin[i] * i * i;
    }
    for (int i = 0; i < BINS - 1; ++i) {
        n += bin[i];
        part += bin[i] * i;
        if (n > 0.0 && n < all) {
            const double d = (sum - part) / (all - n) - part / n, between = n * (all - n) * d * d;
            apart = between > best ? d : apart;
            best = fmax(best, between);
        }
    }
    const double variance = all > 0.0 ? square / all - sum / all * (sum / all) : 0.0;
    *clear = variance > 0.0 ? best / (all * all) / variance : 0.0;
    return apart;
}

/* What one plane says: by how many stops its two classes differ, and how many blocks are sure of it. Two thirds of a
 * bell curve's variance lie between its halves, and all of what has two values: what lies between counts in part, from
 * 0.7 on. */
typedef struct contrast {
    double stops, weight;
} contrast;

static contrast contrast_of(const float *brightness, size_t count, int is_floor)
{
    double bin[BINS] = {0}, clear;
    for (size_t i = 0; i < count; ++i) {
        const double stops = 10.0 + log2(fmax((double)brightness[i], 1e-9));
        bin[(int)fmin(fmax(stops * BINS_A_STOP, 0.0), BINS - 1.0)] += 1.0;
    }
    const double apart = parting(bin, &clear) / BINS_A_STOP;
    const double sure = (double)count * fmin(fmax((clear - 0.7) / 0.15, 0.0), 1.0);
    const contrast c = {apart, apart > (is_floor ? FLOOR_STOPS : WALL_STOPS) ? 0.0
                               : is_floor                                    ? FLOOR_COUNTS * sure
                                                                             : sure};
    return c;
}

/* The mean brightness of a block of pixels where most of it is plane p, or -1: fine patterns are no shadows. */
static float block(const float *rgb, const uint8_t *label, const lmb_pinhole *c, int32_t p, int32_t x0, int32_t y0)
{
    float sum = 0.0f;
    int32_t n = 0;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t at = (y0 + k / LMB_TILE) * c->width + x0 + k % LMB_TILE;
        if (label[at] == p + 1) {
            sum += 0.2126f * rgb[3 * at] + 0.7152f * rgb[3 * at + 1] + 0.0722f * rgb[3 * at + 2];
            ++n;
        }
    }
    return n > LMB_TILE_PIXELS / 2 ? sum / (float)n : -1.0f;
}

static size_t blocks_of(float *out, const float *rgb, const uint8_t *label, const lmb_pinhole *c, int32_t p)
{
    size_t n = 0;
    for (int32_t y = 0; y + LMB_TILE <= c->height; y += LMB_TILE) {
        for (int32_t x = 0; x + LMB_TILE <= c->width; x += LMB_TILE) {
            const float b = block(rgb, label, c, p, x, y);
            out[n] = b;
            n += b >= 0.0f;
        }
    }
    return n;
}

static double median(const contrast *of, int count, double all)
{
    for (int i = 0; i < count; ++i) {
        double below = 0.0;
        for (int k = 0; k < count; ++k) {
            below += of[k].stops <= of[i].stops ? of[k].weight : 0.0;
        }
        double under = below;
        for (int k = 0; k < count; ++k) {
            under -= of[k].stops == of[i].stops ? of[k].weight : 0.0;
        }
        if (below >= 0.5 * all && under <= 0.5 * all && of[i].weight > 0.0) {
            return of[i].stops;
        }
    }
    return 0.0;
}

/* The median plane's, counted in full where a quarter of the blocks are sure of theirs. */
float mix_sun_share(const float *rgb, const lmb_planes *planes, const lmb_pinhole *c, int32_t floor)
{
    contrast of[LMB_MAX_PLANES];
    double all = 0.0, blocks = 0.0;
    const size_t cap = (size_t)(c->width / LMB_TILE + 1) * (size_t)(c->height / LMB_TILE + 1);
    float *brightness = malloc(cap * sizeof *brightness);
    if (brightness == NULL) {
        return -1.0f;
    }
    for (int32_t p = 0; p < planes->count; ++p) {
        const size_t n = blocks_of(brightness, rgb, planes->label, c, p);
        of[p] = contrast_of(brightness, n, p == floor);
        all += of[p].weight;
        blocks += p == floor ? FLOOR_COUNTS * (double)n : (double)n;
    }
    free(brightness);
    const double stops = all > 0.0 ? median(of, planes->count, all) : 0.0;
    const double counted = blocks > 0.0 ? fmin(4.0 * all / blocks, 1.0) : 0.0;
    return fminf((float)(counted * (exp2(stops) - 1.0)), SHARE_MAX);
}

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

/* The middle of the object's foot, in the camera's space. What a file has in the world was put nowhere: its box tells. */
static lmb_vec3 foot_of(const mix_job *j)
{
    lmb_vec3 low, high;
    if (!is_of_world(j)) {
        return j->anchor;
    }
    mix_object_box(&low, &high, j);
    return to_camera(j, (lmb_vec3){0.5f * (low.x + high.x), low.y, 0.5f * (low.z + high.z)});
}

/* Metres of a unit: such a file is in metres. */
static float scale_of(const mix_job *j) { return is_of_world(j) ? 1.0f : j->scale; }

/* Is a place of the camera's space seen as plane p's? */
static int shows(const mix_job *j, int32_t p, lmb_vec3 at)
{
    const lmb_pinhole *c = &j->frame.camera;
    const float x = c->cx - c->fx * at.x / at.z + 0.5f, y = c->cy + c->fy * at.y / at.z + 0.5f;
    return at.z < 0.0f && x >= 0.0f && y >= 0.0f && x < (float)c->width && y < (float)c->height &&
           j->planes.label[(int32_t)y * c->width + (int32_t)x] == p + 1;
}

/* How much of a shadow along `from` would be seen on what the object stands on: of steps on the floor. */
static int seen_steps(const mix_job *j, lmb_vec3 from, float height)
{
    enum { STEPS = 12 };
    const lmb_vec3 foot = lmb_axes_turn(&j->axes, foot_of(j));
    int seen = 0;
    for (int i = 1; i <= STEPS && j->floor >= 0 && !j->hangs; ++i) {
        const float far = height / from.y * (float)i / STEPS;
        const lmb_vec3 p = {foot.x - from.x * far, foot.y, foot.z - from.z * far};
        seen += shows(j, j->floor, to_camera(j, p));
    }
    return seen;
}

/* Level, towards the viewer; of a wall, out of it. */
static lmb_vec3 in_front(const mix_job *j)
{
    const lmb_vec3 foot = lmb_axes_turn(&j->axes, foot_of(j));
    const lmb_vec3 v = j->hangs ? lmb_axes_turn(&j->axes, j->facing) : (lmb_vec3){-foot.x, 0, -foot.z};
    const float level = hypotf(v.x, v.z);
    return level > 0.0f ? (lmb_vec3){v.x / level, 0, v.z / level} : (lmb_vec3){0, 0, 1};
}

/* Does no plane lie between the object and a sun from there, where the photo shows it? Walls and ceilings do. */
static int is_free(const mix_job *j, lmb_vec3 from)
{
    const mix_extent e = mix_extent_of(j);
    const lmb_vec3 way = to_camera(j, from), at = sum(1.0f, foot_of(j), 0.5f * e.height * scale_of(j), j->facing);
    for (int32_t i = 0; i < j->planes.count; ++i) {
        const lmb_flat *p = &j->planes.plane[i];
        const float far = -(along(p->normal, at) + p->distance) / along(p->normal, way);
        if (i != j->floor && far > 0.0f && far < 1e6f && shows(j, i, sum(1.0f, at, far, way))) {
            return 0;
        }
    }
    return 1;
}

/* From beside what is in front, `facing` of it towards that, and so high. side: 1 or -1. */
static lmb_vec3 from_side(lmb_vec3 front, float facing, float side, float height)
{
    const lmb_vec3 up = {0, 1, 0}, across = {front.z, 0, -front.x};
    const float wide = sqrtf(1.0f - height * height), beside = sqrtf(1.0f - facing * facing);
    return sum(wide, sum(facing, front, side * beside, across), height, up);
}

/* About the brightest direction: within 30 degrees of straight from one side, and 30 to 50 degrees high, for the shadow
 * of a sun behind the viewer or overhead hides behind the object. From the other side where more of the floor is. On a wall
 * 45 to 65 degrees from straight out of it: behind a wall shines no sun. Where a wall that is seen is in its way, the
 * first of others that none is: from the other side, nearer to the viewer or farther, higher. */
static lmb_vec3 direction(const mix_job *j)
{
    static const float heights[] = {0.5f, 0.64278761f, 0.76604444f};
    const lmb_vec3 bright = lmb_env_brightest(&j->env[0], (lmb_vec3){0, 1, 0}), front = in_front(j),
                   side = {front.z, 0, -front.x};
    const float flat = hypotf(bright.x, bright.z), low = j->hangs ? 0.42261826f : -0.5f,
                high = j->hangs ? 0.70710678f : 0.5f,
                facing = fminf(fmaxf(flat > 0.0f ? along(bright, front) / flat : 0.0f, low), high);
    const lmb_vec3 lo = j->object.scene.bounds_min, hi = j->object.scene.bounds_max;
    const float tall = (hi.y - lo.y) * scale_of(j), first = along(bright, side) < 0.0f ? -1.0f : 1.0f,
                height = fminf(bright.y, heights[2]);
    const lmb_vec3 one = from_side(front, facing, first, height), other = from_side(front, facing, -first, height);
    const int turned = 2 * seen_steps(j, one, tall) < seen_steps(j, other, tall);
    const lmb_vec3 best = turned ? other : one;
    for (int i = -1; i < 18; ++i) {
        const float ways[] = {facing, high, low};
        const lmb_vec3 from = i < 0 ? best
                                    : from_side(front, ways[i / 2 % 3], (turned != 0) == (i % 2 == 0) ? first : -first, heights[i / 6]);
        if (is_free(j, from)) {
            return from;
        }
    }
    return best;
}

/* --- what is around and too dark ---------------------------------------------------------------------------------- */

/* Hardly a surface reflects more than WHITE. Where the photo shows brighter ones than what is around would make of such,
 * there is light from where it shows nothing: all that is around, and the sun, are as much brighter. Lamps and windows are
 * brighter than white; the surface is asked that is as bright as BRIGHTEST of all. */
#define WHITE     0.8f
#define BRIGHTEST 0.95
#define MORE_MAX  4.0f
#define NEAR      0.5f /* m, beside the object's height: light differs from place to place */

static float grey(const float *rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; }

static float grey_around(const mix_job *j, lmb_vec3 normal)
{
    float rgb[3];
    lmb_env_irradiance(rgb, &j->env[0], normal);
    return grey(rgb);
}

/* The mean brightness of a block's measured pixels, and the normal at its middle; 0: hardly one is measured, or it lies
 * farther from where the object stands. */
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

/* 0: memory is short. Else how much brighter all light is than what is around with a sun from there, of so much by its cosine. */
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
                n += isfinite(more[n]) ? 1 : 0; /* NaN has no place in an order */
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

/* Degrees: where no shadow tells of a sun, it is as wide as windows and many lamps are; where shadows are twice as dark as
 * what is beside them, as narrow as one window far off. */
#define SOFT  60.0f
#define SHARP 8.0f

/* Of a sequence the first frame's. */
static float kept_sun(lmb_light *out, const mix_job *j)
{
    const float *m = j->from_world.m;
    const lmb_vec3 d = j->kept->sun.direction;
    *out = j->kept->sun;
    out->direction = (lmb_vec3){m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                                m[2] * d.x + m[6] * d.y + m[10] * d.z};
    return j->kept->sun_size;
}

float mix_guess_sun(lmb_light *out, const mix_job *j)
{
    if (j->kept != NULL && j->kept->frames > 0 && j->kept->has_sun) {
        return kept_sun(out, j);
    }
    float around[3];
    const lmb_vec3 faces = j->hangs ? in_front(j) : (lmb_vec3){0, 1, 0}, from = direction(j);
    const float shadows = mix_sun_share(j->frame.light.pixels, &j->planes, &j->frame.camera, j->floor),
                share = fmaxf(shadows, j->o.world != NULL ? SHARE_TOLD : SHARE_MIN),
                size = SOFT + (SHARP - SOFT) * fminf(shadows, 1.0f),
                more = j->o.world != NULL
                           ? 1.0f
                           : brighter(j, from, share * grey_around(j, faces) / along(from, faces)),
                by[3] = {more, more, more};
    if (shadows < 0.0f || !(more > 0.0f)) {
        return -1.0f;
    }
    lmb_env_dim(&j->env[0], &j->env[0], by);
    const lmb_mat4 world = mix_back(&j->from_world);
    const lmb_vec3 way = mix_turn(&world, (lmb_vec3){-from.x, -from.y, -from.z});
    memset(out, 0, sizeof *out);
    out->kind = LMB_LIGHT_DIRECTIONAL;
    out->direction = (lmb_vec3){-from.x, -from.y, -from.z};
    out->cos_inner = out->cos_outer = 1.0f;
    lmb_env_irradiance(around, &j->env[0], faces);
    for (int c = 0; c < 3; ++c) {
        out->intensity[c] = share * around[c] / along(from, faces);
    }
    report_note(j->o.is_quiet,
                "no light given: guessed a sun from a side, near where the surroundings are brightest, %.2f as strong "
                "as they, which are %.2f times as bright as the photo has them%s; --light sun:0,0,0:%.3f,%.3f,%.3f:%.3f,%.3f,%.3f:%.0f",
                (double)share, (double)more, more > 1.0f ? "; given by hand, the sun leaves them as in the photo" : "", (double)way.x,
                (double)way.y, (double)way.z, (double)out->intensity[0], (double)out->intensity[1],
                (double)out->intensity[2], (double)size);
    return size;
}
