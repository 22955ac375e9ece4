/* view_options.c: views from the command line. */
#include "view_options.h"

#include <math.h>
#include <string.h>

#include "option_value.h"

#define MOST_NEAR 1e-4f /* m */

/* --- command line ------------------------------------------------------------------------------------------------- */

void view_options_init(view_options *out)
{
    memset(out, 0, sizeof *out);
    out->up.y = 1.0f;
    out->fov_deg = 45.0f;
}

int view_option_size(const char *text, void *at)
{
    view_options *o = at;
    return option_size(text, &o->width, &o->height);
}

int view_options_check(const view_options *o, report *r)
{
    if (o->has_eye != o->has_target) {
        return report_fail(r, "--eye and --target go together");
    }
    return !o->has_eye || memcmp(&o->eye, &o->target, sizeof o->eye) != 0 ||
           report_fail(r, "--eye and --target are one place; the view has no direction");
}

/* --- views -------------------------------------------------------------------------------------------------------- */

void view_size(view_options *o, float aspect)
{
    if (o->width == 0) {
        o->height = 480;
        o->width = (int32_t)lrintf(480.0f * (aspect > 0.0f ? aspect : 4.0f / 3.0f));
        o->width = o->width < 1 ? 1 : o->width > LMB_MAX_SIDE ? LMB_MAX_SIDE : o->width;
    }
}

/* The largest coordinate, m. */
static float reach_of(lmb_vec3 p) { return fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z))); }

int view_look(lmb_view *v, view_options *o, report *r)
{
    view_size(o, 0.0f);
    if (fmaxf(reach_of(o->eye), reach_of(o->target)) > 1048576.0f) {
        return report_fail_usage(r, "the eye, or what it looks at, lies over 1048576 m from the origin");
    }
    return lmb_view_look_at(v, o->eye, o->target, o->up, o->fov_deg * 0.017453293f, o->width, o->height) == LMB_OK ||
           report_fail_usage(r, "--eye, --target and --up do not make a view: they must not lie on one line");
}

static lmb_vec3 bounds_corner(const lmb_scene *s, int i)
{
    lmb_vec3 c = {i & 1 ? s->bounds_max.x : s->bounds_min.x, i & 2 ? s->bounds_max.y : s->bounds_min.y,
                  i & 4 ? s->bounds_max.z : s->bounds_min.z};
    return c;
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

/* Returns a ten-thousandth of the visible distance, halved until it is at most MOST_NEAR, so that a sign in front of
 * the eye is visible in any landscape. Depth is near / w as a float, so halving keeps the fractions and therefore the
 * visibility. */
static float near_of(float reach)
{
    float near_m = 1e-4f * reach;
    while (near_m > MOST_NEAR && near_m < 1e30f) { /* beyond this, no view is valid */
        near_m *= 0.5f;
    }
    return near_m;
}

lmb_view view_from(const lmb_view *middle, float right_m, const lmb_scene *scene)
{
    lmb_view v = *middle;
    v.eye.x += right_m * v.right.x;
    v.eye.y += right_m * v.right.y;
    v.eye.z += right_m * v.right.z;
    float reach = fmaxf(from_eye(scene, v.eye), 1e-4f);
    v.near_m = v.near_m > 0.0f ? v.near_m : near_of(reach);
    v.far_m = v.kind == LMB_ORTHOGRAPHIC && v.far_m > v.near_m ? v.far_m : v.near_m + 2.0f * reach;
    return v;
}
