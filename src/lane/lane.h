/* lane.h: small formulas over the lane verbs, for several kernels. Include after a backend's header. Layer 2. */
#ifndef LMB_LANE_H
#define LMB_LANE_H

#include <string.h>

/* For functions that pay off only if inlined: constant arguments, structs that stay in registers. */
#if defined(__GNUC__)
#define LANE_INLINE static inline __attribute__((always_inline))
#else
#define LANE_INLINE static inline
#endif

/* NOINLINE if lanes are wide. With one lane the frame is small, and a call takes ROM. */
#if LANES > 1
#define LANE_NOINLINE NOINLINE
#else
#define LANE_NOINLINE static inline
#endif

/* A part of a long formula. Without vectors, each step's four lanes take separate places on the stack frame. */
#if defined(LANE_PLAIN) && LANES > 1
#define LANE_PART NOINLINE
#else
#define LANE_PART LANE_INLINE
#endif

#define ALL_LANES (~0u >> (32 - LANES)) /* bits of mask_bits */

/* Column and row of a tile's pixels k, k + 1, ...: k is a multiple of LANES, and 16 lanes cover two rows. */
static inline lane lane_column(int k)
{
    static const float column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
    return lane_load(column + k % LMB_TILE);
}

static inline lane lane_row(int k)
{
    static const float row[LMB_TILE_PIXELS] = {
        0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3,
        4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7, 7};
    return lane_load(row + k);
}

/* at + per_x column + per_y row of the same pixels. */
static inline lanei lanei_affine(int32_t at, int32_t per_x, int32_t per_y, int k)
{
    static const int32_t column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
    lanei r = lanei_mul(lanei_splat(per_x), lanei_load(column + k % LMB_TILE));
#if LANES > LMB_TILE
    static const int32_t below[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
    r = lanei_add(r, lanei_mul(lanei_splat(per_y), lanei_load(below)));
#endif
    return lanei_add(r, lanei_splat(at + per_y * (k / LMB_TILE)));
}

/* The part that lane_trunc cuts off values >= 0. Backends may override this. */
#ifndef LANE_HAS_PART
static inline lane lane_part(lane a) { return lane_sub(a, lane_trunc(a)); }
#endif

/* 0 <= a < n. Backends may override this. */
#ifndef LANE_HAS_WITHIN
static inline lane_mask lanei_within(lanei a, int32_t n)
{
    return mask_and(lanei_not_negative(a), lanei_lt(a, lanei_splat(n)));
}
#endif

/* Four bytes each, at 4 * `at`: the first byte in the low bits, on every target. Backends may override this. */
#ifndef LANE_GATHERS_RGBA
static inline lanei lanei_gather_rgba(const uint8_t *p, lanei at)
{
    int32_t i[LANES];
    lanei_store(i, at);
    for (int k = 0; k < LANES; ++k) {
        const uint8_t *b = p + 4 * (ptrdiff_t)i[k];
        i[k] = (int32_t)((uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24);
    }
    return lanei_load(i);
}
#endif

/* The first n words of a row, 1 .. LANES - 1; the others are 0, or not written. Backends may override these. */
#ifndef LANE_HAS_SOME
static inline lanei lanei_load_some(const uint8_t *p, int n)
{
    int32_t v[LANES] = {0};
    for (int k = 0; k < n; ++k) {
        memcpy(&v[k], p + 4 * k, 4);
    }
    return lanei_load(v);
}
static inline void lanei_store_some(uint8_t *p, int n, lanei a)
{
    int32_t v[LANES];
    lanei_store(v, a);
    for (int k = 0; k < n; ++k) {
        memcpy(p + 4 * k, &v[k], 4);
    }
}
#endif

/* Pixels of four 8-bit codes in a word, the highest one the share a. times: x y / 255; over: (x a + y (255 - a)) / 255
 * with the a of x; plus: x a / 255 + y, at most 255; same: x as over, for rows of one x; between: corners
 * at (0, 0), (1, 0), (0, 1), (1, 1), in the shares of 256 that are the lowest bytes of x and y. All rounded to nearest.
 * Backends may override these. */
#ifndef LANE_HAS_CODES
/* v / 255 of two codes at once, in the low and the high half. */
LANE_INLINE lanei lanei_pair_255th(lanei v)
{
    const lanei pair = lanei_splat(0x00ff00ff);
    v = lanei_add(v, lanei_splat(0x00800080));
    return lanei_and(lanei_shift(lanei_add(v, lanei_and(lanei_shift(v, 8), pair)), 8), pair);
}
LANE_INLINE lanei lanei_pair_times(lanei x, lanei y)
{
    const lanei low = lanei_splat(255);
    const lanei high = lanei_mul(lanei_and(lanei_shift(x, 16), low), lanei_and(lanei_shift(y, 16), low));
    return lanei_pair_255th(
        lanei_or(lanei_mul(lanei_and(x, low), lanei_and(y, low)), lanei_mul(high, lanei_splat(1 << 16))));
}
LANE_INLINE lanei lanei_pair_over(lanei x, lanei y, lanei share)
{
    return lanei_pair_255th(lanei_add(lanei_mul(x, share), lanei_mul(y, lanei_sub(lanei_splat(255), share))));
}
LANE_INLINE lanei lanei_pair_plus(lanei x, lanei y, lanei share)
{
    const lanei sum = lanei_add(lanei_pair_255th(lanei_mul(x, share)), y);
    const lanei over = lanei_and(sum, lanei_splat(0x01000100));
    return lanei_and(lanei_or(sum, lanei_sub(over, lanei_shift(over, 8))), lanei_splat(0x00ff00ff));
}
LANE_INLINE lanei lanei_even_codes(lanei v) { return lanei_and(v, lanei_splat(0x00ff00ff)); }
LANE_INLINE lanei lanei_odd_codes(lanei v) { return lanei_and(lanei_shift(v, 8), lanei_splat(0x00ff00ff)); }
LANE_INLINE lanei lanei_share_code(lanei v) { return lanei_and(lanei_shift(v, 24), lanei_splat(255)); }
LANE_INLINE lanei lanei_join_codes(lanei even, lanei odd)
{
    return lanei_or(even, lanei_mul(odd, lanei_splat(1 << 8)));
}
LANE_INLINE lanei codes_times(lanei x, lanei y)
{
    return lanei_join_codes(lanei_pair_times(lanei_even_codes(x), lanei_even_codes(y)),
                            lanei_pair_times(lanei_odd_codes(x), lanei_odd_codes(y)));
}
LANE_INLINE lanei codes_over(lanei x, lanei y)
{
    const lanei share = lanei_share_code(x);
    return lanei_join_codes(lanei_pair_over(lanei_even_codes(x), lanei_even_codes(y), share),
                            lanei_pair_over(lanei_odd_codes(x), lanei_odd_codes(y), share));
}
LANE_INLINE lanei codes_plus(lanei x, lanei y)
{
    const lanei share = lanei_share_code(x);
    return lanei_join_codes(lanei_pair_plus(lanei_even_codes(x), lanei_even_codes(y), share),
                            lanei_pair_plus(lanei_odd_codes(x), lanei_odd_codes(y), share));
}
LANE_INLINE lanei codes_same(lanei x, lanei y) { return codes_over(x, y); }
LANE_INLINE lanei lanei_code_at(lanei v, int shift) { return lanei_and(lanei_shift(v, shift), lanei_splat(255)); }
LANE_INLINE lanei codes_between(const lanei corner[4], lanei x, lanei y)
{
    x = lanei_code_at(x, 0);
    y = lanei_code_at(y, 0);
    const lanei all = lanei_splat(256), left = lanei_sub(all, x), upper = lanei_sub(all, y);
    const lanei a = lanei_mul(left, upper), b = lanei_mul(x, upper), c = lanei_mul(left, y), d = lanei_mul(x, y);
    lanei made = lanei_splat(0);
    for (int shift = 24; shift >= 0; shift -= 8) {
        lanei sum = lanei_add(lanei_mul(lanei_code_at(corner[0], shift), a), lanei_splat(1 << 15));
        sum = lanei_add(sum, lanei_mul(lanei_code_at(corner[1], shift), b));
        sum = lanei_add(sum, lanei_mul(lanei_code_at(corner[2], shift), c));
        sum = lanei_add(sum, lanei_mul(lanei_code_at(corner[3], shift), d));
        made = lanei_or(lanei_mul(made, lanei_splat(1 << 8)), lanei_shift(sum, 16));
    }
    return made;
}
#endif

/* Clamps to at least `low`, then to at most `high`. Backends may override this. */
#ifndef LANE_HAS_HOLD
static inline lane lane_hold(lane a, lane low, lane high) { return lane_min(lane_max(a, low), high); }
#endif

/* The smallest value of a vector. Backends may override this. */
#ifndef LANE_HAS_LOWEST
static inline float lane_lowest(lane a)
{
    float v[LANES], lowest;
    lane_store(v, a);
    lowest = v[0];
    for (int k = 1; k < LANES; ++k) {
        lowest = v[k] < lowest ? v[k] : lowest;
    }
    return lowest;
}
#endif

/* The sum of sixteen values in one order on every backend: first pairs eight apart, then four, two, one. Backends may
 * override this. */
#ifndef LANE_HAS_SUM16
static inline float lane_sum16(const float v[16])
{
    float b[4];
#if LANES == 4
    lane_store(b, lane_add(lane_add(lane_load(v), lane_load(v + 8)), lane_add(lane_load(v + 4), lane_load(v + 12))));
#else
    for (int i = 0; i < 4; ++i) {
        b[i] = (v[i] + v[i + 8]) + (v[i + 4] + v[i + 12]);
    }
#endif
    return (b[0] + b[2]) + (b[1] + b[3]);
}
#endif

/* Prefix sums of sixteen values, plus `base`. Each value adds the one before it, then the results 2, 4 and 8 before it.
 * Backends may override this. */
#ifndef LANE_HAS_SCAN16
static inline void lane_scan16(float out[16], const float v[16], float base)
{
    float a[24], b[32];
    for (int i = 0; i < 16; ++i) {
        b[i] = 0.0f;
    }
    for (int i = 0; i < 8; ++i) {
        a[i] = 0.0f;
    }
    b[16] = v[0];
    for (int i = 1; i < 16; ++i) {
        b[16 + i] = v[i] + v[i - 1];
    }
    for (int i = 0; i < 16; ++i) {
        a[8 + i] = b[16 + i] + b[14 + i];
    }
    for (int i = 0; i < 16; ++i) {
        b[16 + i] = a[8 + i] + a[4 + i];
    }
    for (int i = 0; i < 16; ++i) {
        out[i] = b[16 + i] + b[8 + i] + base;
    }
}
#endif

/* `low` in the low 16 bits, `high` in the high ones. */
static inline lanei lanei_halves(lanei low, lanei high)
{
    return lanei_or(lanei_and(low, lanei_splat(0xffff)), lanei_mul(high, lanei_splat(1 << 16)));
}

/* The product of the low halves plus that of the high halves, all signed. Backends may override this. */
#ifndef LANE_ADDS_HALVES
static inline lanei lanei_add_halves(lanei a, lanei b)
{
    const lanei up = lanei_splat(1 << 16), low_a = lanei_shift(lanei_mul(a, up), 16),
                low_b = lanei_shift(lanei_mul(b, up), 16);
    return lanei_add(lanei_mul(low_a, low_b), lanei_mul(lanei_shift(a, 16), lanei_shift(b, 16)));
}
#endif

/* The square root within 2^-11 of it, for a guess that changes no result; any value for 0 and denormals. Backends may
 * override this. */
#ifndef LANE_GUESSES_ROOTS
static inline lane lane_root_guess(lane a) { return lane_sqrt(a); }
#endif

/* A word each. Backends may override this. */
#ifndef LANE_GATHERS_I32
static inline lanei lanei_gather_i32(const int32_t *p, lanei at)
{
    int32_t i[LANES];
    lanei_store(i, at);
    for (int k = 0; k < LANES; ++k) {
        i[k] = p[i[k]];
    }
    return lanei_load(i);
}
#endif

/* Four floats each, at 4 * `at`. Backends may override this. */
#ifndef LANE_GATHERS_RGBA_F32
static inline void lane_gather_rgba_f32(lane out[4], const float *p, lanei at)
{
    at = lanei_mul(at, lanei_splat(4));
    for (int c = 0; c < 4; ++c) {
        out[c] = lane_gather_f32(p + c, at);
    }
}
#endif

/* Adds four links to sums. The low half of a link is the row number, the high half the weight. A directed link has
 * three weights in two words: x above the row number, y below z. Backends may override this. */
#ifndef LANE_ADDS_LINKS
static inline lane_sums sums_add_links(lane_sums s, uint16_t (*row)[4], const uint32_t *link)
{
    for (int i = 0; i < 4; i += 2) {
        const uint32_t a = link[i], b = link[i + 1];
        s = sums_add(s, pair_load(row[a & 0xffffu], row[b & 0xffffu]), a >> 16 | (b & 0xffff0000u));
    }
    return s;
}
static inline void sums_add_directed(lane_sums s[3], uint16_t (*row)[4], const uint32_t *link)
{
    for (int i = 0; i < 8; i += 4) {
        const uint32_t a = link[i], a_yz = link[i + 1], b = link[i + 2], b_yz = link[i + 3];
        const lane_pair p = pair_load(row[a & 0xffffu], row[b & 0xffffu]);
        s[0] = sums_add(s[0], p, a >> 16 | (b & 0xffff0000u));
        s[1] = sums_add(s[1], p, (a_yz & 0xffffu) | b_yz << 16);
        s[2] = sums_add(s[2], p, a_yz >> 16 | (b_yz & 0xffff0000u));
    }
}
#endif

/* The bits of values, and values of bits. */
static inline lanei lanei_bits_of(lane a)
{
    float v[LANES];
    int32_t bits[LANES];
    lane_store(v, a);
    memcpy(bits, v, sizeof bits);
    return lanei_load(bits);
}

static inline lane lane_of_bits(lanei a)
{
    float v[LANES];
    int32_t bits[LANES];
    lanei_store(bits, a);
    memcpy(v, bits, sizeof v);
    return lane_load(v);
}

/* floorf within the int32 range. */
static inline lane lane_floor(lane a)
{
    const lane whole = lane_trunc(a);
    return lane_sub(whole, lane_keep(lane_lt(a, whole), lane_splat(1.0f)));
}

/* a + b c */
static inline lane lane_more(float a, lane b, lane c) { return lane_add(lane_splat(a), lane_mul(b, c)); }

/* lmb_exp2 */
static inline lane lane_exp2(lane a)
{
    const lane x = lane_min(lane_max(a, lane_splat(-126.0f)), lane_splat(127.99f));
    const lane k = lane_floor(lane_add(x, lane_splat(0.5f))), f = lane_sub(x, k);
    lane p = lane_more(0x1.5f0946p-10f, f, lane_splat(0x1.417a5cp-13f));
    p = lane_more(0x1.c6af7ap-5f, f, lane_more(0x1.3b2dd2p-7f, f, p));
    p = lane_more(1.0f, f, lane_more(0x1.62e43p-1f, f, lane_more(0x1.ebfbdcp-3f, f, p)));
    return lane_of_bits(lanei_add(lanei_bits_of(p), lanei_mul(lane_to_int(k), lanei_splat(0x800000))));
}

/* lmb_log2 */
static inline lane lane_log2(lane a)
{
    const lanei u = lanei_bits_of(lane_max(a, lane_splat(0x1p-126f)));
    const lanei e = lanei_shift(lanei_sub(u, lanei_splat(0x3f3504f3)), 23);
    const lane f = lane_sub(lane_of_bits(lanei_sub(u, lanei_mul(e, lanei_splat(0x800000)))), lane_splat(1.0f));
    const lane s = lane_div(f, lane_add(lane_splat(2.0f), f)), z = lane_mul(s, s);
    const lane l = lane_more(0x1.55557ap-1f, z, lane_more(0x1.995ed8p-2f, z, lane_splat(0x1.31e03cp-2f)));
    const lane q = lane_mul(s, lane_sub(f, lane_mul(z, l)));
    const lane rest = lane_sub(lane_mul(lane_splat(0x1.c551dap-2f), lane_sub(f, q)), q);
    return lane_add(lane_from_int(e), lane_add(f, rest));
}

typedef struct lane3 {
    lane x, y, z;
} lane3;

static inline lane3 lane3_load(const float (*p)[LMB_TILE_PIXELS], int k)
{
    lane3 r;
    r.x = lane_load(p[0] + k);
    r.y = lane_load(p[1] + k);
    r.z = lane_load(p[2] + k);
    return r;
}

static inline lane3 lane3_splat(float x, float y, float z)
{
    lane3 r;
    r.x = lane_splat(x);
    r.y = lane_splat(y);
    r.z = lane_splat(z);
    return r;
}

static inline lane3 lane3_of(lmb_vec3 v) { return lane3_splat(v.x, v.y, v.z); }

static inline lane3 lane3_add(lane3 a, lane3 b)
{
    a.x = lane_add(a.x, b.x);
    a.y = lane_add(a.y, b.y);
    a.z = lane_add(a.z, b.z);
    return a;
}

static inline lane3 lane3_sub(lane3 a, lane3 b)
{
    a.x = lane_sub(a.x, b.x);
    a.y = lane_sub(a.y, b.y);
    a.z = lane_sub(a.z, b.z);
    return a;
}

static inline lane3 lane3_scale(lane3 a, lane s)
{
    a.x = lane_mul(a.x, s);
    a.y = lane_mul(a.y, s);
    a.z = lane_mul(a.z, s);
    return a;
}

static inline lane3 lane3_pick(lane_mask m, lane3 a, lane3 b)
{
    a.x = lane_pick(m, a.x, b.x);
    a.y = lane_pick(m, a.y, b.y);
    a.z = lane_pick(m, a.z, b.z);
    return a;
}

static inline lane3 lane3_cross(lane3 a, lane3 b)
{
    lane3 r;
    r.x = lane_sub(lane_mul(a.y, b.z), lane_mul(a.z, b.y));
    r.y = lane_sub(lane_mul(a.z, b.x), lane_mul(a.x, b.z));
    r.z = lane_sub(lane_mul(a.x, b.y), lane_mul(a.y, b.x));
    return r;
}

static inline lane lane3_dot(lane3 a, lane3 b)
{
    return lane_add(lane_add(lane_mul(a.x, b.x), lane_mul(a.y, b.y)), lane_mul(a.z, b.z));
}

static inline lane lane_abs(lane a) { return lane_max(a, lane_sub(lane_splat(0.0f), a)); }

static inline lane3 lane3_abs(lane3 a)
{
    a.x = lane_abs(a.x);
    a.y = lane_abs(a.y);
    a.z = lane_abs(a.z);
    return a;
}

/* The gap between two boxes along each axis, or 0 if they overlap there. `to`: from centre to centre; halves: the sum
 * of both half sizes. */
static inline lane3 lane3_gap(lane3 to, lane3 halves)
{
    const lane zero = lane_splat(0.0f);
    lane3 g = lane3_sub(lane3_abs(to), halves);
    g.x = lane_max(g.x, zero);
    g.y = lane_max(g.y, zero);
    g.z = lane_max(g.z, zero);
    return g;
}

#endif
