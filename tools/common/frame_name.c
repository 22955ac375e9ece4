/* frame_name.c: numbered files by a pattern. */
#include "frame_name.h"

#include <stdio.h>
#include <string.h>

#include "io_file.h"

enum { DIGITS = 9, NAME = 4096 };

/* The next %0Nd of a text; NULL: none. */
static const char *find_number(const char *text)
{
    const char *p = strchr(text, '%');
    while (p != NULL && (p[1] != '0' || p[2] < '1' || p[2] > '0' + DIGITS || p[3] != 'd')) {
        p = strchr(p + 1, '%');
    }
    return p;
}

int frame_digits(const char *pattern)
{
    const char *p = find_number(pattern);
    return p == NULL || find_number(p + 4) != NULL || strstr(pattern, "%%") != NULL ? 0 : p[2] - '0';
}

int frame_name(char *out, size_t size, const char *pattern, int32_t k, report *r)
{
    const char *at = find_number(pattern);
    const int n =
        snprintf(out, size, "%.*s%0*d%s", (int)(at - pattern), pattern, frame_digits(pattern), (int)k, at + 4);
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

int frames_can_write(const char *path, int32_t count, report *r)
{
    char name[NAME];
    int ok = 1;
    for (int32_t i = 0; ok && i < count; ++i) {
        ok = frame_numbered(name, sizeof name, path, i, r) &&
             (i == 0 ? file_can_write(name, r) : file_may_replace(name, r));
    }
    return ok;
}
