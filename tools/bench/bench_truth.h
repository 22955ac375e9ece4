/* bench_truth.h: what settings are held against: a picture of the user's, or the subject's own most exact one. */
#ifndef BENCH_TRUTH_H
#define BENCH_TRUTH_H

#include "bench_options.h"

/* bench_truth_free releases it. */
typedef struct bench_truth {
    image picture;
    float *surface; /* as bench_shot's; NULL where it is not known */
    int is_own;
    char said[256]; /* what it is */
} bench_truth;

/* bench_truth_read: the file that --truth names; 3 channels. bench_truth_make: the subject's own, from the cache if it
 * is there, else drawn, and kept there if that can be. 1, or 0 with `r` set. */
int bench_truth_read(bench_truth *out, const char *path, report *r);
int bench_truth_make(bench_truth *out, const bench_options *o, const bench_line *line, report *r);
void bench_truth_free(bench_truth *t);

#endif
