/* group.h: shared by the grouping methods: sums of discs, and one function per method. Layer 5. */
#ifndef LMB_BOUNCE_GROUP_H
#define LMB_BOUNCE_GROUP_H

#include <lambent/bounce.h>

#include "../base/vec.h"

#define LMB_UNGROUPED 0xffffffffu /* link of a disc in no group */

/* A group while it grows. */
typedef struct lmb_group_sum {
    lmb_vec3 position, normal; /* weighted by power */
    float weight;
    uint32_t count;
    lmb_vec3 centre, axis; /* barycentre and unit normal so far [V18 V19] */
} lmb_group_sum;

float lmb_disc_power(const lmb_point *disc);
float lmb_disc_area(const lmb_point *disc);

/* 1 if the normals agree. A cosine of -1 accepts any normal, because rounding may put opposed ones below -1. */
static inline int lmb_group_agrees(const lmb_group_sum *sum, const lmb_point *disc, float cosine)
{
    return cosine <= -1.0f || dot3(disc->normal, sum->axis) >= cosine;
}

void lmb_group_open(lmb_group_sum *sum);
void lmb_group_add(lmb_group_sum *sum, const lmb_point *disc);

/* Group the discs. The link of each disc changes from LMB_UNGROUPED to its group; strict zones may leave it. Returns
 * the number of groups. If that exceeds `max`, the links are undefined. */
uint32_t lmb_group_greedy(lmb_points *points, const lmb_grouping *grouping, float reach, uint32_t max);
uint32_t lmb_group_zones(lmb_points *points, const lmb_grouping *grouping, int32_t zone, uint32_t max);

#endif
