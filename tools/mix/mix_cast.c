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
#define EVEN    0.95  /* most of a plane's light that a near light may send */
#define GRAIN   1e-3  /* variance of a place's light that shows nothing */
#define OTHERS  0.05  /* minimum part of a near light's light on other planes than one */
#define BRIGHT  3.0f /* limit of a place's light, relative to the plane's mean */
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
    float *lit;  /* by place: visible share of the tested sun, 0 .. 1 */
    float *open; /* by place: visible share of the sky, 0 .. 1; later without the smooth variation */
    int32_t first[LMB_MAX_PLANES + 1];
    double even[LMB_MAX_PLANES]; /* by plane: squared differences from even light */
    lmb_traversal traversal;
    double total; /* sum of squared light deviations */
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

/* Divides by the plane's mean. */
static void level(place *p, int32_t n)
{
    double sum = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        sum += (double)p[i].plain;
    }
    for (int32_t i = 0; i < n; ++i) {
        p[i].plain = fminf(p[i].plain * (float)((double)n / sum), BRIGHT);
    }
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
        level(here, count);
        for (int32_t i = 0; i < count; ++i) {
            here[i].light = fminf(fmaxf(here[i].light, -STOPS), STOPS);
            c->total += (double)(here[i].light * here[i].light);
        }
    }
    c->first[c->j->planes.count] = n;
}

/* --- a sun -------------------------------------------------------------------------------------------------------- */

/* Adds `weight` to the places that see the sun. */
static void add_seen(cast *c, lmb_vec3 to, float weight)
{
    const int32_t all = c->first[c->j->planes.count];
    for (int32_t i = 0; i < all; i += LMB_TILE_PIXELS) {
        lmb_tile tile;
        uint64_t asked = 0;
        memset(&tile, 0, sizeof tile);
        for (int32_t k = 0; k < LMB_TILE_PIXELS && i + k < all; ++k) {
            const place *p = &c->all[i + k];
            const float at[3] = {p->at.x, p->at.y, p->at.z};
            for (int a = 0; a < 3; ++a) {
                tile.position[a][k] = at[a];
            }
            tile.depth[k] = p->depth;
            tile.id[k] = 1;
            asked |= (uint64_t)(dot(p->normal, to) > 0.05f) << k;
        }
        const uint64_t seen =
            asked & ~(asked != 0 ? lmb_occluded_sun(c->j->o.kernels, &c->traversal, &c->bvh, &tile, asked, to) : 0);
        for (int32_t k = 0; k < LMB_TILE_PIXELS && i + k < all; ++k) {
            c->lit[i + k] += (seen >> k & 1u) != 0 ? weight : 0.0f;
        }
    }
}

/* Adds one direction to the cosine-weighted visible share of the sky. */
static void add_open(cast *c, lmb_vec3 to)
{
    for (int32_t i = 0; i < c->first[c->j->planes.count]; ++i) {
        c->open[i] += c->lit[i] * fmaxf(dot(c->all[i].normal, to), 0.0f) * (2.0f / WAYS);
    }
}

/* Returns the squared stops that the sun's shadows explain, minus those with the wrong sign. *stops: darkening by a
 * shadow on a surface that faces the sun. */
static double explain(cast *c, lmb_vec3 to, float size, double *stops, int is_first)
{
    const int32_t all = c->first[c->j->planes.count], rays = size > 0.0f ? RAYS : 1;
    double sum = 0.0, xy = 0.0, xx = 0.0;
    const lmb_vec3 other = fabsf(to.x) < 0.5f ? (lmb_vec3){1, 0, 0} : (lmb_vec3){0, 0, 1},
                   a = unit(plus(other, to, -dot(other, to))),
                   b = {to.y * a.z - to.z * a.y, to.z * a.x - to.x * a.z, to.x * a.y - to.y * a.x};
    memset(c->lit, 0, (size_t)all * sizeof *c->lit);
    for (int32_t i = 0; i < rays; ++i) {
        const float far = tanf(0.5f * size * (PI / 180.0f)) * sqrtf(((float)i + 0.5f) / (float)rays),
                    turn = 2.3999632f * (float)i;
        add_seen(c, rays > 1 ? unit(plus(plus(to, a, far * cosf(turn)), b, far * sinf(turn))) : to, 1.0f / (float)rays);
    }
    if (is_first) {
        add_open(c, to);
    }
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        const int32_t n = c->first[p + 1] - c->first[p];
        const place *here = c->all + c->first[p];
        double here_xy = 0.0, here_xx = 0.0;
        const double cosine = n > 0 ? (double)dot(here->normal, to) : 0.0;
        if (!(cosine > 0.05)) {
            continue;
        }
        flatten(c->lit + c->first[p], 1, here, n);
        for (int32_t i = 0; i < n; ++i) {
            here_xy += (double)(c->lit[c->first[p] + i] * here[i].light);
            here_xx += (double)(c->lit[c->first[p] + i] * c->lit[c->first[p] + i]);
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

static lmb_vec3 way(int32_t i)
{
    const float y = LOWEST + (0.995f - LOWEST) * ((float)i + 0.5f) / WAYS, flat = sqrtf(1.0f - y * y),
                turn = 2.3999632f * (float)i;
    return (lmb_vec3){flat * cosf(turn), y, flat * sinf(turn)};
}

/* --- a near light ------------------------------------------------------------------------------------------------- */

/* Sets the light that a near light at `at` sends to the places; 1 is a surface `distance` m away that faces it. */
static void set_lamp(cast *c, lmb_vec3 at, float distance)
{
    const int32_t all = c->first[c->j->planes.count];
    for (int32_t i = 0; i < all; i += LMB_TILE_PIXELS) {
        lmb_tile tile;
        uint64_t asked = 0;
        float sent[LMB_TILE_PIXELS] = {0};
        memset(&tile, 0, sizeof tile);
        for (int32_t k = 0; k < LMB_TILE_PIXELS && i + k < all; ++k) {
            const place *p = &c->all[i + k];
            const lmb_vec3 to = plus(at, p->at, -1.0f);
            const float from[3] = {p->at.x, p->at.y, p->at.z}, d2 = fmaxf(dot(to, to), 1e-4f);
            for (int a = 0; a < 3; ++a) {
                tile.position[a][k] = from[a];
            }
            tile.depth[k] = p->depth;
            tile.id[k] = 1;
            sent[k] = dot(to, p->normal) * distance * distance / (d2 * sqrtf(d2));
            asked |= (uint64_t)(sent[k] > 0.0f) << k;
        }
        const float noise = lmb_tile_noise(&tile, asked) + lmb_place_noise(at, 0.0f);
        const uint64_t seen =
            asked & ~(asked != 0 ? lmb_occluded_tile(c->j->o.kernels, &c->traversal, &c->bvh, &tile, asked, at, noise)
                                 : 0);
        for (int32_t k = 0; k < LMB_TILE_PIXELS && i + k < all; ++k) {
            c->lit[i + k] = (seen >> k & 1u) != 0 ? sent[k] : 0.0f;
        }
    }
}

/* Returns the squared differences of a plane's places from even light plus `ratio` times the light in c->lit. */
static double misfit(const cast *c, int32_t p, double ratio)
{
    const int32_t n = c->first[p + 1] - c->first[p];
    const place *here = c->all + c->first[p];
    const float *lit = c->lit + c->first[p];
    double mean = 0.0, sum = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        mean += (1.0 + ratio * (double)lit[i]) / n;
    }
    for (int32_t i = 0; i < n; ++i) {
        const double off = (double)here[i].plain - (1.0 + ratio * (double)lit[i]) / mean;
        sum += off * off;
    }
    return sum;
}

/* Returns the share of the places' variance that the light in c->lit explains if each plane has an unknown colour, and
 * all have the same even light. A pattern on one plane can look like such light, so a part of the share must
 * be of other planes. */
static double fits_even(const cast *c)
{
    double total = GRAIN * (double)c->first[c->j->planes.count], best = 0.0;
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        total += c->even[p];
    }
    for (double ratio = 0.25; ratio < 20.0; ratio *= 2.0) {
        double sum = 0.0, largest = 0.0;
        for (int32_t p = 0; p < c->j->planes.count; ++p) {
            const double by = c->even[p] - misfit(c, p, ratio);
            sum += by;
            largest = fmax(largest, by);
        }
        best = fmax(best, fmin(sum, (sum - largest) / OTHERS) / total);
    }
    return best;
}

/* Returns the squares that the light in c->lit explains if the even light of each plane is unknown too, which gives a
 * better direction. *share: the lamp's light on a surface that faces it, relative to the even light. */
static double fits(const cast *c, double *share)
{
    double sum = 0.0, lamp = 0.0, even = 1e-9;
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
            const double by = fmin(xy / xx, EVEN / fmax(x, 1e-9)); /* the rest is even light */
            sum += 2.0 * by * xy - by * by * xx;
            lamp += by * by * xx;
            even += by * (1.0 - by * x) * xx;
        }
    }
    *share = lamp / even;
    return sum;
}

/* Keeps the lamp at `at` if it explains more than the best one so far. */
static void try_lamp(mix_lamp *out, double *best, lmb_vec3 *best_at, cast *c, lmb_vec3 at, lmb_vec3 foot)
{
    const lmb_vec3 to = plus(at, foot, -1.0f);
    const float distance = sqrtf(dot(to, to));
    if (!(to.y > LOWEST * distance)) {
        return;
    }
    double share = 0.0;
    set_lamp(c, at, distance);
    const double by = fits(c, &share);
    if (by > *best) {
        *best = by;
        *best_at = at;
        *out = (mix_lamp){unit(to), (float)share, (float)fits_even(c)};
    }
}

static void find_lamp(mix_lamp *out, cast *c, lmb_vec3 foot)
{
    static const float far[] = {0.7f, 1.0f, 1.4f, 2.0f, 2.8f, 4.0f};
    static const float off[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    lmb_vec3 at = foot;
    double best = 0.0;
    for (int32_t p = 0; p < c->j->planes.count; ++p) {
        c->even[p] = misfit(c, p, 0.0);
    }
    for (int32_t i = 0; i < WAYS; i += 3) {
        for (size_t k = 0; k < sizeof far / sizeof *far; ++k) {
            try_lamp(out, &best, &at, c, plus(foot, way(i), far[k]), foot);
        }
    }
    for (float step = 0.3f; step > 0.04f && best > 0.0; step *= 0.5f) {
        const lmb_vec3 from = at;
        for (int32_t i = 0; i < 6; ++i) {
            try_lamp(out, &best, &at, c, plus(from, (lmb_vec3){off[i][0], off[i][1], off[i][2]}, step), foot);
        }
    }
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
        const double o = (double)c->open[i], v = (double)c->lit[i], y = (double)c->all[i].light;
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
    out->explained = c->total > 0.0 && stops < DARKER ? (float)(best / c->total) : 0.0f;
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

int mix_find_cast(mix_cast *sun, mix_lamp *lamp, const mix_job *j, lmb_vec3 foot)
{
    cast *c = calloc(1, sizeof *c);
    const int32_t step = step_of(j);
    const size_t cap = (size_t)(j->frame.camera.width / step + 1) * (size_t)(j->frame.camera.height / step + 1);
    int ok = c != NULL;
    memset(sun, 0, sizeof *sun);
    memset(lamp, 0, sizeof *lamp);
    sun->to = lamp->to = (lmb_vec3){0, 1, 0};
    if (ok && j->real_triangles > 0) {
        c->j = j;
        c->all = malloc(cap * sizeof *c->all);
        c->lit = malloc(cap * sizeof *c->lit);
        c->open = calloc(cap, sizeof *c->open);
        ok = c->all != NULL && c->lit != NULL && c->open != NULL && build_bvh(c);
        if (ok) {
            find_places(c);
            measure(sun, c);
            find_lamp(lamp, c, foot);
        }
        free(c->all);
        free(c->lit);
        free(c->open);
        free(c->memory);
    }
    free(c);
    return ok;
}
