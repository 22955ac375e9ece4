/* io_bytes.h: shared by the image formats: the largest image, and numbers in either byte order. */
#ifndef IO_BYTES_H
#define IO_BYTES_H

#include <stddef.h>
#include <stdint.h>

/* 16384 x 16384: 1 GiB as RGBA. Byte counts up to 15 per pixel also fit a 32-bit size_t. */
#define PICTURE_MAX_PIXELS (UINT64_C(1) << 28)

static inline int picture_fits(uint64_t width, uint64_t height)
{
    return width > 0 && height > 0 && width <= PICTURE_MAX_PIXELS && height <= PICTURE_MAX_PIXELS / width;
}

/* Limits pixels by file size, because formats that compress without bound would break the bound on time: 8192 x 8192
 * for any file, and 64 for each byte. */
static inline int picture_is_paid(uint64_t width, uint64_t height, uint64_t bytes_of_file)
{
    return width * height <= (UINT64_C(1) << 26) + 64 * bytes_of_file;
}

static inline uint32_t get_u32_be(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static inline uint32_t get_u32_le(const uint8_t *p)
{
    return (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}

static inline void put_u32_be(uint8_t *p, uint32_t v)
{
    p[0] = (uint8_t)(v >> 24);
    p[1] = (uint8_t)(v >> 16);
    p[2] = (uint8_t)(v >> 8);
    p[3] = (uint8_t)v;
}

static inline void put_u32_le(uint8_t *p, uint32_t v)
{
    p[0] = (uint8_t)v;
    p[1] = (uint8_t)(v >> 8);
    p[2] = (uint8_t)(v >> 16);
    p[3] = (uint8_t)(v >> 24);
}

#endif
