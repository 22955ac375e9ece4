/* picture_read.h: reads any image file, recognized by content: PNG, JPEG, PPM, PGM, PAM, PFM or Radiance HDR. Other
 * files are refused with a message that names the format and a converter. */
#ifndef PICTURE_READ_H
#define PICTURE_READ_H

#include "image.h"

/* An image as stored in the file, either codes or linear light. stored_picture_free releases it. */
typedef struct stored_picture {
    const char *format; /* "PNG" and so on */
    int32_t width, height;
    int32_t channels; /* 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha */
    bitmap codes;     /* texels NULL: the file stores light */
    float light_of[256]; /* linear light of a code */
    image light;      /* pixels NULL: the file stores codes */
} stored_picture;

/* picture_begins: whether this is an image, of a format that is read or only recognized. */
int picture_begins(const uint8_t *data, size_t size);

/* Both return 1, or 0 with `r` set and nothing allocated; `name` is used in messages. picture_read prints a note on
 * stderr if a defect was tolerated (bitmap.note). */
int picture_read(stored_picture *out, const uint8_t *data, size_t size, const char *name, report *r);
/* picture_read_codes: only for images of codes, like textures; refuses linear light. bitmap_free releases it. */
int picture_read_codes(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

/* picture_work: the cost limit of decoding these bytes, in pixels of a plain image: those of the header, and a
 * quarter more for each scan of a progressive JPEG, which visits all blocks; 0 if the header is not valid. */
uint64_t picture_work(const uint8_t *data, size_t size);

void stored_picture_free(stored_picture *p);

#endif
