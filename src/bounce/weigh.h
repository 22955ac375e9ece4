/* weigh.h: one node of the light's tree against one surface of a tile: what it gives, at most, and its error. Floor 6. */
#ifndef LMB_BOUNCE_WEIGH_H
#define LMB_BOUNCE_WEIGH_H

#include "../base/vec.h"
#include "tree.h"

/* The pixels of one surface in a tile. */
typedef struct patch {
    uint64_t pixels;
    lmb_vec3 low, high, centre, half; /* box of their positions */
    lmb_vec3 normal;                  /* mean */
    float cosine, sine;               /* of the widest angle to the mean */
    float face_sine;                  /* of theirs and of their faces' */
} patch;

static inline float gap(float centre, float halves) { return maxf(absf(centre) - halves, 0.0f); }

/* Between two boxes: `to`: from one's centre to the other's. */
static inline lmb_vec3 boxes_apart(lmb_vec3 to, lmb_vec3 a, lmb_vec3 b)
{
    return vec3(gap(to.x, a.x + b.x), gap(to.y, a.y + b.y), gap(to.z, a.z + b.z));
}

void lmb_patch_of(patch *out, const lmb_tile *tile, uint64_t pixels);

/* What a node gives the patch's middle, and what it may be wrong by. */
typedef struct weight {
    int faces; /* 0: all of it faces away */
    float value, most, error;
} weight;

/* A node gives at most U = M cosP cosG / (pi d^2), with the largest cosines and the least distance d between its box and
 * the surface's. Seen as one disc it is wrong by second order in size and bend: U min(1, R^2 / 2 d^2 + sin^2 a), R half
 * its box's diagonal, a the widest angle of its normals; by first order where a horizon goes through it. `seen`: where its
 * visibility is asked. Right for all but a few of thousands of nodes: a rule, no proof. */
weight lmb_weigh(const lmb_node *n, const lmb_texel *seen, const patch *p);

/* The same with what holds for every pixel and every texel in the node: value is the least that any pixel gets, error the
 * most that the node's disc and the sum of its texels may differ by. With least and largest cosines and distances and
 * s = A / (pi d^2), the disc formula (gather.inl) lies between M / (pi D^2) (c (1 - 2 s) - s) and
 * M / (pi d^2) (c (1 + s) + cosG^2 s), since -(c + cosG^2) <= t <= 2 c + 1; exact shapes near by do, too. */
weight lmb_weigh_proven(const lmb_node *n, const lmb_texel *seen, const patch *p);

#endif
