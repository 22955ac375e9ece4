/* test_draw.c: coverage of fixed-function drawing: triangles, lines, points; clipping; bad input. */
#include "../draw_case.h"

#include <math.h>

void test_draw(void);

#if LMB_DRAW

/* --- triangles ---------------------------------------------------------------------------------------------------- */

/* A polygon's fan covers each pixel once for any corners, as do two triangles that share an edge. */
static void test_once(void)
{
    test_rng r = {11};
    for (int i = 0; i < tries(60, 600); ++i) {
        float c[9][3];
        const float x = test_uniform(&r, 5, 35), y = test_uniform(&r, 5, 27), size = test_uniform(&r, 1, 30);
        c[0][0] = x, c[0][1] = y, c[0][2] = 0.5f;
        for (int k = 1; k < 9; ++k) {
            const double turn = (k - 1) * 2.0 * 3.14159265358979 / 7.0;
            c[k][0] = floorf((x + size * (float)cos(turn)) * 4) / 4;
            c[k][1] = floorf((y + size * (float)sin(turn)) * 4) / 4;
            c[k][2] = 0.5f;
        }
        memcpy(c[8], c[1], sizeof c[8]);
        case_begin();
        case_count();
        CHECK(case_draw(LMB_DRAW_TRIANGLE_FAN, (const float(*)[3])c, NULL, 9) == LMB_OK);
        CHECK(case_counted(2, 255) == 0);
        CHECK(size < 3 || case_counted(1, 1) > 4);
    }
}

/* Top and left edges belong to a rectangle, the others do not; all ways of drawing it give the same pixels. */
static void test_edges(void)
{
    static const float list[6][3] = {{3.5f, 2.5f, 0}, {3.5f, 9.5f, 0},  {20.5f, 9.5f, 0},
                                     {3.5f, 2.5f, 0}, {20.5f, 9.5f, 0}, {20.5f, 2.5f, 0}};
    static const float strip[4][3] = {{3.5f, 9.5f, 0}, {3.5f, 2.5f, 0}, {20.5f, 9.5f, 0}, {20.5f, 2.5f, 0}};
    static const float fan[4][3] = {{3.5f, 2.5f, 0}, {3.5f, 9.5f, 0}, {20.5f, 9.5f, 0}, {20.5f, 2.5f, 0}};
    static const struct {
        int32_t primitive;
        const float (*corners)[3];
        uint32_t count;
    } all[] = {{LMB_DRAW_TRIANGLES, list, 6},
               {LMB_DRAW_TRIANGLE_STRIP, strip, 4},
               {LMB_DRAW_TRIANGLE_FAN, fan, 4},
               {LMB_DRAW_QUADS, fan, 4},
               {LMB_DRAW_QUAD_STRIP, strip, 4}};
    for (int i = 0; i < 5; ++i) {
        case_begin();
        case_count();
        CHECK(case_draw(all[i].primitive, all[i].corners, NULL, all[i].count) == LMB_OK);
        CHECK_MSG(case_counted(1, 1) == 17 * 7 && case_counted(2, 255) == 0, "primitive %d", all[i].primitive);
        CHECK(drawn.stencil[2][3] == 1 && drawn.stencil[8][19] == 1 && drawn.stencil[9][19] == 0 &&
              drawn.stencil[8][20] == 0);
        CHECK(drawn.colour[2][3][0] == 255 && drawn.colour[1][3][0] == 0);
    }
}

/* A scene's triangles have the pixels and depth of lmb_draw if the camera's half angles are 45 degrees, which need no
 * rounding. */
static void test_same_depth(void)
{
    test_rng r = {5};
    float corners[90][3];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance place;
    lmb_scene scene;
    lmb_view view;
    static float depth[CASE_TILED];
    memset(&mesh, 0, sizeof mesh), memset(&material, 0, sizeof material), memset(&place, 0, sizeof place);
    memset(&scene, 0, sizeof scene), memset(&view, 0, sizeof view);
    for (int i = 0; i < 270; ++i) {
        corners[i / 3][i % 3] = test_uniform(&r, -3, 3);
    }
    mesh.positions = corners, mesh.vertex_count = 90, mesh.triangle_count = 30;
    material.texture = -1, material.alpha = 1, material.flags = LMB_DOUBLE_SIDED;
    for (int i = 0; i < 4; ++i) {
        place.to_world.m[5 * i] = 1;
    }
    place.first_id = 1;
    scene.meshes = &mesh, scene.materials = &material, scene.instances = &place;
    scene.mesh_count = scene.material_count = scene.instance_count = 1;
    view.eye = (lmb_vec3){0.3f, 0.2f, 3.5f};
    view.right.x = view.up.y = view.back.z = 1;
    view.half_width = view.half_height = 1;
    view.near_m = 0.1f;
    view.frame_width = CASE_WIDE, view.frame_height = CASE_HIGH;
    lmb_target target;
    memset(&target, 0, sizeof target), memset(depth, 0, sizeof depth);
    CHECK(lmb_surface_init(&target.depth, LMB_DEPTH32F, CASE_WIDE, CASE_HIGH, depth, sizeof depth) == LMB_OK);
    CHECK(lmb_draw(&target, lmb_kernels_named("scalar"), &view, &scene, 1, 30, 0, NULL) == LMB_OK);
    case_begin();
    CHECK(lmb_draw_view(&state, &view, &place.to_world) == LMB_OK);
    state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
    CHECK(case_draw(LMB_DRAW_TRIANGLES, (const float(*)[3])corners, NULL, 90) == LMB_OK);
    CHECK(memcmp(depth, drawn.depth, sizeof depth) == 0);
    int n = 0;
    for (int i = 0; i < CASE_TILED; ++i) {
        n += depth[i] > 0;
    }
    CHECK(n > 300);
}

/* A colour and texture coordinates on a receding plane, against binary64. */
static void test_perspective(void)
{
    static const float c[4][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -9}, {-1, 1, -9}};
    static const uint8_t colours[4][4] = {{0, 0, 0, 255}, {255, 0, 0, 255}, {255, 255, 0, 255}, {0, 255, 0, 255}};
    double worst = 0;
    int n = 0;
    case_begin();
    memset(&state.to_clip, 0, sizeof state.to_clip);
    state.to_clip.m[0] = state.to_clip.m[5] = 1, state.to_clip.m[11] = -1, state.to_clip.m[14] = 0.5f;
    CHECK(case_draw(LMB_DRAW_QUADS, c, &colours[0][0], 4) == LMB_OK);
    for (int y = 0; y < CASE_HIGH; ++y) {
        for (int x = 0; x < CASE_WIDE; ++x) {
            if (drawn.colour[y][x][3] != 0) {
                /* y / w = sy, w = 1 + 4 (y + 1) on the plane */
                const double sx = (x + 0.5) / CASE_WIDE * 2 - 1, sy = 1 - (y + 0.5) / CASE_HIGH * 2;
                const double at = 5 * sy / (1 - 4 * sy), w = 1 + 4 * (at + 1);
                const double red = (sx * w + 1) / 2 * 255, green = (at + 1) / 2 * 255;
                worst = fmax(worst, fmax(fabs(red - drawn.colour[y][x][0]), fabs(green - drawn.colour[y][x][1])));
                ++n;
            }
        }
    }
    CHECK_MSG(n > 100 && worst < 2.5, "%d pixels, %g", n, worst);
}

/* --- lines -------------------------------------------------------------------------------------------------------- */

/* Smallest |x - cx| + |y - cy| over a segment, in 1/256 px. */
static double least_sum(const double p[4], double cx, double cy)
{
    const double dx = p[2] - p[0], dy = p[3] - p[1];
    const double at[4] = {0, 1, dx != 0 ? (cx - p[0]) / dx : 0, dy != 0 ? (cy - p[1]) / dy : 0};
    double least = 1e9;
    for (int i = 0; i < 4; ++i) {
        if (at[i] >= 0 && at[i] <= 1) {
            least = fmin(least, fabs(p[0] + at[i] * dx - cx) + fabs(p[1] + at[i] * dy - cy));
        }
    }
    return least;
}

/* Against the definition in binary64, with numeric values for the shifts e and e^2. */
static void test_diamonds(void)
{
    test_rng r = {3};
    int wrong = 0, pixels = 0;
    for (int i = 0; i < tries(400, 4000); ++i) {
        const int coarse = i % 4 == 0 ? 128 : i % 4 == 1 ? 64 : 1;
        float c[2][3];
        double p[4];
        for (int k = 0; k < 4; ++k) {
            const int v = (int)(test_random(&r) % (4096u / (unsigned)coarse)) * coarse;
            c[k / 2][k % 2] = (float)v / 256.0f;
            p[k] = v - (k % 2 == 0 ? 0x1p-20 : 0x1p-40);
        }
        if (i % 7 == 0) {
            c[1][i % 2] = c[0][i % 2];
            p[2 + i % 2] = p[i % 2];
        }
        c[0][2] = c[1][2] = 0.5f;
        case_begin();
        case_count();
        CHECK(case_draw(LMB_DRAW_LINES, (const float(*)[3])c, NULL, 2) == LMB_OK);
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < 20; ++x) {
                const double cx = x * 256 + 128, cy = y * 256 + 128;
                const int leaves = least_sum(p, cx, cy) < 128 && fabs(p[2] - cx) + fabs(p[3] - cy) >= 128;
                wrong += leaves != drawn.stencil[y][x];
                pixels += leaves;
            }
        }
    }
    CHECK_MSG(wrong == 0 && pixels > 2000, "%d of %d pixels", wrong, pixels);
}

/* A loop through pixel centres has each pixel once; wide lines and points have the right size. */
static void test_widths(void)
{
    static const float loop[4][3] = {{2.5f, 2.5f, 0}, {12.5f, 2.5f, 0}, {12.5f, 9.5f, 0}, {2.5f, 9.5f, 0}};
    static const float line[2][3] = {{4.5f, 10.5f, 0}, {14.5f, 10.5f, 0}}, point[1][3] = {{10.25f, 10.75f, 0}};
    case_begin();
    case_count();
    CHECK(case_draw(LMB_DRAW_LINE_LOOP, loop, NULL, 4) == LMB_OK);
    CHECK(case_counted(1, 1) == 2 * 10 + 2 * 7 && case_counted(2, 255) == 0);
    for (int px = 1; px <= 6; ++px) {
        case_begin();
        case_count();
        state.line_px = (uint8_t)px;
        CHECK(case_draw(LMB_DRAW_LINE_STRIP, line, NULL, 2) == LMB_OK);
        CHECK_MSG(case_counted(1, 1) == 10 * px && case_counted(2, 255) == 0, "%d px", px);
        CHECK(drawn.stencil[10][8] == 1);
        case_begin();
        case_count();
        state.point_px = (uint8_t)px;
        CHECK(case_draw(LMB_DRAW_POINTS, point, NULL, 1) == LMB_OK);
        CHECK_MSG(case_counted(1, 1) == px * px, "%d px", px);
        const int top = (px % 2 == 0 ? 11 : 10) - px / 2, left = 10 - px / 2;
        CHECK(drawn.stencil[top][left] == 1 && drawn.stencil[top - 1][left] == 0 && drawn.stencil[top][left - 1] == 0);
    }
    state.point_px = 9; /* partly outside */
    case_count();
    const float corner[1][3] = {{0.5f, 0.5f, 0}};
    CHECK(case_draw(LMB_DRAW_POINTS, corner, NULL, 1) == LMB_OK && case_counted(1, 255) == 25);
    CHECK(case_guard_is_whole());
}

/* --- clipping, windows -------------------------------------------------------------------------------------------- */

typedef struct soup {
    float corners[60][3], uvs[60][2];
    uint8_t colours[60][4];
} soup;

static void make_soup(soup *s, uint32_t seed)
{
    test_rng r = {seed};
    for (int i = 0; i < 60; ++i) {
        s->corners[i][0] = test_uniform(&r, -4, 4);
        s->corners[i][1] = test_uniform(&r, -4, 4);
        s->corners[i][2] = test_uniform(&r, -6, 1);
        s->uvs[i][0] = test_uniform(&r, -2, 2);
        s->uvs[i][1] = test_uniform(&r, -2, 2);
        for (int k = 0; k < 4; ++k) {
            s->colours[i][k] = (uint8_t)test_random(&r);
        }
    }
}

static void soup_state(int primitive)
{
    CHECK(lmb_draw_state_init(&state, CASE_WIDE, CASE_HIGH) == LMB_OK);
    memset(&state.to_clip, 0, sizeof state.to_clip);
    state.to_clip.m[0] = state.to_clip.m[5] = 1, state.to_clip.m[11] = -1, state.to_clip.m[14] = 0.25f;
    state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE | LMB_DRAW_BLEND;
    state.blend_source[0] = LMB_DRAW_SOURCE_ALPHA;
    state.blend_target[0] = LMB_DRAW_INVERSE_SOURCE_ALPHA;
    state.line_px = state.point_px = primitive & 1 ? 3 : 1;
    state.fog = LMB_DRAW_FOG_EXP;
    state.fog_density = 0.2f;
    state.planes = 1;
    state.plane[0][0] = 1, state.plane[0][1] = 0.5f, state.plane[0][3] = 2;
}

/* 1, 2: patterns, and edges or corners of polygons. */
static void soup_mode(int mode)
{
    static uint8_t pattern[128];
    for (int i = 0; i < 128; ++i) {
        pattern[i] = (uint8_t)(i * 77 | i << 2);
    }
    state.polygon_mode[0] = state.polygon_mode[1] = (uint8_t)mode;
    state.polygon_mode[1] = (uint8_t)(mode == 2 ? LMB_DRAW_FILL : mode);
    state.line_pattern = (uint16_t)(mode == 0 ? 0xffff : 0x3717);
    state.line_repeat = (uint16_t)(1 + mode);
    state.area_pattern = mode == 0 ? NULL : pattern;
}

static lmb_status draw_soup(const lmb_draw_target *on, const soup *s, int primitive, lmb_stats *stats)
{
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    v.positions = s->corners;
    v.colours = &s->colours[0][0];
    v.uvs[0] = s->uvs;
    v.count = 60;
    return lmb_draw_list(on, &state, &v, primitive, NULL, stats);
}

/* Windows of the frame and scissors have the bytes of the whole picture. */
static void test_windows(void)
{
    soup s;
    make_soup(&s, 77);
    for (int i = 0; i < 3 * (LMB_DRAW_POLYGON + 1); ++i) {
        const int primitive = i % (LMB_DRAW_POLYGON + 1), mode = i / (LMB_DRAW_POLYGON + 1);
        static uint8_t whole[CASE_HIGH][CASE_WIDE][4];
        static float part_depth[16 * 24];
        uint8_t part[16][24][4];
        lmb_draw_target window;
        case_begin();
        soup_state(primitive);
        soup_mode(mode);
        CHECK(draw_soup(&drawn_on, &s, primitive, NULL) == LMB_OK);
        memcpy(whole, drawn.colour, sizeof whole);
        memset(&window, 0, sizeof window), memset(part, 0, sizeof part), memset(part_depth, 0, sizeof part_depth);
        CHECK(lmb_surface_init(&window.colour, LMB_RGBA8, 24, 16, part, sizeof part) == LMB_OK);
        CHECK(lmb_surface_init(&window.depth, LMB_DEPTH32F, 24, 16, part_depth, sizeof part_depth) == LMB_OK);
        window.x0 = window.y0 = 8;
        CHECK(draw_soup(&window, &s, primitive, NULL) == LMB_OK);
        int wrong = 0, shown = 0;
        for (int y = 0; y < 16; ++y) {
            wrong += memcmp(part[y], whole[y + 8][8], sizeof part[y]) != 0;
            for (int x = 0; x < 24; ++x) {
                shown += part[y][x][3] != 0;
            }
        }
        CHECK_MSG(wrong == 0 && shown > 3 - 2 * mode, "primitive %d, mode %d: %d rows, %d pixels", primitive, mode, wrong,
                  shown);
        case_begin();
        soup_state(primitive);
        soup_mode(mode);
        state.flags |= LMB_DRAW_SCISSOR;
        for (int part_of = 0; part_of < 3; ++part_of) {
            static const int32_t boxes[3][4] = {{-5, 0, 18, 32}, {13, 0, 4, 32}, {17, 0, 100, 32}};
            memcpy(state.scissor, boxes[part_of], sizeof state.scissor);
            CHECK(draw_soup(&drawn_on, &s, primitive, NULL) == LMB_OK);
        }
        CHECK(memcmp(whole, drawn.colour, sizeof whole) == 0 && case_guard_is_whole());
    }
}

/* A list has the bytes of primitives drawn one by one, and of an indexed list, whatever is drawn elsewhere. */
static void test_parts(void)
{
    static const int32_t kinds[4] = {LMB_DRAW_TRIANGLES, LMB_DRAW_QUADS, LMB_DRAW_LINES, LMB_DRAW_POINTS};
    static const uint32_t each[4] = {3, 4, 2, 1};
    soup s;
    make_soup(&s, 31);
    for (int i = 0; i < 4; ++i) {
        static uint8_t whole[CASE_HIGH][CASE_WIDE][4];
        uint8_t order[60];
        lmb_draw_vertices v;
        memset(&v, 0, sizeof v);
        v.positions = s.corners, v.colours = &s.colours[0][0], v.count = 60;
        case_begin();
        soup_state(i);
        CHECK(draw_soup(&drawn_on, &s, kinds[i], NULL) == LMB_OK);
        memcpy(whole, drawn.colour, sizeof whole);
        case_begin();
        soup_state(i);
        for (uint32_t k = 0; k < 60; k += each[i]) {
            const lmb_draw_state kept = state;
            v.positions = s.corners[k], v.colours = s.colours[k], v.count = each[i];
            CHECK(lmb_draw_list(&drawn_on, &state, &v, kinds[i], NULL, NULL) == LMB_OK);
            state.flags |= LMB_DRAW_SCISSOR; /* another draw, away from these */
            state.scissor[0] = CASE_WIDE;
            CHECK(draw_soup(&drawn_on, &s, kinds[3 - i], NULL) == LMB_OK);
            state = kept;
        }
        CHECK_MSG(memcmp(whole, drawn.colour, sizeof whole) == 0, "primitive %d", kinds[i]);
        for (uint32_t k = 0; k < 60; ++k) {
            order[k] = (uint8_t)(59 - k);
        }
        soup turned;
        for (int k = 0; k < 60; ++k) {
            memcpy(turned.corners[k], s.corners[59 - k], sizeof turned.corners[k]);
            memcpy(turned.colours[k], s.colours[59 - k], sizeof turned.colours[k]);
        }
        const lmb_draw_indices x = {order, 60, LMB_DRAW_INDEX_U8};
        v.positions = turned.corners, v.colours = turned.colours[0], v.count = 60;
        case_begin();
        soup_state(i);
        CHECK(lmb_draw_list(&drawn_on, &state, &v, kinds[i], &x, NULL) == LMB_OK);
        CHECK_MSG(memcmp(whole, drawn.colour, sizeof whole) == 0, "primitive %d by indices", kinds[i]);
    }
}

/* A plane of the state clips at the right position; so do near and far. */
static void test_cuts(void)
{
    case_begin();
    state.planes = 1 << 3;
    state.plane[3][0] = 1, state.plane[3][3] = -10; /* x >= 10 */
    CHECK(case_rectangle(0, 0, 40, 32, 0.5f) == LMB_OK);
    CHECK(drawn.colour[5][9][0] == 0 && drawn.colour[5][10][0] == 255 && drawn.colour[31][39][0] == 255);
    case_begin();
    const float slope[4][3] = {{0, 0, -1}, {0, 32, -1}, {40, 32, 3}, {40, 0, 3}}; /* d is 0 at x = 10, 1 at 20 */
    CHECK(case_draw(LMB_DRAW_QUADS, slope, NULL, 4) == LMB_OK);
    CHECK(drawn.colour[5][9][0] == 0 && drawn.colour[5][10][0] == 255 && drawn.colour[5][19][0] == 255 &&
          drawn.colour[5][20][0] == 0);
    case_begin();
    const float line[2][3] = {{0.5f, 4.5f, -1}, {40.5f, 4.5f, 3}};
    CHECK(case_draw(LMB_DRAW_LINES, line, NULL, 2) == LMB_OK);
    CHECK(drawn.colour[4][9][0] == 0 && drawn.colour[4][11][0] == 255 && drawn.colour[4][19][0] == 255 &&
          drawn.colour[4][21][0] == 0);
}

/* Roads from in front of the near plane to 1,000 km away keep their sides: an edge is clipped from the near end. */
static void test_long_edges(void)
{
    int wrong = 0, shown = 0;
    for (int i = 0; i < 8; ++i) {
        const float far = 1e6f - 12345.6f * (float)i, slope = 0.2f + 0.013f * (float)i, side = far * slope;
        const float c[4][3] = {{-0.1f, -1, -0.005f}, {0.1f, -1, -0.005f}, {side, -1, -far}, {-side, -1, -far}};
        case_begin();
        memset(&state.to_clip, 0, sizeof state.to_clip);
        state.to_clip.m[0] = state.to_clip.m[5] = 1, state.to_clip.m[11] = -1, state.to_clip.m[14] = 0.25f;
        CHECK(case_draw(LMB_DRAW_QUADS, c, NULL, 4) == LMB_OK);
        for (int k = 17 * CASE_WIDE; k < CASE_HIGH * CASE_WIDE; ++k) {
            const int x = k % CASE_WIDE, y = k / CASE_WIDE;
            const double sx = fabs((x + 0.5) / CASE_WIDE * 2 - 1), w = 1 / ((y + 0.5) / CASE_HIGH * 2 - 1);
            const double right = (0.1 + (double)slope * (w - 0.005)) / w;
            wrong += fabs(sx - right) > 0.002 && (drawn.colour[y][x][0] != 0) != (sx < right);
            shown += drawn.colour[y][x][0] != 0;
        }
    }
    CHECK_MSG(wrong == 0 && shown > 800, "%d of %d", wrong, shown);
}

static void test_culls(void)
{
    for (int i = 0; i < 8; ++i) {
        case_begin();
        state.flags =
            (i & 1 ? LMB_DRAW_CULL_BACK : 0u) | (i & 2 ? LMB_DRAW_CULL_FRONT : 0u) | (i & 4 ? LMB_DRAW_CLOCKWISE : 0u);
        CHECK(case_rectangle(2, 2, 8, 8, 0) == LMB_OK);   /* counter-clockwise in the picture */
        CHECK(case_rectangle(18, 2, 12, 8, 0) == LMB_OK); /* clockwise */
        const int front = drawn.colour[4][4][0] != 0, back = drawn.colour[4][14][0] != 0;
        CHECK_MSG((i & 4 ? back : front) == !(i & 2) && (i & 4 ? front : back) == !(i & 1), "%d", i);
    }
}

/* --- vertices and bad input --------------------------------------------------------------------------------------- */

static void test_formats(void)
{
    static const float f32[4][3] = {{2, 3, 0.5f}, {2, 20, 0.5f}, {30, 20, 0.5f}, {30, 3, 0.5f}};
    static const int16_t i16[4][4] = {{1, 1, 0, 0}, {1, 18, 0, 0}, {29, 18, 0, 0}, {29, 1, 0, 0}};
    int32_t fixed[4][3];
    static const uint8_t u8[6] = {0, 1, 2, 0, 2, 3};
    static const uint16_t u16[6] = {0, 1, 2, 0, 2, 3};
    static const uint32_t u32[6] = {0, 1, 2, 0, 2, 3};
    uint64_t hash[7];
    for (int i = 0; i < 12; ++i) {
        fixed[i / 3][i % 3] = (int32_t)(f32[i / 3][i % 3] * 65536);
    }
    for (int i = 0; i < 6; ++i) {
        lmb_draw_vertices v;
        const lmb_draw_indices x = {i == 3   ? (const void *)u8
                                    : i == 4 ? (const void *)u16
                                             : (const void *)u32,
                                    6,
                                    i == 3   ? LMB_DRAW_INDEX_U8
                                    : i == 4 ? LMB_INDEX_U16
                                             : LMB_INDEX_U32};
        memset(&v, 0, sizeof v);
        v.positions = i == 1 ? (const void *)i16 : i == 2 ? (const void *)fixed : (const void *)f32;
        v.position_format = i == 1 ? LMB_DRAW_I16 : i == 2 ? LMB_DRAW_FIXED : LMB_DRAW_F32;
        v.position_scale = (lmb_vec3){1, 1, 1};
        v.position_offset = (lmb_vec3){1, 2, 0.5f};
        v.count = 4;
        case_begin();
        state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
        CHECK(lmb_draw_list(&drawn_on, &state, &v, i < 3 ? LMB_DRAW_QUADS : LMB_DRAW_TRIANGLES, i < 3 ? NULL : &x,
                            NULL) == LMB_OK);
        hash[i] = lmb_surface_hash(&drawn_on.colour) ^ lmb_surface_hash(&drawn_on.depth);
        CHECK(hash[i] == hash[0] && drawn.colour[10][10][0] == 255);
    }
}

static void test_dropped(void)
{
    lmb_stats stats;
    soup s;
    const float odd[] = {(float)NAN, (float)INFINITY, -(float)INFINITY, 3e38f, 1048576.0f};
    memset(&stats, 0, sizeof stats);
    make_soup(&s, 5);
    case_begin();
    soup_state(0);
    state.stage[0].texture = NULL;
    for (int i = 0; i < 5; ++i) {
        s.corners[3 * i][i % 3] = odd[i];
    }
    CHECK(draw_soup(&drawn_on, &s, LMB_DRAW_TRIANGLES, &stats) == LMB_OK);
    CHECK(stats.triangles == 20 && stats.triangles_dropped == 5 && stats.triangles_drawn > 3);
    const uint16_t order[6] = {0, 59, 60, 30, 31, 65535};
    const lmb_draw_indices x = {order, 6, LMB_INDEX_U16};
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    v.positions = s.corners;
    v.count = 60;
    CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_TRIANGLES, &x, &stats) == LMB_OK);
    CHECK(stats.triangles == 22 && stats.triangles_dropped == 7 && case_guard_is_whole());
}

/* Small textured triangles, with a place of its own each: those with odd coordinates are dropped and counted. */
static void test_dropped_coordinates(void)
{
    enum { TRIANGLES = 40 };
    static const float odd[] = {(float)NAN, (float)INFINITY, 3e38f, -1048576.0f};
    static const uint8_t white[4] = {255, 255, 255, 255};
    const lmb_texture texture = {.texels = white, .width = 1, .height = 1, .levels = 1, .filter = LMB_NEAREST};
    float at[3 * TRIANGLES][3], uv[3 * TRIANGLES][2];
    lmb_stats stats;
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    memset(&stats, 0, sizeof stats);
    for (int i = 0; i < 3 * TRIANGLES; ++i) {
        at[i][0] = (float)(i / 3 % 8 * 4 + (i % 3 == 2 ? 4 : 1));
        at[i][1] = (float)(i / 24 * 4 + (i % 3 == 1 ? 4 : 1));
        at[i][2] = 0.5f;
        uv[i][0] = uv[i][1] = i % 15 == 7 ? odd[i / 15 % 4] : 0.5f; /* in triangle 2, 7, 12 ... */
    }
    v.positions = at;
    v.uvs[0] = uv;
    v.count = 3 * TRIANGLES;
    case_begin();
    state.kernels = picked_kernels();
    state.stage[0].texture = &texture;
    CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_TRIANGLES, NULL, &stats) == LMB_OK);
    CHECK(stats.triangles == TRIANGLES && stats.triangles_dropped == TRIANGLES / 5);
    for (int i = 0; i < TRIANGLES; ++i) {
        CHECK_MSG((drawn.colour[i / 8 * 4 + 1][i % 8 * 4 + 1][3] == 0) == (i % 5 == 2), "triangle %d", i);
    }
}

/* A line without length has no pixel, wherever it lies in one, wide or not. */
static void test_no_length(void)
{
    for (int i = 0; i < 64; ++i) {
        const float x = 5.0f + 0.25f * (float)(i % 4), y = 7.0f + 0.25f * (float)(i / 4 % 4);
        const float both[2][3] = {{x, y, 0.5f}, {x, y, 0.5f}};
        case_begin();
        case_count();
        state.line_px = 1 + i / 16;
        CHECK(case_draw(LMB_DRAW_LINES, both, NULL, 2) == LMB_OK && case_counted(1, 255) == 0);
    }
}

static lmb_status refuse(int32_t primitive)
{
    static const float c[4][3] = {{0, 0, 1}, {0, 32, 1}, {40, 32, 1}, {40, 0, 1}};
    return case_draw(primitive, c, NULL, 4);
}

/* Each out-of-range value is refused and nothing is written. */
static void test_refused(void)
{
    uint8_t *const state_bytes[] = {&state.planes,
                                    &state.fog,
                                    &state.depth_func,
                                    &state.alpha_func,
                                    &state.colour_mask,
                                    &state.stencil_func,
                                    &state.stencil_op[0],
                                    &state.stencil_op[1],
                                    &state.stencil_op[2],
                                    &state.blend_source[0],
                                    &state.blend_source[1],
                                    &state.blend_target[0],
                                    &state.blend_target[1],
                                    &state.blend_equation[0],
                                    &state.blend_equation[1],
                                    &state.logic_op,
                                    &state.stage[0].mode,
                                    &state.stage[1].mode,
                                    &state.polygon_mode[0],
                                    &state.polygon_mode[1],
                                    &state.stage[1].combine.func[0],
                                    &state.stage[0].combine.func[1],
                                    &state.stage[0].combine.source[1][2],
                                    &state.stage[1].combine.operand[0][1],
                                    &state.stage[1].combine.shift[1]};
    static const uint8_t past[] = {64, 4, 8, 8, 16, 8, 8, 8, 8, 15, 15, 15, 15, 5, 5, 16, 6, 6, 3, 3, 8, 6, 6, 4, 3};
    float *const floats[] = {&state.to_clip.m[3],   &state.plane[5][2],         &state.fog_axis[1],
                             &state.depth_range[0], &state.depth_range[1],      &state.offset_slope,
                             &state.offset_units,   &state.fog_start,           &state.fog_end,
                             &state.fog_density,    &state.stage[0].level_bias, &state.stage[1].level_bias};
    int n = 0;
    for (int i = 0; i < (int)sizeof past; ++i) {
        case_begin();
        *state_bytes[i] = past[i];
        n += refuse(LMB_DRAW_QUADS) == LMB_ERR_ARG;
        *state_bytes[i] = 255;
        n += refuse(LMB_DRAW_QUADS) == LMB_ERR_ARG;
    }
    CHECK_MSG(n == 2 * (int)sizeof past, "%d", n);
    for (int i = 0; i < 12; ++i) {
        case_begin();
        *floats[i] = (float)NAN;
        CHECK_MSG(refuse(LMB_DRAW_QUADS) == LMB_ERR_ARG, "number %d", i);
        *floats[i] = -(float)INFINITY;
        CHECK_MSG(refuse(LMB_DRAW_QUADS) == LMB_ERR_ARG, "number %d", i);
    }
    for (int i = 0; i < 18; ++i) {
        static const uint8_t texels[4];
        const lmb_texture texture = {texels, 1, 1, (uint8_t)(i == 12 ? 2 : 1), 0, 0, (uint8_t)(i == 16 ? 3 : 0), 0};
        case_begin();
        state.flags = i == 0 ? LMB_DRAW_FLAGS + 1 : i == 1 ? LMB_DRAW_DEPTH_TEST : i == 2 ? LMB_DRAW_STENCIL : 0;
        drawn_on.depth.data = i == 1 || i == 3 ? NULL : drawn_on.depth.data;
        drawn_on.colour.data = i == 3 ? NULL : drawn_on.colour.data;
        drawn_on.stencil = i == 2 ? NULL : drawn_on.stencil;
        drawn_on.stencil_stride -= i == 4;
        drawn_on.x0 = i == 5 ? 4 : i == 6 ? -8 : 0;
        drawn_on.depth.width -= i == 7;
        state.viewport[2] = i == 8 ? 0 : i == 9 ? 16385 : CASE_WIDE;
        state.line_px = i == 10 ? 0 : 1;
        state.point_px = i == 11 ? 0 : 1;
        state.line_repeat = (uint16_t)(i == 13 ? 0 : i == 14 ? 257 : 1);
        drawn_on.depth_far = i == 15 ? 1.0f : 0.0f;
        drawn_on.colour.layout = i == 17 ? LMB_TILED : LMB_LINEAR;
        state.stage[1].texture = i == 12 || i == 16 ? &texture : NULL;
        CHECK_MSG(refuse(LMB_DRAW_QUADS) == (i == 16 ? LMB_ERR_FORMAT : LMB_ERR_ARG), "%d", i);
        CHECK(drawn.colour[3][3][0] == 0 && drawn.depth[0] == 0 && case_guard_is_whole());
    }
    const lmb_draw_vertices odd[2] = {{.position_format = LMB_DRAW_I16, .position_scale = {(float)NAN, 1, 1}},
                                      {.uv_format = LMB_DRAW_I16, .uv_scale = (float)INFINITY}};
    for (int i = 0; i < 2; ++i) {
        case_begin();
        CHECK(lmb_draw_list(&drawn_on, &state, &odd[i], LMB_DRAW_QUADS, NULL, NULL) == LMB_ERR_ARG);
    }
    case_begin();
    CHECK(refuse(-1) == LMB_ERR_ARG && refuse(10) == LMB_ERR_ARG);
    drawn_on.colour.format = LMB_RGB32F;
    CHECK(refuse(LMB_DRAW_QUADS) == LMB_ERR_FORMAT);
    CHECK(drawn.colour[3][3][0] == 0 && case_guard_is_whole());
}

/* Random states and vertices: nothing is written out of bounds. */
static void test_random_states(void)
{
    test_rng r = {19};
    int drawn_calls = 0;
    for (int i = 0; i < tries(300, 6000); ++i) {
        soup s;
        static uint8_t texels[64 * 4 * 2];
        const lmb_texture texture = {
            texels, 8, 8, (uint8_t)(1 + i % 4), (uint8_t)(i % 3), (uint8_t)(i / 3 % 3), (uint8_t)(i % 3), 0};
        make_soup(&s, test_random(&r));
        case_begin();
        uint32_t *words = (uint32_t *)(void *)s.corners;
        words[test_random(&r) % 180] = test_random(&r);
        soup_state((int)(test_random(&r) % 9));
        state.flags = test_random(&r) & LMB_DRAW_FLAGS;
        state.stage[i & 1].texture = &texture;
        state.stage[i & 1].mode = (uint8_t)(test_random(&r) % 6);
        for (int k = 0; k < 3; ++k) {
            lmb_draw_combine *c = &state.stage[i & 1].combine;
            c->func[k & 1] = (uint8_t)(test_random(&r) % 6);
            c->source[k & 1][k] = (uint8_t)(test_random(&r) % 6);
            c->operand[k & 1][k] = (uint8_t)(test_random(&r) % 4);
            c->shift[k & 1] = (uint8_t)(test_random(&r) % 3);
        }
        state.polygon_mode[i & 1] = (uint8_t)(test_random(&r) % 3);
        state.line_pattern = (uint16_t)test_random(&r);
        state.line_repeat = (uint16_t)(1 + test_random(&r) % 256);
        state.area_pattern = i % 3 == 0 ? texels : NULL;
        state.viewport[0] = (int32_t)(test_random(&r) % 60) - 30;
        state.viewport[2] = 1 + (int32_t)(test_random(&r) % (i % 5 == 0 ? 16384 : 60));
        state.scissor[1] = (int32_t)(test_random(&r) % 60) - 30;
        state.fog = (uint8_t)(test_random(&r) % 4);
        state.point_px = (uint8_t)(1 + test_random(&r) % 255);
        state.line_px = (uint8_t)(1 + test_random(&r) % 20);
        state.offset_slope = test_uniform(&r, -3, 3);
        drawn_calls += draw_soup(&drawn_on, &s, (int)(test_random(&r) % 10), NULL) == LMB_OK;
        if (!case_guard_is_whole()) {
            CHECK_MSG(0, "try %d", i);
            return;
        }
    }
    CHECK(drawn_calls == tries(300, 6000));
}

void test_draw(void)
{
    test_once();
    test_edges();
    test_same_depth();
    test_perspective();
    test_diamonds();
    test_widths();
    test_windows();
    test_parts();
    test_cuts();
    test_long_edges();
    test_culls();
    test_formats();
    test_dropped();
    test_dropped_coordinates();
    test_no_length();
    test_refused();
    test_random_states();
}

#else
void test_draw(void) { SKIP("a build without fixed-function drawing"); }
#endif
