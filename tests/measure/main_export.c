/* main_export.c: checks the files that `lambent relight` exports for other programs against sums over all
 * pixels of the world's picture.
 *
 *     measure-export FOLDER MAP|made:N
 *
 * MAP is a sphere's picture, twice as wide as high; made:1 .. made:4 are worlds that this program makes: small lamps,
 * checks, a bright horizon, a sun of one pixel. The files are written to FOLDER. Figures are the relative RMSE, the
 * largest error in brackets as a share of the mean of the right values, and for cube and panorama the sum of all light
 * over the right sum:
 *
 *   the first cube of --lobes, against the mean of the picture over each texel; the others at some of their texels
 *   irradiance of 6 x 8 x 8 normals by --cube, and by the sum of --harmonics
 *   --map of the picture's own height, against the picture
 *   the table of --dfg, against a sum over 1024 x 1024 half vectors */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/picture.h"
#include "../../tools/picture/picture_read.h"
#include "../../tools/relight/verb_relight.h"
#include "../pfm_file.h"

#define PI 3.141592653589793

int test_passed, test_failed, test_skipped;

enum { LEVELS = 6, SAMPLES = 300, DFG = 128, STEPS = 1024, ACROSS = 24 /* samples of a texel each way */ };
enum { MADE_HIGH = 256, MADE_WIDE = 512 };

typedef struct vec {
    double x, y, z;
} vec;

static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static vec unit(vec a)
{
    const double per = 1.0 / sqrt(dot(a, a));
    return (vec){a.x * per, a.y * per, a.z * per};
}

static vec texel(int32_t n, int32_t i)
{
    const double s = (2 * (i % n) + 1.0) / n - 1.0, t = (2 * (i / n % n) + 1.0) / n - 1.0;
    const vec to[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return unit(to[i / (n * n)]);
}

/* Weight of light from a direction with this cosine to the normal. */
static double lobe_weight(double cosine, double alpha)
{
    const double a2 = alpha * alpha, nh2 = 0.5 * (1.0 + cosine), d = nh2 * (a2 - 1.0) + 1.0;
    return alpha < 0.0 ? cosine : cosine / (d * d * (cosine + sqrt(cosine * cosine * (1.0 - a2) + a2)));
}

/* Irradiance if alpha < 0, else the mean over a lobe. */
static void gather(double out[3], const image *map, vec n, double alpha)
{
    double all = 0.0;
    out[0] = out[1] = out[2] = 0.0;
    for (int32_t y = 0; y < map->height; ++y) {
        const double north = PI * (y + 0.5) / map->height, round = sin(north), area = round * 2.0 * PI * PI / map->height / map->width;
        for (int32_t x = 0; x < map->width; ++x) {
            const double a = 2.0 * PI * (x + 0.5) / map->width - PI;
            const double cosine = dot(n, (vec){round * sin(a), cos(north), -round * cos(a)});
            const double w = cosine > 0.0 ? area * lobe_weight(cosine, alpha) : 0.0;
            all += w;
            for (int c = 0; c < 3 && w > 0.0; ++c) {
                out[c] += w * (double)map->pixels[3 * ((size_t)y * (size_t)map->width + (size_t)x) + (size_t)c];
            }
        }
    }
    for (int c = 0; c < 3 && alpha >= 0.0; ++c) {
        out[c] /= all;
    }
}

typedef struct sums {
    double apart, all, sum, worst;
    double light[2]; /* all of it, got and wanted, by solid angle */
    int count;
} sums;

static void add(sums *s, double got, double want)
{
    s->apart += (got - want) * (got - want);
    s->all += want * want;
    s->sum += want;
    s->worst = fmax(s->worst, fabs(got - want));
    ++s->count;
}

static void add_light(sums *s, double got, double want, double angle)
{
    s->light[0] += angle * got;
    s->light[1] += angle * want;
}

/* Prints the relative RMSE and the largest error over the mean. */
static void print(const char *what, const sums *s)
{
    printf("%s %.2f %% (%.3g)", what, 100.0 * sqrt(s->apart / (s->all > 0.0 ? s->all : 1.0)),
           100.0 * s->worst * s->count / (s->sum > 0.0 ? s->sum : 1.0));
    if (s->light[1] > 0.0) {
        printf(", all light %.2f %%", 100.0 * s->light[0] / s->light[1]);
    }
    printf("\n");
}

/* The mean of the picture over a cube's texel, by samples of the pixels that contain them. */
static void mean_over(double out[3], const image *map, int32_t n, int32_t i)
{
    double all = 0.0;
    out[0] = out[1] = out[2] = 0.0;
    for (int32_t k = 0; k < ACROSS * ACROSS; ++k) {
        const double s = (2 * (i % n) + (2 * (k % ACROSS) + 1.0) / ACROSS) / n - 1.0,
                     t = (2 * (i / n % n) + (2 * (k / ACROSS) + 1.0) / ACROSS) / n - 1.0, w = pow(1.0 + s * s + t * t, -1.5);
        const vec to[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}}, d = unit(to[i / (n * n)]);
        const int32_t x = (int32_t)((0.5 + atan2(d.x, -d.z) / (2.0 * PI)) * map->width) % map->width,
                      y = (int32_t)fmin(acos(d.y) / PI * map->height, map->height - 1.0);
        all += w;
        for (size_t c = 0; c < 3; ++c) {
            out[c] += w * (double)map->pixels[3 * ((size_t)y * (size_t)map->width + (size_t)x) + c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        out[c] /= all;
    }
}

static int lobes(const char *folder, const image *map)
{
    for (int i = 0; i < LEVELS; ++i) {
        char name[1024];
        image cube;
        sums s;
        memset(&s, 0, sizeof s);
        snprintf(name, sizeof name, "%s/lobe_%d.pfm", folder, i);
        if (!pfm_file(&cube, name)) {
            return 0;
        }
        const double roughness = i / (LEVELS - 1.0), alpha = fmax(roughness * roughness, 1e-3);
        const int32_t n = cube.width, texels = 6 * n * n;
        const int32_t samples = i > 0 && texels > SAMPLES ? SAMPLES : texels; /* the first cube costs little */
        for (int32_t k = 0; k < samples; ++k) {
            const int32_t at = (int32_t)((int64_t)k * texels / samples);
            double want[3];
            if (i > 0) {
                gather(want, map, texel(n, at), alpha);
            } else {
                mean_over(want, map, n, at);
            }
            const double s0 = (2 * (at % n) + 1.0) / n - 1.0, t0 = (2 * (at / n % n) + 1.0) / n - 1.0;
            for (int c = 0; c < 3; ++c) {
                const double got = (double)cube.pixels[3 * (size_t)at + (size_t)c];
                add(&s, got, want[c]);
                add_light(&s, got, want[c], i > 0 ? 0.0 : pow(1.0 + s0 * s0 + t0 * t0, -1.5));
            }
        }
        snprintf(name, sizeof name, i > 0 ? "lobe of roughness %.1f" : "cube: lobe of roughness %.0f", roughness);
        print(name, &s);
        image_free(&cube);
    }
    return 1;
}

static int read_harmonics(double out[9][3], const char *name)
{
    report r = {""};
    file_bytes file;
    if (!file_read(&file, name, &r)) {
        return 0;
    }
    const char *at = strstr((const char *)file.data, "\"irradiance\"");
    int count = 0;
    for (; at != NULL && count < 27; ++at) {
        char *end;
        const double v = strtod(at, &end);
        if (end != at && *at != ' ' && *at != '\n') {
            out[count / 3][count % 3] = v;
            ++count;
            at = end - 1;
        }
    }
    file_free(&file);
    return count == 27;
}

static int irradiance(const char *folder, const image *map)
{
    char name[1024];
    image cube;
    double j[9][3];
    sums by_cube, by_harmonics;
    memset(&by_cube, 0, sizeof by_cube);
    memset(&by_harmonics, 0, sizeof by_harmonics);
    snprintf(name, sizeof name, "%s/harmonics.json", folder);
    if (!read_harmonics(j, name)) {
        return 0;
    }
    snprintf(name, sizeof name, "%s/cube.pfm", folder);
    if (!pfm_file(&cube, name)) {
        return 0;
    }
    for (int32_t i = 0; i < 6 * 8 * 8; ++i) {
        const vec n = texel(8, i);
        const double b[9] = {0.282095, 0.488603 * n.y, 0.488603 * n.z, 0.488603 * n.x, 1.092548 * n.x * n.y, 1.092548 * n.y * n.z,
                             0.315392 * (3.0 * n.z * n.z - 1.0), 1.092548 * n.x * n.z, 0.546274 * (n.x * n.x - n.y * n.y)};
        double want[3];
        gather(want, map, n, -1.0);
        for (int c = 0; c < 3; ++c) {
            double sum = 0.0;
            for (int k = 0; k < 9; ++k) {
                sum += j[k][c] * b[k];
            }
            add(&by_cube, (double)cube.pixels[3 * (size_t)i + (size_t)c], want[c]);
            add(&by_harmonics, sum, want[c]);
        }
    }
    print("irradiance by cube", &by_cube);
    print("irradiance by 9 harmonics", &by_harmonics);
    image_free(&cube);
    return 1;
}

/* Reads a file that relight wrote, and begins its sums. */
static int begin(image *out, sums *s, const char *folder, const char *file)
{
    char name[1024];
    memset(s, 0, sizeof *s);
    snprintf(name, sizeof name, "%s/%s", folder, file);
    return pfm_file(out, name);
}

/* The picture against the map of its height, which comes from a cube. */
static int back(const char *folder, const image *map)
{
    image got;
    sums s;
    if (!begin(&got, &s, folder, "back.pfm")) {
        return 0;
    }
    for (size_t i = 0; i < 3 * (size_t)map->width * (size_t)map->height && got.width == map->width; ++i) {
        const double north = PI * ((double)(i / 3 / (size_t)map->width) + 0.5) / map->height;
        add(&s, (double)got.pixels[i], (double)map->pixels[i]);
        add_light(&s, (double)got.pixels[i], (double)map->pixels[i], sin(north));
    }
    print("panorama to a cube and back", &s);
    image_free(&got);
    return 1;
}

/* The lobe's reflection of white light as a sum over half vectors, spread as the lobe: F0 is 1 for [0] and 0 for [1]. */
static void reflect_white(double out[2], double facing, double alpha)
{
    const double a2 = alpha * alpha;
    const vec v = {sqrt(1.0 - facing * facing), 0.0, facing};
    double one = 0.0, grazing = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        /* More half vectors in the lobe's tail, because light that grazes comes from there. */
        const double rest = 1.0 - (i + 0.5) / STEPS, tail = rest * rest * rest, weight = 3.0 * rest * rest;
        const double hz = 1.0 / sqrt(1.0 + a2 * (1.0 - tail) / tail), round = sqrt(1.0 - hz * hz);
        for (int k = 0; k < STEPS; ++k) {
            const double turn = 2.0 * PI * (k + 0.5) / STEPS;
            const vec h = {round * cos(turn), round * sin(turn), hz};
            const double vh = dot(v, h), z = 2.0 * vh * hz - facing; /* of the light's direction */
            if (z <= 0.0 || vh <= 0.0) {
                continue;
            }
            const double smith = z * sqrt(facing * facing * (1.0 - a2) + a2) + facing * sqrt(z * z * (1.0 - a2) + a2);
            const double f = 2.0 * vh * z / (smith * hz), fresnel = pow(1.0 - vh, 5.0);
            one += weight * f * (1.0 - fresnel);
            grazing += weight * f * fresnel;
        }
    }
    out[0] = one / STEPS / STEPS;
    out[1] = grazing / STEPS / STEPS;
}

static int table(const char *folder)
{
    image dfg;
    sums s;
    if (!begin(&dfg, &s, folder, "dfg.pfm")) {
        return 0;
    }
    for (int32_t i = 0; i < 100; ++i) { /* from the edges of the table on */
        const int32_t x = 127 * (i % 10) / 9, y = 127 * (i / 10) / 9;
        const double roughness = (y + 0.5) / DFG;
        double want[2];
        reflect_white(want, (x + 0.5) / DFG, roughness * roughness);
        for (int c = 0; c < 2; ++c) {
            add(&s, (double)dfg.pixels[3 * (y * DFG + x) + c], want[c]);
        }
    }
    print("table of lobes", &s);
    image_free(&dfg);
    return 1;
}

/* --- worlds of our own -------------------------------------------------------------------------------------------- */

static double drawn(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 40) / 16777216.0;
}

static void set(float *pixels, int32_t x, int32_t y, double r, double g, double b)
{
    float *p = pixels + 3 * ((size_t)y * MADE_WIDE + (size_t)(x % MADE_WIDE));
    p[0] = (float)r;
    p[1] = (float)g;
    p[2] = (float)b;
}

static void make_world(float *pixels, int which)
{
    uint64_t state = 7;
    for (int32_t i = 0; i < MADE_WIDE * MADE_HIGH; ++i) {
        const int32_t x = i % MADE_WIDE, y = i / MADE_WIDE;
        const double up = 1.0 - (double)y / MADE_HIGH, band = exp(-0.5 * pow((y - 124.0) / 2.5, 2.0));
        const int is_bright = (x / 32 + y / 32) % 2;
        set(pixels, x, y, which == 2 ? (is_bright ? 5.0 : 0.05) : 0.2 + 0.3 * up + (which == 3 ? 40.0 * band : 0.0),
            which == 2 ? (is_bright ? 3.0 : 0.1) : 0.3 + 0.3 * up + (which == 3 ? 25.0 * band : 0.0),
            which == 2 ? (is_bright ? 1.0 : 0.3) : 0.3 + 0.7 * up + (which == 3 ? 10.0 * band : 0.0));
    }
    for (int k = 0; k < 12 && which == 1; ++k) { /* lamps of 1 to 4 pixels a side */
        const int32_t x0 = (int32_t)(drawn(&state) * MADE_WIDE), y0 = (int32_t)(drawn(&state) * 240.0), side = 1 + k % 4;
        const double light = 100.0 * pow(100.0, drawn(&state)), red = drawn(&state);
        for (int32_t i = 0; i < side * side; ++i) {
            set(pixels, x0 + i % side, y0 + i / side, light, light * (1.0 - 0.5 * red), light * (1.0 - red));
        }
    }
    if (which == 4) {
        set(pixels, 133, 71, 1e5, 9e4, 7e4);
    }
}

/* Writes a world of our own to `path`. */
static int write_made(const char *path, int which)
{
    report r = {""};
    const image p = {MADE_WIDE, MADE_HIGH, 3, malloc(3 * sizeof(float) * MADE_WIDE * MADE_HIGH)};
    if (p.pixels == NULL) {
        return 0;
    }
    make_world(p.pixels, which);
    const int ok = picture_write(path, &p, 0.0f, PICTURE_CLIPPED, &r);
    free(p.pixels);
    return ok;
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

int main(int argc, char **argv)
{
    stored_picture map;
    report r = {""};
    file_bytes file;
    char lobe[1024], harmonics[1024], cube[1024], dfg[1024], from_cube[1024], made[1024], high[16];
    const int which = argc == 3 && strncmp(argv[2], "made:", 5) == 0 ? atoi(argv[2] + 5) : 0;
    if (argc != 3) {
        return 2;
    }
    snprintf(made, sizeof made, "%s/made_%d.pfm", argv[1], which);
    char *const path = which > 0 ? made : argv[2];
    if ((which > 0 && !write_made(made, which)) || !file_read(&file, path, &r)) {
        return 2;
    }
    const int is_read = picture_read(&map, file.data, file.size, path, &r);
    file_free(&file);
    snprintf(lobe, sizeof lobe, "%s/lobe_%%01d.pfm", argv[1]);
    snprintf(harmonics, sizeof harmonics, "%s/harmonics.json", argv[1]);
    snprintf(cube, sizeof cube, "%s/cube.pfm", argv[1]);
    snprintf(dfg, sizeof dfg, "%s/dfg.pfm", argv[1]);
    snprintf(from_cube, sizeof from_cube, "%s/back.pfm", argv[1]);
    snprintf(high, sizeof high, "%d", is_read ? (int)map.light.height : 8);
    char *relight[] = {"relight", "--world", path, "--at", "0,0,0", "--lobes", lobe, "--harmonics", harmonics, "--cube", cube,
                       "--dfg", dfg, "--map", from_cube, "--map-height", high, "-q"};
    if (!is_read || map.light.pixels == NULL || verb_relight((int)(sizeof relight / sizeof *relight), relight) != 0) {
        return 1;
    }
    printf("%s\n", argv[2]);
    const int ok = lobes(argv[1], &map.light) && irradiance(argv[1], &map.light) &&
                   back(argv[1], &map.light) && table(argv[1]);
    stored_picture_free(&map);
    return ok ? 0 : 1;
}
