/* verb_relief.c: `lambent relief`: draws a complex model as a simple one that carries its surface. */
#include "verb_relief.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/option_value.h"
#include "../common/progress.h"
#include "../common/view_frame.h"
#include "../model/model.h"
#include "../picture/picture.h"
#include "../render/background.h"
#include "relief_compare.h"
#include "relief_crowd.h"
#include "relief_options.h"
#include "relief_path.h"
#include "relief_sky.h"
#include "relief_withheld.h"

enum { BOUNCE_MAP = 256 }; /* texels per side */
#define AMBIENT 0.3f /* W/m2 */
#define NEARER  0.1f /* of a photo's nearest depth: nothing before that is drawn */
enum { PLANE_FULL, PLANE_DEPTH, PLANE_NORMAL, PLANE_ALBEDO, PLANE_LIT };

/* --- command line ------------------------------------------------------------------------------------------------- */

static const char *const picks[] = {"p", "eye-ray", NULL}; /* in the order of LMB_RELIEF_ */
static const char *const samplings[] = {"bilinear", "nearest", NULL};
static const char *const shows[] = {"full", "depth", "normal", "albedo", "lit", NULL}; /* in the order of PLANE_ */

static const char *const grounds[] = {"auto", "none", NULL};
static const int32_t ground_values[] = {0, 1};

#define AT(member) .at = offsetof(relief_options, member)

static const option_row rows[] = {
    {.name = "FILE.lmr", .kind = OPTION_TEXT, .value = "", AT(file), .file = OPTION_READS,
     .help = HELP("made by `lambent relief bake`")},
    {.name = "--crowd", .value = "LIST", .kind = OPTION_TEXT, AT(crowd), .file = OPTION_READS,
     .help = HELP("many reliefs in one picture, in place of FILE.lmr: a list of placements, one per line, each "
             "FILE.lmr X Y Z [TURN [SCALE]]. TURN is in degrees about +y; names are relative to the list and have no "
             "spaces; # begins a comment. At most 1,000,000 placements of 1,000 files. The time grows with the pixels "
             "that placements cover and with their triangles: bake small ones with --size 64 --triangles 500. A ground "
             "and --bounce take time for all triangles")},
    {.kind = OPTION_TITLE, .help = HELP("view")},
    VIEW_OPTION_SIZE(relief_options, view, "px (default 640x480)"),
    VIEW_OPTIONS_CAMERA(relief_options, view, "the camera's position (default: the whole model from slightly above)"),
    {.name = "--photo", .value = "PREFIX", .kind = OPTION_TEXT, AT(photo),
     .help = HELP("draws from the place of a photo as in `relief bake --frame`, in the photo's size and without light, "
             "and prints how far the picture is from it (PSNR) and how many pixels the simple model fills. Use a photo "
             "that the relief was not made of")},
    {.kind = OPTION_TITLE, .help = HELP("surface")},
    {.name = "--pick", .kind = OPTION_WORD, AT(how.pick), .words = picks,
     .help = HELP("the winning candidate: nearest to the simple surface (default), or to the eye's ray")},
    {.name = "--sampling", .kind = OPTION_WORD, AT(how.sampling), .words = samplings,
     .help = HELP("of the views' texels (default bilinear)")},
    RELIEF_OPTIONS_LOOK(relief_options),
    {.kind = OPTION_TITLE, .help = HELP("light")},
    {.name = "--light", .kind = OPTION_LIGHT, AT(light), .counts = offsetof(relief_options, has_light),
     .help = HELP("KIND is spot, point or sun (default: a sun from the upper right)")},
    {.name = "--shadow-map", .value = "N", .kind = OPTION_MULTIPLE_OF_8, AT(shadow_map), .low = 0, .high = LMB_MAX_SIDE,
     .help = HELP("texels per side of the light's shadow map, at most (default 1024); the relief's map has at most the "
             "texels that its views show, and at most two per pixel. 0: no shadows")},
    {.name = "--ambient", .value = "E", .kind = OPTION_NUMBER, AT(ambient), .low = 0, .high = 1e6,
     .help = HELP("irradiance from everywhere, W/m2 (default 0.3, with a --world 0)")},
    {.name = "--world", .value = "FILE|sky|none", .kind = OPTION_TEXT, AT(world),
     .help = HELP("surroundings that light the picture and are visible behind it: a clear sky with a sun, or an "
             "environment map as in `lambent render` (default none). The world's sun replaces the default one. The "
             "scene of --with and the ground have contact shadows of the sky's light, the relief itself has none")},
    {.name = "--ground", .kind = OPTION_WORD, AT(no_ground), .words = grounds, .values = ground_values,
     .help = HELP("auto (default): with a --world, put a grey disc below the relief, unless there is a --with or the "
             "--background is a colour or transparent")},
    {.name = "--background", .value = "RRGGBB|world|transparent", .kind = OPTION_OWN, AT(background),
     .parse = render_option_background, .expects = RENDER_BACKGROUND_WANTS,
     .help = HELP("shown where there is no surface: a colour, the world (default; black if there is none), or "
             "transparent, for a PNG with alpha")},
    {.name = "--with", .value = "SCENE", .kind = OPTION_TEXT, AT(with), .file = OPTION_READS,
     .help = HELP("other geometry in the same picture: both shadow and hide each other")},
    OPTION_VERTEX_COLOURS_ROW(relief_options, choice.vertex_colours),
    {.name = "--bounce", .kind = OPTION_FLAG, AT(bounce),
     .help = HELP("adds light reflected once by the other geometry and the simple model")},
    {.kind = OPTION_TITLE, .help = HELP("output")},
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(out), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP(PICTURE_OPTION_HELP)},
    {.name = "--show", .kind = OPTION_WORD, AT(show), .words = shows, .help = HELP("(default full)")},
    {.name = "--samples", .kind = OPTION_WORD, AT(samples), .words = option_samples, .values = option_sample_values,
     .help = HELP("per pixel, of the light (default 4 for .png and .ppm, 1 for .pfm and .hdr; with --compare 1)")},
    {.name = "--exposure", .value = "EV|auto", .kind = OPTION_OWN, AT(exposure_ev), .parse = option_stops,
     .expects = OPTION_STOPS_WANTS,
     .help = HELP("stops, display formats only (default 0)")},
    {.name = "--compare", .value = "MODEL", .kind = OPTION_TEXT, AT(compare), .file = OPTION_READS,
     .help = HELP("also draws the complex model, and prints speed and errors side by side")},
    OPTION_BACKEND_ROW(relief_options, kernels),
    OPTION_THREADS_ROW(relief_options, threads, "draw the picture"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(relief_options, view.is_quiet, view.is_verbose, "print the time of each stage"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

#define TENT \
    "    printf 'v %s\\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >tent.obj\n" \
    "    printf 'f %s\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\n" \
    "    lambent relief bake tent.obj --size 64 --triangles 8 -o tent.lmr\n"

static const option_table table = {
    .verb = "relief render",
    .usage = HELP("relief render FILE.lmr [--path FILE] -o OUT [options]\n"
                  "relief render --crowd LIST [--path FILE] -o OUT [options]"),
    .about = HELP("Draws a complex model as a few triangles that carry its surface, silhouette, depth and shadow, "
             "by views of it."),
    .part = {rows, relief_path_rows},
    .examples = HELP("  a tent, its relief and a picture of that:\n" TENT
                "    lambent relief render tent.lmr --size 160x120 -o tent.png\n"),
};

static const option_row ask_rows[] = {OPTION_ASK, {.kind = OPTION_END}};

static const option_table both_table = {
    .verb = "relief",
    .usage = HELP("relief bake MODEL -o OUT.lmr [options]\nrelief render FILE.lmr [--path FILE] -o OUT [options]\n"
                  "relief render --crowd LIST [--path FILE] -o OUT [options]"),
    .about = HELP("Draws a complex model as a few triangles that carry its surface, silhouette, depth and shadow, by "
        "views of it: `bake` makes the views and the simple model, `render` draws them. Each has its own --help."),
    .part = {ask_rows},
    .examples = HELP("  a tent, its relief and a picture of that:\n" TENT
                "    lambent relief render tent.lmr --size 160x120 -o tent.png\n"),
};

static int has_world(const relief_options *o) { return o->world != NULL && strcmp(o->world, "none") != 0; }

static int background_fits(const relief_options *o, report *r)
{
    const int format = picture_format(o->out);
    if (o->background.kind != BACKGROUND_WORLD && o->show != PLANE_FULL) {
        return report_fail(r, "--background: only pictures of light have one; use --show full");
    }
    if (o->background.kind == BACKGROUND_TRANSPARENT && format != PICTURE_PNG) {
        return report_fail(r, "--background transparent: only PNG has alpha; name a .png");
    }
    return o->background.kind != BACKGROUND_COLOUR || !picture_is_linear(format) ||
           report_fail(r, "--background: a colour needs a display format; name a .png or a .ppm");
}

/* --photo leaves nothing of the camera and the light to choose. The web page reads no photos. */
static int photo_fits(const relief_options *o, report *r)
{
#if defined(OPTIONS_WITHOUT_HELP)
    return (void)o, (void)r, 1;
#else
    view_options usual;
    view_options_init(&usual);
    const int sees = o->view.has_eye || o->view.has_target || o->view.width > 0 || o->view.near_m > 0.0f ||
                     o->view.fov_deg != usual.fov_deg || o->view.up.x != usual.up.x || o->view.up.y != usual.up.y ||
                     o->view.up.z != usual.up.z;
    if (sees || o->path != NULL || o->compare != NULL) {
        return report_fail(r, "--photo sets camera and size: leave --eye, --target, --up, --fov, --near, --size, "
                           "--path and --compare out");
    }
    if (o->has_light || has_world(o) || o->bounce || o->samples != 0) {
        return report_fail(r, "--photo draws without light: leave --light, --world, --bounce and --samples out");
    }
    return o->background.kind == BACKGROUND_WORLD ||
           report_fail(r, "--photo has no background: leave --background out");
#endif
}

static int parse(relief_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    view_options_init(&o->view);
    o->shadow_map = 1024;
    o->ambient = NAN;
    o->kernels = lmb_kernels_pick();
    const int asked = options_parse(o, &table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    if (o->file == NULL && o->crowd == NULL) {
        return report_fail(r, "no relief given; lambent relief bake makes one");
    }
    if (o->crowd != NULL && (o->file != NULL || o->compare != NULL)) {
        return report_fail(r, "--crowd names the reliefs to draw: leave %s out",
                           o->file != NULL ? o->file : "--compare");
    }
    if (o->compare != NULL && o->with != NULL) {
        return report_fail(r, "--compare draws only the complex model: leave --with out");
    }
    if (o->out == NULL) {
        return report_fail(r, "no output given; add -o FILE.png");
    }
    if (has_world(o) && o->compare != NULL) {
        return report_fail(r, "--compare needs a single light: leave --world out");
    }
    if (o->photo != NULL && !photo_fits(o, r)) {
        return OPTIONS_BAD;
    }
    if (o->photo != NULL && o->show == PLANE_FULL) {
        o->show = PLANE_ALBEDO;
    }
    if (isnan(o->ambient)) {
        o->ambient = has_world(o) ? 0.0f : AMBIENT;
    }
    if (!background_fits(o, r)) {
        return OPTIONS_BAD;
    }
    return relief_path_check(o, r) && view_options_check(&o->view, r) ? OPTIONS_RUN : OPTIONS_BAD;
}

/* --- work --------------------------------------------------------------------------------------------------------- */

typedef struct work {
    file_bytes file;
    lmb_relief relief;
    relief_crowd crowd;
    lmb_scene simple; /* of the relief, or of all placements */
    model with, complex; /* complex: the model of --compare */
    lmb_light light; /* the given light, or the default sun */
    key_path path;
    relief_sky sky;
    relief_photo photo;
} work;

static void work_free(work *w)
{
    file_free(&w->file);
    model_free(&w->with);
    model_free(&w->complex);
    key_path_free(&w->path);
    relief_sky_free(&w->sky);
    relief_crowd_free(&w->crowd);
    relief_photo_free(&w->photo);
    free(w);
}

static int open_reliefs(work *w, const relief_options *o, report *r)
{
    if (o->crowd != NULL) {
        const int ok = relief_crowd_read(&w->crowd, o->crowd, r);
        w->simple = w->crowd.scene;
        return ok;
    }
    const int ok = relief_file_open(&w->relief, &w->file, o->file, r);
    lmb_relief_scene(&w->simple, &w->relief);
    return ok;
}

static int load(model *out, const char *path, const relief_options *o, report *r)
{
    static model_notes notes;
    memset(&notes, 0, sizeof notes);
    if (!model_load_as(out, path, &o->choice, &notes, r)) {
        return 0;
    }
    model_tell(&notes, path, MODEL_NOTE_OPTION);
    return 1;
}

static int choose_view(lmb_view *out, work *w, relief_options *o, report *r)
{
    lmb_view middle;
    if (o->photo != NULL) {
        const int ok = relief_photo_read(&w->photo, o->photo, r);
        report_note(!ok || o->view.is_quiet || w->photo.has_pose,
                    "note: %s: no camera_to_world; its camera is at 0,0,0", o->photo);
        *out = w->photo.view;
        out->near_m *= NEARER;
        return ok;
    }
    const int is_quiet = o->view.is_quiet;
    o->view.is_quiet |= relief_path_leads(&w->path, KEY_CAMERA); /* no note about a default camera */
    const char *name = o->crowd != NULL ? o->crowd : o->file;
    if (o->view.has_eye ? !view_look(&middle, &o->view, r) : !view_frame(&middle, &o->view, &w->simple, name, r)) {
        return 0;
    }
    o->view.is_quiet = is_quiet;
    middle.near_m = o->view.near_m;
    *out = view_from(&middle, 0.0f, &w->simple);
    return 1;
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

/* Replaces the frame's light by the plane to show, three floats per pixel. */
static void show(relief_frame *f, int32_t what)
{
    const size_t pixels = (size_t)f->width * (size_t)f->height;
    for (size_t i = 0; i < pixels && what != PLANE_FULL; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const size_t at = 3 * i + c;
            f->rgb[at] = what == PLANE_ALBEDO   ? f->albedo[at]
                         : what == PLANE_NORMAL ? (f->depth[i] > 0.0f ? 0.5f + 0.5f * f->normal[at] : 0.0f)
                         : what == PLANE_DEPTH  ? f->depth[i]
                                               : (float)f->lit[i];
        }
    }
}

/* Only light is averaged over samples. The complex model is drawn with one sample. */
static int32_t samples_of(const relief_options *o)
{
    const int is_linear = picture_is_linear(picture_format(o->out));
    return o->show != PLANE_FULL || o->compare != NULL ? 1 : o->samples != 0 ? o->samples : is_linear ? 1 : 4;
}

/* Light is dark behind surfaces; fills in a display colour, or transparency. */
static int write_before(const relief_options *o, const relief_frame *f, image *linear, const char *path, report *r)
{
    file_bytes file = {NULL, 0};
    if (o->background.kind == BACKGROUND_WORLD) {
        return picture_write(path, linear, o->exposure_ev, PICTURE_CLIPPED, r);
    }
    if (o->background.kind == BACKGROUND_COLOUR) {
        picture_expose(linear, o->exposure_ev, PICTURE_CLIPPED);
        background_colour(linear, o->background.rgb, f->cover);
        return picture_write(path, linear, 0.0f, PICTURE_CLIPPED, r);
    }
    const int ok = picture_encode_alpha(&file, linear, f->cover, o->exposure_ev, PICTURE_CLIPPED, r) &&
                   file_write(path, file.data, file.size, r);
    file_free(&file);
    return ok;
}

/* All pictures use the exposure of the first. */
static int write_frame(relief_options *o, relief_frame *f, const char *path, report *r)
{
    show(f, o->show);
    image out = {f->width, f->height, 3, f->rgb};
    if (isnan(o->exposure_ev)) {
        o->exposure_ev = picture_auto_exposure(&out, PICTURE_CLIPPED);
    }
    return write_before(o, f, &out, path, r);
}

static void tell(const relief_frame *f)
{
    const lmb_relief_stats *s = &f->stats;
    const double n = s->pixels > 0 ? (double)s->pixels : 1.0;
    report_say("pixels of the simple model %.0f: hit %.2f %%, passed %.2f %%, holes %.2f %%\n", (double)s->pixels,
           100.0 * (double)s->hits / n, 100.0 * (double)s->missed / n, 100.0 * (double)s->holes / n);
}

static void tell_withheld(const relief_frame *f, const relief_photo *photo, const char *name)
{
    withheld_figures e;
    withheld_measure(&e, f, photo);
    if (e.db < 0.0) {
        report_say("%s: no pixel shows a surface\n", name);
        return;
    }
    report_say("%s: %.2f dB over the %.2f %% of the pixels with a surface; %.2f %% filled from the simple model\n",
               name, e.db, 100.0 * e.shown, 100.0 * e.filled);
}

/* Reads the world, and takes its sun if no light is given. */
static int open_sky(relief_shot *shot, work *w, const relief_options *o, report *r)
{
    if (!has_world(o)) {
        return 1;
    }
    const int wants_ground = !o->no_ground && o->with == NULL && o->background.kind == BACKGROUND_WORLD;
    if (!relief_sky_open(&w->sky, o->world, wants_ground ? &w->simple : NULL, shot->view.eye, o->view.is_quiet, r)) {
        return 0;
    }
    shot->sky = &w->sky;
    shot->shows_sky = o->show == PLANE_FULL && o->background.kind == BACKGROUND_WORLD;
    if (w->sky.ground.instance_count > 0) {
        shot->scene = &w->sky.ground;
    }
    if (!o->has_light && w->sky.around.has_sun) {
        w->light = w->sky.around.sun;
    } else if (!o->has_light && !relief_path_leads(&w->path, KEY_LIGHT)) {
        shot->light = NULL;
    }
    return 1;
}

static int render(work *w, relief_options *o, report *r)
{
    relief_shot shot;
    relief_frame f;
    const lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f,
                           LMB_LIGHT_DIRECTIONAL, 0, 0};
    memset(&shot, 0, sizeof shot);
    w->light = o->has_light ? o->light : sun;
    if (!options_files(o, &table, r) || !open_reliefs(w, o, r) ||
        (o->with != NULL && !load(&w->with, o->with, o, r)) ||
        (o->compare != NULL && !load(&w->complex, o->compare, o, r)) || !options_files(o, &table, r) ||
        !relief_path_open(&w->path, o, &w->light, r) || !choose_view(&shot.view, w, o, r)) {
        return 0;
    }
    shot.kernels = o->kernels;
    shot.relief = o->crowd == NULL ? &w->relief : NULL;
    shot.crowd = o->crowd != NULL ? &w->crowd : NULL;
    shot.scene = o->with != NULL ? &w->with.scene : NULL;
    shot.how = o->how;
    shot.light = &w->light;
    shot.shadow_map = o->shadow_map;
    shot.ambient = o->ambient;
    shot.threads = pool_threads(o->threads);
    shot.bounce = o->bounce ? BOUNCE_MAP : 0;
    shot.samples = samples_of(o);
    if (!open_sky(&shot, w, o, r) || !options_files(o, &table, r)) { /* photo and world are inputs, too */
        return 0;
    }
    if (o->show == PLANE_DEPTH) {
        o->exposure_ev = NAN;
    }
    if (o->path != NULL) {
        return relief_along(o, &w->path, &shot, &w->light, &w->simple, write_frame, r);
    }
    if (!relief_shoot(&f, &shot, r)) {
        return 0;
    }
    if (!o->view.is_quiet) {
        tell(&f);
    }
    if (o->photo != NULL && !o->view.is_quiet) {
        tell_withheld(&f, &w->photo, o->photo);
    }
    report_note(!o->view.is_verbose, "shadow map %.2f ms, triangles %.2f ms, pixels %.2f ms", 1e3 * f.light_s,
                1e3 * f.draw_s, 1e3 * f.band_s);
    const int ok = (o->compare == NULL || relief_tell(&f, shot, &w->complex.scene, r)) && write_frame(o, &f, o->out, r);
    relief_frame_free(&f);
    return ok;
}

static int verb_render_relief(int argc, char **argv)
{
    report r = {""};
    relief_options o;
    const int asked = parse(&o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    work *w = calloc(1, sizeof *w);
    progress_begin(o.view.is_quiet, "relief render");
    const int ok = w != NULL ? render(w, &o, &r) : report_fail(&r, "out of memory");
    if (w != NULL) {
        work_free(w);
    }
    progress_end();
    return ok ? 0 : report_end(&r, "relief render", 1);
}

int verb_relief(int argc, char **argv)
{
    if (argc >= 2 && strcmp(argv[1], "bake") == 0) {
        return verb_relief_bake(argc - 1, argv + 1);
    }
    if (argc >= 2 && strcmp(argv[1], "render") == 0) {
        return verb_render_relief(argc - 1, argv + 1);
    }
    static const char *const verbs[] = {"bake", "render", NULL};
    report r = {""};
    const char *meant = argc >= 2 ? options_nearest(verbs, argv[1]) : NULL;
    if (meant != NULL) {
        report_fail(&r, "there is no `relief %s`; did you mean relief %s?", argv[1], meant);
        return report_end(&r, "relief", 2);
    }
    if (argc >= 2 && argv[1][0] != '-') {
        report_fail(&r, "there is no `relief %s`: give bake or render; lambent relief --help describes both", argv[1]);
        return report_end(&r, "relief", 2);
    }
    const int asked = options_parse(NULL, &both_table, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &both_table, &r);
    }
    report_fail(&r, "give bake or render; lambent relief --help describes both");
    return report_end(&r, "relief", 2);
}
