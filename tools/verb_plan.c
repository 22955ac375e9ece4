/* verb_plan.c: `lambent plan`: what a picture takes and what it does without, before it is drawn. */
#include "verb_plan.h"

#include <stdio.h>
#include <string.h>

#include "plan_table.h"

static const char usage[] =
    "usage: lambent plan SCENE [options of `lambent render`, without -o] [--budget-...] [--json]\n"
    "\n"
    "What `lambent render` with the same options would do, and draws nothing: the stages it runs, with counted\n"
    "operations, units of work and memory; those it leaves out, and why. `exact`: the picture has the same bytes as\n"
    "with it; that is proven, and tested. Without a budget nothing else is left out.\n"
    "\n"
    "  a lamp of 0 W               no map, no light\n"
    "  a lamp that looks past      the faces of its map that see nothing of the scene are not drawn\n"
    "  nothing reflects, or is lit no bounced light\n"
    "  no glossy material          no lobe;   none that shines: no emitted light\n"
    "  a convex, empty room        nothing stands between two points of it: no segment is asked\n"
    "\n"
    "Pairs and segments of bounced light are told by a look at up to 192 tiles of the picture itself. So is the error\n"
    "of what is chosen for a budget, against a finer setting. No look costs over a quarter of the picture.\n"
    "Work is counted in units: one is a pixel lit by one node.\n"
    "\n"
    "  --json                      all of it for programs\n";

/* What follows is `render`'s own list: its last part. */
static void help(void)
{
    fputs(usage, stdout);
    fputs(render_usage[RENDER_USAGE_PARTS - 1], stdout);
    fputs("\n  lambent plan demo\n"
          "  lambent plan room.gltf --budget-ms 16          what fits a frame of 16 ms on this machine\n"
          "  lambent plan room.gltf --budget-error 0.02     the least work for 2 % of error\n"
          "  lambent plan room.gltf --budget-bytes 100KiB   what fits a small memory, or by how much nothing does\n"
          "  lambent render --help                          the other options\n",
          stdout);
}

static int plan(render_job *j, report *r)
{
    lmb_plan p;
    budget_choice choice;
    if (!render_job_load(j, r) || !render_job_set(j, r) || !budget_fit(&choice, j, r)) {
        return 0;
    }
    lmb_status status = lmb_render_begin(j->render, &j->frame);
    if (status == LMB_OK) {
        status = lmb_plan_frame(&p, j->render, choice.facts.most > 0 ? &choice.facts : NULL);
    }
    if (status != LMB_OK) {
        return report_fail(r, "%s: cannot be planned: %s", j->o.scene, lmb_status_name(status));
    }
    if (j->o.json) {
        plan_print_json(&p, j, &choice);
    } else {
        plan_print_table(&p, j, &choice);
    }
    return 1;
}

int verb_plan(int argc, char **argv)
{
    report r = {""};
    static render_job j; /* too large for a small stack: the options hold 64 lights */
    memset(&j, 0, sizeof j);
    if (!render_options_parse(&j.o, argc, argv, &r)) {
        fprintf(stderr, "lambent plan: %s\n", r.text);
        return 2;
    }
    if (j.o.help) {
        help();
        return 0;
    }
    if (j.o.show >= SHOW_DEPTH) {
        fprintf(stderr, "lambent plan: --show: plans are of pictures of light: full, direct, indirect, irradiance\n");
        return 2;
    }
    const int ok = plan(&j, &r);
    if (!ok) {
        fprintf(stderr, "lambent plan: %s\n", r.text);
    }
    render_job_free(&j);
    return ok ? 0 : 1;
}
