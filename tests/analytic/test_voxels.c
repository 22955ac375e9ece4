/* test_voxels.c: cones through voxels against closed forms. [M6-M8 M13 M21]
 *
 * The integrating sphere (see test_sphere.c): one bounce is albedo x I / R2 everywhere. A plane under a sphere:
 * a sphere of radius r, with the centre at height h over the plane and at distance d from the pixel, covers r2
 * h / d3 of the cosine-weighted hemisphere. A closed room of constant radiance: pi times that radiance
 * everywhere, and nothing open. */
#include "../lit_tree.h"

#include <stdlib.h>

void test_voxels(void);

enum { STACKS = 48, SLICES = 96, CAP = 400000, ROOM_SIDE = 100 };

static lmb_voxels voxels;
static lmb_cones cones;
static lmb_cone_scratch cone_scratch;
static lmb_tile tile;

static void build(void *memory, size_t bytes, int32_t depth)
{
    const lmb_scene *s = &world.scene;
    const lmb_voxel_part part = {s, 1, lmb_scene_triangles(s), {1, 1}};
    CHECK(lmb_voxels_init(&voxels, CAP, LMB_VOXELS_ONE, memory, bytes) == LMB_OK);
    CHECK(lmb_voxels_build(&voxels, &s->bounds_min, &s->bounds_max, depth, &part, 1) == LMB_OK);
    CHECK(voxels.depth == depth);
}

static void set_pixel(int k, lmb_vec3 at, lmb_vec3 normal)
{
    tile.depth[k] = 1.0f;
    set_plane(tile.position, k, at);
    set_plane(tile.normal, k, normal);
    set_plane(tile.face, k, normal);
}

static void see(lmb_irradiance *light, float open[LMB_TILE_PIXELS])
{
    const lmb_cone_trace how = {picked_kernels(), &voxels, LMB_VOXEL_WITHOUT, LMB_VOXEL_WITHOUT, NULL,
                                &cone_scratch, 0};
    memset(light, 0, sizeof *light);
    CHECK(lmb_cones_diffuse(light, open, &how, &cones, &tile) == LMB_OK);
}

typedef struct deviation {
    double mean, max, off; /* signed mean; largest and mean of absolute values */
    int count;
} deviation;

static void deviate(deviation *d, double off)
{
    d->mean += off;
    d->off += fabs(off);
    d->max = fmax(d->max, fabs(off));
    ++d->count;
}

static void tell(const char *name, int32_t depth, int count, deviation *d)
{
    d->mean /= d->count;
    d->off /= d->count;
    printf("  %-16s %3d^3, %2d cones: %+.4f in the mean, off by %.4f, %.4f at most\n", name, 1 << depth, count, d->mean,
           d->off, d->max);
}

/* --- the integrating sphere --------------------------------------------------------------------------------------- */

static void check_sphere(void *memory, size_t bytes, int32_t depth, int count, double bar)
{
    deviation d = {0, 0, 0, 0};
    test_rng r = {3};
    lmb_irradiance light;
    build(memory, bytes, depth);
    CHECK(lmb_voxels_inject(&voxels, 0, lit.texel, (size_t)lit.faces * (size_t)(lit.size * lit.size)) == LMB_OK);
    CHECK(lmb_voxels_filter(&voxels, 0) == LMB_OK && voxels.lost[0] == 0.0);
    CHECK(lmb_cones_init(&cones, &voxels, count) == LMB_OK);
    for (int n = 0; n < 8; ++n) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int stack = (int)(test_random(&r) % STACKS), slice = (int)(test_random(&r) % SLICES);
            const lmb_vec3 at = on_sphere(stack, STACKS, slice, SLICES);
            set_pixel(k, mul3(at, 0.999f), mul3(at, -1.0f));
        }
        see(&light, NULL);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            deviate(&d, (double)light.rgb[1][k] / (0.5 * 3.0) - 1.0);
        }
    }
    tell("sphere", depth, count, &d);
    CHECK_MSG(fabs(d.mean) <= bar, "%g", d.mean);
}

/* --- a closed room ------------------------------------------------------------------------------------------------ */

static lmb_texel *room_texels;

/* Walls of radiance 1. */
static void make_room(lmb_vec3 half)
{
    const lmb_vec3 axis[3] = {X, Y, Z};
    const float side[3] = {half.x, half.y, half.z};
    world_begin(0.5f, 0.5f, 0.5f);
    for (int i = 0; i < 6; ++i) {
        const int a = i / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        const lmb_vec3 out = mul3(axis[a], i & 1 ? -1.0f : 1.0f), u = mul3(axis[b], side[b]),
                       v = mul3(axis[c], side[c]);
        world_quad(mul3(out, side[a]), u, v);
        for (int k = 0; k < ROOM_SIDE * ROOM_SIDE; ++k) {
            lmb_texel *t = &room_texels[i * ROOM_SIDE * ROOM_SIDE + k];
            const float x = ((float)(k % ROOM_SIDE) + 0.5f) * (2.0f / ROOM_SIDE) - 1.0f,
                        y = ((float)(k / ROOM_SIDE) + 0.5f) * (2.0f / ROOM_SIDE) - 1.0f;
            t->position = add3(mul3(out, side[a]), add3(mul3(u, x), mul3(v, y)));
            t->normal = mul3(out, -1.0f);
            for (int q = 0; q < 3; ++q) {
                t->flux[q] = (float)PI * 4.0f * side[b] * side[c] / (float)(ROOM_SIDE * ROOM_SIDE);
            }
        }
    }
    CHECK(world_end() == LMB_OK);
}

static void check_room(void *memory, size_t bytes, lmb_vec3 half, int32_t depth, int count)
{
    deviation d = {0, 0, 0, 0}, hole = {0, 0, 0, 0};
    const lmb_vec3 axis[3] = {X, Y, Z};
    const float side[3] = {half.x, half.y, half.z};
    float open[LMB_TILE_PIXELS];
    lmb_irradiance light;
    make_room(half);
    build(memory, bytes, depth);
    CHECK(lmb_voxels_inject(&voxels, 0, room_texels, 6 * ROOM_SIDE * ROOM_SIDE) == LMB_OK);
    CHECK(lmb_voxels_filter(&voxels, 0) == LMB_OK && voxels.lost[0] == 0.0);
    CHECK(lmb_cones_init(&cones, &voxels, count) == LMB_OK);
    for (int i = 0; i < 6; ++i) {
        const int a = i / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        const lmb_vec3 out = mul3(axis[a], i & 1 ? -1.0f : 1.0f);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float x = ((float)(k % 8) + 0.5f) * 0.25f - 1.0f, y = ((float)(k / 8) + 0.5f) * 0.25f - 1.0f;
            set_pixel(k, add3(mul3(out, side[a]), add3(mul3(axis[b], x * side[b]), mul3(axis[c], y * side[c]))),
                      mul3(out, -1.0f));
        }
        see(&light, open);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            deviate(&d, (double)light.rgb[0][k] / PI - 1.0);
            deviate(&hole, (double)open[k]);
        }
    }
    tell("room", depth, count, &d);
    tell("room, open", depth, count, &hole);
    CHECK_MSG(fabs(d.mean) <= 0.1, "%g", d.mean);
}

/* --- a plane under a sphere --------------------------------------------------------------------------------------- */

static void check_open(void *memory, size_t bytes, float height, int count, double bar)
{
    const float radius = 0.5f;
    deviation d = {0, 0, 0, 0};
    float open[LMB_TILE_PIXELS];
    lmb_irradiance light;
    world_begin(0.5f, 0.5f, 0.5f);
    world.material[0].flags = 0; /* closed, and seen only from outside */
    world_quad(vec3(0, 0, 0), vec3(0, 0, 2), vec3(2, 0, 0));
    world_sphere(vec3(0, height, 0), radius, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    build(memory, bytes, 7);
    CHECK(lmb_cones_init(&cones, &voxels, count) == LMB_OK);
    for (int n = 0; n < 16; ++n) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int x = 8 * (n % 4) + k % 8, z = 8 * (n / 4) + k / 8;
            set_pixel(k, vec3(((float)x + 0.5f) * 0.1f - 1.6f, 0, ((float)z + 0.5f) * 0.1f - 1.6f), Y);
        }
        see(&light, open);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const lmb_vec3 p = plane_vec(tile.position, k);
            const double to = sqrt((double)(p.x * p.x + p.z * p.z + height * height));
            deviate(&d, (double)open[k] - (1.0 - (double)(radius * radius * height) / (to * to * to)));
        }
    }
    tell(height > 0.6f ? "open" : "open, contact", 7, count, &d);
    CHECK_MSG(d.off <= 0.05 && d.max <= bar, "%g %g", d.off, d.max);
}

void test_voxels(void)
{
    const size_t bytes = lmb_voxels_bytes(CAP, LMB_VOXELS_ONE);
    const lmb_light light = point_light(vec3(0, 0, 0));
    void *memory = malloc(bytes);
    room_texels = calloc(6 * ROOM_SIDE * ROOM_SIDE, sizeof *room_texels);
    if (memory == NULL || room_texels == NULL) {
        abort();
    }
    world_begin(0.5f, 0.5f, 0.5f);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    lit_by(&light);
    for (int32_t depth = 6; depth <= 7; ++depth) {
        check_sphere(memory, bytes, depth, 7, 0.1);
        check_sphere(memory, bytes, depth, 19, 0.05);
    }
    check_room(memory, bytes, vec3(0.5f, 0.5f, 0.5f), 6, 19);
    check_room(memory, bytes, vec3(0.5f, 0.2f, 0.4f), 6, 19);
    check_open(memory, bytes, 0.8f, 7, 0.1);
    check_open(memory, bytes, 0.8f, 19, 0.06);
    check_open(memory, bytes, 0.8f, 37, 0.06);
    check_open(memory, bytes, 0.55f, 19, 0.06); /* 1.3 leaves over the plane */
    free(memory);
    free(room_texels);
}
