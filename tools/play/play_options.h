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

/* play_name: the file of frame k by a pattern that was checked. 1, or 0 with `r` set: too long. */
int play_name(char *out, size_t size, const char *pattern, int32_t k, report *r);

#endif
