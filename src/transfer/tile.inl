/* tile.inl: the pixels of a tile that lie on a triangle, and their light from one leaf. Layer 7. */
#ifndef LMB_TRANSFER_TILE_INL
#define LMB_TRANSFER_TILE_INL

#define WEIGHT_FLOOR 1e-12f /* smaller weights become 0, so that their products are not denormal */

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

/* Weight of a leaf's corner at pixels of the triangle. */
LANE_INLINE lane leaf_weight(const lmb_transfer_leaf *leaf, int corner, lane b1, lane b2)
{
    const float *by = leaf->weight[corner];
    return lane_add(lane_add(lane_splat(by[0]), lane_mul(lane_splat(by[1]), b1)), lane_mul(lane_splat(by[2]), b2));
}

/* Interpolates number c of the corners. */
LANE_INLINE lane leaf_mix(const lmb_transfer_leaf *leaf, const lane w[3], int c)
{
    return lane_add(lane_add(lane_mul(lane_splat(leaf->corner[0][c]), w[0]),
                             lane_mul(lane_splat(leaf->corner[1][c]), w[1])),
                    lane_mul(lane_splat(leaf->corner[2][c]), w[2]));
}

/* Channel c of the light along x, y and z. If the corners have no direction, light arrives along the face normal. */
LANE_INLINE lane3 leaf_arrives(const lmb_transfer_leaf *leaf, const lane w[3], int c, lane3 face)
{
    lane3 v;
    if (!leaf->is_directed) {
        return lane3_scale(face, leaf_mix(leaf, w, c));
    }
    v.x = leaf_mix(leaf, w, 3 * c);
    v.y = leaf_mix(leaf, w, 3 * c + 1);
    v.z = leaf_mix(leaf, w, 3 * c + 2);
    return v;
}

/* Light that arrives along the pixel's normal. Directional light counts as if none came from behind the normal. Half of
 * the loss that a tilted normal causes under uniform light above the face is added. */
LANE_INLINE lane leaf_light(const lmb_transfer_leaf *leaf, const lmb_tile *tile, int k, const lane w[3], int c)
{
    if (!leaf->is_directed) {
        return leaf_mix(leaf, w, c);
    }
    const lane3 n = lane3_load(tile->normal, k), face = lane3_load(tile->face, k);
    const lane3 v = leaf_arrives(leaf, w, c, face);
    const lane turned = lane_mul(lane_splat(0.5f), lane_sub(lane_splat(1.0f), lane3_dot(n, face)));
    return lane_add(lane3_dot(v, n), lane_mul(turned, lane3_dot(v, face)));
}

#if LMB_LOBES
#define ARRIVES_WIDE 1.0f /* sr, solid angle of reflected light: the value from 0.5 to 3 with the least error */

/* Adds the light that the pixels' lobes reflect: all of it as a disc in the mean direction. */
LANE_INLINE void leaf_lobes(lmb_glossy *inout, const lmb_tile *tile, int k, uint32_t own, const lmb_transfer_leaf *leaf,
                            const lane w[3])
{
    const lobe_pixels p = lobe_load(inout, tile, k);
    const lane3 face = lane3_load(tile->face, k);
    const lane zero = lane_splat(0.0f);
    lane3 all = lane3_splat(0.0f, 0.0f, 0.0f), e, sum = lobe_sum(inout, k);
    for (int c = 0; c < 3; ++c) {
        all = lane3_add(all, leaf_arrives(leaf, w, c, face));
    }
    const lane length2 = lane_max(lane3_dot(all, all), lane_splat(1e-24f));
    const lane3 to = lane3_scale(all, lane_sqrt(lane_div(lane_splat(1.0f), length2)));
    e.x = lane_max(leaf_light(leaf, tile, k, w, 0), zero);
    e.y = lane_max(leaf_light(leaf, tile, k, w, 1), zero);
    e.z = lane_max(leaf_light(leaf, tile, k, w, 2), zero);
    lobe_store(inout, k, lane3_pick(mask_of_bits(own), lobe_add(sum, &p, to, lane_splat(ARRIVES_WIDE), e), sum));
}
#endif

static uint64_t KERNEL(transfer_leaf)(lmb_irradiance *inout, lmb_glossy *glossy, float weight[2][LMB_TILE_PIXELS],
                                      const lmb_tile *tile, uint64_t left, const lmb_transfer_leaf *leaf)
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
#if LMB_LOBES
        if (glossy != NULL && ((uint32_t)(glossy->pixels >> k) & own) != 0) {
            leaf_lobes(glossy, tile, k, (uint32_t)(glossy->pixels >> k) & own, leaf, w);
        }
#endif
    }
    (void)glossy;
    return out;
}

#endif
