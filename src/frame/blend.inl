/* blend.inl: albedo / pi x (direct + indirect) of a tile's pixels. Layer 8. */

static void KERNEL(blend)(lmb_radiance *out, const lmb_tile *tile, const lmb_irradiance *direct,
                          const lmb_irradiance *indirect)
{
    const lane inverse_pi = lane_splat(0.31830989f), zero = lane_splat(0.0f);
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
            lane e = direct != NULL ? lane_load(direct->rgb[c] + k) : zero;
            if (indirect != NULL) {
                e = lane_add(e, lane_load(indirect->rgb[c] + k));
            }
            lane_store(out->rgb[c] + k, lane_mul(lane_mul(lane_load(tile->albedo[c] + k), inverse_pi), e));
        }
    }
}
