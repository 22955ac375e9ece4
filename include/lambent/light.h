/* light.h: direct light on Lambertian surfaces, with a shadow test; and the lobe of glossy surfaces. [V7 V29]
 *
 * Stability: stable. Tags like [V7] are requirements in src/SOURCES.md. */
#ifndef LMB_LIGHT_H
#define LMB_LIGHT_H

#include "map.h"

/* Irradiance of a tile's pixels, W/m2 per channel, planar like lmb_tile. */
typedef struct lmb_irradiance {
    float rgb[3][LMB_TILE_PIXELS];
} lmb_irradiance;

/* The glossy lobe of a tile's pixels and its light towards the viewer; planar like lmb_tile. 2.8 KiB.
 *
 * f = D V F: GGX (Walter et al. 2007), height-correlated Smith shadowing (Heitz 2014), Schlick's Fresnel. A light
 * without area gives f E, where E is the irradiance that it adds. A disc gives f E with D replaced by the mean of D
 * over the half vectors to the disc: whatever the size, at most the disc's own radiance times F. src/direct/lobe.inl
 * has the derivation.
 * With a lobe, diffuse light is scaled by 1 - (F0 + (1 - F0) (1 - alpha)^3 (1 - n.v)^5): a white dielectric (F0 0.04)
 * reflects 0.84 to 1.02 of white light from all sides. A metal (F0 1) reflects all of it if smooth, and 0.3 to 0.6 at
 * roughness 1, because light that the roughness reflects twice is missing.
 * In a lobe, other surfaces show only their diffuse light, as far as bounces are solved: surfaces without light from
 * lights or elements are black, and glossy ones lack highlights and reflections. */
typedef struct lmb_glossy {
    uint64_t pixels;                    /* pixels with a lobe, a bit each; of other pixels only `rgb` is defined */
    float specular[3][LMB_TILE_PIXELS]; /* F0 */
    float alpha2[LMB_TILE_PIXELS];
    float towards[3][LMB_TILE_PIXELS];  /* direction to the viewer, unit */
    float facing[LMB_TILE_PIXELS];      /* cosine between normal and `towards`, at least 0.001 */
    float rgb[3][LMB_TILE_PIXELS];      /* radiance, W/(m2 sr); 0 without a lobe */
} lmb_glossy;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_direct_tile: add one light's direct irradiance to a tile's pixels.                                       [V7 V29]
 *
 *   inout   added to, so that several lights sum up in order.
 *   tile    resolved for `view`; the face normal guards the shading normal against light from behind.
 *   map     the shadow map, drawn; NULL: the light casts no shadow.
 *
 * The shadow test does not compare depths. The four texels around the pixel's exact position in the map name triangles
 * by ids, and each triangle is tested as a plane with edges. A plane nearer to the pixel than rounding can resolve
 * (2^-15 of the distances involved) does not shadow it. There is no bias to tune.
 * An occluder that slips between texel centres is missed. If no named triangle lies over the pixel, the texel's depth
 * is compared with the pixel's own plane instead (error: about one texel at shadow edges).
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                           const lmb_view *view, const lmb_scene *scene, const lmb_light *light,
                           const lmb_shadow_map *map);

/* The rest is missing in builds without trees and probes: they ignore materials' lobes. */

/* lmb_glossy_tile: set up the lobes of a tile that was resolved for `view`, with no light yet. Sets all of `out` and
 * returns 1; if no pixel has a lobe (and for null), sets only out->pixels to 0 and returns 0. */
int lmb_glossy_tile(lmb_glossy *out, const lmb_tile *tile, const lmb_view *view, const lmb_scene *scene);

/* lmb_glossy_direct: add the lobes' reflection of one light.
 *
 *   lit  the irradiance of only this light, with its shadow: lmb_direct_tile added it to zeros.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_glossy_direct(lmb_glossy *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                             const lmb_irradiance *lit, const lmb_light *light);

#ifdef __cplusplus
}
#endif
#endif
