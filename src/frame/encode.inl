/* encode.inl: linear values -> sRGB codes, the same as lmb_srgb_encode, LANES at a time. Layer 8.
 *
 * A guess of the unrounded code with an error below one half leaves two candidates: the guess rounded down, and the
 * next code. The exact threshold between them decides. */
#include "../base/codec.h"

/* 0 .. 254. The curve is 255 (1.055 x^(1/2.4) - 0.055); a polynomial of degree 4 in sqrt(x) is within 0.19 codes. A
 * root within 2^-11 of it adds at most 0.11. */
LANE_INLINE lanei encode_guess(lane x)
{
    const lane root = lane_root_guess(x);
    lane curve = lane_add(lane_mul(lane_splat(-78.940811f), root), lane_splat(214.911713f));
    curve = lane_add(lane_mul(curve, root), lane_splat(-240.93952f));
    curve = lane_add(lane_mul(curve, root), lane_splat(369.214329f));
    curve = lane_add(lane_mul(curve, root), lane_splat(-9.43618988f));
    curve = lane_pick(lane_lt(x, lane_splat(0.0031308f)), lane_mul(lane_splat(12.92f * 255.0f), x), curve);
    return lanei_min(lane_to_int(curve), lanei_splat(254));
}

/* A NaN counts as 0. */
LANE_INLINE lanei encode_lanes(lane value)
{
    const lane x = lane_min(lane_max(value, lane_splat(0.0f)), lane_splat(1.0f));
    const lanei low = encode_guess(x), high = lanei_add(low, lanei_splat(1));
    return lanei_pick(lane_le(lane_gather_f32(lmb_srgb_threshold, high), x), high, low);
}

#if defined(LANE_PLAIN) && LANES > 1
/* Compilers turn these loops into vectors, except for the thresholds. Same values as encode_lanes. */
NOINLINE void encode_plain(uint8_t code[LMB_TILE_PIXELS], const float value[LMB_TILE_PIXELS], float gain)
{
    /* All in arrays: compilers make branches of a product, or a conversion, of which only one side has need. */
    float x[LMB_TILE_PIXELS], line[LMB_TILE_PIXELS], curve[LMB_TILE_PIXELS];
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        x[k] = minf(maxf(value[k] * gain, 0.0f), 1.0f);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float root = sqrtf(x[k]);
        float v = -78.940811f * root + 214.911713f;
        v = v * root + -240.93952f;
        v = v * root + 369.214329f;
        curve[k] = v * root + -9.43618988f;
        line[k] = 12.92f * 255.0f * x[k];
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        curve[k] = x[k] < 0.0031308f ? line[k] : curve[k];
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t low = mini((int32_t)curve[k], 254);
        code[k] = (uint8_t)(low + (lmb_srgb_threshold[low + 1] <= x[k]));
    }
}

static void KERNEL(encode)(uint32_t out[LMB_TILE_PIXELS], const lmb_radiance *in, float gain)
{
    uint8_t code[3][LMB_TILE_PIXELS];
    for (int c = 0; c < 3; ++c) {
        encode_plain(code[c], in->rgb[c], gain);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out[k] = (uint32_t)code[0][k] | (uint32_t)code[1][k] << 8 | (uint32_t)code[2][k] << 16 | 0xff000000u;
    }
}
#else
static void KERNEL(encode)(uint32_t out[LMB_TILE_PIXELS], const lmb_radiance *in, float gain)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        lanei channel[3];
        for (int c = 0; c < 3; ++c) {
            channel[c] = encode_lanes(lane_mul(lane_load(in->rgb[c] + k), lane_splat(gain)));
        }
        const lanei first = lanei_or(channel[0], lanei_mul(channel[1], lanei_splat(1 << 8)));
        const lanei last = lanei_or(lanei_mul(channel[2], lanei_splat(1 << 16)), lanei_splat(-(1 << 24)));
        lanei_store((int32_t *)out + k, lanei_or(first, last));
    }
}
#endif
