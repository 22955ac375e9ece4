/* test_simplify_odd.c: the simplifier with invalid and degenerate meshes. */
#include "../../tools/mesh/corner_mesh.h"
#include "../mesh_shapes.h"

void test_simplify_odd(void);

static simplify_facts facts; /* of the last mesh */

static void check_both(const triangle_mesh *in, uint32_t triangles, uint32_t min, uint32_t max)
{
    int around;
    for (around = 0; around < 2; ++around) {
        triangle_mesh out = simple(in, triangles, around, &facts);
        CHECK_MSG(out.triangle_count >= min && out.triangle_count <= max, "%u", (unsigned)out.triangle_count);
        triangle_mesh_free(&out);
    }
}

static void check_few(void)
{
    triangle_mesh in, out;
    report problem;
    memset(&problem, 0, sizeof problem);
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

/* Triangles with corners that are not finite are dropped, and the rest is simplified. */
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

/* Only lines and points, sheets of one edge, both sides of a sheet, a wheel, random corners, extremes. */
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
    corner_mesh m;
    counted_heap t = {0, 0};
    report r;
    uint32_t i;
    add_vertex(&in, 0, 0, 0);
    for (i = 0; i < SPOKES; ++i)
        add_vertex(&in, (float)cos(i * 6.283185307179586 / SPOKES), (float)sin(i * 6.283185307179586 / SPOKES), 0);
    for (i = 0; i < SPOKES; ++i)
        add_triangle(&in, 0, 1 + i, 1 + (i + 1) % SPOKES);
    check_both(&in, 24, 22, 24);
    memset(&r, 0, sizeof r);
    CHECK(corner_mesh_build(&m, &in, &facts, &t, &r));
    CHECK(!corner_mesh_can_join(&m, 0, 1, dvec_mix(m.places[0], m.places[1], 0.01))); /* too many triangles */
    corner_mesh_free(&m, &t);
    triangle_mesh_free(&in);
}

/* Two poles of 600 triangles each, most of which must go before an edge there can collapse. */
static void check_globe(void)
{
    enum { AROUND = 600, RINGS = 5 };
    triangle_mesh in = room_for(AROUND * RINGS + 2, AROUND * RINGS * 2), out;
    uint32_t i, k;
    for (k = 0; k < RINGS; ++k)
        for (i = 0; i < AROUND; ++i) {
            const double a = i * 6.283185307179586 / AROUND, b = ((double)k - 2) * 0.5;
            add_vertex(&in, (float)(cos(a) * cos(b)), (float)(sin(a) * cos(b)), (float)sin(b));
        }
    add_vertex(&in, 0, 0, -1);
    add_vertex(&in, 0, 0, 1);
    for (i = 0; i < AROUND; ++i) {
        const uint32_t j = (i + 1) % AROUND, top = AROUND * (RINGS - 1);
        add_triangle(&in, AROUND * RINGS, j, i);
        add_triangle(&in, AROUND * RINGS + 1, top + i, top + j);
        for (k = 0; k + 1 < RINGS; ++k) {
            add_triangle(&in, k * AROUND + i, k * AROUND + j, (k + 1) * AROUND + j);
            add_triangle(&in, k * AROUND + i, (k + 1) * AROUND + j, (k + 1) * AROUND + i);
        }
    }
    out = simple(&in, 40, SIMPLIFY_NEAR, &facts);
    CHECK_MSG(out.triangle_count == 40 && !open_edges(&out), "%u", (unsigned)out.triangle_count);
    CHECK_MSG(fabs(volume(&out) / volume(&in) - 1) < 0.15, "%g", volume(&out));
    triangle_mesh_free(&in);
    triangle_mesh_free(&out);
}

static void check_extremes(void)
{
    static const float scales[] = {3.4e38f, 1e-18f, 1e-38f};
    int i;
    for (i = 0; i < 3; ++i) {
        triangle_mesh in = placed(sphere(6), scales[i], 0, 0, 0);
        check_both(&in, 100, 100, 432);
        triangle_mesh_free(&in);
    }
}

void test_simplify_odd(void)
{
    check_few();
    check_not_finite();
    check_odd();
    check_wheel();
    check_globe();
    check_extremes();
}
