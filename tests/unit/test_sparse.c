/* test_sparse.c: light gathered at some pixels: even light stays even, surfaces do not mix, isolated pixels are
 * gathered. */
#include "../world.h"

void test_sparse(void);

enum { SIDE = 64, MAP = 32, POINTS = 4096 };

static lmb_tile tile;
static lmb_irradiance light;

/* A tile of the plane z = 0 with 1 cm per pixel, viewed from above. */
static void flat_tile(void)
{
    memset(&tile, 0, sizeof tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.position, k, vec3(0.01f * (float)(k % 8), 0.01f * (float)(k / 8), 0.0f));
        set_plane(tile.face, k, Z);
        set_plane(tile.normal, k, Z);
        tile.id[k] = 1;
    }
    tile.hits = LMB_TILE_PIXELS;
}

static void set_light(int k, float v)
{
    for (int c = 0; c < 3; ++c) {
        light.rgb[c][k] = v * (float)(c + 1);
    }
}

/* Sets unknown pixels to an extreme value, so that using one shows. */
static void forget(uint64_t known)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((known >> k & 1u) == 0) {
            set_light(k, -1e6f);
        }
    }
}

static int count(uint64_t bits)
{
    int n = 0;
    for (; bits != 0; bits &= bits - 1) {
        ++n;
    }
    return n;
}

/* A constant gives exactly this value; a slope gives the slope. */
static void even_light(int32_t step)
{
    flat_tile();
    const uint64_t known = lmb_sparse_pixels(&tile, step);
    CHECK(count(known) == 64 / (step * step));
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_light(k, 0.1f);
    }
    forget(known);
    CHECK(lmb_upsample_tile(&light, &tile, known, step) == 0);
    int exact = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        exact += light.rgb[0][k] == 0.1f && light.rgb[1][k] == 0.2f && light.rgb[2][k] == 0.1f * 3.0f;
    }
    CHECK_MSG(exact == LMB_TILE_PIXELS, "%d of 64", exact);
    float worst = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_light(k, 2.0f + 0.05f * (float)(k % 8) + 0.03f * (float)(k / 8));
    }
    forget(known);
    CHECK(lmb_upsample_tile(&light, &tile, known, step) == 0);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        worst = maxf(worst, absf(light.rgb[0][k] - (2.0f + 0.05f * (float)(k % 8) + 0.03f * (float)(k / 8))));
    }
    CHECK_MSG(worst < 1e-6f, "%g", (double)worst);
}

/* Both lights increase downwards; the second is far brighter. */
static float two_lights(int k, int border)
{
    return (k % 8 >= border ? 50.0f : 0.5f) * (1.0f + 0.03f * (float)(k / 8));
}

/* Two surfaces, with the border at each column in turn: neither takes light from the other. `wall`: they meet in a
 * corner; otherwise the second lies 10 cm below the first. */
static void two_surfaces(int32_t step, int wall)
{
    int wrong = 0, asked = 0;
    for (int border = 1; border < 8; ++border) {
        flat_tile();
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            if (k % 8 >= border && wall) {
                set_plane(tile.position, k,
                          vec3(0.01f * (float)border, 0.01f * (float)(k / 8), 0.01f * (float)(k % 8 - border)));
                set_plane(tile.face, k, mul3(X, -1.0f));
                set_plane(tile.normal, k, mul3(X, -1.0f));
            } else if (k % 8 >= border) {
                tile.position[2][k] = -0.1f;
            }
        }
        const uint64_t known = lmb_sparse_pixels(&tile, step);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            set_light(k, two_lights(k, border));
        }
        forget(known);
        CHECK(lmb_upsample_tile(&light, &tile, known, step) == 0);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            wrong += absf(light.rgb[0][k] / two_lights(k, border) - 1.0f) > 1e-5f;
        }
        asked += count(known);
    }
    CHECK_MSG(wrong == 0, "%d pixels", wrong);
    CHECK_MSG(asked < 7 * 64, "all pixels gathered"); /* the samples explain some pixels */
}

/* A single pixel unlike its surroundings, or turned away: only this one is gathered besides the samples. */
static void lone_pixel(int32_t step)
{
    const int lone = 3 + 8 * 4;
    flat_tile();
    const uint64_t samples = lmb_sparse_pixels(&tile, step);
    tile.position[2][lone] = 0.5f;
    CHECK(lmb_sparse_pixels(&tile, step) == (samples | UINT64_C(1) << lone));
    flat_tile();
    set_plane(tile.normal, lone, normalize3(vec3(1, 0, 1)));
    CHECK(lmb_sparse_pixels(&tile, step) == (samples | UINT64_C(1) << lone));
    flat_tile();
    tile.id[lone] = 0;
    CHECK(lmb_sparse_pixels(&tile, step) == samples);
}

/* Light that ends between two samples: the pixels in between are returned for gathering, the others are not. */
static void uneven_light(int32_t step)
{
    flat_tile();
    const uint64_t known = lmb_sparse_pixels(&tile, step);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_light(k, k % 8 > 4 ? 1.0f : 0.5f);
    }
    const uint64_t between = step == 2 ? UINT64_C(0x1818181818181818) : UINT64_C(0x7e7e7e7e7e7e7e7e);
    CHECK(lmb_upsample_tile(&light, &tile, known, step) == (between & ~known));
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE], map_memory[2 * MAP * MAP];
static float full[SIDE * SIDE * 3], sparse[SIDE * SIDE * 3], again[SIDE * SIDE * 3];
LMB_POINTS_ARRAY(points, POINTS, MAP / 4);
static lmb_groups groups;
static lmb_band_scratch scratch;
static lmb_render render;
static lmb_light ceiling_light;

static lmb_frame frame_of(float *out, int32_t step)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = picked_kernels();
    f.scene = &world.scene;
    f.view = look(vec3(0.3f, 0.4f, 0.95f), vec3(-0.2f, -0.6f, -0.8f), 75, SIDE);
    f.show = LMB_SHOW_IRRADIANCE;
    f.shadow_map = MAP;
    f.grouping.block = 4;
    f.grouping.groups = 60;
    f.gather_step = step;
    f.map_memory = map_memory;
    f.map_bytes = sizeof map_memory;
    f.points = points;
    f.groups = &groups;
    f.eye = target_of(LMB_DEPTH32F, SIDE, depth, id);
    f.scratch = &scratch;
    CHECK(lmb_surface_init(&f.out, LMB_RGB32F, SIDE, SIDE, out, sizeof full) == LMB_OK);
    return f;
}

/* Bands from last to first, with noise in the scratch. */
static void render_backward(const lmb_frame *f)
{
    CHECK(lmb_render_begin(&render, f) == LMB_OK);
    while (render.stage < LMB_STAGE_BANDS) {
        CHECK(lmb_render_step(&render, 64) == LMB_MORE);
    }
    for (int32_t band = SIDE / 8 - 1; band >= 0; --band) {
        memset(&scratch, 0x7f, sizeof scratch);
        CHECK(lmb_render_band(&render, &scratch, &f->eye, &f->out, band) == LMB_OK);
    }
}

/* Gathered pixels equal the full picture, the rest is near it. Without occlusion a pixel's light does not depend on
 * others. */
static void compare_frames(int32_t step)
{
    lmb_frame f = frame_of(full, 1);
    int asked = 0, other = 0, off = 0;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    f = frame_of(again, step);
    render_backward(&f);
    f = frame_of(sparse, step);
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    CHECK(memcmp(sparse, again, sizeof sparse) == 0);
    for (int32_t y = 0; y < SIDE; y += 8) {
        for (int32_t x = 0; x < SIDE; x += 8) {
            CHECK(lmb_resolve_tile(&tile, f.kernels, &f.view, f.scene, &f.eye, x, y) == LMB_OK);
            const uint64_t pixels = lmb_sparse_pixels(&tile, step);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                const int at = 3 * ((y + k / 8) * SIDE + x + k % 8), is = (int)(pixels >> k & 1u);
                asked += is;
                other += is && memcmp(full + at, sparse + at, 12) != 0;
                off += absf(sparse[at] - full[at]) > 0.1f * full[at];
            }
        }
    }
    printf("  every %d: %.1f %% of the pixels asked first, %d of %d off by a tenth\n", (int)step,
           100.0 * asked / (SIDE * SIDE), off, SIDE * SIDE);
    CHECK_MSG(other == 0, "%d of %d", other, asked);
    CHECK_MSG(asked < SIDE * SIDE / (step == 2 ? 2 : 4), "%d", asked);
    CHECK_MSG(off < SIDE * SIDE / (step == 2 ? 25 : 9), "%d pixels", off); /* most lie in the corners of the room */
}

static void refused(void)
{
    lmb_frame f = frame_of(full, 3);
    CHECK(lmb_sparse_pixels(NULL, 2) == 0 && lmb_sparse_pixels(NULL, 1) == 0);
    CHECK(lmb_upsample_tile(NULL, &tile, 0, 2) == 0 && lmb_upsample_tile(&light, NULL, 0, 2) == 0);
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f.gather_step = -1;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
}

void test_sparse(void)
{
    for (int32_t step = 2; step <= 4; step += 2) {
        even_light(step);
        two_surfaces(step, 0);
        two_surfaces(step, 1);
        lone_pixel(step);
        uneven_light(step);
    }
    world_begin(0.7f, 0.6f, 0.5f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_box(vec3(-0.3f, -0.8f, -0.3f), 0.2f);
    CHECK(world_end() == LMB_OK);
    ceiling_light = spot(vec3(0.5f, 0.8f, 0.1f), vec3(-0.5f, -1, -0.3f), 20, 40);
    world.scene.lights = &ceiling_light;
    world.scene.light_count = 1;
    compare_frames(2);
    compare_frames(4);
    refused();
}
