/* many_lights_cell.h: definitions shared by the stream of many lights, their tree and the cut. Layer 6. */
#ifndef LMB_TREE_MANY_LIGHTS_CELL_H
#define LMB_TREE_MANY_LIGHTS_CELL_H

#include <lambent/many_lights.h>

#define LMB_MANY_LIGHTS_ENDLESS2 0x1p+60f /* m2: squared range of lights that have none */
#define LMB_MANY_LIGHTS_SUNS (LMB_MANY_LIGHTS_KINDS - 1u) /* lmb_many_lights_cell.kind */

/* Quantization of a kind's positions; suns have directions, -1 .. 1. */
typedef struct lmb_many_lights_scale {
    float low[3], step;
} lmb_many_lights_scale;

static inline lmb_many_lights_scale lmb_many_lights_scale_of(const lmb_many_lights *m, uint32_t kind)
{
    const lmb_many_lights_scale world = {{m->low.x, m->low.y, m->low.z}, m->step},
                                sky = {{-1.0f, -1.0f, -1.0f}, 0x1p-23f};
    return kind == LMB_MANY_LIGHTS_SUNS ? sky : world;
}

/* Merges the lights of `from` into `into`; the key of `into` stays. Merging is exact, so order and grouping do not
 * matter. */
void lmb_many_lights_merge(lmb_many_lights_cell *into, const lmb_many_lights_cell *from);

#endif
