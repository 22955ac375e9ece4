/* relief_bake.h: a complex scene and a simple model -> a .lmr: views chosen, drawn, packed. */
#ifndef RELIEF_BAKE_H
#define RELIEF_BAKE_H

#include <lambent/relief.h>

#include "../mesh/simplify.h"
#include "../picture/image.h"

/* A view's picture as it is stored. */
typedef struct relief_picture {
    lmb_view view;
    uint8_t *texels;
    size_t bytes;
} relief_picture;

/* A .lmr in the making. Zeroed it is empty; relief_bake_free releases it. */
typedef struct relief_bake {
    relief_picture picture[LMB_RELIEF_VIEWS];
    int32_t views;
    int32_t format; /* LMB_RELIEF_FULL or _PACKED: set it first */
} relief_bake;

/* What its views make of the complex surface, shares of its area. */
typedef struct relief_coverage {
    double unseen;  /* by no view */
    double slanted; /* by none within 60 degrees of its normal */
} relief_coverage;

/* relief_fit: an orthographic view along `direction` (from the mesh to the eye), size x size texels, as narrow as the
 * mesh allows. */
lmb_view relief_fit(const triangle_mesh *mesh, lmb_vec3 direction, int32_t size);

/* relief_reach: near and far plane of a perspective view, as close around the mesh as may be: depth is coded between
 * them. 0 where nothing of it lies before the view. */
int relief_reach(lmb_view *inout, const triangle_mesh *mesh);

/* relief_directions: `count` unit vectors all around: the faces, edges and corners of a cube for 6, 14, 18 and 26, on a
 * spiral else. */
void relief_directions(lmb_vec3 *out, int32_t count);

/* relief_greedy: of 98 directions those that see most of what is not yet seen well, one after the other. 1, or 0 with
 * `r` set. */
int relief_greedy(lmb_vec3 *out, int32_t count, const triangle_mesh *mesh, const lmb_scene *scene, int32_t size,
                  report *r);

/* relief_add_views: draw views of the scene, so many threads at once, and keep them; relief_add: one. 1, or 0 with `r`
 * set. */
int relief_add_views(relief_bake *bake, const lmb_scene *scene, const lmb_view *view, int32_t count, int threads,
                     report *r);
int relief_add(relief_bake *bake, const lmb_scene *scene, const lmb_view *view, report *r);

/* relief_add_planes: the same of a picture that is there: depth m along the axis (0: nothing), normals, linear or
 * (codes 1) sRGB-coded colours 0 .. 1, 3 floats a texel. */
int relief_add_planes(relief_bake *bake, const lmb_view *view, const float *depth, const float *normal,
                      const float *colour, int codes, report *r);

/* relief_cover: how well the views see a mesh. */
int relief_cover(relief_coverage *out, const relief_bake *bake, const triangle_mesh *mesh, report *r);

/* relief_encode: the file. Allocates *out. */
int relief_encode(file_bytes *out, const relief_bake *bake, const triangle_mesh *simple, report *r);

void relief_bake_free(relief_bake *bake);

#endif
