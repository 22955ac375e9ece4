/* verb_plan.c: `lambent plan`: cost of a picture and the settings that leave something out, before it is drawn. */
#include "verb_plan.h"

#include "../../platform/host/host.h"
#include "../render/render_verb.h"
#include "plan_table.h"

static int plan(render_job *j, report *r)
{
    lmb_plan p;
    budget_choice choice;
    const double start = host_seconds();
    if (j->o.stats != NULL) {
        return report_fail_usage(r, "--stats: plan draws no picture; use plan --json, or lambent render --stats");
    }
    if (!render_job_load(j, r) || !render_job_set(j, r) || !budget_fit(&choice, j, r)) {
        return 0;
    }
    lmb_status status = lmb_render_begin(j->render, &j->frame);
    if (status == LMB_OK) {
        status = lmb_plan_frame(&p, j->render, choice.facts.pairs, choice.facts.segments);
    }
    if (status != LMB_OK) {
        return report_fail(r, "%s: cannot be planned: %s", j->o.scene, lmb_status_name(status));
    }
    report_note(!j->o.view.is_verbose, "planned in %.1f ms, with the reading of the scene",
                (host_seconds() - start) * 1e3);
    report_print_notes();
    if (j->o.json) {
        plan_print_json(&p, j, &choice);
    } else {
        plan_print_table(&p, j, &choice);
    }
    return 1;
}

int verb_plan(int argc, char **argv) { return render_verb(&plan_table, argc, argv, plan); }
