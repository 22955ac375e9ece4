/* main_statue.c: draws a relief from ROM, 128x128 in RGB565 with self-shadowing, in less than 256 KiB of RAM.
 *
 * statue.inc holds the words of the .lmr (tests/scripts/statue.sh bakes it). Prints the picture's hash and the RAM. The
 * hash must be the same on a host. */
#include <lambent/lambent.h>

#include <string.h>

#include "../port_say.h"

enum { SIDE = 128, MAP_SIZE = 128 };

static const uint32_t statue[] = {
#include "statue.inc"
};

/* Words, for alignment to 4. Sides are whole tiles. */
static uint32_t picture[SIDE * SIDE / 2], eye_depth[SIDE * SIDE], eye_id[SIDE * SIDE / 2];
LMB_SHADOW_MAP_ARRAY(map_memory, MAP_SIZE);
static lmb_relief relief;
static lmb_relief_stats stats;
static lmb_scene simple;
static lmb_shadow_map map;
static lmb_target eye;
static lmb_surface out;
static lmb_tile tile;
static lmb_irradiance direct, ambient;
static lmb_radiance radiance;
static const lmb_light sun = {{0, 0, 0}, {-0.48f, -0.6f, -0.64f}, {2.6f, 2.6f, 2.6f}, 1, 1,
                              LMB_LIGHT_DIRECTIONAL, 0, 0};

static lmb_status place(lmb_view *view)
{
    lmb_vec3 middle, from;
    lmb_status s = lmb_build_check();
    if (s == LMB_OK)
        s = lmb_relief_open(&relief, statue, sizeof statue);
    if (s == LMB_OK)
        s = lmb_surface_init(&out, LMB_RGB565, SIDE, SIDE, picture, sizeof picture);
    if (s == LMB_OK)
        s = lmb_surface_init(&eye.depth, LMB_DEPTH32F, SIDE, SIDE, eye_depth, sizeof eye_depth);
    if (s == LMB_OK)
        s = lmb_surface_init(&eye.id, LMB_ID16, SIDE, SIDE, eye_id, sizeof eye_id);
    if (s != LMB_OK)
        return s;
    lmb_relief_scene(&simple, &relief);
    middle.x = 0.5f * (simple.bounds_min.x + simple.bounds_max.x);
    middle.y = 0.5f * (simple.bounds_min.y + simple.bounds_max.y);
    middle.z = 0.5f * (simple.bounds_min.z + simple.bounds_max.z);
    const float size = simple.bounds_max.x - simple.bounds_min.x;
    from = middle;
    from.x += 0.6f * size;
    from.y += 0.5f * size;
    from.z += 1.2f * size;
    return lmb_view_look_at(view, from, middle, (lmb_vec3){0, 1, 0}, 0.7f, SIDE, SIDE);
}

static lmb_status draw_map(const lmb_kernels *kernels)
{
    lmb_status s = lmb_shadow_map_init(&map, &sun, &simple, MAP_SIZE, LMB_ID16, map_memory, sizeof map_memory);
    if (s == LMB_OK) {
        lmb_shadow_map_clear(&map);
        s = lmb_shadow_map_draw(&map, kernels, &simple, 1, lmb_scene_triangles(&simple), NULL);
    }
    return s != LMB_OK ? s : lmb_relief_shadow_rows(&map, kernels, &tile, &relief, NULL, 0, MAP_SIZE / LMB_TILE);
}

static lmb_status draw_tile(const lmb_kernels *kernels, const lmb_view *view, int32_t x, int32_t y)
{
    lmb_status s = lmb_resolve_tile(&tile, kernels, view, &simple, &eye, x, y);
    if (s == LMB_OK)
        s = lmb_relief_tile(&tile, kernels, &relief, view, NULL, &stats);
    memset(&direct, 0, sizeof direct);
    if (s == LMB_OK)
        s = lmb_direct_tile(&direct, kernels, &tile, view, &simple, &sun, NULL);
    const uint64_t lit = lmb_relief_lit(&map, &sun, &tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k)
        for (int c = 0; c < 3; ++c) {
            direct.rgb[c][k] = lit >> k & 1 ? direct.rgb[c][k] : 0.0f;
            ambient.rgb[c][k] = 0.4f;
        }
    if (s == LMB_OK)
        s = lmb_compose_tile(&radiance, kernels, &tile, &direct, &ambient);
    return s != LMB_OK ? s : lmb_store_tile(&out, kernels, 0, 0, &radiance, x, y, 0.0f);
}

static lmb_status draw(void)
{
    const lmb_kernels *kernels = lmb_kernels_pick();
    lmb_view view;
    lmb_status s = place(&view);
    if (s == LMB_OK)
        s = draw_map(kernels);
    if (s == LMB_OK)
        s = lmb_draw(&eye, kernels, &view, &simple, 1, lmb_scene_triangles(&simple), 0, NULL);
    for (int32_t y = 0; y < SIDE && s == LMB_OK; y += LMB_TILE)
        for (int32_t x = 0; x < SIDE && s == LMB_OK; x += LMB_TILE)
            s = draw_tile(kernels, &view, x, y);
    return s;
}

int main(void)
{
    const lmb_status s = draw();
    if (s != LMB_OK) {
        return say_error(lmb_status_name(s));
    }
    say_count("views ", (uint32_t)relief.views);
    say_count(", triangles ", lmb_scene_triangles(&simple));
    say_count(", pixels ", (uint32_t)stats.pixels);
    say_count(", hits ", (uint32_t)stats.hits);
    say_count(", holes ", (uint32_t)stats.holes);
    port_put("\nstatue-128x128-rgb565 ");
    say_hex(lmb_surface_hash(&out));
    port_put("\n");
    return say_ram();
}
