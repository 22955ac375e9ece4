/* mix_sequence.c: `lambent mix --frames`: draws a sequence of photos in order. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../common/frame_name.h"
#include "../common/io_file.h"
#include "../common/progress.h"
#include "../picture/picture.h"
#include "mix_next.h"
#include "mix_run.h"

/* `folder`: the folder of the list. */
static int read_entry(mix_job *j, const mix_entry *e, const char *folder, report *r)
{
    mix_source *s = &j->o.source;
    s->folder = e->is_rooted ? "" : folder;
    if (e->prefix != NULL) {
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

/* Linear photos keep the exposure of the first one. Otherwise static parts would flicker. */
static float exposure_of(mix_kept *k, const mix_job *j)
{
    if (j->frame.photo.codes.texels != NULL) {
        return mix_exposure(j);
    }
    k->exposure_ev = k->has_exposure ? k->exposure_ev : mix_exposure(j);
    k->has_exposure = 1;
    return k->exposure_ev;
}

/* While a frame is drawn, the previous one is written and the next one is read, beside the picture's rows. */
typedef struct sequence {
    const mix_options *o;
    mix_list list;
    mix_kept kept;
    mix_spare spare; /* beside rows only the reader of the next frame uses it */
    mix_aside aside;
    mix_ready next;
    report why_next;                   /* if next.job is NULL: why it cannot be used */
    int32_t at, unwritten;             /* in the list: the frame being drawn; the last one drawn, or -1 if written */
    int32_t width, height;             /* size of the first photo; 0: none read yet */
    int is_drawn, is_written;
    int is_over;                       /* memory or open files have run out: `failed` */
    int32_t estimated, first_estimated; /* frames drawn without a depth of their own */
    int32_t left_out, run, last_out;   /* frames: total, since one was drawn, the number of the last one */
    report why, failed, first;         /* first: why the first one was left out */
} sequence;

/* Depth, planes and light are kept between frames, so all frames must have the size of the first. */
static int has_size(sequence *s, const mix_entry *e, const mix_frame *f, report *r)
{
    s->width = s->width > 0 ? s->width : f->camera.width;
    s->height = s->height > 0 ? s->height : f->camera.height;
    return (f->camera.width == s->width && f->camera.height == s->height) ||
           report_fail(r, "%s: %d x %d pixels, and the first frame has %d x %d; frames of a sequence have one size",
                       e->prefix != NULL ? e->prefix : e->photo, (int)f->camera.width, (int)f->camera.height,
                       (int)s->width, (int)s->height);
}

static void read_at(sequence *s, int32_t at)
{
    const double from = host_seconds();
    mix_job *j = at < s->list.count ? calloc(1, sizeof *j) : NULL;
    memset(&s->next, 0, sizeof s->next);
    s->why_next.text[0] = '\0';
    if (j == NULL) {
        report_fail(&s->why_next, "out of memory");
        return;
    }
    j->o = *s->o;
    j->kept = &s->kept;
    j->spare = &s->spare;
    j->aside = &s->aside;
    const mix_entry *e = &s->list.entry[at];
    if (!read_entry(j, e, s->list.folder, &s->why_next)) {
        free(j);
        return;
    }
    if (!has_size(s, e, &j->frame, &s->why_next)) {
        mix_frame_free(&j->frame);
        free(j);
        return;
    }
    j->read_s = host_seconds() - from;
    s->next.job = j;
}

static void write_drawn(sequence *s)
{
    char name[4200];
    s->is_written =
        s->unwritten < 0 ||
        (frame_name(name, sizeof name, s->o->out, s->unwritten, &s->failed) &&
         picture_write(name, &s->kept.last->picture, exposure_of(&s->kept, s->kept.last), PICTURE_CLIPPED, &s->failed));
    s->unwritten = -1;
}

static void write_or_read(void *user, int index, int thread)
{
    sequence *s = user;
    (void)thread;
    if (index == 0) {
        write_drawn(s);
        return;
    }
    read_at(s, s->at + 1);
    if (s->aside.is_beside && s->next.job != NULL) {
        mix_make_ready(&s->next, &s->kept);
    }
}

/* The first frames left out in a row get a line each, the others one line together, because a file that is no list has
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
    report_note(s->o->is_quiet || s->run <= SAID, "frames %d to %d are left out, too",
                (int)(s->last_out - s->run + SAID + 1), (int)s->last_out);
    s->run = 0;
}

/* Reports a frame that cannot be used. The sequence goes on as if it had not been listed, and the end reports it again.
 * If the system has failed, it stops: other frames would fail, too. */
static void tell_failed(sequence *s)
{
    if (report_is_system(&s->why) || report_is_usage(&s->why)) {
        if (s->is_written) { /* otherwise report the first failure: writing the previous frame */
            s->failed = s->why;
        }
        s->is_over = 1;
        return;
    }
    tell_left_out(s);
    if (s->left_out++ == 0) {
        s->first = s->why;
    }
}

/* Draws a prepared frame. If it fails, the frame prepared behind it is read again. */
static void draw_next(sequence *s)
{
    mix_ready now = s->next;
    s->why = s->why_next;
    s->aside.count = 2;
    const int lacks_depth = now.job != NULL && now.job->frame.lacks_depth;
    s->is_drawn = now.job != NULL && mix_draw_next(&now, &s->kept, &s->why);
    if (s->is_drawn && lacks_depth && s->estimated++ == 0) {
        s->first_estimated = s->at;
    }
    if (s->aside.count > 0) {
        mix_aside_run(&s->aside, pool_threads(s->o->threads));
    } else if (!s->is_drawn && s->next.has_depth) {
        mix_ready_free(&s->next);
        read_at(s, s->at + 1);
    }
    mix_ready_free(&now);
    if (s->is_drawn) {
        s->unwritten = s->at;
        tell_rest(s);
    } else {
        tell_failed(s);
    }
}

/* Registers all files that frames may be read from before any is written, because the next frame is read while one is
 * written. */
static int keep_inputs(const mix_list *list, report *r)
{
    static const char *const endings[] = {".json",      ".color.png", ".color.jpg", ".color.pam",
                                          ".color.pfm", ".depth.png", ".depth.pfm"};
    int ok = 1;
    for (int32_t i = 0; ok && i < list->count; ++i) {
        const mix_entry *e = &list->entry[i];
        const size_t size = e->prefix != NULL ? strlen(e->prefix) + sizeof ".color.png" : 0;
        char *name = size > 0 ? malloc(size) : NULL;
        ok = size == 0 || name != NULL || report_fail(r, "out of memory");
        for (size_t k = 0; ok && name != NULL && k < sizeof endings / sizeof *endings; ++k) {
            snprintf(name, size, "%s%s", e->prefix, endings[k]);
            ok = file_keep(name, r);
        }
        free(name);
        ok = ok && (e->prefix != NULL || (file_keep(e->photo, r) && (e->depth == NULL || file_keep(e->depth, r))));
    }
    return ok;
}

static int can_write(const mix_options *o, const mix_list *list, report *r)
{
    char name[4200];
    int ok = options_files(o, &mix_table, r) && keep_inputs(list, r);
    for (int32_t i = 0; ok && i < list->count; ++i) {
        ok = frame_name(name, sizeof name, o->out, i, r) &&
             (i == 0 ? file_can_write(name, r) : file_may_replace(name, r));
    }
    return ok;
}

static void tell_list(const mix_options *o, const mix_list *l)
{
    report_note(o->is_quiet || l->no_depth + l->no_pose == 0,
                "%s: photos without a depth within 0.02 s: %d; without a pose: %d; they are no frames", o->frames,
                (int)l->no_depth, (int)l->no_pose);
    report_note(o->is_quiet || l->unread == 0,
                "%s: lines of its lists that are no time and name, or pose: %d; they are passed over", o->frames,
                (int)l->unread);
}

/* Returns 1 if all frames were drawn and written. */
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
    s.list.may_lack_depth = o->source.may_lack_depth;
    if (!mix_list_read(&s.list, o->frames, r) || !can_write(o, &s.list, r)) {
        mix_list_free(&s.list);
        return 0;
    }
    tell_list(o, &s.list);
    report_print_notes();
    s.aside.run = write_or_read;
    s.aside.user = &s;
    s.is_written = 1;
    s.unwritten = -1;
    read_at(&s, 0);
    while (s.at < s.list.count && s.is_written && !s.is_over) {
        draw_next(&s);
        progress_tell("frames", (double)++s.at / (double)s.list.count);
    }
    if (s.is_written) {
        write_drawn(&s);
    }
    mix_ready_free(&s.next);
    tell_rest(&s);
    report_note(o->is_quiet || s.estimated == 0,
                "frames without depth: %d, the first is %d; it is estimated from earlier frames and their planes",
                (int)s.estimated, (int)s.first_estimated);
    const int ok = end(&s, r);
    mix_kept_free(&s.kept);
    mix_spare_free(&s.spare);
    mix_list_free(&s.list);
    return ok;
}
