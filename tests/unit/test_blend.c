/* test_blend.c: blended surfaces cover a share alpha of the samples, also one behind another. */
#include "../world.h"

void test_blend(void);

#if LMB_MULTISAMPLE

enum { SIDE = 64 };

static struct {
    uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
} blend;

static uint8_t shown[SIDE * SIDE][8]; /* by pixel and id of a triangle: samples that show it */

static void draw_samples(int32_t samples, uint32_t flags)
{
    lmb_view v;
    lmb_target t;
    memset(&t, 0, sizeof t);
    memset(shown, 0, sizeof shown);
    CHECK(lmb_view_look_at(&v, vec3(0, 0, 5), vec3(0, 0, 0), Y, 0.6f, SIDE, SIDE) == LMB_OK);
    v.near_m = 0.1f;
    for (int32_t i = 0; i < samples; ++i) {
        lmb_view sample = v;
        lmb_view_sample(&sample, samples, i);
        lmb_surface_init(&t.depth, LMB_DEPTH32F, SIDE, SIDE, blend.depth, sizeof blend.depth);
        lmb_surface_init(&t.id, LMB_ID32, SIDE, SIDE, blend.id, sizeof blend.id);
        lmb_surface_clear(&t.depth);
        lmb_surface_clear(&t.id);
        CHECK(lmb_draw(&t, lmb_kernels_at(0), &sample, &world.scene, 1, 8, flags, NULL) == LMB_OK);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            ++shown[k][blend.id[k] & 7];
        }
    }
}

/* Counts the samples that show each triangle's id, over all pixels. */
static void count_ids(uint32_t counts[8], int32_t samples, uint32_t flags)
{
    draw_samples(samples, flags);
    for (int id = 0; id < 8; ++id) {
        counts[id] = 0;
        for (int k = 0; k < SIDE * SIDE; ++k) {
            counts[id] += shown[k][id];
        }
    }
}

/* Walls that fill the picture, nearest first; only the last has the second material. */
static void walls(int count, float near_alpha, float last_alpha)
{
    const float alpha[2] = {near_alpha, last_alpha};
    world_begin(0.5f, 0.5f, 0.5f);
    for (int i = 0; i < count; ++i) {
        if (i == count - 1) {
            world_part();
        }
        world_quad(vec3(0, 0, 1.0f - (float)i), mul3(X, 9), mul3(Y, 9));
    }
    for (int i = 0; i < 2; ++i) {
        world.material[i].alpha = alpha[i];
        world.material[i].flags |= LMB_ALPHA_MASK | LMB_ALPHA_BLEND;
        world.material[i].alpha_cutoff = 0.5f;
    }
    CHECK(world_end() == LMB_OK);
}

static void check_shares(float near_alpha, float far_alpha, int32_t samples)
{
    const double all = (double)samples * SIDE * SIDE;
    uint32_t n[8];
    walls(2, near_alpha, far_alpha);
    count_ids(n, samples, LMB_CULL_BACK | LMB_BLEND);
    const double near_share = (n[1] + n[2]) / all, far_share = (n[3] + n[4]) / all;
    CHECK_MSG(fabs(near_share - (double)near_alpha) <= 1.0 / 64, "%g of %g", near_share, (double)near_alpha);
    const double want = (1.0 - near_share) * (double)far_alpha, within = samples == 16 ? 0.02 : 0.04;
    CHECK_MSG(fabs(far_share - want) <= within, "%d samples: %g instead of %g", (int)samples, far_share, want);
}

/* Three walls with the same alpha in front of nothing: each covers a share alpha of the rest. */
static void check_layers(float alpha, int32_t samples)
{
    uint32_t n[8];
    walls(3, alpha, alpha);
    count_ids(n, samples, LMB_BLEND);
    const double left = n[0] / ((double)samples * SIDE * SIDE), open = 1.0 - (double)alpha;
    CHECK_MSG(fabs(left - open * open * open) <= 0.02, "%d samples of %g: %g is left", (int)samples, (double)alpha, left);
}

/* At alpha 1/2, two of a pixel's four samples show the surface. */
static void check_strips(void)
{
    int wrong = 0;
    walls(2, 0.5f, 1.0f);
    draw_samples(4, LMB_BLEND);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        wrong += shown[k][1] + shown[k][2] != 2;
    }
    CHECK_MSG(wrong <= SIDE, "%d", wrong); /* except pixels in which two triangles meet */
}

/* Two walls of alpha 1/2 leave a quarter of a pixel's samples, with little grain. */
static void check_grain(void)
{
    double sum2 = 0.0;
    walls(2, 0.5f, 0.5f);
    draw_samples(16, LMB_BLEND);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const double off = shown[k][0] / 16.0 - 0.25;
        sum2 += off * off;
    }
    const double grain = sqrt(sum2 / (SIDE * SIDE));
    CHECK_MSG(grain < 0.1, "%g", grain);
}

/* A wall far away: the texture's period is a pixel, so each pixel shows the mean of alpha, a quarter. */
static void check_far(int32_t width, int32_t height)
{
    static uint8_t texels[4 * 2 * 96 * 96];
    uint32_t n[8];
    walls(2, 1.0f, 1.0f);
    world.texture.texels = texels;
    world.texture.width = (uint16_t)width;
    world.texture.height = (uint16_t)height;
    world.texture.levels = (uint8_t)lmb_texture_level_count(width, height);
    world.texture.filter = LMB_TRILINEAR;
    for (int32_t i = 0; i < width * height; ++i) {
        texels[4 * i + 3] = i % width < width / 4 ? 255 : 0;
    }
    lmb_texture_mips(texels, width, height, world.texture.levels);
    world.scene.texture_count = 1;
    world.material[0].texture = 0;
    const float repeats = 18.0f / (2.0f * 4.0f * tanf(0.3f)) * SIDE; /* over the wall, 18 m wide and 4 m away */
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k) {
            world.uvs[i][k][0] *= repeats;
            world.uvs[i][k][1] *= repeats;
        }
    }
    lmb_view v;
    CHECK(lmb_view_look_at(&v, vec3(0, 0, 5), vec3(0, 0, 0), Y, 0.6f, SIDE, SIDE) == LMB_OK);
    CHECK(fabsf(lmb_triangle_alpha(&v, &world.scene, 1, 40, 50) - (float)(width / 4) / (float)width) < 0.02f);
    for (int32_t samples = 1; samples <= 4; samples *= 4) {
        count_ids(n, samples, LMB_BLEND);
        const double share = (n[1] + n[2]) / ((double)samples * SIDE * SIDE), want = (double)(width / 4) / width;
        CHECK_MSG(fabs(share - want) < 0.02, "%dx%d, %d samples: %g of %g", (int)width, (int)height, (int)samples, share, want);
    }
}

/* A texture with the same alpha everywhere, under the cutoff. */
static void check_even(void)
{
    static uint8_t texels[4 * 8 * 8];
    uint32_t n[8];
    walls(2, 1.0f, 1.0f);
    memset(texels, 64, sizeof texels);
    world.texture.texels = texels;
    world.texture.width = world.texture.height = 8;
    world.texture.levels = 1;
    world.scene.texture_count = 1;
    world.material[0].texture = 0;
    count_ids(n, 4, LMB_BLEND);
    const double share = (n[1] + n[2]) / (4.0 * SIDE * SIDE);
    CHECK_MSG(fabs(share - 64.0 / 255.0) < 0.02, "%g", share);
}

void test_blend(void)
{
    static const float alphas[] = {0.0f, 0.1f, 0.3f, 0.5f, 0.77f, 1.0f};
    uint32_t n[8];
    for (int i = 0; i < COUNT(alphas) * COUNT(alphas); ++i) {
        for (int32_t samples = 1; samples <= 16; samples *= 4) {
            check_shares(alphas[i % COUNT(alphas)], alphas[i / COUNT(alphas)], samples);
        }
    }
    for (int32_t samples = 1; samples <= 16; samples *= 4) {
        check_layers(0.25f, samples);
        check_layers(0.6f, samples);
    }
    check_strips();
    check_grain();
    check_even();
    check_far(64, 64);
    check_far(96, 96);
    check_far(33, 7);
    check_far(81, 5);
    walls(2, 0.6f, 1.0f); /* lights use the cutoff */
    count_ids(n, 1, 0);
    CHECK(n[1] + n[2] == SIDE * SIDE);
}

#else
void test_blend(void) { test_skip("no samples in this build"); }
#endif
