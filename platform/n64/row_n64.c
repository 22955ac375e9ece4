/* row_n64.c: a row of the picture as RGBA5551 in RDRAM, dithered as room_rgb555 does it, by registers of 64 bits. */
#include "port_n64.h"

#include "../demo/room.h"

typedef uint64_t __attribute__((may_alias)) two_pixels;

/* Bayer's matrix for room.h's formula: (t * 255 + 127) / 16, and 1. */
static const uint8_t steps[4][4] = {{8, 136, 40, 168}, {200, 72, 232, 104}, {56, 184, 24, 152}, {248, 120, 216, 88}};

/* A line of the data cache becomes the memory's without being fetched; later it goes there. On other MIPS processors,
 * where the cost is counted, these two are the system's own. */
#ifdef N64_NO_CACHE_OPERATIONS
#define CACHE_LINE(operation, p) ((void)(p))
#else
#define CACHE_LINE(operation, p) __asm__ volatile("cache %0, 0(%1)" : : "i"(operation), "r"(p) : "memory")
#endif
enum { CREATE_DIRTY = 0x0d, WRITE_BACK_INVALIDATE = 0x15 };

#define FOUR(a, b, c, d) ((uint64_t)(a) << 48 | (uint64_t)(b) << 32 | (uint64_t)(c) << 16 | (d))

/* (m - 1) / 255 of four m of 1 .. 8153, for 255 divides exactly by (m + m / 256) / 256 there. m: 31 c + a step. */
static inline uint64_t by_255(uint64_t c, uint64_t step)
{
    const uint64_t m = (c << 5) - c + step;
    return (m + (m >> 8 & FOUR(255, 255, 255, 255))) >> 8 & FOUR(31, 31, 31, 31);
}

/* Four pixels of which a and b hold two each. What lies in the upper half of each 32 bits goes away at the end. */
static inline void four(uint32_t *to, uint64_t a, uint64_t b, const uint64_t step[3])
{
    const uint64_t pair = FOUR(0, 255, 0, 255), kept = FOUR(0, 65535, 0, 65535);
    const uint64_t green = by_255((a >> 8 & pair) << 16 | (b >> 8 & pair), step[2]);
    const uint64_t first = by_255(a & FOUR(255, 255, 255, 255), step[0]);
    const uint64_t second = by_255(b & FOUR(255, 255, 255, 255), step[1]);
    const uint64_t p = (first >> 5 | first << 1 | green >> 10) & kept;
    const uint64_t q = (second >> 5 | second << 1 | green << 6) & kept;
    to[0] = (uint32_t)(p >> 16 | p) | 0x10001u;
    to[1] = (uint32_t)(q >> 16 | q) | 0x10001u;
}

void n64_row(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    const uint8_t *s = steps[y & 3];
    const uint64_t step[3] = {FOUR(s[0], s[0], s[1], s[1]), FOUR(s[2], s[2], s[3], s[3]), FOUR(s[0], s[2], s[1], s[3])};
    const two_pixels *from = (const two_pixels *)(const void *)rgb;
    uint32_t *to = (uint32_t *)(void *)out;
    for (const two_pixels *end = from + width / 2; from < end; from += 4, to += 4) {
        CACHE_LINE(CREATE_DIRTY, to);
        four(to, from[0], from[1], step);
        four(to + 2, from[2], from[3], step);
        CACHE_LINE(WRITE_BACK_INVALIDATE, to);
    }
}
