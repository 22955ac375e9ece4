/* halve.inl: splits the light of 8 x 8 blocks along the line between two halves of a triangle. Layer 7. */
#ifndef LMB_TRANSFER_HALVE_INL
#define LMB_TRANSFER_HALVE_INL

/* Mask of the rows, from the row of block k, in which a vector has a lane set. */
LANE_INLINE uint32_t halve_rows(lane_mask some, int k)
{
    const uint32_t bits = mask_bits(some), over = LANES > LMB_TILE ? bits >> LMB_TILE : 0u;
    const uint32_t first = LANES > LMB_TILE ? bits & 255u : bits;
    return ((first != 0 ? 1u : 0u) | (over != 0 ? 2u : 0u)) << k / LMB_TILE;
}

/* The line's function is 0 on the line, positive on the side of the first half, and changes by 1 over a block. So the
 * first half gets 1/2 plus the function at the block's middle: the exact area for lines parallel to the blocks' sides,
 * close for others. Both parts are whole numbers and add up to the block's light. */
static uint32_t KERNEL(transfer_halve)(float first[LMB_TILE_PIXELS], float light[LMB_TILE_PIXELS], const float line[3],
                                       uint32_t rows)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    uint32_t has[2] = {0, 0};
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        if ((rows >> k / LMB_TILE & (LANES > LMB_TILE ? 3u : 1u)) == 0) {
            continue;
        }
        const lane by_column = lane_mul(lane_splat(line[1]), lane_column(k));
        const lane by_row = lane_mul(lane_splat(line[2]), lane_row(k));
        const lane over = lane_add(lane_add(lane_splat(line[0]), by_column), by_row);
        const lane part = lane_min(lane_max(lane_add(over, lane_splat(0.5f)), zero), one);
        const lane all = lane_load(light + k), a = lane_trunc(lane_mul(all, part)), b = lane_sub(all, a);
        lane_store(first + k, a);
        lane_store(light + k, b);
        has[0] |= halve_rows(lane_lt(zero, a), k);
        has[1] |= halve_rows(lane_lt(zero, b), k);
    }
    return (has[0] & rows) | (has[1] & rows) << LMB_TILE;
}

#endif
