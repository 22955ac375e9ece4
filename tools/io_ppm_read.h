/* io_ppm_read.h: PPM files into 8-bit pictures. */
#ifndef IO_PPM_READ_H
#define IO_PPM_READ_H

#include "image.h"

/* ppm_decode: binary PPM (P6) of one picture with the largest value 255, alpha 255; `name` stands in messages. The
 * bytes must end where the picture does. Takes 4/3 of the pixels' bytes in memory.
 *
 * Returns 1, or 0 with `r` set and nothing allocated. bitmap_free releases it. */
int ppm_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

#endif
