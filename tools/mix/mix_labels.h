/* mix_labels.h: per-pixel labels of the object, for training machine learning on such pictures. */
#ifndef MIX_LABELS_H
#define MIX_LABELS_H

#include "mix_job.h"

/* By pixel. */
struct mix_labels {
    float *covered; /* 0 .. 1 */
    float *depth;   /* m along the camera's axis; 0: the object is not visible */
    float *normal;  /* 3: unit, in camera space: x right, y up, z back */
};

/* mix_labels_take: takes memory for the labels if they are requested. Returns 1, or 0 with `r` set. */
int mix_labels_take(mix_job *j, report *r);

/* mix_labels_sample: stores one sample's labels at some pixels of a tile; the first sample that shows the object
 * counts. mix_labels_cover: stores the object's coverage of each pixel. */
void mix_labels_sample(const mix_job *j, const lmb_tile *real, const lmb_tile *object, uint64_t shown);
void mix_labels_cover(const mix_job *j, const lmb_tile *real, const float covered[LMB_TILE_PIXELS]);

/* mix_labels_write: writes PREFIX.mask.png, .depth.pfm, .normal.pfm and .pose.json. Returns 1, or 0 with `r` set. */
int mix_labels_write(const mix_job *j, report *r);

#endif
