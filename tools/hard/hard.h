/* hard.h: the gallery of hard cases: what renderers get wrong, each with a number and what it may be at most.
 *
 * It is part of the tool and not of the tests, so that people see on their own machine what was tried (`lambent bench
 * hard`); tests/hard runs the same list and fails where a number is past its bound. */
#ifndef HARD_H
#define HARD_H

#include "hard_list.h"

extern const char *const hard_groups[]; /* the groups of cases; ends with NULL */

/* hard_run: the cases of group i of hard_groups, or all where i < 0. 0: not enough memory. */
int hard_run(hard_list *out, int i, const lmb_kernels *kernels);

void hard_raster(hard_list *list);
void hard_views(hard_list *list); /* the group raster's views */
void hard_shadow(hard_list *list);
void hard_bounce(hard_list *list);
void hard_probe(hard_list *list);
void hard_relief(hard_list *list);
void hard_mixed(hard_list *list);
void hard_far(hard_list *list);
void hard_whole(hard_list *list);
void hard_baked(hard_list *list);
void hard_cliff(hard_list *list);
void hard_sheet(hard_list *list);
void hard_pillar(hard_list *list);

#endif
