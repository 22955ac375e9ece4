/* scene_rooms.c: rooms with fine occluders: slats, bars, shelves, stairs. */
#include <stddef.h>

#include "scenes.h"

/* A white room with a floor of another colour and a coloured wall at each end of x. */
typedef struct plain_room {
    int floor, white, red, blue, wood, dark;
} plain_room;

static plain_room paints(made_scene *s)
{
    plain_room p;
    p.floor = paint(s, 0.55, 0.5, 0.42);
    p.white = paint(s, 0.76, 0.75, 0.72);
    p.red = paint(s, 0.6, 0.16, 0.1);
    p.blue = paint(s, 0.18, 0.28, 0.6);
    p.wood = paint(s, 0.5, 0.32, 0.17);
    p.dark = paint(s, 0.2, 0.2, 0.22);
    return p;
}

static plain_room plain(made_scene *s, svec size)
{
    const plain_room p = paints(s);
    const svec x = at(size.x, 0, 0), y = at(0, size.y, 0), z = at(0, 0, size.z);
    panel(s, p.floor, at(0, 0, 0), x, z, NULL, 0);
    panel(s, p.white, y, x, z, NULL, 0);
    panel(s, p.white, at(0, 0, 0), x, y, NULL, 0);
    panel(s, p.white, z, x, y, NULL, 0);
    panel(s, p.red, at(0, 0, 0), z, y, NULL, 0);
    panel(s, p.blue, x, z, y, NULL, 0);
    return p;
}

/* --- slats and bars ----------------------------------------------------------------------------------------------- */

/* Thirty upright slats divide the room; the lamp is on one side, the eye on the other. */
void build_louvres(made_scene *s)
{
    const svec size = at(any_between(s, 5.5, 6.5), any_between(s, 2.7, 3.1), any_between(s, 4.6, 5.4));
    const plain_room p = plain(s, size);
    const double turn = any_between(s, 25, 50), deep = any_between(s, 0.11, 0.15), step = size.z / 30;
    for (int i = 0; i < 30; ++i) {
        crate(s, p.wood, at(0.5 * size.x, 0, (i + 0.5) * step), at(deep, size.y - 0.15, 0.012), turn);
    }
    spot(s, at(0.9, size.y - 0.3, 0.5 * size.z), at(0.42 * size.x, 0, 0.5 * size.z), 25, 35, 50);
    look(s, at(size.x - 0.4, 1.7, 0.5 * size.z + 0.9), at(0.35 * size.x, 0.9, 0.45 * size.z), 62);
}

/* Sun through the flat slats of a blind. */
void build_blinds(made_scene *s)
{
    const svec size = at(any_between(s, 4.5, 5.5), 2.8, any_between(s, 4, 4.6));
    const plain_room p = paints(s);
    const opening window = {0.8, 0.7, size.z - 0.8, 2.4};
    const svec x = at(size.x, 0, 0), y = at(0, size.y, 0), z = at(0, 0, size.z);
    panel(s, p.floor, at(0, 0, 0), x, z, NULL, 0);
    panel(s, p.white, y, x, z, NULL, 0);
    panel(s, p.white, at(0, 0, 0), x, y, NULL, 0);
    panel(s, p.red, z, x, y, NULL, 0);
    panel(s, p.blue, x, z, y, NULL, 0);
    wall(s, p.white, at(0, 0, 0), z, y, at(-0.2, 0, 0), &window, 1);
    const double lean = any_between(s, 0.005, 0.02);
    for (int i = 0; i < 24; ++i) {
        slab(s, p.wood, at(0.02, window.v0 + 0.03 + 0.07 * i, window.u0), at(0.055, lean, 0), at(-0.001, 0.004, 0),
             at(0, 0, window.u1 - window.u0));
    }
    crate(s, p.wood, at(2.4, 0, 1.4), at(1.2, 0.45, 0.7), any_between(s, 10, 40));
    sun(s, at(1, -any_between(s, 0.45, 0.6), any_between(s, 0.1, 0.3)), 30);
    sun_through(s, at(-0.21, window.v0, window.u0), at(0, window.v1, window.u1));
    look(s, at(size.x - 0.4, 1.6, size.z - 0.5), at(1.0, 0.7, 1.5), 66);
}

/* A spot behind an iron grille. */
void build_grille(made_scene *s)
{
    const svec size = at(any_between(s, 5, 6), 3, any_between(s, 4, 5));
    const plain_room p = plain(s, size);
    const double where = any_between(s, 2.2, 2.7), step = any_between(s, 0.11, 0.14);
    const int bars = (int)(size.z / step);
    for (int i = 1; i < bars; ++i) {
        tube(s, p.dark, at(where, 0, i * step), at(where, size.y, i * step), 0.011, 0.011, 6);
    }
    for (int i = 1; i < 6; ++i) {
        box(s, p.dark, at(where - 0.004, 0.5 * i - 0.02, 0), at(where + 0.004, 0.5 * i + 0.02, size.z));
    }
    crate(s, p.wood, at(where + 1.2, 0, 1.2), at(0.7, 0.7, 0.7), any_between(s, 0, 90));
    spot(s, at(0.5, 2.2, 0.4 * size.z), at(where + 1.0, 0.3, 0.5 * size.z), 30, 30, 40);
    look(s, at(size.x - 0.3, 1.6, size.z - 0.6), at(where - 0.8, 0.9, 0.4 * size.z), 65);
}

/* A gallery's railing, lit from above. */
void build_railing(made_scene *s)
{
    const svec size = at(6, any_between(s, 4.8, 5.4), 6);
    const plain_room p = plain(s, size);
    const double high = any_between(s, 2.2, 2.6), deep = any_between(s, 1.6, 2.2);
    box(s, p.white, at(0, high - 0.25, 0), at(size.x, high, deep));
    for (int i = 0; i < 55; ++i) {
        const double x = (i + 0.5) * size.x / 55;
        box(s, p.dark, at(x - 0.01, high, deep - 0.06), at(x + 0.01, high + 1, deep - 0.04));
    }
    box(s, p.wood, at(0, high + 1, deep - 0.08), at(size.x, high + 1.05, deep - 0.02));
    spot(s, at(0.5 * size.x, size.y - 0.2, 0.3), at(0.45 * size.x, high, deep + 0.6), 40, 40, 58);
    look(s, at(size.x - 0.6, 1.7, size.z - 0.3), at(0.35 * size.x, high - 0.2, 0.4 * deep), 70);
}

static void shelf_books(made_scene *s, const int *covers, svec foot, double wide, double deep)
{
    for (double x = 0.02; x < wide - 0.08;) {
        const double thick = any_between(s, 0.02, 0.055), high = any_between(s, 0.2, 0.3);
        const int cover = covers[(int)any_between(s, 0, 4)];
        if (any_between(s, 0, 1) < 0.9) {
            box(s, cover, plus(foot, at(x, 0, 0)), plus(foot, at(x + thick, high, deep * any_between(s, 0.6, 0.9))));
        }
        x += thick + any_between(s, 0.001, 0.01);
    }
}

void build_bookshelves(made_scene *s)
{
    const svec size = at(any_between(s, 4.2, 5), 2.6, any_between(s, 3.6, 4.2));
    const plain_room p = plain(s, size);
    const int covers[4] = {p.red, p.blue, p.wood, paint(s, 0.25, 0.45, 0.2)};
    const double deep = 0.3, wide = 0.9;
    for (int unit_x = 0; unit_x < 4; ++unit_x) {
        const double x0 = 0.2 + unit_x * (wide + 0.03);
        for (int row = 0; row < 7; ++row) {
            const double y = 0.08 + 0.34 * row;
            box(s, p.wood, at(x0 + 0.02, y, 0), at(x0 + wide - 0.02, y + 0.02, deep));
            if (row < 6) {
                shelf_books(s, covers, at(x0 + 0.02, y + 0.02, 0.01), wide - 0.04, deep);
            }
        }
        box(s, p.wood, at(x0, 0, 0), at(x0 + 0.02, 2.2, deep));
        box(s, p.wood, at(x0 + wide - 0.02, 0, 0), at(x0 + wide, 2.2, deep));
    }
    crate(s, p.wood, at(2.2, 0.68, 2), at(1.3, 0.04, 0.7), any_between(s, 0, 30));
    spot(s, at(1.2, 2.5, size.z - 0.5), at(2.2, 0.6, 0.3), 12, 35, 55);
    look(s, at(size.x - 0.5, 1.6, size.z - 0.35), at(1.6, 1.0, 0.3), 60);
}

/* --- stairs ------------------------------------------------------------------------------------------------------- */

static void flight(made_scene *s, int material, svec foot, svec run, svec across, double rise, int steps)
{
    for (int i = 0; i < steps; ++i) {
        slab(s, material, plus(foot, plus(times(run, i), at(0, rise * i, 0))), run, at(0, rise, 0), across);
    }
}

void build_stair_hall(made_scene *s)
{
    const double rise = any_between(s, 0.16, 0.18), tread = any_between(s, 0.26, 0.3), wide = any_between(s, 1.1, 1.3);
    const svec size = at(10 * tread + 2.6, 20 * rise + 2.5, any_between(s, 3.6, 4.2));
    const plain_room p = plain(s, size);
    const svec end = at(1.2 + 10 * tread, 10 * rise, 0);
    flight(s, p.wood, at(1.2, 0, 0), at(tread, 0, 0), at(0, 0, wide), rise, 10);
    box(s, p.wood, at(end.x, end.y - 0.2, 0), at(size.x, end.y, 2 * wide + 0.1));
    flight(s, p.wood, at(end.x, end.y, wide + 0.1), at(-tread, 0, 0), at(0, 0, wide), rise, 10);
    for (int i = 0; i < 10; ++i) {
        const double x = 1.2 + (i + 0.5) * tread, y = rise * (i + 1);
        box(s, p.dark, at(x - 0.012, y, wide + 0.01), at(x + 0.012, y + 0.9, wide + 0.034));
    }
    spot(s, at(0.35 * size.x, size.y - 0.15, size.z - 0.8), at(0.5 * size.x, 0.6, 0.8), 45, 35, 50);
    look(s, at(0.35, 1.7, size.z - 0.35), at(end.x, 1.6, 0.8), 68);
}

void build_spiral(made_scene *s)
{
    const plain_room p = paints(s);
    const double radius = any_between(s, 1.9, 2.2), rise = 0.18, turn = any_between(s, 19, 24);
    const double high = 5;
    tube(s, p.white, at(0, 0, 0), at(0, high, 0), radius, radius, 32);
    tube(s, p.red, at(0, 0, 0), at(0, high, 0), 0.12, 0.12, 12);
    for (int i = 0; i < 32; ++i) {
        const double a = 11.25 * i, b = 11.25 * ((i + 1) % 32);
        const svec va = at(radius * cosine(a), 0, radius * sine(a)), vb = at(radius * cosine(b), 0, radius * sine(b));
        triangle(s, p.floor, at(0, 0, 0), va, vb);
        triangle(s, p.white, at(0, high, 0), plus(va, at(0, high, 0)), plus(vb, at(0, high, 0)));
    }
    for (int i = 0; i < 24; ++i) {
        const svec out = at(cosine(turn * i), 0, sine(turn * i)), side = at(-sine(turn * i), 0, cosine(turn * i));
        const double y = rise * (i + 1);
        slab(s, p.wood, plus(times(out, 0.13), plus(times(side, -0.17), at(0, y - 0.05, 0))), times(out, 1.2),
             at(0, 0.05, 0), times(side, 0.34));
        tube(s, p.dark, plus(times(out, 1.3), at(0, y, 0)), plus(times(out, 1.3), at(0, y + 0.9, 0)), 0.012, 0.012, 5);
    }
    point(s, at(1.1 * cosine(turn * 26), 4.5, 1.1 * sine(turn * 26)), 10);
    look(s, at((radius - 0.2) * cosine(200), 1.6, (radius - 0.2) * sine(200)), at(0.3, 1.9, 0.2), 75);
}
