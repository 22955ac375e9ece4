/* test_tone.c: display formats and light over white: the curve, automatic exposure, alpha in a PNG. */
#include "../test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/picture.h"

void test_tone(void);

static void expose(float out[3], float r, float g, float b, int tone)
{
    image one = {1, 1, 3, out};
    out[0] = r;
    out[1] = g;
    out[2] = b;
    picture_expose(&one, 0.0f, tone);
}

static void check_curve(void)
{
    float rgb[3], last = 0.0f;
    for (int i = 0; i < 400; ++i) {
        const float v = 0.01f * expf(0.1f * (float)i);
        expose(rgb, v, v, v, PICTURE_CURVED);
        CHECK_MSG(v > 0.76f || fabsf(rgb[0] - v) < 1e-7f, "%g becomes %g", (double)v, (double)rgb[0]);
        CHECK_MSG(rgb[0] >= last && rgb[0] <= 1.0f && rgb[0] == rgb[1] && rgb[1] == rgb[2], "%g becomes %g", (double)v,
                  (double)rgb[0]);
        last = rgb[0];
    }
    /* Khronos PBR Neutral of (4, 2, 1), without the toe: compressed peak 1 - 0.0576 / 3.48, desaturated by 0.31. */
    expose(rgb, 4, 2, 1, PICTURE_CURVED);
    const double bent = 1 - 0.24 * 0.24 / (4 + 0.24 - 0.76), faded = 1 - 1 / (0.15 * (4 - bent) + 1);
    CHECK(fabs((double)rgb[0] - bent) < 1e-6);
    CHECK(fabs((double)rgb[1] - (bent / 2 + (bent - bent / 2) * faded)) < 1e-6);
    CHECK(fabs((double)rgb[2] - (bent / 4 + (bent - bent / 4) * faded)) < 1e-6);
    expose(rgb, 4, 2, 1, PICTURE_CLIPPED);
    CHECK(rgb[0] == 4 && rgb[1] == 2 && rgb[2] == 1);
    expose(rgb, INFINITY, 3e38f, 0, PICTURE_CURVED);
    CHECK(rgb[0] >= 0 && rgb[0] <= 1 && rgb[1] <= 1 && rgb[2] >= 0);
}

static void check_exposure(void)
{
    static float pixels[300 * 3];
    image p = {300, 1, 3, pixels};
    for (int i = 0; i < 900; ++i) {
        pixels[i] = 0.25f;
    }
    const float before = picture_auto_exposure(&p, PICTURE_CLIPPED);
    CHECK_MSG(before == 1.875f, "%g", (double)before);
    CHECK(picture_auto_exposure(&p, PICTURE_CURVED) == 0.625f); /* from half of the pixels */
    for (int i = 0; i < 453; ++i) {
        pixels[i] = 0.01f;
    }
    CHECK(picture_auto_exposure(&p, PICTURE_CLIPPED) == before);
    CHECK(picture_auto_exposure(&p, PICTURE_CURVED) == 2.25f); /* from the brightest hundredth */
    pixels[0] = pixels[1] = pixels[2] = 1e8f; /* a speck */
    CHECK(picture_auto_exposure(&p, PICTURE_CLIPPED) == before);
    uint8_t *codes = picture_codes(&p, 0.0f, PICTURE_CURVED);
    CHECK(codes != NULL && codes[0] == 255 && codes[897] == 137);
    free(codes);
    for (int i = 0; i < 900; ++i) {
        pixels[i] = i < 12 ? 4.0f : 0.25f; /* a 75th of the pixels is no speck and keeps its tones */
    }
    CHECK(picture_auto_exposure(&p, PICTURE_CLIPPED) == -2.125f && picture_auto_exposure(&p, PICTURE_CURVED) == -1.75f);
    for (int i = 0; i < 900; ++i) {
        pixels[i] = i < 18 ? 1e5f : 0.01f; /* a lamp close to a wall */
    }
    codes = picture_codes(&p, picture_auto_exposure(&p, PICTURE_CURVED), PICTURE_CURVED);
    CHECK_MSG(codes != NULL && codes[0] == 255 && codes[899] > 38 && codes[899] < 48, "%d", codes[899]);
    free(codes);
}

static void check_alpha(void)
{
    static float pixels[6] = {0.25f, 0.125f, 0, 0, 0, 0};
    static const float alpha[2] = {0.5f, 0.0f};
    const image p = {2, 1, 3, pixels};
    report r = {""};
    file_bytes file;
    bitmap got;
    CHECK(picture_encode_alpha(&file, &p, alpha, 0.0f, PICTURE_CLIPPED, &r));
    CHECK(png_decode(&got, file.data, file.size, "tone.png", &r) && got.width == 2);
    CHECK(got.texels[0] == 188 && got.texels[1] == 137 && got.texels[2] == 0 && got.texels[3] == 128);
    CHECK(got.texels[7] == 0);
    bitmap_free(&got);
    file_free(&file);
}

void test_tone(void)
{
    check_curve();
    check_exposure();
    check_alpha();
}
