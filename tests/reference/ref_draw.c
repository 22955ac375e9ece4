/* ref_draw.c: lines, points, blending and fog of fixed-function drawing, evaluated per pixel in binary64. */
#include "ref_draw.h"

#include <lambent/draw.h>
#include <math.h>
#include <string.h>

#include "../test.h"

#if LMB_DRAW

enum { SIDE = 64, ROUNDS = 4000 };
static uint8_t picture[SIDE][SIDE][4];

static lmb_draw_target begin(lmb_draw_state *s)
{
    lmb_draw_target t;
    memset(&t, 0, sizeof t);
    memset(picture, 0, sizeof picture);
    CHECK(lmb_surface_init(&t.colour, LMB_RGBA8, SIDE, SIDE, picture, sizeof picture) == LMB_OK);
    CHECK(lmb_draw_state_init(s, SIDE, SIDE) == LMB_OK && lmb_draw_pixels(s) == LMB_OK);
    return t;
}

/* --- lines and points --------------------------------------------------------------------------------------------- */

typedef struct segment {
    double x0, y0, x1, y1;
} segment;

static int in_diamond(double x, double y) { return fabs(x) + fabs(y) < 0.5; }

/* Returns whether the segment, relative to the pixel's middle, meets the open diamond and ends outside. */
static int leaves(segment s)
{
    double first = 0, last = 1;
    if (in_diamond(s.x1, s.y1)) {
        return 0;
    }
    for (int side = 0; side < 4; ++side) {
        const double a = side & 1 ? 1 : -1, b = side & 2 ? 1 : -1;
        const double from = 0.5 - a * s.x0 - b * s.y0, to = 0.5 - a * s.x1 - b * s.y1; /* positive inside */
        if (from <= 0 && to <= 0) {
            return 0;
        }
        if (from < 0) {
            first = fmax(first, from / (from - to));
        } else if (to < 0) {
            last = fmin(last, from / (from - to));
        }
    }
    return first < last;
}

/* A small "a little" as in the header: the offset only decides between pixels if a line passes through a corner. */
static segment moved(const float c[2][3], double x, double y)
{
    const double little = 1e-9, less = 1e-12;
    const segment s = {floor((double)c[0][0] * 256 + 0.5) / 256 - x - little,
                       floor((double)c[0][1] * 256 + 0.5) / 256 - y - less,
                       floor((double)c[1][0] * 256 + 0.5) / 256 - x - little,
                       floor((double)c[1][1] * 256 + 0.5) / 256 - y - less};
    return s;
}

/* Corners on a grid of 1/256, 1/4 or 1/2 px, so that many lines pass through corners of diamonds. */
static void make_line(float c[2][3], test_rng *r, int round)
{
    const float grid = round % 3 == 0 ? 256.0f : round % 3 == 1 ? 4.0f : 2.0f;
    const float reach = round % 5 == 0 ? 3.0f : 40.0f;
    memset(c, 0, 6 * sizeof(float));
    for (int k = 0; k < 2; ++k) {
        c[0][k] = floorf(test_uniform(r, -5, SIDE + 5) * grid) / grid;
        c[1][k] = c[0][k] + floorf(test_uniform(r, -reach, reach) * grid) / grid;
    }
    if (round % 7 == 0) {
        c[1][1] = c[0][1] + (round % 2 ? c[1][0] - c[0][0] : 0);
    }
}

static int try_line(test_rng *r, int round, int *pixels)
{
    lmb_draw_state s;
    const lmb_draw_target t = begin(&s);
    float c[2][3];
    int wrong = 0;
    make_line(c, r, round);
    const lmb_draw_vertices v = {.positions = c, .count = 2};
    CHECK(lmb_draw_list(&t, &s, &v, LMB_DRAW_LINES, NULL, NULL) == LMB_OK);
    for (int y = 0; y < SIDE; ++y) {
        for (int x = 0; x < SIDE; ++x) {
            const int want = leaves(moved((const float(*)[3])c, x + 0.5, y + 0.5));
            wrong += want != (picture[y][x][3] != 0);
            *pixels += want;
        }
    }
    return wrong;
}

static int try_point(test_rng *r, int round, int *pixels)
{
    lmb_draw_state s;
    const lmb_draw_target t = begin(&s);
    float c[2][3];
    int wrong = 0;
    make_line(c, r, round);
    s.point_px = (uint8_t)(1 + test_random(r) % 12);
    const lmb_draw_vertices v = {.positions = c, .count = 1};
    CHECK(lmb_draw_list(&t, &s, &v, LMB_DRAW_POINTS, NULL, NULL) == LMB_OK);
    const double px = s.point_px, half = s.point_px % 2 ? 0 : 0.5;
    const double at_x = floor((double)c[0][0] * 256 + 0.5) / 256, at_y = floor((double)c[0][1] * 256 + 0.5) / 256;
    const double left = floor(at_x + half) - floor(px / 2), top = floor(at_y + half) - floor(px / 2);
    for (int y = 0; y < SIDE; ++y) {
        for (int x = 0; x < SIDE; ++x) {
            const int want = x >= left && x < left + px && y >= top && y < top + px;
            wrong += want != (picture[y][x][3] != 0);
            *pixels += want;
        }
    }
    return wrong;
}

void ref_draw_lines(void)
{
    test_rng r = {3};
    int wrong[2] = {0, 0}, pixels[2] = {0, 0};
    for (int i = 0; i < ROUNDS; ++i) {
        wrong[0] += try_line(&r, i, &pixels[0]);
        wrong[1] += try_point(&r, i, &pixels[1]);
    }
    printf("lines: %d of %d pixels differ; points: %d of %d\n", wrong[0], pixels[0], wrong[1], pixels[1]);
    CHECK(wrong[0] == 0 && pixels[0] > 10 * ROUNDS);
    CHECK(wrong[1] == 0 && pixels[1] > 10 * ROUNDS);
}

/* --- blending ----------------------------------------------------------------------------------------------------- */

static double factor(const lmb_draw_state *s, int which, const double source[4], const double target[4], int i)
{
    double constant[4];
    for (int k = 0; k < 4; ++k) {
        constant[k] = s->blend_colour[k] / 255.0;
    }
    const double all[15] = {0, 1, source[i], 1 - source[i], source[3], 1 - source[3], target[3], 1 - target[3],
                            target[i], 1 - target[i], i == 3 ? 1 : fmin(source[3], 1 - target[3]), constant[i],
                            1 - constant[i], constant[3], 1 - constant[3]};
    return all[which];
}

static void blend(double target[4], const lmb_draw_state *s, const uint8_t codes[4])
{
    double source[4], made[4];
    for (int i = 0; i < 4; ++i) {
        source[i] = codes[i] / 255.0;
    }
    for (int i = 0; i < 4; ++i) {
        const int alpha = i == 3, equation = s->blend_equation[alpha];
        const double a = source[i] * factor(s, s->blend_source[alpha], source, target, i);
        const double b = target[i] * factor(s, s->blend_target[alpha], source, target, i);
        const double all[5] = {a + b, a - b, b - a, fmin(source[i], target[i]), fmax(source[i], target[i])};
        made[i] = floor(fmin(fmax(all[equation], 0), 1) * 255 + 0.5 + 1e-9) / 255; /* 1e-9: avoids ties */
    }
    memcpy(target, made, sizeof made);
}

void ref_draw_blends(void)
{
    test_rng r = {17};
    int wrong = 0, codes = 0;
    for (int n = 0; n < 40 * 15 * 15; ++n) {
        static const float c[4][3] = {{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}};
        const lmb_draw_vertices v = {.positions = c, .count = 4};
        lmb_draw_state s;
        const lmb_draw_target t = begin(&s);
        double target[4];
        for (int i = 0; i < 4; ++i) {
            picture[1][1][i] = (uint8_t)test_random(&r);
            target[i] = picture[1][1][i] / 255.0;
            s.blend_colour[i] = (uint8_t)test_random(&r);
        }
        s.flags = LMB_DRAW_BLEND;
        s.blend_source[0] = (uint8_t)(n % 15), s.blend_source[1] = (uint8_t)(n / 15 % 15);
        s.blend_target[0] = (uint8_t)(n / 15 % 15 == 10 ? 1 : n / 15 % 15);
        s.blend_target[1] = (uint8_t)(n % 15 == 10 ? 3 : n % 15);
        s.blend_equation[0] = (uint8_t)(test_random(&r) % 5), s.blend_equation[1] = (uint8_t)(test_random(&r) % 5);
        for (int layer = 0; layer < 3; ++layer) {
            for (int i = 0; i < 4; ++i) {
                s.colour[i] = (uint8_t)(test_random(&r) % 9 == 0 ? 255 : test_random(&r));
            }
            CHECK(lmb_draw_list(&t, &s, &v, LMB_DRAW_QUADS, NULL, NULL) == LMB_OK);
            blend(target, &s, s.colour);
        }
        for (int i = 0; i < 4; ++i, ++codes) {
            wrong += fabs(255 * target[i] - picture[1][1][i]) > 1e-6;
        }
    }
    printf("blending: %d of %d codes differ\n", wrong, codes);
    CHECK(wrong == 0);
}

/* --- fog and colours across perspective --------------------------------------------------------------------------- */

/* A triangle in front of the eye at the origin; the view is along -z with half angles of 45 degrees. */
typedef struct facing {
    float corner[3][3];
    uint8_t colour[3][4];
} facing;

static void make_facing(facing *f, test_rng *r)
{
    for (int i = 0; i < 3; ++i) {
        const float z = test_uniform(r, 1, 30);
        f->corner[i][0] = test_uniform(r, -1.5f, 1.5f) * z;
        f->corner[i][1] = test_uniform(r, -1.5f, 1.5f) * z;
        f->corner[i][2] = -z;
        for (int k = 0; k < 4; ++k) {
            f->colour[i][k] = (uint8_t)(k == 3 ? 255 : test_random(r));
        }
    }
}

/* Barycentric weights at the point of the triangle seen at x, y of the picture, 0 .. SIDE. Corners are snapped. */
static int shares_at(double out[3], const facing *f, double x, double y)
{
    double at[3][3], sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double w = -(double)f->corner[i][2];
        at[i][0] = floor(((double)f->corner[i][0] / w + 1) * SIDE / 2 * 256 + 0.5) / 256;
        at[i][1] = floor((1 - (double)f->corner[i][1] / w) * SIDE / 2 * 256 + 0.5) / 256;
        at[i][2] = 1 / w;
    }
    const double area = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
    for (int i = 0; i < 3; ++i) {
        const double *a = at[(i + 1) % 3], *b = at[(i + 2) % 3];
        out[i] = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area * at[i][2];
        sum += out[i];
    }
    for (int i = 0; i < 3; ++i) {
        out[i] /= sum;
    }
    return fabs(area) > 8 && out[0] > 1e-3 && out[1] > 1e-3 && out[2] > 1e-3;
}

static double fog_left(const lmb_draw_state *s, double c)
{
    const double thick = (double)s->fog_density * c;
    const double f = s->fog == LMB_DRAW_FOG_LINEAR ? ((double)s->fog_end - c) / ((double)s->fog_end - (double)s->fog_start)
                     : s->fog == LMB_DRAW_FOG_EXP  ? exp(-thick)
                                                   : exp(-thick * thick);
    return fmin(fmax(f, 0), 1);
}

/* Returns the largest difference in codes; for an exact code it is at most 1/2. */
static double try_fog(test_rng *r, int fog, int *pixels)
{
    lmb_draw_state s;
    const lmb_draw_target t = begin(&s);
    facing f;
    double worst = 0;
    make_facing(&f, r);
    memset(&s.to_clip, 0, sizeof s.to_clip);
    s.to_clip.m[0] = s.to_clip.m[5] = 1, s.to_clip.m[11] = -1, s.to_clip.m[14] = 0.25f;
    s.fog = (uint8_t)fog;
    s.fog_start = 2, s.fog_end = 25, s.fog_density = test_uniform(r, 0.01f, 0.3f);
    s.fog_colour[0] = (uint8_t)test_random(r), s.fog_colour[2] = 255;
    const lmb_draw_vertices v = {.positions = f.corner, .colours = f.colour[0], .count = 3};
    CHECK(lmb_draw_list(&t, &s, &v, LMB_DRAW_TRIANGLES, NULL, NULL) == LMB_OK);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const int x = k % SIDE, y = k / SIDE;
        double share[3];
        if (picture[y][x][3] == 0 || !shares_at(share, &f, x + 0.5, y + 0.5)) {
            continue;
        }
        double distance = 0;
        for (int i = 0; i < 3; ++i) {
            distance -= share[i] * (double)f.corner[i][2];
        }
        const double left = fog == 0 ? 1 : fog_left(&s, distance);
        for (int c = 0; c < 3; ++c) {
            const double own = share[0] * f.colour[0][c] + share[1] * f.colour[1][c] + share[2] * f.colour[2][c];
            worst = fmax(worst, fabs(own * left + s.fog_colour[c] * (1 - left) - picture[y][x][c]));
        }
        ++*pixels;
    }
    return worst;
}

void ref_draw_fogs(void)
{
    static const char *const names[4] = {"none", "linear", "exp", "exp2"};
    for (int fog = 0; fog < 4; ++fog) {
        test_rng r = {(uint64_t)(29 + fog)};
        double worst = 0;
        int pixels = 0;
        for (int i = 0; i < ROUNDS / 10; ++i) {
            worst = fmax(worst, try_fog(&r, fog, &pixels));
        }
        /* Three roundings of 1/2 each: the colour, the fog factor, which weighs a difference of up to 255 codes, and
         * the mix. Weights in narrow triangles are also off by 1e-4 in binary32. */
        printf("fog %s: %d pixels, at most %.3f codes off\n", names[fog], pixels, worst);
        CHECK_MSG(worst < (fog == 0 ? 0.55 : 1.55) && pixels > 10000, "fog %s: %g", names[fog], worst);
    }
}

#else
void ref_draw_lines(void) { SKIP("a build without fixed-function drawing"); }
void ref_draw_blends(void) {}
void ref_draw_fogs(void) {}
#endif
