/* test_vertex_light.c: lambent/fixed.h blobs made from scenes: a room with walls that are two-sided slabs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/pack/vertex_light.h"
#include "../test.h"

void test_vertex_light(void);

enum { SLABS = 6 };

static float corner[SLABS][8][3];
static lmb_mesh mesh[SLABS];
static lmb_instance instance[SLABS];
static lmb_material material;
static lmb_scene scene;

static void put_slab(int which, const float low[3], const float high[3])
{
    static const uint16_t sides[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 3; ++k) {
            corner[which][i][k] = i >> k & 1 ? high[k] : low[k];
        }
    }
    mesh[which].positions = corner[which][0];
    mesh[which].vertex_count = 8;
    mesh[which].triangle_count = 12;
    mesh[which].indices = sides;
    mesh[which].index_format = LMB_INDEX_U16;
    for (int i = 0; i < 4; ++i) {
        instance[which].to_world.m[5 * i] = 1.0f;
    }
    instance[which].mesh = (uint32_t)which;
    instance[which].first_id = (uint32_t)(1 + 12 * which);
}

/* 4 m wide and deep and 2.4 m high inside, made of slabs 0.3 m thick. */
static void make_room(void)
{
    static const float inside[3] = {4.0f, 2.4f, 4.0f}, thick = 0.3f;
    for (int i = 0; i < SLABS; ++i) {
        float low[3] = {-thick, -thick, -thick}, high[3];
        const int axis = i / 2;
        for (int k = 0; k < 3; ++k) {
            high[k] = inside[k] + thick;
        }
        low[axis] = i % 2 ? inside[axis] : -thick;
        high[axis] = low[axis] + thick;
        put_slab(i, low, high);
    }
    material.texture = -1;
    material.albedo[0] = material.albedo[1] = material.albedo[2] = 0.5f;
    material.alpha = 1.0f;
    material.flags = LMB_DOUBLE_SIDED;
    memset(&scene, 0, sizeof scene);
    scene.meshes = mesh;
    scene.materials = &material;
    scene.instances = instance;
    scene.mesh_count = scene.instance_count = SLABS;
    scene.material_count = 1;
    lmb_scene_bounds(&scene.bounds_min, &scene.bounds_max, &scene);
}

/* Smallest and largest share that elements of the floor receive of a lamp's unobstructed light. */
static void light_floor(double part[2], const lmb_fixed *blob)
{
    lmb_fixed_frame f;
    void *memory = malloc(lmb_fixed_memory(blob, blob->triangles));
    const double per = ldexp(1.0, blob->units_log2), lamp[3] = {2.1, 2.3, 1.9};
    memset(&f, 0, sizeof f);
    CHECK(memory != NULL &&
          lmb_fixed_lay(&f, blob, blob->triangles, memory, lmb_fixed_memory(blob, blob->triangles)) == LMB_OK);
    for (int k = 0; k < 3; ++k) {
        f.lamp.position[k] = (int32_t)(per * lamp[k]) - blob->origin[k];
        f.lamp.intensity[k] = LMB_FIXED_WHITE;
    }
    f.bounces = 1;
    CHECK(lmb_fixed_light(&f) == LMB_OK);
    part[0] = 1e30, part[1] = 0.0;
    for (uint32_t e = 0; e < blob->elements; ++e) {
        const uint32_t *word = blob->receiver + 3 * (blob->vertices + e);
        double at[3], far2 = 0.0;
        const int32_t own[3] = {(int16_t)(word[0] & 0xffffu), (int16_t)(word[0] >> 16), (int16_t)(word[1] & 0xffffu)};
        for (int k = 0; k < 3; ++k) {
            at[k] = (own[k] + blob->origin[k]) / per;
            far2 += (lamp[k] - at[k]) * (lamp[k] - at[k]);
        }
        if (at[1] > -0.01 && at[1] < 0.01 && (word[1] >> 24) == 127u) {
            const double free = 65536.0 * lamp[1] / (far2 * sqrt(far2)), own_part = f.direct[e][0] / free;
            part[0] = own_part < part[0] ? own_part : part[0];
            part[1] = own_part > part[1] ? own_part : part[1];
        }
    }
    free(memory);
}

static void test_slabs(void)
{
    static const vertex_light_options asked = {300, 48, 8, 256};
    report r = {""};
    vertex_light_facts facts;
    lmb_fixed blob;
    uint32_t *words, count;
    double part[2] = {0.0, 0.0};
    make_room();
    CHECK_MSG(vertex_light_make(&words, &count, &facts, &scene, &asked, &r), "%s", r.text);
    /* the inside of a wall does not belong to the room, nor do the outer sides */
    CHECK_MSG(facts.hidden >= SLABS * 12, "%u", (unsigned)facts.hidden);
    CHECK_MSG(facts.valid < facts.places && 4 * facts.valid > facts.places, "%u of %u", (unsigned)facts.valid,
              (unsigned)facts.places);
    CHECK(words != NULL && lmb_fixed_open(&blob, words, 4 * (size_t)count) == LMB_OK);
    light_floor(part, &blob);
    CHECK_MSG(part[0] > 0.97 && part[1] < 1.03, "%g .. %g", part[0], part[1]);
    free(words);
}

void test_vertex_light(void) { test_slabs(); }
