/* shadow.h: tests by the shadow map whether a point of a surface is lit. Layer 4. */
#ifndef LMB_DIRECT_SHADOW_H
#define LMB_DIRECT_SHADOW_H

#include <lambent/map.h>

#include "../base/vec.h"
#include "../lane/kernels.h"

/* A pixel's surface point. */
typedef struct lmb_receiver {
    lmb_vec3 position, face; /* world; unit normal */
    uint32_t id;             /* its own triangle never shadows it */
} lmb_receiver;

/* Answers in builds with LMB_FACETS for a lit point whose triangle is named by none of the four texels around it, and
 * by some but not all. */
enum { LMB_LIT_IN_DOUBT = 2, LMB_LIT_BESIDE = 3 };

/* Pixels of a tile that the map takes for lit. doubtful, beside: those with the answers above. */
typedef struct lmb_lit_pixels {
    uint64_t lit, doubtful, beside;
} lmb_lit_pixels;

#if LMB_FACETS
/* A triangle in a face of the map. */
typedef struct lmb_own_tips {
    uint32_t id; /* 0: none */
    int32_t face;
    float x[3], y[3], reach; /* texels; reach: 0 if the triangle is not in front of the light */
} lmb_own_tips;
#endif

/* The face of a map that shows the direction d from its light. Not for suns. */
static inline int32_t shadow_map_face(const lmb_shadow_map *map, lmb_vec3 d)
{
    return map->faces == 1 ? 0 : (int32_t)side_of3(d);
}

/* The shadow map of one light, for any number of points that a view sees. */
typedef struct lmb_shadow_query {
    const lmb_shadow_map *map;
    const lmb_light *light;
    const lmb_scene *scene;
    const lmb_view *view;
    lmb_fill_window window; /* of the last face used */
    int32_t face;           /* -1: none */
#if LMB_FACETS
    lmb_own_tips tips; /* of the last receiver that needed them */
#endif
} lmb_shadow_query;

void lmb_shadow_ask(lmb_shadow_query *out, const lmb_shadow_map *map, const lmb_light *light, const lmb_scene *scene,
                    const lmb_view *view);
#if LMB_SHADOW_LANES
/* The answers of lmb_is_lit for the requested pixels of a tile. */
void lmb_shadow_lit(lmb_lit_pixels *out, lmb_shadow_query *query, const lmb_kernels *kernels, const lmb_tile *tile,
                    uint64_t asked);
#endif
#if LMB_FACETS
/* Returns the lit pixels to trace, from lmb_shadow_lit's answer: all if up to two are lit, otherwise those in
 * `doubtful`. Also those in `beside` if all lit pixels are in one of the two sets, or up to 16 are lit, as in a sealed
 * room. is_brief: of these only pixels around which a texel shows a surface in front of their plane. That test takes
 * about 700 instructions a pixel. */
uint64_t lmb_shadow_unsure(lmb_shadow_query *query, const lmb_tile *tile, const lmb_lit_pixels *found, int is_brief);
#endif
/* Returns 0 if the point is in shadow. */
int lmb_is_lit(lmb_shadow_query *query, const lmb_receiver *receiver);

#endif
