/* report.c: keeps the first failure's one line. */
#include "report.h"

#include <stdarg.h>
#include <stdio.h>

int report_fail(report *r, const char *format, ...)
{
    va_list args;
    char *c;

    if (!r || r->text[0]) return 0;
    va_start(args, format);
    vsnprintf(r->text, sizeof r->text, format, args);
    va_end(args);
    for (c = r->text; *c; ++c) { /* file names may hold anything; a report stays one printable line */
        if ((unsigned char)*c < 32 || *c == 127) *c = '?';
    }
    return 0;
}

void report_note(int is_quiet, const char *format, ...)
{
    va_list args;
    if (!is_quiet) {
        va_start(args, format);
        fputs("lambent: ", stderr);
        vfprintf(stderr, format, args);
        fputc('\n', stderr);
        va_end(args);
    }
}

int report_end(const report *r, const char *verb, int status)
{
    fprintf(stderr, "lambent %s: %s\n", verb, r->text);
    return status;
}
