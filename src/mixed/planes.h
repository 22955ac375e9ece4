/* planes.h: what finding planes and finding their outlines have in common. Layer 6. */
#ifndef LMB_MIXED_PLANES_H
#define LMB_MIXED_PLANES_H

#include "plane_fit.h"

/* Labels beside 0 and the planes' numbers: of a region that became no plane, and of a hole's pixels once visited. */
enum { LABEL_TRIED = 254, LABEL_HOLE = 255 };

/* Is there a picture's worth of labels, and of what was measured? */
static inline int are_labels(const lmb_planes *planes, const lmb_cloud *cloud)
{
    return planes != NULL && planes->label != NULL && cloud != NULL && cloud->inverse != NULL && cloud->normal != NULL;
}

/* How far off a plane an inverse distance is, in standard deviations. */
static inline float plane_off(const lmb_cloud *cloud, const float slope[3], float inverse, lmb_vec3 ray)
{
    return absf(inverse - plane_inverse(slope, ray.x, ray.y)) / lmb_cloud_sigma(cloud, inverse);
}

/* lmb_planes_fit: a plane's pixels, those within `off` deviations; 0 where there is no plane in them. */
int lmb_planes_fit(float slope[3], const lmb_planes *planes, const lmb_cloud *cloud, int32_t label, float off);

/* lmb_planes_outline: give each pixel to the plane it lies on, and holes to the plane around them.             [M4] */
void lmb_planes_outline(lmb_planes *planes, const lmb_cloud *cloud);

/* Of its inverse distance that a point moves at most when it moves onto its plane. */
#define PLANE_MOVES 0.15f

/* lmb_planes_farthest: by plane, the smallest inverse distance that was measured on it. */
void lmb_planes_farthest(float min[LMB_MAX_PLANES], const lmb_planes *planes, const lmb_cloud *cloud);

/* lmb_planes_boxes: from the labels, of each plane its pixels and their box. lmb_planes_centres: from those and its slope
 * its centre; min: by plane, the least inverse distance that holes in it count as. */
void lmb_planes_boxes(lmb_planes *planes, const lmb_pinhole *camera);
void lmb_planes_centres(float min[LMB_MAX_PLANES], lmb_planes *planes, const lmb_cloud *cloud);

/* lmb_planes_measure: everything of lmb_flat beside `slope`, from the labels.                                  [M5] */
void lmb_planes_measure(lmb_planes *planes, const lmb_cloud *cloud);

#endif
