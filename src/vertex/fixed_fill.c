/* fixed_fill.c: fills a triangle's rows in a band: edges, depth and colour in integers. Layer 8.
 *
 * The position of an edge in a row depends only on the two ends, taken from top to bottom. So neighbours share it, and
 * a pixel with its centre on the edge belongs to one of them. Linear values are computed modulo 2^32: only the result
 * must fit. So a row has the same pixels in any band. */
#include <string.h>

#include "fixed_part.h"
#include "number.h"

typedef struct fixed_edge {
    int32_t x, y, slope; /* 1/16 px; slope in 2^-14 */
} fixed_edge;

static fixed_edge fixed_edge_of(const lmb_fixed_vertex *from, const lmb_fixed_vertex *to)
{
    const int32_t down = to->y - from->y;
    fixed_edge e = {from->x, from->y, 0};
    if (down > 0) {
        const int32_t free = zeros_above((uint32_t)down);
        const uint32_t per = reciprocal((uint32_t)down << free);
        /* the difference has 15 bits, `free` is 18 to 31 */
        e.slope = signed_high_of((to->x - from->x) * 32768, (int32_t)per) >> (31 - free);
    }
    return e;
}

/* x in 2^-14 px, for a row with the centre between the edge's ends. */
static int32_t fixed_edge_at(const fixed_edge *e, int32_t middle)
{
    return e->x * 1024 + ((e->slope * (middle - e->y)) >> 4);
}

/* The first pixel with a centre not left of x. */
static int32_t first_fixed_pixel(int32_t x) { return (x + 8191) >> 14; }

/* A linear value on the triangle: at the first corner, and per 1/16 px. */
typedef struct fixed_plane {
    uint32_t at, per_x, per_y;
} fixed_plane;

/* Values of a triangle that all planes need. */
typedef struct slant {
    int32_t x1, y1, x2, y2; /* from the first corner */
    int32_t area, per, free; /* twice the area, 1/256 px2; 2^62 / (area << free) */
    int32_t size;            /* bits of the largest distance between corners, 1/16 px */
} slant;

enum {
    DEPTH_BITS = 14, DEPTH_STEEP = 12, /* fraction bits; a change over 2^STEEP per 1/16 px is too steep */
    COLOUR_BITS = 16, COLOUR_STEEP = 4,
    /* A gentle plane changes by at most 2^GENTLE along and down a triangle at most GENTLE_ACROSS px wide. If the
     * corners lie between FIXED_LEAST and FIXED_MOST, the value then stays within range in all pixels, because edges
     * are off by at most 2^-13 of the triangle's size, and colour steps by 1/512 of a code. */
    DEPTH_GENTLE = 17, COLOUR_GENTLE = 10, GENTLE_ACROSS = 256
};

/* n / area in 2^-bits. The shifted value fits 31 bits, because n is at most 2^DEPTH_STEEP or 2^COLOUR_STEEP times the
 * area, and `free` of the area is at least 3. */
static uint32_t share(const slant *s, int32_t n, int32_t bits)
{
    const int32_t left = s->free + bits - 30;
    return (uint32_t)signed_high_of(left >= 0 ? n * (1 << left) : n >> -left, s->per);
}

static int is_gentle(const fixed_plane *p, uint32_t most_of)
{
    return p->per_x + most_of <= 2u * most_of && p->per_y + most_of <= 2u * most_of;
}

static uint32_t mean_of_thirds(int32_t f0, int32_t f1, int32_t f2) { return (uint32_t)(f0 + f1 + f2) * 21845u >> 16; }

/* Returns 1 if the plane is gentle. A triangle so steep that the whole change is within 1/16 px gets the mean of the
 * corners. Depth differences are below 65,504, and coordinates below 15,361 because of the guard band: the two products
 * together fit 31 bits. */
static int set_fixed_depth(fixed_plane *out, const slant *s, int32_t f0, int32_t f1, int32_t f2)
{
    const int32_t a = f1 - f0, b = f2 - f0, x = a * s->y2 - b * s->y1, y = b * s->x1 - a * s->x2;
    if ((x < 0 ? -x : x) >> DEPTH_STEEP > s->area || (y < 0 ? -y : y) >> DEPTH_STEEP > s->area) {
        out->at = mean_of_thirds(f0, f1, f2) << DEPTH_BITS;
        out->per_x = out->per_y = 0;
        return 1;
    }
    out->at = (uint32_t)f0 << DEPTH_BITS;
    out->per_x = share(s, x, DEPTH_BITS);
    out->per_y = share(s, y, DEPTH_BITS);
    return is_gentle(out, 1u << (DEPTH_GENTLE + DEPTH_BITS - 1 - s->size));
}

/* The same, plus half a code for rounding. */
static int set_colour(fixed_plane *out, const slant *s, int32_t f0, int32_t f1, int32_t f2)
{
    const int32_t a = f1 - f0, b = f2 - f0, x = a * s->y2 - b * s->y1, y = b * s->x1 - a * s->x2;
    if ((x < 0 ? -x : x) >> COLOUR_STEEP > s->area || (y < 0 ? -y : y) >> COLOUR_STEEP > s->area) {
        out->at = (mean_of_thirds(f0, f1, f2) << COLOUR_BITS) + 32768u;
        out->per_x = out->per_y = 0;
        return 1;
    }
    out->at = ((uint32_t)f0 << COLOUR_BITS) + 32768u;
    out->per_x = share(s, x, COLOUR_BITS);
    out->per_y = share(s, y, COLOUR_BITS);
    return is_gentle(out, 1u << (COLOUR_GENTLE + COLOUR_BITS - s->size));
}

/* The first pixel of a row, and the step to the next: depth; colours in 1/256 of a code, 16 bits each. `dither`: added
 * to the colours of each pixel from the first one on. */
typedef struct row_span {
    uint32_t depth, depth_step, red, green, blue, red_step, green_step, blue_step;
    const uint16_t *dither;
} row_span;

/* Bayer's 4 x 4 matrix of 0 .. 15, halved. Each row is repeated, so that a span may begin at any of the first four. */
#define D(t) ((t) / 2u * 256u)
#define ROW(a, b, c, d) {D(a), D(b), D(c), D(d), D(a), D(b), D(c), D(d)}
static const uint16_t dithers[4][8] = {ROW(0, 8, 2, 10), ROW(12, 4, 14, 6), ROW(3, 11, 1, 9), ROW(15, 7, 13, 5)};

/* Dithered colours -> a 16-bit pixel; or several at once, each in 16 bits of a word of `type`. */
#define IN_EACH_HALF(type, v)         ((type)-1 / 0xffffu * (v))
#define PACK_555(high, one, r, g, b) (((((r) & (high)) >> 5 | ((g) & (high))) >> 5 | ((b) & (high))) >> 1)
#define PACK_5551(high, one, r, g, b) (((r) & (high)) | (((g) & (high)) | ((b) & (high)) >> 5) >> 5 | (one))

#define HULL_PIXEL(pack)                                                   \
    {                                                                      \
        const uint32_t d = *dither++;                                      \
        *to++ = (uint16_t)pack(0xf800u, 1u, red + d, green + d, blue + d); \
        red += s->red_step, green += s->green_step, blue += s->blue_step;  \
    }

/* Two pixels share a word, so that sums and masks of a colour are computed for both at once. */
#if defined(__GNUC__)
typedef uint32_t __attribute__((may_alias)) two_pixels;

/* Stores two pixels on a 4-byte boundary, the first one low. Two such words, because a row's dither has four values. */
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define IN_MEMORY(two) ((two) << 16 | (two) >> 16)
#else
#define IN_MEMORY(two) (two)
#endif
#define STORE_TWO(place, pack, which) \
    { \
        const uint32_t two = pack(high, IN_EACH_HALF(uint32_t, 1u), reds_##which, greens_##which, blues_##which); \
        *(two_pixels *)(void *)(to + (place)) = IN_MEMORY(two); \
    }
#define HULL_LOOP(pack) \
    if (((uintptr_t)to & 2u) != 0) { \
        HULL_PIXEL(pack) \
    } \
    uint32_t high = IN_EACH_HALF(uint32_t, 0xf800u); \
    KEEP(high); \
    const uint32_t dither_0 = dither[0] | (uint32_t)dither[1] << 16, \
                   dither_1 = (dither[2] | (uint32_t)dither[3] << 16) - dither_0; \
    uint32_t reds_0 = IN_EACH_HALF(uint32_t, red) + (s->red_step << 16) + dither_0, \
             greens_0 = IN_EACH_HALF(uint32_t, green) + (s->green_step << 16) + dither_0, \
             blues_0 = IN_EACH_HALF(uint32_t, blue) + (s->blue_step << 16) + dither_0, \
             reds_1 = reds_0 + IN_EACH_HALF(uint32_t, 2u * s->red_step) + dither_1, \
             greens_1 = greens_0 + IN_EACH_HALF(uint32_t, 2u * s->green_step) + dither_1, \
             blues_1 = blues_0 + IN_EACH_HALF(uint32_t, 2u * s->blue_step) + dither_1; \
    const uint32_t red_by = IN_EACH_HALF(uint32_t, 4u * s->red_step), \
                   green_by = IN_EACH_HALF(uint32_t, 4u * s->green_step), \
                   blue_by = IN_EACH_HALF(uint32_t, 4u * s->blue_step); \
    for (const uint16_t *const fours = to + ((past - to) & ~3); to != fours; to += 4) { \
        KEEP(reds_0); \
        KEEP(greens_0); \
        KEEP(blues_0); \
        KEEP(reds_1); \
        KEEP(greens_1); \
        KEEP(blues_1); \
        STORE_TWO(0, pack, 0) \
        STORE_TWO(2, pack, 1) \
        reds_0 += red_by, greens_0 += green_by, blues_0 += blue_by; \
        reds_1 += red_by, greens_1 += green_by, blues_1 += blue_by; \
    } \
    if (past - to >= 2) { \
        STORE_TWO(0, pack, 0) \
        to += 2; \
        reds_0 = reds_1, greens_0 = greens_1, blues_0 = blues_1; \
    } \
    if (to != past) { \
        *to = (uint16_t)pack(high, 1u, reds_0, greens_0, blues_0); \
    }

#else

#define HULL_LOOP(pack)  \
    while (to != past) { \
        HULL_PIXEL(pack) \
    }
#endif

#define DEEP_PIXEL(which, colour)                  \
    if (depth_##which > to_depth[which]) {         \
        to_depth[which] = (uint16_t)depth_##which; \
        to[which] = (uint16_t)(colour);            \
    }

/* The two loops of a format: with a depth test, two by two; and for the hull, which is behind all else. */
#define LOOPS(name, pack) \
    static void fill_deep_##name(void *pixels, uint16_t *to_depth, int32_t count, const row_span *s) \
    { \
        uint16_t *to = (uint16_t *)pixels, *const past = to + count; \
        const uint16_t *dither = s->dither; \
        uint32_t depth = s->depth, red = s->red, green = s->green, blue = s->blue; \
        if (count & 1) { \
            const uint32_t depth_0 = depth >> DEPTH_BITS, d = *dither++; \
            DEEP_PIXEL(0, pack(0xf800u, 1u, red + d, green + d, blue + d)) \
            depth += s->depth_step, red += s->red_step, green += s->green_step, blue += s->blue_step; \
            ++to, ++to_depth; \
        } \
        const uint32_t depth_step = s->depth_step, red_by = IN_EACH_HALF(uint32_t, 2u * s->red_step), \
                       green_by = IN_EACH_HALF(uint32_t, 2u * s->green_step), \
                       blue_by = IN_EACH_HALF(uint32_t, 2u * s->blue_step); \
        uint32_t high = IN_EACH_HALF(uint32_t, 0xf800u); \
        KEEP(high); \
        uint32_t d = dither[0] | (uint32_t)dither[1] << 16; \
        const uint32_t other = d ^ (dither[2] | (uint32_t)dither[3] << 16); \
        red = IN_EACH_HALF(uint32_t, red) + (s->red_step << 16), \
        green = IN_EACH_HALF(uint32_t, green) + (s->green_step << 16); \
        blue = IN_EACH_HALF(uint32_t, blue) + (s->blue_step << 16); \
        for (; to != past; to += 2, to_depth += 2, d ^= other) { \
            const uint32_t depth_0 = depth >> DEPTH_BITS, depth_1 = (depth + depth_step) >> DEPTH_BITS; \
            depth += 2 * depth_step; \
            if (depth_0 > to_depth[0] || depth_1 > to_depth[1]) { \
                const uint32_t two = pack(high, IN_EACH_HALF(uint32_t, 1u), red + d, green + d, blue + d); \
                DEEP_PIXEL(0, two) \
                DEEP_PIXEL(1, two >> 16) \
            } \
            red += red_by, green += green_by, blue += blue_by; \
        } \
    } \
    static void fill_hull_##name(void *pixels, uint16_t *to_depth, int32_t count, const row_span *s) \
    { \
        uint16_t *to = (uint16_t *)pixels, *const past = to + count; \
        const uint16_t *dither = s->dither; \
        uint32_t red = s->red, green = s->green, blue = s->blue; \
        (void)to_depth; \
        HULL_LOOP(pack) \
    }
LOOPS(555, PACK_555)
LOOPS(5551, PACK_5551)

/* 8-bit colours: red lies above blue in one word, because sums of blue stay within 16 bits. */
static void fill_hull_888(void *pixels, uint16_t *to_depth, int32_t count, const row_span *s)
{
    uint32_t *to = (uint32_t *)pixels, red_blue = (s->red << 16) + s->blue, green = s->green;
    const uint32_t red_blue_step = (s->red_step << 16) + s->blue_step, green_step = s->green_step;
    const uint32_t *const past = to + count;
    (void)to_depth;
    for (; to != past; ++to) {
        *to = (red_blue >> 8 & 0xff00ffu) | (green & 0xff00u);
        red_blue += red_blue_step, green += green_step;
        ONE_BY_ONE(red_blue, green);
    }
}

#define DEEP_888(which)                                              \
    if (depth >> DEPTH_BITS > to_depth[which]) {                     \
        to_depth[which] = (uint16_t)(depth >> DEPTH_BITS);           \
        to[which] = (red_blue >> 8 & 0xff00ffu) | (green & 0xff00u); \
    }                                                                \
    depth += depth_step, red_blue += red_blue_step, green += green_step;

static void fill_deep_888(void *pixels, uint16_t *to_depth, int32_t count, const row_span *s)
{
    uint32_t *to = (uint32_t *)pixels, depth = s->depth, red_blue = (s->red << 16) + s->blue, green = s->green;
    const uint32_t depth_step = s->depth_step, red_blue_step = (s->red_step << 16) + s->blue_step,
                   green_step = s->green_step;
    const uint32_t *const past = to + count;
    if (count & 1) {
        DEEP_888(0)
        ++to, ++to_depth;
    }
    for (; to != past; to += 2, to_depth += 2) {
        DEEP_888(0)
        DEEP_888(1)
    }
}

typedef void fill_loop(void *pixels, uint16_t *to_depth, int32_t count, const row_span *s);

static fill_loop *loop_of(const fixed_band *b)
{
    static fill_loop *const loops[3][2] = {{fill_hull_888, fill_deep_888}, {fill_hull_555, fill_deep_555},
                                           {fill_hull_5551, fill_deep_5551}};
    return loops[b->format][b->depth != NULL];
}

/* log2 of the bytes per pixel. */
static int32_t bytes_log2(const fixed_band *b) { return b->format == LMB_FIXED_RGB888 ? 2 : 1; }

void lmb_fixed_clear(const fixed_band *b, uint32_t colour)
{
    static const row_span nothing = {0};
    row_span s = nothing;
    s.red = colour >> 8 & 0xff00u, s.green = colour & 0xff00u, s.blue = (colour & 255u) << 8;
    for (int32_t y = b->first; y < b->past; ++y) {
        s.dither = dithers[y & 3];
        loop_of(b)((unsigned char *)b->pixel + (b->width * (y - b->first) << bytes_log2(b)), NULL, b->width, &s);
    }
}

/* A value along a row. */
typedef struct fixed_ramp {
    uint32_t at;
    int32_t step;
} fixed_ramp;

/* Pixel centres beside an edge may lie slightly outside the triangle: clamps both ends to 0 .. max. */
static fixed_ramp ramp_within(uint32_t from, int32_t step, int32_t count, int32_t max)
{
    fixed_ramp r = {from, step};
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

/* The step in 1/256 of a code. */
static int32_t colour_step(uint32_t to_x) { return (int32_t)(to_x + 128u) >> 8; }

static fixed_ramp colour_ramp(uint32_t from, uint32_t to_x, int32_t count)
{
    return ramp_within((uint32_t)((int32_t)from >> 8), colour_step(to_x), count, FIXED_TOP);
}

/* For triangles that are not gentle; they are rare. */
NOINLINE void set_steep(row_span *s, const uint32_t at[4], const uint32_t per_x[4], int32_t count)
{
    const fixed_ramp d = ramp_within(at[0], (int32_t)per_x[0], count, 0x3fffffff),
                     r = colour_ramp(at[1], per_x[1], count), g = colour_ramp(at[2], per_x[2], count),
                     b = colour_ramp(at[3], per_x[3], count);
    s->depth = d.at, s->depth_step = (uint32_t)d.step;
    s->red = r.at, s->green = g.at, s->blue = b.at;
    s->red_step = (uint32_t)r.step, s->green_step = (uint32_t)g.step, s->blue_step = (uint32_t)b.step;
}

/* Moves to another pixel of the row, usually the next. */
#define MOVE(way, by) \
    (depth way (by)*depth_x, red way (by)*red_x, green way (by)*green_x, blue way (by)*blue_x)

/* Fills rows first .. past - 1. Values read in each row are copied first, because the stack is usually the fastest
 * memory. */
ALWAYS_INLINE void fill_rows(const fixed_band *b, const lmb_fixed_ready *r, int32_t first, int32_t past, int is_deep)
{
    const int32_t middle = within(r->middle, first, past), log2 = bytes_log2(b), above = b->width * (first - b->first),
                  pitch = b->width << log2, width = b->width, most_left = r->left,
                  most_right = r->right, is_gentle = r->is_gentle, is_whole_left = r->is_whole_left;
    const uint32_t depth_x = is_deep ? r->per_x[0] : 0, red_x = r->per_x[1], green_x = r->per_x[2],
                   blue_x = r->per_x[3], depth_y = is_deep ? r->per_y[0] : 0, red_y = r->per_y[1],
                   green_y = r->per_y[2], blue_y = r->per_y[3], down = (uint32_t)(first - r->first);
    uint32_t depth = is_deep ? r->at[0] + depth_y * down : 0, red = r->at[1] + red_y * down,
             green = r->at[2] + green_y * down, blue = r->at[3] + blue_y * down;
    unsigned char *to = (unsigned char *)b->pixel + (above << log2);
    uint16_t *to_depth = is_deep ? b->depth + above : NULL;
    fill_loop *const loop = loop_of(b);
    int32_t at = 0; /* the pixel of the current values */
    row_span s;
    s.depth_step = depth_x, s.red_step = (uint32_t)colour_step(red_x), s.green_step = (uint32_t)colour_step(green_x);
    s.blue_step = (uint32_t)colour_step(blue_x);
    const lmb_fixed_edge *other = first < middle ? &r->upper : &r->lower;
    lmb_fixed_edge whole = r->whole;
    whole.at += whole.slope * (int32_t)down;
    int32_t y = first, other_at = other->at + other->slope * (first - (first < middle ? r->first : r->middle));
    for (int32_t end = first < middle ? middle : past; y < past; end = past, other = &r->lower, other_at = other->at) {
        lmb_fixed_edge left = {is_whole_left ? whole.at : other_at, is_whole_left ? whole.slope : other->slope},
                       right = {is_whole_left ? other_at : whole.at, is_whole_left ? other->slope : whole.slope};
        for (; y < end; ++y) {
            const int32_t x = maxi(first_fixed_pixel(left.at), most_left),
                          count = mini(first_fixed_pixel(right.at), most_right) - x;
            if (count > 0) {
                const int32_t by = x - at;
                if (by == 1) {
                    MOVE(+=, 1);
                } else if (by == -1) {
                    MOVE(-=, 1);
                } else if (by != 0) {
                    MOVE(+=, (uint32_t)by);
                }
                at = x;
                if (is_gentle) {
                    s.depth = depth, s.red = red >> 8, s.green = green >> 8, s.blue = blue >> 8;
                } else {
                    const uint32_t n[4] = {depth, red, green, blue};
                    set_steep(&s, n, r->per_x, count);
                }
                s.dither = dithers[y & 3] + (x & 3);
                loop(to + (x << log2), is_deep ? to_depth + x : NULL, count, &s);
            }
            to += pitch;
            if (is_deep) {
                to_depth += width;
            }
            left.at += left.slope, right.at += right.slope;
            KEEP(left.at);
            KEEP(right.at);
            depth += depth_y, red += red_y, green += green_y, blue += blue_y;
        }
        whole.at = is_whole_left ? left.at : right.at;
    }
}

NOINLINE void fill_hull(const fixed_band *b, const lmb_fixed_ready *r, int32_t first, int32_t past)
{
    fill_rows(b, r, first, past, 0);
}

NOINLINE void fill_deep(const fixed_band *b, const lmb_fixed_ready *r, int32_t first, int32_t past)
{
    fill_rows(b, r, first, past, 1);
}

void lmb_fixed_fill(const fixed_band *b, const lmb_fixed_ready *r)
{
    const int32_t first = maxi(r->first, b->first), past = mini(r->past, b->past);
    if (first < past) {
        if (b->depth == NULL) {
            fill_hull(b, r, first, past);
        } else {
            fill_deep(b, r, first, past);
        }
    }
}

/* Sets an edge at the centre of a row. */
static void set_fixed_edge(lmb_fixed_edge *out, const lmb_fixed_vertex *from, const lmb_fixed_vertex *to, int32_t row)
{
    const fixed_edge e = fixed_edge_of(from, to);
    out->at = fixed_edge_at(&e, 16 * row + 8);
    out->slope = e.slope;
}

static void set_number(lmb_fixed_ready *out, int i, const fixed_plane *p, const lmb_fixed_vertex *c)
{
    out->at[i] = p->at + p->per_x * (uint32_t)(8 - c->x) + p->per_y * (uint32_t)(16 * out->first + 8 - c->y);
    out->per_x[i] = p->per_x * 16u;
    out->per_y[i] = p->per_y * 16u;
}

int lmb_fixed_set_up(lmb_fixed_ready *out, const lmb_fixed_vertex *c0, const lmb_fixed_vertex *c1,
                     const lmb_fixed_vertex *c2, int32_t width, int32_t first, int32_t past, int has_depth)
{
    const lmb_fixed_vertex *top = c0, *middle = c1, *bottom = c2, *swap;
    fixed_plane p;
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
        is_gentle &= set_fixed_depth(&p, &s, c0->depth, c1->depth, c2->depth);
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
    set_fixed_edge(&out->whole, top, bottom, y0);
    if (y0 < y1) {
        set_fixed_edge(&out->upper, top, middle, y0);
    }
    if (y1 < y2) {
        set_fixed_edge(&out->lower, middle, bottom, y1);
    }
    return 1;
}
