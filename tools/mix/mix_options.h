/* mix_options.h: the command line of `lambent mix`. */
#ifndef MIX_OPTIONS_H
#define MIX_OPTIONS_H

#include "../common/options.h"
#include "../model/model.h"
#include "mix_frame.h"

enum { MIX_LIGHTS = 8, MIX_OBJECTS = 16 /* in one picture */ };

enum { MIX_FINAL = 0, MIX_DELTA, MIX_PLANES, MIX_VOXELS, MIX_ENV, MIX_OBJECT };

/* The object's position. */
enum { MIX_AT_CENTRE = 0, /* of the plane that it would stand on */
       MIX_AT_PIXEL, MIX_AT_WORLD /* as in the file, in the world of the frame's pose */ };

/* The up direction. */
enum { MIX_UP_FOUND = 0, /* by the pose if planes agree with it, or by the planes */
       MIX_UP_CAMERA, MIX_UP_POSE, MIX_UP_GIVEN };

/* The kind of plane under or behind it if no place is given. */
enum { MIX_ON_ANY = 0, MIX_ON_FLOOR, MIX_ON_TABLE, MIX_ON_WALL };

typedef struct mix_at {
    int32_t at; /* MIX_AT_* */
    float px[2];
} mix_at;

typedef struct mix_options {
    mix_source source;
    const char *frames; /* a list instead of `source`'s files */
    const char *placements; /* a list of pictures instead of `object` and `out` */
    int match_grain;
    const char *object, *world, *out, *stats, *labels;
    const char *object_of[MIX_OBJECTS]; /* by object; `object` and the members below hold those of the first */
    mix_at at_of[MIX_OBJECTS];
    float scale_of[MIX_OBJECTS], turn_of[MIX_OBJECTS];
    int32_t objects, ats, scales, turns; /* numbers of these */
    model_choice choice; /* choices for the files of the objects */
    float scale;      /* m per unit of the mesh; 0: 1, or chosen if `fit` */
    int fit;
    int32_t on;       /* MIX_ON_* */
    float turn_deg;
    int32_t at;
    float at_px[2];
    lmb_light lights[MIX_LIGHTS];
    float light_size[MIX_LIGHTS]; /* m, of a sun degrees; 0: none */
    int32_t light_count;
    int no_light;     /* no sun is guessed */
    int32_t up;       /* MIX_UP_* */
    float up_to[3];   /* in the world of the pose, or the camera's */
    int32_t show, shadow_map, depth; /* depth: of the voxels */
    int32_t cones;    /* 7, 19 or 37 */
    int32_t samples;  /* per pixel; 0: by the output's format */
    float roughness;  /* roughness and reflectance of the plane's varnish */
    float specular;   /* 0: none */
    float exposure_ev;
    int is_quiet, is_verbose; /* quiet: print only errors; verbose: also print the time of each stage */
    const lmb_kernels *kernels;
    int32_t threads; /* 0: as many as there are processors */
} mix_options;

extern const option_table mix_table;

/* See options_parse. */
int mix_options_parse(mix_options *out, int argc, char **argv, report *r);

#endif
