/* test_tree.c: the tree over a shadow map: energy, bounds, the ends of texels, refused input.        [V5 V6 V7 V15] */
#include "../lit_tree.h"

void test_tree(void);

enum { NOISE = 0x3c };

/* --- scenes ------------------------------------------------------------------------------------------------------- */

/* A closed box of 2 m a side; furnished: with a ball and a crate. */
static void make_room(int furnished)
{
    world_begin(0.6f, 0.4f, 0.2f);
    world_box(vec3(0, 0, 0), 1.0f);
    if (furnished) {
        world_sphere(vec3(0.4f, -0.6f, 0.3f), 0.35f, 12, 24);
        world_box(vec3(-0.5f, -0.8f, -0.4f), 0.2f);
    }
    CHECK(world_end() == LMB_OK);
}

/* A 4 m2 floor, rotated against the texel grid. */
static void make_floor(void)
{
    const float c = 0.8829476f, s = 0.4694716f; /* 28 degrees */
    world_begin(0.6f, 0.4f, 0.2f);
    world_quad(vec3(0, 0, 0), vec3(s, 0, c), vec3(c, 0, -s));
    CHECK(world_end() == LMB_OK);
}

/* --- energy ------------------------------------------------------------------------------------------------------- */

typedef struct sums {
    double texels[3], moved[3], roots[3]; /* W: as collected, after edges moved, and at the roots */
    double moved_m2, roots_m2;
} sums;

static sums sum_all(void)
{
    sums s;
    memset(&s, 0, sizeof s);
    for (uint32_t f = 0; f < lit.faces; ++f) {
        const lmb_node root = lit_node(f, 0, 0, tree_root_level(&lit));
        for (int c = 0; c < 3; ++c) {
            s.roots[c] += (double)root.flux[c];
        }
        s.roots_m2 += (double)root.area;
        for (int32_t i = 0; i < lit.size * lit.size; ++i) {
            const lmb_node n = lit_node(f, i % lit.size, i / lit.size, 0);
            for (int c = 0; c < 3; ++c) {
                s.texels[c] += (double)tree_texel(&lit, f, i % lit.size, i / lit.size)->flux[c];
                s.moved[c] += (double)n.flux[c];
            }
            s.moved_m2 += (double)n.area;
        }
    }
    return s;
}

/* V28: albedo x intensity x power, as collected. At an edge one texel gains the amount that another loses, and sums
 * lose nothing. */
static void check_flux(const char *name, lmb_light light, double power)
{
    double worst = 0.0, lost = 0.0, summed = 0.0;
    lit_by(&light);
    const sums s = sum_all();
    for (int c = 0; c < 3; ++c) {
        const double want = power * (double)light.intensity[c] * (double)world.material[0].albedo[c];
        worst = fmax(worst, fabs(s.texels[c] / want - 1.0));
        lost = fmax(lost, fabs(s.moved[c] / s.texels[c] - 1.0));
        summed = fmax(summed, fabs(s.roots[c] / s.moved[c] - 1.0));
    }
    printf("  flux, %-22s %.4f %% from closed form, edges %.4f %%, sums %.1e\n", name, worst * 100, lost * 100, summed);
    CHECK_MSG(worst <= 2e-3, "%s: %g", name, worst);
    CHECK_MSG(lost <= 1e-3, "%s: %g", name, lost);
    CHECK_MSG(summed <= 2e-6, "%s: %g", name, summed);
    CHECK_MSG(fabs(s.roots_m2 / s.moved_m2 - 1.0) <= 2e-6, "%s: %g of %g m2", name, s.roots_m2, s.moved_m2);
}

static void check_energy(void)
{
    make_room(0);
    check_flux("spot 20-35", spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 35), cone_power(20, 35));
    check_flux("spot 0-49", spot(vec3(0, 0, 0), vec3(1, 0.4f, 0.3f), 0, 49), cone_power(0, 49));
    check_flux("spot 40-70, six faces", spot(vec3(0.1f, 0.5f, -0.2f), vec3(0.2f, -1, 0.3f), 40, 70),
               cone_power(40, 70));
    check_flux("point", point_light(vec3(0.1f, 0.2f, 0.3f)), 4.0 * PI);
    const double room_m2 = sum_all().moved_m2;
    CHECK_MSG(fabs(room_m2 / 24.0 - 1.0) < 2e-3, "%g m2 of 24", room_m2);
    make_room(1);
    check_flux("point, furnished", point_light(vec3(0.1f, 0.3f, -0.1f)), 4.0 * PI);
    make_floor();
    check_flux("sun overhead", sun(vec3(0, -1, 0)), 4.0);
    check_flux("sun at 60 degrees", sun(vec3(0.8660254f, -0.5f, 0)), 2.0);
    lmb_light ends = point_light(vec3(0, 0.3f, 0)); /* the range ends 0.85 m from the floor's centre */
    ends.range = 0.9f;
    check_flux("point, range 0.9", ends, range_power(0.3, 0.9, 0.0));
}

/* --- bounds ------------------------------------------------------------------------------------------------------- */

/* A quarter of the texels of lit_by. */
static void lit_small(const lmb_light *light)
{
    const int32_t faces = lmb_shadow_map_faces(light, &world.scene);
    lit_begin((uint32_t)faces, faces == 1 ? LIT_SIDE / 2 : LIT_SMALL / 2, 0);
    lit_add(light);
}

typedef struct faults {
    uint32_t nodes, outside, bent, strange, sums, empty;
} faults;

/* In the node's box and sphere, up to rounding. */
static int is_in(const lmb_node *n, lmb_vec3 p)
{
    const lmb_vec3 axis[3] = {n->normal, n->across, cross3(n->normal, n->across)}, d = sub3(p, n->middle);
    int in = length3(d) <= n->radius * 1.000001f + 1e-6f;
    for (int i = 0; i < 3; ++i) {
        in &= absf(dot3(axis[i], d)) <= n->half[i] * 1.000001f + 1e-6f && absf(length3(axis[i]) - 1.0f) < 1e-5f;
    }
    return in;
}

static lmb_vec3 stands_at(uint32_t face, const lmb_node *n)
{
    return tree_texel(&lit, face, (int32_t)n->texel % lit.size, (int32_t)n->texel / lit.size)->position;
}

/* A node's representative texel is lit, lies under the node, and is nearer to the node's centre than those of the
 * children. */
static int is_well_stood_for(const lmb_node *n, uint32_t face, int32_t x, int32_t y, int level)
{
    const int32_t tx = (int32_t)n->texel % lit.size, ty = (int32_t)n->texel / lit.size;
    int good = tx >> level == x && ty >> level == y && flux_sum(tree_texel(&lit, face, tx, ty)->flux) > 0.0f;
    for (int i = 0; i < 4; ++i) {
        const lmb_node part = lit_node(face, 2 * x + i % 2, 2 * y + i / 2, level - 1);
        good &= !(flux_sum(part.flux) > 0.0f) || length3(sub3(stands_at(face, &part), n->centre)) >=
                                                     0.99999f * length3(sub3(stands_at(face, n), n->centre));
    }
    return good;
}

/* Compares a node with every texel under it. */
static void check_node(faults *f, uint32_t face, int32_t x, int32_t y, int level)
{
    const lmb_node n = lit_node(face, x, y, level);
    const int32_t side = 1 << level;
    double flux = 0.0, area = 0.0;
    uint32_t outside = 0, bent = 0;
    for (int32_t i = 0; i < side * side; ++i) {
        const lmb_node t = lit_node(face, x * side + i % side, y * side + i / side, 0);
        if (flux_sum(t.flux) > 0.0f) {
            flux += (double)flux_sum(t.flux);
            area += (double)t.area;
            outside += !is_in(&n, t.centre);
            bent += dot3(t.normal, n.normal) < n.cosine - 1e-6f;
        }
    }
    f->empty += (flux > 0.0) != (flux_sum(n.flux) > 0.0f);
    f->sums += fabs((double)flux_sum(n.flux) - flux) > 4e-6 * flux || fabs((double)n.area - area) > 4e-6 * area;
    if (flux > 0.0) {
        ++f->nodes;
        f->outside += outside > 0 || !is_in(&n, n.centre);
        f->bent += bent > 0 || absf(length3(n.normal) - 1.0f) > 1e-6f;
        f->strange += !is_well_stood_for(&n, face, x, y, level);
    }
}

/* V15: boxes, cones, sums and the representative texel of every node. */
static void check_bounds(const char *name, lmb_light light)
{
    faults f;
    memset(&f, 0, sizeof f);
    lit_small(&light);
    for (uint32_t face = 0; face < lit.faces; ++face) {
        for (int level = 1; level <= tree_root_level(&lit); ++level) {
            const int32_t side = lit.size >> level;
            for (int32_t i = 0; i < side * side; ++i) {
                check_node(&f, face, i % side, i / side, level);
            }
        }
    }
    CHECK_MSG(f.nodes > 1000, "%s: %u nodes", name, (unsigned)f.nodes);
    CHECK_MSG(f.outside == 0, "%s: %u boxes do not hold their texels", name, (unsigned)f.outside);
    CHECK_MSG(f.bent == 0, "%s: %u cones do not hold their normals", name, (unsigned)f.bent);
    CHECK_MSG(f.sums == 0, "%s: %u sums wrong", name, (unsigned)f.sums);
    CHECK_MSG(f.strange == 0, "%s: %u nodes have the wrong texel stand for them", name, (unsigned)f.strange);
    CHECK_MSG(f.empty == 0, "%s: %u nodes empty with light or lit without", name, (unsigned)f.empty);
}

/* --- order, and refused input ------------------------------------------------------------------------------------- */

/* Rows in any order and pieces, over any previous contents: the same bytes. */
static void check_order(lmb_light light)
{
    static uint32_t first_memory[sizeof lit_memory / sizeof *lit_memory];
    make_room(1);
    lit_begin(6, LIT_SMALL / 2, NOISE);
    lit_add(&light);
    const size_t bytes = lmb_tree_bytes(lit.faces, lit.size);
    const uint32_t faces = lit.faces;
    memcpy(first_memory, lit_memory, sizeof lit_memory);
    lit_begin(6, LIT_SMALL / 2, NOISE);
    for (lit.faces = 0; lit.faces < faces; ++lit.faces) { /* all faces of a point light must be drawn */
        const int32_t rows = lit.size / LMB_TILE, face = (int32_t)lit.faces;
        CHECK(lit_rows(&light, face, rows - 3, rows) == LMB_OK && lit_rows(&light, face, 1, 2) == LMB_OK);
        CHECK(lit_rows(&light, face, 2, rows - 3) == LMB_OK && lit_rows(&light, face, 4, 4) == LMB_OK);
        CHECK(lit_rows(&light, face, 0, 1) == LMB_OK);
        lit_sum(lit.faces);
    }
    CHECK(faces == 6 && bytes <= sizeof lit_memory && memcmp(lit_memory, first_memory, sizeof lit_memory) == 0);
    for (uint32_t f = 0; f < faces; ++f) {
        lit_sum(f);
    }
    CHECK(memcmp(lit_memory, first_memory, sizeof lit_memory) == 0); /* summed twice */
}

static void check_refused(void)
{
    const lmb_light light = spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 35);
    const lmb_kernels *k = picked_kernels();
    const int32_t rows = LIT_SMALL / LMB_TILE;
    lmb_tree t, other;
    CHECK(lmb_tree_bytes(1, 8) == 64 * sizeof(lmb_texel) + 21 * sizeof(lmb_node) + sizeof(lmb_view) + sizeof(lmb_target));
    CHECK(lmb_tree_bytes(0, 64) == 0 && lmb_tree_bytes(1, 4) == 0 && lmb_tree_bytes(1, 96) == 0);
    CHECK(lmb_tree_bytes(1, 8192) == 0 && lmb_tree_bytes(1, -8) == 0 && lmb_tree_bytes(65536, 8) == 0);
    const size_t bytes = lmb_tree_bytes(2, LIT_SMALL);
    CHECK(lmb_tree_init(&t, 2, LIT_SMALL, lit_memory, bytes) == LMB_OK && t.faces == 0 && t.face_cap == 2);
    CHECK(lmb_tree_init(&other, 2, LIT_SMALL, lit_memory, bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_tree_init(&other, 2, LIT_SMALL, (char *)lit_memory + 2, bytes) == LMB_ERR_ALIGN);
    CHECK(lmb_tree_init(&other, 2, 100, lit_memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_tree_init(&other, 2, LIT_SMALL, NULL, bytes) == LMB_ERR_ARG);
    CHECK(lmb_tree_init(NULL, 2, LIT_SMALL, lit_memory, bytes) == LMB_ERR_ARG);
    make_room(0);
    lit_begin(2, LIT_SMALL, NOISE);
    lit_draw(&light);
    CHECK(lmb_tree_texels(&lit, k, &light_tile, &world.scene, &light, &lit_map, 0, 2, 0, rows) == LMB_ERR_CAPACITY);
    CHECK(lmb_tree_texels(&lit, k, &light_tile, &world.scene, &light, &lit_map, 1, 0, 0, rows) == LMB_ERR_ARG);
    CHECK(lmb_tree_texels(&lit, k, &light_tile, &world.scene, &light, &lit_map, 0, 0, 0, rows + 1) == LMB_ERR_ARG);
    CHECK(lmb_tree_texels(&lit, k, &light_tile, &world.scene, &light, &lit_map, 0, 0, 2, 1) == LMB_ERR_ARG);
    CHECK(lmb_tree_texels(&lit, k, &light_tile, &world.scene, &light, NULL, 0, 0, 0, rows) == LMB_ERR_ARG);
    CHECK(lmb_tree_texels(&lit, NULL, &light_tile, &world.scene, &light, &lit_map, 0, 0, 0, rows) == LMB_ERR_ARG);
    other = lit;
    other.size = 2 * LIT_SMALL;
    CHECK(lmb_tree_texels(&other, k, &light_tile, &world.scene, &light, &lit_map, 0, 0, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_tree_sum(&lit, 2) == LMB_ERR_ARG && lmb_tree_sum(NULL, 0) == LMB_ERR_ARG);
    CHECK(lmb_tree_texels(&lit, k, &light_tile, &world.scene, &light, &lit_map, 0, 0, 0, 0) == LMB_OK);
    size_t kept = 0;
    while (kept < sizeof lit_memory && ((const uint8_t *)lit_memory)[kept] == NOISE) {
        ++kept;
    }
    CHECK(kept == sizeof lit_memory); /* nothing was written */
}

/* --- the ends of texels ------------------------------------------------------------------------------------------- */

/* Two plates of 4 x 2 m with normals a and b that both start at the line `along` through the origin. */
static void make_fold(lmb_vec3 along, lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 u = normalize3(cross3(along, a)), v = normalize3(cross3(b, along));
    world_begin(0.6f, 0.4f, 0.2f);
    world_quad(u, u, mul3(along, 2.0f));
    world_quad(v, v, mul3(along, -2.0f));
    CHECK(world_end() == LMB_OK);
}

typedef struct ends {
    uint32_t count, stray;
    double worst; /* distance in texels from the line */
} ends;

/* Lines on which texels should end: through `at`, along `along`. */
typedef struct lines {
    int32_t count;
    lmb_vec3 at[4], along[4];
} lines;

static float off_lines(const lines *l, lmb_vec3 p)
{
    float min = 3e38f;
    for (int i = 0; i < l->count; ++i) {
        min = minf(min, length3(cross3(sub3(p, l->at[i]), l->along[i])));
    }
    return min;
}

/* Steps of a whole texel of the surface to the left, right, up and down. */
static void whole_sides(lmb_vec3 step[4], int32_t x, int32_t y)
{
    const lmb_texel *t = tree_texel(&lit, 0, x, y);
    lmb_node n;
    lmb_vec3 u, v;
    lmb_tree_texel_quad(&n, &u, &v, &lit, 0, x, y);
    step[1] = mul3(u, 512.0f / (float)(t->side[0] + t->side[1]));
    step[2] = mul3(v, 512.0f / (float)(t->side[2] + t->side[3]));
    step[0] = mul3(step[1], -1.0f);
    step[3] = mul3(step[2], -1.0f);
}

/* For texels on one side of the plane y = height, except at the map's rim: measures whether their moved ends lie on the
 * lines. Ends moved without a line nearby are strays. */
static ends measure_ends(const lines *l, float height, int over)
{
    ends e = {0, 0, 0.0};
    for (int32_t i = 0; i < lit.size * lit.size; ++i) {
        const lmb_texel *t = tree_texel(&lit, 0, i % lit.size, i / lit.size);
        lmb_vec3 step[4];
        if (!(flux_sum(t->flux) > 0.0f) || (t->position.y > height) != over) {
            continue;
        }
        whole_sides(step, i % lit.size, i / lit.size);
        for (int s = 0; s < 4; ++s) {
            if (t->side[s] != 128) {
                const lmb_vec3 end = add3(t->position, mul3(step[s], (float)t->side[s] / 256.0f));
                ++e.count;
                e.worst = fmax(e.worst, (double)(off_lines(l, end) / length3(step[s])));
                e.stray += off_lines(l, t->position) > 1.1f * length3(step[s]);
            }
        }
    }
    return e;
}

static void check_ends(const char *name, const ends *e, double bound)
{
    const sums s = sum_all();
    const double lost = fabs(s.moved[0] / s.texels[0] - 1.0);
    printf("  %-21s %u ends within %.3f texel of their line, light kept to %.4f %%\n", name, (unsigned)e->count,
           e->worst, lost * 100);
    CHECK_MSG(e->count > 100 && e->worst < bound, "%s: %u ends, %g", name, (unsigned)e->count, e->worst);
    CHECK_MSG(e->stray == 0, "%s: %u ends moved away from the line", name, (unsigned)e->stray);
    CHECK_MSG(lost < 5e-4, "%s: %g", name, lost);
}

/* --- the shape of texels at their ends ---------------------------------------------------------------------------- */

/* Position of a point in the map, in texels from the centre. */
static void in_map(double out[2], const lmb_view *v, lmb_vec3 p)
{
    const lmb_vec3 d = sub3(p, v->eye);
    const double w = v->kind == LMB_PERSPECTIVE ? -(double)dot3(d, v->back) : 1.0;
    out[0] = (double)dot3(d, v->right) / w / (double)v->half_width * lit.size / 2;
    out[1] = (double)dot3(d, v->up) / w / (double)v->half_height * lit.size / 2;
}

/* In texels; positive if counter-clockwise. */
static double area_in_map(const lmb_vec3 *corner, int corners)
{
    double sum = 0.0;
    for (int i = 0; i < corners; ++i) {
        double p[2], q[2];
        in_map(p, &lit.view[0], corner[i]);
        in_map(q, &lit.view[0], corner[(i + 1) % corners]);
        sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    return sum;
}

static double taken[LIT_SIDE * LIT_SIDE]; /* share of each cell covered by all texels */

static void take_parts(lmb_node_ref at)
{
    static const int32_t step[CREASE_PARTS] = {0, -1, 1, -LIT_SIDE, LIT_SIDE};
    const lmb_texel *t = tree_texel(&lit, 0, at.x, at.y);
    const int32_t i = at.y * LIT_SIDE + at.x;
    lmb_vec3 corner[CREASE_CORNERS];
    taken[i] += tree_is_whole(t) ? 1.0 : 0.0;
    for (int part = 0; part < CREASE_PARTS && !tree_is_whole(t); ++part) {
        const int corners = lmb_crease_part(corner, &lit, at, part);
        CHECK(corners == 0 || (corners >= 3 && corners <= CREASE_CORNERS));
        const double area = area_in_map(corner, corners);
        CHECK_MSG(area > -1e-3, "part %d of %d %d: %g", part, at.x, at.y, area);
        const int32_t to = i + step[part];
        if (to >= 0 && to < LIT_SIDE * LIT_SIDE) { /* a part beyond the map's rim belongs to no cell */
            taken[to] += area;
        }
    }
}

/* Texels cover every cell fully and without overlap, nearly so at the meeting of three planes. The rims of the map and
 * of the lit area are excluded. */
static void check_parts(const char *name, double bound)
{
    double worst = 0.0;
    int edges = 0;
    CHECK(lit.size == LIT_SIDE);
    memset(taken, 0, sizeof taken);
    for (int32_t i = 0; i < LIT_SIDE * LIT_SIDE; ++i) {
        const lmb_node_ref at = {0, (uint16_t)(i % LIT_SIDE), (uint16_t)(i / LIT_SIDE), 0};
        if (flux_sum(tree_texel(&lit, 0, at.x, at.y)->flux) > 0.0f) {
            take_parts(at);
        }
    }
    for (int32_t i = 0; i < LIT_SIDE * LIT_SIDE; ++i) {
        const int32_t x = i % LIT_SIDE, y = i / LIT_SIDE;
        int inside = x > 0 && y > 0 && x < LIT_SIDE - 1 && y < LIT_SIDE - 1;
        for (int k = 0; k < 9 && inside; ++k) {
            inside = flux_sum(tree_texel(&lit, 0, x + k % 3 - 1, y + k / 3 - 1)->flux) > 0.0f;
        }
        if (inside) {
            worst = fmax(worst, fabs(taken[i] - 1.0));
            edges += !tree_is_whole(tree_texel(&lit, 0, x, y));
        }
    }
    printf("  %-21s %d texels at edges, cells shared out to %.4f\n", name, edges, worst);
    CHECK_MSG(edges > 100 && worst < bound, "%s: %d, %g", name, edges, worst);
}

/* A sunlit corner reflects evenly: compares, at the floor beside the wall, the light of the wall's texels by exact
 * shapes with that of the wall as one square; also by rectangles, for reference. */
static void check_beside(lmb_vec3 along, lmb_vec3 floor, lmb_vec3 wall)
{
    const lmb_vec3 out = normalize3(cross3(along, floor)), up = normalize3(cross3(wall, along));
    double worst = 0.0, rectangles = 0.0;
    for (int place = 0; place < 24; ++place) {
        const lmb_vec3 at = add3(mul3(along, -0.3f + 0.027f * (float)place), mul3(out, 0.004f));
        double exact = 0.0, rough = 0.0, level = 0.0;
        for (int32_t i = 0; i < LIT_SIDE * LIT_SIDE; ++i) {
            const lmb_node_ref p = {0, (uint16_t)(i % LIT_SIDE), (uint16_t)(i / LIT_SIDE), 0};
            const lmb_texel *t = tree_texel(&lit, 0, p.x, p.y);
            lmb_vec3 corner[CREASE_CORNERS], u, v;
            lmb_node n;
            if (!(t->flux[0] > 0.0f) || dot3(t->normal, wall) < 0.99f) {
                continue;
            }
            lmb_tree_texel_quad(&n, &u, &v, &lit, 0, p.x, p.y);
            const double quad = (double)(n.flux[0] * lmb_quad_factor(at, floor, floor, n.centre, n.normal, u, v));
            const double exitance = (double)(n.flux[0] / n.area);
            level = fmax(level, exitance);
            rough += quad;
            exact += tree_is_whole(t) ? quad : 0.0;
            for (int part = 0; part < CREASE_PARTS && !tree_is_whole(t); ++part) {
                const int corners = lmb_crease_part(corner, &lit, p, part);
                exact += exitance * (double)lmb_polygon_factor(at, floor, floor, corner, corners, t->normal);
            }
        }
        const double want =
            level * (double)lmb_quad_factor(at, floor, floor, up, wall, mul3(along, 2.0f), up) * 8.0;
        worst = fmax(worst, fabs(exact / want - 1.0));
        rectangles = fmax(rectangles, fabs(rough / want - 1.0));
    }
    printf("  beside a corner: %.4f from the wall as one square (%.4f by rectangles)\n", worst, rectangles);
    CHECK_MSG(worst < 0.02, "%g", worst);
    CHECK(rectangles > 5.0 * worst);
}

/* V16: texels end at the line in which two planes meet, and nowhere else. */
static void check_fold(const char *name, lmb_light light, lmb_vec3 along)
{
    lines l;
    l.count = 1;
    l.at[0] = vec3(0, 0, 0);
    l.along[0] = along;
    lit_by(&light);
    const ends e = measure_ends(&l, -9.0f, 1);
    check_ends(name, &e, 0.02);
    check_parts(name, 2e-3);
}

static void check_folds(void)
{
    const lmb_vec3 along = normalize3(vec3(0.35f, 0.1f, 1)), floor = normalize3(cross3(along, X));
    const lmb_vec3 wall = normalize3(cross3(floor, along)), roof = normalize3(sub3(floor, wall));
    make_fold(along, floor, wall); /* a corner */
    check_fold("corner, spot", spot(vec3(1.2f, 1.1f, 0.4f), vec3(-1, -1, -0.2f), 20, 40), along);
    check_fold("corner, sun", sun(vec3(-1, -0.7f, -0.2f)), along);
    make_fold(mul3(along, -1.0f), floor, wall); /* seen from inside */
    check_fold("room, spot", spot(vec3(1.2f, 1.1f, 0.4f), vec3(-1, -1, -0.2f), 20, 40), along);
    check_fold("room, sun", sun(vec3(-1, -0.7f, -0.2f)), along);
    check_beside(mul3(along, -1.0f), floor, wall);
    make_fold(along, floor, roof); /* flatter */
    check_fold("flat, spot", spot(vec3(0.7f, 1.3f, 0.4f), vec3(-0.5f, -1, -0.2f), 20, 40), along);
    check_fold("flat, sun", sun(vec3(-0.3f, -1, -0.2f)), along);
}

/* --- coarser than the map ----------------------------------------------------------------------------------------- */

/* A tree of one face with 1 / `each` of the map's `side` texels a side. */
static void lit_coarse(const lmb_light *light, int32_t side, int32_t each)
{
    const int32_t size = side / each;
    lit_begin(1, size, NOISE);
    CHECK(lmb_shadow_map_init(&lit_map, light, &world.scene, side, LMB_ID32, lit_map_memory,
                              sizeof lit_map_memory) == LMB_OK);
    CHECK(lit_map.faces == 1);
    lmb_shadow_map_clear(&lit_map);
    CHECK(lmb_shadow_map_draw(&lit_map, picked_kernels(), &world.scene, 1, WORLD_TRIANGLES, NULL) == LMB_OK);
    CHECK(lit_rows(light, 0, 0, side / LMB_TILE) == LMB_OK);
    lit_sum(0);
    lit.faces = 1;
}

/* Lit texels are in front of the light, within `reach` of the world's centre, and in the plane of their surface. */
static void check_coarse(const char *name, lmb_light light, float reach)
{
    for (int32_t each = 1; each <= 8; each *= 2) {
        uint32_t count = 0, strays = 0;
        lit_coarse(&light, LIT_SIDE, each);
        for (int32_t i = 0; i < lit.size * lit.size; ++i) {
            const lmb_texel *t = tree_texel(&lit, 0, i % lit.size, i / lit.size);
            const float ahead = dot3(light.direction, sub3(t->position, light.position));
            if (flux_sum(t->flux) > 0.0f) {
                ++count;
                strays += !(largest3(t->position) <= reach) || (light.kind == LMB_LIGHT_SPOT && !(ahead > 0.0f));
            }
        }
        CHECK_MSG(count > 200 && strays == 0, "%s, a %d-th: %u of %u texels astray", name, (int)each, (unsigned)strays,
                  (unsigned)count);
    }
}

/* In a convex room no texel lies behind a wall, which would hide it from all receivers: tested with the planes of 256
 * other texels. */
static void check_behind(const char *name, lmb_light light)
{
    for (int32_t each = 2; each <= 8; each *= 2) {
        uint32_t count = 0, behind = 0;
        float worst = 0.0f;
        lit_coarse(&light, LIT_SIDE, each);
        for (int32_t i = 0; i < lit.size * lit.size; ++i) {
            const lmb_texel *t = tree_texel(&lit, 0, i % lit.size, i / lit.size);
            float deep = 0.0f;
            for (int32_t k = 0; k < lit.size * lit.size && flux_sum(t->flux) > 0.0f; k += 256 / (each * each)) {
                const lmb_texel *wall = tree_texel(&lit, 0, k % lit.size, k / lit.size);
                const float before = dot3(wall->normal, sub3(t->position, wall->position));
                deep = flux_sum(wall->flux) > 0.0f ? maxf(deep, -before) : deep;
            }
            count += flux_sum(t->flux) > 0.0f;
            behind += deep > 2e-6f;
            worst = maxf(worst, deep);
        }
        printf("  behind walls, %s, a %d-th: %u of %u texels, by %.1e m\n", name, (int)each, (unsigned)behind,
               (unsigned)count, (double)worst);
        CHECK_MSG(count > 200 && behind == 0, "%s, a %d-th: %u of %u, by %g m", name, (int)each, (unsigned)behind,
                  (unsigned)count, (double)worst);
    }
}

static void check_all_behind(void)
{
    make_room(0);
    check_behind("box", spot(vec3(0.1f, 0.6f, -0.2f), vec3(0.2f, -1, 0.3f), 30, 48));
    check_behind("box, by its axes", spot(vec3(0, 0.6f, 0), vec3(0, -1, 0), 30, 48));
    world_begin(0.6f, 0.4f, 0.2f);
    world_sphere(vec3(0, 0, 0), 1.0f, 10, 20);
    CHECK(world_end() == LMB_OK);
    check_behind("ball from within", spot(vec3(0.1f, 0.2f, -0.2f), vec3(0.2f, -1, 0.3f), 30, 48));
}

/* A plate about a texel wide in front of a wall, at 16 places. If its edges follow the map's axes, its light is that of
 * its area to within one map pixel; at any angle, on average. */
static void check_plate(float degrees, int32_t each)
{
    const float c = cosf(degrees * (float)PI / 180.0f), s = sinf(degrees * (float)PI / 180.0f);
    const lmb_light light = sun(vec3(0, 0, -1));
    double worst = 0.0, mean = 0.0, bound = 0.0;
    for (int i = 0; i < 16; ++i) {
        const float half_w = 0.042f + 0.0026f * (float)i, half_h = 0.71f, x = -0.3f + 0.0371f * (float)i;
        world_begin(0.6f, 0.4f, 0.2f);
        world_quad(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
        world_quad(vec3(x, 0.01f * (float)i, 0.5f), vec3(half_w * c, half_w * s, 0), vec3(-half_h * s, half_h * c, 0));
        CHECK(world_end() == LMB_OK);
        lit_coarse(&light, LIT_SMALL, each);
        const double pixel = 2.0 * (double)lit_map.view[0].half_width / LIT_SMALL;
        const double want = (double)(4.0f * half_w * half_h * world.material[0].albedo[0] * light.intensity[0]);
        double sum = 0.0;
        for (int32_t k = 0; k < lit.size * lit.size; ++k) {
            const lmb_texel *t = tree_texel(&lit, 0, k % lit.size, k / lit.size);
            sum += t->position.z > 0.25f ? (double)t->flux[0] : 0.0;
        }
        worst = fmax(worst, fabs(sum / want - 1.0));
        mean += (sum / want - 1.0) / 16;
        bound = fmax(bound, pixel / (2.0 * (double)half_w) + pixel / (2.0 * (double)half_h));
    }
    printf("  plate at %g degrees, a %d-th: flux within %.2f %% (%.2f in the mean), a pixel is %.2f %%\n",
           (double)degrees, (int)each, worst * 100, mean * 100, bound * 100);
    if (degrees == 0.0f || degrees == 90.0f) {
        CHECK_MSG(worst < bound, "at %g degrees, a %d-th: %g of %g", (double)degrees, (int)each, worst, bound);
    }
    CHECK_MSG(fabs(mean) < 0.05, "at %g degrees, a %d-th: %g in the mean", (double)degrees, (int)each, mean);
}

static void check_plates(void)
{
    static const float degrees[] = {0, 7, 37, 90};
    for (int i = 0; i < COUNT(degrees); ++i) {
        for (int32_t each = i % 2 + 1; each <= 8; each *= 4) { /* 1 and 4, or 2 and 8 */
            check_plate(degrees[i], each);
        }
    }
}

/* Planes that the light sees up to the horizon or edge-on: texels moved to their centres stay in front of it. */
static void check_horizons(void)
{
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 5000), mul3(X, 5000));
    CHECK(world_end() == LMB_OK);
    for (int i = 0; i < 12; i += 4) {
        check_coarse("street light", spot(vec3(0, 2, 0), vec3(0.3f, -0.05f * (float)i, 1), 20, 45), 10000.0f);
    }
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 4), mul3(X, 4));
    world_quad(vec3(0, 2, 4), mul3(X, 4), mul3(Y, 4));
    CHECK(world_end() == LMB_OK);
    for (int i = 0; i < 12; i += 4) {
        check_coarse("light on a wall", spot(vec3(0, 0.01f, 0), vec3(0.3f, 0.03f * (float)i, 1), 20, 45), 8.0f);
        check_coarse("sun along a wall", sun(vec3(0.0001f * (float)i, -1, 0.00002f)), 8.0f);
    }
}

/* A nearly black surface counts as black: its sums would give 0 / 0. */
static void check_dim(void)
{
    static const float albedo[] = {1e-10f, 1e-20f, 1e-30f, 1e-38f, 1e-42f};
    for (int i = 0; i < COUNT(albedo); ++i) {
        const lmb_light light = point_light(vec3(0.1f, 0.2f, 0.3f));
        make_room(0);
        for (int c = 0; c < 3; ++c) {
            world.material[0].albedo[c] = albedo[i];
        }
        lit_begin(6, LIT_SMALL / 4, 0);
        lit_add(&light);
        for (uint32_t f = 0; f < lit.faces; ++f) {
            const lmb_node root = lit_node(f, 0, 0, tree_root_level(&lit));
            CHECK_MSG(largest3(root.centre) <= 1.001f && root.centre.x == root.centre.x, "albedo %g: centre %g",
                      (double)albedo[i], (double)root.centre.x);
            CHECK(i > 0 || flux_sum(root.flux) > 0.0f);
            CHECK(flux_sum(root.flux) == 0.0f || flux_sum(root.flux) > 1e-25f);
        }
    }
}

void test_tree(void)
{
    check_energy();
    make_room(1);
    check_bounds("spot", spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 45));
    check_bounds("point", point_light(vec3(0.1f, 0.3f, -0.1f)));
    check_bounds("sun", sun(vec3(0.4f, -1, 0.2f)));
    check_order(point_light(vec3(0.1f, 0.3f, -0.1f)));
    check_refused();
    check_folds();
    check_horizons();
    check_all_behind();
    check_plates();
    check_dim();
}
