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

#endif
