/* points.c: a shadow map -> first points: lit surface elements with their flux. Layer 5.      [V1 V2 V4 V5 V6 V7]
 *
 * A block of b x b texels gives one element per surface. Texels with the same normal and plane are summed, so a fine
 * map costs more points only at the borders of surfaces. Each element becomes a quad of equal area. The sides of the
 * quad follow the texels' footprint on the surface and their spread in the block (second moments), so a strip stays a
 * strip. */
#include <lambent/bounce.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "../direct/footprint.h"
#include "../direct/texel.h"
#include "../raster/tile.h"
#include "points.h"

#if LMB_BOUNCE

#define MAX_BLOCK_SURFACES 4 /* surfaces per block; more join the most similar */

size_t lmb_points_bytes(uint32_t n, uint32_t side)
{
    const size_t cells = ((size_t)side * side + 1) * sizeof(uint32_t);
    if (side > LMB_MAX_SIDE || n > ((size_t)-1 - cells) / sizeof(lmb_point)) {
        return 0; /* more than this target can address */
    }
    return (size_t)n * sizeof(lmb_point) + cells;
}

lmb_status lmb_points_init(lmb_points *out, uint32_t n, uint32_t side, void *memory, size_t bytes)
{
    if (out == NULL || n == 0 || side == 0 || side > LMB_MAX_SIDE) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_points_bytes(n, side));
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->data = (lmb_point *)memory;
    out->cap = n;
    out->cells = (uint32_t *)(void *)(out->data + n);
    out->cell_cap = side * side + 1;
    return LMB_OK;
}

/* Sums over the texels of one surface in a block. */
typedef struct element {
    lmb_vec3 position, normal; /* weighted by power */
    lmb_vec3 first, face;      /* of the first texel, for comparison */
    float power[3], flux[3], weight;
    float x, y, xx, yy; /* texels from the centre of the block */
    int32_t count;
} element;

static float plane_gap(const element *e, lmb_vec3 p) { return absf(dot3(e->face, sub3(p, e->first))); }

/* The element of a texel: the same surface, a new element, or, if all are in use, the most similar one. */
static element *find_element(element *e, int32_t *count, lmb_vec3 p, lmb_vec3 n, float texel_m)
{
    int32_t best = 0;
    float best_cosine = -2.0f;
    for (int32_t i = 0; i < *count; ++i) {
        float cosine = dot3(e[i].face, n);
        if (cosine >= TILE_COS_25 && plane_gap(&e[i], p) <= texel_m) {
            return &e[i];
        }
        if (cosine > best_cosine) {
            best_cosine = cosine;
            best = i;
        }
    }
    if (*count == MAX_BLOCK_SURFACES) {
        return &e[best];
    }
    memset(&e[*count], 0, sizeof *e);
    e[*count].first = p;
    e[*count].face = n;
    return &e[(*count)++];
}

static void add_lit_texel(element *e, const lmb_tile *t, int k, const float power[3], float x, float y)
{
    float weight = power[0] + power[1] + power[2];
    e->position =
        add3(e->position, mul3(sub3(tile_vec(t->position, k), e->first), weight));
    e->normal = add3(e->normal, mul3(tile_vec(t->face, k), weight));
    for (int c = 0; c < 3; ++c) {
        e->power[c] += power[c];
        e->flux[c] += power[c] * t->albedo[c][k];
    }
    e->weight += weight;
    e->x += x;
    e->y += y;
    e->xx += x * x;
    e->yy += y * y;
    ++e->count;
}

/* Side of the quad in texels, from the spread of the texels along one axis. Exact for a full block. */
static float spread_of_means(float sum, float sum2, float count)
{
    float mean = sum / count, variance = maxf(sum2 / count - mean * mean, 0.0f) + 1.0f / 12.0f;
    return sqrtf(12.0f * variance);
}

static void make_point(lmb_point *out, const element *e, const lmb_shadow_map *map, const lmb_view *v)
{
    float n = (float)e->count, per_weight = 1.0f / e->weight;
    float side_x = spread_of_means(e->x, e->xx, n), side_y = spread_of_means(e->y, e->yy, n);
    float fit = 0.5f * sqrtf(n / (side_x * side_y)); /* half sides of a quad with the texels' area */
    memset(out, 0, sizeof *out);
    out->position = add3(e->first, mul3(e->position, per_weight));
    out->normal = normalize3(mul3(e->normal, per_weight));
    for (int c = 0; c < 3; ++c) {
        out->flux[c] = e->flux[c];
        out->albedo[c] = e->power[c] > 0.0f ? e->flux[c] / e->power[c] : 0.0f;
    }
    footprint_sides(&out->axis_u, &out->axis_v, v, map->size, out->position, out->normal);
    out->axis_u = mul3(out->axis_u, fit * side_x);
    out->axis_v = mul3(out->axis_v, fit * side_y);
}

static int32_t block_of(const lmb_grouping *grouping)
{
    return grouping != NULL && grouping->block != 0 ? grouping->block : LMB_TILE;
}

static int is_block(int32_t n) { return n == 1 || n == 2 || n == 4 || n == 8; }

typedef struct point_collector {
    lmb_points *points;
    const lmb_scene *scene;
    const lmb_light *light;
    const lmb_shadow_map *map;
    int32_t face, block;
} point_collector;

/* The texel's owner, or a dummy. */
static uint32_t *owner_of(const point_collector *c, uint32_t *nowhere, int32_t x, int32_t y)
{
    const uint32_t size = (uint32_t)c->map->size;
    lmb_points *p = c->points;
    return p->owner != NULL ? &p->owner[p->owner_count - size * size + (uint32_t)y * size + (uint32_t)x] : nowhere;
}

/* Collects the block with (bx, by) of the tile as first texel. */
static lmb_status collect_block(const point_collector *c, const lmb_tile *tile, int32_t bx, int32_t by)
{
    const lmb_view *v = &c->map->view[c->face];
    element e[MAX_BLOCK_SURFACES];
    int32_t count = 0;
    float middle = 0.5f * (float)(c->block - 1),
          texel = 2.0f * maxf(v->half_width, v->half_height) / (float)c->map->size;
    for (int32_t y = 0; y < c->block; ++y) {
        for (int32_t x = 0; x < c->block; ++x) {
            int k = (by + y) * LMB_TILE + bx + x;
            float power[3];
            uint32_t nowhere, *owner = owner_of(c, &nowhere, tile->x + bx + x, tile->y + by + y);
            *owner = LMB_NOBODY;
            if (tile->id[k] == 0) {
                continue;
            }
            const lmb_vec3 p = tile_vec(tile->position, k);
            lmb_light_texel_power(power, c->light, c->map, c->face, tile->x + bx + x, tile->y + by + y);
            light_end_power(power, c->light, p);
            if (power[0] + power[1] + power[2] > 0.0f) {
                lmb_vec3 n = tile_vec(tile->face, k);
                float texel_m = texel * (v->kind == LMB_PERSPECTIVE ? tile->depth[k] : 1.0f);
                element *own = find_element(e, &count, p, n, texel_m);
                add_lit_texel(own, tile, k, power, (float)x - middle, (float)y - middle);
                *owner = c->points->count + (uint32_t)(own - e);
            }
        }
    }
    for (int32_t i = 0; i < count; ++i) {
        if (c->points->count == c->points->cap) {
            return LMB_ERR_CAPACITY;
        }
        lmb_point *p = &c->points->data[c->points->count++];
        make_point(p, &e[i], c->map, v);
        p->cell_x = (uint16_t)((tile->x + bx) / c->block);
        p->cell_y = (uint16_t)((tile->y + by) / c->block);
        p->face = c->points->faces;
    }
    return LMB_OK;
}

/* A row of blocks through all tiles of the row, so that points and cells come in row order. */
static lmb_status collect_block_row(const point_collector *c, const lmb_kernels *kernels, lmb_tile *tile, int32_t y)
{
    int32_t side = c->map->size / c->block;
    for (int32_t x = 0; x < c->map->size; x += c->block) {
        lmb_status status = LMB_OK;
        if (x % LMB_TILE == 0) {
            status = lmb_resolve_tile(tile, kernels, &c->map->view[c->face], c->scene, &c->map->face[c->face], x,
                                      y - y % LMB_TILE);
        }
        c->points->cells[(y / c->block) * side + x / c->block] = c->points->count;
        if (status == LMB_OK && (tile->hits > 0 || c->points->owner != NULL)) {
            status = collect_block(c, tile, x % LMB_TILE, y % LMB_TILE);
        }
        if (status != LMB_OK) {
            return status;
        }
    }
    return LMB_OK;
}

lmb_status lmb_points_collect(lmb_points *points, const lmb_kernels *kernels, lmb_tile *scratch,
                              const lmb_scene *scene, const lmb_light *light, const lmb_shadow_map *map, int32_t face,
                              int32_t tile_y0, int32_t tile_y1, const lmb_grouping *grouping)
{
    point_collector c;
    int32_t block = block_of(grouping);
    if (points == NULL || points->data == NULL || kernels == NULL || scratch == NULL || scene == NULL ||
        light == NULL || map == NULL || (uint32_t)face >= (uint32_t)map->faces || tile_y0 < 0 ||
        tile_y1 < tile_y0 || tile_y1 > map->size / LMB_TILE || !is_block(block)) {
        return LMB_ERR_ARG;
    }
    int32_t side = map->size / block;
    if ((uint32_t)side * (uint32_t)side + 1 > points->cell_cap) {
        return LMB_ERR_CAPACITY;
    }
    const uint32_t texels = points->owner != NULL ? (uint32_t)map->size * (uint32_t)map->size : 0;
    if (tile_y0 == 0) {
        if (texels > points->owner_cap - points->owner_count) {
            return LMB_ERR_CAPACITY;
        }
        points->owner_count += texels;
    } else if (points->faces == 0 || points->owner_count < texels) {
        return LMB_ERR_ARG; /* no face was begun */
    }
    points->faces += tile_y0 == 0;
    c.points = points;
    c.scene = scene;
    c.light = light;
    c.map = map;
    c.face = face;
    c.block = block;
    for (int32_t y = tile_y0 * LMB_TILE; y < tile_y1 * LMB_TILE; y += block) {
        lmb_status status = collect_block_row(&c, kernels, scratch, y);
        if (status != LMB_OK) {
            return status;
        }
    }
    if (tile_y1 == map->size / LMB_TILE) {
        points->cells[side * side] = points->count;
    }
    return LMB_OK;
}

/* --- in parts ----------------------------------------------------------------------------------------------------- */

/* The rows and cells of a part. */
typedef struct part_place {
    int32_t first_row, past_row;    /* of tiles */
    uint32_t first_cell, past_cell; /* of blocks */
} part_place;

static part_place place_part(const lmb_shadow_map *map, int32_t block, int32_t part, int32_t parts)
{
    const uint32_t cells_a_row = (uint32_t)((map->size / block) * (LMB_TILE / block));
    int64_t first, past;
    part_place p;
    share_out(&first, &past, map->size / LMB_TILE, part, parts);
    p.first_row = (int32_t)first;
    p.past_row = (int32_t)past;
    p.first_cell = (uint32_t)first * cells_a_row;
    p.past_cell = (uint32_t)past * cells_a_row;
    return p;
}

int lmb_points_have_room(const lmb_points *points, const lmb_shadow_map *map, const lmb_grouping *grouping)
{
    const int32_t block = block_of(grouping);
    if (!is_block(block)) {
        return 0;
    }
    const uint64_t side = (uint64_t)(map->size / block), cells = side * side,
                   texels = points->owner != NULL ? (uint64_t)map->size * (uint64_t)map->size : 0;
    return texels <= points->owner_cap - points->owner_count && cells < points->cell_cap &&
           MAX_BLOCK_SURFACES * cells <= points->cap - points->count;
}

lmb_status lmb_points_part(const lmb_points *points, const lmb_kernels *kernels, lmb_tile *scratch,
                           const lmb_scene *scene, const lmb_light *light, const lmb_shadow_map *map, int32_t face,
                           int32_t part, int32_t parts, const lmb_grouping *grouping)
{
    const part_place p = place_part(map, block_of(grouping), part, parts);
    lmb_points own = *points;
    if (p.first_row == p.past_row) {
        return LMB_OK;
    }
    own.data += points->count + MAX_BLOCK_SURFACES * p.first_cell;
    own.cap = MAX_BLOCK_SURFACES * (p.past_cell - p.first_cell);
    own.count = 0;
    if (p.first_row > 0) { /* row 0 counts the face */
        ++own.faces;
        own.owner_count += (uint32_t)map->size * (uint32_t)map->size;
    }
    lmb_status status =
        lmb_points_collect(&own, kernels, scratch, scene, light, map, face, p.first_row, p.past_row, grouping);
    if (status == LMB_OK) {
        own.cells[p.first_cell] =
            own.count; /* starts at the part's own 0; holds the count until the end */
    }
    return status;
}

/* Converts the owners of a part's texels from indices of the part to global ones. */
static void move_owners(const lmb_points *points, const lmb_shadow_map *map, const part_place *p)
{
    const uint32_t row = (uint32_t)(map->size * LMB_TILE);
    for (uint32_t i = (uint32_t)p->first_row * row; i < (uint32_t)p->past_row * row && points->owner != NULL; ++i) {
        uint32_t *owner = &points->owner[points->owner_count + i];
        *owner += *owner != LMB_NOBODY ? points->count : 0;
    }
}

void lmb_points_put_together(lmb_points *points, const lmb_shadow_map *map, int32_t parts, const lmb_grouping *grouping)
{
    const uint32_t so_far = points->count;
    const int32_t side = map->size / block_of(grouping);
    for (int32_t i = 0; i < parts; ++i) {
        const part_place p = place_part(map, block_of(grouping), i, parts);
        if (p.first_row == p.past_row) {
            continue;
        }
        const uint32_t count = points->cells[p.first_cell];
        memmove(points->data + points->count, points->data + so_far + MAX_BLOCK_SURFACES * p.first_cell,
                count * sizeof *points->data);
        points->cells[p.first_cell] = 0;
        move_owners(points, map, &p);
        for (uint32_t c = p.first_cell; c < p.past_cell; ++c) {
            points->cells[c] += points->count;
        }
        points->count += count;
    }
    points->cells[side * side] = points->count;
    points->owner_count += points->owner != NULL ? (uint32_t)map->size * (uint32_t)map->size : 0;
    ++points->faces;
}

#endif
