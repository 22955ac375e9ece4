/* test_room_edges.c: checks that pixels with centres on the edges of a room have the same bounced light as their
 * neighbours, and none if the room is dark. */
#include "../folder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../tools/render/render_draw.h"
#include "../test.h"

#define COUNT_OF(a) ((int)(sizeof(a) / sizeof *(a)))

void test_room_edges(void);

enum { SIDE = 64, CORNERS = 8, MARGIN = 6 /* px at corners and the centre, with steep light changes */ };

/* make check-all tries all positions: the first with all methods, the others with some. It uses the verb's default shadow
 * map in the first position. make nightly tries all methods in all positions, with that shadow map. */
static int is_long(void) { return test_length() > 0; }

/* A room with camera and lamp, rotated about the room's centre, then scaled and moved. `fine`: drawn with the verb's
 * default shadow map. */
typedef struct room {
    double axis[3][3], scale, at[3];
    int fine;
} room;

static void room_place(double out[3], const room *r, double x, double y, double z)
{
    for (int i = 0; i < 3; ++i) {
        out[i] = r->at[i] + r->scale * (r->axis[0][i] * x + r->axis[1][i] * y + r->axis[2][i] * z);
    }
}

static room room_of(uint64_t seed, double scale, double far)
{
    test_rng random = {seed};
    room r = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, scale, {far, 0.3 * far, -far}, test_length() > (seed == 0 ? 0 : 1)};
    for (int turn = 0; turn < 3 && seed != 0; ++turn) {
        const double angle = (double)test_uniform(&random, 0.0f, 6.2831853f), c = cos(angle), s = sin(angle);
        for (int i = 0; i < 3; ++i) {
            const double a = r.axis[turn][i], b = r.axis[(turn + 1) % 3][i];
            r.axis[turn][i] = c * a + s * b;
            r.axis[(turn + 1) % 3][i] = c * b - s * a;
        }
    }
    return r;
}

/* Writes six walls with their fronts inwards. `first`: number of corners written so far. */
static int box_write(char *text, size_t size, const room *r, const double low[3], const double high[3], int first)
{
    static const int walls[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    int end = 0;
    for (int i = 0; i < CORNERS; ++i) {
        double p[3];
        room_place(p, r, i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
        end += snprintf(text + end, size - (size_t)end, "v %.9g %.9g %.9g\n", p[0], p[1], p[2]);
    }
    for (int i = 0; i < 6; ++i) {
        end += snprintf(text + end, size - (size_t)end, "f %d %d %d %d\n", first + walls[i][3] + 1,
                        first + walls[i][2] + 1, first + walls[i][1] + 1, first + walls[i][0] + 1);
    }
    return end;
}

/* Writes the drawn room, a cube of 4 m. `other`: another box that contains the lamp, or NULL. */
static int room_write(char *path, size_t size, folder *f, const room *r, const double other[2][3])
{
    static const double low[3] = {-2, -2, -2}, high[3] = {2, 2, 2};
    char text[4096];
    int end = box_write(text, sizeof text, r, low, high, 0);
    if (other != NULL) {
        end += box_write(text + end, sizeof text - (size_t)end, r, other[0], other[1], CORNERS);
    }
    return snprintf(path, size, "%s", folder_put(f, "room.obj", text, (size_t)end)) < (int)size;
}

/* Counts pixels on the diagonals of the picture, where the edges of the room are, with less than 0.8 of the light of
 * all four neighbours. */
static int dark_pixels(const image *picture)
{
    int dark = 0;
    for (int i = MARGIN; i < SIDE - MARGIN; ++i) {
        const int columns[2] = {i, SIDE - 1 - i};
        for (int k = 0; k < 2 && (i < SIDE / 2 - MARGIN || i >= SIDE / 2 + MARGIN); ++k) {
            const float *at = picture->pixels + 3 * (i * SIDE + columns[k]);
            dark += at[0] < 0.8f * fminf(fminf(at[-3], at[3]), fminf(at[-3 * SIDE], at[3 * SIDE]));
        }
    }
    return dark;
}

/* Counts pixels with bounced light above 1e-4. The room with the lamp has about 0.1 W/m2sr. */
static int lit_pixels(const image *picture)
{
    int lit = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        lit += !(picture->pixels[3 * i + 1] < 1e-4f);
    }
    return lit;
}

/* Counts dark pixels on the edges of a room with the lamp, or lit pixels of a room without the lamp. */
static int edge_count(const room *r, const double other[2][3], const double lamp[3], const char *how, const char *value)
{
    char path[512], eye[96], target[96], up[96], light[200], verb[] = "render";
    double e[3], t[3], u[3], l[3];
    static render_job j;
    report said = {""};
    folder f;
    int dark = SIDE;
    memset(&j, 0, sizeof j);
    room_place(e, r, 0, 0, 1.9);
    room_place(t, r, 0, 0, -2);
    room_place(l, r, lamp[0], lamp[1], lamp[2]);
    for (int i = 0; i < 3; ++i) {
        u[i] = r->axis[1][i];
    }
    snprintf(eye, sizeof eye, "%.9g,%.9g,%.9g", e[0], e[1], e[2]);
    snprintf(target, sizeof target, "%.9g,%.9g,%.9g", t[0], t[1], t[2]);
    snprintf(up, sizeof up, "%.9g,%.9g,%.9g", u[0], u[1], u[2]);
    snprintf(light, sizeof light, "point:%.9g,%.9g,%.9g:0,-1,0:%g,%g,%g", l[0], l[1], l[2],
             30 * r->scale * r->scale, 30 * r->scale * r->scale, 30 * r->scale * r->scale);
    folder_open(&f);
    if (room_write(path, sizeof path, &f, r, other)) {
        const char *line[] = {verb,     path,    "-o",      "none.pfm", "--size",    "64x64",      "--eye", eye,   "--target",
                              target,   "--up",  up,        "--fov",    "91.7",      "--light",    light,   "--show", other != NULL ? "indirect" : "irradiance",
                              "--world", "none", "--threads", "1",      how,         value,        "--shadow-map", "128"};
        char *words[sizeof line / sizeof *line];
        const int count = COUNT_OF(line) - (r->fine ? 2 : 0);
        for (int i = 0; i < count; ++i) {
            words[i] = (char *)(uintptr_t)line[i];
        }
        const int ok = render_options_parse(&j.o, count, words, &said) && render_job_load(&j, &said) &&
                       render_job_set(&j, &said) && render_draw(&j, &said);
        CHECK_MSG(ok, "%s", said.text);
        dark = ok ? (other != NULL ? lit_pixels : dark_pixels)(&j.linear) : SIDE;
        render_job_free(&j);
    }
    folder_close(&f);
    return dark;
}

void test_room_edges(void)
{
    static const char *const how[][2] = {{"--quality", "default"}, {"--quality", "draft"}, {"--gather", "live"},
                                         {"--occlusion", "none"}, {"--group", "method=zones"},
                                         {"--group", "method=greedy"}};
    static const struct place {
        uint64_t seed;
        double scale, far;
    } places[] = {{0, 1, 0}, {1, 1, 0}, {2, 1, 7}, {3, 10, 100}, {4, 0.01, 0}};
    static const double inside[3] = {0.3, 1.2, 0.1}, outside[3] = {3, 4, -4},
                        above[3] = {-4.2, 2.4, -4.6}, beside[3] = {-4.3, 0.4, 0.2};
    static const double around[2][3] = {{-6, -5, -6}, {6, 6, 6}}, next[2][3] = {{-6, -2, -2}, {-2, 2, 2}};
    for (int i = 0; i < COUNT_OF(places); i += is_long() ? 1 : 2) {
        const room r = room_of(places[i].seed, places[i].scale, places[i].far);
        const int each = i == 0 || test_length() > 1 ? 1 : 3;
        for (int k = is_long() ? i % each : 0; k < (i < 1 || is_long() ? COUNT_OF(how) : 1); k += each) {
            const int dark = edge_count(&r, NULL, inside, how[k][0], how[k][1]);
            /* Fixed groups: discs do not end at the edge. */
            CHECK_MSG(dark <= (k < 4 ? 2 : 12), "place %d, %s %s: %d dark pixels", i, how[k][0], how[k][1], dark);
        }
        /* Only with exact occlusion. */
        for (int k = is_long() ? i % each : 0; k < (is_long() || i == 0 ? 3 : 1); k += each) {
            const int lit = edge_count(&r, around, outside, how[k][0], how[k][1]) +
                            edge_count(&r, around, above, how[k][0], how[k][1]) +
                            edge_count(&r, next, beside, how[k][0], how[k][1]);
            CHECK_MSG(lit == 0, "place %d, %s %s: %d lit pixels of a dark room", i, how[k][0], how[k][1], lit);
        }
    }
}
