/* picture_read.c: reads any image file, recognized by content; suggests converters for formats that are not read. */
#include "picture_read.h"

#include <string.h>

#include "../common/progress.h"
#include "io_jpeg.h"
#include "io_pam.h"
#include "io_png.h"
#include "io_ppm_read.h"

/* --- kinds that are read --- */

typedef struct picture_kind {
    const char *format;
    int (*begins)(const uint8_t *data, size_t size);
    int (*read_codes)(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);
    int (*read_light)(image *out, const uint8_t *data, size_t size, const char *name, report *r);
} picture_kind;

/* The first half of the signature. The rest detects a transfer as text, which png_decode reports. */
static int is_png(const uint8_t *data, size_t size) { return size >= 4 && memcmp(data, PNG_SIGNATURE, 4) == 0; }

static int is_grey_map(const uint8_t *data, size_t size)
{
    return is_ppm(data, size) && (data[1] == '2' || data[1] == '5');
}

static int is_pfm(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == 'F' || data[1] == 'f') &&
           (data[2] == ' ' || (data[2] >= '\t' && data[2] <= '\r'));
}

static int is_hdr(const uint8_t *data, size_t size) { return size >= 2 && data[0] == '#' && data[1] == '?'; }

static const picture_kind kinds[] = {
    {"PNG", is_png, png_decode, NULL},
    {"JPEG", is_jpeg, jpeg_decode, NULL},
    {"PGM", is_grey_map, ppm_decode, NULL},
    {"PPM", is_ppm, ppm_decode, NULL},
    {"PAM", is_pam, pam_decode, NULL},
    {"PFM", is_pfm, NULL, pfm_decode},
    {"HDR", is_hdr, NULL, hdr_decode},
};

static const picture_kind *kind_of(const uint8_t *data, size_t size)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; ++i)
        if (kinds[i].begins(data, size))
            return &kinds[i];
    return NULL;
}

/* --- kinds that are known by name --- */

typedef struct foreign_kind {
    const char *format;
    const char *magic; /* at the start of the file; a ? matches any byte */
    size_t size;       /* of the magic */
    const char *advice;
} foreign_kind;

#define MAGIC(text) text, sizeof(text) - 1

static const foreign_kind foreign_kinds[] = {
    {"WebP", MAGIC("RIFF????WEBP"), "dwebp in.webp -o out.png"},
    {"AVIF", MAGIC("????ftypavif"), "avifdec in.avif out.png"},
    {"AVIF", MAGIC("????ftypavis"), "avifdec in.avif out.png"},
    {"HEIF", MAGIC("????ftypheic"), "heif-convert in.heic out.png"},
    {"HEIF", MAGIC("????ftypmif1"), "heif-convert in.heic out.png"},
    {"JPEG XL", MAGIC("\xFF\x0A"), "djxl in.jxl out.png"},
    {"JPEG XL", MAGIC("\0\0\0\x0CJXL "), "djxl in.jxl out.png"},
    {"JPEG 2000", MAGIC("\0\0\0\x0CjP  "), "opj_decompress -i in.jp2 -o out.png"},
    {"JPEG 2000", MAGIC("\xFF\x4F\xFF\x51"), "opj_decompress -i in.j2k -o out.png"},
    {"KTX2", MAGIC("\xABKTX 20\xBB"), "ktx extract --transcode rgba8 in.ktx2 out.png"},
    {"KTX", MAGIC("\xABKTX 11\xBB"), "ktx2ktx2 -o out.ktx2 in.ktx, then ktx extract out.ktx2 out.png"},
    {"Basis Universal", MAGIC("sB\x13\0"), "basisu -unpack in.basis"},
    {"DDS", MAGIC("DDS "), "magick in.dds out.png"},
    {"OpenEXR", MAGIC("\x76\x2F\x31\x01"), "oiiotool in.exr -o out.hdr"},
    {"TIFF", MAGIC("II*\0"), "magick in.tif out.png"},
    {"TIFF", MAGIC("MM\0*"), "magick in.tif out.png"},
    {"GIF", MAGIC("GIF8"), "magick in.gif[0] out.png"},
    {"BMP", MAGIC("BM????\0\0\0\0"), "magick in.bmp out.png"},
    {"Photoshop", MAGIC("8BPS"), "magick in.psd[0] out.png"},
    {"QOI", MAGIC("qoif"), "magick in.qoi out.png"},
    {"PBM", MAGIC("P1\n"), "pnmtopng in.pbm > out.png"},
    {"PBM", MAGIC("P4\n"), "pnmtopng in.pbm > out.png"},
    {"PBM", MAGIC("P1 "), "pnmtopng in.pbm > out.png"},
    {"PBM", MAGIC("P4 "), "pnmtopng in.pbm > out.png"},
};

/* TGA has no magic at the start, but most files have one at the end. */
static const foreign_kind tga = {"TGA", MAGIC("TRUEVISION-XFILE.\0"), "magick in.tga out.png"};

static int is_magic(const foreign_kind *f, const uint8_t *data)
{
    for (size_t i = 0; i < f->size; ++i)
        if (f->magic[i] != '?' && (uint8_t)f->magic[i] != data[i])
            return 0;
    return 1;
}

static const foreign_kind *foreign_kind_of(const uint8_t *data, size_t size)
{
    for (size_t i = 0; i < sizeof foreign_kinds / sizeof foreign_kinds[0]; ++i)
        if (size >= foreign_kinds[i].size && is_magic(&foreign_kinds[i], data))
            return &foreign_kinds[i];
    return size >= tga.size && is_magic(&tga, data + size - tga.size) ? &tga : NULL;
}

static int refuse(const uint8_t *data, size_t size, const char *name, report *r)
{
    const foreign_kind *f = foreign_kind_of(data, size);
    if (size == 0)
        return report_fail(r, "%s: the file is empty (0 bytes); export or copy it again", name);
    if (f)
        return report_fail(r, "%s: this picture is %s, which is not read; convert it, for example: %s", name, f->format,
                           f->advice);
    return report_fail(r, "%s: not a PNG, JPEG, PPM, PGM, PAM, PFM or Radiance HDR picture, by its first bytes", name);
}

/* --- channels --- */

static int has_holes(const bitmap *map)
{
    const size_t pixels = (size_t)map->width * (size_t)map->height;
    for (size_t i = 0; i < pixels; ++i)
        if (map->texels[4 * i + 3] != 255)
            return 1;
    return 0;
}

/* Byte 25 of a decoded PNG is the colour type: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA. A colour or
 * palette entry that tRNS makes transparent adds an alpha channel if a pixel shows it. */
static int32_t png_channels(const uint8_t *data, const bitmap *map)
{
    const int type = data[25], colours = type == 0 || type == 4 ? 1 : 3;
    return colours + (type >= 4 || has_holes(map));
}

/* The frame header (SOF0 to SOF2) of data that begins like a JPEG: at the marker and 10 bytes long; NULL: none
 * found. Fill bytes may precede a marker. */
static const uint8_t *jpeg_frame(const uint8_t *data, size_t size)
{
    size_t at = 2;
    while (size - at >= 10) {
        if (data[at + 1] == 0xFF) {
            ++at;
        } else if (data[at + 1] >= 0xC0 && data[at + 1] <= 0xC2) {
            return data + at;
        } else {
            const size_t skip = 2 + ((size_t)data[at + 2] << 8 | data[at + 3]);
            if (skip > size - at)
                break;
            at += skip;
        }
    }
    return NULL;
}

/* The number of components in the frame header of a decoded file. */
static int32_t jpeg_channels(const uint8_t *data, size_t size)
{
    const uint8_t *frame = jpeg_frame(data, size);
    return frame ? frame[9] : 3;
}

static int32_t code_channels(const picture_kind *kind, const uint8_t *data, size_t size, const bitmap *map)
{
    if (kind->read_codes == png_decode)
        return png_channels(data, map);
    if (kind->read_codes == pam_decode)
        return pam_channels(data, size);
    return kind->read_codes == jpeg_decode ? jpeg_channels(data, size) : is_grey_map(data, size) ? 1 : 3;
}

/* --- the whole --- */

int picture_begins(const uint8_t *data, size_t size)
{
    return kind_of(data, size) != NULL || foreign_kind_of(data, size) != NULL;
}

int picture_read(stored_picture *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    const picture_kind *kind = kind_of(data, size);
    memset(out, 0, sizeof *out);
    if (!kind)
        return refuse(data, size, name, r);
    out->format = kind->format;
    if (kind->read_light) {
        if (!kind->read_light(&out->light, data, size, name, r))
            return 0;
        out->width = out->light.width;
        out->height = out->light.height;
        out->channels = out->light.channels;
        return 1;
    }
    if (!kind->read_codes(&out->codes, data, size, name, r))
        return 0;
    if (out->codes.note != NULL)
        report_note(progress_is_quiet(), "note: %s: %s", name, out->codes.note);
    out->width = out->codes.width;
    out->height = out->codes.height;
    out->channels = code_channels(kind, data, size, &out->codes);
    srgb_table(out->light_of);
    return 1;
}

/* Counts possible scans of a JPEG: entropy-coded data never contains these two bytes in a row. */
static uint64_t count_scans(const uint8_t *data, size_t size)
{
    const uint8_t *at = data, *end = data + size;
    uint64_t scans = 0;
    while (end - at > 1 && (at = memchr(at, 0xFF, (size_t)(end - at) - 1)) != NULL)
        scans += *++at == 0xDA;
    return scans;
}

static uint64_t jpeg_work(const uint8_t *data, size_t size)
{
    const uint8_t *frame = jpeg_frame(data, size);
    const uint64_t pixels =
        frame ? (uint64_t)(frame[5] << 8 | frame[6]) * (uint64_t)(frame[7] << 8 | frame[8]) : 0;
    return frame && frame[1] == 0xC2 ? pixels + (pixels + 3) / 4 * count_scans(data, size) : pixels;
}

uint64_t picture_work(const uint8_t *data, size_t size)
{
    if (is_png(data, size) && size >= 24)
        return (uint64_t)get_u32_be(data + 16) * get_u32_be(data + 20);
    if (is_jpeg(data, size))
        return jpeg_work(data, size);
    return size;
}

int picture_read_codes(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    const picture_kind *kind = kind_of(data, size);
    memset(out, 0, sizeof *out);
    if (!kind)
        return refuse(data, size, name, r);
    if (!kind->read_codes)
        return report_fail(r, "%s: this picture is %s, linear light instead of codes of 8 bits; save it as PNG or JPEG",
                           name, kind->format);
    return kind->read_codes(out, data, size, name, r);
}

void stored_picture_free(stored_picture *p)
{
    bitmap_free(&p->codes);
    image_free(&p->light);
}
