/* io_text.h: splits a text into lines, tokens and numbers in place. */
#ifndef IO_TEXT_H
#define IO_TEXT_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* A range of bytes in a text; not terminated. */
typedef struct slice {
    const char *at;
    size_t size;
} slice;

/* A position in a text of lines. */
typedef struct cursor {
    const char *at, *end;
    const char *path; /* for messages */
    uint32_t line;    /* from 1 */
    int has_lf;       /* otherwise CR ends a line, as in Mac OS 9 */
} cursor;

/* Tokens. A comment ends a line; so does the line break, unless there is a backslash before it. */
cursor text_open(const uint8_t *data, size_t size, const char *path);
int text_token(slice *out, cursor *c); /* the next one on this line; 0 at the end */
void text_rest(slice *out, cursor *c); /* the rest of this line (without continuation lines), trimmed */
int text_next_line(cursor *c);         /* 0 at the end of the text */
int slice_is(slice s, const char *word);
int slice_is_like(slice s, const char *word); /* ignoring case */
int slice_number(double *out, slice s);   /* 0: not a number; inf and nan are numbers */
int slice_integer(int64_t *out, slice s); /* 0: not one of at most 18 digits */
int text_fail(const cursor *c, report *r, const char *format, ...) REPORT_PRINTF(3, 4);

#endif
