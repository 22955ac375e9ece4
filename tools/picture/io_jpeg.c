/* io_jpeg.c: JPEG images from memory, sequential or progressive, as RGBA: markers, tables and the frame.
 *
 * Memory besides the file: samples and texels, and coefficients for progressive images. A block takes at least two bits
 * of the file (one if progressive), fills up to 1024 / 9 pixels (three components of 4 x 1, 1 x 4 and 1 x 1) and needs
 * 64 bytes of samples and 128 of coefficients. In total at most 2080 times the file, progressive 5184 times; and
 * because of picture_is_paid, at most 1024 times the file plus 1024 MiB (16 bytes per pixel of four components, without
 * the padding of narrow images). Files too short for their blocks are refused before anything is allocated. Bytes after
 * EOI are ignored. Time is proportional to pixels, bits and JPEG_IDLE_BLOCKS. */
#include "io_jpeg.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_bytes.h"

enum {
    SOF0 = 0xC0, SOF1 = 0xC1, SOF2 = 0xC2, DHT = 0xC4, JPG = 0xC8, DAC = 0xCC, SOF15 = 0xCF, RST0 = 0xD0, SOI = 0xD8,
    EOI = 0xD9, SOS = 0xDA, DQT = 0xDB, DNL = 0xDC, DRI = 0xDD, APP0 = 0xE0, APP14 = 0xEE, COM = 0xFE
};

/* The body of a marker segment, after the length. */
typedef struct jpeg_segment {
    size_t at; /* of the marker */
    int marker;
    const uint8_t *body;
    size_t size;
} jpeg_segment;

static uint32_t get_u16_be(const uint8_t *p)
{
    return (uint32_t)p[0] << 8 | p[1];
}

static int wrong_size(jpeg_reader *j, const jpeg_segment *s)
{
    return report_fail(j->r, "%s: marker %02X at byte %zu cannot hold %zu bytes; the file is damaged", j->name,
                       (unsigned)s->marker, s->at, s->size);
}

static int wrong_content(jpeg_reader *j, const jpeg_segment *s, const char *what)
{
    return report_fail(j->r, "%s: marker %02X at byte %zu: %s; the file is damaged", j->name, (unsigned)s->marker,
                       s->at, what);
}

/* Reads the marker at j->at, perhaps after fill bytes, and the body; moves j->at behind both. */
static int read_segment(jpeg_reader *j, jpeg_segment *s)
{
    size_t at = j->at;
    memset(s, 0, sizeof *s);
    while (j->size - at > 2 && j->data[at] == 0xFF && j->data[at + 1] == 0xFF) ++at;
    if (j->size - at < 2)
        return report_fail(j->r, "%s: the file ends at byte %zu, before EOI; it is truncated", j->name, j->size);
    s->at = at;
    s->marker = j->data[at + 1];
    if (j->data[at] != 0xFF || s->marker < SOF0 || (s->marker >= RST0 && s->marker <= SOI))
        return report_fail(j->r, "%s: no marker that may stand at byte %zu; the file is damaged", j->name, at);
    j->at = at + 2;
    if (s->marker == EOI) return 1;
    if (j->size - j->at < 2 || get_u16_be(j->data + j->at) > j->size - j->at)
        return report_fail(j->r, "%s: marker %02X at byte %zu runs past the end of the file", j->name,
                           (unsigned)s->marker, at);
    if (get_u16_be(j->data + j->at) < 2) return wrong_content(j, s, "its length is less than 2");
    s->body = j->data + j->at + 2;
    s->size = get_u16_be(j->data + j->at) - 2;
    j->at += 2 + s->size;
    return 1;
}

/* --- tables --- */

static int read_quant(jpeg_reader *j, const jpeg_segment *s)
{
    size_t at = 0;
    uint32_t k, v;
    while (at < s->size) {
        uint32_t wide = s->body[at] >> 4, id = s->body[at] & 15;
        if (wide > 1 || id >= JPEG_TABLES) return wrong_content(j, s, "no such quantization table");
        if (s->size - at < 1 + 64 * (1 + (size_t)wide)) return wrong_size(j, s);
        for (++at, k = 0; k < 64; ++k, at += 1 + wide) {
            v = wide ? get_u16_be(s->body + at) : s->body[at];
            if (v == 0) return wrong_content(j, s, "a quantizer is 0");
            j->quant[id][jpeg_zigzag[k]] = (uint16_t)v;
        }
    }
    return 1;
}

/* The canonical code with counts[n - 1] codes of n bits; 0 if n bits cannot distinguish so many. */
static int build_code(jpeg_code *c, const uint8_t counts[16], const uint8_t *symbols, uint32_t total)
{
    uint32_t length, code = 0, index = 0, i;
    memset(c, 0, sizeof *c);
    memcpy(c->symbols, symbols, total);
    for (length = 1; length <= 16; ++length, code *= 2) {
        c->offset[length] = (int32_t)index - (int32_t)code;
        for (i = 0; i < counts[length - 1]; ++i, ++index, ++code) {
            uint32_t spare = JPEG_QUICK_BITS - length, k;
            if (code >> length) return 0;
            if (length > JPEG_QUICK_BITS) continue;
            for (k = 0; k < 1u << spare; ++k)
                c->quick[(code << spare) + k] = (uint16_t)(length << 8 | c->symbols[index]);
        }
        c->limit[length] = code;
    }
    c->is_defined = 1;
    return 1;
}

static int read_codes(jpeg_reader *j, const jpeg_segment *s)
{
    size_t at = 0;
    uint32_t i, total;
    while (at < s->size) {
        uint32_t kind = s->body[at] >> 4, id = s->body[at] & 15;
        if (kind > 1 || id >= JPEG_TABLES) return wrong_content(j, s, "no such Huffman table");
        if (s->size - at < 17) return wrong_size(j, s);
        for (total = 0, i = 1; i <= 16; ++i) total += s->body[at + i];
        if (total < 1 || total > 256) return wrong_content(j, s, "a Huffman code has 1 to 256 symbols");
        if (s->size - at - 17 < total) return wrong_size(j, s);
        if (!build_code(kind ? &j->ac[id] : &j->dc[id], s->body + at + 1, s->body + at + 17, total))
            return wrong_content(j, s, "more Huffman codes than their bits can tell apart");
        at += 17 + total;
    }
    return 1;
}

/* --- frame --- */

/* Names the frame types of other coding methods. */
static int other_method(jpeg_reader *j, int marker)
{
    const char *what = marker == 0xC3 ? "lossless" : marker < JPG ? "hierarchical"
                       : marker == JPG ? "a JPEG extension" : "arithmetic-coded";
    return report_fail(j->r, "%s: a JPEG that is %s (marker %02X) is not read; save it as a common JPEG or a PNG",
                       j->name, what, (unsigned)marker);
}

static int read_component(jpeg_reader *j, const jpeg_segment *s, uint32_t i)
{
    const uint8_t *b = s->body + 6 + 3 * i;
    jpeg_component *c = &j->components[i];
    uint32_t k;
    c->id = b[0];
    c->h = b[1] >> 4;
    c->v = b[1] & 15;
    c->table = b[2];
    for (k = 0; k < i; ++k) {
        if (j->components[k].id == c->id) return wrong_content(j, s, "two components have the same name");
    }
    if (c->h < 1 || c->h > 4 || c->v < 1 || c->v > 4 || c->table >= JPEG_TABLES)
        return wrong_content(j, s, "a sampling factor or a table does not exist");
    if (c->h == 3 || c->v == 3)
        return report_fail(j->r, "%s: sampling factor 3 is not read, only 1, 2 and 4; convert it to 4:2:0", j->name);
    if (j->count == 1) c->h = c->v = 1; /* factors mean nothing for a single component */
    if (c->h > j->h_max) j->h_max = c->h;
    if (c->v > j->v_max) j->v_max = c->v;
    memset(c->known, -1, sizeof c->known);
    return 1;
}

/* Allocates samples and coefficients of a component. The file was found long enough for the blocks. */
static int place_component(jpeg_reader *j, jpeg_component *c)
{
    size_t bytes = (size_t)c->blocks_x * c->blocks_y * 64;
    int fits = !j->progressive || bytes <= SIZE_MAX / sizeof *c->coefficients;
    c->samples = calloc(bytes, 1);
    if (j->progressive && fits) c->coefficients = calloc(bytes, sizeof *c->coefficients);
    if (!c->samples || (j->progressive && !c->coefficients))
        return report_fail(j->r, "%s: out of memory for %zu bytes", j->name, bytes);
    return 1;
}

static int place_components(jpeg_reader *j)
{
    uint64_t blocks = 0;
    uint32_t i;
    for (i = 0; i < j->count; ++i) {
        jpeg_component *c = &j->components[i];
        c->width = (j->width * c->h + j->h_max - 1) / j->h_max;
        c->height = (j->height * c->v + j->v_max - 1) / j->v_max;
        c->blocks_x = (c->width + 7) / 8;
        c->blocks_y = (c->height + 7) / 8;
        blocks += (uint64_t)c->blocks_x * c->blocks_y;
    }
    if (blocks * (j->progressive ? 1 : 2) > (uint64_t)(j->size - j->at) * 8)
        return report_fail(j->r, "%s: %zu bytes of image data cannot fill %" PRIu32 " x %" PRIu32 " pixels", j->name,
                           j->size - j->at, j->width, j->height);
    for (i = 0; i < j->count; ++i) {
        if (!place_component(j, &j->components[i])) return 0;
    }
    return 1;
}

/* Reads the number of components and pixels; refuses unsupported ones by name. */
static int read_shape(jpeg_reader *j, const jpeg_segment *s)
{
    const uint8_t *b = s->body;
    if (s->size < 6 || s->size != 6 + 3 * (size_t)b[5]) return wrong_size(j, s);
    if (b[0] != 8)
        return report_fail(j->r, "%s: %d bits a sample are not read, only 8; convert it to 8 bits", j->name, b[0]);
    if (b[5] != 1 && b[5] != 3 && b[5] != 4)
        return report_fail(j->r, "%s: %d components are not read; convert it to grey or RGB", j->name, b[5]);
    j->height = get_u16_be(b + 1);
    j->width = get_u16_be(b + 3);
    if (j->height == 0)
        return report_fail(j->r, "%s: the height is not in the header (it may come later, as DNL), which is not read;"
                           " save it again", j->name);
    if (!picture_fits(j->width, j->height))
        return report_fail(j->r, "%s: %" PRIu32 " x %" PRIu32 " pixels; 1 to 2^28 can be read", j->name, j->width,
                           j->height);
    if (!picture_is_paid(j->width, j->height, j->size))
        return report_fail(j->r, "%s: %" PRIu32 " x %" PRIu32 " pixels in %zu bytes; beyond 8192 x 8192 it may be 64 a"
                           " byte; save it smaller", j->name, j->width, j->height, j->size);
    return 1;
}

static int read_frame(jpeg_reader *j, const jpeg_segment *s)
{
    uint32_t i;
    if (j->count > 0) return wrong_content(j, s, "a second frame");
    if (!read_shape(j, s)) return 0;
    j->progressive = s->marker == SOF2;
    j->count = s->body[5];
    for (i = 0; i < j->count; ++i) {
        if (!read_component(j, s, i)) return 0;
    }
    return place_components(j);
}

/* --- scans --- */

/* Reads the coefficients and bits that the scan refines; the bits before must exist, and only once. */
static int read_band(jpeg_reader *j, const jpeg_segment *s)
{
    const uint8_t *b = s->body + 1 + 2 * j->scan_count;
    uint32_t i, k;
    j->first = b[0];
    j->last = b[1];
    j->high = b[2] >> 4;
    j->low = b[2] & 15;
    if (j->progressive ? j->first > j->last || j->last > 63 || (j->first == 0 && j->last > 0) || j->low > 13 ||
                             (j->first > 0 && j->scan_count > 1) || (j->high > 0 && j->high != j->low + 1)
                       : j->first != 0 || j->last != 63 || j->high != 0 || j->low != 0)
        return wrong_content(j, s, "no such part of a picture");
    for (i = 0; i < j->scan_count; ++i) {
        jpeg_component *c = j->scan[i];
        if (j->first > 0 && c->known[0] < 0) return wrong_content(j, s, "details before the mean (DC)");
        for (k = j->first; k <= j->last; ++k) {
            if (c->known[k] != (j->high ? (int)j->high : -1))
                return wrong_content(j, s, "a part that was there, or lacks the one before it");
            c->known[k] = (int8_t)j->low;
        }
    }
    return 1;
}

/* Takes the current tables for the scan's i-th component. */
static int take_tables(jpeg_reader *j, const jpeg_segment *s, uint32_t i)
{
    uint32_t tables = s->body[2 + 2 * i];
    jpeg_component *c = j->scan[i];
    int needs_dc = j->first == 0 && j->high == 0, needs_ac = j->last > 0;
    if (tables >> 4 >= JPEG_TABLES || (tables & 15) >= JPEG_TABLES)
        return wrong_content(j, s, "no such Huffman table");
    c->dc = &j->dc[tables >> 4];
    c->ac = &j->ac[tables & 15];
    if ((needs_dc && !c->dc->is_defined) || (needs_ac && !c->ac->is_defined))
        return wrong_content(j, s, "its Huffman table is not there");
    if (!needs_dc) return 1; /* not the component's first */
    if (j->quant[c->table][0] == 0) return wrong_content(j, s, "its quantization table is not there");
    memcpy(c->quant, j->quant[c->table], sizeof c->quant);
    return 1;
}

static int find_component(jpeg_reader *j, const jpeg_segment *s, uint32_t i)
{
    uint32_t k;
    j->scan[i] = NULL;
    for (k = 0; k < j->count; ++k) {
        if (j->components[k].id == s->body[1 + 2 * i]) j->scan[i] = &j->components[k];
    }
    for (k = 0; k < i; ++k) {
        if (j->scan[k] == j->scan[i]) return wrong_content(j, s, "one component twice");
    }
    return j->scan[i] ? 1 : wrong_content(j, s, "a component that the frame has not");
}

static int read_scan(jpeg_reader *j, const jpeg_segment *s)
{
    uint32_t i, blocks = 0;
    if (j->count == 0) return wrong_content(j, s, "a scan before the frame");
    if (s->size < 1 || s->body[0] < 1 || s->body[0] > j->count || s->size != 4 + 2 * (size_t)s->body[0])
        return wrong_size(j, s);
    j->scan_count = s->body[0];
    for (i = 0; i < j->scan_count; ++i) {
        if (!find_component(j, s, i)) return 0;
        blocks += j->scan[i]->h * j->scan[i]->v;
    }
    if (j->scan_count > 1 && blocks > 10) return wrong_content(j, s, "more than 10 blocks in turn");
    if (!read_band(j, s)) return 0;
    for (i = 0; i < j->scan_count; ++i) {
        if (!take_tables(j, s, i)) return 0;
    }
    return jpeg_scan(j);
}

/* --- the whole --- */

static void read_application(jpeg_reader *j, const jpeg_segment *s)
{
    if (s->marker == APP0 + 1 && j->note == NULL) j->note = jpeg_exif_note(s->body, s->size);
    if (s->marker == APP0 && s->size >= 5 && memcmp(s->body, "JFIF", 5) == 0) j->is_jfif = 1;
    if (s->marker == APP14 && s->size >= 12 && memcmp(s->body, "Adobe", 5) == 0) j->adobe = s->body[11];
}

static int read_marker(jpeg_reader *j, const jpeg_segment *s)
{
    if (s->marker == DHT) return read_codes(j, s);
    if (s->marker == DQT) return read_quant(j, s);
    if (s->marker == SOS) return read_scan(j, s);
    if (s->marker >= SOF0 && s->marker <= SOF2) return read_frame(j, s);
    if (s->marker <= SOF15) return other_method(j, s->marker);
    if (s->marker == DRI) {
        if (s->size != 2) return wrong_size(j, s);
        j->restart = get_u16_be(s->body);
        return 1;
    }
    if (s->marker >= APP0 && s->marker < APP0 + 16) read_application(j, s);
    if ((s->marker >= APP0 && s->marker < APP0 + 16) || s->marker == COM) return 1;
    return wrong_content(j, s, s->marker == DNL ? "a height (DNL) where one is known" : "it means nothing here");
}

static int read_markers(jpeg_reader *j)
{
    jpeg_segment s;
    uint32_t i;
    if (!is_jpeg(j->data, j->size)) return report_fail(j->r, "%s: not a JPEG file", j->name);
    j->at = 2;
    for (;;) {
        if (!read_segment(j, &s)) return 0;
        if (s.marker == EOI) break;
        if (!read_marker(j, &s)) return 0;
    }
    if (j->count == 0) return wrong_content(j, &s, "no frame before the end");
    for (i = 0; i < j->count; ++i) {
        if (j->components[i].known[0] < 0) return wrong_content(j, &s, "no scan of a component before the end");
    }
    return 1;
}

/* JFIF means YCbCr; else Adobe's transform 0, or components named R G B, mean RGB. With four components, all
 * of Adobe's transforms but 0 mean YCCK. */
static int is_ycc(const jpeg_reader *j)
{
    const jpeg_component *c = j->components;
    if (j->count == 1) return 0;
    if (j->count == 4) return j->adobe > 0;
    if (j->is_jfif) return 1;
    return j->adobe >= 0 ? j->adobe != 0 : !(c[0].id == 'R' && c[1].id == 'G' && c[2].id == 'B');
}

/* The blocks of progressive pictures, now that all their coefficients are there. */
static void transform_coefficients(jpeg_reader *j)
{
    uint32_t i, x, y;
    for (i = 0; j->progressive && i < j->count; ++i) {
        const jpeg_component *c = &j->components[i];
        size_t stride = (size_t)c->blocks_x * 8;
        for (y = 0; y < c->blocks_y; ++y) {
            for (x = 0; x < c->blocks_x; ++x)
                jpeg_inverse_dct(c->samples + (y * stride + x) * 8, stride,
                                 c->coefficients + ((size_t)y * c->blocks_x + x) * 64, c->quant);
        }
    }
}

static uint8_t *make_texels(jpeg_reader *j)
{
    size_t bytes = (size_t)j->width * j->height * 4;
    uint8_t *texels = malloc(bytes), *rows = malloc(JPEG_COMPONENTS * ((size_t)j->width + 4));
    if (texels && rows) {
        transform_coefficients(j);
        jpeg_colour_rows(texels, j, is_ycc(j), rows);
    } else {
        report_fail(j->r, "%s: out of memory for %zu bytes", j->name, bytes);
        free(texels);
        texels = NULL;
    }
    free(rows);
    return texels;
}

int jpeg_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    jpeg_reader j;
    uint32_t i;
    memset(out, 0, sizeof *out);
    memset(&j, 0, sizeof j);
    j.data = data;
    j.size = size;
    j.name = name;
    j.r = r;
    j.adobe = -1;
    j.idle = JPEG_IDLE_BLOCKS + 32 * (uint64_t)size;
    if (read_markers(&j)) out->texels = make_texels(&j);
    for (i = 0; i < JPEG_COMPONENTS; ++i) {
        free(j.components[i].samples);
        free(j.components[i].coefficients);
    }
    if (!out->texels) return 0;
    out->width = (int32_t)j.width;
    out->height = (int32_t)j.height;
    out->note = j.note;
    return 1;
}
