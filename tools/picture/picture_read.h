/* picture_read.h: reads any picture file, recognized by content: PNG, JPEG, PPM, PGM, PAM, PFM or Radiance HDR. Other
 * files are refused with a message that names their format and a converter. */
#ifndef PICTURE_READ_H
#define PICTURE_READ_H

#include "image.h"

/* A picture as its file stores it, as codes or as linear light. stored_picture_free releases it. */
typedef struct stored_picture {
    const char *format; /* "PNG" and so on */
    int32_t width, height;
    int32_t channels; /* 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha */
    bitmap codes;     /* texels NULL: the file stores light */
    image light;      /* pixels NULL: the file stores codes */
} stored_picture;

/* picture_begins: is this a picture, of a kind that is read or one that is only known by name? */
int picture_begins(const uint8_t *data, size_t size);

/* Both return 1, or 0 with `r` set and nothing allocated; `name` stands in messages. picture_read says on stderr what a
 * file has against its format though it could be read (bitmap.note). */
int picture_read(stored_picture *out, const uint8_t *data, size_t size, const char *name, report *r);
/* picture_read_codes: only pictures of codes, as textures are; linear light is refused. bitmap_free releases it. */
int picture_read_codes(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* picture_work: what decoding these bytes takes at most, in pixels of a plain picture: those of the header, and of a
 * progressive JPEG a quarter more for each scan, which goes over all of its blocks; 0 where the header is not valid. */
uint64_t picture_work(const uint8_t *data, size_t size);

void stored_picture_free(stored_picture *p);

#endif
