/* scene_small.c: scenes of at most a few hundred triangles, for truth in the repository. */
#include <stddef.h>

#include "scenes.h"

typedef struct paints {
    int floor, white, red, green;
} paints;

static paints four_paints(made_scene *s)
{
    paints p;
    p.floor = paint(s, 0.5, 0.4, 0.3);
    p.white = paint(s, 0.75, 0.74, 0.72);
    p.red = paint(s, 0.6, 0.15, 0.12);
    p.green = paint(s, 0.2, 0.5, 0.25);
    return p;
}

/* A spot on the left wall; crates stand in the reflected light. */
void build_small_room(made_scene *s)
{
    const svec size = at(any_between(s, 3.8, 4.2), 2.6, any_between(s, 3.8, 4.2));
    const paints p = four_paints(s);
    shell(s, p.floor, p.white, p.white, at(0, 0, 0), size);
    panel(s, p.red, at(0.01, 0.3, 0.5), at(0, 0, 2.2), at(0, 1.6, 0), NULL, 0);
    crate(s, p.green, at(1.5, 0, 1.2), at(0.7, 1.1, 0.7), any_between(s, 15, 35));
    crate(s, p.white, at(2.6, 0, 1.9), at(0.6, 0.6, 0.6), any_between(s, -30, -10));
    spot(s, at(0.6 * size.x, 2.4, 0.5 * size.z), at(0, 0.9, 0.4 * size.z), 30, 25, 40);
    look(s, at(size.x - 0.3, 1.6, size.z - 0.3), at(1.2, 0.8, 1.0), 65);
}

/* Nine steps along a wall, under a lamp. */
void build_small_stairs(made_scene *s)
{
    enum { STEPS = 9 };
    const double rise = any_between(s, 0.16, 0.19), tread = any_between(s, 0.25, 0.3), wide = 1.2;
    const svec size = at(STEPS * tread + 2.4, STEPS * rise + 2.2, 3.2);
    const paints p = four_paints(s);
    shell(s, p.floor, p.white, p.white, at(0, 0, 0), size);
    for (int i = 0; i < STEPS; ++i) {
        box(s, p.red, at(1.0 + i * tread, i * rise, 0), at(1.0 + (i + 1) * tread, (i + 1) * rise, wide));
    }
    box(s, p.green, at(1.0 + STEPS * tread, 0, 0), at(size.x, STEPS * rise, wide));
    point(s, at(0.5 * size.x, size.y - 0.5, 2.2), 8);
    look(s, at(0.4, 1.6, size.z - 0.3), at(1.0 + 0.6 * STEPS * tread, 0.9, 0.5), 65);
}

/* Boards between two sides in front of a wall, with floating boxes on them; a spot shines in at an angle. */
void build_small_shelf(made_scene *s)
{
    enum { BOARDS = 4, BOXES = 4 };
    const svec size = at(any_between(s, 3.0, 3.4), 2.5, any_between(s, 2.8, 3.2));
    const double left = any_between(s, 0.7, 1.0), wide = 1.5, deep = any_between(s, 0.3, 0.4), thick = 0.03;
    const double rise = any_between(s, 0.42, 0.5), high = BOARDS * rise + thick;
    const paints p = four_paints(s);
    shell(s, p.floor, p.white, p.white, at(0, 0, 0), size);
    box(s, p.red, at(left, 0, 0), at(left + thick, high, deep));
    box(s, p.red, at(left + wide, 0, 0), at(left + wide + thick, high, deep));
    for (int i = 1; i <= BOARDS; ++i) {
        const double y = i * rise;
        box(s, p.red, at(left + thick, y, 0), at(left + wide, y + thick, deep));
        for (int k = 0; k < BOXES && i < BOARDS; ++k) {
            const double x = left + 0.1 + 0.34 * k, tall = any_between(s, 0.15, rise - 0.1);
            box(s, k % 2 ? p.green : p.white, at(x, y + thick, any_between(s, 0.02, 0.06)),
                at(x + any_between(s, 0.12, 0.3), y + thick + tall, deep - any_between(s, 0.03, 0.1)));
        }
    }
    spot(s, at(size.x - 0.4, 2.2, size.z - 0.5), at(left + 0.5 * wide, 0.5 * high, 0), 30, 20, 30);
    look(s, at(0.5, 1.5, size.z - 0.3), at(left + 0.6 * wide, 1.0, 0.2), 60);
}

/* The lit room behind a door with a screen in front of it, seen from the dark room. */
void build_doorway(made_scene *s)
{
    const paints p = four_paints(s);
    const opening door = {1.2, 0, any_between(s, 2.1, 2.3), 2.0};
    const double far_x = any_between(s, 6.8, 7.2);
    shell(s, p.floor, p.white, p.white, at(0, 0, 0), at(far_x, 2.6, 3.6));
    wall(s, p.white, at(3.5, 0, 0), at(0, 0, 3.6), at(0, 2.6, 0), at(0.15, 0, 0), &door, 1);
    box(s, p.green, at(2.6, 0, 1.5), at(2.66, 1.5, 2.7));
    crate(s, p.red, at(1.3, 0, 0.8), at(0.6, 0.6, 0.6), 20);
    spot(s, at(5.2, 2.4, 1.8), at(5.6, 0, 1.6), 60, 35, 50);
    look(s, at(0.3, 1.6, 3.2), at(3.0, 0.9, 1.4), 70);
}

/* A panel that emits light above crates; no other light. */
void build_glow(made_scene *s)
{
    const svec size = at(any_between(s, 3.4, 3.8), 2.6, any_between(s, 3.4, 3.8));
    const paints p = four_paints(s);
    const int lamp = paint(s, 0.3, 0.3, 0.3);
    s->emission[lamp][0] = 9;
    s->emission[lamp][1] = 8;
    s->emission[lamp][2] = 6;
    shell(s, p.floor, p.white, p.white, at(0, 0, 0), size);
    panel(s, lamp, at(1.2, 1.9, 1.1), at(1.0, 0, 0), at(0, 0.25, 0.7), NULL, 0);
    crate(s, p.red, at(1.1, 0, 1.2), at(0.6, 1.0, 0.6), any_between(s, 20, 40));
    crate(s, p.green, at(2.3, 0, 1.6), at(0.6, 0.5, 0.6), any_between(s, -20, 0));
    look(s, at(size.x - 0.3, 1.5, size.z - 0.3), at(1.2, 0.7, 1.0), 65);
}

/* A lamp lights the end of a side room. Most visible surfaces do not see that end, so their light has bounced twice. */
void build_alcove(made_scene *s)
{
    const paints p = four_paints(s);
    const opening mouth = {0.3, 0, any_between(s, 1.6, 1.8), 2.5};
    const double deep = any_between(s, 1.9, 2.1);
    shell(s, p.floor, p.white, p.white, at(-deep, 0, 0), at(4, 2.5, 4));
    panel(s, p.white, at(0, 0, 0), at(0, 0, 4), at(0, 2.5, 0), &mouth, 1);
    panel(s, p.red, at(-deep, 0, 1.9), at(deep, 0, 0), at(0, 2.5, 0), NULL, 0);
    spot(s, at(-0.7, 2.3, 0.9), at(-deep, 1.0, 1.2), 50, 30, 45);
    look(s, at(3.7, 1.6, 3.7), at(0.8, 0.9, 1.2), 65);
}
