/* lobe.inl: the glossy lobe: GGX, height-correlated Smith, Schlick; of a light without area and of a disc. Layer 4.
 *
 * For a disc, the lobe's mean is needed. Let s be the slope (tangent of the angle to n) of the half vector h = (l + v)
 * / |l + v|. GGX's density of slopes, a2 / (pi (a2 + s^2)^2), is the stereographic projection of a sphere's surface,
 * with s = alpha tan(angle / 2), and this projection maps circles to circles. So the share of all slopes in a circle of
 * radius t around s is exactly that of a cap of the sphere:
 *   share = (1 - q / root) / 2,  q = a2 + s^2 - t^2,  root = sqrt(q^2 + 4 a2 t^2),
 * and the mean density in the circle is share / (pi t^2): the density itself for t = 0, at most 1 / (pi t^2). For q >=
 * 0 the same is 2 a2 / (pi root (root + q)), without cancellation. The directions to a disc of solid angle w cover w /
 * (4 l.h) of half vectors (Walter et al. 2007, equation 14), and that over (n.h)^3 of slopes. They are approximated by
 * a circle of this area, t^2 = w / (4 pi l.h (n.h)^3). Only the shape is wrong: at an angle, the disc's slopes form an
 * ellipse. If a disc fills much of the sky, they are not a circle at all. So D V is limited to 1 / (n.l w), because no
 * reflection is brighter than the disc itself.
 *
 * Discs stand for surfaces that continue beside them. If the lobe is sharper than a disc, adjacent discs would show as
 * gaps and overlaps, so alpha^2 grows by a part of t^2. A uniform wall of 64 texels in a floor of roughness 0.1 | 0.2
 * (unit/test_glossy) has a worst error of 20 | 8 % with 1/4, 14 | 1 % with 1/2, 8 | 2 % with 1. */
#ifndef LMB_LOBE_FORMULA
#define LMB_LOBE_FORMULA

#define LOBE_WIDEN  0.5f   /* share of t^2 added to alpha^2 */
#define LOBE_MIN    1e-3f  /* minimum cosine to a light or viewer; smaller ones are clamped */
#define LOBE_MIN2   1e-12f /* minimum of t^2: far below any alpha^2 */
#define LOBE_RISE   1e-2f  /* minimum of 1 - v.h: the fifth power stays far from denormals */
#define LOBE_DARK   1e-6f  /* D V below this counts as 0 */
#define LOBE_E_DARK 1e-20f /* W/m2: irradiance below this counts as 0 */

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

/* D V, 1/sr, for a light in the unit direction `to` that covers solid angle `w`. Sets *rise to (1 - v.h)^5. */
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
    /* V = 1 / 2 (n.l sqrt(a2 + (1 - a2) n.v^2) + n.v sqrt(a2 + (1 - a2) n.l^2)), with the surface's alpha. */
    const lane rest = lane_sub(one, p->a2);
    const lane by_l = lane_mul(nl, lane_sqrt(lane_add(p->a2, lane_mul(rest, lane_mul(nv, nv)))));
    const lane by_v = lane_mul(nv, lane_sqrt(lane_add(p->a2, lane_mul(rest, lane_mul(nl, nl)))));
    const lane v = lane_div(lane_splat(0.15915494f), lane_add(by_l, by_v)); /* / pi, for the density */
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

/* sum + the reflection towards the viewer of light e with solid angle w from direction `to`. */
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

/* Pixels without a lobe do not change. */
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
