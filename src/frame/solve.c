/* solve.c: runs the stages of the light solution, by steps and in parts. Layer 8. [V33 V34] */

#include "../base/vec.h"
#include "../bounce/points.h"
#include "stages.h"
#include "requires.h"

/* Texels along each side of a map face that are collected into a transfer's elements: this many for one face, half for
 * six. With 128, small elements get no texel or one: rmse of the Cornell box .113; with 256, .08; with 512, .075. */
enum { COLLECTED = 256 };
#define UNIT_RECEIVERS 64u
#define ELEMENT_ERROR 2.0f /* times a pixel's: a pixel sees the mean of many elements. With 4 spots lose 1 % of light */

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
    if (!requires_bvh(f) || reuses(r, LMB_REUSE_BVH)) {
        return LMB_OK;
    }
    const lmb_status status = lmb_bvh_build(&f->bvh, f->scene);
    f->bvh.hull.count = f->run_all ? 0 : f->bvh.hull.count;
    return status;
}

static lmb_status end_face(lmb_render *r)
{
    const lmb_shadow_map *map = &r->maps[r->light];
    const int drawn = (map->drawn >> r->face) & 1u && !requires_transfer(&r->frame);
    lmb_status status = LMB_OK;
    if (requires_cut(&r->frame)) {
        status = drawn && requires_texels(r) ? lmb_tree_sum(&r->frame.tree, r->frame.tree.faces) : LMB_OK;
        r->frame.tree.faces += drawn ? 1 : 0;
    } else if (drawn && requires_groups(&r->frame)) {
        status = lmb_discs_join(&r->frame.points, map, &r->frame.grouping);
    }
    r->progress = 0;
    if (++r->face >= (uint32_t)map->faces) {
        r->face = 0;
        ++r->light;
    }
    return status;
}

static int32_t collected_each(const lmb_shadow_map *map)
{
    int32_t each = 1;
    while (map->size / each > (map->faces > 1 ? COLLECTED / 2 : COLLECTED) && map->size % (2 * each) == 0) {
        each *= 2;
    }
    return each;
}

/* Collects rows of the current face into the transfer's elements. */
static lmb_status collect_rows(const lmb_render *r, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    const lmb_shadow_map *map = &r->maps[r->light];
    const int32_t each = collected_each(map), rows = map->size / each, all = map->size / LMB_TILE;
    lmb_transfer_scratch *scratch = &f->scratch->gather.transfer;
    return lmb_transfer_collect(&f->transfer_light, f->kernels, scratch, f->transfer, f->scene,
                                &f->scene->lights[r->light], map, (int32_t)r->face, each, rows * first / all,
                                rows * past / all);
}

static lmb_many_lights_query elements_query(const lmb_frame *f, lmb_stats *stats)
{
    const float error = (f->many_lights_error > 0.0f ? f->many_lights_error : 0.02f) * ELEMENT_ERROR;
    const lmb_many_lights_query query = {f->many_lights, f->bvh.triangle != NULL ? &f->bvh : NULL, error, 1, 0,
                                         stats};
    return query;
}

/* Adds lights without maps to the transfer's elements; a unit is a tile of elements. */
NOINLINE lmb_status step_many_lights(lmb_render *r, int32_t units)
{
    const lmb_frame *f = &r->frame;
    const lmb_many_lights_query query = elements_query(f, f->stats);
    const lmb_element_scratch own = {f->kernels, NULL, &f->scratch->tile, NULL, &f->scratch->indirect};
    const int32_t tiles = lmb_transfer_tiles(f->transfer), first = (int32_t)r->progress,
                  past = tiles - first < units ? tiles : first + units;
    const lmb_status status = lmb_transfer_many_lights(&f->transfer_light, &own, &f->scratch->many_lights,
                                                       f->transfer, &query, first, past);
    r->progress = (uint32_t)past;
    return status != LMB_OK ? status : past < tiles ? LMB_MORE : LMB_OK;
}

/* Collects first points of the current face's tile rows first .. past - 1, into the tree of single points, that of
 * tiles, or both. */
static lmb_status collect_points(const lmb_render *r, lmb_tile *tile, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    const lmb_shadow_map *map = &r->maps[r->light];
    const int32_t face = (int32_t)r->face;
    const lmb_status status = requires_live(f) ? lmb_live_collect(f->live, f->kernels, tile, f->scene, r->light, map,
                                                                  face, f->tree.faces, first, past)
                                               : LMB_OK;
    return status != LMB_OK || !requires_texels(r)
               ? status
               : lmb_tree_texels(&f->tree, f->kernels, tile, f->scene, &f->scene->lights[r->light], map, face,
                                 f->tree.faces, first, past);
}

static lmb_status step_points(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    if (requires_transfer(f) && r->light + r->face + r->progress == 0) {
        (void)lmb_transfer_clear(&f->transfer_light, f->transfer);
    }
    if (!requires_bounce(f) || skips(r, LMB_SKIP_BOUNCE) || reuses(r, LMB_REUSE_POINTS)) {
        return LMB_OK;
    }
    if (r->light == f->scene->light_count) {
        return requires_many_lights_transfer(f) ? step_many_lights(r, units) : LMB_OK;
    }
    if (light_is(r, r->light, LMB_LIGHT_TEXELS_REUSED | LMB_LIGHT_DIM)) {
        f->tree.faces += requires_cut(f) ? faces_that_bounce(r, r->light) : 0;
        ++r->light;
        return LMB_MORE;
    }
    const lmb_shadow_map *map = &r->maps[r->light];
    int32_t rows = map->size / LMB_TILE, last = mini(rows, (int32_t)r->progress + units);
    uint32_t before = f->points.count;
    if ((map->drawn >> r->face) & 1u) {
        lmb_status status =
            requires_transfer(f) ? collect_rows(r, (int32_t)r->progress, last)
            : requires_cut(f)
                ? collect_points(r, &f->scratch->tile, (int32_t)r->progress, last)
                : lmb_points_collect(&f->points, f->kernels, &f->scratch->tile, f->scene, &f->scene->lights[r->light],
                                     map, (int32_t)r->face, (int32_t)r->progress, last, &f->grouping);
        if (status != LMB_OK) {
            return status;
        }
    }
    if (f->stats != NULL) {
        f->stats->first_points += f->points.count - before;
    }
    r->progress = (uint32_t)last;
    if (last == rows) {
        lmb_status status = end_face(r);
        return status != LMB_OK ? status : LMB_MORE;
    }
    return LMB_MORE;
}

/* Sets the light that elements of a transfer send: one reflection after another, then the total. r->progress counts
 * them. */
static lmb_status step_sent(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    lmb_transfer_light *light = &f->transfer_light;
    const uint32_t emits = r->emits != 0, passes = (uint32_t)f->bounces - 1 + emits, pass = r->progress++;
    if (pass < passes) {
        const int what = pass == 0 && emits       ? LMB_TRANSFER_SEND_EMITTED
                         : pass == emits          ? LMB_TRANSFER_SEND_COLLECTED
                                                  : LMB_TRANSFER_SEND_RECEIVED;
        const lmb_status status = lmb_transfer_bounce(light, f->transfer, what);
        return status != LMB_OK ? status : LMB_MORE;
    }
    if (f->bounces > 1 && !f->truncated) {
        const int last = f->bounces > 2 ? LMB_TRANSFER_SEND_RECEIVED : LMB_TRANSFER_SEND_COLLECTED;
        (void)lmb_transfer_rest(light, f->transfer, last, LMB_MAX_BOUNCES - f->bounces);
    }
    return lmb_transfer_send(light, f->transfer);
}

/* Builds the tree of single points over the senders of pass r->light (maps, elements), or at last of all passes. */
static lmb_status build_live(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    const int is_last = !has_bounces(r);
    lmb_status status = LMB_OK;
    f->live->faces = is_last || r->light == (uint32_t)sends_direct(r) ? f->tree.faces : 0;
    f->live->elements = 0;
    if (requires_elements(r)) {
        status = lmb_elements_live(f->live, &f->elements);
    }
    status = status != LMB_OK ? status : lmb_live_build(f->live, f->scene);
    if (status == LMB_OK && is_last && f->stats != NULL) {
        f->stats->first_points += f->live->points;
        f->stats->full_cuts += f->live->merged;
    }
    return status;
}

static lmb_status step_groups(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    if (requires_transfer(f)) {
        return skips(r, LMB_SKIP_BOUNCE) ? LMB_OK : step_sent(r);
    }
    if (requires_elements(r) || (requires_live(f) && !skips(r, LMB_SKIP_BOUNCE))) {
        lmb_status status = LMB_OK;
        if (reuses(r, LMB_REUSE_BOUNCES)) {
            return LMB_OK;
        }
        if (requires_elements(r)) {
            status = lmb_elements_build(&f->elements, f->scene, requires_texels(r) ? &f->tree : NULL);
        }
        return status == LMB_OK && requires_live(f) ? build_live(r) : status;
    }
    if (!requires_groups(f) || reuses(r, LMB_REUSE_POINTS)) {
        return LMB_OK;
    }
    return lmb_group_points(f->groups, &f->points, &f->grouping, f->stats);
}

/* Receives light from single points. */
static lmb_status receive_live(const lmb_render *r, lmb_band_scratch *scratch, int32_t first, int32_t past,
                               lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    lmb_live few = *f->live;
    few.strata = (few.strata + 3) / 4; /* a pixel sees many elements with independent noise */
    const lmb_status status = lmb_elements_receive_live(&f->elements, f->kernels, scratch->live, &few, live_bvh(f),
                                                        first, past);
    count_live(stats, scratch->live);
    return status;
}

/* Receives direct light of emissive surfaces and of many lights. */
static lmb_status receive_direct(const lmb_render *r, const lmb_element_scratch *own, lmb_band_scratch *scratch,
                                 const lmb_cut_params *cut_params, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    const lmb_many_lights_query query = elements_query(f, cut_params->stats);
    const lmb_status status = !r->emits ? LMB_OK
                              : requires_live(f)
                                  ? receive_live(r, scratch, first, past, cut_params->stats)
                                  : lmb_elements_receive(&f->elements, own, NULL, cut_params, first, past);
    return status != LMB_OK || !requires_many_lights_bounce(f)
               ? status
               : lmb_many_lights_elements(&f->elements, own, &scratch->many_lights, &query, first, past);
}

/* Elements first .. past - 1 receive light in pass r->light. If there are emissive surfaces or many lights, the first
 * pass receives their light. The next pass receives the first reflection of this light, and of the lights in shadow
 * maps. Each further pass adds one reflection. */
static lmb_status receive(const lmb_render *r, lmb_band_scratch *scratch, int32_t first, int32_t past, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    const lmb_cut_params cut_params = cut_params_of(f, stats);
    const uint32_t direct = (uint32_t)sends_direct(r);
    lmb_element_scratch own;
    own.kernels = f->kernels;
    own.cut = &scratch->gather.cut;
    own.tile = &scratch->tile;
    own.received = &scratch->direct;
    own.fresh = &scratch->indirect;
    if (r->light < direct) {
        return receive_direct(r, &own, scratch, &cut_params, first, past);
    }
    return requires_live(f) ? receive_live(r, scratch, first, past, stats)
                            : lmb_elements_receive(&f->elements, &own, r->light == direct ? &f->tree : NULL,
                                                   &cut_params, first, past);
}

/* Ends a pass after all elements have received light. */
static lmb_status end_bounce(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    lmb_elements *e = &f->elements;
    const uint32_t direct = (uint32_t)sends_direct(r), pass = r->light;
    lmb_status status = pass == 0 && requires_many_lights_bounce(f) ? lmb_many_lights_elements_done(e) : LMB_OK;
    r->progress = 0;
    ++r->light;
    if (status == LMB_OK && !has_bounces(r) && f->bounces > 1 && !f->truncated) {
        status = requires_live(f)
                     ? lmb_elements_rest_live(e, f->live, LMB_MAX_BOUNCES - f->bounces)
                     : lmb_elements_rest(e, pass == direct ? &f->tree : NULL, LMB_MAX_BOUNCES - f->bounces);
    }
    status = status != LMB_OK ? status : lmb_elements_send(e, !has_bounces(r));
    status = status == LMB_OK && requires_live(f) ? build_live(r) : status;
    return status != LMB_OK ? status : has_bounces(r) ? LMB_MORE : LMB_OK;
}

/* Computes receivers of baked light; a unit is UNIT_RECEIVERS of them. */
static lmb_status step_receivers(lmb_render *r, int32_t units)
{
    const lmb_frame *f = &r->frame;
    const uint32_t all = f->transfer->count[LMB_TRANSFER_RECEIVERS] + f->transfer->count[LMB_TRANSFER_CLUSTERS],
                   first = r->progress, left = (all - first) / UNIT_RECEIVERS,
                   past = left < (uint32_t)units ? all : first + (uint32_t)units * UNIT_RECEIVERS;
    const lmb_status status = lmb_transfer_receivers(&f->transfer_light, f->kernels, f->transfer, first, past);
    r->progress = past;
    return status != LMB_OK ? status : past < all ? LMB_MORE : LMB_OK;
}

static lmb_status step_bounces(lmb_render *r, int32_t units)
{
    if (requires_transfer(&r->frame)) {
        return skips(r, LMB_SKIP_BOUNCE) ? LMB_OK : step_receivers(r, units);
    }
    if (!has_bounces(r)) {
        return LMB_OK;
    }
    const int32_t tiles = lmb_elements_tiles(&r->frame.elements), first = (int32_t)r->progress,
                  past = tiles - first < units ? tiles : first + units;
    const lmb_status status = receive(r, r->frame.scratch, first, past, r->frame.stats);
    r->progress = (uint32_t)past;
    return status != LMB_OK ? status : past < tiles ? LMB_MORE : end_bounce(r);
}

lmb_status lmb_render_solve(lmb_render *r, int32_t units)
{
    switch (r->stage) {
    case LMB_STAGE_SHADOW_MAP:
        return step_shadow_map(r, units);
    case LMB_STAGE_BVH:
        return step_bvh(r);
    case LMB_STAGE_POINTS:
        return step_points(r, units);
    case LMB_STAGE_GROUPS:
        return step_groups(r);
    default:
        return step_bounces(r, units);
    }
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

/* Collects a row of blocks of the current face. Faces outside the map have no points. */
static lmb_status part_points(const lmb_render *r, lmb_tile *tile, int32_t part, int32_t parts)
{
    const lmb_frame *f = &r->frame;
    const lmb_shadow_map *map = &r->maps[r->light];
    if (((map->drawn >> r->face) & 1u) == 0) {
        return LMB_OK;
    }
    if (requires_cut(f)) {
        int64_t first, past;
        share_out(&first, &past, map->size / LMB_TILE, part, parts);
        return collect_points(r, tile, (int32_t)first, (int32_t)past);
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
    case LMB_STAGE_SHADOW_MAP:
        return part_shadow_map(r, part, parts, stats);
    case LMB_STAGE_POINTS:
        return part_points(r, &scratch->tile, part, parts);
    default:
        return part_bounces(r, scratch, part, parts, stats);
    }
}

/* Ends the face's parts; LMB_MORE if another face is left. */
static lmb_status end_parts_of_face(lmb_render *r, int32_t parts)
{
    lmb_frame *f = &r->frame;
    const lmb_shadow_map *map = &r->maps[r->light];
    const uint32_t before = f->points.count;
    if (requires_groups(f) && (map->drawn >> r->face) & 1u) {
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
