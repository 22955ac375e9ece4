/* grey.h: shows numbers that are not light as greys in display formats: in place, as linear light in 0 .. 1. */
#ifndef GREY_H
#define GREY_H

#include "image.h"

/* One channel. 0 means no value and stays black.
 *
 *   grey_depths    white at the eye, in equal steps of light
 *   grey_distances white at the nearest, in equal steps of grey, and returns the range; farthest 0: no value at all
 *   grey_shares    0 .. 1 in equal steps of grey */
void grey_depths(image *p);
void grey_distances(image *p, float *nearest_m, float *farthest_m);
void grey_shares(image *p);

/* grey_normals: three channels of -1 .. 1; 0 is middle grey. */
void grey_normals(image *p);

/* image_widen: one channel becomes three. 1, or 0 with `r` set. */
int image_widen(image *p, report *r);

#endif
