/* io_ppm_read.h: PPM and PGM files into 8-bit pictures. */
#ifndef IO_PPM_READ_H
#define IO_PPM_READ_H

#include "image.h"

/* ppm_decode: one picture of kind P6 or P3 (colour), P5 or P2 (grey), bytes or decimal text, with comments; alpha is
 * 255; `name` stands in messages. The largest value M may be 1 to 65535: codes are stored values where it is 255, their
 * high byte where it is 65535 (as png_decode has it), otherwise 255 v / M to the nearest, halves up. The file must end
 * where the picture does. Takes at most 4 times the file's size in memory.
 *
 * Returns 1, or 0 with `r` set and nothing allocated. bitmap_free releases it. */
int ppm_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* Does a file of the kinds above begin here? */
static inline int is_ppm(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == '2' || data[1] == '3' || data[1] == '5' || data[1] == '6') &&
           (data[2] == '#' || data[2] == ' ' || (data[2] >= '\t' && data[2] <= '\r'));
}

#endif
