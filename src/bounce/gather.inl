/* gather.inl: groups of emitters -> irradiance of a tile's pixels, with the viewer's depth map as occluder.  [V25-V28]
 *
 * Lanes are pixels; groups are added one after another: the order is the contract. */
#ifndef LMB_GATHER_FORMULA
#define LMB_GATHER_FORMULA

/* One emitter, one vector of pixels. M = 1: W/m2 a watt.
 *
 * A disc of area A seen from r away, to second order in s = A / (pi r^2) (integrate cosP cosG / r^2 over the disc):
 *   E = (c - t s) / (pi r^2),  c = cosP cosG,  t = c (3 cos^2 G - 1) + g cos^2 G,  g = nP.nG.
 * c^2 / (c + t s) has the same expansion, stays positive for t >= 0 and equals 1 / (pi r^2 + A) on the axis of a
 * facing disc (t = c = 1), which is exact. For t < 0 the sum itself is kept, under the bound cosG / s: nothing receives
 * more than the disc's own radiosity M / A times cosG. */
static inline lane disc_factor(lane3 to, lane r2, lane3 n, lane3 axis, lane area)
{
    const lane zero = lane_splat(0.0f), inverse_pi = lane_splat(0.31830989f);
    lane i = lane_div(lane_splat(1.0f), r2);
    lane a = lane3_dot(n, to), b = lane_sub(zero, lane3_dot(axis, to));
    lane c = lane_mul(lane_mul(a, b), i), g2 = lane_mul(lane_mul(b, b), i);
    lane s = lane_mul(lane_mul(area, inverse_pi), i);
    lane t = lane_add(lane_mul(c, lane_sub(lane_mul(lane_splat(3.0f), g2), lane_splat(1.0f))),
                      lane_mul(lane3_dot(n, axis), g2));
    lane ts = lane_mul(t, s);
    lane_mask over = lane_le(zero, t);
    lane cos_g = lane_mul(b, lane_sqrt(i));
    lane top = lane_pick(over, lane_mul(c, c), lane_min(lane_mul(lane_sub(c, ts), s), cos_g));
    lane bottom = lane_pick(over, lane_add(c, ts), s);
    lane_mask faces = mask_and(lane_lt(zero, a), lane_lt(zero, b));
    lane e = lane_mul(lane_mul(inverse_pi, i), lane_div(top, lane_pick(faces, bottom, lane_splat(1.0f))));
    return lane_keep(faces, e);
}

#endif

#ifdef KERNEL

/* A group is near within this many of its radii: then its discs are read one by one. (2.8 costs twice the pairs and buys
 * nothing that the discs' own LMB_NEAR does not: cornell trim 0.048 either way.) */
#define GROUP_NEAR 2.0f
/* Discs that share one segment while none of them is near: 1 costs three times the segments for 0.001 of trim. */
#define SHARED 4u
/* Two stored depths a pixel apart are one surface when they differ by no more than this share, or by this many times
 * the step beside them: d is affine over a plane, so an edge-on wall steps evenly and a silhouette does not. */
#define JUMP 0.02f
#define SLOPE 2.0f

/* A vector of pixels in the viewer's frame, and the depth plane of each one's surface. */
typedef struct seen_from {
    lane x, y, w;     /* m along right, up, the axis */
    lane px, py, d;   /* place in the map */
    lane dx, dy;      /* the surface's own plane: d per px */
} seen_from;

static inline lane3 march_view(const lmb_march_job *m, lane3 p)
{
    lane3 v;
    p = lane3_sub(p, lane3_splat(m->eye.x, m->eye.y, m->eye.z));
    v.x = lane3_dot(p, lane3_splat(m->right.x, m->right.y, m->right.z));
    v.y = lane3_dot(p, lane3_splat(m->up.x, m->up.y, m->up.z));
    v.z = lane_sub(lane_splat(0.0f), lane3_dot(p, lane3_splat(m->back.x, m->back.y, m->back.z)));
    return v;
}

static inline void march_place(lane *px, lane *py, lane *d, const lmb_march_job *m, lane3 v)
{
    const lane one = lane_splat(1.0f);
    lane i = m->perspective ? lane_div(one, v.z) : one;
    *px = lane_add(lane_mul(lane_mul(v.x, i), lane_splat(m->scale_x)), lane_splat(m->middle_x));
    *py = lane_sub(lane_splat(m->middle_y), lane_mul(lane_mul(v.y, i), lane_splat(m->scale_y)));
    *d = m->perspective ? lane_mul(lane_splat(m->near_m), i)
                        : lane_mul(lane_sub(lane_splat(m->far_m), v.z), lane_splat(1.0f / (m->far_m - m->near_m)));
}

/* d of the plane through v with normal n, per px: d is affine in the map, and so are the rays' dot products with n. */
static inline lane_mask march_plane(lane *dx, lane *dy, const lmb_march_job *m, lane3 v, lane3 n)
{
    lane nx = lane3_dot(n, lane3_splat(m->right.x, m->right.y, m->right.z));
    lane ny = lane3_dot(n, lane3_splat(m->up.x, m->up.y, m->up.z));
    lane nz = lane_sub(lane_splat(0.0f), lane3_dot(n, lane3_splat(m->back.x, m->back.y, m->back.z)));
    lane bottom, gain;
    if (m->perspective) {
        bottom = lane_add(lane_add(lane_mul(nx, v.x), lane_mul(ny, v.y)), lane_mul(nz, v.z));
        gain = lane_splat(m->near_m);
    } else {
        bottom = nz;
        gain = lane_splat(1.0f / (m->far_m - m->near_m));
    }
    const lane least = lane_splat(-1e-6f); /* the surface faces the viewer: negative */
    gain = lane_div(gain, lane_min(bottom, least));
    *dx = lane_mul(lane_mul(gain, nx), lane_splat(1.0f / m->scale_x));
    *dy = lane_mul(lane_mul(gain, ny), lane_splat(-1.0f / m->scale_y));
    return lane_lt(bottom, least);
}

static inline seen_from march_begin(const lmb_march_job *m, const lmb_tile *tile, int k)
{
    seen_from s;
    lane3 v = march_view(m, lane3_load(tile->position, k));
    v.z = lane_max(v.z, lane_splat(m->near_m));
    s.x = v.x;
    s.y = v.y;
    s.w = v.z;
    march_place(&s.px, &s.py, &s.d, m, v);
    march_plane(&s.dx, &s.dy, m, v, lane3_load(tile->face, k));
    return s;
}

/* Share of the segment from (px, py) that lies inside the frame, along one axis. */
static inline lane march_inside(lane from, lane to, float size)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), end = lane_splat(size);
    lane edge = lane_pick(lane_lt(to, zero), zero, end);
    lane_mask leaves = mask_or(lane_lt(to, zero), lane_lt(end, to));
    lane run = lane_sub(to, from);
    lane share = lane_div(lane_sub(edge, from), lane_pick(leaves, run, one));
    return lane_pick(leaves, lane_min(lane_max(share, zero), one), one);
}

/* Stored depth at whole pixels inside the map. */
static inline lane march_read(const lmb_march_job *m, lane x, lane y)
{
    const lanei seven = lanei_splat(7), ix = lane_to_int(x), iy = lane_to_int(y);
    lanei at;
    if (m->tiled) {
        at = lanei_add(lanei_mul(lanei_shift(iy, 3), lanei_splat(m->row_step)),
                       lanei_mul(lanei_shift(ix, 3), lanei_splat(LMB_TILE_PIXELS)));
        at = lanei_add(at, lanei_add(lanei_mul(lanei_and(iy, seven), lanei_splat(LMB_TILE)), lanei_and(ix, seven)));
    } else {
        at = lanei_add(lanei_mul(iy, lanei_splat(m->row_step)), ix);
    }
    if (m->depth_32 != NULL) {
        return lane_gather_f32(m->depth_32, at);
    }
    lane code = lane_gather_u16(m->depth_16, at);
    lane d = lane_add(lane_mul(code, lane_splat(m->d16_scale)), lane_splat(m->d16_bias));
    return lane_keep(lane_lt(lane_splat(0.0f), code), d);
}

/* A run of segments in the map: from each pixel of a vector towards one emitter. */
typedef struct march_run {
    lane x, y;     /* px, over the whole segment */
    lane rise;     /* d of the segment's end over the pixel's own surface plane */
    lane end_x, end_y, end_d;       /* the emitter's place */
    lane end_dx, end_dy, end_rise;  /* its plane: d per px; d of the segment's start over it */
    lane w_end;    /* m along the view's axis */
    lane end;      /* share of the segment that lies inside the frame */
    lane pixel;    /* share of it that is one px */
    lane samples;  /* one a px of it, at most m->steps */
} march_run;

static inline march_run march_towards(const lmb_march_job *m, const seen_from *s, lane3 at, lane3 axis)
{
    march_run r;
    lane3 v = march_view(m, at);
    lane_mask level = march_plane(&r.end_dx, &r.end_dy, m, v, axis);
    if (m->perspective) { /* cut where the segment passes the near plane */
        lane near_m = lane_splat(m->near_m);
        lane_mask behind = lane_lt(v.z, near_m);
        lane run = lane_pick(behind, lane_sub(s->w, v.z), lane_splat(1.0f));
        lane share = lane_pick(behind, lane_div(lane_sub(s->w, near_m), run), lane_splat(1.0f));
        v.x = lane_add(s->x, lane_mul(lane_sub(v.x, s->x), share));
        v.y = lane_add(s->y, lane_mul(lane_sub(v.y, s->y), share));
        v.z = lane_max(lane_add(s->w, lane_mul(lane_sub(v.z, s->w), share)), near_m);
    }
    lane px, py, d;
    march_place(&px, &py, &d, m, v);
    r.x = lane_sub(px, s->px);
    r.y = lane_sub(py, s->py);
    r.rise = lane_sub(lane_sub(d, s->d), lane_add(lane_mul(r.x, s->dx), lane_mul(r.y, s->dy)));
    r.w_end = v.z;
    r.end_x = px;
    r.end_y = py;
    r.end_d = d;
    /* An emitter turned away from the viewer is not in the map: no surface of its own to step over. */
    r.end_rise = lane_sub(lane_sub(s->d, d), lane_sub(lane_splat(0.0f), lane_add(lane_mul(r.x, r.end_dx), lane_mul(r.y, r.end_dy))));
    r.end_rise = lane_pick(level, r.end_rise, lane_splat(-1e30f));
    r.end = lane_min(march_inside(s->px, px, m->last_x + 1.0f), march_inside(s->py, py, m->last_y + 1.0f));
    const lane one = lane_splat(1.0f), zero = lane_splat(0.0f);
    lane length = lane_max(lane_max(r.x, lane_sub(zero, r.x)), lane_max(r.y, lane_sub(zero, r.y)));
    r.pixel = lane_div(one, lane_max(length, one));
    r.samples = lane_trunc(lane_min(lane_add(lane_mul(length, r.end), one), lane_splat((float)m->steps)));
    return r;
}

/* The stored d at share t of the segments, and how far it stands over them: positive, and the viewer's surface hides
 * that place.
 *
 * Both heights are taken over the pixel's own surface plane, the stored one at its texel's middle. So a flat receiver
 * never shadows itself, however grazing the view, and no bias needs tuning. */
static inline lane march_height(lane *stored, const lmb_march_job *m, const seen_from *s, const march_run *r, lane t)
{
    const lane zero = lane_splat(0.0f), half = lane_splat(0.5f);
    lane x = lane_add(s->px, lane_mul(r->x, t)), y = lane_add(s->py, lane_mul(r->y, t));
    x = lane_trunc(lane_min(lane_max(x, zero), lane_splat(m->last_x)));
    y = lane_trunc(lane_min(lane_max(y, zero), lane_splat(m->last_y)));
    *stored = march_read(m, x, y);
    lane off_x = lane_sub(lane_add(x, half), s->px), off_y = lane_sub(lane_add(y, half), s->py);
    lane plane = lane_add(s->d, lane_add(lane_mul(off_x, s->dx), lane_mul(off_y, s->dy)));
    lane ray = lane_add(plane, lane_mul(r->rise, t));
    off_x = lane_sub(lane_add(x, half), r->end_x);
    off_y = lane_sub(lane_add(y, half), r->end_y);
    plane = lane_add(r->end_d, lane_add(lane_mul(off_x, r->end_dx), lane_mul(off_y, r->end_dy)));
    ray = lane_max(ray, lane_add(plane, lane_mul(r->end_rise, lane_sub(lane_splat(1.0f), t))));
    lane slack = lane_mul(lane_splat(m->slack), s->d);
    return lane_sub(*stored, lane_add(ray, slack));
}

/* Where along the segments sample i lies: equal steps of the map, or of the world seen in the map. */
static inline lane march_share(const lmb_march_job *m, const seen_from *s, const march_run *r, int i)
{
    lane t = lane_div(lane_splat((float)i + 0.5f), r->samples);
    if (m->kind == LMB_OCCLUSION_VIEW_WORLD && m->perspective) {
        return lane_div(lane_mul(t, r->w_end), lane_add(s->w, lane_mul(lane_sub(r->w_end, s->w), t)));
    }
    return lane_mul(t, r->end);
}

static inline lane march_gap(lane a, lane b) { return lane_max(lane_sub(a, b), lane_sub(b, a)); }

/* Between two samples on different sides of the viewer's surface: does the segment cross it there, or only pass
 * behind a silhouette? Halve the gap to about a pixel; a surface that then still jumps is two surfaces. */
static inline lane_mask march_crosses(const lmb_march_job *m, const seen_from *s, const march_run *r, lane from, lane to,
                                      lane from_d, lane to_d, lane_mask from_hidden)
{
    for (int i = 0; i < 4; ++i) {
        lane stored, middle = lane_mul(lane_add(from, to), lane_splat(0.5f));
        lane_mask hidden = lane_lt(lane_splat(0.0f), march_height(&stored, m, s, r, middle));
        lane_mask first = mask_not(mask_or(mask_and(hidden, mask_not(from_hidden)), mask_and(from_hidden, mask_not(hidden))));
        from = lane_pick(first, middle, from);
        from_d = lane_pick(first, stored, from_d);
        to = lane_pick(first, to, middle);
        to_d = lane_pick(first, to_d, stored);
    }
    lane before, after, jump = march_gap(from_d, to_d);
    march_height(&before, m, s, r, lane_sub(from, r->pixel));
    march_height(&after, m, s, r, lane_add(to, r->pixel));
    lane slope = lane_max(march_gap(before, from_d), march_gap(to_d, after));
    return lane_le(jump, lane_add(lane_mul(lane_splat(JUMP), lane_min(from_d, to_d)), lane_mul(lane_splat(SLOPE), slope)));
}

/* Which of the wanted segments from the pixels to one emitter cross nothing that the viewer sees.            [V25]
 *
 * In the map a segment is straight and d is affine along it. It may pass behind something, unseen, and come out again:
 * that crosses no visible surface, so only a change of side without a silhouette blocks. */
static inline lane_mask march(const lmb_march_job *m, const seen_from *s, lane3 at, lane3 axis, lane_mask wanted)
{
    const lane zero = lane_splat(0.0f);
    const march_run r = march_towards(m, s, at, axis);
    lane_mask open = wanted, hidden_before = lane_lt(zero, zero);
    lane before = zero, stored_before = s->d;
    for (int i = 0; i < m->steps && mask_bits(open); ++i) {
        lane stored, t = march_share(m, s, &r, i);
        lane_mask hidden = lane_lt(zero, march_height(&stored, m, s, &r, t));
        lane_mask changed = mask_or(mask_and(hidden, mask_not(hidden_before)), mask_and(hidden_before, mask_not(hidden)));
        changed = mask_and(mask_and(changed, open), lane_lt(lane_splat((float)i), r.samples));
        if (mask_bits(changed)) {
            lane_mask crosses = march_crosses(m, s, &r, before, t, stored_before, stored, hidden_before);
            open = mask_and(open, mask_not(mask_and(changed, crosses)));
        }
        hidden_before = hidden;
        before = t;
        stored_before = stored;
    }
    return open;
}

static inline void gather_add(lmb_irradiance *inout, int k, lane weight, float r, float g, float b)
{
    lane_store(inout->rgb[0] + k, lane_add(lane_load(inout->rgb[0] + k), lane_mul(weight, lane_splat(r))));
    lane_store(inout->rgb[1] + k, lane_add(lane_load(inout->rgb[1] + k), lane_mul(weight, lane_splat(g))));
    lane_store(inout->rgb[2] + k, lane_add(lane_load(inout->rgb[2] + k), lane_mul(weight, lane_splat(b))));
}

/* Lanes that carry a surface. */
static inline lane_mask gather_hits(const lmb_tile *tile, int k)
{
    return mask_not(lanei_equal(lanei_load((const int32_t *)tile->id + k), lanei_splat(0)));
}

static void KERNEL(gather)(lmb_irradiance *inout, uint64_t *near_pixels, const lmb_tile *tile, const lmb_groups *groups,
                           const lmb_march_job *m)
{
    for (int32_t j = 0; j < groups->count; ++j) {
        near_pixels[j] = 0;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane3 p = lane3_load(tile->position, k), n = lane3_load(tile->normal, k), face = lane3_load(tile->face, k);
        const lane_mask hits = gather_hits(tile, k);
        seen_from from;
        if (mask_bits(hits) == 0) {
            continue;
        }
        if (m != NULL) {
            from = march_begin(m, tile, k);
        }
        for (int32_t j = 0; j < groups->count; ++j) {
            const lane3 at = lane3_splat(groups->position[0][j], groups->position[1][j], groups->position[2][j]);
            const lane3 axis = lane3_splat(groups->normal[0][j], groups->normal[1][j], groups->normal[2][j]);
            lane near2 = lane_splat(groups->radius[j] * GROUP_NEAR * (groups->radius[j] * GROUP_NEAR));
            lane3 to = lane3_sub(at, p);
            lane r2 = lane3_dot(to, to);
            lane_mask close = mask_and(hits, lane_lt(r2, near2));
            near_pixels[j] |= (uint64_t)mask_bits(close) << k;
            lane weight = disc_factor(to, lane_max(r2, near2), n, axis, lane_splat(groups->area[j]));
            lane_mask lit = mask_and(mask_and(hits, mask_not(close)), lane_lt(lane_splat(0.0f), weight));
            lit = mask_and(lit, lane_lt(lane_splat(0.0f), lane3_dot(face, to)));
            if (m != NULL && mask_bits(lit)) {
                lit = march(m, &from, at, axis, lit);
            }
            if (mask_bits(lit)) {
                gather_add(inout, k, lane_keep(lit, weight), groups->flux[0][j], groups->flux[1][j], groups->flux[2][j]);
            }
        }
    }
}

/* The exact form factor for the few lanes so close to a disc that its shape matters. */
static inline lane gather_quads(lane weight, lane_mask close, const lmb_tile *tile, int k, const lmb_point *disc)
{
    float w[LANES];
    uint32_t bits = mask_bits(close);
    lane_store(w, weight);
    for (int i = 0; i < LANES; ++i) {
        if ((bits >> i) & 1u) {
            w[i] = lmb_quad_factor(vec3(tile->position[0][k + i], tile->position[1][k + i], tile->position[2][k + i]),
                                   vec3(tile->normal[0][k + i], tile->normal[1][k + i], tile->normal[2][k + i]),
                                   disc->position, disc->normal, disc->axis_u, disc->axis_v);
        }
    }
    return lane_load(w);
}

static inline lane_mask gather_flags(uint32_t bits)
{
    int32_t flag[LANES];
    for (int i = 0; i < LANES; ++i) {
        flag[i] = (int32_t)((bits >> i) & 1u);
    }
    return lanei_equal(lanei_load(flag), lanei_splat(1));
}

static inline lane_mask gather_march(const lmb_march_job *m, const seen_from *from, const lmb_point *d, lane_mask wanted)
{
    return march(m, from, lane3_splat(d->position.x, d->position.y, d->position.z),
                 lane3_splat(d->normal.x, d->normal.y, d->normal.z), wanted);
}

/* One vector of pixels against the discs of a group. Discs follow one another along the light's map, so SHARED of them
 * share the segment to their second; a pixel that is near a disc has a segment of its own. */
static inline void gather_discs(lmb_irradiance *inout, const lmb_tile *tile, int k, lane_mask hits, const lmb_point *discs,
                                uint32_t count, const lmb_march_job *m, const seen_from *from)
{
    const lane3 p = lane3_load(tile->position, k), n = lane3_load(tile->normal, k), face = lane3_load(tile->face, k);
    const lane zero = lane_splat(0.0f);
    lane_mask shared = hits;
    uint32_t known = 0; /* discs before this one have their shared answer */
    for (uint32_t j = 0; j < count; ++j) {
        const lmb_point *d = &discs[j];
        float uu = dot3(d->axis_u, d->axis_u), vv = dot3(d->axis_v, d->axis_v), uv = dot3(d->axis_u, d->axis_v);
        float area = 4.0f * sqrtf(maxf(uu * vv - uv * uv, 0.0f)), half2 = uu + vv + 2.0f * absf(uv);
        lane near2 = lane_splat(half2 * (LMB_NEAR * LMB_NEAR));
        lane3 to = lane3_sub(lane3_splat(d->position.x, d->position.y, d->position.z), p);
        lane r2 = lane3_dot(to, to);
        lane_mask close = mask_and(hits, lane_lt(r2, near2));
        lane weight = disc_factor(to, lane_max(r2, near2), n, lane3_splat(d->normal.x, d->normal.y, d->normal.z),
                                  lane_splat(area));
        if (mask_bits(close)) {
            weight = gather_quads(weight, close, tile, k, d);
        }
        lane_mask lit = mask_and(mask_and(hits, lane_lt(zero, weight)), lane_lt(zero, lane3_dot(face, to)));
        if (m != NULL && mask_bits(lit)) {
            lane_mask own = mask_and(lit, close), other = mask_and(lit, mask_not(close));
            if (mask_bits(other) && j >= known) {
                known = j - j % SHARED + SHARED;
                shared = gather_march(m, from, &discs[known - SHARED + 1 < count ? known - SHARED + 1 : j], hits);
            }
            lit = mask_and(other, shared);
            if (mask_bits(own)) {
                lit = mask_or(lit, gather_march(m, from, d, own));
            }
        }
        if (mask_bits(lit)) {
            gather_add(inout, k, lane_keep(lit, weight), d->flux[0], d->flux[1], d->flux[2]);
        }
    }
}

static void KERNEL(gather_near)(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                                uint32_t count, const lmb_march_job *m)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t mine = (uint32_t)(pixels >> k) & ((1u << LANES) - 1u);
        if (mine != 0) {
            seen_from from;
            if (m != NULL) {
                from = march_begin(m, tile, k);
            }
            gather_discs(inout, tile, k, gather_flags(mine), discs, count, m, &from);
        }
    }
}

#endif
