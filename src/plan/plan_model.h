/* plan_model.h: what operations cost and how errors add, by numbers that were fitted. Floor 8. */
#ifndef LMB_PLAN_MODEL_H
#define LMB_PLAN_MODEL_H

#include <lambent/plan.h>

typedef struct plan_model {
    float units[LMB_OPS];         /* work of each operation */
    float cut, map, step;         /* what the looks' errors are multiplied by */
} plan_model;

/* The repository's own: plan_model.inc. */
extern const plan_model lmb_model;

/* By settings: pairs and segments of so many pixels; the error; and all of a choice but its settings and `meets`. */
void lmb_model_light(double *pairs, double *segments, const lmb_facts *f, const lmb_settings *s,
                     double pixels);
float lmb_model_error(const plan_model *m, const lmb_facts *f, const lmb_settings *s);
void lmb_model_cost(lmb_choice *inout, const plan_model *m, const lmb_facts *f, uint64_t fixed);

#endif
