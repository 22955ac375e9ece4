/* warp.inl: intersects the eye's rays with the complex surface, using the reference views. Layer 5.         [P3-P6 P12]
 *
 * Lanes are pixels. Let q be a point on a pixel's ray. A view has q at texel (u, v) with depth d and shows a surface of
 * depth s there: a candidate. f = d - s is positive if q is in front of the surface, negative if q is behind. Between
 * texels s is bilinear, so f changes along the ray at a known rate: the ray meets the view's surface about -f / rate
 * farther on. */
#define RELIEF_JUMP   4.0f  /* texels: neighbours with a larger depth difference are two surfaces */
#define RELIEF_TURNED 0.02f /* a surface that rises along the ray by less faces away from the eye */
#define RELIEF_BEFORE 0.1f   /* max pixels of a point in front of its surface, and ... */
#define RELIEF_BEHIND 0.5f  /* ... behind it */
#define RELIEF_ROUNDS 3     /* surfaces on a ray: grazed ones, and the one that is hit */
#define RELIEF_AS_EYE 0.5f  /* min cosine to the eye's ray of views that can show the next surface */
#define RELIEF_SAME   0.99999f /* min cosine of directions that count as equal */
#define RELIEF_EQUAL  0.01f /* texels: candidates this close count as equally near; the first view wins */
#define RELIEF_RIM    0.01f /* texels a point may lie outside the outer texel middles (rounding) */
#define RELIEF_NEAR   1.0f  /* a view is dropped if its candidate is this many texels worse than the best ... */
#define RELIEF_FAR    4.0f  /* ... unless the best is farther off than this */
#define RELIEF_SETTLED 0.3f /* pixels; a smaller step is the last */
#define RELIEF_WORST  1e30f

typedef struct relief_ray {
    lane3 from, along; /* point on the simple surface; unit direction */
    lane3 normal;      /* of the simple surface */
    lane pixel;        /* m, side of a pixel at that depth */
} relief_ray;

/* A view's surface near a point. */
typedef struct relief_lookup {
    lane u, v, d;     /* the point, projected */
    lane gap;         /* m along the view's axis from the point to the surface */
    lane on;          /* m to the surface behind, if the point is past the edge of the nearer one */
    lane step;        /* m along the eye's ray to the surface */
    lane off;         /* m from the point (or the ray) to the candidate */
    lane s;           /* depth of the candidate */
    lanei at;         /* the nearest texel, or the upper left of four, and ... */
    lane fu, fv;      /* ... the position between the four */
    lane_mask of[4];  /* texels on the candidate's surface */
    lane_mask some;   /* the view has a surface there */
    lane_mask shown;  /* the view has a candidate: a surface that faces the eye */
    lane_mask whole;  /* all four texels are on the candidate's surface */
    lane_mask free;   /* the view sees through the point in all four texels */
    lane_mask empty;  /* at least one texel is empty */
} relief_lookup;

static inline lane relief_row(const float row[4], lane3 q)
{
    const lane3 a = lane3_splat(row[0], row[1], row[2]);
    return lane_add(lane3_dot(a, q), lane_splat(row[3]));
}

/* Rate of change of a view coordinate along a direction. */
static inline lane relief_rate(const float row[4], lane3 along)
{
    return lane3_dot(lane3_splat(row[0], row[1], row[2]), along);
}

/* Depth codes of texels of a view. */
static inline lanei relief_code(const lmb_relief_job *job, const lmb_relief_view *view, lanei at)
{
    return lanei_and(lanei_gather_rgba(view->texels, at),
                     lanei_splat(job->format == LMB_RELIEF_FULL ? 0xffffff : 0xffff));
}

static inline lane relief_depth(const lmb_relief_view *view, lanei code)
{
    return lane_add(lane_splat(view->min), lane_mul(lane_from_int(code), lane_splat(view->per_code)));
}

/* m along the view's axis for each unit of depth. */
static inline lane relief_metres(const lmb_relief_view *view, lane d)
{
    if (!view->perspective) {
        return lane_splat(0.0f - view->z_per_d);
    }
    return lane_div(lane_splat(view->near_m), lane_max(lane_mul(d, d), lane_splat(1e-12f)));
}

/* Width of a texel of the view at q, m. */
static inline lane relief_texel_at(const lmb_relief_view *view, lane3 q)
{
    if (!view->perspective) {
        return lane_splat(view->texel);
    }
    const lane ahead = lane3_dot(lane3_sub(lane3_of(view->eye), q), lane3_of(view->back));
    return lane_mul(lane_splat(view->texel), lane_max(ahead, lane_splat(view->near_m)));
}

/* Depth difference of RELIEF_JUMP texels. */
static inline lane relief_jump(const lmb_relief_view *view, lane d)
{
    const float texels = RELIEF_JUMP * view->texel;
    return view->perspective ? lane_mul(lane_splat(texels), d) : lane_splat(texels / (0.0f - view->z_per_d));
}

static inline lane3 relief_towards(const lmb_relief_view *view, lane3 q)
{
    if (!view->perspective) {
        return lane3_of(view->back);
    }
    const lane3 to = lane3_sub(lane3_of(view->eye), q);
    return lane3_scale(to, lane_div(lane_splat(1.0f), lane_sqrt(lane_max(lane3_dot(to, to), lane_splat(1e-20f)))));
}

/* Projects q into the view. w is clamped above 0, which keeps quotients finite. Returns the lanes inside the
 * picture. */
LANE_PART lane_mask relief_project(relief_lookup *out, lane *per_w, const lmb_relief_view *view, lane3 q)
{
    const lane zero = lane_splat(0.0f), rim = lane_splat(-RELIEF_RIM);
    const lane right = lane_splat((float)(view->width - 1)), bottom = lane_splat((float)(view->height - 1));
    lane_mask inside;
    out->u = relief_row(view->to_view[0], q);
    out->v = relief_row(view->to_view[1], q);
    out->d = relief_row(view->to_view[2], q);
    *per_w = lane_splat(1.0f);
    if (view->perspective) {
        const lane w = relief_row(view->to_view[3], q);
        const lane_mask before = lane_lt(lane_splat(1e-6f * view->near_m), w);
        *per_w = lane_div(lane_splat(1.0f), lane_pick(before, w, lane_splat(1.0f)));
        out->u = lane_mul(out->u, *per_w);
        out->v = lane_mul(out->v, *per_w);
        out->d = lane_keep(before, lane_mul(out->d, *per_w));
    }
    inside = mask_and(mask_and(lane_le(rim, out->u), lane_le(out->u, lane_sub(right, rim))),
                      mask_and(lane_le(rim, out->v), lane_le(out->v, lane_sub(bottom, rim))));
    out->u = lane_max(lane_min(lane_keep(inside, out->u), right), zero);
    out->v = lane_max(lane_min(lane_keep(inside, out->v), bottom), zero);
    return view->perspective ? mask_and(inside, lane_lt(zero, out->d)) : inside;
}

/* The texel to the upper left of u, v, and the fractions between it and the next. */
static inline lanei relief_texel(lane *fu, lane *fv, const lmb_relief_view *view, lane u, lane v)
{
    const lane u0 = lane_min(lane_trunc(u), lane_splat((float)(view->width - 2))),
               v0 = lane_min(lane_trunc(v), lane_splat((float)(view->height - 2)));
    *fu = lane_sub(u, u0);
    *fv = lane_sub(v, v0);
    return lanei_add(lanei_mul(lane_to_int(v0), lanei_splat(view->width)), lane_to_int(u0));
}

/* Point of the surface that the view shows at u, v: the point with d = s. */
static inline lane3 relief_place(const lmb_relief_view *view, lane u, lane v, lane s)
{
    const lane3 across = lane3_add(lane3_of(view->corner), lane3_add(lane3_scale(lane3_of(view->per_u), u),
                                                                     lane3_scale(lane3_of(view->per_v), v)));
    if (view->perspective) {
        const lane z = lane_div(lane_splat(view->near_m), lane_max(s, lane_splat(1e-12f)));
        return lane3_add(lane3_of(view->eye), lane3_scale(across, z));
    }
    const lane z = lane_add(lane_splat(view->z_at_0), lane_mul(s, lane_splat(view->z_per_d)));
    return lane3_sub(across, lane3_scale(lane3_of(view->back), z));
}

/* Depths of four texels on the surface nearest to d. Texels on other surfaces get the depth of the nearest texel.
 * out->on: the nearest depth behind that surface, negative if none. Returns the lanes with a surface. */
LANE_PART lane_mask relief_gather(lane s[4], relief_lookup *out, const lmb_relief_job *job, const lmb_relief_view *view)
{
    const lane d = out->d;
    const lanei below = lanei_add(out->at, lanei_splat(view->width)), one = lanei_splat(1);
    /* Starts all four loads before the first is used. */
    const lanei code[4] = {relief_code(job, view, out->at), relief_code(job, view, lanei_add(out->at, one)),
                           relief_code(job, view, below), relief_code(job, view, lanei_add(below, one))};
    const lane jump = relief_jump(view, d);
    lane min = lane_splat(RELIEF_WORST), near = d;
    lane_mask some = lane_lt(min, min);
    out->free = mask_not(some);
    out->empty = some;
    for (int k = 0; k < 4; ++k) {
        s[k] = relief_depth(view, code[k]);
        out->of[k] = lanei_lt(lanei_splat(0), code[k]);
        out->empty = mask_or(out->empty, mask_not(out->of[k]));
        const lane far = lane_abs(lane_sub(s[k], d));
        const lane_mask nearer = mask_and(out->of[k], lane_lt(far, min));
        out->free = mask_and(out->free, mask_or(mask_not(out->of[k]), lane_lt(s[k], lane_sub(d, jump))));
        min = lane_pick(nearer, far, min);
        near = lane_pick(nearer, s[k], near);
        some = mask_or(some, nearer);
    }
    out->on = lane_splat(-1.0f);
    for (int k = 0; k < 4; ++k) {
        const lane_mask behind = mask_and(out->of[k], lane_lt(s[k], lane_sub(near, jump)));
        out->on = lane_max(out->on, lane_pick(behind, s[k], lane_splat(-1.0f)));
        out->of[k] = mask_and(out->of[k], lane_le(lane_abs(lane_sub(s[k], near)), jump));
        s[k] = lane_pick(out->of[k], s[k], near);
    }
    return some;
}

/* A vector of pixels, and the distance their rays have advanced. */
typedef struct relief_way {
    relief_ray ray;
    lane t;          /* m from the simple surface */
    uint32_t ask[LMB_RELIEF_TILE_VIEWS];  /* pixels, one bit each, that test each view ... */
    uint32_t kept[LMB_RELIEF_TILE_VIEWS]; /* ... and those for which the view was among the best */
    lane_mask live, moving;
} relief_way;

static inline lane3 relief_here(const relief_way *w)
{
    return lane3_add(w->ray.from, lane3_scale(w->ray.along, w->t));
}

/* Distance of the candidate from q, or from the eye's ray. */
static inline lane relief_off(const lmb_relief_job *job, const relief_ray *ray, lane3 to)
{
    if (job->pick == LMB_RELIEF_EYE_RAY) {
        to = lane3_sub(to, lane3_scale(ray->along, lane3_dot(to, ray->along)));
    }
    return lane_sqrt(lane3_dot(to, to));
}

/* Orthographic views show the whole model, so space outside their pictures is empty. */
static inline lane_mask relief_free(const lmb_relief_view *view, lane_mask inside, lane_mask free)
{
    return view->perspective ? mask_and(inside, free) : mask_or(mask_not(inside), free);
}

/* Bilinear coverage by the texels of the candidate's surface. Texels show the surface at their middle, so the edge lies
 * at one half on average. */
static inline lane relief_cover(const relief_lookup *look)
{
    const lane one = lane_splat(1.0f), gu = lane_sub(one, look->fu), gv = lane_sub(one, look->fv);
    const lane upper = lane_add(lane_keep(look->of[0], gu), lane_keep(look->of[1], look->fu)),
               lower = lane_add(lane_keep(look->of[2], gu), lane_keep(look->of[3], look->fu));
    return lane_add(lane_mul(upper, gv), lane_mul(lower, look->fv));
}

/* Looks up a view, interpolating between texels. */
NOINLINE void relief_lookup_between(relief_lookup *out, const lmb_relief_job *job, const lmb_relief_view *view,
                                    const relief_way *w)
{
    const relief_ray *ray = &w->ray;
    const lane3 q = relief_here(w);
    lane s[4], per_w;
    const lane_mask inside = relief_project(out, &per_w, view, q);
    out->at = relief_texel(&out->fu, &out->fv, view, out->u, out->v);
    const lane_mask some = relief_gather(s, out, job, view);
    const lane across = lane_sub(s[1], s[0]), down = lane_sub(s[2], s[0]),
               twist = lane_sub(lane_sub(s[3], s[2]), across);
    const lane su = lane_add(across, lane_mul(twist, out->fv)), sv = lane_add(down, lane_mul(twist, out->fu));
    out->s = lane_add(s[0], lane_add(lane_mul(su, out->fu), lane_mul(down, out->fv)));
    const lane dw = relief_rate(view->to_view[3], ray->along);
    const lane du = lane_mul(lane_sub(relief_rate(view->to_view[0], ray->along), lane_mul(out->u, dw)), per_w),
               dv = lane_mul(lane_sub(relief_rate(view->to_view[1], ray->along), lane_mul(out->v, dw)), per_w),
               dd = lane_mul(lane_sub(relief_rate(view->to_view[2], ray->along), lane_mul(out->d, dw)), per_w);
    const lane rate = lane_sub(dd, lane_add(lane_mul(su, du), lane_mul(sv, dv)));
    const lane metres = relief_metres(view, out->d), f = lane_sub(out->d, out->s);
    const lane_mask turned = lane_lt(lane_mul(rate, metres), lane_splat(-RELIEF_TURNED));
    out->gap = lane_mul(f, metres);
    out->step = lane_div(f, lane_pick(turned, lane_sub(lane_splat(0.0f), rate), lane_splat(1.0f)));
    out->some = mask_and(inside, some);
    out->empty = relief_free(view, inside, out->empty);
    const lane_mask covers = lane_le(lane_splat(0.5f), relief_cover(out));
    const lane_mask off_edge = mask_and(mask_not(covers), lane_le(lane_splat(0.0f), out->on));
    out->on = lane_pick(off_edge, lane_mul(lane_sub(out->d, out->on), metres), out->gap);
    out->shown = mask_and(mask_and(out->some, turned), covers);
    out->free = relief_free(view, inside, out->free);
    out->whole = mask_and(mask_and(out->of[0], out->of[1]), mask_and(out->of[2], out->of[3]));
    out->off = relief_off(job, ray, lane3_scale(relief_towards(view, q), out->gap));
}

/* Looks up a view at the nearest texel. */
NOINLINE void relief_lookup_nearest(relief_lookup *out, const lmb_relief_job *job, const lmb_relief_view *view,
                                    const relief_way *w)
{
    const relief_ray *ray = &w->ray;
    const lane3 q = relief_here(w);
    lane per_w;
    const lane_mask inside = relief_project(out, &per_w, view, q);
    out->u = lane_trunc(lane_add(out->u, lane_splat(0.5f)));
    out->v = lane_trunc(lane_add(out->v, lane_splat(0.5f)));
    out->at = lanei_add(lanei_mul(lane_to_int(out->v), lanei_splat(view->width)), lane_to_int(out->u));
    out->fu = out->fv = lane_splat(0.0f);
    const lanei code = relief_code(job, view, out->at);
    out->s = relief_depth(view, code);
    const lane3 to = lane3_sub(relief_place(view, out->u, out->v, out->s), q);
    const lane_mask some = lanei_lt(lanei_splat(0), code);
    out->gap = out->on = lane_mul(lane_sub(out->d, out->s), relief_metres(view, out->d));
    out->step = lane3_dot(to, ray->along);
    out->off = relief_off(job, ray, to);
    out->some = out->shown = out->whole = mask_and(inside, some);
    const lane_mask past = lane_lt(out->s, lane_sub(out->d, relief_jump(view, out->d)));
    out->free = relief_free(view, inside, mask_or(mask_not(some), past));
    out->empty = relief_free(view, inside, mask_not(some));
}

/* Looks up a view at the point that the ray has reached. */
static inline void relief_lookup_at(relief_lookup *out, const lmb_relief_job *job, const lmb_relief_view *view,
                                    const relief_way *w)
{
    if (job->sampling) {
        relief_lookup_nearest(out, job, view, w);
    } else {
        relief_lookup_between(out, job, view, w);
    }
}

/* --- choice of views ---------------------------------------------------------------------------------------------- */

/* The three best values so far. */
typedef struct relief_best {
    lane value[3]; /* descending */
    lanei view[3];
} relief_best;

static inline relief_best relief_none(void)
{
    relief_best b;
    for (int i = 0; i < 3; ++i) {
        b.value[i] = lane_splat(-RELIEF_WORST);
        b.view[i] = lanei_splat(-1);
    }
    return b;
}

static inline void relief_insert(relief_best *b, lane value, lanei view)
{
    for (int i = 0; i < 3; ++i) {
        const lane_mask over = lane_lt(b->value[i], value);
        const lane was = b->value[i];
        const lanei who = b->view[i];
        b->value[i] = lane_pick(over, value, was);
        b->view[i] = lanei_pick(over, view, who);
        value = lane_pick(over, was, value);
        view = lanei_pick(over, who, view);
    }
}

LANE_PART void relief_ray_of(relief_ray *r, const lmb_tile *tile, const lmb_relief_job *job, int k)
{
    const lane3 back = lane3_of(job->back), zero = lane3_splat(0.0f, 0.0f, 0.0f);
    r->from = lane3_load(tile->position, k);
    r->normal = lane3_load(tile->normal, k);
    r->along = lane3_sub(zero, back);
    r->pixel = lane_splat(job->pixel);
    if (job->perspective) {
        const lane3 to = lane3_sub(r->from, lane3_of(job->eye));
        const lane length = lane_sqrt(lane_max(lane3_dot(to, to), lane_splat(1e-20f)));
        r->along = lane3_scale(to, lane_div(lane_splat(1.0f), length));
        r->pixel = lane_mul(r->pixel, length);
    }
}

/* Score of a view for a pixel: how directly the view faces the surface, and how similar its direction is to the eye's.
 * If `pick` selects by ray, the second criterion dominates. */
LANE_PART lane relief_suits(const lmb_relief_job *job, const lmb_relief_view *view, const relief_ray *ray)
{
    const lane3 towards = relief_towards(view, ray->from);
    const lane faces = lane3_dot(ray->normal, towards), as_eye = lane_sub(lane_splat(0.0f),
                                                                         lane3_dot(ray->along, towards));
    const lane worth = lane_add(faces, lane_mul(as_eye, lane_splat(job->pick == LMB_RELIEF_EYE_RAY ? 8.0f : 0.5f)));
    relief_lookup at;
    lane per_w;
    if (!view->perspective) {
        return worth;
    }
    return lane_pick(relief_project(&at, &per_w, view, ray->from), worth, lane_splat(-100.0f));
}

static void KERNEL(relief_rank)(uint8_t votes[LMB_RELIEF_VIEWS], const lmb_tile *tile, const lmb_relief *relief,
                                const lmb_relief_job *job)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        relief_ray ray;
        relief_ray_of(&ray, tile, job, k);
        relief_best b = relief_none();
        int32_t view[LANES];
        for (int32_t i = 0; i < relief->views; ++i) {
            relief_insert(&b, relief_suits(job, &relief->view[i], &ray), lanei_splat(i));
        }
        for (int i = 0; i < 3; ++i) {
            lanei_store(view, b.view[i]);
            for (int n = 0; n < LANES; ++n) {
                votes[view[n] >= 0 ? view[n] : 0] += view[n] >= 0 && tile->id[k + n] != 0;
            }
        }
    }
}

/* --- advancing along the ray -------------------------------------------------------------------------------------- */

/* The result of a ray's last lookup. */
typedef struct relief_found {
    lane worth;      /* score of the best candidate ... */
    lane3 candidate; /* ... its position ... */
    lane_mask met;   /* ... and whether it lies on the ray */
    lane_mask seen_through;
    lane_mask passed;  /* the point lies in front of a surface of some view */
    lane as_eye, onward; /* cosine of the view nearest to the eye's direction; m to the surface in that view */
    lane weight, step; /* sums over the agreeing views */
    lane3 codes, normal;
} relief_found;

/* Penalty of a candidate, m: its distance, an oblique view, a depth discontinuity beside it. */
static inline lane relief_against(const lmb_relief_job *job, lane texel, const relief_lookup *look, lane faces)
{
    const lane one = lane_splat(1.0f);
    if (job->pick == LMB_RELIEF_EYE_RAY) {
        return lane_max(lane_sub(look->off, lane_mul(lane_splat(RELIEF_EQUAL), texel)), lane_splat(0.0f));
    }
    return lane_add(lane_add(look->off, lane_mul(texel, lane_mul(lane_splat(0.5f), lane_sub(one, faces)))),
                    lane_pick(look->whole, lane_splat(0.0f), texel));
}

/* Keeps the views of the best candidates for the pixels whose rays still advance. */
NOINLINE void relief_keep(relief_way *w, const lmb_relief_job *job, const relief_best *best)
{
    const uint32_t moving = mask_bits(w->moving);
    for (int32_t i = 0; i < job->count; ++i) {
        uint32_t among = 0;
        for (int k = 0; k < job->keep; ++k) {
            among |= mask_bits(lanei_equal(best->view[k], lanei_splat(i)));
        }
        w->kept[i] = (w->kept[i] & ~moving) | (among & moving);
    }
}

/* Runs one lookup for the pixels whose rays still advance and returns their steps. A view without a surface near the
 * best candidate so far is dropped, unless the best candidate is far off. The step is limited to three times the gap
 * plus a texel, which suffices for any surface that both the view and the eye see well. */
NOINLINE lane relief_advance(relief_way *w, const lmb_relief_job *job)
{
    const lane3 q = relief_here(w);
    const lane zero = lane_splat(0.0f), texel = relief_texel_at(job->view[0], q);
    const uint32_t moving = mask_bits(w->moving);
    lane step = zero;
    relief_best best = relief_none();
    for (int32_t i = 0; i < job->count; ++i) {
        const lmb_relief_view *view = job->view[i];
        const lane_mask asked = mask_and(w->moving, mask_of_bits(w->ask[i]));
        relief_lookup look;
        if (mask_bits(asked) == 0) {
            continue;
        }
        relief_lookup_at(&look, job, view, w);
        const lane faces = lane3_dot(w->ray.normal, relief_towards(view, q)), own = relief_texel_at(view, q);
        const lane worth = lane_pick(mask_and(asked, look.shown),
                                     lane_sub(zero, relief_against(job, own, &look, faces)),
                                     lane_splat(-RELIEF_WORST));
        const lane max = lane_add(lane_mul(lane_splat(3.0f), lane_abs(look.gap)), own);
        const lane_mask over = lane_lt(best.value[0], worth);
        step = lane_pick(over, lane_max(lane_min(look.step, max), lane_sub(zero, max)), step);
        relief_insert(&best, worth, lanei_splat(i));
        const lane min = lane_sub(best.value[0], lane_mul(lane_splat(RELIEF_NEAR), texel));
        w->ask[i] &= ~moving | mask_bits(lane_le(min, worth));
    }
    const uint32_t far = moving & mask_bits(lane_lt(best.value[0], lane_mul(lane_splat(-RELIEF_FAR), texel)));
    for (int32_t i = 0; i < job->count; ++i) {
        w->ask[i] |= far;
    }
    relief_keep(w, job, &best);
    return step;
}

/* --- the surface -------------------------------------------------------------------------------------------------- */

/* A signed field of `bits` bits at bit `from`. */
static inline lane relief_signed(lanei word, int from, int bits)
{
    return lane_from_int(lanei_shift(lanei_mul(word, lanei_splat((int32_t)(1u << (32 - from - bits)))), 32 - bits));
}

static inline lane relief_bits(lanei word, int from, int bits, float scale)
{
    return lane_mul(lane_from_int(lanei_and(lanei_shift(word, from), lanei_splat((1 << bits) - 1))), lane_splat(scale));
}

/* sRGB codes 0 .. 255. */
static inline lane3 relief_codes(const lmb_relief_job *job, const lmb_relief_view *view, lanei at)
{
    lane3 c;
    if (job->format == LMB_RELIEF_FULL) {
        const lanei word = lanei_gather_rgba(view->texels + 4 * (size_t)view->width * (size_t)view->height, at);
        c.x = relief_bits(word, 0, 8, 1.0f);
        c.y = relief_bits(word, 8, 8, 1.0f);
        c.z = relief_bits(word, 16, 8, 1.0f);
    } else {
        const lanei word = lanei_gather_rgba(view->texels, at);
        c.x = relief_bits(word, 16, 5, 255.0f / 31.0f);
        c.y = relief_bits(word, 21, 6, 255.0f / 63.0f);
        c.z = relief_bits(word, 27, 5, 255.0f / 31.0f);
    }
    return c;
}

/* Point on the octahedron |x| + |y| + |z| = 1: like lmb_octahedral_decode, but not normalized. */
static inline lane3 relief_normal(const lmb_relief_job *job, const lmb_relief_view *view, lanei at)
{
    const size_t texels = (size_t)view->width * (size_t)view->height;
    const int full = job->format == LMB_RELIEF_FULL;
    const lane max = lane_splat(full ? 32767.0f : 127.0f), zero = lane_splat(0.0f);
    lane3 n;
    if (full) {
        const lanei word = lanei_gather_rgba(view->texels + 8 * texels, at);
        n.x = relief_signed(word, 0, 16);
        n.y = relief_signed(word, 16, 16);
    } else {
        const lanei word = lanei_gather_rgba(view->texels + 4 * texels, lanei_shift(at, 1));
        const lane_mask odd = lanei_lt(lanei_splat(0), lanei_and(at, lanei_splat(1)));
        n.x = lane_pick(odd, relief_signed(word, 16, 8), relief_signed(word, 0, 8));
        n.y = lane_pick(odd, relief_signed(word, 24, 8), relief_signed(word, 8, 8));
    }
    n.x = lane_max(n.x, lane_sub(zero, max));
    n.y = lane_max(n.y, lane_sub(zero, max));
    n.z = lane_sub(lane_sub(max, lane_abs(n.x)), lane_abs(n.y));
    const lane fold = lane_min(n.z, zero), back = lane_sub(zero, fold);
    n.x = lane_add(n.x, lane_pick(lane_lt(n.x, zero), back, fold));
    n.y = lane_add(n.y, lane_pick(lane_lt(n.y, zero), back, fold));
    return lane3_scale(n, lane_splat(full ? 1.0f / 32767.0f : 1.0f / 127.0f));
}

/* Adds the weighted colour and normal of the texels on the candidate's surface. */
NOINLINE void relief_paint(relief_found *f, const lmb_relief_job *job, const lmb_relief_view *view,
                            const relief_lookup *look, lane weight)
{
    const lane one = lane_splat(1.0f), gu = lane_sub(one, look->fu), gv = lane_sub(one, look->fv);
    const lane part[4] = {lane_mul(gu, gv), lane_mul(look->fu, gv), lane_mul(gu, look->fv),
                          lane_mul(look->fu, look->fv)};
    const int32_t next[4] = {0, 1, view->width, view->width + 1};
    const int texels = job->sampling ? 1 : 4;
    for (int k = 0; k < texels; ++k) {
        const lanei at = lanei_add(look->at, lanei_splat(next[k]));
        const lane share = job->sampling ? weight : lane_keep(look->of[k], lane_mul(weight, part[k]));
        f->weight = lane_add(f->weight, share);
        f->codes = lane3_add(f->codes, lane3_scale(relief_codes(job, view, at), share));
        f->normal = lane3_add(f->normal, lane3_scale(relief_normal(job, view, at), share));
        f->step = lane_add(f->step, lane_mul(share, look->step));
    }
}

/* Weight of a view: depends on the angle to the surface, the distance of the candidate, and the number of texels (of
 * four) on its surface. */
static inline lane relief_weight(const lmb_relief_job *job, lane texel, const relief_lookup *look, lane faces)
{
    const lane one = lane_splat(1.0f), f = lane_max(faces, lane_splat(0.05f));
    const lane reach = lane_div(one, lane_mul(lane_splat(1.5f), texel));
    const lane near = lane_max(lane_sub(one, lane_mul(lane_abs(look->gap), reach)), lane_splat(0.0f));
    if (job->keep == 1) {
        return one;
    }
    return lane_mul(lane_mul(f, f), lane_mul(near, lane_pick(look->whole, one, lane_splat(0.02f))));
}

static inline void relief_clear(relief_found *f)
{
    const lane zero = lane_splat(0.0f);
    f->met = f->seen_through = f->passed = lane_lt(zero, zero);
    f->worth = lane_splat(-RELIEF_WORST);
    f->as_eye = lane_splat(RELIEF_AS_EYE);
    f->onward = f->weight = f->step = zero;
    f->candidate = f->codes = f->normal = lane3_splat(0.0f, 0.0f, 0.0f);
}

/* Adds to `f` the requested pixels of view i; `look` is the view's lookup at the points that the rays have reached. */
NOINLINE void relief_hear(relief_found *f, const relief_way *w, const lmb_relief_job *job, int32_t i,
                            const relief_lookup *look, lane_mask asked)
{
    const lmb_relief_view *view = job->view[i];
    const lane zero = lane_splat(0.0f), worst = lane_splat(-RELIEF_WORST);
    const lane before = lane_mul(lane_splat(RELIEF_BEFORE), w->ray.pixel),
               behind = lane_mul(lane_splat(-RELIEF_BEHIND), w->ray.pixel);
    const lane same = lane_splat(job->pick == LMB_RELIEF_EYE_RAY ? RELIEF_SAME : 2.0f);
    const lane3 q = relief_here(w), towards = relief_towards(view, q);
    const lane texel = relief_texel_at(view, q);
    const lane as_eye = lane_sub(zero, lane3_dot(towards, w->ray.along));
    const lane_mask ahead = mask_and(mask_and(asked, look->some), lane_lt(before, look->on));
    const lane_mask free = mask_and(asked, look->free);
    const lane_mask better = mask_and(ahead, lane_lt(f->as_eye, as_eye));
    f->passed = mask_or(f->passed, mask_or(free, ahead));
    f->seen_through = mask_or(f->seen_through, job->as_is ? mask_and(free, lane_lt(same, as_eye)) : free);
    f->as_eye = lane_pick(better, as_eye, f->as_eye);
    f->onward = lane_pick(better, lane_max(look->on, texel), f->onward);
    const lane faces = lane3_dot(w->ray.normal, towards);
    const lane_mask says = mask_and(mask_and(asked, mask_and(w->live, mask_of_bits(w->kept[i]))), look->shown);
    if (mask_bits(says) == 0) {
        return;
    }
    const lane worth = lane_pick(says, lane_sub(zero, relief_against(job, texel, look, faces)), worst);
    const lane_mask over = lane_lt(f->worth, worth);
    f->worth = lane_pick(over, worth, f->worth);
    f->candidate = lane3_pick(over, relief_place(view, look->u, look->v, look->s), f->candidate);
    const lane_mask met = mask_and(look->whole, mask_and(lane_le(look->gap, before), lane_le(behind, look->gap)));
    f->met = mask_or(mask_and(over, met), mask_and(f->met, mask_not(over)));
    relief_paint(f, job, view, look, lane_keep(says, relief_weight(job, texel, look, faces)));
}

/* Last lookup: the kept views define the surface; the other views decide whether a surface can exist there. */
NOINLINE void relief_arrive(relief_found *f, const relief_way *w, const lmb_relief_job *job)
{
    relief_clear(f);
    for (int32_t i = 0; i < job->count; ++i) {
        const lane_mask asked = i < job->aligned ? w->live : mask_and(w->live, mask_of_bits(w->ask[i]));
        relief_lookup look;
        if (mask_bits(asked) != 0) {
            relief_lookup_at(&look, job, job->view[i], w);
            relief_hear(f, w, job, i, &look, asked);
        }
    }
}

NOINLINE void relief_set_out(relief_way *w, const lmb_tile *tile, const lmb_relief_job *job, int k)
{
    int32_t id[LANES];
    for (int i = 0; i < LANES; ++i) {
        id[i] = tile->id[k + i] != 0;
    }
    relief_ray_of(&w->ray, tile, job, k);
    w->live = w->moving = lanei_lt(lanei_splat(0), lanei_load(id));
    w->t = lane_splat(0.0f);
    for (int i = 0; i < LMB_RELIEF_TILE_VIEWS; ++i) {
        w->kept[i] = 0;
    }
}

/* Interpolates between two sRGB codes: at most a quarter of a code off, exact at codes. */
static inline lane relief_linear(lane code)
{
    const lane whole = lane_min(lane_max(lane_trunc(code), lane_splat(0.0f)), lane_splat(254.0f));
    const lanei at = lane_to_int(whole);
    const lane low = lane_gather_f32(lmb_srgb_linear, at), high = lane_gather_f32(lmb_srgb_linear + 1, at);
    const lane part = lane_sub(code, whole);
    return lane_add(lane_mul(low, lane_sub(lane_splat(1.0f), part)), lane_mul(high, part));
}

static inline void relief_put(float (*planes)[LMB_TILE_PIXELS], int k, lane_mask m, lane3 v)
{
    const lane3 was = lane3_load((const float (*)[LMB_TILE_PIXELS])planes, k);
    lane_store(planes[0] + k, lane_pick(m, v.x, was.x));
    lane_store(planes[1] + k, lane_pick(m, v.y, was.y));
    lane_store(planes[2] + k, lane_pick(m, v.z, was.z));
}

NOINLINE void relief_store(lmb_tile *out, const relief_way *w, const relief_found *f, const lmb_relief_job *job,
                             lane_mask hit, int k)
{
    const lane per = lane_div(lane_splat(1.0f), lane_pick(hit, f->weight, lane_splat(1.0f)));
    const lane3 codes = lane3_scale(f->codes, per), n = resolve_unit(f->normal);
    const lane3 on_ray = lane3_add(relief_here(w), lane3_scale(w->ray.along, lane_mul(f->step, per)));
    const lane3 place = job->as_is ? f->candidate : on_ray;
    const lane depth = lane_sub(lane_splat(0.0f), lane3_dot(lane3_sub(place, lane3_of(job->eye)), lane3_of(job->back)));
    lane3 albedo;
    albedo.x = relief_linear(codes.x);
    albedo.y = relief_linear(codes.y);
    albedo.z = relief_linear(codes.z);
    relief_put(out->position, k, hit, place);
    relief_put(out->face, k, hit, n);
    relief_put(out->normal, k, hit, n);
    relief_put(out->albedo, k, hit, albedo);
    lane_store(out->depth + k, lane_pick(hit, depth, lane_load(out->depth + k)));
}

/* Advances each ray until its step is short. */
NOINLINE void relief_travel(relief_way *w, const lmb_relief_job *job)
{
    const lane near = lane_mul(lane_splat(RELIEF_SETTLED), w->ray.pixel);
    w->moving = w->live;
    for (int32_t i = 0; i < LMB_RELIEF_TILE_VIEWS; ++i) {
        w->ask[i] = ~0u;
    }
    lane step = relief_advance(w, job);
    for (int32_t i = 1; i < job->steps; ++i) {
        w->t = lane_add(w->t, lane_keep(w->moving, step));
        w->moving = mask_and(w->moving, lane_lt(near, lane_abs(step)));
        if (mask_bits(w->moving) == 0 || i + 1 == job->steps) {
            return;
        }
        step = relief_advance(w, job);
    }
}

/* Pixels with rays that end in open background: a view with about the eye's direction is empty there. */
NOINLINE lane_mask relief_open(const relief_way *w, const lmb_relief_job *job, lane_mask of)
{
    lane_mask open = mask_and(of, mask_not(of));
    for (int32_t i = 0; i < job->count && mask_bits(of) != 0; ++i) {
        const lane3 towards = relief_towards(job->view[i], relief_here(w));
        const lane as_eye = lane_sub(lane_splat(0.0f), lane3_dot(towards, w->ray.along));
        relief_lookup look;
        relief_lookup_at(&look, job, job->view[i], w);
        open = mask_or(open, mask_and(mask_and(of, look.empty), lane_lt(lane_splat(RELIEF_AS_EYE), as_eye)));
    }
    return open;
}

/* Sorts rays into three groups: hits, rays past all surfaces, and rays that go on. Returns 0 if none goes on. If no
 * view with a direction similar to the eye's has a surface at the end of a ray, the ray takes the nearest candidate.
 * The exception is open background in such a view: a surface seen only by a different view may be hidden from the
 * eye. */
NOINLINE int relief_end(relief_way *w, lmb_relief_found *out, lmb_tile *inout, const lmb_relief_job *job, int k,
                          int last)
{
    relief_found f;
    relief_arrive(&f, w, job);
    const lane_mask some = mask_and(w->live, lane_lt(lane_splat(1e-6f), f.weight));
    const lane_mask here = job->as_is ? some : mask_and(some, mask_or(f.met, mask_not(f.passed)));
    const lane_mask clear = mask_and(here, mask_not(f.seen_through));
    const lane_mask passed = mask_and(mask_and(w->live, f.passed), mask_not(clear));
    const lane_mask on = mask_and(passed, lane_lt(lane_splat(RELIEF_AS_EYE), f.as_eye));
    const int away = last && job->outside; /* behind a model's outside there is no further surface */
    const lane_mask ends = last && !away ? passed : mask_and(passed, mask_not(on));
    const lane_mask open = relief_open(w, job, ends);
    const lane_mask hit = mask_or(clear, mask_and(mask_and(ends, some), mask_not(open)));
    relief_store(inout, w, &f, job, hit, k);
    out->hit |= (uint64_t)mask_bits(hit) << k;
    out->missed |= (uint64_t)mask_bits(away ? mask_or(open, on) : open) << k;
    w->live = on;
    w->t = lane_add(w->t, lane_keep(on, f.onward));
    w->ray.normal = lane3_sub(lane3_splat(0.0f, 0.0f, 0.0f), w->ray.along);
    return mask_bits(on) != 0;
}

/* A ray that passes a surface goes on to the next surface in the view nearest to the eye's direction. */
static void KERNEL(relief_warp)(lmb_relief_found *out, lmb_tile *inout, const lmb_relief_job *job)
{
    const int rounds = job->as_is ? 1 : RELIEF_ROUNDS;
    out->hit = out->missed = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        relief_way w;
        int goes_on;
        relief_set_out(&w, inout, job, k);
        goes_on = mask_bits(w.live) != 0;
        for (int round = 1; goes_on && round <= rounds; ++round) {
            relief_travel(&w, job);
            goes_on = relief_end(&w, out, inout, job, k, round == rounds);
        }
    }
}
