/* mix_run.h: steps shared by one photo and a sequence of them. */
#ifndef MIX_RUN_H
#define MIX_RUN_H

#include "mix_job.h"

/* mix_make_picture: draws a frame that was read and has planes. It prints notes about the object before the long work.
 * mix_lap: seconds since *from, which becomes now. mix_exposure: exposure of the picture, in stops. mix_tell_times:
 * prints the time of each step. */
int mix_make_picture(mix_job *j, double *from, report *r);
double mix_lap(double *from);
float mix_exposure(const mix_job *j);
void mix_tell_times(const mix_job *j);

/* mix_placements: draws all pictures of a list of placements in one photo. Returns 1, or 0 with `r` set. */
int mix_placements(mix_job *j, report *r);

/* mix_frames: draws all frames of a list. Returns 1, or 0 with `r` set. */
int mix_frames(const mix_options *o, report *r);

#endif
