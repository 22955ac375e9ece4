/* bake_elements.c: triangles -> elements of similar size, sorted, and the tree of pieces that leads to them. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "bake_triangle.h"

enum { MESH = 500, CROWD = 8, WASTE = 4, CELL = 3 /* elements of a cell, at most, that walls separate */ };
enum { Z_BITS = 9 }; /* steps along an axis of the order, as a power of two */
#define CONTACT 0.2f /* of an element's size: smallest size of elements that other geometry touches */
#define CLOSER  0.5f /* of that, if enough elements are left */
#define LARGE   9.0f  /* times the smallest size of elements: above it, elements may be long and thin */
#define STARVED 4.0f  /* the same: above it, thin elements at contacts are not smaller */
#define SMALLER 0.75f /* but only if all others become this much smaller */
#define STANDING 0.4f /* of an element's size: size of elements with a wall at a corner */
#define SLIVER  0.25f /* of that size: narrower triangles share elements, because they would use up all of them */
#define LONG    4.0f  /* largest ratio between a thin element's longest edge and that of a compact one of that area */
#define BESIDE  0.1f  /* of the smallest edge: distance of the points tested on both sides of a wall */
#define CORNERS (7u << 3) /* bits of a piece that record walls: three for edges, then three for corners */

lmb_vec3 bake_facing(const bake_element *e)
{
    const lmb_vec3 across = cross3(sub3(e->corner[1], e->corner[0]), sub3(e->corner[2], e->corner[0]));
    const float length = length3(across);
    return e->is_one || !(length > 0.0f) ? e->normal : mul3(across, 1.0f / length);
}

/* If there are few small triangles, they are no mesh: the sides of a box get receivers of their own. */
static void set_small(bake *b)
{
    const uint32_t all = lmb_scene_triangles(b->scene);
    lmb_triangle t;
    b->small_m = 2.0f * b->set.cluster_m;
    for (uint32_t id = 1; id <= all; ++id) {
        b->small_count += lmb_triangle_fetch(&t, b->scene, id) && bake_is_small(b, t.corner);
    }
    if (b->small_count < MESH) {
        b->small_m = 0.0f;
        b->small_count = 0;
    }
}

int bake_begin(bake *b, const lmb_scene *scene, const bake_settings *set, report *r)
{
    const uint32_t all = lmb_scene_triangles(scene);
    const size_t bytes = lmb_bvh_bytes(all);
    double area = 0.0;
    b->set = *set;
    b->scene = scene;
    b->kernels = lmb_kernels_pick();
    b->bvh_memory = bytes > 0 ? malloc(bytes) : NULL;
    if (b->bvh_memory == NULL || lmb_bvh_init(&b->bvh, all, b->bvh_memory, bytes) != LMB_OK ||
        lmb_bvh_build(&b->bvh, scene) != LMB_OK) {
        return report_fail(r, "not enough memory for %u triangles", (unsigned)all);
    }
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_triangle t;
        lmb_vec3 n;
        float own;
        if (lmb_triangle_fetch(&t, scene, id) && lmb_triangle_shape(&n, &own, &t)) {
            area += (double)own * (t.material->flags & LMB_DOUBLE_SIDED ? 2.0 : 1.0);
        }
    }
    b->area = (float)area;
    if (!(b->area > 0.0f)) {
        return report_fail(r, "no surface to light: all triangles are points or lines");
    }
    b->has_cluster_m = set->cluster_m > 0.0f;
    if (!b->has_cluster_m) {
        b->set.cluster_m = sqrtf(b->area / 6000.0f);
    }
    set_small(b);
    if (b->set.smallest_m <= 0.0f) {
        b->set.smallest_m = sqrtf(b->area / 100000.0f);
    }
    return 1;
}

/* Makes the corners counter-clockwise around the normal. */
static void put_round(lmb_vec3 corner[3], lmb_vec3 normal)
{
    if (dot3(normal, cross3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0]))) < 0.0f) {
        const lmb_vec3 last = corner[2];
        corner[2] = corner[1];
        corner[1] = last;
    }
}

static int is_narrow(const lmb_vec3 corner[3], float width)
{
    int from;
    return 2.0f * triangle_area(corner) < width * triangle_longest(&from, corner);
}

/* --- pieces ------------------------------------------------------------------------------------------------------- */

typedef struct maker {
    bake *b;
    bake_sight sight;
    float side, contact;
    uint32_t *slot; /* hash table of small triangles' cells: element + 1 */
    uint32_t mask;
    uint8_t *is_reached; /* per side of a triangle */
    int is_full;
    int emits; /* of the current triangle */
    int is_small, is_sliver;
    int has_slivers; /* many slivers: they share elements; if few, each has one, as the edge of a thin wall should */
    int had_slivers; /* at the smallest element size */
    int is_crowded;  /* so many cross other geometry that those share elements too */
    uint32_t own; /* current side: 2 (id - 1) + back */
    uint32_t cut; /* leaf of the cuts at the current piece; 0: none */
    report *r;
} maker;

/* Adds a triangle to an element that has several, or may get more. */
static int add_part(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal, uint32_t element, uint32_t side)
{
    bake *b = m->b;
    if (b->part_count == b->part_cap) {
        const uint32_t cap = b->part_cap > 0 ? 2 * b->part_cap : 1024;
        bake_part *data = realloc(b->part, cap * sizeof *data);
        if (data == NULL) {
            return report_fail(m->r, "not enough memory for %u parts of elements", (unsigned)cap);
        }
        b->part = data;
        b->part_cap = cap;
    }
    bake_part *p = &b->part[b->part_count++];
    memcpy(p->corner, corner, sizeof p->corner);
    put_round(p->corner, normal);
    p->normal = normal;
    p->middle = triangle_middle(corner);
    p->area = triangle_area(corner);
    p->open = 1.0f;
    p->element = element;
    p->number = b->part_count;
    p->side = side;
    return 1;
}

static uint32_t add_element(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal)
{
    bake *b = m->b;
    if (b->element_count == b->set.elements) {
        m->is_full = 1;
        return 0;
    }
    bake_element *e = &b->element[b->element_count];
    memset(e, 0, sizeof *e);
    memcpy(e->corner, corner, sizeof e->corner);
    put_round(e->corner, normal);
    e->middle = e->place = triangle_middle(corner);
    e->normal = normal;
    e->area = triangle_area(corner);
    e->facing = 1.0f;
    e->is_one = 1;
    e->open = 1.0f;
    e->emits = m->emits;
    e->number = b->element_count;
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 d = sub3(corner[k], e->middle);
        e->reach2 = maxf(e->reach2, dot3(d, d));
    }
    return b->element_count++;
}

void bake_join(const bake *b, bake_element *e)
{
    if (e->parts == 0) {
        return;
    }
    const bake_part *p = b->part + e->first_part;
    lmb_vec3 middle = vec3(0.0f, 0.0f, 0.0f), normal = middle;
    float area = 0.0f, largest = 0.0f;
    for (uint32_t i = 0; i < e->parts; ++i) {
        const float own = p[i].area * p[i].open;
        area += own;
        middle = add3(middle, mul3(p[i].middle, own));
        normal = add3(normal, mul3(p[i].normal, own));
        if (own > largest) {
            largest = own;
            e->place = p[i].middle;
            memcpy(e->corner, p[i].corner, sizeof e->corner);
        }
    }
    if (!(area > 0.0f)) {
        return;
    }
    e->area = area;
    e->middle = mul3(middle, 1.0f / area);
    e->facing = length3(normal) / area;
    e->normal = e->facing > 1e-6f ? normalize3(normal) : e->normal;
    e->reach2 = 0.0f;
    for (uint32_t i = 0; i < e->parts; ++i) {
        for (int k = 0; k < 3 && p[i].open > 0.0f; ++k) {
            const lmb_vec3 d = sub3(p[i].corner[k], e->middle);
            e->reach2 = maxf(e->reach2, dot3(d, d));
        }
    }
}

/* No light reaches the current triangle, as far as is known, so it shares an element only with other closed ones. */
/* 0 .. 5: dominant axis and sign of a normal. */
static uint32_t facing_of(lmb_vec3 n)
{
    const float x = absf(n.x), y = absf(n.y), z = absf(n.z);
    if (x >= y && x >= z) {
        return n.x < 0.0f;
    }
    return y >= z ? 2u + (n.y < 0.0f) : 4u + (n.z < 0.0f);
}

static uint32_t is_closed(const maker *m)
{
    return m->b->small_open != NULL && m->is_small && m->b->small_open[m->own] == 0;
}

static uint32_t small_element(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal)
{
    const lmb_vec3 at = triangle_middle(corner), low = m->b->scene->bounds_min;
    const float per = 2.0f / m->side;
    const uint32_t cell[4] = {(uint32_t)clampf((at.x - low.x) * per, 0.0f, 1e6f),
                              (uint32_t)clampf((at.y - low.y) * per, 0.0f, 1e6f),
                              (uint32_t)clampf((at.z - low.z) * per, 0.0f, 1e6f),
                              facing_of(normal) | (uint32_t)m->emits << 3 | is_closed(m) << 4};
    uint32_t h = cell[0] * 73856093u ^ cell[1] * 19349663u ^ cell[2] * 83492791u ^ cell[3] * 2654435761u;
    int met = 0;
    h ^= h >> 15;
    for (;; ++h) {
        uint32_t *slot = &m->slot[5 * (size_t)(h & m->mask)];
        if (slot[4] == 0) {
            const uint32_t e = add_element(m, corner, normal);
            memcpy(slot, cell, sizeof cell);
            slot[4] = e + 1;
            return e;
        }
        const bake_element *first = &m->b->element[slot[4] - 1];
        if (memcmp(slot, cell, sizeof cell) == 0 &&
            (++met == CELL || bake_sees_over(&m->sight, m->b, at, normal, first->middle, first->normal))) {
            m->b->element[slot[4] - 1].is_one = 0;
            return slot[4] - 1;
        }
    }
}

/* Returns whether there is a wall at this point of the line to another. Lines of cuts continue past the end of a
 * wall. */
static int is_wall(maker *m, lmb_vec3 at, lmb_vec3 to, lmb_vec3 normal)
{
    const lmb_vec3 near = bake_pulled(m->b, at, to);
    const lmb_vec3 across = mul3(normalize3(cross3(normal, sub3(to, at))), BESIDE * m->b->set.smallest_m);
    return !bake_sees(&m->sight, m->b, add3(near, across), sub3(near, across), normal);
}

/* Returns the wall bits of both halves: the cut is an edge of each, from the new corner to the opposite one. */
static void half_walls(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal, const bake_cut *cut, uint32_t walls,
                       uint32_t out[2])
{
    const int from = cut->from, to = (from + 1) % 3, other = (from + 2) % 3;
    const lmb_vec3 mid = bake_cut_at(cut, corner);
    const uint32_t own = (cut->is_wall && is_wall(m, mid, corner[other], normal)) ||
                         ((walls >> from & 1u) != 0 && is_wall(m, mid, corner[to], normal));
    walls |= (uint32_t)(cut->is_wall && is_wall(m, corner[other], mid, normal)) << (3 + other);
    for (int h = 0; h < 2; ++h) {
        const int moves = h == 0 ? to : from, line = h == 0 ? to : other;
        out[h] = (walls & ~(1u << line | 8u << moves)) | (uint32_t)cut->is_wall << line | own << (3 + moves);
    }
}

static int halve(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal, size_t node, int depth, uint32_t walls);

static int halve_by(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal, size_t node, int depth, const bake_cut *cut,
                    uint32_t walls)
{
    const uint32_t own = m->cut;
    uint32_t first, on[2];
    if (!bake_divide(m->b, &m->b->section[LMB_TRANSFER_PIECES], node, cut, &first, m->r)) {
        return 0;
    }
    half_walls(m, corner, normal, cut, walls, on);
    for (uint32_t h = 0; h < 2; ++h) {
        lmb_vec3 half[3];
        memcpy(half, corner, sizeof half);
        half[h == 0 ? (cut->from + 1) % 3 : cut->from] = bake_cut_at(cut, corner);
        m->cut = cut->first > 0 ? cut->first + h : own;
        if (!halve(m, half, normal, first + h, depth + 1, on[h])) {
            return 0;
        }
    }
    return 1;
}

/* Returns the size of a piece, m: the longest edge; with thin pieces, that of half a square of the same area, or the
 * facets of pillars would take all elements. */
static float size_of(const maker *m, const lmb_vec3 corner[3], float longest)
{
    const float compact = 2.0f * sqrtf(triangle_area(corner));
    return m->b->has_thin ? minf(longest, maxf(compact, longest * (1.0f / LONG))) : longest;
}

/* Cuts a triangle, then halves it at the longest edge until it is small enough; adds nodes to the section of pieces.
 * Light changes fast next to walls, so pieces are smaller there, but larger than the blocks of a shadow map. */
static int halve(maker *m, const lmb_vec3 corner[3], lmb_vec3 normal, size_t node, int depth, uint32_t walls)
{
    bake_words *w = &m->b->section[LMB_TRANSFER_PIECES];
    bake_cut cut = m->b->cut[m->cut];
    int from;
    const float longest = size_of(m, corner, triangle_longest(&from, corner));
    if (m->is_full) {
        return 1;
    }
    if (cut.first > 0) {
        return halve_by(m, corner, normal, node, depth, &cut, walls);
    }
    if (cut.is_closed[m->own % 2]) {
        w->data[node] = LMB_TRANSFER_LEAF | add_element(m, corner, normal);
        return 1;
    }
    const int is_small = depth == 0 && longest * 2.0f < m->side, is_last = depth == LMB_TRANSFER_MAX_HALVINGS;
    const int is_free = longest <= m->side && (is_small || (m->is_crowded && m->is_sliver) ||
                                               bake_stands_free(&m->sight, m->b, corner, normal));
    const int is_beside = (walls & CORNERS) != 0 && !is_small && !m->is_sliver;
    if (is_last || (is_free && !(is_beside && longest > STANDING * m->side)) || longest <= m->contact * m->side) {
        const int is_shared = is_free && (is_small || m->is_sliver);
        const uint32_t e = is_shared ? small_element(m, corner, normal) : add_element(m, corner, normal);
        w->data[node] = LMB_TRANSFER_LEAF | e;
        m->b->element[e].is_stood_on = !is_free;
        return !is_shared || add_part(m, corner, normal, e, depth == 0 ? m->own : LMB_TRANSFER_NONE);
    }
    memset(&cut, 0, sizeof cut);
    cut.from = from;
    cut.part = 0.5f;
    return halve_by(m, corner, normal, node, depth, &cut, walls);
}

/* Adds the sides of a triangle that show, by material and mirroring of the instance. */
static int add_triangle(maker *m, uint32_t id)
{
    bake *b = m->b;
    bake_words *surfaces = &b->section[LMB_TRANSFER_SURFACES], *pieces = &b->section[LMB_TRANSFER_PIECES];
    lmb_triangle t;
    lmb_vec3 normal;
    float area;
    const int exists = lmb_triangle_fetch(&t, b->scene, id) && lmb_triangle_shape(&normal, &area, &t);
    m->emits =
        exists && largest3(vec3(t.material->emission[0], t.material->emission[1], t.material->emission[2])) > 0.0f;
    m->is_small = exists && bake_is_small(b, t.corner);
    m->is_sliver = exists && m->has_slivers && is_narrow(t.corner, SLIVER * m->side);
    for (int back = 0; back < 2; ++back) {
        const int shows =
            exists && ((t.material->flags & LMB_DOUBLE_SIDED) != 0 || back == is_mirrored(&t.instance->to_world)) &&
            m->is_reached[2 * (id - 1) + (size_t)back];
        m->own = 2 * (id - 1) + (uint32_t)back;
        m->cut = b->cut_root[id - 1];
        surfaces->data[4 * (id - 1) + (size_t)back] = shows ? (uint32_t)pieces->count : LMB_TRANSFER_NONE;
        if (shows && (!bake_put(pieces, 0, m->r) ||
                      !halve(m, t.corner, mul3(normal, back ? -1.0f : 1.0f), pieces->count - 1, 0, 0))) {
            return 0;
        }
    }
    return 1;
}

static int by_element(const void *a, const void *b)
{
    const bake_part *x = a, *y = b;
    return x->element != y->element ? (x->element < y->element ? -1 : 1) : x->number < y->number ? -1 : 1;
}

/* Makes the parts of each element adjacent. */
static void take_parts(bake *b)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < b->part_count; ++i) {
        if (!b->element[b->part[i].element].is_one) {
            b->part[kept++] = b->part[i];
        }
    }
    b->part_count = kept;
    if (kept > 0) {
        qsort(b->part, kept, sizeof *b->part, by_element);
    }
    for (uint32_t i = 0; i < kept; ++i) {
        bake_element *e = &b->element[b->part[i].element];
        e->first_part = e->parts++ == 0 ? i : e->first_part;
    }
    for (uint32_t i = 0; i < b->element_count; ++i) {
        bake_join(b, &b->element[i]);
    }
}

/* Counts only long slivers: small triangles of a mesh share elements anyway, and do not force a window's jambs to
 * share. */
static uint32_t slivers(const maker *m)
{
    uint32_t count = 0;
    lmb_triangle t;
    for (uint32_t id = 1; id <= lmb_scene_triangles(m->b->scene); ++id) {
        int from;
        count += lmb_triangle_fetch(&t, m->b->scene, id) && 2.0f * triangle_longest(&from, t.corner) >= m->side &&
                 is_narrow(t.corner, SLIVER * m->side);
    }
    return count;
}

static int make(maker *m)
{
    const uint32_t all = lmb_scene_triangles(m->b->scene), long_ones = slivers(m);
    m->b->section[LMB_TRANSFER_PIECES].count = m->b->section[LMB_TRANSFER_CUTS].count = 0;
    m->b->element_count = m->b->part_count = 0;
    memset(m->b->element, 0, m->b->set.elements * sizeof *m->b->element);
    m->is_full = 0;
    m->has_slivers = long_ones >= MESH && long_ones * CROWD >= m->b->set.elements;
    m->had_slivers |= m->has_slivers;
    memset(m->slot, 0, 20 * ((size_t)m->mask + 1));
    for (uint32_t id = 1; id <= all && !m->is_full; ++id) {
        if (!add_triangle(m, id)) {
            return 0;
        }
    }
    if (!m->is_full) {
        take_parts(m->b);
    }
    return 1;
}

/* --- order -------------------------------------------------------------------------------------------------------- */

/* Moves bits 0, 1, 2, .. to 0, 3, 6, .. */
static uint32_t spread_bits(uint32_t v)
{
    uint32_t out = 0;
    for (int i = 0; i < Z_BITS; ++i) {
        out |= ((v >> i) & 1u) << (3 * i);
    }
    return out;
}

/* Steps along an axis, of 2^Z_BITS. */
static uint32_t step_of(float at, float low, float per)
{
    return (uint32_t)clampf((at - low) * per, 0.0f, (float)((1 << Z_BITS) - 1));
}

/* The facing, then the place along a Z curve. */
uint32_t bake_key(const lmb_scene *scene, lmb_vec3 at, lmb_vec3 normal)
{
    const float longest = largest3(sub3(scene->bounds_max, scene->bounds_min));
    const float per = (float)(1 << Z_BITS) / maxf(longest, 1e-30f);
    const lmb_vec3 low = scene->bounds_min;
    return facing_of(normal) << (3 * Z_BITS) | spread_bits(step_of(at.x, low.x, per)) |
           spread_bits(step_of(at.y, low.y, per)) << 1 | spread_bits(step_of(at.z, low.z, per)) << 2;
}

static int by_key(const void *a, const void *b)
{
    const bake_element *x = a, *y = b;
    const uint32_t hidden = 1u << 31;
    if ((x->key & hidden) != (y->key & hidden)) {
        return (x->key & hidden) < (y->key & hidden) ? -1 : 1;
    }
    if (x->zone != y->zone) {
        return x->zone < y->zone ? -1 : 1;
    }
    return x->key != y->key ? (x->key < y->key ? -1 : 1) : x->number < y->number ? -1 : 1;
}

/* Returns the common zone of four nodes, if they have one. */
static uint32_t join_zones(const uint32_t child[4])
{
    uint32_t zone = BAKE_NO_ZONE;
    for (int k = 0; k < 4; ++k) {
        zone = child[k] == BAKE_NO_ZONE || child[k] == zone ? zone : zone == BAKE_NO_ZONE ? child[k] : BAKE_ZONES;
    }
    return zone;
}

int bake_zones(bake *b, report *r)
{
    const uint32_t n = b->set.elements;
    free(b->node_zone);
    b->node_zone = malloc(((size_t)n / 3 * 4 + 2) * sizeof *b->node_zone);
    if (b->node_zone == NULL) {
        return report_fail(r, "not enough memory for %u elements", (unsigned)n);
    }
    for (uint32_t i = 0; i < n; ++i) {
        b->node_zone[i] = bake_open_area(&b->element[i]) > 0.0f ? b->element[i].zone : BAKE_NO_ZONE;
    }
    for (uint32_t below = 0, at = n, count = n / 4; count > 0; below = at, at += count, count /= 4) {
        for (uint32_t i = 0; i < count; ++i) {
            b->node_zone[at + i] = join_zones(&b->node_zone[below + 4 * i]);
        }
    }
    return 1;
}

uint32_t bake_zone_of(const bake *b, const uint16_t *row, int axes)
{
    const uint32_t n = b->set.elements;
    uint32_t best = 0;
    float highest = 0.0f;
    for (uint32_t i = 0; i < n; ++i) {
        float sum = 0.0f;
        for (int a = 0; a < axes; ++a) {
            sum += absf(bake_long(row[(size_t)a * n + i]));
        }
        if (sum > highest) {
            highest = sum;
            best = i;
        }
    }
    return highest > 0.0f ? b->element[best].zone : BAKE_NO_ZONE;
}

int bake_order(bake *b, report *r)
{
    uint32_t *place = malloc((b->element_count + 1) * sizeof *place);
    if (place == NULL) {
        return report_fail(r, "not enough memory for %u elements", (unsigned)b->element_count);
    }
    for (uint32_t i = 0; i < b->element_count; ++i) {
        bake_element *e = &b->element[i];
        e->number = i;
        e->key = bake_key(b->scene, e->middle, e->normal) | (uint32_t)e->is_hidden << 31 | (uint32_t)e->emits << 30;
    }
    qsort(b->element, b->element_count, sizeof *b->element, by_key);
    for (uint32_t i = 0; i < b->element_count; ++i) {
        place[b->element[i].number] = i;
    }
    for (uint32_t i = 0; i < b->part_count; ++i) {
        b->part[i].element = place[b->part[i].element];
    }
    bake_words *pieces = &b->section[LMB_TRANSFER_PIECES], *areas = &b->section[LMB_TRANSFER_AREAS];
    for (size_t i = 0; i < pieces->count; ++i) {
        if (pieces->data[i] & LMB_TRANSFER_LEAF) {
            pieces->data[i] = LMB_TRANSFER_LEAF | place[pieces->data[i] & ~LMB_TRANSFER_LEAF];
        }
    }
    free(place);
    areas->count = 0;
    for (uint32_t i = 0; i < b->set.elements; ++i) {
        if (!bake_put_float(areas, i < b->element_count ? bake_open_area(&b->element[i]) : 0.0f, r)) {
            return 0;
        }
    }
    return 1;
}

/* Sets the sides to use: all, or those that an earlier call kept. */
static int set_reached(maker *m, uint32_t all)
{
    bake_words *surfaces = &m->b->section[LMB_TRANSFER_SURFACES];
    const int is_first = surfaces->count == 0;
    m->is_reached = malloc(2 * (size_t)all + 1);
    for (uint32_t i = 0; is_first && i < LMB_TRANSFER_SURFACE_WORDS * all; ++i) {
        if (!bake_put(surfaces, LMB_TRANSFER_NONE, m->r)) {
            return 0;
        }
    }
    for (uint32_t i = 0; m->is_reached != NULL && i < 2 * all; ++i) {
        m->is_reached[i] =
            is_first || surfaces->data[LMB_TRANSFER_SURFACE_WORDS * (i / 2) + i % 2] != LMB_TRANSFER_NONE;
    }
    return m->is_reached != NULL || report_fail(m->r, "not enough memory for %u triangles", (unsigned)all);
}

/* The size of elements of equal area, halved since contacts and rounding need some, m. */
static float smallest_side(const bake *b) { return 0.5f * sqrtf(b->area / (float)b->set.elements); }

/* Makes elements as small as their number allows. */
static int make_small(maker *m)
{
    const lmb_scene *s = m->b->scene;
    const float smallest = smallest_side(m->b);
    const float longest = largest3(sub3(s->bounds_max, s->bounds_min));
    int ok = 1;
    m->side = smallest;
    while (ok && (ok = make(m)) != 0 && m->is_full) {
        m->side *= 1.1f;
        if (m->side > longest && m->b->cut_count > 2) { /* only cuts are left */
            m->side = smallest;
            ok = bake_cuts(m->b, m->r);
        }
    }
    return ok;
}

/* Makes elements. If they become far too large, some are thin; if that is not enough, those at contacts are no longer
 * smaller. */
static int make_closer(maker *m)
{
    m->contact = CONTACT;
    m->b->has_thin = 0; /* a second pass decides again */
    int ok = make_small(m);
    if (!ok || m->side <= LARGE * smallest_side(m->b)) {
        return ok;
    }
    m->b->has_thin = 1;
    ok = make_small(m);
    const float side = m->side;
    if (!ok || side <= STARVED * smallest_side(m->b)) {
        return ok;
    }
    m->contact = 1.0f;
    ok = make_small(m);
    if (ok && m->side > SMALLER * side) {
        m->contact = CONTACT;
        ok = make_small(m);
    }
    return ok;
}

int bake_elements(bake *b, report *r)
{
    maker m;
    memset(&m, 0, sizeof m);
    m.b = b;
    m.r = r;
    m.mask = 4 * b->set.elements - 1;
    m.slot = malloc(20 * ((size_t)m.mask + 1));
    free(b->element);
    b->element = calloc(b->set.elements, sizeof *b->element);
    int ok = (m.slot != NULL && b->element != NULL) ||
             report_fail(r, "not enough memory for %u elements", (unsigned)b->set.elements);
    ok = ok && bake_sight_begin(&m.sight, r) && set_reached(&m, lmb_scene_triangles(b->scene));
    ok = ok && make_closer(&m);
    if (ok && m.had_slivers && b->element_count < b->set.elements / WASTE) { /* or a room would be a few elements */
        m.is_crowded = 1;
        ok = make_small(&m);
    }
    m.contact *= CLOSER; /* light leaks through a thin wall at elements that cross it */
    if (ok && (ok = make(&m)) != 0 && m.is_full) {
        m.contact *= 1.0f / CLOSER;
        ok = make(&m);
    }
    free(m.slot);
    free(m.is_reached);
    bake_sight_end(&m.sight, b);
    return ok && bake_order(b, r);
}
