/* links.inl: what arrives by links: sums of what nodes send times weights. Layer 9.
 *
 * Two links at a time; the last of an odd number goes with one of weight 0. Sums of integers: exact in any order. */
#ifndef LMB_TRANSFER_LINKS_INL
#define LMB_TRANSFER_LINKS_INL

static void KERNEL(transfer_links)(int32_t out[3], const uint32_t *link, uint32_t count, uint16_t (*node)[4])
{
    lane_sums sum = sums_zero();
    uint32_t i = 0;
    for (; i + 1 < count; i += 2) {
        const uint32_t a = link[i], b = link[i + 1];
        sum = sums_add(sum, pair_load(node[a & 0xffffu], node[b & 0xffffu]), a >> 16 | (b & 0xffff0000u));
    }
    if (i < count) {
        const uint16_t *last = node[link[i] & 0xffffu];
        sum = sums_add(sum, pair_load(last, last), link[i] >> 16);
    }
    sums_store(out, sum);
}

/* Two links, each of two words, onto the sums along x, y and z. */
LANE_INLINE void links_add_directed(lane_sums sum[3], lane_pair p, uint32_t a, uint32_t a_yz, uint32_t b, uint32_t b_yz)
{
    sum[0] = sums_add(sum[0], p, a >> 16 | (b & 0xffff0000u));
    sum[1] = sums_add(sum[1], p, (a_yz & 0xffffu) | b_yz << 16);
    sum[2] = sums_add(sum[2], p, a_yz >> 16 | (b_yz & 0xffff0000u));
}

static void KERNEL(transfer_directed_links)(int32_t out[3][3], const uint32_t *link, uint32_t count,
                                            uint16_t (*node)[4])
{
    lane_sums sum[3];
    sum[0] = sum[1] = sum[2] = sums_zero();
    uint32_t i = 0;
    for (; i + 1 < count; i += 2, link += 4) {
        const uint32_t a = link[0], b = link[2];
        links_add_directed(sum, pair_load(node[a & 0xffffu], node[b & 0xffffu]), a, link[1], b, link[3]);
    }
    if (i < count) {
        const uint16_t *last = node[link[0] & 0xffffu];
        links_add_directed(sum, pair_load(last, last), link[0], link[1], 0, 0);
    }
    sums_store(out[0], sum[0]);
    sums_store(out[1], sum[1]);
    sums_store(out[2], sum[2]);
}

#endif
