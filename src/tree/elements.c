/* elements.c: a scene's triangles -> elements of about one size, with neighbours adjacent in memory. Layer 6. */
#include <lambent/elements.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../base/poly.h"
#include "tree.h"
#include "piece.h"

#if LMB_TREES

enum {
    MAX_TRIANGLE_HALVINGS = 32, /* max halvings of a triangle at the longest edge: 2^31 pieces; 2^24 is the limit */
    MAX_CELLS_A_SIDE = 1 << 20,
    MAX_PIECES = 64 /* per element: also ends the division of pieces without area, or all hole */
};

/* --- memory ------------------------------------------------------------------------------------------------------- */

/* Texels along a side; 0 if n is not a power of 4 within bounds. */
static int32_t side_of_cells(uint32_t n)
{
    int32_t side = LMB_TILE;
    while (side < 4096 && (uint32_t)side * (uint32_t)side < n) {
        side *= 2;
    }
    return (uint32_t)side * (uint32_t)side == n ? side : 0;
}

size_t lmb_elements_bytes(uint32_t n)
{
    const size_t tree = side_of_cells(n) > 0 ? lmb_tree_bytes(1, side_of_cells(n)) : 0;
    return tree == 0 || n > ((size_t)-1 - tree) / sizeof(lmb_element) ? 0 : tree + n * sizeof(lmb_element);
}

lmb_status lmb_elements_init(lmb_elements *out, uint32_t n, void *memory, size_t bytes)
{
    const size_t needed = lmb_elements_bytes(n);
    const lmb_status status = check_array(out, memory, bytes, needed);
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->data = (lmb_element *)memory;
    out->cap = n;
    return lmb_tree_init(&out->tree, 1, side_of_cells(n), out->data + n, bytes - n * sizeof(lmb_element));
}

/* --- pieces -> elements ------------------------------------------------------------------------------------------- */

/* Small triangles find their element by grid cell, in a hash table with twice as many slots as elements. The table uses
 * the memory in which the tree's nodes are built later. */
typedef struct element_maker {
    lmb_elements *out;
    const lmb_scene *scene;
    uint32_t *slot; /* index of an element + 1, or 0 */
    uint32_t mask;
    uint32_t pieces; /* of divided triangles */
    float side2;     /* in the core */
    float per;       /* 1 / the core's size; 0: no core */
    int full;
} element_maker;

/* Cells then have at most 10 sizes, and six sides of each fit in the fewest elements, 64. */
#define MAX_COARSENESS 511.0f

/* Side of a piece's elements over that in the core: 1 in the core, 2 at the core's size from it. A ground or a terrain
 * around an object would take nearly all elements otherwise. */
static float coarseness(const element_maker *m, const lmb_vec3 p[3])
{
    const lmb_core *c = &m->scene->core;
    const lmb_vec3 low = min3(min3(p[0], p[1]), p[2]), high = max3(max3(p[0], p[1]), p[2]);
    const float away = length3(max3(max3(sub3(c->low, high), sub3(low, c->high)), vec3(0, 0, 0)));
    return 1.0f + minf(m->per * away, MAX_COARSENESS);
}

/* Elements are sorted by facing side: key / 2^27 is the side. */
static uint32_t element_facing(const lmb_element *e) { return e->key >> (3 * PIECE_Z_BITS); }

static int32_t cell_along(float at, float low, float per_cell)
{
    return (int32_t)clampf((at - low) * per_cell, 0.0f, (float)(MAX_CELLS_A_SIDE - 1));
}

typedef struct element_cell {
    int32_t x, y, z;
    float per; /* cells in a metre */
} element_cell;

/* The box that contains nearly all of the scene. Outliers are clamped to the box, so that they do not take cells from
 * the rest. */
static lmb_vec3 low_of(const lmb_scene *s) { return s->core.faces > 0 ? s->core.wide_low : s->bounds_min; }
static lmb_vec3 high_corner(const lmb_scene *s) { return s->core.faces > 0 ? s->core.wide_high : s->bounds_max; }

/* Cells double in size as the elements do. */
static element_cell cell_of_piece(const element_maker *m, const lmb_vec3 corner[3])
{
    const lmb_vec3 p = piece_middle(corner), low = low_of(m->scene);
    element_cell c;
    c.per = 2.0f / sqrtf(m->side2);
    for (float times = coarseness(m, corner); times >= 2.0f; times *= 0.5f) {
        c.per *= 0.5f;
    }
    c.x = cell_along(p.x, low.x, c.per);
    c.y = cell_along(p.y, low.y, c.per);
    c.z = cell_along(p.z, low.z, c.per);
    return c;
}

/* The slot of the element with e's cell and side, or the empty slot for it. */
static uint32_t *find_slot(const element_maker *m, const lmb_element *e)
{
    const element_cell c = cell_of_piece(m, e->corner);
    uint32_t h = (uint32_t)c.x * 73856093u ^ (uint32_t)c.y * 19349663u ^ (uint32_t)c.z * 83492791u ^
                 element_facing(e) * 2654435761u;
    h ^= h >> 15;
    for (;; ++h) {
        uint32_t *slot = &m->slot[h & m->mask];
        if (*slot == 0) {
            return slot;
        }
        const lmb_element *other = &m->out->data[*slot - 1];
        const element_cell o = cell_of_piece(m, other->corner);
        if (o.x == c.x && o.y == c.y && o.z == c.z && o.per == c.per && element_facing(other) == element_facing(e)) {
            return slot;
        }
    }
}

static lmb_element *append(element_maker *m, const lmb_element *e)
{
    if (m->out->count == m->out->cap) {
        m->full = 1;
        return NULL;
    }
    m->out->data[m->out->count] = *e;
    return &m->out->data[m->out->count++];
}

/* received[0] temporarily holds the area of the largest triangle. */
static void join_elements(lmb_element *into, const lmb_element *e)
{
    const float area = into->area + e->area, share = e->area / area;
    for (int c = 0; c < 3; ++c) {
        into->albedo[c] += (e->albedo[c] - into->albedo[c]) * share;
        into->emission[c] += (e->emission[c] - into->emission[c]) * share;
    }
    if (e->area > into->received[0]) {
        memcpy(into->corner, e->corner, sizeof into->corner);
        memcpy(into->fresh, e->fresh, sizeof into->fresh);
        into->id = e->id;
        into->received[0] = e->area;
    }
    into->area = area;
    into->reach2 = 0.0f;
}

static void add_element(element_maker *m, const lmb_element *e, int small)
{
    uint32_t *slot = small ? find_slot(m, e) : NULL;
    if (slot != NULL && *slot != 0) {
        join_elements(&m->out->data[*slot - 1], e);
    } else if (append(m, e) != NULL && slot != NULL) {
        *slot = m->out->count;
    }
}

/* Adds both sides of a piece. `fresh` temporarily holds the normal. */
static void add_piece(element_maker *m, const piece_source *s, const surface_piece *p, int small)
{
    const lmb_material *material = s->triangle.material;
    const lmb_vec3 at = piece_middle(p->corner);
    const float area = 0.5f * length3(piece_across(p->corner));
    lmb_element e;
    memset(&e, 0, sizeof e);
    memcpy(e.corner, p->corner, sizeof e.corner);
    e.area = area * lmb_source_albedo(e.albedo, s, p, area / s->area);
    if (!(e.area > 0.0f)) {
        return;
    }
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 d = sub3(p->corner[k], at);
        e.reach2 = maxf(e.reach2, dot3(d, d));
    }
    e.reach2 = e.area < area ? 0.0f : e.reach2; /* an element with holes has no shape */
    lmb_source_emission(e.emission, s, p);
    e.received[0] = e.area;
    e.id = s->triangle.id;
    for (int back = 0; back <= ((material->flags & LMB_DOUBLE_SIDED) != 0); ++back) {
        const lmb_vec3 n = mul3(s->normal, back ? -1.0f : 1.0f);
        e.fresh[0] = n.x;
        e.fresh[1] = n.y;
        e.fresh[2] = n.z;
        e.key = side_of3(n) << (3 * PIECE_Z_BITS);
        add_element(m, &e, small);
    }
}

/* --- cutting ------------------------------------------------------------------------------------------------------ */

/* Squared length of the longest edge, which runs from corner *from to the next. */
static float longest_edge(int *from, const surface_piece *p)
{
    float longest = -1.0f;
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 d = sub3(p->corner[(k + 1) % 3], p->corner[k]);
        if (dot3(d, d) > longest) {
            longest = dot3(d, d);
            *from = k;
        }
    }
    return longest;
}

/* A halving on the path to a piece: the edge's corner outside the piece, and the half that contains the piece. */
typedef struct turn {
    lmb_vec3 corner;
    float b1, b2;
    int from, first;
} turn;

/* Exchanges corner k of the piece with the stored corner. */
static void swap_corner(surface_piece *p, turn *t, int k)
{
    const turn kept = *t;
    t->corner = p->corner[k];
    t->b1 = p->b1[k];
    t->b2 = p->b2[k];
    p->corner[k] = kept.corner;
    p->b1[k] = kept.b1;
    p->b2[k] = kept.b2;
}

/* Enters the half after the middle of the edge from `from`. */
static void enter_second(surface_piece *p, turn *t, int from)
{
    const int to = (from + 1) % 3;
    t->corner = add3(p->corner[from], mul3(sub3(p->corner[to], p->corner[from]), 0.5f));
    t->b1 = 0.5f * (p->b1[from] + p->b1[to]);
    t->b2 = 0.5f * (p->b2[from] + p->b2[to]);
    t->from = from;
    t->first = 0;
    swap_corner(p, t, from);
}

/* Moves from the second half to the first. Returns 0 if the first is done too, and the piece is whole again. */
static int enter_first(surface_piece *p, turn *t)
{
    const int done = t->first, to = (t->from + 1) % 3;
    if (!done) {
        swap_corner(p, t, t->from); /* t now holds the middle */
    }
    swap_corner(p, t, to);
    t->first = 1;
    return !done;
}

/* Squared length of the longest edge that elements have at a piece. */
static float side2_at(const element_maker *m, const surface_piece *p)
{
    const float times = coarseness(m, p->corner);
    return m->side2 * (times * times);
}

/* Stores turns instead of pending pieces: 28 bytes of stack per halving instead of 60. */
static void add_source(element_maker *m, const piece_source *s)
{
    turn turns[MAX_TRIANGLE_HALVINGS];
    surface_piece p = {{{0, 0, 0}}, {0, 1, 0}, {0, 0, 1}};
    int depth = 0, from = 0;
    memcpy(p.corner, s->triangle.corner, sizeof p.corner);
    if (longest_edge(&from, &p) * 4.0f < side2_at(m, &p)) {
        add_piece(m, s, &p, 1);
        return;
    }
    do {
        while (depth < MAX_TRIANGLE_HALVINGS && longest_edge(&from, &p) > side2_at(m, &p)) {
            enter_second(&p, &turns[depth++], from);
        }
        add_piece(m, s, &p, 0);
        m->full |= ++m->pieces > MAX_PIECES * m->out->cap;
        while (depth > 0 && !enter_first(&p, &turns[depth - 1])) {
            --depth;
        }
    } while (depth > 0 && !m->full);
}

/* Returns 1 if everything fits. */
static int make(element_maker *m)
{
    const uint32_t all = lmb_scene_triangles(m->scene);
    piece_source s;
    m->full = 0;
    m->pieces = 0;
    m->out->count = 0;
    memset(m->slot, 0, ((size_t)m->mask + 1) * sizeof *m->slot);
    for (uint32_t id = 1; id <= all && !m->full; ++id) {
        if (lmb_source_open(&s, m->scene, id)) {
            add_source(m, &s);
        }
    }
    return !m->full;
}

static float scene_area(const lmb_scene *scene)
{
    const uint32_t all = lmb_scene_triangles(scene);
    double area = 0.0;
    piece_source s;
    for (uint32_t id = 1; id <= all; ++id) {
        if (lmb_source_open(&s, scene, id)) {
            area += (double)s.area * (s.triangle.material->flags & LMB_DOUBLE_SIDED ? 2.0 : 1.0);
        }
    }
    return (float)area;
}

/* --- order -------------------------------------------------------------------------------------------------------- */

static void set_key(lmb_element *e, const lmb_scene *scene, float per)
{
    e->key |= piece_place(piece_middle(e->corner), low_of(scene), per);
}

static void sift(lmb_element *data, uint32_t at, uint32_t count)
{
    const lmb_element e = data[at];
    for (uint32_t child = 2 * at + 1; child < count; child = 2 * at + 1) {
        child += child + 1 < count && data[child + 1].key > data[child].key;
        if (data[child].key <= e.key) {
            break;
        }
        data[at] = data[child];
        at = child;
    }
    data[at] = e;
}

/* Heapsort, which needs no extra memory. */
static void sort(lmb_element *data, uint32_t count)
{
    for (uint32_t i = count / 2; i > 0; --i) {
        sift(data, i - 1, count);
    }
    for (uint32_t last = count; last > 1; --last) {
        const lmb_element largest = data[0];
        data[0] = data[last - 1];
        data[last - 1] = largest;
        sift(data, 0, last - 1);
    }
}

static void put_in_order(lmb_elements *e, const lmb_scene *scene)
{
    const lmb_vec3 size = sub3(high_corner(scene), low_of(scene));
    const float longest = largest3(size), per = longest > 0.0f ? (float)(1 << PIECE_Z_BITS) / longest : 0.0f;
    for (uint32_t i = 0; i < e->count; ++i) {
        set_key(&e->data[i], scene, per);
    }
    sort(e->data, e->count);
}

/* --- the tree ----------------------------------------------------------------------------------------------------- */

static void set_texels_of_tree(lmb_elements *e)
{
    memset(e->tree.texel, 0, (size_t)e->cap * sizeof *e->tree.texel);
    for (uint32_t i = 0; i < e->count; ++i) {
        lmb_element *from = &e->data[i];
        lmb_texel *t = &e->tree.texel[tree_along_z(&e->tree, i)];
        t->position = piece_middle(from->corner);
        t->normal = vec3(from->fresh[0], from->fresh[1], from->fresh[2]);
        for (int c = 0; c < 3; ++c) {
            t->flux[c] = flux_or_none(LMB_PI * from->area * from->emission[c]);
            from->received[c] = from->fresh[c] = 0.0f;
        }
    }
}

static void set_level(lmb_elements *e, const lmb_tree *lights)
{
    double flux = (double)flux_sum(tree_level(&e->tree, 0, tree_root_level(&e->tree))->flux), area = 0.0;
    for (uint32_t f = 0; lights != NULL && f < lights->faces; ++f) {
        flux += (double)flux_sum(tree_level(lights, f, tree_root_level(lights))->flux);
    }
    for (uint32_t i = 0; i < e->count; ++i) {
        area += (double)e->data[i].area;
    }
    e->level = area > 0.0 ? (float)(flux / area) : 0.0f;
}

lmb_status lmb_elements_build(lmb_elements *inout, const lmb_scene *scene, const lmb_tree *lights)
{
    element_maker m;
    if (inout == NULL || inout->data == NULL || scene == NULL) {
        return LMB_ERR_ARG;
    }
    m.out = inout;
    m.scene = scene;
    m.per = scene->core.faces > 0 ? 1.0f / maxf(largest3(sub3(scene->core.high, scene->core.low)), 1e-12f) : 0.0f;
    m.slot = (uint32_t *)(void *)inout->tree.node;
    m.mask = 2 * inout->cap - 1;
    /* A piece's area is at most half of side^2, so the first trial is either much too fine or consists of small
     * triangles only. */
    m.side2 = maxf(scene_area(scene) / (float)inout->cap, 1e-24f);
    while (!make(&m)) {
        m.side2 *= inout->count == inout->cap ? 2.0f : 16.0f;
    }
    inout->side = sqrtf(m.side2);
    put_in_order(inout, scene);
    set_texels_of_tree(inout);
    inout->tree.element = inout->data;
    inout->tree.faces = 1;
    lmb_tree_sum(&inout->tree, 0);
    set_level(inout, lights);
    return LMB_OK;
}

#endif
