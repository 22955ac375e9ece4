/* test_bytes.c: checks every public call that returns bytes at the limits of its arguments: the true sum, or 0 if it
 * does not fit into a size_t. `make cross-bytes-i386` runs it with a 32-bit size_t. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../src/base/vec.h"
#include "../../src/frame/live_grid.h"
#include "../../src/lane/kernels.h"
#include "../test.h"

void test_bytes(void);

/* `name` is the name of the call in messages. */
static void check_sum(const char *name, size_t bytes, uint64_t truth)
{
    const size_t wanted = truth <= SIZE_MAX ? (size_t)truth : 0;
    CHECK_MSG(bytes == wanted, "%s: %lu, not %lu", name, (unsigned long)bytes, (unsigned long)wanted);
}

/* --- pictures and maps -------------------------------------------------------------------------------------------- */

static uint64_t squares(uint64_t side, uint64_t each)
{
    uint64_t sum = 0;
    for (; side > 0; side /= 2) {
        sum += side * side * each;
    }
    return sum;
}

static void test_pictures(void)
{
    const uint64_t side = LMB_MAX_SIDE, texels = side * side;
    check_sum("surface", lmb_surface_bytes(LMB_RGB32F, LMB_MAX_SIDE, LMB_MAX_SIDE), 12 * texels);
    check_sum("surface", lmb_surface_bytes(LMB_RGB32F, INT32_MAX, INT32_MAX), 0);
    check_sum("depth", lmb_depth_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE), 4 * texels);
    check_sum("map", lmb_shadow_map_bytes(6, LMB_MAX_SIDE, LMB_ID32), 48 * texels);
    check_sum("map", lmb_shadow_map_bytes(7, LMB_MAX_SIDE, LMB_ID32), 0);
    check_sum("texture", lmb_texture_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE, 14), squares(side, 4));
    check_sum("texture", lmb_texture_bytes(INT32_MAX, INT32_MAX, 1), 0);
    check_sum("texels", lmb_texture_format_bytes(LMB_TEXELS_RGB565, LMB_MAX_SIDE, LMB_MAX_SIDE, 14), squares(side, 2));
    check_sum("env", lmb_env_bytes(2048), squares(2048, 48));
    check_sum("env", lmb_env_bytes(4096), 0);
    check_sum("lattice", lmb_lattice_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE),
              texels / 64 * (sizeof(live_grid_tile) + GRID_SAMPLES * sizeof(lmb_live_sample)));
}

static void test_mixed(void)
{
    const uint64_t texels = (uint64_t)LMB_MAX_SIDE * LMB_MAX_SIDE;
    check_sum("cloud", lmb_cloud_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE), 16 * texels);
    check_sum("planes", lmb_planes_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE), 5 * texels);
    check_sum("planes", lmb_planes_bytes(LMB_MAX_SIDE + 1, LMB_MAX_SIDE), 0);
    check_sum("mesh", lmb_real_mesh_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE, 1), 96 * texels);
    check_sum("mesh", lmb_real_mesh_bytes(LMB_MAX_SIDE, LMB_MAX_SIDE, 2), 24 * texels);
}

/* --- probes ------------------------------------------------------------------------------------------------------- */

/* Sums the texels of a face with its border over all levels, starting at `side`. */
static uint64_t bordered(uint64_t side)
{
    uint64_t sum = 0;
    for (; side > 0; side /= 2) {
        sum += 6 * (side + 2) * (side + 2);
    }
    return sum;
}

static void test_probes(void)
{
    lmb_world_pictures p;
    lmb_probe_table table;
    const float ground = 0.0f;
    memset(&p, 0, sizeof p);
    memset(&table, 0, sizeof table);
    p.face_size = 4096;
    p.ground = &ground;
    p.ground_width = p.ground_height = 8192;
    check_sum("world", lmb_world_bytes(&p, LMB_WORLD_F32), 16 * (bordered(4096) + bordered(2048) + squares(8192, 1)));
    p.face_size = 4097;
    check_sum("world", lmb_world_bytes(&p, LMB_WORLD_F32), 0);
    check_sum("table", lmb_probe_table_bytes(1024, 512),
              4 * (3 * 1024 * 512 / 2 + 512 + 9 * 1024 + 15 * 512 + 512 * 256 + 3 * LMB_PROBE_TEXELS +
                   LMB_PROBE_BORDERED / 2));
    check_sum("table", lmb_probe_table_bytes(2048, 1024), 0);
    check_sum("cube", lmb_probe_cube_bytes(256), 6 * 258 * 258 * 16);
    check_sum("cube", lmb_probe_cube_bytes(257), 0);
    table.width = 1024;
    table.height = 512;
    check_sum("blur", lmb_probe_blur_bytes(&table, 2), 4 * 2 * 512 * 2048);
    table.width = 40000; /* no real table: the sum exceeds 2^32 */
    table.height = 20000;
    check_sum("blur", lmb_probe_blur_bytes(&table, 2), 0);
    table.width = table.height = -40000;
    check_sum("blur", lmb_probe_blur_bytes(&table, 1), 0);
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static void test_light(void)
{
    const uint64_t cells = (uint64_t)1 << 22, most = UINT32_MAX;
    const uint64_t face = 4096 * 4096, nodes = (face - 1) / 3;
    const uint64_t tree = face * sizeof(lmb_texel) + nodes * sizeof(lmb_node) + sizeof(lmb_view) + sizeof(lmb_target);
    check_sum("many lights", lmb_many_lights_bytes(1u << 22),
              cells * sizeof(lmb_many_lights_cell) + 2 * cells * sizeof(lmb_many_lights_node) +
                  (2 * cells + 16) * LMB_MANY_LIGHTS_PLANES * 4 + 4 * 2 * cells);
    check_sum("many lights", lmb_many_lights_bytes((1u << 22) + 1), 0);
    check_sum("tree", lmb_tree_bytes(1, 4096), tree);
    check_sum("tree", lmb_tree_bytes(65535, 4096), 65535 * tree);
    check_sum("tree", lmb_tree_bytes(65536, 4096), 0);
    check_sum("elements", lmb_elements_bytes(1u << 24), tree + face * sizeof(lmb_element));
    check_sum("points", lmb_points_bytes(UINT32_MAX, LMB_MAX_SIDE),
              most * sizeof(lmb_point) + 4 * ((uint64_t)LMB_MAX_SIDE * LMB_MAX_SIDE + 1));
    check_sum("points", lmb_points_bytes(1, 65536), 0);
    check_sum("voxels", lmb_voxels_bytes(1u << 24, LMB_VOXELS_THREE), 388 * face);
    check_sum("voxels", lmb_voxels_bytes(1u << 24, LMB_VOXELS_ONE), 148 * face);
    check_sum("bvh", lmb_bvh_bytes(UINT32_MAX),
              most * sizeof(lmb_bvh_triangle) + (most / 8 + 8) * sizeof(lmb_boxes));
}

static void test_bins(void)
{
    lmb_view v;
    memset(&v, 0, sizeof v);
    v.right.x = v.up.y = v.back.z = v.half_width = v.half_height = v.near_m = 1.0f;
    v.far_m = 10.0f;
    v.frame_width = v.frame_height = LMB_MAX_FRAME;
    const size_t none = lmb_bins_bytes(&v, 0), some = lmb_bins_bytes(&v, LMB_BATCH);
    CHECK(none > 0 && some > none);
    check_sum("bins", lmb_bins_bytes(&v, UINT32_MAX), none + (uint64_t)(some - none) * (UINT32_MAX / LMB_BATCH));
}

/* --- files in place ----------------------------------------------------------------------------------------------- */

/* Counts that no file of a small machine can have. */
static void test_files(void)
{
    const uint64_t most = UINT32_MAX;
    const uint32_t words[4] = {0, 0, 0, 0};
    lmb_transfer t;
    lmb_pack p;
    lmb_scene s;
    void *memory[4];
    memset(&t, 0, sizeof t);
    memset(&p, 0, sizeof p);
    check_sum("transfer", lmb_transfer_light_bytes(&t), 0);
    t.section[0] = words;
    check_sum("transfer", lmb_transfer_light_bytes(&t), LMB_TRANSFER_PARTS * sizeof(lmb_transfer_part));
    t.nodes = UINT32_MAX;
    for (int i = 0; i < LMB_TRANSFER_SECTIONS; ++i) {
        t.count[i] = UINT32_MAX;
    }
    check_sum("transfer", lmb_transfer_light_bytes(&t),
              most * (36 + 8 + 12 + 36 + sizeof(lmb_transfer_coarse)) + LMB_TRANSFER_PARTS * sizeof(lmb_transfer_part));
    p.data = words;
    check_sum("pack", lmb_pack_bytes(&p), 0);
    for (int i = 0; i < 5; ++i) { /* a 32-bit sum would be a few hundred bytes */
        static const int kind[5] = {LMB_PACK_MESHES, LMB_PACK_TEXTURES, LMB_PACK_MATERIALS, LMB_PACK_INSTANCES,
                                    LMB_PACK_LIGHTS};
        p.count[kind[i]] = (1u << 31) + 1;
    }
    check_sum("pack", lmb_pack_bytes(&p),
              (((uint64_t)1 << 31) + 1) * (sizeof(lmb_mesh) + sizeof(lmb_texture) + sizeof(lmb_material) +
                                           sizeof(lmb_instance) + sizeof(lmb_light)));
    CHECK(lmb_pack_scene(&s, &p, memory, sizeof memory) == LMB_ERR_CAPACITY);
}

/* --- a frame ------------------------------------------------------------------------------------------------------ */

/* With maps of 3 GiB per light, the minimum for the frame. */
static void test_frame(void)
{
    static lmb_light light[LMB_MAX_LIGHTS];
    lmb_scene scene;
    lmb_frame_settings set;
    memset(&scene, 0, sizeof scene);
    memset(&set, 0, sizeof set);
    scene.lights = light;
    scene.bounds_max.x = scene.bounds_max.y = scene.bounds_max.z = 1.0f;
    set.kernels = picked_kernels();
    set.scene = &scene;
    set.show = LMB_SHOW_DIRECT;
    set.shadow_map = LMB_MAX_SIDE;
    set.id_format = LMB_ID32;
    lmb_view_look_at(&set.view, vec3(0, 0, 2), vec3(0, 0, 0), vec3(0, 1, 0), 1.0f, 64, 64);
    const size_t none = lmb_frame_bytes(&set);
    CHECK(none > 0 && none < 1u << 24);
    for (uint32_t i = 0; i < LMB_MAX_LIGHTS; ++i) {
        light[i].kind = LMB_LIGHT_POINT;
        light[i].intensity[0] = 1.0f;
    }
    for (scene.light_count = 1; scene.light_count <= LMB_MAX_LIGHTS; ++scene.light_count) {
        const uint64_t maps = (uint64_t)48 * LMB_MAX_SIDE * LMB_MAX_SIDE * scene.light_count;
        check_sum("frame", lmb_frame_bytes(&set), none + maps);
    }
}

void test_bytes(void)
{
    test_pictures();
    test_mixed();
    test_probes();
    test_light();
    test_bins();
    test_files();
    test_frame();
}
