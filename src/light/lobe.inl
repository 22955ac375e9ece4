/* lobe.inl: the glossy lobe: GGX, height-correlated Smith, Schlick; of a light without area and of a disc. Layer 5.
 *
 * A disc is asked for its mean. Let s be the slope (tangent of the angle to n) of the half vector h = (l + v) / |l +
 * v|. GGX's density of slopes, a2 / (pi (a2 + s^2)^2), is what a sphere's surface becomes by stereographic
 * projection, with s = alpha tan(angle / 2): and this takes circles to circles. So the share of all slopes that lies
 * in a circle of radius t around s is that of a cap of the sphere, exactly:
 *   share = (1 - q / root) / 2,  q = a2 + s^2 - t^2,  root = sqrt(q^2 + 4 a2 t^2),
 * and the mean density in it is share / (pi t^2): the density itself for t = 0, at most 1 / (pi t^2). For q >= 0 the
 * same is 2 a2 / (pi root (root + q)), without a difference of near numbers.
 * The directions to a disc of solid angle w are as many half vectors as w / (4 l.h) (Walter et al. 2007, equation 14),
 * and as many slopes as that over (n.h)^3: they are taken as a circle of this area, t^2 = w / (4 pi l.h (n.h)^3).
 * Wrong is only the shape: seen at an angle the disc's circle of slopes is an ellipse. A disc that fills much of the
 * sky is no circle at all: as nothing reflects more than the disc's own radiance, D V is at most 1 / (n.l w).
 *
 * Discs stand for surfaces that go on beside them. Where the lobe is sharper than a disc, discs side by side would
 * show, with gaps and overlaps: so alpha^2 grows by a part of t^2. An even wall of 64 texels in a floor of roughness
 * 0.1 | 0.2 (unit/test_glossy) is off by 20 | 8 % at its worst by 1/4, by 14 | 1 % by 1/2, by 8 | 2 % by 1. */
#ifndef LMB_LOBE_FORMULA
#define LMB_LOBE_FORMULA

#define LOBE_WIDEN  0.5f   /* of t^2: added to alpha^2 */
#define LOBE_MIN    1e-3f  /* of cosines: lights and viewers that graze more count as if they did not */
#define LOBE_MIN2   1e-12f /* of t^2: far under any alpha^2 */
#define LOBE_RISE   1e-2f  /* 1 - v.h is at least this: its fifth power stays a number far from the least ones */
#define LOBE_DARK   1e-6f  /* of D V: what is under it is 0 */
#define LOBE_E_DARK 1e-20f /* W/m2: the same of light */

/* A vector of pixels. */
typedef struct lobe_pixels {
    lane3 n, v, specular; /* normal; to the viewer; F0 */
    lane facing, a2;
} lobe_pixels;

static inline lobe_pixels lobe_load(const lmb_glossy *glossy, const lmb_tile *tile, int k)
{
    lobe_pixels p;
    p.n = lane3_load(tile->normal, k);
    p.v = lane3_load(glossy->towards, k);
    p.specular = lane3_load(glossy->specular, k);
    p.facing = lane_load(glossy->facing + k);
    p.a2 = lane_load(glossy->alpha2 + k);
    return p;
}

/* D V, 1/sr: of a light in direction `to`, unit, that takes solid angle `w`. *rise becomes (1 - v.h)^5. */
static inline lane lobe_value(lane *rise, const lobe_pixels *p, lane3 to, lane w)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane nv = p->facing, nl = lane_max(lane3_dot(p->n, to), lane_splat(LOBE_MIN));
    const lane3 h = lane3_add(to, p->v), off = lane3_sub(h, lane3_scale(p->n, lane3_dot(p->n, h)));
    const lane hh = lane_max(lane3_dot(h, h), lane_splat(LOBE_MIN2));
    /* With c = |h| n.h: s^2 = off^2 / c^2, t^2 = w hh / (2 pi c^3), D = density (hh / c^2)^2. */
    const lane ic = lane_div(one, lane_add(nl, nv)), ic2 = lane_mul(ic, ic), hc = lane_mul(hh, ic2);
    const lane s2 = lane_mul(lane3_dot(off, off), ic2);
    const lane t2 =
        lane_max(lane_mul(lane_mul(w, lane_splat(0.15915494f)), lane_mul(hc, ic)), lane_splat(LOBE_MIN2));
    const lane a2 = lane_add(p->a2, lane_mul(lane_splat(LOBE_WIDEN), t2));
    const lane q = lane_sub(lane_add(a2, s2), t2), twice = lane_add(a2, a2);
    const lane root = lane_sqrt(lane_add(lane_mul(q, q), lane_mul(lane_add(twice, twice), t2)));
    const lane_mask outside = lane_le(zero, q);
    const lane top = lane_pick(outside, twice, lane_sub(root, q));
    const lane bottom = lane_mul(root, lane_pick(outside, lane_add(root, q), lane_add(t2, t2)));
    /* V = 1 / 2 (n.l sqrt(a2 + (1 - a2) n.v^2) + n.v sqrt(a2 + (1 - a2) n.l^2)), of the surface's own alpha. */
    const lane rest = lane_sub(one, p->a2);
    const lane by_l = lane_mul(nl, lane_sqrt(lane_add(p->a2, lane_mul(rest, lane_mul(nv, nv)))));
    const lane by_v = lane_mul(nv, lane_sqrt(lane_add(p->a2, lane_mul(rest, lane_mul(nl, nl)))));
    const lane v = lane_div(lane_splat(0.15915494f), lane_add(by_l, by_v)); /* / pi, of the density */
    const lane mean = lane_mul(lane_mul(lane_div(top, bottom), lane_mul(hc, hc)), v);
    const lane max = lane_div(one, lane_mul(nl, lane_max(w, lane_splat(LOBE_MIN2))));
    const lane value = lane_min(mean, max);
    const lane low = lane_max(lane_sub(one, lane_mul(lane_splat(0.5f), lane_sqrt(hh))), lane_splat(LOBE_RISE));
    const lane low2 = lane_mul(low, low);
    *rise = lane_mul(lane_mul(low2, low2), low);
    return lane_keep(lane_lt(lane_splat(LOBE_DARK), value), value);
}

/* One channel: light e through the lobe. */
static inline lane lobe_light(lane e, lane value, lane specular, lane rise)
{
    const lane f = lane_add(specular, lane_mul(lane_sub(lane_splat(1.0f), specular), rise));
    return lane_mul(lane_keep(lane_lt(lane_splat(LOBE_E_DARK), e), e), lane_mul(value, f));
}

/* sum + what light e of solid angle w, from direction `to`, becomes on its way to the viewer. */
static inline lane3 lobe_add(lane3 sum, const lobe_pixels *p, lane3 to, lane w, lane3 e)
{
    lane rise;
    const lane value = lobe_value(&rise, p, to, w);
    sum.x = lane_add(sum.x, lobe_light(e.x, value, p->specular.x, rise));
    sum.y = lane_add(sum.y, lobe_light(e.y, value, p->specular.y, rise));
    sum.z = lane_add(sum.z, lobe_light(e.z, value, p->specular.z, rise));
    return sum;
}

static inline lane3 lobe_sum(const lmb_glossy *glossy, int k) { return lane3_load(glossy->rgb, k); }

static inline void lobe_store(lmb_glossy *out, int k, lane3 sum)
{
    lane_store(out->rgb[0] + k, sum.x);
    lane_store(out->rgb[1] + k, sum.y);
    lane_store(out->rgb[2] + k, sum.z);
}

#endif

#ifdef KERNEL

/* Pixels without a lobe stay as they are. */
static void KERNEL(glossy_direct)(lmb_glossy *inout, const lmb_tile *tile, const lmb_irradiance *lit,
                                  const lmb_light *light)
{
    const lane one = lane_splat(1.0f);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane_mask own = mask_of_bits((uint32_t)(inout->pixels >> k) & ALL_LANES);
        const lobe_pixels p = lobe_load(inout, tile, k);
        const lane3 sum = lobe_sum(inout, k), e = lane3_load(lit->rgb, k);
        lane3 to = lane3_splat(-light->direction.x, -light->direction.y, -light->direction.z);
        if (!light_kind_is(light->kind, LIGHT_FAR)) {
            to = lane3_sub(lane3_of(light->position), lane3_load(tile->position, k));
            to = lane3_scale(to, lane_sqrt(lane_div(one, lane_max(lane3_dot(to, to), lane_splat(1e-24f)))));
        }
        lobe_store(inout, k, lane3_pick(own, lobe_add(sum, &p, to, lane_splat(0.0f), e), sum));
    }
}

#endif
