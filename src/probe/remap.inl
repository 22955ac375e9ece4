/* remap.inl: radiance that rays see: by direction from a point, or one ray per pixel. Layer 5. [S5-S8, S17]
 *
 * Lanes are rays. A ray meets the far world at q, which the cube shows along q - centre. It also meets the ground if it
 * descends to the ground inside the picture. Both are read bilinearly, from a level with texels about as wide as the
 * ray. */

typedef struct remap_colour {
    lane3 rgb; /* times alpha */
    lane alpha;
} remap_colour;

/* Adds texel `at` of the world, weighted. */
LANE_PART void remap_add(remap_colour *sum, const lmb_world_job *job, lanei at, lane weight)
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

/* Interpolates four texels: at, to the right, below, and below right. fx, fy: position between them. */
LANE_PART remap_colour remap_four(const lmb_world_job *job, const lanei at[4], lane fx, lane fy)
{
    const lane one = lane_splat(1.0f), zero = lane_splat(0.0f), gx = lane_sub(one, fx), gy = lane_sub(one, fy);
    remap_colour sum = {{zero, zero, zero}, zero};
    remap_add(&sum, job, at[0], lane_mul(gx, gy));
    remap_add(&sum, job, at[1], lane_mul(fx, gy));
    remap_add(&sum, job, at[2], lane_mul(gx, fy));
    remap_add(&sum, job, at[3], lane_mul(fx, fy));
    return sum;
}

/* The intersection of a ray with the cube: the face, and the position in texels of the bordered face, minus one half:
 * 0.5 .. n + 0.5. */
typedef struct remap_spot {
    lanei face;
    lane x, y;
} remap_spot;

/* Intersects a ray along d, of any length but 0; faces as in cube_face. */
LANE_PART void remap_meet(remap_spot *out, const lmb_world_job *job, lane3 d)
{
    const lane zero = lane_splat(0.0f), half_n = lane_splat(0.5f * (float)job->side);
    const lane x = lane_abs(d.x), y = lane_abs(d.y), z = lane_abs(d.z);
    const lane_mask on_x = mask_and(lane_le(y, x), lane_le(z, x)), on_y = mask_and(mask_not(on_x), lane_le(z, y));
    const lane_mask up_x = lane_lt(zero, d.x), up_y = lane_lt(zero, d.y), up_z = lane_lt(zero, d.z);
    const lane max = lane_pick(on_x, x, lane_pick(on_y, y, z)), less_x = lane_sub(zero, d.x),
               less_y = lane_sub(zero, d.y), less_z = lane_sub(zero, d.z);
    const lane s = lane_pick(on_x, lane_pick(up_x, less_z, d.z), lane_pick(on_y, d.x, lane_pick(up_z, d.x, less_x)));
    const lane t = lane_pick(on_y, lane_pick(up_y, d.z, less_z), less_y);
    out->face =
        lanei_pick(on_x, lanei_pick(up_x, lanei_splat(0), lanei_splat(1)),
                   lanei_pick(on_y, lanei_pick(up_y, lanei_splat(2), lanei_splat(3)),
                              lanei_pick(up_z, lanei_splat(4), lanei_splat(5))));
    const lane middle = lane_add(half_n, lane_splat(0.5f));
    const lane scale = lane_div(half_n, lane_max(max, lane_splat(1e-20f)));
    out->x = lane_add(lane_mul(s, scale), middle);
    out->y = lane_add(lane_mul(t, scale), middle);
}

/* Index of texel (x, y) of the bordered face. */
LANE_PART lanei remap_texel(const lmb_world_job *job, const remap_spot *spot, lane x, lane y)
{
    const lanei row = lanei_splat(job->side + 2);
    return lanei_add(lanei_mul(lanei_add(lanei_mul(spot->face, row), lane_to_int(y)), row),
                     lanei_add(lane_to_int(x), lanei_splat(job->cube_at)));
}

/* Weights of three texels in a row, at t -0.5 .. 0.5 from the middle one: the value of the parabola that has the values
 * of the texels as means over them. */
LANE_INLINE void remap_parabola(lane weight[3], lane t)
{
    const lane half = lane_splat(0.5f), odd = lane_mul(half, t);
    const lane even = lane_sub(lane_mul(half, lane_mul(t, t)), lane_splat(1.0f / 24.0f));
    weight[0] = lane_sub(even, odd);
    weight[1] = lane_sub(lane_splat(1.0f), lane_add(even, even));
    weight[2] = lane_add(even, odd);
}

/* The sharpest filter, for rays of which the mean over a texel or more is needed. Beside a bright texel a single ray
 * may be negative. Clamped rays would add 5 to 20 % to the light of small lamps. */
LANE_PART remap_colour remap_nine(const lmb_world_job *job, const remap_spot *spot)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), half = lane_splat(0.5f),
               n = lane_splat((float)job->side);
    const lane x = lane_trunc(lane_min(lane_max(lane_add(spot->x, half), one), n)),
               y = lane_trunc(lane_min(lane_max(lane_add(spot->y, half), one), n));
    const lanei middle = remap_texel(job, spot, x, y);
    remap_colour sum = {{zero, zero, zero}, zero};
    lane across[3], down[3];
    remap_parabola(across, lane_sub(spot->x, x));
    remap_parabola(down, lane_sub(spot->y, y));
    for (int i = 0; i < 9; ++i) {
        const lanei at = lanei_add(middle, lanei_splat((i / 3 - 1) * (job->side + 2) + i % 3 - 1));
        remap_add(&sum, job, at, lane_mul(across[i % 3], down[i / 3]));
    }
    sum.alpha = lane_min(lane_max(sum.alpha, zero), one);
    return sum;
}

/* Radiance of the cube along d. */
LANE_PART remap_colour remap_cube(const lmb_world_job *job, lane3 d)
{
    const lanei row = lanei_splat(job->side + 2), one = lanei_splat(1);
    remap_spot spot;
    lanei at[4];
    remap_meet(&spot, job, d);
    if (job->means) {
        return remap_nine(job, &spot);
    }
    const lane zero = lane_splat(0.0f), last = lane_splat((float)job->side); /* also clamps NaN */
    const lane x0 = lane_trunc(lane_min(lane_max(spot.x, zero), last)),
               y0 = lane_trunc(lane_min(lane_max(spot.y, zero), last));
    at[0] = remap_texel(job, &spot, x0, y0);
    at[1] = lanei_add(at[0], one);
    at[2] = lanei_add(at[0], row);
    at[3] = lanei_add(at[2], one);
    return remap_four(job, at, lane_sub(spot.x, x0), lane_sub(spot.y, y0));
}

/* Ray origins in the forms that the formulas need. */
typedef struct remap_place {
    lane3 from_centre, from_middle; /* relative to the cube's centre, the sphere's middle, m */
    lane outside2;                  /* |from_middle|^2 - radius^2: < 0 */
    lane3 to_low, to_high;          /* to the walls of the box */
    lane3 from_ground;              /* relative to the ground's corner */
} remap_place;

/* Clamps points outside the far world to the nearest inside. */
LANE_PART void remap_stand(remap_place *out, const lmb_world_job *job, lane3 at)
{
    if (job->shape == LMB_WORLD_SPHERE) {
        const lane3 d = lane3_sub(at, lane3_of(job->middle));
        const lane length = lane_sqrt(lane3_dot(d, d)), reach = lane_splat(job->reach);
        const lane_mask outside = lane_lt(reach, length);
        const lane shrunk = lane_div(reach, lane_pick(outside, length, lane_splat(1.0f)));
        at = lane3_pick(outside, lane3_add(lane3_of(job->middle), lane3_scale(d, shrunk)), at);
    } else {
        const lane3 low = lane3_of(job->reach_low), high = lane3_of(job->reach_high);
        at.x = lane_max(lane_min(at.x, high.x), low.x);
        at.y = lane_max(lane_min(at.y, high.y), low.y);
        at.z = lane_max(lane_min(at.z, high.z), low.z);
    }
    out->from_centre = lane3_sub(at, lane3_of(job->centre));
    out->from_middle = lane3_sub(at, lane3_of(job->middle));
    out->outside2 = lane_sub(lane3_dot(out->from_middle, out->from_middle), lane_splat(job->radius2));
    out->to_low = lane3_sub(lane3_of(job->low), at);
    out->to_high = lane3_sub(lane3_of(job->high), at);
    out->from_ground = lane3_sub(at, lane3_of(job->ground));
}

/* Distance to the sphere or the box along d. */
LANE_PART lane remap_shape(const lmb_world_job *job, const remap_place *from, lane3 d)
{
    const lane zero = lane_splat(0.0f);
    if (job->shape == LMB_WORLD_SPHERE) {
        const lane b = lane3_dot(from->from_middle, d);
        const lane inner = lane_sub(lane_mul(b, b), from->outside2);
        return lane_sub(lane_sqrt(lane_max(inner, zero)), b);
    }
    const lane low[3] = {from->to_low.x, from->to_low.y, from->to_low.z},
               high[3] = {from->to_high.x, from->to_high.y, from->to_high.z}, axis[3] = {d.x, d.y, d.z};
    lane t = lane_splat(1e20f);
    for (int i = 0; i < 3; ++i) {
        const lane wall = lane_pick(lane_lt(zero, axis[i]), high[i], low[i]);
        const lane_mask along = lane_lt(lane_splat(1e-10f), lane_mul(axis[i], axis[i]));
        t = lane_min(t, lane_pick(along, lane_div(wall, lane_pick(along, axis[i], lane_splat(1.0f))), t));
    }
    return t;
}

/* Distance to the far world along d. A floor lies slightly beyond the ground's picture on it. */
LANE_PART lane remap_far(const lmb_world_job *job, const remap_place *from, lane3 d)
{
    const lane far = remap_shape(job, from, d);
    if (!job->has_floor) {
        return far;
    }
    const lane down = lane_sub(lane_splat(0.0f), d.y), high = from->from_ground.y;
    const lane_mask falls = mask_and(lane_lt(lane_splat(1e-5f), down), lane_lt(lane_splat(1e-6f), high));
    const lane floor = lane_mul(lane_splat(1.00001f), lane_div(high, lane_pick(falls, down, lane_splat(1.0f))));
    return lane_pick(falls, lane_min(floor, far), far);
}

/* The ground's picture at x, z metres from the corner; `wide`: the ray's width there, m. */
LANE_PART remap_colour remap_ground(const lmb_world_job *job, lane x, lane z, lane wide)
{
    const lane half = lane_splat(0.5f), zero = lane_splat(0.0f);
    lanei level = lanei_splat(0), first = lanei_splat(job->ground_from);
    for (int i = 0; i + 1 < job->ground_levels; ++i) {
        const lane_mask finer = lane_lt(lane_splat(job->ground_limit[i]), wide);
        level = lanei_pick(finer, lanei_splat(i + 1), level);
        first = lanei_pick(finer, lanei_splat(job->ground_from + job->ground_at[i + 1]), first);
    }
    const lane columns = lane_table(job->ground_columns, level), rows = lane_table(job->ground_rows, level);
    const lane last_x = lane_sub(columns, lane_splat(1.0f)), last_y = lane_sub(rows, lane_splat(1.0f));
    x = lane_min(lane_max(lane_sub(lane_mul(lane_mul(x, lane_splat(job->ground_per_x)), columns), half), zero), last_x);
    z = lane_min(lane_max(lane_sub(lane_mul(lane_mul(z, lane_splat(job->ground_per_z)), rows), half), zero), last_y);
    const lane x0 = lane_trunc(x), y0 = lane_trunc(z);
    const lanei one = lanei_splat(1), width = lane_to_int(columns);
    const lanei right = lanei_min(one, lanei_sub(lane_to_int(last_x), lane_to_int(x0)));
    const lanei under = lanei_mul(lanei_min(one, lanei_sub(lane_to_int(last_y), lane_to_int(y0))), width);
    lanei at[4];
    at[0] = lanei_add(first, lanei_add(lanei_mul(lane_to_int(y0), width), lane_to_int(x0)));
    at[1] = lanei_add(at[0], right);
    at[2] = lanei_add(at[0], under);
    at[3] = lanei_add(at[2], right);
    return remap_four(job, at, lane_sub(x, x0), lane_sub(z, y0));
}

/* Composites `near` over `far`. */
LANE_PART lane3 remap_over(remap_colour near, remap_colour far)
{
    return lane3_add(near.rgb, lane3_scale(far.rgb, lane_sub(lane_splat(1.0f), near.alpha)));
}

typedef struct remap_hit {
    remap_colour colour; /* 0 for rays that miss */
    lane distance;       /* along d */
} remap_hit;

/* Intersects rays with the ground's picture. */
LANE_PART remap_hit remap_fall(const lmb_world_job *job, const remap_place *from, lane3 d)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), down = lane_sub(zero, d.y);
    const lane_mask falls = mask_and(lane_lt(lane_splat(1e-5f), down), lane_lt(lane_splat(1e-6f), from->from_ground.y));
    remap_hit hit = {{{zero, zero, zero}, zero}, zero};
    if (mask_bits(falls) == 0) {
        return hit;
    }
    const lane per_down = lane_div(one, lane_pick(falls, down, one));
    hit.distance = lane_keep(falls, lane_mul(from->from_ground.y, per_down));
    const lane x = lane_add(from->from_ground.x, lane_mul(d.x, hit.distance)),
               z = lane_add(from->from_ground.z, lane_mul(d.z, hit.distance));
    const lane_mask inside = mask_and(mask_and(lane_le(zero, x), lane_le(x, lane_splat(job->ground_width_m))),
                                      mask_and(lane_le(zero, z), lane_le(z, lane_splat(job->ground_depth_m))));
    const lane_mask met = mask_and(falls, inside);
    if (mask_bits(met) == 0) {
        return hit;
    }
    /* The ray's footprint on the ground is an ellipse, longer than wide by the factor per_down. The geometric mean
     * selects the level. */
    const lane wide = lane_mul(lane_mul(hit.distance, lane_splat(job->ray_width)), lane_sqrt(per_down));
    const remap_colour colour = remap_ground(job, lane_keep(met, x), lane_keep(met, z), wide);
    hit.colour.rgb.x = lane_keep(met, colour.rgb.x);
    hit.colour.rgb.y = lane_keep(met, colour.rgb.y);
    hit.colour.rgb.z = lane_keep(met, colour.rgb.z);
    hit.colour.alpha = lane_keep(met, colour.alpha);
    return hit;
}

/* Composites the nearer of two hits over the other, or averages them if the job blends. */
LANE_PART lane3 remap_mix(const lmb_world_job *job, const remap_hit *ground, remap_colour cube, lane far)
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

/* Radiance along a vector of rays. If the ground is nearer and opaque in all of them, the cube is not read. */
LANE_PART lane3 remap_see(const lmb_world_job *job, const remap_place *from, lane3 d)
{
    const lane far = remap_far(job, from, d), whole = lane_splat(0.99999f);
    remap_hit ground = {{{lane_splat(0.0f), lane_splat(0.0f), lane_splat(0.0f)}, lane_splat(0.0f)}, lane_splat(0.0f)};
    if (job->ground_levels > 0) {
        ground = remap_fall(job, from, d);
    }
    const lane_mask hides = mask_and(lane_lt(ground.distance, far), lane_lt(whole, ground.colour.alpha));
    if (!job->blend && mask_bits(mask_not(hides)) == 0) {
        return ground.colour.rgb;
    }
    const remap_colour cube = remap_cube(job, lane3_add(lane3_scale(d, far), from->from_centre));
    const lane3 seen = remap_mix(job, &ground, cube, far);
    return job->blend ? seen : lane3_pick(hides, ground.colour.rgb, seen);
}

/* Decodes 16-bit codes of a direction's components. The step is 1.5e-5 of a radius. */
LANE_INLINE lane remap_code(const uint16_t *p)
{
    return lane_sub(lane_mul(lane_load_u16(p, LMB_TILE), lane_splat(2.0f / 65535.0f)), lane_splat(1.0f));
}

static void KERNEL(remap)(float *out, const uint16_t *direction, int32_t count, lmb_vec3 at, const lmb_world_job *job)
{
    const uint16_t *x = direction, *y = x + count, *z = y + count;
    remap_place from;
    remap_stand(&from, job, lane3_of(at));
    for (int32_t k = 0; k < count; k += LANES) {
        const lane3 d = {remap_code(x + k), remap_code(y + k), remap_code(z + k)};
        const lane3 seen = remap_see(job, &from, d);
        lane_store(out + k, seen.x);
        lane_store(out + count + k, seen.y);
        lane_store(out + 2 * count + k, seen.z);
    }
}

LANE_INLINE void remap_store(float out[3][LMB_TILE_PIXELS], int k, lane3 v)
{
    lane_store(out[0] + k, v.x);
    lane_store(out[1] + k, v.y);
    lane_store(out[2] + k, v.z);
}

static void KERNEL(see)(float out[3][LMB_TILE_PIXELS], float origin[3][LMB_TILE_PIXELS],
                        float direction[3][LMB_TILE_PIXELS], const lmb_world_job *job)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        remap_place from;
        remap_stand(&from, job, lane3_load((const float (*)[LMB_TILE_PIXELS])origin, k));
        remap_store(out, k, remap_see(job, &from, lane3_load((const float (*)[LMB_TILE_PIXELS])direction, k)));
    }
}

static void KERNEL(world_radiance)(float out[3][LMB_TILE_PIXELS], float direction[3][LMB_TILE_PIXELS],
                                   const lmb_world_job *job)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        remap_store(out, k, remap_cube(job, lane3_load((const float (*)[LMB_TILE_PIXELS])direction, k)).rgb);
    }
}
