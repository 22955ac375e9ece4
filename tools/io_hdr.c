/* io_hdr.c: float pictures as Radiance HDR: three mantissas and a shared exponent, run-length coded by component. */
#include "image.h"
#include "io_bytes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CODED_MIN = 8, /* rows outside these widths are stored as plain RGBE */
    CODED_MAX = 32767,
    RUN_MIN = 4,   /* shorter runs cost less inside a literal stretch */
    RUN_MAX = 127, /* code 128 + n: one byte, n times */
    LITERAL_MAX = 128
};

/* What the format can say: negative light and NaN are 0; 255/256 * 2^127 is the largest value. */
static float storable(float v)
{
    const float most = 1.6947656946257677e38f;
    return v > 0.0f ? (v < most ? v : most) : 0.0f;
}

/* Mantissas are rounded to nearest: most readers take them as they are, without the half step that Radiance's own
 * programs add back. */
static void put_rgbe(uint8_t out[4], const float *rgb, int32_t channels)
{
    float c[3], most = 0.0f;
    double unit;
    int exponent, i;

    for (i = 0; i < 3; ++i) {
        c[i] = storable(rgb[channels == 3 ? i : 0]);
        if (c[i] > most) most = c[i];
    }
    memset(out, 0, 4);
    frexp((double)most, &exponent);
    if (most <= 0.0f || exponent < -127) return;
    unit = ldexp(1.0, 8 - exponent);
    if ((double)most * unit >= 255.5) { /* would round to 256 */
        ++exponent;
        unit *= 0.5;
    }
    for (i = 0; i < 3; ++i) out[i] = (uint8_t)((double)c[i] * unit + 0.5);
    out[3] = (uint8_t)(exponent + 128);
}

static int32_t run_length(const uint8_t *bytes, int32_t n)
{
    int32_t run = 1;
    while (run < n && run < RUN_MAX && bytes[run] == bytes[0]) ++run;
    return run;
}

/* One component of a row, n bytes. Returns the byte behind; writes at most n + n / 128 + 1. */
static uint8_t *put_runs(uint8_t *to, const uint8_t *bytes, int32_t n)
{
    int32_t at = 0;
    while (at < n) {
        int32_t stop = at, run = 0;
        while (stop < n && stop - at < LITERAL_MAX) {
            run = run_length(bytes + stop, n - stop);
            if (run >= RUN_MIN) break;
            stop += run;
        }
        if (stop - at > LITERAL_MAX) stop = at + LITERAL_MAX;
        if (stop > at) {
            *to++ = (uint8_t)(stop - at);
            memcpy(to, bytes + at, (size_t)(stop - at));
            to += stop - at;
        } else {
            *to++ = (uint8_t)(128 + run);
            *to++ = bytes[at];
            stop += run;
        }
        at = stop;
    }
    return to;
}

/* A row's components, one after another, from its pixels in `rgbe`; `plane` holds one of them. */
static uint8_t *put_coded_row(uint8_t *to, const uint8_t *rgbe, uint8_t *plane, int32_t width)
{
    int32_t x, k;
    *to++ = 2; /* impossible as a pixel: says that coded components follow */
    *to++ = 2;
    *to++ = (uint8_t)(width >> 8);
    *to++ = (uint8_t)width;
    for (k = 0; k < 4; ++k) {
        for (x = 0; x < width; ++x) plane[x] = rgbe[4 * x + k];
        to = put_runs(to, plane, width);
    }
    return to;
}

static uint8_t *put_rows(uint8_t *to, const image *in, uint8_t *rgbe, uint8_t *plane)
{
    const float *from = in->pixels;
    int32_t x, y;
    for (y = 0; y < in->height; ++y) {
        for (x = 0; x < in->width; ++x, from += in->channels) put_rgbe(rgbe + 4 * (size_t)x, from, in->channels);
        if (in->width >= CODED_MIN && in->width <= CODED_MAX) {
            to = put_coded_row(to, rgbe, plane, in->width);
        } else {
            memcpy(to, rgbe, 4 * (size_t)in->width);
            to += 4 * (size_t)in->width;
        }
    }
    return to;
}

/* The most that `in` can take behind the header. */
static uint64_t worst_bytes(const image *in)
{
    uint64_t w = (uint64_t)in->width, row = w < CODED_MIN || w > CODED_MAX ? 4 * w : 4 + 4 * (w + w / LITERAL_MAX + 1);
    return row * (uint64_t)in->height;
}

int hdr_encode(file_bytes *out, const image *in, report *r)
{
    char header[80]; /* 35 fixed characters and two numbers of at most 9 digits */
    size_t header_bytes, n;
    uint8_t *rgbe, *end, *data;

    out->data = NULL;
    out->size = 0;
    if (in->width < 1 || in->height < 1 || !picture_fits((uint64_t)in->width, (uint64_t)in->height) ||
        (in->channels != 1 && in->channels != 3))
        return report_fail(r, "HDR: cannot write %d x %d pixels of %d floats", (int)in->width, (int)in->height,
                           (int)in->channels);
    snprintf(header, sizeof header, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", (int)in->height,
             (int)in->width);
    header_bytes = strlen(header);
    n = (size_t)worst_bytes(in); /* under 2^31: a coded row has at least 8 pixels, of at most 5 bytes each */
    out->data = malloc(header_bytes + n);
    rgbe = malloc((size_t)in->width * 5);
    if (out->data && rgbe) {
        memcpy(out->data, header, header_bytes);
        end = put_rows(out->data + header_bytes, in, rgbe, rgbe + 4 * (size_t)in->width);
        out->size = (size_t)(end - out->data);
        data = realloc(out->data, out->size);
        if (data) out->data = data;
        free(rgbe);
        return 1;
    }
    free(rgbe);
    file_free(out);
    return report_fail(r, "HDR: out of memory for %zu bytes", header_bytes + n);
}
