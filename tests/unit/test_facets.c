/* test_facets.c: the light of the facets that show in one texel of the tree. */
#include <lambent/lambent.h>

#include "../world.h"

enum { FRAME = 48, MAP = 128, FACES = 1, ELEMENTS = 64, BVH = 2048, TREE = MAP / 4, SIDES = 12, PARTS = 5 };

#include "../bounce_frame.h"

void test_facets(void);

#if LMB_FACETS

static uint8_t colours[3 * WORLD_TRIANGLES][4], texel[4];
static float plain[FRAME * FRAME * 3];

enum { BY_ALBEDO, BY_COLOURS, BY_TEXTURE, BY_NEEDLES, BY_PARTS };
enum { LEVEL = 64 /* linear */, CODE = 137 /* sRGB */ };

/* A column on a floor, in a spot from the side; the floor's albedo is `albedo`, LEVEL or CODE. */
static void draw_column(int by, double albedo)
{
    const lmb_view v = look(vec3(0.3f, 1.6f, 2.2f), vec3(0, 0.3f, 0), 50, FRAME);
    world_begin(0.8f, 0.8f, 0.8f);
    world_quad(vec3(0, 0, 0), mul3(Z, 3.0f), mul3(X, 3.0f));
    world_part();
    for (int i = 0; i < SIDES; ++i) {
        const float a = (float)(2.0 * PI * i / SIDES), b = (float)(2.0 * PI * (i + 1) / SIDES);
        const lmb_vec3 p = vec3(0.4f * cosf(a), 0, 0.4f * sinf(a)), q = vec3(0.4f * cosf(b), 0, 0.4f * sinf(b)),
                       up = vec3(0, 1, 0);
        const int parts = by == BY_PARTS ? PARTS : 1;
        for (int k = 0; k < parts * parts; ++k) {
            const float to_q = (float)(k % parts) / (float)parts, height = (float)(k / parts) / (float)parts;
            const lmb_vec3 wide = mul3(sub3(q, p), 1.0f / (float)parts), high = mul3(up, 1.0f / (float)parts),
                           at = add3(add3(p, mul3(sub3(q, p), to_q)), mul3(up, height));
            world_triangle(at, add3(at, high), add3(add3(at, high), wide));
            world_triangle(at, add3(add3(at, high), wide), add3(at, wide));
        }
    }
    for (int i = 0; i < 1900 && by == BY_NEEDLES; ++i) { /* around the column: three points in a line each */
        const float a = (float)(2.0 * PI * i / 1900);
        const lmb_vec3 at = vec3(floorf(440.0f * cosf(a)) / 1024.0f, 0.0078125f * (float)(i % 8 + 1),
                                 floorf(440.0f * sinf(a)) / 1024.0f),
                       step = vec3((float)(i % 16 - 8) / 128.0f, (float)(i % 5) / 128.0f, (float)(i % 11 - 5) / 128.0f);
        world_triangle(at, add3(at, mul3(step, 3)), add3(at, step));
    }
    memset(colours, by == BY_COLOURS ? LEVEL : 255, sizeof colours);
    memset(texel, CODE, sizeof texel);
    texel[3] = 255;
    world.texture.texels = texel;
    world.texture.width = world.texture.height = world.texture.levels = 1;
    world.texture.filter = LMB_NEAREST;
    for (int c = 0; c < 3; ++c) {
        world.material[0].albedo[c] = by != BY_COLOURS && by != BY_TEXTURE ? (float)albedo : 1.0f;
    }
    CHECK(world_end() == LMB_OK);
    const lmb_light light = spot(vec3(2.5f, 2.0f, 1.5f), vec3(-2.5f, -1.7f, -1.5f), 10, 40);
    world.scene.lights = &light;
    world.scene.light_count = 1;
    if (by == BY_COLOURS) {
        world.mesh[0].colours = colours[0];
    }
    world.material[0].texture = by == BY_TEXTURE ? 0 : -1;
    lmb_frame f = bounce_frame(&v, 1);
    CHECK(lmb_tree_init(&f.tree, FACES, TREE, tree_memory, sizeof tree_memory) == LMB_OK);
    f.show = LMB_SHOW_IRRADIANCE;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
}

/* A facet's light goes with its own albedo, whether that comes from the material, a texture or vertex colours. */
static void check_albedo(int by, double albedo)
{
    double worst = 0.0, mean = 0.0;
    draw_column(BY_ALBEDO, albedo);
    memcpy(plain, picture, sizeof plain);
    draw_column(by, albedo);
    for (int i = 0; i < COUNT(plain); ++i) {
        worst = fmax(worst, fabs((double)picture[i] - (double)plain[i]));
        mean += (double)plain[i] / COUNT(plain);
    }
    CHECK_MSG(mean > 0.0 && worst < 0.001 * mean, "albedo by %d: %g apart, mean %g", by, worst, mean);
}

/* Triangles without area that show in the map, because of rounding to pixels, are no facets; the light stays. */
static void check_needles(void)
{
    double sum[2] = {0.0, 0.0};
    int under = 0;
    for (int with = 0; with < 2; ++with) {
        draw_column(with ? BY_NEEDLES : BY_ALBEDO, 0.5);
        for (int i = 0; i < COUNT(picture); ++i) {
            under += !(picture[i] >= 0.0f);
            sum[with] += (double)picture[i];
        }
    }
    CHECK_MSG(under == 0 && sum[0] > 0.0 && fabs(sum[1] / sum[0] - 1.0) < 0.02, "%g, with needles %g", sum[0], sum[1]);
}

/* Triangles of one plane do not end at each other. */
static void check_parts(void)
{
    double sum[2] = {0.0, 0.0};
    for (int with = 0; with < 2; ++with) {
        draw_column(with ? BY_PARTS : BY_ALBEDO, 0.5);
        for (int i = 0; i < COUNT(picture); ++i) {
            sum[with] += (double)picture[i];
        }
    }
    CHECK_MSG(sum[0] > 0.0 && fabs(sum[1] / sum[0] - 1.0) < 0.005, "%g, in parts %g", sum[0], sum[1]);
}

void test_facets(void)
{
    check_albedo(BY_COLOURS, LEVEL / 255.0);
    check_albedo(BY_TEXTURE, pow((CODE / 255.0 + 0.055) / 1.055, 2.4));
    check_needles();
    check_parts();
}

#else

void test_facets(void) {}

#endif
