/* rooms_build.c: the rooms. Constants may be chosen on the first ones, but not on the held-out ones. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "rooms.h"

static int metal(room *r, double red, double green, double blue, double roughness)
{
    const int m = paint(&r->scene, red, green, blue);
    r->rough_metal[m] = roughness;
    return m;
}

/* Adds a ball with its triangles facing outwards. */
static void ball_outside(made_scene *s, int material, svec centre, double radius, int rings)
{
    uint32_t i = s->triangles;
    ball(s, material, centre, radius, rings);
    for (; i < s->triangles; ++i) {
        const svec a = s->corners[3 * i], b = s->corners[3 * i + 1], c = s->corners[3 * i + 2];
        if (dot_of(cross_of(less(b, a), less(c, a)), less(a, centre)) < 0.0) {
            s->corners[3 * i + 1] = c;
            s->corners[3 * i + 2] = b;
        }
    }
}

/* All triangles added from now on belong to the object. */
static void object_begins(room *r) { r->bare = r->scene.triangles; }

static void tell_lights(room *r)
{
    for (int i = 0; i < r->scene.light_count; ++i) {
        r->told[r->told_count++] = r->scene.lights[i];
    }
}

static void build_small_object(room *r)
{
    made_scene *s = &r->scene;
    const int floor = paint(s, 0.45, 0.4, 0.35), white = paint(s, 0.7, 0.7, 0.68), red = paint(s, 0.5, 0.12, 0.1);
    shell(s, floor, white, white, at(0, 0, 0), at(6, 3, 7));
    point(s, at(2.2, 2.6, 3.4), 14);
    look(s, at(4.6, 1.6, 6.6), at(2.4, 0.5, 2.2), 60);
    object_begins(r);
    crate(s, red, at(3.2, 0, 2.6), at(0.35, 0.4, 0.35), 25);
    ball_outside(s, white, at(2.0, 0.18, 3.6), 0.18, 8);
    tell_lights(r);
}

static void build_metal_box(room *r)
{
    made_scene *s = &r->scene;
    const int floor = paint(s, 0.5, 0.42, 0.34), white = paint(s, 0.72, 0.7, 0.66), blue = paint(s, 0.2, 0.3, 0.55);
    shell(s, floor, white, white, at(0, 0, 0), at(4, 2.6, 4.4));
    panel(s, blue, at(0.01, 0.2, 0.6), at(0, 0, 1.8), at(0, 1.5, 0), NULL, 0);
    spot(s, at(2.4, 2.4, 1.8), at(1.0, 0.2, 1.4), 22, 30, 48);
    look(s, at(3.7, 1.5, 4.1), at(0.8, 0.5, 1.0), 60);
    object_begins(r);
    crate(s, metal(r, 0.9, 0.88, 0.85, 0.4), at(0.75, 0, 1.3), at(0.55, 0.6, 0.55), 15);
    tell_lights(r);
}

/* The window is a bright square in the wall ahead; `mix` gets eight small lights for it. */
static void build_window(room *r)
{
    made_scene *s = &r->scene;
    const int floor = paint(s, 0.4, 0.36, 0.32), white = paint(s, 0.68, 0.68, 0.66), pane = paint(s, 0, 0, 0),
              green = paint(s, 0.25, 0.45, 0.2);
    const double low[2] = {1.2, 0.9}, wide = 1.4, high = 1.1, radiance = 6;
    const opening hole = {low[0], low[1], low[0] + wide, low[1] + high};
    quad(s, floor, at(0, 0, 0), at(0, 0, 4.5), at(4, 0, 4.5), at(4, 0, 0));
    quad(s, white, at(0, 2.6, 0), at(4, 2.6, 0), at(4, 2.6, 4.5), at(0, 2.6, 4.5));
    quad(s, white, at(0, 0, 0), at(0, 2.6, 0), at(0, 2.6, 4.5), at(0, 0, 4.5));
    quad(s, white, at(4, 0, 0), at(4, 0, 4.5), at(4, 2.6, 4.5), at(4, 2.6, 0));
    quad(s, white, at(0, 0, 4.5), at(0, 2.6, 4.5), at(4, 2.6, 4.5), at(4, 0, 4.5));
    panel(s, white, at(0, 0, 0), at(4, 0, 0), at(0, 2.6, 0), &hole, 1);
    panel(s, pane, at(low[0], low[1], 0), at(wide, 0, 0), at(0, high, 0), NULL, 0);
    for (int c = 0; c < 3; ++c) {
        s->emission[pane][c] = radiance;
    }
    look(s, at(2.6, 1.5, 4.3), at(1.9, 0.7, 0.8), 62);
    object_begins(r);
    crate(s, green, at(2.0, 0, 1.3), at(0.5, 0.7, 0.4), 20);
    for (int i = 0; i < ROOM_LIGHTS; ++i) {
        scene_light *l = &r->told[r->told_count++];
        const double power = radiance * wide * high / ROOM_LIGHTS;
        l->kind = SCENE_SPOT;
        l->position = at(low[0] + wide * (0.125 + 0.25 * (i % 4)), low[1] + high * (0.25 + 0.5 * (i / 4)), 0.03);
        l->direction = at(0, 0, 1);
        l->rgb[0] = l->rgb[1] = l->rgb[2] = power;
        l->inner_deg = 1;
        l->outer_deg = 89;
    }
}

static void build_metal_ball(room *r)
{
    made_scene *s = &r->scene;
    const int floor = paint(s, 0.5, 0.45, 0.4), white = paint(s, 0.7, 0.7, 0.7), red = paint(s, 0.6, 0.2, 0.15);
    shell(s, floor, white, red, at(0, 0, 0), at(3.6, 2.5, 4));
    point(s, at(1.0, 2.1, 2.6), 9);
    look(s, at(2.9, 1.3, 3.7), at(1.5, 0.4, 1.2), 55);
    object_begins(r);
    ball_outside(s, metal(r, 0.95, 0.8, 0.5, 0.4), at(1.6, 0.35, 1.6), 0.35, 16);
    tell_lights(r);
}

static void build_lamp(room *r)
{
    made_scene *s = &r->scene;
    const int floor = paint(s, 0.5, 0.45, 0.4), white = paint(s, 0.7, 0.7, 0.7);
    shell(s, floor, white, white, at(0, 0, 0), at(3.6, 2.5, 4));
    point(s, at(2.6, 2.2, 2.8), 4);
    look(s, at(2.9, 1.3, 3.7), at(1.4, 0.4, 1.0), 55);
    object_begins(r);
    const int glow = paint(s, 0, 0, 0), foot = paint(s, 0.3, 0.3, 0.32);
    s->emission[glow][0] = 9;
    s->emission[glow][1] = 7.5;
    s->emission[glow][2] = 5;
    box(s, foot, at(1.38, 0, 1.18), at(1.62, 0.25, 1.42));
    box(s, glow, at(1.4, 0.25, 1.2), at(1.6, 0.45, 1.4));
    tell_lights(r);
}

/* --- held out: sizes, places, colours and lights are random, and the whole is turned ------------------------------ */

static int any_paint(made_scene *s, double low, double high)
{
    const double red = any_between(s, low, high), green = any_between(s, low, high), blue = any_between(s, low, high);
    return paint(s, red, green, blue);
}

/* A closed room seen towards its corner 0, 0, 0. */
static svec any_room(room *r, uint64_t seed)
{
    made_scene *s = &r->scene;
    s->random = seed;
    const double wide = any_between(s, 3.2, 4.5), high = any_between(s, 2.3, 2.8), deep = any_between(s, 3.4, 4.6);
    const int floor = any_paint(s, 0.3, 0.6), walls = any_paint(s, 0.55, 0.75), ceiling = any_paint(s, 0.6, 0.8);
    shell(s, floor, walls, ceiling, at(0, 0, 0), at(wide, high, deep));
    return at(wide, high, deep);
}

static void turn_any(room *r)
{
    scene_place p = scene_as_it_is();
    scene_turn(&p, at(0, 1, 0), any_between(&r->scene, 10, 80));
    scene_put(&r->scene, &p);
    tell_lights(r);
}

static void build_metal_tall(room *r)
{
    made_scene *s = &r->scene;
    const svec size = any_room(r, 501);
    spot(s, at(any_between(s, 0.5, 0.7) * size.x, 0.94 * size.y, any_between(s, 0.3, 0.4) * size.z), at(0.9, 0.3, 1.3),
         any_between(s, 18, 26), 28, 50);
    look(s, at(0.9 * size.x, 1.45, 0.92 * size.z), at(0.9, 0.5, 1.0), 58);
    object_begins(r);
    crate(s, metal(r, 0.93, 0.8, 0.55, any_between(s, 0.35, 0.5)),
          at(any_between(s, 0.7, 1.0), 0, any_between(s, 1.0, 1.4)), at(0.5, any_between(s, 0.7, 0.9), 0.45),
          any_between(s, 5, 85));
    turn_any(r);
}

static void build_glow_panel(room *r)
{
    made_scene *s = &r->scene;
    const svec size = any_room(r, 502);
    point(s, at(0.75 * size.x, 0.85 * size.y, any_between(s, 0.6, 0.8) * size.z), any_between(s, 3, 5));
    look(s, at(0.85 * size.x, 1.4, 0.93 * size.z), at(1.2, 0.4, 1.0), 56);
    object_begins(r);
    const int glow = paint(s, 0, 0, 0), foot = any_paint(s, 0.2, 0.5);
    s->emission[glow][0] = any_between(s, 6, 9);
    s->emission[glow][1] = any_between(s, 5, 7);
    s->emission[glow][2] = any_between(s, 3, 6);
    crate(s, foot, at(1.3, 0, 1.2), at(0.3, 0.2, 0.16), 30);
    slab(s, glow, at(1.15, 0.2, 1.2), at(0.26, 0, -0.15), at(0, 0.35, 0.1), at(0.03, 0, 0.05));
    turn_any(r);
}

static void build_copper_ball(room *r)
{
    made_scene *s = &r->scene;
    const svec size = any_room(r, 503);
    point(s, at(0.7 * size.x, 0.85 * size.y, any_between(s, 0.3, 0.5) * size.z), any_between(s, 7, 10));
    look(s, at(0.88 * size.x, 1.5, 0.93 * size.z), at(1.2, 0.6, 0.9), 62);
    object_begins(r);
    ball_outside(s, metal(r, 0.9, 0.6, 0.45, any_between(s, 0.3, 0.45)),
                 at(any_between(s, 1.2, 1.5), 0.3, any_between(s, 1.2, 1.5)), 0.3, 16);
    turn_any(r);
}

/* --- objects that emit light and stand on the floor --------------------------------------------------------------- */

static int glowing(made_scene *s, double red, double green, double blue)
{
    const int m = paint(s, 0, 0, 0);
    s->emission[m][0] = red;
    s->emission[m][1] = green;
    s->emission[m][2] = blue;
    return m;
}

/* A room under a lamp; the floor is as dark as many carpets. */
static int dark_floor(room *r, double floor)
{
    made_scene *s = &r->scene;
    const int white = paint(s, 0.6, 0.6, 0.58);
    shell(s, paint(s, floor, floor, floor), white, white, at(0, 0, 0), at(3.6, 2.5, 4));
    spot(s, at(2.4, 2.4, 2.9), at(1.8, 0, 2.06), 24, 40, 70);
    look(s, at(2.6, 1.3, 3.4), at(1.5, 0.2, 1.6), 46);
    object_begins(r);
    return glowing(s, 6, 5.5, 4.5);
}

static void build_glow_ball(room *r)
{
    const int glow = dark_floor(r, 0.2);
    ball_outside(&r->scene, glow, at(1.6, 0.2, 1.7), 0.2, 24);
    tell_lights(r);
}

static void build_glow_box(room *r)
{
    const int glow = dark_floor(r, 0.35);
    crate(&r->scene, glow, at(1.5, 0, 1.7), at(0.35, 0.15, 0.25), 35);
    tell_lights(r);
}

/* A cone on its tip, so that all of it except the lid leans over the floor. */
static void build_glow_cone(room *r)
{
    enum { SIDES = 24 };
    const int glow = dark_floor(r, 0.25);
    made_scene *s = &r->scene;
    for (int i = 0; i < SIDES; ++i) {
        const double a = 2.0 * 3.14159265358979 * i / SIDES, b = 2.0 * 3.14159265358979 * (i + 1) / SIDES;
        const svec c = at(1.6, 0, 1.7), low_a = plus(c, at(0.04 * cos(a), 0, 0.04 * sin(a))),
                   low_b = plus(c, at(0.04 * cos(b), 0, 0.04 * sin(b))),
                   high_a = plus(c, at(0.22 * cos(a), 0.35, 0.22 * sin(a))),
                   high_b = plus(c, at(0.22 * cos(b), 0.35, 0.22 * sin(b))), top = plus(c, at(0, 0.35, 0));
        quad(s, glow, low_a, high_a, high_b, low_b);
        quad(s, glow, high_a, top, top, high_b);
    }
    tell_lights(r);
}

/* The object is a ball or a box, the light a spot or a point. */
void room_any_metal(room *r, uint64_t seed)
{
    made_scene *s = &r->scene;
    const svec size = any_room(r, seed);
    const double x = any_between(s, 0.9, 1.4), z = any_between(s, 0.9, 1.5), radius = any_between(s, 0.2, 0.4);
    if (any_between(s, 0, 1) < 0.5) {
        spot(s, at(any_between(s, 0.4, 0.7) * size.x, 0.93 * size.y, any_between(s, 0.3, 0.6) * size.z), at(x, 0.2, z),
             any_between(s, 16, 26), 26, 52);
    } else {
        point(s, at(any_between(s, 0.3, 0.75) * size.x, 0.85 * size.y, any_between(s, 0.3, 0.7) * size.z),
              any_between(s, 6, 10));
    }
    look(s, at(any_between(s, 0.8, 0.9) * size.x, any_between(s, 1.3, 1.6), 0.92 * size.z), at(x, 0.45, z - 0.2),
         any_between(s, 54, 64));
    object_begins(r);
    const int m = metal(r, any_between(s, 0.85, 0.96), any_between(s, 0.6, 0.9), any_between(s, 0.4, 0.9),
                        any_between(s, 0.3, 0.5));
    if (any_between(s, 0, 1) < 0.5) {
        ball_outside(s, m, at(x, radius, z), radius, 16);
    } else {
        crate(s, m, at(x, 0, z), at(any_between(s, 0.3, 0.6), any_between(s, 0.4, 0.8), any_between(s, 0.3, 0.6)),
              any_between(s, 5, 85));
    }
    turn_any(r);
}

const room_kind room_kinds[] = {
    {"small_object", build_small_object, "a crate and a ball in a large room"},
    {"metal_box", build_metal_box, "a bright metal box near a wall"},
    {"window", build_window, "a crate before a window"},
    {"metal_ball", build_metal_ball, "a metal ball"},
    {"lamp", build_lamp, "a small lamp"},
    {"metal_tall", build_metal_tall, "held out: a turned metal box in a turned room"},
    {"glow_panel", build_glow_panel, "held out: a leaning panel that glows, on a foot"},
    {"copper_ball", build_copper_ball, "held out: a metal ball in a turned room"},
    {"glow_ball", build_glow_ball, "a ball that glows, on a dark floor"},
    {"glow_box", build_glow_box, "held out: a low box that glows, on the floor"},
    {"glow_cone", build_glow_cone, "held out: a cone that glows and stands on its tip"},
};
const int room_kind_count = COUNT_OF(room_kinds);
