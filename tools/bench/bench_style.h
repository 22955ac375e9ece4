/* bench_style.h: the style of a report, light and dark. */
#ifndef BENCH_STYLE_H
#define BENCH_STYLE_H

/* In parts, because C99 requires compilers to accept only strings of up to 4,095 characters. */
enum { BENCH_STYLE_PARTS = 2 };
extern const char *const bench_style[BENCH_STYLE_PARTS];

#endif
