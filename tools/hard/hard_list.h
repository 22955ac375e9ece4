/* hard_list.h: a list of hard cases, each with a figure and an upper bound. */
#ifndef HARD_LIST_H
#define HARD_LIST_H

#include <lambent/lambent.h>

#include "hard_stage.h"

/* EXACT: 0 by design. BOUNDED: limited by rounding or a stated formula. MEASURED: against an independent reference,
 * with a bound slightly above the measured figure, so that it cannot grow unnoticed. */
enum { HARD_EXACT = 0, HARD_BOUNDED, HARD_MEASURED };

typedef struct hard_case {
    const char *group, *name, *unit;
    int kind;
    double figure, bound; /* holds if figure <= bound; NaN never does */
} hard_case;

enum { HARD_CASES = 224 };

typedef struct hard_list {
    hard_case item[HARD_CASES];
    int count;
    const char *group;
    hard_stage *stage; /* shared; each group sets it up */
} hard_list;

/* hard_put: adds a case to the running group. */
void hard_put(hard_list *list, int kind, const char *name, double figure, double bound, const char *unit);
int hard_holds(const hard_case *c);
const char *hard_kind_name(int kind);

/* part / whole; if whole is 0, a figure that exceeds every bound. */
double hard_share(double part, double whole);

#endif
