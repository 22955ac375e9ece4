/* main_gouraud.c: the demo scene with light at vertices, 160x120 in RGB565, in less than 160 KiB of RAM: the shadow
 * map, bounced light by the transfer that tests/scripts/live.sh bakes, and the picture.
 *
 * Prints the picture's hash, the instructions for the frame (0: unknown) and for a frame with unchanged light, and the
 * RAM. The hash must be the same on a host. */
#include <lambent/lambent.h>

#include "../../tools/demo/demo_scene.h"
#include "../port_say.h"
#include "count.h"

enum { WIDTH = 160, HEIGHT = 120, MAP_SIZE = 40, RECEIVERS = 512 };

static const uint32_t baked[] = {
#include "baked.inc"
};

/* Words, for alignment to 4. */
static uint32_t picture[WIDTH * HEIGHT / 2];
static uint16_t depth[WIDTH * HEIGHT];
static uint32_t map_memory[MAP_SIZE * MAP_SIZE * 6 / 4];
static uint32_t light_memory[6800];
static float direct[RECEIVERS][3];
static lmb_transfer transfer;
static lmb_transfer_light light;
static lmb_shadow_map map;
static lmb_gouraud_scratch scratch;
static lmb_transfer_scratch collecting;
static lmb_gouraud frame;

/* Instructions until the end of a stage. */
enum { MAP, ELEMENTS, RECEIVERS_LIT, DRAWN, STAGES };
static uint32_t taken[STAGES];

static lmb_status place(void)
{
    const lmb_scene *scene = demo_scene();
    lmb_status s = lmb_build_check();
    if (s == LMB_OK)
        s = lmb_surface_init(&frame.out, LMB_RGB565, WIDTH, HEIGHT, picture, sizeof picture);
    if (s == LMB_OK)
        s = lmb_transfer_open(&transfer, baked, sizeof baked);
    if (s == LMB_OK)
        s = lmb_transfer_fits(&transfer, scene);
    if (s == LMB_OK && transfer.count[LMB_TRANSFER_RECEIVERS] > RECEIVERS)
        s = LMB_ERR_CAPACITY;
    if (s == LMB_OK)
        s = lmb_transfer_light_init(&light, &transfer, light_memory, sizeof light_memory);
    if (s == LMB_OK)
        s = lmb_transfer_materials(&light, &transfer, scene);
    frame.scene = scene;
    frame.transfer = &transfer;
    frame.light = &light;
    frame.maps = &map;
    frame.direct = direct;
    frame.scratch = &scratch;
    frame.view = demo_view(WIDTH, HEIGHT);
    frame.depth = depth;
    return s;
}

/* Updates the parts that depend only on the light: the shadow map, and the light of receivers. */
static lmb_status light_up(void)
{
    const lmb_scene *scene = frame.scene;
    lmb_status s =
        lmb_shadow_map_init(&map, &scene->lights[0], scene, MAP_SIZE, LMB_ID16, map_memory, sizeof map_memory);
    if (s == LMB_OK)
        s = lmb_gouraud_map(&map, &scratch, scene);
    taken[MAP] = count_taken();
    if (s == LMB_OK)
        s = lmb_transfer_clear(&light, &transfer);
    for (int32_t f = 0; f < map.faces && s == LMB_OK; ++f)
        s = lmb_transfer_collect(&light, lmb_kernels_pick(), &collecting, &transfer, scene, &scene->lights[0], &map, f,
                                 1, 0, MAP_SIZE);
    taken[ELEMENTS] = count_taken();
    if (s == LMB_OK)
        s = lmb_transfer_send(&light, &transfer);
    if (s == LMB_OK)
        s = lmb_transfer_receivers(&light, lmb_kernels_pick(), &transfer, 0,
                                   transfer.count[LMB_TRANSFER_RECEIVERS] + transfer.count[LMB_TRANSFER_CLUSTERS]);
    taken[RECEIVERS_LIT] = count_taken();
    return s;
}

static lmb_status draw(void)
{
    const lmb_status s = lmb_gouraud_begin(&frame);
    return s == LMB_OK ? lmb_gouraud_draw(&frame, 1, lmb_scene_triangles(frame.scene)) : s;
}

int main(void)
{
    lmb_status s = place();
    count_start();
    if (s == LMB_OK)
        s = light_up();
    if (s == LMB_OK)
        s = draw();
    taken[DRAWN] = count_taken();
    if (s != LMB_OK) {
        return say_error(lmb_status_name(s));
    }
    port_put("demo-gouraud-160x120-rgb565 ");
    say_hex(lmb_surface_hash(&frame.out));
    say_count("\ninstructions ", taken[DRAWN]);
    say_count(" map ", taken[MAP]);
    say_count(" elements ", taken[ELEMENTS] - taken[MAP]);
    say_count(" receivers ", taken[RECEIVERS_LIT] - taken[ELEMENTS]);
    say_count(" of them where the light stands still ", taken[DRAWN] - taken[RECEIVERS_LIT]);
    port_put("\n");
    return say_ram();
}
