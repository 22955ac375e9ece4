/* many_lights.inl: error of a node of many lights for a tile, and its irradiance at the pixels. Layer 6. */

static inline lane3 many_load3(const lmb_many_lights *many_lights, uint32_t plane, uint32_t at)
{
    const float *p = many_lights->plane + plane * many_lights->plane_step + at;
    lane3 r;
    r.x = lane_load(p);
    r.y = lane_load(p + many_lights->plane_step);
    r.z = lane_load(p + 2 * many_lights->plane_step);
    return r;
}

/* Cosines under a millionth count as 0. Since lights have at least 2^-60 W/sr, products are then never denormal. */
static inline lane many_cosine(lane c) { return lane_keep(lane_lt(lane_splat(0x1p-20f), c), c); }

#define MANY_SOME 0x1p-60f /* factors with a product below normal numbers count as 0 */

/* Cosine of the sum of two angles, each given as cosine and sine; -1 if the sum exceeds half a turn. */
static inline lane many_sum_cosine(lane c1, lane s1, lane c2, lane s2)
{
    const lane turned = lane_add(lane_mul(s1, c2), lane_mul(c1, s2));
    return lane_pick(lane_lt(lane_splat(0.0f), turned), lane_sub(lane_mul(c1, c2), lane_mul(s1, s2)),
                     lane_splat(-1.0f));
}

/* The share of spots' light that can reach the pixels: 0 if no cone reaches them, else the ratio of the widest cone's
 * solid angle to that of all cones together, as seen with the sizes of both boxes. */
static inline lane many_cone_share(const lmb_many_lights *many_lights, uint32_t at, lane3 between, lane3 halves)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), some = lane_splat(1e-4f);
    const float *plane = many_lights->plane + at;
    const lane d2 = lane_max(lane3_dot(between, between), lane_splat(1e-12f));
    const lane size2 = lane_min(lane_div(lane3_dot(halves, halves), d2), one);
    const lane sine = lane_sqrt(size2), cosine = lane_sqrt(lane_sub(one, size2));
    const lane wide = many_sum_cosine(lane_load(plane + LMB_MANY_LIGHTS_COSINE * many_lights->plane_step),
                                      lane_load(plane + LMB_MANY_LIGHTS_SINE * many_lights->plane_step), cosine, sine);
    /* `between` points from the pixels to the lights */
    const lane along = lane_div(lane_sub(zero, lane3_dot(many_load3(many_lights, LMB_MANY_LIGHTS_AXIS, at), between)),
                                lane_sqrt(d2));
    const lane own = lane_sub(one, lane_load(plane + LMB_MANY_LIGHTS_OUTER * many_lights->plane_step));
    const lane share = lane_min(one, lane_div(own, lane_max(lane_sub(one, wide), lane_splat(1e-6f))));
    const lane reach = lane_pick(lane_lt(size2, one), lane_sub(wide, some), lane_splat(-2.0f));
    return lane_keep(lane_lt(reach, along), lane_max(share, lane_splat(0x1p-20f)));
}

/* The sum of bounds may be SUM_OF_BOUNDS times the allowed error, because positions err by far less than their bounds.
 * Ranges do not, because two of them represent all. */
#define MANY_RANGES 16.0f

/* Bounds of the factor by which ranges reduce a node's light, if any light of the tree has a range. Returns the upper
 * bound, from the boxes' distance and the greatest range. *min_left is the lower bound, from the boxes' farthest points
 * and the least range. The factors of all of the node's lights at all pixels lie between these bounds, and so do those
 * of the lights that represent them. */
static inline lane many_range_share(lane *min_left, const lmb_many_lights *many_lights, uint32_t at, lane gap2,
                                    lane3 between, lane3 halves)
{
    const float *plane = many_lights->plane + LMB_MANY_LIGHTS_RANGE * many_lights->plane_step + at;
    const lane3 far = lane3_add(lane3_abs(between), halves);
    *min_left = direct_within(lane3_dot(far, far), lane_max(lane_load(plane), lane_splat(0x1p-80f)));
    return direct_within(gap2, lane_max(lane_load(plane + many_lights->plane_step), lane_splat(0x1p-80f)));
}

/* Lanes are nodes here and do not interact. The upper bound of a node's light is I cos / d^2: d is the distance of the
 * boxes, and the cosine comes from the highest rise of a corner of one box over the plane of a corner of the other. */
static void KERNEL(many_places)(float error[16], float light[16], float inside[16], const lmb_many_lights *many_lights,
                                uint32_t first, uint32_t count, const lmb_many_lights_job *job, int have_cones)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), min = lane_splat(1e-24f);
    const lane3 middle = lane3_of(job->middle), half = lane3_of(job->half), n = lane3_of(job->normal);
    const lane bend = lane_splat(job->bend), size2 = lane3_dot(half, half);
    for (uint32_t k = 0; k < count; k += LANES) {
        const uint32_t at = first + k;
        const lane power = lane_load(many_lights->plane + LMB_MANY_LIGHTS_POWER * many_lights->plane_step + at);
        const lane3 own = many_load3(many_lights, LMB_MANY_LIGHTS_HALF, at), halves = lane3_add(own, half);
        const lane3 between = lane3_sub(many_load3(many_lights, LMB_MANY_LIGHTS_MIDDLE, at), middle);
        const lane3 gap = lane3_gap(between, halves);
        const lane gap2 = lane3_dot(gap, gap), d2 = lane_max(gap2, min), own2 = lane3_dot(own, own);
        const lane rise = lane_add(lane3_dot(n, between), lane3_dot(lane3_abs(n), halves));
        const lane cosine = lane_min(lane_add(many_cosine(lane_div(rise, lane_sqrt(d2))), bend), one);
        lane min_left = one, max_left = one; /* bounds of the factor of ranges */
        if (many_lights->ranged > 0) {
            max_left = many_range_share(&min_left, many_lights, at, gap2, between, halves);
        }
        const lane upper = lane_div(lane_mul(power, cosine), d2);
        const lane3 to = lane3_sub(many_load3(many_lights, LMB_MANY_LIGHTS_POSITION, at), middle);
        const lane r2 = lane_max(lane_add(lane3_dot(to, to), size2), min);
        const lane likely = lane_min(lane_add(many_cosine(lane_div(lane3_dot(n, to), lane_sqrt(r2))), bend), one);
        const lane some = lane_splat(MANY_SOME);
        lane size = lane_min(one, lane_div(own2, d2));
        if (many_lights->ranged > 0) {
            size = lane_add(size, lane_mul(lane_splat(MANY_RANGES), lane_sub(max_left, min_left)));
        }
        lane wrong = lane_keep(mask_and(lane_lt(some, upper), lane_lt(some, size)), lane_mul(upper, size));
        wrong = lane_pick(lane_lt(gap2, own2), lane_splat(LMB_MANY_LIGHTS_NEAR), wrong);
        lane about = lane_div(lane_mul(power, likely), r2);
        if (many_lights->ranged > 0) {
            const lane left = lane_mul(lane_splat(0.5f), lane_add(max_left, min_left));
            about = lane_keep(lane_lt(some, about), lane_mul(about, left));
        }
        const lane share = have_cones ? many_cone_share(many_lights, at, between, halves) : one;
        const lane_mask reaches =
            mask_and(lane_lt(zero, cosine), mask_and(lane_lt(zero, share), lane_lt(zero, max_left)));
        lane_store(error + k, lane_pick(reaches, wrong, lane_splat(-1.0f)));
        lane_store(light + k, have_cones ? lane_keep(lane_lt(some, about), lane_mul(about, share)) : about);
        lane_store(inside + k, about);
    }
}

/* The same for lights at infinity, computed at a distance of a metre, wherever the pixels are. */
static void KERNEL(many_suns)(float error[16], float light[16], float inside[16], const lmb_many_lights *many_lights,
                              uint32_t first, uint32_t count, const lmb_many_lights_job *job)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), some = lane_splat(MANY_SOME);
    const lane3 n = lane3_of(job->normal);
    const lane bend = lane_splat(job->bend);
    for (uint32_t k = 0; k < count; k += LANES) {
        const uint32_t at = first + k;
        const lane power = lane_load(many_lights->plane + LMB_MANY_LIGHTS_POWER * many_lights->plane_step + at);
        const lane3 own = many_load3(many_lights, LMB_MANY_LIGHTS_HALF, at);
        const lane rise =
            lane_add(lane3_dot(n, many_load3(many_lights, LMB_MANY_LIGHTS_MIDDLE, at)), lane3_dot(lane3_abs(n), own));
        const lane cosine = lane_min(lane_add(many_cosine(rise), bend), one);
        const lane upper = lane_mul(power, cosine), size = lane3_dot(own, own);
        const lane likely =
            lane_add(many_cosine(lane3_dot(n, many_load3(many_lights, LMB_MANY_LIGHTS_POSITION, at))), bend);
        const lane about = lane_mul(power, lane_min(likely, one));
        lane wrong = lane_keep(mask_and(lane_lt(some, upper), lane_lt(some, size)), lane_mul(upper, size));
        wrong = lane_pick(lane_lt(one, size), lane_splat(LMB_MANY_LIGHTS_NEAR), wrong);
        lane_store(error + k, lane_pick(lane_lt(zero, cosine), wrong, lane_splat(-1.0f)));
        lane_store(light + k, about);
        lane_store(inside + k, about);
    }
}

static void KERNEL(many_lights_bounds)(float error[16], float light[16], float inside[16],
                                       const lmb_many_lights *many_lights, uint32_t first, uint32_t count,
                                       const lmb_many_lights_job *job)
{
    const uint32_t kind = many_lights->node[first].kind;
    const int coned = light_kind_is((int32_t)kind, LIGHT_CONED);
    if (light_kind_is((int32_t)kind, LIGHT_FAR)) {
        KERNEL(many_suns)(error, light, inside, many_lights, first, count, job);
    } else {
        KERNEL(many_places)(error, light, inside, many_lights, first, count, job, coned);
    }
}

/* I cos / d^2 from the lights' mean position. Distances are at least the lights' spread, because within it they lie on
 * all sides. */
static inline lane many_factor(lane3 at, lane3 n, lane3 face, const lmb_active_light *active)
{
    const lane zero = lane_splat(0.0f);
    const lane3 to = lane3_sub(lane3_of(active->position), at);
    const lane d2 = lane_max(lane3_dot(to, to), lane_splat(1e-24f));
    const lane inverse = lane_div(lane_splat(1.0f), lane_max(d2, lane_splat(active->spread)));
    const lane cosine = many_cosine(lane_div(lane3_dot(n, to), lane_sqrt(d2)));
    return lane_keep(lane_lt(zero, lane3_dot(face, to)), lane_mul(inverse, cosine));
}

/* The fall-off of one spot's cone, as in direct.inl. */
static inline lane many_falloff(lane3 at, const lmb_many_lights_source *spot, float per)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane3 from = lane3_sub(at, lane3_of(spot->position));
    const lane d2 = lane_max(lane3_dot(from, from), lane_splat(1e-12f));
    const lane cosine = lane_div(lane3_dot(lane3_of(spot->direction), from), lane_sqrt(d2));
    lane t = lane_mul(lane_sub(cosine, lane_splat(spot->cos_outer)), lane_splat(per));
    t = lane_min(lane_max(t, zero), one);
    t = lane_keep(lane_lt(lane_splat(0x1p-20f), t), t);
    return lane_mul(lane_mul(t, t), lane_sub(lane_splat(3.0f), lane_mul(lane_splat(2.0f), t)));
}

static inline lane many_light(lane3 at, lane3 n, lane3 face, const lmb_active_light *active)
{
    const lane3 to = lane3_of(active->position);
    return light_kind_is((int32_t)active->kind, LIGHT_FAR)
               ? lane_keep(lane_lt(lane_splat(0.0f), lane3_dot(face, to)), many_cosine(lane3_dot(n, to)))
               : many_factor(at, n, face, active);
}

/* Factor of a range, from the lights' mean position, because the first-order differences between the lights cancel
 * there. */
static inline lane many_in_range(lane3 at, const lmb_active_light *active, float range2)
{
    const lane3 to = lane3_sub(lane3_of(active->position), at);
    const lane left = direct_within(lane3_dot(to, to), lane_splat(range2));
    return lane_keep(lane_lt(lane_splat(0x1p-20f), left), left);
}

/* Factor of one of the two representative lights, for the pixels from k on. */
static inline lane many_share(lane3 at, const lmb_active_light *active, int i, int k)
{
    lane seen = lane_keep(mask_of_bits((uint32_t)(active->seen[i] >> k)), lane_splat(active->share[i]));
    if (active->source[i].range2 > 0.0f) {
        seen = lane_mul(seen, many_in_range(at, active, active->source[i].range2));
    }
    return light_kind_is((int32_t)active->kind, LIGHT_CONED)
               ? lane_mul(seen, many_falloff(at, &active->source[i], active->per[i]))
               : seen;
}

static void KERNEL(many_lights_irradiance)(lmb_irradiance *inout, const lmb_tile *tile, uint64_t pixels,
                               const lmb_active_light *active_lights, int32_t count)
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
            const lmb_active_light *active = &active_lights[i];
            const lane share = lane_add(many_share(at, active, 0, k), many_share(at, active, 1, k));
            const lane e = lane_mul(many_light(at, n, face, active), share);
            sum.x = lane_add(sum.x, lane_mul(e, lane_splat(active->intensity[0])));
            sum.y = lane_add(sum.y, lane_mul(e, lane_splat(active->intensity[1])));
            sum.z = lane_add(sum.z, lane_mul(e, lane_splat(active->intensity[2])));
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
