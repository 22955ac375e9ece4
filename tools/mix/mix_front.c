/* mix_front.c: real surfaces in front of the object: measured depth with edges aligned to the photo's colours. */
#include "mix_front.h"

#include <math.h>
#include <string.h>

/* Distance from an edge up to which sensors are wrong, px, and the relative depth step that makes an edge. */
enum { EDGE = 4, HOLES = 14 /* px in a window: fewer are specks, more may be hidden by a close object */,
       AROUND = 24 /* px beyond the box, because surfaces may reach into it */, SWEEPS = 6 };
#define STEP    0.04f
#define GRAZES  0.7f   /* if a plane changes more than this between pixels, it is too steep to extrapolate */
#define SHADOW  0.09f  /* px, relative to the focal length: width of the projector's shadow at 0.8 m */

/* Cost of a path from a surface, in differences of display values. */
#define A_PIXEL 0.005f /* per pixel of length */
#define A_HOLE  0.15f  /* per unmeasured pixel, if a farther surface is beside it: close objects are measured fully */
#define DOUBT   0.5f   /* of a measured pixel near an edge, against a neighbour's surface with a similar colour */

/* Pixels of a picture, bounds inclusive. */
typedef struct window {
    int32_t x0, y0, x1, y1;
} window;

typedef struct refiner {
    const lmb_cloud *cloud;
    const lmb_planes *planes;
    const float *rgb;
    mix_way *way;
    window all; /* the box and a margin that may affect it */
} refiner;

static window around(const lmb_pinhole *c, int32_t x, int32_t y, int32_t reach)
{
    const window w = {x < reach ? 0 : x - reach, y < reach ? 0 : y - reach,
                      x + reach < c->width ? x + reach : c->width - 1,
                      y + reach < c->height ? y + reach : c->height - 1};
    return w;
}

/* Is there an edge or a hole near? Pixels that all lie on one plane have no edge, however steep it is. */
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

/* The inverse distance here if pixel `other`'s surface continues: on the plane, if there is one. The mean around a
 * pixel of a steep floor would lie in front of objects on the floor. */
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

/* --- paths from surfaces ------------------------------------------------------------------------------------------ */

/* The farthest surface beside a hole, along the row: a hole lies in a close object's projector shadow, on that
 * surface. */
static float beyond(const refiner *f, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &f->cloud->camera;
    const window w = around(c, x, y, (int32_t)fminf(SHADOW * c->fx, (float)c->width) + 1);
    float min = INFINITY;
    for (int32_t u = w.x0; u <= w.x1; ++u) {
        const float q = f->cloud->inverse[y * c->width + u];
        min = q > 0.0f ? fminf(min, q) : min;
    }
    return min;
}

/* Starts a pixel: certain of its surface, doubtful near an edge (it may be a neighbour's), or a hole. */
static void begin(const refiner *f, int32_t x, int32_t y)
{
    const int32_t at = y * f->cloud->camera.width + x;
    mix_way *way = &f->way[at];
    const int is_measured = f->cloud->inverse[at] > 0.0f;
    way->is_doubtful = is_doubtful(f, x, y);
    way->from = is_measured ? at : -1;
    way->cost = !is_measured ? INFINITY : way->is_doubtful ? DOUBT : 0.0f;
    way->beyond = is_measured ? 0.0f : beyond(f, x, y);
}

/* Colour distance, in about display values. */
static float differ(const float *a, const float *b)
{
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float d = sqrtf(fmaxf(a[c], 0.0f)) - sqrtf(fmaxf(b[c], 0.0f));
        sum += d * d;
    }
    return sqrtf(sum);
}

/* Takes a neighbour's surface if its path costs less than the pixel's own. */
static void ask(const refiner *f, int32_t at, int32_t x, int32_t y, float length)
{
    const int32_t other = y * f->cloud->camera.width + x;
    if (x < f->all.x0 || x > f->all.x1 || y < f->all.y0 || y > f->all.y1 || f->way[other].from < 0) {
        return;
    }
    mix_way *to = &f->way[at];
    const mix_way *way = &f->way[other];
    const int is_near = to->beyond > 0.0f && f->cloud->inverse[way->from] > to->beyond * (1.0f + STEP);
    const float cost = way->cost + length * (is_near ? A_HOLE + A_PIXEL : A_PIXEL) +
                       differ(f->rgb + 3 * (size_t)at, f->rgb + 3 * (size_t)other);
    if (cost < to->cost) {
        to->cost = cost;
        to->from = way->from;
    }
}

/* Sweeps from the top left, or back from the bottom right. */
static void sweep(const refiner *f, int32_t step)
{
    const window *w = &f->all;
    const int32_t wide = w->x1 - w->x0 + 1, count = wide * (w->y1 - w->y0 + 1);
    for (int32_t i = 0; i < count; ++i) {
        const int32_t k = step > 0 ? i : count - 1 - i, x = w->x0 + k % wide, y = w->y0 + k / wide,
                      at = y * f->cloud->camera.width + x;
        if (f->way[at].is_doubtful) {
            ask(f, at, x - step, y, 1.0f);
            ask(f, at, x, y - step, 1.0f);
            ask(f, at, x - step, y - step, 1.4142136f);
            ask(f, at, x + step, y - step, 1.4142136f);
        }
    }
}

/* The measured depth if it can belong to the chosen surface, else that surface. */
static float chosen(const refiner *f, int32_t x, int32_t y)
{
    const int32_t at = y * f->cloud->camera.width + x;
    const float own = f->cloud->inverse[at];
    if (f->way[at].from < 0) {
        return own;
    }
    const float q = said_of(f, x, y, f->way[at].from);
    return own > 0.0f && fabsf(own - q) < STEP * fmaxf(own, q) + 4.0f * lmb_cloud_sigma(f->cloud, own) ? own : q;
}

void mix_front_refine(float *out, mix_way *way, const lmb_cloud *cloud, const lmb_planes *planes, const float *rgb,
                      const int32_t box[4])
{
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    const window all = {box[0] > AROUND ? box[0] - AROUND : 0, box[1] > AROUND ? box[1] - AROUND : 0,
                        (box[2] + AROUND < w ? box[2] + AROUND : w) - 1,
                        (box[3] + AROUND < h ? box[3] + AROUND : h) - 1};
    const refiner f = {cloud, planes, rgb, way, all};
    memcpy(out, cloud->inverse, (size_t)w * (size_t)h * sizeof *out);
    for (int32_t y = all.y0; y <= all.y1; ++y) {
        for (int32_t x = all.x0; x <= all.x1; ++x) {
            begin(&f, x, y);
        }
    }
    for (int i = 0; i < SWEEPS; ++i) {
        sweep(&f, i % 2 == 0 ? 1 : -1);
    }
    for (int32_t y = box[1]; y < box[3]; ++y) {
        for (int32_t x = box[0]; x < box[2]; ++x) {
            if (way[y * w + x].is_doubtful) {
                out[y * w + x] = chosen(&f, x, y);
            }
        }
    }
}

/* --- by sample ---------------------------------------------------------------------------------------------------- */

static int is_before(float q, float object, const lmb_cloud *cloud)
{
    return q > 0.0f && q - 1.0f / object > 2.0f * lmb_cloud_sigma(cloud, q);
}

/* The surface in front of the object at a sample, by bilinear weights of the four pixels around. */
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
