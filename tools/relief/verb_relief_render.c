/* verb_relief_render.c: `lambent relief render`: draws a complex model as a simple one that carries its surface. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
#include "verb_relief.h"

enum { BOUNCE_MAP = 256 }; /* texels per side */
#define NEARER 0.1f /* of a photo's nearest depth: nothing before that is drawn */

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
    if (!relief_has_world(o)) {
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
    if (!options_files(o, &relief_table, r) || !open_reliefs(w, o, r) ||
        (o->with != NULL && !load(&w->with, o->with, o, r)) ||
        (o->compare != NULL && !load(&w->complex, o->compare, o, r)) || !options_files(o, &relief_table, r) ||
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
    if (!open_sky(&shot, w, o, r) || !options_files(o, &relief_table, r)) { /* photo and world are inputs, too */
        return 0;
    }
    report_note(o->view.is_quiet || !o->bounce || shot.light != NULL,
                "note: --bounce reflects only a sun or lamp, and there is none; add --light");
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

int verb_relief_render(int argc, char **argv)
{
    report r = {""};
    relief_options o;
    const int asked = relief_options_parse(&o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &relief_table, &r);
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
