/* mix_frame.h: a photo with depth and camera, read from files. */
#ifndef MIX_FRAME_H
#define MIX_FRAME_H

#include "../picture/picture_read.h"
#include <lambent/mixed.h>

/* The files to read. NULL or 0: not given. `frame` supplies the parts that the other members leave open. */
typedef struct mix_source {
    const char *frame; /* PREFIX of .color.(png|jpg|pam|pfm), .depth.(png|pfm) and .json */
    const char *photo, *depth;
    const char *folder;  /* the list's folder, for file_is_below; NULL: names are from the command line */
    float depth_scale; /* metres per unit; 0: 0.001 for PNG, 1 for PFM, or the JSON's value */
    float intrinsics[4];
    int32_t has_intrinsics;
    int32_t may_lack_depth; /* no depth file: all of it is not measured */
} mix_source;

/* Release it with mix_frame_free. */
typedef struct mix_frame {
    stored_picture photo; /* as stored */
    image light;          /* the photo as linear light, 3 channels */
    float *depth;         /* m, same size */
    int lacks_depth;      /* there is no depth file */
    lmb_pinhole camera;
    int has_pose;
    double pose[16];      /* camera (x right, y down, z ahead) to world, row by row */
} mix_frame;

/* mix_frame_read: returns 1, or 0 with `r` set and nothing allocated. */
int mix_frame_read(mix_frame *out, const mix_source *from, report *r);
void mix_frame_free(mix_frame *f);

/* mix_has_shape: does a depth picture have the photo's aspect ratio and enough pixels? mix_resample: resamples it to
 * f->depth, m, with edges aligned to the photo's; returns 0 if memory is short. */
int mix_has_shape(const mix_frame *f, const image *in);
int mix_resample(mix_frame *f, const image *in, float scale);

/* mix_is_camera: are these fx, fy, cx, cy of a valid camera, px? */
int mix_is_camera(const float v[4]);

/* mix_is_pose: is it a rotation and a place, all finite? */
int mix_is_pose(const double pose[16]);

#endif
