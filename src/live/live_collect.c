/* live_collect.c: a shadow map -> the first points of the live tree: one for each block of texels. Layer 5.     [ours]
 *
 * A hash selects one texel of each block as the block's point. So points do not line up along the map, and surfaces
 * that share a block are selected in proportion to their visible area. The point gets all the light through the block.
 * It lies at the texel's middle, where the map was sampled, so never behind an edge. Four blocks amid blocks of the
 * same triangle give one point. Blocks that are not flat give one for each surface, with the light of the texels that
 * show it: if the hash selected a surface behind another one, receivers near the one in front would get no light from
 * it. */
#include "live_part.h"

#include <string.h>

#include "../base/memory_check.h"

#if LMB_LIVE

enum {
    BLOCK = 4,
    LARGE_BLOCK = 8,
    OTHERS = 3,     /* further points of a block that is not flat */
    REST_SLOTS = 7, /* the last slots of a tile's further points: they hold collector.rest, and never a point */
    WIDE = 2,       /* blocks a side that are joined, */
    NEXT = 4,       /* if so many a side are alike: light is finest at edges */
    FACETS = 8      /* that are kept */
};
#define MANY_BLOCKS (1u << 18)
#define MANY_ELEMENTS (1u << 24)

/* --- memory ------------------------------------------------------------------------------------------------------- */

static int32_t side_by(int32_t size, int32_t each) { return (size + each - 1) / each; }

static uint64_t blocks_of(uint32_t faces, int32_t side) { return (uint64_t)faces * (uint64_t)side * (uint64_t)side; }

int32_t lmb_live_side(uint32_t faces, int32_t size)
{
    if (size < LMB_TILE || size > LMB_MAX_SIDE || size % LMB_TILE != 0) {
        return 0;
    }
    return side_by(size, blocks_of(faces, size / BLOCK) > MANY_BLOCKS ? LARGE_BLOCK : BLOCK);
}

/* One node for each first point, a quarter more for inner nodes, and padding to start each level on a chunk. */
static uint64_t chunks_of(uint64_t blocks)
{
    return LMB_LIVE_SMALL ? blocks / LMB_LIVE_NODES + 4 : blocks / LMB_LIVE_NODES * 5 / 4 + 16;
}

static uint64_t bytes_of(uint32_t faces, int32_t side, uint32_t elements)
{
    const uint64_t points = live_slots(faces, side) + (uint64_t)elements,
                   chunks = chunks_of(blocks_of(faces, side) + elements) * sizeof(lmb_live_chunk);
    return chunks + points * (2 * sizeof(lmb_live_point)) + faces * (uint64_t)sizeof(lmb_live_face) + CACHE_LINE;
}

/* Bytes from a pointer to the next cache line, where vectors do not straddle two. */
static size_t to_line(const void *p) { return (CACHE_LINE - (uintptr_t)p % CACHE_LINE) % CACHE_LINE; }

size_t lmb_live_bytes(uint32_t faces, int32_t side, uint32_t elements)
{
    if (faces == 0 || faces > 6 * LMB_MAX_LIGHTS || side < 1 || side > LMB_MAX_SIDE / BLOCK ||
        blocks_of(faces, side) > (1u << 28) || elements > MANY_ELEMENTS) {
        return 0;
    }
    return size_or_none(bytes_of(faces, side, elements));
}

lmb_status lmb_live_init(lmb_live *out, uint32_t faces, int32_t side, uint32_t elements, void *memory, size_t bytes)
{
    const lmb_status status = check_room(out, memory, bytes, lmb_live_bytes(faces, side, elements));
    if (status != LMB_OK) {
        return status;
    }
    const size_t points = live_slots(faces, side) + elements;
    memset(out, 0, sizeof *out);
    out->face = (lmb_live_face *)memory;
    out->chunk = (lmb_live_chunk *)(void *)((uint8_t *)(out->face + faces) + to_line(out->face + faces));
    out->chunk_cap = (uint32_t)chunks_of(blocks_of(faces, side) + elements);
    out->point = (lmb_live_point *)(void *)(out->chunk + out->chunk_cap);
    out->sorted = out->point + points;
    out->element_cap = elements;
    out->face_cap = faces;
    out->side = side;
    out->strata = LMB_LIVE_STRATA;
    out->split = 16.0f;
    return LMB_OK;
}

/* --- faces -------------------------------------------------------------------------------------------------------- */

static lmb_status set_face(lmb_live_face *out, const lmb_live *live, const lmb_shadow_map *map, int32_t face,
                           uint32_t light)
{
    const int32_t each = side_by(map->size, BLOCK) <= live->side ? BLOCK : LARGE_BLOCK;
    memset(out, 0, sizeof *out);
    out->view = map->view[face];
    out->id = map->face[face].id;
    out->size = map->size;
    out->each = each;
    out->light = light;
    return side_by(map->size, each) > live->side ? LMB_ERR_CAPACITY : LMB_OK;
}

typedef char rest_fits[OTHERS * LMB_TILE_PIXELS * 2 <= REST_SLOTS * sizeof(lmb_live_point) ? 1 : -1];

/* --- a tile of blocks --------------------------------------------------------------------------------------------- */

/* State of one face, while the tiles are collected. */
typedef struct collector {
    const lmb_live *live;
    const lmb_kernels *kernels;
    lmb_tile *tile;
    const lmb_scene *scene;
    const lmb_light *light;
    const lmb_shadow_map *map;
    const lmb_live_face *face;
    int32_t map_face, side; /* side: blocks */
    uint32_t into;
    uint16_t x[LMB_TILE_PIXELS], y[LMB_TILE_PIXELS]; /* the texels of the current tile's blocks */
    uint16_t shows[LMB_TILE_PIXELS];                 /* the parts of each block that the point represents */
    uint16_t (*rest)[LMB_TILE_PIXELS];               /* OTHERS: parts of surfaces that get points of their own */
    int is_one;                                      /* all texels of the tile's blocks show one id; x, y are not set */
    int32_t lit[LMB_TILE];                           /* points of each row of the current tiles' blocks so far */
    lmb_live_facet known[FACETS];
} collector;

/* Light through eight blocks of a row, at 1 W/sr. A block's middle decides whether a sun's finer face contains it. */
static void set_powers(float out[16], const collector *c, int32_t column, int32_t row)
{
#if LMB_TRANSFER
    const lmb_view *v = &c->face->view;
    lmb_texel_row texels;
    float sx[16];
    for (int32_t i = 0; i < 16; ++i) {
        sx[i] = texel_sx(v, c->side, column + i % LMB_TILE);
    }
    lmb_texel_row_of(&texels, c->light, c->map, c->map_face, row * c->face->each + c->face->each / 2);
    texels.side_x = 2.0f * v->half_width / (float)c->side;
    texels.side_y = 2.0f * v->half_height / (float)c->side;
    texels.sy = texel_sy(v, c->side, row);
    c->kernels->texel_powers(out, sx, LMB_TILE, &texels);
#else
    lmb_shadow_map blocks = *c->map;
    lmb_light even = *c->light;
    blocks.size = c->side;
    for (int h = 0; h < 3; ++h) {
        even.intensity[h] = 1.0f;
    }
    for (int32_t i = 0; i < LMB_TILE; ++i) {
        float power[3];
        lmb_light_texel_power(power, &even, &blocks, c->map_face, column + i, row);
        out[i] = power[0];
    }
#endif
}

/* A number of the face that is the same whatever other lights and faces were skipped. */
static uint32_t number_of(const collector *c) { return 8 * c->face->light + (uint32_t)c->map_face; }

/* The texel that represents a block. */
static void texel_of(int32_t *x, int32_t *y, const collector *c, int32_t column, int32_t row)
{
    const int32_t each = c->face->each;
    const uint32_t h = live_hash((uint32_t)column, (uint32_t)row, number_of(c));
    *x = mini(column * each + (int32_t)(h >> 8 & (uint32_t)(each - 1)), c->face->size - 1);
    *y = mini(row * each + (int32_t)(h >> 16 & (uint32_t)(each - 1)), c->face->size - 1);
}

/* Area of a block projected to the plane through `at`. A cross-section of the block's frustum is z^2 times the block at
 * distance 1, perpendicular to the view's axis. */
static float texel_area_at(const collector *c, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_view *v = &c->face->view;
    const float block = 4.0f * v->half_width * v->half_height / (float)(c->side * c->side);
    const lmb_vec3 ray = v->kind == LMB_PERSPECTIVE ? sub3(at, v->eye) : v->back;
    const float z = absf(dot3(v->back, ray)), slope = absf(dot3(normal, ray));
    return block * z * z * z / maxf(slope, GRAZE * sqrtf(dot3(ray, ray)));
}

/* Blocks of the current tile that give one point. */
typedef struct blocks {
    int first, wide; /* the pixel of the first one, and how many there are a side */
    int from;        /* the pixel of the one with the point */
} blocks;

/* The share of a block that shows the surface of pixel k. */
static float shown_share(const collector *c, int k)
{
    return c->is_one ? 1.0f : (float)count_bits_16(c->shows[k]) * (1.0f / LMB_LIVE_NODES);
}

/* Flux of joined blocks. */
static void sum_flux(float sum[3], const collector *c, const blocks *b, const float *power, lmb_vec3 at)
{
    const float left = light_within_at(c->light, at); /* as in light_end_power */
    for (int i = 0; i < b->wide * b->wide; ++i) {
        const int k = b->first + i / b->wide * LMB_TILE + i % b->wide;
        const float own = power[k] * shown_share(c, k);
        for (int h = 0; h < 3; ++h) {
            const float each = texel_flux(c->light->intensity[h], own);
            sum[h] += (left < 1.0f ? texel_flux(each, left) : each) * c->tile->albedo[h][k];
        }
    }
    for (int h = 0; h < 3; ++h) {
        sum[h] = sum[h] < FLUX_FLOOR ? 0.0f : sum[h];
    }
}

static void set_point(lmb_live_point *out, collector *c, int32_t column, int32_t row, const blocks *b,
                      const float *power)
{
    const int k = b->from;
    const lmb_view *v = &c->face->view;
    const uint32_t id = c->tile->id[k];
    const lmb_live_facet *p = id != 0 ? lmb_live_facet_of(c->known, FACETS, c->scene, v, c->into, id) : NULL;
    const int in = k - b->first;
    int32_t x = c->x[k], y = c->y[k];
    lmb_vec3 at;
    memset(out, 0, sizeof *out);
    if (!(power[k] > 0.0f)) {
        return;
    }
    if (c->is_one) {
        texel_of(&x, &y, c, column + in % LMB_TILE, row + in / LMB_TILE);
    }
    if (p == NULL || !lmb_live_place(&at, p, v, texel_sx(v, c->face->size, x), texel_sy(v, c->face->size, y))) {
        return;
    }
    sum_flux(out->flux, c, b, power, at);
    out->position = at;
    out->normal = p->normal;
    out->area = texel_area_at(c, at, p->normal) * (float)(b->wide * b->wide) * shown_share(c, k);
    out->id = c->tile->id[k];
    out->column = (uint16_t)column;
    out->row = (uint16_t)row;
    out->face = (uint16_t)c->into;
    out->light = (uint8_t)c->face->light;
    out->wide = (uint8_t)b->wide;
    out->shows = c->shows[k];
}

/* --- blocks of several surfaces ----------------------------------------------------------------------------------- */

/* Moves pixel k to one of these parts of its block, by a hash. */
static void move_to_part(collector *c, int32_t column, int32_t row, int k, uint32_t parts)
{
    const int32_t each = c->face->each;
    uint32_t left = live_hash((uint32_t)row, (uint32_t)column, number_of(c) + parts) % count_bits_16(parts);
    for (; left > 0; --left) {
        parts &= parts - 1;
    }
    const int i = lowest_bit(parts);
    c->x[k] = (uint16_t)(column * each + (2 * (i % 4) + 1) * each / 8);
    c->y[k] = (uint16_t)(row * each + (2 * (i / 4) + 1) * each / 8);
}

/* Divides a block that is not flat by surface. The surface of the pixel's texel has the first point; if that texel
 * shows nothing, another one is taken. *others: further points of the tile, updated. The last point of a block gets all
 * surfaces that are left. Returns the id of the texel. */
static uint32_t divide_block(collector *c, int *others, int32_t column, int32_t row, int k)
{
    const lmb_surface *depth = &c->map->face[c->map_face].depth;
    lmb_live_block b;
    lmb_live_block_of(&b, c->face, column, row);
    c->shows[k] = 0xffffu;
    if (b.is_one && (c->face->each == BLOCK || live_id(&c->face->id, c->x[k], c->y[k]) == b.id[0])) {
        return b.id[0];
    }
    uint32_t id = live_id(&c->face->id, c->x[k], c->y[k]);
    if (id == 0) {
        move_to_part(c, column, row, k, b.shown);
        id = live_id(&c->face->id, c->x[k], c->y[k]);
    }
    const lmb_live_facet *p = lmb_live_facet_of(c->known, FACETS, c->scene, &c->face->view, c->into, id);
    const uint32_t own = p != NULL ? lmb_live_block_on(&b, c->face, depth, p) : 0;
    if (p == NULL || own == 0xffffu) {
        return id;
    }
    uint32_t part[OTHERS], left = own != 0 ? b.shown & ~own : 0;
    int count = 0;
    for (; left != 0; ++count) {
        const int i = lowest_bit(left);
        p = count < OTHERS - 1
                ? lmb_live_facet_of(c->known, FACETS, c->scene, &c->face->view, c->into, b.id[i]) : NULL;
        part[count] = p != NULL ? (lmb_live_block_on(&b, c->face, depth, p) & left) | 1u << i : left;
        left &= ~part[count];
    }
    c->shows[k] = (uint16_t)b.shown;
    if (own != 0 && *others + count <= LIVE_SURFACES - REST_SLOTS) {
        *others += count;
        c->shows[k] = (uint16_t)own;
        for (int q = 0; q < count; ++q) {
            c->rest[q][k] = (uint16_t)part[q];
        }
    }
    return id;
}

/* Resolves the albedo of 8 x 8 blocks: their ids form a window of a map with one texel per block. */
static lmb_status resolve_ids(collector *c, uint32_t id[LMB_TILE_PIXELS], int32_t column, int32_t row)
{
    const int32_t side = c->side;
    lmb_view view = c->face->view;
    lmb_target window;
    memset(&window, 0, sizeof window);
    view.frame_width = view.frame_height = (side + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    window.depth.data = window.id.data = id; /* depths are not read */
    window.depth.width = window.depth.height = window.id.width = window.id.height = LMB_TILE;
    window.depth.stride_bytes = window.id.stride_bytes = LMB_TILE * 4;
    window.depth.format = LMB_DEPTH32F;
    window.id.format = LMB_ID32;
    window.x0 = column;
    window.y0 = row;
    return lmb_resolve_albedo(c->tile, c->kernels, &view, c->scene, &window, column, row);
}

/* Resolves one texel of each block. *others: the number of other surfaces that get points. */
static lmb_status resolve_blocks(int *others, collector *c, int32_t column, int32_t row, const float *power)
{
    uint32_t id[LMB_TILE_PIXELS], one;
    *others = 0;
    memset(c->rest, 0, OTHERS * sizeof *c->rest);
    c->is_one = lmb_live_square_is_one(&one, c->face, column, row);
    for (int32_t k = 0; k < LMB_TILE_PIXELS && c->is_one; ++k) {
        id[k] = power[k] > 0.0f ? one : 0;
        c->shows[k] = power[k] > 0.0f ? 0xffffu : 0;
    }
    for (int32_t k = 0; k < LMB_TILE_PIXELS && !c->is_one; ++k) {
        const int32_t at = column + k % LMB_TILE, down = row + k / LMB_TILE;
        int32_t x, y;
        id[k] = 0;
        c->shows[k] = 0;
        if (at < c->side && down < c->side && power[k] > 0.0f) {
            texel_of(&x, &y, c, at, down);
            c->x[k] = (uint16_t)x;
            c->y[k] = (uint16_t)y;
            id[k] = divide_block(c, others, at, down, k);
        }
    }
    return resolve_ids(c, id, column, row);
}

/* Do the NEXT x NEXT blocks from pixel k on show one triangle, are flat, and are all lit? Blocks outside the map show
 * none. */
static int are_alike(const collector *c, const float *power, int k)
{
    const uint32_t id = c->tile->id[k];
    int alike = id != 0;
    for (int i = 0; i < NEXT * NEXT && alike; ++i) {
        const int at = k + i / NEXT * LMB_TILE + i % NEXT;
        alike = c->tile->id[at] == id && power[at] > 0.0f && c->shows[at] == 0xffffu;
    }
    return alike;
}

/* Slots of the points of a row of blocks. The lit ones come first, then a dark one. */
static lmb_live_point *row_of(const collector *c, int32_t row)
{
    return c->live->point + (size_t)c->into * (size_t)c->live->side * (size_t)c->live->side +
           (size_t)row * (size_t)c->side;
}

/* Stores the points of WIDE x WIDE blocks from (column, row) on: one, or one for each block. */
static void set_points(collector *c, int32_t column, int32_t row, int k, const float *power, int joined)
{
    const int32_t side = c->side;
    if (column >= side || row >= side) {
        return;
    }
    const int pick = (int)(live_hash((uint32_t)row, (uint32_t)column, number_of(c)) >> 9 & (WIDE * WIDE - 1));
    for (int i = 0; i < WIDE * WIDE; ++i) {
        const int32_t x = i % WIDE, y = i / WIDE, from = joined ? pick : i;
        const blocks b = {k + y * LMB_TILE + x, joined ? WIDE : 1, k + from / WIDE * LMB_TILE + from % WIDE};
        if (column + x < side && row + y < side && !(joined && i > 0)) {
            int32_t *lit = &c->lit[(row + y) % LMB_TILE];
            lmb_live_point *to = row_of(c, row + y) + *lit;
            set_point(to, c, column + x, row + y, &b, power);
            *lit += live_power(to->flux) > 0.0f;
        }
    }
}

/* Stores the points of one other surface of each block; *count: points stored before and after. */
static lmb_status set_other(int *count, lmb_live_point *out, collector *c, int32_t column, int32_t row, int q,
                              const float *power)
{
    uint32_t id[LMB_TILE_PIXELS];
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        c->shows[k] = c->rest[q][k];
        id[k] = 0;
        if (c->shows[k] != 0) {
            move_to_part(c, column + k % LMB_TILE, row + k / LMB_TILE, k, c->shows[k]);
            id[k] = live_id(&c->face->id, c->x[k], c->y[k]);
        }
    }
    const lmb_status status = resolve_ids(c, id, column, row);
    for (int32_t k = 0; k < LMB_TILE_PIXELS && status == LMB_OK; ++k) {
        const blocks b = {k, 1, k};
        if (c->shows[k] != 0) {
            set_point(&out[*count], c, column + k % LMB_TILE, row + k / LMB_TILE, &b, power);
            *count += live_power(out[*count].flux) > 0.0f;
        }
    }
    return status;
}

/* Slots of the points of a tile's other surfaces. */
static lmb_live_point *others_of(const collector *c, int32_t column, int32_t row)
{
    const lmb_live *live = c->live;
    const size_t tiles = (size_t)((c->side + LMB_TILE - 1) / LMB_TILE),
                 tile = (size_t)(row / LMB_TILE) * tiles + (size_t)(column / LMB_TILE);
    return live->point + (size_t)live->face_cap * (size_t)live->side * (size_t)live->side +
           LIVE_SURFACES * ((size_t)c->into * live_tiles(live->side) + tile);
}

/* Stores the points of all other surfaces of a tile's blocks. */
static lmb_status set_others(collector *c, int others, int32_t column, int32_t row, const float *power)
{
    lmb_live_point *to = others_of(c, column, row);
    lmb_status status = LMB_OK;
    int count = 0;
    for (int q = 0; q < OTHERS && others > 0 && status == LMB_OK; ++q) {
        status = set_other(&count, to, c, column, row, q, power);
    }
    memset(&to[count], 0, sizeof *to);
    return status;
}

static lmb_status collect_tile(collector *c, int32_t column, int32_t row)
{
    float power[LMB_TILE_PIXELS + LMB_TILE]; /* set_powers writes 16 */
    int others;
    memset(power, 0, sizeof power);
    for (int32_t y = 0; y < LMB_TILE && row + y < c->side; ++y) {
        set_powers(power + y * LMB_TILE, c, column, row + y);
    }
    c->rest = (uint16_t (*)[LMB_TILE_PIXELS])(void *)(others_of(c, column, row) + LIVE_SURFACES - REST_SLOTS);
    const lmb_status status = resolve_blocks(&others, c, column, row, power);
    for (int n = 0; n < LMB_TILE_PIXELS / (NEXT * NEXT) && status == LMB_OK; ++n) {
        const int k = n / (LMB_TILE / NEXT) * NEXT * LMB_TILE + n % (LMB_TILE / NEXT) * NEXT;
        const int joined = are_alike(c, power, k);
        for (int i = 0; i < NEXT * NEXT / (WIDE * WIDE); ++i) {
            const int at = k + i / (NEXT / WIDE) * WIDE * LMB_TILE + i % (NEXT / WIDE) * WIDE;
            set_points(c, column + at % LMB_TILE, row + at / LMB_TILE, at, power, joined);
        }
    }
    return status == LMB_OK ? set_others(c, others, column, row, power) : status;
}

/* Collects the tiles of a row. */
static lmb_status collect_row(collector *c, int32_t row)
{
    lmb_status status = LMB_OK;
    memset(c->lit, 0, sizeof c->lit);
    for (int32_t column = 0; column < c->side && status == LMB_OK; column += LMB_TILE) {
        status = collect_tile(c, column, row);
    }
    for (int32_t y = 0; y < LMB_TILE && row + y < c->side; ++y) {
        if (c->lit[y] < c->side) {
            memset(row_of(c, row + y) + c->lit[y], 0, sizeof(lmb_live_point));
        }
    }
    return status;
}

/* Tile row `row` of a map contains the blocks of tile row row / each if it is the first of these rows. */
lmb_status lmb_live_collect(const lmb_live *live, const lmb_kernels *kernels, lmb_tile *scratch,
                            const lmb_scene *scene, uint32_t light, const lmb_shadow_map *map, int32_t face,
                            uint32_t into, int32_t first, int32_t past)
{
    lmb_live_face own;
    collector c;
    if (live == NULL || live->face == NULL || kernels == NULL || scratch == NULL || scene == NULL || map == NULL ||
        light >= scene->light_count || light >= LMB_MAX_LIGHTS || face < 0 || face >= map->faces || first < 0 ||
        past < first || past > map->size / LMB_TILE) {
        return LMB_ERR_ARG;
    }
    lmb_status status = into < live->face_cap ? set_face(&own, live, map, face, light) : LMB_ERR_CAPACITY;
    if (status != LMB_OK) {
        return status;
    }
    if (first == 0 && past > 0) { /* one part only */
        live->face[into] = own;
    }
    memset(&c, 0, sizeof c);
    c.live = live;
    c.kernels = kernels;
    c.tile = scratch;
    c.scene = scene;
    c.light = &scene->lights[light];
    c.map = map;
    c.face = &own;
    c.map_face = face;
    c.into = into;
    c.side = live_blocks(&own);
    for (int32_t row = first; row < past && status == LMB_OK; ++row) {
        if (row % own.each == 0) {
            status = collect_row(&c, row / own.each * LMB_TILE);
        }
    }
    return status;
}

#endif
