/* bench_figures.c: `lambent-bench relight --object`: objects in a world's light, by samples, contact and filters. */
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../relight/relight_draw.h"
#include "bench_subject.h"

static const char *const stages[BENCH_STAGES] = {"world and tables", "objects", NULL};

static const bench_try tries[] = {
    {"default", "", 2, 0},
    {"samples", "--samples 4", 4, 0},
    {"samples", "--samples 16", 12, 0},
    {"contact", "--contact", 5, 0},
    {"contact", "--contact --samples 4", 7, 0},
    {"contact", "--contact --samples 16", 15, 0},
    {"filters", "--contact --samples 4 --filter sh9", 7, 0},
    {"filters", "--contact --samples 4 --filter blur2", 7, 0},
    {"parts", "--contact --samples 4 --per-part", 7, 0},
    {"storage", "--contact --samples 4 --storage log16", 7, 0},
};

#define EXACT "--contact --samples 16"

typedef struct scene {
    const bench_line *line;
    relight_options o;
    relight_light light;
    image picture;
} scene;

static int parse(relight_options *o, const bench_line *line, report *r)
{
    char *argv[BENCH_ARGS];
    memcpy(argv, line->argv, sizeof argv);
    if (relight_options_parse(o, line->argc, argv, r) != OPTIONS_RUN) {
        return 0;
    }
    o->view.is_quiet = 1;
    return 1;
}

static int draw_once(void *user, double stage_s[BENCH_STAGES], report *r)
{
    scene *s = user;
    lmb_vec3 middle;
    relight_light_free(&s->light);
    image_free(&s->picture);
    memset(&s->light, 0, sizeof s->light);
    const double start = host_cpu_seconds();
    if (!parse(&s->o, s->line, r) || !relight_light_make(&s->light, &s->o, r)) {
        return 0;
    }
    const double made = host_cpu_seconds();
    s->o.into = &s->picture;
    const int ok = relight_draw(&middle, &s->light, &s->o, r);
    stage_s[0] = made - start;
    stage_s[1] = host_cpu_seconds() - made;
    return ok;
}

static int check(const bench_line *line, report *r)
{
    static relight_options o;
    return parse(&o, line, r);
}

static int draw(bench_shot *out, const bench_line *line, const bench_way *way, report *r)
{
    scene *s = calloc(1, sizeof *s);
    memset(out, 0, sizeof *out);
    if (s == NULL) {
        return report_fail(r, "out of memory");
    }
    s->line = line;
    const int ok = bench_repeat(out, way, draw_once, s, r);
    if (ok) {
        out->picture = s->picture;
        memset(&s->picture, 0, sizeof s->picture);
        out->bytes = (double)lmb_world_bytes(&s->o.place, s->o.format);
        out->threads = 1;
    }
    image_free(&s->picture);
    relight_light_free(&s->light);
    free(s);
    return ok;
}

static int draw_truth(bench_shot *out, const bench_line *line, report *r)
{
    static const bench_way way = {0, 1};
    bench_line all;
    return bench_line_with(&all, line, EXACT, r) && draw(out, &all, &way, r);
}

const bench_subject bench_figures = {
    .verb = "relight",
    .size = "--size %dx%d",
    .usual_size = "--threads 1",
    .output = "-o picture.pfm",
    .table = &relight_table,
    .refused = " --cube --map --path -o --exposure --tone --show ",
    .stages = stages,
    .tries = tries,
    .try_count = sizeof tries / sizeof *tries,
    .backends = 1,
    .truth_is = "its own finest settings, " EXACT,
    .usage = "relight --world WORLD --object FILE [options of lambent relight] [options]",
    .about = "Measures speed against error of objects in the light of a world: by samples per pixel, with occlusion "
             "of each other and of the ground (--contact), by filter and storage; for lights with a size, roughness "
             "and places, add options of lambent relight. The truth is your picture or the finest settings: contact "
             "and 16 samples. Time includes reading the files; memory is the world's.",
    .examples = "  lambent-bench relight --world demo --object demo --size 80x60 --runs 1 --sweep samples=1,4\n",
    .check = check,
    .draw = draw,
    .truth = draw_truth,
};
