/* test_draw_fill.c: blending of rows by every available backend: every colour, share and target code, against the exact
 * quotient. Rows of each width keep the pixels around them. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../src/lane/kernels.h"
#include "../test.h"

void test_draw_fill(void);

#if LMB_DRAW_LANES
enum { CODES = 256, WIDEST = 40 };

static uint8_t exact(int source, int share, int target, int adds)
{
    if (adds) {
        const int sum = (2 * source * share + 255) / 510 + target;
        return (uint8_t)(sum < 255 ? sum : 255);
    }
    return (uint8_t)((2 * (source * share + target * (255 - share)) + 255) / 510);
}

/* Returns the first share with a wrong code, or 256. R and B are the source, G its inverse. */
static int first_wrong(const lmb_kernels *backend, int adds)
{
    static uint8_t row[CODES][4];
    for (int share = 0; share < CODES; ++share) {
        for (int source = 0; source < CODES; ++source) {
            const uint32_t word = (uint32_t)source * 0x10001u | (uint32_t)(255 - source) << 8 | (uint32_t)share << 24;
            int wrong = 0;
            for (int k = 0; k < CODES; ++k) {
                memset(row[k], k, 4);
            }
            backend->draw_fill(&row[0][0], 0, CODES, 1, word, adds);
            for (int k = 0; k < CODES; ++k) {
                const uint8_t red = exact(source, share, k, adds);
                wrong |= row[k][0] != red || row[k][2] != red || row[k][1] != exact(255 - source, share, k, adds) ||
                         row[k][3] != exact(share, share, k, adds);
            }
            if (wrong) {
                return share;
            }
        }
    }
    return CODES;
}

static int keeps_others(const lmb_kernels *backend, int32_t width)
{
    uint32_t pixels[3][WIDEST + 2];
    int good = 1;
    memset(pixels, 0, sizeof pixels);
    backend->draw_fill((uint8_t *)&pixels[0][1], sizeof pixels[0], width, 2, 0xff332211u, 0);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < WIDEST + 2; ++x) {
            good &= pixels[y][x] == (y < 2 && x >= 1 && x <= width ? 0xff332211u : 0);
        }
    }
    return good;
}

void test_draw_fill(void)
{
    const lmb_kernels *backend;
    for (int32_t i = 0; (backend = lmb_kernels_at(i)) != NULL; ++i) {
        for (int adds = 0; adds < 2; ++adds) {
            const int share = first_wrong(backend, adds);
            CHECK_MSG(share == CODES, "%s, %s: wrong with share %d", lmb_kernels_name(backend), adds ? "added" : "over",
                      share);
        }
        for (int32_t width = 1; width <= WIDEST; ++width) {
            CHECK_MSG(keeps_others(backend, width), "%s: a row of %d pixels", lmb_kernels_name(backend), width);
        }
    }
}
#else
void test_draw_fill(void) {}
#endif
