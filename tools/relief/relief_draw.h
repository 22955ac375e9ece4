/* relief_draw.h: pictures of a relief, of ordinary geometry, and of both together. */
#ifndef RELIEF_DRAW_H
#define RELIEF_DRAW_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* What to draw, and how. */
typedef struct relief_shot {
    const lmb_kernels *kernels;
    lmb_view view;
    const lmb_relief *relief; /* NULL: none */
    const lmb_scene *scene;   /* ordinary geometry; NULL: none */
    lmb_relief_how how;
    const lmb_light *light;   /* NULL: only what the surfaces are */
    int32_t shadow_map;        /* texels a side; 0: no shadow */
    float ambient;            /* irradiance from everywhere, W/m2 */
    int threads;              /* that draw the picture at once; 0: one */
    int32_t bounce;           /* texels a side of the map that the light bounces from, a power of two; 0: it does not */
    int32_t samples;          /* a pixel, of `rgb`: their mean; 1, 4, 8 or 16, or 0: one */
} relief_shot;

/* Planes of width x height pixels, rows from the top; by several samples a pixel all but `rgb` are of the last of them.
 * relief_frame_free releases them. */
typedef struct relief_frame {
    int32_t width, height;
    float *depth;                  /* m along the view's axis; 0: nothing */
    float *normal, *albedo, *rgb;  /* 3 floats a pixel; rgb: radiance */
    float *open;                   /* radiance if nothing cast a shadow */
    uint8_t *lit;                  /* 1: some of the light arrives */
    lmb_relief_stats stats;
    double light_s, draw_s, band_s; /* of all samples; processor time: the shadow map; triangles; attributes and light */
    size_t bytes;                   /* memory while it was drawn, without models */
} relief_frame;

/* relief_shoot: 1, or 0 with `r` set and nothing allocated. */
int relief_shoot(relief_frame *out, const relief_shot *shot, report *r);
void relief_frame_free(relief_frame *f);

#endif
