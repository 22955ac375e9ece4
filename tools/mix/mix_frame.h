/* mix_frame.h: a photo with its depth and its camera, read from files. */
#ifndef MIX_FRAME_H
#define MIX_FRAME_H

#include "../picture/picture_read.h"
#include <lambent/mixed.h>

/* Where it is read from. NULL, 0: not given; what `frame` gives is what the others leave open. */
typedef struct mix_source {
    const char *frame; /* PREFIX of .color.(png|jpg|pfm), .depth.(png|pfm) and .json */
    const char *photo, *depth;
    const char *folder;  /* of the list with all names, for file_is_below; NULL: names are from the command line */
    float depth_scale; /* metres of a unit; 0: 0.001 for PNG, 1 for PFM, or what the JSON says */
    float intrinsics[4];
    int32_t has_intrinsics;
} mix_source;

/* mix_frame_free releases it. */
typedef struct mix_frame {
    stored_picture photo; /* as stored */
    image light;          /* the photo as linear light, 3 channels */
    float *depth;         /* m, as wide and high */
    lmb_pinhole camera;
    int has_pose;
    double pose[16];      /* camera (x right, y down, z ahead) to world, rows */
} mix_frame;

/* mix_frame_read: 1, or 0 with `r` set and nothing allocated. */
int mix_frame_read(mix_frame *out, const mix_source *from, report *r);
void mix_frame_free(mix_frame *f);

/* mix_has_shape: is a depth picture as wide for its height as the photo is, and not too coarse? mix_resample: such a one as f->depth, m, edges
 * where the photo has them; 0 without memory. */
int mix_has_shape(const mix_frame *f, const image *in);
int mix_resample(mix_frame *f, const image *in, float scale);

/* mix_is_camera: are fx, fy, cx, cy of a camera, px? */
int mix_is_camera(const float v[4]);

/* mix_is_pose: a rotation and a place, all finite. */
int mix_is_pose(const double pose[16]);

#endif
