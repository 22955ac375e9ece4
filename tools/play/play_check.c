/* play_check.c: draws a frame again with the best settings, and compares. */
#include "play_check.h"

#include <string.h>

/* Memory of the world stays owned by the job. */
static void take_world(render_job *b, const render_job *j)
{
    b->many_lights.tree = j->many_lights.tree;
    b->gathers_sky = j->gathers_sky;
    b->around = j->around;
}

/* Sets the frame up for another world. */
static int change_world(play_check *c, const render_job *j, report *r)
{
    take_world(&c->best, j);
    if (!render_job_refit(&c->best, r)) {
        return 0;
    }
    memset(c->best.render, 0, sizeof *c->best.render);
    return 1;
}

/* Copies the job's options, except those that --quality sets. */
static int make(play_check *c, const render_job *j, report *r)
{
    render_job *b = &c->best;
    b->o = j->o;
    b->o.quality = LMB_QUALITY_BEST;
    b->o.transfer = NULL;
    b->o.shadow_map = b->o.tree = b->o.conservative = 0;
    b->o.error = b->o.visibility = 0.0f;
    b->o.gather_step = 1;
    memset(&b->o.grouping, 0, sizeof b->o.grouping);
    b->o.grouping.method = LMB_GROUP_CUT;
    b->o.occlusion = LMB_OCCLUSION_EXACT;
    b->scene = j->scene;
    b->middle = j->middle;
    b->eyes = 1;
    take_world(b, j);
    b->workers.threads = j->workers.threads;
    c->is_made = 1;
    return render_job_take(b, r);
}

int play_check_frame(metrics *out, play_check *c, const render_job *j, uint32_t worlds, report *r)
{
    render_job *b = &c->best;
    metrics_input in;
    int32_t stage;
    if (!c->is_made && !make(c, j, r)) {
        return 0;
    }
    b->scene = j->scene;
    b->middle = j->middle;
    if (c->worlds != worlds && !change_world(c, j, r)) {
        return 0;
    }
    c->worlds = worlds;
    render_job_eye(b, &b->frame, &b->linear, 0);
    const lmb_status status = workers_reuse(&b->workers, &stage, b->render, &b->frame);
    if (status != LMB_OK) {
        return report_fail(r, "%s: drawing by --quality best stopped: %s", j->o.scene, lmb_status_name(status));
    }
    memset(&in, 0, sizeof in);
    in.test = j->linear.pixels;
    in.truth = b->linear.pixels;
    in.width = b->linear.width;
    in.height = b->linear.height;
    in.channels = b->linear.channels;
    return metrics_measure(out, &in, r);
}

void play_check_free(play_check *c)
{
    memset(&c->best.around, 0, sizeof c->best.around);
    render_job_free(&c->best);
}
