/* relief_causes.c: attributes a relief's squared error to causes, and compares the direct picture with a finer one. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../tools/relief/relief_compare.h"
#include "relief_stage.h"

enum { FINE = 4 };
enum { NEAR_EDGE, ELSEWHERE, SMOOTH, KINDS };

typedef struct share {
    long long pixels;
    double squared;
} share;

/* Returns whether the depth jumps beside a pixel. */
static int near_edge(const relief_frame *f, int32_t x, int32_t y, float jump)
{
    const float z = f->depth[y * f->width + x];
    for (int32_t dy = -1; dy <= 1; ++dy) {
        for (int32_t dx = -1; dx <= 1; ++dx) {
            const int32_t nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= f->width || ny >= f->height) {
                continue;
            }
            const float n = f->depth[ny * f->width + nx];
            if (n == 0.0f || fabsf(n - z) > jump) {
                return 1;
            }
        }
    }
    return 0;
}

static void add_shares(share out[KINDS], const relief_frame *got, const relief_frame *want, float diagonal)
{
    for (int32_t i = 0; i < want->width * want->height; ++i) {
        if (got->depth[i] > 0.0f && want->depth[i] > 0.0f) {
            const int edge = near_edge(want, i % want->width, i / want->width, 0.01f * diagonal);
            const int off = fabsf(got->depth[i] - want->depth[i]) > 0.003f * diagonal;
            const int kind = edge ? NEAR_EDGE : off ? ELSEWHERE : SMOOTH;
            ++out[kind].pixels;
            out[kind].squared += relief_squared(got->open + 3 * (size_t)i, want->open + 3 * (size_t)i);
        }
    }
}

/* Averages FINE x FINE samples a pixel over the samples with a surface. */
static relief_frame mean_of(const relief_frame *fine)
{
    relief_frame out;
    memset(&out, 0, sizeof out);
    out.width = fine->width / FINE;
    out.height = fine->height / FINE;
    const size_t pixels = (size_t)out.width * (size_t)out.height;
    out.depth = calloc(pixels, sizeof(float));
    out.open = calloc(3 * pixels, sizeof(float));
    for (int32_t i = 0; i < fine->width * fine->height; ++i) {
        const int32_t at = i / fine->width / FINE * out.width + i % fine->width / FINE;
        if (fine->depth[i] > 0.0f) {
            out.depth[at] += 1.0f;
            for (int c = 0; c < 3; ++c) {
                out.open[3 * at + c] += fine->open[3 * i + c];
            }
        }
    }
    for (size_t i = 0; i < pixels; ++i) {
        for (size_t c = 0; c < 3 && out.depth[i] > 0.0f; ++c) {
            out.open[3 * i + c] /= out.depth[i];
        }
    }
    return out;
}

static double between(const relief_frame *a, const relief_frame *b)
{
    double sum = 0.0;
    long long n = 0;
    for (int32_t i = 0; i < a->width * a->height; ++i) {
        if (a->depth[i] > 0.0f && b->depth[i] > 0.0f) {
            sum += relief_squared(a->open + 3 * (size_t)i, b->open + 3 * (size_t)i);
            ++n;
        }
    }
    return n > 0 ? 10.0 * log10(255.0 * 255.0 * 3.0 * (double)n / sum) : 0.0;
}

static relief_frame shoot(const relief_shot *shot, report *r)
{
    relief_frame f;
    if (!relief_shoot(&f, shot, r)) {
        give_up(r);
    }
    return f;
}

void relief_causes(report *r)
{
    for (int i = 0; i < STATUES; ++i) {
        subject *s = subject_make(&statues[i], r);
        share of[KINDS] = {{0, 0.0}};
        double direct = 0.0, relief = 0.0, both = 0.0;
        int cameras = 0;
        for (int c = 1; s != NULL && c < 24; c += 4) {
            relief_shot shot;
            lmb_light sun;
            memset(&shot, 0, sizeof shot);
            shot.kernels = lmb_kernels_pick();
            shot.view = subject_camera(s, c, 512, &sun);
            shot.light = &sun;
            shot.ambient = 0.4f;
            shot.relief = &s->relief;
            relief_frame got = shoot(&shot, r);
            shot.relief = NULL;
            shot.scene = &s->complex.scene;
            relief_frame want = shoot(&shot, r);
            shot.view = subject_camera(s, c, 512 * FINE, &sun);
            relief_frame fine = shoot(&shot, r), mean = mean_of(&fine);
            add_shares(of, &got, &want, s->diagonal);
            direct += between(&want, &mean);
            relief += between(&got, &mean);
            both += between(&got, &want);
            ++cameras;
            relief_frame_free(&got);
            relief_frame_free(&want);
            relief_frame_free(&fine);
            relief_frame_free(&mean);
        }
        if (s != NULL) {
            const double n = (double)(of[0].pixels + of[1].pixels + of[2].pixels),
                         e = of[0].squared + of[1].squared + of[2].squared;
            printf("%-6s relief to direct %.2f dB; direct to %d samples a pixel %.2f, relief to these %.2f; pixels | "
                   "squared error: beside jumps of depth %.1f %% | %.1f %%, at another depth %.1f | %.1f, others "
                   "%.1f | %.1f\n", statues[i].name, both / cameras, FINE * FINE, direct / cameras, relief / cameras,
                   100.0 * (double)of[0].pixels / n, 100.0 * of[0].squared / e, 100.0 * (double)of[1].pixels / n,
                   100.0 * of[1].squared / e, 100.0 * (double)of[2].pixels / n, 100.0 * of[2].squared / e);
            subject_free(s);
        }
    }
}
