/* halvings.h: a triangle halved again and again: from a place on it to the piece that holds the place. Layer 9. */
#ifndef LMB_TRANSFER_HALVINGS_H
#define LMB_TRANSFER_HALVINGS_H

#include <lambent/transfer.h>

#include "../base/vec.h"
#include "../raster/triangle.h"

/* 0 where the id names no triangle with an area. */
static inline int transfer_triangle_of(lmb_transfer_triangle *out, const lmb_scene *scene, uint32_t id)
{
    lmb_triangle t;
    float area;
    if (!lmb_triangle_fetch(&t, scene, id) || !lmb_triangle_shape(&out->normal, &area, &t)) {
        return 0;
    }
    const lmb_vec3 e1 = sub3(t.corner[1], t.corner[0]), e2 = sub3(t.corner[2], t.corner[0]);
    const float per = 0.5f / area;
    out->corner = t.corner[0];
    out->along[0] = mul3(cross3(e2, out->normal), per);
    out->along[1] = mul3(cross3(out->normal, e1), per);
    return 1;
}

/* The same, kept by the low bits of its id: walls and floors come back in every row. NULL where there is none. */
static inline const lmb_transfer_triangle *transfer_triangle_kept(lmb_transfer_kept *kept, const lmb_scene *scene,
                                                                  uint32_t id)
{
    const uint32_t at = id % LMB_TRANSFER_KEPT;
    if (kept->id[at] != id) {
        kept->id[at] = transfer_triangle_of(&kept->triangle[at], scene, id) ? id : 0;
    }
    return kept->id[at] == id ? &kept->triangle[at] : NULL;
}

/* One halving of edge `from`: from corner `from` to the next, `to`. Its middle becomes a corner of both halves: of the
 * first in place of the edge's end, of the second in place of its beginning. */
static inline int halving_from(uint32_t node) { return (int)(node >> LMB_TRANSFER_EDGE_BIT & 3u); }
static inline int halving_to(int from) { return from == 2 ? 0 : from + 1; }
static inline uint32_t halving_first(uint32_t node) { return node & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u); }

#endif
