/* scene_sample.h: a look at a few tiles of a scene: facts that its work is told by and settings are chosen by. */
#ifndef SCENE_SAMPLE_H
#define SCENE_SAMPLE_H

#include "render_job.h"

/* What a look took. */
typedef struct look_cost {
    double work, light, seconds; /* units, and of them what the light took that was solved last; of the clock */
    int32_t solved;       /* 1: the job's render holds the light of the rung that was looked at last, as its frame is */
} look_cost;

/* scene_sample: of a job that is set. With a budget, by the ladder of settings, into the job's own memory, whose
 * options and frame are left as the last rung has them; it ends when a rung meets the budget, or when more would cost
 * over a fifth of the picture. Else by the job's own settings, at a seventh of its tiles or fewer. Where no light
 * bounces by cuts, out->most is 0. `fixed`: as for lmb_plan_cost. 1, or 0 with `r` set: out of memory. */
int scene_sample(lmb_facts *out, look_cost *cost, render_job *j, const lmb_budget *budget, uint64_t fixed, report *r);

#endif
