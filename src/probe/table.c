/* table.c: directions of the texels in a latitude-longitude map, and tables for the filters. Layer 5.    [S9 S10] */
#include <string.h>

#include "../base/memory_check.h"
#include "../base/poly.h"
#include "cube.h"
#include <lambent/probe.h>

enum { ROW_WAVES = 9, LEGENDRE = 15 };

static int is_table_size(int32_t width, int32_t height)
{
    return height >= 8 && height <= 512 && height % 8 == 0 && width == 2 * height;
}

/* Size in 32-bit words. */
static size_t table_words(int32_t width, int32_t height)
{
    const size_t w = (size_t)width, h = (size_t)height;
    return 3 * w * h / 2 + h + ROW_WAVES * w + LEGENDRE * h + w / 2 * (h / 2) + 3 * LMB_PROBE_TEXELS +
           LMB_PROBE_BORDERED / 2;
}

size_t lmb_probe_table_bytes(int32_t width, int32_t height)
{
    return is_table_size(width, height) ? 4 * table_words(width, height) : 0;
}

static uint16_t code_of_cosine(float d) { return (uint16_t)(clampf(d, -1.0f, 1.0f) * 32767.5f + 32768.0f); }

static float latitude(int32_t row, int32_t height) { return LMB_PI * ((float)(2 * row + 1) / (float)(2 * height)); }

static void set_directions(lmb_probe_table *t, const float *longitude_cos, const float *longitude_sin)
{
    const size_t count = (size_t)t->width * (size_t)t->height;
    for (int32_t row = 0; row < t->height; ++row) {
        const float from_north = latitude(row, t->height), round = lmb_sin(from_north), up = lmb_cos(from_north);
        for (int32_t x = 0; x < t->width; ++x) {
            uint16_t *d = t->direction + (size_t)row * (size_t)t->width + (size_t)x;
            d[0] = code_of_cosine(round * longitude_sin[x]);
            d[count] = code_of_cosine(up);
            d[2 * count] = code_of_cosine(-round * longitude_cos[x]);
        }
    }
}

/* The height of a row between latitudes a and b is cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2). */
static void set_areas(lmb_probe_table *t)
{
    const float half = lmb_sin(0.5f * LMB_PI / (float)t->height), per_column = 2.0f * LMB_PI / (float)t->width;
    for (int32_t row = 0; row < t->height; ++row) {
        t->area[row] = per_column * (2.0f * lmb_sin(latitude(row, t->height)) * half);
    }
}

static void set_waves(lmb_probe_table *t, float start)
{
    for (int32_t x = 0; x < t->width; ++x) {
        const float a = start + 2.0f * LMB_PI * ((float)(2 * x + 1) / (float)(2 * t->width));
        for (int32_t m = 0; m < 5; ++m) {
            t->wave[m * t->width + x] = lmb_cos((float)m * a);
            if (m > 0) {
                t->wave[(4 + m) * t->width + x] = lmb_sin((float)m * a);
            }
        }
    }
}

/* Normalized Legendre functions without (-1)^m, of y = cos of the angle from north: sqrt((2l+1)/4pi (l-m)!/(l+m)!)
 * P_lm, times sqrt 2 for m > 0. */
static void legendre(float out[LEGENDRE], float y)
{
    const float y2 = y * y, s2 = maxf(1.0f - y2, 0.0f), s = sqrtf(s2);
    const float p[LEGENDRE] = {
        0.282094792f,
        0.488602512f * y, 0.488602512f * s,
        0.315391565f * (3.0f * y2 - 1.0f), 1.092548431f * (s * y), 0.546274215f * s2,
        0.373176333f * (y * (5.0f * y2 - 3.0f)), 0.457045799f * (s * (5.0f * y2 - 1.0f)), 1.445305721f * (s2 * y),
        0.590043590f * (s2 * s),
        0.105785547f * ((35.0f * y2 - 30.0f) * y2 + 3.0f), 0.669046544f * (s * (y * (7.0f * y2 - 3.0f))),
        0.473087348f * (s2 * (7.0f * y2 - 1.0f)), 1.770130769f * (s2 * (s * y)), 0.625835735f * (s2 * s2)};
    memcpy(out, p, sizeof p);
}

/* Averages over each row with three-point Gauss quadrature: exact for m = 0, so a constant world has a single
 * harmonic. */
static void set_legendre(lmb_probe_table *t)
{
    for (int32_t row = 0; row < t->height; ++row) {
        const float top = lmb_cos(LMB_PI * ((float)row / (float)t->height)),
                    bottom = lmb_cos(LMB_PI * ((float)(row + 1) / (float)t->height));
        const float middle = 0.5f * (top + bottom), reach = 0.774596669f * (0.5f * (top - bottom));
        float low[LEGENDRE], mean[LEGENDRE], high[LEGENDRE];
        legendre(low, middle - reach);
        legendre(mean, middle);
        legendre(high, middle + reach);
        for (int32_t i = 0; i < LEGENDRE; ++i) {
            t->legendre[i * t->height + row] = (5.0f * (low[i] + high[i]) + 8.0f * mean[i]) * (1.0f / 18.0f);
        }
    }
}

static void set_lights(lmb_probe_table *t)
{
    const int32_t n = LMB_PROBE_SIDE;
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const lmb_vec3 d = cube_nth_direction(i, n);
        t->light[i] = d.x;
        t->light[LMB_PROBE_TEXELS + i] = d.y;
        t->light[2 * LMB_PROBE_TEXELS + i] = d.z;
    }
}

/* Four texels share the direction of their common corner. */
static void set_row_shares(lmb_probe_table *t, float start)
{
    enum { SIDE = LMB_PROBE_SIDE + 2 };
    for (int32_t i = 0; i < t->width / 2 * (t->height / 2); ++i) {
        const float down = LMB_PI * ((float)(2 * (i / (t->width / 2)) + 1) / (float)t->height);
        const float a = start + 2.0f * LMB_PI * ((float)(2 * (i % (t->width / 2)) + 1) / (float)t->width);
        const float round = lmb_sin(down);
        float u, v;
        const int32_t face = cube_face(&u, &v, vec3(round * lmb_sin(a), lmb_cos(down), -round * lmb_cos(a)));
        const float x = (u + 1.0f) * (0.5f * LMB_PROBE_SIDE), y = (v + 1.0f) * (0.5f * LMB_PROBE_SIDE);
        const int32_t x0 = mini((int32_t)x, LMB_PROBE_SIDE - 1), y0 = mini((int32_t)y, LMB_PROBE_SIDE - 1);
        t->share[i].slot = (uint16_t)((face * SIDE + y0) * SIDE + x0);
        t->share[i].x = (uint8_t)((x - (float)x0) * 255.0f + 0.5f);
        t->share[i].y = (uint8_t)((y - (float)y0) * 255.0f + 0.5f);
    }
}

static void set_fold(lmb_probe_table *t)
{
    enum { N = LMB_PROBE_SIDE, SIDE = N + 2 };
    for (int32_t i = 0; i < LMB_PROBE_BORDERED; ++i) {
        const int32_t face = i / (SIDE * SIDE), x = i % SIDE - 1, y = i / SIDE % SIDE - 1;
        const cube_place own = {face, x, y};
        const cube_place p = x < 0 || y < 0 || x >= N || y >= N ? cube_border(face, x, y, N) : own;
        t->fold[i] = (uint16_t)((p.face * N + p.y) * N + p.x);
    }
}

lmb_status lmb_probe_table_init(lmb_probe_table *out, int32_t width, int32_t height, float start_deg, void *memory,
                                size_t bytes)
{
    if (out == NULL || !is_table_size(width, height) || !(start_deg >= -360.0f && start_deg <= 360.0f)) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_probe_table_bytes(width, height));
    if (status != LMB_OK) {
        return status;
    }
    const size_t w = (size_t)width, h = (size_t)height;
    out->width = width;
    out->height = height;
    out->start = start_deg * (LMB_PI / 180.0f);
    out->direction = (uint16_t *)memory;
    out->area = (float *)memory + 3 * w * h / 2;
    out->wave = out->area + h;
    out->legendre = out->wave + ROW_WAVES * w;
    out->light = out->legendre + LEGENDRE * h;
    out->share = (lmb_probe_share *)(void *)(out->light + 3 * LMB_PROBE_TEXELS);
    out->fold = (uint16_t *)(void *)(out->share + w / 2 * (h / 2));
    set_waves(out, out->start);
    set_areas(out);
    set_legendre(out);
    set_lights(out);
    set_row_shares(out, out->start);
    set_fold(out);
    set_directions(out, out->wave + w, out->wave + 5 * w);
    return LMB_OK;
}
