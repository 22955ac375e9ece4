/* coverage.inl: divides the cells of a shadow map block among triangles. Layer 7. */
#ifndef LMB_TRANSFER_COVERAGE_INL
#define LMB_TRANSFER_COVERAGE_INL

static const float share_column[LMB_TRANSFER_BLOCK_CELLS] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
static const float share_row[LMB_TRANSFER_BLOCK_CELLS] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

#define SHARE_REACH 0.01f  /* weight of a triangle near a cell that no outline covers */
#define SHARE_LEAST 1e-12f /* keeps products from being denormal */

LANE_INLINE lane share_value(const float f[3], lane x, lane y)
{
    return lane_add(lane_add(lane_splat(f[0]), lane_mul(lane_splat(f[1]), x)), lane_mul(lane_splat(f[2]), y));
}

LANE_INLINE lane share_clamp(lane v) { return lane_min(lane_max(v, lane_splat(0.0f)), lane_splat(1.0f)); }

/* The part of a cell inside two edges that keep `a` and `b` of it. Perpendicular edges keep a b; opposite or equal
 * edges keep max(a + b - 1, 0) or min(a, b). Other angles mix both by the cosine. */
LANE_INLINE lane share_both(lane a, lane b, float cosine)
{
    const lane one = lane_splat(1.0f), zero = lane_splat(0.0f);
    const lane alike = cosine < 0.0f ? lane_max(lane_sub(lane_add(a, b), one), zero) : lane_min(a, b);
    const float by = cosine < 0.0f ? -cosine : cosine;
    return lane_add(lane_mul(lane_splat(1.0f - by), lane_mul(a, b)), lane_mul(lane_splat(by), alike));
}

/* The part of a cell inside a triangle's outline, and how close the outline comes. */
LANE_INLINE void share_cover(lane *cover, lane *reach, const lmb_transfer_shown *s, lane x, lane y)
{
    lane in[3], part[3];
    for (int k = 0; k < 3; ++k) {
        in[k] = lane_mul(share_value(s->corner[k], x, y), lane_splat(s->per[k]));
        part[k] = share_clamp(lane_add(in[k], lane_splat(0.5f)));
    }
    *cover = share_both(share_both(part[0], part[1], s->cosine[2]), part[2],
                        s->cosine[0] < s->cosine[1] ? s->cosine[0] : s->cosine[1]);
    *reach = share_clamp(lane_add(lane_min(in[0], lane_min(in[1], in[2])), lane_splat(1.0f)));
}

/* The part of a cell in which a is nearer than b. */
LANE_INLINE lane share_nearer(const lmb_transfer_shown *a, const lmb_transfer_shown *b, lane x, lane y)
{
    float gap[3];
    for (int k = 0; k < 3; ++k) {
        gap[k] = a->near[k] - b->near[k];
    }
    const float by = absf(gap[1]) + absf(gap[2]);
    const lane over = lane_div(share_value(gap, x, y), lane_splat(by > 1e-30f ? by : 1e-30f));
    return share_clamp(lane_add(over, lane_splat(0.5f)));
}

LANE_INLINE lane share_less(lane part, lane covered)
{
    return lane_max(lane_mul(part, lane_sub(lane_splat(1.0f), covered)), lane_splat(SHARE_LEAST));
}

/* Each triangle gets the cell area that it covers minus the coverage of nearer triangles; the shares of a cell add up
 * to 1. Cells k, k + 1, .. of a block. */
LANE_INLINE void share_cells(float out[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS],
                             const lmb_transfer_shown *shown, int32_t count, const float at[2], int k)
{
    const lane one = lane_splat(1.0f);
    const lane x = lane_add(lane_splat(at[0]), lane_load(share_column + k));
    const lane y = lane_add(lane_splat(at[1]), lane_load(share_row + k));
    lane cover[LMB_TRANSFER_SHARING], part[LMB_TRANSFER_SHARING];
    lane all = lane_splat(0.0f);
    for (int32_t i = 0; i < count; ++i) {
        lane reach = one;
        cover[i] = one;
        if (shown[i].id != 0) {
            share_cover(&cover[i], &reach, &shown[i], x, y);
        }
        part[i] = cover[i];
        lane_store(out[i] + k, reach); /* stored here: a third array of 512-bit lanes exceeds the stack budget */
    }
    for (int32_t i = 0; i < count; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            const lane nearer = shown[i].id == 0   ? lane_splat(0.0f)
                                : shown[j].id == 0 ? one
                                                   : share_nearer(&shown[i], &shown[j], x, y);
            part[j] = share_less(part[j], lane_mul(nearer, cover[i]));
            part[i] = share_less(part[i], lane_mul(lane_sub(one, nearer), cover[j]));
        }
    }
    for (int32_t i = 0; i < count; ++i) {
        part[i] = lane_add(part[i], lane_mul(lane_load(out[i] + k), lane_splat(SHARE_REACH)));
        all = lane_add(all, part[i]);
    }
    for (int32_t i = 0; i < count; ++i) {
        lane_store(out[i] + k, lane_div(part[i], all));
    }
}

/* For the first `cells` columns and rows. */
static void KERNEL(transfer_share)(float out[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS],
                                   const lmb_transfer_shown *shown, int32_t count, const float at[2], int32_t cells)
{
    for (int k = 0; k < LMB_TRANSFER_CELLS * cells; k += LANES) {
        if (k % LMB_TRANSFER_CELLS < cells) {
            share_cells(out, shown, count, at, k);
        }
    }
}

#endif
