/* sh.c: a map's spherical harmonics, and irradiance from them. Layer 5.                                          [S25]
 *
 * A harmonic is a function of latitude times cos m a or sin m a. Each row is first summed against the nine waves, then
 * the waves against the latitude functions: width x 9 products per row instead of width x 25. */
#include <string.h>

#include "../base/vec.h"
#include "cube.h"
#include <lambent/probe.h>

enum { SH_WAVES = 9, BANDS = 5 };

/* Index of harmonic l, m >= 0. */
static int32_t index_of_harmonic(int32_t l, int32_t m) { return l * (l + 1) / 2 + m; }

static void row_waves(float out[SH_WAVES], const float *row, const lmb_probe_table *t)
{
    for (int32_t w = 0; w < SH_WAVES; ++w) {
        const float *wave = t->wave + w * t->width;
        float sum[8] = {0}; /* eight independent sums, which compilers keep in registers */
        for (int32_t x = 0; x < t->width; x += 8) {
            for (int32_t i = 0; i < 8; ++i) {
                sum[i] += row[x + i] * wave[x + i];
            }
        }
        out[w] = ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
    }
}

static void add_map_row(float inout[LMB_SH_25], const float wave[SH_WAVES], const lmb_probe_table *t, int32_t y)
{
    for (int32_t l = 0; l < BANDS; ++l) {
        for (int32_t m = 0; m <= l; ++m) {
            const float part = t->area[y] * t->legendre[index_of_harmonic(l, m) * t->height + y];
            inout[l * l + l + m] += part * wave[m];
            if (m > 0) {
                inout[l * l + l - m] += part * wave[4 + m];
            }
        }
    }
}

lmb_status lmb_probe_sh(float coefficient[3][LMB_SH_25], const float *map, const lmb_probe_table *table)
{
    if (coefficient == NULL || map == NULL || table == NULL || table->wave == NULL) {
        return LMB_ERR_ARG;
    }
    memset(coefficient, 0, 3 * sizeof *coefficient);
    for (int32_t c = 0; c < 3; ++c) {
        for (int32_t y = 0; y < table->height; ++y) {
            float wave[SH_WAVES];
            row_waves(wave, map + (size_t)(c * table->height + y) * (size_t)table->width, table);
            add_map_row(coefficient[c], wave, table, y);
        }
    }
    return LMB_OK;
}

/* Evaluates the harmonics at d as polynomials. The axis is +y, longitude is atan2(x, -z); e is -z. */
static void harmonics(float out[LMB_SH_25], lmb_vec3 d)
{
    const float y = d.y, e = -d.z, x = d.x, y2 = y * y;
    const float c2 = e * e - x * x, s2 = 2.0f * (e * x);                  /* s^m cos, sin of 2 a */
    const float c3 = c2 * e - s2 * x, s3 = c2 * x + s2 * e;               /* 3 a */
    const float c4 = c2 * c2 - s2 * s2, s4 = 2.0f * (c2 * s2);            /* 4 a */
    const float p1 = 0.488602512f, p21 = 1.092548431f * y, p22 = 0.546274215f;
    const float p31 = 0.457045799f * (5.0f * y2 - 1.0f), p32 = 1.445305721f * y, p33 = 0.590043590f;
    const float p41 = 0.669046544f * (y * (7.0f * y2 - 3.0f)), p42 = 0.473087348f * (7.0f * y2 - 1.0f),
                p43 = 1.770130769f * y, p44 = 0.625835735f;
    const float h[LMB_SH_25] = {
        0.282094792f,
        p1 * x, p1 * y, p1 * e,
        p22 * s2, p21 * x, 0.315391565f * (3.0f * y2 - 1.0f), p21 * e, p22 * c2,
        p33 * s3, p32 * s2, p31 * x, 0.373176333f * (y * (5.0f * y2 - 3.0f)), p31 * e, p32 * c2, p33 * c3,
        p44 * s4, p43 * s3, p42 * s2, p41 * x, 0.105785547f * ((35.0f * y2 - 30.0f) * y2 + 3.0f), p41 * e, p42 * c2,
        p43 * c3, p44 * c4};
    memcpy(out, h, sizeof h);
}

lmb_status lmb_probe_sh_cube(float *cube, int32_t n, const float coefficient[3][LMB_SH_25], int32_t terms)
{
    /* Harmonics of the clamped cosine: pi, 2 pi / 3, pi / 4, 0, -pi / 24. [Ramamoorthi and Hanrahan 2001] */
    static const float band[BANDS] = {3.14159265f, 2.09439510f, 0.785398163f, 0.0f, -0.130899694f};
    if (cube == NULL || coefficient == NULL || n < 1 || n > 64 ||
        (terms != LMB_SH_9 && terms != LMB_SH_16 && terms != LMB_SH_25)) {
        return LMB_ERR_ARG;
    }
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        float h[LMB_SH_25];
        harmonics(h, cube_nth_direction(i, n));
        for (int32_t c = 0; c < 3; ++c) {
            float sum = 0.0f;
            for (int32_t l = 0; l * l < terms; ++l) {
                for (int32_t k = l * l; k < (l + 1) * (l + 1); ++k) {
                    sum += band[l] * (coefficient[c][k] * h[k]);
                }
            }
            cube[(size_t)c * 6 * (size_t)(n * n) + (size_t)i] = sum;
        }
    }
    return LMB_OK;
}
