/* cone.inl: what cones see of voxels.                                                                        [M20-M22]
 *
 * Lanes are pixels; a cone's samples lie at the same distances for all of them, so levels are no lanes' matter.
 *
 * A sample is read between eight voxels' middles of two levels. With d the cone's axis, per leaf of way along it:
 *   coverage  C = sum |d_a| cover_a of the side that faces the viewer: how often a ray meets a surface (cone_crossed)
 *   light     E = sum |d_a| light_a of that side: radiance x how often
 * What rays meet adds up to 1, then all is hidden: surfaces that follow each other in a sample or on the way are taken
 * to lie side by side. So a wall is whole whatever level it is read from, and half a wall is half: exponentials would
 * need a wall to be several times as thick as it is.
 *   The surfaces' radiance is E / V, V the coverage that belongs to E: C, less what double-sided surfaces have along
 * axes on which they turn away. For one flat, evenly lit surface it is exact.
 *   The pixel's own plane is known: voxels behind it are left out, those that it goes through lose what it alone has
 * there, and what is left is divided by the sample's share in front of it. */

typedef struct cone_rays {
    lane3 origin, towards;  /* leaves from the cube's corner; the pixels' faces' normals */
    lane3 d;                /* the axis */
    lane front[3], back[3]; /* how far rays go along it, and against it */
    int32_t both;           /* bit k: some go against it along axis k */
} cone_rays;

typedef struct cone_sum {
    lane3 front, back; /* coverage against the rays, and with them */
    lane3 sheets;      /* the normal of what is double-sided */
    lane3 light;
    lane space; /* how much of the sample is in front of the pixel's plane */
} cone_sum;

/* The first of the two cells beside a place along an axis, from -1 on, and how near the second is: in 256 steps, so
 * that products of weights are no denormals. */
typedef struct cone_axis {
    lanei cell;
    lane second;
} cone_axis;

LANE_INLINE cone_axis cone_axis_of(lane at, int32_t level, int32_t depth)
{
    const float side = (float)(1 << (depth - level));
    const lane scaled = lane_mul(at, lane_splat(1.0f / (float)(1 << level)));
    /* One more, so that trunc is floor. */
    const lane from = lane_min(lane_max(lane_add(scaled, lane_splat(0.5f)), lane_splat(0.0f)), lane_splat(side + 1.0f));
    const lane first = lane_trunc(from);
    cone_axis r;
    r.cell = lanei_sub(lane_to_int(first), lanei_splat(1));
    r.second = lane_mul(lane_trunc(lane_mul(lane_sub(from, first), lane_splat(256.0f))), lane_splat(1.0f / 256.0f));
    return r;
}

LANE_INLINE lane cone_weight(const cone_axis *a, int i)
{
    return i ? a->second : lane_sub(lane_splat(1.0f), a->second);
}

/* The voxels of cells; under 8 where there is none. */
LANE_INLINE lanei cone_voxel(const lmb_cone_job *job, int32_t levels, lanei x, lanei y, lanei z)
{
    static const int32_t base[5] = {8, 9, 17, 81, 593};
    const int32_t below = levels > 4 ? levels - 4 : 0, full = levels - below;
    const lanei one = lanei_splat(1), row = lanei_splat(1 << full), end = lanei_splat((1 << levels) - 1);
    const lane_mask inside =
        lanei_not_negative(lanei_or(lanei_or(lanei_or(x, y), z),
                                    lanei_or(lanei_or(lanei_sub(end, x), lanei_sub(end, y)), lanei_sub(end, z))));
    x = lanei_and(x, end);
    y = lanei_and(y, end);
    z = lanei_and(z, end);
    lanei at = lanei_add(lanei_mul(lanei_add(lanei_mul(lanei_shift(z, below), row), lanei_shift(y, below)), row),
                         lanei_add(lanei_shift(x, below), lanei_splat(base[full])));
    for (int32_t bit = below - 1; bit >= 0; --bit) {
        const lanei octant =
            lanei_add(lanei_and(lanei_shift(x, bit), one),
                      lanei_add(lanei_mul(lanei_and(lanei_shift(y, bit), one), lanei_splat(2)),
                                lanei_mul(lanei_and(lanei_shift(z, bit), one), lanei_splat(4))));
        at = lanei_add(lane_to_int(lane_gather_f32(job->child, at)), octant);
    }
    return lanei_pick(inside, at, lanei_splat(0));
}

/* Coverage along one axis; own: what the pixel's own plane has of it, if it is there. */
LANE_INLINE void cone_add_axis(lane *front, lane *back, lane *sheets, const lane pair[2], lane sheet, lane d,
                               lane weight, lane own)
{
    const lane zero = lane_splat(0.0f);
    const lane_mask along = lane_lt(zero, d);
    const lane mine = lane_min(lane_abs(sheet), own);
    const lane plus = lane_max(lane_sub(pair[0], mine), zero), minus = lane_max(lane_sub(pair[1], mine), zero);
    const lane left = lane_sub(sheet, lane_pick(lane_lt(sheet, zero), lane_sub(zero, mine), mine));
    *front = lane_add(*front, lane_mul(lane_pick(along, minus, plus), weight));
    *back = lane_add(*back, lane_mul(lane_pick(along, plus, minus), weight));
    *sheets = lane_add(*sheets, lane_mul(left, weight));
}

LANE_INLINE void cone_add_light(lane3 *sum, const lmb_cone_job *job, lanei at, lane d, int axis, int back, lane share)
{
    const lane_mask along = lane_lt(lane_splat(0.0f), d);
    const lanei even = lanei_splat(2 * axis), odd = lanei_splat(2 * axis + 1);
    lane light[4];
    lane_gather_rgba_f32(light, job->light, lanei_add(at, lanei_pick(along, back ? even : odd, back ? odd : even)));
    sum->x = lane_add(sum->x, lane_mul(light[0], share));
    sum->y = lane_add(sum->y, lane_mul(light[1], share));
    sum->z = lane_add(sum->z, lane_mul(light[2], share));
}

/* One voxel's part. own: what a plane across the voxel has of coverage; 0 for voxels without the pixel's own. */
LANE_PART void cone_add(cone_sum *sum, const lmb_cone_job *job, const cone_rays *rays, lanei at, lane weight, lane own)
{
    const lane d[3] = {rays->d.x, rays->d.y, rays->d.z};
    const lane3 mine = lane3_scale(lane3_abs(rays->towards), own);
    const lanei three = lanei_mul(at, lanei_splat(3)), six = lanei_add(three, three);
    lane pair[4], sheet[4];
    lane_gather_rgba_f32(sheet, job->cover, lanei_add(three, lanei_splat(2)));
    lane_gather_rgba_f32(pair, job->cover, three);
    cone_add_axis(&sum->front.x, &sum->back.x, &sum->sheets.x, pair, sheet[0], d[0], weight, mine.x);
    cone_add_axis(&sum->front.y, &sum->back.y, &sum->sheets.y, pair + 2, sheet[1], d[1], weight, mine.y);
    lane_gather_rgba_f32(pair, job->cover, lanei_add(three, lanei_splat(1)));
    cone_add_axis(&sum->front.z, &sum->back.z, &sum->sheets.z, pair, sheet[2], d[2], weight, mine.z);
    for (int k = 0; k < 3; ++k) {
        cone_add_light(&sum->light, job, six, d[k], k, 0, lane_mul(weight, rays->front[k]));
        if (rays->both >> k & 1) {
            cone_add_light(&sum->light, job, six, d[k], k, 1, lane_mul(weight, rays->back[k]));
        }
    }
}

/* A level at `at`, leaves from the corner. */
LANE_APART void cone_level(cone_sum *sum, const lmb_cone_job *job, const cone_rays *rays, const lane3 *at,
                           int32_t level, float share)
{
    const float wide = (float)(1 << level);
    const lane zero = lane_splat(0.0f), half = lane_splat(0.5f);
    const lane3 reaches = lane3_abs(rays->towards);
    const lane reach = lane_mul(lane_add(lane_add(reaches.x, reaches.y), reaches.z), lane_splat(0.5f * wide));
    const cone_axis x = cone_axis_of(at->x, level, job->depth), y = cone_axis_of(at->y, level, job->depth),
                    z = cone_axis_of(at->z, level, job->depth);
    for (int k = 0; k < 8; ++k) {
        const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        const lanei cx = lanei_add(x.cell, lanei_splat(i)), cy = lanei_add(y.cell, lanei_splat(j)),
                    cz = lanei_add(z.cell, lanei_splat(l));
        const lane3 middle = {lane_mul(lane_add(lane_from_int(cx), half), lane_splat(wide)),
                              lane_mul(lane_add(lane_from_int(cy), half), lane_splat(wide)),
                              lane_mul(lane_add(lane_from_int(cz), half), lane_splat(wide))};
        const lane height = lane3_dot(lane3_sub(middle, rays->origin), rays->towards);
        const lane front = lane_add(lane_div(lane_mul(height, half), lane_max(reach, half)), half);
        const lane all = lane_mul(lane_mul(cone_weight(&x, i), cone_weight(&y, j)),
                                  lane_mul(cone_weight(&z, l), lane_splat(share)));
        const lane weight = lane_keep(lane_lt(lane_sub(zero, reach), height), all);
        const lanei voxel = cone_voxel(job, job->depth - level, cx, cy, cz);
        sum->space = lane_add(sum->space, lane_mul(weight, lane_min(lane_max(front, zero), lane_splat(1.0f))));
        if (mask_bits(lanei_lt(lanei_splat(7), voxel)) != 0) {
            cone_add(sum, job, rays, voxel, weight, lane_keep(lane_lt(height, reach), lane_splat(1.0f / wide)));
        }
    }
}

/* How often a ray meets a surface, per leaf. `met`: |d_a| cover_a, whose sum is right for a corner of walls and too
 * much for all else. Flat: |N . d|. Round: the projection of an ellipsoid with these areas, the root of the squares'
 * sum. What is both, by parts: the root of (N . d)^2 and of what the squares have more than N's own; but walls that
 * face each other cancel in N, for which the larger of the first two is right. CREASED of the former, the rest of the
 * latter: of 0, 1/2, 0.7, 1 the one that keeps a sphere's shadow within 0.12 and leaves least of a closed room open. */
LANE_INLINE lane cone_crossed(lane cover, lane3 met, lane3 normal, lane3 d)
{
    const float creased = 0.7f;
    const lane3 flat = {lane_mul(normal.x, d.x), lane_mul(normal.y, d.y), lane_mul(normal.z, d.z)};
    const lane through = lane_add(lane_add(flat.x, flat.y), flat.z), squares = lane3_dot(met, met);
    const lane rest = lane_max(lane_sub(squares, lane3_dot(flat, flat)), lane_splat(0.0f));
    const lane parts = lane_sqrt(lane_add(lane_mul(through, through), rest));
    const lane larger = lane_max(lane_sqrt(squares), lane_abs(through));
    return lane_min(cover, lane_add(lane_mul(parts, lane_splat(creased)),
                                    lane_mul(larger, lane_splat(1.0f - creased))));
}

/* What shows of C, see above. */
LANE_INLINE lane cone_shown(lane cover, lane3 sheets, lane3 d, const lane back[3])
{
    const lane zero = lane_splat(0.0f);
    const lane part[3] = {lane_mul(sheets.x, d.x), lane_mul(sheets.y, d.y), lane_mul(sheets.z, d.z)};
    const lane sum = lane_add(lane_add(part[0], part[1]), part[2]);
    const lane3 one_way = lane3_abs(sheets);
    lane shown = lane_sub(cover, lane_add(lane_add(lane_mul(back[0], one_way.x), lane_mul(back[1], one_way.y)),
                                          lane_mul(back[2], one_way.z)));
    for (int k = 0; k < 3; ++k) {
        const lane against = lane_pick(lane_lt(sum, zero), part[k], lane_sub(zero, part[k]));
        shown = lane_sub(shown, lane_max(against, zero));
    }
    return lane_max(shown, lane_add(lane_mul(cover, lane_splat(0.1f)), lane_splat(1e-12f)));
}

/* A cone that widens by `spread` on either side is read as rays that go apart, d_a + spread x with x as dense as a tent
 * over -1 .. 1. The mean of |d_a + spread x| is spread (1/3 + q^2 - q^3 / 3), q = |d_a| / spread, up to q = 1; what of
 * it goes forward and what back differ by d_a. Without this a cone would pass between walls that it is wider than.
 * Parts under 2^-12 are none: what they are multiplied with stays a normal number. */
LANE_APART void cone_spread(cone_rays *rays, float spread)
{
    const lane least = lane_splat(1.0f / 4096.0f), one = lane_splat(1.0f), third = lane_splat(1.0f / 3.0f);
    const lane along[3] = {lane_abs(rays->d.x), lane_abs(rays->d.y), lane_abs(rays->d.z)};
    rays->both = 0;
    for (int k = 0; k < 3; ++k) {
        lane mean = along[k];
        if (spread > 0.0f) {
            const lane q = lane_min(lane_mul(along[k], lane_splat(1.0f / spread)), one);
            const lane bent = lane_add(third, lane_mul(lane_mul(q, q), lane_sub(one, lane_mul(q, third))));
            mean = lane_pick(lane_lt(along[k], lane_splat(spread)), lane_mul(bent, lane_splat(spread)), mean);
        }
        const lane back = lane_mul(lane_sub(mean, along[k]), lane_splat(0.5f)), front = lane_sub(mean, back);
        rays->back[k] = lane_keep(lane_lt(least, back), back);
        rays->front[k] = lane_keep(lane_lt(least, front), front);
        rays->both |= (mask_bits(lane_lt(least, back)) != 0) << k;
    }
}

/* Of what was added up along one axis: the normal's part, from sums by whether rays go along it. */
LANE_INLINE lane cone_normal(lane front, lane back, lane sheets, lane d)
{
    const lane difference = lane_sub(back, front);
    return lane_add(lane_pick(lane_lt(lane_splat(0.0f), d), difference, lane_sub(front, back)), sheets);
}

/* What a step adds, and what it leaves open: under 1/1024 is none, for each lane alone, so that none knows when the
 * others are done. */
LANE_APART lane cone_weigh(lmb_cone_seen *out, int k, const cone_sum *sum, const cone_rays *rays, float length,
                           lane open)
{
    const lane3 d = rays->d;
    const lane3 met = {lane_add(lane_mul(sum->front.x, rays->front[0]), lane_mul(sum->back.x, rays->back[0])),
                       lane_add(lane_mul(sum->front.y, rays->front[1]), lane_mul(sum->back.y, rays->back[1])),
                       lane_add(lane_mul(sum->front.z, rays->front[2]), lane_mul(sum->back.z, rays->back[2]))};
    const lane3 normal = {cone_normal(sum->front.x, sum->back.x, sum->sheets.x, d.x),
                          cone_normal(sum->front.y, sum->back.y, sum->sheets.y, d.y),
                          cone_normal(sum->front.z, sum->back.z, sum->sheets.z, d.z)};
    const lane cover = lane_add(lane_add(met.x, met.y), met.z), crossed = cone_crossed(cover, met, normal, d);
    const lane space = lane_max(sum->space, lane_splat(0.25f));
    const lane taken = lane_min(open, lane_div(lane_mul(crossed, lane_splat(length)), space));
    const lane scale = lane_div(taken, cone_shown(cover, sum->sheets, d, rays->back));
    lane_store(out->rgb[0] + k, lane_add(lane_load(out->rgb[0] + k), lane_mul(sum->light.x, scale)));
    lane_store(out->rgb[1] + k, lane_add(lane_load(out->rgb[1] + k), lane_mul(sum->light.y, scale)));
    lane_store(out->rgb[2] + k, lane_add(lane_load(out->rgb[2] + k), lane_mul(sum->light.z, scale)));
    const lane left = lane_sub(open, taken);
    return lane_keep(lane_lt(lane_splat(1.0f / 1024.0f), left), left);
}

LANE_APART lane cone_step(lmb_cone_seen *out, int k, const lmb_cone_job *job, const cone_rays *rays,
                          const lmb_cone_step *step, lane open)
{
    const lane3 at = lane3_add(rays->origin, lane3_scale(rays->d, lane_splat(step->at * job->per_leaf)));
    cone_sum sum;
    sum.front = sum.back = sum.sheets = sum.light = lane3_splat(0.0f, 0.0f, 0.0f);
    sum.space = lane_splat(0.0f);
    cone_level(&sum, job, rays, &at, step->level, step->finer);
    if (step->finer < 1.0f) {
        cone_level(&sum, job, rays, &at, step->level + 1, 1.0f - step->finer);
    }
    return cone_weigh(out, k, &sum, rays, step->length, open);
}

/* Is one of the samples in the cube, or up to half a voxel of the coarser level beside it, which it still reads? */
LANE_APART int cone_is_inside(const lmb_cone_job *job, const cone_rays *rays, const lmb_cone_step *step)
{
    const float margin = (float)(1 << step->level), side = (float)(1 << job->depth) + margin;
    const lane3 at = lane3_add(rays->origin, lane3_scale(rays->d, lane_splat(step->at * job->per_leaf)));
    const lane low = lane_min(lane_min(at.x, at.y), at.z), high = lane_max(lane_max(at.x, at.y), at.z);
    return mask_bits(mask_and(lane_lt(lane_splat(-margin), low), lane_lt(high, lane_splat(side)))) != 0;
}

LANE_PART lane cone_follow(lmb_cone_seen *out, int k, const lmb_cone_job *job, cone_rays *rays)
{
    float spread = -1.0f;
    lane open = lane_splat(1.0f);
    for (int c = 0; c < 3; ++c) {
        lane_store(out->rgb[c] + k, lane_splat(0.0f));
    }
    for (int32_t i = 0; i < job->steps && mask_bits(lane_lt(lane_splat(0.0f), open)) != 0; ++i) {
        const lmb_cone_step *step = &job->step[i];
        if (!cone_is_inside(job, rays, step)) {
            continue;
        }
        if (step->spread != spread) {
            spread = step->spread;
            cone_spread(rays, spread);
        }
        open = cone_step(out, k, job, rays, step, open);
    }
    return open;
}

static void KERNEL(cone)(lmb_cone_seen *out, const lmb_cone_job *job, const lmb_tile *tile,
                         float direction[3][LMB_TILE_PIXELS])
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        cone_rays rays;
        lane3 at;
        at.x = lane_load(tile->position[0] + k);
        at.y = lane_load(tile->position[1] + k);
        at.z = lane_load(tile->position[2] + k);
        rays.origin = lane3_scale(lane3_sub(at, lane3_of(job->low)), lane_splat(job->per_leaf));
        rays.towards.x = lane_load(tile->face[0] + k);
        rays.towards.y = lane_load(tile->face[1] + k);
        rays.towards.z = lane_load(tile->face[2] + k);
        rays.d.x = lane_load(direction[0] + k);
        rays.d.y = lane_load(direction[1] + k);
        rays.d.z = lane_load(direction[2] + k);
        lane_store(out->open + k, cone_follow(out, k, job, &rays));
    }
}
