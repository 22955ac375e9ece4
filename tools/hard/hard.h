/* hard.h: the gallery of hard cases: what renderers get wrong, each with a number and what it may be at most.
 *
 * It is part of the tool and not of the tests, so that people see on their own machine what was tried (`lambent bench
 * hard`); tests/hard runs the same list and fails where a number is past its bound. */
#ifndef HARD_H
#define HARD_H

#include "hard_list.h"

/* hard_run: the cases of the room of that name, or of all where it is NULL. 0: no such room, or no memory. */
int hard_run(hard_list *out, const char *room, const lmb_kernels *kernels);
extern const char *const hard_rooms[]; /* ends with NULL */

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
