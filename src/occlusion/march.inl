/* march.inl: does the segment from a pixel to an emitter cross the surface that the viewer sees? Layer 4. [V24 V25 V26]
 *
 * All computed in the viewer's depth map, in which planes are affine in d and segments are straight. */

/* Two stored depths a pixel apart are one surface if they differ by at most this share, or by this many times the step
 * beside them: d is affine over a plane, so an edge-on wall has even steps and a silhouette does not. */
#define MIN_JUMP_SHARE   0.02f
#define MIN_SLOPE_FACTOR 2.0f
/* Square of the assumed depth of an object behind its front, in lengths of the segment that it hides: a segment through
 * the centre of a ball is half the hidden length behind the front. Trim at 0 / 1/2 / 1 length: corner_contact 0.190
 * 0.073 0.088, bunny_room 0.081 0.076 0.112, cornell 0.051 0.036 0.030, grazing_sun 0.059 0.065 0.083. */
#define DEPTH_2 0.25f

/* A vector of pixels in the viewer's frame, and the depth plane of each pixel's surface. */
typedef struct seen_from {
    lane w;           /* m along the axis */
    lane px, py, d;   /* position in the map */
    lane dx, dy;      /* plane of the surface: d per px */
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

/* d of the plane through v with normal n, per px: d is affine in the map, as are the dot products of rays with n. */
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
    const lane min = lane_splat(-1e-6f); /* the surface faces the viewer: negative */
    gain = lane_div(gain, lane_min(bottom, min));
    *dx = lane_mul(lane_mul(gain, nx), lane_splat(1.0f / m->scale_x));
    *dy = lane_mul(lane_mul(gain, ny), lane_splat(-1.0f / m->scale_y));
    return lane_lt(bottom, min);
}

/* Returns the pixels in the viewer's axes, m. */
static inline lane3 march_begin(seen_from *out, const lmb_march_job *m, lane3 position, lane3 face)
{
    lane3 v = march_view(m, position);
    v.z = lane_max(v.z, lane_splat(m->near_m));
    out->w = v.z;
    march_place(&out->px, &out->py, &out->d, m, v);
    march_plane(&out->dx, &out->dy, m, v, face);
    return v;
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

/* Stored depth at integer pixels inside the map. */
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

/* Segments in the map, from each pixel of a vector towards one emitter. */
typedef struct march_run {
    lane rise;     /* d of the segment's end above the pixel's surface plane */
    lane end_x, end_y, end_d;       /* position of the emitter */
    lane end_dx, end_dy, end_rise;  /* plane of the emitter: d per px; d of the segment's start above it */
    lane w_end;    /* m along the view's axis */
    lane end;      /* share of the segment that lies inside the frame */
    lane samples;  /* one per px of that part, at most m->steps */
} march_run;

/* Extent of the whole segments, px. */
static inline lane march_x(const seen_from *s, const march_run *r) { return lane_sub(r->end_x, s->px); }
static inline lane march_y(const seen_from *s, const march_run *r) { return lane_sub(r->end_y, s->py); }

/* The larger side of a segment's box in the map, px. */
static inline lane march_length(const seen_from *s, const march_run *r)
{
    const lane zero = lane_splat(0.0f), x = march_x(s, r), y = march_y(s, r);
    return lane_max(lane_max(x, lane_sub(zero, x)), lane_max(y, lane_sub(zero, y)));
}

/* Segments from `start`, in the viewer's axes. */
static inline void march_towards(march_run *out, const lmb_march_job *m, const seen_from *s, lane3 start, lane3 at,
                                 lane3 axis)
{
    march_run r;
    lane3 v = march_view(m, at);
    lane_mask level = march_plane(&r.end_dx, &r.end_dy, m, v, axis);
    if (m->perspective) { /* clip at the near plane */
        lane near_m = lane_splat(m->near_m);
        lane_mask behind = lane_lt(v.z, near_m);
        lane run = lane_pick(behind, lane_sub(start.z, v.z), lane_splat(1.0f));
        lane share = lane_pick(behind, lane_div(lane_sub(start.z, near_m), run), lane_splat(1.0f));
        v.x = lane_add(start.x, lane_mul(lane_sub(v.x, start.x), share));
        v.y = lane_add(start.y, lane_mul(lane_sub(v.y, start.y), share));
        v.z = lane_max(lane_add(start.z, lane_mul(lane_sub(v.z, start.z), share)), near_m);
    }
    lane px, py, d;
    march_place(&px, &py, &d, m, v);
    r.w_end = v.z;
    r.end_x = px;
    r.end_y = py;
    r.end_d = d;
    const lane x = march_x(s, &r), y = march_y(s, &r);
    r.rise = lane_sub(lane_sub(d, s->d), lane_add(lane_mul(x, s->dx), lane_mul(y, s->dy)));
    /* An emitter turned away from the viewer is not in the map, so it has no surface to step over. */
    r.end_rise = lane_sub(lane_sub(s->d, d),
                          lane_sub(lane_splat(0.0f), lane_add(lane_mul(x, r.end_dx), lane_mul(y, r.end_dy))));
    r.end_rise = lane_pick(level, r.end_rise, lane_splat(-1e30f));
    r.end = lane_min(march_inside(s->px, px, m->last_x + 1.0f), march_inside(s->py, py, m->last_y + 1.0f));
    r.samples = lane_trunc(
        lane_min(lane_add(lane_mul(march_length(s, &r), r.end), lane_splat(1.0f)), lane_splat((float)m->steps)));
    *out = r;
}

/* Stored d at share t of the segments. Returns the height above the segments: if positive, the viewer's surface hides
 * the point.
 *
 * Both heights are relative to the pixel's surface plane, the stored one at the centre of the texel. So a flat receiver
 * never shadows itself at any viewing angle, and no bias needs tuning. */
NOINLINE lane march_height(lane *stored, const lmb_march_job *m, const seen_from *s, const march_run *r, lane t)
{
    const lane zero = lane_splat(0.0f), half = lane_splat(0.5f);
    lane x = lane_add(s->px, lane_mul(march_x(s, r), t)), y = lane_add(s->py, lane_mul(march_y(s, r), t));
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

/* Position of sample i along the segments: equal steps of the map, or of the world as seen in the map. */
static inline lane march_share(const lmb_march_job *m, const seen_from *s, const march_run *r, int i)
{
    lane t = lane_div(lane_splat((float)i + 0.5f), r->samples);
    if (m->kind == LMB_OCCLUSION_VIEW_WORLD && m->perspective) {
        t = lane_div(lane_mul(t, r->w_end), lane_add(s->w, lane_mul(lane_sub(r->w_end, s->w), t)));
        return lane_min(t, r->end);
    }
    return lane_mul(t, r->end);
}

/* d -> m along the view's axis. */
static inline lane march_w(const lmb_march_job *m, lane d)
{
    d = lane_max(d, lane_splat(1e-9f));
    return m->perspective ? lane_div(lane_splat(m->near_m), d)
                          : lane_sub(lane_splat(m->far_m), lane_mul(d, lane_splat(m->far_m - m->near_m)));
}

static inline lane march_gap(lane a, lane b) { return lane_max(lane_sub(a, b), lane_sub(b, a)); }

/* Between two samples on different sides of the viewer's surface: does the segment cross the surface, or pass behind a
 * silhouette? Halves the gap to about a pixel; if the surface still jumps there, it is two surfaces. */
LANE_NOINLINE lane_mask march_crosses(const lmb_march_job *m, const seen_from *s, const march_run *r, lane from,
                                      lane to, lane from_d, lane to_d, lane_mask from_hidden)
{
    for (int i = 0; i < 4; ++i) {
        lane stored, middle = lane_mul(lane_add(from, to), lane_splat(0.5f));
        lane_mask hidden = lane_lt(lane_splat(0.0f), march_height(&stored, m, s, r, middle));
        lane_mask first =
            mask_not(mask_or(mask_and(hidden, mask_not(from_hidden)), mask_and(from_hidden, mask_not(hidden))));
        from = lane_pick(first, middle, from);
        from_d = lane_pick(first, stored, from_d);
        to = lane_pick(first, to, middle);
        to_d = lane_pick(first, to_d, stored);
    }
    const lane one = lane_splat(1.0f), pixel = lane_div(one, lane_max(march_length(s, r), one));
    lane before, after, jump = march_gap(from_d, to_d);
    march_height(&before, m, s, r, lane_sub(from, pixel));
    march_height(&after, m, s, r, lane_add(to, pixel));
    lane slope = lane_max(march_gap(before, from_d), march_gap(to_d, after));
    return lane_le(jump, lane_add(lane_mul(lane_splat(MIN_JUMP_SHARE), lane_min(from_d, to_d)),
                                  lane_mul(lane_splat(MIN_SLOPE_FACTOR), slope)));
}

/* The point at share t of the segments, in the viewer's axes, m. */
static inline lane3 march_point(const lmb_march_job *m, const seen_from *s, const march_run *r, lane t)
{
    lane3 p;
    lane d = lane_add(s->d, lane_mul(lane_sub(r->end_d, s->d), t));
    p.z = march_w(m, d);
    lane wide = m->perspective ? p.z : lane_splat(1.0f);
    lane px = lane_add(s->px, lane_mul(march_x(s, r), t)), py = lane_add(s->py, lane_mul(march_y(s, r), t));
    p.x = lane_mul(lane_mul(lane_sub(px, lane_splat(m->middle_x)), lane_splat(1.0f / m->scale_x)), wide);
    p.y = lane_mul(lane_mul(lane_sub(py, lane_splat(m->middle_y)), lane_splat(1.0f / m->scale_y)), wide);
    return p;
}

/* A segment is hidden from share `in` to `out`. `gap`: smallest depth of the segment behind the front, m. Returns
 * whether the segment passes through the object rather than behind it. The far side is unknown. Objects are assumed
 * about as deep as wide: blocked if the segment comes closer to the front than half the hidden length. */
LANE_NOINLINE lane_mask march_through(const lmb_march_job *m, const seen_from *s, const march_run *r, lane in, lane out,
                                      lane gap)
{
    lane3 chord = lane3_sub(march_point(m, s, r, out), march_point(m, s, r, in));
    return lane_lt(lane_mul(gap, gap), lane_mul(lane_splat(DEPTH_2), lane3_dot(chord, chord)));
}

/* Returns the wanted segments from the pixels to one emitter that cross nothing the viewer sees.            [V25]
 *
 * In the map a segment is straight and d is affine along it. A change of side across a continuous surface blocks. If
 * the segment passes behind a silhouette and comes out again, march_through decides. An end that stays hidden counts as
 * open. */
static inline lane_mask march(const lmb_march_job *m, const seen_from *s, const march_run *r, lane_mask wanted)
{
    const lane zero = lane_splat(0.0f);
    lane_mask open = wanted, hidden_before = lane_lt(zero, zero);
    lane before = zero, stored_before = s->d, in = zero, gap = lane_splat(1e9f);
    for (int i = 0; i < m->steps && mask_bits(open); ++i) {
        lane stored, t = march_share(m, s, r, i);
        lane_mask hidden = lane_lt(zero, march_height(&stored, m, s, r, t));
        lane_mask changed =
            mask_or(mask_and(hidden, mask_not(hidden_before)), mask_and(hidden_before, mask_not(hidden)));
        changed = mask_and(mask_and(changed, open), lane_lt(lane_splat((float)i), r->samples));
        if (mask_bits(changed)) {
            lane_mask crosses = march_crosses(m, s, r, before, t, stored_before, stored, hidden_before);
            open = mask_and(open, mask_not(mask_and(changed, crosses)));
            lane middle = lane_mul(lane_add(before, t), lane_splat(0.5f));
            lane_mask leaves = mask_and(mask_and(changed, hidden_before), open);
            if (mask_bits(leaves)) {
                open = mask_and(open, mask_not(mask_and(leaves, march_through(m, s, r, in, middle, gap))));
            }
            in = lane_pick(changed, middle, in);
            gap = lane_pick(changed, lane_splat(1e9f), gap);
        }
        if (mask_bits(mask_and(hidden, open))) {
            lane d = lane_add(s->d, lane_mul(lane_sub(r->end_d, s->d), t));
            gap = lane_pick(hidden, lane_min(gap, lane_sub(march_w(m, d), march_w(m, stored))), gap);
        }
        hidden_before = hidden;
        before = t;
        stored_before = stored;
    }
    return open;
}
