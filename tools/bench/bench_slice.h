/* bench_slice.h: some settings of a sweep as a slice's file, and the report of all slices. */
#ifndef BENCH_SLICE_H
#define BENCH_SLICE_H

#include "../common/slice.h"
#include "bench_state.h"

/* bench_slice_deal: sets is_own[i] to 1 if the slice measures setting i. Settings go in order of weight, the longest
 * first, to the slice with the least work. */
void bench_slice_deal(uint8_t is_own[BENCH_POINTS], slice s, const bench_task *task, int tasks);

/* bench_slice_job: a hash of settings, options, scene, truth and the picture of the first setting. Files count by
 * content. */
uint64_t bench_slice_job(const sweep *s);

/* bench_slice_write: writes the points to a file next to o->out. bench_slice_merge: writes the report; `path` ends in
 * .csv, .json, .html or .svg. Prints a note if slices come from different machines, unless quiet. They return 1, or 0
 * with `r` set. */
int bench_slice_write(const bench_options *o, const bench_results *b, report *r);
int bench_slice_merge(const char *path, const slice_set *set, int is_quiet, report *r);

#endif
