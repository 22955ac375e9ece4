/* part.h: which face of a sun's map. Floor 4. */
#ifndef LMB_MAP_PART_H
#define LMB_MAP_PART_H

#include <lambent/map.h>

/* The finest face of a directional light's map that has a place, and two texels around it. */
int32_t lmb_light_map_part(const lmb_light_map *map, lmb_vec3 at);

#endif
