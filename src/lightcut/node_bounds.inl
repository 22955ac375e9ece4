/* node_bounds.inl: light of tree nodes at a pixel cluster: estimate, upper bound and error. Layer 7.              [V27]
 *
 * Lanes are nodes, each computed for itself.
 *
 * A node gives at most U = M cosP cosG / (pi d^2), with the largest cosines and the least distance d between its box
 * and the pixel cluster's. Include gather.inl first: the disc formula is its. */

#define BOUNDS_SECOND  0.5f  /* of R^2 / d^2: boxes hold whole texels, of which discs are right to second order */
#define BOUNDS_NOISE   9.5367432e-7f /* 2^-20: of the distance; what rounding takes of heights over planes */
#define BOUNDS_ROUNDED 1e-4f /* more than rounding takes of a bound, of its own size and of the distance */

/* What both bounds begin with. */
typedef struct bounds_pair {
    lane3 normal;        /* the node's */
    lane3 to;            /* from the pixel cluster's middle to that of the node's box */
    lane m, half2;       /* flux; half the box's diagonal, squared */
    lane reach;          /* no two points of both are farther apart */
    lane sine;           /* of the widest angle of the node's normals; 1 over 90 degrees */
    lane apart2;         /* squared least distance of the boxes */
    lane own_p,
        cluster_p; /* how far the node's box and the pixel cluster reach along the cluster's normal */
    lane own_g, cluster_g; /* and along the node's */
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

/* A vector along three axes. */
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
    lane3 turn[3]; /* the pixel cluster's axes along the node's, all as positive */
    lane3 to;      /* along the pixel cluster's axes */
    for (int i = 0; i < 3; ++i) {
        turn[i] = lane3_abs(lane3_along(lane3_of(p->axis[i]), axis));
    }
    to.x = lane3_dot(lane3_of(p->axis[0]), r.to);
    to.y = lane3_dot(lane3_of(p->axis[1]), r.to);
    to.z = lane3_dot(lane3_of(p->axis[2]), r.to);
    lane3 own, cluster; /* how far the node reaches along the pixel cluster's axes, and the cluster along the node's */
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

/* A node gives at most U, by its largest cosines and least distance. Seen as one disc it is wrong by second order:
 * U min(1, R^2 / 2 d^2 + sin^2 a), R the radius of its box, a the widest angle of its normals. Where a horizon goes
 * through it, the pixel cluster's or its own, it is wrong by first order: by a quarter of U where its middle is on it
 * and counts for nothing. Right for all but a few of thousands of nodes: a rule, no proof. (No bound: the node's own
 * radiosity. It is a mean, and its brightest part may fill the sky: rooms lost a tenth of their later bounces by it.)
 * Returns the nodes that do not face away by more than rounding: what lies in the pixel cluster's own plane lights
 * nothing, and is not divided to find that out. The exact shapes of near leaves agree: clipped to the horizon they give
 * at most the share of the sky under the angle noise / d, d the distance. */
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
    /* A node that holds the pixel cluster may give any amount: so much that it is divided first, but not so much that
     * the sum of errors keeps the rounding of it when it is gone. */
    const lane lower = lane_max(lane_mul(lane_splat(1e-6f), n->half2), lane_splat(1e-24f));
    const lane d2 = lane_max(n->apart2, lower), d = lane_sqrt(d2);
    const lane upper = lane_mul(lane_mul(lane_div(lane_mul(n->m, lane_splat(INVERSE_PI)), d2),
                                        lane_min(lane_div(up, d), one)), lane_min(lane_div(out, d), one));
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

/* What holds for every pixel and every texel in the node: value is the least that any pixel gets, error the most that
 * the node's disc and the sum of its texels may differ by. With least and largest cosines and distances and
 * s = A / (pi d^2), the disc formula (gather.inl) lies between M / (pi D^2) (c (1 - 2 s) - s) and
 * M / (pi d^2) (c (1 + s) + cosG^2 s), since -(c + cosG^2) <= t <= 2 c + 1; exact shapes near by do, too. */
LANE_INLINE lane_mask bounds_conservative(lmb_node_bounds *w, int k, const lmb_pixel_cluster *p, const bounds_pair *n)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), rounded = lane_splat(BOUNDS_ROUNDED);
    const lane slack = lane_mul(rounded, n->reach), power = lane_mul(n->m, lane_splat(INVERSE_PI));
    const lane up = lane3_dot(lane3_of(p->normal), n->to), out = lane_sub(zero, lane3_dot(n->normal, n->to));
    const lane ups = lane_add(lane_add(lane_add(n->own_p, n->cluster_p), lane_mul(lane_splat(p->face_sine), n->reach)),
                              slack);
    const lane outs = lane_add(lane_add(lane_add(n->own_g, n->cluster_g), lane_mul(n->sine, n->reach)), slack);
    const lane d2 = lane_max(n->apart2, lane_splat(1e-24f)), d = lane_sqrt(d2);
    const lane s = lane_div(lane_mul(lane_load(w->node[LMB_BOUNDS_AREA] + k), lane_splat(INVERSE_PI)), d2);
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
