/* mix_next.c: one frame of a sequence: prepared while the previous one is drawn, then drawn. */
#include "mix_next.h"

#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "mix_again.h"
#include "mix_run.h"

/* --- the known depth ---------------------------------------------------------------------------------------------- */

void mix_ready_free(mix_ready *n)
{
    if (n->job != NULL) {
        mix_job_free(n->job);
    }
    mix_depth_free(&n->depth);
    memset(n, 0, sizeof *n);
}

/* Merges this frame into a copy of the known depth, so that a frame that fails has no effect. */
static int measure(mix_ready *n, const mix_kept *k, int is_kept, report *r)
{
    mix_job *j = n->job;
    if (k->frames + is_kept > 0 && k->depth.has_pose != j->frame.has_pose) {
        return report_fail(r, j->frame.has_pose ? "has a pose, and those before it have none" : "has no pose");
    }
    if (k->frames + is_kept == 0 && j->frame.lacks_depth) {
        return report_fail(r, "has no depth, and no frame before it has any");
    }
    lmb_pinhole_round(&j->frame.camera);
    mix_depth_free(&n->depth);
    if (!mix_depth_copy(&n->depth, &k->depth, r)) {
        return 0;
    }
    if (is_kept) {
        mix_depth_seen(&n->depth);
    }
    return n->has_depth = mix_keep_depth(&n->depth, &j->frame, r);
}

static int find_planes(mix_job *j, report *r)
{
    double from = host_seconds();
    const int ok = mix_find_planes(j, r);
    j->planes_s = mix_lap(&from);
    return ok;
}

/* Uses one thread, because the others draw. An error here is ignored: it occurs again, and is reported, when the frame
 * is drawn. */
void mix_make_ready(mix_ready *n, const mix_kept *k)
{
    report none = {""};
    const int32_t threads = n->job->o.threads;
    n->job->o.threads = 1;
    if (n->job->o.object != NULL && measure(n, k, 1, &none) && !mix_is_little_new(&n->depth)) {
        (void)find_planes(n->job, &none);
    }
    n->job->o.threads = threads;
}

/* --- the picture -------------------------------------------------------------------------------------------------- */

/* Applies the last frame's result to this photo, once the last picture is written. */
static void draw_still(mix_job *j, mix_job *last, double *from)
{
    const mix_frame was = last->frame;
    mix_aside_run(j->aside, pool_threads(j->o.threads));
    last->frame = j->frame;
    j->frame = was;
    mix_again_draw(last);
    j->draw_s = mix_lap(from);
    mix_tell_times(j);
}

/* Makes a drawn frame the last one, and its world that of the next frames. Returns a job that is no longer needed. */
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

/* k->depth includes this frame. Draws the picture into k->last; *job becomes a job that is no longer needed. */
static int draw_one(mix_job **job, mix_kept *k, report *r)
{
    mix_job *j = *job;
    double from = host_seconds();
    const double bright = mix_brightness(&j->frame);
    if (mix_is_still(k, bright)) {
        draw_still(j, k->last, &from);
        return 1;
    }
    if (j->planes.label == NULL && !find_planes(j, r)) {
        return 0;
    }
    from = host_seconds();
    if (!mix_make_picture(j, &from, r)) {
        return 0;
    }
    mix_tell_times(j);
    if (j->o.object != NULL && !mix_keep(k, j, r)) {
        return 0;
    }
    *job = take_over(k, j);
    k->bright = bright;
    mix_depth_seen(&k->depth);
    return 1;
}

int mix_draw_next(mix_ready *n, mix_kept *k, report *r)
{
    if (!n->has_depth && !measure(n, k, 0, r)) {
        return 0;
    }
    const mix_depth was = k->depth;
    k->depth = n->depth;
    n->depth = was;
    const int ok = draw_one(&n->job, k, r);
    if (!ok) {
        n->depth = k->depth;
        k->depth = was;
    }
    return ok;
}
