/* smooth_normals.h: normals of surfaces that are smooth by group: one for all corners of a group at one place. */
#ifndef SMOOTH_NORMALS_H
#define SMOOTH_NORMALS_H

#include "model_build.h"

/* A group at a place: the sum of its triangles' normals, each by its angle there. */
typedef struct smooth_place {
    float place[3];
    uint32_t group;
    double sum[3];
    float first[3]; /* a triangle's normal, for where the sum is nothing; zeros: none has an area */
} smooth_place;

typedef struct smooth_normals {
    smooth_place *places;
    uint32_t *slots; /* open addressing over places: number + 1 */
    uint32_t count, mask;
    uint64_t key; /* of the hash: so that no file can choose places that all go to one slot */
} smooth_normals;

/* corner_weights: a triangle's normal, of unit length, and how much it counts at its corners: by its angle there, and
 * next to nothing where it is so low that its normal is mostly rounding. 0: it has no area. */
int corner_weights(double normal[3], double weight[3], const float *const corner[3]);

/* smooth_open: room for so many places. 1, or 0 with b->r set. */
int smooth_open(smooth_normals *out, model_build *b, uint64_t room, uint64_t key);

/* smooth_add: a triangle, at its corner k, of group group[k]; 0: not there. */
void smooth_add(smooth_normals *s, const float *const corner[3], const uint32_t group[3]);

/* smooth_at: unit length; +Y where no triangle of the group with an area has a corner. */
lmb_vec3 smooth_at(const smooth_normals *s, const float place[3], uint32_t group);

#endif
