/* gouraud_fill.c: clips, and fills row by row: edges and colours in integers. Layer 8.
 *
 * Corners lie within GOURAUD_GUARD times the target, of LMB_GOURAUD_MAX_SIDE px. Differences are at most 16,384 in 1/16
 * px, so an area, and 2^14 times a difference, fit 32 bits. The position of an edge in a row depends only on the two
 * ends, taken from top to bottom. So neighbours share it, and a pixel with its centre on the edge belongs to one of
 * them. */
#include "gouraud_fill.h"

#include <string.h>

#include "../base/vec.h"

#if LMB_TRANSFER

enum { MAX_CLIPPED_CORNERS = 8 }; /* of a triangle cut by five planes */

/* --- before the division ------------------------------------------------------------------------------------------ */

static void set_gouraud_row(float row[4], lmb_vec3 axis, const lmb_mat4 *t, lmb_vec3 eye)
{
    const float *m = t->m;
    for (int c = 0; c < 3; ++c) {
        row[c] = dot3(axis, vec3(m[4 * c], m[4 * c + 1], m[4 * c + 2]));
    }
    row[3] = dot3(axis, sub3(vec3(m[12], m[13], m[14]), eye));
}

void lmb_gouraud_view_of(gouraud_view *out, const lmb_view *v, const lmb_mat4 *to_world)
{
    set_gouraud_row(out->row[0], mul3(v->right, 1.0f / v->half_width), to_world, v->eye);
    set_gouraud_row(out->row[1], mul3(v->up, 1.0f / v->half_height), to_world, v->eye);
    set_gouraud_row(out->row[2], mul3(v->back, -1.0f), to_world, v->eye);
    out->near_m = v->near_m;
    out->far_m = v->far_m;
    out->is_far = v->kind == LMB_ORTHOGRAPHIC;
    out->depth_scale = out->is_far ? 1.0f / (v->far_m - v->near_m) : 0.0f;
}

void lmb_gouraud_scale(float rows[3][4], lmb_vec3 scale, lmb_vec3 offset)
{
    for (int i = 0; i < 3; ++i) {
        float *row = rows[i];
        row[3] = gouraud_along(row, offset);
        row[0] *= scale.x, row[1] *= scale.y, row[2] *= scale.z;
    }
}

/* Points beyond 1,000 km, and non-numbers, are outside all planes. */
uint32_t lmb_gouraud_outside(const gouraud_point *p)
{
    const float guard = (float)GOURAUD_GUARD * p->w;
    if (!(absf(p->x) < 1e9f && absf(p->y) < 1e9f && absf(p->w) < 1e6f)) {
        return GOURAUD_OUTSIDE;
    }
    return (uint32_t)(p->w < p->z) | (uint32_t)(guard + p->x < 0.0f) << 1 | (uint32_t)(guard - p->x < 0.0f) << 2 |
           (uint32_t)(guard - p->y < 0.0f) << 3 | (uint32_t)(guard + p->y < 0.0f) << 4;
}

void lmb_gouraud_size(gouraud_target *t, int32_t width, int32_t height)
{
    t->width = width;
    t->height = height;
    t->half[0] = 8.0f * (float)width;
    t->half[1] = 8.0f * (float)height;
    t->middle[0] = t->half[0] + 0.5f + (float)GOURAUD_BIAS;
    t->middle[1] = t->half[1] + 0.5f + (float)GOURAUD_BIAS;
}

/* Distance of a point inside a plane. */
static float height_inside(const gouraud_point *p, int plane)
{
    const float guard = (float)GOURAUD_GUARD * p->w;
    switch (plane) {
    case 0:
        return p->w - p->z;
    case 1:
        return guard + p->x;
    case 2:
        return guard - p->x;
    case 3:
        return guard - p->y;
    default:
        return guard + p->y;
    }
}

/* Intersection of the segment from a, inside, to b, outside, with the plane. */
static gouraud_point cut_gouraud_edge(const gouraud_point *a, const gouraud_point *b, float in, float out)
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

/* Always cuts from the inside to the outside, so that neighbours cut a shared edge at one place. */
static int cut_by_gouraud_plane(gouraud_point *out, const gouraud_point *p, int count, int plane)
{
    int n = 0;
    for (int i = 0; i < count; ++i) {
        const gouraud_point *a = &p[i], *b = &p[i + 1 < count ? i + 1 : 0];
        const float at = height_inside(a, plane), bt = height_inside(b, plane);
        if (at >= 0.0f) {
            out[n++] = *a;
        }
        if ((at >= 0.0f) != (bt >= 0.0f)) {
            out[n++] = at >= 0.0f ? cut_gouraud_edge(a, b, at, bt) : cut_gouraud_edge(b, a, bt, at);
        }
    }
    return n;
}

gouraud_corner lmb_gouraud_place(const gouraud_target *t, const gouraud_point *p)
{
    gouraud_corner c;
    gouraud_point_of(&c.x, &c.y, &c.d, t, p);
    c.colour[0] = p->colour[0], c.colour[1] = p->colour[1], c.colour[2] = p->colour[2];
    return c;
}

/* If x or y was huge compared with w, a cut corner lies on the guard band only within binary32 precision. */
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
    gouraud_point a[MAX_CLIPPED_CORNERS + 1] = {p[0], p[1], p[2]}, b[MAX_CLIPPED_CORNERS + 1];
    int count = 3;
    for (int plane = 0; plane < 5 && count >= 3; ++plane) {
        if ((any >> plane & 1u) == 0) {
            continue;
        }
        count = cut_by_gouraud_plane(b, a, count, plane);
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
typedef struct gouraud_edge {
    int32_t x, y, past, slope;
} gouraud_edge;

static gouraud_edge gouraud_edge_of(const gouraud_corner *from, const gouraud_corner *to)
{
    gouraud_edge e;
    const int32_t down = to->y - from->y;
    e.x = from->x;
    e.y = from->y;
    e.past = to->y;
    e.slope = down > 0 ? (to->x - from->x) * 16384 / down : 0;
    return e;
}

/* x in 2^-14 px, for a row with the centre between the edge's ends. */
static int32_t gouraud_edge_at(const gouraud_edge *e, int32_t middle)
{
    return e->x * 1024 + ((e->slope * (middle - e->y)) >> 4);
}

/* Shift across of an edge that moves outwards by a sixteenth of a pixel, down or across. */
static int32_t edge_growth(const gouraud_edge *e) { return ((e->slope < 0 ? -e->slope : e->slope) >> 4) + 1024; }

/* The first pixel with a centre not left of x. */
static int32_t first_gouraud_pixel(int32_t x) { return (x + 8191) >> 14; }

/* A linear value on the triangle, in 0 .. max. Integers if it is gentle. */
typedef struct gouraud_plane {
    float at, per_x, per_y, max;   /* at the first corner; per px */
    int32_t first, step_x, step_y; /* at the centre of the target's first pixel; step to the next pixel, and to the next
                                      row */
    int is_gentle;
} gouraud_plane;

/* Per px: up to this, values fit 31 bits at any distance between a pixel and a corner. */
#define MAX_GENTLE_STEP 262144.0f

/* All but the integers. */
static void set_plane(gouraud_plane *out, const gouraud_corner c[3], float f0, float f1, float f2, float per_area,
                      float max)
{
    const float a = f1 - f0, b = f2 - f0;
    out->at = f0;
    out->per_x = (a * (float)(c[2].y - c[0].y) - b * (float)(c[1].y - c[0].y)) * per_area;
    out->per_y = (b * (float)(c[1].x - c[0].x) - a * (float)(c[2].x - c[0].x)) * per_area;
    out->max = max;
}

/* Adds the integers if they suffice. */
static void set_whole_plane(gouraud_plane *out, const gouraud_corner c[3], float f0, float f1, float f2, float per_area,
                            float max)
{
    set_plane(out, c, f0, f1, f2, per_area, max);
    out->is_gentle = absf(out->per_x) < MAX_GENTLE_STEP && absf(out->per_y) < MAX_GENTLE_STEP;
    if (out->is_gentle) {
        out->step_x = (int32_t)out->per_x;
        out->step_y = (int32_t)out->per_y;
        out->first = (int32_t)(f0 + (out->per_x * (float)(8 - c[0].x) + out->per_y * (float)(8 - c[0].y)) * 0.0625f);
    }
}

/* x and y: px from the first corner. */
static float plane_at(const gouraud_plane *p, float x, float y)
{
    return clampf(p->at + p->per_y * y + p->per_x * x, 0.0f, p->max);
}

/* A value along a row: at the first pixel, and per pixel, with both ends in the plane's range. */
typedef struct gouraud_ramp {
    int32_t at, step;
} gouraud_ramp;

static gouraud_ramp ramp_between(const gouraud_plane *p, const gouraud_corner *c, int32_t x, int32_t y, int32_t count)
{
    const float dx = (float)(16 * x + 8 - c->x) * 0.0625f, dy = (float)(16 * y + 8 - c->y) * 0.0625f;
    gouraud_ramp r;
    r.at = (int32_t)plane_at(p, dx, dy);
    r.step = count > 1 ? ((int32_t)plane_at(p, dx + (float)(count - 1), dy) - r.at) / (count - 1) : 0;
    return r;
}

/* Pixel centres beside an edge may lie slightly outside the triangle. */
static inline gouraud_ramp ramp_of(const gouraud_plane *p, const gouraud_corner *c, int32_t x, int32_t y, int32_t count)
{
    const uint32_t max = (uint32_t)(int32_t)p->max;
    gouraud_ramp r;
    r.at = p->first + p->step_y * y + p->step_x * x;
    r.step = p->step_x;
    if (!p->is_gentle || (uint32_t)r.at > max || (uint32_t)(r.at + r.step * (count - 1)) > max) {
        r = ramp_between(p, c, x, y, count);
    }
    return r;
}

/* Colours: 5, 6 and 5 bits, with 11 fraction bits. Red lies above blue in one word, because sums of blue stay within 16
 * bits. */
enum { COLOUR_FRACTION_BITS = 11 };

static uint32_t red_and_blue(int32_t red, int32_t blue) { return ((uint32_t)red << 16) + (uint32_t)blue; }

static uint16_t pixel_of_channels(uint32_t red_blue, uint32_t green)
{
    return (uint16_t)((red_blue >> 16 & 0xf800u) | (green & 0x1f800u) >> (COLOUR_FRACTION_BITS - 5) |
                      (red_blue & 0xffffu) >> COLOUR_FRACTION_BITS);
}

/* Bayer's 4 x 4 matrix (1973) in sixteenths, less half of one: for red and for blue. */
#define IN_BOTH_HALVES(a) ((uint32_t)(a) << 16 | (uint32_t)(a))
static const uint32_t dither_table[4][4] = {
    {IN_BOTH_HALVES(64), IN_BOTH_HALVES(1088), IN_BOTH_HALVES(320), IN_BOTH_HALVES(1344)},
    {IN_BOTH_HALVES(1600), IN_BOTH_HALVES(576), IN_BOTH_HALVES(1856), IN_BOTH_HALVES(832)},
    {IN_BOTH_HALVES(448), IN_BOTH_HALVES(1472), IN_BOTH_HALVES(192), IN_BOTH_HALVES(1216)},
    {IN_BOTH_HALVES(1984), IN_BOTH_HALVES(960), IN_BOTH_HALVES(1728), IN_BOTH_HALVES(704)}};

/* A 16-bit depth: the four lowest bits of the exponent and twelve of the fraction, so that relative precision is the
 * same near and far. */
#define LEAST_DEPTH 1.5262604e-5f /* 2^-16 plus a step: code 1 */
#define MOST_DEPTH  0.9998779f    /* 1 minus a step: code 65535 */

static uint16_t depth_code(float depth)
{
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    return (uint16_t)((bits - ((127u - 16u) << 23)) >> 11);
}

typedef struct depth_ramp {
    float at, step;
} depth_ramp;

static inline depth_ramp depths_of(const gouraud_plane *p, const gouraud_corner *c, int32_t x, int32_t y, int32_t count)
{
    const float dx = (float)(16 * x + 8 - c->x) * 0.0625f, dy = (float)(16 * y + 8 - c->y) * 0.0625f;
    const float more = (float)(count - 1), at = p->at + p->per_y * dy + p->per_x * dx, end = at + p->per_x * more;
    depth_ramp d = {at, p->per_x};
    if (!(at >= LEAST_DEPTH && at <= MOST_DEPTH && end >= LEAST_DEPTH && end <= MOST_DEPTH)) {
        d.at = clampf(at, LEAST_DEPTH, MOST_DEPTH);
        d.step = count > 1 ? (clampf(end, LEAST_DEPTH, MOST_DEPTH) - d.at) / more : 0.0f;
    }
    return d;
}

typedef struct filler {
    const gouraud_target *t;
    const gouraud_corner *c;
    gouraud_plane depth, colour[3];
    uint32_t id;
    int how;
    uint32_t red_blue, green; /* the colour for GOURAUD_FLAT */
    int32_t first, past;      /* range of pixels across */
} filler;

static void fill_row(const filler *f, int32_t x, int32_t y, int32_t count)
{
    const gouraud_target *t = f->t;
    const depth_ramp d = depths_of(&f->depth, f->c, x, y, count);
    const gouraud_ramp r = ramp_of(&f->colour[0], f->c, x, y, count), g = ramp_of(&f->colour[1], f->c, x, y, count),
                       b = ramp_of(&f->colour[2], f->c, x, y, count);
    uint16_t *depth = t->depth16 + y * t->step + x, *pixel = t->pixel + y * t->pixel_step + x, *past = pixel + count;
    const uint32_t *threshold = dither_table[y & 3], red_blue_step = red_and_blue(r.step, b.step);
    uint32_t red_blue = red_and_blue(r.at, b.at);
    int32_t green = g.at;
    float at = d.at;
    for (; pixel != past; ++pixel, ++depth, ++x) {
        const uint16_t own = depth_code(at);
        if (own > *depth) {
            const uint32_t low = threshold[x & 3];
            *depth = own;
            *pixel = pixel_of_channels(red_blue + low, (uint32_t)green + (low & 0xffffu));
        }
        at += d.step, red_blue += red_blue_step, green += g.step;
    }
}

/* The same with one colour. */
static void fill_row_flat(const filler *f, int32_t x, int32_t y, int32_t count)
{
    const gouraud_target *t = f->t;
    const depth_ramp d = depths_of(&f->depth, f->c, x, y, count);
    uint16_t *depth = t->depth16 + y * t->step + x, *pixel = t->pixel + y * t->pixel_step + x, *past = pixel + count;
    float at = d.at;
    for (; pixel != past; ++pixel, ++depth, ++x, at += d.step) {
        const uint16_t own = depth_code(at);
        if (own > *depth) {
            const uint32_t low = dither_table[y & 3][x & 3];
            *depth = own;
            *pixel = pixel_of_channels(f->red_blue + low, f->green + (low & 0xffffu));
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

/* Fills the rows with their centres on both edges. */
static void fill_between(const filler *f, const gouraud_edge *a, const gouraud_edge *b, int32_t top, int32_t past)
{
    const gouraud_target *t = f->t;
    const int32_t first = maxi((top + 7) >> 4, 0), end = mini((past + 7) >> 4, t->height);
    for (int32_t y = first; y < end; ++y) {
        const int32_t u = gouraud_edge_at(a, 16 * y + 8), v = gouraud_edge_at(b, 16 * y + 8);
        int32_t left = mini(u, v), right = maxi(u, v);
        if (f->how == GOURAUD_GROWN) {
            left -= edge_growth(u < v ? a : b);
            right += edge_growth(u < v ? b : a);
        }
        const int32_t x = maxi(first_gouraud_pixel(left), f->first),
                      count = mini(first_gouraud_pixel(right), f->past) - x;
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

static void set_colour_planes(filler *f, float per_area)
{
    const gouraud_corner *c = f->c;
    set_plane(&f->depth, c, c[0].d, c[1].d, c[2].d, per_area, 1.0f);
    if (f->t->pixel == NULL) {
        return;
    }
    const float full[3] = {31.0f * 2048.0f, 63.0f * 2048.0f, 31.0f * 2048.0f};
    if (f->how == GOURAUD_FLAT) {
        const float *code = c[0].colour;
        f->red_blue = red_and_blue((int32_t)(code[0] * (full[0] / 255.0f)), (int32_t)(code[2] * (full[2] / 255.0f)));
        f->green = (uint32_t)(int32_t)(code[1] * (full[1] / 255.0f));
        return;
    }
    for (int i = 0; i < 3; ++i) {
        const float per = full[i] / 255.0f;
        set_whole_plane(&f->colour[i], c, c[0].colour[i] * per, c[1].colour[i] * per, c[2].colour[i] * per, per_area,
                        full[i]);
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
    set_colour_planes(&f, 16.0f / (float)area);
    const gouraud_edge whole = gouraud_edge_of(top, bottom), upper = gouraud_edge_of(top, middle),
                       lower = gouraud_edge_of(middle, bottom);
    fill_between(&f, &whole, &upper, top->y, middle->y);
    fill_between(&f, &whole, &lower, middle->y, bottom->y);
}

#endif
