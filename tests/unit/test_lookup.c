/* test_lookup.c: triangles by id, vertices in each stream format, opacity at pixels, texels, names of backends. */
#include <lambent/lambent.h>

#include <math.h>
#include <string.h>

#include "../../src/raster/triangle.h"
#include "../test.h"

void test_lookup(void);

enum { WIDE = 24, HIGH = 16, SIDE = 8 };

static const float corners[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
static const int16_t short_corners[4][4] = {{-100, -100, 0, 0}, {100, -100, 0, 0}, {100, 100, 0, 0}, {-100, 100, 0, 0}};
static const float uvs[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
static const uint16_t short_uvs[4][2] = {{0, 65535}, {65535, 65535}, {65535, 0}, {0, 0}};
static const uint8_t colours[4][4] = {{255, 0, 51, 255}, {255, 0, 51, 255}, {0, 255, 51, 51}, {0, 255, 51, 51}};
static const uint16_t short_indices[6] = {0, 1, 2, 0, 2, 3};
static const uint32_t indices[6] = {0, 1, 2, 0, 2, 9}; /* the last one is outside */
static int16_t normals[4][2];
static uint8_t texels[SIDE * SIDE * 4];
static lmb_texture texture = {texels, SIDE, SIDE, 1, LMB_WRAP_CLAMP, LMB_WRAP_CLAMP, LMB_BILINEAR, LMB_TEXELS_RGBA8};
static lmb_material materials[2] = {{.albedo = {1, 1, 1}, .alpha = 0.5f, .texture = 0},
                                    {.albedo = {1, 1, 1}, .alpha = 1, .texture = -1}};
static lmb_mesh meshes[3];
static lmb_instance instances[3] = {
    {.to_world = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, .first_id = 1},
    {.to_world = {{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, -5, 1}}, .mesh = 1, .material = 1, .first_id = 3},
    {.to_world = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, .mesh = 2, .material = 1, .first_id = 5}};
static lmb_scene scene;

static void make(void)
{
    memset(meshes, 0, sizeof meshes);
    memset(&scene, 0, sizeof scene);
    for (int i = 0; i < 4; ++i) {
        lmb_octahedral_encode(normals[i], (lmb_vec3){0, 0, 1});
    }
    for (int i = 0; i < SIDE * SIDE; ++i) { /* alpha falls from left to right */
        texels[4 * i] = 188;
        texels[4 * i + 1] = 128;
        texels[4 * i + 3] = (uint8_t)(255 - 32 * (i % SIDE));
    }
    meshes[0] = (lmb_mesh){.positions = corners, .normals = normals[0], .uvs = uvs, .colours = colours[0],
                           .indices = short_indices, .vertex_count = 4, .triangle_count = 2,
                           .index_format = LMB_INDEX_U16};
    meshes[1] = (lmb_mesh){.positions = short_corners, .uvs = short_uvs, .indices = indices, .vertex_count = 4,
                           .triangle_count = 2, .index_format = LMB_INDEX_U32, .position_format = LMB_POSITION_I16,
                           .uv_format = LMB_UV_U16, .position_scale = {0.01f, 0.01f, 0.01f},
                           .position_offset = {0, 3, 0}, .uv_scale = {2, 4}};
    meshes[2] = (lmb_mesh){.positions = corners, .vertex_count = 4, .triangle_count = 1};
    scene = (lmb_scene){.meshes = meshes, .materials = materials, .textures = &texture, .instances = instances,
                        .mesh_count = 3, .material_count = 2, .texture_count = 1, .instance_count = 3};
    lmb_scene_bounds(&scene.bounds_min, &scene.bounds_max, &scene);
    CHECK(lmb_scene_check(&scene) == LMB_OK && lmb_scene_triangles(&scene) == 5);
}

static int is_at(lmb_vec3 v, float x, float y, float z)
{
    return fabsf(v.x - x) < 1e-5f && fabsf(v.y - y) < 1e-5f && fabsf(v.z - z) < 1e-5f;
}

static void test_triangles(void)
{
    lmb_triangle t;
    lmb_vec3 normal = {0, 0, 0};
    float area = 0.0f;
    CHECK(lmb_triangle_fetch(&t, &scene, 2) && t.id == 2 && t.instance == &instances[0] && t.mesh == &meshes[0]);
    CHECK(t.vertex[0] == 0 && t.vertex[1] == 2 && t.vertex[2] == 3 && t.material == &materials[0]);
    CHECK(lmb_triangle_shape(&normal, &area, &t) && is_at(normal, 0, 0, 1) && fabsf(area - 2.0f) < 1e-6f);
    CHECK(lmb_triangle_fetch(&t, &scene, 3) && t.instance == &instances[1] && t.material == &materials[1]);
    CHECK(is_at(t.corner[0], -2, 4, -5) && is_at(t.corner[2], 2, 8, -5)); /* 2 * (y + 3) */
    CHECK(lmb_triangle_shape(&normal, &area, &t) && fabsf(area - 8.0f) < 1e-4f);
    CHECK(!lmb_triangle_fetch(&t, &scene, 4)); /* an index outside the mesh */
    CHECK(lmb_triangle_fetch(&t, &scene, 5) && t.vertex[2] == 2); /* without indices */
    CHECK(!lmb_triangle_fetch(&t, &scene, 0) && !lmb_triangle_fetch(&t, &scene, 6));
    CHECK(!lmb_triangle_fetch(NULL, &scene, 1) && !lmb_triangle_fetch(&t, NULL, 1));
    t.corner[1] = t.corner[0];
    CHECK(!lmb_triangle_shape(&normal, &area, &t) && fabsf(area - 8.0f) < 1e-4f); /* as it was */
    t.corner[1].x = INFINITY;
    CHECK(!lmb_triangle_shape(&normal, &area, &t) && !lmb_triangle_shape(&normal, &area, NULL));
}

static void test_vertices(void)
{
    lmb_vertex v, kept;
    CHECK(lmb_mesh_vertex(&v, &meshes[0], 2) && is_at(v.position, 1, 1, 0) && is_at(v.normal, 0, 0, 1));
    CHECK(v.uv[0] == 1 && v.uv[1] == 0 && v.colour[0] == 0 && v.colour[1] == 1 && v.colour[3] == 0.2f);
    CHECK(lmb_mesh_vertex(&v, &meshes[1], 1) && is_at(v.position, 1, 2, 0) && is_at(v.normal, 0, 0, 0));
    CHECK(v.uv[0] == 2 && v.uv[1] == 4 && v.colour[0] == 1 && v.colour[3] == 1);
    kept = v;
    CHECK(!lmb_mesh_vertex(&v, &meshes[0], 4) && memcmp(&v, &kept, sizeof v) == 0);
    CHECK(!lmb_mesh_vertex(NULL, &meshes[0], 0) && !lmb_mesh_vertex(&v, NULL, 0));
    CHECK(lmb_mesh_index(&meshes[0], 5) == 3 && lmb_mesh_index(&meshes[1], 5) == 9 && lmb_mesh_index(&meshes[2], 2) == 2);
    CHECK(lmb_mesh_index(&meshes[0], 6) == UINT32_MAX && lmb_mesh_index(&meshes[2], 3) == UINT32_MAX);
    CHECK(lmb_mesh_index(NULL, 0) == UINT32_MAX);
}

#if LMB_LIVE
/* A triangle is flat if its three normals are equal, or if its mesh has none. */
static void test_flat(void)
{
    const int16_t kept[2] = {normals[1][0], normals[1][1]};
    CHECK(lmb_triangle_is_flat(&scene, 1) && lmb_triangle_is_flat(&scene, 2) && lmb_triangle_is_flat(&scene, 3));
    CHECK(!lmb_triangle_is_flat(&scene, 0) && !lmb_triangle_is_flat(&scene, 4));
    lmb_octahedral_encode(normals[1], (lmb_vec3){0.6f, 0, 0.8f}); /* a corner of triangle 1 */
    CHECK(!lmb_triangle_is_flat(&scene, 1) && lmb_triangle_is_flat(&scene, 2));
    memcpy(normals[1], kept, sizeof kept);
    lmb_octahedral_encode(normals[2], (lmb_vec3){0.6f, 0, 0.8f}); /* the last corner of 1, and one of 2 */
    CHECK(!lmb_triangle_is_flat(&scene, 1) && !lmb_triangle_is_flat(&scene, 2));
    memcpy(normals[2], kept, sizeof kept);
    materials[0].normal_scale = 0.5f;
    CHECK(!lmb_triangle_is_flat(&scene, 1));
    materials[0].normal_scale = 0.0f;
}
#else
static void test_flat(void) { }
#endif

/* The texture's alpha where a pixel sees the square, by hand: material x texture x vertices. */
static float alpha_by_hand(const lmb_view *view, int32_t x, int32_t y)
{
    const float s = (2.0f * ((float)x + 0.5f) / WIDE - 1.0f) * view->half_width * 4.0f;
    const float t = (1.0f - 2.0f * ((float)y + 0.5f) / HIGH) * view->half_height * 4.0f;
    const float u = 0.5f + 0.5f * fminf(fmaxf(s, -1.0f), 1.0f), v = 0.5f + 0.5f * fminf(fmaxf(t, -1.0f), 1.0f);
    const float at = fminf(fmaxf(u * SIDE - 0.5f, 0.0f), SIDE - 1.0f);
    return 0.5f * ((255.0f - 32.0f * at) / 255.0f) * (1.0f - 0.8f * v);
}

static void test_alpha(void)
{
    lmb_view view;
    int seen = 0;
    CHECK(lmb_view_look_at(&view, (lmb_vec3){0, 0, 4}, (lmb_vec3){0, 0, 0}, (lmb_vec3){0, 1, 0}, 0.6f, WIDE, HIGH) ==
          LMB_OK);
    for (int32_t y = 0; y < HIGH; ++y) {
        for (int32_t x = 0; x < WIDE; ++x) {
            const float s = (2.0f * ((float)x + 0.5f) / WIDE - 1.0f) * view.half_width * 4.0f;
            const float t = (1.0f - 2.0f * ((float)y + 0.5f) / HIGH) * view.half_height * 4.0f;
            const uint32_t id = s >= t ? 1 : 2; /* below or above the diagonal */
            if (fabsf(s) < 1.0f && fabsf(t) < 1.0f) {
                const float a = lmb_triangle_alpha(&view, &scene, id, x, y), exact = alpha_by_hand(&view, x, y);
                CHECK_MSG(fabsf(a - exact) < 1e-4f, "(%d, %d): %g, by hand %g", (int)x, (int)y, (double)a, (double)exact);
                materials[0].flags = LMB_ALPHA_MASK;
                const float masked = lmb_triangle_alpha(&view, &scene, id, x, y);
                CHECK_MSG(fabsf(masked - exact) < 1e-4f, "(%d, %d): %g of a mask", (int)x, (int)y, (double)masked);
                materials[0].flags = 0;
                ++seen;
            }
        }
    }
    CHECK(seen > 60);
    CHECK(lmb_triangle_alpha(&view, &scene, 5, 0, 0) == 1.0f); /* opaque, and beside the pixel */
    CHECK(lmb_triangle_alpha(&view, &scene, 4, 0, 0) == 0.0f && lmb_triangle_alpha(&view, &scene, 1, WIDE, 0) == 0.0f);
    CHECK(lmb_triangle_alpha(&view, &scene, 1, 0, -1) == 0.0f && lmb_triangle_alpha(&view, NULL, 1, 0, 0) == 0.0f);
    CHECK(lmb_triangle_alpha(NULL, &scene, 1, 0, 0) == 0.0f);
    view.frame_width = INT32_MAX; /* no frame: nothing overflows */
    CHECK(lmb_triangle_alpha(&view, &scene, 1, INT32_MAX - 1, 0) == 0.0f);
}

static void test_texels(void)
{
    static const lmb_texture none;
    float out[4] = {1, 1, 1, 1};
    lmb_texture_sample(out, &texture, 0.5f, 0.5f, 0.0f);
    CHECK(fabsf(out[0] - 0.5029f) < 1e-3f && fabsf(out[1] - 0.2159f) < 1e-3f && out[2] == 0.0f);
    CHECK(fabsf(out[3] - (255.0f - 112.0f) / 255.0f) < 1e-5f);
    lmb_normal_map_sample(out, &texture, 0.5f, 0.5f, 0.0f);
    CHECK(fabsf(0.5f + 0.5f * out[1] - 128.0f / 255.0f) < 1e-5f && out[2] == -1.0f);
    lmb_texture_sample(out, &none, 0.5f, 0.5f, 0.0f);
    CHECK(out[0] == 0.0f && out[3] == 0.0f);
    out[0] = 1.0f;
    lmb_texture_sample(out, NULL, 0.5f, 0.5f, 0.0f);
    CHECK(out[0] == 0.0f);
    CHECK(lmb_srgb_encode(0.5029f) == 188 && lmb_srgb_encode(-1.0f) == 0 && lmb_srgb_encode(NAN) == 0);
    CHECK(lmb_srgb_encode(INFINITY) == 255 && lmb_srgb_encode(1.0f) == 255);
}

/* All backends of the build, in the order of those that run here. */
static void test_backends(void)
{
    const char *name, *last = "";
    int32_t here = 0;
    for (int32_t i = 0; (name = lmb_kernels_built(i)) != NULL; ++i) {
        const lmb_kernels *k = lmb_kernels_named(name);
        CHECK(k == NULL || k == lmb_kernels_at(here++));
        last = name;
    }
    CHECK(here > 0 && lmb_kernels_at(here) == NULL && strcmp(last, "scalar") == 0 && lmb_kernels_built(-1) == NULL);
}

void test_lookup(void)
{
    make();
    test_triangles();
    test_vertices();
    test_flat();
    test_alpha();
    test_texels();
    test_backends();
}
