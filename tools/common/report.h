/* report.h: a one-line error message: problem, place and remedy; tools pass errors up in it. */
#ifndef REPORT_H
#define REPORT_H

#include <stddef.h>
#include <stdio.h>

#if defined(__GNUC__)
#define REPORT_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define REPORT_PRINTF(f, a)
#endif

enum { REPORT_TEXT = 4608 }; /* a path of 4,096 bytes and a sentence */

/* Zero it before use. The first failure is kept; later ones are ignored. */
typedef struct report {
    char text[REPORT_TEXT]; /* "" if nothing failed; no newline. The last byte is the kind, see report_is_system */
} report;

/* report_fail: sets the text ("FILE: what is wrong at PLACE; what to do") if none is set. Always returns 0, so that
 * a parser can `return report_fail(...)`. */
int report_fail(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_print: like printf, for text with names from files and command lines. text_format cleans it. report_words:
 * returns the stream for messages of a verb: stdout, or stderr after report_take_stdout, if a file goes to stdout.
 * report_say: report_print to that stream. */
void report_print(FILE *out, const char *format, ...) REPORT_PRINTF(2, 3);
FILE *report_words(void);
void report_say(const char *format, ...) REPORT_PRINTF(1, 2);
void report_take_stdout(void);

/* report_flush: returns 1 if everything printed to stdout could be written, otherwise 0 with `r` set. report_flush_to:
 * the same for a stream that takes the place of stdout. */
int report_flush(report *r);
int report_flush_to(FILE *out, report *r);

/* report_fail_system: like report_fail, if no file is at fault but memory or open files ran out. A report_fail about
 * memory counts as such. report_is_system: whether this is the kind. */
int report_is_system(const report *r);
int report_fail_system(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_fail_usage: like report_fail, if the command line is at fault in a way that parsing cannot detect: one file
 * for two purposes. report_is_usage: whether this is the kind. */
int report_is_usage(const report *r);
int report_fail_usage(report *r, const char *format, ...) REPORT_PRINTF(2, 3);

/* report_note: prints a line on stderr after the program's name, unless is_quiet. report_hold_notes: later notes
 * wait for report_print_notes, report_say or the first step of progress. If the command fails before, report_end drops
 * the notes, and the error is the only line. One thread at a time. */
void report_note(int is_quiet, const char *format, ...) REPORT_PRINTF(2, 3);
void report_hold_notes(void);
void report_print_notes(void);

/* report_end: prints the message after the program and VERB, and returns the exit status: `status`, or 2 after
 * report_fail_usage. */
int report_end(const report *r, const char *verb, int status);
int report_end_to(FILE *err, const report *r, const char *verb, int status);

#endif
