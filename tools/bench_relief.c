/* bench_relief.c: `lambent bench relief`: reliefs by views, size and iterations, against their complex model. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_subject.h"
#include "model.h"
#include "option_value.h"
#include "relief_bake.h"
#include "relief_draw.h"
#include "relief_model.h"
#include "view_options.h"

static const char help[] =
    "usage: lambent bench relief MODEL [--views N|greedy:N] [--size PX] [--packed] [--triangles N] [--steps N]\n"
    "                            [--looks N] [--keep N] [--eye X,Y,Z --target X,Y,Z --fov DEG] [--sweep NAME=V,V,...]\n"
    "                            [--runs N] [-o NAME | --html FILE --csv FILE --json FILE]\n"
    "\n"
    "Speed and memory against error of a model drawn as a relief, at 512 x 512 under a sun, whole from a little\n"
    "above: bakes it by so many views of such a size and draws it in so many steps. The truth is the model itself,\n"
    "drawn by its triangles. Options are those of lambent relief bake and render; time is that of the picture, memory\n"
    "the relief's.\n"
    "\n"
    "  lambent bench relief statue.ply -o statue\n"
    "  lambent bench relief statue.ply --sweep views=6,14,26 --sweep size=128,256\n";

static const char *const stages[BENCH_STAGES] = {"light map", "triangles", "pixels", NULL};

static const bench_try tries[] = {
    {"default", "", 3, 0},
    {"views", "--views 6", 2, 0},
    {"views", "--views 14", 2, 0},
    {"views", "--views 18", 3, 0},
    {"views", "--views greedy:12", 4, 0},
    {"views", "--views greedy:26", 6, 0},
    {"views", "--views 50", 5, 0},
    {"size", "--size 64", 3, 0},
    {"size", "--size 128", 3, 0},
    {"size", "--size 512", 5, 0},
    {"iterations", "--steps 1", 3, 0},
    {"iterations", "--steps 2", 3, 0},
    {"iterations", "--steps 3", 3, 0},
    {"iterations", "--steps 12", 3, 0},
    {"looks", "--looks 1 --keep 1", 3, 0},
    {"looks", "--looks 3", 3, 0},
    {"looks", "--keep 1", 3, 0},
    {"simple model", "--triangles 500", 3, 0},
    {"simple model", "--triangles 12000", 3, 0},
    {"storage", "--packed", 3, 0},
    {"draft and", "--views 14 --size 128 --steps 2 --keep 1", 3, 0},
};

enum { SIDE = 512, LIGHT_MAP = 1024 };

typedef struct statue {
    const char *model;
    int32_t views, greedy, size, triangles, format;
    view_options view;
    lmb_relief_how how;
    /* made of it */
    struct model loaded;
    triangle_mesh mesh, simple;
    relief_scene flat;
    lmb_scene scene;
    lmb_mesh *meshes;
    relief_bake bake;
    file_bytes file;
    lmb_relief relief;
    lmb_scene simple_scene;
    lmb_light sun;
    relief_shot shot;
    relief_frame frame;
} statue;

/* --- the command line --------------------------------------------------------------------------------------------- */

static int parse_views(const char *text, statue *s)
{
    s->greedy = strncmp(text, "greedy:", 7) == 0;
    return option_int(text + 7 * s->greedy, 1, LMB_RELIEF_VIEWS, &s->views);
}

static int parse_size(const char *text, statue *s) { return option_int(text, 8, 4096, &s->size); }
static int parse_triangles(const char *text, statue *s) { return option_int(text, 4, 10000000, &s->triangles); }
static int parse_steps(const char *text, statue *s) { return option_int(text, 1, 32, &s->how.steps); }
static int parse_looks(const char *text, statue *s) { return option_int(text, 1, LMB_RELIEF_LOOKS, &s->how.views); }
static int parse_keep(const char *text, statue *s) { return option_int(text, 1, 3, &s->how.keep); }
static int parse_eye(const char *text, statue *s) { return s->view.has_eye = option_vec3(text, &s->view.eye); }
static int parse_target(const char *text, statue *s) { return s->view.has_target = option_vec3(text, &s->view.target); }
static int parse_fov(const char *text, statue *s) { return view_option_fov(text, &s->view); }

static const struct flag {
    option_name of;
    int (*parse)(const char *text, statue *s);
    int bakes; /* of relief bake, else of relief render */
} flags[] = {
    {{"--views", "1 .. 64 or greedy:N"}, parse_views, 1},
    {{"--size", "8 .. 4096"}, parse_size, 1},
    {{"--triangles", "4 .. 10000000"}, parse_triangles, 1},
    {{"--steps", "1 .. 32"}, parse_steps, 0},
    {{"--looks", "1 .. 8"}, parse_looks, 0},
    {{"--keep", "1 .. 3"}, parse_keep, 0},
    {{"--eye", "X,Y,Z"}, parse_eye, 0},
    {{"--target", "X,Y,Z"}, parse_target, 0},
    {{"--fov", "degrees, over 0 and under 179"}, parse_fov, 0},
};
enum { FLAGS = sizeof flags / sizeof *flags };

static int parse(statue *s, const bench_line *l, report *r)
{
    char *argv[BENCH_ARGS + 1];
    memcpy(argv, l->argv, (size_t)l->argc * sizeof *argv);
    argv[l->argc] = NULL;
    view_options_init(&s->view);
    s->views = 26;
    s->size = 256;
    s->triangles = 3000;
    s->format = LMB_RELIEF_FULL;
    for (int i = 1; i < l->argc; ++i) {
        if (strcmp(argv[i], "--packed") == 0) {
            s->format = LMB_RELIEF_PACKED;
        } else if (argv[i][0] != '-') {
            if (s->model != NULL) {
                return report_fail(r, "one model at a time: %s and %s", s->model, argv[i]);
            }
            s->model = argv[i];
        } else {
            const int f = option_find(flags, sizeof *flags, FLAGS, argv, i, r);
            if (f < 0 || (!flags[f].parse(argv[++i], s) && !option_refuse(&flags[f].of, argv[i], r))) {
                return 0;
            }
        }
    }
    s->view.width = s->view.height = SIDE;
    s->view.is_quiet = 1;
    return (s->model != NULL || report_fail(r, "no model given")) && view_options_check(&s->view, r);
}

/* Two commands: one bakes, one draws. */
static void say(char *out, size_t size, const bench_line *l)
{
    bench_line both[2];
    memset(both, 0, sizeof both);
    for (int k = 0; k < 2; ++k) {
        bench_line_add(&both[k], k == 0 ? "relief bake" : "relief render statue.lmr");
    }
    for (int i = 1; i < l->argc; ++i) {
        int f = FLAGS - 1;
        while (f >= 0 && strcmp(flags[f].of.name, l->argv[i]) != 0) {
            --f;
        }
        bench_line *to = &both[f >= 0 && !flags[f].bakes];
        to->argv[to->argc++] = l->argv[i];
        if (f >= 0 && i + 1 < l->argc) {
            to->argv[to->argc++] = l->argv[++i];
        }
    }
    bench_line_add(&both[0], "-o statue.lmr");
    bench_line_add(&both[1], "--size 512x512 -o picture.pfm");
    bench_line_say(out, size, &both[0]);
    const size_t n = strlen(out), join = n + 4 < size ? (size_t)snprintf(out + n, size - n, " && ") : 0;
    bench_line_say(out + n + join, size - n - join, &both[1]);
}

/* --- a statue and its relief -------------------------------------------------------------------------------------- */

static int load(statue *s, report *r)
{
    static model_notes notes;
    memset(&notes, 0, sizeof notes);
    if (!model_load(&s->loaded, s->model, NULL, &notes, r) || !relief_flatten(&s->mesh, &s->loaded.scene, r) ||
        !relief_scene_of(&s->flat, &s->mesh, r)) {
        return 0;
    }
    s->meshes = malloc((s->loaded.scene.mesh_count + 1) * sizeof *s->meshes);
    if (s->meshes == NULL) {
        return report_fail(r, "%s: out of memory", s->model);
    }
    relief_smooth(&s->scene, s->meshes, &s->loaded.scene, &s->flat);
    return lmb_scene_triangles(&s->scene) > 0 || report_fail(r, "%s: nothing to bake: no triangles", s->model);
}

static int bake(statue *s, report *r)
{
    lmb_vec3 direction[LMB_RELIEF_VIEWS];
    simplify_facts facts;
    relief_directions(direction, s->views);
    if ((s->greedy && !relief_greedy(direction, s->views, &s->mesh, &s->scene, s->size, r)) ||
        !simplify_mesh(&s->simple, &s->mesh, (uint32_t)s->triangles, SIMPLIFY_AROUND, &facts, r)) {
        return 0;
    }
    s->bake.format = s->format;
    for (int32_t i = 0; i < s->views; ++i) {
        const lmb_view view = relief_fit(&s->mesh, direction[i], s->size);
        if (!relief_add(&s->bake, &s->scene, &view, r)) {
            return 0;
        }
    }
    if (!relief_encode(&s->file, &s->bake, &s->simple, r)) {
        return 0;
    }
    return (lmb_relief_swap(s->file.data, s->file.size) == LMB_OK &&
            lmb_relief_open(&s->relief, s->file.data, s->file.size) == LMB_OK) ||
           report_fail(r, "%s: its relief cannot be opened", s->model);
}

/* The same for relief and truth: of the model's own box. */
static int aim(statue *s, report *r)
{
    static const lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f,
                                  LMB_LIGHT_DIRECTIONAL, 0};
    lmb_view middle;
    if (s->view.has_eye ? !view_look(&middle, &s->view, r) : !view_frame(&middle, &s->view, &s->scene, s->model, r)) {
        return 0;
    }
    middle.near_m = 0.0f;
    s->sun = sun;
    s->shot.kernels = lmb_kernels_pick();
    s->shot.view = view_from(&middle, 0.0f, &s->scene);
    s->shot.how = s->how;
    s->shot.light = &s->sun;
    s->shot.light_map = LIGHT_MAP;
    s->shot.ambient = 0.3f;
    return 1;
}

static int shoot_once(void *user, double stage_s[BENCH_STAGES], report *r)
{
    statue *s = user;
    relief_frame_free(&s->frame);
    memset(&s->frame, 0, sizeof s->frame);
    if (!relief_shoot(&s->frame, &s->shot, r)) {
        return 0;
    }
    stage_s[0] = s->frame.light_s;
    stage_s[1] = s->frame.draw_s;
    stage_s[2] = s->frame.band_s;
    return 1;
}

/* Where it shows something: what backgrounds have in common is nobody's merit. */
static int keep(bench_shot *out, statue *s, report *r)
{
    const relief_frame *f = &s->frame;
    const size_t pixels = (size_t)f->width * (size_t)f->height;
    out->surface = calloc(pixels, 3 * sizeof *out->surface);
    out->picture.pixels = malloc(pixels * 3 * sizeof *out->picture.pixels);
    if (out->surface == NULL || out->picture.pixels == NULL) {
        return report_fail(r, "out of memory");
    }
    for (size_t i = 0; i < pixels; ++i) {
        out->surface[3 * i + 2] = f->depth[i] > 0.0f ? 1.0f : 0.0f;
    }
    memcpy(out->picture.pixels, f->rgb, pixels * 3 * sizeof *out->picture.pixels);
    out->picture.width = f->width;
    out->picture.height = f->height;
    out->picture.channels = 3;
    out->bytes = (double)(s->file.size > 0 ? s->file.size : 0);
    out->threads = 1;
    return 1;
}

static void statue_free(statue *s)
{
    model_free(&s->loaded);
    triangle_mesh_free(&s->mesh);
    triangle_mesh_free(&s->simple);
    relief_scene_free(&s->flat);
    relief_bake_free(&s->bake);
    relief_frame_free(&s->frame);
    file_free(&s->file);
    free(s->meshes);
    free(s);
}

static int run(bench_shot *out, const bench_line *line, const bench_way *way, int is_truth, report *r)
{
    statue *s = calloc(1, sizeof *s);
    memset(out, 0, sizeof *out);
    int ok = s != NULL ? parse(s, line, r) && load(s, r) && aim(s, r) : report_fail(r, "out of memory");
    ok = ok && (is_truth || bake(s, r));
    if (ok) {
        s->shot.relief = is_truth ? NULL : &s->relief;
        s->shot.scene = is_truth ? &s->scene : NULL;
        ok = bench_repeat(out, way, shoot_once, s, r) && keep(out, s, r);
    }
    if (!ok) {
        bench_shot_free(out);
    }
    if (s != NULL) {
        statue_free(s);
    }
    return ok;
}

static int check(const bench_line *line, report *r)
{
    statue *s = calloc(1, sizeof *s);
    const int ok = s != NULL ? parse(s, line, r) : report_fail(r, "out of memory");
    free(s);
    return ok;
}

static int draw(bench_shot *out, const bench_line *line, const bench_way *way, report *r)
{
    return run(out, line, way, 0, r);
}

static int draw_truth(bench_shot *out, const bench_line *line, report *r)
{
    static const bench_way way = {0, 1};
    return run(out, line, &way, 1, r);
}

const bench_subject bench_relief = {
    .verb = "relief",
    .bare = " --packed ",
    .refused = " --truth ",
    .stages = stages,
    .tries = tries,
    .try_count = sizeof tries / sizeof *tries,
    .truth_is = "the model itself, drawn by its triangles",
    .help = help,
    .say = say,
    .check = check,
    .draw = draw,
    .truth = draw_truth,
};
