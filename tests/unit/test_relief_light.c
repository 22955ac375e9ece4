/* test_relief_light.c: a relief of a sphere in a scene: shadows in both directions, bounced light. Requirements
 * P7-P11. */
#include "../sphere_relief.h"

void test_relief_light(void);

/* P7-P9 P11: above a floor: the sphere's shadows, shadows on the sphere, and visibility in both directions. */
static void shadows(const stage *s, lmb_light light)
{
    const lmb_view v = look(vec3(0.0f, 2.0f, 5.0f), vec3(0, 0, 0), 60.0, FRAME);
    relief_shot shot = shot_of(s, &v), truth;
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0.0f, -1.2f, 0.0f), vec3(0, 0, 3), vec3(3, 0, 0));
    world_quad(vec3(-0.9f, 1.6f, 0.0f), vec3(0, 0, 0.8f), vec3(0.6f, 0, 0));
    CHECK(world_end() == LMB_OK);
    shot.scene = &world.scene;
    shot.light = &light;
    shot.shadow_map = MAP;
    relief_frame got = shoot(&shot);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    truth = shot;
    truth.relief = NULL;
    relief_frame want = shoot(&truth);
    int same = 0, dark = 0, apart = 0;
    for (int i = 0; i < FRAME * FRAME; ++i) {
        same += got.lit[i] == want.lit[i];
        dark += want.depth[i] > 0.0f && !want.lit[i];
        apart += fabsf(got.depth[i] - want.depth[i]) > 0.02f;
    }
    CHECK_MSG(dark > 1000 && same > FRAME * FRAME * 98 / 100 && apart < FRAME * FRAME / 100,
              "%d dark, %d of %d the same, %d apart", dark, same, FRAME * FRAME, apart);
    relief_frame_free(&got);
    relief_frame_free(&want);
}

/* P7: a small picture has a small shadow map, and nearly the same pixels are lit as with a fine one. */
static void small_picture(const stage *s)
{
    enum { SMALL = 16 };
    const lmb_light light = sun(vec3(-0.6f, -0.64f, -0.48f));
    int same = 0, own = 0;
    const lmb_view large = look(vec3(0.0f, 2.0f, 5.0f), vec3(0, 0, 0), 40.0, FRAME),
                   small = look(vec3(0.0f, 2.0f, 5.0f), vec3(0, 0, 0), 40.0, SMALL);
    relief_shot shot = shot_of(s, &large);
    shot.light = &light;
    shot.shadow_map = 512;
    relief_frame fine = shoot(&shot);
    shot.view = small;
    relief_frame got = shoot(&shot);
    CHECK_MSG(got.map_side * 2 < fine.map_side && got.map_side >= SMALL, "maps of %d and %d", (int)got.map_side,
              (int)fine.map_side);
    for (int i = 0; i < SMALL * SMALL; ++i) {
        const int at = (i / SMALL * FRAME + i % SMALL) * (FRAME / SMALL) + (FRAME + 1) * (FRAME / SMALL / 2);
        own += got.depth[i] > 0.0f && fine.depth[at] > 0.0f;
        same += got.depth[i] > 0.0f && fine.depth[at] > 0.0f && got.lit[i] == fine.lit[at];
    }
    CHECK_MSG(own > 50 && same > own * 95 / 100, "%d of %d the same", same, own);
    relief_frame_free(&fine);
    relief_frame_free(&got);
}

/* Light that a floor reflects up arrives on a relief as on the sphere. */
static void receives_bounce(const stage *s)
{
    static uint32_t depth[FRAME * FRAME], id[FRAME * FRAME];
    static lmb_tile tile;
    static lmb_groups groups;
    static lmb_gather_scratch scratch;
    const lmb_view v = look(vec3(0.0f, -0.5f, 4.0f), vec3(0, 0, 0), 40.0, FRAME);
    lmb_irradiance bounced[2];
    lmb_scene simple;
    memset(&groups, 0, sizeof groups);
    memset(bounced, 0, sizeof bounced);
    groups.count = 1;
    set_group(&groups, 0, vec3(0, -3, 0), Y, 1.0f, 0.6f);
    groups.flux[0][0] = 10.0f;
    lmb_relief_scene(&simple, &s->relief);
    for (int i = 0; i < 2; ++i) {
        const lmb_scene *scene = i == 0 ? &simple : &s->complex.scene;
        lmb_target t = target_of(LMB_DEPTH32F, FRAME, depth, id);
        lmb_surface_clear(&t.depth);
        lmb_surface_clear(&t.id);
        CHECK(lmb_draw(&t, picked_kernels(), &v, scene, 1, WORLD_TRIANGLES, 0, NULL) == LMB_OK);
        CHECK(lmb_resolve_tile(&tile, picked_kernels(), &v, scene, &t, 64, 80) == LMB_OK);
        if (i == 0) {
            CHECK(lmb_relief_tile(&tile, picked_kernels(), &s->relief, &v, NULL, NULL) == LMB_OK);
        }
        int32_t hits = 0;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            hits += tile.id[k] != 0;
        }
        CHECK_MSG(tile.hits == hits, "%d, not %d", (int)tile.hits, (int)hits);
        CHECK(lmb_gather_tile(&bounced[i], picked_kernels(), &scratch, &tile, &groups, NULL, NULL) == LMB_OK);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; k += 9) {
        const double a = (double)bounced[0].rgb[0][k], b = (double)bounced[1].rgb[0][k];
        CHECK_MSG(b > 0.001 && fabs(a - b) < 0.01 * b, "%g, not %g", a, b);
    }
}

/* --- a room ------------------------------------------------------------------------------------------------------- */

/* Mean irradiance in shadow, and the mean difference between the frames there. */
typedef struct indirect {
    int pixels;
    double mean, off;
} indirect;

static void add_pixel(indirect *sum, const relief_frame *got, const relief_frame *want, int i)
{
    const double a = PI * (double)got->rgb[3 * i + 1] / (double)got->albedo[3 * i + 1],
                 b = PI * (double)want->rgb[3 * i + 1] / (double)want->albedo[3 * i + 1];
    ++sum->pixels;
    sum->mean += b;
    sum->off += fabs(a - b);
}

/* The sphere is on a floor beside a wall, under a sun: both reflect light to it from below and the side, and it
 * reflects light to both, as with the sphere's triangles. */
static void stands_in_a_room(const stage *s)
{
    const lmb_view v = look(vec3(1.5f, 0.8f, 4.5f), vec3(-0.4f, -0.2f, 0), 50.0, FRAME);
    const lmb_light light = sun(vec3(-0.5f, -1.0f, -0.3f));
    indirect ball = {0, 0.0, 0.0}, beside = {0, 0.0, 0.0};
    relief_shot shot = shot_of(s, &v), truth;
    world_begin(0.6f, 0.6f, 0.6f);
    world_quad(vec3(0.0f, -1.0f, 0.0f), vec3(0, 0, 3), vec3(3, 0, 0));
    world_quad(vec3(-1.6f, 0.5f, 0.0f), vec3(0, 1.5f, 0), vec3(0, 0, 3));
    CHECK(world_end() == LMB_OK);
    shot.scene = &world.scene;
    shot.light = &light;
    shot.shadow_map = MAP;
    shot.bounce = MAP / 2;
    relief_frame got = shoot(&shot);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    truth = shot;
    truth.relief = NULL;
    relief_frame want = shoot(&truth);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        const int same = got.depth[i] > 0.0f && want.depth[i] > 0.0f && fabsf(got.depth[i] - want.depth[i]) < 0.02f;
        if (same && !got.lit[i] && !want.lit[i]) {
            const int flat = want.normal[3 * i] > 0.999f || want.normal[3 * i + 1] > 0.999f;
            add_pixel(flat ? &beside : &ball, &got, &want, i);
        }
    }
    CHECK_MSG(ball.pixels > 300 && ball.mean > 0.0 && ball.off < 0.05 * ball.mean,
              "on the sphere: %d pixels, %g W/m2 together, off by %g", ball.pixels, ball.mean,
              ball.off);
    CHECK_MSG(beside.pixels > 300 && beside.mean > 0.0 && beside.off < 0.1 * beside.mean,
              "beside it: %d pixels, %g W/m2 together, off by %g", beside.pixels, beside.mean, beside.off);
    relief_frame_free(&got);
    relief_frame_free(&want);
}

/* A map of 8 x 8 texels in which only the last one has depth, near the light: it shadows points below it up to the
 * map's edge, and none at the other corners. */
static void last_texel(void)
{
    static uint32_t memory[8 * 8 * 4];
    static lmb_tile tile;
    static lmb_shadow_map map;
    const lmb_light light = sun(vec3(0, -1, 0));
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, -1, 0), vec3(0, 0, 1), X);
    world_quad(vec3(0, 1, 0), vec3(0, 0, 0.1f), vec3(0.1f, 0, 0));
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_shadow_map_init(&map, &light, &world.scene, 8, LMB_ID32, memory, sizeof memory) == LMB_OK);
    lmb_shadow_map_clear(&map);
    ((float *)map.face[0].depth.data)[63] = 1.0f;
    const lmb_view *v = &map.view[0];
    for (int k = 0; k < 4; ++k) {
        const float side = 0.975f * v->half_width, rise = 0.975f * v->half_height;
        const lmb_vec3 across = add3(mul3(v->right, k & 1 ? side : -side), mul3(v->up, k & 2 ? -rise : rise));
        const lmb_vec3 at = add3(add3(v->eye, across), vec3(0, -1.0f - v->eye.y - across.y, 0));
        tile.position[0][k] = at.x;
        tile.position[1][k] = at.y;
        tile.position[2][k] = at.z;
        tile.face[1][k] = 1.0f;
        tile.id[k] = 1;
    }
    CHECK_MSG(lmb_relief_lit(&map, &light, &tile) == 7, "%d", (int)lmb_relief_lit(&map, &light, &tile));
}

void test_relief_light(void)
{
    last_texel();
    stage *s = stage_make(LMB_RELIEF_FULL, 0);
    receives_bounce(s);
    small_picture(s);
    shadows(s, sun(vec3(0.2f, -1.0f, -0.1f)));
    shadows(s, point_light(vec3(-0.8f, 4.0f, 0.4f)));
    shadows(s, point_light(vec3(4.0f, 0.7f, 0.4f)));
    shadows(s, point_light(vec3(-2.0f, 1.5f, -3.0f)));
    stage_free(s);
    s = stage_make(LMB_RELIEF_FULL, 400);
    stands_in_a_room(s);
    stage_free(s);
}
