/* mix_block.h: small pictures of an object from many directions, which show the blocked parts of the environment. The
 * pictures are in mesh space, so all placements of an object share those that do not depend on a light. */
#ifndef MIX_BLOCK_H
#define MIX_BLOCK_H

#include <lambent/lambent.h>

#include "../model/model.h"

enum { MIX_BLOCK_WAYS = 48 /* directions of the environment */ };

/* The object as seen from a direction or, if `is_near`, from a point light. */
typedef struct mix_block_view {
    lmb_vec3 x, y, to; /* unit; `to`: towards the light */
    lmb_vec3 middle;   /* of the object */
    float away;        /* of a point light, from the middle, in mesh units */
    int is_near;
    float per_unit; /* texels */
    int32_t side;
    float *key;      /* side x side: how near to the light the object reaches, mesh units; -FLT_MAX: not there */
    float *sum;      /* (side + 1) x (side + 1): texels covered, summed from the first corner */
    float low, high; /* of the keys */
} mix_block_view;

/* A mesh without its structure. */
typedef struct mix_block {
    float *corner; /* 9 per triangle, mesh space */
    uint32_t triangles;
    lmb_vec3 middle;
    float radius;
    float albedo[3];                    /* mean, by area */
    mix_block_view way[MIX_BLOCK_WAYS]; /* evenly spread over the sphere */
    void *memory;
} mix_block;

/* mix_block_make: returns 1, or 0 if memory is short. Release it with mix_block_free. */
int mix_block_make(mix_block *out, const lmb_scene *scene);
void mix_block_free(mix_block *b);

/* mix_block_bytes: memory of a view's arrays. mix_block_look: draws a view; `to` is a direction, or the position
 * of a light if is_near. Returns 0 if the point light is inside the object's sphere: it has no shadow. */
size_t mix_block_bytes(int32_t side);
int mix_block_look(mix_block_view *out, const mix_block *b, lmb_vec3 to, int is_near, int32_t side, void *memory);

/* mix_block_soft: the share of a cone from p, 0 .. 1, that the object covers; for surfaces that the object does not
 * reach behind. spread: the tangent of half the cone's angle. mix_block_hard: the share of the texels around p's that
 * lie nearer to the light than p by over `bias`. */
float mix_block_soft(const mix_block_view *v, lmb_vec3 p, float spread);
float mix_block_hard(const mix_block_view *v, lmb_vec3 p, float bias);

#endif
