/* bench_style.h: how a report looks, light and dark. */
#ifndef BENCH_STYLE_H
#define BENCH_STYLE_H

/* In parts: C99 asks compilers for strings of 4,095 characters only. */
enum { BENCH_STYLE_PARTS = 2 };
extern const char *const bench_style[BENCH_STYLE_PARTS];

#endif
