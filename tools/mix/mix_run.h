/* mix_run.h: what one photo and a sequence of them have in common. */
#ifndef MIX_RUN_H
#define MIX_RUN_H

#include "mix_job.h"

/* mix_make_picture: of a frame that was read, its planes found. mix_lap: seconds since *from, which becomes now.
 * mix_exposure: stops, of its picture. mix_tell, mix_tell_times: words about it. */
int mix_make_picture(mix_job *j, double *from, report *r);
double mix_lap(double *from);
float mix_exposure(const mix_job *j);
void mix_tell(const mix_job *j);
void mix_tell_times(const mix_job *j);

/* mix_frames: all of a list. 1, or 0 with `r` set. */
int mix_frames(const mix_options *o, report *r);

#endif
