/* io_pam.h: PAM files (Netpbm's P7) into 8-bit pictures. */
#ifndef IO_PAM_H
#define IO_PAM_H

#include "image.h"

/* pam_decode: one picture of type BLACKANDWHITE, GRAYSCALE or RGB, each also with _ALPHA, of one or two bytes a sample;
 * without a type DEPTH chooses: 1 to 4. `name` stands in messages. Codes are as ppm_decode has them, alpha too. The
 * file must end where the picture does. Takes at most 4 times the file's size in memory. bitmap_free releases it.
 * pam_decode_16: GRAYSCALE of two bytes, nothing else: the high byte as red, the low one as green, as png_decode_16.
 *
 * Return 1, or 0 with `r` set and nothing allocated. */
int pam_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);
int pam_decode_16(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* pam_channels: of a file that was decoded: its DEPTH. */
int32_t pam_channels(const uint8_t *data, size_t size);

/* Does such a file begin here? */
static inline int is_pam(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && data[1] == '7' && (data[2] == '\n' || data[2] == '\r');
}

#endif
