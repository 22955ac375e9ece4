/* io_pam.h: decodes PAM files (Netpbm's P7) into 8-bit pictures. */
#ifndef IO_PAM_H
#define IO_PAM_H

#include "image.h"

/* pam_decode: decodes one picture of type BLACKANDWHITE, GRAYSCALE or RGB, each also with _ALPHA, with one or two bytes
 * per sample. Without a type, DEPTH (1 to 4) chooses. `name` is used in messages. Codes are as in ppm_decode, alpha
 * too. The file must end with the picture. Takes at most 4 times the size of the file in memory. bitmap_free releases
 * it. pam_decode_16: only GRAYSCALE of two bytes: the high byte as red, the low byte as green, like png_decode_16.
 *
 * Return 1, or 0 with `r` set and nothing allocated. */
int pam_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);
int pam_decode_16(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* pam_channels: returns the DEPTH of a file that was decoded. */
int32_t pam_channels(const uint8_t *data, size_t size);

/* Returns 1 if the data begins like a PAM file. */
static inline int is_pam(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && data[1] == '7' && (data[2] == '\n' || data[2] == '\r');
}

#endif
