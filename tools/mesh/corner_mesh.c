/* corner_mesh.c: the triangles that meet at a vertex, and the effect of collapsing an edge. */
#include "corner_mesh.h"

#include <string.h>

/* A collapse may turn a triangle by 78 degrees at most (cosine 0.2), and may not make it a needle. A needle may
 * become half as wide; otherwise the sides of a long thin prism could never lose a triangle. */
#define TURN_COS2   0.04
#define NEEDLE      0.04 /* twice the area over the square of the longest side; 0.87 is equilateral */

static dvec place(const corner_mesh *m, uint32_t c) { return m->places[m->vertex[c]]; }

dvec corner_mesh_normal(const corner_mesh *m, uint32_t c)
{
    return dvec_turn(place(m, c), place(m, corner_after(c)), place(m, corner_before(c)));
}

/* --- edges --- */

static uint32_t end_of(const corner_mesh *m, uint32_t c, int high)
{
    const uint32_t a = m->vertex[c], b = m->vertex[corner_after(c)];
    return (a < b) == high ? b : a;
}

/* One pass of a counting sort, which is stable. `starts`: vertex_count + 1. */
static void sort_edges(const corner_mesh *m, uint32_t *out, const uint32_t *in, uint32_t n, uint32_t *starts, int high)
{
    uint32_t i, v;
    memset(starts, 0, ((size_t)m->vertex_count + 1) * sizeof *starts);
    for (i = 0; i < n; ++i)
        ++starts[end_of(m, in[i], high) + 1];
    for (v = 0; v < m->vertex_count; ++v)
        starts[v + 1] += starts[v];
    for (i = 0; i < n; ++i)
        out[starts[end_of(m, in[i], high)]++] = in[i];
}

uint32_t *corner_mesh_edges(const corner_mesh *m, counted_heap *t)
{
    const uint32_t n = 3 * m->live;
    uint32_t *edges = counted_alloc(t, n, sizeof *edges), *work = counted_alloc(t, n, sizeof *work);
    uint32_t *starts = counted_alloc(t, (uint64_t)m->vertex_count + 1, sizeof *starts);
    uint32_t c, k = 0;
    if (edges && work && starts) {
        for (c = 0; c < m->corner_count; ++c)
            if (m->vertex[c] != CORNER_NONE)
                edges[k++] = c;
        sort_edges(m, work, edges, n, starts, 1);
        sort_edges(m, edges, work, n, starts, 0);
    } else {
        counted_free(t, edges, n, sizeof *edges);
        edges = NULL;
    }
    counted_free(t, work, n, sizeof *work);
    counted_free(t, starts, (uint64_t)m->vertex_count + 1, sizeof *starts);
    return edges;
}

uint32_t corner_mesh_edge_end(const corner_mesh *m, const uint32_t *edges, uint32_t i)
{
    const uint32_t low = end_of(m, edges[i], 0), high = end_of(m, edges[i], 1);
    for (++i; i < 3 * m->live && end_of(m, edges[i], 0) == low && end_of(m, edges[i], 1) == high; ++i)
        continue;
    return i;
}

/* --- lists --- */

static void unlink_corner(corner_mesh *m, uint32_t c)
{
    const uint32_t v = m->vertex[c], next = m->next[c], prior = m->prior[c];
    if (next != CORNER_NONE)
        m->prior[next] = prior;
    if (prior != CORNER_NONE)
        m->next[prior] = next;
    else
        m->first[v] = next;
    --m->valence[v];
    m->vertex[c] = CORNER_NONE;
}

void corner_mesh_drop(corner_mesh *m, uint32_t c)
{
    const uint32_t t = c / 3 * 3;
    unlink_corner(m, t);
    unlink_corner(m, t + 1);
    unlink_corner(m, t + 2);
    --m->live;
}

/* Returns whether vertex v is another corner of the triangle. */
static int touches(const corner_mesh *m, uint32_t c, uint32_t v)
{
    return m->vertex[corner_after(c)] == v || m->vertex[corner_before(c)] == v;
}

/* All corners of b become corners of a. */
static void relabel(corner_mesh *m, uint32_t a, uint32_t b)
{
    uint32_t c, last = CORNER_NONE;
    for (c = m->first[b]; c != CORNER_NONE; c = m->next[c]) {
        m->vertex[c] = a;
        last = c;
    }
    if (last == CORNER_NONE)
        return;
    m->next[last] = m->first[a];
    if (m->first[a] != CORNER_NONE)
        m->prior[m->first[a]] = last;
    m->first[a] = m->first[b];
    m->first[b] = CORNER_NONE;
    m->valence[a] += m->valence[b];
    m->valence[b] = 0;
}

/* Triangles of the edge a b. */
static uint32_t faces_of(const corner_mesh *m, uint32_t a, uint32_t b)
{
    uint32_t c, n = 0;
    for (c = m->first[a]; c != CORNER_NONE; c = m->next[c])
        n += (uint32_t)touches(m, c, b);
    return n;
}

/* A hub of many triangles keeps its flag, because nothing visits all of its triangles. */
static uint8_t has_border(const corner_mesh *m, uint32_t v)
{
    uint32_t c;
    if (m->valence[v] > CORNER_STAR)
        return m->border[v];
    for (c = m->first[v]; c != CORNER_NONE; c = m->next[c])
        if (faces_of(m, v, m->vertex[corner_after(c)]) != 2 || faces_of(m, v, m->vertex[corner_before(c)]) != 2)
            return 1;
    return 0;
}

/* Clears border flags after a border edge collapsed, because the hole may have closed. */
static void mend_borders(corner_mesh *m, uint32_t a)
{
    uint32_t c;
    m->border[a] = has_border(m, a);
    for (c = m->first[a]; c != CORNER_NONE; c = m->next[c]) {
        const uint32_t v = m->vertex[corner_after(c)]; /* around a closed hole each follows a somewhere */
        if (m->border[v])
            m->border[v] = has_border(m, v);
    }
}

static void join_materials(corner_mesh *m, uint32_t a, uint32_t b, dvec at)
{
    const dvec edge = dvec_sub(m->places[b], m->places[a]);
    double s = dvec_dot(dvec_sub(at, m->places[a]), edge) / dvec_dot(edge, edge);
    int k;
    s = s > 0 ? s < 1 ? s : 1 : 0; /* no edge (0 / 0): use a */
    for (k = 0; k < 6; ++k)
        m->looks[a][k] = (float)((1 - s) * (double)m->looks[a][k] + s * (double)m->looks[b][k]);
}

void corner_mesh_join(corner_mesh *m, uint32_t a, uint32_t b, dvec at)
{
    uint32_t c, next;
    for (c = m->first[b]; c != CORNER_NONE; c = next) {
        next = m->next[c];
        if (touches(m, c, a))
            corner_mesh_drop(m, c);
    }
    relabel(m, a, b);
    join_materials(m, a, b, at);
    m->places[a] = at;
    m->border[a] |= m->border[b];
    if (m->border[a])
        mend_borders(m, a);
}

/* --- guards --- */

/* Marks the vertices around a but b with the epoch, and those that face the edge a b with one more. */
static void mark_around(corner_mesh *m, uint32_t a, uint32_t b)
{
    uint32_t c;
    m->epoch += 2;
    for (c = m->first[a]; c != CORNER_NONE; c = m->next[c]) {
        m->mark[m->vertex[corner_after(c)]] = m->epoch;
        m->mark[m->vertex[corner_before(c)]] = m->epoch;
    }
    m->mark[b] = 0;
    for (c = m->first[a]; c != CORNER_NONE; c = m->next[c])
        if (touches(m, c, b))
            m->mark[m->vertex[m->vertex[corner_after(c)] == b ? corner_before(c) : corner_after(c)]] = m->epoch + 1;
}

/* Returns whether removing the faces of edge a b would leave a third vertex without triangles, or with two back to
 * back. */
static int strands(const corner_mesh *m, uint32_t c, uint32_t a)
{
    const uint32_t v = m->vertex[m->vertex[corner_after(c)] == a ? corner_before(c) : corner_after(c)];
    return m->valence[v] <= (m->border[v] ? 1u : 3u);
}

/* v is a neighbour of a and b, but in none of the triangles at their edge. Returns whether joining a and b closes
 * the three-sided hole a b v. If their edges have more faces, it would pinch off the surface inside the ring a b v. */
static int is_hole(const corner_mesh *m, uint32_t a, uint32_t b, uint32_t v)
{
    return faces_of(m, a, b) == 1 && faces_of(m, a, v) == 1 && faces_of(m, b, v) == 1;
}

static int links_agree(corner_mesh *m, uint32_t a, uint32_t b)
{
    const uint32_t faces = faces_of(m, a, b);
    uint32_t c;
    int k;
    if (faces == 2 && m->border[a] && m->border[b])
        return 0;
    mark_around(m, a, b);
    for (c = m->first[b]; c != CORNER_NONE; c = m->next[c]) {
        for (k = 0; k < 2; ++k) {
            const uint32_t v = m->vertex[k ? corner_after(c) : corner_before(c)];
            if (m->mark[v] == m->epoch && !is_hole(m, a, b, v))
                return 0;
        }
        if (touches(m, c, a) && strands(m, c, a))
            return 0;
    }
    return 1;
}

static double larger(double a, double b) { return a > b ? a : b; }

static double longest_side2(dvec a, dvec b, dvec c)
{
    const dvec ab = dvec_sub(b, a), bc = dvec_sub(c, b), ca = dvec_sub(a, c);
    return larger(dvec_dot(ab, ab), larger(dvec_dot(bc, bc), dvec_dot(ca, ca)));
}

/* Returns whether the triangle of corner c keeps its orientation when the corner moves. A triangle without area has
 * none to lose. */
static int survives(const corner_mesh *m, uint32_t c, dvec at)
{
    const dvec p = place(m, c), q = place(m, corner_after(c)), r = place(m, corner_before(c));
    const dvec before = dvec_turn(p, q, r), after = dvec_turn(at, q, r);
    const double b2 = dvec_dot(before, before), a2 = dvec_dot(after, after), both = dvec_dot(before, after);
    const double side_b = longest_side2(p, q, r), side_a = longest_side2(at, q, r);
    if (b2 > 0 && !(both > 0 && both * both > TURN_COS2 * b2 * a2))
        return 0;
    return a2 > 0 && (a2 > NEEDLE * NEEDLE * side_a * side_a || 4 * a2 * side_b * side_b >= b2 * side_a * side_a);
}

static int all_survive(const corner_mesh *m, uint32_t a, uint32_t without, dvec at)
{
    uint32_t c;
    for (c = m->first[a]; c != CORNER_NONE; c = m->next[c])
        if (!touches(m, c, without) && !survives(m, c, at))
            return 0;
    return 1;
}

int corner_mesh_can_join(corner_mesh *m, uint32_t a, uint32_t b, dvec at)
{
    return m->valence[a] + m->valence[b] <= CORNER_STAR && links_agree(m, a, b) && all_survive(m, a, b, at)
        && all_survive(m, b, a, at);
}

/* --- parts --- */

static uint32_t add_triangles(const corner_mesh *m, uint32_t v, uint32_t *part, uint32_t n, uint32_t cap)
{
    uint32_t c, i;
    for (c = m->first[v]; c != CORNER_NONE; c = m->next[c]) {
        for (i = 0; i < n && part[i] != c / 3 * 3; ++i)
            continue;
        if (i == cap)
            return cap + 1;
        if (i == n)
            part[n++] = c / 3 * 3;
    }
    return n;
}

uint32_t corner_mesh_part(const corner_mesh *m, uint32_t v, uint32_t *part, uint32_t cap)
{
    uint32_t n = add_triangles(m, v, part, 0, cap), i, k;
    for (i = 0; i < n && n <= cap; ++i)
        for (k = 0; k < 3 && n <= cap; ++k)
            n = add_triangles(m, m->vertex[part[i] + k], part, n, cap);
    return n <= cap ? n : 0;
}
