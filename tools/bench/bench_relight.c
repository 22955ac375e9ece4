/* bench_relight.c: `lambent-bench relight`: a place's irradiance by each filter. */
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../relight/relight_light.h"
#include "bench_subject.h"

static const char *const stages[BENCH_STAGES] = {"seeing the world", "filter", NULL};

static const bench_try tries[] = {
    {"filters", "", 1, 0},
    {"filters", "--filter sh9", 1, 0},
    {"filters", "--filter sh16", 1, 0},
    {"filters", "--filter sh25", 1, 0},
    {"filters", "--filter blur", 1, 0},
    {"filters", "--filter blur1", 1, 0},
    {"filters", "--filter blur2", 1, 0},
    {"storage", "--storage log16", 1, 0},
    {"storage", "--storage log8", 1, 0},
    {"storage", "--filter sh9 --storage log16", 1, 0},
    {"overlap", "--overlap mean", 1, 0},
    {"faces", "--faces 16", 1, BENCH_OTHER},
    {"faces", "--faces 32", 1, BENCH_OTHER},
};

typedef struct place {
    relight_options o;
    relight_light light;
} place;

static int parse(place *p, const bench_line *line, report *r)
{
    char *argv[BENCH_ARGS];
    memcpy(argv, line->argv, sizeof argv);
    return relight_options_parse(&p->o, line->argc, argv, r) == OPTIONS_RUN &&
           (p->o.worlds == 1 || report_fail(r, "--world: a sweep is of one world"));
}

static int see_once(void *user, double stage_s[BENCH_STAGES], report *r)
{
    place *p = user;
    relight_light *l = &p->light;
    const double start = host_cpu_seconds();
    if (lmb_probe_remap(l->map, p->o.kernels, l->world, &l->table[0], p->o.at[0], p->o.blend) != LMB_OK) {
        return report_fail(r, "--at: numbers over 1,000,000 m");
    }
    const double seen = host_cpu_seconds();
    const int ok = relight_light_filter(l, &p->o, p->o.faces);
    stage_s[0] = seen - start;
    stage_s[1] = host_cpu_seconds() - seen;
    return ok || report_fail(r, "--filter: no memory for it");
}

/* Planes as a picture, six faces from the top. */
static int keep(bench_shot *out, const place *p, report *r)
{
    const int32_t n = p->o.faces;
    const size_t texels = 6 * (size_t)n * (size_t)n;
    out->picture.pixels = malloc(3 * texels * sizeof *out->picture.pixels);
    out->picture.width = n;
    out->picture.height = 6 * n;
    out->picture.channels = 3;
    for (size_t i = 0; out->picture.pixels != NULL && i < 3 * texels; ++i) {
        out->picture.pixels[i] = p->light.cube[i % 3 * texels + i / 3];
    }
    out->bytes = (double)lmb_world_bytes(&p->o.place, p->o.format) + (double)sizeof p->light +
                 (double)lmb_probe_table_bytes(RELIGHT_WIDTH, RELIGHT_HEIGHT);
    out->threads = 1;
    return out->picture.pixels != NULL || report_fail(r, "out of memory");
}

static int run(bench_shot *out, const bench_line *line, const bench_way *way, int (*then)(place *p), report *r)
{
    place *p = calloc(1, sizeof *p);
    memset(out, 0, sizeof *out);
    int ok = p != NULL ? parse(p, line, r) : report_fail(r, "out of memory");
    ok = ok && relight_light_make(&p->light, &p->o, r) && bench_repeat(out, way, see_once, p, r) &&
         (then == NULL || then(p)) && keep(out, p, r);
    if (p != NULL) {
        relight_light_free(&p->light);
        free(p);
    }
    return ok;
}

static int check(const bench_line *line, report *r)
{
    place *p = calloc(1, sizeof *p);
    const int ok = p != NULL ? parse(p, line, r) : report_fail(r, "out of memory");
    free(p);
    return ok;
}

static int draw(bench_shot *out, const bench_line *line, const bench_way *way, report *r)
{
    return run(out, line, way, NULL, r);
}

/* The direction of texel x, y of a cube's face, as in lambent/probe.h, not normalized. */
static void texel_direction(double d[3], int face, double s, double t)
{
    const double all[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    memcpy(d, all[face], sizeof all[face]);
}

/* Sums all directions of the map, weighted by cosine and solid angle; pi for a world of uniform radiance. */
static void add_all(double sum[3], const relight_light *l, const double d[3])
{
    const lmb_probe_table *t = &l->table[0];
    const size_t n = (size_t)t->width * (size_t)t->height;
    double whole = 0.0, light[3] = {0, 0, 0};
    for (size_t i = 0; i < n; ++i) {
        double cosine = 0.0; /* times the length of d, as in the sum of weights */
        for (size_t c = 0; c < 3; ++c) {
            cosine += ((double)t->direction[c * n + i] * (2.0 / 65535.0) - 1.0) * d[c];
        }
        const double weight = cosine > 0.0 ? cosine * (double)t->area[i / (size_t)t->width] : 0.0;
        whole += weight;
        for (size_t c = 0; c < 3; ++c) {
            light[c] += weight * (double)l->map[c * n + i];
        }
    }
    for (int c = 0; c < 3; ++c) {
        sum[c] = light[c] / whole * 3.14159265358979323846;
    }
}

static int sum_exactly(place *p)
{
    const int32_t n = p->o.faces;
    const size_t texels = 6 * (size_t)n * (size_t)n;
    for (int32_t i = 0; i < (int32_t)texels; ++i) {
        const int32_t x = i % n, y = i / n % n;
        double d[3], sum[3];
        texel_direction(d, i / (n * n), (2.0 * x + 1.0) / n - 1.0, (2.0 * y + 1.0) / n - 1.0);
        add_all(sum, &p->light, d);
        for (int c = 0; c < 3; ++c) {
            p->light.cube[(size_t)c * texels + (size_t)i] = (float)sum[c];
        }
    }
    return 1;
}

static int draw_truth(bench_shot *out, const bench_line *line, report *r)
{
    static const bench_way way = {0, 1};
    return run(out, line, &way, sum_exactly, r);
}

const bench_subject bench_relight = {
    .verb = "relight",
    .size = "--faces %d",
    .output = "--cube light.pfm",
    .table = &relight_table,
    .refused = " --cube --map --path ",
    .stages = stages,
    .tries = tries,
    .try_count = sizeof tries / sizeof *tries,
    .backends = 1,
    .truth_is = "all 128 x 64 directions by their exact cosines; pictures are the cube's faces, +x -x +y -y +z -z",
    .usage = "relight --world WORLD [options of lambent relight] [options]",
    .about = "Measures speed against error of the light at a place of a world: seen from there (128 x 64 "
             "directions) and filtered to an irradiance cube by exact cosines, 9, 16 and 25 harmonics, and the "
             "blurs. The truth is a cube like that of lambent relight --cube, or else every one of those directions "
             "by its exact cosine, so that only the filters have errors. A picture is the cube's six faces, +x -x "
             "+y -y +z -z from the top. With --object FILE the sweep is of a picture of objects in that light: see "
             "lambent-bench relight --object FILE --help.",
    .examples = "  lambent-bench relight --world demo --runs 1 --sweep filter=cosine,sh9\n",
    .check = check,
    .draw = draw,
    .truth = draw_truth,
};
