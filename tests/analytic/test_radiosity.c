/* test_radiosity.c: many bounces in closed rooms, and emitting surfaces, against conservation of energy.
 *
 * In a closed room with reflectance rho everywhere, the walls reflect P rho^k of a light's power P at the k-th
 * reflection; N reflections sum to P rho (1 - rho^N) / (1 - rho). If all walls emit radiance L, every point has the
 * same radiance: with N reflections it is L (1 - rho^(N + 2)) / (1 - rho) everywhere, which includes emission and
 * direct light; with the remaining reflections it is L / (1 - rho). Sealed parts stay dark. */
enum { FRAME = 16, MAP = 64, FACES = 6, ELEMENTS = 4096, BVH = 64, BOUNCES = 12 };

#include "../bounce_frame.h"
#include "facing.h"

void test_radiosity(void);

static const float rho = 0.5f;

static int32_t truncated = 1;

/* Light at single points uses a coarser rule for sums. */
static int is_live;
static double bound(double of_cuts, double of_points) { return is_live ? of_points : of_cuts; }

#if LMB_LIVE
static uint64_t live_memory[FACES * MAP * MAP / 16 * 46 + ELEMENTS * 31 + 2048];
static uint64_t lattice_memory[FRAME * FRAME / 64 * 192];
static lmb_live live;
static lmb_live_scratch live_scratch;

static void ask_live(lmb_frame *f)
{
    const int32_t side = lmb_live_side(FACES, MAP);
    CHECK(lmb_lattice_init(&f->lattice, FRAME, FRAME, lattice_memory, sizeof lattice_memory) == LMB_OK);
    CHECK(lmb_live_init(&live, FACES, side, ELEMENTS, live_memory, sizeof live_memory) == LMB_OK);
    f->gather_step = LMB_GATHER_LIVE;
    f->live = &live;
    scratch.live = &live_scratch;
}
#endif

static void draw_wide(lmb_vec3 from, lmb_vec3 to, double fov_deg, int32_t show, int32_t bounces)
{
    const lmb_view view = look(from, to, fov_deg, FRAME);
    lmb_frame f = bounce_frame(&view, bounces);
    f.show = show;
    f.truncated = truncated;
    f.error = f.visibility = 0.005f; /* compared with exact energy, not with a cut */
#if LMB_LIVE
    if (is_live) {
        ask_live(&f);
    }
#endif
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
}

static void draw(lmb_vec3 from, lmb_vec3 to, int32_t show, int32_t bounces)
{
    draw_wide(from, to, 75, show, bounces);
}

static void add_irradiance(int material, float radiance)
{
    for (int c = 0; c < 3; ++c) {
        world.material[material].emission[c] = radiance * (float)(c + 1);
    }
}

/* --- emitting walls ----------------------------------------------------------------------------------------------- */

static void check_furnace(int32_t bounces)
{
    const double want = 3.0 * (1.0 - (truncated ? pow((double)rho, bounces + 2) : 0.0)) / (1.0 - (double)rho);
    double max = 0.0, mean = 0.0;
    world_begin(rho, rho, rho);
    world_box(vec3(0.3f, -0.1f, 0.2f), 1.0f);
    add_irradiance(0, 3.0f);
    CHECK(world_end() == LMB_OK);
    draw(vec3(-0.3f, 0.5f, 0.7f), vec3(0.9f, -0.8f, -0.4f), LMB_SHOW_FULL, bounces);
    for (int i = 0; i < FRAME * FRAME * 3; ++i) {
        const double off = (double)picture[i] / (want * (i % 3 + 1)) - 1.0;
        max = fmax(max, fabs(off));
        mean += off / (FRAME * FRAME * 3);
    }
    printf("  walls that emit%s, %2d bounces%s: %+.3f %% in the mean, %.3f %% off at most\n", is_live ? ", live" : "",
           (int)bounces, truncated ? "" : " and the rest", mean * 100, max * 100);
    CHECK_MSG(max < bound(0.01, 0.005) && fabs(mean) < 0.003, "%d bounces: %g, %g", (int)bounces, mean, max);
}

/* --- an emitting panel -------------------------------------------------------------------------------------------- */

/* A unit square at height h emits light down on another, without lights. The view is centred, so the result does not
 * depend on the orientation of pictures: E = pi L F. */
static void check_panel(double h)
{
    const double eye = 0.4 * h, half = 0.45;
    double max = 0.0, mean = 0.0;
    world_begin(rho, rho, rho);
    world_quad(vec3(0.5f, 0, 0.5f), vec3(0, 0, 0.5f), vec3(0.5f, 0, 0));
    world_part();
    world_quad(vec3(0.5f, (float)h, 0.5f), vec3(0.5f, 0, 0), vec3(0, 0, 0.5f));
    world.material[1].flags = 0;
    add_irradiance(1, 2.0f);
    CHECK(world_end() == LMB_OK);
    draw_wide(vec3(0.5f, (float)eye, 0.5f), vec3(0.5f, 0, 0.5f), 2.0 * atan(half / eye) * 180.0 / PI,
              LMB_SHOW_IRRADIANCE, 1);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        const double x = 0.5 + half * ((i % FRAME + 0.5) / FRAME * 2.0 - 1.0),
                     z = 0.5 + half * ((i / FRAME + 0.5) / FRAME * 2.0 - 1.0);
        const double off = (double)picture[3 * i + 1] / (PI * 4.0 * parallel_factor(x, z, h)) - 1.0;
        max = fmax(max, fabs(off));
        mean += off / (FRAME * FRAME);
    }
    printf("  panel%s at height %-4g %+.3f %% in the mean, %.3f %% off at most\n", is_live ? ", live" : "", h, mean * 100,
           max * 100);
    /* Light between samples 8 px apart is interpolated from four of them; with 16 px the error shows. */
    CHECK_MSG(max < bound(0.01, 0.3) && fabs(mean) < bound(0.01, 0.005), "height %g: %g, %g", h, mean, max);
}

/* --- a point light in a room -------------------------------------------------------------------------------------- */

/* A point, or a panel on the ceiling; 4 pi W a channel. */
enum { POINT, PANEL };

/* With or without a closed block that intersects the floor and a wall. */
static void make_room(int source, int block)
{
    static lmb_light light;
    light = point_light(vec3(0.2f, 0.5f, -0.1f));
    light.intensity[0] = light.intensity[1] = light.intensity[2] = 1.0f;
    world_begin(rho, rho, rho);
    world_box(vec3(0, 0, 0), 1.0f);
    if (block) {
        world_box(vec3(0.7f, -0.8f, -0.3f), 0.35f);
    }
    if (source == POINT) {
        world.scene.lights = &light;
        world.scene.light_count = 1;
    } else {
        world_part();
        world_quad(vec3(-0.2f, 0.999f, 0), vec3(0.5f, 0, 0), vec3(0, 0, 0.5f));
        world.material[1].flags = 0;
        world.material[1].emission[0] = 4.0f;
    }
    CHECK(world_end() == LMB_OK);
}

/* Light received by all elements; W, one channel. Excludes direct light of lights. */
static double received(void)
{
    const lmb_elements *e = &render.frame.elements;
    double sum = 0.0;
    for (uint32_t i = 0; i < e->count; ++i) {
        sum += (double)e->data[i].received[0] * (double)e->data[i].area;
    }
    return sum;
}

static void check_room(int source, int block, int32_t bounces)
{
    const double r = (double)rho, left = !truncated ? 0.0 : pow(r, source == POINT ? bounces - 1 : bounces),
                 want = 4.0 * PI * (source == POINT ? r : 1.0) * (1.0 - left) / (1.0 - r);
    make_room(source, block);
    draw(vec3(0.8f, 0.8f, 0.8f), vec3(0, -0.5f, -0.3f), LMB_SHOW_IRRADIANCE, bounces);
    printf("  %s in a room%s%s, %2d bounces%s: %.4f of its energy\n", source == POINT ? "point light" : "panel",
           is_live ? ", live" : "", block ? " with a block" : "", (int)bounces, truncated ? "" : " and the rest", received() / want);
    CHECK_MSG(fabs(received() / want - 1.0) < bound(0.01, 0.03), "%d bounces: %g", (int)bounces, received() / want);
}

/* The total light does not depend on the number of bounces that are computed separately. */
static void check_rest(void)
{
    truncated = 0;
    check_furnace(2);
    check_furnace(3);
    check_room(POINT, 0, 2);
    check_room(POINT, 0, 4);
    check_room(POINT, 1, 4);
    check_room(PANEL, 1, 4);
    truncated = 1;
}

/* White walls never absorb light, so the remainder covers only the maximum number of bounces of a frame. */
static void check_white(void)
{
    lmb_elements *e = &render.frame.elements;
    make_room(POINT, 0);
    for (int c = 0; c < 3; ++c) {
        world.material[0].albedo[c] = 1.0f;
    }
    truncated = 0;
    draw(vec3(0.8f, 0.8f, 0.8f), vec3(0, -0.5f, -0.3f), LMB_SHOW_IRRADIANCE, 3);
    truncated = 1;
    const double all = received() / (4.0 * PI);
    printf("  point light in a white room, 3 bounces and the rest: %.2f times what it gives, of %d\n", all,
           (int)LMB_MAX_BOUNCES - 1);
    CHECK_MSG(all > 0.7 * (LMB_MAX_BOUNCES - 1) && all < 1.01 * (LMB_MAX_BOUNCES - 1), "%g", all);
    CHECK(lmb_elements_rest(NULL, NULL, 1) == LMB_ERR_ARG && lmb_elements_rest(e, NULL, -1) == LMB_ERR_ARG);
    CHECK(lmb_elements_rest(e, NULL, LMB_MAX_BOUNCES + 1) == LMB_ERR_ARG);
    CHECK(lmb_elements_rest(e, NULL, 0) == LMB_OK && received() / (4.0 * PI) == all);
}

static int is_in_block(lmb_vec3 p)
{
    return absf(p.x - 0.7f) < 0.3501f && absf(p.y + 0.8f) < 0.3501f && absf(p.z + 0.3f) < 0.3501f;
}

/* Sides facing into the block, parts of the room inside the block, and sides facing out of the room all stay
 * dark. The panel is the light, because a light's map may see a little under the block's edge: snapping moves
 * texels by a 256th of their size. */
static void check_sealed(void)
{
    const lmb_elements *e = &render.frame.elements;
    double inside = 0.0, outside = 0.0;
    int count = 0, out_count = 0;
    for (uint32_t i = 0; i < e->count; ++i) {
        const lmb_element *p = &e->data[i];
        const lmb_vec3 at = mul3(add3(add3(p->corner[0], p->corner[1]), p->corner[2]), 1.0f / 3.0f);
        const uint32_t side = p->key >> 27;
        const float off[3] = {at.x, at.y, at.z}, way = side & 1 ? -1.0f : 1.0f;
        float ahead[3] = {at.x, at.y, at.z};
        ahead[side / 2] += 0.001f * way;
        if (is_in_block(vec3(ahead[0], ahead[1], ahead[2]))) {
            inside += (double)p->received[0];
            ++count;
        } else if (off[side / 2] * way > 0.9999f) {
            outside += (double)p->received[0];
            ++out_count;
        }
    }
    CHECK_MSG(count > 30 && inside == 0.0, "%d elements in the block received %g", count, inside);
    CHECK_MSG(out_count > 300 && outside == 0.0, "%d elements outside received %g", out_count, outside);
}

void test_radiosity(void)
{
    if (LMB_MAX_CUT < 8192) {
        SKIP("radiosity: cuts of %d nodes are too coarse for 1 %%", LMB_MAX_CUT);
        return;
    }
    check_furnace(1);
    check_furnace(BOUNCES);
    check_panel(2.0);
    check_panel(1.0);
    check_panel(0.3);
    check_panel(0.05);
    check_room(POINT, 0, 2);
    check_room(POINT, 0, BOUNCES);
    check_room(POINT, 1, BOUNCES);
    check_room(PANEL, 0, 1);
    check_room(PANEL, 0, BOUNCES);
    check_room(PANEL, 1, BOUNCES);
    check_sealed();
    check_rest();
    check_white();
#if LMB_LIVE
    is_live = 1;
    check_furnace(1);
    check_furnace(BOUNCES);
    check_panel(1.0);
    check_panel(0.3);
    check_room(POINT, 0, 2);
    check_room(POINT, 0, BOUNCES);
    check_room(POINT, 1, BOUNCES);
    check_room(PANEL, 0, 1);
    check_room(PANEL, 1, BOUNCES);
    check_sealed();
    check_rest();
    is_live = 0;
#endif
}
