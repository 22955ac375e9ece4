/* verb_capture.c: `lambent capture`: a place of a scene as the world of `lambent relight`. */
#include "verb_capture.h"

#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/frame_name.h"
#include "../common/progress.h"
#include "../picture/picture.h"
#include "../render/render_draw.h"
#include "capture_options.h"

#define BELOW 0.01f /* of the scene's height: what far worlds keep from the ground */
#define CUT 0.05f /* of the place's height over the ground: what stands higher is not seen from above */

enum { NAME = 4096 };

/* One run. */
typedef struct capture {
    capture_options o;
    render_job job;
    image cube, ground; /* of one place; of all */
    double pictures, done;
} capture;

/* --- views -------------------------------------------------------------------------------------------------------- */

/* Of a face: where it looks, and where its columns and rows go, as lambent/probe.h says. */
static const float face_axes[6][3][3] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},   {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
};

static lmb_vec3 minus(const float v[3]) { return (lmb_vec3){0.0f - v[0], 0.0f - v[1], 0.0f - v[2]}; }

/* Faces are seen from inside, so their columns run against a view's right. */
static void look_at_face(lmb_view *v, lmb_vec3 at, int face)
{
    v->eye = at;
    v->back = minus(face_axes[face][0]);
    v->right = minus(face_axes[face][1]);
    v->up = minus(face_axes[face][2]);
    v->kind = LMB_PERSPECTIVE;
    v->half_width = v->half_height = 1.0f;
    v->near_m = 0.0f;
}

/* From above, from where objects on the ground are cut off. */
static void look_down(lmb_view *v, const capture_options *o)
{
    v->eye = (lmb_vec3){o->ground_centre[0], o->ground_y + CUT * (o->at[0].y - o->ground_y), o->ground_centre[1]};
    v->back = (lmb_vec3){0, 1, 0};
    v->right = (lmb_vec3){1, 0, 0};
    v->up = (lmb_vec3){0, 0, -1};
    v->kind = LMB_ORTHOGRAPHIC;
    v->half_width = 0.5f * o->ground_size[0];
    v->half_height = 0.5f * o->ground_size[1];
    v->near_m = 0.0f;
    v->far_m = 0.0f;
}

/* What the options leave open of the ground. */
static int place_ground(capture_options *o, const lmb_scene *s, report *r)
{
    const lmb_vec3 low = s->bounds_min, high = s->bounds_max;
    if (!o->has_ground_size) {
        o->ground_size[0] = high.x - low.x;
        o->ground_size[1] = high.z - low.z;
    }
    if (!o->has_ground_centre) {
        o->ground_centre[0] = 0.5f * (low.x + high.x);
        o->ground_centre[1] = 0.5f * (low.z + high.z);
    }
    o->ground_y = o->has_ground_y ? o->ground_y : low.y;
    if (!(o->ground_size[0] > 0.0f && o->ground_size[1] > 0.0f)) {
        return report_fail(r, "--ground: the scene has no width or no depth; add --ground-size W,D");
    }
    return o->at[0].y > o->ground_y ||
           report_fail(r, "--ground: %g m is not below the place; add --ground-height H", (double)o->ground_y);
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static int draw(capture *c, report *r)
{
    progress_whole("pictures", c->done++ / c->pictures);
    return render_draw(&c->job, r);
}

static int take(image *out, int32_t width, int32_t height, report *r)
{
    out->width = width;
    out->height = height;
    out->channels = 3;
    out->pixels = malloc(3 * sizeof(float) * (size_t)width * (size_t)height);
    return out->pixels != NULL || report_fail(r, "not enough memory; try fewer --faces");
}

static void put_face(image *cube, int face, const image *seen)
{
    const int32_t n = seen->width;
    for (int32_t at = 0; at < n * n; ++at) {
        const int32_t x = at % n, y = at / n;
        memcpy(cube->pixels + 3 * ((size_t)(face * n + y) * (size_t)n + (size_t)(n - 1 - x)),
               seen->pixels + 3 * (size_t)at, 3 * sizeof *cube->pixels);
    }
}

static int draw_cube(capture *c, lmb_vec3 at, report *r)
{
    for (int face = 0; face < 6; ++face) {
        look_at_face(&c->job.middle, at, face);
        if (!draw(c, r)) {
            return 0;
        }
        put_face(&c->cube, face, &c->job.linear);
    }
    return 1;
}

static int draw_ground(capture *c, report *r)
{
    if (c->o.ground == NULL) {
        return 1;
    }
    look_down(&c->job.middle, &c->o);
    if (!take(&c->ground, c->o.faces, c->o.faces, r) || !draw(c, r)) {
        return 0;
    }
    memcpy(c->ground.pixels, c->job.linear.pixels,
           3 * sizeof(float) * (size_t)c->ground.width * (size_t)c->ground.height);
    return 1;
}

static int write_cube(capture *c, int32_t i, report *r)
{
    char name[NAME];
    if (c->o.at_count == 1) {
        return picture_write(c->o.render.out, &c->cube, 0.0f, PICTURE_CLIPPED, r);
    }
    return frame_name(name, sizeof name, c->o.render.out, i, r) &&
           picture_write(name, &c->cube, 0.0f, PICTURE_CLIPPED, r);
}

/* --- what relight is to be told ----------------------------------------------------------------------------------- */

static int is_within(lmb_vec3 a, lmb_vec3 low, lmb_vec3 high)
{
    return a.x > low.x && a.y > low.y && a.z > low.z && a.x < high.x && a.y < high.y && a.z < high.z;
}

/* The far world is the scene's box where all places lie in it; below a ground's picture, which would share its bottom
 * with it pixel by pixel. */
static void tell(const capture *c)
{
    const capture_options *o = &c->o;
    lmb_vec3 low = c->job.scene.bounds_min;
    const lmb_vec3 high = c->job.scene.bounds_max;
    int inside = 1;
    low.y -= o->ground != NULL ? BELOW * (high.y - low.y) : 0.0f;
    for (int32_t i = 0; i < o->at_count; ++i) {
        char name[NAME];
        report unread = {""};
        const char *file =
            o->at_count > 1 && frame_name(name, sizeof name, o->render.out, i, &unread) ? name : o->render.out;
        report_say("--world %s --world-centre %.9g,%.9g,%.9g%s", file, (double)o->at[i].x, (double)o->at[i].y,
                   (double)o->at[i].z, i + 1 < o->at_count ? " " : "");
        inside &= is_within(o->at[i], low, high);
    }
    if (inside) {
        report_say(" --world-box %.9g,%.9g,%.9g,%.9g,%.9g,%.9g", (double)low.x, (double)low.y, (double)low.z,
                   (double)high.x, (double)high.y, (double)high.z);
    }
    if (o->ground != NULL) {
        report_say(" --ground %s --ground-size %.9g,%.9g --ground-centre %.9g,%.9g --ground-height %.9g", o->ground,
                   (double)o->ground_size[0], (double)o->ground_size[1], (double)o->ground_centre[0],
                   (double)o->ground_centre[1], (double)o->ground_y);
    }
    report_say("\n");
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

/* The size of a face, and a first view, which is the same to the scene's lights as any. */
static void set_view(capture *c)
{
    view_options *v = &c->job.o.view;
    v->width = v->height = c->o.faces;
    v->has_eye = v->has_target = 1;
    v->eye = c->o.at[0];
    v->target = (lmb_vec3){v->eye.x, v->eye.y, v->eye.z - 1.0f};
}

static int capture_all(capture *c, report *r)
{
    const double start = host_seconds();
    c->job.o = c->o.render;
    set_view(c);
    if (!options_files(&c->o, &capture_table, r) || !render_job_load(&c->job, r) ||
        !options_files(&c->o, &capture_table, r) || !render_job_set(&c->job, r) ||
        (c->o.ground != NULL && !place_ground(&c->o, &c->job.scene, r)) ||
        !take(&c->cube, c->o.faces, 6 * c->o.faces, r)) {
        return 0;
    }
    const double ready = host_seconds();
    c->pictures = 6.0 * c->o.at_count + (c->o.ground != NULL);
    if (!draw_ground(c, r)) {
        return 0;
    }
    for (int32_t i = 0; i < c->o.at_count; ++i) {
        if (!draw_cube(c, c->o.at[i], r) || !write_cube(c, i, r)) {
            return 0;
        }
    }
    if (c->o.ground != NULL && !picture_write(c->o.ground, &c->ground, 0.0f, PICTURE_CLIPPED, r)) {
        return 0;
    }
    report_note(!c->o.render.view.is_verbose, "reading %.1f ms, pictures %.1f ms", (ready - start) * 1e3,
                (host_seconds() - ready) * 1e3);
    if (!c->o.render.view.is_quiet) {
        tell(c);
    }
    return report_flush(r);
}

int verb_capture(int argc, char **argv)
{
    report r = {""};
    static capture c; /* too large for a small stack: the options hold 64 lights */
    memset(&c, 0, sizeof c);
    const int asked = capture_options_parse(&c.o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &capture_table, &r);
    }
    progress_begin(c.o.render.view.is_quiet, "capture");
    const int ok = capture_all(&c, &r);
    progress_end();
    image_free(&c.cube);
    image_free(&c.ground);
    render_job_free(&c.job);
    return ok ? 0 : report_end(&r, "capture", 1);
}
