/* row_gamecube.c: a row of the picture as the GameCube's video interface takes it, YCbCr 4:2:2 of 8 bits, by integers.
 *
 *     Y  = ( 66 R + 129 G +  25 B +  16 * 256 + 128) / 256        of each pixel
 *     Cb = (-38 R -  74 G + 112 B + 128 * 256 + 128) / 256        of the mean of two pixels' R, G, B, each rounded down
 *     Cr = (112 R -  94 G -  18 B + 128 * 256 + 128) / 256        likewise
 *
 * which is ITU-R BT.601 with Y of 16 to 235. Products come from tables: the processor has one unit that multiplies. */
#include "port_gamecube.h"

enum { LINE = 32 /* bytes of a line of the data cache */ };

static struct {
    uint16_t y[3][256];
    uint32_t chroma[3][256]; /* Cb * 65536 + Cr: of the sum both are positive */
    uint32_t is_made;
} table;

static void make_tables(void)
{
    static const int32_t y[3] = {66, 129, 25}, cb[3] = {-38, -74, 112}, cr[3] = {112, -94, -18};
    for (int32_t i = 0; i < 3; ++i)
        for (int32_t v = 0; v < 256; ++v) {
            table.y[i][v] = (uint16_t)(y[i] * v + (i == 1 ? 16 * 256 + 128 : 0));
            table.chroma[i][v] = (uint32_t)(cb[i] * v) * 65536u + (uint32_t)(cr[i] * v) + (i == 1 ? 0x80808080u : 0u);
        }
    table.is_made = 1;
}

/* The tables by six addresses in registers, which the compiler would else make of one each time. */
typedef struct bases {
    const uint16_t *y[3];
    const uint32_t *chroma[3];
} bases;

static inline uint32_t luma(const bases *t, uint32_t c)
{
    return (uint32_t)t->y[0][c >> 16] + t->y[1][c >> 8 & 255u] + t->y[2][c & 255u];
}

static inline uint32_t two(const bases *t, uint32_t a, uint32_t b)
{
    const uint32_t mean = (a & b) + ((a ^ b) >> 1 & 0x7f7f7fu);
    const uint32_t c = t->chroma[0][mean >> 16] + t->chroma[1][mean >> 8 & 255u] + t->chroma[2][mean & 255u];
    return (luma(t, a) << 16 & 0xff000000u) | (c >> 8 & 0xff00ffu) | (luma(t, b) & 0xff00u);
}

void gamecube_row(uint32_t *out, const uint32_t *rgb, int32_t width)
{
    bases t;
    if (!table.is_made)
        make_tables();
    for (int i = 0; i < 3; ++i) {
        t.y[i] = table.y[i], t.chroma[i] = table.chroma[i];
        __asm__("" : "+r"(t.y[i]), "+r"(t.chroma[i]));
    }
    for (const uint32_t *end = rgb + width; rgb < end; rgb += 16, out += LINE / 4) {
        __asm__ volatile("dcbz 0, %0" : : "r"(out) : "memory"); /* the line is ours without being fetched */
        for (int i = 0; i < LINE / 4; ++i)
            out[i] = two(&t, rgb[2 * i], rgb[2 * i + 1]);
        __asm__ volatile("dcbf 0, %0" : : "r"(out) : "memory"); /* and goes to RAM, where it is shown from */
    }
}
