/* main_bounced.c: frames of the demo scene with bounced light, 160x120 in RGB565, in less than 320 KiB of RAM. Lamp and
 * knot move. Nothing is baked, and nothing is kept from one frame for the next. Build it with LMB_LIVE_CUT 64.
 *
 * Prints, for each frame, the picture's hash, thousands of instructions by stage (0: unknown) and in all, those of direct
 * light in the same memory, and the difference; then the RAM. The hashes must be the same on a host. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../tools/demo/demo_scene.h"
#include "../port_say.h"
#include "count.h"
#include "strips.h"

enum {
    MAP_SIZE = 64,
    BLOCKS = 16, /* first points each way, at most */
    STRATA = 8,
    FRAMES = 3,
    INSTANCES = 17,
    KNOT = 14,
    STAGES = LMB_STAGE_DONE
};

static uint32_t map_memory[MAP_SIZE * MAP_SIZE * 6 / 4];
static uint32_t bvh_memory[13000];
static uint64_t live_memory[9400];
static uint64_t lattice_memory[3750];
static uint64_t tree_memory[1024]; /* the frame must have a tree of texels, but reads it only for glossy materials */
static lmb_live live;
static lmb_live_scratch live_scratch;
static lmb_band_scratch scratch;
static lmb_render render;
static lmb_frame frame;
static lmb_scene scene;
static lmb_instance instances[INSTANCES];
static lmb_light lamp;

/* --- motion ------------------------------------------------------------------------------------------------------- */

static void turn_knot(lmb_mat4 *m, float angle)
{
    const float c = lmb_cos(angle), s = lmb_sin(angle);
    for (int k = 0; k < 3; ++k) {
        const float x = m->m[4 * k], z = m->m[4 * k + 2];
        m->m[4 * k] = c * x + s * z;
        m->m[4 * k + 2] = c * z - s * x;
    }
}

static void move_lamp(float angle)
{
    const lmb_light *from = demo_scene()->lights;
    lmb_vec3 to = from->direction;
    lamp = *from;
    lamp.position.x -= 0.5f * lmb_sin(angle);
    lamp.position.z += 0.5f * (1.0f - lmb_cos(angle));
    to.x = from->position.x + 3.0f * to.x - lamp.position.x;
    to.y = from->position.y + 3.0f * to.y - lamp.position.y;
    to.z = from->position.z + 3.0f * to.z - lamp.position.z;
    const float length = lmb_sqrt(to.x * to.x + to.y * to.y + to.z * to.z);
    lamp.direction.x = to.x / length;
    lamp.direction.y = to.y / length;
    lamp.direction.z = to.z / length;
}

static void move(int number)
{
    const float angle = 0.2f * (float)number;
    scene = *demo_scene();
    memcpy(instances, scene.instances, sizeof instances);
    turn_knot(&instances[KNOT].to_world, angle);
    move_lamp(angle);
    scene.instances = instances;
    scene.lights = &lamp;
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static lmb_status place_bounces(void)
{
    const uint32_t triangles = lmb_scene_triangles(&scene);
    lmb_status s = lmb_bvh_small_init(&frame.bvh, triangles, bvh_memory, lmb_bvh_small_bytes(triangles));
    if (lmb_bvh_small_bytes(triangles) > sizeof bvh_memory)
        s = LMB_ERR_CAPACITY;
    if (s == LMB_OK)
        s = lmb_tree_init(&frame.tree, 1, MAP_SIZE / 8, tree_memory, sizeof tree_memory);
    if (s == LMB_OK)
        s = lmb_live_init(&live, 1, BLOCKS, 0, live_memory, sizeof live_memory);
    if (s == LMB_OK)
        s = lmb_lattice_init(&frame.lattice, WIDTH, HEIGHT, lattice_memory, sizeof lattice_memory);
    live.strata = STRATA;
    live.split = 8.0f;
    scratch.live = &live_scratch;
    frame.live = &live;
    frame.grouping.method = LMB_GROUP_CUT;
    frame.occlusion = LMB_OCCLUSION_EXACT;
    frame.gather_step = LMB_GATHER_LIVE;
    return s;
}

static lmb_status place(void)
{
    lmb_status s = lmb_build_check();
    if (s == LMB_OK)
        s = place_strips(&frame);
    frame.kernels = lmb_kernels_pick();
    frame.scene = &scene;
    frame.view = demo_view(WIDTH, HEIGHT);
    frame.shadow_map = MAP_SIZE;
    frame.map_memory = map_memory;
    frame.map_bytes = sizeof map_memory;
    frame.id_format = LMB_ID16;
    frame.scratch = &scratch;
    return s == LMB_OK ? place_bounces() : s;
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

/* Draws a frame. taken: adds instructions by stage, in thousands. */
static lmb_status draw(uint32_t taken[STAGES])
{
    lmb_status s = lmb_render_begin(&render, &frame);
    for (s = s == LMB_OK ? LMB_MORE : s; s == LMB_MORE;) {
        const int32_t stage = render.stage;
        count_start();
        s = lmb_render_step(&render, 1 << 14);
        taken[stage] += count_taken() / 1000;
    }
    return s;
}

static uint32_t sum_of(const uint32_t taken[STAGES])
{
    uint32_t sum = 0;
    for (int i = 0; i < STAGES; ++i)
        sum += taken[i];
    return sum;
}

static lmb_status draw_both(int number)
{
    static const char *const names[STAGES] = {" map ", " bvh ",  " points ",  " tree ",
                                              0,       " view ", " samples ", " bands "};
    uint32_t direct[STAGES] = {0}, full[STAGES] = {0};
    move(number);
    frame.show = LMB_SHOW_DIRECT;
    lmb_status s = draw(direct);
    frame.show = LMB_SHOW_FULL;
    if (s == LMB_OK)
        s = draw(full);
    say_count("demo-bounced-", (uint32_t)number);
    port_put(" ");
    say_hex(lmb_surface_hash(&frame.out));
    port_put("\nthousands of instructions:");
    for (int i = 0; i < STAGES; ++i)
        if (names[i] != 0)
            say_count(names[i], full[i]);
    say_count(" all ", sum_of(full));
    say_count(" direct ", sum_of(direct));
    say_count(" added ", sum_of(full) - sum_of(direct));
    port_put("\n");
    return s;
}

int main(void)
{
    move(0);
    lmb_status s = place();
    for (int i = 0; i < FRAMES && s == LMB_OK; ++i)
        s = draw_both(i);
    return s != LMB_OK ? say_error(lmb_status_name(s)) : say_ram();
}
