/* bins.c: triangles set up once, into bins by rows of the frame, and drawn from there into windows. Layer 3.
 *
 * A bin has two lists of blocks, both in triangle order: small triangles, LMB_BATCH side by side, and large ones, which
 * store how many small ones precede them. A triangle is in each bin that its box meets, and a bin draws only into its
 * own rows. So each pixel meets its triangles once and in order, for any windows. */
#include <lambent/bins.h>

#if LMB_CULLING
#include <string.h>

#include "draw_one.h"
#include "target.h"
#include "triangle.h"

enum { SMALL_BLOCKS, LARGE_BLOCKS, BLOCK_KINDS };
enum { BIN_ALIGN_BYTES = 64, ROWS_SHIFT = 7, BIN_BYTES = 1 << 20 };

typedef struct bin {
    uint32_t first[BLOCK_KINDS], last[BLOCK_KINDS]; /* blocks, if there are any */
    uint32_t count[BLOCK_KINDS];                    /* triangles */
} bin;

enum { LARGE_IS_MASKED = 1, LARGE_BLENDS = 2 };

/* A triangle that is large, was clipped, or has holes. */
typedef struct bin_large {
    lmb_screen_vertex corner[3];
    uint32_t id, flags;
    uint32_t before; /* small triangles of the bin before it */
} bin_large;

enum { BLOCK_BYTES = sizeof(lmb_bin_block), LARGE_BYTES = sizeof(bin_large) };
enum { LARGES_A_BLOCK = BLOCK_BYTES / LARGE_BYTES }; /* per block */

/* Layout of the caller's memory. */
typedef struct bin_pool {
    bin *bins;
    uint32_t *next; /* of each block: the following one */
    lmb_bin_block *block;
    uint32_t blocks, used;
    int shift;             /* log2 of the rows of a bin */
    int32_t width, height; /* limits of windows */
    int is_full;           /* 1: no more triangles are added */
} bin_pool;

/* --- memory ------------------------------------------------------------------------------------------------------- */

/* log2 of 128 rows, or of fewer if these exceed a MiB of float depth. */
static int rows_shift(const lmb_view *view)
{
    int shift = ROWS_SHIFT;
    while (shift > 3 && (int64_t)view->frame_width * (4 << shift) > BIN_BYTES) {
        --shift;
    }
    return shift;
}

/* Pixels of the frame and the rest of the last tile, which windows may include. */
static int32_t with_last_tile(int32_t frame_px) { return frame_px + LMB_TILE - 1; }

static uint32_t bin_count(const lmb_view *view)
{
    return (uint32_t)((with_last_tile(view->frame_height) - 1) >> rows_shift(view)) + 1;
}

static size_t table_bytes(const lmb_view *view)
{
    return (bin_count(view) * sizeof(bin) + BIN_ALIGN_BYTES - 1) / BIN_ALIGN_BYTES * BIN_ALIGN_BYTES;
}

int32_t lmb_bins_rows(const lmb_view *view)
{
    return view != NULL && lmb_view_is_valid(view) ? 1 << rows_shift(view) : 0;
}

size_t lmb_bins_bytes(const lmb_view *view, uint32_t triangles)
{
    if (lmb_bins_rows(view) == 0) {
        return 0;
    }
    const uint64_t blocks = (uint64_t)(triangles / LMB_BATCH) * 2 + 2 * (uint64_t)bin_count(view) + 2,
                   bytes = table_bytes(view) + blocks * (sizeof(lmb_bin_block) + sizeof(uint32_t)) + BIN_ALIGN_BYTES;
    return bytes <= SIZE_MAX ? (size_t)bytes : 0;
}

/* Returns 0 if not even the bins fit. */
static int pool_find(bin_pool *p, const lmb_bins *bins)
{
    const size_t table = table_bytes(&bins->view),
                 skip = (BIN_ALIGN_BYTES - (uintptr_t)bins->memory % BIN_ALIGN_BYTES) % BIN_ALIGN_BYTES;
    if (bins->memory == NULL || bins->bytes < table + skip) {
        return 0;
    }
    uint8_t *at = (uint8_t *)bins->memory + skip;
    const size_t blocks = (bins->bytes - table - skip) / (sizeof(lmb_bin_block) + sizeof(uint32_t));
    p->blocks = blocks < UINT32_MAX ? (uint32_t)blocks : UINT32_MAX;
    p->bins = (bin *)(void *)at;
    p->block = (lmb_bin_block *)(void *)(at + table);
    p->next = (uint32_t *)(void *)(p->block + p->blocks);
    p->used = 0;
    p->is_full = 0;
    p->shift = rows_shift(&bins->view);
    p->width = with_last_tile(bins->view.frame_width);
    p->height = with_last_tile(bins->view.frame_height);
    return 1;
}

static void block_soon(const bin_pool *p, uint32_t i)
{
    for (size_t at = 0; at < sizeof(lmb_bin_block); at += BIN_ALIGN_BYTES) {
        MESH_SOON((const uint8_t *)&p->block[i] + at);
    }
}

/* --- into bins ---------------------------------------------------------------------------------------------------- */

/* The block and place for the next triangle of a kind; NULL if memory is exhausted. */
static inline lmb_bin_block *pool_place(bin_pool *p, bin *b, int kind, uint32_t per_block, uint32_t *place)
{
    *place = b->count[kind] % per_block;
    if (*place == 0) {
        const uint32_t i = p->used;
        if (i == p->blocks) {
            return NULL;
        }
        if (b->count[kind] == 0) {
            b->first[kind] = i;
        } else {
            p->next[b->last[kind]] = i;
        }
        p->next[i] = i; /* the last one */
        b->last[kind] = i;
        if (++p->used < p->blocks) {
            block_soon(p, p->used);
        }
    }
    ++b->count[kind];
    return &p->block[b->last[kind]];
}

static inline int put_small(bin_pool *p, bin *b, const lmb_bin_block *from, int k, uint32_t id)
{
    uint32_t i;
    lmb_bin_block *to = pool_place(p, b, SMALL_BLOCKS, LMB_BATCH, &i);
    if (to == NULL) {
        return 0;
    }
    to->x[i] = from->x[k];
    to->y[i] = from->y[k];
    to->to_b[i] = from->to_b[k];
    to->to_c[i] = from->to_c[k];
    to->d[0][i] = from->d[0][k];
    to->d[1][i] = from->d[1][k];
    to->d[2][i] = from->d[2][k];
    to->id[i] = id;
    return 1;
}

static int put_large(bin_pool *p, bin *b, const bin_large *large)
{
    uint32_t i;
    lmb_bin_block *to = pool_place(p, b, LARGE_BLOCKS, LARGES_A_BLOCK, &i);
    if (to == NULL) {
        return 0;
    }
    bin_large *own = (bin_large *)(void *)to + i;
    *own = *large;
    own->before = b->count[SMALL_BLOCKS];
    return 1;
}

/* First and last pixels in 0 .. size - 1 with a sample between two 24.8 positions. */
static void span_of_tiles(int32_t *first, int32_t *last, int32_t low, int32_t high, int32_t origin, int32_t size)
{
    *first = maxi((low + 255 - origin) >> 8, 0);
    *last = mini((high - origin) >> 8, size - 1);
}

/* Returns 0 if memory is exhausted. Sets *seen if the triangle has area and is not culled. */
static int put_large_triangle(bin_pool *p, const lmb_draw_instance *d, const bin_large *large, int *seen)
{
    const lmb_screen_vertex *a = &large->corner[0], *b = &large->corner[1], *c = &large->corner[2];
    const int64_t area = setup_area(a, b, c);
    int32_t x0, x1, y0, y1;
    if (area == 0 || (d->cull && (area > 0) != d->mirrored)) {
        return 1;
    }
    *seen = 1;
    span_of_tiles(&x0, &x1, mini(a->x_24_8, mini(b->x_24_8, c->x_24_8)), maxi(a->x_24_8, maxi(b->x_24_8, c->x_24_8)),
                  d->job.origin_x, p->width);
    span_of_tiles(&y0, &y1, mini(a->y_24_8, mini(b->y_24_8, c->y_24_8)), maxi(a->y_24_8, maxi(b->y_24_8, c->y_24_8)),
                  d->job.origin_y, p->height);
    if (x0 > x1 || y0 > y1 || p->is_full) {
        return 1;
    }
    for (int32_t i = y0 >> p->shift; i <= y1 >> p->shift; ++i) {
        if (!put_large(p, &p->bins[i], large)) {
            return 0;
        }
    }
    return 1;
}

/* Adds triangle k of a batch, with this id, as the triangles that clipping leaves. */
static int put_other(bin_pool *p, const lmb_draw_instance *d, const lmb_bin_batch *from, int k, uint32_t id, int *seen)
{
    const uint32_t whole = from->whole & ~from->sets.small;
    lmb_screen_vertex corner[LMB_CLIP_MAX];
    bin_large large;
    int n = 3;
    if (whole >> k & 1u) {
        corner[0].x_24_8 = from->block.x[k], corner[0].y_24_8 = from->block.y[k], corner[0].d = from->block.d[0][k];
        corner[1].x_24_8 = from->b[0][k], corner[1].y_24_8 = from->b[1][k], corner[1].d = from->block.d[1][k];
        corner[2].x_24_8 = from->c[0][k], corner[2].y_24_8 = from->c[1][k], corner[2].d = from->block.d[2][k];
    } else {
        n = lmb_one_corners(corner, d, id);
    }
    large.id = id;
    large.flags = (d->masked ? LARGE_IS_MASKED : 0u) | (d->blends ? LARGE_BLENDS : 0u);
    large.before = 0;
    for (int i = 2; i < n; ++i) {
        large.corner[0] = corner[0], large.corner[1] = corner[i - 1], large.corner[2] = corner[i];
        if (!put_large_triangle(p, d, &large, seen)) {
            return 0;
        }
    }
    return 1;
}

/* Adds a small triangle to each bin of its rows. */
static inline int put_rows(bin_pool *p, const lmb_bin_batch *from, int k, uint32_t id)
{
    for (int32_t i = from->y0[k] >> p->shift; i <= from->y1[k] >> p->shift; ++i) {
        if (!put_small(p, &p->bins[i], &from->block, k, id)) {
            return 0;
        }
    }
    return 1;
}

/* State of a build. */
typedef struct bin_builder {
    bin_pool pool;
    lmb_bins *bins;
    const lmb_kernels *kernels;
    const lmb_cluster *clusters; /* of the instance, or NULL */
    lmb_stats *stats;
    lmb_fill_window frame;
    lmb_bin_batch batch;
} bin_builder;

/* Adds the triangle to bins, if there is memory. */
static void put_in_bin(bin_builder *b, const lmb_draw_instance *d, int k, uint32_t id, int is_other, uint32_t *drawn)
{
    bin_pool *p = &b->pool;
    int seen = 0, fits;
    if (is_other) {
        fits = put_other(p, d, &b->batch, k, id, &seen);
        *drawn += (uint32_t)seen;
    } else {
        fits = p->is_full || put_rows(p, &b->batch, k, id);
    }
    if (!fits) {
        p->is_full = 1;
        b->bins->past_id = id;
    }
}

/* Number of bits in a set. */
static uint32_t set_size(uint32_t bits) { return (uint32_t)count_bits_16(bits); }

static void build_batch(bin_builder *b, const lmb_draw_instance *d, uint32_t id, uint32_t count)
{
    const lmb_batch_sets *sets = &b->batch.sets;
    b->kernels->bin_snap(&b->batch, &d->job, d->mesh, id - d->first_id, count);
    const uint32_t other = sets->other | (d->masked ? sets->small : 0);
    uint32_t drawn = set_size(d->masked ? sets->drawn & ~sets->small : sets->drawn);
    for (uint32_t left = sets->small | other; left != 0; left &= left - 1) {
        const int k = lowest_bit(left);
        put_in_bin(b, d, k, id + (uint32_t)k, (int)(other >> k & 1u), &drawn);
    }
    if (b->stats != NULL) {
        b->stats->triangles += count;
        b->stats->triangles_dropped += set_size((((1u << count) - 1) & ~sets->in) | sets->dropped);
        b->stats->triangles_drawn += drawn;
    }
}

/* Triangles first .. past - 1 of an instance, in batches; skips clusters outside the frame. */
static void build_instance(bin_builder *b, const lmb_draw_instance *d, uint32_t first, uint32_t past)
{
    while (first < past && !(b->pool.is_full && b->stats == NULL)) {
        const uint32_t at = first - d->first_id, left = past - first;
        const uint32_t rest = LMB_CLUSTER - at % LMB_CLUSTER, of_cluster = rest < left ? rest : left;
        uint32_t count = left < LMB_BATCH ? left : LMB_BATCH;
        if (b->clusters != NULL) {
            const int hidden = at % LMB_CLUSTER == 0 && lmb_cluster_is_hidden(&b->clusters[at / LMB_CLUSTER], &d->job,
                                                                              &b->frame, b->kernels);
            count = hidden || of_cluster < count ? of_cluster : count;
            if (hidden) {
                if (b->stats != NULL) {
                    b->stats->triangles += count;
                }
                first += count;
                continue;
            }
        }
        build_batch(b, d, first, count);
        first += count;
    }
}

/* An instance in a window without memory, as large as windows may be. */
NOINLINE void set_bin_instance(lmb_draw_instance *out, const lmb_bins *bins, const lmb_instance *instance)
{
    lmb_target frame;
    lmb_fill_context c;
    memset(&frame, 0, sizeof frame);
    frame.depth.width = with_last_tile(bins->view.frame_width);
    frame.depth.height = with_last_tile(bins->view.frame_height);
    c.target = &frame;
    c.view = &bins->view;
    c.scene = bins->scene;
    lmb_draw_instance_set(out, &c, instance, bins->flags);
}

/* The frame in which clusters are tested. */
static void set_bin_frame(bin_builder *b, const lmb_view *view)
{
    memset(&b->frame, 0, sizeof b->frame);
    b->frame.tiles_x = (with_last_tile(view->frame_width) + LMB_TILE - 1) / LMB_TILE;
    b->frame.tiles_y = (with_last_tile(view->frame_height) + LMB_TILE - 1) / LMB_TILE;
    b->frame.origin_x = view_origin_x(view);
    b->frame.origin_y = view_origin_y(view);
}

static void build_all(bin_builder *b, const lmb_culling *culling)
{
    const lmb_bins *bins = b->bins;
    const lmb_scene *scene = bins->scene;
    const lmb_instance *instance = lmb_instance_of(scene, bins->first_id);
    lmb_cluster_place place = {NULL, 0, 0, 0};
    if (instance == NULL) {
        return;
    }
    const lmb_instance *end = scene->instances + scene->instance_count;
    set_bin_frame(b, &bins->view);
    for (; instance < end && instance->first_id < bins->end_id; ++instance) {
        const uint32_t past = instance->first_id + scene->meshes[instance->mesh].triangle_count;
        lmb_draw_instance d;
        set_bin_instance(&d, bins, instance);
#if LMB_PLAIN_LANES == 1
        memset(b->batch.sets.kept, 0, sizeof b->batch.sets.kept);
#endif
        b->clusters = culling != NULL && culling->clusters != NULL
                          ? lmb_cluster_find(&place, culling, scene, instance->mesh)
                          : NULL;
        build_instance(b, &d, bins->first_id > instance->first_id ? bins->first_id : instance->first_id,
                       past < bins->end_id ? past : bins->end_id);
    }
}

/* Fills empty places in each bin's last block with valid numbers. */
static void fill_up(const bin_pool *p, uint32_t bins)
{
    for (uint32_t n = 0; n < bins; ++n) {
        const uint32_t used = p->bins[n].count[SMALL_BLOCKS] % LMB_BATCH;
        lmb_bin_block *b = &p->block[p->bins[n].last[SMALL_BLOCKS]];
        for (uint32_t i = used; used != 0 && i < LMB_BATCH; ++i) {
            b->x[i] = b->y[i] = b->to_b[i] = b->to_c[i] = 0;
            b->d[0][i] = b->d[1][i] = b->d[2][i] = 0.0f;
            b->id[i] = 0;
        }
    }
}

lmb_status lmb_bins_build(lmb_bins *bins, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                          uint32_t first_id, uint32_t count, uint32_t flags, const lmb_culling *culling,
                          lmb_stats *stats)
{
    bin_builder b;
    if (bins == NULL || kernels == NULL || view == NULL || scene == NULL || first_id == 0 ||
        !lmb_view_is_valid(view)) {
        return LMB_ERR_ARG;
    }
    if (culling != NULL && culling->clusters != NULL && culling->cluster_count < lmb_culling_clusters(scene)) {
        return LMB_ERR_CAPACITY;
    }
    bins->scene = scene;
    bins->view = *view;
    bins->flags = flags;
    bins->first_id = first_id;
    bins->end_id = bins->past_id = count > UINT32_MAX - first_id ? UINT32_MAX : first_id + count;
    b.bins = bins;
    b.kernels = kernels;
    b.stats = stats;
    memset(&b.pool, 0, sizeof b.pool);
    if (pool_find(&b.pool, bins)) {
        memset(b.pool.bins, 0, bin_count(view) * sizeof(bin));
    } else {
        b.pool.is_full = 1; /* triangles are only counted */
        bins->past_id = first_id;
    }
    build_all(&b, culling);
    if (bins->past_id > first_id) {
        fill_up(&b.pool, bin_count(view));
    }
    return LMB_OK;
}

/* --- out of bins -------------------------------------------------------------------------------------------------- */

/* State for drawing one bin. */
typedef struct bin_drawing {
    lmb_fill_context context;
    lmb_setup_job job;
    const bin_pool *pool;
    const bin *from;
    uint32_t large, large_block; /* the next large one: index and block */
    uint32_t asked, asks;        /* tested blocks; blocks still to be tested */
} bin_drawing;

static void draw_large(const lmb_fill_context *c, const bin_large *l)
{
    lmb_setup setup;
    (void)lmb_setup_triangle(&setup, &l->corner[0], &l->corner[1], &l->corner[2]); /* with area: put_large_triangle */
    if (l->flags & LARGE_IS_MASKED) {
        lmb_fill_masked(c, &setup, l->id, LMB_MULTISAMPLE && (l->flags & LARGE_BLENDS) != 0);
    } else {
        fill_one(c, &setup, l->id);
    }
}

/* The next large triangle if it precedes the bin's small one number `past`; otherwise NULL. */
static const bin_large *next_large(bin_drawing *d, uint32_t past)
{
    const uint32_t i = d->large % LARGES_A_BLOCK;
    if (d->large == d->from->count[LARGE_BLOCKS]) {
        return NULL;
    }
    const bin_large *large = (const bin_large *)(const void *)&d->pool->block[d->large_block] + i;
    if (large->before >= past) {
        return NULL;
    }
    ++d->large;
    d->large_block = i == LARGES_A_BLOCK - 1 ? d->pool->next[d->large_block] : d->large_block;
    return large;
}

/* A block of `count` small triangles after `first` earlier ones, and the large ones between them. Without ids the large
 * ones come first, because the nearest depth is the same in any order. */
static void draw_block(bin_drawing *d, lmb_batch *batch, const lmb_bin_block *block, uint32_t first, uint32_t count,
                       int hidden)
{
    const lmb_fill_context *c = &d->context;
    const int ordered = c->target->id.data != NULL;
    uint32_t done = 0;
    if (!hidden) {
        c->kernels->bin_setup(batch, &d->job, block, count);
    }
    for (const bin_large *l; (l = next_large(d, first + count)) != NULL;) {
        const uint32_t before = ((1u << (l->before - first)) - 1) & ~done;
        if (ordered && before != 0 && !hidden) {
            fill_batch(c, batch, batch->sets.small & before);
            done |= before;
        }
        draw_large(c, l);
    }
    if (!hidden) {
        fill_batch(c, batch, batch->sets.small & ~done);
    }
}

/* 1 if drawn surfaces hide all of a full block. Tests each fourth block, and blocks that follow a hidden one. */
static int is_block_hidden(bin_drawing *d, const lmb_bin_block *block)
{
    enum { EACH = 4, AFTER = 16 };
    const lmb_fill_context *c = &d->context;
    lmb_tile_box box;
    if (c->window.farthest == NULL || (d->asks == 0 && ++d->asked % EACH != 0)) {
        return 0;
    }
    const float nearest = c->kernels->bin_box(&box, &d->job, block);
    const int hidden = c->kernels->culled_box(&c->window, &box, lmb_depth_as_held(&c->window, nearest));
    d->asks = hidden ? (uint32_t)AFTER : d->asks - (d->asks > 0);
    return hidden;
}

static void draw_bin(bin_drawing *d)
{
    const bin_pool *p = d->pool;
    const uint32_t count = d->from->count[SMALL_BLOCKS];
    lmb_batch batch;
    d->asked = d->asks = 0;
    d->large = 0;
    d->large_block = d->from->first[LARGE_BLOCKS];
    for (uint32_t n = 0, i = d->from->first[SMALL_BLOCKS]; n < count; n += LMB_BATCH, i = p->next[i]) {
        const uint32_t own = count - n < LMB_BATCH ? count - n : LMB_BATCH;
        block_soon(p, p->next[i]);
        draw_block(d, &batch, &p->block[i], n, own, own == LMB_BATCH && is_block_hidden(d, &p->block[i]));
    }
    for (const bin_large *l; (l = next_large(d, UINT32_MAX)) != NULL;) {
        draw_large(&d->context, l);
    }
}

/* A window's tile rows first .. first + count - 1, which lie in one bin. */
static void set_bin_rows(bin_drawing *out, lmb_target *rows, const lmb_target *target, const lmb_bins *bins,
                         int32_t first, int32_t count, const lmb_culling *culling)
{
    const lmb_view *view = &bins->view;
    lmb_setup_job *job = &out->job;
    lmb_target_rows(rows, target, first, count);
    out->context.target = rows;
    out->context.view = view;
    out->context.scene = bins->scene;
#if LMB_TREES
    out->context.is_ahead = 0;
#endif
    out->context.culling = culling;
    out->context.window = lmb_target_window(rows, view);
    out->context.window.farthest = NULL;
    if (culling != NULL && culling->farthest != NULL) {
        out->context.window.farthest = culling->farthest + (ptrdiff_t)first * out->context.window.tiles_x;
    }
    memset(job, 0, sizeof *job);
    job_window(job, view, rows);
}

static void clear_rows(const bin_drawing *d)
{
    const lmb_fill_context *c = &d->context;
    const lmb_fill_window *w = &c->window;
    lmb_surface_clear(&c->target->depth);
    if (c->target->id.data != NULL) {
        lmb_surface_clear(&c->target->id);
    }
    if (w->farthest != NULL) {
        memset(w->farthest, 0, (size_t)w->tiles_x * (size_t)w->tiles_y * sizeof *w->farthest);
    }
}

/* Draws the binned triangles of `count` bins, one bin after another. A separate function, because draw_rest needs the
 * stack, too. */
NOINLINE void draw_bin_rows(const lmb_target *target, const lmb_kernels *kernels, const lmb_bins *bins, int32_t count,
                            int32_t clear, const lmb_culling *culling)
{
    const int shift = rows_shift(&bins->view);
    const int32_t end = target->y0 + target->depth.height;
    for (int32_t y = target->y0, past; y < end; y = past) {
        bin_drawing d;
        lmb_target rows;
        past = mini(((y >> shift) + 1) << shift, end);
        for (int32_t i = 0; i < count; ++i) {
            bin_pool pool;
            set_bin_rows(&d, &rows, target, &bins[i], (y - target->y0) / LMB_TILE, (past - y + LMB_TILE - 1) / LMB_TILE,
                         culling);
            d.context.kernels = kernels;
            if (clear && i == 0) {
                clear_rows(&d);
            }
            if (bins[i].past_id > bins[i].first_id && pool_find(&pool, &bins[i])) {
                d.pool = &pool;
                d.from = &pool.bins[y >> shift];
                draw_bin(&d);
            }
        }
    }
}

/* Draws the triangles that did not fit into bins. */
static lmb_status draw_rest(const lmb_target *target, const lmb_kernels *kernels, const lmb_bins *b,
                            const lmb_culling *culling)
{
    const uint32_t left = b->end_id - b->past_id;
    return culling == NULL
               ? lmb_draw(target, kernels, &b->view, b->scene, b->past_id, left, b->flags, NULL)
               : lmb_draw_culled(target, kernels, &b->view, b->scene, b->past_id, left, b->flags, 0, culling, NULL);
}

static lmb_status check_draw(const lmb_target *target, const lmb_kernels *kernels, const lmb_bins *bins, int32_t count,
                             const lmb_culling *culling)
{
    if (target == NULL || kernels == NULL || bins == NULL || count < 1) {
        return LMB_ERR_ARG;
    }
    for (int32_t i = 0; i < count; ++i) {
        const lmb_view *v = &bins[i].view;
        if (bins[i].scene == NULL || bins[i].first_id == 0 || v->frame_width != bins->view.frame_width ||
            v->frame_height != bins->view.frame_height) {
            return LMB_ERR_ARG;
        }
        const lmb_status status = lmb_target_check(target, v, lmb_scene_triangles(bins[i].scene));
        if (status != LMB_OK) {
            return status;
        }
        if (culling != NULL && culling->clusters != NULL &&
            culling->cluster_count < lmb_culling_clusters(bins[i].scene)) {
            return LMB_ERR_CAPACITY;
        }
    }
    return culling != NULL && culling->farthest != NULL && culling->tiles < lmb_culling_tiles(target)
               ? LMB_ERR_CAPACITY
               : LMB_OK;
}

lmb_status lmb_bins_draw(const lmb_target *target, const lmb_kernels *kernels, const lmb_bins *bins, int32_t count,
                         int32_t clear, const lmb_culling *culling)
{
    lmb_status status = check_draw(target, kernels, bins, count, culling);
    for (int32_t from = 0, to; status == LMB_OK && from < count; from = to) {
        int fits;
        to = from;
        do {
            fits = bins[to].past_id >= bins[to].end_id;
        } while (++to < count && fits);
        draw_bin_rows(target, kernels, bins + from, to - from, clear && from == 0, culling);
        if (!fits) {
            status = draw_rest(target, kernels, &bins[to - 1], culling);
        }
    }
    return status;
}
#endif
