/* fuzz_pictures.c: the picture decoders: arbitrary bytes give a whole picture, or one line and no picture. */
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/image.h"
#include "../../tools/picture/io_jpeg.h"
#include "../../tools/picture/io_pam.h"
#include "../../tools/picture/io_png.h"
#include "../../tools/picture/io_ppm_read.h"
#include "../../tools/picture/picture_read.h"
#include "fuzz.h"

#define NAME "input"

typedef int (*decode_bitmap)(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);
typedef int (*decode_image)(image *out, const uint8_t *data, size_t size, const char *name, report *r);

/* Reads the last texel, to check that the picture has the reported size. */
static void try_bitmap(decode_bitmap decode, const uint8_t *data, size_t size)
{
    report r = {{0}};
    bitmap map;
    if (decode(&map, data, size, NAME, &r)) {
        fuzz_require(map.width > 0 && map.height > 0 && r.text[0] == '\0');
        volatile uint8_t last = map.texels[(size_t)map.width * (size_t)map.height * 4 - 1];
        (void)last;
        bitmap_free(&map);
    } else {
        fuzz_require(map.texels == NULL);
        fuzz_failed(&r, NAME ":");
    }
}

static void try_image(decode_image decode, const uint8_t *data, size_t size)
{
    report r = {{0}};
    image picture;
    if (decode(&picture, data, size, NAME, &r)) {
        size_t values = (size_t)picture.width * (size_t)picture.height * (size_t)picture.channels;
        fuzz_require(picture.width > 0 && picture.height > 0 && (picture.channels == 1 || picture.channels == 3));
        volatile float last = picture.pixels[values - 1];
        (void)last;
        image_free(&picture);
    } else {
        fuzz_require(picture.pixels == NULL);
        fuzz_failed(&r, NAME ":");
    }
}

static void put_chunk(uint8_t **to, const char *type, const uint8_t *body, size_t size)
{
    uint8_t *at = *to;
    put_u32_be(at, (uint32_t)size);
    memcpy(at + 4, type, 4);
    if (size > 0) {
        memcpy(at + 8, body, size);
    }
    put_u32_be(at + 8 + size, png_crc(at + 4, 4 + size));
    *to = at + PNG_CHUNK_FRAME + size;
}

/* Wraps arbitrary bytes as a PNG: 13 of header, a palette, and rows, compressed so that every checksum is right. */
static void try_rows(const uint8_t *data, size_t size)
{
    enum { PALETTE = 48 };
    uint8_t *packed, *file, *at;
    size_t packed_size;
    if (size <= PNG_HEADER_BYTES + PALETTE ||
        !deflate_zlib(&packed, &packed_size, data + PNG_HEADER_BYTES + PALETTE, size - PNG_HEADER_BYTES - PALETTE)) {
        return;
    }
    at = file = malloc(packed_size + 256);
    if (file != NULL) {
        memcpy(at, PNG_SIGNATURE, PNG_SIGNATURE_BYTES);
        at += PNG_SIGNATURE_BYTES;
        put_chunk(&at, "IHDR", data, PNG_HEADER_BYTES);
        put_chunk(&at, "PLTE", data + PNG_HEADER_BYTES, PALETTE);
        put_chunk(&at, "tRNS", data + PNG_HEADER_BYTES, data[9] == 0 ? 2 : data[9] == 2 ? 6 : 16);
        put_chunk(&at, "IDAT", packed, packed_size);
        put_chunk(&at, "IEND", NULL, 0);
        try_bitmap(png_decode, file, (size_t)(at - file));
        try_bitmap(png_decode_16, file, (size_t)(at - file));
    }
    free(file);
    free(packed);
}

void fuzz_png(const uint8_t *data, size_t size)
{
    try_bitmap(png_decode, data, size);
    try_bitmap(png_decode_16, data, size);
    if (size < PNG_SIGNATURE_BYTES || memcmp(data, PNG_SIGNATURE, PNG_SIGNATURE_BYTES) != 0) {
        try_rows(data, size);
    }
}

void fuzz_repair(fuzz_target target, uint8_t *data, size_t size, uint64_t seed)
{
    size_t at = PNG_SIGNATURE_BYTES;
    if ((target != fuzz_png && target != fuzz_picture) || seed % 8 == 0 || size < at ||
        memcmp(data, PNG_SIGNATURE, at) != 0) {
        return;
    }
    while (at < size && size - at >= PNG_CHUNK_FRAME) {
        uint32_t body = get_u32_be(data + at);
        if (body > size - at - PNG_CHUNK_FRAME) {
            return;
        }
        put_u32_be(data + at + 8 + body, png_crc(data + at + 4, 4 + (size_t)body));
        at += PNG_CHUNK_FRAME + (size_t)body;
    }
}

void fuzz_jpeg(const uint8_t *data, size_t size) { try_bitmap(jpeg_decode, data, size); }

void fuzz_ppm(const uint8_t *data, size_t size) { try_bitmap(ppm_decode, data, size); }

void fuzz_pam(const uint8_t *data, size_t size)
{
    try_bitmap(pam_decode, data, size);
    try_bitmap(pam_decode_16, data, size);
}

void fuzz_hdr(const uint8_t *data, size_t size) { try_image(hdr_decode, data, size); }

void fuzz_pfm(const uint8_t *data, size_t size) { try_image(pfm_decode, data, size); }

/* A picture has codes or light, never both; the header gives at least as many pixels as the picture has. */
static void check_picture(const stored_picture *p, const uint8_t *data, size_t size)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    fuzz_require(p->format != NULL && p->width > 0 && p->height > 0 && p->channels >= 1 && p->channels <= 4);
    fuzz_require((p->codes.texels == NULL) != (p->light.pixels == NULL));
    if (p->codes.texels != NULL) {
        fuzz_require(p->codes.width == p->width && p->codes.height == p->height);
        fuzz_require(picture_work(data, size) >= pixels);
        volatile uint8_t last = p->codes.texels[4 * pixels - 1];
        (void)last;
    } else {
        fuzz_require(p->light.width == p->width && p->light.height == p->height && p->light.channels == p->channels);
        volatile float last = p->light.pixels[pixels * (size_t)p->channels - 1];
        (void)last;
    }
}

/* Any format, detected from the first bytes; unsupported formats are named. */
void fuzz_picture(const uint8_t *data, size_t size)
{
    report r = {{0}};
    stored_picture picture;
    if (picture_read(&picture, data, size, NAME, &r)) {
        fuzz_require(r.text[0] == '\0' && picture_begins(data, size));
        check_picture(&picture, data, size);
        stored_picture_free(&picture);
    } else {
        fuzz_require(picture.codes.texels == NULL && picture.light.pixels == NULL);
        fuzz_failed(&r, NAME ":");
    }
}

/* Inflates a stream to a length chosen by the first byte; then deflates the bytes and checks the round trip. */
void fuzz_inflate(const uint8_t *data, size_t size)
{
    uint8_t *packed, *back = malloc(size + 65536);
    size_t packed_size;
    fuzz_require(back != NULL);
    if (size > 0) {
        inflate_zlib(back, (size_t)data[0] * data[0], data + 1, size - 1);
    }
    fuzz_require(deflate_zlib(&packed, &packed_size, data, size));
    fuzz_require(inflate_zlib(back, size, packed, packed_size) && (size == 0 || memcmp(back, data, size) == 0));
    free(packed);
    free(back);
}
