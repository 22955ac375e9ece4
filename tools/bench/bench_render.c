/* bench_render.c: `lambent-bench SCENE`: pictures with all options of `lambent render`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../model/scene_hash.h"
#include "../render/render_draw.h"
#include "bench_subject.h"

static const char *const stages[BENCH_STAGES] = {"shadow maps", "BVH",  "first points", "groups",
                                                 "bounces",     "view", "samples",      "pixels", NULL};

static const bench_try tries[] = {
    {"presets", "", 4, 0},
    {"presets", "--quality draft", 1, 0},
    {"draft and", "--quality draft --gather full", 1, 0},
    {"presets", "--quality best", 24, 0},
    {"first points", "--tree 64 --shadow-map 512", 3, 0},
    {"first points", "--tree 128", 3, 0},
    {"first points", "--tree 512", 6, 0},
    {"first points", "--tree 1024", 11, 0},
    {"shadow map", "--shadow-map 256", 4, 0},
    {"shadow map", "--shadow-map 2048", 5, 0},
    {"error", "--error 0.005", 5, 0},
    {"error", "--error 0.01", 5, 0},
    {"error", "--error 0.05", 4, 0},
    {"error", "--error 0.1", 4, 0},
    {"visibility", "--visibility 0.005", 6, 0},
    {"visibility", "--visibility 0.03", 3, 0},
    {"visibility", "--visibility 0.1", 2, 0},
    {"occlusion", "--occlusion none", 1, 0},
    {"gather", "--gather live", 1, 0},
    {"draft and", "--quality draft --gather full --error 0.2 --visibility 0.2", 1, 0},
    {"draft and", "--quality draft --gather full --tree 64 --shadow-map 512", 1, 0},
    {"best and", "--quality best --tree 512", 15, 0},
    {"fixed groups", "--group method=zones,groups=64", 4, 0},
    {"fixed groups", "--group method=zones", 2, 0},
    {"fixed groups", "--group method=zones --occlusion none", 1, 0},
    {"fixed groups", "--group method=greedy", 4, 0},
    {"bounces", "--bounces 2", 30, BENCH_OTHER},
    {"bounces", "--bounces 6", 77, BENCH_OTHER},
    {"threads", "--threads 2", 4, BENCH_SAME},
};

/* Grouping comes before occlusion: nodes that --error divides keep the visibility of the larger node, so the first step
 * measures only the light, and the next one only occlusion. Smaller numbers change the Cornell box's median error by at
 * most 0.0005 and take half as long again. */
static const bench_exact exact[] = {
    {"interpolation", "--gather full", "--gather"},
    {"grouping", "--group method=cut --error 0.001", NULL},
    {"occlusion", "--group method=cut --occlusion exact --visibility 0.004", NULL},
    {"shadow map, first points", "--shadow-map 1024 --tree 1024", NULL},
};

#define EXACT \
    "--gather full --group method=cut --occlusion exact --error 0.001 --visibility 0.004 --shadow-map 1024 --tree 1024"

/* --- a picture ---------------------------------------------------------------------------------------------------- */

static int parse(render_job *j, const bench_line *line, report *r)
{
    char *argv[BENCH_ARGS];
    memcpy(argv, line->argv, sizeof argv);
    if (render_options_parse(&j->o, line->argc, argv, r) != OPTIONS_RUN) {
        return 0;
    }
    j->o.view.is_quiet = 1;
    return j->o.show <= LMB_SHOW_IRRADIANCE || report_fail(r, "--show: a sweep compares light: full, direct, indirect "
                                                              "or irradiance");
}

static int draw_once(void *user, double stage_s[BENCH_STAGES], report *r)
{
    render_job *j = user;
    memset(&j->stats, 0, sizeof j->stats);
    j->lit = 0;
    if (!render_draw(j, r)) {
        return 0;
    }
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        stage_s[i] = j->workers.stage_s[i];
    }
    return 1;
}

/* Marks the pixels that show a surface. */
static int find_surface(float **out, const render_job *j, report *r)
{
    const lmb_surface *eye = &j->frame.eye.depth;
    const size_t n = (size_t)eye->width * (size_t)eye->height;
    float *depth = malloc(n * sizeof *depth);
    *out = calloc(n, 3 * sizeof **out);
    const int ok = depth != NULL && *out != NULL && lmb_depth_linearize(depth, n * sizeof *depth, eye) == LMB_OK;
    for (size_t i = 0; ok && i < n; ++i) {
        (*out)[3 * i + 2] = depth[i] > 0.0f ? 1.0f : 0.0f;
    }
    free(depth);
    return ok || report_fail(r, "not enough memory for %.0f pixels", (double)n);
}

static void keep(bench_shot *out, render_job *j)
{
    out->picture = j->linear;
    j->linear.pixels = NULL;
    out->bytes = (double)(j->bytes + j->many_lights.bytes);
    out->work = (double)(j->stats.pairs + j->stats.segments);
    out->threads = j->workers.threads;
}

static int check(const bench_line *line, report *r)
{
    static render_job j; /* only for the options */
    memset(&j, 0, sizeof j);
    return parse(&j, line, r);
}

static int draw(bench_shot *out, const bench_line *line, const bench_way *way, report *r)
{
    render_job *j = calloc(1, sizeof *j);
    memset(out, 0, sizeof *out);
    int ok = j != NULL ? parse(j, line, r) : report_fail(r, "out of memory");
    ok = ok && render_job_load(j, r) && render_job_set(j, r);
    if (ok) {
        j->workers.clock = j->workers.threads == 1 ? host_cpu_seconds : NULL;
        j->workers.every = way->every;
    }
    ok = ok && bench_repeat(out, way, draw_once, j, r) && find_surface(&out->surface, j, r);
    if (ok) {
        keep(out, j);
    } else {
        bench_shot_free(out);
    }
    if (j != NULL) {
        render_job_free(j);
        free(j);
    }
    return ok;
}

/* --- the truth ---------------------------------------------------------------------------------------------------- */

/* Draws the given settings, made exact, on all threads. */
static int draw_truth(bench_shot *out, const bench_line *line, report *r)
{
    static const bench_way way = {0, 1};
    bench_line all;
    return bench_line_with(&all, line, EXACT, r) && bench_line_hurry(&all, &bench_render) && draw(out, &all, &way, r);
}

/* Hashes the loaded scene, the view, and the options without the scene's name. */
static int hash(uint64_t *out, const bench_line *line, report *r)
{
    render_job *j = calloc(1, sizeof *j);
    int ok = j != NULL ? parse(j, line, r) : report_fail(r, "out of memory");
    ok = ok && render_job_load(j, r) && render_job_set(j, r);
    if (ok) {
        *out = scene_hash(&j->scene);
        for (int i = 0; i < line->argc; ++i) {
            if (line->argv[i] != j->o.scene) {
                *out = scene_hash_bytes(*out, line->argv[i], strlen(line->argv[i]) + 1);
            }
        }
        *out = scene_hash_bytes(*out, EXACT, sizeof EXACT);
        *out = scene_hash_view(*out, &j->frame.view);
    }
    if (j != NULL) {
        render_job_free(j);
        free(j);
    }
    return ok;
}

const bench_subject bench_render = {
    .verb = "render --show indirect --threads 1",
    .size = "--size %dx%d",
    .usual_size = "--size 160x120",
    .output = "-o picture.pfm",
    .table = &render_table,
    .refused = " --stats --stereo --exposure ",
    .stages = stages,
    .work = "pairs and segments",
    .tries = tries,
    .try_count = sizeof tries / sizeof *tries,
    .backends = 1,
    .exact = exact,
    .exact_count = sizeof exact / sizeof *exact,
    .truth_is = "its own most exact settings, " EXACT,
    .hurry = "--threads %d",
    .usage = "SCENE [options of lambent render] [options]\n"
             "relight|relief|mix --help     the same for these verbs\n"
             "--help                        speed of kernels",
    .about = "Measures speed against error of one picture: draws it with some thirty settings, one option at a time "
             "around --quality draft, default and best. Prints the cost of each (time by stage, memory, "
             "instructions if the system counts them) and the error against the truth: `trim`, relative RMSE "
             "without the worst 1 % of pixels, and the other figures of lambent compare. Pictures show only bounced "
             "light (--show indirect), on one thread, at the truth's size or 160x120; options of render change "
             "that.",
    .examples = "  three settings, as a table:\n"
                "    lambent-bench demo --size 24x16 --runs 1 --sweep tree=16,32,64 --breakdown 0\n"
                "  the same, as pages.html, pages.csv, pages.json:\n"
                "    lambent-bench demo --size 24x16 --runs 1 --sweep tree=16,32,64 --breakdown 0 -o pages\n",
    .check = check,
    .draw = draw,
    .truth = draw_truth,
    .hash = hash,
};
