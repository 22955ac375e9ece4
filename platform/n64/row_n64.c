/* row_n64.c: a row of the picture as RGBA5551 in RDRAM, dithered as room_rgb555 does it, by registers of 64 bits. */
#include "port_n64.h"

#include "../demo/room.h"

typedef uint64_t __attribute__((may_alias)) two_pixels;

/* Bayer's matrix for room.h's formula, halved: 0 .. 7. */
static const uint8_t steps[4][4] = {{0, 4, 1, 5}, {6, 2, 7, 3}, {1, 5, 0, 4}, {7, 3, 6, 2}};

/* A line of the data cache becomes the memory's without being fetched; later it goes there. On other MIPS processors,
 * where the cost is counted, these two are the system's own. */
#ifdef N64_NO_CACHE_OPERATIONS
#define CACHE_LINE(operation, p) ((void)(p))
#else
#define CACHE_LINE(operation, p) __asm__ volatile("cache %0, 0(%1)" : : "i"(operation), "r"(p) : "memory")
#endif
enum { CREATE_DIRTY = 0x0d, WRITE_BACK_INVALIDATE = 0x15 };

#define BOTH(v) ((uint64_t)(v) << 32 | (v))

/* Two pixels, the first one in the upper half. */
static inline uint32_t two(uint64_t p, uint64_t step)
{
    const uint64_t v = p - (p >> 5 & BOTH(0x070707u)) + step;
    const uint64_t q = (v >> 8 & BOTH(0xf800u)) | (v >> 5 & BOTH(0x7c0u)) | (v >> 2 & BOTH(0x3eu));
    return (uint32_t)(q >> 16 | q) | 0x10001u;
}

void n64_row(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    const uint8_t *s = steps[y & 3];
    const uint64_t first = ((uint64_t)s[0] << 32 | s[1]) * 0x010101u, second = ((uint64_t)s[2] << 32 | s[3]) * 0x010101u;
    const two_pixels *from = (const two_pixels *)(const void *)rgb;
    uint32_t *to = (uint32_t *)(void *)out;
    for (const two_pixels *end = from + width / 2; from < end; from += 4, to += 4) {
        CACHE_LINE(CREATE_DIRTY, to);
        to[0] = two(from[0], first), to[1] = two(from[1], second);
        to[2] = two(from[2], first), to[3] = two(from[3], second);
        CACHE_LINE(WRITE_BACK_INVALIDATE, to);
    }
}
