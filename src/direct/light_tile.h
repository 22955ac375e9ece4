/* light_tile.h: adds one of the scene's lights to a tile, with lobes. Layer 4. */
#ifndef LMB_DIRECT_LIGHT_TILE_H
#define LMB_DIRECT_LIGHT_TILE_H

#include <lambent/light.h>

#include "../base/exact.h"
#include "shadow.h"

typedef struct light_tile {
    const lmb_kernels *kernels;
    const lmb_scene *scene;
    const lmb_view *view;
    const lmb_tile *tile; /* resolved */
} light_tile;

/* Adds light i to `sum`, and the reflection by lobes to `glossy` (NULL: no lobes).
 *
 *   one  scratch: a lobe needs the irradiance of each light separately; the total is the same.
 *   map  of the light; NULL: no shadows. */
lmb_status lmb_light_tile_add(lmb_irradiance *sum, lmb_glossy *glossy, lmb_irradiance *one, const light_tile *to,
                              uint32_t i, const lmb_shadow_map *map);

#if LMB_FACETS

/* The two halves of lmb_direct_tile: the irradiance without shadows and the pixels that the map takes for lit, then the
 * sum over lit pixels. Between the two, a caller may trace the pixels that the first one returns: lit ones that the
 * texels around them do not decide. map: not NULL. is_brief: fewer, as for lmb_shadow_unsure. */
uint64_t lmb_direct_find(lmb_irradiance *one, uint64_t *lit, const light_tile *to, const lmb_light *light,
                         const lmb_shadow_map *map, int is_brief);
void lmb_direct_add(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_irradiance *one, uint64_t lit);

#endif

#endif
