/* picture.h: a linear frame -> the file format its name asks for. */
#ifndef PICTURE_H
#define PICTURE_H

#include <stdint.h>

#include "image.h"

enum { PICTURE_UNKNOWN = 0, PICTURE_PNG, PICTURE_PPM, PICTURE_PFM, PICTURE_HDR };

/* By extension, whatever its case. */
int picture_format(const char *path);
int picture_is_linear(int format);

/* A row of an option table (OPTION_OWN): a const char *, the name of a file that picture_write can write. */
#define PICTURE_OPTION_WANTS "a file name ending in .png, .ppm, .pfm or .hdr"
int picture_option(const char *text, void *at);

/* The stops that bring the brightest hundredth of the pixels just under white; 0 for a black frame. */
float picture_auto_exposure(const image *linear);

/* picture_codes: three display codes a pixel. The caller's to free; NULL where memory is short. */
uint8_t *picture_codes(const image *linear, float exposure_ev);

/* Write, whole or not at all. exposure_ev counts for display formats. 1, or 0 with `r` set. */
int picture_write(const char *path, const image *linear, float exposure_ev, report *r);

#endif
