/* test_facets.c: the light of the facets that show in one texel of the tree. */
#include <lambent/lambent.h>

#include "../world.h"

enum { FRAME = 48, MAP = 128, FACES = 1, ELEMENTS = 64, BVH = 64, TREE = MAP / 4, SIDES = 12 };

#include "../bounce_frame.h"

void test_facets(void);

#if LMB_FACETS

static uint8_t colours[3 * WORLD_TRIANGLES][4], texel[4];
static float plain[FRAME * FRAME * 3];

enum { BY_ALBEDO, BY_COLOURS, BY_TEXTURE };
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
        world_triangle(p, add3(p, up), add3(q, up));
        world_triangle(p, add3(q, up), q);
    }
    memset(colours, by == BY_COLOURS ? LEVEL : 255, sizeof colours);
    memset(texel, CODE, sizeof texel);
    texel[3] = 255;
    world.texture.texels = texel;
    world.texture.width = world.texture.height = world.texture.levels = 1;
    world.texture.filter = LMB_NEAREST;
    for (int c = 0; c < 3; ++c) {
        world.material[0].albedo[c] = by == BY_ALBEDO ? (float)albedo : 1.0f;
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

void test_facets(void)
{
    check_albedo(BY_COLOURS, LEVEL / 255.0);
    check_albedo(BY_TEXTURE, pow((CODE / 255.0 + 0.055) / 1.055, 2.4));
}

#else

void test_facets(void) {}

#endif
