/* mix_turn.h: rigid transforms between the spaces of cameras, scenes and worlds. Matrices are in columns, as in the
 * library. */
#ifndef MIX_TURN_H
#define MIX_TURN_H

#include <lambent/types.h>

/* mix_turn, mix_move: transform a direction, a point. mix_back: the inverse of a rigid transform. mix_product: first b,
 * then a. */
lmb_vec3 mix_turn(const lmb_mat4 *t, lmb_vec3 d);
lmb_vec3 mix_move(const lmb_mat4 *t, lmb_vec3 p);
lmb_mat4 mix_back(const lmb_mat4 *t);
lmb_mat4 mix_product(const lmb_mat4 *a, const lmb_mat4 *b);

#endif
