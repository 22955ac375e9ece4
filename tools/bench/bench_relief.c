/* bench_relief.c: `lambent-bench relief`: reliefs by views, size and iterations, against their complex model. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/view_frame.h"
#include "../model/model.h"
#include "../relief/relief_bake.h"
#include "../relief/relief_draw.h"
#include "../relief/relief_model.h"
#include "../relief/relief_options.h"
#include "bench_subject.h"

static const char *const stages[BENCH_STAGES] = {"shadow map", "triangles", "pixels", NULL};

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
    {"pixel views", "--pixel-views 1 --keep 1", 3, 0},
    {"pixel views", "--pixel-views 3", 3, 0},
    {"pixel views", "--keep 1", 3, 0},
    {"simple model", "--triangles 500", 3, 0},
    {"simple model", "--triangles 12000", 3, 0},
    {"storage", "--packed", 3, 0},
    {"shadow map", "--shadow-map 128", 3, 0},
    {"shadow map", "--shadow-map 256", 3, 0},
    {"shadow map", "--shadow-map 0", 3, 0},
    {"draft and", "--views 14 --size 128 --steps 2 --keep 1", 3, 0},
};

enum { SIDE = 512, SHADOW_MAP = 1024 };

typedef struct statue {
    const char *model;
    model_choice choice;
    int32_t views, greedy, size, triangles, is_packed, shadow_map;
    view_options view;
    lmb_relief_how how;
    /* derived from it */
    struct model loaded;
    triangle_mesh mesh, simple;
    relief_bake bake;
    file_bytes file;
    lmb_relief relief;
    lmb_scene simple_scene;
    lmb_light sun;
    relief_shot shot;
    relief_frame frame;
} statue;

/* --- the command line --------------------------------------------------------------------------------------------- */

static int parse_views(const char *text, void *at)
{
    statue *s = at;
    return relief_option_views(text, &s->views, &s->greedy);
}

/* Options of relief bake, and of relief render. */
static const option_row bake_rows[] = {
    {.name = "MODEL", .kind = OPTION_TEXT, .value = "", .at = offsetof(statue, model), .help = "the complex one"},
    {.name = "--views", .value = "N|greedy:N", .kind = OPTION_OWN, .parse = parse_views,
     .expects = "1 .. 64 or greedy:N",
     .help = "from N sides (default 26), or the N that see most"},
    RELIEF_OPTIONS_BAKE(statue),
    {.kind = OPTION_END},
};
static const option_row render_rows[] = {
    RELIEF_OPTIONS_LOOK(statue),
    {.name = "--shadow-map", .kind = OPTION_MULTIPLE_OF_8, .value = "N", .at = offsetof(statue, shadow_map), .low = 0,
     .high = LMB_MAX_SIDE, .help = HELP("texels per side at most (default 1024); 0: no shadow")},
    VIEW_OPTIONS_CAMERA(statue, view, "the camera's position (default: the whole model from slightly above)"),
    {.kind = OPTION_END},
};
static const option_table table = {.verb = "relief", .part = {bake_rows, render_rows}};

static int parse(statue *s, const bench_line *l, report *r)
{
    char *argv[BENCH_ARGS];
    memcpy(argv, l->argv, sizeof argv);
    view_options_init(&s->view);
    s->views = 26;
    s->size = 256;
    s->triangles = 3000;
    s->shadow_map = SHADOW_MAP;
    if (options_parse(s, &table, l->argc, argv, r) != OPTIONS_RUN) {
        return 0;
    }
    s->view.width = s->view.height = SIDE;
    s->view.is_quiet = 1;
    return (s->model != NULL || report_fail(r, "no model given")) && view_options_check(&s->view, r);
}

static int draws(const option_row *row)
{
    const option_row *of = render_rows;
    while (of->kind != OPTION_END && of != row) {
        ++of;
    }
    return of == row;
}

/* Two commands: bake and draw. */
static void say(char *out, size_t size, const bench_line *l)
{
    bench_line both[2];
    memset(both, 0, sizeof both);
    for (int k = 0; k < 2; ++k) {
        bench_line_add(&both[k], k == 0 ? "relief bake" : "relief render statue.lmr");
    }
    for (int i = 1; i < l->argc;) {
        const option_row *row = l->argv[i][0] == '-' ? options_find(&table, l->argv[i]) : NULL;
        const int words = row != NULL ? options_words(row, l->argv[i]) : 1;
        for (int k = 0; k < words && i < l->argc; ++k) {
            bench_line_put(&both[row != NULL && draws(row)], l->argv[i++]);
        }
    }
    bench_line_add(&both[0], "-o statue.lmr");
    bench_line_add(&both[1], "--size 512x512 -o picture.pfm");
    bench_line_say(out, size, &both[0]);
    const size_t n = strlen(out), join = n + 4 < size ? (size_t)snprintf(out + n, size - n, " && ") : 0;
    bench_line_say(out + n + join, size - n - join, &both[1]);
}

/* --- a model and the relief of it --------------------------------------------------------------------------------- */

static int load(statue *s, report *r)
{
    static model_notes notes;
    memset(&notes, 0, sizeof notes);
    if (!model_load_as(&s->loaded, s->model, &s->choice, &notes, r)) {
        return 0;
    }
    model_tell(&notes, s->model, MODEL_NOTE_OPTION);
    return relief_flatten(&s->mesh, &s->loaded.scene, r);
}

static int bake(statue *s, report *r)
{
    lmb_vec3 direction[LMB_RELIEF_VIEWS];
    simplify_facts facts;
    relief_directions(direction, s->views);
    if ((s->greedy && !relief_greedy(direction, s->views, &s->mesh, &s->loaded.scene, s->size, r)) ||
        !simplify_mesh(&s->simple, &s->mesh, (uint32_t)s->triangles, SIMPLIFY_AROUND, &facts, r)) {
        return 0;
    }
    s->bake.format = s->is_packed ? LMB_RELIEF_PACKED : LMB_RELIEF_FULL;
    for (int32_t i = 0; i < s->views; ++i) {
        const lmb_view view = relief_fit(&s->mesh, direction[i], s->size);
        if (!relief_add(&s->bake, &s->loaded.scene, &view, r)) {
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

/* The same view and light for relief and truth, from the model's box. */
static int aim(statue *s, report *r)
{
    static const lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f,
                                  LMB_LIGHT_DIRECTIONAL, 0, 0};
    lmb_view middle;
    const lmb_scene *scene = &s->loaded.scene;
    if (s->view.has_eye ? !view_look(&middle, &s->view, r) : !view_frame(&middle, &s->view, scene, s->model, r)) {
        return 0;
    }
    middle.near_m = s->view.near_m;
    s->sun = sun;
    s->shot.kernels = lmb_kernels_pick();
    s->shot.view = view_from(&middle, 0.0f, scene);
    s->shot.how = s->how;
    s->shot.light = &s->sun;
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

/* Marks covered pixels, so that equal backgrounds do not improve the figures. */
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
    relief_bake_free(&s->bake);
    relief_frame_free(&s->frame);
    file_free(&s->file);
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
        s->shot.scene = is_truth ? &s->loaded.scene : NULL;
        s->shot.shadow_map = is_truth ? SHADOW_MAP : s->shadow_map;
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
    .table = &table,
    .refused = " --truth ",
    .stages = stages,
    .tries = tries,
    .try_count = sizeof tries / sizeof *tries,
    .truth_is = "the model itself, drawn by its triangles",
    .usage = "relief MODEL [options of lambent relief bake and render] [options]",
    .about = "Measures speed and memory against error of a model drawn as a relief, at 512 x 512 under a sun, whole "
             "from slightly above: bakes it with several numbers and sizes of views and draws it with several "
             "numbers of steps. The truth is the model itself, drawn by its triangles. You may give --views, "
             "--size, --packed, --triangles, --steps, --pixel-views, --keep, --shadow-map, --eye, --target, --up "
             "and --fov of lambent relief. Time is that of the picture, memory that of the relief.",
    .examples = "  a tent by two numbers of views:\n"
                "    printf 'v %s\\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >tent.obj\n"
                "    printf 'f %s\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\n"
                "    lambent-bench relief tent.obj --triangles 8 --size 32 --runs 1 --sweep views=6,14\n",
    .say = say,
    .check = check,
    .draw = draw,
    .truth = draw_truth,
};
