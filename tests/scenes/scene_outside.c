/* scene_outside.c: sun on leaves, land, courts and streets; and a cave. */
#include <stddef.h>

#include "scenes.h"

/* --- leaves ------------------------------------------------------------------------------------------------------- */

/* A leaf: two triangles, folded along the rib. */
static void leaf(made_scene *s, int material, svec where, double size)
{
    svec rib, other;
    do {
        rib = at(any_between(s, -1, 1), any_between(s, -1, 1), any_between(s, -1, 1));
        other = at(any_between(s, -1, 1), any_between(s, -1, 1), any_between(s, -1, 1));
    } while (dot_of(rib, rib) > 1 || dot_of(rib, rib) < 0.1 ||
             dot_of(cross_of(rib, other), cross_of(rib, other)) < 0.05);
    rib = times(unit(rib), size);
    const svec across = times(unit(cross_of(rib, other)), 0.35 * size),
               lift = times(unit(cross_of(across, rib)), 0.1 * size);
    const svec tip = plus(where, rib), middle = plus(where, times(rib, 0.5));
    triangle(s, material, where, plus(middle, plus(across, lift)), tip);
    triangle(s, material, where, tip, plus(middle, less(lift, across)));
}

static void tree(made_scene *s, int leaves, double size)
{
    const int ground = paint(s, 0.45, 0.4, 0.33), green = paint(s, 0.22, 0.5, 0.15), young = paint(s, 0.4, 0.55, 0.15),
              bark = paint(s, 0.3, 0.22, 0.15), white = paint(s, 0.75, 0.73, 0.7);
    panel(s, ground, at(-8, 0, -8), at(16, 0, 0), at(0, 0, 16), NULL, 0);
    panel(s, white, at(-4, 0, -3.5), at(8, 0, 0), at(0, 5, 0), NULL, 0);
    tube(s, bark, at(0, 0, 0), at(0, 2.2, 0), 0.16, 0.1, 10);
    for (int i = 0; i < leaves;) {
        const svec p = at(any_between(s, -1, 1), any_between(s, -1, 1), any_between(s, -1, 1));
        if (dot_of(p, p) <= 1.0) {
            leaf(s, i++ % 3 == 0 ? young : green, at(1.9 * p.x, 2.6 + 1.4 * p.y, 1.9 * p.z), size);
        }
    }
    sun(s, at(any_between(s, -0.5, -0.3), -1, any_between(s, -0.6, -0.4)), 10);
    sun_through(s, at(-4, 0, -3.6), at(4, 5, 4));
    look(s, at(3.4, 1.6, 4.6), at(-0.1, 1.9, 0), 55);
}

void build_foliage(made_scene *s) { tree(s, 2000, 0.22); }

void build_foliage20k(made_scene *s) { tree(s, 20000, 0.09); }

void build_leaves(made_scene *s) { tree(s, 40, 0.9); }

/* Upright blades in front of a wall. */
void build_reeds(made_scene *s)
{
    const int ground = paint(s, 0.5, 0.42, 0.3), green = paint(s, 0.35, 0.5, 0.18), white = paint(s, 0.74, 0.7, 0.66);
    panel(s, ground, at(-4, 0, -3), at(8, 0, 0), at(0, 0, 7), NULL, 0);
    panel(s, white, at(-4, 0, -3), at(8, 0, 0), at(0, 3, 0), NULL, 0);
    for (int i = 0; i < 900; ++i) {
        const double a = any_between(s, 0, 360), wide = any_between(s, 0.01, 0.025), high = any_between(s, 0.8, 1.6);
        const svec foot = at(any_between(s, -2.5, 2.5), 0, any_between(s, -2.2, 0.6));
        const svec side = times(at(cosine(a), 0, sine(a)), wide);
        const svec tip = plus(foot, at(any_between(s, -0.15, 0.15), high, any_between(s, -0.15, 0.15)));
        triangle(s, green, less(foot, side), plus(foot, side), tip);
    }
    sun(s, at(any_between(s, 0.2, 0.5), -1, any_between(s, -0.9, -0.6)), 10);
    sun_through(s, at(-4, 0, -3.1), at(4, 3, 3));
    look(s, at(1.2, 1.5, 3.4), at(0, 0.7, -0.8), 52);
}

/* --- land --------------------------------------------------------------------------------------------------------- */

typedef double land_height(double x, double z, uint32_t seed);

/* A square of `cells` x `cells` around the origin, `side` metres wide. */
static void land(made_scene *s, int low, int high, double border, double side, int cells, land_height *height,
                 uint32_t seed)
{
    const double step = side / cells;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const double x0 = -0.5 * side + i * step, z0 = -0.5 * side + j * step, x1 = x0 + step, z1 = z0 + step;
            const svec a = at(x0, height(x0, z0, seed), z0), b = at(x1, height(x1, z0, seed), z0);
            const svec c = at(x1, height(x1, z1, seed), z1), d = at(x0, height(x0, z1, seed), z1);
            quad(s, a.y + c.y > 2 * border ? high : low, a, d, c, b);
        }
    }
}

static double canyon_height(double x, double z, uint32_t seed)
{
    const double bend = 9 * smooth_noise(at(0.03 * z, 0.5, 0.5), seed), far = (x - bend) / 9;
    const double side = far * far / (1 + far * far); /* 0 on the river, 1 far from it */
    double rough = 0, size = 1;
    for (int k = 0; k < 4; ++k, size *= 0.5) {
        rough += size * smooth_noise(at(0.09 * x / size, 7.5 + k, 0.09 * z / size), seed + 1);
    }
    return 26 * side + (1.2 + 2.5 * side) * rough;
}

void build_canyon(made_scene *s)
{
    const int sand = paint(s, 0.62, 0.45, 0.3), rock = paint(s, 0.6, 0.3, 0.2);
    const uint32_t seed = (uint32_t)any_between(s, 1, 1e6);
    land(s, sand, rock, 5, 100, 100, canyon_height, seed);
    sun(s, at(any_between(s, 0.7, 0.9), -1, any_between(s, -0.3, 0.3)), 10);
    const double z = 30, x = 9 * smooth_noise(at(0.03 * z, 0.5, 0.5), seed);
    const double far = 9 * smooth_noise(at(-0.15, 0.5, 0.5), seed);
    look(s, at(x, canyon_height(x, z, seed) + 3, z), at(far, 6, -5), 65);
}

static double hills(double x, double z, uint32_t seed)
{
    double h = 0, size = 1;
    const double near_house = (x * x + z * z) / (150.0 * 150.0);
    for (int k = 0; k < 5; ++k, size *= 0.5) {
        h += 120 * size * smooth_noise(at(0.0016 * x / size, 3.5 + k, 0.0016 * z / size), seed);
    }
    return near_house < 1 ? h * near_house * near_house * near_house : h;
}

/* A house of 8 x 6 m on level ground in the middle of 4 km; a door and two windows to the sun. */
static void terrain(made_scene *s)
{
    const int grass = paint(s, 0.3, 0.42, 0.18), stone = paint(s, 0.5, 0.47, 0.42), white = paint(s, 0.76, 0.74, 0.7),
              red = paint(s, 0.55, 0.2, 0.14), wood = paint(s, 0.5, 0.36, 0.2);
    const opening holes[3] = {{0.8, 0.9, 2.4, 2.3}, {3.4, 0.0, 4.5, 2.2}, {5.6, 0.9, 7.2, 2.3}};
    const svec x = at(8, 0, 0), y = at(0, 3, 0), z = at(0, 0, 6), foot = at(-4, 0.15, -3);
    land(s, grass, stone, 60, 4000, 56, hills, (uint32_t)any_between(s, 1, 1e6));
    box(s, stone, at(-4.3, -0.5, -3.3), at(4.3, 0.149, 3.3));
    panel(s, wood, foot, x, z, NULL, 0);
    wall(s, white, foot, x, y, at(0, 0, -0.2), NULL, 0);
    wall(s, white, plus(foot, z), x, y, at(0, 0, 0.2), holes, 3);
    wall(s, white, foot, z, y, at(-0.2, 0, 0), NULL, 0);
    wall(s, white, plus(foot, x), z, y, at(0.2, 0, 0), NULL, 0);
    slab(s, red, plus(foot, at(-0.5, 3, -0.6)), at(9, 0, 0), at(0, 0.2, 0), at(0, 0, 7.2));
    crate(s, red, at(0.6, 0.15, -0.6), at(1.4, 0.75, 0.8), any_between(s, 5, 40));
    sun(s, at(any_between(s, -0.3, 0.3), -0.8, -1), 12);
    sun_through(s, at(-4.5, 0, -3.3), at(4.5, 3.4, 3.8));
}

void build_terrain_in(made_scene *s)
{
    terrain(s);
    sun_through(s, at(-3.3, 0.1, 3.0), at(3.3, 2.6, 3.2));
    look(s, at(3.6, 1.75, -2.5), at(-1.6, 1.0, 2.2), 70);
}

void build_terrain_out(made_scene *s)
{
    terrain(s);
    look(s, at(9, 3.2, 13), at(0, 1.4, 1), 50);
}

/* --- courts and streets ------------------------------------------------------------------------------------------- */

void build_courtyard(made_scene *s)
{
    const int ground = paint(s, 0.5, 0.46, 0.4), white = paint(s, 0.74, 0.7, 0.62), red = paint(s, 0.6, 0.25, 0.15),
              green = paint(s, 0.2, 0.4, 0.18);
    const double side = any_between(s, 11, 13), high = any_between(s, 5, 6);
    opening arches[5];
    for (int i = 0; i < 5; ++i) {
        arches[i].u0 = 0.6 + i * (side - 0.6) / 5;
        arches[i].u1 = arches[i].u0 + 1.6;
        arches[i].v0 = 0;
        arches[i].v1 = 2.6;
    }
    panel(s, ground, at(-3, 0, -3), at(side + 6, 0, 0), at(0, 0, side + 6), NULL, 0);
    wall(s, white, at(0, 0, 0), at(side, 0, 0), at(0, high, 0), at(0, 0, -0.4), arches, 5);
    wall(s, red, at(0, 0, 0), at(0, 0, side), at(0, high, 0), at(-0.4, 0, 0), arches, 5);
    wall(s, white, at(side, 0, 0), at(0, 0, side), at(0, high, 0), at(0.4, 0, 0), NULL, 0);
    wall(s, white, at(0, 0, side), at(side, 0, 0), at(0, high, 0), at(0, 0, 0.4), NULL, 0);
    panel(s, white, at(-3, 0, -3), at(side + 3, 0, 0), at(0, high, 0), NULL, 0);
    panel(s, white, at(-3, 0, -3), at(0, 0, side + 3), at(0, high, 0), NULL, 0);
    panel(s, red, at(-3, high, -3), at(side + 3, 0, 0), at(0, 0, 3), NULL, 0);
    panel(s, red, at(-3, high, 0), at(3, 0, 0), at(0, 0, side), NULL, 0);
    tube(s, white, at(0.5 * side, 0, 0.5 * side), at(0.5 * side, 0.7, 0.5 * side), 1.3, 1.3, 16);
    ball(s, green, at(0.3 * side, 0.6, 0.25 * side), 0.6, 8);
    sun(s, at(any_between(s, -0.7, -0.4), -1, any_between(s, -0.5, -0.3)), 10);
    look(s, at(side - 1, 1.8, side - 1), at(0.2 * side, 1.5, 0.1 * side), 65);
}

void build_city(made_scene *s)
{
    const int ground = paint(s, 0.35, 0.35, 0.36), kinds[4] = {paint(s, 0.7, 0.68, 0.62), paint(s, 0.6, 0.35, 0.25),
                                                               paint(s, 0.4, 0.45, 0.5), paint(s, 0.65, 0.6, 0.35)};
    panel(s, ground, at(-20, 0, -20), at(240, 0, 0), at(0, 0, 240), NULL, 0);
    for (int j = 0; j < 10; ++j) {
        for (int i = 0; i < 10; ++i) {
            const svec low = at(20.0 * i + any_between(s, 0, 3), 0, 20.0 * j + any_between(s, 0, 3));
            const double high = any_between(s, 8, 45);
            box(s, kinds[(int)any_between(s, 0, 4)], low,
                plus(low, at(any_between(s, 9, 13), high, any_between(s, 9, 13))));
        }
    }
    sun(s, at(any_between(s, 0.5, 0.8), -1, any_between(s, 0.3, 0.6)), 10);
    look(s, at(97, 38, 198), at(88, 8, 60), 55);
}

/* --- a cave ------------------------------------------------------------------------------------------------------- */

static svec cave_wall(double turn, double height, uint32_t seed)
{
    const svec d = at(cosine(turn) * cosine(height), sine(height), sine(turn) * cosine(height));
    double r = 4, size = 1;
    for (int k = 0; k < 4; ++k, size *= 0.5) {
        r += 1.1 * size * smooth_noise(plus(times(d, 1.7 / size), at(10, 10, 10)), seed + (uint32_t)k);
    }
    return at(d.x * r * 1.4, d.y * r * 0.8, d.z * r);
}

void build_cave(made_scene *s)
{
    const int rock = paint(s, 0.6, 0.5, 0.4), moss = paint(s, 0.35, 0.5, 0.25), rings = 40;
    const uint32_t seed = (uint32_t)any_between(s, 1, 1e6);
    for (int j = 0; j < rings; ++j) {
        const double h0 = -90.0 + 180.0 * j / rings, h1 = -90.0 + 180.0 * (j + 1) / rings;
        for (int i = 0; i < 2 * rings; ++i) {
            const double t0 = 180.0 * i / rings, t1 = 180.0 * ((i + 1) % (2 * rings)) / rings;
            const svec a = cave_wall(t0, h0, seed), b = cave_wall(t1, h0, seed), c = cave_wall(t1, h1, seed),
                       d = cave_wall(t0, h1, seed);
            const int colour = j < rings / 3 ? moss : rock;
            if (j + 1 < rings) {
                triangle(s, colour, a, c, d);
            }
            if (j > 0) {
                triangle(s, colour, a, b, c);
            }
        }
    }
    for (int i = 0; i < 6; ++i) { /* hanging and standing stones */
        const svec a = at(any_between(s, -2.5, 1.5), i % 2 ? -3.4 : 3.4, any_between(s, -2, 2));
        tube(s, rock, a, at(a.x, i % 2 ? -0.6 : 0.8, a.z), any_between(s, 0.4, 0.7), 0.05, 12);
    }
    spot(s, at(1.2, 1.4, -0.6), at(-2.4, -1.6, 0.6), 25, 35, 55);
    look(s, at(3.0, 0.2, 0.6), at(-2.0, -0.4, 0), 70);
}
