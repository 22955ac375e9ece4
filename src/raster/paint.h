/* paint.h: colours and normals from the textures of a triangle. Layer 3. */
#ifndef LMB_RASTER_PAINT_H
#define LMB_RASTER_PAINT_H

#include "plane.h"
#include "triangle.h"

/* A triangle's plane and texture coordinates, as images lie on it. */
typedef struct lmb_painted {
    int32_t slot; /* of the batch it was taken from */
    lmb_plane plane;
    float uv[3][2]; /* corner 0, and the others' differences from it */
} lmb_painted;

/* Base colour times the albedo, less what a metal takes of it, and the normal map bends the normals, of the tile's
 * pixels that have a slot; after kernels->resolve, which set them. A normal that leaves the viewer's side of the face
 * is lifted to it. */
void lmb_paint_tile(lmb_tile *out, const lmb_resolve_batch *batch, const lmb_kernels *kernels, const lmb_scene *scene);

#if LMB_LOBES

/* A tile's pixels once it is resolved, by the images of their own triangles. */
typedef struct lmb_painter {
    const lmb_tile *tile;
    const lmb_scene *scene;
    lmb_rays rays;
    lmb_triangle triangle; /* of the last pixel; id 0: none yet */
    lmb_painted painted;
} lmb_painter;

/* The tile was resolved for `view`; all three stay while the painter is used. */
void lmb_painter_begin(lmb_painter *out, const lmb_scene *scene, const lmb_view *view, const lmb_tile *tile);

/* Linear light of scene->textures[texture] at pixel k, which has an id, filtered as base colours are. */
void lmb_painter_colour(float out[4], lmb_painter *at, uint32_t texture, int k);

/* How much of a metal pixel k is, and how rough, by its material's metal_map. */
void lmb_painter_metal(float *metallic, float *roughness, lmb_painter *at, int k);

/* The base colour at pixel k: albedo x texture x vertex colour, all of it before a metal takes its part. */
void lmb_painter_base(float out[3], lmb_painter *at, int k);

#endif

#endif
