/* test_fixed.c: integer frames: number formats, coverage, clipping, bands, light, and damaged blobs. */
#include <lambent/lambent.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/vertex/fixed_part.h"
#include "../../src/vertex/number.h"
#include "../small_fixed.h"
#include "../test.h"

void test_fixed(void);

static double larger(double a, double b) { return a > b ? a : b; }

/* --- numbers ------------------------------------------------------------------------------------------------------ */

static void test_numbers(void)
{
    double low = 1.0, high = -1.0, cube = 0.0, code = 0.0;
    for (uint32_t v = 0x80000000u; v >= 0x80000000u; v += 997) {
        const double off = (double)reciprocal(v) * (double)v / 4611686018427387904.0 - 1.0;
        low = off < low ? off : low;
        high = larger(high, off);
        if (v > 0xffffffffu - 997) {
            break;
        }
    }
    CHECK_MSG(low > -1.0 / 131072.0 && high < 1.0 / 536870912.0, "a reciprocal is off by %g .. %g", low, high);
    CHECK(reciprocal(0x80000000u) < 0x80000000u && reciprocal(0xffffffffu) > 0x3fff8000u);
    for (uint32_t v = 1u << 28; v < 1u << 30; v += 1009) {
        const double m = v / 268435456.0;
        cube = larger(cube, fabs(inverse_cube(v) / 65536.0 * m * sqrt(m) - 1.0));
    }
    CHECK_MSG(cube < 1.0 / 4096.0, "a power is off by %g", cube);
    for (uint32_t v = 0; v < 17000; ++v) {
        const double x = (v > 16383 ? 16383 : v) / 16384.0;
        code = larger(code, fabs(srgb_of(v) / 256.0 - 255.0 * (x <= 0.0031308 ? 12.92 * x
                                                                                : 1.055 * pow(x, 1.0 / 2.4) - 0.055)));
    }
    CHECK_MSG(code < 0.25, "a code is off by %g", code);
    for (int i = 0; i < 32; ++i) {
        CHECK(zeros_above(1u << i) == 31 - i && zeros_above(0xffffffffu >> i) == i);
    }
}

/* --- coverage ----------------------------------------------------------------------------------------------------- */

enum { SIDE = 64 };
static uint32_t pixel[SIDE * SIDE];
static uint16_t depth[SIDE * SIDE];

static void clear(void)
{
    memset(pixel, 0, sizeof pixel);
    memset(depth, 0, sizeof depth);
}

static lmb_fixed_vertex random_corner(test_rng *rng)
{
    lmb_fixed_vertex c;
    c.x = (int16_t)((int32_t)(test_random(rng) % 1400) - 200);
    c.y = (int16_t)((int32_t)(test_random(rng) % 1400) - 200);
    c.depth = (uint16_t)(FIXED_LEAST_DEPTH + test_random(rng) % (FIXED_MOST_DEPTH - FIXED_LEAST_DEPTH + 1));
    for (int i = 0; i < 3; ++i) {
        c.colour[i] = (uint8_t)(FIXED_LEAST + test_random(rng) % (FIXED_MOST - FIXED_LEAST + 1));
    }
    c.flags = 0;
    return c;
}

static void fill(const fixed_band *b, const lmb_fixed_vertex *c0, const lmb_fixed_vertex *c1, const lmb_fixed_vertex *c2)
{
    lmb_fixed_ready r;
    if (lmb_fixed_set_up(&r, c0, c1, c2, b->width, b->first, b->past, b->depth != NULL)) {
        lmb_fixed_fill(b, &r);
    }
}

/* Counts the pixels that a triangle covers, at constant depth, so that all are drawn. */
static void cover(uint8_t *count, lmb_fixed_vertex a, lmb_fixed_vertex b, lmb_fixed_vertex c)
{
    const fixed_band band = {pixel, depth, SIDE, 0, SIDE, LMB_FIXED_RGB888};
    clear();
    a.depth = b.depth = c.depth = 1000;
    fill(&band, &a, &b, &c);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        count[i] = (uint8_t)(count[i] + (depth[i] != 0));
    }
}

/* Corners around a centre: no pixel is drawn twice, and none well inside is left out. */
static void test_fans(void)
{
    enum { AROUND = 7 };
    static uint8_t count[SIDE * SIDE];
    test_rng rng = {5};
    int twice = 0, gaps = 0;
    for (int n = 0; n < 400; ++n) {
        lmb_fixed_vertex middle = random_corner(&rng), ring[AROUND];
        middle.x = (int16_t)(300 + test_random(&rng) % 400), middle.y = (int16_t)(300 + test_random(&rng) % 400);
        for (int i = 0; i < AROUND; ++i) {
            const double turn = (i + (double)test_uniform(&rng, 0.0f, 0.8f)) * 6.283185307 / AROUND;
            const double far = 500.0 + (double)(test_random(&rng) % 400);
            ring[i] = random_corner(&rng);
            ring[i].x = (int16_t)(middle.x + (int32_t)(far * cos(turn)));
            ring[i].y = (int16_t)(middle.y + (int32_t)(far * sin(turn)));
        }
        memset(count, 0, sizeof count);
        for (int i = 0; i < AROUND; ++i) {
            cover(count, middle, ring[i], ring[(i + 1) % AROUND]);
        }
        for (int i = 0; i < SIDE * SIDE; ++i) {
            const double x = 16 * (i % SIDE) + 8 - middle.x, y = 16 * (i / SIDE) + 8 - middle.y;
            twice += count[i] > 1;
            gaps += count[i] == 0 && x * x + y * y < 190.0 * 190.0;
        }
    }
    CHECK_MSG(twice == 0 && gaps == 0, "%d pixels twice, %d left out", twice, gaps);
}

/* Colours and depths against the plane through the corners; slivers stay within the range of the corners. */
static void test_planes(void)
{
    test_rng rng = {9};
    double most_off = 0.0, most_far = 0.0;
    int outside = 0;
    for (int n = 0; n < 3000; ++n) {
        const fixed_band band = {pixel, depth, SIDE, 0, SIDE, LMB_FIXED_RGB888};
        lmb_fixed_vertex c[3] = {random_corner(&rng), random_corner(&rng), random_corner(&rng)};
        if (n % 3 == 0) { /* a sliver */
            c[2].x = (int16_t)((c[0].x + c[1].x) / 2 + (int32_t)(test_random(&rng) % 5));
            c[2].y = (int16_t)((c[0].y + c[1].y) / 2);
        }
        clear();
        fill(&band, &c[0], &c[1], &c[2]);
        const double x1 = c[1].x - c[0].x, y1 = c[1].y - c[0].y, x2 = c[2].x - c[0].x, y2 = c[2].y - c[0].y,
                     area = x1 * y2 - x2 * y1;
        for (int i = 0; i < SIDE * SIDE; ++i) {
            if (depth[i] == 0) {
                continue;
            }
            const double x = 16 * (i % SIDE) + 8 - c[0].x, y = 16 * (i / SIDE) + 8 - c[0].y,
                         b1 = (x * y2 - x2 * y) / area, b2 = (x1 * y - x * y1) / area;
            const int is_fat = fabs(area) > 40000.0;
            for (int k = 0; k < 3; ++k) {
                const int own = (int)(pixel[i] >> (16 - 8 * k) & 255u);
                const double want = c[0].colour[k] + (c[1].colour[k] - c[0].colour[k]) * b1 +
                                    (c[2].colour[k] - c[0].colour[k]) * b2;
                const int low = mini(c[0].colour[k], mini(c[1].colour[k], c[2].colour[k])),
                          high = maxi(c[0].colour[k], maxi(c[1].colour[k], c[2].colour[k]));
                most_off = is_fat ? larger(most_off, fabs(own - want)) : most_off;
                outside += own < low - 17 || own > high + 17;
            }
            const double want = c[0].depth + (c[1].depth - c[0].depth) * b1 + (c[2].depth - c[0].depth) * b2;
            most_far = is_fat ? larger(most_far, fabs(depth[i] - want)) : most_far;
        }
    }
    CHECK_MSG(most_off < 1.5 && most_far < 40.0, "colours off by %g, depths by %g", most_off, most_far);
    CHECK_MSG(outside == 0, "%d colours of slivers are none between the corners'", outside);
}

/* Found by search: wide and steep, so that rounding takes a colour outside the corners' at an end of a row. It must not
 * leave the range of codes, in which it would wrap. */
static void test_wide(void)
{
    enum { WIDE = 960, ROWS = 8 };
    static const lmb_fixed_vertex corners[][3] = {
        {{141, 102, 65519, {247, 1, 247}, 0}, {14926, 120, 65519, {247, 1, 1}, 0},
         {11927, 223, 65519, {1, 247, 247}, 0}},
        {{7911, 215, 16, {1, 247, 1}, 0}, {1035, 46, 65519, {247, 247, 1}, 0}, {15171, 54, 16, {1, 1, 1}, 0}},
        {{788, -33, 16, {1, 1, 247}, 0}, {842, 244, 65519, {247, 247, 1}, 0}, {15151, 107, 16, {1, 1, 247}, 0}},
        {{606, 35, 16, {1, 1, 247}, 0}, {15233, 54, 65519, {247, 1, 1}, 0}, {923, 139, 16, {247, 1, 1}, 0}}};
    static uint32_t wide[WIDE * ROWS];
    static uint16_t far_away[WIDE * ROWS];
    for (int n = 0; n < (int)(sizeof corners / sizeof *corners); ++n) {
        const fixed_band band = {wide, far_away, WIDE, 0, ROWS, LMB_FIXED_RGB888};
        const lmb_fixed_vertex *c = corners[n];
        const double x1 = c[1].x - c[0].x, y1 = c[1].y - c[0].y, x2 = c[2].x - c[0].x, y2 = c[2].y - c[0].y,
                     area = x1 * y2 - x2 * y1;
        int drawn = 0;
        double off = 0.0;
        memset(far_away, 0, sizeof far_away);
        fill(&band, &c[0], &c[1], &c[2]);
        for (int i = 0; i < WIDE * ROWS; ++i) {
            const double x = 16 * (i % WIDE) + 8 - c[0].x, y = 16 * (i / WIDE) + 8 - c[0].y,
                         b1 = (x * y2 - x2 * y) / area, b2 = (x1 * y - x * y1) / area;
            for (int k = 0; k < 3 && far_away[i] != 0; ++k) {
                const int own = (int)(wide[i] >> (16 - 8 * k) & 255u);
                const double want = c[0].colour[k] + (c[1].colour[k] - c[0].colour[k]) * b1 +
                                    (c[2].colour[k] - c[0].colour[k]) * b2;
                off = larger(off, fabs(own - fmin(fmax(want, 1.0), 247.0)));
                ++drawn;
            }
        }
        CHECK_MSG(drawn > WIDE && off < 12.0, "triangle %d: %d values, off by %g", n, drawn, off);
    }
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

enum { WIDTH = 96, HEIGHT = 64 };
static uint32_t words[SMALL_FIXED_WORDS], memory[8192], picture[2][WIDTH * HEIGHT];
static uint16_t far_of[WIDTH * HEIGHT];

static void make_frame(lmb_fixed *s, lmb_fixed_frame *f, int which)
{
    memset(f, 0, sizeof *f);
    CHECK(small_fixed(words) == sizeof words);
    CHECK(lmb_fixed_open(s, words, sizeof words) == LMB_OK);
    CHECK(lmb_fixed_lay(f, s, s->triangles, memory, sizeof memory) == LMB_OK);
    small_fixed_frame(f, WIDTH, HEIGHT, which);
    f->pixel = picture[0];
    f->depth = far_of;
    f->background = 0xff00ffu;
}

static lmb_fixed_ready ready[256];

/* From inside a closed room every pixel is drawn, whatever the near plane and guard band. Bands of any height match the
 * picture, with any memory for prepared triangles. */
static void test_frames(void)
{
    static const int32_t rows[4] = {1, 7, 16, 33};
    static const uint32_t caps[4] = {0, 3, 10, 256};
    lmb_fixed s;
    lmb_fixed_frame f;
    for (int which = 0; which < 8; ++which) {
        int left = 0, differ = 0;
        make_frame(&s, &f, which);
        CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
        CHECK(lmb_fixed_band(&f, 0, HEIGHT) == LMB_OK);
        for (int i = 0; i < WIDTH * HEIGHT; ++i) {
            left += picture[0][i] == f.background;
        }
        for (int k = 0; k < 4; ++k) {
            f.ready = ready;
            f.ready_cap = caps[(k + which) % 4];
            memset(ready, 0x55, sizeof ready);
            memset(picture[1], 0x55, sizeof picture[1]);
            CHECK(lmb_fixed_prepare(&f) == LMB_OK);
            CHECK(f.ready_count <= f.ready_cap && (f.ready_cap < f.seen_count || f.ready_count == f.seen_count));
            for (int32_t y = 0; y < HEIGHT; y += rows[k]) {
                f.pixel = picture[1] + WIDTH * y;
                CHECK(lmb_fixed_band(&f, y, mini(y + rows[k], HEIGHT)) == LMB_OK);
            }
            differ += memcmp(picture[0], picture[1], sizeof picture[0]) != 0;
        }
        f.background = LMB_FIXED_COVERED;
        memset(picture[1], 0x55, sizeof picture[1]);
        f.pixel = picture[1];
        CHECK(lmb_fixed_band(&f, 0, HEIGHT) == LMB_OK);
        differ += memcmp(picture[0], picture[1], sizeof picture[0]) != 0;
        CHECK_MSG(left == 0 && differ == 0, "frame %d: %d pixels left, %d band heights differ", which, left, differ);
    }
}

/* A code with dither in 5 bits. */
static uint32_t level(uint32_t code, int x, int y)
{
    static const uint32_t bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    return (code + bayer[y & 3][x & 3] / 2) / 8;
}

/* 16-bit formats are the codes of the 32-bit picture, dithered, in bands of any height. */
static void test_formats(void)
{
    static uint16_t small[WIDTH * HEIGHT];
    lmb_fixed s;
    lmb_fixed_frame f;
    for (int which = 0; which < 8; ++which) {
        make_frame(&s, &f, which);
        f.background = which & 1 ? LMB_FIXED_COVERED : 0xf80010u;
        CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
        if (which & 2) {
            f.seen_count = f.seen_count / 2; /* so that some background is left */
        }
        memset(picture[0], 0, sizeof picture[0]);
        memset(small, 0, sizeof small);
        CHECK(lmb_fixed_band(&f, 0, HEIGHT) == LMB_OK);
        for (f.format = LMB_FIXED_BGR555; f.format <= LMB_FIXED_RGBA5551; ++f.format) {
            int wrong = 0;
            for (int32_t y = 0; y < HEIGHT; y += 5 + which) {
                f.pixel_16 = small + WIDTH * y;
                CHECK(lmb_fixed_band(&f, y, mini(y + 5 + which, HEIGHT)) == LMB_OK);
            }
            for (int i = 0; i < WIDTH * HEIGHT; ++i) {
                const uint32_t c = picture[0][i], r = level(c >> 16, i % WIDTH, i / WIDTH),
                               g = level(c >> 8 & 255u, i % WIDTH, i / WIDTH), b = level(c & 255u, i % WIDTH, i / WIDTH);
                const uint32_t wanted = f.format == LMB_FIXED_BGR555 ? r | g << 5 | b << 10
                                                                     : r << 11 | g << 6 | b << 1 | 1u;
                wrong += c != 0 && small[i] != wanted;
            }
            CHECK_MSG(wrong == 0, "frame %d, format %d: %d pixels", which, (int)f.format, wrong);
        }
        f.format = LMB_FIXED_RGBA5551 + 1;
        CHECK(lmb_fixed_band(&f, 0, HEIGHT) == LMB_ERR_ARG);
        f.format = LMB_FIXED_BGR555, f.pixel_16 = NULL;
        CHECK(lmb_fixed_band(&f, 0, HEIGHT) == LMB_ERR_ARG);
    }
}

/* Drawing the hull without depth equals drawing it with depth, except at its edges with the objects on it. */
static void test_hull(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    for (int which = 0; which < 8; ++which) {
        int differ = 0;
        for (int k = 0; k < 2; ++k) {
            make_frame(&s, &f, which);
            CHECK(s.hull == s.triangles / 2);
            s.hull = k ? s.hull : 0;
            f.pixel = picture[k];
            CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
            CHECK(lmb_fixed_band(&f, 0, HEIGHT) == LMB_OK);
        }
        for (int i = 0; i < WIDTH * HEIGHT; ++i) {
            differ += picture[0][i] != picture[1][i];
        }
        CHECK_MSG(differ <= 4, "frame %d: %d pixels differ", which, differ);
    }
}

/* Cameras everywhere in the room, also at walls and edges: no gaps, whatever is clipped. */
static void test_views(void)
{
    test_rng rng = {3};
    lmb_fixed s;
    lmb_fixed_frame f;
    int left = 0;
    make_frame(&s, &f, 0);
    for (int n = 0; n < 200; ++n) {
        int32_t eye[3], to[3];
        for (int i = 0; i < 3; ++i) {
            eye[i] = (int32_t)(test_random(&rng) % 3801) - 1900;
            to[i] = (int32_t)(test_random(&rng) % 3801) - 1900;
        }
        f.view.focal = 200 + (int32_t)(test_random(&rng) % 3000);
        f.view.near_units = 16;
        if (eye[0] > -250 && eye[0] < 700 && eye[1] > -800 && eye[1] < 200 && eye[2] > -800 && eye[2] < 200) {
            continue; /* inside the small cube */
        }
        if (lmb_fixed_look_at(&f.view, eye, to) != LMB_OK) {
            continue;
        }
        CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_band(&f, 0, HEIGHT) == LMB_OK);
        for (int i = 0; i < WIDTH * HEIGHT; ++i) {
            left += picture[0][i] == f.background;
        }
    }
    CHECK_MSG(left == 0, "%d pixels of a closed room left", left);
}

/* The longest distance from eye to target: axes are orthogonal and of one length, and back points to the eye. */
static void test_far_eyes(void)
{
    static const int32_t eye[3] = {LMB_FIXED_EYE, -LMB_FIXED_EYE, 20000}, to[3] = {-8191, 8191, -1000};
    const double way[3] = {eye[0] - to[0], eye[1] - to[1], eye[2] - to[2]};
    const double length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    lmb_fixed_view v;
    memset(&v, 0, sizeof v);
    CHECK(lmb_fixed_look_at(&v, eye, to) == LMB_OK);
    for (int i = 0; i < 3; ++i) {
        CHECK_MSG(fabs(v.axis[2][i] - LMB_FIXED_ONE * way[i] / length) < 8.0, "%d: %d", i, (int)v.axis[2][i]);
        for (int k = 0; k < 3; ++k) {
            double product = 0.0;
            for (int c = 0; c < 3; ++c) {
                product += (double)v.axis[i][c] * (double)v.axis[k][c] / ((double)LMB_FIXED_ONE * LMB_FIXED_ONE);
            }
            CHECK_MSG(fabs(product - (i == k)) < 1.0 / 1024.0, "axes %d and %d: %g", i, k, product);
        }
    }
}

/* One wall that sees the whole lamp, against the formula. */
static void test_light(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    double most_off = 0.0;
    make_frame(&s, &f, 0);
    uint32_t *seen = words + SMALL_FIXED_WORDS - SMALL_FIXED_RECEIVERS;
    for (int i = 0; i < SMALL_FIXED_RECEIVERS; ++i) {
        seen[i] = 0x07ffffffu;
    }
    f.bounces = 0;
    for (int n = 0; n < 27; ++n) {
        f.lamp.position[0] = 600 * (n % 3) - 500, f.lamp.position[1] = 700 * (n / 3 % 3) - 900;
        f.lamp.position[2] = 500 * (n / 9) - 300;
        f.lamp.intensity[0] = f.lamp.intensity[1] = f.lamp.intensity[2] = 9000;
        CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
        for (uint32_t i = 0; i < s.vertices; ++i) {
            fixed_receiver r;
            double along = 0.0, far2 = 0.0;
            fixed_receiver_at(&r, &s, i);
            for (int k = 0; k < 3; ++k) {
                const double d = f.lamp.position[k] - r.at[k];
                along += d * r.normal[k] / 127.0;
                far2 += d * d;
            }
            const double light = along > 0.0 ? 9000.0 / 4096.0 * along / sqrt(far2) / (far2 / 1048576.0) : 0.0;
            for (int c = 0; c < 3 && (f.vertex[i].flags & FIXED_USED); ++c) {
                const double v = light * (r.albedo[c] / 255.0) * (r.albedo[c] / 255.0), x = v > 1.0 ? 1.0 : v,
                             code = 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055);
                most_off = larger(most_off, fabs(f.vertex[i].colour[c] - (code > FIXED_MOST ? FIXED_MOST : code)));
            }
        }
    }
    CHECK_MSG(most_off < 1.2, "direct light is off by %g codes", most_off);
}

/* Makes a frame without bounces from a blob with the given units per metre, and without occlusion. */
static void make_open(lmb_fixed *s, lmb_fixed_frame *f, int which, uint32_t units_log2, uint32_t intensity)
{
    make_frame(s, f, which);
    uint32_t *seen = words + SMALL_FIXED_WORDS - SMALL_FIXED_RECEIVERS;
    for (int i = 0; i < SMALL_FIXED_RECEIVERS; ++i) {
        seen[i] = 0x07ffffffu;
    }
    words[2] = units_log2;
    CHECK(lmb_fixed_open(s, words, sizeof words) == LMB_OK);
    f->bounces = 0;
    f->lamp.intensity[0] = f->lamp.intensity[1] = f->lamp.intensity[2] = intensity;
}

/* If a unit is a metre, the light of most lamps is below the smallest step, by more bits than a word has in some
 * cases. */
static void test_dim(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    for (uint32_t bit = 0; bit < 15; ++bit) {
        int wrong = 0, dark = 0;
        make_open(&s, &f, (int)bit % 4, 0, 1u << bit);
        CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
        for (uint32_t i = 0; i < s.vertices; ++i) {
            fixed_receiver r;
            double far2 = 0.0;
            fixed_receiver_at(&r, &s, i);
            for (int k = 0; k < 3; ++k) {
                far2 += (double)(f.lamp.position[k] - r.at[k]) * (f.lamp.position[k] - r.at[k]);
            }
            if ((f.vertex[i].flags & FIXED_USED) != 0 && (double)(1u << bit) * 16.0 / far2 < 2.0) { /* of 65,536 */
                ++dark;
                for (int c = 0; c < 3; ++c) {
                    wrong += f.vertex[i].colour[c] != FIXED_LEAST;
                }
            }
        }
        CHECK_MSG(wrong == 0 && dark > 30, "intensity %u: %d of %d", 1u << bit, wrong, dark);
    }
}

/* A lamp close to a vertex exceeds the largest step there, for any number of lost bits. */
static void test_dazzling(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    int wrong = 0, lit = 0;
    for (uint32_t n = 0; n < 20 * SMALL_FIXED_VERTICES; n += 3) {
        const uint32_t i = n % SMALL_FIXED_VERTICES, near = n / SMALL_FIXED_VERTICES;
        fixed_receiver r;
        make_open(&s, &f, (int)i % 4, 16, (1u << 20) - 1 - 977 * i - 31 * near);
        fixed_receiver_at(&r, &s, i);
        for (int k = 0; k < 3; ++k) {
            f.lamp.position[k] = r.at[k] + r.normal[k] / 127 * (near < 12 ? 1 : (int32_t)near);
        }
        if (lmb_fixed_transform(&f) != LMB_OK || lmb_fixed_light(&f) != LMB_OK) {
            ++wrong;
        }
        for (int c = 0; c < 3 && (f.vertex[i].flags & FIXED_USED) != 0; ++c) {
            wrong += f.vertex[i].colour[c] != FIXED_MOST;
            ++lit;
        }
    }
    CHECK_MSG(wrong == 0 && lit > 1000, "%d of %d", wrong, lit);
}

/* Links: an additional bounce is never darker, and light scales with the lamp. */
static void test_bounces(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    uint32_t sum[4] = {0, 0, 0, 0};
    for (int bounces = 0; bounces < 4; ++bounces) {
        make_frame(&s, &f, 1);
        f.bounces = bounces;
        CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
        for (uint32_t i = 0; i < s.vertices; ++i) {
            sum[bounces] += (f.vertex[i].flags & FIXED_USED) ? f.vertex[i].colour[1] : 0u;
        }
    }
    CHECK_MSG(sum[0] < sum[1] && sum[1] < sum[2] && sum[2] <= sum[3], "%u, %u, %u, %u", (unsigned)sum[0],
              (unsigned)sum[1], (unsigned)sum[2], (unsigned)sum[3]);
}

/* A row that sees only one element shows the light of the element in closed form. */
static void test_one_link(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    make_frame(&s, &f, 0);
    const uint32_t receivers = s.vertices + s.elements;
    uint32_t *row = words + LMB_FIXED_HEADER_WORDS + 3 * receivers + 2 * s.triangles, *link = row + 2 * receivers;
    for (uint32_t i = 0; i < receivers; ++i) {
        row[2 * i] = 2u << 24;
        row[2 * i + 1] = 134217728u; /* 100 / 2^36 of 2^27: a share of 0.1953 */
    }
    link[0] = 100u << 8 | 3u | 3u << 16;
    CHECK(lmb_fixed_open(&s, words, sizeof words) == LMB_OK);
    f.bounces = 1;
    /* a lamp directly in front of face 3, hidden from all others: they see it only through the link */
    CHECK(lmb_fixed_transform(&f) == LMB_OK && lmb_fixed_light(&f) == LMB_OK);
    fixed_receiver three;
    fixed_receiver_at(&three, &s, s.vertices + 3);
    const double sent = f.direct[3][1] * (three.albedo[1] / 255.0) * (three.albedo[1] / 255.0) * 100.0 * 134217728.0 /
                        68719476736.0;
    lmb_fixed_frame again = f;
    again.bounces = 0;
    static lmb_fixed_vertex lit[SMALL_FIXED_VERTICES];
    memcpy(lit, f.vertex, sizeof lit);
    CHECK(lmb_fixed_light(&again) == LMB_OK);
    double most_off = 0.0;
    int dark = 0;
    for (uint32_t i = 0; i < s.vertices; ++i) {
        fixed_receiver r;
        fixed_receiver_at(&r, &s, i);
        if ((f.vertex[i].flags & FIXED_USED) && f.vertex[i].colour[1] <= FIXED_LEAST) { /* no direct light */
            const double v = sent / 65536.0 * (r.albedo[1] / 255.0) * (r.albedo[1] / 255.0), x = v > 1.0 ? 1.0 : v,
                         code = 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055);
            most_off = larger(most_off, fabs(lit[i].colour[1] - code));
            dark += 1;
        }
    }
    CHECK_MSG(dark > 10 && most_off < 1.2, "%d vertices, off by %g codes", dark, most_off);
}

/* --- refused input ------------------------------------------------------------------------------------------------ */

static lmb_status open_with(size_t at, uint32_t word)
{
    static uint32_t copy[SMALL_FIXED_WORDS];
    lmb_fixed s;
    small_fixed(copy);
    copy[at] = word;
    return lmb_fixed_open(&s, copy, sizeof copy);
}

static void test_refused(void)
{
    const uint32_t magic = 0x4c4d4600u | LMB_FIXED_VERSION;
    const size_t rows = LMB_FIXED_HEADER_WORDS + 3 * SMALL_FIXED_RECEIVERS + 2 * SMALL_FIXED_TRIANGLES,
                 links = rows + 2 * SMALL_FIXED_RECEIVERS,
                 last_element = LMB_FIXED_HEADER_WORDS + 3 * (SMALL_FIXED_RECEIVERS - 1);
    lmb_fixed s;
    small_fixed(words);
    CHECK(open_with(0, magic) == LMB_OK);
    CHECK(open_with(0, magic + 1) == LMB_ERR_FORMAT);
    CHECK(open_with(0, (magic & 255u) << 24 | (magic >> 8 & 255u) << 16 | (magic >> 16 & 255u) << 8 | magic >> 24) ==
          LMB_ERR_BUILD);
    CHECK(lmb_fixed_open(&s, words, sizeof words - 4) == LMB_ERR_FORMAT);
    CHECK(lmb_fixed_open(&s, words, 3) == LMB_ERR_FORMAT && lmb_fixed_open(&s, words, 0) == LMB_ERR_FORMAT);
    CHECK(lmb_fixed_open(&s, (const char *)words + 1, sizeof words - 4) == LMB_ERR_ALIGN);
    for (size_t i = 1; i < 10; ++i) { /* sizes */
        CHECK(open_with(i, 0x7fffffffu) == LMB_ERR_FORMAT);
    }
    CHECK(open_with(10, 8192) == LMB_ERR_FORMAT && open_with(13, 15) == LMB_ERR_FORMAT);
    CHECK(open_with(18, 1) == LMB_ERR_FORMAT && open_with(19, 1) == LMB_ERR_FORMAT);
    CHECK(open_with(13, 8192) == LMB_ERR_FORMAT && open_with(17, SMALL_FIXED_TRIANGLES + 1) == LMB_ERR_FORMAT);
    CHECK(open_with(20, 0x2000) == LMB_ERR_FORMAT);                 /* a position beyond 8191 */
    CHECK(open_with(21, 0x7f7f0000u) == LMB_ERR_FORMAT);            /* a normal that is too long */
    CHECK(open_with(last_element, 0x2000) == LMB_ERR_FORMAT && open_with(last_element + 1, 0x7f7f0000u) == LMB_ERR_FORMAT);
    CHECK(open_with(rows - 1, SMALL_FIXED_VERTICES) == LMB_ERR_FORMAT);
    CHECK(open_with(rows - 2, SMALL_FIXED_VERTICES << 16) == LMB_ERR_FORMAT);
    CHECK(open_with(rows, 0x06ffffffu) == LMB_ERR_FORMAT);          /* links out of range */
    CHECK(open_with(rows, 0x05000000u) == LMB_ERR_FORMAT);          /* an odd number */
    CHECK(open_with(rows + 1, 0xffffffffu) == LMB_ERR_FORMAT);      /* more light than exists */
    CHECK(open_with(links, SMALL_FIXED_FACES) == LMB_ERR_FORMAT);   /* no such element */
}

static void test_arguments(void)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    const int32_t at[3] = {0, 0, 0}, up[3] = {0, 100, 0}, far_away[3] = {9000, 0, 0};
    make_frame(&s, &f, 0);
    CHECK(lmb_fixed_look_at(&f.view, at, at) == LMB_ERR_ARG && lmb_fixed_look_at(&f.view, at, up) == LMB_ERR_ARG);
    CHECK(lmb_fixed_look_at(&f.view, at, far_away) == LMB_ERR_ARG);
    CHECK(lmb_fixed_band(&f, 0, HEIGHT + 1) == LMB_ERR_ARG && lmb_fixed_band(&f, 4, 4) == LMB_ERR_ARG);
    f.view.width = LMB_FIXED_MAX_SIDE + 1;
    CHECK(lmb_fixed_transform(&f) == LMB_ERR_ARG && lmb_fixed_prepare(&f) == LMB_ERR_ARG);
    f.view.width = WIDTH;
    f.view.axis[0][0] = 32768;
    CHECK(lmb_fixed_transform(&f) == LMB_ERR_ARG);
    make_frame(&s, &f, 0);
    f.bounces = 4;
    CHECK(lmb_fixed_light(&f) == LMB_ERR_ARG);
    f.bounces = 1;
    f.lamp.intensity[1] = 1u << 20;
    CHECK(lmb_fixed_light(&f) == LMB_ERR_ARG);
}

void test_fixed(void)
{
    test_numbers();
    test_fans();
    test_planes();
    test_wide();
    test_frames();
    test_formats();
    test_hull();
    test_views();
    test_far_eyes();
    test_light();
    test_dim();
    test_dazzling();
    test_bounces();
    test_one_link();
    test_refused();
    test_arguments();
}
