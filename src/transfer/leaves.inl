/* leaves.inl: the leaves of a triangle's halvings that texels of a shadow map show. Layer 9. */
#ifndef LMB_TRANSFER_LEAVES_INL
#define LMB_TRANSFER_LEAVES_INL

typedef struct leaves_at {
    lane w[3];  /* weights of the corners */
    lanei word; /* of the halving there */
} leaves_at;

/* b = to + (from + by sx) d / (n + n_by sx), at least 0 and at limit `limit`. Too small a weight is none, so that its
 * halves are no denormals. */
LANE_INLINE lane leaves_weight(const lmb_texel_run *run, int i, lane sx, lane t, lane limit)
{
    const lane along = lane_add(lane_splat(run->from[i]), lane_mul(lane_splat(run->by[i]), sx));
    const lane w = lane_min(lane_max(lane_add(lane_splat(run->to[i]), lane_mul(along, t)), lane_splat(0.0f)), limit);
    return lane_keep(lane_lt(lane_splat(1e-12f), w), w);
}

/* The half of each lane that holds its weights, as enter_half finds it. Where there is no half weights mean nothing. */
LANE_INLINE lanei leaves_half(leaves_at *at)
{
    const lanei from = lanei_and(lanei_shift(at->word, LMB_TRANSFER_EDGE_BIT), lanei_splat(3));
    const lane_mask is_0 = lanei_equal(from, lanei_splat(0)), is_1 = lanei_equal(from, lanei_splat(1));
    const lane a = lane_pick(is_0, at->w[0], lane_pick(is_1, at->w[1], at->w[2]));
    const lane b = lane_pick(is_0, at->w[1], lane_pick(is_1, at->w[2], at->w[0]));
    const lane_mask second = lane_lt(a, b);
    const lane keeps = lane_abs(lane_sub(a, b)), less = lane_pick(second, a, b), moves = lane_add(less, less);
    const lane new_a = lane_pick(second, moves, keeps), new_b = lane_pick(second, keeps, moves);
    at->w[0] = lane_pick(is_0, new_a, lane_pick(is_1, at->w[0], new_b));
    at->w[1] = lane_pick(is_0, new_b, lane_pick(is_1, new_a, at->w[1]));
    at->w[2] = lane_pick(is_0, at->w[2], lane_pick(is_1, new_b, new_a));
    const lanei first = lanei_and(at->word, lanei_splat((1 << LMB_TRANSFER_EDGE_BIT) - 1));
    return lanei_add(first, lanei_pick(second, lanei_splat(1), lanei_splat(0)));
}

/* All lanes go down together until each is at a leaf. */
LANE_INLINE lanei leaves_find(leaves_at at, const int32_t *node)
{
    lane_mask inner = lanei_not_negative(at.word);
    for (int i = 0; i < LMB_TRANSFER_MAX_HALVINGS && mask_bits(inner) != 0; ++i) {
        const lanei half = lanei_gather_i32(node, lanei_pick(inner, leaves_half(&at), lanei_splat(0)));
        at.word = lanei_pick(inner, half, at.word);
        inner = lanei_not_negative(at.word);
    }
    const lanei leaf = lanei_and(at.word, lanei_splat((int32_t)~LMB_TRANSFER_LEAF));
    return lanei_pick(inner, lanei_splat(-1), leaf);
}

static void KERNEL(texel_leaves)(uint32_t *out, const float *sx, int32_t count, const lmb_texel_run *run)
{
    const int32_t *node = (const int32_t *)run->node;
    for (int32_t i = 0; i < count; i += LANES) {
        const lane x = lane_load(sx + i), one = lane_splat(1.0f);
        const lane t =
            lane_div(lane_splat(run->d), lane_add(lane_splat(run->n), lane_mul(lane_splat(run->n_by), x)));
        leaves_at at;
        at.w[1] = leaves_weight(run, 0, x, t, one);
        at.w[2] = leaves_weight(run, 1, x, t, lane_sub(one, at.w[1]));
        at.w[0] = lane_sub(lane_sub(one, at.w[1]), at.w[2]);
        at.word = lanei_splat(node[run->root]);
        lanei_store((int32_t *)out + i, leaves_find(at, node));
    }
}

#endif
