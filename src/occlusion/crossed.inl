/* crossed.inl: which segments from a tile's pixels to a point cross one triangle. Lanes are pixels.           [V25]
 *
 * The edges' planes go through the point, so a segment crosses inside all three where its direction has the same side
 * of each; two triangles' planes through a shared edge are exactly opposite, so there is no gap between them. */
static uint64_t KERNEL(crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_cross_job *job)
{
    const lane3 at = lane3_of(job->at), n = lane3_of(job->normal);
    const lane3 e0 = lane3_of(job->edge[0]), e1 = lane3_of(job->edge[1]), e2 = lane3_of(job->edge[2]);
    const lane zero = lane_splat(0.0f), beyond = lane_splat(job->beyond);
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t asked = (uint32_t)(pixels >> k) & (~0u >> (32 - LANES));
        if (asked != 0) {
            const lane3 d = lane3_sub(lane3_load(tile->position, k), at);
            const lane least = lane_min(lane_min(lane3_dot(e0, d), lane3_dot(e1, d)), lane3_dot(e2, d));
            const lane_mask inside = mask_and(lane_le(zero, least), lane_lt(beyond, lane3_dot(n, d)));
            out |= (uint64_t)(mask_bits(inside) & asked) << k;
        }
    }
    return out;
}
