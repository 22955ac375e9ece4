/* solve_live.c: bounced light at single points, from a tree of the first points of all lights. Layer 8. [V33 V34]
 *
 * Elements are points of that tree. Lobes are lit by cuts of the texels, as in solve_cut.c. */
#include <string.h>

#include "../base/vec.h"
#include "../live/live_part.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "live_grid.h"
#include "requires.h"
#include "solver.h"
#include "stages.h"

#if LMB_LIVE

/* Lights of a sky, if there are no other many lights. */
static uint32_t suns_of(const lmb_many_lights *m)
{
    return m != NULL && m->node_count > 0 && m->node[0].kind == LMB_LIGHT_DIRECTIONAL ? m->cell_count : 0;
}

/* Places the tree of single points, and a scratch for each thread. */
static lmb_status live_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const lmb_status placed = lmb_solve_cut_place(f, s, b);
    const uint32_t lit = lmb_frame_map_faces(f->scene), faces = lit > 0 ? lit : 1;
    const int32_t side = lmb_live_side(faces, f->shadow_map), threads = s->threads > 1 ? s->threads : 1;
    const size_t bytes = lmb_live_bytes(faces, side, f->elements.cap);
    const uint32_t suns = suns_of(f->many_lights);
    void *sky_memory = NULL;
    if (placed != LMB_OK) {
        return placed;
    }
    f->live = (lmb_live *)lmb_frame_take(b, sizeof *f->live);
    void *memory = lmb_frame_take(b, bytes);
    if (suns > 0) {
        f->live_sky = (lmb_live_sky *)lmb_frame_take(b, sizeof *f->live_sky);
        sky_memory = lmb_frame_take(b, lmb_live_sky_bytes(suns));
    }
    lmb_live_scratch *scratch = (lmb_live_scratch *)lmb_frame_take(b, sizeof *scratch * (uint64_t)threads);
    if (bytes == 0 || is_only_measured(b)) {
        return bytes == 0 ? LMB_ERR_ARG : LMB_OK;
    }
    for (int32_t i = 0; i < threads; ++i) {
        memset(&scratch[i], 0, sizeof *scratch);
        f->scratch[i].live = &scratch[i];
    }
    lmb_status status = lmb_live_init(f->live, faces, side, f->elements.cap, memory, bytes);
    if (status == LMB_OK && suns > 0) {
        status = lmb_live_sky_init(f->live_sky, suns, sky_memory, lmb_live_sky_bytes(suns));
    }
    const int few = s->quality == LMB_QUALITY_DRAFT && !lmb_scene_emits(f->scene); /* emitters are the brightest */
    f->live->strata = few ? LMB_LIVE_STRATA / 2 : LMB_LIVE_STRATA;
    if (suns > 0) {
        f->live_sky->strata = few ? LMB_LIVE_STRATA / 2 : LMB_LIVE_STRATA;
    }
    f->live->steady = s->steady;
    f->live->split = s->quality == LMB_QUALITY_DRAFT ? 8.0f : 16.0f;
    return status;
}

/* --- first points ------------------------------------------------------------------------------------------------- */

/* Collects into the tree of single points, and into that of texels if lobes need it. */
static lmb_status live_rows(const lmb_render *r, lmb_tile *tile, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    const lmb_status status = lmb_live_collect(f->live, f->kernels, tile, f->scene, r->light, &r->maps[r->light],
                                               (int32_t)r->face, f->tree.faces, first, past);
    return status != LMB_OK ? status : lmb_solve_cut_rows(r, tile, first, past);
}

/* --- bounces ------------------------------------------------------------------------------------------------------ */

/* Builds the tree of single points over the senders of pass r->light (maps, elements), or at last of all passes. */
static lmb_status build_points(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    const int is_last = !has_bounces(r);
    lmb_status status = LMB_OK;
    f->live->faces = is_last || r->light == (uint32_t)sends_direct(r) ? f->tree.faces : 0;
    f->live->elements = 0;
    f->live->sky = NULL;
    if (is_last ? gathers_live_sky(f) : r->light == 0 && has_live_sky(f)) {
        f->live->sky = f->live_sky;
    }
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

static lmb_status live_build(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    lmb_status status = LMB_OK;
    if (skips(r, LMB_SKIP_BOUNCE) || reuses(r, LMB_REUSE_BOUNCES)) {
        return LMB_OK;
    }
    if (has_live_sky(f)) {
        status = lmb_many_lights_sky(f->live_sky, f->many_lights, f->scene);
    }
    if (status == LMB_OK && requires_elements(r)) {
        status = lmb_elements_build(&f->elements, f->scene, requires_texels(r) ? &f->tree : NULL);
    }
    return status == LMB_OK ? build_points(r) : status;
}

static lmb_status live_receive(const lmb_render *r, lmb_band_scratch *s, int32_t first, int32_t past, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    lmb_live few = *f->live;
    lmb_live_sky few_suns;
    few.strata = (few.strata + 3) / 4; /* a pixel sees many elements with independent noise */
    if (few.sky != NULL) {
        few_suns = *few.sky;
        few_suns.strata = (few_suns.strata + 3) / 4;
        few.sky = &few_suns;
    }
    const lmb_status status =
        lmb_elements_receive_live(&f->elements, f->kernels, s->live, &few, live_bvh(f), first, past);
    count_live(stats, s->live);
    return status;
}

static lmb_status live_rest(lmb_render *r, int32_t left)
{
    return lmb_elements_rest_live(&r->frame.elements, r->frame.live, left);
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

lmb_status lmb_render_live(float light[3], const lmb_render *r, lmb_band_scratch *s, const lmb_live_receiver *at)
{
    const lmb_frame *f = &r->frame;
    const lmb_status status = lmb_live_receive_again(light, f->kernels, s->live, f->live, live_bvh(f), at);
    count_live(&s->counts, s->live);
    return status;
}

/* The shift of the segments towards a sky. Tiles of vertices and of samples have no neighbours, so it depends only
 * on the place. */
static float turn_at(lmb_vec3 place)
{
    uint32_t bits[3];
    memcpy(bits, &place, sizeof bits);
    return (float)(live_hash(bits[0], bits[1], bits[2]) >> 8) * (1.0f / 16777216.0f);
}

/* Lights each pixel separately. */
static lmb_status live_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                            const lmb_tile *tile, const lmb_irradiance *direct)
{
    lmb_status status = LMB_OK;
    if (glossy != NULL) {
        return lmb_solve_cut_tile(inout, glossy, r, s, tile, direct);
    }
    for (int k = 0; k < LMB_TILE_PIXELS && status == LMB_OK; ++k) {
        if (tile->id[k] != 0) {
            const lmb_vec3 place = tile_vec(tile->position, k);
            const lmb_live_receiver at = {place, tile_vec(tile->face, k), tile_vec(tile->normal, k), tile->id[k],
                                          lmb_place_noise(place, absf(tile->depth[k])),
                                          view_to_eye(&r->frame.view, place), turn_at(place)};
            float light[3];
            status = lmb_live_receive(light, r->frame.kernels, s->live, r->frame.live, live_bvh(&r->frame), &at);
            count_live(&s->counts, s->live);
            for (int c = 0; c < 3 && status == LMB_OK; ++c) {
                inout->rgb[c][k] += light[c];
            }
        }
    }
    return status;
}

const frame_solver lmb_solver_live = {
    .place = live_place,
    .rows = live_rows,
    .end_face = lmb_solve_cut_end_face,
    .build = live_build,
    .step = lmb_solve_elements_step,
    .done = lmb_solve_elements_done,
    .receive = live_receive,
    .rest = live_rest,
    .built = build_points,
    .tile = live_tile,
};

#endif
