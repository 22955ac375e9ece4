/* relight_stage.h: shared parts of the relight figures: a world, filters, errors and times. */
#ifndef RELIGHT_STAGE_H
#define RELIGHT_STAGE_H

#include <lambent/lambent.h>

#include "../../tools/picture/image.h"
#include "../test.h"

#define PI 3.14159265358979323846

enum { PLACES = 5, WIDTH = 128, HEIGHT = 64, SIDE = 8, TEXELS = 6 * SIDE * SIDE, MAX_SIDE = 32 };
enum { COSINE, SH_9, SH_16, SH_25, BLUR, BLUR_1, BLUR_2, FILTERS };

extern const char *const filter_names[FILTERS];
extern const lmb_vec3 relight_places[PLACES]; /* of truth/env_relight */

/* All memory for updates; large. Zero it before use. */
typedef struct relight_stage {
    const lmb_kernels *kernels;
    lmb_world world;
    lmb_probe_table table[3]; /* of the map, its half and its quarter, for blurs */
    lmb_probe_blur blur[3];
    lmb_probe_lights lights;
    float map[3 * WIDTH * HEIGHT], half[3 * WIDTH * HEIGHT / 4], blurred[3 * WIDTH * HEIGHT / 16], line[WIDTH];
    float harmonics[3][LMB_SH_25];
    float cube[3 * 6 * MAX_SIDE * MAX_SIDE]; /* planes */
    float *ground;
    void *world_memory, *table_memory[3], *blur_memory[3];
} relight_stage;

/* Makes tables and blurs. Exits if there is no memory. */
void relight_stage_make(relight_stage *out);
void relight_stage_free(relight_stage *s);

/* Replaces the world. */
void relight_set_world(relight_stage *inout, const lmb_world_pictures *pictures, int32_t format);

/* Takes truth/env_relight as seen from its centre, with its ground; or the surroundings of one of its places, as a
 * world around the origin. Returns 0 if a picture is missing. */
int relight_take_centre(relight_stage *inout);
int relight_take_place(relight_stage *inout, int place);

/* One object's update at `at`: irradiance of n x n x 6 normals into `cube`. relight_filter: the
 * same from the current map. */
void relight_update(relight_stage *inout, int filter, lmb_vec3 at, int32_t n);
void relight_filter(relight_stage *inout, int filter, int32_t n);

/* Samples a picture at u, v, bilinearly; clamps at the ends or wraps around the seam. */
void relight_read(float out[3], const image *picture, float u, float v, int wraps);

/* Error of a cube of planes against texels of RGB: RMSE relative to the mean; largest error and smallest value of the
 * cube, both relative to the largest texel. */
typedef struct relight_error {
    double rmse, largest, min;
} relight_error;

relight_error relight_compare(const float *cube, const float *truth, int texels);

/* Seconds of a call: the minimum of many samples. */
double relight_seconds(void (*work)(void *), void *context);

/* The parts; each prints a table or two. `counts`: a file with lines `FILTER INSTRUCTIONS`, or NULL. */
void relight_tell_filters(relight_stage *s, const char *counts);
void relight_tell_raster(relight_stage *s);
void relight_tell_maps(relight_stage *s);
void relight_tell_glossy(relight_stage *s);
void relight_tell_frames(relight_stage *s);

/* A map of ../shared/data/env as a picture and as a world's faces. */
typedef struct relight_sky {
    image picture;
    lmb_world_pictures pictures;
    float *face[6];
} relight_sky;

enum { SKIES = 5, TUNED = 3 }; /* the rest is held out */
extern const char *const sky_names[SKIES];

int relight_sky_load(relight_sky *out, int sky); /* 0 if it is missing */
void relight_sky_free(relight_sky *sky);

/* Direction of point (x, y) of a map of twice its height, a unit vector; texel edges are at whole numbers. sky_area:
 * solid angle of a texel in row y, sr. */
void sky_direction(double d[3], double x, double y, int height);
double sky_area(int y, int height);

#endif
