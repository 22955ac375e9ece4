/* io_pfm.c: float images as PFM: a text header, then rows of floats from the bottom up. Reading uses as much memory as
 * the file has bytes. */
#include "../common/io_bytes.h"
#include "image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_MAX = 31 };

typedef struct pfm_header {
    int32_t width, height, channels;
    float scale;       /* > 0: multiplies stored values */
    int little_endian;
    size_t bytes;      /* of the header itself */
} pfm_header;

static int is_space(uint8_t c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* Past white space and lines that begin with #, which some programs write. */
static size_t skip_blanks(const uint8_t *data, size_t size, size_t at)
{
    int comment = 0;
    for (; at < size && (comment || is_space(data[at]) || data[at] == '#'); ++at)
        comment = data[at] == '#' || (comment && data[at] != '\n');
    return at;
}

/* The next word of the header, and one white space after it. Returns the offset after both, or 0: none, too long. */
static size_t read_word(char word[WORD_MAX + 1], const uint8_t *data, size_t size, size_t at)
{
    size_t n = 0;
    at = skip_blanks(data, size, at);
    for (; at < size && !is_space(data[at]); ++at) {
        if (n == WORD_MAX || data[at] < 33 || data[at] > 126) return 0;
        word[n++] = (char)data[at];
    }
    word[n] = 0;
    return n > 0 && at < size ? at + 1 : 0;
}

/* A side of a picture: 1 .. 2^28 in decimal digits, else 0. */
static int32_t parse_side(const char *word)
{
    uint64_t v = 0; /* under 2^32 after each digit */
    for (; *word; ++word) {
        if (*word < '0' || *word > '9') return 0;
        v = 10 * v + (uint64_t)(*word - '0');
        if (v > PICTURE_MAX_PIXELS) return 0;
    }
    return (int32_t)v;
}

/* A plain decimal number, not 0, well within the range of float; otherwise 0. */
static float parse_scale(const char *word)
{
    char *end;
    double v;
    if (word[strspn(word, "0123456789+-.eE")]) return 0.0f;
    v = strtod(word, &end);
    return *end == 0 && fabs(v) > 1e-30 && fabs(v) < 1e30 ? (float)v : 0.0f;
}

static int read_header(pfm_header *h, const uint8_t *data, size_t size, const char *name, report *r)
{
    char word[WORD_MAX + 1];
    size_t at = read_word(word, data, size, 0);
    float scale = 0.0f;

    if (!at || is_space(data[0]) || (strcmp(word, "PF") != 0 && strcmp(word, "Pf") != 0))
        return report_fail(r, "%s: not a PFM file", name);
    h->channels = word[1] == 'F' ? 3 : 1;
    at = read_word(word, data, size, at);
    h->width = at ? parse_side(word) : 0;
    if (at) at = read_word(word, data, size, at);
    h->height = at ? parse_side(word) : 0;
    if (at) at = read_word(word, data, size, at);
    if (at) scale = parse_scale(word);
    if (!at || h->width < 1 || h->height < 1 || !picture_fits((uint64_t)h->width, (uint64_t)h->height))
        return report_fail(r, "%s: the header must be PF or Pf, width, height (1 to 2^28 pixels) and scale", name);
    if (scale == 0.0f) return report_fail(r, "%s: the scale '%s' is not a usable number", name, word);
    h->little_endian = scale < 0.0f;
    h->scale = fabsf(scale);
    h->bytes = at;
    return 1;
}

int pfm_figures(float *scale, int *is_little, const uint8_t *data, size_t size)
{
    report unheard = {""};
    pfm_header h;
    memset(&h, 0, sizeof h);
    if (!read_header(&h, data, size, "", &unheard)) return 0;
    *scale = h.scale;
    *is_little = h.little_endian;
    return 1;
}

static float get_float(const uint8_t *p, int little_endian)
{
    uint32_t bits = little_endian ? get_u32_le(p) : get_u32_be(p);
    float v;
    memcpy(&v, &bits, 4);
    return v;
}

static void read_rows(image *out, const pfm_header *h, const uint8_t *from)
{
    size_t n = (size_t)h->width * (size_t)h->channels, i;
    int32_t y;
    for (y = h->height - 1; y >= 0; --y) {
        float *row = out->pixels + (size_t)y * n;
        for (i = 0; i < n; ++i, from += 4) {
            row[i] = get_float(from, h->little_endian);
            if (h->scale != 1.0f) row[i] *= h->scale; /* by 1 would still change the bits of some NaNs */
        }
    }
}

int pfm_decode(image *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    pfm_header h;
    uint64_t need; /* under 2^32: fits size_t everywhere */

    memset(out, 0, sizeof *out);
    memset(&h, 0, sizeof h);
    if (!read_header(&h, data, size, name, r)) return 0;
    need = (uint64_t)h.width * (uint64_t)h.height * (uint64_t)h.channels * 4;
    if (size - h.bytes != need)
        return report_fail(r, "%s: %d x %d pixels take %.0f bytes behind the header, the file has %zu", name,
                           (int)h.width, (int)h.height, (double)need, size - h.bytes);
    out->pixels = malloc((size_t)need);
    if (!out->pixels) return report_fail(r, "%s: out of memory for %zu bytes", name, (size_t)need);
    out->width = h.width;
    out->height = h.height;
    out->channels = h.channels;
    read_rows(out, &h, data + h.bytes);
    return 1;
}

static void write_rows(uint8_t *to, const image *in)
{
    size_t n = (size_t)in->width * (size_t)in->channels, i;
    int32_t y;
    for (y = in->height - 1; y >= 0; --y) {
        const float *row = in->pixels + (size_t)y * n;
        for (i = 0; i < n; ++i, to += 4) {
            uint32_t bits;
            memcpy(&bits, row + i, 4);
            put_u32_le(to, bits);
        }
    }
}

int pfm_encode(file_bytes *out, const image *in, report *r)
{
    char header[40]; /* two numbers of at most 9 digits */
    size_t header_bytes, n;

    out->data = NULL;
    out->size = 0;
    if (in->width < 1 || in->height < 1 || !picture_fits((uint64_t)in->width, (uint64_t)in->height) ||
        (in->channels != 1 && in->channels != 3))
        return report_fail(r, "PFM: cannot write %d x %d pixels of %d floats", (int)in->width, (int)in->height,
                           (int)in->channels);
    snprintf(header, sizeof header, "P%c\n%d %d\n-1.0\n", in->channels == 3 ? 'F' : 'f', (int)in->width,
             (int)in->height);
    header_bytes = strlen(header);
    n = (size_t)in->width * (size_t)in->height * (size_t)in->channels * 4;
    out->data = malloc(header_bytes + n);
    if (!out->data) return report_fail(r, "PFM: out of memory for %zu bytes", header_bytes + n);
    memcpy(out->data, header, header_bytes);
    write_rows(out->data + header_bytes, in);
    out->size = header_bytes + n;
    return 1;
}
