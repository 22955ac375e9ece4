/* budget.c: samples a job's scene and chooses settings for the budget. */
#include "budget.h"

#include <stdio.h>
#include <math.h>
#include <string.h>

#include "bench_calibrate.h"
#include "scene_sample.h"

/* Bytes that do not depend on settings. */
static uint64_t fixed_bytes(const render_job *j)
{
    const lmb_frame *f = &j->frame;
    const uint64_t pixels = (uint64_t)f->view.frame_width * (uint64_t)f->view.frame_height;
    return (uint64_t)lmb_bvh_bytes(lmb_scene_triangles(f->scene)) +
           (f->elements.data != NULL ? (uint64_t)lmb_elements_bytes(f->elements.cap) : 0) + sizeof(lmb_band_scratch) +
           pixels * (4 + 4 + 12);
}

void budget_words(char *out, size_t size, const budget_choice *c)
{
    const ladder_budget *b = &c->budget;
    const ladder_choice *a = &c->chosen;
    static const char none[] = "no setting meets the budget; the nearest takes ";
    static const char unchecked[] = "no setting is known to meet the budget: to check the nearest would cost over a "
                                    "fifth of the picture";
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
        n += (size_t)snprintf(out + n, size - n, "%s%.3g x the error", n > 0 ? ", " : none,
                              (double)(a->error / b->error));
    }
    if (b->error > 0.0f && a->error < 0.0f && n < size) {
        snprintf(out + n, size - n, "%s", n > 0 ? "; its error was not checked" : unchecked);
    }
    if (n == 0 && out[0] == '\0') {
        snprintf(out, size, "the budget is met");
    }
}

/* `all`: bytes of the whole job. */
static void tell(const budget_choice *c, size_t all, int is_quiet)
{
    const ladder_settings *s = &c->chosen.settings;
    char words[200], error[32] = "not checked";
    budget_words(words, sizeof words, c);
    if (c->chosen.error >= 0.0f) {
        snprintf(error, sizeof error, "about %.2g", (double)c->chosen.error);
    }
    report_note(
        is_quiet,
        "chosen: --shadow-map %d --tree %d --error %.3g --visibility %.3g --gather full --occlusion %s: error %s, %.3g "
        "units of work, %.0f KiB, and %.0f KiB of state and scratch of threads",
        (int)s->shadow_map, (int)s->tree, (double)s->error, (double)s->visibility,
        s->occlusion == LMB_OCCLUSION_EXACT ? "exact" : "none", error, c->chosen.work,
        (double)c->chosen.bytes / 1024.0, fmax((double)all - (double)c->chosen.bytes, 0.0) / 1024.0);
    report_note(is_quiet, "looked at %.3g units of work, %.0f %% of the picture's", c->look.work,
                100.0 * c->look.work / c->chosen.work);
    report_note(is_quiet, "%s", words);
}

/* Applies the chosen settings. If tree and maps are those of the last sample, that light is reused. */
static int take_choice(budget_choice *c, render_job *j, report *r)
{
    const ladder_settings *s = &c->chosen.settings;
    render_job_apply(j, s);
    if (!c->look.solved || j->frame.tree.size != s->tree || j->frame.shadow_map != s->shadow_map) {
        return render_job_refit(j, r);
    }
    j->frame.error = s->error;
    j->frame.visibility = s->visibility;
    j->frame.occlusion = s->occlusion;
    c->look.work -= c->look.light;
    j->lit = 1;
    return 1;
}

int budget_fit(budget_choice *out, render_job *j, report *r)
{
    memset(out, 0, sizeof *out);
    out->budget = j->o.budget;
    if (j->o.budget_ms > 0.0f) {
        out->rate = j->o.rate > 0.0f ? (double)j->o.rate : bench_calibrate(j->workers.threads);
        out->budget.work = out->rate * (double)j->o.budget_ms * 1e-3;
    }
    const uint64_t fixed = fixed_bytes(j);
    if (!scene_sample(&out->facts, &out->look, j, &out->budget, fixed, r)) {
        return 0;
    }
    if (!has_budget(&out->budget, 0.0f)) {
        return 1;
    }
    if (out->facts.max == 0) {
        return report_fail(r, "%s: --budget: no light bounces here that settings could be chosen for", j->o.scene);
    }
    if (!ladder_choose(&out->chosen, &out->facts, &out->budget, fixed)) {
        return report_fail(r, "%s: --budget: nothing to choose from", j->o.scene);
    }
    if (!take_choice(out, j, r)) {
        return 0;
    }
    ladder_choice c;
    ladder_cost(&c, &out->facts, out->chosen.rung, fixed);
    out->facts.pairs = c.op[LMB_OP_PAIRS];
    out->facts.segments = c.op[LMB_OP_SEGMENTS];
    tell(out, j->bytes + j->many_lights.bytes, j->o.view.is_quiet);
    return 1;
}
