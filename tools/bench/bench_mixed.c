/* bench_mixed.c: `lambent-bench mix`: an object in a photo by voxels and cones. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../mix/mix_job.h"
#include "bench_subject.h"

static const char *const stages[BENCH_STAGES] = {"planes", "object and light", "voxels", "picture", NULL};

static const bench_try tries[] = {
    {"default", "", 4, 0},
    {"voxels", "--voxels 5", 2, 0},
    {"voxels", "--voxels 6", 3, 0},
    {"voxels", "--voxels 8", 10, 0},
    {"cones", "--cones 7", 3, 0},
    {"cones", "--cones 37", 6, 0},
    {"shadow map", "--shadow-map 256", 4, 0},
    {"shadow map", "--shadow-map 2048", 5, 0},
    {"samples", "--samples 4", 5, 0},
    {"samples", "--samples 16", 9, 0},
    {"draft and", "--voxels 6 --cones 7", 2, 0},
    {"draft and", "--voxels 5 --cones 7 --shadow-map 256", 2, 0},
};

#define EXACT "--voxels 8 --cones 37 --shadow-map 2048 --samples 16"

typedef struct mixture {
    const bench_line *line;
    mix_job *job; /* of the last run */
} mixture;

static int parse(mix_options *o, const bench_line *line, report *r)
{
    char *argv[BENCH_ARGS];
    memcpy(argv, line->argv, sizeof argv);
    if (mix_options_parse(o, line->argc, argv, r) != OPTIONS_RUN) {
        return 0;
    }
    o->is_quiet = 1;
    if (o->objects > 1) {
        return report_fail(r, "--object: %d of them; give one", (int)o->objects);
    }
    return o->object != NULL || report_fail(r, "--object: nothing is put into the photo");
}

static int begin(mixture *m, report *r)
{
    if (m->job != NULL) {
        mix_job_free(m->job);
    }
    m->job = calloc(1, sizeof *m->job);
    return m->job != NULL ? parse(&m->job->o, m->line, r) && mix_frame_read(&m->job->frame, &m->job->o.source, r)
                          : report_fail(r, "out of memory");
}

static double lap(double *from)
{
    const double now = host_cpu_seconds(), was = *from;
    *from = now;
    return now - was;
}

static int mix_once(void *user, double stage_s[BENCH_STAGES], report *r)
{
    mixture *m = user;
    if (!begin(m, r)) {
        return 0;
    }
    double from = host_cpu_seconds();
    int ok = mix_find_planes(m->job, r);
    stage_s[0] = lap(&from);
    ok = ok && mix_place(m->job, r) && mix_light(m->job, r);
    model_tell(&m->job->notes, m->job->o.object, MODEL_NOTE_OPTION);
    stage_s[1] = lap(&from);
    ok = ok && mix_voxels(m->job, r);
    stage_s[2] = lap(&from);
    ok = ok && mix_draw(m->job, r);
    stage_s[3] = lap(&from);
    return ok;
}

/* Marks the pixels that the object changes. */
static void mark_changed(float *surface, const image *picture, const image *photo)
{
    const size_t n = (size_t)picture->width * (size_t)picture->height;
    double mean = 0.0;
    for (size_t i = 0; i < 3 * n; ++i) {
        mean += (double)photo->pixels[i] / (3.0 * (double)n);
    }
    for (size_t i = 0; i < n; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            if (fabs((double)picture->pixels[3 * i + c] - (double)photo->pixels[3 * i + c]) > 0.01 * mean) {
                surface[3 * i + 2] = 1.0f;
            }
        }
    }
}

static double bytes_of(const mix_job *j)
{
    return (double)lmb_voxels_bytes(j->voxels.cap, LMB_VOXELS_THREE) + (double)mix_maps_bytes(j);
}

static int check(const bench_line *line, report *r)
{
    mix_options o;
    return parse(&o, line, r);
}

static int draw(bench_shot *out, const bench_line *line, const bench_way *way, report *r)
{
    mixture m = {line, NULL};
    memset(out, 0, sizeof *out);
    int ok = bench_repeat(out, way, mix_once, &m, r);
    if (ok) {
        mix_job *j = m.job;
        const size_t n = (size_t)j->picture.width * (size_t)j->picture.height;
        out->surface = calloc(n, 3 * sizeof *out->surface);
        ok = out->surface != NULL || report_fail(r, "out of memory");
    }
    if (ok) {
        mark_changed(out->surface, &m.job->picture, &m.job->frame.light);
        out->picture = m.job->picture;
        m.job->picture.pixels = NULL;
        out->bytes = bytes_of(m.job);
        out->threads = 1;
    }
    if (m.job != NULL) {
        mix_job_free(m.job);
    }
    return ok;
}

static int draw_truth(bench_shot *out, const bench_line *line, report *r)
{
    static const bench_way way = {0, 1};
    bench_line all;
    return bench_line_with(&all, line, EXACT, r) && draw(out, &all, &way, r);
}

const bench_subject bench_mixed = {
    .verb = "mix",
    .output = "-o picture.pfm",
    .table = &mix_table,
    .refused = " --stats --show --exposure ",
    .stages = stages,
    .tries = tries,
    .try_count = sizeof tries / sizeof *tries,
    .backends = 1,
    .truth_is = "its own finest settings, " EXACT,
    .usage = "mix --frame PREFIX --object MESH [options of lambent mix] [options]",
    .about = "Measures speed and memory against error of an object in a photo: by voxels per side, cones per "
             "hemisphere, texels of the shadow maps and samples per pixel; for lights with a size and for varnish, "
             "add options of lambent mix. Errors count where the object changes the photo by more than a hundredth "
             "of its mean, against your picture (linear, of the photo's size) or the finest settings: 256 voxels "
             "per side, 37 cones, 16 samples. Time excludes reading the files; memory is that of the voxels and "
             "maps.",
    .examples = "  a photo with depth of the built-in room, a tent, and a picture of both as the truth:\n"
                "    eye='--eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 80x60'\n"
                "    lambent render demo $eye -o photo.png\n"
                "    lambent render demo $eye --show depth -o depth.pfm\n"
                "    printf 'v %s\\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >tent.obj\n"
                "    printf 'f %s\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\n"
                "    put='--photo photo.png --depth depth.pfm --intrinsics 72.43,72.43,39.5,29.5 --object tent.obj'\n"
                "    lambent mix $put --voxels 6 --cones 37 -o truth.pfm\n"
                "    lambent-bench mix $put --runs 1 --truth truth.pfm --sweep voxels=4,5\n",
    .check = check,
    .draw = draw,
    .truth = draw_truth,
};
