/* codec.c: sRGB codes by tables, octahedral normals. Layer 1. */
#include "codec.h"

#include <lambent/scene.h>

#include "vec.h"

#include "srgb_table.inc"

/* Eight halvings find the largest code with a threshold that is reached. NaN reaches none. */
uint8_t lmb_srgb_encode(float linear)
{
    int32_t code = 0, step;
    for (step = 128; step > 0; step >>= 1)
        code += linear >= lmb_srgb_threshold[code + step] ? step : 0;
    return (uint8_t)code;
}

/* The sphere is projected to the octahedron |x| + |y| + |z| = 1. Its lower half folds outwards over the diagonals of
 * the unit square (Meyer, Suessmuth, Sussner, Stamminger 2010). In integers the fold is exact. */
lmb_vec3 lmb_octahedral_decode(const int16_t code[2])
{
    if (!code)
        return vec3(0.0f, 0.0f, 1.0f);
    int32_t x = maxi(code[0], -32767), y = maxi(code[1], -32767);
    int32_t z = 32767 - (x < 0 ? -x : x) - (y < 0 ? -y : y);
    if (z < 0) {
        x += x < 0 ? -z : z;
        y += y < 0 ? -z : z;
    }
    return normalize3(vec3((float)x, (float)y, (float)z));
}

/* Position of a unit vector in the folded square, -32767 .. 32767 a side. */
static void octahedral_project(float out[2], lmb_vec3 n)
{
    float scale = 32767.0f / (absf(n.x) + absf(n.y) + absf(n.z));
    float x = n.x * scale, y = n.y * scale;
    if (n.z < 0.0f) {
        out[0] = x < 0.0f ? absf(y) - 32767.0f : 32767.0f - absf(y);
        out[1] = y < 0.0f ? absf(x) - 32767.0f : 32767.0f - absf(x);
    } else {
        out[0] = x;
        out[1] = y;
    }
}

/* Rounding each coordinate by itself may err by 6.5e-5 rad: the square's grid is skewed on the sphere. The nearest of
 * the four surrounding codes errs by 4.4e-5 at most, the covering radius of that grid at a face's centre. */
void lmb_octahedral_encode(int16_t out[2], lmb_vec3 unit)
{
    lmb_vec3 n = normalize3(unit), d;
    float at[2], error, best = 4.0f;
    int32_t i;
    int16_t code[2];
    if (!out)
        return;
    out[0] = out[1] = 0;
    if (!(dot3(n, n) > 0.5f && dot3(n, n) < 2.0f)) /* zero, denormal, infinite, NaN: +z */
        return;
    octahedral_project(at, n);
    for (i = 0; i < 4; ++i) {
        code[0] = (int16_t)clampf(floorf(at[0]) + (float)(i & 1), -32767.0f, 32767.0f);
        code[1] = (int16_t)clampf(floorf(at[1]) + (float)(i >> 1), -32767.0f, 32767.0f);
        d = sub3(lmb_octahedral_decode(code), n);
        error = dot3(d, d);
        if (error < best) {
            best = error;
            out[0] = code[0];
            out[1] = code[1];
        }
    }
}
