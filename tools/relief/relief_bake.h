/* relief_bake.h: bakes a complex scene and a simple model to a .lmr: chooses, draws and packs views. */
#ifndef RELIEF_BAKE_H
#define RELIEF_BAKE_H

#include <lambent/relief.h>

#include "../mesh/simplify.h"
#include "../picture/image.h"

/* A view's picture as stored. */
typedef struct relief_picture {
    lmb_view view;
    uint8_t *texels;
    size_t bytes;
} relief_picture;

/* A .lmr in the making. Zeroed: empty. Release it with relief_bake_free when you have encoded it. */
typedef struct relief_bake {
    relief_picture picture[LMB_RELIEF_VIEWS];
    int32_t views;
    int32_t format; /* LMB_RELIEF_FULL or _PACKED: set it first */
} relief_bake;

/* Shares of the complex surface's area. */
typedef struct relief_coverage {
    double unseen;  /* visible in no view */
    double slanted; /* in no view within 60 degrees of the normal */
} relief_coverage;

/* relief_fit: an orthographic view along `direction` (from the mesh to the eye), size x size texels, fitted closely to
 * the mesh. */
lmb_view relief_fit(const triangle_mesh *mesh, lmb_vec3 direction, int32_t size);

/* relief_reach: sets near and far plane of a perspective view as close to the mesh as possible, because depth is coded
 * between them. Returns 0 if no part of the mesh lies in front of the view. */
int relief_reach(lmb_view *inout, const triangle_mesh *mesh);

/* relief_directions: `count` unit vectors in all directions: faces, edges and corners of a cube for 6, 14, 18 and 26,
 * otherwise a spiral. */
void relief_directions(lmb_vec3 *out, int32_t count);

/* relief_greedy: chooses from 98 directions, one at a time, the one that most improves the views of the surface.
 * Returns 1, or 0 with `r` set. */
int relief_greedy(lmb_vec3 *out, int32_t count, const triangle_mesh *mesh, const lmb_scene *scene, int32_t size,
                  report *r);

/* relief_add_views: draws views of the scene on `threads` threads and stores them; relief_add: draws one. They return
 * 1, or 0 with `r` set. */
int relief_add_views(relief_bake *bake, const lmb_scene *scene, const lmb_view *view, int32_t count, int threads,
                     report *r);
int relief_add(relief_bake *bake, const lmb_scene *scene, const lmb_view *view, report *r);

/* relief_add_planes: adds a view from planes that you provide: depth, m along the axis (0: nothing), normals, and
 * colours 0 .. 1, linear or (codes 1) sRGB-coded, 3 floats per texel. */
int relief_add_planes(relief_bake *bake, const lmb_view *view, const float *depth, const float *normal,
                      const float *colour, int codes, report *r);

/* relief_cover: measures how well the views show a mesh. */
int relief_cover(relief_coverage *out, const relief_bake *bake, const triangle_mesh *mesh, report *r);

/* relief_encode: encodes the file. Allocates *out. */
int relief_encode(file_bytes *out, const relief_bake *bake, const triangle_mesh *simple, report *r);

void relief_bake_free(relief_bake *bake);

#endif
