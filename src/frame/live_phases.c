/* live_phases.c: light of single points at the samples of a grid, and between them. Layer 8.
 *
 * r->light is the phase, r->progress the next piece: two rows of tiles. In a phase a piece writes only its own samples,
 * and reads from others only results of earlier phases. So any order and number of threads gives the same bytes. Pixels
 * between samples are lit as the bands are drawn. */
#include <string.h>

#include "../base/vec.h"
#include "../bounce/points.h"
#include "../live/live_part.h"
#include "../raster/plane.h"
#include "../raster/target.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "live_grid.h"
#include "stages.h"
#include "requires.h"

#if LMB_LIVE

enum {
    SURFACES = 0, /* stores the surfaces of samples; lights those of level 0 */
    CELLS_16,     /* divides */
    SAMPLES_8,    /* lights */
    CELLS_8,
    SAMPLES_4,
    CELLS_4,
    SAMPLES_2,
    SHADOWS, /* removes their noise */
    SLOPES,
    PHASES
};
enum { ROWS = 2, PIECE_UNITS = 64 };

/* px each way within which a pixel that no sample explains needs a lit pixel */
#define MAX_REACH_PX 3
#define FINE_REACH_PX 2 /* with more segments than draft has */
#define SMALL_REACH_PX 5 /* with LMB_LIVE_SMALL */

static live_grid grid_of(const lmb_render *r) { return lmb_live_grid_of(&r->frame.lattice, r->frame.live->strata); }

/* --- samples ------------------------------------------------------------------------------------------------------ */

/* x, y: the sample's pixel. */
static lmb_live_receiver receiver_of(const lmb_render *r, const lmb_live_sample *s, int32_t x, int32_t y)
{
    const lmb_view *v = &r->frame.view;
    const lmb_vec3 at = s->position;
    const lmb_live_receiver receiver = {at, s->face, s->normal, s->id,
                                        lmb_place_noise(at, absf(dot3(v->back, sub3(at, v->eye)))),
                                        view_to_eye(v, at), live_turn(x / GRID_STEP, y / GRID_STEP)};
    return receiver;
}

static lmb_status light_sample(const lmb_render *r, lmb_band_scratch *s, lmb_live_sample *inout, int32_t x, int32_t y)
{
    const lmb_live_receiver receiver = receiver_of(r, inout, x, y);
    const lmb_status status = lmb_render_live(inout->light, r, s, &receiver);
    for (int i = 0; i < 2 && status == LMB_OK; ++i) {
        const float *seen = i == 0 ? s->live->seen : s->live->sky_seen, steps = i == 0 ? LIVE_STEPS : LIVE_SKY_STEPS;
        memcpy(inout->slope[i], i == 0 ? s->live->whole : s->live->sky_whole, sizeof inout->slope[i]);
        inout->is_lit[i] = (uint8_t)(seen[0] >= 0.0f);
        for (int c = 0; c < 3; ++c) {
            inout->seen[i][c] = (uint16_t)(clampf(seen[c], 0.0f, 1.0f) * steps + 0.5f);
        }
    }
    return status;
}

/* Lights the requested samples of a tile. tile: its surfaces; NULL: they are stored. */
NOINLINE lmb_status light_live_tile(const lmb_render *r, lmb_band_scratch *s, const live_grid *g, int32_t column,
                               int32_t row, const lmb_tile *tile, uint32_t asked)
{
    live_grid_tile *t = grid_tile(g, column, row);
    lmb_status status = LMB_OK;
    for (uint32_t bits = asked; bits != 0 && status == LMB_OK; bits &= bits - 1) {
        const int k = lowest_bit(bits), pixel = grid_pixel(k);
        lmb_live_sample *sample = grid_sample(g, t, k);
        if (tile != NULL) {
            *sample = lmb_live_grid_surface(tile, pixel);
        }
        sample->position = lmb_place_onto_triangle(r->frame.scene, sample->id, sample->position);
        status = light_sample(r, s, sample, column * LMB_TILE + pixel % LMB_TILE, row * LMB_TILE + pixel / LMB_TILE);
    }
    t->known |= (uint16_t)asked;
    return status;
}

/* The last triangle that filled a tile. */
typedef struct filling {
    uint32_t id;
    int is_flat;
    lmb_plane plane;
    lmb_live_sample surface; /* of the last tile's first pixel */
} filling;

/* Id of the triangle that fills a tile; otherwise 0. */
static uint32_t id_that_fills(const lmb_target *eye, int32_t column, int32_t row)
{
    const lmb_fill_tile t = lmb_target_tile(eye, column - eye->x0 / LMB_TILE, row - eye->y0 / LMB_TILE);
    const int is_16 = t.id_format == LMB_ID16;
    const uint32_t id = is_16 ? *(const uint16_t *)t.id : *(const uint32_t *)t.id;
    const uint64_t all = (uint64_t)id * (is_16 ? UINT64_C(0x0001000100010001) : UINT64_C(0x0000000100000001));
    const size_t bytes = is_16 ? LMB_TILE * sizeof(uint16_t) : LMB_TILE * sizeof(uint32_t);
    uint64_t differ = 0, some;
    for (int y = 0; y < LMB_TILE && differ == 0; ++y) {
        const uint8_t *at = (const uint8_t *)t.id + (ptrdiff_t)y * t.id_step * (ptrdiff_t)(bytes / LMB_TILE);
        for (size_t x = 0; x < bytes; x += sizeof some) {
            memcpy(&some, at + x, sizeof some);
            differ |= some ^ all;
        }
    }
    return differ == 0 ? id : 0;
}

/* Selects another triangle and stores the surface of the current tile. */
static void fill_by(filling *out, const lmb_render *r, const lmb_tile *tile, uint32_t id)
{
    const lmb_frame *f = &r->frame;
    lmb_triangle t;
    lmb_rays rays;
    out->id = id;
    out->is_flat = lmb_triangle_is_flat(f->scene, id) && lmb_triangle_fetch(&t, f->scene, id);
    if (out->is_flat) {
        lmb_resolve_rays(&rays, &f->view, tile->x, tile->y);
        lmb_resolve_plane(&out->plane, t.corner, &rays);
        out->surface = lmb_live_grid_surface(tile, 0);
    }
}

/* Moves the surface to the first pixel of another tile, by the formula of lmb_resolve_tile. */
static void fill_at(filling *inout, const lmb_view *view, int32_t x, int32_t y)
{
    const lmb_plane *p = &inout->plane;
    lmb_rays rays;
    lmb_resolve_rays(&rays, view, x, y);
    const float slope = dot3(p->plane, rays.direction), height = dot3(p->plane, sub3(p->corner, rays.origin)),
                w = clampf(height / (slope * slope < 1e-36f ? 1e-18f : slope), p->w_min, p->w_max);
    inout->surface.position = add3(add3(rays.origin, mul3(rays.direction, w)), rays.eye);
}

/* Stores the surfaces of a tile. In a room, the triangle that fills a tile usually fills the next tile too. */
static lmb_status take_own_surface(filling *last, const lmb_render *r, lmb_band_scratch *s, const live_grid *g,
                               int32_t column, int32_t row)
{
    const lmb_frame *f = &r->frame;
    const lmb_target *eye = &s->live->window;
    const int32_t x = column * LMB_TILE, y = row * LMB_TILE;
    const uint32_t id = grid_is_last(g, column, row) || requires_glossy(r) ? 0 : id_that_fills(eye, column, row);
    if (id != 0 && last->id == id && last->is_flat) {
        fill_at(last, &f->view, x, y);
        lmb_live_grid_put_even(g, &last->surface, column, row);
        return LMB_OK;
    }
    const lmb_status status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, eye, x, y);
    if (status == LMB_OK) {
        lmb_live_grid_put(g, &s->tile,
                          requires_glossy(r) && lmb_glossy_tile(&s->glossy, &s->tile, &f->view, f->scene));
    }
    if (status == LMB_OK && id != 0 && last->id != id) {
        fill_by(last, r, &s->tile, id);
    }
    return status;
}

NOINLINE lmb_status take_row(const lmb_render *r, lmb_band_scratch *s, const live_grid *g, int32_t row)
{
    filling last;
    lmb_status status = LMB_OK;
    last.id = 0;
    for (int32_t column = 0; column < g->columns && status == LMB_OK; ++column) {
        status = take_own_surface(&last, r, s, g, column, row);
        if (status == LMB_OK) {
            status = light_live_tile(r, s, g, column, row, NULL, lmb_live_grid_asks(g, column, row, 0));
        }
    }
    return status;
}

static lmb_status take_surfaces(const lmb_render *r, lmb_band_scratch *s, const live_grid *g, int32_t row)
{
    const lmb_status status = lmb_render_view_strip(r, &s->live->window, row);
    return status == LMB_OK ? take_row(r, s, g, row) : status;
}

/* Lights the samples of a row of tiles that level 1, 2 or 3 requests. */
static lmb_status light_row(const lmb_render *r, lmb_band_scratch *s, const live_grid *g, int32_t row, int32_t level)
{
    const lmb_frame *f = &r->frame;
    lmb_target *eye = &s->live->window;
    lmb_status status = LMB_OK;
    int is_drawn = 0;
    for (int32_t column = 0; column < g->columns && status == LMB_OK; ++column) {
        const uint32_t asked = lmb_live_grid_asks(g, column, row, level);
        if (level == 1) {
            status = light_live_tile(r, s, g, column, row, NULL, asked);
            continue;
        }
        if (asked != 0 && !is_drawn) {
            status = lmb_render_view_band(r, eye, &f->eye, row);
            is_drawn = 1;
        }
        if (asked != 0 && status == LMB_OK) {
            status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, eye, column * LMB_TILE, row * LMB_TILE);
        }
        if (asked != 0 && status == LMB_OK) {
            status = light_live_tile(r, s, g, column, row, &s->tile, asked);
        }
    }
    return status;
}

/* --- phases ------------------------------------------------------------------------------------------------------- */

static int32_t pieces_of(const lmb_render *r) { return (band_count(&r->frame.view) + ROWS - 1) / ROWS; }

static lmb_status do_row(const lmb_render *r, lmb_band_scratch *s, const live_grid *g, int32_t row)
{
    if (r->light == SURFACES) {
        return take_surfaces(r, s, g, row);
    }
    if (r->light < SHADOWS) {
        return light_row(r, s, g, row, (int32_t)r->light / 2);
    }
    for (int32_t column = 0; column < g->columns; ++column) {
        if (r->light == SHADOWS) {
            lmb_live_grid_smooth(g, column, row);
        } else {
            lmb_live_grid_slopes(g, column, row);
        }
    }
    return LMB_OK;
}

static lmb_status do_piece(const lmb_render *r, lmb_band_scratch *s, int32_t i)
{
    const live_grid g = grid_of(r);
    lmb_status status = LMB_OK;
    if (r->light < SHADOWS && r->light % 2 == 1) {
        lmb_live_grid_divide(&g, i * ROWS, (int32_t)r->light / 2);
        return LMB_OK;
    }
    lmb_live_forget(s->live);
    for (int32_t row = i * ROWS; row < mini(i * ROWS + ROWS, g.rows) && status == LMB_OK; ++row) {
        status = do_row(r, s, &g, row);
    }
    return status;
}

NOINLINE void set_mean(lmb_render *r)
{
    const live_grid g = grid_of(r);
    r->frame.lattice.mean = lmb_live_grid_mean(&g);
}

/* Advances to the next phase. */
lmb_status lmb_render_samples_on(lmb_render *r)
{
    r->progress = 0;
    if (r->light == SURFACES) {
        set_mean(r);
    }
    return ++r->light < PHASES ? LMB_MORE : LMB_OK;
}

lmb_status lmb_render_samples(lmb_render *r, int32_t units)
{
    lmb_band_scratch *s = r->frame.scratch;
    for (int32_t n = 0; (n == 0 || n + PIECE_UNITS <= units) && (int32_t)r->progress < pieces_of(r); n += PIECE_UNITS) {
        memset(&s->counts, 0, sizeof s->counts);
        const lmb_status status = do_piece(r, s, (int32_t)r->progress++);
        if (status != LMB_OK) {
            return status;
        }
        add_counts(r->frame.stats, &s->counts);
    }
    return (int32_t)r->progress < pieces_of(r) ? LMB_MORE : lmb_render_samples_on(r);
}

lmb_status lmb_render_samples_part(const lmb_render *r, lmb_band_scratch *s, int32_t part, int32_t parts,
                                   lmb_stats *stats)
{
    int64_t first, past;
    lmb_status status = LMB_OK;
    memset(&s->counts, 0, sizeof s->counts);
    share_out(&first, &past, pieces_of(r), part, parts);
    for (int64_t i = first; i < past && status == LMB_OK; ++i) {
        status = do_piece(r, s, (int32_t)i);
    }
    add_counts(stats, &s->counts);
    return status;
}

/* --- pixels that no sample explains ------------------------------------------------------------------------------- */

/* Sources of light for a pixel: a mask of individually lit pixels of the tile, and samples of the tile and the cell. */
typedef struct sources {
    const lmb_tile *tile;
    const lmb_irradiance *light;
    uint64_t known;
    int count, reach;
    const lmb_live_sample *sample[GRID_SAMPLES + 3];
    int8_t x[GRID_SAMPLES + 3], y[GRID_SAMPLES + 3];
} sources;

/* Light at a pixel, averaged over the sources. */
typedef struct around {
    float sum, light[3]; /* sums of weights and of weighted light */
} around;

static void add_around(around *a, const float light[3], float weight)
{
    a->sum += weight;
    for (int c = 0; c < 3; ++c) {
        a->light[c] += weight * light[c];
    }
}

static int is_within(const sources *s, int dx, int dy)
{
    return dx >= -s->reach && dx <= s->reach && dy >= -s->reach && dy <= s->reach;
}

/* Weight of a source at an offset of dx, dy px. */
static float nearness(int dx, int dy)
{
    const float d2 = 0.5f + (float)(dx * dx + dy * dy);
    return 1.0f / (d2 * d2);
}

/* Averages the sources within reach. */
static around around_of(const sources *s, int k)
{
    const lmb_live_sample own = lmb_live_grid_surface(s->tile, k);
    const int x = k % LMB_TILE, y = k / LMB_TILE;
    around a;
    memset(&a, 0, sizeof a);
    for (int i = 0; i < s->count; ++i) {
        const int dx = s->x[i] - x, dy = s->y[i] - y;
        const float weight = is_within(s, dx, dy) ? live_agree(&own, s->sample[i]) * nearness(dx, dy) : 0.0f;
        if (weight > 0.0f) {
            add_around(&a, s->sample[i]->light, weight);
        }
    }
    for (uint64_t bits = s->known; bits != 0; bits &= bits - 1) {
        const int from = lowest_bit_64(bits), dx = from % LMB_TILE - x, dy = from / LMB_TILE - y;
        const lmb_live_sample other = lmb_live_grid_surface(s->tile, from);
        const float weight = is_within(s, dx, dy) ? live_agree(&own, &other) * nearness(dx, dy) : 0.0f;
        if (weight > 0.0f) {
            const float light[3] = {s->light->rgb[0][from], s->light->rgb[1][from], s->light->rgb[2][from]};
            add_around(&a, light, weight);
        }
    }
    return a;
}

static void set_sources(sources *out, const live_grid *g, const lmb_tile *tile, const lmb_irradiance *light)
{
    const int32_t column = tile->x / LMB_TILE, row = tile->y / LMB_TILE;
    out->tile = tile;
    out->light = light;
    out->known = 0;
    out->count = 0;
    for (int i = 0; i < 4; ++i) {
        const int32_t right = i & 1, down = i >> 1;
        if (column + right < g->columns && row + down < g->rows) {
            const live_grid_tile *t = grid_tile(g, column + right, row + down);
            for (uint32_t bits = i == 0 ? t->known : t->known & 1u; bits != 0; bits &= bits - 1) {
                const int k = lowest_bit(bits);
                out->sample[out->count] = grid_sample(g, t, k);
                out->x[out->count] = (int8_t)(right * LMB_TILE + k % GRID_SIDE * GRID_STEP);
                out->y[out->count++] = (int8_t)(down * LMB_TILE + k / GRID_SIDE * GRID_STEP);
            }
        }
    }
}

ALWAYS_INLINE lmb_status light_pixel(lmb_irradiance *out, const lmb_render *r, lmb_band_scratch *s, int k)
{
    lmb_live_sample own = lmb_live_grid_surface(&s->tile, k);
    own.position = lmb_place_onto_triangle(r->frame.scene, own.id, own.position);
    const lmb_status status = light_sample(r, s, &own, s->tile.x + k % LMB_TILE, s->tile.y + k / LMB_TILE);
    for (int c = 0; c < 3; ++c) {
        out->rgb[c][k] = own.light[c];
    }
    return status;
}

NOINLINE lmb_status light_steep(lmb_irradiance *inout, const lmb_render *r, lmb_band_scratch *s, uint64_t steep)
{
    lmb_status status = LMB_OK;
    for (; steep != 0 && status == LMB_OK; steep &= steep - 1) {
        status = light_pixel(inout, r, s, lowest_bit_64(steep));
    }
    return status;
}

/* Lights some of the remaining pixels individually, so that each pixel has a source within reach. */
static lmb_status light_left(lmb_irradiance *inout, const lmb_render *r, lmb_band_scratch *s, const live_grid *g,
                             uint64_t left)
{
    lmb_status status = LMB_OK;
    sources from;
    set_sources(&from, g, &s->tile, inout);
    from.reach = LMB_LIVE_SMALL                                  ? SMALL_REACH_PX
                 : r->frame.live->strata > LMB_LIVE_STRATA / 2 ? FINE_REACH_PX
                                                               : MAX_REACH_PX;
    for (uint64_t bits = left; bits != 0 && status == LMB_OK; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        if (!(around_of(&from, k).sum > 0.0f)) {
            status = light_pixel(inout, r, s, k);
            from.known |= (uint64_t)1 << k;
        }
    }
    for (uint64_t bits = left & ~from.known; bits != 0 && status == LMB_OK; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const around a = around_of(&from, k);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] = a.light[c] / a.sum;
        }
    }
    return status;
}

lmb_status lmb_render_live_tile(lmb_irradiance *out, const lmb_render *r, lmb_band_scratch *s)
{
    const live_grid g = grid_of(r);
    if (s->tile.hits < LMB_TILE_PIXELS) {
        memset(out, 0, sizeof *out);
    }
    if (s->tile.hits == 0 || grid_tile(&g, s->tile.x / LMB_TILE, s->tile.y / LMB_TILE)->lobes) {
        return LMB_OK;
    }
    const uint64_t left = lmb_live_grid_fill(out, r->frame.kernels, &g, &s->tile);
    const lmb_status status = left != 0 ? light_left(out, r, s, &g, left) : LMB_OK;
    return status == LMB_OK ? light_steep(out, r, s, lmb_live_grid_steep(&g, &s->tile)) : status;
}

#endif
