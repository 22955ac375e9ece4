/* relief_baroque.c: ornate shapes as reliefs: errors, specks, times of whole frames. Each shape has two seeds; with the
 * second it is turned and has other parameters. [P7 P12] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../tools/relief/relief_compare.h"
#include "../baroque.h"
#include "relief_stage.h"

enum { FINE = 400, SIMPLE = 6000, SIDE = 512, MAP = 1024, EVERY = 3 };

static const char *const names[BAROQUE_KINDS] = {"urn", "drapery", "scrolls", "knot"};

static void add(relief_figures *sum, const relief_figures *f, double weight)
{
    sum->iou += f->iou * weight;
    sum->normal_50 += f->normal_50 * weight;
    sum->normal_95 += f->normal_95 * weight;
    sum->psnr_db += f->psnr_db * weight;
    sum->shadowed_db += f->shadowed_db * weight;
    sum->lit += f->lit * weight;
    sum->isolated += f->isolated * weight;
}

/* Seconds of a frame's parts: the minimum of several runs. */
static void time_parts(double out[3], const relief_shot *shot, report *r)
{
    out[0] = out[1] = out[2] = 1e30;
    for (int i = 0; i < 3; ++i) {
        relief_frame f;
        if (!relief_shoot(&f, shot, r)) {
            give_up(r);
        }
        const double now[3] = {f.light_s, f.draw_s, f.band_s};
        for (int k = 0; k < 3; ++k) {
            out[k] = now[k] < out[k] ? now[k] : out[k];
        }
        relief_frame_free(&f);
    }
}

static void show_both(const char *name, int camera, relief_frame *test, relief_frame *truth, report *r)
{
    char full[64];
    snprintf(full, sizeof full, "%s_%02d_relief", name, camera);
    relief_show(full, test->rgb, test->width, test->height, r);
    snprintf(full, sizeof full, "%s_%02d_truth", name, camera);
    relief_show(full, truth->rgb, truth->width, truth->height, r);
}

static void measure(const char *name, const subject *s, report *r)
{
    relief_figures sum;
    double relief_s[3], direct_s[3];
    int cameras = 0;
    memset(&sum, 0, sizeof sum);
    for (int i = 1; i < CAMERAS; i += EVERY) {
        relief_frame truth, test;
        relief_figures f;
        lmb_light sun;
        relief_shot shot = {.kernels = lmb_kernels_pick(), .view = subject_camera(s, i, SIDE, &sun), .light = &sun,
                            .shadow_map = MAP, .ambient = 0.4f}, direct;
        direct = shot;
        shot.relief = &s->relief;
        direct.scene = &s->complex.scene;
        if (!relief_shoot(&truth, &direct, r) || !relief_shoot(&test, &shot, r) ||
            !relief_measure(&f, &test, &truth, (double)s->diagonal, r)) {
            give_up(r);
        }
        add(&sum, &f, 1.0);
        ++cameras;
        if (i == 10) {
            show_both(name, i, &test, &truth, r);
            time_parts(relief_s, &shot, r);
            time_parts(direct_s, &direct, r);
        }
        relief_frame_free(&truth);
        relief_frame_free(&test);
    }
    relief_figures mean;
    memset(&mean, 0, sizeof mean);
    add(&mean, &sum, 1.0 / cameras);
    printf("%-10s covered %.4f  normal %.2f %.1f deg  light %.2f dB shadowed %.2f  lit %.2f %%  isolated %.3f %%  ms: "
           "map %.1f (direct %.1f) frame %.1f (%.1f)\n",
           name, mean.iou, mean.normal_50, mean.normal_95, mean.psnr_db, mean.shadowed_db, 100.0 * mean.lit,
           100.0 * mean.isolated, 1e3 * relief_s[0], 1e3 * direct_s[0],
           1e3 * (relief_s[0] + relief_s[1] + relief_s[2]), 1e3 * (direct_s[0] + direct_s[1] + direct_s[2]));
    bar(name, "light, cast shadows apart, at 29 dB", mean.psnr_db >= 29.0);
    bar(name, "isolated pixels under 0.05 %", mean.isolated < 0.0005);
}

void relief_baroque(report *r)
{
    for (int i = 0; i < 2 * BAROQUE_KINDS; ++i) {
        char name[32];
        triangle_mesh mesh = baroque(i % BAROQUE_KINDS, 1 + (uint32_t)(i / BAROQUE_KINDS), FINE);
        subject *s = subject_of(&mesh, SIMPLE, r);
        snprintf(name, sizeof name, "%s%s", names[i % BAROQUE_KINDS], i < BAROQUE_KINDS ? "" : "_2");
        printf("%-10s %u -> %u triangles, unseen %.2f %%, slanted %.2f %%\n", name, (unsigned)mesh.triangle_count,
               (unsigned)s->simple.triangle_count, 100.0 * s->coverage.unseen, 100.0 * s->coverage.slanted);
        measure(name, s, r);
        subject_free(s);
        triangle_mesh_free(&mesh);
    }
}
