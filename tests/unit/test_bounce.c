/* test_bounce.c: first points, discs, groups and gathering, against formulas, integrals and exact rays. [V1-V28] */
#include <stdlib.h>

#include "../world.h"

void test_bounce(void);

enum { SIDE = 256, POINTS = 120000, FRAME = 128 };

/* --- scenes ------------------------------------------------------------------------------------------------------- */

static uint8_t colours[WORLD_TRIANGLES][3][4];

/* Starts a mesh with vertex colours, all white. */
static void begin_coloured(float red, float green, float blue)
{
    memset(colours, 255, sizeof colours);
    world_begin(red, green, blue);
    world.mesh[0].colours = &colours[0][0][0];
}

/* A closed box of 2 m a side around the origin. */
static void make_box(void)
{
    begin_coloured(0.6f, 0.4f, 0.2f);
    world_box(vec3(0, 0, 0), 1.0f);
    CHECK(world_end() == LMB_OK);
}

/* The box with a ball and a crate: curved and flat surfaces, near and far, in six directions. */
static void make_room(void)
{
    begin_coloured(0.6f, 0.4f, 0.2f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_sphere(vec3(0.4f, -0.6f, 0.3f), 0.35f, 12, 24);
    world_box(vec3(-0.5f, -0.8f, -0.4f), 0.2f);
    CHECK(world_end() == LMB_OK);
}

/* A 4 m2 floor rotated against the texel grid, so that texel centres are not all on one side of an edge. */
static void make_floor(void)
{
    float c = 0.8829476f, s = 0.4694716f; /* 28 degrees */
    begin_coloured(0.6f, 0.4f, 0.2f);
    world_quad(vec3(0, 0, 0), vec3(s, 0, c), vec3(c, 0, -s));
    CHECK(world_end() == LMB_OK);
}

/* --- first points ------------------------------------------------------------------------------------------------- */

static lmb_point point_data[POINTS];
static uint32_t point_cells[SIDE * SIDE + 1];
static lmb_points points;
static uint32_t map_memory[6 * SIDE * SIDE * 2];
static lmb_shadow_map map; /* of the last add_points */
static lmb_tile tile;
static lmb_groups groups;
static lmb_stats stats;

static void clear_points(void)
{
    memset(&points, 0, sizeof points);
    points.data = point_data;
    points.cap = POINTS;
    points.cells = point_cells;
    points.cell_cap = SIDE * SIDE + 1;
}

static void add_points(const lmb_light *light, int32_t size, const lmb_grouping *g, int join)
{
    const lmb_kernels *k = picked_kernels();
    lmb_status status = lmb_shadow_map_init(&map, light, &world.scene, size, LMB_ID32, map_memory, sizeof map_memory);
    lmb_shadow_map_clear(&map);
    if (status == LMB_OK) {
        status = lmb_shadow_map_draw(&map, k, &world.scene, 1, WORLD_TRIANGLES, NULL);
    }
    for (int32_t f = 0; f < map.faces && status == LMB_OK; ++f) {
        if ((map.drawn >> f) & 1u) {
            status = lmb_points_collect(&points, k, &tile, &world.scene, light, &map, f, 0, size / LMB_TILE, g);
            if (status == LMB_OK && join) {
                status = lmb_discs_join(&points, &map, g);
            }
        }
    }
    CHECK_MSG(status == LMB_OK, "%s", lmb_status_name(status));
}

static lmb_grouping grouping_of(int32_t method, int32_t count, int32_t block)
{
    lmb_grouping g;
    memset(&g, 0, sizeof g);
    g.method = method;
    g.groups = count;
    g.block = block;
    return g;
}

static void only_points(const lmb_light *light, int32_t size, int32_t block)
{
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, block);
    clear_points();
    add_points(light, size, &g, 0);
}

static double flux_of(int c)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < points.count; ++i) {
        sum += (double)points.data[i].flux[c];
    }
    return sum;
}

static double area_of(const lmb_point *p) { return 4.0 * (double)length3(cross3(p->axis_u, p->axis_v)); }

static double total_area(void)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < points.count; ++i) {
        sum += area_of(&points.data[i]);
    }
    return sum;
}

/* V4, V28: the power that all points emit = albedo x intensity x power, for every block size. */
static void check_flux(const char *name, lmb_light light, double power, double bound)
{
    static const int32_t blocks[] = {8, 4, 2, 1};
    double first[3] = {0, 0, 0}, worst = 0.0, spread = 0.0;
    for (int b = 0; b < COUNT(blocks); ++b) {
        only_points(&light, light.kind == LMB_LIGHT_POINT || light.cos_outer < 0.6f ? SIDE / 2 : SIDE, blocks[b]);
        for (int c = 0; c < 3; ++c) {
            double flux = flux_of(c), want = power * (double)light.intensity[c] * (double)world.material[0].albedo[c];
            first[c] = b == 0 ? flux : first[c];
            worst = fmax(worst, fabs(flux / want - 1.0));
            spread = fmax(spread, fabs(flux / first[c] - 1.0));
        }
    }
    printf("  flux, %-22s %.4f %% from closed form, blocks within %.1e\n", name, worst * 100.0, spread);
    CHECK_MSG(worst <= bound, "%s: %g", name, worst);
    CHECK_MSG(spread <= 1e-5, "%s: %g", name, spread);
}

static void test_flux(void)
{
    lmb_light wide;
    make_box();
    check_flux("spot 20-35", spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 35), cone_power(20, 35), 1e-3);
    check_flux("spot 0-49", spot(vec3(0, 0, 0), vec3(1, 0.4f, 0.3f), 0, 49), cone_power(0, 49), 1e-3);
    check_flux("spot 30-30, hard", spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 30, 30), cone_power(30, 30),
               2e-3);
    check_flux("spot 40-70, six faces", spot(vec3(0.1f, 0.5f, -0.2f), vec3(0.2f, -1, 0.3f), 40, 70), cone_power(40, 70),
               1e-3);
    wide = spot(vec3(0.1f, 0.5f, -0.2f), vec3(0.2f, -1, 0.3f), 60, 89);
    check_flux("spot 60-89, six faces", wide, cone_power(60, 89), 1e-3);
    check_flux("point", point_light(vec3(0.1f, 0.2f, 0.3f)), 4.0 * PI, 1e-3);
    make_room();
    check_flux("point, furnished", point_light(vec3(0.1f, 0.3f, -0.1f)), 4.0 * PI, 1e-3);
    make_floor();
    check_flux("sun overhead", sun(vec3(0, -1, 0)), 4.0, 2e-3);
    check_flux("sun at 60 degrees", sun(vec3(0.8660254f, -0.5f, 0)), 2.0, 2e-3);
    lmb_light ends = point_light(vec3(0, 0.3f, 0)); /* the range ends 0.85 m from the floor's centre */
    ends.range = 0.9f;
    check_flux("point, range 0.9", ends, range_power(0.3, 0.9, 0.0), 2e-3);
}

/* V5, V6, V7: points lie on the walls, face the light, lie in the cone, and each is in the right cell. */
static void check_places(lmb_light light, int32_t block)
{
    uint32_t off = 0, turned = 0, away = 0, outside = 0, misplaced = 0;
    only_points(&light, SIDE, block);
    float texel = 2.0f * map.view[0].half_width / (float)SIDE; /* at 1 m */
    for (uint32_t i = 0; i < points.count; ++i) {
        const lmb_point *p = &points.data[i];
        lmb_vec3 d = sub3(p->position, light.position), n = p->normal, q = p->position;
        float max = maxf(absf(q.x), maxf(absf(q.y), absf(q.z))), w = -dot3(map.view[0].back, d);
        off += absf(dot3(n, q) + 1.0f) > 1e-5f || max > 1.0f + texel / 128.0f; /* vertices snap to 1/256 texel */
        turned += maxf(absf(n.x), maxf(absf(n.y), absf(n.z))) < 0.999999f || absf(length3(n) - 1.0f) > 1e-5f;
        away += !(dot3(n, d) < 0.0f);
        outside += light.kind == LMB_LIGHT_SPOT &&
                   w * light.cos_outer < length3(d) * light.cos_outer * light.cos_outer - texel * w;
        if (map.faces == 1) {
            float x =
                (dot3(map.view[0].right, d) / (w * map.view[0].half_width) + 1.0f) * 0.5f * (float)SIDE / (float)block;
            float y =
                (1.0f - dot3(map.view[0].up, d) / (w * map.view[0].half_height)) * 0.5f * (float)SIDE / (float)block;
            misplaced += absf(x - 0.5f - (float)p->cell_x) > 0.501f || absf(y - 0.5f - (float)p->cell_y) > 0.501f;
        }
    }
    CHECK_MSG(points.count > 0 && off == 0, "%u of %u off the walls", (unsigned)off, (unsigned)points.count);
    CHECK_MSG(turned == 0, "%u normals wrong", (unsigned)turned);
    CHECK_MSG(away == 0, "%u face away from the light", (unsigned)away);
    CHECK_MSG(outside == 0, "%u outside the cone", (unsigned)outside);
    CHECK_MSG(misplaced == 0, "%u not in their cell", (unsigned)misplaced);
}

/* V7: the floor behind a 0.6 m plate is unlit, the top of the plate is lit. */
static void check_shadowed(void)
{
    lmb_light light = spot(vec3(0, 0.9f, 0), vec3(0, -1, 0), 30, 40);
    uint32_t behind = 0, on_plate = 0, under = 0;
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_quad(vec3(0.1f, 0, 0), vec3(0.3f, 0, 0), vec3(0, 0, -0.3f));
    CHECK(world_end() == LMB_OK);
    only_points(&light, SIDE, 1);
    for (uint32_t i = 0; i < points.count; ++i) {
        lmb_vec3 p = points.data[i].position;
        float t = 0.9f / (0.9f - p.y); /* the ray's crossing of y = 0 */
        int inside = absf(p.x * t - 0.1f) < 0.295f && absf(p.z * t) < 0.295f;
        behind += p.y < -0.5f && inside;
        on_plate += absf(p.y) < 1e-4f;
        under += absf(p.y) < 1e-4f && points.data[i].normal.y < 0.0f;
    }
    CHECK_MSG(behind == 0, "%u points in the plate's shadow", (unsigned)behind);
    CHECK(on_plate > 100 && under == 0);
}

/* The sum of 4 |u x v| is the lit area. */
static void check_areas(void)
{
    static const int32_t blocks[] = {1, 8};
    double want = PI * tan(35 * PI / 180) * tan(35 * PI / 180);
    for (int b = 0; b < COUNT(blocks); ++b) {
        lmb_light l = sun(vec3(0.5f, -0.8f, 0.2f));
        make_floor();
        only_points(&l, SIDE, blocks[b]);
        double floor_m2 = total_area();
        make_box();
        l = point_light(vec3(0.1f, 0.2f, 0.3f));
        only_points(&l, SIDE / 2, blocks[b]);
        double box_m2 = total_area();
        l = spot(vec3(0, 0, 0), vec3(0, -1, 0), 25, 35);
        only_points(&l, SIDE, blocks[b]);
        double circle_m2 = total_area();
        printf("  areas, block %d: floor %+.3f %%, box %+.3f %%, circle %+.3f %%\n", (int)blocks[b],
               (floor_m2 / 4 - 1) * 100, (box_m2 / 24 - 1) * 100, (circle_m2 / want - 1) * 100);
        CHECK(fabs(floor_m2 / 4.0 - 1.0) < 5e-3);
        CHECK(fabs(box_m2 / 24.0 - 1.0) < 5e-3);
        CHECK(fabs(circle_m2 / want - 1.0) < 1e-2);
    }
}

/* V2: reflectance follows vertex colours and textures. */
static void check_albedo(void)
{
    static const uint8_t texels[2][4] = {{0, 0, 0, 255}, {255, 255, 255, 255}};
    lmb_light l = sun(vec3(0, -1, 0));
    float worst = 0.0f, min = 1.0f, max = 0.0f;
    uint32_t grey = 0, dark = 0, bright = 0;
    begin_coloured(1, 1, 1);
    world_quad(vec3(0, 0, 0), Z, X);
    for (int i = 0; i < 6; ++i) {
        memset(colours[i / 3][i % 3], world.corners[i / 3][i % 3][0] > 0.0f ? 255 : 0, 3);
    }
    CHECK(world_end() == LMB_OK);
    only_points(&l, SIDE, 8);
    for (uint32_t i = 0; i < points.count; ++i) {
        float a = points.data[i].albedo[0];
        worst = maxf(worst, absf(a - 0.5f * (1.0f + points.data[i].position.x)));
        min = minf(min, a);
        max = maxf(max, a);
    }
    CHECK_MSG(worst < 0.005f && min < 0.05f && max > 0.95f, "%g %g %g", (double)worst, (double)min, (double)max);
    memset(colours, 255, sizeof colours);
    for (int i = 0; i < 6; ++i) {
        world.uvs[i / 3][i % 3][0] = world.corners[i / 3][i % 3][0] > 0.0f ? 1.0f : 0.0f;
        world.uvs[i / 3][i % 3][1] = 0.5f;
    }
    world.texture.texels = &texels[0][0];
    world.texture.width = 2;
    world.texture.height = world.texture.levels = 1;
    world.texture.wrap_s = LMB_WRAP_CLAMP;
    world.texture.filter = LMB_NEAREST;
    world.material[0].texture = 0;
    CHECK(world_end() == LMB_OK);
    only_points(&l, SIDE, 1);
    for (uint32_t i = 0; i < points.count; ++i) {
        const lmb_point *p = &points.data[i];
        dark += p->albedo[0] < 1e-5f && p->position.x < 0.0f;
        bright += p->albedo[0] > 0.99999f && p->position.x > 0.0f;
        grey += p->albedo[0] > 1e-5f && p->albedo[0] < 0.99999f;
    }
    CHECK_MSG(grey == 0 && dark > 1000 && dark + bright == points.count, "%u %u %u", (unsigned)grey, (unsigned)dark,
              (unsigned)bright);
}

static void check_collect_limits(void)
{
    lmb_light l = point_light(vec3(0.1f, 0.2f, 0.3f));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    const lmb_kernels *k = picked_kernels();
    make_box();
    only_points(&l, SIDE / 2, 8);
    uint32_t all = points.count;
    clear_points();
    points.cap = 5;
    CHECK(lmb_points_collect(&points, k, &tile, &world.scene, &l, &map, 0, 0, SIDE / 16, &g) == LMB_ERR_CAPACITY);
    CHECK(points.count == 5 && all > 5);
    clear_points();
    points.cell_cap = 16;
    CHECK(lmb_points_collect(&points, k, &tile, &world.scene, &l, &map, 0, 0, SIDE / 16, &g) == LMB_ERR_CAPACITY);
    clear_points();
    g.block = 3;
    CHECK(lmb_points_collect(&points, k, &tile, &world.scene, &l, &map, 0, 0, SIDE / 16, &g) == LMB_ERR_ARG);
    CHECK(lmb_points_collect(&points, k, &tile, &world.scene, &l, &map, 6, 0, SIDE / 16, NULL) == LMB_ERR_ARG);
    CHECK(points.count == 0 && lmb_discs_join(&points, &map, NULL) == LMB_ERR_ARG);
    /* A face must start at its first row, and discs can only join with the block size of the collection. */
    CHECK(lmb_points_collect(&points, k, &tile, &world.scene, &l, &map, 0, 1, SIDE / 16, NULL) == LMB_ERR_ARG);
    clear_points();
    points.cell_cap = (SIDE / 16) * (SIDE / 16) + 1;
    CHECK(lmb_points_collect(&points, k, &tile, &world.scene, &l, &map, 0, 0, SIDE / 16, NULL) == LMB_OK);
    for (g.block = -8; g.block < LMB_TILE; ++g.block) {
        CHECK_MSG(g.block == 0 || lmb_discs_join(&points, &map, &g) == LMB_ERR_ARG, "%d", (int)g.block);
    }
    CHECK(lmb_discs_join(&points, &map, NULL) == LMB_OK);
}

static void test_points(void)
{
    make_box();
    check_places(spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 35), 1);
    check_places(spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 48), 8);
    check_places(spot(vec3(0.1f, 0.1f, -0.2f), vec3(-1, -1, 1), 20, 48), 4);
    check_places(point_light(vec3(0.5f, -0.2f, 0.7f)), 8);
    check_shadowed();
    check_areas();
    check_albedo();
    check_collect_limits();
}

/* --- discs -------------------------------------------------------------------------------------------------------- */

static int is_inner(const lmb_point *p, int32_t side)
{
    return p->cell_x > 1 && p->cell_y > 1 && p->cell_x < side - 2 && p->cell_y < side - 2;
}

/* Largest relative error of the inner points' mean distance against `want`. */
static double distance_error(double want)
{
    double worst = 0.0;
    for (uint32_t i = 0; i < points.count; ++i) {
        if (is_inner(&points.data[i], SIDE / 8)) {
            worst = fmax(worst, fabs((double)points.data[i].distance / want - 1.0));
        }
    }
    return worst;
}

/* V8, V9: on a plane that faces the light, points form a grid with four direct and four diagonal neighbours. */
static void check_distances(void)
{
    lmb_light l = sun(vec3(0, -1, 0));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    CHECK(world_end() == LMB_OK);
    clear_points();
    add_points(&l, SIDE, &g, 1);
    double step = 16.0 * (double)map.view[0].half_width / SIDE;
    CHECK_MSG(points.count == (SIDE / 8) * (SIDE / 8), "%u", (unsigned)points.count);
    CHECK_MSG(distance_error(step * 0.5 * (1.0 + sqrt(2.0))) < 1e-3, "%g",
              distance_error(step * 0.5 * (1.0 + sqrt(2.0))));
    g.neighbour_m = (float)(1.2 * step); /* excludes the diagonals */
    clear_points();
    add_points(&l, SIDE, &g, 1);
    CHECK_MSG(distance_error(step) < 1e-3, "%g", distance_error(step));
    g.neighbour_m = (float)(0.5 * step); /* excludes all: the disc's size is used */
    clear_points();
    add_points(&l, SIDE, &g, 1);
    CHECK_MSG(distance_error(step) < 1e-3, "%g", distance_error(step));
}

/* V11: a larger k gives fewer discs. V12: no flux is lost. */
static void check_joining(void)
{
    static const float k[] = {0.05f, 0.5f, 0.75f, 1.0f};
    lmb_light l = point_light(vec3(0.1f, 0.3f, -0.1f));
    uint32_t before = 0xffffffffu, first = 0;
    make_room();
    for (int i = 0; i < COUNT(k); ++i) {
        lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
        g.join = k[i];
        clear_points();
        add_points(&l, SIDE / 2, &g, 0);
        double flux = flux_of(0), flux_b = flux_of(2), area = total_area();
        first = points.count;
        clear_points();
        add_points(&l, SIDE / 2, &g, 1);
        CHECK_MSG(fabs(flux_of(0) / flux - 1) < 1e-6 && fabs(flux_of(2) / flux_b - 1) < 1e-6, "%g",
                  flux_of(0) / flux - 1);
        CHECK_MSG(fabs(total_area() / area - 1) < 1e-5, "%g", total_area() / area - 1);
        CHECK_MSG(points.count <= before, "k %g: %u discs after %u", (double)k[i], (unsigned)points.count,
                  (unsigned)before);
        before = points.count;
    }
    printf("  discs: k = 1 leaves %u of %u points\n", (unsigned)before, (unsigned)first);
    CHECK(before < first);
}

/* Five points in 2x2 cells: two in the first cell, 1 cm apart; the others are 1 m away. */
static void hand_points(void)
{
    static const float at[5][3] = {{0, 0, 0}, {0.01f, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
    clear_points();
    points.count = 5;
    points.faces = 1;
    for (uint32_t i = 0; i < 5; ++i) {
        lmb_point *p = &points.data[i];
        set_disc(p, vec3(at[i][0], at[i][1], at[i][2]), Y, mul3(X, 0.1f * (float)(i + 1)), mul3(Z, 0.1f),
                 (float)(i + 1));
        p->albedo[0] = p->albedo[1] = p->albedo[2] = 0.25f * (float)i;
        p->cell_x = (uint16_t)(i > 0 ? (i - 1) % 2 : 0);
        p->cell_y = (uint16_t)(i > 0 ? (i - 1) / 2 : 0);
        p->face = 1;
    }
    point_cells[0] = 0;
    point_cells[1] = 2;
    point_cells[2] = 3;
    point_cells[3] = 4;
    point_cells[4] = 5;
    memset(&map, 0, sizeof map);
    map.size = 16;
}

static void check_hand_joining(void)
{
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    const lmb_point *p = points.data;
    hand_points();
    double area = total_area(), flux = flux_of(0);
    CHECK(lmb_discs_join(&points, &map, &g) == LMB_OK && points.count == 4);
    p = points.data;
    CHECK_MSG(absf(p->position.x - 0.02f / 3.0f) < 1e-6f, "%g", (double)p->position.x); /* weighted by flux 1 and 2 */
    CHECK_MSG(absf(p->albedo[0] - 0.5f / 3.0f) < 1e-6f, "%g", (double)p->albedo[0]);    /* mean of the members [V12] */
    CHECK(fabs((double)p->flux[0] - 3.0) < 1e-6 && fabs(flux_of(0) - flux) < 1e-5);
    CHECK(fabs(total_area() - area) < 1e-6);
    hand_points(); /* mean distance of point 0: (0.01 + 1 + 1 + 1.414) / 4 = 0.856 */
    g.join = 0.01f;
    CHECK(lmb_discs_join(&points, &map, &g) == LMB_OK && points.count == 5);
    CHECK_MSG(absf(p->distance - 0.856053f) < 1e-5f, "%g", (double)p->distance);
    hand_points();
    g.join = 0.5f;
    points.data[1].normal = X; /* another surface: neither a neighbour nor joined */
    CHECK(lmb_discs_join(&points, &map, &g) == LMB_OK && points.count == 5);
    CHECK_MSG(absf(p->distance - 1.138071f) < 1e-5f, "%g", (double)p->distance);
    hand_points();
    g.neighbour_m = 0.5f; /* V9: the mean becomes 0.01; half of it joins nothing */
    CHECK(lmb_discs_join(&points, &map, &g) == LMB_OK && points.count == 5 && absf(p->distance - 0.01f) < 1e-6f);
}

/* V9: points are 40 cm apart. A radius of 25 cm reaches none, 50 cm the four beside, 70 cm also the diagonals, and 1 m
 * twelve more. */
static void check_thresholds(void)
{
    static const struct {
        float neighbour_m;
        double mean;
    } want[] = {{0.25f, 0.4}, {0.5f, 0.4}, {0.7f, 0.2 * (1.0 + 1.4142135623730951)},
                {1.0f, 0.4 * (4.0 + 4.0 * 1.4142135623730951 + 8.0 + 8.0 * 2.2360679774997896) / 20.0}};
    const double half = 0.2 * SIDE / 8; /* of a plane with 40 cm blocks */
    lmb_light l = sun(vec3(0, -1, 0));
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, (float)half), mul3(X, (float)half));
    CHECK(world_end() == LMB_OK);
    for (int i = 0; i < COUNT(want); ++i) {
        lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
        g.neighbour_m = want[i].neighbour_m;
        clear_points();
        add_points(&l, SIDE, &g, 1);
        double step = 16.0 * (double)map.view[0].half_width / SIDE;
        CHECK_MSG(fabs(step - 0.4) < 0.01, "blocks of %g m", step); /* the map is slightly larger than the plane */
        CHECK_MSG(distance_error(want[i].mean * step / 0.4) < 1e-3, "within %g m: %g", (double)want[i].neighbour_m,
                  distance_error(want[i].mean * step / 0.4));
    }
}

/* ---- neighbours within a radius, against a test of all points ---- */

static int is_met(const lmb_point *p, const lmb_point *q, const lmb_grouping *g)
{
    const lmb_vec3 away = sub3(q->position, p->position);
    const int faces = dot3(p->normal, q->normal) >= 0.90630779f;
    const int cells = g->neighbour_cells;
    return p != q && p->face == q->face &&
           (g->flags & LMB_NEAR_HEMISPHERE ? dot3(p->normal, away) >= -1e-3f * length3(away) : faces) &&
           (g->neighbour_m <= 0.0f || length3(away) <= g->neighbour_m) &&
           (cells == 0 || (abs(p->cell_x - q->cell_x) <= cells && abs(p->cell_y - q->cell_y) <= cells));
}

/* Over the face collected last; 0 if there is no neighbour. */
static double mean_of_all(const lmb_point *p, const lmb_grouping *g)
{
    double sum = 0.0;
    uint32_t met = 0;
    for (uint32_t j = points.cells[0]; j < points.count; ++j) {
        const lmb_point *q = &points.data[j];
        if (is_met(p, q, g)) {
            sum += (double)length3(sub3(q->position, p->position));
            ++met;
        }
    }
    return met > 0 ? sum / met : 0.0;
}

/* Distances of a map's points, relative to the mean over all points of the face. */
typedef struct distances {
    double worst, off, mean; /* largest error; mean error; mean distance, m */
} distances;

static distances distances_of(const lmb_light *l, const lmb_grouping *g)
{
    distances d = {0.0, 0.0, 0.0};
    uint32_t count = 0;
    clear_points();
    CHECK(lmb_shadow_map_init(&map, l, &world.scene, SIDE / 2, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_shadow_map_clear(&map) == LMB_OK);
    CHECK(lmb_shadow_map_draw(&map, picked_kernels(), &world.scene, 1, WORLD_TRIANGLES, NULL) == LMB_OK);
    for (int32_t f = 0; f < map.faces; ++f) {
        if ((map.drawn >> f & 1u) == 0) {
            continue;
        }
        CHECK(lmb_points_collect(&points, picked_kernels(), &tile, &world.scene, l, &map, f, 0, SIDE / 16, g) ==
              LMB_OK);
        const uint32_t first = points.cells[0];
        CHECK(lmb_discs_join(&points, &map, g) == LMB_OK);
        for (uint32_t i = first; i < points.count; i += 3) {
            const lmb_point *p = &points.data[i];
            const double all = mean_of_all(p, g), off = all > 0.0 ? fabs((double)p->distance / all - 1.0) : 0.0;
            d.worst = fmax(d.worst, off);
            d.off += off;
            d.mean += (double)p->distance;
            ++count;
        }
    }
    CHECK(count > 50);
    d.off /= count;
    d.mean /= count;
    return d;
}

static lmb_grouping neighbours_within(float metres, int32_t cells, uint32_t flags, int32_t block)
{
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, block);
    g.join = 1e-30f;
    g.neighbour_m = metres;
    g.neighbour_cells = cells;
    g.flags = flags;
    return g;
}

/* V8 V9 V10: all points within the radius count, in space or in the map, even if the map foreshortens it. If the radius
 * spans more than half of 64 x 64 cells, every second cell each way is sampled. */
static void check_radii(void)
{
    static const float radius[] = {0.05f, 0.25f, 0.5f, 1.0f, 3.0f};
    const lmb_light lights[] = {point_light(vec3(0.1f, 0.3f, -0.1f)),
                                spot(vec3(0.1f, 0.8f, -0.2f), vec3(0.2f, -1, 0.3f), 20, 48),
                                spot(vec3(-0.9f, 0.1f, -0.2f), vec3(1, -0.2f, 0.1f), 20, 80),
                                sun(vec3(0.3f, -1, 0.2f))};
    const lmb_grouping half = neighbours_within(3.0f, 0, 0, 2);
    make_room();
    for (int l = 0; l < COUNT(lights); ++l) {
        double before = 0.0;
        for (int i = 0; i < COUNT(radius); ++i) {
            const lmb_grouping facing = neighbours_within(radius[i], 0, 0, 8),
                               over = neighbours_within(radius[i], 0, LMB_NEAR_HEMISPHERE, 8),
                               fine = neighbours_within(radius[i], 0, 0, 4);
            const distances d = distances_of(&lights[l], &facing), e = distances_of(&lights[l], &over),
                            s = i % 2 ? d : distances_of(&lights[l], &fine);
            CHECK_MSG(d.worst < 1e-4 && e.worst < 1e-4 && s.worst < 1e-4, "light %d, %g m: %g, %g, %g", l,
                      (double)radius[i], d.worst, e.worst, s.worst);
            CHECK_MSG(i < 2 || d.mean > 1.05 * before, "light %d, %g m: %g m", l, (double)radius[i], d.mean);
            before = d.mean;
        }
        if (map.faces == 1) {
            const distances s = distances_of(&lights[l], &half);
            CHECK_MSG(s.off < 0.03, "light %d, every second cell: %g, at worst %g", l, s.off, s.worst);
        }
        for (int32_t cells = 1; cells <= 3; ++cells) {
            const lmb_grouping map_alone = neighbours_within(0.0f, cells, 0, 8),
                               both = neighbours_within(0.2f, cells, 0, 8);
            CHECK(distances_of(&lights[l], &map_alone).worst < 1e-4 && distances_of(&lights[l], &both).worst < 1e-4);
        }
    }
}

/* V12: discs have the radius that the grouping sets, and no light is lost. */
static void check_disc_radius(void)
{
    lmb_light l = point_light(vec3(0.1f, 0.3f, -0.1f));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    make_room();
    clear_points();
    add_points(&l, SIDE / 2, &g, 1);
    const double flux = flux_of(0);
    const uint32_t count = points.count;
    g.radius = 0.7f;
    clear_points();
    add_points(&l, SIDE / 2, &g, 1);
    CHECK(points.count == count && flux_of(0) == flux);
    double worst = 0.0;
    for (uint32_t i = 0; i < points.count; ++i) {
        const lmb_point *p = &points.data[i];
        worst = fmax(worst, fabs(sqrt(area_of(p) / PI) / (0.7 * (double)p->distance) - 1.0));
    }
    CHECK_MSG(worst < 1e-5, "%g", worst);
}

/* V10: points of the same plane (on the rim) and a point on a wall that faces elsewhere are in the hemisphere over the
 * first point. A point below the plane does not count even if it faces the same way, nor does one beyond the
 * threshold. */
static void check_hemisphere(void)
{
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    const lmb_point *p = points.data;
    g.join = 1e-3f;
    g.flags = LMB_NEAR_HEMISPHERE;
    hand_points();
    points.data[2].normal = mul3(X, -1.0f);
    points.data[2].position.y = 0.75f; /* 1.25 m from the first */
    points.data[3].position.y = -0.1f;
    CHECK(lmb_discs_join(&points, &map, &g) == LMB_OK && points.count == 5);
    CHECK_MSG(absf(p->distance - (0.01f + 1.25f + 1.4142136f) / 3.0f) < 1e-6f, "%g", (double)p->distance);
    hand_points();
    points.data[2].normal = mul3(X, -1.0f);
    points.data[2].position.y = 0.75f;
    points.data[3].position.y = -0.1f;
    g.neighbour_m = 1.3f; /* excludes the opposite point, at 1.414 */
    CHECK(lmb_discs_join(&points, &map, &g) == LMB_OK && points.count == 5);
    CHECK_MSG(absf(p->distance - (0.01f + 1.25f) / 2.0f) < 1e-6f, "%g", (double)p->distance);
}

static void test_discs(void)
{
    check_thresholds();
    check_radii();
    check_disc_radius();
    check_hemisphere();
    check_distances();
    check_joining();
    check_hand_joining();
}

/* --- groups ------------------------------------------------------------------------------------------------------- */

/* Independent of the order of the points. */
static uint64_t hash_points(void)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < points.count; ++i) {
        const uint8_t *bytes = (const uint8_t *)&points.data[i];
        uint64_t h = UINT64_C(1469598103934665603);
        for (size_t b = 0; b < offsetof(lmb_point, link); ++b) {
            h = (h ^ bytes[b]) * UINT64_C(1099511628211);
        }
        sum += h;
    }
    return sum;
}

static lmb_vec3 group_vec(float planes[3][LMB_MAX_GROUPS], int32_t k)
{
    return vec3(planes[0][k], planes[1][k], planes[2][k]);
}

/* V12, V13, V18, V19: recomputes group k from the members in double. */
static int group_is_its_members(int32_t k)
{
    const lmb_point *m = points.data + groups.first[k];
    double flux = 0, area = 0, albedo = 0, bary[3] = {0, 0, 0}, way[3] = {0, 0, 0}, inside = 1;
    lmb_vec3 centre = group_vec(groups.position, k);
    for (uint32_t i = 0; i < groups.members[k]; ++i) {
        double w = (double)m[i].flux[0] + (double)m[i].flux[1] + (double)m[i].flux[2];
        flux += w;
        area += area_of(&m[i]);
        albedo += area_of(&m[i]) * (double)m[i].albedo[1];
        bary[0] += w * (double)m[i].position.x;
        bary[1] += w * (double)m[i].position.y;
        bary[2] += w * (double)m[i].position.z;
        way[0] += w * (double)m[i].normal.x;
        way[1] += w * (double)m[i].normal.y;
        way[2] += w * (double)m[i].normal.z;
        for (int c = 0; c < 4; ++c) {
            lmb_vec3 corner = add3(add3(m[i].position, mul3(m[i].axis_u, c & 1 ? 1.0f : -1.0f)),
                                   mul3(m[i].axis_v, c & 2 ? 1.0f : -1.0f));
            inside *= length3(sub3(corner, centre)) <= groups.radius[k] * 1.00001f;
        }
    }
    double sum = (double)groups.flux[0][k] + (double)groups.flux[1][k] + (double)groups.flux[2][k];
    double turn = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    for (int c = 0; c < 3; ++c) { /* opposed members cancel: any direction is valid */
        inside *= turn < 1e-3 * flux || fabs(way[c] / turn - (double)groups.normal[c][k]) < 1e-3;
    }
    double off = fabs(bary[0] / flux - (double)centre.x) + fabs(bary[1] / flux - (double)centre.y) +
                 fabs(bary[2] / flux - (double)centre.z);
    return groups.members[k] > 0 && inside > 0 && fabs(sum / flux - 1) < 1e-5 &&
           fabs((double)groups.area[k] / area - 1) < 1e-5 && fabs((double)groups.albedo[1][k] - albedo / area) < 1e-5 &&
           off < 1e-4 && absf(length3(group_vec(groups.normal, k)) - 1.0f) < 1e-5f;
}

/* Every point is a member of exactly one group, none is lost or changed, and groups match their members. */
static void check_groups(const char *name, uint64_t hash, uint32_t count, double flux)
{
    uint32_t next = 0, gaps = 0, wrong = 0;
    for (int32_t k = 0; k < groups.count; ++k) {
        gaps += groups.first[k] != next;
        next += groups.members[k];
        wrong += !group_is_its_members(k);
    }
    CHECK_MSG(gaps == 0 && next == points.count && points.count == count, "%s: %u in ranges, %u discs", name,
              (unsigned)next, (unsigned)count);
    CHECK_MSG(hash_points() == hash, "%s: the discs have changed", name);
    CHECK_MSG(wrong == 0, "%s: %u of %d groups are not their members' sum", name, (unsigned)wrong, (int)groups.count);
    CHECK_MSG(fabs(stats.flux_grouped / flux - 1) < 1e-5 && fabs(stats.flux_lit / flux - 1) < 1e-5,
              "%s: %.9g of %.9g W", name, stats.flux_grouped, flux);
}

static void run_grouping(const char *name, const lmb_grouping *g)
{
    uint64_t hash = hash_points();
    uint32_t count = points.count;
    double flux = flux_of(0) + flux_of(1) + flux_of(2);
    memset(&stats, 0, sizeof stats);
    CHECK(lmb_group_points(&groups, &points, g, &stats) == LMB_OK);
    CHECK_MSG(groups.count > 0 && (g->groups == 0 || groups.count <= g->groups), "%s: %d groups", name,
              (int)groups.count);
    CHECK(stats.groups == (uint32_t)groups.count && stats.discs == count);
    check_groups(name, hash, count, flux);
}

/* Points of a furnished box under a light, joined to discs. */
static void room_points(int32_t size, int32_t block)
{
    lmb_light l = point_light(vec3(0.1f, 0.3f, -0.1f));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, block);
    make_room();
    clear_points();
    add_points(&l, size, &g, 1);
}

/* V17, V18: members lie within reach, and no later disc would have fitted a group that was already closed. The
 * barycentre moves as members join, so the first members may end up outside: the test allows three times the reach. */
static void check_greedy(float reach, float cosine)
{
    lmb_grouping g = grouping_of(LMB_GROUP_GREEDY, LMB_MAX_GROUPS, 8);
    uint32_t far = 0, bent = 0, missed = 0;
    float worst = 0.0f;
    g.reach = reach;
    g.cosine = cosine;
    room_points(SIDE / 2, 8);
    run_grouping("greedy", &g);
    CHECK_MSG(stats.regroups == 0, "%u restarts: the reach is not what was asked for", (unsigned)stats.regroups);
    for (int32_t k = 0; k < groups.count; ++k) {
        const lmb_point *m = points.data + groups.first[k];
        float radius = maxf((float)sqrt(area_of(m) / PI), 0.5f * m->distance) * reach;
        lmb_vec3 at = group_vec(groups.position, k), n = group_vec(groups.normal, k);
        for (uint32_t i = 0; i < points.count - groups.first[k]; ++i) {
            float away = length3(sub3(m[i].position, at)), agree = dot3(m[i].normal, n);
            if (i < groups.members[k]) {
                worst = maxf(worst, away / radius);
                far += away > 3.0f * radius;
                bent += agree < (4.0f * cosine * cosine - 3.0f) * cosine; /* three times the angle */
            } else {
                missed += away < radius * 0.9999f && agree > cosine + 1e-4f;
            }
        }
    }
    printf("  greedy: reach %g, cosine %g: %d groups, members within %.2f reaches\n", (double)reach, (double)cosine,
           (int)groups.count, (double)worst);
    CHECK_MSG(far == 0 && bent == 0, "%u too far, %u turned away", (unsigned)far, (unsigned)bent);
    CHECK_MSG(missed == 0, "%u discs fit an earlier group", (unsigned)missed);
}

/* V21: never more groups than requested. V20, V18: no light is lost. */
static void check_counts(int32_t method)
{
    static const int32_t wanted[] = {1, 2, 3, 5, 6, 7, 16, 33, 64, 200, 256, 1000, LMB_MAX_GROUPS};
    char name[64];
    printf("  %s:", method == LMB_GROUP_GREEDY ? "greedy" : "zones");
    for (int i = 0; i < COUNT(wanted); ++i) {
        lmb_grouping g = grouping_of(method, wanted[i], 8);
        if (wanted[i] > LMB_MAX_GROUPS) {
            continue;
        }
        room_points(SIDE / 2, 8);
        snprintf(name, sizeof name, "method %d, %d groups", (int)method, (int)wanted[i]);
        run_grouping(name, &g);
        printf(" %d/%d", (int)groups.count, (int)wanted[i]);
    }
    printf(" groups of %u discs\n", (unsigned)points.count);
}

/* More map faces than requested groups. */
static void check_many_faces(void)
{
    static const int32_t methods[] = {LMB_GROUP_ZONES, LMB_GROUP_GREEDY};
    for (int m = 0; m < COUNT(methods); ++m) {
        for (int32_t wanted = 1; wanted <= 8; ++wanted) {
            lmb_grouping g = grouping_of(methods[m], wanted, 8);
            make_box();
            clear_points();
            for (int i = 0; i < 5; ++i) {
                lmb_light l = point_light(vec3(0.15f * (float)i - 0.3f, 0.2f, 0.3f - 0.1f * (float)i));
                add_points(&l, 32, &g, 1);
            }
            CHECK(points.faces == 30);
            run_grouping("30 faces", &g);
        }
    }
}

/* V20: the number of zones follows g.zones, whatever the limit of groups. */
static void check_zone_count(void)
{
    lmb_light l = sun(vec3(0, -1, 0));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 90, 8);
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    CHECK(world_end() == LMB_OK);
    for (g.zones = 4; g.zones <= 64; g.zones *= 4) {
        clear_points();
        add_points(&l, SIDE, &g, 1);
        memset(&stats, 0, sizeof stats);
        CHECK(lmb_group_points(&groups, &points, &g, &stats) == LMB_OK && stats.regroups == 0);
        CHECK_MSG(groups.count >= g.zones && groups.count <= 9 * g.zones / 4, "%d zones: %d groups", (int)g.zones,
                  (int)groups.count);
    }
}

/* V20: a plate 1 m above a floor, in zones of 4x4 discs. Discs that do not fit open a second group; strict mode drops
 * and counts them. */
static void check_zones(void)
{
    lmb_light l = sun(vec3(0, -1, 0));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 200, 8);
    uint32_t mixed = 0, used = 0;
    uint8_t zones[8][8];
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    world_quad(vec3(0.13f, 1, 0.07f), mul3(Z, 0.41f), mul3(X, 0.41f));
    CHECK(world_end() == LMB_OK);
    g.neighbour_m = 0.3f; /* V9: plate and floor are no neighbours, so neither extends the other's reach */
    g.neighbour_cells = 1; /* V8: on the floor, adjacent cells only */
    clear_points();
    add_points(&l, SIDE, &g, 1);
    g.groups = (int32_t)(points.count / 10); /* 4x4 are the smallest zones that fit in this number of groups */
    run_grouping("zones", &g);
    CHECK(stats.regroups == 0);
    for (int32_t k = 0; k < groups.count; ++k) {
        const lmb_point *m = points.data + groups.first[k];
        for (uint32_t i = 0; i < groups.members[k]; ++i) {
            mixed += absf(m[i].position.y - m[0].position.y) > 0.1f;
            mixed += m[i].cell_x / 4 != m[0].cell_x / 4 || m[i].cell_y / 4 != m[0].cell_y / 4;
        }
    }
    int32_t whole = groups.count;
    CHECK_MSG(mixed == 0 && whole > 64, "%u members of another height or zone, %d groups", (unsigned)mixed, (int)whole);
    clear_points();
    add_points(&l, SIDE, &g, 1);
    g.flags = LMB_ZONES_STRICT;
    memset(&stats, 0, sizeof stats);
    memset(zones, 0, sizeof zones);
    CHECK(lmb_group_points(&groups, &points, &g, &stats) == LMB_OK);
    for (int32_t k = 0; k < groups.count; ++k) {
        used += groups.members[k];
        ++zones[points.data[groups.first[k]].cell_y / 4][points.data[groups.first[k]].cell_x / 4];
    }
    double dropped = 0.0;
    for (uint32_t i = used; i < points.count; ++i) {
        dropped += (double)points.data[i].flux[0] + (double)points.data[i].flux[1] + (double)points.data[i].flux[2];
    }
    CHECK_MSG(groups.count == 64, "%d groups of 64 zones", (int)groups.count);
    for (int z = 0; z < 64; ++z) {
        CHECK(zones[z / 8][z % 8] == 1);
    }
    printf("  zones: %d groups, or 64 strict ones that drop %.2f %%\n", (int)whole, dropped / stats.flux_lit * 100.0);
    CHECK(dropped > 0.0);
    CHECK_MSG(fabs(stats.flux_lit - stats.flux_grouped - dropped) < 1e-5 * stats.flux_lit, "%g %g",
              stats.flux_lit - stats.flux_grouped, dropped);
}

/* V22: a group's position is the first disc. */
static void check_point_centre(void)
{
    static const int32_t methods[] = {LMB_GROUP_ZONES, LMB_GROUP_GREEDY};
    for (int m = 0; m < COUNT(methods); ++m) {
        lmb_grouping g = grouping_of(methods[m], 64, 8);
        uint32_t elsewhere = 0, outside = 0;
        g.flags = LMB_POINT_CENTRE;
        room_points(SIDE / 2, 8);
        CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK);
        for (int32_t k = 0; k < groups.count; ++k) {
            const lmb_point *d = points.data + groups.first[k];
            lmb_vec3 at = group_vec(groups.position, k);
            elsewhere += memcmp(&at, &d->position, sizeof at) != 0;
            for (uint32_t i = 0; i < groups.members[k]; ++i) {
                lmb_vec3 corner = add3(add3(d[i].position, d[i].axis_u), d[i].axis_v);
                outside += length3(sub3(corner, at)) > groups.radius[k] * 1.00001f;
            }
        }
        CHECK_MSG(elsewhere == 0 && outside == 0, "%u not at their first disc, %u corners outside", (unsigned)elsewhere,
                  (unsigned)outside);
    }
}

/* V14: one group per disc if they fit, otherwise an error; bad arguments. */
static void check_group_limits(void)
{
    lmb_grouping g = grouping_of(LMB_GROUP_NONE, 0, 8);
    lmb_light l = spot(vec3(0, 0.8f, 0), vec3(0, -1, 0), 20, 35);
    make_box();
    clear_points();
    add_points(&l, 128, &g, 1);
    CHECK(points.count < LMB_MAX_GROUPS);
    run_grouping("none", &g);
    CHECK((uint32_t)groups.count == points.count);
    l = point_light(vec3(0, 0, 0));
    clear_points();
    add_points(&l, SIDE, &g, 1);
    CHECK(points.count > LMB_MAX_GROUPS && lmb_group_points(&groups, &points, &g, NULL) == LMB_ERR_CAPACITY);
    g.groups = LMB_MAX_GROUPS + 1;
    CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_ERR_ARG);
    g = grouping_of(3, 0, 8);
    CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_ERR_ARG);
    g = grouping_of(LMB_GROUP_ZONES, 16, 8);
    points.count = 0;
    CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK && groups.count == 0);
}

/* Grouping is repeatable, whatever the scratch member held. */
static void check_repeats(void)
{
    static const int32_t methods[] = {LMB_GROUP_ZONES, LMB_GROUP_GREEDY};
    static lmb_groups before;
    for (int m = 0; m < COUNT(methods); ++m) {
        lmb_grouping g = grouping_of(methods[m], 90, 8);
        uint64_t hash;
        memset(&groups, 0, sizeof groups);
        room_points(SIDE / 2, 8);
        CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK);
        before = groups;
        hash = hash_points();
        memset(&groups, 0, sizeof groups);
        room_points(SIDE / 2, 8);
        for (uint32_t i = 0; i < points.count; ++i) {
            points.data[i].link = i * 2654435761u;
        }
        CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK);
        CHECK(hash_points() == hash && memcmp(&before, &groups, sizeof groups) == 0);
        g.groups = 10; /* discs that were already grouped */
        run_grouping("again", &g);
    }
}

/* --- fewer discs than points -------------------------------------------------------------------------------------- */

/* Squared distance in cells from each disc to the nearest of the same face. */
static int32_t least_step(void)
{
    int32_t min = 1 << 20;
    for (uint32_t i = 0; i < points.count; ++i) {
        for (uint32_t j = i + 1; j < points.count; ++j) {
            int32_t x = points.data[i].cell_x - points.data[j].cell_x;
            int32_t y = points.data[i].cell_y - points.data[j].cell_y;
            min = x * x + y * y < min ? x * x + y * y : min;
        }
    }
    return min;
}

/* V14, V15: a plane of 32 x 32 points thinned to one disc per `thin` points. The spacing is nearly even, discs keep the
 * map's order and cells, each has the light of about the same number of points, and no light is lost. */
static void check_thinned_plane(int32_t thin)
{
    const int32_t side = SIDE / 8, all = side * side;
    lmb_light l = sun(vec3(0, -1, 0));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    uint32_t disordered = 0;
    float max = 0.0f;
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    CHECK(world_end() == LMB_OK);
    clear_points();
    add_points(&l, SIDE, &g, 0);
    double flux = flux_of(0), area = total_area();
    CHECK(points.count == (uint32_t)all);
    g.thin = thin;
    clear_points();
    add_points(&l, SIDE, &g, 1);
    int32_t count = (int32_t)points.count;
    CHECK_MSG(count * thin > all - side * thin / 2 && count * thin < all + side * thin / 2, "1 of %d: %d of %d",
              (int)thin, (int)count, (int)all);
    CHECK_MSG((double)least_step() >= 0.66 * thin, "1 of %d: %d", (int)thin, (int)least_step());
    CHECK_MSG(fabs(flux_of(0) / flux - 1) < 1e-6 && fabs(total_area() / area - 1) < 1e-5, "1 of %d: %g %g", (int)thin,
              flux_of(0) / flux - 1, total_area() / area - 1);
    for (int32_t i = 0; i < count; ++i) {
        const lmb_point *p = &points.data[i];
        disordered += i > 0 && p->cell_y * side + p->cell_x <= p[-1].cell_y * side + p[-1].cell_x;
        max = maxf(max, is_inner(p, side) ? p->flux[0] : 0.0f);
    }
    CHECK(disordered == 0);
    CHECK_MSG((double)max < 2.5 * thin * flux / all, "1 of %d: one has %g times a point's", (int)thin,
              (double)max * all / flux);
}

/* In a room: each surface keeps a disc, normals stay within the limit for one surface, and no light is lost. */
static void check_thinned_room(void)
{
    lmb_light l = point_light(vec3(0.1f, 0.3f, -0.1f));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    uint32_t off = 0;
    make_box();
    clear_points();
    add_points(&l, SIDE, &g, 0);
    double flux = flux_of(1), area = total_area();
    uint32_t before = points.count;
    g.thin = 10;
    clear_points();
    add_points(&l, SIDE, &g, 1);
    for (uint32_t i = 0; i < points.count; ++i) {
        lmb_vec3 q = points.data[i].position;
        off += absf(dot3(points.data[i].normal, q) + 1.0f) > 1e-5f; /* walls do not mix */
    }
    CHECK_MSG(off == 0, "%u off the walls", (unsigned)off);
    CHECK_MSG(fabs(flux_of(1) / flux - 1) < 1e-6 && fabs(total_area() / area - 1) < 1e-5, "%g", flux_of(1) / flux - 1);
    CHECK_MSG(points.count > before / 11 && points.count < before / 5, "%u of %u", (unsigned)points.count,
              (unsigned)before);
    run_grouping("thinned", &g);
    printf("  discs: 1 of 10 leaves %u of %u in a box, %d groups\n", (unsigned)points.count, (unsigned)before,
           (int)groups.count);
}

static void check_thin_limits(void)
{
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 0, 8);
    static const int32_t bad[] = {-1, LMB_MAX_THIN + 1};
    for (int i = 0; i < COUNT(bad); ++i) {
        g.thin = bad[i];
        hand_points();
        CHECK(lmb_discs_join(&points, &map, &g) == LMB_ERR_ARG && points.count == 5);
        CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_ERR_ARG && points.count == 5);
    }
}

static void test_thinning(void)
{
    static const int32_t thin[] = {1, 2, 3, 5, 10, 33, LMB_MAX_THIN};
    for (int i = 0; i < COUNT(thin); ++i) {
        check_thinned_plane(thin[i]);
    }
    check_thinned_room();
    check_thin_limits();
}

static void test_groups(void)
{
    test_thinning();
    if (LMB_MAX_GROUPS >= 512) {
        check_greedy(3.0f, 0.9f);
        check_greedy(2.0f, 0.95f);
        check_greedy(5.0f, 0.7f);
        check_zones();
        check_zone_count();
        check_group_limits();
    } else {
        SKIP("grouping by reach, zones one by one: %d groups are too few to tell", LMB_MAX_GROUPS);
    }
    check_counts(LMB_GROUP_GREEDY);
    check_counts(LMB_GROUP_ZONES);
    check_many_faces();
    check_point_centre();
    check_repeats();
}

/* --- form factors ------------------------------------------------------------------------------------------------- */

static lmb_vec3 random_unit(test_rng *r)
{
    for (;;) {
        lmb_vec3 v = vec3(test_uniform(r, -1, 1), test_uniform(r, -1, 1), test_uniform(r, -1, 1));
        float d2 = dot3(v, v);
        if (d2 > 0.01f && d2 <= 1.0f) {
            return normalize3(v);
        }
    }
}

static void basis(lmb_vec3 *u, lmb_vec3 *v, lmb_vec3 n)
{
    *u = normalize3(cross3(absf(n.x) < 0.7f ? X : Y, n));
    *v = cross3(n, *u);
}

/* cosP cosG / (pi r^2), 0 if either faces away. */
static double point_factor(lmb_vec3 at, lmb_vec3 n, const double q[3], lmb_vec3 axis)
{
    double x = q[0] - (double)at.x, y = q[1] - (double)at.y, z = q[2] - (double)at.z, r2 = x * x + y * y + z * z;
    double a = x * (double)n.x + y * (double)n.y + z * (double)n.z;
    double b = -(x * (double)axis.x + y * (double)axis.y + z * (double)axis.z);
    return a > 0 && b > 0 ? a * b / (PI * r2 * r2) : 0.0;
}

/* Mean over a disc of radius 1: Gauss quadrature in the squared radius, equal steps in angle. */
static double disc_truth(lmb_vec3 at, lmb_vec3 n, lmb_vec3 centre, lmb_vec3 axis)
{
    static const double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    double sum = 0.0;
    lmb_vec3 u, v;
    basis(&u, &v, axis);
    for (int i = 0; i < 8; ++i) {
        double r = sqrt(0.5 + 0.5 * (i & 1 ? -node[i / 2] : node[i / 2]));
        for (int j = 0; j < 64; ++j) {
            double x = r * cos(2 * PI * j / 64), y = r * sin(2 * PI * j / 64), q[3];
            q[0] = (double)centre.x + x * (double)u.x + y * (double)v.x;
            q[1] = (double)centre.y + x * (double)u.y + y * (double)v.y;
            q[2] = (double)centre.z + x * (double)u.z + y * (double)v.z;
            sum += 0.5 * weight[i / 2] / 64 * point_factor(at, n, q, axis);
        }
    }
    return sum;
}

/* A receiver at the origin and a disc of radius 1 at distance r. The disc is entirely above the receiver's horizon and
 * faces the receiver. */
typedef struct pair {
    lmb_vec3 normal, centre, axis;
} pair;

static pair random_pair(test_rng *r, float distance)
{
    for (;;) {
        pair p;
        p.normal = random_unit(r);
        p.centre = mul3(random_unit(r), distance);
        p.axis = random_unit(r);
        float g = dot3(p.normal, p.axis), dip = sqrtf(maxf(1.0f - g * g, 0.0f));
        if (dot3(p.normal, p.centre) > dip && dot3(p.axis, p.centre) < 0.0f) {
            return p;
        }
    }
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Error of the formula as measured when it was chosen: 1.6 / 0.4 / 0.05 / 0.01 % at 2-3 / 3-5 / 5-8 / 8-12 radii. */
static void check_disc_error(float near_r, float far_r, double bound)
{
    enum { TRIES = 1000 };
    static double error[TRIES];
    test_rng rng = {UINT64_C(0x9e3779b97f4a7c15)};
    double mean = 0.0;
    for (int i = 0; i < TRIES; ++i) {
        pair p = random_pair(&rng, test_uniform(&rng, near_r, far_r));
        double want = disc_truth(vec3(0, 0, 0), p.normal, p.centre, p.axis);
        error[i] = fabs((double)lmb_disc_factor(vec3(0, 0, 0), p.normal, p.centre, p.axis, (float)PI) / want - 1.0);
        mean += error[i] / TRIES;
    }
    qsort(error, TRIES, sizeof *error, compare_doubles);
    printf("  disc at %g-%g radii: median %.4f %%, mean %.4f %%, 99 %% under %.3f %%\n", (double)near_r, (double)far_r,
           error[TRIES / 2] * 100, mean * 100, error[TRIES * 99 / 100] * 100);
    CHECK_MSG(error[TRIES / 2] < bound, "%g", error[TRIES / 2]);
    CHECK_MSG(mean < 3.0 * bound, "%g", mean);
}

/* The error is of second order in s = A / (pi r^2): 16 times smaller at twice the distance. */
static void check_disc_order(void)
{
    enum { TRIES = 400 };
    static double ratio[TRIES];
    test_rng rng = {77};
    for (int i = 0; i < TRIES; ++i) {
        pair p = random_pair(&rng, 6.0f);
        double e[2];
        for (int k = 0; k < 2; ++k) {
            lmb_vec3 c = mul3(p.centre, k ? 2.0f : 1.0f);
            double want = disc_truth(vec3(0, 0, 0), p.normal, c, p.axis);
            e[k] = fabs((double)lmb_disc_factor(vec3(0, 0, 0), p.normal, c, p.axis, (float)PI) / want - 1.0);
        }
        ratio[i] = e[0] / (e[1] + 1e-9);
    }
    qsort(ratio, TRIES, sizeof *ratio, compare_doubles);
    printf("  disc, twice as far: error %.1f times less (second order: 16)\n", ratio[TRIES / 2]);
    CHECK_MSG(ratio[TRIES / 2] > 11 && ratio[TRIES / 2] < 22, "%g", ratio[TRIES / 2]);
}

static void check_disc_limits(void)
{
    test_rng rng = {5};
    uint32_t over = 0, seen = 0, negative = 0;
    for (int i = 1; i < 200; ++i) { /* exact on the axis */
        float r = 0.05f * (float)i;
        double want = 1.0 / (PI * (double)r * (double)r + PI);
        float got = lmb_disc_factor(vec3(0, 0, 0), Z, vec3(0, 0, r), vec3(0, 0, -1), (float)PI);
        CHECK_MSG(fabs((double)got / want - 1) < 2e-6, "at %g: %g, want %g", (double)r, (double)got, want);
    }
    for (int i = 0; i < 40000; ++i) {
        float r = (float)pow(10.0, (double)test_uniform(&rng, -3, 2));
        lmb_vec3 n = random_unit(&rng), c = mul3(random_unit(&rng), r), axis = random_unit(&rng);
        float f = lmb_disc_factor(vec3(0, 0, 0), n, c, axis, (float)PI);
        over += !(f <= (float)(1.0 / PI) * 1.00001f);
        negative += !(f >= 0.0f);
        seen += f != 0.0f && (dot3(n, c) <= 0.0f || dot3(axis, c) >= 0.0f);
    }
    CHECK_MSG(over == 0 && negative == 0, "%u over M / A, %u negative", (unsigned)over, (unsigned)negative);
    CHECK_MSG(seen == 0, "%u face away and are lit", (unsigned)seen);
    CHECK(lmb_disc_factor(vec3(0, 0, 0), Z, vec3(0, 0, 0), Z, 1.0f) == 0.0f);
}

static double quad_truth(lmb_vec3 at, lmb_vec3 n, lmb_vec3 centre, lmb_vec3 axis, lmb_vec3 u, lmb_vec3 v)
{
    enum { STEPS = 400 };
    double sum = 0.0;
    for (int j = 0; j < STEPS; ++j) {
        for (int i = 0; i < STEPS; ++i) {
            double a = (2.0 * i + 1.0) / STEPS - 1.0, b = (2.0 * j + 1.0) / STEPS - 1.0, q[3];
            q[0] = (double)centre.x + a * (double)u.x + b * (double)v.x;
            q[1] = (double)centre.y + a * (double)u.y + b * (double)v.y;
            q[2] = (double)centre.z + a * (double)u.z + b * (double)v.z;
            sum += point_factor(at, n, q, axis);
        }
    }
    return sum / ((double)STEPS * STEPS);
}

/* A square of 2 m a side around the origin. */
static float quad_from(lmb_vec3 at, lmb_vec3 n, lmb_vec3 axis)
{
    return lmb_quad_factor(at, n, n, vec3(0, 0, 0), axis, X, Y);
}

/* Random orientations, including parallelograms; the horizon often cuts the quad. */
static void check_quads(void)
{
    enum { QUADS = 50 };
    test_rng rng = {99};
    double worst = 0.0;
    uint32_t clipped = 0;
    for (int i = 0; i < QUADS; ++i) {
        lmb_vec3 axis = random_unit(&rng), n = random_unit(&rng), u, v;
        basis(&u, &v, axis);
        v = add3(mul3(v, test_uniform(&rng, 0.2f, 1)), mul3(u, test_uniform(&rng, -0.5f, 0.5f)));
        lmb_vec3 at = add3(mul3(axis, test_uniform(&rng, 0.1f, 3)), mul3(random_unit(&rng), 0.05f));
        at = add3(at, add3(mul3(u, test_uniform(&rng, -2, 2)), mul3(v, test_uniform(&rng, -2, 2))));
        int above = 0;
        for (int c = 0; c < 4; ++c) {
            lmb_vec3 corner = add3(mul3(u, c & 1 ? 1.0f : -1.0f), mul3(v, c & 2 ? 1.0f : -1.0f));
            above += dot3(n, sub3(corner, at)) > 0.0f;
        }
        clipped += above > 0 && above < 4;
        double area = 4.0 * (double)length3(cross3(u, v));
        double want = quad_truth(at, n, vec3(0, 0, 0), axis, u, v);
        worst = fmax(worst, area * fabs((double)lmb_quad_factor(at, n, n, vec3(0, 0, 0), axis, u, v) - want));
    }
    printf("  quad: form factor within %.1e of the integral, %u of %d cut by the horizon\n", worst, (unsigned)clipped, QUADS);
    CHECK_MSG(worst < 1e-3, "%g", worst);
    CHECK(clipped > QUADS / 10);
    CHECK(quad_from(vec3(0, 0, 1), vec3(0, 0, -1), vec3(0, 0, -1)) == 0.0f);                 /* emitter turned away */
    CHECK(quad_from(vec3(0, 0, 1), Z, Z) == 0.0f);                                           /* receiver */
    CHECK(quad_from(vec3(0, 0, 0), Z, Z) == 0.0f && quad_from(vec3(3, 0, 0), X, Z) == 0.0f); /* the quad's own plane */
    /* When it touches the quad, the quad fills the hemisphere. */
    CHECK(absf(4.0f * quad_from(vec3(0, 0, 0.004f), vec3(0, 0, -1), Z) - 1.0f) < 1e-3f);
}

static void test_factors(void)
{
    check_disc_error(2, 3, 0.025);
    check_disc_error(3, 5, 0.006);
    check_disc_error(5, 8, 0.0008);
    check_disc_error(8, 12, 0.00016);
    check_disc_order();
    check_disc_limits();
    check_quads();
}

/* --- the gather of a tile ----------------------------------------------------------------------------------------- */

static lmb_gather_scratch gather_scratch;

/* 64 random surface points around the origin; the last two have no surface. */
static void random_tile(test_rng *rng)
{
    memset(&tile, 0, sizeof tile);
    for (int k = 0; k < LMB_TILE_PIXELS - 2; ++k) {
        lmb_vec3 n = random_unit(rng);
        set_plane(tile.position, k, mul3(random_unit(rng), test_uniform(rng, 0, 1)));
        set_plane(tile.normal, k, n);
        set_plane(tile.face, k, n);
        tile.depth[k] = 1.0f;
        tile.id[k] = 1;
        ++tile.hits;
    }
}

/* The flux differs per channel. */
static void emit(int32_t k, lmb_vec3 at, lmb_vec3 axis, float area, float radius, float flux)
{
    set_group(&groups, k, at, axis, area, radius);
    for (int c = 0; c < 3; ++c) {
        groups.flux[c][k] = flux * (float)(c + 1);
    }
}

static void gather(lmb_irradiance *out, const lmb_points *p, const lmb_occluder *o)
{
    memset(out, 0, sizeof *out);
    CHECK(lmb_gather_tile(out, picked_kernels(), &gather_scratch, &tile, &groups, p, o) == LMB_OK);
}

/* V27, V28: far groups in sequence. */
static void check_far(void)
{
    test_rng rng = {11};
    lmb_irradiance got, want;
    memset(&want, 0, sizeof want);
    random_tile(&rng);
    groups.count = 50;
    for (int32_t k = 0; k < groups.count; ++k) {
        emit(k, mul3(random_unit(&rng), test_uniform(&rng, 2, 9)), random_unit(&rng), test_uniform(&rng, 0.1f, 0.5f),
             0.4f, test_uniform(&rng, 0.1f, 9));
    }
    for (int32_t j = 0; j < groups.count; ++j) {
        for (int k = 0; k < LMB_TILE_PIXELS - 2; ++k) {
            float f = lmb_disc_factor(plane_vec(tile.position, k), plane_vec(tile.normal, k),
                                      group_vec(groups.position, j), group_vec(groups.normal, j), groups.area[j]);
            for (int c = 0; c < 3; ++c) {
                want.rgb[c][k] += f * groups.flux[c][j];
            }
        }
    }
    gather(&got, NULL, NULL);
    CHECK(memcmp(&got, &want, sizeof got) == 0);
    CHECK(got.rgb[0][LMB_TILE_PIXELS - 1] == 0.0f && got.rgb[0][0] > 0.0f);
    /* A back-facing face receives nothing, whatever the shading normal. */
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.face, k, mul3(plane_vec(tile.normal, k), -1.0f));
    }
    gather(&got, NULL, NULL);
    float sum = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        sum += got.rgb[0][k];
    }
    CHECK(sum == 0.0f);
}

/* A plate of 8x8 discs, 2 m a side, as one group over the origin. */
static void plate_points(float y)
{
    clear_points();
    groups.count = 1;
    emit(0, vec3(0, y, 0), vec3(0, -1, 0), 4.0f, 1.4142136f, 8.0f);
    groups.members[0] = 64;
    for (int i = 0; i < 64; ++i) {
        lmb_vec3 at = vec3(0.25f * (float)(i % 8) - 0.875f, y, 0.25f * (float)(i / 8) - 0.875f);
        set_disc(&points.data[points.count++], at, vec3(0, -1, 0), mul3(X, 0.125f), mul3(Z, 0.125f),
                 0.0625f * (float)(1 + i % 3));
    }
}

/* V27: the sum over the discs; within LMB_NEAR half-diagonals they count as quads. */
static double sum_discs(int *quads, lmb_vec3 at, lmb_vec3 n)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < points.count; ++i) {
        const lmb_point *p = &points.data[i];
        lmb_vec3 d = sub3(p->position, at);
        int is_near = dot3(d, d) < 2.0f * 0.125f * 0.125f * LMB_NEAR * LMB_NEAR;
        float f = is_near ? lmb_quad_factor(at, n, n, p->position, p->normal, p->axis_u, p->axis_v)
                          : lmb_disc_factor(at, n, p->position, p->normal, 0.0625f);
        *quads += is_near;
        sum += (double)p->flux[0] * (double)f;
    }
    return sum;
}

/* A pixel within a group's radius is lit by the group's discs, one by one. */
static void check_near(void)
{
    test_rng rng = {12};
    lmb_irradiance got, without;
    double worst = 0.0;
    int quads = 0;
    float alone = 0.0f;
    for (int round = 0; round < 400; ++round) {
        random_tile(&rng);
        plate_points(test_uniform(&rng, 0.04f, 0.5f)); /* lower ones are lit from a height (FLAT_PART) */
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float x = test_uniform(&rng, -0.5f, 0.5f), z = test_uniform(&rng, -0.5f, 0.5f);
            set_plane(tile.position, k, vec3(x, 0, z));
        }
        gather(&got, &points, NULL);
        gather(&without, NULL, NULL);
        for (int k = 0; k < LMB_TILE_PIXELS - 2; ++k) {
            double want = sum_discs(&quads, plane_vec(tile.position, k), plane_vec(tile.normal, k));
            worst = fmax(worst, fabs((double)got.rgb[0][k] - want) / (want + 1e-3));
            alone = maxf(alone, without.rgb[0][k]);
        }
    }
    printf("  near: tile within %.1e of its discs' factors, %d of them quads\n", worst, quads);
    CHECK_MSG(worst < 1e-5, "%g", worst);
    CHECK(quads > 1000 && alone == 0.0f); /* without discs, near groups add nothing */
}

/* Pixels that face down below the ceiling of the box, from height `low` up. */
static void ceiling_tile(float low)
{
    test_rng rng = {15};
    random_tile(&rng);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float x = test_uniform(&rng, -0.9f, 0.9f), y = test_uniform(&rng, low, 0.9f);
        float z = test_uniform(&rng, -0.9f, 0.9f);
        set_plane(tile.position, k, vec3(x, y, z));
        set_plane(tile.normal, k, vec3(0, -1, 0));
        set_plane(tile.face, k, vec3(0, -1, 0));
    }
}

/* The light of a lit patch of floor, grouped by method and k, with or without discs. */
static void gather_level(lmb_irradiance *out, int32_t method, float join, int discs, float low)
{
    lmb_light l = spot(vec3(0, 0.9f, 0), vec3(0, -1, 0), 20, 25);
    lmb_grouping g = grouping_of(method, 60, 8);
    g.join = join;
    clear_points();
    add_points(&l, SIDE / 2, &g, 1);
    CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK);
    ceiling_tile(low);
    gather(out, discs ? &points : NULL, NULL);
}

static double largest_difference(const lmb_irradiance *a, const lmb_irradiance *b)
{
    double worst = 0.0;
    for (int k = 0; k < LMB_TILE_PIXELS - 2; ++k) {
        worst = fmax(worst, fabs((double)a->rgb[0][k] / (double)b->rgb[0][k] - 1.0));
    }
    return worst;
}

/* V27: first points, discs, groups, or a mix (far groups, near discs) may light a pixel. From afar all agree; near by,
 * groups without discs add nothing. */
static void check_levels(void)
{
    lmb_irradiance by_points, by_discs, by_groups, mixed;
    make_box();
    gather_level(&by_points, LMB_GROUP_NONE, 1e-30f, 1, 0.0f);
    int32_t first = groups.count;
    gather_level(&by_discs, LMB_GROUP_NONE, 1.0f, 1, 0.0f);
    int32_t second = groups.count;
    gather_level(&by_groups, LMB_GROUP_ZONES, 1.0f, 0, 0.0f);
    CHECK_MSG(first > second && second > groups.count, "%d points, %d discs, %d groups", (int)first, (int)second,
              (int)groups.count);
    CHECK_MSG(largest_difference(&by_discs, &by_points) < 0.01, "%g", largest_difference(&by_discs, &by_points));
    CHECK_MSG(largest_difference(&by_groups, &by_points) < 0.02, "%g", largest_difference(&by_groups, &by_points));
    gather_level(&by_points, LMB_GROUP_NONE, 1e-30f, 1, -0.95f);
    gather_level(&mixed, LMB_GROUP_ZONES, 1.0f, 1, -0.95f);
    gather_level(&by_groups, LMB_GROUP_ZONES, 1.0f, 0, -0.95f);
    CHECK_MSG(largest_difference(&mixed, &by_points) < 0.15, "%g", largest_difference(&mixed, &by_points));
    CHECK_MSG(largest_difference(&by_groups, &by_points) > 0.5, "%g", largest_difference(&by_groups, &by_points));
}

/* V16: a square, a long rectangle and an oval's quad of equal area give the same bytes from afar and differ near by. */
static void check_shapes(void)
{
    static const float sides[3][2] = {{0.125f, 0.125f}, {0.5f, 0.03125f}, {0.25f, 0.0625f}};
    test_rng rng = {14};
    lmb_irradiance far[3], near[3];
    random_tile(&rng);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.position, k, vec3(test_uniform(&rng, -0.3f, 0.3f), 0, test_uniform(&rng, -0.3f, 0.3f)));
    }
    for (int s = 0; s < 3; ++s) {
        clear_points();
        set_disc(&points.data[points.count++], vec3(0, 3, 0), vec3(0, -1, 0), mul3(X, sides[s][0]),
                 mul3(Z, sides[s][1]), 2.0f);
        lmb_grouping g = grouping_of(LMB_GROUP_NONE, 0, 8);
        CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK && groups.area[0] == 0.0625f);
        gather(&far[s], &points, NULL);
        points.data[0].position.y = 0.2f;
        CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK);
        gather(&near[s], &points, NULL);
    }
    CHECK(memcmp(&far[0], &far[1], sizeof far[0]) == 0 && memcmp(&far[0], &far[2], sizeof far[0]) == 0);
    CHECK(memcmp(&near[0], &near[1], sizeof near[0]) != 0 && memcmp(&near[0], &near[2], sizeof near[0]) != 0);
    float max = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        max = maxf(max, far[0].rgb[0][k]);
    }
    CHECK(max > 0.0f);
}

static void check_linear(const lmb_occluder *o)
{
    lmb_irradiance once, twice;
    uint32_t wrong = 0, lit = 0;
    gather(&once, &points, o);
    for (int32_t k = 0; k < groups.count; ++k) {
        for (int c = 0; c < 3; ++c) {
            groups.flux[c][k] *= 2.0f;
        }
    }
    for (uint32_t i = 0; i < points.count; ++i) {
        for (int c = 0; c < 3; ++c) {
            points.data[i].flux[c] *= 2.0f;
        }
    }
    gather(&twice, &points, o);
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            wrong += twice.rgb[c][k] != 2.0f * once.rgb[c][k];
            lit += once.rgb[c][k] > 0.0f;
        }
    }
    CHECK_MSG(wrong == 0 && lit > 0, "%u values not exactly doubled", (unsigned)wrong);
}

static void check_gather_arguments(void)
{
    lmb_irradiance out;
    lmb_occluder o;
    const lmb_kernels *k = picked_kernels();
    memset(&out, 0, sizeof out);
    memset(&o, 0, sizeof o);
    CHECK(lmb_gather_tile(NULL, k, &gather_scratch, &tile, &groups, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_gather_tile(&out, k, NULL, &tile, &groups, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_gather_tile(&out, k, &gather_scratch, &tile, NULL, NULL, NULL) == LMB_ERR_ARG);
    o.kind = LMB_OCCLUSION_VIEW; /* without a view */
    o.steps = 12;
    CHECK(lmb_gather_tile(&out, k, &gather_scratch, &tile, &groups, NULL, &o) == LMB_ERR_ARG);
}

static void test_gather(void)
{
    test_rng rng = {13};
    check_far();
    check_near();
    check_shapes();
    if (LMB_MAX_GROUPS >= 512) {
        check_levels();
    } else {
        SKIP("points one by one: %d groups are too few", LMB_MAX_GROUPS);
    }
    random_tile(&rng);
    plate_points(0.3f);
    check_linear(NULL);
    check_gather_arguments();
}

/* --- occlusion ---------------------------------------------------------------------------------------------------- */

static uint32_t depth_memory[FRAME * FRAME], id_memory[FRAME * FRAME];
static lmb_target eye;
static float picture[2][FRAME * FRAME];
static lmb_vec3 seen_at[FRAME * FRAME];
static uint32_t seen_id[FRAME * FRAME];

static lmb_view look_near(lmb_vec3 from, lmb_vec3 target, double fov_deg)
{
    lmb_view v = look(from, target, fov_deg, FRAME);
    v.near_m = 0.05f;
    v.far_m = 50.0f;
    return v;
}

static void draw_view(const lmb_view *v, int32_t format)
{
    eye = target_of(format, FRAME, depth_memory, id_memory);
    world_draw(&eye, v, 0);
}

/* Red irradiance of every pixel for a kind of occlusion. */
static void gather_view(float *out, const lmb_view *v, int32_t kind, int32_t steps)
{
    lmb_occluder o;
    o.view = v;
    o.depth = &eye.depth;
    o.kind = kind;
    o.steps = steps;
    for (int32_t y = 0; y < FRAME; y += LMB_TILE) {
        for (int32_t x = 0; x < FRAME; x += LMB_TILE) {
            lmb_irradiance e;
            CHECK(lmb_resolve_tile(&tile, picked_kernels(), v, &world.scene, &eye, x, y) == LMB_OK);
            gather(&e, &points, &o);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                int32_t at = (y + k / LMB_TILE) * FRAME + x + k % LMB_TILE;
                out[at] = e.rgb[0][k];
                seen_at[at] = plane_vec(tile.position, k);
                seen_id[at] = tile.id[k];
            }
        }
    }
}

/* One emitter, small enough to count as far everywhere. */
static void one_emitter(lmb_vec3 at, lmb_vec3 axis)
{
    clear_points();
    groups.count = 1;
    emit(0, at, normalize3(axis), 1e-4f, 1e-3f, 1.0f);
}

/* V25, V26: a wall at x = 0, seen from the lit side, between floor pixels at x > 0 and an emitter at x < 0. */
static void check_wall(int32_t kind, int32_t format, int32_t steps)
{
    const lmb_vec3 from = {-1, 0.6f, 0};
    lmb_view v = look_near(vec3(2.5f, 1.8f, 1.5f), vec3(0.3f, 0.3f, 0), 55);
    int hidden = 0, leaks = 0, open = 0, lost = 0;
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 3), mul3(X, 3));
    world_quad(vec3(0, 0.4f, 0), mul3(Y, 0.4f), mul3(Z, 0.8f));
    CHECK(world_end() == LMB_OK);
    draw_view(&v, format);
    one_emitter(from, X);
    gather_view(picture[0], &v, LMB_OCCLUSION_NONE, 12);
    gather_view(picture[1], &v, kind, steps);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        lmb_vec3 p = seen_at[i];
        if (seen_id[i] == 0 || seen_id[i] > 2 || p.x < 0.1f || picture[0][i] == 0.0f) {
            continue;
        }
        lmb_vec3 at = add3(from, mul3(sub3(p, from), 1.0f / (p.x + 1.0f))); /* the segment's crossing of x = 0 */
        int inside = at.y < 0.75f && absf(at.z)<0.75f, past = at.y> 0.85f || absf(at.z) > 0.85f;
        hidden += inside;
        leaks += inside && picture[1][i] != 0.0f;
        open += past;
        lost += past && picture[1][i] == 0.0f;
    }
    printf("  wall, %s, D%d, %d steps: %d of %d hidden pixels lit, %d of %d open ones dark\n",
           kind == LMB_OCCLUSION_VIEW   ? "view"
           : kind == LMB_OCCLUSION_NONE ? "none"
                                        : "view-world",
           format == LMB_DEPTH32F ? 32 : 16, (int)steps, leaks, hidden, lost, open);
    CHECK(hidden > 500 && open > 100);
    if (kind == LMB_OCCLUSION_NONE) {
        CHECK(leaks == hidden && lost == 0);
    } else {
        /* The wall is thin but is assumed to have thickness, so most segments that pass close behind it are lost.
         * check_screen tests that distant ones stay open. */
        CHECK_MSG(leaks * 100 <= hidden, "%d of %d", leaks, hidden);
        CHECK_MSG(lost < open, "%d of %d", lost, open);
    }
}

/* A small plate close to the viewer covers parts of segments far behind it but must block none. */
static void check_screen(int32_t kind)
{
    const lmb_vec3 eye_at = {2.5f, 1.8f, 1.5f}, plate_at = {1.95f, 1.5f, 1.125f};
    lmb_view v = look_near(eye_at, vec3(0.3f, 0.3f, 0), 55);
    int lost = 0, seen = 0, hidden = 0;
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 3), mul3(X, 3));
    world_quad(plate_at, mul3(normalize3(cross3(v.back, Y)), 0.05f), mul3(Y, 0.05f));
    CHECK(world_end() == LMB_OK);
    draw_view(&v, LMB_DEPTH32F);
    one_emitter(vec3(-1, 0.6f, 0), X);
    gather_view(picture[0], &v, LMB_OCCLUSION_NONE, 12);
    gather_view(picture[1], &v, kind, 32);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        hidden += seen_id[i] > 2;
        if (seen_id[i] == 1 || seen_id[i] == 2) {
            seen += picture[0][i] > 0.0f;
            lost += picture[1][i] != picture[0][i];
        }
    }
    /* If a segment leaves the floor right at the plate's rim in the picture, its last sample may block it. */
    CHECK_MSG(seen > 1000 && hidden > 50 && lost * 500 < seen, "%d of %d dark behind a plate of %d pixels", lost, seen,
              hidden);
}

/* A floor seen at 1 to 5 degrees under an emitter, with nothing in between. */
static void check_grazing(int32_t kind, int32_t format, int orthographic)
{
    static const double degrees[] = {1, 2, 3, 5, 20};
    int dark = 0, seen = 0;
    begin_coloured(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 8), mul3(X, 8));
    CHECK(world_end() == LMB_OK);
    for (int d = 0; d < COUNT(degrees); ++d) {
        for (int e = 0; e < 5; ++e) {
            double a = degrees[d] * PI / 180;
            lmb_view v = look_near(vec3(0, (float)(5.0 * sin(a)), (float)(5.0 * cos(a))), vec3(0, 0, 0), 40);
            if (orthographic) {
                v.kind = LMB_ORTHOGRAPHIC;
                v.half_width = v.half_height = 2.0f;
            }
            draw_view(&v, format);
            one_emitter(vec3((float)(e - 2) * 0.9f, 0.5f + 0.6f * (float)e, 1.3f - 0.8f * (float)e), vec3(0, -1, 0));
            gather_view(picture[0], &v, LMB_OCCLUSION_NONE, 12);
            gather_view(picture[1], &v, kind, 12);
            for (int i = 0; i < FRAME * FRAME; ++i) {
                seen += picture[0][i] > 0.0f;
                dark += picture[1][i] != picture[0][i];
            }
        }
    }
    CHECK_MSG(dark == 0 && seen > 1000, "kind %d, format %d, %s: %d of %d pixels of a bare floor are dark", (int)kind,
              (int)format, orthographic ? "orthographic" : "perspective", dark, seen);
}

/* 16-bit depth agrees with 32-bit depth, compared for each pixel and emitter. */
static void check_depth_formats(int32_t kind, int orthographic)
{
    test_rng rng = {21};
    lmb_view v = look_near(vec3(0.7f, 0.5f, 0.8f), vec3(-0.2f, -0.5f, -0.3f), 75);
    int pairs = 0, differ = 0, hidden = 0;
    make_room();
    v.far_m = 4.0f;
    if (orthographic) {
        v.kind = LMB_ORTHOGRAPHIC;
        v.half_width = v.half_height = 1.2f;
    }
    for (int e = 0; e < (orthographic ? 6 : 24); ++e) {
        lmb_vec3 n = random_unit(&rng), at = mul3(n, 0.98f / maxf(absf(n.x), maxf(absf(n.y), absf(n.z))));
        one_emitter(at, mul3(at, -1.0f));
        draw_view(&v, LMB_DEPTH32F);
        gather_view(picture[0], &v, LMB_OCCLUSION_NONE, 12);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            pairs += picture[0][i] > 0.0f;
        }
        gather_view(picture[0], &v, kind, 12);
        draw_view(&v, LMB_DEPTH16);
        gather_view(picture[1], &v, kind, 12);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            differ += (picture[0][i] > 0.0f) != (picture[1][i] > 0.0f);
            hidden += picture[0][i] == 0.0f;
        }
    }
    printf("  depth of 16 bits and of 32 differ on %.3f %% of %d pairs\n", 100.0 * differ / pairs, pairs);
    CHECK_MSG(differ * 100 <= pairs && hidden > 1000, "%d of %d", differ, pairs);
}

/* Linear and tiled depth give the same result. */
static void check_depth_layouts(void)
{
    static float rows[FRAME * FRAME];
    lmb_view v = look_near(vec3(0.7f, 0.5f, 0.8f), vec3(-0.2f, -0.5f, -0.3f), 75);
    make_room();
    one_emitter(vec3(-0.9f, -0.6f, 0.5f), X);
    draw_view(&v, LMB_DEPTH32F);
    gather_view(picture[0], &v, LMB_OCCLUSION_VIEW, 12);
    CHECK(lmb_depth_linearize(rows, sizeof rows, &eye.depth) == LMB_OK);
    eye.depth.data = rows;
    eye.depth.layout = LMB_LINEAR;
    eye.depth.stride_bytes = FRAME * 4;
    gather_view(picture[1], &v, LMB_OCCLUSION_VIEW, 12);
    CHECK(memcmp(picture[0], picture[1], sizeof picture[0]) == 0);
}

/* Twice the light gives twice the result behind an occluder too, near and far. */
static void check_linear_occluded(void)
{
    lmb_light l = point_light(vec3(0.1f, 0.3f, -0.1f));
    lmb_grouping g = grouping_of(LMB_GROUP_ZONES, 64, 8);
    lmb_view v = look_near(vec3(0.7f, 0.5f, 0.8f), vec3(-0.2f, -0.5f, -0.3f), 75);
    lmb_occluder o;
    make_room();
    clear_points();
    add_points(&l, SIDE / 2, &g, 1);
    CHECK(lmb_group_points(&groups, &points, &g, NULL) == LMB_OK);
    draw_view(&v, LMB_DEPTH32F);
    o.view = &v;
    o.depth = &eye.depth;
    o.kind = LMB_OCCLUSION_VIEW;
    o.steps = 12;
    CHECK(lmb_resolve_tile(&tile, picked_kernels(), &v, &world.scene, &eye, 64, 64) == LMB_OK);
    check_linear(&o);
}

static void test_occlusion(void)
{
    static const int32_t kinds[] = {LMB_OCCLUSION_VIEW, LMB_OCCLUSION_VIEW_WORLD};
    check_screen(LMB_OCCLUSION_VIEW);
    check_screen(LMB_OCCLUSION_VIEW_WORLD);
    check_wall(LMB_OCCLUSION_NONE, LMB_DEPTH32F, 12);
    for (int k = 0; k < COUNT(kinds); ++k) {
        check_wall(kinds[k], LMB_DEPTH32F, 12);
        check_wall(kinds[k], LMB_DEPTH32F, 64);
        check_wall(kinds[k], LMB_DEPTH16, 12);
        for (int i = 0; i < 4; ++i) {
            check_grazing(kinds[k], i & 1 ? LMB_DEPTH16 : LMB_DEPTH32F, i >> 1);
        }
        check_depth_formats(kinds[k], 0);
        check_depth_formats(kinds[k], 1);
    }
    check_depth_layouts();
    check_linear_occluded();
}

void test_bounce(void)
{
    test_flux();
    test_points();
    test_discs();
    test_groups();
    test_factors();
    test_gather();
    test_occlusion();
}
