/* io_png_read.c: PNG images from memory, every colour type and depth, as 8-bit RGBA.
 *
 * Memory besides the file: a copy of the image data, the rows (at most 1032 times the image data, the limit of deflate)
 * and the texels (at most 32 times the rows, for 1-bit images), which are allocated after the rows were inflated. That
 * is at most 12 bytes per pixel, and pixels are limited by picture_is_paid: 769 times the file plus 768 MiB. Time is
 * proportional. Bytes after IEND are ignored; anything else that the specification forbids is refused. */
#include "image.h"
#include "io_png.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGBA = 6 };

/* A match of 258 bytes takes at least two bits, one for the length and one for the distance. */
#define DEFLATE_MAX_RATIO 1032u

typedef struct png_chunk {
    size_t at; /* of the length field */
    uint32_t size;
    char type[5];
    const uint8_t *body;
} png_chunk;

typedef struct png_reader {
    const uint8_t *data;
    size_t size;
    const char *name;
    report *r;
    uint32_t width, height, depth, colour, channels;
    int interlaced;
    int split; /* 16-bit greys: both bytes, as red and green */
    uint8_t palette[256][4];
    uint32_t palette_count, palette_stored; /* entries that a pixel can show; entries of PLTE */
    int has_key;         /* there was a tRNS chunk */
    uint32_t key[3];     /* the transparent grey or colour */
    size_t first_idat;   /* offset; 0: none yet */
    uint64_t idat_bytes; /* bodies of all IDAT chunks */
    int idat_over;       /* another chunk followed them */
} png_reader;

/* --- chunks --- */

static int is_letter(uint8_t c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

static int is_type(const png_chunk *c, const char *type)
{
    return memcmp(c->type, type, 4) == 0;
}

/* The chunk at offset `at`, whole and with the right checksum. */
static int read_frame(png_reader *p, png_chunk *c, size_t at)
{
    const uint8_t *frame = p->data + at;
    size_t left = p->size - at;
    int i;

    if (left < PNG_CHUNK_FRAME)
        return report_fail(p->r, "%s: the file ends at byte %zu, inside a chunk or before IEND", p->name, p->size);
    for (i = 0; i < 4; ++i) {
        if (!is_letter(frame[4 + i]))
            return report_fail(p->r, "%s: no chunk begins at byte %zu; the file is damaged", p->name, at);
        c->type[i] = (char)frame[4 + i];
    }
    c->type[4] = 0;
    c->at = at;
    c->size = get_u32_be(frame);
    c->body = frame + 8;
    if (c->size > left - PNG_CHUNK_FRAME)
        return report_fail(p->r, "%s: chunk %s at byte %zu runs past the end of the file", p->name, c->type, at);
    if (png_crc(frame + 4, 4 + (size_t)c->size) != get_u32_be(c->body + c->size))
        return report_fail(p->r, "%s: chunk %s at byte %zu has a wrong checksum; the file is damaged", p->name,
                           c->type, at);
    return 1;
}

static size_t chunk_end(const png_chunk *c)
{
    return c->at + PNG_CHUNK_FRAME + c->size;
}

static int wrong_size(png_reader *p, const png_chunk *c)
{
    return report_fail(p->r, "%s: chunk %s at byte %zu cannot hold %" PRIu32 " bytes", p->name, c->type, c->at,
                       c->size);
}

static int misplaced(png_reader *p, const png_chunk *c)
{
    return report_fail(p->r, "%s: chunk %s at byte %zu may not stand there", p->name, c->type, c->at);
}

/* Samples per pixel of a colour type; 0 if the colour type, or this depth of it, does not exist. */
static uint32_t channels_of(uint32_t colour, uint32_t depth)
{
    int whole = depth == 8 || depth == 16, part = depth == 1 || depth == 2 || depth == 4;
    switch (colour) {
    case GREY: return whole || part ? 1 : 0;
    case PALETTE: return part || depth == 8 ? 1 : 0;
    case GREY_ALPHA: return whole ? 2 : 0;
    case RGB: return whole ? 3 : 0;
    case RGBA: return whole ? 4 : 0;
    default: return 0;
    }
}

static int read_header(png_reader *p, const png_chunk *c)
{
    const uint8_t *b = c->body;
    if (!is_type(c, "IHDR")) return misplaced(p, c);
    if (c->size != PNG_HEADER_BYTES) return wrong_size(p, c);
    p->width = get_u32_be(b);
    p->height = get_u32_be(b + 4);
    p->depth = b[8];
    p->colour = b[9];
    p->interlaced = b[12];
    p->channels = channels_of(p->colour, p->depth);
    if (!picture_fits(p->width, p->height))
        return report_fail(p->r, "%s: %" PRIu32 " x %" PRIu32 " pixels; 1 to 2^28 can be read", p->name, p->width,
                           p->height);
    if (!p->channels)
        return report_fail(p->r, "%s: colour type %" PRIu32 " with %" PRIu32 " bits does not exist", p->name,
                           p->colour, p->depth);
    if (b[10] != 0 || b[11] != 0 || b[12] > 1)
        return report_fail(p->r, "%s: unknown compression %d, filter %d or interlace %d method", p->name, b[10], b[11],
                           b[12]);
    return 1;
}

static int read_palette(png_reader *p, const png_chunk *c)
{
    const uint32_t shown = p->colour == PALETTE ? 1u << p->depth : 256u;
    uint32_t i, count = c->size / 3;
    if (p->colour == GREY || p->colour == GREY_ALPHA || p->palette_count || p->has_key || p->first_idat)
        return misplaced(p, c);
    if (c->size % 3 != 0 || count < 1 || count > 256) return wrong_size(p, c);
    p->palette_stored = count;
    count = count < shown ? count : shown; /* no pixel can show the rest, and other decoders ignore it */
    for (i = 0; i < count; ++i) {
        memcpy(p->palette[i], c->body + 3 * i, 3);
        p->palette[i][3] = 255;
    }
    p->palette_count = count;
    return 1;
}

/* tRNS: alpha for the first palette entries, or the one grey or colour that is transparent. */
static int read_transparency(png_reader *p, const png_chunk *c)
{
    uint32_t i;
    if (p->has_key || p->first_idat || p->colour == GREY_ALPHA || p->colour == RGBA) return misplaced(p, c);
    p->has_key = 1;
    if (p->colour == PALETTE) {
        if (!p->palette_count) return misplaced(p, c);
        if (c->size < 1 || c->size > p->palette_stored) return wrong_size(p, c);
        for (i = 0; i < c->size && i < p->palette_count; ++i) p->palette[i][3] = c->body[i];
        return 1;
    }
    if (c->size != 2 * p->channels) return wrong_size(p, c);
    for (i = 0; i < p->channels; ++i) { /* the bits above the depth mean nothing */
        p->key[i] = ((uint32_t)c->body[2 * i] << 8 | c->body[2 * i + 1]) & ((1u << p->depth) - 1u);
    }
    return 1;
}

static int read_chunk(png_reader *p, const png_chunk *c)
{
    if (is_type(c, "IDAT")) {
        if (p->idat_over || (p->colour == PALETTE && !p->palette_count)) return misplaced(p, c);
        if (!p->first_idat) p->first_idat = c->at;
        p->idat_bytes += c->size;
        return 1;
    }
    if (p->first_idat) p->idat_over = 1;
    if (is_type(c, "PLTE")) return read_palette(p, c);
    if (is_type(c, "tRNS")) return read_transparency(p, c);
    if (is_type(c, "IHDR")) return misplaced(p, c);
    if (c->type[0] >= 'a') return 1; /* ancillary: not needed for the image */
    return report_fail(p->r, "%s: chunk %s at byte %zu is not known, yet needed; save the picture as plain PNG",
                       p->name, c->type, c->at);
}

/* Checks all chunks up to IEND; afterwards IDAT chunks can be read without checks. */
static int read_chunks(png_reader *p)
{
    png_chunk c;
    if (p->size < PNG_SIGNATURE_BYTES || memcmp(p->data, PNG_SIGNATURE, PNG_SIGNATURE_BYTES) != 0)
        return report_fail(p->r, "%s: not a PNG file", p->name);
    if (!read_frame(p, &c, PNG_SIGNATURE_BYTES) || !read_header(p, &c)) return 0;
    for (;;) {
        if (!read_frame(p, &c, chunk_end(&c))) return 0;
        if (is_type(&c, "IEND")) break;
        if (!read_chunk(p, &c)) return 0;
    }
    if (c.size != 0) return wrong_size(p, &c);
    if (!p->first_idat) return report_fail(p->r, "%s: no image data (IDAT) before IEND at byte %zu", p->name, c.at);
    return 1;
}

/* --- rows --- */

/* Interlaced pictures come as seven smaller ones, every dx-th pixel of every dy-th row; others as one. */
typedef struct png_pass {
    uint32_t x0, y0, dx, dy;
    uint32_t width, height; /* of the smaller image; either may be 0, and then it has no bytes */
} png_pass;

static uint32_t pass_count(const png_reader *p)
{
    return p->interlaced ? 7 : 1;
}

static png_pass get_pass(const png_reader *p, uint32_t i)
{
    static const uint8_t grid[8][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                       {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}, {0, 0, 1, 1}};
    const uint8_t *g = grid[p->interlaced ? i : 7];
    png_pass s;
    s.x0 = g[0];
    s.y0 = g[1];
    s.dx = g[2];
    s.dy = g[3];
    s.width = p->width > s.x0 ? (p->width - s.x0 - 1) / s.dx + 1 : 0;
    s.height = p->height > s.y0 ? (p->height - s.y0 - 1) / s.dy + 1 : 0;
    return s;
}

/* Without the filter byte. With at most 2^28 pixels of 64 bits, all rows together stay under 2^31 + 2^28 bytes. */
static size_t row_bytes(const png_reader *p, uint32_t width)
{
    return (size_t)(((uint64_t)width * p->channels * p->depth + 7) / 8);
}

static size_t all_rows_bytes(const png_reader *p)
{
    size_t total = 0;
    uint32_t i;
    for (i = 0; i < pass_count(p); ++i) {
        png_pass s = get_pass(p, i);
        if (s.width > 0) total += s.height * (1 + row_bytes(p, s.width));
    }
    return total;
}

/* Adds the prediction back in place. `step`: bytes between a sample and the same one of the pixel on the left. */
static int unfilter(uint8_t *row, const uint8_t *above, size_t n, size_t step, uint8_t filter)
{
    size_t i, head = step < n ? step : n; /* the first pixel has no left neighbour */
    switch (filter) {
    case PNG_NONE: return 1;
    case PNG_SUB:
        for (i = step; i < n; ++i) row[i] = (uint8_t)(row[i] + row[i - step]);
        return 1;
    case PNG_UP:
        for (i = 0; i < n; ++i) row[i] = (uint8_t)(row[i] + above[i]);
        return 1;
    case PNG_AVERAGE:
        for (i = 0; i < head; ++i) row[i] = (uint8_t)(row[i] + above[i] / 2);
        for (; i < n; ++i) row[i] = (uint8_t)(row[i] + (row[i - step] + above[i]) / 2);
        return 1;
    case PNG_PAETH:
        for (i = 0; i < head; ++i) row[i] = (uint8_t)(row[i] + above[i]);
        for (; i < n; ++i) row[i] = (uint8_t)(row[i] + png_paeth(row[i - step], above[i], above[i - step]));
        return 1;
    default: return 0;
    }
}

/* --- pixels --- */

static uint32_t get_sample(const png_reader *p, const uint8_t *row, size_t i)
{
    size_t bit = i * p->depth;
    if (p->depth == 8) return row[i];
    if (p->depth == 16) return (uint32_t)row[2 * i] << 8 | row[2 * i + 1];
    return row[bit / 8] >> (8 - p->depth - bit % 8) & ((1u << p->depth) - 1u);
}

/* To 8 bits: the high byte of 16; fewer repeat their bits, so that all ones become 255. */
static uint8_t widen(const png_reader *p, uint32_t sample)
{
    switch (p->depth) {
    case 1: return (uint8_t)(sample * 255);
    case 2: return (uint8_t)(sample * 85);
    case 4: return (uint8_t)(sample * 17);
    case 8: return (uint8_t)sample;
    default: return (uint8_t)(sample >> 8);
    }
}

static int put_indexed(const png_reader *p, uint8_t *texel, uint32_t index)
{
    if (index >= p->palette_count) return 0;
    memcpy(texel, p->palette[index], 4);
    return 1;
}

/* Converts pixel `i` of a row to RGBA; returns 0 if there is no such palette entry. */
static int put_texel(const png_reader *p, uint8_t *texel, const uint8_t *row, size_t i)
{
    uint32_t k, s[4] = {0, 0, 0, 0}, colours = p->channels < 3 ? 1 : 3;
    int keyed = p->has_key;

    for (k = 0; k < p->channels; ++k) s[k] = get_sample(p, row, i * p->channels + k);
    if (p->colour == PALETTE) return put_indexed(p, texel, s[0]);
    for (k = 0; k < colours; ++k) keyed = keyed && s[k] == p->key[k];
    for (k = 0; k < 3; ++k) texel[k] = widen(p, s[colours == 1 ? 0 : k]);
    texel[3] = p->channels > colours ? widen(p, s[colours]) : keyed ? 0 : 255;
    return 1;
}

/* Converts a row of whole bytes without a transparent colour, `pitch` from texel to texel: takes the high byte of
 * each sample. */
static void put_bytes(const png_reader *p, uint8_t *texel, size_t pitch, const uint8_t *row, uint32_t n)
{
    const size_t wide = p->depth / 8, all = p->channels * wide, next = p->channels < 3 ? 0 : wide;
    const int has_alpha = p->channels % 2 == 0;
    for (; n > 0; --n, row += all, texel += pitch) {
        texel[0] = row[0];
        texel[1] = row[next];
        texel[2] = row[2 * next];
        texel[3] = has_alpha ? row[all - wide] : 255;
    }
}

/* Writes every dx-th texel from `to` on. Returns 0, with the report set, if there is no such colour. */
static int put_row(png_reader *p, uint8_t *texels, png_pass s, size_t to, const uint8_t *row)
{
    uint32_t x;
    if (p->split) {
        for (x = 0; x < s.width; ++x, to += s.dx) memcpy(texels + 4 * to, row + 2 * (size_t)x, 2);
        return 1;
    }
    if (p->depth >= 8 && p->colour != PALETTE && !p->has_key) {
        put_bytes(p, texels + 4 * to, 4 * (size_t)s.dx, row, s.width);
        return 1;
    }
    for (x = 0; x < s.width; ++x, to += s.dx) {
        if (!put_texel(p, texels + 4 * to, row, x))
            return report_fail(p->r, "%s: pixel %zu, %zu has a colour index outside the palette of %" PRIu32, p->name,
                               to % p->width, to / p->width, p->palette_count);
    }
    return 1;
}

/* Undoes the filters of one pass and spreads the pixels. Returns the end of the rows, or NULL with the report set. */
static uint8_t *unpack_pass(png_reader *p, uint8_t *texels, png_pass s, uint8_t *rows, const uint8_t *zeros)
{
    size_t n = row_bytes(p, s.width), step = p->channels * p->depth < 8 ? 1 : p->channels * p->depth / 8;
    const uint8_t *above = zeros;
    uint32_t y;

    if (s.width == 0) return rows;
    for (y = 0; y < s.height; ++y, above = rows + 1, rows += 1 + n) {
        size_t to = ((size_t)s.y0 + (size_t)y * s.dy) * p->width + s.x0;
        if (!unfilter(rows + 1, above, n, step, rows[0])) {
            report_fail(p->r, "%s: row filter %d does not exist; the file is damaged", p->name, rows[0]);
            return NULL;
        }
        if (!put_row(p, texels, s, to, rows + 1)) return NULL;
    }
    return rows;
}

/* --- the whole --- */

static uint8_t *join_idat(const png_reader *p)
{
    uint8_t *joined = malloc((size_t)p->idat_bytes + 1);
    size_t at = p->first_idat, used = 0;
    while (joined && used < p->idat_bytes) {
        uint32_t n = get_u32_be(p->data + at);
        if (n > 0) memcpy(joined + used, p->data + at + 8, n);
        used += n;
        at += PNG_CHUNK_FRAME + n;
    }
    return joined;
}

/* `zeros` bytes of 0, the row above the first, then all rows as they were filtered. */
static uint8_t *inflate_rows(png_reader *p, size_t zeros, size_t size)
{
    uint8_t *rows, *joined;
    if (size / DEFLATE_MAX_RATIO > p->idat_bytes) {
        report_fail(p->r, "%s: %" PRIu64 " bytes of image data cannot fill %" PRIu32 " x %" PRIu32 " pixels", p->name,
                    p->idat_bytes, p->width, p->height);
        return NULL;
    }
    if (!picture_is_paid(p->width, p->height, p->size)) {
        report_fail(p->r, "%s: %" PRIu32 " x %" PRIu32 " pixels in %zu bytes; beyond 8192 x 8192 it may be 64 a byte;"
                    " save it smaller", p->name, p->width, p->height, p->size);
        return NULL;
    }
    joined = join_idat(p);
    rows = size <= SIZE_MAX - zeros ? malloc(zeros + size) : NULL; /* one row of 2^28 pixels, on a 32-bit machine */
    if (!joined || !rows) {
        report_fail(p->r, "%s: out of memory for %.0f bytes", p->name, (double)zeros + (double)size);
    } else if (inflate_zlib(rows + zeros, size, joined, (size_t)p->idat_bytes)) {
        memset(rows, 0, zeros);
        free(joined);
        return rows;
    } else {
        report_fail(p->r, "%s: image data (IDAT at byte %zu) does not inflate to the %zu bytes of %" PRIu32
                    " x %" PRIu32 " pixels; the file is damaged", p->name, p->first_idat, size, p->width, p->height);
    }
    free(joined);
    free(rows);
    return NULL;
}

static uint8_t *unpack(png_reader *p)
{
    size_t zeros = row_bytes(p, p->width), texel_bytes = (size_t)p->width * p->height * 4;
    uint8_t *rows = inflate_rows(p, zeros, all_rows_bytes(p)), *texels, *next;
    uint32_t i;

    if (!rows) return NULL;
    texels = malloc(texel_bytes);
    if (!texels) report_fail(p->r, "%s: out of memory for %zu bytes", p->name, texel_bytes);
    next = texels ? rows + zeros : NULL;
    for (i = 0; next && i < pass_count(p); ++i) next = unpack_pass(p, texels, get_pass(p, i), next, rows);
    free(rows);
    if (!next) {
        free(texels);
        return NULL;
    }
    return texels;
}

static int decode(bitmap *out, const uint8_t *data, size_t size, int split, const char *name, report *r)
{
    png_reader p;
    memset(out, 0, sizeof *out);
    memset(&p, 0, sizeof p);
    p.data = data;
    p.size = size;
    p.name = name;
    p.r = r;
    p.split = split;
    if (!read_chunks(&p)) return 0;
    if (split && (p.colour != GREY || p.depth != 16))
        return report_fail(r, "%s: not a grey PNG of 16 bits", name);
    out->texels = unpack(&p);
    if (!out->texels) return 0;
    out->width = (int32_t)p.width;
    out->height = (int32_t)p.height;
    return 1;
}

int png_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    return decode(out, data, size, 0, name, r);
}

int png_decode_16(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    return decode(out, data, size, 1, name, r);
}
