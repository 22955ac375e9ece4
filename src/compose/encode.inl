/* encode.inl: linear values -> sRGB codes, the same as lmb_srgb_encode, LANES at a time.
 *
 * A guess, then the two thresholds around it decide: exact wherever the guess is off by less than one code. Above the
 * curve's straight part it is 255 (-0.0769 + 0.2981 x^(1/4) + 0.8338 x^(1/2) - 0.0553 x), fitted to within 0.092. */
#include "../base/codec.h"

LANE_INLINE lanei encode_guess(lane x)
{
    const lane root = lane_sqrt(x), fourth = lane_sqrt(root);
    lane curve = lane_add(lane_splat(-0.0768973f), lane_mul(lane_splat(0.29807961f), fourth));
    curve = lane_add(curve, lane_mul(lane_splat(0.83378652f), root));
    curve = lane_add(curve, lane_mul(lane_splat(-0.055328384f), x));
    curve = lane_pick(lane_lt(x, lane_splat(0.0031308f)), lane_mul(lane_splat(12.92f), x), curve);
    lanei code = lane_to_int(lane_add(lane_mul(curve, lane_splat(255.0f)), lane_splat(0.5f)));
    return lanei_min(lanei_max(code, lanei_splat(0)), lanei_splat(255));
}

/* A NaN counts as 0. */
LANE_INLINE lanei encode_lanes(lane value)
{
    const lane x = lane_min(lane_max(value, lane_splat(0.0f)), lane_splat(1.0f));
    const lanei code = encode_guess(x), one = lanei_splat(1), next = lanei_min(lanei_add(code, one), lanei_splat(255));
    lane_mask low = lane_lt(x, lane_gather_f32(lmb_srgb_threshold, code));
    lane_mask high = lane_le(lane_gather_f32(lmb_srgb_threshold, next), x);
    return lanei_pick(low, lanei_sub(code, one), lanei_pick(high, next, code));
}

static void KERNEL(encode)(int32_t code[3][LMB_TILE_PIXELS], const lmb_radiance *in, float gain)
{
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
            lanei_store(code[c] + k, encode_lanes(lane_mul(lane_load(in->rgb[c] + k), lane_splat(gain))));
        }
    }
}
