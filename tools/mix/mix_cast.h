/* mix_cast.h: a sun estimated from the cast shadows in a photo. */
#ifndef MIX_CAST_H
#define MIX_CAST_H

#include "mix_job.h"

typedef struct mix_cast {
    lmb_vec3 to;      /* unit, towards the sun, in scene space */
    float size;       /* degrees */
    float share;      /* irradiance on a surface that faces the sun, relative to the environment's */
    float sure;       /* 0 .. 1 */
    float explained;  /* share of the brightness variance on the planes that the sun's shadows explain */
} mix_cast;

/* mix_find_cast: searches the upper hemisphere for the sun that best explains dark places on the planes by shadows of
 * the measured geometry. Softness of the shadows gives the size of the sun. Returns 1, or 0 if memory is short. */
int mix_find_cast(mix_cast *out, const mix_job *j);

#endif
