/* simplify.c: collapses the edge with the least quadric error until few enough triangles are left. */
#include "simplify.h"

#include <string.h>

#include "corner_mesh.h"
#include "edge_heap.h"
#include "enclose.h"
#include "quadric.h"

/* A border edge weighs like a square on it. With 3, 10 or 100 the rims of many small holes take the triangles that
 * the rest needs: a rhino of 800 holes misses 0.46, 0.57, 0.99 % of its pixels instead of 0.40. */
#define BORDER_WEIGHT 1
/* Of a quadric's trace: pulls the point to the edge's middle if the planes leave it free, as on a flat face; too
 * small to move a corner of three planes. */
#define DRAW 1e-6
/* Of the area times the squared edge length: cost of a collapse on a flat face, so that short edges go first. */
#define LENGTH_COST 1e-6
/* Parts of at most this many triangles may vanish. */
#define PART 16

typedef struct simplifier {
    corner_mesh mesh;
    quadric *quadrics;  /* of a vertex: planes of the faces and borders that have come together in it, by area */
    uint32_t *stamps;   /* of a vertex: how often it moved */
    edge_heap heap;
    int around;
    counted_heap memory;
    simplify_facts *facts;
} simplifier;

/* Room for a quarter more edges than there are, so that removing stale entries makes room for many. */
static uint32_t edge_room(const corner_mesh *m, const uint32_t *edges)
{
    uint32_t i, n = 0;
    for (i = 0; i < 3 * m->live; i = corner_mesh_edge_end(m, edges, i))
        ++n;
    return n + n / 4 + 64;
}

/* --- quadrics --- */

static void add_to(simplifier *s, uint32_t v, quadric q) { s->quadrics[v] = quadric_sum(s->quadrics[v], q); }

static void add_faces(simplifier *s)
{
    const corner_mesh *m = &s->mesh;
    uint32_t c;
    for (c = 0; c < m->corner_count; c += 3) {
        dvec n;
        quadric q;
        if (m->vertex[c] == CORNER_NONE)
            continue;
        n = corner_mesh_normal(m, c);
        q = quadric_plane(dvec_unit(n), m->places[m->vertex[c]], dvec_length(n) / 2);
        add_to(s, m->vertex[c], q);
        add_to(s, m->vertex[c + 1], q);
        add_to(s, m->vertex[c + 2], q);
    }
}

/* Out of the surface, across the border that corner c starts. */
static dvec border_normal(const corner_mesh *m, uint32_t c)
{
    const dvec along = dvec_sub(m->places[m->vertex[corner_after(c)]], m->places[m->vertex[c]]);
    return dvec_unit(dvec_cross(along, corner_mesh_normal(m, c)));
}

static void add_borders(simplifier *s, const uint32_t *edges)
{
    const corner_mesh *m = &s->mesh;
    uint32_t i, end;
    for (i = 0; i < 3 * m->live; i = end) {
        const uint32_t a = m->vertex[edges[i]], b = m->vertex[corner_after(edges[i])];
        const dvec along = dvec_sub(m->places[b], m->places[a]);
        quadric q;
        end = corner_mesh_edge_end(m, edges, i);
        if (end - i == 2)
            continue;
        q = quadric_plane(border_normal(m, edges[i]), m->places[a], BORDER_WEIGHT * dvec_dot(along, along));
        add_to(s, a, q);
        add_to(s, b, q);
    }
}

/* --- positions and costs ----------- */

/* Finds the position for the joined vertex, and the error there. A border vertex pulls an inner one to it, because
 * borders must stay. */
static int place_edge(const simplifier *s, uint32_t a, uint32_t b, dvec *at, double *cost)
{
    const corner_mesh *m = &s->mesh;
    const quadric q = quadric_sum(s->quadrics[a], s->quadrics[b]);
    const dvec middle = dvec_mix(m->places[a], m->places[b], 0.5), along = dvec_sub(m->places[b], m->places[a]);
    const double trace = quadric_trace(q);
    if (m->border[a] != m->border[b])
        *at = m->places[m->border[a] ? a : b];
    else if (!(trace > 0) || !quadric_min(at, quadric_drawn(q, middle, DRAW * trace), middle))
        *at = middle;
    *cost = quadric_error(q, *at) + LENGTH_COST * trace * dvec_dot(along, along);
    return *cost < HUGE_VAL;
}

/* --- the heap --- */

static int is_stale(const simplifier *s, const heap_edge *e) { return s->stamps[e->a] + s->stamps[e->b] != e->stamp; }

/* An edge has one entry that is not stale, and edges get fewer: this frees a fifth of the room. */
static void sweep(simplifier *s)
{
    uint32_t i, n = 0;
    for (i = 0; i < s->heap.count; ++i)
        if (!is_stale(s, &s->heap.edges[i]))
            s->heap.edges[n++] = s->heap.edges[i];
    s->heap.count = n;
    edge_heap_order(&s->heap);
}

static void push(simplifier *s, uint32_t a, uint32_t b, double cost)
{
    heap_edge e;
    e.cost = cost;
    e.a = a < b ? a : b;
    e.b = a < b ? b : a;
    e.stamp = s->stamps[a] + s->stamps[b];
    if (s->heap.count == s->heap.cap)
        sweep(s);
    if (s->heap.count < s->heap.cap)
        edge_heap_push(&s->heap, e);
}

static void push_edge(simplifier *s, uint32_t a, uint32_t b)
{
    dvec at;
    double cost;
    if (place_edge(s, a, b, &at, &cost))
        push(s, a, b, cost);
}

/* Adds all existing edges. */
static void fill(simplifier *s, const uint32_t *edges)
{
    const corner_mesh *m = &s->mesh;
    uint32_t i;
    for (i = 0; i < 3 * m->live; i = corner_mesh_edge_end(m, edges, i))
        push_edge(s, m->vertex[edges[i]], m->vertex[corner_after(edges[i])]);
}

/* --- collapse --- */

static void collapse(simplifier *s, uint32_t a, uint32_t b, dvec at)
{
    corner_mesh *m = &s->mesh;
    uint32_t c, k;
    add_to(s, a, s->quadrics[b]);
    corner_mesh_join(m, a, b, at);
    ++s->stamps[a];
    ++s->stamps[b];
    ++s->facts->collapses;
    m->epoch += 2;
    for (c = m->first[a]; c != CORNER_NONE; c = m->next[c])
        for (k = 1; k < 3; ++k) {
            const uint32_t v = m->vertex[k == 1 ? corner_after(c) : corner_before(c)];
            if (m->mark[v] != m->epoch) {
                m->mark[v] = m->epoch;
                push_edge(s, a, v);
            }
        }
}

/* The cost of removing a part: the surface of a part is as far from any other as it is large. */
static double part_cost(const corner_mesh *m, const uint32_t *part, uint32_t n)
{
    double area = 0, across = 0;
    uint32_t i, k;
    for (i = 0; i < n; ++i) {
        area += dvec_length(corner_mesh_normal(m, part[i])) / 2;
        for (k = 0; k < 3; ++k) {
            const dvec d = dvec_sub(m->places[m->vertex[part[i] + k]], m->places[m->vertex[part[0]]]);
            across = dvec_dot(d, d) > across ? dvec_dot(d, d) : across;
        }
    }
    return area * across;
}

/* A small part that cannot collapse is removed when that is the cheapest change; the last part stays. */
static void vanish(simplifier *s, const heap_edge *e)
{
    corner_mesh *m = &s->mesh;
    uint32_t part[PART], n = s->around ? 0 : corner_mesh_part(m, e->a, part, PART), i;
    double cost;
    if (!n || n == m->live)
        return;
    cost = part_cost(m, part, n);
    if (cost > e->cost) {
        push(s, e->a, e->b, cost);
        return;
    }
    for (i = 0; i < n; ++i) {
        uint32_t k;
        for (k = 0; k < 3; ++k)
            ++s->stamps[m->vertex[part[i] + k]];
        corner_mesh_drop(m, part[i]);
    }
    ++s->facts->vanished;
}

static void take(simplifier *s, heap_edge e)
{
    dvec at;
    double cost;
    if (is_stale(s, &e) || !place_edge(s, e.a, e.b, &at, &cost))
        return;
    if (corner_mesh_can_join(&s->mesh, e.a, e.b, at))
        collapse(s, e.a, e.b, at);
    else
        vanish(s, &e);
}

/* --- all of it --- */

/* Returns 0: no memory. */
static int prepare(simplifier *s)
{
    corner_mesh *m = &s->mesh;
    uint32_t *edges = corner_mesh_edges(m, &s->memory);
    int ok;
    s->heap.cap = edges ? edge_room(m, edges) : 0;
    s->heap.edges = counted_alloc(&s->memory, s->heap.cap, sizeof *s->heap.edges);
    s->quadrics = counted_alloc(&s->memory, m->vertex_count, sizeof *s->quadrics);
    s->stamps = counted_alloc(&s->memory, m->vertex_count, sizeof *s->stamps);
    ok = edges && s->heap.edges && s->quadrics && s->stamps;
    if (ok) {
        add_faces(s);
        add_borders(s, edges);
        fill(s, edges);
    }
    counted_free(&s->memory, edges, 3 * (uint64_t)m->live, sizeof *edges);
    return ok;
}

static int reduce(simplifier *s, uint32_t triangles)
{
    if (s->mesh.live <= triangles)
        return 1;
    if (!prepare(s))
        return 0;
    while (s->mesh.live > triangles && s->heap.count)
        take(s, edge_heap_pop(&s->heap));
    return 1;
}

static void release(simplifier *s)
{
    const uint32_t vertices = s->mesh.vertex_count;
    counted_free(&s->memory, s->heap.edges, s->heap.cap, sizeof *s->heap.edges);
    counted_free(&s->memory, s->quadrics, vertices, sizeof *s->quadrics);
    counted_free(&s->memory, s->stamps, vertices, sizeof *s->stamps);
    corner_mesh_free(&s->mesh, &s->memory);
}

/* Keeps the welded input, which the result has to enclose. */
static int keep_inner(simplifier *s, triangle_mesh *inner)
{
    if (!corner_mesh_write(&s->mesh, inner, 0, &s->memory))
        return 0;
    counted_add(&s->memory, (uint64_t)inner->vertex_count * 6 * sizeof(float));
    counted_add(&s->memory, (uint64_t)inner->triangle_count * 3 * sizeof(uint32_t));
    return 1;
}

int simplify_mesh(triangle_mesh *out, const triangle_mesh *in, uint32_t triangles, int around, simplify_facts *facts,
                  report *r)
{
    simplifier s;
    triangle_mesh inner;
    int ok;
    memset(&s, 0, sizeof s);
    memset(&inner, 0, sizeof inner);
    memset(out, 0, sizeof *out);
    memset(facts, 0, sizeof *facts);
    s.facts = facts;
    s.around = around;
    ok = corner_mesh_build(&s.mesh, in, facts, &s.memory, r)
        && (around != SIMPLIFY_AROUND || keep_inner(&s, &inner))
        && reduce(&s, triangles) && corner_mesh_write(&s.mesh, out, in->colours != NULL, &s.memory);
    release(&s);
    if (ok && around == SIMPLIFY_AROUND && facts->collapses)
        ok = mesh_enclose(out, &inner, &facts->outside, &s.memory);
    triangle_mesh_free(&inner);
    facts->memory_bytes = s.memory.highest;
    if (ok)
        return 1;
    triangle_mesh_free(out);
    return report_fail(r, "not enough memory to simplify %u triangles", (unsigned)in->triangle_count);
}
