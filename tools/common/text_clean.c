/* text_clean.c: makes text from files and command lines safe to print. */
#include "text_clean.h"

#include <stdio.h>
#include <string.h>

int text_character(uint32_t *code, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    const int n = s[0] < 0x80 ? 1 : s[0] < 0xC2 ? 0 : s[0] < 0xE0 ? 2 : s[0] < 0xF0 ? 3 : s[0] < 0xF5 ? 4 : 0;
    uint32_t value = n > 1 ? s[0] & (0x7Fu >> n) : s[0];
    for (int i = 1; i < n; ++i) {
        if ((s[i] & 0xC0) != 0x80) {
            return 0;
        }
        value = value << 6 | (s[i] & 0x3Fu);
    }
    if ((n == 3 && (value < 0x800 || (value >= 0xD800 && value <= 0xDFFF))) || /* overlong; a surrogate */
        (n == 4 && (value < 0x10000 || value > 0x10FFFF))) {
        return 0;
    }
    *code = value;
    return n;
}

int text_is_hidden(uint32_t code)
{
    static const uint32_t ranges[][2] = {
        {0x00, 0x1F},     {0x7F, 0x9F},     {0xAD, 0xAD},     {0x61C, 0x61C},   {0x180E, 0x180E}, {0x200B, 0x200B},
        {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2060, 0x206F}, {0xFEFF, 0xFEFF}, {0xFFF9, 0xFFFB}, {0xE0000, 0xE007F},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; ++i) {
        if (code >= ranges[i][0] && code <= ranges[i][1]) {
            return 1;
        }
    }
    return (code & 0xFFFE) == 0xFFFE;
}

static void clean(char *text, int keeps_breaks)
{
    const size_t size = strlen(text);
    const char *from = text, *end = text + size;
    char *to = text;
    while (from < end) {
        uint32_t code;
        const int n = text_character(&code, from);
        if (n > 0 && (!text_is_hidden(code) || (code == '\n' && (keeps_breaks || from + 1 == end)))) {
            memmove(to, from, (size_t)n);
            to += n;
        } else {
            *to++ = '?';
        }
        from += n > 0 ? n : 1;
    }
    *to = '\0';
}

static int count_breaks(const char *text)
{
    int n = 0;
    for (; (text = strchr(text, '\n')) != NULL; ++text) {
        ++n;
    }
    return n;
}

void text_clean_lines(char *inout, int breaks)
{
    const int n = count_breaks(inout);
    clean(inout, n <= breaks);
}

void text_clean(char *inout)
{
    const size_t size = strlen(inout);
    clean(inout, 0);
    if (size > 0 && inout[strlen(inout) - 1] == '\n') {
        inout[strlen(inout) - 1] = '?';
    }
}

int text_format(char *out, size_t size, const char *format, va_list args)
{
    const int n = vsnprintf(out, size, format, args);
    if (n < 0) {
        out[0] = '\0';
    } else if ((size_t)n >= size) {
        size_t begin = size - 1;
        uint32_t code;
        while (begin > 0 && size - begin < 4 && ((unsigned char)out[begin - 1] & 0xC0) == 0x80) {
            --begin;
        }
        if (begin > 0 && (unsigned char)out[begin - 1] >= 0xC0 && text_character(&code, out + begin - 1) == 0) {
            out[begin - 1] = '\0';
        }
    }
    text_clean_lines(out, count_breaks(format));
    return n;
}

void text_json(char out[TEXT_JSON], const char **at)
{
    uint32_t code;
    const int n = text_character(&code, *at);
    if (n == 0) {
        strcpy(out, "\\ufffd");
    } else if (code > 0xFFFF && text_is_hidden(code)) {
        snprintf(out, TEXT_JSON, "\\u%04x\\u%04x", (unsigned)(0xD7C0 + (code >> 10)),
                 (unsigned)(0xDC00 + (code & 0x3FF)));
    } else if (text_is_hidden(code)) {
        snprintf(out, TEXT_JSON, "\\u%04x", (unsigned)code);
    } else {
        snprintf(out, TEXT_JSON, "%s%.*s", code == '"' || code == '\\' ? "\\" : "", n, *at);
    }
    *at += n > 0 ? n : 1;
}
