/* relief_options.h: rows of options shared by `lambent relief bake`, `relief render` and `lambent-bench relief`. */
#ifndef RELIEF_OPTIONS_H
#define RELIEF_OPTIONS_H

#include <lambent/relief.h>

#include "../common/option_value.h"
#include "../common/options.h"
#include "../common/view_options.h"
#include "../model/model.h"
#include "../render/render_options.h"

/* How a relief is baked: int32_t size, triangles, is_packed of a struct of the type. */
#define RELIEF_OPTIONS_BAKE(type)                                                                            \
    OPTION_VERTEX_COLOURS_ROW(type, choice.vertex_colours),                                                  \
    {.name = "--size", .value = "PX", .kind = OPTION_INT, .at = offsetof(type, size), .low = 8, .high = 4096, \
     .help = HELP("texels per side of a view (default 256)")},                                                       \
    {.name = "--packed", .kind = OPTION_FLAG, .at = offsetof(type, is_packed),                               \
     .help = HELP("6 bytes per texel instead of 12: 16 bits of depth, 5 6 5 of colour, 2 x 8 of normal")},           \
    {.name = "--triangles", .value = "N", .kind = OPTION_INT, .at = offsetof(type, triangles), .low = 4,     \
     .high = 10000000,                                                                                       \
     .help = HELP("of the simple model (default 3000), made by edge collapse so that it encloses the complex one; " \
             "parts that stick out are cut off")}

/* How pixels search the surface: lmb_relief_how `how`. */
#define RELIEF_OPTIONS_LOOK(type)                                                                            \
    {.name = "--steps", .value = "N", .kind = OPTION_INT, .at = offsetof(type, how.steps), .low = 1, .high = 32, \
     .help = HELP("search steps per pixel (default 6); 1: one, from the simple surface")},                           \
    {.name = "--pixel-views", .value = "N", .kind = OPTION_INT, .at = offsetof(type, how.views), .low = 1,         \
     .high = LMB_RELIEF_TILE_VIEWS, .help = HELP("views searched per pixel (default 6)")},                      \
    {.name = "--keep", .value = "N", .kind = OPTION_INT, .at = offsetof(type, how.keep), .low = 1, .high = 3, \
     .help = HELP("number of the best of these that are blended (default 3)")}

/* The picture of --show, in the order of its words. */
enum { PLANE_FULL, PLANE_DEPTH, PLANE_NORMAL, PLANE_ALBEDO, PLANE_LIT };

/* The example of the help: makes tent.lmr. */
#define RELIEF_TENT \
    "    printf 'v %s\\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >tent.obj\n" \
    "    printf 'f %s\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\n" \
    "    lambent relief bake tent.obj --size 64 --triangles 8 -o tent.lmr\n"

/* The command line of `lambent relief render`. */
typedef struct relief_options {
    const char *file, *out, *compare, *with, *path, *crowd, *photo;
    model_choice choice; /* choices for the files of --with and --compare */
    view_options view;
    lmb_relief_how how;
    lmb_light light;
    int32_t has_light, bounce;
    int32_t shadow_map, show, samples;
    int32_t frames; /* of the path; 0: to the end */
    float fps;      /* 0: 30 */
    const char *world; /* sky, none, or a file; NULL: none */
    int32_t no_ground;
    render_background background;
    float ambient, exposure_ev; /* ambient NaN: by default; exposure NaN: chosen by the picture */
    const lmb_kernels *kernels;
    int32_t threads;
} relief_options;

extern const option_table relief_table; /* of `relief render` */

/* 1 if --world names a sky or a file. */
int relief_has_world(const relief_options *o);

/* Sets defaults, parses argv and refuses options that exclude each other. Returns as options_parse does. */
int relief_options_parse(relief_options *o, int argc, char **argv, report *r);

/* Parses `N` or `greedy:N`. Returns 1, or 0 if the text is neither. */
int relief_option_views(const char *text, int32_t *views, int32_t *is_greedy);

#endif
