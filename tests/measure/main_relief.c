/* main_relief.c: compares reliefs with the complex models that they replace: errors, speed, memory. [P1-P12]
 *
 *     measure-relief [quality|baroque|own|rooms|causes|speed|crowds]...     default: all; LMB_PICTURES: folder for pictures
 *
 * Exit status 1 if a bar is missed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../../src/base/vec.h"
#include "../../tools/relief/relief_compare.h"
#include "../test.h"
#include "relief_stage.h"

int test_passed, test_failed, test_skipped;

enum { SIDE = 512, SHADOW_MAP = 1024 };

/* --- errors ------------------------------------------------------------------------------------------------------- */

static void picture(const char *name, const char *what, int camera_number, const relief_frame *f, report *r)
{
    char full[64];
    if (camera_number % 8 == 3) {
        snprintf(full, sizeof full, "%s_%02d_%s", name, camera_number, what);
        relief_show(full, f->rgb, f->width, f->height, r);
    }
}

static void add(relief_figures *sum, const relief_figures *f, double weight)
{
    sum->silhouette_px += f->silhouette_px * weight;
    sum->iou += f->iou * weight;
    sum->lost += f->lost * weight;
    sum->added += f->added * weight;
    sum->depth_50 += f->depth_50 * weight;
    sum->depth_95 += f->depth_95 * weight;
    sum->normal_50 += f->normal_50 * weight;
    sum->normal_95 += f->normal_95 * weight;
    sum->psnr_db += f->psnr_db * weight;
    sum->shadowed_db += f->shadowed_db * weight;
    sum->albedo_db += f->albedo_db * weight;
    sum->lit += f->lit * weight;
}

static const struct way {
    const char *name;
    lmb_relief_how how;
} ways[] = {{"iterated", {0, 0, 0, 0, 0}}, {"nearest P, once", {1, 0, 1, 8, 1}}};

static void hold_bars(const char *name, const relief_figures *f)
{
    bar(name, "outline within 1 px", f->silhouette_px <= 1.0);
    bar(name, "depth within 0.1 % (median) and 1 % (95 of 100)", f->depth_50 <= 0.001 && f->depth_95 <= 0.01);
    bar(name, "normals within 3 degrees (median)", f->normal_50 <= 3.0);
    bar(name, "light, cast shadows apart, at 32 dB", f->psnr_db >= 32.0);
    bar(name, "lit or not as it should, 97 %", f->lit >= 0.97);
}

static void quality_of(const char *name, subject *s, report *r)
{
    for (int w = 0; w < 2; ++w) {
        relief_figures sum;
        lmb_relief_stats stats = {0, 0, 0, 0};
        memset(&sum, 0, sizeof sum);
        for (int i = 0; i < CAMERAS; ++i) {
            relief_shot shot;
            relief_frame truth, test;
            relief_figures f;
            lmb_light sun;
            memset(&shot, 0, sizeof shot);
            shot.kernels = lmb_kernels_pick();
            shot.view = subject_camera(s, i, SIDE, &sun);
            shot.light = &sun;
            shot.shadow_map = SHADOW_MAP;
            shot.ambient = 0.4f;
            shot.scene = &s->complex.scene;
            if (!relief_shoot(&truth, &shot, r)) {
                give_up(r);
            }
            shot.scene = NULL;
            shot.relief = &s->relief;
            shot.how = ways[w].how;
            if (!relief_shoot(&test, &shot, r) || !relief_measure(&f, &test, &truth, (double)s->diagonal, r)) {
                give_up(r);
            }
            picture(name, w ? "once" : "relief", i, &test, r);
            if (w == 0) {
                picture(name, "truth", i, &truth, r);
            }
            stats.pixels += test.stats.pixels;
            stats.hits += test.stats.hits;
            stats.missed += test.stats.missed;
            stats.holes += test.stats.holes;
            add(&sum, &f, 1.0 / CAMERAS);
            relief_frame_free(&truth);
            relief_frame_free(&test);
        }
        printf("%-6s %-16s outline %5.2f px iou %.4f -%.4f +%.4f  depth %.3f %% %.3f %%  normal %.2f %.1f deg  "
               "light %.2f dB shadowed %.2f albedo %.2f dB  lit %.4f  holes %.4f missed %.4f\n",
               name, ways[w].name, sum.silhouette_px, sum.iou, sum.lost, sum.added,
               100.0 * sum.depth_50, 100.0 * sum.depth_95, sum.normal_50, sum.normal_95,
               sum.psnr_db, sum.shadowed_db, sum.albedo_db,
               sum.lit, (double)stats.holes / (double)stats.pixels, (double)stats.missed / (double)stats.pixels);
        if (w == 0) {
            hold_bars(name, &sum);
        }
    }
}

void relief_quality(report *r)
{
    for (int i = 0; i < STATUES; ++i) {
        subject *s = subject_make(&statues[i], r);
        if (s != NULL) {
            printf("%s: %u -> %u triangles, %.1f MiB, baked in %.1f s, unseen %.2f %%, slanted %.2f %%\n",
                   statues[i].name, (unsigned)s->mesh.triangle_count, (unsigned)s->simple.triangle_count,
                   (double)s->file.size / 1048576.0, s->bake_s, 100.0 * s->coverage.unseen,
                   100.0 * s->coverage.slanted);
            quality_of(statues[i].name, s, r);
            subject_free(s);
        }
    }
}

/* --- speed -------------------------------------------------------------------------------------------------------- */

/* Seconds for a picture's triangles and pixels: the minimum of several runs. */
static double seconds(const relief_shot *shot, report *r)
{
    double min = 1e30;
    for (int i = 0; i < 7; ++i) {
        relief_frame f;
        if (!relief_shoot(&f, shot, r)) {
            give_up(r);
        }
        min = fmin(min, f.draw_s + f.band_s);
        relief_frame_free(&f);
    }
    return min;
}

void relief_speed(report *r)
{
    subject *s = subject_make(&statues[1], r);
    if (s == NULL) {
        return;
    }
    for (int level = 0; level < 3; ++level) {
        for (int32_t side = 256; side <= 512; side *= 2) {
            relief_shot shot;
            lmb_light sun;
            memset(&shot, 0, sizeof shot);
            shot.kernels = lmb_kernels_pick();
            shot.view = subject_camera(s, 9, side, &sun);
            shot.scene = &s->complex.scene;
            const double direct = seconds(&shot, r);
            shot.scene = NULL;
            shot.relief = &s->relief;
            const double relief = seconds(&shot, r);
            printf("%7u triangles at %d x %d: direct %6.2f ms, relief %6.2f ms, ratio %.2f\n",
                   (unsigned)s->mesh.triangle_count, (int)side, (int)side, 1e3 * direct, 1e3 * relief, direct / relief);
        }
        triangle_mesh more;
        if (!relief_divide(&more, &s->mesh, r)) {
            give_up(r);
        }
        triangle_mesh_free(&s->mesh);
        relief_scene_free(&s->complex);
        s->mesh = more;
        if (!relief_scene_of(&s->complex, &s->mesh, r)) {
            give_up(r);
        }
    }
    subject_free(s);
}

static int wanted(const char *what, int argc, char **argv)
{
    int found = argc < 2;
    for (int i = 1; i < argc; ++i) {
        found |= strcmp(argv[i], what) == 0;
    }
    return found;
}

int main(int argc, char **argv)
{
    static const struct { const char *name; void (*run)(report *r); } parts[] = {
        {"quality", relief_quality}, {"baroque", relief_baroque}, {"own", relief_own_views}, {"rooms", relief_rooms}, {"causes", relief_causes},
        {"speed", relief_speed}, {"crowds", relief_crowds}};
    report r = {""};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
        if (wanted(parts[i].name, argc, argv)) {
            parts[i].run(&r);
        }
    }
    return test_failed > 0;
}
