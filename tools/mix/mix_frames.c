/* mix_frames.c: what is kept from frame to frame of a sequence: depth that was measured, where the object stands, its
 * light. */
#include "mix_frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ALIKE    0.05 /* how far a photo's mean may be off the one that the answer was found for */

enum {
    TWICE = 2, /* frames that must differ before a static camera believes them */
    FEW = 500, /* of so many pixels one may measure something else before these are found anew */
    SOME = 20  /* and before all are */
};

/* --- depth -------------------------------------------------------------------------------------------------------- */

static float inverse_of(float depth) { return depth >= 0.01f && depth <= 1000.0f ? 1.0f / depth : 0.0f; }

static int is_same_view(const mix_kept *k, const mix_frame *f)
{
    return memcmp(&k->camera, &f->camera, sizeof f->camera) == 0 && memcmp(k->pose, f->pose, sizeof f->pose) == 0;
}

static int has_size(const mix_kept *k, const mix_frame *f)
{
    return k->inverse != NULL && k->camera.width == f->camera.width && k->camera.height == f->camera.height;
}

static int take_depth(mix_kept *k, const mix_frame *f, report *r)
{
    const size_t pixels = (size_t)f->camera.width * (size_t)f->camera.height;
    free(k->inverse);
    free(k->differs);
    free(k->fresh);
    k->inverse = calloc(pixels, sizeof *k->inverse);
    k->differs = calloc(pixels, 1);
    k->fresh = calloc(pixels, 1);
    if (k->inverse != NULL && k->differs != NULL && k->fresh != NULL) {
        return 1;
    }
    free(k->inverse);
    free(k->differs);
    free(k->fresh);
    k->inverse = NULL;
    k->differs = k->fresh = NULL;
    return report_fail(r, "out of memory");
}

/* What is known of one pixel that does not move: the first measure stays while others agree, or nothing is measured. */
static void keep_pixel(mix_kept *k, size_t i, float now)
{
    const float was = k->inverse[i];
    const int differs = was > 0.0f && now > 0.0f && !mix_agree(was, now);
    k->differs[i] = (uint8_t)(differs ? k->differs[i] + 1 : 0);
    if ((!(was > 0.0f) && now > 0.0f) || k->differs[i] >= TWICE) {
        k->changed += !k->fresh[i];
        k->fresh[i] = 1;
        k->inverse[i] = now;
        k->differs[i] = 0;
    }
}

/* A pose's point of the world, and back. Rows; x right, y down, z ahead. */
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

/* What is known, as another camera sees it: each pixel's point, the nearest one of those that fall on a pixel. */
static void move_depth(float *out, const mix_kept *k, const mix_frame *f)
{
    const lmb_pinhole *a = &k->camera, *b = &f->camera;
    for (int32_t i = 0; i < a->width * a->height; ++i) {
        const double q = (double)k->inverse[i];
        if (!(q > 0.0)) {
            continue;
        }
        const double p[3] = {((double)(i % a->width) - (double)a->cx) / (double)a->fx / q,
                             ((double)(i / a->width) - (double)a->cy) / (double)a->fy / q, 1.0 / q};
        double w[3], c[3];
        to_world(w, k->pose, p);
        to_camera(c, f->pose, w);
        const double x = (double)b->fx * c[0] / c[2] + (double)b->cx, y = (double)b->fy * c[1] / c[2] + (double)b->cy;
        if (c[2] > 0.01 && x > -0.5 && y > -0.5 && x < b->width - 0.5 && y < b->height - 0.5) {
            float *to = &out[(int32_t)(y + 0.5) * b->width + (int32_t)(x + 0.5)];
            *to = fmaxf(*to, (float)(1.0 / c[2]));
        }
    }
}

/* From another place what is measured now is believed, and the mean of both where they agree. */
static int merge_moved(mix_kept *k, const mix_frame *f, report *r)
{
    const size_t pixels = (size_t)f->camera.width * (size_t)f->camera.height;
    float *moved = calloc(pixels, sizeof *moved);
    if (moved == NULL) {
        return report_fail(r, "out of memory");
    }
    move_depth(moved, k, f);
    free(k->inverse);
    k->inverse = moved;
    memset(k->differs, 0, pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const float was = moved[i], now = inverse_of(f->depth[i]);
        moved[i] = !(now > 0.0f) ? was : was > 0.0f && mix_agree(was, now) ? 0.5f * (was + now) : now;
    }
    return 1;
}

int mix_keep_depth(mix_kept *k, mix_frame *f, report *r)
{
    const size_t pixels = (size_t)f->camera.width * (size_t)f->camera.height;
    if (!has_size(k, f)) {
        k->changed = pixels;
        if (!take_depth(k, f, r)) {
            return 0;
        }
        for (size_t i = 0; i < pixels; ++i) {
            k->inverse[i] = inverse_of(f->depth[i]);
        }
    } else if (is_same_view(k, f)) {
        for (size_t i = 0; i < pixels; ++i) {
            keep_pixel(k, i, inverse_of(f->depth[i]));
        }
    } else {
        k->changed = pixels;
        if (!merge_moved(k, f, r)) {
            return 0;
        }
    }
    k->camera = f->camera;
    k->has_pose = f->has_pose;
    memcpy(k->pose, f->pose, sizeof k->pose);
    for (size_t i = 0; i < pixels; ++i) {
        f->depth[i] = k->inverse[i] > 0.0f ? 1.0f / k->inverse[i] : 0.0f;
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

static int is_as_bright(const mix_kept *k, double bright) { return fabs(bright - k->bright) <= ALIKE * k->bright; }

int mix_is_still(mix_kept *k, double bright)
{
    k->is_other_light = k->frames > 0 && !is_as_bright(k, bright);
    const size_t pixels = (size_t)k->camera.width * (size_t)k->camera.height;
    return k->last != NULL && k->last->answer != NULL && FEW * k->changed < pixels && !k->is_other_light;
}

int mix_is_settled(const mix_kept *k)
{
    const size_t pixels = (size_t)k->camera.width * (size_t)k->camera.height;
    return k->last != NULL && k->last->answer != NULL && SOME * k->changed < pixels && !k->is_other_light;
}

/* --- the object and its light ------------------------------------------------------------------------------------- */

int mix_keep(mix_kept *k, mix_job *j, report *r)
{
    if (k->frames > 0) {
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
    free(k->inverse);
    free(k->differs);
    free(k->fresh);
    memset(k, 0, sizeof *k);
}
