/* render_options.h: what `lambent render` was asked for. */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include <lambent/lambent.h>

#include "report.h"

#define RENDER_LIGHTS 64 /* --light given at most this often */

/* --show beyond LMB_SHOW_*: attributes, not light. */
enum { SHOW_DEPTH = 16, SHOW_NORMAL, SHOW_ALBEDO };

typedef struct render_options {
    const char *scene, *out, *stats;
    int32_t width, height; /* 0: default */
    const char *scene_name; /* of a file with several; NULL: its own choice */
    const char *camera;     /* name or number; NULL: the first */
    int has_eye, has_target, has_fov;
    lmb_vec3 eye, target, up;
    float fov_deg;
    lmb_light lights[RENDER_LIGHTS];
    uint32_t light_count;
    int32_t show;
    int32_t light_map; /* 0: chosen */
    lmb_grouping grouping;
    float error, visible; /* 0: default */
    int32_t occlusion, steps;
    int32_t exposure_auto;
    float exposure_ev;
    const lmb_kernels *kernels;
    int32_t threads; /* 0: as many as there are processors */
    int help;
} render_options;

extern const char render_usage[];

/* 1, or 0 with `r` set: bad usage. */
int render_options_parse(render_options *out, int argc, char **argv, report *r);

#endif
