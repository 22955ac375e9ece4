/* hud.c: a pane of glass, a line around it, a health bar and text over a lit room.
 *
 * The frame is drawn first and keeps its depth, so lmb_draw_list hides the part of the pane behind the block.
 * lmb_render_vertices lights the glass by the room's light. Overlays are drawn in pixels, without depth. If you run
 * `hud out.ppm`, it also writes the picture. */
#include "room.h"

#include <stdlib.h>

enum { WIDTH = 160, HEIGHT = 120 };

static lmb_render state;

static lmb_status draw_glass(const lmb_draw_target *target, const lmb_frame *frame)
{
    static const float corners[4][3] = {
        {-0.2f, 0.1f, -0.2f}, {0.35f, 0.1f, -0.2f}, {0.35f, 1.2f, -0.2f}, {-0.2f, 1.2f, -0.2f}};
    static const uint8_t tints[4][4] = {
        {140, 200, 255, 110}, {140, 200, 255, 110}, {230, 245, 255, 160}, {230, 245, 255, 160}};
    const lmb_mat4 here = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    uint8_t lit[4][4];
    lmb_draw_vertices pane = {.positions = corners, .colours = tints[0], .count = 4};
    const lmb_draw_vertices rim = {.positions = corners, .count = 4};
    lmb_draw_state s;
    lmb_status status = lmb_render_vertices(lit[0], &state, frame->scratch, &pane, NULL, &here);
    pane.colours = lit[0];
    status = status != LMB_OK ? status : lmb_draw_state_init(&s, WIDTH, HEIGHT);
    status = status != LMB_OK ? status : lmb_draw_view(&s, &frame->view, &here);
    s.kernels = lmb_kernels_pick();
    s.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_BLEND;
    s.blend_source[0] = LMB_DRAW_SOURCE_ALPHA;
    s.blend_target[0] = LMB_DRAW_INVERSE_SOURCE_ALPHA;
    status = status != LMB_OK ? status : lmb_draw_list(target, &s, &pane, LMB_DRAW_QUADS, NULL, NULL);
    s.flags = LMB_DRAW_DEPTH_TEST;
    return status != LMB_OK ? status : lmb_draw_list(target, &s, &rim, LMB_DRAW_LINE_LOOP, NULL, NULL);
}

static lmb_status draw_hud(const lmb_draw_target *target)
{
    static const float bar[4][3] = {{8, 104, 0}, {8, 112, 0}, {60, 112, 0}, {60, 104, 0}};
    static const uint8_t paint[4][4] = {
        {200, 30, 30, 255}, {200, 30, 30, 255}, {240, 200, 40, 255}, {240, 200, 40, 255}};
    static const uint8_t ink[4] = {255, 240, 200, 255};
    const lmb_draw_vertices bars = {.positions = bar, .colours = paint[0], .count = 4};
    lmb_draw_state s;
    lmb_status status = lmb_draw_state_init(&s, WIDTH, HEIGHT);
    status = status != LMB_OK ? status : lmb_draw_pixels(&s);
    status = status != LMB_OK ? status : lmb_draw_list(target, &s, &bars, LMB_DRAW_QUADS, NULL, NULL);
    status = status != LMB_OK ? status : lmb_text(&target->colour, 8, 6, "A room with a pane\nof glass", 1, ink);
    return status != LMB_OK ? status : lmb_text(&target->colour, 94, 104, "65/100", 1, ink);
}

int main(int argc, char **argv)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_frame_settings settings = {.kernels = lmb_kernels_pick(), .scene = &scene, .show = LMB_SHOW_DIRECT};
    lmb_frame frame;
    if (lmb_view_look_at(&settings.view, room_eye, room_middle, room_up, 0.8f, WIDTH, HEIGHT) != LMB_OK) {
        return 1;
    }
    void *block = malloc(lmb_frame_bytes(&settings));
    lmb_status status = lmb_frame_init(&frame, &settings, block, lmb_frame_bytes(&settings));
    status = status != LMB_OK ? status : lmb_render_frame(&state, &frame);
    const lmb_draw_target target = {.colour = frame.out, .depth = frame.eye.depth};
    status = status != LMB_OK ? status : draw_glass(&target, &frame);
    status = status != LMB_OK ? status : draw_hud(&target);
    FILE *file = argc > 1 && status == LMB_OK ? fopen(argv[1], "wb") : NULL;
    for (int i = -1; file != NULL && i < WIDTH * HEIGHT; ++i) {
        i < 0 ? (void)fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT)
              : (void)fwrite((const char *)frame.out.data + 4 * i, 1, 3, file);
    }
    const int closed = file == NULL || fclose(file) == 0;
    const uint64_t hash = status == LMB_OK ? lmb_surface_hash(&frame.out) : 0;
    free(block);
    return ends_with("pane of glass and text", hash, UINT64_C(0x76ddb420df498b05)) || !closed;
}
