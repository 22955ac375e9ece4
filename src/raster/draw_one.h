/* draw_one.h: one triangle, without a batch. Layer 3. */
#ifndef LMB_RASTER_DRAW_ONE_H
#define LMB_RASTER_DRAW_ONE_H

#include "clip.h"
#include "fill.h"

/* One instance in one view. */
typedef struct lmb_draw_instance {
    lmb_setup_job job;
    lmb_clip_guard guard;
    int8_t mirrored, cull, masked, blends; /* 0 or 1 */
    const lmb_mesh *mesh;
    uint32_t first_id;
} lmb_draw_instance;

/* The triangle `id` on the screen, clipped to a polygon. Returns the number of corners, 0 or 3 .. LMB_CLIP_MAX. The
 * triangle's indices must be inside the mesh. */
int lmb_one_corners(lmb_screen_vertex corner[LMB_CLIP_MAX], const lmb_draw_instance *d, uint32_t id);

/* Sets all of an instance except the context. flags: as in lmb_draw. */
void lmb_draw_instance_set(lmb_draw_instance *out, const lmb_fill_context *context, const lmb_instance *instance,
                           uint32_t flags);

/* Draws the triangle `id`, of any size and position, with indices inside the mesh. Returns 1 if any of it is drawn. */
int lmb_draw_one(const lmb_fill_context *context, const lmb_draw_instance *d, uint32_t id);

#endif
