/* text_buffer.c: a growing text, for files that are written at once. */
#include "text_buffer.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io_file.h"
#include "text_clean.h"

enum { FIRST = 1 << 14 };

/* Makes room for n more characters and the 0. */
static int has_room(text_buffer *p, size_t n)
{
    size_t cap = p->cap > 0 ? p->cap : FIRST;
    char *data;
    while (cap < p->size + n + 1 && cap <= SIZE_MAX / 2) {
        cap *= 2;
    }
    if (p->is_short || cap < p->size + n + 1 || (cap > p->cap && (data = realloc(p->data, cap)) == NULL)) {
        p->is_short = 1;
        return 0;
    }
    if (cap > p->cap) {
        p->data = data;
        p->cap = cap;
    }
    return 1;
}

static void put(text_buffer *p, const char *text, size_t n)
{
    if (has_room(p, n)) {
        memcpy(p->data + p->size, text, n);
        p->size += n;
        p->data[p->size] = '\0';
    }
}

void text_buffer_plain(text_buffer *p, const char *text) { put(p, text, strlen(text)); }

void text_buffer_span(text_buffer *p, const char *text, size_t size) { put(p, text, size); }

void text_buffer_add(text_buffer *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    if (n < 0 || !has_room(p, (size_t)n)) {
        p->is_short = 1;
        return;
    }
    va_start(args, format);
    text_format(p->data + p->size, (size_t)n + 1, format, args);
    va_end(args);
    p->size += strlen(p->data + p->size);
}

void text_buffer_html(text_buffer *p, const char *text)
{
    while (*text != '\0') {
        uint32_t code;
        const int n = text_character(&code, text);
        switch (n == 0 || text_is_hidden(code) ? '\0' : *text) {
        case '\0':
            text_buffer_plain(p, "?");
            break;
        case '&':
            text_buffer_plain(p, "&amp;");
            break;
        case '<':
            text_buffer_plain(p, "&lt;");
            break;
        case '>':
            text_buffer_plain(p, "&gt;");
            break;
        case '"':
            text_buffer_plain(p, "&quot;");
            break;
        default:
            put(p, text, (size_t)n);
        }
        text += n > 0 ? n : 1;
    }
}

void text_buffer_json(text_buffer *p, const char *text)
{
    text_buffer_plain(p, "\"");
    while (*text != '\0') {
        char character[TEXT_JSON];
        text_json(character, &text);
        text_buffer_plain(p, character);
    }
    text_buffer_plain(p, "\"");
}

void text_buffer_csv(text_buffer *p, const char *text)
{
    const int is_quoted = strpbrk(text, ",\"\r\n") != NULL;
    put(p, "\"", is_quoted);
    while (*text != '\0') {
        uint32_t code;
        const int n = text_character(&code, text), is_shown = n > 0 && !text_is_hidden(code);
        put(p, "\"", *text == '"');
        put(p, is_shown ? text : "?", is_shown ? (size_t)n : 1);
        text += n > 0 ? n : 1;
    }
    put(p, "\"", is_quoted);
}

void text_buffer_base64(text_buffer *p, const uint8_t *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t n = size - i < 3 ? size - i : 3;
        const uint32_t bits =
            (uint32_t)data[i] << 16 | (n > 1 ? (uint32_t)data[i + 1] << 8 : 0) | (n > 2 ? (uint32_t)data[i + 2] : 0);
        const char four[4] = {digits[bits >> 18], digits[bits >> 12 & 63], n > 1 ? digits[bits >> 6 & 63] : '=',
                              n > 2 ? digits[bits & 63] : '='};
        put(p, four, 4);
    }
}

int text_buffer_write(const text_buffer *p, const char *path, report *r)
{
    if (p->is_short) {
        return report_fail(r, "%s: out of memory after %.0f characters", path, (double)p->size);
    }
    return file_write(path, p->size > 0 ? p->data : "", p->size, r);
}

void text_buffer_free(text_buffer *p)
{
    free(p->data);
    memset(p, 0, sizeof *p);
}
