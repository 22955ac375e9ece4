/* verb_plan.h: `lambent plan`. */
#ifndef VERB_PLAN_H
#define VERB_PLAN_H

int verb_plan(int argc, char **argv);

#endif
