/* mix_lobes.h: objects that reflect like metal. [M20] */
#ifndef MIX_LOBES_H
#define MIX_LOBES_H

#include "mix_mirror.h"

/* The memory that one tile's lobes are computed in. */
typedef struct mix_lobes {
    lmb_glossy lobes;
    mix_mirror mirror;
    float seen[3][LMB_TILE_PIXELS];
    lmb_irradiance one; /* of one light */
} mix_lobes;

/* mix_lobes_read: sets up the object's materials, with glossy lobes for metals. */
void mix_lobes_read(mix_job *j);

/* mix_lobes_bounces: sets j->bounces, the scene that is used for bounced light. In it, metals reflect their light
 * diffusely. Light that they reflect from given lights is excluded (mix_sources.h). */
int mix_lobes_bounces(mix_job *j, report *r);

/* mix_lobes_lights: adds the lights to a tile of the object and to its lobes. The tile is one of `samples` samples of
 * the picture, and each uses a separate part of a guessed sun. mix_lobes_finish: completes the radiance: the part that
 * lobes leave to diffuse light, the reflected photo with the object (mix_mirror.h), and emission. */
void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object, int32_t sample, int32_t samples);
void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object);

#endif
