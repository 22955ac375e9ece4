/* relight_options.h: the command line of `lambent relight`. */
#ifndef RELIGHT_OPTIONS_H
#define RELIGHT_OPTIONS_H

#include <lambent/lambent.h>

#include "../common/report.h"
#include "../common/view_options.h"
#include "../model/model.h"
#include "../picture/image.h"

enum { RELIGHT_WIDTH = 128, RELIGHT_HEIGHT = 64, RELIGHT_MAX_FACES = 64 };
/* Maximum number of --at and of --keep, of --light, of --world, of --object. */
enum { RELIGHT_PLACES = 32, RELIGHT_LIGHTS = 16, RELIGHT_WORLDS = 8, RELIGHT_OBJECTS = 16 };

enum { FILTER_COSINE, FILTER_SH9, FILTER_SH16, FILTER_SH25, FILTER_BLUR, FILTER_BLUR1, FILTER_BLUR2, FILTERS };
extern const char *const relight_filters[FILTERS + 1];

enum { FLOOR_AUTO, FLOOR_ON, FLOOR_NONE };

typedef struct relight_options {
    /* the world */
    const char *world[RELIGHT_WORLDS], *ground;
    lmb_vec3 centre[RELIGHT_WORLDS];
    int32_t worlds, centres, world_every; /* world_every: pictures per file of a numbered --world */
    lmb_world_pictures place; /* everything except the pictures; of the first world */
    float ground_size[2], ground_centre[2];
    int32_t format, blend;
    int32_t has_far, has_ground_centre;
    int32_t floor; /* FLOOR_ */
    /* the objects */
    model_choice choice; /* choices for the file of the object */
    const char *object, *path; /* object: the first one */
    const char *object_of[RELIGHT_OBJECTS];
    int32_t objects, scales;
    float scale_of[RELIGHT_OBJECTS]; /* m, of the longest side; 0: as in the file. One value: for all objects */
    lmb_vec3 at[RELIGHT_PLACES], keep[RELIGHT_PLACES];
    int32_t at_count, keep_count;
    float roughness, f0; /* < 0: as in the materials */
    int per_part, contact, no_contact;
    lmb_light lights[RELIGHT_LIGHTS];
    int32_t light_count;
    lmb_probe_policy policy;
    /* methods and output */
    int32_t filter, faces, show;
    view_options view;
    const char *out, *cube, *map, *vectors_out, *vectors_in, *lobes, *harmonics, *dfg;
    int32_t map_height, side;
    float azimuth;     /* degrees: the longitude of the map's left edge */
    image *into;       /* receives the picture in place of the file `out`; release it. NULL: none */
    float stereo_m;    /* between the eyes; 0: one eye */
    int32_t samples;   /* per pixel; 0: by the output's format */
    int32_t tone;      /* PICTURE_ */
    float exposure_ev; /* NaN: chosen by the picture */
    const lmb_kernels *kernels;
    int32_t threads; /* 0: as many as there are processors */
} relight_options;

extern const option_table relight_table;

/* Parses X,Y,Z within 1,000,000 m. Returns 1, or 0 if the text is invalid. */
int relight_place(const char *text, lmb_vec3 *out);

/* Do the numbers of worlds and centres match, and is a numbered world possible here? Returns 1, or 0 with `r` set. */
int relight_worlds_check(const relight_options *o, report *r);

/* relight_has_ground: does the world have a ground: a ground picture or a floor? */
int relight_has_ground(const relight_options *o);

/* See options_parse. */
int relight_options_parse(relight_options *out, int argc, char **argv, report *r);

#endif
