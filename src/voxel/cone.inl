/* cone.inl: radiance that cones gather from voxels. Layer 5. [M20-M22]
 *
 * Lanes are pixels; a cone's samples lie at the same distances for all of them, so all lanes read the same levels.
 *
 * A sample is read between eight voxels' middles of two levels. With d the ray to a voxel's middle, which is as long as
 * the axis is by then, per leaf of way along the axis:
 *   coverage  C = sum |d_a| cover_a of the side that faces the viewer: how often a ray meets a surface (cone_crossed)
 *   light     E = sum |d_a| light_a of that side: radiance x how often
 * A cone's rays go apart: by its axis alone it would pass between walls that it is wider than, and a wall that it
 * grazes would count more often than once, for the rays that come to it late go along it more than the axis does.
 * Where voxels are wider than the cone, their middles say nothing and d is the axis.
 * What rays meet adds up to 1, then all is hidden: surfaces that follow each other in a sample or on the way are taken
 * to lie side by side. So a wall is whole whatever level it is read from, and half a wall is half: exponentials would
 * need a wall to be several times as thick as it is.
 *   The surfaces' radiance is E / V, V the coverage that belongs to E: C, less what double-sided surfaces have along
 * axes on which they turn away. For one flat, evenly lit surface it is exact.
 *   The pixel's own plane is known: voxels behind it are left out, those that it goes through lose what it alone has
 * there, and what is left is divided by the sample's share in front of it. What is double-sided and faces the other way
 * may be the same surface from behind, or another one that the pixel's touches: a floor under what stands on it. */

typedef struct cone_rays {
    lane3 origin, towards; /* leaves from the cube's corner; the pixels' faces' normals */
    lane3 d, axis;         /* the axis; and without parts that are next to none */
    float apart;           /* of the step */
} cone_rays;

typedef struct cone_sum {
    lane3 met;    /* |d_a| x coverage against the rays, by axis */
    lane3 flat;   /* d_a x the surfaces' normal */
    lane3 sheets; /* of that, what is double-sided */
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

/* The part of double-sided coverage along an axis that may be the pixel's own plane: all of it, or what its front
 * faces. */
LANE_INLINE lane cone_own(lane sheet, lane towards, int32_t faced)
{
    const lane zero = lane_splat(0.0f);
    return faced ? lane_max(lane_pick(lane_lt(towards, zero), lane_sub(zero, sheet), sheet), zero) : lane_abs(sheet);
}

/* Adds coverage along one axis. mine: the part of it that is the pixel's own plane; d: how far the ray goes. */
LANE_INLINE void cone_add_axis(lane *met, lane *flat, lane *sheets, const lane pair[2], lane sheet, lane d,
                               lane weight, lane mine)
{
    const lane zero = lane_splat(0.0f);
    const lane plus = lane_max(lane_sub(pair[0], mine), zero), minus = lane_max(lane_sub(pair[1], mine), zero);
    const lane left = lane_sub(sheet, lane_pick(lane_lt(sheet, zero), lane_sub(zero, mine), mine));
    const lane way = lane_mul(weight, d), far = lane_abs(way);
    *met = lane_add(*met, lane_mul(lane_pick(lane_lt(zero, d), minus, plus), far));
    *flat = lane_add(*flat, lane_mul(lane_add(lane_sub(plus, minus), left), way));
    *sheets = lane_add(*sheets, lane_mul(left, way));
}

LANE_INLINE void cone_add_light(lane3 *sum, const lmb_cone_job *job, lanei at, lane d, int axis, lane weight)
{
    const lane_mask along = lane_lt(lane_splat(0.0f), d);
    const lane share = lane_mul(weight, lane_abs(d));
    lane light[4];
    lane_gather_rgba_f32(light, job->light,
                         lanei_add(at, lanei_pick(along, lanei_splat(2 * axis + 1), lanei_splat(2 * axis))));
    sum->x = lane_add(sum->x, lane_mul(light[0], share));
    sum->y = lane_add(sum->y, lane_mul(light[1], share));
    sum->z = lane_add(sum->z, lane_mul(light[2], share));
}

/* One voxel's part. own: what a plane across the voxel has of coverage; 0 for voxels without the pixel's own. */
LANE_PART void cone_add(cone_sum *sum, const lmb_cone_job *job, const cone_rays *rays, const lane3 *ray, lanei at,
                        lane weight, lane own)
{
    const lane3 max = lane3_scale(lane3_abs(rays->towards), own);
    const lanei three = lanei_mul(at, lanei_splat(3)), six = lanei_add(three, three);
    lane pair[4], sheet[4];
    lane3 mine;
    lane_gather_rgba_f32(sheet, job->cover, lanei_add(three, lanei_splat(2)));
    mine.x = lane_min(cone_own(sheet[0], rays->towards.x, job->faced), max.x);
    mine.y = lane_min(cone_own(sheet[1], rays->towards.y, job->faced), max.y);
    mine.z = lane_min(cone_own(sheet[2], rays->towards.z, job->faced), max.z);
    lane_gather_rgba_f32(pair, job->cover, three);
    cone_add_axis(&sum->met.x, &sum->flat.x, &sum->sheets.x, pair, sheet[0], ray->x, weight, mine.x);
    cone_add_axis(&sum->met.y, &sum->flat.y, &sum->sheets.y, pair + 2, sheet[1], ray->y, weight, mine.y);
    lane_gather_rgba_f32(pair, job->cover, lanei_add(three, lanei_splat(1)));
    cone_add_axis(&sum->met.z, &sum->flat.z, &sum->sheets.z, pair, sheet[2], ray->z, weight, mine.z);
    cone_add_light(&sum->light, job, six, ray->x, 0, weight);
    cone_add_light(&sum->light, job, six, ray->y, 1, weight);
    cone_add_light(&sum->light, job, six, ray->z, 2, weight);
}

/* Parts under 2^-12 are none: what they are multiplied with stays a normal number. */
LANE_INLINE lane cone_part(lane part)
{
    return lane_keep(lane_lt(lane_splat(1.0f / 4096.0f), lane_abs(part)), part);
}

LANE_INLINE lane3 cone_parts(lane3 d)
{
    const lane3 r = {cone_part(d.x), cone_part(d.y), cone_part(d.z)};
    return r;
}

/* A level at `at`, leaves from the corner. */
NOINLINE void cone_level(cone_sum *sum, const lmb_cone_job *job, const cone_rays *rays, const lane3 *at,
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
        const lane3 away = lane3_sub(middle, rays->origin);
        const lane height = lane3_dot(away, rays->towards);
        const lane front = lane_add(lane_div(lane_mul(height, half), lane_max(reach, half)), half);
        const lane all = lane_mul(lane_mul(cone_weight(&x, i), cone_weight(&y, j)),
                                  lane_mul(cone_weight(&z, l), lane_splat(share)));
        const lane weight = lane_keep(lane_lt(lane_sub(zero, reach), height), all);
        const lanei voxel = cone_voxel(job, job->depth - level, cx, cy, cz);
        sum->space = lane_add(sum->space, lane_mul(weight, lane_min(lane_max(front, zero), lane_splat(1.0f))));
        if (mask_bits(lanei_lt(lanei_splat(7), voxel)) != 0) {
            const lane3 ray = rays->apart > 0.0f ? cone_parts(lane3_scale(away, lane_splat(rays->apart))) : rays->axis;
            cone_add(sum, job, rays, &ray, voxel, weight, lane_keep(lane_lt(height, reach), lane_splat(1.0f / wide)));
        }
    }
}

/* The expected number of surfaces that a ray meets in a leaf. `met` is |d_a| cover_a; its sum is right for a corner
 * of walls, and too much for all else. Flat surfaces count |N . d|, and nothing where the ray leaves what is
 * single-sided: on a ball's far side the normal's parts face the ray along some axes. Round ones count the projection
 * of an ellipsoid with these areas, which is the root of the squares' sum. What is both counts by parts: the root of
 * the squares' sum with N's own part taken out and (N . d)^2 put in. */
LANE_INLINE lane cone_crossed(lane cover, const cone_sum *sum)
{
    const lane zero = lane_splat(0.0f);
    const lane twice = lane_add(lane_add(sum->sheets.x, sum->sheets.y), sum->sheets.z);
    const lane once = lane_sub(lane_add(lane_add(sum->flat.x, sum->flat.y), sum->flat.z), twice);
    const lane through = lane_add(lane_max(lane_sub(zero, once), zero), lane_abs(twice));
    const lane round = lane_sub(lane3_dot(sum->met, sum->met), lane3_dot(sum->flat, sum->flat));
    return lane_min(cover, lane_sqrt(lane_add(lane_mul(through, through), lane_max(round, zero))));
}

/* V of the head of this file: the part of C whose light shows. */
LANE_INLINE lane cone_shown(lane cover, const cone_sum *sum)
{
    const lane zero = lane_splat(0.0f), part[3] = {sum->sheets.x, sum->sheets.y, sum->sheets.z};
    const lane way = lane_add(lane_add(part[0], part[1]), part[2]);
    lane shown = cover;
    for (int k = 0; k < 3; ++k) {
        const lane against = lane_pick(lane_lt(way, zero), part[k], lane_sub(zero, part[k]));
        shown = lane_sub(shown, lane_max(against, zero));
    }
    return lane_max(shown, lane_add(lane_mul(cover, lane_splat(0.1f)), lane_splat(1e-12f)));
}

/* Adds the light of a step, and returns what the step leaves open. Under 1/1024 counts as closed, for each lane by
 * itself: so a lane does not depend on when others are done. */
NOINLINE lane cone_scale(lmb_cone_seen *out, int k, const cone_sum *sum, float length, lane open)
{
    const lane cover = lane_add(lane_add(sum->met.x, sum->met.y), sum->met.z),
               crossed = cone_crossed(cover, sum);
    const lane space = lane_max(sum->space, lane_splat(0.25f));
    const lane taken = lane_min(open, lane_div(lane_mul(crossed, lane_splat(length)), space));
    const lane scale = lane_div(taken, cone_shown(cover, sum));
    lane_store(out->rgb[0] + k, lane_add(lane_load(out->rgb[0] + k), lane_mul(sum->light.x, scale)));
    lane_store(out->rgb[1] + k, lane_add(lane_load(out->rgb[1] + k), lane_mul(sum->light.y, scale)));
    lane_store(out->rgb[2] + k, lane_add(lane_load(out->rgb[2] + k), lane_mul(sum->light.z, scale)));
    const lane left = lane_sub(open, taken);
    return lane_keep(lane_lt(lane_splat(1.0f / 1024.0f), left), left);
}

NOINLINE lane cone_step(lmb_cone_seen *out, int k, const lmb_cone_job *job, const cone_rays *rays,
                          const lmb_cone_step *step, lane open)
{
    const lane3 at = lane3_add(rays->origin, lane3_scale(rays->d, lane_splat(step->at * job->per_leaf)));
    cone_sum sum;
    sum.met = sum.flat = sum.sheets = sum.light = lane3_splat(0.0f, 0.0f, 0.0f);
    sum.space = lane_splat(0.0f);
    cone_level(&sum, job, rays, &at, step->level, step->finer);
    if (step->finer < 1.0f) {
        cone_level(&sum, job, rays, &at, step->level + 1, 1.0f - step->finer);
    }
    return cone_scale(out, k, &sum, step->length, open);
}

/* Is one of the samples in the cube, or up to half a voxel of the coarser level beside it, which it still reads? */
NOINLINE int cone_is_inside(const lmb_cone_job *job, const cone_rays *rays, const lmb_cone_step *step)
{
    const float margin = (float)(1 << step->level), side = (float)(1 << job->depth) + margin;
    const lane3 at = lane3_add(rays->origin, lane3_scale(rays->d, lane_splat(step->at * job->per_leaf)));
    const lane low = lane_min(lane_min(at.x, at.y), at.z), high = lane_max(lane_max(at.x, at.y), at.z);
    return mask_bits(mask_and(lane_lt(lane_splat(-margin), low), lane_lt(high, lane_splat(side)))) != 0;
}

/* Pixels without a surface are closed from the start: lanes that have no other end at once. */
LANE_PART lane cone_follow(lmb_cone_seen *out, int k, const lmb_cone_job *job, cone_rays *rays, lane depth)
{
    lane open = lane_keep(lane_lt(lane_splat(0.0f), depth), lane_splat(1.0f));
    for (int c = 0; c < 3; ++c) {
        lane_store(out->rgb[c] + k, lane_splat(0.0f));
    }
    for (int32_t i = 0; i < job->steps && mask_bits(lane_lt(lane_splat(0.0f), open)) != 0; ++i) {
        const lmb_cone_step *step = &job->step[i];
        if (!cone_is_inside(job, rays, step)) {
            continue;
        }
        rays->apart = step->apart;
        open = cone_step(out, k, job, rays, step, open);
    }
    return open;
}

/* Positions that are not finite, or so far that squared distances overflow, are moved to the corner: inactive lanes
 * must stay finite, because wider back ends compute more of them. */
LANE_INLINE lane cone_finite(lane v) { return lane_keep(lane_lt(lane_abs(v), lane_splat(1.0995116e12f)), v); }

LANE_INLINE lane3 cone_place(lane3 p)
{
    const lane3 r = {cone_finite(p.x), cone_finite(p.y), cone_finite(p.z)};
    return r;
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
        rays.origin = cone_place(lane3_scale(lane3_sub(at, lane3_of(job->low)), lane_splat(job->per_leaf)));
        rays.towards.x = lane_load(tile->face[0] + k);
        rays.towards.y = lane_load(tile->face[1] + k);
        rays.towards.z = lane_load(tile->face[2] + k);
        rays.d.x = lane_load(direction[0] + k);
        rays.d.y = lane_load(direction[1] + k);
        rays.d.z = lane_load(direction[2] + k);
        rays.axis = cone_parts(rays.d);
        lane_store(out->open + k, cone_follow(out, k, job, &rays, lane_load(tile->depth + k)));
    }
}
