/* tile.inl: a tile's pixels on a triangle, and their light on one of its leaves. Layer 9. */
#ifndef LMB_TRANSFER_TILE_INL
#define LMB_TRANSFER_TILE_INL

#define WEIGHT_FLOOR 1e-12f /* weights below it are 0, so that no product of theirs is denormal */

LANE_INLINE lane tile_weight(lane3 to, lmb_vec3 along, lane limit)
{
    const lane w = lane_min(lane_max(lane3_dot(lane3_of(along), to), lane_splat(0.0f)), limit);
    return lane_keep(lane_lt(lane_splat(WEIGHT_FLOOR), w), w);
}

static uint64_t KERNEL(transfer_side)(float weight[2][LMB_TILE_PIXELS], const lmb_tile *tile, uint64_t left,
                                      const lmb_transfer_triangle *triangle)
{
    const int first = lowest_bit_64(left);
    const lane3 face = lane3_of(tile_vec(tile->face, first));
    const lanei id = lanei_splat((int32_t)tile->id[first]);
    uint64_t out = (uint64_t)1 << first;
    for (int k = first / LANES * LANES; k < LMB_TILE_PIXELS; k += LANES) {
        lane_mask own = mask_and(mask_of_bits((uint32_t)(left >> k) & ALL_LANES),
                                 lanei_equal(lanei_load((const int32_t *)tile->id + k), id));
        if (mask_bits(own) == 0) {
            continue;
        }
        own = mask_and(own, lane_lt(lane_splat(0.0f), lane3_dot(lane3_load(tile->face, k), face)));
        out |= (uint64_t)mask_bits(own) << k;
        const lane3 to = lane3_sub(lane3_load(tile->position, k), lane3_of(triangle->corner));
        const lane one = lane_splat(1.0f), b1 = tile_weight(to, triangle->along[0], one);
        lane_store(weight[0] + k, b1);
        lane_store(weight[1] + k, tile_weight(to, triangle->along[1], lane_sub(one, b1)));
    }
    return out;
}

/* The weight of a leaf's corner at pixels of the triangle. */
LANE_INLINE lane leaf_weight(const lmb_transfer_leaf *leaf, int corner, lane b1, lane b2)
{
    const float(*by)[3] = leaf->weight;
    return lane_add(lane_add(lane_splat(by[0][corner]), lane_mul(lane_splat(by[1][corner]), b1)),
                    lane_mul(lane_splat(by[2][corner]), b2));
}

/* Number c of each corner, by their weights. */
LANE_INLINE lane leaf_mix(const lmb_transfer_leaf *leaf, const lane w[3], int c)
{
    return lane_add(lane_add(lane_mul(lane_splat(leaf->corner[0][c]), w[0]),
                             lane_mul(lane_splat(leaf->corner[1][c]), w[1])),
                    lane_mul(lane_splat(leaf->corner[2][c]), w[2]));
}

/* Of a mesh what arrives along the pixel's normal; else the corners lie on its plane. */
LANE_INLINE lane leaf_light(const lmb_transfer_leaf *leaf, const lmb_tile *tile, int k, const lane w[3], int c)
{
    lane3 by_axis;
    if (!leaf->is_mesh) {
        return leaf_mix(leaf, w, c);
    }
    by_axis.x = leaf_mix(leaf, w, 3 * c);
    by_axis.y = leaf_mix(leaf, w, 3 * c + 1);
    by_axis.z = leaf_mix(leaf, w, 3 * c + 2);
    return lane3_dot(by_axis, lane3_load(tile->normal, k));
}

static uint64_t KERNEL(transfer_leaf)(lmb_irradiance *inout, float weight[2][LMB_TILE_PIXELS], const lmb_tile *tile,
                                      uint64_t left, const lmb_transfer_leaf *leaf)
{
    const int first = lowest_bit_64(left);
    uint64_t out = (uint64_t)1 << first;
    for (int k = first / LANES * LANES; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t mine = (uint32_t)(left >> k) & ALL_LANES;
        if (mine == 0) {
            continue;
        }
        const lane b1 = lane_load(weight[0] + k), b2 = lane_load(weight[1] + k), zero = lane_splat(0.0f);
        const lane w[3] = {leaf_weight(leaf, 0, b1, b2), leaf_weight(leaf, 1, b1, b2), leaf_weight(leaf, 2, b1, b2)};
        const uint32_t on = mask_bits(lane_le(zero, lane_min(lane_min(w[0], w[1]), w[2])));
        const uint32_t own = (on | (uint32_t)(out >> k)) & mine;
        if (own == 0) {
            continue;
        }
        out |= (uint64_t)own << k;
        for (int c = 0; c < 3; ++c) {
            const lane e = lane_max(leaf_light(leaf, tile, k, w, c), zero);
            lane_store(inout->rgb[c] + k, lane_add(lane_load(inout->rgb[c] + k), lane_keep(mask_of_bits(own), e)));
        }
    }
    return out;
}

#endif
