/* row_n64.c: a row of the picture as RGBA5551 in RDRAM, dithered as room_rgb555 does it. */
#include "port_n64.h"

#include "../demo/room.h"

/* Bayer's matrix for room.h's formula, each entry as (t * 255 + 127) / 16, in two halves of a word. */
static const uint32_t steps[4][4] = {{7, 135, 39, 167}, {199, 71, 231, 103}, {55, 183, 23, 151}, {247, 119, 215, 87}};

/* A line of the data cache becomes the memory's without being fetched; later it goes there. On other MIPS processors,
 * where the cost is counted, these two are the system's own. */
#ifdef N64_NO_CACHE_OPERATIONS
#define CACHE_LINE(operation, p) ((void)(p))
#else
#define CACHE_LINE(operation, p) __asm__ volatile("cache %0, 0(%1)" : : "i"(operation), "r"(p) : "memory")
#endif
enum { CREATE_DIRTY = 0x0d, WRITE_BACK_INVALIDATE = 0x15 };

/* Five bits of red, green and blue: c * 31 + step over 255, by which 255 divides exactly for all below 65535. */
static inline __attribute__((always_inline)) uint32_t pixel(uint32_t rgb, uint32_t step)
{
    const uint32_t two = rgb & 0xff00ffu, one = rgb >> 8 & 0xffu;
    const uint32_t m = (two << 5) - two + (step | step << 16), g = (one << 5) - one + step;
    const uint32_t rb = (m + 0x10001u + (m >> 8 & 0xff00ffu)) >> 8, green = (g + 1 + (g >> 8)) >> 8;
    return (rb >> 5 & 0xf800u) | green << 6 | (rb & 31u) << 1 | 1u;
}

void n64_row(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    const uint32_t *step = steps[y & 3];
    const uint32_t a = step[0], b = step[1], c = step[2], d = step[3];
    uint32_t *to = (uint32_t *)(void *)out;
    for (const uint32_t *end = rgb + width; rgb < end; rgb += 8, to += 4) {
        CACHE_LINE(CREATE_DIRTY, to);
        to[0] = pixel(rgb[0], a) << 16 | pixel(rgb[1], b);
        to[1] = pixel(rgb[2], c) << 16 | pixel(rgb[3], d);
        to[2] = pixel(rgb[4], a) << 16 | pixel(rgb[5], b);
        to[3] = pixel(rgb[6], c) << 16 | pixel(rgb[7], d);
        CACHE_LINE(WRITE_BACK_INVALIDATE, to);
    }
}
