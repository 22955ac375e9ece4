/* many.inl: many lights' nodes: how wrong one would be for a tile, and what it gives its pixels. */

static inline lane3 many_load3(const lmb_many *many, uint32_t plane, uint32_t at)
{
    const float *p = many->plane + plane * many->plane_step + at;
    lane3 r;
    r.x = lane_load(p);
    r.y = lane_load(p + many->plane_step);
    r.z = lane_load(p + 2 * many->plane_step);
    return r;
}

/* A millionth over the plane is in it: with that, and lights of 2^-60 W/sr or more, products stay normal numbers. */
static inline lane many_cosine(lane c) { return lane_keep(lane_lt(lane_splat(0x1p-20f), c), c); }

#define MANY_SOME 0x1p-60f /* what multiplies to less than a normal number is none */

/* Lanes are nodes here: none of them meets another. The upper bound of a node's light is I cos / d^2 with d the boxes'
 * distance and the cosine from the highest that a corner of one box rises over the plane of one of the other. */
static void KERNEL(many_bounds)(float error[16], float light[16], const lmb_many *many, uint32_t first,
                                uint32_t count, const lmb_many_job *job)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), least = lane_splat(1e-12f);
    const lane3 middle = lane3_of(job->middle), half = lane3_of(job->half), n = lane3_of(job->normal);
    const lane bend = lane_splat(job->bend), size2 = lane3_dot(half, half);
    for (uint32_t k = 0; k < count; k += LANES) {
        const uint32_t at = first + k;
        const lane power = lane_load(many->plane + LMB_MANY_POWER * many->plane_step + at);
        const lane3 own = many_load3(many, LMB_MANY_HALF, at), halves = lane3_add(own, half);
        const lane3 between = lane3_sub(many_load3(many, LMB_MANY_MIDDLE, at), middle);
        const lane3 gap = lane3_gap(between, halves);
        const lane gap2 = lane3_dot(gap, gap), d2 = lane_max(gap2, least), own2 = lane3_dot(own, own);
        const lane rise = lane_add(lane3_dot(n, between), lane3_dot(lane3_abs(n), halves));
        const lane cosine = lane_min(lane_add(many_cosine(lane_div(rise, lane_sqrt(d2))), bend), one);
        const lane upper = lane_div(lane_mul(power, cosine), d2);
        const lane3 to = lane3_sub(many_load3(many, LMB_MANY_POSITION, at), middle);
        const lane r2 = lane_max(lane_add(lane3_dot(to, to), size2), least);
        const lane likely = lane_min(lane_add(many_cosine(lane_div(lane3_dot(n, to), lane_sqrt(r2))), bend), one);
        const lane size = lane_min(one, lane_div(own2, d2)), some = lane_splat(MANY_SOME);
        lane wrong = lane_keep(mask_and(lane_lt(some, upper), lane_lt(some, size)), lane_mul(upper, size));
        wrong = lane_pick(lane_lt(gap2, own2), lane_splat(LMB_MANY_NEAR), wrong);
        lane_store(error + k, lane_pick(lane_lt(zero, cosine), wrong, lane_splat(-1.0f)));
        lane_store(light + k, lane_div(lane_mul(power, likely), r2));
    }
}

/* I cos / d^2 from the lights' mean place. Within their spread they are all around: nothing is nearer than that. */
static inline lane many_factor(lane3 at, lane3 n, lane3 face, const lmb_many_lamp *lamp)
{
    const lane zero = lane_splat(0.0f);
    const lane3 to = lane3_sub(lane3_of(lamp->position), at);
    const lane d2 = lane_max(lane3_dot(to, to), lane_splat(1e-12f));
    const lane inverse = lane_div(lane_splat(1.0f), lane_max(d2, lane_splat(lamp->spread)));
    const lane cosine = many_cosine(lane_div(lane3_dot(n, to), lane_sqrt(d2)));
    return lane_keep(lane_lt(zero, lane3_dot(face, to)), lane_mul(inverse, cosine));
}

static void KERNEL(many_shine)(lmb_irradiance *inout, const lmb_tile *tile, uint64_t pixels,
                               const lmb_many_lamp *lamps, int32_t count)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t own = (uint32_t)(pixels >> k) & ((1u << LANES) - 1u);
        const lane3 at = lane3_load(tile->position, k), n = lane3_load(tile->normal, k);
        const lane3 face = lane3_load(tile->face, k);
        const lane_mask is_own = mask_of_bits(own);
        lane3 sum = lane3_splat(0.0f, 0.0f, 0.0f), old;
        if (own == 0) {
            continue;
        }
        for (int32_t i = 0; i < count; ++i) {
            const lmb_many_lamp *lamp = &lamps[i];
            const lane share =
                lane_add(lane_keep(mask_of_bits((uint32_t)(lamp->seen[0] >> k)), lane_splat(lamp->share[0])),
                         lane_keep(mask_of_bits((uint32_t)(lamp->seen[1] >> k)), lane_splat(lamp->share[1])));
            const lane e = lane_mul(many_factor(at, n, face, lamp), share);
            sum.x = lane_add(sum.x, lane_mul(e, lane_splat(lamp->intensity[0])));
            sum.y = lane_add(sum.y, lane_mul(e, lane_splat(lamp->intensity[1])));
            sum.z = lane_add(sum.z, lane_mul(e, lane_splat(lamp->intensity[2])));
        }
        old.x = lane_load(inout->rgb[0] + k);
        old.y = lane_load(inout->rgb[1] + k);
        old.z = lane_load(inout->rgb[2] + k);
        sum = lane3_pick(is_own, lane3_add(old, sum), old);
        lane_store(inout->rgb[0] + k, sum.x);
        lane_store(inout->rgb[1] + k, sum.y);
        lane_store(inout->rgb[2] + k, sum.z);
    }
}
