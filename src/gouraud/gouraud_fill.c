/* gouraud_fill.c: clips, and fills row by row: edges and colours in integers. Layer 10.
 *
 * Corners lie within GOURAUD_GUARD times the target, of LMB_GOURAUD_MAX_SIDE px: differences are at most 16,384 in 1/16
 * px, so that an area, and 2^14 times a difference, fit 32 bits. An edge's place in a row depends on its two ends alone, taken from top to bottom: neighbours share it,
 * and a pixel whose middle lies on it belongs to one of them. */
#include "gouraud_fill.h"

#include "../base/vec.h"

#if LMB_TRANSFER

/* Of bits that are not 0. */
static inline int highest_bit(uint32_t bits)
{
#if defined(__GNUC__)
    return 31 - __builtin_clz(bits);
#else
    int n = 0;
    for (; (bits >>= 1) != 0;) {
        ++n;
    }
    return n;
#endif
}

enum { CORNERS = 8 }; /* of a triangle that five planes have cut */

/* --- before the division ------------------------------------------------------------------------------------------ */

static void set_row(float row[4], lmb_vec3 axis, const lmb_mat4 *t, lmb_vec3 eye)
{
    const float *m = t->m;
    for (int c = 0; c < 3; ++c) {
        row[c] = dot3(axis, vec3(m[4 * c], m[4 * c + 1], m[4 * c + 2]));
    }
    row[3] = dot3(axis, sub3(vec3(m[12], m[13], m[14]), eye));
}

void lmb_gouraud_view_of(gouraud_view *out, const lmb_view *v, const lmb_mat4 *to_world)
{
    set_row(out->row[0], v->right, to_world, v->eye);
    set_row(out->row[1], v->up, to_world, v->eye);
    set_row(out->row[2], mul3(v->back, -1.0f), to_world, v->eye);
    out->scale_x = 1.0f / v->half_width;
    out->scale_y = 1.0f / v->half_height;
    out->near_m = v->near_m;
    out->far_m = v->far_m;
    out->is_far = v->kind == LMB_ORTHOGRAPHIC;
    out->depth_scale = out->is_far ? 1.0f / (v->far_m - v->near_m) : 0.0f;
}

static float along(const float row[4], lmb_vec3 p) { return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]; }

uint32_t lmb_gouraud_project(gouraud_point *out, const gouraud_view *v, lmb_vec3 p)
{
    const float x = along(v->row[0], p), y = along(v->row[1], p), w = along(v->row[2], p);
    out->x = x * v->scale_x;
    out->y = y * v->scale_y;
    out->z = v->is_far ? (v->far_m - w) * v->depth_scale : v->near_m;
    out->w = v->is_far ? 1.0f : w;
    const float guard = (float)GOURAUD_GUARD * out->w;
    if (!(x * x + y * y + w * w < 1e12f)) { /* 1,000 km, or no number */
        return GOURAUD_OUTSIDE;
    }
    return (uint32_t)(out->w < out->z) | (uint32_t)(guard + out->x < 0.0f) << 1 | (uint32_t)(guard - out->x < 0.0f) << 2 |
           (uint32_t)(guard - out->y < 0.0f) << 3 | (uint32_t)(guard + out->y < 0.0f) << 4;
}

/* How far inside a plane a point is. */
static float inside(const gouraud_point *p, int plane)
{
    const float guard = (float)GOURAUD_GUARD * p->w;
    switch (plane) {
    case 0: return p->w - p->z;
    case 1: return guard + p->x;
    case 2: return guard - p->x;
    case 3: return guard - p->y;
    default: return guard + p->y;
    }
}

/* Where the way from a, inside, to b, outside, meets the plane. */
static gouraud_point cut(const gouraud_point *a, const gouraud_point *b, float in, float out)
{
    const float t = in / (in - out);
    gouraud_point p;
    p.x = a->x + (b->x - a->x) * t;
    p.y = a->y + (b->y - a->y) * t;
    p.z = a->z + (b->z - a->z) * t;
    p.w = a->w + (b->w - a->w) * t;
    for (int c = 0; c < 3; ++c) {
        p.colour[c] = a->colour[c] + (b->colour[c] - a->colour[c]) * t;
    }
    return p;
}

/* Always from the inside to the outside, so that neighbours cut a shared edge at one place. */
static int cut_plane(gouraud_point *out, const gouraud_point *p, int count, int plane)
{
    int n = 0;
    for (int i = 0; i < count; ++i) {
        const gouraud_point *a = &p[i], *b = &p[i + 1 < count ? i + 1 : 0];
        const float at = inside(a, plane), bt = inside(b, plane);
        if (at >= 0.0f) {
            out[n++] = *a;
        }
        if ((at >= 0.0f) != (bt >= 0.0f)) {
            out[n++] = at >= 0.0f ? cut(a, b, at, bt) : cut(b, a, bt, at);
        }
    }
    return n;
}

/* 1/16 px from the target's edge. */
static int32_t to_sixteenths(float part, int32_t size)
{
    const float at = (part + 1.0f) * (8.0f * (float)size) + 0.5f;
    const int32_t i = (int32_t)at;
    return i - ((float)i > at);
}

void lmb_gouraud_point_of(int32_t *x, int32_t *y, float *d, const gouraud_target *t, const gouraud_point *p)
{
    const float inverse = 1.0f / p->w;
    *x = to_sixteenths(p->x * inverse, t->width);
    *y = to_sixteenths(-p->y * inverse, t->height);
    *d = p->z * inverse; /* at most 1: raster/setup.c */
}

gouraud_corner lmb_gouraud_place(const gouraud_target *t, const gouraud_point *p)
{
    gouraud_corner c;
    lmb_gouraud_point_of(&c.x, &c.y, &c.d, t, p);
    c.colour[0] = p->colour[0], c.colour[1] = p->colour[1], c.colour[2] = p->colour[2];
    return c;
}

/* A corner cut where x or y was huge beside w lies on the guard only as well as binary32 puts it there. */
static gouraud_corner place_cut(const gouraud_target *t, gouraud_point p)
{
    const float guard = (float)GOURAUD_GUARD * p.w;
    p.x = clampf(p.x, -guard, guard);
    p.y = clampf(p.y, -guard, guard);
    p.z = clampf(p.z, 0.0f, p.w);
    return lmb_gouraud_place(t, &p);
}

void lmb_gouraud_clip(const gouraud_target *t, const gouraud_point p[3], uint32_t any, uint32_t id, int how)
{
    gouraud_point a[CORNERS + 1] = {p[0], p[1], p[2]}, b[CORNERS + 1];
    int count = 3;
    for (int plane = 0; plane < 5 && count >= 3; ++plane) {
        if ((any >> plane & 1u) == 0) {
            continue;
        }
        count = cut_plane(b, a, count, plane);
        for (int i = 0; i < count; ++i) {
            a[i] = b[i];
        }
    }
    if (count < 3) {
        return;
    }
    gouraud_corner c[3];
    c[0] = place_cut(t, a[0]);
    c[2] = place_cut(t, a[1]);
    for (int i = 2; i < count; ++i) {
        c[1] = c[2];
        c[2] = place_cut(t, a[i]);
        lmb_gouraud_fill(t, c, id, how);
    }
}

/* --- rows --------------------------------------------------------------------------------------------------------- */

/* From an upper end down to a lower one; x in 1/16 px, `slope` in 2^-14. */
typedef struct edge {
    int32_t x, y, past, slope;
} edge;

static edge edge_of(const gouraud_corner *from, const gouraud_corner *to)
{
    edge e;
    const int32_t down = to->y - from->y;
    e.x = from->x;
    e.y = from->y;
    e.past = to->y;
    e.slope = down > 0 ? (to->x - from->x) * 16384 / down : 0;
    return e;
}

/* In 2^-14 px, in a row whose middle lies between the edge's ends. */
static int32_t edge_at(const edge *e, int32_t middle) { return e->x * 1024 + ((e->slope * (middle - e->y)) >> 4); }

/* By how much an edge that is a sixteenth of a pixel farther out, down or across, lies to the side. */
static int32_t edge_growth(const edge *e) { return ((e->slope < 0 ? -e->slope : e->slope) >> 4) + 1024; }

/* The first pixel whose middle is not left of x. */
static int32_t first_pixel(int32_t x) { return (x + 8191) >> 14; }

/* A number that is linear on the triangle, within 0 .. max. */
typedef struct plane {
    float at, per_x, per_y, max; /* at the first corner; per px */
} plane;

static plane plane_of(const gouraud_corner c[3], float f0, float f1, float f2, float per_area, float max)
{
    const float a = f1 - f0, b = f2 - f0;
    plane p;
    p.at = f0;
    p.per_x = (a * (float)(c[2].y - c[0].y) - b * (float)(c[1].y - c[0].y)) * per_area;
    p.per_y = (b * (float)(c[1].x - c[0].x) - a * (float)(c[2].x - c[0].x)) * per_area;
    p.max = max;
    return p;
}

/* x and y: px from the first corner. */
static float plane_at(const plane *p, float x, float y) { return clampf(p->at + p->per_y * y + p->per_x * x, 0.0f, p->max); }

/* A number along a row: at its first pixel, and from pixel to pixel, both ends within the plane's range. */
typedef struct ramp {
    int32_t at, step;
} ramp;

static ramp ramp_of(const plane *p, float x, float y, int32_t count)
{
    ramp r;
    r.at = (int32_t)plane_at(p, x, y);
    r.step = 0;
    if (count > 1) {
        r.step = ((int32_t)plane_at(p, x + (float)(count - 1), y) - r.at) / (count - 1);
    }
    return r;
}

/* Bayer's matrix (1973) of 4 x 4 in sixteenths, less half of one. */
static const uint16_t dither[4][4] = {{2048, 34816, 10240, 43008},
                                      {51200, 18432, 59392, 26624},
                                      {14336, 47104, 6144, 38912},
                                      {63488, 30720, 55296, 22528}};

/* 0 .. 2^30 in 16 bits: an exponent of 4 and 12 below its leading bit, so that far surfaces are told apart like near
 * ones; under 2^15 all 12 are of one size. */
static uint16_t depth_code(int32_t depth)
{
    const uint32_t v = (uint32_t)depth;
    if (v < 32768u) {
        return (uint16_t)(v >> 3);
    }
    const int bit = highest_bit(v);
    return (uint16_t)((uint32_t)(bit - 14) << 12 | (v >> (bit - 12) & 4095u));
}

typedef struct filler {
    const gouraud_target *t;
    const gouraud_corner *c;
    plane depth, colour[3];
    uint32_t id;
    int how;
    int32_t flat[3];     /* the colour of GOURAUD_FLAT */
    int32_t first, past; /* pixels across that it may cover */
} filler;

/* Colours have 16 bits below those that are kept. */
static void fill_row(const filler *f, int32_t x, int32_t y, int32_t count)
{
    const gouraud_target *t = f->t;
    const float dx = (float)(16 * x + 8 - f->c[0].x) * 0.0625f, dy = (float)(16 * y + 8 - f->c[0].y) * 0.0625f;
    const ramp d = ramp_of(&f->depth, dx, dy, count), r = ramp_of(&f->colour[0], dx, dy, count),
               g = ramp_of(&f->colour[1], dx, dy, count), b = ramp_of(&f->colour[2], dx, dy, count);
    uint16_t *depth = t->depth16 + y * t->step + x, *pixel = t->pixel + y * t->pixel_step + x;
    const uint16_t *threshold = dither[y & 3];
    int32_t at = d.at, red = r.at, green = g.at, blue = b.at;
    for (int32_t i = 0; i < count; ++i) {
        const uint16_t own = depth_code(at);
        if (own > depth[i]) {
            const int32_t low = threshold[(x + i) & 3];
            depth[i] = own;
            pixel[i] = (uint16_t)((red + low) >> 16 << 11 | (green + low) >> 16 << 5 | (blue + low) >> 16);
        }
        at += d.step, red += r.step, green += g.step, blue += b.step;
    }
}

/* The same with one colour. */
static void fill_row_flat(const filler *f, int32_t x, int32_t y, int32_t count)
{
    const gouraud_target *t = f->t;
    const float dx = (float)(16 * x + 8 - f->c[0].x) * 0.0625f, dy = (float)(16 * y + 8 - f->c[0].y) * 0.0625f;
    const ramp d = ramp_of(&f->depth, dx, dy, count);
    uint16_t *depth = t->depth16 + y * t->step + x, *pixel = t->pixel + y * t->pixel_step + x;
    int32_t at = d.at;
    for (int32_t i = 0; i < count; ++i, at += d.step) {
        const uint16_t own = depth_code(at);
        if (own > depth[i]) {
            const int32_t low = dither[y & 3][(x + i) & 3];
            depth[i] = own;
            pixel[i] = (uint16_t)((f->flat[0] + low) >> 16 << 11 | (f->flat[1] + low) >> 16 << 5 |
                                  (f->flat[2] + low) >> 16);
        }
    }
}

static void fill_row_ids(const filler *f, int32_t x, int32_t y, int32_t count)
{
    const gouraud_target *t = f->t;
    const float dx = (float)(16 * x + 8 - f->c[0].x) * 0.0625f, dy = (float)(16 * y + 8 - f->c[0].y) * 0.0625f;
    for (int32_t i = 0; i < count; ++i) {
        const int32_t at = y * t->step + x + i;
        const float d = plane_at(&f->depth, dx + (float)i, dy);
        if (d > t->depth[at]) {
            t->depth[at] = d;
            if (t->id_format == LMB_ID16) {
                ((uint16_t *)t->id)[at] = (uint16_t)f->id;
            } else {
                ((uint32_t *)t->id)[at] = f->id;
            }
        }
    }
}

/* Rows whose middles lie on both edges. */
static void fill_between(const filler *f, const edge *a, const edge *b, int32_t top, int32_t past)
{
    const gouraud_target *t = f->t;
    const int32_t first = maxi((top + 7) >> 4, 0), end = mini((past + 7) >> 4, t->height);
    for (int32_t y = first; y < end; ++y) {
        const int32_t u = edge_at(a, 16 * y + 8), v = edge_at(b, 16 * y + 8);
        int32_t left = mini(u, v), right = maxi(u, v);
        if (f->how == GOURAUD_GROWN) {
            left -= edge_growth(u < v ? a : b);
            right += edge_growth(u < v ? b : a);
        }
        const int32_t x = maxi(first_pixel(left), f->first), count = mini(first_pixel(right), f->past) - x;
        if (count <= 0) {
            continue;
        }
        if (t->pixel == NULL) {
            fill_row_ids(f, x, y, count);
        } else if (f->how == GOURAUD_FLAT) {
            fill_row_flat(f, x, y, count);
        } else {
            fill_row(f, x, y, count);
        }
    }
}

static void set_planes(filler *f, float per_area)
{
    const gouraud_corner *c = f->c;
    if (f->t->pixel == NULL) {
        f->depth = plane_of(c, c[0].d, c[1].d, c[2].d, per_area, 1.0f);
        return;
    }
    const float scale[3] = {31.0f * 65536.0f / 255.0f, 63.0f * 65536.0f / 255.0f, 31.0f * 65536.0f / 255.0f};
    const float max = 1073741760.0f; /* with a step more still 31 bits */
    f->depth = plane_of(c, c[0].d * max, c[1].d * max, c[2].d * max, per_area, max);
    for (int i = 0; i < 3; ++i) {
        const float first = c[0].colour[i] * scale[i], max_colour = 255.0f * scale[i];
        f->flat[i] = (int32_t)first;
        if (f->how != GOURAUD_FLAT) {
            f->colour[i] = plane_of(c, first, c[1].colour[i] * scale[i], c[2].colour[i] * scale[i], per_area, max_colour);
        }
    }
}

void lmb_gouraud_fill(const gouraud_target *t, const gouraud_corner c[3], uint32_t id, int how)
{
    const int32_t area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    const gouraud_corner *top = &c[0], *middle = &c[1], *bottom = &c[2], *swap;
    filler f;
    if (area == 0) {
        return;
    }
    if (middle->y < top->y) {
        swap = top, top = middle, middle = swap;
    }
    if (bottom->y < middle->y) {
        swap = middle, middle = bottom, bottom = swap;
    }
    if (middle->y < top->y) {
        swap = top, top = middle, middle = swap;
    }
    if ((bottom->y + 7) >> 4 <= (top->y + 7) >> 4 || bottom->y < 0 || top->y > 16 * t->height) {
        return;
    }
    f.t = t;
    f.c = c;
    f.id = id;
    f.how = how;
    f.first = maxi((mini(c[0].x, mini(c[1].x, c[2].x)) + 6) >> 4, 0);
    f.past = mini((maxi(c[0].x, maxi(c[1].x, c[2].x)) + 8) >> 4, t->width);
    set_planes(&f, 16.0f / (float)area);
    const edge whole = edge_of(top, bottom), upper = edge_of(top, middle), lower = edge_of(middle, bottom);
    fill_between(&f, &whole, &upper, top->y, middle->y);
    fill_between(&f, &whole, &lower, middle->y, bottom->y);
}

#endif
