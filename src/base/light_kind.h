/* light_kind.h: kinds of light with a position, a direction or a cone; ranges of lights. Layer 1. */
#ifndef LMB_BASE_LIGHT_KIND_H
#define LMB_BASE_LIGHT_KIND_H

#include <lambent/scene.h>

#include "vec.h"

/* A bit for each kind. FAR: comes from one direction and does not fall off with distance. */
enum {
    LIGHT_KNOWN = 1 << LMB_LIGHT_POINT | 1 << LMB_LIGHT_SPOT | 1 << LMB_LIGHT_DIRECTIONAL,
    LIGHT_PLACED = 1 << LMB_LIGHT_POINT | 1 << LMB_LIGHT_SPOT,
    LIGHT_FAR = LIGHT_KNOWN & ~LIGHT_PLACED,
    LIGHT_AIMED = 1 << LMB_LIGHT_SPOT | 1 << LMB_LIGHT_DIRECTIONAL,
    LIGHT_CONED = 1 << LMB_LIGHT_SPOT
};

/* Returns 0 for unknown kinds. */
static inline int light_kind_is(int32_t kind, uint32_t which)
{
    return (uint32_t)kind < 32u && (which >> kind & 1u) != 0;
}

/* Checks a known kind: a direction of unit length, a cone that opens outwards. NaN fails. */
static inline int light_shape_is_valid(const lmb_light *l)
{
    if (light_kind_is(l->kind, LIGHT_AIMED) && !(absf(dot3(l->direction, l->direction) - 1.0f) <= 1e-3f)) {
        return 0;
    }
    return !light_kind_is(l->kind, LIGHT_CONED) ||
           (l->cos_outer > 0.0f && l->cos_inner >= l->cos_outer && l->cos_inner <= 1.0f);
}

/* The light's range squared, 2^-80 .. 2^60 m2; 0: no range, as always in small builds (LMB_TREES 0). */
static inline float light_range2(const lmb_light *l)
{
    return LMB_TREES && light_kind_is(l->kind, LIGHT_PLACED) && l->range > 0.0f && l->range < 0x1p+30f
               ? maxf(l->range * l->range, 0x1p-80f) : 0.0f;
}

/* Factor of a light's range at a squared distance: 1 - (d / range)^4, exactly 0 from d = range on. Squared distances
 * under 2^-40 of range2 are raised to that, because they change nothing and would make denormals. */
static inline float light_within(float d2, float range2)
{
    const float t = range2 > 0.0f ? minf(maxf(d2, range2 * 0x1p-40f) / range2, 1.0f) : 0.0f;
    return 1.0f - t * t;
}

/* The same factor for a light and a position. */
static inline float light_within_at(const lmb_light *l, lmb_vec3 at)
{
    const lmb_vec3 to = sub3(l->position, at);
    return light_within(dot3(to, to), light_range2(l));
}

#endif
