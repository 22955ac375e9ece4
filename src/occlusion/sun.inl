/* sun.inl: which pixels' rays to a point at infinity cross a triangle, or boxes. Layer 4.                        [V25]
 *
 * Lanes are pixels, then boxes.
 *
 * The planes of the edges are parallel to the rays: the limit of crossed.inl for a distant point. */
static uint64_t KERNEL(sun_crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_sun_job *job)
{
    const lane3 at = lane3_of(job->at), n = lane3_of(job->normal);
    const lane3 e0 = lane3_of(job->edge[0]), e1 = lane3_of(job->edge[1]), e2 = lane3_of(job->edge[2]);
    const lane o0 = lane_splat(job->offset[0]), o1 = lane_splat(job->offset[1]), o2 = lane_splat(job->offset[2]);
    const lane zero = lane_splat(0.0f), beyond = lane_splat(job->beyond);
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t asked = (uint32_t)(pixels >> k) & (~0u >> (32 - LANES));
        if (asked != 0) {
            const lane3 d = lane3_sub(lane3_load(tile->position, k), at);
            const lane v0 = lane_add(lane3_dot(e0, d), o0), v1 = lane_add(lane3_dot(e1, d), o1);
            const lane min = lane_min(lane_min(v0, v1), lane_add(lane3_dot(e2, d), o2));
            const lane_mask inside = mask_and(lane_le(zero, min), lane_lt(beyond, lane3_dot(n, d)));
            out |= (uint64_t)(mask_bits(inside) & asked) << k;
        }
    }
    return out;
}

/* At share t the pixels' box is low + t d .. high + t d. It meets another box from the time the fronts touch until the
 * backs separate. Each time is wrong by about 2^-23 of itself. */
static uint32_t KERNEL(sun_meets)(const lmb_sun_sweep *s, const lmb_boxes *boxes)
{
    uint32_t out = 0;
    for (int i = 0; i < LMB_BOXES; i += LANES) {
        lane from = lane_splat(0.0f), to = lane_splat(3e38f);
        for (int c = 0; c < 3; ++c) {
            const lane per = lane_splat(s->per[c]);
            const lane a = lane_mul(lane_sub(lane_load(boxes->low[c] + i), lane_splat(s->high[c])), per);
            const lane b = lane_mul(lane_sub(lane_load(boxes->high[c] + i), lane_splat(s->low[c])), per);
            from = lane_max(from, s->per[c] > 0.0f ? a : b);
            to = lane_min(to, s->per[c] > 0.0f ? b : a);
        }
        out |= mask_bits(lane_le(lane_mul(from, lane_splat(1.0f - 0x1p-20f)), to)) << i;
    }
    return out;
}
