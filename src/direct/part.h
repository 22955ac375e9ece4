/* part.h: finds which face of a sun's map holds a point. Layer 4. */
#ifndef LMB_DIRECT_PART_H
#define LMB_DIRECT_PART_H

#include <lambent/map.h>

/* The finest face of a directional light's shadow map that contains a point and two texels around it. */
int32_t lmb_shadow_map_part(const lmb_shadow_map *map, lmb_vec3 at);

#endif
