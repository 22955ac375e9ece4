/* verb_bench.c: `lambent-bench`: the raster workload, draws, the far gather, threads, hard cases, and sweeps. */
#include "verb_bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../common/io_file.h"
#include "../common/options.h"
#include "../hard/hard.h"
#include "../render/bench_calibrate.h"
#include "bench_draw.h"
#include "bench_gather.h"
#include "bench_hard.h"
#include "bench_operations.h"
#include "bench_peers.h"
#include "bench_rates.h"
#include "bench_scene.h"
#include "bench_shares.h"
#include "bench_threads.h"
#include "verb_bench_sweep.h"

enum { FRAMES_MAX = 100000, FRAMES_MIN = 8 };

enum { CASES = 32 };

typedef struct options {
    const char *folder, *peers, *html; /* NULL: not given */
    const lmb_kernels *kernels; /* NULL: not given */
    const char *cases[CASES];
    int32_t case_count, threads;
    int32_t group; /* of hard_groups; -1: all */
    int linear, plain, json, is_quiet, is_verbose;
    float seconds; /* per case */
} options;

/* One case's memory. */
typedef struct canvas {
    lmb_target target;
    lmb_surface out; /* data NULL: depth only */
    void *depth, *id, *rgba, *linear;
    void *own_depth, *own_id; /* allocations of depth and id */
    size_t linear_bytes;
    lmb_culling culling;
    void *farthest, *clusters;
} canvas;

/* Frame times, s. */
typedef struct timing {
    double cpu[FRAMES_MAX], wall[FRAMES_MAX];
    int count;
    double peak;    /* depths per second that the backend reads, tests and writes in cache */
    double bound;   /* minimum time of a frame, s; 0: the backend's rates are unknown */
    const char *by; /* the limiting unit */
} timing;

/* --- one frame ---------------------------------------------------------------------------------------------------- */

/* Stores the colours like radiance: sRGB-coded, tile by tile. */
static void store_colours(const canvas *c, const bench_scene *s, const lmb_kernels *kernels)
{
    static lmb_tile tile;
    static lmb_radiance radiance;
    for (int32_t y = 0; y < s->view.frame_height; y += LMB_TILE) {
        for (int32_t x = 0; x < s->view.frame_width; x += LMB_TILE) {
            lmb_resolve_albedo(&tile, kernels, &s->view, &s->scene, &c->target, x, y);
            if (tile.hits > 0) {
                memcpy(radiance.rgb, tile.albedo, sizeof radiance.rgb);
                lmb_store_tile(&c->out, kernels, 0, 0, &radiance, x, y, 0.0f);
            }
        }
    }
}

static void draw_ids(canvas *c, const bench_scene *s, const lmb_kernels *kernels, uint32_t flags)
{
    lmb_draw_culled(&c->target, kernels, &s->view, &s->scene, 1, s->mesh.triangle_count, flags, 1, &c->culling, NULL);
}

static void draw_frame(canvas *c, const bench_scene *s, const lmb_kernels *kernels, int cull)
{
    draw_ids(c, s, kernels, cull ? LMB_CULL_BACK : 0);
    if (c->id != NULL) {
        lmb_surface_clear(&c->out);
    }
    if (c->rgba != NULL) {
        store_colours(c, s, kernels);
    } else if (c->linear != NULL) {
        lmb_depth_linearize(c->linear, c->linear_bytes, &c->target.depth);
    }
}

/* --- one case ----------------------------------------------------------------------------------------------------- */

/* Surfaces are aligned to cache lines. Otherwise vectors as wide as a line would straddle two, which took a fifth
 * longer. */
enum { LINE = 64 };

static void *on_line(void *own)
{
    return own != NULL ? (uint8_t *)own + (LINE - (uintptr_t)own % LINE) % LINE : NULL;
}

static void canvas_free(canvas *c)
{
    free(c->own_depth);
    free(c->own_id);
    free(c->rgba);
    free(c->linear);
    free(c->farthest);
    free(c->clusters);
}

/* Makes the bounds, and the clusters when the case is loaded, outside the frame time. */
static int canvas_cull(canvas *c, const bench_scene *s)
{
    lmb_culling *culling = &c->culling;
    culling->tiles = lmb_culling_tiles(&c->target);
    culling->cluster_count = lmb_culling_clusters(&s->scene);
    culling->farthest = c->farthest = malloc(culling->tiles * sizeof(float));
    lmb_cluster *clusters = c->clusters = malloc(culling->cluster_count * sizeof *clusters);
    culling->clusters = clusters;
    return c->farthest != NULL && clusters != NULL &&
           lmb_clusters_build(clusters, culling->cluster_count, &s->scene) == LMB_OK;
}

static int canvas_make(canvas *c, const bench_case *k, const bench_scene *s, const options *o, report *r)
{
    const int colours = k->look != BENCH_DEPTH;
    const size_t pixels = (size_t)k->width * (size_t)k->height;
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, k->width, k->height),
                 id = lmb_surface_bytes(LMB_ID32, k->width, k->height);
    memset(c, 0, sizeof *c);
    c->own_depth = malloc(depth + LINE);
    c->own_id = colours ? malloc(id + LINE) : NULL;
    c->depth = on_line(c->own_depth);
    c->id = on_line(c->own_id);
    c->rgba = colours ? malloc(4 * pixels) : NULL;
    c->linear = o->linear ? malloc(4 * pixels) : NULL;
    c->linear_bytes = 4 * pixels;
    if (c->depth == NULL || (colours && (c->id == NULL || c->rgba == NULL)) || (o->linear && c->linear == NULL)) {
        canvas_free(c);
        return report_fail(r, "%s: out of memory", k->name);
    }
    lmb_surface_init(&c->target.depth, LMB_DEPTH32F, k->width, k->height, c->depth, depth);
    if (colours) {
        lmb_surface_init(&c->target.id, LMB_ID32, k->width, k->height, c->id, id);
        lmb_surface_init(&c->out, LMB_RGBA8, k->width, k->height, c->rgba, 4 * pixels);
    }
    if (!canvas_cull(c, s)) {
        canvas_free(c);
        return report_fail(r, "%s: out of memory", k->name);
    }
    return 1;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Depth-only cases, bounded by the processor's loads and stores. */
static int is_depth_fill(const bench_case *k) { return k->scene >= BENCH_FILL_PASS && k->look == BENCH_DEPTH; }

/* Sets the bound: the longest time that a frame keeps a unit, or loads and stores, busy. */
static void set_bound(timing *t, canvas *c, const bench_scene *s, const bench_rates *r, int cull)
{
    double counts[BENCH_OPS];
    int unit = 0;
    draw_frame(c, s, bench_operations_begin(), cull);
    const double depths = bench_operations_end(counts) / t->peak;
    t->bound = depths;
    t->by = "depth";
    const double busy = bench_rates_bound(&unit, r, counts) / r->backend->lanes * r->cycle;
    /* Compilers may or may not vectorize plain C lanes, so operations of plain C give no bound. */
    if (busy > depths && strcmp(r->backend->name, "scalar") != 0) {
        t->bound = busy;
        t->by = bench_op_names[unit];
    }
}

/* Draws two frames to warm up, then frames for the requested time, each timed separately. The processor's loops run
 * between them, so both see the same clock rate and load. */
static void measure(timing *t, canvas *c, const bench_scene *s, const options *o, int cull)
{
    bench_rates rates;
    const int rated = bench_rates_begin(&rates, lmb_kernels_name(o->kernels));
    draw_frame(c, s, o->kernels, cull);
    draw_frame(c, s, o->kernels, cull);
    const double end = host_seconds() + (double)o->seconds;
    t->count = 0;
    t->peak = t->bound = 0.0;
    while ((host_seconds() < end || t->count < FRAMES_MIN) && t->count < FRAMES_MAX) {
        const double wall = host_seconds(), cpu = host_cpu_seconds();
        draw_frame(c, s, o->kernels, cull);
        t->cpu[t->count] = host_cpu_seconds() - cpu;
        t->wall[t->count++] = host_seconds() - wall;
        if (rated) {
            t->peak = bench_rates_store(&rates);
            bench_rates_step(&rates);
        }
    }
    if (rated) {
        set_bound(t, c, s, &rates, cull);
    }
    qsort(t->cpu, (size_t)t->count, sizeof *t->cpu, by_value);
    qsort(t->wall, (size_t)t->count, sizeof *t->wall, by_value);
}

static void print_case(const bench_case *k, const bench_scene *s, const timing *t, const options *o)
{
    const unsigned triangles = s->mesh.triangle_count;
    const double min = t->cpu[0] * 1e3, middle = t->cpu[t->count / 2] * 1e3;
    const double wall = t->wall[0] * 1e3, wall_middle = t->wall[t->count / 2] * 1e3, each = min * 1e6 / triangles;
    const double pixels = (double)k->width * k->height * (triangles / 2) / t->cpu[0]; /* two triangles per layer */
    printf(o->json ? "{\"case\":\"%s\",\"triangles\":%u,\"cpu_min_ms\":%.4f,\"wall_min_ms\":%.4f,\"cpu_med_ms\":%.4f,"
                     "\"wall_med_ms\":%.4f,\"frames\":%d,\"ns_per_triangle\":%.2f,\"backend\":\"%s\""
                   : "lambent,%s,tris=%u,cpu_min_ms=%.4f,wall_min_ms=%.4f,cpu_med_ms=%.4f,wall_med_ms=%.4f,n=%d,"
                     "ns_per_tri=%.2f,backend=%s",
           k->name, triangles, min, wall, middle, wall_middle, t->count, each, lmb_kernels_name(o->kernels));
    if (is_depth_fill(k) && t->peak > 0.0) {
        printf(o->json ? ",\"pixels_per_s\":%.4g,\"peak\":%.4g" : ",pixels_per_s=%.4g,peak=%.4g", pixels, t->peak);
    }
    if (t->bound > 0.0) {
        printf(o->json ? ",\"bound_ms\":%.4f,\"by\":\"%s\",\"share\":%.4f" : ",bound_ms=%.4f,by=%s,share=%.4f",
               t->bound * 1e3, t->by, t->bound / t->cpu[0]);
    }
    puts(o->json ? "}" : "");
    fflush(stdout);
}

/* Runs the peers, and prints their times relative to ours. */
static int run_peers(bench_peers *p, const bench_case *k, const timing *t, const options *o, report *r)
{
    bench_peer_case *row = &p->row[p->count];
    row->name = k->name;
    row->own_ms = t->cpu[0] * 1e3;
    p->count += p->found.count > 0 && p->count < BENCH_PEER_CASES - 1;
    for (int i = 0; i < p->found.count; ++i) {
        double ms = 0.0;
        if (!bench_peers_run(&ms, p, i, k->name, r)) {
            return 0;
        }
        row->ms[i] = ms;
        if (!o->is_quiet && ms > 0.0) {
            printf(o->json ? "{\"peer\":\"%s\",\"case\":\"%s\",\"cpu_min_ms\":%.4f,\"times\":%.3f}\n"
                           : "%s,%s,cpu_min_ms=%.4f,times=%.3f\n",
                   p->found.name[i], k->name, ms, ms / (t->cpu[0] * 1e3));
            fflush(stdout);
        }
    }
    return 1;
}

static void keep_share(bench_shares *b, const bench_case *k, const timing *t)
{
    if (t->bound > 0.0 && b->count < BENCH_SHARES) {
        bench_share *s = &b->row[b->count++];
        s->name = k->name;
        s->by = t->by;
        s->ms = t->cpu[0] * 1e3;
        s->bound_ms = t->bound * 1e3;
    }
}

static int run_case(bench_shares *shares, const bench_case *k, bench_peers *peers, const options *o, report *r)
{
    static bench_scene s;
    static timing t;
    canvas c;
    if (o->folder == NULL && k->scene < BENCH_FILL_PASS) {
        return report_fail(r, "%s: where are bunny.mesh and sponza.mesh? Give --data FOLDER or set BENCH_DATA",
                           k->name);
    }
    if (!bench_scene_load(&s, k, o->folder, r)) {
        return 0;
    }
    int ok = canvas_make(&c, k, &s, o, r);
    if (ok) {
        measure(&t, &c, &s, o, k->cull);
        keep_share(shares, k, &t);
        if (!o->is_quiet) {
            print_case(k, &s, &t, o);
        }
        canvas_free(&c);
        ok = run_peers(peers, k, &t, o, r);
    }
    bench_scene_free(&s);
    return ok;
}

/* --- the command line --------------------------------------------------------------------------------------------- */

static int is_wanted(const bench_case *k, const options *o)
{
    for (int i = 0; i < o->case_count; ++i) {
        if (strstr(k->name, o->cases[i]) != NULL) {
            return 1;
        }
    }
    return o->case_count == 0;
}

static int wanted_count(const options *o)
{
    int count = 0;
    for (int i = 0; i < bench_case_count; ++i) {
        count += is_wanted(&bench_cases[i], o);
    }
    return count;
}

#define AT(member) .at = offsetof(options, member)
#define ROW_FOLDER(what)                                                                                      \
    {.name = "--data", .value = "FOLDER", .kind = OPTION_TEXT, AT(folder),                                    \
     .help = "of " what " (default: the environment's BENCH_DATA)"}
#define ROW_SECONDS(text)                                                                                     \
    {.name = "--seconds", .value = "S", .kind = OPTION_ABOVE, AT(seconds), .low = 0, .high = 9999, .help = text}
#define ROW_JSON {.name = "--json", .kind = OPTION_FLAG, AT(json), .help = "one object per line"}
#define ROW_LOUDNESS OPTION_LOUDNESS(options, is_quiet, is_verbose, "print the time it took")
#define END {.kind = OPTION_END}

static const option_row raster_rows[] = {
    {.name = "CASE", .kind = OPTION_TEXT, .value = "", AT(cases), .counts = offsetof(options, case_count),
     .times = CASES, .size = sizeof(const char *),
     .help = "part of a case's name (default: all)"},
    ROW_FOLDER("bunny.mesh and sponza.mesh"),
    OPTION_BACKEND_ROW(options, kernels),
    ROW_SECONDS("of each case (default 1.5)"),
    {.name = "--linear", .kind = OPTION_FLAG, AT(linear),
     .help = "also copies depth into plain rows, which other programs read"},
    {.name = "--peers", .value = "DIR", .kind = OPTION_TEXT, AT(peers),
     .help = "after each case runs every program of this folder on it, and prints the time and how many times our "
             "time that is; tools/README.md describes the output that such a program must print"},
    {.name = "--html", .value = "FILE.html", .kind = OPTION_TEXT, AT(html), .file = OPTION_WRITES,
     .help = "a page with each case's share of its bound as a bar"},
    ROW_JSON, ROW_LOUDNESS, OPTION_ASK, END,
};
static const option_row gather_rows[] = {
    OPTION_BACKEND_ROW(options, kernels),
    ROW_SECONDS("of each backend (default 1.5)"),
    ROW_JSON, ROW_LOUDNESS, OPTION_ASK, END,
};
static const option_row draw_rows[] = {
    {.name = "CASE", .kind = OPTION_TEXT, .value = "", AT(cases), .counts = offsetof(options, case_count),
     .times = CASES, .size = sizeof(const char *),
     .help = "part of a case's name (default: all)"},
    ROW_FOLDER("bunny.mesh and sponza.mesh; without it cases of these are left out"),
    OPTION_BACKEND_ROW(options, kernels),
    {.name = "--plain", .kind = OPTION_FLAG, AT(plain), .help = "without kernels, in plain C"},
    ROW_SECONDS("of each case (default 1)"),
    ROW_JSON, ROW_LOUDNESS, OPTION_ASK, END,
};
static const option_row threads_rows[] = {
    {.name = "--threads", .value = "N", .kind = OPTION_INT, AT(threads), .low = 2, .high = POOL_MAX,
     .help = "as many threads, and processes (default 2)"},
    ROW_FOLDER("bunny.mesh and sponza.mesh"),
    OPTION_BACKEND_ROW(options, kernels),
    ROW_SECONDS("of each case (default 4)"),
    ROW_LOUDNESS, OPTION_ASK, END,
};
static const option_row hard_rows[] = {
    {.name = "CASES", .kind = OPTION_WORD, .value = "", AT(group), .words = hard_groups,
     .help = "one group of cases (default: all)"},
    OPTION_BACKEND_ROW(options, kernels),
    ROW_JSON, ROW_LOUDNESS, OPTION_ASK, END,
};
static const option_row calibrate_rows[] = {
    {.name = "--threads", .value = "N", .kind = OPTION_INT, AT(threads), .low = 1, .high = POOL_MAX,
     .help = "that draw at once (default: the processors)"},
    OPTION_TIME_LIMIT, OPTION_ASK, END,
};
static const option_row bench_rows[] = {OPTION_ASK, END};

static int check_raster(const options *o, report *r)
{
    return wanted_count(o) > 0 || report_fail(r, "no case has `%s` in its name", o->cases[0]);
}

static int write_shares(const char *path, const bench_shares *b, report *r)
{
    text_buffer text;
    memset(&text, 0, sizeof text);
    bench_shares_html(&text, b);
    const int ok = text_buffer_write(&text, path, r);
    text_buffer_free(&text);
    return ok;
}

static int run_raster(const options *o, report *r)
{
    static bench_peers peers;
    bench_shares shares;
    memset(&shares, 0, sizeof shares);
    shares.backend = lmb_kernels_name(o->kernels);
    if (o->html != NULL && !file_can_write(o->html, r)) {
        return 0;
    }
    if (o->peers != NULL && !bench_peers_find(&peers, o->peers, o->folder, (double)o->seconds, r)) {
        return 0;
    }
    for (int i = 0; i < bench_case_count; ++i) {
        if (is_wanted(&bench_cases[i], o) && !run_case(&shares, &bench_cases[i], &peers, o, r)) {
            return 0;
        }
    }
    if (o->peers != NULL && !o->json && !o->is_quiet) {
        bench_peers_print(&peers);
    }
    return o->html == NULL || write_shares(o->html, &shares, r);
}

static int run_gather(const options *o, report *r)
{
    const gather_options gather = {o->kernels, (double)o->seconds, o->json, o->is_quiet};
    return bench_gather(&gather, r);
}

static draw_options draw_of(const options *o)
{
    const draw_options draw = {o->cases, (int)o->case_count, o->folder, o->plain ? NULL : o->kernels,
                               (double)o->seconds, o->json, o->is_quiet};
    return draw;
}

static int check_draw(const options *o, report *r)
{
    const draw_options draw = draw_of(o);
    return bench_draw_is_wanted(&draw) || report_fail(r, "no case has `%s` in its name", o->cases[0]);
}

static int run_draw(const options *o, report *r)
{
    const draw_options draw = draw_of(o);
    return bench_draw(&draw, r);
}

static int run_threads(const options *o, report *r)
{
    const threads_options threads = {o->folder, o->kernels, (int)o->threads, (double)o->seconds, o->is_quiet};
    return bench_threads(&threads, r);
}

static int run_hard(const options *o, report *r)
{
    const hard_options hard = {o->kernels, (int)o->group, o->json, o->is_quiet};
    return bench_hard(&hard, r);
}

static int run_calibrate(const options *o, report *r)
{
    const int threads = o->threads > 0 ? (int)o->threads : pool_processors();
    const double rate = bench_calibrate(threads);
    if (!(rate > 0.0)) {
        return report_fail(r, "no memory to draw the built-in room");
    }
    printf("%.4g units of work a second, threads: %d   (for plan and render: --budget rate=%.4g)\n", rate, threads,
           rate);
    return 1;
}

/* The workloads with separate command lines, and their defaults. */
static const struct workload {
    const char *name;
    int (*check)(const options *o, report *r); /* returns 0 with `r` set for bad usage; NULL: nothing to check */
    int (*run)(const options *o, report *r);
    int32_t threads;
    float seconds;
    int picks; /* use one backend by default; else all in turn */
    option_table table;
} workloads[] = {
    {"raster",
     check_raster,
     run_raster,
     0,
     1.5f,
     1,
     {.verb = "raster",
      .usage = "raster [CASE...] [options]",
      .about = "Draws the fixed raster workload on one thread and prints one line per case: the minimum and the "
             "median time of a frame (clear, draw, and for gouraud and tex cases colours into RGBA8), and `share` = "
             "bound / minimum time. The bound is the best that the same run finds the machine can do with the "
             "frame's own work, which is counted by drawing it once with verbs that count: the longest (`by`) of "
             "the time for reading, testing and writing the frame's depths in 16 KiB of cache (`depth`), and the "
             "times for which its multiplications, additions, maxima, divisions, comparisons and picks keep one "
             "unit busy (`mul`, `add`, `max`, `div`; as for gather). All of it as if every lane were used; "
             "integers, doubles, loads, masks, branches, clearing, and reading the mesh and textures count as "
             "nothing. In plain C, whose lanes compilers join as they like, only depths count. fill-depth cases "
             "also print pixels per second and `peak`, the depths per second of the bound.",
      .part = {raster_rows},
      .examples = "  lambent-bench raster fill-depth --seconds 0.1\n"}},
    {"gather",
     NULL,
     run_gather,
     0,
     1.5f,
     0,
     {.verb = "gather",
      .usage = "gather [options]",
      .about = "Times the far gather without occlusion, all groups lighting all pixels; a pair is one pixel with "
             "one group. Prints one line per backend: pairs per second, cycles per pair, and `share` = bound / "
             "cycles. The bound is the best that the same run finds the machine can do with the kernel's own "
             "operations (`ops_per_vector`, counted by running it with verbs that count): each operation is timed "
             "by itself in registers (`cycles_per_op`), and for its load on a unit that multiplications, additions, "
             "maxima or divisions keep busy. The most loaded unit's time is the bound (`unit`, `load_per_op`). "
             "Loads, stores, masks, branches and waiting for results count as nothing. A cycle is that of a chain "
             "of integer operations.",
      .part = {gather_rows},
      .examples = "  lambent-bench gather --seconds 0.1\n"}},
    {"draw",
     check_draw,
     run_draw,
     0,
     1.0f,
     1,
     {.verb = "draw",
      .usage = "draw [CASE...] [options]",
      .about = "Draws cases of lambent/draw.h on one thread, at 640 x 480, and prints one line per case: its name, "
             "a description, and the shortest processor time of a frame. Frames of meshes, sprites, particles, "
             "lines and shadows begin with a clear of colours and depth. For `clear`, `fill` and `glass`, the line "
             "also has the time of storing each pixel once (memset) in the same run, and that as a share of the "
             "frame's.",
      .part = {draw_rows},
      .examples = "  lambent-bench draw fill --seconds 0.1\n"}},
    {"threads",
     NULL,
     run_threads,
     2,
     4.0f,
     1,
     {.verb = "threads",
      .usage = "threads [options]",
      .about = "Times the gather of the built-in scene, and 2048 x 2048 depths and ids of the workload's meshes by "
             "strips of rows and by bins, on one thread, on N threads, and in N processes at once, in turn. `of "
             "processes` is the speed-up of threads relative to that of processes: 100 % is all that this machine "
             "gives.",
      .part = {threads_rows},
      .examples = "  with a folder that holds bunny.mesh and sponza.mesh:\n"
                  "    [ ! -e data/sponza.mesh ] || lambent-bench threads --data data --seconds 1\n",
      .status = "exit status: 0 done, 1 a file that cannot be read or no processes to be had, 2 bad usage"}},
    {"hard",
     NULL,
     run_hard,
     0,
     0.0f,
     1,
     {.verb = "hard",
      .usage = "hard [CASES] [options]",
      .about = "Tests cases that renderers get wrong: prints one line per case, with a figure and its upper bound. "
             "`exact` is 0 by design, `bounded` is limited by arithmetic or a formula, `measured` is compared with "
             "rays, sums and closed forms in double, with a bound slightly above the figure found. A few seconds.",
      .part = {hard_rows},
      .examples = "  lambent-bench hard raster\n",
      .status = "exit status: 0 done, 1 a figure past its bound, 2 bad usage"}},
    {"--calibrate",
     NULL,
     run_calibrate,
     0,
     0.0f,
     0,
     {.verb = "--calibrate",
      .usage = "--calibrate [--threads N]",
      .about = "Measures units of work per second, which --budget ms needs: draws the built-in room a few times.",
      .part = {calibrate_rows},
      .examples = "  lambent-bench --calibrate --threads 1\n"}},
};

static const option_table bench_table = {
    .verb = "",
    .usage = "SCENE|relight|relief|mix ...  speed against error\n"
             "raster [CASE...] [options]    speed of drawing the fixed workload\n"
             "draw [CASE...] [options]      speed of drawing 2D, lines, blends\n"
             "gather [options]              speed of lighting pixels by groups\n"
             "threads [options]             speed-up of threads, compared with processes\n"
             "hard [CASES] [options]        cases that renderers get wrong\n"
             "--calibrate [--threads N]     units of work per second\n"
             "merge SLICE... -o OUT         join slices of a sweep",
    .about =
        "Measures speed and errors. Each has its own --help: lambent-bench raster --help; lambent-bench demo --help is "
        "that of SCENE.",
    .part = {bench_rows},
    .examples = "  lambent-bench raster fill-depth --seconds 0.1\n"
                "  lambent-bench demo --size 24x16 --runs 1 --sweep tree=16,32 --breakdown 0\n",
};

static int measure_workload(const struct workload *w, int argc, char **argv)
{
    const char *folder = getenv("BENCH_DATA");
    options o;
    report r = {""};
    memset(&o, 0, sizeof o);
    o.group = -1;
    o.folder = folder != NULL && folder[0] != '\0' ? folder : NULL;
    o.threads = w->threads;
    o.seconds = w->seconds;
    o.kernels = w->picks ? lmb_kernels_pick() : NULL;
    int asked = options_parse(&o, &w->table, argc, argv, &r);
    if (asked == OPTIONS_RUN && w->check != NULL && !w->check(&o, &r)) {
        asked = OPTIONS_BAD;
    }
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &w->table, &r);
    }
    const double start = host_seconds();
    const int ok = w->run(&o, &r);
    report_note(!o.is_verbose, "%s took %.1f s", w->table.verb, host_seconds() - start);
    return ok ? 0 : report_end(&r, w->table.verb, 1);
}

/* The name of a workload or subject that is similar to the word, unless the word is a file. */
static const char *meant_by(const char *word)
{
    static const char *const names[] = {"raster",  "draw",   "gather", "threads", "hard",
                                        "relight", "relief", "mix",    NULL};
    const char *meant = options_nearest(names, word);
    FILE *file = meant != NULL && strcmp(meant, word) != 0 ? fopen(word, "rb") : NULL;
    if (file != NULL) {
        fclose(file);
        return NULL;
    }
    return meant != NULL && strcmp(meant, word) != 0 ? meant : NULL;
}

int verb_bench(int argc, char **argv)
{
    report r = {""};
    for (size_t i = 0; argc > 1 && i < sizeof workloads / sizeof *workloads; ++i) {
        if (strcmp(argv[1], workloads[i].name) == 0) {
            return measure_workload(&workloads[i], argc - 1, argv + 1);
        }
    }
    if (argc > 1 && (argv[1][0] != '-' || argv[1][1] == '\0')) {
        const char *meant = meant_by(argv[1]);
        if (meant == NULL) {
            return verb_bench_sweep(argc, argv);
        }
        report_fail(&r, "there is no file `%s`; did you mean lambent-bench %s?", argv[1], meant);
        return report_end(&r, "", 2);
    }
    int asked = options_parse(NULL, &bench_table, argc, argv, &r);
    if (asked == OPTIONS_RUN) {
        asked = report_fail(&r, "what is to be measured? A scene, raster, draw, gather, threads, hard; see --help");
    }
    return options_answer(asked, &bench_table, &r);
}
