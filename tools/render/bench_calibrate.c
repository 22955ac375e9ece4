/* bench_calibrate.c: units of work per second of this machine, measured with the built-in room. */
#include "bench_calibrate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/option_value.h"
#include "render_draw.h"

enum { RUNS = 3 };

/* The work of a frame, from the plan and the counts. */
static double work_of(const lmb_plan *plan, const lmb_stats *stats)
{
    const lmb_plan_row *gather = &plan->row[LMB_PLAN_GATHER];
    return plan->work + lmb_plan_units(LMB_OP_PAIRS) * ((double)stats->pairs - gather->op[LMB_OP_PAIRS]) +
           lmb_plan_units(LMB_OP_SEGMENTS) * (double)stats->segments;
}

/* Units per second of one run; 0 if it fails. */
static double run(render_job *j)
{
    lmb_plan plan;
    report r = {""};
    double seconds = 0.0;
    j->lit = 0;
    memset(&j->stats, 0, sizeof j->stats);
    if (lmb_render_begin(j->render, &j->frame) != LMB_OK || lmb_plan_frame(&plan, j->render, 0.0, 0.0) != LMB_OK ||
        !render_draw(j, &r)) {
        return 0.0;
    }
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        seconds += j->workers.stage_s[i];
    }
    return seconds > 0.0 ? work_of(&plan, &j->stats) / seconds : 0.0;
}

double bench_calibrate(int threads)
{
    static const char *const words[] = {"plan", "demo", "--size", "96x72"};
    char *argv[4];
    report r = {""};
    double best = 0.0;
    render_job *j = calloc(1, sizeof *j);
    for (int i = 0; i < 4; ++i) {
        argv[i] = (char *)(uintptr_t)words[i];
    }
    if (j == NULL) {
        return 0.0;
    }
    if (render_options_parse(&j->o, 4, argv, &r)) {
        j->o.threads = threads;
        j->o.view.is_quiet = 1;
        for (int i = 0; i < RUNS && (i > 0 || (render_job_load(j, &r) && render_job_set(j, &r))); ++i) {
            const double rate = run(j);
            best = rate > best ? rate : best;
        }
    }
    render_job_free(j);
    free(j);
    return best;
}
