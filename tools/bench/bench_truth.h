/* bench_truth.h: the reference for settings: a picture of the user's, or the subject's most exact one. */
#ifndef BENCH_TRUTH_H
#define BENCH_TRUTH_H

#include "bench_options.h"

/* Release it with bench_truth_free. */
typedef struct bench_truth {
    image picture;
    float *surface; /* as in bench_shot; NULL if unknown */
    int is_own;
    char said[256]; /* a description */
} bench_truth;

/* bench_truth_read: reads the file of --truth; 3 channels. bench_truth_make: takes the subject's truth from the cache,
 * or draws it and stores it there if possible. They return 1, or 0 with `r` set. */
int bench_truth_read(bench_truth *out, const char *path, report *r);
int bench_truth_make(bench_truth *out, const bench_options *o, const bench_line *line, report *r);
void bench_truth_free(bench_truth *t);

#endif
