/* smooth_normals.h: normals of smoothing groups: one normal for all corners of a group at one position. */
#ifndef SMOOTH_NORMALS_H
#define SMOOTH_NORMALS_H

#include "model_build.h"

/* A group at a position: the sum of the triangle normals, weighted by angle. */
typedef struct smooth_place {
    float place[3];
    uint32_t group;
    double sum[3];
    float first[3]; /* normal of a triangle, used if the sum is 0; zeros: no triangle has an area */
} smooth_place;

typedef struct smooth_normals {
    smooth_place *places;
    uint32_t *slots; /* open addressing: index into places + 1 */
    uint32_t count, mask;
    uint64_t key; /* hash key, so that no file can make all positions collide */
} smooth_normals;

/* corner_weights: computes the unit normal of a triangle, and the weight of each corner from the angle there. The
 * weight is almost 0 if the triangle is so thin that the normal is mostly rounding error. Returns 0 if it has no
 * area. */
int corner_weights(double normal[3], double weight[3], const float *const corner[3]);

/* smooth_open: makes room for `room` positions. Returns 1, or 0 with b->r set. */
int smooth_open(smooth_normals *out, model_build *b, uint64_t room, uint64_t key);

/* smooth_add: adds a triangle to the group group[k] at corner k; group 0: that corner is skipped. */
void smooth_add(smooth_normals *s, const float *const corner[3], const uint32_t group[3]);

/* smooth_at: returns a unit normal, or +Y if no triangle of the group with an area has a corner there. */
lmb_vec3 smooth_at(const smooth_normals *s, const float place[3], uint32_t group);

#endif
