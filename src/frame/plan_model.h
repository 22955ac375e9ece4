/* plan_model.h: work of operations, from fitted numbers. Layer 8. */
#ifndef LMB_PLAN_MODEL_H
#define LMB_PLAN_MODEL_H

#include <lambent/plan.h>

#include "../base/exact.h"

typedef struct plan_model {
    float units[LMB_OPS]; /* work of each operation */
} plan_model;

/* The model in plan_model.inc. */
extern const plan_model lmb_model;

#endif
