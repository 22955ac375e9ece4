/* corner_mesh_io.c: a corner mesh from an indexed one, and back. */
#include "corner_mesh.h"

#include <string.h>

static int is_finite3(const float *p)
{
    int k;
    for (k = 0; k < 3; ++k)
        if (!(p[k] - p[k] == 0))
            return 0;
    return 1;
}

/* --- welding --- */

static uint32_t hash3(const float *p)
{
    uint32_t h = 0;
    int k;
    for (k = 0; k < 3; ++k) {
        const float v = p[k] + 0.0f; /* -0 is 0 */
        uint32_t bits;
        memcpy(&bits, &v, sizeof bits);
        h = (h ^ bits) * 0x9E3779B1u;
        h ^= h >> 15;
    }
    return h;
}

static int same_place(const float *p, const float *q) { return p[0] == q[0] && p[1] == q[1] && p[2] == q[2]; }

static uint32_t table_size(uint32_t n)
{
    uint32_t size = 16;
    while (size < n + n / 2)
        size *= 2;
    return size;
}

/* The slot of a vertex position in a table of vertex numbers: free, or holds the first vertex there. */
static uint32_t slot_of(const uint32_t *table, uint32_t size, const float *positions, uint32_t v)
{
    const float *p = positions + 3 * (size_t)v;
    uint32_t slot = hash3(p) & (size - 1);
    while (table[slot] != CORNER_NONE && !same_place(p, positions + 3 * (size_t)table[slot]))
        slot = (slot + 1) & (size - 1);
    return slot;
}

/* same[v]: the index of v's position, in the order of first vertices; CORNER_NONE: not finite. */
static int weld(uint32_t *same, uint32_t *count, const triangle_mesh *in, simplify_facts *facts, counted_heap *t)
{
    const uint32_t size = table_size(in->vertex_count);
    uint32_t *table = counted_alloc(t, size, sizeof *table), v;
    *count = 0;
    if (!table)
        return 0;
    memset(table, 0xFF, (size_t)size * sizeof *table);
    for (v = 0; v < in->vertex_count; ++v) {
        uint32_t slot;
        same[v] = CORNER_NONE;
        if (!is_finite3(in->positions + 3 * (size_t)v))
            continue;
        slot = slot_of(table, size, in->positions, v);
        if (table[slot] == CORNER_NONE) {
            table[slot] = v;
            same[v] = (*count)++;
        } else {
            same[v] = same[table[slot]];
            ++facts->welded;
        }
    }
    counted_free(t, table, size, sizeof *table);
    return 1;
}

/* --- in --- */

static int take_all(corner_mesh *m, uint32_t vertices, uint32_t corners, counted_heap *t)
{
    m->vertex_count = vertices;
    m->corner_count = corners;
    m->places = counted_alloc(t, vertices, sizeof *m->places);
    m->looks = counted_alloc(t, vertices, sizeof *m->looks);
    m->first = counted_alloc(t, vertices, sizeof *m->first);
    m->valence = counted_alloc(t, vertices, sizeof *m->valence);
    m->mark = counted_alloc(t, vertices, sizeof *m->mark);
    m->border = counted_alloc(t, vertices, sizeof *m->border);
    m->vertex = counted_alloc(t, corners, sizeof *m->vertex);
    m->next = counted_alloc(t, corners, sizeof *m->next);
    m->prior = counted_alloc(t, corners, sizeof *m->prior);
    return m->places && m->looks && m->first && m->valence && m->mark && m->border && m->vertex && m->next && m->prior;
}

void corner_mesh_free(corner_mesh *m, counted_heap *t)
{
    counted_free(t, m->places, m->vertex_count, sizeof *m->places);
    counted_free(t, m->looks, m->vertex_count, sizeof *m->looks);
    counted_free(t, m->first, m->vertex_count, sizeof *m->first);
    counted_free(t, m->valence, m->vertex_count, sizeof *m->valence);
    counted_free(t, m->mark, m->vertex_count, sizeof *m->mark);
    counted_free(t, m->border, m->vertex_count, sizeof *m->border);
    counted_free(t, m->vertex, m->corner_count, sizeof *m->vertex);
    counted_free(t, m->next, m->corner_count, sizeof *m->next);
    counted_free(t, m->prior, m->corner_count, sizeof *m->prior);
    memset(m, 0, sizeof *m);
}

/* Reads positions, and sums of the normals and colours of the vertices there. */
static void read_vertices(corner_mesh *m, const triangle_mesh *in, const uint32_t *same)
{
    uint32_t v;
    int k;
    for (v = 0; v < in->vertex_count; ++v) {
        const size_t at = 3 * (size_t)v;
        float *look;
        if (same[v] == CORNER_NONE)
            continue;
        m->places[same[v]] = dvec_read(in->positions + at);
        look = m->looks[same[v]];
        for (k = 0; k < 3 && in->normals && is_finite3(in->normals + at); ++k)
            look[k] += in->normals[at + (size_t)k];
        for (k = 0; k < 3 && in->colours && is_finite3(in->colours + at); ++k)
            look[3 + k] += in->colours[at + (size_t)k];
    }
}

static void link_corner(corner_mesh *m, uint32_t c, uint32_t v)
{
    m->vertex[c] = v;
    m->prior[c] = CORNER_NONE;
    m->next[c] = m->first[v];
    if (m->first[v] != CORNER_NONE)
        m->prior[m->first[v]] = c;
    m->first[v] = c;
    ++m->valence[v];
}

static int read_triangles(corner_mesh *m, const triangle_mesh *in, const uint32_t *same, report *r)
{
    uint32_t c;
    memset(m->first, 0xFF, (size_t)m->vertex_count * sizeof *m->first);
    memset(m->vertex, 0xFF, (size_t)m->corner_count * sizeof *m->vertex);
    for (c = 0; c < m->corner_count; c += 3) {
        uint32_t v[3];
        int k;
        for (k = 0; k < 3; ++k) {
            const uint32_t index = in->indices[c + (uint32_t)k];
            if (index >= in->vertex_count)
                return report_fail(r, "triangle %u has vertex %u of %u", (unsigned)(c / 3), (unsigned)index,
                                   (unsigned)in->vertex_count);
            v[k] = same[index];
        }
        if (v[0] == CORNER_NONE || v[1] == CORNER_NONE || v[2] == CORNER_NONE || v[0] == v[1] || v[1] == v[2]
            || v[2] == v[0])
            continue;
        for (k = 0; k < 3; ++k)
            link_corner(m, c + (uint32_t)k, v[k]);
        ++m->live;
    }
    return 1;
}

static void find_borders(corner_mesh *m, const uint32_t *edges)
{
    uint32_t i, end;
    for (i = 0; i < 3 * m->live; i = end) {
        end = corner_mesh_edge_end(m, edges, i);
        if (end - i != 2)
            m->border[m->vertex[edges[i]]] = m->border[m->vertex[corner_after(edges[i])]] = 1;
    }
}

/* Vertices at one position get the mean of their normals and colours; without normals, that of the faces by area. */
static void finish_materials(corner_mesh *m, const triangle_mesh *in, const uint32_t *same, float *shares)
{
    uint32_t v, c;
    for (v = 0; v < in->vertex_count; ++v)
        if (same[v] != CORNER_NONE)
            shares[same[v]] += 1.0f;
    for (v = 0; v < m->vertex_count; ++v) {
        dvec n = dvec_read(m->looks[v]);
        int k;
        for (c = m->first[v]; c != CORNER_NONE && !in->normals; c = m->next[c])
            n = dvec_add(n, corner_mesh_normal(m, c));
        dvec_write(m->looks[v], dvec_unit(n));
        for (k = 3; k < 6; ++k)
            m->looks[v][k] /= shares[v];
    }
}

static int build_welded(corner_mesh *m, const triangle_mesh *in, uint32_t *same, simplify_facts *facts, counted_heap *t,
                        report *r)
{
    uint32_t count, *edges = NULL;
    float *shares = NULL;
    int ok = weld(same, &count, in, facts, t) && take_all(m, count, 3 * in->triangle_count, t)
        && (shares = counted_alloc(t, count, sizeof *shares)) != NULL;
    if (ok) {
        read_vertices(m, in, same);
        ok = read_triangles(m, in, same, r) && (edges = corner_mesh_edges(m, t)) != NULL;
    }
    if (ok) {
        find_borders(m, edges);
        finish_materials(m, in, same, shares);
    }
    counted_free(t, edges, 3 * (uint64_t)m->live, sizeof *edges);
    counted_free(t, shares, count, sizeof *shares);
    return ok;
}

int corner_mesh_build(corner_mesh *m, const triangle_mesh *in, simplify_facts *facts, counted_heap *t, report *r)
{
    uint32_t *same = NULL;
    int ok;
    memset(m, 0, sizeof *m);
    if (in->triangle_count >= (UINT32_C(1) << 28) || in->vertex_count >= (UINT32_C(1) << 30))
        return report_fail(r, "%u triangles of %u vertices are too many to simplify", (unsigned)in->triangle_count,
                           (unsigned)in->vertex_count);
    same = counted_alloc(t, in->vertex_count, sizeof *same);
    ok = same && build_welded(m, in, same, facts, t, r);
    counted_free(t, same, in->vertex_count, sizeof *same);
    facts->dropped = in->triangle_count - m->live;
    return ok ? 1 : report_fail(r, "not enough memory to simplify %u triangles", (unsigned)in->triangle_count);
}

/* --- out --- */

static void write_vertex(const corner_mesh *m, triangle_mesh *out, uint32_t v, uint32_t to)
{
    const size_t at = 3 * (size_t)to;
    dvec_write(out->positions + at, m->places[v]);
    dvec_write(out->normals + at, dvec_unit(dvec_read(m->looks[v])));
    if (out->colours)
        memcpy(out->colours + at, m->looks[v] + 3, 3 * sizeof(float));
}

static int take_out(triangle_mesh *out, uint32_t vertices, uint32_t triangles, int colours)
{
    const size_t v = vertices ? vertices : 1, n = triangles ? triangles : 1;
    out->positions = malloc(v * 3 * sizeof(float));
    out->normals = malloc(v * 3 * sizeof(float));
    out->colours = colours ? malloc(v * 3 * sizeof(float)) : NULL;
    out->indices = malloc(n * 3 * sizeof(uint32_t));
    return out->positions && out->normals && (out->colours || !colours) && out->indices;
}

int corner_mesh_write(const corner_mesh *m, triangle_mesh *out, int colours, counted_heap *t)
{
    uint32_t *to = counted_alloc(t, m->vertex_count, sizeof *to), v, c, n = 0;
    int ok;
    for (v = 0; v < m->vertex_count && to; ++v)
        to[v] = m->first[v] != CORNER_NONE ? n++ : CORNER_NONE;
    ok = to && take_out(out, n, m->live, colours);
    for (v = 0; v < m->vertex_count && ok; ++v)
        if (to[v] != CORNER_NONE)
            write_vertex(m, out, v, to[v]);
    out->vertex_count = n;
    out->triangle_count = 0;
    for (c = 0; c < m->corner_count && ok; ++c)
        if (m->vertex[c] != CORNER_NONE) {
            out->indices[3 * (size_t)out->triangle_count + c % 3] = to[m->vertex[c]];
            out->triangle_count += c % 3 == 2;
        }
    counted_free(t, to, m->vertex_count, sizeof *to);
    return ok;
}

void triangle_mesh_free(triangle_mesh *m)
{
    free(m->positions);
    free(m->normals);
    free(m->colours);
    free(m->indices);
    memset(m, 0, sizeof *m);
}
