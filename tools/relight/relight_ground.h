/* relight_ground.h: the share of the ground's light left around an object. */
#ifndef RELIGHT_GROUND_H
#define RELIGHT_GROUND_H

#include "relight_region.h"

typedef struct ground_map {
    float x, z, per_x, per_z; /* corner, m, and texels per metre */
    float left[HIDDEN_SIDE * HIDDEN_SIDE][3];
    float shut[HIDDEN_SIDE * HIDDEN_SIDE]; /* cosine-weighted solid angle that the object blocks */
} ground_map;

/* Maps around one figure, with finer texels close to it. */
typedef struct contact_ground {
    ground_map map[HIDDEN_MAPS];
} contact_ground;

/* Runs of one figure's peaks in one map. */
typedef struct peak_runs {
    hidden_runs runs;
    uint32_t first[LMB_PROBE_PEAKS + 1];
} peak_runs;

/* ground_throw: computes the shadows of the peaks. Returns 1, or 0 if memory is short. */
int ground_throw(peak_runs *inout, int map, hidden *h, const far_lights *lights, const relight_options *o);

/* ground_shade: computes a map from the lights at the figure and the radiance of the regions. */
void ground_shade(ground_map *out, const hidden_map *map, const peak_runs *peaks, lmb_vec3 foot,
                  const far_lights *lights, float (*reflected)[3]);

/* ground_light: the unoccluded irradiance of the ground, W/m2, by lights that cast shadows on it. */
void ground_light(float out[3], const far_lights *lights);

/* ground_left: multiplies by the share of light that this figure leaves at a place, from the first `maps` maps:
 * bilinear, 1 outside. */
void ground_left(float inout[3], const contact_ground *g, int maps, float x, float z);

#endif
