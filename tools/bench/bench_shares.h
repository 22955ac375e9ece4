/* bench_shares.h: each case's share of the machine's bound, as a page with bars. */
#ifndef BENCH_SHARES_H
#define BENCH_SHARES_H

#include "../common/text_buffer.h"

enum { BENCH_SHARES = 32 };

typedef struct bench_share {
    const char *name; /* of the case; owned by the caller */
    const char *by;   /* the limit: a unit, or "depth" */
    double ms, bound_ms;
} bench_share;

typedef struct bench_shares {
    bench_share row[BENCH_SHARES];
    int count;
    const char *backend;
} bench_shares;

void bench_shares_html(text_buffer *out, const bench_shares *b);

#endif
