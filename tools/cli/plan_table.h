/* plan_table.h: prints a plan as text or JSON. */
#ifndef PLAN_TABLE_H
#define PLAN_TABLE_H

#include "../render/budget.h"

/* Print to stdout. `plan` is for the job's frame, with the facts in `choice`. */
void plan_print_table(const lmb_plan *plan, const render_job *j, const budget_choice *choice);
void plan_print_json(const lmb_plan *plan, const render_job *j, const budget_choice *choice);

#endif
