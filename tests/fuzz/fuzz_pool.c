/* fuzz_pool.c: slots of all public structs, blocks of memory with an exact end, and odd numbers. */
#include "fuzz_pool.h"

#if FUZZ_CALLS

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Without a sanitizer, guard bytes behind each block detect overruns. */
#if defined(__SANITIZE_ADDRESS__)
#define GUARD 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GUARD 0
#endif
#endif
#ifndef GUARD
#define GUARD 64
#endif
enum { FILL = 0xa5, BLOCKS = 1024 };

int pool_says;
float pool_raw[POOL_ARRAY / sizeof(float)];

void pool_say(const char *format, ...)
{
    va_list list;
    if (pool_says) {
        va_start(list, format);
        vprintf(format, list);
        va_end(list);
        fflush(stdout);
    }
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

typedef struct block {
    uint8_t *data;
    size_t bytes;
} block;

static block blocks[BLOCKS];
static int block_count;

static block guarded(size_t bytes)
{
    block b = {malloc(bytes + GUARD), bytes};
    if (b.data == NULL) {
        abort();
    }
    memset(b.data, 0, bytes);
    memset(b.data + bytes, FILL, GUARD);
    return b;
}

static void check_guard(const block *b)
{
    for (size_t i = 0; i < GUARD; ++i) {
        fuzz_require(b->data[b->bytes + i] == FILL);
    }
}

void *pool_block(size_t bytes)
{
    fuzz_require(block_count < BLOCKS);
    blocks[block_count] = guarded(bytes);
    return blocks[block_count++].data;
}

/* --- slots -------------------------------------------------------------------------------------------------------- */

typedef struct kind {
    const char *type;
    size_t bytes;
    block slot[POOL_SLOTS];
    int is_fresh[POOL_SLOTS]; /* for this input */
} kind;

#define ONE(type)         {#type, sizeof(type), {{NULL, 0}}, {0}}
#define MANY(type, count) {#type, (count) * sizeof(type), {{NULL, 0}}, {0}}
static kind kinds[] = {
    ONE(lmb_around_scratch), ONE(lmb_axes), ONE(lmb_band_scratch), ONE(lmb_bvh),
    ONE(lmb_cloud), ONE(lmb_cone_scratch), ONE(lmb_cone_seen), ONE(lmb_cone_trace), ONE(lmb_cone_width), ONE(lmb_cones),
    ONE(lmb_core), ONE(lmb_culling), ONE(lmb_cut), ONE(lmb_cut_params), ONE(lmb_element_scratch), ONE(lmb_elements),
    ONE(lmb_env), ONE(lmb_fixed), ONE(lmb_fixed_frame), ONE(lmb_fixed_view), ONE(lmb_frame),
    ONE(lmb_frame_settings), ONE(lmb_gather_scratch), ONE(lmb_glossy), ONE(lmb_gouraud),
    ONE(lmb_gouraud_scratch), ONE(lmb_grouping), ONE(lmb_groups), ONE(lmb_hull), ONE(lmb_irradiance), ONE(lmb_lattice),
    ONE(lmb_live), ONE(lmb_live_receiver), ONE(lmb_live_scratch), ONE(lmb_live_sky), ONE(lmb_many_lights),
    ONE(lmb_many_lights_query), ONE(lmb_many_lights_scratch), ONE(lmb_multisample),
    ONE(lmb_occluder), ONE(lmb_pack), ONE(lmb_pinhole), ONE(lmb_plan), ONE(lmb_planes), ONE(lmb_points),
    ONE(lmb_probe), ONE(lmb_probe_answer), ONE(lmb_probe_blur), ONE(lmb_probe_cache), ONE(lmb_probe_cube),
    ONE(lmb_probe_lights), ONE(lmb_probe_policy), ONE(lmb_probe_rays), ONE(lmb_probe_table), ONE(lmb_radiance),
    ONE(lmb_real_mesh), ONE(lmb_relief), ONE(lmb_relief_how), ONE(lmb_relief_stats), ONE(lmb_relight),
    ONE(lmb_relight_scratch), ONE(lmb_render), ONE(lmb_stats), ONE(lmb_surface), ONE(lmb_survey),
    ONE(lmb_target), ONE(lmb_tile), ONE(lmb_tile_sample), ONE(lmb_transfer), ONE(lmb_transfer_light),
    ONE(lmb_transfer_scratch), ONE(lmb_traversal), ONE(lmb_tree), ONE(lmb_view), ONE(lmb_voxels), ONE(lmb_world),
    ONE(lmb_world_pictures), ONE(lmb_world_query), MANY(lmb_light, POOL_LIGHTS), MANY(lmb_shadow_map, POOL_MAPS),
    MANY(lmb_texel, POOL_TEXELS), MANY(lmb_vec3, POOL_PLACES), MANY(lmb_voxel_part, POOL_PARTS),
    MANY(lmb_cluster, POOL_CLUSTERS), MANY(lmb_bins, POOL_BINS), ONE(lmb_draw_target), ONE(lmb_draw_state),
    ONE(lmb_draw_vertices), ONE(lmb_draw_indices), ONE(lmb_draw_pixels_of), ONE(lmb_draw_fragment_at),
    ONE(lmb_draw_lighting), ONE(lmb_draw_lit), ONE(lmb_blit_image), ONE(lmb_blit_how), ONE(lmb_mat4),
    ONE(lmb_triangle), ONE(lmb_vertex),
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static kind *kind_of(const char *type)
{
    for (int k = 0; k < KINDS; ++k) {
        if (strcmp(kinds[k].type, type) == 0) {
            return &kinds[k];
        }
    }
    fprintf(stderr, "fuzz_pool.c has no slots of %s: name it there\n", type);
    abort();
}

size_t pool_slot_bytes(const char *type) { return kind_of(type)->bytes; }

void *pool_slot(const char *type, int i)
{
    if (strcmp(type, "lmb_scene") == 0) {
        return (void *)(uintptr_t)pool_scene(i);
    }
    if (strcmp(type, "lmb_mesh") == 0) { /* of a checked scene, as the headers demand; so are textures */
        return (void *)(uintptr_t)pool_scene(i)->meshes;
    }
    if (strcmp(type, "lmb_texture") == 0) {
        return (void *)(uintptr_t)pool_scene(i)->textures;
    }
    kind *k = kind_of(type);
    i %= POOL_SLOTS;
    if (k->slot[i].data == NULL) {
        k->slot[i] = guarded(k->bytes);
    }
    if (!k->is_fresh[i]) {
        memset(k->slot[i].data, 0, k->bytes);
        k->is_fresh[i] = 1;
    }
    return k->slot[i].data;
}

void pool_begin(void)
{
    pool_says = getenv("LMB_FUZZ_SAY") != NULL;
    for (int k = 0; k < KINDS; ++k) {
        memset(kinds[k].is_fresh, 0, sizeof kinds[k].is_fresh);
    }
    memset(pool_raw, 0, sizeof pool_raw);
    pool_make_scenes();
}

void pool_end(void)
{
    for (int k = 0; k < KINDS; ++k) {
        for (int i = 0; i < POOL_SLOTS; ++i) {
            if (kinds[k].is_fresh[i]) {
                check_guard(&kinds[k].slot[i]);
            }
        }
    }
    for (; block_count > 0; --block_count) {
        check_guard(&blocks[block_count - 1]);
        free(blocks[block_count - 1].data);
    }
    pool_check_scenes();
}

/* --- numbers ------------------------------------------------------------------------------------------------------ */

float pool_float(uint8_t i)
{
    static const float odd[32] = {0.0f,   -0.0f,  1.0f,    -1.0f,   0.5f,       2.0f,   1e-6f,  -1e-6f,
                                  1e6f,   -1e6f,  1e-20f,  -1e-20f, 1e20f,      -1e20f, 1e-40f, -1e-40f,
                                  1e-45f, 3e38f,  -3e38f,  1.6e9f,  -2.1475e9f, 4.3e9f, 9.3e18f, 1048576.0f,
                                  64.0f,  -64.0f, 0.9999999f, 1.0000001f, 3.1415927f};
    uint32_t bits = i == 29 ? 0x7fc00000u : i == 30 ? 0x7f800000u : 0xff800000u; /* NaN, infinities */
    float v;
    memcpy(&v, &bits, sizeof v);
    return i >= 32 ? (float)(i - 144) / 16.0f : i >= 29 ? v : odd[i];
}

lmb_vec3 pool_vector(uint8_t i)
{
    return (lmb_vec3){pool_float(i), pool_float((uint8_t)(i * 7 + 3)), pool_float((uint8_t)(i * 13 + 40))};
}

int64_t pool_whole(uint8_t i)
{
    static const int64_t odd[] = {-1,    -2,    -8,         -128,       INT32_MIN,   INT32_MAX, UINT32_MAX, 65535,
                                  65536, 1 << 24, INT64_MAX, INT64_MIN, 1 << 30, (int64_t)3 << 30, 4096, 8191,
                                  8192,  8193,  16384,      0x55555555, 0x7fffff,   1000003,   100,        127,
                                  128,   256,   512,        1024,       INT32_MIN + 1, 640, 200, 255};
    return i < 128 ? i : odd[i % 32];
}

static uint16_t hash_of(const char *name)
{
    uint32_t h = 0x811c9dc5u;
    for (; *name != '\0'; ++name) {
        h = (h ^ (uint8_t)*name) * 0x01000193u;
    }
    return (uint16_t)(h >> 16 ^ h);
}

int pool_nearest(const char *const *name, size_t step, int count, uint16_t wanted)
{
    int best = 0;
    uint16_t least = UINT16_MAX;
    for (int i = 0; i < count; ++i) {
        const char *one = *(const char *const *)(const void *)((const char *)name + (size_t)i * step);
        const uint16_t apart = (uint16_t)(hash_of(one) - wanted);
        if (apart <= least) {
            least = apart;
            best = i;
        }
    }
    return best;
}

#endif
