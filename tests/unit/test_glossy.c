/* test_glossy.c: the glossy lobe: energy, the disc factor against integrals, and frames with and without it. */
#include "../../src/direct/glossy.h"

#include "../world.h"

void test_glossy(void);

enum { FRAME = 64, MAP = 64, FACES = 1, ELEMENTS = 4096, BVH = 512 };

#include "../bounce_frame.h"
#include "../live_frame.h"

static lmb_glossy glossy;
static lmb_tile tile;

static double least_alpha2(double roughness)
{
    const double alpha = fmax(roughness * roughness, (double)LMB_MIN_ALPHA);
    return alpha * alpha;
}

/* One pixel at the origin facing +Z with a lobe. */
static void set_lobe(double roughness, float f0, lmb_vec3 towards)
{
    memset(&glossy, 0, sizeof glossy);
    memset(&tile, 0, sizeof tile);
    set_plane(tile.normal, 0, Z);
    set_plane(tile.face, 0, Z);
    set_plane(glossy.towards, 0, towards);
    tile.id[0] = 1;
    glossy.pixels = 1;
    glossy.alpha2[0] = (float)least_alpha2(roughness);
    glossy.facing[0] = towards.z;
    for (int c = 0; c < 3; ++c) {
        glossy.specular[c][0] = f0;
    }
}

static lmb_vec3 at_angle(double theta, double phi)
{
    return vec3((float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)), (float)cos(theta));
}

/* --- the lobe itself ---------------------------------------------------------------------------------------------- */

/* Share of uniform light that the lobe reflects to a viewer at this angle: half vectors sampled with GGX's density D
 * n.h, so f n.l becomes f n.l 4 l.h / (D n.h). */
static double reflected(double roughness, double theta, float f0)
{
    enum { STEPS = 40 };
    const lmb_vec3 v = at_angle(theta, 0.0);
    const double a2 = least_alpha2(roughness);
    double sum = 0.0;
    set_lobe(roughness, f0, v);
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double u = (i % STEPS + 0.5) / STEPS, s2 = a2 * u / (1.0 - u), nh = 1.0 / sqrt(1.0 + s2);
        const lmb_vec3 h = at_angle(acos(nh), 2.0 * PI * (i / STEPS + 0.5) / STEPS);
        const double vh = (double)dot3(v, h), nl = 2.0 * vh * (double)h.z - (double)v.z;
        if (vh > 0.0 && nl > 0.001) {
            const lmb_vec3 l = sub3(mul3(h, (float)(2.0 * vh)), v);
            const double d = a2 / (PI * pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
            sum += (double)lmb_glossy_factor(&glossy, &tile, 0, l, 0.0f) * nl * 4.0 * vh / (d * nh);
        }
    }
    return sum / (STEPS * STEPS);
}

/* Diffuse light that remains beside a white dielectric's lobe. */
static double left_over(double theta)
{
    lmb_radiance one;
    glossy.facing[0] = (float)cos(theta);
    for (int c = 0; c < 3; ++c) {
        one.rgb[c][0] = 1.0f;
    }
    CHECK(lmb_compose_glossy(&one, &glossy) == LMB_OK);
    return (double)one.rgb[0][0];
}

/* White light from everywhere. A metal with F0 = 1 reflects at most 1: nearly 1 if smooth, except at grazing angles,
 * and at roughness 1 the single-scattering part. A white dielectric (F0 = 0.04), lobe and diffuse: 0.84 to 1.02. */
static void white_furnace(void)
{
    static const double roughness[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0}, degrees[] = {0, 30, 60, 75, 80, 85};
    double max = 0, min = 9, smooth = 9, most_both = 0, least_both = 9;
    for (int i = 0; i < COUNT(roughness) * COUNT(degrees); ++i) {
        const double r = roughness[i % COUNT(roughness)], theta = degrees[i / COUNT(roughness)] * PI / 180.0;
        const double metal = reflected(r, theta, 1.0f), both = reflected(r, theta, 0.04f) + left_over(theta);
        max = fmax(metal, max);
        min = fmin(metal, min);
        smooth = r < 0.25 && theta < 1.4 ? fmin(metal, smooth) : smooth;
        most_both = fmax(both, most_both);
        least_both = fmin(both, least_both);
    }
    printf("  white furnace: metals %.3f .. %.3f, smooth ones from %.3f; dielectrics %.3f .. %.3f\n", min, max, smooth,
           least_both, most_both);
    CHECK(max < 1.0005 && min > 0.3 && smooth > 0.96);
    CHECK(most_both < 1.02 && least_both > 0.84);
}

/* Swapping light and viewer gives the same. */
static void reciprocity(void)
{
    test_rng rng = {11};
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double roughness = (double)test_uniform(&rng, 0.15f, 1.0f);
        const lmb_vec3 a = at_angle((double)test_uniform(&rng, 0.0f, 1.5f), (double)test_uniform(&rng, 0.0f, 6.0f));
        const lmb_vec3 b = at_angle((double)test_uniform(&rng, 0.0f, 1.5f), (double)test_uniform(&rng, 0.0f, 6.0f));
        set_lobe(roughness, 0.3f, a);
        const double one = (double)lmb_glossy_factor(&glossy, &tile, 0, b, 0.0f);
        set_lobe(roughness, 0.3f, b);
        const double two = (double)lmb_glossy_factor(&glossy, &tile, 0, a, 0.0f);
        worst = fmax(worst, fabs(one - two) / fmax(one, 1e-5));
    }
    CHECK_MSG(worst < 1e-3, "%g", worst);
}

/* --- a disc ------------------------------------------------------------------------------------------------------- */

/* D V of the exact lobe. */
static double lobe_exact(double a2, lmb_vec3 l, lmb_vec3 v)
{
    const lmb_vec3 h = normalize3(add3(l, v));
    const double nh = (double)h.z, nl = (double)l.z, nv = (double)v.z;
    const double d = a2 / (PI * pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    return d * 0.5 / (nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl));
}

/* The lobe's mean over a disc of radius r at distance 1 in direction l that faces the pixel; more rings if the lobe is
 * narrower than the disc. */
static double disc_exact(double a2, lmb_vec3 l, lmb_vec3 v, double r)
{
    const int rings = (int)fmin(200.0, 10.0 + 8.0 * r / sqrt(a2));
    const lmb_vec3 x = normalize3(cross3(absf(l.x) < 0.9f ? X : Y, l)), y = cross3(l, x);
    double sum = 0.0, all = 0.0;
    for (int i = 0; i < rings * rings; ++i) {
        const double at = (i % rings + 0.5) / rings * r, phi = 2.0 * PI * (i / rings + 0.5) / rings;
        const lmb_vec3 p = add3(l, add3(mul3(x, (float)(at * cos(phi))), mul3(y, (float)(at * sin(phi)))));
        const double d = (double)length3(p), w = (double)p.z > 0.0 ? at * (double)p.z / (d * d * d * d) : 0.0;
        all += w;
        sum += w > 0.0 ? w * lobe_exact(a2, normalize3(p), v) : 0.0;
    }
    return sum / all;
}

/* Largest error of discs around the mirror direction, relative to a disc there, for a viewer at `theta`. */
static double disc_error(double *middle, double roughness, double r, double theta)
{
    const double w = 2.0 * PI * (1.0 - 1.0 / sqrt(1.0 + r * r)), a2 = least_alpha2(roughness);
    const lmb_vec3 v = at_angle(theta, PI), mirror = at_angle(theta, 0.0);
    const double peak = disc_exact(a2, mirror, v, r);
    double worst = 0.0;
    set_lobe(roughness, 1.0f, v);
    *middle = (double)lmb_glossy_factor(&glossy, &tile, 0, mirror, (float)w) / peak - 1.0;
    for (int i = 1; i < 24; ++i) {
        const double away = 3.0 * i / 24 * (r + roughness * roughness), turn = 2.4 * i;
        const lmb_vec3 l = normalize3(add3(mirror, add3(mul3(Y, (float)(away * sin(turn))),
                                                        mul3(at_angle(theta + 0.5 * PI, 0.0),
                                                             (float)(away * cos(turn))))));
        if ((double)l.z > 0.1 + r) {
            const double off = (double)lmb_glossy_factor(&glossy, &tile, 0, l, (float)w) - disc_exact(a2, l, v, r);
            worst = fmax(worst, fabs(off) / peak);
        }
    }
    return worst;
}

/* Percent. Rows: roughness; columns: radii of discs at distance 1. Sharp lobes with large discs are blurred on purpose
 * (lobe.inl: WIDEN), by up to a third in the middle. This moves their edges, so the largest errors are high. */
static const double disc_roughness[] = {0.1, 0.2, 0.3, 0.5, 0.7, 1.0}, disc_radius[] = {0.01, 0.03, 0.1, 0.3};
static const double disc_low[2][6][4] = {
    /* deficit in the mirror direction; viewed at 20 degrees from the normal, then at 60 */
    {{9.5, 26.1, 32.7, 34.7}, {0.8, 6.1, 24.0, 33.4}, {0.1, 1.4, 11.3, 28.8},
     {0.0, 0.1, 2.5, 14.9}, {0.0, 0.1, 1.0, 7.7}, {0.0, 0.0, 0.4, 4.2}},
    {{9.7, 26.5, 32.8, 34.7}, {0.8, 6.2, 24.4, 33.5}, {0.2, 1.4, 11.6, 29.1},
     {0.0, 0.1, 2.6, 15.1}, {0.0, 0.1, 1.1, 7.8}, {0.0, 0.1, 0.7, 5.3}}};
static const double disc_worst[2][6][4] = {
    /* error around it, relative to a disc there */
    {{9.1, 25.8, 42.0, 53.5}, {0.8, 5.9, 23.5, 40.9}, {0.1, 1.4, 10.8, 28.7},
     {0.0, 0.1, 2.3, 13.9}, {0.0, 0.1, 1.0, 7.3}, {0.0, 0.2, 1.3, 4.1}},
    {{12.4, 31.5, 60.8, 61.9}, {1.1, 8.1, 30.3, 50.6}, {0.2, 1.9, 14.6, 42.5},
     {0.0, 0.2, 3.3, 17.1}, {0.0, 0.1, 1.0, 7.1}, {0.0, 0.2, 3.1, 5.0}}};

static void disc_against_integral(void)
{
    for (int i = 0; i < 2 * 6 * 4; ++i) {
        const int view = i / 24, row = i / 4 % 6, column = i % 4;
        double middle;
        const double worst = 100.0 * disc_error(&middle, disc_roughness[row], disc_radius[column], view ? PI / 3.0
                                                                                                       : PI / 9.0);
        CHECK_MSG(fabs(-100.0 * middle - disc_low[view][row][column]) < 0.15 &&
                      fabs(worst - disc_worst[view][row][column]) < 0.15,
                  "view %d, roughness %.1f, radius %.2f: %.2f low, %.2f worst", view, disc_roughness[row],
                  disc_radius[column], -100.0 * middle, worst);
    }
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

/* A floor and a wall, and a box of the second material. */
static lmb_frame room(float specular, float roughness)
{
    static lmb_light light;
    const lmb_view v = look(vec3(0.5f, 2.0f, 5.0f), vec3(0, 0.5f, 0), 45.0, FRAME);
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2.0f), mul3(X, 2.0f));
    world_quad(vec3(0, 2, -2), mul3(X, 2.0f), mul3(Y, 2.0f));
    world_part();
    world_box(vec3(-0.5f, 0.5f, 0), 0.5f);
    CHECK(world_end() == LMB_OK);
    for (int c = 0; c < 3; ++c) {
        world.material[0].specular[c] = specular;
    }
    world.material[0].roughness = roughness;
    light = spot(vec3(1, 4, 3), normalize3(vec3(-0.3f, -1, -1)), 25.0, 35.0);
    world.scene.lights = &light;
    world.scene.light_count = 1;
    CHECK(lmb_scene_check(&world.scene) == LMB_OK);
    return bounce_frame(&v, 2);
}

static float plain[FRAME * FRAME * 3], other[FRAME * FRAME * 3];

static void draw(float *out, const lmb_frame *f)
{
    CHECK(lmb_render_frame(&render, f) == LMB_OK);
    memcpy(out, picture, sizeof picture);
}

static double mean_of(const float *p)
{
    double sum = 0.0;
    for (int i = 0; i < FRAME * FRAME * 3; ++i) {
        sum += (double)p[i];
    }
    return sum / (FRAME * FRAME * 3);
}

/* Roughness without specular is no lobe. A lobe shows in direct and in bounced light, but not in irradiance. */
static void lobe_or_none(void)
{
    for (int32_t show = LMB_SHOW_FULL; show <= LMB_SHOW_IRRADIANCE; ++show) {
        lmb_frame f = room(0.0f, 0.0f);
        f.show = show;
        draw(plain, &f);
        f = room(0.0f, 0.3f);
        f.show = show;
        draw(other, &f);
        CHECK(render.is_glossy == 0 && memcmp(plain, other, sizeof plain) == 0);
        f = room(0.5f, 0.3f);
        f.show = show;
        draw(other, &f);
        CHECK(render.is_glossy == 1);
        CHECK((memcmp(plain, other, sizeof plain) == 0) == (show == LMB_SHOW_IRRADIANCE));
        CHECK_MSG(mean_of(other) > 0.5 * mean_of(plain) && mean_of(other) < 4.0 * mean_of(plain), "%g, plain %g",
                  mean_of(other), mean_of(plain));
    }
}

/* If every pixel has a lobe, all are gathered also with samples. A second picture with the same light equals a new
 * frame. */
static void steps_and_again(void)
{
    lmb_frame f = room(0.5f, 0.4f);
    world.material[1].specular[1] = 0.2f;
    f.bounces = 1;
    draw(plain, &f);
    gather_live(&f);
    draw(other, &f);
    CHECK(memcmp(plain, other, sizeof plain) == 0);
    f.bounces = 2;
    draw(other, &f);
    f.view = look(vec3(-1.0f, 1.5f, 4.0f), vec3(0, 0.5f, 0), 50.0, FRAME);
    CHECK(lmb_render_again(&render, &f) == LMB_OK);
    while (lmb_render_step(&render, 100) == LMB_MORE) {
    }
    memcpy(plain, picture, sizeof picture);
    draw(other, &f);
    CHECK(memcmp(plain, other, sizeof plain) == 0);
}

/* Radiance that a lobe with F = 1 reflects from a wall of radiance 1, z = -2, |x| < 2, 0 < y < 4: half vectors as in
 * reflected(). */
static double shown(double roughness, lmb_vec3 at, lmb_vec3 towards)
{
    enum { STEPS = 64 };
    const double a2 = least_alpha2(roughness);
    double sum = 0.0;
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double u = (i % STEPS + 0.5) / STEPS, nh = 1.0 / sqrt(1.0 + a2 * u / (1.0 - u));
        lmb_vec3 h = at_angle(acos(nh), 2.0 * PI * (i / STEPS + 0.5) / STEPS);
        h = vec3(h.x, h.z, -h.y);
        const float vh = dot3(towards, h);
        const lmb_vec3 l = sub3(mul3(h, 2.0f * vh), towards);
        const float t = (-2.0f - at.z) / l.z, x = at.x + l.x * t, y = at.y + l.y * t;
        if (vh > 0.0f && l.y > 0.0f && t > 0.0f && absf(x) < 2.0f && y < 4.0f) {
            const double nl = (double)l.y, nv = (double)towards.y;
            sum += nl * 4.0 * (double)vh / nh * 0.5 /
                   (nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl));
        }
    }
    return sum / (STEPS * STEPS);
}

/* A perfectly reflecting floor in front of a white wall, either sunlit or emissive with at most `elements` elements. If
 * the reflected ray meets the wall well inside, the floor is as bright as the integral, whatever the nodes, texels and
 * elements in between. At the wall's foot, close to them, it is on average at most a fifth brighter; with few large
 * elements, the centres of the parts are too high there. */
static void mirrored_wall(float roughness, uint32_t elements, double low, double high, double foot_low)
{
    static lmb_light light;
    const lmb_vec3 eye_at = vec3(0, 1.5f, 3.5f);
    const lmb_view v = look(eye_at, vec3(0, 0, -0.8f), 40.0, FRAME);
    double min = 9, max = 0, sum = 0, foot = 0;
    int count = 0, feet = 0;
    world_begin(0, 0, 0);
    world_quad(vec3(0, 0, 0), mul3(Z, 2.0f), mul3(X, 2.0f));
    world_part();
    world_quad(vec3(0, 2, -2), mul3(X, 2.0f), mul3(Y, 2.0f));
    CHECK(world_end() == LMB_OK);
    for (int c = 0; c < 3; ++c) {
        world.material[0].specular[c] = 1.0f;
        world.material[1].albedo[c] = 0.5f;
    }
    world.material[0].roughness = roughness;
    light = sun(normalize3(vec3(0, -0.5f, -1)));
    world.scene.lights = &light;
    world.scene.light_count = elements == 0;
    world.material[1].emission[1] = elements > 0 ? 1.0f : 0.0f;
    const float wall = elements > 0 ? 1.0f : 0.5f / (float)PI * -light.direction.z * light.intensity[1];
    lmb_frame f = bounce_frame(&v, 1);
    f.error = 0.0005f; /* compared with an integral, not with a cut */
    CHECK(elements == 0 || lmb_elements_init(&f.elements, elements, element_memory, sizeof element_memory) == LMB_OK);
    f.show = LMB_SHOW_INDIRECT;
    f.occlusion = LMB_OCCLUSION_NONE;
    draw(plain, &f);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        const float sx = ((float)(i % FRAME) + 0.5f) / FRAME * 2.0f - 1.0f,
                    sy = 1.0f - ((float)(i / FRAME) + 0.5f) / FRAME * 2.0f;
        lmb_vec3 ray = sub3(add3(mul3(v.right, sx * v.half_width), mul3(v.up, sy * v.half_height)), v.back);
        const lmb_vec3 p = add3(eye_at, mul3(ray, -eye_at.y / ray.y));
        const float t = (-2.0f - p.z) / ray.z, x = p.x + ray.x * t, y = -ray.y * t;
        if (i % 7 == 0 && ray.y < 0.0f && absf(p.z) < 1.9f && absf(p.x) < 1.9f && absf(x) < 1.2f &&
            absf(y - 2.0f) < 1.2f) {
            const double share = (double)(plain[3 * i + 1] / wall) /
                                 shown((double)roughness, p, normalize3(mul3(ray, -1.0f)));
            min = fmin(min, share);
            max = fmax(max, share);
            sum += share;
            ++count;
        } else if (ray.y < 0.0f && p.z > -1.97f && p.z < -1.85f && absf(p.x) < 1.0f) {
            foot += (double)(plain[3 * i + 1] / wall) / shown((double)roughness, p, normalize3(mul3(ray, -1.0f)));
            ++feet;
        }
    }
    printf("  mirrored wall, roughness %.2f, %d elements: %.3f of it, %.3f .. %.3f, %d pixels; %.3f at its foot\n",
           (double)roughness, (int)elements, sum / count, min, max, count, foot / feet);
    CHECK(count > 100 && min > low && max < high);
    CHECK(feet > 10 && foot > foot_low * feet && foot < 1.2 * feet);
}

/* One handmade light of 1, 2, 3 W/m2 from above on every backend: equals the factor. Dark pixels and pixels without a
 * lobe get nothing. */
static void one_light(void)
{
    const lmb_light light = point_light(vec3(0.3f, 0.2f, 2.0f));
    const lmb_kernels *kernels;
    lmb_view v = look(vec3(-0.2f, 0, 3), vec3(0, 0, 0), 40.0, FRAME);
    (void)room(0.3f, 0.5f);
    for (int32_t i = 0; (kernels = lmb_kernels_at(i)) != NULL; ++i) {
        lmb_irradiance lit;
        int good = 0, none = 0;
        memset(&lit, 0, sizeof lit);
        memset(&tile, 0, sizeof tile);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            set_plane(tile.position, k, vec3(0.1f * (float)(k % 8), 0.1f * (float)(k / 8), 0));
            set_plane(tile.face, k, Z);
            set_plane(tile.normal, k, Z);
            tile.id[k] = k % 3 ? 1 : world.instance[1].first_id; /* the second material, without a lobe */
            for (int c = 0; c < 3; ++c) {
                lit.rgb[c][k] = k % 5 ? (float)(c + 1) : 0.0f;
            }
        }
        CHECK(lmb_glossy_tile(&glossy, &tile, &v, &world.scene) == 1);
        CHECK(lmb_glossy_direct(&glossy, kernels, &tile, &lit, &light) == LMB_OK);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float f =
                lmb_glossy_factor(&glossy, &tile, k, sub3(light.position, plane_vec(tile.position, k)), 0.0f);
            const float wanted = k % 3 && k % 5 ? 2.0f * f : 0.0f;
            good += absf(glossy.rgb[1][k] - wanted) <= 1e-5f * wanted && (wanted > 0.01f || wanted == 0.0f);
            none += glossy.rgb[1][k] == 0.0f;
        }
        CHECK_MSG(good == LMB_TILE_PIXELS && none == 30, "%d good, %d dark", good, none);
    }
    v.kind = LMB_ORTHOGRAPHIC;
    v.back = Y;
    CHECK(lmb_glossy_tile(&glossy, &tile, &v, &world.scene) == 1 && glossy.towards[1][1] == 1.0f);
}

/* Black objects with a lobe reflect the light source and each other. */
static void black_lobes(void)
{
    double mean[2];
    for (int32_t show = LMB_SHOW_DIRECT; show <= LMB_SHOW_INDIRECT; ++show) {
        lmb_frame f = room(0.5f, 0.6f);
        for (int c = 0; c < 3; ++c) {
            world.material[0].albedo[c] = 0.0f;
            world.material[1].albedo[c] = 0.8f;
        }
        f.show = show;
        draw(plain, &f);
        world.material[0].specular[0] = world.material[0].specular[1] = world.material[0].specular[2] = 0.0f;
        draw(other, &f);
        mean[show - LMB_SHOW_DIRECT] = mean_of(plain) - mean_of(other);
    }
    CHECK_MSG(mean[0] > 1e-4 && mean[1] > 1e-4, "%g, %g", mean[0], mean[1]);
}

static void refusals(void)
{
    static const float bad[] = {-0.1f, 1.01f, NAN, INFINITY};
    for (int i = 0; i < COUNT(bad); ++i) {
        (void)room(0.5f, 0.4f);
        world.material[0].specular[i % 3] = bad[i];
        CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
        (void)room(0.5f, 0.4f);
        world.material[0].roughness = bad[i];
        CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    }
    CHECK(lmb_glossy_tile(NULL, &tile, &render.frame.view, &world.scene) == 0);
    CHECK(lmb_glossy_direct(NULL, picked_kernels(), &tile, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_compose_glossy(NULL, &glossy) == LMB_ERR_ARG);
}

void test_glossy(void)
{
    white_furnace();
    reciprocity();
    disc_against_integral();
    lobe_or_none();
    steps_and_again();
    mirrored_wall(0.1f, 0, 0.85, 1.15, 0.9);
    mirrored_wall(0.2f, 0, 0.98, 1.01, 0.9);
    mirrored_wall(0.4f, 0, 0.99, 1.01, 0.9);
    mirrored_wall(0.4f, 256, 0.87, 1.08, 0.75);
    mirrored_wall(0.4f, 4096, 0.97, 1.01, 0.93);
    mirrored_wall(0.6f, 256, 0.95, 1.01, 0.88);
    one_light();
    black_lobes();
    refusals();
}
