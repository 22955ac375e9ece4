/* bench_threads.c: `lambent-bench threads`: the speed-up of threads, compared with independent processes.
 *
 * N processes that each do the whole work share memory bandwidth, caches and the machine's other users, but no work, so
 * their throughput is the limit for threads. One thread, N threads and N processes run in turns, so that load on the
 * machine affects them alike. The shortest time of each counts; the median of the turns' ratios is printed, too. */
#include "bench_threads.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../../platform/host/process.h"
#include "../common/binned.h"
#include "../demo/demo_scene.h"
#include "bench_scene.h"

enum {
    WIDTH = 320,
    HEIGHT = 240,
    GATHER_MAP = 512,
    MAP = 2048,
    POINTS = 4 * 64 * 64,
    ROUNDS_MIN = 5,
    ROUNDS_MAX = 1000
};

/* One work load of `parts` parallel pieces: as many as threads, or a fixed number. */
typedef struct bench_work {
    const char *name;
    pool_job job;
    void *user;
    int bands; /* pieces; 0: as many as threads */
    void (*shared)(void *user, int threads); /* distributes itself over threads; or NULL */
    int parts; /* of the current run */
} bench_work;

static void run_work(bench_work *w, int threads)
{
    w->parts = w->bands > 0 ? w->bands : threads;
    if (w->shared != NULL) {
        w->shared(w->user, threads);
    } else {
        pool_run(threads, w->parts, w->job, w);
    }
}

static void run_alone(void *user) { run_work(user, 1); }

/* --- gather ------------------------------------------------------------------------------------------------------- */

typedef struct gather_job {
    uint32_t depth[WIDTH * HEIGHT], id[WIDTH * HEIGHT], map[GATHER_MAP * GATHER_MAP * 2];
    float out[WIDTH * HEIGHT * 3];
    lmb_point points[POINTS];
    uint32_t cells[64 * 64 + 1];
    lmb_groups groups;
    lmb_band_scratch scratch[POOL_MAX];
    lmb_render render;
} gather_job;

static void gather_band(void *user, int band, int worker)
{
    const bench_work *w = user;
    gather_job *g = w->user;
    const lmb_frame *f = &g->render.frame;
    lmb_render_band(&g->render, &g->scratch[worker], &f->eye, &f->out, band);
}

/* A frame with only bounced light, prepared up to the bands. */
static lmb_status gather_begin(gather_job *g, const lmb_kernels *kernels)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = kernels;
    f.scene = demo_scene();
    f.view = demo_view(WIDTH, HEIGHT);
    f.show = LMB_SHOW_INDIRECT;
    f.shadow_map = GATHER_MAP;
    f.occlusion = LMB_OCCLUSION_VIEW;
    f.map_memory = g->map;
    f.map_bytes = sizeof g->map;
    f.points.data = g->points;
    f.points.cap = POINTS;
    f.points.cells = g->cells;
    f.points.cell_cap = sizeof g->cells / sizeof *g->cells;
    f.groups = &g->groups;
    f.scratch = g->scratch;
    lmb_surface_init(&f.eye.depth, LMB_DEPTH32F, WIDTH, HEIGHT, g->depth, sizeof g->depth);
    lmb_surface_init(&f.eye.id, LMB_ID32, WIDTH, HEIGHT, g->id, sizeof g->id);
    lmb_surface_init(&f.out, LMB_RGB32F, WIDTH, HEIGHT, g->out, sizeof g->out);
    lmb_status status = lmb_render_begin(&g->render, &f);
    while (status >= 0 && g->render.stage < LMB_STAGE_BANDS) {
        status = lmb_render_step(&g->render, 1 << 20);
    }
    return status < 0 ? status : LMB_OK;
}

/* --- a shadow map ------------------------------------------------------------------------------------------------ */

typedef struct map_job {
    uint32_t depth[MAP * MAP], id[MAP * MAP];
    binned bins;
    bench_scene scene;
    lmb_shadow_map map;
    const lmb_kernels *kernels;
} map_job;

static void map_rows(void *user, int part, int worker)
{
    const bench_work *w = user;
    const map_job *m = w->user;
    const int32_t rows = MAP / LMB_TILE;
    (void)worker;
    lmb_shadow_map_rows(&m->map, m->kernels, &m->scene.scene, rows * part / w->parts, rows * (part + 1) / w->parts,
                        NULL);
}

static void map_begin(map_job *m, int ids, const lmb_kernels *kernels)
{
    memset(&m->map, 0, sizeof m->map);
    m->kernels = kernels;
    m->map.faces = 1;
    m->map.drawn = 1;
    m->map.size = MAP;
    m->map.view[0] = m->scene.view;
    lmb_surface_init(&m->map.face[0].depth, LMB_DEPTH32F, MAP, MAP, m->depth, sizeof m->depth);
    if (ids) {
        lmb_surface_init(&m->map.face[0].id, LMB_ID32, MAP, MAP, m->id, sizeof m->id);
    }
}

/* The same map by bins: one draw per run, which distributes itself over threads. */
static void map_binned(void *user, int threads)
{
    map_job *m = user;
    const lmb_scene *scene = &m->scene.scene;
    const binned_draw draw = {
        &m->map.face[0], m->kernels, &m->map.view[0], scene, 1, lmb_scene_triangles(scene), 0, threads};
    binned_run(&m->bins, &draw);
}

/* --- turns -------------------------------------------------------------------------------------------------------- */

/* Times in s, by turn. */
typedef struct turns {
    double alone[ROUNDS_MAX], threads[ROUNDS_MAX], processes[ROUNDS_MAX], ratio[ROUNDS_MAX];
    int count;
} turns;

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* N processes do N units of work in their time, N threads one. Sorts the ratios. */
static double median_ratio(turns *t, int n)
{
    for (int i = 0; i < t->count; ++i) {
        t->ratio[i] = t->processes[i] / (n * t->threads[i]);
    }
    qsort(t->ratio, (size_t)t->count, sizeof *t->ratio, by_value);
    return t->ratio[t->count / 2];
}

static double min(const double *v, int count)
{
    double best = v[0];
    for (int i = 1; i < count; ++i) {
        best = v[i] < best ? v[i] : best;
    }
    return best;
}

/* Returns 0 if a process has ended. */
static int run_processes(const process *p, int count)
{
    int good = 1;
    for (int i = 0; i < count; ++i) {
        good &= process_go(&p[i]);
    }
    for (int i = 0; i < count; ++i) {
        good &= process_wait(&p[i]);
    }
    return good;
}

static int take_turns(turns *t, bench_work *w, const process *p, const threads_options *o)
{
    const double end = host_seconds() + o->seconds;
    int good = 1;
    run_work(w, o->threads);
    for (t->count = 0; good && t->count < ROUNDS_MAX && (host_seconds() < end || t->count < ROUNDS_MIN); ++t->count) {
        const double start = host_seconds();
        run_work(w, 1);
        const double alone = host_seconds();
        run_work(w, o->threads);
        const double threads = host_seconds();
        good = run_processes(p, o->threads);
        t->alone[t->count] = alone - start;
        t->threads[t->count] = threads - alone;
        t->processes[t->count] = host_seconds() - threads;
    }
    return good;
}

static void print_turns(const bench_work *w, turns *t, const threads_options *o)
{
    const double alone = min(t->alone, t->count), threads = min(t->threads, t->count),
                 processes = min(t->processes, t->count);
    const double by_threads = alone / threads, by_processes = o->threads * alone / processes;
    printf(
        "%-29s one thread %8.2f ms, %d threads %8.2f ms: x %.2f; %d processes: x %.2f; of processes %5.1f %% (median "
        "%5.1f %%); %d turns, %s\n",
        w->name, alone * 1e3, o->threads, threads * 1e3, by_threads, o->threads, by_processes,
        by_threads / by_processes * 100.0, median_ratio(t, o->threads) * 100.0, t->count, lmb_kernels_name(o->kernels));
    fflush(stdout);
}

static int measure(bench_work *w, const threads_options *o, report *r)
{
    process p[POOL_MAX];
    static turns t;
    int started = 0, good;
    while (started < o->threads && process_start(&p[started], run_alone, w)) {
        ++started;
    }
    good = started == o->threads && take_turns(&t, w, p, o);
    for (int i = 0; i < started; ++i) {
        process_end(&p[i]);
    }
    if (!good) {
        return report_fail(r, "%s: no processes to compare with: this system has no fork, or ended one", w->name);
    }
    if (!o->is_quiet) {
        print_turns(w, &t, o);
    }
    return 1;
}

/* --- the cases ---------------------------------------------------------------------------------------------------- */

static int measure_gather(const threads_options *o, report *r)
{
    gather_job *g = malloc(sizeof *g);
    bench_work w = {"gather-demo-320x240", gather_band, g, HEIGHT / LMB_TILE, NULL, 0};
    if (g == NULL) {
        return report_fail(r, "not enough memory for the gather");
    }
    const lmb_status status = gather_begin(g, o->kernels);
    const int ok = status == LMB_OK ? measure(&w, o, r) : report_fail(r, "demo: %s", lmb_status_name(status));
    free(g);
    return ok;
}

/* Depth, then also ids; by windows of rows, then by bins. */
static int measure_map(map_job *m, const bench_case *of, const threads_options *o, report *r)
{
    static const char *const kinds[2][2] = {{"depth-2048", "depth-2048 by bins"},
                                            {"depth-id-2048", "depth-id-2048 by bins"}};
    int ok = 1;
    if (!bench_scene_load(&m->scene, of, o->folder, r)) {
        return 0;
    }
    for (int i = 0; i < 4 && ok; ++i) {
        const int ids = i / 2, bins = i % 2;
        char name[64];
        bench_work w = {name, map_rows, m, 0, bins ? map_binned : NULL, 0};
        snprintf(name, sizeof name, "%s-%s", of->name, kinds[ids][bins]);
        map_begin(m, ids, o->kernels);
        ok = measure(&w, o, r);
    }
    bench_scene_free(&m->scene);
    return ok;
}

static int measure_maps(const threads_options *o, report *r)
{
    static const bench_case of[] = {{"bunny", BENCH_BUNNY, BENCH_DEPTH, MAP, MAP, 0},
                                    {"sponzaL", BENCH_SPONZA_LIGHT, BENCH_DEPTH, MAP, MAP, 0},
                                    {"sponzaI", BENCH_SPONZA_INSIDE, BENCH_DEPTH, MAP, MAP, 0}};
    map_job *m = malloc(sizeof *m);
    int ok = 1;
    if (m == NULL) {
        return report_fail(r, "not enough memory for the maps");
    }
    memset(&m->bins, 0, sizeof m->bins);
    for (size_t i = 0; i < sizeof of / sizeof *of && ok; ++i) {
        ok = measure_map(m, &of[i], o, r);
    }
    binned_free(&m->bins);
    free(m);
    return ok;
}

int bench_threads(const threads_options *o, report *r)
{
    if (o->folder == NULL) {
        return report_fail(r, "where are bunny.mesh and sponza.mesh? Give --data FOLDER or set BENCH_DATA");
    }
    return measure_gather(o, r) && measure_maps(o, r);
}
