/* warp.c: a tile of the simple model becomes one of the complex surface: which views, then the kernel. Layer 5.
 * [P2 P3 P5 P6 P11 P12] */
#include <lambent/relief.h>

#include <string.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../raster/target.h"
#include "../raster/tile.h"
#include "mend.h"

#if LMB_RELIEF

enum { DEFAULT_WARP_STEPS = 6, MAX_WARP_STEPS = 32, DEFAULT_LOOKED_VIEWS = 6, DEFAULT_KEPT_VIEWS = 3 };

static int in_range(int32_t v, int32_t max) { return v >= 0 && v <= max; }

static int is_how(const lmb_relief_how *h)
{
    return in_range(h->steps, MAX_WARP_STEPS) && in_range(h->pick, LMB_RELIEF_EYE_RAY) && in_range(h->sampling, 1) &&
           in_range(h->views, LMB_RELIEF_TILE_VIEWS) && in_range(h->keep, DEFAULT_KEPT_VIEWS);
}

/* Sets all fields except the views. If texels are drawn as they are, only one view is kept. */
static void set_warp_job(lmb_relief_job *job, const lmb_relief *relief, const lmb_view *view, const lmb_relief_how *how)
{
    const float wide = 2.0f * view->half_width / (float)view->frame_width,
                high = 2.0f * view->half_height / (float)view->frame_height;
    job->count = job->outside = 0;
    job->format = relief->format;
    job->steps = how->steps != 0 ? how->steps : DEFAULT_WARP_STEPS;
    job->pick = how->pick;
    job->sampling = how->sampling;
    job->as_is = job->steps == 1 || job->sampling;
    job->keep = job->as_is ? 1 : how->keep != 0 ? how->keep : DEFAULT_KEPT_VIEWS;
    job->eye = view->eye;
    job->back = view->back;
    job->perspective = view->kind == LMB_PERSPECTIVE;
    job->pixel = maxf(wide, high);
}

/* Adds the views with directions nearest to the eye's: they see past the same edges as the eye. */
static void add_aligned(lmb_relief_job *job, const lmb_tile *tile, const lmb_relief *relief, int32_t max)
{
    int k = 0;
    while (k < LMB_TILE_PIXELS - 1 && tile->id[k] == 0) {
        ++k;
    }
    const lmb_vec3 at = tile_vec(tile->position, k);
    const lmb_vec3 towards = job->perspective ? normalize3(sub3(job->eye, at)) : job->back;
    while (job->count < mini(max, relief->views)) {
        float best = -2.0f;
        const lmb_relief_view *which = NULL;
        for (int32_t i = 0; i < relief->views; ++i) {
            const lmb_relief_view *v = &relief->view[i];
            const float d = dot3(towards, v->perspective ? normalize3(sub3(v->eye, at)) : v->back);
            int known = 0;
            for (int32_t c = 0; c < job->count; ++c) {
                known |= job->view[c] == v;
            }
            if (!known && (which == NULL || d > best)) { /* a NaN position needs views too */
                best = d;
                which = v;
            }
        }
        job->view[job->count++] = which;
    }
}

/* Adds the views that suit the most pixels; ties go to the first. */
static void choose_views(lmb_relief_job *job, const lmb_tile *tile, const lmb_kernels *kernels,
                         const lmb_relief *relief, int32_t max)
{
    uint8_t votes[LMB_RELIEF_VIEWS];
    memset(votes, 0, sizeof votes);
    kernels->relief_rank(votes, tile, relief, job);
    add_aligned(job, tile, relief, max < 4 ? 1 : 2);
    job->aligned = job->count;
    for (int32_t i = 0; i < job->count; ++i) {
        votes[job->view[i] - relief->view] = 0;
    }
    while (job->count < max) {
        int32_t first = 0;
        for (int32_t i = 1; i < relief->views; ++i) {
            first = votes[i] > votes[first] ? i : first;
        }
        if (votes[first] == 0) {
            return;
        }
        job->view[job->count++] = &relief->view[first];
        votes[first] = 0;
    }
}

static void clear_pixel(lmb_tile *t, int k)
{
    for (int c = 0; c < 3; ++c) {
        t->position[c][k] = t->face[c][k] = t->normal[c][k] = t->albedo[c][k] = 0.0f;
    }
    t->depth[k] = t->uv[0][k] = t->uv[1][k] = 0.0f;
    t->id[k] = 0;
    --t->hits;
}

static void add_stats(lmb_relief_stats *stats, const lmb_relief_found *found, int32_t pixels)
{
    const uint64_t all = (uint64_t)pixels, hits = (uint64_t)count_bits_64(found->hit),
                   missed = (uint64_t)count_bits_64(found->missed);
    stats->pixels += all;
    stats->hits += hits;
    stats->missed += missed;
    stats->holes += all - hits - missed;
}

lmb_status lmb_relief_tile(lmb_tile *inout, const lmb_kernels *kernels, const lmb_relief *relief,
                           const lmb_view *view, const lmb_relief_how *how, lmb_relief_stats *stats)
{
    const lmb_relief_how usual = {0, 0, 0, 0, 0};
    lmb_relief_job job;
    lmb_relief_found found = {0, 0};
    how = how != NULL ? how : &usual;
    if (inout == NULL || kernels == NULL || relief == NULL || view == NULL || !lmb_view_is_valid(view) ||
        !is_how(how)) {
        return LMB_ERR_ARG;
    }
    uint64_t covered = 0;
    if (inout->hits == 0) {
        return LMB_OK;
    }
    set_warp_job(&job, relief, view, how);
    choose_views(&job, inout, kernels, relief, how->views != 0 ? how->views : DEFAULT_LOOKED_VIEWS);
    for (int32_t i = 0; i < job.count; ++i) {
        job.outside |= !job.view[i]->perspective;
    }
    if (job.count > 0) {
        kernels->relief_warp(&found, inout, &job);
    }
    if (!job.as_is) {
        lmb_relief_mend(inout, &found, &job, view);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        covered |= (uint64_t)(inout->id[k] != 0) << k;
    }
    inout->hits = count_bits_64(covered);
    for (uint64_t bits = found.missed; bits != 0; bits &= bits - 1) {
        clear_pixel(inout, lowest_bit_64(bits));
    }
    if (stats != NULL) {
        add_stats(stats, &found, count_bits_64(covered));
    }
    return LMB_OK;
}

static void take_warped_pixel(lmb_tile *t, const lmb_tile *from, int k)
{
    for (int c = 0; c < 3; ++c) {
        t->position[c][k] = from->position[c][k];
        t->face[c][k] = from->face[c][k];
        t->normal[c][k] = from->normal[c][k];
        t->albedo[c][k] = from->albedo[c][k];
    }
    t->depth[k] = from->depth[k];
    t->uv[0][k] = from->uv[0][k];
    t->uv[1][k] = from->uv[1][k];
    t->hits += t->id[k] == 0;
    t->id[k] = LMB_MAX_TRIANGLES;
}

void lmb_relief_nearer(lmb_tile *inout, const lmb_tile *other)
{
    for (int k = 0; inout != NULL && other != NULL && k < LMB_TILE_PIXELS; ++k) {
        if (other->id[k] != 0 && (inout->id[k] == 0 || other->depth[k] < inout->depth[k])) {
            take_warped_pixel(inout, other, k);
        }
    }
}

#endif
