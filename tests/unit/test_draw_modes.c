/* test_draw_modes.c: edges, corners and sides of polygons; patterns; combined stages; more vertex colours. */
#include "../draw_case.h"

#include <math.h>

void test_draw_modes(void);

#if LMB_DRAW

static const float square[4][3] = {{4.5f, 4.5f, 0}, {4.5f, 20.5f, 0}, {30.5f, 20.5f, 0}, {30.5f, 4.5f, 0}};

static lmb_status draw_vertices(int32_t primitive, const lmb_draw_vertices *v)
{
    return lmb_draw_list(&drawn_on, &state, v, primitive, NULL, NULL);
}

static int red_at(int x, int y) { return drawn.colour[y][x][0]; }

static int shown(void)
{
    int n = 0;
    for (int k = 0; k < CASE_HIGH * CASE_WIDE; ++k) {
        n += drawn.colour[k / CASE_WIDE][k % CASE_WIDE][3] != 0;
    }
    return n;
}

/* --- sides of polygons -------------------------------------------------------------------------------------------- */

/* A polygon's edges equal those of a loop, and its corners equal points; neither quads nor polygons have diagonals. */
static void test_outlines(void)
{
    static const int32_t all[] = {LMB_DRAW_QUADS, LMB_DRAW_POLYGON};
    static uint8_t loop[CASE_HIGH][CASE_WIDE][4];
    for (int i = 0; i < 2; ++i) {
        case_begin();
        state.line_pattern = 0x3c5f;
        CHECK(case_draw(LMB_DRAW_LINE_LOOP, square, NULL, 4) == LMB_OK);
        memcpy(loop, drawn.colour, sizeof loop);
        case_begin();
        state.line_pattern = 0x3c5f;
        state.polygon_mode[0] = LMB_DRAW_EDGES;
        CHECK(case_draw(all[i], square, NULL, 4) == LMB_OK);
        CHECK(shown() > 40 && memcmp(loop, drawn.colour, sizeof loop) == 0);
        case_begin();
        state.polygon_mode[0] = LMB_DRAW_CORNERS;
        state.point_px = 3;
        CHECK(case_draw(all[i], square, NULL, 4) == LMB_OK);
        CHECK(shown() == 4 * 9 && red_at(4, 4) == 255 && red_at(30, 20) == 255 && red_at(15, 12) == 0);
        case_begin();
        state.polygon_mode[0] = LMB_DRAW_EDGES;
        CHECK(case_draw(LMB_DRAW_TRIANGLE_FAN, square, NULL, 4) == LMB_OK);
        CHECK(red_at(17, 12) == 255); /* the diagonal */
    }
}

/* The vertices select visible edges, except in strips and fans. */
static void test_edges_chosen(void)
{
    static const uint8_t edges[4] = {1, 0, 1, 0};
    const lmb_draw_vertices v = {.positions = square, .edges = edges, .count = 4};
    case_begin();
    state.polygon_mode[0] = LMB_DRAW_EDGES;
    CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK);
    CHECK(red_at(4, 12) == 255 && red_at(17, 20) == 0 && red_at(30, 12) == 255 && red_at(17, 4) == 0);
    case_begin();
    state.polygon_mode[0] = LMB_DRAW_CORNERS;
    CHECK(draw_vertices(LMB_DRAW_POLYGON, &v) == LMB_OK && shown() == 2);
    case_begin();
    state.polygon_mode[0] = LMB_DRAW_EDGES;
    CHECK(draw_vertices(LMB_DRAW_TRIANGLE_FAN, &v) == LMB_OK);
    CHECK(red_at(17, 20) == 255 && red_at(17, 4) == 255);
}

/* Front and back have separate modes and colours, and are culled in each mode. */
static void test_sides(void)
{
    static const uint8_t red[4][4] = {{200, 0, 0, 255}, {200, 0, 0, 255}, {200, 0, 0, 255}, {200, 0, 0, 255}};
    static const uint8_t dim[4][4] = {{90, 0, 0, 255}, {90, 0, 0, 255}, {90, 0, 0, 255}, {90, 0, 0, 255}};
    static const uint8_t more[4][4] = {{7, 0, 0, 0}, {7, 0, 0, 0}, {7, 0, 0, 0}, {7, 0, 0, 0}};
    float turned[4][3];
    for (int i = 0; i < 4; ++i) {
        memcpy(turned[i], square[3 - i], sizeof turned[i]);
    }
    for (int clockwise = 0; clockwise < 2; ++clockwise) {
        for (int back = 0; back < 2; ++back) {
            const lmb_draw_vertices v = {.positions = back != clockwise ? (const void *)turned : (const void *)square,
                                         .colours = red[0],
                                         .back_colours = dim[0],
                                         .back_seconds = more[0],
                                         .count = 4};
            const uint32_t turns = clockwise ? LMB_DRAW_CLOCKWISE : 0;
            case_begin();
            state.flags = turns;
            CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK && red_at(17, 12) == (back ? 97 : 200));
            case_begin();
            state.flags = turns;
            state.polygon_mode[1] = LMB_DRAW_EDGES;
            CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK);
            CHECK(red_at(17, 12) == (back ? 0 : 200) && red_at(4, 12) == (back ? 97 : 200));
            for (int mode = 0; mode < 3; ++mode) {
                case_begin();
                state.flags = turns | (back ? LMB_DRAW_CULL_BACK : LMB_DRAW_CULL_FRONT);
                state.polygon_mode[0] = state.polygon_mode[1] = (uint8_t)mode;
                CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK && shown() == 0);
                state.flags = turns | (back ? LMB_DRAW_CULL_FRONT : LMB_DRAW_CULL_BACK);
                CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK && shown() > 3);
            }
        }
    }
}

/* A flat polygon has the colour of the first vertex. */
static void test_flat_polygon(void)
{
    static const uint8_t colours[4][4] = {{10, 0, 0, 255}, {20, 0, 0, 255}, {30, 0, 0, 255}, {40, 0, 0, 255}};
    case_begin();
    state.flags = LMB_DRAW_FLAT;
    CHECK(case_draw(LMB_DRAW_POLYGON, square, colours[0], 4) == LMB_OK);
    CHECK(red_at(8, 18) == 10 && red_at(27, 7) == 10);
}

/* --- patterns ----------------------------------------------------------------------------------------------------- */

/* The n-th pixel of a line, in either direction, has bit n / repeat of the pattern. Strips continue the count. */
static void test_dashes(void)
{
    static const float to[4][2] = {{35, 9.25f}, {9, 6}, {4.75f, 27}, {30, 30.5f}};
    const uint32_t pattern = 0xb2c7;
    int all_left = 0;
    for (int i = 0; i < 16; ++i) {
        const int repeat = 1 + i / 8 * 2, turned = i & 1;
        const float *end = to[i / 2 % 4];
        const float c[2][3] = {{turned ? end[0] : 3.25f, turned ? end[1] : 4.75f, 0},
                               {turned ? 3.25f : end[0], turned ? 4.75f : end[1], 0}};
        static uint8_t whole[CASE_HIGH][CASE_WIDE][4];
        case_begin();
        CHECK(case_draw(LMB_DRAW_LINES, c, NULL, 2) == LMB_OK);
        memcpy(whole, drawn.colour, sizeof whole);
        case_begin();
        state.line_pattern = (uint16_t)pattern, state.line_repeat = (uint16_t)repeat;
        CHECK(case_draw(LMB_DRAW_LINES, c, NULL, 2) == LMB_OK);
        const int down = fabsf(c[1][1] - c[0][1]) > fabsf(c[1][0] - c[0][0]);
        int n = 0, wrong = 0;
        for (int k = 0; k < (down ? CASE_HIGH : CASE_WIDE); ++k) {
            const int along = c[1][down] > c[0][down] ? k : (down ? CASE_HIGH : CASE_WIDE) - 1 - k;
            for (int across = 0; across < (down ? CASE_WIDE : CASE_HIGH); ++across) {
                const int x = down ? across : along, y = down ? along : across;
                if (whole[y][x][0] != 0) {
                    const int shows = (pattern >> (n / repeat % 16) & 1u) != 0;
                    wrong += (red_at(x, y) != 0) != shows;
                    all_left += !shows;
                    ++n;
                }
            }
        }
        CHECK_MSG(wrong == 0 && n > 4, "line %d: %d of %d", i, wrong, n);
    }
    CHECK(all_left > 100);
    static const float bent[4][3] = {{2.5f, 3.5f, 0}, {12.5f, 3.5f, 0}, {12.5f, 9.5f, 0}, {30.5f, 9.5f, 0}};
    case_begin();
    state.line_pattern = 0x00ff;
    CHECK(case_draw(LMB_DRAW_LINE_STRIP, bent, NULL, 4) == LMB_OK);
    for (int n = 0; n < 34; ++n) {
        const int x = n < 10 ? 2 + n : n < 16 ? 12 : 12 + n - 16, y = n < 10 ? 3 : n < 16 ? 3 + n - 10 : 9;
        CHECK((red_at(x, y) != 0) == (n % 16 < 8));
    }
    case_begin();
    state.line_pattern = 0x00ff;
    CHECK(case_draw(LMB_DRAW_LINES, bent, NULL, 4) == LMB_OK);
    CHECK(red_at(12, 9) != 0 && red_at(2, 3) != 0 && red_at(21, 9) == 0);
}

/* The pattern is fixed to the frame; lines and points ignore it. */
static void test_area_pattern(void)
{
    uint8_t pattern[32][4];
    int wrong = 0;
    for (int i = 0; i < 128; ++i) {
        pattern[i / 4][i % 4] = (uint8_t)(i * 59 + 7);
    }
    case_begin();
    state.area_pattern = pattern[0];
    CHECK(case_rectangle(0, 0, CASE_WIDE, CASE_HIGH, 0) == LMB_OK);
    for (int y = 0; y < CASE_HIGH; ++y) {
        for (int x = 0; x < CASE_WIDE; ++x) {
            wrong += (red_at(x, y) != 0) != (pattern[y % 32][x % 32 / 8] >> x % 8 & 1);
        }
    }
    CHECK(wrong == 0);
    memset(pattern, 0, sizeof pattern);
    CHECK(case_draw(LMB_DRAW_LINE_LOOP, square, NULL, 4) == LMB_OK && red_at(4, 12) == 255);
    case_begin();
    state.area_pattern = pattern[0];
    CHECK(case_rectangle(0, 0, CASE_WIDE, CASE_HIGH, 0) == LMB_OK && shown() == 0);
    CHECK(case_draw(LMB_DRAW_POINTS, square, NULL, 4) == LMB_OK && shown() == 4);
}

/* --- stages ------------------------------------------------------------------------------------------------------- */

typedef struct combined {
    double vertex[4], previous[4], texel[2][4], constant[4];
} combined;

static double argument(const combined *c, const lmb_draw_combine *how, int stage, int i, int k)
{
    const int source = how->source[i == 3][k], operand = how->operand[i == 3][k];
    const double *from = source == LMB_DRAW_FROM_TEXTURE    ? c->texel[stage]
                         : source == LMB_DRAW_FROM_CONSTANT ? c->constant
                         : source == LMB_DRAW_FROM_VERTEX   ? c->vertex
                         : source == LMB_DRAW_FROM_PREVIOUS ? c->previous
                                                            : c->texel[source - LMB_DRAW_FROM_STAGE];
    const double v = operand == LMB_DRAW_TAKE_COLOUR || operand == LMB_DRAW_TAKE_INVERSE_COLOUR ? from[i] : from[3];
    return operand == LMB_DRAW_TAKE_INVERSE_COLOUR || operand == LMB_DRAW_TAKE_INVERSE_ALPHA ? 1 - v : v;
}

static double result(const combined *c, const lmb_draw_combine *how, int stage, int i)
{
    const int func = how->func[0] == LMB_DRAW_DOT4 ? LMB_DRAW_DOT4 : how->func[i == 3];
    const double a = argument(c, how, stage, i, 0), b = argument(c, how, stage, i, 1),
                 d = argument(c, how, stage, i, 2);
    double dot = 0;
    for (int k = 0; k < 3; ++k) {
        dot += 4 * (argument(c, how, stage, k, 0) - 0.5) * (argument(c, how, stage, k, 1) - 0.5);
    }
    const double all[8] = {a, a * b, a + b, a + b - 0.5, a * d + b * (1 - d), a - b, dot, dot};
    const int shift = how->shift[func == LMB_DRAW_DOT4 ? 0 : i == 3];
    return fmin(fmax(all[func] * (1 << shift), 0), 1);
}

/* Every function, source, operand and scale of both stages, against the formulas in binary64. */
static void test_combines(void)
{
    test_rng r = {23};
    lmb_texture t[2];
    uint8_t texel[2][4];
    double worst = 0;
    int funcs = 0;
    for (int n = 0; n < tries(3000, 60000); ++n) {
        combined c;
        case_begin();
        for (int i = 0; i < 4; ++i) {
            state.colour[i] = (uint8_t)test_random(&r);
            c.vertex[i] = c.previous[i] = state.colour[i] / 255.0;
        }
        for (int k = 0; k < 2; ++k) {
            lmb_draw_stage *s = &state.stage[k];
            memset(&t[k], 0, sizeof t[k]);
            t[k].texels = texel[k], t[k].width = t[k].height = t[k].levels = 1;
            s->texture = &t[k];
            s->mode = LMB_DRAW_COMBINE;
            for (int i = 0; i < 4; ++i) {
                texel[k][i] = (uint8_t)(test_random(&r) % 7 == 0 ? 255 : test_random(&r));
                s->colour[i] = (uint8_t)test_random(&r);
                c.texel[k][i] = texel[k][i] / 255.0;
            }
            for (int i = 0; i < 6; ++i) {
                s->combine.source[i / 3][i % 3] = (uint8_t)(test_random(&r) % 6);
                s->combine.operand[i / 3][i % 3] = (uint8_t)(test_random(&r) % 4);
            }
            s->combine.func[0] = (uint8_t)(test_random(&r) % 8);
            s->combine.func[1] = (uint8_t)(test_random(&r) % 6);
            s->combine.shift[0] = (uint8_t)(test_random(&r) % 3);
            s->combine.shift[1] = (uint8_t)(test_random(&r) % 3);
        }
        for (int k = 0; k < 2; ++k) {
            const lmb_draw_combine *how = &state.stage[k].combine;
            combined next = c;
            for (int i = 0; i < 4; ++i) {
                c.constant[i] = state.stage[k].colour[i] / 255.0;
            }
            funcs |= 1 << how->func[0];
            for (int i = 0; i < 4; ++i) {
                next.previous[i] = floor(result(&c, how, k, i) * 255 + 0.5 + 1e-9) / 255;
            }
            memcpy(c.previous, next.previous, sizeof c.previous);
        }
        CHECK(case_rectangle(0, 0, 2, 2, 0) == LMB_OK);
        for (int i = 0; i < 4; ++i) {
            worst = fmax(worst, fabs(drawn.colour[1][1][i] - 255 * c.previous[i]));
        }
    }
    CHECK_MSG(worst < 1e-6 && funcs == 255, "%g %d", worst, funcs);
}

/* A stage without a texture passes the colour through; as a source it is 1. */
static void test_missing_stage(void)
{
    static const uint8_t texel[4] = {50, 60, 70, 80};
    lmb_texture t;
    memset(&t, 0, sizeof t);
    t.texels = texel, t.width = t.height = t.levels = 1;
    case_begin();
    state.stage[0].texture = &t;
    state.stage[0].mode = LMB_DRAW_COMBINE;
    state.stage[0].combine.source[0][0] = LMB_DRAW_FROM_STAGE + 1;
    state.stage[0].combine.source[1][0] = LMB_DRAW_FROM_TEXTURE;
    state.stage[1].mode = LMB_DRAW_COMBINE;
    CHECK(case_rectangle(0, 0, 2, 2, 0) == LMB_OK);
    CHECK(drawn.colour[0][0][0] == 255 && drawn.colour[0][0][3] == 80);
}

/* --- streams ------------------------------------------------------------------------------------------------------ */

/* Second colours are added after the stages and before fog; the fog distance may be a vertex attribute. */
static void test_streams(void)
{
    static const uint8_t texel[4] = {100, 100, 100, 255};
    static const uint8_t seconds[4][4] = {{0, 200, 9, 9}, {0, 200, 9, 9}, {0, 200, 9, 9}, {0, 200, 9, 9}};
    static const float fogs[4] = {0, 0, 1, 1};
    lmb_texture t;
    lmb_draw_vertices v = {.positions = square, .seconds = seconds[0], .fogs = fogs, .count = 4};
    memset(&t, 0, sizeof t);
    t.texels = texel, t.width = t.height = t.levels = 1;
    case_begin();
    state.stage[0].texture = &t;
    state.colour[3] = 77;
    CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK);
    const uint8_t *p = drawn.colour[10][10];
    CHECK(p[0] == 100 && p[1] == 255 && p[2] == 109 && p[3] == 77);
    case_begin();
    state.fog = LMB_DRAW_FOG_LINEAR;
    CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK);
    CHECK(abs(red_at(17, 12) - 128) < 3 && red_at(5, 12) > 240 && red_at(29, 12) < 16);
    const float odd[4] = {0, (float)NAN, 0, 0};
    v.fogs = odd;
    case_begin();
    CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_OK && red_at(5, 18) == 0 && red_at(29, 6) == 255);
    v.fogs = (const float *)(const void *)((const uint8_t *)fogs + 1);
    CHECK(draw_vertices(LMB_DRAW_QUADS, &v) == LMB_ERR_ALIGN);
}

/* Fills the stack below the caller, so that a place that nobody wrote is large. */
static int32_t fill_stack(int last)
{
    volatile int32_t words[5000];
    for (int i = 0; i < 5000; ++i) {
        words[i] = INT32_MAX;
    }
    return words[last];
}

/* A corner outside the guard band has no place: sanitizers report a sum with one. */
static void test_corners_without_place(void)
{
    float far[12][3];
    for (int i = 0; i < 12; ++i) {
        memcpy(far[i], square[i % 3], sizeof far[i]);
        far[i][1] = i % 3 == 0 ? -1e5f : far[i][1];
    }
    const lmb_draw_vertices v = {.positions = far[0], .count = 12};
    case_begin();
    CHECK(fill_stack(4999) == INT32_MAX);
    CHECK(draw_vertices(LMB_DRAW_TRIANGLES, &v) == LMB_OK && shown() > 100);
}

void test_draw_modes(void)
{
    test_corners_without_place();
    test_outlines();
    test_edges_chosen();
    test_sides();
    test_flat_polygon();
    test_dashes();
    test_area_pattern();
    test_combines();
    test_missing_stage();
    test_streams();
}

#else
void test_draw_modes(void) { SKIP("a build without fixed-function drawing"); }
#endif
