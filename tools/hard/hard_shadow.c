/* hard_shadow.c: hard cases of shadows: false dark (acne) and false light (detachment, leaks); rays in double. */
#include <math.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { SIDE = HARD_SIDE };

/* Pixels that face a light: lit or dark by rays; of these, dark or lit by the library. */
typedef struct shadow_count {
    double lit, dark, acne, leaks, not_finite, strays; /* strays: maximum false light / unshadowed light */
} shadow_count;

/* Does the light reach a point by rays? Scenes with masks need a separate function. */
typedef int (*sees_light)(const hard_stage *s, dvec at, dvec normal, uint32_t id);

static int sees_by_triangles(const hard_stage *s, dvec at, dvec normal, uint32_t id)
{
    return hard_true_direct(s, at, normal, id) > 0.0;
}

static void judge_tile(shadow_count *n, hard_stage *s, int32_t x, int32_t y, sees_light sees)
{
    static lmb_irradiance open;
    hard_direct(s, x, y);
    memset(&open, 0, sizeof open);
    lmb_direct_tile(&open, s->kernels, &s->tile, &s->view, &s->scene, &s->light, NULL);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float e = s->lit.rgb[0][k];
        dvec normal;
        n->not_finite += !(e >= 0.0f && e < 1e30f);
        if (s->tile.id[k] == 0 || !(open.rgb[0][k] > 0.0f)) {
            continue;
        }
        const dvec at = hard_surface(&normal, s, x + k % LMB_TILE, y + k / LMB_TILE, s->tile.id[k]);
        const int lit = sees(s, at, normal, s->tile.id[k]);
        n->lit += lit;
        n->dark += !lit;
        n->acne += lit && e == 0.0f;
        n->leaks += !lit && e > 0.0f;
        if (!lit && e > 0.0f) {
            const dvec to = dvec_sub(dvec_read(&s->light.position.x), at);
            n->strays = fmax(n->strays, (double)e * dvec_dot(to, to) / (double)s->light.intensity[0]);
        }
    }
}

static shadow_count judge(hard_stage *s, int32_t map, sees_light sees)
{
    shadow_count n = {0, 0, 0, 0, 0, 0};
    hard_draw(s, 0, UINT32_MAX);
    hard_map(s, map);
    for (int32_t y = 0; y < s->view.frame_height; y += LMB_TILE) {
        for (int32_t x = 0; x < s->view.frame_width; x += LMB_TILE) {
            judge_tile(&n, s, x, y, sees);
        }
    }
    return n;
}

/* Adds two cases: false dark among lit pixels, false light among dark ones. */
static void put_both(hard_list *l, const shadow_count *n, const char *acne, double acne_bar, const char *leaks,
                     double leak_bar)
{
    hard_put(l, HARD_MEASURED, acne, 100.0 * hard_share(n->acne, n->lit), acne_bar, "%");
    hard_put(l, HARD_MEASURED, leaks, 100.0 * hard_share(n->leaks, n->dark), leak_bar, "%");
}

/* --- scenes ------------------------------------------------------------------------------------------------------- */

static dvec sun_at(double from_zenith_deg)
{
    const double a = from_zenith_deg * PI / 180.0;
    return dvec_of(sin(a) * 0.8, -cos(a), sin(a) * 0.6);
}

static void begin_floor(hard_stage *s, dvec middle)
{
    hard_begin(s, 0.7);
    hard_quad(s, middle, dvec_of(3, 0, 0), dvec_of(0, 0, -3));
    hard_look(s, dvec_add(middle, dvec_of(1.5, 2.5, 3.0)), dvec_add(middle, dvec_of(0, 0.2, 0)), 55.0, SIDE);
}

/* Averages over positions a part of a texel apart: in a shadow of about 200 pixels, a single pixel would depend on the
 * alignment of texels. */
static shadow_count ball_on_floor(hard_stage *s, dvec middle, double zenith_deg)
{
    enum { PLACES = 8 };
    shadow_count all = {0, 0, 0, 0, 0, 0};
    for (int i = 0; i < PLACES; ++i) {
        begin_floor(s, middle);
        hard_ball(s, dvec_add(middle, dvec_of(0.0037 * i, 0.5, 0.0023 * i)), 0.5, 24);
        hard_sun(s, sun_at(zenith_deg), 3.0);
        hard_end(s);
        const shadow_count n = judge(s, HARD_MAP, sees_by_triangles);
        all.lit += n.lit;
        all.dark += n.dark;
        all.acne += n.acne;
        all.leaks += n.leaks;
        all.not_finite += n.not_finite;
        all.strays = fmax(all.strays, n.strays);
    }
    return all;
}

static void grazing(hard_list *l)
{
    static const double zenith[4] = {60.0, 85.0, 89.0, 89.9};
    hard_stage *s = l->stage;
    double acne = 0.0, lit = 0.0;
    for (int i = 0; i < 4; ++i) {
        begin_floor(s, dvec_of(0, 0, 0));
        hard_sun(s, sun_at(zenith[i]), 3.0);
        hard_end(s);
        const shadow_count n = judge(s, HARD_MAP, sees_by_triangles);
        acne += n.acne;
        lit += n.lit;
    }
    hard_put(l, HARD_EXACT, "a floor under suns at 60 .. 89.9 degrees: acne", lit > 0.0 ? acne : HUGE_VAL, 0, "px");
    shadow_count n = ball_on_floor(s, dvec_of(0, 0, 0), 45.0);
    put_both(l, &n, "ball on a floor, sun at 45 degrees, 512 texels: acne", 0.1, "its shadow: lit", 0.5);
    n = ball_on_floor(s, dvec_of(0, 0, 0), 85.0);
    put_both(l, &n, "sun at 85 degrees: acne", 0.1, "its shadow: lit", 1.5);
    n = ball_on_floor(s, dvec_of(0, 0, 0), 89.0);
    put_both(l, &n, "sun at 89 degrees: acne", 0.1, "its shadow: lit", 5);
    n = ball_on_floor(s, dvec_of(1e4, 0, -1e4), 45.0);
    put_both(l, &n, "10 km from the origin: acne", 0.1, "its shadow: lit", 0.5);
}

/* --- lights near surfaces ----------------------------------------------------------------------------------------- */

static void near_lights(hard_list *l)
{
    hard_stage *s = l->stage;
    begin_floor(s, dvec_of(0, 0, 0));
    hard_point(s, dvec_of(0.1, 1e-3, -0.2), 1e-3);
    hard_end(s);
    shadow_count n = judge(s, 256, sees_by_triangles);
    hard_put(l, HARD_MEASURED, "a light 1 mm over a floor: acne", 100.0 * hard_share(n.acne, n.lit), 0, "%");
    begin_floor(s, dvec_of(0, 0, 0));
    hard_point(s, dvec_of(0.1, 0, -0.2), 1e-3);
    hard_end(s);
    n = judge(s, 256, sees_by_triangles);
    hard_put(l, HARD_EXACT, "a light on the floor: no numbers", n.not_finite, 0, "px");
    hard_put(l, HARD_BOUNDED, "what reaches the floor, of light that faces it", 1e6 * n.strays, 1, "ppm");
    /* A slat shadows a wall 1 km away. The map's near plane lies at 1e-5 of the scene's diagonal: 2.3 cm here. */
    hard_begin(s, 0.5);
    hard_quad(s, dvec_of(0, 0, -1000), dvec_of(400, 0, 0), dvec_of(0, 400, 0));
    hard_quad(s, dvec_of(0.003, 0, -0.03), dvec_of(0.003, 0, 0), dvec_of(0, 0.0045, 0));
    hard_look(s, dvec_of(300, 200, -500), dvec_of(0, 0, -1000), 60.0, SIDE);
    hard_spot(s, dvec_of(0, 0, 0), dvec_of(0, 0, -1), 40.0, 1e6);
    hard_end(s);
    n = judge(s, HARD_MAP, sees_by_triangles);
    put_both(l, &n, "an occluder at 3 cm, a wall at 1 km: acne", 0.1, "its shadow: lit", 2.5);
}

/* --- thin things -------------------------------------------------------------------------------------------------- */

static shadow_count fence(hard_stage *s, double texels)
{
    const double texel = 6.1 / HARD_MAP;
    begin_floor(s, dvec_of(0, 0, 0));
    for (int i = -12; i <= 12; ++i) {
        hard_quad(s, dvec_of(0.1 * i, 0.5, 0), dvec_of(0.5 * texels * texel, 0, 0), dvec_of(0, 0, -1));
    }
    hard_sun(s, dvec_of(0.3, -1, 0.2), 3.0);
    hard_end(s);
    return judge(s, HARD_MAP, sees_by_triangles);
}

static void thin(hard_list *l)
{
    hard_stage *s = l->stage;
    shadow_count n = fence(s, 2.0);
    put_both(l, &n, "slats of two texels: acne", 0.1, "their shadow: lit", 12);
    n = fence(s, 0.5);
    hard_put(l, HARD_MEASURED, "slats of half a texel (documented: missed): their shadow lit",
             100.0 * hard_share(n.leaks, n.dark), 70, "%");
    begin_floor(s, dvec_of(0, 0, 0));
    hard_box(s, dvec_of(0, 0.251, 0), dvec_of(0.25, 0.25, 0.25));
    hard_sun(s, dvec_of(0.5, -1, 0.3), 3.0);
    hard_end(s);
    n = judge(s, HARD_MAP, sees_by_triangles);
    put_both(l, &n, "a crate 1 mm over its floor: acne", 0.1, "its shadow: lit", 0.5);
    begin_floor(s, dvec_of(0, 0, 0));
    hard_box(s, dvec_of(0, 0.5, 0), dvec_of(0.0005, 0.5, 1.0));
    hard_sun(s, dvec_of(1, -0.5, 0.2), 3.0);
    hard_end(s);
    n = judge(s, HARD_MAP, sees_by_triangles);
    put_both(l, &n, "a wall of 1 mm: acne", 0.1, "its shadow: lit", 0.3);
}

/* A floor and a wall, seen from inside the corner, with the sun on the wall's back; rotated about the foot, with a row
 * of pixels on it or nearly. Counts pixels of the floor that are lit. */
static void foot_of_wall(hard_list *l)
{
    enum { PLACES = 24 };
    hard_stage *s = l->stage;
    double specks = 0.0, pixels = 0.0;
    for (int i = 0; i < PLACES; ++i) {
        const dvec along = dvec_of(cos(0.7 * i), 0, sin(0.7 * i)), in = dvec_of(-along.z, 0, along.x);
        hard_begin(s, 0.7);
        hard_quad(s, dvec_mul(in, 4.0), dvec_mul(along, 8.0), dvec_mul(in, -4.0));
        hard_quad(s, dvec_of(0, 4, 0), dvec_mul(along, 8.0), dvec_of(0, 4, 0));
        const dvec eye = dvec_add(dvec_mul(in, 2.0), dvec_of(0, 1.0 + 1e-6 * i, 0));
        hard_look(s, eye, dvec_of(1e-6 * i, 1.0, 0), 2.0 * 180.0 / PI * atan(0.25 * SIDE / 16.5), SIDE);
        hard_sun(s, dvec_add(dvec_mul(in, 0.8), dvec_of(0, -0.6, 0)), 3.0);
        hard_end(s);
        for (int kind = LMB_PERSPECTIVE; kind <= LMB_ORTHOGRAPHIC; ++kind) {
            if (kind == LMB_ORTHOGRAPHIC) { /* half a pixel up, the middles of a row see the foot */
                const dvec up = dvec_mul(dvec_sub(dvec_of(0, 2, 0), in), 2.0 / SIDE / sqrt(5.0));
                hard_look(s, dvec_add(dvec_add(dvec_mul(in, 2.0), dvec_of(0, 1.0, 0)), up), up, 60.0, SIDE);
                s->view.kind = LMB_ORTHOGRAPHIC;
                s->view.half_width = s->view.half_height = 2.0f;
            }
            const shadow_count n = judge(s, HARD_MAP, sees_by_triangles);
            pixels += n.lit + n.dark;
            specks += n.leaks + n.lit - n.acne;
        }
    }
    hard_put(l, HARD_EXACT, "the foot of a wall whose back is lit: lit", pixels > 0.0 ? specks : HUGE_VAL, 0, "px");
}

/* --- transforms, masks, motion ------------------------------------------------------------------------------------ */

static void transforms(hard_list *l)
{
    hard_stage *s = l->stage;
    float *m;
    begin_floor(s, dvec_of(0, 0, 0));
    hard_part(s, 0.5);
    m = s->instance[1].to_world.m;
    m[0] = -1.5f, m[4] = 0.25f, m[5] = 0.5f, m[10] = 2.0f, m[13] = 0.25f;
    hard_ball(s, dvec_of(0, 0, 0), 0.5, 24);
    hard_sun(s, sun_at(45.0), 3.0);
    hard_end(s);
    shadow_count n = judge(s, HARD_MAP, sees_by_triangles);
    put_both(l, &n, "a ball mirrored, sheared, scaled unevenly: acne", 0.1, "its shadow: lit", 0.5);
    s->view.kind = LMB_ORTHOGRAPHIC;
    s->view.half_width = s->view.half_height = 2.0f;
    s->view.near_m = 0.1f;
    s->view.far_m = 20.0f;
    n = judge(s, HARD_MAP, sees_by_triangles);
    put_both(l, &n, "by an orthographic camera: acne", 0.1, "its shadow: lit", 1.2);
}

enum { HOLES = 8 };

/* Light through a square in y = 1, 2 m wide, of HOLES x HOLES fields, every other one open; triangles 3 and 4. */
static int sees_through_holes(const hard_stage *s, dvec at, dvec normal, uint32_t id)
{
    const lmb_light *l = &s->light;
    const dvec to = dvec_of(-(double)l->direction.x, -(double)l->direction.y, -(double)l->direction.z);
    if (dvec_dot(to, normal) <= 0.0 || id > 2) {
        return dvec_dot(to, normal) > 0.0;
    }
    const dvec p = dvec_add(at, dvec_mul(to, (1.0 - at.y) / to.y));
    const int u = (int)floor((p.x + 1.0) * 0.5 * HOLES), v = (int)floor((1.0 - p.z) * 0.5 * HOLES);
    return u < 0 || v < 0 || u >= HOLES || v >= HOLES || ((u ^ v) & 1) != 0;
}

static void masked(hard_list *l)
{
    static uint8_t texels[HOLES * HOLES * 4];
    hard_stage *s = l->stage;
    begin_floor(s, dvec_of(0, 0, 0));
    const uint32_t k = hard_part(s, 0.5);
    hard_quad(s, dvec_of(0, 1, 0), dvec_of(1, 0, 0), dvec_of(0, 0, -1));
    hard_holes(s, k, texels, HOLES);
    hard_sun(s, dvec_of(0.2, -1, 0.1), 3.0);
    hard_end(s);
    const shadow_count n = judge(s, HARD_MAP, sees_through_holes);
    put_both(l, &n, "an alpha-masked caster: acne", 0.1, "its shadow: lit", 0.3);
}

/* Lit pixels, by the library and by rays, of the floor under a crate, with the sun rotated by `step` tenths of a
 * texel. */
static void take_step(uint8_t out[SIDE * SIDE][2], hard_stage *s, int step)
{
    const double a = 0.5 + step * 0.1 * 6.0 / HARD_MAP;
    begin_floor(s, dvec_of(0, 0, 0));
    hard_box(s, dvec_of(0, 0.4, 0), dvec_of(0.3, 0.3, 0.3));
    hard_sun(s, dvec_of(sin(a), -cos(a), 0.3), 3.0);
    hard_end(s);
    hard_draw(s, 0, UINT32_MAX);
    hard_map(s, HARD_MAP);
    for (int32_t tile = 0; tile < SIDE * SIDE / LMB_TILE_PIXELS; ++tile) {
        const int32_t x = tile % (SIDE / LMB_TILE) * LMB_TILE, y = tile / (SIDE / LMB_TILE) * LMB_TILE;
        hard_direct(s, x, y);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            dvec normal = {0, 0, 0}, at = {0, 0, 0};
            const uint32_t id = s->tile.id[k];
            if (id != 0) {
                at = hard_surface(&normal, s, x + k % LMB_TILE, y + k / LMB_TILE, id);
            }
            out[tile * LMB_TILE_PIXELS + k][0] = s->lit.rgb[0][k] > 0.0f;
            out[tile * LMB_TILE_PIXELS + k][1] = id != 0 && sees_by_triangles(s, at, normal, id);
        }
    }
}

/* Pixels that change from step to step although the rays agree. */
static void motion(hard_list *l)
{
    static uint8_t before[SIDE * SIDE][2], now[SIDE * SIDE][2];
    double steady = 0.0, flicker = 0.0;
    take_step(before, l->stage, 0);
    for (int step = 1; step < 8; ++step) {
        take_step(now, l->stage, step);
        for (int32_t i = 0; i < SIDE * SIDE; ++i) {
            steady += before[i][1] == now[i][1];
            flicker += before[i][1] == now[i][1] && before[i][0] != now[i][0];
        }
        memcpy(before, now, sizeof before);
    }
    hard_put(l, HARD_MEASURED, "a sun that moves by tenths of a texel: pixels that flicker",
             100.0 * hard_share(flicker, steady), 0.05, "%");
}

/* --- closed rooms ------------------------------------------------------------------------------------------------- */

/* Lit pixels in corners of 100 closed rooms of one leaf, with a light outside and ground below. */
static double lit_in_rooms(hard_stage *s, uint64_t rng, double fov_deg, int is_sun)
{
    double lit = 0.0;
    for (int i = 0; i < 100; ++i) {
        double v[8];
        for (int k = 0; k < 8; ++k) {
            v[k] = hard_uniform(&rng, -1, 1);
        }
        const dvec half = dvec_of(0.55 + 0.25 * v[0], 0.55 + 0.25 * v[1], 0.55 + 0.25 * v[2]);
        const dvec eye = dvec_of(0.9 * half.x * v[3], 0.9 * half.y * v[4], 0.9 * half.z * v[5]);
        const dvec corner = dvec_of(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
        const dvec lamp = dvec_of(3 * v[6], half.y + 1.6 + v[0], 3 * v[7]);
        hard_begin(s, 0.5);
        hard_box(s, dvec_of(0, 0, 0), half);
        hard_quad(s, dvec_of(0, -half.y - 0.001, 0), dvec_of(10, 0, 0), dvec_of(0, 0, -10));
        if (is_sun) {
            hard_sun(s, dvec_of(-lamp.x, -lamp.y, -lamp.z), 10);
        } else {
            hard_point(s, lamp, 30);
        }
        hard_end(s);
        hard_look(s, eye, corner, fov_deg, SIDE);
        s->view.near_m = 0.01f;
        hard_draw(s, 0, UINT32_MAX);
        hard_map(s, HARD_MAP);
        for (int32_t k = 0; k < SIDE * SIDE / LMB_TILE_PIXELS; ++k) {
            hard_direct(s, k % (SIDE / LMB_TILE) * LMB_TILE, k / (SIDE / LMB_TILE) * LMB_TILE);
            for (int j = 0; j < LMB_TILE_PIXELS; ++j) {
                lit += s->lit.rgb[0][j] > 0.0f;
            }
        }
    }
    return lit;
}

void hard_shadow(hard_list *l)
{
    grazing(l);
    near_lights(l);
    thin(l);
    foot_of_wall(l);
    transforms(l);
    masked(l);
    motion(l);
    hard_put(l, HARD_MEASURED, "corners of 100 closed rooms, lit from outside", lit_in_rooms(l->stage, 7, 60.0, 0), 16,
             "px");
    hard_put(l, HARD_MEASURED, "the same, seen through a telephoto lens", lit_in_rooms(l->stage, 11, 8.0, 0), 1, "px");
    hard_put(l, HARD_MEASURED, "corners of 100 closed rooms in sunlight", lit_in_rooms(l->stage, 13, 60.0, 1), 112,
             "px");
    hard_put(l, HARD_MEASURED, "the same, seen through a telephoto lens", lit_in_rooms(l->stage, 17, 8.0, 1), 101,
             "px");
}
