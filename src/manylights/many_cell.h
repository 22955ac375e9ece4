/* many_cell.h: what the stream of lights, the tree and the cut share. Floor 6. */
#ifndef LMB_MANYLIGHTS_MANY_CELL_H
#define LMB_MANYLIGHTS_MANY_CELL_H

#include <lambent/many.h>

#define LMB_MANY_SUNS (LMB_MANY_KINDS - 1u) /* lmb_many_cell.kind */

/* What positions of a kind are counted in: suns' are directions, -1 .. 1. */
typedef struct lmb_many_scale {
    float low[3], step;
} lmb_many_scale;

static inline lmb_many_scale lmb_many_scale_of(const lmb_many *m, uint32_t kind)
{
    const lmb_many_scale world = {{m->low.x, m->low.y, m->low.z}, m->step}, sky = {{-1.0f, -1.0f, -1.0f}, 0x1p-23f};
    return kind == LMB_MANY_SUNS ? sky : world;
}

/* Put the lights of `from` to those of `into`; its key stays. Merging is exact, so order and grouping do not matter. */
void lmb_many_merge(lmb_many_cell *into, const lmb_many_cell *from);

#endif
