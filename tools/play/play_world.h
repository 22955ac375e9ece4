/* play_world.h: the world of a frame, if it changes: numbered files, blended from one to the next. [S20 S28] */
#ifndef PLAY_WORLD_H
#define PLAY_WORLD_H

#include "../picture/world_series.h"
#include "../render/render_job.h"
#include "play_motion.h"

/* Zeroed: the world stays. Release it with play_world_free. */
typedef struct play_world {
    world_series series;
    world file[2];    /* the last two that were read, without lights */
    int32_t index[2]; /* of them in the series, from 1; 0: none */
    world_moment shown;
    uint32_t changes;  /* of the world that is shown */
    char first[4096];  /* the first file's name */
} play_world;

/* play_world_begin: if the options' world is numbered, finds the files and replaces it with the first. Call it before
 * the scene is loaded. play_world_set: changes the light to that of frame k. Return 1, or 0 with `r` set. */
int play_world_begin(play_world *out, render_options *inout, report *r);
int play_world_set(play_world *inout, render_job *j, play_motion *motion, int32_t k, int32_t every, report *r);

/* play_world_check: reads all files that `frames` frames from frame `from` on use, so that a bad one ends the command
 * before it writes. Returns 1, or 0 with `r` set. */
int play_world_check(const play_world *w, int32_t from, int32_t frames, int32_t every, report *r);

/* play_world_hash: adds all files to the job of a slice. Returns 1, or 0 with `r` set. */
int play_world_hash(const play_world *w, render_options *inout, report *r);

void play_world_free(play_world *w);

#endif
