/* relief_bounce.h: light that bounces between ordinary geometry and a relief, whose simple model stands for it. */
#ifndef RELIEF_BOUNCE_H
#define RELIEF_BOUNCE_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* What both together send on. Zeroed it is empty; relief_bounce_free releases it. Must not move. */
typedef struct relief_bounce {
    lmb_scene scene; /* both */
    lmb_mesh *meshes;
    lmb_material *materials;
    lmb_instance *instances;
    lmb_tree tree;
    lmb_bvh plain; /* what hides light from a relief's pixels, which lie inside its simple model ... */
    lmb_bvh both;  /* ... and from others */
    lmb_cut *cut;
    lmb_tile tile;
    void *memory[4];
} relief_bounce;

/* relief_bounce_make: the first points of one light.
 *
 *   plain, simple  ordinary geometry, and a relief's simple model; either may be NULL. They stay.
 *   size           texels a side of the shadow map: a power of two
 * 1, or 0 with `r` set and nothing allocated. */
int relief_bounce_make(relief_bounce *out, const lmb_kernels *kernels, const lmb_scene *plain, const lmb_scene *simple,
                       const lmb_light *light, int32_t size, report *r);

/* relief_bounce_tile: add what they light of a tile's pixels. `of_relief`: those that show the relief, a bit each. */
lmb_status relief_bounce_tile(lmb_irradiance *inout, relief_bounce *b, const lmb_kernels *kernels, const lmb_tile *tile,
                              uint64_t of_relief);

void relief_bounce_free(relief_bounce *b);

#endif
