/* mend.h: pixels of a warped tile that nothing around them explains. Layer 6. */
#ifndef MEND_H
#define MEND_H

#include <lambent/relief.h>

#include "../lane/kernels.h"

/* lmb_relief_mend: after the kernel, before pixels that missed are cleared. `found` says afterwards what became of
 * each; a pixel that the simple model left out may be among those that hit. */
void lmb_relief_mend(lmb_tile *inout, lmb_relief_found *found, const lmb_relief_job *job, const lmb_view *view);

/* lmb_relief_beside: bits of the up to eight pixels of a tile around pixel k. */
uint64_t lmb_relief_beside(int k);

#endif
