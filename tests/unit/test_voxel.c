/* test_voxel.c: surfaces and light stored in voxels, and limits of cones. [M6-M8 M11-M13 M20-M22] */
#include "../lit_tree.h"
#include "../voxel_sum.h"

#include <stdlib.h>

void test_voxel(void);

enum { CAP = 60000 };

static lmb_voxels v;
static lmb_cones cones;
static lmb_cone_scratch scratch;
static lmb_tile tile;
static void *memory;
static size_t bytes;

static lmb_status build(uint32_t cap, int32_t fields, int32_t depth, const lmb_voxel_part *parts, int32_t count)
{
    const lmb_scene *s = &world.scene;
    CHECK(lmb_voxels_init(&v, cap, fields, memory, bytes) == LMB_OK);
    return lmb_voxels_build(&v, &s->bounds_min, &s->bounds_max, depth, parts, count);
}

static void build_all(uint32_t cap, int32_t fields, int32_t depth)
{
    const lmb_voxel_part part = {&world.scene, 1, world.count, {1, 1}};
    CHECK(build(cap, fields, depth, &part, 1) == LMB_OK);
}

static int within(double a, double b, double share) { return fabs(a - b) <= share * fabs(b); }

/* --- surfaces ----------------------------------------------------------------------------------------------------- */

static double scene_area(double along[6])
{
    double area = 0.0;
    for (int k = 0; k < 6; ++k) {
        along[k] = 0.0;
    }
    for (uint32_t i = 0; i < world.count; ++i) {
        float (*c)[3] = world.corners[i];
        const lmb_vec3 a = vec3(c[0][0], c[0][1], c[0][2]), b = vec3(c[1][0], c[1][1], c[1][2]),
                       d = vec3(c[2][0], c[2][1], c[2][2]);
        const lmb_vec3 n = mul3(cross3(sub3(b, a), sub3(d, a)), 0.5f);
        const float part[3] = {n.x, n.y, n.z};
        area += (double)length3(n);
        for (int k = 0; k < 3; ++k) {
            along[2 * k + (part[k] < 0.0f)] += fabs((double)part[k]);
        }
    }
    return area;
}

/* M6: areas are exact for each direction, on the leaves and as the root's mean. */
static void surfaces_are_whole(int32_t depth)
{
    double along[6];
    world_begin(0.5f, 0.5f, 0.5f);
    world.material[0].flags = 0;
    world_sphere(vec3(0.1f, 0.2f, 0.3f), 0.7f, 24, 48);
    world_box(vec3(-1.0f, 0.2f, 0.1f), 0.3f);
    CHECK(world_end() == LMB_OK);
    build_all(CAP, LMB_VOXELS_ONE, depth);
    const double area = scene_area(along), face = (double)v.leaf * (double)v.leaf;
    const double leaves = pow(8.0, (double)v.depth);
    CHECK_MSG(v.depth == depth && within(v.area, area, 1e-4), "%g of %g", v.area, area);
    for (int k = 0; k < 6; ++k) {
        const double root = (double)v.cover[0][8 * LMB_VOXEL_COVER + k] * leaves * face;
        CHECK_MSG(within(root, along[k], 1e-3), "%d: %g of %g", k, root, along[k]);
    }
}

/* A triangle with a non-finite corner, or one too far away, is left out; the rest stays. */
static void no_place(void)
{
    static const float bad[] = {NAN, INFINITY, 1e30f, -1e30f};
    for (int i = 0; i < 12; ++i) {
        world_begin(0.5f, 0.5f, 0.5f);
        world_box(vec3(-1.0f, 0.2f, 0.1f), 0.3f);
        CHECK(world_end() == LMB_OK);
        world.corners[5][i % 3][i / 4] = bad[i % 4];
        const lmb_voxel_part part = {&world.scene, 1, world.count + 9, {1, 1}}; /* nine that do not exist */
        CHECK(build(CAP, LMB_VOXELS_ONE, 4, &part, 1) == LMB_OK);
        CHECK_MSG(within(v.area, 11.0 * 0.18, 1e-4), "%d: %g", i, v.area);
    }
}

/* Hashes each place's leaf, independent of its number. */
static uint64_t hash_places(void)
{
    uint64_t h = UINT64_C(0xcbf29ce484222325);
    const int32_t side = 1 << v.depth;
    for (int32_t i = 0; i < side * side * side; ++i) {
        const lmb_vec3 cell = vec3((float)(i % side) + 0.5f, (float)(i / side % side) + 0.5f,
                                   (float)(i / (side * side)) + 0.5f);
        const uint32_t at = lmb_voxels_at(&v, add3(v.low, mul3(cell, v.leaf)), 0);
        for (int k = 0; k < LMB_VOXEL_COVER && at > 0; ++k) {
            uint32_t bits;
            memcpy(&bits, &v.cover[0][(size_t)at * LMB_VOXEL_COVER + (size_t)k], sizeof bits);
            h = (h ^ (bits + (uint32_t)i)) * UINT64_C(0x100000001b3);
        }
    }
    return h;
}

static void order_does_not_matter(void)
{
    build_all(CAP, LMB_VOXELS_ONE, 5);
    const uint64_t before = hash_places();
    for (uint32_t i = 0; i < world.count / 2; ++i) {
        float other[3][3];
        memcpy(other, world.corners[i], sizeof other);
        memcpy(world.corners[i], world.corners[world.count - 1 - i], sizeof other);
        memcpy(world.corners[world.count - 1 - i], other, sizeof other);
    }
    build_all(CAP, LMB_VOXELS_ONE, 5);
    CHECK(hash_places() == before);
    world.corners[0][0][0] += 0.05f;
    build_all(CAP, LMB_VOXELS_ONE, 5);
    CHECK(hash_places() != before);
}

/* M8: empty space uses no nodes, and a full pool merges its contents into larger leaves. */
static void small_pools(void)
{
    double along[6];
    const double area = scene_area(along);
    build_all(CAP, LMB_VOXELS_ONE, 6);
    const uint32_t needed = v.count;
    CHECK(needed < (1u << 18) / 8 && v.depth == 6 && v.asked == 6);
    CHECK(lmb_voxels_at(&v, v.low, 0) == 0 && lmb_voxels_at(&v, sub3(v.low, X), 0) == 0);
    build_all(needed, LMB_VOXELS_ONE, 6);
    CHECK(v.depth == 6 && v.count == needed);
    build_all(needed - 1, LMB_VOXELS_ONE, 6);
    CHECK(v.depth == 5 && v.asked == 6 && within(v.area, area, 1e-4));
    build_all(4689, LMB_VOXELS_ONE, 10);
    CHECK(v.depth == 4 && v.count == 4689 && within(v.area, area, 1e-4));
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static size_t lit_count(void) { return (size_t)lit.faces * (size_t)(lit.size * lit.size); }

/* M7, M13: all the map's light, per direction, on the leaves and as the root's mean. */
static void light_is_whole(void)
{
    const lmb_light light = spot(vec3(0.2f, 2.5f, 1.0f), vec3(0, -1, -0.4f), 30, 40);
    double want[6] = {0, 0, 0, 0, 0, 0}, got[6][3], flux = 0.0, error = 0.0, max = 0.0;
    lit_by(&light);
    build_all(CAP, LMB_VOXELS_ONE, 6);
    CHECK(lmb_voxels_inject(&v, 0, lit.texel, lit_count()) == LMB_OK);
    for (size_t i = 0; i < lit_count(); ++i) {
        const lmb_texel *t = &lit.texel[i];
        const float n[3] = {t->normal.x, t->normal.y, t->normal.z};
        flux += (double)t->flux[0] + (double)t->flux[1] + (double)t->flux[2];
        for (int k = 0; k < 3; ++k) {
            want[2 * k + (n[k] < 0.0f)] += (double)t->flux[0] * fabs((double)n[k]);
        }
    }
    CHECK_MSG(flux > 0.0 && within(v.flux[0] + v.lost[0], flux, 1e-9) && v.lost[0] == 0.0, "%g of %g, %g lost",
              v.flux[0], flux, v.lost[0]);
    CHECK(lmb_voxels_filter(&v, 0) == LMB_OK);
    voxel_sum(got, &v, 0);
    const double scale = PI * (double)v.leaf * (double)v.leaf * pow(8.0, (double)v.depth);
    for (int k = 0; k < 6; ++k) {
        const double root = (double)v.light[0][8 * LMB_VOXEL_LIGHT + 4 * k] * scale;
        error = fmax(error, fmax(fabs(got[k][0] - want[k]), fabs(root - want[k])));
        max = fmax(max, want[k]);
    }
    CHECK_MSG(error <= 1e-5 * max, "%g of %g", error, max);
    printf("  light injected and filtered: %.2g of it off\n", error / max);
}

/* --- two worlds --------------------------------------------------------------------------------------------------- */

static void set_floor_tile(float y)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        tile.depth[k] = 1.0f;
        set_plane(tile.position, k, vec3((float)(k % 8) * 0.25f - 0.9f, y, (float)(k / 8) * 0.25f - 0.9f));
        set_plane(tile.normal, k, Y);
        set_plane(tile.face, k, Y);
    }
}

static lmb_irradiance see(int32_t field, int32_t in_world, const lmb_env *env, float open[LMB_TILE_PIXELS])
{
    const lmb_cone_trace trace = {picked_kernels(), &v, field, in_world, env, &scratch, 0};
    lmb_irradiance light;
    memset(&light, 0, sizeof light);
    CHECK(lmb_cones_diffuse(&light, open, &trace, &cones, &tile) == LMB_OK);
    return light;
}

/* A room of a floor and two walls, with an optional box in one of the worlds. */
static void make_worlds(int object)
{
    const lmb_light light = spot(vec3(0.4f, 1.8f, 0.4f), vec3(-0.2f, -1, -0.2f), 40, 50);
    lmb_voxel_part parts[2];
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    world_quad(vec3(-1, 1, 0), Y, Z);
    world_quad(vec3(0, 1, -1), X, Y);
    world_part();
    world_box(vec3(-0.2f, 0.31f, -0.2f), 0.3f);
    CHECK(world_end() == LMB_OK);
    memset(parts, 0, sizeof parts);
    parts[0].scene = parts[1].scene = &world.scene;
    parts[0].first_id = 1;
    parts[0].count = world.first;
    parts[0].in[0] = parts[0].in[1] = parts[1].in[1] = 1;
    parts[1].first_id = world.first + 1;
    parts[1].count = object ? world.count - world.first : 0;
    CHECK(build(CAP, LMB_VOXELS_THREE, 5, parts, 2) == LMB_OK);
    for (int32_t w = 0; w < 2; ++w) {
        world.instance[1].to_world.m[13] = w == 0 || !object ? 100.0f : 0.0f; /* outside the light's cone */
        lit_by(&light);
        CHECK(lmb_voxels_inject(&v, w, lit.texel, lit_count()) == LMB_OK && v.lost[w] == 0.0);
        CHECK(lmb_voxels_filter(&v, w) == LMB_OK);
    }
    CHECK(lmb_voxels_delta(&v) == LMB_OK && lmb_cones_init(&cones, &v, 7) == LMB_OK);
    set_floor_tile(0.0f);
}

/* M11, M12: without an object the difference is zero to the bit. An object removes light and adds some. */
static void difference_of_worlds(void)
{
    float min = 0.0f, max = 0.0f, traced = 0.0f, open[2][LMB_TILE_PIXELS];
    make_worlds(0);
    lmb_irradiance without = see(0, 0, NULL, open[0]), with = see(1, 1, NULL, open[1]), delta = see(2, 1, NULL, NULL);
    CHECK(memcmp(&without, &with, sizeof with) == 0 && memcmp(open[0], open[1], sizeof open[0]) == 0);
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        max = fmaxf(max, without.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS]);
        min = fmaxf(min, fabsf(delta.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS]));
    }
    CHECK(max > 0.0f && min == 0.0f);
    make_worlds(1);
    const lmb_irradiance before = see(0, 0, NULL, open[0]), hidden = see(0, 1, NULL, NULL);
    with = see(1, 1, NULL, open[1]);
    delta = see(2, 1, NULL, NULL);
    min = max = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        traced = fmaxf(traced, fabsf(with.rgb[0][k] - hidden.rgb[0][k] - delta.rgb[0][k]));
        min = fminf(min, with.rgb[0][k] - before.rgb[0][k]);
        max = fmaxf(max, with.rgb[0][k] - before.rgb[0][k]);
    }
    CHECK_MSG(min < -0.01f && max > 0.001f && traced < 1e-5f, "%g %g %g", (double)min, (double)max, (double)traced);
    min = max = 0.0f;
    for (size_t i = 0; i < (size_t)v.count * LMB_VOXEL_LIGHT; ++i) {
        min = fminf(min, v.light[LMB_VOXEL_DELTA][i]);
        max = fmaxf(max, v.light[LMB_VOXEL_DELTA][i]);
    }
    CHECK(min < 0.0f && max > 0.0f);
}

/* Twice the light gives exactly twice the result. */
static void twice_the_light(void)
{
    static lmb_texel twice[LIT_SIDE * LIT_SIDE];
    const lmb_irradiance once = see(1, 1, NULL, NULL);
    CHECK(lit_count() <= LIT_SIDE * LIT_SIDE);
    memcpy(twice, lit.texel, lit_count() * sizeof *twice);
    for (size_t i = 0; i < lit_count(); ++i) {
        for (int c = 0; c < 3; ++c) {
            twice[i].flux[c] *= 2.0f;
        }
    }
    CHECK(lmb_voxels_dark(&v, 1) == LMB_OK && lmb_voxels_inject(&v, 1, twice, lit_count()) == LMB_OK);
    CHECK(lmb_voxels_filter(&v, 1) == LMB_OK);
    const lmb_irradiance two = see(1, 1, NULL, NULL);
    int equal = 1;
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        equal &= two.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] ==
                 2.0f * once.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
    }
    CHECK(equal);
}

/* --- cones -------------------------------------------------------------------------------------------------------- */

/* M21, M22: under an open sky of constant radiance a floor receives pi times the radiance; each cone has its share of
 * the hemisphere. */
static void open_sky(void)
{
    static uint32_t texels[6 * (64 + 16 + 4 + 1) * 2];
    const float radiance[3] = {2.0f, 0.5f, 8.0f};
    lmb_env env;
    CHECK(lmb_env_init(&env, 8, texels, sizeof texels) == LMB_OK);
    for (int32_t i = 0; i < 6 * 64; ++i) {
        lmb_env_set(&env, i / 64, i % 8, i / 8 % 8, radiance);
    }
    lmb_env_mips(&env);
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    CHECK(world_end() == LMB_OK);
    build_all(CAP, LMB_VOXELS_ONE, 5);
    set_floor_tile(0.0f);
    tile.depth[9] = 0.0f;
    for (int32_t count = 7; count <= 37; count += count == 7 ? 12 : 18) {
        float open[LMB_TILE_PIXELS], off = 0.0f;
        lmb_vec3 sum = {0, 0, 0};
        CHECK(lmb_cones_init(&cones, &v, count) == LMB_OK);
        const lmb_irradiance light = see(0, 0, &env, open);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            for (int c = 0; c < 3; ++c) {
                const float want = k == 9 ? 0.0f : (float)PI * radiance[c];
                off = fmaxf(off, fabsf(light.rgb[c][k] - want) / radiance[c]);
            }
        }
        for (int32_t i = 0; i < count; ++i) {
            const float *d = cones.direction[i];
            sum = add3(sum, vec3(d[0], d[1], d[2]));
            CHECK(fabs((double)(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - 1.0) < 1e-6 && d[2] > 0.2f);
        }
        CHECK_MSG(off < 1e-4f && open[9] == 0.0f, "%d cones: %g", (int)count, (double)off);
        /* The mean cosine over the cosine-weighted hemisphere is 2/3; axes are the centres of wide cones. */
        CHECK_MSG(fabs((double)sum.z / count - 2.0 / 3.0) < 0.06 && fabs((double)sum.x) + fabs((double)sum.y) < 1e-4,
                  "%g", (double)sum.z / count);
    }
}

/* A wall lit from one side is dark on the other and occludes everything behind it. */
static void walls_are_tight(void)
{
    const lmb_light above = spot(vec3(0.9f, 1.0f, 0), vec3(-1, -0.2f, 0), 30, 40);
    float open[LMB_TILE_PIXELS], max = 0.0f, front = 0.0f;
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    world_quad(vec3(0.03f, 1, 0), Y, mul3(Z, 1.0f));
    CHECK(world_end() == LMB_OK);
    lit_by(&above);
    build_all(CAP, LMB_VOXELS_ONE, 6);
    CHECK(lmb_voxels_inject(&v, 0, lit.texel, lit_count()) == LMB_OK && lmb_voxels_filter(&v, 0) == LMB_OK);
    CHECK(lmb_cones_init(&cones, &v, 19) == LMB_OK);
    set_floor_tile(0.0f);
    const lmb_irradiance light = see(0, 0, NULL, open);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (k % 8 == 2) {
            max = fmaxf(max, light.rgb[0][k]);
        } else if (k % 8 == 5) {
            front = fmaxf(front, light.rgb[0][k]);
        }
    }
    CHECK_MSG(front > 0.0f && max < 0.02f * front, "%g behind, %g in front", (double)max, (double)front);
}

/* M20: a narrow cone along the mirrored view gives the mirror's picture. */
static void mirror(void)
{
    lmb_cone_width width;
    lmb_cone_seen seen;
    make_worlds(0);
    CHECK(lmb_cone_width_init(&width, &v, lmb_cone_tangent(0.15f)) == LMB_OK && width.tangent < 0.06f);
    const lmb_cone_trace trace = {picked_kernels(), &v, 0, 0, NULL, &scratch, 0};
    /* From above the floor's centre towards the wall at x = -1, and towards the open side. */
    CHECK(lmb_cones_glossy(&seen, &trace, &width, &tile, vec3(3.0f, 1.0f, 0.0f)) == LMB_OK);
    CHECK(seen.rgb[1][4 * 8 + 3] > 0.0f && seen.open[4 * 8 + 3] < 0.1f);
    CHECK(lmb_cones_glossy(&seen, &trace, &width, &tile, vec3(-3.0f, 1.0f, 0.0f)) == LMB_OK);
    CHECK(seen.rgb[1][4 * 8 + 3] == 0.0f && seen.open[4 * 8 + 3] > 0.99f);
    /* The same cone along explicit mirror directions; straight up there is nothing. */
    static float direction[3][LMB_TILE_PIXELS];
    static lmb_cone_seen along;
    CHECK(lmb_cones_glossy(&seen, &trace, &width, &tile, vec3(3.0f, 1.0f, 0.0f)) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 d = sub3(plane_vec(tile.position, k), vec3(3.0f, 1.0f, 0.0f));
        set_plane(direction, k, normalize3(vec3(d.x, -d.y, d.z)));
    }
    CHECK(lmb_cones_trace(&along, &trace, &width, &tile, direction) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        CHECK(fabsf(along.rgb[1][k] - seen.rgb[1][k]) < 1e-3f && fabsf(along.open[k] - seen.open[k]) < 1e-3f);
        set_plane(direction, k, Y);
    }
    CHECK(lmb_cones_trace(&along, &trace, &width, &tile, direction) == LMB_OK);
    CHECK(along.rgb[1][27] == 0.0f && along.open[27] == 1.0f);
    CHECK(lmb_cones_trace(&along, &trace, NULL, &tile, direction) == LMB_ERR_ARG);
    /* Narrow cones need too many steps in the finest trees and are widened until the steps fit. */
    lmb_voxels fine = v;
    for (fine.depth = 4; fine.depth <= 12; ++fine.depth) {
        CHECK(lmb_cone_width_init(&width, &fine, 0.01f) == LMB_OK && width.count <= LMB_CONE_STEPS);
        CHECK(fine.depth <= 8 ? width.tangent == 0.01f : width.tangent > 0.012f && width.tangent < 0.04f);
        const lmb_cone_step *last = &width.step[width.count - 1];
        CHECK(last->at + 0.5f * last->length >= 1.7f * v.leaf * (float)(1 << fine.depth));
    }
    CHECK(lmb_cone_width_init(&width, &v, 0.009f) == LMB_ERR_ARG && lmb_cone_width_init(NULL, &v, 1.0f) == LMB_ERR_ARG);
    CHECK(lmb_cone_tangent(0.0f) < lmb_cone_tangent(0.5f) && lmb_cone_tangent(1.0f) == 1.0f);
}

/* --- refused input ------------------------------------------------------------------------------------------------ */

static void refusals(void)
{
    const lmb_vec3 low = {0, 0, 0}, high = {1, 1, 1}, nan = {NAN, 0, 0};
    const lmb_voxel_part part = {&world.scene, 1, 1, {1, 1}}, none = {NULL, 1, 1, {1, 1}};
    lmb_irradiance light;
    lmb_cone_trace trace = {picked_kernels(), &v, 0, 0, NULL, &scratch, 0};
    CHECK(lmb_voxels_bytes(4688, LMB_VOXELS_ONE) == 0 && lmb_voxels_bytes(4689, 2) == 0);
    CHECK(lmb_voxels_bytes(5000, LMB_VOXELS_ONE) == 5000 * 148);
    CHECK(lmb_voxels_bytes(5000, LMB_VOXELS_THREE) == 5000 * 388);
    CHECK(lmb_voxels_init(&v, 5000, LMB_VOXELS_ONE, memory, 5000 * 148 - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_voxels_init(&v, 5000, LMB_VOXELS_ONE, (char *)memory + 1, bytes - 1) == LMB_ERR_ALIGN);
    CHECK(lmb_voxels_init(NULL, 5000, LMB_VOXELS_ONE, memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_voxels_init(&v, 5000, LMB_VOXELS_ONE, memory, bytes) == LMB_OK);
    CHECK(lmb_voxels_inject(&v, 0, NULL, 0) == LMB_ERR_ARG && lmb_voxels_filter(&v, 0) == LMB_ERR_ARG);
    CHECK(lmb_cones_init(&cones, &v, 7) == LMB_ERR_ARG);
    CHECK(lmb_voxels_build(&v, &low, &high, 3, &part, 1) == LMB_ERR_ARG);
    CHECK(lmb_voxels_build(&v, &low, &nan, 5, &part, 1) == LMB_ERR_ARG);
    CHECK(lmb_voxels_build(&v, &high, &low, 5, &part, 1) == LMB_ERR_ARG);
    CHECK(lmb_voxels_build(&v, &low, &high, 5, &none, 1) == LMB_ERR_ARG);
    CHECK(lmb_voxels_build(&v, &low, &high, 5, &part, 1) == LMB_OK);
    CHECK(lmb_voxels_filter(&v, -1) == LMB_ERR_ARG && lmb_voxels_filter(&v, LMB_VOXELS_THREE) == LMB_ERR_ARG);
    CHECK(lmb_voxels_filter(NULL, 0) == LMB_ERR_ARG);
    CHECK(lmb_voxels_inject(&v, LMB_VOXEL_WITH, NULL, 0) == LMB_ERR_ARG && lmb_voxels_delta(&v) == LMB_ERR_ARG);
    CHECK(lmb_cones_init(&cones, &v, 8) == LMB_ERR_ARG && lmb_cones_init(&cones, &v, 7) == LMB_OK);
    trace.scratch = NULL;
    CHECK(lmb_cones_diffuse(&light, NULL, &trace, &cones, &tile) == LMB_ERR_ARG);
    trace.scratch = &scratch;
    trace.world = LMB_VOXEL_WITH;
    CHECK(lmb_cones_diffuse(&light, NULL, &trace, &cones, &tile) == LMB_ERR_ARG);
}

void test_voxel(void)
{
    bytes = lmb_voxels_bytes(CAP, LMB_VOXELS_THREE);
    memory = malloc(bytes);
    if (memory == NULL) {
        abort();
    }
    memset(memory, 0x3c, bytes);
    surfaces_are_whole(4);
    surfaces_are_whole(6);
    order_does_not_matter();
    small_pools();
    light_is_whole();
    difference_of_worlds();
    twice_the_light();
    open_sky();
    walls_are_tight();
    mirror();
    no_place();
    refusals();
    free(memory);
}
