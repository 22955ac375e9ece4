/* verb_relief_bake.c: `lambent relief bake`: a complex model -> views and a simple model, in one file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/progress.h"
#include "../mesh/enclose.h"
#include "../model/model.h"
#include "relief_bake.h"
#include "relief_compare.h"
#include "relief_model.h"
#include "relief_options.h"
#include "relief_photos.h"
#include "verb_relief.h"

typedef struct options {
    const char *model, *out, *simple, *views_file;
    model_choice choice;
    int32_t views, size, triangles, greedy, is_packed;
    int as_is, is_quiet, is_verbose;
    const char *frame[LMB_RELIEF_VIEWS]; /* of photos */
    int32_t frames;
    float block;
    int32_t threads;
} options;

static int parse_views(const char *text, void *at)
{
    options *o = at;
    o->views_file = NULL;
    if (relief_option_views(text, &o->views, &o->greedy)) {
        return 1;
    }
    o->views_file = text;
    return !o->greedy && text[0] != '\0' && strspn(text, "-0123456789") != strlen(text);
}

#define AT(member) .at = offsetof(options, member)

static const option_row rows[] = {
    {.name = "MODEL", .kind = OPTION_TEXT, .value = "", AT(model), .file = OPTION_READS,
     .help = ".gltf .glb .obj .ply"},
    {.name = "-o", .value = "OUT.lmr", .kind = OPTION_TEXT, AT(out), .file = OPTION_WRITES,
     .help = "file for `lambent relief render`, which draws it in place, from flash too"},
    {.name = "--views", .value = "N|greedy:N|FILE", .kind = OPTION_OWN, .parse = parse_views,
     .expects = "1 .. 64, greedy:N, or a file of cameras",
     .help = "N: from N sides; 6, 14, 18, 26 are a cube's faces, edges and corners (default 26), to 64;\ngreedy:N: "
             "the N of 98 sides that see most;\nFILE: your cameras, one per line: EX EY EZ TX TY TZ FOV (eye, "
             "target, degrees)"},
    RELIEF_OPTIONS_BAKE(options),
    {.name = "--simple", .value = "FILE", .kind = OPTION_TEXT, AT(simple), .file = OPTION_READS,
     .help = "your simple model, close to the complex one; it is moved out where the complex one sticks out"},
    {.name = "--as-is", .kind = OPTION_FLAG, AT(as_is), .help = "leaves it unchanged"},
    {.kind = OPTION_TITLE, .help = "photos"},
    {.name = "--frame", .value = "PREFIX", .kind = OPTION_TEXT, AT(frame), .counts = offsetof(options, frames),
     .times = LMB_RELIEF_VIEWS, .size = sizeof(const char *),
     .help = "a photo as a view: PREFIX.color.png, .depth.png, .json, as in `lambent mix --help`; with "
             "camera_to_world if you give several (y down). `render --show albedo` shows it"},
    {.name = "--block", .value = "M", .kind = OPTION_NUMBER, AT(block), .low = 1e-4, .high = 1e4,
     .help = "the simple model of photos: cubes of this size that hold a point of a photo (default 1/24 of the "
             "longest side)"},
    {.kind = OPTION_TITLE, .help = "other"},
    OPTION_THREADS_ROW(options, threads, "draw the views"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(options, is_quiet, is_verbose, "print the time of each stage"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "relief bake",
    .usage = "relief bake MODEL -o OUT.lmr [options]\n"
             "relief bake --frame PREFIX [--frame PREFIX ...] -o OUT.lmr [--block M] [--packed]",
    .about = "Makes views of a complex model, for drawing it as a simple one that carries its surface. Meshes "
             "without normals are flat-shaded, as in `lambent render`. Prints how much of the surface no view sees: "
             "the simple model's surface fills that part. Also prints time, error and bytes of a picture by the "
             "relief, by the model's mesh and by 60,000 of its triangles, because these meshes are often the better "
             "choice.",
    .part = {rows},
    .examples = "  a tent and its relief:\n"
                "    printf 'v %s\\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >tent.obj\n"
                "    printf 'f %s\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\n"
                "    lambent relief bake tent.obj --size 64 --triangles 8 -o tent.lmr\n",
};

static int parse(options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    o->views = 26;
    o->size = 256;
    o->triangles = 3000;
    const int asked = options_parse(o, &table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    if ((o->model != NULL) == (o->frames > 0)) {
        return report_fail(r, o->frames > 0 ? "a model or photos, not both" : "no model given");
    }
    if (o->as_is && o->simple == NULL) {
        return report_fail(r, "--as-is needs --simple FILE");
    }
    if (o->out == NULL) {
        return report_fail(r, "no output given; add -o FILE.lmr");
    }
    return OPTIONS_RUN;
}

/* --- work --------------------------------------------------------------------------------------------------------- */

typedef struct work {
    model loaded, loaded_simple;
    triangle_mesh mesh, simple;
    lmb_view view[LMB_RELIEF_VIEWS];
    int32_t views;
    relief_bake bake;
    file_bytes file;
    model_notes notes[2]; /* of the complex and the simple model */
} work;

static void work_free(work *w)
{
    model_free(&w->loaded);
    model_free(&w->loaded_simple);
    triangle_mesh_free(&w->mesh);
    triangle_mesh_free(&w->simple);
    relief_bake_free(&w->bake);
    file_free(&w->file);
    free(w);
}

static int load(model *out, triangle_mesh *mesh, const char *path, const options *o, model_notes *notes, report *r)
{
    if (!model_load_as(out, path, &o->choice, notes, r)) {
        return 0;
    }
    return relief_flatten(mesh, &out->scene, r);
}

static void tell_outside(double outside, const options *o)
{
    report_note(o->is_quiet || !(outside > 0.0), "note: the complex model sticks out of the simple one by %.3g m",
                outside);
}

/* Loads the user's simple model and moves it outwards; vertices at one position are merged. */
static int load_simple(work *w, const options *o, report *r)
{
    triangle_mesh own;
    simplify_facts facts;
    counted_heap held = {0, 0};
    double outside = 0.0;
    if (!load(&w->loaded_simple, &own, o->simple, o, &w->notes[1], r)) {
        return 0;
    }
    if (o->as_is) {
        w->simple = own;
    } else {
        const int ok = simplify_mesh(&w->simple, &own, own.triangle_count, SIMPLIFY_NEAR, &facts, r);
        triangle_mesh_free(&own);
        if (!ok) {
            return 0;
        }
    }
    if (!(o->as_is ? mesh_outside : mesh_enclose)(&w->simple, &w->mesh, &outside, &held)) {
        return report_fail(r, "%s: out of memory", o->simple);
    }
    tell_outside(outside, o);
    return 1;
}

static int make_simple(work *w, const options *o, report *r)
{
    simplify_facts facts;
    if (o->simple != NULL) {
        return load_simple(w, o, r);
    }
    if (!simplify_mesh(&w->simple, &w->mesh, (uint32_t)o->triangles, SIMPLIFY_AROUND, &facts, r)) {
        return 0;
    }
    tell_outside(facts.outside, o);
    return 1;
}

/* Reads a line of a file of cameras. Returns 1, 0 if it is malformed, -1 if it is empty. */
static int read_camera(lmb_view *v, const char *line, const work *w, int32_t size)
{
    double f[7];
    char more;
    const char *c = line + strspn(line, " \t\r");
    if (*c == '\0' || *c == '#') {
        return -1;
    }
    if (sscanf(c, "%lf %lf %lf %lf %lf %lf %lf %c", f, f + 1, f + 2, f + 3, f + 4, f + 5, f + 6, &more) != 7 ||
        !(f[6] > 0.0 && f[6] < 179.0)) {
        return 0;
    }
    const lmb_vec3 eye = {(float)f[0], (float)f[1], (float)f[2]}, target = {(float)f[3], (float)f[4], (float)f[5]};
    const lmb_vec3 y = {0.0f, 1.0f, 0.0f}, z = {0.0f, 0.0f, 1.0f};
    const float fov = (float)(f[6] * 0.017453292519943295);
    return (lmb_view_look_at(v, eye, target, y, fov, size, size) == LMB_OK ||
            lmb_view_look_at(v, eye, target, z, fov, size, size) == LMB_OK) &&
           relief_reach(v, &w->mesh);
}

static int read_cameras(work *w, const options *o, report *r)
{
    file_bytes file;
    int number = 0;
    if (!file_read(&file, o->views_file, r)) {
        return 0;
    }
    char *text = malloc(file.size + 1), *line = text;
    if (text != NULL) {
        memcpy(text, file.data, file.size);
        text[file.size] = '\0';
    }
    file_free(&file);
    while (line != NULL && r->text[0] == '\0') {
        char *end = strchr(line, '\n');
        lmb_view v;
        if (end != NULL) {
            *end++ = '\0';
        }
        const int found = read_camera(&v, line, w, o->size);
        ++number;
        if (found == 0 || (found > 0 && w->views == LMB_RELIEF_VIEWS)) {
            report_fail(r, found ? "%s, line %d: over %d cameras" : "%s, line %d: not EX EY EZ TX TY TZ FOV",
                        o->views_file, number, LMB_RELIEF_VIEWS);
        } else if (found > 0) {
            w->view[w->views++] = v;
        }
        line = end;
    }
    free(text);
    return r->text[0] == '\0' && (w->views > 0 || report_fail(r, "%s: no cameras in it", o->views_file));
}

static int choose_views(work *w, const options *o, report *r)
{
    lmb_vec3 direction[LMB_RELIEF_VIEWS];
    if (o->views_file != NULL) {
        return read_cameras(w, o, r);
    }
    relief_directions(direction, o->views);
    if (o->greedy && !relief_greedy(direction, o->views, &w->mesh, &w->loaded.scene, o->size, r)) {
        return 0;
    }
    for (w->views = 0; w->views < o->views; ++w->views) {
        w->view[w->views] = relief_fit(&w->mesh, direction[w->views], o->size);
    }
    return 1;
}

static void tell(const work *w, const options *o, const relief_coverage *c)
{
    report_say("%s: %u triangles as %u, %d views of %d x %d, %.0f bytes\n", o->out, (unsigned)w->mesh.triangle_count,
           (unsigned)w->simple.triangle_count, (int)w->views, (int)o->size, (int)o->size, (double)w->file.size);
    report_say("surface that no view sees: %.2f %%; none within 60 degrees of its normal: %.2f %%\n", 100.0 * c->unseen,
           100.0 * c->slanted);
}

/* --- relief or mesh ----------------------------------------------------------------------------------------------- */

enum { WORTH_SIDE = 512, WORTH_MAP = 1024 };
enum { FEW_TRIANGLES = 60000 }; /* of the simplified mesh that a relief competes with */
#define LEAST_GAIN_DB 0.5       /* smaller differences of two pictures count as none */

static const lmb_light worth_sun = {
    {0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f, LMB_LIGHT_DIRECTIONAL, 0, 0};

/* A way to draw the model, measured. */
typedef struct worth {
    relief_frame frame; /* without shadows */
    double plain_s, whole_s; /* processor time without and with the pass of the shadow map */
    double bytes, db;        /* db: of light without cast shadows, against the model's mesh */
} worth;

/* Draws a picture three times without and with shadows; keeps the shortest times. */
static int measure_worth(worth *out, const relief_shot *shot, report *r)
{
    relief_shot shadowed = *shot;
    out->plain_s = out->whole_s = 1e30;
    shadowed.shadow_map = WORTH_MAP;
    for (int i = 0; i < 3; ++i) {
        relief_frame f;
        if (!relief_shoot(&f, &shadowed, r)) {
            return 0;
        }
        out->whole_s = fmin(out->whole_s, f.light_s + f.draw_s + f.band_s);
        relief_frame_free(&f);
        relief_frame_free(&out->frame);
        if (!relief_shoot(&out->frame, shot, r)) {
            return 0;
        }
        out->plain_s = fmin(out->plain_s, out->frame.draw_s + out->frame.band_s);
    }
    return 1;
}

static double mesh_bytes(const triangle_mesh *m) { return 20.0 * m->vertex_count + 12.0 * m->triangle_count; }

/* Measures the model simplified to FEW_TRIANGLES. */
static int measure_few(worth *out, const relief_shot *shot, const triangle_mesh *mesh, report *r)
{
    triangle_mesh few;
    relief_scene drawn;
    relief_shot by_few = *shot;
    simplify_facts facts;
    if (!simplify_mesh(&few, mesh, FEW_TRIANGLES, SIMPLIFY_NEAR, &facts, r)) {
        return 0;
    }
    int ok = relief_scene_of(&drawn, &few, r);
    if (ok) {
        by_few.scene = &drawn.scene;
        ok = measure_worth(out, &by_few, r);
        relief_scene_free(&drawn);
    }
    out->bytes = mesh_bytes(&few);
    triangle_mesh_free(&few);
    return ok;
}

static void tell_way(const char *name, const worth *of)
{
    char db[32] = "exact";
    if (of->db >= 0.0) {
        snprintf(db, sizeof db, "%.1f", of->db);
    }
    report_say("%-32s %8.1f %13.1f %8s %8.2f\n", name, 1e3 * of->plain_s, 1e3 * of->whole_s, db, of->bytes / 1048576.0);
}

/* Returns the sentence that names the way to draw. `few`: NULL if the model has no more triangles. A mesh of fewer
 * triangles that is no faster than the relief does not count. */
static const char *worth_verdict(const worth *relief, const worth *mesh, const worth *few)
{
    if (mesh->whole_s <= relief->whole_s) {
        return "the mesh is the faster and exact: draw that";
    }
    if (few == NULL || few->whole_s > relief->whole_s) {
        return "the relief is the faster: draw that";
    }
    return few->db > relief->db - LEAST_GAIN_DB
               ? "the mesh of 60,000 triangles is the faster and as near to the model: draw that"
               : "the mesh of 60,000 triangles is the faster, the relief nearer to the model";
}

static void tell_ways(const worth *relief, const worth *mesh, const worth *few, uint32_t triangles)
{
    char name[64];
    report_say("a picture of %d x %d, ms          without shadows  with them       dB      MiB\n", (int)WORTH_SIDE,
               (int)WORTH_SIDE);
    tell_way("the relief", relief);
    if (few != NULL) {
        tell_way("the model as 60000 triangles", few);
    }
    snprintf(name, sizeof name, "the model's %u triangles", (unsigned)triangles);
    tell_way(name, mesh);
    report_say("%s\n", worth_verdict(relief, mesh, few));
}

/* Prints whether the relief is worthwhile: draws a picture from between the views with the relief, with the model's
 * triangles, and with at most FEW_TRIANGLES of them. */
static int tell_worth(const work *w, report *r)
{
    lmb_relief relief;
    relief_shot shot;
    relief_figures e = {.psnr_db = 0.0};
    worth by_relief = {.bytes = (double)w->file.size}, by_mesh = {.bytes = mesh_bytes(&w->mesh), .db = -1.0},
          by_few = {.bytes = 0.0};
    const int is_large = w->mesh.triangle_count > FEW_TRIANGLES;
    memset(&shot, 0, sizeof shot);
    if (lmb_relief_open(&relief, w->file.data, w->file.size) != LMB_OK) {
        return 1; /* more views than this build draws */
    }
    shot.kernels = lmb_kernels_pick();
    shot.view = relief_fit(&w->mesh, (lmb_vec3){0.53f, 0.37f, 0.7628236f}, WORTH_SIDE);
    shot.light = &worth_sun;
    shot.ambient = 1.0f;
    shot.relief = &relief;
    int ok = measure_worth(&by_relief, &shot, r);
    shot.relief = NULL;
    shot.scene = &w->loaded.scene;
    ok = ok && measure_worth(&by_mesh, &shot, r) && relief_measure(&e, &by_relief.frame, &by_mesh.frame, 1.0, r);
    by_relief.db = e.psnr_db;
    ok = ok && (!is_large || (measure_few(&by_few, &shot, &w->mesh, r) &&
                              relief_measure(&e, &by_few.frame, &by_mesh.frame, 1.0, r)));
    by_few.db = e.psnr_db;
    if (ok) {
        tell_ways(&by_relief, &by_mesh, is_large ? &by_few : NULL, w->mesh.triangle_count);
    }
    relief_frame_free(&by_relief.frame);
    relief_frame_free(&by_mesh.frame);
    relief_frame_free(&by_few.frame);
    return ok;
}

/* --- models ------------------------------------------------------------------------------------------------------- */

static int bake(work *w, const options *o, report *r)
{
    relief_coverage coverage;
    if (!options_files(o, &table, r) || !load(&w->loaded, &w->mesh, o->model, o, &w->notes[0], r) ||
        !options_files(o, &table, r) || !choose_views(w, o, r) || !make_simple(w, o, r)) {
        return 0;
    }
    w->bake.format = o->is_packed ? LMB_RELIEF_PACKED : LMB_RELIEF_FULL;
    /* A file of one view: models and views that are too small or too large are refused before the notes. */
    if (!relief_add(&w->bake, &w->loaded.scene, &w->view[0], r) ||
        !relief_encode(&w->file, &w->bake, &w->simple, r)) {
        return 0;
    }
    file_free(&w->file);
    for (int i = 0; i < 2; ++i) {
        model_tell(&w->notes[i], i == 0 ? o->model : o->simple, MODEL_NOTE_OPTION);
    }
    report_print_notes();
    if (!relief_add_views(&w->bake, &w->loaded.scene, w->view + 1, w->views - 1, pool_threads(o->threads), r) ||
        !relief_cover(&coverage, &w->bake, &w->mesh, r) || !relief_encode(&w->file, &w->bake, &w->simple, r) ||
        !file_write(o->out, w->file.data, w->file.size, r)) {
        return 0;
    }
    if (!o->is_quiet) {
        tell(w, o, &coverage);
    }
    report unmeasured = {""}; /* the file is written; errors from here on are ignored */
    return o->is_quiet || tell_worth(w, &unmeasured) || 1;
}

/* --- photos ------------------------------------------------------------------------------------------------------- */

static int add_photos(work *w, const options *o, relief_photo *photo, report *r)
{
    for (int32_t i = 0; i < o->frames; ++i) {
        if (!relief_photo_read(&photo[i], o->frame[i], r)) {
            return 0;
        }
        if (o->frames > 1 && !photo[i].has_pose) {
            return report_fail(r, "%s: no camera_to_world, which several --frame need", o->frame[i]);
        }
    }
    const float side = o->block > 0.0f ? o->block : relief_photo_size(photo, o->frames) / 24.0f;
    if (!relief_blocks(&w->simple, photo, o->frames, side, r)) {
        return 0;
    }
    for (int32_t i = 0; i < o->frames; ++i) {
        const relief_photo *p = &photo[i];
        if (!relief_add_planes(&w->bake, &p->view, p->depth, p->normal, p->colour, 0, r)) {
            return 0;
        }
    }
    return 1;
}

static int bake_photos(work *w, const options *o, report *r)
{
    relief_photo photo[LMB_RELIEF_VIEWS];
    memset(photo, 0, sizeof photo);
    w->bake.format = o->is_packed ? LMB_RELIEF_PACKED : LMB_RELIEF_FULL;
    const int ok = options_files(o, &table, r) && add_photos(w, o, photo, r) &&
                   relief_encode(&w->file, &w->bake, &w->simple, r) &&
                   file_write(o->out, w->file.data, w->file.size, r);
    for (int32_t i = 0; i < o->frames; ++i) {
        relief_photo_free(&photo[i]);
    }
    if (ok && !o->is_quiet) {
        report_say("%s: %d photos on %u triangles, %.0f bytes\n", o->out, (int)o->frames,
               (unsigned)w->simple.triangle_count, (double)w->file.size);
    }
    return ok;
}

int verb_relief_bake(int argc, char **argv)
{
    report r = {""};
    options o;
    const double start = host_seconds();
    const int asked = parse(&o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    work *w = calloc(1, sizeof *w);
    progress_begin(o.is_quiet, "relief bake");
    const int ok = w != NULL ? (o.frames > 0 ? bake_photos : bake)(w, &o, &r) : report_fail(&r, "out of memory");
    if (w != NULL) {
        work_free(w);
    }
    progress_end();
    report_note(!ok || !o.is_verbose, "baked in %.1f s", host_seconds() - start);
    return ok ? 0 : report_end(&r, "relief bake", 1);
}
