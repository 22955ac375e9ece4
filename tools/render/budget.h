/* budget.h: a job's settings chosen for its budget. */
#ifndef BUDGET_H
#define BUDGET_H

#include "render_job.h"
#include "scene_sample.h"

/* What was looked at and chosen. */
typedef struct budget_choice {
    lmb_facts facts;
    lmb_budget budget; /* the options', with milliseconds as work */
    lmb_choice chosen;
    look_cost look;
    double rate;       /* units a second with the job's threads; 0: was not wanted */
} budget_choice;

/* budget_fit: look at a job that is set; where it has a budget, choose, set its options and memory by that, and say on
 * stderr what was chosen. 1, or 0 with `r` set. */
int budget_fit(budget_choice *out, render_job *j, report *r);

/* In words, one line: what is short of the budget, or that nothing is. */
void budget_words(char *out, size_t size, const budget_choice *c);

#endif
