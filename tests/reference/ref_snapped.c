/* ref_snapped.c: the slow rasterizer on corners snapped to 24.8: integer edges, binary64 depth. */
#include "reference.h"

#include <math.h>
#include <string.h>

enum { PLANES = 5, CORNERS = 3 + PLANES };

/* In clip space. The floats equal the fast rasterizer's; depth is z_exact / w_exact. */
typedef struct clip_corner {
    float x, y, z, w;
    double z_exact, w_exact;
} clip_corner;

/* On the screen: 24.8 from the frame's middle, y down. */
typedef struct screen_corner {
    int64_t x, y;
    float d_drawn;
    double d;
} screen_corner;

/* --- to clip space ------------------------------------------------------------------------------------------------ */

static float dot(lmb_vec3 a, float x, float y, float z) { return a.x * x + a.y * y + a.z * z; }

/* Metres from the eye along an axis; the term of the eye is one constant of the view. */
static float along(lmb_vec3 axis, const lmb_view *v, const float p[3])
{
    return dot(axis, p[0], p[1], p[2]) + dot(axis, 0.0f - v->eye.x, 0.0f - v->eye.y, 0.0f - v->eye.z);
}

static clip_corner to_clip(const lmb_view *v, const float p[3])
{
    const lmb_vec3 ahead = {v->back.x * -1.0f, v->back.y * -1.0f, v->back.z * -1.0f};
    const float m = along(ahead, v, p);
    clip_corner c;
    c.x = along(v->right, v, p) * (1.0f / v->half_width);
    c.y = along(v->up, v, p) * (1.0f / v->half_height);
    if (v->kind == LMB_ORTHOGRAPHIC) {
        c.z = (v->far_m - m) * (1.0f / (v->far_m - v->near_m));
        c.w = 1.0f;
        c.z_exact = ((double)v->far_m - (double)m) / ((double)v->far_m - (double)v->near_m);
        c.w_exact = 1.0;
    } else {
        c.z = v->near_m;
        c.w = m;
        c.z_exact = (double)v->near_m;
        c.w_exact = (double)m;
    }
    return c;
}

/* --- clipping ----------------------------------------------------------------------------------------------------- */

/* Negative if outside: nearer than the near plane, or more than 16383 px left, right, above or
 * below the frame's middle. */
static float inside(const lmb_view *v, const clip_corner *c, int plane)
{
    const float wide = 16383.0f * 2.0f / (float)v->frame_width, high = 16383.0f * 2.0f / (float)v->frame_height;
    switch (plane) {
    case 0: return c->w - c->z;
    case 1: return wide * c->w + c->x;
    case 2: return wide * c->w - c->x;
    case 3: return high * c->w - c->y;
    default: return high * c->w + c->y;
    }
}

static int earlier_bits(const clip_corner *a, const clip_corner *b)
{
    const float p[4] = {a->x, a->y, a->z, a->w}, q[4] = {b->x, b->y, b->z, b->w};
    for (int i = 0; i < 4; ++i) {
        uint32_t u, t;
        memcpy(&u, &p[i], 4);
        memcpy(&t, &q[i], 4);
        if (u != t) {
            return u < t;
        }
    }
    return 1;
}

/* Intersects the edge between two corners with a plane. Interpolates from the corner nearer to the plane; if both are
 * equally near, from the one with the smaller bits. */
static clip_corner cut_edge(const lmb_view *v, const clip_corner *p, const clip_corner *q, int plane)
{
    const float dp = inside(v, p, plane), dq = inside(v, q, plane);
    const int from_p = fabsf(dp) < fabsf(dq) || (fabsf(dp) == fabsf(dq) && earlier_bits(p, q));
    const clip_corner *a = from_p ? p : q, *b = from_p ? q : p;
    const float da = from_p ? dp : dq, db = from_p ? dq : dp, t = da / (da - db);
    const double t_exact = (double)da / ((double)da - (double)db);
    clip_corner r;
    r.x = a->x + (b->x - a->x) * t;
    r.y = a->y + (b->y - a->y) * t;
    r.z = a->z + (b->z - a->z) * t;
    r.w = plane == 0 ? r.z : a->w + (b->w - a->w) * t;
    r.z_exact = a->z_exact + (b->z_exact - a->z_exact) * t_exact;
    r.w_exact = plane == 0 ? r.z_exact : a->w_exact + (b->w_exact - a->w_exact) * t_exact;
    return r;
}

static int cut_polygon(const lmb_view *v, clip_corner *polygon, int n, int plane)
{
    clip_corner out[CORNERS + 1];
    int m = 0;
    for (int i = 0; i < n && m < CORNERS; ++i) {
        const clip_corner *a = &polygon[i], *b = &polygon[(i + 1) % n];
        const int a_in = inside(v, a, plane) >= 0.0f, b_in = inside(v, b, plane) >= 0.0f;
        if (a_in) {
            out[m++] = *a;
        }
        if (a_in != b_in) {
            out[m++] = cut_edge(v, a, b, plane);
        }
    }
    memcpy(polygon, out, (size_t)m * sizeof *out);
    return m;
}

/* Clips only against planes that cut the triangle itself. */
static int clip(const lmb_view *v, clip_corner polygon[CORNERS])
{
    int cuts[PLANES], n = 3;
    for (int plane = 0; plane < PLANES; ++plane) {
        cuts[plane] = 0;
        for (int i = 0; i < 3; ++i) {
            cuts[plane] |= inside(v, &polygon[i], plane) < 0.0f;
        }
    }
    for (int plane = 0; plane < PLANES && n >= 3; ++plane) {
        n = cuts[plane] ? cut_polygon(v, polygon, n, plane) : n;
    }
    return n;
}

/* --- to the screen ------------------------------------------------------------------------------------------------ */

/* 24.8, at most 16384 px from the middle, even if binary32 rounds a corner on the guard band past that. */
static int64_t snapped(float v) { return (int64_t)fminf(fmaxf(floorf(v), -4194304.0f), 4194304.0f); }

static screen_corner to_screen(const lmb_view *v, const clip_corner *c)
{
    const float inverse = 1.0f / c->w;
    screen_corner s;
    s.x = snapped(c->x * inverse * (float)(v->frame_width * 128) + 0.5f);
    s.y = snapped(0.5f - c->y * inverse * (float)(v->frame_height * 128));
    s.d_drawn = c->z * inverse;
    s.d = c->z_exact / c->w_exact;
    return s;
}

/* Twice the signed area of a, b and a point: positive if the point lies right of a -> b in the direction
 * of the edge, with y down. */
static int64_t edge(const screen_corner *a, const screen_corner *b, int64_t x, int64_t y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* The inside is right of the edge: left edges go up, top edges go right. */
static int covers(const screen_corner *a, const screen_corner *b, int64_t e)
{
    return e > 0 || (e == 0 && (b->y < a->y || (b->y == a->y && b->x > a->x)));
}

static int64_t min(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t max(int64_t a, int64_t b) { return a > b ? a : b; }

/* A pixel's centre relative to the middle of a frame of `side` px. */
static int64_t centre(int32_t pixel, int32_t side) { return 256 * (int64_t)pixel + 128 - 128 * (int64_t)side; }

/* The frame's first pixel with a centre not before `at`, and the last with a centre not past it; `side` and -1 if there
 * are none. (Centres are 256 apart.) */
static int32_t first_pixel(int64_t at, int32_t side)
{
    const int64_t behind = at - centre(0, side);
    return (int32_t)(behind <= 0 ? 0 : min(side, (behind + 255) / 256));
}

static int32_t last_pixel(int64_t at, int32_t side)
{
    const int64_t behind = at - centre(0, side);
    return (int32_t)(behind < 0 ? -1 : min(side - 1, behind / 256));
}

/* Slope a px of the plane through the drawn corners: the sum of the changes along x and y. */
static double drawn_slope(const screen_corner *a, const screen_corner *b, const screen_corner *c, int64_t area)
{
    const double bd = (double)b->d_drawn - (double)a->d_drawn, cd = (double)c->d_drawn - (double)a->d_drawn;
    const double along_x = bd * (double)(c->y - a->y) - cd * (double)(b->y - a->y);
    const double along_y = cd * (double)(b->x - a->x) - bd * (double)(c->x - a->x);
    return 256.0 * (fabs(along_x) + fabs(along_y)) / (double)area;
}

/* Returns the piece's pixel with the centre at (x, y), 24.8; 0 if it lies outside. */
static int cover(ref_pixel *p, const screen_corner *a, const screen_corner *b, const screen_corner *c, int64_t area,
                 int64_t x, int64_t y)
{
    const int64_t ab = edge(a, b, x, y), bc = edge(b, c, x, y), ca = edge(c, a, x, y);
    p->d = ((double)bc * a->d + (double)ca * b->d + (double)ab * c->d) / (double)area;
    return covers(a, b, ab) && covers(b, c, bc) && covers(c, a, ca) && p->d > 0.0;
}

/* Corners must be in the order of positive area. */
static void draw_piece(const lmb_view *v, const screen_corner *a, const screen_corner *b, const screen_corner *c,
                       ref_put *put, void *user)
{
    const int64_t area = edge(a, b, c->x, c->y);
    const int32_t width = v->frame_width, height = v->frame_height;
    const int32_t x0 = first_pixel(min(a->x, min(b->x, c->x)), width);
    const int32_t y0 = first_pixel(min(a->y, min(b->y, c->y)), height);
    const int32_t x1 = last_pixel(max(a->x, max(b->x, c->x)), width);
    const int32_t y1 = last_pixel(max(a->y, max(b->y, c->y)), height);
    ref_pixel p;
    p.low = fminf(a->d_drawn, fminf(b->d_drawn, c->d_drawn));
    p.high = fminf(1.0f, fmaxf(a->d_drawn, fmaxf(b->d_drawn, c->d_drawn)));
    p.slope = drawn_slope(a, b, c, area);
    for (p.y = y0; p.y <= y1; ++p.y) {
        for (p.x = x0; p.x <= x1; ++p.x) {
            if (cover(&p, a, b, c, area, centre(p.x, width), centre(p.y, height))) {
                put(user, &p);
            }
        }
    }
}

void ref_draw_snapped(const lmb_view *v, const float corner[3][3], int cull, ref_put *put, void *user)
{
    clip_corner polygon[CORNERS];
    screen_corner screen[CORNERS];
    for (int i = 0; i < 3; ++i) {
        polygon[i] = to_clip(v, corner[i]);
    }
    const int n = clip(v, polygon);
    for (int i = 0; i < n; ++i) {
        screen[i] = to_screen(v, &polygon[i]);
    }
    for (int i = 2; i < n; ++i) {
        /* y points down, so front faces, which are counter-clockwise, have negative area. */
        const int64_t area = edge(&screen[0], &screen[i - 1], screen[i].x, screen[i].y);
        if (area < 0) {
            draw_piece(v, &screen[0], &screen[i], &screen[i - 1], put, user);
        } else if (area > 0 && !cull) {
            draw_piece(v, &screen[0], &screen[i - 1], &screen[i], put, user);
        }
    }
}
