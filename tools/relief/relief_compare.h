/* relief_compare.h: how far a picture of a relief is from one of the complex model. */
#ifndef RELIEF_COMPARE_H
#define RELIEF_COMPARE_H

#include "relief_draw.h"

/* Percentiles are over pixels that both cover; -1 where there is none. */
typedef struct relief_figures {
    double silhouette_px;   /* median distance from a pixel on one's outline to the other's, both ways */
    double iou;             /* covered by both / by either */
    double lost, added;     /* covered by the truth alone, by the test alone / by the truth */
    double depth_50, depth_95; /* |difference| / diagonal */
    double normal_50, normal_95; /* degrees */
    double psnr_db;         /* of light without cast shadows: sRGB codes, full scale 255 */
    double shadowed_db;     /* with them */
    double albedo_db;       /* of reflectance alone */
    double lit;             /* share of them whose light or shadow is the same */
    double isolated;        /* share of pixels that stand out from all around them, and not in the truth */
} relief_figures;

/* relief_squared: the squared difference of two colours, sRGB codes, summed over R G B. */
double relief_squared(const float *a, const float *b);

/* relief_isolated: is a pixel of `rgb` brighter or darker than all eight around it, by RELIEF_UNLIKE sRGB codes in some
 * colour? A picture that has such a pixel where the truth has none shows a speck. */
enum { RELIEF_UNLIKE = 24 };
int relief_isolated(const relief_frame *f, int32_t x, int32_t y);

/* relief_measure: both of one size, one view, one light. 1, or 0 with `r` set (memory). */
int relief_measure(relief_figures *out, const relief_frame *test, const relief_frame *truth, double diagonal,
                   report *r);

/* relief_tell: draws the complex model as `shot` drew its relief's picture `f`; prints speed and errors. */
int relief_tell(const relief_frame *f, relief_shot shot, const lmb_scene *complex, report *r);

#endif
