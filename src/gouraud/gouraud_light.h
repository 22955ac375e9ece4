/* gouraud_light.h: the light at a triangle's corner, and its colour. Layer 10. */
#ifndef LMB_GOURAUD_LIGHT_H
#define LMB_GOURAUD_LIGHT_H

#include <lambent/gouraud.h>

#include "../raster/triangle.h"

/* Add what arrives straight from the lights on a plane of the normal. is_exact: shadows by the triangles that the map
 * names; else by its depth, off by a texel. */
void lmb_gouraud_direct(float inout[3], const lmb_gouraud *g, lmb_vec3 at, lmb_vec3 normal, uint32_t id, int is_exact);

/* Add what a blend of clusters throws back along a normal. */
void lmb_gouraud_blend(float inout[3], const lmb_gouraud *g, uint32_t blend, lmb_vec3 normal);

/* The base colour of a triangle, of its material and its texture's mean; without colours of its own. */
void lmb_gouraud_albedo(float out[3], const lmb_scene *scene, const lmb_material *material);

/* sRGB codes of `albedo` lit by `e`, W/m2; gain: 2^exposure / pi. */
void lmb_gouraud_colour(float out[3], const float e[3], const float albedo[3], float gain);

#endif
