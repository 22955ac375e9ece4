/* relief_photos.h: photos with depth and poses as a relief's views, and blocks around their surfaces as the simple
 * model. [P11] */
#ifndef RELIEF_PHOTOS_H
#define RELIEF_PHOTOS_H

#include "../mix/mix_frame.h"
#include "relief_bake.h"

/* A posed photo. Release it with relief_photo_free. */
typedef struct relief_photo {
    lmb_view view;
    float *depth, *normal, *colour; /* m along the axis, 0: nothing; towards the camera, unit; linear */
    int has_pose;                   /* 0: the camera is at 0 */
} relief_photo;

/* relief_photo_of: converts a photo to the library's camera. x of the pose's world stays, and y and z are negated: a
 * world with y down, like the cameras, becomes one with y up. Without a pose the camera is at 0 and looks along -z.
 * Normals come from the depth. Refuses a camera with an axis over half a pixel off the picture's middle. Returns 1, or
 * 0 with `r` set. */
int relief_photo_of(relief_photo *out, const mix_frame *frame, report *r);

/* relief_photo_read: reads PREFIX.color.png, PREFIX.depth.png and PREFIX.json (mix_frame.h). */
int relief_photo_read(relief_photo *out, const char *prefix, report *r);
void relief_photo_free(relief_photo *p);

/* relief_photo_size: the longest side of the box around all points of the photos, m. */
float relief_photo_size(const relief_photo *photo, int32_t count);

/* relief_blocks: cubes of a lattice, `side` m wide, around all points of the photos: the faces towards empty cubes, in
 * the photos' colours. All photographed points lie inside. Release it with triangle_mesh_free. Returns 1, or 0 with `r`
 * set. */
int relief_blocks(triangle_mesh *out, const relief_photo *photo, int32_t count, float side, report *r);

#endif
