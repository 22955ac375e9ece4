/* solve.c: the stages of the light, by steps and in parts. Floor 10.                                     [V33 V34] */
#include "../base/vec.h"
#include "../bounce/points.h"
#include "stages.h"
#include "wants.h"

#define ELEMENT_ERROR 2.0f /* times a pixel's: a pixel sees the mean of many elements. At 4 spots lose 1 % of light */

/* --- by steps ----------------------------------------------------------------------------------------------------- */

static lmb_status step_light_map(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    if (r->light == f->scene->light_count) {
        return LMB_OK;
    }
    if (light_is(r, r->light, LMB_LIGHT_MAP_KEPT)) {
        ++r->light;
        return LMB_MORE;
    }
    if (r->place == 0) {
        lmb_light_map_clear(&r->maps[r->light]);
    }
    lmb_status status = lmb_light_map_draw(&r->maps[r->light], f->kernels, f->scene, r->place + 1,
                                           (uint32_t)units * UNIT_TRIANGLES, f->stats);
    r->place += (uint32_t)units * UNIT_TRIANGLES;
    if (r->place >= r->triangles) {
        r->place = 0;
        ++r->light;
    }
    return status != LMB_OK ? status : LMB_MORE;
}

static lmb_status step_blockers(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    if (!wants_blockers(f) || keeps(r, LMB_KEEP_BLOCKERS)) {
        return LMB_OK;
    }
    const lmb_status status = lmb_blockers_build(&f->blockers, f->scene);
    f->blockers.hull.count = f->everything ? 0 : f->blockers.hull.count;
    return status;
}

static lmb_status end_face(lmb_render *r)
{
    const lmb_light_map *map = &r->maps[r->light];
    const int drawn = (map->drawn >> r->face) & 1u;
    lmb_status status = LMB_OK;
    if (wants_cut(&r->frame)) {
        status = drawn ? lmb_tree_sum(&r->frame.tree, r->frame.tree.faces) : LMB_OK;
        r->frame.tree.faces += drawn ? 1 : 0;
    } else if (drawn) {
        status = lmb_discs_join(&r->frame.points, map, &r->frame.grouping);
    }
    r->place = 0;
    if (++r->face >= (uint32_t)map->faces) {
        r->face = 0;
        ++r->light;
    }
    return status;
}

static lmb_status step_points(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    if (!wants_bounce(f) || omits(r, LMB_OMIT_BOUNCE) || keeps(r, LMB_KEEP_POINTS) ||
        r->light == f->scene->light_count) {
        return LMB_OK;
    }
    if (light_is(r, r->light, LMB_LIGHT_TEXELS_KEPT | LMB_LIGHT_DIM)) {
        f->tree.faces += wants_cut(f) ? faces_that_bounce(r, r->light) : 0;
        ++r->light;
        return LMB_MORE;
    }
    const lmb_light_map *map = &r->maps[r->light];
    int32_t rows = map->size / LMB_TILE, last = mini(rows, (int32_t)r->place + units);
    uint32_t before = f->points.count;
    if ((map->drawn >> r->face) & 1u) {
        lmb_status status =
            wants_cut(f)
                ? lmb_tree_texels(&f->tree, f->kernels, &f->scratch->tile, f->scene, &f->scene->lights[r->light], map,
                                  (int32_t)r->face, f->tree.faces, (int32_t)r->place, last)
                : lmb_points_collect(&f->points, f->kernels, &f->scratch->tile, f->scene, &f->scene->lights[r->light],
                                     map, (int32_t)r->face, (int32_t)r->place, last, &f->grouping);
        if (status != LMB_OK) {
            return status;
        }
    }
    if (f->stats != NULL) {
        f->stats->first_points += f->points.count - before;
    }
    r->place = (uint32_t)last;
    if (last == rows) {
        lmb_status status = end_face(r);
        return status != LMB_OK ? status : LMB_MORE;
    }
    return LMB_MORE;
}

static lmb_status step_groups(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    if (wants_elements(r)) {
        return keeps(r, LMB_KEEP_BOUNCES) ? LMB_OK : lmb_elements_build(&f->elements, f->scene, &f->tree);
    }
    if (!wants_groups(f) || keeps(r, LMB_KEEP_POINTS)) {
        return LMB_OK;
    }
    return lmb_group_points(f->groups, &f->points, &f->grouping, f->stats);
}

/* What is there before any reflection: of what shines by itself, and of many lights. */
static lmb_status receive_direct(const lmb_render *r, const lmb_receiver *own, lmb_band_scratch *scratch,
                                 const lmb_cutting *cutting, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    const float error = (f->many_error > 0.0f ? f->many_error : 0.02f) * ELEMENT_ERROR;
    const lmb_many_look look = {f->many, f->blockers.triangle != NULL ? &f->blockers : NULL, error, 1};
    const lmb_status status =
        r->shines ? lmb_elements_receive(&f->elements, own, NULL, cutting, first, past) : LMB_OK;
    return status != LMB_OK || !wants_many_bounce(f)
               ? status
               : lmb_many_elements(&f->elements, own, &scratch->many, &look, first, past);
}

/* Elements first .. past - 1 receive, for the r->light'th time. First, where something shines by itself or many lights
 * do, what these send; next the first reflection of that, and of lamps, which the light's maps hold; then one
 * reflection after another. */
static lmb_status receive(const lmb_render *r, lmb_band_scratch *scratch, int32_t first, int32_t past, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    const lmb_cutting cutting = cutting_of(f, stats);
    const uint32_t direct = (uint32_t)sends_direct(r);
    lmb_receiver own;
    own.kernels = f->kernels;
    own.cut = &scratch->gather.cut;
    own.tile = &scratch->tile;
    own.received = &scratch->direct;
    own.fresh = &scratch->indirect;
    if (r->light < direct) {
        return receive_direct(r, &own, scratch, &cutting, first, past);
    }
    return lmb_elements_receive(&f->elements, &own, r->light == direct ? &f->tree : NULL, &cutting, first, past);
}

/* All elements have received. */
static lmb_status end_bounce(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    lmb_elements *e = &f->elements;
    const uint32_t direct = (uint32_t)sends_direct(r), pass = r->light;
    lmb_status status = pass == 0 && wants_many_bounce(f) ? lmb_many_elements_done(e) : LMB_OK;
    r->place = 0;
    ++r->light;
    if (status == LMB_OK && !has_bounces(r) && f->bounces > 1 && !f->truncated) {
        status = lmb_elements_rest(e, pass == direct ? &f->tree : NULL, LMB_MOST_BOUNCES - f->bounces);
    }
    status = status != LMB_OK ? status : lmb_elements_send(e, !has_bounces(r));
    return status != LMB_OK ? status : has_bounces(r) ? LMB_MORE : LMB_OK;
}

static lmb_status step_bounces(lmb_render *r, int32_t units)
{
    if (!has_bounces(r)) {
        return LMB_OK;
    }
    const int32_t tiles = lmb_elements_tiles(&r->frame.elements), first = (int32_t)r->place,
                  past = tiles - first < units ? tiles : first + units;
    const lmb_status status = receive(r, r->frame.scratch, first, past, r->frame.stats);
    r->place = (uint32_t)past;
    return status != LMB_OK ? status : past < tiles ? LMB_MORE : end_bounce(r);
}

lmb_status lmb_render_solve(lmb_render *r, int32_t units)
{
    switch (r->stage) {
    case LMB_STAGE_LIGHT_MAP:
        return step_light_map(r, units);
    case LMB_STAGE_BLOCKERS:
        return step_blockers(r);
    case LMB_STAGE_POINTS:
        return step_points(r, units);
    case LMB_STAGE_GROUPS:
        return step_groups(r);
    default:
        return step_bounces(r, units);
    }
}

/* --- in parts ----------------------------------------------------------------------------------------------------- */

/* Of a light whose map is drawn. */
static int64_t rows_of(const lmb_render *r, uint32_t light)
{
    const int64_t rows = r->frame.light_map / LMB_TILE;
    return light_is(r, light, LMB_LIGHT_MAP_KEPT) ? 0 : r->maps[light].faces * rows;
}

/* Tile rows counted through all faces of all lights' maps, so that many lights are shared out whole. */
static lmb_status part_light_map(const lmb_render *r, int32_t part, int32_t parts, lmb_stats *stats)
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
            status = lmb_light_map_rows(&r->maps[i], f->kernels, f->scene, (int32_t)from, (int32_t)to, stats);
        }
        before += own;
    }
    return status;
}

/* A row of blocks of the face at hand. Faces that are no part of the map have no points. */
static lmb_status part_points(const lmb_render *r, lmb_tile *tile, int32_t part, int32_t parts)
{
    const lmb_frame *f = &r->frame;
    const lmb_light_map *map = &r->maps[r->light];
    if (((map->drawn >> r->face) & 1u) == 0) {
        return LMB_OK;
    }
    if (wants_cut(f)) {
        int64_t first, past;
        share_out(&first, &past, map->size / LMB_TILE, part, parts);
        return lmb_tree_texels(&f->tree, f->kernels, tile, f->scene, &f->scene->lights[r->light], map, (int32_t)r->face,
                               f->tree.faces, (int32_t)first, (int32_t)past);
    }
    return lmb_points_part(&f->points, f->kernels, tile, f->scene, &f->scene->lights[r->light], map, (int32_t)r->face,
                           part, parts, &f->grouping);
}

static lmb_status part_bounces(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                               lmb_stats *stats)
{
    int64_t first, past;
    share_out(&first, &past, lmb_elements_tiles(&r->frame.elements), part, parts);
    return receive(r, scratch, (int32_t)first, (int32_t)past, stats);
}

lmb_status lmb_render_solve_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                                 lmb_stats *stats)
{
    switch (r->stage) {
    case LMB_STAGE_LIGHT_MAP:
        return part_light_map(r, part, parts, stats);
    case LMB_STAGE_POINTS:
        return part_points(r, &scratch->tile, part, parts);
    default:
        return part_bounces(r, scratch, part, parts, stats);
    }
}

/* The face's parts are done: LMB_MORE where another face waits. */
static lmb_status end_parts_of_face(lmb_render *r, int32_t parts)
{
    lmb_frame *f = &r->frame;
    const lmb_light_map *map = &r->maps[r->light];
    const uint32_t before = f->points.count;
    if (wants_groups(f) && (map->drawn >> r->face) & 1u) {
        lmb_points_put_together(&f->points, map, parts, &f->grouping);
    }
    if (f->stats != NULL) {
        f->stats->first_points += f->points.count - before;
    }
    const lmb_status status = end_face(r);
    return status != LMB_OK ? status : r->light < f->scene->light_count ? LMB_MORE : LMB_OK;
}

lmb_status lmb_render_solve_on(lmb_render *r, int32_t parts)
{
    return r->stage == LMB_STAGE_POINTS    ? end_parts_of_face(r, parts)
           : r->stage == LMB_STAGE_BOUNCES ? end_bounce(r)
                                           : LMB_OK;
}
