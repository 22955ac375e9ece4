/* test_large.c: layer 3: large triangles in long rows of tiles have the same bytes as in windows one tile wide, in
 * which rows have no next tile; also with bounds of farthest depths.
 *
 * Triangles are random, of every size up to far beyond the guard band: slivers lower than a tile, rectangles on tile
 * borders, copies of the previous one (at equal depths the earlier id stays), and NaN. */
#include <string.h>

#include <lambent/raster.h>

#include "../laid_surface.h"
#include "../test.h"

void test_large(void);

/* No multiple of the vector width, nor of a counter's first step. */
enum { ACROSS = 261, DOWN = 3, TILES = ACROSS * DOWN, WIDTH = ACROSS * LMB_TILE, HEIGHT = DOWN * LMB_TILE };
enum { TRIANGLES = 36, SCENES = 4 };
enum { SMALL = 128, SMALL_TILES = SMALL / LMB_TILE * (SMALL / LMB_TILE) };

static float corners[9 * TRIANGLES];
static uint32_t wide_depth[WIDTH * HEIGHT], wide_id[WIDTH * HEIGHT], one_depth[LMB_TILE * HEIGHT],
    one_id[LMB_TILE * HEIGHT];
static lmb_view view;
static lmb_scene scene;

/* At px of the frame from the centre, and at a distance. */
static void put_corner(float *out, float x, float y, float z)
{
    const float m = view.kind == LMB_PERSPECTIVE ? z : 1.0f;
    out[0] = x * m, out[1] = y * m, out[2] = -z;
}

static void put_triangle(test_rng *r, float *out, int i)
{
    static const float sizes[] = {60.0f, 400.0f, 1100.0f, 5000.0f, 1e6f};
    const float size = sizes[test_random(r) % 5u], z = test_uniform(r, 2, 30);
    /* Two slopes of a few roundings, which leave the corners' range, and one of a few 16-bit codes. */
    static const float tilts[] = {0.0f, 2e-5f, 1.5e-4f, 4e-3f, 1.0f};
    const float tilt = tilts[test_random(r) % 5u];
    const float high = i % 4 == 0 ? 5.0f : size, x = test_uniform(r, -900, 900), y = test_uniform(r, -9, 9);
    for (int k = 0; k < 3; ++k) {
        put_corner(out + 3 * k, x + test_uniform(r, -size, size), y + test_uniform(r, -high, high),
                   z + tilt * test_uniform(r, -1, 1));
    }
    if (i % 6 == 1 || i % 6 == 2) { /* half a rectangle on tile borders, nearest at the right angle */
        const float left = 8.0f * (float)(test_random(r) % 160u) - 1044.0f, top = test_random(r) % 2u ? 12.0f : 4.0f;
        const float x0 = test_random(r) % 2u ? left : left + 704.0f, y0 = test_random(r) % 2u ? top : top - 16.0f;
        put_corner(out, x0, y0, z);
        put_corner(out + 3, 2.0f * left + 704.0f - x0, y0, z + tilt);
        put_corner(out + 6, x0, 2.0f * top - 16.0f - y0, z + 0.02f * tilt * test_uniform(r, 0, 1));
    }
    if (i % 6 == 5 && i > 6) {
        memcpy(out, out - 9, 9 * sizeof *out);
    }
    if (i == 9) {
        memset(out + test_random(r) % 9u, 0xff, sizeof *out); /* NaN */
    }
}

static void make_scene(test_rng *r, int32_t kind)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    static lmb_mesh mesh;
    static lmb_material material;
    static lmb_instance instance;
    memset(&view, 0, sizeof view);
    view.kind = kind;
    view.right.x = view.up.y = view.back.z = 1.0f;
    view.half_width = 0.5f * (float)WIDTH;
    view.half_height = 0.5f * (float)HEIGHT;
    view.near_m = 0.5f;
    view.far_m = 40.0f;
    view.frame_width = WIDTH;
    view.frame_height = HEIGHT;
    for (int i = 0; i < TRIANGLES; ++i) {
        put_triangle(r, corners + 9 * i, i);
    }
    mesh.positions = corners;
    mesh.vertex_count = 3 * TRIANGLES;
    mesh.triangle_count = TRIANGLES;
    material.texture = -1;
    material.flags = LMB_DOUBLE_SIDED;
    instance.to_world = unit;
    instance.first_id = 1;
    scene.meshes = &mesh;
    scene.materials = &material;
    scene.instances = &instance;
    scene.mesh_count = scene.material_count = scene.instance_count = 1;
}

static lmb_target target_of(int32_t depth_format, int32_t id_format, int32_t width, void *depth, void *id)
{
    lmb_target t;
    memset(&t, 0, sizeof t);
    t.depth = surface_of(depth_format, LMB_TILED, width, HEIGHT, depth);
    lmb_surface_clear(&t.depth);
    if (id_format != LMB_FORMAT_NONE) {
        t.id = surface_of(id_format, LMB_TILED, width, HEIGHT, id);
        lmb_surface_clear(&t.id);
    }
    return t;
}

/* Number of differing tiles in column x. */
static int32_t differ(const lmb_surface *wide, const lmb_surface *one, int32_t x)
{
    const size_t tile = (size_t)(LMB_TILE_PIXELS * lmb_pixel_bytes(wide->format));
    int32_t n = 0;
    for (size_t y = 0; y < DOWN; ++y) {
        const char *a = (const char *)wide->data + (y * ACROSS + (size_t)x) * tile;
        n += memcmp(a, (const char *)one->data + y * tile, tile) != 0;
    }
    return n;
}

static int32_t columns_differ(const lmb_kernels *kernels, const lmb_target *wide)
{
    int32_t n = 0;
    for (int32_t x = 0; x < ACROSS; ++x) {
        lmb_target t = target_of(wide->depth.format, wide->id.format, LMB_TILE, one_depth, one_id);
        t.x0 = x * LMB_TILE;
        CHECK(lmb_draw(&t, kernels, &view, &scene, 1, TRIANGLES, 0, NULL) == LMB_OK);
        n += differ(&wide->depth, &t.depth, x);
        n += t.id.data != NULL ? differ(&wide->id, &t.id, x) : 0;
    }
    return n;
}

/* Returns the hash of the depths. */
static uint64_t judge(const lmb_kernels *kernels, int32_t depth_format, int32_t id_format)
{
    lmb_target t = target_of(depth_format, id_format, WIDTH, wide_depth, wide_id);
    CHECK(lmb_draw(&t, kernels, &view, &scene, 1, TRIANGLES, 0, NULL) == LMB_OK);
    CHECK_MSG(columns_differ(kernels, &t) == 0, "%s, formats %d and %d", lmb_kernels_name(kernels), (int)depth_format,
              (int)id_format);
    const uint64_t depth = lmb_surface_hash(&t.depth);
#if LMB_CULLING
    static float farthest[TILES + 15];
    const lmb_culling culling = {farthest, NULL, TILES + 15, 0};
    const uint64_t id = t.id.data != NULL ? lmb_surface_hash(&t.id) : 0;
    t = target_of(depth_format, id_format, WIDTH, wide_depth, wide_id);
    memset(farthest, 0, sizeof farthest);
    CHECK(lmb_draw_culled(&t, kernels, &view, &scene, 1, TRIANGLES, 0, 0, &culling, NULL) == LMB_OK);
    CHECK(lmb_surface_hash(&t.depth) == depth && (t.id.data == NULL || lmb_surface_hash(&t.id) == id));
#endif
    return depth;
}

/* Found by search: depths that differ by a few steps of binary32 between corners; by rounding, the plane leaves this
 * range in tiles entirely inside. In a frame of 128 px with a half width of 1 at 1 m. */
static const float nearly_flat[][9] = {
    {-0x1.c29406p-1f, 0x1.5da61p-1f, -0x1.cd646p-1f, -0x1.c293f2p-1f, -0x1.a5bdaep-1f, -0x1.cd644cp-1f,
     0x1.a5bdaep-1f, 0x1.5da602p-1f, -0x1.cd644cp-1f},
    {-0x1.dee704p-2f, -0x1.0309e8p-2f, -0x1.ad9b28p-2f, -0x1.3186ap-1f, -0x1.e5461ep-10f, -0x1.ad9b44p-2f,
     0x1.149702p-3f, -0x1.474352p-4f, -0x1.ad9b28p-2f},
    {-0x1.3c5d8p-2f, 0x1.fb530ep-3f, -0x1.6cd14cp-2f, -0x1.3c5d6ep-2f, -0x1.035cbep-2f, -0x1.6cd138p-2f,
     0x1.2b439ep-2f, 0x1.fb52fp-3f, -0x1.6cd136p-2f},
    {0x1.690014p-1f, 0x1.f43fd2p-2f, -0x1.f504a2p-2f, -0x1.6659bp-1f, -0x1.503912p-1f, -0x1.f5049ep-2f,
     -0x1.317f5ep-1f, 0x1.105746p-1f, -0x1.f5048p-2f},
    {-0x1.260b9cp-1f, 0x1.2ba56ep-1f, -0x1.66748ep-1f, -0x1.260baep-1f, -0x1.ba77fap-2f, -0x1.6674a4p-1f,
     0x1.4d406ep-1f, 0x1.2ba58p-1f, -0x1.6674a2p-1f},
    {-0x1.03269ap-1f, 0x1.f07a76p-2f, -0x1.5d2beep-1f, -0x1.03268ep-1f, -0x1.af0224p-2f, -0x1.5d2bdcp-1f,
     0x1.e590fcp-2f, 0x1.f07a5ap-2f, -0x1.5d2bdap-1f},
    {-0x1.0439b6p-1f, 0x1.3eb3fcp-1f, -0x1.7641bep-1f, -0x1.0439a6p-1f, -0x1.3eb3eap-1f, -0x1.7641a8p-1f,
     0x1.2176c8p-1f, 0x1.3eb3eap-1f, -0x1.7641a8p-1f},
    {-0x1.1ab75ep-1f, 0x1.320878p-1f, -0x1.7511a4p-1f, -0x1.1ab772p-1f, -0x1.4f2dfp-1f, -0x1.7511bep-1f,
     0x1.3db11cp-1f, 0x1.32088ep-1f, -0x1.7511bep-1f},
    {-0x1.25f0bep-1f, 0x1.642834p-1f, -0x1.9cdf7cp-1f, -0x1.0d449cp-2f, -0x1.d10be4p-2f, -0x1.9cdf8ep-1f,
     0x1.9584b2p-1f, 0x1.36dd0ep-1f, -0x1.9cdf8ep-1f},
    {-0x1.83923cp-2f, 0x1.7c0276p-3f, -0x1.0ef7e4p-1f, -0x1.9f286cp-2f, -0x1.5618acp-2f, -0x1.0ef7c4p-1f,
     0x1.f890c4p-3f, 0x1.43b73ep-2f, -0x1.0ef7c4p-1f},
    {-0x1.1c2048p+0f, 0x1.132d6p+0f, -0x1.1e5d02p+0f, -0x1.1c203ap+0f, -0x1.f99c1ep-1f, -0x1.1e5cf4p+0f,
     0x1.f0a938p-1f, 0x1.132d52p+0f, -0x1.1e5cf4p+0f},
};

static void make_nearly_flat(const float *triangle)
{
    test_rng r = {24};
    make_scene(&r, LMB_PERSPECTIVE);
    memcpy(corners, triangle, 9 * sizeof *corners);
    view.half_width = view.half_height = 1.0f;
    view.near_m = 0.1f;
    view.far_m = 3.0f;
    view.frame_width = view.frame_height = SMALL;
}

/* Number of tiles that differ from a separate window. */
static int32_t tiles_differ(const lmb_kernels *kernels, const float *whole)
{
    static float one[LMB_TILE_PIXELS];
    int32_t n = 0;
    for (int32_t tile = 0; tile < SMALL_TILES; ++tile) {
        lmb_target t;
        memset(&t, 0, sizeof t);
        memset(one, 0, sizeof one);
        t.depth = surface_of(LMB_DEPTH32F, LMB_TILED, LMB_TILE, LMB_TILE, one);
        t.x0 = tile % (SMALL / LMB_TILE) * LMB_TILE;
        t.y0 = tile / (SMALL / LMB_TILE) * LMB_TILE;
        CHECK(lmb_draw(&t, kernels, &view, &scene, 1, 1, 0, NULL) == LMB_OK);
        n += memcmp(one, whole + (size_t)tile * LMB_TILE_PIXELS, sizeof one) != 0;
    }
    return n;
}

static void judge_nearly_flat(const lmb_kernels *kernels, int i)
{
    static float whole[SMALL * SMALL], culled[SMALL * SMALL];
    static uint16_t codes[2][SMALL * SMALL];
    lmb_target t;
    memset(&t, 0, sizeof t);
    memset(whole, 0, sizeof whole);
    memset(culled, 0, sizeof culled);
    t.depth = surface_of(LMB_DEPTH32F, LMB_TILED, SMALL, SMALL, whole);
    CHECK(lmb_draw(&t, kernels, &view, &scene, 1, 1, 0, NULL) == LMB_OK);
    CHECK_MSG(tiles_differ(kernels, whole) == 0, "%s, triangle %d", lmb_kernels_name(kernels), i);
    for (int plain = 0; plain < 2; ++plain) { /* plain C clamps each depth */
        const lmb_kernels *by = plain ? lmb_kernels_named("scalar") : kernels;
        memset(codes[plain], 0, sizeof codes[plain]);
        t.depth = surface_of(LMB_DEPTH16, LMB_TILED, SMALL, SMALL, codes[plain]);
        CHECK(lmb_draw(&t, by, &view, &scene, 1, 1, 0, NULL) == LMB_OK);
        memset(culled, 0, sizeof culled);
        t.depth = surface_of(LMB_DEPTH32F, LMB_TILED, SMALL, SMALL, culled);
        CHECK(lmb_draw(&t, by, &view, &scene, 1, 1, 0, NULL) == LMB_OK);
        CHECK_MSG(memcmp(whole, culled, sizeof whole) == 0, "%s, triangle %d", lmb_kernels_name(kernels), i);
    }
    CHECK_MSG(memcmp(codes[0], codes[1], sizeof codes[0]) == 0, "%s, triangle %d", lmb_kernels_name(kernels), i);
    memset(culled, 0, sizeof culled);
#if LMB_CULLING
    static float farthest[SMALL_TILES + 15];
    const lmb_culling culling = {farthest, NULL, SMALL_TILES + 15, 0};
    memset(farthest, 0, sizeof farthest);
    t.depth.data = culled;
    CHECK(lmb_draw_culled(&t, kernels, &view, &scene, 1, 1, 0, 0, &culling, NULL) == LMB_OK);
    CHECK_MSG(memcmp(whole, culled, sizeof whole) == 0, "%s, triangle %d", lmb_kernels_name(kernels), i);
#endif
}

static void test_nearly_flat(void)
{
    for (size_t i = 0; i < sizeof nearly_flat / sizeof *nearly_flat; ++i) {
        make_nearly_flat(nearly_flat[i]);
        for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
            judge_nearly_flat(lmb_kernels_at(m), (int)i);
        }
    }
}

/* Depths are the same without ids, which use another code path. */
void test_large(void)
{
    static const int32_t formats[][2] = {{LMB_DEPTH32F, LMB_FORMAT_NONE}, {LMB_DEPTH32F, LMB_ID32},
                                         {LMB_DEPTH16, LMB_ID16}, {LMB_DEPTH16, LMB_FORMAT_NONE}};
    test_rng r = {24};
    for (int i = 0; i < SCENES; ++i) {
        make_scene(&r, i % 2 ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC);
        for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
            uint64_t hash[sizeof formats / sizeof *formats];
            for (size_t k = 0; k < sizeof formats / sizeof *formats; ++k) {
                hash[k] = judge(lmb_kernels_at(m), formats[k][0], formats[k][1]);
            }
            CHECK_MSG(hash[0] == hash[1] && hash[2] == hash[3], "%s", lmb_kernels_name(lmb_kernels_at(m)));
        }
    }
    test_nearly_flat();
}
