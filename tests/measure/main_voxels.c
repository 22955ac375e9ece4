/* main_voxels.c: compares one bounce by cones through voxels with truth and closed forms:
 * errors, time by stage, memory.
 *                                                                                   [M6-M8 M11-M13 M20-M22]
 *     measure-voxels [SCENE...]        cornell and corridor have bars
 *
 * Seconds are those of one core. `x`: multiples of the time of one bounce by cuts with exact occlusion (the tool's
 * default). Closed forms: tests/analytic/test_voxels.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <lambent/lambent.h>

#include "../../tools/bench/bench_operations.h"
#include "../../tools/bench/bench_rates.h"
#include "../../tools/picture/metrics.h"
#include "../truth_scene.h"
#include "../voxel_sum.h"

int test_passed, test_failed, test_skipped;

enum { MAP = 512, CUT_MAP = 256, CAP = 1 << 22 };

/* Limits of cuts in the tool's default quality. */
static const float cut_error = 0.2f, cut_visibility = 0.06f;

typedef struct work {
    const char *scene;
    model loaded;
    image truth, surface;
    lmb_view view;
    lmb_target eye;
    lmb_tree tree, cut_tree; /* every texel, for voxels; and the tree of bounced light */
    lmb_bvh bvh;
    lmb_cut cut;
    lmb_voxels voxels;
    lmb_cones cones;
    lmb_cone_scratch scratch;
    lmb_tile tile;
    double map_seconds, tree_seconds, cut_tree_seconds, build_seconds, inject_seconds, filter_seconds, eye_seconds,
        seconds;      /* `seconds`: of the picture, by cones or by cuts */
    double all_bytes; /* without voxels */
    void *memory[32]; /* all allocations */
    int taken;
} work;

static void *take(work *w, size_t bytes)
{
    void *p = calloc(1, bytes);
    if (p == NULL || w->taken == 32) {
        printf("not enough memory\n");
        exit(1);
    }
    w->all_bytes += (double)bytes;
    return w->memory[w->taken++] = p;
}

static double seconds_now(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Seconds since the last call. */
static double lap(double *from)
{
    const double now = seconds_now(), spent = now - *from;
    *from = now;
    return spent;
}

/* --- a scene ------------------------------------------------------------------------------------------------------ */

static int load(work *w, const char *scene)
{
    memset(w, 0, sizeof *w);
    w->scene = scene;
    return truth_scene(&w->loaded, &w->truth, &w->surface, scene);
}

static void close_scene(work *w)
{
    while (w->taken > 0) {
        free(w->memory[--w->taken]);
    }
    truth_scene_free(&w->loaded, &w->truth, &w->surface);
}

static void draw_eye(work *w)
{
    const lmb_scene *scene = &w->loaded.scene;
    const int32_t width = w->view.frame_width, height = w->view.frame_height;
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, width, height),
                 id = lmb_surface_bytes(LMB_ID32, width, height);
    CHECK(lmb_surface_init(&w->eye.depth, LMB_DEPTH32F, width, height, take(w, depth), depth) == LMB_OK);
    CHECK(lmb_surface_init(&w->eye.id, LMB_ID32, width, height, take(w, id), id) == LMB_OK);
    double from = seconds_now();
    lmb_surface_clear(&w->eye.depth);
    lmb_surface_clear(&w->eye.id);
    CHECK(lmb_draw(&w->eye, lmb_kernels_pick(), &w->view, scene, 1, lmb_scene_triangles(scene), LMB_CULL_BACK, NULL) ==
          LMB_OK);
    w->eye_seconds = lap(&from);
}

static void add_faces(work *w, lmb_tree *tree, const lmb_light *light, const lmb_shadow_map *map)
{
    for (int32_t f = 0; f < map->faces; ++f) {
        if ((map->drawn >> f & 1u) != 0) {
            CHECK(lmb_tree_texels(tree, lmb_kernels_pick(), &w->tile, &w->loaded.scene, light, map, f, tree->faces++, 0,
                                  MAP / LMB_TILE) == LMB_OK);
        }
    }
}

/* First points of all shadow maps. */
static void draw_lights(work *w)
{
    const lmb_scene *scene = &w->loaded.scene;
    const lmb_kernels *kernels = lmb_kernels_pick();
    uint32_t faces = 0;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        faces += (uint32_t)lmb_shadow_map_faces(&scene->lights[i], scene);
    }
    const size_t bytes = lmb_tree_bytes(faces, MAP), cut_bytes = lmb_tree_bytes(faces, CUT_MAP);
    CHECK(lmb_tree_init(&w->tree, faces, MAP, take(w, bytes), bytes) == LMB_OK);
    CHECK(lmb_tree_init(&w->cut_tree, faces, CUT_MAP, take(w, cut_bytes), cut_bytes) == LMB_OK);
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        const lmb_light *light = &scene->lights[i];
        const int32_t own = lmb_shadow_map_faces(light, scene);
        const size_t size = lmb_shadow_map_bytes(own, MAP, LMB_ID32);
        lmb_shadow_map map;
        double from = seconds_now();
        CHECK(lmb_shadow_map_init(&map, light, scene, MAP, LMB_ID32, take(w, size), size) == LMB_OK);
        lmb_shadow_map_clear(&map);
        CHECK(lmb_shadow_map_draw(&map, kernels, scene, 1, lmb_scene_triangles(scene), NULL) == LMB_OK);
        w->map_seconds += lap(&from);
        add_faces(w, &w->tree, light, &map);
        w->tree_seconds += lap(&from);
        add_faces(w, &w->cut_tree, light, &map);
        w->cut_tree_seconds += lap(&from);
    }
    double from = seconds_now();
    for (uint32_t f = 0; f < w->cut_tree.faces; ++f) {
        CHECK(lmb_tree_sum(&w->cut_tree, f) == LMB_OK);
    }
    w->cut_tree_seconds += lap(&from);
}

static void make_voxels(work *w, void *memory, uint32_t cap, int32_t depth)
{
    const lmb_scene *scene = &w->loaded.scene;
    const lmb_voxel_part part = {scene, 1, lmb_scene_triangles(scene), {1, 1}};
    lmb_voxels *v = &w->voxels;
    CHECK(lmb_voxels_init(v, cap, LMB_VOXELS_ONE, memory, lmb_voxels_bytes(cap, LMB_VOXELS_ONE)) == LMB_OK);
    double from = seconds_now();
    CHECK(lmb_voxels_build(v, &scene->bounds_min, &scene->bounds_max, depth, &part, 1) == LMB_OK);
    w->build_seconds = lap(&from);
    CHECK(lmb_voxels_inject(v, 0, w->tree.texel, (size_t)w->tree.faces * MAP * MAP) == LMB_OK);
    w->inject_seconds = lap(&from);
    CHECK(lmb_voxels_filter(v, 0) == LMB_OK);
    w->filter_seconds = lap(&from);
}

static double voxel_bytes(const work *w) { return (double)lmb_voxels_bytes(w->voxels.count, LMB_VOXELS_ONE); }

/* M7, M13: compares the flux in the voxels with the map's, and the root's mean with the sum of the leaves. */
static void check_energy(const work *w)
{
    const lmb_voxels *v = &w->voxels;
    double want[6] = {0, 0, 0, 0, 0, 0}, got[6][3], flux = 0.0, off = 0.0, max = 0.0;
    for (size_t i = 0; i < (size_t)w->tree.faces * MAP * MAP; ++i) {
        const lmb_texel *t = &w->tree.texel[i];
        const float n[3] = {t->normal.x, t->normal.y, t->normal.z};
        flux += (double)t->flux[0] + (double)t->flux[1] + (double)t->flux[2];
        for (int k = 0; k < 3; ++k) {
            want[2 * k + (n[k] < 0.0f)] += (double)t->flux[0] * fabs((double)n[k]);
        }
    }
    voxel_sum(got, v, 0);
    for (int k = 0; k < 6; ++k) {
        off = fmax(off, fabs(got[k][0] - want[k]));
        max = fmax(max, want[k]);
    }
    printf("  %-11s energy: %.6f W of %.6f injected, %.2g lost; leaves by direction off by %.2g\n", w->scene,
           v->flux[0], flux, v->lost[0] / flux, off / max);
    CHECK(fabs(v->flux[0] / flux - 1.0) <= 0.02 && off <= 0.02 * max);
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

/* One bounce on a tile: by cones, or by the cut of exact bounced light. */
static void light_tile(work *w, lmb_irradiance *light, int by_cuts)
{
    const lmb_cone_trace cones = {lmb_kernels_pick(), &w->voxels, 0, 0, NULL, &w->scratch, 0};
    lmb_cut_params cut_params;
    memset(&cut_params, 0, sizeof cut_params);
    cut_params.error = cut_error;
    cut_params.visibility = cut_visibility;
    cut_params.bvh = &w->bvh;
    memset(light, 0, sizeof *light);
    if (by_cuts) {
        CHECK(lmb_gather_cut(light, cones.kernels, &w->cut, &w->tile, &w->cut_tree, &cut_params) == LMB_OK);
    } else {
        CHECK(lmb_cones_diffuse(light, NULL, &cones, &w->cones, &w->tile) == LMB_OK);
    }
}

/* Radiance of one bounce, three floats a pixel. */
static void draw(work *w, float *out, int by_cuts)
{
    const int32_t width = w->view.frame_width, height = w->view.frame_height, across = (width + 7) / 8;
    double from = seconds_now();
    for (int32_t i = 0; i < across * ((height + 7) / 8); ++i) {
        const int32_t x = i % across * 8, y = i / across * 8;
        lmb_irradiance light;
        CHECK(lmb_resolve_tile(&w->tile, lmb_kernels_pick(), &w->view, &w->loaded.scene, &w->eye, x, y) == LMB_OK);
        light_tile(w, &light, by_cuts);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int32_t px = x + k % 8, py = y + k / 8;
            for (int c = 0; c < 3 && px < width && py < height; ++c) {
                out[3 * (py * width + px) + c] = light.rgb[c][k] * w->tile.albedo[c][k] * 0.318309886f;
            }
        }
    }
    w->seconds = lap(&from);
}

static void dump(const work *w, const float *pixels, int32_t depth, int cones)
{
    const char *folder = getenv("LMB_DUMP");
    const image picture = {w->view.frame_width, w->view.frame_height, 3, (float *)pixels};
    char path[SHARED_PATH];
    file_bytes bytes;
    report r = {""};
    if (folder != NULL) {
        snprintf(path, sizeof path, "%s/%s_%d_%d.pfm", folder, w->scene, (int)depth, cones);
        CHECK(pfm_encode(&bytes, &picture, &r) && file_write(path, bytes.data, bytes.size, &r));
        file_free(&bytes);
    }
}

/* --- one bounce against truth ------------------------------------------------------------------------------------- */

static void against_truth(work *w, const float *pixels, const char *what, int has_bars)
{
    metrics_input in;
    metrics m;
    report r = {""};
    memset(&in, 0, sizeof in);
    in.test = pixels;
    in.truth = w->truth.pixels;
    in.surface = w->surface.pixels;
    in.width = w->truth.width;
    in.height = w->truth.height;
    in.channels = 3;
    if (!metrics_measure(&m, &in, &r)) {
        CHECK_MSG(0, "%s", r.text);
        return;
    }
    printf("  %-11s %-26s rmse %.3f  trim %.3f  e50 %.3f  e95 %.3f  mean %.3f  leak %.2f\n", w->scene, what, m.rmse,
           m.trim, m.e50, m.e95, m.mean, m.leak);
    CHECK_MSG(!has_bars || m.rmse <= 0.45, "%s: rmse %g", w->scene, m.rmse);
    CHECK_MSG(!has_bars || m.e50 <= 0.20, "%s: e50 %g", w->scene, m.e50);
}

static void take_bvh(work *w)
{
    const uint32_t triangles = lmb_scene_triangles(&w->loaded.scene);
    const size_t bytes = lmb_bvh_bytes(triangles);
    CHECK(lmb_bvh_init(&w->bvh, triangles, take(w, bytes), bytes) == LMB_OK);
    CHECK(lmb_bvh_build(&w->bvh, &w->loaded.scene) == LMB_OK);
}

static void say_stages(const work *w)
{
    const lmb_voxels *v = &w->voxels;
    printf("  %-11s %4d^3: %7u voxels, %6.1f MB; build %6.1f ms, inject %5.1f, filter %5.1f\n", w->scene, 1 << v->depth,
           (unsigned)v->count, voxel_bytes(w) * 1e-6, w->build_seconds * 1e3, w->inject_seconds * 1e3,
           w->filter_seconds * 1e3);
}

static void bounce(work *w, const char *scene, void *memory, int has_bars)
{
    static const int32_t counts[] = {7, 19, 37};
    char what[40];
    if (!load(w, scene)) {
        return;
    }
    float *pixels = take(w, (size_t)w->truth.width * (size_t)w->truth.height * 3 * sizeof *pixels);
    truth_view(&w->view, &w->loaded.cameras[0], &w->truth);
    draw_eye(w);
    draw_lights(w);
    take_bvh(w);
    draw(w, pixels, 1);
    const double by_cuts = w->seconds;
    snprintf(what, sizeof what, "cuts, %.2f s", by_cuts);
    against_truth(w, pixels, what, 0);
    for (int32_t depth = 5; depth <= 8; ++depth) {
        make_voxels(w, memory, CAP, depth);
        say_stages(w);
        for (int n = 0; n < 3; ++n) {
            CHECK(lmb_cones_init(&w->cones, &w->voxels, counts[n]) == LMB_OK);
            if (depth == 7 || counts[n] == 19) {
                draw(w, pixels, 0);
                snprintf(what, sizeof what, "%2d cones, %.2f s, %.1f x", (int)counts[n], w->seconds,
                         w->seconds / by_cuts);
                against_truth(w, pixels, what, has_bars && depth == 7 && counts[n] == 19);
                dump(w, pixels, depth, counts[n]);
            }
        }
        if (depth == 7) {
            check_energy(w);
        }
    }
    close_scene(w);
}

/* --- a frame of 640x480 ------------------------------------------------------------------------------------------- */

/* Seconds for the cones of every sixteenth tile. */
static double trace_some(work *w, const lmb_kernels *kernels)
{
    const int32_t across = (w->view.frame_width + 7) / 8, down = (w->view.frame_height + 7) / 8;
    const lmb_cone_trace trace = {kernels, &w->voxels, 0, 0, NULL, &w->scratch, 0};
    double spent = 0.0;
    for (int32_t i = 0; i < across * down; i += 16) {
        lmb_irradiance light;
        memset(&light, 0, sizeof light);
        CHECK(lmb_resolve_tile(&w->tile, lmb_kernels_pick(), &w->view, &w->loaded.scene, &w->eye, i % across * 8,
                               i / across * 8) == LMB_OK);
        double from = seconds_now();
        CHECK(lmb_cones_diffuse(&light, NULL, &trace, &w->cones, &w->tile) == LMB_OK);
        spent += lap(&from);
    }
    return spent;
}

/* Compares with two lower bounds of the same run: the arithmetic at the measured rate of the processor (bench gather),
 * and the reads: each lane reads four floats, or one, from a place of its own in a table that fits the first-level
 * cache. The measurements alternate, so that both run at the same clock rate and load. */
static void say_share(work *w)
{
    bench_rates rates;
    double counts[BENCH_OPS], min = 1e30, per_second = 0.0;
    int unit = 0;
    if (!bench_rates_begin(&rates, lmb_kernels_name(lmb_kernels_pick()))) {
        printf("  %s: its rates are not known\n", lmb_kernels_name(lmb_kernels_pick()));
        return;
    }
    for (int i = 0; i < 5; ++i) {
        const double spent = trace_some(w, lmb_kernels_pick());
        min = spent < min ? spent : min;
        bench_rates_step(&rates);
        per_second = bench_rates_read(&rates);
    }
    trace_some(w, bench_operations_begin());
    bench_operations_end(counts);
    const double bound = bench_rates_bound(&unit, &rates, counts) / rates.backend->lanes * rates.cycle,
                 reads = bench_operations_reads() / per_second;
    printf("  of the cones' time their arithmetic takes at least %.0f %% (%s), their reads %.0f %% at best (%s, "
           "%.2f GHz, %.2g reads/s)\n",
           100.0 * bound / min, bench_op_names[unit], 100.0 * reads / min, rates.backend->name, 1e-9 / rates.cycle,
           per_second);
}

static void say_frame(const work *w, const char *scene)
{
    const double all = w->map_seconds + w->tree_seconds + w->build_seconds + w->inject_seconds + w->filter_seconds +
                       w->eye_seconds + w->seconds;
    printf("  %s at 640x480, %d^3, 19 cones: %.2f s: shadow map %.1f ms, first points %.1f, voxels %.1f, "
           "injection %.1f, filter %.1f, eye %.1f, cones %.0f; %u voxels, %.1f MB\n",
           scene, 1 << w->voxels.depth, all, w->map_seconds * 1e3, w->tree_seconds * 1e3, w->build_seconds * 1e3,
           w->inject_seconds * 1e3, w->filter_seconds * 1e3, w->eye_seconds * 1e3, w->seconds * 1e3,
           (unsigned)w->voxels.count, voxel_bytes(w) * 1e-6);
}

static void frame(work *w, const char *scene, void *memory)
{
    double by_cones = 0.0;
    if (!load(w, scene)) {
        return;
    }
    image like = w->truth;
    like.width = 640;
    like.height = 480;
    float *pixels = take(w, (size_t)like.width * (size_t)like.height * 3 * sizeof *pixels);
    truth_view(&w->view, &w->loaded.cameras[0], &like);
    draw_eye(w);
    draw_lights(w);
    take_bvh(w);
    for (int32_t depth = 5; depth <= 8; ++depth) {
        make_voxels(w, memory, CAP, depth);
        CHECK(lmb_cones_init(&w->cones, &w->voxels, 19) == LMB_OK);
        draw(w, pixels, 0);
        say_frame(w, scene);
        if (depth == 7) {
            by_cones = w->seconds;
            printf("  voxels take %.1f MB, %.0f %% of the frame's memory\n", voxel_bytes(w) * 1e-6,
                   100.0 * voxel_bytes(w) / (voxel_bytes(w) + w->all_bytes));
            say_share(w);
        }
    }
    draw(w, pixels, 1);
    printf("  by cuts the pixels take %.0f ms and their tree %.1f: cones of 128^3 take %.1f times that\n",
           w->seconds * 1e3, w->cut_tree_seconds * 1e3, by_cones / w->seconds);
    close_scene(w);
}

int main(int argc, char **argv)
{
    static work w;
    void *memory = malloc(lmb_voxels_bytes(CAP, LMB_VOXELS_ONE));
    if (memory == NULL) {
        printf("not enough memory\n");
        return 1;
    }
    for (int i = 1; i < argc; ++i) {
        bounce(&w, argv[i], memory, 0);
    }
    if (argc == 1) {
        bounce(&w, "cornell", memory, 1);
        bounce(&w, "corridor", memory, 1);
        frame(&w, "cornell", memory);
    }
    free(memory);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
