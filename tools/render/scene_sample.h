/* scene_sample.h: samples a few tiles of a scene, to estimate work and to choose settings. */
#ifndef SCENE_SAMPLE_H
#define SCENE_SAMPLE_H

#include "ladder.h"
#include "render_job.h"

/* Cost of the sampling. */
typedef struct look_cost {
    double work, light, seconds; /* units; the part of the light solved last; wall time */
    int32_t solved;       /* 1: the job's render and frame hold the light of the rung sampled last */
} look_cost;

/* scene_sample: call it after render_job_set. With a budget it tries the ladder of settings in the job's own memory,
 * and leaves options and frame as the last rung set them. It ends when a rung meets the budget, or when more would
 * cost over a fifth of the picture. Without a budget it uses the job's settings and at most a seventh of the tiles.
 * If no light bounces by cuts, out->max is 0. `fixed`: see ladder_cost. Returns 1, or 0 with `r` set: out of
 * memory. */
int scene_sample(ladder_facts *out, look_cost *cost, render_job *j, const ladder_budget *budget, uint64_t fixed,
                 report *r);

#endif
