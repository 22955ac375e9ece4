/* many_cut.h: which nodes of the lights' tree stand for all lights on one surface of a tile. Floor 6. */
#ifndef LMB_MANYLIGHTS_MANY_CUT_H
#define LMB_MANYLIGHTS_MANY_CUT_H

#include "../lane/kernels.h"

/* Fills scratch->entry: `open` nodes from the front, `closed` from the back; and the sums over them. */
void lmb_many_cut(lmb_many_scratch *scratch, const lmb_kernels *kernels, const lmb_many_look *look,
                  const lmb_many_job *job);

#endif
