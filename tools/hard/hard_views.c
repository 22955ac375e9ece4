/* hard_views.c: hard cases of views: each pixel must show the surface that its ray meets, in double and without
 * clipping.
 *
 * The ray of a pixel times the three planes through the eye and an edge (Olano and Greer's homogeneous edges) gives the
 * barycentric weights for any corners. A pixel counts only if the result is the same all around it, `slack` px. */
#include <math.h>
#include <string.h>

#include "hard.h"

enum { SIDE = HARD_SIDE };

/* Returns 1 if inside, with the distance along the axis, else 0. The ray must have length 1 along the axis. */
static int meets(double *w, const dvec t[3], dvec from, dvec ray, double near)
{
    const dvec a = dvec_sub(t[0], from), b = dvec_sub(t[1], from), c = dvec_sub(t[2], from);
    const double ea = dvec_dot(ray, dvec_cross(b, c)), eb = dvec_dot(ray, dvec_cross(c, a)),
                 ec = dvec_dot(ray, dvec_cross(a, b)), sum = ea + eb + ec;
    *w = dvec_dot(a, dvec_cross(b, c)) / sum;
    return sum != 0.0 && ea / sum >= 0.0 && eb / sum >= 0.0 && ec / sum >= 0.0 && *w >= near;
}

typedef struct view_count {
    double clear, wrong, deep; /* pixels that count; wrongly drawn or missing; with wrong depth */
} view_count;

/* Judges pixel (x, y) of a picture that shows only triangle `t`. */
static void judge_pixel(view_count *n, const hard_stage *s, uint32_t t, int32_t x, int32_t y, double slack)
{
    static const double off[5][2] = {{0, 0}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    const double near = (double)s->view.near_m, scale = s->view.kind == LMB_PERSPECTIVE ? 1.0 : 0.0;
    double min = HUGE_VAL, max = 0.0, w;
    int inside = 0;
    for (int i = 0; i < 5; ++i) {
        dvec from, ray = hard_ray(&from, &s->view, x + 0.5 + slack * off[i][0], y + 0.5 + slack * off[i][1]);
        const int in = meets(&w, s->world[t], from, ray, near * (i == 0 ? 1.0 : i & 1 ? 1.0 + 1e-5 : 1.0 - 1e-5));
        inside += in;
        min = in && w < min ? w : min;
        max = in && w > max ? w : max;
    }
    if (inside != 0 && inside != 5) {
        return;
    }
    const int drawn = s->id[hard_at(s, x, y)] != 0;
    ++n->clear;
    n->wrong += drawn != (inside == 5);
    if (drawn && inside == 5 && scale > 0.0) {
        const double got = near / (double)hard_depth(s, x, y);
        n->deep += got < min * (1.0 - 1e-6) || got > max * (1.0 + 1e-6);
    }
}

static void judge(view_count *n, hard_stage *s, double slack)
{
    for (uint32_t t = 0; t < s->count; ++t) {
        hard_draw(s, t, 1);
        for (int32_t i = 0; i < SIDE * SIDE; ++i) {
            judge_pixel(n, s, t, i % SIDE, i / SIDE, slack);
        }
    }
}

/* The point at a pixel and a distance in the current view. */
static dvec place(const hard_stage *s, double x, double y, double w)
{
    dvec from;
    const dvec ray = hard_ray(&from, &s->view, x, y);
    return dvec_add(from, dvec_mul(ray, w));
}

static double any(uint64_t *rng) { return hard_uniform(rng, -8.0, SIDE + 8.0); }

/* --- far corners, near planes ------------------------------------------------------------------------------------- */

/* Corners 2^k px away in all directions around the frame. */
static view_count far_corners(hard_stage *s, int k, double slack)
{
    view_count n = {0, 0, 0};
    uint64_t rng = (uint64_t)k;
    hard_begin(s, 1.0);
    for (int i = 0; i < 24; ++i) {
        dvec c[3];
        for (int v = 0; v < 3; ++v) {
            const double a = hard_uniform(&rng, 0.0, 6.2831853), r = ldexp(1.0, k),
                         w = 0.5 * pow(4.0, hard_uniform(&rng, 0, 1));
            c[v] = place(s, any(&rng) + (v > 0 ? r * cos(a) : 0.0), any(&rng) + (v > 0 ? r * sin(a) : 0.0), w);
        }
        hard_triangle(s, c[0], c[1], c[2]);
    }
    hard_end(s);
    judge(&n, s, slack);
    return n;
}

/* Triangles with `corners` corners at depths w_low .. w_high, about the near plane or behind the eye. */
static view_count near_corners(hard_stage *s, double w_low, double w_high, int corners, uint64_t seed)
{
    view_count n = {0, 0, 0};
    uint64_t rng = seed;
    hard_begin(s, 1.0);
    for (int i = 0; i < 40; ++i) {
        dvec c[3];
        for (int v = 0; v < 3; ++v) {
            const double w = v < corners ? hard_uniform(&rng, w_low, w_high) : pow(10.0, hard_uniform(&rng, -1.0, 1.5));
            c[v] = place(s, any(&rng), any(&rng), w);
        }
        hard_triangle(s, c[0], c[1], c[2]);
    }
    hard_end(s);
    judge(&n, s, 1.0 / 32.0);
    return n;
}

/* An eye inside a box, `gap` m from a wall: no ray escapes. */
static double open_around(hard_stage *s, double gap)
{
    double holes = 0.0;
    uint64_t rng = 12;
    for (int i = 0; i < 40; ++i) {
        const dvec at = dvec_of(hard_uniform(&rng, -0.9, 0.9), 1.0 - gap, hard_uniform(&rng, -0.9, 0.9));
        hard_begin(s, 1.0);
        hard_box(s, dvec_of(0, 0, 0), dvec_of(1, 1, 1));
        hard_end(s);
        hard_look(s, at, dvec_add(at, hard_direction(&rng)), 100.0, SIDE);
        s->view.near_m = (float)(0.25 * gap);
        hard_draw(s, 0, UINT32_MAX);
        for (int32_t k = 0; k < SIDE * SIDE; ++k) {
            holes += s->id[hard_at(s, k % SIDE, k / SIDE)] == 0;
        }
    }
    return holes;
}

static void near_and_far(hard_list *l)
{
    hard_stage *s = l->stage;
    view_count n;
    hard_look(s, dvec_of(0, 0, 0), dvec_of(0, 0, -1), 60.0, SIDE);
    s->view.near_m = 0.0625f;
    n = far_corners(s, 13, 1.0 / 64.0);
    hard_put(l, HARD_BOUNDED, "corners at 2^13 px: wrong beyond 1/64 px", hard_share(n.wrong, n.clear > 0), 0, "px");
    n = far_corners(s, 17, 1.0);
    hard_put(l, HARD_BOUNDED, "at 2^17 px, cut by the guard band: beyond 1 px", hard_share(n.wrong, n.clear > 0), 0,
             "px");
    n = near_corners(s, 0.0625 * (1 + 1e-6), 0.0625 * (1 + 1e-4), 1, 6);
    hard_put(l, HARD_BOUNDED, "a corner just past the near plane: wrong", hard_share(n.wrong, n.clear > 0), 0, "px");
    hard_put(l, HARD_BOUNDED, "its depth off the ray's", hard_share(n.deep, n.clear > 0), 0, "px");
    n = near_corners(s, -5.0, 0.05, 1, 7);
    hard_put(l, HARD_BOUNDED, "a corner behind the eye: wrong", hard_share(n.wrong, n.clear > 0), 0, "px");
    n = near_corners(s, -5.0, 0.05, 2, 8);
    hard_put(l, HARD_BOUNDED, "two corners behind the eye: wrong", hard_share(n.wrong, n.clear > 0), 0, "px");
    n = near_corners(s, 0.0624, 0.06245, 2, 9);
    hard_put(l, HARD_BOUNDED, "slivers on the near plane: wrong", hard_share(n.wrong, n.clear > 0), 0, "px");
    s->view.near_m = 1e-6f;
    n = near_corners(s, -1e-6, 1e-6, 1, 10);
    hard_put(l, HARD_BOUNDED, "w -> 0, near plane at a micrometre: wrong", hard_share(n.wrong, n.clear > 0), 0, "px");
    hard_put(l, HARD_EXACT, "triangles around the eye, 1 mm from a wall: holes", open_around(s, 1e-3), 0, "px");
    hard_put(l, HARD_EXACT, "the same, a micrometre", open_around(s, 1e-6), 0, "px");
}

/* --- scales and angles -------------------------------------------------------------------------------------------- */

/* Twelve triangles in front of the eye at `scale`, with `fov_deg`: corners inside and outside the frame. */
static void put_scaled(hard_stage *s, double scale, double fov_deg)
{
    uint64_t rng = 11;
    hard_look(s, dvec_of(0, 0, 0), dvec_of(0, 0, -scale), fov_deg, SIDE);
    s->view.near_m = (float)(0.01 * scale);
    hard_begin(s, 1.0);
    for (int i = 0; i < 12; ++i) {
        dvec c[3];
        for (int v = 0; v < 3; ++v) {
            c[v] = place(s, any(&rng), any(&rng), scale * hard_uniform(&rng, 0.2, 1.0));
        }
        hard_triangle(s, c[0], c[1], c[2]);
    }
    hard_end(s);
}

static double wrong_at(hard_stage *s, double scale, double fov_deg)
{
    view_count n = {0, 0, 0};
    put_scaled(s, scale, fov_deg);
    judge(&n, s, 1.0 / 64.0);
    return hard_share(n.wrong + n.deep, n.clear > 0);
}

/* Counts bits that differ from scale 1, with eye and corners scaled by a power of two. */
static double unlike_at(hard_stage *s, int power)
{
    static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    put_scaled(s, 1.0, 60.0);
    hard_draw(s, 0, UINT32_MAX);
    memcpy(depth, s->depth, sizeof depth);
    memcpy(id, s->id, sizeof id);
    for (uint32_t i = 0; i < 9 * s->count; ++i) {
        float *v = &s->corner[i / 9][i / 3 % 3][i % 3];
        *v = (float)ldexp((double)*v, power);
    }
    hard_end(s);
    s->view.near_m = (float)ldexp((double)s->view.near_m, power);
    hard_draw(s, 0, UINT32_MAX);
    double unlike = 0.0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        unlike += s->depth[i] != depth[i] || s->id[i] != id[i];
    }
    return unlike;
}

void hard_views(hard_list *l)
{
    hard_stage *s = l->stage;
    near_and_far(l);
    hard_put(l, HARD_EXACT, "scene x 2^-19, x 2^19: other bits than x 1", unlike_at(s, -19) + unlike_at(s, 19), 0,
             "px");
    hard_put(l, HARD_BOUNDED, "scene of a micrometre: wrong beyond 1/64 px", wrong_at(s, 1e-6, 60.0), 0, "px");
    hard_put(l, HARD_BOUNDED, "scene of 1000 km: the same", wrong_at(s, 1e6, 60.0), 0, "px");
    hard_put(l, HARD_BOUNDED, "field of view 0.01 degrees: the same", wrong_at(s, 1.0, 0.01), 0, "px");
    hard_put(l, HARD_BOUNDED, "178 degrees: the same", wrong_at(s, 1.0, 178.0), 0, "px");
}
