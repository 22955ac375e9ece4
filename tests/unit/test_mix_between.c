/* test_mix_between.c: light traced at the corners of a tile: even light stays even, surfaces do not mix, isolated pixels
 * are traced. */
#include "../../tools/mix/mix_between.h"
#include "../world.h"

void test_mix_between(void);

static lmb_tile tile;
static lmb_irradiance light;

/* A tile of the plane z = 0 with 1 cm per pixel, viewed from above. */
static void flat_tile(void)
{
    memset(&tile, 0, sizeof tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.position, k, vec3(0.01f * (float)(k % 8), 0.01f * (float)(k / 8), 0.0f));
        set_plane(tile.face, k, Z);
        set_plane(tile.normal, k, Z);
        tile.id[k] = 1;
    }
    tile.hits = LMB_TILE_PIXELS;
}

static void set_light(int k, float v)
{
    for (int c = 0; c < 3; ++c) {
        light.rgb[c][k] = v * (float)(c + 1);
    }
}

/* Sets unknown pixels to an extreme value, so that using one shows. */
static void forget(uint64_t known)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((known >> k & 1u) == 0) {
            set_light(k, -1e6f);
        }
    }
}

static int count(uint64_t bits)
{
    int n = 0;
    for (; bits != 0; bits &= bits - 1) {
        ++n;
    }
    return n;
}

/* A constant gives exactly this value; a slope gives the slope. */
static void even_light(void)
{
    flat_tile();
    const uint64_t known = mix_between_pixels(&tile);
    CHECK(count(known) == 4);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_light(k, 0.1f);
    }
    forget(known);
    CHECK(mix_between_fill(&light, &tile, known) == 0);
    int exact = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        exact += light.rgb[0][k] == 0.1f && light.rgb[1][k] == 0.2f && light.rgb[2][k] == 0.1f * 3.0f;
    }
    CHECK_MSG(exact == LMB_TILE_PIXELS, "%d of 64", exact);
    float worst = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_light(k, 2.0f + 0.05f * (float)(k % 8) + 0.03f * (float)(k / 8));
    }
    forget(known);
    CHECK(mix_between_fill(&light, &tile, known) == 0);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        worst = maxf(worst, absf(light.rgb[0][k] - (2.0f + 0.05f * (float)(k % 8) + 0.03f * (float)(k / 8))));
    }
    CHECK_MSG(worst < 1e-6f, "%g", (double)worst);
}

/* Both lights increase downwards; the second is far brighter. */
static float two_lights(int k, int border)
{
    return (k % 8 >= border ? 50.0f : 0.5f) * (1.0f + 0.03f * (float)(k / 8));
}

/* Two surfaces, with the border at each column in turn: neither takes light from the other. `wall`: they meet in a
 * corner; otherwise the second lies 10 cm below the first. */
static void two_surfaces(int wall)
{
    int wrong = 0, asked = 0;
    for (int border = 1; border < 8; ++border) {
        flat_tile();
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            if (k % 8 >= border && wall) {
                set_plane(tile.position, k,
                          vec3(0.01f * (float)border, 0.01f * (float)(k / 8), 0.01f * (float)(k % 8 - border)));
                set_plane(tile.face, k, mul3(X, -1.0f));
                set_plane(tile.normal, k, mul3(X, -1.0f));
            } else if (k % 8 >= border) {
                tile.position[2][k] = -0.1f;
            }
        }
        const uint64_t known = mix_between_pixels(&tile);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            set_light(k, two_lights(k, border));
        }
        forget(known);
        CHECK(mix_between_fill(&light, &tile, known) == 0);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            wrong += absf(light.rgb[0][k] / two_lights(k, border) - 1.0f) > 1e-5f;
        }
        asked += count(known);
    }
    CHECK_MSG(wrong == 0, "%d pixels", wrong);
    CHECK_MSG(asked < 7 * 64, "all pixels traced"); /* the corners explain some pixels */
}

/* A single pixel unlike its surroundings, or turned away: only this one is traced besides the corners. */
static void lone_pixel(void)
{
    const int lone = 3 + 8 * 4;
    flat_tile();
    const uint64_t samples = mix_between_pixels(&tile);
    tile.position[2][lone] = 0.5f;
    CHECK(mix_between_pixels(&tile) == (samples | UINT64_C(1) << lone));
    flat_tile();
    set_plane(tile.normal, lone, normalize3(vec3(1, 0, 1)));
    CHECK(mix_between_pixels(&tile) == (samples | UINT64_C(1) << lone));
    flat_tile();
    tile.id[lone] = 0;
    CHECK(mix_between_pixels(&tile) == samples);
}

/* Light that ends between two corners: the pixels in between are returned for tracing, the others are not. */
static void uneven_light(void)
{
    flat_tile();
    const uint64_t known = mix_between_pixels(&tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_light(k, k % 8 > 4 ? 1.0f : 0.5f);
    }
    const uint64_t between = UINT64_C(0x7e7e7e7e7e7e7e7e);
    CHECK(mix_between_fill(&light, &tile, known) == (between & ~known));
}

void test_mix_between(void)
{
    even_light();
    two_surfaces(0);
    two_surfaces(1);
    lone_pixel();
    uneven_light();
}
