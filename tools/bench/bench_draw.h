/* bench_draw.h: `lambent-bench draw`: the speed of lambent/draw.h for everything in a frame besides the lit scene. */
#ifndef BENCH_DRAW_H
#define BENCH_DRAW_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct draw_options {
    const char *const *cases; /* parts of names; none: all */
    int case_count;
    const char *folder;         /* of bunny.mesh and sponza.mesh; NULL: without them */
    const lmb_kernels *kernels; /* NULL: plain C */
    double seconds;             /* per case */
    int json, is_quiet;
} draw_options;

/* bench_draw_is_wanted: does a case's name contain one of the parts? bench_draw: prints one line per case. Returns 1,
 * or 0 with `r` set. */
int bench_draw_is_wanted(const draw_options *o);
int bench_draw(const draw_options *o, report *r);

#endif
