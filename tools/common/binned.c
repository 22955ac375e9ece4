/* binned.c: threads set up ranges of the scene's triangles, and then draw rows of the window from the bins. */
#include "binned.h"

#include <stdlib.h>
#include <string.h>

static lmb_status draw_alone(const binned_draw *d)
{
    lmb_surface_clear(&d->target->depth);
    if (d->target->id.data != NULL) {
        lmb_surface_clear(&d->target->id);
    }
    return lmb_draw(d->target, d->kernels, d->view, d->scene, d->first_id, d->count, d->flags, NULL);
}

#if LMB_CULLING

enum { WORTH = 1 << 14 }; /* triangles and tiles; below this, about 1 ms, other threads are not worth their start */

typedef struct work {
    binned *b;
    const binned_draw *draw;
    int ranges;
    int32_t rows; /* px of a piece */
    lmb_status built[POOL_MAX]; /* status of each range */
    lmb_status drawn[POOL_MAX]; /* by worker: of the last rows that failed */
} work;

static lmb_status first_failure(const lmb_status *of, int count)
{
    lmb_status status = LMB_OK;
    for (int i = 0; i < count && status == LMB_OK; ++i) {
        status = of[i];
    }
    return status;
}

static void build_range(work *w, int i)
{
    const binned_draw *d = w->draw;
    const uint32_t each = d->count / (uint32_t)w->ranges, first = each * (uint32_t)i;
    w->built[i] = lmb_bins_build(&w->b->bins[i], d->kernels, d->view, d->scene, d->first_id + first,
                                 i == w->ranges - 1 ? d->count - first : each, d->flags, NULL, NULL);
}

/* Rows from .. past - 1 of a surface of tiles. */
static void cut(lmb_surface *s, int32_t from, int32_t past)
{
    if (s->data != NULL) {
        s->data = (uint8_t *)s->data + (ptrdiff_t)s->stride_bytes * (s->layout == LMB_TILED ? from / LMB_TILE : from);
        s->height = past - from;
    }
}

static void draw_rows(work *w, int i, int worker)
{
    const binned_draw *d = w->draw;
    const int32_t height = d->target->depth.height, first = d->target->y0 / w->rows * w->rows + i * w->rows,
                  from = first > d->target->y0 ? first - d->target->y0 : 0,
                  past = first + w->rows - d->target->y0 < height ? first + w->rows - d->target->y0 : height;
    lmb_target t = *d->target;
    t.y0 += from;
    cut(&t.depth, from, past);
    cut(&t.id, from, past);
    const lmb_status status = lmb_bins_draw(&t, d->kernels, w->b->bins, w->ranges, 1, NULL);
    w->drawn[worker] = status != LMB_OK ? status : w->drawn[worker];
}

/* First the ranges; then rows, if all are built. */
static void do_piece(void *user, int i, int worker)
{
    work *w = user;
    if (i < w->ranges) {
        build_range(w, i);
    } else if (first_failure(w->built, w->ranges) == LMB_OK) {
        draw_rows(w, i - w->ranges, worker);
    }
}

/* Allocates `ranges` bins of equal size; if memory is short, as many as possible. */
static void give_memory(binned *b, const binned_draw *d, int ranges)
{
    const size_t each = lmb_bins_bytes(d->view, d->count / (uint32_t)ranges + 1);
    if (b->bytes < each * (size_t)ranges) {
        free(b->memory);
        b->bytes = each * (size_t)ranges;
        b->memory = malloc(b->bytes);
        b->bytes = b->memory != NULL ? b->bytes : 0;
    }
    for (int i = 0; i < ranges; ++i) {
        b->bins[i].bytes = b->bytes / (size_t)ranges;
        b->bins[i].memory = b->memory != NULL ? (uint8_t *)b->memory + b->bins[i].bytes * (size_t)i : NULL;
    }
}

lmb_status binned_run(binned *b, const binned_draw *d)
{
    work w;
    const int32_t high = d->target->depth.height;
    memset(&w, 0, sizeof w);
    w.b = b;
    w.draw = d;
    w.ranges = d->threads;
    w.rows = lmb_bins_rows(d->view);
    if (w.rows == 0 || d->count < (uint32_t)w.ranges ||
        (int64_t)d->count + (int64_t)d->target->depth.width * high / LMB_TILE_PIXELS < WORTH) {
        return draw_alone(d);
    }
    give_memory(b, d, w.ranges);
    const int pieces = (d->target->y0 + high - 1) / w.rows - d->target->y0 / w.rows + 1;
    pool_run_stages(d->threads, w.ranges, w.ranges + pieces, do_piece, &w);
    const lmb_status status = first_failure(w.built, w.ranges);
    return status != LMB_OK ? status : first_failure(w.drawn, d->threads);
}

#else /* a library without bins */

lmb_status binned_run(binned *b, const binned_draw *d)
{
    (void)b;
    return draw_alone(d);
}

#endif

void binned_free(binned *b)
{
    free(b->memory);
    b->memory = NULL;
    b->bytes = 0;
}
