/* relief_path.c: pictures of a relief along a path of keys. */
#include "relief_path.h"

#include <math.h>

#include "../common/frame_name.h"
#include "../common/io_file.h"
#include "../common/option_value.h"
#include "../common/progress.h"

enum { MOST = 1000000, NAME = 4096 };
#define FPS 30.0f
#define LEAST_M 1e-6f /* between a moving thing and the target */

#define AT(member) .at = offsetof(relief_options, member)

const option_row relief_path_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("motion")},
    {.name = "--path", .value = "FILE", .kind = OPTION_TEXT, AT(path), .file = OPTION_READS,
     .help = HELP("motion of camera and light by keys: lines of TIME camera|light X,Y,Z [X,Y,Z], as in `lambent play`: "
             "one picture per frame, numbered by OUT's %0Nd, as frame_%04d.png, or else by -0000, -0001, ...")},
    {.name = "--frames", .value = "N", .kind = OPTION_INT, AT(frames), .low = 1, .high = MOST,
     .help = HELP("how many (default: to the path's last key)")},
    {.name = "--fps", .value = "F", .kind = OPTION_ABOVE, AT(fps), .low = 0.0, .high = 1e5,
     .help = HELP("frames per second of the path: frame k is at k / F seconds (default 30)")},
    {.kind = OPTION_END},
};

int relief_path_check(const relief_options *o, report *r)
{
    if (o->path == NULL) {
        return frame_digits(o->out) > 0 ? report_fail(r, "%s: numbers pictures of a --path, and none is given", o->out)
               : o->frames > 0 || o->fps > 0.0f ? report_fail(r, "--frames and --fps are of a --path; none is given")
                                                 : 1;
    }
    if (file_is_stdout(o->out)) {
        return report_fail(r, "--path draws a picture a frame: give -o a file name");
    }
    return o->compare == NULL || report_fail(r, "--compare is of one picture: leave --path out");
}

/* --- a picture ---------------------------------------------------------------------------------------------------- */

typedef struct tour {
    relief_options *o;
    relief_shot *shot;
    lmb_light *light;
    lmb_light light_at_rest;
    lmb_view view_at_rest;
    const lmb_scene *simple;
    const key_path *path;
} tour;

static lmb_vec3 towards(const path_key *key)
{
    const lmb_vec3 d = {key->target.x - key->at.x, key->target.y - key->at.y, key->target.z - key->at.z};
    const float length = sqrtf(d.x * d.x + d.y * d.y + d.z * d.z), per = length > LEAST_M ? 1.0f / length : 0.0f;
    return (lmb_vec3){d.x * per, d.y * per, d.z * per};
}

/* Without a target the direction of view stays. */
static int put_camera(tour *w, const path_key *key, int32_t k, report *r)
{
    lmb_view v = w->view_at_rest;
    if (key->has_target && lmb_view_look_at(&v, key->at, key->target, w->o->view.up, w->o->view.fov_deg * 0.017453293f,
                                            v.frame_width, v.frame_height) != LMB_OK) {
        return report_fail(r, "%s: at frame %d the camera looks along what is up for it; give another --up", w->o->path,
                           (int)k);
    }
    v.eye = key->at;
    v.near_m = w->o->view.near_m;
    w->shot->view = view_from(&v, 0.0f, w->simple);
    return 1;
}

static void put_light(tour *w, const path_key *key)
{
    *w->light = w->light_at_rest;
    if (w->light->kind != LMB_LIGHT_DIRECTIONAL) {
        w->light->position = key->at;
    }
    if (key->has_target) {
        w->light->direction = towards(key);
    }
}

static float fps_of(const relief_options *o) { return o->fps > 0.0f ? o->fps : FPS; }

static int put(tour *w, int32_t k, report *r)
{
    const double time_s = (double)k / (double)fps_of(w->o);
    int ok = 1;
    for (uint32_t t = 0; ok && t < w->path->track_count; ++t) {
        const key_track *track = &w->path->track[t];
        const path_key key = key_path_at(w->path, track, time_s);
        const lmb_vec3 to = towards(&key);
        if (key.has_target && to.x == 0.0f && to.y == 0.0f && to.z == 0.0f) {
            return report_fail(r, "%s: at frame %d what line %u moves stands at its own target; move one of its keys",
                               w->o->path, (int)k, (unsigned)track->line);
        }
        if (track->what == KEY_LIGHT) {
            put_light(w, &key);
        } else {
            ok = put_camera(w, &key, k, r);
        }
    }
    return ok;
}

/* --- before the first picture ------------------------------------------------------------------------------------- */

int relief_path_open(key_path *out, const relief_options *o, const lmb_light *light, report *r)
{
    if (o->path == NULL || !key_path_read(out, o->path, r)) {
        return o->path == NULL;
    }
    for (uint32_t t = 0; t < out->track_count; ++t) {
        const key_track *track = &out->track[t];
        if (track->what == KEY_OBJECT || track->index > 0) {
            return report_fail(r, "%s:%u: a relief has a camera and a light that move, and nothing else", o->path,
                               (unsigned)track->line);
        }
        if (track->what == KEY_CAMERA && o->view.has_eye && out->key[track->first].has_target) {
            return report_fail(r, "%s:%u: the camera goes and looks by these keys; leave --eye and --target out",
                               o->path, (unsigned)track->line);
        }
        if (track->what == KEY_LIGHT && light->kind == LMB_LIGHT_DIRECTIONAL && !out->key[track->first].has_target) {
            return report_fail(r, "%s:%u: the light is a sun, which has only a direction; give its keys a target",
                               o->path, (unsigned)track->line);
        }
    }
    return 1;
}

int relief_path_leads(const key_path *path, int what)
{
    int leads = 0;
    for (uint32_t t = 0; t < path->track_count; ++t) {
        leads |= path->track[t].what == what;
    }
    return leads;
}

/* Tests all names and views first, so that errors are reported before anything is drawn. */
static int can_draw(tour *w, int32_t frames, report *r)
{
    int ok = frames_can_write(w->o->out, frames, r);
    for (int32_t i = 0; ok && i < frames; ++i) {
        ok = put(w, i, r);
    }
    return ok;
}

static int count_frames(int32_t *out, const relief_options *o, const key_path *path, report *r)
{
    const double count = ceil(key_path_end(path) * (double)fps_of(o) - 1e-6) + 1.0;
    *out = o->frames > 0 ? o->frames : (int32_t)fmin(count, MOST);
    return o->frames > 0 || count <= MOST ||
           report_fail(r,
                       "%s: %.0f pictures to its last key, of which %d can be drawn; give --frames, or a lower --fps",
                       o->path, count, (int)MOST);
}

static int draw(tour *w, int32_t frames, relief_write *write, report *r)
{
    char name[NAME];
    relief_frame f;
    double light_s = 0.0, draw_s = 0.0, band_s = 0.0;
    int ok = 1;
    for (int32_t i = 0; ok && i < frames; ++i) {
        progress_whole("pictures", (double)i / (double)frames);
        if (!put(w, i, r) || !frame_numbered(name, sizeof name, w->o->out, i, r) || !relief_shoot(&f, w->shot, r)) {
            return 0;
        }
        light_s += f.light_s;
        draw_s += f.draw_s;
        band_s += f.band_s;
        ok = write(w->o, &f, name, r);
        relief_frame_free(&f);
        if (ok && !w->o->view.is_quiet) {
            report_say("%s\n", name);
        }
    }
    report_note(!ok || !w->o->view.is_verbose,
                "a picture in the mean: shadow map %.2f ms, triangles %.2f ms, pixels %.2f ms", 1e3 * light_s / frames,
                1e3 * draw_s / frames, 1e3 * band_s / frames);
    return ok && report_flush(r);
}

int relief_along(relief_options *o, const key_path *path, relief_shot *shot, lmb_light *light, const lmb_scene *simple,
                 relief_write *write, report *r)
{
    tour w = {o, shot, light, *light, shot->view, simple, path};
    int32_t frames;
    return count_frames(&frames, o, path, r) && can_draw(&w, frames, r) && draw(&w, frames, write, r);
}
