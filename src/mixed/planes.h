/* planes.h: shared by the search for planes and for their outlines. Layer 6. */
#ifndef LMB_MIXED_PLANES_H
#define LMB_MIXED_PLANES_H

#include "plane_fit.h"

/* Labels other than 0 and planes: a region that became no plane, and a visited pixel of a hole. */
enum { LABEL_TRIED = 254, LABEL_HOLE = 255 };

/* Are the arrays of labels and measurements present? */
static inline int are_labels(const lmb_planes *planes, const lmb_cloud *cloud)
{
    return planes != NULL && planes->label != NULL && cloud != NULL && cloud->inverse != NULL && cloud->normal != NULL;
}

/* Distance of an inverse from a plane, in standard deviations. */
static inline float plane_off(const lmb_cloud *cloud, const float slope[3], float inverse, lmb_vec3 ray)
{
    return absf(inverse - plane_inverse(slope, ray.x, ray.y)) / lmb_cloud_sigma(cloud, inverse);
}

/* lmb_planes_outline: assigns each pixel to the best plane, and holes to the plane around them.                 [M4] */
void lmb_planes_outline(lmb_planes *planes, const lmb_cloud *cloud);

/* Max move of a point onto a plane, as a share of the inverse distance. */
#define PLANE_MOVES 0.15f

/* lmb_planes_farthest: for each plane, the smallest measured inverse distance. */
void lmb_planes_farthest(float min[LMB_MAX_PLANES], const lmb_planes *planes, const lmb_cloud *cloud);

/* lmb_planes_boxes: sets each plane's pixel count and bounding box from the labels. Call it before lmb_planes_centres,
 * which sets the centres from these and the slopes; min: for each plane, a lower limit of the inverse distance in
 * holes. */
void lmb_planes_boxes(lmb_planes *planes, const lmb_pinhole *camera);
void lmb_planes_centres(float min[LMB_MAX_PLANES], lmb_planes *planes, const lmb_cloud *cloud);

/* lmb_planes_measure: sets all of lmb_flat except `slope`, from the labels.                                     [M5] */
void lmb_planes_measure(lmb_planes *planes, const lmb_cloud *cloud);

#endif
