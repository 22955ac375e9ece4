/* live_sum.inl: a receiver's cut of the live tree, and the targets of the segments. Layer 5.                    [ours]
 *
 * Lanes are the nodes of a chunk, sixteen on every backend; sums over them use one fixed tree. */

/* Light of nodes i .. i + LANES - 1, and the mask of near ones. A disc of area A that faces the receiver at distance d
 * gives light proportional to 1 / (d^2 pi + A). Chunks store a smaller A if parts follow. */
LANE_INLINE lane live_nodes(uint32_t *near, const lmb_live_chunk *c, int i, const lmb_live_job *job)
{
    const lane zero = lane_splat(0.0f);
    lane3 d, facing;
    d.x = lane_sub(lane_load(c->place[0] + i), lane_splat(job->position.x));
    d.y = lane_sub(lane_load(c->place[1] + i), lane_splat(job->position.y));
    d.z = lane_sub(lane_load(c->place[2] + i), lane_splat(job->position.z));
    const lane d2 = lane3_dot(d, d);
    const lane here = lane3_dot(d, lane3_of(job->normal));
    *near = mask_bits(lane_lt(d2, lane_mul(lane_splat(job->split), lane_load(c->radius2 + i))));
    if (mask_bits(lane_lt(zero, here)) == 0) {
        return zero;
    }
    facing.x = lane_load(c->normal[0] + i);
    facing.y = lane_load(c->normal[1] + i);
    facing.z = lane_load(c->normal[2] + i);
    const lane there = lane_sub(zero, lane3_dot(d, facing));
    lane_mask lit = mask_and(lane_lt(zero, here), lane_lt(zero, there));
    if (job->is_bent) {
        lit = mask_and(lit, lane_lt(zero, lane3_dot(d, lane3_of(job->face))));
    }
    if (mask_bits(lit) == 0) {
        return zero;
    }
    const lane under = lane_mul(d2, lane_add(lane_mul(d2, lane_splat(3.14159265f)), lane_load(c->area + i)));
    const lane light = lane_div(lane_mul(lane_load(c->power + i), lane_mul(here, there)), under);
    return lane_keep(mask_and(lit, lane_lt(light, lane_splat(1e30f))), light);
}

/* Requests the nodes first .. first + count - 1. Returns 0 if the cut is full. */
static inline int live_ask(lmb_live_scratch *s, const lmb_live *live, uint32_t first, uint32_t count)
{
    const uint32_t past = first + count, from = first / LMB_LIVE_NODES, to = (past - 1) / LMB_LIVE_NODES;
    if (s->count + (int32_t)(to - from) + 1 > LMB_LIVE_CUT) {
        return 0;
    }
    for (uint32_t i = from; i <= to; ++i) {
        const uint32_t low = i == from ? first % LMB_LIVE_NODES : 0,
                       high = i == to ? (past - 1) % LMB_LIVE_NODES : LMB_LIVE_NODES - 1;
        const lmb_live_chunk *c = &live->chunk[i];
        for (int h = 0; h < 3; ++h) {
            LIVE_SOON(c->place[h]);
            LIVE_SOON(c->normal[h]);
        }
        LIVE_SOON(c->area);
        LIVE_SOON(c->power);
        LIVE_SOON(c->radius2);
        s->chunk[s->count] = c;
        s->asked[s->count++] = (uint16_t)((0xffffu << low) & (0xffffu >> (LMB_LIVE_NODES - 1 - high)));
    }
    return 1;
}

/* Can a first point's block light the receiver? The block is flat: no, if the receiver lies behind or almost in the
 * block's plane, or if the whole block lies below the receiver's horizon. */
static inline int live_is_ahead(const lmb_live_chunk *c, int i, const lmb_live_job *job)
{
    const lmb_vec3 d = sub3(vec3(c->place[0][i], c->place[1][i], c->place[2][i]), job->position);
    const float here = dot3(d, job->face);
    const float there = 0.0f - dot3(d, vec3(c->normal[0][i], c->normal[1][i], c->normal[2][i]));
    return there > 0.0f && there * there > 1e-6f * dot3(d, d) && (here > 0.0f || here * here < c->radius2[i]);
}

#define LIVE_OFF 1.0f /* texels between a receiver and an inner edge */

/* Does the receiver lie in an inner edge, less than a texel above a block's plane? The map has no sample between the
 * block's last texel and the edge, and at the edge all of a wall's light comes from there. Such a receiver is lit one
 * texel farther off, where the light is about the same. */
static inline void live_keep_off(lmb_live_scratch *s, const lmb_live *live, const lmb_live_chunk *c, int i,
                                 const lmb_live_job *job)
{
    const lmb_live_point *p = &live->sorted[c->first[i]];
    const float texel =
        p->face == LMB_LIVE_ELEMENT ? 0.0f : LIVE_OFF * sqrtf(p->area) / (float)(live->face[p->face].each * p->wide);
    const lmb_vec3 d = sub3(job->position, p->position);
    const float height = dot3(d, p->normal), cosine = dot3(p->normal, job->face);
    const float lift = texel - height, along2 = 1.0f - cosine * cosine;
    if (lift > s->lift && lift > 1e-3f * texel && height > -texel && along2 > 0.1f && dot3(d, d) < 2.0f * p->area) {
        s->lift = lift;
        s->off = mul3(sub3(p->normal, mul3(job->face, cosine)), lift / along2);
    }
}

/* Can live_keep_off move the receiver? A point's distance and area are also in the chunk, so most points are not read.
 * Parts of a point repeat the test of the point, so this may return anything for them. */
static inline int live_is_beside(const lmb_live_chunk *c, int i, const lmb_live_job *job)
{
    const lmb_vec3 d = sub3(job->position, vec3(c->place[0][i], c->place[1][i], c->place[2][i]));
    return dot3(d, d) < 2.0f * c->radius2[i];
}

/* Requests the parts of near nodes in chunk k of the cut; the nodes themselves then give no light. */
static inline void live_divide(lmb_live_scratch *s, const lmb_live *live, int32_t k, uint32_t near,
                               const lmb_live_job *job)
{
    const lmb_live_chunk *c = s->chunk[k];
    for (; near != 0; near &= near - 1) {
        const int i = lowest_bit(near);
        if (c->count[i] == (LMB_LIVE_LEAF | 1u) && job->can_move && live_is_beside(c, i, job)) {
            live_keep_off(s, live, c, i, job);
        }
        if ((c->count[i] & LMB_LIVE_LEAF) != 0) {
            if (s->leaves < LMB_LIVE_CUT && (c->count[i] != (LMB_LIVE_LEAF | 1u) || live_is_ahead(c, i, job))) {
                s->leaf[s->leaves++] = (uint32_t)(k * LMB_LIVE_NODES + i);
            }
        } else if (c->count[i] != 0) {
            if (live_ask(s, live, c->first[i], c->count[i])) {
                s->value[k][i] = 0.0f;
            } else {
                s->is_full = 1;
            }
        }
    }
}

/* Computes the values of the cut's chunks from s->done on, including chunks that these request. */
static void KERNEL(live_values)(lmb_live_scratch *s, const lmb_live *live, const lmb_live_job *job)
{
    for (; s->done < s->count; ++s->done) {
        const int32_t k = s->done;
        const uint32_t asked = s->asked[k];
        uint32_t near = 0;
        for (int i = 0; i < LMB_LIVE_NODES; i += LANES) {
            uint32_t bits;
            if (LANES == 1 && (asked >> i & 1u) == 0) {
                s->value[k][i] = 0.0f;
                continue;
            }
            const lane value = live_nodes(&bits, s->chunk[k], i, job);
            near |= bits << i;
            lane_store(s->value[k] + i, lane_keep(mask_of_bits(asked >> i & (~0u >> (32 - LANES))), value));
        }
        near &= asked;
        if (near != 0) {
            live_divide(s, live, k, near, job);
        }
    }
}

/* Like footprint_over. */
LANE_INLINE lane3 live_over(const lmb_live_surface *p, lane sx, lane sy)
{
    const lmb_view *v = p->view;
    const lane3 right = lane3_of(v->right), up = lane3_of(v->up), back = lane3_of(v->back), eye = lane3_of(v->eye);
    const lmb_vec3 from = sub3(p->corner, v->eye);
    lane3 across;
    across.x = lane_add(lane_mul(right.x, sx), lane_mul(up.x, sy));
    across.y = lane_add(lane_mul(right.y, sx), lane_mul(up.y, sy));
    across.z = lane_add(lane_mul(right.z, sx), lane_mul(up.z, sy));
    if (v->kind == LMB_PERSPECTIVE) {
        const lane3 ray = lane3_sub(across, back);
        const lane far = lane_div(lane_splat(dot3(p->normal, from)), lane3_dot(lane3_of(p->normal), ray));
        across.x = lane_add(eye.x, lane_mul(ray.x, far));
        across.y = lane_add(eye.y, lane_mul(ray.y, far));
        across.z = lane_add(eye.z, lane_mul(ray.z, far));
        return across;
    }
    const lane w = lane_div(lane3_dot(lane3_of(p->normal), lane3_sub(lane3_of(from), across)),
                            lane_splat(-dot3(p->normal, v->back)));
    across.x = lane_add(eye.x, lane_sub(across.x, lane_mul(back.x, w)));
    across.y = lane_add(eye.y, lane_sub(across.y, lane_mul(back.y, w)));
    across.z = lane_add(eye.z, lane_sub(across.z, lane_mul(back.z, w)));
    return across;
}

/* Moves points that lie outside the triangle onto it. */
LANE_INLINE lane3 live_onto(const lmb_live_surface *p, lane3 at)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), inside = lane_splat(LIVE_INSIDE),
               limit = lane_splat(1.0f - LIVE_INSIDE);
    const lane3 from = lane3_sub(at, lane3_of(p->corner));
    lane b1 = lane3_dot(lane3_of(p->along[0]), from), b2 = lane3_dot(lane3_of(p->along[1]), from);
    const lane_mask out = mask_or(mask_or(lane_lt(b1, zero), lane_lt(b2, zero)), lane_lt(one, lane_add(b1, b2)));
    if (mask_bits(out) == 0) {
        return at;
    }
    b1 = lane_max(b1, inside);
    b2 = lane_max(b2, inside);
    const lane sum = lane_add(b1, b2), over = lane_pick(lane_lt(limit, sum), lane_div(limit, sum), one);
    const lane u = lane_mul(b1, over), v = lane_mul(b2, over);
    const lane3 corner = lane3_of(p->corner), s0 = lane3_of(p->side[0]), s1 = lane3_of(p->side[1]);
    at.x = lane_pick(out, lane_add(corner.x, lane_add(lane_mul(s0.x, u), lane_mul(s1.x, v))), at.x);
    at.y = lane_pick(out, lane_add(corner.y, lane_add(lane_mul(s0.y, u), lane_mul(s1.y, v))), at.y);
    at.z = lane_pick(out, lane_add(corner.z, lane_add(lane_mul(s0.z, u), lane_mul(s1.z, v))), at.z);
    return at;
}

/* Like is_sane. */
LANE_INLINE lane_mask live_sane(lane v)
{
    return mask_and(lane_lt(lane_splat(-1048576.0f), v), lane_lt(v, lane_splat(1048576.0f)));
}

/* Like lmb_live_place, for many points. */
static uint32_t KERNEL(live_places)(lmb_live_spots *s, const lmb_live_surface *p, uint32_t asked)
{
    uint32_t out = 0;
    for (int i = 0; i < LMB_LIVE_NODES; i += LANES) {
        const lane_mask own = mask_of_bits(asked >> i & (~0u >> (32 - LANES)));
        const lane3 over = live_over(p, lane_load(s->sx + i), lane_load(s->sy + i)), at = live_onto(p, over);
        const lane where[3] = {at.x, at.y, at.z};
        const float normal[3] = {p->normal.x, p->normal.y, p->normal.z};
        for (int h = 0; h < 3; ++h) {
            lane_store(s->place[h] + i, lane_pick(own, where[h], lane_load(s->place[h] + i)));
            lane_store(s->normal[h] + i, lane_pick(own, lane_splat(normal[h]), lane_load(s->normal[h] + i)));
        }
        out |= mask_bits(mask_and(mask_and(live_sane(over.x), live_sane(over.y)), live_sane(over.z))) << i;
    }
    return out & asked;
}

/* Sums the cut's chunks, and each channel. Returns the total. */
static float KERNEL(live_sums)(float light[3], lmb_live_scratch *s)
{
    float all = 0.0f, sums[LMB_LIVE_NODES];
    lane sum[3][LMB_LIVE_NODES / LANES];
    for (int i = 0; i < LMB_LIVE_NODES / LANES; ++i) {
        sum[0][i] = sum[1][i] = sum[2][i] = lane_splat(0.0f);
    }
    for (int32_t k = 0; k < s->count; ++k) {
        const lmb_live_chunk *c = s->chunk[k];
        s->sum[k] = lane_sum16(s->value[k]);
        all += s->sum[k];
        for (int i = 0; i < LMB_LIVE_NODES / LANES && s->sum[k] > 0.0f; ++i) {
            const lane value = lane_load(s->value[k] + i * LANES);
            for (int h = 0; h < 3 && (LANES > 1 || s->value[k][i] > 0.0f); ++h) {
                sum[h][i] = lane_add(sum[h][i], lane_mul(value, lane_load(c->colour[h] + i * LANES)));
            }
        }
    }
    for (int h = 0; h < 3; ++h) {
        for (int i = 0; i < LMB_LIVE_NODES / LANES; ++i) {
            lane_store(sums + i * LANES, sum[h][i]);
        }
        light[h] = lane_sum16(sums);
    }
    return all;
}

static inline void live_put_target(lmb_live_rays *r, int32_t to, const lmb_live_chunk *c, int i)
{
    const lmb_live_target *t = &c->target[i];
    const lmb_vec3 at = r->segments.at;
    r->to[0][to] = t->at[0] - at.x;
    r->to[1][to] = t->at[1] - at.y;
    r->to[2][to] = t->at[2] - at.z;
    r->facet[0][to] = t->facet[0];
    r->facet[1][to] = t->facet[1];
    r->facet[2][to] = t->facet[2];
    r->colour[0][to] = t->colour[0];
    r->colour[1][to] = t->colour[1];
    r->colour[2][to] = t->colour[2];
    r->id[to] = t->id;
}

/* Lane whose range of running sums contains `at`: the first of the lanes `some`, not 0, with a sum over it. The last
 * one of them if rounding overshot. */
LANE_INLINE int live_lane_at(const float sums[LMB_LIVE_NODES], float at, uint32_t some)
{
    uint32_t after = 0;
    for (int i = 0; i < LMB_LIVE_NODES; i += LANES) {
        after |= mask_bits(lane_lt(lane_splat(at), lane_load(sums + i))) << i;
    }
    after &= some;
    return after != 0 ? lowest_bit(after) : highest_bit(some);
}

/* Finds the part of a node at a fraction of the node's power: a chunk and a lane. */
static inline const lmb_live_chunk *live_part_at(int *lane_of, const lmb_live *live, uint32_t first, uint32_t count,
                                                 float at)
{
    const uint32_t past = first + count;
    float sums[LMB_LIVE_NODES];
    for (;;) {
        const lmb_live_chunk *part = &live->chunk[first / LMB_LIVE_NODES];
        const uint32_t low = first % LMB_LIVE_NODES, end = past - (first - low),
                       some = (0xffffu << low) & (end < LMB_LIVE_NODES ? ~(~0u << end) : 0xffffu);
        for (int i = 0; i < LMB_LIVE_NODES; i += LANES) {
            const lane_mask own = mask_of_bits(some >> i & (~0u >> (32 - LANES)));
            lane_store(sums + i, lane_keep(own, lane_load(part->power + i)));
        }
        lane_scan16(sums, sums, 0.0f);
        if (at < sums[LMB_LIVE_NODES - 1] || end <= LMB_LIVE_NODES) {
            *lane_of = live_lane_at(sums, at, some);
            return part;
        }
        at -= sums[LMB_LIVE_NODES - 1];
        first += LMB_LIVE_NODES - low;
    }
}

/* Sums the sky's nodes, and each channel. Returns the total. The mean direction of a node above the horizon gives its
 * light exactly. */
static float KERNEL(live_sky)(float light[3], lmb_live_scratch *s, const lmb_live_sky *sky, const lmb_live_job *job)
{
    const lane zero = lane_splat(0.0f);
    const lane3 normal = lane3_of(job->normal), face = lane3_of(job->face);
    float all = 0.0f, sums[LMB_LIVE_NODES];
    lane sum[3][LMB_LIVE_NODES / LANES];
    for (int i = 0; i < LMB_LIVE_NODES / LANES; ++i) {
        sum[0][i] = sum[1][i] = sum[2][i] = zero;
    }
    s->count = (int32_t)sky->chunks;
    for (int32_t k = 0; k < s->count; ++k) {
        const lmb_live_suns *c = &sky->chunk[k];
        uint32_t any = 0;
        for (int i = 0; i < LMB_LIVE_NODES / LANES; ++i) {
            lane3 toward;
            toward.x = lane_load(c->toward[0] + i * LANES);
            toward.y = lane_load(c->toward[1] + i * LANES);
            toward.z = lane_load(c->toward[2] + i * LANES);
            const lane cosine = lane3_dot(normal, toward);
            lane_mask lit = lane_lt(lane_splat(0x1p-20f), cosine); /* no denormals */
            if (job->is_bent) {
                lit = mask_and(lit, lane_lt(zero, lane3_dot(face, toward)));
            }
            any |= mask_bits(lit);
            lane_store(s->value[k] + i * LANES, lane_keep(lit, lane_mul(lane_load(c->power + i * LANES), cosine)));
        }
        s->sum[k] = any != 0 ? lane_sum16(s->value[k]) : 0.0f;
        all += s->sum[k];
        for (int i = 0; i < LMB_LIVE_NODES / LANES && s->sum[k] > 0.0f; ++i) {
            const lane value = lane_load(s->value[k] + i * LANES);
            for (int h = 0; h < 3; ++h) {
                sum[h][i] = lane_add(sum[h][i], lane_mul(value, lane_load(c->colour[h] + i * LANES)));
            }
        }
    }
    for (int h = 0; h < 3; ++h) {
        for (int i = 0; i < LMB_LIVE_NODES / LANES; ++i) {
            lane_store(sums + i * LANES, sum[h][i]);
        }
        light[h] = lane_sum16(sums);
    }
    return all;
}

/* Selects a node for each of `strata` strata of `all` light, each at `place` in the stratum, 0 .. 1. */
static void KERNEL(live_picks)(lmb_live_picks *out, const lmb_live_scratch *s, int32_t strata, float place, float all)
{
    const float step = all / (float)strata;
    float so_far = 0.0f, at = place * step;
    int32_t k = 0;
    for (int32_t e = 0; e < s->count && k < strata; ++e) {
        const float next = so_far + s->sum[e];
        if (at < next) {
            float sums[LMB_LIVE_NODES];
            uint32_t some = 0;
            lane_scan16(sums, s->value[e], so_far);
            for (int i = 0; i < LMB_LIVE_NODES; i += LANES) {
                some |= mask_bits(lane_lt(lane_splat(0.0f), lane_load(s->value[e] + i))) << i;
            }
            while (some != 0 && k < strata && at < next) {
                const int i = live_lane_at(sums, at, some);
                out->node[k] = (uint16_t)(e * LMB_LIVE_NODES + i);
                out->rest[k] = sums[i] - at;
                ++k;
                at = ((float)k + place) * step;
            }
        }
        so_far = next;
    }
    out->count = k;
}

/* Completes the segments after s->targets targets were stored. */
LANE_INLINE void live_towards(lmb_live_scratch *s)
{
    lmb_live_rays *r = &s->rays;
    int32_t k = s->targets;
    for (; k % LMB_LIVE_NODES != 0; ++k) { /* padding that the sums include */
        for (int h = 0; h < 3; ++h) {
            r->to[h][k] = r->facet[h][k] = r->colour[h][k] = 0.0f;
        }
        r->id[k] = 0;
    }
    for (int i = 0; i < k; i += LANES) {
        for (int h = 0; h < 3; ++h) {
            lane_store(r->segments.per[h] + i, crossed_per(lane_load(r->to[h] + i)));
        }
    }
}

/* The sum of a sky's nodes has no light from below the receiver's horizon, so such targets do not count. */
static uint64_t KERNEL(live_above)(lmb_live_scratch *s, const lmb_live_receiver *at)
{
    lmb_live_rays *r = &s->rays;
    const lane3 normal = lane3_of(at->normal), face = lane3_of(at->face);
    const lane zero = lane_splat(0.0f);
    uint64_t out = 0;
    live_towards(s);
    for (int k = 0; k < s->targets; k += LANES) {
        lane3 to;
        to.x = lane_load(r->to[0] + k);
        to.y = lane_load(r->to[1] + k);
        to.z = lane_load(r->to[2] + k);
        const lane_mask above = mask_and(lane_lt(zero, lane3_dot(normal, to)), lane_lt(zero, lane3_dot(face, to)));
        for (int h = 0; h < 3; ++h) {
            lane_store(r->colour[h] + k, lane_keep(above, lane_load(r->colour[h] + k)));
        }
        out |= (uint64_t)mask_bits(above) << k;
    }
    return s->targets < LMB_TILE_PIXELS ? out & (((uint64_t)1 << s->targets) - 1) : out;
}

/* Selects targets: one for each of `strata` strata of `all` light, each at `place` in the stratum, 0 .. 1. If a node
 * has more than one stratum, the part is used that lies the pick's `rest` of the light before the node's end. */
static void KERNEL(live_targets)(lmb_live_scratch *s, const lmb_live *live, int32_t strata, float place, float all)
{
    const float step = all / (float)strata;
    lmb_live_picks p;
    KERNEL(live_picks)(&p, s, strata, place, all);
    for (int32_t k = 0; k < p.count; ++k) {
        LIVE_SOON(&s->chunk[p.node[k] / LMB_LIVE_NODES]->target[p.node[k] % LMB_LIVE_NODES]);
    }
    for (int32_t k = 0; k < p.count; ++k) {
        const int32_t e = p.node[k] / LMB_LIVE_NODES;
        int i = p.node[k] % LMB_LIVE_NODES;
        const lmb_live_chunk *c = s->chunk[e];
        const uint32_t parts = c->count[i];
        if (s->value[e][i] > step && parts != 0 && (parts & LMB_LIVE_LEAF) == 0) {
            const float left = clampf(p.rest[k] / s->value[e][i], 0.0f, 1.0f);
            c = live_part_at(&i, live, c->first[i], parts, (1.0f - left) * c->power[i]);
            LIVE_SOON(&c->target[i]);
        }
        s->pick[k].chunk = c;
        s->pick[k].lane = i;
    }
    for (int32_t k = 0; k < p.count; ++k) {
        live_put_target(&s->rays, k, s->pick[k].chunk, s->pick[k].lane);
    }
    s->targets = p.count;
    live_towards(s);
}

/* Targets that count: above the receiver's horizon, and with the receiver in front of the target's facet by more than
 * rounding. A node's target may fail either test although the node's middle passes. */
static uint64_t KERNEL(live_ahead)(const lmb_live_rays *r, int32_t targets, const lmb_live_receiver *at)
{
    const lane3 face = lane3_of(at->face);
    const lane below = lane_splat(-at->noise);
    uint64_t out = 0;
    for (int k = 0; k < targets; k += LANES) {
        lane3 to, facet;
        to.x = lane_load(r->to[0] + k);
        to.y = lane_load(r->to[1] + k);
        to.z = lane_load(r->to[2] + k);
        facet.x = lane_load(r->facet[0] + k);
        facet.y = lane_load(r->facet[1] + k);
        facet.z = lane_load(r->facet[2] + k);
        const lanei id = lanei_load((const int32_t *)(const void *)(r->id + k));
        const lane_mask own = lanei_equal(id, lanei_splat((int32_t)at->id));
        const lane_mask ahead =
            mask_and(lane_lt(lane_splat(0.0f), lane3_dot(face, to)), lane_lt(lane3_dot(facet, to), below));
        out |= (uint64_t)(mask_bits(ahead) & ~mask_bits(own)) << k;
    }
    return targets < LMB_TILE_PIXELS ? out & (((uint64_t)1 << targets) - 1) : out;
}

/* Adds the colours of all targets, and of the visible ones. */
static void KERNEL(live_share)(float all[3], float some[3], const lmb_live_rays *r, int32_t targets, uint64_t seen)
{
    for (int h = 0; h < 3; ++h) {
        float sums[2][LMB_LIVE_NODES];
        for (int i = 0; i < LMB_LIVE_NODES; i += LANES) {
            lane a = lane_splat(0.0f), b = a;
            for (int k = i; k < targets; k += LMB_LIVE_NODES) {
                const lane c = lane_load(r->colour[h] + k);
                a = lane_add(a, c);
                b = lane_add(b, lane_keep(mask_of_bits((uint32_t)(seen >> k) & (~0u >> (32 - LANES))), c));
            }
            lane_store(sums[0] + i, a);
            lane_store(sums[1] + i, b);
        }
        all[h] += lane_sum16(sums[0]);
        some[h] += lane_sum16(sums[1]);
    }
}

/* Narrows the ranges of a ray in boxes by one axis. */
LANE_INLINE void live_slab(lane *from, lane *to, lane low, lane high, float per)
{
    const lane along = lane_splat(per), a = lane_mul(low, along), b = lane_mul(high, along);
    *from = lane_max(*from, lane_min(a, b));
    *to = lane_min(*to, lane_max(a, b));
}

/* Mask bits of rays 0 .. 31 that meet boxes i, i + 1, ...: `low`, `high` are the boxes' sides, from the rays' origin.
 * Lanes are boxes: few rays reach most nodes. Unrolled by axis, so that the sides stay in registers. */
LANE_INLINE lanei live_met(lane3 low, lane3 high, lane_mask some, const lmb_segments *s, int first, uint32_t asked)
{
    lanei out = lanei_splat(0);
    for (uint32_t bits = asked; bits != 0; bits &= bits - 1) {
        const int k = first + lowest_bit(bits);
        lane from = lane_splat(0.0f), to = lane_splat(1.0f);
        live_slab(&from, &to, low.x, high.x, s->per[0][k]);
        live_slab(&from, &to, low.y, high.y, s->per[1][k]);
        live_slab(&from, &to, low.z, high.z, s->per[2][k]);
        const lane_mask met = mask_and(some, crossed_some(from, to));
        out = lanei_pick(met, lanei_or(out, lanei_splat((int32_t)(bits & (~bits + 1)))), out);
    }
    return out;
}

/* Sets the requested rays that meet each of a node's boxes. Returns the boxes that any of them meets. */
static uint32_t KERNEL(live_boxes)(uint32_t out[2][LMB_BOXES], const lmb_segments *s, uint64_t asked,
                                   const lmb_boxes *boxes)
{
    const lane3 at = lane3_of(s->at);
    uint32_t any = 0;
    for (int i = 0; i < LMB_BOXES; i += LANES) {
        lane3 low, high;
        low.x = lane_load(boxes->low[0] + i);
        high.x = lane_load(boxes->high[0] + i);
        const lane_mask some = lane_le(low.x, high.x);
        if (mask_bits(some) == 0) { /* no more boxes */
            break;
        }
        low.x = lane_sub(low.x, at.x);
        high.x = lane_sub(high.x, at.x);
        low.y = lane_sub(lane_load(boxes->low[1] + i), at.y);
        high.y = lane_sub(lane_load(boxes->high[1] + i), at.y);
        low.z = lane_sub(lane_load(boxes->low[2] + i), at.z);
        high.z = lane_sub(lane_load(boxes->high[2] + i), at.z);
        const lanei one = live_met(low, high, some, s, 0, (uint32_t)asked),
                    two = live_met(low, high, some, s, 32, (uint32_t)(asked >> 32));
        lanei_store((int32_t *)(void *)(out[0] + i), one);
        lanei_store((int32_t *)(void *)(out[1] + i), two);
        any |= (~mask_bits(lanei_equal(lanei_or(one, two), lanei_splat(0))) & (~0u >> (32 - LANES))) << i;
    }
    return any;
}

/* The first ray to test, from ray k on; LMB_TILE_PIXELS: there is none. A single lane skips rays that are not asked. */
static inline int live_next(uint64_t asked, int k)
{
    const uint64_t left = k < LMB_TILE_PIXELS ? asked >> k : 0;
    return left == 0 ? LMB_TILE_PIXELS : LANES == 1 ? k + lowest_bit_64(left) : k;
}

/* Returns the requested rays that end beyond a triangle's plane. */
static uint64_t KERNEL(live_beyond)(float (*to)[LMB_TILE_PIXELS], uint64_t asked, const lmb_cross_job *job)
{
    const lane3 n = lane3_of(job->normal);
    const lane beyond = lane_splat(job->beyond);
    uint64_t out = 0;
    for (int k = live_next(asked, 0); k < LMB_TILE_PIXELS; k = live_next(asked, k + LANES)) {
        lane3 d;
        d.x = lane_load(to[0] + k);
        d.y = lane_load(to[1] + k);
        d.z = lane_load(to[2] + k);
        out |= (uint64_t)mask_bits(lane_lt(beyond, lane3_dot(n, d))) << k;
    }
    return out & asked;
}

/* Returns the requested rays, which end beyond a triangle's plane, that cross the triangle. */
static uint64_t KERNEL(live_crossed)(float (*to)[LMB_TILE_PIXELS], uint64_t asked, const lmb_cross_job *job)
{
    const lane3 e0 = lane3_of(job->edge[0]), e1 = lane3_of(job->edge[1]), e2 = lane3_of(job->edge[2]);
    const lane outer = lane_splat(0.0f - job->slack);
    uint64_t out = 0;
    for (int k = live_next(asked, 0); k < LMB_TILE_PIXELS; k = live_next(asked, k + LANES)) {
        lane3 d;
        d.x = lane_load(to[0] + k);
        d.y = lane_load(to[1] + k);
        d.z = lane_load(to[2] + k);
        const lane min = lane_min(lane_min(lane3_dot(e0, d), lane3_dot(e1, d)), lane3_dot(e2, d));
        out |= (uint64_t)mask_bits(lane_le(outer, min)) << k;
    }
    return out & asked;
}
