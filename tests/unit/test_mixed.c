/* test_mixed.c: points, planes, the mesh of the real scene, the folded environment, and the effect of an object.
 * M1-M24. */
#include <lambent/lambent.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/half.h"
#include "../../src/mixed/cloud.h"
#include "../test.h"

void test_mixed(void);

enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 80.0f, 80.0f, 47.5f, 35.5f};

typedef struct stage {
    float depth[PIXELS];
    lmb_cloud cloud;
    lmb_planes planes;
    lmb_real_mesh mesh;
    lmb_tile tile;
    uint32_t cloud_memory[PIXELS * 4], plane_memory[PIXELS * 5 / 4], mesh_memory[PIXELS / 16 * 24 + 64];
} stage;

/* --- points ------------------------------------------------------------------------------------------------------- */

static void test_points(stage *s)
{
    for (int i = 0; i < PIXELS; ++i) {
        s->depth[i] = 2.0f;
    }
    s->depth[0] = 0.0f;
    s->depth[1] = NAN;
    s->depth[2] = -1.0f;
    CHECK(lmb_cloud_init(&s->cloud, &camera, s->depth, s->cloud_memory, sizeof s->cloud_memory) == LMB_OK);
    const lmb_vec3 p = lmb_cloud_point(&s->cloud, 87, 35), none = lmb_cloud_point(&s->cloud, 1, 0);
    CHECK_MSG(fabsf(p.x - 2.0f * 39.5f / 80.0f) < 1e-6f && fabsf(p.y - 2.0f * 0.5f / 80.0f) < 1e-6f && p.z == -2.0f,
              "%g %g %g", (double)p.x, (double)p.y, (double)p.z);
    CHECK(none.x == 0.0f && none.y == 0.0f && none.z == 0.0f);
    CHECK(s->cloud.inverse[0] == 0.0f && s->cloud.inverse[1] == 0.0f && s->cloud.inverse[2] == 0.0f);
    lmb_cloud_normals(&s->cloud, 0, LMB_MAX_SIDE);
    CHECK(s->cloud.normal[PIXELS / 2].z > 0.99999f && s->cloud.normal[0].z == 0.0f);
}

/* A normal uses the pixels around it: the two or three nearest on each side for short focal lengths, every second of
 * four or six for long ones. The test moves one pixel after the other by 1 / 1000. */
static void test_reach(stage *s)
{
    static const struct {
        float fx;
        uint32_t sees; /* bits 1 .. 7: the pixel at this offset to the right counts */
    } pictures[] = {{80.0f, 0x06}, {290.0f, 0x0e}, {400.0f, 0x14}, {470.0f, 0x14}, {600.0f, 0x54}};
    enum { AT = 60 + 35 * WIDTH };
    for (int i = 0; i < (int)(sizeof pictures / sizeof *pictures); ++i) {
        uint32_t sees = 0;
        lmb_pinhole lens = camera;
        lmb_vec3 alike = {0, 0, 0};
        lens.fx = lens.fy = pictures[i].fx;
        for (int far = 0; far < 8; ++far) {
            for (int k = 0; k < PIXELS; ++k) {
                s->depth[k] = 2.0f + 0.002f * (float)(far > 0 && k == AT + far);
            }
            CHECK(lmb_cloud_init(&s->cloud, &lens, s->depth, s->cloud_memory, sizeof s->cloud_memory) == LMB_OK);
            CHECK(lmb_cloud_normals(&s->cloud, 0, LMB_MAX_SIDE) == LMB_OK);
            alike = far == 0 ? s->cloud.normal[AT] : alike;
            sees |= (uint32_t)(memcmp(&alike, &s->cloud.normal[AT], sizeof alike) != 0) << far;
        }
        CHECK_MSG(sees == pictures[i].sees, "%g px: %x", (double)lens.fx, sees);
    }
}

static void test_refusals(stage *s)
{
    lmb_pinhole bad = camera;
    CHECK(lmb_cloud_bytes(0, 5) == 0 && lmb_cloud_bytes(5, LMB_MAX_SIDE + 1) == 0);
    CHECK(lmb_cloud_init(&s->cloud, &camera, s->depth, s->cloud_memory, 16 * PIXELS - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_cloud_init(&s->cloud, &camera, NULL, s->cloud_memory, sizeof s->cloud_memory) == LMB_ERR_ARG);
    bad.fx = 0.0f;
    CHECK(lmb_cloud_init(&s->cloud, &bad, s->depth, s->cloud_memory, sizeof s->cloud_memory) == LMB_ERR_ARG);
    bad.fx = NAN;
    CHECK(lmb_cloud_init(&s->cloud, &bad, s->depth, s->cloud_memory, sizeof s->cloud_memory) == LMB_ERR_ARG);
    CHECK(lmb_planes_find(&s->planes, &s->cloud, s->plane_memory, 5 * PIXELS - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_real_mesh_bytes(WIDTH, HEIGHT, 0) == 0);
}

/* --- neighbours --------------------------------------------------------------------------------------------------- */

static float far2(lmb_vec3 a, lmb_vec3 b)
{
    const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

static void test_picture_neighbours(stage *s)
{
    int32_t found[NEAREST_CAP];
    for (int i = 0; i < PIXELS; ++i) {
        s->depth[i] = i % WIDTH > 50 ? 1.0f : 2.0f;
    }
    s->depth[10 * WIDTH + 9] = 0.0f;
    lmb_cloud_init(&s->cloud, &camera, s->depth, s->cloud_memory, sizeof s->cloud_memory);
    CHECK(lmb_cloud_nearest(found, 8, &s->cloud, 10, 10) == 8);
    for (int i = 0; i < 8; ++i) {
        CHECK(found[i] != 10 * WIDTH + 9);
    }
    CHECK(found[0] == 9 * WIDTH + 10 || found[0] == 10 * WIDTH + 11 || found[0] == 11 * WIDTH + 10);
    CHECK(lmb_cloud_nearest(found, 8, &s->cloud, 9, 10) == 0);
    CHECK(lmb_cloud_nearest(found, 4, &s->cloud, 50, 30) == 4);
    for (int i = 0; i < 4; ++i) { /* the metre between both exceeds any distance on the same side */
        CHECK(found[i] % WIDTH <= 50);
    }
    CHECK(lmb_cloud_nearest(found, 8, &s->cloud, 0, 0) == 8);
}

/* --- planes ------------------------------------------------------------------------------------------------------- */

/* A floor 0.5 m below the camera and a wall 2.5 m ahead, with noise in 1 / distance; one pixel in twenty is missing. */
static void draw_corner(stage *s, float noise)
{
    test_rng rng = {3};
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float floor = ray.y < -0.01f ? -0.5f / ray.y : 1e9f, z = floor < 2.5f ? floor : 2.5f;
        s->depth[i] = 1.0f / (1.0f / z + test_uniform(&rng, -noise, noise));
        s->depth[i] = test_random(&rng) % 20 == 0 ? 0.0f : s->depth[i];
    }
}

static int find_planes(stage *s)
{
    return lmb_cloud_init(&s->cloud, &camera, s->depth, s->cloud_memory, sizeof s->cloud_memory) == LMB_OK &&
           lmb_cloud_normals(&s->cloud, 0, LMB_MAX_SIDE) == LMB_OK &&
           lmb_planes_find(&s->planes, &s->cloud, s->plane_memory, sizeof s->plane_memory) == LMB_OK;
}

static void test_corner(stage *s)
{
    draw_corner(s, 0.004f);
    CHECK(find_planes(s) && s->planes.count == 2);
    const int32_t p = lmb_planes_floor(&s->planes);
    const lmb_flat *floor = &s->planes.plane[p], *wall = &s->planes.plane[1 - p];
    CHECK_MSG(floor->normal.y > 0.9998f && fabsf(floor->distance - 0.5f) < 0.005f, "%g %g", (double)floor->normal.y,
              (double)floor->distance);
    CHECK_MSG(wall->normal.z > 0.9999f && fabsf(wall->distance - 2.5f) < 0.01f, "%g %g", (double)wall->normal.z,
              (double)wall->distance);
    CHECK(fabsf(floor->centre.y + 0.5f) < 0.01f && floor->high[0] > 0.5f && floor->low[0] < -0.5f);
    int wrong = 0, holes = 0;
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const int label = 1 + (ray.y < -0.2f ? p : 1 - p);
        wrong += s->planes.label[i] != label;
        holes += s->depth[i] == 0.0f && s->planes.label[i] == 0;
    }
    CHECK_MSG(wrong < PIXELS / 50 && holes < 8, "%d wrong, %d holes", wrong, holes);
    lmb_planes_move(&s->cloud, &s->planes);
    const lmb_vec3 moved = lmb_cloud_point(&s->cloud, 48, 70);
    CHECK_MSG(fabsf(moved.y + 0.5f) < 0.005f, "%g", (double)moved.y);
    lmb_vec3 at;
    CHECK(lmb_planes_anchor(&at, &s->planes, &camera, p, 48.0f, 70.0f) && fabsf(at.y - moved.y) < 1e-5f);
    CHECK(!lmb_planes_anchor(&at, &s->planes, &camera, p, 48.0f, 0.0f)); /* above the horizon */
    CHECK(!lmb_planes_anchor(&at, &s->planes, &camera, 2, 48.0f, 70.0f));
}

/* The floor's centre if it is free, otherwise the nearest free place: beside an object on it, in front of one that
 * hides it, and with room up to the picture's edge. */
static void test_place(stage *s)
{
    lmb_vec3 at;
    draw_corner(s, 0.0f);
    find_planes(s);
    const int32_t p = lmb_planes_floor(&s->planes);
    const lmb_flat *floor = &s->planes.plane[p];
    const lmb_vec3 centre = floor->centre;
    CHECK(lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.2f, 0.0f) && far2(at, centre) == 0.0f);
    CHECK(!lmb_planes_clear(&at, &s->planes, &s->cloud, p, 9.0f, 0.0f));
    CHECK(!lmb_planes_clear(&at, &s->planes, &s->cloud, 2, 0.2f, 0.0f));
    CHECK(lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.2f, 0.6f) && far2(at, centre) == 0.0f);
    /* 80 px per metre at 1 m: 35 px above the axis are 0.44 m, and the floor is 0.5 m below the axis. */
    CHECK(!lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.1f, 2.0f));
    CHECK(lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.1f, 1.2f) && -at.z > 0.7f * 80.0f / 36.0f + 0.05f);
    /* An obstacle in front of the centre, a third of the way from the camera, hides an object behind it. */
    for (int i = 0; i < PIXELS; ++i) {
        if (abs(i % WIDTH - 48) < 5 && i / WIDTH < 46) {
            s->cloud.inverse[i] = 3.0f;
        }
    }
    CHECK(lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.1f, 0.6f) && fabsf(at.x) > 0.1f);
    CHECK(lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.1f, 0.0f) && far2(at, centre) == 0.0f);
    /* A strip through the plane's centre does not belong to the plane: the whole footprint is beside it. */
    for (int i = 0; i < PIXELS; ++i) {
        s->planes.label[i] = abs(i % WIDTH - 48) < 12 ? 0 : s->planes.label[i];
    }
    CHECK(lmb_planes_clear(&at, &s->planes, &s->cloud, p, 0.1f, 0.0f));
    CHECK_MSG((fabsf(at.x) - 0.1f) * 80.0f / -at.z > 11.0f, "%g %g", (double)at.x, (double)at.z);
}

/* A plane that faces the camera's up direction is a floor; if a ceiling is visible, leaning walls are not. */
static void test_up(void)
{
    static const float wall[3] = {0.0f, 0.45f, 0.89302855f}, down[3] = {0.0f, -0.89302855f, 0.45f};
    lmb_planes planes;
    memset(&planes, 0, sizeof planes);
    CHECK(lmb_planes_up(&planes).y == 1.0f && lmb_planes_floor(&planes) == -1);
    planes.count = 1;
    planes.plane[0].pixels = 5000;
    planes.plane[0].normal = (lmb_vec3){wall[0], wall[1], wall[2]};
    CHECK(lmb_planes_floor(&planes) == 0 && lmb_planes_up(&planes).y == wall[1]);
    planes.count = 2;
    planes.plane[1].pixels = 1000;
    planes.plane[1].normal = (lmb_vec3){down[0], down[1], down[2]};
    CHECK(lmb_planes_floor(&planes) == -1 && lmb_planes_up(&planes).y == -down[1]);
    planes.count = 3;
    planes.plane[2].pixels = 40;
    planes.plane[2].normal = (lmb_vec3){-down[0], -down[1], -down[2]};
    CHECK(lmb_planes_floor(&planes) == 2);
    planes.plane[2].normal = (lmb_vec3){0, 0, 1};
    CHECK(lmb_planes_floor(&planes) == -1);
}

/* A camera rolled by 20 degrees sees two walls of a room: up is along both, even with a small sloping plane. One wall
 * does not determine it. */
static void test_up_by_walls(void)
{
    const float s = 0.34202014f, c = 0.93969262f;
    lmb_planes planes;
    memset(&planes, 0, sizeof planes);
    planes.count = 1;
    planes.plane[0].pixels = 5000;
    planes.plane[0].normal = (lmb_vec3){0.8f * c, 0.8f * s, 0.6f}; /* 0.27 up: it leans only by the camera's roll */
    CHECK(lmb_planes_up(&planes).y == 1.0f);
    planes.count = 3;
    planes.plane[1].pixels = 3000;
    planes.plane[1].normal = (lmb_vec3){-0.6f * c, -0.6f * s, 0.8f};
    planes.plane[2].pixels = 200;
    planes.plane[2].normal = (lmb_vec3){0.0f, 0.8f, 0.6f};
    const lmb_vec3 up = lmb_planes_up(&planes);
    CHECK_MSG(fabsf(up.x + s) < 1e-5f && fabsf(up.y - c) < 1e-5f && fabsf(up.z) < 1e-5f, "%g %g %g", (double)up.x,
              (double)up.y, (double)up.z);
    CHECK(lmb_planes_floor(&planes) == -1);
}

/* --- which way is up, in random rooms ----------------------------------------------------------------------------- */

static lmb_vec3 turned(lmb_vec3 v, float x, float z)
{
    const lmb_vec3 p = {v.x, v.y * cosf(x) - v.z * sinf(x), v.y * sinf(x) + v.z * cosf(x)};
    return (lmb_vec3){p.x * cosf(z) - p.y * sinf(z), p.x * sinf(z) + p.y * cosf(z), p.z};
}

/* Adds a plane of e^low to e^high pixels, with a normal error of about `noise`. */
static void put_plane(lmb_planes *planes, lmb_vec3 n, float low, float high, float noise, test_rng *rng)
{
    lmb_flat *p = &planes->plane[planes->count++];
    float off[3];
    for (int i = 0; i < 3; ++i) {
        off[i] = noise * (test_uniform(rng, -1, 1) + test_uniform(rng, -1, 1) + test_uniform(rng, -1, 1));
    }
    n = (lmb_vec3){n.x + off[0], n.y + off[1], n.z + off[2]};
    const float length = sqrtf(n.x * n.x + n.y * n.y + n.z * n.z);
    p->normal = (lmb_vec3){n.x / length, n.y / length, n.z / length};
    p->pixels = (int32_t)expf(test_uniform(rng, low, high));
}

/* A room with floor, ceiling, table, walls, and sloping planes; returns its up direction. Odd rooms have corners of any
 * angle, more slopes, and cameras rolled by up to 40 degrees. */
static lmb_vec3 put_room(lmb_planes *planes, int is_odd, test_rng *rng)
{
    const lmb_vec3 up = {0, 1, 0}, down = {0, -1, 0};
    const float yaw = test_uniform(rng, 0, 6.2831853f), corner = is_odd ? test_uniform(rng, 1.05f, 2.09f) : 1.5707963f,
                noise = test_uniform(rng, 0.005f, is_odd ? 0.07f : 0.044f);
    planes->count = 0;
    for (int i = 1 + (int)test_uniform(rng, 0, 3); i > 0; --i) {
        const float at = yaw + (i % 2 != 0 ? corner : i == 2 ? 0.0f : 3.1415927f);
        put_plane(planes, (lmb_vec3){cosf(at), 0, sinf(at)}, 7.5f, 11.0f, noise, rng);
    }
    if (test_uniform(rng, 0, 1) < (is_odd ? 0.55f : 0.7f)) {
        put_plane(planes, up, 7.0f, 11.0f, noise, rng);
    }
    if (test_uniform(rng, 0, 1) < 0.25f) {
        put_plane(planes, down, 7.0f, 10.5f, noise, rng);
    }
    if (test_uniform(rng, 0, 1) < 0.35f) {
        put_plane(planes, up, 7.0f, 9.5f, noise, rng);
    }
    for (int i = (int)test_uniform(rng, 0, is_odd ? 3.5f : 2.0f); i > 0; --i) {
        const float tilt = test_uniform(rng, 0.3f, 1.2f), at = test_uniform(rng, 0, 6.2831853f);
        put_plane(planes, (lmb_vec3){sinf(tilt) * cosf(at), cosf(tilt), sinf(tilt) * sinf(at)}, 6.5f, is_odd ? 10.5f : 9.5f,
                  noise, rng);
    }
    const float nod = test_uniform(rng, -0.6f, 0.35f), roll = test_uniform(rng, -1, 1) * (is_odd ? 0.7f : 0.35f);
    for (int i = 0; i < planes->count; ++i) {
        planes->plane[i].normal = turned(planes->plane[i].normal, nod, roll);
    }
    return turned(up, nod, roll);
}

/* Counts the rooms in which up is found within five degrees. Twice UPRIGHT and half of it are worse for both kinds of
 * room. */
static void test_up_in_rooms(void)
{
    enum { ROOMS = 20000 };
    static const int wanted[2] = {18495, 13290};
    lmb_planes planes;
    memset(&planes, 0, sizeof planes);
    for (int is_odd = 0; is_odd < 2; ++is_odd) {
        test_rng rng = {(uint32_t)is_odd + 71};
        int right = 0;
        for (int i = 0; i < ROOMS; ++i) {
            const lmb_vec3 want = put_room(&planes, is_odd, &rng), up = lmb_planes_up(&planes);
            right += want.x * up.x + want.y * up.y + want.z * up.z > 0.9961947f;
        }
        CHECK_MSG(right >= wanted[is_odd], "%d of %d", right, ROOMS);
    }
}

/* No measurements, one pixel, a constant distance, and no flat surface. */
static void test_no_planes(stage *s)
{
    static const lmb_pinhole one = {1, 1, 80.0f, 80.0f, 0.0f, 0.0f};
    test_rng rng = {1};
    memset(s->depth, 0, sizeof s->depth);
    CHECK(find_planes(s) && s->planes.count == 0 && lmb_planes_floor(&s->planes) == -1);
    s->depth[0] = 1.0f;
    CHECK(lmb_cloud_init(&s->cloud, &one, s->depth, s->cloud_memory, sizeof s->cloud_memory) == LMB_OK);
    CHECK(lmb_cloud_normals(&s->cloud, 0, LMB_MAX_SIDE) == LMB_OK && s->cloud.normal[0].z == 0.0f);
    CHECK(lmb_planes_find(&s->planes, &s->cloud, s->plane_memory, sizeof s->plane_memory) == LMB_OK &&
          s->planes.count == 0);
    for (int i = 0; i < PIXELS; ++i) {
        s->depth[i] = 3.0f;
    }
    CHECK(find_planes(s) && s->planes.count == 1 && s->planes.plane[0].pixels == PIXELS);
    CHECK(fabsf(s->planes.plane[0].distance - 3.0f) < 1e-4f && s->planes.plane[0].normal.z > 0.999999f);
    for (int i = 0; i < PIXELS; i += 7) { /* as a caller might set it */
        s->cloud.inverse[i] = i % 2 == 0 ? NAN : INFINITY;
    }
    CHECK(lmb_cloud_normals(&s->cloud, 0, LMB_MAX_SIDE) == LMB_OK);
    for (int i = 0; i < PIXELS; ++i) {
        CHECK(i % 7 == 0 || s->cloud.normal[i].z > 0.99f);
    }
    for (int i = 0; i < PIXELS; ++i) {
        s->depth[i] = test_uniform(&rng, 0.5f, 5.0f);
    }
    CHECK(find_planes(s) && s->planes.count <= 1); /* no crash, hardly any plane found */
}

/* More planes than fit: the largest are kept. */
static void test_many_planes(stage *s)
{
    enum { ACROSS = 6, DOWN = 5 };
    for (int i = 0; i < PIXELS; ++i) {
        const int patch = i / WIDTH * DOWN / HEIGHT * ACROSS + i % WIDTH * ACROSS / WIDTH;
        s->depth[i] = 1.0f + 0.1f * (float)(patch * 7 % (ACROSS * DOWN));
    }
    CHECK_MSG(find_planes(s) && s->planes.count == LMB_MAX_PLANES, "%d", (int)s->planes.count);
    for (int i = 1; i < s->planes.count; ++i) {
        CHECK(s->planes.plane[i].pixels <= s->planes.plane[i - 1].pixels && s->planes.plane[i].pixels > 100);
    }
    int wrong = 0;
    for (int i = 0; i < PIXELS; ++i) {
        wrong += s->planes.label[i] > LMB_MAX_PLANES;
    }
    CHECK(wrong == 0);
}

/* --- the mesh ----------------------------------------------------------------------------------------------------- */

static void test_mesh(stage *s)
{
    const lmb_axes axes = lmb_axes_upright((lmb_vec3){0, 1, 0});
    draw_corner(s, 0.0f);
    find_planes(s);
    lmb_planes_move(&s->cloud, &s->planes);
    CHECK(lmb_real_mesh_bytes(WIDTH, HEIGHT, 4) <= sizeof s->mesh_memory);
    CHECK(lmb_real_mesh_build(&s->mesh, &s->cloud, &s->planes, 4, &axes, s->mesh_memory, 4) == LMB_ERR_CAPACITY);
    CHECK(lmb_real_mesh_build(&s->mesh, &s->cloud, &s->planes, 0, &axes, s->mesh_memory, 4) == LMB_ERR_ARG);
    CHECK(lmb_real_mesh_build(&s->mesh, &s->cloud, &s->planes, 4, &axes, s->mesh_memory, sizeof s->mesh_memory) ==
          LMB_OK);
    CHECK(s->mesh.count == PIXELS / 16);
    int off = 0, gaps = 0;
    for (int c = 0; c < s->mesh.count; ++c) {
        const lmb_flat *p = &s->planes.plane[s->mesh.label[c] - 1];
        const float *a = s->mesh.positions + 12 * c;
        for (int k = 0; k < 4; ++k) {
            const float *v = a + 3 * k;
            off += fabsf(v[0] * p->normal.x + v[1] * p->normal.y + v[2] * p->normal.z + p->distance) > 1e-4f;
        }
        /* Adjacent cells of one plane share two corners, bit for bit. */
        if ((c + 1) % s->mesh.columns != 0 && s->mesh.label[c] == s->mesh.label[c + 1]) {
            gaps += memcmp(a + 9, a + 12, 12) != 0 || memcmp(a + 6, a + 15, 12) != 0;
        }
    }
    CHECK_MSG(off == 0 && gaps == 0, "%d off, %d gaps", off, gaps);
    CHECK(lmb_real_tile(&s->tile, &s->cloud, &s->planes, &s->mesh, &axes, 40, 64) == LMB_OK && s->tile.hits == 64);
    CHECK(fabsf(s->tile.position[1][20] + 0.5f) < 1e-3f && s->tile.face[1][20] > 0.9999f && s->tile.id[20] > 0);
    CHECK(lmb_real_tile(&s->tile, &s->cloud, &s->planes, &s->mesh, &axes, 41, 64) == LMB_ERR_ARG);
    /* Cells of no plane, without a known direction or edge-on, face the camera, and so do their pixels. */
    for (int edge_on = 0; edge_on < 2; ++edge_on) {
        memset(s->planes.label, 0, PIXELS);
        for (int i = 0; i < PIXELS; ++i) {
            s->cloud.normal[i] = (lmb_vec3){edge_on ? 1.0f : 0.0f, 0, 0};
        }
        CHECK(lmb_real_mesh_build(&s->mesh, &s->cloud, &s->planes, 4, &axes, s->mesh_memory, sizeof s->mesh_memory) ==
              LMB_OK && s->mesh.count > PIXELS / 20);
        off = 0;
        for (int c = 0; c < s->mesh.count; ++c) {
            const float *a = s->mesh.positions + 12 * c;
            off += fabsf(a[5] - a[2]) + fabsf(a[8] - a[2]) + fabsf(a[11] - a[2]) > -1e-5f * a[2];
        }
        CHECK_MSG(off < (edge_on ? s->mesh.count * 3 / 4 : 1), "%d of %d", off, (int)s->mesh.count);
        CHECK(lmb_real_tile(&s->tile, &s->cloud, &s->planes, &s->mesh, &axes, 40, 64) == LMB_OK);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const lmb_vec3 n = {s->tile.normal[0][k], s->tile.normal[1][k], s->tile.normal[2][k]};
            const float facing = n.x * s->tile.position[0][k] + n.y * s->tile.position[1][k] +
                                 n.z * s->tile.position[2][k];
            CHECK_MSG(s->tile.id[k] == 0 || facing < 0.0f, "%d: %g", k, (double)facing);
        }
    }
}

/* --- grazing photos ------------------------------------------------------------------------------------------------ */

/* A floor up to the horizon, measured up to `far`, with noise in 1 / distance; one pixel in ten is missing. Beyond
 * `far` only specks are measured, which sensors report at any distance in their range. */
static void draw_grazing(stage *s, test_rng *rng)
{
    const float height = test_uniform(rng, 0.04f, 1.5f), far = test_uniform(rng, 0.8f, 4.5f),
                tilt = test_uniform(rng, -0.2f, 0.2f), roll = test_uniform(rng, -0.15f, 0.15f),
                noise = test_uniform(rng, 0.0f, 0.004f);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float down = tilt + roll * ray.x - ray.y, z = down > 0.0f ? height / down : 1e9f;
        s->depth[i] = z < far ? 1.0f / (1.0f / z + test_uniform(rng, -noise, noise)) : 0.0f;
        s->depth[i] = test_random(rng) % 10 == 0 ? 0.0f : s->depth[i];
        if (z >= far && test_random(rng) % 40 == 0) {
            s->depth[i] = test_uniform(rng, 0.8f, 1.0f) * far;
        }
    }
}

/* Nearest [0] and farthest [1] measurement in the cells around cell corner (i, j), m. */
static void measured_near(float range[2], const stage *s, int32_t i, int32_t j)
{
    range[0] = 1e9f;
    range[1] = 0.0f;
    for (int32_t y = 4 * j - 4; y < 4 * j + 4; ++y) {
        for (int32_t x = 4 * i - 4; x < 4 * i + 4; ++x) {
            const float z = x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT ? 0.0f : s->depth[y * WIDTH + x];
            range[0] = z > 0.0f && z < range[0] ? z : range[0];
            range[1] = z > range[1] ? z : range[1];
        }
    }
}

/* A plane is no larger than its measured part, which reaches `far` at most. */
static int is_wide(const lmb_planes *planes, float far)
{
    for (int32_t i = 0; i < planes->count; ++i) {
        const lmb_flat *p = &planes->plane[i];
        if (p->high[0] - p->low[0] > 3.0f * far || p->high[1] - p->low[1] > 1.5f * far || -p->centre.z > far) {
            return 1;
        }
    }
    return 0;
}

static float farthest(const stage *s)
{
    float far = 0.0f;
    for (int i = 0; i < PIXELS; ++i) {
        far = s->depth[i] > far ? s->depth[i] : far;
    }
    return far;
}

/* Up to noise and steps of a millimetre, no cell corner is farther from the measurements around it than a corner can be
 * from its cell's centre, so no bounds are wider than the photo is deep. */
static void test_grazing(stage *s)
{
    static const int32_t corner[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    const lmb_axes axes = lmb_axes_upright((lmb_vec3){0, 1, 0});
    test_rng rng = {2025};
    int off = 0, corners = 0, wide = 0;
    float worst = 0.0f;
    for (int n = 0; n < 60; ++n) {
        draw_grazing(s, &rng);
        CHECK(find_planes(s));
        wide += is_wide(&s->planes, farthest(s));
        lmb_planes_move(&s->cloud, &s->planes);
        CHECK(lmb_real_mesh_build(&s->mesh, &s->cloud, &s->planes, 4, &axes, s->mesh_memory, sizeof s->mesh_memory) ==
              LMB_OK);
        for (int32_t at = 0; at < s->mesh.columns * s->mesh.rows; ++at) {
            for (int32_t k = 0; s->mesh.cell[at] >= 0 && k < 4; ++k) {
                float range[2];
                measured_near(range, s, at % s->mesh.columns + corner[k][0], at / s->mesh.columns + corner[k][1]);
                const float z = -s->mesh.positions[12 * s->mesh.cell[at] + 3 * k + 2];
                off += !(z > 0.7f * range[0] && z < 1.4f * range[1]);
                worst = z / range[1] > worst ? z / range[1] : worst;
                ++corners;
            }
        }
    }
    CHECK_MSG(wide == 0, "%d planes reach farther than what was measured", wide);
    CHECK_MSG(off == 0 && corners > 15000, "%d of %d corners, %g times as far as measured", off, corners,
              (double)worst);
}

/* A photo pixel and the frame's pixel show the same ray, wherever the axis is. */
static void test_view(void)
{
    static const float centres[3] = {47.5f, 30.0f, 61.5f};
    static const int32_t before[3] = {0, 40, 0}, sides[3] = {96, 141, 124}; /* whole tiles only */
    const lmb_axes axes = lmb_axes_upright((lmb_vec3){0, 1, 0});
    for (int i = 0; i < 3; ++i) {
        lmb_pinhole c = camera;
        lmb_view v = {.sample_x = 0};
        int32_t x0, y0;
        c.cx = centres[i] + 0.1f;
        lmb_pinhole_round(&c);
        CHECK(c.cx == centres[i]);
        CHECK(lmb_photo_view(&v, &x0, &y0, &c, &axes) == LMB_OK && x0 % LMB_TILE == 0 && y0 % LMB_TILE == 0);
        CHECK(x0 == before[i] && v.frame_width == sides[i] && y0 == 0 && v.frame_height == HEIGHT);
        const float x = ((2.0f * ((float)x0 + 10.0f) + 1.0f) / (float)v.frame_width - 1.0f) * v.half_width;
        CHECK_MSG(fabsf(x - lmb_cloud_ray(&c, 10.0f, 0.0f).x) < 1e-6f, "%g", (double)x);
    }
}

/* Focal lengths that give no field of view, or an infinite one. */
static void test_no_view(void)
{
    static const float focal[4] = {3e33f, INFINITY, 1e-31f, 1e-42f};
    const lmb_axes axes = lmb_axes_upright((lmb_vec3){0, 1, 0});
    for (int i = 0; i < 8; ++i) {
        lmb_pinhole c = camera;
        lmb_view v;
        int32_t x0, y0;
        *(i & 1 ? &c.fx : &c.fy) = focal[i / 2];
        CHECK_MSG(lmb_photo_view(&v, &x0, &y0, &c, &axes) == LMB_ERR_ARG, "%d: %g", i & 1, (double)focal[i / 2]);
    }
}

/* --- environment -------------------------------------------------------------------------------------------------- */

static void test_half(void)
{
    int wrong = 0;
    for (uint32_t code = 0; code < 0x7c00u; ++code) {
        wrong += half_encode(half_decode((uint16_t)code)) != code;
    }
    CHECK(wrong == 0);
    wrong = 0;
    for (uint32_t steps = 0; steps <= 4096; ++steps) { /* quarters of the smallest step: ties round to the even code */
        const uint32_t whole = steps / 4, rest = steps % 4, up = rest > 2 || (rest == 2 && whole % 2 == 1);
        wrong += half_encode((float)steps / 67108864.0f) != whole + up;
    }
    CHECK(wrong == 0);
    CHECK(half_decode(HALF_ONE) == 1.0f && half_encode(-1.0f) == 0 && half_encode(NAN) == 0);
    CHECK(half_encode(1e9f) == 0x7bff);
    CHECK(half_encode(1.0f + 1.0f / 2048.0f) == HALF_ONE && half_encode(1.0f + 3.0f / 2048.0f) == HALF_ONE + 2);
}

/* Left, right, top and bottom of a picture map to the cube's sides, the centre to front and back. */
static void test_fold(void)
{
    enum { SIZE = 16, SIDE = 90 };
    static uint32_t memory[SIZE * SIZE * 6 * 3];
    static float rgb[SIDE * SIDE * 3];
    static const lmb_vec3 to[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    static const float want[6] = {2.0f, 1.0f, 3.0f, 4.0f, 5.0f, 5.0f};
    const lmb_axes axes = lmb_axes_upright((lmb_vec3){0, 1, 0});
    lmb_env env;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const int x = i % SIDE - SIDE / 2, y = i / SIDE - SIDE / 2, ax = x < 0 ? -1 - x : x, ay = y < 0 ? -1 - y : y;
        const float v = ax < SIDE / 6 && ay < SIDE / 6 ? 5.0f : ax > ay ? (x < 0 ? 1.0f : 2.0f) : y < 0 ? 3.0f : 4.0f;
        rgb[3 * i] = rgb[3 * i + 1] = rgb[3 * i + 2] = v;
    }
    CHECK(lmb_env_bytes(12) == 0 && lmb_env_bytes(0) == 0 && lmb_env_bytes(4096) == 0);
    CHECK(lmb_env_init(&env, SIZE, memory, lmb_env_bytes(SIZE) - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_env_init(&env, SIZE, memory, sizeof memory) == LMB_OK && env.levels == 5);
    CHECK(lmb_env_fold(&env, rgb, SIDE, SIDE, &axes) == LMB_OK);
    for (int i = 0; i < 6; ++i) {
        float seen[3];
        lmb_env_sample(seen, &env, to[i], 0.0f);
        CHECK_MSG(seen[0] == want[i] && seen[2] == want[i], "side %d: %g", i, (double)seen[0]);
        lmb_env_sample(seen, &env, to[i], 1.0f); /* the level with one texel per face: the mean of the face */
        CHECK_MSG(fabsf(seen[1] - want[i]) < 0.05f, "side %d: %g", i, (double)seen[1]);
    }
}

static void test_dimmed(void)
{
    enum { SIZE = 8 };
    static uint32_t memory[SIZE * SIZE * 6 * 3];
    const float light[3] = {9, 9, 9}, up_share[3] = {0.5f, 1.0f, 1.0f};
    lmb_env env;
    float seen[3];
    lmb_env_init(&env, SIZE, memory, sizeof memory);
    lmb_env_set(&env, 0, 4, 4, light);
    lmb_env_set(&env, 0, 4, 3, light);
    lmb_env_mips(&env);
    lmb_env_dim(&env, &env, up_share);
    /* Invalid directions give the value straight ahead. */
    const lmb_vec3 odd[] = {{0, 0, 0}, {NAN, 0, 0}, {0, INFINITY, 1}, {1e-30f, 0, 0}};
    float ahead[3];
    lmb_env_sample(ahead, &env, (lmb_vec3){0, 0, -1}, 0.0f);
    for (int i = 0; i < 4; ++i) {
        lmb_env_sample(seen, &env, odd[i], 0.0f);
        CHECK_MSG(memcmp(seen, ahead, sizeof seen) == 0, "direction %d: %g %g %g", i, (double)seen[0], (double)seen[1],
                  (double)seen[2]);
    }
    lmb_env_sample(seen, &env, (lmb_vec3){1.0f, -0.1f, -0.1f}, 0.0f);
    CHECK(seen[0] > 0.0f && seen[0] == 0.5f * seen[1] && seen[1] == seen[2]);
}

/* --- changes ------------------------------------------------------------------------------------------------------ */

static void test_delta(stage *s)
{
    lmb_irradiance without, with;
    lmb_radiance photo, before;
    memset(&s->tile, 0, sizeof s->tile);
    for (int i = 0; i < 3 * LMB_TILE_PIXELS; ++i) {
        before.rgb[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS] = 0.1f + 0.003f * (float)(i % LMB_TILE_PIXELS);
        without.rgb[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS] = 2.0f;
        s->tile.id[i % LMB_TILE_PIXELS] = 1;
    }
    s->tile.id[7] = 0;
    photo = before;
    with = without;
    CHECK(lmb_delta_tile(&photo, &s->tile, &without, &with) == LMB_OK && memcmp(&photo, &before, sizeof photo) == 0);
    with.rgb[0][3] = 1.0f; /* half the light gives half the picture */
    with.rgb[0][4] = 0.0f;
    with.rgb[0][5] = 4.0f;
    with.rgb[0][7] = 0.0f;
    CHECK(lmb_delta_tile(&photo, &s->tile, &without, &with) == LMB_OK);
    CHECK(fabsf(photo.rgb[0][3] - 0.5f * before.rgb[0][3]) < 1e-6f && photo.rgb[0][4] < 1e-6f);
    CHECK(fabsf(photo.rgb[0][5] - 2.0f * before.rgb[0][5]) < 1e-6f && photo.rgb[0][7] == before.rgb[0][7]);
    CHECK(lmb_real_albedo(9.0f, 1.0f) == LMB_ALBEDO_MAX && lmb_real_albedo(0.0f, 1.0f) == LMB_ALBEDO_MIN);
    CHECK(lmb_real_albedo(1.0f, 0.0f) == 0.5f);
    CHECK(fabsf(lmb_real_albedo(0.25f, 3.14159265f) - 0.25f) < 1e-6f);
}

/* A varnish straight below the camera reflects its share of the change, at a grazing angle nearly all. Other planes and
 * pixels without a plane reflect nothing, and unchanged pixels keep their bits. */
static void test_mirror_tile(stage *s)
{
    static lmb_cone_seen without, with;
    lmb_radiance photo, before;
    const lmb_pinhole tile = {LMB_TILE, LMB_TILE, 80.0f, 80.0f, 0.0f, 0.0f};
    lmb_planes planes;
    memset(&planes, 0, sizeof planes);
    memset(&s->tile, 0, sizeof s->tile);
    planes.label = (uint8_t *)s->plane_memory;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        s->tile.id[k] = 1;
        s->tile.normal[1][k] = 1.0f;
        s->tile.position[1][k] = -1.0f;
        planes.label[k] = 2;
        for (int c = 0; c < 3; ++c) {
            before.rgb[c][k] = 0.1f + 0.001f * (float)k;
            without.rgb[c][k] = 0.5f;
            with.rgb[c][k] = 1.5f;
        }
    }
    s->tile.position[2][1] = -1.7320508f; /* 60 degrees: 0.04 + 0.96 / 32 */
    s->tile.id[2] = 0;
    planes.label[3] = 1;
    planes.label[4] = 0;
    with.rgb[1][5] = 0.5f;
    with.rgb[2][6] = -100.0f;
    photo = before;
    CHECK(lmb_mirror_tile(&photo, &s->tile, &planes, &tile, 1, &without, &with, 0.04f) == LMB_OK);
    const float got[2] = {photo.rgb[0][0] - before.rgb[0][0], photo.rgb[0][1] - before.rgb[0][1]};
    CHECK_MSG(fabsf(got[0] - 0.04f) < 1e-6f && fabsf(got[1] - 0.07f) < 1e-5f, "%g %g", (double)got[0], (double)got[1]);
    CHECK(photo.rgb[0][2] == before.rgb[0][2] && photo.rgb[0][3] == before.rgb[0][3] &&
          photo.rgb[0][4] == before.rgb[0][4] && photo.rgb[1][5] == before.rgb[1][5] &&
          photo.rgb[2][6] == 0.5f * before.rgb[2][6]); /* at most half of the photo counts as reflection */
    photo = before;
    CHECK(lmb_mirror_tile(&photo, &s->tile, &planes, &tile, -1, &without, &with, 1.0f) == LMB_OK);
    CHECK(fabsf(photo.rgb[0][3] - before.rgb[0][3] - 1.0f) < 1e-6f && photo.rgb[0][4] == before.rgb[0][4]);
    CHECK(lmb_mirror_tile(&photo, &s->tile, &planes, &tile, 1, NULL, &with, 0.04f) == LMB_ERR_ARG);
}

/* Sizes that the headers document. */
static void test_sizes(void)
{
    CHECK_MSG(sizeof(lmb_flat) == 100, "%d", (int)sizeof(lmb_flat));
    CHECK_MSG(sizeof(lmb_cones) == 21108, "%d", (int)sizeof(lmb_cones));
    CHECK_MSG(sizeof(lmb_cone_scratch) == 2560, "%d", (int)sizeof(lmb_cone_scratch));
    CHECK_MSG(sizeof(lmb_around_scratch) / 1024 == 9, "%d", (int)sizeof(lmb_around_scratch));
    CHECK(lmb_voxels_bytes(100000, LMB_VOXELS_ONE) == 14800000);
    CHECK(lmb_voxels_bytes(100000, LMB_VOXELS_THREE) == 38800000);
    CHECK(lmb_cloud_bytes(10, 10) == 1600 && lmb_planes_bytes(10, 10) == 500 && lmb_real_mesh_bytes(8, 8, 4) == 4 * 96);
}

/* A nearer surface hides the object; one within the depth noise does not. */
static void test_hidden(stage *s)
{
    static lmb_tile object;
    static lmb_radiance photo, light;
    memset(&s->tile, 0, sizeof s->tile);
    memset(&object, 0, sizeof object);
    memset(&photo, 0, sizeof photo);
    s->cloud.noise = 0.001f;
    for (int k = 0; k < 4; ++k) {
        object.id[k] = k != 3;
        object.depth[k] = 2.0f;
        light.rgb[1][k] = 1.0f;
        s->tile.id[k] = k != 2;
        s->tile.depth[k] = k == 0 ? 1.9f : 1.999f;
    }
    CHECK(lmb_object_tile(&photo, &light, &object, &s->tile, &s->cloud) == 6);
    CHECK(photo.rgb[1][0] == 0.0f && photo.rgb[1][1] == 1.0f && photo.rgb[1][2] == 1.0f && photo.rgb[1][3] == 0.0f);
}

static const lmb_vec3 box[4] = {{-1, 0, -3}, {1, 0, -3}, {0, 1, -3}, {0, 0, -5}};

/* Both maps of each kind of light have the same views, so a texel's power is the same number. */
static void test_two_maps(void)
{
    enum { SIZE = 16 };
    static uint32_t memory[2 * 6 * SIZE * SIZE * 2];
    lmb_scene scene;
    lmb_light light = {{0, 2, -3}, {0, -1, 0}, {1, 2, 3}, 0.9f, 0.8f, LMB_LIGHT_SPOT, 0, 0};
    memset(&scene, 0, sizeof scene);
    scene.bounds_min = (lmb_vec3){-1, 0, -5};
    scene.bounds_max = (lmb_vec3){1, 1, -3};
    for (light.kind = LMB_LIGHT_POINT; light.kind <= LMB_LIGHT_DIRECTIONAL; ++light.kind) {
        lmb_shadow_map maps[2];
        float power[2][3];
        CHECK(lmb_two_maps(maps, &light, &scene, SIZE, memory, sizeof memory) == LMB_OK);
        CHECK(memcmp(maps[0].view, maps[1].view, sizeof maps[0].view) == 0);
        for (int i = 0; i < 2; ++i) {
            lmb_light_texel_power(power[i], &light, &maps[i], 0, 3, 5);
        }
        CHECK(memcmp(power[0], power[1], sizeof power[0]) == 0 && power[0][2] > 0.0f);
    }
    CHECK(lmb_two_maps(NULL, &light, &scene, SIZE, memory, sizeof memory) == LMB_ERR_ARG);
}

static lmb_texel around_points[4096];

/* Each part has the colour at its centre: vertex colours of 8 and 16 bits, and a black-to-white texture with both kinds
 * of uvs. */
static void check_coloured(lmb_scene *scene, lmb_mesh *mesh, lmb_material *material, const lmb_env *env)
{
    static const uint8_t colours[16] = {255, 0, 51, 255, 0, 204, 102, 255, 51, 255, 255, 255};
    static const float uvs[8] = {0.25f, 0.5f, 0.75f, 0.5f, 0.25f, 0.5f};
    static const uint16_t uvs_16[8] = {16384, 32768, 49151, 32768, 16384, 32768};
    static const uint8_t black_to_white[8] = {0, 0, 0, 255, 255, 255, 255, 255};
    const lmb_texture texture = {black_to_white, 2, 1, 1, LMB_WRAP_CLAMP, LMB_WRAP_CLAMP, LMB_BILINEAR, 0};
    uint16_t wide[16];
    for (int i = 0; i < 16; ++i) {
        wide[i] = (uint16_t)(65535.0 * sqrt(colours[i] / 255.0) + 0.5);
    }
    scene->textures = &texture;
    scene->texture_count = 1;
    mesh->uv_scale[0] = mesh->uv_scale[1] = 1.0f;
    for (int kind = 0; kind < (LMB_TEXTURE_FORMATS ? 4 : 3); ++kind) {
        material->texture = kind > 0 ? 0 : -1;
        mesh->colours = kind == 3 ? (const uint8_t *)wide : colours;
        mesh->colour_format = kind == 3 ? LMB_COLOUR_RGBA16 : LMB_COLOUR_RGBA8;
        mesh->uvs = kind == 2 ? (const void *)uvs_16 : uvs;
        mesh->uv_format = kind == 2 ? LMB_UV_U16 : LMB_UV_F32;
        const size_t n = lmb_around_points(around_points, 4096, scene, 1, 1, 0.5f, env);
        CHECK(n >= 16);
        for (size_t i = 0; i < n; ++i) {
            const double b2 = (double)around_points[i].position.y,
                         b1 = ((double)around_points[i].position.x + 1.0 - b2) / 2.0;
            for (int c = 0; c < 3; ++c) {
                const double colour = (colours[c] * (1.0 - b1 - b2) +
                                       colours[4 + c] * b1 + colours[8 + c] * b2) / 255.0,
                             wanted = 0.5 * 3.14159265 / (double)n * colour * (kind > 0 ? b1 : 1.0);
                CHECK_MSG(fabs((double)around_points[i].flux[c] - wanted) < 1e-4, "%d, part %d: %g, not %g", kind,
                          (int)i, (double)around_points[i].flux[c], wanted);
            }
        }
    }
    mesh->colours = colours;
    mesh->colour_format = LMB_COLOUR_RGBA8;
}

/* A part samples the texels inside it from the texture levels: a mean of all texels would make each part grey. */
static void check_levels(lmb_scene *scene, lmb_mesh *mesh, lmb_material *material, const lmb_env *env)
{
    static uint8_t texels[4 * (64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1)];
    static const float uvs[6] = {0.0f, 0.5f, 1.0f, 0.5f, 0.5f, 1.0f};
    const lmb_texture texture = {texels, 64, 64, 7, LMB_WRAP_CLAMP, LMB_WRAP_CLAMP, LMB_BILINEAR, 0};
    size_t at = 0;
    float dark = 0.0f, light = 0.0f;
    for (int side = 64; side > 0; side /= 2) {
        for (int i = 0; i < side * side; ++i, at += 4) {
            memset(texels + at, side == 1 ? 188 : i % side < side / 2 ? 0 : 255, 3);
            texels[at + 3] = 255;
        }
    }
    scene->textures = &texture;
    scene->texture_count = 1;
    mesh->colours = NULL;
    mesh->uvs = uvs;
    mesh->uv_format = LMB_UV_F32;
    material->texture = 0;
    const size_t n = lmb_around_points(around_points, 4096, scene, 1, 1, 0.125f, env);
    for (size_t i = 0; i < n; ++i) {
        const double b2 = (double)around_points[i].position.y, b1 = ((double)around_points[i].position.x + 1.0 - b2) / 2.0,
                     u = b1 + 0.5 * b2;
        dark = u < 0.4 ? fmaxf(dark, around_points[i].flux[0]) : dark;
        light += u > 0.6 ? around_points[i].flux[0] : 0.0f;
    }
    CHECK_MSG(n >= 64 && dark < 1e-4f && light > 0.3f, "%d parts: %g where it is black, %g where white", (int)n,
              (double)dark, (double)light);
}

/* A triangle reflects albedo x light x area, for any number of parts. */
static void test_around(void)
{
    static uint32_t env_memory[8 * 8 * 6 * 3], triangle[3] = {0, 1, 2};
    lmb_texel *const points = around_points;
    lmb_material material;
    lmb_mesh mesh;
    lmb_instance instance;
    lmb_scene scene;
    lmb_env env;
    const float white[3] = {1, 1, 1};
    memset(&material, 0, sizeof material);
    memset(&mesh, 0, sizeof mesh);
    memset(&instance, 0, sizeof instance);
    memset(&scene, 0, sizeof scene);
    material.albedo[0] = material.albedo[1] = material.albedo[2] = 0.5f;
    material.texture = -1;
    mesh.positions = box;
    mesh.indices = triangle;
    mesh.vertex_count = 4;
    mesh.triangle_count = 1;
    mesh.index_format = LMB_INDEX_U32;
    instance.to_world.m[0] = instance.to_world.m[5] = instance.to_world.m[10] = instance.to_world.m[15] = 1.0f;
    instance.first_id = 1;
    scene.meshes = &mesh;
    scene.materials = &material;
    scene.instances = &instance;
    scene.mesh_count = scene.material_count = scene.instance_count = 1;
    lmb_env_init(&env, 8, env_memory, sizeof env_memory);
    for (int i = 0; i < 6 * 64; ++i) {
        lmb_env_set(&env, i / 64, i % 8, i / 8 % 8, white);
    }
    lmb_env_mips(&env);
    for (float leaf = 3.0f; leaf > 0.05f; leaf *= 0.4f) {
        double sum = 0.0;
        const size_t n = lmb_around_points(points, 4096, &scene, 1, 1, leaf, &env);
        CHECK(n == lmb_around_points(NULL, 0, &scene, 1, 1, leaf, &env));
        double middle = 0.0; /* of all parts, equals the triangle's */
        for (size_t i = 0; i < n; ++i) {
            sum += (double)points[i].flux[0];
            middle += (double)points[i].position.y / (double)n;
            CHECK(points[i].position.y > 0.0f && points[i].position.z == -3.0f && points[i].normal.z == 1.0f);
        }
        CHECK_MSG(fabs(sum - 0.5 * 3.14159265) < 1e-3 && fabs(middle - 1.0 / 3.0) < 1e-5, "%g, %g of %d parts", sum,
                  middle, (int)n);
    }
    check_coloured(&scene, &mesh, &material, &env);
    check_levels(&scene, &mesh, &material, &env);
}

/* Close points share one result, which scales all of them; an unchanged light leaves the bits alone. */
static void test_again(void)
{
    enum { COUNT = 100 };
    static lmb_texel points[COUNT], before[COUNT];
    static lmb_around_scratch scratch;
    const lmb_vec3 about = {0, 0, 0};
    memset(points, 0, sizeof points);
    for (int i = 0; i < COUNT; ++i) {
        points[i].position = (lmb_vec3){0.01f * (float)(i % 10) + (float)(i / 10), 0.0f, 0.0f};
        points[i].normal = (lmb_vec3){0, i < 50 ? 1.0f : -1.0f, 0};
        points[i].flux[0] = points[i].flux[1] = points[i].flux[2] = 0.1f + 0.01f * (float)i;
    }
    memcpy(before, points, sizeof before);
    CHECK(lmb_around_gather(&scratch, points, 0, COUNT, 0.5f, about) == COUNT);
    CHECK_MSG(scratch.count <= 10 && scratch.tile.normal[1][0] == 1.0f && scratch.tile.depth[0] > 0.0f, "%d",
              (int)scratch.count);
    for (int k = 0; k < scratch.count; ++k) {
        scratch.before.rgb[0][k] = scratch.now.rgb[0][k] = 0.7f;
        scratch.before.rgb[1][k] = 2.0f;
        scratch.now.rgb[1][k] = 1.0f;
        scratch.now.rgb[2][k] = 1.0f; /* no light before */
    }
    CHECK(lmb_around_scale(points, &scratch, NULL) == LMB_OK);
    for (int i = 0; i < COUNT; ++i) {
        CHECK(points[i].flux[0] == before[i].flux[0] && points[i].flux[1] == 0.5f * before[i].flux[1] &&
              points[i].flux[2] == before[i].flux[2]);
    }
    CHECK(lmb_around_gather(&scratch, points, 0, 10, 1e-4f, (lmb_vec3){0.05f, 0, 0}) == 10 && scratch.count == 10);
    CHECK(lmb_around_gather(&scratch, points, COUNT, COUNT, 1.0f, about) == COUNT && scratch.count == 0);
    CHECK(lmb_around_scale(NULL, &scratch, NULL) == LMB_ERR_ARG);
}

void test_mixed(void)
{
    stage *s = calloc(1, sizeof *s);
    if (s == NULL) {
        abort();
    }
    test_points(s);
    test_reach(s);
    test_refusals(s);
    test_picture_neighbours(s);
    test_corner(s);
    test_place(s);
    test_up();
    test_up_by_walls();
    test_up_in_rooms();
    test_no_planes(s);
    test_many_planes(s);
    test_mesh(s);
    test_grazing(s);
    test_view();
    test_no_view();
    test_half();
    test_fold();
    test_dimmed();
    test_delta(s);
    test_mirror_tile(s);
    test_sizes();
    test_hidden(s);
    test_two_maps();
    test_around();
    test_again();
    free(s);
}
