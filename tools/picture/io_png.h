/* io_png.h: shared by the PNG reader and writer: signature, chunk checksum, row filters (PNG 3rd edition). */
#ifndef IO_PNG_H
#define IO_PNG_H

#include <stddef.h>
#include <stdint.h>

#include "../common/io_bytes.h"

#define PNG_SIGNATURE "\x89PNG\r\n\x1a\n" /* 8 bytes */

enum {
    PNG_SIGNATURE_BYTES = 8,
    PNG_CHUNK_FRAME = 12, /* length, type and checksum around a chunk's body */
    PNG_HEADER_BYTES = 13
};

enum { PNG_NONE = 0, PNG_SUB = 1, PNG_UP = 2, PNG_AVERAGE = 3, PNG_PAETH = 4, PNG_FILTERS = 5 };

/* CRC-32 (reflected polynomial edb88320) of a chunk's type and body, four bits a step. */
static inline uint32_t png_crc(const uint8_t *data, size_t size)
{
    static const uint32_t step[16] = {0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu, 0x76dc4190u, 0x6b6b51f4u,
                                      0x4db26158u, 0x5005713cu, 0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu,
                                      0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu};
    uint32_t crc = 0xffffffffu;
    size_t i;
    for (i = 0; i < size; ++i) {
        crc ^= data[i];
        crc = crc >> 4 ^ step[crc & 15u];
        crc = crc >> 4 ^ step[crc & 15u];
    }
    return ~crc;
}

/* Of left, above and above-left the one nearest to left + above - above-left; the first of equals. */
static inline uint8_t png_paeth(int left, int above, int corner)
{
    int to_left = above - corner, to_above = left - corner, to_corner = to_left + to_above;
    if (to_left < 0) to_left = -to_left;
    if (to_above < 0) to_above = -to_above;
    if (to_corner < 0) to_corner = -to_corner;
    if (to_left <= to_above && to_left <= to_corner) return (uint8_t)left;
    return (uint8_t)(to_above <= to_corner ? above : corner);
}

#endif
