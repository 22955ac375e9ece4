/* row_gamecube.c: a row of the picture as the GameCube's video interface takes it, YCbCr 4:2:2 of 8 bits, by integers.
 *
 *     Y  = ( 66 R + 129 G +  25 B +  16 * 256 + 128) / 256        of each pixel
 *     Cb = (-38 R -  74 G + 112 B + 128 * 256 + 128) / 256        of both, the mean of the numerators before the
 *     Cr = (112 R -  94 G -  18 B + 128 * 256 + 128) / 256        division, rounded down
 *
 * which is ITU-R BT.601 with Y of 16 to 235. Two pixels lie in the halves of a word: no sum leaves its half. */
#include "port_gamecube.h"

enum { LINE = 32 /* bytes of a line of the data cache */ };

static uint32_t both(uint32_t half) { return half << 16 | half; }

static uint32_t two(uint32_t a, uint32_t b)
{
    const uint32_t r = (a & 0xff0000u) | (b >> 16 & 0xffu), g = (a << 8 & 0xff0000u) | (b >> 8 & 0xffu);
    const uint32_t c = (a << 16 & 0xff0000u) | (b & 0xffu);
    const uint32_t y = 66 * r + 129 * g + 25 * c + both(4224);
    const uint32_t u = 112 * c - 38 * r - 74 * g + both(32896), v = 112 * r - 94 * g - 18 * c + both(32896);
    const uint32_t cb = ((u >> 16) + (u & 0xffffu)) >> 9, cr = ((v >> 16) + (v & 0xffffu)) >> 9;
    return (y & 0xff000000u) | cb << 16 | (y & 0xff00u) | cr;
}

void gamecube_row(uint32_t *out, const uint32_t *rgb, int32_t width)
{
    for (const uint32_t *end = rgb + width; rgb < end; rgb += 16, out += LINE / 4) {
        __asm__ volatile("dcbz 0, %0" : : "r"(out) : "memory"); /* the line is ours without being fetched */
        for (int i = 0; i < LINE / 4; ++i)
            out[i] = two(rgb[2 * i], rgb[2 * i + 1]);
        __asm__ volatile("dcbf 0, %0" : : "r"(out) : "memory"); /* and goes to RAM, where it is shown from */
    }
}
