/* test_frames.c: layers 4 and 8: a frame has the same bytes however its work and memory are divided. */
#include <math.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../tools/demo/demo_scene.h"
#include "../../src/base/vec.h"
#include "../test.h"

void test_frames(void);

/* Sanitizers make frames about 20 times slower. */
#if defined(__SANITIZE_ADDRESS__)
#define SLOW 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SLOW 1
#endif
#endif
#ifdef SLOW
enum { WIDTH = 32, HEIGHT = 24 };
#else
enum { WIDTH = 64, HEIGHT = 48 };
#endif
enum { MAP = 32, BLOCK = 4, GROUPS = 60, POINTS = 8192, CANARY = 64 };
enum { FLOATS = WIDTH * HEIGHT * 3, TARGET = WIDTH * HEIGHT, MAP_WORDS = 8 * MAP * MAP * 2 };
#define PATTERN 0xa5a5a5a5u

/* Of the room's three lights, the small configuration uses the first, whose map has one face. */
enum { ALL_LIGHTS = 3, LIGHTS = LMB_MAX_LIGHTS < ALL_LIGHTS ? 1 : ALL_LIGHTS, FACES = LIGHTS == 1 ? 1 : 8 };

/* All memory of a frame, with canaries where a size could be wrong. */
static struct memory {
    uint32_t depth[TARGET + 2 * CANARY], id[TARGET + 2 * CANARY], whole_depth[TARGET];
    uint32_t map[MAP_WORDS + 2 * CANARY];
    lmb_point points[POINTS + 1];
    uint32_t cells[(MAP / BLOCK) * (MAP / BLOCK) + 1];
    lmb_groups groups;
    lmb_band_scratch scratch, other_scratch;
    lmb_render render, copy;
    lmb_stats stats;
    uint32_t band_rows[WIDTH * 8 * 3];
} m;

/* Pictures, followed by canaries. */
typedef struct picture {
    uint32_t data[FLOATS + CANARY];
    lmb_surface surface;
} picture;

static picture reference, other, third;

/* ---- scenes ---- */

/* A box open to the viewer, with a block and three lights. Each side is a grid, so that a draw takes several units. */
enum { SIDES = 7, GRID = 13, SIDE_VERTICES = (GRID + 1) * (GRID + 1), SIDE_TRIANGLES = 2 * GRID * GRID };
static float room_positions[SIDES][SIDE_VERTICES * 3];
static uint16_t room_indices[SIDES][SIDE_TRIANGLES * 3];
static lmb_mesh room_mesh[SIDES];
static lmb_material room_materials[SIDES];
static lmb_instance room_instances[SIDES];
static lmb_light room_lights[ALL_LIGHTS];
static lmb_scene room;

/* Four corners in order, bilinear in between. */
static void put_grid(int n, const float p[12])
{
    float *at = room_positions[n];
    uint16_t *index = room_indices[n];
    for (int v = 0; v < SIDE_VERTICES; ++v) {
        float s = (float)(v % (GRID + 1)) / GRID, t = (float)(v / (GRID + 1)) / GRID;
        for (int c = 0; c < 3; ++c) {
            *at++ = (p[c] * (1 - s) + p[3 + c] * s) * (1 - t) + (p[9 + c] * (1 - s) + p[6 + c] * s) * t;
        }
    }
    for (int q = 0; q < GRID * GRID; ++q) {
        static const int corner[6] = {0, 1, GRID + 2, 0, GRID + 2, GRID + 1};
        for (int k = 0; k < 6; ++k) {
            *index++ = (uint16_t)(q / GRID * (GRID + 1) + q % GRID + corner[k]);
        }
    }
}

static void put_side(int n, const float p[12], const float colour[3])
{
    static const lmb_instance plain = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 0, 0, 1, 0};
    put_grid(n, p);
    memset(&room_mesh[n], 0, sizeof room_mesh[n]);
    room_mesh[n].positions = room_positions[n];
    room_mesh[n].indices = room_indices[n];
    room_mesh[n].index_format = LMB_INDEX_U16;
    room_mesh[n].vertex_count = SIDE_VERTICES;
    room_mesh[n].triangle_count = SIDE_TRIANGLES;
    memset(&room_materials[n], 0, sizeof room_materials[n]);
    memcpy(room_materials[n].albedo, colour, sizeof room_materials[n].albedo);
    room_materials[n].alpha = 1.0f;
    room_materials[n].texture = -1;
    room_materials[n].flags = LMB_DOUBLE_SIDED;
    room_instances[n] = plain;
    room_instances[n].mesh = room_instances[n].material = (uint32_t)n;
    room_instances[n].first_id = 1u + SIDE_TRIANGLES * (uint32_t)n;
}

static void set_lights(uint32_t count)
{
    static const lmb_light lights[ALL_LIGHTS] = {
        {{0.2f, 1.8f, 0.5f}, {-0.2f, -0.96f, -0.196f}, {9, 8, 7}, 0.95f, 0.8f, LMB_LIGHT_SPOT, 0, 0},
        {{-0.5f, 1.2f, 0.9f}, {0, -1, 0}, {1, 2, 3}, 0, 0, LMB_LIGHT_POINT, 0, 0},
        {{0, 0, 0}, {0.6f, 0, -0.8f}, {2, 1, 0.5f}, 0, 0, LMB_LIGHT_DIRECTIONAL, 0, 0},
    };
    memcpy(room_lights, lights, sizeof lights);
    room.light_count = count;
}

static void set_room(void)
{
    static const float quads[SIDES][12] = {
        {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1},                       /* floor */
        {-1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1},                       /* ceiling */
        {-1, 0, -1, 1, 0, -1, 1, 2, -1, -1, 2, -1},                     /* back */
        {-1, 0, 1, -1, 0, -1, -1, 2, -1, -1, 2, 1},                     /* left */
        {1, 0, -1, 1, 0, 1, 1, 2, 1, 1, 2, -1},                         /* right */
        {-0.4f, 0, 0.3f, 0.3f, 0, 0.5f, 0.3f, 0.7f, 0.5f, -0.4f, 0.7f, 0.3f}, /* block, front */
        {-0.4f, 0.7f, 0.3f, 0.3f, 0.7f, 0.5f, 0.2f, 0.7f, -0.3f, -0.4f, 0.7f, -0.3f}, /* block, top */
    };
    static const float colour[SIDES][3] = {{0.7f, 0.7f, 0.7f}, {0.7f, 0.7f, 0.7f}, {0.7f, 0.6f, 0.5f},
                                           {0.8f, 0.1f, 0.1f}, {0.1f, 0.7f, 0.2f}, {0.5f, 0.5f, 0.9f},
                                           {0.9f, 0.9f, 0.3f}};
    for (int n = 0; n < SIDES; ++n) {
        put_side(n, quads[n], colour[n]);
    }
    memset(&room, 0, sizeof room);
    room.meshes = room_mesh;
    room.materials = room_materials;
    room.instances = room_instances;
    room.lights = room_lights;
    room.mesh_count = room.material_count = room.instance_count = SIDES;
    set_lights(LIGHTS);
    lmb_scene_bounds(&room.bounds_min, &room.bounds_max, &room);
}

/* ---- frames ---- */

static void set_picture(picture *p, int32_t format, int32_t width, int32_t height)
{
    for (int i = 0; i < FLOATS + CANARY; ++i) {
        p->data[i] = PATTERN;
    }
    lmb_surface_init(&p->surface, format, width, height, p->data, FLOATS * sizeof(uint32_t));
}

static size_t picture_bytes(const picture *p)
{
    return lmb_surface_bytes(p->surface.format, p->surface.width, p->surface.height);
}

/* Compares all memory: pixels and the untouched rest. */
static int same_picture(const picture *a, const picture *b) { return memcmp(a->data, b->data, sizeof a->data) == 0; }

static int picture_keeps_rest(const picture *p)
{
    const uint8_t *byte = (const uint8_t *)p->data;
    int good = 1;
    for (size_t i = picture_bytes(p); i < sizeof p->data; ++i) {
        good &= byte[i] == 0xa5;
    }
    return good;
}

static lmb_surface target_surface(int32_t format, int32_t layout, int32_t width, int32_t height, uint32_t *data)
{
    lmb_surface s;
    lmb_surface_init(&s, format, width, height, data, TARGET * sizeof(uint32_t));
    if (layout == LMB_LINEAR) {
        s.layout = LMB_LINEAR;
        s.stride_bytes /= LMB_TILE;
    }
    return s;
}

static void set_eye(lmb_frame *f, int32_t height, int32_t layout, int32_t depth_format, int32_t id_format)
{
    memset(&f->eye, 0, sizeof f->eye);
    f->eye.depth = target_surface(depth_format, layout, f->view.frame_width, height, m.depth + CANARY);
    f->eye.id = target_surface(id_format, layout, f->view.frame_width, height, m.id + CANARY);
}

static lmb_frame plain_frame(const lmb_scene *scene, lmb_view view, picture *out)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = picked_kernels();
    f.scene = scene;
    f.view = view;
    f.shadow_map = MAP;
    f.grouping.block = BLOCK;
    f.grouping.groups = GROUPS;
    f.occlusion = LMB_OCCLUSION_VIEW;
    f.steps = 4;
    f.map_memory = m.map + CANARY;
    f.map_bytes = MAP_WORDS * sizeof(uint32_t);
    f.points.data = m.points;
    f.points.cap = POINTS;
    f.points.cells = m.cells;
    f.points.cell_cap = sizeof m.cells / sizeof *m.cells;
    f.groups = &m.groups;
    f.scratch = &m.scratch;
    f.stats = &m.stats;
    set_picture(out, LMB_RGB32F, view.frame_width, view.frame_height);
    f.out = out->surface;
    set_eye(&f, view.frame_height, LMB_TILED, LMB_DEPTH32F, LMB_ID32);
    /* Leftovers of an earlier frame must not matter. */
    memset(&m.scratch, 0x3c, sizeof m.scratch);
    memset(&m.groups, 0x3c, sizeof m.groups);
    memset(m.points, 0x3c, sizeof m.points);
    memset(m.cells, 0x3c, sizeof m.cells);
    memset(m.map, 0x3c, sizeof m.map);
    memset(m.depth, 0x3c, sizeof m.depth);
    memset(m.id, 0x3c, sizeof m.id);
    memset(m.whole_depth, 0x3c, sizeof m.whole_depth);
    return f;
}

static lmb_status run_steps(const lmb_frame *f, int32_t units)
{
    lmb_status status = lmb_render_begin(&m.render, f);
    while (status == LMB_OK || status == LMB_MORE) {
        status = lmb_render_step(&m.render, units);
        if (status != LMB_MORE) {
            return status;
        }
    }
    return status;
}

static lmb_view room_view(int32_t width, int32_t height)
{
    static const lmb_vec3 eye = {0.1f, 1.1f, 3.2f}, target = {0, 0.9f, 0}, up = {0, 1, 0};
    lmb_view v = {.sample_x = 0};
    lmb_view_look_at(&v, eye, target, up, 0.75f, width, height);
    v.near_m = 0.1f;
    v.far_m = 20.0f;
    return v;
}

static int lit_pixels(const picture *p)
{
    int lit = 0;
    for (int32_t i = 0; i < p->surface.width * p->surface.height * 3; ++i) {
        float v;
        memcpy(&v, &p->data[i], sizeof v);
        lit += v > 0.0f;
    }
    return lit;
}

/* ---- slicing ---- */

/* Every `stride`th step size from `first` on. */
static void check_steps(const lmb_scene *scene, lmb_view view, const lmb_frame *how, size_t first, size_t stride)
{
    static const int32_t units[] = {1, 3, 8, 17, 1000, 1 << 30};
    for (size_t i = first; i < sizeof units / sizeof *units; i += stride) {
        lmb_frame f = plain_frame(scene, view, &other);
        f.occlusion = how->occlusion;
        f.grouping.method = how->grouping.method;
        CHECK(run_steps(&f, units[i]) == LMB_OK);
        CHECK_MSG(same_picture(&reference, &other), "units %d", (int)units[i]);
    }
}

/* The state may be copied between any two steps. */
static void check_copies(const lmb_scene *scene, lmb_view view)
{
    lmb_frame f = plain_frame(scene, view, &other);
    lmb_render *now = &m.render, *next = &m.copy;
    lmb_status status = lmb_render_begin(now, &f);
    CHECK(status == LMB_OK);
    do {
        lmb_render *t = now;
        memcpy(next, now, sizeof *next);
        memset(now, 0x3c, sizeof *now);
        memset(&m.scratch, 0x3c, sizeof m.scratch);
        now = next;
        next = t;
        status = lmb_render_step(now, 5);
    } while (status == LMB_MORE);
    CHECK(status == LMB_OK);
    CHECK(same_picture(&reference, &other));
}

static void shuffle(int32_t *order, int32_t count, test_rng *r)
{
    for (int32_t i = 0; i < count; ++i) {
        order[i] = i;
    }
    for (int32_t i = count - 1; i > 0; --i) {
        int32_t j = (int32_t)(test_random(r) % (uint32_t)(i + 1)), t = order[i];
        order[i] = order[j];
        order[j] = t;
    }
}

static lmb_status run_to_bands(const lmb_frame *f)
{
    lmb_status status = lmb_render_begin(&m.render, f);
    while (status >= 0 && m.render.stage < LMB_STAGE_BANDS) {
        status = lmb_render_step(&m.render, 64);
    }
    return status;
}

/* Bands in random order with two scratches in turn, whole eye buffers or ones of 8 or 16 rows, into the frame or 8
 * separate rows. */
static void check_bands(const lmb_scene *scene, lmb_view view, int small_eye, int small_out)
{
    test_rng r = {31u + (uint64_t)small_eye + 2u * (uint64_t)small_out};
    int32_t bands = (view.frame_height + 7) / 8, order[HEIGHT / 8 + 1], failed = 0;
    lmb_frame f = plain_frame(scene, view, &other);
    lmb_target eye;
    if (small_eye) {
        set_eye(&f, (small_out ? 2 : 1) * LMB_TILE, LMB_TILED, LMB_DEPTH32F, LMB_ID32);
        f.eye_depth = target_surface(LMB_DEPTH32F, LMB_TILED, view.frame_width, view.frame_height, m.whole_depth);
    }
    eye = f.eye;
    CHECK(run_to_bands(&f) == LMB_MORE);
    shuffle(order, bands, &r);
    for (int32_t i = 0; i < bands; ++i) {
        lmb_band_scratch *scratch = i & 1 ? &m.scratch : &m.other_scratch;
        lmb_surface rows = f.out;
        int32_t y = order[i] * 8, left = view.frame_height - y;
        if (small_out) {
            lmb_surface_init(&rows, LMB_RGB32F, view.frame_width, LMB_TILE, m.band_rows, sizeof m.band_rows);
        }
        failed += lmb_render_band(&m.render, scratch, &eye, &rows, order[i]) != LMB_OK;
        if (small_out) {
            memcpy(other.data + y * view.frame_width * 3, m.band_rows,
                   sizeof(uint32_t) * 3u * (size_t)view.frame_width * (size_t)(left < 8 ? left : 8));
        }
    }
    CHECK(failed == 0);
    CHECK_MSG(same_picture(&reference, &other), "small eye %d, small out %d", small_eye, small_out);
}

/* Other memory layouts: eye buffers of one or two bands, rows instead of tiles, 16-bit ids. */
static void check_memory(const lmb_scene *scene, lmb_view view, const lmb_frame *how, int first, int stride)
{
    for (int i = first; i < 16; i += stride) {
        lmb_frame f = plain_frame(scene, view, &other);
        int layout = i & 1 ? LMB_LINEAR : LMB_TILED, id = i & 2 ? LMB_ID16 : LMB_ID32;
        f.occlusion = how->occlusion;
        f.grouping.method = how->grouping.method;
        f.id_format = i & 4 ? LMB_ID16 : 0;
        set_eye(&f, i & 8 ? (i & 4 ? 2 : 1) * LMB_TILE : view.frame_height, layout, LMB_DEPTH32F, id);
        if (i & 8) {
            f.eye_depth = target_surface(LMB_DEPTH32F, layout, view.frame_width, view.frame_height, m.whole_depth);
        }
        CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
        CHECK_MSG(same_picture(&reference, &other), "memory variant %d", i);
    }
}

/* ---- callbacks ---- */

typedef struct handed {
    picture *to;
    int32_t calls, wrong, stop_at;
} handed;

static int take_rows(void *user, const lmb_surface *rows, int32_t y)
{
    handed *h = (handed *)user;
    const lmb_surface *whole = &h->to->surface;
    int32_t expected = whole->height - y < 8 ? whole->height - y : 8;
    h->wrong += y != 8 * h->calls || rows->height != expected || rows->width != whole->width;
    ++h->calls;
    for (int32_t i = 0; i < rows->height; ++i) {
        const uint8_t *row = (const uint8_t *)rows->data + i * rows->stride_bytes;
        memcpy((uint8_t *)whole->data + (y + i) * whole->stride_bytes, row,
               (size_t)(whole->width * lmb_pixel_bytes(whole->format)));
    }
    return h->calls == h->stop_at;
}

/* 8 rows per callback; dither and exposure follow the frame, not the rows. */
static void check_callback(const lmb_scene *scene, lmb_view view, int32_t format)
{
    static const lmb_surface none;
    handed h = {&third, 0, 0, 0};
    lmb_frame f = plain_frame(scene, view, &other);
    set_picture(&reference, format, view.frame_width, view.frame_height);
    f.out = reference.surface;
    f.exposure_ev = 1.5f;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    set_picture(&third, format, view.frame_width, view.frame_height);
    f.out = none;
    lmb_surface_init(&f.out, format, view.frame_width, LMB_TILE, m.band_rows, sizeof m.band_rows);
    f.callback = take_rows;
    f.user = &h;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    CHECK(h.calls == (view.frame_height + 7) / 8 && h.wrong == 0);
    CHECK_MSG(same_picture(&reference, &third), "format %d", (int)format);
    CHECK(picture_keeps_rest(&reference));
}

static void test_callback_stops(void)
{
    handed h = {&third, 0, 0, 3};
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    set_picture(&third, LMB_RGB32F, WIDTH, HEIGHT);
    f.callback = take_rows;
    f.user = &h;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK && h.calls == 3);
    CHECK(memcmp(third.data, other.data, 24 * WIDTH * 12) == 0);
    CHECK(other.data[24 * WIDTH * 3] == PATTERN); /* the whole frame, up to the refused band */
}

/* stride 1: every step size and every third memory layout, for each kind of occlusion and grouping. */
static void check_scene(const lmb_scene *scene, lmb_view view, size_t stride)
{
    static const int32_t formats[] = {LMB_RGB32F, LMB_RGBA8, LMB_BGRA8, LMB_RGB565, LMB_RGB555, LMB_RGB565_BE};
    for (int i = 0; i < 4; ++i) {
        lmb_frame f = plain_frame(scene, view, &reference);
        f.occlusion = i % 3;
        f.grouping.method = i & 1 ? LMB_GROUP_GREEDY : LMB_GROUP_ZONES;
        CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
        CHECK(lit_pixels(&reference) > view.frame_width * view.frame_height && picture_keeps_rest(&reference));
        check_steps(scene, view, &f, (size_t)i % stride, stride);
        check_memory(scene, view, &f, i % (int)stride, (int)stride + 2);
    }
    lmb_frame f = plain_frame(scene, view, &reference);
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    check_copies(scene, view);
    for (int i = 0; i < 4; ++i) {
        check_bands(scene, view, i & 1, i >> 1);
    }
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        check_callback(scene, view, formats[i]);
    }
}

static void test_slicing(void)
{
    check_scene(&room, room_view(WIDTH, HEIGHT), 1);
    check_scene(&room, room_view(WIDTH - 11, HEIGHT - 11), 3);
    check_scene(demo_scene(), demo_view(WIDTH, HEIGHT), 3);
}

/* ---- light is linear ---- */

/* gcc 12.2 for AArch64 fails with an internal error on fmax. */
static double larger(double worst, double v) { return v <= worst ? worst : v; }

static void render_show(picture *out, int show, int occlusion, int method)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), out);
    f.show = show;
    f.occlusion = occlusion;
    f.grouping.method = method;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
}

static void scale_lights(float s)
{
    for (int i = 0; i < ALL_LIGHTS; ++i) {
        for (int c = 0; c < 3; ++c) {
            room_lights[i].intensity[c] *= s;
        }
    }
}

static float value_at(const picture *p, int i)
{
    float v;
    memcpy(&v, &p->data[i], sizeof v);
    return v;
}

static void test_doubling(void)
{
    static const int shows[] = {LMB_SHOW_INDIRECT, LMB_SHOW_IRRADIANCE, LMB_SHOW_DIRECT, LMB_SHOW_FULL};
    for (int n = 0; n < 12; ++n) {
        int wrong = 0, lit = 0;
        set_lights(LIGHTS);
        render_show(&reference, shows[n % 4], n / 4, n / 2 % 2);
        scale_lights(n & 1 ? 2.0f : 0.5f);
        render_show(&other, shows[n % 4], n / 4, n / 2 % 2);
        for (int i = 0; i < FLOATS; ++i) {
            float v = value_at(&reference, i) * (n & 1 ? 2.0f : 0.5f);
            wrong += memcmp(&v, &other.data[i], sizeof v) != 0;
            lit += v > 0.0f;
        }
        CHECK_MSG(wrong == 0 && lit > FLOATS / 8, "variant %d: %d of %d lit", n, wrong, lit);
    }
    set_lights(LIGHTS);
}

static void test_darkness(void)
{
    for (int n = 0; n < 16; ++n) {
        int wrong = 0;
        set_lights(n & 8 ? 0 : LIGHTS);
        scale_lights(0.0f);
        render_show(&other, n & 3, LMB_OCCLUSION_VIEW, n / 4 % 2);
        for (int i = 0; i < FLOATS; ++i) {
            wrong += other.data[i] != 0;
        }
        CHECK_MSG(wrong == 0, "variant %d: %d values are not zero", n, wrong);
    }
    set_lights(LIGHTS);
}

/* Each light's shadow map drawn by hand, all triangles at once. */
static void draw_maps(lmb_shadow_map maps[ALL_LIGHTS])
{
    static uint32_t memory[ALL_LIGHTS][6 * MAP * MAP * 2];
    for (int i = 0; i < LIGHTS; ++i) {
        lmb_shadow_map_init(&maps[i], &room_lights[i], &room, MAP, LMB_ID32, memory[i], sizeof memory[i]);
        lmb_shadow_map_clear(&maps[i]);
        lmb_shadow_map_draw(&maps[i], picked_kernels(), &room, 1, UINT32_MAX, NULL);
    }
}

/* V3, V29: a frame's direct light is the sum of each light's irradiance, in the order of the lights. */
static void test_sum_of_lights(void)
{
    static lmb_irradiance sum, one;
    static lmb_radiance radiance;
    const lmb_kernels *k = picked_kernels();
    picture *built = &third;
    render_show(&reference, LMB_SHOW_DIRECT, LMB_OCCLUSION_NONE, 0);
    lmb_render *r = &m.render; /* the eye buffer is still valid */
    lmb_shadow_map maps[ALL_LIGHTS];
    draw_maps(maps);
    for (int i = 0; i < LIGHTS; ++i) {
        for (int32_t f = 0; f < maps[i].faces; ++f) {
            CHECK(memcmp(maps[i].face[f].depth.data, r->maps[i].face[f].depth.data, MAP * MAP * 4) == 0);
            CHECK(memcmp(maps[i].face[f].id.data, r->maps[i].face[f].id.data, MAP * MAP * 4) == 0);
        }
    }
    set_picture(built, LMB_RGB32F, WIDTH, HEIGHT);
    for (int32_t at = 0; at < WIDTH / 8 * (HEIGHT / 8); ++at) {
        int32_t x = at % (WIDTH / 8) * 8, y = at / (WIDTH / 8) * 8;
        lmb_tile *tile = &m.scratch.tile;
        lmb_resolve_tile(tile, k, &r->frame.view, &room, &r->frame.eye, x, y);
        memset(&sum, 0, sizeof sum);
        for (int i = 0; i < LIGHTS; ++i) {
            memset(&one, 0, sizeof one);
            lmb_direct_tile(&one, k, tile, &r->frame.view, &room, &room_lights[i], &maps[i]);
            for (int p = 0; p < 3 * LMB_TILE_PIXELS; ++p) {
                sum.rgb[p / LMB_TILE_PIXELS][p % LMB_TILE_PIXELS] += one.rgb[p / LMB_TILE_PIXELS][p % LMB_TILE_PIXELS];
            }
        }
        lmb_compose_tile(&radiance, k, tile, &sum, NULL);
        lmb_store_tile(&built->surface, picked_kernels(), 0, 0, &radiance, x, y, 0.0f);
    }
    lmb_radiance none;
    memset(&none, 0, sizeof none);
    CHECK(lmb_store_tile(&built->surface, NULL, 0, 0, &none, 0, 0, 0.0f) == LMB_ERR_ARG);
    CHECK(lmb_store_tile(&built->surface, picked_kernels(), 0, 0, NULL, 0, 0, 0.0f) == LMB_ERR_ARG);
    CHECK(lmb_store_tile(NULL, picked_kernels(), 0, 0, &none, 0, 0, 0.0f) == LMB_ERR_ARG);
    CHECK(same_picture(&reference, built));
}

/* LMB_RGB565_BE: the values and dither of LMB_RGB565, high byte first on every machine. */
static void test_high_byte_first(void)
{
    enum { SIDE = 12, TOP = 3 }; /* some tiles are only partly in the surface */
    static uint32_t values[SIDE * SIDE / 2], sent[SIDE * SIDE / 2];
    lmb_surface native, display;
    lmb_radiance in;
    int32_t wrong = 0, unlike = 0;
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        in.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] = (float)(k * 37 % 192) / 191.0f;
    }
    in.rgb[0][0] = 1.0f, in.rgb[1][0] = in.rgb[2][0] = 0.0f;
    CHECK(lmb_surface_init(&native, LMB_RGB565, SIDE, SIDE, values, sizeof values) == LMB_OK);
    CHECK(lmb_surface_init(&display, LMB_RGB565_BE, SIDE, SIDE, sent, sizeof sent) == LMB_OK);
    for (int32_t at = 0; at < 9; ++at) {
        const int32_t x = at % 3 * LMB_TILE, y = at / 3 * LMB_TILE;
        CHECK(lmb_store_tile(&native, picked_kernels(), TOP, TOP, &in, x, y, 0.5f) == LMB_OK);
        CHECK(lmb_store_tile(&display, picked_kernels(), TOP, TOP, &in, x, y, 0.5f) == LMB_OK);
    }
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const uint32_t v = ((const uint16_t *)values)[k], high = ((const uint8_t *)sent)[2 * k];
        wrong += v != (high << 8 | ((const uint8_t *)sent)[2 * k + 1]);
        unlike += v >> 8 != (v & 255u);
    }
    CHECK(wrong == 0 && unlike > SIDE * SIDE / 2);
    const uint8_t *red = (const uint8_t *)sent + 2 * ((LMB_TILE - TOP) * SIDE + LMB_TILE - TOP);
    CHECK(red[0] == 0xf8 && red[1] == 0x00);
}

static float gbuffer[2][7 * WIDTH * HEIGHT];

static void set_gbuffer(lmb_surface s[3], float *at, const lmb_view *v)
{
    size_t pixels = (size_t)v->frame_width * (size_t)v->frame_height;
    memset(at, 0xa5, 7 * WIDTH * HEIGHT * sizeof(float));
    lmb_surface_init(&s[0], LMB_R32F, v->frame_width, v->frame_height, at, pixels * 4);
    lmb_surface_init(&s[1], LMB_RGB32F, v->frame_width, v->frame_height, at + pixels, pixels * 12);
    lmb_surface_init(&s[2], LMB_RGB32F, v->frame_width, v->frame_height, at + 4 * pixels, pixels * 12);
}

/* V28, V30: the radiance towards the viewer is irradiance x reflectance / pi. */
static void test_reflected(void)
{
    float *albedo = gbuffer[0] + 4 * TARGET;
    lmb_surface s[3];
    double worst = 0.0;
    render_show(&reference, LMB_SHOW_IRRADIANCE, LMB_OCCLUSION_VIEW, LMB_GROUP_ZONES);
    render_show(&other, LMB_SHOW_INDIRECT, LMB_OCCLUSION_VIEW, LMB_GROUP_ZONES);
    set_gbuffer(s, gbuffer[0], &m.render.frame.view);
    for (int32_t b = 0; b < HEIGHT / 8; ++b) {
        CHECK(lmb_gbuffer_band(NULL, NULL, &s[2], picked_kernels(), &m.scratch.tile, &m.render.frame.view, &room,
                               &m.render.frame.eye, b) == LMB_OK);
    }
    for (int i = 0; i < FLOATS; ++i) {
        const double want = (double)value_at(&reference, i) * (double)albedo[i] / 3.14159265358979;
        worst = larger(worst, fabs((double)value_at(&other, i) - want) / (want + 1e-9));
    }
    CHECK_MSG(worst < 1e-6 && lit_pixels(&other) > FLOATS / 2, "%g", worst);
}

/* V29: direct light needs no points and no groups; full is direct plus indirect. */
static void test_shows(void)
{
    double worst = 0;
    render_show(&reference, LMB_SHOW_DIRECT, LMB_OCCLUSION_VIEW, 0);
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    f.show = LMB_SHOW_DIRECT;
    f.groups = NULL;
    memset(&f.points, 0, sizeof f.points);
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK && same_picture(&reference, &other));
    f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    f.groups = NULL; /* full, without bounced light: the same */
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK && same_picture(&reference, &other));
    f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    f.stats = NULL;
    f.show = LMB_SHOW_INDIRECT;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    render_show(&third, LMB_SHOW_FULL, LMB_OCCLUSION_VIEW, 0);
    for (int i = 0; i < FLOATS; ++i) {
        double whole = (double)value_at(&third, i), sum = (double)value_at(&reference, i) + (double)value_at(&other, i);
        worst = larger(worst, fabs(whole - sum) / (fabs(sum) + 1e-6));
    }
    CHECK_MSG(worst < 5e-7, "%g", worst);
    CHECK(lit_pixels(&other) > FLOATS / 2 && lit_pixels(&reference) > FLOATS / 8);
}

/* A wall of LMB_UNLIT shows its albedo in any light. Other surfaces do not change. */
static void test_unlit(void)
{
    enum { WALL = 3 };
    const float *colour = room_materials[WALL].albedo;
    int shown = 0, wrong = 0, lit = 0;
    room_materials[WALL].flags ^= LMB_UNLIT;
    room.light_count = 0;
    render_show(&third, LMB_SHOW_DIRECT, LMB_OCCLUSION_VIEW, 0); /* only the wall */
    set_lights(LIGHTS);
    render_show(&other, LMB_SHOW_DIRECT, LMB_OCCLUSION_VIEW, 0);
    room_materials[WALL].flags ^= LMB_UNLIT;
    render_show(&reference, LMB_SHOW_DIRECT, LMB_OCCLUSION_VIEW, 0);
    for (int i = 0; i < FLOATS; ++i) {
        const int is_wall = value_at(&third, i - i % 3) > 0.0f;
        shown += is_wall;
        lit += is_wall && value_at(&reference, i) != value_at(&other, i);
        wrong += value_at(&other, i) != (is_wall ? colour[i % 3] : value_at(&reference, i));
        wrong += value_at(&third, i) != (is_wall ? colour[i % 3] : 0.0f);
    }
    CHECK_MSG(wrong == 0 && lit > 100 && shown > 100 && shown < FLOATS / 2, "%d wrong, %d of %d lit otherwise", wrong,
              lit, shown);
}

/* ---- errors ---- */

static void set_canaries(void)
{
    for (int i = 0; i < CANARY; ++i) {
        m.depth[i] = m.id[i] = m.map[i] = PATTERN;
        m.depth[CANARY + TARGET + i] = m.id[CANARY + TARGET + i] = m.map[CANARY + MAP_WORDS + i] = PATTERN;
    }
}

static int canaries_live(void)
{
    int good = 1;
    for (int i = 0; i < CANARY; ++i) {
        good &= m.depth[i] == PATTERN && m.id[i] == PATTERN && m.map[i] == PATTERN;
        good &= m.depth[CANARY + TARGET + i] == PATTERN && m.id[CANARY + TARGET + i] == PATTERN;
        good &= m.map[CANARY + MAP_WORDS + i] == PATTERN;
    }
    return good;
}

/* Refused at once: returns the status and writes no pixel, map or point. */
static void check_refused(const lmb_frame *f, lmb_status expected, const char *what)
{
    static uint32_t map_before[MAP_WORDS];
    memcpy(map_before, m.map + CANARY, sizeof map_before);
    set_canaries();
    lmb_status status = lmb_render_frame(&m.render, f);
    CHECK_MSG(status == expected, "%s: %s", what, lmb_status_name(status));
    CHECK_MSG(other.data[0] == PATTERN && picture_keeps_rest(&other) && m.depth[CANARY] == 0x3c3c3c3cu &&
                  m.points[0].face == 0x3c3c3c3cu && memcmp(map_before, m.map + CANARY, sizeof map_before) == 0,
              "%s: wrote", what);
    CHECK_MSG(canaries_live(), "%s", what);
    CHECK_MSG(lmb_render_step(&m.render, 1000) <= LMB_OK, "%s: goes on", what);
}

static lmb_frame refused_frame(void) { return plain_frame(&room, room_view(WIDTH, HEIGHT), &other); }

static void test_refused(void)
{
    static lmb_light many[LMB_MAX_LIGHTS + ALL_LIGHTS];
    static const lmb_surface none;
    lmb_frame f = refused_frame();
#define REFUSED(change, status) \
    do { \
        f = refused_frame(); \
        change; \
        check_refused(&f, status, #change); \
    } while (0)
    CHECK(lmb_render_begin(NULL, &f) == LMB_ERR_ARG && lmb_render_begin(&m.render, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_step(NULL, 1) == LMB_ERR_ARG);
    REFUSED(f.kernels = NULL, LMB_ERR_ARG);
    REFUSED(f.scene = NULL, LMB_ERR_ARG);
    REFUSED(f.scratch = NULL, LMB_ERR_ARG);
    REFUSED(f.show = 4, LMB_ERR_ARG);
    REFUSED(f.show = -1, LMB_ERR_ARG);
    REFUSED(f.occlusion = 3, LMB_ERR_ARG);
    REFUSED(f.error = -1.0f, LMB_ERR_ARG);
    REFUSED(f.visibility = -1.0f, LMB_ERR_ARG);
    REFUSED(f.steps = 65, LMB_ERR_ARG);
    REFUSED(f.steps = -1, LMB_ERR_ARG);
    REFUSED(f.shadow_map = 60, LMB_ERR_ARG);
    REFUSED(f.shadow_map = 0, LMB_ERR_ARG);
    REFUSED(f.map_memory = NULL, LMB_ERR_ARG);
    REFUSED(f.map_memory = (uint8_t *)f.map_memory + 1, LMB_ERR_ALIGN);
    REFUSED(f.map_bytes = FACES * MAP * MAP * 8 - 1, LMB_ERR_CAPACITY); /* 8 bytes a texel */
    REFUSED(f.map_bytes = 0, LMB_ERR_CAPACITY);
    REFUSED(f.out = none, LMB_ERR_ARG);
    REFUSED(f.out.width = WIDTH - 1, LMB_ERR_ARG);
    REFUSED(f.out.height = HEIGHT - 1, LMB_ERR_ARG);
    REFUSED(f.out.format = LMB_R32F, LMB_ERR_FORMAT);
    REFUSED(f.out.format = LMB_DEPTH32F, LMB_ERR_FORMAT);
    REFUSED(f.eye.depth.data = NULL, LMB_ERR_ARG);
    REFUSED(f.eye.id.data = NULL, LMB_ERR_ARG);
    REFUSED(f.eye.y0 = 8, LMB_ERR_ARG);
    REFUSED(f.occlusion = LMB_OCCLUSION_NONE; f.eye.depth.height = f.eye.id.height = 12, LMB_ERR_ARG);
    REFUSED(f.eye.depth.height = f.eye.id.height = 16, LMB_ERR_ARG);
    REFUSED(f.occlusion = LMB_OCCLUSION_NONE; f.eye.depth.width = f.eye.id.width = WIDTH - 8, LMB_ERR_ARG);
    REFUSED(f.occlusion = LMB_OCCLUSION_NONE; set_eye(&f, LMB_TILE, LMB_TILED, LMB_DEPTH32F, LMB_ID32); f.eye.y0 = 8,
            LMB_ERR_ARG);
    REFUSED(set_eye(&f, LMB_TILE, LMB_TILED, LMB_DEPTH32F, LMB_ID32), LMB_ERR_ARG); /* VIEW needs the whole depth */
    memcpy(many, room_lights, sizeof room_lights);
    room.lights = many;
    REFUSED(room.light_count = LMB_MAX_LIGHTS + 1, LMB_ERR_CAPACITY);
    room.lights = room_lights;
    set_lights(LIGHTS);
    room_mesh[6].triangle_count = 65536;
    REFUSED(f.id_format = LMB_ID16, LMB_ERR_SCENE);
    room_mesh[6].triangle_count = SIDE_TRIANGLES;
#undef REFUSED
}

/* Exactly enough map memory suffices, at the end of the array. */
static void test_exact_memory(void)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    set_canaries();
    f.map_bytes = FACES * lmb_shadow_map_bytes(1, MAP, LMB_ID32);
    f.map_memory = m.map + CANARY + MAP_WORDS - f.map_bytes / sizeof *m.map;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK && canaries_live() && picture_keeps_rest(&other));
}

/* Full points end the frame with a status and nothing is written past the caller's arrays. */
static void test_few_points(void)
{
    for (uint32_t cap = 1; cap < 60; cap = cap * 3 + 1) {
        lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
        f.points.cap = cap;
        CHECK(lmb_render_frame(&m.render, &f) == LMB_ERR_CAPACITY);
        CHECK(m.points[cap].face == 0x3c3c3c3cu && other.data[0] == PATTERN);
    }
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    f.points.cell_cap = (MAP / BLOCK) * (MAP / BLOCK); /* one short */
    CHECK(lmb_render_frame(&m.render, &f) == LMB_ERR_CAPACITY);
    CHECK(m.cells[(MAP / BLOCK) * (MAP / BLOCK)] == 0x3c3c3c3cu && other.data[0] == PATTERN);
}

static void test_band_arguments(void)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK);
    CHECK(lmb_render_band(&m.render, &m.scratch, &f.eye, &f.out, 0) == LMB_ERR_ARG); /* too early */
    CHECK(run_to_bands(&f) == LMB_MORE);
    CHECK(lmb_render_band(NULL, &m.scratch, &f.eye, &f.out, 0) == LMB_ERR_ARG);
    CHECK(lmb_render_band(&m.render, NULL, &f.eye, &f.out, 0) == LMB_ERR_ARG);
    CHECK(lmb_render_band(&m.render, &m.scratch, NULL, &f.out, 0) == LMB_ERR_ARG);
    CHECK(lmb_render_band(&m.render, &m.scratch, &f.eye, NULL, 0) == LMB_ERR_ARG);
    CHECK(lmb_render_band(&m.render, &m.scratch, &f.eye, &f.out, -1) == LMB_ERR_ARG);
    CHECK(lmb_render_band(&m.render, &m.scratch, &f.eye, &f.out, HEIGHT / 8) == LMB_ERR_ARG);
    CHECK(other.data[0] == PATTERN && picture_keeps_rest(&other));
}

/* V34: maps, points, groups, view, bands, each once, in this order. */
static void test_progress(void)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    const char *name = NULL;
    int wrong = 0, stage = -1, stages = 0;
    float before = 0.0f;
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK);
    do {
        float now = lmb_render_progress(&name, &m.render);
        wrong += name == NULL || !(now >= 0.0f && now <= 1.0f) || m.render.stage < stage;
        wrong += m.render.stage == stage && now < before;
        wrong += m.render.stage > stage + 1 + (m.render.stage == LMB_STAGE_BANDS); /* the frame has no samples */
        stages += m.render.stage != stage;
        stage = m.render.stage;
        before = now;
    } while (lmb_render_step(&m.render, 1) == LMB_MORE);
    CHECK(wrong == 0 && stages == LMB_STAGE_DONE - 1 && lmb_render_progress(&name, &m.render) == 1.0f);
    CHECK(lmb_render_progress(&name, NULL) == 1.0f && name != NULL);
}

/* ---- two eyes, one light ---- */

enum { WIDE = 2 * WIDTH * HEIGHT * 3 };

/* Stereo picture, and the second eye's buffers. */
static uint32_t wide[WIDE], right_depth[TARGET], right_id[TARGET];

/* Uses a tree of lights with a cut per tile, and exact occlusion. */
static void use_cut(lmb_frame *f)
{
    enum { FACE_BYTES = MAP * MAP * (sizeof(lmb_texel) + sizeof(lmb_node) / 3) + 64 * (sizeof(lmb_view) + sizeof(lmb_target)) };
    static uint32_t tree[FACES * FACE_BYTES / 4], bvh[SIDES * SIDE_TRIANGLES * 128 / 4];
    f->grouping.method = LMB_GROUP_CUT;
    f->shadow_map = MAP;
    CHECK(lmb_tree_init(&f->tree, FACES, MAP, tree, sizeof tree) == LMB_OK);
    CHECK(lmb_bvh_init(&f->bvh, lmb_scene_triangles(f->scene), bvh, sizeof bvh) == LMB_OK);
}

/* Map sizes that the tree cannot use are refused before drawing, not halfway by the tree's own call. */
static void test_odd_trees(void)
{
    lmb_frame f = refused_frame();
    use_cut(&f);
    f.occlusion = LMB_OCCLUSION_EXACT;
    f.tree.size = 8;
    for (int32_t each = 1; each <= 9; ++each) {
        const int good = each == 1 || each == 2 || each == 4 || each == 8;
        f.shadow_map = 8 * each;
        CHECK_MSG((lmb_render_begin(&m.render, &f) == LMB_ERR_ARG) == !good, "%d times the tree's size", (int)each);
    }
}

static lmb_view eye_view(int eye)
{
    lmb_view v = room_view(WIDTH, HEIGHT);
    v.eye.x += eye == 0 ? -0.0625f : 0.0625f;
    return v;
}

static lmb_surface half_of_wide(int eye)
{
    lmb_surface s;
    memset(&s, 0, sizeof s);
    s.data = wide + eye * WIDTH * 3;
    s.width = WIDTH;
    s.height = HEIGHT;
    s.stride_bytes = 2 * WIDTH * 12;
    s.format = LMB_RGB32F;
    return s;
}

static void finish(lmb_render *r, int32_t units)
{
    lmb_status status = LMB_MORE;
    while (status == LMB_MORE) {
        status = lmb_render_step(r, units);
    }
    CHECK_MSG(status == LMB_OK, "%s", lmb_status_name(status));
}

/* A frame with zones or with a cut. */
static lmb_frame stereo_frame(int eye, int occlusion, picture *out)
{
    lmb_frame f = plain_frame(&room, eye_view(eye), out);
    f.occlusion = occlusion;
    if (occlusion == LMB_OCCLUSION_EXACT) {
        use_cut(&f);
    }
    return f;
}

/* Both halves equal separate frames byte for byte. */
static void check_halves(int occlusion)
{
    for (int eye = 0; eye < 2; ++eye) {
        int wrong = 0;
        lmb_frame f = stereo_frame(eye, occlusion, &reference);
        CHECK(lmb_render_frame(&m.render, &f) == LMB_OK && lit_pixels(&reference) > FLOATS / 4);
        for (int y = 0; y < HEIGHT; ++y) {
            wrong += memcmp(wide + (2 * y + eye) * WIDTH * 3, reference.data + y * WIDTH * 3, WIDTH * 12) != 0;
        }
        CHECK_MSG(wrong == 0, "eye %d: %d rows differ", eye, wrong);
    }
    CHECK(memcmp(wide, wide + WIDTH * 3, WIDTH * 12) != 0); /* the eyes see different pictures */
}

/* V31: the left eye, then the right with the solved light of the left; the light's stages run and count once. */
static void check_stereo(int occlusion, int32_t units)
{
    lmb_stats left;
    memset(&m.stats, 0, sizeof m.stats);
    memset(wide, 0xa5, sizeof wide);
    lmb_frame f = stereo_frame(0, occlusion, &other);
    f.out = half_of_wide(0);
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK);
    finish(&m.render, units);
    left = m.stats;
    const uint32_t all = lmb_scene_triangles(&room);
    CHECK((left.groups > 0) == (occlusion != LMB_OCCLUSION_EXACT) && left.triangles == (FACES + 1) * all);
    f.view = eye_view(1);
    f.out = half_of_wide(1);
    CHECK(lmb_render_again(&m.render, &f) == LMB_OK && m.render.stage == LMB_STAGE_VIEW);
    finish(&m.render, units);
    CHECK(m.stats.first_points == left.first_points && m.stats.discs == left.discs &&
          m.stats.groups == left.groups && m.stats.flux_lit == left.flux_lit);
    CHECK(m.stats.triangles == left.triangles + all && m.stats.bands == 2 * left.bands);
    check_halves(occlusion);
}

/* Both eyes alternately: a copy of the render with separate depth and scratch. */
static void check_stereo_at_once(void)
{
    memset(wide, 0xa5, sizeof wide);
    lmb_frame f = plain_frame(&room, eye_view(0), &other);
    f.out = half_of_wide(0);
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK);
    while (m.render.stage < LMB_STAGE_VIEW) {
        lmb_render_step(&m.render, 3);
    }
    m.copy = m.render;
    f.view = eye_view(1);
    f.out = half_of_wide(1);
    f.scratch = &m.other_scratch;
    f.eye.depth = target_surface(LMB_DEPTH32F, LMB_TILED, WIDTH, HEIGHT, right_depth);
    f.eye.id = target_surface(LMB_ID32, LMB_TILED, WIDTH, HEIGHT, right_id);
    CHECK(lmb_render_again(&m.copy, &f) == LMB_OK);
    for (lmb_status a = LMB_MORE, b = LMB_MORE; a == LMB_MORE || b == LMB_MORE;) {
        a = lmb_render_step(&m.render, 5);
        b = lmb_render_step(&m.copy, 9);
        CHECK(a >= 0 && b >= 0);
    }
    check_halves(LMB_OCCLUSION_VIEW);
}

/* Another `show` with the same light; light that was not solved is refused. */
static void check_other_shows(void)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    set_picture(&reference, LMB_RGB32F, WIDTH, HEIGHT);
    f.out = reference.surface;
    f.show = LMB_SHOW_DIRECT;
    CHECK(lmb_render_again(&m.render, &f) == LMB_OK);
    finish(&m.render, 64);
    render_show(&third, LMB_SHOW_DIRECT, LMB_OCCLUSION_VIEW, LMB_GROUP_ZONES);
    CHECK(same_picture(&reference, &third));
    f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    f.show = LMB_SHOW_DIRECT;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    f.show = LMB_SHOW_FULL;
    CHECK(lmb_render_again(&m.render, &f) == LMB_ERR_ARG && m.render.stage == LMB_STAGE_DONE);
    /* A BVH that was built can be used again; one that was not cannot. */
    for (int built = 0; built < 2; ++built) {
        f = stereo_frame(0, LMB_OCCLUSION_EXACT, &other);
        f.show = LMB_SHOW_INDIRECT;
        f.occlusion = built ? LMB_OCCLUSION_EXACT : LMB_OCCLUSION_NONE;
        CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
        f.occlusion = LMB_OCCLUSION_NONE;
        CHECK(lmb_render_again(&m.render, &f) == LMB_OK);
        finish(&m.render, 64);
        f.occlusion = LMB_OCCLUSION_EXACT;
        CHECK(lmb_render_again(&m.render, &f) == (built ? LMB_OK : LMB_ERR_ARG));
        f.show = LMB_SHOW_DIRECT; /* needs neither */
        CHECK(lmb_render_again(&m.render, &f) == LMB_OK);
        finish(&m.render, 64);
    }
}

/* Refused: the render stays unchanged. */
static void check_again_refused(void)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other), bad;
    CHECK(lmb_render_again(NULL, &f) == LMB_ERR_ARG);
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK);
    CHECK(lmb_render_again(&m.render, NULL) == LMB_ERR_ARG);
    while (m.render.stage < LMB_STAGE_VIEW) {
        CHECK(lmb_render_again(&m.render, &f) == LMB_ERR_ARG);
        lmb_render_step(&m.render, 1000);
    }
    m.copy = m.render;
    bad = f;
    bad.out.width = WIDTH - 1;
    CHECK(lmb_render_again(&m.render, &bad) == LMB_ERR_ARG);
    bad = f;
    bad.out.format = LMB_R32F;
    CHECK(lmb_render_again(&m.render, &bad) == LMB_ERR_FORMAT);
    bad = f;
    bad.view.frame_width = WIDTH - 8;
    CHECK(lmb_render_again(&m.render, &bad) == LMB_ERR_ARG);
    bad = f;
    bad.kernels = NULL;
    CHECK(lmb_render_again(&m.render, &bad) == LMB_ERR_ARG);
    CHECK(memcmp(&m.copy, &m.render, sizeof m.copy) == 0);
    f.points.cap = 5;
    CHECK(lmb_render_frame(&m.render, &f) == LMB_ERR_CAPACITY);
    CHECK(lmb_render_again(&m.render, &f) == LMB_ERR_CAPACITY);
}

static void test_again(void)
{
    check_stereo(LMB_OCCLUSION_NONE, 1 << 20);
    check_stereo(LMB_OCCLUSION_VIEW, 1 << 20);
    check_stereo(LMB_OCCLUSION_VIEW, 7);
    check_stereo(LMB_OCCLUSION_EXACT, 64);
    check_stereo_at_once();
    check_other_shows();
    check_again_refused();
}

/* ---- data that a frame keeps ---- */

static float kept[MAP * MAP];

/* V33: distances of one face of a shadow map from the G-buffer of its view: each texel's ray ends on the room's bounds
 * or inside. */
static int light_distances(const lmb_shadow_map *map, int32_t face)
{
    const lmb_view *v = &map->view[face];
    int found = 0, out = 0;
    lmb_surface s;
    lmb_surface_init(&s, LMB_R32F, MAP, MAP, kept, sizeof kept);
    for (int32_t b = 0; b < MAP / 8; ++b) {
        CHECK(lmb_gbuffer_band(&s, NULL, NULL, picked_kernels(), &m.scratch.tile, v, &room, &map->face[face], b) ==
              LMB_OK);
    }
    for (int i = 0; i < MAP * MAP; ++i) {
        const float x = ((float)(i % MAP) + 0.5f) * 2.0f / MAP - 1.0f;
        const float y = 1.0f - ((float)(i / MAP) + 0.5f) * 2.0f / MAP;
        const float scale = v->kind == LMB_PERSPECTIVE ? kept[i] : 1.0f, w = kept[i];
        const lmb_vec3 across =
            add3(mul3(v->right, x * v->half_width * scale), mul3(v->up, y * v->half_height * scale));
        const lmb_vec3 at = sub3(add3(v->eye, across), mul3(v->back, w));
        found += w > 0.0f;
        out += w > 0.0f && (at.x < room.bounds_min.x - 1e-3f || at.x > room.bounds_max.x + 1e-3f ||
                            at.y < room.bounds_min.y - 1e-3f || at.y > room.bounds_max.y + 1e-3f ||
                            at.z < room.bounds_min.z - 1e-3f || at.z > room.bounds_max.z + 1e-3f);
    }
    CHECK_MSG(out == 0, "%d texels outside the room", out);
    return found;
}

/* The discs and groups of a finished frame: each disc is in one group and in the map of its face. Its flux is incoming
 * flux x reflectance, and the groups emit the sum of the discs. */
static void check_kept_groups(const lmb_points *p, const lmb_groups *g)
{
    uint32_t members = 0, wrong = 0;
    double flux = 0.0, sent = 0.0, came = 0.0;
    for (int32_t k = 0; k < g->count; ++k) {
        wrong += g->first[k] != members;
        members += g->members[k];
        sent += (double)g->flux[1][k];
    }
    for (uint32_t i = 0; i < p->count; ++i) {
        const lmb_point *d = &p->data[i];
        flux += (double)d->flux[1];
        came += d->albedo[1] > 0.0f ? (double)(d->flux[1] / d->albedo[1]) : 0.0;
        wrong += d->face < 1 || d->face > p->faces || d->cell_x >= MAP / BLOCK || d->cell_y >= MAP / BLOCK;
    }
    CHECK(wrong == 0 && members == p->count && g->count > 10 && p->faces == FACES);
    CHECK(fabs(sent / flux - 1.0) < 1e-5 && came > flux);
}

/* The kept depth of the whole view agrees with the G-buffer. */
static void check_kept_depth(const lmb_frame *f)
{
    static uint32_t rows[TARGET];
    float *z = gbuffer[0];
    lmb_surface s;
    double worst = 0.0;
    lmb_surface_init(&s, LMB_R32F, WIDTH, HEIGHT, z, TARGET * 4);
    for (int32_t b = 0; b < HEIGHT / 8; ++b) {
        CHECK(lmb_gbuffer_band(&s, NULL, NULL, f->kernels, &m.scratch.tile, &f->view, &room, &f->eye, b) == LMB_OK);
    }
    CHECK(lmb_depth_linearize(rows, sizeof rows, &f->eye.depth) == LMB_OK);
    for (int i = 0; i < TARGET; ++i) {
        float d;
        memcpy(&d, &rows[i], sizeof d);
        worst = d > 0.0f ? fmax(worst, fabs((double)(lmb_depth_view_z(&f->view, d) / z[i]) - 1.0)) : worst;
    }
    CHECK_MSG(worst < 1e-3, "%g", worst);
}

static void test_buffers(void)
{
    lmb_frame f = plain_frame(&room, room_view(WIDTH, HEIGHT), &other);
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK);
    const lmb_render *r = &m.render;
    int found = 0;
    for (int i = 0; i < LIGHTS; ++i) {
        for (int32_t face = 0; face < r->maps[i].faces; ++face) {
            found += (r->maps[i].drawn >> face) & 1u ? light_distances(&r->maps[i], face) : 0;
        }
    }
    CHECK_MSG(found > MAP * MAP / 2, "%d texels", found);
    check_kept_groups(&r->frame.points, r->frame.groups);
    check_kept_depth(&r->frame);
}

/* ---- the G-buffer ---- */

/* Bands from one whole target; then, last band first, each from a separate target of eight rows. */
static void check_gbuffer(const lmb_scene *scene, lmb_view view)
{
    lmb_frame f = plain_frame(scene, view, &other);
    int32_t bands = (view.frame_height + 7) / 8, failed = 0, flat = 0;
    lmb_surface s[3];
    const lmb_kernels *k = picked_kernels();
    lmb_surface_clear(&f.eye.depth);
    lmb_surface_clear(&f.eye.id);
    lmb_draw(&f.eye, k, &view, scene, 1, UINT32_MAX, LMB_CULL_BACK, NULL);
    set_gbuffer(s, gbuffer[0], &view);
    for (int32_t b = 0; b < bands; ++b) {
        failed += lmb_gbuffer_band(&s[0], &s[1], &s[2], k, &m.scratch.tile, &view, scene, &f.eye, b) != LMB_OK;
    }
    set_gbuffer(s, gbuffer[1], &view);
    set_eye(&f, LMB_TILE, LMB_LINEAR, LMB_DEPTH32F, LMB_ID16);
    for (int32_t b = bands - 1; b >= 0; --b) {
        f.eye.y0 = 8 * b;
        lmb_surface_clear(&f.eye.depth);
        lmb_surface_clear(&f.eye.id);
        lmb_draw(&f.eye, k, &view, scene, 1, UINT32_MAX, LMB_CULL_BACK, NULL);
        failed += lmb_gbuffer_band(&s[0], NULL, &s[2], k, &m.scratch.tile, &view, scene, &f.eye, b) != LMB_OK;
        failed += lmb_gbuffer_band(NULL, &s[1], NULL, k, &m.scratch.tile, &view, scene, &f.eye, b) != LMB_OK;
    }
    CHECK(failed == 0 && memcmp(gbuffer[0], gbuffer[1], sizeof gbuffer[0]) == 0);
    for (int32_t i = 0; i < view.frame_width * view.frame_height; ++i) {
        const float *n = gbuffer[0] + view.frame_width * view.frame_height + 3 * i;
        float size = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        flat += gbuffer[0][i] == 0.0f ? size != 0.0f : fabsf(size - 1.0f) > 1e-5f;
    }
    CHECK_MSG(flat == 0, "%d normals are not of unit length", (int)flat);
}

static void test_gbuffer(void)
{
    lmb_view view = room_view(WIDTH, HEIGHT);
    lmb_surface s[3];
    check_gbuffer(&room, view);
    check_gbuffer(&room, room_view(WIDTH - 11, HEIGHT - 11));
    check_gbuffer(demo_scene(), demo_view(WIDTH, HEIGHT));
    lmb_frame f = plain_frame(&room, view, &other);
    const lmb_kernels *k = picked_kernels();
    set_gbuffer(s, gbuffer[0], &view);
    CHECK(lmb_gbuffer_band(&s[0], NULL, NULL, k, &m.scratch.tile, &view, &room, &f.eye, HEIGHT / 8) == LMB_ERR_ARG);
    CHECK(lmb_gbuffer_band(&s[0], NULL, NULL, k, &m.scratch.tile, &view, &room, &f.eye, -1) == LMB_ERR_ARG);
    CHECK(lmb_gbuffer_band(&s[0], NULL, NULL, k, NULL, &view, &room, &f.eye, 0) == LMB_ERR_ARG);
    CHECK(lmb_gbuffer_band(&s[1], NULL, NULL, k, &m.scratch.tile, &view, &room, &f.eye, 0) == LMB_ERR_FORMAT);
    CHECK(lmb_gbuffer_band(NULL, &s[0], NULL, k, &m.scratch.tile, &view, &room, &f.eye, 0) == LMB_ERR_FORMAT);
}

/* ---- the shadow map ---- */

static void draw_shadow_map(lmb_shadow_map *map)
{
    const size_t bytes = 6 * MAP * MAP * 8;
    lmb_status status = lmb_shadow_map_init(map, &room_lights[1], &room, MAP, LMB_ID32, m.map + CANARY, bytes);
    CHECK(status == LMB_OK && map->faces == 6 && map->drawn == 63 && map->size == MAP);
    CHECK(lmb_shadow_map_clear(map) == LMB_OK);
    CHECK(lmb_shadow_map_draw(map, picked_kernels(), &room, 1, 555, NULL) == LMB_OK);
    CHECK(lmb_shadow_map_draw(map, picked_kernels(), &room, 556, UINT32_MAX, NULL) == LMB_OK);
}

/* Returns the texels with a surface; each face equals lmb_draw in its view. */
static int check_faces(const lmb_shadow_map *map)
{
    int found = 0;
    for (int32_t f = 0; f < 6; ++f) {
        static uint32_t depth[MAP * MAP], id[MAP * MAP];
        lmb_target t;
        memset(&t, 0, sizeof t);
        lmb_surface_init(&t.depth, LMB_DEPTH32F, MAP, MAP, depth, sizeof depth);
        lmb_surface_init(&t.id, LMB_ID32, MAP, MAP, id, sizeof id);
        lmb_surface_clear(&t.depth);
        lmb_surface_clear(&t.id);
        lmb_draw(&t, picked_kernels(), &map->view[f], &room, 1, UINT32_MAX, 0, NULL);
        CHECK(memcmp(depth, map->face[f].depth.data, sizeof depth) == 0);
        CHECK(memcmp(id, map->face[f].id.data, sizeof id) == 0);
        for (int i = 0; i < MAP * MAP; ++i) {
            found += id[i] != 0;
        }
    }
    return found;
}

/* Single-sided walls, then the same walls reversed: lights see both sides, so the ids are equal. (The corner order
 * differs, which changes the rounding of the depth of clipped triangles.) */
static void test_shadow_map(void)
{
    static uint32_t before[6][MAP * MAP];
    lmb_shadow_map map;
    for (int n = 0; n < SIDES; ++n) {
        room_materials[n].flags = 0;
    }
    draw_shadow_map(&map);
    int found = check_faces(&map);
    CHECK_MSG(found > 3 * MAP * MAP, "%d texels", found);
    for (int32_t f = 0; f < 6; ++f) {
        memcpy(before[f], map.face[f].id.data, sizeof before[f]);
    }
    for (int i = 0; i < SIDES * SIDE_TRIANGLES; ++i) {
        uint16_t *corner = room_indices[i / SIDE_TRIANGLES] + i % SIDE_TRIANGLES * 3, t = corner[1];
        corner[1] = corner[2];
        corner[2] = t;
    }
    draw_shadow_map(&map);
    for (int32_t f = 0; f < 6; ++f) {
        CHECK(memcmp(before[f], map.face[f].id.data, sizeof before[f]) == 0);
    }
    set_room();
}

static void test_shadow_map_arguments(void)
{
    lmb_shadow_map map, before;
    const lmb_light *light = &room_lights[1];
    memset(&map, 0xa5, sizeof map);
    before = map;
    CHECK(lmb_shadow_map_init(&map, light, &room, MAP, LMB_ID32, m.map, 6 * MAP * MAP * 8 - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_shadow_map_init(&map, light, &room, 20, LMB_ID32, m.map, sizeof m.map) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_init(&map, light, &room, MAP, LMB_DEPTH32F, m.map, sizeof m.map) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_init(&map, light, &room, MAP, LMB_ID32, NULL, sizeof m.map) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_init(&map, light, &room, MAP, LMB_ID32, (uint8_t *)m.map + 2, 6 * MAP * MAP * 8) ==
          LMB_ERR_ALIGN);
    CHECK(memcmp(&map, &before, sizeof map) == 0);
    CHECK(lmb_shadow_map_draw(NULL, picked_kernels(), &room, 1, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_clear(NULL) == LMB_ERR_ARG);
}

void test_frames(void)
{
    set_room();
    CHECK(lmb_scene_check(&room) == LMB_OK && lmb_scene_check(demo_scene()) == LMB_OK);
    test_slicing();
    test_callback_stops();
    test_doubling();
    test_darkness();
    test_sum_of_lights();
    test_reflected();
    test_shows();
    test_unlit();
    test_odd_trees();
    test_refused();
    test_exact_memory();
    test_few_points();
    test_band_arguments();
    test_progress();
    test_again();
    test_buffers();
    test_high_byte_first();
    test_gbuffer();
    test_shadow_map();
    test_shadow_map_arguments();
}
