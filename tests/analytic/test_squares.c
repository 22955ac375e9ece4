/* test_squares.c: light between two unit squares, against Howell's closed forms. [V27]
 *
 * Form factors of a surface element (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3 and B-5):
 * over a corner of a parallel rectangle: see facing.h; and at distance c from the edge of a perpendicular rectangle
 * that extends b along that edge from the element and has height a, with X = a/b, Y = c/b:
 *   F = 1/(2 pi) (atan(1/Y) - Y/sqrt(X2+Y2) atan(1/sqrt(X2+Y2)))
 * Rectangles that do not begin at the element are sums and differences of such rectangles. */
#include "facing.h"

void test_squares(void);

enum { CUTS = 32, BLOCK = 4 }; /* discs along the emitter's side; discs along a group's side */

/* --- closed forms ------------------------------------------------------------------------------------------------- */

static double upright_corner(double b, double c)
{
    double x = 1.0 / b, y = c / b, r = sqrt(x * x + y * y);
    return (atan(1 / y) - y / r * atan(1 / r)) / (2 * PI);
}

/* From a floor point (x, z), 0 <= x <= 1, to the vertical unit square on z = 0. */
static double upright_factor(double x, double z)
{
    return (x > 0 ? upright_corner(x, z) : 0.0) + (x < 1 ? upright_corner(1 - x, z) : 0.0);
}

/* --- the emitter -------------------------------------------------------------------------------------------------- */

static lmb_point discs[CUTS * CUTS];
static lmb_points points;
static lmb_groups groups;
static lmb_gather_scratch scratch;

/* A unit square of radiosity 1 from `corner` along u and v, as BLOCK x BLOCK discs a group; it emits along `axis`. */
static void make_emitter(lmb_vec3 corner, lmb_vec3 u, lmb_vec3 v, lmb_vec3 axis)
{
    const float side = 1.0f / (float)CUTS, group_side = side * (float)BLOCK;
    memset(&points, 0, sizeof points);
    memset(&groups, 0, sizeof groups);
    points.data = discs;
    points.cap = CUTS * CUTS;
    for (int g = 0; g < (CUTS / BLOCK) * (CUTS / BLOCK); ++g) {
        int gx = g % (CUTS / BLOCK), gy = g / (CUTS / BLOCK), k = groups.count++;
        lmb_vec3 at =
            add3(corner, add3(mul3(u, ((float)gx + 0.5f) * group_side), mul3(v, ((float)gy + 0.5f) * group_side)));
        set_group(&groups, k, at, axis, group_side * group_side, group_side * 0.70710678f);
        groups.flux[0][k] = groups.flux[1][k] = groups.flux[2][k] = group_side * group_side;
        groups.first[k] = points.count;
        groups.members[k] = BLOCK * BLOCK;
        for (int i = 0; i < BLOCK * BLOCK; ++i) {
            float x = ((float)(gx * BLOCK + i % BLOCK) + 0.5f) * side,
                  y = ((float)(gy * BLOCK + i / BLOCK) + 0.5f) * side;
            set_disc(&points.data[points.count++], add3(corner, add3(mul3(u, x), mul3(v, y))), axis,
                     mul3(u, 0.5f * side), mul3(v, 0.5f * side), side * side);
        }
    }
}

/* Receivers: 64 points over the unit square y = 0, facing up. */
static void make_tile(lmb_tile *tile)
{
    memset(tile, 0, sizeof *tile);
    tile->hits = LMB_TILE_PIXELS;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        tile->position[0][k] = ((float)(k % 8) + 0.5f) / 8.0f;
        tile->position[2][k] = ((float)(k / 8) + 0.5f) / 8.0f;
        tile->normal[1][k] = tile->face[1][k] = 1.0f;
        tile->depth[k] = 1.0f;
        tile->id[k] = 1;
    }
}

static void gather(lmb_irradiance *out, const lmb_tile *tile)
{
    memset(out, 0, sizeof *out);
    CHECK(lmb_gather_tile(out, picked_kernels(), &scratch, tile, &groups, &points, NULL) == LMB_OK);
}

static void judge(const char *name, double where, double worst, double mean, double bound)
{
    printf("  %s %-6g worst %.4f %%, mean %.4f %%\n", name, where, worst * 100, mean * 100);
    CHECK_MSG(worst < bound, "%s %g: %g", name, where, worst);
}

/* Irradiance from a square of radiosity 1 equals the form factor: E = pi L F, and L = 1 / pi. */
static void check_facing(double height, double bound)
{
    lmb_tile tile;
    lmb_irradiance e;
    double worst = 0.0, mean = 0.0;
    make_tile(&tile);
    make_emitter(vec3(0, (float)height, 0), vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));
    gather(&e, &tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double want = parallel_factor((double)tile.position[0][k], (double)tile.position[2][k], (double)(float)height);
        double off = fabs((double)e.rgb[1][k] / want - 1.0);
        worst = fmax(worst, off);
        mean += off / LMB_TILE_PIXELS;
    }
    judge("facing squares, distance", height, worst, mean, bound);
}

/* Receivers in rows parallel to the shared edge, the nearest at `nearest`. */
static void check_upright(double nearest, double bound)
{
    lmb_tile tile;
    lmb_irradiance e;
    double worst = 0.0, mean = 0.0;
    make_tile(&tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        tile.position[2][k] = (float)(nearest * pow(1.0 / nearest, k / 8 / 7.0));
    }
    make_emitter(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
    gather(&e, &tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double want = upright_factor((double)tile.position[0][k], (double)tile.position[2][k]);
        double off = fabs((double)e.rgb[1][k] / want - 1.0);
        worst = fmax(worst, off);
        mean += off / LMB_TILE_PIXELS;
    }
    judge("upright squares, nearest", nearest, worst, mean, bound);
}

/* Square to square: facing at distance 1: 0.199825; with a shared edge: 0.200044 (Howell, C-11 and C-14). */
static double mean_over_floor(void)
{
    double sum = 0.0;
    for (int t = 0; t < 64; ++t) {
        lmb_tile tile;
        lmb_irradiance e;
        make_tile(&tile);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            tile.position[0][k] = ((float)(t % 8 * 8 + k % 8) + 0.5f) / 64.0f;
            tile.position[2][k] = ((float)(t / 8 * 8 + k / 8) + 0.5f) / 64.0f;
        }
        gather(&e, &tile);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            sum += (double)e.rgb[0][k] / 4096.0;
        }
    }
    return sum;
}

/* Only the near formula: a whole square as one quad. */
static void check_quad(void)
{
    double worst = 0.0;
    for (int i = 0; i < 64; ++i) {
        double x = (i % 8 + 0.5) / 8, z = (i / 8 + 0.5) / 8;
        lmb_vec3 at = vec3((float)x, 0, (float)z), up = vec3(0, 1, 0);
        double facing = (double)lmb_quad_factor(at, up, up, vec3(0.5f, 0.25f, 0.5f), vec3(0, -1, 0), vec3(0.5f, 0, 0),
                                                vec3(0, 0, 0.5f));
        double upright =
            (double)lmb_quad_factor(at, up, up, vec3(0.5f, 0.5f, 0), vec3(0, 0, 1), vec3(0.5f, 0, 0), vec3(0, 0.5f, 0));
        worst = fmax(worst, fabs(facing / parallel_factor(x, z, 0.25) - 1.0));
        worst = fmax(worst, fabs(upright / upright_factor(x, z) - 1.0));
    }
    printf("  one quad: worst %.1e\n", worst);
    CHECK_MSG(worst < 1e-5, "%g", worst);
}

/* The bounds are widest at receivers 2 to 3 half-diagonals from a disc: at that distance quads change to the disc's
 * second-order formula, which is 1 to 2 % off, and the grids of receivers and discs are aligned everywhere. */
void test_squares(void)
{
    check_quad();
    check_facing(2.0, 1e-3);
    check_facing(1.0, 1e-3);
    check_facing(0.5, 1e-3);
    check_facing(0.2, 5e-3);
    check_facing(0.1, 8e-3);
    check_facing(0.05, 2e-2);
    check_facing(0.02, 5e-3);
    check_facing(0.005, 1e-3);
    check_upright(0.5, 1e-3);
    check_upright(0.1, 2e-2);
    check_upright(0.02, 2e-2);
    check_upright(0.005, 2e-2);
    make_emitter(vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));
    double facing = mean_over_floor();
    make_emitter(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
    double upright = mean_over_floor();
    printf("  square to square: facing %.6f (0.199825), upright %.6f (0.200044)\n", facing, upright);
    CHECK_MSG(fabs(facing / 0.199825 - 1.0) < 1e-3, "%g", facing);
    CHECK_MSG(fabs(upright / 0.200044 - 1.0) < 5e-3, "%g", upright);
}
