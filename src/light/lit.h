/* lit.h: one of the scene's lights on a tile, lobes and all. Floor 5. */
#ifndef LMB_LIGHT_LIT_H
#define LMB_LIGHT_LIT_H

#include <lambent/light.h>

typedef struct lit_tile {
    const lmb_kernels *kernels;
    const lmb_scene *scene;
    const lmb_view *view;
    const lmb_tile *tile; /* resolved */
} lit_tile;

/* Add light i to `sum`, and what lobes make of it to `gloss` (NULL: there are none).
 *
 *   one  scratch: a lobe wants each light's irradiance by itself; added to the others' it is the same sum.
 *   map  the light's; NULL: no shadows. */
lmb_status lmb_lit_add(lmb_irradiance *sum, lmb_gloss *gloss, lmb_irradiance *one, const lit_tile *to, uint32_t i,
                       const lmb_light_map *map);

#endif
