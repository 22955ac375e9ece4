/* mix_frames.c: the state kept from frame to frame of a sequence: measured depth, place and light of the object. */
#include "mix_frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ALIKE    0.05 /* maximum relative change of a photo's mean for which a result is reused */

enum {
    TWICE = 2, /* frames that must differ before a static camera accepts a change */
    FEW = 500, /* if under one pixel in FEW is new, the last result is reused */
    SOME = 20  /* if at least one in SOME is new, all pixels are redrawn */
};

/* --- depth -------------------------------------------------------------------------------------------------------- */

static float inverse_of(float depth) { return depth >= 0.01f && depth <= 1000.0f ? 1.0f / depth : 0.0f; }

static int is_same_view(const mix_depth *d, const mix_frame *f)
{
    return memcmp(&d->camera, &f->camera, sizeof f->camera) == 0 && memcmp(d->pose, f->pose, sizeof f->pose) == 0;
}

static int has_size(const mix_depth *d, const mix_frame *f)
{
    return d->inverse != NULL && d->camera.width == f->camera.width && d->camera.height == f->camera.height;
}

void mix_depth_free(mix_depth *d)
{
    free(d->inverse);
    free(d->differs);
    free(d->fresh);
    memset(d, 0, sizeof *d);
}

static size_t pixels_of(const mix_depth *d) { return (size_t)d->camera.width * (size_t)d->camera.height; }

/* Sets all values to 0, for a camera. */
static int take_depth(mix_depth *d, const lmb_pinhole *camera, report *r)
{
    memset(d, 0, sizeof *d);
    d->camera = *camera;
    d->inverse = calloc(pixels_of(d), sizeof *d->inverse);
    d->differs = calloc(pixels_of(d), 1);
    d->fresh = calloc(pixels_of(d), 1);
    if (d->inverse == NULL || d->differs == NULL || d->fresh == NULL) {
        mix_depth_free(d);
        return report_fail(r, "out of memory");
    }
    return 1;
}

int mix_depth_copy(mix_depth *out, const mix_depth *in, report *r)
{
    memset(out, 0, sizeof *out);
    if (in->inverse == NULL) {
        return 1;
    }
    if (!take_depth(out, &in->camera, r)) {
        return 0;
    }
    memcpy(out->inverse, in->inverse, pixels_of(in) * sizeof *in->inverse);
    memcpy(out->differs, in->differs, pixels_of(in));
    memcpy(out->fresh, in->fresh, pixels_of(in));
    out->has_pose = in->has_pose;
    memcpy(out->pose, in->pose, sizeof in->pose);
    out->changed = in->changed;
    return 1;
}

/* Updates one pixel of a static camera. The first measurement stays while later ones agree or nothing is measured. */
static void keep_pixel(mix_depth *d, size_t i, float now)
{
    const float was = d->inverse[i];
    const int differs = was > 0.0f && now > 0.0f && !mix_agree(was, now);
    d->differs[i] = (uint8_t)(differs ? d->differs[i] + 1 : 0);
    if ((!(was > 0.0f) && now > 0.0f) || d->differs[i] >= TWICE) {
        d->changed += !d->fresh[i];
        d->fresh[i] = 1;
        d->inverse[i] = now;
        d->differs[i] = 0;
    }
}

/* to_world moves a point from a pose's camera space to the world, to_camera back. Poses are stored by rows; x right, y
 * down, z ahead. */
static void to_world(double out[3], const double pose[16], const double p[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = pose[4 * i] * p[0] + pose[4 * i + 1] * p[1] + pose[4 * i + 2] * p[2] + pose[4 * i + 3];
    }
}

static void to_camera(double out[3], const double pose[16], const double p[3])
{
    const double d[3] = {p[0] - pose[3], p[1] - pose[7], p[2] - pose[11]};
    for (int i = 0; i < 3; ++i) {
        out[i] = pose[i] * d[0] + pose[4 + i] * d[1] + pose[8 + i] * d[2];
    }
}

/* Projects the known depth into another camera. If several points fall on a pixel, the nearest one is kept. */
static void move_depth(float *out, const mix_depth *d, const mix_frame *f)
{
    const lmb_pinhole *a = &d->camera, *b = &f->camera;
    for (int32_t i = 0; i < a->width * a->height; ++i) {
        const double q = (double)d->inverse[i];
        if (!(q > 0.0)) {
            continue;
        }
        const double p[3] = {((double)(i % a->width) - (double)a->cx) / (double)a->fx / q,
                             ((double)(i / a->width) - (double)a->cy) / (double)a->fy / q, 1.0 / q};
        double w[3], c[3];
        to_world(w, d->pose, p);
        to_camera(c, f->pose, w);
        const double x = (double)b->fx * c[0] / c[2] + (double)b->cx, y = (double)b->fy * c[1] / c[2] + (double)b->cy;
        if (c[2] > 0.01 && x > -0.5 && y > -0.5 && x < b->width - 0.5 && y < b->height - 0.5) {
            float *to = &out[(int32_t)(y + 0.5) * b->width + (int32_t)(x + 0.5)];
            *to = fmaxf(*to, (float)(1.0 / c[2]));
        }
    }
}

/* If the camera has moved, a new measurement replaces the old one, or is averaged with it if both agree. */
static int merge_moved(mix_depth *d, const mix_frame *f, report *r)
{
    const size_t pixels = (size_t)f->camera.width * (size_t)f->camera.height;
    float *moved = calloc(pixels, sizeof *moved);
    if (moved == NULL) {
        return report_fail(r, "out of memory");
    }
    move_depth(moved, d, f);
    free(d->inverse);
    d->inverse = moved;
    memset(d->differs, 0, pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const float was = moved[i], now = inverse_of(f->depth[i]);
        moved[i] = !(now > 0.0f) ? was : was > 0.0f && mix_agree(was, now) ? 0.5f * (was + now) : now;
    }
    return 1;
}

int mix_keep_depth(mix_depth *d, mix_frame *f, report *r)
{
    const size_t pixels = (size_t)f->camera.width * (size_t)f->camera.height;
    if (!has_size(d, f)) {
        mix_depth_free(d);
        if (!take_depth(d, &f->camera, r)) {
            return 0;
        }
        d->changed = pixels;
        for (size_t i = 0; i < pixels; ++i) {
            d->inverse[i] = inverse_of(f->depth[i]);
        }
    } else if (is_same_view(d, f)) {
        for (size_t i = 0; i < pixels; ++i) {
            keep_pixel(d, i, inverse_of(f->depth[i]));
        }
    } else {
        d->changed = pixels;
        if (!merge_moved(d, f, r)) {
            return 0;
        }
    }
    d->camera = f->camera;
    d->has_pose = f->has_pose;
    memcpy(d->pose, f->pose, sizeof d->pose);
    for (size_t i = 0; i < pixels; ++i) {
        f->depth[i] = d->inverse[i] > 0.0f ? 1.0f / d->inverse[i] : 0.0f;
    }
    return 1;
}

double mix_brightness(const mix_frame *f)
{
    const size_t count = 3 * (size_t)f->light.width * (size_t)f->light.height;
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
        sum += (double)f->light.pixels[i];
    }
    return sum / (double)count;
}

void mix_depth_seen(mix_depth *d)
{
    d->changed = 0;
    memset(d->fresh, 0, pixels_of(d));
}

int mix_is_little_new(const mix_depth *d) { return FEW * d->changed < pixels_of(d); }

static int is_as_bright(const mix_kept *k, double bright) { return fabs(bright - k->bright) <= ALIKE * k->bright; }

int mix_is_still(mix_kept *k, double bright)
{
    k->is_other_light = k->frames > 0 && !is_as_bright(k, bright);
    return k->last != NULL && k->last->answer != NULL && mix_is_little_new(&k->depth) && !k->is_other_light;
}

int mix_is_settled(const mix_kept *k)
{
    const size_t pixels = pixels_of(&k->depth);
    return k->last != NULL && k->last->answer != NULL && SOME * k->depth.changed < pixels && !k->is_other_light;
}

/* --- the object and the light ------------------------------------------------------------------------------------- */

int mix_keep(mix_kept *k, mix_job *j, report *r)
{
    if (k->frames > 0) {
        mix_keep_planes(k, j);
        ++k->frames;
        return 1;
    }
    if (!mix_keep_light(k, j, r)) {
        free(k->env_memory);
        k->env_memory = NULL;
        return 0;
    }
    k->object = j->object;
    mix_keep_place(k, j);
    mix_keep_planes(k, j);
    ++k->frames;
    return 1;
}

void mix_kept_free(mix_kept *k)
{
    if (k->world != NULL && k->world != k->last) {
        mix_job_free(k->world);
    }
    if (k->last != NULL) {
        mix_job_free(k->last);
    }
    model_free(&k->object);
    free(k->env_memory);
    mix_depth_free(&k->depth);
    memset(k, 0, sizeof *k);
}
