/* points.h: a face's first points collected in parts, each on a thread of its own. Layer 6. */
#ifndef LMB_BOUNCE_POINTS_H
#define LMB_BOUNCE_POINTS_H

#include <lambent/bounce.h>

/* Is there room for the parts of one more face, each with all the points its blocks can have? */
int lmb_points_have_room(const lmb_points *points, const lmb_shadow_map *map, const lmb_grouping *grouping);

/* lmb_points_part: lmb_points_collect of part `part` of `parts` of a face's rows, into that part's own place behind
 * the points so far, whose count stands. Parts may be collected at once. The same returns. */
lmb_status lmb_points_part(const lmb_points *points, const lmb_kernels *kernels, lmb_tile *scratch,
                           const lmb_scene *scene, const lmb_light *light, const lmb_shadow_map *map, int32_t face,
                           int32_t part, int32_t parts, const lmb_grouping *grouping);

/* lmb_points_put_together: close the gaps between the parts: the points and cells that lmb_points_collect leaves. */
void lmb_points_put_together(lmb_points *points, const lmb_shadow_map *map, int32_t parts,
                             const lmb_grouping *grouping);

/* Share `part` of `parts` <= 65,535 of n things: *first .. *past - 1, from n part / parts on; in 32 bits, because small
 * targets divide 64 bits by a routine of 700 bytes. */
static inline int64_t share_edge(uint32_t n, uint32_t part, uint32_t parts)
{
    return (int64_t)(n / parts) * part + n % parts * part / parts;
}

static inline void share_out(int64_t *first, int64_t *past, int64_t n, int32_t part, int32_t parts)
{
    *first = share_edge((uint32_t)n, (uint32_t)part, (uint32_t)parts);
    *past = share_edge((uint32_t)n, (uint32_t)part + 1, (uint32_t)parts);
}

#endif
