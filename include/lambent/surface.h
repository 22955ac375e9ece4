/* surface.h: your pixels: sizes, clearing, linearising, hashing, and comparing two pictures.
 *
 * Stability: stable. */
#ifndef LMB_SURFACE_H
#define LMB_SURFACE_H

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_pixel_bytes: bytes of one pixel of a format; 0 for an unknown one. */
int32_t lmb_pixel_bytes(int32_t format);

/* lmb_surface_bytes: memory of a surface, whole tiles for depth and id formats; 0 for a bad size or format. */
size_t lmb_surface_bytes(int32_t format, int32_t width, int32_t height);

/* lmb_depth_bytes: short for lmb_surface_bytes(LMB_DEPTH32F, width, height). */
size_t lmb_depth_bytes(int32_t width, int32_t height);

/* lmb_surface_init: describe `bytes` of your memory as a surface: tiled for depth and id, linear for colour.
 *
 * Returns LMB_OK; LMB_ERR_ARG (null, size outside 1 .. LMB_MAX_SIDE), LMB_ERR_FORMAT, LMB_ERR_ALIGN (data not aligned
 * to 4 bytes), LMB_ERR_CAPACITY (bytes too few): then `out` is unchanged. */
lmb_status lmb_surface_init(lmb_surface *out, int32_t format, int32_t width, int32_t height, void *data,
                            size_t bytes);

/* lmb_surface_clear: set all pixels to 0 bytes (depth: nothing; id: none). Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_surface_clear(const lmb_surface *surface);

/* lmb_depth_linearize: copy a tiled depth or id surface into rows of width pixels, tightly packed, same format. Returns
 * LMB_OK, LMB_ERR_ARG, LMB_ERR_FORMAT, or LMB_ERR_CAPACITY if `bytes` of `out` < width * height * pixel bytes. */
lmb_status lmb_depth_linearize(void *out, size_t bytes, const lmb_surface *surface);

/* lmb_depth_view_z: distance along the view's axis, metres, of a float depth d > 0; the only way back from d. */
float lmb_depth_view_z(const lmb_view *view, float d);

/* lmb_surface_hash: 64-bit FNV-1a over the pixels in row order, each value in little-endian byte order on every target
 * and for every layout, so that equal pictures have equal hashes everywhere. 0 for a null surface. */
uint64_t lmb_surface_hash(const lmb_surface *surface);

/* lmb_surface_diff: find the first pixel, in row order, with different bytes.
 *
 * Returns 1 and writes the position to x, y; 0 if all are equal; LMB_ERR_ARG / LMB_ERR_FORMAT if the two cannot be
 * compared (null, sizes or formats differ; layouts may). */
int32_t lmb_surface_diff(int32_t *x, int32_t *y, const lmb_surface *a, const lmb_surface *b);

#ifdef __cplusplus
}
#endif
#endif
