/* render_view.c: where a picture is taken from: the command line, the scene's cameras, or a view that frames it all. */
#include "render_view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "demo_scene.h"

/* Width from the height and an aspect. */
static void choose_size(render_options *o, float aspect)
{
    if (o->width == 0) {
        o->height = 480;
        o->width = (int32_t)lrintf(480.0f * (aspect > 0.0f ? aspect : 4.0f / 3.0f));
        o->width = o->width < 1 ? 1 : o->width > LMB_MAX_SIDE ? LMB_MAX_SIDE : o->width;
    }
}

static lmb_vec3 bounds_corner(const lmb_scene *s, int i)
{
    lmb_vec3 c = {i & 1 ? s->bounds_max.x : s->bounds_min.x, i & 2 ? s->bounds_max.y : s->bounds_min.y,
                  i & 4 ? s->bounds_max.z : s->bounds_min.z};
    return c;
}

static float along(lmb_vec3 axis, lmb_vec3 a, lmb_vec3 b)
{
    return axis.x * (a.x - b.x) + axis.y * (a.y - b.y) + axis.z * (a.z - b.z);
}

/* How far back the eye must stand from `centre` for every corner of the bounds to fit, with a little air. */
static float fitting_distance(const lmb_scene *s, const lmb_view *v, lmb_vec3 centre)
{
    float away = 0.0f;
    for (int i = 0; i < 8; ++i) {
        lmb_vec3 c = bounds_corner(s, i);
        float wide = fabsf(along(v->right, c, centre)) / v->half_width,
              high = fabsf(along(v->up, c, centre)) / v->half_height;
        away = fmaxf(away, along(v->back, c, centre) + 1.05f * fmaxf(wide, high));
    }
    return away;
}

/* The whole scene, from a little above and to the side. */
static int frame_scene(render_options *o, const lmb_scene *scene, lmb_view *v, report *r)
{
    lmb_vec3 lo = scene->bounds_min, hi = scene->bounds_max;
    lmb_vec3 centre = {(lo.x + hi.x) * 0.5f, (lo.y + hi.y) * 0.5f, (lo.z + hi.z) * 0.5f};
    lmb_vec3 from = {centre.x + 0.45f, centre.y + 0.35f, centre.z + 0.82f};
    choose_size(o, 0.0f);
    if (!(hi.x > lo.x || hi.y > lo.y || hi.z > lo.z)) {
        return report_fail(r, "%s: nothing to see: the scene has no extent", o->scene);
    }
    if (lmb_view_look(v, from, centre, o->up, 0.698f, o->width, o->height) != LMB_OK) {
        return report_fail(r, "%s: no view frames the scene; give --eye and --target", o->scene);
    }
    float away = fitting_distance(scene, v, centre);
    v->eye.x = centre.x + away * v->back.x;
    v->eye.y = centre.y + away * v->back.y;
    v->eye.z = centre.z + away * v->back.z;
    fprintf(stderr, "lambent: no camera in %s: framing the scene from %.4g,%.4g,%.4g\n", o->scene, (double)v->eye.x,
            (double)v->eye.y, (double)v->eye.z);
    return 1;
}

static const model_camera *find_camera(const render_options *o, const model *m, report *r)
{
    char *end;
    long n;
    if (o->camera == NULL) {
        return m->camera_count > 0 ? &m->cameras[0] : NULL;
    }
    for (uint32_t i = 0; i < m->camera_count; ++i) {
        if (strcmp(m->cameras[i].name, o->camera) == 0) {
            return &m->cameras[i];
        }
    }
    n = strtol(o->camera, &end, 10);
    if (*end == '\0' && n >= 0 && n < (long)m->camera_count) {
        return &m->cameras[n];
    }
    report_fail(r, "%s: no camera `%s`; it has %u, numbered from 0", o->scene, o->camera, (unsigned)m->camera_count);
    return NULL;
}

static void use_camera(render_options *o, lmb_view *v, const model_camera *c)
{
    choose_size(o, c->aspect);
    float aspect = (float)o->width / (float)o->height;
    v->eye = c->eye;
    v->right = c->right;
    v->up = c->up;
    v->back = c->back;
    v->kind = c->orthographic ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE;
    v->half_height = c->orthographic ? c->half_height : tanf(0.5f * c->yfov_rad);
    v->half_width = v->half_height * aspect;
    v->near_m = c->near_m;
    v->far_m = c->far_m;
    v->frame_width = o->width;
    v->frame_height = o->height;
}

static float from_eye(const lmb_scene *s, lmb_vec3 eye)
{
    float far2 = 0.0f;
    for (int i = 0; i < 8; ++i) {
        lmb_vec3 c = bounds_corner(s, i);
        far2 =
            fmaxf(far2, (c.x - eye.x) * (c.x - eye.x) + (c.y - eye.y) * (c.y - eye.y) + (c.z - eye.z) * (c.z - eye.z));
    }
    return sqrtf(far2);
}

int render_view(lmb_view *v, render_options *o, const model *loaded, const lmb_scene *scene, report *r)
{
    memset(v, 0, sizeof *v);
    if (o->has_eye) {
        choose_size(o, 0.0f);
        if (lmb_view_look(v, o->eye, o->target, o->up, o->fov_deg * 0.017453293f, o->width, o->height) != LMB_OK) {
            return report_fail(r, "--eye, --target and --up do not make a view: they must not lie on one line");
        }
    } else if (strcmp(o->scene, "demo") == 0 && o->camera == NULL) {
        choose_size(o, 4.0f / 3.0f);
        *v = demo_view(o->width, o->height);
    } else {
        const model_camera *c = find_camera(o, loaded, r);
        if (c == NULL && r->text[0] != '\0') {
            return 0;
        }
        if (c == NULL && !frame_scene(o, scene, v, r)) {
            return 0;
        }
        if (c != NULL) {
            use_camera(o, v, c);
        }
    }
    v->near_m = loaded->camera_count > 0 && !o->has_eye ? v->near_m : 0.0f;
    return 1;
}

/* A near plane of the scene's own size where none is given: a ten-thousandth of what is seen. */
lmb_view render_view_from(const lmb_view *middle, float right_m, const lmb_scene *scene)
{
    lmb_view v = *middle;
    v.eye.x += right_m * v.right.x;
    v.eye.y += right_m * v.right.y;
    v.eye.z += right_m * v.right.z;
    float reach = fmaxf(from_eye(scene, v.eye), 1e-4f);
    v.near_m = v.near_m > 0.0f ? v.near_m : 1e-4f * reach;
    v.far_m = v.kind == LMB_ORTHOGRAPHIC && v.far_m > v.near_m ? v.far_m : v.near_m + 2.0f * reach;
    return v;
}
