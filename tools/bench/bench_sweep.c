/* bench_sweep.c: measures settings one after the other, and compares them with the truth. */
#include "bench_sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../common/progress.h"
#include "../../platform/host/pool.h"
#include "../picture/metrics.h"
#include "../picture/picture.h"
#include "bench_front.h"
#include "bench_breakdowns.h"
#include "bench_slice.h"
#include "bench_picture.h"

enum { TRUTH_WEIGHT = 60 };

static void say(const sweep *s, char *out, size_t size, const bench_line *line)
{
    if (s->o->subject->say != NULL) {
        s->o->subject->say(out, size, line);
    } else {
        bench_line_say(out, size, line);
    }
}

/* --- one setting -------------------------------------------------------------------------------------------------- */

static void set_figures(bench_point *p, const metrics *m)
{
    const double all[] = {m->trim, m->rmse, m->e50, m->e95, m->e99, m->mean, m->has_leak ? m->leak : (double)NAN};
    memcpy(p->figure, all, sizeof all);
    p->has_figures = 1;
}

static int hold(sweep *s, bench_point *p, const image *picture, report *r)
{
    const image *truth = &s->truth.picture;
    metrics_input in;
    metrics m;
    if (picture->width != truth->width || picture->height != truth->height) {
        return report_fail(r, "--truth is %d x %d and the picture %d x %d; give no --size", (int)truth->width,
                           (int)truth->height, (int)picture->width, (int)picture->height);
    }
    memset(&in, 0, sizeof in);
    in.test = picture->pixels;
    in.truth = truth->pixels;
    in.surface = s->truth.surface;
    in.width = truth->width;
    in.height = truth->height;
    in.channels = 3;
    if (!metrics_measure(&m, &in, r)) {
        return 0;
    }
    set_figures(p, &m);
    bench_picture_of(&p->picture, picture, s->exposure_ev);
    bench_picture_heat(&p->heat, picture, truth, s->truth.surface, m.truth_mean);
    return 1;
}

static int is_same(const image *a, const image *b)
{
    return a->pixels != NULL && b->pixels != NULL && a->width == b->width && a->height == b->height &&
           memcmp(a->pixels, b->pixels, (size_t)a->width * (size_t)a->height * 3 * sizeof(float)) == 0;
}

static void take_times(bench_point *p, const bench_shot *shot)
{
    memcpy(p->stage_s, shot->stage_s, sizeof p->stage_s);
    for (int i = 0; i < BENCH_STAGES; ++i) {
        p->time_s += shot->stage_s[i];
    }
    p->instructions = shot->instructions;
    p->bytes = shot->bytes;
    p->work = shot->work;
    p->threads = shot->threads;
}

/* Draws and measures a setting. An error in the first setting, or of the system, ends the sweep. A later setting that
 * is incompatible with the given options is reported in place. Settings of other slices are drawn without timing. */
static int measure(sweep *s, const bench_task *t, int is_own, report *r)
{
    const bench_way way = {is_own ? s->o->runs : 0, 1};
    bench_point *p = bench_results_add(s->b);
    const int number = s->b->count - 1;
    bench_line line;
    bench_shot shot;
    report own = {""};
    if (p == NULL) {
        return report_fail(r, "out of memory");
    }
    p->number = is_own ? (int)(t - s->task) : -1;
    snprintf(p->option, sizeof p->option, "%s", t->option);
    snprintf(p->name, sizeof p->name, "%s", t->words[0] != '\0' ? t->words : "default");
    if (!sweep_line(&line, s, t->words, r)) {
        return 0;
    }
    say(s, p->command, sizeof p->command, &line);
    report_note(!s->o->is_verbose, "%s", p->command + strspn(p->command, " "));
    if (!s->o->subject->draw(&shot, &line, &way, &own)) {
        snprintf(p->failure, sizeof p->failure, "%.150s", own.text);
        return (number > 0 && !report_is_system(&own)) || report_fail(r, "%s", own.text);
    }
    if (number == 0 && s->truth.surface == NULL) { /* a truth from a file: use the first picture's surface */
        s->truth.surface = shot.surface;
        shot.surface = NULL;
    }
    take_times(p, &shot);
    s->kept[number] = shot.picture;
    shot.picture.pixels = NULL;
    bench_shot_free(&shot);
    p->same = t->flags & BENCH_SAME ? is_same(&s->kept[number], &s->kept[0]) : -1;
    return (t->flags & (BENCH_OTHER | BENCH_SAME)) || hold(s, p, &s->kept[number], r);
}

/* --- all of them -------------------------------------------------------------------------------------------------- */

static int get_truth(sweep *s, report *r)
{
    bench_line line;
    if (s->o->truth != NULL) {
        if (!bench_truth_read(&s->truth, s->o->truth, r)) {
            return 0;
        }
    } else {
        s->truth.is_own = 1;
        progress_whole("the truth", s->done / s->all);
        if (!sweep_line(&line, s, "", r) || !bench_truth_make(&s->truth, s->o, &line, r)) {
            return 0;
        }
        s->done += TRUTH_WEIGHT;
    }
    s->exposure_ev = picture_auto_exposure(&s->truth.picture, PICTURE_CLIPPED);
    bench_picture_of(&s->b->truth_picture, &s->truth.picture, s->exposure_ev);
    return 1;
}

static void describe(sweep *s)
{
    bench_results *b = s->b;
    char processor[128];
    bench_line line;
    report unheard = {""};
    host_processor(processor, sizeof processor);
    snprintf(b->computer, sizeof b->computer, "%s%s%d processors, %s lanes, lambent %d.%d.%d", processor,
             processor[0] != '\0' ? ", " : "", pool_processors(), lmb_kernels_name(lmb_kernels_pick()),
             LMB_VERSION / 10000, LMB_VERSION / 100 % 100, LMB_VERSION % 100);
    snprintf(b->how, sizeof b->how,
             "the least of up to %d runs after one that warms up, stage by stage; processor time "
             "on one thread",
             (int)s->o->runs);
    if (sweep_line(&line, s, "", &unheard)) {
        say(s, b->title, sizeof b->title, &line);
    }
    snprintf(b->truth, sizeof b->truth, "%s", s->truth.said);
    bench_results_about(b, s->o->subject);
    b->settings = s->tasks;
}

static int run(sweep *s, report *r)
{
    uint8_t is_own[BENCH_POINTS];
    s->tasks = bench_tasks(s->task, s->o, r);
    bench_slice_deal(is_own, s->o->slice, s->task, s->tasks);
    s->all = bench_breakdowns_weight(s->o) + (s->o->truth == NULL ? TRUTH_WEIGHT : 0);
    for (int i = 0; i < s->tasks; ++i) {
        s->all += is_own[i] ? s->task[i].weight : 0.0;
    }
    if (s->tasks == 0 || !get_truth(s, r)) {
        return 0;
    }
    describe(s);
    for (int i = 0; i < s->tasks; ++i) {
        progress_whole(s->task[i].words[0] != '\0' ? s->task[i].words : "default", s->done / s->all);
        if ((i == 0 || is_own[i]) && !measure(s, &s->task[i], is_own[i], r)) {
            return 0;
        }
        s->done += is_own[i] ? s->task[i].weight : 0.0;
    }
    if (s->o->slice.count > 0) {
        s->b->job = bench_slice_job(s);
        return 1;
    }
    bench_front(s->b);
    return bench_breakdowns(s, r);
}

int bench_sweep(bench_results *out, const bench_options *o, report *r)
{
    sweep *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return report_fail(r, "out of memory");
    }
    s->o = o;
    s->b = out;
    s->start = host_seconds();
    const int ok = run(s, r);
    progress_end();
    out->seconds = host_seconds() - s->start;
    for (int i = 0; i < BENCH_POINTS; ++i) {
        image_free(&s->kept[i]);
    }
    bench_truth_free(&s->truth);
    free(s);
    return ok;
}
