/* ear_clip.h: cuts one planar polygon into triangles. */
#ifndef EAR_CLIP_H
#define EAR_CLIP_H

#include <stddef.h>
#include <stdint.h>

#define POLYGON_MAX_CONCAVE 1000 /* corners; larger concave ones are cut as if convex, because time grows as n^2 */

/* polygon_cut: n >= 3 corners, x y z each. Writes 3 * (n - 2) corner numbers to `out`, the polygon's way round kept.
 * Convex (or degenerate, or not finite): a fan from corner 0. Concave: ears. `links` is scratch of 2 * n.
 * Returns 1, or 0 where it was too large and concave, and the fan may overlap itself. */
int polygon_cut(uint32_t *out, const double *points, uint32_t n, uint32_t *links);

#endif
