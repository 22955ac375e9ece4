/* test_text_clean.c: tests which parts of a text are printed, as plain text, JSON, HTML and CSV. */
#include "../test.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../../tools/common/report.h"
#include "../../tools/common/text_buffer.h"
#include "../../tools/common/text_clean.h"

void test_text_clean(void);

static int cleans(const char *text, const char *wanted)
{
    char copy[128];
    strcpy(copy, text);
    text_clean(copy);
    return strcmp(copy, wanted) == 0;
}

static void characters(void)
{
    CHECK(cleans("", "") && cleans("plain ~", "plain ~") &&
          cleans("\xC3\xBC\xE2\x82\xAC\xF0\x9F\x99\x82", "\xC3\xBC\xE2\x82\xAC\xF0\x9F\x99\x82"));
    for (int c = 1; c < 256; ++c) {
        const char text[3] = {(char)c, 'x', '\0'};
        char copy[3];
        strcpy(copy, text);
        text_clean(copy);
        CHECK_MSG((copy[0] == '?') == (c < 32 || c > 126 || c == '?'), "byte %d", c);
    }
    /* C1, a soft hyphen, marks, overrides, isolates, separators, a byte order mark, tags, noncharacters */
    CHECK(cleans("\xC2\x80\xC2\x9B\xC2\x9F\xC2\xA0", "???\xC2\xA0") && cleans("\xC2\xAD\xD8\x9C", "??"));
    CHECK(cleans("\xE2\x80\x8E\xE2\x80\x8F\xE2\x80\xA8\xE2\x80\xA9\xE2\x80\xAA\xE2\x80\xAE\xE2\x80\xAF",
                 "??????\xE2\x80\xAF"));
    CHECK(cleans("\xE2\x81\xA6\xE2\x81\xA9\xEF\xBB\xBF\xEF\xBF\xBE\xEF\xBF\xBF\xF3\xA0\x81\x81", "??????"));
    CHECK(cleans("\xE2\x80\x8D", "\xE2\x80\x8D")); /* a joiner; some scripts need it */
    /* not UTF-8: overlong, surrogates, beyond U+10FFFF, truncated */
    CHECK(cleans("\xC0\xAF", "??") && cleans("\xE0\x80\x80", "???") && cleans("\xED\xA0\x80", "???"));
    CHECK(cleans("\xF4\x90\x80\x80", "????") && cleans("\xE2\x82", "??") && cleans("\xE2\x82y\x9B", "??y?"));
    CHECK(cleans("\n", "?") && cleans("a\nb\n", "a?b?") && cleans("\t\r", "??"));
}

static const char *formatted(char out[64], size_t size, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    text_format(out, size, format, args);
    va_end(args);
    return out;
}

static void formats(void)
{
    char out[64];
    CHECK(strcmp(formatted(out, sizeof out, "%s: %d\n", "a\x1B", 3), "a?: 3\n") == 0);
    CHECK(strcmp(formatted(out, sizeof out, "a\nb %s\n", "c"), "a\nb c\n") == 0);
    CHECK(strcmp(formatted(out, sizeof out, "%s\n", "a\nlambent: all is well"), "a?lambent: all is well\n") == 0);
    CHECK(strcmp(formatted(out, 6, "%s", "abc\xE2\x82\xAC"), "abc") == 0);
    CHECK(strcmp(formatted(out, 7, "%s", "abc\xE2\x82\xAC"), "abc\xE2\x82\xAC") == 0);
    CHECK(strcmp(formatted(out, 5, "%s", "\xC3\xBC\xC3\xBC\xC3\xBC"), "\xC3\xBC\xC3\xBC") == 0);
    report r = {""};
    report_fail(&r, "%s: gone\n", "a\xC2\x9B\n");
    CHECK(strcmp(r.text, "a??: gone?") == 0);
}

static void buffers(void)
{
    text_buffer b;
    memset(&b, 0, sizeof b);
    text_buffer_json(&b, "\"\\\x1B\x7F\xC2\x9B\x9B\xE2\x80\xAE\xC3\xBC\xF3\xA0\x81\x81\xF0\x9F\x99\x82");
    text_buffer_plain(&b, "|");
    text_buffer_html(&b, "<'\">&\x1B\x9B\xE2\x80\xAE\xC3\xBC");
    text_buffer_plain(&b, "|");
    text_buffer_csv(&b, "a,\n\"\x1B\x9B\xC3\xBC");
    text_buffer_add(&b, "|%s|", "\x1B\xC2\x80");
    CHECK_MSG(strcmp(b.data, "\"\\\"\\\\\\u001b\\u007f\\u009b\\ufffd\\u202e\xC3\xBC\\udb40\\udc41\xF0\x9F\x99\x82\"|"
                             "&lt;'&quot;&gt;&amp;???\xC3\xBC|\"a,?\"\"??\xC3\xBC\"|??|") == 0,
              "%s", b.data);
    text_buffer_free(&b);
}

void test_text_clean(void)
{
    characters();
    formats();
    buffers();
}
