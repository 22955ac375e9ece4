/* test_light.c: direct light and its shadow test, against formulas and exact rays. [V3 V7 V29] */
#include "../../src/direct/shadow.h"
#include "../world.h"

void test_light(void);

enum { SIDE = 512, FRAME = 128, PIXELS = FRAME * FRAME };

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static uint32_t map_memory[6 * SIDE * SIDE * 2], depth_memory[PIXELS], id_memory[PIXELS];
static lmb_shadow_map map;
static lmb_target eye;

/* Visible points, and their irradiance without shadows [0] and with [1]. */
static struct {
    lmb_vec3 at, normal;
    uint32_t id;
    float open[3], shadowed[3];
} seen[PIXELS];

static void draw_map(const lmb_light *light, int32_t size)
{
    CHECK(lmb_shadow_map_init(&map, light, &world.scene, size, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_shadow_map_clear(&map) == LMB_OK);
    CHECK(lmb_shadow_map_draw(&map, picked_kernels(), &world.scene, 1, WORLD_TRIANGLES, NULL) == LMB_OK);
}

static void draw_view(const lmb_view *v)
{
    eye = target_of(LMB_DEPTH32F, FRAME, depth_memory, id_memory);
    world_draw(&eye, v, LMB_CULL_BACK);
}

#if LMB_SHADOW_LANES
/* The test of a tile by lanes gives the same answers as that of each pixel, on every backend. */
static void check_lanes(lmb_tile *tile, const lmb_view *v, const lmb_light *light)
{
    lmb_shadow_query query;
    uint64_t shown = 0;
    lmb_lit_pixels want = {0, 0, 0};
    lmb_shadow_ask(&query, &map, light, &world.scene, v);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0) {
            const lmb_receiver r = {plane_vec(tile->position, k), plane_vec(tile->face, k), tile->id[k]};
            const int answer = lmb_is_lit(&query, &r);
            shown |= (uint64_t)1 << k;
            want.lit |= (uint64_t)(answer != 0) << k;
            want.doubtful |= (uint64_t)(answer == LMB_LIT_IN_DOUBT) << k;
            want.beside |= (uint64_t)(answer == LMB_LIT_BESIDE) << k;
        }
    }
    for (int32_t m = 0; listed_kernels(m) != NULL; ++m) {
        lmb_lit_pixels found;
        lmb_shadow_lit(&found, &query, listed_kernels(m), tile, shown);
        CHECK_MSG(memcmp(&found, &want, sizeof found) == 0, "%s: %d of %d pixels at %d, %d",
                  lmb_kernels_name(listed_kernels(m)), (int)count_bits_64(found.lit ^ want.lit),
                  (int)count_bits_64(shown), (int)tile->x, (int)tile->y);
    }
}
#else
#define check_lanes(tile, v, light) ((void)0)
#endif

/* One tile of 32 is checked, and other ones in each picture. */
static void shade_tile(const lmb_view *v, const lmb_light *light, int32_t x, int32_t y)
{
    static int turn;
    turn += x == 0 && y == 0;
    static lmb_tile tile;
    lmb_irradiance open, shadowed;
    const lmb_kernels *k = picked_kernels();
    memset(&open, 0, sizeof open);
    memset(&shadowed, 0, sizeof shadowed);
    CHECK(lmb_resolve_tile(&tile, k, v, &world.scene, &eye, x, y) == LMB_OK);
    CHECK(lmb_direct_tile(&open, k, &tile, v, &world.scene, light, NULL) == LMB_OK);
    CHECK(lmb_direct_tile(&shadowed, k, &tile, v, &world.scene, light, &map) == LMB_OK);
    if ((x + 3 * y) / LMB_TILE % 32 == turn % 32) {
        check_lanes(&tile, v, light);
    }
    for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
        int32_t p = (y + i / LMB_TILE) * FRAME + x + i % LMB_TILE;
        seen[p].at = plane_vec(tile.position, i);
        seen[p].normal = plane_vec(tile.normal, i);
        seen[p].id = tile.id[i];
        for (int c = 0; c < 3; ++c) {
            seen[p].open[c] = open.rgb[c][i];
            seen[p].shadowed[c] = shadowed.rgb[c][i];
        }
    }
}

static void shade(const lmb_view *v, const lmb_light *light, int32_t size)
{
    draw_map(light, size);
    draw_view(v);
    for (int32_t y = 0; y < FRAME; y += LMB_TILE) {
        for (int32_t x = 0; x < FRAME; x += LMB_TILE) {
            shade_tile(v, light, x, y);
        }
    }
}

/* --- irradiance --------------------------------------------------------------------------------------------------- */

/* V3: intensity x cosine / distance2, smoothstep of the angle's cosine between the cones, in double. */
static double irradiance(const lmb_light *l, lmb_vec3 p, lmb_vec3 n)
{
    double d[3] = {(double)l->position.x - (double)p.x, (double)l->position.y - (double)p.y,
                   (double)l->position.z - (double)p.z};
    double axis[3] = {(double)l->direction.x, (double)l->direction.y, (double)l->direction.z};
    double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], r = sqrt(r2), share = 1.0;
    if (l->kind == LMB_LIGHT_DIRECTIONAL) {
        return fmax(0.0, -(axis[0] * (double)n.x + axis[1] * (double)n.y + axis[2] * (double)n.z));
    }
    if (l->kind == LMB_LIGHT_SPOT) {
        double t = -(d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]) / r,
               wide = (double)l->cos_inner - (double)l->cos_outer;
        t = fmin(fmax((t - (double)l->cos_outer) / fmax(wide, 1e-6), 0.0), 1.0);
        share = t * t * (3.0 - 2.0 * t);
    }
    if (l->range > 0.0f) {
        share *= fmax(1.0 - pow(r / (double)l->range, 4.0), 0.0);
    }
    return share * fmax(0.0, (d[0] * (double)n.x + d[1] * (double)n.y + d[2] * (double)n.z) / (r * r2));
}

/* Open floor and a tilted plate: picture and formula agree across the whole cone. */
static void check_irradiance(const char *name, lmb_light light)
{
    lmb_view v = look(vec3(0.5f, 3, 3), vec3(0, 0, 0), 60, FRAME);
    double worst = 0.0, peak = 0.0, min = 1e30;
    uint32_t dark = 0, pixels = 0;
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    world_part();
    world_quad(vec3(-0.2f, 0.3f, -1.5f), mul3(X, 0.7f), vec3(0, 0.3f, -0.2f));
    CHECK(world_end() == LMB_OK);
    shade(&v, &light, 256);
    for (int i = 0; i < PIXELS; ++i) {
        if (seen[i].id != 0) {
            double want = irradiance(&light, seen[i].at, seen[i].normal);
            peak = fmax(peak, want);
            min = fmin(min, want);
            for (int c = 0; c < 3; ++c) {
                worst = fmax(worst, fabs((double)seen[i].open[c] - want * (double)light.intensity[c]) /
                                        (double)light.intensity[c]);
            }
            ++pixels;
            dark += want > 0.0 && seen[i].open[0] == 0.0f;
        }
    }
    printf("  irradiance, %-10s %.1e of the peak off the formula over %u pixels\n", name, worst / peak,
           (unsigned)pixels);
    CHECK_MSG(pixels > PIXELS / 4 && worst < 1e-5 * peak, "%s: %g of %g", name, worst, peak);
    if (light.kind == LMB_LIGHT_SPOT) {
        CHECK(min == 0.0); /* outside the cone too */
    }
    CHECK_MSG(dark * 1000 <= pixels, "%u", (unsigned)dark);
}

/* Inner cone: full light; outer: none; at the mean of the cosines: half. A hard cone has no transition. */
static void check_cone(void)
{
    static lmb_tile tile;
    lmb_irradiance e;
    lmb_view v = look(vec3(0, 2, 0), vec3(0, 0, 0), 60, FRAME);
    lmb_light l = spot(vec3(0, 1, 0), vec3(0, -1, 0), 20, 40);
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    CHECK(world_end() == LMB_OK);
    memset(&tile, 0, sizeof tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* cosines from 1 down to 0.7 */
        double cosine = 1.0 - 0.3 * k / (LMB_TILE_PIXELS - 1), sine = sqrt(1.0 - cosine * cosine);
        tile.position[0][k] = (float)sine;
        tile.position[1][k] = (float)(1.0 - cosine);
        tile.normal[0][k] = tile.face[0][k] = (float)-sine; /* facing the light from 1 m */
        tile.normal[1][k] = tile.face[1][k] = (float)cosine;
        tile.id[k] = 1;
    }
    memset(&e, 0, sizeof e);
    CHECK(lmb_direct_tile(&e, picked_kernels(), &tile, &v, &world.scene, &l, NULL) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double cosine = 1.0 - 0.3 * k / (LMB_TILE_PIXELS - 1),
               t = (cosine - cos(PI * 40 / 180)) / (cos(PI * 20 / 180) - cos(PI * 40 / 180));
        t = fmin(fmax(t, 0.0), 1.0);
        CHECK_MSG(fabs((double)e.rgb[0][k] - 2.0 * t * t * (3.0 - 2.0 * t)) < 1e-5, "cosine %g: %g", cosine,
                  (double)e.rgb[0][k]);
    }
    l = spot(vec3(0, 1, 0), vec3(0, -1, 0), 30, 30);
    CHECK(lmb_direct_tile(&e, picked_kernels(), &tile, &v, &world.scene, &l, NULL) ==
          LMB_OK); /* added to the output */
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double cosine = 1.0 - 0.3 * k / (LMB_TILE_PIXELS - 1),
               t = (cosine - cos(PI * 40 / 180)) / (cos(PI * 20 / 180) - cos(PI * 40 / 180));
        t = fmin(fmax(t, 0.0), 1.0);
        double want = 2.0 * t * t * (3.0 - 2.0 * t) + (cosine > cos(PI * 30 / 180) ? 2.0 : 0.0);
        CHECK_MSG(fabs((double)e.rgb[0][k] - want) < 1e-5, "hard, cosine %g: %g", cosine, (double)e.rgb[0][k]);
    }
    for (int k = 0; k < LMB_TILE_PIXELS;
         ++k) { /* back-facing surface: smooth normals do not leak light */
        tile.face[0][k] = -tile.face[0][k];
        tile.face[1][k] = -tile.face[1][k];
    }
    memset(&e, 0, sizeof e);
    CHECK(lmb_direct_tile(&e, picked_kernels(), &tile, &v, &world.scene, &l, NULL) == LMB_OK);
    CHECK(e.rgb[0][0] == 0.0f && e.rgb[1][20] == 0.0f && e.rgb[2][63] == 0.0f);
    CHECK(lmb_direct_tile(NULL, picked_kernels(), &tile, &v, &world.scene, &l, NULL) == LMB_ERR_ARG);
    static const float cosines[4][2] = {{0.0f, 0.9f}, {0.9f, 0.8f}, {0.5f, 1.01f}, {NAN, 0.9f}};
    lmb_scene lit = world.scene;
    lmb_light bad = spot(vec3(0, 1, 0), vec3(0, -1, 0), 20, 40);
    lit.lights = &bad;
    lit.light_count = 1;
    CHECK(lmb_scene_check(&lit) == LMB_OK);
    for (int i = 0; i < 4; ++i) {
        bad.cos_outer = cosines[i][0];
        bad.cos_inner = cosines[i][1];
        CHECK(lmb_scene_check(&lit) == LMB_ERR_ARG);
    }
    CHECK(lmb_direct_tile(&e, picked_kernels(), &tile, &v, NULL, &l, NULL) == LMB_ERR_ARG);
}

/* Compares a range with the formula of viewers: exactly 0 at its end and beyond. 0 and 2^30 m mean no range, and suns
 * have none. */
static void check_range(void)
{
    static const float ranges[] = {2.0f, 0.75f, 5.0f, 1e-20f, 0x1p-45f, 0.0f, 0x1p30f, 3e38f};
    static lmb_tile tile;
    const lmb_view v = look(vec3(0, 2, 0), vec3(0, 0, 0), 60, FRAME);
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    CHECK(world_end() == LMB_OK);
    memset(&tile, 0, sizeof tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* 1/16 to 4 m below the light */
        tile.position[1][k] = -0.0625f * (float)(k + 1);
        tile.normal[1][k] = tile.face[1][k] = 1.0f;
        tile.id[k] = 1;
    }
    for (int i = 0; i < COUNT(ranges); ++i) {
        for (int kind = 0; kind < 3; ++kind) {
            lmb_irradiance e;
            lmb_light l = kind == LMB_LIGHT_SPOT ? spot(vec3(0, 0, 0), vec3(0, -1, 0), 20, 40)
                                                 : make_light(kind, vec3(0, 0, 0), vec3(0, -1, 0));
            l.range = ranges[i];
            memset(&e, 0, sizeof e);
            CHECK(lmb_direct_tile(&e, picked_kernels(), &tile, &v, &world.scene, &l, NULL) == LMB_OK);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                const double d = 0.0625 * (k + 1), end = (double)ranges[i];
                const int ends = end > 0.0 && kind != LMB_LIGHT_DIRECTIONAL;
                const double left = ends ? fmax(1.0 - pow(d / end, 4.0), 0.0) : 1.0;
                const double want = (double)l.intensity[0] * left / (kind == LMB_LIGHT_DIRECTIONAL ? 1.0 : d * d);
                CHECK_MSG(left > 0.0 ? fabs((double)e.rgb[0][k] - want) < 1e-5 * fmax(want, (double)l.intensity[0])
                                     : e.rgb[0][k] == 0.0f,
                          "kind %d, range %g, %g m: %g, not %g", kind, end, d, (double)e.rgb[0][k], want);
            }
        }
    }
    static const float bad[] = {-1.0f, NAN, INFINITY};
    lmb_scene lit = world.scene;
    lmb_light l = point_light(vec3(0, 1, 0));
    lit.lights = &l;
    lit.light_count = 1;
    l.range = 2.0f;
    CHECK(lmb_scene_check(&lit) == LMB_OK);
    for (int i = 0; i < COUNT(bad); ++i) {
        l.range = bad[i];
        CHECK(lmb_scene_check(&lit) == LMB_ERR_ARG);
    }
}

static lmb_light ranged(lmb_light l, float range)
{
    l.range = range;
    return l;
}

static void test_irradiance(void)
{
    check_range();
    check_irradiance("ranged", ranged(point_light(vec3(0.3f, 1.2f, -0.4f)), 1.7f));
    check_irradiance("ranged spot", ranged(spot(vec3(0.3f, 1.2f, -0.4f), vec3(-0.2f, -1, -0.3f), 20, 38), 1.5f));
    check_irradiance("point", point_light(vec3(0.3f, 1.2f, -0.4f)));
    check_irradiance("spot", spot(vec3(0.3f, 1.2f, -0.4f), vec3(-0.2f, -1, -0.3f), 20, 38));
    check_irradiance("wide spot", spot(vec3(0.3f, 0.7f, -0.4f), vec3(-0.2f, -1, -0.1f), 30, 62));
    check_irradiance("hard spot", spot(vec3(0.3f, 1.2f, -0.4f), vec3(-0.2f, -1, -0.3f), 30, 30));
    check_irradiance("sun", sun(vec3(0.4f, -0.8f, -0.2f)));
    check_cone();
}

/* --- shadows ------------------------------------------------------------------------------------------------------ */

/* The plate: half sides of 0.5 m, rotated, 1 m above the floor. */
static const lmb_vec3 plate_at = {0.1f, 1, -0.05f}, plate_u = {0.46f, 0, 0.2f}, plate_v = {-0.2f, 0, 0.46f};

static void make_plate(void)
{
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    world_part();
    world_quad(plate_at, plate_u, plate_v);
    CHECK(world_end() == LMB_OK);
}

/* Intersection of the segment from p to the light with the plate, in half sides; 0 if it does not cross the plate's
 * height. */
static int cross_plate(double uv[2], const lmb_light *l, lmb_vec3 p)
{
    double up[3] = {-(double)l->direction.x, -(double)l->direction.y, -(double)l->direction.z};
    if (l->kind != LMB_LIGHT_DIRECTIONAL) {
        up[0] = (double)l->position.x - (double)p.x;
        up[1] = (double)l->position.y - (double)p.y;
        up[2] = (double)l->position.z - (double)p.z;
    }
    double t = ((double)plate_at.y - (double)p.y) / up[1], size = (double)dot3(plate_u, plate_u);
    double x = (double)p.x + t * up[0] - (double)plate_at.x, z = (double)p.z + t * up[2] - (double)plate_at.z;
    uv[0] = (x * (double)plate_u.x + z * (double)plate_u.z) / size;
    uv[1] = (x * (double)plate_v.x + z * (double)plate_v.z) / size;
    return t > 0.0;
}

/* Texel position of a point in the downward face of a map (point lights), or in the only one. */
static void place_in_map(double xy[2], lmb_vec3 p)
{
    const lmb_view *v = &map.view[map.faces == 1 ? 0 : 3];
    lmb_vec3 d = sub3(p, v->eye);
    double w = v->kind == LMB_PERSPECTIVE ? -(double)dot3(v->back, d) : 1.0;
    xy[0] = ((double)dot3(v->right, d) / (w * (double)v->half_width) * 0.5 + 0.5) * map.size;
    xy[1] = (0.5 - (double)dot3(v->up, d) / (w * (double)v->half_height) * 0.5) * map.size;
}

/* Distance in texels between a floor point and the plate's outline in the map. */
static double texels_to_edge(lmb_vec3 p)
{
    static const float sign[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    double corner[5][2], at[2], nearest = 1e30;
    place_in_map(at, p);
    for (int i = 0; i < 5; ++i) {
        place_in_map(corner[i], add3(plate_at, add3(mul3(plate_u, sign[i][0]), mul3(plate_v, sign[i][1]))));
    }
    for (int i = 0; i < 4; ++i) {
        double ex = corner[i + 1][0] - corner[i][0], ey = corner[i + 1][1] - corner[i][1];
        double dx = at[0] - corner[i][0], dy = at[1] - corner[i][1];
        double t = fmin(fmax((dx * ex + dy * ey) / (ex * ex + ey * ey), 0.0), 1.0);
        nearest = fmin(nearest, hypot(dx - t * ex, dy - t * ey));
    }
    return nearest;
}

/* V7: lit or dark as the exact ray, up to a texel from the shadow's edge. */
static void check_shadow(const char *name, lmb_light light, int32_t size)
{
    lmb_view v = look(vec3(1.2f, 2.6f, 2.4f), vec3(0, 0, 0), 60, FRAME);
    int wrong = 0, close = 0, near_edge = 0, dark = 0, lit = 0;
    double farthest = 0.0;
    make_plate();
    shade(&v, &light, size);
    for (int i = 0; i < PIXELS; ++i) {
        double uv[2];
        if (seen[i].id == 0 || seen[i].id > 2 || seen[i].open[0] == 0.0f || !cross_plate(uv, &light, seen[i].at)) {
            continue;
        }
        int shaded = fabs(uv[0]) < 1.0 && fabs(uv[1]) < 1.0, differs = (seen[i].shadowed[0] == 0.0f) != shaded;
        double texels = texels_to_edge(seen[i].at);
        dark += shaded;
        lit += !shaded;
        near_edge += texels <= 1.0;
        close += differs && texels <= 1.0;
        wrong += differs && texels > 1.0;
        farthest = differs ? fmax(farthest, texels) : farthest;
        CHECK(seen[i].shadowed[0] == 0.0f || memcmp(seen[i].shadowed, seen[i].open, sizeof seen[i].open) == 0);
    }
    printf("  shadow, %-5s map %3d: %d wrong of %d, at most %.2f texels from the edge (%d pixels within one)\n", name,
           (int)size, close + wrong, dark + lit, farthest, near_edge);
    CHECK_MSG(dark > 100 && lit > 1000, "%d dark, %d lit", dark, lit);
    CHECK_MSG(wrong == 0, "%s, map %d: %d pixels farther than a texel", name, (int)size, wrong);
    CHECK_MSG(close * 25 <= near_edge, "%s, map %d: %d of %d within a texel", name, (int)size, close, near_edge);
}

/* A texture with holes: every second texel of 8x8 is transparent. */
static void check_mask(lmb_light light, int32_t size)
{
    static uint8_t texels[64][4];
    lmb_view v = look(vec3(0.4f, 0.9f, 2.0f), vec3(0, 0, 0), 60, FRAME);
    int wrong = 0, through = 0, stopped = 0, corner = 0;
    for (int i = 0; i < 64; ++i) {
        memset(texels[i], (i % 8 + i / 8) % 2 ? 255 : 0, 4);
    }
    make_plate();
    world.texture.texels = &texels[0][0];
    world.texture.width = world.texture.height = 8;
    world.texture.levels = 1;
    world.texture.filter = LMB_NEAREST;
    world.texture.wrap_s = world.texture.wrap_t = LMB_WRAP_CLAMP;
    world.material[1].texture = 0;
    world.material[1].alpha_cutoff = 0.5f;
    world.material[1].flags |= LMB_ALPHA_MASK;
    CHECK(world_end() == LMB_OK);
    shade(&v, &light, size);
    for (int i = 0; i < PIXELS; ++i) {
        double uv[2];
        if (seen[i].id == 0 || seen[i].id > 2 || seen[i].open[0] == 0.0f || !cross_plate(uv, &light, seen[i].at) ||
            fabs(uv[0]) > 0.98 || fabs(uv[1]) > 0.98) {
            continue;
        }
        double s = (uv[0] + 1.0) * 4.0, t = (uv[1] + 1.0) * 4.0;
        double side = fmin(s - floor(s), ceil(s) - s), other = fmin(t - floor(t), ceil(t) - t);
        int hole = ((int)s + (int)t) % 2 == 0, differs = (seen[i].shadowed[0] > 0.0f) != hole;
        through += hole;
        stopped += !hole;
        if (fmax(side, other) < 0.3) { /* at the corners of four holes no texel centre need be in the right one */
            corner += differs;
        } else {
            wrong += differs && fmin(side, other) > 0.005;
        }
    }
    printf("  holes, map %d: %d of %d pixels wrong, %d more at corners\n", (int)size, wrong, through + stopped, corner);
    CHECK_MSG(through > 50 && stopped > 50 && wrong * 500 <= through + stopped, "%d of %d", wrong, through + stopped);
    CHECK_MSG(corner * 50 <= through + stopped, "%d of %d", corner, through + stopped);
}

/* A plate 4 mm above a floor shadows it: the tolerance for rounding is far smaller. Viewed through the gap. */
static void check_low_plate(lmb_light light)
{
    lmb_view v = look(vec3(0.3f, 0.003f, 1.5f), vec3(0, 0.001f, 0), 3, FRAME);
    int dark = 0, wrong = 0;
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0.004f, 0), mul3(Z, 0.5f), mul3(X, 0.5f));
    world_quad(vec3(0, 0, 0), mul3(Z, 0.4f), mul3(X, 0.4f));
    CHECK(world_end() == LMB_OK);
    shade(&v, &light, 256);
    for (int i = 0; i < PIXELS; ++i) {
        int inner = absf(seen[i].at.x) < 0.39f && absf(seen[i].at.z) < 0.39f;
        if (seen[i].id > 2 && inner && seen[i].open[0] > 0.0f) {
            ++dark;
            wrong += seen[i].shadowed[0] != 0.0f;
        }
    }
    CHECK_MSG(dark > 100 && wrong == 0, "%d of %d pixels 4 mm under a plate are lit", wrong, dark);
}

static void test_shadows(void)
{
    static const int32_t sizes[] = {64, 256, SIDE};
    lmb_light day = sun(vec3(0.3f, -0.8f, -0.2f));
    lmb_light light = point_light(vec3(-0.3f, 2.2f, 0.3f));
    lmb_light cone = spot(vec3(-0.6f, 2.5f, 0.4f), vec3(0.25f, -1, -0.15f), 25, 40);
    for (int i = 0; i < COUNT(sizes); ++i) {
        check_shadow("sun", day, sizes[i]);
        check_shadow("point", light, sizes[i]);
        check_shadow("spot", cone, sizes[i]);
    }
    check_mask(day, SIDE);
    check_mask(light, SIDE);
    check_mask(cone, 256);
    check_low_plate(day);
    check_low_plate(light);
    check_low_plate(cone);
}

/* --- no acne ------------------------------------------------------------------------------------------------------ */

/* Dark pixels that face the light: a convex body must have none. */
static int dark_pixels(int *facing, const lmb_view *v, const lmb_light *light, int32_t size)
{
    int dark = 0;
    shade(v, light, size);
    for (int i = 0; i < PIXELS; ++i) {
        *facing += seen[i].open[0] > 0.0f;
        dark += seen[i].open[0] > 0.0f && seen[i].shadowed[0] == 0.0f;
    }
    return dark;
}

static void check_convex(const char *name, int32_t size)
{
    static const double degrees[] = {0, 20, 45, 60, 75, 85, 89, 89.9};
    static const float eyes[][3] = {{3, 1, 2}, {-1, 3, -2}, {0.1f, -2.5f, 2.2f}};
    int dark = 0, facing = 0;
    for (int e = 0; e < COUNT(eyes); ++e) {
        lmb_view v = look(vec3(eyes[e][0], eyes[e][1], eyes[e][2]), vec3(0, 0, 0), 45, FRAME);
        for (int d = 0; d < COUNT(degrees); ++d) {
            double a = degrees[d] * PI / 180;
            lmb_vec3 up = vec3((float)(sin(a) * 0.8), (float)cos(a), (float)(sin(a) * 0.6));
            lmb_light l = sun(mul3(up, -1.0f));
            dark += dark_pixels(&facing, &v, &l, size);
            l = point_light(mul3(up, 3.0f));
            dark += dark_pixels(&facing, &v, &l, size);
            l = spot(mul3(up, 2.5f), mul3(up, -1.0f), 30, 45);
            dark += dark_pixels(&facing, &v, &l, size);
        }
    }
    printf("  convex %s, map %d: %d of %d lit pixels are dark\n", name, (int)size, dark, facing);
    CHECK_MSG(facing > 10000 && dark == 0, "%s, map %d: %d of %d pixels that face the light are dark", name, (int)size,
              dark, facing);
}

/* Coplanar triangles, adjacent and overlapping, at all rotations. */
static void check_coplanar(void)
{
    int dark = 0, facing = 0;
    for (int i = 0; i < 8; ++i) {
        double a = 0.35 * i, b = 0.2 + 0.13 * i;
        lmb_vec3 n = vec3((float)(sin(b) * cos(a)), (float)cos(b), (float)(sin(b) * sin(a)));
        lmb_vec3 u = normalize3(cross3(Z, n)), w = cross3(n, u), at = mul3(vec3(0.3f, 0.7f, -0.2f), (float)i);
        lmb_view v = look(add3(at, add3(mul3(n, 2.5f), mul3(u, 1.5f))), at, 50, FRAME);
        world_begin(0.5f, 0.5f, 0.5f);
        world_quad(at, mul3(u, 1.1f), mul3(w, 1.1f));
        world_quad(at, add3(mul3(u, 0.7f), mul3(w, 0.3f)), add3(mul3(w, 0.7f), mul3(u, -0.3f)));
        CHECK(world_end() == LMB_OK);
        for (int d = 1; d < 10; ++d) {
            double c = d * 9.9 * PI / 180; /* up to 89.1 degrees from the normal */
            lmb_vec3 up = add3(mul3(n, (float)cos(c)), mul3(add3(mul3(u, 0.8f), mul3(w, 0.6f)), (float)sin(c)));
            lmb_light l = sun(mul3(up, -1.0f));
            dark += dark_pixels(&facing, &v, &l, 64);
            l = point_light(add3(at, mul3(up, 2.0f)));
            dark += dark_pixels(&facing, &v, &l, 64);
        }
    }
    CHECK_MSG(facing > 10000 && dark == 0, "%d of %d pixels of a plane shadow themselves", dark, facing);
}

/* A light 1 mm above a 4 m floor: the whole floor is lit according to the formula. */
static void check_low_light(void)
{
    lmb_light l = point_light(vec3(0.1f, 0.001f, 0.2f));
    lmb_view v = look(vec3(0.5f, 3, 2), vec3(0, 0, 0), 60, FRAME);
    int dark = 0, facing = 0;
    double worst = 0.0;
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    CHECK(world_end() == LMB_OK);
    dark = dark_pixels(&facing, &v, &l, 256);
    for (int i = 0; i < PIXELS; ++i) {
        if (seen[i].id != 0) {
            double want = 2.0 * irradiance(&l, seen[i].at, seen[i].normal);
            worst = fmax(worst, fabs((double)seen[i].shadowed[0] / want - 1.0));
        }
    }
    printf("  light 1 mm over a floor: %d of %d pixels dark, %.1e off the formula\n", dark, facing, worst);
    CHECK_MSG(facing > 1000 && dark == 0 && worst < 1e-3, "%d dark, %g", dark, worst);
}

static void test_acne(void)
{
    static const int32_t sizes[] = {16, 64, 256};
    for (int i = 0; i < COUNT(sizes); ++i) {
        world_begin(0.5f, 0.5f, 0.5f);
        world_box(vec3(0, 0, 0), 0.7f);
        CHECK(world_end() == LMB_OK);
        check_convex("box", sizes[i]);
        world_begin(0.5f, 0.5f, 0.5f);
        world_sphere(vec3(0, 0, 0), 1.0f, 24, 48);
        CHECK(world_end() == LMB_OK);
        check_convex("sphere", sizes[i]);
    }
    check_coplanar();
    check_low_light();
}

/* --- one point and a map ------------------------------------------------------------------------------------------ */

static int lights(const lmb_light *light, lmb_vec3 at)
{
    const lmb_view v = look(vec3(0, 8, 8), vec3(0, 0, 0), 60, FRAME);
    const lmb_receiver r = {at, Y, 1};
    lmb_shadow_query query;
    lmb_shadow_ask(&query, &map, light, &world.scene, &v);
    return lmb_is_lit(&query, &r);
}

/* Of all texels. */
static void set_ids(uint32_t id)
{
    for (int32_t i = 0; i < map.size * map.size; ++i) {
        ((uint32_t *)map.face[0].id.data)[i] = id;
    }
}

/* A floor, a roof 2 m above all of it, and a triangle without area. */
static void floor_and_roof(void)
{
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 30), mul3(X, 30));
    world_quad(vec3(0, 2, 0), mul3(Z, 30), mul3(X, 30));
    world_triangle(X, X, X);
    CHECK(world_end() == LMB_OK);
}

/* The roof shadows points inside a spot's map. Outside the cone, behind the lamp and in parts without a drawn map there
 * is no shadow. If the map has the id of a missing triangle or one without area, its depth decides. */
static void test_spot_map(void)
{
    const lmb_light lamp = spot(vec3(0, 3, 0), vec3(0, -1, 0), 20, 25);
    floor_and_roof();
    draw_map(&lamp, 64);
    CHECK(!lights(&lamp, vec3(0, 0, 0)) && !lights(&lamp, vec3(0.9f, 0, 0.2f)));
    CHECK(lights(&lamp, vec3(9, 0, 0)) && lights(&lamp, vec3(-9, 0, 0)));
    CHECK(lights(&lamp, vec3(0, 0, 9)) && lights(&lamp, vec3(0, 0, -9)));
    CHECK(lights(&lamp, vec3(0, 4, 0)) && lights(&lamp, vec3(0, 2.5f, 0)));
    set_ids(1000);
    CHECK(!lights(&lamp, vec3(0, 0, 0)) && lights(&lamp, vec3(0, 2.5f, 0)));
    set_ids(5);
    CHECK(!lights(&lamp, vec3(0, 0, 0)) && lights(&lamp, vec3(0, 2.5f, 0)));
    map.drawn = 0;
    CHECK(lights(&lamp, vec3(0, 0, 0)));
}

/* A sun is never nearer than a blocker: a roof farther away than the length of the sun's direction still shadows. */
static void test_sun_map(void)
{
    const lmb_light light = sun(vec3(0, -1, 0));
    floor_and_roof();
    draw_map(&light, 64);
    CHECK(!lights(&light, vec3(0, 0, 0)) && lights(&light, vec3(0, 2.5f, 0)));
}

void test_light(void)
{
    test_spot_map();
    test_sun_map();
    test_irradiance();
    test_shadows();
    test_acne();
}
