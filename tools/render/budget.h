/* budget.h: chooses the settings of a job for a budget. */
#ifndef BUDGET_H
#define BUDGET_H

#include "render_job.h"
#include "scene_sample.h"

/* Measured facts and the settings chosen. */
typedef struct budget_choice {
    ladder_facts facts;
    ladder_budget budget; /* from the options, with milliseconds converted to work */
    ladder_choice chosen;
    look_cost look;
    double rate;       /* units per second with the job's threads; 0: not needed */
} budget_choice;

/* budget_fit: samples a job after render_job_set. If the job has a budget, it chooses settings, applies them to
 * options and memory, and prints them on stderr. Returns 1, or 0 with `r` set. */
int budget_fit(budget_choice *out, render_job *j, report *r);

/* budget_words: writes one line that lists the limits the choice exceeds, or states that it meets all. */
void budget_words(char *out, size_t size, const budget_choice *c);

#endif
