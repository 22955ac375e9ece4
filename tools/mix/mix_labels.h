/* mix_labels.h: what each pixel shows of the object, for those who teach machines by such pictures. */
#ifndef MIX_LABELS_H
#define MIX_LABELS_H

#include "mix_job.h"

/* By pixel. */
struct mix_labels {
    float *covered; /* 0 .. 1 */
    float *depth;   /* m along the camera's axis; 0: the object is not seen */
    float *normal;  /* 3: unit, in the camera's space: x right, y up, z back */
};

/* mix_labels_take: room for them, where they are asked for. 1, or 0 with `r` set. */
int mix_labels_take(mix_job *j, report *r);

/* mix_labels_sample: what one sample shows of the object at some of a tile's pixels; the first that shows any counts.
 * mix_labels_cover: how much of each of them it covers. */
void mix_labels_sample(const mix_job *j, const lmb_tile *real, const lmb_tile *object, uint64_t shown);
void mix_labels_cover(const mix_job *j, const lmb_tile *real, const float covered[LMB_TILE_PIXELS]);

/* mix_labels_write: PREFIX.mask.png, .depth.pfm, .normal.pfm and .pose.json. 1, or 0 with `r` set. */
int mix_labels_write(const mix_job *j, report *r);

#endif
