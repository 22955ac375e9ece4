/* verb_play.c: `lambent play`: frames of a moving scene, and their times. */
#include "verb_play.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/frame_name.h"
#include "../common/progress.h"
#include "../common/text_buffer.h"
#include "../picture/picture.h"
#include "../render/render_finish.h"
#include "play_check.h"
#include "play_motion.h"
#include "play_options.h"
#include "play_slice.h"
#include "play_times.h"
#include "play_world.h"

enum { NAME = SLICE_NAME };

/* One run. */
typedef struct play {
    play_options o;
    render_job job;
    play_motion motion;
    play_world world;
    play_times times;
    play_check check;
    text_buffer said; /* printed to stdout at the end */
    byte_buffer made; /* frames of a slice */
    float exposure_ev;
} play;

/* Frames per file of a numbered world. */
static int32_t every_of(const play *p) { return p->o.world_every > 0 ? p->o.world_every : 1; }

/* --- a frame ------------------------------------------------------------------------------------------------------ */

static int draw(play *p, int32_t k, play_time *took, report *r)
{
    render_job *j = &p->job;
    int32_t stage;
    if (!play_world_set(&p->world, j, &p->motion, k, every_of(p), r) ||
        !play_motion_set(&p->motion, k, r)) {
        return 0;
    }
    render_job_eye(j, &j->frame, &j->linear, 0);
    const double start = host_seconds(), cpu = host_cpu_seconds();
    const lmb_status status = workers_reuse(&j->workers, &stage, j->render, &j->frame);
    took->cpu_s[PLAY_WHOLE] = took->cpu_s[PLAY_REST] = host_cpu_seconds() - cpu;
    took->clock_s[PLAY_WHOLE] = took->clock_s[PLAY_REST] = host_seconds() - start;
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        took->clock_s[i] = j->workers.stage_s[i];
        took->cpu_s[i] = j->workers.stage_cpu_s[i];
        took->clock_s[PLAY_REST] -= took->clock_s[i];
        took->cpu_s[PLAY_REST] -= took->cpu_s[i];
    }
    return status == LMB_OK || report_fail(r, "%s: frame %d: drawing stopped: %s", p->o.render.scene, (int)k,
                                           lmb_status_name(status));
}

/* All frames have the exposure of frame 0, even if drawing starts with another. */
static int find_exposure(play *p, report *r)
{
    play_time unused;
    p->exposure_ev = p->job.o.exposure_ev;
    if (p->o.render.out == NULL || !p->job.o.exposure_auto || picture_is_linear(picture_format(p->o.render.out))) {
        return 1;
    }
    if (!draw(p, 0, &unused, r) || !render_exposure(&p->exposure_ev, &p->job, r)) {
        return 0;
    }
    report_note(p->o.render.view.is_quiet, "exposure %+.3g EV (auto, by frame 0)", (double)p->exposure_ev);
    memset(p->job.render, 0, sizeof *p->job.render);
    return 1;
}

static int put_frame(play *p, int32_t k, const render_finish *f, report *r)
{
    char name[NAME];
    file_bytes file = {NULL, 0};
    if (p->o.render.slice.count == 0) {
        return frame_name(name, sizeof name, p->o.render.out, k, r) && finish_write(f, name, &p->job.linear, 1, r);
    }
    const int ok = finish_encode(&file, f, &p->job.linear, 1, r) && play_slice_put(&p->made, k, f->format, &file, r);
    file_free(&file);
    return ok;
}

/* Writes a frame as `render` writes a picture. This changes the light. */
static int write_frame(play *p, int32_t k, report *r)
{
    render_finish f;
    if (p->o.render.out == NULL) {
        return 1;
    }
    const int ok = finish_begin_at(&f, &p->job, p->exposure_ev, r) && put_frame(p, k, &f, r);
    finish_free(&f);
    if (p->job.o.background.kind != BACKGROUND_WORLD) {
        p->job.render->stage = LMB_STAGE_VIEW; /* finding the background has overwritten the view */
    }
    return ok;
}

static int check_frame(play *p, int32_t k, report *r)
{
    metrics m;
    if (p->o.check == 0 || k % p->o.check != 0) {
        return 1;
    }
    if (!play_check_frame(&m, &p->check, &p->job, p->world.changes, r)) {
        return 0;
    }
    text_buffer_add(&p->said, "frame %-5d  trim %.4f  rmse %.4f  mean %.4f\n", (int)k, m.trim, m.rmse, m.mean);
    return 1;
}

/* --- all of them -------------------------------------------------------------------------------------------------- */

static int draw_all(play *p, report *r)
{
    int ok = 1;
    report_print_notes();
    const slice own = p->o.render.slice;
    const int32_t frames = slice_items(own, p->o.frames);
    for (int32_t i = 0; ok && i < frames; ++i) {
        const int32_t k = p->o.from + slice_item(own, i);
        play_time took;
        progress_whole("frames", (double)i / (double)frames);
        ok = draw(p, k, &took, r) && check_frame(p, k, r) && write_frame(p, k, r);
        if (ok) {
            play_times_add(&p->times, &took);
        }
    }
    progress_end();
    return ok;
}

static void tell_frames(play *p)
{
    const render_job *j = &p->job;
    text_buffer_add(&p->said, "%s: %d frames of %d x %d, %u triangles, %u lights, %d thread%s of %s lanes\n",
                    p->o.render.scene, (int)p->times.count, (int)j->linear.width, (int)j->linear.height,
                    (unsigned)lmb_scene_triangles(&j->scene), (unsigned)j->scene.light_count, j->workers.threads,
                    j->workers.threads == 1 ? "" : "s", lmb_kernels_name(j->frame.kernels));
    play_times_print(&p->said, &p->times);
}

/* Prints a note if nothing moves in the last frames, which would look fast. */
static void tell_end(const play *p)
{
    const double end = play_motion_end(&p->motion);
    const double last = (double)(p->o.from + p->o.frames - 1) / (double)p->o.fps;
    const double stays = (double)(p->world.series.count - 1) * (double)every_of(p);
    const int is_changed = (double)(p->o.from + p->o.frames - 1) > stays;
    world_series_tell(&p->world.series, p->o.from + p->o.frames - 1, every_of(p), p->o.render.view.is_quiet);
    report_note(p->o.render.view.is_quiet || !play_motion_is_over(&p->motion, last) ||
                    (p->world.series.count > 0 && !is_changed),
                "note: %s ends at %.3g s, the frames at %.3g s: from there on nothing moves",
                p->o.path != NULL ? p->o.path : p->o.render.scene, end, last);
}

static int write_stats(const play *p, report *r)
{
    text_buffer b;
    memset(&b, 0, sizeof b);
    text_buffer_add(&b, "{\n  \"width\": %d, \"height\": %d, \"frames\": %d, \"threads\": %d,\n  \"seconds\": {",
                    (int)p->job.linear.width, (int)p->job.linear.height, (int)p->times.count, p->job.workers.threads);
    for (int row = 0; row < PLAY_ROWS; ++row) {
        const play_figure clock = play_times_of(&p->times, row, 0), cpu = play_times_of(&p->times, row, 1);
        text_buffer_add(&b, "%s\n    \"%s\": {\"clock\": [%.6f, %.6f, %.6f], \"cpu\": [%.6f, %.6f, %.6f]}",
                        row > 0 ? "," : "", play_times_name(row), clock.low, clock.median, clock.p95, cpu.low,
                        cpu.median, cpu.p95);
    }
    text_buffer_add(&b, "\n  },\n  \"figures\": [\"least\", \"median\", \"95 of 100\"], \"backend\": \"%s\"\n}\n",
                    lmb_kernels_name(p->job.frame.kernels));
    const int ok = text_buffer_write(&b, p->o.render.stats, r);
    text_buffer_free(&b);
    return ok;
}

static int can_write(const play *p, report *r)
{
    char name[NAME];
    int ok = options_files(&p->o, &play_table, r);
    if (ok && p->o.render.slice.count > 0) {
        return slice_name(name, p->o.render.out, p->o.render.slice, r) && file_can_write(name, r);
    }
    for (int32_t i = 0; ok && p->o.render.out != NULL && i < p->o.frames; ++i) {
        ok = frame_name(name, sizeof name, p->o.render.out, p->o.from + i, r) &&
             (i == 0 ? file_can_write(name, r) : file_may_replace(name, r));
    }
    return ok;
}

static int write_slice(const play *p, report *r)
{
    char about[SLICE_ABOUT];
    snprintf(about, sizeof about, "play %.100s, frames %d to %d", p->o.render.scene, (int)p->o.from,
             (int)(p->o.from + p->o.frames - 1));
    return play_slice_write(p->o.render.out, p->o.render.slice, p->job.o.slice_job, about, &p->made, r);
}

static int tell(play *p, report *r)
{
    if (p->said.is_short) {
        return report_fail(r, "out of memory");
    }
    if (!p->o.render.view.is_quiet && p->said.data != NULL) {
        fputs(p->said.data, report_words());
    }
    return report_flush(r);
}

static int run(play *p, report *r)
{
    p->job.o = p->o.render;
    p->job.hides = MODEL_NOTE_MOTION;
    if (!can_write(p, r) || !play_motion_read(&p->motion, &p->o, r) || !render_job_load(&p->job, r) ||
        !play_world_check(&p->world, p->o.from, p->o.frames, every_of(p), r) || !can_write(p, r) ||
        !play_motion_find(&p->motion, &p->job, r) || !render_job_set(&p->job, r) || !play_motion_make(&p->motion, r) ||
        !play_times_make(&p->times, p->o.frames, r) || !find_exposure(p, r) || !draw_all(p, r) ||
        (p->o.render.slice.count > 0 && !write_slice(p, r))) {
        return 0;
    }
    tell_frames(p);
    render_tell_coarse(p->o.render.view.is_quiet, &p->job.stats);
    render_tell_dropped(p->o.render.view.is_quiet, &p->job.scene, &p->job.stats);
    tell_end(p);
    return (p->o.render.stats == NULL || write_stats(p, r)) && tell(p, r);
}

int verb_play(int argc, char **argv)
{
    report r = {""};
    static play p; /* too large for a small stack: the options hold 64 lights */
    memset(&p, 0, sizeof p);
    const int asked = play_options_parse(&p.o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &play_table, &r);
    }
    progress_begin(p.o.render.view.is_quiet, "play");
    const int ok = play_world_begin(&p.world, &p.o.render, &r) &&
                   render_options_job(&p.o.render, &play_table, argc, argv, &r) &&
                   play_world_hash(&p.world, &p.o.render, &r) && run(&p, &r);
    free(p.made.data);
    play_check_free(&p.check);
    play_times_free(&p.times);
    play_motion_free(&p.motion);
    play_world_free(&p.world);
    render_job_free(&p.job);
    text_buffer_free(&p.said);
    return ok ? 0 : report_end(&r, "play", 1);
}
