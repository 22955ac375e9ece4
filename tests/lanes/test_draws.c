/* test_draws.c: whole draws of random triangles on every available backend against scalar's: small and large ones,
 * clipped, edge-on and degenerate, into each kind of window, some with a mask. Tests setup, fill_small, fill_large and fill_masked together. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../src/lane/kernels.h"
#include "seed.h"

void test_draws(void);

enum { ROUNDS = 400, FRAME = 160, TRIANGLES = 107, PIXELS = FRAME * FRAME };

/* A scene of loose triangles under one view, and a window of the frame. */
typedef struct draws {
    float positions[9 * TRIANGLES], uvs[6 * TRIANGLES];
    uint8_t texels[4 * 40 * 40];
    lmb_texture texture;
    uint32_t indices[3 * TRIANGLES];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view;
    int32_t x0, y0, width, height, depth_format, id_format, layout;
    int32_t id_stride_more; /* bytes */
    uint32_t flags;
} draws;

/* Each triangle has one of the smallest `kinds` sizes, 0.01 to 6 m, at a place that may be behind the eye. If they are
 * crowded, most are in the picture, and all triangles of a batch are small. */
static void make_triangle(float *p, uint32_t kinds, int are_crowded, test_rng *r)
{
    static const float sizes[] = {0.01f, 0.05f, 0.2f, 1.0f, 6.0f};
    const float size = sizes[test_random(r) % kinds], share = are_crowded ? 0.2f : 1.0f;
    const float x = share * test_uniform(r, -2, 2), y = share * test_uniform(r, -2, 2), z = share * test_uniform(r, -3, 4);
    for (int k = 0; k < 9; k += 3) {
        p[k] = x + test_uniform(r, -size, size);
        p[k + 1] = y + test_uniform(r, -size, size);
        p[k + 2] = z + test_uniform(r, -size, size);
    }
    switch (test_random(r) % 16u) {
    case 0: p[8] = p[5] = p[2]; break;                                       /* parallel to the image plane */
    case 1: memcpy(p + 6, p + 3, 3 * sizeof *p); break;                      /* no area */
    case 2: p[test_random(r) % 9u] = hard_bits[test_random(r) % HARD_COUNT] % 2u ? 1e30f : -1e7f; break;
    case 3: memset(p + test_random(r) % 9u, 0xff, sizeof *p); break;         /* NaN */
    default: break;
    }
}

/* Every corner has its own vertex, or near triangles share corners; in some meshes a few indices are out of range. */
static void make_indices(draws *d, test_rng *r)
{
    const uint32_t stray = test_random(r) % 3u;
    for (uint32_t i = 0; i < 3 * TRIANGLES; ++i) {
        const uint32_t other = i + test_random(r) % 9u;
        d->indices[i] = test_random(r) % 2u && other < 3 * TRIANGLES ? other : i;
        if (stray == 0 && test_random(r) % 40u == 0) {
            d->indices[i] = test_random(r) % 2u ? 3 * TRIANGLES : 0xffffffffu - test_random(r) % 2u;
        }
    }
    d->mesh.indices = d->indices;
    d->mesh.index_format = LMB_INDEX_U32;
}

/* A mask of up to 40x40 texels, in squares that are opaque in turns: tiles are all hole, all solid, or neither. */
static void make_squares(draws *d, test_rng *r)
{
    const int squares = 1 + (int)(test_random(r) % 8u), width = 4 + (int)(test_random(r) % 37u),
              height = 4 + (int)(test_random(r) % 37u);
    for (int i = 0; i < width * height; ++i) {
        const int is_solid = (i % width / squares ^ i / width / squares) & 1;
        d->texels[4 * i + 3] = (uint8_t)((is_solid ? 240u : 0u) + test_random(r) % 16u);
    }
    for (int i = 0; i < 6 * TRIANGLES; ++i) {
        d->uvs[i] = test_uniform(r, -0.2f, 1.2f);
    }
    d->texture.width = (uint16_t)width;
    d->texture.height = (uint16_t)height;
}

/* A mask of up to 9x9 texels. A few coordinates are huge. */
static void make_mask(draws *d, test_rng *r)
{
    for (int i = 0; i < 6 * TRIANGLES; ++i) {
        d->uvs[i] = test_random(r) % 64u ? test_uniform(r, -3, 3) : test_uniform(r, -3e6f, 3e6f);
    }
    for (size_t i = 0; i < sizeof d->texels; ++i) {
        d->texels[i] = (uint8_t)(test_random(r) % 3u ? 255u * (test_random(r) % 2u) : test_random(r));
    }
    d->texture.texels = d->texels;
    d->texture.width = (uint16_t)(1u + test_random(r) % 9u);
    d->texture.height = (uint16_t)(1u + test_random(r) % 9u);
    d->texture.levels = 1;
    d->texture.wrap_s = (uint8_t)(test_random(r) % 3u);
    d->texture.wrap_t = (uint8_t)(test_random(r) % 3u);
    d->texture.filter = test_random(r) % 2u ? LMB_NEAREST : LMB_BILINEAR;
    if (test_random(r) % 2u) {
        make_squares(d, r);
    }
    d->mesh.uvs = d->uvs;
    d->scene.textures = &d->texture;
    d->scene.texture_count = 1;
    d->material.texture = 0;
    d->material.flags |= LMB_ALPHA_MASK;
    d->material.alpha = test_uniform(r, 0.5f, 1.0f);
    d->material.alpha_cutoff = 0.5f;
}

static void make_draws(draws *d, test_rng *r)
{
    const lmb_vec3 eye = {0, 0, 3}, target = {0.1f, 0.05f, 0}, up = {0, 1, 0};
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    memset(d, 0, sizeof *d);
    const uint32_t kinds = 1u + test_random(r) % 5u; /* batches of small triangles use special code */
    const int are_crowded = test_random(r) % 2u == 0;
    for (int i = 0; i < TRIANGLES; ++i) {
        make_triangle(d->positions + 9 * i, kinds, are_crowded, r);
    }
    for (uint32_t i = 1; i < TRIANGLES; ++i) { /* equal depths: the earlier triangle wins */
        if (test_random(r) % 4u == 0) {
            const uint32_t back = 1 + test_random(r) % 12u; /* mostly of the same batch */
            memcpy(d->positions + 9 * i, d->positions + 9 * (back < i ? i - back : 0), 9 * sizeof(float));
        }
    }
    d->mesh.positions = d->positions;
    d->mesh.vertex_count = 3 * TRIANGLES;
    d->mesh.triangle_count = TRIANGLES;
    if (test_random(r) % 2u) {
        make_indices(d, r);
    }
    d->material.alpha = 1.0f;
    d->material.texture = -1;
    d->instance.to_world = unit;
    d->instance.to_world.m[0] = test_random(r) % 2u ? 1.0f : -1.3f; /* mirrored */
    d->instance.first_id = 1;
    d->scene.meshes = &d->mesh;
    d->scene.materials = &d->material;
    d->scene.instances = &d->instance;
    d->scene.mesh_count = d->scene.material_count = d->scene.instance_count = 1;
    lmb_view_look_at(&d->view, eye, target, up, 0.9f, FRAME, FRAME);
    d->view.kind = test_random(r) % 4u ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC;
    d->view.near_m = 0.05f;
    d->view.far_m = 20.0f;
    d->x0 = (int32_t)(test_random(r) % 4u) * 16;
    d->y0 = (int32_t)(test_random(r) % 4u) * 24;
    d->width = 8 + (int32_t)(test_random(r) % (uint32_t)(FRAME - d->x0 - 7));
    d->height = 8 + (int32_t)(test_random(r) % (uint32_t)(FRAME - d->y0 - 7));
    d->depth_format = test_random(r) % 3u ? LMB_DEPTH32F : LMB_DEPTH16;
    d->id_format = test_random(r) % 3u == 0 ? LMB_FORMAT_NONE : test_random(r) % 2u ? LMB_ID16 : LMB_ID32;
    d->layout = test_random(r) % 3u ? LMB_TILED : LMB_LINEAR;
    d->flags = test_random(r) % 2u ? LMB_CULL_BACK : 0;
    d->id_stride_more = test_random(r) % 4u == 0 ? 8 * 8 * 4 : 0;
    if (test_random(r) % 4u == 0) {
        make_mask(d, r);
    }
}

/* The most common target: depth and ids in tiles, of the whole frame. */
static void make_usual(draws *d)
{
    d->depth_format = LMB_DEPTH32F;
    d->id_format = LMB_ID32;
    d->layout = LMB_TILED;
    d->id_stride_more = d->x0 = d->y0 = 0;
    d->width = d->height = FRAME;
    d->mesh.index_format = LMB_INDEX_NONE;
    d->mesh.indices = NULL;
}

/* Linear windows have rows as wide as whole tiles. */
static void make_surface(lmb_surface *s, const draws *d, int32_t format, void *memory, size_t bytes)
{
    CHECK(lmb_surface_init(s, format, d->width, d->height, memory, bytes) == LMB_OK);
    if (d->layout == LMB_LINEAR) {
        s->layout = LMB_LINEAR;
        s->stride_bytes = (d->width + 7) / 8 * 8 * lmb_pixel_bytes(format);
    }
}

static uint64_t draw_with(const lmb_kernels *backend, const draws *d, lmb_stats *stats)
{
    static uint32_t depth[PIXELS], id[PIXELS + 8 * FRAME];
    lmb_target t = {{0}, {0}, 0, 0};
    uint64_t hash;
    memset(depth, 0, sizeof depth);
    memset(id, 0, sizeof id);
    memset(stats, 0, sizeof *stats);
    t.x0 = d->x0;
    t.y0 = d->y0;
    make_surface(&t.depth, d, d->depth_format, depth, sizeof depth);
    if (d->id_format != LMB_FORMAT_NONE) {
        make_surface(&t.id, d, d->id_format, id, sizeof id);
        t.id.stride_bytes += d->id_stride_more;
    }
    CHECK(lmb_draw(&t, backend, &d->view, &d->scene, 1, TRIANGLES, d->flags, stats) == LMB_OK);
    hash = lmb_surface_hash(&t.depth);
    return d->id_format == LMB_FORMAT_NONE ? hash : hash * 31u + lmb_surface_hash(&t.id);
}

static int same_stats(const lmb_stats *a, const lmb_stats *b)
{
    return a->triangles == b->triangles && a->triangles_drawn == b->triangles_drawn &&
           a->triangles_dropped == b->triangles_dropped;
}

/* Rows of tiles that span over 2^31 bytes; only the last row, which has the triangles, is allocated. */
static void check_far_rows(const lmb_kernels *backend, int with_ids)
{
    static float near_by[64 * 4 * 10], far_apart[64 * 4];
    static uint32_t near_id[64 * 4 * 10], far_id[64 * 4];
    const lmb_vec3 eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 1, 0};
    test_rng r = seed_rng(7);
    draws d;
    lmb_target t = {{0}, {0}, 0, 0};
    int drawn = 0;
    make_draws(&d, &r);
    d.mesh.index_format = LMB_INDEX_NONE;
    lmb_view_look_at(&d.view, eye, target, up, 0.9f, 32, 80);
    for (int i = 0; i < 9 * TRIANGLES; i += 3) {
        d.positions[i] = test_uniform(&r, -0.4f, 0.4f);
        d.positions[i + 1] = test_uniform(&r, -0.46f, -0.4f); /* of 0.48 m downwards: the last eight rows */
        d.positions[i + 2] = test_uniform(&r, -0.01f, 0.01f);
    }
    memset(near_by, 0, sizeof near_by);
    memset(far_apart, 0, sizeof far_apart);
    memset(near_id, 0, sizeof near_id);
    memset(far_id, 0, sizeof far_id);
    CHECK(lmb_surface_init(&t.depth, LMB_DEPTH32F, 32, 80, near_by, sizeof near_by) == LMB_OK);
    if (with_ids) {
        CHECK(lmb_surface_init(&t.id, LMB_ID32, 32, 80, near_id, sizeof near_id) == LMB_OK);
    }
    CHECK(lmb_draw(&t, backend, &d.view, &d.scene, 1, TRIANGLES, 0, NULL) == LMB_OK);
    t.depth.stride_bytes = INT32_MAX / LMB_TILE & ~3;
    t.depth.data = (void *)((uintptr_t)far_apart - 9 * (uintptr_t)t.depth.stride_bytes);
    if (with_ids) {
        t.id.stride_bytes = t.depth.stride_bytes;
        t.id.data = (void *)((uintptr_t)far_id - 9 * (uintptr_t)t.id.stride_bytes);
    }
    CHECK(lmb_draw(&t, backend, &d.view, &d.scene, 1, TRIANGLES, 0, NULL) == LMB_OK);
    for (int i = 0; i < 64 * 4; ++i) {
        drawn += far_apart[i] > 0.0f;
    }
    CHECK(drawn > 100);
    CHECK(memcmp(near_by + 9 * 64 * 4, far_apart, sizeof far_apart) == 0);
    CHECK(memcmp(near_id + 9 * 64 * 4, far_id, sizeof far_id) == 0);
}

void test_draws(void)
{
    const seed_range range = seeds(ROUNDS);
    const lmb_kernels *backend;
    for (int32_t i = 0; (backend = lmb_kernels_at(i)) != NULL; ++i) {
        check_far_rows(backend, 0);
        check_far_rows(backend, 1);
    }
    for (uint32_t k = 0; k < range.count; ++k) {
        test_rng r = seed_rng(range.first + k);
        draws d;
        lmb_stats want, got;
        make_draws(&d, &r);
        if ((range.first + k) % 4 == 0) {
            make_usual(&d);
        }
        const uint64_t hash = draw_with(&lmb_kernels_scalar, &d, &want);
        CHECK(want.triangles == TRIANGLES);
        for (int32_t i = 0; (backend = lmb_kernels_at(i)) != NULL && backend != &lmb_kernels_scalar; ++i) {
            CHECK_MSG(draw_with(backend, &d, &got) == hash && same_stats(&want, &got),
                      "a draw by %s; repeat: LANES_SEED=%u tests lanes", lmb_kernels_name(backend),
                      (unsigned)(range.first + k));
        }
    }
}
