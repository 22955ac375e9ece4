/* many_lights_cut.h: nodes of the tree of many lights that represent all lights on a surface of a tile. Layer 6. */
#ifndef LMB_TREE_MANY_LIGHTS_CUT_H
#define LMB_TREE_MANY_LIGHTS_CUT_H

#include "../lane/kernels.h"

/* Fills scratch->entry: `open` nodes from the front, `closed` from the back; and the sums over them. */
void lmb_many_lights_cut(lmb_many_lights_scratch *scratch, const lmb_kernels *kernels,
                         const lmb_many_lights_query *query, const lmb_many_lights_job *job);

#endif
