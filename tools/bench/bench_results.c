/* bench_results.c: a report's points, and numbers as text. */
#include "bench_results.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bench_point *bench_results_add(bench_results *b)
{
    if (b->point == NULL) {
        b->point = calloc(BENCH_POINTS, sizeof *b->point);
        b->cap = b->point != NULL ? BENCH_POINTS : 0;
    }
    if (b->count == b->cap) {
        return NULL;
    }
    b->point[b->count].same = -1;
    b->point[b->count].threads = 1;
    return &b->point[b->count++];
}

void bench_results_free(bench_results *b)
{
    for (int i = 0; i < b->count; ++i) {
        free(b->point[i].picture.rgb);
        free(b->point[i].heat.rgb);
    }
    free(b->truth_picture.rgb);
    free(b->point);
    memset(b, 0, sizeof *b);
}

void bench_say_time(char out[24], double s)
{
    const int digits = s >= 99.5 ? 0 : s >= 9.95 ? 1 : 2;
    const double ms = 1e3 * s;
    if (s >= 0.9995) {
        snprintf(out, 24, "%.*f s", digits, s);
    } else if (ms >= 0.9995) {
        snprintf(out, 24, "%.*f ms", ms >= 99.5 ? 0 : ms >= 9.95 ? 1 : 2, ms);
    } else {
        snprintf(out, 24, "%.*f us", ms >= 0.0995 ? 0 : 1, 1e3 * ms);
    }
}

void bench_say_bytes(char out[24], double bytes)
{
    const double mib = bytes / 1048576.0;
    if (mib >= 0.995) {
        snprintf(out, 24, "%.*f MiB", mib >= 9.95 ? 0 : 1, mib);
    } else {
        snprintf(out, 24, "%.0f KiB", bytes / 1024.0);
    }
}

/* Shares under 0.0001 % print as 0. */
void bench_say_figure(char out[24], const bench_results *b, int figure, double v)
{
    const double percent = 100.0 * v;
    if (isnan(v)) {
        snprintf(out, 24, "-");
    } else if (figure > 0 || !b->percent) {
        snprintf(out, 24, "%.*f", v >= 9.995 ? 1 : v >= 0.0995 ? 3 : 4, v);
    } else {
        snprintf(out, 24, "%.*f %%", percent >= 9.95 ? 0 : percent >= 0.0995 ? 1 : percent > 0.0 ? 3 : 0, percent);
    }
}
