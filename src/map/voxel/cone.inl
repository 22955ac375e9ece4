/* cone.inl: what cones see of voxels.                                                                        [M20-M22]
 *
 * Lanes are pixels; a cone's samples lie at the same distances for all of them, so levels are no lanes' matter.
 *
 * A sample is read between eight voxels' middles of two levels. With d the cone's axis, per leaf of way along it:
 *   coverage  C = sum |d_a| cover_a of the side that faces the viewer: how often a ray meets a surface, see cone_crossed
 *   light     E = sum |d_a| light_a of that side: radiance x how often
 * What rays meet adds up to 1, then all is hidden: surfaces that follow each other in a sample or on the way are taken
 * to lie side by side. So a wall is whole whatever level it is read from, and half a wall is half: exponentials would
 * need a wall to be several times as thick as it is.
 *   The surfaces' radiance is E / V, V the coverage that belongs to E: C, less what double-sided surfaces have along
 * axes on which they turn away. For one flat, evenly lit surface it is exact.
 *   The pixel's own plane is known: voxels behind it are left out, those that it goes through lose what it alone has
 * there, and what is left is divided by the sample's share in front of it. */

typedef struct cone_rays {
    lane3 origin, towards; /* leaves from the cube's corner; the pixels' faces' normals */
    lane3 own;             /* |towards| */
    lane half;             /* of a voxel one wide along `towards` */
    lanei side[3];         /* lobe 0 or 1, 2 or 3, 4 or 5: the one that faces the viewer */
    lane_mask along[3];    /* rays go to larger numbers */
    lane front[3], back[3]; /* how far rays go against it, and with it */
    int both[3];            /* some rays go with it */
} cone_rays;

typedef struct cone_sum {
    lane3 front, back;    /* coverage against the rays, and with them */
    lane3 normal, sheets; /* of all, and of what is double-sided */
    lane3 light;
    lane space; /* how much of the sample is in front of the pixel's plane */
} cone_sum;

/* The cells beside a place along one axis, and whether they are in the cube. */
typedef struct cone_axis {
    lanei cell[2];
    lane_mask inside[2];
    lane weight[2];
    lane middle; /* of the first, voxels */
} cone_axis;

/* 256 weights between two middles: their products are no denormals. */
LANE_INLINE cone_axis cone_axis_of(lane at, int32_t level, int32_t depth)
{
    const int32_t last = (1 << (depth - level)) - 1;
    const lane one = lane_splat(1.0f), scaled = lane_mul(at, lane_splat(1.0f / (float)(1 << level)));
    /* One more, so that trunc is floor. */
    const lane from = lane_min(lane_max(lane_add(scaled, lane_splat(0.5f)), lane_splat(0.0f)),
                               lane_splat((float)last + 2.0f));
    const lane first = lane_trunc(from);
    const lane f = lane_mul(lane_trunc(lane_mul(lane_sub(from, first), lane_splat(256.0f))), lane_splat(1.0f / 256.0f));
    const lanei cell = lanei_sub(lane_to_int(first), lanei_splat(1)), zero = lanei_splat(0), end = lanei_splat(last);
    const lanei next = lanei_add(cell, lanei_splat(1));
    cone_axis r;
    r.inside[0] = mask_and(lanei_not_negative(cell), lanei_not_negative(lanei_sub(end, cell)));
    r.inside[1] = lanei_not_negative(lanei_sub(end, next));
    r.cell[0] = lanei_min(lanei_max(cell, zero), end);
    r.cell[1] = lanei_min(next, end);
    r.weight[0] = lane_sub(one, f);
    r.weight[1] = f;
    r.middle = lane_sub(first, lane_splat(0.5f));
    return r;
}

/* The voxels of cells; under 8 where there is none. */
LANE_INLINE lanei cone_voxel(const lmb_cone_job *job, int32_t levels, lanei x, lanei y, lanei z)
{
    static const int32_t base[5] = {8, 9, 17, 81, 593};
    const int32_t below = levels > 4 ? levels - 4 : 0, full = levels - below;
    const lanei one = lanei_splat(1), row = lanei_splat(1 << full);
    lanei at = lanei_add(lanei_mul(lanei_add(lanei_mul(lanei_shift(z, below), row), lanei_shift(y, below)), row),
                         lanei_add(lanei_shift(x, below), lanei_splat(base[full])));
    for (int32_t bit = below - 1; bit >= 0; --bit) {
        const lanei octant =
            lanei_add(lanei_and(lanei_shift(x, bit), one),
                      lanei_add(lanei_mul(lanei_and(lanei_shift(y, bit), one), lanei_splat(2)),
                                lanei_mul(lanei_and(lanei_shift(z, bit), one), lanei_splat(4))));
        at = lanei_add(lane_to_int(lane_gather_f32(job->child, at)), octant);
    }
    return at;
}

/* a less b, towards 0; not past it. */
LANE_INLINE lane cone_less(lane a, lane b)
{
    const lane zero = lane_splat(0.0f);
    return lane_sub(a, lane_max(lane_min(a, b), lane_sub(zero, b)));
}

LANE_INLINE void cone_add_axis(lane *front, lane *back, lane *normal, lane *sheets, const lane pair[2], lane sheet,
                               lane_mask along, lane weight, lane own)
{
    const lane of_plane = lane_min(lane_abs(sheet), own); /* what the pixel's own plane has of it */
    const lane plus = lane_sub(pair[0], of_plane), minus = lane_sub(pair[1], of_plane);
    const lane left = cone_less(sheet, own);
    *front = lane_add(*front, lane_mul(lane_pick(along, minus, plus), weight));
    *back = lane_add(*back, lane_mul(lane_pick(along, plus, minus), weight));
    *normal = lane_add(*normal, lane_mul(lane_add(lane_sub(pair[0], pair[1]), left), weight));
    *sheets = lane_add(*sheets, lane_mul(left, weight));
}

/* One voxel's part. own: what the plane that goes through it has of each axis; 0 for others. */
LANE_PART void cone_add(cone_sum *sum, const lmb_cone_job *job, const cone_rays *rays, lanei at, lane weight, lane own)
{
    lane xy[4], z[4], n[4], light[4];
    const lanei three = lanei_mul(at, lanei_splat(3)), six = lanei_add(three, three);
    lane_gather_rgba_f32(xy, job->cover, three);
    lane_gather_rgba_f32(z, job->cover, lanei_add(three, lanei_splat(1)));
    lane_gather_rgba_f32(n, job->cover, lanei_add(three, lanei_splat(2)));
    cone_add_axis(&sum->front.x, &sum->back.x, &sum->normal.x, &sum->sheets.x, xy, n[0], rays->along[0], weight,
                  lane_mul(own, rays->own.x));
    cone_add_axis(&sum->front.y, &sum->back.y, &sum->normal.y, &sum->sheets.y, xy + 2, n[1], rays->along[1], weight,
                  lane_mul(own, rays->own.y));
    cone_add_axis(&sum->front.z, &sum->back.z, &sum->normal.z, &sum->sheets.z, z, n[2], rays->along[2], weight,
                  lane_mul(own, rays->own.z));
    for (int k = 0; k < 3; ++k) {
        for (int b = 0; b <= rays->both[k]; ++b) {
            const lane share = lane_mul(weight, b ? rays->back[k] : rays->front[k]);
            const lanei lobe = b ? lanei_sub(lanei_splat(4 * k + 1), rays->side[k]) : rays->side[k];
            lane_gather_rgba_f32(light, job->light, lanei_add(six, lobe));
            sum->light.x = lane_add(sum->light.x, lane_mul(light[0], share));
            sum->light.y = lane_add(sum->light.y, lane_mul(light[1], share));
            sum->light.z = lane_add(sum->light.z, lane_mul(light[2], share));
        }
    }
}

/* A level at `at`, leaves from the corner. */
LANE_PART void cone_level(cone_sum *sum, const lmb_cone_job *job, const cone_rays *rays, lane3 at, int32_t level,
                          float share)
{
    const float wide = (float)(1 << level);
    const lane zero = lane_splat(0.0f), reach = lane_mul(rays->half, lane_splat(wide));
    const lane per_reach = lane_div(lane_splat(0.5f), lane_max(reach, lane_splat(0.25f)));
    const cone_axis x = cone_axis_of(at.x, level, job->depth), y = cone_axis_of(at.y, level, job->depth),
                    z = cone_axis_of(at.z, level, job->depth);
    for (int k = 0; k < 8; ++k) {
        const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        const lane_mask inside = mask_and(x.inside[i], mask_and(y.inside[j], z.inside[l]));
        lanei voxel = cone_voxel(job, job->depth - level, x.cell[i], y.cell[j], z.cell[l]);
        voxel = lanei_pick(inside, voxel, lanei_splat(0));
        const lane3 middle = {lane_mul(lane_add(x.middle, lane_splat((float)i)), lane_splat(wide)),
                              lane_mul(lane_add(y.middle, lane_splat((float)j)), lane_splat(wide)),
                              lane_mul(lane_add(z.middle, lane_splat((float)l)), lane_splat(wide))};
        const lane height = lane3_dot(lane3_sub(middle, rays->origin), rays->towards);
        lane weight = lane_mul(lane_mul(x.weight[i], y.weight[j]), lane_mul(z.weight[l], lane_splat(share)));
        weight = lane_keep(lane_lt(lane_sub(zero, reach), height), weight);
        const lane front = lane_min(lane_add(lane_mul(height, per_reach), lane_splat(0.5f)), lane_splat(1.0f));
        sum->space = lane_add(sum->space, lane_mul(weight, lane_max(front, zero)));
        if (mask_bits(lanei_lt(lanei_splat(7), voxel)) == 0) {
            continue;
        }
        cone_add(sum, job, rays, voxel, weight, lane_keep(lane_lt(height, reach), lane_splat(1.0f / wide)));
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
 * it goes forward and what back differ by d_a. Without this a cone would pass between walls that it is wider than. */
LANE_PART void cone_part(cone_rays *rays, lane3 d, float spread)
{
    const lane zero = lane_splat(0.0f), along[3] = {lane_abs(d.x), lane_abs(d.y), lane_abs(d.z)};
    for (int k = 0; k < 3; ++k) {
        lane mean = along[k];
        if (spread > 0.0f) {
            const lane q = lane_min(lane_mul(along[k], lane_splat(1.0f / spread)), lane_splat(1.0f));
            const lane bent = lane_add(lane_splat(1.0f / 3.0f),
                                       lane_mul(lane_mul(q, q), lane_sub(lane_splat(1.0f),
                                                                         lane_mul(q, lane_splat(1.0f / 3.0f)))));
            mean = lane_pick(lane_lt(along[k], lane_splat(spread)), lane_mul(bent, lane_splat(spread)), mean);
        }
        const lane back = lane_mul(lane_sub(mean, along[k]), lane_splat(0.5f));
        /* Under 2^-12 is none: what it is multiplied with stays a normal number. */
        rays->back[k] = lane_keep(lane_lt(lane_splat(1.0f / 4096.0f), back), back);
        rays->front[k] = lane_sub(mean, rays->back[k]);
        rays->front[k] = lane_keep(lane_lt(lane_splat(1.0f / 4096.0f), rays->front[k]), rays->front[k]);
        rays->both[k] = mask_bits(lane_lt(zero, rays->back[k])) != 0;
    }
}

/* One step: what it adds, and what it leaves open. */
LANE_PART lane cone_step(lane3 *rgb, const lmb_cone_job *job, const cone_rays *rays, lane3 at, lane3 d, int32_t i,
                         lane open)
{
    const lmb_cone_step *step = &job->step[i];
    cone_sum sum;
    sum.front = sum.back = sum.normal = sum.sheets = sum.light = lane3_splat(0.0f, 0.0f, 0.0f);
    sum.space = lane_splat(0.0f);
    cone_level(&sum, job, rays, at, step->level, step->finer);
    if (step->finer < 1.0f) {
        cone_level(&sum, job, rays, at, step->level + 1, 1.0f - step->finer);
    }
    const lane3 met = {lane_add(lane_mul(sum.front.x, rays->front[0]), lane_mul(sum.back.x, rays->back[0])),
                       lane_add(lane_mul(sum.front.y, rays->front[1]), lane_mul(sum.back.y, rays->back[1])),
                       lane_add(lane_mul(sum.front.z, rays->front[2]), lane_mul(sum.back.z, rays->back[2]))};
    const lane cover = lane_add(lane_add(met.x, met.y), met.z), crossed = cone_crossed(cover, met, sum.normal, d);
    const lane space = lane_max(sum.space, lane_splat(0.25f));
    const lane taken = lane_min(open, lane_div(lane_mul(crossed, lane_splat(step->length)), space));
    const lane scale = lane_div(taken, cone_shown(cover, sum.sheets, d, rays->back));
    *rgb = lane3_add(*rgb, lane3_scale(sum.light, scale));
    return lane_sub(open, taken);
}

LANE_PART lane cone_follow(lane3 *rgb, const lmb_cone_job *job, cone_rays *rays, lane3 d)
{
    const float side = (float)(1 << job->depth);
    float spread = -1.0f;
    lane open = lane_splat(1.0f);
    *rgb = lane3_splat(0.0f, 0.0f, 0.0f);
    for (int32_t i = 0; i < job->steps; ++i) {
        const lmb_cone_step *step = &job->step[i];
        const float margin = (float)(1 << step->level); /* half a voxel of the coarser level still has a part */
        const lane3 at = lane3_add(rays->origin, lane3_scale(d, lane_splat(step->at * job->per_leaf)));
        const lane low = lane_min(lane_min(at.x, at.y), at.z), high = lane_max(lane_max(at.x, at.y), at.z);
        if (mask_bits(mask_and(lane_lt(lane_splat(-margin), low), lane_lt(high, lane_splat(side + margin)))) == 0) {
            continue;
        }
        if (step->spread != spread) {
            spread = step->spread;
            cone_part(rays, d, spread);
        }
        open = cone_step(rgb, job, rays, at, d, i, open);
        if (mask_bits(lane_lt(lane_splat(1.0f / 1024.0f), open)) == 0) {
            break;
        }
    }
    return open;
}

static void KERNEL(cone)(lmb_cone_seen *out, const lmb_cone_job *job, const lmb_tile *tile,
                         float direction[3][LMB_TILE_PIXELS])
{
    const lane zero = lane_splat(0.0f);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane3 d = {lane_load(direction[0] + k), lane_load(direction[1] + k), lane_load(direction[2] + k)};
        const lane3 at = {lane_load(tile->position[0] + k), lane_load(tile->position[1] + k),
                          lane_load(tile->position[2] + k)};
        const lane along[3] = {d.x, d.y, d.z};
        cone_rays rays;
        lane3 rgb;
        rays.origin = lane3_scale(lane3_sub(at, lane3_of(job->low)), lane_splat(job->per_leaf));
        rays.towards.x = lane_load(tile->face[0] + k);
        rays.towards.y = lane_load(tile->face[1] + k);
        rays.towards.z = lane_load(tile->face[2] + k);
        rays.own = lane3_abs(rays.towards);
        rays.half = lane_mul(lane_add(lane_add(rays.own.x, rays.own.y), rays.own.z), lane_splat(0.5f));
        for (int i = 0; i < 3; ++i) {
            rays.along[i] = lane_lt(zero, along[i]);
            rays.side[i] = lanei_pick(rays.along[i], lanei_splat(2 * i + 1), lanei_splat(2 * i));
        }
        const lane open = cone_follow(&rgb, job, &rays, d);
        lane_store(out->rgb[0] + k, rgb.x);
        lane_store(out->rgb[1] + k, rgb.y);
        lane_store(out->rgb[2] + k, rgb.z);
        lane_store(out->open + k, open);
    }
}
