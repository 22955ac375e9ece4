/* scene_homes.c: furnished rooms, halls, sequences of rooms. */
#include <stddef.h>

#include "scenes.h"

typedef struct home {
    int floor, white, wood, cloth, green, metal;
} home;

static home paints(made_scene *s)
{
    home h;
    h.floor = paint(s, 0.5, 0.38, 0.26);
    h.white = paint(s, 0.78, 0.77, 0.74);
    h.wood = paint(s, 0.55, 0.38, 0.22);
    h.cloth = paint(s, 0.55, 0.18, 0.14);
    h.green = paint(s, 0.25, 0.5, 0.3);
    h.metal = paint(s, 0.4, 0.4, 0.42);
    return h;
}

/* A top on four legs. */
static void table(made_scene *s, int material, svec foot, svec size, double leg)
{
    const double x = 0.5 * size.x, z = 0.5 * size.z;
    box(s, material, plus(foot, at(-x, size.y - 0.04, -z)), plus(foot, at(x, size.y, z)));
    for (int k = 0; k < 4; ++k) {
        const double u = k & 1 ? x - leg : -x, v = k & 2 ? z - leg : -z;
        box(s, material, plus(foot, at(u, 0, v)), plus(foot, at(u + leg, size.y - 0.04, v + leg)));
    }
}

/* A chair with a back of five bars at the offset dz. */
static void chair(made_scene *s, int material, svec foot, double dz)
{
    table(s, material, foot, at(0.42, 0.45, 0.42), 0.035);
    for (int i = 0; i < 5; ++i) {
        const svec a = plus(foot, at(-0.2 + 0.09 * i, 0.45, dz * 0.2 - 0.01));
        box(s, material, a, plus(a, at(0.03, 0.45, 0.02)));
    }
    box(s, material, plus(foot, at(-0.21, 0.86, dz * 0.2 - 0.015)), plus(foot, at(0.21, 0.93, dz * 0.2 + 0.015)));
}

/* Floor, ceiling and three walls; the fourth wall, at x = 0, has the windows. */
static void room_with_windows(made_scene *s, const home *h, svec size, const opening *windows, int count)
{
    const svec x = at(size.x, 0, 0), y = at(0, size.y, 0), z = at(0, 0, size.z);
    panel(s, h->floor, at(0, 0, 0), x, z, NULL, 0);
    panel(s, h->white, y, x, z, NULL, 0);
    panel(s, h->white, at(0, 0, 0), x, y, NULL, 0);
    panel(s, h->white, z, x, y, NULL, 0);
    panel(s, h->green, x, z, y, NULL, 0);
    wall(s, h->white, at(0, 0, 0), z, y, at(-0.25, 0, 0), windows, count);
}

void build_kitchen(made_scene *s)
{
    const svec size = at(any_between(s, 3.8, 4.4), 2.6, any_between(s, 4.4, 5.2));
    const home h = paints(s);
    const opening window = {1.4, 0.95, 3.2, 2.15};
    room_with_windows(s, &h, size, &window, 1);
    for (int i = 0; i < 6; ++i) { /* cupboards along z = 0, below and above, with small gaps */
        const double x0 = 0.15 + 0.6 * i;
        box(s, h.wood, at(x0, 0.1, 0.02), at(x0 + 0.585, 0.86, 0.6));
        if (i != 3) {
            box(s, h.wood, at(x0, 1.45, 0.02), at(x0 + 0.585, 2.15, 0.36));
        }
    }
    box(s, h.metal, at(0.12, 0.87, 0.01), at(3.8, 0.91, 0.63));
    box(s, h.metal, at(2.0, 1.6, 0.02), at(2.5, 1.75, 0.5));
    const svec middle = at(1.7, 0, any_between(s, 2.3, 2.8));
    table(s, h.wood, middle, at(1.4, 0.74, 0.85), 0.06);
    for (int k = 0; k < 4; ++k) {
        chair(s, h.cloth, plus(middle, at(k & 1 ? 0.35 : -0.35, 0, k & 2 ? 0.62 : -0.62)), k & 2 ? 1 : -1);
    }
    ball(s, h.green, plus(middle, at(0.2, 0.84, 0.1)), 0.1, 8);
    sun(s, at(1, -any_between(s, 0.65, 0.85), any_between(s, -0.3, 0.0)), 40);
    sun_through(s, at(-0.26, window.v0, window.u0), at(0, window.v1, window.u1));
    look(s, at(size.x - 0.3, 1.65, size.z - 0.3), at(1.2, 0.9, 1.2), 68);
}

/* Sun through many small windows. */
void build_windows(made_scene *s)
{
    const svec size = at(any_between(s, 6, 7), 4, 8);
    const home h = paints(s);
    opening windows[40];
    int n = 0;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 10; ++i) {
            const double u = 0.4 + 0.75 * i, v = 0.6 + 0.8 * j, side = any_between(s, 0.18, 0.3);
            windows[n].u0 = u;
            windows[n].u1 = u + side;
            windows[n].v0 = v;
            windows[n++].v1 = v + side;
        }
    }
    room_with_windows(s, &h, size, windows, n);
    for (int i = 0; i < 3; ++i) {
        crate(s, h.cloth, at(any_between(s, 2, 5), 0, 1.5 + 2 * i), at(0.8, any_between(s, 0.5, 1.5), 0.8), 20.0 * i);
    }
    sun(s, at(1, -any_between(s, 0.5, 0.7), any_between(s, -0.3, 0.3)), 60);
    sun_through(s, at(-0.26, 0.5, 0.3), at(0, 3.5, 7.8));
    look(s, at(size.x - 0.4, 1.7, size.z - 0.4), at(0.8, 1.3, 2.2), 68);
}

void build_furnished(made_scene *s)
{
    const svec size = at(any_between(s, 4.6, 5.2), 2.7, any_between(s, 4.2, 4.8));
    const home h = paints(s);
    shell(s, h.floor, h.white, h.white, at(0, 0, 0), size);
    box(s, h.cloth, at(0.2, 0.15, 1.2), at(1.0, 0.42, 3.2)); /* a sofa */
    box(s, h.cloth, at(0.1, 0.15, 1.0), at(0.3, 0.85, 3.4));
    box(s, h.cloth, at(0.1, 0.15, 1.0), at(1.0, 0.6, 1.2));
    box(s, h.cloth, at(0.1, 0.15, 3.2), at(1.0, 0.6, 3.4));
    table(s, h.wood, at(1.8, 0, 2.2), at(0.7, 0.42, 1.1), 0.05);
    for (int i = 0; i < 5; ++i) { /* an open shelf */
        box(s, h.wood, at(1.5, 0.3 + 0.42 * i, 0.02), at(3.6, 0.33 + 0.42 * i, 0.35));
        for (int k = 0; k < 5 && i < 4; ++k) {
            const double x = 1.6 + 0.38 * k + any_between(s, 0, 0.1);
            box(s, k % 2 ? h.green : h.metal, at(x, 0.33 + 0.42 * i, 0.05),
                at(x + any_between(s, 0.1, 0.25), 0.33 + 0.42 * i + any_between(s, 0.1, 0.32), 0.28));
        }
    }
    tube(s, h.metal, at(3.9, 0, 0.9), at(3.9, 1.5, 0.9), 0.015, 0.015, 8); /* a lamp with a shade */
    tube(s, h.white, at(3.9, 1.42, 0.9), at(3.9, 1.7, 0.9), 0.24, 0.15, 24);
    ball(s, h.green, at(1.8, 0.54, 2.3), 0.12, 8);
    point(s, at(3.9, 1.56, 0.9), 8);
    look(s, at(size.x - 0.3, 1.6, size.z - 0.3), at(1.4, 0.8, 1.3), 68);
}

/* --- halls -------------------------------------------------------------------------------------------------------- */

void build_columns(made_scene *s)
{
    const svec size = at(any_between(s, 9, 11), 5, any_between(s, 14, 17));
    const home h = paints(s);
    shell(s, h.floor, h.white, h.white, at(0, 0, 0), size);
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 2; ++i) {
            const svec foot = at((i + 1) * size.x / 3, 0, (j + 0.5) * size.z / 6);
            tube(s, h.wood, foot, plus(foot, at(0, size.y, 0)), 0.3, 0.24, 16);
            box(s, h.metal, plus(foot, at(-0.4, 0, -0.4)), plus(foot, at(0.4, 0.25, 0.4)));
        }
    }
    panel(s, h.cloth, at(0.05, 0.5, 2), at(0, 0, size.z - 4), at(0, 3, 0), NULL, 0);
    spot(s, at(0.5 * size.x, 4.8, 0.45 * size.z), at(0.2 * size.x, 0.5, 0.25 * size.z), 150, 40, 60);
    look(s, at(0.85 * size.x, 1.7, size.z - 0.7), at(0.35 * size.x, 1.6, 0.3 * size.z), 65);
}

/* Arches across a barrel vault. */
void build_arcade(made_scene *s)
{
    const home h = paints(s);
    const double radius = any_between(s, 2.2, 2.6), spring = 2.4, length = 15;
    const int parts = 20;
    panel(s, h.floor, at(-radius, 0, 0), at(2 * radius, 0, 0), at(0, 0, length), NULL, 0);
    for (int side = -1; side < 2; side += 2) {
        panel(s, side < 0 ? h.cloth : h.white, at(side * radius, 0, 0), at(0, 0, length), at(0, spring, 0), NULL, 0);
        for (int j = 0; j < 5; ++j) {
            box(s, h.white, at(side * radius - 0.25, 0, 1.3 + 3 * j), at(side * radius + 0.25, spring, 1.7 + 3 * j));
        }
    }
    for (int i = 0; i < parts; ++i) {
        const double a = 180.0 * i / parts, b = 180.0 * (i + 1) / parts, inner = radius - 0.25;
        const svec pa = at(radius * cosine(a), spring + radius * sine(a), 0);
        const svec pb = at(radius * cosine(b), spring + radius * sine(b), 0);
        quad(s, h.white, pa, pb, plus(pb, at(0, 0, length)), plus(pa, at(0, 0, length)));
        for (int end = 0; end < 2; ++end) { /* the walls at both ends */
            triangle(s, h.green, at(0, spring, end * length), plus(pa, at(0, 0, end * length)),
                     plus(pb, at(0, 0, end * length)));
        }
        for (int j = 0; j < 5; ++j) { /* the arches */
            const svec qa = at(inner * cosine(a), spring + inner * sine(a), 1.3 + 3 * j);
            const svec qb = at(inner * cosine(b), spring + inner * sine(b), 1.3 + 3 * j);
            const svec deep = at(0, 0, 0.4), za = at(pa.x, pa.y, qa.z), zb = at(pb.x, pb.y, qb.z);
            quad(s, h.wood, qa, qb, plus(qb, deep), plus(qa, deep));
            quad(s, h.wood, qa, qb, zb, za);
            quad(s, h.wood, plus(qa, deep), plus(qb, deep), plus(zb, deep), plus(za, deep));
        }
    }
    panel(s, h.green, at(-radius, 0, 0), at(2 * radius, 0, 0), at(0, spring, 0), NULL, 0);
    panel(s, h.green, at(-radius, 0, length), at(2 * radius, 0, 0), at(0, spring, 0), NULL, 0);
    spot(s, at(0.8, 3.6, 0.45 * length), at(-1.6, 0.3, 0.28 * length), 60, 35, 50);
    look(s, at(0.9, 1.7, length - 0.6), at(-0.5, 1.9, 3), 60);
}

/* Long, with niches, and lit at the far end, so that most of the light comes from later bounces. */
void build_gallery(made_scene *s)
{
    const svec size = at(3.2, any_between(s, 2.9, 3.4), any_between(s, 20, 24));
    const home h = paints(s);
    shell(s, h.floor, h.white, h.white, at(0, 0, 0), size);
    for (int j = 0; j < 8; ++j) {
        const double z = 1.2 + j * (size.z - 2) / 8;
        box(s, h.white, at(0, 0, z), at(0.5, size.y, z + 0.4));
        box(s, h.white, at(size.x - 0.5, 0, z), at(size.x, size.y, z + 0.4));
        box(s, j % 2 ? h.cloth : h.green, at(0.02, 1, z + 0.8), at(0.08, 2.2, z + 2));
        box(s, h.wood, at(size.x - 0.4, 0, z + 0.9), at(size.x - 0.1, any_between(s, 0.6, 1.2), z + 1.3));
    }
    spot(s, at(0.5 * size.x, size.y - 0.1, 0.35 * size.z), at(0.3 * size.x, 0, 0.22 * size.z), 60, 40, 60);
    look(s, at(0.6 * size.x, 1.6, 0.78 * size.z), at(0.45 * size.x, 1.4, 0), 60);
}

/* --- rooms after rooms -------------------------------------------------------------------------------------------- */

/* Four rooms, with a door between each two, not opposite each other; the lamp is in the
 * second, the eye in the third. */
void build_doors(made_scene *s)
{
    const home h = paints(s);
    const svec size = at(15, 2.7, any_between(s, 3.8, 4.4));
    shell(s, h.floor, h.white, h.white, at(0, 0, 0), size);
    for (int i = 1; i < 4; ++i) {
        const double z = any_between(s, 0.6, size.z - 1.6);
        const opening door = {z, 0, z + any_between(s, 0.85, 1.1), 2.1};
        wall(s, i == 2 ? h.cloth : h.green, at(3.75 * i - 0.06, 0, 0), at(0, 0, size.z), at(0, size.y, 0),
             at(0.12, 0, 0), &door, 1);
        box(s, h.wood, at(3.75 * i + 1.2, 0, 0.1), at(3.75 * i + 2.2, any_between(s, 0.5, 1.6), 0.6));
    }
    spot(s, at(5.2, 2.6, 0.5 * size.z), at(6.9, 0, 0.5 * size.z), 25, 40, 60);
    look(s, at(10.8, 1.6, size.z - 0.4), at(7.6, 1.1, 0.35 * size.z), 72);
}

void build_l_corridor(made_scene *s)
{
    const home h = paints(s);
    const double wide = any_between(s, 1.8, 2.2), high = 2.6, length = any_between(s, 8, 10);
    const svec y = at(0, high, 0);
    for (int top = 0; top < 2; ++top) {
        const svec up = times(y, top);
        panel(s, top ? h.white : h.floor, up, at(wide, 0, 0), at(0, 0, length), NULL, 0);
        panel(s, top ? h.white : h.floor, plus(up, at(wide, 0, 0)), at(length - wide, 0, 0), at(0, 0, wide), NULL, 0);
    }
    panel(s, h.white, at(0, 0, 0), at(0, 0, length), y, NULL, 0);
    panel(s, h.cloth, at(0, 0, 0), at(length, 0, 0), y, NULL, 0);
    panel(s, h.white, at(wide, 0, wide), at(0, 0, length - wide), y, NULL, 0);
    panel(s, h.white, at(wide, 0, wide), at(length - wide, 0, 0), y, NULL, 0);
    panel(s, h.green, at(0, 0, length), at(wide, 0, 0), y, NULL, 0);
    panel(s, h.green, at(length, 0, 0), at(0, 0, wide), y, NULL, 0);
    for (int i = 0; i < 3; ++i) {
        box(s, h.wood, at(wide - 0.35, 0, 3 + 1.6 * i), at(wide - 0.02, 0.45, 4 + 1.6 * i));
    }
    spot(s, at(2.6, 2.5, 0.5 * wide), at(0.7, 0.4, 0.4 * wide), 20, 40, 55);
    look(s, at(0.5 * wide, 1.6, length - 0.4), at(0.4 * wide, 1.1, 0), 62);
}

/* --- roofs and tents ---------------------------------------------------------------------------------------------- */

/* A room under a gable roof; sun through windows. */
void build_attic(made_scene *s)
{
    const home h = paints(s);
    const double half = any_between(s, 2.4, 2.8), knee = 0.7, top = any_between(s, 3.1, 3.5), length = 6.5;
    const svec slope = at(half, top - knee, 0), along = at(0, 0, length);
    const opening windows[3] = {{0.9, 1.0, 1.6, 2.1}, {2.9, 1.0, 3.6, 2.1}, {4.9, 1.2, 5.4, 2.0}};
    panel(s, h.floor, at(-half, 0, 0), at(2 * half, 0, 0), along, NULL, 0);
    panel(s, h.white, at(-half, 0, 0), along, at(0, knee, 0), NULL, 0);
    panel(s, h.white, at(half, 0, 0), along, at(0, knee, 0), NULL, 0);
    wall(s, h.white, at(-half, knee, 0), along, slope, at(-0.08, 0.1, 0), windows, 3);
    panel(s, h.wood, at(half, knee, 0), along, at(-half, top - knee, 0), NULL, 0);
    for (int end = 0; end < 2; ++end) {
        const svec z = at(0, 0, end * length);
        panel(s, end ? h.white : h.cloth, plus(at(-half, 0, 0), z), at(2 * half, 0, 0), at(0, knee, 0), NULL, 0);
        triangle(s, end ? h.white : h.cloth, plus(at(-half, knee, 0), z), plus(at(half, knee, 0), z),
                 plus(at(0, top, 0), z));
    }
    for (int i = 0; i < 4; ++i) { /* collar beams */
        box(s, h.wood, at(-0.75, top - 0.9, 0.8 + 1.6 * i), at(0.75, top - 0.75, 0.92 + 1.6 * i));
    }
    for (int i = 0; i < 5; ++i) {
        const double side = any_between(s, 0.4, 0.8);
        crate(s, i % 2 ? h.green : h.wood, at(any_between(s, -1.2, 1.7), 0, 0.8 + 1.0 * i), at(side, side, side),
              37.0 * i);
    }
    sun(s, at(any_between(s, 0.5, 0.7), -1, any_between(s, -0.2, 0.2)), 30);
    sun_through(s, at(-half - 0.1, knee + 0.5, 0.8), at(0, top, 5.5));
    look(s, at(0.9, 1.6, length - 0.3), at(-0.1, 0.9, 1.6), 68);
}

/* A closed box with a small hole for the sun. */
void build_tent(made_scene *s)
{
    const home h = paints(s);
    const svec size = at(3, 2.4, 4);
    const double z = any_between(s, 1.4, 2.2);
    const opening hole = {z, 1.5, z + 0.3, 1.8};
    room_with_windows(s, &h, size, &hole, 1);
    ball(s, h.cloth, at(2.1, 0.35, 1.2), 0.35, 10);
    crate(s, h.wood, at(1.2, 0, 3.1), at(0.6, 0.8, 0.5), any_between(s, 10, 70));
    sun(s, at(1, -any_between(s, 0.7, 0.9), any_between(s, -0.15, 0.15)), 100);
    sun_through(s, at(-0.26, hole.v0, hole.u0), at(0, hole.v1, hole.u1));
    look(s, at(size.x - 0.2, 1.5, size.z - 0.2), at(1.0, 0.8, 1.2), 70);
}

/* --- clutter ------------------------------------------------------------------------------------------------------ */

void build_pipes(made_scene *s)
{
    const home h = paints(s);
    const svec size = at(5, 3.2, 6);
    shell(s, h.floor, h.white, h.white, at(0, 0, 0), size);
    for (int i = 0; i < 40; ++i) {
        const double r = any_between(s, 0.02, 0.09), y = any_between(s, 0.3, 3), z = any_between(s, 0.3, 4.5);
        const int colour = i % 3 == 0 ? h.cloth : i % 3 == 1 ? h.metal : h.green;
        if (i % 2 == 0) {
            tube(s, colour, at(0, y, z), at(size.x, y + any_between(s, -0.2, 0.2), z), r, r, 12);
        } else {
            tube(s, colour, at(any_between(s, 0.3, 3.2), 0, z), at(any_between(s, 0.3, 3.2), size.y, z), r, r, 12);
        }
    }
    spot(s, at(0.4, 3, 5.2), at(2.4, 0.8, 2.0), 30, 40, 60);
    look(s, at(size.x - 0.4, 1.7, size.z - 0.3), at(1.6, 1.4, 1.0), 66);
}

/* Crates at every angle. */
void build_crates(made_scene *s)
{
    const home h = paints(s);
    const svec size = at(6, 3, 6);
    shell(s, h.floor, h.white, h.white, at(0, 0, 0), size);
    for (int i = 0; i < 60; ++i) {
        const svec foot = at(any_between(s, 0.4, 4.2), 0.45 * (int)any_between(s, 0, 3), any_between(s, 0.4, 4.4));
        const double side = any_between(s, 0.3, 0.45);
        crate(s,
              i % 4 == 0   ? h.cloth
              : i % 4 == 1 ? h.green
                           : h.wood,
              foot, at(side, 0.44, side), any_between(s, 0, 90));
    }
    spot(s, at(3.2, 2.9, 4.2), at(2.2, 0.6, 1.8), 30, 40, 60);
    look(s, at(size.x - 0.4, 1.8, size.z - 0.4), at(1.8, 0.7, 1.8), 64);
}
