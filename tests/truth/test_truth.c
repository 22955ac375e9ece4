/* test_truth.c: compares pictures with the path-traced ones of the shared folder. [V25 V27 V28 V29 V30]
 *
 * LMB_SHARED names the folder (default ../shared); missing files are skipped. Settings are the defaults of `lambent
 * render`. Some scenes have bars; the figures of the others are only printed. LMB_TRUTH_ALL also prints the bounced
 * light of every scene, which takes eight times as long. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <lambent/lambent.h>

#include "../../tools/picture/metrics.h"
#include "../every_texel.h"
#include "../truth_scene.h"

void test_truth(void);

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

/* --- a scene, drawn as by the tool -------------------------------------------------------------------------------- */

typedef struct stage {
    const char *name;
    model loaded;
    lmb_frame frame;
    lmb_render *render;
    void *map_memory, *point_memory, *tree_memory, *depth_memory, *id_memory;
    lmb_stats stats;
    lmb_many_lights many_lights;
    void *many_lights_memory, *bvh_memory;
    image drawn, depth; /* depth: of the truth; the third channel marks surfaces */
} stage;

static void *take(size_t bytes)
{
    void *p = calloc(1, bytes > 0 ? bytes : 1);
    if (p == NULL) {
        printf("not enough memory for the test\n");
        exit(1);
    }
    return p;
}

/* 1024 texels a side, less if there are many faces: 2 M texels in all. */
static void take_maps(stage *s)
{
    const lmb_scene *scene = &s->loaded.scene;
    lmb_frame *f = &s->frame;
    uint32_t faces = 0, side;
    f->shadow_map = 1024;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        faces += (uint32_t)lmb_shadow_map_faces(&scene->lights[i], scene);
    }
    while ((uint32_t)f->shadow_map * (uint32_t)f->shadow_map * faces > 2u << 20) {
        f->shadow_map /= 2;
    }
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        f->map_bytes += lmb_shadow_map_bytes(lmb_shadow_map_faces(&scene->lights[i], scene), f->shadow_map, LMB_ID32);
    }
    f->map_memory = s->map_memory = take(f->map_bytes);
    side = (uint32_t)f->shadow_map / 8u;
    size_t bytes = lmb_points_bytes(side * side * 4u * faces, side);
    s->point_memory = take(bytes);
    CHECK(lmb_points_init(&f->points, side * side * 4u * faces, side, s->point_memory, bytes) == LMB_OK);
}

static void take_frame(stage *s)
{
    lmb_frame *f = &s->frame;
    int32_t w = s->drawn.width, h = s->drawn.height;
    size_t depth = lmb_surface_bytes(LMB_DEPTH32F, w, h), id = lmb_surface_bytes(LMB_ID32, w, h),
           out = (size_t)w * (size_t)h * 12;
    s->depth_memory = take(depth);
    s->id_memory = take(id);
    s->drawn.pixels = take(out);
    s->drawn.channels = 3;
    s->render = take(sizeof *s->render);
    f->groups = take(sizeof *f->groups);
    f->scratch = take(sizeof *f->scratch);
    CHECK(lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, w, h, s->depth_memory, depth) == LMB_OK);
    CHECK(lmb_surface_init(&f->eye.id, LMB_ID32, w, h, s->id_memory, id) == LMB_OK);
    CHECK(lmb_surface_init(&f->out, LMB_RGB32F, w, h, s->drawn.pixels, out) == LMB_OK);
    f->kernels = picked_kernels();
    f->scene = &s->loaded.scene;
    f->occlusion = LMB_OCCLUSION_VIEW;
    f->steps = 12;
    f->id_format = LMB_ID32;
    f->stats = &s->stats;
}

/* Loads a scene's file and view. `sized_as`: the truth picture that gives the size. */
static int stage_load(stage *s, const char *name, const char *sized_as)
{
    char path[SHARED_PATH];
    model_notes notes;
    report r = {""};
    image like;
    memset(s, 0, sizeof *s);
    memset(&notes, 0, sizeof notes);
    s->name = name;
    if (!truth_is_there(name) || !truth_picture(&like, name, sized_as)) {
        return 0;
    }
    s->drawn.width = like.width;
    s->drawn.height = like.height;
    image_free(&like);
    truth_path(path, name, "scene.gltf");
    int ok = model_load(&s->loaded, path, NULL, &notes, &r);
    CHECK_MSG(ok && s->loaded.camera_count > 0, "%s: %s", name, r.text);
    if (ok) {
        truth_view(&s->frame.view, &s->loaded.cameras[0], &s->drawn);
    }
    return ok;
}

static int stage_open(stage *s, const char *name, const char *sized_as)
{
    const int ok = stage_load(s, name, sized_as);
    if (ok) {
        take_maps(s);
        take_frame(s);
    }
    return ok;
}

static void stage_close(stage *s)
{
    free(s->many_lights_memory);
    free(s->bvh_memory);
    free(s->map_memory);
    free(s->point_memory);
    free(s->tree_memory);
    free(s->depth_memory);
    free(s->id_memory);
    free(s->render);
    free(s->frame.groups);
    free(s->frame.scratch);
    image_free(&s->drawn);
    image_free(&s->depth);
    model_free(&s->loaded);
}

static void stage_draw(stage *s, int32_t show)
{
    memset(&s->stats, 0, sizeof s->stats);
    s->frame.show = show;
    CHECK(lmb_render_frame(s->render, &s->frame) == LMB_OK);
}

static int has_surface(const stage *s, int i) { return s->depth.pixels[3 * i + 2] > 0.5f; }

static float grey(const image *p, int i)
{
    return (p->pixels[3 * i] + p->pixels[3 * i + 1] + p->pixels[3 * i + 2]) / 3.0f;
}

static metrics_input input_of(const stage *s, const image *truth)
{
    metrics_input in;
    memset(&in, 0, sizeof in);
    in.test = s->drawn.pixels;
    in.truth = truth->pixels;
    in.surface = s->depth.pixels;
    in.width = truth->width;
    in.height = truth->height;
    in.channels = 3;
    return in;
}

static int measure(metrics *m, const stage *s, const image *truth)
{
    const metrics_input in = input_of(s, truth);
    report r = {""};
    int ok = s->depth.channels == 3 && truth->width == s->drawn.width && truth->height == s->drawn.height &&
             metrics_measure(m, &in, &r);
    CHECK_MSG(ok, "%s: %s", s->name, r.text);
    return ok;
}

/* --- G-buffer ----------------------------------------------------------------------------------------------------- */

enum { DEPTH, NORMAL, ALBEDO };

static void draw_attribute(stage *s, int what)
{
    lmb_frame *f = &s->frame;
    lmb_surface z = f->out;
    z.format = LMB_R32F;
    z.stride_bytes = z.width * 4;
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    CHECK(lmb_draw(&f->eye, f->kernels, &f->view, f->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK,
                   NULL) == LMB_OK);
    for (int32_t band = 0; band < (f->view.frame_height + 7) / 8; ++band) {
        CHECK(lmb_gbuffer_band(what == DEPTH ? &z : NULL, what == NORMAL ? &f->out : NULL,
                               what == ALBEDO ? &f->out : NULL, f->kernels, &f->scratch->tile, &f->view, f->scene,
                               &f->eye, band) == LMB_OK);
    }
}

/* Equal within 0.1 %: of the depth, of the length of a unit normal, of each channel. The
 * background must be empty in both. */
static int is_same(int what, const float *test, const float *truth)
{
    double d = 0.0;
    if (what == DEPTH) {
        return truth[2] > 0.5f ? fabs((double)test[0] / (double)truth[0] - 1.0) <= 1e-3 : test[0] == 0.0f;
    }
    for (int c = 0; c < 3; ++c) {
        double off = (double)test[c] - (double)truth[c];
        if (what == ALBEDO && fabs(off) > 1e-3 * (double)truth[c]) {
            return 0;
        }
        d += off * off;
    }
    return what == ALBEDO || d <= 1e-6;
}

/* V5, V23: depth, normal and reflectance of the first surface along each pixel's ray. */
static void check_gbuffer(const char *name)
{
    static const char *const files[] = {"gbuffer_depth.pfm", "gbuffer_normal.pfm", "gbuffer_albedo.pfm"};
    double share[3] = {0, 0, 0};
    stage s;
    if (!stage_open(&s, name, files[0])) {
        return;
    }
    for (int what = DEPTH; what <= ALBEDO; ++what) {
        image truth;
        int n = s.drawn.width * s.drawn.height, same = 0;
        draw_attribute(&s, what);
        if (truth_picture(&truth, name, files[what])) {
            for (int i = 0; i < n; ++i) {
                same += is_same(what, s.drawn.pixels + (what == DEPTH ? i : 3 * i), truth.pixels + 3 * i);
            }
            image_free(&truth);
        }
        share[what] = (double)same / n;
        CHECK_MSG(share[what] >= 0.995, "%s, %s: %.3f %% of the pixels", name, files[what], share[what] * 100);
    }
    printf("  %-15s depth %.3f %%, normal %.3f %%, albedo %.3f %% of pixels within 0.1 %%\n", name, share[0] * 100,
           share[1] * 100, share[2] * 100);
    stage_close(&s);
}

/* --- direct light ------------------------------------------------------------------------------------------------- */

static int is_lit(const image *p, int x, int y) { return grey(p, y * p->width + x) > 0.0f; }

/* A pixel with one of its four neighbours lit if it is dark, or dark if it is lit. */
static int on_boundary(const image *p, int x, int y)
{
    int lit = is_lit(p, x, y);
    return (x > 0 && is_lit(p, x - 1, y) != lit) || (x + 1 < p->width && is_lit(p, x + 1, y) != lit) ||
           (y > 0 && is_lit(p, x, y - 1) != lit) || (y + 1 < p->height && is_lit(p, x, y + 1) != lit);
}

/* Within 2 px of such a pixel. */
static int near_boundary(const image *p, int x, int y)
{
    for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
            int i = x + dx, j = y + dy;
            if (dx * dx + dy * dy <= 4 && i >= 0 && j >= 0 && i < p->width && j < p->height && on_boundary(p, i, j)) {
                return 1;
            }
        }
    }
    return 0;
}

typedef struct direct_figures {
    double rmse; /* relative, away from boundaries */
    int pixels, wrong, wrong_far;
} direct_figures;

static direct_figures compare_direct(const stage *s, const image *truth)
{
    direct_figures d = {0, 0, 0, 0};
    double sum = 0.0, mean = 0.0;
    int away = 0;
    for (int i = 0; i < truth->width * truth->height; ++i) {
        int x = i % truth->width, y = i / truth->width;
        if (!has_surface(s, i)) {
            continue;
        }
        int is_near = near_boundary(truth, x, y), wrong = is_lit(truth, x, y) != is_lit(&s->drawn, x, y);
        ++d.pixels;
        d.wrong += wrong;
        d.wrong_far += wrong && !is_near;
        mean += (double)grey(truth, i);
        for (int c = 0; c < 3 && !is_near; ++c) {
            double off = (double)s->drawn.pixels[3 * i + c] - (double)truth->pixels[3 * i + c];
            sum += off * off;
            ++away;
        }
    }
    d.rmse = sqrt(sum / (away > 0 ? away : 1)) / (mean / d.pixels);
    return d;
}

/* V7, V29: direct light and shadows. `barred`: the milestone's bars apply; otherwise figures are only printed. */
static void check_direct(const char *name, int barred)
{
    stage s;
    image truth;
    metrics m;
    if (!stage_open(&s, name, "cycles_direct.pfm")) {
        return;
    }
    if (truth_picture(&s.depth, name, "gbuffer_depth.pfm") && truth_picture(&truth, name, "cycles_direct.pfm")) {
        stage_draw(&s, LMB_SHOW_DIRECT);
        if (measure(&m, &s, &truth)) {
            direct_figures d = compare_direct(&s, &truth);
            printf("  %-15s e50 %.5f, off edges rmse %.5f, wrongly lit or dark %d of %d, %d of them over 2 px from an "
                   "edge\n",
                   name, m.e50, d.rmse, d.wrong, d.pixels, d.wrong_far);
            CHECK_MSG(!barred || m.e50 <= 0.005, "%s: e50 %g", name, m.e50);
            CHECK_MSG(!barred || d.rmse <= 0.02, "%s: rmse %g", name, d.rmse);
            CHECK_MSG(!barred || d.wrong * 500 <= d.pixels, "%s: %d of %d", name, d.wrong, d.pixels);
            CHECK_MSG(!barred || d.wrong_far == 0, "%s: %d pixels", name, d.wrong_far);
        }
        image_free(&truth);
    }
    stage_close(&s);
}

/* --- many lights -------------------------------------------------------------------------------------------------- */

enum { MANY_CELLS = 16384 };

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Splits each light into `parts` within a millimetre of its place, and adds them as one slice. */
static void stream(stage *s, int parts)
{
    static lmb_light slice[100];
    const lmb_scene *scene = &s->loaded.scene;
    const lmb_vec3 low = {0, 0, 0}, high = {10, 4, 10};
    const size_t bytes = lmb_many_lights_bytes(MANY_CELLS);
    test_rng r = {5};
    s->many_lights_memory = take(bytes);
    CHECK(lmb_many_lights_init(&s->many_lights, MANY_CELLS, low, high, 100.0f, s->many_lights_memory, bytes) == LMB_OK);
    double spent = 0.0;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        for (int k = 0; k < parts; ++k) {
            slice[k] = scene->lights[i];
            for (int c = 0; c < 3; ++c) {
                slice[k].intensity[c] /= (float)parts;
            }
            if (parts > 1) {
                slice[k].position.x += test_uniform(&r, -0.0005f, 0.0005f);
                slice[k].position.y += test_uniform(&r, -0.0005f, 0.0005f);
                slice[k].position.z += test_uniform(&r, -0.0005f, 0.0005f);
            }
        }
        const double start = seconds();
        CHECK(lmb_many_lights_add(&s->many_lights, slice, (uint32_t)parts) == LMB_OK);
        spent += seconds() - start;
    }
    const double start = seconds();
    CHECK(lmb_many_lights_build(&s->many_lights) == LMB_OK && s->many_lights.dropped == 0);
    printf("  %-17s %7u lights, %5u cells, %.1f MB, %.0f ns a light and %.1f ms for the tree\n", s->name,
           (unsigned)s->many_lights.lights, (unsigned)s->many_lights.cell_count, (double)bytes * 1e-6,
           spent * 1e9 / (double)s->many_lights.lights, (seconds() - start) * 1e3);
}

/* Returns the number of shadow tests; 0 if the scene is missing. */
static double check_many(const char *name, int parts)
{
    stage s;
    image truth;
    metrics m;
    double tests = 0.0;
    if (!stage_load(&s, name, "pt_direct.pfm")) {
        return tests;
    }
    if (truth_picture(&truth, name, "pt_direct.pfm") && truth_picture(&s.depth, name, "pt_direct.pfm")) {
        const uint32_t triangles = lmb_scene_triangles(&s.loaded.scene);
        const size_t bytes = lmb_bvh_bytes(triangles);
        stream(&s, parts);
        s.loaded.scene.light_count = 0;
        take_frame(&s);
        s.bvh_memory = take(bytes);
        CHECK(lmb_bvh_init(&s.frame.bvh, triangles, s.bvh_memory, bytes) == LMB_OK);
        s.frame.many_lights = &s.many_lights;
        s.frame.shadow_map = 8;
        s.frame.occlusion = LMB_OCCLUSION_NONE;
        for (int i = 0; i < s.depth.width * s.depth.height; ++i) {
            s.depth.pixels[3 * i + 2] = 1.0f; /* a closed room: each pixel has a surface */
        }
        const double start = seconds();
        stage_draw(&s, LMB_SHOW_DIRECT);
        const double spent = seconds() - start;
        if (measure(&m, &s, &truth)) {
            tests = (double)s.frame.scratch->many_lights.tests;
            const metrics_input in = input_of(&s, &truth);
            const double worst = metrics_worst(&m, &in);
            printf("  %-17s rmse %.4f, trim %.4f, worst %.4f, mean %.4f, %.0f nodes and %.0f shadow tests a tile, "
                   "%.2f s\n",
                   name, m.rmse, m.trim, worst, m.mean, (double)s.frame.scratch->many_lights.nodes / 1024.0,
                   tests / 1024.0, spent);
            CHECK_MSG(m.rmse <= 0.015, "%s: rmse %g", name, m.rmse);
            CHECK_MSG(m.mean >= 0.99 && m.mean <= 1.01, "%s: mean %g", name, m.mean);
        }
        image_free(&truth);
    }
    stage_close(&s);
    return tests;
}

/* V3: 100 to 1,000,000 lights; the last case splits each of the 10,000 into a hundred, in the same memory and time. */
static void check_all_many(void)
{
    check_many("many_lights_100", 1);
    check_many("many_lights_1000", 1);
    const double once = check_many("many_lights_10000", 1), in_parts = check_many("many_lights_10000", 100);
    CHECK_MSG(in_parts <= 1.1 * once, "%g shadow tests for a million lights, %g for 10,000", in_parts, once);
}

/* --- one bounce --------------------------------------------------------------------------------------------------- */

/* V25, V27, V28: the indirect part of one bounce. */
static void check_indirect(const char *name, int barred)
{
    stage s;
    image truth;
    metrics m;
    if (!stage_open(&s, name, "pt_indirect1.pfm")) {
        return;
    }
    if (truth_picture(&s.depth, name, "gbuffer_depth.pfm") && truth_picture(&truth, name, "pt_indirect1.pfm")) {
        stage_draw(&s, LMB_SHOW_INDIRECT);
        if (measure(&m, &s, &truth)) {
            const metrics_input in = input_of(&s, &truth);
            const double worst = metrics_worst(&m, &in);
            printf("  %-15s trim %.4f, rmse %.4f, worst %.4f, e50 %.4f, e95 %.4f, mean %.4f, %u groups\n", name, m.trim,
                   m.rmse, worst, m.e50, m.e95, m.mean, (unsigned)s.stats.groups);
            CHECK_MSG(!barred || m.trim <= 0.25, "%s: trim %g", name, m.trim);
            CHECK_MSG(!barred || m.e50 <= 0.08, "%s: e50 %g", name, m.e50);
            CHECK_MSG(!barred || (m.mean >= 0.88 && m.mean <= 1.08), "%s: mean %g", name, m.mean);
            CHECK_MSG(s.stats.flux_grouped >= 0.999 * s.stats.flux_lit, "%s: %g of %g W", name, s.stats.flux_grouped,
                      s.stats.flux_lit);
            CHECK(m.nonfinite == 0);
        }
        image_free(&truth);
    }
    stage_close(&s);
}

/* --- cuts of the light tree ------------------------------------------------------------------------------------- */

/* Replaces groups by the tree of a map of `size` texels a side, and a BVH of all triangles. */
static void take_tree(stage *s, int32_t size, float error, float visibility)
{
    const lmb_scene *scene = &s->loaded.scene;
    lmb_frame *f = &s->frame;
    const uint32_t triangles = lmb_scene_triangles(scene);
    uint32_t faces = 0;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        faces += (uint32_t)lmb_shadow_map_faces(&scene->lights[i], scene);
    }
    const size_t tree = lmb_tree_bytes(faces, size), bvh = lmb_bvh_bytes(triangles);
    free(s->tree_memory);
    free(s->bvh_memory);
    s->tree_memory = take(tree);
    s->bvh_memory = take(bvh);
    CHECK(lmb_tree_init(&f->tree, faces, size, s->tree_memory, tree) == LMB_OK);
    CHECK(lmb_bvh_init(&f->bvh, triangles, s->bvh_memory, bvh) == LMB_OK);
    f->shadow_map = size;
    f->grouping.method = LMB_GROUP_CUT;
    f->occlusion = LMB_OCCLUSION_EXACT;
    f->error = error;
    f->visibility = visibility;
}

typedef struct cut_row {
    const char *name;
    int32_t map;
    float error, visibility;
    double trim, rmse, worst, leak; /* bounds; worst: metrics_worst; leak: maximum distance from 1, if any */
} cut_row;

/* V3, V25: one bounce by cuts with exact visibility. */
static void check_cut(const cut_row *row)
{
    stage s;
    image truth;
    metrics m;
    if (!stage_open(&s, row->name, "pt_indirect1.pfm")) {
        return;
    }
    if (truth_picture(&s.depth, row->name, "gbuffer_depth.pfm") &&
        truth_picture(&truth, row->name, "pt_indirect1.pfm")) {
        take_tree(&s, row->map, row->error, row->visibility);
        stage_draw(&s, LMB_SHOW_INDIRECT);
        if (measure(&m, &s, &truth)) {
            const metrics_input in = input_of(&s, &truth);
            const double worst = metrics_worst(&m, &in);
            printf("  %-15s map %d, error %.2f: trim %.4f, rmse %.4f, worst %.4f, e50 %.4f, mean %.4f, leak %.3f\n", row->name,
                   (int)row->map, (double)row->error, m.trim, m.rmse, worst, m.e50, m.mean, m.has_leak ? m.leak : 1.0);
            CHECK_MSG(m.trim <= row->trim, "%s: trim %g", row->name, m.trim);
            CHECK_MSG(m.rmse <= row->rmse, "%s: rmse %g", row->name, m.rmse);
            CHECK_MSG(worst <= row->worst, "%s: worst %g", row->name, worst);
            CHECK_MSG(fabs(m.mean - 1.0) <= 0.01, "%s: mean %g", row->name, m.mean);
            CHECK_MSG(!m.has_leak || fabs(m.leak - 1.0) <= row->leak, "%s: leak %g", row->name, m.leak);
            CHECK(m.nonfinite == 0);
        }
        image_free(&truth);
    }
    stage_close(&s);
}

/* One tile of SPARSE is tested. */
enum { SPARSE = 31 };

typedef struct cut_errors {
    float *of; /* one value a pixel: |cut - every texel| */
    double *want;
    int count;
    double all; /* texels x pixels */
} cut_errors;

static void tile_errors(cut_errors *e, stage *s, lmb_cut *cut, const texel_quad *quads, int quad_count)
{
    lmb_band_scratch *scratch = s->frame.scratch;
    const lmb_tile *tile = &scratch->tile;
    lmb_cut_params how;
    lmb_irradiance got;
    memset(&got, 0, sizeof got);
    memset(&how, 0, sizeof how);
    how.error = how.visibility = s->frame.conservative ? 0.02f : 0.01f;
    how.conservative = s->frame.conservative;
    how.stats = &s->stats;
    CHECK(lmb_gather_cut(&got, s->frame.kernels, cut, tile, &s->render->frame.tree, &how) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double want = 0.0;
        for (int i = 0; i < quad_count && tile->id[k] != 0; ++i) {
            want += texel_factor(&quads[i], tile, k) * (double)flux_sum(quads[i].n.flux);
        }
        if (tile->id[k] != 0) {
            e->of[e->count] = (float)fabs((double)got.rgb[0][k] + (double)got.rgb[1][k] + (double)got.rgb[2][k] - want);
            e->want[e->count++] = want;
        }
    }
    e->all += (double)quad_count * tile->hits;
}

static int by_size(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Relative to the light plus a thousandth of its mean, so that rounding in very dark pixels does not count. */
static float error_at(cut_errors *e, double share)
{
    double mean = 0.0;
    for (int i = 0; i < e->count; ++i) {
        mean += e->want[i] / e->count;
    }
    for (int i = 0; i < e->count; ++i) {
        e->of[i] = (float)((double)e->of[i] / (e->want[i] + 1e-3 * mean));
    }
    qsort(e->of, (size_t)e->count, sizeof *e->of, by_size);
    return e->of[(int)(share * (e->count - 1))];
}

/* V27: cuts without the BVH, from a map of 256 texels a side, against every texel, in one tile of 31. With the rule,
 * all but a thousandth of the pixels meet the error 0.01; with the conservative bound, all meet 0.02. */
static void check_cut_error(const char *name, int conservative, double most_share)
{
    stage s;
    cut_errors e = {NULL, NULL, 0, 0.0};
    lmb_cut *cut = take(sizeof *cut);
    if (stage_open(&s, name, "pt_indirect1.pfm")) {
        const lmb_view *v = &s.frame.view;
        const int32_t wide = v->frame_width / LMB_TILE, tiles = wide * (v->frame_height / LMB_TILE);
        take_tree(&s, 256, 0.01f, 0.02f);
        stage_draw(&s, LMB_SHOW_INDIRECT);
        const lmb_tree *tree = &s.render->frame.tree;
        texel_quad *quads = take(sizeof *quads * 65536u * tree->faces);
        const int quad_count = every_texel(quads, tree);
        s.frame.conservative = conservative;
        memset(&s.stats, 0, sizeof s.stats);
        e.of = take(sizeof *e.of * (size_t)tiles * LMB_TILE_PIXELS);
        e.want = take(sizeof *e.want * (size_t)tiles * LMB_TILE_PIXELS);
        for (int32_t t = SPARSE / 2; t < tiles; t += SPARSE) {
            CHECK(lmb_resolve_tile(&s.frame.scratch->tile, s.frame.kernels, v, s.frame.scene, &s.frame.eye,
                                   t % wide * LMB_TILE, t / wide * LMB_TILE) == LMB_OK);
            tile_errors(&e, &s, cut, quads, quad_count);
        }
        const double p999 = (double)error_at(&e, conservative ? 1.0 : 0.999), share = (double)s.stats.pairs / e.all;
        printf("  %-15s %s %.4f of %d pixels, by %.1f %% of the pairs\n", name, conservative ? "proved, most" : "p99.9",
               p999, e.count, share * 100.0);
        CHECK_MSG(p999 <= (conservative ? 0.02 : 0.01), "%s: %g", name, p999);
        CHECK_MSG(share <= most_share, "%s: %g", name, share);
        free(quads);
        stage_close(&s);
    }
    free(e.of);
    free(e.want);
    free(cut);
}

/* V30: the white furnace: rho I / (pi R2) and 1.5 times that, and the traced picture of the same mesh. */
static void check_furnace(void)
{
    static const struct row {
        int32_t show;
        const char *file;
        double want, bound;
    } rows[] = {{LMB_SHOW_DIRECT, "pt_direct.pfm", 0.159155, 0.004},
                {LMB_SHOW_FULL, "pt_one_bounce.pfm", 0.238732, 0.01}};
    stage s;
    image truth;
    if (!stage_open(&s, "furnace_sphere", "pt_direct.pfm")) {
        return;
    }
    for (int r = 0; r < COUNT(rows); ++r) {
        double off = 0.0, off_truth = 0.0, mean = 0.0;
        int n = s.drawn.width * s.drawn.height;
        stage_draw(&s, rows[r].show);
        if (!truth_picture(&truth, "furnace_sphere", rows[r].file)) {
            continue;
        }
        for (int i = 0; i < n; ++i) {
            double v = (double)s.drawn.pixels[3 * i];
            off = fmax(off, fabs(v / rows[r].want - 1.0));
            off_truth = fmax(off_truth, fabs(v / (double)truth.pixels[3 * i] - 1.0));
            mean += v / n;
        }
        printf("  furnace_sphere  mean %.6f, formula %.6f, worst pixel %.3f %%; of the traced picture %.3f %%\n", mean,
               rows[r].want, off * 100, off_truth * 100);
        CHECK_MSG(off < rows[r].bound && off_truth < rows[r].bound, "%g %g", off, off_truth);
        image_free(&truth);
    }
    stage_close(&s);
}

void test_truth(void)
{
    static const struct scene {
        const char *name;
        int direct, indirect; /* the bars apply */
    } scenes[] = {
#define TRUTH_SCENE(scene, direct, bounced, set) {#scene, direct, bounced},
#include "truth_scenes.inc"
#undef TRUTH_SCENE
    };
    /* The tool's default, and best. */
    static const cut_row cuts[] = {
        {"cornell", 256, 0.02f, 0.015f, 0.05, 0.08, 0.092, 0.3},
        {"corridor", 256, 0.02f, 0.015f, 0.05, 0.08, 0.121, 0.3},
        {"corner_contact", 256, 0.02f, 0.015f, 0.05, 0.08, 0.103, 0.3},
        {"corridor", 1024, 0.01f, 0.005f, 0.015, 0.04, 0.095, 0.1},
    };
    static const cut_row more_cuts[] = {
        {"cornell", 1024, 0.01f, 0.005f, 0.015, 0.04, 0.051, 0.1},
        {"corner_contact", 1024, 0.01f, 0.005f, 0.015, 0.08, 0.078, 0.3},
        {"bunny_room", 1024, 0.01f, 0.005f, 0.015, 0.04, 0.142, 0.1},
    };
    printf(" G-buffer\n");
    for (int i = 0; i < COUNT(scenes); ++i) {
        check_gbuffer(scenes[i].name);
    }
    printf(" direct light\n");
    for (int i = 0; i < COUNT(scenes); ++i) {
        check_direct(scenes[i].name, scenes[i].direct);
    }
    printf(" many lights\n");
    check_all_many();
    printf(" one bounce\n");
    for (int i = 0; i < COUNT(scenes); ++i) {
        if (scenes[i].indirect || getenv("LMB_TRUTH_ALL") != NULL) {
            check_indirect(scenes[i].name, scenes[i].indirect);
        }
    }
    check_furnace();
    printf(" one bounce by cuts\n");
    for (int i = 0; i < COUNT(cuts); ++i) {
        check_cut(&cuts[i]);
    }
    for (int i = 0; i < COUNT(more_cuts) && getenv("LMB_TRUTH_ALL") != NULL; ++i) {
        check_cut(&more_cuts[i]);
    }
    printf(" cuts against every texel\n");
    check_cut_error("cornell", 0, 0.05);
    for (int i = 0; i < COUNT(scenes) && getenv("LMB_TRUTH_ALL") != NULL; ++i) {
        check_cut_error(scenes[i].name, 0, strcmp(scenes[i].name, "sponza") == 0 ? 0.16 : 1.0);
        check_cut_error(scenes[i].name, 1, 1.0);
    }
}
