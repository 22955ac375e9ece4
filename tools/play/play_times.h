/* play_times.h: frame times, by stage. */
#ifndef PLAY_TIMES_H
#define PLAY_TIMES_H

#include <lambent/lambent.h>

#include "../common/report.h"
#include "../common/text_buffer.h"

/* The frame's stages, the rest (checks, reuse), and the total. */
enum { PLAY_REST = LMB_STAGE_DONE, PLAY_WHOLE, PLAY_ROWS };

typedef struct play_time {
    double clock_s[PLAY_ROWS], cpu_s[PLAY_ROWS];
} play_time;

/* low: the minimum; p95: 95 of 100 frames take at most this. */
typedef struct play_figure {
    double low, median, p95;
} play_figure;

/* Zeroed: empty. Release it with play_times_free. */
typedef struct play_times {
    play_time *frame;
    double *sorted;
    int32_t count, cap;
} play_times;

int play_times_make(play_times *out, int32_t frames, report *r);
void play_times_free(play_times *t);

/* play_times_add: adds a frame. play_times_of: a row's figures, seconds, wall or processor time. */
void play_times_add(play_times *t, const play_time *frame);
play_figure play_times_of(const play_times *t, int row, int is_cpu);

/* The name of a row. */
const char *play_times_name(int row);

/* Prints a table in ms; nothing if there are no frames. */
void play_times_print(text_buffer *out, const play_times *t);

#endif
