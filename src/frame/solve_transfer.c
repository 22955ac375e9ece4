/* solve_transfer.c: baked bounced light: elements collect the light of the maps and send it along a transfer. Layer 8.
 * [V33 V34] */
#include "requires.h"
#include "solver.h"
#include "stages.h"

#if LMB_TRANSFER

/* Texels along each side of a map face that are collected into a transfer's elements: this many for one face, half for
 * six. With 128, small elements get no texel or one: rmse of the Cornell box .113; with 256, .08; with 512, .075. */
enum { MIN_COLLECTED_SIDE = 256 };
#define UNIT_RECEIVERS 64u

static lmb_status transfer_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const size_t bytes = lmb_transfer_light_bytes(f->transfer);
    void *memory = lmb_frame_take(b, bytes), *places = NULL;
    (void)s;
    if (f->many_lights != NULL) {
        places = lmb_frame_take(b, (uint64_t)sizeof(lmb_transfer_place) * f->transfer->count[LMB_TRANSFER_AREAS]);
    }
    if (bytes == 0 || is_only_measured(b)) {
        return bytes == 0 ? LMB_ERR_ARG : LMB_OK;
    }
    const lmb_status status = lmb_transfer_light_init(&f->transfer_light, f->transfer, memory, bytes);
    f->transfer_light.place = (lmb_transfer_place *)places;
    return status != LMB_OK ? status : lmb_transfer_materials(&f->transfer_light, f->transfer, f->scene);
}

/* --- first points ------------------------------------------------------------------------------------------------- */

static lmb_status transfer_begin(lmb_render *r)
{
    (void)lmb_transfer_clear(&r->frame.transfer_light, r->frame.transfer);
    return LMB_OK;
}

static int32_t collected_each(const lmb_shadow_map *map)
{
    int32_t each = 1;
    while (map->size / each > (map->faces > 1 ? MIN_COLLECTED_SIDE / 2 : MIN_COLLECTED_SIDE) &&
           map->size % (2 * each) == 0) {
        each *= 2;
    }
    return each;
}

static lmb_status transfer_collect(lmb_render *r, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    const lmb_shadow_map *map = &r->maps[r->light];
    const int32_t each = collected_each(map), rows = map->size / each, all = map->size / LMB_TILE;
    lmb_transfer_scratch *scratch = &f->scratch->gather.transfer;
    return lmb_transfer_collect(&f->transfer_light, f->kernels, scratch, f->transfer, f->scene,
                                &f->scene->lights[r->light], map, (int32_t)r->face, each, rows * first / all,
                                rows * past / all);
}

#if LMB_TREES
/* Adds lights without maps to the elements; a unit is a tile of elements. */
static lmb_status transfer_many_lights(lmb_render *r, int32_t units)
{
    const lmb_frame *f = &r->frame;
    if (!requires_many_lights_transfer(f)) {
        return LMB_OK;
    }
    const lmb_many_lights_query query = elements_query(f, f->stats);
    const lmb_element_scratch own = {f->kernels, NULL, &f->scratch->tile, NULL, &f->scratch->indirect};
    const int32_t tiles = lmb_transfer_tiles(f->transfer), first = (int32_t)r->progress,
                  past = tiles - first < units ? tiles : first + units;
    const lmb_status status = lmb_transfer_many_lights(&f->transfer_light, &own, &f->scratch->many_lights,
                                                       f->transfer, &query, first, past);
    r->progress = (uint32_t)past;
    return status != LMB_OK ? status : past < tiles ? LMB_MORE : LMB_OK;
}
#endif

/* --- bounces ------------------------------------------------------------------------------------------------------ */

/* Sets the light that elements send: one reflection after another, then the total. r->progress counts them. */
static lmb_status transfer_build(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    lmb_transfer_light *light = &f->transfer_light;
    if (skips(r, LMB_SKIP_BOUNCE)) {
        return LMB_OK;
    }
    const uint32_t emits = r->emits != 0, passes = (uint32_t)f->bounces - 1 + emits, pass = r->progress++;
    if (pass < passes) {
        const int what = pass == 0 && emits ? LMB_TRANSFER_SEND_EMITTED
                         : pass == emits    ? LMB_TRANSFER_SEND_COLLECTED
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

static uint32_t receivers_of(const lmb_frame *f)
{
    return f->transfer->count[LMB_TRANSFER_RECEIVERS] + f->transfer->count[LMB_TRANSFER_CLUSTERS];
}

/* Lights receivers; a unit is UNIT_RECEIVERS of them. */
static lmb_status transfer_step(lmb_render *r, const frame_solver *own, int32_t units)
{
    const lmb_frame *f = &r->frame;
    (void)own;
    if (skips(r, LMB_SKIP_BOUNCE)) {
        return LMB_OK;
    }
    const uint32_t all = receivers_of(f), first = r->progress, left = (all - first) / UNIT_RECEIVERS,
                   past = left < (uint32_t)units ? all : first + (uint32_t)units * UNIT_RECEIVERS;
    const lmb_status status = lmb_transfer_receivers(&f->transfer_light, f->kernels, f->transfer, first, past);
    r->progress = past;
    return status != LMB_OK ? status : past < all ? LMB_MORE : LMB_OK;
}

static float transfer_done(const lmb_render *r)
{
    const uint32_t all = receivers_of(&r->frame);
    return (float)r->progress / (float)(all > 0 ? all : 1);
}

static lmb_status transfer_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                                const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    (void)direct;
    return lmb_transfer_tile(inout, glossy, f->kernels, &s->gather.transfer, &f->transfer_light, f->transfer, f->scene,
                             tile);
}

const frame_solver lmb_solver_transfer = {
    .place = transfer_place,
    .begin = transfer_begin,
    .collect = transfer_collect,
#if LMB_TREES
    .end_points = transfer_many_lights,
#endif
    .build = transfer_build,
    .step = transfer_step,
    .done = transfer_done,
    .tile = transfer_tile,
};

#endif
