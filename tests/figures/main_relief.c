/* main_relief.c: reliefs against the complex models that they stand for: errors, speed, memory. [P1-P12]
 *
 *     relief [quality|speed]...        both by default; a folder for pictures in LMB_PICTURES
 *
 * Exit status 1 where a bar is passed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../../src/base/vec.h"
#include "../../tools/model.h"
#include "../../tools/picture.h"
#include "../../tools/relief_bake.h"
#include "../../tools/relief_compare.h"
#include "../../tools/relief_model.h"
#include "../shared_file.h"

int test_passed, test_failed, test_skipped;

enum { VIEWS = 26, TEXELS = 256, CAMERAS = 24, SIDE = 512, LIGHT_MAP = 1024 };

/* A complex model, and a relief of it. */
typedef struct subject {
    model loaded;
    triangle_mesh mesh, simple;
    relief_scene complex;
    lmb_relief relief;
    file_bytes file;
    relief_coverage coverage;
    double bake_s;
    lmb_vec3 middle;
    float diagonal;
} subject;

static void subject_free(subject *s)
{
    model_free(&s->loaded);
    triangle_mesh_free(&s->mesh);
    triangle_mesh_free(&s->simple);
    relief_scene_free(&s->complex);
    file_free(&s->file);
    free(s);
}

static void give_up(const report *r)
{
    printf("FAIL: %s\n", r->text);
    exit(1);
}

/* The wood's grain of a model that has no colours. */
static void paint(triangle_mesh *m, float diagonal)
{
    for (uint32_t v = 0; v < m->vertex_count; ++v) {
        const float *p = m->positions + 3 * (size_t)v;
        const float k = 40.0f / diagonal, g = sinf(k * p[0]) * sinf(k * p[1]) * sinf(k * p[2]);
        m->colours[3 * (size_t)v] = 0.55f + 0.25f * g;
        m->colours[3 * (size_t)v + 1] = 0.45f + 0.2f * g;
        m->colours[3 * (size_t)v + 2] = 0.4f - 0.15f * g;
    }
}

static void load(subject *s, const char *path, report *r)
{
    static model_notes notes;
    if (!model_load(&s->loaded, path, NULL, &notes, r) || !relief_flatten(&s->mesh, &s->loaded.scene, r)) {
        give_up(r);
    }
    const lmb_vec3 low = s->loaded.scene.bounds_min, high = s->loaded.scene.bounds_max;
    s->middle = mul3(add3(low, high), 0.5f);
    s->diagonal = length3(sub3(high, low));
    paint(&s->mesh, s->diagonal);
    if (!relief_scene_of(&s->complex, &s->mesh, r)) {
        give_up(r);
    }
}

static void bake(subject *s, uint32_t triangles, int32_t views, int32_t texels, int32_t format, report *r)
{
    relief_bake *b = calloc(1, sizeof *b);
    lmb_vec3 direction[LMB_RELIEF_VIEWS];
    simplify_facts facts;
    const double since = host_cpu_seconds();
    int ok = b != NULL && simplify_mesh(&s->simple, &s->mesh, triangles, SIMPLIFY_AROUND, &facts, r);
    relief_directions(direction, views);
    b->format = format;
    for (int32_t i = 0; i < views && ok; ++i) {
        const lmb_view v = relief_fit(&s->mesh, direction[i], texels);
        ok = relief_add(b, &s->complex.scene, &v, r);
    }
    ok = ok && relief_cover(&s->coverage, b, &s->mesh, r) && relief_encode(&s->file, b, &s->simple, 0.0f, r);
    s->bake_s = host_cpu_seconds() - since;
    if (!ok || lmb_relief_open(&s->relief, s->file.data, s->file.size) != LMB_OK) {
        report_fail(r, "no relief");
        give_up(r);
    }
    relief_bake_free(b);
    free(b);
}

/* --- errors ------------------------------------------------------------------------------------------------------- */

/* All around, between a cube's lattice: by golden angles, turned. */
static lmb_view camera(const subject *s, int i, int32_t side, lmb_light *sun)
{
    const double y = 1.0 - (2.0 * i + 1.0) / CAMERAS, a = 2.39996322972865332 * i + 0.3, ring = sqrt(1.0 - y * y);
    const lmb_vec3 d = vec3((float)(ring * cos(a)), (float)y, (float)(ring * sin(a)));
    lmb_view v;
    const float away = 1.32f * s->diagonal; /* 45 degrees hold the sphere around it */
    if (lmb_view_look(&v, add3(s->middle, mul3(d, away)), s->middle, vec3(0.0f, 1.0f, 0.0f), 0.7853982f, side, side) !=
        LMB_OK) {
        exit(1);
    }
    v.near_m = 0.01f * away;
    v.far_m = 3.0f * away;
    memset(sun, 0, sizeof *sun);
    sun->kind = LMB_LIGHT_DIRECTIONAL;
    sun->direction = normalize3(mul3(add3(add3(mul3(v.back, 0.7f), mul3(v.up, 0.6f)), mul3(v.right, 0.5f)), -1.0f));
    sun->intensity[0] = sun->intensity[1] = sun->intensity[2] = 2.6f;
    sun->cos_inner = sun->cos_outer = 1.0f;
    return v;
}

static void picture(const char *name, const char *what, int camera_number, const relief_frame *f, report *r)
{
    const char *folder = getenv("LMB_PICTURES");
    char path[600];
    if (folder == NULL || camera_number % 8 != 3) {
        return;
    }
    const image out = {f->width, f->height, 3, f->rgb};
    snprintf(path, sizeof path, "%.300s/%s_%02d_%s.png", folder, name, camera_number, what);
    if (!picture_write(path, &out, 0.0f, r)) {
        give_up(r);
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

static void bar(const char *name, const char *what, int holds)
{
    if (!holds) {
        printf("FAIL %s: %s\n", name, what);
        ++test_failed;
    }
}

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
            shot.view = camera(s, i, SIDE, &sun);
            shot.light = &sun;
            shot.light_map = LIGHT_MAP;
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

static void quality(report *r)
{
    static const struct { const char *name, *file; uint32_t triangles; } of[] = {
        {"rhino", "data/meshes/rhino_60k.ply", 3000},
        {"bunny", "data/meshes/stanford_bunny.obj", 2000},
        {"lucy", "data/meshes/lucy_100k.ply", 4000}};
    for (int i = 0; i < 3; ++i) {
        char path[SHARED_PATH];
        if (shared_file(path, of[i].file)) {
            subject *s = calloc(1, sizeof *s);
            load(s, path, r);
            bake(s, of[i].triangles, VIEWS, TEXELS, LMB_RELIEF_FULL, r);
            printf("%s: %u -> %u triangles, %.1f MiB, baked in %.1f s, unseen %.2f %%, slanted %.2f %%\n", of[i].name,
                   (unsigned)s->mesh.triangle_count, (unsigned)s->simple.triangle_count,
                   (double)s->file.size / 1048576.0, s->bake_s, 100.0 * s->coverage.unseen,
                   100.0 * s->coverage.slanted);
            quality_of(of[i].name, s, r);
            subject_free(s);
        }
    }
}

/* --- speed -------------------------------------------------------------------------------------------------------- */

/* Seconds of a picture's triangles and pixels: the least of some. */
static double seconds(const relief_shot *shot, report *r)
{
    double least = 1e30;
    for (int i = 0; i < 7; ++i) {
        relief_frame f;
        if (!relief_shoot(&f, shot, r)) {
            give_up(r);
        }
        least = fmin(least, f.draw_s + f.band_s);
        relief_frame_free(&f);
    }
    return least;
}

static void speed(report *r)
{
    char path[SHARED_PATH];
    if (!shared_file(path, "data/meshes/stanford_bunny.obj")) {
        return;
    }
    subject *s = calloc(1, sizeof *s);
    load(s, path, r);
    bake(s, 2000, VIEWS, TEXELS, LMB_RELIEF_FULL, r);
    for (int level = 0; level < 3; ++level) {
        for (int32_t side = 256; side <= 512; side *= 2) {
            relief_shot shot;
            lmb_light sun;
            memset(&shot, 0, sizeof shot);
            shot.kernels = lmb_kernels_pick();
            shot.view = camera(s, 9, side, &sun);
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
    report r = {""};
    if (wanted("quality", argc, argv)) {
        quality(&r);
    }
    if (wanted("speed", argc, argv)) {
        speed(&r);
    }
    return test_failed > 0;
}
