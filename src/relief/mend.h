/* mend.h: corrects single pixels of a warped tile that disagree with their neighbours. Layer 5. */
#ifndef MEND_H
#define MEND_H

#include <lambent/relief.h>

#include "../lane/kernels.h"

/* lmb_relief_mend: call this after the kernel and before you clear the pixels that missed. Updates `found`; a pixel
 * that the simple model left empty may become a hit. */
void lmb_relief_mend(lmb_tile *inout, lmb_relief_found *found, const lmb_relief_job *job, const lmb_view *view);

/* lmb_relief_beside: mask of the up to eight tile pixels around pixel k. */
uint64_t lmb_relief_beside(int k);

#endif
