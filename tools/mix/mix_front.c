/* mix_front.c: what real things are in front of the object: measured depth whose edges follow the photo's colours. */
#include "mix_front.h"

#include <math.h>
#include <string.h>

/* Sensors are wrong up to so many pixels from an edge; and surfaces so far apart, relatively, have an edge between. */
enum { EDGE = 4, REACH = 8, HOLES = 14 /* px of a window: less is a spot, more may be what a near thing hides */ };
#define STEP      0.04f
#define COLOUR    0.08f /* of white, display's values: how like two pixels are */
#define ALIKE     0.3f  /* what at least one pixel of a surface is, for a pixel to become part of it */
#define GRAZES    0.7f  /* planes that change so much within the window tell nothing beside it */
#define DOUBTFUL  0.1f  /* what a pixel near an edge counts beside one that is not */

typedef struct refiner {
    const lmb_cloud *cloud;
    const lmb_planes *planes;
    const float *rgb;
} refiner;

/* The window of `reach` around a pixel that lies in the picture. */
typedef struct window {
    int32_t x0, y0, x1, y1;
} window;

static window around(const lmb_pinhole *c, int32_t x, int32_t y, int32_t reach)
{
    const window w = {x < reach ? 0 : x - reach, y < reach ? 0 : y - reach,
                      x + reach < c->width ? x + reach : c->width - 1,
                      y + reach < c->height ? y + reach : c->height - 1};
    return w;
}

/* Is there an edge near, or nothing measured? What is all of one plane has none, however steep it is. */
static int is_doubtful(const refiner *f, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &f->cloud->camera;
    const window w = around(c, x, y, EDGE);
    const int32_t at = y * c->width + x;
    const uint8_t label = f->planes->label[at];
    float min = INFINITY, max = 0.0f;
    int mixed = label == 0, holes = 0;
    if (!(f->cloud->inverse[at] > 0.0f)) {
        return 1;
    }
    for (int32_t v = w.y0; v <= w.y1; ++v) {
        for (int32_t u = w.x0; u <= w.x1; ++u) {
            const float q = f->cloud->inverse[v * c->width + u];
            holes += !(q > 0.0f);
            if (q > 0.0f) {
                min = fminf(min, q);
                max = fmaxf(max, q);
                mixed |= f->planes->label[v * c->width + u] != label;
            }
        }
    }
    return holes > HOLES || (mixed && max - min > STEP * max + 4.0f * lmb_cloud_sigma(f->cloud, max));
}

/* How like two pixels are, 0 .. 1, in about a display's values. */
static float likeness(const float *a, const float *b)
{
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float d = sqrtf(fmaxf(a[c], 0.0f)) - sqrtf(fmaxf(b[c], 0.0f));
        sum += d * d;
    }
    sum *= 1.0f / (COLOUR * COLOUR);
    return 1.0f / (1.0f + sum * sum);
}

/* What another pixel says of this one's distance: its plane goes on to here. A steep floor's mean of pixels around would
 * lie before what stands on it. */
static float said_of(const refiner *f, int32_t x, int32_t y, int32_t other)
{
    const float q = f->cloud->inverse[other];
    const uint8_t label = f->planes->label[other];
    if (label == 0 || !(q > 0.0f)) {
        return q;
    }
    const lmb_vec3 ray = lmb_cloud_ray(&f->cloud->camera, (float)x, (float)y);
    const float *slope = f->planes->plane[label - 1].slope, on = slope[0] * ray.x + slope[1] * ray.y + slope[2];
    return on > GRAZES * q && on * GRAZES < q ? on : q;
}

/* The surface, near or far, that the pixels like this one have. */
static float chosen(const refiner *f, const uint8_t *doubt, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &f->cloud->camera;
    const window w = around(c, x, y, REACH);
    const int32_t at = y * c->width + x;
    const float own = f->cloud->inverse[at];
    float min = INFINITY, max = 0.0f, weight[2] = {0, 0}, sum[2] = {0, 0}, alike[2] = {-1, -1};
    for (int32_t v = w.y0; v <= w.y1; ++v) {
        for (int32_t u = w.x0; u <= w.x1; ++u) {
            const float q = said_of(f, x, y, v * c->width + u);
            min = q > 0.0f ? fminf(min, q) : min;
            max = fmaxf(max, q);
        }
    }
    const float between = 0.5f * (min + max);
    for (int32_t v = w.y0; v <= w.y1; ++v) {
        for (int32_t u = w.x0; u <= w.x1; ++u) {
            const int32_t k = v * c->width + u;
            const float q = said_of(f, x, y, k);
            if (q > 0.0f) {
                const float far = (float)((u - x) * (u - x) + (v - y) * (v - y));
                const float like = likeness(f->rgb + 3 * (size_t)at, f->rgb + 3 * (size_t)k);
                const float one = like * (doubt[k] ? DOUBTFUL : 1.0f) / (1.0f + far * (8.0f / (REACH * REACH)));
                alike[q > between] = doubt[k] ? alike[q > between] : fmaxf(alike[q > between], like);
                weight[q > between] += one;
                sum[q > between] += one * q;
            }
        }
    }
    const int side = weight[1] > weight[0];
    if (alike[side] < ALIKE) { /* a mixture of both keeps what was measured; beside one alone that is its ragged edge */
        return own > 0.0f && (alike[own > between] < 0.0f || alike[own < between] >= 0.0f) ? own : 0.0f;
    }
    return own > 0.0f && (own > between) == side ? own : sum[side] / weight[side];
}

void mix_front_refine(float *out, uint8_t *doubt, const lmb_cloud *cloud, const lmb_planes *planes, const float *rgb,
                      const int32_t box[4])
{
    const refiner f = {cloud, planes, rgb};
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    memcpy(out, cloud->inverse, (size_t)w * (size_t)h * sizeof *out);
    memset(doubt, 0, (size_t)w * (size_t)h);
    for (int32_t y = box[1] - REACH; y < box[3] + REACH; ++y) {
        for (int32_t x = box[0] - REACH; x < box[2] + REACH; ++x) {
            if (x >= 0 && y >= 0 && x < w && y < h) {
                doubt[y * w + x] = (uint8_t)is_doubtful(&f, x, y);
            }
        }
    }
    for (int32_t y = box[1]; y < box[3]; ++y) {
        for (int32_t x = box[0]; x < box[2]; ++x) {
            if (doubt[y * w + x]) {
                out[y * w + x] = chosen(&f, doubt, x, y);
            }
        }
    }
}

/* --- by sample ---------------------------------------------------------------------------------------------------- */

static int is_before(float q, float object, const lmb_cloud *cloud)
{
    return q > 0.0f && q - 1.0f / object > 2.0f * lmb_cloud_sigma(cloud, q);
}

/* Of the four pixels around the sample, by how near it is to each. */
static float surface_before(const float *front, const lmb_cloud *cloud, float x, float y, float object)
{
    const int32_t w = cloud->camera.width, h = cloud->camera.height, u = (int32_t)floorf(x), v = (int32_t)floorf(y);
    const float s = x - (float)u, t = y - (float)v;
    float hidden = 0.0f, near = 0.0f;
    for (int32_t k = 0; k < 4; ++k) {
        const int32_t px = u + (k & 1), py = v + (k >> 1);
        const float q = px < 0 || py < 0 || px >= w || py >= h ? 0.0f : front[py * w + px];
        const float weight = (k & 1 ? s : 1.0f - s) * (k >> 1 ? t : 1.0f - t);
        if (is_before(q, object, cloud)) {
            hidden += weight;
            near = fmaxf(near, q);
        }
    }
    return hidden > 0.5f ? near : 0.0f;
}

void mix_front_tile(lmb_tile *out, const lmb_tile *real, const lmb_tile *object, const float *front,
                    const lmb_cloud *cloud, float x, float y)
{
    *out = *real;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float near = object->id[k] == 0 ? 0.0f
                                              : surface_before(front, cloud, (float)(real->x + k % LMB_TILE) + x,
                                                               (float)(real->y + k / LMB_TILE) + y, object->depth[k]);
        out->id[k] = near > 0.0f;
        out->depth[k] = near > 0.0f ? 1.0f / near : 0.0f;
    }
}
