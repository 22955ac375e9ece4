/* shadow.h: tests by the shadow map whether a point of a surface is lit. Layer 5. */
#ifndef LMB_LIGHT_SHADOW_H
#define LMB_LIGHT_SHADOW_H

#include <lambent/map.h>

/* A pixel's surface point. */
typedef struct lmb_receiver {
    lmb_vec3 position, face; /* world; unit normal */
    uint32_t id;             /* its own triangle never shadows it */
    float noise;             /* m: what rounding may have moved the position by */
} lmb_receiver;

int lmb_is_lit(const lmb_shadow_map *map, const lmb_light *light, const lmb_scene *scene, const lmb_receiver *receiver);

/* By the depth of the nearest texel alone: a tenth of the work, off by a texel. */
int lmb_is_lit_by_depth(const lmb_shadow_map *map, const lmb_light *light, const lmb_receiver *receiver);

#endif
