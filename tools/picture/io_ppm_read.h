/* io_ppm_read.h: decodes PPM and PGM files into 8-bit images. */
#ifndef IO_PPM_READ_H
#define IO_PPM_READ_H

#include "image.h"

/* ppm_decode: one image of kind P6 or P3 (colour), P5 or P2 (grey), as bytes or decimal text, with comments; alpha
 * is 255; `name` is used in messages. The maximum M may be 1 to 65535. If it is 255, codes are the stored values; if
 * 65535, their high byte (like png_decode); otherwise 255 v / M rounded to nearest, halves up. The file must end
 * with the image. Memory: at most 4 times the file's size. Returns 1, or 0 with `r` set and nothing allocated.
 * bitmap_free releases it. */
int ppm_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* is_ppm: whether the bytes begin like one of these files. */
static inline int is_ppm(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == '2' || data[1] == '3' || data[1] == '5' || data[1] == '6') &&
           (data[2] == '#' || data[2] == ' ' || (data[2] >= '\t' && data[2] <= '\r'));
}

#endif
