/* relief_photos.h: photos with depth and poses as a relief's views, and blocks around what they show as its simple
 * model. [P11] */
#ifndef RELIEF_PHOTOS_H
#define RELIEF_PHOTOS_H

#include "../mix/mix_frame.h"
#include "relief_bake.h"

/* What a posed photo shows. relief_photo_free releases it. */
typedef struct relief_photo {
    lmb_view view;
    float *depth, *normal, *colour; /* m along the axis, 0: nothing; towards the camera, unit; linear */
} relief_photo;

/* relief_photo_of: the photo as a camera of ours saw it: of the pose's world x stays, and y and z are turned round, so
 * that a world whose y points down like its cameras' has its y up. Without a pose the camera stands at 0 and looks down
 * -z. Normals are the depth's. Refuses a camera whose axis misses the picture's middle by over half a pixel. 1, or 0
 * with `r` set. */
int relief_photo_of(relief_photo *out, const mix_frame *frame, report *r);

/* relief_photo_read: that of PREFIX.color.png, PREFIX.depth.png and PREFIX.json (mix_frame.h). */
int relief_photo_read(relief_photo *out, const char *prefix, report *r);
void relief_photo_free(relief_photo *p);

/* relief_photo_size: of the box around all points of the photos, its longest side, m. */
float relief_photo_size(const relief_photo *photo, int32_t count);

/* relief_blocks: cubes of a lattice, `side` m wide, that hold a point of a photo: their faces towards cubes that hold
 * none, in the photos' colours. What photos show lies inside. triangle_mesh_free releases it. */
int relief_blocks(triangle_mesh *out, const relief_photo *photo, int32_t count, float side, report *r);

#endif
