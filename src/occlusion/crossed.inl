/* crossed.inl: which segments from a tile's pixels to a point cross a triangle, or a box. Layer 4.            [V25]
 *
 * Lanes are pixels.
 *
 * The planes of the edges contain the point, so a segment crosses inside all three if its direction is on the same side
 * of each. The planes of two triangles through a shared edge are exactly opposite, so there is no gap between them. */
static uint64_t KERNEL(crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_cross_job *job)
{
    const lane3 at = lane3_of(job->at), n = lane3_of(job->normal);
    const lane3 e0 = lane3_of(job->edge[0]), e1 = lane3_of(job->edge[1]), e2 = lane3_of(job->edge[2]);
    const lane outer = lane_splat(0.0f - job->slack), beyond = lane_splat(job->beyond);
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t asked = (uint32_t)(pixels >> k) & (~0u >> (32 - LANES));
        if (asked != 0) {
            const lane3 d = lane3_sub(lane3_load(tile->position, k), at);
            const lane min = lane_min(lane_min(lane3_dot(e0, d), lane3_dot(e1, d)), lane3_dot(e2, d));
            const lane_mask inside = mask_and(lane_le(outer, min), lane_lt(beyond, lane3_dot(n, d)));
            out |= (uint64_t)(mask_bits(inside) & asked) << k;
        }
    }
    return out;
}

/* 1 / d, clamped to a finite value. */
static inline lane crossed_per(lane d)
{
    const lane thin = lane_splat(1e-20f), zero = lane_splat(0.0f);
    const lane_mask back = lane_lt(d, zero);
    const lane size = lane_max(lane_pick(back, lane_sub(zero, d), d), thin);
    const lane per = lane_div(lane_splat(1.0f), size);
    return lane_pick(back, lane_sub(zero, per), per);
}

static void KERNEL(segments)(lmb_segments *out, const lmb_tile *tile, lmb_vec3 at)
{
    out->at = at;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane3 d = lane3_sub(lane3_load(tile->position, k), lane3_of(at));
        lane_store(out->per[0] + k, crossed_per(d.x));
        lane_store(out->per[1] + k, crossed_per(d.y));
        lane_store(out->per[2] + k, crossed_per(d.z));
    }
}

/* Parameters along a segment are quotients of differences, each exact to 4 roundings. With this margin no box is
 * missed, at any distance of the point. */
static inline lane_mask crossed_some(lane from, lane to)
{
    return lane_le(from, lane_mul(to, lane_splat(1.0000010f)));
}

static inline void crossed_slab(lane *from, lane *to, lane per, float low, float high)
{
    const lane a = lane_mul(lane_splat(low), per), b = lane_mul(lane_splat(high), per);
    *from = lane_max(*from, lane_min(a, b));
    *to = lane_min(*to, lane_max(a, b));
}

/* Along an axis, a segment at parameter t is at t d with d in [d0, d1]. It may meet [low, high] if t d1 >= low and t d0
 * <= high. Each condition bounds t from below or above, depending on the sign of d1 or d0, which is the same for all
 * boxes. */
static inline void crossed_narrow(lane *from, lane *to, float per, lane side)
{
    const lane t = lane_mul(side, lane_splat(per));
    if (per > 0.0f) {
        *from = lane_max(*from, t);
    } else {
        *to = lane_min(*to, t);
    }
}

static uint32_t KERNEL(meets)(const lmb_pyramid *p, const lmb_boxes *boxes)
{
    uint32_t out = 0;
    for (int i = 0; i < LMB_BOXES; i += LANES) {
        lane from = lane_splat(0.0f), to = lane_splat(1.0f);
        for (int c = 0; c < 3; ++c) {
            const lane at = lane_splat(p->at[c]);
            crossed_narrow(&from, &to, p->per_high[c], lane_sub(lane_load(boxes->low[c] + i), at));
            crossed_narrow(&from, &to, -p->per_low[c], lane_sub(at, lane_load(boxes->high[c] + i)));
        }
        out |= mask_bits(crossed_some(from, to)) << i;
    }
    return out;
}

/* On each axis the segment enters the boxes at one side and leaves at the other. Unrolled by axis, so that all six
 * values stay in registers. */
static uint32_t KERNEL(meets_one)(const lmb_segment *s, const lmb_boxes *boxes)
{
    const float *side = (const float *)(const void *)boxes;
    const lane3 at = lane3_of(s->at), per = lane3_of(s->per);
    const float *x0 = side + s->enter[0], *y0 = side + s->enter[1], *z0 = side + s->enter[2];
    const float *x1 = side + s->leave[0], *y1 = side + s->leave[1], *z1 = side + s->leave[2];
    uint32_t out = 0;
    for (int i = 0; i < LMB_BOXES; i += LANES) {
        const lane ax = lane_mul(lane_sub(lane_load(x0 + i), at.x), per.x);
        const lane ay = lane_mul(lane_sub(lane_load(y0 + i), at.y), per.y);
        const lane az = lane_mul(lane_sub(lane_load(z0 + i), at.z), per.z);
        const lane bx = lane_mul(lane_sub(lane_load(x1 + i), at.x), per.x);
        const lane by = lane_mul(lane_sub(lane_load(y1 + i), at.y), per.y);
        const lane bz = lane_mul(lane_sub(lane_load(z1 + i), at.z), per.z);
        const lane from = lane_max(lane_max(ax, ay), lane_max(az, lane_splat(0.0f)));
        const lane to = lane_min(lane_min(bx, by), lane_min(bz, lane_splat(1.0f)));
        out |= mask_bits(crossed_some(from, to)) << i;
    }
    return out;
}

static uint64_t KERNEL(through)(const lmb_segments *segments, uint64_t pixels, const lmb_boxes *boxes, int i)
{
    const lmb_vec3 low = sub3(vec3(boxes->low[0][i], boxes->low[1][i], boxes->low[2][i]), segments->at);
    const lmb_vec3 high = sub3(vec3(boxes->high[0][i], boxes->high[1][i], boxes->high[2][i]), segments->at);
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t asked = (uint32_t)(pixels >> k) & (~0u >> (32 - LANES));
        if (asked != 0) {
            lane from = lane_splat(0.0f), to = lane_splat(1.0f);
            crossed_slab(&from, &to, lane_load(segments->per[0] + k), low.x, high.x);
            crossed_slab(&from, &to, lane_load(segments->per[1] + k), low.y, high.y);
            crossed_slab(&from, &to, lane_load(segments->per[2] + k), low.z, high.z);
            out |= (uint64_t)(mask_bits(crossed_some(from, to)) & asked) << k;
        }
    }
    return out;
}
