/* live_collect.c: a shadow map -> the first points of the live tree: one for each block of texels. Layer 5.     [ours]
 *
 * A hash selects one texel of each block as the block's point. So points do not line up along the map, and surfaces
 * that share a block are selected in proportion to their visible area. The point gets all the light through the block.
 * It lies at the texel's middle, where the map was sampled, so never behind an edge. Four blocks amid blocks of the
 * same triangle give one point. */
#include "live_part.h"

#include <string.h>

#include "../base/memory_check.h"

#if LMB_LIVE

enum {
    BLOCK = 4,
    LARGE_BLOCK = 8,
    WIDE = 2,   /* blocks a side that are joined, */
    NEXT = 4,   /* if so many a side are alike: light is finest at edges */
    FACETS = 8, /* that are kept */
    LINE = 64   /* bytes */
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
static uint64_t chunks_of(uint64_t blocks) { return blocks / LMB_LIVE_NODES * 5 / 4 + 16; }

static uint64_t bytes_of(uint32_t faces, int32_t side, uint32_t elements)
{
    const uint64_t points = blocks_of(faces, side) + elements, chunks = chunks_of(points) * sizeof(lmb_live_chunk);
    return chunks + points * (2 * sizeof(lmb_live_point)) + faces * (uint64_t)sizeof(lmb_live_face) + LINE;
}

/* Bytes from a pointer to the next cache line, where vectors do not straddle two. */
static size_t to_line(const void *p) { return (LINE - (uintptr_t)p % LINE) % LINE; }

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
    const size_t needed = lmb_live_bytes(faces, side, elements);
    if (out == NULL || memory == NULL || needed == 0) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)memory % sizeof(uint64_t) != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < needed) {
        return LMB_ERR_CAPACITY;
    }
    const size_t points = (size_t)blocks_of(faces, side) + elements;
    memset(out, 0, sizeof *out);
    out->face = (lmb_live_face *)memory;
    out->chunk = (lmb_live_chunk *)(void *)((uint8_t *)(out->face + faces) + to_line(out->face + faces));
    out->chunk_cap = (uint32_t)chunks_of(points);
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

/* The texel that represents a block: the same whatever other lights and faces were skipped. */
static void texel_of(int32_t *x, int32_t *y, const collector *c, int32_t column, int32_t row)
{
    const int32_t each = c->face->each;
    const uint32_t h = live_hash((uint32_t)column, (uint32_t)row, 8 * c->face->light + (uint32_t)c->map_face);
    *x = mini(column * each + (int32_t)(h >> 8 & (uint32_t)(each - 1)), c->face->size - 1);
    *y = mini(row * each + (int32_t)(h >> 16 & (uint32_t)(each - 1)), c->face->size - 1);
}

/* Area of a block projected to the plane through `at`. A cross-section of the block's frustum is z^2 times the block at
 * distance 1, perpendicular to the view's axis. */
static float area_of(const collector *c, lmb_vec3 at, lmb_vec3 normal)
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

/* Flux of joined blocks. */
static void sum_flux(float sum[3], const collector *c, const blocks *b, const float *power, lmb_vec3 at)
{
    for (int i = 0; i < b->wide * b->wide; ++i) {
        const int k = b->first + i / b->wide * LMB_TILE + i % b->wide;
        float each[3];
        for (int h = 0; h < 3; ++h) {
            each[h] = texel_flux(c->light->intensity[h], power[k]);
        }
        light_end_power(each, c->light, at);
        for (int h = 0; h < 3; ++h) {
            sum[h] += each[h] * c->tile->albedo[h][k];
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
    const int32_t x = c->x[k], y = c->y[k];
    lmb_vec3 at;
    memset(out, 0, sizeof *out);
    if (!(power[k] > 0.0f)) {
        return;
    }
    if (p == NULL || !lmb_live_place(&at, p, v, texel_sx(v, c->face->size, x), texel_sy(v, c->face->size, y))) {
        return;
    }
    sum_flux(out->flux, c, b, power, at);
    out->position = at;
    out->normal = p->normal;
    out->area = area_of(c, at, p->normal) * (float)(b->wide * b->wide);
    out->id = c->tile->id[k];
    out->column = (uint16_t)column;
    out->row = (uint16_t)row;
    out->face = (uint16_t)c->into;
    out->light = (uint8_t)c->face->light;
    out->wide = (uint8_t)b->wide;
}

/* Resolves the albedo of 8 x 8 blocks: their ids form a window of a map with one texel per block. */
static lmb_status resolve_blocks(collector *c, int32_t column, int32_t row)
{
    uint32_t id[LMB_TILE_PIXELS];
    const int32_t side = c->side;
    lmb_view view = c->face->view;
    lmb_target window;
    memset(&window, 0, sizeof window);
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t at = column + k % LMB_TILE, down = row + k / LMB_TILE;
        int32_t x, y;
        id[k] = 0;
        if (at < side && down < side) {
            texel_of(&x, &y, c, at, down);
            c->x[k] = (uint16_t)x;
            c->y[k] = (uint16_t)y;
            id[k] = live_id(&c->face->id, x, y);
        }
    }
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

/* Do the NEXT x NEXT blocks from pixel k on show one triangle, and are all lit? Blocks outside the map show none. */
static int are_alike(const collector *c, const float *power, int k)
{
    const uint32_t id = c->tile->id[k];
    int alike = id != 0;
    for (int i = 0; i < NEXT * NEXT && alike; ++i) {
        const int at = k + i / NEXT * LMB_TILE + i % NEXT;
        alike = c->tile->id[at] == id && power[at] > 0.0f;
    }
    return alike;
}

/* Stores the points of WIDE x WIDE blocks from (column, row) on: one, or one for each block. */
static void set_points(collector *c, int32_t column, int32_t row, int k, const float *power, int joined)
{
    const int32_t side = c->side;
    if (column >= side || row >= side) {
        return;
    }
    lmb_live_point *out = c->live->point + (size_t)c->into * (size_t)c->live->side * (size_t)c->live->side +
                          (size_t)row * (size_t)side + (size_t)column;
    const int pick = (int)(live_hash((uint32_t)row, (uint32_t)column, c->into) >> 9 & (WIDE * WIDE - 1));
    for (int i = 0; i < WIDE * WIDE; ++i) {
        const int32_t x = i % WIDE, y = i / WIDE, from = joined ? pick : i;
        lmb_live_point *to = out + (size_t)y * (size_t)side + (size_t)x;
        const blocks b = {k + y * LMB_TILE + x, joined ? WIDE : 1, k + from / WIDE * LMB_TILE + from % WIDE};
        if (column + x < side && row + y < side && !(joined && i > 0)) {
            set_point(to, c, column + x, row + y, &b, power);
        } else if (joined) {
            memset(to, 0, sizeof *to);
        }
    }
}

static lmb_status collect_tile(collector *c, int32_t column, int32_t row)
{
    const lmb_status status = resolve_blocks(c, column, row);
    float power[LMB_TILE_PIXELS + LMB_TILE]; /* set_powers writes 16 */
    for (int32_t y = 0; y < LMB_TILE && row + y < c->side && status == LMB_OK; ++y) {
        set_powers(power + y * LMB_TILE, c, column, row + y);
    }
    for (int n = 0; n < LMB_TILE_PIXELS / (NEXT * NEXT) && status == LMB_OK; ++n) {
        const int k = n / (LMB_TILE / NEXT) * NEXT * LMB_TILE + n % (LMB_TILE / NEXT) * NEXT;
        const int joined = are_alike(c, power, k);
        for (int i = 0; i < NEXT * NEXT / (WIDE * WIDE); ++i) {
            const int at = k + i / (NEXT / WIDE) * WIDE * LMB_TILE + i % (NEXT / WIDE) * WIDE;
            set_points(c, column + at % LMB_TILE, row + at / LMB_TILE, at, power, joined);
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
        for (int32_t column = 0; row % own.each == 0 && column < c.side && status == LMB_OK;
             column += LMB_TILE) {
            status = collect_tile(&c, column, row / own.each * LMB_TILE);
        }
    }
    return status;
}

#endif
