/* golden.c: pixel-exact cases: one line `name hash` each, the same on every machine, with every compiler, and in every
 * configuration that the case fits.
 *
 * Each case runs on every available backend (or on the backends of the golden_way); a line lists the
 * backends with a wrong hash.
 *
 * Freestanding and small (static memory under 256 KiB in the small configuration), so that a Cortex-M4F runs the same
 * list. A hash changes only in a commit that explains the pixels. */
#include "golden_cases.h"

#include <stddef.h>
#include <string.h>

#include "../../src/base/poly.h"
#include "../torus.h"
#include "../../tools/demo/demo_scene.h"

enum { WIDTH = GOLDEN_WIDTH, HEIGHT = GOLDEN_HEIGHT, MAP = 64, POINTS = GOLDEN_POINTS, TRIANGLES = 40, TREE = 32 };
enum { LIGHT_CELLS = 20, MANY_LIGHTS = 600, ELEMENTS = 64 };

static struct memory {
    uint32_t depth[88 * 64], id[88 * 64];
    uint32_t out[WIDTH * HEIGHT * 3]; /* from here on: golden_first */
    uint32_t map[MAP * MAP * 2];
    lmb_groups groups;
    lmb_band_scratch scratch;
    lmb_render render;
    uint64_t lights[LIGHT_CELLS * 720 / 8];
} memory GOLDEN_ALIGNED;
/* First points, or in their place the tree of a shadow map: one face, or more faces of a smaller size. */
static union light_memory {
    lmb_point points[POINTS];
    struct {
        lmb_texel texels[TREE * TREE];
        lmb_target shown;
        lmb_node nodes[(TREE * TREE - 1) / 3];
        lmb_view view;
    } tree;
} light_memory GOLDEN_ALIGNED;
static uint32_t point_cells[MAP / 4 * (MAP / 4) + 1] GOLDEN_ALIGNED;
static lmb_points points = {light_memory.points, POINTS, 0, point_cells, MAP / 4 * (MAP / 4) + 1, 0, NULL, 0, 0};
static uint32_t bvh_memory[TRIANGLES * 29 + 1024] GOLDEN_ALIGNED, element_memory[ELEMENTS * 44 + 64] GOLDEN_ALIGNED;
const lmb_kernels *golden_kernels;
static const golden_way *way;

/* --- hashing: every value as little-endian bytes ------------------------------------------------------------------ */

uint64_t golden_hash_u32(uint64_t h, uint32_t v)
{
    for (int i = 0; i < 4; ++i) {
        h = (h ^ ((v >> (8 * i)) & 255u)) * UINT64_C(0x100000001b3);
    }
    return h;
}

uint64_t golden_hash_floats(uint64_t h, const float *v, size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        uint32_t bits;
        memcpy(&bits, &v[i], sizeof bits);
        h = golden_hash_u32(h, bits);
    }
    return h;
}

static uint64_t hash_surface(uint64_t h, const lmb_surface *s)
{
    uint64_t own = lmb_surface_hash(s);
    return golden_hash_u32(golden_hash_u32(h, (uint32_t)own), (uint32_t)(own >> 32));
}

static uint64_t hash_points(uint64_t h)
{
    for (uint32_t i = 0; i < points.count; ++i) {
        const lmb_point *p = &points.data[i];
        h = golden_hash_floats(h, &p->position.x, 3);
        h = golden_hash_floats(h, &p->normal.x, 3);
        h = golden_hash_floats(h, p->flux, 3);
        h = golden_hash_floats(h, p->albedo, 3);
        h = golden_hash_floats(h, &p->axis_u.x, 3);
        h = golden_hash_floats(h, &p->axis_v.x, 3);
        h = golden_hash_floats(h, &p->distance, 1);
        h = golden_hash_u32(h, p->cell_x | (uint32_t)p->cell_y << 16);
    }
    return h;
}

static uint64_t hash_groups(uint64_t h)
{
    const lmb_groups *g = &memory.groups;
    for (int32_t k = 0; k < g->count; ++k) {
        for (int c = 0; c < 3; ++c) {
            h = golden_hash_floats(h, &g->position[c][k], 1);
            h = golden_hash_floats(h, &g->normal[c][k], 1);
            h = golden_hash_floats(h, &g->flux[c][k], 1);
        }
        h = golden_hash_floats(h, &g->area[k], 1);
        h = golden_hash_floats(h, &g->radius[k], 1);
        h = golden_hash_u32(h, g->members[k]);
    }
    return h;
}

/* --- a scene of random triangles, some masked, some textured ------------------------------------------------------ */

static float soup_positions[TRIANGLES * 9] GOLDEN_ALIGNED, soup_uvs[TRIANGLES * 6] GOLDEN_ALIGNED;
static uint32_t soup_colours[TRIANGLES * 3] GOLDEN_ALIGNED;
static uint32_t soup_texels[16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1] GOLDEN_ALIGNED;
static lmb_texture soup_texture;
static lmb_mesh soup_meshes[2];
static const lmb_material soup_materials[2] = {
    {{0.8f, 0.7f, 0.6f}, 1.0f, 0.0f, 0, LMB_DOUBLE_SIDED, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.5f, 0.6f, 0.9f}, 1.0f, 0.5f, 0, LMB_DOUBLE_SIDED | LMB_ALPHA_MASK, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0,
     0.0f},
};
static lmb_instance soup_instances[2];
static lmb_light soup_light;
static lmb_scene soup;

static uint32_t random_state;

float golden_random(float lo, float hi)
{
    random_state = random_state * 1664525u + 1013904223u;
    return lo + (hi - lo) * ((float)(random_state >> 8) * (1.0f / 16777216.0f));
}

static void make_texture(void)
{
    uint8_t *t = (uint8_t *)soup_texels;
    for (int i = 0; i < 16 * 16; ++i) {
        t[4 * i] = (uint8_t)(i * 7);
        t[4 * i + 1] = (uint8_t)(255 - i);
        t[4 * i + 2] = (uint8_t)(i * 3);
        t[4 * i + 3] = ((i >> 1) ^ (i >> 5)) & 1 ? 255 : 40;
    }
    soup_texture.texels = t;
    soup_texture.width = soup_texture.height = 16;
    soup_texture.levels = 5;
    soup_texture.wrap_s = LMB_WRAP_MIRROR;
    soup_texture.filter = LMB_TRILINEAR;
    lmb_texture_mips(t, 16, 16, 5);
}

lmb_scene *golden_soup(uint32_t seed, float span)
{
    static const lmb_instance instance = {
        {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 0, 0, 1, 0};
    random_state = seed;
    for (int i = 0; i < TRIANGLES * 9; ++i) {
        soup_positions[i] = golden_random(-span, span);
    }
    for (int i = 0; i < TRIANGLES * 6; ++i) {
        soup_uvs[i] = golden_random(-2.0f, 3.0f);
    }
    for (int i = 0; i < TRIANGLES * 3 * 4; ++i) {
        ((uint8_t *)soup_colours)[i] = (uint8_t)golden_random(0.0f, 256.0f);
    }
    make_texture();
    for (int m = 0; m < 2; ++m) {
        memset(&soup_meshes[m], 0, sizeof soup_meshes[m]);
        soup_meshes[m].positions = soup_positions + m * TRIANGLES / 2 * 9;
        soup_meshes[m].uvs = soup_uvs + m * TRIANGLES / 2 * 6;
        soup_meshes[m].colours = (const uint8_t *)(soup_colours + m * TRIANGLES / 2 * 3);
        soup_meshes[m].vertex_count = TRIANGLES / 2 * 3;
        soup_meshes[m].triangle_count = TRIANGLES / 2;
        soup_instances[m] = instance;
        soup_instances[m].mesh = soup_instances[m].material = (uint32_t)m;
        soup_instances[m].first_id = 1u + (uint32_t)m * TRIANGLES / 2;
    }
    memset(&soup, 0, sizeof soup);
    soup.meshes = soup_meshes;
    soup.materials = soup_materials;
    soup.textures = &soup_texture;
    soup.instances = soup_instances;
    soup.lights = &soup_light;
    soup.mesh_count = soup.material_count = soup.instance_count = 2;
    soup.texture_count = soup.light_count = 1;
    lmb_scene_bounds(&soup.bounds_min, &soup.bounds_max, &soup);
    return &soup;
}

lmb_view golden_soup_view(int orthographic)
{
    lmb_view v = {.sample_x = 0};
    lmb_vec3 eye = {0.3f, 0.2f, 4.0f}, target = {0, 0, 0}, up = {0, 1, 0};
    lmb_view_look_at(&v, eye, target, up, 0.9f, WIDTH, HEIGHT);
    v.near_m = 0.05f;
    v.far_m = 20.0f;
    if (orthographic) {
        v.kind = LMB_ORTHOGRAPHIC;
        v.half_width = 2.4f;
        v.half_height = 1.8f;
    }
    return v;
}

enum { TILED = 0, LINEAR = 8, PADDED = 16 };
enum { PADDING = 8 }; /* pixels after a row */

/* Sets a linear layout, without or with gaps between rows. */
static void make_linear(lmb_surface *s, int layout)
{
    s->layout = LMB_LINEAR;
    s->stride_bytes = (WIDTH + (layout == PADDED ? PADDING : 0)) * lmb_pixel_bytes(s->format);
}

/* Checks that the gaps between rows of a linear surface were not written. */
static int gaps_are_untouched(const lmb_surface *s)
{
    const int32_t row = WIDTH * lmb_pixel_bytes(s->format);
    int good = 1;
    for (int32_t y = 0; s->layout == LMB_LINEAR && y < s->height; ++y) {
        for (int32_t i = row; i < s->stride_bytes; ++i) {
            good &= ((const uint8_t *)s->data)[y * s->stride_bytes + i] == 0xa5;
        }
    }
    return good;
}

static void set_eye(lmb_target *eye, int32_t height, int depth_format, int id_format, int layout)
{
    memset(eye, 0, sizeof *eye);
    memset(memory.depth, 0xa5, sizeof memory.depth);
    memset(memory.id, 0xa5, sizeof memory.id);
    lmb_surface_init(&eye->depth, depth_format, WIDTH, height, memory.depth, sizeof memory.depth);
    lmb_surface_init(&eye->id, id_format, WIDTH, height, memory.id, sizeof memory.id);
    if (layout != TILED) {
        make_linear(&eye->depth, layout);
        make_linear(&eye->id, layout);
    }
    lmb_surface_clear(&eye->depth);
    lmb_surface_clear(&eye->id);
}

lmb_target golden_eye(int depth_format, int id_format)
{
    lmb_target eye;
    set_eye(&eye, HEIGHT, depth_format, id_format, TILED);
    return eye;
}

typedef char first_is_there[sizeof memory - offsetof(struct memory, out) >= sizeof ((golden_space *)0)->first ? 1 : -1];
typedef char second_is_there[sizeof light_memory >= sizeof ((golden_space *)0)->second ? 1 : -1];

void *golden_first(void) { return memset(memory.out, 0x3c, sizeof memory - offsetof(struct memory, out)); }
void *golden_second(void) { return memset(&light_memory, 0x3c, sizeof light_memory); }

/* --- cases -------------------------------------------------------------------------------------------------------- */

static uint64_t case_functions(int variant)
{
    uint64_t h = GOLDEN_START;
    (void)variant;
    for (int i = -600; i <= 600; ++i) {
        float x = (float)i * 0.0103f, v[5];
        v[0] = lmb_sin(x);
        v[1] = lmb_cos(x * 3.0f);
        v[2] = lmb_atan2(x, 1.5f - x * x);
        v[3] = lmb_log2(x * x + 1e-6f);
        v[4] = lmb_exp2(x);
        h = golden_hash_floats(h, v, 5);
    }
    return h;
}

/* A mesh drawn only by public calls: numbers.h. */
static uint64_t case_torus(int variant)
{
    static torus t;
    uint64_t h = GOLDEN_START;
    (void)variant;
    torus_make(&t);
    h = golden_hash_floats(h, t.positions, 3 * TORUS_VERTICES);
    for (int i = 0; i < 3 * TORUS_TRIANGLES; ++i) {
        h = golden_hash_u32(h, t.indices[i]);
    }
    return lmb_scene_check(&t.scene) == LMB_OK ? h : 0;
}

/* 0..3: depth 32F/16 x id 16/32; +4 orthographic; triangles cross the near plane and the guard band. LINEAR or PADDED
 * added: rows instead of tiles, with the same pixels and hash. */
static uint64_t case_raster(int variant)
{
    lmb_target eye;
    golden_soup(17u + (uint32_t)(variant & 7), variant & 4 ? 2.0f : 4.5f);
    lmb_view v = golden_soup_view(variant & 4);
    set_eye(&eye, HEIGHT, variant & 1 ? LMB_DEPTH16 : LMB_DEPTH32F, variant & 2 ? LMB_ID32 : LMB_ID16, variant & ~7);
    way->draw(&eye, golden_kernels, &v, &soup, LMB_CULL_BACK, NULL);
    uint64_t h = gaps_are_untouched(&eye.depth) && gaps_are_untouched(&eye.id) ? GOLDEN_START : 0;
    return hash_surface(hash_surface(h, &eye.depth), &eye.id);
}

static uint64_t case_resolve(int variant)
{
    lmb_target eye;
    uint64_t h = GOLDEN_START;
    golden_soup(91u, 2.0f);
    lmb_view v = golden_soup_view(variant & 7);
    set_eye(&eye, HEIGHT, LMB_DEPTH32F, LMB_ID16, variant & ~7);
    way->draw(&eye, golden_kernels, &v, &soup, 0, NULL);
    for (int32_t y = 0; y < HEIGHT; y += 8) {
        for (int32_t x = 0; x < WIDTH; x += 8) {
            const lmb_tile *t = &memory.scratch.tile;
            lmb_resolve_tile(&memory.scratch.tile, golden_kernels, &v, &soup, &eye, x, y);
            h = golden_hash_floats(h, t->position[0], 3 * 64);
            h = golden_hash_floats(h, t->face[0], 3 * 64);
            h = golden_hash_floats(h, t->albedo[0], 3 * 64);
            h = golden_hash_floats(h, t->depth, 64);
        }
    }
    return h;
}

/* Also uses the image as a normal map; back faces are visible. */
static uint64_t case_normal_map(int variant)
{
    lmb_target eye;
    lmb_material bent[2] = {soup_materials[0], soup_materials[1]};
    uint64_t h = GOLDEN_START;
    golden_soup(91u, 2.0f);
    bent[0].normal_scale = 1.0f;
    bent[1].normal_scale = 0.4f;
    soup.materials = bent;
    lmb_view v = golden_soup_view(variant);
    set_eye(&eye, HEIGHT, LMB_DEPTH32F, LMB_ID16, TILED);
    way->draw(&eye, golden_kernels, &v, &soup, 0, NULL);
    for (int32_t y = 0; y < HEIGHT; y += 8) {
        for (int32_t x = 0; x < WIDTH; x += 8) {
            lmb_resolve_tile(&memory.scratch.tile, golden_kernels, &v, &soup, &eye, x, y);
            h = golden_hash_floats(h, memory.scratch.tile.normal[0], 3 * 64);
        }
    }
    return h;
}

static lmb_light make_light(int kind)
{
    lmb_light l = {{0.5f, 1.5f, 3.0f}, {-0.16439899f, -0.49319696f, -0.85424364f}, {9, 8, 7}, 0.95f, 0.8f, 0, 0, 0};
    l.kind = kind;
    return l;
}

static uint64_t case_shadow_map(int variant)
{
    lmb_shadow_map map;
    golden_soup(33u, 2.0f);
    soup_light = make_light(variant);
    int32_t size = variant == LMB_LIGHT_POINT ? 24 : MAP;
    lmb_shadow_map_init(&map, &soup_light, &soup, size, LMB_ID16, memory.map, sizeof memory.map);
    way->draw_map(&map, golden_kernels, &soup);
    uint64_t h = GOLDEN_START;
    for (int32_t f = 0; f < map.faces; ++f) {
        float power[3];
        h = hash_surface(hash_surface(h, &map.face[f].depth), &map.face[f].id);
        for (int32_t i = 0; i < size; i += 3) {
            lmb_light_texel_power(power, &soup_light, &map, f, i, size - 1 - i);
            h = golden_hash_floats(h, power, 3);
        }
    }
    return h;
}

/* Points, discs and groups of the demo room's spot. Variants: zones, greedy, strict zones, first discs as centres; one
 * disc of ten points, neighbours by hemisphere. */
static uint64_t case_groups(int variant)
{
    static const lmb_grouping how[6] = {
        {LMB_GROUP_ZONES, 4, 60, 0, 0, 0, 0, 0, 0, 0, 0, 0},
        {LMB_GROUP_GREEDY, 4, 90, 0.5f, 1.0f, 2.5f, 0.8f, 0, 0, 0, 0, 0},
        {LMB_GROUP_ZONES, 4, 60, 0, 0, 0, 0.95f, LMB_ZONES_STRICT, 0, 0, 0, 0},
        {LMB_GROUP_ZONES, 4, 40, 0, 0, 0, 0, LMB_POINT_CENTRE, 0, 0, 0, 0},
        {LMB_GROUP_ZONES, 4, 60, 0, 0, 0, 0, 0, 10, 0, 0, 0},
        {LMB_GROUP_GREEDY, 4, 90, 0.25f, 0, 0, 0, LMB_NEAR_HEMISPHERE, 0, 0, 0, 0},
    };
    const lmb_scene *scene = demo_scene();
    lmb_shadow_map map;
    lmb_shadow_map_init(&map, &scene->lights[0], scene, MAP, LMB_ID16, memory.map, sizeof memory.map);
    way->draw_map(&map, golden_kernels, scene);
    points.count = points.faces = 0;
    lmb_status a =
        lmb_points_collect(&points, golden_kernels, &memory.scratch.tile, scene, &scene->lights[0], &map, 0, 0, MAP / 8,
                           &how[variant]);
    uint64_t h = golden_hash_u32(hash_points(GOLDEN_START), (uint32_t)a);
    h = golden_hash_u32(h, (uint32_t)lmb_discs_join(&points, &map, &how[variant]));
    h = hash_points(h);
    h = golden_hash_u32(h, (uint32_t)lmb_group_points(&memory.groups, &points, &how[variant], NULL));
    return hash_groups(h);
}

void golden_give_samples(lmb_band_scratch *out, golden_samples *own, int32_t samples)
{
#if LMB_MULTISAMPLE && !defined(LMB_CONFIG_TINY)
    lmb_multisample *m = &own->room;
    memset(m, 0x3c, sizeof *m);
    memset(&m->eye, 0, sizeof m->eye);
    lmb_surface_init(&m->eye.depth, LMB_DEPTH32F, WIDTH, samples * LMB_TILE, own->depth, sizeof own->depth);
    lmb_surface_init(&m->eye.id, LMB_ID32, WIDTH, samples * LMB_TILE, own->id, sizeof own->id);
    out->multisample = m;
#else
    (void)out;
    (void)own;
    (void)samples;
#endif
}

static lmb_frame demo_frame(void)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = golden_kernels;
    f.scene = demo_scene();
    f.view = demo_view(WIDTH, HEIGHT);
    f.shadow_map = MAP;
    f.grouping.block = 4;
    f.grouping.groups = 60;
    f.occlusion = LMB_OCCLUSION_VIEW;
    f.steps = 8;
    f.map_memory = memory.map;
    f.map_bytes = sizeof memory.map;
    f.id_format = LMB_ID16;
    f.points = points;
    f.groups = &memory.groups;
    f.scratch = &memory.scratch;
    set_eye(&f.eye, HEIGHT, LMB_DEPTH32F, LMB_ID16, TILED);
    lmb_surface_init(&f.out, LMB_RGB32F, WIDTH, HEIGHT, memory.out, sizeof memory.out);
    return f;
}

/* Draws a frame by the golden_way; hashes status and picture. */
static uint64_t hash_frame(uint64_t h, const lmb_frame *f)
{
    lmb_status status = way->render(&memory.render, f);
    return hash_surface(golden_hash_u32(h, (uint32_t)status), &f->out);
}

static uint64_t case_show(int variant)
{
    lmb_frame f = demo_frame();
    f.show = variant & 7;
    set_eye(&f.eye, HEIGHT, LMB_DEPTH32F, LMB_ID16, variant & ~7);
    return hash_frame(GOLDEN_START, &f);
}

#ifndef LMB_CONFIG_TINY
/* The range ends on the floor, before the walls. */
static uint64_t case_range(int variant)
{
    lmb_frame f = demo_frame();
    static lmb_scene scene;
    static lmb_light light;
    scene = *f.scene;
    light = scene.lights[0];
    light.range = 3.0f;
    scene.lights = &light;
    f.scene = &scene;
    f.show = variant;
    return hash_frame(GOLDEN_START, &f);
}
#endif

static uint64_t case_occlusion(int variant)
{
    lmb_frame f = demo_frame();
    f.show = LMB_SHOW_INDIRECT;
    f.occlusion = variant;
    return hash_frame(GOLDEN_START, &f);
}

/* Two eyes 12 cm apart, one light. Variant: occlusion. */
static uint64_t case_stereo(int variant)
{
    lmb_frame f = demo_frame();
    uint64_t h = GOLDEN_START;
    f.occlusion = variant;
    for (int eye = 0; eye < 2; ++eye) {
        f.view = demo_view(WIDTH, HEIGHT);
        f.view.eye.x += eye == 0 ? -0.06f : 0.06f;
        lmb_status status = eye == 0 ? way->render(&memory.render, &f) : way->again(&memory.render, &f);
        h = hash_surface(golden_hash_u32(h, (uint32_t)status), &f.out);
    }
    return h;
}

static uint64_t case_format(int variant)
{
    static const uint8_t formats[] = {LMB_RGB565, LMB_RGB555, LMB_RGBA8, LMB_BGRA8, LMB_RGB565_BE};
    lmb_frame f = demo_frame();
    f.exposure_ev = 0.5f;
    lmb_surface_init(&f.out, formats[variant], WIDTH, HEIGHT, memory.out, sizeof memory.out);
    return hash_frame(GOLDEN_START, &f);
}

/* A spot along a diagonal of the box, or a sun. */
static void turn_light(lmb_light *l, int i)
{
    l->kind = i % 4 == 3 ? LMB_LIGHT_DIRECTIONAL : LMB_LIGHT_SPOT;
    l->direction.x = i & 1 ? 0.48f : -0.6f;
    l->direction.y = i & 1 ? -0.64f : 0.0f;
    l->direction.z = i & 1 ? 0.6f : 0.8f;
    l->cos_outer = golden_random(0.1f, 0.9f);
    l->cos_inner = golden_random(l->cos_outer, 1.0f);
}

/* Lights all over the soup, in slices, with clusters among them. If lights have all kinds, there are so few cells that
 * any configuration merges lights at once. */
static lmb_status stream_lights(lmb_many_lights *many_lights, int kinds)
{
    const lmb_vec3 low = {-2, -2, -2}, high = {2, 2, 3};
    lmb_light slice[7];
    lmb_status status = lmb_many_lights_init(many_lights, kinds ? 8 : LIGHT_CELLS, low, high, 9.0f * MANY_LIGHTS,
                                             memory.lights, sizeof memory.lights);
    memset(slice, 0, sizeof slice);
    for (int i = 0; i < MANY_LIGHTS && status == LMB_OK; i += 7) {
        for (int k = 0; k < 7; ++k) {
            const float reach = k < 3 ? 0.01f : 1.9f;
            slice[k].position.x = golden_random(-reach, reach);
            slice[k].position.y = golden_random(-reach, reach);
            slice[k].position.z = 1.0f + golden_random(-reach, reach);
            for (int c = 0; c < 3; ++c) {
                slice[k].intensity[c] = golden_random(0.0f, 0.1f);
            }
            if (kinds && k > 0) {
                turn_light(&slice[k], i + k);
            }
            slice[k].range = kinds == 3 ? 0.4f * (float)(k % 6) : 0.0f;
        }
        status = lmb_many_lights_add(many_lights, slice, 7);
    }
    return status == LMB_OK ? lmb_many_lights_build(many_lights) : status;
}

/* Many lights on the soup, with shadows (0) and without; points, spots and suns (2), with ranges (3). LIGHT_CELLS never
 * fill a cut of the smallest capacity. */
static uint64_t case_many(int variant)
{
    lmb_frame f = demo_frame();
    lmb_many_lights many_lights;
    golden_soup(57u, 1.6f);
    soup.light_count = 0;
    lmb_status status = stream_lights(&many_lights, variant > 1 ? variant : 0);
    uint64_t h = golden_hash_u32(golden_hash_u32(GOLDEN_START, (uint32_t)status), many_lights.doubled);
    for (uint32_t i = 0; i < many_lights.node_count; ++i) {
        h = golden_hash_floats(golden_hash_floats(h, many_lights.node[i].intensity, 3), &many_lights.node[i].position.x,
                               3);
        h = golden_hash_floats(h, &many_lights.node[i].strongest.position.x, 3);
        h = golden_hash_floats(h, &many_lights.node[i].median.position.x, 3);
    }
    f.scene = &soup;
    f.view = golden_soup_view(0);
    f.show = LMB_SHOW_DIRECT;
    f.occlusion = LMB_OCCLUSION_NONE;
    f.many_lights = &many_lights;
    if (variant != 1) { /* shares the map's memory: there is no map */
        lmb_bvh_init(&f.bvh, TRIANGLES, memory.map, sizeof memory.map);
    }
    return hash_frame(h, &f);
}

/* --- cuts of the light tree ------------------------------------------------------------------------------------- */

static void set_tree(lmb_tree *tree, uint32_t faces, int32_t size)
{
    memset(&light_memory, 0x3c, sizeof light_memory);
    memset(tree, 0, sizeof *tree);
    lmb_tree_init(tree, faces, size, &light_memory, sizeof light_memory);
}

static uint64_t hash_tree(uint64_t h, const lmb_tree *tree, uint32_t faces)
{
    const uint32_t texels = (uint32_t)(tree->size * tree->size);
    for (uint32_t i = 0; i < faces * texels; ++i) {
        const lmb_texel *t = &tree->texel[i];
        h = golden_hash_floats(h, &t->position.x, 3);
        h = golden_hash_floats(h, &t->normal.x, 3);
        h = golden_hash_floats(h, t->flux, 3);
        for (int k = 0; k < 4; ++k) {
            h = golden_hash_u32(h, t->side[k]);
        }
    }
    for (uint32_t i = 0; i < faces * ((texels - 1) / 3); ++i) {
        const lmb_node *n = &tree->node[i];
        h = golden_hash_floats(h, &n->centre.x, 3);
        h = golden_hash_floats(h, &n->normal.x, 3);
        h = golden_hash_floats(h, n->flux, 3);
        h = golden_hash_floats(h, &n->area, 1);
        h = golden_hash_floats(h, &n->middle.x, 3);
        h = golden_hash_floats(h, &n->across.x, 3);
        h = golden_hash_floats(h, n->half, 3);
        h = golden_hash_floats(h, &n->radius, 1);
        h = golden_hash_floats(h, &n->cosine, 1);
        h = golden_hash_floats(h, &n->agreement, 1);
        h = golden_hash_u32(h, n->texel);
    }
    return h;
}

static lmb_bvh soup_bvh(void)
{
    lmb_bvh b;
    memset(&b, 0, sizeof b);
    lmb_bvh_init(&b, TRIANGLES, bvh_memory, sizeof bvh_memory);
    return b;
}

/* A face's tree. Variant: the light's kind (for a point, the sixth face); + 4: with half as many
 * texels a side as the map. */
static uint64_t case_tree(int variant)
{
    const int32_t face = (variant & 3) == LMB_LIGHT_POINT ? 5 : 0, size = face > 0 ? 16 : TREE;
    lmb_shadow_map map;
    lmb_tree tree;
    golden_soup(33u, 2.0f);
    soup_light = make_light(variant & 3);
    lmb_shadow_map_init(&map, &soup_light, &soup, size, LMB_ID16, memory.map, sizeof memory.map);
    way->draw_map(&map, golden_kernels, &soup);
    set_tree(&tree, 1, variant & 4 ? size / 2 : size);
    lmb_status a = lmb_tree_texels(&tree, golden_kernels, &memory.scratch.tile, &soup, &soup_light, &map, face, 0, 0,
                                   size / LMB_TILE);
    lmb_status b = lmb_tree_sum(&tree, 0);
    return hash_tree(golden_hash_u32(golden_hash_u32(GOLDEN_START, (uint32_t)a), (uint32_t)b), &tree, 1);
}

/* A soup lit by cuts of a tree of `size` x `size` texels a face. */
static lmb_frame soup_frame(uint32_t faces, int32_t size)
{
    lmb_frame f = demo_frame();
    golden_soup(33u, 2.0f);
    soup_light = make_light(LMB_LIGHT_SPOT);
    f.scene = &soup;
    f.view = golden_soup_view(0);
    f.show = LMB_SHOW_INDIRECT;
    f.shadow_map = size;
    f.grouping.method = LMB_GROUP_CUT;
    memset(&f.points, 0, sizeof f.points);
    f.groups = NULL;
    set_tree(&f.tree, faces, size);
    f.bvh = soup_bvh();
    return f;
}

/* 64 texels: the small configuration holds every cut. Variant: occlusion. */
static uint64_t case_cut(int variant)
{
    lmb_frame f = soup_frame(1, 8);
    f.occlusion = variant;
    return hash_frame(GOLDEN_START, &f);
}

#if LMB_FACETS && !defined(LMB_CONFIG_TINY)
/* A pillar of 19 sides on a floor. */
static void make_pillar(void)
{
    float *to = soup_positions, rim[20][2];
    for (int i = 0; i <= 19; ++i) {
        const float t = 0.21f * (float)(i % 19 - 9), per = 0.4f / (1.0f + t * t);
        rim[i][0] = (1.0f - t * t) * per;
        rim[i][1] = 2.0f * t * per;
    }
    const float floor_corner[2][9] = {{-2, -1, -2, -2, -1, 2, 2, -1, 2}, {-2, -1, -2, 2, -1, 2, 2, -1, -2}};
    memcpy(to, floor_corner, sizeof floor_corner);
    for (int i = 0; i < 38; ++i) {
        const float *a = rim[i / 2], *b = rim[i / 2 + 1];
        const float side[9] = {a[0], -1, a[1], b[0], i & 1 ? -1.0f : 1.0f, b[1], i & 1 ? b[0] : a[0], 1,
                               i & 1 ? b[1] : a[1]};
        memcpy(to + 18 + 9 * i, side, sizeof side);
    }
    soup_instances[1].material = 0;
    lmb_scene_bounds(&soup.bounds_min, &soup.bounds_max, &soup);
}

/* Texels of 8 x 8 pixels of the map, in which many sides show. */
static uint64_t case_facets(int variant)
{
    lmb_frame f = soup_frame(1, 8);
    make_pillar();
    f.shadow_map = variant;
    f.occlusion = LMB_OCCLUSION_EXACT;
    return hash_frame(GOLDEN_START, &f);
}
#endif

#ifndef LMB_CONFIG_TINY
/* The soup with light at single points, each near some of the map's texels. Variant: occlusion, and STEADY. */
enum { STEADY = 16 };

static uint64_t live_memory[1 << 13] GOLDEN_ALIGNED, lattice[10 * 8 * 192] GOLDEN_ALIGNED;
static lmb_live_scratch live_scratch;
static lmb_live live;

static uint64_t case_live(int variant)
{
    lmb_frame f = soup_frame(1, TREE);
    f.gather_step = LMB_GATHER_LIVE;
    f.occlusion = variant % STEADY;
    f.live = &live;
    memory.scratch.live = &live_scratch;
    const lmb_status one = lmb_lattice_init(&f.lattice, WIDTH, HEIGHT, lattice, sizeof lattice);
    const lmb_status two = lmb_live_init(&live, 1, lmb_live_side(1, TREE), 0, live_memory, sizeof live_memory);
    live.steady = variant / STEADY;
    return hash_frame(golden_hash_u32(golden_hash_u32(GOLDEN_START, (uint32_t)one), (uint32_t)two), &f);
}

/* The same under a sky of random suns, the first brighter than all others. */
static uint64_t case_live_sky(int variant)
{
    enum { SUNS = 96 };
    static uint64_t sky_memory[5 << 10] GOLDEN_ALIGNED, stream_memory[SUNS * 100] GOLDEN_ALIGNED;
    static lmb_live_sky sky;
    const lmb_vec3 none = {0, 0, 0};
    lmb_many_lights suns;
    lmb_light sun;
    lmb_frame f = soup_frame(1, TREE);
    lmb_status status = lmb_many_lights_init(&suns, SUNS, none, none, 300.0f, stream_memory, sizeof stream_memory);
    memset(&sun, 0, sizeof sun);
    sun.kind = LMB_LIGHT_DIRECTIONAL;
    sun.cos_inner = sun.cos_outer = 1.0f;
    for (int i = 0; i < SUNS && status == LMB_OK; ++i) {
        const float a = golden_random(-1, 1), b = golden_random(-1, 1), per = 1.0f / (1.0f + a * a + b * b);
        sun.direction.x = 2.0f * a * per; /* a point of the plane onto the sphere */
        sun.direction.y = 2.0f * b * per;
        sun.direction.z = (i & 1 ? 1.0f : -1.0f) * (1.0f - a * a - b * b) * per;
        for (int c = 0; c < 3; ++c) {
            sun.intensity[c] = golden_random(0.0f, 0.1f) * (i == 0 ? (float)SUNS : 1.0f);
        }
        status = lmb_many_lights_add(&suns, &sun, 1);
    }
    f.gather_step = LMB_GATHER_LIVE;
    f.occlusion = variant;
    f.live = &live;
    f.live_sky = &sky;
    f.many_lights = &suns;
    f.gather_many_lights = 1;
    memory.scratch.live = &live_scratch;
    status = status == LMB_OK ? lmb_many_lights_build(&suns) : status;
    const lmb_status one = lmb_lattice_init(&f.lattice, WIDTH, HEIGHT, lattice, sizeof lattice);
    const lmb_status two = lmb_live_init(&live, 1, lmb_live_side(1, TREE), 0, live_memory, sizeof live_memory);
    const lmb_status three = lmb_live_sky_init(&sky, suns.cell_count, sky_memory, sizeof sky_memory);
    const uint64_t h = golden_hash_u32(golden_hash_u32(GOLDEN_START, (uint32_t)status), (uint32_t)one);
    return hash_frame(golden_hash_u32(golden_hash_u32(h, (uint32_t)two), (uint32_t)three), &f);
}
#endif

#if LMB_MULTISAMPLE && !defined(LMB_CONFIG_TINY)
/* Several samples a pixel: the soup of case_cut, lobes, emission, and blending. */
static uint64_t case_samples(int variant)
{
    static const int32_t samples[] = {4, 8, 16, 4};
    static golden_samples own_samples;
    lmb_frame f = soup_frame(1, 8);
    lmb_material some[2] = {soup_materials[0], soup_materials[1]};
    for (int c = 0; c < 3; ++c) {
        some[0].specular[c] = variant == 1 ? 0.04f : 0.0f;
        some[1].specular[c] = variant == 1 ? 0.9f - 0.2f * (float)c : 0.0f;
        some[1].emission[c] = variant == 2 ? 0.5f : 0.0f;
    }
    some[0].roughness = some[1].roughness = 0.5f;
    if (variant == 3) {
        some[1].flags |= LMB_ALPHA_MASK | LMB_ALPHA_BLEND;
        some[1].alpha = 0.6f;
    }
    soup.materials = some;
    f.show = LMB_SHOW_FULL;
    f.occlusion = LMB_OCCLUSION_EXACT;
    f.samples = samples[variant];
    golden_give_samples(&memory.scratch, &own_samples, f.samples);
    if (variant == 2) {
        lmb_elements_init(&f.elements, ELEMENTS, element_memory, sizeof element_memory);
    }
    return hash_frame(GOLDEN_START, &f);
}
#endif

/* Cuts with more nodes than the small configuration holds. */
static uint64_t case_full_cut(int variant)
{
    lmb_frame f = soup_frame(1, TREE);
    f.occlusion = variant;
    return hash_frame(GOLDEN_START, &f);
}

/* The same with a conservative error: by bounds instead of the rule. */
static uint64_t case_cut_conservative(int variant)
{
    lmb_frame f = soup_frame(1, 8);
    (void)variant;
    f.occlusion = LMB_OCCLUSION_NONE;
    f.conservative = 1;
    f.error = 0.1f;
    return hash_frame(GOLDEN_START, &f);
}

/* Three bounces between the soup's elements; the whole picture. Variant 1: a part of the soup emits light. */
static uint64_t case_bounces(int variant)
{
    lmb_frame f = soup_frame(1, 8);
    lmb_material emitting[2] = {soup_materials[0], soup_materials[1]};
    emitting[1].emission[0] = emitting[1].emission[2] = (float)variant;
    soup.materials = emitting;
    f.show = LMB_SHOW_FULL;
    f.occlusion = LMB_OCCLUSION_EXACT;
    f.bounces = 3;
    lmb_elements_init(&f.elements, ELEMENTS, element_memory, sizeof element_memory);
    return hash_frame(GOLDEN_START, &f);
}

/* Materials with lobes, lit by a spot directly and after one bounce; the whole picture. Variant 1: one material is
 * diffuse. */
static uint64_t case_glossy(int variant)
{
    lmb_frame f = soup_frame(1, 8);
    lmb_material shiny[2] = {soup_materials[0], soup_materials[1]};
    for (int c = 0; c < 3; ++c) {
        shiny[0].specular[c] = variant ? 0.0f : 0.04f;
        shiny[1].specular[c] = 0.9f - 0.2f * (float)c;
    }
    shiny[0].roughness = 0.7f;
    shiny[1].roughness = 0.3f;
    soup.materials = shiny;
    f.show = LMB_SHOW_FULL;
    f.occlusion = LMB_OCCLUSION_EXACT;
    return hash_frame(GOLDEN_START, &f);
}

/* Variant 0: a map of emission, seen and as light; 1: a map of metal and roughness under a lobe; the whole picture. */
static uint64_t case_surface_maps(int variant)
{
    lmb_frame f = soup_frame(1, 8);
    lmb_material mapped[2] = {soup_materials[0], soup_materials[1]};
    for (int i = 0; i < 2; ++i) {
        for (int c = 0; c < 3; ++c) {
            mapped[i].emission[c] = variant ? 0.0f : 0.5f + 0.25f * (float)c;
            mapped[i].specular[c] = variant ? 0.04f : 0.0f;
        }
        mapped[i].roughness = 0.8f;
        mapped[i].metallic = 0.9f;
        mapped[i].emission_map = variant ? 0 : 1;
        mapped[i].metal_map = variant ? 1 : 0;
    }
    soup.materials = mapped;
    f.show = LMB_SHOW_FULL;
    f.occlusion = LMB_OCCLUSION_EXACT;
    lmb_elements_init(&f.elements, ELEMENTS, element_memory, sizeof element_memory);
    return hash_frame(GOLDEN_START, &f);
}

/* A spot, and another so wide that a cube's faces serve it; the whole picture. */
static uint64_t case_cut_lights(int variant)
{
    lmb_frame f = soup_frame(7, 8);
    lmb_light two[2];
    two[0] = two[1] = soup_light;
    two[1].position.x = -1.0f;
    two[1].cos_inner = 0.5f;
    two[1].cos_outer = 0.2f;
    soup.lights = two;
    soup.light_count = 2;
    f.show = LMB_SHOW_FULL;
    f.occlusion = variant;
    lmb_surface_clear(&f.out);
    return hash_frame(GOLDEN_START, &f);
}

/* --- exceeded capacities: the status, and partial results --------------------------------------------------------- */

/* A map's first points of 4x4 or 1x1 texels, with too little room: the points so far are kept. */
static uint64_t case_full_points(int variant)
{
    static const lmb_grouping how = {LMB_GROUP_ZONES, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const lmb_scene *scene = demo_scene();
    lmb_shadow_map map;
    lmb_points few = points;
    lmb_shadow_map_init(&map, &scene->lights[0], scene, MAP, LMB_ID16, memory.map, sizeof memory.map);
    way->draw_map(&map, golden_kernels, scene);
    few.count = few.faces = 0;
    few.cap = variant == 0 ? 100 : POINTS;
    few.cell_cap = variant == 0 ? few.cell_cap : MAP / 4 * (MAP / 4);
    lmb_status status =
        lmb_points_collect(&few, golden_kernels, &memory.scratch.tile, scene, &scene->lights[0], &map, 0, 0, MAP / 8,
                           &how);
    points.count = few.count;
    return hash_points(golden_hash_u32(GOLDEN_START, (uint32_t)status));
}

/* A frame with more points, maps or lights than there is room for. */
static uint64_t case_full_frame(int variant)
{
    lmb_frame f = demo_frame();
    lmb_light two[2];
    lmb_scene lit = *f.scene;
    lmb_surface_clear(&f.out);
    two[0] = two[1] = lit.lights[0];
    two[1].intensity[1] *= 0.5f;
    lit.lights = two;
    f.scene = &lit;
    f.shadow_map = MAP / 2;
    if (variant == 0) {
        f.points.cap = 100;
        f.shadow_map = MAP;
    } else if (variant == 1) {
        f.map_bytes -= MAP * MAP * 4;
        f.shadow_map = MAP;
    } else {
        lit.light_count = 2; /* the small configuration takes only one */
    }
    return hash_frame(GOLDEN_START, &f);
}

/* As many groups as this configuration has, for discs that need more: zones, greedy, and one a disc. */
static uint64_t case_full_groups(int variant)
{
    lmb_grouping how = {LMB_GROUP_ZONES, 4, LMB_MAX_GROUPS, 0, 0.05f, 0.3f, 0.999f, 0, 0, 0, 0, 0};
    const lmb_scene *scene = demo_scene();
    lmb_shadow_map map;
    lmb_stats stats;
    how.method = variant;
    lmb_shadow_map_init(&map, &scene->lights[0], scene, MAP, LMB_ID16, memory.map, sizeof memory.map);
    way->draw_map(&map, golden_kernels, scene);
    points.count = points.faces = 0;
    lmb_points_collect(&points, golden_kernels, &memory.scratch.tile, scene, &scene->lights[0], &map, 0, 0, MAP / 8,
                       &how);
    lmb_discs_join(&points, &map, &how);
    memset(&stats, 0, sizeof stats);
    memory.groups.count = 0;
    lmb_status status = lmb_group_points(&memory.groups, &points, &how, &stats);
    uint64_t h = golden_hash_u32(golden_hash_u32(GOLDEN_START, (uint32_t)status), points.count);
    return hash_groups(golden_hash_u32(h, stats.regroups));
}

/* --- ways --------------------------------------------------------------------------------------------------------- */

static lmb_status draw_whole(const lmb_target *target, const lmb_kernels *k, const lmb_view *view,
                             const lmb_scene *scene, uint32_t flags, lmb_stats *stats)
{
    return lmb_draw(target, k, view, scene, 1, UINT32_MAX - 1, flags, stats);
}

static lmb_status draw_map_whole(const lmb_shadow_map *map, const lmb_kernels *k, const lmb_scene *scene)
{
    lmb_shadow_map_clear(map);
    return lmb_shadow_map_draw(map, k, scene, 1, UINT32_MAX - 1, NULL);
}

static lmb_status again_whole(lmb_render *r, const lmb_frame *frame)
{
    lmb_status status = lmb_render_again(r, frame);
    while (status == LMB_OK && r->stage < LMB_STAGE_DONE) {
        status = lmb_render_step(r, 64);
        status = status == LMB_MORE ? LMB_OK : status;
    }
    return status;
}

const golden_way golden_whole = {draw_whole, draw_map_whole, lmb_render_frame, again_whole, -1, 0};

/* --- the table ---------------------------------------------------------------------------------------------------- */

static const struct golden {
    const char *name;
    uint64_t (*run)(int variant);
    int variant;
    uint64_t hash;
} cases[] = {
#include "golden_table.inc"
#if LMB_MAX_GROUPS == 2048 && LMB_MAX_LIGHTS == 128 && LMB_MAX_CUT == 65536
#define CAPACITY_CASE(name, run, variant, here, tiny) {name, run, variant, here},
#include "golden_capacity.inc"
#elif LMB_MAX_GROUPS == 96 && LMB_MAX_LIGHTS == 1 && LMB_MAX_CUT == 64
#define CAPACITY_CASE(name, run, variant, large, here) {name, run, variant, here},
#include "golden_capacity.inc"
#endif
};

static void write_hex(char *out, uint64_t v)
{
    for (int i = 0; i < 16; ++i) {
        out[i] = "0123456789abcdef"[(v >> (60 - 4 * i)) & 15u];
    }
    out[16] = '\0';
}

static size_t append(char *line, size_t at, const char *text)
{
    while (*text != '\0') {
        line[at++] = *text++;
    }
    line[at] = '\0';
    return at;
}

static int32_t backend_count(void)
{
    int32_t n = 0;
    while (lmb_kernels_at(n) != NULL) {
        ++n;
    }
    return n;
}

/* `name hash`; if a backend's hash is wrong, also that hash, WRONG and the backends. */
static int run_case(char line[160], int32_t number)
{
    const struct golden *c = &cases[number];
    char wrong[64];
    size_t n = append(line, 0, c->name), w = append(wrong, 0, "");
    uint64_t shown = c->hash;
    const int32_t count = backend_count();
    for (int32_t i = 0; i < count; ++i) {
        if (way->backend >= 0 && (way->backend + number) % count != i) {
            continue;
        }
        golden_kernels = lmb_kernels_at(i);
        uint64_t hash = c->run(c->variant);
        if (hash != c->hash) {
            shown = hash;
            w = append(wrong, append(wrong, w, " "), lmb_kernels_name(golden_kernels));
        }
    }
    n = append(line, n, " ");
    write_hex(line + n, shown);
    if (w > 0) {
        append(line, append(line, n + 16, " WRONG"), wrong);
    }
    return w > 0;
}

/* GOLDEN_EACH: runs every n-th case, for slow builds and emulators; GOLDEN_FROM: number of the first case. */
#ifndef GOLDEN_EACH
#define GOLDEN_EACH 1
#endif
#ifndef GOLDEN_FROM
#define GOLDEN_FROM 0
#endif
const char *golden_only;

/* Compares without strcmp, because ports without a libc lack it. */
static int is_wanted(const char *name)
{
    const char *only = golden_only;
    while (only != NULL && *only != 0 && *only == *name) {
        ++only;
        ++name;
    }
    return golden_only == NULL || *only == *name;
}

int golden_run(const golden_way *how, void (*put)(const char *line))
{
    int wrong = 0;
    way = how;
    for (int32_t i = GOLDEN_FROM; i < (int32_t)(sizeof cases / sizeof *cases); i += GOLDEN_EACH) {
        char line[160];
        if (!is_wanted(cases[i].name) || (how->third > 0 && i % 3 != how->third - 1)) {
            continue;
        }
        wrong += run_case(line, i);
        put(line);
    }
    return wrong;
}
