/* relight_ground.h: what is left of the ground's light around an object. */
#ifndef RELIGHT_GROUND_H
#define RELIGHT_GROUND_H

#include "relight_region.h"

typedef struct ground_map {
    float x, z, per_x, per_z; /* its corner, m, and texels a metre */
    float left[HIDDEN_SIDE * HIDDEN_SIDE][3];
} ground_map;

/* Around one figure: what is near in finer texels. */
typedef struct contact_ground {
    ground_map map[HIDDEN_MAPS];
} contact_ground;

/* Runs of one figure's peaks in one map. */
typedef struct peak_runs {
    hidden_runs runs;
    uint32_t first[LMB_PROBE_PEAKS + 1];
} peak_runs;

/* ground_throw: the shadows of the peaks among the lights. 1, or 0: out of memory. */
int ground_throw(peak_runs *inout, int map, hidden *h, const far_lights *lights, const relight_options *o);

/* ground_shade: a map by the lights where the figure stands and the radiance of its regions. */
void ground_shade(ground_map *out, const hidden_map *map, const peak_runs *peaks, lmb_vec3 foot, const far_lights *lights,
                  float (*reflected)[3]);

/* ground_light: W/m2 that the ground receives where nothing stands, by lights that throw shadows on it. */
void ground_light(float out[3], const far_lights *lights);

/* ground_left: times what is left of the ground's light at a place by this figure, by so many of its maps:
 * bilinear, 1 beside them. */
void ground_left(float inout[3], const contact_ground *g, int maps, float x, float z);

#endif
