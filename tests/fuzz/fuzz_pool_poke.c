/* fuzz_pool_poke.c: one odd number, or one pointer, in a public struct between calls. */
#include "fuzz_pool.h"

#if FUZZ_CALLS

#include <stddef.h>
#include <string.h>

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

#define WHOLE(type, member) {#type "." #member, #type, offsetof(type, member), sizeof(((type *)0)->member), 0}
#define REAL(type, member)  {#type "." #member, #type, offsetof(type, member), sizeof(((type *)0)->member), 1}
static const struct {
    const char *name, *type;
    size_t at, bytes;
    int is_real;
} numbers[] = {
    REAL(lmb_view, eye.x), REAL(lmb_view, right.x), REAL(lmb_view, up.y), REAL(lmb_view, back.z),
    REAL(lmb_view, half_width), REAL(lmb_view, half_height), REAL(lmb_view, near_m), REAL(lmb_view, far_m),
    WHOLE(lmb_view, kind), WHOLE(lmb_view, frame_width), WHOLE(lmb_view, frame_height), WHOLE(lmb_view, sample_x),
    WHOLE(lmb_view, sample_y), WHOLE(lmb_target, x0), WHOLE(lmb_target, y0), REAL(lmb_light, position.x),
    REAL(lmb_light, position.y), REAL(lmb_light, direction.x), REAL(lmb_light, direction.y),
    REAL(lmb_light, intensity[0]), REAL(lmb_light, cos_inner), REAL(lmb_light, cos_outer), WHOLE(lmb_light, kind),
    REAL(lmb_light, range),
    WHOLE(lmb_grouping, method), WHOLE(lmb_grouping, block), WHOLE(lmb_grouping, groups),
    REAL(lmb_grouping, neighbour_m), REAL(lmb_grouping, join), REAL(lmb_grouping, reach), REAL(lmb_grouping, cosine),
    WHOLE(lmb_grouping, flags), WHOLE(lmb_grouping, thin), WHOLE(lmb_grouping, neighbour_cells),
    REAL(lmb_grouping, radius), WHOLE(lmb_grouping, zones), REAL(lmb_cut_params, error),
    REAL(lmb_cut_params, visibility), REAL(lmb_cut_params, floor), WHOLE(lmb_cut_params, conservative),
    REAL(lmb_cut_params, lower), WHOLE(lmb_occluder, kind), WHOLE(lmb_occluder, steps),
    REAL(lmb_many_lights_query, error), WHOLE(lmb_many_lights_query, each), WHOLE(lmb_many_lights_query, by_seen),
    REAL(lmb_pinhole, fx), REAL(lmb_pinhole, fy), REAL(lmb_pinhole, cx), REAL(lmb_pinhole, cy),
    WHOLE(lmb_pinhole, width), WHOLE(lmb_pinhole, height), REAL(lmb_axes, right.x), REAL(lmb_axes, up.y),
    REAL(lmb_axes, back.z), REAL(lmb_axes, back.x), REAL(lmb_world_pictures, ground_x),
    REAL(lmb_world_pictures, ground_z), REAL(lmb_world_pictures, ground_width_m),
    REAL(lmb_world_pictures, ground_depth_m), REAL(lmb_world_pictures, ground_y), REAL(lmb_world_pictures, centre.x),
    REAL(lmb_world_pictures, middle.y), REAL(lmb_world_pictures, radius), REAL(lmb_world_pictures, low.z),
    REAL(lmb_world_pictures, high.x), WHOLE(lmb_world_pictures, shape), WHOLE(lmb_world_pictures, has_floor), REAL(lmb_world_query, ray_width),
    WHOLE(lmb_world_query, blend), WHOLE(lmb_voxel_part, first_id), WHOLE(lmb_voxel_part, count),
    WHOLE(lmb_voxel_part, in[0]), WHOLE(lmb_cone_trace, field), WHOLE(lmb_cone_trace, world),
    WHOLE(lmb_cone_trace, faced), REAL(lmb_probe_policy, radius_m), WHOLE(lmb_probe_policy, every),
    WHOLE(lmb_relight, blend), WHOLE(lmb_relight, show), REAL(lmb_relight, exposure_ev), REAL(lmb_relight, view.eye.x),
    REAL(lmb_gouraud, exposure_ev), REAL(lmb_gouraud, view.near_m), REAL(lmb_gouraud, view.eye.z),
    WHOLE(lmb_gouraud, view.kind), WHOLE(lmb_relief_how, steps), WHOLE(lmb_relief_how, pick),
    WHOLE(lmb_relief_how, sampling), WHOLE(lmb_relief_how, views), WHOLE(lmb_relief_how, keep),
    WHOLE(lmb_frame_settings, format), WHOLE(lmb_frame_settings, by_bands), WHOLE(lmb_frame_settings, show),
    WHOLE(lmb_frame_settings, quality), WHOLE(lmb_frame_settings, bounces), WHOLE(lmb_frame_settings, threads),
    WHOLE(lmb_frame_settings, shadow_map), WHOLE(lmb_frame_settings, tree), REAL(lmb_frame_settings, error),
    REAL(lmb_frame_settings, visibility), WHOLE(lmb_frame_settings, elements), WHOLE(lmb_frame_settings, gather_step),
    WHOLE(lmb_frame_settings, samples), WHOLE(lmb_frame_settings, points), WHOLE(lmb_frame_settings, id_format),
    WHOLE(lmb_frame_settings, view.frame_width), WHOLE(lmb_frame_settings, view.frame_height),
    REAL(lmb_frame_settings, view.near_m), WHOLE(lmb_frame_settings, grouping.method),
    WHOLE(lmb_frame_settings, grouping.block), WHOLE(lmb_frame_settings, grouping.groups),
    REAL(lmb_frame_settings, grouping.reach), WHOLE(lmb_frame, show), WHOLE(lmb_frame, shadow_map),
    WHOLE(lmb_frame, grouping.method), WHOLE(lmb_frame, grouping.block), WHOLE(lmb_frame, occlusion),
    WHOLE(lmb_frame, steps), REAL(lmb_frame, error), REAL(lmb_frame, visibility), WHOLE(lmb_frame, conservative),
    REAL(lmb_frame, many_lights_error), WHOLE(lmb_frame, gather_many_lights), WHOLE(lmb_frame, bounces),
    WHOLE(lmb_frame, truncated), WHOLE(lmb_frame, gather_step), WHOLE(lmb_frame, samples),
    REAL(lmb_frame, exposure_ev), WHOLE(lmb_frame, id_format), REAL(lmb_frame, dim), REAL(lmb_frame, error_floor),
    WHOLE(lmb_frame, run_all), WHOLE(lmb_frame, view.frame_width), REAL(lmb_frame, view.eye.x),
    REAL(lmb_frame, view.half_width), REAL(lmb_frame, view.near_m), WHOLE(lmb_frame, view.sample_x),
    WHOLE(lmb_tile, x), WHOLE(lmb_tile, y), WHOLE(lmb_tile, id[9]), REAL(lmb_tile, depth[3]),
    REAL(lmb_tile, position[0][5]), REAL(lmb_tile, normal[1][0]), REAL(lmb_irradiance, rgb[0][7]),
    REAL(lmb_texel, flux[0]), REAL(lmb_texel, position.x), REAL(lmb_vec3, x), REAL(lmb_traversal, segments.at.x),
    REAL(lmb_draw_state, to_clip.m[0]), REAL(lmb_draw_state, to_clip.m[15]), REAL(lmb_draw_state, plane[0][1]),
    REAL(lmb_draw_state, fog_axis[2]), REAL(lmb_draw_state, depth_range[0]), REAL(lmb_draw_state, offset_units),
    REAL(lmb_draw_state, fog_density), REAL(lmb_draw_state, stage[1].level_bias), WHOLE(lmb_draw_state, flags),
    WHOLE(lmb_draw_state, viewport[0]), WHOLE(lmb_draw_state, viewport[3]), WHOLE(lmb_draw_state, scissor[1]),
    WHOLE(lmb_draw_state, scissor[2]), WHOLE(lmb_draw_target, x0), REAL(lmb_draw_target, depth_far),
    WHOLE(lmb_draw_lighting, count), REAL(lmb_draw_lighting, to_eye.m[6]), REAL(lmb_draw_lighting, ambient[1]),
    REAL(lmb_draw_lighting, material[0].shininess), REAL(lmb_draw_lighting, material[1].diffuse[3]),
    REAL(lmb_draw_vertices, position_scale.x), REAL(lmb_draw_vertices, uv_scale), REAL(lmb_mat4, m[5]),
    WHOLE(lmb_blit_how, scale), WHOLE(lmb_blit_how, part[0]), WHOLE(lmb_blit_how, part[3]),
};

void pool_poke(const uint8_t b[12])
{
    const int i = pool_nearest(&numbers[0].name, sizeof *numbers, COUNT(numbers), (uint16_t)(b[0] | b[1] << 8));
    uint8_t *at = (uint8_t *)pool_slot(numbers[i].type, b[2]) + numbers[i].at;
    const float real = pool_float(b[3]);
    const double wide = (double)real;
    const int64_t whole = pool_whole(b[3]);
    const int32_t narrow = (int32_t)(uint32_t)(uint64_t)whole;
    fuzz_require(numbers[i].bytes == 4 || numbers[i].bytes == 8);
    if (numbers[i].is_real) {
        memcpy(at, numbers[i].bytes == 4 ? (const void *)&real : &wide, numbers[i].bytes);
    } else {
        memcpy(at, numbers[i].bytes == 4 ? (const void *)&narrow : &whole, numbers[i].bytes);
    }
    pool_say("%s (%d) = %g\n", numbers[i].name, b[2] % POOL_SLOTS, numbers[i].is_real ? wide : (double)whole);
}

#define POINTER(type, member, to) {#type "." #member, #type, offsetof(type, member), #to, 0}
#define COPY(type, member, to)    {#type "." #member, #type, offsetof(type, member), #to, sizeof(to)}
static const struct {
    const char *name, *type;
    size_t at;
    const char *to;
    size_t bytes; /* 0: a pointer */
} links[] = {
    POINTER(lmb_cut_params, bvh, lmb_bvh), POINTER(lmb_cut_params, stats, lmb_stats),
    POINTER(lmb_cut_params, direct, lmb_irradiance), POINTER(lmb_cut_params, beside, lmb_irradiance),
    POINTER(lmb_cut_params, glossy, lmb_glossy), POINTER(lmb_occluder, view, lmb_view),
    POINTER(lmb_occluder, depth, lmb_surface), POINTER(lmb_many_lights_query, many_lights, lmb_many_lights),
    POINTER(lmb_many_lights_query, bvh, lmb_bvh), POINTER(lmb_world_query, world, lmb_world),
    POINTER(lmb_voxel_part, scene, lmb_scene), POINTER(lmb_cone_trace, voxels, lmb_voxels),
    POINTER(lmb_cone_trace, env, lmb_env), POINTER(lmb_cone_trace, scratch, lmb_cone_scratch),
    POINTER(lmb_relight, scene, lmb_scene), POINTER(lmb_relight, maps, lmb_shadow_map),
    POINTER(lmb_relight, world, lmb_world), POINTER(lmb_relight, probes, lmb_probe),
    POINTER(lmb_gouraud, scene, lmb_scene), POINTER(lmb_gouraud, maps, lmb_shadow_map),
    POINTER(lmb_gouraud, scratch, lmb_gouraud_scratch), POINTER(lmb_element_scratch, cut, lmb_cut),
    POINTER(lmb_element_scratch, tile, lmb_tile), POINTER(lmb_element_scratch, fresh, lmb_irradiance),
    POINTER(lmb_frame_settings, scene, lmb_scene), POINTER(lmb_frame_settings, many_lights, lmb_many_lights),
    POINTER(lmb_frame_settings, transfer, lmb_transfer), POINTER(lmb_frame, scene, lmb_scene),
    POINTER(lmb_frame, many_lights, lmb_many_lights), POINTER(lmb_frame, background, lmb_env),
    POINTER(lmb_frame, groups, lmb_groups), POINTER(lmb_frame, scratch, lmb_band_scratch),
    POINTER(lmb_frame, stats, lmb_stats), COPY(lmb_target, depth, lmb_surface), COPY(lmb_target, id, lmb_surface),
    COPY(lmb_relight, view, lmb_view), COPY(lmb_relight, eye, lmb_target), COPY(lmb_frame, view, lmb_view),
    COPY(lmb_frame, out, lmb_surface), COPY(lmb_frame, eye, lmb_target), COPY(lmb_frame, eye_depth, lmb_surface),
    COPY(lmb_frame, points, lmb_points), COPY(lmb_frame, tree, lmb_tree), COPY(lmb_frame, bvh, lmb_bvh),
    COPY(lmb_frame, elements, lmb_elements), COPY(lmb_frame, lattice, lmb_lattice),
    COPY(lmb_frame, grouping, lmb_grouping), COPY(lmb_frame_settings, view, lmb_view),
    COPY(lmb_frame_settings, grouping, lmb_grouping), COPY(lmb_frame_settings, out, lmb_surface),
};

void pool_link(const uint8_t b[12])
{
    const int i = pool_nearest(&links[0].name, sizeof *links, COUNT(links), (uint16_t)(b[0] | b[1] << 8));
    uint8_t *at = (uint8_t *)pool_slot(links[i].type, b[2]) + links[i].at;
    void *to = b[3] >= 240 ? NULL : pool_slot(links[i].to, b[3]);
    pool_say("%s (%d) = %s %d\n", links[i].name, b[2] % POOL_SLOTS, to == NULL ? "NULL" : links[i].to, b[3]);
    if (links[i].bytes == 0) {
        memcpy(at, &to, sizeof to);
    } else if (to != NULL) {
        memmove(at, to, links[i].bytes);
    } else {
        memset(at, 0, links[i].bytes);
    }
}

#endif
