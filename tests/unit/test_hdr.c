/* test_hdr.c: Radiance pictures: written files read back, every coding and orientation, and damaged files. */
#include "../test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/image.h"
#include "../shared_file.h"

void test_hdr(void);

#define HEAD "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"

static report problem;
static image loaded;

/* Header text, then pixel bytes. */
static int decode(const char *head, const void *pixels, size_t n)
{
    uint8_t *file = malloc(strlen(head) + n);
    int ok;
    image_free(&loaded);
    memset(&problem, 0, sizeof problem);
    if (!file) return 0;
    memcpy(file, head, strlen(head));
    if (n) memcpy(file + strlen(head), pixels, n);
    ok = hdr_decode(&loaded, file, strlen(head) + n, "a.hdr", &problem);
    free(file);
    return ok;
}

static void check_fails(int ok, const char *part)
{
    CHECK_MSG(!ok && !loaded.pixels, "loaded, but should say: %s", part);
    CHECK_MSG(strstr(problem.text, part) != NULL, "\"%s\" lacks \"%s\"", problem.text, part);
}

#define CHECK_DECODES(call) CHECK_MSG(call, "%s", problem.text)

static int is_pixel(int32_t x, int32_t y, float r, float g, float b)
{
    const float *p = loaded.pixels ? loaded.pixels + 3 * (y * loaded.width + x) : NULL;
    return p && p[0] == r && p[1] == g && p[2] == b;
}

/* --- writing --- */

/* Half a step of the largest component's 8 bits, at most 1/256 of it; 1/255.5 if the component rounds up to 256 steps
 * and the step doubles. */
static int is_near(const float *a, const float *b)
{
    float max = fmaxf(b[0], fmaxf(b[1], b[2]));
    int i;
    for (i = 0; i < 3; ++i)
        if (!(fabsf(a[i] - b[i]) <= max / 255.4f)) return 0;
    return 1;
}

static void check_round_trip(int32_t width, int32_t height, test_rng *rng)
{
    image in = {0, 0, 3, NULL};
    file_bytes file = {NULL, 0};
    int32_t i, wrong = 0;
    in.width = width;
    in.height = height;
    in.pixels = malloc((size_t)width * (size_t)height * 3 * sizeof(float));
    memset(&problem, 0, sizeof problem);
    image_free(&loaded);
    if (!in.pixels) return;
    for (i = 0; i < 3 * width * height; ++i) { /* runs and noise, from 2^-20 to 2^20 */
        const int exponent = (int)(test_random(rng) % 41) - 20;
        in.pixels[i] = i % 97 < 40 ? 0.75f : ldexpf(test_uniform(rng, 0.0f, 1.0f), exponent);
    }
    CHECK(hdr_encode(&file, &in, &problem));
    CHECK_DECODES(hdr_decode(&loaded, file.data, file.size, "a.hdr", &problem));
    CHECK(loaded.width == width && loaded.height == height && loaded.channels == 3);
    for (i = 0; loaded.pixels && i < width * height; ++i) wrong += !is_near(loaded.pixels + 3 * i, in.pixels + 3 * i);
    CHECK_MSG(wrong == 0, "%dx%d: %d pixels", (int)width, (int)height, (int)wrong);
    file_free(&file);
    free(in.pixels);
}

static void round_trips(void)
{
    static const int32_t widths[] = {1, 2, 7, 8, 9, 127, 128, 129, 500, 32767, 32768};
    test_rng rng = {5};
    size_t i;
    for (i = 0; i < sizeof widths / sizeof widths[0]; ++i)
        check_round_trip(widths[i], widths[i] > 1000 ? 2 : 13, &rng);
}

/* --- codings --- */

static void flat_pixels(void)
{
    static const uint8_t two[8] = {128, 64, 0, 129, 255, 1, 2, 136}, ends[8] = {255, 128, 0, 255, 255, 255, 255, 0};
    static const uint8_t one[4] = {200, 100, 50, 137};
    CHECK_DECODES(decode(HEAD "-Y 1 +X 2\n", two, 8));
    CHECK(is_pixel(0, 0, 1.0f, 0.5f, 0.0f) && is_pixel(1, 0, 255.0f, 1.0f, 2.0f));
    CHECK_DECODES(decode(HEAD "-Y 2 +X 1\n", ends, 8)); /* exponent 0 is black, whatever the mantissas */
    CHECK(is_pixel(0, 0, 255 * 0x1p119f, 0x1p126f, 0.0f) && is_pixel(0, 1, 0.0f, 0.0f, 0.0f));
    CHECK_DECODES(decode("#?RGBE\r\n# made by hand\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\r\n", one, 4));
    CHECK(is_pixel(0, 0, 400.0f, 200.0f, 100.0f));
}

static void old_runs(void)
{
    /* 1 + 2 + 256 + 1 pixels */
    static const uint8_t row[] = {128, 0, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1, 0, 128, 0, 129};
    static const uint8_t zero[] = {128, 0, 0, 129, 1, 1, 1, 0, 1, 1, 1, 1, 0, 0, 128, 129};
    static const uint8_t apart[] = {128, 0, 0, 129, 1, 1, 1, 2, 0, 128, 0, 129, 1, 1, 1, 3};
    CHECK_DECODES(decode(HEAD "-Y 1 +X 260\n", row, sizeof row));
    CHECK(is_pixel(258, 0, 1.0f, 0.0f, 0.0f) && is_pixel(259, 0, 0.0f, 1.0f, 0.0f));
    CHECK_DECODES(decode(HEAD "-Y 1 +X 258\n", zero, sizeof zero));
    CHECK(is_pixel(256, 0, 1.0f, 0.0f, 0.0f) && is_pixel(257, 0, 0.0f, 0.0f, 1.0f));
    CHECK_DECODES(decode(HEAD "-Y 1 +X 7\n", apart, sizeof apart));
    CHECK(is_pixel(2, 0, 1.0f, 0.0f, 0.0f) && is_pixel(3, 0, 0.0f, 1.0f, 0.0f) && is_pixel(6, 0, 0.0f, 1.0f, 0.0f));
    check_fails(decode(HEAD "-Y 1 +X 260\n", row, sizeof row - 4), "the file ends in its pixels");
    check_fails(decode(HEAD "-Y 1 +X 258\n", row, sizeof row), "a run longer than its line");
    check_fails(decode(HEAD "-Y 1 +X 3\n", row + 4, 12), "repeated pixel at the beginning");
}

static void new_runs(void)
{
    static const uint8_t row[] = {2,   2,   0,  10, 138, 128, 3, 1, 2, 3, 135, 4, 138, 0,
                                  130, 129, 8, 130, 130, 130, 130, 130, 130, 130, 130};
    uint8_t bad[sizeof row];
    int i;
    CHECK_DECODES(decode(HEAD "-Y 1 +X 10\n", row, sizeof row));
    CHECK(is_pixel(0, 0, 1.0f, 1 / 128.0f, 0.0f) && is_pixel(2, 0, 2.0f, 6 / 128.0f, 0.0f));
    CHECK(is_pixel(9, 0, 2.0f, 8 / 128.0f, 0.0f));
    check_fails(decode(HEAD "-Y 1 +X 11\n", row, sizeof row), "a line of 10 pixels in a picture whose lines have 11");
    for (i = 4; i < 7; i += 2) {
        memcpy(bad, row, sizeof bad);
        bad[i] = i == 4 ? 139 : 0;
        check_fails(decode(HEAD "-Y 1 +X 10\n", bad, sizeof bad), i == 4 ? "a run of 11 pixels" : "a run of 0");
    }
}

/* A file of 3 x 2 pixels numbered in reading order: the expected order for each orientation. */
static void orientations(void)
{
    static const struct {
        const char *size;
        uint8_t order[6];
    } ways[] = {
        {"-Y 2 +X 3\n", {0, 1, 2, 3, 4, 5}}, {"-Y 2 -X 3\n", {2, 1, 0, 5, 4, 3}}, {"+Y 2 +X 3\n", {3, 4, 5, 0, 1, 2}},
        {"+Y 2 -X 3\n", {5, 4, 3, 2, 1, 0}}, {"+X 3 -Y 2\n", {0, 3, 1, 4, 2, 5}}, {"-X 3 -Y 2\n", {2, 5, 1, 4, 0, 3}},
        {"+X 3 +Y 2\n", {3, 0, 4, 1, 5, 2}}, {"-X 3 +Y 2\n", {5, 2, 4, 1, 3, 0}},
    };
    uint8_t pixels[24];
    char head[128];
    size_t i;
    int32_t k;
    for (i = 0; i < sizeof ways / sizeof ways[0]; ++i) {
        for (k = 0; k < 6; ++k) {
            memset(pixels + 4 * k, 0, 4);
            pixels[4 * k] = (uint8_t)(128 + ways[i].order[k]);
            pixels[4 * k + 3] = 136;
        }
        snprintf(head, sizeof head, HEAD "%s", ways[i].size);
        CHECK_DECODES(decode(head, pixels, sizeof pixels));
        CHECK(loaded.width == 3 && loaded.height == 2);
        for (k = 0; k < 6; ++k) CHECK_MSG(is_pixel(k % 3, k / 3, 128.0f + (float)k, 0, 0), "%s", ways[i].size);
    }
}

static void exposures(void)
{
    static const uint8_t one[4] = {128, 128, 128, 129}, bright[4] = {255, 255, 255, 255};
    CHECK_DECODES(decode("#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\nEXPOSURE= 4 \nCOLORCORR=1 .5 2\n\n"
                         "-Y 1 +X 1\n", one, 4));
    CHECK(is_pixel(0, 0, 0.125f, 0.25f, 0.0625f));
    CHECK_DECODES(decode("#?RADIANCE\nEXPOSURE=0.001\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n", bright, 4));
    CHECK(loaded.pixels && isfinite(loaded.pixels[0]));
    CHECK_DECODES(decode("#?RADIANCE\n\tEXPOSURE=9\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n", one, 4));
    CHECK(is_pixel(0, 0, 1, 1, 1)); /* an indented line describes a source picture */
}

/* --- damage --- */

static void refuses(void)
{
    static const struct {
        const char *head, *says;
    } bad[] = {
        {"", "does not begin with #?"},
        {"#", "does not begin with #?"},
        {"#?RADIANCE", "ends in its header"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "ends in its header"},
        {"#?RADIANCE\n\n-Y 1 +X 1\n", "has no FORMAT"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "not 32-bit_rle_rgbe"},
        {"#?RADIANCE\nEXPOSURE=0\n", "usable numbers"},
        {"#?RADIANCE\nEXPOSURE=-1\n", "usable numbers"},
        {"#?RADIANCE\nEXPOSURE=nan\n", "usable numbers"},
        {"#?RADIANCE\nEXPOSURE=1 2\n", "usable numbers"},
        {"#?RADIANCE\nEXPOSURE=1e29\nEXPOSURE=1e29\nEXPOSURE=1e29\n", "leave no picture"},
        {"#?RADIANCE\nCOLORCORR=1 2\n", "usable numbers"},
        {HEAD, "ends in its header"},
        {HEAD "-Y 1 +Y 1\n", "must stand a size"},
        {HEAD "-Y 1\n", "must stand a size"},
        {HEAD "-Y 0 +X 1\n", "must stand a size"},
        {HEAD "-Y  1 +X 1\n", "must stand a size"},
        {HEAD "-Y 1 +X 1 \n", "must stand a size"},
        {HEAD "Y 1 +X 1\n", "must stand a size"},
        {HEAD "-Y 1 +X -1\n", "must stand a size"},
        {HEAD "-Y 99999999999999999999 +X 1\n", "must stand a size"},
        {HEAD "-Y 16385 +X 16384\n", "must stand a size"},
        {HEAD "-Y 1 +X 1\n", "do not fit the rest of the file"},
        {HEAD "-Y 16384 +X 16384\n", "do not fit the rest of the file"},
        {HEAD "-Y 1 +X 268435456\nabcdefgh", "more than 1024 times the file"},
        {HEAD "-Y 1 +X 1\nabcde", "1 bytes behind the last pixel"},
    };
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i) check_fails(decode(bad[i].head, NULL, 0), bad[i].says);
}

/* Every prefix is refused; a flipped bit gives a picture or a message. */
static void damage(void)
{
    static const uint8_t lines[] = {2,   2, 0, 8, 136, 128, 136, 3, 4, 1, 2, 3, 4, 132, 9, 136, 130,
                                    200, 0, 0, 130, 1, 1, 1, 7};
    static const char head[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 2 +X 8\n";
    enum { SIZE = sizeof head - 1 + sizeof lines };
    uint8_t file[SIZE];
    size_t n;
    memcpy(file, head, sizeof head - 1);
    memcpy(file + sizeof head - 1, lines, sizeof lines);
    CHECK_DECODES(decode(head, lines, sizeof lines));
    for (n = 0; n < SIZE; ++n) {
        uint8_t *exact = malloc(n + 1); /* so that a sanitizer detects one byte too many */
        if (!exact) return;
        memcpy(exact + 1, file, n);
        image_free(&loaded);
        memset(&problem, 0, sizeof problem);
        CHECK(!hdr_decode(&loaded, exact + 1, n, "a.hdr", &problem) && problem.text[0] && !loaded.pixels);
        free(exact);
    }
    for (n = 0; n < 8 * (size_t)SIZE; ++n) {
        file[n / 8] ^= (uint8_t)(1u << n % 8);
        image_free(&loaded);
        memset(&problem, 0, sizeof problem);
        CHECK(hdr_decode(&loaded, file, SIZE, "a.hdr", &problem) ? loaded.pixels != NULL : problem.text[0] != '\0');
        file[n / 8] ^= (uint8_t)(1u << n % 8);
    }
}

/* --- real files --- */

static const struct {
    const char *name;
    int32_t width;
    double peak;
} known[] = {
    {"venice_sunset_1024x512.hdr", 1024, 6496},    {"potsdamer_platz_512x256.hdr", 512, 11.19},
    {"studio_small_03_512x256.hdr", 512, 3520},    {"forest_slope_512x256.hdr", 512, 61},
    {"dikhololo_night_512x256.hdr", 512, 30},
};

/* Peaks are known to four digits. */
static void check_known(const char *path, int32_t width, double peak)
{
    file_bytes file;
    double max = 0;
    int32_t i;
    image_free(&loaded);
    memset(&problem, 0, sizeof problem);
    CHECK_DECODES(file_read(&file, path, &problem));
    if (problem.text[0]) return;
    CHECK_DECODES(hdr_decode(&loaded, file.data, file.size, path, &problem));
    CHECK(loaded.width == width && loaded.height == width / 2);
    for (i = 0; loaded.pixels && i < 3 * loaded.width * loaded.height; ++i)
        max = fmax(max, (double)loaded.pixels[i]);
    CHECK_MSG(fabs(max - peak) < 0.0005 * peak, "%s: peak %.6g, not %g", path, max, peak);
    file_free(&file);
}

static void known_files(void)
{
    char path[SHARED_PATH], name[64];
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i) {
        snprintf(name, sizeof name, "data/env/%s", known[i].name);
        if (shared_file(path, name)) check_known(path, known[i].width, known[i].peak);
    }
}

void test_hdr(void)
{
    round_trips();
    flat_pixels();
    old_runs();
    new_runs();
    orientations();
    exposures();
    refuses();
    damage();
    known_files();
    image_free(&loaded);
}
