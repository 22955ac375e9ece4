/* mix_sequence.c: `lambent mix --frames`: a sequence of photos, one after the other. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../common/frame_name.h"
#include "../common/io_file.h"
#include "../common/progress.h"
#include "../picture/picture.h"
#include "mix_again.h"
#include "mix_frames.h"
#include "mix_run.h"

static int read_entry(mix_job *j, const mix_entry *e, report *r)
{
    mix_source *s = &j->o.source;
    if (e->prefix[0] != '\0') {
        s->frame = e->prefix;
        return mix_frame_read(&j->frame, s, r);
    }
    s->photo = e->photo;
    s->depth = e->depth;
    s->depth_scale = s->depth_scale > 0.0f ? s->depth_scale : 0.0002f;
    if (!s->has_intrinsics) {
        return report_fail(r, "no camera given; add --intrinsics FX,FY,CX,CY");
    }
    if (!mix_is_pose(e->pose)) {
        return report_fail(r, "%s: its pose is no rotation and place", e->photo);
    }
    if (!mix_frame_read(&j->frame, s, r)) {
        return 0;
    }
    j->frame.has_pose = 1;
    memcpy(j->frame.pose, e->pose, sizeof j->frame.pose);
    return 1;
}

/* The last frame's answer to this one's photo. */
static void draw_still(mix_job *j, mix_job *last, double *from)
{
    const mix_frame was = last->frame;
    last->frame = j->frame;
    j->frame = was;
    mix_again_draw(last);
    j->draw_s = mix_lap(from);
    mix_tell_times(j);
}

/* A frame that was drawn is the last one, and its world the next frames'. Returns a job that nobody needs any more. */
static mix_job *take_over(mix_kept *k, mix_job *j)
{
    mix_job *last = k->last, *world = k->world;
    k->last = j;
    k->world = j->world;
    if (world != NULL && world != k->world && world != last) {
        mix_job_free(world);
    }
    return last != k->world ? last : NULL;
}

/* One frame that was read: its picture is k->last's, and what later frames need is kept; *job becomes what nobody needs. */
static int draw_one(mix_job **job, mix_kept *k, report *r)
{
    mix_job *j = *job;
    double from = host_seconds();
    if (k->frames > 0 && k->depth.has_pose != j->frame.has_pose) {
        return report_fail(r, j->frame.has_pose ? "has a pose, and those before it have none" : "has no pose");
    }
    lmb_pinhole_round(&j->frame.camera);
    if (!mix_keep_depth(&k->depth, &j->frame, r)) {
        return 0;
    }
    const double bright = mix_brightness(&j->frame);
    if (mix_is_still(k, bright)) {
        draw_still(j, k->last, &from);
        return 1;
    }
    if (!mix_find_planes(j, r)) {
        return 0;
    }
    j->planes_s = mix_lap(&from);
    if (!mix_make_picture(j, &from, r)) {
        return 0;
    }
    if (k->frames == 0) {
        mix_tell(j);
    }
    mix_tell_times(j);
    if (j->o.object != NULL && !mix_keep(k, j, r)) {
        return 0;
    }
    *job = take_over(k, j);
    k->bright = bright;
    k->depth.changed = 0;
    memset(k->depth.fresh, 0, (size_t)k->depth.camera.width * (size_t)k->depth.camera.height);
    return 1;
}

/* A frame that fails has measured nothing: the next ones are those of a list without it. */
static int draw_or_forget(mix_job **job, mix_kept *k, report *r)
{
    mix_depth was;
    if (!mix_depth_copy(&was, &k->depth, r)) {
        return 0;
    }
    const int ok = draw_one(job, k, r);
    if (!ok) {
        const mix_depth failed = k->depth;
        k->depth = was;
        was = failed;
    }
    mix_depth_free(&was);
    return ok;
}

/* Linear photos are exposed as the first one is: chosen anew, what does not move would flicker. */
static float exposure_of(mix_kept *k, const mix_job *j)
{
    if (j->frame.photo.codes.texels != NULL) {
        return mix_exposure(j);
    }
    k->exposure_ev = k->has_exposure ? k->exposure_ev : mix_exposure(j);
    k->has_exposure = 1;
    return k->exposure_ev;
}

/* Between two frames one is written and the next one is read, by a thread each. */
typedef struct sequence {
    const mix_options *o;
    mix_list list;
    mix_kept kept;
    mix_job *next;                     /* that was read; or NULL: it cannot be used, and `why` */
    int32_t at;                        /* of the list: what `next` is */
    int is_drawn, is_written;          /* the frame before it */
    int is_over;                       /* the machine has no more memory or open files: `failed` */
    int32_t left_out, run, last_out;   /* frames: all, those since one was drawn, the number of the last one */
    report why, failed, first;         /* first: why the first one is left out that is */
} sequence;

static void read_next(sequence *s)
{
    const double from = host_seconds();
    s->next = s->at < s->list.count ? calloc(1, sizeof *s->next) : NULL;
    if (s->next == NULL) {
        report_fail(&s->why, "out of memory");
        return;
    }
    s->next->o = *s->o;
    s->next->kept = &s->kept;
    if (!read_entry(s->next, &s->list.entry[s->at], &s->why)) {
        free(s->next);
        s->next = NULL;
        return;
    }
    s->next->read_s = host_seconds() - from;
}

static void write_drawn(sequence *s)
{
    char name[4200];
    s->is_written = !s->is_drawn || (frame_name(name, sizeof name, s->o->out, s->at - 1, &s->failed) &&
                                     picture_write(name, &s->kept.last->picture, exposure_of(&s->kept, s->kept.last),
                                                   PICTURE_CLIPPED, &s->failed));
}

static void write_or_read(void *user, int index, int thread)
{
    (void)thread;
    if (index == 0) {
        write_drawn(user);
    } else {
        read_next(user);
    }
}

/* Of frames left out in a row the first ones are said, each by a line, and the others by one: a file that is no list has
 * thousands of them. */
enum { SAID = 8 };

static void tell_left_out(sequence *s)
{
    report_note(s->o->is_quiet || s->run >= SAID, "frame %d is left out: %s", (int)s->at, s->why.text);
    ++s->run;
    s->last_out = s->at;
}

static void tell_rest(sequence *s)
{
    report_note(s->o->is_quiet || s->run <= SAID, "frames %d to %d are left out, too", (int)(s->last_out - s->run + SAID + 1),
                (int)s->last_out);
    s->run = 0;
}

/* A frame that cannot be used is said and left out; the others go on as if it had not been listed, and the end says it
 * again. Where the machine is at fault no other frame would fare better. */
static void draw_next(sequence *s)
{
    mix_job *j = s->next;
    s->is_drawn = j != NULL && draw_or_forget(&j, &s->kept, &s->why);
    if (s->is_drawn) {
        tell_rest(s);
    } else if (report_is_system(&s->why)) {
        s->failed = s->why;
        s->is_over = 1;
    } else {
        tell_left_out(s);
        if (s->left_out++ == 0) {
            s->first = s->why;
        }
    }
    if (j != NULL) {
        mix_job_free(j);
    }
    s->next = NULL;
}

/* Every file that a frame may be read from, before any is written: and while one is written, the next one is read. */
static int keep_inputs(const mix_list *list, report *r)
{
    static const char *const endings[] = {".json", ".color.png", ".color.jpg", ".color.pfm", ".depth.png", ".depth.pfm"};
    int ok = 1;
    for (int32_t i = 0; ok && i < list->count; ++i) {
        const mix_entry *e = &list->entry[i];
        for (size_t k = 0; ok && e->prefix[0] != '\0' && k < sizeof endings / sizeof *endings; ++k) {
            char name[sizeof e->prefix + 16];
            snprintf(name, sizeof name, "%s%s", e->prefix, endings[k]);
            ok = file_keep(name, r);
        }
        ok = ok && (e->prefix[0] != '\0' || (file_keep(e->photo, r) && file_keep(e->depth, r)));
    }
    return ok;
}

static int can_write(const mix_options *o, const mix_list *list, report *r)
{
    char name[4200];
    int ok = options_files(o, &mix_table, r) && keep_inputs(list, r);
    for (int32_t i = 0; ok && i < list->count; ++i) {
        ok = frame_name(name, sizeof name, o->out, i, r) && (i == 0 ? file_can_write(name, r) : file_may_replace(name, r));
    }
    return ok;
}

static void tell_list(const mix_options *o, const mix_list *l)
{
    report_note(o->is_quiet || l->no_depth + l->no_pose == 0,
                "%s: photos without a depth within 0.02 s: %d; without a pose: %d; they are no frames", o->frames,
                (int)l->no_depth, (int)l->no_pose);
    report_note(o->is_quiet || l->unread == 0, "%s: lines of its lists that are no time and name, or pose: %d; they are passed over",
                o->frames, (int)l->unread);
}

/* 1 where all frames were drawn and written. */
static int end(const sequence *s, report *r)
{
    if (!s->is_written || s->is_over) {
        *r = s->failed;
        return 0;
    }
    return s->left_out == 0 || report_fail(r, "%s: %d of %d frames are left out, the first because %s", s->o->frames,
                                           (int)s->left_out, (int)s->list.count, s->first.text);
}

int mix_frames(const mix_options *o, report *r)
{
    sequence s;
    memset(&s, 0, sizeof s);
    s.o = o;
    if (!mix_list_read(&s.list, o->frames, r) || !can_write(o, &s.list, r)) {
        mix_list_free(&s.list);
        return 0;
    }
    tell_list(o, &s.list);
    s.is_written = 1;
    read_next(&s);
    while (s.at < s.list.count && s.is_written && !s.is_over) {
        draw_next(&s);
        progress_tell("frames", (double)++s.at / (double)s.list.count);
        s.why.text[0] = '\0';
        pool_run(pool_threads(o->threads), 2, write_or_read, &s);
    }
    if (s.next != NULL) {
        mix_job_free(s.next);
    }
    tell_rest(&s);
    const int ok = end(&s, r);
    mix_kept_free(&s.kept);
    mix_list_free(&s.list);
    return ok;
}
