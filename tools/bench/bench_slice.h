/* bench_slice.h: some settings of a sweep as a slice's file, and the report of all of them. */
#ifndef BENCH_SLICE_H
#define BENCH_SLICE_H

#include "../common/slice.h"
#include "bench_state.h"

/* bench_slice_deal: is_own[i]: 1 where the slice measures setting i. Each goes, the longest first, to the slice that has
 * the least to do, by their weights. */
void bench_slice_deal(uint8_t is_own[BENCH_POINTS], slice s, const bench_task *task, int tasks);

/* bench_slice_job: of the settings, what was given, the scene, the truth and the picture of the first setting. Files
 * count by what they hold. */
uint64_t bench_slice_job(const sweep *s);

/* bench_slice_write: the points beside o->out. bench_slice_merge: the report; `path` ends in .csv, .json, .html or .svg.
 * Slices of unlike machines are told of, unless quiet. 1, or 0 with `r` set. */
int bench_slice_write(const bench_options *o, const bench_results *b, report *r);
int bench_slice_merge(const char *path, const slice_set *set, int is_quiet, report *r);

#endif
