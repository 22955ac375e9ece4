/* play_times.h: what frames took, by stage. */
#ifndef PLAY_TIMES_H
#define PLAY_TIMES_H

#include <lambent/lambent.h>

#include "../common/report.h"
#include "../common/text_buffer.h"

/* The frame's stages, what is none of them (checks, what is found to be kept), and all of it. */
enum { PLAY_REST = LMB_STAGE_DONE, PLAY_WHOLE, PLAY_ROWS };

typedef struct play_time {
    double clock_s[PLAY_ROWS], cpu_s[PLAY_ROWS];
} play_time;

/* low: the least; p95: what 95 of 100 frames take no more than. */
typedef struct play_figure {
    double low, median, p95;
} play_figure;

/* Zeroed: none. play_times_free releases it. */
typedef struct play_times {
    play_time *frame;
    double *sorted;
    int32_t count, cap;
} play_times;

int play_times_make(play_times *out, int32_t frames, report *r);
void play_times_free(play_times *t);

/* play_times_add: one frame more. play_times_of: a row's figures, seconds, by the clock or of the processor. */
void play_times_add(play_times *t, const play_time *frame);
play_figure play_times_of(const play_times *t, int row, int is_cpu);

/* The row in words. */
const char *play_times_name(int row);

/* As a table of ms; of 0 frames nothing. */
void play_times_print(text_buffer *out, const play_times *t);

#endif
