/* test_pack.c: packed scenes: a handmade file, damage to it, motion, texture formats; the result of `lambent pack` for
 * a model, and the options of the verb. */
#include "../folder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vertex.h"
#include "../../src/raster/texture.h"
#include "../../tools/common/checksum.h"
#include "../../tools/demo/demo_scene.h"
#include "../../tools/model/model_motion.h"
#include "../../tools/pack/pack.h"
#include "../../tools/pack/verb_pack.h"
#include "../model_case.h"
#include "../small_pack.h"

void test_pack(void);

enum { WIDE = 40, HIGH = 32 };

static uint32_t words[SMALL_PACK_WORDS];
static void *memory[512]; /* of the scene */
static lmb_pack opened;
static lmb_scene scene;

static size_t make_small(void)
{
    const size_t bytes = small_pack(words);
    CHECK(bytes <= sizeof words && lmb_pack_open(&opened, words, bytes) == LMB_OK);
    CHECK(lmb_pack_bytes(&opened) > 0 && lmb_pack_bytes(&opened) <= sizeof memory);
    CHECK(lmb_pack_scene(&scene, &opened, memory, sizeof memory) == LMB_OK);
    return bytes;
}

/* The hash of a picture, or 0 if it could not be drawn. */
static uint64_t draw(const lmb_scene *s, const lmb_view *view)
{
    static lmb_frame frame;
    static lmb_render render;
    lmb_frame_settings set;
    uint64_t hash = 0;
    memset(&set, 0, sizeof set);
    set.kernels = picked_kernels();
    set.scene = s;
    set.view = *view;
    set.show = LMB_SHOW_DIRECT;
    set.shadow_map = 64;
    const size_t bytes = lmb_frame_bytes(&set);
    void *room = malloc(bytes + 1);
    if (room != NULL && lmb_frame_init(&frame, &set, room, bytes) == LMB_OK &&
        lmb_render_frame(&render, &frame) == LMB_OK) {
        hash = lmb_surface_hash(&frame.out);
    }
    free(room);
    return hash;
}

static uint32_t word_of(float v)
{
    uint32_t w;
    memcpy(&w, &v, sizeof w);
    return w;
}

/* Word 13 of a light. Files from older tools have 0 there. */
static void test_range(void)
{
    make_small();
    CHECK(scene.lights[0].range == 0.0f);
    uint32_t *w = words + (opened.part[LMB_PACK_LIGHTS] - words) + 13;
    const size_t bytes = words[2];
    *w = word_of(2.5f);
    CHECK(lmb_pack_open(&opened, words, bytes) == LMB_OK);
    CHECK(lmb_pack_scene(&scene, &opened, memory, sizeof memory) == LMB_OK && scene.lights[0].range == 2.5f);
    *w = word_of(-1.0f);
    CHECK(lmb_pack_open(&opened, words, bytes) == LMB_ERR_FORMAT);
    *w = 0x7fc00000u;
    CHECK(lmb_pack_open(&opened, words, bytes) == LMB_ERR_FORMAT);
}

/* --- the library -------------------------------------------------------------------------------------------------- */

static void test_in_place(void)
{
    lmb_view view;
    size_t n;
    const size_t bytes = make_small();
    CHECK(scene.mesh_count == 1 && scene.instance_count == 2 && scene.light_count == 1 && scene.texture_count == 2);
    CHECK(scene.instances[0].first_id == 1 && scene.instances[1].first_id == 3);
    CHECK((const uint8_t *)scene.meshes->positions > (const uint8_t *)words &&
          (const uint8_t *)scene.meshes->positions < (const uint8_t *)words + bytes);
    const lmb_vec3 p = mesh_position(scene.meshes, 1);
    CHECK(p.x == 1.0f && p.y == 0.0f && p.z == -1.0f);
    CHECK(lmb_pack_part(&opened, LMB_PACK_INDICES, &n) == scene.meshes->indices && n == 12);
    CHECK(lmb_pack_part(&opened, LMB_PACK_TRANSFER, &n) == NULL && n == 0);
    CHECK(lmb_pack_part(&opened, LMB_PACK_KINDS, NULL) == NULL && lmb_pack_part(&opened, 0, NULL) == NULL);
    CHECK(lmb_pack_view(&view, &opened, &scene, 0, 0.0f, WIDE, HIGH) == LMB_OK);
    CHECK(view.near_m == 0.1f && view.half_height == 0.4f && fabsf(view.half_width - 0.5f) < 1e-6f);
    CHECK(lmb_pack_view(&view, &opened, &scene, 1, 0.0f, WIDE, HIGH) == LMB_ERR_ARG);
    CHECK(lmb_pack_scene(&scene, &opened, memory, lmb_pack_bytes(&opened) - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_pack_scene(&scene, &opened, (uint8_t *)memory + 4, sizeof memory - 4) == LMB_ERR_ALIGN);
    CHECK(draw(&scene, &view) != 0);
}

static lmb_status open_with(uint32_t at, uint32_t word, size_t bytes)
{
    lmb_pack p;
    const uint32_t was = words[at];
    words[at] = word;
    const lmb_status status = lmb_pack_open(&p, words, bytes);
    words[at] = was;
    return status;
}

/* The index of a word in a part of the open file. */
static uint32_t at_part(int kind, uint32_t word) { return (uint32_t)(opened.part[kind] - words) + word; }

static void test_refused(void)
{
    lmb_pack p;
    const size_t bytes = make_small();
    CHECK(lmb_pack_open(&p, words, bytes - 4) == LMB_ERR_FORMAT && p.data == NULL);
    CHECK(lmb_pack_open(&p, words, bytes + 64) == LMB_OK); /* a partition of flash */
    CHECK(lmb_pack_open(&p, (const uint8_t *)words + 2, bytes) == LMB_ERR_ALIGN);
    CHECK(open_with(1, 0x04030201u, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(4, 1, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(LMB_PACK_HEADER_WORDS, LMB_PACK_MESHES, bytes) == LMB_ERR_FORMAT); /* twice, and no SCENE */
    CHECK(open_with(LMB_PACK_HEADER_WORDS + 4 * 10, 9999, bytes) == LMB_OK); /* an unknown kind is skipped, ... */
    CHECK(open_with(LMB_PACK_HEADER_WORDS + 4 * 11, 9999, bytes) == LMB_ERR_FORMAT); /* ... but nodes need tracks */
    CHECK(open_with(at_part(LMB_PACK_INDICES, 1), 0x00040004u, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_MESHES, 0), 3, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_MESHES, 1), 0x00ffffffu, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_MESHES, 2), words[at_part(LMB_PACK_MESHES, 2)] | 1u << 24, bytes) == LMB_OK);
    CHECK(open_with(at_part(LMB_PACK_MESHES, 2), words[at_part(LMB_PACK_MESHES, 2)] | 2u << 24, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_MESHES, 3), (uint32_t)bytes - 8, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_TEXTURES, 1), 200 | 200 << 16, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_TEXTURES, 2), 3 | 3 << 8, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_MATERIALS, 5), 2, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_MATERIALS, 0), 0xff800000u, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_INSTANCES, 12), 1, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_INSTANCES, 13), 2, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_INSTANCES, 14), 3, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_LIGHTS, 11), 7, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_CAMERAS, 14), 0, bytes) == LMB_ERR_FORMAT);
    CHECK(open_with(at_part(LMB_PACK_NODES, 16), 1, bytes) == LMB_ERR_FORMAT); /* a node that is its parent */
    CHECK(open_with(at_part(LMB_PACK_NODES, 2), 2, bytes) == LMB_OK);
    CHECK(open_with(at_part(LMB_PACK_NODES, 2), 3, bytes) == LMB_ERR_FORMAT); /* two translations */
    CHECK(open_with(at_part(LMB_PACK_KEYS, 1), 0, bytes) == LMB_ERR_FORMAT);  /* times that do not increase */
    CHECK(open_with(at_part(LMB_PACK_TRACKS, 1), 200, bytes) == LMB_ERR_FORMAT);
}

/* The mesh with 32-bit indices at the file's end is the same; each index is checked. */
static void test_wide_indices(void)
{
    static const uint32_t indices[6] = {0, 1, 2, 2, 1, 3};
    const size_t bytes = make_small(), wide = bytes + sizeof indices;
    lmb_pack p;
    lmb_view view;
    CHECK(wide <= sizeof words && lmb_pack_view(&view, &opened, &scene, 0, 0.0f, WIDE, HIGH) == LMB_OK);
    const uint64_t was = draw(&scene, &view);
    words[2] = (uint32_t)wide;
    words[at_part(LMB_PACK_MESHES, 2)] ^= (uint32_t)(LMB_INDEX_U16 ^ LMB_INDEX_U32) << 16;
    words[at_part(LMB_PACK_MESHES, 8)] = (uint32_t)bytes;
    memcpy((uint8_t *)words + bytes, indices, sizeof indices);
    CHECK(lmb_pack_open(&p, words, wide) == LMB_OK);
    CHECK(lmb_pack_scene(&scene, &p, memory, sizeof memory) == LMB_OK);
    CHECK(scene.meshes[0].index_format == LMB_INDEX_U32 && draw(&scene, &view) == was && was != 0);
    for (uint32_t i = 0; i < 6; ++i) {
        CHECK(open_with((uint32_t)bytes / 4 + i, 4, wide) == LMB_ERR_FORMAT);
    }
}

/* Parts that share a byte with another part or with the table. The moved part has an unknown kind, so the file is
 * otherwise valid. */
static void test_overlaps(void)
{
    const uint32_t bytes = (uint32_t)make_small(), parts = words[3], last = parts - 3; /* KEYS, after most of them */
    uint32_t *table = words + LMB_PACK_HEADER_WORDS, *own = table + LMB_PACK_PART_WORDS * last, refused = 0;
    lmb_pack p;
    own[0] = 9999;
    CHECK(open_with(0, words[0], bytes) == LMB_OK);
    const uint32_t at = own[1], size = own[2];
    for (uint32_t i = 0; i < parts; ++i) {
        const uint32_t *other = table + LMB_PACK_PART_WORDS * i;
        if (i != last) {
            own[2] = 4;
            own[1] = other[1] + other[2] - 4;
            refused += lmb_pack_open(&p, words, bytes) == LMB_ERR_FORMAT;
            own[1] = other[1];
            refused += lmb_pack_open(&p, words, bytes) == LMB_ERR_FORMAT;
            own[2] = 0;
            CHECK(lmb_pack_open(&p, words, bytes) == LMB_OK); /* an empty part overlaps nothing */
        }
    }
    CHECK_MSG(refused == 2 * (parts - 1), "%u of %u", (unsigned)refused, (unsigned)(2 * (parts - 1)));
    own[1] = at;
    own[2] = size + 4;
    CHECK(lmb_pack_open(&p, words, bytes) == LMB_ERR_FORMAT); /* into the following part */
    own[1] = at - 4;
    CHECK(lmb_pack_open(&p, words, bytes) == LMB_ERR_FORMAT);
    own[1] = 4 * LMB_PACK_HEADER_WORDS; /* the table */
    own[2] = 4;
    CHECK(lmb_pack_open(&p, words, bytes) == LMB_ERR_FORMAT);
    own[1] = 4 * (LMB_PACK_HEADER_WORDS + LMB_PACK_PART_WORDS * (parts - 1));
    CHECK(lmb_pack_open(&p, words, bytes) == LMB_ERR_FORMAT);
}

/* Replaces each word: any file that opens can be drawn. */
static void test_damaged(void)
{
    static const uint32_t odd[] = {0, 1, 0xffffffffu, 0x7fc00000u, 0x40000000u, 0x00010001u, 0x80000000u};
    const size_t bytes = make_small();
    uint32_t taken = 0;
    for (uint32_t at = 0; at < bytes / 4; ++at) {
        for (size_t k = 0; k < sizeof odd / sizeof *odd; ++k) {
            const uint32_t was = words[at];
            lmb_pack p;
            lmb_scene s;
            lmb_view v;
            words[at] = odd[k];
            const lmb_status status = lmb_pack_open(&p, words, bytes);
            CHECK(status == LMB_OK || status == LMB_ERR_FORMAT);
            if (status == LMB_OK && lmb_pack_bytes(&p) <= sizeof memory &&
                lmb_pack_scene(&s, &p, memory, sizeof memory) == LMB_OK) {
                ++taken;
                lmb_pack_pose(&s, &p, 0.5f);
                if (lmb_pack_view(&v, &p, &s, 0, 0.5f, 8, 8) == LMB_OK && (at + k) % 16 == 0) {
                    draw(&s, &v);
                }
            }
            words[at] = was;
        }
    }
    CHECK(taken > 100);
}

static int is_near(lmb_vec3 v, float x, float y, float z)
{
    return fabsf(v.x - x) < 1e-5f && fabsf(v.y - y) < 1e-5f && fabsf(v.z - z) < 1e-5f;
}

static lmb_vec3 column(const lmb_mat4 *m, int c) { return vec3(m->m[4 * c], m->m[4 * c + 1], m->m[4 * c + 2]); }

static void test_moves(void)
{
    make_small();
    CHECK(opened.seconds == 1.0f);
    CHECK(lmb_pack_pose(&scene, &opened, 0.0f) == LMB_OK && scene.revision == 0 && scene.instances[1].revision == 0);
    CHECK(lmb_pack_pose(&scene, &opened, 0.5f) == LMB_OK && scene.revision == 1 && scene.instances[1].revision == 1);
    CHECK(scene.instances[0].revision == 0);
    const lmb_mat4 *m = &scene.instances[1].to_world;
    CHECK(is_near(column(m, 0), 0.35355339f, 0, -0.35355339f) && is_near(column(m, 3), 0, 1, 0)); /* by 45 degrees */
    CHECK(is_near(scene.lights[0].position, 0.5f, 1.8f, 0.5f) && scene.lights[0].revision == 1);
    CHECK(fabsf(scene.bounds_max.y - 1.0f) < 1e-5f);
    CHECK(lmb_pack_pose(&scene, &opened, 0.25f) == LMB_OK);
    CHECK(is_near(scene.lights[0].position, 0.25f, 1.8f, 0.5f)); /* the cubic has tangents of 1 */
    CHECK(lmb_pack_pose(&scene, &opened, 2.0f) == LMB_OK);
    CHECK(is_near(column(m, 0), 0, 0, -0.5f) && is_near(column(m, 3), 0, 1.5f, 0));
    CHECK(lmb_pack_pose(&scene, &opened, -1.0f) == LMB_OK && is_near(column(m, 0), 0.5f, 0, 0));
    CHECK(lmb_pack_pose(&scene, &opened, NAN) == LMB_OK);
    CHECK(lmb_pack_pose(&scene, &opened, 0.5f) == LMB_OK);
    lmb_instance own = scene.instances[1]; /* copies: from the transforms of another time to those of the scene */
    lmb_light lamp = scene.lights[0];
    memset(&own.to_world, 0, sizeof own.to_world);
    memset(&lamp.position, 0, sizeof lamp.position);
    CHECK(lmb_pack_place_instance(&own, &opened, 1, 0.5f) == LMB_OK &&
          memcmp(&own, &scene.instances[1], sizeof own) == 0);
    CHECK(lmb_pack_place_light(&lamp, &opened, 0, 0.5f) == LMB_OK && memcmp(&lamp, &scene.lights[0], sizeof lamp) == 0);
    CHECK(lmb_pack_place_instance(&own, &opened, scene.instance_count, 0.5f) == LMB_ERR_ARG);
    CHECK(lmb_pack_place_light(&lamp, &opened, 1000, 0.5f) == LMB_ERR_ARG);
    CHECK(lmb_pack_place_light(NULL, &opened, 0, 0.5f) == LMB_ERR_ARG &&
          lmb_pack_place_instance(&own, NULL, 0, 0.5f) == LMB_ERR_ARG);
    scene.light_count = 0;
    CHECK(lmb_pack_pose(&scene, &opened, 0.0f) == LMB_ERR_ARG);
}

/* A sun and a camera on the panel's node, rotated by 45 degrees about Y, with a scale of 0 in the node or in a matrix
 * above it. */
static void test_no_scale(void)
{
    static const float nothing[12] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0};
    const size_t bytes = make_small();
    lmb_view view;
    words[at_part(LMB_PACK_LIGHTS, 11)] = LMB_LIGHT_DIRECTIONAL;
    words[at_part(LMB_PACK_LIGHTS, 12)] = words[at_part(LMB_PACK_CAMERAS, 19)] = 1;
    for (int k = 0; k < 2; ++k) {
        memset(&words[at_part(LMB_PACK_NODES, 16 * (k == 0) + 11)], 0, 3 * sizeof *words);
        if (k == 1) { /* the node above: a matrix of zeros, 1 m up */
            words[at_part(LMB_PACK_NODES, 2)] = 0;
            words[at_part(LMB_PACK_NODES, 3)] = 1;
            memcpy(&words[at_part(LMB_PACK_NODES, 4)], nothing, sizeof nothing);
        }
        CHECK(lmb_pack_open(&opened, words, bytes) == LMB_OK &&
              lmb_pack_scene(&scene, &opened, memory, sizeof memory) == LMB_OK);
        CHECK(lmb_pack_pose(&scene, &opened, 0.5f) == LMB_OK);
        CHECK(is_near(scene.lights[0].direction, -0.70710678f, 0, -0.70710678f));
        CHECK(is_near(scene.lights[0].position, 0, 1, 0));
        CHECK(lmb_pack_view(&view, &opened, &scene, 0, 0.5f, WIDE, HIGH) == LMB_OK);
        CHECK(is_near(view.back, 0.70710678f, 0, 0.70710678f) && is_near(view.up, 0, 1, 0));
    }
}

/* Under a matrix that flattens space, a node rotated by 45 degrees has no Z axis, and without scale neither. A sun and
 * a camera there have no direction. A point light needs none. */
static void test_no_direction(void)
{
    static const float flat[12] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, 1.5f, 0};
    const size_t bytes = make_small();
    lmb_view view;
    words[at_part(LMB_PACK_LIGHTS, 12)] = words[at_part(LMB_PACK_CAMERAS, 19)] = 1;
    words[at_part(LMB_PACK_NODES, 2)] = 0;
    words[at_part(LMB_PACK_NODES, 3)] = 1;
    memcpy(&words[at_part(LMB_PACK_NODES, 4)], flat, sizeof flat);
    for (int kind = 0; kind < 2; ++kind) {
        words[at_part(LMB_PACK_LIGHTS, 11)] = kind == 0 ? LMB_LIGHT_POINT : LMB_LIGHT_DIRECTIONAL;
        CHECK(lmb_pack_open(&opened, words, bytes) == LMB_OK &&
              lmb_pack_scene(&scene, &opened, memory, sizeof memory) == LMB_OK);
        lmb_light lamp = scene.lights[0];
        CHECK(lmb_pack_place_light(&lamp, &opened, 0, 0.0f) == LMB_OK); /* not rotated yet */
        CHECK(lmb_pack_place_light(&lamp, &opened, 0, 0.5f) == (kind == 0 ? LMB_OK : LMB_ERR_SCENE));
        CHECK(is_near(lamp.position, 0, 2.0f, 0));
    }
    CHECK(lmb_pack_view(&view, &opened, &scene, 0, 0.0f, WIDE, HIGH) == LMB_OK);
    CHECK(lmb_pack_view(&view, &opened, &scene, 0, 0.5f, WIDE, HIGH) == LMB_ERR_SCENE);
}

/* Spans of two seconds: tangents of cubic keys are per second. Rotations have constant speed and take the shorter way,
 * even if the quaternions of the keys have opposite signs. */
static void test_spans(void)
{
    const float pi_8 = 0.39269908f;
    make_small();
    uint32_t *key = words + (opened.part[LMB_PACK_KEYS] - words);
    const lmb_mat4 *m = &scene.instances[1].to_world;
    key[1] = float_bits(2.0f);
    for (int sign = 0; sign < 2; ++sign) {
        CHECK(lmb_pack_pose(&scene, &opened, 0.5f) == LMB_OK);
        /* h = u^2 (3 - 2 u) + 2 s u (1 - u) (1 - u - u) / 2 at u = 1/4, with both tangents 1 per second */
        CHECK_MSG(is_near(scene.lights[0].position, 0.34375f, 1.8f, 0.5f), "%g", (double)scene.lights[0].position.x);
        CHECK_MSG(is_near(column(m, 0), 0.5f * cosf(pi_8), 0, -0.5f * sinf(pi_8)), "%g %g", (double)m->m[0],
                  (double)m->m[2]);
        CHECK(is_near(column(m, 3), 0, 0.75f, 0));
        CHECK(lmb_pack_pose(&scene, &opened, 1.75f) == LMB_OK);
        CHECK(is_near(column(m, 0), 0.5f * cosf(3.5f * pi_8), 0, -0.5f * sinf(3.5f * pi_8)));
        for (int i = 12; i < 16; ++i) { /* the second rotation with its sign flipped */
            key[i] ^= 0x80000000u;
        }
    }
    key[22] = float_bits(2.0f); /* leaves the first key twice as fast and rests at the second */
    key[25] = 0;
    lmb_pack_pose(&scene, &opened, 0.5f);
    CHECK_MSG(fabsf(scene.lights[0].position.x - (0.15625f + 0.1875f * 2.0f * 0.75f * 2.0f)) < 1e-5f, "%g",
              (double)scene.lights[0].position.x);
}

/* --- textures ----------------------------------------------------------------------------------------------------- */

/* The small file's textures, and the same textures as RGBA8. */
static void test_formats(void)
{
    uint8_t rgba[2][4 * (16 + 4 + 1)];
    lmb_texture same;
    make_small();
    for (uint32_t i = 0; i < 21; ++i) { /* as in small_pack */
        static const uint8_t index[21] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 3, 5, 9, 11, 7};
        memcpy(rgba[0] + 4 * i, scene.textures[0].texels + 4 * index[i], 4);
    }
    static const uint8_t four[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 132, 130, 132, 255};
    memcpy(rgba[1], four, sizeof four);
    for (int i = 0; i < 2; ++i) {
        same = scene.textures[i];
        same.texels = rgba[i];
        same.format = LMB_TEXELS_RGBA8;
        for (int k = 0; k < 200; ++k) {
            float a[4], b[4];
            const float u = (float)k * 0.037f, v = (float)k * 0.051f, lod = (float)(k % 5) * 0.6f;
            lmb_texture_sample(a, &scene.textures[i], u, v, lod);
            lmb_texture_sample(b, &same, u, v, lod);
            CHECK(memcmp(a, b, sizeof a) == 0);
        }
    }
    CHECK(lmb_texture_format_bytes(LMB_TEXELS_RGBA8, 5, 3, 2) == 4 * (15 + 2));
    CHECK(lmb_texture_format_bytes(LMB_TEXELS_RGB565, 5, 3, 2) == 2 * (15 + 2));
    CHECK(lmb_texture_format_bytes(LMB_TEXELS_PALETTE4, 5, 3, 2) == 64 + 8 + 1);
    CHECK(lmb_texture_format_bytes(3, 5, 3, 2) == 0 && lmb_texture_format_bytes(LMB_TEXELS_PALETTE4, 5, 3, 9) == 0);
}

/* A texture far away shows the smallest level. The palette has the colour of this level, even if the colours of the large
 * levels would fill the palette. */
static void test_palette_from_afar(void)
{
    enum { WIDE_T = 97, HIGH_T = 41, MOST = 4 * WIDE_T * HIGH_T * 2 };
    static uint8_t rgba[MOST];
    for (int kind = 0; kind < 3; ++kind) { /* bright stripes at two edges; those over a gradient; two colours */
        pack_buffer out = {NULL, 0, 0, 0};
        lmb_texture t;
        memset(&t, 0, sizeof t);
        memset(rgba, 0, sizeof rgba);
        t.width = WIDE_T;
        t.height = HIGH_T;
        t.levels = lmb_texture_level_count(WIDE_T, HIGH_T);
        t.texels = rgba;
        for (int i = 0; i < WIDE_T * HIGH_T; ++i) {
            const int x = i % WIDE_T, y = i / WIDE_T;
            const uint8_t dark = (uint8_t)(kind == 1 ? x / 3 : 10);
            const uint8_t code[4] = {x >= 64 ? 255 : dark, kind < 2 && y >= 28 ? 255 : dark, 40, 255};
            memcpy(rgba + 4 * i, code, sizeof code);
        }
        CHECK(lmb_texture_mips(rgba, t.width, t.height, t.levels) == LMB_OK);
        const double off = pack_encode(&out, &t, LMB_TEXELS_PALETTE4, 0);
        const size_t bytes = lmb_texture_format_bytes(LMB_TEXELS_PALETTE4, t.width, t.height, t.levels);
        const uint8_t *mean = rgba + lmb_texture_bytes(t.width, t.height, t.levels) - 4;
        CHECK_MSG(out.data != NULL && off >= 0.0 && off < 6.0, "case %d: %g", kind, off);
        for (int k = 0; out.data != NULL && k < 3; ++k) {
            const int shown = out.data[4 * (out.data[bytes - 1] & 15) + k];
            CHECK_MSG(abs(shown - mean[k]) <= 6, "case %d channel %d: %d for %d", kind, k, shown, mean[k]);
        }
        free(out.data);
    }
}

/* Each level of a strip counts as much as the first one, too; with weights of 4 a level the error was 63. */
static void test_palette_of_a_strip(void)
{
    enum { LONG_T = 4096 };
    static uint8_t rgba[8 * LONG_T];
    lmb_texture t;
    pack_buffer out = {NULL, 0, 0, 0};
    memset(&t, 0, sizeof t);
    t.texels = rgba;
    t.width = LONG_T;
    t.height = 1;
    t.levels = lmb_texture_level_count(LONG_T, 1);
    for (int i = 0; i < LONG_T; ++i) {
        const uint8_t code[4] = {(uint8_t)(i / 16), (uint8_t)(i * 7), (uint8_t)(i * 13), 255};
        memcpy(rgba + 4 * i, code, 4);
    }
    CHECK(lmb_texture_mips(rgba, t.width, t.height, t.levels) == LMB_OK);
    const double error = pack_encode(&out, &t, LMB_TEXELS_PALETTE4, 0);
    CHECK(error > 0.0 && error < 45.0);
    free(out.data);
}

/* A picture with packed formats equals that with the decoded RGBA8 codes: through kernels, levels and holes. */
static void test_formats_drawn(void)
{
    enum { SIDE = 32, LEVELS = 6, TEXELS = 1365 };
    static uint8_t rgba[4 * TEXELS], coded[4 * TEXELS];
    lmb_texture texture[2];
    lmb_material material[2];
    lmb_view view;
    make_small();
    CHECK(lmb_pack_view(&view, &opened, &scene, 0, 0.0f, WIDE, HIGH) == LMB_OK);
    memset(texture, 0, sizeof texture);
    memcpy(material, scene.materials, sizeof material);
    texture[0].width = texture[0].height = SIDE;
    scene.textures = texture;
    scene.materials = material;
    for (int k = 0; k < 18; ++k) {
        test_rng rng = {77u + (uint64_t)k};
        const int is_palette = k % 2;
        texture[0].levels = k % 3 == 0 ? 1 : LEVELS;
        texture[0].filter = (uint8_t)(k % 3 == 0 ? k / 3 % 2 : k % 3);
        material[0].flags = LMB_DOUBLE_SIDED | (k > 8 && is_palette ? LMB_ALPHA_MASK : 0);
        for (size_t i = 0; i < 64 + TEXELS * 2; ++i) {
            coded[i] = (uint8_t)test_random(&rng);
        }
        const uint8_t *index = coded + 64;
        for (size_t level = 0, n = 0; level < LEVELS; ++level) {
            const size_t texels = (SIDE >> level) * (SIDE >> level);
            for (size_t i = 0; i < texels; ++i, ++n) {
                uint16_t v;
                memcpy(&v, coded + 2 * n, sizeof v);
                const uint32_t r = v >> 11, g = v >> 5 & 63u, b = v & 31u;
                const uint8_t *colour = coded + 4 * (index[i / 2] >> 4 * (i % 2) & 15);
                const uint8_t code[4] = {(uint8_t)(r << 3 | r >> 2), (uint8_t)(g << 2 | g >> 4),
                                         (uint8_t)(b << 3 | b >> 2), 255};
                memcpy(rgba + 4 * n, is_palette ? colour : code, 4);
            }
            index += (texels + 1) / 2;
        }
        texture[1] = texture[0];
        texture[0].texels = coded;
        texture[0].format = is_palette ? LMB_TEXELS_PALETTE4 : LMB_TEXELS_RGB565;
        texture[1].texels = rgba;
        texture[1].format = LMB_TEXELS_RGBA8;
        material[0].texture = 0;
        const uint64_t by_format = draw(&scene, &view);
        material[0].texture = 1;
        CHECK_MSG(by_format != 0 && by_format == draw(&scene, &view), "case %d", k);
    }
}

/* --- the result of `lambent pack` --------------------------------------------------------------------------------- */

/* Packs a model; `out` is then read from memory, as verbs read it. */
static int repack(pack *parts, const model *m, const pack_settings *set)
{
    file_bytes file = {NULL, 0};
    report r = {""};
    memset(parts, 0, sizeof *parts);
    int ok = pack_model(parts, m, set, &r) && pack_file(&file, parts, &r);
    CHECK_MSG(ok, "%s", r.text);
    forget();
    ok = ok && model_read(&loaded, "a.lmp", NULL, file.data, file.size, &notes, &problem);
    CHECK_MSG(ok, "%s", problem.text);
    file_free(&file);
    return ok;
}

static model demo_model(model_camera *camera)
{
    model m;
    const lmb_view v = demo_view(640, 480);
    memset(&m, 0, sizeof m);
    memset(camera, 0, sizeof *camera);
    m.scene = *demo_scene();
    m.cameras = camera;
    m.camera_count = 1;
    camera->eye = v.eye;
    camera->right = v.right;
    camera->up = v.up;
    camera->back = v.back;
    camera->yfov_rad = 0.872664626f;
    strcpy(camera->name, "eye");
    return m;
}

/* The picture is the same from the packed file through the library and from the model that verbs read, and, if nothing
 * is moved, from the source. */
static void test_demo(void)
{
    model_camera camera;
    const model m = demo_model(&camera);
    const pack_settings keeps = {0.0, 0.0, PACK_FILE, PACK_RGBA8}, usual = {2e-4, 3.0, PACK_LOCALITY, PACK_AUTO};
    pack parts;
    const lmb_view view = demo_view(WIDE, HIGH);
    lmb_view packed;
    const uint64_t source = draw(demo_scene(), &view);
    if (repack(&parts, &m, &keeps)) {
        CHECK(draw(&loaded.scene, &view) == source && parts.lost.position_m == 0.0);
        CHECK(loaded.camera_count == 1 && strcmp(loaded.cameras[0].name, "eye") == 0);
        CHECK(lmb_pack_view(&packed, loaded.pack, &loaded.scene, 0, 0.0f, WIDE, HIGH) == LMB_OK);
        CHECK(packed.half_height == view.half_height && packed.half_width == view.half_width);
    }
    pack_free(&parts);
    if (repack(&parts, &m, &usual)) {
        CHECK(parts.lost.position_m > 0.0 && parts.lost.position_m <= 2e-4 && parts.lost.uv_texels <= 0.0625);
        CHECK(parts.lost.fetched * 10 < parts.lost.fetched_before * 9);
        CHECK(parts.lost.texture > 0.0 && parts.lost.texture <= 3.0);
        CHECK(loaded.scene.meshes[0].position_format == LMB_POSITION_I16);
        CHECK(lmb_scene_triangles(&loaded.scene) == lmb_scene_triangles(demo_scene()));
    }
    pack_free(&parts);
    forget();
}

/* Two meshes that share an edge still share it: positions on one grid are exact. */
static void test_no_cracks(void)
{
    enum { POINTS = 60 };
    static float strip[2][3 * 2 * POINTS];
    static uint16_t index[6 * (POINTS - 1)];
    lmb_mesh mesh[2];
    lmb_instance instance[2];
    lmb_material material;
    model m;
    pack parts;
    test_rng rng = {5};
    memset(&m, 0, sizeof m);
    memset(mesh, 0, sizeof mesh);
    memset(instance, 0, sizeof instance);
    memset(&material, 0, sizeof material);
    material.texture = -1;
    for (int i = 0; i < POINTS; ++i) {
        float shared[3] = {(float)i * 0.3f, test_uniform(&rng, -0.1f, 0.1f), test_uniform(&rng, -0.1f, 0.1f)};
        for (int s = 0; s < 2; ++s) {
            memcpy(strip[s] + 6 * i, shared, sizeof shared);
            memcpy(strip[s] + 6 * i + 3, shared, sizeof shared);
            strip[s][6 * i + 5] += s == 0 ? -1.7f : 2.9f;
        }
    }
    for (uint32_t i = 0; i < POINTS - 1; ++i) {
        const uint16_t own[6] = {(uint16_t)(2 * i), (uint16_t)(2 * i + 1), (uint16_t)(2 * i + 2),
                                 (uint16_t)(2 * i + 2), (uint16_t)(2 * i + 1), (uint16_t)(2 * i + 3)};
        memcpy(index + 6 * i, own, sizeof own);
    }
    for (uint32_t s = 0; s < 2; ++s) {
        mesh[s].positions = strip[s];
        mesh[s].vertex_count = 2 * POINTS;
        mesh[s].indices = index;
        mesh[s].index_format = LMB_INDEX_U16;
        mesh[s].triangle_count = 2 * (POINTS - 1);
        instance[s].mesh = s;
        instance[s].first_id = 1 + s * mesh[0].triangle_count;
        for (int k = 0; k < 4; ++k) {
            instance[s].to_world.m[5 * k] = 1.0f;
        }
    }
    m.scene.meshes = mesh;
    m.scene.materials = &material;
    m.scene.instances = instance;
    m.scene.mesh_count = m.scene.instance_count = 2;
    m.scene.material_count = 1;
    const pack_settings usual = {1e-3, 3.0, PACK_LOCALITY, PACK_AUTO};
    if (repack(&parts, &m, &usual)) {
        int shared = 0;
        for (uint32_t a = 0; a < loaded.scene.meshes[0].vertex_count; ++a) {
            const lmb_vec3 p = mesh_position(&loaded.scene.meshes[0], a);
            for (uint32_t b = 0; b < loaded.scene.meshes[1].vertex_count; ++b) {
                const lmb_vec3 q = mesh_position(&loaded.scene.meshes[1], b);
                shared += p.x == q.x && p.y == q.y && p.z == q.z;
            }
        }
        CHECK_MSG(shared == POINTS, "%d of %d", shared, POINTS);
        CHECK(loaded.scene.meshes[0].position_format == LMB_POSITION_I16 && parts.lost.position_m < 1e-3);
    }
    pack_free(&parts);
    forget();
}

/* Reordering keeps the triangles and fetches fewer vertices. */
static void test_order(void)
{
    enum { SIDE = 24, TRIANGLES = 2 * SIDE * SIDE, VERTICES = (SIDE + 1) * (SIDE + 1) };
    static uint32_t index[3 * TRIANGLES], before[3 * TRIANGLES], scratch[VERTICES];
    static uint8_t found[TRIANGLES];
    test_rng rng = {9};
    for (uint32_t t = 0; t < TRIANGLES; ++t) {
        const uint32_t v = t / 2 / SIDE * (SIDE + 1) + t / 2 % SIDE;
        const uint32_t own[2][3] = {{v, v + 1, v + SIDE + 1}, {v + SIDE + 1, v + 1, v + SIDE + 2}};
        memcpy(index + 3 * t, own[t % 2], sizeof own[0]);
    }
    for (uint32_t t = TRIANGLES - 1; t > 0; --t) {
        const uint32_t with = test_random(&rng) % (t + 1);
        uint32_t hold[3];
        memcpy(hold, index + 3 * t, sizeof hold);
        memcpy(index + 3 * t, index + 3 * with, sizeof hold);
        memcpy(index + 3 * with, hold, sizeof hold);
    }
    memcpy(before, index, sizeof index);
    CHECK(pack_order(index, TRIANGLES, VERTICES));
    for (uint32_t t = 0; t < TRIANGLES; ++t) {
        for (uint32_t b = 0; b < TRIANGLES; ++b) {
            found[b] |= memcmp(index + 3 * t, before + 3 * b, 12) == 0;
        }
    }
    CHECK(memchr(found, 0, TRIANGLES) == NULL);
    const uint64_t shuffled = pack_fetched(before, TRIANGLES, scratch, VERTICES),
                   ordered = pack_fetched(index, TRIANGLES, scratch, VERTICES);
    CHECK_MSG(shuffled > 2 * TRIANGLES && ordered * 4 < TRIANGLES * 3, "%d, %d", (int)shuffled, (int)ordered);
    CHECK(pack_order(index, 0, 0));
}

/* Materials use one picture in several ways. It is packed once for each way, in a format that keeps the channels
 * used. */
static void test_shared_picture(void)
{
    enum { SIDE = 16, BYTES = 4 * SIDE * SIDE };
    static uint8_t rgba[BYTES];
    test_rng rng = {11};
    lmb_texture texture[4];
    lmb_material material[6];
    lmb_scene s;
    report r = {""};
    uint32_t slot[4];
    static pack out;
    memset(texture, 0, sizeof texture);
    memset(material, 0, sizeof material);
    memset(&s, 0, sizeof s);
    memset(&out, 0, sizeof out);
    for (size_t i = 0; i < BYTES; ++i) {
        rgba[i] = (uint8_t)test_random(&rng);
    }
    for (int i = 0; i < 4; ++i) {
        texture[i].texels = rgba;
        texture[i].width = texture[i].height = SIDE;
        texture[i].levels = 1;
        texture[i].wrap_s = (uint8_t)(i % 2);
        material[i].texture = i;
        material[i].flags = i % 2 ? LMB_ALPHA_MASK : 0;
    }
    s.textures = texture;
    s.materials = material;
    s.texture_count = 4;
    s.material_count = 4;
    const pack_settings small = {0.0, 3.0, PACK_FILE, PACK_RGB565};
    CHECK_MSG(pack_textures(&out, slot, &s, &small, &r), "%s", r.text);
    const uint32_t *record = (const uint32_t *)(const void *)out.part[LMB_PACK_TEXTURES].data;
    CHECK(out.part[LMB_PACK_TEXTURES].size == 4 * 4 * LMB_PACK_TEXTURE_WORDS);
    CHECK(out.part[LMB_PACK_TEXELS].size == BYTES / 2 + BYTES); /* once opaque, and once with alpha */
    for (int i = 0; i < 4; ++i) {
        const uint32_t *w = record + LMB_PACK_TEXTURE_WORDS * slot[i];
        CHECK((w[2] >> 8 & 255u) == (i % 2 ? LMB_TEXELS_RGBA8 : LMB_TEXELS_RGB565));
        CHECK(w[0] == record[LMB_PACK_TEXTURE_WORDS * slot[i % 2]] && (w[2] >> 16 & 255u) == (uint32_t)(i % 2));
    }
    pack_free(&out);
    memset(&out, 0, sizeof out);
    material[4] = material[0]; /* a texture for both kinds of material keeps alpha */
    material[4].flags = LMB_ALPHA_MASK;
    material[5] = material[1]; /* in either order */
    material[5].flags = 0;
    s.material_count = 6;
    CHECK(pack_textures(&out, slot, &s, &small, &r));
    CHECK(out.part[LMB_PACK_TEXELS].size == BYTES + BYTES / 2);
    record = (const uint32_t *)(const void *)out.part[LMB_PACK_TEXTURES].data;
    CHECK((record[LMB_PACK_TEXTURE_WORDS * slot[0] + 2] >> 8 & 255u) == LMB_TEXELS_RGBA8);
    CHECK((record[LMB_PACK_TEXTURE_WORDS * slot[1] + 2] >> 8 & 255u) == LMB_TEXELS_RGBA8);
    pack_free(&out);
}

/* Errors are as reported; sixteen colours are exact. */
static void test_encode(void)
{
    enum { SIDE = 8 };
    static uint8_t rgba[4 * 85];
    test_rng rng = {3};
    pack_buffer out = {NULL, 0, 0, 0};
    lmb_texture t, coded;
    memset(&t, 0, sizeof t);
    t.texels = rgba;
    t.width = t.height = SIDE;
    t.levels = 1;
    for (size_t i = 0; i < 4 * SIDE * SIDE; ++i) {
        rgba[i] = (uint8_t)(i % 4 == 3 ? 255 : test_random(&rng) % 256);
    }
    for (int format = LMB_TEXELS_RGB565; format <= LMB_TEXELS_PALETTE4; ++format) {
        double sum = 0.0;
        out.size = 0;
        const double error = pack_encode(&out, &t, format, 0);
        CHECK(out.size == (lmb_texture_format_bytes(format, SIDE, SIDE, 1) + 3) / 4 * 4);
        coded = t;
        coded.texels = out.data;
        coded.format = (uint8_t)format;
        for (int i = 0; i < SIDE * SIDE; ++i) {
            float v[4];
            lmb_normal_map_sample(v, &coded, ((float)(i % SIDE) + 0.5f) / SIDE, ((float)(i / SIDE) + 0.5f) / SIDE, 0.0f);
            for (int k = 0; k < 3; ++k) {
                const double off = ((double)v[k] + 1.0) * 127.5 - rgba[4 * i + k];
                sum += off * off;
            }
        }
        CHECK_MSG(fabs(sqrt(sum / (3.0 * SIDE * SIDE)) - error) < 1e-3, "%g", error);
        CHECK(format == LMB_TEXELS_RGB565 ? error < 2.5 : error < 60.0);
    }
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        memset(rgba + 4 * i, (int)(i % 16 * 3), 4);
    }
    out.size = 0;
    CHECK(pack_encode(&out, &t, LMB_TEXELS_PALETTE4, 1) == 0.0);
    free(out.data);
}

/* To the other byte order and back. */
static void test_swapped(void)
{
    static uint32_t other[SMALL_PACK_WORDS];
    const size_t bytes = make_small();
    file_bytes file = {(uint8_t *)other, bytes};
    pack parts;
    report r = {""};
    memcpy(other, words, sizeof other);
    lmb_pack own;
    CHECK(lmb_pack_open(&own, other, bytes) == LMB_OK);
    pack_swap(&file, &own);
    const uint8_t *p = file.data;
    CHECK(memcmp(p, words, 4) == 0 && p[4] == ((const uint8_t *)words)[7] && memcmp(p, words, bytes) != 0);
    forget();
    CHECK(!model_read(&loaded, "a.lmp", NULL, p, bytes, &notes, &problem));
    CHECK(strstr(problem.text, "-endian machines, unlike this one") != NULL);
    memset(&parts, 0, sizeof parts);
    CHECK_MSG(pack_take(&parts, &opened, "a.lmp", &r), "%s", r.text);
    file_bytes again = {NULL, 0};
    CHECK(pack_file(&again, &parts, &r) && lmb_pack_open(&own, again.data, again.size) == LMB_OK);
    CHECK(own.count[LMB_PACK_TRACKS] == 3 && own.seconds == 1.0f);
    file_free(&again);
    pack_free(&parts);
}

/* Damages any byte of a file with a checksum, in either byte order. */
static void test_checksum(void)
{
    static uint32_t file_words[SMALL_PACK_WORDS];
    const size_t bytes = make_small();
    file_bytes file = {(uint8_t *)file_words, bytes};
    memcpy(file_words, words, sizeof file_words);
    for (int order = 0; order < 2; ++order) {
        if (order == 1) {
            lmb_pack own;
            CHECK(lmb_pack_open(&own, file_words, bytes) == LMB_OK);
            pack_swap(&file, &own);
        }
        checksum_put(&file, LMB_PACK_HEADER_WORDS);
        CHECK(checksum_fits(file.data, bytes, LMB_PACK_HEADER_WORDS));
        for (size_t at = 12; at < bytes; ++at) {
            file.data[at] ^= 0x10;
            CHECK_MSG(!checksum_fits(file.data, bytes, LMB_PACK_HEADER_WORDS), "byte %d", (int)at);
            file.data[at] ^= 0x10;
        }
    }
    CHECK(checksum_fits((const uint8_t *)words, bytes, LMB_PACK_HEADER_WORDS)); /* it has none */
}

/* Runs the verb on a scene with --position-error `error`, or NULL for the default. The caller frees the file. */
static file_bytes packed_by_verb(folder *f, const char *from, const char *error)
{
    char in[FOLDER_PATH], out[FOLDER_PATH], value[40];
    char *argv[] = {"pack", in, "--quiet", "-o", out, "--position-error", value, NULL};
    file_bytes file = {NULL, 0};
    report r = {""};
    snprintf(in, sizeof in, "%s", from);
    snprintf(out, sizeof out, "%s", folder_file(f, "out.lmp"));
    snprintf(value, sizeof value, "%s", error != NULL ? error : "");
    CHECK(verb_pack(error != NULL ? 7 : 5, argv) == 0);
    CHECK_MSG(file_read(&file, out, &r), "%s", r.text);
    file_keep_end();
    return file;
}

/* By default a vertex of a scene that is long along any axis moves by at most a 32768th of the diagonal, for which 16
 * bits suffice. For half of that they do not. */
static void test_default_error(void)
{
    folder f;
    folder_open(&f);
    for (int axis = 0; axis < 3; ++axis) {
        float size[3] = {1.25f, 1.5f, 1.125f};
        char obj[200], error[40];
        size[axis] = 13.0f;
        snprintf(obj, sizeof obj, "v 0 0 0\nv %g %g 0\nv 0.25 0.5 %g\nf 1 2 3\n", (double)size[0], (double)size[1],
                 (double)size[2]);
        const char *from = folder_put(&f, "in.obj", obj, strlen(obj));
        const double diagonal = sqrt((double)(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]));
        file_bytes by_default = packed_by_verb(&f, from, NULL);
        for (int i = 1; i <= 2; ++i) {
            snprintf(error, sizeof error, "%.9g", diagonal / (32768.0 * i));
            file_bytes given = packed_by_verb(&f, from, error);
            const int same = given.size == by_default.size && memcmp(given.data, by_default.data, given.size) == 0;
            CHECK_MSG(same == (i == 1), "axis %d, %s m", axis, error);
            file_free(&given);
        }
        file_free(&by_default);
    }
    folder_close(&f);
}

void test_pack(void)
{
    test_default_error();
    test_checksum();
    test_in_place();
    test_range();
    test_refused();
    test_wide_indices();
    test_overlaps();
    test_damaged();
    test_moves();
    test_no_scale();
    test_no_direction();
    test_spans();
    test_formats();
    test_palette_from_afar();
    test_palette_of_a_strip();
    test_formats_drawn();
    test_demo();
    test_no_cracks();
    test_order();
    test_encode();
    test_shared_picture();
    test_swapped();
}
