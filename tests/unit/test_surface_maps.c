/* test_surface_maps.c: emission and metallic-roughness maps, per texel for visible pixels; the emission of elements
 * with a map. */
enum { FRAME = 64, MAP = 64, FACES = 1, ELEMENTS = 1024, BVH = 16, SIDE = 32 };

#include "../bounce_frame.h"

#include "../../tools/render/own_light.h"

void test_surface_maps(void);

static uint32_t texels[SIDE * SIDE * 2];

/* Codes `left` for u < 1/2, otherwise `right`; mips of colours or of plain codes. */
static void set_halves(const uint8_t left[4], const uint8_t right[4], int filter, int is_colour)
{
    for (int i = 0; i < SIDE * SIDE; ++i) {
        memcpy(&texels[i], i % SIDE < SIDE / 2 ? left : right, 4);
    }
    world.texture.texels = (const uint8_t *)texels;
    world.texture.width = world.texture.height = SIDE;
    world.texture.filter = (uint8_t)filter;
    world.texture.wrap_s = world.texture.wrap_t = LMB_WRAP_CLAMP;
    world.texture.levels = filter == LMB_TRILINEAR ? (uint8_t)lmb_texture_level_count(SIDE, SIDE) : 1;
    CHECK((is_colour ? lmb_texture_mips : lmb_normal_map_mips)((uint8_t *)texels, SIDE, SIDE, world.texture.levels) ==
          LMB_OK);
}

static const uint8_t black[4] = {0, 0, 0, 255}, white[4] = {255, 255, 255, 255}, grey[4] = {188, 188, 188, 255};

/* --- emission ----------------------------------------------------------------------------------------------------- */

/* A black wall of 2 x 2 m at z = 0 with a glowing right half. */
static void make_glow(int filter)
{
    world_begin(0, 0, 0);
    set_halves(black, white, filter, 1);
    world.material[0].emission[0] = 3.0f;
    world.material[0].emission[2] = 0.5f;
    world.material[0].emission_map = 1;
    world.material[0].flags = 0;
    world_quad(vec3(0, 0, 0), X, Y);
    CHECK(world_end() == LMB_OK);
}

/* From a distance at which the wall fills the picture, or a `share` of it. */
static void draw_front(float share, int32_t show)
{
    const lmb_view v = look(vec3(0, 0, 1.0f / share), vec3(0, 0, 0), 90, FRAME);
    lmb_frame f = bounce_frame(&v, 1);
    f.show = show;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
}

static void test_seen(void)
{
    for (int filter = LMB_NEAREST; filter <= LMB_TRILINEAR; ++filter) {
        int dark = 0, lit = 0;
        make_glow(filter);
        draw_front(1.0f, LMB_SHOW_DIRECT);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            const int x = i % FRAME;
            const float *p = &picture[3 * i];
            dark += x < FRAME / 2 - 2 && p[0] == 0.0f && p[1] == 0.0f && p[2] == 0.0f;
            lit += x >= FRAME / 2 + 2 && absf(p[0] - 3.0f) < 1e-5f && p[1] == 0.0f && absf(p[2] - 0.5f) < 1e-5f;
        }
        CHECK_MSG(dark == FRAME * (FRAME / 2 - 2) && lit == dark, "filter %d: %d dark, %d lit", filter, dark, lit);
    }
}

/* Stripes of one texel, from a distance with four per pixel: levels give the mean. */
static void test_far(void)
{
    int good = 0, all = 0;
    make_glow(LMB_TRILINEAR);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        memcpy(&texels[i], i % 2 ? white : black, 4);
    }
    CHECK(lmb_texture_mips((uint8_t *)texels, SIDE, SIDE, world.texture.levels) == LMB_OK);
    draw_front(0.0625f, LMB_SHOW_DIRECT);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        if (picture[3 * i] > 0.0f) {
            ++all;
            good += absf(picture[3 * i] - 1.5f) < 0.02f;
        }
    }
    CHECK_MSG(all == 16 && good == all, "%d of %d pixels", good, all);
}

/* --- emission of elements ------------------------------------------------------------------------------------- */

/* All light comes from the glowing half: pi L 2 m2; pieces across the edge have their share. */
static void check_elements(int filter, double bar)
{
    lmb_elements e;
    double right = 0.0, left = 0.0;
    int wrong = 0;
    make_glow(filter);
    CHECK(lmb_elements_init(&e, ELEMENTS, element_memory, sizeof element_memory) == LMB_OK);
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    for (uint32_t i = 0; i < e.count; ++i) {
        const lmb_element *p = &e.data[i];
        const float from = minf(p->corner[0].x, minf(p->corner[1].x, p->corner[2].x)),
                    to = maxf(p->corner[0].x, maxf(p->corner[1].x, p->corner[2].x));
        *(from + to > 0.0f ? &right : &left) += (double)(p->emission[0] * p->area);
        wrong += (to < -0.15f && p->emission[0] != 0.0f) || (from > 0.15f && absf(p->emission[0] - 3.0f) > 1e-4f);
    }
    CHECK_MSG(wrong == 0, "filter %d: %d of %u elements", filter, wrong, (unsigned)e.count);
    CHECK_MSG(fabs((left + right) / 6.0 - 1.0) < bar && left < 0.05 * right, "filter %d: %g left, %g right", filter,
              left, right);
}

/* If one texel of 1,024 glows, the 64 elements of a two-triangle wall include it. */
static void test_small(void)
{
    lmb_elements e;
    for (int filter = LMB_BILINEAR; filter <= LMB_TRILINEAR; ++filter) {
        double all = 0.0;
        make_glow(filter);
        for (int i = 0; i < SIDE * SIDE; ++i) {
            memcpy(&texels[i], i == 9 * SIDE + 21 ? white : black, 4);
        }
        CHECK(lmb_texture_mips((uint8_t *)texels, SIDE, SIDE, world.texture.levels) == LMB_OK);
        CHECK(lmb_elements_init(&e, 64, element_memory, sizeof element_memory) == LMB_OK);
        CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
        for (uint32_t i = 0; i < e.count; ++i) {
            all += (double)(e.data[i].emission[0] * e.data[i].area);
        }
        const double want = 3.0 * 4.0 / (SIDE * SIDE);
        CHECK_MSG(fabs(all / want - 1.0) < 0.25, "filter %d: %g of it", filter, all / want);
    }
}

/* --- metal and roughness ------------------------------------------------------------------------------------------ */

static lmb_glossy glossy;

/* A wall with a metal left half of G = 0.4 and a non-metal right half of G = 1. */
static void make_metal(float metallic)
{
    static const uint8_t metal[4] = {255, 102, 255, 255}, plain[4] = {255, 255, 0, 255};
    world_begin(0.8f, 0.6f, 0.4f);
    set_halves(metal, plain, LMB_NEAREST, 0);
    world.material[0].flags = 0;
    world.material[0].specular[0] = world.material[0].specular[1] = world.material[0].specular[2] = 0.04f;
    world.material[0].roughness = 0.5f;
    world.material[0].metallic = metallic;
    world.material[0].metal_map = 1;
    world_quad(vec3(0, 0, 0), X, Y);
    CHECK(world_end() == LMB_OK);
}

/* Pixels of two tiles, left and right of the centre. */
static void check_metal(int32_t x, double albedo, double f0, double roughness)
{
    const lmb_view v = look(vec3(0, 0, 1), vec3(0, 0, 0), 90, FRAME);
    lmb_target t = target_of(LMB_DEPTH32F, FRAME, depth_memory, id_memory);
    lmb_tile *tile = &scratch.tile;
    int good = 0;
    world_draw(&t, &v, 0);
    CHECK(lmb_resolve_tile(tile, picked_kernels(), &v, &world.scene, &t, x, 24) == LMB_OK);
    CHECK(lmb_glossy_tile(&glossy, tile, &v, &world.scene) == 1);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const double a2 = fmax(pow(roughness, 4), 1e-4);
        good += fabs((double)tile->albedo[0][k] - albedo) < 1e-5 && fabs((double)glossy.specular[0][k] - f0) < 1e-5 &&
                fabs((double)glossy.alpha2[k] - a2) < 1e-5;
    }
    CHECK_MSG(good == LMB_TILE_PIXELS, "x %d: %d pixels; albedo %g, F0 %g, alpha2 %g", (int)x, good,
              (double)tile->albedo[0][0], (double)glossy.specular[0][0], (double)glossy.alpha2[0]);
}

static void test_metal(void)
{
    make_metal(1.0f);
    check_metal(16, 0.0, 0.8, 0.2);
    check_metal(40, 0.8, 0.04, 0.5);
    make_metal(0.5f);
    check_metal(16, 0.4, 0.04 + 0.76 * 0.5, 0.2);
    /* With vertex and base colours too: here both are half, as codes 188 and 128. */
    static uint8_t colours[6 * 4];
    memset(colours, 128, sizeof colours);
    make_metal(1.0f);
    world.mesh[0].colours = colours;
    set_halves(grey, grey, LMB_NEAREST, 1);
    world.material[0].texture = 0;
    const double base = 0.8 * 0.5028865 * 128 / 255.0, metallic = 188 / 255.0; /* sRGB and linear */
    check_metal(16, base * (1.0 - metallic), 0.04 + (base - 0.04) * metallic, 0.5 * metallic);
}

/* Pixels of a triangle that the scene does not have, as in a tile of another scene, get no metal and no base colour. */
static void test_missing_triangle(void)
{
    const lmb_view v = look(vec3(0, 0, 1), vec3(0, 0, 0), 90, FRAME);
    lmb_target t = target_of(LMB_DEPTH32F, FRAME, depth_memory, id_memory);
    lmb_tile *tile = &scratch.tile;
    int pixels[2] = {0, 0}, good = 0;
    make_metal(1.0f);
    world_draw(&t, &v, 0);
    CHECK(lmb_resolve_tile(tile, picked_kernels(), &v, &world.scene, &t, 16, FRAME - 24) == LMB_OK);
    world.mesh[0].vertex_count = 3; /* of the second triangle's vertices none */
    CHECK(lmb_glossy_tile(&glossy, tile, &v, &world.scene) == 1);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int missing = tile->id[k] == 2;
        ++pixels[missing];
        good += fabs((double)glossy.specular[0][k] - (missing ? 0.04 : 0.8)) < 1e-5 &&
                fabs((double)glossy.alpha2[k] - (missing ? 1e-4 : 0.0016)) < 1e-5;
    }
    CHECK_MSG(pixels[0] > 8 && pixels[1] > 8 && good == LMB_TILE_PIXELS, "%d and %d pixels, %d good", pixels[0],
              pixels[1], good);
}

/* Elements reflect only with the non-metal part: the right half. */
static void test_metal_elements(void)
{
    lmb_elements e;
    double sum = 0.0;
    make_metal(1.0f);
    CHECK(lmb_elements_init(&e, ELEMENTS, element_memory, sizeof element_memory) == LMB_OK);
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    for (uint32_t i = 0; i < e.count; ++i) {
        sum += (double)(e.data[i].albedo[0] * e.data[i].area);
    }
    CHECK_MSG(fabs(sum / 1.6 - 1.0) < 0.02, "%g m2", sum);
}

/* --- refused input; the light of a scene -------------------------------------------------------------------------- */

static void test_checked(void)
{
    make_glow(LMB_NEAREST);
    world.material[0].emission_map = 2;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_SCENE);
    world.material[0].emission_map = 0;
    world.material[0].metal_map = 2;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_SCENE);
    world.material[0].metal_map = 1;
    world.material[0].metallic = 1.5f;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.material[0].metallic = NAN;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.material[0].metallic = 1.0f;
    CHECK(lmb_scene_check(&world.scene) == LMB_OK);
}

/* A lamp at the ceiling of a room lights it; the same lamp outside a box does not, however bright it looks, because
 * nothing receives it. */
static void test_own_light(void)
{
    report r = {""};
    world_begin(0.5f, 0.5f, 0.5f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_part();
    world_quad(vec3(0, 0.99f, 0), mul3(X, 0.2f), mul3(Z, 0.2f)); /* front: down */
    world.material[1].flags = 0;
    world.material[1].emission[0] = world.material[1].emission[1] = world.material[1].emission[2] = 2.0f;
    CHECK(world_end() == LMB_OK);
    /* pi L A over 24 m2 of walls with two sides, except where the brightness exceeds the limit that counts. */
    const double room = (double)own_light(&world.scene, &r), all = PI * 2.0 * 0.16 / 48.16;
    CHECK_MSG(room > 2.0 * (double)OWN_LIGHT && room < all, "%g of %g W/m2", room, all);
    for (int i = 0; i < 6; ++i) {
        world.corners[world.first + (uint32_t)i / 3][i % 3][1] = -1.01f;
    }
    CHECK(world_end() == LMB_OK);
    const double outside = (double)own_light(&world.scene, &r);
    CHECK_MSG(outside >= 0.0 && outside < (double)OWN_LIGHT / 10.0, "%g W/m2", outside);
}

void test_surface_maps(void)
{
    test_seen();
    test_far();
    check_elements(LMB_NEAREST, 0.03);
    check_elements(LMB_BILINEAR, 0.01);
    check_elements(LMB_TRILINEAR, 0.01);
    test_small();
    test_metal();
    test_missing_triangle();
    test_metal_elements();
    test_checked();
    test_own_light();
}
