/* plan_model.h: what operations cost, by numbers that were fitted. Layer 11. */
#ifndef LMB_PLAN_MODEL_H
#define LMB_PLAN_MODEL_H

#include <lambent/plan.h>

typedef struct plan_model {
    float units[LMB_OPS]; /* work of each operation */
} plan_model;

/* The repository's own: plan_model.inc. */
extern const plan_model lmb_model;

/* All of a choice but its rung, settings, error and `meets`, by those settings and the pairs and segments of all tiles.
 * */
void lmb_model_cost(lmb_choice *inout, const plan_model *m, const lmb_facts *f, double pairs, double segments,
                    uint64_t fixed);

#endif
