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

static edge edge_of(const lmb_fixed_vertex *from, const lmb_fixed_vertex *to)
{
    const int32_t down = to->y - from->y;
    edge e = {from->x, from->y, 0};
    if (down > 0) {
        const int32_t free = zeros_above((uint32_t)down);
        const uint32_t per = reciprocal((uint32_t)down << free);
        /* the difference is of 15 bits, `free` of 18 to 31 */
        e.slope = signed_high_of((to->x - from->x) * 32768, (int32_t)per) >> (31 - free);
    }
    return e;
}

/* In 2^-14 px, in a row whose middle lies between the edge's ends. */
static int32_t edge_at(const edge *e, int32_t middle) { return e->x * 1024 + ((e->slope * (middle - e->y)) >> 4); }

/* The first pixel whose middle is not left of x. */
static int32_t first_pixel(int32_t x) { return (x + 8191) >> 14; }

/* A number that is linear on the triangle: at the first corner, and in 1/16 px from there. */
typedef struct plane {
    uint32_t at, per_x, per_y;
} plane;

/* A triangle's numbers that all planes need. */
typedef struct slant {
    int32_t x1, y1, x2, y2; /* from the first corner */
    int32_t area, per, free; /* twice the area, 1/256 px2; 2^62 / (area << free) */
    int32_t size;            /* bits of what the corners are apart at most, 1/16 px */
} slant;

enum {
    DEPTH_BITS = 14, DEPTH_STEEP = 12, /* bits below 1; 2^steep a 1/16 px is the most that is told apart */
    COLOUR_BITS = 16, COLOUR_STEEP = 4,
    /* A plane that changes by at most so much, 2^bits, along and down a triangle, and over so many px: what lies between
     * FIXED_LEAST and FIXED_MOST at the corners then stays within its bits in all pixels, as edges are off by 2^-13 of
     * the triangle's size, and a colour's step by 1/512 of a code. */
    DEPTH_GENTLE = 17, COLOUR_GENTLE = 10, GENTLE_ACROSS = 256
};

/* n / area in 2^-bits: what is shifted fits 31 bits, as n is at most 2^DEPTH_STEEP or 2^COLOUR_STEEP times the area, whose
 * `free` is at least 3. */
static uint32_t share(const slant *s, int32_t n, int32_t bits)
{
    const int32_t left = s->free + bits - 30;
    return (uint32_t)signed_high_of(left >= 0 ? n * (1 << left) : n >> -left, s->per);
}

static int is_gentle(const plane *p, uint32_t most_of)
{
    return p->per_x + most_of <= 2u * most_of && p->per_y + most_of <= 2u * most_of;
}

static uint32_t mean_of(int32_t f0, int32_t f1, int32_t f2) { return (uint32_t)(f0 + f1 + f2) * 21845u >> 16; }

/* A triangle so steep that all of the change is within 1/16 px has its corners' mean. 1 where it is gentle. Differences of
 * depths are below 65,504 and of places below 15,361, as the guard has it: both products together fit 31 bits. */
static int set_depth(plane *out, const slant *s, int32_t f0, int32_t f1, int32_t f2)
{
    const int32_t a = f1 - f0, b = f2 - f0, x = a * s->y2 - b * s->y1, y = b * s->x1 - a * s->x2;
    if ((x < 0 ? -x : x) >> DEPTH_STEEP > s->area || (y < 0 ? -y : y) >> DEPTH_STEEP > s->area) {
        out->at = mean_of(f0, f1, f2) << DEPTH_BITS;
        out->per_x = out->per_y = 0;
        return 1;
    }
    out->at = (uint32_t)f0 << DEPTH_BITS;
    out->per_x = share(s, x, DEPTH_BITS);
    out->per_y = share(s, y, DEPTH_BITS);
    return is_gentle(out, 1u << (DEPTH_GENTLE + DEPTH_BITS - 1 - s->size));
}

/* Likewise, half of a code more, to be rounded. */
static int set_colour(plane *out, const slant *s, int32_t f0, int32_t f1, int32_t f2)
{
    const int32_t a = f1 - f0, b = f2 - f0, x = a * s->y2 - b * s->y1, y = b * s->x1 - a * s->x2;
    if ((x < 0 ? -x : x) >> COLOUR_STEEP > s->area || (y < 0 ? -y : y) >> COLOUR_STEEP > s->area) {
        out->at = (mean_of(f0, f1, f2) << COLOUR_BITS) + 32768u;
        out->per_x = out->per_y = 0;
        return 1;
    }
    out->at = ((uint32_t)f0 << COLOUR_BITS) + 32768u;
    out->per_x = share(s, x, COLOUR_BITS);
    out->per_y = share(s, y, COLOUR_BITS);
    return is_gentle(out, 1u << (COLOUR_GENTLE + COLOUR_BITS - s->size));
}

/* A row's first pixel, and what each next one adds. Red lies over blue in one word, both in 1/256 of a code: no sum of
 * blue leaves its 16 bits. `dither`: what is added to a code of each of four pixels, from the first one on, in the place
 * of red, blue and green alike. */
typedef struct span {
    uint32_t depth, depth_step, red_blue, red_blue_step, green, green_step;
    const uint32_t *dither;
} span;

/* Bayer's 4 x 4 matrix of 0 .. 15, halved, over a row and on, so that four may begin at any of the first four. */
#define D(t) ((t) / 2u * 0x01000100u)
#define ROW(a, b, c, d) {D(a), D(b), D(c), D(d), D(a), D(b), D(c), D(d)}
static const uint32_t dithers[4][8] = {ROW(0, 8, 2, 10), ROW(12, 4, 14, 6), ROW(3, 11, 1, 9), ROW(15, 7, 13, 5)};

/* rb: red over blue, g: green, both with their dither. Nothing is dithered of 8 bits. */
#define PACK_888(rb, g, d)  (((rb) >> 8 & 0xff00ffu) | ((g) & 0xff00u))
#define PACK_555(rb, g, d)  (((rb) + (d)) >> 27 | (((g) + (d)) >> 6 & 0x3e0u) | (((rb) + (d)) >> 1 & 0x7c00u))
#define PACK_5551(rb, g, d) \
    ((((rb) + (d)) >> 16 & 0xf800u) | (((g) + (d)) >> 5 & 0x7c0u) | (((rb) + (d)) >> 10 & 0x3eu) | 1u)

#define DEEP_PIXEL(type, pack, which)                                            \
    if (depth >> DEPTH_BITS > *to_depth) {                                       \
        *to_depth = (uint16_t)(depth >> DEPTH_BITS);                             \
        *to = (type)(pack(red_blue, green, dither[which]));                      \
    }                                                                            \
    ++to_depth, ++to;                                                            \
    depth += depth_step, red_blue += red_blue_step, green += green_step;

#define HULL_PIXEL(type, pack, dither)              \
    *to++ = (type)(pack(red_blue, green, dither));  \
    red_blue += red_blue_step, green += green_step; \
    ONE_BY_ONE(red_blue, green);

/* A format's two loops: before what was drawn, and of the hull, which nothing lies behind. */
#define LOOPS(name, type, pack)                                                                                   \
    static void fill_deep_##name(void *pixels, uint16_t *to_depth, int32_t count, const span *s)                  \
    {                                                                                                             \
        type *to = (type *)pixels;                                                                                \
        const uint32_t *const dither = s->dither;                                                                 \
        uint32_t depth = s->depth, red_blue = s->red_blue, green = s->green, at = 0;                              \
        const uint32_t depth_step = s->depth_step, red_blue_step = s->red_blue_step, green_step = s->green_step;  \
        const uint16_t *const past = to_depth + count;                                                            \
        (void)dither;                                                                                             \
        if (count & 1) {                                                                                          \
            DEEP_PIXEL(type, pack, at)                                                                            \
            ++at;                                                                                                 \
        }                                                                                                         \
        for (; to_depth != past; at = (at + 2) & 3u) {                                                            \
            DEEP_PIXEL(type, pack, at)                                                                            \
            DEEP_PIXEL(type, pack, at + 1)                                                                        \
        }                                                                                                         \
    }                                                                                                             \
    static void fill_hull_##name(void *pixels, uint16_t *to_depth, int32_t count, const span *s)                  \
    {                                                                                                             \
        type *to = (type *)pixels;                                                                                \
        uint32_t red_blue = s->red_blue, green = s->green;                                                        \
        const uint32_t red_blue_step = s->red_blue_step, green_step = s->green_step, d0 = s->dither[0],           \
                       d1 = s->dither[1], d2 = s->dither[2], d3 = s->dither[3];                                   \
        const type *const past = to + count, *const fours = to + (count & ~3);                                    \
        (void)to_depth, (void)d0, (void)d1, (void)d2, (void)d3;                                                   \
        while (to != fours) {                                                                                     \
            HULL_PIXEL(type, pack, d0)                                                                            \
            HULL_PIXEL(type, pack, d1)                                                                            \
            HULL_PIXEL(type, pack, d2)                                                                            \
            HULL_PIXEL(type, pack, d3)                                                                            \
        }                                                                                                         \
        if (to != past) {                                                                                         \
            HULL_PIXEL(type, pack, d0)                                                                            \
        }                                                                                                         \
        if (to != past) {                                                                                         \
            HULL_PIXEL(type, pack, d1)                                                                            \
        }                                                                                                         \
        if (to != past) {                                                                                         \
            HULL_PIXEL(type, pack, d2)                                                                            \
        }                                                                                                         \
    }
LOOPS(888, uint32_t, PACK_888)
LOOPS(555, uint16_t, PACK_555)
LOOPS(5551, uint16_t, PACK_5551)

typedef void fill_loop(void *pixels, uint16_t *to_depth, int32_t count, const span *s);

static fill_loop *loop_of(const fixed_band *b)
{
    static fill_loop *const loops[3][2] = {{fill_hull_888, fill_deep_888}, {fill_hull_555, fill_deep_555},
                                           {fill_hull_5551, fill_deep_5551}};
    return loops[b->format][b->depth != NULL];
}

/* How far pixels are apart: a shift. */
static int32_t bytes_log2(const fixed_band *b) { return b->format == LMB_FIXED_RGB888 ? 2 : 1; }

void lmb_fixed_clear(const fixed_band *b, uint32_t colour)
{
    span s = {0, 0, (colour & 0xff00ffu) << 8, 0, colour & 0xff00u, 0, NULL};
    for (int32_t y = b->first; y < b->past; ++y) {
        s.dither = dithers[y & 3];
        loop_of(b)((unsigned char *)b->pixel + (b->width * (y - b->first) << bytes_log2(b)), NULL, b->width, &s);
    }
}

/* Numbers of the row at hand, in the middle of the picture's first column; to the next pixel and row. */
typedef struct filler {
    const fixed_band *b;
    uint32_t depth, red, green, blue, depth_x, red_x, green_x, blue_x, depth_y, red_y, green_y, blue_y;
    int32_t left, right; /* pixels across that it may cover */
    int is_gentle;
    fill_loop *loop;
} filler;

/* A number along a row. */
typedef struct ramp {
    uint32_t at;
    int32_t step;
} ramp;

/* Pixels' middles beside an edge may lie a little outside of the triangle: both ends within 0 .. max. */
static ramp ramp_within(uint32_t from, int32_t step, int32_t count, int32_t max)
{
    ramp r = {from, step};
    if (from <= (uint32_t)max && from + (uint32_t)step * (uint32_t)(count - 1) <= (uint32_t)max) {
        return r;
    }
    const int32_t end = within((int32_t)(from + (uint32_t)step * (uint32_t)(count - 1)), 0, max);
    r.at = (uint32_t)within((int32_t)from, 0, max);
    r.step = 0;
    if (count > 1) {
        const int32_t free = zeros_above((uint32_t)(count - 1)), way = end - (int32_t)r.at;
        const uint32_t size = (uint32_t)(way < 0 ? -way : way),
                       each = high_of(size, reciprocal((uint32_t)(count - 1) << free)) >> (30 - free);
        const uint32_t whole = each * (uint32_t)(count - 1) > size ? each - 1 : each;
        r.step = way < 0 ? -(int32_t)whole : (int32_t)whole;
    }
    return r;
}

/* In 1/256 of a code. */
static int32_t colour_step(uint32_t to_x) { return (int32_t)(to_x + 128u) >> 8; }

static ramp colour_ramp(uint32_t from, uint32_t to_x, int32_t x, int32_t count)
{
    return ramp_within((uint32_t)((int32_t)(from + to_x * (uint32_t)x) >> 8), colour_step(to_x), count, FIXED_TOP);
}

static void set_steep(span *s, const filler *f, int32_t x, int32_t count)
{
    const ramp r = colour_ramp(f->red, f->red_x, x, count), g = colour_ramp(f->green, f->green_x, x, count),
               b = colour_ramp(f->blue, f->blue_x, x, count),
               d = ramp_within(f->depth + f->depth_x * (uint32_t)x, (int32_t)f->depth_x, count, 0x3fffffff);
    s->depth = d.at, s->depth_step = (uint32_t)d.step;
    s->red_blue = (r.at << 16) + b.at, s->red_blue_step = ((uint32_t)r.step << 16) + (uint32_t)b.step;
    s->green = g.at, s->green_step = (uint32_t)g.step;
}

/* Rows first .. end - 1 between two edges, the left one first, which go on to the row `end`. */
static void fill_between(filler *f, lmb_fixed_edge *a, lmb_fixed_edge *b, int32_t first, int32_t end)
{
    span s = {0, f->depth_x, 0, ((uint32_t)colour_step(f->red_x) << 16) + (uint32_t)colour_step(f->blue_x),
              0, (uint32_t)colour_step(f->green_x), NULL};
    const int32_t width = f->b->width, log2 = bytes_log2(f->b), above = width * (first - f->b->first);
    int32_t u = a->at, v = b->at;
    unsigned char *to = (unsigned char *)f->b->pixel + (above << log2);
    uint16_t *to_depth = f->b->depth == NULL ? NULL : f->b->depth + above;
    for (int32_t y = first; y < end; ++y, u += a->slope, v += b->slope, to += width << log2) {
        const int32_t x = maxi(first_pixel(u), f->left);
        const int32_t count = mini(first_pixel(v), f->right) - x;
        if (count > 0) {
            const uint32_t at = (uint32_t)x;
            if (f->is_gentle) {
                s.depth = f->depth + f->depth_x * at;
                s.red_blue = ((f->red + f->red_x * at) << 8 & 0xffff0000u) + ((f->blue + f->blue_x * at) >> 8);
                s.green = (f->green + f->green_x * at) >> 8;
            } else {
                set_steep(&s, f, x, count);
            }
            s.dither = dithers[y & 3] + (x & 3);
            f->loop(to + (x << log2), to_depth == NULL ? NULL : to_depth + x, count, &s);
        }
        to_depth = to_depth == NULL ? NULL : to_depth + width;
        f->depth += f->depth_y, f->red += f->red_y, f->green += f->green_y, f->blue += f->blue_y;
    }
    a->at = u, b->at = v;
}

void lmb_fixed_fill(const fixed_band *b, const lmb_fixed_ready *r)
{
    const int32_t first = maxi(r->first, b->first), past = mini(r->past, b->past), middle = within(r->middle, first, past);
    if (first >= past) {
        return;
    }
    const uint32_t down = (uint32_t)(first - r->first);
    const uint32_t *y = r->per_y, *x = r->per_x;
    filler f = {b, r->at[0], r->at[1], r->at[2], r->at[3], x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3],
                r->left, r->right, r->is_gentle, loop_of(b)};
    lmb_fixed_edge whole = r->whole;
    if (down > 0) {
        f.depth += y[0] * down, f.red += y[1] * down, f.green += y[2] * down, f.blue += y[3] * down;
        whole.at += whole.slope * (int32_t)down;
    }
    if (first < middle) {
        lmb_fixed_edge upper = r->upper;
        upper.at += upper.slope * (int32_t)down;
        fill_between(&f, r->is_whole_left ? &whole : &upper, r->is_whole_left ? &upper : &whole, first, middle);
    }
    if (middle < past) {
        lmb_fixed_edge lower = r->lower;
        lower.at += lower.slope * (middle - r->middle);
        fill_between(&f, r->is_whole_left ? &whole : &lower, r->is_whole_left ? &lower : &whole, middle, past);
    }
}

/* In the middle of a row. */
static void set_edge(lmb_fixed_edge *out, const lmb_fixed_vertex *from, const lmb_fixed_vertex *to, int32_t row)
{
    const edge e = edge_of(from, to);
    out->at = edge_at(&e, 16 * row + 8);
    out->slope = e.slope;
}

static void set_number(lmb_fixed_ready *out, int i, const plane *p, const lmb_fixed_vertex *c)
{
    out->at[i] = p->at + p->per_x * (uint32_t)(8 - c->x) + p->per_y * (uint32_t)(16 * out->first + 8 - c->y);
    out->per_x[i] = p->per_x * 16u;
    out->per_y[i] = p->per_y * 16u;
}

int lmb_fixed_set_up(lmb_fixed_ready *out, const lmb_fixed_vertex *c0, const lmb_fixed_vertex *c1,
                     const lmb_fixed_vertex *c2, int32_t width, int32_t first, int32_t past, int has_depth)
{
    const lmb_fixed_vertex *top = c0, *middle = c1, *bottom = c2, *swap;
    plane p;
    slant s = {c1->x - c0->x, c1->y - c0->y, c2->x - c0->x, c2->y - c0->y, 0, 0, 0, 0};
    int32_t area = s.x1 * s.y2 - s.x2 * s.y1;
    if (middle->y < top->y) {
        swap = top, top = middle, middle = swap;
    }
    if (bottom->y < middle->y) {
        swap = middle, middle = bottom, bottom = swap;
    }
    if (middle->y < top->y) {
        swap = top, top = middle, middle = swap;
    }
    const int32_t y0 = maxi((top->y + 7) >> 4, first), y2 = mini((bottom->y + 7) >> 4, past),
                  y1 = within((middle->y + 7) >> 4, y0, y2);
    out->first = out->past = 0;
    if (area == 0 || y0 >= y2) {
        return 0;
    }
    out->first = (int16_t)y0, out->middle = (int16_t)y1, out->past = (int16_t)y2;
    if (area < 0) {
        area = -area;
        s.x1 = -s.x1, s.y1 = -s.y1, s.x2 = -s.x2, s.y2 = -s.y2;
    }
    const uint32_t apart = (uint32_t)(s.x1 < 0 ? -s.x1 : s.x1) | (uint32_t)(s.x2 < 0 ? -s.x2 : s.x2) |
                           (uint32_t)(s.y1 < 0 ? -s.y1 : s.y1) | (uint32_t)(s.y2 < 0 ? -s.y2 : s.y2);
    s.size = 32 - zeros_above(apart);
    s.area = area;
    s.free = zeros_above((uint32_t)area);
    s.per = (int32_t)reciprocal((uint32_t)area << s.free);
    out->left = (int16_t)maxi((mini(c0->x, mini(c1->x, c2->x)) + 7) >> 4, 0);
    out->right = (int16_t)mini((maxi(c0->x, maxi(c1->x, c2->x)) + 8) >> 4, width);
    int is_gentle = out->right - out->left <= GENTLE_ACROSS;
    if (has_depth) {
        is_gentle &= set_depth(&p, &s, c0->depth, c1->depth, c2->depth);
        set_number(out, 0, &p, c0);
    } else {
        out->at[0] = out->per_x[0] = out->per_y[0] = 0;
    }
    for (int i = 0; i < 3; ++i) {
        is_gentle &= set_colour(&p, &s, c0->colour[i], c1->colour[i], c2->colour[i]);
        set_number(out, 1 + i, &p, c0);
    }
    out->is_gentle = (uint8_t)is_gentle;
    out->is_whole_left =
        (middle->x - top->x) * (bottom->y - top->y) - (bottom->x - top->x) * (middle->y - top->y) > 0;
    set_edge(&out->whole, top, bottom, y0);
    if (y0 < y1) {
        set_edge(&out->upper, top, middle, y0);
    }
    if (y1 < y2) {
        set_edge(&out->lower, middle, bottom, y1);
    }
    return 1;
}
