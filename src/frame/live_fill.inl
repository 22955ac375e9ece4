/* live_fill.inl: light of a cell's pixels, from the samples at its corners. Layer 8.                            [ours]
 *
 * Corners on a pixel's surface count with bilinear weights. Each is extrapolated by half of the slopes, which is exact
 * for quadratics. If a corner is missing, full slopes are used, which is exact for linear light. */

#define FILL_ENOUGH 0.5f /* min share of the bilinear weights of the corners that agree, ... */
#define FILL_NEAR   1.01f  /* ... unless the squared distance to one of them, px2, is below this */

typedef struct corners_sum {
    lane weight, enough, near; /* near: 1 if a corner is */
    lane light[3], low[3], high[3];
} corners_sum;

/* 0 .. 1: how well pixels agree with a sample's surface, like live_agree. */
LANE_INLINE lane corners_agree(const lmb_live_sample *s, const lmb_tile *tile, int k)
{
    lane3 normal, face, d;
    normal.x = lane_load(tile->normal[0] + k);
    normal.y = lane_load(tile->normal[1] + k);
    normal.z = lane_load(tile->normal[2] + k);
    face.x = lane_load(tile->face[0] + k);
    face.y = lane_load(tile->face[1] + k);
    face.z = lane_load(tile->face[2] + k);
    d.x = lane_sub(lane_load(tile->position[0] + k), lane_splat(s->position.x));
    d.y = lane_sub(lane_load(tile->position[1] + k), lane_splat(s->position.y));
    d.z = lane_sub(lane_load(tile->position[2] + k), lane_splat(s->position.z));
    const lane bend = lane_sub(lane_splat(1.0f), lane3_dot(normal, lane3_of(s->normal)));
    const lane lift = lane_max(lane_abs(lane3_dot(face, d)), lane_abs(lane3_dot(lane3_of(s->face), d)));
    const lane max = lane_mul(lane_add(lane_add(bend, bend), lane_splat(LIVE_SAME_LIFT)), lane3_dot(d, d));
    const lane_mask same =
        mask_and(lane_le(bend, lane_splat(1.0f - LIVE_SAME_COS)), lane_le(lane_mul(lift, lift), max));
    const lane part = lane_sub(lane_splat(1.0f), lane_mul(bend, lane_splat(1.0f / (1.0f - LIVE_SAME_COS) * 0.999f)));
    return lane_keep(same, lane_pick(lane_lt(lane_splat(1e-4f), bend), part, lane_splat(1.0f)));
}

/* Adds corner i, with a share `part` of the slopes. */
LANE_INLINE void corners_add(corners_sum *sum, const lmb_live_cell *p, int i, lane agree, lane part, lane x, lane y)
{
    const lmb_live_sample *s = p->corner[i];
    const lane one = lane_splat(1.0f);
    const lane u = lane_mul(lane_sub(x, lane_splat(p->x[0])), lane_splat(p->per_x)),
               v = lane_mul(lane_sub(y, lane_splat(p->y[0])), lane_splat(p->per_y));
    const lane share = lane_mul(i & 1 ? u : lane_sub(one, u), i >> 1 ? v : lane_sub(one, v));
    const lane weight = lane_mul(lane_add(lane_max(share, lane_splat(0.0f)), lane_splat(0.001f)), agree);
    const lane dx = lane_sub(x, lane_splat(p->x[i & 1])), dy = lane_sub(y, lane_splat(p->y[i >> 1]));
    const lane ahead = lane_mul(part, dx), down = lane_mul(part, dy);
    const lane_mask counts = lane_lt(lane_splat(0.0f), agree);
    sum->weight = lane_add(sum->weight, weight);
    sum->enough = lane_add(sum->enough, lane_keep(counts, share));
    sum->near = lane_max(sum->near, lane_keep(mask_and(counts, lane_lt(lane_add(lane_mul(dx, dx), lane_mul(dy, dy)),
                                                                       lane_splat(FILL_NEAR))),
                                              one));
    for (int h = 0; h < 3; ++h) {
        const lane light = lane_splat(s->light[h]);
        const lane on = lane_add(light, lane_add(lane_mul(lane_splat(s->slope[0][h]), ahead),
                                                 lane_mul(lane_splat(s->slope[1][h]), down)));
        sum->light[h] = lane_add(sum->light[h], lane_mul(weight, on));
        sum->low[h] = lane_min(sum->low[h], lane_pick(counts, light, sum->low[h]));
        sum->high[h] = lane_max(sum->high[h], lane_keep(counts, light));
    }
}

/* Sets the corners' agreements. Returns the lanes in which all four agree. */
LANE_INLINE lane_mask corners_agreements(lane agree[4], const lmb_live_cell *p, const lmb_tile *tile, int k)
{
    lane_mask all = lane_lt(lane_splat(0.0f), lane_splat(1.0f));
    for (int i = 0; i < 4; ++i) {
        agree[i] = p->corner[i] != NULL ? corners_agree(p->corner[i], tile, k) : lane_splat(0.0f);
        all = mask_and(all, lane_lt(lane_splat(0.0f), agree[i]));
    }
    return all;
}

/* Lights pixels k, k + 1, ...; returns the mask of those that are explained. */
LANE_INLINE uint32_t corners_light(lmb_irradiance *inout, const lmb_tile *tile, const lmb_live_cell *p, int k,
                                 uint32_t asked)
{
    const lane zero = lane_splat(0.0f), x = lane_column(k), y = lane_row(k);
    corners_sum sum;
    lane agree[4];
    const lane part = lane_pick(corners_agreements(agree, p, tile, k), lane_splat(0.5f), lane_splat(1.0f));
    sum.weight = sum.enough = sum.near = zero;
    for (int h = 0; h < 3; ++h) {
        sum.light[h] = sum.high[h] = zero;
        sum.low[h] = lane_splat(3e38f);
    }
    for (int i = 0; i < 4; ++i) {
        if (p->corner[i] != NULL) {
            corners_add(&sum, p, i, agree[i], part, x, y);
        }
    }
    const lane_mask known = mask_and(mask_of_bits(asked), mask_or(lane_le(lane_splat(FILL_ENOUGH), sum.enough),
                                                                  lane_lt(zero, sum.near)));
    const lane per = lane_div(lane_splat(1.0f), lane_pick(known, sum.weight, lane_splat(1.0f)));
    for (int h = 0; h < 3; ++h) {
        const lane span = lane_mul(lane_splat(0.5f), lane_sub(sum.high[h], sum.low[h]));
        const lane light = lane_hold(lane_mul(sum.light[h], per), lane_max(lane_sub(sum.low[h], span), zero),
                                     lane_add(sum.high[h], span));
        lane_store(inout->rgb[h] + k, lane_pick(known, light, lane_load(inout->rgb[h] + k)));
    }
    return mask_bits(known);
}

/* Smallest and largest light that pixels of an even cell may get. */
static inline void corners_range(float range[3][2], const lmb_live_cell *p)
{
    for (int h = 0; h < 3; ++h) {
        float low = 3e38f, high = 0.0f;
        for (int i = 0; i < 4; ++i) {
            low = minf(low, p->corner[i]->light[h]);
            high = maxf(high, p->corner[i]->light[h]);
        }
        const float span = 0.5f * (high - low);
        range[h][0] = maxf(low - span, 0.0f);
        range[h][1] = high + span;
    }
}

/* Light of a corner, extrapolated by its slopes. */
LANE_INLINE lane corner_on(const lmb_live_sample *s, int h, lane dx, lane dy)
{
    return lane_add(lane_splat(s->light[h]), lane_add(lane_mul(lane_splat(s->slope[0][h]), dx),
                                                      lane_mul(lane_splat(s->slope[1][h]), dy)));
}

/* As corners_light, when all corners agree fully with all pixels. It explains all asked pixels. */
LANE_INLINE void corners_even(lmb_irradiance *inout, const lmb_live_cell *p, int k, uint32_t asked,
                              float range[3][2])
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), half = lane_splat(0.5f);
    const lane x = lane_column(k), y = lane_row(k);
    const lane dx0 = lane_sub(x, lane_splat(p->x[0])), dx1 = lane_sub(x, lane_splat(p->x[1])),
               dy0 = lane_sub(y, lane_splat(p->y[0])), dy1 = lane_sub(y, lane_splat(p->y[1]));
    const lane u = lane_mul(dx0, lane_splat(p->per_x)), v = lane_mul(dy0, lane_splat(p->per_y)),
               left = lane_sub(one, u), above = lane_sub(one, v), min = lane_splat(0.001f);
    const lane w0 = lane_add(lane_max(lane_mul(left, above), zero), min),
               w1 = lane_add(lane_max(lane_mul(u, above), zero), min),
               w2 = lane_add(lane_max(lane_mul(left, v), zero), min),
               w3 = lane_add(lane_max(lane_mul(u, v), zero), min);
    const lane per = lane_div(one, lane_add(lane_add(lane_add(w0, w1), w2), w3));
    const lane hx0 = lane_mul(half, dx0), hx1 = lane_mul(half, dx1), hy0 = lane_mul(half, dy0),
               hy1 = lane_mul(half, dy1);
    for (int h = 0; h < 3; ++h) { /* the corners are unrolled: gcc -O2 keeps the rest of a loop in memory */
        lane light = lane_mul(w0, corner_on(p->corner[0], h, hx0, hy0));
        light = lane_add(light, lane_mul(w1, corner_on(p->corner[1], h, hx1, hy0)));
        light = lane_add(light, lane_mul(w2, corner_on(p->corner[2], h, hx0, hy1)));
        light = lane_add(light, lane_mul(w3, corner_on(p->corner[3], h, hx1, hy1)));
        light = lane_hold(lane_mul(light, per), lane_splat(range[h][0]), lane_splat(range[h][1]));
        lane_store(inout->rgb[h] + k, lane_pick(mask_of_bits(asked), light, lane_load(inout->rgb[h] + k)));
    }
}

static uint64_t KERNEL(live_fill)(lmb_irradiance *inout, const lmb_tile *tile, const lmb_live_cell *p)
{
    uint64_t left = 0;
    float range[3][2];
    if (p->even) {
        corners_range(range, p);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t asked = (uint32_t)(p->pixels >> k) & (~0u >> (32 - LANES));
        if (asked != 0 && p->even) {
            corners_even(inout, p, k, asked, range);
        } else if (asked != 0) {
            left |= (uint64_t)(asked & ~corners_light(inout, tile, p, k, asked)) << k;
        }
    }
    return left;
}
