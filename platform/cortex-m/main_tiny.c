/* main_tiny.c: the demo scene with bounced light, 160x120 in RGB565, in less than 256 KiB of RAM and without a heap.
 *
 * Prints the picture's hash and the RAM. The hash must be the same on a host. */
#include <lambent/lambent.h>

#include "../../tools/demo/demo_scene.h"
#include "../port_say.h"

enum { WIDTH = 160, HEIGHT = 120, MAP_SIZE = 128, MAP_BLOCKS = MAP_SIZE / 8, POINTS = 400 };

/* Words, for alignment to 4. Depth and id consist of whole tiles: both sizes are multiples of 8. */
static uint32_t picture[WIDTH * HEIGHT / 2];
static uint32_t band_depth[WIDTH * LMB_TILE];
static uint32_t band_id[WIDTH * LMB_TILE / 2];
static uint32_t view_depth[WIDTH * HEIGHT / 2];
LMB_SHADOW_MAP_ARRAY(map_memory, MAP_SIZE);
LMB_POINTS_ARRAY(points, POINTS, MAP_BLOCKS);
static lmb_groups groups;
static lmb_band_scratch scratch;
static lmb_stats stats;
static lmb_render render;

static lmb_status place_surfaces(lmb_frame *frame)
{
    lmb_status s = lmb_surface_init(&frame->out, LMB_RGB565, WIDTH, HEIGHT, picture, sizeof picture);
    if (s == LMB_OK)
        s = lmb_surface_init(&frame->eye.depth, LMB_DEPTH32F, WIDTH, LMB_TILE, band_depth, sizeof band_depth);
    if (s == LMB_OK)
        s = lmb_surface_init(&frame->eye.id, LMB_ID16, WIDTH, LMB_TILE, band_id, sizeof band_id);
    if (s == LMB_OK)
        s = lmb_surface_init(&frame->eye_depth, LMB_DEPTH16, WIDTH, HEIGHT, view_depth, sizeof view_depth);
    return s;
}

static lmb_status draw(lmb_surface *out)
{
    static lmb_frame frame;
    lmb_status s = lmb_build_check();
    if (s == LMB_OK)
        s = place_surfaces(&frame);
    frame.kernels = lmb_kernels_pick();
    frame.scene = demo_scene();
    frame.view = demo_view(WIDTH, HEIGHT);
    frame.shadow_map = MAP_SIZE;
    frame.occlusion = LMB_OCCLUSION_VIEW;
    frame.map_memory = map_memory;
    frame.map_bytes = sizeof map_memory;
    frame.id_format = LMB_ID16;
    frame.points = points;
    frame.groups = &groups;
    frame.scratch = &scratch;
    frame.stats = &stats;
    if (s == LMB_OK)
        s = lmb_render_frame(&render, &frame);
    *out = frame.out;
    return s;
}

int main(void)
{
    lmb_surface out;
    lmb_status s = draw(&out);
    if (s != LMB_OK) {
        return say_error(lmb_status_name(s));
    }
    say_count("triangles ", stats.triangles_drawn);
    say_count(", first points ", stats.first_points);
    say_count(", groups ", stats.groups);
    port_put("\ndemo-160x120-rgb565 ");
    say_hex(lmb_surface_hash(&out));
    port_put("\n");
    return say_ram();
}
