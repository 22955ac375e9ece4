/* mix_lobes.h: objects that reflect as metals do. [M20] */
#ifndef MIX_LOBES_H
#define MIX_LOBES_H

#include "mix_mirror.h"

/* What one tile's lobes are made in. */
typedef struct mix_lobes {
    lmb_glossy lobes;
    mix_mirror mirror;
    float seen[3][LMB_TILE_PIXELS];
    lmb_irradiance one; /* of one light */
} mix_lobes;

/* mix_lobes_read: the object's materials as its file has them, metals with their lobes. */
void mix_lobes_read(mix_job *j);

/* mix_lobes_bounces: set j->bounces, the scene whose surfaces throw about what bounces. Lobes throw as much as their metal
 * reflects, but to all sides; what lights send them is not in it (mix_sources.h). */
int mix_lobes_bounces(mix_job *j, report *r);

/* mix_lobes_lights: add what lights bring to a tile of the object, and to its lobes; the tile is one of so many samples of
 * the picture, each of which asks its own places of a guessed sun.
 * mix_lobes_finish: of its radiance, what lobes leave of it, what they see of the photo with the object (mix_mirror.h),
 * and what its surfaces emit. */
void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object, int32_t sample, int32_t samples);
void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object);

#endif
