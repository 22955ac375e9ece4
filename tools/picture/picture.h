/* picture.h: writes a linear image in the format that the file name selects. */
#ifndef PICTURE_H
#define PICTURE_H

#include <stdint.h>

#include "image.h"

enum { PICTURE_UNKNOWN = 0, PICTURE_PNG, PICTURE_PPM, PICTURE_PFM, PICTURE_HDR };

/* By file extension, ignoring case. For standard output, `-` is a PNG, and ppm:- pfm:- hdr:- select those formats. */
int picture_format(const char *path);
int picture_is_linear(int format);

/* For a row of an option table (OPTION_OWN): stores a const char *, the name of a file that picture_write can write. */
#define PICTURE_OPTION_WANTS                                                                              \
    "a file name ending in .png, .ppm, .pfm or .hdr, or png:-, ppm:-, pfm:- or hdr:- for standard output (- is png:-)"
#define PICTURE_OPTION_HELP ".png .ppm (display), .pfm .hdr (linear); -, ppm:-, pfm:-, hdr:- are standard output"
int picture_option(const char *text, void *at);

/* Tone mapping of display formats. PICTURE_CURVED: light up to 0.76 is unchanged. Above, a shoulder that never
 * reaches white scales all channels alike by the brightest, and bright colours fade to white: Khronos PBR Neutral
 * without the toe, which removes a veil of reflection that these surfaces do not have. PICTURE_CLIPPED: clamps to
 * white. Indices of --tone's words. */
enum { PICTURE_CURVED = 0, PICTURE_CLIPPED };

/* The exposure in stops that brings the brightest hundredth of the pixels just below white, with the curve to 0.93
 * of white. The curve gets fewer stops if half of the pixels would be over 0.42 of white, so that white objects on
 * white keep their tones. 0 for a black image. */
float picture_auto_exposure(const image *linear, int tone);

/* picture_codes: three display codes per pixel. You free them. NULL if memory is short. */
uint8_t *picture_codes(const image *linear, float exposure_ev, int tone);

/* picture_expose: applies exposure and tone curve of display formats in place. */
void picture_expose(image *inout, float exposure_ev, int tone);

/* picture_encode_alpha: encodes a PNG with alpha: `alpha` is 0 .. 1 for each pixel, and `linear` is premultiplied by
 * it. */
int picture_encode_alpha(file_bytes *out, const image *linear, const float *alpha, float exposure_ev, int tone,
                         report *r);

/* picture_encode: the bytes of a file in a PICTURE_ format. picture_write: writes the file in the format of the
 * name, completely or not at all. Exposure and tone apply to display formats. Return 1, or 0 with `r` set. */
int picture_encode(file_bytes *out, int format, const image *linear, float exposure_ev, int tone, report *r);
int picture_write(const char *path, const image *linear, float exposure_ev, int tone, report *r);

#endif
