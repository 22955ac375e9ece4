/* mix_options.h: the command line of `lambent mix`. */
#ifndef MIX_OPTIONS_H
#define MIX_OPTIONS_H

#include "../common/options.h"
#include "../model/model.h"
#include "mix_frame.h"

enum { MIX_LIGHTS = 8 };

enum { MIX_FINAL = 0, MIX_DELTA, MIX_PLANES, MIX_VOXELS, MIX_ENV, MIX_OBJECT };

/* Where the object stands. */
enum { MIX_AT_CENTRE = 0, /* of the plane that it would stand on */
       MIX_AT_PIXEL, MIX_AT_WORLD /* as its file has it, in the world of the frame's pose */ };

/* What is up. */
enum { MIX_UP_FOUND = 0, /* by the pose where planes agree with that, or by the planes */
       MIX_UP_CAMERA, MIX_UP_POSE, MIX_UP_GIVEN };

/* Which plane it stands on, or hangs on, where no place is given. */
enum { MIX_ON_ANY = 0, MIX_ON_FLOOR, MIX_ON_TABLE, MIX_ON_WALL };

typedef struct mix_options {
    mix_source source;
    const char *frames; /* a list instead of `source`'s files */
    const char *object, *world, *out, *stats, *labels;
    model_choice choice; /* choices for the file of the object */
    float scale;      /* m of a unit of the mesh; 0: 1, or with `fit` chosen */
    int fit;
    int32_t on;       /* MIX_ON_* */
    float turn_deg;
    int32_t at;
    float at_px[2];
    lmb_light lights[MIX_LIGHTS];
    float light_size[MIX_LIGHTS]; /* m, of a sun degrees; 0: none */
    int32_t light_count;
    int no_light;     /* none is guessed */
    int32_t up;       /* MIX_UP_* */
    float up_to[3];   /* in the world of the pose, or the camera's */
    int32_t show, shadow_map, depth; /* depth: of the voxels */
    int32_t cones;    /* 7, 19 or 37 */
    int32_t samples;  /* a pixel; 0: by the output's format */
    float roughness;  /* of the plane's varnish, and its reflectance */
    float specular;   /* 0: there is none */
    float exposure_ev;
    int is_quiet, is_verbose; /* nothing but errors is said; also how long each stage took */
    const lmb_kernels *kernels;
    int32_t threads; /* 0: as many as there are processors */
} mix_options;

extern const option_table mix_table;

/* As options_parse. */
int mix_options_parse(mix_options *out, int argc, char **argv, report *r);

#endif
