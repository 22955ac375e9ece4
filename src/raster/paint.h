/* paint.h: colours and normals from the textures of a triangle. Layer 3. */
#ifndef LMB_RASTER_PAINT_H
#define LMB_RASTER_PAINT_H

#include "plane.h"
#include "triangle.h"

/* A triangle's plane and texture coordinates, for images on it. */
typedef struct lmb_painted {
    int32_t slot; /* of the batch it was taken from */
    lmb_plane plane;
    float uv[3][2]; /* corner 0, and the differences of the others from it */
} lmb_painted;

/* For the tile's pixels with a slot: multiplies albedo by the base colour, subtracts the part of metals, and bends
 * normals by the normal map. Call it after kernels->resolve. A normal that leaves the viewer's side of the face is
 * lifted to it. */
void lmb_paint_tile(lmb_tile *out, const lmb_resolve_batch *batch, const lmb_kernels *kernels, const lmb_scene *scene);

#if LMB_LOBES

/* Reads textures at the pixels of a resolved tile. */
typedef struct lmb_painter {
    const lmb_tile *tile;
    const lmb_scene *scene;
    lmb_rays rays;
    lmb_triangle triangle; /* of the last pixel; id 0: none yet */
    lmb_painted painted;
} lmb_painter;

/* The tile was resolved for `view`. All three must outlive the painter. */
void lmb_painter_begin(lmb_painter *out, const lmb_scene *scene, const lmb_view *view, const lmb_tile *tile);

/* Linear light of scene->textures[texture] at pixel k, which has an id, filtered as base colours are. */
void lmb_painter_colour(float out[4], lmb_painter *at, uint32_t texture, int k);

/* Metalness and roughness of pixel k, with the material's metal_map. */
void lmb_painter_metal(float *metallic, float *roughness, lmb_painter *at, int k);

/* The base colour at pixel k: albedo x texture x vertex colour, before the part of metals is subtracted. */
void lmb_painter_base(float out[3], lmb_painter *at, int k);

#endif

#endif
