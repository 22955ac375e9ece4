/* info_text.c: what `lambent info` prints: labelled lines, or JSON. */
#include "info_text.h"

/* Bytes of the UTF-8 character (RFC 3629) that starts here, 0: none does. The terminating 0 ends any sequence. */
static int utf8_size(const unsigned char *s)
{
    const int n = s[0] < 0x80 ? 1 : s[0] < 0xC2 ? 0 : s[0] < 0xE0 ? 2 : s[0] < 0xF0 ? 3 : s[0] < 0xF5 ? 4 : 0;
    for (int i = 1; i < n; ++i)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    if ((s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xED && s[1] >= 0xA0) || /* overlong; a half of a pair */
        (s[0] == 0xF0 && s[1] < 0x90) || (s[0] == 0xF4 && s[1] >= 0x90))   /* overlong; past U+10FFFF */
        return 0;
    return n;
}

void json_text(FILE *out, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', out);
    while (*s) {
        const int n = utf8_size(s);
        if (n == 0)
            fputs("\\ufffd", out);
        else if (*s < 32 || *s == 127)
            fprintf(out, "\\u%04x", (unsigned)*s);
        else
            fprintf(out, "%s%.*s", *s == '"' || *s == '\\' ? "\\" : "", n, (const char *)s);
        s += n > 0 ? n : 1;
    }
    fputc('"', out);
}

void plain_text(FILE *out, const char *text)
{
    for (; *text; ++text)
        fputc((unsigned char)*text < 32 || *text == 127 ? '?' : *text, out);
}

void label(FILE *out, const char *text) { fprintf(out, "%-12s ", text); }

void json_vec3(FILE *out, const char *name, lmb_vec3 v)
{
    fprintf(out, "\"%s\":[%.9g,%.9g,%.9g]", name, (double)v.x, (double)v.y, (double)v.z);
}
