/* relief_bounce.h: bounced light between ordinary geometry and a relief, approximated by the relief's simple model. */
#ifndef RELIEF_BOUNCE_H
#define RELIEF_BOUNCE_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* The light that both reflect. Zeroed: empty. Release it with relief_bounce_free. Do not move it. */
typedef struct relief_bounce {
    lmb_scene scene; /* both */
    lmb_mesh *meshes;
    lmb_material *materials;
    lmb_instance *instances;
    lmb_tree tree;
    lmb_bvh plain; /* occluders for pixels of the relief, which lie inside the simple model ... */
    lmb_bvh both;  /* ... and for others */
    lmb_cut *cut;
    lmb_tile tile;
    void *memory[4];
} relief_bounce;

/* relief_bounce_make: computes the first points of one light, and the occluders.
 *
 *   plain, simple  ordinary geometry, and a relief's simple model; either may be NULL. Keep both while you use `out`.
 *   size           texels per side of the shadow map: a power of two; 0: only the occluders, without `light`
 * Returns 1, or 0 with `r` set and nothing allocated. */
int relief_bounce_make(relief_bounce *out, const lmb_kernels *kernels, const lmb_scene *plain, const lmb_scene *simple,
                       const lmb_light *light, int32_t size, report *r);

/* relief_bounce_tile: adds the bounced light to a tile's pixels. `of_relief`: a mask of the pixels that show the
 * relief. */
lmb_status relief_bounce_tile(lmb_irradiance *inout, relief_bounce *b, const lmb_kernels *kernels, const lmb_tile *tile,
                              uint64_t of_relief);

void relief_bounce_free(relief_bounce *b);

#endif
