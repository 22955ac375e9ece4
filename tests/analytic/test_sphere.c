/* test_sphere.c: the integrating sphere: inside a Lambertian sphere one bounce is the same everywhere. [V27 V28 V29]
 *
 * Radius R, reflectance rho, a point light I at the centre: direct irradiance I / R2, radiance rho I / (pi R2). One
 * bounce gives rho I / R2 everywhere, because the form factor of any patch to any other is the patch's area over 4 pi
 * R2. The mesh is inscribed, which raises all values by the mean of 1 / r3 over a facet, about 0.1 % here. */
#include "../world.h"

void test_sphere(void);

enum {
    STACKS = 48,
    SLICES = 96,
    TRIANGLES = 2 * SLICES * (STACKS - 1),
    FRAME = 32,
    MAP = 256,
    SIDE = MAP / 8,
    VIEWS = 6
};

static const float albedo = 0.5f;

static void make_sphere(void)
{
    static lmb_light light;
    light = point_light(vec3(0, 0, 0));
    light.intensity[0] = light.intensity[1] = light.intensity[2] = 1.0f;
    world_begin(albedo, albedo, albedo);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    world.scene.lights = &light;
    world.scene.light_count = 1;
    CHECK(world_end() == LMB_OK && world.count == TRIANGLES);
}

/* --- rendering ---------------------------------------------------------------------------------------------------- */

static uint32_t map_memory[6 * MAP * MAP * 2], depth_memory[FRAME * FRAME], id_memory[FRAME * FRAME];
static lmb_point point_data[6 * SIDE * SIDE * 4];
static uint32_t point_cells[SIDE * SIDE + 1];
static lmb_groups groups;
static lmb_band_scratch scratch;
static lmb_render render;
static lmb_stats stats;
static float picture[FRAME * FRAME * 3];

static void draw(int view, int32_t show, int32_t method, int32_t count, int32_t occlusion)
{
    static const float ways[VIEWS][3] = {{1, 0, 0}, {-1, 0, 0}, {0.1f, 1, 0}, {0.1f, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    /* Off the centre, to avoid symmetry; from there 95 degrees see a third of the sphere. */
    const lmb_vec3 from = {0.05f, -0.03f, 0.3f};
    lmb_frame f;
    memset(&f, 0, sizeof f);
    memset(&stats, 0, sizeof stats);
    f.kernels = picked_kernels();
    f.scene = &world.scene;
    f.show = show;
    f.shadow_map = MAP;
    f.grouping.method = method;
    f.grouping.groups = count;
    f.occlusion = occlusion;
    f.map_memory = map_memory;
    f.map_bytes = sizeof map_memory;
    f.points.data = point_data;
    f.points.cap = 6 * SIDE * SIDE * 4;
    f.points.cells = point_cells;
    f.points.cell_cap = SIDE * SIDE + 1;
    f.groups = &groups;
    f.scratch = &scratch;
    f.stats = &stats;
    f.view = look(from, add3(from, vec3(ways[view][0], ways[view][1], ways[view][2])), 95, FRAME);
    f.eye = target_of(LMB_DEPTH32F, FRAME, depth_memory, id_memory);
    CHECK(lmb_surface_init(&f.out, LMB_RGB32F, FRAME, FRAME, picture, sizeof picture) == LMB_OK);
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
}

/* Deviation of the pictures of all views from `want`, relative to `want`. */
typedef struct deviation {
    double mean, max, ratio; /* of absolute values; largest; mean over want */
    int pixels;
} deviation;

static deviation measure(int32_t show, int32_t method, int32_t count, int32_t occlusion, double want)
{
    deviation d = {0, 0, 0, 0};
    for (int view = 0; view < VIEWS; ++view) {
        draw(view, show, method, count, occlusion);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            double off = (double)picture[3 * i] / want - 1.0;
            d.mean += fabs(off);
            d.max = fmax(d.max, fabs(off));
            d.ratio += off + 1.0;
            ++d.pixels;
        }
    }
    d.mean /= d.pixels;
    d.ratio /= d.pixels;
    return d;
}

static void tell(const char *name, deviation d)
{
    printf("  %-34s mean %.5f of the formula, off by %.3f %% on average, %.3f %% at most\n", name, d.ratio,
           d.mean * 100, d.max * 100);
}

/* V27, V28: rho I / R2 within 1 % everywhere, with 700 groups or more; the bar is the one of the
 * paper's own measurement. */
static void check_bounce(const char *name, int32_t method, int32_t count)
{
    char line[80];
    deviation d = measure(LMB_SHOW_IRRADIANCE, method, count, LMB_OCCLUSION_NONE, (double)albedo);
    snprintf(line, sizeof line, "one bounce, %s, %d groups", name, (int)groups.count);
    tell(line, d);
    CHECK_MSG(groups.count >= 700, "%s: %d groups", name, (int)groups.count);
    CHECK_MSG(d.max < 0.01, "%s: %g", name, d.max);
    CHECK_MSG(d.mean < 0.004 && fabs(d.ratio - 1.001) < 0.003, "%s: %g %g", name, d.mean, d.ratio);
    /* The light's total: 4 pi I rho. */
    CHECK_MSG(fabs(stats.flux_lit / (3.0 * 4.0 * PI * (double)albedo) - 1.0) < 1e-4, "%g", stats.flux_lit);
    CHECK_MSG(stats.flux_grouped > 0.999 * stats.flux_lit, "%g of %g", stats.flux_grouped, stats.flux_lit);
}

void test_sphere(void)
{
    deviation d;
    if (LMB_MAX_GROUPS < 2048) {
        SKIP("integrating sphere: %d groups are too few for 1 %%", LMB_MAX_GROUPS);
        return;
    }
    make_sphere();
    d = measure(LMB_SHOW_DIRECT, 0, 0, LMB_OCCLUSION_NONE, (double)albedo / PI);
    tell("direct radiance", d);
    CHECK_MSG(d.max < 0.004 && fabs(d.ratio - 1.001) < 0.001, "%g %g", d.max, d.ratio);
    check_bounce("zones", LMB_GROUP_ZONES, 1024);
    check_bounce("greedy", LMB_GROUP_GREEDY, 1024);
    check_bounce("zones", LMB_GROUP_ZONES, 2048);
    d = measure(LMB_SHOW_FULL, LMB_GROUP_ZONES, 1024, LMB_OCCLUSION_NONE, 1.5 * (double)albedo / PI);
    tell("direct + one bounce, radiance", d);
    CHECK_MSG(d.max < 0.007, "%g", d.max);
    /* A sphere is convex, so the viewer's depth map must not shadow any point. */
    d = measure(LMB_SHOW_IRRADIANCE, LMB_GROUP_ZONES, 1024, LMB_OCCLUSION_VIEW, (double)albedo);
    tell("one bounce, view occlusion", d);
    CHECK_MSG(fabs(d.ratio - 1.001) < 0.02, "%g", d.ratio);
}
