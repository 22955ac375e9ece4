/* capture_options.h: what `lambent capture` was asked for. */
#ifndef CAPTURE_OPTIONS_H
#define CAPTURE_OPTIONS_H

#include "../render/render_options.h"

enum { CAPTURE_PLACES = 32 }; /* --at given at most so often */

typedef struct capture_options {
    render_options render; /* first: its rows store into it. `out`: the cube's file, or a pattern of several places */
    lmb_vec3 at[CAPTURE_PLACES];
    int32_t at_count, faces;
    const char *ground;
    float ground_size[2], ground_centre[2], ground_y;
    int32_t has_ground_size, has_ground_centre, has_ground_y; /* else by the scene's bounds */
} capture_options;

extern const option_table capture_table;

/* As options_parse. */
int capture_options_parse(capture_options *out, int argc, char **argv, report *r);

#endif
