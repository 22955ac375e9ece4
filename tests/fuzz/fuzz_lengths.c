/* fuzz_lengths.c: lengths of arrays and memory of public calls, from their headers. */
#include "fuzz_calls.h"

#if FUZZ_CALLS

#include <string.h>

#define W(i)       ((int32_t)(uint32_t)(uint64_t)a[i].whole)
#define U(i)       ((uint32_t)(uint64_t)a[i].whole)
#define S(i, type) ((const type *)a[i].memory)

static size_t within(int64_t n, int64_t max, size_t each) { return n < 0 ? 0 : (size_t)(n < max ? n : max) * each; }
static size_t map_of(const lmb_probe_table *t)
{
    return t == NULL ? 0 : 3 * sizeof(float) * (size_t)t->width * (size_t)t->height;
}
/* Assumes that source and destination are the same. */
static size_t line_of(const lmb_probe_blur *b)
{
    return b == NULL ? 0 : (4 + (size_t)b->height) * sizeof(float) * (size_t)b->width;
}
static size_t cube_of(int32_t n, int32_t max)
{
    return n < 1 || n > max ? 0 : 18 * sizeof(float) * (size_t)n * (size_t)n;
}

static size_t two_maps(const argument *a)
{
    const int32_t faces = a[1].memory && a[2].memory ? lmb_shadow_map_faces(a[1].memory, a[2].memory) : 0;
    return 2 * lmb_shadow_map_bytes(faces, W(3), LMB_ID32);
}

static size_t shadow_map(const argument *a)
{
    const int32_t faces = a[1].memory && a[2].memory ? lmb_shadow_map_faces(a[1].memory, a[2].memory) : 0;
    return lmb_shadow_map_bytes(faces, W(3), W(4));
}

/* Bytes that the call `of` needs: `memory`, `data` and plain arrays. */
#define LENGTH(of, name, bytes) static size_t of##_##name(const argument *a) { (void)a; return bytes; }
LENGTH(lmb_points_init, memory, lmb_points_bytes(U(1), U(2)))
LENGTH(lmb_lattice_init, memory, lmb_lattice_bytes(W(1), W(2)))
LENGTH(lmb_live_init, memory, lmb_live_bytes(U(1), W(2), U(3)))
LENGTH(lmb_live_sky_init, memory, lmb_live_sky_bytes(U(1)))
LENGTH(lmb_elements_init, memory, lmb_elements_bytes(U(1)))
LENGTH(lmb_env_init, memory, lmb_env_bytes(W(1)))
LENGTH(lmb_many_lights_init, memory, lmb_many_lights_bytes(U(1)))
LENGTH(lmb_cloud_init, memory, a[1].memory ? lmb_cloud_bytes(S(1, lmb_pinhole)->width, S(1, lmb_pinhole)->height) : 0)
LENGTH(lmb_cloud_init, depth_m, lmb_cloud_init_memory(a) / 4)
LENGTH(lmb_planes_find, memory,
       a[1].memory ? lmb_planes_bytes(S(1, lmb_cloud)->camera.width, S(1, lmb_cloud)->camera.height) : 0)
LENGTH(lmb_real_mesh_build, memory,
       a[1].memory ? lmb_real_mesh_bytes(S(1, lmb_cloud)->camera.width, S(1, lmb_cloud)->camera.height, W(3)) : 0)
LENGTH(lmb_bvh_init, memory, lmb_bvh_bytes(U(1)))
LENGTH(lmb_world_init, memory, lmb_world_bytes(a[1].memory, W(2)))
LENGTH(lmb_probe_table_init, memory, lmb_probe_table_bytes(W(1), W(2)))
LENGTH(lmb_probe_blur_init, memory, lmb_probe_blur_bytes(a[1].memory, W(2)))
LENGTH(lmb_probe_cube_init, memory, lmb_probe_cube_bytes(W(2)))
LENGTH(lmb_frame_init, memory, lmb_frame_bytes(a[1].memory))
LENGTH(lmb_surface_init, data, lmb_surface_bytes(W(1), W(2), W(3)))
LENGTH(lmb_depth_linearize, out,
       a[2].memory ? (size_t)S(2, lmb_surface)
                         ->width *(size_t)S(2, lmb_surface)
                         ->height *(size_t)lmb_pixel_bytes(S(2, lmb_surface)->format)
                   : 0)
LENGTH(lmb_transfer_light_init, memory, lmb_transfer_light_bytes(a[1].memory))
LENGTH(lmb_pack_scene, memory, lmb_pack_bytes(a[1].memory))
LENGTH(lmb_pack_part, bytes, sizeof(size_t))
LENGTH(lmb_fixed_lay, memory, lmb_fixed_memory(a[1].memory, U(2)))
LENGTH(lmb_tree_init, memory, lmb_tree_bytes(U(1), W(2)))
LENGTH(lmb_voxels_init, memory, lmb_voxels_bytes(U(1), W(2)))
LENGTH(lmb_env_fold, rgb, W(2) < 1 || W(3) < 1 || W(2) > 8192 || W(3) > 8192 ? 0 : 12 * (size_t)W(2) * (size_t)W(3))
LENGTH(lmb_probe_remap, map, map_of(a[3].memory))
LENGTH(lmb_probe_reduce, map, map_of(a[3].memory))
LENGTH(lmb_probe_cosine, cube, cube_of(W(1), 64))
LENGTH(lmb_probe_sh, map, map_of(a[2].memory))
LENGTH(lmb_probe_sh_cube, cube, cube_of(W(1), 256))
LENGTH(lmb_probe_blur_map, out, a[4].memory ? 12 * (size_t)S(4, lmb_probe_blur)->width * (size_t)S(4, lmb_probe_blur)->height : 0)
LENGTH(lmb_probe_blur_map, map, lmb_probe_blur_map_out(a))
LENGTH(lmb_probe_blur_map, line, line_of(a[4].memory))
LENGTH(lmb_probe_halve, out, map_of(a[2].memory) / 4)
LENGTH(lmb_probe_halve, map, map_of(a[2].memory))
LENGTH(lmb_probe_map_cube, cube, cube_of(W(1), 256))
LENGTH(lmb_probe_map_cube, map, map_of(a[3].memory))
LENGTH(lmb_probe_reflect, cube, cube_of(W(1), 256))
LENGTH(lmb_probe_cube_init, planes, cube_of(W(2), 256))
LENGTH(lmb_transfer_fingerprint, moving, within(U(3), POOL_PLACES, 8))
LENGTH(lmb_texture_mips, texels, lmb_texture_bytes(W(1), W(2), W(3)))
LENGTH(lmb_normal_map_mips, texels, lmb_texture_bytes(W(1), W(2), W(3)))
#if LMB_DRAW
LENGTH(lmb_render_vertices, colours, a[3].memory ? 4 * (size_t)S(3, lmb_draw_vertices)->count : 0)
LENGTH(lmb_render_vertices, normals, a[3].memory ? 12 * (size_t)S(3, lmb_draw_vertices)->count : 0)
LENGTH(lmb_draw_light, normals, a[2].memory ? 12 * (size_t)S(2, lmb_draw_vertices)->count : 0)
#endif
static size_t any_int32_t(const argument *a) { return (void)a, sizeof(int32_t); }
static size_t any_float(const argument *a) { return (void)a, sizeof(float); }
static size_t any_place(const argument *a) { return (void)a, 3 * sizeof(int32_t); }
static size_t any_double(const argument *a) { return (void)a, sizeof(double); }

#define IS(of, name) {#of, #name, of##_##name}
static const struct {
    const char *call, *name;
    size_t (*bytes)(const argument *);
} lengths[] = {
    IS(lmb_points_init, memory),
    IS(lmb_lattice_init, memory),
    IS(lmb_live_init, memory),
    IS(lmb_live_sky_init, memory),
    IS(lmb_elements_init, memory),
    IS(lmb_env_init, memory),
    IS(lmb_many_lights_init, memory),
    IS(lmb_cloud_init, memory),
    IS(lmb_cloud_init, depth_m),
    IS(lmb_planes_find, memory),
    IS(lmb_real_mesh_build, memory),
    IS(lmb_bvh_init, memory),
    IS(lmb_world_init, memory),
    IS(lmb_probe_table_init, memory),
    IS(lmb_probe_blur_init, memory),
    IS(lmb_probe_cube_init, memory),
    IS(lmb_frame_init, memory),
    IS(lmb_surface_init, data),
    IS(lmb_depth_linearize, out),
    IS(lmb_transfer_light_init, memory),
    IS(lmb_pack_scene, memory),
    IS(lmb_pack_part, bytes),
    IS(lmb_fixed_lay, memory),
    IS(lmb_tree_init, memory),
    IS(lmb_voxels_init, memory),
    IS(lmb_env_fold, rgb),
    IS(lmb_probe_remap, map),
    IS(lmb_probe_reduce, map),
    IS(lmb_probe_cosine, cube),
    IS(lmb_probe_sh, map),
    IS(lmb_probe_sh_cube, cube),
    IS(lmb_probe_blur_map, out),
    IS(lmb_probe_blur_map, map),
    IS(lmb_probe_blur_map, line),
    IS(lmb_probe_halve, out),
    IS(lmb_probe_halve, map),
    IS(lmb_probe_map_cube, cube),
    IS(lmb_probe_map_cube, map),
    IS(lmb_probe_reflect, cube),
    IS(lmb_probe_cube_init, planes),
    IS(lmb_transfer_fingerprint, moving),
    IS(lmb_texture_mips, texels),
    IS(lmb_normal_map_mips, texels),
#if LMB_DRAW
    IS(lmb_render_vertices, colours),
    IS(lmb_render_vertices, normals),
    IS(lmb_draw_light, normals),
#endif
    {"lmb_two_maps", "memory", two_maps},
    {"lmb_shadow_map_init", "memory", shadow_map},
    {"lmb_triangle_shape", "area", any_float},
    {"lmb_fixed_look_at", "eye", any_place},
    {"lmb_fixed_look_at", "target", any_place},
    {"lmb_photo_view", "x0", any_int32_t},
    {"lmb_photo_view", "y0", any_int32_t},
    {"lmb_surface_diff", "x", any_int32_t},
    {"lmb_surface_diff", "y", any_int32_t},
    {"lmb_render_progress", "name", any_double},
};

int fuzz_length(size_t *bytes, const argument *a, const char *call, const char *name)
{
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; ++i) {
        if (strcmp(lengths[i].call, call) == 0 && strcmp(lengths[i].name, name) == 0) {
            *bytes = lengths[i].bytes(a);
            return 1;
        }
    }
    return 0;
}

#endif
