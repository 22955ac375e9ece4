/* report.h: one line that says what went wrong, where, and what to do; how tools pass errors up. */
#ifndef REPORT_H
#define REPORT_H

#include <stddef.h>
#include <stdio.h>

#if defined(__GNUC__)
#define REPORT_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define REPORT_PRINTF(f, a)
#endif

/* Zero it before use. The first failure wins; later ones keep it. */
typedef struct report {
    char text[512]; /* "" while nothing went wrong; no newline. The last byte: the kind, see report_is_system */
} report;

/* report_fail: set the text ("FILE: what is wrong at PLACE; what to do") if none is set. Always returns 0, so that
 * a parser can `return report_fail(...)`. */
int report_fail(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_print: like printf, for text with names from files and command lines. text_format cleans it. report_words:
 * returns the stream for messages of a verb: stdout, or stderr after report_take_stdout, if a file goes to stdout.
 * report_say: report_print to that stream. */
void report_print(FILE *out, const char *format, ...) REPORT_PRINTF(2, 3);
FILE *report_words(void);
void report_say(const char *format, ...) REPORT_PRINTF(1, 2);
void report_take_stdout(void);

/* report_flush: 1 where all that was said on stdout could be written, else 0 with `r` set. */
int report_flush(report *r);

/* report_fail_system: the same where no file is at fault: the machine has no more memory or open files. A line of
 * report_fail about memory is such a one, too. report_is_system: is it one? */
int report_is_system(const report *r);
int report_fail_system(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_fail_usage: the same where the command line is at fault, though its options alone do not show it: one file for
 * two purposes. report_is_usage: is it one? */
int report_is_usage(const report *r);
int report_fail_usage(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_note: a line on stderr behind `lambent: `, unless it is to be quiet. */
void report_note(int is_quiet, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_end: tell the line, behind `lambent VERB: `, and return what the verb exits with: `status`, or 2
 * after report_fail_usage. */
int report_end(const report *r, const char *verb, int status);
int report_end_to(FILE *err, const report *r, const char *verb, int status);

#endif
