/* main_path.c: makes the small truths in the repository, and prints their noise.
 *
 *     path -o DIR [NAME]...     all of small_truths.inc, or only the named ones: DIR/NAME.hdr
 *
 * Traces two halves with different random numbers; the file is their mean, and half their difference is the noise. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "path.h"

enum { SIDE = 64, PIXELS = SIDE * SIDE };

typedef struct small_truth {
    const char *name;
    int bounces, strata;
} small_truth;

static const small_truth truths[] = {
#define SMALL_TRUTH(kind, bounces, strata, slow, t0, r0, w0, t1, r1, w1, t2, r2, w2) {#kind, bounces, strata},
#include "small_truths.inc"
#undef SMALL_TRUTH
};

/* --- Radiance HDR ------------------------------------------------------------------------------------------------- */

/* Three mantissas, rounded to nearest, and a shared exponent. */
static void put_colour(unsigned char out[4], const double rgb[3])
{
    int exponent;
    const double max = fmax(rgb[0], fmax(rgb[1], rgb[2]));
    memset(out, 0, 4);
    if (max < 1e-30) {
        return;
    }
    frexp(max * (256.0 / 255.5), &exponent); /* so that 255.5 and more uses the next exponent */
    for (int c = 0; c < 3; ++c) {
        out[c] = (unsigned char)(ldexp(rgb[c], 8 - exponent) + 0.5);
    }
    out[3] = (unsigned char)(exponent + 128);
}

static int run_at(const unsigned char *row, int x)
{
    int n = 1;
    while (x + n < SIDE && row[x + n] == row[x]) {
        ++n;
    }
    return n;
}

/* One component of a row: runs of at least four, and literals between them. */
static void put_row(FILE *f, const unsigned char *row)
{
    for (int x = 0; x < SIDE;) {
        int end = x;
        while (end < SIDE && run_at(row, end) < 4) {
            ++end;
        }
        if (end > x) {
            fputc(end - x, f);
            fwrite(row + x, 1, (size_t)(end - x), f);
        } else {
            end = x + run_at(row, x);
            fputc(128 + end - x, f);
            fputc(row[x], f);
        }
        x = end;
    }
}

static int write_picture(const char *path, double (*rgb)[3])
{
    FILE *f = fopen(path, "wb");
    if (f == NULL) {
        return 0;
    }
    fprintf(f, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", SIDE, SIDE);
    for (int y = 0; y < SIDE; ++y) {
        unsigned char row[4][SIDE], four[4];
        for (int x = 0; x < SIDE; ++x) {
            put_colour(four, rgb[y * SIDE + x]);
            for (int k = 0; k < 4; ++k) {
                row[k][x] = four[k];
            }
        }
        fputc(2, f);
        fputc(2, f);
        fputc(SIDE >> 8, f);
        fputc(SIDE & 255, f);
        for (int k = 0; k < 4; ++k) {
            put_row(f, row[k]);
        }
    }
    return fclose(f) == 0;
}

/* --- two halves --------------------------------------------------------------------------------------------------- */

static double half[2][PIXELS][3];

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Puts the mean of both into the first; returns the noise as rmse and trim. */
static void join(double *rmse, double *trim)
{
    static double square[PIXELS];
    double mean = 0.0, sum = 0.0, kept = 0.0;
    for (int i = 0; i < PIXELS; ++i) {
        square[i] = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double off = 0.5 * (half[0][i][c] - half[1][i][c]);
            square[i] += off * off / 3.0;
            half[0][i][c] -= off;
            mean += half[0][i][c] / (3.0 * PIXELS);
        }
    }
    qsort(square, PIXELS, sizeof *square, rising);
    for (int i = 0; i < PIXELS; ++i) {
        sum += square[i];
        kept += i < PIXELS - PIXELS / 100 ? square[i] : 0.0;
    }
    *rmse = sqrt(sum / PIXELS) / mean;
    *trim = sqrt(kept / (PIXELS - PIXELS / 100)) / mean;
}

static int make(const small_truth *t, const char *folder)
{
    made_scene s;
    path_tracer p;
    char path[1024];
    double rmse, trim;
    if (!scene_make(&s, t->name) || !path_open(&p, &s)) {
        return 0;
    }
    for (int k = 0; k < 2; ++k) {
        test_rng random = {(uint64_t)(k + 1) * UINT64_C(0x9e3779b97f4a7c15)};
        for (int i = 0; i < PIXELS; ++i) {
            path_point seen;
            if (path_eye(&p, &seen, i % SIDE, i / SIDE, SIDE)) {
                path_bounced(&p, &seen, t->bounces, t->strata, &random, half[k][i]);
            } else {
                memset(half[k][i], 0, sizeof half[k][i]);
            }
        }
    }
    join(&rmse, &trim);
    printf("%-13s %4u triangles, noise: trim %.4f, rmse %.4f\n", t->name, (unsigned)s.triangles, trim, rmse);
    snprintf(path, sizeof path, "%.900s/%s.hdr", folder, t->name);
    const int ok = write_picture(path, half[0]);
    path_close(&p);
    scene_drop(&s);
    return ok;
}

static int is_named(const char *name, int argc, char **argv)
{
    int named = argc < 4;
    for (int i = 3; i < argc; ++i) {
        named |= strcmp(argv[i], name) == 0;
    }
    return named;
}

int main(int argc, char **argv)
{
    if (argc < 3 || strcmp(argv[1], "-o") != 0) {
        fprintf(stderr, "usage: path -o DIR [NAME]...\n");
        return 2;
    }
    for (int i = 0; i < COUNT_OF(truths); ++i) {
        if (is_named(truths[i].name, argc, argv) && !make(&truths[i], argv[2])) {
            fprintf(stderr, "path: %s: not made\n", truths[i].name);
            return 1;
        }
    }
    return 0;
}
