/* solve_groups.c: bounced light by groups of first points, the same for all pixels. Layer 8. [V31 V33 V34] */
#include "../bounce/points.h"
#include "requires.h"
#include "solver.h"
#include "stages.h"

#if LMB_BOUNCE

/* Places first points, groups, and the whole view's depth if the eye holds only bands. */
static lmb_status groups_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const int32_t block_side = f->grouping.block != 0 ? f->grouping.block : LMB_TILE;
    if (block_side < 1 || block_side > LMB_TILE || f->shadow_map % block_side != 0) {
        return LMB_ERR_ARG;
    }
    const uint32_t side = (uint32_t)(f->shadow_map / block_side);
    const uint64_t max = (uint64_t)side * side * 4u * lmb_frame_map_faces(f->scene),
                   n = s->points != 0 ? s->points : max;
    const size_t bytes = n <= UINT32_MAX ? lmb_points_bytes((uint32_t)n, side) : 0;
    if (bytes == 0) {
        return LMB_ERR_ARG;
    }
    void *points = lmb_frame_take(b, bytes);
    f->groups = (lmb_groups *)lmb_frame_take(b, sizeof *f->groups);
    lmb_status status = is_only_measured(b) ? LMB_OK : lmb_points_init(&f->points, (uint32_t)n, side, points, bytes);
    if (status == LMB_OK && s->by_bands) {
        const int32_t format = f->view.far_m > f->view.near_m ? LMB_DEPTH16 : LMB_DEPTH32F;
        status = lmb_frame_take_surface(&f->eye_depth, format, &f->view, f->view.frame_height, b);
    }
    return status;
}

static lmb_status groups_collect(lmb_render *r, int32_t first, int32_t past)
{
    lmb_frame *f = &r->frame;
    const uint32_t before = f->points.count;
    const lmb_status status =
        lmb_points_collect(&f->points, f->kernels, &f->scratch->tile, f->scene, &f->scene->lights[r->light],
                           &r->maps[r->light], (int32_t)r->face, first, past, &f->grouping);
    if (status == LMB_OK && f->stats != NULL) {
        f->stats->first_points += f->points.count - before;
    }
    return status;
}

static lmb_status groups_end_face(lmb_render *r)
{
    return lmb_discs_join(&r->frame.points, &r->maps[r->light], &r->frame.grouping);
}

static int groups_have_parts(const lmb_render *r)
{
    return lmb_points_have_room(&r->frame.points, &r->maps[r->light], &r->frame.grouping);
}

static lmb_status groups_part(const lmb_render *r, lmb_tile *tile, int32_t part, int32_t parts)
{
    const lmb_frame *f = &r->frame;
    return lmb_points_part(&f->points, f->kernels, tile, f->scene, &f->scene->lights[r->light], &r->maps[r->light],
                           (int32_t)r->face, part, parts, &f->grouping);
}

static void groups_join_parts(lmb_render *r, int32_t parts)
{
    lmb_frame *f = &r->frame;
    const uint32_t before = f->points.count;
    lmb_points_put_together(&f->points, &r->maps[r->light], parts, &f->grouping);
    if (f->stats != NULL) {
        f->stats->first_points += f->points.count - before;
    }
}

static lmb_status groups_build(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    return reuses(r, LMB_REUSE_POINTS) ? LMB_OK : lmb_group_points(f->groups, &f->points, &f->grouping, f->stats);
}

static lmb_status groups_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_occluder occluder;
    (void)glossy;
    (void)direct;
    occluder.view = &f->view;
    occluder.depth = occluding_depth(f);
    occluder.kind = f->occlusion;
    occluder.steps = f->steps;
    return lmb_gather_tile(inout, f->kernels, &s->gather.groups, tile, f->groups, &f->points, &occluder);
}

const frame_solver lmb_solver_groups = {
    .place = groups_place,
    .collect = groups_collect,
    .end_face = groups_end_face,
    .has_parts = groups_have_parts,
    .part = groups_part,
    .join = groups_join_parts,
    .build = groups_build,
    .tile = groups_tile,
};

#endif
