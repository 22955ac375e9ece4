/* main_cuts.c: compares each preset's cut with brute force, which uses every lit texel of a 1024 x 1024 map for every
 * pixel, on some tiles of truth scenes. [V27]
 *
 *     measure-cuts [STEP [SCENE...]] every STEP-th tile in reading order (default 17, which no row of tiles is a
 *                                    multiple of); cornell and sponza
 *
 * Brute force is a strong baseline: texels that face away are culled, a tile's pixels test 64 segments at once, and
 * kernels process the visible pairs. `pairs` counts pixels x lit texels for brute force, and pixels x visible nodes for
 * a cut; `seen` counts mutually visible pairs for both. Seconds are those of one core for the chosen tiles, without the
 * map. `added` is the cut's trim against truth minus that of brute force; `from brute` is its trim against brute force.
 * Default and best pass with 1/100 of the pairs and at most 0.02 added. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <lambent/lambent.h>

#include "../../src/lane/kernels.h"
#include "../../src/raster/tile.h"
#include "../../tools/picture/metrics.h"
#include "../every_texel.h"
#include "../truth_scene.h"

int test_passed, test_failed, test_skipped;

enum { MAP = 1024, STEP = 17 };

static const struct preset {
    const char *name;
    int32_t quality;
    int has_bars;
} presets[] = {{"draft", LMB_QUALITY_DRAFT, 0}, {"default", LMB_QUALITY_DEFAULT, 1}, {"best", LMB_QUALITY_BEST, 1}};

typedef struct counts {
    double pairs, seen, segments, seconds;
} counts;

typedef struct work {
    const char *scene;
    model loaded;
    lmb_frame frame;
    lmb_render render;
    lmb_band_scratch scratch;
    image truth, surface; /* surface: depth of the truth, cleared outside the chosen tiles */
    float *brute, *cut;   /* radiance, three a pixel */
    texel_quad *texel;
    int texels, step;
    void *memory[8]; /* all allocations */
    int taken;
} work;

static void *take(work *w, size_t bytes)
{
    void *p = calloc(1, bytes);
    if (p == NULL) {
        printf("not enough memory\n");
        exit(1);
    }
    return w->memory[w->taken++] = p;
}

static double seconds_now(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* --- a scene ------------------------------------------------------------------------------------------------------ */

static int load(work *w)
{
    return truth_scene(&w->loaded, &w->truth, &w->surface, w->scene);
}

static void set_frame(work *w)
{
    lmb_frame *f = &w->frame;
    const lmb_scene *scene = &w->loaded.scene;
    const int32_t width = w->truth.width, height = w->truth.height;
    const uint32_t triangles = lmb_scene_triangles(scene);
    uint32_t faces = 0;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        const int32_t own = lmb_shadow_map_faces(&scene->lights[i], scene);
        f->map_bytes += lmb_shadow_map_bytes(own, MAP, LMB_ID32);
        faces += (uint32_t)own;
    }
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, width, height),
                 id = lmb_surface_bytes(LMB_ID32, width, height), tree = lmb_tree_bytes(faces, MAP),
                 bvh = lmb_bvh_bytes(triangles),
                 pixels = (size_t)width * (size_t)height * 3 * sizeof(float);
    f->kernels = lmb_kernels_pick();
    f->scene = scene;
    truth_view(&f->view, &w->loaded.cameras[0], &w->truth);
    f->show = LMB_SHOW_INDIRECT;
    f->shadow_map = MAP;
    f->grouping.method = LMB_GROUP_CUT;
    f->occlusion = LMB_OCCLUSION_EXACT;
    f->map_memory = take(w, f->map_bytes);
    f->scratch = &w->scratch;
    w->brute = take(w, pixels);
    w->cut = take(w, pixels);
    CHECK(lmb_tree_init(&f->tree, faces, MAP, take(w, tree), tree) == LMB_OK);
    CHECK(lmb_bvh_init(&f->bvh, triangles, take(w, bvh), bvh) == LMB_OK);
    CHECK(lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, width, height, take(w, depth), depth) == LMB_OK);
    CHECK(lmb_surface_init(&f->eye.id, LMB_ID32, width, height, take(w, id), id) == LMB_OK);
    CHECK(lmb_surface_init(&f->out, LMB_RGB32F, width, height, w->cut, pixels) == LMB_OK);
}

/* Builds the light tree and the view. */
static int solve(work *w)
{
    lmb_status status = lmb_render_begin(&w->render, &w->frame);
    for (; status == LMB_OK || status == LMB_MORE; status = lmb_render_step(&w->render, 1)) {
        if (w->render.stage == LMB_STAGE_BANDS) {
            w->texel = take(w, (size_t)MAP * MAP * w->render.frame.tree.faces * sizeof *w->texel);
            w->texels = every_texel(w->texel, &w->render.frame.tree);
            return 1;
        }
    }
    CHECK_MSG(0, "%s: %s", w->scene, lmb_status_name(status));
    return 0;
}

static void close_scene(work *w)
{
    while (w->taken > 0) {
        free(w->memory[--w->taken]);
    }
    truth_scene_free(&w->loaded, &w->truth, &w->surface);
}

/* --- a tile by brute force ---------------------------------------------------------------------------------------- */

/* A tile's box, and emitters that are queued for the kernel. */
typedef struct gatherer {
    const work *w;
    const lmb_tile *tile;
    lmb_irradiance *light;
    lmb_vec3 middle, half;
    uint64_t pixels;
    lmb_traversal traversal;
    lmb_emitter *emitter;
    float (*memory)[LMB_GATHER_PAIRS];
    int32_t waiting;
} gatherer;

static void flush(gatherer *g)
{
    g->w->frame.kernels->gather_cut(g->light, g->memory, g->tile, g->emitter, g->waiting);
    g->waiting = 0;
}

static float gap(float apart, float half) { return absf(apart) > half ? absf(apart) - half : 0.0f; }

/* Returns whether the texel's shape matters for some pixel. */
static int is_near(const gatherer *g, const texel_quad *q)
{
    const lmb_vec3 to = sub3(q->n.centre, g->middle);
    const lmb_vec3 apart = vec3(gap(to.x, g->half.x), gap(to.y, g->half.y), gap(to.z, g->half.z));
    return dot3(apart, apart) < q->near2;
}

/* Returns the pixels that lie in front of the texel and face it. */
static uint64_t facing(const gatherer *g, const texel_quad *q)
{
    uint64_t out = 0;
    for (uint64_t bits = g->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 to = sub3(q->n.centre, tile_vec(g->tile->position, k));
        const int faces = dot3(tile_vec(g->tile->normal, k), to) > 0.0f && dot3(q->n.normal, to) < 0.0f;
        out |= (uint64_t)faces << k;
    }
    return out;
}

static void add_near(const gatherer *g, const texel_quad *q, uint64_t seen)
{
    for (uint64_t bits = seen; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const double f = texel_factor(q, g->tile, k);
        for (int c = 0; c < 3; ++c) {
            g->light->rgb[c][k] += (float)(f * (double)q->n.flux[c]);
        }
    }
}

static void add_far(gatherer *g, const texel_quad *q, uint64_t seen)
{
    lmb_emitter *e = &g->emitter[g->waiting++];
    e->position = q->n.centre;
    e->back = mul3(q->n.normal, -1.0f);
    e->area_pi = q->n.area * 0.31830989f;
    memcpy(e->flux, q->n.flux, sizeof e->flux);
    e->visible = seen;
    if (g->waiting == LMB_CUT_BLOCK) {
        flush(g);
    }
}

static void gather_brute(lmb_irradiance *light, work *w, const lmb_tile *tile, counts *sum)
{
    lmb_vec3 low, high;
    gatherer g;
    memset(&g, 0, sizeof g);
    g.w = w;
    g.tile = tile;
    g.light = light;
    g.pixels = tile_pixels(tile);
    g.emitter = w->scratch.gather.cut.with.nodes.emitter;
    g.memory = w->scratch.gather.cut.use.pairs;
    tile_box(&low, &high, tile, g.pixels);
    g.middle = mul3(add3(low, high), 0.5f);
    g.half = mul3(sub3(high, low), 0.5f);
    for (int i = 0; i < w->texels; ++i) {
        const texel_quad *q = &w->texel[i];
        const int near = is_near(&g, q);
        const uint64_t asked = near ? g.pixels : facing(&g, q);
        const uint64_t seen =
            asked & ~lmb_occluded_tile(w->frame.kernels, &g.traversal, &w->render.frame.bvh, tile, asked, q->middle,
                                       lmb_tile_noise(tile, asked) + lmb_place_noise(q->middle, 0.0f));
        sum->segments += count_bits_64(asked);
        sum->seen += count_bits_64(seen);
        if (near) {
            add_near(&g, q, seen);
        } else if (seen != 0) {
            add_far(&g, q, seen);
        }
    }
    flush(&g);
    sum->pairs += (double)count_bits_64(g.pixels) * w->texels;
}

/* --- the chosen tiles --------------------------------------------------------------------------------------------- */

static void gather_cut(lmb_irradiance *light, work *w, const lmb_tile *tile, const lmb_frame *how, counts *sum)
{
    lmb_stats stats;
    lmb_cut_params cut_params;
    memset(&stats, 0, sizeof stats);
    memset(&cut_params, 0, sizeof cut_params);
    cut_params.error = how->error;
    cut_params.visibility = how->visibility;
    cut_params.bvh = &w->render.frame.bvh;
    cut_params.stats = &stats;
    CHECK(lmb_gather_cut(light, w->frame.kernels, &w->scratch.gather.cut, tile, &w->render.frame.tree, &cut_params) ==
          LMB_OK);
    sum->pairs += (double)stats.pairs;
    sum->seen += (double)stats.pairs;
    sum->segments += (double)stats.segments;
}

static void store(float *out, const work *w, const lmb_irradiance *light, int32_t x0, int32_t y0)
{
    lmb_surface to = w->frame.out;
    lmb_radiance radiance;
    to.data = (uint8_t *)out;
    CHECK(lmb_compose_tile(&radiance, w->frame.kernels, &w->scratch.tile, NULL, light) == LMB_OK);
    CHECK(lmb_store_tile(&to, w->frame.kernels, 0, 0, &radiance, x0, y0, 0.0f) == LMB_OK);
}

/* Gathers by a cut; if `how` is NULL, by brute force. */
static counts gather_tiles(work *w, float *out, const lmb_frame *how)
{
    const lmb_view *v = &w->frame.view;
    const int32_t across = (v->frame_width + LMB_TILE - 1) / LMB_TILE,
                  down = (v->frame_height + LMB_TILE - 1) / LMB_TILE;
    counts sum = {0, 0, 0, 0};
    for (int32_t i = 0; i < across * down; i += w->step) {
        const int32_t x = i % across * LMB_TILE, y = i / across * LMB_TILE;
        lmb_irradiance light;
        memset(&light, 0, sizeof light);
        CHECK(lmb_resolve_tile(&w->scratch.tile, w->frame.kernels, v, w->frame.scene, &w->frame.eye, x, y) == LMB_OK);
        const double start = seconds_now();
        if (how == NULL) {
            gather_brute(&light, w, &w->scratch.tile, &sum);
        } else {
            gather_cut(&light, w, &w->scratch.tile, how, &sum);
        }
        sum.seconds += seconds_now() - start;
        store(out, w, &light, x, y);
    }
    return sum;
}

/* Excludes all other pixels from the figures. */
static void mask_others(work *w)
{
    const int32_t across = (w->truth.width + LMB_TILE - 1) / LMB_TILE;
    for (int32_t i = 0; i < w->truth.width * w->truth.height; ++i) {
        const int32_t x = i % w->truth.width, y = i / w->truth.width;
        float *mark = &w->surface.pixels[3 * i + 2];
        *mark = (y / LMB_TILE * across + x / LMB_TILE) % w->step == 0 ? *mark : 0.0f;
    }
}

static double trim_of(const work *w, const float *test, const float *truth)
{
    metrics_input in;
    metrics m;
    report r = {""};
    memset(&in, 0, sizeof in);
    memset(&m, 0, sizeof m);
    in.test = test;
    in.truth = truth;
    in.surface = w->surface.pixels;
    in.width = w->truth.width;
    in.height = w->truth.height;
    in.channels = 3;
    CHECK_MSG(metrics_measure(&m, &in, &r), "%s: %s", w->scene, r.text);
    return m.trim;
}

static void tell(const work *w, const char *name, const counts *sum, double trim)
{
    printf("| %s | %s | %.0f | %.0f | %.0f | %.3f | %.4f |", w->scene, name, sum->pairs, sum->seen, sum->segments,
           sum->seconds, trim);
}

/* The error and visibility limits of a quality, from lmb_frame_init. */
static lmb_frame frame_of(const work *w, int32_t quality)
{
    lmb_frame_settings s;
    lmb_frame f;
    memset(&s, 0, sizeof s);
    s.kernels = w->frame.kernels;
    s.scene = w->frame.scene;
    s.view = w->frame.view;
    s.quality = quality;
    void *memory = malloc(lmb_frame_bytes(&s));
    CHECK(lmb_frame_init(&f, &s, memory, lmb_frame_bytes(&s)) == LMB_OK);
    free(memory);
    return f;
}

static void tell_cut(work *w, const struct preset *p, const counts *brute, double brute_trim)
{
    const lmb_frame how = frame_of(w, p->quality);
    const counts cut = gather_tiles(w, w->cut, &how);
    const double added = trim_of(w, w->cut, w->truth.pixels) - brute_trim;
    tell(w, p->name, &cut, brute_trim + added);
    printf(" %+.4f | %.4f | %.0f | %.0f |\n", added, trim_of(w, w->cut, w->brute), brute->pairs / cut.pairs,
           brute->seconds / cut.seconds);
    CHECK_MSG(!p->has_bars || (cut.pairs * 100.0 <= brute->pairs && added <= 0.02), "%s, %s", w->scene, p->name);
}

static void run(work *w)
{
    if (load(w)) {
        set_frame(w);
        if (solve(w)) {
            mask_others(w);
            const counts brute = gather_tiles(w, w->brute, NULL);
            const double trim = trim_of(w, w->brute, w->truth.pixels);
            tell(w, "brute force", &brute, trim);
            printf(" | | | |\n");
            for (size_t i = 0; i < sizeof presets / sizeof *presets; ++i) {
                tell_cut(w, &presets[i], &brute, trim);
                fflush(stdout);
            }
        }
    }
    close_scene(w);
}

int main(int argc, char **argv)
{
    static const char *const usual[] = {"cornell", "sponza"};
    static work w;
    const int scenes = argc > 2 ? argc - 2 : 2, step = argc > 1 ? atoi(argv[1]) : STEP;
    printf("| scene | by | pairs | seen | segments | s | trim | added | from brute | pairs saved | time saved |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < scenes && step > 0; ++i) {
        memset(&w, 0, sizeof w);
        w.scene = argc > 2 ? argv[i + 2] : usual[i];
        w.step = step;
        run(&w);
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0 || step <= 0;
}
