/* relief_withheld.h: a picture of a relief beside a photo that it was not made of, from the photo's place. */
#ifndef RELIEF_WITHHELD_H
#define RELIEF_WITHHELD_H

#include "relief_draw.h"
#include "relief_photos.h"

typedef struct withheld_figures {
    double db;           /* of reflectance, sRGB codes, over pixels that show a surface; 99: equal; -1: none do */
    double shown, filled; /* shares of the picture's pixels: with a surface; filled from the simple model because no
                             view shows them */
} withheld_figures;

/* withheld_measure: compares a frame with the photo of the same view and size. */
void withheld_measure(withheld_figures *out, const relief_frame *frame, const relief_photo *photo);

#endif
