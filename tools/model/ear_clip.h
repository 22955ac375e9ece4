/* ear_clip.h: cuts one planar polygon into triangles. */
#ifndef EAR_CLIP_H
#define EAR_CLIP_H

#include <stddef.h>
#include <stdint.h>

#define POLYGON_MAX_CONCAVE 1000 /* corners; larger concave ones are cut as if convex, because time grows as n^2 */

/* polygon_cut: n >= 3 corners, x y z each. Writes 3 * (n - 2) corner numbers to `out` with the winding of the
 * polygon. Convex (or degenerate, or not finite): a fan from corner 0. Concave: ears. `links` is scratch of 2 * n.
 * Returns 1, or 0 if a concave polygon was too large, or took more than 2 n^2 comparisons: triangles may overlap. */
int polygon_cut(uint32_t *out, const double *points, uint32_t n, uint32_t *links);

/* polygon_cut_within: the same for one of many polygons that share *steps comparisons; it subtracts the steps it
 * uses. Give a file polygon_steps: a polygon of 1000 corners takes 2 million at most, and thirty bytes a corner. */
int polygon_cut_within(uint32_t *out, const double *points, uint32_t n, uint32_t *links, uint64_t *steps);

static inline uint64_t polygon_steps(uint64_t file_size) { return (UINT64_C(1) << 25) + 64 * file_size; }

#endif
