/* node_bounds.inl: light of tree nodes at a pixel cluster: estimate, upper bound and error. Layer 6.              [V27]
 *
 * Lanes are nodes, computed independently.
 *
 * A node gives at most U = M cosP cosG / (pi d^2), with the largest cosines, and the least distance d between the boxes
 * of node and pixel cluster. Include gather.inl first, for the disc formula. */

#define BOUNDS_SECOND  0.5f  /* of R^2 / d^2: boxes hold whole texels, and discs are correct to second order */
#define BOUNDS_NOISE   9.5367432e-7f /* 2^-20 of the distance: rounding of heights over planes */
#define BOUNDS_ROUNDED 1e-4f /* above the rounding of a bound, relative to the bound and to the distance */

/* Shared by both bounds. */
typedef struct bounds_pair {
    lane3 normal;        /* of the node */
    lane3 to;            /* from the centre of the pixel cluster to that of the node's box */
    lane m, half2;       /* flux; half the box's diagonal, squared */
    lane reach;          /* no two points of both boxes are farther apart */
    lane sine;           /* of the widest angle of the node's normals; 1 over 90 degrees */
    lane apart2;         /* squared least distance of the boxes */
    lane own_p,
        cluster_p; /* extent of the node's box and of the pixel cluster along the cluster's normal */
    lane own_g, cluster_g; /* the same along the node's normal */
} bounds_pair;

static inline lane3 bounds_load3(const lmb_node_bounds *w, int plane, int k)
{
    lane3 r;
    r.x = lane_load(w->node[plane] + k);
    r.y = lane_load(w->node[plane + 1] + k);
    r.z = lane_load(w->node[plane + 2] + k);
    return r;
}

static inline lane bounds_length(lane3 v) { return lane_sqrt(lane3_dot(v, v)); }

static inline lane bounds_sine(lane cosine)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane sine = lane_sqrt(lane_max(lane_sub(one, lane_mul(cosine, cosine)), zero));
    return lane_pick(lane_lt(zero, cosine), sine, one);
}

/* Components of a vector along three axes. */
static inline lane3 lane3_along(lane3 v, const lane3 axis[3])
{
    lane3 r;
    r.x = lane3_dot(v, axis[0]);
    r.y = lane3_dot(v, axis[1]);
    r.z = lane3_dot(v, axis[2]);
    return r;
}

LANE_INLINE bounds_pair bounds_begin(const lmb_node_bounds *w, int k, const lmb_pixel_cluster *p)
{
    const lane3 across = bounds_load3(w, LMB_BOUNDS_ACROSS, k), half = bounds_load3(w, LMB_BOUNDS_HALF, k);
    const lane radius = lane_load(w->node[LMB_BOUNDS_RADIUS] + k);
    const lane3 other = lane3_splat(p->half[0], p->half[1], p->half[2]);
    bounds_pair r;
    r.normal = bounds_load3(w, LMB_BOUNDS_NORMAL, k);
    r.to = lane3_sub(bounds_load3(w, LMB_BOUNDS_MIDDLE, k), lane3_of(p->centre));
    r.m = lane_load(w->node[LMB_BOUNDS_FLUX] + k);
    r.half2 = lane_mul(radius, radius);
    r.reach = lane_add(lane_add(bounds_length(r.to), radius), bounds_length(other));
    r.sine = bounds_sine(lane_load(w->node[LMB_BOUNDS_COSINE] + k));
    const lane3 axis[3] = {r.normal, across, lane3_cross(r.normal, across)};
    lane3 turn[3]; /* absolute components of the pixel cluster's axes along the node's */
    lane3 to;      /* along the pixel cluster's axes */
    for (int i = 0; i < 3; ++i) {
        turn[i] = lane3_abs(lane3_along(lane3_of(p->axis[i]), axis));
    }
    to.x = lane3_dot(lane3_of(p->axis[0]), r.to);
    to.y = lane3_dot(lane3_of(p->axis[1]), r.to);
    to.z = lane3_dot(lane3_of(p->axis[2]), r.to);
    lane3 own, cluster; /* extent of the node along the pixel cluster's axes, and of the cluster along the node's */
    own.x = lane_min(lane3_dot(turn[0], half), radius);
    own.y = lane_min(lane3_dot(turn[1], half), radius);
    own.z = lane_min(lane3_dot(turn[2], half), radius);
    cluster = lane3_add(lane3_add(lane3_scale(turn[0], other.x), lane3_scale(turn[1], other.y)),
                        lane3_scale(turn[2], other.z));
    const lane3 apart_p = lane3_gap(to, lane3_add(own, other));
    const lane3 apart_g = lane3_gap(lane3_along(r.to, axis), lane3_add(half, cluster));
    r.apart2 = lane_max(lane3_dot(apart_p, apart_p), lane3_dot(apart_g, apart_g));
    r.own_p = lane_min(lane3_dot(lane3_abs(lane3_along(lane3_of(p->normal), axis)), half), radius);
    r.cluster_p = lane_splat(p->thick);
    r.own_g = half.x;
    r.cluster_g = cluster.x;
    return r;
}

/* Heuristic bound. A node gives at most U, from the largest cosines and the least distance. As one disc it has a
 * second-order error: U min(1, R^2 / 2 d^2 + sin^2 a), with R the radius of the node's box and a the widest angle of
 * the normals. If a horizon, the pixel cluster's or the node's own, passes through the node, the error is first order:
 * a quarter of U if the node's centre lies on the horizon and counts as 0. This holds for all but a few in thousands of
 * nodes, but is not proven. (The node's radiosity is not a bound: it is a mean, and the brightest part may fill the
 * sky. With it, rooms lost a tenth of their later bounces.) Returns the nodes that do not face away by more than
 * rounding: nodes in the pixel cluster's own plane give no light, and are not split to find that out. The exact shapes
 * of near leaves are consistent: clipped to the horizon, they give at most the share of the sky below the angle noise /
 * d, with d the distance. */
LANE_INLINE lane_mask bounds_rule(lmb_node_bounds *w, int k, const lmb_pixel_cluster *p, const bounds_pair *n)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), two = lane_splat(2.0f), bent = lane_splat(p->sine);
    const lane3 pn = lane3_of(p->normal), pc = lane3_of(p->centre);
    const lane sines_p = lane_mul(bent, n->reach), sines_g = lane_mul(n->sine, n->reach);
    const lane up = lane_add(lane_add(lane_add(lane3_dot(pn, n->to), n->own_p), n->cluster_p), sines_p);
    const lane out = lane_add(lane_sub(lane_add(n->own_g, n->cluster_g), lane3_dot(n->normal, n->to)), sines_g);
    const lane noise = lane_add(lane_splat(p->noise), lane_mul(lane_splat(BOUNDS_NOISE), n->reach));
    const lane_mask faces = mask_and(mask_and(lane_lt(noise, up), lane_lt(noise, out)), lane_lt(zero, n->m));
    if (mask_bits(faces) == 0) {
        lane_store(w->upper + k, zero);
        return faces;
    }
    /* A node that contains the pixel cluster may give any amount. It gets a value large enough to be split first, but
     * small enough that no rounding of it remains in the sum of errors afterwards. */
    const lane lower = lane_max(lane_mul(lane_splat(1e-6f), n->half2), lane_splat(1e-24f));
    const lane d2 = lane_max(n->apart2, lower), d = lane_sqrt(d2);
    const lane upper =
        lane_mul(lane_mul(lane_div(lane_mul(n->m, lane_splat(LMB_INVERSE_PI)), d2), lane_min(lane_div(up, d), one)),
                 lane_min(lane_div(out, d), one));
    const lane over = lane_mul(two, lane_add(lane_add(n->own_p, n->cluster_p), sines_p));
    const lane before = lane_mul(two, lane_add(lane_add(n->own_g, n->cluster_g), sines_g));
    const lane size2 = lane_div(lane_mul(lane_splat(BOUNDS_SECOND), n->half2), d2);
    const lane bend = lane_mul(n->sine, n->sine);
    const lane second = lane_add(size2, bend);
    const lane_mask crossed = mask_or(lane_lt(up, over), lane_lt(out, before));
    const lane size = lane_pick(crossed, lane_max(second, lane_splat(0.25f)), second);
    const lane3 at = lane3_sub(bounds_load3(w, LMB_BOUNDS_CENTRE, k), pc);
    const lane factor = disc_factor(at, lane_max(lane3_dot(at, at), lane_splat(1e-24f)), pn, n->normal,
                                    lane_load(w->node[LMB_BOUNDS_AREA] + k));
    const lane sent = lane_mul(n->m, lane_load(w->node[LMB_BOUNDS_AGREEMENT] + k));
    lane_store(w->value + k, lane_mul(sent, factor));
    lane_store(w->error + k, lane_mul(upper, lane_min(size, one)));
    lane_store(w->upper + k, lane_keep(faces, upper));
    return faces;
}

/* Bounds for every pixel and every texel in the node: value is the minimum light of any pixel, error the largest
 * difference between the node's disc and the sum of the texels. With least and largest cosines and distances and s = A
 * / (pi d^2), the disc formula (gather.inl) lies between M / (pi D^2) (c (1 - 2 s) - s) and M / (pi d^2) (c (1 + s) +
 * cosG^2 s), since -(c + cosG^2) <= t <= 2 c + 1. So do exact shapes of near leaves. */
LANE_INLINE lane_mask bounds_conservative(lmb_node_bounds *w, int k, const lmb_pixel_cluster *p, const bounds_pair *n)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), rounded = lane_splat(BOUNDS_ROUNDED);
    const lane slack = lane_mul(rounded, n->reach), power = lane_mul(n->m, lane_splat(LMB_INVERSE_PI));
    const lane up = lane3_dot(lane3_of(p->normal), n->to), out = lane_sub(zero, lane3_dot(n->normal, n->to));
    const lane ups = lane_add(lane_add(lane_add(n->own_p, n->cluster_p), lane_mul(lane_splat(p->face_sine), n->reach)),
                              slack);
    const lane outs = lane_add(lane_add(lane_add(n->own_g, n->cluster_g), lane_mul(n->sine, n->reach)), slack);
    const lane d2 = lane_max(n->apart2, lane_splat(1e-24f)), d = lane_sqrt(d2);
    const lane s = lane_div(lane_mul(lane_load(w->node[LMB_BOUNDS_AREA] + k), lane_splat(LMB_INVERSE_PI)), d2);
    const lane high_p = lane_min(lane_div(lane_max(lane_add(up, ups), zero), d), one);
    const lane high_g = lane_min(lane_div(lane_max(lane_add(out, outs), zero), d), one);
    const lane low_p = lane_div(lane_max(lane_sub(up, ups), zero), n->reach);
    const lane low_g = lane_div(lane_max(lane_sub(out, outs), zero), n->reach);
    const lane both = lane_add(lane_mul(lane_mul(high_p, high_g), lane_add(one, s)),
                               lane_mul(lane_mul(high_g, high_g), s));
    const lane upper = lane_mul(lane_div(power, d2), both);
    const lane bottom = lane_sub(lane_mul(lane_mul(low_p, low_g), lane_sub(one, lane_mul(lane_splat(2.0f), s))), s);
    const lane lower = lane_mul(lane_div(power, lane_mul(n->reach, n->reach)),
                                lane_keep(lane_lt(s, lane_splat(0.5f)), bottom));
    const lane value = lane_mul(lane_max(lower, zero), lane_sub(one, rounded));
    lane_store(w->value + k, value);
    lane_store(w->error + k, lane_sub(lane_mul(upper, lane_add(one, rounded)), value));
    return mask_and(mask_and(lane_lt(zero, n->m), lane_lt(zero, high_p)), lane_lt(zero, high_g));
}

static uint32_t KERNEL(node_bounds)(lmb_node_bounds *inout, int32_t count, const lmb_pixel_cluster *cluster,
                                    int32_t conservative)
{
    uint32_t faces = 0;
    for (int k = 0; k < count; k += LANES) {
        const bounds_pair n = bounds_begin(inout, k, cluster);
        lane_mask own = bounds_rule(inout, k, cluster, &n);
        if (conservative) {
            own = bounds_conservative(inout, k, cluster, &n);
        }
        faces |= mask_bits(own) << k;
    }
    return faces;
}
