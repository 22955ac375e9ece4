/* io_text.c: splits a text into lines, tokens and numbers, without copying it. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io_text.h"

cursor text_open(const uint8_t *data, size_t size, const char *path)
{
    cursor c;
    c.at = (const char *)data;
    c.end = size ? c.at + size : c.at;
    c.path = path;
    c.line = 1;
    c.has_lf = size > 0 && memchr(data, '\n', size) != NULL;
    if (size >= 3 && memcmp(data, "\xEF\xBB\xBF", 3) == 0)
        c.at += 3;
    return c;
}

static int is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/* Returns 1 at the last byte of a line break. */
static int ends_line(const cursor *c, const char *at) { return *at == (c->has_lf ? '\n' : '\r'); }

/* Returns the bytes of a backslash and the line break after it; 0 if there is no continuation here. */
static size_t continuation(const cursor *c)
{
    const size_t left = (size_t)(c->end - c->at);
    if (*c->at != '\\' || left < 2)
        return 0;
    if (ends_line(c, c->at + 1))
        return 2;
    return left >= 3 && c->at[1] == '\r' && c->at[2] == '\n' ? 3 : 0;
}

static void skip_blanks(cursor *c)
{
    while (c->at < c->end) {
        const size_t n = continuation(c);
        if (!n && (!is_blank(*c->at) || ends_line(c, c->at)))
            return;
        c->line += n != 0;
        c->at += n ? n : 1;
    }
}

static int at_line_end(const cursor *c) { return c->at == c->end || *c->at == '#' || ends_line(c, c->at); }

int text_token(slice *out, cursor *c)
{
    skip_blanks(c);
    if (at_line_end(c))
        return 0;
    out->at = c->at;
    while (c->at < c->end && *c->at != '\n' && !is_blank(*c->at) && !continuation(c))
        ++c->at;
    out->size = (size_t)(c->at - out->at);
    return 1;
}

void text_rest(slice *out, cursor *c)
{
    while (c->at < c->end && is_blank(*c->at) && !ends_line(c, c->at))
        ++c->at;
    out->at = c->at;
    while (c->at < c->end && !ends_line(c, c->at) && !continuation(c))
        ++c->at;
    out->size = (size_t)(c->at - out->at);
    while (out->size && is_blank(out->at[out->size - 1]))
        --out->size;
}

int text_next_line(cursor *c)
{
    while (c->at < c->end && !ends_line(c, c->at)) {
        const size_t n = continuation(c);
        c->line += n != 0;
        c->at += n ? n : 1;
    }
    if (c->at == c->end)
        return 0;
    ++c->at;
    ++c->line;
    return c->at < c->end;
}

int slice_is(slice s, const char *word) { return s.size == strlen(word) && memcmp(s.at, word, s.size) == 0; }

static int lower(char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; }

int slice_is_like(slice s, const char *word)
{
    size_t i = 0;
    while (i < s.size && word[i] != '\0' && lower(s.at[i]) == lower(word[i]))
        ++i;
    return i == s.size && word[i] == '\0';
}

/* strtod needs a terminator; 63 characters hold every double to the last useful digit. */
int slice_number(double *out, slice s)
{
    char text[64], *end;
    if (s.size == 0 || s.size >= sizeof text)
        return 0;
    memcpy(text, s.at, s.size);
    text[s.size] = '\0';
    *out = strtod(text, &end);
    return end == text + s.size;
}

int slice_integer(int64_t *out, slice s)
{
    const int negative = s.size > 0 && s.at[0] == '-';
    size_t i = (size_t)(negative || (s.size > 0 && s.at[0] == '+'));
    int64_t value = 0;
    if (s.size == i || s.size - i > 18)
        return 0;
    for (; i < s.size; ++i) {
        if (s.at[i] < '0' || s.at[i] > '9')
            return 0;
        value = value * 10 + (s.at[i] - '0');
    }
    *out = negative ? -value : value;
    return 1;
}

int text_fail(const cursor *c, report *r, const char *format, ...)
{
    char message[320];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return report_fail(r, "%s: line %u: %s", c->path, (unsigned)c->line, message);
}
