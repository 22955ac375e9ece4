/* relief_draw.h: pictures of a relief, of ordinary geometry, and of both together. */
#ifndef RELIEF_DRAW_H
#define RELIEF_DRAW_H

#include <lambent/lambent.h>

#include "../common/report.h"

struct relief_sky; /* relief_sky.h */
struct relief_crowd; /* relief_crowd.h */

/* The contents and settings of a picture. */
typedef struct relief_shot {
    const lmb_kernels *kernels;
    lmb_view view;
    const lmb_relief *relief; /* NULL: none */
    const struct relief_crowd *crowd; /* placements, instead of `relief`; NULL: none */
    const lmb_scene *scene;   /* ordinary geometry; NULL: none */
    lmb_relief_how how;
    const lmb_light *light;   /* NULL: without `sky` only surface attributes */
    const struct relief_sky *sky; /* NULL: none */
    int shows_sky;            /* 1: behind all surfaces */
    int32_t shadow_map;        /* texels per side; 0: no shadow */
    float ambient;            /* irradiance from everywhere, W/m2 */
    int threads;              /* that draw the picture; 0: one */
    int32_t bounce;           /* texels per side of the map for bounced light, a power of two; 0: no bounced light */
    int32_t samples;          /* per pixel, of `rgb`: the mean; 1, 4, 8 or 16, or 0: one */
} relief_shot;

/* Planes of width x height pixels, rows from the top. With several samples per pixel, all planes but `rgb` hold the
 * last one. Release it with relief_frame_free. */
typedef struct relief_frame {
    int32_t width, height;
    float *depth;                  /* m along the view's axis; 0: nothing */
    float *normal, *albedo, *rgb;  /* 3 floats per pixel; rgb: radiance */
    float *open;                   /* radiance without shadows */
    float *cover;                  /* share of the samples with a surface */
    uint8_t *lit;                  /* 1: some direct light arrives */
    lmb_relief_stats stats;
    int32_t map_side;              /* texels per side of the shadow map, of the relief's if there is one; 0: none */
    double light_s, draw_s, band_s; /* processor time of all samples: the shadow map; triangles; attributes and light */
    size_t bytes;                   /* memory used to draw it, without models */
} relief_frame;

/* relief_shoot: draws a picture. Returns 1, or 0 with `r` set and nothing allocated. */
int relief_shoot(relief_frame *out, const relief_shot *shot, report *r);
void relief_frame_free(relief_frame *f);

#endif
