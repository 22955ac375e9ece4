/* fuzz_pool_scene.c: the scenes that sequences of calls draw, and the files that they open. */
#include "fuzz_pool.h"

#if FUZZ_CALLS

#include <string.h>

#include "../small_relief.h"
#include "../small_pack.h"
#include "../small_transfer.h"

enum { LIGHTS = 3, TEXTURE = 4, RELIEF_SIDE = 8 };

/* The room, and in it the same two squares again, at half size and upright. */
typedef struct world {
    small_room room;
    float uvs[ROOM_TRIANGLES * 6];
    uint8_t texels[TEXTURE * TEXTURE * 4];
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance instance[2];
    lmb_light light[LIGHTS];
    lmb_texture texture;
    lmb_scene scene;
} world;

static small_room room;
static world worlds[2]; /* with every property; and the one that changes */
static lmb_scene none, relief_scene;
static lmb_relief relief;
static uint32_t relief_words[SMALL_WORDS(RELIEF_SIDE)], transfer_words[SMALL_TRANSFER_WORDS(ROOM_TRIANGLES)];
static uint32_t pack_words[SMALL_PACK_WORDS];
static size_t relief_bytes, transfer_bytes, pack_bytes;
static uint64_t sums[POOL_SCENES];

static void make_materials(world *w)
{
    lmb_material *m = &w->material[1];
    w->material[0] = w->room.material;
    *m = w->room.material;
    m->texture = 0;
    m->alpha_cutoff = 0.5f;
    m->flags = LMB_ALPHA_MASK | LMB_DOUBLE_SIDED;
    m->normal_scale = 1.0f;
    m->emission_map = m->metal_map = 1;
    m->metallic = 0.5f;
    m->roughness = 0.4f;
    for (int c = 0; c < 3; ++c) {
        m->emission[c] = 0.25f * (float)c;
        m->specular[c] = 0.04f;
    }
    for (int i = 0; i < TEXTURE * TEXTURE * 4; ++i) {
        w->texels[i] = (uint8_t)(i * 37);
    }
    w->texture = (lmb_texture){w->texels, TEXTURE, TEXTURE, 1, LMB_WRAP_MIRROR, LMB_WRAP_REPEAT, LMB_BILINEAR, 0};
}

static void make_world(world *w)
{
    memset(w, 0, sizeof *w);
    small_room_make(&w->room);
    make_materials(w);
    for (int i = 0; i < ROOM_TRIANGLES * 6; ++i) {
        w->uvs[i] = 0.3f * (float)(i * i % 11);
    }
    for (int i = 0; i < 2; ++i) {
        w->mesh[i] = w->room.mesh;
        w->instance[i] = w->room.instance;
        w->instance[i].mesh = w->instance[i].material = (uint32_t)i;
        w->instance[i].first_id = 1 + (uint32_t)i * ROOM_TRIANGLES;
    }
    w->mesh[1].uvs = w->uvs;
    w->instance[1].to_world = (lmb_mat4){{0, 0.5f, 0, 0, -0.5f, 0, 0, 0, 0, 0, 0.5f, 0, 0.25f, 0.5f, 0, 1}};
    w->light[0] = w->room.light;
    w->light[1] = w->room.light;
    w->light[1].kind = LMB_LIGHT_POINT;
    w->light[2] = w->room.light;
    w->light[2].kind = LMB_LIGHT_DIRECTIONAL;
    w->scene = w->room.scene;
    w->scene.meshes = w->mesh;
    w->scene.materials = w->material;
    w->scene.instances = w->instance;
    w->scene.lights = w->light;
    w->scene.textures = &w->texture;
    w->scene.mesh_count = w->scene.material_count = w->scene.instance_count = 2;
    w->scene.texture_count = 1;
    w->scene.light_count = LIGHTS;
    lmb_scene_bounds(&w->scene.bounds_min, &w->scene.bounds_max, &w->scene);
}

const lmb_scene *pool_scene(int i)
{
    const lmb_scene *const all[POOL_SCENES] = {&room.scene, &worlds[0].scene, &worlds[1].scene, &none, &relief_scene};
    return all[i % POOL_SCENES];
}

/* FNV-1a over the data of a scene, 8 bytes at a time. */
static uint64_t sum_of(const void *data, size_t bytes)
{
    uint64_t sum = UINT64_C(0xcbf29ce484222325), word;
    const uint8_t *at = data;
    for (size_t i = 0; i + sizeof word <= bytes; i += sizeof word) {
        memcpy(&word, at + i, sizeof word);
        sum = (sum ^ word) * UINT64_C(0x100000001b3);
    }
    return sum;
}

static void sum_all(uint64_t out[POOL_SCENES])
{
    out[0] = sum_of(&room, sizeof room);
    out[1] = sum_of(&worlds[0], sizeof worlds[0]);
    out[2] = sum_of(&worlds[1], sizeof worlds[1]);
    out[3] = sum_of(&none, sizeof none);
    out[4] = sum_of(relief_words, sizeof relief_words) ^ sum_of(&relief, sizeof relief);
}

void pool_make_scenes(void)
{
    static world fresh;
    if (fresh.scene.meshes == NULL) {
        small_room_make(&room);
        make_world(&worlds[0]);
        make_world(&worlds[1]);
        fresh = worlds[1];
        transfer_bytes = small_transfer(transfer_words, &room.scene);
        pack_bytes = small_pack(pack_words);
        relief_bytes = small_relief(relief_words, LMB_RELIEF_FULL, RELIEF_SIDE);
        fuzz_require(lmb_relief_open(&relief, relief_words, relief_bytes) == LMB_OK);
        lmb_relief_scene(&relief_scene, &relief);
    }
    worlds[1] = fresh;
    for (int i = 0; i < POOL_SCENES; ++i) {
        fuzz_require(lmb_scene_check(pool_scene(i)) == LMB_OK);
    }
    sum_all(sums);
}

void pool_check_scenes(void)
{
    uint64_t now[POOL_SCENES];
    sum_all(now);
    fuzz_require(memcmp(sums, now, sizeof sums) == 0);
}

/* The n-th number of a scene that may change. */
static float *number_of(world *w, int n)
{
    float *const part[] = {w->room.corners[0][0], w->instance[0].to_world.m,  w->instance[1].to_world.m,
                           w->light[0].intensity, &w->light[0].position.x,    &w->light[1].position.x,
                           w->light[2].intensity, w->material[0].albedo,      w->material[1].albedo,
                           w->material[1].specular, w->material[1].emission,  &w->material[1].alpha_cutoff,
                           &w->scene.bounds_min.x, &w->scene.bounds_max.x,    w->uvs,
                           &w->light[0].cos_inner, &w->material[1].roughness, &w->light[0].direction.x};
    static const int count[] = {ROOM_TRIANGLES * 9, 16, 16, 3, 3, 3, 3, 3, 3, 3, 3, 1, 3, 3,
                                ROOM_TRIANGLES * 6, 2,  1,  3};
    const int k = n % (int)(sizeof count / sizeof *count);
    return part[k] + n / 16 % count[k];
}

void pool_change(const uint8_t b[12])
{
    world *w = &worlds[1];
    float *at = number_of(w, b[0] | b[1] << 8);
    const float before = *at;
    memcpy(at, b + 3, b[2] == 255 ? sizeof *at : 0);
    *at = b[2] == 255 ? *at : pool_float(b[2]);
    if (lmb_scene_check(&w->scene) != LMB_OK) {
        *at = before;
    }
    pool_say("scene 2: a number %g -> %g\n", (double)before, (double)*at);
    if (b[7] & 1u) {
        lmb_scene_bounds(&w->scene.bounds_min, &w->scene.bounds_max, &w->scene);
        lmb_scene_core(&w->scene.core, &w->scene);
        fuzz_require(lmb_scene_check(&w->scene) == LMB_OK);
    }
    ++w->scene.revision;
    ++w->scene.lights_revision;
    sum_all(sums);
}

const uint32_t *pool_transfer(size_t *bytes)
{
    *bytes = transfer_bytes;
    return transfer_words;
}

const uint32_t *pool_relief(size_t *bytes)
{
    *bytes = relief_bytes;
    return relief_words;
}

const uint32_t *pool_pack(size_t *bytes)
{
    *bytes = pack_bytes;
    return pack_words;
}

#endif
