/* io_ppm_read.c: PPM files into 8-bit pictures. */
#include "io_ppm_read.h"

#include <stdlib.h>

typedef struct cursor {
    const uint8_t *data;
    size_t size, at;
} cursor;

static int is_space(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* White space and comments, which run from # to the line's end. */
static void skip_space(cursor *c)
{
    int in_comment = 0;
    for (; c->at < c->size; ++c->at) {
        uint8_t b = c->data[c->at];
        if (in_comment)
            in_comment = b != '\n' && b != '\r';
        else if (b == '#')
            in_comment = 1;
        else if (!is_space(b))
            return;
    }
}

/* A decimal number in 1 .. limit after at least one separator; 0 when there is none. `limit` under 2^27. */
static int32_t read_number(cursor *c, int32_t limit)
{
    size_t before = c->at, digits;
    int32_t value = 0;
    skip_space(c);
    if (c->at == before)
        return 0;
    digits = c->at;
    while (c->at < c->size && c->data[c->at] >= '0' && c->data[c->at] <= '9' && value <= limit)
        value = 10 * value + (c->data[c->at++] - '0');
    return c->at > digits && value <= limit ? value : 0;
}

static int read_pixels(bitmap *out, const uint8_t *rgb, size_t count)
{
    out->texels = malloc(4 * count);
    if (!out->texels)
        return 0;
    for (size_t i = 0; i < count; ++i) {
        out->texels[4 * i] = rgb[3 * i];
        out->texels[4 * i + 1] = rgb[3 * i + 1];
        out->texels[4 * i + 2] = rgb[3 * i + 2];
        out->texels[4 * i + 3] = 255;
    }
    return 1;
}

int ppm_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    const int32_t max_side = 1 << 20;
    cursor c = {data, size, 2};
    out->texels = NULL;
    if (size < 2 || data[0] != 'P' || data[1] != '6')
        return report_fail(r, "%s: not a binary PPM: it does not begin with P6", name);
    out->width = read_number(&c, max_side);
    out->height = out->width ? read_number(&c, max_side) : 0;
    if (!out->height)
        return report_fail(r, "%s: no width and height of 1 to %d after P6", name, (int)max_side);
    if (read_number(&c, 65535) != 255)
        return report_fail(r, "%s: the largest value is not 255; convert it to 8 bits a channel", name);
    if (c.at >= size || !is_space(data[c.at]))
        return report_fail(r, "%s: no white space before the pixels at byte %.0f", name, (double)c.at);
    ++c.at;
    uint64_t count = (uint64_t)out->width * (uint64_t)out->height, left = (uint64_t)(size - c.at);
    if (left != 3 * count)
        return report_fail(r, "%s: %.0f bytes of pixels, but %d x %d takes %.0f", name, (double)left, (int)out->width,
                           (int)out->height, 3.0 * (double)count);
    if (4 * count > SIZE_MAX || !read_pixels(out, data + c.at, (size_t)count))
        return report_fail(r, "%s: memory is short for %d x %d pixels", name, (int)out->width, (int)out->height);
    return 1;
}
