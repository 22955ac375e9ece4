/* io_ppm_read.c: decodes PPM and PGM files into 8-bit images. */
#include "io_ppm_read.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_bytes.h"

typedef struct ppm_reader {
    const uint8_t *data;
    size_t size, at;
    const char *name;
    report *r;
    uint32_t width, height, max;  /* most: the largest value that a sample may have */
    size_t channels;              /* 1 or 3 */
    int is_text;
} ppm_reader;

static int is_space(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* White space and comments, which run from # to the line's end. */
static void skip_space(ppm_reader *p)
{
    int in_comment = 0;
    for (; p->at < p->size; ++p->at) {
        uint8_t b = p->data[p->at];
        if (in_comment)
            in_comment = b != '\n' && b != '\r';
        else if (b == '#')
            in_comment = 1;
        else if (!is_space(b))
            return;
    }
}

/* A decimal number in 0 .. limit after at least one separator. `limit` at most 2^28, so that a digit more fits. */
static int read_number(uint32_t *out, ppm_reader *p, uint32_t limit)
{
    size_t before = p->at, digits;
    uint32_t value = 0;
    skip_space(p);
    if (p->at == before)
        return 0;
    digits = p->at;
    while (p->at < p->size && p->data[p->at] >= '0' && p->data[p->at] <= '9' && value <= limit)
        value = 10 * value + (uint32_t)(p->data[p->at++] - '0');
    *out = value;
    return p->at > digits && value <= limit;
}

static int read_header(ppm_reader *p)
{
    const uint32_t side = (uint32_t)PICTURE_MAX_PIXELS;
    const uint8_t kind = p->size >= 2 && p->data[0] == 'P' ? p->data[1] : 0;
    if (kind != '2' && kind != '3' && kind != '5' && kind != '6')
        return report_fail(p->r, "%s: not a PPM or PGM file: it does not begin with P2, P3, P5 or P6", p->name);
    p->channels = kind == '2' || kind == '5' ? 1 : 3;
    p->is_text = kind < '4';
    p->at = 2;
    if (!read_number(&p->width, p, side) || !read_number(&p->height, p, side) || !picture_fits(p->width, p->height))
        return report_fail(p->r, "%s: after P%c must stand width and height, together 1 to 2^28 pixels", p->name, kind);
    if (!read_number(&p->max, p, 65535) || p->max == 0)
        return report_fail(p->r, "%s: no largest value of 1 to 65535 after the size", p->name);
    return 1;
}

/* Checks that a file of this length can hold the samples; a text sample needs a digit and a separator. */
static int check_length(ppm_reader *p)
{
    const uint64_t left = p->size - p->at, samples = (uint64_t)p->width * p->height * p->channels;
    const uint64_t need = samples * (p->is_text || p->max > 255 ? 2 : 1);
    if (p->is_text ? left < need : left != need)
        return report_fail(p->r, "%s: %" PRIu64 " bytes of pixels, but %" PRIu32 " x %" PRIu32 " take %s%" PRIu64,
                           p->name, left, p->width, p->height, p->is_text ? "at least " : "", need);
    return 1;
}

static int read_sample(uint32_t *out, ppm_reader *p)
{
    if (p->is_text)
        return read_number(out, p, p->max);
    *out = p->data[p->at++];
    if (p->max > 255)
        *out = *out << 8 | p->data[p->at++];
    return *out <= p->max;
}

static uint8_t code_of(uint32_t sample, uint32_t max)
{
    if (max == 65535)
        return (uint8_t)(sample >> 8);
    return (uint8_t)((sample * 255 + max / 2) / max);
}

static int read_texels(uint8_t *texels, ppm_reader *p)
{
    const size_t count = (size_t)p->width * p->height;
    for (size_t i = 0; i < count; ++i) {
        uint8_t *to = texels + 4 * i;
        for (size_t k = 0; k < p->channels; ++k) {
            uint32_t sample;
            if (!read_sample(&sample, p))
                return report_fail(p->r, "%s: pixel %zu, %zu: no value of 0 to %" PRIu32 " before byte %zu", p->name,
                                   i % p->width, i / p->width, p->max, p->at);
            to[k] = code_of(sample, p->max);
        }
        if (p->channels == 1)
            to[1] = to[2] = to[0];
        to[3] = 255;
    }
    if (p->is_text)
        skip_space(p);
    return p->at == p->size || report_fail(p->r, "%s: more behind the last pixel, at byte %zu; one picture is read",
                                           p->name, p->at);
}

int ppm_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    ppm_reader p = {data, size, 0, name, r, 0, 0, 0, 0, 0};
    memset(out, 0, sizeof *out);
    if (!read_header(&p))
        return 0;
    if (!p.is_text && (p.at >= size || !is_space(data[p.at])))
        return report_fail(r, "%s: no white space before the pixels at byte %zu", name, p.at);
    p.at += !p.is_text;
    if (!check_length(&p))
        return 0;
    out->texels = malloc((size_t)p.width * p.height * 4); /* at most 2^30 */
    if (!out->texels)
        return report_fail(r, "%s: memory is short for %" PRIu32 " x %" PRIu32 " pixels", name, p.width, p.height);
    if (!read_texels(out->texels, &p)) {
        bitmap_free(out);
        return 0;
    }
    out->width = (int32_t)p.width;
    out->height = (int32_t)p.height;
    return 1;
}
