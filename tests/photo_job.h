/* photo_job.h: a job of `lambent mix` by a command line, with room for a photo and its depth. */
#ifndef PHOTO_JOB_H
#define PHOTO_JOB_H

#include <stdlib.h>

#include "../tools/mix/mix_job.h"
#include "test.h"

/* mix_job_free releases it. */
static inline mix_job *photo_job(int argc, char **argv, const lmb_pinhole *camera)
{
    const size_t pixels = (size_t)camera->width * (size_t)camera->height;
    report r = {""};
    mix_job *j = calloc(1, sizeof *j);
    if (j == NULL) {
        abort();
    }
    CHECK_MSG(mix_options_parse(&j->o, argc, argv, &r), "%s", r.text);
    j->frame.camera = *camera;
    j->frame.light.width = camera->width;
    j->frame.light.height = camera->height;
    j->frame.light.channels = 3;
    j->frame.light.pixels = malloc(3 * pixels * sizeof(float));
    j->frame.depth = malloc(pixels * sizeof(float));
    if (j->frame.light.pixels == NULL || j->frame.depth == NULL) {
        abort();
    }
    return j;
}

/* The picture of a job whose object has its place, all of the object of that material. */
static inline void photo_draw(mix_job *j, const lmb_material *look)
{
    report r = {""};
    for (uint32_t i = 1; i < j->scene.material_count; ++i) {
        ((lmb_material *)(uintptr_t)j->scene.materials)[i] = *look;
    }
    CHECK_MSG(mix_light(j, &r) && mix_voxels(j, &r) && mix_draw(j, &r), "%s", r.text);
}

/* The picture's mean green over pixels x0 .. x1 - 1 of rows y0 .. y1 - 1. */
static inline float photo_mean(const mix_job *j, int x0, int y0, int x1, int y1)
{
    float sum = 0.0f;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            sum += j->picture.pixels[3 * (y * j->frame.camera.width + x) + 1] / (float)((x1 - x0) * (y1 - y0));
        }
    }
    return sum;
}

#endif
