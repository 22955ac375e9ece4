/* points.h: a face's first points collected in parts, each on a thread. Layer 5. */
#ifndef LMB_BOUNCE_POINTS_H
#define LMB_BOUNCE_POINTS_H

#include <lambent/bounce.h>

/* 1 if there is room for the parts of one more face, each with the maximum number of points. */
int lmb_points_have_room(const lmb_points *points, const lmb_shadow_map *map, const lmb_grouping *grouping);

/* lmb_points_part: runs lmb_points_collect for part `part` of `parts` of a face's rows, into the place of that part
 * behind the points so far. points->count does not change. Parts may run at once. Same returns. */
lmb_status lmb_points_part(const lmb_points *points, const lmb_kernels *kernels, lmb_tile *scratch,
                           const lmb_scene *scene, const lmb_light *light, const lmb_shadow_map *map, int32_t face,
                           int32_t part, int32_t parts, const lmb_grouping *grouping);

/* lmb_points_put_together: closes the gaps between parts. The points and cells are then those of lmb_points_collect. */
void lmb_points_put_together(lmb_points *points, const lmb_shadow_map *map, int32_t parts,
                             const lmb_grouping *grouping);

/* Share `part` of `parts` <= 65,535 of n items: *first .. *past - 1, from n part / parts on. In 32 bits, because small
 * targets divide 64 bits with a routine of 700 bytes. */
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
