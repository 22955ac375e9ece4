/* mix_around.h: the environment of the object if the lights are given. */
#ifndef MIX_AROUND_H
#define MIX_AROUND_H

#include "mix_job.h"

/* mix_around: replaces j->env[0], which is folded from the photo, by one without the lamps and without their light on
 * visible surfaces. Returns 1, or 0 with `r` set. */
int mix_around(mix_job *j, report *r);

#endif
