/* picture.h: a linear frame -> the file format its name asks for. */
#ifndef PICTURE_H
#define PICTURE_H

#include <stdint.h>

#include "image.h"

enum { PICTURE_UNKNOWN = 0, PICTURE_PNG, PICTURE_PPM, PICTURE_PFM, PICTURE_HDR };

/* By extension, whatever its case; of standard output, `-` is a PNG, and ppm:- pfm:- hdr:- what they say. */
int picture_format(const char *path);
int picture_is_linear(int format);

/* A row of an option table (OPTION_OWN): a const char *, the name of a file that picture_write can write. */
#define PICTURE_OPTION_WANTS                                                                              \
    "a file name ending in .png, .ppm, .pfm or .hdr, or png:-, ppm:-, pfm:- or hdr:- for standard output (- is png:-)"
#define PICTURE_OPTION_HELP ".png .ppm (display), .pfm .hdr (linear); -, ppm:-, pfm:-, hdr:- are standard output"
int picture_option(const char *text, void *at);

/* How display formats take light over white. PICTURE_CURVED: up to 0.76 of the exposed light is as it is; beyond, a
 * shoulder that never reaches white, all channels alike by the brightest, and bright colours fade to white: Khronos PBR
 * Neutral without its toe, which takes away a veil of reflection that these surfaces have not.
 * PICTURE_CLIPPED: what is over white is white. Values of --tone's words. */
enum { PICTURE_CURVED = 0, PICTURE_CLIPPED };

/* The stops that bring the brightest hundredth of the pixels just under white, or where the curve has it at 0.93 of
 * white. With the curve fewer, where half of the pixels would be over 0.42 of white: something white among white has
 * tones too. 0 for a black frame. */
float picture_auto_exposure(const image *linear, int tone);

/* picture_codes: three display codes a pixel. The caller's to free; NULL where memory is short. */
uint8_t *picture_codes(const image *linear, float exposure_ev, int tone);

/* picture_expose: the light of display formats in place: exposed, and by the curve. */
void picture_expose(image *inout, float exposure_ev, int tone);

/* picture_encode_alpha: encodes a PNG with alpha: `alpha` is 0 .. 1 for each pixel, and `linear` is premultiplied by
 * it. */
int picture_encode_alpha(file_bytes *out, const image *linear, const float *alpha, float exposure_ev, int tone, report *r);

/* picture_encode: a file's bytes, of a PICTURE_ format. picture_write: the file that its name asks for, whole or not at
 * all. Exposure and tone count for display formats. 1, or 0 with `r` set. */
int picture_encode(file_bytes *out, int format, const image *linear, float exposure_ev, int tone, report *r);
int picture_write(const char *path, const image *linear, float exposure_ev, int tone, report *r);

#endif
