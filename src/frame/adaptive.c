/* adaptive.c: bounced light at samples of a lattice and between them; also runs the phases of live_phases.c. Layer 8.
 *
 * r->light is the phase, r->progress the next band or window. In a phase a window writes only its own pixels, and reads
 * from others only results of earlier phases. So any order and number of threads gives the same bytes. */
#include <string.h>

#include "../base/vec.h"
#include "../bounce/points.h"
#include "../raster/tile.h"
#include "lattice.h"
#include "stages.h"
#include "requires.h"

#if LMB_TREES

enum {
    PHASE_SURFACES = 0, /* bands: stores the surfaces of the pixels */
    PHASE_LEVELS = 1,   /* windows: samples of the first level, the second, ... */
    PHASE_FILL = PHASE_LEVELS + LATTICE_LEVELS,
    PHASE_REST, /* pixels that no sample explains */
    ADAPTIVE_PHASES
};
enum { WINDOW_UNITS = 64 };

#define SPLIT_PER_ERROR2 28.0f  /* times the squared error limit: lmb_lattice.split */
#define LIVE_SPLIT 290.0f /* over strata^2: sampling errors of shadows should not cause divisions */

static lmb_status take_band_surfaces(const lmb_render *r, lmb_band_scratch *s, int32_t band)
{
    const lmb_frame *f = &r->frame;
    lmb_target eye;
    lmb_status status = lmb_render_view_band(r, &eye, &f->eye, band);
    for (int32_t x = 0; x < f->view.frame_width && status == LMB_OK; x += LMB_TILE) {
        status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, &eye, x, band * LMB_TILE);
        if (status == LMB_OK) {
            lmb_render_onto_triangles(&s->tile, f);
            const int lobes = requires_glossy(r) && lmb_glossy_tile(&s->glossy, &s->tile, &f->view, f->scene);
            lmb_lattice_put(&f->lattice, &s->tile, lobes);
        }
    }
    return status;
}

/* --- packs: wanted pixels of one surface, gathered as a tile ------------------------------------------------------ */

/* Tile i of a window in Morton order, in which consecutive tiles are near each other. */
static lmb_lattice_tile *tile_along(const lmb_lattice *l, const int32_t column[2], const int32_t row[2], int32_t i)
{
    int32_t x = 0, y = 0;
    for (int32_t bit = 0; 1 << bit < LATTICE_WINDOW; ++bit) {
        x |= (i >> (2 * bit) & 1) << bit;
        y |= (i >> (2 * bit + 1) & 1) << bit;
    }
    return column[0] + x < column[1] && row[0] + y < row[1] ? lattice_tile(l, column[0] + x, row[0] + y) : NULL;
}

/* Like tile_plane. */
static int on_plane(const lmb_lattice_tile *a, int i, const lmb_lattice_tile *b, int k)
{
    const lmb_vec3 n = tile_vec(a->face, i), d = sub3(tile_vec(b->position, k), tile_vec(a->position, i));
    const float height = dot3(n, d);
    return dot3(n, tile_vec(b->face, k)) >= TILE_COS_25 && height * height <= TILE_FLAT * TILE_FLAT * dot3(d, d);
}

/* The depth bounds the rounding error of the position. */
static void put_window_pixel(lmb_tile *out, int to, const lmb_lattice_tile *in, int from, const lmb_frame *f)
{
    for (int c = 0; c < 3; ++c) {
        out->position[c][to] = in->position[c][from];
        out->face[c][to] = in->face[c][from];
        out->normal[c][to] = in->normal[c][from];
    }
    out->depth[to] = absf(dot3(f->view.back, sub3(tile_vec(in->position, from), f->view.eye)));
    out->id[to] = requires_live(f) ? in->id[from] : 1;
}

/* A pack being filled: the pixels are in s->together, with their origins in `pixel` and `tile`. */
typedef struct pack {
    const lmb_render *r;
    lmb_band_scratch *s;
    int32_t column[2], row[2];
    lmb_lattice_tile *seed;
    int seed_pixel;
    int32_t count;
    uint16_t tile[LMB_TILE_PIXELS]; /* index in Morton order */
} pack;

static void put_alike(pack *p, lmb_lattice_tile *tile, int32_t i)
{
    for (uint64_t bits = tile->wanted; bits != 0 && p->count < LMB_TILE_PIXELS; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        if (p->seed == NULL) {
            p->seed = tile;
            p->seed_pixel = k;
        }
        if (on_plane(p->seed, p->seed_pixel, tile, k)) {
            put_window_pixel(&p->s->together, p->count, tile, k, &p->r->frame);
            p->s->pixel[p->count] = (uint16_t)k;
            p->tile[p->count++] = (uint16_t)i;
            tile->wanted &= ~((uint64_t)1 << k);
        }
    }
}

static lmb_status gather_pack(const pack *p)
{
    memset(&p->s->indirect, 0, sizeof p->s->indirect);
    const lmb_status status = lmb_render_gather(&p->s->indirect, NULL, p->r, p->s, &p->s->together, NULL);
    for (int32_t i = 0; i < p->count; ++i) {
        lmb_lattice_tile *tile = tile_along(&p->r->frame.lattice, p->column, p->row, p->tile[i]);
        if (tile == NULL) {
            continue; /* a pack never contains such a tile */
        }
        for (int c = 0; c < 3; ++c) {
            tile->light.rgb[c][p->s->pixel[i]] = p->s->indirect.rgb[c][i];
        }
        tile->known |= (uint64_t)1 << p->s->pixel[i];
    }
    return status;
}

/* Gathers the wanted pixels of a window. */
static lmb_status gather_window(const lmb_render *r, lmb_band_scratch *s, int32_t window)
{
    const lmb_lattice *l = &r->frame.lattice;
    lmb_status status = LMB_OK;
    pack p;
    p.r = r;
    p.s = s;
    lmb_lattice_window(p.column, p.row, l, window);
    for (int32_t first = 0; first < LATTICE_WINDOW * LATTICE_WINDOW && status == LMB_OK;) {
        const lmb_lattice_tile *at = tile_along(l, p.column, p.row, first);
        if (at == NULL || at->wanted == 0) {
            ++first;
            continue;
        }
        p.seed = NULL;
        p.count = 0;
        memset(&s->together, 0, sizeof s->together);
        for (int32_t i = first; i < LATTICE_WINDOW * LATTICE_WINDOW && p.count < LMB_TILE_PIXELS; ++i) {
            lmb_lattice_tile *tile = tile_along(l, p.column, p.row, i);
            if (tile != NULL && tile->wanted != 0) {
                put_alike(&p, tile, i);
            }
        }
        status = gather_pack(&p);
    }
    return status;
}

/* --- phases ------------------------------------------------------------------------------------------------------- */

static int32_t pieces_of(const lmb_render *r)
{
    if (lights_points(r)) {
        return lmb_render_live_pieces(r);
    }
    return r->light == PHASE_SURFACES ? band_count(&r->frame.view) : lmb_lattice_windows(&r->frame.lattice);
}

static lmb_status do_piece(const lmb_render *r, lmb_band_scratch *s, int32_t i)
{
    const lmb_lattice *l = &r->frame.lattice;
    if (r->light == PHASE_SURFACES) {
        return take_band_surfaces(r, s, i);
    }
    if (r->light == PHASE_FILL) {
        lmb_lattice_fill(l, i);
        return LMB_OK;
    }
    if (r->light == PHASE_REST) {
        lmb_lattice_rest(l, i);
    }
    lmb_status status = gather_window(r, s, i);
    if (r->light == PHASE_REST && status == LMB_OK) {
        lmb_lattice_closer(l, i);
        status = gather_window(r, s, i);
        lmb_lattice_late(l, i);
    }
    return status;
}

static float split_of(const lmb_frame *f)
{
    const float strata = requires_live(f) ? (float)f->live->strata : 0.0f;
    return requires_live(f) ? LIVE_SPLIT / (strata * strata) : SPLIT_PER_ERROR2 * f->error * f->error;
}

/* Advances to the next phase. */
lmb_status lmb_render_samples_on(lmb_render *r)
{
    r->progress = 0;
    if (lights_points(r)) {
        return lmb_render_live_on(r);
    }
    const int32_t level = (int32_t)r->light - PHASE_LEVELS;
    if (level == 0) {
        r->frame.lattice.mean = lmb_lattice_mean(&r->frame.lattice);
        r->frame.lattice.split = split_of(&r->frame);
    }
    if (level >= 0 && level < LATTICE_LEVELS - 1) {
        lmb_lattice_divide(&r->frame.lattice, level);
    }
    return ++r->light < ADAPTIVE_PHASES ? LMB_MORE : LMB_OK;
}

lmb_status lmb_render_samples(lmb_render *r, int32_t units)
{
    lmb_band_scratch *s = r->frame.scratch;
    const int32_t each = r->light == PHASE_SURFACES ? LMB_TILE : WINDOW_UNITS;
    for (int32_t n = 0; (n == 0 || n + each <= units) && (int32_t)r->progress < pieces_of(r); n += each) {
        memset(&s->counts, 0, sizeof s->counts);
        const int32_t i = (int32_t)r->progress++;
        const lmb_status status = lights_points(r) ? lmb_render_live_piece(r, s, i) : do_piece(r, s, i);
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
        status = lights_points(r) ? lmb_render_live_piece(r, s, (int32_t)i) : do_piece(r, s, (int32_t)i);
    }
    add_counts(stats, &s->counts);
    return status;
}

#endif
