/* light.h: direct light with its shadow test, Lambertian. [V7 V29] */
#ifndef LMB_LIGHT_H
#define LMB_LIGHT_H

#include "map.h"

/* Irradiance of a tile's pixels, W/m2 per channel, planar like lmb_tile. */
typedef struct lmb_irradiance {
    float rgb[3][LMB_TILE_PIXELS];
} lmb_irradiance;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_direct_tile: add one light's direct irradiance to a tile's pixels.                              [V7 V29]
 *
 *   inout   added to, so that several lights sum up in their order.
 *   tile    resolved for `view`; its face normal guards the shading normal against light from behind.
 *   map     the light's map, drawn; NULL: the light casts no shadow.
 *
 * The shadow test asks the map's own triangles at the pixel's exact place in the map: the four texels around it name
 * them, and each is tested as a plane with its edges. A plane that passes nearer to the pixel than rounding can tell
 * (2^-15 of the distances involved) does not shadow it. Nothing to tune.
 * What is missed: an occluder that slips between texel centres. Where no named triangle lies over the pixel, the
 * texel's depth is held against the pixel's own plane instead (error: about one texel at shadow edges).
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                           const lmb_view *view, const lmb_scene *scene, const lmb_light *light,
                           const lmb_light_map *map);

#ifdef __cplusplus
}
#endif
#endif
