/* test_resolve.c: tiles with many triangles and meshes, resolved in any window, equal those of the whole frame. */
#include <lambent/lambent.h>

#include <math.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../src/raster/plane.h"
#include "../test.h"

void test_resolve(void);

enum { FRAME = 48, MESHES = 4, TRIANGLES = 40, CORNERS = 3 * TRIANGLES, PIXELS = FRAME * FRAME, TEXELS = 16 };

/* Meshes with every choice of streams, so that batches in a tile have different streams. */
typedef struct world {
    lmb_mesh mesh[MESHES];
    lmb_material material[MESHES];
    lmb_instance instance[MESHES];
    lmb_texture texture[2]; /* with and without levels */
    lmb_scene scene;
    lmb_view view;
    float positions[MESHES][CORNERS * 3], uvs[MESHES][CORNERS * 2];
    int16_t normals[MESHES][CORNERS * 2];
    uint8_t texels[TEXELS * TEXELS * 4 * 2];
    uint16_t colours[MESHES][CORNERS * 4]; /* as bytes or whole */
    uint32_t indices[MESHES][CORNERS];
} world;

static world w;
static uint32_t depth_memory[PIXELS], id_memory[PIXELS];

static void make_mesh(test_rng *r, int m)
{
    lmb_mesh *mesh = &w.mesh[m];
    for (int i = 0; i < CORNERS; ++i) {
        const float middle = i % 3 == 0 ? test_uniform(r, -1.0f, 1.0f) : w.positions[m][3 * (i - i % 3)];
        w.positions[m][3 * i] = i % 3 == 0 ? middle : middle + test_uniform(r, -0.3f, 0.3f);
        w.positions[m][3 * i + 1] = i % 3 == 0 ? test_uniform(r, -1.0f, 1.0f)
                                               : w.positions[m][3 * (i - i % 3) + 1] + test_uniform(r, -0.3f, 0.3f);
        w.positions[m][3 * i + 2] = test_uniform(r, -0.5f, 0.5f);
        w.uvs[m][2 * i] = test_uniform(r, -3.0f, 3.0f);
        w.uvs[m][2 * i + 1] = test_uniform(r, -3.0f, 3.0f);
        w.indices[m][i] = (uint32_t)i;
        for (int c = 0; c < 4; ++c) {
            w.colours[m][4 * i + c] = (uint16_t)test_random(r);
        }
        w.normals[m][2 * i] = (int16_t)test_random(r);
        w.normals[m][2 * i + 1] = (int16_t)test_random(r);
    }
    memset(mesh, 0, sizeof *mesh);
    mesh->positions = w.positions[m];
    mesh->indices = w.indices[m];
    mesh->index_format = LMB_INDEX_U32;
    mesh->vertex_count = CORNERS;
    mesh->triangle_count = TRIANGLES;
    mesh->uvs = m % 2 == 0 ? w.uvs[m] : NULL;
    mesh->normals = m < 2 ? w.normals[m] : NULL;
    mesh->colours = m == 1 || m == 2 ? (const uint8_t *)w.colours[m] : NULL;
    mesh->colour_format = m == 2 && LMB_TEXTURE_FORMATS ? LMB_COLOUR_RGBA16 : LMB_COLOUR_RGBA8;
}

static void make_world(test_rng *r)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const lmb_vec3 eye = {0, 0, 3}, target = {0, 0, 0}, up = {0, 1, 0};
    memset(&w, 0, sizeof w);
    for (size_t i = 0; i < sizeof w.texels; ++i) {
        w.texels[i] = (uint8_t)test_random(r);
    }
    for (int t = 0; t < 2; ++t) {
        w.texture[t].texels = w.texels;
        w.texture[t].width = w.texture[t].height = TEXELS;
        w.texture[t].levels = t == 0 ? 4 : 1;
        w.texture[t].filter = t == 0 ? LMB_TRILINEAR : LMB_BILINEAR;
    }
    for (int m = 0; m < MESHES; ++m) {
        make_mesh(r, m);
        w.material[m].albedo[0] = w.material[m].albedo[1] = w.material[m].albedo[2] = w.material[m].alpha = 0.9f;
        w.material[m].texture = m == 3 ? 1 : 0; /* of a mesh without coordinates: the first texel */
        w.material[m].flags = LMB_DOUBLE_SIDED;
        w.instance[m].to_world = unit;
        w.instance[m].mesh = w.instance[m].material = (uint32_t)m;
        w.instance[m].first_id = 1u + (uint32_t)m * TRIANGLES;
    }
    w.scene.meshes = w.mesh;
    w.scene.materials = w.material;
    w.scene.instances = w.instance;
    w.scene.textures = w.texture;
    w.scene.mesh_count = w.scene.material_count = w.scene.instance_count = MESHES;
    w.scene.texture_count = 2;
    lmb_scene_bounds(&w.scene.bounds_min, &w.scene.bounds_max, &w.scene);
    CHECK(lmb_scene_check(&w.scene) == LMB_OK);
    CHECK(lmb_view_look_at(&w.view, eye, target, up, 0.7f, FRAME, FRAME) == LMB_OK);
    w.view.near_m = 0.1f;
    w.view.far_m = 10.0f;
}

/* Draws the window's part of the frame. */
static lmb_target draw(const lmb_kernels *k, int32_t x0, int32_t y0, int32_t width, int32_t height)
{
    lmb_target t;
    memset(&t, 0, sizeof t);
    CHECK(lmb_surface_init(&t.depth, LMB_DEPTH32F, width, height, depth_memory, sizeof depth_memory) == LMB_OK);
    CHECK(lmb_surface_init(&t.id, LMB_ID32, width, height, id_memory, sizeof id_memory) == LMB_OK);
    t.x0 = x0;
    t.y0 = y0;
    lmb_surface_clear(&t.depth);
    lmb_surface_clear(&t.id);
    CHECK(lmb_draw(&t, k, &w.view, &w.scene, 1, MESHES * TRIANGLES, 0, NULL) == LMB_OK);
    return t;
}

/* Compares all planes of pixel k in two tiles. */
static int same_pixel(const lmb_tile *a, const lmb_tile *b, int k)
{
    int same =
        a->id[k] == b->id[k] && a->depth[k] == b->depth[k] && a->uv[0][k] == b->uv[0][k] && a->uv[1][k] == b->uv[1][k];
    for (int c = 0; c < 3; ++c) {
        same = same && a->position[c][k] == b->position[c][k] && a->face[c][k] == b->face[c][k] &&
               a->normal[c][k] == b->normal[c][k] && a->albedo[c][k] == b->albedo[c][k];
    }
    return same;
}

static lmb_tile whole[PIXELS / LMB_TILE_PIXELS];

static void resolve_whole(const lmb_kernels *k)
{
    const lmb_target t = draw(k, 0, 0, FRAME, FRAME);
    for (int i = 0; i < PIXELS / LMB_TILE_PIXELS; ++i) {
        const int32_t x = i % (FRAME / LMB_TILE) * LMB_TILE, y = i / (FRAME / LMB_TILE) * LMB_TILE;
        CHECK(lmb_resolve_tile(&whole[i], k, &w.view, &w.scene, &t, x, y) == LMB_OK);
    }
}

/* A tile's pixels inside a window equal the frame's, those outside are empty; likewise for resolving only colours. */
static void check_tile(const lmb_kernels *k, const lmb_target *t, int32_t x, int32_t y)
{
    static lmb_tile tile, only;
    const lmb_tile *want = &whole[y / LMB_TILE * (FRAME / LMB_TILE) + x / LMB_TILE];
    int wrong = 0;
    memset(&only, 0xa5, sizeof only);
    CHECK(lmb_resolve_tile(&tile, k, &w.view, &w.scene, t, x, y) == LMB_OK);
    CHECK(lmb_resolve_albedo(&only, k, &w.view, &w.scene, t, x, y) == LMB_OK);
    for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
        const int inside = x + i % LMB_TILE < t->x0 + t->depth.width && y + i / LMB_TILE < t->y0 + t->depth.height;
        wrong += inside ? !same_pixel(&tile, want, i) : tile.id[i] != 0 || tile.depth[i] != 0.0f;
        for (int c = 0; c < 3; ++c) {
            wrong += only.albedo[c][i] != tile.albedo[c][i];
        }
        wrong += only.id[i] != tile.id[i];
    }
    CHECK_MSG(wrong == 0, "%s: %d values of tile %d %d differ in a window at %d %d", lmb_kernels_name(k), wrong, (int)x,
              (int)y, (int)t->x0, (int)t->y0);
}

static void test_windows(const lmb_kernels *k, test_rng *r)
{
    resolve_whole(k);
    for (int n = 0; n < 12; ++n) {
        const int32_t x0 = (int32_t)(test_random(r) % 6u) * LMB_TILE, y0 = (int32_t)(test_random(r) % 6u) * LMB_TILE;
        const int32_t width = 1 + (int32_t)(test_random(r) % (uint32_t)(FRAME - x0));
        const int32_t height = 1 + (int32_t)(test_random(r) % (uint32_t)(FRAME - y0));
        const lmb_target t = draw(k, x0, y0, width, height);
        for (int32_t y = y0; y < y0 + height; y += LMB_TILE) {
            for (int32_t x = x0; x < x0 + width; x += LMB_TILE) {
                check_tile(k, &t, x, y);
            }
        }
    }
}

/* Ids of triangles that no longer exist, and ids past the scene, give nothing and leave their neighbours unchanged. */
static void test_bad_ids(const lmb_kernels *k)
{
    static lmb_tile tile;
    resolve_whole(k);
    const lmb_target t = draw(k, 0, 0, FRAME, FRAME);
    for (int i = 0; i < CORNERS; i += 5) {
        w.indices[1][i] = CORNERS + (uint32_t)i;
    }
    for (int i = 0; i < PIXELS; i += 7) {
        id_memory[i] = id_memory[i] != 0 ? 0x80000000u + (uint32_t)i : 0;
    }
    for (int n = 0; n < PIXELS / LMB_TILE_PIXELS; ++n) {
        int wrong = 0;
        CHECK(lmb_resolve_tile(&tile, k, &w.view, &w.scene, &t, whole[n].x, whole[n].y) == LMB_OK);
        for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
            const uint32_t triangle = whole[n].id[i] - w.instance[1].first_id;
            int gone = (n * LMB_TILE_PIXELS + i) % 7 == 0;
            for (uint32_t c = 0; triangle < TRIANGLES && c < 3; ++c) {
                gone |= (3 * triangle + c) % 5 == 0;
            }
            wrong += gone ? tile.id[i] != 0 || tile.depth[i] != 0.0f || tile.albedo[0][i] != 0.0f
                          : !same_pixel(&tile, &whole[n], i);
        }
        CHECK_MSG(wrong == 0, "%s: %d pixels of tile %d", lmb_kernels_name(k), wrong, n);
    }
}

#if LMB_TEXTURE_FORMATS
/* 16-bit colours are squares, so dark ones keep their ratios: these are the sRGB codes 1 and 2, and white. */
static void test_wide_colours(const lmb_kernels *k)
{
    static const uint16_t code[4] = {1142, 1615, 65535, 65535};
    int seen = 0, wrong = 0;
    w.material[2].texture = -1;
    for (int i = 0; i < CORNERS; ++i) {
        memcpy(w.colours[2] + 4 * i, code, sizeof code);
    }
    resolve_whole(k);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_tile *t = &whole[i / LMB_TILE_PIXELS];
        const int at = i % LMB_TILE_PIXELS;
        if (t->id[at] - w.instance[2].first_id < TRIANGLES) {
            ++seen;
            wrong += fabsf(t->albedo[0][at] / 0.9f - 0.0003035f) > 4e-7f ||
                     fabsf(t->albedo[1][at] / 0.9f - 0.000607f) > 6e-7f || fabsf(t->albedo[2][at] - 0.9f) > 1e-6f;
        }
    }
    CHECK_MSG(seen > 50 && wrong == 0, "%s: %d of %d", lmb_kernels_name(k), wrong, seen);
}
#endif

/* NaN and infinite coordinates: the tile is the same on every backend. */
static void test_wild_coordinates(const lmb_kernels *k)
{
    const float wild[4] = {NAN, INFINITY, -INFINITY, 3e38f};
    for (int i = 0; i < CORNERS * 2; i += 3) {
        w.uvs[0][i] = wild[i % 4];
    }
    resolve_whole(k);
    for (int n = 0; n < PIXELS / LMB_TILE_PIXELS; ++n) {
        for (int i = 0; i < 2 * LMB_TILE_PIXELS; ++i) {
            CHECK(whole[n].uv[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS] >= -8.0f &&
                  whole[n].uv[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS] <= 8.0f);
        }
    }
}

/* One corner has a colour, the others none, and the edge between the others passes through pixel centres: rounding
 * takes no pixel below 0 or above 1. */
static void test_colours(const lmb_kernels *k, test_rng *r)
{
    uint8_t colours[12] = {77, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255};
    int on_edge = 0;
    make_world(r);
    memset(w.indices[1] + 3, 0, sizeof w.indices[1] - 3 * sizeof w.indices[1][0]);
    for (int m = 0; m < MESHES; m += m == 0 ? 2 : 1) {
        memset(w.indices[m], 0, sizeof w.indices[m]);
    }
    for (int turn = 0; turn < 100; ++turn) {
        const float side = test_uniform(r, 0.3f, 0.8f), way = turn % 2 ? 1.0f : -1.0f;
        const float at[9] = {side * way, side * way, test_uniform(r, -1, 1), side,  -side, test_uniform(r, -1, 1),
                             -side,      side,       test_uniform(r, -1, 1)};
        colours[0] = (uint8_t)(1 + turn);
        memcpy(w.colours[1], colours, sizeof colours);
        memcpy(w.positions[1], at, sizeof at);
        resolve_whole(k);
        for (int i = 0; i < PIXELS; ++i) {
            const lmb_tile *tile = &whole[i / LMB_TILE_PIXELS];
            const float a = tile->albedo[0][i % LMB_TILE_PIXELS];
            CHECK_MSG(a >= 0.0f && a <= 1.0f + 1e-6f, "%s: %g", lmb_kernels_name(k), (double)a);
            on_edge += tile->id[i % LMB_TILE_PIXELS] != 0 && a < 1e-6f;
        }
    }
    CHECK(on_edge > 100);
}

/* Three corners with one code give code / 255, rounded once, whatever the backend. */
static void test_codes(const lmb_kernels *k, test_rng *r)
{
    int seen = 0, wrong = 0;
    make_world(r);
    for (int m = 0; m < MESHES; ++m) {
        w.material[m].texture = -1;
        w.material[m].albedo[0] = 1.0f;
        w.mesh[m].colour_format = LMB_COLOUR_RGBA8;
    }
    for (int code = 0; code < 256; ++code) {
        memset(w.colours, code, sizeof w.colours);
        resolve_whole(k);
        for (int i = 0; i < PIXELS; ++i) {
            const lmb_tile *tile = &whole[i / LMB_TILE_PIXELS];
            const uint32_t id = tile->id[i % LMB_TILE_PIXELS];
            if (id != 0 && w.mesh[(id - 1) / TRIANGLES].colours != NULL) {
                wrong += tile->albedo[0][i % LMB_TILE_PIXELS] != (float)code / 255.0f;
                ++seen;
            }
        }
    }
    CHECK(seen > 256 && wrong == 0);
}

/* If a ray lies in a triangle's plane, edge-on, it meets the plane no farther than the triangle's last corner, even if
 * the eye lies in this plane. A ray through the triangle meets it at the exact distance. */
static void test_edge_on(void)
{
    const lmb_vec3 back = {0, 0, 1}, floor[3] = {{0, -1, -2}, {1, -1, -2}, {0, -1, -3}},
                   turned[3] = {{0, -1, -2}, {0, -1, -3}, {1, -1, -2}};
    lmb_rays rays;
    lmb_plane plane;
    float b1 = -1.0f, b2 = -1.0f;
    memset(&rays, 0, sizeof rays);
    rays.back = back;
    rays.direction = mul3(back, -1.0f);
    rays.ry.y = -0.25f;
    rays.near_m = 0.5f;
    rays.perspective = 1;
    for (int i = 0; i < 2; ++i) {
        lmb_resolve_plane(&plane, i == 0 ? floor : turned, &rays);
        CHECK(plane.w_min == 2.0f && plane.w_max == 3.0f);
        lmb_resolve_point(&b1, &b2, &plane, &rays, 0.0f, 0.0f);
        const float along = i == 0 ? b2 : b1, across = i == 0 ? b1 : b2;
        CHECK_MSG(across == 0.0f && (along == 0.0f || along == 1.0f), "%g %g", (double)b1, (double)b2);
        lmb_resolve_point(&b1, &b2, &plane, &rays, 0.0f, 1.6f); /* 1 down at 2.5 */
        CHECK_MSG(fabsf((i == 0 ? b2 : b1) - 0.5f) < 1e-6f, "%g %g", (double)b1, (double)b2);
    }
    rays.eye.y = -1.0f;
    lmb_resolve_plane(&plane, floor, &rays);
    lmb_resolve_point(&b1, &b2, &plane, &rays, 0.0f, 0.0f);
    CHECK_MSG(b1 == 0.0f && b2 == 0.0f, "%g %g", (double)b1, (double)b2);
}

void test_resolve(void)
{
    const lmb_kernels *k;
    test_edge_on();
    for (int32_t i = 0; (k = lmb_kernels_at(i)) != NULL; ++i) {
        test_rng r = {71};
        make_world(&r);
        test_windows(k, &r);
#if LMB_TEXTURE_FORMATS
        test_wide_colours(k);
#endif
        test_bad_ids(k);
        make_world(&r);
        test_wild_coordinates(k);
        test_colours(k, &r);
        test_codes(k, &r);
    }
}
