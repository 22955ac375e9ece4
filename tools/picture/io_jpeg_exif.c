/* io_jpeg_exif.c: the orientation in a JPEG's Exif segment. */
#include <string.h>

#include "io_jpeg.h"

/* An unsigned number of `bytes` bytes, in either byte order; 0 beyond the end. */
static uint32_t exif_number(const uint8_t *body, size_t size, int is_big, size_t at, size_t bytes)
{
    uint32_t v = 0;
    if (size < bytes || at > size - bytes) return 0;
    for (size_t i = 0; i < bytes; ++i) v = v << 8 | body[at + (is_big ? i : bytes - 1 - i)];
    return v;
}

const char *jpeg_exif_note(const uint8_t *body, size_t size)
{
    enum { TIFF = 6, ENTRY = 12, ORIENTATION = 0x112 }; /* bytes of "Exif\0\0", of an entry; a tag */
    if (size < TIFF + 8 || memcmp(body, "Exif\0", 6) != 0) return NULL;
    const int is_big = body[TIFF] == 'M';
    const size_t list = TIFF + (size_t)exif_number(body, size, is_big, TIFF + 4, 4);
    const uint32_t entries = exif_number(body, size, is_big, list, 2);
    for (uint32_t i = 0; i < entries && list + 2 + ENTRY * (size_t)i < size; ++i) {
        const size_t at = list + 2 + ENTRY * (size_t)i;
        const uint32_t turn = exif_number(body, size, is_big, at + 8, 2);
        if (exif_number(body, size, is_big, at, 2) == ORIENTATION && turn >= 2 && turn <= 8)
            return "viewers turn or mirror it by the Exif orientation; here it is used as stored";
    }
    return NULL;
}
