/* test_cut.c: each tile's cut of the light tree, against a sum over all texels. [V25 V27 V28] */
#include <stdlib.h>

#include "../every_texel.h"
#include "../lit_tree.h"

void test_cut(void);

enum { FRAME = 40, BANDS = FRAME / LMB_TILE, PIXELS = FRAME * FRAME };

static uint32_t depth_memory[PIXELS], id_memory[PIXELS], bvh_memory[1 << 16];
static lmb_target eye;
static lmb_tile tile;

static lmb_stats stats;

/* Followed by a canary. */
static struct {
    lmb_cut it;
    uint8_t after[64];
} cut;

static void begin_cut(void)
{
    memset(&cut, 0x5a, sizeof cut);
    memset(&stats, 0, sizeof stats);
}

static int canary_stays(void)
{
    int good = 1;
    for (size_t i = 0; i < sizeof cut.after; ++i) {
        good &= cut.after[i] == 0x5a;
    }
    return good;
}

static lmb_cut_params cut_params_of(float error, const lmb_bvh *bvh)
{
    lmb_cut_params c;
    memset(&c, 0, sizeof c);
    c.error = error;
    c.visibility = 0.02f;
    c.bvh = bvh;
    c.stats = &stats;
    return c;
}

static void gather(lmb_irradiance *out, const lmb_cut_params *how)
{
    memset(out, 0, sizeof *out);
    CHECK(lmb_gather_cut(out, picked_kernels(), &cut.it, &tile, &lit, how) == LMB_OK);
}

/* --- rooms -------------------------------------------------------------------------------------------------------- */

static lmb_vec3 random_point(test_rng *r, float half)
{
    const float x = test_uniform(r, -half, half), y = test_uniform(r, -half, half);
    return vec3(x, y, test_uniform(r, -half, half));
}

/* A closed room of 2 m a side with boxes, a ball, and plates anywhere. */
static void make_room(test_rng *r)
{
    world_begin(0.6f, 0.4f, 0.2f);
    world_box(vec3(0, 0, 0), 1.0f);
    for (int i = 0; i < 3; ++i) {
        const float half = test_uniform(r, 0.1f, 0.3f);
        world_box(random_point(r, 0.7f), half);
        const lmb_vec3 u = normalize3(random_point(r, 1.0f)), v = normalize3(cross3(u, random_point(r, 1.0f)));
        world_quad(random_point(r, 0.8f), mul3(u, 0.3f), mul3(v, 0.2f));
    }
    world_sphere(random_point(r, 0.6f), 0.25f, 12, 24);
    CHECK(world_end() == LMB_OK);
}

static lmb_light room_light(test_rng *r, int kind)
{
    const lmb_vec3 at = random_point(r, 0.8f);
    return kind % 3 == 0 ? spot(at, sub3(random_point(r, 0.5f), at), 20, 45)
                         : kind % 3 == 1 ? point_light(at) : spot(at, sub3(random_point(r, 0.5f), at), 30, 70);
}

static void draw_view(const lmb_view *v)
{
    eye = target_of(LMB_DEPTH32F, FRAME, depth_memory, id_memory);
    world_draw(&eye, v, 0);
}

static void take_tile(const lmb_view *v, int number)
{
    CHECK(lmb_resolve_tile(&tile, picked_kernels(), v, &world.scene, &eye, number % BANDS * LMB_TILE,
                           number / BANDS * LMB_TILE) == LMB_OK);
}

/* --- every texel -------------------------------------------------------------------------------------------------- */

static texel_quad *quads;
static int quad_count;

static void take_quads(void)
{
    quads = realloc(quads, (size_t)lit.faces * (size_t)lit.size * (size_t)lit.size * sizeof *quads + 1);
    quad_count = quads != NULL ? every_texel(quads, &lit) : 0;
}

/* Red light of all texels that pass `sees`, or of all if it is NULL. */
static double sum_quads(int k, int (*sees)(lmb_vec3 from, lmb_vec3 to))
{
    const lmb_vec3 at = plane_vec(tile.position, k);
    double sum = 0.0;
    for (int i = 0; i < quad_count; ++i) {
        const double f = texel_factor(&quads[i], &tile, k);
        if (f > 0.0 && (sees == NULL || sees(at, quads[i].middle))) {
            sum += f * (double)quads[i].n.flux[0];
        }
    }
    return sum;
}

/* --- errors ------------------------------------------------------------------------------------------------------- */

enum { ERRORS = 1 << 16 };

static double got_all[ERRORS], want_all[ERRORS];
static float errors[ERRORS];
static int error_count;

static void add_error(double got, double want)
{
    got_all[error_count] = got;
    want_all[error_count++] = want;
}

static int by_size(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* |got - want| / (want + rest x mean) of the pixels from `first` on, so that rounding in a lit plane, a millionth of
 * the mean, does not count. Sorts all of them. */
static void sort_errors(int first, double rest)
{
    double mean = 0.0;
    for (int i = first; i < error_count; ++i) {
        mean += want_all[i] / (error_count - first);
    }
    for (int i = first; i < error_count; ++i) {
        errors[i] = (float)(fabs(got_all[i] - want_all[i]) / (want_all[i] + rest * mean));
    }
    qsort(errors, (size_t)error_count, sizeof *errors, by_size);
}

/* The error that this share of the pixels does not exceed. */
static double error_at(double share)
{
    return error_count > 0 ? (double)errors[(int)(share * (error_count - 1))] : 0.0;
}

/* W/m2 that count as rounding, against some tenths of light: from texels in the pixel's plane, which cuts omit. */
#define NOTHING 1e-5

/* Without a BVH: the tiles on a view's diagonal, every second one if the cut is conservative. */
static double compare_view(const lmb_view *v, const lmb_cut_params *how)
{
    double pairs = 0.0;
    draw_view(v);
    for (int t = 0; t < BANDS * BANDS; t += (how->conservative ? 2 : 1) * (BANDS + 1)) {
        lmb_irradiance got;
        take_tile(v, t);
        gather(&got, how);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const double want = tile.id[k] != 0 ? sum_quads(k, NULL) : 0.0;
            if (want > NOTHING) {
                add_error((double)got.rgb[0][k], want);
                pairs += quad_count;
            } else {
                CHECK((double)got.rgb[0][k] < 2.0 * NOTHING);
            }
        }
    }
    return pairs;
}

/* V27: with a small share of the texels, 999 of 1,000 pixels are within `error` of the sum over all texels; if
 * conservative, all are. */
static void check_error(float error, int conservative, double bound, double most_share)
{
    double pairs = 0.0;
    error_count = 0;
    begin_cut();
    for (int room = 0; room < (conservative ? 2 : 3); ++room) { /* conservative cuts take ten times as long */
        test_rng r = {(uint64_t)(90 + room)};
        lmb_cut_params how = cut_params_of(error, NULL);
        how.conservative = conservative;
        make_room(&r);
        const lmb_light light = room_light(&r, room);
        lit_begin((uint32_t)lmb_shadow_map_faces(&light, &world.scene), LIT_SMALL / 2, 0);
        lit_add(&light);
        take_quads();
        const lmb_view v = look(mul3(random_point(&r, 1.0f), 0.9f), random_point(&r, 0.3f), 80, FRAME);
        const int first = error_count;
        pairs += compare_view(&v, &how);
        sort_errors(first, conservative ? 1e-6 : 1e-3);
    }
    const double p999 = error_at(0.999), share = (double)stats.pairs / pairs;
    printf("  %s %.2f: p50 %.5f, p99.9 %.5f, most %.5f of %d pixels by %.1f %% of the pairs\n",
           conservative ? "bound" : "error", (double)error, error_at(0.5), p999, error_at(1.0), error_count,
           share * 100.0);
    CHECK(error_count > (conservative ? 200 : 500) && canary_stays());
    CHECK_MSG((conservative ? error_at(1.0) : p999) <= bound, "%g", p999);
    CHECK_MSG(share <= most_share, "%g", share);
}

/* --- a tile by hand ----------------------------------------------------------------------------------------------- */

/* A floor of 8 x 8 pixels, `step` apart, from `at`. */
static void floor_tile(lmb_vec3 at, float step)
{
    memset(&tile, 0, sizeof tile);
    tile.hits = LMB_TILE_PIXELS;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.position, k, add3(at, vec3(step * (float)(k % 8), 0, step * (float)(k / 8))));
        set_plane(tile.normal, k, Y);
        set_plane(tile.face, k, Y);
        tile.id[k] = 1;
    }
}

/* The box of 2 m a side, with walls and ceiling lit from near the centre. */
static void lit_box(void)
{
    const lmb_light light = point_light(vec3(0.1f, 0.2f, 0.3f));
    world_begin(0.6f, 0.4f, 0.2f);
    world_box(vec3(0, 0, 0), 1.0f);
    CHECK(world_end() == LMB_OK);
    lit_by(&light);
}

/* The tile's first 2 x 2 pixels are finite, not negative, and within `bound` of the sum over all texels. */
static void check_sane(const char *what, const lmb_irradiance *got, double bound)
{
    double worst = 0.0;
    int good = canary_stays() && cut.it.count <= LMB_MAX_CUT;
    for (int k = 0; k <= LMB_TILE + 1; k += k == 1 ? LMB_TILE - 1 : 1) {
        const double want = sum_quads(k, NULL);
        worst = fmax(worst, fabs((double)got->rgb[0][k] / want - 1.0));
        good &= want > 0.0 && got->rgb[1][k] > 0.0f && got->rgb[2][k] < 1e3f;
    }
    CHECK_MSG(good && worst <= bound, "%s: %g with %d nodes", what, worst, (int)cut.it.count);
}

/* If the nodes exceed the capacity, the pixels (here four) are halved with separate cuts while that helps. Pixels that
 * still do not fit are lit with the nodes they have and counted. */
static void check_full(void)
{
    lmb_cut_params how = cut_params_of(1e-9f, NULL);
    lmb_irradiance got;
    lmb_bvh b;
    lit_box();
    take_quads();
    CHECK(quad_count > LMB_MAX_CUT);
    CHECK(lmb_bvh_init(&b, world.count, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK);
    floor_tile(vec3(-0.3f, -1, -0.3f), 0.05f);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        tile.id[k] = k % LMB_TILE < 2 && k < 2 * LMB_TILE;
    }
    tile.hits = 4;
    for (int occluded = 0; occluded < 2; ++occluded) {
        begin_cut();
        how.bvh = occluded ? &b : NULL;
        how.visibility = 1e-9f;
        gather(&got, &how);
        CHECK_MSG(stats.full_cuts > 0 && stats.pairs > LMB_MAX_CUT, "%.0f", (double)stats.full_cuts);
        check_sane(occluded ? "full, blocked" : "full", &got, 0.02);
    }
}

/* If a full cut does not meet a conservative bound, and nothing blocks light, every texel lights the pixels. */
static void check_full_bound(void)
{
    lmb_cut_params how = cut_params_of(1e-9f, NULL);
    lmb_irradiance got;
    how.conservative = 1;
    lit_box();
    take_quads();
    floor_tile(vec3(-0.3f, -1, -0.3f), 0.05f);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        tile.id[k] = k % LMB_TILE < 2 && k < 2 * LMB_TILE;
    }
    tile.hits = 4;
    begin_cut();
    gather(&got, &how);
    CHECK_MSG(stats.full_cuts > 0 && stats.pairs >= 4 * (uint64_t)quad_count, "%.0f full, %.0f pairs, %d quads",
              (double)stats.full_cuts, (double)stats.pairs, quad_count);
    check_sane("full, bounded", &got, 1e-5);
}

/* A small error uses as many nodes as needed, up to the capacity. */
static void check_many_nodes(void)
{
    const lmb_cut_params how = cut_params_of(1e-4f, NULL);
    lmb_irradiance got;
    lit_box();
    begin_cut();
    floor_tile(vec3(-0.3f, -1, -0.3f), 0.003f);
    gather(&got, &how);
    CHECK_MSG(cut.it.count > (LMB_MAX_CUT < 2048 ? LMB_MAX_CUT / 2 : 1024) && (LMB_MAX_CUT < 2048 || stats.full_cuts == 0),
              "%d nodes", (int)cut.it.count);
}

/* At the end of a cut no node can be divided, or there is no room, or the root of the summed squared errors is below
 * `error` of the nodes' light. This holds on a lit wall too, where nodes that contain the tile can give any amount. */
static void check_promise(void)
{
    static const float places[][3] = {{-0.3f, -1, -0.3f}, {-0.999f, -0.999f, -0.999f}, {0.5f, 0.99f, 0.5f}};
    const lmb_cut_params how = cut_params_of(0.02f, NULL);
    lmb_irradiance got;
    lit_box();
    for (int p = 0; p < 9; ++p) {
        double error = 0.0, value = 0.0;
        begin_cut();
        floor_tile(vec3(places[p / 3][0], places[p / 3][1], places[p / 3][2]),
                   p % 3 == 0 ? 0.0001f : 0.003f * (float)p);
        gather(&got, &how);
        for (int32_t i = 0; i < cut.it.count; ++i) {
            const int is_node = cut.it.ref[i].level != 0xffff;
            const double e = is_node && cut.it.visible[i] != 0 ? (double)cut.it.of.error[i] : 0.0;
            error += e * e;
            value += is_node ? (double)cut.it.value[i] : 0.0;
        }
        error = sqrt(error);
        CHECK_MSG(value > 0.0 && error <= 0.02 * 1.000001 * value, "tile %d: %g of %g", p, error, value);
        CHECK(cut.it.count + 3 <= LMB_MAX_CUT && stats.segments == 0);
        CHECK(stats.pairs > 0 && stats.pairs <= LMB_TILE_PIXELS * (uint64_t)cut.it.count);
    }
}

/* Twice the light gives exactly twice the result. */
static void check_linear(void)
{
    const lmb_cut_params how = cut_params_of(0.02f, NULL);
    lmb_irradiance once, twice;
    int wrong = 0;
    lit_box();
    floor_tile(vec3(-0.3f, -1, -0.3f), 0.05f);
    gather(&once, &how);
    for (int32_t i = 0; i < (int32_t)lit.faces * lit.size * lit.size; ++i) {
        for (int c = 0; c < 3; ++c) {
            lit.texel[i].flux[c] *= 2.0f;
        }
    }
    for (uint32_t f = 0; f < lit.faces; ++f) {
        lit_sum(f);
    }
    gather(&twice, &how);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        wrong += !(once.rgb[0][k] > 0.0f) || twice.rgb[0][k] != 2.0f * once.rgb[0][k];
    }
    CHECK_MSG(wrong == 0, "%d pixels not exactly doubled", wrong);
}

static int is_dark(const lmb_irradiance *e)
{
    int dark = 1;
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        dark &= e->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] == 0.0f;
    }
    return dark;
}

/* No face, a face without light, one lit texel, and a tile without a surface. The result is added to the output. */
static void check_small(void)
{
    const lmb_cut_params how = cut_params_of(0.02f, NULL);
    lmb_irradiance got, more;
    lit_box();
    floor_tile(vec3(-0.3f, -1, -0.3f), 0.05f);
    const uint32_t faces = lit.faces;
    lit.faces = 0;
    gather(&got, &how);
    CHECK(is_dark(&got) && cut.it.count == 0);
    lit.faces = faces;
    const lmb_texel kept = lit.texel[3 * LIT_SMALL * LIT_SMALL - 7];
    for (int32_t i = 0; i < (int32_t)faces * lit.size * lit.size; ++i) {
        memset(lit.texel[i].flux, 0, sizeof lit.texel[i].flux);
    }
    for (int lights = 0; lights < 2; ++lights) { /* a texel of the ceiling */
        for (uint32_t f = 0; f < faces; ++f) {
            lit_sum(f);
        }
        take_quads();
        gather(&got, &how);
        CHECK(quad_count == lights && is_dark(&got) == !lights);
        for (int k = 0; k < LMB_TILE_PIXELS && lights; ++k) {
            CHECK(fabs((double)got.rgb[0][k] - sum_quads(k, NULL)) <= 1e-6 * sum_quads(k, NULL));
        }
        lit.texel[3 * LIT_SMALL * LIT_SMALL - 7] = kept;
    }
    more = got;
    CHECK(lmb_gather_cut(&more, picked_kernels(), &cut.it, &tile, &lit, &how) == LMB_OK);
    CHECK(more.rgb[0][9] == got.rgb[0][9] + got.rgb[0][9]);
    memset(tile.id, 0, sizeof tile.id);
    gather(&got, &how);
    CHECK(is_dark(&got));
}

static void check_refused(void)
{
    lmb_cut_params how = cut_params_of(0.02f, NULL);
    lmb_irradiance out;
    lmb_tree none = lit;
    const lmb_kernels *k = picked_kernels();
    none.texel = NULL;
    memset(&out, 0, sizeof out);
    CHECK(lmb_gather_cut(NULL, k, &cut.it, &tile, &lit, &how) == LMB_ERR_ARG);
    CHECK(lmb_gather_cut(&out, NULL, &cut.it, &tile, &lit, &how) == LMB_ERR_ARG);
    CHECK(lmb_gather_cut(&out, k, NULL, &tile, &lit, &how) == LMB_ERR_ARG);
    CHECK(lmb_gather_cut(&out, k, &cut.it, NULL, &lit, &how) == LMB_ERR_ARG);
    CHECK(lmb_gather_cut(&out, k, &cut.it, &tile, NULL, &how) == LMB_ERR_ARG);
    CHECK(lmb_gather_cut(&out, k, &cut.it, &tile, &none, &how) == LMB_ERR_ARG);
    CHECK(lmb_gather_cut(&out, k, &cut.it, &tile, &lit, NULL) == LMB_ERR_ARG);
    how.error = 0.0f;
    CHECK(lmb_gather_cut(&out, k, &cut.it, &tile, &lit, &how) == LMB_ERR_ARG);
    how = cut_params_of(0.02f, NULL);
    how.visibility = -1.0f;
    CHECK(lmb_gather_cut(&out, k, &cut.it, &tile, &lit, &how) == LMB_ERR_ARG);
    CHECK(is_dark(&out));
}

/* --- a wall with a door ------------------------------------------------------------------------------------------- */

/* At x = 0, between the walls, open for z in DOOR_LOW .. DOOR_HIGH. */
#define DOOR_LOW  -0.1f
#define DOOR_HIGH 0.3f

static void make_rooms(void)
{
    world_begin(0.6f, 0.4f, 0.2f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_quad(vec3(0, 0, 0.5f * (DOOR_LOW - 1.1f)), mul3(Y, 1.1f), mul3(Z, 0.5f * (DOOR_LOW + 1.1f)));
    world_quad(vec3(0, 0, 0.5f * (DOOR_HIGH + 1.1f)), mul3(Y, 1.1f), mul3(Z, 0.5f * (1.1f - DOOR_HIGH)));
    CHECK(world_end() == LMB_OK);
}

/* z at which a segment from x > 0 to x < 0 crosses the wall. */
static float passes(lmb_vec3 from, lmb_vec3 to) { return from.z + (to.z - from.z) * from.x / (from.x - to.x); }

static float door_wider; /* m, on both sides */

static int through_door(lmb_vec3 from, lmb_vec3 to)
{
    const float z = passes(from, to);
    return z > DOOR_LOW - door_wider && z < DOOR_HIGH + door_wider;
}

typedef struct door_figures {
    int dark, leaks;
    double sum_got, sum_want; /* over the pixels that see light */
} door_figures;

static void compare_door(door_figures *d, const lmb_irradiance *got)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile.id[k] == 0 || tile.position[0][k] < 1e-3f) {
            continue;
        }
        door_wider = 1e-5f;
        if (sum_quads(k, through_door) == 0.0) {
            ++d->dark;
            d->leaks += got->rgb[0][k] != 0.0f;
        } else {
            door_wider = 0.0f;
            add_error((double)got->rgb[0][k], sum_quads(k, through_door));
            d->sum_got += got_all[error_count - 1];
            d->sum_want += want_all[error_count - 1];
        }
    }
}

/* V25, V26: light only in the room at x < 0, viewed from the other room. Pixels that see no lit texel are exactly dark;
 * the others have the light of the texels they see, except that a node is visible or not as a whole. */
static void check_door(float visibility, double p95)
{
    const lmb_light light = spot(vec3(-0.3f, 0.2f, 0.1f), vec3(-1, -0.5f, 0.1f), 20, 45);
    const lmb_view v = look(vec3(0.95f, 0.6f, -0.8f), vec3(0.2f, -0.7f, 0.3f), 90, FRAME);
    lmb_cut_params how = cut_params_of(0.02f, NULL);
    door_figures d = {0, 0, 0.0, 0.0};
    lmb_bvh b;
    int beyond = 0;
    make_rooms();
    lit_begin(1, LIT_SMALL / 2, 0);
    lit_add(&light);
    take_quads();
    for (int i = 0; i < quad_count; ++i) {
        beyond += quads[i].middle.x >= -1e-3f;
    }
    CHECK(lmb_bvh_init(&b, world.count, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK);
    how.bvh = &b;
    how.visibility = visibility;
    draw_view(&v);
    begin_cut();
    error_count = 0;
    for (int t = 0; t < BANDS * BANDS; ++t) {
        lmb_irradiance got;
        take_tile(&v, t);
        gather(&got, &how);
        compare_door(&d, &got);
    }
    sort_errors(0, 1e-2);
    const double mean = d.sum_got / d.sum_want;
    printf("  door, visibility %.3f: %d pixels dark, %d leak; %d lit: p50 %.4f, p95 %.4f, p99.9 %.4f, mean %.4f; %.0f "
           "segments a pixel\n",
           (double)visibility, d.dark, d.leaks, error_count, error_at(0.5), error_at(0.95), error_at(0.999), mean,
           (double)stats.segments / PIXELS);
    CHECK(beyond == 0 && canary_stays());
    CHECK_MSG(d.dark > 300 && d.leaks == 0, "%d of %d", d.leaks, d.dark);
    CHECK_MSG(error_count > 300 && error_at(0.95) <= p95, "%g", error_at(0.95));
    CHECK_MSG(fabs(mean - 1.0) <= 0.01, "%g", mean);
}

/* Tiles of a row share tests: a tile is exact while earlier ones saved enough, and is coarse and cheap if they borrowed
 * too much. By default a tile adds 4.4 million tests and may borrow five times as many. */
static void check_row(void)
{
    enum { MEAN = 4369066 /* 65,536 / .015f */, LONG_AGO = 1 << 20 };
    const lmb_light light = spot(vec3(-0.3f, 0.2f, 0.1f), vec3(-1, -0.5f, 0.1f), 20, 45);
    const lmb_view v = look(vec3(0.95f, 0.6f, -0.8f), vec3(0.2f, -0.7f, 0.3f), 90, FRAME);
    lmb_cut_params how = cut_params_of(0.001f, NULL);
    lmb_irradiance own, got;
    lmb_bvh b;
    uint32_t most = 0;
    int busiest = 0;
    make_rooms();
    lit_begin(1, LIT_SMALL / 2, 0);
    lit_add(&light);
    CHECK(lmb_bvh_init(&b, world.count, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK);
    how.bvh = &b;
    how.visibility = 0.015f;
    draw_view(&v);
    begin_cut();
    for (int t = 0; t < BANDS * BANDS; ++t) {
        take_tile(&v, t);
        gather(&got, &how);
        busiest = cut.it.tests > most ? t : busiest;
        most = cut.it.tests > most ? cut.it.tests : most;
    }
    CHECK_MSG(most > 10000, "%u", (unsigned)most);
    take_tile(&v, busiest);
    gather(&own, &how);
    const int64_t start[] = {0, LONG_AGO, -6 * (int64_t)MEAN + 2 * (int64_t)most, -6 * (int64_t)MEAN - LONG_AGO};
    for (int i = 0; i < 4; ++i) {
        int64_t saved = start[i];
        how.saved = &saved;
        gather(&got, &how);
        const int64_t off = saved - (start[i] + MEAN - (int64_t)cut.it.tests);
        CHECK_MSG(off >= -1 && off <= 1, "%d: %.0f", i, (double)off);
        if (i < 3) {
            CHECK_MSG(cut.it.tests == most && cut.it.coarse == 0 && memcmp(&got, &own, sizeof got) == 0, "%d: %u tests", i,
                      (unsigned)cut.it.tests);
        } else {
            CHECK_MSG(cut.it.tests < most / 4 && cut.it.coarse > 0, "%u of %u tests, %u coarse", (unsigned)cut.it.tests,
                      (unsigned)most, (unsigned)cut.it.coarse);
        }
    }
    CHECK(canary_stays());
}

void test_cut(void)
{
    check_row();
    check_error(0.02f, 1, 0.02, 1.0);
    check_error(0.5f, 1, 0.5, 0.7);
    check_error(0.02f, 0, 0.02, 0.12);
    check_error(0.1f, 0, 0.05, 0.09);
    check_full();
    check_full_bound();
    check_many_nodes();
    check_promise();
    check_linear();
    check_small();
    check_refused();
    check_door(0.02f, 0.05);
    check_door(0.002f, 0.006);
    free(quads);
}
