/* image.h: images in memory and in file formats. Every reader checks each length before use, and limits memory to a
 * stated multiple of the file's size. */
#ifndef IMAGE_H
#define IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "../common/io_file.h"
#include "../common/report.h"

/* Linear light, rows from the top, `channels` floats per pixel. image_free releases it. */
typedef struct image {
    int32_t width, height;
    int32_t channels; /* 1 or 3 */
    float *pixels;
} image;

/* 8-bit RGBA as stored (colour sRGB-coded), rows from the top. bitmap_free releases it. */
typedef struct bitmap {
    int32_t width, height;
    uint8_t *texels; /* width * height * 4 */
    const char *note; /* a defect of the file that was tolerated; NULL: none */
} bitmap;

/* All calls below return 1, or 0 with `r` set and nothing allocated or left on disk. */

/* png_decode: PNG from memory; `name` is used in messages. Colour types 0 2 3 4 6, depths 1 2 4 8 16, tRNS,
 * interlaced or not; of 16 bits only the high byte is kept. */
int png_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);
/* png_decode_16: only a grey PNG of 16 bits: the high byte as red, the low one as green. */
int png_decode_16(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);
/* png_encode: 8-bit RGB from rows of RGB bytes, deflate-compressed with adaptive filters. Allocates *out.
 * png_encode_alpha: RGBA, colours not multiplied by alpha. png_encode_quick: RGB in a third of the time; a file is a
 * few per cent larger. */
int png_encode(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r);
int png_encode_quick(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r);
int png_encode_alpha(file_bytes *out, const uint8_t *rgba, int32_t width, int32_t height, report *r);

int pfm_decode(image *out, const uint8_t *data, size_t size, const char *name, report *r);
/* pfm_figures: reads the header of a PFM that was decoded: *scale, over 0, the factor of stored values, and whether the
 * low byte comes first. Returns 0 if the file is no PFM. */
int pfm_figures(float *scale, int *is_little, const uint8_t *data, size_t size);
int pfm_encode(file_bytes *out, const image *in, report *r); /* little-endian, bottom row first */
/* hdr_decode: Radiance RGBE from memory, run-length coded (old or new) or not, in any of the eight orientations. The
 * result has 3 channels; EXPOSURE and COLORCORR are divided out. Memory: at most 16 MiB and 1024 bytes per byte of
 * file. */
int hdr_decode(image *out, const uint8_t *data, size_t size, const char *name, report *r);
int hdr_encode(file_bytes *out, const image *in, report *r); /* Radiance RGBE, run-length coded */
int ppm_encode(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r);

/* srgb_decode: linear light of an sRGB code 0 .. 255 (IEC 61966-2-1). */
double srgb_decode(int code);

/* srgb_table: srgb_decode of each code. */
void srgb_table(float light_of[256]);

/* srgb_curve: the same for a fractional code, 0 .. 1. */
double srgb_curve(double code);

void image_free(image *img);
void bitmap_free(bitmap *map);

/* inflate_zlib: RFC 1950/1951 into exactly `out_size` bytes; 0 on any other length or bad checksum. */
int inflate_zlib(uint8_t *out, size_t out_size, const uint8_t *in, size_t in_size);
/* deflate_zlib: LZ77 + dynamic Huffman. Allocates *out (malloc) and sets *out_size; returns 0 if memory is short. */
int deflate_zlib(uint8_t **out, size_t *out_size, const uint8_t *in, size_t in_size);

/* deflate_zlib_quick: the same with few tries for each match. */
int deflate_zlib_quick(uint8_t **out, size_t *out_size, const uint8_t *in, size_t in_size);

#endif
