/* mix_grain.c: the noise of a photo, estimated from it. The square root of light stands for display values: noise of a
 * sensor is about even in it. */
#include "mix_grain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 512 };

#define WIDEST  0.125f  /* largest difference counted */
#define QUARTER 3.1381f /* 1 / the first quartile of |x| of a normal distribution of deviation 1 */

/* Differences of squares, by size. */
typedef struct sizes {
    uint32_t bin[BINS], count;
} sizes;

static float root(float light) { return sqrtf(fminf(fmaxf(light, 0.0f), 1.0f)); }

static int step_of(float value)
{
    const int step = (int)(value * (float)MIX_GRAIN_STEPS);
    return step < 0 ? 0 : step > MIX_GRAIN_STEPS - 1 ? MIX_GRAIN_STEPS - 1 : step;
}

static void add_square(sizes of[MIX_GRAIN_STEPS][3], const image *p, int32_t x, int32_t y, int c)
{
    const size_t w = 3 * (size_t)p->width;
    const float *at = p->pixels + w * (size_t)y + 3 * (size_t)x + (size_t)c;
    const float a = root(at[0]), b = root(at[3]), d = root(at[w]), e = root(at[w + 3]), mean = 0.25f * (a + b + d + e),
                off = 0.5f * fabsf(a - b - d + e);
    if (mean > 0.02f && mean < 0.985f && off < WIDEST) { /* clipped pixels have no noise */
        sizes *s = &of[step_of(mean)][c];
        ++s->bin[(int)(off * ((float)BINS / WIDEST))];
        ++s->count;
    }
}

/* The deviation from the first quartile: half of the squares may be edges or texture. */
static float deviation(const sizes *s)
{
    uint32_t below = 0;
    int i = 0;
    while (i < BINS && below + s->bin[i] < s->count / 4) {
        below += s->bin[i++];
    }
    if (i == 0 || i == BINS) { /* none, or nothing was counted */
        return 0.0f;
    }
    const float share = ((float)s->count / 4.0f - (float)below) / (float)s->bin[i];
    return QUARTER * ((float)i + share) * (WIDEST / (float)BINS);
}

/* Steps with few squares take the value of the nearest step that has enough. */
static void fill(mix_grain *g, sizes of[MIX_GRAIN_STEPS][3])
{
    enum { ENOUGH = 256 };
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < MIX_GRAIN_STEPS; ++i) {
            for (int far = 0; far < MIX_GRAIN_STEPS && g->sigma[i][c] == 0.0f; ++far) {
                for (int way = -1; way < 2; way += 2) {
                    const int at = i + way * far;
                    if (at >= 0 && at < MIX_GRAIN_STEPS && of[at][c].count >= ENOUGH && g->sigma[i][c] == 0.0f) {
                        g->sigma[i][c] = deviation(&of[at][c]);
                    }
                }
            }
        }
    }
}

/* A number that looks random: a finaliser of MurmurHash3. */
static uint32_t mixed(uint32_t h)
{
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

static uint32_t seed_of(const image *photo)
{
    const size_t count = (size_t)photo->width * (size_t)photo->height * (size_t)photo->channels;
    uint32_t seed = 0, bits;
    for (size_t i = 0; i < count; ++i) {
        memcpy(&bits, &photo->pixels[i], sizeof bits);
        seed = mixed(seed ^ bits);
    }
    return seed;
}

int mix_grain_find(mix_grain *out, const image *photo)
{
    sizes(*of)[3] = calloc(MIX_GRAIN_STEPS, sizeof *of);
    memset(out, 0, sizeof *out);
    if (of == NULL) {
        return 0;
    }
    for (int32_t y = 0; y + 1 < photo->height; y += 2) {
        for (int32_t x = 0; x + 1 < photo->width; x += 2) {
            for (int c = 0; c < 3; ++c) {
                add_square(of, photo, x, y, c);
            }
        }
    }
    fill(out, of);
    out->seed = seed_of(photo);
    free(of);
    return 1;
}

/* A sum of four even numbers is near to a normal distribution, of deviation 1 here. */
static float noise_of(uint32_t seed, uint32_t x, uint32_t y, uint32_t c)
{
    const uint32_t a = mixed(mixed(seed + x + 8192u * y) + 0x9e3779b9u * (c + 1)), b = mixed(a + 0x7f4a7c15u);
    const float sum = (float)(a & 0xffffu) + (float)(a >> 16) + (float)(b & 0xffffu) + (float)(b >> 16);
    return (sum * (1.0f / 65535.0f) - 2.0f) * 1.7320508f;
}

void mix_grain_add(lmb_radiance *inout, const mix_grain *g, const float covered[LMB_TILE_PIXELS], int32_t x, int32_t y)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int c = 0; c < 3 && covered[k] > 0.0f; ++c) {
            const uint32_t at_x = (uint32_t)(x + k % LMB_TILE), at_y = (uint32_t)(y + k / LMB_TILE);
            const float was = inout->rgb[c][k], value = root(was), noise = noise_of(g->seed, at_x, at_y, (uint32_t)c),
                        now = fmaxf(value + covered[k] * g->sigma[step_of(value)][c] * noise, 0.0f);
            inout->rgb[c][k] = fmaxf(was + (now * now - value * value), 0.0f);
        }
    }
}
