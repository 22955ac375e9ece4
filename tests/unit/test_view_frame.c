/* test_view_frame.c: a scene without a camera fills the frame and touches no border, for any shape and size. */
#include "../../tools/common/view_frame.h"
#include "../world.h"

void test_view_frame(void);

enum { WIDTH = 160, HEIGHT = 120 };

static struct {
    uint32_t depth[WIDTH * HEIGHT], id[WIDTH * HEIGHT];
} drawn;

static view_options options_of(int32_t width, int32_t height)
{
    view_options o;
    view_options_init(&o);
    o.is_quiet = 1;
    o.width = width;
    o.height = height;
    return o;
}

/* A box with half sides x, y, z around `at`. */
static void box_at(lmb_vec3 at, float x, float y, float z)
{
    const lmb_vec3 half[3] = {mul3(X, x), mul3(Y, y), mul3(Z, z)};
    for (int i = 0; i < 6; ++i) {
        const lmb_vec3 out = i & 1 ? mul3(half[i / 2], -1.0f) : half[i / 2];
        world_quad(add3(at, out), half[(i / 2 + 1) % 3], half[(i / 2 + 2) % 3]);
    }
}

/* The five walls of a box without one. */
static void room_without(int wall)
{
    const lmb_vec3 half[3] = {mul3(X, 2), mul3(Y, 1.5f), mul3(Z, 2)};
    world_begin(0.5f, 0.5f, 0.5f);
    for (int i = 0; i < 6; ++i) {
        if (i != wall) {
            const lmb_vec3 out = i & 1 ? half[i / 2] : mul3(half[i / 2], -1.0f);
            world_quad(out, half[(i / 2 + 1) % 3], half[(i / 2 + 2) % 3]);
        }
    }
    CHECK(world_end() == LMB_OK);
}

/* Share of a 160 x 120 frame that the scene covers; -1 if it touches the frame's border. */
static double covered(const lmb_view *framed)
{
    lmb_view open = *framed, v;
    lmb_target t;
    int count = 0, border = 0;
    open.near_m = 0.0f; /* from the scene's size, as by default */
    v = view_from(&open, 0.0f, &world.scene);
    memset(&t, 0, sizeof t);
    lmb_surface_init(&t.depth, LMB_DEPTH32F, WIDTH, HEIGHT, drawn.depth, sizeof drawn.depth);
    lmb_surface_init(&t.id, LMB_ID32, WIDTH, HEIGHT, drawn.id, sizeof drawn.id);
    lmb_surface_clear(&t.depth);
    lmb_surface_clear(&t.id);
    CHECK(lmb_draw(&t, lmb_kernels_at(0), &v, &world.scene, 1, UINT32_MAX - 1, 0, NULL) == LMB_OK);
    for (int y = 0; y < HEIGHT; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            const int tile = y / LMB_TILE * (WIDTH / LMB_TILE) + x / LMB_TILE;
            const int shows = drawn.id[tile * LMB_TILE_PIXELS + y % LMB_TILE * LMB_TILE + x % LMB_TILE] != 0;
            count += shows;
            border |= shows && (x == 0 || y == 0 || x == WIDTH - 1 || y == HEIGHT - 1);
        }
    }
    return border ? -1.0 : count / (double)(WIDTH * HEIGHT);
}

/* Largest distance of all corners from the frame's centre, relative to half of the frame: horizontally and
 * vertically. */
static void reach_in(double out[2], const lmb_view *v)
{
    out[0] = out[1] = 0.0;
    for (uint32_t i = 0; i < 3 * world.count; ++i) {
        const float *p = world.corners[i / 3][i % 3];
        const lmb_vec3 d = sub3(vec3(p[0], p[1], p[2]), v->eye);
        const double away = -(double)dot3(v->back, d);
        CHECK(away > 0.0);
        out[0] = fmax(out[0], fabs((double)dot3(v->right, d)) / (away * (double)v->half_width));
        out[1] = fmax(out[1], fabs((double)dot3(v->up, d)) / (away * (double)v->half_height));
    }
}

/* The scene fills one direction of the frame to 0.94, and the other to between `share` and that. */
static void check_framed(const char *what, double share)
{
    view_options o = options_of(WIDTH, HEIGHT);
    report r = {0};
    lmb_view v;
    double reach[2];
    memset(&v, 0, sizeof v);
    CHECK(view_frame(&v, &o, &world.scene, "it", &r));
    reach_in(reach, &v);
    const double full = fmax(reach[0], reach[1]), cover = covered(&v);
    CHECK_MSG(fabs(full - 0.94) < 2e-3, "%s: reaches %g", what, full);
    CHECK_MSG(cover >= share && cover <= 0.8, "%s: covers %g", what, cover);
}

static void check_box(const char *what, lmb_vec3 at, float x, float y, float z, double share)
{
    world_begin(0.5f, 0.5f, 0.5f);
    box_at(at, x, y, z);
    CHECK(world_end() == LMB_OK);
    check_framed(what, share);
}

static void check_shapes(void)
{
    check_box("cube", vec3(0, 0, 0), 1, 1, 1, 0.3);
    check_box("tiny cube", vec3(0, 0, 0), 1e-4f, 1e-4f, 1e-4f, 0.3);
    check_box("huge cube", vec3(0, 0, 0), 9e3f, 9e3f, 9e3f, 0.3);
    check_box("far cube", vec3(900, -40, 3000), 1, 1, 1, 0.3);
    check_box("plate", vec3(0, 0, 0), 5, 0.05f, 5, 0.3);
    check_box("wall", vec3(0, 2, 0), 6, 2, 0.1f, 0.3);
    check_box("wall from its side", vec3(0, 2, 0), 0.1f, 2, 6, 0.3);
    check_box("tower", vec3(0, 10, 0), 1, 10, 1, 0.06);
    world_begin(0.5f, 0.5f, 0.5f);
    box_at(vec3(-3, 0, 0), 1, 1, 1);
    box_at(vec3(9, 4, 2), 0.5f, 2, 0.5f); /* all on one side of the centre of the bounds */
    CHECK(world_end() == LMB_OK);
    check_framed("two boxes", 0.05);
}

/* If no size is given, the frame is as tall or as wide as the scene. */
static void check_size(float x, float y, float z, int32_t width)
{
    view_options o = options_of(0, 0);
    report r = {0};
    lmb_view v;
    memset(&v, 0, sizeof v);
    world_begin(0.5f, 0.5f, 0.5f);
    box_at(vec3(0, 0, 0), x, y, z);
    CHECK(world_end() == LMB_OK);
    CHECK(view_frame(&v, &o, &world.scene, "it", &r));
    CHECK_MSG(o.width == width && o.height == 480 && v.frame_width == width, "%d x %d", (int)o.width, (int)o.height);
}

/* A room is viewed through the one open wall, or from above, but not from below. */
static void check_rooms(void)
{
    static const float open[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0.7f, 0}, {0, 0, -1}, {0, 0, 1}};
    for (int wall = 0; wall < 6; ++wall) {
        view_options o = options_of(WIDTH, HEIGHT);
        report r = {0};
        lmb_view v;
        memset(&v, 0, sizeof v);
        room_without(wall);
        CHECK(view_frame(&v, &o, &world.scene, "it", &r));
        const lmb_vec3 out = vec3(open[wall][0], open[wall][1], open[wall][2]);
        CHECK_MSG(dot3(out, out) == 0.0f || dot3(out, v.back) > 0.5f, "wall %d: %g", wall, (double)dot3(out, v.back));
        CHECK(v.back.y > 0.0f);
    }
}

/* Towards the eye. */
static lmb_vec3 seen_from(void)
{
    view_options o = options_of(WIDTH, HEIGHT);
    report r = {0};
    lmb_view v;
    memset(&v, 0, sizeof v);
    CHECK(world_end() == LMB_OK && view_frame(&v, &o, &world.scene, "it", &r));
    return v.back;
}

/* A thing a little deeper than wide is viewed from the front; a long one from the right side. */
static void check_sides(void)
{
    static const float deep[2] = {1.3f, 1.7f};
    for (int i = 0; i < 2; ++i) {
        world_begin(0.5f, 0.5f, 0.5f);
        box_at(vec3(0, 0, 0), 1, 1, deep[i]);
        const lmb_vec3 back = seen_from();
        CHECK_MSG(i == 0 ? back.z > back.x : back.x > back.z, "%g deep: from %g, %g", (double)deep[i], (double)back.x,
                  (double)back.z);
    }
}

/* Five boards with gaps between them are no room: they are viewed like other things, not through the open side. */
static void check_boards(void)
{
    const lmb_vec3 half[3] = {mul3(X, 2), mul3(Y, 1.5f), mul3(Z, 2)};
    world_begin(0.5f, 0.5f, 0.5f);
    for (int i = 0; i < 5; ++i) {
        const lmb_vec3 out = i & 1 ? half[i / 2] : mul3(half[i / 2], -1.0f);
        world_quad(out, mul3(half[(i / 2 + 1) % 3], 0.65f), mul3(half[(i / 2 + 2) % 3], 0.65f));
    }
    const lmb_vec3 back = seen_from();
    CHECK_MSG(back.x > 0.4f, "boards: from %g, %g, %g", (double)back.x, (double)back.y, (double)back.z);
}

/* A wall closes a side of the bounds if it is within a fiftieth of their size from this side. If it is farther in, the
 * room counts as open there and is viewed through this side. */
static void check_niche(void)
{
    static const float deep[2] = {0.015f, 0.025f};
    for (int i = 0; i < 2; ++i) {
        room_without(1);
        world_quad(vec3(2.0f - 4.0f * deep[i], 0, 0), mul3(Y, 1.5f), mul3(Z, 2));
        const lmb_vec3 back = seen_from();
        CHECK_MSG(i == 0 ? back.x < 0.6f : back.x > 0.8f, "a wall %g deep: from %g, %g, %g", (double)deep[i],
                  (double)back.x, (double)back.y, (double)back.z);
    }
}

/* If a corner is far outside or not finite, its triangles are not visible: the rest is framed as without them. */
static void check_strays(void)
{
    static const float strays[3] = {1e10f, -INFINITY, NAN};
    for (int i = 0; i < 3; ++i) {
        view_options o = options_of(WIDTH, HEIGHT);
        report r = {0};
        lmb_view v;
        memset(&v, 0, sizeof v);
        world_begin(0.5f, 0.5f, 0.5f);
        box_at(vec3(0, 0, 0), 1, 1, 1);
        world_quad(vec3(0, strays[i], 0), X, Z);
        CHECK(world_end() == LMB_OK);
        world.count -= 2; /* excluded from reach_in and check_framed */
        check_framed("a cube and strays", 0.3);
        world_begin(0.5f, 0.5f, 0.5f);
        world_quad(vec3(strays[i], 0, 0), X, Z);
        world_triangle(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 0, strays[i]));
        world_end();
        CHECK(!view_frame(&v, &o, &world.scene, "it", &r));
    }
}

void test_view_frame(void)
{
    check_shapes();
    check_size(1, 1, 1, 640);
    check_size(1, 3, 1, 240);
    check_size(1, 5, 1, 160);
    check_size(5, 1, 2, 960);
    check_size(5, 0.5f, 1, 1440);
    check_rooms();
    check_sides();
    check_boards();
    check_niche();
    check_strays();
}
