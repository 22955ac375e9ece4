/* test_draw_pixels.c: the operations on a drawn pixel: tests, textures, fog, blending, formats. */
#include "../draw_case.h"

#include <math.h>

void test_draw_pixels(void);

#if LMB_DRAW

static void set_colour(uint8_t out[4], test_rng *r)
{
    const uint32_t v = test_random(r);
    for (int i = 0; i < 4; ++i) {
        const uint32_t byte = v >> 8 * i & 255u;
        out[i] = (uint8_t)(byte < 40 ? 0 : byte > 215 ? 255 : byte);
    }
}

/* --- blending ----------------------------------------------------------------------------------------------------- */

static double factor_of(int f, const uint8_t s[4], const uint8_t t[4], const uint8_t c[4], int i)
{
    const double sa = s[3] / 255.0, ta = t[3] / 255.0;
    const double all[15] = {0,
                            1,
                            s[i] / 255.0,
                            1 - s[i] / 255.0,
                            sa,
                            1 - sa,
                            ta,
                            1 - ta,
                            t[i] / 255.0,
                            1 - t[i] / 255.0,
                            i == 3 ? 1 : fmin(sa, 1 - ta),
                            c[i] / 255.0,
                            1 - c[i] / 255.0,
                            c[3] / 255.0,
                            1 - c[3] / 255.0};
    return all[f];
}

static double blended(const lmb_draw_state *st, const uint8_t s[4], const uint8_t t[4], int i)
{
    const int a = i == 3;
    const double x = s[i] * factor_of(st->blend_source[a], s, t, st->blend_colour, i),
                 y = t[i] * factor_of(st->blend_target[a], s, t, st->blend_colour, i);
    switch (st->blend_equation[a]) {
    case LMB_DRAW_ADD:
        return fmin(x + y, 255);
    case LMB_DRAW_SUBTRACT:
        return fmax(x - y, 0);
    case LMB_DRAW_REVERSE_SUBTRACT:
        return fmax(y - x, 0);
    case LMB_DRAW_MIN:
        return s[i] < t[i] ? s[i] : t[i];
    default:
        return s[i] > t[i] ? s[i] : t[i];
    }
}

/* All factors and equations for colour and alpha: the exact quotient, rounded to nearest. */
static void test_blends(void)
{
    test_rng r = {9};
    int wrong = 0;
    case_begin();
    state.flags = LMB_DRAW_BLEND;
    for (int n = 0; n < 15 * 15 * 5; ++n) {
        uint8_t before[8][4];
        state.blend_source[0] = (uint8_t)(n % 15);
        state.blend_target[0] = (uint8_t)(n / 15 % 15 == LMB_DRAW_SATURATE ? 0 : n / 15 % 15);
        state.blend_equation[0] = (uint8_t)(n / 225);
        state.blend_source[1] = (uint8_t)(test_random(&r) % 15);
        state.blend_target[1] = (uint8_t)(test_random(&r) % 10);
        state.blend_equation[1] = (uint8_t)(test_random(&r) % 5);
        set_colour(state.colour, &r);
        set_colour(state.blend_colour, &r);
        for (int k = 0; k < 8; ++k) {
            set_colour(drawn.colour[0][k], &r);
            memcpy(before[k], drawn.colour[0][k], 4);
        }
        CHECK(case_rectangle(0, 0, 8, 1, 0) == LMB_OK);
        for (int k = 0; k < 32; ++k) {
            const double right = blended(&state, state.colour, before[k / 4], k % 4);
            wrong += fabs(right - drawn.colour[0][k / 4][k % 4]) > 0.5 + 1e-9;
        }
    }
    CHECK_MSG(wrong == 0, "%d channels", wrong);
}

/* The order does not matter for ONE and ONE (up to 255), MIN and MAX. */
static void test_commutes(void)
{
    for (int kind = 0; kind < 3; ++kind) {
        uint64_t hash[2];
        for (int turn = 0; turn < 2; ++turn) {
            test_rng r = {4};
            uint8_t colours[10][4];
            case_begin();
            state.flags = LMB_DRAW_BLEND;
            state.blend_target[0] = state.blend_target[1] = LMB_DRAW_ONE;
            state.blend_equation[0] = state.blend_equation[1] = (uint8_t)(kind == 0   ? LMB_DRAW_ADD
                                                                          : kind == 1 ? LMB_DRAW_MIN
                                                                                      : LMB_DRAW_MAX);
            for (int i = 0; i < 10; ++i) {
                set_colour(colours[i], &r);
            }
            memset(drawn.colour, kind == 1 ? 255 : 0, sizeof drawn.colour);
            for (int k = 0; k < 10; ++k) {
                const int i = turn ? 9 - k : k;
                memcpy(state.colour, colours[i], 4);
                CHECK(case_rectangle((float)i, (float)i / 2, (float)i + 20, 20, 0) == LMB_OK);
            }
            hash[turn] = lmb_surface_hash(&drawn_on.colour);
        }
        CHECK(hash[0] == hash[1]);
    }
}

static void test_logic(void)
{
    static const int32_t formats[2] = {LMB_RGBA8, LMB_RGB565};
    for (int f = 0; f < 2; ++f) {
        for (uint32_t op = 0; op < 16; ++op) {
            case_begin();
            CHECK(lmb_surface_init(&drawn_on.colour, formats[f], CASE_WIDE, CASE_HIGH, drawn.colour,
                                   sizeof drawn.colour) == LMB_OK);
            state.flags = LMB_DRAW_LOGIC | LMB_DRAW_BLEND;
            state.logic_op = (uint8_t)op;
            state.colour[0] = 0xf0, state.colour[1] = 0x3c, state.colour[2] = 0xaa, state.colour[3] = 0x18;
            const uint8_t was[4] = {0xcc, 0x5a, 0x33, 0x81};
            memcpy(drawn.colour[0][0], was, 4);
            CHECK(case_rectangle(0, 0, 1, 1, 0) == LMB_OK);
            const uint32_t high =
                (0xf0u * 31 + 127) / 255 << 11 | (0x3cu * 63 + 127) / 255 << 5 | (0xaau * 31 + 127) / 255;
            uint16_t got, from;
            memcpy(&got, drawn.colour[0][0], 2);
            memcpy(&from, was, 2);
            int wrong = 0;
            for (int bit = 0; bit < (f == 0 ? 32 : 16); ++bit) {
                const int s = f == 0 ? state.colour[bit / 8] >> bit % 8 & 1 : (int)(high >> bit & 1u);
                const int t = f == 0 ? was[bit / 8] >> bit % 8 & 1 : from >> bit & 1;
                const int new_bit = f == 0 ? drawn.colour[0][0][bit / 8] >> bit % 8 & 1 : got >> bit & 1;
                wrong += new_bit != (int)(op >> (3 - 2 * s - t) & 1u);
            }
            CHECK_MSG(wrong == 0, "format %d, op %u", f, op);
        }
    }
}

static void test_masks(void)
{
    for (int mask = 0; mask < 16; ++mask) {
        case_begin();
        state.colour_mask = (uint8_t)mask;
        CHECK(case_rectangle(0, 0, 4, 4, 0) == LMB_OK);
        for (int i = 0; i < 4; ++i) {
            CHECK(drawn.colour[1][1][i] == (mask >> i & 1 ? 255 : 0));
        }
    }
}

/* --- tests -------------------------------------------------------------------------------------------------------- */

static void test_functions(void)
{
    for (int func = 0; func < 8; ++func) {
        for (int order = -1; order <= 1; ++order) {
            const int passes = order < 0 ? func & 1 : order == 0 ? func >> 1 & 1 : func >> 2 & 1;
            case_begin();
            state.flags = LMB_DRAW_ALPHA_TEST;
            state.alpha_func = (uint8_t)func;
            state.alpha_value = 100;
            state.colour[3] = (uint8_t)(100 + order);
            CHECK(case_rectangle(0, 0, 4, 4, 0) == LMB_OK && (drawn.colour[1][1][0] != 0) == passes);
            case_begin();
            state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
            state.depth_func = LMB_DRAW_ALWAYS;
            CHECK(case_rectangle(0, 0, 8, 8, 0.5f) == LMB_OK && drawn.depth[9] == 0.5f);
            memset(drawn.colour, 0, sizeof drawn.colour);
            state.depth_func = (uint8_t)func;
            CHECK(case_rectangle(0, 0, 8, 8, 0.5f + 0.125f * (float)order) == LMB_OK);
            CHECK((drawn.colour[1][1][0] != 0) == passes &&
                  drawn.depth[9] == (passes ? 0.5f + 0.125f * (float)order : 0.5f));
            case_begin();
            case_count();
            state.stencil_func = (uint8_t)func;
            state.stencil_mask = 0x7f;
            state.stencil_value = (uint8_t)(0x80 + 50 + order);
            drawn.stencil[1][1] = 50;
            CHECK(case_rectangle(0, 0, 4, 4, 0) == LMB_OK && (drawn.colour[1][1][0] != 0) == passes);
        }
    }
}

static void test_stencil(void)
{
    static const uint8_t from[3] = {0, 77, 255};
    static const uint8_t right[8][3] = {{0, 77, 255}, {0, 0, 0},     {9, 9, 9},  {1, 78, 255},
                                        {0, 76, 254}, {255, 178, 0}, {1, 78, 0}, {255, 76, 254}};
    for (int op = 0; op < 8; ++op) {
        for (int way = 0; way < 3; ++way) { /* the stencil fails, the depth fails, both pass */
            case_begin();
            state.flags = LMB_DRAW_STENCIL | LMB_DRAW_DEPTH_TEST;
            state.stencil_value = 9;
            state.stencil_func = way == 0 ? LMB_DRAW_NEVER : LMB_DRAW_ALWAYS;
            state.depth_func = way == 1 ? LMB_DRAW_NEVER : LMB_DRAW_ALWAYS;
            state.stencil_op[way] = (uint8_t)op;
            memcpy(drawn.stencil[2], from, 3);
            CHECK(case_rectangle(0, 2, 3, 3, 0) == LMB_OK);
            CHECK_MSG(memcmp(drawn.stencil[2], right[op], 3) == 0, "op %d, %d", op, way);
            CHECK((drawn.colour[2][1][0] != 0) == (way == 2) && drawn.stencil[1][1] == 0);
            memcpy(drawn.stencil[2], from, 3);
            state.stencil_write = 0x0f;
            CHECK(case_rectangle(0, 2, 3, 3, 0) == LMB_OK);
            CHECK(drawn.stencil[2][1] == ((77 & 0xf0) | (right[op][1] & 0x0f)));
        }
    }
}

/* Depth range, 16 bits, offsets. A failed alpha test leaves depth and stencil alone. */
static void test_depths(void)
{
    static uint16_t codes[CASE_TILED];
    case_begin();
    state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
    state.depth_range[0] = 0.25f, state.depth_range[1] = 0.75f;
    CHECK(case_rectangle(0, 0, 8, 8, 0.5f) == LMB_OK && drawn.depth[0] == 0.5f);
    CHECK(case_rectangle(0, 0, 8, 8, 1.0f) == LMB_OK && drawn.depth[0] == 0.75f);
    state.depth_range[0] = 1, state.depth_range[1] = 0;
    CHECK(case_rectangle(0, 0, 8, 8, 0.125f) == LMB_OK && drawn.depth[0] == 0.875f);
    state.depth_range[0] = 0, state.depth_range[1] = 1;
    state.offset_units = 3;
    CHECK(case_rectangle(0, 0, 8, 8, 0.875f) == LMB_OK && drawn.depth[0] == 0.875f + 3 * 0x1p-24f);
    state.offset_units = 0, state.offset_slope = 2;
    const float slope[4][3] = {{8, 0, 0.5f}, {8, 8, 0.5f}, {16, 8, 0.75f}, {16, 0, 0.75f}}; /* 1/32 per px */
    CHECK(case_draw(LMB_DRAW_QUADS, slope, NULL, 4) == LMB_OK && drawn.depth[64] == 0.5f + 0.5f / 32 + 2.0f / 32);
    case_begin();
    memset(codes, 0, sizeof codes);
    CHECK(lmb_surface_init(&drawn_on.depth, LMB_DEPTH16, CASE_WIDE, CASE_HIGH, codes, sizeof codes) == LMB_OK);
    state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
    drawn_on.depth_far = 0.5f;
    CHECK(case_rectangle(0, 0, 8, 8, 1.0f) == LMB_OK && codes[0] == 65535);
    CHECK(case_rectangle(8, 0, 16, 8, 0.75f) == LMB_OK && codes[64] == 1 + 65534 / 2);
    CHECK(case_rectangle(16, 0, 24, 8, 0.25f) == LMB_OK && codes[128] == 0);
    case_begin();
    case_count();
    state.flags |= LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE | LMB_DRAW_ALPHA_TEST;
    state.alpha_func = LMB_DRAW_LESS;
    state.alpha_value = 255;
    CHECK(case_rectangle(0, 0, 8, 8, 0.5f) == LMB_OK && drawn.depth[0] == 0 && drawn.stencil[0][0] == 0);
}

/* --- textures ----------------------------------------------------------------------------------------------------- */

static uint8_t image[8 * 8 * 4 * 2];

static lmb_texture make_texture(int filter, int wrap)
{
    test_rng r = {2};
    const lmb_texture t = {image, 8, 8, 4, (uint8_t)wrap, (uint8_t)wrap, (uint8_t)filter, LMB_TEXELS_RGBA8};
    for (int i = 0; i < 8 * 8 * 4; ++i) {
        image[i] = (uint8_t)test_random(&r);
    }
    memset(image + 256, 100, 64), memset(image + 256 + 64, 150, 16), memset(image + 256 + 80, 200, 4);
    return t;
}

/* A square of 16 x 16 px with texture coordinates from u0 to u1 and from v0 to v1. */
static lmb_status textured(float u0, float u1, float size)
{
    const float c[4][3] = {{0, 0, 0}, {0, size, 0}, {size, size, 0}, {size, 0, 0}},
                uv[4][2] = {{u0, u0}, {u0, u1}, {u1, u1}, {u1, u0}};
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    v.positions = c;
    v.uvs[0] = v.uvs[1] = uv;
    v.count = 4;
    return lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_QUADS, NULL, NULL);
}

static int wrapped(int i, int wrap)
{
    const int m = ((i % 16) + 16) % 16;
    return wrap == LMB_WRAP_CLAMP    ? (i < 0   ? 0
                                        : i > 7 ? 7
                                                : i)
           : wrap == LMB_WRAP_MIRROR ? (m > 7 ? 15 - m : m)
                                     : m % 8;
}

/* Texel by texel, three periods wide, with each wrap mode; bilinear at texel corners. */
static void test_wraps(void)
{
    for (int wrap = 0; wrap < 3; ++wrap) {
        const lmb_texture nearest = make_texture(LMB_NEAREST, wrap), bilinear = make_texture(LMB_BILINEAR, wrap);
        int wrong = 0, off = 0;
        case_begin();
        state.stage[0].texture = &nearest;
        state.stage[0].mode = LMB_DRAW_REPLACE;
        CHECK(textured(-1.0f, 3.0f, 32) == LMB_OK);
        for (int i = 0; i < 32 * 32; ++i) {
            const uint8_t *right = image + 4 * (8 * wrapped(i / 32 - 8, wrap) + wrapped(i % 32 - 8, wrap));
            wrong += memcmp(drawn.colour[i / 32][i % 32], right, 4) != 0;
        }
        state.stage[0].texture = &bilinear;
        CHECK(textured(-1.0f + 0.5f / 8, 3.0f + 0.5f / 8, 32) == LMB_OK);
        for (int i = 0; i < 31 * 31 * 4; ++i) {
            const int y = i / 4 / 31 - 8, x = i / 4 % 31 - 8, c = i % 4;
            int sum = 0;
            for (int k = 0; k < 4; ++k) {
                sum += image[4 * (8 * wrapped(y + (k >> 1), wrap) + wrapped(x + (k & 1), wrap)) + c];
            }
            off += abs(4 * drawn.colour[y + 8][x + 8][c] - sum) > 6;
        }
        CHECK_MSG(wrong == 0 && off == 0, "wrap %d: %d, %d", wrap, wrong, off);
    }
}

static void test_levels(void)
{
    const lmb_texture t = make_texture(LMB_TRILINEAR, LMB_WRAP_REPEAT);
    static const struct {
        float size, bias;
        int right;
    } all[] = {{4, 0, 100}, {2, 0, 150}, {1, 0, 200}, {8, 1, 100}, {4, 0.5f, 125}, {4, 9, 200}, {2, -1, 100}};
    for (int i = 0; i < 7; ++i) {
        case_begin();
        state.stage[1].texture = &t;
        state.stage[1].mode = LMB_DRAW_REPLACE;
        state.stage[1].level_bias = all[i].bias;
        CHECK(textured(0, 1, all[i].size) == LMB_OK);
        CHECK_MSG(abs(drawn.colour[0][0][1] - all[i].right) <= 1, "%d: %d", i, drawn.colour[0][0][1]);
    }
}

static void test_texels(void)
{
    static const uint16_t codes[4] = {0xf800, 0x07e0, 0x001f, 0x8410};
    uint8_t palette[64 + 2];
    lmb_texture t = {(const uint8_t *)codes, 2, 2, 1, 0, 0, 0, LMB_TEXELS_RGB565};
    static const uint8_t right[4][4] = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {132, 130, 132, 255}};
    case_begin();
    state.stage[0].texture = &t;
    state.stage[0].mode = LMB_DRAW_REPLACE;
    if (!LMB_TEXTURE_FORMATS) {
        CHECK(textured(0, 1, 2) == LMB_ERR_FORMAT);
        return;
    }
    CHECK(textured(0, 1, 2) == LMB_OK);
    CHECK(memcmp(drawn.colour[0][0], right[0], 8) == 0 && memcmp(drawn.colour[1][0], right[2], 8) == 0);
    memset(palette, 0, sizeof palette);
    memcpy(palette + 4 * 7, right, sizeof right);
    palette[64] = 0x87, palette[65] = 0xa9;
    t.texels = palette;
    t.format = LMB_TEXELS_PALETTE4;
    memset(drawn.colour, 0, sizeof drawn.colour);
    CHECK(textured(0, 1, 2) == LMB_OK);
    CHECK(memcmp(drawn.colour[0][0], right[0], 8) == 0 && memcmp(drawn.colour[1][0], right[2], 8) == 0);
}

/* Both stages in each mode, against the formulas in binary64. */
static void test_modes(void)
{
    test_rng r = {8};
    lmb_texture t[2];
    uint8_t texel[2][4];
    double worst = 0;
    for (int n = 0; n < 25 * 8; ++n) {
        case_begin();
        set_colour(state.colour, &r);
        double c[4];
        for (int i = 0; i < 4; ++i) {
            c[i] = state.colour[i];
        }
        for (int k = 0; k < 2; ++k) {
            lmb_draw_stage *s = &state.stage[k];
            set_colour(texel[k], &r);
            uint8_t own[4];
            set_colour(own, &r);
            memcpy(s->colour, own, sizeof s->colour);
            memset(&t[k], 0, sizeof t[k]);
            t[k].texels = texel[k], t[k].width = t[k].height = t[k].levels = 1, t[k].filter = (uint8_t)(n % 3);
            s->texture = &t[k];
            s->mode = (uint8_t)(k == 0 ? n % 5 : n / 5 % 5);
            const double a = texel[k][3] / 255.0;
            for (int i = 0; i < 3; ++i) {
                const double x = texel[k][i];
                const double all[5] = {c[i] * x / 255, x, c[i] * (1 - a) + x * a,
                                       c[i] * (1 - x / 255) + s->colour[i] * x / 255, fmin(c[i] + x, 255)};
                c[i] = floor(all[s->mode] + 0.5);
            }
            c[3] = s->mode == LMB_DRAW_REPLACE ? texel[k][3] : s->mode == LMB_DRAW_DECAL ? c[3] : floor(c[3] * a + 0.5);
        }
        CHECK(textured(0, 1, 2) == LMB_OK);
        for (int i = 0; i < 4; ++i) {
            worst = fmax(worst, fabs(drawn.colour[1][1][i] - c[i]));
        }
    }
    CHECK_MSG(worst == 0, "%g", worst);
}

/* --- fog, shading, formats ---------------------------------------------------------------------------------------- */

static void test_fog(void)
{
    double worst = 0;
    for (int fog = 1; fog <= 3; ++fog) {
        const float c[4][3] = {{0, 0, 0}, {0, 8, 0}, {32, 8, 0}, {32, 0, 0}};
        case_begin();
        state.fog = (uint8_t)fog;
        state.fog_axis[0] = 0.25f; /* distance x / 4 */
        state.fog_start = 1, state.fog_end = 7;
        state.fog_density = 0.3f;
        state.fog_colour[1] = 200;
        CHECK(case_draw(LMB_DRAW_QUADS, c, NULL, 4) == LMB_OK);
        for (int x = 0; x < 32; ++x) {
            const double d = (x + 0.5) / 4, t = 0.3 * d;
            const double f = fmin(fmax(fog == 1 ? (7 - d) / 6 : fog == 2 ? exp(-t) : exp(-t * t), 0), 1);
            worst = fmax(worst, fabs(255 * f - drawn.colour[4][x][0]));
            worst = fmax(worst, fabs(255 * f + 200 * (1 - f) - drawn.colour[4][x][1]));
        }
    }
    CHECK_MSG(worst < 1.01, "%g", worst);
}

/* Flat shading uses the last vertex's colour; both halves of a quad have one colour. Equal colours stay unchanged. */
static void test_shades(void)
{
    static const float c[4][3] = {{0.3f, 0.2f, 0}, {1.1f, 19, 0}, {23, 22, 0}, {27, 1, 0}};
    static const uint8_t colours[4][4] = {{10, 0, 0, 255}, {20, 0, 0, 255}, {30, 0, 0, 255}, {40, 0, 0, 255}};
    static const struct {
        int32_t primitive;
        int right[2]; /* lower left, upper right */
    } all[] = {{LMB_DRAW_QUADS, {40, 40}}, {LMB_DRAW_TRIANGLE_FAN, {30, 40}}};
    for (int i = 0; i < 2; ++i) {
        case_begin();
        state.flags = LMB_DRAW_FLAT;
        CHECK(case_draw(all[i].primitive, c, &colours[0][0], 4) == LMB_OK);
        CHECK(drawn.colour[16][4][0] == all[i].right[0] && drawn.colour[4][20][0] == all[i].right[1]);
    }
    case_begin();
    state.colour[0] = 137;
    CHECK(case_draw(LMB_DRAW_TRIANGLES, c, NULL, 3) == LMB_OK);
    for (int k = 0; k < CASE_HIGH * CASE_WIDE; ++k) {
        const uint8_t *p = drawn.colour[k / CASE_WIDE][k % CASE_WIDE];
        CHECK(p[3] == 0 || p[0] == 137);
    }
}

/* Each format stores the drawn values; with dither, their mean. Blending with alpha 0 changes no bit. */
static void test_targets(void)
{
    for (int format = LMB_RGB565; format <= LMB_BGRA8; ++format) {
        const int bytes = lmb_pixel_bytes(format);
        double mean[3] = {0, 0, 0};
        case_begin();
        CHECK(lmb_surface_init(&drawn_on.colour, format, CASE_WIDE, CASE_HIGH, drawn.colour, sizeof drawn.colour) ==
              LMB_OK);
        state.flags = LMB_DRAW_DITHER;
        state.colour[0] = 100, state.colour[1] = 150, state.colour[2] = 203;
        CHECK(case_rectangle(0, 0, 8, 8, 0) == LMB_OK);
        for (int k = 0; k < 64; ++k) {
            const uint8_t *p = &drawn.colour[0][0][0] + drawn_on.colour.stride_bytes * (k / 8) + bytes * (k % 8);
            const uint32_t v =
                format == LMB_RGB565_BE ? (uint32_t)p[0] << 8 | p[1] : (uint32_t) * (const uint16_t *)(const void *)p;
            const int wide = bytes == 4, green = format == LMB_RGB555 ? 31 : 63;
            mean[0] += wide ? p[format == LMB_BGRA8 ? 2 : 0] : (v >> (format == LMB_RGB555 ? 10 : 11)) * 255.0 / 31;
            mean[1] += wide ? p[1] : (v >> 5 & (uint32_t)green) * 255.0 / green;
            mean[2] += wide ? p[format == LMB_BGRA8 ? 0 : 2] : (v & 31) * 255.0 / 31;
        }
        CHECK_MSG(fabs(mean[0] / 64 - 100) < 0.1 && fabs(mean[1] / 64 - 150) < 0.1 && fabs(mean[2] / 64 - 203) < 0.1,
                  "format %d: %g %g %g", format, mean[0] / 64, mean[1] / 64, mean[2] / 64);
        const uint64_t hash = lmb_surface_hash(&drawn_on.colour);
        state.flags |= LMB_DRAW_BLEND;
        state.blend_source[0] = state.blend_source[1] = LMB_DRAW_SOURCE_ALPHA;
        state.blend_target[0] = state.blend_target[1] = LMB_DRAW_INVERSE_SOURCE_ALPHA;
        state.colour[3] = 0;
        CHECK(case_rectangle(0, 0, 40, 32, 0) == LMB_OK);
        CHECK(lmb_surface_hash(&drawn_on.colour) == hash && case_guard_is_whole());
    }
}

/* --- rectangles --------------------------------------------------------------------------------------------------- */

static float set_place(test_rng *r, uint32_t size) { return (float)(test_random(r) % size) / 256.0f - 7.0f; }

/* A quad on the grid of 1/256 px around the target: upright, folded, or with one corner moved. */
static void set_quad(float corner[4][3], test_rng *r)
{
    const float x0 = set_place(r, 14000), x1 = set_place(r, 14000);
    const float y0 = set_place(r, 12000), y1 = set_place(r, 12000);
    const float at[4][2] = {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}};
    const uint32_t first = test_random(r) % 4, way = test_random(r) % 2, kind = test_random(r) % 8;
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t from = (first + (way != 0 ? k : 4 - k)) % 4;
        corner[k][0] = at[from][0] + (kind == 0 && k == 2 ? 0.5f : 0.0f);
        corner[k][1] = kind == 1 && k > 1 ? y0 + y1 - at[from][1] : at[from][1] + (k + 1 == kind ? 0.5f : 0.0f);
        corner[k][2] = 0.25f * (float)(kind == 2 && k == 3);
    }
}

/* A quad has the pixels of its two triangles, if it is filled as a rectangle and if it is not. */
static void test_rectangles(void)
{
    static const uint8_t order[6] = {0, 1, 2, 0, 2, 3};
    const lmb_draw_indices split = {order, 6, LMB_DRAW_INDEX_U8};
    static uint8_t before[CASE_HIGH][CASE_WIDE][4], quad[CASE_HIGH][CASE_WIDE][4];
    test_rng r = {31};
    int wrong = 0, painted = 0;
    case_begin();
    for (int n = 0; n < 4000; ++n) {
        float corner[4][3], with_w[4][4];
        uint8_t colours[4][4];
        lmb_stats of_quad = {0}, of_triangles = {0};
        lmb_draw_vertices v;
        memset(&v, 0, sizeof v);
        set_quad(corner, &r);
        for (int k = 0; k < 4; ++k) {
            set_colour(colours[k], &r);
            if (n % 8 != 0) {
                memcpy(colours[k], colours[0], 4);
            }
        }
        for (int k = 0; k < 4; ++k) { /* the same places, at other distances */
            with_w[k][3] = (float)(1u << test_random(&r) % 3);
            for (int i = 0; i < 3; ++i) {
                with_w[k][i] = corner[k][i] * with_w[k][3];
            }
        }
        v.positions = n % 6 == 0 ? (const void *)with_w : (const void *)corner;
        v.position_format = n % 6 == 0 ? LMB_DRAW_F32X4 : LMB_DRAW_F32;
        v.colours = n % 3 == 0 ? &colours[0][0] : NULL;
        v.count = 4;
        set_colour(state.colour, &r);
        drawn_on.colour.format = n % 2 != 0 ? LMB_BGRA8 : LMB_RGBA8;
        state.kernels = n % 5 == 0 ? NULL : lmb_kernels_at((int32_t)(test_random(&r) % 5)); /* NULL past the last */
        state.flags = (n % 7 != 0 ? LMB_DRAW_BLEND : 0) | (n % 11 == 0 ? LMB_DRAW_SCISSOR : 0) |
                      (n % 13 == 0 && n % 8 != 0 ? LMB_DRAW_FLAT : 0) | (n % 17 == 0 ? LMB_DRAW_DEPTH_TEST : 0);
        state.depth_func = LMB_DRAW_ALWAYS;
        state.blend_source[0] = state.blend_source[1] = LMB_DRAW_SOURCE_ALPHA;
        state.blend_target[0] = state.blend_target[1] = n % 4 == 0 ? LMB_DRAW_ONE : LMB_DRAW_INVERSE_SOURCE_ALPHA;
        state.scissor[0] = 3;
        state.scissor[1] = 5;
        state.scissor[2] = 20;
        state.scissor[3] = 11;
        for (int i = 0; i < CASE_HIGH * CASE_WIDE; ++i) {
            set_colour(before[i / CASE_WIDE][i % CASE_WIDE], &r);
        }
        memcpy(drawn.colour, before, sizeof before);
        CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_QUADS, NULL, &of_quad) == LMB_OK);
        memcpy(quad, drawn.colour, sizeof quad);
        memcpy(drawn.colour, before, sizeof before);
        CHECK(lmb_draw_list(&drawn_on, &state, &v, LMB_DRAW_TRIANGLES, &split, &of_triangles) == LMB_OK);
        wrong += memcmp(quad, drawn.colour, sizeof quad) != 0 || !case_guard_is_whole() ||
                 memcmp(&of_quad, &of_triangles, sizeof of_quad) != 0;
        painted += memcmp(quad, before, sizeof quad) != 0;
    }
    CHECK_MSG(wrong == 0, "%d", wrong);
    CHECK_MSG(painted > 2000, "%d", painted);
}

void test_draw_pixels(void)
{
    test_blends();
    test_rectangles();
    test_commutes();
    test_logic();
    test_masks();
    test_functions();
    test_stencil();
    test_depths();
    test_wraps();
    test_levels();
    test_texels();
    test_modes();
    test_fog();
    test_shades();
    test_targets();
}

#else
void test_draw_pixels(void) { SKIP("a build without fixed-function drawing"); }
#endif
