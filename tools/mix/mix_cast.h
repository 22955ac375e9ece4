/* mix_cast.h: a sun or a near light estimated from the shadows and the shading in a photo. */
#ifndef MIX_CAST_H
#define MIX_CAST_H

#include "mix_job.h"

typedef struct mix_cast {
    lmb_vec3 to;      /* unit, towards the light, in scene space */
    float size;       /* degrees */
    float share;      /* irradiance on a surface that faces the light, relative to the environment's */
    float by_shadows; /* share of the brightness variance on the planes that the shadows explain, without smooth
                         variation, 0 .. 1; negative: dark places are lit */
    float explained;  /* the same plus the share of all variance that shadows and falloff explain, up to 2 */
    int is_near;      /* 1: a near light or a window, and `to` is at the foot; 0: a sun */
} mix_cast;

/* mix_find_cast: searches the upper hemisphere for the sun that best explains dark places on the planes by shadows of
 * the measured geometry; softness of the shadows gives the size of the sun. Then searches the places up to 4 m around
 * `foot`, in scene space, for a near light or a window that explains more: shadows, and brightness that decreases with
 * the distance. Returns 1, or 0 if memory is short. */
int mix_find_cast(mix_cast *out, const mix_job *j, lmb_vec3 foot);

#endif
