/* ref_exact.c: the slow rasterizer with everything in binary64, without snapping. */
#include "reference.h"

#include <math.h>
#include <string.h>

/* Metres, scaled to half width 1; depth is z / w. */
typedef struct clip_corner {
    double x, y, z, w;
} clip_corner;

/* Pixels of the frame, y down. */
typedef struct screen_corner {
    double x, y, d;
} screen_corner;

static double along(lmb_vec3 axis, const lmb_view *v, const float p[3])
{
    return (double)axis.x * ((double)p[0] - (double)v->eye.x) + (double)axis.y * ((double)p[1] - (double)v->eye.y) +
           (double)axis.z * ((double)p[2] - (double)v->eye.z);
}

static clip_corner to_clip(const lmb_view *v, const float p[3])
{
    const double near_m = (double)v->near_m, far_m = (double)v->far_m, m = -along(v->back, v, p);
    clip_corner c;
    c.x = along(v->right, v, p) / (double)v->half_width;
    c.y = along(v->up, v, p) / (double)v->half_height;
    c.z = v->kind == LMB_ORTHOGRAPHIC ? (far_m - m) / (far_m - near_m) : near_m;
    c.w = v->kind == LMB_ORTHOGRAPHIC ? 1.0 : m;
    return c;
}

static clip_corner on_near_plane(const clip_corner *a, const clip_corner *b)
{
    const double da = a->w - a->z, db = b->w - b->z, t = da / (da - db);
    clip_corner r;
    r.x = a->x + (b->x - a->x) * t;
    r.y = a->y + (b->y - a->y) * t;
    r.z = a->z + (b->z - a->z) * t;
    r.w = r.z;
    return r;
}

static int clip_near(clip_corner out[4], const clip_corner in[3])
{
    int n = 0;
    for (int i = 0; i < 3; ++i) {
        const clip_corner *a = &in[i], *b = &in[(i + 1) % 3];
        if (a->w >= a->z) {
            out[n++] = *a;
        }
        if ((a->w >= a->z) != (b->w >= b->z)) {
            out[n++] = on_near_plane(a, b);
        }
    }
    return n;
}

static screen_corner to_screen(const lmb_view *v, const clip_corner *c)
{
    screen_corner s;
    s.x = (0.5 + 0.5 * c->x / c->w) * v->frame_width;
    s.y = (0.5 - 0.5 * c->y / c->w) * v->frame_height;
    s.d = c->z / c->w;
    return s;
}

static double edge(const screen_corner *a, const screen_corner *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static int covers(const screen_corner *a, const screen_corner *b, double e)
{
    return e > 0.0 || (e == 0.0 && (b->y < a->y || (b->y == a->y && b->x > a->x)));
}

static int cover(ref_pixel *p, const screen_corner *a, const screen_corner *b, const screen_corner *c, double area)
{
    const double x = p->x + 0.5, y = p->y + 0.5, ab = edge(a, b, x, y), bc = edge(b, c, x, y), ca = edge(c, a, x, y);
    p->d = (bc * a->d + ca * b->d + ab * c->d) / area;
    return covers(a, b, ab) && covers(b, c, bc) && covers(c, a, ca) && p->d > 0.0;
}

/* Clamps to the frame, whatever the triangle's size. */
static int32_t pixel_of(double at, int32_t side) { return (int32_t)fmax(0.0, fmin(at, (double)side)); }

/* Corners must be in the order of positive area. */
static void draw_piece(const lmb_view *v, const screen_corner *a, const screen_corner *b, const screen_corner *c,
                       ref_put *put, void *user)
{
    const double area = edge(a, b, c->x, c->y);
    const int32_t width = v->frame_width, height = v->frame_height;
    const int32_t x0 = pixel_of(fmin(a->x, fmin(b->x, c->x)), width);
    const int32_t y0 = pixel_of(fmin(a->y, fmin(b->y, c->y)), height);
    const int32_t x1 = pixel_of(fmax(a->x, fmax(b->x, c->x)), width - 1);
    const int32_t y1 = pixel_of(fmax(a->y, fmax(b->y, c->y)), height - 1);
    ref_pixel p;
    p.low = p.high = 0.0f;
    p.slope = 0.0;
    for (p.y = y0; p.y <= y1; ++p.y) {
        for (p.x = x0; p.x <= x1; ++p.x) {
            if (cover(&p, a, b, c, area)) {
                put(user, &p);
            }
        }
    }
}

void ref_draw_exact(const lmb_view *v, const float corner[3][3], int cull, ref_put *put, void *user)
{
    clip_corner in[3], polygon[4];
    screen_corner screen[4];
    for (int i = 0; i < 3; ++i) {
        in[i] = to_clip(v, corner[i]);
    }
    const int n = clip_near(polygon, in);
    for (int i = 0; i < n; ++i) {
        screen[i] = to_screen(v, &polygon[i]);
    }
    for (int i = 2; i < n; ++i) {
        const double area = edge(&screen[0], &screen[i - 1], screen[i].x, screen[i].y);
        if (area < 0.0) {
            draw_piece(v, &screen[0], &screen[i], &screen[i - 1], put, user);
        } else if (area > 0.0 && !cull) {
            draw_piece(v, &screen[0], &screen[i - 1], &screen[i], put, user);
        }
    }
}
