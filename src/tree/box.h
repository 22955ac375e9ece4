/* box.h: oriented boxes with bounds that do not depend on the orientation of the world. Layer 6. */
#ifndef LMB_TREE_BOX_H
#define LMB_TREE_BOX_H

#include "../base/vec.h"

/* If the part of `towards` across the normal is below this share of the whole, it is rounding. */
#define BOX_ACROSS 1e-3f

/* A unit vector perpendicular to a unit normal: along the part of `towards` across it, or across the world axis least
 * along it. */
static inline lmb_vec3 box_across(lmb_vec3 normal, lmb_vec3 towards)
{
    const lmb_vec3 part = sub3(towards, mul3(normal, dot3(normal, towards)));
    if (dot3(part, part) > BOX_ACROSS * BOX_ACROSS * dot3(towards, towards)) {
        return normalize3(part);
    }
    const lmb_vec3 a = vec3(absf(normal.x), absf(normal.y), absf(normal.z));
    const lmb_vec3 min = a.x <= a.y && a.x <= a.z ? vec3(1, 0, 0) : a.y <= a.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
    return normalize3(cross3(normal, min));
}

static inline lmb_vec3 longer3(lmb_vec3 a, lmb_vec3 b) { return dot3(a, a) >= dot3(b, b) ? a : b; }

/* A box that grows along three axes from one point; empty at first. */
typedef struct box_span {
    lmb_vec3 from, axis[3];
    float low[3], high[3];
} box_span;

static inline box_span box_begin(lmb_vec3 from, lmb_vec3 normal, lmb_vec3 across)
{
    box_span s;
    s.from = from;
    s.axis[0] = normal;
    s.axis[1] = across;
    s.axis[2] = cross3(normal, across);
    for (int i = 0; i < 3; ++i) {
        s.low[i] = 3e38f;
        s.high[i] = -3e38f;
    }
    return s;
}

static inline void box_add(box_span *s, int i, float at, float half)
{
    s->low[i] = minf(s->low[i], at - half);
    s->high[i] = maxf(s->high[i], at + half);
}

static inline void box_add_point(box_span *s, lmb_vec3 p)
{
    for (int i = 0; i < 3; ++i) {
        box_add(s, i, dot3(s->axis[i], sub3(p, s->from)), 0.0f);
    }
}

static inline float box_half(const box_span *s, int i) { return 0.5f * (s->high[i] - s->low[i]); }

static inline lmb_vec3 box_middle(const box_span *s)
{
    lmb_vec3 m = s->from;
    for (int i = 0; i < 3; ++i) {
        m = add3(m, mul3(s->axis[i], 0.5f * (s->high[i] + s->low[i])));
    }
    return m;
}

#endif
