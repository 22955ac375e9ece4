/* links.inl: light that arrives through links: sums of node light times weights. Layer 7.
 *
 * Four links at a time; the rest are padded with a weight of 0. The sums are of integers, so they are exact in any
 * order. */
#ifndef LMB_TRANSFER_LINKS_INL
#define LMB_TRANSFER_LINKS_INL

/* The links of all receivers are contiguous: megabytes, each read once per frame. */
#define LINKS_AHEAD 512
#if defined(__GNUC__)
#define LINKS_SOON(p) __builtin_prefetch(p)
#else
#define LINKS_SOON(p) ((void)0)
#endif

static void KERNEL(transfer_links)(int32_t out[3], const uint32_t *link, uint32_t count, uint16_t (*node)[4])
{
    lane_sums sum = sums_zero();
    uint32_t i = 0;
    for (; i + 4 <= count; i += 4) {
        LINKS_SOON(link + i + LINKS_AHEAD);
        sum = sums_add_links(sum, node, link + i);
    }
    for (; i < count; ++i) {
        const uint16_t *one = node[link[i] & 0xffffu];
        sum = sums_add(sum, pair_load(one, one), link[i] >> 16);
    }
    sums_store(out, sum);
}

static void KERNEL(transfer_directed_links)(int32_t out[3][3], const uint32_t *link, uint32_t count,
                                            uint16_t (*node)[4])
{
    lane_sums sum[3];
    sum[0] = sum[1] = sum[2] = sums_zero();
    uint32_t i = 0;
    for (; i + 4 <= count; i += 4) {
        LINKS_SOON(link + 2 * (size_t)i + LINKS_AHEAD);
        sums_add_directed(sum, node, link + 2 * (size_t)i);
    }
    for (; i < count; ++i) {
        const uint32_t a = link[2 * (size_t)i], yz = link[2 * (size_t)i + 1];
        const lane_pair one = pair_load(node[a & 0xffffu], node[a & 0xffffu]);
        sum[0] = sums_add(sum[0], one, a >> 16);
        sum[1] = sums_add(sum[1], one, yz & 0xffffu);
        sum[2] = sums_add(sum[2], one, yz >> 16);
    }
    for (int k = 0; k < 3; ++k) {
        sums_store(out[k], sum[k]);
    }
}

#endif
