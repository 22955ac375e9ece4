/* test_draw_shader.c: shader colours, counts of passed pixels, and positions with w, in every way of drawing. */
#include "../draw_case.h"

#include <stdlib.h>

void test_draw_shader(void);

#if LMB_DRAW && !LMB_DRAW_SMALL

/* Inputs of the shader, and its behaviour. */
static struct {
    const uint8_t (*colours)[4]; /* per vertex; mixed by shares */
    int calls, backs, strange;
    uint32_t vertex[3];
    int leaves_even; /* 1: discards pixels with even x */
    float off; /* largest difference of by_x and by_y from the change of the shares to the next pixels */
} seen;

static float mixed(const lmb_draw_pixels_of *p, const lmb_draw_fragment_at *at, int i)
{
    const float v0 = seen.colours[p->vertex[0]][i], v1 = seen.colours[p->vertex[1]][i],
                v2 = seen.colours[p->vertex[2]][i];
    return v0 + at->share[0] * (v1 - v0) + at->share[1] * (v2 - v0);
}

/* Are pixel k of a tile and its four neighbours in the mask? */
static int is_inner(uint64_t mask, int k)
{
    const uint64_t all = k > 7 && k < 56 ? (uint64_t)0x10381 << (k - 8) : 0;
    return k % 8 > 0 && k % 8 < 7 && all != 0 && (mask & all) == all;
}

static uint64_t shade(void *user, const lmb_draw_pixels_of *p, uint8_t colour[64][4])
{
    uint64_t out = 0;
    float shares[2][64], by_x[2][64], by_y[2][64];
    lmb_draw_shares(shares, p);
    lmb_draw_steps(by_x, by_y, p);
    seen.strange += user != &seen || p->mask == 0 || p->x % 8 != 0 || p->y % 8 != 0;
    ++seen.calls;
    seen.backs += p->is_back;
    memcpy(seen.vertex, p->vertex, sizeof seen.vertex);
    for (int k = 0; k < 64; ++k) {
        lmb_draw_fragment_at at, next[2];
        lmb_draw_fragment(&at, p, k);
        seen.strange += (p->mask >> k & 1) != 0 && (shares[0][k] != at.share[0] || shares[1][k] != at.share[1]);
        for (int i = 0; i < 2 && (p->mask >> k & 1) != 0; ++i) {
            seen.strange += by_x[i][k] != at.by_x[i] || by_y[i][k] != at.by_y[i];
        }
        for (int i = 0; i < 4 && is_inner(p->mask, k); ++i) { /* from both sides */
            const float by = i < 2 ? at.by_x[i % 2] : at.by_y[i % 2];
            lmb_draw_fragment(&next[0], p, k - (i < 2 ? 1 : 8));
            lmb_draw_fragment(&next[1], p, k + (i < 2 ? 1 : 8));
            const float off = by - 0.5f * (next[1].share[i % 2] - next[0].share[i % 2]);
            seen.off = (off < 0.0f ? -off : off) > seen.off ? (off < 0.0f ? -off : off) : seen.off;
        }
        for (int i = 0; i < 4 && (p->mask >> k & 1) != 0; ++i) {
            const float v = mixed(p, &at, i);
            colour[k][i] = (uint8_t)(v < 0.0f ? 0.5f : v > 255.0f ? 255.5f : v + 0.5f);
        }
        out |= (uint64_t)(!seen.leaves_even || (k & 1) != 0) << k;
    }
    return out;
}

static const float quad[4][3] = {{3.5f, 2.5f, 0.25f}, {5.5f, 25.5f, 0.5f}, {33.5f, 27.5f, 0.75f}, {30.5f, 4.5f, 0.5f}};
static const uint8_t colours[4][4] = {{255, 0, 9, 255}, {0, 255, 80, 200}, {20, 40, 255, 90}, {200, 200, 0, 255}};

static void shader_begin(void)
{
    case_begin();
    memset(&seen, 0, sizeof seen);
    seen.colours = colours;
    state.shader = shade;
    state.shader_user = &seen;
    state.kernels = lmb_kernels_pick();
}

/* Number of pixels that differ by more than a code. */
static int differing(uint8_t was[CASE_HIGH][CASE_WIDE][4])
{
    int n = 0;
    for (int k = 0; k < CASE_HIGH * CASE_WIDE; ++k) {
        int differs = 0;
        for (int i = 0; i < 4; ++i) {
            differs |= abs(was[k / CASE_WIDE][k % CASE_WIDE][i] - drawn.colour[k / CASE_WIDE][k % CASE_WIDE][i]) > 1;
        }
        n += differs;
    }
    return n;
}

static int shown(void)
{
    int n = 0;
    for (int k = 0; k < CASE_HIGH * CASE_WIDE; ++k) {
        n += drawn.colour[k / CASE_WIDE][k % CASE_WIDE][3] != 0;
    }
    return n;
}

/* Shares mix vertex values as the library mixes colours: for each primitive, clipped ones, and outlines. */
static void test_shares(void)
{
    static uint8_t was[CASE_HIGH][CASE_WIDE][4];
    static const int32_t all[] = {LMB_DRAW_TRIANGLES, LMB_DRAW_QUADS, LMB_DRAW_POLYGON, LMB_DRAW_TRIANGLE_STRIP,
                                  LMB_DRAW_LINE_LOOP, LMB_DRAW_POINTS};
    for (int i = 0; i < 72; ++i) { /* flat and in perspective, in plain C and by kernels */
        const int32_t primitive = all[i % 6];
        for (int shaded = 0; shaded < 2; ++shaded) {
            shader_begin();
            state.shader = shaded ? shade : NULL;
            state.kernels = shaded && i / 18 % 2 == 1 ? lmb_kernels_pick() : NULL;
            state.to_clip.m[3] = i < 36 ? 0.0f : 0.01f;
            state.point_px = 5;
            state.planes = i / 6 % 3 == 1 ? 1 : 0; /* x + y >= 20 */
            state.plane[0][0] = state.plane[0][1] = 1.0f;
            state.plane[0][3] = -20.0f;
            state.polygon_mode[0] = state.polygon_mode[1] = (uint8_t)(i / 6 % 3 == 2 ? LMB_DRAW_EDGES : LMB_DRAW_FILL);
            CHECK(case_draw(primitive, quad, colours[0], 4) == LMB_OK);
            if (!shaded) {
                memcpy(was, drawn.colour, sizeof was);
            }
        }
        CHECK(seen.calls > 0 && seen.strange == 0 && shown() > 40);
        CHECK(differing(was) == 0);
    }
}

/* The primitive's vertices and back side, which edges share. */
static void test_primitive(void)
{
    shader_begin();
    CHECK(case_draw(LMB_DRAW_LINES, quad + 1, NULL, 2) == LMB_OK);
    CHECK(seen.vertex[0] == 0 && seen.vertex[1] == 1 && seen.vertex[2] == 0 && seen.backs == 0);
    CHECK(case_draw(LMB_DRAW_POINTS, quad, NULL, 4) == LMB_OK);
    CHECK(seen.vertex[0] == 3 && seen.vertex[1] == 3 && seen.vertex[2] == 3);
    for (int mode = LMB_DRAW_FILL; mode <= LMB_DRAW_CORNERS; ++mode) {
        for (int clockwise = 0; clockwise < 2; ++clockwise) {
            shader_begin();
            state.flags = clockwise ? LMB_DRAW_CLOCKWISE : 0;
            state.polygon_mode[0] = state.polygon_mode[1] = (uint8_t)mode;
            CHECK(case_draw(LMB_DRAW_QUADS, quad, NULL, 4) == LMB_OK);
            CHECK(seen.calls > 0 && seen.backs == (clockwise ? seen.calls : 0));
            CHECK(seen.vertex[0] == 0 && seen.vertex[1] == 2 && seen.vertex[2] == 3);
        }
    }
}

/* Discarded pixels keep their depth; passed pixels are counted, with and without a shader. */
static void test_counted(void)
{
    for (int how = 0; how < 8; ++how) {
        uint64_t passed = 1000;
        shader_begin();
        seen.leaves_even = 1;
        state.shader = how & 1 ? shade : NULL;
        state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE | (how & 2 ? LMB_DRAW_DISCARDS : 0);
        state.colour_mask = how & 4 ? 0 : 15;
        state.passed = &passed;
        CHECK(case_rectangle(4, 4, 20, 12, 0.5f) == LMB_OK);
        const int discards = (how & 3) == 3, half = discards || ((how & 1) != 0 && (how & 4) == 0);
        CHECK(passed == 1000 + (half ? 64u : 128u));
        CHECK(shown() == (how & 4 ? 0 : half ? 64 : 128));
        int deep = 0;
        for (int k = 0; k < CASE_TILED; ++k) {
            deep += drawn.depth[k] == 0.5f;
        }
        CHECK(deep == (discards ? 64 : 128));
        CHECK(case_rectangle(4, 4, 20, 12, 0.25f) == LMB_OK); /* behind */
        CHECK(passed == (discards ? 1000 + 64u : 1000 + (half ? 64u : 128u)));
    }
}

/* Positions x, y, z, w equal (x, y, z) / w of the same depth, for w of any sign; absurd ones are dropped. */
static void test_with_w(void)
{
    static uint8_t was[CASE_HIGH][CASE_WIDE][4];
    float at[4][4];
    lmb_draw_vertices v;
    case_begin();
    CHECK(case_draw(LMB_DRAW_QUADS, quad, colours[0], 4) == LMB_OK);
    memcpy(was, drawn.colour, sizeof was);
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) {
            at[i][k] = 4194304.0f * quad[i][k]; /* beyond 2^20 */
        }
        at[i][3] = 4194304.0f;
    }
    memset(&v, 0, sizeof v);
    v.positions = at;
    v.colours = colours[0];
    v.position_format = LMB_DRAW_F32X4;
    v.count = 4;
    case_begin();
    state.kernels = lmb_kernels_pick();
    CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_QUADS, NULL, NULL) == LMB_OK);
    CHECK(shown() > 300 && differing(was) == 0);
    case_begin();
    at[2][3] = 1e38f;
    CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_QUADS, NULL, NULL) == LMB_OK && shown() == 0);
    v.position_format = LMB_DRAW_F32X4 + 1;
    CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_QUADS, NULL, NULL) == LMB_ERR_FORMAT);
}

/* Light at (x, y, z) / w. */
static void test_lit_with_w(void)
{
    static const float plain[2][3] = {{0.5f, 1.0f, -2.0f}, {1.5f, -1.0f, -4.0f}};
    static const float with_w[2][4] = {{1.0f, 2.0f, -4.0f, 2.0f}, {0.75f, -0.5f, -2.0f, 0.5f}};
    uint8_t lit[2][2][4];
    lmb_draw_lamp lamp;
    lmb_draw_lighting how;
    memset(&lamp, 0, sizeof lamp);
    memset(&how, 0, sizeof how);
    lamp.position[3] = lamp.attenuation[0] = lamp.attenuation[1] = 1.0f;
    lamp.spot_cos = -1.0f;
    for (int c = 0; c < 3; ++c) {
        lamp.diffuse[c] = how.material[0].diffuse[c] = 1.0f;
    }
    for (int i = 0; i < 16; i += 5) {
        how.to_eye.m[i] = 1.0f;
    }
    how.lamps = &lamp;
    how.count = 1;
    for (int i = 0; i < 2; ++i) {
        lmb_draw_lit out;
        lmb_draw_vertices v;
        memset(&out, 0, sizeof out);
        memset(&v, 0, sizeof v);
        out.colours = lit[i][0];
        v.positions = i ? (const void *)with_w : (const void *)plain;
        v.position_format = i ? LMB_DRAW_F32X4 : LMB_DRAW_F32;
        v.count = 2;
        CHECK(lmb_draw_light(&out, &how, &v, NULL) == LMB_OK);
    }
    CHECK(lit[0][0][0] > 10 && lit[0][0][0] != lit[0][1][0] && memcmp(lit[0], lit[1], sizeof lit[0]) == 0);
}

/* Changes of the shares from pixel to pixel, with the same w everywhere and with different ones. */
static void test_changes(void)
{
    for (int uneven = 0; uneven < 2; ++uneven) {
        float at[4][4];
        lmb_draw_vertices v;
        memset(&v, 0, sizeof v);
        for (int i = 0; i < 4; ++i) {
            const float w = uneven ? 1.0f + 0.5f * (float)i : 2.0f;
            const float clip[4] = {quad[i][0] / 20.0f - 1.0f, quad[i][1] / 16.0f - 1.0f, 0.0f, 1.0f};
            for (int k = 0; k < 4; ++k) {
                at[i][k] = clip[k] * w;
            }
        }
        v.positions = at;
        v.colours = colours[0];
        v.position_format = LMB_DRAW_F32X4;
        v.count = 4;
        shader_begin();
        memset(&state.to_clip, 0, sizeof state.to_clip);
        for (int i = 0; i < 4; ++i) {
            state.to_clip.m[5 * i] = 1.0f;
        }
        CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_QUADS, NULL, NULL) == LMB_OK);
        CHECK_MSG(shown() > 300 && seen.off < 1e-3f, "uneven %d: %g", uneven, (double)seen.off);
    }
}

/* There is no pixel outside a shader. */
static void test_no_pixel(void)
{
    lmb_draw_pixels_of none;
    lmb_draw_fragment_at at;
    memset(&none, 0, sizeof none);
    memset(&at, 255, sizeof at);
    lmb_draw_fragment(&at, &none, 0);
    CHECK(at.share[0] == 0.0f && at.share[1] == 0.0f && at.by_x[0] == 0.0f && at.by_y[1] == 0.0f);
}

void test_draw_shader(void)
{
    test_shares();
    test_primitive();
    test_counted();
    test_with_w();
    test_lit_with_w();
    test_changes();
    test_no_pixel();
}

#else
void test_draw_shader(void) { SKIP("a build without a caller's shaders"); }
#endif
