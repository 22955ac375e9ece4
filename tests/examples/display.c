/* display.c: a display fed by lines, on a machine without memory for a picture: 8 rows of RGB565
 * at a time, in small steps.
 *
 * by_bands stores depth, ids and picture of only 8 rows; your callback gets each finished band. Fixed groups
 * (LMB_QUALITY_FIXED) need the least memory; everything is in one static block. lmb_render_step does a bounded piece of
 * work and returns, so a main loop or an RTOS task stays responsive. */
#include "room.h"

enum { WIDTH = 96, HEIGHT = 64 };

static uint64_t block[(200 * 1024 + sizeof(lmb_band_scratch) + sizeof(lmb_groups)) / 8];
static lmb_render state;

/* In place of the bus to a display: a running sum over the sent rows. */
typedef struct display {
    uint64_t sum;
    int32_t rows;
} display;

static int send_rows(void *user, const lmb_surface *rows, int32_t y)
{
    display *d = user;
    d->sum = d->sum * 31 + lmb_surface_hash(rows);
    d->rows += rows->height;
    return y != d->rows - rows->height; /* 0: continue. Bands come from the top */
}

int main(void)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_frame_settings settings;
    lmb_frame frame;
    display screen = {0, 0};
    int steps = 0;

    memset(&settings, 0, sizeof settings);
    settings.kernels = lmb_kernels_pick();
    settings.scene = &scene;
    settings.by_bands = 1;
    settings.format = LMB_RGB565;
    settings.quality = LMB_QUALITY_FIXED;
    settings.shadow_map = 128;
    settings.grouping.groups = 64;
    settings.points = 600; /* 88 bytes each; too few would stop the frame with LMB_ERR_CAPACITY */
    lmb_view_look_at(&settings.view, room_eye, room_middle, room_up, 0.8f, WIDTH, HEIGHT);
    if (lmb_frame_init(&frame, &settings, block, sizeof block) != LMB_OK) {
        printf("%lu bytes wanted, %lu there\n", (unsigned long)lmb_frame_bytes(&settings), (unsigned long)sizeof block);
        return 1;
    }
    frame.callback = send_rows;
    frame.user = &screen;
    lmb_status status = lmb_render_begin(&state, &frame);
    for (int more = status == LMB_OK; more; more = status == LMB_MORE) {
        status = lmb_render_step(&state, 4);
        ++steps;
    }
    printf("%d rows sent in %d steps, %lu KiB\n", (int)screen.rows, steps,
           (unsigned long)(lmb_frame_bytes(&settings) / 1024));
    return status != LMB_OK || screen.rows != HEIGHT || ends_with("display", screen.sum, UINT64_C(0xc7b0dffbc3e66318));
}
