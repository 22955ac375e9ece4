/* render.c: the one call that runs the rooms in order, whole or one bounded step at a time. Floor 8.     [V33 V34] */
#include <lambent/render.h>

#include <string.h>

#include "../base/surface_check.h"
#include "../base/vec.h"
#include "../bounce/points.h"
#include "../raster/triangle.h"
#include "../raster/target.h"
#include "sparse.h"
#include "wants.h"

/* A build without trees refuses frames that ask for them (check_frame), so none of these is ever called. */
#if !LMB_TREES
#undef lmb_gather_cut
#undef lmb_many_direct_tile
#define lmb_gather_cut(...)       LMB_ERR_ARG
#define lmb_many_direct_tile(...) LMB_ERR_ARG
#define lmb_blockers_build(...)   LMB_ERR_ARG
#define lmb_tree_sum(...)         LMB_ERR_ARG
#define lmb_tree_texels(...)      LMB_ERR_ARG
#define lmb_elements_build(...)   LMB_ERR_ARG
#define lmb_elements_receive(...) LMB_ERR_ARG
#define lmb_elements_send(...)    LMB_ERR_ARG
#define lmb_elements_tiles(...)   0
#endif

#define UNIT_TRIANGLES 1024u
#define BAND_UNITS     8
#define STEPS          12
#define SHARE          0.02f

static int32_t band_count(const lmb_view *v) { return (v->frame_height + LMB_TILE - 1) / LMB_TILE; }

static int shines(const lmb_scene *scene)
{
    int any = 0;
    for (uint32_t i = 0; i < scene->material_count; ++i) {
        const float *e = scene->materials[i].emission;
        any |= e[0] > 0.0f || e[1] > 0.0f || e[2] > 0.0f;
    }
    return any;
}

static lmb_status check_eye(const lmb_frame *f)
{
    const lmb_surface *d = &f->eye.depth;
    lmb_status status = lmb_target_check(&f->eye, &f->view, lmb_scene_triangles(f->scene));
    if (status != LMB_OK) {
        return status;
    }
    if (f->eye.id.data == NULL || f->eye.x0 != 0 || f->eye.y0 != 0 || d->width != f->view.frame_width ||
        (d->height != f->view.frame_height && d->height != LMB_TILE)) {
        return LMB_ERR_ARG;
    }
    const lmb_surface *map = occluding_depth(f);
    if (map == NULL || map == d) {
        return LMB_OK;
    }
    lmb_target whole = f->eye;
    whole.depth = *map;
    memset(&whole.id, 0, sizeof whole.id);
    return is_whole(map, &f->view) ? lmb_target_check(&whole, &f->view, 0) : LMB_ERR_ARG;
}

static lmb_status check_out(const lmb_surface *out, const lmb_view *v)
{
    if (out->data == NULL || out->width != v->frame_width ||
        (out->height != v->frame_height && out->height != LMB_TILE)) {
        return LMB_ERR_ARG;
    }
    if (out->format < LMB_RGB565 || out->format > LMB_RGB32F || out->format == LMB_R32F || out->layout != LMB_LINEAR) {
        return LMB_ERR_FORMAT;
    }
    return lmb_surface_is_sound(out) ? LMB_OK : LMB_ERR_ARG;
}

static lmb_status check_frame(const lmb_frame *f)
{
    if (f->kernels == NULL || f->scene == NULL || f->scratch == NULL || f->show < LMB_SHOW_FULL ||
        f->show > LMB_SHOW_IRRADIANCE || f->steps < 0 || f->steps > 64 || f->view.frame_width < 1 ||
        f->view.frame_height < 1 || f->occlusion < LMB_OCCLUSION_NONE || f->occlusion > LMB_OCCLUSION_EXACT ||
        !(f->error > 0.0f) || !(f->visible > 0.0f)) {
        return LMB_ERR_ARG;
    }
    if (!LMB_TREES && (f->grouping.method == LMB_GROUP_CUT || f->many != NULL)) {
        return LMB_ERR_ARG;
    }
    if (f->bounces < 1 || (f->bounces > 1 && wants_bounce(f) && (!wants_cut(f) || f->elements.data == NULL))) {
        return LMB_ERR_ARG;
    }
    if (f->gather_step != 1 && f->gather_step != 2 && f->gather_step != 4) {
        return LMB_ERR_ARG;
    }
    if (f->scene->light_count > LMB_MAX_LIGHTS) {
        return LMB_ERR_CAPACITY;
    }
    if (f->many_bounce > f->scene->light_count) {
        return LMB_ERR_ARG;
    }
    if (wants_cut(f) ? f->light_map % f->tree.size != 0 || f->light_map / f->tree.size > 8 ||
                           f->occlusion % LMB_OCCLUSION_EXACT != 0
                     : wants_groups(f) && f->occlusion == LMB_OCCLUSION_EXACT) {
        return LMB_ERR_ARG;
    }
    if (f->id_format == LMB_ID16 && lmb_scene_triangles(f->scene) > 65535u) {
        return LMB_ERR_SCENE;
    }
    lmb_status status = check_eye(f);
    return status != LMB_OK ? status : check_out(&f->out, &f->view);
}

/* Share the map memory out: one light's map after another. */
static lmb_status place_maps(lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    uint8_t *place = (uint8_t *)f->map_memory;
    size_t left = f->map_bytes;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        const lmb_light *light = &f->scene->lights[i];
        size_t need = lmb_light_map_bytes(lmb_light_map_faces(light), f->light_map, f->id_format);
        lmb_status status = lmb_light_map_init(&r->maps[i], light, f->scene, f->light_map, f->id_format, place, left);
        if (status != LMB_OK) {
            return status;
        }
        place += need;
        left -= need;
    }
    return LMB_OK;
}

static int32_t gather_step(const lmb_frame *f, int32_t step) { return step != 0 && wants_bounce(f) ? step : 1; }

lmb_status lmb_render_begin(lmb_render *r, const lmb_frame *frame)
{
    if (r == NULL || frame == NULL) {
        return LMB_ERR_ARG;
    }
    memset(r, 0, sizeof *r);
    r->frame = *frame;
    lmb_frame *f = &r->frame;
    f->id_format = f->id_format != 0 ? f->id_format : LMB_ID32;
    f->steps = f->steps != 0 ? f->steps : STEPS;
    f->error = f->error != 0.0f ? f->error : SHARE;
    f->visible = f->visible != 0.0f ? f->visible : SHARE;
    f->bounces = f->bounces != 0 ? f->bounces : 1;
    f->gather_step = gather_step(f, f->gather_step);
    f->tree.faces = 0;
    f->points.count = 0;
    f->points.faces = 0;
    f->points.owner_count = 0;
    lmb_status status = check_frame(f);
    if (status == LMB_OK) {
        status = place_maps(r);
    }
    r->triangles = status == LMB_OK ? lmb_scene_triangles(f->scene) : 0;
    r->shines = status == LMB_OK && shines(f->scene);
    r->stage = status == LMB_OK ? LMB_STAGE_LIGHT_MAP : LMB_STAGE_DONE;
    r->failed = status;
    return status;
}

/* What belongs to the picture, not to the light. */
static void set_picture(lmb_frame *f, const lmb_frame *from)
{
    f->kernels = from->kernels;
    f->view = from->view;
    f->show = from->show;
    f->occlusion = from->occlusion;
    f->steps = from->steps != 0 ? from->steps : STEPS;
    f->error = from->error != 0.0f ? from->error : SHARE;
    f->visible = from->visible != 0.0f ? from->visible : SHARE;
    f->many_error = from->many_error;
    f->gather_step = gather_step(f, from->gather_step);
    f->exposure_ev = from->exposure_ev;
    f->eye = from->eye;
    f->eye_depth = from->eye_depth;
    f->scratch = from->scratch;
    f->out = from->out;
    f->callback = from->callback;
    f->user = from->user;
    f->stats = from->stats;
}

/* Was what the picture asks for solved with the light? Groups or a tree; the tree of blockers. */
static int is_solved(const lmb_frame *f, const lmb_frame *before)
{
    const int exact = wants_cut(f) && f->occlusion == LMB_OCCLUSION_EXACT;
    return (!wants_bounce(f) || wants_bounce(before)) &&
           (!exact || before->occlusion == LMB_OCCLUSION_EXACT || before->blockers.node_count > 0);
}

lmb_status lmb_render_again(lmb_render *r, const lmb_frame *frame)
{
    lmb_frame f;
    if (r == NULL || frame == NULL || (r->failed == LMB_OK && r->stage < LMB_STAGE_VIEW)) {
        return LMB_ERR_ARG;
    }
    if (r->failed != LMB_OK) {
        return r->failed;
    }
    f = r->frame;
    set_picture(&f, frame);
    lmb_status status = check_frame(&f);
    if (status == LMB_OK && !is_solved(&f, &r->frame)) {
        status = LMB_ERR_ARG;
    }
    if (status == LMB_OK) {
        r->frame = f;
        r->stage = LMB_STAGE_VIEW;
        r->light = r->face = r->place = 0;
    }
    return status;
}

/* Every stage's step does up to `units` of work, moves r->light, face and place on, and sets LMB_MORE or LMB_OK when the stage is
 * complete. */
static lmb_status step_light_map(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    if (r->light == f->scene->light_count) {
        return LMB_OK;
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

/* Many lights want them whatever is shown: another picture by the same light may show what this one does not. */
static lmb_status step_blockers(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    const int for_bounce = wants_cut(f) && f->occlusion == LMB_OCCLUSION_EXACT;
    const int for_many = f->many != NULL && f->blockers.triangle != NULL;
    return for_bounce || for_many ? lmb_blockers_build(&f->blockers, f->scene) : LMB_OK;
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
    if (!wants_bounce(f) || r->light == f->scene->light_count) {
        return LMB_OK;
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
        return lmb_elements_build(&f->elements, f->scene, &f->tree);
    }
    return wants_groups(f) ? lmb_group_points(f->groups, &f->points, &f->grouping, f->stats) : LMB_OK;
}

/* Bounce r->light + 2: elements first .. past - 1 receive. The light's maps give the first share of it. */
static lmb_status receive(const lmb_render *r, lmb_band_scratch *scratch, int32_t first, int32_t past, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    const lmb_cutting cutting = cutting_of(f, stats);
    lmb_receiver own;
    own.kernels = f->kernels;
    own.cut = &scratch->gather.cut;
    own.tile = &scratch->tile;
    own.received = &scratch->direct;
    own.fresh = &scratch->indirect;
    return lmb_elements_receive(&f->elements, &own, r->light == 0 ? &f->tree : NULL, &cutting, first, past);
}

static int has_bounces(const lmb_render *r) { return wants_elements(r) && r->light + 1 < (uint32_t)r->frame.bounces; }

/* All elements have received. */
static lmb_status end_bounce(lmb_render *r)
{
    r->place = 0;
    ++r->light;
    const lmb_status status = lmb_elements_send(&r->frame.elements, !has_bounces(r));
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

/* The whole frame's depth: with ids where the eye holds them all, else depth alone for the occlusion. */
static int view_target(lmb_target *out, const lmb_frame *f)
{
    *out = f->eye;
    if (is_whole(&f->eye.depth, &f->view)) {
        return 1;
    }
    const lmb_surface *map = occluding_depth(f);
    memset(out, 0, sizeof *out);
    if (map != NULL) {
        out->depth = *map;
    }
    return map != NULL;
}

static void clear_target(const lmb_target *t)
{
    lmb_surface_clear(&t->depth);
    if (t->id.data != NULL) {
        lmb_surface_clear(&t->id);
    }
}

static lmb_status step_view(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    lmb_target whole;
    if (!view_target(&whole, f)) {
        return LMB_OK;
    }
    if (r->place == 0) {
        clear_target(&whole);
    }
    lmb_status status = lmb_draw(&whole, f->kernels, &f->view, f->scene, r->place + 1, (uint32_t)units * UNIT_TRIANGLES,
                                 LMB_CULL_BACK, f->stats);
    r->place += (uint32_t)units * UNIT_TRIANGLES;
    return status != LMB_OK ? status : r->place >= r->triangles ? LMB_OK : LMB_MORE;
}

/* Attributes of the band: in the whole frame's target, or drawn now into a band-sized one. */
static lmb_status draw_band(const lmb_render *r, lmb_target *eye, int32_t band)
{
    const lmb_frame *f = &r->frame;
    if (is_whole(&eye->depth, &f->view)) {
        return LMB_OK;
    }
    eye->y0 = band * LMB_TILE;
    lmb_surface_clear(&eye->depth);
    lmb_surface_clear(&eye->id);
    return lmb_draw(eye, f->kernels, &f->view, f->scene, 1, r->triangles, LMB_CULL_BACK, NULL);
}

/* What surfaces give off towards the viewer. */
static void add_shine(lmb_radiance *inout, const lmb_scene *scene, const lmb_tile *tile)
{
    uint32_t id = 0;
    const float *emission = NULL;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && tile->id[k] != id) {
            id = tile->id[k];
            emission = scene->materials[lmb_instance_of(scene, id)->material].emission;
        }
        for (int c = 0; c < 3 && tile->id[k] != 0; ++c) {
            inout->rgb[c][k] += emission[c];
        }
    }
}

/* SHOW_IRRADIANCE is what arrives before the albedo. */
static void show_irradiance(lmb_radiance *out, const lmb_irradiance *e) { memcpy(out->rgb, e->rgb, sizeof out->rgb); }

/* Direct and bounced light of the tile at hand; of the latter `indirect` where that is known, NULL: gathered here. */
static lmb_status light_tile(const lmb_render *r, lmb_band_scratch *s, const lmb_irradiance *indirect)
{
    const lmb_frame *f = &r->frame;
    lmb_many_look look;
    lmb_status status = LMB_OK;
    memset(&s->direct, 0, sizeof s->direct);
    for (uint32_t i = 0; wants_direct(f) && i < f->scene->light_count - f->many_bounce && status == LMB_OK; ++i) {
        status =
            lmb_direct_tile(&s->direct, f->kernels, &s->tile, &f->view, f->scene, &f->scene->lights[i], &r->maps[i]);
    }
    if (wants_many(f) && status == LMB_OK) {
        look.many = f->many;
        look.blockers = f->blockers.triangle != NULL ? &f->blockers : NULL;
        look.error = f->many_error;
        status = lmb_many_direct_tile(&s->direct, f->kernels, &s->many, &s->tile, &look);
    }
    if (indirect == NULL && status == LMB_OK) {
        indirect = &s->indirect;
        memset(&s->indirect, 0, sizeof s->indirect);
        status = lmb_render_gather(&s->indirect, r, s, &s->tile);
    }
    if (status == LMB_OK && f->show == LMB_SHOW_IRRADIANCE) {
        show_irradiance(&s->radiance, indirect);
        return LMB_OK;
    }
    if (status == LMB_OK) {
        status = lmb_compose_tile(&s->radiance, f->kernels, &s->tile, &s->direct, indirect);
    }
    if (status == LMB_OK && r->shines && wants_direct(f)) {
        add_shine(&s->radiance, f->scene, &s->tile);
    }
    return status;
}

/* The bounced light of the tile at column x where that is gathered by blocks: with the first tile of each. Else NULL. */
static lmb_status block_light(const lmb_irradiance **out, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_target *window, int32_t x, int32_t band)
{
    const lmb_frame *f = &r->frame;
    const int32_t part = x / LMB_TILE % LMB_SPARSE_TILES;
    *out = f->gather_step > 1 ? &s->sparse.light[part] : NULL;
    if (f->gather_step == 1 || part > 0) {
        return LMB_OK;
    }
    const int32_t ahead = (f->view.frame_width - x + LMB_TILE - 1) / LMB_TILE;
    return lmb_render_block(r, s, window, x, band * LMB_TILE, mini(LMB_SPARSE_TILES, ahead));
}

lmb_status lmb_render_band(const lmb_render *r, lmb_band_scratch *scratch, const lmb_target *eye,
                           const lmb_surface *out, int32_t band)
{
    if (r == NULL || scratch == NULL || eye == NULL || out == NULL || r->stage < LMB_STAGE_BANDS || band < 0 ||
        band >= band_count(&r->frame.view)) {
        return LMB_ERR_ARG;
    }
    lmb_status sound = check_out(out, &r->frame.view);
    if (sound != LMB_OK) {
        return sound;
    }
    if (r->failed != LMB_OK) {
        return r->failed;
    }
    const lmb_frame *f = &r->frame;
    lmb_target window = *eye;
    int32_t out_y0 = is_whole(out, &f->view) ? 0 : band * LMB_TILE;
    lmb_status status = draw_band(r, &window, band);
    for (int32_t x = 0; x < f->view.frame_width && status == LMB_OK; x += LMB_TILE) {
        const lmb_irradiance *indirect;
        status = block_light(&indirect, r, scratch, &window, x, band);
        if (status == LMB_OK) {
            status = lmb_resolve_tile(&scratch->tile, f->kernels, &f->view, f->scene, &window, x, band * LMB_TILE);
        }
        if (status == LMB_OK) {
            status = light_tile(r, scratch, indirect);
        }
        if (status == LMB_OK) {
            status = lmb_store_tile(out, f->kernels, 0, out_y0, &scratch->radiance, x, band * LMB_TILE, f->exposure_ev);
        }
    }
    return status;
}

/* 1 to go on. */
static int hand_over(const lmb_frame *f, int32_t band)
{
    lmb_surface rows = f->out;
    int32_t y = band * LMB_TILE;
    if (f->callback == NULL) {
        return 1;
    }
    if (is_whole(&f->out, &f->view)) {
        rows.data = (uint8_t *)rows.data + (ptrdiff_t)y * rows.stride_bytes;
    }
    rows.height = mini(LMB_TILE, f->view.frame_height - y);
    return f->callback(f->user, &rows, y) == 0;
}

static lmb_status step_bands(lmb_render *r, int32_t units)
{
    const int32_t bands = band_count(&r->frame.view);
    for (int32_t n = 0; (n == 0 || n + BAND_UNITS <= units) && r->place < (uint32_t)bands; n += BAND_UNITS) {
        int32_t band = (int32_t)r->place++;
        memset(&r->frame.scratch->counts, 0, sizeof r->frame.scratch->counts);
        lmb_status status = lmb_render_band(r, r->frame.scratch, &r->frame.eye, &r->frame.out, band);
        if (status != LMB_OK) {
            return status;
        }
        if (r->frame.stats != NULL) {
            ++r->frame.stats->bands;
            r->frame.stats->pairs += r->frame.scratch->counts.pairs;
            r->frame.stats->segments += r->frame.scratch->counts.segments;
        }
        if (!hand_over(&r->frame, band)) {
            return LMB_OK;
        }
    }
    return r->place < (uint32_t)bands ? LMB_MORE : LMB_OK;
}

/* Tile rows counted through all faces of all lights' maps, so that many lights are shared out whole. */
static lmb_status part_light_map(const lmb_render *r, int32_t part, int32_t parts, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    const int64_t rows = f->light_map / LMB_TILE;
    int64_t first, past, all = 0, before = 0;
    lmb_status status = LMB_OK;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        all += r->maps[i].faces * rows;
    }
    share_out(&first, &past, all, part, parts);
    for (uint32_t i = 0; i < f->scene->light_count && status == LMB_OK; ++i) {
        const int64_t own = r->maps[i].faces * rows;
        const int64_t from = first > before ? first - before : 0, to = past - before < own ? past - before : own;
        if (from < to) {
            status = lmb_light_map_rows(&r->maps[i], f->kernels, f->scene, (int32_t)from, (int32_t)to, stats);
        }
        before += own;
    }
    return status;
}

static lmb_status part_view(const lmb_render *r, int32_t part, int32_t parts, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    lmb_target whole, window;
    int64_t first, past;
    share_out(&first, &past, band_count(&f->view), part, parts);
    if (first >= past || !view_target(&whole, f)) {
        return LMB_OK;
    }
    lmb_target_rows(&window, &whole, (int32_t)first, (int32_t)(past - first));
    clear_target(&window);
    return lmb_draw(&window, f->kernels, &f->view, f->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK,
                    first == 0 ? stats : NULL);
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

int32_t lmb_render_has_parts(const lmb_render *r)
{
    if (r == NULL || r->failed != LMB_OK) {
        return 0;
    }
    switch (r->stage) {
    case LMB_STAGE_LIGHT_MAP:
        return r->light == 0 && r->place == 0;
    case LMB_STAGE_POINTS:
        return wants_bounce(&r->frame) && r->place == 0 && r->light < r->frame.scene->light_count &&
               (wants_cut(&r->frame) || lmb_points_have_room(&r->frame.points, &r->maps[r->light], &r->frame.grouping));
    case LMB_STAGE_BOUNCES:
        return has_bounces(r) && r->place == 0;
    case LMB_STAGE_VIEW:
        return r->place == 0;
    default:
        return 0;
    }
}

lmb_status lmb_render_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                           lmb_stats *stats)
{
    if (!lmb_render_has_parts(r) || scratch == NULL || part < 0 || part >= parts || parts > 65535) {
        return LMB_ERR_ARG;
    }
    switch (r->stage) {
    case LMB_STAGE_LIGHT_MAP:
        return part_light_map(r, part, parts, stats);
    case LMB_STAGE_POINTS:
        return part_points(r, &scratch->tile, part, parts);
    case LMB_STAGE_BOUNCES:
        return part_bounces(r, scratch, part, parts, stats);
    default:
        return part_view(r, part, parts, stats);
    }
}

/* The stage is complete, or has failed. */
static lmb_status end_stage(lmb_render *r, lmb_status status)
{
    if (status < 0) {
        r->stage = LMB_STAGE_DONE;
        r->failed = status;
        return status;
    }
    if (status == LMB_OK) {
        ++r->stage;
        r->light = r->face = r->place = 0;
    }
    return r->stage == LMB_STAGE_DONE ? LMB_OK : LMB_MORE;
}

lmb_status lmb_render_parts_done(lmb_render *r, int32_t parts)
{
    if (!lmb_render_has_parts(r) || parts < 1) {
        return LMB_ERR_ARG;
    }
    return end_stage(r, r->stage == LMB_STAGE_POINTS    ? end_parts_of_face(r, parts)
                        : r->stage == LMB_STAGE_BOUNCES ? end_bounce(r)
                                                        : LMB_OK);
}

lmb_status lmb_render_step(lmb_render *r, int32_t units)
{
    lmb_status status;
    if (r == NULL) {
        return LMB_ERR_ARG;
    }
    if (r->failed != LMB_OK) {
        return r->failed;
    }
    units = mini(maxi(units, 1), 1 << 20);
    switch (r->stage) {
    case LMB_STAGE_LIGHT_MAP:
        status = step_light_map(r, units);
        break;
    case LMB_STAGE_BLOCKERS:
        status = step_blockers(r);
        break;
    case LMB_STAGE_POINTS:
        status = step_points(r, units);
        break;
    case LMB_STAGE_GROUPS:
        status = step_groups(r);
        break;
    case LMB_STAGE_BOUNCES:
        status = step_bounces(r, units);
        break;
    case LMB_STAGE_VIEW:
        status = step_view(r, units);
        break;
    case LMB_STAGE_BANDS:
        status = step_bands(r, units);
        break;
    default:
        return LMB_OK;
    }
    return end_stage(r, status);
}

lmb_status lmb_render_frame(lmb_render *r, const lmb_frame *frame)
{
    lmb_status status = lmb_render_begin(r, frame);
    if (status == LMB_OK) {
        do {
            status = lmb_render_step(r, 64);
        } while (status == LMB_MORE);
    }
    return status;
}

float lmb_render_progress(const char **name, const lmb_render *r)
{
    static const char *const names[] = {"light maps", "blockers", "first points", "groups",
                                        "bounces",    "view",     "bands",        "done"};
    if (r == NULL || r->stage < 0 || r->stage > LMB_STAGE_DONE) {
        *name = names[LMB_STAGE_DONE];
        return 1.0f;
    }
    float lights = maxf((float)r->frame.scene->light_count, 1.0f), triangles = maxf((float)r->triangles, 1.0f),
          done = 0.0f;
    *name = names[r->stage];
    switch (r->stage) {
    case LMB_STAGE_LIGHT_MAP:
        done = ((float)r->light + (float)r->place / triangles) / lights;
        break;
    case LMB_STAGE_POINTS:
        done = (float)r->light / lights;
        break;
    case LMB_STAGE_BOUNCES:
        done = ((float)r->light + (float)r->place / maxf((float)lmb_elements_tiles(&r->frame.elements), 1.0f)) /
               maxf((float)(r->frame.bounces - 1), 1.0f);
        break;
    case LMB_STAGE_VIEW:
        done = (float)r->place / triangles;
        break;
    case LMB_STAGE_BANDS:
        done = (float)r->place / (float)band_count(&r->frame.view);
        break;
    case LMB_STAGE_DONE:
        done = 1.0f;
        break;
    default:
        break;
    }
    return minf(done, 1.0f);
}
