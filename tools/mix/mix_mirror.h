/* mix_mirror.h: what an object's metal mirrors: the photo's surfaces as they are with the object, and beyond the photo its
 * planes. [M20] */
#ifndef MIX_MIRROR_H
#define MIX_MIRROR_H

#include "mix_job.h"

/* What one tile's rays are made in. */
typedef struct mix_mirror {
    lmb_tile hit;            /* where one ray of each pixel meets what the photo shows */
    float photo[3][LMB_TILE_PIXELS], albedo[3][LMB_TILE_PIXELS]; /* there; of its plane */
    lmb_irradiance light[2]; /* there, without and with the object */
    float weight[3][LMB_TILE_PIXELS]; /* of that ray, by channel */
} mix_mirror;

/* mix_mirror_planes: set j->plane_albedo, the mean colour of each plane, and the ball that stands for the object. The real
 * mesh has its colours. */
void mix_mirror_planes(mix_job *j);

/* mix_mirror_tile: set the radiance that each pixel's lobe reflects, by rays about the mirror direction. The object's own
 * parts are in no ray's way. */
void mix_mirror_tile(float out[3][LMB_TILE_PIXELS], mix_mirror *s, const mix_job *j, const lmb_view *view,
                     const lmb_tile *object, const lmb_glossy *lobes);

#endif
