/* play_options.h: what `lambent play` was asked for. */
#ifndef PLAY_OPTIONS_H
#define PLAY_OPTIONS_H

#include "../render/render_options.h"

typedef struct play_options {
    render_options render; /* first: its rows store into it. `out`: the pattern */
    int32_t move;          /* PLAY_*, bits */
    const char *path;
    int32_t frames, from, check;
    float fps;
} play_options;

extern const option_table play_table;

/* As options_parse. */
int play_options_parse(play_options *out, int argc, char **argv, report *r);


#endif
