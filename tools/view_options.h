/* view_options.h: where a picture is taken from: by the command line, or so that a scene fits. */
#ifndef VIEW_OPTIONS_H
#define VIEW_OPTIONS_H

#include <lambent/scene.h>

#include "report.h"

typedef struct view_options {
    int32_t width, height; /* 0: default */
    int has_eye, has_target;
    lmb_vec3 eye, target, up;
    float fov_deg;
    int is_quiet; /* nothing is said on stderr */
} view_options;

/* Up +Y, 45 degrees, nothing else chosen. */
void view_options_init(view_options *out);

/* --fov: over 0 and under 179. 1, or 0 where the text is none. */
int view_option_fov(const char *text, view_options *o);

/* Does what was given go together? 1, or 0 with `r` set. */
int view_options_check(const view_options *o, report *r);

/* view_size: where no size was given: height 480, width by an aspect (0: 4 / 3). */
void view_size(view_options *o, float aspect);

/* view_look: from --eye to --target. view_frame: the whole scene, from a little above and to the side; says so on
 * stderr, where `name` is the scene's. Both set the size where it was left open, but not near_m. 1, or 0 with `r`
 * set. */
int view_look(lmb_view *out, view_options *o, report *r);
int view_frame(lmb_view *out, view_options *o, const lmb_scene *scene, const char *name, report *r);

/* view_from: `middle` moved right_m metres to its right, with the near and far plane of where it then stands. */
lmb_view view_from(const lmb_view *middle, float right_m, const lmb_scene *scene);

#endif
