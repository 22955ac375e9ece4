/* play_options.h: the command line of `lambent play`. */
#ifndef PLAY_OPTIONS_H
#define PLAY_OPTIONS_H

#include "../render/render_options.h"

typedef struct play_options {
    render_options render; /* first, because its rows store into it. `out`: the pattern */
    int32_t move;          /* KEY_*, bits */
    const char *path;
    int32_t frames, from, check, world_every;
    float fps;
} play_options;

extern const option_table play_table;

/* See options_parse. */
int play_options_parse(play_options *out, int argc, char **argv, report *r);


#endif
