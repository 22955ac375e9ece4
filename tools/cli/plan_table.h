/* plan_table.h: a plan as people read it, and as JSON. */
#ifndef PLAN_TABLE_H
#define PLAN_TABLE_H

#include "../render/budget.h"

/* On stdout. `plan` is of the job's frame, with the facts in `choice`. */
void plan_print_table(const lmb_plan *plan, const render_job *j, const budget_choice *choice);
void plan_print_json(const lmb_plan *plan, const render_job *j, const budget_choice *choice);

#endif
