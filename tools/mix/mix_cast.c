/* mix_cast.c: a sun or a near light estimated from a photo: dark places on planes that the geometry explains, and
 * brightness that decreases with the distance. */
#include "mix_cast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f

enum { COLUMNS = 80 /* of places, about */, WAYS = 240, TURNS = 8, RAYS = 16, TERMS = 6, FEW = 24 /* places */ };

#define LOWEST  0.2f   /* sine of the minimum sun elevation */
#define CLEAR   0.005f /* m: nearer geometry is the same plane. A larger value shortens shadows and lowers the sun */
#define CLIPPED 0.98f
#define DARKEST 1e-4f
#define WHITE   0.05   /* of a plane's pixels */
#define RED_STOPS  0.5f /* maximum difference from the plane's mean colour: sun and sky differ in blue */
#define BLUE_STOPS 0.9f
#define DARKER  3.0    /* stops: a larger step is a picture or a rug, not a shadow */
#define EVEN    0.95  /* most of a plane's light that a light may send */
#define GRAIN   1e-3  /* variance of a place's light that shows nothing */
#define OTHERS  0.05  /* minimum part of the explained variance on other planes than one */
#define NEARER  0.3f  /* a near light must explain so much more than a sun, as it has more unknowns */
#define BRIGHT  3.0f /* limit of a place's light, relative to the plane's mean */
#define NARROWEST 1.0f /* degrees */
#define WIDEST    50.0f
#define STOPS   1.5f   /* limit of a place's deviation: pictures on a wall are not shadows */

/* A place on a plane: the deviation of the light from the plane's other places, in stops, with smooth variation
 * removed. */
typedef struct place {
    lmb_vec3 at, normal;
    float depth, light, plain; /* plain: linear, relative to the plane's mean */
    float term[TERMS]; /* orthonormal basis of the smooth variation over the plane */
} place;

typedef struct cast {
    const mix_job *j;
    lmb_bvh bvh;
    void *memory;
    place *all; /* by plane */
    float *seen; /* by place: visible share of the tested light, 0 .. 1; later without the smooth variation */
    float *lit;  /* by place: light that the tested light sends, relative to a surface that faces it at the foot */
    float *open; /* by place: visible share of the sky, 0 .. 1; later without the smooth variation */
    int32_t first[LMB_MAX_PLANES + 1];
    lmb_traversal traversal;
    double cosine[LMB_MAX_PLANES]; /* by plane: to the tested light, in the mean */
    double total;  /* sum of squared deviations of `light` */
    double uneven; /* sum of squared deviations of `plain`, and grain */
} cast;

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 plus(lmb_vec3 a, lmb_vec3 b, float s)
{
    const lmb_vec3 out = {a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
    return out;
}

static lmb_vec3 unit(lmb_vec3 a)
{
    const lmb_vec3 zero = {0, 0, 0};
    return plus(zero, a, 1.0f / sqrtf(fmaxf(dot(a, a), 1e-30f)));
}

/* --- places ------------------------------------------------------------------------------------------------------- */

static int32_t step_of(const mix_job *j)
{
    const int32_t step = j->frame.camera.width / COLUMNS;
    return step < 1 ? 1 : step;
}

/* The appearance of a plane: the channel used for brightness, which is the brightest one that is rarely clipped, and
 * the mean colour in stops of red and blue over green. */
typedef struct look {
    int channel;
    float red, blue;
} look;

static float stops_over(float a, float b) { return log2f(fmaxf(a, DARKEST) / fmaxf(b, DARKEST)); }

static look look_of(const mix_job *j, int32_t p)
{
    const size_t pixels = (size_t)j->frame.camera.width * (size_t)j->frame.camera.height;
    double sum[3] = {0, 0, 0}, white[3] = {0, 0, 0}, n = 0.0;
    look out = {1, 0, 0};
    for (size_t i = 0; i < pixels; ++i) {
        for (int c = 0; c < 3 && j->planes.label[i] == p + 1; ++c) {
            const float one = j->frame.light.pixels[3 * i + (size_t)c];
            sum[c] += one >= 0.0f ? (double)fminf(one, 1.0f) : 0.0;
            white[c] += !(one < CLIPPED);
            n += 1.0 / 3.0;
        }
    }
    double best = -(double)INFINITY;
    for (int c = 0; c < 3; ++c) {
        const double value = sum[c] - (white[c] > WHITE * n ? 4.0 * n + 2.0 * sum[c] : 0.0); /* all clipped: darkest */
        if (value > best) {
            best = value;
            out.channel = c;
        }
    }
    out.red = stops_over((float)sum[0], (float)sum[1]);
    out.blue = stops_over((float)sum[2], (float)sum[1]);
    return out;
}

/* The light of a block of plane p. Returns 0 if a pixel belongs to another plane or is clipped, or if the colour is not
 * that of a shadow: shadows are bluer or redder than their surroundings, but hardly greener. */
static float light_of(const mix_job *j, int32_t p, const look *l, int32_t x0, int32_t y0, int32_t step)
{
    float sum[3] = {0, 0, 0}, peak = 0.0f;
    for (int32_t k = 0; k < step * step; ++k) {
        const size_t at = (size_t)(y0 + k / step) * (size_t)j->frame.camera.width + (size_t)(x0 + k % step);
        const float *rgb = j->frame.light.pixels + 3 * at;
        if (j->planes.label[at] != p + 1 || !(rgb[l->channel] < CLIPPED) || !(rgb[l->channel] >= 0.0f)) {
            return 0.0f;
        }
        for (int c = 0; c < 3; ++c) {
            sum[c] += rgb[c] / (float)(step * step);
            peak = fmaxf(peak, rgb[c]);
        }
    }
    const int is_alike = !(peak < CLIPPED) || (fabsf(stops_over(sum[0], sum[1]) - l->red) < RED_STOPS &&
                                               fabsf(stops_over(sum[2], sum[1]) - l->blue) < BLUE_STOPS);
    return is_alike ? fmaxf(sum[l->channel], DARKEST) : 0.0f;
}

static int32_t add_plane(cast *c, int32_t p, int32_t n)
{
    const mix_job *j = c->j;
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height, step = step_of(j);
    const lmb_vec3 normal = lmb_axes_turn(&j->axes, j->planes.plane[p].normal);
    const look l = look_of(j, p);
    for (int32_t y = 0; y + step <= h; y += step) {
        for (int32_t x = 0; x + step <= w; x += step) {
            const float light = light_of(j, p, &l, x, y, step);
            const int32_t mx = x + step / 2, my = y + step / 2, at = my * w + mx;
            if (!(light > 0.0f) || !(j->cloud.inverse[at] > 0.0f)) {
                continue;
            }
            const float u = 2.0f * (float)x / (float)w - 1.0f, v = 2.0f * (float)y / (float)h - 1.0f;
            const float term[TERMS] = {1.0f, u, v, u * u, u * v, v * v};
            place *to = &c->all[n++];
            to->at = plus(lmb_axes_turn(&j->axes, lmb_cloud_point(&j->cloud, mx, my)), normal, CLEAR);
            to->normal = normal;
            to->depth = 1.0f / j->cloud.inverse[at];
            to->light = log2f(light);
            to->plain = light;
            memcpy(to->term, term, sizeof term);
        }
    }
    return n;
}

/* Makes the terms orthonormal (Gram-Schmidt). */
static void set_terms(place *p, int32_t n)
{
    for (int t = 0; t < TERMS; ++t) {
        double length = 0.0;
        for (int s = 0; s < t; ++s) {
            double along = 0.0;
            for (int32_t i = 0; i < n; ++i) {
                along += (double)(p[i].term[s] * p[i].term[t]);
            }
            for (int32_t i = 0; i < n; ++i) {
                p[i].term[t] -= (float)along * p[i].term[s];
            }
        }
        for (int32_t i = 0; i < n; ++i) {
            length += (double)(p[i].term[t] * p[i].term[t]);
        }
        for (int32_t i = 0; i < n; ++i) {
            p[i].term[t] *= length > 1e-6 ? (float)(1.0 / sqrt(length)) : 0.0f;
        }
    }
}

/* Removes from the values the part that the terms explain. */
static void flatten(float *value, size_t stride, const place *p, int32_t n)
{
    for (int t = 0; t < TERMS; ++t) {
        double along = 0.0;
        for (int32_t i = 0; i < n; ++i) {
            along += (double)(value[stride * (size_t)i] * p[i].term[t]);
        }
        for (int32_t i = 0; i < n; ++i) {
            value[stride * (size_t)i] -= (float)along * p[i].term[t];
        }
    }
}

/* Divides by the plane's mean. Returns the sum of squared differences from it. */
static double level(place *p, int32_t n)
{
    double sum = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        sum += (double)p[i].plain;
    }
    for (int32_t i = 0; i < n; ++i) {
        p[i].plain = fminf(p[i].plain * (float)((double)n / sum), BRIGHT);
    }
    double mean = 0.0, squares = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        mean += (double)p[i].plain / n;
        squares += (double)(p[i].plain * p[i].plain);
    }
    return fmax(squares - mean * mean * n, 0.0);
}

static void find_places(cast *c)
{
    int32_t n = 0;
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        c->first[p] = n;
        n = add_plane(c, p, n);
        n = n - c->first[p] < FEW ? c->first[p] : n;
        place *here = c->all + c->first[p];
        const int32_t count = n - c->first[p];
        set_terms(here, count);
        if (count > 0) {
            flatten(&here->light, sizeof *here / sizeof(float), here, count);
        }
        c->uneven += level(here, count) + GRAIN * count;
        for (int32_t i = 0; i < count; ++i) {
            here[i].light = fminf(fmaxf(here[i].light, -STOPS), STOPS);
            c->total += (double)(here[i].light * here[i].light);
        }
    }
    c->first[c->j->planes.count] = n;
}

/* --- the light of a candidate ------------------------------------------------------------------------------------- */

/* Sets the positions of up to 64 places from i on. Returns their number. */
static int32_t set_tile(lmb_tile *out, const cast *c, int32_t i)
{
    const int32_t left = c->first[c->j->planes.count] - i, count = left < LMB_TILE_PIXELS ? left : LMB_TILE_PIXELS;
    memset(out, 0, sizeof *out);
    for (int32_t k = 0; k < count; ++k) {
        const place *p = &c->all[i + k];
        const float at[3] = {p->at.x, p->at.y, p->at.z};
        for (int a = 0; a < 3; ++a) {
            out->position[a][k] = at[a];
        }
        out->depth[k] = p->depth;
        out->id[k] = 1;
    }
    return count;
}

static void clear_seen(cast *c) { memset(c->seen, 0, (size_t)c->first[c->j->planes.count] * sizeof *c->seen); }

static void add_mask(cast *c, int32_t i, int32_t count, uint64_t seen, float weight)
{
    for (int32_t k = 0; k < count; ++k) {
        c->seen[i + k] += (seen >> k & 1u) != 0 ? weight : 0.0f;
    }
}

/* Adds `weight` to the places that see the sun. */
static void add_seen(cast *c, lmb_vec3 to, float weight)
{
    const int32_t all = c->first[c->j->planes.count];
    for (int32_t i = 0; i < all; i += LMB_TILE_PIXELS) {
        lmb_tile tile;
        uint64_t asked = 0;
        const int32_t count = set_tile(&tile, c, i);
        for (int32_t k = 0; k < count; ++k) {
            asked |= (uint64_t)(dot(c->all[i + k].normal, to) > 0.05f) << k;
        }
        const uint64_t hidden =
            asked != 0 ? lmb_occluded_sun(c->j->o.kernels, &c->traversal, &c->bvh, &tile, asked, to) : 0;
        add_mask(c, i, count, asked & ~hidden, weight);
    }
}

/* Adds `weight` to the places that see a point. */
static void add_seen_point(cast *c, lmb_vec3 at, float weight)
{
    const int32_t all = c->first[c->j->planes.count];
    for (int32_t i = 0; i < all; i += LMB_TILE_PIXELS) {
        lmb_tile tile;
        uint64_t asked = 0;
        const int32_t count = set_tile(&tile, c, i);
        for (int32_t k = 0; k < count; ++k) {
            asked |= (uint64_t)(dot(plus(at, c->all[i + k].at, -1.0f), c->all[i + k].normal) > 0.0f) << k;
        }
        const float noise = lmb_tile_noise(&tile, asked) + lmb_place_noise(at, 0.0f);
        const uint64_t hidden =
            asked != 0 ? lmb_occluded_tile(c->j->o.kernels, &c->traversal, &c->bvh, &tile, asked, at, noise) : 0;
        add_mask(c, i, count, asked & ~hidden, weight);
    }
}

/* Returns the squared stops that the shadows in c->seen explain, minus those with the wrong sign. *stops: darkening by
 * a shadow on a surface that faces the light. Removes the smooth variation from c->seen. */
static double explain_shadows(cast *c, double *stops)
{
    double sum = 0.0, xy = 0.0, xx = 0.0;
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        const int32_t n = c->first[p + 1] - c->first[p];
        const place *here = c->all + c->first[p];
        float *seen = c->seen + c->first[p];
        const double cosine = c->cosine[p];
        double here_xy = 0.0, here_xx = 0.0;
        if (n == 0 || !(cosine > 0.05)) {
            continue;
        }
        flatten(seen, 1, here, n);
        for (int32_t i = 0; i < n; ++i) {
            here_xy += (double)(seen[i] * here[i].light);
            here_xx += (double)(seen[i] * seen[i]);
        }
        if (here_xx > 1.0) {
            sum += (here_xy > 0.0 ? 1.0 : -1.0) * here_xy * here_xy / here_xx;
            xy += cosine * here_xy;
            xx += cosine * cosine * here_xx;
        }
    }
    *stops = xx > 0.0 ? xy / xx : 0.0;
    return sum;
}

/* Returns the squares that the light in c->lit explains if the colour and the even light of each plane are unknown. A
 * pattern on one plane can look like such light, so a part must be of other planes. *share: the light on a surface that
 * faces it, relative to the even light. */
static double explain_falloff(const cast *c, double *share)
{
    double sum = 0.0, largest = 0.0, sent = 0.0, even = 1e-9;
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        const int32_t n = c->first[p + 1] - c->first[p];
        const place *here = c->all + c->first[p];
        const float *lit = c->lit + c->first[p];
        double x = 0.0, xx = 0.0, xy = 0.0;
        for (int32_t i = 0; i < n; ++i) {
            x += (double)lit[i] / n;
        }
        for (int32_t i = 0; i < n; ++i) {
            const double dx = (double)lit[i] - x;
            xx += dx * dx;
            xy += dx * ((double)here[i].plain - 1.0);
        }
        if (xy > 0.0 && xx > 1e-9) {
            const double by = fmin(xy / xx, EVEN / fmax(x, 1e-9)), /* the rest is even light */
                         here_sum = 2.0 * by * xy - by * by * xx;
            sum += here_sum;
            largest = fmax(largest, here_sum);
            sent += by * by * xx;
            even += by * (1.0 - by * x) * xx;
        }
    }
    *share = sent / even;
    return fmin(sum, (sum - largest) / OTHERS);
}

/* --- a sun -------------------------------------------------------------------------------------------------------- */

/* Adds one direction to the cosine-weighted visible share of the sky. */
static void add_open(cast *c, lmb_vec3 to)
{
    for (int32_t i = 0; i < c->first[c->j->planes.count]; ++i) {
        c->open[i] += c->seen[i] * fmaxf(dot(c->all[i].normal, to), 0.0f) * (2.0f / WAYS);
    }
}

static void see_sun(cast *c, lmb_vec3 to, float size)
{
    const int32_t rays = size > 0.0f ? RAYS : 1;
    const lmb_vec3 other = fabsf(to.x) < 0.5f ? (lmb_vec3){1, 0, 0} : (lmb_vec3){0, 0, 1},
                   a = unit(plus(other, to, -dot(other, to))),
                   b = {to.y * a.z - to.z * a.y, to.z * a.x - to.x * a.z, to.x * a.y - to.y * a.x};
    clear_seen(c);
    for (int32_t i = 0; i < rays; ++i) {
        const float far = tanf(0.5f * size * (PI / 180.0f)) * sqrtf(((float)i + 0.5f) / (float)rays),
                    turn = 2.3999632f * (float)i;
        add_seen(c, rays > 1 ? unit(plus(plus(to, a, far * cosf(turn)), b, far * sinf(turn))) : to, 1.0f / (float)rays);
    }
}

/* As explain_shadows, for a sun. */
static double explain(cast *c, lmb_vec3 to, float size, double *stops, int is_first)
{
    see_sun(c, to, size);
    if (is_first) {
        add_open(c, to);
    }
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        c->cosine[p] = c->first[p + 1] > c->first[p] ? (double)dot(c->all[c->first[p]].normal, to) : 0.0;
    }
    return explain_shadows(c, stops);
}

static lmb_vec3 way(int32_t i)
{
    const float y = LOWEST + (0.995f - LOWEST) * ((float)i + 0.5f) / WAYS, flat = sqrtf(1.0f - y * y),
                turn = 2.3999632f * (float)i;
    return (lmb_vec3){flat * cosf(turn), y, flat * sinf(turn)};
}

/* --- a near light ------------------------------------------------------------------------------------------------- */

/* A near light: a ball, or a window whose light falls off with the angle to its level way to the foot. */
typedef struct lamp {
    lmb_vec3 at;
    float radius;
    double by, by_shadows, share; /* what it explains, and its light relative to the even light */
} lamp;

/* Sets the light that the lamp sends to the places. */
static void set_lit(cast *c, lmb_vec3 at, lmb_vec3 foot, int is_window)
{
    const lmb_vec3 off = plus(at, foot, -1.0f);
    const float squared = dot(off, off), level = fmaxf(sqrtf(off.x * off.x + off.z * off.z), 1e-6f);
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        c->cosine[p] = 0.0;
        for (int32_t i = c->first[p]; i < c->first[p + 1]; ++i) {
            const lmb_vec3 to = plus(at, c->all[i].at, -1.0f);
            const float d2 = fmaxf(dot(to, to), 1e-4f), d = sqrtf(d2), cosine = dot(to, c->all[i].normal) / d;
            c->lit[i] = c->seen[i] * fmaxf(cosine, 0.0f) * squared / d2;
            if (is_window) {
                c->lit[i] *= fmaxf((to.x * off.x + to.z * off.z) / (level * d), 0.0f);
            }
            c->cosine[p] += (double)cosine / (c->first[p + 1] - c->first[p]);
        }
    }
}

static lamp lamp_at(cast *c, lmb_vec3 at, float radius, lmb_vec3 foot)
{
    const int32_t rays = radius > 0.0f ? RAYS : 1;
    lamp out = {at, radius, 0.0, 0.0, 0.0};
    clear_seen(c);
    for (int32_t i = 0; i < rays; ++i) {
        const float y = 1.0f - (2.0f * (float)i + 1.0f) / (float)rays, flat = sqrtf(1.0f - y * y),
                    turn = 2.3999632f * (float)i;
        add_seen_point(c, plus(at, (lmb_vec3){flat * cosf(turn), y, flat * sinf(turn)}, radius), 1.0f / (float)rays);
    }
    for (int is_window = 0; is_window < 2; ++is_window) {
        double share = 0.0;
        set_lit(c, at, foot, is_window);
        const double by = explain_falloff(c, &share) / c->uneven;
        if (by > out.by) {
            out.by = by;
            out.share = share;
        }
    }
    double stops;
    out.by_shadows = explain_shadows(c, &stops) / c->total;
    out.by += out.by_shadows;
    return out;
}

/* Replaces the best lamp if this one explains more. */
static void try_lamp(lamp *best, cast *c, lmb_vec3 at, float radius, lmb_vec3 foot)
{
    const lmb_vec3 to = plus(at, foot, -1.0f);
    if (to.y > LOWEST * sqrtf(dot(to, to))) {
        const lamp one = lamp_at(c, at, radius, foot);
        *best = one.by > best->by ? one : *best;
    }
}

/* Moves the lamp by decreasing steps as long as it explains more. */
static void refine_lamp(lamp *best, cast *c, lmb_vec3 foot)
{
    static const float off[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (float step = 0.3f; step > 0.04f; step *= 0.5f) {
        for (int i = 0; i < 12; ++i) {
            const lmb_vec3 by = {off[i % 6][0], off[i % 6][1], off[i % 6][2]};
            try_lamp(best, c, plus(best->at, by, step), best->radius, foot);
        }
    }
}

/* Refines the best lamp of each distance, because neighbouring distances explain nearly as much. */
static void find_lamp(mix_cast *out, cast *c, lmb_vec3 foot)
{
    static const float far[] = {0.7f, 1.0f, 1.4f, 2.0f, 2.8f, 4.0f}, radii[] = {0.1f, 0.2f, 0.35f, 0.6f, 0.9f};
    lamp best = {foot, 0.0f, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < sizeof far / sizeof *far; ++k) {
        lamp here = {foot, 0.0f, 0.0, 0.0, 0.0};
        for (int32_t i = 0; i < WAYS; i += 2) {
            try_lamp(&here, c, plus(foot, way(i), far[k]), 0.0f, foot);
        }
        if (here.by > 0.0) {
            refine_lamp(&here, c, foot);
        }
        best = here.by > best.by ? here : best;
    }
    for (int pass = 0; pass < 2 && best.by > 0.0; ++pass) {
        for (size_t i = 0; i < sizeof radii / sizeof *radii; ++i) {
            try_lamp(&best, c, best.at, radii[i], foot);
        }
        refine_lamp(&best, c, foot);
    }
    const lmb_vec3 to = plus(best.at, foot, -1.0f);
    out->to = unit(to);
    out->size = best.radius > 0.0f ? fminf(360.0f / PI * atanf(best.radius / sqrtf(dot(to, to))), WIDEST) : NARROWEST;
    out->share = (float)best.share;
    out->by_shadows = (float)best.by_shadows;
    out->explained = (float)best.by;
    out->is_near = 1;
}

/* --- the search --------------------------------------------------------------------------------------------------- */

static void search(mix_cast *out, cast *c, double *best)
{
    double stops;
    *best = 0.0;
    for (int32_t i = 0; i < WAYS; ++i) {
        const double by = explain(c, way(i), 0.0f, &stops, 1);
        if (by > *best) {
            *best = by;
            out->to = way(i);
        }
    }
}

/* Ambient light is also darker near objects. Fits visible sky and sun together and removes the sky's part from the
 * light of the places. */
static void take_open(cast *c, lmb_vec3 to)
{
    double oo = 1e-9, vv = 1e-9, ov = 0.0, oy = 0.0, vy = 0.0, stops;
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        flatten(c->open + c->first[p], 1, c->all + c->first[p], c->first[p + 1] - c->first[p]);
    }
    explain(c, to, 0.0f, &stops, 0);
    for (int32_t i = 0; i < c->first[c->j->planes.count]; ++i) {
        const double o = (double)c->open[i], v = (double)c->seen[i], y = (double)c->all[i].light;
        oo += o * o;
        vv += v * v;
        ov += o * v;
        oy += o * y;
        vy += v * y;
    }
    const double by = oo * vv - ov * ov > 1e-3 * oo * vv ? fmax((oy * vv - vy * ov) / (oo * vv - ov * ov), 0.0) : 0.0;
    for (int32_t i = 0; i < c->first[c->j->planes.count]; ++i) {
        c->all[i].light -= (float)by * c->open[i];
    }
}

/* Refines the direction in decreasing steps. */
static void refine(mix_cast *out, cast *c, double *best)
{
    double stops;
    *best = explain(c, out->to, 0.0f, &stops, 0);
    for (float step = 0.08f; step > 0.015f && *best > 0.0; step *= 0.5f) {
        const lmb_vec3 from = out->to, side = unit((lmb_vec3){from.z, 0, -from.x}),
                       high = {from.y * side.z, from.z * side.x - from.x * side.z, -from.y * side.x};
        for (int32_t i = 0; i < TURNS; ++i) {
            const float turn = 2.0f * PI * (float)i / TURNS;
            const lmb_vec3 to = unit(plus(plus(from, side, step * cosf(turn)), high, step * sinf(turn)));
            const double by = to.y > LOWEST ? explain(c, to, 0.0f, &stops, 0) : 0.0;
            if (by > *best) {
                *best = by;
                out->to = to;
            }
        }
    }
}

static void measure(mix_cast *out, cast *c)
{
    static const float sizes[] = {3.0f, 8.0f, 16.0f, 30.0f, 50.0f};
    double best, stops;
    search(out, c, &best);
    take_open(c, out->to);
    refine(out, c, &best);
    best = explain(c, out->to, 0.0f, &stops, 0);
    out->size = 1.0f;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        double here;
        const double by = explain(c, out->to, sizes[i], &here, 0);
        if (by > best) {
            best = by;
            stops = here;
            out->size = sizes[i];
        }
    }
    see_sun(c, out->to, out->size);
    memcpy(c->lit, c->seen, (size_t)c->first[c->j->planes.count] * sizeof *c->lit);
    double share;
    out->by_shadows = stops < DARKER ? (float)(best / c->total) : 0.0f;
    out->explained = out->by_shadows + (float)(explain_falloff(c, &share) / c->uneven);
    out->share = (float)(exp2(fmin(fmax(stops, 0.0), DARKER)) - 1.0);
}

static int build_bvh(cast *c)
{
    lmb_scene real = c->j->scene;
    const size_t bytes = lmb_bvh_bytes(c->j->real_triangles);
    real.instance_count = 1;
    real.light_count = 0;
    c->memory = malloc(bytes);
    return c->memory != NULL && lmb_bvh_init(&c->bvh, c->j->real_triangles, c->memory, bytes) == LMB_OK &&
           lmb_bvh_build(&c->bvh, &real) == LMB_OK;
}

int mix_find_cast(mix_cast *out, const mix_job *j, lmb_vec3 foot)
{
    cast *c = calloc(1, sizeof *c);
    const int32_t step = step_of(j);
    const size_t cap = (size_t)(j->frame.camera.width / step + 1) * (size_t)(j->frame.camera.height / step + 1);
    int ok = c != NULL;
    memset(out, 0, sizeof *out);
    out->to = (lmb_vec3){0, 1, 0};
    if (ok && j->real_triangles > 0) {
        c->j = j;
        c->all = malloc(cap * sizeof *c->all);
        c->seen = malloc(cap * sizeof *c->seen);
        c->lit = malloc(cap * sizeof *c->lit);
        c->open = calloc(cap, sizeof *c->open);
        ok = c->all != NULL && c->seen != NULL && c->lit != NULL && c->open != NULL && build_bvh(c);
        if (ok) {
            mix_cast near = *out;
            find_places(c);
            if (c->total > 0.0) {
                measure(out, c);
                find_lamp(&near, c, foot);
                *out = near.explained > NEARER + out->explained ? near : *out;
            }
        }
        free(c->all);
        free(c->seen);
        free(c->lit);
        free(c->open);
        free(c->memory);
    }
    free(c);
    return ok;
}
