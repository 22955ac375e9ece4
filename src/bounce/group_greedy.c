/* group_greedy.c: discs -> groups around a chosen disc, until none fits. Layer 5.                        [V17 V18]
 *
 * A disc joins if its centre is within reach x the first disc's radius of the group's barycentre and the normals agree.
 * Each round of joining moves the barycentre, so rounds continue until one adds nothing. */
#include "group.h"

#if LMB_BOUNCE

#define MAX_REACH_RADII  1e4f   /* a reach this wide takes all remaining discs, regardless of direction */
#define MAX_REACH_M      1e18f  /* m */
#define MAX_GROUP_ROUNDS 64     /* a group that still changes after this many is accepted */

static int fits(const lmb_group_sum *g, const lmb_point *d, float reach_m, float cosine)
{
    lmb_vec3 away = sub3(d->position, g->centre);
    if (reach_m >= MAX_REACH_M) {
        return 1;
    }
    return dot3(away, away) <= reach_m * reach_m && lmb_group_agrees(g, d, cosine);
}

/* One pass over the free discs. Returns how many joined. */
static uint32_t join_round(lmb_group_sum *g, lmb_points *points, uint32_t from, uint32_t group, float reach_m,
                           float cosine)
{
    uint32_t joined = 0;
    const lmb_group_sum before = *g;
    for (uint32_t i = from; i < points->count; ++i) {
        lmb_point *d = &points->data[i];
        if (d->link == LMB_UNGROUPED && fits(&before, d, reach_m, cosine)) {
            d->link = group;
            lmb_group_add(g, d);
            ++joined;
        }
    }
    return joined;
}

uint32_t lmb_group_greedy(lmb_points *points, const lmb_grouping *grouping, float reach, uint32_t max)
{
    uint32_t groups = 0;
    for (uint32_t i = 0; i < points->count; ++i) {
        lmb_point *first = &points->data[i];
        if (first->link == LMB_UNGROUPED) {
            lmb_group_sum g;
            float radius = maxf(sqrtf(lmb_disc_area(first) * 0.31830989f), 0.5f * first->distance);
            float reach_m = reach < MAX_REACH_RADII ? reach * radius : MAX_REACH_M;
            if (groups == max) {
                return max + 1;
            }
            lmb_group_open(&g);
            first->link = groups;
            lmb_group_add(&g, first);
            for (int round = 0;
                 round < MAX_GROUP_ROUNDS && join_round(&g, points, i + 1, groups, reach_m, grouping->cosine);
                 ++round) {
            }
            ++groups;
        }
    }
    return groups;
}

#endif
