/* mix_cast.h: the sun that a photo's own shadows tell of. */
#ifndef MIX_CAST_H
#define MIX_CAST_H

#include "mix_job.h"

typedef struct mix_cast {
    lmb_vec3 to;      /* unit, towards the sun, in the scene's space */
    float size;       /* degrees */
    float share;      /* what it gives a surface that faces it, over what comes from everywhere else */
    float sure;       /* 0 .. 1 */
    float explained;  /* of what differs on the planes, the part that its shadow explains */
} mix_cast;

/* mix_find_cast: a cast shadow is where depth explains that a plane is dark. Of suns all over the half sphere above, that
 * whose shadows of what is measured explain most; and how wide it is, by how soft they are. 1, or 0 without memory. */
int mix_find_cast(mix_cast *out, const mix_job *j);

#endif
