/* plane.inl: the planes of LANES triangles, and barycentrics of points on them. Layer 3.
 *
 * Values are relative to the eye and scaled by each triangle's longest edge, so that squares of tiny edges are not
 * denormal. */

typedef struct plane_lanes {
    lane3 corner;      /* corner 0 */
    lane3 g1, g2;      /* barycentrics: b1 = (p - corner).g1, b2 = (p - corner).g2 */
    lane3 plane, face; /* unit normal; the same, turned to the viewer */
    lane w_min, w_max; /* of the corners, along the view axis */
} plane_lanes;

LANE_INLINE lane plane_w(lane3 corner, const lmb_rays *rays)
{
    return lane_mul(lane3_dot(lane3_of(rays->back), corner), lane_splat(-1.0f));
}

LANE_INLINE void plane_range(plane_lanes *out, const lane3 seen[3], const lmb_rays *rays)
{
    const lane a = plane_w(seen[0], rays), b = plane_w(seen[1], rays), c = plane_w(seen[2], rays);
    lane low = lane_min(lane_min(a, b), c);
    if (rays->perspective) {
        low = lane_max(low, lane_splat(rays->near_m));
    }
    out->w_min = low;
    out->w_max = lane_max(lane_max(lane_max(a, b), c), low);
}

/* `corner` in the world, m. */
LANE_INLINE plane_lanes plane_setup(const lane3 corner[3], const lmb_rays *rays)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane3 eye = lane3_of(rays->eye), back = lane3_of(rays->back);
    const lane3 seen[3] = {lane3_sub(corner[0], eye), lane3_sub(corner[1], eye), lane3_sub(corner[2], eye)};
    plane_lanes r;
    lane3 e1 = lane3_sub(corner[1], corner[0]), e2 = lane3_sub(corner[2], corner[0]);
    const lane longest = lane_sqrt(lane_max(lane3_dot(e1, e1), lane3_dot(e2, e2)));
    const lane shrink = lane_pick(lane_lt(lane_splat(1e-12f), longest), lane_div(one, longest), zero);
    e1 = lane3_scale(e1, shrink);
    e2 = lane3_scale(e2, shrink);
    const lane3 n = lane3_cross(e1, e2);
    const lane nn = lane3_dot(n, n);
    const lane_mask fine = lane_lt(lane_splat(1e-24f), nn);
    const lane gain = lane_pick(fine, lane_div(shrink, nn), zero);
    r.corner = seen[0];
    r.g1 = lane3_scale(lane3_cross(e2, n), gain);
    r.g2 = lane3_scale(lane3_cross(n, e1), gain);
    r.plane = lane3_pick(fine, lane3_scale(n, lane_div(one, lane_sqrt(nn))), back);
    const lane turned =
        rays->perspective ? lane3_dot(r.plane, r.corner) : lane_mul(lane3_dot(r.plane, back), lane_splat(-1.0f));
    r.face = lane3_pick(lane_lt(zero, turned), lane3_scale(r.plane, lane_splat(-1.0f)), r.plane);
    plane_range(&r, seen, rays);
    return r;
}
