/* test_gouraud.c: light at corners: coverage, the shadow map, shown pixels, division into pieces, refused input. */
#include "../world.h"

#include <stdlib.h>

#include "../../src/base/codec.h"
#include "../../src/direct/part.h"
#include "../../src/vertex/gouraud_fill.h"
#include "../../src/vertex/gouraud_light.h"
#include "../small_transfer.h"

void test_gouraud(void);

#if LMB_TRANSFER

enum { SIDE = 64, MAP = 64, WORDS = SMALL_TRANSFER_WORDS(ROOM_TRIANGLES) };

static small_room room;
static uint32_t file[WORDS], light_memory[1536], map_memory[6 * MAP * MAP * 2], other_memory[6 * MAP * MAP * 2];
static uint32_t picture[SIDE * SIDE / 2], before[SIDE * SIDE / 2];
static uint16_t depth[SIDE * SIDE];
static float direct[SMALL_RECEIVERS][3];
static lmb_gouraud_scratch scratch;
static lmb_transfer transfer;
static lmb_transfer_light light;
static lmb_shadow_map map;

static const uint16_t *pixels(void) { return (const uint16_t *)picture; }

/* --- coverage ----------------------------------------------------------------------------------------------------- */

static float id_depth[SIDE * SIDE];
static uint32_t ids[SIDE * SIDE];

static gouraud_target id_target(void)
{
    gouraud_target t;
    memset(&t, 0, sizeof t);
    t.depth = id_depth;
    t.id = ids;
    t.id_format = LMB_ID32;
    t.width = t.height = t.step = SIDE;
    return t;
}

/* Counts how often triangles around a point cover each pixel of their square. */
static void cover(uint8_t times[SIDE * SIDE], const int32_t square[4][2], int32_t x, int32_t y, int how)
{
    const gouraud_target t = id_target();
    memset(times, 0, SIDE * SIDE);
    for (int i = 0; i < 4; ++i) {
        gouraud_corner c[3];
        memset(c, 0, sizeof c);
        c[0].x = x, c[0].y = y;
        c[1].x = square[i][0], c[1].y = square[i][1];
        c[2].x = square[(i + 1) % 4][0], c[2].y = square[(i + 1) % 4][1];
        c[0].d = c[1].d = c[2].d = 0.5f;
        memset(id_depth, 0, sizeof id_depth);
        lmb_gouraud_fill(&t, c, 1, how);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            times[k] = (uint8_t)(times[k] + (id_depth[k] > 0.0f));
        }
    }
}

/* Adjacent triangles share every pixel centre and leave none out, even if corners lie far outside. */
static void covers_once(void)
{
    static uint8_t times[SIDE * SIDE], grown[SIDE * SIDE];
    test_rng r = {5};
    for (int round = 0; round < 200; ++round) {
        const int32_t reach = round % 2 ? 900 : 0;
        const int32_t low_x = 100 - reach + (int32_t)(test_random(&r) % 100u), low_y = 90 - reach + (int32_t)(test_random(&r) % 100u),
                      high_x = 700 + reach + (int32_t)(test_random(&r) % 200u), high_y = 720 + reach + (int32_t)(test_random(&r) % 200u);
        const int32_t square[4][2] = {{low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}};
        const int32_t x = low_x + 1 + (int32_t)(test_random(&r) % (uint32_t)(high_x - low_x - 1)),
                      y = low_y + 1 + (int32_t)(test_random(&r) % (uint32_t)(high_y - low_y - 1));
        int wrong = 0, gaps = 0;
        cover(times, square, x, y, GOURAUD_MIXED);
        cover(grown, square, x, y, GOURAUD_GROWN);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            const int32_t px = 16 * (k % SIDE) + 8, py = 16 * (k / SIDE) + 8;
            const int is_in = px >= low_x && px < high_x && py >= low_y && py < high_y;
            wrong += times[k] != is_in;
            gaps += grown[k] < is_in;
        }
        CHECK_MSG(wrong == 0, "round %d: %d pixels are not covered once", round, wrong);
        CHECK_MSG(gaps == 0, "round %d: %d pixels are left out", round, gaps);
    }
}

/* --- depth -------------------------------------------------------------------------------------------------------- */

/* Depth at[0] plus at[1] from left to right and at[2] from top to bottom. */
static float plane_depth(const float at[3], int32_t x, int32_t y)
{
    return at[0] + (at[1] * (float)x + at[2] * (float)y) / (16.0f * SIDE);
}

/* In 16 bits: 4096 codes per power of two, from 2^-16 on; 1 has the last code. */
static int code_of_depth(float d)
{
    int power = 0;
    const float fraction = 2.0f * frexpf(d, &power) - 1.0f;
    return d >= 1.0f ? 65535 : (power + 15) * 4096 + (int)(4096.0f * fraction);
}

/* Fills the picture with one triangle. */
static void fill_all(const gouraud_target *t, const float at[3], int channel, int how)
{
    static const int32_t corner[3][2] = {{-800, -800}, {3200, -800}, {-800, 3200}};
    gouraud_corner c[3];
    memset(c, 0, sizeof c);
    for (int i = 0; i < 3; ++i) {
        c[i].x = corner[i][0], c[i].y = corner[i][1];
        c[i].d = plane_depth(at, c[i].x, c[i].y);
        c[i].colour[channel] = 255.0f;
    }
    lmb_gouraud_fill(t, c, 1, how);
}

/* Of two intersecting planes, the nearer one shows at each pixel in either drawing order, and the stored depth is
 * within two codes, even if the last pixel of a row is slightly over 1. Depth rows are shorter than pixel rows. */
static void shows_the_nearer(void)
{
    enum { WIDE = SIDE - 5 };
    static const float planes[][2][3] = {{{0.2f, 0.6f, 0.0f}, {0.5f, 0.0f, 0.0f}},
                                         {{0.1f, 0.3f, 0.5f}, {0.6f, -0.2f, 0.1f}},
                                         {{0.4f, 0.65642f, 0.0f}, {0.7f, 0.0f, 0.1f}},
                                         {{0.02f, -0.019f, 0.0f}, {0.001f, 0.0f, 0.02f}}};
    gouraud_target t;
    memset(&t, 0, sizeof t);
    t.pixel = (uint16_t *)picture;
    t.depth16 = depth;
    t.width = t.step = WIDE;
    t.height = t.pixel_step = SIDE;
    for (int i = 0; i < COUNT(planes) * 6; ++i) {
        const float(*plane)[3] = planes[i / 6];
        int wrong = 0, off = 0, red = 0;
        memset(depth, 0, sizeof depth);
        for (int k = 0; k < 2; ++k) {
            const int own = k ^ (i & 1);
            fill_all(&t, plane[own], own, i % 6 / 2); /* GOURAUD_MIXED, _FLAT, _GROWN */
        }
        for (int k = 0; k < WIDE * SIDE; ++k) {
            const int32_t x = k % WIDE, y = k / WIDE;
            const int a = code_of_depth(plane_depth(plane[0], 16 * x + 8, 16 * y + 8)),
                      b = code_of_depth(plane_depth(plane[1], 16 * x + 8, 16 * y + 8)), more = a > b ? a : b;
            const uint16_t shown = pixels()[SIDE * y + x];
            wrong += a > b + 2 ? shown != 0xf800u : b > a + 2 && shown != 0x07e0u;
            off += depth[k] > more + 2 || depth[k] + 2 < more;
            red += shown == 0xf800u;
        }
        CHECK_MSG(wrong == 0 && off == 0, "case %d: %d wrong, %d depths are off", i, wrong, off);
        CHECK_MSG(red > 100 && red < WIDE * SIDE - 100, "case %d: %d", i, red);
    }
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static lmb_gouraud frame_of(lmb_vec3 eye, lmb_vec3 target)
{
    lmb_gouraud g;
    memset(&g, 0, sizeof g);
    small_room_make(&room);
    CHECK(lmb_scene_check(&room.scene) == LMB_OK);
    CHECK(lmb_transfer_open(&transfer, file, small_transfer(file, &room.scene)) == LMB_OK);
    CHECK(lmb_transfer_light_init(&light, &transfer, light_memory, sizeof light_memory) == LMB_OK);
    CHECK(lmb_surface_init(&g.out, LMB_RGB565, SIDE, SIDE, picture, sizeof picture) == LMB_OK);
    CHECK(lmb_view_look_at(&g.view, eye, target, vec3(0, 0, 1), 0.8f, SIDE, SIDE) == LMB_OK);
    g.scene = &room.scene;
    g.transfer = &transfer;
    g.light = &light;
    g.direct = direct;
    g.scratch = &scratch;
    g.depth = depth;
    return g;
}

static void draw(const lmb_gouraud *g)
{
    CHECK(lmb_gouraud_begin(g) == LMB_OK);
    CHECK(lmb_gouraud_draw(g, 1, ROOM_TRIANGLES) == LMB_OK);
}

static int red_of(int k) { return pixels()[k] >> 11; }

/* The red of a surface with albedo 0.5 and this irradiance. */
static float red_by(float e) { return lmb_srgb_encode(e * 0.5f / 3.14159265f) * 31.0f / 255.0f; }

static int green_of(int k) { return pixels()[k] >> 5 & 63; }

/* Only the floor, from above. Even light gives even pixels; light that grows along x grows in the picture. */
static void shows_receivers(void)
{
    const lmb_gouraud g = frame_of(vec3(0, 0.9f, 0), vec3(0, 0, 0));
    const float e = 2.0f, code = lmb_srgb_encode(e * 0.5f / 3.14159265f);
    int off = 0, empty = 0;
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        light.receiver[i][0] = light.receiver[i][1] = light.receiver[i][2] = e;
    }
    draw(&g);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        empty += depth[k] == 0;
        off += fabsf((float)red_of(k) - code * 31.0f / 255.0f) > 1.0f ||
               fabsf((float)green_of(k) - code * 63.0f / 255.0f) > 1.0f;
    }
    CHECK_MSG(empty == 0 && off == 0, "%d empty, %d off", empty, off);
    /* Corners 0 and 1 are at x -1, 2 and 3 at x 1; 4 is between 0 and 1. The picture's right is -x. */
    const float at[SMALL_RECEIVERS] = {0.0f, 0.0f, 4.0f, 4.0f, 0.0f};
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        light.receiver[i][0] = light.receiver[i][1] = light.receiver[i][2] = at[i];
    }
    draw(&g);
    int falls = 0;
    for (int y = 0; y < SIDE; ++y) {
        for (int x = 4; x < SIDE; ++x) {
            falls += green_of(y * SIDE + x) < green_of(y * SIDE + x - 4) - 1;
        }
    }
    const int left = green_of(SIDE * SIDE / 2 + 2), right = green_of(SIDE * SIDE / 2 + SIDE - 3);
    CHECK_MSG((left > right ? left - right : right - left) > 10, "left %d, right %d", left, right);
    CHECK_MSG(left > right || falls == 0, "%d fall", falls);
}

/* Returns whether the ray through a pixel's centre meets the front of the floor beyond the near plane. `slack` is added
 * to the floor's half sides. */
static int meets_floor(const lmb_view *v, int k, float slack)
{
    const float x = ((float)(k % SIDE) + 0.5f) * (2.0f / SIDE) - 1.0f,
                y = 1.0f - ((float)(k / SIDE) + 0.5f) * (2.0f / SIDE);
    const lmb_vec3 across = add3(mul3(v->right, x * v->half_width), mul3(v->up, y * v->half_height)),
                   ray = sub3(across, v->back);
    const float along = v->eye.y > 0.0f && ray.y < 0.0f ? v->eye.y / -ray.y : -1.0f;
    const lmb_vec3 at = add3(v->eye, mul3(ray, along));
    return along > v->near_m && maxf(absf(at.x), absf(at.z)) < 1.0f + slack;
}

/* A floor that extends behind the eye or far beyond the picture is visible from above exactly at the pixels with a ray
 * to it, and not from below. */
static void cuts_the_floor(void)
{
    test_rng r = {9};
    int seen = 0;
    for (int i = 0; i < 40; ++i) {
        const lmb_vec3 eye = vec3(test_uniform(&r, -0.9f, 0.9f), i % 4 == 3 ? -0.2f : test_uniform(&r, 0.05f, 0.4f),
                                  test_uniform(&r, -0.9f, 0.9f));
        const lmb_vec3 to = vec3(test_uniform(&r, -1, 1), test_uniform(&r, 0, 0.2f), test_uniform(&r, -1, 1));
        const lmb_gouraud g = frame_of(eye, to);
        int wrong = 0;
        CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 1, 2) == LMB_OK);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            wrong += depth[k] != 0 ? !meets_floor(&g.view, k, 0.05f) : meets_floor(&g.view, k, -0.05f);
            seen += depth[k] != 0;
        }
        CHECK_MSG(wrong == 0, "eye %d: %d pixels", i, wrong);
    }
    CHECK(seen > 10 * SIDE * SIDE);
}

/* Views without perspective: a floor that extends far beyond the picture fills it from above, and shows nothing from
 * below. */
static void cuts_without_perspective(void)
{
    for (int below = 0; below < 2; ++below) {
        lmb_gouraud g = frame_of(vec3(0.2f, below ? -0.5f : 0.5f, 0.1f), vec3(0.2f, 0, 0.1f));
        int shown = 0;
        g.view.kind = LMB_ORTHOGRAPHIC;
        g.view.half_width = g.view.half_height = 0.001f;
        g.view.near_m = 0.1f;
        g.view.far_m = 2.0f;
        CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 1, 2) == LMB_OK);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            shown += depth[k] != 0;
        }
        CHECK_MSG(shown == (below ? 0 : SIDE * SIDE), "below %d: %d pixels", below, shown);
    }
}

/* --- vertices ----------------------------------------------------------------------------------------------------- */

/* The room's mesh with vertices that triangles share: the floor's 0, 1, 2, 5, the ceiling's 6, 7, 8, 11. */
static int16_t vertex_normal[12][2];
static uint8_t vertex_colour[12][4];

static void share_vertices(void)
{
    static const uint32_t indices[12] = {0, 1, 2, 0, 2, 5, 6, 7, 8, 6, 8, 11};
    room.mesh.indices = indices;
    room.mesh.index_format = LMB_INDEX_U32;
}

/* All reflected light comes from cluster 0: red by the normal's x, green by -y. */
static void light_clusters(float red, float green)
{
    memset(light_memory, 0, sizeof light_memory);
    light.cluster[0][0] = red;
    light.cluster[0][4] = -green;
}

/* The ceiling has light by direction: vertices with a normal get its light, transformed like normals; without normals
 * the face counts. */
static void lights_by_normal(void)
{
    static const float across[3] = {1.0f, 2.0f, -1.0f};
    for (int i = 0; i < 6; ++i) {
        const lmb_gouraud g = frame_of(vec3(0, 0.1f, 0), vec3(0, 1, 0));
        const float x = across[i / 2];
        const lmb_vec3 n = i % 2 ? normalize3(vec3(0.6f / x, -0.8f, 0)) : vec3(0, -1, 0);
        int off = 0, empty = 0;
        share_vertices();
        for (int k = 0; k < 12; ++k) {
            lmb_octahedral_encode(vertex_normal[k], vec3(0.6f, -0.8f, 0));
        }
        room.mesh.normals = i % 2 ? vertex_normal[0] : NULL;
        room.instance.to_world.m[0] = x;
        /* all blends in full from cluster 0 */
        uint32_t *corner = file + (transfer.section[LMB_TRANSFER_CORNERS] - file) + 9;
        memset(corner, 0, 6 * sizeof *corner);
        light_clusters(x < 0.0f ? -3.0f : 3.0f, 1.5f);
        CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 3, 2) == LMB_OK);
        const float red = red_by(3.0f * absf(n.x)), green = red_by(1.5f * -n.y) * 63.0f / 31.0f;
        for (int k = 0; k < SIDE * SIDE; ++k) {
            empty += depth[k] == 0;
            off += fabsf((float)red_of(k) - red) > 1.0f || fabsf((float)green_of(k) - green) > 1.0f;
        }
        CHECK_MSG(empty == 0 && off == 0, "case %d: %d empty, %d off", i, empty, off);
    }
}

/* Triangles with vertex normals share a vertex's light, with the blend of the first one; without normals each triangle
 * has its own. */
static void shares_vertex_light(void)
{
    for (int smooth = 0; smooth < 2; ++smooth) {
        const lmb_gouraud g = frame_of(vec3(0, 0.1f, 0), vec3(0, 1, 0));
        uint32_t *corner = file + (transfer.section[LMB_TRANSFER_CORNERS] - file) + 9;
        share_vertices();
        for (int k = 0; k < 12; ++k) {
            lmb_octahedral_encode(vertex_normal[k], vec3(0, -1, 0));
        }
        room.mesh.normals = smooth ? vertex_normal[0] : NULL;
        light_clusters(0.0f, 2.0f);
        for (int i = 0; i < 2; ++i) {
            CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 3, 2) == LMB_OK);
            CHECK(i == 0 || (memcmp(before, picture, sizeof before) == 0) == smooth);
            memcpy(before, picture, sizeof before);
            CHECK(corner[4] == (uint32_t)(i == 0));
            corner[4] = 0; /* of the second triangle, at a vertex that both share */
        }
    }
}

/* A divided triangle interpolates the vertices' colours at the corners of its parts, here at the middle of vertices 0
 * and 1. */
static void divides_colours(void)
{
    static const uint8_t red[3] = {0, 255, 128};
    const lmb_gouraud g = frame_of(vec3(0, 3, 0), vec3(0, 0, 0));
    for (int k = 0; k < 12; ++k) {
        memset(vertex_colour[k], 255, sizeof vertex_colour[k]);
        vertex_colour[k][0] = red[k % 3];
    }
    room.mesh.colours = vertex_colour[0];
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        light.receiver[i][0] = light.receiver[i][1] = light.receiver[i][2] = 3.0f;
    }
    CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 1, 1) == LMB_OK);
    for (int i = 1; i < 16; ++i) { /* from the middle to vertex 2 */
        const float x = -1.0f + 0.125f * (float)i, z = 0.0625f * (float)i, half = 3.0f * tanf(0.4f);
        const int k = (int)((0.5f - 0.5f * z / half) * SIDE) * SIDE + (int)((0.5f - 0.5f * x / half) * SIDE);
        CHECK_MSG(fabsf((float)red_of(k) - red_by(3.0f * 128.0f / 255.0f)) < 2.0f, "%d: %d", i, red_of(k));
        CHECK_MSG(fabsf((float)green_of(k) - red_by(3.0f) * 63.0f / 31.0f) < 2.0f, "%d: %d", i, green_of(k));
    }
}

/* If light by direction and receivers have equal light, parts have equal colours, with direct light too. */
static void divides_directed(void)
{
    lmb_gouraud g = frame_of(vec3(0, 0.9f, 0), vec3(0, 0, 0));
    int differ = 0, grows = 0;
    room.light.kind = LMB_LIGHT_POINT;
    CHECK(lmb_shadow_map_init(&map, &room.light, &room.scene, MAP, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_gouraud_map(&map, &scratch, &room.scene) == LMB_OK);
    for (int i = 0; i < 3; ++i) {
        uint32_t *division = file + (transfer.section[LMB_TRANSFER_DIVISIONS] - file);
        memset(light_memory, 0, sizeof light_memory);
        for (int k = 0; k < SMALL_RECEIVERS; ++k) {
            light.receiver[k][0] = i == 0 ? 1.0f : 0.0f;
        }
        light.cluster[0][1] = light.cluster[1][1] = i == 1 ? 1.0f : 0.0f; /* red by the normal's y */
        division[4] = SMALL_LEAF(i == 1 ? 3 : 0);
        division[5] = SMALL_LEAF(i == 1 ? 4 : 1);
        g.maps = i < 2 ? &map : NULL;
        CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 1, 1) == LMB_OK);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            const int was = ((const uint16_t *)before)[k] >> 11;
            differ += i == 1 && (red_of(k) > was + 1 || red_of(k) < was - 1);
            grows += i == 2 && was > red_of(k) + 3;
        }
        memcpy(before, picture, sizeof before);
    }
    CHECK_MSG(differ == 0 && grows > SIDE * SIDE / 3, "%d differ, %d of the light", differ, grows);
}

/* --- maps --------------------------------------------------------------------------------------------------------- */

/* The ids match the rasterizer's, except for triangles that face away from the light. */
static void draws_maps(void)
{
    lmb_shadow_map other;
    int differ = 0, shown = 0;
    small_room_make(&room);
    CHECK(lmb_shadow_map_init(&map, &room.light, &room.scene, MAP, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_shadow_map_init(&other, &room.light, &room.scene, MAP, LMB_ID32, other_memory, sizeof other_memory) ==
          LMB_OK);
    CHECK(lmb_shadow_map_clear(&other) == LMB_OK);
    CHECK(lmb_shadow_map_draw(&other, picked_kernels(), &room.scene, 1, ROOM_TRIANGLES, NULL) == LMB_OK);
    for (int twice = 0; twice < 2; ++twice) {
        CHECK(lmb_gouraud_map(&map, &scratch, &room.scene) == LMB_OK);
    }
    const uint32_t *own = map.face[0].id.data, *tiled = other.face[0].id.data;
    for (int y = 0; y < MAP; ++y) {
        for (int x = 0; x < MAP; ++x) {
            const uint32_t id = tiled[(y / 8 * (MAP / 8) + x / 8) * 64 + y % 8 * 8 + x % 8];
            shown += id != 0;
            differ += id != own[y * MAP + x];
        }
    }
    CHECK_MSG(shown > MAP * MAP / 2 && differ <= MAP, "%d differ of %d", differ, shown);
    CHECK(lmb_gouraud_map(NULL, &scratch, &room.scene) == LMB_ERR_ARG);
    CHECK(lmb_gouraud_map(&map, &scratch, NULL) == LMB_ERR_ARG);
    CHECK(lmb_gouraud_map(&map, NULL, &room.scene) == LMB_ERR_ARG);
}

/* Direct light reaches corners inside the cone; a blocker above them removes it. */
static void casts_shadows(void)
{
    lmb_gouraud g = frame_of(vec3(0, 0.9f, 0), vec3(0, 0, 0));
    room.light.cos_outer = 0.3f;
    room.light.cos_inner = 0.35f;
    CHECK(lmb_shadow_map_init(&map, &room.light, &room.scene, MAP, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_gouraud_map(&map, &scratch, &room.scene) == LMB_OK);
    memset(light_memory, 0, sizeof light_memory);
    g.maps = &map;
    draw(&g);
    int lit = 0;
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        const lmb_vec3 at = i == 4 ? vec3(-1, 0, 0) : vec3(i < 2 ? -1.0f : 1.0f, 0, i == 1 || i == 2 ? 1.0f : -1.0f);
        const lmb_vec3 to = sub3(room.light.position, at);
        const float d2 = dot3(to, to), cosine = to.y / sqrtf(d2), spread = (cosine - 0.3f) / 0.05f,
                    t = clampf(spread, 0.0f, 1.0f), want = 2.0f / d2 * cosine * t * t * (3.0f - 2.0f * t);
        CHECK_MSG(fabsf(direct[i][0] - want) < 1e-3f, "%d: %g, not %g", i, (double)direct[i][0], (double)want);
        lit += direct[i][0] > 0.0f;
    }
    CHECK(lit > 0);
    /* The ceiling, moved below the light, hides all ids except triangle 3's. */
    for (int k = 0; k < 3; ++k) {
        room.corners[2][k][1] = room.corners[3][k][1] = 0.5f;
        room.corners[2][k][0] *= -1.0f, room.corners[3][k][0] *= -1.0f; /* facing up */
    }
    CHECK(lmb_gouraud_map(&map, &scratch, &room.scene) == LMB_OK);
    CHECK(lmb_gouraud_begin(&g) == LMB_OK && lmb_gouraud_draw(&g, 1, 2) == LMB_OK);
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        CHECK_MSG(direct[i][0] == 0.0f, "%d: %g", i, (double)direct[i][0]);
    }
}

/* A square around `middle` along two axes, with one light. */
static struct {
    float corner[4][3];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_light light;
    lmb_core core;
    lmb_scene scene;
} lone;

static lmb_gouraud square_under(lmb_vec3 middle, lmb_vec3 u, lmb_vec3 v)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    lmb_gouraud g;
    memset(&g, 0, sizeof g);
    for (int i = 0; i < 4; ++i) {
        const lmb_vec3 at = add3(middle, add3(mul3(u, i == 1 || i == 2 ? 1.0f : -1.0f), mul3(v, i < 2 ? -1.0f : 1.0f)));
        lone.corner[i][0] = at.x, lone.corner[i][1] = at.y, lone.corner[i][2] = at.z;
    }
    memset(&lone.mesh, 0, sizeof lone.mesh);
    memset(&lone.material, 0, sizeof lone.material);
    memset(&lone.instance, 0, sizeof lone.instance);
    memset(&lone.scene, 0, sizeof lone.scene);
    lone.mesh.positions = lone.corner;
    lone.mesh.indices = indices;
    lone.mesh.index_format = LMB_INDEX_U32;
    lone.mesh.vertex_count = 4;
    lone.mesh.triangle_count = 2;
    lone.material.flags = LMB_DOUBLE_SIDED;
    lone.material.alpha = 1.0f;
    lone.material.texture = -1;
    lone.instance.first_id = 1;
    lone.scene.core = lone.core;
    for (int i = 0; i < 4; ++i) {
        lone.instance.to_world.m[5 * i] = 1.0f;
    }
    lone.scene.meshes = &lone.mesh;
    lone.scene.materials = &lone.material;
    lone.scene.instances = &lone.instance;
    lone.scene.lights = &lone.light;
    lone.scene.mesh_count = lone.scene.material_count = lone.scene.instance_count = lone.scene.light_count = 1;
    lmb_scene_bounds(&lone.scene.bounds_min, &lone.scene.bounds_max, &lone.scene);
    CHECK(lmb_scene_check(&lone.scene) == LMB_OK);
    CHECK(lmb_shadow_map_init(&map, &lone.light, &lone.scene, MAP, LMB_ID32, map_memory, sizeof map_memory) ==
          LMB_OK);
    CHECK(lmb_gouraud_map(&map, &scratch, &lone.scene) == LMB_OK);
    g.scene = &lone.scene;
    g.maps = &map;
    return g;
}

static void light_alone(int32_t kind, lmb_vec3 direction)
{
    memset(&lone.light, 0, sizeof lone.light);
    lone.light.kind = kind;
    lone.light.direction = direction;
    lone.light.intensity[0] = 1.0f;
}

/* A point light in the centre: only the part behind the square is dark, on one of the six sides. */
static void shadows_by_face(void)
{
    light_alone(LMB_LIGHT_POINT, vec3(0, 0, 0));
    for (int side = 0; side < 6; ++side) {
        const lmb_vec3 axes[3] = {X, Y, Z};
        const float sign = side % 2 ? -1.0f : 1.0f;
        const lmb_gouraud g = square_under(mul3(axes[side / 2], 0.5f * sign), mul3(axes[(side / 2 + 1) % 3], 0.1f),
                                           mul3(axes[(side / 2 + 2) % 3], 0.1f));
        CHECK(map.faces == 6);
        for (int to = 0; to < 6; ++to) {
            const lmb_vec3 way = mul3(axes[to / 2], to % 2 ? -1.0f : 1.0f);
            float behind[3] = {0, 0, 0}, near[3] = {0, 0, 0};
            lmb_gouraud_direct(behind, &g, mul3(way, 0.9f), mul3(way, -1.0f), 0, 0);
            lmb_gouraud_direct(near, &g, mul3(way, 0.4f), mul3(way, -1.0f), 0, 0);
            CHECK_MSG(fabsf(behind[0] - (to == side ? 0.0f : 1.0f / 0.81f)) < 1e-5f, "square %d, face %d: %g", side, to,
                      (double)behind[0]);
            CHECK_MSG(fabsf(near[0] - 1.0f / 0.16f) < 1e-4f, "square %d, face %d: %g", side, to, (double)near[0]);
        }
    }
}

/* A sun's map with a face for the scene's core and one for all: a point behind the square is dark in either face, and
 * one beside it is lit. */
static void shadows_by_core(void)
{
    for (int wide = 0; wide < 2; ++wide) {
        light_alone(LMB_LIGHT_DIRECTIONAL, vec3(0, -1, 0));
        lone.core.low = lone.core.wide_low = vec3(-0.5f, -0.5f, -0.5f);
        lone.core.high = lone.core.wide_high = vec3(0.5f, 0.5f, 0.5f);
        lone.core.wide_low.x = -8.0f;
        lone.core.wide_high.x = 8.0f;
        lone.core.faces = 2;
        const float x = wide ? 6.0f : 0.0f;
        const lmb_gouraud g = square_under(vec3(x, 0, 0), mul3(X, 0.3f), mul3(Z, 0.3f));
        CHECK(map.faces == 2 && lmb_shadow_map_part(&map, vec3(x, -0.3f, 0)) == wide);
        for (int i = 0; i < 2; ++i) {
            float got[3] = {0, 0, 0};
            lmb_gouraud_direct(got, &g, vec3(x + 0.45f * (float)i, -0.3f, 0), Y, 0, 0);
            CHECK_MSG(got[0] == (float)i, "face %d, place %d: %g", wide, i, (double)got[0]);
        }
    }
    memset(&lone.core, 0, sizeof lone.core);
}

/* A light's range, as for pixels. */
static void ends_by_range(void)
{
    for (int kind = 0; kind < 2; ++kind) {
        light_alone(kind, vec3(0, -1, 0));
        lone.light.cos_inner = 0.9f;
        lone.light.cos_outer = 0.8f;
        lone.light.range = 2.0f;
        const lmb_gouraud g = square_under(vec3(0, -4, 0), mul3(X, 0.1f), mul3(Z, 0.1f));
        for (int i = 1; i <= 12; ++i) {
            const float d = 0.25f * (float)i, by4 = d * d * d * d / 16.0f;
            const float want = maxf(1.0f - by4, 0.0f) / (d * d);
            float got[3] = {0, 0, 0};
            lmb_gouraud_direct(got, &g, vec3(0, -d, 0), vec3(0, 1, 0), 0, 0);
            CHECK_MSG(want > 0.0f ? fabsf(got[0] - want) <= 1e-5f * want + 1e-6f : got[0] == 0.0f,
                      "kind %d, %g m: %g, not %g", kind, (double)d, (double)got[0], (double)want);
        }
    }
}

/* A slanted square is lit everywhere, and everything behind it is dark, with a point light and with a sun. */
static void lights_slopes(void)
{
    for (int i = 0; i < 24; ++i) {
        const lmb_vec3 sun = normalize3(vec3(0.3f * (float)(i % 3 - 1), -1.0f, 0.4f * (float)(i / 3 % 2) - 0.2f));
        const lmb_vec3 n = normalize3(vec3(0.5f - 0.2f * (float)(i % 4), 0.7f, i % 2 ? -0.4f : 0.3f));
        const lmb_vec3 u = normalize3(cross3(n, vec3(0, 0.1f, 1))), v = cross3(n, u);
        const lmb_vec3 middle = vec3(0.05f, -1.0f, -0.1f);
        light_alone(i < 12 ? LMB_LIGHT_POINT : LMB_LIGHT_DIRECTIONAL, sun);
        const lmb_gouraud g = square_under(middle, mul3(u, 0.9f), mul3(v, 0.9f));
        int dark = 0, bright = 0;
        for (int k = 0; k < 17 * 17; ++k) {
            const float a = 0.1f * (float)(k % 17 - 8), b = 0.1f * (float)(k / 17 - 8);
            const lmb_vec3 at = add3(middle, add3(mul3(u, a), mul3(v, b)));
            const lmb_vec3 way = i < 12 ? at : sun, under = add3(at, mul3(normalize3(way), 0.3f));
            float on[3] = {0, 0, 0}, behind[3] = {0, 0, 0};
            lmb_gouraud_direct(on, &g, at, n, 0, 0);
            lmb_gouraud_direct(behind, &g, under, n, 0, 0);
            dark += !(on[0] > 0.0f);
            bright += behind[0] > 0.0f;
        }
        CHECK_MSG(dark == 0 && bright == 0, "case %d: %d dark, %d bright", i, dark, bright);
    }
}

/* A mesh with 16-bit positions matches the one in binary32; a triangle with invalid vertices is dropped. */
static void reads_positions(void)
{
    static int16_t stored[8][4];
    static float given[8][3];
    static uint32_t indices[9] = {0, 2, 1, 0, 3, 2, 0xffffffffu, 63, 0xffffffffu};
    static uint32_t other[SIDE * SIDE];
    lmb_scene scene;
    lmb_mesh mesh;
    lmb_instance instance;
    small_room_make(&room);
    scene = room.scene;
    mesh = scene.meshes[0];
    instance = scene.instances[0];
    scene.meshes = &mesh;
    scene.instances = &instance;
    scene.mesh_count = scene.instance_count = 1;
    for (int i = 0; i < 4; ++i) {
        const int16_t x = (int16_t)(i == 1 || i == 2 ? 20000 : -12000), z = (int16_t)(i < 2 ? -9000 : 17000);
        stored[i][0] = x, stored[i][1] = 100, stored[i][2] = z;
        given[i][0] = (float)x * 5e-5f + 0.1f, given[i][1] = 0.01f, given[i][2] = (float)z * 5e-5f - 0.05f;
    }
    mesh.indices = indices;
    mesh.index_format = LMB_INDEX_U32;
    mesh.triangle_count = 3;
    mesh.vertex_count = 4;
    mesh.normals = NULL;
    mesh.colours = NULL;
    mesh.position_scale = vec3(5e-5f, 1e-4f, 5e-5f);
    mesh.position_offset = vec3(0.1f, 0, -0.05f);
    instance.first_id = 1;
    CHECK(lmb_shadow_map_init(&map, &room.light, &room.scene, MAP, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    mesh.position_format = LMB_POSITION_I16;
    mesh.positions = stored;
    CHECK(lmb_gouraud_map(&map, &scratch, &scene) == LMB_OK);
    memcpy(other, map.face[0].id.data, MAP * MAP * 4);
    mesh.position_format = LMB_POSITION_F32;
    mesh.positions = given;
    CHECK(lmb_gouraud_map(&map, &scratch, &scene) == LMB_OK);
    int shown = 0, differ = 0;
    for (int k = 0; k < MAP * MAP; ++k) {
        const uint32_t id = ((const uint32_t *)map.face[0].id.data)[k];
        shown += id != 0;
        differ += id != other[k];
        CHECK(id < 3);
    }
    CHECK_MSG(shown > 100 && differ == 0, "%d of %d differ", differ, shown);
}

static void in_pieces(void)
{
    const lmb_gouraud g = frame_of(vec3(0.4f, 0.5f, 2.0f), vec3(0, 0.5f, 0));
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        light.receiver[i][0] = (float)i;
    }
    draw(&g);
    memcpy(before, picture, sizeof before);
    CHECK(lmb_gouraud_begin(&g) == LMB_OK);
    for (uint32_t id = 1; id <= ROOM_TRIANGLES; ++id) {
        CHECK(lmb_gouraud_draw(&g, id, 1) == LMB_OK);
    }
    CHECK(memcmp(before, picture, sizeof before) == 0);
    CHECK(lmb_gouraud_draw(&g, 5, UINT32_MAX) == LMB_OK);
    CHECK(memcmp(before, picture, sizeof before) == 0);
}

#define REFUSED(change, status) \
    do { \
        lmb_gouraud g = whole; \
        change; \
        CHECK_MSG(lmb_gouraud_begin(&g) == (status), "%s", #change); \
    } while (0)

static void refuses(void)
{
    const lmb_gouraud whole = frame_of(vec3(0, 0.9f, 0), vec3(0, 0, 0));
    CHECK(lmb_gouraud_begin(&whole) == LMB_OK);
    REFUSED(g.scene = NULL, LMB_ERR_ARG);
    REFUSED(g.transfer = NULL, LMB_ERR_ARG);
    REFUSED(g.light = NULL, LMB_ERR_ARG);
    REFUSED(g.direct = NULL, LMB_ERR_ARG);
    REFUSED(g.scratch = NULL, LMB_ERR_ARG);
    REFUSED(g.depth = NULL, LMB_ERR_ARG);
    REFUSED(g.out.data = NULL, LMB_ERR_ARG);
    REFUSED(g.view.frame_width = SIDE - 1, LMB_ERR_ARG);
    REFUSED(g.out.format = LMB_RGB555, LMB_ERR_FORMAT);
    REFUSED(g.out.width = g.view.frame_width = 1024; g.out.stride_bytes = 2048, LMB_ERR_CAPACITY);
    CHECK(lmb_shadow_map_init(&map, &room.light, &room.scene, MAP, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    REFUSED(g.maps = &map, LMB_ERR_ARG); /* tiled */
    CHECK(lmb_gouraud_begin(NULL) == LMB_ERR_ARG && lmb_gouraud_draw(NULL, 1, 1) == LMB_ERR_ARG);
    CHECK(lmb_gouraud_draw(&whole, 0, 1) == LMB_ERR_ARG);
}

void test_gouraud(void)
{
    covers_once();
    shows_the_nearer();
    shows_receivers();
    cuts_the_floor();
    cuts_without_perspective();
    lights_by_normal();
    shares_vertex_light();
    divides_colours();
    divides_directed();
    draws_maps();
    casts_shadows();
    shadows_by_face();
    shadows_by_core();
    ends_by_range();
    lights_slopes();
    reads_positions();
    in_pieces();
    refuses();
}

#else

void test_gouraud(void) {}

#endif
