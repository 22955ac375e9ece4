/* test_draw_lists.c: random lists of draws on every available backend, and in plain C, against the generic path. The
 * generic path has no shortcut for common states: it does not keep corners, and tests and blends pixels one by one. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../src/lane/kernels.h"
#include "../laid_surface.h"
#include "seed.h"

void test_draw_lists(void);

#if LMB_DRAW
enum { ROUNDS = 400, WIDE = 61, HIGH = 45, VERTICES = 60, CORNERS = 60, TEXELS = 16 * 8 };

/* The draws of a round, and their target. */
typedef struct lists {
    float positions[VERTICES][3], homogeneous[VERTICES][4], uvs[VERTICES][2];
    uint8_t colours[VERTICES][4], texels[2][4 * TEXELS];
    uint32_t indices[CORNERS];
    lmb_texture texture[2];
    lmb_draw_state state;
    lmb_draw_vertices vertices;
    int32_t primitive, format, depth_layout, is_upside_down, has_indices;
    uint32_t colour_before;
} lists;

typedef struct canvas {
    uint32_t colour[WIDE * HIGH];
    float depth[64 * 48];
    uint8_t stencil[WIDE * HIGH];
    lmb_stats stats;
} canvas;

static uint32_t any(test_rng *r, uint32_t count) { return test_random(r) % count; }

/* A quarter of all triangles is large; some corners are behind the eye, far out, or NaN. */
static void make_vertices(lists *l, test_rng *r)
{
    const float size = any(r, 4) == 0 ? 3.0f : 0.25f;
    float x = 0.0f, y = 0.0f, z = -3.0f;
    for (int i = 0; i < VERTICES; ++i) {
        if (i % 3 == 0) {
            x = test_uniform(r, -1.5f, 1.5f);
            y = test_uniform(r, -1.5f, 1.5f);
            z = test_uniform(r, -6.0f, -1.0f);
        }
        l->positions[i][0] = x + test_uniform(r, -size, size);
        l->positions[i][1] = y + test_uniform(r, -size, size);
        l->positions[i][2] = z + (any(r, 3) == 0 ? 0.0f : test_uniform(r, -size, size));
        l->uvs[i][0] = test_uniform(r, -1.5f, 2.5f);
        l->uvs[i][1] = test_uniform(r, -1.5f, 2.5f);
        if (any(r, 40) == 0) {
            const uint32_t hard = hard_bits[any(r, HARD_COUNT)];
            memcpy(any(r, 2) ? &l->positions[i][any(r, 3)] : &l->uvs[i][any(r, 2)], &hard, sizeof hard);
        }
    }
    const int one_colour = any(r, 3) == 0, is_solid = any(r, 2) == 0;
    for (int i = 0; i < 4 * VERTICES; ++i) {
        l->colours[i / 4][i % 4] = (uint8_t)(one_colour && i >= 4 ? l->colours[0][i % 4] : any(r, 256));
        l->colours[i / 4][i % 4] = is_solid && i % 4 == 3 ? 255 : l->colours[i / 4][i % 4];
    }
    for (int i = 0; i < CORNERS; ++i) {
        l->indices[i] = any(r, 60) == 0  ? VERTICES + any(r, 9)
                        : any(r, 3) == 0 ? any(r, VERTICES)
                                         : (uint32_t)(i % VERTICES);
    }
}

/* The same positions times w, which is often 1. */
static void make_homogeneous(lists *l, test_rng *r)
{
    for (int i = 0; i < VERTICES; ++i) {
        const float w = any(r, 3) ? 1.0f : test_uniform(r, -0.5f, 2.0f);
        for (int k = 0; k < 3; ++k) {
            l->homogeneous[i][k] = l->positions[i][k] * w;
        }
        l->homogeneous[i][3] = w;
    }
    if (any(r, 3) == 0) {
        l->vertices.positions = l->homogeneous;
        l->vertices.position_format = LMB_DRAW_F32X4;
    }
}

static void make_textures(lists *l, test_rng *r)
{
    for (int k = 0; k < 2; ++k) {
        const lmb_texture t = {l->texels[k],    16, 8, 1, (uint8_t)any(r, 3), (uint8_t)any(r, 3), (uint8_t)any(r, 3),
                               LMB_TEXELS_RGBA8};
        for (int i = 0; i < 4 * TEXELS; ++i) {
            l->texels[k][i] = (uint8_t)any(r, 256);
        }
        l->texture[k] = t;
        l->state.stage[k].mode = (uint8_t)any(r, 5);
        for (int c = 0; c < 3; ++c) {
            l->state.stage[k].colour[c] = (uint8_t)any(r, 256);
        }
        l->state.stage[k].texture = any(r, 3) == 0 ? &l->texture[k] : NULL;
    }
}

static void make_blending(lmb_draw_state *s, test_rng *r)
{
    static const uint8_t usual[2] = {LMB_DRAW_INVERSE_SOURCE_ALPHA, LMB_DRAW_ONE};
    s->flags |= any(r, 2) ? LMB_DRAW_BLEND : 0;
    s->flags |= any(r, 12) == 0 ? LMB_DRAW_LOGIC : 0;
    s->logic_op = (uint8_t)any(r, 16);
    s->colour_mask = (uint8_t)(any(r, 6) == 0 ? any(r, 16) : 15);
    for (int i = 0; i < 2; ++i) {
        s->blend_source[i] = (uint8_t)any(r, 15);
        s->blend_target[i] = (uint8_t)any(r, 10);
        s->blend_equation[i] = (uint8_t)any(r, 5);
    }
    for (int i = 0; i < 4; ++i) {
        s->blend_colour[i] = (uint8_t)any(r, 256);
    }
    if (any(r, 2)) {
        s->blend_source[0] = s->blend_source[1] = LMB_DRAW_SOURCE_ALPHA;
        s->blend_target[0] = s->blend_target[1] = usual[any(r, 2)];
        s->blend_equation[0] = s->blend_equation[1] = LMB_DRAW_ADD;
    }
}

static void make_state(lists *l, test_rng *r)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const lmb_vec3 eye = {0, 0, 1}, target = {0.1f, 0, -3}, up = {0, 1, 0};
    lmb_draw_state *s = &l->state;
    lmb_view view;
    lmb_view_look_at(&view, eye, target, up, 0.9f, WIDE, HIGH);
    view.kind = any(r, 4) == 0 ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE;
    CHECK(lmb_draw_state_init(s, WIDE, HIGH) == LMB_OK && lmb_draw_view(s, &view, &unit) == LMB_OK);
    s->flags = any(r, 4) ? LMB_DRAW_DEPTH_TEST | (any(r, 4) ? LMB_DRAW_DEPTH_WRITE : 0u) : 0u;
    s->depth_func = (uint8_t)(any(r, 2) ? LMB_DRAW_GREATER : any(r, 8));
    s->flags |= (any(r, 5) ? 0u : LMB_DRAW_FLAT) | (any(r, 5) ? 0u : LMB_DRAW_CULL_BACK) |
                (any(r, 5) ? 0u : LMB_DRAW_CLOCKWISE) | (any(r, 5) ? 0u : LMB_DRAW_SCISSOR) |
                (any(r, 9) ? 0u : LMB_DRAW_ALPHA_TEST) | (any(r, 9) ? 0u : LMB_DRAW_CULL_FRONT);
    s->alpha_func = LMB_DRAW_GREATER, s->alpha_value = 100;
    s->scissor[0] = 5, s->scissor[1] = 3, s->scissor[2] = 40, s->scissor[3] = 33;
    s->fog = (uint8_t)(any(r, 3) == 0 ? any(r, 4) : 0);
    s->fog_start = 1.0f, s->fog_end = any(r, 5) ? 6.0f : 0.5f, s->fog_density = 0.3f;
    s->fog_colour[0] = 190;
    s->offset_slope = any(r, 5) ? 0.0f : 1.5f;
    s->depth_range[0] = any(r, 5) ? 0.0f : 0.2f;
    s->flags |= any(r, 5) ? 0u : LMB_DRAW_STENCIL;
    s->stencil_func = (uint8_t)any(r, 8), s->stencil_value = (uint8_t)any(r, 256);
    s->stencil_mask = (uint8_t)(any(r, 2) ? 255 : any(r, 256));
    s->stencil_write = (uint8_t)(any(r, 2) ? 255 : any(r, 256));
    for (int i = 0; i < 3; ++i) {
        s->stencil_op[i] = (uint8_t)any(r, 8);
    }
    s->line_px = (uint8_t)(1 + any(r, 3)), s->point_px = (uint8_t)(1 + any(r, 9));
    make_blending(s, r);
    make_textures(l, r);
}

/* A 24.8 position; half of them are whole pixels. */
static float any_px(test_rng *r, float low, float high)
{
    const int32_t v = (int32_t)(256.0f * test_uniform(r, low, high));
    return (float)(any(r, 2) ? v : v & ~255) * (1.0f / 256.0f);
}

/* Quads in pixels, most of them upright, of any corner first and any direction, with texture coordinates of a sprite
 * or any others, without tests. */
static void make_sheets(lists *l, test_rng *r)
{
    const int is_one = any(r, 2) == 0, is_sprite = any(r, 2) == 0;
    (void)lmb_draw_pixels(&l->state);
    l->state.flags &= LMB_DRAW_BLEND | LMB_DRAW_FLAT | LMB_DRAW_SCISSOR | LMB_DRAW_LOGIC;
    l->primitive = any(r, 4) ? LMB_DRAW_QUADS : LMB_DRAW_QUAD_STRIP;
    l->vertices.positions = l->positions;
    l->vertices.position_format = LMB_DRAW_F32;
    l->has_indices = 0;
    for (int i = 0; i + 4 <= VERTICES; i += 4) {
        const float x = any_px(r, -20.0f, WIDE), y = any_px(r, -20.0f, HIGH);
        const float wide = any_px(r, 0.0f, 50.0f), high = any_px(r, 0.0f, 40.0f);
        const int turn = (int)any(r, 8), wave = any(r, 8) == 0;
        for (int k = 0; k < 4; ++k) {
            const int corner = (turn & 4) != 0 ? (turn + 4 - k) & 3 : (turn + k) & 3;
            const int right = corner == 1 || corner == 2, down = corner >= 2;
            const int to = l->primitive == LMB_DRAW_QUAD_STRIP && k >= 2 ? i + 5 - k : i + k;
            l->positions[to][0] = x + (float)right * wide + (wave && k == 1 ? 2.0f : 0.0f);
            l->positions[to][1] = y + (float)down * high;
            l->positions[to][2] = 0.5f;
            l->uvs[to][0] = is_sprite ? (float)right : test_uniform(r, -1.5f, 2.5f);
            l->uvs[to][1] = is_sprite ? (float)down : test_uniform(r, -1.5f, 2.5f);
            memcpy(l->colours[to], l->colours[is_one ? i : to], 4);
        }
    }
}

/* Triangles of one to some hundred pixels without indices, in the states that kernels draw in batches or whole, some
 * with a texture or fog, in any window. */
static void make_streams(lists *l, test_rng *r)
{
    static const float sizes[4] = {0.05f, 0.15f, 0.4f, 2.0f};
    lmb_draw_state *s = &l->state;
    s->flags &= ~(uint32_t)(LMB_DRAW_LOGIC | LMB_DRAW_ALPHA_TEST | LMB_DRAW_STENCIL);
    s->flags |= LMB_DRAW_SCISSOR;
    s->fog = (uint8_t)(any(r, 2) ? any(r, 4) : LMB_DRAW_FOG_NONE);
    s->colour_mask = 15;
    s->offset_slope = any(r, 4) ? 0.0f : 1.5f;
    s->stage[0].texture = any(r, 2) ? &l->texture[0] : NULL;
    s->stage[0].mode = (uint8_t)any(r, 2);
    l->texture[0].filter = (uint8_t)any(r, 2);
    s->stage[1].texture = NULL;
    s->blend_source[0] = s->blend_source[1] = LMB_DRAW_SOURCE_ALPHA;
    s->blend_target[0] = s->blend_target[1] = any(r, 2) ? LMB_DRAW_ONE : LMB_DRAW_INVERSE_SOURCE_ALPHA;
    s->blend_equation[0] = s->blend_equation[1] = LMB_DRAW_ADD;
    for (int k = 0; k < 2; ++k) {
        const int32_t side = k == 0 ? WIDE : HIGH, first = any(r, 3) ? 0 : (int32_t)any(r, (uint32_t)side);
        s->scissor[k] = first;
        s->scissor[2 + k] = any(r, 3) ? side : 1 + (int32_t)any(r, (uint32_t)(side - first));
    }
    l->primitive = LMB_DRAW_TRIANGLES;
    l->format = any(r, 2) ? LMB_RGBA8 : LMB_BGRA8;
    l->depth_layout = LMB_LINEAR;
    l->has_indices = 0;
    for (int i = 0; i < VERTICES; i += 3) {
        const float size = sizes[any(r, 4)], x = test_uniform(r, -1.5f, 1.5f), y = test_uniform(r, -1.2f, 1.2f),
                    z = test_uniform(r, -4.0f, -2.0f);
        for (int k = i; k < i + 3; ++k) {
            l->positions[k][0] = x + test_uniform(r, -size, size);
            l->positions[k][1] = y + test_uniform(r, -size, size);
            l->positions[k][2] = z + (any(r, 3) ? test_uniform(r, -size, size) : 0.0f);
            memcpy(l->colours[k], l->colours[any(r, 2) ? i : k], 4);
        }
    }
    make_homogeneous(l, r);
}

/* Lines of one pixel in the states of draw_line.c: in perspective, or on a grid of quarters of pixels, so that they also
 * end on the edges of diamonds, and pass through corners of pixels. */
static void make_lines(lists *l, test_rng *r)
{
    lmb_draw_state *s = &l->state;
    s->flags &= LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE | LMB_DRAW_BLEND | LMB_DRAW_FLAT | LMB_DRAW_SCISSOR;
    s->fog = LMB_DRAW_FOG_NONE;
    s->colour_mask = 15;
    s->stage[0].texture = s->stage[1].texture = NULL;
    s->line_px = 1;
    l->primitive = LMB_DRAW_LINES + (int32_t)any(r, 3);
    l->format = any(r, 2) ? LMB_RGBA8 : LMB_BGRA8;
    l->depth_layout = any(r, 4) ? LMB_LINEAR : LMB_TILED;
    if (any(r, 4) == 0) {
        return;
    }
    (void)lmb_draw_pixels(s);
    l->vertices.positions = l->positions;
    l->vertices.position_format = LMB_DRAW_F32;
    for (int i = 0; i < VERTICES; ++i) {
        const int is_near = (i & 1) != 0 && any(r, 4) != 0;
        for (int k = 0; k < 2; ++k) {
            const uint32_t side = k == 0 ? WIDE : HIGH;
            l->positions[i][k] = is_near ? l->positions[i - 1][k] + 0.25f * (float)any(r, 80) - 10.0f
                                         : 0.25f * (float)any(r, 4 * side + 40) - 5.0f;
        }
        l->positions[i][2] = any(r, 3) ? test_uniform(r, 0.0f, 1.0f) : 0.5f;
    }
}

static void make_lists(lists *l, test_rng *r)
{
    memset(l, 0, sizeof *l);
    make_state(l, r);
    make_vertices(l, r);
    l->vertices.positions = l->positions;
    make_homogeneous(l, r);
    l->has_indices = any(r, 3) != 0;
    l->vertices.uvs[0] = l->vertices.uvs[1] = any(r, 5) ? l->uvs : NULL;
    l->vertices.colours = any(r, 5) ? &l->colours[0][0] : NULL;
    l->vertices.count = VERTICES;
    l->primitive = any(r, 3) ? LMB_DRAW_TRIANGLES : (int32_t)any(r, 9);
    l->format = any(r, 6) == 0 ? LMB_RGB565 : any(r, 2) ? LMB_RGBA8 : LMB_BGRA8;
    l->depth_layout = any(r, 2) ? LMB_TILED : LMB_LINEAR;
    l->is_upside_down = any(r, 4) == 0;
    l->colour_before = test_random(r);
    if (any(r, 3) == 0) {
        make_sheets(l, r);
    } else if (any(r, 2) == 0) {
        make_streams(l, r);
    } else if (any(r, 3) == 0) {
        make_lines(l, r);
    }
}

/* plainly: forces the generic code by a stencil that changes nothing, and without second colour. */
static void draw_lists(canvas *out, const lists *l, const lmb_kernels *kernels, int plainly)
{
    static const uint8_t none[VERTICES][4];
    const lmb_draw_indices indices = {l->indices, CORNERS, LMB_INDEX_U32};
    lmb_draw_vertices v = l->vertices;
    lmb_draw_state s = l->state;
    lmb_draw_target t;
    memset(out, 0, sizeof *out);
    memset(&t, 0, sizeof t);
    for (int i = 0; i < WIDE * HIGH; ++i) {
        out->colour[i] = l->colour_before * (uint32_t)(i + 1);
        out->stencil[i] = (uint8_t)(out->colour[i] >> 24);
    }
    CHECK(lmb_surface_init(&t.colour, l->format, WIDE, HIGH, out->colour, sizeof out->colour) == LMB_OK);
    CHECK(lmb_surface_init(&t.depth, LMB_DEPTH32F, WIDE, HIGH, out->depth, sizeof out->depth) == LMB_OK);
    if (l->depth_layout == LMB_LINEAR) {
        t.depth.layout = LMB_LINEAR;
        t.depth.stride_bytes = 64 * 4;
    }
    if (l->is_upside_down) {
        t.colour.data = (uint8_t *)t.colour.data + (HIGH - 1) * t.colour.stride_bytes;
        t.colour.stride_bytes = -t.colour.stride_bytes;
    }
    t.stencil = out->stencil;
    t.stencil_stride = WIDE;
    s.kernels = kernels;
    if (plainly) {
        v.seconds = &none[0][0];
    }
    if (plainly && (s.flags & LMB_DRAW_STENCIL) == 0) {
        s.flags |= LMB_DRAW_STENCIL;
        s.stencil_func = LMB_DRAW_ALWAYS;
        s.stencil_op[0] = s.stencil_op[1] = s.stencil_op[2] = LMB_DRAW_KEEP;
    }
    CHECK(lmb_draw_list(&t, &s, &v, l->primitive, l->has_indices ? &indices : NULL, &out->stats) == LMB_OK);
}

static int same_canvas(const canvas *a, const canvas *b)
{
    return memcmp(a->colour, b->colour, sizeof a->colour) == 0 && memcmp(a->depth, b->depth, sizeof a->depth) == 0 &&
           memcmp(a->stencil, b->stencil, sizeof a->stencil) == 0 &&
           a->stats.triangles == b->stats.triangles && a->stats.triangles_drawn == b->stats.triangles_drawn &&
           a->stats.triangles_dropped == b->stats.triangles_dropped;
}

#if LMB_DRAW_LANES
/* --- whole triangles by one call ---------------------------------------------------------------------------------- */

enum { AREA_WIDE = 128, AREA_HIGH = 32, AREAS = 300 };

static lmb_kernels counting;
static void (*area_of)(lmb_draw_area *area);
static int areas, painted; /* painted: with a texture or fog */

static void count_area(lmb_draw_area *area)
{
    ++areas;
    painted += area->pixels.state->stage[0].texture != NULL || area->pixels.state->fog != LMB_DRAW_FOG_NONE;
    area_of(area);
}

typedef struct area_canvas {
    uint32_t colour[AREA_WIDE * AREA_HIGH];
    float depth[AREA_WIDE * AREA_HIGH];
} area_canvas;

/* Draws over `out`. tests: 1: where the depth is less than the stored one. look: 0: one colour; other bits: 1 smooth
 * colours, 2 and 4 a texture, nearest or bilinear; 8, 16, 24 fog. */
static void draw_area_case(area_canvas *out, float corners[3][3], int tests, int look, const lmb_kernels *kernels)
{
    static const uint8_t colours[3][4] = {{255, 0, 90, 200}, {0, 255, 30, 90}, {70, 20, 255, 255}};
    static const float uvs[3][2] = {{-0.3f, 0.1f}, {2.7f, 0.4f}, {0.2f, 1.9f}};
    static uint8_t texels[4 * TEXELS];
    const lmb_texture texture = {texels, 16, 8, 1, LMB_WRAP_REPEAT, LMB_WRAP_MIRROR,
                                 (uint8_t)((look & 4) != 0 ? LMB_BILINEAR : LMB_NEAREST), LMB_TEXELS_RGBA8};
    lmb_draw_target t;
    lmb_draw_state s;
    lmb_draw_vertices v;
    memset(&t, 0, sizeof t);
    memset(&v, 0, sizeof v);
    for (int i = 0; i < 4 * TEXELS; ++i) {
        texels[i] = (uint8_t)(i * 37);
    }
    CHECK(lmb_surface_init(&t.colour, LMB_RGBA8, AREA_WIDE, AREA_HIGH, out->colour, sizeof out->colour) == LMB_OK);
    CHECK(lmb_draw_state_init(&s, AREA_WIDE, AREA_HIGH) == LMB_OK && lmb_draw_pixels(&s) == LMB_OK);
    s.kernels = kernels;
    if (tests) {
        t.depth = surface_of(LMB_DEPTH32F, LMB_LINEAR, AREA_WIDE, AREA_HIGH, out->depth);
        s.flags |= LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
        s.depth_func = LMB_DRAW_LESS;
    }
    if ((look & 6) != 0) {
        s.stage[0].texture = &texture;
        v.uvs[0] = uvs;
    }
    s.fog = (uint8_t)(look >> 3);
    s.fog_axis[0] = 0.02f;
    s.fog_axis[1] = 0.05f;
    s.fog_end = 3.0f;
    s.fog_density = 0.7f;
    s.fog_colour[1] = 200;
    v.colours = (look & 1) != 0 ? colours[0] : NULL;
    v.positions = corners[0];
    v.count = 3;
    CHECK(lmb_draw_list(&t, &s, &v, LMB_DRAW_TRIANGLES, NULL, NULL) == LMB_OK);
}

/* The kernel skips tiles left of a triangle. Corners are on a grid of half pixels, so that edges also pass through
 * corners of tiles, and through centres of pixels at the tiles' rims. Half of the triangles are of one colour. */
static void check_areas(const lmb_kernels *backend)
{
    static area_canvas want, got;
    test_rng r = seed_rng(11);
    int unlike = 0;
    counting = *backend;
    area_of = counting.draw_area;
    counting.draw_area = area_of != NULL ? count_area : NULL;
    areas = painted = 0;
    memset(&want, 0, sizeof want);
    memset(&got, 0, sizeof got);
    for (int n = 0; n < AREAS; ++n) {
        float corners[3][3] = {{0}};
        const int tests = n % 2, look = n % 4 < 2 ? 0 : n / 4 % 32;
        for (int i = 0; i < 3; ++i) {
            corners[i][0] = 0.5f * (float)any(&r, 2 * AREA_WIDE + 1);
            corners[i][1] = 0.5f * (float)any(&r, 2 * AREA_HIGH + 1);
            corners[i][2] = tests ? 0.125f * (float)any(&r, 9) : 0.0f;
        }
        if (tests && n % 20 == 1) { /* the triangles in between cross each other */
            for (int i = 0; i < AREA_WIDE * AREA_HIGH; ++i) {
                want.depth[i] = got.depth[i] = 1.0f;
            }
        }
        if (!tests) {
            memset(want.colour, 0, sizeof want.colour);
            memset(got.colour, 0, sizeof got.colour);
        }
        draw_area_case(&want, corners, tests, look, NULL);
        draw_area_case(&got, corners, tests, look, &counting);
        unlike += memcmp(&want, &got, sizeof want) != 0;
    }
    CHECK_MSG(unlike == 0, "%s: %d of %d triangles differ from plain C", lmb_kernels_name(backend), unlike, AREAS);
    CHECK_MSG(area_of == NULL || (areas > AREAS / 2 && painted > AREAS / 4), "%s: %d areas, %d painted",
              lmb_kernels_name(backend), areas, painted);
}
#else
static void check_areas(const lmb_kernels *backend) { (void)backend; }
#endif

void test_draw_lists(void)
{
    static canvas want, got;
    const seed_range range = seeds(ROUNDS);
    const lmb_kernels *backend;
    for (int32_t i = 0; (backend = lmb_kernels_at(i)) != NULL; ++i) {
        check_areas(backend);
    }
    for (uint32_t k = 0; k < range.count; ++k) {
        test_rng r = seed_rng(range.first + k);
        lists l;
        make_lists(&l, &r);
        draw_lists(&want, &l, NULL, 1);
        draw_lists(&got, &l, NULL, 0);
        CHECK_MSG(same_canvas(&want, &got), "a list by plain C; repeat: LANES_SEED=%u tests lanes",
                  (unsigned)(range.first + k));
        for (int32_t i = 0; (backend = lmb_kernels_at(i)) != NULL; ++i) {
            draw_lists(&got, &l, backend, 0);
            CHECK_MSG(same_canvas(&want, &got), "a list by %s; repeat: LANES_SEED=%u tests lanes",
                      lmb_kernels_name(backend), (unsigned)(range.first + k));
        }
    }
}
#else
void test_draw_lists(void) {}
#endif
