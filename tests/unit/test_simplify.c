/* test_simplify.c: simplified meshes: triangle count, shape, borders, parts, appearance and seams. */
#include "../../tools/mesh/corner_mesh.h"
#include "../../tools/mesh/quadric.h"
#include "../mesh_shapes.h"

void test_simplify(void);

static simplify_facts facts; /* of the last mesh */

/* --- shapes --- */

/* Three planes meet in a point with an error of exactly zero, also in sign. */
static void check_quadric(void)
{
    test_rng rng = {1};
    dvec flat;
    int i, k;
    for (i = 0; i < 200; ++i) {
        const dvec on = dvec_of((double)test_uniform(&rng, -9, 9), (double)test_uniform(&rng, -9, 9), 5);
        quadric q = quadric_plane(dvec_of(1, 0, 0), on, 0);
        double area = 0;
        dvec min;
        for (k = 0; k < 5; ++k) {
            const dvec n = dvec_of((double)test_uniform(&rng, -1, 1), (double)test_uniform(&rng, -1, 1), k - 2.2);
            q = quadric_sum(q, quadric_plane(dvec_unit(n), on, k + 1));
            area += k + 1;
        }
        CHECK(quadric_min(&min, q, dvec_of(0, 0, 0)) && dvec_length(dvec_sub(min, on)) < 1e-9);
        CHECK(quadric_error(q, on) >= 0 && quadric_error(q, on) < 1e-12 * area);
        CHECK(fabs(quadric_error(quadric_plane(dvec_of(0, 1, 0), on, 2), dvec_add(on, dvec_of(7, 3, 5))) - 18) < 1e-9);
    }
    CHECK(!quadric_min(&flat, quadric_plane(dvec_of(0, 1, 0), dvec_of(0, 0, 0), 1), dvec_of(0, 0, 0)));
}

static void check_sphere(int around)
{
    triangle_mesh in = sphere(24), out = simple(&in, 300, around, &facts);
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
    triangle_mesh in = torus(48), out = simple(&in, 400, SIMPLIFY_NEAR, &facts);
    CHECK_MSG(out.triangle_count == 400, "%u", (unsigned)out.triangle_count);
    CHECK_MSG(out.vertex_count == 200, "%u", (unsigned)out.vertex_count); /* one tunnel */
    CHECK(!open_edges(&out));
    CHECK_MSG(fabs(volume(&out) / volume(&in) - 1) < 0.02, "%g of %g", volume(&out), volume(&in));
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* Down to the eight corners, which stay in place; also far away, up to the precision of binary32. */
static void check_cube(float x, float slack)
{
    triangle_mesh in = placed(cube(8), 1.0f, x, 0, 0), out = simple(&in, 12, SIMPLIFY_NEAR, &facts);
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
    out = simple(&in, 4, SIMPLIFY_NEAR, &facts);
    CHECK_MSG(out.triangle_count >= 4 && !open_edges(&out), "%u", (unsigned)out.triangle_count); /* still a solid */
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* If the mesh is already small enough, nothing moves, bit for bit. */
static void check_untouched(void)
{
    triangle_mesh in = potato(3), out = simple(&in, in.triangle_count, SIMPLIFY_AROUND, &facts);
    uint32_t i, other = 0;
    CHECK(out.triangle_count == in.triangle_count && out.vertex_count == 6 * 9 + 2 && !facts.collapses);
    for (i = 0; i < 3 * in.triangle_count && out.triangle_count == in.triangle_count; ++i)
        other += memcmp(in.positions + 3 * in.indices[i], out.positions + 3 * out.indices[i], 12) != 0;
    CHECK_MSG(!other, "%u", (unsigned)other);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* The outline of the field is the same square: its border edges lie on it with a total length of four. */
static void check_border(float steep, uint32_t triangles, double slack)
{
    triangle_mesh in = field(24, steep), out = simple(&in, triangles, SIMPLIFY_NEAR, &facts);
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

/* A rough field seen from above: the remaining triangles face upwards and are no slivers. */
static void check_folds(void)
{
    triangle_mesh in = field(40, 0), out;
    test_rng rng = {2};
    uint32_t i, back = 0, needles = 0;
    for (i = 0; i < in.vertex_count; ++i) {
        float *p = in.positions + 3 * i;
        const int inner = p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1;
        p[0] += inner ? test_uniform(&rng, -0.008f, 0.008f) : 0;
        p[1] += inner ? test_uniform(&rng, -0.008f, 0.008f) : 0;
        p[2] = test_uniform(&rng, 0, 0.02f);
    }
    out = simple(&in, 300, SIMPLIFY_NEAR, &facts);
    for (i = 0; i < out.triangle_count; ++i) {
        const dvec a = dvec_read(out.positions + 3 * (size_t)out.indices[3 * i]);
        const dvec b = dvec_read(out.positions + 3 * (size_t)out.indices[3 * i + 1]);
        const dvec c = dvec_read(out.positions + 3 * (size_t)out.indices[3 * i + 2]), n = dvec_turn(a, b, c);
        const double ab = dvec_length(dvec_sub(a, b)), bc = dvec_length(dvec_sub(b, c));
        const double side = fmax(ab, fmax(bc, dvec_length(dvec_sub(c, a))));
        back += !(n.z > 0);
        needles += dvec_length(n) < 0.039 * side * side;
    }
    CHECK_MSG(!back && !needles, "%u %u", (unsigned)back, (unsigned)needles);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* Most border edges that leave one vertex: more than one means that two borders touch. */
static uint32_t most_borders(const triangle_mesh *m)
{
    uint32_t *count = calloc(m->vertex_count + 1, sizeof *count), i, k, max = 0;
    for (i = 0; i < 3 * m->triangle_count; ++i) {
        const uint32_t a = m->indices[i], b = m->indices[i % 3 == 2 ? i - 2 : i + 1];
        for (k = 0; k < 3 * m->triangle_count; ++k)
            if (m->indices[k] == b && m->indices[k % 3 == 2 ? k - 2 : k + 1] == a)
                break;
        if (k == 3 * m->triangle_count && ++count[a] > max)
            max = count[a];
    }
    free(count);
    return max;
}

/* A field with windows: the part between two of them stays wider than a point. */
static void check_windows(void)
{
    triangle_mesh in = field(24, 1), out;
    uint32_t i, n = 0;
    for (i = 0; i < in.triangle_count; ++i)
        if (i / 2 % 24 % 6 < 2 || i / 48 % 6 < 2) {
            memmove(in.indices + 3 * n, in.indices + 3 * i, 3 * sizeof(uint32_t));
            ++n;
        }
    in.triangle_count = n;
    CHECK(most_borders(&in) == 1);
    out = simple(&in, 120, SIMPLIFY_NEAR, &facts);
    CHECK_MSG(out.triangle_count <= 120 && most_borders(&out) == 1, "%u, %u", (unsigned)out.triangle_count,
              (unsigned)most_borders(&out));
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* Every seventh triangle of a sphere is missing: the holes close instead of keeping the parts between them. */
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
    out = simple(&in, 200, SIMPLIFY_NEAR, &facts);
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
            in.normals[3 * v + c] = -in.positions[3 * v + c]; /* differ from the faces' normals */
        }
    out = simple(&in, 300, SIMPLIFY_NEAR, &facts);
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

/* Specks beside a ball are removed first; with SIMPLIFY_AROUND they stay. */
static void check_parts(void)
{
    triangle_mesh in = sphere(10), out;
    uint32_t i;
    for (i = 0; i < 20; ++i)
        in = joined(in, placed(i % 2 ? cube(1) : field(1, 0), 0.01f, 2.0f + (float)i, 0, 0));
    out = simple(&in, 100, SIMPLIFY_NEAR, &facts);
    CHECK_MSG(facts.vanished == 20, "%u", (unsigned)facts.vanished);
    CHECK_MSG(out.triangle_count == 100 && fabs(volume(&out) - 4) < 0.1, "%u, %g", (unsigned)out.triangle_count,
              volume(&out));
    triangle_mesh_free(&out);
    out = simple(&in, 300, SIMPLIFY_AROUND, &facts);
    CHECK(!facts.vanished && out.triangle_count <= 300);
    for (i = 0; i < out.vertex_count && out.positions[3 * i] < 20.9f; ++i)
        continue;
    CHECK(i < out.vertex_count);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

/* A flat two-sided triangle: collapses of it would cost nothing but are not allowed. Because it is as large as the
 * ball, removing it costs more than the ball's finer triangles. */
static void check_large_part(void)
{
    triangle_mesh leaf = room_for(3, 2), in, out;
    add_vertex(&leaf, 2, 0, 0);
    add_vertex(&leaf, 3, 0, 0);
    add_vertex(&leaf, 2, 1, 0);
    add_triangle(&leaf, 0, 1, 2);
    add_triangle(&leaf, 0, 2, 1);
    in = joined(sphere(10), leaf);
    out = simple(&in, 100, SIMPLIFY_NEAR, &facts);
    CHECK(!facts.vanished && out.triangle_count == 100);
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
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

/* The third case has only ties. */
static void check_same(void)
{
    static const uint32_t known[3] = {0x33D4E0C0u, 0xC3F85E45u, 0x47CDCECDu};
    int i;
    for (i = 0; i < 3; ++i) {
        triangle_mesh in = i < 2 ? potato(12) : cube(8);
        triangle_mesh out = simple(&in, 150, i == 1 ? SIMPLIFY_AROUND : SIMPLIFY_NEAR, &facts);
        CHECK_MSG(folded(&out) == known[i], "0x%08X", (unsigned)folded(&out));
        triangle_mesh_free(&in);
        triangle_mesh_free(&out);
    }
}

/* --- allowed edge collapses --- */

/* Vertex 12 in the centre of a flat field, 13 to the right of it; the end of the sheet is on that side. */
static void check_turning(corner_mesh *m)
{
    CHECK(corner_mesh_can_join(m, 12, 13, dvec_of(0.6, 0.5, 0)));
    CHECK(!corner_mesh_can_join(m, 12, 13, dvec_of(0.5, 0.1, 0)));   /* flips triangles */
    CHECK(!corner_mesh_can_join(m, 12, 13, dvec_of(0.6, 0.5, 2)));   /* sets triangles on edge */
    CHECK(!corner_mesh_can_join(m, 12, 13, dvec_of(0.6, 0.254, 0))); /* creates slivers */
}

/* Two squares with a corner at an end of edge 12 - 13 each are removed, so only this edge is left between them. */
static void check_pinching(void)
{
    triangle_mesh in = field(4, 0);
    corner_mesh m;
    counted_heap t = {0, 0};
    report r;
    uint32_t i, n = 0;
    memset(&r, 0, sizeof r);
    CHECK(corner_mesh_build(&m, &in, &facts, &t, &r));
    check_turning(&m);
    corner_mesh_free(&m, &t);
    for (i = 0; i < in.triangle_count; ++i)
        if (i / 2 != 5 && i / 2 != 11) {
            memmove(in.indices + 3 * n, in.indices + 3 * i, 3 * sizeof(uint32_t));
            ++n;
        }
    in.triangle_count = n;
    CHECK(corner_mesh_build(&m, &in, &facts, &t, &r));
    CHECK(m.border[12] && m.border[13] && !corner_mesh_can_join(&m, 12, 13, dvec_of(0.6, 0.5, 0)));
    corner_mesh_free(&m, &t);
    CHECK(!t.bytes);
    triangle_mesh_free(&in);
}

/* A ball with one triangle missing: a collapse closes it, and no border is left. */
static void check_closing(void)
{
    triangle_mesh in = sphere(4);
    corner_mesh m;
    counted_heap t = {0, 0};
    report r;
    uint32_t v, a = CORNER_NONE, b = 0, borders = 0;
    memset(&r, 0, sizeof r);
    in.triangle_count--;
    CHECK(corner_mesh_build(&m, &in, &facts, &t, &r));
    for (v = 0; v < m.vertex_count; ++v)
        if (m.border[v]) {
            b = a == CORNER_NONE ? b : v;
            a = a == CORNER_NONE ? v : a;
            ++borders;
        }
    CHECK(borders == 3 && corner_mesh_can_join(&m, a, b, dvec_mix(m.places[a], m.places[b], 0.5)));
    corner_mesh_join(&m, a, b, dvec_mix(m.places[a], m.places[b], 0.5));
    for (v = 0, borders = 0; v < m.vertex_count; ++v)
        borders += m.first[v] != CORNER_NONE && m.border[v];
    CHECK_MSG(!borders, "%u", (unsigned)borders);
    corner_mesh_free(&m, &t);
    triangle_mesh_free(&in);
}

void test_simplify(void)
{
    check_quadric();
    check_sphere(SIMPLIFY_NEAR);
    check_sphere(SIMPLIFY_AROUND);
    check_torus();
    check_cube(0, 1e-5f);
    check_cube(3000, 3e-4f);
    check_untouched();
    check_border(0, 2, 1e-5);
    check_border(4, 150, 1e-3); /* a thousandth of the side, because the hill pulls */
    check_folds();
    check_windows();
    check_holes();
    check_looks();
    check_parts();
    check_large_part();
    check_same();
    check_pinching();
    check_closing();
}
