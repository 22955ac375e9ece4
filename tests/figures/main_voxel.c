/* main_voxel.c: one bounce by cones through voxels against truth and closed forms: errors, time by stage, memory.
 *                                                                                   [M6-M8 M11-M13 M20-M22, DESIGN 6]
 *     voxel [SCENE...]        cornell and corridor have bars
 *
 * Seconds are of one core, on this machine; shares of a frame's peak memory are of what this program takes for it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <lambent/lambent.h>

#include "../../tools/metrics.h"
#include "../truth_scene.h"

int test_passed, test_failed, test_skipped;

enum { MAP = 512 };

typedef struct work {
    const char *scene;
    model loaded;
    image truth, surface;
    lmb_view view;
    lmb_target eye;
    lmb_tree tree;
    lmb_voxels voxels;
    lmb_cones cones;
    lmb_cone_scratch scratch;
    lmb_tile tile;
    double map_seconds, tree_seconds, build_seconds, inject_seconds, filter_seconds, eye_seconds, cone_seconds;
    double voxel_bytes, all_bytes;
    void *memory[32]; /* all that was taken */
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

/* Since the last call. */
static double lap(double *from)
{
    const double now = seconds_now(), spent = now - *from;
    *from = now;
    return spent;
}

/* --- a scene ------------------------------------------------------------------------------------------------------ */

static int load(work *w, const char *scene)
{
    char path[SHARED_PATH];
    model_notes notes;
    report r = {""};
    memset(w, 0, sizeof *w);
    memset(&notes, 0, sizeof notes);
    w->scene = scene;
    truth_path(path, scene, "scene.gltf");
    if (!truth_is_there(scene) || !truth_picture(&w->truth, scene, "pt_indirect1.pfm") ||
        !truth_picture(&w->surface, scene, "gbuffer_depth.pfm")) {
        return 0;
    }
    const int ok = model_load(&w->loaded, path, NULL, &notes, &r) && w->loaded.camera_count > 0;
    CHECK_MSG(ok, "%s: %s", scene, r.text);
    return ok;
}

static void close_scene(work *w)
{
    while (w->taken > 0) {
        free(w->memory[--w->taken]);
    }
    image_free(&w->truth);
    image_free(&w->surface);
    model_free(&w->loaded);
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

/* First points of all lights' maps. */
static void draw_lights(work *w)
{
    const lmb_scene *scene = &w->loaded.scene;
    const lmb_kernels *kernels = lmb_kernels_pick();
    uint32_t faces = 0;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        faces += (uint32_t)lmb_light_map_faces(&scene->lights[i]);
    }
    const size_t bytes = lmb_tree_bytes(faces, MAP);
    CHECK(lmb_tree_init(&w->tree, faces, MAP, take(w, bytes), bytes) == LMB_OK);
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        const lmb_light *light = &scene->lights[i];
        const int32_t own = lmb_light_map_faces(light);
        const size_t size = lmb_light_map_bytes(own, MAP, LMB_ID32);
        lmb_light_map map;
        double from = seconds_now();
        CHECK(lmb_light_map_init(&map, light, scene, MAP, LMB_ID32, take(w, size), size) == LMB_OK);
        lmb_light_map_clear(&map);
        CHECK(lmb_light_map_draw(&map, kernels, scene, 1, lmb_scene_triangles(scene), NULL) == LMB_OK);
        w->map_seconds += lap(&from);
        for (int32_t f = 0; f < own; ++f) {
            if ((map.drawn >> f & 1u) != 0) {
                CHECK(lmb_tree_texels(&w->tree, kernels, &w->tile, scene, light, &map, f, w->tree.faces++, 0,
                                      MAP / LMB_TILE) == LMB_OK);
            }
        }
        w->tree_seconds += lap(&from);
    }
}

static void make_voxels(work *w, int32_t depth, uint32_t cap)
{
    const lmb_scene *scene = &w->loaded.scene;
    const lmb_voxel_part part = {scene, 1, lmb_scene_triangles(scene), {1, 1}};
    const size_t bytes = lmb_voxels_bytes(cap, LMB_VOXELS_ONE);
    lmb_voxels *v = &w->voxels;
    w->voxel_bytes = (double)bytes;
    CHECK(lmb_voxels_init(v, cap, LMB_VOXELS_ONE, take(w, bytes), bytes) == LMB_OK);
    double from = seconds_now();
    CHECK(lmb_voxels_build(v, &scene->bounds_min, &scene->bounds_max, depth, &part, 1) == LMB_OK);
    w->build_seconds = lap(&from);
    CHECK(lmb_voxels_inject(v, 0, w->tree.texel, (size_t)w->tree.faces * MAP * MAP) == LMB_OK);
    w->inject_seconds = lap(&from);
    CHECK(lmb_voxels_filter(v, 0) == LMB_OK);
    w->filter_seconds = lap(&from);
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

/* Radiance of one bounce, three floats a pixel. */
static void trace(work *w, float *out)
{
    const lmb_scene *scene = &w->loaded.scene;
    const lmb_cone_trace how = {lmb_kernels_pick(), &w->voxels, 0, 0, NULL, &w->scratch};
    const int32_t width = w->view.frame_width, height = w->view.frame_height;
    double from = seconds_now();
    for (int32_t i = 0; i < (width + 7) / 8 * ((height + 7) / 8); ++i) {
        const int32_t x = i % ((width + 7) / 8) * 8, y = i / ((width + 7) / 8) * 8;
        lmb_irradiance light;
        memset(&light, 0, sizeof light);
        CHECK(lmb_resolve_tile(&w->tile, how.kernels, &w->view, scene, &w->eye, x, y) == LMB_OK);
        if (w->tile.hits > 0) {
            CHECK(lmb_cones_diffuse(&light, NULL, &how, &w->cones, &w->tile) == LMB_OK);
        }
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int32_t px = x + k % 8, py = y + k / 8;
            for (int c = 0; c < 3 && px < width && py < height; ++c) {
                out[3 * (py * width + px) + c] = light.rgb[c][k] * w->tile.albedo[c][k] * 0.318309886f;
            }
        }
    }
    w->cone_seconds = lap(&from);
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
    printf("  %-11s %-22s rmse %.3f  trim %.3f  e50 %.3f  e95 %.3f  mean %.3f  leak %.2f\n", w->scene, what, m.rmse,
           m.trim, m.e50, m.e95, m.mean, m.leak);
    CHECK_MSG(!has_bars || m.rmse <= 0.45, "%s: rmse %g", w->scene, m.rmse);
    CHECK_MSG(!has_bars || m.e50 <= 0.20, "%s: e50 %g", w->scene, m.e50);
}

static void bounce(const char *scene, int has_bars)
{
    static const int32_t depths[] = {6, 7};
    static const int32_t counts[] = {7, 19, 37};
    static work w;
    if (!load(&w, scene)) {
        return;
    }
    float *pixels = take(&w, (size_t)w.truth.width * (size_t)w.truth.height * 3 * sizeof *pixels);
    truth_view(&w.view, &w.loaded.cameras[0], &w.truth);
    draw_eye(&w);
    draw_lights(&w);
    for (int d = 0; d < 2; ++d) {
        make_voxels(&w, depths[d], 1u << 21);
        const lmb_voxels *v = &w.voxels;
        printf("  %s, depth %d of %d: %u voxels, %.1f MB; area %.5f m2; flux %.6f W, %.2g of it lost; build %.1f ms, "
               "inject %.1f, filter %.1f\n", scene, (int)v->depth, (int)v->asked, (unsigned)v->count,
               (double)v->count * 148e-6, v->area, v->flux[0], v->lost[0] / (v->flux[0] + v->lost[0]), w.build_seconds * 1e3,
               w.inject_seconds * 1e3, w.filter_seconds * 1e3);
        for (int n = 0; n < 3; ++n) {
            char what[32];
            CHECK(lmb_cones_init(&w.cones, v, counts[n]) == LMB_OK);
            trace(&w, pixels);
            snprintf(what, sizeof what, "%d^3, %d cones, %.2f s", 1 << v->depth, (int)counts[n], w.cone_seconds);
            against_truth(&w, pixels, what, has_bars && v->depth == 7 && counts[n] == 19);
            dump(&w, pixels, v->depth, counts[n]);
        }
    }
    close_scene(&w);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        for (int i = 1; i < argc; ++i) {
            bounce(argv[i], 0);
        }
    } else {
        bounce("cornell", 1);
        bounce("corridor", 1);
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
