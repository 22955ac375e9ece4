/* frame_name.c: numbered files by a pattern. */
#include "frame_name.h"

#include <stdio.h>
#include <string.h>

enum { DIGITS = 9 };

int frame_digits(const char *pattern)
{
    const char *p = strchr(pattern, '%');
    if (p == NULL || p[1] != '0' || p[2] < '1' || p[2] > '0' + DIGITS || p[3] != 'd' || strchr(p + 4, '%') != NULL) {
        return 0;
    }
    return p[2] - '0';
}

int frame_name(char *out, size_t size, const char *pattern, int32_t k, report *r)
{
    const char *at = strchr(pattern, '%');
    const int n = snprintf(out, size, "%.*s%0*d%s", (int)(at - pattern), pattern, frame_digits(pattern), (int)k, at + 4);
    return (n > 0 && (size_t)n < size) || report_fail(r, "%s: the name is too long", pattern);
}

int frame_numbered(char *out, size_t size, const char *path, int32_t k, report *r)
{
    if (frame_digits(path) > 0) {
        return frame_name(out, size, path, k, r);
    }
    const char *dot = strrchr(path, '.');
    const int n = snprintf(out, size, "%.*s-%04d%s", (int)(dot - path), path, (int)k, dot);
    return (n > 0 && (size_t)n < size) || report_fail(r, "%s: the name is too long", path);
}
