/* verb_bench.c: `lambent bench`: the raster workload, the far gather, threads, hard cases; all else is swept. */
#include "verb_bench.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../platform/host/host.h"
#include "../platform/host/pool.h"
#include "bench_calibrate.h"
#include "bench_gather.h"
#include "bench_hard.h"
#include "bench_operations.h"
#include "bench_rates.h"
#include "bench_scene.h"
#include "bench_threads.h"
#include "verb_bench_sweep.h"

static const char help_text[] =
    "usage: lambent bench SCENE|relight|relief|mix ...      speed against error; see lambent bench SCENE --help\n"
    "       lambent bench raster [CASE...] [--data FOLDER] [--backend NAME] [--seconds S] [--linear] [--json]\n"
    "       lambent bench gather [--backend NAME] [--seconds S] [--json]\n"
    "       lambent bench threads [--threads N] [--data FOLDER] [--backend NAME] [--seconds S]\n"
    "       lambent bench hard [ROOM] [--backend NAME] [--json]\n"
    "       lambent bench --calibrate [--threads N]   units of work a second, by which --budget-ms reckons\n"
    "\n"
    "raster: draws the fixed raster workload on one thread and prints a line a case: the least and the median\n"
    "time of a frame (clear, draw, and for gouraud and tex cases colours into RGBA8), and `share` = bound /\n"
    "least time. A CASE is part of a case's name; without one, all. The bound is what the same run finds the\n"
    "machine can do at most with the frame's own work, which is counted by drawing it once over verbs that\n"
    "count: the longest (`by`) of the time that reading, testing and writing the frame's depths takes in 16 KiB\n"
    "of cache (`depth`), and the times that its multiplications, additions, maxima, divisions, comparisons and\n"
    "picks keep one unit busy (`mul`, `add`, `max`, `div`; as for gather). All of it as if every lane were of\n"
    "use; integers, doubles, loads, masks, branches, clearing, and reading the mesh and textures count as\n"
    "nothing; of plain C, whose lanes compilers join as they like, only depths count. fill-depth cases also tell\n"
    "pixels a second and `peak`, the depths a second that the bound is of.\n"
    "\n"
    "gather: the far gather without occlusion, all groups lighting all pixels; a pair is one pixel with one\n"
    "group. Prints a line a back end: pairs a second, cycles a pair, and `share` = bound / cycles. The bound is\n"
    "what the same run finds the machine can do with the kernel's own operations (`ops_per_vector`, counted by\n"
    "running it over verbs that count): each operation is timed in registers alone (`cycles_per_op`), and for\n"
    "what it adds to a unit that multiplications, additions, maxima or divisions keep busy. The most loaded\n"
    "unit's time is the bound (`unit`, `load_per_op`). Loads, stores, masks, branches and waiting for results\n"
    "count as nothing. A cycle is that of a chain of integer operations.\n"
    "\n"
    "threads: the gather of the built-in scene and 2048 x 2048 maps of sponza's light on one thread, on N\n"
    "threads, and in N processes at once, in turn. `of processes` is what the threads gain over what the\n"
    "processes do: 100 % is all that this machine gives.\n"
    "\n"
    "hard: what renderers get wrong, tried here: a line a case, with its figure and what that may be at most.\n"
    "`exact` is 0 by design, `bounded` by arithmetic or a formula, `measured` against rays, sums and closed forms\n"
    "in double, whose bound lies a little over what was found. A ROOM is raster, shadow, bounce, probe, relief,\n"
    "mixed or all. A few seconds; exit status 1 where a figure is past its bound.\n"
    "\n"
    "  --data FOLDER    of bunny.mesh and sponza.mesh (default: the environment's BENCH_DATA)\n"
    "  --backend NAME   scalar, sse2, avx2, avx512, neon, simd128 (default: this machine's best; gather: all)\n"
    "  --seconds S      of each case, or back end (default: 1.5; threads: 4)\n"
    "  --threads N      2 .. 64 (default: 2)\n"
    "  --linear         with depth copied into plain rows, which other programs read\n"
    "  --json           one object a line\n"
    "\n"
    "exit status: 0 done, 1 a file that cannot be read or no processes to be had, 2 bad usage\n";

enum { FRAMES_MAX = 100000, FRAMES_MIN = 8 };

enum { RASTER, GATHER, THREADS, HARD, NOTHING };

typedef struct options {
    const char *folder;
    const lmb_kernels *kernels; /* NULL: all in turn */
    const char *const *cases;
    int case_count, what, threads, linear, json, help;
    double seconds; /* 0: as is usual */
} options;

/* One case's memory. */
typedef struct canvas {
    lmb_target target;
    lmb_surface out; /* data NULL: depth only */
    void *depth, *id, *rgba, *linear;
    size_t linear_bytes;
} canvas;

/* Times of frames, s. */
typedef struct timing {
    double cpu[FRAMES_MAX], wall[FRAMES_MAX];
    int count;
    double peak;    /* depths that the back end reads, tests and writes in a second, in cache */
    double bound;   /* least time of a frame, s; 0: the back end's rates are not known */
    const char *by; /* what takes it */
} timing;

/* --- one frame ---------------------------------------------------------------------------------------------------- */

/* The colours go out as radiance does: sRGB-coded, tile by tile. */
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

static void draw_frame(const canvas *c, const bench_scene *s, const lmb_kernels *kernels, int cull)
{
    lmb_surface_clear(&c->target.depth);
    if (c->id != NULL) {
        lmb_surface_clear(&c->target.id);
        lmb_surface_clear(&c->out);
    }
    lmb_draw(&c->target, kernels, &s->view, &s->scene, 1, s->mesh.triangle_count, cull ? LMB_CULL_BACK : 0, NULL);
    if (c->rgba != NULL) {
        store_colours(c, s, kernels);
    } else if (c->linear != NULL) {
        lmb_depth_linearize(c->linear, c->linear_bytes, &c->target.depth);
    }
}

/* --- one case ----------------------------------------------------------------------------------------------------- */

static void canvas_free(canvas *c)
{
    free(c->depth);
    free(c->id);
    free(c->rgba);
    free(c->linear);
}

static int canvas_make(canvas *c, const bench_case *k, const options *o, report *r)
{
    const int colours = k->look != BENCH_DEPTH;
    const size_t pixels = (size_t)k->width * (size_t)k->height;
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, k->width, k->height),
                 id = lmb_surface_bytes(LMB_ID32, k->width, k->height);
    memset(c, 0, sizeof *c);
    c->depth = malloc(depth);
    c->id = colours ? malloc(id) : NULL;
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
    return 1;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Nothing but depths: what a machine's loads and stores bound. */
static int is_depth_fill(const bench_case *k) { return k->scene >= BENCH_FILL_PASS && k->look == BENCH_DEPTH; }

/* The longest of what one frame keeps a unit, or loads and stores, busy with. */
static void set_bound(timing *t, const canvas *c, const bench_scene *s, const bench_rates *r, int cull)
{
    double counts[BENCH_OPS];
    int unit = 0;
    draw_frame(c, s, bench_operations_begin(), cull);
    const double depths = bench_operations_end(counts) / t->peak;
    t->bound = depths;
    t->by = "depth";
    const double busy = bench_rates_bound(&unit, r, counts) / r->machine->lanes * r->cycle;
    /* Plain C's lanes are what a compiler makes of them, here less and there more: its operations bound nothing. */
    if (busy > depths && strcmp(r->machine->name, "scalar") != 0) {
        t->bound = busy;
        t->by = bench_op_names[unit];
    }
}

/* Two frames to warm up, then frames for the time asked for, each by itself, and the machine's loops between them: both
 * meet the same clock rate and the same neighbours. */
static void measure(timing *t, const canvas *c, const bench_scene *s, const options *o, int cull)
{
    bench_rates rates;
    const int rated = bench_rates_begin(&rates, lmb_kernels_name(o->kernels));
    draw_frame(c, s, o->kernels, cull);
    draw_frame(c, s, o->kernels, cull);
    const double end = host_seconds() + o->seconds;
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
    const double least = t->cpu[0] * 1e3, middle = t->cpu[t->count / 2] * 1e3;
    const double wall = t->wall[0] * 1e3, wall_middle = t->wall[t->count / 2] * 1e3, each = least * 1e6 / triangles;
    const double pixels = (double)k->width * k->height * (triangles / 2) / t->cpu[0]; /* two triangles a layer */
    printf(o->json ? "{\"case\":\"%s\",\"triangles\":%u,\"cpu_min_ms\":%.4f,\"wall_min_ms\":%.4f,\"cpu_med_ms\":%.4f,"
                     "\"wall_med_ms\":%.4f,\"frames\":%d,\"ns_per_triangle\":%.2f,\"backend\":\"%s\""
                   : "lambent,%s,tris=%u,cpu_min_ms=%.4f,wall_min_ms=%.4f,cpu_med_ms=%.4f,wall_med_ms=%.4f,n=%d,"
                     "ns_per_tri=%.2f,backend=%s",
           k->name, triangles, least, wall, middle, wall_middle, t->count, each, lmb_kernels_name(o->kernels));
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

static int run_case(const bench_case *k, const options *o, report *r)
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
    const int ok = canvas_make(&c, k, o, r);
    if (ok) {
        measure(&t, &c, &s, o, k->cull);
        print_case(k, &s, &t, o);
        canvas_free(&c);
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

/* The value behind an option, or NULL with `r` set. */
static const char *value_of(int *i, int argc, char **argv, report *r)
{
    if (*i + 1 < argc) {
        return argv[++*i];
    }
    report_fail(r, "%s: its value is missing; see lambent bench --help", argv[*i]);
    return NULL;
}

static int parse_value(options *o, const char *name, const char *value, report *r)
{
    if (strcmp(name, "--data") == 0) {
        o->folder = value;
        return 1;
    }
    if (strcmp(name, "--backend") == 0) {
        o->kernels = lmb_kernels_named(value);
        return o->kernels != NULL || report_fail(r, "--backend %s: not here; this machine's best is %s", value,
                                                 lmb_kernels_name(lmb_kernels_pick()));
    }
    char *end;
    const double number = strtod(value, &end);
    const int whole = end != value && *end == 0; /* nothing stands behind it */
    if (strcmp(name, "--threads") == 0) {
        o->threads = number >= 2.0 && number <= POOL_MAX ? (int)number : 0;
        return (whole && o->threads > 0 && o->threads == number) ||
               report_fail(r, "--threads %s: not 2 .. %d", value, POOL_MAX);
    }
    o->seconds = number;
    return (whole && o->seconds > 0.0 && o->seconds < 1e4) || report_fail(r, "--seconds %s: not a time over 0", value);
}

static int parse_option(options *o, int *i, int argc, char **argv, report *r)
{
    const char *name = argv[*i], *value;
    if (strcmp(name, "--help") == 0) {
        return o->help = 1;
    }
    if (strcmp(name, "--linear") == 0) {
        return o->linear = 1;
    }
    if (strcmp(name, "--json") == 0) {
        return o->json = 1;
    }
    if (strcmp(name, "--data") != 0 && strcmp(name, "--backend") != 0 && strcmp(name, "--seconds") != 0 &&
        strcmp(name, "--threads") != 0) {
        return report_fail(r, "unknown option '%s'; see lambent bench --help", name);
    }
    value = value_of(i, argc, argv, r);
    return value != NULL && parse_value(o, name, value, r);
}

/* The first word says what is measured; more of them only mean something to raster, one more to hard. */
static int what_of(const options *o)
{
    static const char *const names[] = {"raster", "gather", "threads", "hard"};
    int what = RASTER;
    while (o->case_count > 0 && what < NOTHING && strcmp(o->cases[0], names[what]) != 0) {
        ++what;
    }
    const int most = what == RASTER ? INT_MAX : what == HARD ? 2 : 1;
    return o->case_count == 0 || o->case_count > most ? NOTHING : what;
}

/* An option that what is measured has no use for, or NULL. */
static const char *idle_option(const options *o)
{
    return o->threads > 0 && o->what != THREADS  ? "--threads"
           : o->linear && o->what != RASTER      ? "--linear"
           : o->json && o->what == THREADS       ? "--json"
           : o->seconds > 0.0 && o->what == HARD ? "--seconds"
                                                 : NULL;
}

/* Words that are no options are parts of cases' names; they are moved to the front of argv. */
static int parse(options *o, int argc, char **argv, report *r)
{
    const char *folder = getenv("BENCH_DATA");
    memset(o, 0, sizeof *o);
    o->folder = folder != NULL && folder[0] != '\0' ? folder : NULL;
    o->cases = (const char *const *)argv;
    for (int i = 1; i < argc; ++i) {
        if (argv[i][0] != '-') {
            argv[o->case_count++] = argv[i];
        } else if (!parse_option(o, &i, argc, argv, r)) {
            return 0;
        }
    }
    if (o->help) {
        return 1;
    }
    o->what = what_of(o);
    if (o->what == NOTHING) {
        return report_fail(r, "what is to be measured? A scene, `raster`, `gather`, `threads`, `hard`; see --help");
    }
    if (idle_option(o) != NULL) {
        return report_fail(r, "%s means nothing to `%s`; see --help", idle_option(o), o->cases[0]);
    }
    o->threads = o->threads > 0 ? o->threads : 2;
    o->kernels = o->kernels == NULL && o->what != GATHER ? lmb_kernels_pick() : o->kernels;
    o->seconds = o->seconds > 0.0 ? o->seconds : o->what == THREADS ? 4.0 : 1.5;
    ++o->cases;
    --o->case_count;
    return o->what != RASTER || wanted_count(o) > 0 || report_fail(r, "no case has `%s` in its name", o->cases[0]);
}

static int run_raster(const options *o, report *r)
{
    for (int i = 0; i < bench_case_count; ++i) {
        if (is_wanted(&bench_cases[i], o) && !run_case(&bench_cases[i], o, r)) {
            return 0;
        }
    }
    return 1;
}

static int run(const options *o, report *r)
{
    const threads_options threads = {o->folder, o->kernels, o->threads, o->seconds};
    switch (o->what) {
    case GATHER: return bench_gather(o->kernels, o->seconds, o->json, r);
    case THREADS: return bench_threads(&threads, r);
    case HARD: return bench_hard(o->kernels, o->case_count > 0 ? o->cases[0] : NULL, o->json, r);
    default: return run_raster(o, r);
    }
}

/* A first word that is no workload's name is a scene, or a verb that is swept. */
static int is_swept(int argc, char **argv)
{
    options o;
    memset(&o, 0, sizeof o);
    o.cases = (const char *const *)argv + 1;
    o.case_count = 1;
    return argc > 1 && argv[1][0] != '-' && what_of(&o) == NOTHING;
}

int verb_bench(int argc, char **argv)
{
    if (is_swept(argc, argv)) {
        return verb_bench_sweep(argc, argv);
    }
    if (argc > 1 && strcmp(argv[1], "--calibrate") == 0) {
        return verb_calibrate(argc, argv);
    }
    options o;
    report r = {""};
    if (!parse(&o, argc, argv, &r)) {
        fprintf(stderr, "lambent bench: %s\n", r.text);
        return 2;
    }
    if (o.help) {
        fputs(help_text, stdout);
        return 0;
    }
    if (!run(&o, &r)) {
        fprintf(stderr, "lambent bench: %s\n", r.text);
        return 1;
    }
    return 0;
}
