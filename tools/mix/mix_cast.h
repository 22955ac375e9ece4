/* mix_cast.h: a sun or a near light estimated from the shadows and the shading in a photo. */
#ifndef MIX_CAST_H
#define MIX_CAST_H

#include "mix_job.h"

typedef struct mix_cast {
    lmb_vec3 to;      /* unit, towards the sun, in scene space */
    float size;       /* degrees */
    float share;      /* irradiance on a surface that faces the sun, relative to the environment's */
    float explained;  /* share of the brightness variance on the planes that the sun's shadows explain */
} mix_cast;

/* A lamp, found by its falloff: how brightness decreases over each plane, and its shadows. */
typedef struct mix_lamp {
    lmb_vec3 to;      /* unit, from the foot towards it */
    float share;      /* as above, at the foot */
    float explained;  /* share of all brightness variance on the planes */
} mix_lamp;

/* mix_find_cast: searches the upper hemisphere for the sun that best explains dark places on the planes by shadows of
 * the measured geometry; softness of the shadows gives the size of the sun. Then searches the places up to 4 m around
 * `foot`, in scene space, for a near light. Returns 1, or 0 if memory is short. */
int mix_find_cast(mix_cast *sun, mix_lamp *lamp, const mix_job *j, lmb_vec3 foot);

#endif
