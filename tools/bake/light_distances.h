/* light_distances.h: how far light at a place may use a probe: distances from the probe to the surfaces around it. */
#ifndef LIGHT_DISTANCES_H
#define LIGHT_DISTANCES_H

#include "../render/ray_space.h"

/* Distances around a probe, a cube map: of each texel the mean and the mean square over its directions of 1 / distance
 * along the face's axis, 1/m, 1/m2. A plane is linear on a face. Faces +x -x +y -y +z -z, rows of texels; a direction d
 * is at 0.5 + 0.5 (d[a + 1], d[a + 2]) / |d[a]| of the square of its longest axis a; after z comes x. */
enum { LIGHT_DISTANCES_SIDE = 4, LIGHT_DISTANCES = 2 * 6 * LIGHT_DISTANCES_SIDE * LIGHT_DISTANCES_SIDE };

/* light_distances: traces the map, nine rays per texel. Surfaces closer than nearest_m count as so far. */
void light_distances(float out[LIGHT_DISTANCES], ray_space *space, lmb_vec3 at, float nearest_m);

/* light_distances_weight: the weight of a probe for light at a place, 2.5e-11 .. 1.2: small if the probe lies behind
 * the surface, or if a surface lies between them. The variance bounds the share of directions with a surface beyond the
 * place (Chebyshev), as in Majercik et al. 2019, who use distances and an octahedral
 * map. step_m: the shortest step of the lattice. */
float light_distances_weight(const float map[LIGHT_DISTANCES], lmb_vec3 probe, float step_m, lmb_vec3 at,
                             lmb_vec3 normal);

#endif
