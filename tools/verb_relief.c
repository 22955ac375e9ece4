/* verb_relief.c: `lambent relief`: a complex model drawn as a simple one that carries its surface. */
#include "verb_relief.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"
#include "option_value.h"
#include "picture.h"
#include "relief_compare.h"
#include "relief_model.h"
#include "view_options.h"

static const char help_text[] =
    "usage: lambent relief bake MODEL -o OUT.lmr [options]     see lambent relief bake --help\n"
    "       lambent relief render FILE.lmr -o IMG [options]\n"
    "\n"
    "A complex model drawn as a few triangles that carry its surface, silhouette, depth and shadow, by views of it.\n"
    "\n"
    "view\n"
    "  --eye X,Y,Z --target X,Y,Z --up X,Y,Z --fov DEG    (default: the whole model from a little above)\n"
    "  --size WxH                 (default 640x480)\n"
    "surface\n"
    "  --pick p|eye-ray           which candidate wins: nearest to the simple surface (default), or to the eye's ray\n"
    "  --sampling bilinear|nearest\n"
    "  --steps N                  looks a pixel takes, 1 .. 32 (default 6); 1: once, from the simple surface\n"
    "  --looks N                  views a pixel looks at, 1 .. 8 (default 6)\n"
    "  --keep N                   of which the best are blended, 1 .. 3 (default 3)\n"
    "light\n"
    "  --light spot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER]   (default: a sun from the upper right)\n"
    "  --light-map N              texels a side of its shadow map, a multiple of 8 (default 1024); 0: no shadows\n"
    "  --ambient E                irradiance from everywhere, W/m2 (default 0.3)\n"
    "  --with SCENE               other geometry in the same picture: both shadow and hide each other\n"
    "  --bounce                   light once reflected, too, by the other geometry and the simple model\n"
    "output\n"
    "  -o IMG                     .png .ppm .pfm .hdr\n"
    "  --show full|depth|normal|albedo|lit\n"
    "  --exposure EV              stops (default 0)\n"
    "  --compare MODEL            draws the complex model too, and prints speed and errors side by side\n"
    "  --backend NAME             scalar, sse2, avx2, avx512, neon, simd128: this machine's best by default\n"
    "\n"
    "exit status: 0 done, 1 a file that cannot be read or written, 2 bad usage\n";

enum { BOUNCE_MAP = 256 }; /* texels a side */
enum { SHOW_FULL, SHOW_DEPTH, SHOW_NORMAL, SHOW_ALBEDO, SHOW_LIT };

typedef struct options {
    const char *file, *out, *compare, *with;
    view_options view;
    lmb_relief_how how;
    lmb_light light;
    int has_light, bounce, help;
    int32_t light_map, show;
    float ambient, exposure_ev;
    const lmb_kernels *kernels;
} options;

/* --- command line ------------------------------------------------------------------------------------------------- */

static int parse_out(const char *text, options *o) { return picture_format(o->out = text) != PICTURE_UNKNOWN; }
static int parse_compare(const char *text, options *o) { return (o->compare = text)[0] != '\0'; }
static int parse_with(const char *text, options *o) { return (o->with = text)[0] != '\0'; }
static int parse_eye(const char *text, options *o) { return o->view.has_eye = option_vec3(text, &o->view.eye); }
static int parse_target(const char *text, options *o)
{
    return o->view.has_target = option_vec3(text, &o->view.target);
}
static int parse_up(const char *text, options *o) { return option_vec3(text, &o->view.up); }
static int parse_fov(const char *text, options *o) { return view_option_fov(text, &o->view); }
static int parse_size(const char *text, options *o) { return option_size(text, &o->view.width, &o->view.height); }
static int parse_steps(const char *text, options *o) { return option_int(text, 1, 32, &o->how.steps); }
static int parse_looks(const char *text, options *o) { return option_int(text, 1, LMB_RELIEF_LOOKS, &o->how.views); }
static int parse_keep(const char *text, options *o) { return option_int(text, 1, 3, &o->how.keep); }
static int parse_light(const char *text, options *o) { return o->has_light = option_light(text, &o->light); }
static int parse_ambient(const char *text, options *o) { return option_number(text, 0.0f, 1e6f, &o->ambient); }
static int parse_exposure(const char *text, options *o) { return option_number(text, -64.0f, 64.0f, &o->exposure_ev); }
static int parse_backend(const char *text, options *o) { return (o->kernels = lmb_kernels_named(text)) != NULL; }

static int parse_light_map(const char *text, options *o)
{
    return option_int(text, 0, LMB_MAX_SIDE, &o->light_map) && o->light_map % LMB_TILE == 0;
}

static int parse_pick(const char *text, options *o)
{
    static const char *const words[] = {"p", "eye-ray", NULL}; /* in the order of LMB_RELIEF_ */
    return option_word(text, words, NULL, &o->how.pick);
}

static int parse_sampling(const char *text, options *o)
{
    static const char *const words[] = {"bilinear", "nearest", NULL};
    return option_word(text, words, NULL, &o->how.sampling);
}

static int parse_show(const char *text, options *o)
{
    static const char *const words[] = {"full", "depth", "normal", "albedo", "lit", NULL}; /* in the order of SHOW_ */
    return option_word(text, words, NULL, &o->show);
}

static const struct flag {
    option_name of;
    int (*parse)(const char *text, options *o);
} flags[] = {
    {{"-o", "a file name ending in .png, .ppm, .pfm or .hdr"}, parse_out},
    {{"--eye", "X,Y,Z"}, parse_eye},
    {{"--target", "X,Y,Z"}, parse_target},
    {{"--up", "X,Y,Z"}, parse_up},
    {{"--fov", "degrees over 0 and under 179"}, parse_fov},
    {{"--size", "WxH, each 1 .. 8192"}, parse_size},
    {{"--pick", "p or eye-ray"}, parse_pick},
    {{"--sampling", "bilinear or nearest"}, parse_sampling},
    {{"--steps", "1 .. 32"}, parse_steps},
    {{"--looks", "1 .. 8"}, parse_looks},
    {{"--keep", "1 .. 3"}, parse_keep},
    {{"--light", "spot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER]"}, parse_light},
    {{"--light-map", "a multiple of 8, 0 .. 8192"}, parse_light_map},
    {{"--ambient", "0 or more"}, parse_ambient},
    {{"--with", "a scene's file"}, parse_with},
    {{"--show", "full, depth, normal, albedo or lit"}, parse_show},
    {{"--exposure", "-64 .. 64"}, parse_exposure},
    {{"--compare", "a model's file"}, parse_compare},
    {{"--backend", "scalar, sse2, avx2, avx512, neon or simd128, as far as this machine has it"}, parse_backend},
};

static int parse_one(options *o, char **argv, int *at, report *r)
{
    if (strcmp(argv[*at], "--help") == 0 || strcmp(argv[*at], "-h") == 0) {
        return o->help = 1;
    }
    if (strcmp(argv[*at], "--bounce") == 0) {
        return o->bounce = 1;
    }
    if (argv[*at][0] != '-') {
        if (o->file != NULL) {
            return report_fail(r, "one relief at a time: %s and %s", o->file, argv[*at]);
        }
        o->file = argv[*at];
        return 1;
    }
    const int f = option_find(flags, sizeof *flags, sizeof flags / sizeof *flags, argv, *at, r);
    ++*at;
    return f >= 0 && (flags[f].parse(argv[*at], o) || option_refuse(&flags[f].of, argv[*at], r));
}

static int parse(options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    view_options_init(&o->view);
    o->light_map = 1024;
    o->ambient = 0.3f;
    o->kernels = lmb_kernels_pick();
    for (int i = 1; i < argc && !o->help; ++i) {
        if (!parse_one(o, argv, &i, r)) {
            return 0;
        }
    }
    if (!o->help && o->file == NULL) {
        return report_fail(r, "no relief given; lambent relief bake makes one");
    }
    if (o->compare != NULL && o->with != NULL) {
        return report_fail(r, "--compare draws the complex model alone: without --with");
    }
    return o->help || ((o->out != NULL || report_fail(r, "no output given; add -o FILE.png")) &&
                       view_options_check(&o->view, r));
}

/* --- work --------------------------------------------------------------------------------------------------------- */

typedef struct work {
    file_bytes file;
    lmb_relief relief;
    lmb_scene simple;
    model with, truth;
    triangle_mesh mesh; /* the truth's, for its normals */
    relief_scene flat;
    lmb_scene complex;
    lmb_mesh *meshes;
    lmb_light sun;
} work;

static void work_free(work *w)
{
    file_free(&w->file);
    model_free(&w->with);
    model_free(&w->truth);
    triangle_mesh_free(&w->mesh);
    relief_scene_free(&w->flat);
    free(w->meshes);
    free(w);
}

static int open_relief(work *w, const char *path, report *r)
{
    if (!file_read(&w->file, path, r)) {
        return 0;
    }
    lmb_status status = lmb_relief_swap(w->file.data, w->file.size);
    if (status == LMB_OK) {
        status = lmb_relief_open(&w->relief, w->file.data, w->file.size);
    }
    lmb_relief_scene(&w->simple, &w->relief);
    return status == LMB_OK ||
           report_fail(r, "%s: %s", path, status == LMB_ERR_CAPACITY ? "more views than this build takes"
                                                                     : "not a whole .lmr file of version 1");
}

static int load(model *out, const char *path, report *r)
{
    static model_notes notes;
    memset(&notes, 0, sizeof notes);
    return model_load(out, path, NULL, &notes, r);
}

/* The complex model as it was baked. */
static int load_truth(work *w, const char *path, report *r)
{
    if (!load(&w->truth, path, r) || !relief_flatten(&w->mesh, &w->truth.scene, r) ||
        !relief_scene_of(&w->flat, &w->mesh, r)) {
        return 0;
    }
    w->meshes = malloc((w->truth.scene.mesh_count + 1) * sizeof *w->meshes);
    if (w->meshes == NULL) {
        return report_fail(r, "%s: out of memory", path);
    }
    relief_smooth(&w->complex, w->meshes, &w->truth.scene, &w->flat);
    return 1;
}

static int choose_view(lmb_view *out, const work *w, options *o, report *r)
{
    lmb_view middle;
    if (o->view.has_eye ? !view_look(&middle, &o->view, r) : !view_frame(&middle, &o->view, &w->simple, o->file, r)) {
        return 0;
    }
    middle.near_m = 0.0f;
    *out = view_from(&middle, 0.0f, &w->simple);
    return 1;
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

/* What is shown, three floats a pixel, in place of the frame's light. */
static void show(relief_frame *f, int32_t what)
{
    const size_t pixels = (size_t)f->width * (size_t)f->height;
    for (size_t i = 0; i < pixels && what != SHOW_FULL; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const size_t at = 3 * i + c;
            f->rgb[at] = what == SHOW_ALBEDO   ? f->albedo[at]
                         : what == SHOW_NORMAL ? (f->depth[i] > 0.0f ? 0.5f + 0.5f * f->normal[at] : 0.0f)
                         : what == SHOW_DEPTH  ? f->depth[i]
                                               : (float)f->lit[i];
        }
    }
}

static int write_frame(const options *o, relief_frame *f, report *r)
{
    show(f, o->show);
    const image out = {f->width, f->height, 3, f->rgb};
    const float ev = o->show == SHOW_DEPTH ? picture_auto_exposure(&out) : o->exposure_ev;
    return picture_write(o->out, &out, ev, r);
}

static void tell(const relief_frame *f)
{
    const lmb_relief_stats *s = &f->stats;
    const double n = s->pixels > 0 ? (double)s->pixels : 1.0;
    printf("pixels of the simple model %.0f: hit %.2f %%, passed %.2f %%, holes %.2f %%\n", (double)s->pixels,
           100.0 * (double)s->hits / n, 100.0 * (double)s->missed / n, 100.0 * (double)s->holes / n);
}

static void tell_compared(const relief_frame *f, const relief_frame *truth, const relief_figures *e)
{
    printf("%-22s %12s %12s\n", "", "relief", "direct");
    printf("%-22s %12.2f %12.2f\n", "light's map, ms", 1e3 * f->light_s, 1e3 * truth->light_s);
    printf("%-22s %12.2f %12.2f\n", "triangles, ms", 1e3 * f->draw_s, 1e3 * truth->draw_s);
    printf("%-22s %12.2f %12.2f\n", "pixels, ms", 1e3 * f->band_s, 1e3 * truth->band_s);
    printf("outline %.2f px (median), covered by both %.2f %%\n", e->silhouette_px, 100.0 * e->iou);
    printf("depth %.4f %% of the diagonal (median), %.4f %% (95 of 100)\n", 100.0 * e->depth_50, 100.0 * e->depth_95);
    printf("normals %.2f degrees (median), %.1f (95 of 100)\n", e->normal_50, e->normal_95);
    printf("light %.2f dB, without cast shadows %.2f; reflectance %.2f dB; lit or not as it should %.2f %%\n",
           e->shadowed_db, e->psnr_db, e->albedo_db, 100.0 * e->lit);
}

static double diagonal(const lmb_scene *s)
{
    const double x = (double)(s->bounds_max.x - s->bounds_min.x), y = (double)(s->bounds_max.y - s->bounds_min.y),
                 z = (double)(s->bounds_max.z - s->bounds_min.z);
    return sqrt(x * x + y * y + z * z);
}

static int compare(work *w, relief_shot shot, const relief_frame *f, report *r)
{
    relief_frame truth;
    relief_figures e;
    shot.relief = NULL;
    shot.scene = &w->complex;
    if (!relief_shoot(&truth, &shot, r)) {
        return 0;
    }
    const int ok = relief_measure(&e, f, &truth, diagonal(&w->complex), r);
    if (ok) {
        tell_compared(f, &truth, &e);
    }
    relief_frame_free(&truth);
    return ok;
}

static int render(work *w, options *o, report *r)
{
    relief_shot shot;
    relief_frame f;
    const lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f,
                           LMB_LIGHT_DIRECTIONAL, 0};
    memset(&shot, 0, sizeof shot);
    w->sun = sun;
    if (!file_can_write(o->out, r) || !open_relief(w, o->file, r) ||
        (o->with != NULL && !load(&w->with, o->with, r)) ||
        (o->compare != NULL && !load_truth(w, o->compare, r)) || !choose_view(&shot.view, w, o, r)) {
        return 0;
    }
    shot.kernels = o->kernels;
    shot.relief = &w->relief;
    shot.scene = o->with != NULL ? &w->with.scene : NULL;
    shot.how = o->how;
    shot.light = o->has_light ? &o->light : &w->sun;
    shot.light_map = o->light_map;
    shot.ambient = o->ambient;
    shot.bounce = o->bounce ? BOUNCE_MAP : 0;
    if (!relief_shoot(&f, &shot, r)) {
        return 0;
    }
    tell(&f);
    const int ok = (o->compare == NULL || compare(w, shot, &f, r)) && write_frame(o, &f, r);
    relief_frame_free(&f);
    return ok;
}

static int verb_render_relief(int argc, char **argv)
{
    report r = {""};
    options o;
    if (!parse(&o, argc, argv, &r)) {
        return report_end(&r, "relief render", 2);
    }
    if (o.help) {
        fputs(help_text, stdout);
        return 0;
    }
    work *w = calloc(1, sizeof *w);
    const int ok = w != NULL ? render(w, &o, &r) : report_fail(&r, "out of memory");
    if (w != NULL) {
        work_free(w);
    }
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
    const int help = argc >= 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0);
    fputs(help ? help_text : "lambent relief: bake or render? lambent relief --help tells\n", help ? stdout : stderr);
    return help ? 0 : 2;
}
