/* mix_shine.h: objects that reflect as metals do, and objects that emit light. [M20 M25] */
#ifndef MIX_SHINE_H
#define MIX_SHINE_H

#include "mix_job.h"

enum { MIX_LAMPS = 6 /* lights that stand for all that an object emits, one for each way that it faces */ };

/* What one tile's lobes are made in. */
typedef struct mix_shine {
    lmb_glossy lobes;
    lmb_cone_seen seen;
    lmb_cone_width width;
    lmb_irradiance one; /* of one light */
} mix_shine;

/* mix_shine_read: the object's materials as its file has them, metals with their lobes. */
void mix_shine_read(mix_job *j);

/* mix_shine_lamps: lights that send what the object emits. Returns how many of MIX_LAMPS there are, or -1 with `r`
 * set. */
int32_t mix_shine_lamps(lmb_light out[MIX_LAMPS], mix_job *j, report *r);

/* mix_shine_bounces: set j->bounces, the scene whose surfaces throw light about. Lobes throw as much as their metal
 * reflects, but to all sides. */
int mix_shine_bounces(mix_job *j, report *r);

/* mix_shine_lights: add what lights bring to a tile of the object, and to its lobes.
 * mix_shine_finish: of its radiance, what lobes leave of it, what they see by narrow cones in the field with the object,
 * and what its surfaces emit. */
void mix_shine_lights(mix_shine *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object);
void mix_shine_finish(lmb_radiance *inout, mix_shine *s, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object);

#endif
