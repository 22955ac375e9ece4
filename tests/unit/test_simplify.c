/* test_simplify.c: simpler meshes: their count, shape, borders, parts and looks; enclosing; hostile input. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/enclose.h"
#include "../../tools/simplify.h"
#include "../../tools/triangle_tree.h"
#include "../test.h"

void test_simplify(void);

/* --- meshes --- */

static triangle_mesh room_for(uint32_t vertices, uint32_t triangles)
{
    triangle_mesh m;
    memset(&m, 0, sizeof m);
    m.positions = malloc(vertices * 3 * sizeof(float));
    m.indices = malloc(triangles * 3 * sizeof(uint32_t));
    return m;
}

static void add_vertex(triangle_mesh *m, float x, float y, float z)
{
    float *p = m->positions + 3 * (size_t)m->vertex_count++;
    p[0] = x;
    p[1] = y;
    p[2] = z;
}

static void add_triangle(triangle_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *v = m->indices + 3 * (size_t)m->triangle_count++;
    v[0] = a;
    v[1] = b;
    v[2] = c;
}

/* n x n squares of (n + 1)^2 vertices from number `from` on, row by row. */
static void add_squares(triangle_mesh *m, uint32_t from, uint32_t n)
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
static triangle_mesh cube(uint32_t n)
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
static triangle_mesh sphere(uint32_t n)
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
static triangle_mesh potato(uint32_t n)
{
    triangle_mesh m = sphere(n);
    uint32_t v;
    for (v = 0; v < m.vertex_count; ++v) {
        float *p = m.positions + 3 * v;
        const float s = 1.0f + 0.1f * (p[0] * p[1] * 4.0f - p[2] * p[2] * p[0] * 3.0f);
        p[0] *= s;
        p[1] *= s;
        p[2] *= s;
    }
    return m;
}

/* Rings of radius 0.3 around a circle of radius 1; the last ring and row repeat the first. */
static triangle_mesh torus(uint32_t n)
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
static triangle_mesh field(uint32_t n, float steep)
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

static triangle_mesh joined(triangle_mesh a, triangle_mesh b)
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

static triangle_mesh placed(triangle_mesh m, float scale, float x, float y, float z)
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

static simplify_facts facts;
static report problem;

/* Simplified; every result has to be in order, whatever came in. */
static triangle_mesh simple(const triangle_mesh *in, uint32_t triangles, int around)
{
    triangle_mesh out;
    uint32_t i, bad = 0;
    memset(&problem, 0, sizeof problem);
    CHECK_MSG(simplify_mesh(&out, in, triangles, around, &facts, &problem), "%s", problem.text);
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

/* How often the edges occur the other way round, and how often at all (a directed edge once, where all is well). */
static uint32_t open_edges(const triangle_mesh *m)
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

static double volume(const triangle_mesh *m)
{
    double sum = 0;
    uint32_t i;
    for (i = 0; i < m->triangle_count; ++i)
        sum += dvec_dot(dvec_read(m->positions + 3 * (size_t)m->indices[3 * i]),
                        dvec_cross(dvec_read(m->positions + 3 * (size_t)m->indices[3 * i + 1]),
                                   dvec_read(m->positions + 3 * (size_t)m->indices[3 * i + 2]))) / 6;
    return sum;
}

/* --- shapes --- */

static void check_sphere(int around)
{
    triangle_mesh in = sphere(24), out = simple(&in, 300, around);
    uint32_t v, askew = 0;
    CHECK_MSG(out.triangle_count == 300, "%u", (unsigned)out.triangle_count);
    CHECK(out.vertex_count == 152); /* Euler */
    CHECK(!open_edges(&out));
    CHECK_MSG(fabs(volume(&out) - 4.18879) < 0.1, "%g", volume(&out));
    CHECK(around ? volume(&out) > volume(&in) : 1);
    for (v = 0; v < out.vertex_count; ++v) {
        const dvec p = dvec_read(out.positions + 3 * v);
        askew += dvec_dot(dvec_unit(p), dvec_read(out.normals + 3 * v)) < 0.98;
    }
    CHECK_MSG(!askew, "%u", (unsigned)askew);
    CHECK(facts.welded == 6 * 25 * 25 - (6 * 24 * 24 + 2) && !facts.dropped);
    CHECK(facts.memory_bytes > 0 && facts.memory_bytes < 3000000);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

static void check_torus(void)
{
    triangle_mesh in = torus(48), out = simple(&in, 400, SIMPLIFY_NEAR);
    CHECK_MSG(out.triangle_count == 400, "%u", (unsigned)out.triangle_count);
    CHECK_MSG(out.vertex_count == 200, "%u", (unsigned)out.vertex_count); /* one tunnel */
    CHECK(!open_edges(&out));
    CHECK_MSG(fabs(volume(&out) / volume(&in) - 1) < 0.02, "%g of %g", volume(&out), volume(&in));
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* Down to its eight corners, which stay where they are; far away as well, in what binary32 leaves there. */
static void check_cube(float x, float slack)
{
    triangle_mesh in = placed(cube(8), 1.0f, x, 0, 0), out = simple(&in, 12, SIMPLIFY_NEAR);
    uint32_t v;
    double off = 0;
    CHECK(out.triangle_count == 12 && out.vertex_count == 8);
    for (v = 0; v < out.vertex_count; ++v) {
        const float *p = out.positions + 3 * v;
        off = fmax(off, fabs(fabs((double)p[0] - (double)x) - 1));
        off = fmax(off, fmax(fabs(fabs((double)p[1]) - 1), fabs(fabs((double)p[2]) - 1)));
    }
    CHECK_MSG(off <= (double)slack, "%g", off);
    CHECK(!open_edges(&out));
    triangle_mesh_free(&out);
    out = simple(&in, 4, SIMPLIFY_NEAR);
    CHECK_MSG(out.triangle_count >= 4 && !open_edges(&out), "%u", (unsigned)out.triangle_count); /* still a solid */
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* As few triangles as are wanted: nothing moves, down to the bits. */
static void check_untouched(void)
{
    triangle_mesh in = potato(3), out = simple(&in, in.triangle_count, SIMPLIFY_AROUND);
    uint32_t i, other = 0;
    CHECK(out.triangle_count == in.triangle_count && out.vertex_count == 6 * 9 + 2 && !facts.collapses);
    for (i = 0; i < 3 * in.triangle_count && out.triangle_count == in.triangle_count; ++i)
        other += memcmp(in.positions + 3 * in.indices[i], out.positions + 3 * out.indices[i], 12) != 0;
    CHECK_MSG(!other, "%u", (unsigned)other);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* The outline of the field is the same square: its border edges lie on it, and are four long together. */
static void check_border(float steep, uint32_t triangles, double slack)
{
    triangle_mesh in = field(24, steep), out = simple(&in, triangles, SIMPLIFY_NEAR);
    double length = 0, off = 0;
    uint32_t i, k;
    CHECK_MSG(out.triangle_count == triangles, "%u", (unsigned)out.triangle_count);
    for (i = 0; i < 3 * out.triangle_count; ++i) {
        const uint32_t a = out.indices[i], b = out.indices[i % 3 == 2 ? i - 2 : i + 1];
        const float *p = out.positions + 3 * a, *q = out.positions + 3 * b;
        uint32_t back = 0;
        for (k = 0; k < 3 * out.triangle_count; ++k)
            back += out.indices[k] == b && out.indices[k % 3 == 2 ? k - 2 : k + 1] == a;
        if (back)
            continue;
        length += dvec_length(dvec_sub(dvec_read(p), dvec_read(q)));
        off = fmax(off, (double)fminf(fminf(fabsf(p[0]), fabsf(p[0] - 1)), fminf(fabsf(p[1]), fabsf(p[1] - 1))));
    }
    CHECK_MSG(fabs(length - 4) < 4 * slack && off < slack, "%g long, %g off", length, off);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* Every seventh triangle of a sphere is missing: the holes close, instead of keeping what is between them. */
static void check_holes(void)
{
    triangle_mesh in = sphere(16), out;
    uint32_t i, n = 0;
    for (i = 0; i < in.triangle_count; ++i)
        if (i % 7) {
            memmove(in.indices + 3 * n, in.indices + 3 * i, 3 * sizeof(uint32_t));
            ++n;
        }
    in.triangle_count = n;
    out = simple(&in, 200, SIMPLIFY_NEAR);
    CHECK_MSG(out.triangle_count <= 200, "%u", (unsigned)out.triangle_count);
    CHECK(!open_edges(&out));
    CHECK_MSG(fabs(volume(&out) - 4.18879) < 0.25, "%g", volume(&out));
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* --- looks and parts --- */

static void check_looks(void)
{
    triangle_mesh in = sphere(16), out;
    uint32_t v, c, off = 0, dull = 0;
    in.colours = malloc(in.vertex_count * 3 * sizeof(float));
    in.normals = malloc(in.vertex_count * 3 * sizeof(float));
    for (v = 0; v < in.vertex_count; ++v)
        for (c = 0; c < 3; ++c) {
            in.colours[3 * v + c] = 0.5f + 0.4f * in.positions[3 * v + c];
            in.normals[3 * v + c] = -in.positions[3 * v + c]; /* not the faces' */
        }
    out = simple(&in, 300, SIMPLIFY_NEAR);
    CHECK(out.colours != NULL);
    for (v = 0; v < out.vertex_count && out.colours; ++v) {
        const dvec p = dvec_unit(dvec_read(out.positions + 3 * v)), n = dvec_read(out.normals + 3 * v);
        for (c = 0; c < 3; ++c)
            off += fabsf(out.colours[3 * v + c] - 0.5f - 0.4f * out.positions[3 * v + c]) > 0.05f;
        dull += dvec_dot(n, p) > -0.98 || fabs(dvec_length(n) - 1) > 1e-6;
    }
    CHECK_MSG(!off && !dull, "%u %u", (unsigned)off, (unsigned)dull);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* Specks beside a ball are the first to go; around, they stay. */
static void check_parts(void)
{
    triangle_mesh in = sphere(10), out;
    uint32_t i;
    for (i = 0; i < 20; ++i)
        in = joined(in, placed(i % 2 ? cube(1) : field(1, 0), 0.01f, 2.0f + (float)i, 0, 0));
    out = simple(&in, 100, SIMPLIFY_NEAR);
    CHECK_MSG(facts.vanished == 20, "%u", (unsigned)facts.vanished);
    CHECK_MSG(out.triangle_count == 100 && fabs(volume(&out) - 4) < 0.1, "%u, %g", (unsigned)out.triangle_count,
              volume(&out));
    triangle_mesh_free(&out);
    out = simple(&in, 300, SIMPLIFY_AROUND);
    CHECK(!facts.vanished && out.triangle_count <= 300);
    for (i = 0; i < out.vertex_count && out.positions[3 * i] < 20.9f; ++i)
        continue;
    CHECK(i < out.vertex_count);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* --- around --- */

/* The nearest point, from all triangles one by one: by weights of a fine lattice, so that it shares no formula. */
static double distance_by_hand(const triangle_mesh *m, dvec p)
{
    double best = HUGE_VAL;
    uint32_t t;
    int i, k, n = 40;
    for (t = 0; t < m->triangle_count; ++t) {
        const dvec a = dvec_read(m->positions + 3 * (size_t)m->indices[3 * t]);
        const dvec b = dvec_read(m->positions + 3 * (size_t)m->indices[3 * t + 1]);
        const dvec c = dvec_read(m->positions + 3 * (size_t)m->indices[3 * t + 2]);
        for (i = 0; i <= n; ++i)
            for (k = 0; k <= n - i; ++k) {
                const dvec q = dvec_add(a, dvec_add(dvec_mul(dvec_sub(b, a), (double)i / n),
                                                    dvec_mul(dvec_sub(c, a), (double)k / n)));
                best = fmin(best, dvec_length(dvec_sub(p, q)));
            }
    }
    return best;
}

static void check_nearest(void)
{
    triangle_mesh in = potato(2);
    triangle_tree tree;
    tally t = {0, 0};
    test_rng rng = {3};
    int i;
    CHECK(triangle_tree_build(&tree, &in, &t));
    for (i = 0; i < 60; ++i) {
        const float x = test_uniform(&rng, -2, 2), y = test_uniform(&rng, -2, 2), z = test_uniform(&rng, -2, 2);
        const dvec p = dvec_of((double)x, (double)y, (double)z);
        const nearest n = triangle_tree_nearest(&tree, p, (uint32_t)i % in.triangle_count);
        const double by_hand = distance_by_hand(&in, p), d = sqrt(n.distance2);
        CHECK_MSG(d <= by_hand && d > by_hand - 0.02, "%g, by hand %g", d, by_hand);
        CHECK(fabs(n.weight[0] + n.weight[1] + n.weight[2] - 1) < 1e-9);
        CHECK((n.height > 0) == (dvec_length(p) > dvec_length(n.point)));
    }
    triangle_tree_free(&tree, &t);
    CHECK(!t.bytes && t.highest);
    triangle_mesh_free(&in);
}

/* Along a ray from the middle the surface of m, which is star-shaped: how far a vertex is beyond it. */
static double sticks_out(const triangle_mesh *m, dvec p)
{
    uint32_t t;
    for (t = 0; t < m->triangle_count; ++t) {
        const dvec a = dvec_read(m->positions + 3 * (size_t)m->indices[3 * t]);
        const dvec b = dvec_read(m->positions + 3 * (size_t)m->indices[3 * t + 1]);
        const dvec c = dvec_read(m->positions + 3 * (size_t)m->indices[3 * t + 2]);
        const double u = dvec_dot(p, dvec_cross(b, c)), v = dvec_dot(p, dvec_cross(c, a));
        const double w = dvec_dot(p, dvec_cross(a, b));
        if (u >= 0 && v >= 0 && w >= 0 && u + v + w > 0)
            return dvec_length(p) * (1 - dvec_dot(a, dvec_cross(b, c)) / (u + v + w));
    }
    return HUGE_VAL;
}

static double most_outside(const triangle_mesh *in, const triangle_mesh *out)
{
    double most = -HUGE_VAL;
    uint32_t v;
    for (v = 0; v < in->vertex_count; v += 3)
        most = fmax(most, sticks_out(out, dvec_read(in->positions + 3 * v)));
    return most;
}

static void check_around(triangle_mesh in, uint32_t triangles)
{
    triangle_mesh near = simple(&in, triangles, SIMPLIFY_NEAR), out = simple(&in, triangles, SIMPLIFY_AROUND);
    CHECK_MSG(out.triangle_count == triangles, "%u", (unsigned)out.triangle_count);
    CHECK_MSG(most_outside(&in, &near) > 0.005, "%g", most_outside(&in, &near)); /* there is something to do */
    CHECK_MSG(most_outside(&in, &out) < 1e-5, "%g", most_outside(&in, &out));
    CHECK_MSG(facts.outside < 1e-5, "%g", facts.outside);
    CHECK_MSG(volume(&out) < 1.12 * volume(&in), "%g of %g", volume(&out), volume(&in));
    triangle_mesh_free(&in);
    triangle_mesh_free(&near);
    triangle_mesh_free(&out);
}

/* A flat sheet has no outside to move to, but a border: a smaller sheet grows to the larger one. */
static void check_enclose_border(void)
{
    triangle_mesh in = field(8, 0), sheet = placed(field(2, 0), 0.9f, 0.05f, 0.05f, -0.01f);
    tally t = {0, 0};
    double outside;
    uint32_t v;
    float low = 1, high = 0;
    CHECK(mesh_enclose(&sheet, &in, &outside, &t));
    for (v = 0; v < sheet.vertex_count; ++v) {
        low = fminf(low, sheet.positions[3 * v]);
        high = fmaxf(high, sheet.positions[3 * v]);
    }
    CHECK_MSG(low < 0.002f && high > 0.998f && outside < 0.003, "%g %g %g", (double)low, (double)high, outside);
    CHECK(!t.bytes);
    triangle_mesh_free(&in);
    triangle_mesh_free(&sheet);
}

/* --- the same everywhere --- */

static uint32_t folded(const triangle_mesh *m)
{
    uint32_t h = 2166136261u, i, bits;
    for (i = 0; i < 3 * m->triangle_count; ++i)
        h = (h ^ m->indices[i]) * 16777619u;
    for (i = 0; i < 3 * m->vertex_count; ++i) {
        memcpy(&bits, &m->positions[i], sizeof bits);
        h = (h ^ bits) * 16777619u;
        memcpy(&bits, &m->normals[i], sizeof bits);
        h = (h ^ bits) * 16777619u;
    }
    return h;
}

static void check_same(void)
{
    static const uint32_t known[2] = {0x31103CFFu, 0x3888DF5Du};
    triangle_mesh in = potato(12);
    int around;
    for (around = 0; around < 2; ++around) {
        triangle_mesh out = simple(&in, 150, around);
        CHECK_MSG(folded(&out) == known[around], "0x%08X", (unsigned)folded(&out));
        triangle_mesh_free(&out);
    }
    triangle_mesh_free(&in);
}

/* --- hostile --- */

static void check_both(const triangle_mesh *in, uint32_t triangles, uint32_t least, uint32_t most)
{
    int around;
    for (around = 0; around < 2; ++around) {
        triangle_mesh out = simple(in, triangles, around);
        CHECK_MSG(out.triangle_count >= least && out.triangle_count <= most, "%u", (unsigned)out.triangle_count);
        triangle_mesh_free(&out);
    }
}

static void check_few(void)
{
    triangle_mesh in, out;
    memset(&in, 0, sizeof in);
    check_both(&in, 0, 0, 0);
    in = room_for(4, 4);
    add_vertex(&in, 0, 0, 0);
    add_vertex(&in, 1, 0, 0);
    add_vertex(&in, 0, 1, 0);
    add_vertex(&in, 0, 0, 1);
    add_triangle(&in, 0, 1, 2);
    check_both(&in, 1, 1, 1);
    check_both(&in, 0, 1, 1); /* the last part stays */
    add_triangle(&in, 0, 3, 1);
    add_triangle(&in, 0, 2, 3);
    add_triangle(&in, 1, 3, 2);
    check_both(&in, 0, 4, 4);
    in.indices[11] = 4;
    CHECK(!simplify_mesh(&out, &in, 2, SIMPLIFY_NEAR, &facts, &problem));
    CHECK_MSG(strstr(problem.text, "triangle 3 has vertex 4 of 4") && !out.indices, "%s", problem.text);
    memset(&problem, 0, sizeof problem);
    in.triangle_count = UINT32_C(1) << 28;
    CHECK(!simplify_mesh(&out, &in, 2, SIMPLIFY_NEAR, &facts, &problem) && strstr(problem.text, "too many"));
    triangle_mesh_free(&in);
}

/* Corners that are none: dropped, and the rest is done. */
static void check_not_finite(void)
{
    triangle_mesh in = sphere(8);
    in.positions[3 * 200] = (float)NAN;
    in.positions[3 * 300 + 1] = HUGE_VALF;
    in.indices[0] = in.indices[1];
    check_both(&in, 100, 98, 100);
    CHECK_MSG(facts.dropped >= 9 && facts.dropped <= 13, "%u", (unsigned)facts.dropped);
    triangle_mesh_free(&in);
}

/* Nothing but lines and points, sheets of one edge, both sides of a sheet, a wheel, any three corners, extremes. */
static void check_odd(void)
{
    triangle_mesh in = field(6, 0);
    test_rng rng = {5};
    uint32_t i;
    for (i = 0; i < in.vertex_count; ++i)
        in.positions[3 * i + 1] = in.positions[3 * i + 2] = 0;
    check_both(&in, 10, 0, 72);
    for (i = 0; i < in.vertex_count; ++i)
        in.positions[3 * i] = 1;
    check_both(&in, 10, 0, 0);
    CHECK(facts.dropped == 72);
    triangle_mesh_free(&in);

    in = room_for(40, 400);
    add_vertex(&in, 0, 0, 0);
    add_vertex(&in, 0, 0, 1);
    for (i = 2; i < 40; ++i) {
        add_vertex(&in, test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1));
        add_triangle(&in, 0, 1, i);
    }
    check_both(&in, 5, 1, 38);
    for (i = 0; i < 300; ++i)
        add_triangle(&in, test_random(&rng) % 40, test_random(&rng) % 40, test_random(&rng) % 40);
    check_both(&in, 5, 1, 338);
    triangle_mesh_free(&in);

    in = joined(field(8, 1), field(8, 1));
    for (i = in.triangle_count / 2; i < in.triangle_count; ++i) {
        const uint32_t swap = in.indices[3 * i];
        in.indices[3 * i] = in.indices[3 * i + 1];
        in.indices[3 * i + 1] = swap;
    }
    check_both(&in, 40, 1, 256);
    triangle_mesh_free(&in);
}

static void check_wheel(void)
{
    enum { SPOKES = 3000 };
    triangle_mesh in = room_for(SPOKES + 1, SPOKES);
    uint32_t i;
    add_vertex(&in, 0, 0, 0);
    for (i = 0; i < SPOKES; ++i)
        add_vertex(&in, (float)cos(i * 6.283185307179586 / SPOKES), (float)sin(i * 6.283185307179586 / SPOKES), 0);
    for (i = 0; i < SPOKES; ++i)
        add_triangle(&in, 0, 1 + i, 1 + (i + 1) % SPOKES);
    check_both(&in, 24, 22, 24);
    triangle_mesh_free(&in);
}

static void check_extremes(void)
{
    static const float scales[] = {1e38f, 1e-18f, 1e-38f};
    int i;
    for (i = 0; i < 3; ++i) {
        triangle_mesh in = placed(sphere(6), scales[i], 0, 0, 0);
        check_both(&in, 100, 100, 432);
        triangle_mesh_free(&in);
    }
}

void test_simplify(void)
{
    check_sphere(SIMPLIFY_NEAR);
    check_sphere(SIMPLIFY_AROUND);
    check_torus();
    check_cube(0, 1e-5f);
    check_cube(3000, 3e-4f);
    check_untouched();
    check_border(0, 2, 1e-5);
    check_border(4, 150, 1e-3); /* a thousandth of the side, where the hill pulls */
    check_holes();
    check_looks();
    check_parts();
    check_nearest();
    check_around(sphere(20), 200);
    check_around(potato(24), 250);
    check_enclose_border();
    check_same();
    check_few();
    check_not_finite();
    check_odd();
    check_wheel();
    check_extremes();
}
