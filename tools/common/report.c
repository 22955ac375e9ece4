/* report.c: keeps the message of the first failure. */
#include "report.h"

#include "command_name.h"
#include "notes.h"
#include "progress.h"
#include "text_clean.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { OF_FILES, OF_SYSTEM, OF_USAGE }; /* kind of failure, in the last byte of the text */

static void set_text(report *r, int kind, const char *format, va_list args)
{
    if (r == NULL || r->text[0] != '\0') {
        return;
    }
    text_format(r->text, sizeof r->text - 1, format, args);
    text_clean(r->text); /* a message must stay one line */
    r->text[sizeof r->text - 1] = (char)kind;
}

int report_fail(report *r, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_text(r, strstr(format, "memory") != NULL ? OF_SYSTEM : OF_FILES, format, args);
    va_end(args);
    return 0;
}

int report_fail_system(report *r, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_text(r, OF_SYSTEM, format, args);
    va_end(args);
    return 0;
}

int report_fail_usage(report *r, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_text(r, OF_USAGE, format, args);
    va_end(args);
    return 0;
}

static int is_of(const report *r, int kind) { return r->text[0] != '\0' && r->text[sizeof r->text - 1] == kind; }
int report_is_system(const report *r) { return is_of(r, OF_SYSTEM); }
int report_is_usage(const report *r) { return is_of(r, OF_USAGE); }

static int is_taken;

FILE *report_words(void) { return is_taken ? stderr : stdout; }

/* If memory runs out, the text is truncated. */
static void print(FILE *out, const char *format, va_list args)
{
    char few[1024];
    va_list again;
    va_copy(again, args);
    const int n = vsnprintf(few, sizeof few, format, args);
    const size_t size = n < 0 ? 0 : (size_t)n + 1;
    char *more = size > sizeof few ? malloc(size) : NULL;
    char *text = more != NULL ? more : few;
    text_format(text, more != NULL ? size : sizeof few, format, again);
    va_end(again);
    fputs(text, out);
    free(more);
}

void report_print(FILE *out, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    print(out, format, args);
    va_end(args);
}

void report_say(const char *format, ...)
{
    va_list args;
    report_print_notes();
    va_start(args, format);
    print(report_words(), format, args);
    va_end(args);
}

void report_take_stdout(void) { is_taken = 1; }

int report_flush_to(FILE *out, report *r)
{
    errno = 0;
    return (fflush(out) == 0 && !ferror(out)) ||
           report_fail(r, "standard output: cannot be written%s%s", errno != 0 ? ": " : "",
                       errno != 0 ? strerror(errno) : "");
}

int report_flush(report *r) { return report_flush_to(stdout, r); }

void report_hold_notes(void) { notes_hold(); }

void report_print_notes(void)
{
    progress_wipe();
    notes_print();
}

void report_note(int is_quiet, const char *format, ...)
{
    va_list args;
    if (is_quiet) {
        return;
    }
    va_start(args, format);
    if (!notes_add(command_name(""), format, args)) {
        progress_wipe();
        fprintf(stderr, "%s: ", command_name(""));
        print(stderr, format, args);
        fputc('\n', stderr);
    }
    va_end(args);
}

int report_end(const report *r, const char *verb, int status)
{
    progress_end();
    notes_drop();
    return report_end_to(stderr, r, verb, status);
}

int report_end_to(FILE *err, const report *r, const char *verb, int status)
{
    report_print(err, "%s: %s\n", command_name(verb), r->text);
    return report_is_usage(r) ? 2 : status;
}
