/* cone.inl: radiance that cones gather from voxels. Layer 6. [M20-M22]
 *
 * Lanes are pixels. A cone's samples lie at the same distances for all pixels, so all lanes read the same levels.
 *
 * A sample is interpolated between the middles of eight voxels on two levels. Let d be the ray to a voxel's middle, as
 * long as the axis at that point, per leaf along the axis:
 * - coverage C = sum |d_a| cover_a of the side that faces the viewer: the mean number of surfaces that a ray meets
 *   (cone_crossed)
 * - light E = sum |d_a| light_a of that side: radiance times that number
 *
 * A cone's rays diverge. With the axis direction for all of them, the cone would pass between walls narrower than
 * itself. A grazed wall would also count more than once, because rays that arrive later run more along the wall than
 * the axis does. If voxels are wider than the cone, their middles give no direction and d is the axis.
 *
 * Coverage is summed up to 1, which hides all that lies behind. Surfaces that follow each other in a sample or along
 * the cone are assumed to lie side by side. So a wall is opaque on every level, and half a wall covers half.
 * Exponential falloff would need walls several times thicker.
 *
 * The surfaces' radiance is E / V. V is the coverage that belongs to E: C minus the coverage of double-sided surfaces
 * along axes on which they face away. This is exact for one flat, evenly lit surface.
 *
 * The pixel's own plane is known. Voxels behind the plane are skipped; voxels that it cuts lose the coverage of the
 * plane itself, and the rest is divided by the share of the sample in front of the plane. A double-sided surface that
 * faces the other way may be the same surface from behind, or another one that touches the pixel's: a floor under an
 * object. */

typedef struct cone_rays {
    lane3 origin, towards; /* leaves from the cube's corner; face normals of the pixels */
    lane3 d, axis;         /* the axis, and the axis without tiny components */
    float apart;           /* of the step */
} cone_rays;

typedef struct cone_sum {
    lane3 met;    /* |d_a| x coverage against the rays, by axis */
    lane3 flat;   /* d_a x normal of the surfaces */
    lane3 sheets; /* the double-sided part of `flat` */
    lane3 light;
    lane space; /* share of the sample in front of the pixel's plane */
} cone_sum;

/* The first of the two cells around a position on an axis, from -1, and the weight of the second, in steps of 1/256 so
 * that products of weights are not denormal. */
typedef struct cone_axis {
    lanei cell;
    lane second;
} cone_axis;

LANE_INLINE cone_axis cone_axis_of(lane at, int32_t level, int32_t depth)
{
    const float side = (float)(1 << (depth - level));
    const lane scaled = lane_mul(at, lane_splat(1.0f / (float)(1 << level)));
    /* Adds 1, so that trunc works as floor. */
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

/* Voxel indices of cells; under 8 if there is no voxel. */
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

/* The double-sided coverage along an axis that may be the pixel's own plane: all of it, or the part that the plane's
 * front faces. */
LANE_INLINE lane cone_own(lane sheet, lane towards, int32_t faced)
{
    const lane zero = lane_splat(0.0f);
    return faced ? lane_max(lane_pick(lane_lt(towards, zero), lane_sub(zero, sheet), sheet), zero) : lane_abs(sheet);
}

/* Adds coverage along one axis. mine: the part that is the pixel's own plane; d: length of the ray along the axis. */
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

/* Adds one voxel. own: coverage of a plane through the voxel; 0 if the pixel's plane does not cut it. */
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

/* Flushes components under 2^-12 to zero, so that products with them stay normal numbers. */
LANE_INLINE lane cone_part(lane part)
{
    return lane_keep(lane_lt(lane_splat(1.0f / 4096.0f), lane_abs(part)), part);
}

LANE_INLINE lane3 cone_parts(lane3 d)
{
    const lane3 r = {cone_part(d.x), cone_part(d.y), cone_part(d.z)};
    return r;
}

/* Reads one level at `at`, in leaves from the corner. */
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

/* Expected number of surfaces that a ray meets in a leaf. `met` is |d_a| cover_a; the sum of `met` is right for a
 * corner of walls and too large otherwise. Flat surfaces count |N . d|; a single-sided one counts 0 if the ray leaves
 * it, because on the far side of a ball some components of the normal still face the ray. Round surfaces count the
 * projection of an ellipsoid with these areas, the root of the sum of squares. Mixtures take the root of the sum of
 * squares with N's part replaced by (N . d)^2. */
LANE_INLINE lane cone_crossed(lane cover, const cone_sum *sum)
{
    const lane zero = lane_splat(0.0f);
    const lane twice = lane_add(lane_add(sum->sheets.x, sum->sheets.y), sum->sheets.z);
    const lane once = lane_sub(lane_add(lane_add(sum->flat.x, sum->flat.y), sum->flat.z), twice);
    const lane through = lane_add(lane_max(lane_sub(zero, once), zero), lane_abs(twice));
    const lane round = lane_sub(lane3_dot(sum->met, sum->met), lane3_dot(sum->flat, sum->flat));
    return lane_min(cover, lane_sqrt(lane_add(lane_mul(through, through), lane_max(round, zero))));
}

/* V in the comment at the top: the part of C with visible light. */
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

/* Adds the light of a step and returns the share that stays open. A share under 1/1024 counts as closed, separately for
 * each lane, so that a lane does not depend on when the others end. */
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

/* Does a sample lie in the cube, or within half a voxel of the coarser level beside it, which still contributes? */
NOINLINE int cone_is_inside(const lmb_cone_job *job, const cone_rays *rays, const lmb_cone_step *step)
{
    const float margin = (float)(1 << step->level), side = (float)(1 << job->depth) + margin;
    const lane3 at = lane3_add(rays->origin, lane3_scale(rays->d, lane_splat(step->at * job->per_leaf)));
    const lane low = lane_min(lane_min(at.x, at.y), at.z), high = lane_max(lane_max(at.x, at.y), at.z);
    return mask_bits(mask_and(lane_lt(lane_splat(-margin), low), lane_lt(high, lane_splat(side)))) != 0;
}

/* Pixels without a surface start closed, so that a vector of them ends at once. */
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

/* Moves positions that are not finite, or so far off that squared distances overflow, to the corner: inactive lanes
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
