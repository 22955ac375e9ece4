/* mix_mirror.h: reflections in the object's metal: the photo's surfaces with the object, and planes beyond it. [M20] */
#ifndef MIX_MIRROR_H
#define MIX_MIRROR_H

#include "mix_job.h"

/* The memory that one tile's rays are traced in. */
typedef struct mix_mirror {
    lmb_tile hit;            /* hit points of one ray per pixel on surfaces in the photo */
    float photo[3][LMB_TILE_PIXELS], albedo[3][LMB_TILE_PIXELS]; /* at the hit points; albedo of their planes */
    lmb_irradiance light[2]; /* there, without and with the object */
    float weight[3][LMB_TILE_PIXELS]; /* of that ray, by channel */
} mix_mirror;

/* mix_mirror_planes: sets j->plane_albedo, the mean colour of each plane, and the ball that approximates the object.
 * Colour the real mesh before you call it. */
void mix_mirror_planes(mix_job *j);

/* mix_mirror_tile: computes the radiance that each pixel's lobe reflects, by rays about the mirror direction. The
 * object does not block them. */
void mix_mirror_tile(float out[3][LMB_TILE_PIXELS], mix_mirror *s, const mix_job *j, const lmb_view *view,
                     const lmb_tile *object, const lmb_glossy *lobes);

#endif
