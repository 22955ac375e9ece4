/* test_enclose.c: the nearest point of a mesh and the side of it; simple meshes that contain the original. */
#include "../../tools/mesh/enclose.h"
#include "../../tools/mesh/triangle_tree.h"
#include "../mesh_shapes.h"

void test_enclose(void);

static simplify_facts facts; /* of the last mesh */

/* --- the nearest point --- */

/* The nearest point by a search over all triangles with weights on a fine lattice, so no formula is shared. */
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
    counted_heap t = {0, 0};
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
        CHECK(nearest_is_outside(&n, p) == (dvec_length(p) > dvec_length(n.point)));
    }
    triangle_tree_free(&tree, &t);
    CHECK(!t.bytes && t.highest);
    triangle_mesh_free(&in);
}

/* Beyond a sharp corner some planes face the point and some do not: the side is still correct. */
static void check_sharp(void)
{
    triangle_mesh in = room_for(4, 4);
    triangle_tree tree;
    counted_heap t = {0, 0};
    test_rng rng = {4};
    nearest found;
    int i, k, wrong = 0;
    add_vertex(&in, 0, 0, 3);
    add_vertex(&in, 1, 0, 0);
    add_vertex(&in, 0.2f, 0.3f, 0);
    add_vertex(&in, 0.1f, -0.2f, 0);
    add_triangle(&in, 0, 1, 2);
    add_triangle(&in, 0, 2, 3);
    add_triangle(&in, 0, 3, 1);
    add_triangle(&in, 1, 3, 2);
    CHECK(volume(&in) > 0 && triangle_tree_build(&tree, &in, &t));
    for (i = 0; i < 2000; ++i) {
        const float x = test_uniform(&rng, -1, 2), y = test_uniform(&rng, -1, 1), z = test_uniform(&rng, -1, 4);
        const dvec p = dvec_of((double)x, (double)y, (double)z);
        int outside = 0;
        for (k = 0; k < 4; ++k) {
            const dvec a = dvec_read(in.positions + 3 * (size_t)in.indices[3 * k]);
            const dvec b = dvec_read(in.positions + 3 * (size_t)in.indices[3 * k + 1]);
            const dvec c = dvec_read(in.positions + 3 * (size_t)in.indices[3 * k + 2]);
            outside |= dvec_dot(dvec_turn(a, b, c), dvec_sub(p, a)) > 0;
        }
        found = triangle_tree_nearest(&tree, p, (uint32_t)i % 4);
        wrong += nearest_is_outside(&found, p) != outside;
    }
    CHECK_MSG(!wrong, "%d", wrong);
    triangle_tree_free(&tree, &t);
    triangle_mesh_free(&in);
}

/* --- enclosing --- */

/* Distance of a vertex beyond the surface of m, which is star-shaped, along a ray from the centre. */
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
    double max = -HUGE_VAL;
    uint32_t v;
    for (v = 0; v < in->vertex_count; v += 3)
        max = fmax(max, sticks_out(out, dvec_read(in->positions + 3 * v)));
    return max;
}

static void check_around(triangle_mesh in, uint32_t triangles)
{
    triangle_mesh near = simple(&in, triangles, SIMPLIFY_NEAR, &facts);
    triangle_mesh out = simple(&in, triangles, SIMPLIFY_AROUND, &facts);
    CHECK_MSG(out.triangle_count == triangles, "%u", (unsigned)out.triangle_count);
    CHECK_MSG(most_outside(&in, &near) > 0.005, "%g", most_outside(&in, &near)); /* there is something to do */
    CHECK_MSG(most_outside(&in, &out) < 1e-5, "%g", most_outside(&in, &out));
    CHECK_MSG(facts.outside < 1e-5, "%g", facts.outside);
    CHECK_MSG(volume(&out) < 1.12 * volume(&in), "%g of %g", volume(&out), volume(&in));
    triangle_mesh_free(&in);
    triangle_mesh_free(&near);
    triangle_mesh_free(&out);
}

/* A flat sheet has no outside to move to, only a border: a smaller sheet grows to the larger one. */
static void check_enclose_border(void)
{
    triangle_mesh in = field(8, 0), sheet = placed(field(2, 0), 0.9f, 0.05f, 0.05f, -0.01f);
    counted_heap t = {0, 0};
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

/* A plate within a thicker one: each side is nearer to the wrong side of the other, which must not move anything. */
static void check_thin(void)
{
    triangle_mesh in = cube(4), plate = cube(2), before = cube(2);
    counted_heap t = {0, 0};
    double outside;
    uint32_t v;
    for (v = 0; v < in.vertex_count; ++v)
        in.positions[3 * v + 2] *= 0.02f;
    for (v = 0; v < plate.vertex_count; ++v) {
        plate.positions[3 * v + 2] = plate.positions[3 * v + 2] > 0 ? 0.09f : -0.03f;
        before.positions[3 * v + 2] = plate.positions[3 * v + 2];
    }
    CHECK(mesh_enclose(&plate, &in, &outside, &t) && outside < 1e-5);
    CHECK(!memcmp(plate.positions, before.positions, plate.vertex_count * 3 * sizeof(float)));
    triangle_mesh_free(&in);
    triangle_mesh_free(&plate);
    triangle_mesh_free(&before);
}

/* A patch that faces a ball from outside does not belong to the ball's surface and moves nothing. */
static void check_facing_back(void)
{
    triangle_mesh ball = sphere(4), in = room_for(3, 1);
    counted_heap t = {0, 0};
    double outside;
    add_vertex(&in, 1.2f, 0, 0);
    add_vertex(&in, 1.2f, 0, 0.1f);
    add_vertex(&in, 1.2f, 0.1f, 0);
    add_triangle(&in, 0, 1, 2);
    CHECK(mesh_enclose(&ball, &in, &outside, &t) && outside <= 0);
    in.indices[1] = 2;
    in.indices[2] = 1;
    CHECK(mesh_enclose(&ball, &in, &outside, &t) && most_outside(&in, &ball) < 1e-5);
    triangle_mesh_free(&in);
    triangle_mesh_free(&ball);
}

/* A ball a third as large moves by about the size of the mesh, and the reported remaining distance is correct. */
static void check_far(void)
{
    triangle_mesh in = potato(8), parts = placed(sphere(3), 0.3f, 0.1f, 0, 0);
    triangle_mesh ball = simple(&parts, parts.triangle_count, SIMPLIFY_NEAR, &facts); /* with connected sides */
    counted_heap t = {0, 0};
    double outside;
    CHECK(mesh_enclose(&ball, &in, &outside, &t));
    CHECK_MSG(outside < 0.01 && most_outside(&in, &ball) < 0.01, "%g %g", outside, most_outside(&in, &ball));
    triangle_mesh_free(&in);
    triangle_mesh_free(&parts);
    triangle_mesh_free(&ball);
}

void test_enclose(void)
{
    check_nearest();
    check_sharp();
    check_around(sphere(20), 200);
    check_around(potato(24), 250);
    check_enclose_border();
    check_thin();
    check_facing_back();
    check_far();
}
