/* gouraud_light.h: the light at a triangle's corner, and the colour. Layer 8. */
#ifndef LMB_GOURAUD_LIGHT_H
#define LMB_GOURAUD_LIGHT_H

#include <lambent/gouraud.h>

#include "../raster/triangle.h"

/* Adds direct light on a plane with this normal. is_exact: shadows from the triangles that the map names; otherwise
 * from the map's depth, off by up to a texel. */
void lmb_gouraud_direct(float inout[3], const lmb_gouraud *g, lmb_vec3 at, lmb_vec3 normal, uint32_t id, int is_exact);

/* Adds the light that a blend of clusters reflects, on a plane with this normal. */
void lmb_gouraud_blend(float inout[3], const lmb_gouraud *g, uint32_t blend, lmb_vec3 normal);

/* The base colour of a triangle: material times the mean of the texture, without vertex colours. */
void lmb_gouraud_albedo(float out[3], const lmb_scene *scene, const lmb_material *material);

/* sRGB codes of `albedo` lit by `e`, W/m2; gain: 2^exposure / pi. */
void lmb_gouraud_colour(float out[3], const float e[3], const float albedo[3], float gain);

#endif
