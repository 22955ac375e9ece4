/* fixed_fill.c: fills a triangle's rows in a band: edges, depth and colour in integers. Layer 10.
 *
 * An edge's place in a row depends on its two ends alone, taken from top to bottom: neighbours share it, and a pixel whose
 * middle lies on it belongs to one of them. A number that is linear on the triangle is taken modulo 2^32: only where it
 * ends up must fit. So a row of any band has the same pixels. */
#include "fixed_part.h"
#include "number.h"

typedef struct edge {
    int32_t x, y, slope; /* 1/16 px; slope in 2^-14 */
} edge;

static edge edge_of(const fixed_corner *from, const fixed_corner *to)
{
    const int32_t down = to->y - from->y;
    edge e = {from->x, from->y, 0};
    if (down > 0) {
        const int32_t free = zeros_above((uint32_t)down);
        const uint32_t per = reciprocal((uint32_t)down << free);
        /* the difference is of 15 bits, `free` of 18 to 31 */
        e.slope = (int32_t)((((int64_t)(to->x - from->x) * 32768 * per) >> 32) >> (31 - free));
    }
    return e;
}

/* In 2^-14 px, in a row whose middle lies between the edge's ends. */
static int32_t edge_at(const edge *e, int32_t middle) { return e->x * 1024 + ((e->slope * (middle - e->y)) >> 4); }

/* The first pixel whose middle is not left of x. */
static int32_t first_pixel(int32_t x) { return (x + 8191) >> 14; }

/* At the first corner; per 1/16 px from there; per pixel, as rows go on. */
typedef struct plane {
    uint32_t at, per_x, per_y;
    int32_t step;
} plane;

/* A triangle's numbers that all planes need. */
typedef struct slant {
    int32_t x1, y1, x2, y2; /* from the first corner */
    int32_t area, per, free; /* twice the area, 1/256 px2; 2^62 / (area << free) */
} slant;

/* n / area in 2^-bits. n fits 31 bits after the shift: it is at most 2^steep times the area. */
static uint32_t share(const slant *s, int64_t n, int bits)
{
    const int32_t left = s->free + bits - 30;
    const int32_t shifted = left >= 0 ? (int32_t)n * (1 << left) : (int32_t)(n >> -left);
    return (uint32_t)signed_high_of(shifted, s->per);
}

static int is_steep(const slant *s, int64_t n, int steep) { return ((n < 0 ? -n : n) >> steep) > s->area; }

enum { DEPTH_BITS = 14, DEPTH_STEEP = 12, COLOUR_BITS = 16, COLOUR_STEEP = 4 };

static uint32_t mean_of(int32_t f0, int32_t f1, int32_t f2) { return (uint32_t)(f0 + f1 + f2) * 21845u >> 16; }

/* Depths f0, f1, f2 at the corners. A triangle so steep that all of the change is within 1/16 px has their mean. */
static void set_depth(plane *out, const slant *s, int32_t f0, int32_t f1, int32_t f2)
{
    const int32_t a = f1 - f0, b = f2 - f0;
    const int64_t x = (int64_t)a * s->y2 - (int64_t)b * s->y1, y = (int64_t)b * s->x1 - (int64_t)a * s->x2;
    if (is_steep(s, x, DEPTH_STEEP) || is_steep(s, y, DEPTH_STEEP)) {
        out->at = mean_of(f0, f1, f2) << DEPTH_BITS;
        out->per_x = out->per_y = 0;
    } else {
        out->at = (uint32_t)f0 << DEPTH_BITS;
        out->per_x = share(s, x, DEPTH_BITS);
        out->per_y = share(s, y, DEPTH_BITS);
    }
    out->step = (int32_t)(out->per_x * 16u);
}

/* Likewise of colours, whose products fit 32 bits; half of a code more. A step is in 1/256 of a code. */
static void set_colour(plane *out, const slant *s, int32_t f0, int32_t f1, int32_t f2)
{
    const int32_t a = f1 - f0, b = f2 - f0, x = a * s->y2 - b * s->y1, y = b * s->x1 - a * s->x2;
    if ((x < 0 ? -x : x) >> COLOUR_STEEP > s->area || (y < 0 ? -y : y) >> COLOUR_STEEP > s->area) {
        out->at = (mean_of(f0, f1, f2) << COLOUR_BITS) + 32768u;
        out->per_x = out->per_y = 0;
    } else {
        const int32_t left = s->free + COLOUR_BITS - 30;
        out->at = ((uint32_t)f0 << COLOUR_BITS) + 32768u;
        out->per_x = (uint32_t)signed_high_of(left >= 0 ? x * (1 << left) : x >> -left, s->per);
        out->per_y = (uint32_t)signed_high_of(left >= 0 ? y * (1 << left) : y >> -left, s->per);
    }
    out->step = (int32_t)(out->per_x * 16u + 128u) >> 8;
}

typedef struct filler {
    const fixed_band *b;
    const fixed_corner *c;
    plane depth, colour[3];
    int32_t first, past; /* pixels across that it may cover */
} filler;

/* A number along a row. */
typedef struct ramp {
    uint32_t at;
    int32_t step;
} ramp;

/* Pixels' middles beside an edge may lie a little outside of the triangle: both ends within 0 .. max. */
static ramp ramp_within(int32_t at, int32_t step, int32_t count, int32_t max)
{
    const int32_t end = within((int32_t)((uint32_t)at + (uint32_t)step * (uint32_t)(count - 1)), 0, max);
    ramp r = {(uint32_t)within(at, 0, max), 0};
    if (count > 1) {
        const int32_t free = zeros_above((uint32_t)(count - 1)), way = end - (int32_t)r.at;
        const uint32_t size = (uint32_t)(way < 0 ? -way : way),
                       each = high_of(size, reciprocal((uint32_t)(count - 1) << free)) >> (30 - free);
        const uint32_t whole = each * (uint32_t)(count - 1) > size ? each - 1 : each;
        r.step = way < 0 ? -(int32_t)whole : (int32_t)whole;
    }
    return r;
}

/* What a row's pixels begin with and add. Red lies over blue in one word: no sum of blue leaves its 16 bits. */
typedef struct span {
    uint32_t depth, depth_step, red_blue, red_blue_step, green, green_step;
} span;

#define FILL_PIXEL                                                       \
    if (depth >> DEPTH_BITS > *to_depth) {                               \
        *to_depth = (uint16_t)(depth >> DEPTH_BITS);                     \
        *to = (red_blue >> 8 & 0xff00ffu) | (green & 0xff00u);           \
    }                                                                    \
    ++to_depth, ++to;                                                    \
    depth += depth_step, red_blue += red_blue_step, green += green_step;

/* Two a turn; by itself, so that all of it is in registers. */
NOINLINE void fill_pixels(uint32_t *to, uint16_t *to_depth, int32_t count, const span *s)
{
    uint32_t depth = s->depth, red_blue = s->red_blue, green = s->green;
    const uint32_t depth_step = s->depth_step, red_blue_step = s->red_blue_step, green_step = s->green_step;
    const uint16_t *const past = to_depth + count;
    if (count & 1) {
        FILL_PIXEL
    }
    while (to_depth != past) {
        FILL_PIXEL
        FILL_PIXEL
    }
}

/* A plane from dx, dy on, in 1/16 px, for `count` pixels: within 0 .. max, after a shift. */
static inline ramp ramp_of(const plane *p, uint32_t dx, uint32_t dy, int32_t count, int shift, uint32_t max)
{
    ramp r = {(uint32_t)((int32_t)(p->at + p->per_x * dx + p->per_y * dy) >> shift), p->step};
    if (r.at > max || r.at + (uint32_t)r.step * (uint32_t)(count - 1) > max) {
        r = ramp_within((int32_t)r.at, r.step, count, (int32_t)max);
    }
    return r;
}

static void fill_row(const filler *f, int32_t x, int32_t y, int32_t count)
{
    const fixed_band *b = f->b;
    const uint32_t dx = (uint32_t)(16 * x + 8 - f->c->x), dy = (uint32_t)(16 * y + 8 - f->c->y);
    const ramp d = ramp_of(&f->depth, dx, dy, count, 0, 0x3fffffffu), red = ramp_of(&f->colour[0], dx, dy, count, 8, 0xffffu),
               green = ramp_of(&f->colour[1], dx, dy, count, 8, 0xffffu),
               blue = ramp_of(&f->colour[2], dx, dy, count, 8, 0xffffu);
    const span s = {d.at, (uint32_t)d.step, (red.at << 16) + blue.at, ((uint32_t)red.step << 16) + (uint32_t)blue.step,
                    green.at, (uint32_t)green.step};
    const int32_t at = b->width * (y - b->first) + x;
    fill_pixels(b->pixel + at, b->depth + at, count, &s);
}

/* Rows whose middles lie on both edges. */
static void fill_between(const filler *f, const edge *a, const edge *b, int32_t top, int32_t past)
{
    const int32_t first = most((top + 7) >> 4, f->b->first), end = least((past + 7) >> 4, f->b->past);
    if (first >= end) {
        return;
    }
    int32_t u = edge_at(a, 16 * first + 8), v = edge_at(b, 16 * first + 8);
    for (int32_t y = first; y < end; ++y, u += a->slope, v += b->slope) {
        const int32_t x = most(first_pixel(least(u, v)), f->first);
        const int32_t count = least(first_pixel(most(u, v)), f->past) - x;
        if (count > 0) {
            fill_row(f, x, y, count);
        }
    }
}

void lmb_fixed_fill(const fixed_band *b, const fixed_corner *c0, const fixed_corner *c1, const fixed_corner *c2)
{
    const fixed_corner *top = c0, *middle = c1, *bottom = c2, *swap;
    filler f;
    slant s = {c1->x - c0->x, c1->y - c0->y, c2->x - c0->x, c2->y - c0->y, 0, 0, 0};
    int32_t area = s.x1 * s.y2 - s.x2 * s.y1;
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
    if ((bottom->y + 7) >> 4 <= most((top->y + 7) >> 4, b->first) || (top->y + 7) >> 4 >= b->past) {
        return;
    }
    if (area < 0) {
        area = -area;
        s.x1 = -s.x1, s.y1 = -s.y1, s.x2 = -s.x2, s.y2 = -s.y2;
    }
    s.area = area;
    s.free = zeros_above((uint32_t)area);
    s.per = (int32_t)reciprocal((uint32_t)area << s.free);
    f.b = b;
    f.c = c0;
    f.first = most((least(c0->x, least(c1->x, c2->x)) + 7) >> 4, 0);
    f.past = least((most(c0->x, most(c1->x, c2->x)) + 8) >> 4, b->width);
    set_depth(&f.depth, &s, c0->depth, c1->depth, c2->depth);
    for (int i = 0; i < 3; ++i) {
        set_colour(&f.colour[i], &s, c0->colour[i], c1->colour[i], c2->colour[i]);
    }
    const edge whole = edge_of(top, bottom), upper = edge_of(top, middle), lower = edge_of(middle, bottom);
    fill_between(&f, &whole, &upper, top->y, middle->y);
    fill_between(&f, &whole, &lower, middle->y, bottom->y);
}
