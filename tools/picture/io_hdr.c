/* io_hdr.c: reads and writes Radiance HDR: three mantissas and a shared exponent, run-length coded. Reading uses at
 * most 16 MiB and READ_BYTES_PER_BYTE times the file. */
#include "../common/io_bytes.h"
#include "image.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
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

/* --- writing --- */

/* Clamps to the range of the format: negative light and NaN become 0; 255/256 * 2^127 is the largest value. */
static float storable(float v)
{
    const float max = 1.6947656946257677e38f;
    return v > 0.0f ? (v < max ? v : max) : 0.0f;
}

/* Rounds mantissas to nearest: most readers use them directly, without the half step that Radiance's own programs
 * add. */
static void put_rgbe(uint8_t out[4], const float *rgb, int32_t channels)
{
    float c[3], max = 0.0f;
    double unit;
    int exponent, i;

    for (i = 0; i < 3; ++i) {
        c[i] = storable(rgb[channels == 3 ? i : 0]);
        if (c[i] > max) max = c[i];
    }
    memset(out, 0, 4);
    frexp((double)max, &exponent);
    if (max <= 0.0f || exponent < -127) return;
    unit = ldexp(1.0, 8 - exponent);
    if ((double)max * unit >= 255.5) { /* would round to 256 */
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

/* One component of a row, n bytes. Returns the end; writes at most n + n / 128 + 1. */
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

/* Codes the components of a row one after another, from the pixels in `rgbe`; `plane` holds one component. */
static uint8_t *put_coded_row(uint8_t *to, const uint8_t *rgbe, uint8_t *plane, int32_t width)
{
    int32_t x, k;
    *to++ = 2; /* not possible as a pixel: marks coded components */
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

/* The most bytes that `in` can need after the header. */
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

/* --- reading --- */

#define READ_BYTES_FREE     (UINT64_C(16) << 20) /* memory that any file may take ... */
#define READ_BYTES_PER_BYTE 1024                 /* ... and for each byte of it; coded rows need under 200 */

/* `lines` of `length` pixels in the file's order: rows or, if x comes first, columns. */
typedef struct hdr_reader {
    const uint8_t *begin, *at, *end;
    const char *name;
    report *r;
    int has_format;
    double scale[3];  /* multiplies stored values */
    double unit[256]; /* by exponent: value of a mantissa's lowest bit, without scale */
    int32_t lines, length;
    int columns, flip_x, flip_y;
} hdr_reader;

static int hdr_fail(const hdr_reader *h, const char *format, ...) REPORT_PRINTF(2, 3);
static int hdr_fail(const hdr_reader *h, const char *format, ...)
{
    char message[200];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return report_fail(h->r, "%s: byte %.0f: %s", h->name, (double)(h->at - h->begin), message);
}

/* The next line of the header, truncated to `line`; only the first characters of a line matter. */
static int get_line(char line[128], hdr_reader *h)
{
    size_t left = (size_t)(h->end - h->at), n;
    const uint8_t *stop = left ? memchr(h->at, '\n', left) : NULL;
    if (!stop) return hdr_fail(h, "the file ends in its header; get the whole file");
    n = (size_t)(stop - h->at);
    if (n && h->at[n - 1] == '\r') --n;
    if (n > 127) n = 127;
    memcpy(line, h->at, n);
    line[n] = 0;
    h->at = stop + 1;
    return 1;
}

/* Images store a multiplier for each program that brightened them; dividing restores the original values. */
static int divide_out(hdr_reader *h, const char *text, int count)
{
    double v[3];
    char *end;
    int i;
    for (i = 0; i < count; ++i, text = end) {
        v[i] = strtod(text, &end);
        if (end == text || !(v[i] > 1e-30 && v[i] < 1e30))
            return hdr_fail(h, "EXPOSURE and COLORCORR before here need 1 and 3 usable numbers");
    }
    if (text[strspn(text, " \t")]) return hdr_fail(h, "EXPOSURE and COLORCORR before here need 1 and 3 usable numbers");
    for (i = 0; i < 3; ++i) {
        h->scale[i] /= v[count == 3 ? i : 0];
        if (!(h->scale[i] > 1e-60 && h->scale[i] < 1e60)) return hdr_fail(h, "EXPOSURE and COLORCORR leave no picture");
    }
    return 1;
}

static int read_variable(hdr_reader *h, const char *line)
{
    if (strncmp(line, "EXPOSURE=", 9) == 0) return divide_out(h, line + 9, 1);
    if (strncmp(line, "COLORCORR=", 10) == 0) return divide_out(h, line + 10, 3);
    if (strncmp(line, "FORMAT=", 7) != 0) return 1;
    h->has_format = 1;
    return strcmp(line + 7, "32-bit_rle_rgbe") == 0 ||
           hdr_fail(h, "the format before here is not 32-bit_rle_rgbe; convert the picture");
}

/* "-Y 2": *axis 'Y', *minus, and the side, 1 .. 2^28. Returns the rest of the text, or NULL. */
static const char *read_axis(const char *text, char *axis, int *minus, int32_t *side)
{
    uint64_t v = 0;
    if ((text[0] != '-' && text[0] != '+') || (text[1] != 'X' && text[1] != 'Y') || text[2] != ' ') return NULL;
    *minus = text[0] == '-';
    *axis = text[1];
    for (text += 3; *text >= '0' && *text <= '9'; ++text) {
        v = 10 * v + (uint64_t)(*text - '0');
        if (v > PICTURE_MAX_PIXELS) return NULL;
    }
    *side = (int32_t)v;
    return text;
}

/* The first axis is the one that changes from line to line. -Y +X is the usual reading order. */
static int read_resolution(hdr_reader *h, const char *line)
{
    char slow = 0, fast = 0;
    int minus[2] = {0, 0};
    const char *text = read_axis(line, &slow, &minus[0], &h->lines);
    if (text) text = *text == ' ' ? read_axis(text + 1, &fast, &minus[1], &h->length) : NULL;
    if (!text || *text || slow == fast || !picture_fits((uint64_t)h->lines, (uint64_t)h->length))
        return hdr_fail(h, "before here must stand a size such as -Y 512 +X 1024 (1 to 2^28 pixels)");
    h->columns = slow == 'X';
    h->flip_x = minus[h->columns ? 0 : 1];
    h->flip_y = !minus[h->columns ? 1 : 0];
    return 1;
}

static int read_hdr_header(hdr_reader *h)
{
    char line[128];
    if (h->end - h->at < 2 || h->at[0] != '#' || h->at[1] != '?')
        return report_fail(h->r, "%s: not a Radiance HDR file: it does not begin with #?", h->name);
    do {
        if (!get_line(line, h) || !read_variable(h, line)) return 0;
    } while (line[0]);
    if (!h->has_format) return hdr_fail(h, "the header before here has no FORMAT=32-bit_rle_rgbe");
    return get_line(line, h) && read_resolution(h, line);
}

static int get_bytes(const uint8_t **out, hdr_reader *h, size_t n)
{
    *out = h->at;
    if ((size_t)(h->end - h->at) < n) return hdr_fail(h, "the file ends in its pixels; get the whole file");
    h->at += n;
    return 1;
}

/* One component of a coded line into every fourth byte of `to`. */
static int get_runs(uint8_t *to, hdr_reader *h)
{
    int32_t x = 0, n, i;
    const uint8_t *code, *from;
    while (x < h->length) {
        if (!get_bytes(&code, h, 1)) return 0;
        n = *code > 128 ? *code - 128 : *code;
        if (n == 0 || n > h->length - x) return hdr_fail(h, "a run of %d pixels where %d are left", (int)n,
                                                         (int)(h->length - x));
        if (!get_bytes(&from, h, *code > 128 ? 1 : (size_t)n)) return 0;
        for (i = 0; i < n; ++i) to[4 * (size_t)(x + i)] = from[*code > 128 ? 0 : i];
        x += n;
    }
    return 1;
}

/* Pixels without coding, or with the older runs: 1 1 1 n repeats the pixel before n times. Directly after another
 * such run, n counts 256 times as much. */
static int get_plain_line(uint8_t *to, hdr_reader *h)
{
    const uint8_t *pixel;
    int32_t x = 0;
    int shift = 0;
    while (x < h->length) {
        if (!get_bytes(&pixel, h, 4)) return 0;
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            uint64_t n = (uint64_t)pixel[3] << shift;
            if (x == 0) return hdr_fail(h, "a repeated pixel at the beginning of a line");
            if (shift > 24 || n > (uint64_t)(h->length - x)) return hdr_fail(h, "a run longer than its line");
            for (; n > 0; --n, ++x) memcpy(to + 4 * (size_t)x, to + 4 * (size_t)(x - 1), 4);
            shift += 8;
        } else {
            memcpy(to + 4 * (size_t)x++, pixel, 4);
            shift = 0;
        }
    }
    return 1;
}

static int get_line_rgbe(uint8_t *to, hdr_reader *h)
{
    const uint8_t *mark = h->at;
    int k;
    if (h->length < CODED_MIN || h->length > CODED_MAX || h->end - h->at < 4 || mark[0] != 2 || mark[1] != 2 ||
        mark[2] > 127)
        return get_plain_line(to, h);
    if ((mark[2] << 8 | mark[3]) != h->length)
        return hdr_fail(h, "a line of %d pixels in a picture whose lines have %d", mark[2] << 8 | mark[3],
                        (int)h->length);
    h->at += 4;
    for (k = 0; k < 4; ++k)
        if (!get_runs(to + k, h)) return 0;
    return 1;
}

/* Without the half step that Radiance's own programs add, like most readers and hdr_encode. */
static void get_rgbe(float out[3], const uint8_t rgbe[4], const hdr_reader *h)
{
    double v;
    int i;
    for (i = 0; i < 3; ++i) {
        v = rgbe[i] * h->unit[rgbe[3]] * h->scale[i];
        out[i] = v < (double)FLT_MAX ? (float)v : FLT_MAX;
    }
}

static void place_line(image *out, const hdr_reader *h, int32_t line, const uint8_t *rgbe)
{
    int32_t i;
    for (i = 0; i < h->length; ++i) {
        int32_t x = h->columns ? line : i, y = h->columns ? i : line;
        if (h->flip_x) x = out->width - 1 - x;
        if (h->flip_y) y = out->height - 1 - y;
        get_rgbe(out->pixels + 3 * ((size_t)y * (size_t)out->width + (size_t)x), rgbe + 4 * (size_t)i, h);
    }
}

static int read_lines(image *out, hdr_reader *h, uint8_t *rgbe)
{
    int32_t line;
    for (line = 0; line < h->lines; ++line) {
        if (!get_line_rgbe(rgbe, h)) return 0;
        place_line(out, h, line, rgbe);
    }
    return h->at == h->end || hdr_fail(h, "%.0f bytes behind the last pixel; the size is not this picture's",
                                       (double)(h->end - h->at));
}

/* A line needs at least a pixel and, if it is longer, another one or a run. */
static int is_plausible(const hdr_reader *h, uint64_t bytes)
{
    uint64_t left = (uint64_t)(h->end - h->at);
    if ((uint64_t)h->lines * (h->length > 1 ? 8 : 4) > left)
        return hdr_fail(h, "%d lines of %d pixels do not fit the rest of the file; get the whole file", (int)h->lines,
                        (int)h->length);
    return bytes <= READ_BYTES_FREE + READ_BYTES_PER_BYTE * left ||
           hdr_fail(h, "%.0f bytes of pixels, more than %d times the file; it is damaged or made to harm",
                    (double)bytes, READ_BYTES_PER_BYTE);
}

int hdr_decode(image *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    hdr_reader h;
    uint8_t *rgbe = NULL;
    uint64_t bytes; /* under 2^32: fits size_t everywhere */
    int ok, i;

    memset(out, 0, sizeof *out);
    memset(&h, 0, sizeof h);
    for (i = 1; i < 256; ++i) h.unit[i] = ldexp(1.0, i - 136);
    h.begin = h.at = data;
    h.end = size ? data + size : data;
    h.name = name;
    h.r = r;
    h.scale[0] = h.scale[1] = h.scale[2] = 1.0;
    if (!read_hdr_header(&h)) return 0;
    bytes = (uint64_t)h.lines * (uint64_t)h.length * 3 * sizeof(float);
    if (!is_plausible(&h, bytes + 4 * (uint64_t)h.length)) return 0;
    out->width = h.columns ? h.lines : h.length;
    out->height = h.columns ? h.length : h.lines;
    out->channels = 3;
    out->pixels = malloc((size_t)bytes);
    rgbe = malloc(4 * (size_t)h.length);
    ok = out->pixels && rgbe ? read_lines(out, &h, rgbe)
                             : report_fail(r, "%s: out of memory for %.0f bytes", name, (double)bytes);
    free(rgbe);
    if (!ok) image_free(out);
    return ok;
}
