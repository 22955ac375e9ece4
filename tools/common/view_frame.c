/* view_frame.c: a default view that frames a scene without a camera. */
#include "view_frame.h"

#include <lambent/lookup.h>
#include <math.h>

#include "fvec.h"

#define FRAME_FOV 0.698f /* 40 degrees */
#define AIR       0.94   /* share of the picture that is filled, horizontally or vertically */
#define MUCH      0.25f
#define LONG      1.5f   /* depth over width from which the scene is seen from the side */
#define FLAT      0.2f   /* height over the shorter side below which it is seen from higher up */
#define SIDE      0.02   /* of the scene's size: surfaces this near to a side of the bounds close it */
#define WALL      0.6    /* covered share of a side that makes it a wall, or open */
#define HOLE      0.3

static float along(lmb_vec3 axis, lmb_vec3 a, lmb_vec3 b)
{
    return axis.x * (a.x - b.x) + axis.y * (a.y - b.y) + axis.z * (a.z - b.z);
}

/* Fetches triangle `id` if it is drawn: a corner that is not finite or beyond 2^20 m would distort the frame. */
static int fetch_drawn(lmb_triangle *t, const lmb_scene *s, uint32_t id)
{
    int is_drawn = lmb_triangle_fetch(t, s, id);
    for (int k = 0; k < 3 && is_drawn; ++k) {
        is_drawn = is_sane(t->corner[k].x) && is_sane(t->corner[k].y) && is_sane(t->corner[k].z);
    }
    return is_drawn;
}

/* The share of each of the six sides of the bounds that surfaces close: two per axis, the lower one first. */
static void find_closed(double closed[6], const lmb_scene *s)
{
    const float size[3] = {s->bounds_max.x - s->bounds_min.x, s->bounds_max.y - s->bounds_min.y,
                           s->bounds_max.z - s->bounds_min.z};
    lmb_triangle t;
    for (int side = 0; side < 6; ++side) {
        closed[side] = 0.0;
    }
    for (uint32_t id = 1; id <= lmb_scene_triangles(s); ++id) {
        if (!fetch_drawn(&t, s, id)) {
            continue;
        }
        for (int side = 0; side < 6; ++side) {
            const int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
            double at[3][3], off = 0.0;
            for (int k = 0; k < 3; ++k) {
                at[k][0] = (double)(t.corner[k].x - s->bounds_min.x);
                at[k][1] = (double)(t.corner[k].y - s->bounds_min.y);
                at[k][2] = (double)(t.corner[k].z - s->bounds_min.z);
                off = fmax(off, side & 1 ? (double)size[a] - at[k][a] : at[k][a]);
            }
            if (off <= SIDE * (double)size[a] && size[b] > 0.0f && size[c] > 0.0f) {
                closed[side] += 0.5 *
                                fabs((at[1][b] - at[0][b]) * (at[2][c] - at[0][c]) -
                                     (at[2][b] - at[0][b]) * (at[1][c] - at[0][c])) /
                                ((double)size[b] * (double)size[c]);
            }
        }
    }
}

/* Direction to the eye: slightly above, to the right of the front (+Z). Scenes that are long from front to back are
 * seen from the right side instead, flat ones from higher up, a room with one open wall through that wall. */
static lmb_vec3 direction_to_eye(const lmb_scene *s)
{
    const float x = s->bounds_max.x - s->bounds_min.x, y = s->bounds_max.y - s->bounds_min.y,
                z = s->bounds_max.z - s->bounds_min.z, up = y < FLAT * minf(x, z) ? 0.8f : 0.35f;
    const lmb_vec3 front = {0.45f, up, 0.82f}, right = {0.82f, up, 0.45f};
    static const lmb_vec3 through[6] = {{-0.95f, 0.2f, 0.3f}, {0.95f, 0.2f, 0.3f}, {0.3f, -0.95f, 0.3f},
                                        {0.35f, 0.9f, 0.6f},  {0.3f, 0.2f, -0.95f}, {0.3f, 0.2f, 0.95f}};
    double closed[6];
    int walls = 0, open = -1, holes = 0;
    find_closed(closed, s);
    for (int side = 0; side < 6; ++side) {
        walls += closed[side] >= WALL;
        if (closed[side] <= HOLE) {
            open = side;
            ++holes;
        }
    }
    if (walls == 5 && holes == 1 && open != 2) {
        return through[open];
    }
    return z > LONG * x ? right : front;
}

/* The extent of a scene in a view from `centre`: the largest distance to each plane through it. */
typedef struct scene_reach {
    double right, left, up, down, front;
} scene_reach;

static void add_reach(scene_reach *out, const lmb_view *v, lmb_vec3 p, lmb_vec3 centre)
{
    const double x = (double)along(v->right, p, centre), y = (double)along(v->up, p, centre),
                 z = (double)along(v->back, p, centre), wide = (double)v->half_width * AIR,
                 high = (double)v->half_height * AIR;
    out->right = fmax(out->right, x + wide * z);
    out->left = fmax(out->left, -x + wide * z);
    out->up = fmax(out->up, y + high * z);
    out->down = fmax(out->down, -y + high * z);
    out->front = fmax(out->front, z);
}

static scene_reach reach_of(const lmb_scene *s, const lmb_view *v, lmb_vec3 centre)
{
    scene_reach r = {-1e300, -1e300, -1e300, -1e300, -1e300};
    lmb_triangle t;
    for (uint32_t id = 1; id <= lmb_scene_triangles(s); ++id) {
        const int corners = fetch_drawn(&t, s, id) ? 3 : 0;
        for (int k = 0; k < corners; ++k) {
            add_reach(&r, v, t.corner[k], centre);
        }
    }
    return r;
}

/* Places the eye so that the scene just fits, with a small margin: it touches two opposite sides. */
static void fit(lmb_view *v, const scene_reach *r, lmb_vec3 centre, float size)
{
    const double wide = (double)v->half_width * AIR, high = (double)v->half_height * AIR;
    const float x = (float)(0.5 * (r->right - r->left)), y = (float)(0.5 * (r->up - r->down)),
                z = (float)fmax(fmax((r->right + r->left) / (2.0 * wide), (r->up + r->down) / (2.0 * high)),
                                r->front + 0.01 * (double)size);
    v->eye.x = centre.x + x * v->right.x + y * v->up.x + z * v->back.x;
    v->eye.y = centre.y + x * v->right.y + y * v->up.y + z * v->back.y;
    v->eye.z = centre.z + x * v->right.z + y * v->up.z + z * v->back.z;
}

/* The mismatch between a scene and an aspect ratio, width over height: absolute logarithm. */
static float misfit(float shape, float wide, float high) { return fabsf(logf(shape * high / wide)); }

/* The aspect ratio, of six, that a scene fills best; 4:3 if no other is much better. */
static float shape_of(const lmb_scene *s, const lmb_view *v, lmb_vec3 centre)
{
    static const float usual = 4.0f / 3.0f, shapes[5] = {1.0f / 3.0f, 0.5f, 0.75f, 2.0f, 3.0f};
    float wide = 0.0f, high = 0.0f, best = usual;
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 p = {i & 1 ? s->bounds_max.x : s->bounds_min.x, i & 2 ? s->bounds_max.y : s->bounds_min.y,
                            i & 4 ? s->bounds_max.z : s->bounds_min.z};
        wide = fmaxf(wide, fabsf(along(v->right, p, centre)));
        high = fmaxf(high, fabsf(along(v->up, p, centre)));
    }
    for (int i = 0; i < 5 && wide > 0.0f && high > 0.0f; ++i) {
        best = misfit(shapes[i], wide, high) + MUCH < misfit(usual, wide, high) &&
                       misfit(shapes[i], wide, high) < misfit(best, wide, high)
                   ? shapes[i]
                   : best;
    }
    return best;
}

static int has_drawn(const lmb_scene *s)
{
    lmb_triangle t;
    uint32_t id = lmb_scene_triangles(s);
    while (id > 0 && !fetch_drawn(&t, s, id)) {
        --id;
    }
    return id > 0;
}

int view_any(const lmb_scene *scene, const char *name, report *r)
{
    const lmb_vec3 lo = scene->bounds_min, hi = scene->bounds_max;
    if (lmb_scene_triangles(scene) == 0) {
        return report_fail(r, "%s: nothing to see: no triangles; `lambent info` lists the contents", name);
    }
    if (!has_drawn(scene)) {
        return report_fail(r, "%s: nothing to see: each triangle has a corner that is not finite or 2^20 m away", name);
    }
    return hi.x > lo.x || hi.y > lo.y || hi.z > lo.z ||
           report_fail(r, "%s: nothing to see: all triangles are in one point", name);
}

int view_frame(lmb_view *v, view_options *o, const lmb_scene *scene, const char *name, report *r)
{
    const lmb_vec3 lo = scene->bounds_min, hi = scene->bounds_max, to_eye = direction_to_eye(scene);
    const lmb_vec3 centre = {(lo.x + hi.x) * 0.5f, (lo.y + hi.y) * 0.5f, (lo.z + hi.z) * 0.5f};
    const float size = fmaxf(hi.x - lo.x, fmaxf(hi.y - lo.y, hi.z - lo.z));
    const lmb_vec3 from = {centre.x + size * to_eye.x, centre.y + size * to_eye.y, centre.z + size * to_eye.z};
    if (!view_any(scene, name, r)) {
        return 0;
    }
    if (lmb_view_look_at(v, from, centre, o->up, FRAME_FOV, 4, 3) == LMB_OK) {
        view_size(o, shape_of(scene, v, centre));
    }
    if (o->width == 0 || lmb_view_look_at(v, from, centre, o->up, FRAME_FOV, o->width, o->height) != LMB_OK) {
        return report_fail(r, "%s: no view frames the scene; give --eye and --target", name);
    }
    const scene_reach all = reach_of(scene, v, centre);
    fit(v, &all, centre, size);
    report_note(o->is_quiet, "no camera in %s: framing the scene from %.4g,%.4g,%.4g", name, (double)v->eye.x,
                (double)v->eye.y, (double)v->eye.z);
    return 1;
}
