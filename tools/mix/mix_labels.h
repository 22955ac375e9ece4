/* mix_labels.h: per-pixel labels of the object, for training machine learning on such pictures. */
#ifndef MIX_LABELS_H
#define MIX_LABELS_H

#include "mix_job.h"

enum { MIX_LABEL_FLOATS = 9 /* per pixel */, MIX_LABEL_OBJECTS = 16 };

/* By pixel. */
struct mix_labels {
    float *covered; /* 0 .. 1 */
    float *depth;   /* m along the camera's axis; 0: the object is not visible */
    float *normal;  /* 3: unit, in camera space: x right, y up, z back */
    float *rgb;     /* 3: the object's light times `covered` */
    float *object;  /* 0: none, else 1 + the number of the object */
    int32_t count;  /* objects in the picture, with their first ids, files and places */
    uint32_t first[MIX_LABEL_OBJECTS];
    const char *path[MIX_LABEL_OBJECTS];
    lmb_mat4 placed[MIX_LABEL_OBJECTS];
};

/* mix_labels_lay_out: sets all arrays from `covered`, which has MIX_LABEL_FLOATS per pixel. */
void mix_labels_lay_out(struct mix_labels *l, size_t pixels);

/* mix_labels_take: takes memory for the labels if they are requested, and estimates the photo's noise if --match-grain
 * is given. Returns 1, or 0 with `r` set. mix_labels_grain: then adds such noise to the covered share of pixels. */
int mix_labels_take(mix_job *j, report *r);

/* mix_labels_sample: stores one sample's labels at some pixels of a tile; the first sample that shows the object
 * counts. mix_labels_cover: stores the object's coverage and light of each pixel. */
void mix_labels_sample(const mix_job *j, const lmb_tile *real, const lmb_tile *object, uint64_t shown);
void mix_labels_cover(const mix_job *j, const lmb_tile *real, const lmb_radiance *over,
                      const float covered[LMB_TILE_PIXELS]);

void mix_labels_grain(lmb_radiance *inout, const mix_job *j, const lmb_tile *real,
                      const float covered[LMB_TILE_PIXELS]);

/* mix_labels_write: writes PREFIX.mask.png, .depth.pfm, .normal.pfm, .object.png and .pose.json. Returns 1, or 0 with
 * `r` set. */
int mix_labels_write(const mix_job *j, float exposure_ev, report *r);

#endif
