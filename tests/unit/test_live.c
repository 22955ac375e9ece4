/* test_live.c: light at single points, against sums over all first points; points that must be dark; the same bytes on
 * every backend. */
#include "../world.h"

#include <math.h>

#include "../../src/lane/kernels.h"
#include "../../src/live/live_part.h"

void test_live(void);

enum { MAP = 256, FACES = 12 };

static uint64_t live_memory[1 << 22], bvh_memory[1 << 18];
static uint32_t map_memory[6 * MAP * MAP * 2];
static lmb_live live;
static lmb_live_scratch scratch;
static lmb_shadow_map map;
static lmb_tile tile;
static lmb_bvh bvh;

/* --- a lit world -------------------------------------------------------------------------------------------------- */

static void collect(uint32_t light)
{
    CHECK(lmb_shadow_map_init(&map, &world.scene.lights[light], &world.scene, MAP, LMB_ID32, map_memory,
                              sizeof map_memory) == LMB_OK);
    lmb_shadow_map_clear(&map);
    CHECK(lmb_shadow_map_draw(&map, picked_kernels(), &world.scene, 1, WORLD_TRIANGLES, NULL) == LMB_OK);
    for (int32_t f = 0; f < map.faces; ++f) {
        if ((map.drawn >> f) & 1u) {
            CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, light, &map, f, live.faces, 0,
                                   MAP / LMB_TILE) == LMB_OK);
            ++live.faces;
        }
    }
}

/* Lights the world with lights that share a map's memory: each is collected before the next is drawn. */
static void light_world(const lmb_light *lights, uint32_t count)
{
    CHECK(world_end() == LMB_OK);
    world.scene.lights = lights;
    world.scene.light_count = count;
    memset(live_memory, 0x5a, sizeof live_memory);
    CHECK(lmb_live_bytes(FACES, lmb_live_side(FACES, MAP), 0) <= sizeof live_memory);
    CHECK(lmb_live_init(&live, FACES, lmb_live_side(FACES, MAP), 0, live_memory, sizeof live_memory) == LMB_OK);
    for (uint32_t i = 0; i < count; ++i) {
        collect(i);
    }
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK);
    CHECK(live.points > 0 && live.merged == 0);
    CHECK(lmb_bvh_init(&bvh, world.count, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&bvh, &world.scene) == LMB_OK);
}

static lmb_vec3 corner(uint32_t triangle, int k)
{
    const float *p = world.corners[triangle][k];
    return vec3(p[0], p[1], p[2]);
}

/* A random point on a triangle, on the side of `eye`. */
static lmb_live_receiver place_on(uint32_t triangle, lmb_vec3 eye, test_rng *r)
{
    lmb_live_receiver at;
    const lmb_vec3 a = corner(triangle, 0), u = sub3(corner(triangle, 1), a), v = sub3(corner(triangle, 2), a);
    float s = test_uniform(r, 0.01f, 0.99f), t = test_uniform(r, 0.01f, 0.99f);
    s = s + t > 0.99f ? 0.99f - s : s;
    t = s + t > 0.99f ? 0.99f - t : t;
    at.position = add3(a, add3(mul3(u, absf(s)), mul3(v, absf(t))));
    at.face = normalize3(cross3(u, v));
    at.face = dot3(at.face, sub3(eye, at.position)) < 0.0f ? mul3(at.face, -1.0f) : at.face;
    at.normal = at.face;
    at.id = triangle + 1;
    at.noise = lmb_place_noise(at.position, length3(sub3(eye, at.position)));
    at.to_eye = sub3(eye, at.position);
    at.turn = 0.0f;
    return at;
}

static void receive(float light[3], const lmb_kernels *kernels, const lmb_live_receiver *at, int shadows)
{
    CHECK(lmb_live_receive(light, kernels, &scratch, &live, shadows ? &bvh : NULL, at) == LMB_OK);
}

/* --- all first points, one by one --------------------------------------------------------------------------------- */

/* Returns whether any triangle is in between, except those at the two ends. In binary64. */
static int is_hidden(lmb_vec3 from, lmb_vec3 to, uint32_t own, uint32_t other)
{
    for (uint32_t i = 0; i < world.count; ++i) {
        double e[3][3], d[3], v[3], vol = 0.0;
        const float a[3] = {from.x, from.y, from.z}, b[3] = {to.x, to.y, to.z};
        if (i + 1 == own || i + 1 == other) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            d[k] = (double)b[k] - (double)a[k];
            for (int j = 0; j < 3; ++j) {
                e[k][j] = (double)world.corners[i][k][j] - (double)a[j];
            }
        }
        for (int k = 0; k < 3; ++k) {
            const double *p = e[(k + 1) % 3], *q = e[(k + 2) % 3];
            const double n[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
            v[k] = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
            vol = n[0] * e[k][0] + n[1] * e[k][1] + n[2] * e[k][2];
        }
        const double side = vol < 0.0 ? -1.0 : 1.0, sum = side * (v[0] + v[1] + v[2]);
        if (side * v[0] >= 0.0 && side * v[1] >= 0.0 && side * v[2] >= 0.0 && sum * 0.99999 > side * vol) {
            return 1;
        }
    }
    return 0;
}

/* Light of all first points by the node formula. */
static double sum_of_all(const lmb_live_receiver *at, int channel, int shadows)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < live.points; ++i) {
        const lmb_live_point *p = &live.sorted[i];
        const lmb_vec3 d = sub3(p->position, at->position);
        const double here = (double)dot3(d, at->normal), there = -(double)dot3(d, p->normal), d2 = (double)dot3(d, d);
        if (here > 0.0 && there > 0.0 && (!shadows || !is_hidden(at->position, p->position, at->id, p->id))) {
            sum += (double)p->flux[channel] * here * there / (d2 * (PI * d2 + (double)p->area));
        }
    }
    return sum;
}

/* Returns whether a first point is so near that parts of it count. Blocks of the wide world are as large as a room,
 * and dark. */
static int is_near(const lmb_live_receiver *at)
{
    for (uint32_t i = 0; i < live.points; ++i) {
        const lmb_vec3 d = sub3(live.sorted[i].position, at->position);
        if (dot3(d, d) < 16.0f * live.sorted[i].area && live.sorted[i].id != at->id && live.sorted[i].area < 1.0f) {
            return 1;
        }
    }
    return 0;
}

/* A random point without a near first point: small triangles may have none. */
static lmb_live_receiver far_place(lmb_vec3 eye, test_rng *r)
{
    lmb_live_receiver at = place_on(test_random(r) % world.count, eye, r);
    while (is_near(&at)) {
        at = place_on(test_random(r) % world.count, eye, r);
    }
    return at;
}

typedef struct errors {
    double rms, worst, bias;
} errors;

/* For `count` receivers without near first points, relative to their mean. */
static errors errors_of(int count, lmb_vec3 eye, int shadows, test_rng *r)
{
    errors e = {0, 0, 0};
    double mean = 0.0;
    for (int i = 0; i < count; ++i) {
        const lmb_live_receiver at = far_place(eye, r);
        const int channel = i % 3;
        float light[3];
        receive(light, picked_kernels(), &at, shadows);
        const double all = sum_of_all(&at, channel, shadows), off = (double)light[channel] - all;
        mean += all / count;
        e.rms += off * off / count;
        e.worst = fmax(e.worst, fabs(off));
        e.bias += off / count;
    }
    CHECK(mean > 0.0);
    e.rms = sqrt(e.rms) / mean;
    e.worst /= mean;
    e.bias /= mean;
    return e;
}

/* A room with a table; first points cover both. */
static void room_with_table(void)
{
    world_begin(0.7f, 0.5f, 0.3f);
    world_box(vec3(0, 1, 0), 1.0f);
    world_quad(vec3(0.1f, 0.7f, 0.0f), mul3(X, 0.45f), mul3(Z, 0.4f));
    world_quad(vec3(-0.5f, 0.4f, 0.3f), mul3(X, 0.2f), mul3(Y, 0.4f));
}

/* --- tests -------------------------------------------------------------------------------------------------------- */

static void sums_and_shares(void)
{
    test_rng r = {5};
    const lmb_vec3 eye = vec3(-0.7f, 1.5f, -0.7f);
    const lmb_light lights[2] = {spot(vec3(0.6f, 1.8f, 0.5f), vec3(-0.5f, -1, -0.4f), 20, 35),
                                 point_light(vec3(-0.6f, 1.6f, 0.2f))};
    for (uint32_t count = 1; count <= 2; ++count) {
        room_with_table();
        light_world(lights, count);
        live.split = 16.0f;
        const errors sum = errors_of(tries(100, 150), eye, 0, &r);
        CHECK_MSG(sum.rms < 0.02 && fabs(sum.bias) < 0.005, "%u lights: sums rms %.4f, bias %.4f", (unsigned)count,
                  sum.rms, sum.bias);
        const errors shadows = errors_of(tries(100, 150), eye, 1, &r);
        CHECK_MSG(shadows.rms < 0.08 && fabs(shadows.bias) < 0.02, "%u lights: shadows rms %.4f, bias %.4f",
                  (unsigned)count, shadows.rms, shadows.bias);
    }
    CHECK_MSG(scratch.full == 0, "%u full", (unsigned)scratch.full);
}

/* Eight equal lights of an eighth each give the light of one: the area of a point counts once. */
static void area_counts_once(void)
{
    test_rng r = {9};
    lmb_light lights[8];
    lmb_live_receiver at[60];
    float one[60][3];
    const lmb_light whole = spot(vec3(0.6f, 1.8f, 0.5f), vec3(-0.5f, -1, -0.4f), 20, 35);
    room_with_table();
    light_world(&whole, 1);
    for (int i = 0; i < 60; ++i) {
        at[i] = far_place(vec3(0, 1, 0), &r);
        receive(one[i], picked_kernels(), &at[i], 0);
    }
    for (int i = 0; i < 8; ++i) {
        lights[i] = whole;
        lights[i].position.x += 1e-3f * (float)i;
        for (int c = 0; c < 3; ++c) {
            lights[i].intensity[c] *= 0.125f;
        }
    }
    light_world(lights, 8);
    double sum = 0.0, off = 0.0;
    for (int i = 0; i < 60; ++i) {
        float light[3];
        receive(light, picked_kernels(), &at[i], 0);
        sum += (double)one[i][0];
        off += (double)light[0] - (double)one[i][0];
    }
    CHECK_MSG(fabs(off / sum) < 0.01, "eight lights are %.4f of one", 1.0 + off / sum);
}

/* Four blocks amid sixteen of one triangle give one point, with the light and area of all. */
static void alike_blocks_are_joined(void)
{
    const lmb_light light = spot(vec3(0, 2, 0), vec3(0, -1, 0), 34, 35);
    const double radius = 2.0 * tan(35.0 * PI / 180.0), disc = PI * radius * radius;
    uint32_t wide = 0, by_group[MAP / 16][MAP / 16] = {{0}};
    double area = 0.0, flux = 0.0;
    world_begin(0.6f, 0.6f, 0.6f);
    world_triangle(vec3(-9, 0, -9), vec3(0, 0, 9), vec3(9, 0, -9));
    light_world(&light, 1);
    for (uint32_t i = 0; i < live.points; ++i) {
        const lmb_live_point *p = &live.sorted[i];
        CHECK(p->wide == 1 || (p->wide == 2 && p->column % 2 == 0 && p->row % 2 == 0));
        wide += p->wide == 2;
        by_group[p->row / 4][p->column / 4] += p->wide == 2;
        area += (double)p->area;
        flux += (double)p->flux[0];
    }
    /* A cone of 35 degrees with even intensity, less its faded edge. */
    const double sent = 0.6 * (double)light.intensity[0] * 2.0 * PI * (1.0 - cos(35.0 * PI / 180.0));
    for (int i = 0; i < MAP / 16 * (MAP / 16); ++i) {
        CHECK(by_group[i / (MAP / 16)][i % (MAP / 16)] % 4 == 0);
    }
    CHECK_MSG(wide * 5 > live.points * 3, "%u of %u points", (unsigned)wide, (unsigned)live.points);
    CHECK_MSG(area > 0.95 * disc && area < 1.15 * disc, "%g m2 of %g", area, disc);
    CHECK_MSG(flux > 0.94 * sent && flux < 1.0 * sent, "%g W of %g", flux, sent);
}

/* Points of a map in rows are those of a tiled map, in which squares of one triangle are found at once. */
static void points_of_layouts(void)
{
    static lmb_live_point before[MAP * MAP / 16];
    static uint32_t ids[MAP * MAP];
    static float depths[MAP * MAP];
    const lmb_light light = spot(vec3(0, 2, 0), vec3(0, -1, 0), 34, 35);
    uint32_t wrong = 0;
    world_begin(0.6f, 0.6f, 0.6f);
    world_triangle(vec3(-9, 0, -9), vec3(0, 0, 9), vec3(9, 0, -9));
    world_quad(vec3(0.5f, 0.5f, 0.5f), mul3(Z, 0.2f), mul3(X, 0.2f));
    light_world(&light, 1);
    const uint32_t points = live.points;
    CHECK(map.faces == 1 && points <= COUNT(before));
    memcpy(before, live.sorted, points * sizeof *before);
    for (int32_t i = 0; i < MAP * MAP; ++i) {
        const int32_t x = i % MAP, y = i / MAP;
        const lmb_surface *d = &map.face[0].depth;
        ids[i] = live_id(&map.face[0].id, x, y);
        memcpy(&depths[i],
               (const uint8_t *)d->data + (y / LMB_TILE) * d->stride_bytes +
                   (x / LMB_TILE * LMB_TILE_PIXELS + y % LMB_TILE * LMB_TILE + x % LMB_TILE) * 4,
               sizeof depths[i]);
    }
    CHECK(map.face[0].id.layout == LMB_TILED && map.face[0].depth.layout == LMB_TILED);
    map.face[0].id.layout = map.face[0].depth.layout = LMB_LINEAR;
    map.face[0].id.stride_bytes = map.face[0].depth.stride_bytes = MAP * 4;
    map.face[0].id.data = ids;
    map.face[0].depth.data = depths;
    memset(live_memory, 0x5a, sizeof live_memory);
    CHECK(lmb_live_init(&live, FACES, lmb_live_side(FACES, MAP), 0, live_memory, sizeof live_memory) == LMB_OK);
    CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, 0, &map, 0, 0, 0, MAP / LMB_TILE) == LMB_OK);
    live.faces = 1;
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK);
    for (uint32_t i = 0; i < points && live.points == points; ++i) {
        const lmb_live_point *a = &before[i], *b = &live.sorted[i];
        wrong += memcmp(&a->position, &b->position, sizeof a->position) != 0 ||
                 memcmp(a->flux, b->flux, sizeof a->flux) != 0 || memcmp(&a->area, &b->area, sizeof a->area) != 0 ||
                 a->id != b->id || a->column != b->column || a->row != b->row || a->shows != b->shows;
    }
    CHECK_MSG(live.points == points && wrong == 0, "%u of %u, %u points differ", (unsigned)live.points,
              (unsigned)points, (unsigned)wrong);
}

/* A map with an odd number of blocks each way, of 8 texels: at its far edges pairs of blocks are cut off. The points
 * have all light of the texels. */
static void odd_blocks(void)
{
    enum { SIZE = 136, SIDE = SIZE / 8 };
    const lmb_light light = sun(vec3(0, -1, 0));
    double flux = 0.0, want = 0.0;
    uint32_t last = 0;
    world_begin(0.6f, 0.6f, 0.6f);
    world_quad(vec3(0, 0, 0), mul3(Z, 1), mul3(X, 1));
    CHECK(world_end() == LMB_OK);
    world.scene.lights = &light;
    world.scene.light_count = 1;
    memset(live_memory, 0x5a, sizeof live_memory);
    CHECK(lmb_live_init(&live, 1, SIDE, 0, live_memory, sizeof live_memory) == LMB_OK);
    CHECK(lmb_shadow_map_init(&map, &light, &world.scene, SIZE, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    lmb_shadow_map_clear(&map);
    CHECK(lmb_shadow_map_draw(&map, picked_kernels(), &world.scene, 1, 2, NULL) == LMB_OK);
    CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, 0, &map, 0, 0, 0, SIZE / LMB_TILE) == LMB_OK);
    live.faces = 1;
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK);
    for (uint32_t i = 0; i < live.points; ++i) {
        const lmb_live_point *p = &live.sorted[i];
        CHECK(p->column < SIDE && p->row < SIDE && (p->wide == 1 || (p->column + 2 <= SIDE && p->row + 2 <= SIDE)));
        last += p->column == SIDE - 1 || p->row == SIDE - 1;
        flux += (double)p->flux[0];
    }
    for (int32_t i = 0; i < SIZE * SIZE; ++i) {
        float power[3];
        lmb_light_texel_power(power, &light, &map, 0, i % SIZE, i / SIZE);
        want += live_id(&live.face[0].id, i % SIZE, i / SIZE) != 0 ? 0.6 * (double)power[0] : 0.0;
    }
    CHECK_MSG(last > SIDE && want > 0.0 && fabs(flux / want - 1.0) < 0.02, "%u at the edges, %g W of %g",
              (unsigned)last, flux, want);
}

/* Blocks that show a post and the floor far behind it give a point for each surface. Each has the light of the texels
 * that show the surface, so floor beside the post gets the post's light, whichever texels hashes select. */
static void surfaces_of_blocks(void)
{
    const lmb_light light = spot(vec3(0, 0.5f, 20), vec3(0, -0.01f, -1), 4, 5);
    static uint16_t shows[MAP / 4][MAP / 4];
    uint32_t divided = 0, mixed = 0;
    double flux = 0.0, want = 0.0, got = 0.0;
    world_begin(0.6f, 0.6f, 0.6f);
    world_quad(vec3(0, 0, 0), mul3(X, 9), mul3(Z, 9));
    world_quad(vec3(0, 0, -9), mul3(X, 9), mul3(Y, 9));
    for (int i = 0; i < 5; ++i) { /* 2 cm wide; a texel is 1.4 cm there, a block 5.5 */
        world_quad(vec3(-0.8f + 0.41f * (float)i, 0.5f, 0), mul3(X, 0.01f), mul3(Y, 0.5f));
    }
    light_world(&light, 1);
    memset(shows, 0, sizeof shows);
    for (uint32_t i = 0; i < live.points; ++i) {
        const lmb_live_point *p = &live.sorted[i];
        uint32_t others = 0; /* texels of the point that show another quad */
        for (int k = 0; k < 16; ++k) {
            const uint32_t id = live_id(&live.face[0].id, 4 * p->column + k % 4, 4 * p->row + k / 4);
            others += p->wide == 1 && (p->shows >> k & 1u) && (id - 1) / 2 != (p->id - 1) / 2;
        }
        mixed += others;
        CHECK((shows[p->row][p->column] & p->shows) == 0);
        divided += shows[p->row][p->column] != 0;
        shows[p->row][p->column] |= p->shows;
        flux += (double)p->flux[0];
    }
    const double sent = 0.6 * (double)light.intensity[0] * 2.0 * PI * (1.0 - cos(5.0 * PI / 180.0));
    CHECK_MSG(divided > 100, "%u further surfaces", (unsigned)divided);
    CHECK_MSG(mixed < 10, "%u texels belong to the point of another surface", (unsigned)mixed);
    CHECK_MSG(flux > 0.7 * sent && flux < sent, "%g W of %g", flux, sent);
    for (int i = 0; i < 5; ++i) {
        for (int k = 0; k < 10; ++k) {
            const lmb_vec3 at = vec3(-0.8f + 0.41f * (float)i, 0, 0.1f + 0.01f * (float)k);
            const lmb_live_receiver r = {at, Y, Y, 1, 1e-6f, vec3(0, 1, 0), 0.0f};
            const double area = 0.02 * 1.0;
            float out[3];
            receive(out, picked_kernels(), &r, 0);
            got += (double)out[0];
            for (int n = 0; n < 1000; ++n) { /* strips of the post */
                const double y = (n + 0.5) / 1000.0, z = (double)at.z, d2 = y * y + z * z;
                want += (double)light.intensity[0] / 400.0 * 0.6 / PI * area / 1000.0 * (y / sqrt(d2)) *
                        (z / sqrt(d2)) / d2;
            }
        }
    }
    CHECK_MSG(got / want > 0.75 && got / want < 1.1, "floor beside the posts has %.3f of the light", got / want);
}

/* Small triangles in front of nothing have more surfaces than there is room for: the light stays that of the texels
 * that show them. */
static void crowded_blocks_keep_their_light(void)
{
    const lmb_light light = spot(vec3(0, 0, 4), vec3(0, 0, -1), 34, 35);
    test_rng r = {3};
    double want = 0.0, flux = 0.0;
    uint32_t whole = 0;
    world_begin(0.6f, 0.6f, 0.6f);
    for (int i = 0; i < 2000; ++i) { /* in a quarter of the picture */
        const lmb_vec3 at = vec3(test_uniform(&r, -0.6f, 0.6f), test_uniform(&r, -0.6f, 0.6f), test_uniform(&r, -0.5f, 0.5f));
        world_triangle(at, add3(at, vec3(0.05f, 0.02f, 0)), add3(at, vec3(0.01f, 0.06f, 0)));
    }
    light_world(&light, 1);
    for (uint32_t i = 0; i < live.points; ++i) {
        flux += (double)live.sorted[i].flux[0];
        whole += live.sorted[i].shows != 0xffffu && count_bits_16(live.sorted[i].shows) > 4;
    }
    for (int32_t i = 0; i < MAP * MAP; ++i) {
        float power[3];
        lmb_light_texel_power(power, &light, &map, 0, i % MAP, i / MAP);
        want += live_id(&live.face[0].id, i % MAP, i / MAP) != 0 ? 0.6 * (double)power[0] : 0.0;
    }
    CHECK_MSG(whole > 50, "%u blocks without room", (unsigned)whole);
    CHECK_MSG(fabs(flux / want - 1.0) < 0.02, "%g W of %g", flux, want);
}

/* Many faces of a few blocks each: no first point is lost while they are sorted. */
static void many_small_faces(void)
{
    const uint32_t faces = 700;
    static uint64_t memory[700 * 1024 + (1 << 16)];
    lmb_live l;
    float sum = 0.0f;
    room_with_table();
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_live_bytes(faces, 2, 0) <= sizeof memory);
    CHECK(lmb_live_init(&l, faces, 2, 0, memory, sizeof memory) == LMB_OK);
    memset(l.point, 0, live_slots(faces, 2) * sizeof *l.point);
    for (uint32_t f = 0; f < faces; ++f) {
        l.face[f].size = 8;
        l.face[f].each = 4;
        for (uint32_t k = 0; k < 4; ++k) {
            lmb_live_point *p = &l.point[4 * f + k];
            p->position = vec3(0.001f * (float)f, 1.0f, 0.2f * (float)k);
            p->normal = vec3(0, 1, 0);
            p->flux[0] = p->flux[1] = p->flux[2] = 1.0f;
            p->area = 1e-4f;
            p->id = 1;
        }
    }
    l.faces = faces;
    CHECK(lmb_live_build(&l, &world.scene) == LMB_OK);
    for (uint32_t i = 0; i < l.points; ++i) {
        sum += l.sorted[i].flux[0];
    }
    CHECK_MSG(l.points == 4 * faces && sum == 4.0f * (float)faces, "%u points, %g W", (unsigned)l.points, (double)sum);
}

/* Parts that earlier points left in the scratch change no byte, and some are used. */
static void kept_parts(void)
{
    enum { COUNT = 200 };
    const lmb_light light = point_light(vec3(-0.6f, 1.6f, 0.2f));
    static lmb_live_receiver at[COUNT];
    static float alone[COUNT][3];
    test_rng r = {17};
    int wrong = 0, again = 0;
    room_with_table();
    light_world(&light, 1);
    for (int i = 0; i < COUNT; ++i) {
        at[i] = place_on(test_random(&r) % world.count, vec3(0, 1, 0), &r);
        receive(alone[i], picked_kernels(), &at[i], 1);
    }
    memset(&scratch, 0x3c, sizeof scratch);
    lmb_live_forget(&scratch);
    for (int i = 0; i < 20 * COUNT; ++i) {
        const uint32_t k = test_random(&r) % COUNT;
        float here[3];
        CHECK(lmb_live_receive_again(here, picked_kernels(), &scratch, &live, &bvh, &at[k]) == LMB_OK);
        wrong += memcmp(here, alone[k], sizeof here) != 0;
        for (int32_t c = 0; c < scratch.count; ++c) {
            const ptrdiff_t slot = scratch.chunk[c] >= scratch.near && scratch.chunk[c] < scratch.near + LMB_LIVE_KEPT
                                       ? scratch.chunk[c] - scratch.near
                                       : -1;
            again += slot >= 0;
        }
    }
    CHECK_MSG(wrong == 0 && again > 1000, "%d wrong, %d kept", wrong, again);
    CHECK(lmb_live_receive_again(alone[0], NULL, &scratch, &live, &bvh, &at[0]) == LMB_ERR_ARG);
}

/* If nearly all nodes count as near, the cut is full: such points are counted, and their light stays about right. */
static void full_cuts(void)
{
    const lmb_light lights[2] = {spot(vec3(0.6f, 1.8f, 0.5f), vec3(-0.5f, -1, -0.4f), 20, 35),
                                 point_light(vec3(-0.6f, 1.6f, 0.2f))};
    test_rng r = {29};
    room_with_table();
    light_world(lights, 2);
    live.split = 256.0f;
    scratch.full = 0;
    const errors sum = errors_of(10, vec3(-0.7f, 1.5f, -0.7f), 0, &r);
    CHECK_MSG(scratch.full > 5 && sum.rms < 0.02, "%u full, rms %.4f", (unsigned)scratch.full, sum.rms);
    scratch.full = 0;
}

/* Needles of three points in a line have no area, but after rounding to pixels they may cover some. They send no light
 * and do not disturb the rest. */
static void needles_without_area(void)
{
    const lmb_light light = spot(vec3(0, 2, 0), vec3(0, -1, 0), 34, 35);
    double flux[2] = {0.0, 0.0};
    for (int with = 0; with < 2; ++with) {
        test_rng r = {41};
        uint32_t shown = 0, needles = 0;
        world_begin(0.6f, 0.6f, 0.6f);
        world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
        for (int i = 0; i < 4000 && with; ++i) {
            const float x = (float)((int32_t)(test_random(&r) % 2048) - 1024) / 1024.0f,
                        z = (float)((int32_t)(test_random(&r) % 2048) - 1024) / 1024.0f;
            const lmb_vec3 at = vec3(x, 0.0078125f, z), step = vec3(0.0625f, 0, (float)(i % 64 - 32) / 512.0f);
            world_triangle(at, add3(at, mul3(step, 3)), add3(at, step));
        }
        light_world(&light, 1);
        live.split = 16.0f;
        for (uint32_t i = 0; i < live.points; ++i) {
            flux[with] += (double)live.sorted[i].flux[0];
            needles += live.sorted[i].id > 2;
        }
        for (int32_t i = 0; i < MAP * MAP; ++i) {
            shown += live_id(&live.face[0].id, i % MAP, i / MAP) > 2;
        }
        CHECK_MSG((shown > 20) == with && needles == 0, "%u texels, %u points", (unsigned)shown, (unsigned)needles);
        lmb_live_receiver at = {vec3(0, 0.1f, 0), X, X, 0, 1e-6f, vec3(1, 1, 0), 0.0f};
        float light_at[3];
        receive(light_at, picked_kernels(), &at, 1);
        CHECK(light_at[0] > 0.0f && light_at[0] < 1.0f);
    }
    CHECK_MSG(fabs(flux[1] / flux[0] - 1.0) < 0.02, "%g W of %g", flux[1], flux[0]);
}

/* Close above a wide floor, evenly lit from above: at any height a wall receives half of the floor's light, although
 * the points are far apart. */
static void near_field(void)
{
    const lmb_light light = sun(vec3(0, -1, 0));
    lmb_live_receiver at;
    float here[3];
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 4), mul3(X, 4));
    light_world(&light, 1);
    live.split = 16.0f;
    memset(&at, 0, sizeof at);
    at.face = at.normal = X;
    double sum = 0.0, worst = 0.0;
    for (int i = 0; i < 40; ++i) {
        at.position = vec3(0.013f * (float)(i % 7) - 0.05f, 0.02f + 0.004f * (float)i, 0.017f * (float)(i % 5));
        receive(here, picked_kernels(), &at, 1);
        const double y = (double)at.position.y, x = 4.0 - (double)at.position.x;
        const double truth = 0.5 * (1.0 - y / sqrt(x * x + y * y)); /* for a floor infinite along z */
        const double off = (double)here[0] / truth - 1.0;
        sum += off / 40.0;
        worst = fmax(worst, fabs(off));
    }
    CHECK_MSG(fabs(sum) < 0.02 && worst < 0.1, "%.4f more than the floor sends, at worst %.4f off", sum, worst);
}

static float height_of(int x, int z) { return 0.08f * sinf(0.9f * (float)x) * cosf(0.7f * (float)z); }

/* A bent sheet, lit from above: segments from the underside to the upper side cross it. */
static void under_a_sheet_is_dark(void)
{
    enum { CELLS = 24 };
    test_rng r = {3};
    const lmb_light light = sun(vec3(0.3f, -1, 0.2f));
    int lit = 0, over = 0;
    world_begin(0.7f, 0.7f, 0.7f);
    for (int i = 0; i < CELLS * CELLS; ++i) {
        const int x = i % CELLS, z = i / CELLS;
        const lmb_vec3 a = vec3(0.1f * (float)x, height_of(x, z), 0.1f * (float)z),
                       b = vec3(0.1f * (float)(x + 1), height_of(x + 1, z), 0.1f * (float)z),
                       c = vec3(0.1f * (float)(x + 1), height_of(x + 1, z + 1), 0.1f * (float)(z + 1)),
                       d = vec3(0.1f * (float)x, height_of(x, z + 1), 0.1f * (float)(z + 1));
        world_triangle(a, b, c);
        world_triangle(a, c, d);
    }
    light_world(&light, 1);
    for (int i = 0; i < 3000; ++i) {
        const uint32_t on = test_random(&r) % world.count;
        const float up = i % 10 == 0 ? 9.0f : -9.0f;
        lmb_live_receiver at = place_on(on, add3(corner(on, 0), vec3(0, up, 0)), &r);
        float light_here[3];
        at.noise = lmb_place_noise(at.position, 3.0f);
        receive(light_here, picked_kernels(), &at, 1);
        lit += up < 0.0f && light_here[0] > 0.0f;
        over += up > 0.0f && light_here[0] > 0.0f;
    }
    CHECK_MSG(lit == 0 && over > 100, "%d of its underside are lit; %d of its upper side", lit, over);
}

/* Behind a wall of 1 mm, and of no thickness, in a room with the other half lit. */
static void behind_a_thin_wall_is_dark(void)
{
    test_rng r = {4};
    const lmb_light light = point_light(vec3(0.5f, 1.2f, 0.1f));
    for (int thick = 0; thick < 2; ++thick) {
        int lit = 0, count = 0;
        world_begin(0.7f, 0.7f, 0.7f);
        world_quad(vec3(0, 1, 0), Y, Z);
        world_box(vec3(0, 1, 0), 1.0f);
        if (thick) {
            world_quad(vec3(-0.001f, 1, 0), Y, Z);
        }
        light_world(&light, 1);
        for (int i = 0; i < 4000; ++i) {
            const lmb_live_receiver at = place_on(test_random(&r) % world.count, vec3(-0.5f, 0.9f, 0.1f), &r);
            float here[3];
            if (at.position.x > (thick ? -0.0009f : 0.0f)) {
                continue;
            }
            receive(here, picked_kernels(), &at, 1);
            lit += here[0] > 0.0f;
            ++count;
        }
        CHECK_MSG(lit == 0 && count > 1000, "%d of %d behind the wall are lit", lit, count);
    }
}

/* By rounding, half of the places on a slanted sheet lie behind it. They count as on the viewer's side, so the sheet
 * does not block their light, whether or not it is named as their triangle. */
static void in_a_plane_is_lit(void)
{
    test_rng r = {5};
    const lmb_light light = point_light(vec3(0.3f, 1.7f, 0.2f));
    int differ = 0, lit = 0;
    world_begin(0.7f, 0.7f, 0.7f);
    world_quad(vec3(0.013f, 0.97f, 0.021f), vec3(0.31f, 0.17f, 0.07f), vec3(-0.11f, 0.13f, 0.33f));
    world_box(vec3(0, 1, 0), 1.0f);
    light_world(&light, 1);
    for (int i = 0; i < 2000; ++i) {
        lmb_live_receiver at = place_on(test_random(&r) % 2, vec3(0.1f, i % 2 == 0 ? 1.8f : 0.1f, 0.2f), &r);
        float named[3], unnamed[3];
        receive(named, picked_kernels(), &at, 1);
        at.id = 0;
        receive(unnamed, picked_kernels(), &at, 1);
        differ += memcmp(named, unnamed, sizeof named) != 0;
        lit += named[0] > 0.0f;
    }
    CHECK_MSG(differ == 0 && lit > 1000, "%d differ; %d are lit", differ, lit);
}

/* The number of back ends whose light differs from that of the first one. */
static int differing_backends(const lmb_live_receiver *at)
{
    float first[3], light[3];
    int differing = 0;
    receive(first, listed_kernels(0), at, 1);
    for (int32_t k = 1; listed_kernels(k) != NULL; ++k) {
        receive(light, listed_kernels(k), at, 1);
        differing += memcmp(light, first, sizeof first) != 0;
    }
    return differing;
}

/* On every backend, with every number of strata. */
static void same_bytes(void)
{
    const lmb_light lights[2] = {spot(vec3(0.6f, 1.8f, 0.5f), vec3(-0.5f, -1, -0.4f), 20, 35),
                                 point_light(vec3(-0.6f, 1.6f, 0.2f))};
    test_rng r = {11};
    int wrong = 0;
    room_with_table();
    world_sphere(vec3(0.4f, 0.3f, -0.4f), 0.25f, 12, 20);
    light_world(lights, 2);
    for (int i = 0; i < 600; ++i) {
        lmb_live_receiver at = place_on(test_random(&r) % world.count, vec3(-0.7f, 1.5f, -0.7f), &r);
        at.normal = i % 2 ? normalize3(add3(at.face, vec3(0.2f, 0.1f, -0.1f))) : at.face;
        live.strata = 1 + (int32_t)(test_random(&r) % LMB_LIVE_STRATA);
        wrong += differing_backends(&at);
    }
    CHECK_MSG(wrong == 0, "%d differ", wrong);
}

/* Found by search: receivers for which rounding puts one of the picks past the sum of all nodes. The pick gets the last
 * node, so the light is that of places close by. */
static void rounding_overshoots(void)
{
    const lmb_light lights[2] = {spot(vec3(0.6f, 1.8f, 0.5f), vec3(-0.5f, -1, -0.4f), 20, 35),
                                 point_light(vec3(-0.6f, 1.6f, 0.2f))};
    static const uint64_t found[2] = {15612772849295518238u, 11767705658089006050u};
    room_with_table();
    light_world(lights, 2);
    live.split = 1.0f;
    live.strata = LMB_LIVE_STRATA;
    for (int i = 0; i < 2; ++i) {
        test_rng r = {found[i]};
        lmb_live_receiver at = place_on(test_random(&r) % world.count, vec3(-0.7f, 1.5f, -0.7f), &r);
        float here[3], beside[3];
        at.normal = normalize3(add3(at.face, vec3(0.2f, 0.1f, -0.1f)));
        CHECK(differing_backends(&at) == 0);
        receive(here, picked_kernels(), &at, 1);
        at.position = add3(at.position, vec3(1e-6f, 1e-6f, 1e-6f));
        receive(beside, picked_kernels(), &at, 1);
        CHECK_MSG(here[0] > 0.0f && fabsf(here[0] / beside[0] - 1.0f) < 1e-3f, "%g, %g beside", (double)here[0],
                  (double)beside[0]);
    }
}

/* --- steady light ------------------------------------------------------------------------------------------------- */

static void build_steady(void)
{
    live.steady = 1;
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK);
}

static void steady_light_is_right(void)
{
    test_rng r = {5};
    const lmb_light lights[1] = {point_light(vec3(-0.6f, 1.6f, 0.2f))};
    room_with_table();
    light_world(lights, 1);
    build_steady();
    live.split = 16.0f;
    const errors shadows = errors_of(tries(100, 150), vec3(-0.7f, 1.5f, -0.7f), 1, &r);
    CHECK_MSG(shadows.rms < 0.06 && fabs(shadows.bias) < 0.02, "rms %.4f, bias %.4f", shadows.rms, shadows.bias);
}

static void steady_bytes(void)
{
    const lmb_light lights[1] = {point_light(vec3(-0.6f, 1.6f, 0.2f))};
    test_rng r = {12};
    int wrong = 0;
    room_with_table();
    light_world(lights, 1);
    build_steady();
    for (int i = 0; i < 300; ++i) {
        const lmb_live_receiver at = place_on(test_random(&r) % world.count, vec3(-0.7f, 1.5f, -0.7f), &r);
        live.strata = 1 + (int32_t)(test_random(&r) % LMB_LIVE_STRATA);
        wrong += differing_backends(&at);
    }
    CHECK_MSG(wrong == 0, "%d differ", wrong);
}

enum { BENT = 400, BENDS = 8 };

/* Mean size of the second differences of the light at points, relative to it, as a light moves by small steps. */
static double bends_of(int is_steady)
{
    static float kept[BENDS][BENT];
    static lmb_live_receiver at[BENT];
    double bends = 0.0, all = 0.0;
    test_rng r = {13};
    for (int t = 0; t < BENDS; ++t) {
        const lmb_light lights[1] = {
            spot(vec3(0.6f + 0.001f * (float)t, 1.8f, 0.5f), vec3(-0.5f, -1, -0.4f), 20, 35)};
        room_with_table();
        light_world(lights, 1);
        live.strata = LMB_LIVE_STRATA / 2;
        if (is_steady) {
            build_steady();
        }
        for (int i = 0; i < BENT; ++i) {
            float light[3];
            at[i] = t == 0 ? far_place(vec3(-0.7f, 1.5f, -0.7f), &r) : at[i];
            receive(light, picked_kernels(), &at[i], 1);
            kept[t][i] = light[0];
        }
    }
    for (int i = 0; i < BENT * (BENDS - 2); ++i) {
        const int t = i / BENT + 1, k = i % BENT;
        bends += fabs((double)kept[t - 1][k] - 2.0 * (double)kept[t][k] + (double)kept[t + 1][k]);
        all += (double)kept[t][k];
    }
    CHECK(all > 0.0);
    return bends / all;
}

static void steady_light_bends_less(void)
{
    const double strata = bends_of(0), steady = bends_of(1);
    CHECK_MSG(steady < 0.75 * strata, "steady %.4f, strata %.4f", steady, strata);
}

#define KERNELS_OF_THIS(upper, lower) lmb_kernels_named(#lower),

/* Points of a map that are placed by lanes are those that lmb_live_place gives, and others stay. */
static void places_by_lanes(void)
{
    const lmb_kernels *const backends[] = {LMB_BACKENDS(KERNELS_OF_THIS)};
    test_rng r = {31};
    int wrong = 0, moved = 0;
    for (int n = 0; n < 400; ++n) {
        lmb_view view;
        lmb_live_surface on;
        lmb_live_spots spots, before;
        lmb_live_facet plane;
        memset(&plane, 0, sizeof plane);
        lmb_view_look_at(&view, vec3(0.1f, 2, 0.3f), vec3(0, 0, 0), Z, 1.0f, 64, 64);
        view.kind = n % 2 ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC;
        for (int i = 0; i < 2; ++i) {
            plane.side[i] = vec3(test_uniform(&r, -1, 1), test_uniform(&r, -0.2f, 0.2f), test_uniform(&r, -1, 1));
        }
        const lmb_vec3 across = cross3(plane.side[0], plane.side[1]);
        const float per = 1.0f / dot3(across, across);
        plane.normal = normalize3(across);
        plane.along[0] = mul3(cross3(plane.side[1], across), per);
        plane.along[1] = mul3(cross3(across, plane.side[0]), per);
        on.view = &view;
        on.corner = plane.corner;
        on.normal = plane.normal;
        memcpy(on.side, plane.side, sizeof on.side);
        memcpy(on.along, plane.along, sizeof on.along);
        for (size_t i = 0; i < sizeof spots / sizeof(float); ++i) {
            ((float *)(void *)&spots)[i] = test_uniform(&r, -0.5f, 0.5f);
        }
        before = spots;
        const uint32_t asked = test_random(&r) & 0xffffu;
        for (int k = 0; k < COUNT(backends); ++k) {
            spots = before;
            const uint32_t found = backends[k] != NULL ? backends[k]->live_places(&spots, &on, asked) : 0;
            for (int i = 0; i < LMB_LIVE_NODES && backends[k] != NULL; ++i) {
                lmb_vec3 at = vec3(before.place[0][i], before.place[1][i], before.place[2][i]);
                const int own = asked >> i & 1u;
                const int is = own && lmb_live_place(&at, &plane, &view, before.sx[i], before.sy[i]);
                wrong += (found >> i & 1u) != (uint32_t)is || at.x != spots.place[0][i] || at.y != spots.place[1][i] ||
                         at.z != spots.place[2][i] ||
                         spots.normal[1][i] != (own ? plane.normal.y : before.normal[1][i]);
                moved += is && k == COUNT(backends) - 1; /* plain C, which each build has */
            }
        }
    }
    CHECK_MSG(wrong == 0 && moved > 1000, "%d of %d differ", wrong, moved);
}

/* The rays that meet the boxes of a node, by boxes in lanes: those that meets_one finds one by one. */
static void boxes_by_lanes(void)
{
    const lmb_kernels *const backends[] = {LMB_BACKENDS(KERNELS_OF_THIS)};
    test_rng r = {37};
    int wrong = 0, met = 0;
    for (int n = 0; n < 300; ++n) {
        lmb_segments rays;
        lmb_boxes node;
        memset(&node, 0, sizeof node);
        rays.at = vec3(test_uniform(&r, -1, 1), test_uniform(&r, -1, 1), test_uniform(&r, -1, 1));
        for (int h = 0; h < 3; ++h) {
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                rays.per[h][k] = k % 7 == h ? (n % 2 ? 1e20f : -1e20f) : 1.0f / test_uniform(&r, -1, 1);
            }
            for (int i = 0; i < LMB_BOXES; ++i) {
                const float a = test_uniform(&r, -1, 1);
                node.low[h][i] = i < n % (LMB_BOXES + 1) ? a : 3e38f;
                node.high[h][i] = i < n % (LMB_BOXES + 1) ? a + test_uniform(&r, 0, 0.6f) : -3e38f;
            }
        }
        const uint64_t asked = (uint64_t)test_random(&r) << 32 | test_random(&r);
        for (int k = 0; k < COUNT(backends); ++k) {
            uint32_t out[2][LMB_BOXES];
            memset(out, 0, sizeof out);
            const uint32_t any = backends[k] != NULL ? backends[k]->live_boxes(out, &rays, asked, &node) : 0;
            for (int i = 0; i < LMB_BOXES && backends[k] != NULL; ++i) {
                uint64_t should = 0;
                for (int b = 0; b < LMB_TILE_PIXELS; ++b) {
                    lmb_segment s;
                    s.at = rays.at;
                    s.per = vec3(rays.per[0][b], rays.per[1][b], rays.per[2][b]);
                    for (int h = 0; h < 3; ++h) {
                        s.enter[h] = (rays.per[h][b] < 0.0f ? 3 + h : h) * LMB_BOXES;
                        s.leave[h] = (rays.per[h][b] < 0.0f ? h : 3 + h) * LMB_BOXES;
                    }
                    should |= (uint64_t)(backends[k]->meets_one(&s, &node) >> i & 1u) << b;
                }
                should &= asked;
                const uint64_t is = (uint64_t)out[1][i] << 32 | out[0][i];
                wrong += is != should || (any >> i & 1u) != (uint32_t)(should != 0);
                met += should != 0 && k == COUNT(backends) - 1;
            }
        }
    }
    CHECK_MSG(wrong == 0 && met > 200, "%d of %d differ", wrong, met);
}

/* --- light from infinity ------------------------------------------------------------------------------------------ */

enum { SUNS = 3000 };

static uint64_t stream_memory[SUNS * 100], sky_memory[1 << 14];
static lmb_light suns[SUNS];
static lmb_many_lights stream;
static lmb_live_sky sky;

/* Suns all around on a spiral, 1 W/(m2 sr) in all channels; those above are twice as green. `first`: one is as bright
 * as all others together. `kinds`: one is a point. */
static void make_suns(int first, int kinds)
{
    for (int i = 0; i < SUNS; ++i) {
        const double y = 1 - (2 * i + 1.0) / SUNS, out = sqrt(1 - y * y), turn = 2.399963229728653 * i;
        const float each = (float)(4 * PI / SUNS * (i == 500 && first ? SUNS : 1));
        memset(&suns[i], 0, sizeof suns[i]);
        suns[i].kind = i == 0 && kinds ? LMB_LIGHT_POINT : LMB_LIGHT_DIRECTIONAL;
        suns[i].direction = vec3((float)(-out * cos(turn)), (float)-y, (float)(-out * sin(turn)));
        suns[i].cos_inner = suns[i].cos_outer = 1.0f;
        suns[i].intensity[0] = suns[i].intensity[1] = suns[i].intensity[2] = each;
        suns[i].intensity[1] *= y > 0.8 ? 2.0f : 1.0f;
    }
    CHECK(lmb_many_lights_bytes(SUNS) <= sizeof stream_memory);
    CHECK(lmb_many_lights_init(&stream, SUNS, vec3(-1, -1, -1), vec3(1, 1, 1), 200, stream_memory,
                               sizeof stream_memory) == LMB_OK);
    CHECK(lmb_many_lights_add(&stream, suns, SUNS) == LMB_OK && lmb_many_lights_build(&stream) == LMB_OK);
}

/* The world under that sky. */
static void begin_sky(int first)
{
    make_suns(first, 0);
    memset(live_memory, 0x5a, sizeof live_memory);
    memset(sky_memory, 0x5a, sizeof sky_memory);
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_live_init(&live, 1, 1, 0, live_memory, sizeof live_memory) == LMB_OK);
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK && live.points == 0);
    CHECK(lmb_live_sky_bytes(SUNS) <= sizeof sky_memory);
    CHECK(lmb_live_sky_init(&sky, SUNS, sky_memory, sizeof sky_memory) == LMB_OK);
    CHECK(lmb_many_lights_sky(&sky, &stream, &world.scene) == LMB_OK);
    CHECK(sky.chunks > LMB_LIVE_SKY / 4 && sky.chunks <= LMB_LIVE_SKY);
    live.sky = &sky;
    CHECK(lmb_bvh_init(&bvh, world.count, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&bvh, &world.scene) == LMB_OK);
}

/* Light of all suns one by one. */
static double sum_of_suns(const lmb_live_receiver *at, int channel, int shadows)
{
    double sum = 0.0;
    for (int i = 0; i < SUNS; ++i) {
        const lmb_vec3 to = mul3(suns[i].direction, -1.0f);
        const double here = (double)dot3(to, at->normal);
        if (here > 0.0 && dot3(to, at->face) > 0.0f &&
            (!shadows || !is_hidden(at->position, add3(at->position, mul3(to, 100)), at->id, 0))) {
            sum += (double)suns[i].intensity[channel] * here;
        }
    }
    return sum;
}

/* Errors against all suns, with neighbours' turns averaged. */
static void sky_errors(const char *what, lmb_vec3 eye, int count, int shadows, double rms_bar, double bias_bar)
{
    test_rng r = {43};
    double rms = 0.0, bias = 0.0, mean = 0.0;
    for (int i = 0; i < count; ++i) {
        lmb_live_receiver at = place_on(test_random(&r) % world.count, eye, &r);
        double got = 0.0;
        at.normal = i % 2 ? normalize3(add3(at.face, vec3(0.3f, 0.1f, -0.2f))) : at.face;
        for (int k = 0; k < 9; ++k) {
            float light[3];
            at.turn = ((float)k + 0.5f) / 9.0f;
            receive(light, picked_kernels(), &at, shadows);
            got += (double)light[1] / 9.0;
        }
        const double want = sum_of_suns(&at, 1, shadows);
        rms += (got - want) * (got - want);
        bias += got - want;
        mean += want;
    }
    CHECK_MSG(sqrt(rms * count) < rms_bar * mean && fabs(bias) < bias_bar * mean && mean > 0.0,
              "%s: rms %.4f, bias %.4f of %.4f W/m2", what, sqrt(rms * count) / mean, bias / mean, mean / count);
}

/* A room with an opening of 2 x `half` in the ceiling, with a table. */
static void room_with_hole(float half)
{
    const float rest = 0.5f * (1 - half);
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, 0), mul3(Z, 1), mul3(X, 1));
    for (int i = 0; i < 2; ++i) {
        const float side = i ? -1.0f : 1.0f;
        world_quad(vec3(side, 1, 0), mul3(Y, 1), mul3(Z, 1));
        world_quad(vec3(0, 1, side), mul3(Y, 1), mul3(X, 1));
        world_quad(vec3(side * (half + rest), 2, 0), mul3(Z, 1), mul3(X, rest));
        world_quad(vec3(0, 2, side * (half + rest)), mul3(Z, rest), mul3(X, half));
    }
    world_quad(vec3(0.2f, 0.7f, 0.1f), mul3(Z, 0.4f), mul3(X, 0.5f));
}

static void under_a_sky(void)
{
    const lmb_vec3 eye = vec3(-0.7f, 1.5f, -0.7f);
    test_rng r = {47};
    int lit = 0;
    room_with_hole(0.7f);
    begin_sky(0);
    sky_errors("without shadows", eye, 300, 0, 0.004, 0.002);
    sky_errors("a large hole", eye, 120, 1, 0.04, 0.02);
    begin_sky(1);
    sky_errors("a bright sun, without shadows", eye, 300, 0, 0.004, 0.002);
    sky_errors("a bright sun", eye, 120, 1, 0.12, 0.03);
    room_with_hole(0.12f);
    begin_sky(0);
    sky_errors("a small hole", eye, 240, 1, 0.25, 0.06);
    room_with_table();
    begin_sky(1);
    for (int i = 0; i < 2000; ++i) {
        lmb_live_receiver at = place_on(test_random(&r) % world.count, eye, &r);
        float light[3];
        at.turn = test_uniform(&r, 0, 1);
        receive(light, picked_kernels(), &at, 1);
        lit += light[0] != 0.0f || light[1] != 0.0f || light[2] != 0.0f;
    }
    CHECK_MSG(lit == 0, "%d points of a closed room are lit", lit);
}

/* On every backend, with every number of strata and any turn. */
static void same_sky_bytes(void)
{
    const lmb_kernels *const scalar = lmb_kernels_named("scalar");
    test_rng r = {53};
    int wrong = 0, lit = 0;
    room_with_hole(0.5f);
    begin_sky(1);
    for (int i = 0; i < 400; ++i) {
        lmb_live_receiver at = place_on(test_random(&r) % world.count, vec3(-0.7f, 1.5f, -0.7f), &r);
        float plain[3];
        at.normal = i % 2 ? normalize3(add3(at.face, vec3(0.2f, 0.1f, -0.1f))) : at.face;
        at.turn = test_uniform(&r, -0.5f, 1.5f);
        sky.strata = 1 + (int32_t)(test_random(&r) % LMB_LIVE_STRATA);
        receive(plain, scalar, &at, 1);
        lit += plain[0] > 0.0f;
        wrong += differing_backends(&at);
    }
    CHECK_MSG(wrong == 0 && lit > 100, "%d differ; %d are lit", wrong, lit);
}

static void sky_refusals(void)
{
    const lmb_scene *scene = &world.scene;
    lmb_live_sky few, before;
    float light[3];
    lmb_live_receiver at;
    memset(&at, 0, sizeof at);
    CHECK(lmb_live_sky_bytes(0) == 0 && lmb_live_sky_bytes((1u << 22) + 1) == 0);
    CHECK(lmb_live_sky_init(NULL, 9, sky_memory, sizeof sky_memory) == LMB_ERR_ARG);
    CHECK(lmb_live_sky_init(&few, 0, sky_memory, sizeof sky_memory) == LMB_ERR_ARG);
    CHECK(lmb_live_sky_init(&few, 9, (uint8_t *)sky_memory + 1, sizeof sky_memory - 1) == LMB_ERR_ALIGN);
    CHECK(lmb_live_sky_init(&few, 9, sky_memory, lmb_live_sky_bytes(9) - 1) == LMB_ERR_CAPACITY);
    make_suns(0, 0);
    CHECK(lmb_live_sky_init(&few, stream.cell_count - 1, sky_memory, sizeof sky_memory) == LMB_OK);
    before = few;
    CHECK(lmb_many_lights_sky(&few, &stream, scene) == LMB_ERR_CAPACITY);
    CHECK(memcmp(&few, &before, sizeof few) == 0);
    CHECK(lmb_live_sky_init(&few, stream.cell_count, sky_memory, sizeof sky_memory) == LMB_OK);
    CHECK(lmb_many_lights_sky(&few, &stream, scene) == LMB_OK);
    few.strata = LMB_LIVE_STRATA + 1;
    live.sky = &few;
    CHECK(lmb_live_receive(light, picked_kernels(), &scratch, &live, NULL, &at) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_sky(NULL, &stream, scene) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_sky(&few, NULL, scene) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_sky(&few, &stream, NULL) == LMB_ERR_ARG);
    make_suns(0, 1);
    CHECK(lmb_many_lights_sky(&few, &stream, scene) == LMB_ERR_ARG); /* other lights too */
    CHECK(lmb_many_lights_init(&stream, 9, vec3(0, 0, 0), vec3(0, 0, 0), 1, stream_memory, sizeof stream_memory) ==
          LMB_OK);
    CHECK(lmb_many_lights_sky(&few, &stream, scene) == LMB_ERR_ARG); /* not built */
}

/* The most points that one leaf of the tree holds. */
static uint32_t points_of_leaf(void)
{
    uint32_t most = 0;
    for (uint32_t k = 0; k < live.chunks * LMB_LIVE_NODES; ++k) {
        const uint32_t count = live.chunk[k / LMB_LIVE_NODES].count[k % LMB_LIVE_NODES];
        const uint32_t points = (count & LMB_LIVE_LEAF) != 0 ? count & ~LMB_LIVE_LEAF : 0;
        most = points > most ? points : most;
    }
    return most;
}

/* A room on a ground of 4 km: all its first points lie in one cell of the world. */
static void in_a_wide_world(void)
{
    const lmb_vec3 eye = vec3(-0.7f, 1.5f, -0.7f);
    lmb_light lights[2] = {point_light(vec3(-0.6f, 1.6f, 0.2f)), sun(vec3(0.6f, -0.8f, 0))};
    test_rng r = {59};
    for (int c = 0; c < 3; ++c) {
        lights[1].intensity[c] = 1e-6f;
    }
    room_with_table();
    world_quad(vec3(0, -1, 0), mul3(Z, 2000), mul3(X, 2000));
    light_world(lights, 2);
    const uint32_t inside = world.count - 2;
    double off = 0.0, mean = 0.0;
    CHECK_MSG(points_of_leaf() <= LMB_LIVE_NODES, "%u points in a leaf", (unsigned)points_of_leaf());
    for (int i = 0; i < 200; ++i) {
        lmb_live_receiver at = place_on(test_random(&r) % inside, eye, &r);
        float light[3];
        if (!is_near(&at)) {
            receive(light, picked_kernels(), &at, 0);
            const double want = sum_of_all(&at, 0, 0);
            off += ((double)light[0] - want) * ((double)light[0] - want);
            mean += want;
        }
    }
    CHECK_MSG(sqrt(off * 200) < 0.02 * mean, "rms %.4f", sqrt(off * 200) / mean);
    live.chunk_cap = live.chunks / 2; /* no memory to sort in */
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK && live.chunks <= live.chunk_cap);
}

/* Too few chunks: coarser nodes, the same light. */
static void few_chunks(void)
{
    test_rng r = {21};
    const lmb_light light = point_light(vec3(-0.6f, 1.6f, 0.2f));
    room_with_table();
    light_world(&light, 1);
    const uint32_t used = live.chunks;
    live.chunk_cap = used / 2;
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK);
    CHECK(live.merged > 0 && live.chunks <= used / 2);
    const errors sum = errors_of(100, vec3(-0.7f, 1.5f, -0.7f), 0, &r);
    CHECK_MSG(sum.rms < 0.05, "rms %.4f", sum.rms);
    live.chunk_cap = 3;
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK);
    CHECK(live.chunks <= 3);
}

/* Points below a node; points that are counted several times. */
static uint32_t points_below(const lmb_live *l, uint32_t first, uint32_t count)
{
    uint32_t sum = 0;
    for (uint32_t k = first; k < first + count; ++k) {
        const lmb_live_chunk *c = &l->chunk[k / LMB_LIVE_NODES];
        const uint32_t own = c->count[k % LMB_LIVE_NODES], from = c->first[k % LMB_LIVE_NODES];
        sum += (own & LMB_LIVE_LEAF) != 0 ? own & ~LMB_LIVE_LEAF : points_below(l, from, own);
    }
    return sum;
}

/* A cell with four planes in each finer cell: the last part of a node takes the rest. */
static void many_planes(void)
{
    const float cell = 1.0f / 64.0f, along[4] = {0.1f, 0.35f, 0.6f, 0.85f};
    lmb_scene scene = world.scene;
    lmb_live l;
    scene.bounds_min = vec3(0, 0, 0);
    scene.bounds_max = vec3(1, 1, 1);
    memset(live_memory, 0, sizeof live_memory);
    CHECK(lmb_live_init(&l, 1, 64, 0, live_memory, sizeof live_memory) == LMB_OK);
    l.face[0].size = 256;
    l.face[0].each = 4;
    l.faces = 1;
    for (int cells = 1; cells <= 32; ++cells) {
        memset(l.point, 0, 64 * 64 * sizeof *l.point);
        for (int i = 0; i < 4 * cells + 1; ++i) {
            lmb_live_point *p = &l.point[i];
            const int n = i / 4;
            const float x = (float)(n & 1), y = (float)(n >> 1 & 3), z = (float)(n >> 3), off = along[i % 4];
            p->position = vec3((x + off) * cell, (y + (off > 0.8f ? 0.05f : 0.7f)) * cell, (z + 0.05f) * cell);
            p->normal = vec3(1, 0, 0);
            p->flux[0] = p->flux[1] = p->flux[2] = 1.0f;
            p->area = 0.25f * (0.22f * cell / 0.375f) * (0.22f * cell / 0.375f);
            p->id = 1;
        }
        l.point[4 * cells].position = vec3(0.99f, 0.99f, 0.99f); /* so that cells keep their size */
        CHECK(lmb_live_build(&l, &scene) == LMB_OK);
        CHECK_MSG(points_below(&l, 0, l.top) == l.points && l.points == 4 * (uint32_t)cells + 1, "%d cells: %u of %u",
                  cells, (unsigned)points_below(&l, 0, l.top), (unsigned)l.points);
    }
}

/* The parts of a block are consecutive, and the last one ends within lmb_live_bytes. */
static void parts_fit(void)
{
    static const int32_t sides[] = {1, 7, 64};
    for (int i = 0; i < 3 * COUNT(sides) * 2; ++i) {
        lmb_live l;
        const uint32_t faces = 1u << (2 * (i % 3)), elements = i / 9 ? 100 : 0;
        const int32_t side = sides[i / 3 % 3];
        const size_t bytes = lmb_live_bytes(faces, side, elements);
        CHECK(bytes <= sizeof live_memory && lmb_live_init(&l, faces, side, elements, live_memory, bytes) == LMB_OK);
        const uint8_t *const end = (const uint8_t *)(l.sorted + (l.sorted - l.point));
        CHECK((void *)l.face == (void *)live_memory && (void *)l.chunk >= (void *)(l.face + faces));
        CHECK((void *)l.point >= (void *)(l.chunk + l.chunk_cap) && l.chunk_cap > 0);
        CHECK(l.sorted - l.point >= (ptrdiff_t)faces * side * side + (ptrdiff_t)elements);
        CHECK(end <= (const uint8_t *)live_memory + bytes);
    }
}

static void refused(void)
{
    const lmb_light light = point_light(vec3(-0.6f, 1.6f, 0.2f));
    lmb_live none;
    lmb_live_receiver at;
    float out[3] = {1, 1, 1};
    memset(&none, 0, sizeof none);
    memset(&at, 0, sizeof at);
    CHECK(lmb_live_side(1, 1024) == 256 && lmb_live_side(6, 512) == 128 && lmb_live_side(6, 4096) == 512);
    CHECK(lmb_live_side(1, 0) == 0 && lmb_live_side(1, 12) == 0 && lmb_live_side(1, 16384) == 0);
    CHECK(lmb_live_bytes(0, 64, 0) == 0 && lmb_live_bytes(1, 0, 0) == 0 && lmb_live_bytes(100000, 64, 0) == 0 &&
          lmb_live_bytes(1, 64, (1u << 24) + 1) == 0);
    const size_t bytes = lmb_live_bytes(1, 64, 0);
    CHECK(lmb_live_init(&none, 1, 64, 0, live_memory, bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_live_init(&none, 1, 64, 0, (uint8_t *)live_memory + 4, bytes) == LMB_ERR_ALIGN);
    CHECK(lmb_live_init(NULL, 1, 64, 0, live_memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_live_receive(out, picked_kernels(), &scratch, &none, NULL, &at) == LMB_ERR_ARG);
    CHECK(lmb_live_build(&none, &world.scene) == LMB_ERR_ARG);
    room_with_table();
    light_world(&light, 1);
    CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, 1, &map, 0, 0, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, 0, &map, 6, 0, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, 0, &map, 0, FACES, 0, 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_live_collect(&live, picked_kernels(), &tile, &world.scene, 0, &map, 0, 0, 0, 99) == LMB_ERR_ARG);
    live.faces = 0;
    CHECK(lmb_live_build(&live, &world.scene) == LMB_OK && live.points == 0);
    CHECK(lmb_live_receive(out, picked_kernels(), &scratch, &live, &bvh, &at) == LMB_OK && out[0] == 0.0f);
}

void test_live(void)
{
    sums_and_shares();
    area_counts_once();
    alike_blocks_are_joined();
    points_of_layouts();
    odd_blocks();
    surfaces_of_blocks();
    crowded_blocks_keep_their_light();
    many_small_faces();
    kept_parts();
    near_field();
    full_cuts();
    rounding_overshoots();
    needles_without_area();
    under_a_sheet_is_dark();
    behind_a_thin_wall_is_dark();
    in_a_plane_is_lit();
    same_bytes();
    steady_light_is_right();
    steady_bytes();
    steady_light_bends_less();
    places_by_lanes();
    boxes_by_lanes();
    under_a_sky();
    same_sky_bytes();
    sky_refusals();
    in_a_wide_world();
    few_chunks();
    many_planes();
    parts_fit();
    refused();
}
