/* test_compare.c: error figures against values computed by hand, and the exit statuses of the verb. */
#include "../test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../tools/cli/verb_compare.h"
#include "../../tools/picture/metrics.h"

void test_compare(void);

enum { SIDE = 10, COUNT = SIDE * SIDE };

/* Two pictures of 10 x 10 with a mask and classes, which a test can change before measuring. */
typedef struct pair {
    float test[3 * COUNT], truth[3 * COUNT], surface[3 * COUNT], classes[COUNT];
} pair;

static void set_pixel(float *picture, int i, float grey)
{
    for (int k = 0; k < 3; ++k)
        picture[3 * i + k] = grey;
}

/* Fills both pictures; all pixels are surface and open. */
static void fill(pair *p, float test, float truth)
{
    for (int i = 0; i < COUNT; ++i) {
        set_pixel(p->test, i, test);
        set_pixel(p->truth, i, truth);
        set_pixel(p->surface, i, 1.0f);
        p->classes[i] = 1.0f;
    }
}

static metrics_input input_of(const pair *p, int masked, int classed)
{
    metrics_input in = {p->test, p->truth, masked ? p->surface : NULL, classed ? p->classes : NULL, SIDE, SIDE, 3};
    return in;
}

static metrics measured(const pair *p, int masked, int classed)
{
    metrics_input in = input_of(p, masked, classed);
    report r = {""};
    metrics m;
    CHECK_MSG(metrics_measure(&m, &in, &r), "%s", r.text);
    return m;
}

static int near(double a, double b) { return fabs(a - b) <= 1e-12 * (1.0 + fabs(b)); }

/* Without a mask. */
static double worst_of(pair *p)
{
    const metrics m = measured(p, 0, 0);
    const metrics_input in = input_of(p, 0, 0);
    return metrics_worst(&m, &in);
}

/* Without a mask: returns whether the worst pixel is at (x, y) with this error. */
static int worst_is(const pair *p, double error, int x, int y)
{
    const metrics m = measured(p, 0, 0);
    const metrics_input in = input_of(p, 0, 0);
    int32_t at_x, at_y;
    const double got = metrics_worst_pixel(&at_x, &at_y, &m, &in);
    return near(got, error) && at_x == x && at_y == y;
}

static metrics_equality compared(const pair *p, double peak)
{
    metrics_input in = input_of(p, 0, 0);
    metrics_equality e;
    metrics_compare(&e, &in, peak);
    return e;
}

static void test_equal(pair *p)
{
    fill(p, 0.5f, 0.5f);
    metrics m = measured(p, 0, 0);
    metrics_equality e = compared(p, 0.0);
    CHECK(m.rmse == 0.0 && m.trim == 0.0 && m.e50 == 0.0 && m.e95 == 0.0 && m.e99 == 0.0);
    CHECK(m.mean == 1.0 && m.n90 == 0 && m.pixels == COUNT && m.nonfinite == 0 && !m.has_leak);
    CHECK(isinf(e.psnr_db) && e.psnr_db > 0.0 && e.max_abs == 0.0 && e.max_x == -1);
    CHECK(e.exact == COUNT && e.pixels == COUNT && e.first_x == -1 && e.peak == 0.5);
}

/* Truth 2, test 2.5: each squared error 0.25; 90 of 100 equal ones make 90 %; 0.5 / (2 + 0.02) each. */
static void test_offset(pair *p)
{
    fill(p, 2.5f, 2.0f);
    metrics m = measured(p, 0, 0);
    metrics_equality e = compared(p, 0.0);
    CHECK(near(m.rmse, 0.25) && near(m.trim, 0.25) && near(m.mean, 1.25) && m.n90 == 90);
    CHECK(near(m.e50, 0.5 / 2.02) && near(m.e95, 0.5 / 2.02) && near(m.e99, 0.5 / 2.02));
    CHECK(near(e.psnr_db, 10.0 * log10(16.0)) && e.max_abs == 0.5 && e.max_x == 0 && e.max_y == 0);
    CHECK(e.exact == 0 && e.first_x == 0 && e.first_y == 0);
    CHECK(near(compared(p, 255.0).psnr_db, 10.0 * log10(65025.0 / 0.25)));
}

/* One pixel is 10 too bright in one channel: squared error 100 / 3, entirely in the trimmed hundredth; grey 10 / 3. */
static void test_outlier(pair *p)
{
    fill(p, 1.0f, 1.0f);
    p->test[3 * 57 + 1] = 11.0f;
    metrics m = measured(p, 0, 0);
    metrics_equality e = compared(p, 0.0);
    CHECK(near(m.rmse, sqrt(1.0 / 3.0)) && m.trim == 0.0 && m.n90 == 1);
    CHECK(m.e50 == 0.0 && m.e95 == 0.0 && near(m.e99, 10.0 / 3.0 / 1.01));
    CHECK(near(worst_of(p), 10.0 / 3.0 / 1.01));
    set_pixel(p->truth, 58, 6.0f); /* mean of the truth: 1.2 over the 25 pixels around, 1.05 over all */
    set_pixel(p->test, 58, 6.0f);
    CHECK(near(worst_of(p), 10.0 / 3.0 / (1.2 + 0.0105)) && worst_is(p, 10.0 / 3.0 / (1.2 + 0.0105), 7, 5));
    set_pixel(p->truth, 58, 1.0f);
    set_pixel(p->test, 58, 1.0f);
    CHECK(near(m.mean, 1.0 + 1.0 / 30.0));
    CHECK(e.max_abs == 10.0 && e.max_x == 7 && e.max_y == 5 && e.first_x == 7 && e.first_y == 5);
    CHECK(e.exact == COUNT - 1 && near(e.psnr_db, 10.0 * log10(3.0)));
    p->surface[2] = 0.0f; /* a hundredth of 99 pixels is none */
    m = measured(p, 1, 0);
    CHECK(near(m.trim, m.rmse) && m.n90 == 1);
}

/* Errors of 1 .. 100 hundredths on a truth of 1: the element of each percentile, of 100 and of 50. */
static void test_percentiles(pair *p)
{
    fill(p, 1.0f, 1.0f);
    for (int i = 0; i < COUNT; ++i)
        set_pixel(p->test, i, 1.0f + (float)((i * 37) % COUNT + 1) * 0.015625f);
    metrics m = measured(p, 0, 0);
    CHECK(near(m.e50, 51 * 0.015625 / 1.01) && near(m.e95, 96 * 0.015625 / 1.01) &&
          near(m.e99, 100 * 0.015625 / 1.01));
    for (int i = 0; i < COUNT; ++i)
        set_pixel(p->surface, i, (i * 37) % COUNT < 50 ? 1.0f : 0.0f);
    m = measured(p, 1, 0);
    CHECK(near(m.e50, 26 * 0.015625 / 1.01) && near(m.e95, 48 * 0.015625 / 1.01) &&
          near(m.e99, 50 * 0.015625 / 1.01));
}

/* The mask's third channel decides, and 0.5 is outside; pixels outside can have any value. */
static void test_masked(pair *p)
{
    fill(p, 3.0f, 2.0f);
    for (int i = 0; i < COUNT; i += 2) {
        set_pixel(p->surface, i, 9.0f);
        p->surface[3 * i + 2] = 0.5f;
        set_pixel(p->test, i, (float)NAN);
        set_pixel(p->truth, i, (float)INFINITY);
    }
    metrics m = measured(p, 1, 0);
    CHECK(m.pixels == COUNT / 2 && m.nonfinite == 0 && near(m.rmse, 0.5) && near(m.mean, 1.5));
    metrics_input in = input_of(p, 1, 0);
    metrics_equality e;
    metrics_compare(&e, &in, 0.0);
    CHECK(e.pixels == COUNT / 2 && e.exact == 0 && e.first_x == 1 && e.peak == 2.0);
    report r = {""};
    for (int i = 0; i < COUNT; ++i)
        p->surface[3 * i + 2] = 0.0f;
    CHECK(!metrics_measure(&m, &in, &r) && r.text[0]);
}

/* 40 pixels of a black truth under a mean of 0.6: leak = (40 * 0.006 + 40 * 6e-5) / (40 * 6e-5) = 101. */
static void test_leak(pair *p)
{
    fill(p, 1.0f, 1.0f);
    for (int i = 0; i < 40; ++i) {
        set_pixel(p->truth, i, 0.0f);
        set_pixel(p->test, i, 0.006f);
    }
    metrics m = measured(p, 0, 0);
    CHECK(m.dark == 40 && m.has_leak && fabs(m.leak - 101.0) < 1e-5);
    p->classes[0] = 2.0f;
    m = measured(p, 0, 1);
    CHECK(m.dark == 0 && !m.has_leak);
    for (int i = 60; i < 81; ++i) { /* 21 bright pixels of class 3: test = 2 x truth, leak almost 2 */
        p->classes[i] = METRICS_DARK;
        set_pixel(p->test, i, 2.0f);
    }
    m = measured(p, 0, 1);
    CHECK(m.dark == 21 && m.has_leak && near(m.leak, (2.0 + 6e-5) / (1.0 + 6e-5)));
    p->classes[60] = 1.0f;
    m = measured(p, 0, 1);
    CHECK(m.dark == 20 && !m.has_leak);
}

/* A NaN in one channel makes the pixel black; a truth that is not finite is refused with the position. */
static void test_not_finite(pair *p)
{
    fill(p, 1.0f, 1.0f);
    p->test[3 * 8 + 2] = (float)NAN;
    p->test[3 * 9] = -(float)INFINITY;
    metrics m = measured(p, 0, 0);
    metrics_equality e = compared(p, 0.0);
    CHECK(m.nonfinite == 2 && near(m.mean, 0.98) && near(m.rmse, sqrt(0.02)) && m.n90 == 2);
    CHECK(e.exact == COUNT - 2 && e.max_abs == 1.0 && e.first_x == 8 && e.first_y == 0);
    p->truth[3 * 23 + 1] = (float)NAN;
    metrics_input in = input_of(p, 0, 0);
    report r = {""};
    CHECK(!metrics_measure(&m, &in, &r));
    CHECK_MSG(strstr(r.text, "3,2") != NULL, "%s", r.text);
}

/* A black truth has no mean for relative errors; nothing may divide by 0, even if b + 0.01 mean is 0. */
static void test_degenerate(pair *p)
{
    fill(p, 0.0f, 0.0f);
    metrics m = measured(p, 0, 0);
    CHECK(m.rmse == 0.0 && m.e99 == 0.0 && m.mean == 0.0 && m.dark == COUNT && m.leak == 1.0);
    fill(p, -0.0f, 0.0f);
    CHECK(compared(p, 0.0).exact == 0 && compared(p, 0.0).max_abs == 0.0);
    fill(p, 1.0f, -1.0f);
    m = measured(p, 0, 0);
    CHECK(m.rmse > 1e29 && m.e50 > 1e29 && m.mean > 1e29 && isfinite(m.rmse)); /* a mean below 0 counts as black */
    fill(p, 0.0f, 0.0f); /* mean (10001 - 1) / 100: the equal pixel at -1 has 0 / 0 */
    set_pixel(p->truth, 0, 10001.0f);
    set_pixel(p->truth, 1, -1.0f);
    set_pixel(p->test, 1, -1.0f);
    m = measured(p, 0, 0);
    CHECK(m.e50 == 0.0 && near(m.e99, 10001.0 / 10002.0));
}

/* The worst pixel is relative to its surroundings, and the first of equals; 99.9 % may hide it. */
static void test_worst_pixel(pair *p)
{
    fill(p, 1.0f, 1.0f);
    CHECK(worst_is(p, 0.0, -1, -1));
    for (int i = 0; i < COUNT / 2; ++i) {
        set_pixel(p->test, i, 10.0f);
        set_pixel(p->truth, i, 10.0f);
    }
    set_pixel(p->test, 12, 12.0f); /* 2 of 10, and 0.5 of 1: the mean of the truth is 5.5 */
    set_pixel(p->test, 88, 0.5f);
    set_pixel(p->test, 99, 1.5f);
    CHECK(worst_is(p, 0.5 / 1.055, 8, 8));
    p->surface[3 * 88 + 2] = 0.0f; /* of 99 pixels */
    metrics m = measured(p, 1, 0);
    const metrics_input in = input_of(p, 1, 0);
    int32_t x, y;
    CHECK(metrics_worst_pixel(&x, &y, &m, &in) > 0.4 && x == 9 && y == 9);
}

static int lightness_order(const uint8_t *c) { return 2126 * c[0] + 7152 * c[1] + 722 * c[2]; }

static void test_heat(pair *p)
{
    uint8_t rgb[3 * COUNT], c[3];
    int last = -1, rises = 1;
    for (int i = 0; i <= 100; ++i) {
        metrics_ramp(c, i / 100.0);
        rises &= lightness_order(c) > last;
        last = lightness_order(c);
    }
    CHECK(rises && c[0] == 255 && c[1] == 255 && c[2] == 255);
    metrics_ramp(c, -1.0);
    CHECK(c[0] == 0 && c[1] == 0 && c[2] == 0);
    metrics_ramp(c, (double)INFINITY);
    CHECK(c[0] == 255 && c[1] == 255 && c[2] == 255);

    fill(p, 1.0f, 1.0f);
    set_pixel(p->test, 1, 100.0f);
    set_pixel(p->test, 2, (float)NAN);
    p->surface[3 * 3 + 2] = 0.0f;
    set_pixel(p->test, 4, 1.404f); /* 0.404 / 1.01 is 0.4, the third knot */
    metrics_input in = input_of(p, 1, 0);
    metrics_heat(rgb, &in, 1.0);
    static const uint8_t expected[15] = {0, 0, 0, 255, 255, 255, 0, 255, 0, 64, 64, 64, 165, 38, 140};
    CHECK(memcmp(rgb, expected, sizeof expected) == 0);
}

/* -- files -------------------------------------------------------------------------------------------------------- */

typedef struct scratch {
    char a[300], b[300], text[2048];
} scratch;

/* Names that no other run uses; 0 if the folder is not writable. */
static int scratch_init(scratch *s)
{
    const char *folder = getenv("TMPDIR");
    unsigned tag = (unsigned)time(NULL) * 2654435761u ^ (unsigned)clock() ^ (unsigned)(uintptr_t)s;
    if (!folder || strlen(folder) > 200)
        folder = "/tmp";
    snprintf(s->a, sizeof s->a, "%s/lambent-%08x-a", folder, tag);
    snprintf(s->b, sizeof s->b, "%s/lambent-%08x-b", folder, tag);
    FILE *f = fopen(s->a, "wb");
    return f && fclose(f) == 0;
}

/* A PPM of width x 1 with all bytes `code`, except that the last one is `last`. */
static void write_ppm(const char *path, int width, int code, int last)
{
    FILE *f = fopen(path, "wb");
    if (!f)
        return;
    fprintf(f, "P6\n# a comment\n%d 1\n255\n", width);
    for (int i = 0; i < 3 * width; ++i)
        fputc(i == 3 * width - 1 ? last : code, f);
    fclose(f);
}

/* Runs `compare A B [OPTION VALUE]`; s->text is the output. */
static int compare_status(scratch *s, const char *option, const char *value)
{
    char verb[] = "compare", first[64], second[64], *argv[5];
    int argc = 3;
    argv[0] = verb, argv[1] = s->a, argv[2] = s->b;
    if (option) {
        snprintf(first, sizeof first, "%s", option);
        argv[argc++] = first;
    }
    if (value) {
        snprintf(second, sizeof second, "%s", value);
        argv[argc++] = second;
    }
    FILE *talk = tmpfile();
    if (!talk)
        return -1;
    int status = compare_to(talk, talk, argc, argv);
    rewind(talk);
    s->text[fread(s->text, 1, sizeof s->text - 1, talk)] = 0;
    fclose(talk);
    return status;
}

static int says(const scratch *s, const char *part) { return strstr(s->text, part) != NULL; }

static void test_verb(scratch *s)
{
    write_ppm(s->a, 4, 100, 100);
    write_ppm(s->b, 4, 100, 100);
    CHECK_MSG(compare_status(s, NULL, NULL) == COMPARE_OK && says(s, "exact 4 of 4\n"), "%s", s->text);
    write_ppm(s->a, 4, 100, 103);
    CHECK_MSG(compare_status(s, NULL, NULL) == COMPARE_OK && says(s, "max 3 at 3,0 exact 3 of 4 first 3,0\n"), "%s",
              s->text);
    CHECK_MSG(says(s, "psnr 49.38 dB (rgb, sRGB codes, peak 255)"), "%s", s->text); /* 65025 / (9 / 12) */
    CHECK_MSG(compare_status(s, "--json", NULL) == COMPARE_OK && says(s, "\"first_difference\":[3,0]"), "%s", s->text);
    CHECK(compare_status(s, "--max", "rmse=0.5,lo=0.9,hi=1.1") == COMPARE_OK);
    CHECK_MSG(compare_status(s, "--max", "rmse=0.001") == COMPARE_FAILED && says(s, " [bound rmse=0.001]\n"), "%s",
              s->text);
    CHECK_MSG(says(s, " worst 0.0") && says(s, " at 3,0 mean 1.0"), "%s", s->text);
    CHECK(compare_status(s, "--json", NULL) == COMPARE_OK && says(s, "\"worst_at\":[3,0]"));
    CHECK(compare_status(s, "--max", "worst=0.001") == COMPARE_FAILED && says(s, " [bound worst=0.001]\n"));
    CHECK(compare_status(s, "--max", "worst=0.1") == COMPARE_OK);
    CHECK(compare_status(s, "--max", "hi=1") == COMPARE_FAILED && compare_status(s, "--max", "lo=1") == COMPARE_OK);
    CHECK(compare_status(s, "--max", "rms=1") == COMPARE_USAGE && compare_status(s, "--max", "rmse=") == COMPARE_USAGE);
    CHECK(compare_status(s, "--max", NULL) == COMPARE_USAGE && compare_status(s, "--nothing", NULL) == COMPARE_USAGE);
    CHECK(compare_status(s, "--mask", s->b) == COMPARE_FAILED); /* not a PFM */
    CHECK(compare_status(s, "--help", NULL) == COMPARE_OK && says(s, "usage: lambent compare"));
}

/* Codes 188 and 10 in linear light: ((188/255 + 0.055) / 1.055)^2.4 = 0.50289 and 10/255 / 12.92 = 0.003035. */
static void test_srgb(scratch *s)
{
    write_ppm(s->b, 4, 255, 255);
    write_ppm(s->a, 4, 188, 188);
    CHECK_MSG(compare_status(s, NULL, NULL) == COMPARE_OK && says(s, "mean 0.5029\n"), "%s", s->text);
    write_ppm(s->a, 4, 10, 10);
    CHECK_MSG(compare_status(s, "--json", NULL) == COMPARE_OK && says(s, "\"mean\":0.003035"), "%s", s->text);
}

static void test_size_mismatch(scratch *s)
{
    write_ppm(s->a, 4, 100, 100);
    write_ppm(s->b, 5, 100, 100);
    CHECK(compare_status(s, NULL, NULL) == COMPARE_SIZES);
    CHECK_MSG(says(s, "4x1") && says(s, "5x1") && strchr(s->text, '\n') == s->text + strlen(s->text) - 1, "%s",
              s->text);
    remove(s->b);
    CHECK(compare_status(s, NULL, NULL) == COMPARE_FAILED);
    CHECK_MSG(strncmp(s->text, "lambent compare: ", 17) == 0, "%s", s->text);
}

void test_compare(void)
{
    static pair p;
    static scratch s;
    test_equal(&p);
    test_offset(&p);
    test_outlier(&p);
    test_percentiles(&p);
    test_masked(&p);
    test_leak(&p);
    test_not_finite(&p);
    test_degenerate(&p);
    test_worst_pixel(&p);
    test_heat(&p);
    if (!scratch_init(&s)) {
        SKIP("compare on files: no temporary folder can be written to");
        return;
    }
    test_verb(&s);
    test_srgb(&s);
    test_size_mismatch(&s);
    remove(s.a);
}
