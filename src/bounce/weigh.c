/* weigh.c: one node of the light's tree against one surface of a tile. Floor 6.                                [V27] */
#include "weigh.h"

#include "../base/vec.h"
#include "../raster/tile.h"

#if LMB_TREES

#define INVERSE_PI 0.31830989f
#define SECOND     0.5f  /* of R^2 / d^2: boxes hold whole texels, of which discs are right to second order already */
#define TURNED     16.0f /* how much more a node counts whose point that is asked faces away: its others may not */
#define ROUNDED    1e-4f /* more than rounding takes of a bound, of its own size and of the distance */

/* Of an angle under 90 degrees; 1 over. */
static float sine_of(float cosine) { return cosine > 0.0f ? sqrtf(maxf(1.0f - cosine * cosine, 0.0f)) : 1.0f; }

void lmb_patch_of(patch *out, const lmb_tile *tile, uint64_t pixels)
{
    lmb_vec3 sum = vec3(0, 0, 0);
    float face = 1.0f;
    out->pixels = pixels;
    tile_box(&out->low, &out->high, tile, pixels);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        sum = add3(sum, tile_vec(tile->normal, lowest_bit_64(bits)));
    }
    out->centre = mul3(add3(out->low, out->high), 0.5f);
    out->half = mul3(sub3(out->high, out->low), 0.5f);
    out->normal = normalize3(sum);
    out->cosine = 1.0f;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        out->cosine = minf(out->cosine, dot3(out->normal, tile_vec(tile->normal, k)));
        face = minf(face, dot3(out->normal, tile_vec(tile->face, k)));
    }
    out->sine = sine_of(out->cosine);
    out->face_sine = sine_of(minf(face, out->cosine));
}

static float support(lmb_vec3 half, lmb_vec3 n) { return absf(n.x) * half.x + absf(n.y) * half.y + absf(n.z) * half.z; }

weight lmb_weigh(const lmb_node *n, const lmb_texel *seen, const patch *p)
{
    weight w = {0, 0.0f, 0.0f, 0.0f};
    const lmb_vec3 middle = mul3(add3(n->low, n->high), 0.5f), half = mul3(sub3(n->high, n->low), 0.5f);
    const lmb_vec3 to = sub3(middle, p->centre);
    const float reach = length3(to) + length3(half) + length3(p->half);
    const float sine = sine_of(n->cosine);
    const float up = dot3(p->normal, to) + support(half, p->normal) + support(p->half, p->normal) + p->sine * reach;
    const float out = support(half, n->normal) + support(p->half, n->normal) - dot3(n->normal, to) + sine * reach;
    const float m = flux_sum(n->flux);
    if (!(up > 0.0f) || !(out > 0.0f) || !(m > 0.0f)) {
        return w;
    }
    const lmb_vec3 apart = boxes_apart(to, half, p->half);
    /* A node that holds the patch may give any amount: so much that it is divided first, but not so much that the sum
     * of errors keeps the rounding of it when it is gone. */
    const float d2 = maxf(dot3(apart, apart), maxf(1e-6f * dot3(half, half), 1e-12f)), d = sqrtf(d2);
    w.most = m * INVERSE_PI / d2 * minf(up / d, 1.0f) * minf(out / d, 1.0f);
    /* A node that a horizon goes through, the patch's or its own, is wrong by first order: of a quarter of U where its
     * middle is on it and counts for nothing. */
    const float over = 2.0f * (support(half, p->normal) + support(p->half, p->normal) + p->sine * reach),
                before = 2.0f * (support(half, n->normal) + support(p->half, n->normal) + sine * reach);
    const float second = SECOND * dot3(half, half) / d2 + sine * sine;
    const float size = up < over || out < before ? maxf(second, 0.25f) : second;
    w.faces = 1;
    w.error = w.most * minf(size, 1.0f);
    const lmb_vec3 s = sub3(seen->position, p->centre);
    if (dot3(seen->normal, s) >= 0.0f || dot3(p->normal, s) <= 0.0f) {
        w.most *= TURNED;
    }
    w.value = m * lmb_disc_factor(p->centre, p->normal, n->centre, n->normal, n->area);
    return w;
}

weight lmb_weigh_proven(const lmb_node *n, const lmb_texel *seen, const patch *p)
{
    weight w = lmb_weigh(n, seen, p);
    const lmb_vec3 middle = mul3(add3(n->low, n->high), 0.5f), half = mul3(sub3(n->high, n->low), 0.5f);
    const lmb_vec3 to = sub3(middle, p->centre);
    const float farthest = length3(to) + length3(half) + length3(p->half), slack = ROUNDED * farthest;
    const float up = dot3(p->normal, to), out = -dot3(n->normal, to), m = flux_sum(n->flux);
    const float ups = support(half, p->normal) + support(p->half, p->normal) + p->face_sine * farthest + slack;
    const float outs = support(half, n->normal) + support(p->half, n->normal) + sine_of(n->cosine) * farthest + slack;
    const lmb_vec3 apart = boxes_apart(to, half, p->half);
    const float d2 = maxf(dot3(apart, apart), 1e-12f), d = sqrtf(d2), s = n->area * INVERSE_PI / d2;
    const float high_p = minf(maxf(up + ups, 0.0f) / d, 1.0f), high_g = minf(maxf(out + outs, 0.0f) / d, 1.0f);
    const float low_p = maxf(up - ups, 0.0f) / farthest, low_g = maxf(out - outs, 0.0f) / farthest;
    const float most = m * INVERSE_PI / d2 * (high_p * high_g * (1.0f + s) + high_g * high_g * s);
    const float least =
        m * INVERSE_PI / (farthest * farthest) * (s < 0.5f ? low_p * low_g * (1.0f - 2.0f * s) - s : 0.0f);
    w.faces = m > 0.0f && high_p > 0.0f && high_g > 0.0f;
    w.value = maxf(least, 0.0f) * (1.0f - ROUNDED);
    w.error = most * (1.0f + ROUNDED) - w.value;
    return w;
}

#endif
