/* remap.inl: what a place sees of the world, by direction.                                                     [S5-S8]
 *
 * Lanes are directions. A ray meets the far world at q, which the cube shows along q - centre; and the ground, if it
 * goes down to it within the picture. Both are read bilinearly, from a level whose texels are about as wide as it. */

typedef struct remap_colour {
    lane3 rgb; /* times alpha */
    lane alpha;
} remap_colour;

/* Texel `at` of the world, weighted. */
LANE_PART void remap_add(remap_colour *sum, const lmb_remap_job *job, lanei at, lane weight)
{
    const lanei byte = lanei_splat(255), four = lanei_mul(at, lanei_splat(4));
    lane c[4];
    if (job->format == LMB_WORLD_LOG8) {
        const lanei code = lanei_gather_rgba((const uint8_t *)job->texels, at);
        for (int i = 0; i < 3; ++i) {
            c[i] = lane_gather_f32(job->log8, lanei_and(lanei_shift(code, 8 * i), byte));
        }
        c[3] = lane_mul(lane_from_int(lanei_and(lanei_shift(code, 24), byte)), lane_splat(1.0f / 255.0f));
    } else if (job->format == LMB_WORLD_LOG16) {
        for (int i = 0; i < 3; ++i) {
            const lanei code =
                lane_to_int(lane_gather_u16((const uint16_t *)job->texels, lanei_add(four, lanei_splat(i))));
            const lane high = lane_gather_f32(job->log16[0], lanei_shift(code, 8)),
                       low = lane_gather_f32(job->log16[1], lanei_and(code, byte));
            c[i] = lane_max(lane_sub(lane_mul(high, low), lane_splat(0.101f)), lane_splat(0.0f));
        }
        c[3] = lane_mul(lane_gather_u16((const uint16_t *)job->texels, lanei_add(four, lanei_splat(3))),
                        lane_splat(1.0f / 65535.0f));
    } else {
        lane_gather_rgba_f32(c, (const float *)job->texels, at);
    }
    weight = lane_mul(weight, c[3]);
    sum->rgb.x = lane_add(sum->rgb.x, lane_mul(weight, c[0]));
    sum->rgb.y = lane_add(sum->rgb.y, lane_mul(weight, c[1]));
    sum->rgb.z = lane_add(sum->rgb.z, lane_mul(weight, c[2]));
    sum->alpha = lane_add(sum->alpha, weight);
}

/* Four texels: at, to its right, under it, under that one. fx, fy: where between them. */
LANE_PART remap_colour remap_four(const lmb_remap_job *job, const lanei at[4], lane fx, lane fy)
{
    const lane one = lane_splat(1.0f), zero = lane_splat(0.0f), gx = lane_sub(one, fx), gy = lane_sub(one, fy);
    remap_colour sum = {{zero, zero, zero}, zero};
    remap_add(&sum, job, at[0], lane_mul(gx, gy));
    remap_add(&sum, job, at[1], lane_mul(fx, gy));
    remap_add(&sum, job, at[2], lane_mul(gx, fy));
    remap_add(&sum, job, at[3], lane_mul(fx, fy));
    return sum;
}

/* What the cube shows along d, of any length but 0. As cube_face. */
LANE_PART remap_colour remap_cube(const lmb_remap_job *job, lane3 d)
{
    const lane zero = lane_splat(0.0f), half_n = lane_splat(0.5f * (float)job->side);
    const lane x = lane_abs(d.x), y = lane_abs(d.y), z = lane_abs(d.z);
    const lane_mask on_x = mask_and(lane_le(y, x), lane_le(z, x)), on_y = mask_and(mask_not(on_x), lane_le(z, y));
    const lane_mask up_x = lane_lt(zero, d.x), up_y = lane_lt(zero, d.y), up_z = lane_lt(zero, d.z);
    const lane most = lane_pick(on_x, x, lane_pick(on_y, y, z)), less_x = lane_sub(zero, d.x),
               less_y = lane_sub(zero, d.y), less_z = lane_sub(zero, d.z);
    const lane s = lane_pick(on_x, lane_pick(up_x, less_z, d.z), lane_pick(on_y, d.x, lane_pick(up_z, d.x, less_x)));
    const lane t = lane_pick(on_y, lane_pick(up_y, d.z, less_z), less_y);
    const lanei face =
        lanei_pick(on_x, lanei_pick(up_x, lanei_splat(0), lanei_splat(1)),
                   lanei_pick(on_y, lanei_pick(up_y, lanei_splat(2), lanei_splat(3)),
                              lanei_pick(up_z, lanei_splat(4), lanei_splat(5))));
    /* In texels of the bordered face, less one half: 0.5 .. n + 0.5. */
    const lane middle = lane_add(half_n, lane_splat(0.5f));
    const lane scale = lane_div(half_n, lane_max(most, lane_splat(1e-20f)));
    const lane fx = lane_add(lane_mul(s, scale), middle), fy = lane_add(lane_mul(t, scale), middle);
    const lane x0 = lane_trunc(fx), y0 = lane_trunc(fy);
    const lanei row = lanei_splat(job->side + 2), one = lanei_splat(1);
    lanei at[4];
    at[0] = lanei_add(lanei_mul(lanei_add(lanei_mul(face, row), lane_to_int(y0)), row),
                      lanei_add(lane_to_int(x0), lanei_splat(job->cube_at)));
    at[1] = lanei_add(at[0], one);
    at[2] = lanei_add(at[0], row);
    at[3] = lanei_add(at[2], one);
    return remap_four(job, at, lane_sub(fx, x0), lane_sub(fy, y0));
}

/* How far the far world is along d. */
LANE_PART lane remap_far(const lmb_remap_job *job, lane3 d)
{
    const lane zero = lane_splat(0.0f);
    if (job->shape == LMB_WORLD_SPHERE) {
        const lane b = lane3_dot(lane3_of(job->from_middle), d);
        const lane inner = lane_sub(lane_mul(b, b), lane_splat(job->outside2));
        return lane_sub(lane_sqrt(lane_max(inner, zero)), b);
    }
    const float *low = job->to_low, *high = job->to_high;
    const lane axis[3] = {d.x, d.y, d.z};
    lane t = lane_splat(1e20f);
    for (int i = 0; i < 3; ++i) {
        const lane_mask up = lane_lt(zero, axis[i]);
        const lane wall = lane_pick(up, lane_splat(high[i]), lane_splat(low[i]));
        const lane_mask along = lane_lt(lane_splat(1e-10f), lane_mul(axis[i], axis[i]));
        t = lane_min(t, lane_pick(along, lane_div(wall, lane_pick(along, axis[i], lane_splat(1.0f))), t));
    }
    return t;
}

/* The ground's picture at metres x, z from its corner; `wide`: the ray's width there, m. */
LANE_PART remap_colour remap_ground(const lmb_remap_job *job, lane x, lane z, lane wide)
{
    const lane half = lane_splat(0.5f), zero = lane_splat(0.0f);
    lanei level = lanei_splat(0);
    for (int i = 0; i + 1 < job->ground_levels; ++i) {
        const lane_mask finer = lane_lt(lane_splat(job->ground_limit[i]), wide);
        level = lanei_pick(finer, lanei_splat(i + 1), level);
    }
    const lane columns = lane_table(job->ground_columns, level), rows = lane_table(job->ground_rows, level);
    const lane last_x = lane_sub(columns, lane_splat(1.0f)), last_y = lane_sub(rows, lane_splat(1.0f));
    x = lane_min(lane_max(lane_sub(lane_mul(lane_mul(x, lane_splat(job->ground_per_x)), columns), half), zero), last_x);
    z = lane_min(lane_max(lane_sub(lane_mul(lane_mul(z, lane_splat(job->ground_per_z)), rows), half), zero), last_y);
    const lane x0 = lane_trunc(x), y0 = lane_trunc(z);
    const lanei one = lanei_splat(1), width = lane_to_int(columns);
    const lanei right = lanei_min(one, lanei_sub(lane_to_int(last_x), lane_to_int(x0)));
    const lanei under = lanei_mul(lanei_min(one, lanei_sub(lane_to_int(last_y), lane_to_int(y0))), width);
    const lanei first = lanei_add(lane_to_int(lane_table(job->ground_at, level)), lanei_splat(job->ground_from));
    lanei at[4];
    at[0] = lanei_add(first, lanei_add(lanei_mul(lane_to_int(y0), width), lane_to_int(x0)));
    at[1] = lanei_add(at[0], right);
    at[2] = lanei_add(at[0], under);
    at[3] = lanei_add(at[2], right);
    return remap_four(job, at, lane_sub(x, x0), lane_sub(z, y0));
}

/* Where `near` leaves something to see, `far`. */
LANE_PART lane3 remap_over(remap_colour near, remap_colour far)
{
    return lane3_add(near.rgb, lane3_scale(far.rgb, lane_sub(lane_splat(1.0f), near.alpha)));
}

typedef struct remap_hit {
    remap_colour colour; /* 0 where rays meet none */
    lane distance;       /* along d */
} remap_hit;

/* The ground as far as rays meet its picture. */
LANE_PART remap_hit remap_fall(const lmb_remap_job *job, lane3 d)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), down = lane_sub(zero, d.y);
    const lane_mask falls = lane_lt(lane_splat(1e-5f), down);
    remap_hit hit = {{{zero, zero, zero}, zero}, zero};
    if (mask_bits(falls) == 0) {
        return hit;
    }
    const lane per_down = lane_div(one, lane_pick(falls, down, one));
    hit.distance = lane_mul(lane_splat(job->height), per_down);
    const lane x = lane_add(lane_splat(job->ground_x), lane_mul(d.x, hit.distance)),
               z = lane_add(lane_splat(job->ground_z), lane_mul(d.z, hit.distance));
    const lane_mask inside = mask_and(mask_and(lane_le(zero, x), lane_le(x, lane_splat(job->ground_width_m))),
                                      mask_and(lane_le(zero, z), lane_le(z, lane_splat(job->ground_depth_m))));
    const lane_mask met = mask_and(falls, inside);
    if (mask_bits(met) == 0) {
        return hit;
    }
    /* A ray's foot is longer than wide by per_down; its level's texels, by the square root. */
    const lane wide = lane_mul(lane_mul(hit.distance, lane_splat(job->ray_width)), lane_sqrt(per_down));
    const remap_colour colour = remap_ground(job, lane_keep(met, x), lane_keep(met, z), wide);
    hit.colour.rgb.x = lane_keep(met, colour.rgb.x);
    hit.colour.rgb.y = lane_keep(met, colour.rgb.y);
    hit.colour.rgb.z = lane_keep(met, colour.rgb.z);
    hit.colour.alpha = lane_keep(met, colour.alpha);
    return hit;
}

/* Both candidates: the nearer over the other, or their mean where a ray meets both. */
LANE_PART lane3 remap_mix(const lmb_remap_job *job, const remap_hit *ground, remap_colour cube, lane far)
{
    const lane one = lane_splat(1.0f), ground_alpha = ground->colour.alpha;
    if (job->blend) {
        const lane of_cube = lane_sub(one, lane_mul(lane_splat(0.5f), ground_alpha)),
                   of_ground = lane_sub(one, lane_mul(lane_splat(0.5f), cube.alpha));
        return lane3_add(lane3_scale(cube.rgb, of_cube), lane3_scale(ground->colour.rgb, of_ground));
    }
    return lane3_pick(lane_lt(ground->distance, far), remap_over(ground->colour, cube),
                      remap_over(cube, ground->colour));
}

/* What a vector of rays sees. Where the ground is near and whole the cube need not be read, nor does it count. */
LANE_PART lane3 remap_see(const lmb_remap_job *job, lane3 d)
{
    const lane far = remap_far(job, d), whole = lane_splat(0.99999f);
    remap_hit ground = {{{lane_splat(0.0f), lane_splat(0.0f), lane_splat(0.0f)}, lane_splat(0.0f)}, lane_splat(0.0f)};
    if (job->ground_levels > 0) {
        ground = remap_fall(job, d);
    }
    const lane_mask hides = mask_and(lane_lt(ground.distance, far), lane_lt(whole, ground.colour.alpha));
    if (!job->blend && mask_bits(mask_not(hides)) == 0) {
        return ground.colour.rgb;
    }
    const remap_colour cube = remap_cube(job, lane3_add(lane3_scale(d, far), lane3_of(job->from_centre)));
    const lane3 seen = remap_mix(job, &ground, cube, far);
    return job->blend ? seen : lane3_pick(hides, ground.colour.rgb, seen);
}

/* 16-bit codes of a direction's parts. Their step is 1.5e-5 of a radius. */
LANE_INLINE lane remap_code(const uint16_t *p)
{
    return lane_sub(lane_mul(lane_load_u16(p, LMB_TILE), lane_splat(2.0f / 65535.0f)), lane_splat(1.0f));
}

static void KERNEL(remap)(float *out, const lmb_remap_job *job)
{
    const uint16_t *x = job->direction, *y = x + job->count, *z = y + job->count;
    for (int32_t k = 0; k < job->count; k += LANES) {
        const lane3 d = {remap_code(x + k), remap_code(y + k), remap_code(z + k)};
        const lane3 seen = remap_see(job, d);
        lane_store(out + k, seen.x);
        lane_store(out + job->count + k, seen.y);
        lane_store(out + 2 * job->count + k, seen.z);
    }
}
