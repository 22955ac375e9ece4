/* render_view.c: chooses the view: command line, scene camera, or a view that frames the scene. */
#include "render_view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/view_frame.h"
#include "../demo/demo_scene.h"

const model_camera *render_camera(const render_options *o, const model *m, report *r)
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
    report_fail_usage(r, "--camera: no `%s` in %s, which has %u, numbered from 0", o->camera, o->scene,
                      (unsigned)m->camera_count);
    return NULL;
}

static void use_camera(render_options *o, lmb_view *v, const model_camera *c)
{
    view_size(&o->view, c->aspect);
    float aspect = (float)o->view.width / (float)o->view.height;
    v->eye = c->eye;
    v->right = c->right;
    v->up = c->up;
    v->back = c->back;
    v->kind = c->orthographic ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE;
    v->half_height = c->half_height > 0.0f ? c->half_height : tanf(0.5f * c->yfov_rad);
    v->half_width = v->half_height * aspect;
    v->near_m = c->near_m;
    v->far_m = c->far_m;
    v->frame_width = o->view.width;
    v->frame_height = o->view.height;
}

int render_view(lmb_view *v, render_options *o, const model *loaded, const lmb_scene *scene, report *r)
{
    memset(v, 0, sizeof *v);
    if (o->view.has_eye) {
        if (!view_look(v, &o->view, r)) {
            return 0;
        }
    } else if (strcmp(o->scene, "demo") == 0 && o->camera == NULL) {
        view_size(&o->view, 4.0f / 3.0f);
        *v = demo_view(o->view.width, o->view.height);
    } else {
        const model_camera *c = render_camera(o, loaded, r);
        if (c == NULL && r->text[0] != '\0') {
            return 0;
        }
        if (c == NULL && !view_frame(v, &o->view, scene, o->scene, r)) {
            return 0;
        }
        if (c != NULL) {
            use_camera(o, v, c);
        }
    }
    const int has_own = loaded->camera_count > 0 && !o->view.has_eye;
    v->near_m = o->view.near_m > 0.0f ? o->view.near_m : has_own ? v->near_m : 0.0f;
    return 1;
}
