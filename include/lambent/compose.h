/* compose.h: direct + indirect -> radiance -> a display's pixels. [V28 V29 V30]
 *
 * Stability: stable. Tags like [V28] are requirements in src/SOURCES.md. */
#ifndef LMB_COMPOSE_H
#define LMB_COMPOSE_H

#include "light.h"

/* Radiance towards the viewer of a tile's pixels, W/(m2 sr), planar. */
typedef struct lmb_radiance {
    float rgb[3][LMB_TILE_PIXELS];
} lmb_radiance;

/* The pixels of a frame at which LMB_GATHER_LIVE lights single points: first every 16th each way, then in cells of 8, 4
 * and 2 px if the light varies. Laid out by lmb_lattice_init. */
typedef struct lmb_lattice {
    void *tile;            /* the samples of the frame's tiles, by rows */
    int32_t width, height; /* of the frame, px */
    float mean;            /* light of the first samples, W/m2, R + G + B */
} lmb_lattice;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_lattice_bytes: memory for a lattice of a frame of width x height pixels; 0 if a side is under 1 or over
 * LMB_MAX_SIDE.
 * lmb_lattice_init: lay out a lattice in `memory`, which is aligned as for a uint64_t. Returns LMB_OK, LMB_ERR_ARG,
 * LMB_ERR_ALIGN or LMB_ERR_CAPACITY. Both are missing in builds without live.h. */
size_t lmb_lattice_bytes(int32_t width, int32_t height);
lmb_status lmb_lattice_init(lmb_lattice *out, int32_t width, int32_t height, void *memory, size_t bytes);

/* lmb_compose_tile: albedo / pi x (direct + indirect). Either irradiance may be NULL. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_compose_tile(lmb_radiance *out, const lmb_kernels *kernels, const lmb_tile *tile,
                            const lmb_irradiance *direct, const lmb_irradiance *indirect);

/* lmb_compose_emission: add the light that surfaces emit towards the viewer, by texel; the tile was resolved for
 * `view`. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_compose_emission(lmb_radiance *inout, const lmb_scene *scene, const lmb_view *view,
                                const lmb_tile *tile);

/* lmb_compose_glossy: at pixels with a lobe, scale the diffuse light by the share that the lobe leaves (lmb_glossy),
 * and add the lobe's radiance. Returns LMB_OK or LMB_ERR_ARG. Missing in builds without trees and probes. */
lmb_status lmb_compose_glossy(lmb_radiance *inout, const lmb_glossy *glossy);

/* lmb_store_tile: write a tile into a surface with pixel (0, 0) at frame pixel (x0, y0).
 *
 *   out       LMB_RGB32F: radiance without change. Others: x 2^exposure_ev, clipped to 0..1, sRGB-coded; 16-bit formats
 *             with an 8x8 ordered dither (Bayer 1973) fixed to the frame, so that bands meet without a seam.
 *   x, y      position of the tile's pixel 0 in the frame, px; pixels outside the surface are not written.
 * Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_FORMAT. */
lmb_status lmb_store_tile(const lmb_surface *out, const lmb_kernels *kernels, int32_t x0, int32_t y0,
                          const lmb_radiance *in, int32_t x, int32_t y, float exposure_ev);

#ifdef __cplusplus
}
#endif
#endif
