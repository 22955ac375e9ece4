/* view_options.h: the view from the command line. */
#ifndef VIEW_OPTIONS_H
#define VIEW_OPTIONS_H

#include <lambent/scene.h>

#include "options.h"
#include "report.h"

typedef struct view_options {
    int32_t width, height; /* 0: default */
    int32_t has_eye, has_target;
    lmb_vec3 eye, target, up;
    float fov_deg, near_m; /* near_m 0: chosen automatically */
    int is_quiet, is_verbose; /* quiet: stderr has only errors; verbose: also prints times */
} view_options;

/* Up +Y, 45 degrees, nothing else chosen. */
void view_options_init(view_options *out);

/* Rows for --size and for a camera: `view` is the view_options member of `type`. */
int view_option_size(const char *text, void *at);
#define VIEW_OPTION_SIZE(type, view, text)                                                                   \
    {.name = "--size", .value = "WxH", .kind = OPTION_OWN, .at = offsetof(type, view), .parse = view_option_size, \
     .expects = "WxH, each 1 .. 8192", .help = HELP(text)}
#define VIEW_OPTIONS_CAMERA(type, view, text)                                                                \
    {.name = "--eye", .kind = OPTION_POINT, .at = offsetof(type, view.eye), .counts = offsetof(type, view.has_eye), \
     .help = HELP(text)},                                                                                          \
    {.name = "--target", .kind = OPTION_POINT, .at = offsetof(type, view.target),                            \
     .counts = offsetof(type, view.has_target), .help = HELP("point to look at")},                                 \
    {.name = "--up", .kind = OPTION_POINT, .at = offsetof(type, view.up), \
     .help = HELP("up direction (default 0,1,0)")},                                                                \
    {.name = "--fov", .value = "DEG", .kind = OPTION_ABOVE, .at = offsetof(type, view.fov_deg), .low = 0.0,  \
     .high = 178.999, .help = HELP("vertical angle of view, degrees (default 45)")},                              \
    {.name = "--near", .value = "METRES", .kind = OPTION_NUMBER, .at = offsetof(type, view.near_m), .low = 1e-6, \
     .high = 1e6, .help = HELP("near plane: nearer surfaces are clipped (default: from the file's camera, else "      \
                               "0.1 mm or less)")}

/* view_options_check: whether the options fit together. Returns 1, or 0 with `r` set. */
int view_options_check(const view_options *o, report *r);

/* view_size: if no size was given, sets height 480, and the width from an aspect ratio (0: 4 / 3). */
void view_size(view_options *o, float aspect);

/* view_look: a view from --eye to --target; sets an open size, but not near_m. Returns 1, or 0 with `r` set. */
int view_look(lmb_view *out, view_options *o, report *r);

/* view_from: moves `middle` right_m metres to the right and sets the far plane for the new position. If near_m is 0, it
 * chooses a near plane of at most 0.1 mm; the precision of depth does not depend on it. */
lmb_view view_from(const lmb_view *middle, float right_m, const lmb_scene *scene);

#endif
