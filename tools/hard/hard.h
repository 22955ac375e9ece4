/* hard.h: a gallery of cases that renderers get wrong, each with a measured figure and an upper bound.
 *
 * It is part of the tool and not of the tests, so that you can run it on your machine (`lambent-bench hard`);
 * tests/hard runs the same list and fails if a figure exceeds the bound. */
#ifndef HARD_H
#define HARD_H

#include "hard_list.h"

extern const char *const hard_groups[]; /* the groups of cases; ends with NULL */

/* hard_run: runs the cases of group i of hard_groups, or all if i < 0. Returns 0 if memory is short. */
int hard_run(hard_list *out, int i, const lmb_kernels *kernels);

void hard_raster(hard_list *list);
void hard_views(hard_list *list); /* the views of group raster */
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
void hard_room(hard_list *list);
void hard_slit(hard_list *list);

#endif
