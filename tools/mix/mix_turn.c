/* mix_turn.c: rigid transforms between the spaces of cameras, scenes and worlds. */
#include "mix_turn.h"

lmb_vec3 mix_turn(const lmb_mat4 *t, lmb_vec3 d)
{
    const float *m = t->m;
    const lmb_vec3 out = {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                          m[2] * d.x + m[6] * d.y + m[10] * d.z};
    return out;
}

lmb_vec3 mix_move(const lmb_mat4 *t, lmb_vec3 p)
{
    const lmb_vec3 d = mix_turn(t, p), out = {d.x + t->m[12], d.y + t->m[13], d.z + t->m[14]};
    return out;
}

lmb_mat4 mix_back(const lmb_mat4 *t)
{
    lmb_mat4 out = {{0}};
    for (int i = 0; i < 9; ++i) {
        out.m[i / 3 * 4 + i % 3] = t->m[i % 3 * 4 + i / 3];
    }
    const lmb_vec3 at = {-t->m[12], -t->m[13], -t->m[14]}, back = mix_turn(&out, at);
    out.m[12] = back.x;
    out.m[13] = back.y;
    out.m[14] = back.z;
    out.m[15] = 1.0f;
    return out;
}

lmb_mat4 mix_product(const lmb_mat4 *a, const lmb_mat4 *b)
{
    lmb_mat4 out;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k) {
                sum += (double)a->m[4 * k + r] * (double)b->m[4 * c + k];
            }
            out.m[4 * c + r] = (float)sum;
        }
    }
    return out;
}
