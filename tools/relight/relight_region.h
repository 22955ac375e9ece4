/* relight_region.h: an object as a few regions: what each sees of the world and of the object, and what it reflects. */
#ifndef RELIGHT_REGION_H
#define RELIGHT_REGION_H

#include "relight_hidden.h"

enum { REGIONS = 256 };

/* The world's light at a place from one direction: W/m2 across it; and the radiance of the object's own surfaces that the
 * object sees there, in the mean. */
typedef struct far_light {
    lmb_vec3 to;
    float rgb[3], back[3];
} far_light;

/* The reduced cube's, then its peaks. */
typedef struct far_lights {
    far_light light[LMB_PROBE_TEXELS + LMB_PROBE_PEAKS];
    float angle[LMB_PROBE_TEXELS]; /* sr */
    int32_t count;
} far_lights;

/* Triangles of one part that face about the same way. By direction: the mean of their cosines, where the world is seen,
 * and where the object itself is. */
typedef struct region {
    float open[LMB_PROBE_TEXELS], shut[LMB_PROBE_TEXELS];
    float albedo[3]; /* the mean */
    float area;      /* m2; 0: none are */
    lmb_vec3 middle; /* from the object's foot */
} region;

/* Zeroed: none. regions_free releases them. */
typedef struct regions {
    region *region;
    uint32_t count;
    uint8_t *of;                         /* by triangle of the object */
    uint16_t opposite[LMB_PROBE_TEXELS]; /* directions */
    float per_seen[LMB_PROBE_TEXELS];    /* 1 / m2 across each direction that is shut; 0: none is */
} regions;

/* regions_make: of what hides from itself as `h` knows, a triangle's reflectance by the texel that covers it and its
 * corners' colours. 1, or 0: out of memory. */
int regions_make(regions *out, const hidden *h, const float *directions);

/* What is left of the ground's light that comes along `to` to a place from the figure's foot. */
typedef void region_ground(float left[3], const void *user, lmb_vec3 at, lmb_vec3 to);

/* regions_light: the radiance of each region by the lights and by the others, and the lights' `back`. `ground` NULL: all
 * of its light is there. */
void regions_light(float out[REGIONS][3], far_lights *inout, const regions *p, const uint16_t *fold, region_ground *ground,
                   const void *user);

/* region_directions: the four directions of the reduced cube that are nearest to `d`, and their weights: probe.h. */
void region_directions(uint16_t at[4], float weight[4], const uint16_t *fold, lmb_vec3 d);

void regions_free(regions *p);

#endif
