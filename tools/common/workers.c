/* workers.c: runs the stages of a frame on several threads. */
#include "workers.h"

#include <string.h>

#include "../../platform/host/host.h"

/* A stage in progress. */
typedef struct stage_work {
    const workers *workers;
    const lmb_render *render;
    int parts;
    lmb_status failed[POOL_MAX]; /* by worker, like counts */
    lmb_stats counts[POOL_MAX];
} stage_work;

static void keep_failure(stage_work *w, int worker, lmb_status status)
{
    if (status != LMB_OK) {
        w->failed[worker] = status;
    }
}

static double now(const workers *c) { return c->clock != NULL ? c->clock() : host_seconds(); }

static void tell(const workers *c, const lmb_render *r)
{
    if (c->tell != NULL) {
        c->tell(c->user, r);
    }
}

static void draw_part(void *user, int part, int worker)
{
    stage_work *w = user;
    keep_failure(w, worker,
                 lmb_render_part(w->render, &w->workers->scratches[worker], part, w->parts, &w->counts[worker]));
}

/* Every n-th band, or those of a slice: the k-th band, and their number. */
static int32_t band_at(const workers *c, int32_t k) { return c->every > 1 ? k * c->every : slice_item(c->slice, k); }

static int32_t bands_of(const workers *c, int32_t all)
{
    return c->every > 1 ? (all + c->every - 1) / c->every : slice_items(c->slice, all);
}

/* Bands are taken in order, so a band's number measures progress. */
static void draw_band(void *user, int part, int worker)
{
    stage_work *w = user;
    const lmb_frame *f = &w->render->frame;
    const int32_t band = band_at(w->workers, part);
    lmb_band_scratch *scratch = &w->workers->scratches[worker];
    memset(&scratch->counts, 0, sizeof scratch->counts);
    keep_failure(w, worker, lmb_render_band(w->render, scratch, &f->eye, &f->out, band));
    w->counts[worker].bands += 1;
    w->counts[worker].pairs += scratch->counts.pairs;
    w->counts[worker].segments += scratch->counts.segments;
    w->counts[worker].corner_segments += scratch->counts.corner_segments;
    w->counts[worker].full_cuts += scratch->counts.full_cuts;
    w->counts[worker].tiles += scratch->counts.tiles;
    w->counts[worker].coarse_tiles += scratch->counts.coarse_tiles;
    if (worker == 0 && w->workers->tell != NULL) {
        lmb_render at = *w->render;
        at.progress = (uint32_t)band;
        tell(w->workers, &at);
    }
}

static lmb_status sum_up(const stage_work *w, lmb_stats *stats)
{
    lmb_status status = LMB_OK;
    for (int i = 0; i < POOL_MAX; ++i) {
        status = status != LMB_OK ? status : w->failed[i];
        if (stats != NULL) {
            stats->triangles += w->counts[i].triangles;
            stats->triangles_drawn += w->counts[i].triangles_drawn;
            stats->triangles_dropped += w->counts[i].triangles_dropped;
            stats->bands += w->counts[i].bands;
            stats->pairs += w->counts[i].pairs;
            stats->segments += w->counts[i].segments;
            stats->corner_segments += w->counts[i].corner_segments;
            stats->full_cuts += w->counts[i].full_cuts;
            stats->tiles += w->counts[i].tiles;
            stats->coarse_tiles += w->counts[i].coarse_tiles;
        }
    }
    return status;
}

/* Runs the parts or bands of the current stage on all threads. */
static lmb_status share(const workers *c, const lmb_render *r, int parts, pool_job job)
{
    stage_work w;
    memset(&w, 0, sizeof w);
    w.workers = c;
    w.render = r;
    w.parts = parts;
    tell(c, r);
    pool_run(c->threads, parts, job, &w);
    return sum_up(&w, r->frame.stats);
}

/* Some rows have many more samples than others, so each thread runs many small parts. */
enum { SAMPLE_PARTS = 16 };

static lmb_status do_parts(const workers *c, lmb_render *r)
{
    const int parts = r->stage == LMB_STAGE_SAMPLES ? SAMPLE_PARTS * c->threads : c->threads;
    const lmb_status status = share(c, r, parts, draw_part);
    return status != LMB_OK ? status : lmb_render_parts_done(r, parts);
}

static lmb_status do_step(const workers *c, lmb_render *r)
{
    const lmb_status status = lmb_render_step(r, 16);
    tell(c, r);
    return status;
}

/* Runs the stages before `past`; with one thread in steps, to report progress. */
static lmb_status do_stages(workers *c, lmb_render *r, int32_t *stage, int32_t past)
{
    lmb_status status = LMB_MORE;
    while (status == LMB_MORE && r->stage < past) {
        const double start = now(c), cpu = host_cpu_seconds();
        *stage = r->stage;
        while (status == LMB_MORE && r->stage == *stage) { /* a clock call takes longer than some steps */
            status = c->threads > 1 && lmb_render_has_parts(r) ? do_parts(c, r) : do_step(c, r);
        }
        c->stage_cpu_s[*stage] += host_cpu_seconds() - cpu;
        c->stage_s[*stage] += now(c) - start;
    }
    return status == LMB_MORE ? LMB_OK : status;
}

static lmb_status do_bands(workers *c, lmb_render *r, int32_t *stage)
{
    const double start = now(c), cpu = host_cpu_seconds();
    *stage = LMB_STAGE_BANDS;
    const int32_t bands = bands_of(c, (r->frame.view.frame_height + LMB_TILE - 1) / LMB_TILE);
    lmb_status status = share(c, r, bands, draw_band);
    c->stage_cpu_s[LMB_STAGE_BANDS] += host_cpu_seconds() - cpu;
    c->stage_s[LMB_STAGE_BANDS] += now(c) - start;
    return status;
}

/* Runs the stages before `past` of a frame that began with this status. */
static lmb_status go_on(workers *c, int32_t *stage, lmb_render *r, lmb_status begun, int32_t past)
{
    *stage = LMB_STAGE_SHADOW_MAP;
    memset(c->stage_s, 0, sizeof c->stage_s);
    memset(c->stage_cpu_s, 0, sizeof c->stage_cpu_s);
    return begun != LMB_OK ? begun : do_stages(c, r, stage, past);
}

lmb_status workers_light(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame, int32_t past)
{
    return go_on(c, stage, r, lmb_render_begin(r, frame), past);
}

lmb_status workers_reuse(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame)
{
    const lmb_status status = go_on(c, stage, r, lmb_render_reuse(r, frame), LMB_STAGE_BANDS);
    return status != LMB_OK ? status : do_bands(c, r, stage);
}

lmb_status workers_render(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame)
{
    const lmb_status status = workers_light(c, stage, r, frame, LMB_STAGE_BANDS);
    return status != LMB_OK ? status : do_bands(c, r, stage);
}

lmb_status workers_again_drawn(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame)
{
    lmb_status status = lmb_render_again(r, frame);
    *stage = LMB_STAGE_VIEW;
    if (status == LMB_OK) {
        r->progress = r->triangles; /* none is left to draw, and nothing is cleared */
        status = do_stages(c, r, stage, LMB_STAGE_BANDS);
    }
    return status != LMB_OK ? status : do_bands(c, r, stage);
}

lmb_status workers_again(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame)
{
    lmb_status status = lmb_render_again(r, frame);
    *stage = LMB_STAGE_VIEW;
    if (status == LMB_OK) {
        status = do_stages(c, r, stage, LMB_STAGE_BANDS);
    }
    return status != LMB_OK ? status : do_bands(c, r, stage);
}
