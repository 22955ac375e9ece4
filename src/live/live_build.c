/* live_build.c: first points sorted by world cell -> a tree of chunks of sixteen nodes. Layer 5.                [ours]
 *
 * A key is a cell of 1/16 of the world, one of six sides, then the path down to a cell of 1/512 along a Z curve. Points
 * that share a cell of some level and a plane form a node and are adjacent. Levels are built one after another, so if
 * chunks run out, only the finest nodes are missing. */
#include "live_part.h"

#include <string.h>

#include "../raster/triangle.h"

#if LMB_LIVE

enum {
    CELLS = 512,     /* cells along a side of the world: nine bits an axis */
    TOP_SHIFT = 15,  /* of a key: the bits above are the cell of 1/16 and the side */
    GROUPS = 4,      /* planes per cell; further ones join the closest */
    GROUP_SHIFT = 30, /* of a key, while points are grouped by plane */
    FINE_SHIFT = 21, /* of the keys of a node's own cells: cells of 1/4 */
    CROWD = 16,      /* more points than this in a cell of 1/512 of the world get finer cells, */
    ROUNDS = 3,      /* each time by 512 */
    PARTS = 64,      /* max parts of a node; the last takes the rest */
    TOP = LMB_LIVE_CUT / 2 * LMB_LIVE_NODES, /* nodes of the first level: half of a cut */
    DIGIT = 256      /* four passes sort 30 bits */
};
#define ALIKE  0.9f  /* min cosine between the normals of a plane's points, */
#define LIFT   0.25f /* max height of a point over the plane, as a share of their extent, */
#define GROUND 1e-4f /* or of the world's, if larger */
#define NOBODY 0xffffffffu

typedef struct pair {
    uint32_t key, point;
} pair;

typedef struct builder {
    lmb_live *live;
    lmb_vec3 low;
    float per_cell, extent; /* 1 / m; m, of the world */
    int shift;              /* of keys, to the cells of the current level */
    int is_fine;            /* the cells are those of a node's own box */
    uint32_t slots;         /* used: 16 times a chunk plus a lane */
} builder;

typedef struct range {
    uint32_t first, past;
} range;

/* --- keys --------------------------------------------------------------------------------------------------------- */

/* Spreads nine bits to every third bit. */
static uint32_t cell_bits(uint32_t v)
{
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
}

static uint32_t cell_of(float v) { return (uint32_t)clampi((int32_t)clampf(v, 0.0f, CELLS - 1), 0, CELLS - 1); }

/* 0 .. 5: the dominant axis of the normal, and the sign. */
static uint32_t side_of(lmb_vec3 n)
{
    const float x = absf(n.x), y = absf(n.y), z = absf(n.z);
    return x >= y && x >= z ? (n.x < 0.0f) : y >= z ? 2u + (n.y < 0.0f) : 4u + (n.z < 0.0f);
}

/* The cell's number along a Z curve. */
static uint32_t place_key(const builder *b, lmb_vec3 place)
{
    const lmb_vec3 at = mul3(sub3(place, b->low), b->per_cell);
    return cell_bits(cell_of(at.x)) | cell_bits(cell_of(at.y)) << 1 | cell_bits(cell_of(at.z)) << 2;
}

static uint32_t key_of(const builder *b, const lmb_live_point *p)
{
    const uint32_t z = place_key(b, p->position);
    return (z >> TOP_SHIFT) << (TOP_SHIFT + 3) | side_of(p->normal) << TOP_SHIFT | (z & ((1u << TOP_SHIFT) - 1));
}

/* Slots: those of the blocks of each face, those of the other quarters of each face, those of elements. */
typedef struct slot_run {
    size_t first, past;
    size_t each; /* if a slot is dark, so are the rest of `each` slots: a row of blocks, or the quarters of a tile */
    int of_map;
} slot_run;

static uint32_t slot_runs(const lmb_live *live) { return 2 * live->faces + 1; }

static slot_run slot_run_of(const lmb_live *live, uint32_t run)
{
    const size_t blocks = (size_t)live->side * (size_t)live->side, tiles = LIVE_SURFACES * live_tiles(live->side);
    const uint32_t face = run < live->faces ? run : run - live->faces;
    slot_run s = {live_slots(live->face_cap, live->side), 0, 1, run < 2 * live->faces};
    s.past = s.first + live->elements;
    if (s.of_map) {
        const int32_t side = live_blocks(&live->face[face]);
        s.first = run < live->faces ? face * blocks : live->face_cap * blocks + face * tiles;
        s.past = s.first + (run < live->faces ? (size_t)side * (size_t)side : LIVE_SURFACES * live_tiles(side));
        s.each = run < live->faces ? (size_t)side : LIVE_SURFACES;
    }
    return s;
}

/* The next slot with light from slot i on; s->past if there is none. */
static size_t lit_slot(const lmb_live *live, const slot_run *s, size_t i)
{
    while (i < s->past && !(live_power(live->point[i].flux) > 0.0f)) {
        i = s->first + ((i - s->first) / s->each + 1) * s->each;
    }
    return i;
}

/* Computes the bounding box of lit points, and the flux of the maps' points. */
static int lit_box(lmb_vec3 *low, lmb_vec3 *high, lmb_live *live)
{
    int any = 0;
    *low = vec3(3e38f, 3e38f, 3e38f);
    *high = vec3(-3e38f, -3e38f, -3e38f);
    live->sent[0] = live->sent[1] = live->sent[2] = 0.0;
    for (uint32_t run = 0; run < slot_runs(live); ++run) {
        const slot_run s = slot_run_of(live, run);
        for (size_t i = lit_slot(live, &s, s.first); i < s.past; i = lit_slot(live, &s, i + 1)) {
            const lmb_live_point *p = &live->point[i];
            *low = min3(*low, p->position);
            *high = max3(*high, p->position);
            any = 1;
            for (int h = 0; h < 3 && s.of_map; ++h) {
                live->sent[h] += (double)p->flux[h];
            }
        }
    }
    return any;
}

/* The cell grid is the scene's box, halved as long as all lit points fit in fewer than 480 cells. Its corner is aligned
 * to cells of 1/16, so that small movements of light do not shift the cells. */
static void set_cells(builder *b, const lmb_scene *scene, lmb_vec3 low, lmb_vec3 high)
{
    const lmb_vec3 size = sub3(scene->bounds_max, scene->bounds_min);
    const float lit = largest3(sub3(high, low));
    float extent = maxf(maxf(size.x, maxf(size.y, size.z)), 1e-6f);
    while (extent * 0.5f * (480.0f / 512.0f) > lit && extent > 1e-6f) {
        extent *= 0.5f;
    }
    const float top = extent * (1.0f / 16.0f);
    b->extent = extent;
    b->per_cell = (float)CELLS / extent;
    b->low.x = scene->bounds_min.x + floorf((low.x - scene->bounds_min.x) / top) * top;
    b->low.y = scene->bounds_min.y + floorf((low.y - scene->bounds_min.y) / top) * top;
    b->low.z = scene->bounds_min.z + floorf((low.z - scene->bounds_min.z) / top) * top;
}

/* --- sorting ------------------------------------------------------------------------------------------------------ */

/* One stable pass of a radix sort, by one digit of the keys. */
static void sort_by(pair *to, const pair *from, uint32_t count, int shift)
{
    uint32_t at[DIGIT], sum = 0;
    memset(at, 0, sizeof at);
    for (uint32_t i = 0; i < count; ++i) {
        ++at[from[i].key >> shift & (DIGIT - 1)];
    }
    for (int d = 0; d < DIGIT; ++d) {
        const uint32_t own = at[d];
        at[d] = sum;
        sum += own;
    }
    for (uint32_t i = 0; i < count; ++i) {
        to[at[from[i].key >> shift & (DIGIT - 1)]++] = from[i];
    }
}

/* Sorts the lit points by cell. The pairs use the memory of the chunks. */
static void sort_points(const builder *b)
{
    lmb_live *live = b->live;
    pair *one = (pair *)(void *)live->chunk, *other = (pair *)(void *)live->sorted;
    uint32_t count = 0;
    for (uint32_t run = 0; run < slot_runs(live); ++run) {
        const slot_run s = slot_run_of(live, run);
        for (size_t i = lit_slot(live, &s, s.first); i < s.past; i = lit_slot(live, &s, i + 1)) {
            one[count].key = key_of(b, &live->point[i]);
            one[count++].point = (uint32_t)i;
        }
    }
    for (int shift = 0; shift < 32; shift += 16) {
        sort_by(other, one, count, shift);
        sort_by(one, other, count, shift + 8);
    }
    for (uint32_t i = 0; i < count; ++i) {
        live->sorted[i] = live->point[one[i].point];
        live->sorted[i].key = one[i].key;
    }
    live->points = count;
}

/* --- planes ------------------------------------------------------------------------------------------------------- */

/* Groups a cell's points by plane. Returns the number of groups and sets their ranges. */
static uint32_t group(range out[GROUPS], const builder *b, range r)
{
    lmb_live_point *p = b->live->sorted;
    uint32_t first[GROUPS], count[GROUPS], groups = 0;
    if (r.past - r.first == 1) {
        out[0] = r;
        return 1;
    }
    const float reach = maxf(LIFT * 1.5f * sqrtf(p[r.first].area * (float)(r.past - r.first)), GROUND * b->extent);
    lmb_live_point *aside = (lmb_live_point *)(void *)(b->live->chunk + (b->slots / LMB_LIVE_NODES + 1));
    const size_t room = (size_t)((uint8_t *)(b->live->chunk + b->live->chunk_cap) - (uint8_t *)aside);
    out[0] = r;
    if ((r.past - r.first) * sizeof *p > room || b->slots / LMB_LIVE_NODES + 1 >= b->live->chunk_cap) {
        return 1;
    }
    for (uint32_t i = r.first; i < r.past; ++i) {
        uint32_t own = NOBODY, best = 0;
        float closest = -2.0f;
        for (uint32_t g = 0; g < groups && own == NOBODY; ++g) {
            const lmb_live_point *of = &p[first[g]];
            const float cosine = dot3(of->normal, p[i].normal);
            own = cosine > ALIKE && absf(dot3(of->normal, sub3(p[i].position, of->position))) < reach ? g : NOBODY;
            best = cosine > closest ? g : best;
            closest = maxf(closest, cosine);
        }
        if (own == NOBODY && groups < GROUPS) {
            first[groups] = i;
            count[groups] = 0;
            own = groups++;
        }
        own = own == NOBODY ? best : own;
        ++count[own];
        p[i].key |= own << GROUP_SHIFT;
    }
    if (groups > 1) {
        uint32_t to = r.first;
        memcpy(aside, p + r.first, (r.past - r.first) * sizeof *p);
        for (uint32_t g = 0; g < groups; ++g) {
            out[g].first = to;
            out[g].past = to + count[g];
            for (uint32_t i = 0; i < r.past - r.first; ++i) {
                if (aside[i].key >> GROUP_SHIFT == g) {
                    p[to] = aside[i];
                    p[to++].key &= (1u << GROUP_SHIFT) - 1;
                }
            }
        }
    }
    return groups;
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

/* Several lights may light the same surface, so the area of mixed points is that of the light with the largest part. */
static float area_of(float *mean, const lmb_live_point *p, uint32_t count)
{
    float sum = 0.0f, by_light[LMB_MAX_LIGHTS + 1], largest = 0.0f; /* elements come last */
    uint32_t others = 0;
    for (uint32_t i = 0; i < count; ++i) {
        sum += p[i].area;
        others |= (uint32_t)p[i].light ^ p[0].light;
    }
    *mean = sum / (float)count;
    if (others == 0) {
        return sum;
    }
    memset(by_light, 0, sizeof by_light);
    for (uint32_t i = 0; i < count; ++i) {
        float *own = &by_light[p[i].light % (LMB_MAX_LIGHTS + 1)];
        *own += p[i].area;
        largest = maxf(largest, *own);
    }
    return largest;
}

/* Spreads the bits of a cell's number to every second bit. */
static uint32_t spread_by_two(uint32_t v)
{
    v = (v | v << 8) & 0x00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0fu;
    v = (v | v << 2) & 0x33333333u;
    return (v | v << 1) & 0x55555555u;
}

/* The threshold of a cell and side. Cells beside each other on a plane of that side differ most, so that the nodes that
 * are targets spread evenly. */
static float threshold_of(const builder *b, const lmb_live_point *p)
{
    const uint32_t side = side_of(p->normal), axis = side / 2, z = b->is_fine ? p->key : place_key(b, p->position);
    const int level = b->shift / 3;
    uint32_t cell[3] = {0, 0, 0};
    for (int i = 0; i < 27; ++i) {
        cell[i % 3] |= (z >> i & 1u) << i / 3;
    }
    for (int h = 0; h < 3; ++h) {
        cell[h] >>= level;
    }
    return live_threshold(spread_by_two(cell[(axis + 1) % 3]) | spread_by_two(cell[(axis + 2) % 3]) << 1,
                          live_hash(cell[axis], side, (uint32_t)level));
}

#define MIDDLE_OFFSET 0.35f /* of 0.5: the share of each third of a cell that counts as the middle of the third */

/* Moves a place, 0 .. 1 along a cell, towards the middle of a third, without a jump. */
static float at_rest(float v)
{
    const float third = floorf(3.0f * v), off = 3.0f * v - third - 0.5f;
    const float over = maxf(absf(off) - MIDDLE_OFFSET, 0.0f) * (0.5f / (0.5f - MIDDLE_OFFSET));
    return (third + 0.5f + (off < 0.0f ? -over : over)) * (1.0f / 3.0f);
}

/* Sets the target of a steady node. First points move with the light. So the target is a place of the cell near the
 * node's place, as far as there are points around it: it lies on the triangle of the nearest point, and at most three
 * quarters of the point's width off it, so in the lit block. near: one of the first points. */
static void steady_target(lmb_live_target *t, const builder *b, const lmb_live_point *p, uint32_t count,
                          const lmb_live_point *near, lmb_vec3 place, lmb_vec3 normal)
{
    const float side = b->extent * (float)(1u << b->shift / 3) / (float)CELLS;
    const lmb_vec3 from = mul3(sub3(p->position, b->low), 1.0f / side),
                   low = add3(b->low, mul3(vec3(floorf(from.x), floorf(from.y), floorf(from.z)), side)),
                   in = mul3(sub3(place, low), 1.0f / side);
    const lmb_vec3 rest = add3(low, mul3(vec3(at_rest(in.x), at_rest(in.y), at_rest(in.z)), side)),
                   wanted = sub3(rest, mul3(normal, dot3(normal, sub3(rest, place))));
    float near2 = 3e38f;
    for (uint32_t k = 0; k < count; ++k) {
        const lmb_vec3 d = sub3(p[k].position, wanted);
        const float d2 = dot3(d, d);
        if (p[k].face != LMB_LIVE_ELEMENT && d2 < near2) {
            near = &p[k];
            near2 = d2;
        }
    }
    const lmb_vec3 to = sub3(wanted, near->position), along = sub3(to, mul3(near->normal, dot3(near->normal, to)));
    const float far = length3(along), max = 0.75f * sqrtf(near->area);
    const lmb_vec3 at = lmb_place_onto_triangle(
        b->live->scene, near->id, add3(near->position, far > max ? mul3(along, max / far) : along));
    const float position[3] = {at.x, at.y, at.z}, facet[3] = {near->normal.x, near->normal.y, near->normal.z};
    memcpy(t->at, position, sizeof position);
    memcpy(t->facet, facet, sizeof facet);
    t->id = near->id;
}

/* Stores a point as a node: what put_node computes for one point. */
static void put_point(const builder *b, uint32_t slot, uint32_t first)
{
    lmb_live_chunk *c = &b->live->chunk[slot / LMB_LIVE_NODES];
    const int i = (int)(slot % LMB_LIVE_NODES);
    const lmb_live_point *p = &b->live->sorted[first];
    const lmb_vec3 weighted = mul3(p->normal, live_power(p->flux));
    const lmb_vec3 normal = dot3(weighted, weighted) > 1e-37f ? normalize3(weighted) : p->normal;
    const live_light light = live_light_of(p->flux);
    const int whole = lmb_live_is_whole(b->live, p);
    const float disc = whole ? p->area : LIVE_DISC * p->area;
    live_put(c, i, p->position, normal, &light, maxf(disc, 1e-30f), p->position, p->normal, p->id);
    c->radius2[i] = lmb_live_reach2(b->live, p) * lmb_live_softness(b->live, p);
    c->first[i] = first;
    c->count[i] = LMB_LIVE_LEAF | 1u;
    c->threshold[i] = b->live->steady ? threshold_of(b, p) : 0.0f;
}

/* Stores points of one plane as a node. */
static void put_node(const builder *b, uint32_t slot, range r)
{
    lmb_live_chunk *c = &b->live->chunk[slot / LMB_LIVE_NODES];
    const int i = (int)(slot % LMB_LIVE_NODES);
    const lmb_live_point *p = b->live->sorted + r.first, *target = p;
    const uint32_t count = r.past - r.first;
    lmb_vec3 place = vec3(0, 0, 0), normal = vec3(0, 0, 0);
    float flux[3] = {0, 0, 0}, far2 = 0.0f, near2 = 3e38f, own2 = 0.0f, soft = 0.0f;
    if (count == 1) {
        put_point(b, slot, r.first);
        return;
    }
    for (uint32_t k = 0; k < count; ++k) {
        const float w = live_power(p[k].flux);
        place = add3(place, mul3(sub3(p[k].position, p->position), w));
        normal = add3(normal, mul3(p[k].normal, w));
        for (int h = 0; h < 3; ++h) {
            flux[h] += p[k].flux[h];
        }
    }
    const live_light light = live_light_of(flux);
    const float power = light.power;
    place = add3(p->position, mul3(place, 1.0f / power));
    normal = dot3(normal, normal) > 1e-37f ? normalize3(normal) : p->normal;
    for (uint32_t k = 0; k < count; ++k) {
        const lmb_vec3 d = sub3(p[k].position, place);
        const float d2 = dot3(d, d);
        target = d2 < near2 ? &p[k] : target;
        near2 = minf(near2, d2);
        far2 = maxf(far2, d2);
        if (p[k].face == LMB_LIVE_ELEMENT) {
            own2 = maxf(own2, lmb_live_reach2(b->live, &p[k]));
            soft = maxf(soft, lmb_live_softness(b->live, &p[k]));
        } else {
            soft = 1.0f;
        }
    }
    float spacing2;
    const float area = area_of(&spacing2, p, count);
    live_put(c, i, place, normal, &light, maxf(LIVE_DISC * area, 1e-30f), target->position, target->normal, target->id);
    c->radius2[i] = (far2 + maxf(spacing2, own2)) * soft;
    c->first[i] = r.first;
    c->count[i] = count | LMB_LIVE_LEAF;
    c->threshold[i] = b->live->steady ? threshold_of(b, p) : 0.0f;
    if (b->live->steady && !b->is_fine && target->face != LMB_LIVE_ELEMENT) {
        steady_target(&c->target[i], b, p, count, target, place, normal);
    }
}

/* Allocates a node's parts, in a new chunk if they would straddle two. Returns NOBODY if none is left. */
static uint32_t reserve(builder *b, uint32_t count)
{
    const uint32_t in = b->slots % LMB_LIVE_NODES;
    const uint32_t first = in + count > LMB_LIVE_NODES && in > 0 ? b->slots + LMB_LIVE_NODES - in : b->slots;
    const uint32_t before = (b->slots + LMB_LIVE_NODES - 1) / LMB_LIVE_NODES,
                   chunks = (first + count + LMB_LIVE_NODES - 1) / LMB_LIVE_NODES;
    if (chunks > b->live->chunk_cap) {
        return NOBODY;
    }
    for (uint32_t k = before; k < chunks; ++k) {
        live_blank(&b->live->chunk[k]);
    }
    b->slots = first + count;
    return first;
}

/* The first slot of the next chunk, or this one. */
static uint32_t whole_chunks(uint32_t slots)
{
    return (slots + LMB_LIVE_NODES - 1) / LMB_LIVE_NODES * LMB_LIVE_NODES;
}

/* End of a run of points in one cell. */
static uint32_t run_past(const lmb_live_point *p, uint32_t first, uint32_t past, int shift)
{
    uint32_t i = first + 1;
    while (i < past && p[i].key >> shift == p[first].key >> shift) {
        ++i;
    }
    return i;
}

/* Divides a node by cell and plane. If that gives a single part, a finer level divides it. */
static void divide(builder *b, uint32_t slot, int shift)
{
    lmb_live_chunk *c = &b->live->chunk[slot / LMB_LIVE_NODES];
    const int i = (int)(slot % LMB_LIVE_NODES);
    const uint32_t past = c->first[i] + (c->count[i] & ~LMB_LIVE_LEAF);
    range part[PARTS + 1]; /* the last cell's planes may fill the array, and the rest follows */
    uint32_t parts = 0;
    b->shift = shift;
    for (range r = {c->first[i], 0}; r.first < past; r.first = r.past) {
        r.past = parts + GROUPS > PARTS ? past : run_past(b->live->sorted, r.first, past, shift);
        if (parts + GROUPS > PARTS) {
            part[parts++] = r;
        } else {
            parts += group(part + parts, b, r);
        }
    }
    if (parts < 2) {
        return;
    }
    const uint32_t first = reserve(b, parts);
    if (first == NOBODY) {
        ++b->live->merged;
        return;
    }
    for (uint32_t k = 0; k < parts; ++k) {
        put_node(b, first + k, part[k]);
    }
    c->first[i] = first;
    c->count[i] = parts;
}

/* Divides the nodes from slot `first` on. */
static void divide_level(builder *b, uint32_t first, int shift)
{
    const uint32_t slots = b->slots;
    for (uint32_t slot = first; slot < slots; ++slot) {
        const uint32_t count = b->live->chunk[slot / LMB_LIVE_NODES].count[slot % LMB_LIVE_NODES];
        if (count > (LMB_LIVE_LEAF | 1u)) {
            divide(b, slot, shift);
        }
    }
}

/* --- fine places -------------------------------------------------------------------------------------------------- */

/* Sorts a node's points by cells of 1/512 of their own box. Returns 0 if memory is short. */
static int sort_again(const builder *b, range r)
{
    lmb_live_point *p = b->live->sorted + r.first;
    const uint32_t count = r.past - r.first, used = (b->slots + LMB_LIVE_NODES - 1) / LMB_LIVE_NODES;
    lmb_live_point *aside = (lmb_live_point *)(void *)(b->live->chunk + used);
    pair *one = (pair *)(void *)(aside + count), *other = one + count;
    builder own = *b;
    lmb_vec3 high = p->position;
    if ((b->live->chunk_cap - used) * sizeof *b->live->chunk < count * (sizeof *aside + 2 * sizeof *one)) {
        return 0;
    }
    own.low = p->position;
    for (uint32_t i = 1; i < count; ++i) {
        own.low = min3(own.low, p[i].position);
        high = max3(high, p[i].position);
    }
    own.per_cell = (float)CELLS / maxf(largest3(sub3(high, own.low)), 1e-6f);
    for (uint32_t i = 0; i < count; ++i) {
        one[i].key = place_key(&own, p[i].position);
        one[i].point = i;
    }
    for (int shift = 0; shift < 32; shift += 16) {
        sort_by(other, one, count, shift);
        sort_by(one, other, count, shift + 8);
    }
    memcpy(aside, p, count * sizeof *p);
    for (uint32_t i = 0; i < count; ++i) {
        p[i] = aside[one[i].point];
        p[i].key = one[i].key;
    }
    return 1;
}

/* Divides the crowded nodes below the slot `past`. Returns 1 if there were any. */
static int divide_crowds(builder *b, uint32_t past)
{
    int any = 0;
    for (uint32_t slot = 0; slot < past; ++slot) {
        const lmb_live_chunk *c = &b->live->chunk[slot / LMB_LIVE_NODES];
        const uint32_t i = slot % LMB_LIVE_NODES, count = c->count[i] & ~LMB_LIVE_LEAF;
        const range r = {c->first[i], c->first[i] + count};
        if ((c->count[i] & LMB_LIVE_LEAF) != 0 && count > CROWD && sort_again(b, r)) {
            divide(b, slot, FINE_SHIFT);
            any = 1;
        }
    }
    return any;
}

/* A house on a wide terrain lies in a few cells. Nodes that still have many points are divided by finer cells. */
static void divide_fine(builder *b)
{
    b->is_fine = 1;
    for (int round = 0; round < ROUNDS; ++round) {
        const uint32_t past = b->slots = whole_chunks(b->slots);
        if (!divide_crowds(b, past)) {
            return;
        }
        for (int shift = FINE_SHIFT - 6; shift > 0; shift -= 6) {
            b->slots = whole_chunks(b->slots);
            divide_level(b, past, shift);
        }
    }
}

/* Creates the first level: cells of 1/16 of the world, or larger ones if there are too many; split by plane while
 * memory lasts. */
static void put_top(builder *b)
{
    const lmb_live *live = b->live;
    uint32_t cells = TOP + 1;
    const uint32_t limit = (uint32_t)mini(TOP, (int32_t)(live->chunk_cap / 2 * LMB_LIVE_NODES));
    int shift = TOP_SHIFT;
    for (; cells > limit; shift += 3) {
        cells = 0;
        for (uint32_t i = 0; i < live->points; i = run_past(live->sorted, i, live->points, shift)) {
            ++cells;
        }
    }
    shift -= 3;
    b->shift = shift;
    for (uint32_t i = 0, past; i < live->points; i = past) {
        range part[GROUPS];
        past = run_past(live->sorted, i, live->points, shift);
        part[0].first = i;
        part[0].past = past;
        const uint32_t parts = b->slots + cells + GROUPS <= limit ? group(part, b, part[0]) : 1;
        const uint32_t first = reserve(b, parts);
        for (uint32_t k = 0; k < parts && first != NOBODY; ++k) {
            put_node(b, first + k, part[k]);
        }
        --cells;
    }
}

lmb_status lmb_live_build(lmb_live *live, const lmb_scene *scene)
{
    lmb_vec3 low, high;
    builder b;
    if (live == NULL || live->face == NULL || scene == NULL || live->faces > live->face_cap ||
        live->elements > live->element_cap || (live->elements > 0 && live->element == NULL)) {
        return LMB_ERR_ARG;
    }
    live->chunks = live->top = live->points = live->merged = 0;
    live->built = 1 + live->steady;
    memset(&b, 0, sizeof b);
    b.live = live;
    live->scene = scene;
    if (!lit_box(&low, &high, live)) {
        return LMB_OK;
    }
    set_cells(&b, scene, low, high);
    sort_points(&b);
    put_top(&b);
    live->top = b.slots;
    for (int shift = TOP_SHIFT - 6; shift > 0; shift -= 6) {
        b.slots = whole_chunks(b.slots);
        divide_level(&b, 0, shift);
    }
    divide_fine(&b);
    live->chunks = (b.slots + LMB_LIVE_NODES - 1) / LMB_LIVE_NODES;
    return LMB_OK;
}

#endif
