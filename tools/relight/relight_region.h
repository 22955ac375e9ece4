/* relight_region.h: an object as a few regions: the visibility of each, and the light it reflects. */
#ifndef RELIGHT_REGION_H
#define RELIGHT_REGION_H

#include "relight_hidden.h"

enum { REGIONS = 256 };

/* The world's light at a place from one direction: rgb, W/m2 perpendicular to the direction; back, mean radiance of the
 * object's surfaces that the object sees there. */
typedef struct far_light {
    lmb_vec3 to;
    float rgb[3], back[3];
} far_light;

/* The reduced cube's directions, then the peaks. */
typedef struct far_lights {
    far_light light[LMB_PROBE_TEXELS + LMB_PROBE_PEAKS];
    float angle[LMB_PROBE_TEXELS]; /* sr */
    int32_t count;
} far_lights;

/* Triangles of one part with similar normals. By direction, the mean cosine: open, towards the world; shut, towards the
 * object itself. */
typedef struct region {
    float open[LMB_PROBE_TEXELS], shut[LMB_PROBE_TEXELS];
    float albedo[3]; /* the mean */
    float area;      /* m2; 0: empty */
    lmb_vec3 middle; /* relative to the object's foot */
} region;

/* Zeroed: empty. Release it with regions_free. */
typedef struct regions {
    region *region;
    uint32_t count;
    uint8_t *of;                         /* by triangle of the object */
    uint16_t opposite[LMB_PROBE_TEXELS]; /* directions */
    float per_seen[LMB_PROBE_TEXELS];    /* 1 / m2 perpendicular to each blocked direction; 0: none is blocked */
} regions;

/* regions_make: builds the regions from the self-occlusion in `h`. The reflectance of a triangle comes from one texel
 * of about the same size and the colours of the corners. Returns 1, or 0 if memory is short. */
int regions_make(regions *out, const hidden *h, const float *directions);

/* The share left of the ground's light that comes along `to` to a place relative to the figure's foot. */
typedef void region_ground(float left[3], const void *user, lmb_vec3 at, lmb_vec3 to);

/* regions_light: computes the radiance of each region by the lights and the other regions, and sets the lights' `back`.
 * If you pass NULL as `ground`, light from the ground is not reduced. */
void regions_light(float out[REGIONS][3], far_lights *inout, const regions *p, const uint16_t *fold,
                   region_ground *ground, const void *user);

/* region_directions: the four directions of the reduced cube nearest to `d`, and their weights: probe.h. */
void region_directions(uint16_t at[4], float weight[4], const uint16_t *fold, lmb_vec3 d);

void regions_free(regions *p);

#endif
