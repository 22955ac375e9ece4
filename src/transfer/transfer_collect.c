/* transfer_collect.c: light from shadow maps to elements. Layer 7.
 *
 * A face of a map is read in blocks of texels, 8 x 8 blocks at once. First each block's light is divided among the
 * triangles that the block shows: each of at most 4 x 4 cells reads the surrounding ids, and a triangle gets the part
 * of a cell inside the outline. Then the light of each triangle descends its halvings; at each one a line divides the
 * light between the halves. All shares change continuously as the light moves. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/vec.h"
#include "../direct/texel.h"
#include "../raster/target.h"
#include "halvings.h"
#include "links.h"

#if LMB_TRANSFER

#define MAX_BLOCK_LIGHT 16777216.0f /* 2^24: max light of a block, and the limit of exact integers in binary32 */

enum { MAX_TRIANGLE_VISITS = 8192 }; /* halvings per triangle of a tile; beyond, light descends undivided */
#define WALL_REACH 2.5f /* blocks from a wall within which light goes to the sides that cells show */

/* State of a collection. */
typedef struct collection {
    const lmb_transfer_light *light;
    const lmb_kernels *kernels;
    const lmb_transfer *transfer;
    const lmb_scene *scene;
    const lmb_light *from;
    const lmb_shadow_map *blocks; /* the map with one texel per block */
    const lmb_target *face;
    const lmb_view *view;
    lmb_fill_window ids;
    lmb_transfer_collecting *work;
    int32_t size, cells, step; /* texels of the map each way; cells of a block; texels of a cell */
    float scale;               /* whole-number steps per W */
    int32_t first[2];          /* column and row of the tile's first block */
} collection;

/* --- triangles on the face ---------------------------------------------------------------------------------------- */

/* Converts an affine function of the position in the view's plane to one of a cell's column and row. */
static void by_cells(float out[3], const collection *c, float at, float by_x, float by_y)
{
    const lmb_view *v = c->view;
    const int32_t middle = c->step / 2;
    const float step = (float)c->step * 2.0f / (float)c->size;
    out[0] = at + by_x * texel_sx(v, c->size, middle) + by_y * texel_sy(v, c->size, middle);
    out[1] = by_x * step * v->half_width;
    out[2] = -by_y * step * v->half_height;
}

/* Sets out to a . p as a function of the position in the view's plane. p starts at `from` and moves with the position,
 * and by `back` against the view direction. */
static void set_function(float out[3], const collection *c, lmb_vec3 a, lmb_vec3 from, float back)
{
    const lmb_view *v = c->view;
    by_cells(out, c, dot3(a, from) - back * dot3(a, v->back), dot3(a, v->right), dot3(a, v->up));
}

/* Perspective: the ray at (sx, sy) meets the triangle's plane at 1 / near, near = n.ray / n.(corner - eye); weights are
 * along.(eye - corner) + along.ray / near. Sun: the ray meets the plane at n.(start - corner) / n.back, and weights are
 * linear. */
static int set_outline(lmb_transfer_shown *s, const collection *c, const lmb_transfer_triangle *t)
{
    const lmb_view *v = c->view;
    const int is_far = v->kind != LMB_PERSPECTIVE;
    const lmb_vec3 from = sub3(v->eye, t->corner);
    const float d = is_far ? dot3(t->normal, v->back) : -dot3(t->normal, from);
    if (!(absf(d) > 1e-20f)) {
        return 0;
    }
    set_function(s->near, c, mul3(t->normal, 1.0f / d), is_far ? from : vec3(0, 0, 0), is_far ? 0.0f : 1.0f);
    for (int i = 0; i < 2; ++i) {
        const float times = is_far ? -dot3(t->along[i], v->back) : dot3(t->along[i], from);
        set_function(s->corner[i + 1], c, t->along[i], is_far ? from : vec3(0, 0, 0), is_far ? 0.0f : 1.0f);
        for (int k = 0; k < 3; ++k) {
            s->corner[i + 1][k] += times * s->near[k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        const float all = is_far ? (k == 0 ? 1.0f : 0.0f) : s->near[k];
        s->corner[0][k] = all - s->corner[1][k] - s->corner[2][k];
        s->near[k] = is_far ? -s->near[k] : s->near[k];
    }
    for (int k = 0; k < 3; ++k) {
        s->per[k] = 1.0f / maxf(absf(s->corner[k][1]) + absf(s->corner[k][2]), 1e-30f);
    }
    for (int k = 0; k < 3; ++k) {
        const float *a = s->corner[(k + 1) % 3], *b = s->corner[(k + 2) % 3];
        const float lengths = (a[1] * a[1] + a[2] * a[2]) * (b[1] * b[1] + b[2] * b[2]);
        s->cosine[k] = clampf((a[1] * b[1] + a[2] * b[2]) / sqrtf(maxf(lengths, 1e-30f)), -1.0f, 1.0f);
    }
    return 1;
}

static void set_shown(lmb_transfer_shown *s, const collection *c, uint32_t id)
{
    lmb_transfer_triangle t;
    lmb_triangle of;
    memset(s, 0, sizeof *s);
    s->id = id;
    s->root = LMB_TRANSFER_NONE;
    if (id > c->transfer->count[LMB_TRANSFER_SURFACES] || !lmb_triangle_fetch(&of, c->scene, id) ||
        !transfer_triangle_of(&t, c->scene, id)) {
        return;
    }
    const lmb_vec3 ray = c->view->kind == LMB_PERSPECTIVE ? sub3(t.corner, c->view->eye) : mul3(c->view->back, -1.0f);
    const uint32_t back = dot3(t.normal, ray) > 0.0f;
    s->root = c->transfer->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1) + back];
    s->has_outline = set_outline(s, c, &t) && (of.material->flags & LMB_ALPHA_MASK) == 0;
}

/* Returns NULL if id is 0. */
static const lmb_transfer_shown *shown(const collection *c, uint32_t id)
{
    lmb_transfer_shown *s = &c->work->shown[id % LMB_TRANSFER_SHOWN];
    if (id != 0 && s->id != id) {
        set_shown(s, c, id);
    }
    return id != 0 ? s : NULL;
}

static float value(const float f[3], float x, float y) { return f[0] + f[1] * x + f[2] * y; }

/* --- ids of blocks and cells -------------------------------------------------------------------------------------- */

/* The one id that a block's cells show; LMB_TRANSFER_NONE if they show several. */
static uint32_t *block_id(const collection *c, int32_t x, int32_t y) { return &c->work->block_id[y + 1][x + 1]; }

/* Address of the eight adjacent ids that contain x. */
static const uint8_t *ids_at(const collection *c, int32_t x, int32_t y)
{
    const lmb_fill_window *w = &c->ids;
    const int32_t bytes = w->first.id_format == LMB_ID16 ? 2 : 4;
    return (const uint8_t *)w->first.id + (ptrdiff_t)(y / LMB_TILE) * w->id_row +
           (ptrdiff_t)(x / LMB_TILE) * w->id_tile + (ptrdiff_t)(y % LMB_TILE) * w->first.id_step * bytes;
}

/* A texel in a cell's row or column; clamped to the face. */
static int32_t texel_of_cell(const collection *c, int32_t cell)
{
    return maxi(mini(cell, c->size / c->step - 1), 0) * c->step + c->step / 2;
}

/* One of eight adjacent ids. */
static uint32_t id_in(const collection *c, const uint8_t *eight, int32_t i)
{
    return c->ids.first.id_format == LMB_ID16 ? ((const uint16_t *)(const void *)eight)[i]
                                              : ((const uint32_t *)(const void *)eight)[i];
}

/* Id at the middle of a block's cell. */
static uint32_t cell_id(const collection *c, int32_t x, int32_t y, int32_t column, int32_t row)
{
    const int32_t at = texel_of_cell(c, (c->first[0] + x) * c->cells + column);
    return id_in(c, ids_at(c, at, texel_of_cell(c, (c->first[1] + y) * c->cells + row)), at % LMB_TILE);
}

/* --- a triangle's light on the way down the halvings -------------------------------------------------------------- */

static void add_light(const collection *c, uint32_t element, int32_t sum)
{
    const float power = (float)sum / c->scale;
    for (int i = 0; i < 3; ++i) {
        c->light->power[element][i] += texel_flux(c->from->intensity[i], power);
    }
}

/* Enters a half. The kept corner's function loses the moved corner's; the moved corner's is doubled. */
static void enter_lit_half(lmb_transfer_part *p, const transfer_halving *h, int second)
{
    const transfer_half half = half_of(h, second);
    for (int k = 0; k < 3; ++k) {
        p->corner[half.keeps][k] -= half.less * p->corner[half.moves][k];
        p->corner[half.moves][k] *= half.more;
    }
    p->at = h->first + (uint32_t)second;
    ++p->depth;
}

/* --- walls -------------------------------------------------------------------------------------------------------- */

/* The sides of a line on which one block shows the triangle, at cell middles: one bit for each side. The block lies
 * `across` blocks to the right of block (x, y) and `down` blocks below it. If it shows only the triangle, the four
 * corner cells decide, because the function of the line is monotone along each row and column, also when rounded. */
static uint32_t sides_of_block(const collection *c, uint32_t id, const float line[3], int32_t x, int32_t y,
                               int32_t across, int32_t down)
{
    const uint32_t only = *block_id(c, x + across, y + down);
    const float per = 1.0f / (float)c->cells;
    const int32_t cells = only == id || only == LMB_TRANSFER_NONE ? c->cells : 0,
                  step = only == id ? maxi(cells - 1, 1) : 1;
    uint32_t sides = 0;
    for (int32_t i = 0; i < cells && sides != 3; i += step) {
        for (int32_t k = 0; k < cells; k += step) {
            const int32_t column = across * cells + k, row = down * cells + i;
            if (only == id || cell_id(c, x, y, column, row) == id) {
                const float at_x = (float)x + ((float)column + 0.5f) * per - 0.5f,
                            at_y = (float)y + ((float)row + 0.5f) * per - 0.5f;
                sides |= value(line, at_x, at_y) < 0.0f ? 2u : 1u;
            }
        }
    }
    return sides;
}

/* Which sides of a line does the triangle appear on, at cell middles of a block and the blocks around it? One bit for
 * each side. */
static uint32_t sides_shown(const collection *c, uint32_t id, const float line[3], int32_t x, int32_t y)
{
    uint32_t sides = 0;
    for (int32_t i = 0; i < 9 && sides != 3; ++i) {
        sides |= sides_of_block(c, id, line, x, y, i % 3 - 1, i / 3 - 1);
    }
    return sides;
}

/* Near a wall a block's light goes to the one side that the light sees there, if it sees only one. A division by area
 * would leak through the wall. Both parts stay whole numbers. */
static void part_at_wall(const collection *c, lmb_transfer_part *p, uint32_t id, const float line[3])
{
    uint32_t rows[2] = {0, 0};
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = k % LMB_TILE, y = k / LMB_TILE;
        const uint32_t row = 1u << y;
        float *first = &p[1].light[k], *last = &p->light[k];
        if ((row & (p->rows | p[1].rows)) == 0) {
            continue;
        }
        *first = (row & p[1].rows) != 0 ? *first : 0.0f;
        *last = (row & p->rows) != 0 ? *last : 0.0f;
        const int is_near = *first + *last > 0.0f && absf(value(line, (float)x, (float)y)) < WALL_REACH;
        const uint32_t sides = is_near ? sides_shown(c, id, line, x, y) : 0;
        if (sides == 1 || sides == 2) {
            const float all = *first + *last;
            *first = sides == 1 ? all : 0.0f;
            *last = all - *first;
        }
        rows[0] |= *first > 0.0f ? row : 0u;
        rows[1] |= *last > 0.0f ? row : 0u;
    }
    p[1].rows = rows[0];
    p->rows = rows[1];
}

/* Continues with one half, or with both, and then the second waits. Returns the number of parts. */
static int32_t halve_parts(const collection *c, int32_t parts, uint32_t id, uint32_t node, int can_part)
{
    lmb_transfer_part *p = &c->light->part[parts - 1];
    const transfer_halving h = halving_of(c->transfer, node);
    const float reach = h.is_wall ? 4.0f + WALL_REACH : 4.0f;
    float line[3];
    for (int k = 0; k < 3; ++k) {
        line[k] = p->corner[h.from][k] - h.ratio * p->corner[halving_to(h.from)][k];
    }
    const float by = absf(line[1]) + absf(line[2]), middle = value(line, 3.5f, 3.5f);
    if (!can_part || parts == LMB_TRANSFER_PARTS || !(absf(middle) < reach * by) || !(by < 1e30f)) {
        enter_lit_half(p, &h, middle < 0.0f);
        return parts;
    }
    for (int k = 0; k < 3; ++k) {
        line[k] /= by;
    }
    const uint32_t has = c->kernels->transfer_halve(p[1].light, p->light, line, p->rows);
    p[1].rows = has & LMB_TRANSFER_ALL_ROWS;
    p->rows = has >> LMB_TILE;
    if (h.is_wall) {
        part_at_wall(c, p, id, line);
    }
    if (p[1].rows != 0 && p->rows != 0) {
        memcpy(p[1].corner, p->corner, sizeof p->corner);
        p[1].depth = p->depth;
        enter_lit_half(p, &h, 1);
        enter_lit_half(p + 1, &h, 0);
        return parts + 1;
    }
    const int is_second = p->rows != 0;
    if (!is_second) {
        memcpy(p->light, p[1].light, sizeof p->light);
        p->rows = p[1].rows;
    }
    enter_lit_half(p, &h, is_second);
    return parts;
}

static int32_t sum_of_blocks(const lmb_transfer_part *p)
{
    int32_t sum = 0;
    for (int y = 0; y < LMB_TILE; ++y) {
        if ((p->rows >> y & 1u) == 0) {
            continue;
        }
        for (int x = 0; x < LMB_TILE; ++x) {
            sum += (int32_t)p->light[LMB_TILE * y + x];
        }
    }
    return sum;
}

/* Starts with the light of the first part. */
static void collect_parts(const collection *c, uint32_t id)
{
    const uint32_t *node = c->transfer->section[LMB_TRANSFER_PIECES];
    for (int32_t parts = 1, visits = 0; parts > 0; ++visits) {
        const lmb_transfer_part *p = &c->light->part[parts - 1];
        const uint32_t word = node[p->at];
        if ((word & LMB_TRANSFER_LEAF) != 0) {
            add_light(c, word & ~LMB_TRANSFER_LEAF, sum_of_blocks(p));
            --parts;
        } else if (p->depth == LMB_TRANSFER_MAX_HALVINGS) {
            --parts;
        } else {
            parts = halve_parts(c, parts, id, word, visits < MAX_TRIANGLE_VISITS);
        }
    }
}

/* A triangle's functions in blocks of the current tile. */
static void set_shown_corners(float corner[3][3], const collection *c, const lmb_transfer_shown *s)
{
    const float cells = (float)c->cells;
    /* Middle of the first block, in cells. */
    const float in = 0.5f * (cells - 1.0f) + ((float)(c->step % 2 - 1) * 0.5f) / (float)c->step;
    for (int k = 0; k < 3; ++k) {
        const float *f = s->corner[k];
        corner[k][0] = value(f, (float)c->first[0] * cells + in, (float)c->first[1] * cells + in);
        corner[k][1] = f[1] * cells;
        corner[k][2] = f[2] * cells;
    }
}

/* Range factor of the light at the middle of block k. The corner functions add up to 1 / depth there. The sum is 0 or
 * less if the block does not see the triangle's plane. */
static float left_by_range(const collection *c, const lmb_transfer_sharer *from, int k, float range2)
{
    const float x = (float)(k % LMB_TILE), y = (float)(k / LMB_TILE);
    const float sx = texel_sx(c->view, c->blocks->size, c->first[0] + k % LMB_TILE),
                sy = texel_sy(c->view, c->blocks->size, c->first[1] + k / LMB_TILE);
    const float near = value(from->corner[0], x, y) + value(from->corner[1], x, y) + value(from->corner[2], x, y);
    return near > 1e-10f ? light_within((1.0f + sx * sx + sy * sy) / (near * near), range2) : 0.0f;
}

static void collect_sharer(const collection *c, const lmb_transfer_sharer *from)
{
    const float range2 = light_range2(c->from);
    lmb_transfer_part *p = c->light->part;
    for (uint32_t rows = from->rows; rows != 0; rows &= rows - 1) {
        const int first = LMB_TILE * lowest_bit_64(rows);
        for (int k = first; k < first + LMB_TILE; ++k) {
            p->light[k] = (float)(int32_t)(minf(from->share[k], 1.0f) * c->work->power[k]);
        }
        for (int k = first; k < first + LMB_TILE && range2 > 0.0f; ++k) {
            if (p->light[k] > 0.0f) {
                p->light[k] = (float)(int32_t)(p->light[k] * left_by_range(c, from, k, range2));
            }
        }
    }
    p->rows = from->rows;
    p->at = from->root;
    p->depth = 0;
    memcpy(p->corner, from->corner, sizeof p->corner);
    collect_parts(c, from->id);
}

/* --- shares of triangles ------------------------------------------------------------------------------------------ */

static void collect_sharers(const collection *c)
{
    for (int32_t i = 0; i < c->work->sharers; ++i) {
        collect_sharer(c, &c->work->sharer[i]);
    }
    c->work->sharers = 0;
}

/* Index among the sharers, which are flushed if there are too many; NULL if the triangle has no elements. */
static lmb_transfer_sharer *sharer_of(const collection *c, uint32_t id)
{
    lmb_transfer_collecting *w = c->work;
    for (int32_t i = 0; i < w->sharers; ++i) {
        if (w->sharer[i].id == id) {
            return &w->sharer[i];
        }
    }
    const lmb_transfer_shown *s = shown(c, id);
    if (s == NULL || s->root == LMB_TRANSFER_NONE) {
        return NULL;
    }
    if (w->sharers == LMB_TRANSFER_SHARERS) {
        collect_sharers(c);
    }
    lmb_transfer_sharer *to = &w->sharer[w->sharers++];
    memset(to, 0, sizeof *to);
    to->id = id;
    to->root = s->root;
    set_shown_corners(to->corner, c, s);
    return to;
}

static void add_block_share(const collection *c, uint32_t id, int block, float share)
{
    if (share > 0.0f) {
        lmb_transfer_sharer *to = sharer_of(c, id);
        if (to != NULL) {
            to->share[block] += share;
            to->rows |= 1u << block / LMB_TILE;
        }
    }
}

/* --- reading ids -------------------------------------------------------------------------------------------------- */

/* Adds an id unless it is present. */
static void add_id(lmb_transfer_several *to, uint32_t id)
{
    int32_t i = 0;
    while (i < mini(to->count, LMB_TRANSFER_SHARING) && to->id[i] != id) {
        ++i;
    }
    if (i < to->count) {
        return;
    }
    to->count = mini(i + 1, LMB_TRANSFER_SHARING + 1);
    if (i < LMB_TRANSFER_SHARING) {
        to->id[i] = id;
    }
}

static lmb_transfer_several *several_of(const collection *c, int32_t x, int32_t y)
{
    return &c->work->several[(y + 1) % 3][x + 1];
}

/* Reads the ids of a block. `row` points to the rows of eight texels that contain the block, which starts at texel
 * `in`; if `row` is NULL, any block is read. */
static void read_block(const collection *c, int32_t x, int32_t y, const uint8_t *const *row, ptrdiff_t at, int32_t in)
{
    lmb_transfer_several *to = several_of(c, x, y);
    uint32_t last = LMB_TRANSFER_NONE;
    to->count = 0;
    for (int32_t i = 0; i < c->cells; ++i) {
        for (int32_t k = 0; k < c->cells; ++k) {
            const uint32_t id =
                row != NULL ? id_in(c, row[i] + at, in + k * c->step + c->step / 2) : cell_id(c, x, y, k, i);
            if (id != last) {
                add_id(to, id);
            }
            last = id;
        }
    }
    *block_id(c, x, y) = to->count == 1 ? to->id[0] : LMB_TRANSFER_NONE;
}

/* The common id of eight texels in `rows` rows; LMB_TRANSFER_NONE if the ids differ. */
static uint32_t only_of(const uint8_t *const row[LMB_TRANSFER_CELLS], int32_t rows, ptrdiff_t at, int is_16)
{
    if (is_16) {
        const uint16_t id = *(const uint16_t *)(const void *)(row[0] + at);
        uint16_t other = 0;
        for (int32_t y = 0; y < rows; ++y) {
            const uint16_t *ids = (const uint16_t *)(const void *)(row[y] + at);
            for (int k = 0; k < LMB_TILE; ++k) {
                other |= (uint16_t)(ids[k] ^ id);
            }
        }
        return other == 0 ? id : LMB_TRANSFER_NONE;
    }
    const uint32_t id = *(const uint32_t *)(const void *)(row[0] + at);
    uint32_t other = 0;
    for (int32_t y = 0; y < rows; ++y) {
        const uint32_t *ids = (const uint32_t *)(const void *)(row[y] + at);
        for (int k = 0; k < LMB_TILE; ++k) {
            other |= ids[k] ^ id;
        }
    }
    return other == 0 ? id : LMB_TRANSFER_NONE;
}

/* Reads the blocks of eight texels that lie in the tile or beside it, all at once if they share one id. */
static void read_eight(const collection *c, int32_t first, int32_t y, const uint8_t *const row[LMB_TRANSFER_CELLS],
                       ptrdiff_t at)
{
    const int32_t each = c->cells * c->step, blocks = LMB_TILE / each;
    const uint32_t id = only_of(row, c->cells, at, c->ids.first.id_format == LMB_ID16);
    for (int32_t k = maxi(-1 - first, 0); k < mini(LMB_TILE + 1 - first, blocks); ++k) {
        if (id != LMB_TRANSFER_NONE) {
            *block_id(c, first + k, y) = id;
        } else {
            read_block(c, first + k, y, row, at, k * each);
        }
    }
}

/* Reads a row of the tile's blocks, or a row beside the tile. */
NOINLINE void read_map_row(const collection *c, int32_t y)
{
    const int32_t each = c->cells * c->step, blocks = LMB_TILE % each == 0 ? LMB_TILE / each : 1;
    const uint8_t *row[LMB_TRANSFER_CELLS];
    for (int32_t i = 0; i < c->cells; ++i) {
        row[i] = ids_at(c, 0, texel_of_cell(c, (c->first[1] + y) * c->cells + i));
    }
    for (int32_t x = -blocks; x <= LMB_TILE; x += blocks) {
        const int32_t eight = (c->first[0] + x) * each / LMB_TILE;
        if (LMB_TILE % each == 0 && c->first[0] + x >= 0 && eight < c->size / LMB_TILE) {
            read_eight(c, x, y, row, (ptrdiff_t)eight * c->ids.id_tile);
            continue;
        }
        for (int32_t k = maxi(x, -1); k < mini(x + blocks, LMB_TILE + 1); ++k) {
            read_block(c, k, y, NULL, 0, 0);
        }
    }
}

/* Do all blocks of a row show this one id? */
static int is_row_of(const collection *c, int32_t y, uint32_t id)
{
    const uint32_t *own = block_id(c, -1, y);
    uint32_t other = 0;
    for (int k = 0; k < LMB_TILE + 2; ++k) {
        other |= own[k] ^ id;
    }
    return other == 0 && id != LMB_TRANSFER_NONE;
}

/* --- shares of blocks --------------------------------------------------------------------------------------------- */

/* Gives each cell to the triangle that the cell's middle shows. */
static void share_by_ids(const collection *c, int32_t x, int32_t y)
{
    const float each = 1.0f / (float)(c->cells * c->cells);
    for (int32_t i = 0; i < c->cells; ++i) {
        for (int32_t k = 0; k < c->cells; ++k) {
            add_block_share(c, cell_id(c, x, y, k, i), LMB_TILE * y + x, each);
        }
    }
}

/* Triangles in a block and the blocks around it: a tip may reach into the block without covering a cell's middle. */
static void block_shows(lmb_transfer_several *out, const collection *c, int32_t x, int32_t y)
{
    out->count = 0;
    for (int32_t i = 0; i < 9 && out->count <= LMB_TRANSFER_SHARING; ++i) {
        const int32_t at_x = x + i % 3 - 1, at_y = y + i / 3 - 1;
        const uint32_t only = *block_id(c, at_x, at_y);
        if (only != LMB_TRANSFER_NONE) {
            add_id(out, only);
            continue;
        }
        const lmb_transfer_several *s = several_of(c, at_x, at_y);
        for (int32_t k = 0; k < mini(s->count, LMB_TRANSFER_SHARING); ++k) {
            add_id(out, s->id[k]);
        }
        out->count = maxi(out->count, s->count);
    }
}

/* Finds the triangles' outlines; most are in use from the previous block. Returns 0 if a triangle has none. */
static int find_outlines(const collection *c, const lmb_transfer_several *of)
{
    lmb_transfer_shown *outline = c->work->outline;
    for (int32_t i = 0; i < of->count; ++i) {
        if (outline[i].id == of->id[i]) {
            continue;
        }
        const lmb_transfer_shown *s = shown(c, of->id[i]);
        if (s == NULL) {
            outline[i].id = 0;
        } else if (s->has_outline) {
            outline[i] = *s;
        } else {
            return 0;
        }
    }
    return 1;
}

static void share_by_outlines(const collection *c, int32_t x, int32_t y, const lmb_transfer_several *of)
{
    const int32_t cells = c->cells;
    const float each = 1.0f / (float)(cells * cells);
    const float at[2] = {(float)((c->first[0] + x) * cells), (float)((c->first[1] + y) * cells)};
    float(*share)[LMB_TRANSFER_BLOCK_CELLS] = c->work->share, sum[LMB_TRANSFER_SHARING];
    c->kernels->transfer_share(share, c->work->outline, of->count, at, cells);
    for (int32_t i = 0; i < of->count; ++i) {
        sum[i] = 0.0f;
        for (int32_t k = 0; k < LMB_TRANSFER_CELLS * cells; k += LMB_TRANSFER_CELLS) {
            for (int32_t column = 0; column < cells; ++column) {
                sum[i] += share[i][k + column];
            }
        }
    }
    for (int32_t i = 0; i < of->count; ++i) {
        add_block_share(c, of->id[i], LMB_TILE * y + x, sum[i] * each);
    }
}

/* Do a block and the blocks around it show one triangle? */
static int is_of_one(const collection *c, int32_t x, int32_t y)
{
    const uint32_t id = *block_id(c, x, y);
    uint32_t other = 0;
    for (int32_t i = -1; i <= 1; ++i) {
        const uint32_t *row = block_id(c, x - 1, y + i);
        other |= (row[0] ^ id) | (row[1] ^ id) | (row[2] ^ id);
    }
    return other == 0 && id != LMB_TRANSFER_NONE;
}

static void share_block(const collection *c, int32_t x, int32_t y)
{
    lmb_transfer_several of;
    if (is_of_one(c, x, y)) {
        add_block_share(c, *block_id(c, x, y), LMB_TILE * y + x, 1.0f);
        return;
    }
    block_shows(&of, c, x, y);
    if (of.count > LMB_TRANSFER_SHARING || !find_outlines(c, &of)) {
        share_by_ids(c, x, y);
    } else {
        share_by_outlines(c, x, y, &of);
    }
}

static void share_texel_row(const collection *c, int32_t y)
{
    for (int32_t x = 0; x < LMB_TILE; ++x) {
        if (c->work->power[LMB_TILE * y + x] > 0.0f) {
            share_block(c, x, y);
        }
    }
}

/* --- tiles of blocks ---------------------------------------------------------------------------------------------- */

/* Reads the light through each block, in whole-number steps. Returns 0 if there is none. */
NOINLINE int read_powers(const collection *c)
{
    const int32_t columns = mini(c->blocks->size - c->first[0], LMB_TILE);
    float *power = c->work->power, sx[LMB_TILE + 16];
    int is_any = 0;
    for (int32_t x = 0; x < LMB_TILE + 16; ++x) {
        sx[x] = texel_sx(c->view, c->blocks->size, c->first[0] + mini(x, LMB_TILE - 1));
    }
    for (int32_t y = 0; y < LMB_TILE; ++y) {
        lmb_texel_row row;
        lmb_texel_row_of(&row, c->from, c->blocks, (int32_t)(c->face - c->blocks->face), c->first[1] + y);
        c->kernels->texel_powers(power + LMB_TILE * y, sx, LMB_TILE, &row);
    }
    for (int32_t y = 0; y < LMB_TILE; ++y) {
        for (int32_t x = c->first[1] + y < c->blocks->size ? columns : 0; x < LMB_TILE; ++x) {
            power[LMB_TILE * y + x] = 0.0f;
        }
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        power[k] = minf(power[k] * c->scale, MAX_BLOCK_LIGHT);
        is_any |= power[k] >= 1.0f;
    }
    return is_any;
}

/* Gives all blocks to one triangle. */
static void share_all(const collection *c, uint32_t id)
{
    lmb_transfer_sharer *to = sharer_of(c, id);
    for (int block = 0; block < LMB_TILE_PIXELS && to != NULL; ++block) {
        to->share[block] = 1.0f;
        to->rows = LMB_TRANSFER_ALL_ROWS;
    }
}

/* Shares a row of blocks when the row below is known. Rows with a single triangle wait until the end, because the
 * triangle may own the whole tile. */
static void collect_map_tile(const collection *c)
{
    int is_one = 1;
    if (!read_powers(c)) {
        return;
    }
    for (int32_t y = -1, next = 0; y <= LMB_TILE; ++y) {
        read_map_row(c, y);
        is_one = is_one && is_row_of(c, y, *block_id(c, -1, -1));
        for (; !is_one && next < y; ++next) {
            share_texel_row(c, next);
        }
    }
    if (is_one) {
        share_all(c, *block_id(c, -1, -1));
    }
    collect_sharers(c);
}

/* Cells of a block along each axis. */
static int32_t cells_of(int32_t each)
{
    int32_t cells = LMB_TRANSFER_CELLS;
    while (each % cells != 0) {
        --cells;
    }
    return cells;
}

lmb_status lmb_transfer_collect(const lmb_transfer_light *light, const lmb_kernels *kernels,
                                lmb_transfer_scratch *scratch, const lmb_transfer *t, const lmb_scene *scene,
                                const lmb_light *from, const lmb_shadow_map *map, int32_t face, int32_t each,
                                int32_t first, int32_t past)
{
    if (!transfer_is_laid_out(light, t) || kernels == NULL || scratch == NULL || scene == NULL || from == NULL ||
        map == NULL || each < 1 || (uint32_t)face >= (uint32_t)map->faces || map->size % each != 0 || first < 0 ||
        past < first || past > map->size / each) {
        return LMB_ERR_ARG;
    }
    lmb_shadow_map blocks = *map;
    blocks.size = map->size / each;
    const lmb_view *v = &map->view[face];
    const int32_t cells = cells_of(each);
    const float side_x = 2.0f * v->half_width / (float)blocks.size, side_y = 2.0f * v->half_height / (float)blocks.size;
    collection c = {light,
                    kernels,
                    t,
                    scene,
                    from,
                    &blocks,
                    &blocks.face[face],
                    v,
                    lmb_target_window(&map->face[face], v),
                    &scratch->collecting,
                    map->size,
                    cells,
                    each / cells,
                    MAX_BLOCK_LIGHT / (side_x * side_y),
                    {0, 0}};
    memset(c.work->shown, 0, sizeof c.work->shown);
    memset(c.work->outline, 0, sizeof c.work->outline);
    memset(light->part[0].light, 0, sizeof light->part[0].light); /* a kernel reads two rows if one has light */
    c.work->sharers = 0;
    for (int32_t y = first; y < past; ++y) {
        if (y % LMB_TILE != LMB_TILE - 1 && y != blocks.size - 1) {
            continue;
        }
        c.first[1] = y / LMB_TILE * LMB_TILE;
        for (c.first[0] = 0; c.first[0] < blocks.size; c.first[0] += LMB_TILE) {
            collect_map_tile(&c);
        }
    }
    memset(&scratch->met, 0, sizeof scratch->met);
    return LMB_OK;
}

#endif
