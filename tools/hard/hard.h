/* hard.h: the gallery of hard cases: what renderers get wrong, each with a number and what it may be at most.
 *
 * It is part of the tool and not of the tests, so that people see on their own machine what was tried (`lambent bench
 * hard`); tests/hard runs the same list and fails where a number is past its bound. */
#ifndef HARD_H
#define HARD_H

#include <lambent/lambent.h>

#include "hard_stage.h"

/* EXACT: 0 by design. BOUNDED: what arithmetic or a stated formula allows. MEASURED: against an independent reference,
 * the bound a little over what was found, so that it cannot grow unseen. */
enum { HARD_EXACT = 0, HARD_BOUNDED, HARD_MEASURED };

typedef struct hard_case {
    const char *room, *name, *unit;
    int kind;
    double figure, bound; /* holds where figure <= bound; NaN never does */
} hard_case;

enum { HARD_CASES = 192 };

typedef struct hard_list {
    hard_case item[HARD_CASES];
    int count;
    const char *room;
    hard_stage *stage; /* the rooms' own, in turn */
} hard_list;

/* hard_run: the cases of the room of that name, or of all where it is NULL. 0: no such room, or no memory. */
int hard_run(hard_list *out, const char *room, const lmb_kernels *kernels);
extern const char *const hard_rooms[]; /* ends with NULL */

/* hard_put: one more case of the room at hand. */
void hard_put(hard_list *list, int kind, const char *name, double figure, double bound, const char *unit);
int hard_holds(const hard_case *c);
const char *hard_kind_name(int kind);

/* part / whole; where there is nothing to count, a figure that no bound allows. */
double hard_share(double part, double whole);

void hard_raster(hard_list *list);
void hard_views(hard_list *list); /* the raster room's views */
void hard_shadow(hard_list *list);
void hard_bounce(hard_list *list);
void hard_probe(hard_list *list);
void hard_relief(hard_list *list);
void hard_mixed(hard_list *list);
void hard_far(hard_list *list);
void hard_all(hard_list *list);

#endif
