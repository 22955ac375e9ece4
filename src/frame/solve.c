/* solve.c: runs the stages of the light solution; the frame's solver does those of bounced light. Layer 8. [V33 V34] */

#include "../base/vec.h"
#include "../bounce/points.h"
#include "../occlusion/build.h"
#include "requires.h"
#include "solver.h"
#include "stages.h"

const frame_solver *lmb_solver_of(const lmb_frame *f)
{
#if LMB_TRANSFER
    if (requires_transfer(f)) {
        return &lmb_solver_transfer;
    }
#endif
#if LMB_LIVE
    if (requires_live(f)) {
        return &lmb_solver_live;
    }
#endif
#if LMB_TREES
    if (requires_cut(f)) {
        return &lmb_solver_cut;
    }
#endif
#if LMB_BOUNCE
    if (requires_groups(f)) {
        return &lmb_solver_groups;
    }
#endif
    (void)f;
    return NULL;
}

/* --- by steps ----------------------------------------------------------------------------------------------------- */

static lmb_status step_shadow_map(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    if (r->light == f->scene->light_count) {
        return LMB_OK;
    }
    if (light_is(r, r->light, LMB_SHADOW_MAP_REUSED)) {
        ++r->light;
        return LMB_MORE;
    }
    if (r->progress == 0) {
        lmb_shadow_map_clear(&r->maps[r->light]);
    }
    lmb_status status = lmb_shadow_map_draw(&r->maps[r->light], f->kernels, f->scene, r->progress + 1,
                                            (uint32_t)units * UNIT_TRIANGLES, f->stats);
    r->progress += (uint32_t)units * UNIT_TRIANGLES;
    if (r->progress >= r->triangles) {
        r->progress = 0;
        ++r->light;
    }
    return status != LMB_OK ? status : LMB_MORE;
}

static lmb_status step_bvh(lmb_render *r)
{
    lmb_frame *f = &r->frame;
#if LMB_FACETS
    const int fast = requires_bvh(f) && !requires_full_bvh(f);
    r->reuses = fast ? r->reuses | BUILT_FAST : r->reuses & ~BUILT_FAST;
#endif
    if (!requires_bvh(f) || reuses(r, LMB_REUSE_BVH)) {
        return LMB_OK;
    }
#if LMB_FACETS
    /* Few segments are traced, so a fast build is best. */
    if (fast && lmb_bvh_build_in_order(&f->bvh, f->scene)) {
        return LMB_OK;
    }
#endif
    const lmb_status status = lmb_bvh_build(&f->bvh, f->scene);
    f->bvh.hull.count = f->run_all ? 0 : f->bvh.hull.count;
    return status;
}

/* Is the current face of the shadow map drawn? Others have no first points. */
static int is_drawn(const lmb_render *r) { return (r->maps[r->light].drawn >> r->face & 1u) != 0; }

/* Ends the current face, and goes on to the next one. */
static lmb_status end_face(lmb_render *r, const frame_solver *solver)
{
    const lmb_status status = is_drawn(r) && solver->end_face != NULL ? solver->end_face(r) : LMB_OK;
    r->progress = 0;
    if (++r->face >= (uint32_t)r->maps[r->light].faces) {
        r->face = 0;
        ++r->light;
    }
    return status;
}

static lmb_status step_points(lmb_render *r, const frame_solver *solver, int32_t units)
{
    lmb_frame *f = &r->frame;
    if (solver->begin != NULL && r->light + r->face + r->progress == 0) {
        const lmb_status status = solver->begin(r);
        if (status != LMB_OK) {
            return status;
        }
    }
    if (skips(r, LMB_SKIP_BOUNCE) || reuses(r, LMB_REUSE_POINTS)) {
        return LMB_OK;
    }
    if (r->light == f->scene->light_count) {
        return solver->end_points != NULL ? solver->end_points(r, units) : LMB_OK;
    }
    if (light_is(r, r->light, LMB_LIGHT_TEXELS_REUSED | LMB_LIGHT_DIM)) {
        f->tree.faces += faces_that_bounce(r, r->light);
        ++r->light;
        return LMB_MORE;
    }
    const int32_t rows = r->maps[r->light].size / LMB_TILE, past = mini(rows, (int32_t)r->progress + units);
    const int32_t first = (int32_t)r->progress;
    lmb_status status = !is_drawn(r)           ? LMB_OK
                        : solver->rows != NULL ? solver->rows(r, &f->scratch->tile, first, past)
                                               : solver->collect(r, first, past);
    if (status == LMB_OK) {
        r->progress = (uint32_t)past;
        status = past == rows ? end_face(r, solver) : LMB_OK;
    }
    return status != LMB_OK ? status : LMB_MORE;
}

lmb_status lmb_render_solve(lmb_render *r, int32_t units)
{
    const frame_solver *solver = lmb_solver_of(&r->frame);
    if (r->stage == LMB_STAGE_SHADOW_MAP) {
        return step_shadow_map(r, units);
    }
    if (r->stage == LMB_STAGE_BVH) {
        return step_bvh(r);
    }
    if (solver == NULL) {
        return LMB_OK;
    }
    return r->stage == LMB_STAGE_POINTS   ? step_points(r, solver, units)
           : r->stage == LMB_STAGE_GROUPS ? solver->build(r)
           : solver->step != NULL         ? solver->step(r, solver, units)
                                          : LMB_OK;
}

/* --- in parts ----------------------------------------------------------------------------------------------------- */

/* Tile rows of a light's shadow map that must be drawn. */
static int64_t rows_of(const lmb_render *r, uint32_t light)
{
    const int64_t rows = r->frame.shadow_map / LMB_TILE;
    return light_is(r, light, LMB_SHADOW_MAP_REUSED) ? 0 : r->maps[light].faces * rows;
}

/* Tile rows are counted through all faces of all shadow maps, so that parts stay balanced with many lights. */
static lmb_status part_shadow_map(const lmb_render *r, int32_t part, int32_t parts, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    int64_t first, past, all = 0, before = 0;
    lmb_status status = LMB_OK;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        all += rows_of(r, i);
    }
    share_out(&first, &past, all, part, parts);
    for (uint32_t i = 0; i < f->scene->light_count && status == LMB_OK; ++i) {
        const int64_t own = rows_of(r, i);
        const int64_t from = first > before ? first - before : 0, to = past - before < own ? past - before : own;
        if (from < to) {
            status = lmb_shadow_map_rows(&r->maps[i], f->kernels, f->scene, (int32_t)from, (int32_t)to, stats);
        }
        before += own;
    }
    return status;
}

int lmb_render_solve_has_parts(const lmb_render *r)
{
    const frame_solver *solver = lmb_solver_of(&r->frame);
    if (r->stage == LMB_STAGE_SHADOW_MAP) {
        return r->light == 0 && r->progress == 0;
    }
    if (solver == NULL || r->progress != 0) {
        return 0;
    }
    if (r->stage == LMB_STAGE_BOUNCES) {
        return solver->receive != NULL && has_bounces(r);
    }
    return r->stage == LMB_STAGE_POINTS && !skips(r, LMB_SKIP_BOUNCE) && !reuses(r, LMB_REUSE_POINTS) &&
           r->light < r->frame.scene->light_count &&
           !light_is(r, r->light, LMB_LIGHT_TEXELS_REUSED | LMB_LIGHT_DIM) &&
           (solver->rows != NULL || (solver->has_parts != NULL && solver->has_parts(r)));
}

static lmb_status part_points(const lmb_render *r, const frame_solver *solver, lmb_tile *tile, int32_t part,
                              int32_t parts)
{
    int64_t first, past;
    if (!is_drawn(r)) {
        return LMB_OK;
    }
    if (solver->rows == NULL) {
        return solver->part(r, tile, part, parts);
    }
    share_out(&first, &past, r->maps[r->light].size / LMB_TILE, part, parts);
    return solver->rows(r, tile, (int32_t)first, (int32_t)past);
}

lmb_status lmb_render_solve_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                                 lmb_stats *stats)
{
    const frame_solver *solver = lmb_solver_of(&r->frame);
    if (r->stage == LMB_STAGE_SHADOW_MAP) {
        return part_shadow_map(r, part, parts, stats);
    }
    if (solver == NULL) {
        return LMB_ERR_ARG;
    }
    if (r->stage == LMB_STAGE_POINTS) {
        return part_points(r, solver, &scratch->tile, part, parts);
    }
#if LMB_TREES
    return lmb_solve_elements_part(r, solver, scratch, part, parts, stats);
#else
    return LMB_ERR_ARG;
#endif
}

/* Ends the face's parts; LMB_MORE if another face is left. */
static lmb_status end_parts_of_face(lmb_render *r, int32_t parts)
{
    const frame_solver *solver = lmb_solver_of(&r->frame);
    if (solver == NULL) {
        return LMB_ERR_ARG;
    }
    if (solver->join != NULL && is_drawn(r)) {
        solver->join(r, parts);
    }
    const lmb_status status = end_face(r, solver);
    return status != LMB_OK ? status : r->light < r->frame.scene->light_count ? LMB_MORE : LMB_OK;
}

lmb_status lmb_render_solve_on(lmb_render *r, int32_t parts)
{
    if (r->stage == LMB_STAGE_POINTS) {
        return end_parts_of_face(r, parts);
    }
#if LMB_TREES
    if (r->stage == LMB_STAGE_BOUNCES) {
        return lmb_solve_elements_end(r, lmb_solver_of(&r->frame));
    }
#endif
    return LMB_OK;
}

float lmb_render_solve_done(const lmb_render *r)
{
    const frame_solver *solver = lmb_solver_of(&r->frame);
    return solver != NULL && solver->done != NULL ? solver->done(r) : 0.0f;
}
