/* many_cell.h: what the stream of lights, the tree and the cut share. Floor 5. */
#ifndef LMB_LIGHT_MANY_CELL_H
#define LMB_LIGHT_MANY_CELL_H

#include <lambent/many.h>

/* Put the lights of `from` to those of `into`; its key stays. Merging is exact, so order and grouping do not matter. */
void lmb_many_merge(lmb_many_cell *into, const lmb_many_cell *from);

#endif
