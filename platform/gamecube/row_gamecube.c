/* row_gamecube.c: converts a row of the picture for the GameCube's video interface: YCbCr 4:2:2 of 8 bits, in integers.
 *
 *     Y  = ( 66 R + 129 G +  25 B +  16 * 256 + 128) / 256        of each pixel
 *     Cb = (-38 R -  74 G + 112 B + 128 * 256 + 128) / 256        of the mean of two pixels' R, G, B, each rounded down
 *     Cr = (112 R -  94 G -  18 B + 128 * 256 + 128) / 256        likewise
 *
 * This is ITU-R BT.601 with Y of 16 to 235. Y is computed by multiplication, for two pixels at once if a word holds
 * both; Cb and Cr come from tables, which balances loads and products. */
#include "port_gamecube.h"

enum { LINE = 32 /* bytes of a line of the data cache */ };

static struct {
    uint32_t chroma[3][256]; /* Cb * 65536 + Cr: both are positive in the sum */
    uint32_t is_made;
} table;

static void make_tables(void)
{
    static const int32_t cb[3] = {-38, -74, 112}, cr[3] = {112, -94, -18};
    for (int32_t i = 0; i < 3; ++i)
        for (int32_t v = 0; v < 256; ++v)
            table.chroma[i][v] = (uint32_t)(cb[i] * v) * 65536u + (uint32_t)(cr[i] * v) + (i == 1 ? 0x80808080u : 0u);
    table.is_made = 1;
}

/* Keeps addresses and masks in registers; the compiler would otherwise reload them each time. */
typedef struct kept {
    const uint32_t *red, *green, *blue;
    uint32_t luma_half, luma_mask, chroma_mask, mean_mask;
} kept;

/* 256 Y of both pixels, one in each half. Red times 66 and blue times 25 add up in a product's high half; the low half
 * has only blue times 66, which never carries. */
static inline uint32_t lumas(const kept *k, uint32_t a, uint32_t b)
{
    const uint32_t red_blue = 25u << 16 | 66u, green = (a << 8 & 0xff0000u) | (b >> 8 & 255u);
    const uint32_t of_a = (a & k->chroma_mask) * red_blue, of_b = (b & k->chroma_mask) * red_blue;
    return ((of_a & 0xffff0000u) | of_b >> 16) + green * 129u + k->luma_half;
}

static inline uint32_t chroma(const kept *k, uint32_t a, uint32_t b)
{
    const uint32_t mean = (a & b) + ((a ^ b) >> 1 & k->mean_mask);
    return k->red[mean >> 16] + k->green[mean >> 8 & 255u] + k->blue[mean & 255u];
}

static inline uint32_t two(const kept *k, uint32_t a, uint32_t b)
{
    return (lumas(k, a, b) & k->luma_mask) | (chroma(k, a, b) >> 8 & k->chroma_mask);
}

void gamecube_row(uint32_t *out, const uint32_t *rgb, int32_t width)
{
    kept k = {table.chroma[0], table.chroma[1], table.chroma[2], 0x10801080u, 0xff00ff00u, 0xff00ffu, 0x7f7f7fu};
    if (!table.is_made)
        make_tables();
    __asm__("" : "+r"(k.red), "+r"(k.green), "+r"(k.blue));
    __asm__("" : "+r"(k.luma_half), "+r"(k.luma_mask), "+r"(k.chroma_mask), "+r"(k.mean_mask));
    for (const uint32_t *end = rgb + width; rgb < end;) {
        uint32_t *const line = out;
        __asm__ volatile("dcbz 0, %0" : : "r"(line) : "memory"); /* allocates the line without fetching it */
        /* Two words at a time: one continues while the other waits for its products. */
        for (; out < line + LINE / 4; rgb += 4, out += 2) {
            const uint32_t first = two(&k, rgb[0], rgb[1]), second = two(&k, rgb[2], rgb[3]);
            out[0] = first, out[1] = second;
        }
        __asm__ volatile("dcbf 0, %0" : : "r"(line) : "memory"); /* writes the line to RAM, from which it is shown */
    }
}
