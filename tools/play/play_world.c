/* play_world.c: the world of a frame, if it changes. */
#include "play_world.h"

#include <stdio.h>
#include <string.h>

#include "../common/frame_name.h"
#include "../picture/world_read.h"

int play_world_begin(play_world *w, render_options *o, report *r)
{
    if (o->world == NULL || frame_digits(o->world) == 0) {
        return 1;
    }
    if (!world_series_find(&w->series, o->world, r) ||
        !world_series_name(w->first, sizeof w->first, &w->series, 0, r)) {
        return 0;
    }
    o->world = w->first;
    o->world_changes = 1;
    return 1;
}

int play_world_hash(const play_world *w, render_options *o, report *r)
{
    char name[sizeof w->first];
    for (int32_t i = 1; i < w->series.count && o->slice.count > 0; ++i) {
        if (!world_series_name(name, sizeof name, &w->series, i, r) || !world_hash(&o->slice_job, name, r)) {
            return 0;
        }
    }
    return 1;
}

int play_world_check(const play_world *w, int32_t from, int32_t frames, int32_t every, report *r)
{
    return w->series.count == 0 || world_series_check(&w->series, from, frames, every, 1, r);
}

/* Reads a file, unless it is one of the last two. */
static const world *file_of(play_world *w, const render_job *j, int32_t index, report *r)
{
    char name[sizeof w->first];
    world *to = &w->file[index % 2];
    int32_t *own = &w->index[index % 2];
    if (*own == index + 1) {
        return to;
    }
    world_free(to);
    *own = 0;
    if (!world_series_name(name, sizeof name, &w->series, index, r) ||
        !world_read(to, name, j->o.view.is_quiet, r)) {
        return NULL;
    }
    if (to->env.size != j->around.env.size) {
        report_fail(r, "%s: faces of %d pixels here, and %s has %d", name, (int)to->env.size, w->first,
                    (int)j->around.env.size); /* a file that has changed since play_world_check */
        return NULL;
    }
    *own = index + 1;
    return to;
}

int play_world_set(play_world *w, render_job *j, play_motion *motion, int32_t k, int32_t every, report *r)
{
    if (w->series.count == 0) {
        return 1;
    }
    const world_moment at = world_series_at(&w->series, k, every);
    if (at.index == w->shown.index && at.share == w->shown.share) {
        return 1;
    }
    const world *a = file_of(w, j, at.index, r), *b = NULL;
    if (a == NULL || (at.share > 0.0f && (b = file_of(w, j, at.index + 1, r)) == NULL)) {
        return 0;
    }
    world_blend(&j->around, a, b, at.share);
    w->shown = at;
    ++w->changes;
    const int ok = render_job_change_world(j, motion->light, r);
    play_motion_suns(motion);
    return ok;
}

void play_world_free(play_world *w)
{
    world_free(&w->file[0]);
    world_free(&w->file[1]);
}
