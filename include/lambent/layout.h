/* layout.h: makes a program and a library with different capacities fail to link. If the size of a struct depends on a
 * capacity of config.h, calls that take the struct, directly or behind its pointers, carry all capacities in their
 * names.
 *
 * So lmb_draw is lmb_draw in every build, and lmb_render_begin becomes lmb_render_begin_g2048_l128_c65536_...: a name
 * that the linker cannot find shows the difference between the two builds. Today's compilers and linkers distinguish
 * names of thousands of characters (C99 requires 31). Capacities must therefore be plain numbers, not expressions.
 * `make layout` reads the capacities from config.h and the calls from the headers: none can be forgotten.
 *
 * Stability: stable. */
#ifndef LMB_LAYOUT_H
#define LMB_LAYOUT_H

#include "config.h"

/* In config.h's order: groups, lights, cut; many lights' cut and active lights; pairs, live cut (x), probes (o), planes
 * (f), views, hull's planes; nodes that are bounded, slots. */
#define LMB_PASTE_(name, g, l, c, m, n, p, x, o, f, v, h, w, s) \
    name##_g##g##_l##l##_c##c##_m##m##_n##n##_p##p##_x##x##_o##o##_f##f##_v##v##_h##h##_w##w##_s##s
#define LMB_PASTE(name, g, l, c, m, n, p, x, o, f, v, h, w, s) LMB_PASTE_(name, g, l, c, m, n, p, x, o, f, v, h, w, s)
#define LMB_LAYOUT(name) \
    LMB_PASTE(name, LMB_MAX_GROUPS, LMB_MAX_LIGHTS, LMB_MAX_CUT, LMB_MANY_LIGHTS_CUT, LMB_ACTIVE_LIGHTS, \
              LMB_GATHER_PAIRS, LMB_LIVE_CUT, LMB_MAX_PROBES, LMB_MAX_PLANES, LMB_RELIEF_VIEWS, LMB_HULL_PLANES, \
              LMB_BOUNDS_NODES, LMB_SLOTS)

#define lmb_around_gather           LMB_LAYOUT(lmb_around_gather)
#define lmb_around_scale            LMB_LAYOUT(lmb_around_scale)
#define lmb_occluded_sun            LMB_LAYOUT(lmb_occluded_sun)
#define lmb_occluded_tile           LMB_LAYOUT(lmb_occluded_tile)
#define lmb_bvh_build               LMB_LAYOUT(lmb_bvh_build)
#define lmb_bvh_init                LMB_LAYOUT(lmb_bvh_init)
#define lmb_bvh_small_init          LMB_LAYOUT(lmb_bvh_small_init)
#define lmb_build_check             LMB_LAYOUT(lmb_build_check)
#define lmb_compose_emission        LMB_LAYOUT(lmb_compose_emission)
#define lmb_compose_tile            LMB_LAYOUT(lmb_compose_tile)
#define lmb_cones_diffuse           LMB_LAYOUT(lmb_cones_diffuse)
#define lmb_cones_glossy            LMB_LAYOUT(lmb_cones_glossy)
#define lmb_cones_trace             LMB_LAYOUT(lmb_cones_trace)
#define lmb_delta_tile              LMB_LAYOUT(lmb_delta_tile)
#define lmb_direct_tile             LMB_LAYOUT(lmb_direct_tile)
#define lmb_elements_receive        LMB_LAYOUT(lmb_elements_receive)
#define lmb_elements_receive_live   LMB_LAYOUT(lmb_elements_receive_live)
#define lmb_frame_bytes             LMB_LAYOUT(lmb_frame_bytes)
#define lmb_frame_init              LMB_LAYOUT(lmb_frame_init)
#define lmb_gather_cut              LMB_LAYOUT(lmb_gather_cut)
#define lmb_gather_tile             LMB_LAYOUT(lmb_gather_tile)
#define lmb_gbuffer_band            LMB_LAYOUT(lmb_gbuffer_band)
#define lmb_glossy_direct           LMB_LAYOUT(lmb_glossy_direct)
#define lmb_glossy_tile             LMB_LAYOUT(lmb_glossy_tile)
#define lmb_group_points            LMB_LAYOUT(lmb_group_points)
#define lmb_hull_find               LMB_LAYOUT(lmb_hull_find)
#define lmb_hull_holds              LMB_LAYOUT(lmb_hull_holds)
#define lmb_hull_pixels             LMB_LAYOUT(lmb_hull_pixels)
#define lmb_live_collect            LMB_LAYOUT(lmb_live_collect)
#define lmb_live_receive            LMB_LAYOUT(lmb_live_receive)
#define lmb_many_lights_direct_tile LMB_LAYOUT(lmb_many_lights_direct_tile)
#define lmb_many_lights_elements    LMB_LAYOUT(lmb_many_lights_elements)
#define lmb_mirror_tile             LMB_LAYOUT(lmb_mirror_tile)
#define lmb_object_tile             LMB_LAYOUT(lmb_object_tile)
#define lmb_occluded_again          LMB_LAYOUT(lmb_occluded_again)
#define lmb_plan_frame              LMB_LAYOUT(lmb_plan_frame)
#define lmb_planes_anchor           LMB_LAYOUT(lmb_planes_anchor)
#define lmb_planes_clear            LMB_LAYOUT(lmb_planes_clear)
#define lmb_planes_find             LMB_LAYOUT(lmb_planes_find)
#define lmb_planes_floor            LMB_LAYOUT(lmb_planes_floor)
#define lmb_planes_move             LMB_LAYOUT(lmb_planes_move)
#define lmb_planes_up               LMB_LAYOUT(lmb_planes_up)
#define lmb_points_collect          LMB_LAYOUT(lmb_points_collect)
#define lmb_probe_background        LMB_LAYOUT(lmb_probe_background)
#define lmb_probe_cache_ask         LMB_LAYOUT(lmb_probe_cache_ask)
#define lmb_probe_cache_init        LMB_LAYOUT(lmb_probe_cache_init)
#define lmb_probe_cache_name        LMB_LAYOUT(lmb_probe_cache_name)
#define lmb_probe_glossy_tile       LMB_LAYOUT(lmb_probe_glossy_tile)
#define lmb_probe_light_tile        LMB_LAYOUT(lmb_probe_light_tile)
#define lmb_real_mesh_build         LMB_LAYOUT(lmb_real_mesh_build)
#define lmb_real_mesh_colour        LMB_LAYOUT(lmb_real_mesh_colour)
#define lmb_real_mesh_draw          LMB_LAYOUT(lmb_real_mesh_draw)
#define lmb_real_tile               LMB_LAYOUT(lmb_real_tile)
#define lmb_relief_lit              LMB_LAYOUT(lmb_relief_lit)
#define lmb_relief_nearer           LMB_LAYOUT(lmb_relief_nearer)
#define lmb_relief_open             LMB_LAYOUT(lmb_relief_open)
#define lmb_relief_scene            LMB_LAYOUT(lmb_relief_scene)
#define lmb_relief_shadow_rows      LMB_LAYOUT(lmb_relief_shadow_rows)
#define lmb_relief_tile             LMB_LAYOUT(lmb_relief_tile)
#define lmb_relight_band            LMB_LAYOUT(lmb_relight_band)
#define lmb_render_again            LMB_LAYOUT(lmb_render_again)
#define lmb_render_band             LMB_LAYOUT(lmb_render_band)
#define lmb_render_begin            LMB_LAYOUT(lmb_render_begin)
#define lmb_render_frame            LMB_LAYOUT(lmb_render_frame)
#define lmb_render_has_parts        LMB_LAYOUT(lmb_render_has_parts)
#define lmb_render_sample           LMB_LAYOUT(lmb_render_sample)
#define lmb_render_reuse            LMB_LAYOUT(lmb_render_reuse)
#define lmb_render_part             LMB_LAYOUT(lmb_render_part)
#define lmb_render_parts_done       LMB_LAYOUT(lmb_render_parts_done)
#define lmb_render_progress         LMB_LAYOUT(lmb_render_progress)
#define lmb_render_step             LMB_LAYOUT(lmb_render_step)
#define lmb_render_vertices         LMB_LAYOUT(lmb_render_vertices)
#define lmb_resolve_albedo          LMB_LAYOUT(lmb_resolve_albedo)
#define lmb_resolve_tile            LMB_LAYOUT(lmb_resolve_tile)
#define lmb_tile_noise              LMB_LAYOUT(lmb_tile_noise)
#define lmb_transfer_many_lights    LMB_LAYOUT(lmb_transfer_many_lights)
#define lmb_transfer_tile           LMB_LAYOUT(lmb_transfer_tile)
#define lmb_tree_texels             LMB_LAYOUT(lmb_tree_texels)

#endif
