/* gather_cut.inl: a cut of the light tree -> irradiance of the pixels that see its nodes. Layer 6.          [V27 V28]
 *
 * Lanes are pixels.
 *
 * The steps are in gather.inl: include it first. */
static void KERNEL(gather_cut)(lmb_irradiance *inout, float (*memory)[LMB_GATHER_PAIRS], const lmb_tile *tile,
                               const lmb_emitter *emitters, int32_t count)
{
    gather_pairs pairs;
    gather_group block[BLOCK_GROUPS];
    uint64_t none = 0;
    pairs.of = memory;
    for (int32_t i = 0; i < count; i += BLOCK_GROUPS) {
        const int32_t n = count - i < BLOCK_GROUPS ? count - i : BLOCK_GROUPS;
        for (int32_t j = 0; j < n; ++j) {
            const lmb_emitter *e = &emitters[i + j];
            block[j].at = e->position;
            block[j].back = e->back;
            block[j].near2 = 0.0f;
            block[j].area_pi = e->area_pi;
            block[j].number = 0;
            for (int c = 0; c < 3; ++c) {
                block[j].flux[c] = e->flux[c];
            }
        }
        for (int k = 0; k < LMB_TILE_PIXELS; k += BATCH_PIXELS) {
            gather_find(&pairs, &none, tile, k, block, n);
            gather_estimate(&pairs, tile, k, block);
            for (int32_t at = 0; at < n * BATCH_PIXELS; at += LANES) {
                const uint64_t visible = emitters[i + at / BATCH_PIXELS].visible >> (k + at % BATCH_PIXELS);
                const lane_mask sees = mask_of_bits((uint32_t)visible & ALL_LANES);
                lane_store(pairs.of[PAIR_I] + at, lane_keep(sees, lane_load(pairs.of[PAIR_I] + at)));
            }
            gather_sum(inout, k, &pairs, block);
        }
    }
}
