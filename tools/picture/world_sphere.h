/* world_sphere.h: a picture of the whole sphere -> the faces of a cube; small lamps keep their light. [S1 S2] */
#ifndef WORLD_SPHERE_H
#define WORLD_SPHERE_H

#include "picture_read.h"
#include "world_read.h"

/* world_pixel: linear RGB and alpha of pixel `at`. */
void world_pixel(float out[4], const stored_picture *p, size_t at);

/* world_sphere: fills faces of side x side texels in `own`, and alpha if there is any. A texel is the mean of bilinear
 * samples: four, more towards the poles, and many if they differ. Then pixels that outshine their neighbours are scaled
 * so that all texels together have the light of the pixel: a sun of one pixel has the right power, also at a pole.
 * Returns 1, or 0 with `r` set if memory is short. */
int world_sphere(world_pictures *own, int32_t side, const stored_picture *p, const char *path, report *r);

#endif
