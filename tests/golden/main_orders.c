/* main_orders.c: draws the golden cases in pieces, in several orders and on 1 .. 8 threads: the
 * hashes must be the same.
 *
 * Prints a line for each way, and the lines of cases that differ. Cases take turns through the backends, and change
 * backends from way to way, so every backend runs with every number of threads, and every case. `golden-orders all`
 * runs every way on every backend. `golden-orders third` draws each case in a third of the ways. Pictures are drawn band by
 * band, maps and targets by rows of tiles, the stages of a frame in parts; scratch is filled with noise before each
 * piece. Two more ways skip no stage, and reuse all results of an earlier frame. */
#include <stdio.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../../src/raster/target.h"
#include "../../tools/common/workers.h"
#include "golden.h"

enum { PIECES = 512, THREADS = GOLDEN_WORKERS, ROOM = 4 * 16 * 16 };

/* --- orders ------------------------------------------------------------------------------------------------------- */

typedef enum order_kind { FORWARD = 0, BACKWARD, INTERLEAVED, SHUFFLED } order_kind;

static const struct golden_order {
    const char *name;
    order_kind kind;
    uint32_t seed;
} orders[] = {
    {"forward", FORWARD, 0},      {"backward", BACKWARD, 0},    {"interleaved", INTERLEAVED, 0},
    {"shuffled 1", SHUFFLED, 1},  {"shuffled 22", SHUFFLED, 22}, {"shuffled 333", SHUFFLED, 333},
};

static int order_now, threads_now; /* threads 0: in order_now */
static lmb_band_scratch scratches[THREADS];
static golden_samples samples[THREADS];
static lmb_live_scratch live[THREADS];

static void shuffle(int *p, int n, uint32_t seed)
{
    for (int i = n - 1; i > 0; --i) {
        seed = seed * 1664525u + 1013904223u;
        const int j = (int)((seed >> 8) % (uint32_t)(i + 1)), t = p[i];
        p[i] = p[j];
        p[j] = t;
    }
}

static void set_order(int p[PIECES], int n)
{
    const struct golden_order *o = &orders[order_now];
    const int odd = n / 2;
    for (int i = 0; i < n; ++i) {
        p[i] = o->kind == BACKWARD ? n - 1 - i : o->kind == INTERLEAVED ? (i < odd ? 2 * i + 1 : 2 * (i - odd)) : i;
    }
    if (o->kind == SHUFFLED) {
        shuffle(p, n, o->seed);
    }
}

/* Runs all n pieces in the current way. */
static void do_pieces(int n, pool_job job, void *user)
{
    int p[PIECES];
    if (threads_now > 0) {
        pool_run(threads_now, n, job, user);
        return;
    }
    set_order(p, n);
    for (int i = 0; i < n; ++i) {
        memset(&scratches[i & 1], 0x3c, sizeof scratches[0]);
        job(user, p[i], i & 1);
    }
}

/* --- targets and maps --------------------------------------------------------------------------------------------- */

typedef struct draw_job {
    const lmb_target *target;
    const lmb_shadow_map *map;
    const lmb_kernels *kernels;
    const lmb_view *view;
    const lmb_scene *scene;
    uint32_t flags;
    lmb_status status[THREADS];
} draw_job;

static lmb_status worst(const draw_job *d)
{
    lmb_status status = LMB_OK;
    for (int i = 0; i < THREADS; ++i) {
        status = status != LMB_OK ? status : d->status[i];
    }
    return status;
}

static void draw_row(void *user, int row, int worker)
{
    draw_job *d = user;
    lmb_target window;
    lmb_target_rows(&window, d->target, row, 1);
    const lmb_status status = lmb_draw(&window, d->kernels, d->view, d->scene, 1, UINT32_MAX - 1, d->flags, NULL);
    d->status[worker] = status != LMB_OK ? status : d->status[worker];
}

static lmb_status draw_rows(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view,
                            const lmb_scene *scene, uint32_t flags, lmb_stats *stats)
{
    draw_job d = {target, NULL, kernels, view, scene, flags, {LMB_OK}};
    (void)stats;
    do_pieces((target->depth.height + LMB_TILE - 1) / LMB_TILE, draw_row, &d);
    return worst(&d);
}

static void draw_map_row(void *user, int row, int worker)
{
    draw_job *d = user;
    const lmb_status status = lmb_shadow_map_rows(d->map, d->kernels, d->scene, row, row + 1, NULL);
    d->status[worker] = status != LMB_OK ? status : d->status[worker];
}

static lmb_status draw_map_rows(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene)
{
    draw_job d = {NULL, map, kernels, NULL, scene, 0, {LMB_OK}};
    do_pieces(map->faces * map->size / LMB_TILE, draw_map_row, &d);
    return worst(&d);
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static lmb_point point_room[ROOM];

/* The frame with this way's own scratch, and room to collect first points in parts. */
static lmb_frame with_room(const lmb_frame *frame)
{
    lmb_frame f = *frame;
    f.scratch = scratches;
    scratches[0].live = &live[0];
    if (f.samples > 1) {
        golden_give_samples(&scratches[0], &samples[0], f.samples);
    }
    if (f.points.cap == GOLDEN_POINTS) {
        f.points.data = point_room;
        f.points.cap = ROOM;
    }
    return f;
}

/* Runs a stage's parts, or the bands, of a frame in the current order. */
typedef struct frame_job {
    const lmb_render *render;
    int parts;
    lmb_status status;
} frame_job;

static void do_part(void *user, int part, int worker)
{
    frame_job *j = user;
    scratches[worker].live = &live[worker];
    const lmb_status status = lmb_render_part(j->render, &scratches[worker], part, j->parts, NULL);
    j->status = status != LMB_OK ? status : j->status;
}

static void do_band(void *user, int band, int worker)
{
    frame_job *j = user;
    const lmb_frame *f = &j->render->frame;
    scratches[worker].live = &live[worker];
    if (f->samples > 1) {
        golden_give_samples(&scratches[worker], &samples[worker], f->samples);
    }
    const lmb_status status = lmb_render_band(j->render, &scratches[worker], &f->eye, &f->out, band);
    j->status = status != LMB_OK ? status : j->status;
}

/* Runs the remaining stages of a frame. */
static lmb_status finish_in_order(lmb_render *r, lmb_status status)
{
    frame_job j = {r, 7, LMB_OK};
    while (status >= 0 && r->stage < LMB_STAGE_BANDS) {
        if (lmb_render_has_parts(r)) {
            do_pieces(j.parts, do_part, &j);
            status = j.status != LMB_OK ? j.status : lmb_render_parts_done(r, j.parts);
        } else {
            status = lmb_render_step(r, 3);
        }
    }
    if (status >= 0) {
        do_pieces((r->frame.view.frame_height + LMB_TILE - 1) / LMB_TILE, do_band, &j);
        status = j.status;
    }
    return status;
}

static lmb_status render_in_order(lmb_render *r, const lmb_frame *frame)
{
    const lmb_frame f = with_room(frame);
    return finish_in_order(r, lmb_render_begin(r, &f));
}

static lmb_status again_in_order(lmb_render *r, const lmb_frame *frame)
{
    const lmb_frame f = with_room(frame);
    return finish_in_order(r, lmb_render_again(r, &f));
}

typedef lmb_status (*workers_call)(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

static lmb_status by_workers(workers_call call, lmb_render *r, const lmb_frame *frame)
{
    const lmb_frame f = with_room(frame);
    workers c;
    int32_t stage;
    memset(&c, 0, sizeof c);
    memset(scratches, 0x3c, sizeof scratches);
    for (int i = 0; i < THREADS; ++i) {
        scratches[i].live = &live[i];
        if (f.samples > 1) {
            golden_give_samples(&scratches[i], &samples[i], f.samples);
        }
    }
    c.threads = threads_now;
    c.scratches = scratches;
    return call(&c, &stage, r, &f);
}

static lmb_status render_by_workers(lmb_render *r, const lmb_frame *frame)
{
    return by_workers(workers_render, r, frame);
}
static lmb_status again_by_workers(lmb_render *r, const lmb_frame *frame)
{
    return by_workers(workers_again, r, frame);
}

#if LMB_PLAN
/* Skips no stage. */
static lmb_status render_everything(lmb_render *r, const lmb_frame *frame)
{
    lmb_frame f = with_room(frame);
    f.run_all = 1;
    return finish_in_order(r, lmb_render_begin(r, &f));
}

/* Draws the second frame of an animation without motion: all light comes from the first. */
static lmb_status render_reused(lmb_render *r, const lmb_frame *frame)
{
    lmb_frame f = with_room(frame);
    memset(r, 0, sizeof *r);
    lmb_status status = finish_in_order(r, lmb_render_reuse(r, &f));
    if (status >= 0 && r->stage == LMB_STAGE_BANDS) {
        f = with_room(frame); /* pieces left noise in the scratch */
        lmb_surface_clear(&f.out);
        status = finish_in_order(r, lmb_render_reuse(r, &f));
    }
    return status;
}
#endif

/* --- ways --------------------------------------------------------------------------------------------------------- */

static int cases;

static void put_wrong(const char *line)
{
    ++cases;
    if (strstr(line, " WRONG ") != NULL) {
        printf("FAIL %s\n", line);
    }
}

/* With `third` each case takes part in every third way. */
static int by_thirds, ways;

static int run_way(const char *name, int number, golden_way *way)
{
    way->third = by_thirds ? 1 + ways++ % 3 : 0;
    cases = 0;
    const int wrong = golden_run(way, put_wrong);
    printf("%s", name);
    if (number > 0) {
        printf(" %d", number);
    }
    printf(": %d cases, %d wrong\n", cases, wrong);
    fflush(stdout);
    return wrong > 0 || cases == 0;
}

int main(int argc, char **argv)
{
    int all = 0, used = 1;
    for (; used < argc; ++used) {
        const int is_all = strcmp(argv[used], "all") == 0;
        if (!is_all && strcmp(argv[used], "third") != 0) {
            break;
        }
        all |= is_all;
        by_thirds |= !is_all;
    }
    golden_way ordered = {draw_rows, draw_map_rows, render_in_order, again_in_order, 0, 0};
    golden_way threaded = {draw_rows, draw_map_rows, render_by_workers, again_by_workers, 0, 0};
    const int order_count = sizeof orders / sizeof *orders;
    int failed = 0;
    if (used < argc) {
        printf("FAIL golden-orders takes `all` and `third`, not `%s`\n", argv[used]);
        return 2;
    }
    for (order_now = 0; order_now < order_count; ++order_now) {
        ordered.backend = all ? -1 : order_now;
        failed += run_way(orders[order_now].name, 0, &ordered);
    }
    for (threads_now = 1; threads_now <= THREADS; ++threads_now) {
        threaded.backend = all ? -1 : threads_now - 1;
        failed += run_way("threads", threads_now, &threaded);
    }
    int plans = 0;
#if LMB_PLAN
    golden_way planned[2] = {{draw_rows, draw_map_rows, render_everything, again_in_order, 1, 0},
                             {draw_rows, draw_map_rows, render_reused, again_in_order, 2, 0}};
    order_now = threads_now = 0;
    for (plans = 0; plans < 2; ++plans) {
        planned[plans].backend = all ? -1 : plans + 1;
        failed += run_way(plans == 0 ? "nothing left out" : "all kept", 0, &planned[plans]);
    }
#endif
    printf("%d passed, %d failed, 0 skipped\n", order_count + THREADS + plans - failed, failed);
    return failed > 0;
}
