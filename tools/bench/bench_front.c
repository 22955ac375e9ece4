/* bench_front.c: the front of unbeaten points, and the knee. */
#include "bench_front.h"

#include <math.h>

static int counts(const bench_point *p) { return p->has_figures && p->failure[0] == '\0' && p->threads == 1; }

/* Does a beat b? `earlier`: a comes before b. */
static int beats(const bench_point *a, const bench_point *b, int earlier)
{
    const int no_worse = a->time_s <= b->time_s && a->figure[0] <= b->figure[0];
    return no_worse && (a->time_s < b->time_s || a->figure[0] < b->figure[0] || earlier);
}

static int is_beaten(const bench_results *b, int i)
{
    for (int k = 0; k < b->count; ++k) {
        if (k != i && counts(&b->point[k]) && beats(&b->point[k], &b->point[i], k < i)) {
            return 1;
        }
    }
    return 0;
}

static double log_time(const bench_point *p) { return log(p->time_s > BENCH_MIN_S ? p->time_s : BENCH_MIN_S); }

static double log_error(const bench_point *p)
{
    return log(p->figure[0] > BENCH_MIN_ERROR ? p->figure[0] : BENCH_MIN_ERROR);
}

/* Both axes run from 0 to 1, so the line is time + error = 1. */
static void mark_knee(bench_results *b, const int *order, int n)
{
    const bench_point *fast = &b->point[order[0]], *slow = &b->point[order[n - 1]];
    const double t0 = log_time(fast), e0 = log_error(slow), t = log_time(slow) - t0, e = log_error(fast) - e0;
    double max = 0.0;
    int knee = -1;
    for (int i = 1; i + 1 < n && t > 0.0 && e > 0.0; ++i) {
        const bench_point *p = &b->point[order[i]];
        const double under = 1.0 - (log_time(p) - t0) / t - (log_error(p) - e0) / e;
        if (under > max) {
            max = under;
            knee = order[i];
        }
    }
    if (knee >= 0) {
        b->point[knee].is_knee = 1;
    }
}

/* All times differ. */
int bench_front_order(int *order, const bench_results *b)
{
    int n = 0;
    for (int i = 0; i < b->count; ++i) {
        int k = n;
        if (!b->point[i].on_front) {
            continue;
        }
        for (; k > 0 && b->point[order[k - 1]].time_s > b->point[i].time_s; --k) {
            order[k] = order[k - 1];
        }
        order[k] = i;
        ++n;
    }
    return n;
}

int bench_front(bench_results *b)
{
    int order[BENCH_POINTS];
    for (int i = 0; i < b->count; ++i) {
        b->point[i].is_knee = 0;
        b->point[i].on_front = counts(&b->point[i]) && !is_beaten(b, i);
    }
    const int n = bench_front_order(order, b);
    if (n > 2) {
        mark_knee(b, order, n);
    }
    return n;
}
