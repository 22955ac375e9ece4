/* main_export.c: checks the files that `lambent relight` exports for other programs against sums over all
 * pixels of the world's picture.
 *
 *     measure-export FOLDER MAP
 *
 * MAP is a sphere's picture, twice as wide as high; the files are written to FOLDER. Figures are relative RMSE: each
 * cube of --lobes at some of its texels; irradiance of 6 x 8 x 8 normals by --cube and by the sum of --harmonics; the
 * table of --dfg against a plain sum of 1024 x 1024 directions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/picture_read.h"
#include "../../tools/relight/verb_relight.h"
#include "../pfm_file.h"

#define PI 3.141592653589793

int test_passed, test_failed, test_skipped;

enum { LEVELS = 6, SAMPLES = 300, DFG = 128, STEPS = 1024 };

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
    double apart, all;
} sums;

static void add(sums *s, double got, double want)
{
    s->apart += (got - want) * (got - want);
    s->all += want * want;
}

static double share(const sums *s) { return 100.0 * sqrt(s->apart / (s->all > 0.0 ? s->all : 1.0)); }

static int lobes(const char *folder, const image *map)
{
    printf("lobes of roughness");
    for (int i = 0; i < LEVELS; ++i) {
        char name[1024];
        image cube;
        sums s = {0.0, 0.0};
        snprintf(name, sizeof name, "%s/lobe_%d.pfm", folder, i);
        if (!pfm_file(&cube, name)) {
            return 0;
        }
        const double roughness = i / (LEVELS - 1.0), alpha = fmax(roughness * roughness, 1e-3);
        const int32_t n = cube.width, texels = 6 * n * n;
        for (int32_t k = 0; i > 0 && k < SAMPLES; ++k) {
            const int32_t at = (int32_t)((int64_t)k * texels / SAMPLES);
            double want[3];
            gather(want, map, texel(n, at), alpha);
            for (int c = 0; c < 3; ++c) {
                add(&s, (double)cube.pixels[3 * (size_t)at + (size_t)c], want[c]);
            }
        }
        if (i > 0) {
            printf("  %.1f: %.2f %%", roughness, share(&s));
        }
        image_free(&cube);
    }
    printf("\n");
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
    sums by_cube = {0.0, 0.0}, by_harmonics = {0.0, 0.0};
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
    printf("irradiance by cube %.2f %%, by harmonics %.2f %%\n", share(&by_cube), share(&by_harmonics));
    image_free(&cube);
    return 1;
}

/* The lobe's reflection of white light as a sum over directions: F0 is 1 for [0] and 0 for [1]. */
static void reflect_white(double out[2], double facing, double alpha)
{
    const double a2 = alpha * alpha;
    const vec v = {sqrt(1.0 - facing * facing), 0.0, facing};
    double one = 0.0, grazing = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        const double z = (i + 0.5) / STEPS, round = sqrt(1.0 - z * z);
        for (int k = 0; k < STEPS; ++k) {
            const double turn = 2.0 * PI * (k + 0.5) / STEPS;
            const vec l = {round * cos(turn), round * sin(turn), z}, h = unit((vec){l.x + v.x, l.y + v.y, l.z + v.z});
            const double d = h.z * h.z * (a2 - 1.0) + 1.0, smith = z * sqrt(facing * facing * (1.0 - a2) + a2) + facing * sqrt(z * z * (1.0 - a2) + a2);
            const double f = a2 / (PI * d * d) * 0.5 / smith * z, fresnel = pow(1.0 - dot(v, h), 5.0);
            one += f * (1.0 - fresnel);
            grazing += f * fresnel;
        }
    }
    out[0] = one * 2.0 * PI / STEPS / STEPS;
    out[1] = grazing * 2.0 * PI / STEPS / STEPS;
}

static int table(const char *folder)
{
    char name[1024];
    image dfg;
    sums s = {0.0, 0.0};
    snprintf(name, sizeof name, "%s/dfg.pfm", folder);
    if (!pfm_file(&dfg, name)) {
        return 0;
    }
    for (int32_t i = 0; i < 100; ++i) { /* from roughness 0.4 on, a plain sum is exact */
        const int32_t x = 12 * (i % 10) + 5, y = DFG * 4 / 10 + 7 * (i / 10);
        const double roughness = (y + 0.5) / DFG;
        double want[2];
        reflect_white(want, (x + 0.5) / DFG, roughness * roughness);
        for (int c = 0; c < 2; ++c) {
            add(&s, (double)dfg.pixels[3 * (y * DFG + x) + c], want[c]);
        }
    }
    printf("table of lobes %.2f %%\n", share(&s));
    image_free(&dfg);
    return 1;
}

int main(int argc, char **argv)
{
    stored_picture map;
    report r = {""};
    file_bytes file;
    char lobe[1024], harmonics[1024], cube[1024], dfg[1024];
    if (argc != 3 || !file_read(&file, argv[2], &r)) {
        return 2;
    }
    const int is_read = picture_read(&map, file.data, file.size, argv[2], &r);
    file_free(&file);
    snprintf(lobe, sizeof lobe, "%s/lobe_%%01d.pfm", argv[1]);
    snprintf(harmonics, sizeof harmonics, "%s/harmonics.json", argv[1]);
    snprintf(cube, sizeof cube, "%s/cube.pfm", argv[1]);
    snprintf(dfg, sizeof dfg, "%s/dfg.pfm", argv[1]);
    char *relight[] = {"relight", "--world", argv[2], "--at", "0,0,0", "--lobes", lobe, "--harmonics", harmonics, "--cube", cube,
                       "--dfg", dfg, "-q"};
    if (!is_read || map.light.pixels == NULL || verb_relight((int)(sizeof relight / sizeof *relight), relight) != 0) {
        return 1;
    }
    printf("%s\n", argv[2]);
    const int ok = lobes(argv[1], &map.light) && irradiance(argv[1], &map.light) && table(argv[1]);
    stored_picture_free(&map);
    return ok ? 0 : 1;
}
