/* relief_compare.h: compares a picture of a relief with one of the complex model. */
#ifndef RELIEF_COMPARE_H
#define RELIEF_COMPARE_H

#include "relief_draw.h"

/* Percentiles are over pixels that both cover; -1 if there are none. */
typedef struct relief_figures {
    double silhouette_px;   /* median distance from a pixel on one outline to the other, both ways */
    double iou;             /* covered by both / by either */
    double lost, added;     /* covered only by the truth, only by the test / by the truth */
    double depth_50, depth_95; /* difference| / diagonal */
    double normal_50, normal_95; /* degrees */
    double psnr_db;         /* of light without cast shadows: sRGB codes, full scale 255 */
    double shadowed_db;     /* with cast shadows */
    double albedo_db;       /* of reflectance only */
    double lit;             /* share of pixels that are lit in both or shadowed in both */
    double isolated;        /* share of pixels that differ from all neighbours, unlike in the truth */
} relief_figures;

/* relief_squared: the squared difference of two colours, sRGB codes, summed over R G B. */
double relief_squared(const float *a, const float *b);

/* relief_isolated: is a pixel of `rgb` brighter or darker than all eight neighbours, by RELIEF_UNLIKE sRGB codes in
 * some channel? If only the picture has such a pixel there, not the truth, it is a speck. */
enum { RELIEF_UNLIKE = 24 };
int relief_isolated(const relief_frame *f, int32_t x, int32_t y);

/* relief_measure: compares two pictures of the same size, view and light. Returns 1, or 0 with `r` set if memory is
 * short. */
int relief_measure(relief_figures *out, const relief_frame *test, const relief_frame *truth, double diagonal,
                   report *r);

/* relief_tell: draws the complex model with the settings of `shot`, which drew `f`; prints speed and errors. */
int relief_tell(const relief_frame *f, relief_shot shot, const lmb_scene *complex, report *r);

#endif
