/* report.h: one line that says what went wrong, where, and what to do; how tools pass errors up. */
#ifndef REPORT_H
#define REPORT_H

#include <stddef.h>

#if defined(__GNUC__)
#define REPORT_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define REPORT_PRINTF(f, a)
#endif

/* Zero it before use. The first failure wins; later ones keep it. */
typedef struct report {
    char text[512]; /* "" while nothing went wrong; no newline */
} report;

/* report_fail: set the text ("FILE: what is wrong at PLACE; what to do") if none is set. Always returns 0, so that
 * a parser can `return report_fail(...)`. */
int report_fail(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_note: a line on stderr behind `lambent: `, unless it is to be quiet. */
void report_note(int is_quiet, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_end: tell the line, behind `lambent VERB: `, and return what the verb exits with: `status`. */
int report_end(const report *r, const char *verb, int status);

#endif
