/* mix_around.h: what is around the object, where the lights are known. */
#ifndef MIX_AROUND_H
#define MIX_AROUND_H

#include "mix_job.h"

/* mix_around: j->env[0], which is folded from the photo, without the lamps, and without what they send to surfaces that
 * are seen and not elsewhere. 1, or 0 with `r` set. */
int mix_around(mix_job *j, report *r);

#endif
