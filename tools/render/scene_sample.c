/* scene_sample.c: samples a few tiles on each rung of a ladder of settings; each rung checks the one before. */
#include "scene_sample.h"

#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"

#define SHARE      0.21 /* of the picture's work, for sampling: a quarter, less a margin for wrong estimates */
#define FOR_ITSELF 0.35 /* of the remaining work, for a rung's own samples; the rest is for checking it */
#define GROWTH     2.2  /* work of a sampled tile on the next rung over this one: 1.3 to 3 were measured */
enum { PART = 32 /* the first two rungs sample one place in PART, */, FINE = 3 /* finer rungs FINE times as many */,
       OWN_PART = 7, MIN = 4 /* fewest places for a check */ };
enum { DRAFT = 3 /* first rung with errors worth checking */ };
enum { MAP_TEXELS = 2 << 20 /* over all shadow maps */ };

typedef struct looker {
    render_job *job;
    const ladder_budget *budget;
    uint64_t fixed;
    ladder_facts *facts;
    look_cost *cost;
    lmb_tile_sample *sample[2]; /* of the rung before, and of this one */
    lmb_survey places;
    report *report;
    int32_t rung; /* whose light is solved; -1: none */
} looker;

/* Standard deviations added as a margin to sampled means; more if there are few places. */
static float deviations(int32_t places) { return 1.0f + 4.0f / (float)places; }

/* Error of a rung over the difference from the next, an upper bound for nearly all measured scenes
 * (src/DECISIONS.md). The last two have trees of one size. */
static const float off_over_next[LADDER_RUNGS - 1] = {2.0f, 2.0f, 2.0f, 2.0f, 1.5f, 2.5f, 3.5f};

static double unit(lmb_op op) { return lmb_plan_units((int32_t)op); }

/* Work of the maps, tree and view of a rung. */
static double light_work(const looker *l, int32_t rung)
{
    ladder_facts f = *l->facts;
    ladder_choice c;
    f.tiles = 0.0;
    ladder_cost(&c, &f, rung, 0);
    return c.work;
}

static double rung_work(const looker *l, int32_t rung)
{
    ladder_choice c;
    ladder_cost(&c, l->facts, rung, l->fixed);
    return c.work;
}

static int has_same_light(const looker *l, int32_t a, int32_t b)
{
    ladder_settings x, y;
    ladder_at(&x, l->facts, a);
    ladder_at(&y, l->facts, b);
    return x.tree == y.tree && x.shadow_map == y.shadow_map;
}

/* Solves the light of a frame, and draws the view. `samples`: adds the work of LMB_STAGE_SAMPLES, unless NULL. */
static lmb_status solve(render_job *j, lmb_frame f, lmb_stats *samples)
{
    f.stats = NULL;
    lmb_status status = lmb_render_begin(j->render, &f);
    while (status == LMB_OK && j->render->stage < LMB_STAGE_BANDS) {
        j->render->frame.stats = j->render->stage == LMB_STAGE_SAMPLES ? samples : NULL;
        status = lmb_render_step(j->render, 64);
        status = status == LMB_MORE ? LMB_OK : status;
    }
    return status;
}

/* The frame for samples: one bounce, because errors of later ones are small; without many lights. */
static lmb_frame frame_of(const render_job *j)
{
    lmb_frame f = j->frame;
    f.show = f.show == LMB_SHOW_FULL ? LMB_SHOW_FULL : LMB_SHOW_INDIRECT;
    f.many_lights = NULL;
    f.bounces = 1;
    return f;
}

static lmb_status solve_rung(looker *l, int32_t rung)
{
    render_job *j = l->job;
    ladder_settings s;
    ladder_at(&s, l->facts, rung);
    render_job_apply(j, &s);
    if (l->rung >= 0 && has_same_light(l, l->rung, rung)) {
        j->frame.error = j->render->frame.error = s.error;
        j->frame.visibility = j->render->frame.visibility = s.visibility;
        l->rung = rung;
        return LMB_OK;
    }
    if (!render_job_refit(j, l->report)) {
        return LMB_ERR_CAPACITY;
    }
    l->cost->light = light_work(l, rung);
    l->cost->work += l->cost->light;
    l->rung = rung;
    return solve(j, frame_of(j), NULL);
}

static void survey(looker *l, int32_t wanted)
{
    ladder_places(&l->places, &l->job->frame.view, wanted < LMB_SAMPLE_TILES ? wanted : LMB_SAMPLE_TILES);
}

/* Samples a rung with up to `max` units of work. */
static lmb_status look_at(looker *l, lmb_tile_sample *out, int32_t rung, double max)
{
    ladder_rung *at = &l->facts->rung[rung];
    const lmb_status status = lmb_render_sample(out, l->job->render, l->job->frame.scratch, &l->places, max);
    if (status == LMB_OK) {
        at->places = out->places;
        at->pairs = (float)(out->pairs / (double)out->places);
        at->segments = (float)(out->segments / (double)out->places);
        l->cost->work += out->pairs * unit(LMB_OP_PAIRS) + out->segments * unit(LMB_OP_SEGMENTS);
    }
    return status;
}

/* The work left before planning a picture with `rung` costs too much, once the light of `next` is solved. If the
 * picture can use the light that was solved last, that costs nothing. */
static double left_for(const looker *l, int32_t rung, int32_t next)
{
    const int stands = has_same_light(l, l->rung, next), is_own = has_same_light(l, rung, next);
    const double kept = stands && is_own ? light_work(l, next) : 0.0;
    return SHARE * rung_work(l, rung) - (l->cost->work - kept) - (stands || is_own ? 0.0 : light_work(l, next));
}

/* Returns whether the work left pays for enough places on the next rung. */
static int affords(const looker *l, int32_t rung, double left)
{
    const ladder_rung *at = &l->facts->rung[rung];
    const double place = (double)at->pairs * unit(LMB_OP_PAIRS) + (double)at->segments * unit(LMB_OP_SEGMENTS);
    return left > GROWTH * MIN * place && left > 0.0;
}

/* Returns whether the traversal ends here, because finer rungs are not needed or exceed the budget. */
static int is_last(const looker *l, int32_t rung)
{
    const ladder_budget *b = l->budget;
    ladder_choice c;
    if (rung < 0) {
        return 0;
    }
    ladder_cost(&c, l->facts, rung, l->fixed);
    return (b->error > 0.0f && c.error >= 0.0f && c.error <= b->error) || (b->work > 0.0 && c.work > b->work) ||
           (b->bytes > 0 && c.bytes > b->bytes);
}

/* Goes up the rungs. Samples of a rung are paid from the share of the rung before, which they check. If that is not
 * enough, the rung before is skipped without a check, and this rung pays. */
static lmb_status traversal(looker *l)
{
    const int32_t first = l->budget->work > 0.0 || l->budget->bytes > 0 ? 0 : DRAFT;
    lmb_status status = solve_rung(l, first);
    const int32_t wanted = FINE * ((int32_t)(l->facts->tiles / PART) + 1);
    survey(l, wanted);
    const int32_t all = l->places.count;
    l->places.count = (all + FINE - 1) / FINE;
    status = status != LMB_OK ? status : look_at(l, l->sample[0], first, 0.0);
    int32_t before = first;
    for (int32_t i = first + 1; i < LADDER_RUNGS && status == LMB_OK && !is_last(l, i - 1) && !is_last(l, i - 2);
         ++i) {
        const double checks = left_for(l, i - 1, i), goes_on = left_for(l, i, i);
        const int can_check = before == i - 1 && affords(l, before, checks);
        if (!can_check && (i == LADDER_RUNGS - 1 || !affords(l, before, goes_on))) {
            continue;
        }
        l->places.count = i > first + 1 ? all : l->places.count;
        status = solve_rung(l, i);
        status = status != LMB_OK ? status : look_at(l, l->sample[1], i, can_check ? checks : goes_on * FOR_ITSELF);
        if (status == LMB_OK && can_check) {
            const float bound = ladder_error(l->sample[0], l->sample[1], deviations(l->sample[1]->places));
            l->facts->rung[i - 1].error = bound * off_over_next[i - 1];
        }
        lmb_tile_sample *other = l->sample[0];
        l->sample[0] = l->sample[1];
        l->sample[1] = other;
        before = i;
    }
    return status;
}

/* Counts pairs and segments with the job's own settings. */
static lmb_status take_own(looker *l)
{
    render_job *j = l->job;
    lmb_frame f = j->frame;
    lmb_stats counts;
    f.many_lights = NULL;
    f.show = f.show == LMB_SHOW_FULL ? LMB_SHOW_FULL : LMB_SHOW_INDIRECT;
    memset(&counts, 0, sizeof counts);
    lmb_status status = solve(j, f, &counts);
    if (f.gather_step > 1) { /* the samples of the whole frame are part of the solution */
        l->facts->pairs = (double)counts.pairs;
        l->facts->segments = (double)counts.segments;
        return status;
    }
    survey(l, (int32_t)(l->facts->tiles / OWN_PART) + 1);
    status = status != LMB_OK ? status : lmb_render_sample(l->sample[0], j->render, f.scratch, &l->places, 0.0);
    if (status == LMB_OK) {
        const double each = l->facts->tiles / (double)l->sample[0]->places;
        l->facts->pairs = l->sample[0]->pairs * each;
        l->facts->segments = l->sample[0]->segments * each;
    }
    return status;
}

/* Sets the facts that need no samples. */
static int set_counts(ladder_facts *out, const render_job *j)
{
    const lmb_frame *f = &j->frame;
    const lmb_view *v = &f->view;
    lmb_hull hull;
    if (lmb_render_begin(j->render, f) != LMB_OK) {
        return 0;
    }
    const lmb_render *r = j->render;
    out->triangles = (double)r->triangles;
    for (uint32_t i = 0; i < f->scene->light_count && f->many_lights == NULL; ++i) {
        for (uint32_t bits = r->maps[i].drawn; bits != 0; bits >>= 1) {
            out->faces += bits & 1u ? 1.0 : 0.0;
        }
        out->lights += (r->light_state[i] & LMB_LIGHT_DARK) == 0 ? 1.0 : 0.0;
    }
    out->tiles = (double)((v->frame_width + 7) / 8) * (double)((v->frame_height + 7) / 8);
    out->bounces = (double)(f->bounces + (r->emits ? 1 : 0));
    out->elements = f->elements.data != NULL ? (double)f->elements.cap : 0.0;
    lmb_hull_find(&hull, f->scene);
    out->convex = hull.count > 0;
    for (out->wanted_map = 64; out->wanted_map < v->frame_width && out->wanted_map < 4096; out->wanted_map *= 2) {
    }
    for (out->max = 1024; out->max > 64 && (double)out->max * out->max * f->tree.face_cap > MAP_TEXELS; out->max /= 2) {
    }
    for (int i = 0; i < LADDER_RUNGS; ++i) {
        out->rung[i].error = -1.0f;
    }
    return 1;
}

int scene_sample(ladder_facts *out, look_cost *cost, render_job *j, const ladder_budget *budget, uint64_t fixed,
                 report *r)
{
    const double start = host_seconds();
    looker l;
    memset(out, 0, sizeof *out);
    memset(cost, 0, sizeof *cost);
    memset(&l, 0, sizeof l);
    if (j->frame.tree.texel == NULL || j->frame.grouping.method != LMB_GROUP_CUT) {
        return 1; /* no bounces, or by groups, where pairs are not counted */
    }
    l.job = j;
    l.budget = budget;
    l.fixed = fixed;
    l.facts = out;
    l.cost = cost;
    l.report = r;
    l.rung = -1;
    lmb_tile_sample *looks = malloc(2 * sizeof *looks);
    int ok = looks != NULL && set_counts(out, j);
    if (ok) {
        l.sample[0] = looks;
        l.sample[1] = looks + 1;
        const lmb_status status = has_budget(budget, 0.0f) ? traversal(&l) : take_own(&l);
        ok = status == LMB_OK || report_fail(r, "%s: looking at it stopped: %s", j->o.scene, lmb_status_name(status));
    } else {
        report_fail(r, "not enough memory to look at the scene; without a budget it is drawn without");
    }
    cost->solved = l.rung >= 0 && j->frame.bounces <= 1 && j->frame.many_lights == NULL;
    cost->seconds = host_seconds() - start;
    free(looks);
    return ok;
}
