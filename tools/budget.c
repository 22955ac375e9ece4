/* budget.c: looks at a job's scene, and sets its options as its budget has them. */
#include "budget.h"

#include <stdio.h>
#include <string.h>

#include "bench_calibrate.h"
#include "scene_look.h"

enum { MOST_MAP = 4096 };

/* Bytes that no setting changes. */
static uint64_t fixed_bytes(const render_job *j)
{
    const lmb_frame *f = &j->frame;
    const uint64_t pixels = (uint64_t)f->view.frame_width * (uint64_t)f->view.frame_height;
    return (uint64_t)lmb_blockers_bytes(lmb_scene_triangles(f->scene)) +
           (f->elements.data != NULL ? (uint64_t)lmb_elements_bytes(f->elements.cap) : 0) + sizeof(lmb_band_scratch) +
           pixels * (4 + 4 + 12);
}

void budget_apply(render_job *j, const lmb_settings *s)
{
    j->o.light_map = s->light_map;
    j->o.tree = s->tree;
    j->o.error = s->error;
    j->o.visible = s->visible;
    j->o.gather_step = s->gather_step;
    j->o.occlusion = s->occlusion;
}

void budget_words(char *out, size_t size, const budget_choice *c)
{
    const lmb_budget *b = &c->budget;
    const lmb_choice *a = &c->chosen;
    static const char none[] = "no setting meets the budget; the nearest takes ";
    size_t n = 0;
    out[0] = '\0';
    if (b->work > 0.0 && a->work > b->work) {
        n += (size_t)snprintf(out + n, size - n, "%s%.3g x the work", none, a->work / b->work);
    }
    if (b->bytes > 0 && a->bytes > b->bytes && n < size) {
        n += (size_t)snprintf(out + n, size - n, "%s%.3g x the bytes (%.0f KiB)", n > 0 ? ", " : none,
                              (double)a->bytes / (double)b->bytes, (double)a->bytes / 1024.0);
    }
    if (b->error > 0.0f && a->error > b->error && n < size) {
        snprintf(out + n, size - n, "%s%.3g x the error", n > 0 ? ", " : none, (double)(a->error / b->error));
    }
    if (n == 0 && out[0] == '\0') {
        snprintf(out, size, "the budget is met");
    }
}

static void tell(const budget_choice *c)
{
    const lmb_settings *s = &c->chosen.settings;
    char words[200];
    budget_words(words, sizeof words, c);
    fprintf(stderr,
            "lambent: chosen: --light-map %d --tree %d --error %.3g --visible %.3g --gather %s --occlusion %s: error "
            "about %.2g, %.3g units of work, %.0f KiB\n",
            (int)s->light_map, (int)s->tree, (double)s->error, (double)s->visible,
            s->gather_step == 1 ? "full" : s->gather_step == 2 ? "half" : "quarter",
            s->occlusion == LMB_OCCLUSION_EXACT ? "exact" : "none", (double)c->chosen.error, c->chosen.work,
            (double)c->chosen.bytes / 1024.0);
    fprintf(stderr, "lambent: %s\n", words);
}

int budget_fit(budget_choice *out, render_job *j, report *r)
{
    memset(out, 0, sizeof *out);
    if (!scene_look(&out->facts, j, r)) {
        return 0;
    }
    out->budget = j->o.budget;
    if (!has_budget(&j->o.budget, j->o.budget_ms)) {
        return 1;
    }
    if (out->facts.tree == 0) {
        return report_fail(r, "%s: --budget-*: no light bounces here that settings could be chosen for", j->o.scene);
    }
    if (j->o.budget_ms > 0.0f) {
        out->rate = j->o.rate > 0.0f ? (double)j->o.rate : bench_calibrate(j->crew.threads);
        out->budget.work = out->rate * (double)j->o.budget_ms * 1e-3;
    }
    if (lmb_plan_choose(&out->chosen, &out->facts, &out->budget, fixed_bytes(j), MOST_MAP) != LMB_OK) {
        return report_fail(r, "%s: --budget-*: nothing to choose from", j->o.scene);
    }
    budget_apply(j, &out->chosen.settings);
    tell(out);
    return render_job_refit(j, r);
}
