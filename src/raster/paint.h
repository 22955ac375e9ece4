/* paint.h: the images on a triangle. Floor 3. */
#ifndef LMB_RASTER_PAINT_H
#define LMB_RASTER_PAINT_H

#include "resolve.h"

/* Base colour times the albedo, and the normal map bends the normals, of the tile's pixels that have a slot; after
 * kernels->resolve, which set them. A normal that leaves the viewer's side of the face is lifted to it. */
void lmb_paint_tile(lmb_tile *out, const lmb_resolve_batch *batch, const lmb_kernels *kernels, const lmb_scene *scene);

#endif
