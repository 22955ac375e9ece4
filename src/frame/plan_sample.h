/* plan_sample.h: samples of a frame's tiles. Layer 8. */
#ifndef LMB_PLAN_SAMPLE_H
#define LMB_PLAN_SAMPLE_H

#include <lambent/plan.h>

/* Estimates pairs and segments of the whole frame from `facts`, for a frame's settings. */
void lmb_facts_count(double *pairs, double *segments, const lmb_facts *facts, const lmb_frame *frame);

/* Can you sample this frame? Not if r is NULL. */
int lmb_can_sample(const lmb_render *r);

#endif
