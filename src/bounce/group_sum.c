/* group_sum.c: discs added up into a group. Layer 5.                                                       [V18 V19] */
#include "group.h"

#include <string.h>

#if LMB_BOUNCE

float lmb_disc_power(const lmb_point *d) { return d->flux[0] + d->flux[1] + d->flux[2]; }
float lmb_disc_area(const lmb_point *d) { return 4.0f * length3(cross3(d->axis_u, d->axis_v)); }

void lmb_group_open(lmb_group_sum *g) { memset(g, 0, sizeof *g); }

void lmb_group_add(lmb_group_sum *g, const lmb_point *d)
{
    const float weight = lmb_disc_power(d);
    g->position = add3(g->position, mul3(d->position, weight));
    g->normal = add3(g->normal, mul3(d->normal, weight));
    g->weight += weight;
    if (g->count++ == 0) {
        g->centre = d->position;
        g->axis = d->normal;
    }
    /* Discs without flux do not move the centre, so dimming the light does not either. A group without flux keeps the
     * position of its first disc. */
    if (g->weight > 0.0f) {
        g->centre = mul3(g->position, 1.0f / g->weight);
        g->axis = normalize3(mul3(g->normal, 1.0f / g->weight));
    }
}

#endif
