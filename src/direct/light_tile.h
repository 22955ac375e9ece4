/* light_tile.h: adds one of the scene's lights to a tile, with lobes. Layer 4. */
#ifndef LMB_DIRECT_LIGHT_TILE_H
#define LMB_DIRECT_LIGHT_TILE_H

#include <lambent/light.h>

#include "../base/exact.h"

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

/* lmb_direct_tile that also sets `doubtful`: lit pixels around which the map shows only other triangles, as in a corner
 * smaller than a texel. */
lmb_status lmb_direct_doubtful(lmb_irradiance *inout, uint64_t *doubtful, const light_tile *to, const lmb_light *light,
                               const lmb_shadow_map *map);

#endif

#endif
