/* io_jpeg.h: JPEG images (ITU-T T.81, JFIF) from memory, and types shared by the three files of the reader. */
#ifndef IO_JPEG_H
#define IO_JPEG_H

#include <stddef.h>
#include <stdint.h>

#include "image.h"

/* jpeg_decode: JPEG from memory; `name` is used in messages. Huffman coded, sequential or progressive, 8 bits; grey,
 * YCbCr, RGB, CMYK or YCCK with sampling factors 1, 2 and 4. In CMYK, 255 is no ink, as Adobe's programs write it
 * and browsers read it. Red, green and blue are C, M and Y times K; profiles are ignored. Alpha is 255. Returns 1,
 * or 0 with `r` set and nothing allocated. */
int jpeg_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* is_jpeg: whether the bytes begin like a JPEG. */
static inline int is_jpeg(const uint8_t *data, size_t size)
{
    return size >= 2 && data[0] == 0xFF && data[1] == 0xD8;
}

/* --- inside the reader --- */

enum { JPEG_TABLES = 4, JPEG_COMPONENTS = 4, JPEG_QUICK_BITS = 9 };

/* A Huffman code: quick for codes up to 9 bits, the canonical order for longer ones. */
typedef struct jpeg_code {
    int is_defined;
    uint16_t quick[1 << JPEG_QUICK_BITS]; /* by the next 9 bits: length << 8 | symbol; 0: longer or none */
    uint32_t limit[17];                   /* by length: one above the last code */
    int32_t offset[17];                   /* by length: from code to symbol index */
    uint8_t symbols[256];
} jpeg_code;

/* Blocks are 8 x 8. Blocks beyond blocks_x and blocks_y are padding of an interleaved scan, and not stored. */
typedef struct jpeg_component {
    uint32_t id, h, v, table;
    uint32_t width, height;     /* samples */
    uint32_t blocks_x, blocks_y;
    uint8_t *samples;           /* blocks_y * 8 rows of blocks_x * 8 */
    int16_t *coefficients;      /* of progressive pictures: 64 a block, rows of 8; otherwise NULL */
    uint16_t quant[64];         /* rows of 8, as they were at the component's first scan */
    int8_t known[64];           /* in zigzag order: the lowest bit received so far; -1: none yet */
    const jpeg_code *dc, *ac;   /* of this scan */
    int32_t prediction;         /* DC of the block before */
} jpeg_component;

enum { JPEG_VALID = 0, JPEG_NO_BITS, JPEG_NO_CODE, JPEG_IDLE };

/* Blocks that refining scans may visit without reading a bit. This bounds time by the file's size: these, and 32 per
 * byte. It allows ten scans over any image that picture_is_paid, in three components (seven in four); images for
 * people have two or three. */
#define JPEG_IDLE_BLOCKS (UINT64_C(1) << 25)

typedef struct jpeg_reader {
    const uint8_t *data;
    size_t size, at; /* the next byte */
    const char *name;
    report *r;
    uint32_t width, height, count, h_max, v_max; /* count: of components; 0 before the frame header */
    int progressive, is_jfif, adobe;             /* adobe: colour transform; -1: not given */
    jpeg_component components[JPEG_COMPONENTS];
    uint16_t quant[JPEG_TABLES][64]; /* rows of 8; the first entry is 0 while a table is not defined */
    jpeg_code dc[JPEG_TABLES], ac[JPEG_TABLES];
    uint32_t restart; /* MCUs between restart markers; 0: none */
    const char *note; /* as bitmap's */
    uint64_t idle;    /* of JPEG_IDLE_BLOCKS and the file's share: left for all further scans */

    jpeg_component *scan[JPEG_COMPONENTS]; /* of this scan, like all members below */
    uint32_t scan_count, first, last, high, low;
    uint32_t empty_run; /* blocks that still have no new coefficients */
    uint32_t bits;      /* read, not used: the lowest bit_count */
    uint32_t bit_count;
    int fault;
} jpeg_reader;

/* Position in rows of 8 of the k-th coefficient. */
extern const uint8_t jpeg_zigzag[64];

/* jpeg_scan: decodes the entropy-coded data at j->at for the scan that was set up, and leaves j->at at the marker
 * after it. Sequential blocks become samples at once; progressive ones stay coefficients. */
int jpeg_scan(jpeg_reader *j);

/* jpeg_inverse_dct: the 8 x 8 samples of a block, rows `stride` bytes apart. */
void jpeg_inverse_dct(uint8_t *out, size_t stride, const int16_t block[64], const uint16_t quant[64]);

/* jpeg_colour_rows: converts the whole picture to RGBA. `rows`: scratch, JPEG_COMPONENTS * (width + 4) bytes. */
void jpeg_colour_rows(uint8_t *texels, const jpeg_reader *j, int is_ycc, uint8_t *rows);

/* io_jpeg_exif.c: returns a note if the body of an APP1 segment has an Exif orientation other than upright, else NULL.
 * Viewers turn the picture then, but depth and poses are of the stored pixels. */
const char *jpeg_exif_note(const uint8_t *body, size_t size);

#endif
