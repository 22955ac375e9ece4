/* hard_list.h: a list of hard cases: a figure each, and what it may be at most. */
#ifndef HARD_LIST_H
#define HARD_LIST_H

#include <lambent/lambent.h>

#include "hard_stage.h"

/* EXACT: 0 by design. BOUNDED: what arithmetic or a stated formula allows. MEASURED: against an independent reference,
 * the bound a little over what was found, so that it cannot grow unseen. */
enum { HARD_EXACT = 0, HARD_BOUNDED, HARD_MEASURED };

typedef struct hard_case {
    const char *group, *name, *unit;
    int kind;
    double figure, bound; /* holds where figure <= bound; NaN never does */
} hard_case;

enum { HARD_CASES = 224 };

typedef struct hard_list {
    hard_case item[HARD_CASES];
    int count;
    const char *group;
    hard_stage *stage; /* each group sets it up for itself */
} hard_list;

/* hard_put: one more case of the group that runs. */
void hard_put(hard_list *list, int kind, const char *name, double figure, double bound, const char *unit);
int hard_holds(const hard_case *c);
const char *hard_kind_name(int kind);

/* part / whole; where there is nothing to count, a figure that no bound allows. */
double hard_share(double part, double whole);

#endif
