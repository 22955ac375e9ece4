/* hard_sets.c: random triangles of kinds that are difficult for rasterizers, made in screen space and
 * transformed to the world. */
#include "hard_sets.h"

#include <math.h>
#include <string.h>

#include "../test.h"

enum { WIDTH = 163, HEIGHT = 117 }; /* not multiples of a tile */

/* A corner: px from the frame's top left, metres along the axis. */
typedef struct spot {
    double x, y, w;
} spot;

static double between(test_rng *r, double low, double high) { return (double)test_uniform(r, (float)low, (float)high); }
static double power(test_rng *r, double low, double high) { return pow(10.0, between(r, low, high)); }
static double either(test_rng *r) { return test_random(r) & 1u ? 1.0 : -1.0; }

/* Some way past the frame; depth from twice the near plane's distance on, in random steps. */
static spot anywhere(test_rng *r)
{
    spot s;
    s.x = between(r, -20.0, WIDTH + 20.0);
    s.y = between(r, -20.0, HEIGHT + 20.0);
    s.w = 2.0 * power(r, 0.0, 1.5);
    return s;
}

/* --- the kinds ---------------------------------------------------------------------------------------------------- */

static void make_sliver(test_rng *r, spot s[3])
{
    const double t = between(r, 0.0, 1.0), off = either(r) * power(r, -3.0, 0.5);
    double dx, dy, length;
    for (int k = 0; k < 3; ++k) {
        s[k] = anywhere(r);
    }
    dx = s[1].x - s[0].x;
    dy = s[1].y - s[0].y;
    length = hypot(dx, dy) + 1e-3;
    s[2].x = s[0].x + t * dx - off * dy / length;
    s[2].y = s[0].y + t * dy + off * dx / length;
}

static void make_speck(test_rng *r, spot s[3])
{
    const double size = power(r, -1.0, 0.7);
    const spot at = anywhere(r);
    for (int k = 0; k < 3; ++k) {
        s[k].x = at.x + size * between(r, -1.0, 1.0);
        s[k].y = at.y + size * between(r, -1.0, 1.0);
        s[k].w = at.w * (1.0 + 0.1 * between(r, 0.0, 1.0));
    }
}

static void make_huge(test_rng *r, spot s[3])
{
    for (int k = 0; k < 3; ++k) {
        s[k] = anywhere(r);
        s[k].x += either(r) * power(r, 2.0, 4.0);
        s[k].y += either(r) * power(r, 2.0, 4.0);
    }
}

/* One or two corners nearer than the near plane, or behind the eye. */
static void make_near(test_rng *r, spot s[3])
{
    const int behind = 1 + (int)(test_random(r) & 1u);
    for (int k = 0; k < 3; ++k) {
        s[k] = anywhere(r);
        if (k < behind) {
            s[k].w = between(r, -20.0, 1.0);
        }
    }
}

static void make_far_out(test_rng *r, spot s[3])
{
    for (int k = 0; k < 3; ++k) {
        s[k] = anywhere(r);
        if (k == 0 || (test_random(r) & 1u)) {
            s[k].x += either(r) * power(r, 3.5, 6.0);
            s[k].y += either(r) * power(r, 3.5, 6.0);
        }
    }
}

/* The whole depth of the scene within a few px. */
static void make_edge_on(test_rng *r, spot s[3])
{
    const double size = power(r, 0.0, 1.5);
    const spot at = anywhere(r);
    for (int k = 0; k < 3; ++k) {
        s[k].x = at.x + size * between(r, -1.0, 1.0);
        s[k].y = at.y + size * between(r, -1.0, 1.0);
        s[k].w = 1.01 * power(r, 0.0, 2.0);
    }
}

/* Corners and edges on pixel centres and borders; in four planes, so that many triangles are coplanar. */
static void make_grid(test_rng *r, spot s[3])
{
    const double reach = power(r, 0.3, 2.0), w = 2.0 + (double)(test_random(r) % 4);
    const spot at = anywhere(r);
    for (int k = 0; k < 3; ++k) {
        s[k].x = floor(at.x + reach * between(r, -1.0, 1.0)) * 0.5 * (double)(1 + (test_random(r) & 1u));
        s[k].y = floor(at.y + reach * between(r, -1.0, 1.0)) * 0.5 * (double)(1 + (test_random(r) & 1u));
        s[k].w = w;
    }
}

/* A right angle just past a tile's last pixel, almost parallel to the screen: an error of a few
 * ulps leaves the depth range. */
static void make_flat(test_rng *r, spot s[3])
{
    const double x = 8.0 * (double)(8 + test_random(r) % 12), y = 8.0 * (double)(8 + test_random(r) % 6);
    const double w = between(r, 20.0, 60.0), step = ldexp(1.0, -17); /* an ulp of orthographic depth */
    for (int k = 0; k < 3; ++k) {
        s[k].x = x - 0.5 + ldexp(1.0, -8);
        s[k].y = y - 0.5 + ldexp(1.0, -8);
        s[k].w = floor(w / step) * step + step * (double)(test_random(r) % 64);
    }
    s[1].x -= between(r, 70.0, 100.0);
    s[2].y -= between(r, 70.0, 100.0);
}

/* Boxes of about 64 px, the limit between small and large triangles, and of 10 to 1000 px, the limit of 32 bits. */
static void make_middling(test_rng *r, spot s[3])
{
    const int about_64 = (test_random(r) & 1u) != 0;
    const double wide = about_64 ? between(r, 63.0, 65.0) : power(r, 1.0, 3.0);
    const double high = about_64 ? between(r, 63.0, 65.0) : power(r, 1.0, 3.0);
    const double x = between(r, -0.5 * wide, WIDTH - 0.5 * wide), y = between(r, -0.5 * high, HEIGHT - 0.5 * high);
    for (int k = 0; k < 3; ++k) {
        s[k] = anywhere(r);
        s[k].x = x + (k == 0 ? 0.0 : k == 1 ? wide : between(r, 0.0, wide));
        s[k].y = y + (k == 0 ? between(r, 0.0, high) : k == 1 ? 0.0 : high);
    }
}

/* Beside the eye: x up to 1000 km, w from 0.1 um on. After the guard band clips it, x is off by many w in binary32. */
static void make_beside(test_rng *r, spot s[3])
{
    for (int k = 0; k < 3; ++k) {
        s[k].w = 1e-7 * power(r, 0.0, 2.0);
        s[k].x = 0.5 * WIDTH + either(r) * power(r, 5.0, 6.0) * 0.5 * WIDTH / s[k].w;
        s[k].y = between(r, -20.0, HEIGHT + 20.0);
    }
}

/* --- the sets ----------------------------------------------------------------------------------------------------- */

typedef struct kind {
    const char *name;
    void (*make)(test_rng *r, spot s[3]);
    int cull, steep;
} kind;

static const kind kinds[HARD_SETS / 2 - 1] = {
    {"slivers", make_sliver, 1, 1},
    {"sub-pixel", make_speck, 0, 0},
    {"huge", make_huge, 0, 0},
    {"near plane", make_near, 0, 0},
    {"guard band", make_far_out, 0, 0},
    {"edge-on", make_edge_on, 0, 1},
    {"on the grid", make_grid, 0, 0},
    {"flat corners", make_flat, 0, 0},
    {"all sizes", make_middling, 0, 0},
};
static const kind beside = {"beside the eye", make_beside, 0, 1};

static void set_view(lmb_view *v, int orthographic)
{
    static const lmb_vec3 eye = {1.5f, 2.25f, -3.0f}, target = {4.0f, 1.0f, 2.0f}, up = {0.0f, 1.0f, 0.0f};
    if (!orthographic) {
        lmb_view_look_at(v, eye, target, up, 1.0f, WIDTH, HEIGHT);
        v->near_m = 1.0f;
        return;
    }
    /* One metre a pixel, 1 to 129 m: binary32 represents positions and depths exactly. */
    memset(v, 0, sizeof *v);
    v->kind = LMB_ORTHOGRAPHIC;
    v->right.x = v->up.y = v->back.z = 1.0f;
    v->half_width = 0.5f * WIDTH;
    v->half_height = 0.5f * HEIGHT;
    v->near_m = 1.0f;
    v->far_m = 129.0f;
    v->frame_width = WIDTH;
    v->frame_height = HEIGHT;
}

/* Along the world's axes, so that rounding on one axis does not affect another. */
static void see_beside(lmb_view *v)
{
    set_view(v, 1);
    v->kind = LMB_PERSPECTIVE;
    v->half_width = v->half_height = 1.0f;
    v->near_m = 1e-7f;
}

static void place(float out[3], const lmb_view *v, const spot *s)
{
    const double each = v->kind == LMB_ORTHOGRAPHIC ? 1.0 : s->w;
    const double x = (s->x * 2.0 / WIDTH - 1.0) * (double)v->half_width * each;
    const double y = (1.0 - s->y * 2.0 / HEIGHT) * (double)v->half_height * each;
    out[0] = (float)((double)v->eye.x + x * (double)v->right.x + y * (double)v->up.x - s->w * (double)v->back.x);
    out[1] = (float)((double)v->eye.y + x * (double)v->right.y + y * (double)v->up.y - s->w * (double)v->back.y);
    out[2] = (float)((double)v->eye.z + x * (double)v->right.z + y * (double)v->up.z - s->w * (double)v->back.z);
}

static void set_scene(hard_set *h, uint32_t triangles)
{
    h->mesh.positions = h->corners;
    h->mesh.vertex_count = 3 * triangles;
    h->mesh.triangle_count = triangles;
    h->material.albedo[0] = h->material.albedo[1] = h->material.albedo[2] = h->material.alpha = 1.0f;
    h->material.texture = -1;
    h->material.flags = h->cull ? 0 : LMB_DOUBLE_SIDED;
    for (int i = 0; i < 4; ++i) {
        h->instance.to_world.m[5 * i] = 1.0f;
    }
    h->instance.first_id = 1;
    h->scene.meshes = &h->mesh;
    h->scene.materials = &h->material;
    h->scene.instances = &h->instance;
    h->scene.mesh_count = h->scene.material_count = h->scene.instance_count = 1;
    lmb_scene_bounds(&h->scene.bounds_min, &h->scene.bounds_max, &h->scene);
}

/* A tile that no edge crosses and that still needs the clamp. Depth rises by 0.1 ulp a px towards the right angle at
 * the tile's last pixel, 8 ulps in all. At the first pixel it is 6.6, which rounds to 7; 7 rows on it is 7.7, which
 * rounds to 8; 7 columns on it is 8.7, which rounds to 9. */
static void make_flat_corner(spot s[3])
{
    for (int k = 0; k < 3; ++k) {
        s[k].x = s[k].y = 87.5 + ldexp(1.0, -8);
        s[k].w = 32.0;
    }
    s[0].w -= 8.0 * ldexp(1.0, -17);
    s[1].x -= 80.0;
    s[2].y -= 80.0;
}

static void add_triangle(hard_set *h, int k, const spot s[3])
{
    for (int c = 0; c < 3; ++c) {
        place(h->corners[k][c], &h->view, &s[c]);
    }
}

void hard_set_make(hard_set *out, int i)
{
    test_rng r = {(uint64_t)i + 1};
    spot s[3];
    memset(out, 0, sizeof *out);
    set_view(&out->view, i & 1 || i == HARD_SETS - 1);
    if (i == HARD_SETS - 1) {
        out->name = "one flat corner";
        make_flat_corner(s);
        add_triangle(out, 0, s);
        set_scene(out, 1);
        return;
    }
    const kind *of = i == HARD_SETS - 2 ? &beside : &kinds[i / 2];
    if (of == &beside) {
        see_beside(&out->view);
    }
    out->name = of->name;
    out->cull = of->cull;
    out->steep = of->steep;
    for (int k = 0; k < HARD_TRIANGLES; ++k) {
        of->make(&r, s);
        add_triangle(out, k, s);
    }
    set_scene(out, HARD_TRIANGLES);
}
