/* play_times.c: minimum, median and 95th percentile of frame times, by stage. */
#include "play_times.h"

#include <stdlib.h>
#include <string.h>

int play_times_make(play_times *t, int32_t frames, report *r)
{
    memset(t, 0, sizeof *t);
    t->cap = frames;
    t->frame = calloc((size_t)frames, sizeof *t->frame);
    t->sorted = calloc((size_t)frames, sizeof *t->sorted);
    return (t->frame != NULL && t->sorted != NULL) ||
           report_fail(r, "not enough memory for %d frames' times; draw fewer", (int)frames);
}

void play_times_free(play_times *t)
{
    free(t->frame);
    free(t->sorted);
    memset(t, 0, sizeof *t);
}

void play_times_add(play_times *t, const play_time *frame)
{
    if (t->count < t->cap) {
        t->frame[t->count++] = *frame;
    }
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

play_figure play_times_of(const play_times *t, int row, int is_cpu)
{
    play_figure f = {0.0, 0.0, 0.0};
    if (t->count == 0) {
        return f;
    }
    for (int32_t i = 0; i < t->count; ++i) {
        t->sorted[i] = is_cpu ? t->frame[i].cpu_s[row] : t->frame[i].clock_s[row];
    }
    qsort(t->sorted, (size_t)t->count, sizeof *t->sorted, rising);
    f.low = t->sorted[0];
    f.median = 0.5 * (t->sorted[(t->count - 1) / 2] + t->sorted[t->count / 2]);
    f.p95 = t->sorted[(int32_t)((95 * (int64_t)t->count + 99) / 100) - 1];
    return f;
}

const char *play_times_name(int row)
{
    static const char *const names[] = {"the rest", "whole frame"};
    lmb_render at;
    lmb_scene scene;
    const char *name = names[row == PLAY_WHOLE];
    if (row < PLAY_REST) {
        memset(&at, 0, sizeof at);
        memset(&scene, 0, sizeof scene);
        at.frame.scene = &scene;
        at.stage = row;
        lmb_render_progress(&name, &at);
    }
    return name;
}

void play_times_print(text_buffer *out, const play_times *t)
{
    if (t->count == 0) {
        return;
    }
    text_buffer_add(out, "%-13s %26s   %26s\n", "ms a frame", "by the clock", "of the processor");
    text_buffer_add(out, "%-13s %8s %8s %8s   %8s %8s %8s\n", "", "least", "median", "95 %", "least", "median", "95 %");
    for (int row = 0; row < PLAY_ROWS; ++row) {
        const play_figure clock = play_times_of(t, row, 0), cpu = play_times_of(t, row, 1);
        if (row == PLAY_WHOLE || cpu.p95 >= 5e-7 || clock.p95 >= 5e-7) {
            text_buffer_add(out, "%-13s %8.2f %8.2f %8.2f   %8.2f %8.2f %8.2f\n", play_times_name(row),
                            clock.low * 1e3, clock.median * 1e3, clock.p95 * 1e3, cpu.low * 1e3, cpu.median * 1e3,
                            cpu.p95 * 1e3);
        }
    }
}
