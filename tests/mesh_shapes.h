/* mesh_shapes.h: cubes, balls, rings and fields of triangles, and what tests ask of a mesh. */
#ifndef MESH_SHAPES_H
#define MESH_SHAPES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../tools/common/dvec.h"
#include "../tools/mesh/simplify.h"
#include "test.h"

/* --- meshes --- */

static inline triangle_mesh room_for(uint32_t vertices, uint32_t triangles)
{
    triangle_mesh m;
    memset(&m, 0, sizeof m);
    m.positions = malloc(vertices * 3 * sizeof(float));
    m.indices = malloc(triangles * 3 * sizeof(uint32_t));
    return m;
}

static inline void add_vertex(triangle_mesh *m, float x, float y, float z)
{
    float *p = m->positions + 3 * (size_t)m->vertex_count++;
    p[0] = x;
    p[1] = y;
    p[2] = z;
}

static inline void add_triangle(triangle_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *v = m->indices + 3 * (size_t)m->triangle_count++;
    v[0] = a;
    v[1] = b;
    v[2] = c;
}

/* n x n squares of (n + 1)^2 vertices from number `from` on, row by row. */
static inline void add_squares(triangle_mesh *m, uint32_t from, uint32_t n)
{
    uint32_t i, k;
    for (k = 0; k < n; ++k)
        for (i = 0; i < n; ++i) {
            const uint32_t a = from + k * (n + 1) + i, b = a + n + 1;
            add_triangle(m, a, a + 1, b + 1);
            add_triangle(m, a, b + 1, b);
        }
}

/* Two metres wide, n squares an edge; each face has its own vertices. */
static inline triangle_mesh cube(uint32_t n)
{
    triangle_mesh m = room_for(6 * (n + 1) * (n + 1), 12 * n * n);
    uint32_t face, i, k;
    for (face = 0; face < 6; ++face) {
        const uint32_t from = m.vertex_count, axis = face % 3;
        const float side = face < 3 ? 1.0f : -1.0f, wide = (float)n;
        for (k = 0; k <= n; ++k)
            for (i = 0; i <= n; ++i) {
                float p[3];
                p[axis] = side;
                p[(axis + 1) % 3] = side * (2.0f * (float)i - wide) / wide;
                p[(axis + 2) % 3] = (2.0f * (float)k - wide) / wide;
                add_vertex(&m, p[0], p[1], p[2]);
            }
        add_squares(&m, from, n);
    }
    return m;
}

/* Of radius 1: a cube pushed out. Nothing but + * / sqrt, so that it is the same everywhere. */
static inline triangle_mesh sphere(uint32_t n)
{
    triangle_mesh m = cube(n);
    uint32_t v;
    for (v = 0; v < m.vertex_count; ++v) {
        float *p = m.positions + 3 * v;
        const double length = dvec_length(dvec_read(p));
        int k;
        for (k = 0; k < 3; ++k)
            p[k] = (float)((double)p[k] / length);
    }
    return m;
}

/* The sphere with dents and bumps of a tenth. */
static inline triangle_mesh potato(uint32_t n)
{
    triangle_mesh m = sphere(n);
    uint32_t v;
    for (v = 0; v < m.vertex_count; ++v) {
        float *f = m.positions + 3 * v;
        const dvec p = dvec_read(f), q = dvec_mul(p, 1 + 0.4 * p.x * p.y - 0.3 * p.z * p.z * p.x);
        f[0] = (float)q.x;
        f[1] = (float)q.y;
        f[2] = (float)q.z;
    }
    return m;
}

/* Rings of radius 0.3 around a circle of radius 1; the last ring and row repeat the first. */
static inline triangle_mesh torus(uint32_t n)
{
    triangle_mesh m = room_for((n + 1) * (n + 1), 2 * n * n);
    uint32_t i, k;
    for (k = 0; k <= n; ++k)
        for (i = 0; i <= n; ++i) {
            const double a = (k % n) * 6.283185307179586 / n, b = (i % n) * 6.283185307179586 / n;
            const double r = 1 + 0.3 * cos(b);
            add_vertex(&m, (float)(r * cos(a)), (float)(0.3 * sin(b)), (float)(r * sin(a)));
        }
    add_squares(&m, 0, n);
    return m;
}

/* A square from 0 to 1, with a hill; `steep` 0: flat. */
static inline triangle_mesh field(uint32_t n, float steep)
{
    triangle_mesh m = room_for((n + 1) * (n + 1), 2 * n * n);
    uint32_t i, k;
    for (k = 0; k <= n; ++k)
        for (i = 0; i <= n; ++i) {
            const float x = (float)i / (float)n, y = (float)k / (float)n;
            add_vertex(&m, x, y, steep * x * y * (1.0f - x) * (1.0f - y));
        }
    add_squares(&m, 0, n);
    return m;
}

static inline triangle_mesh joined(triangle_mesh a, triangle_mesh b)
{
    triangle_mesh m = room_for(a.vertex_count + b.vertex_count, a.triangle_count + b.triangle_count);
    uint32_t i;
    memcpy(m.positions, a.positions, a.vertex_count * 3 * sizeof(float));
    memcpy(m.positions + 3 * a.vertex_count, b.positions, b.vertex_count * 3 * sizeof(float));
    m.vertex_count = a.vertex_count + b.vertex_count;
    for (i = 0; i < a.triangle_count; ++i)
        add_triangle(&m, a.indices[3 * i], a.indices[3 * i + 1], a.indices[3 * i + 2]);
    for (i = 0; i < b.triangle_count; ++i)
        add_triangle(&m, a.vertex_count + b.indices[3 * i], a.vertex_count + b.indices[3 * i + 1],
                     a.vertex_count + b.indices[3 * i + 2]);
    triangle_mesh_free(&a);
    triangle_mesh_free(&b);
    return m;
}

static inline triangle_mesh placed(triangle_mesh m, float scale, float x, float y, float z)
{
    uint32_t v;
    for (v = 0; v < m.vertex_count; ++v) {
        m.positions[3 * v] = m.positions[3 * v] * scale + x;
        m.positions[3 * v + 1] = m.positions[3 * v + 1] * scale + y;
        m.positions[3 * v + 2] = m.positions[3 * v + 2] * scale + z;
    }
    return m;
}

/* --- what is looked at --- */

/* Simplified; every result has to be in order, whatever came in. */
static inline triangle_mesh simple(const triangle_mesh *in, uint32_t triangles, int around, simplify_facts *facts)
{
    triangle_mesh out;
    report problem;
    uint32_t i, bad = 0;
    memset(&problem, 0, sizeof problem);
    CHECK_MSG(simplify_mesh(&out, in, triangles, around, facts, &problem), "%s", problem.text);
    for (i = 0; i < 3 * out.triangle_count; ++i)
        bad += out.indices[i] >= out.vertex_count;
    for (i = 0; i < out.triangle_count; ++i)
        bad += out.indices[3 * i] == out.indices[3 * i + 1] || out.indices[3 * i + 1] == out.indices[3 * i + 2]
            || out.indices[3 * i + 2] == out.indices[3 * i];
    for (i = 0; i < 3 * out.vertex_count; ++i)
        bad += !(fabsf(out.positions[i]) < HUGE_VALF) || !(fabsf(out.normals[i]) <= 1.001f);
    CHECK_MSG(!bad, "%u", (unsigned)bad);
    CHECK(out.triangle_count <= in->triangle_count);
    return out;
}

/* Edges that have not exactly one face on each side. */
static inline uint32_t open_edges(const triangle_mesh *m)
{
    uint32_t open = 0, i, k;
    for (i = 0; i < 3 * m->triangle_count; ++i) {
        const uint32_t a = m->indices[i], b = m->indices[i % 3 == 2 ? i - 2 : i + 1];
        uint32_t back = 0, same = 0;
        for (k = 0; k < 3 * m->triangle_count; ++k) {
            const uint32_t c = m->indices[k], d = m->indices[k % 3 == 2 ? k - 2 : k + 1];
            back += c == b && d == a;
            same += c == a && d == b;
        }
        open += back != 1 || same != 1;
    }
    return open;
}

static inline double volume(const triangle_mesh *m)
{
    double sum = 0;
    uint32_t i;
    for (i = 0; i < m->triangle_count; ++i)
        sum += dvec_dot(dvec_read(m->positions + 3 * (size_t)m->indices[3 * i]),
                        dvec_cross(dvec_read(m->positions + 3 * (size_t)m->indices[3 * i + 1]),
                                   dvec_read(m->positions + 3 * (size_t)m->indices[3 * i + 2]))) / 6;
    return sum;
}

#endif
