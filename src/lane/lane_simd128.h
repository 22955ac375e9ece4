/* lane_simd128.h: the lane verbs by WebAssembly's simd128, four wide. lane_scalar.h defines each verb. Layer 2.
 *
 * pmin(x, y) is y < x ? y : x, so SSE's rule is pmin with swapped operands. min and max return a NaN if either operand
 * is a NaN. */
#ifndef LMB_LANE_SIMD128_H
#define LMB_LANE_SIMD128_H

#include "../base/vec.h"

#include <wasm_simd128.h>

#define LANES 4

typedef v128_t lane;
typedef v128_t lanei;
typedef v128_t lane_mask;
typedef struct laned {
    v128_t lo, hi;
} laned;

static inline lane lane_splat(float a) { return wasm_f32x4_splat(a); }
static inline lane lane_load(const float *p) { return wasm_v128_load(p); }
static inline void lane_store(float *p, lane a) { wasm_v128_store(p, a); }
static inline lane lane_add(lane a, lane b) { return wasm_f32x4_add(a, b); }
static inline lane lane_sub(lane a, lane b) { return wasm_f32x4_sub(a, b); }
static inline lane lane_mul(lane a, lane b) { return wasm_f32x4_mul(a, b); }
static inline lane lane_div(lane a, lane b) { return wasm_f32x4_div(a, b); }
static inline lane lane_sqrt(lane a) { return wasm_f32x4_sqrt(a); }
static inline lane lane_min(lane a, lane b) { return wasm_f32x4_pmin(b, a); }
static inline lane lane_max(lane a, lane b) { return wasm_f32x4_pmax(b, a); }
static inline lane_mask lane_lt(lane a, lane b) { return wasm_f32x4_lt(a, b); }
static inline lane_mask lane_le(lane a, lane b) { return wasm_f32x4_le(a, b); }
static inline lane lane_pick(lane_mask m, lane a, lane b) { return wasm_v128_bitselect(a, b, m); }
static inline lane lane_keep(lane_mask m, lane a) { return wasm_v128_and(m, a); }
static inline lane_mask mask_and(lane_mask a, lane_mask b) { return wasm_v128_and(a, b); }
static inline lane_mask mask_or(lane_mask a, lane_mask b) { return wasm_v128_or(a, b); }
static inline lane_mask mask_not(lane_mask a) { return wasm_v128_not(a); }
static inline uint32_t mask_bits(lane_mask a) { return (uint32_t)wasm_i32x4_bitmask(a); }
static inline lane_mask mask_of_bits(uint32_t b)
{
    const v128_t own = wasm_i32x4_const(1, 2, 4, 8);
    return wasm_i32x4_eq(wasm_v128_and(wasm_i32x4_splat((int32_t)b), own), own);
}

static inline lanei lanei_splat(int32_t a) { return wasm_i32x4_splat(a); }
static inline lanei lanei_load(const int32_t *p) { return wasm_v128_load(p); }
static inline void lanei_store(int32_t *p, lanei a) { wasm_v128_store(p, a); }
static inline lanei lanei_add(lanei a, lanei b) { return wasm_i32x4_add(a, b); }
static inline lanei lanei_or(lanei a, lanei b) { return wasm_v128_or(a, b); }
static inline lanei lanei_and(lanei a, lanei b) { return wasm_v128_and(a, b); }
static inline lanei lanei_mul(lanei a, lanei b) { return wasm_i32x4_mul(a, b); }
static inline lanei lanei_sub(lanei a, lanei b) { return wasm_i32x4_sub(a, b); }
static inline lanei lanei_min(lanei a, lanei b) { return wasm_i32x4_min(a, b); }
static inline lanei lanei_max(lanei a, lanei b) { return wasm_i32x4_max(a, b); }
static inline lanei lanei_pick(lane_mask m, lanei a, lanei b) { return wasm_v128_bitselect(a, b, m); }
static inline lane_mask lanei_lt(lanei a, lanei b) { return wasm_i32x4_lt(a, b); }
static inline lanei lanei_shift(lanei a, int n) { return wasm_i32x4_shr(a, (uint32_t)n); }
static inline lane_mask lanei_not_negative(lanei a) { return wasm_i32x4_ge(a, wasm_i32x4_const(0, 0, 0, 0)); }
static inline lane_mask lanei_equal(lanei a, lanei b) { return wasm_i32x4_eq(a, b); }
static inline lanei lane_to_int(lane a) { return wasm_i32x4_trunc_sat_f32x4(a); }
static inline lane lane_from_int(lanei a) { return wasm_f32x4_convert_i32x4(a); }
static inline lane lane_trunc(lane a) { return wasm_f32x4_convert_i32x4(wasm_i32x4_trunc_sat_f32x4(a)); }

#define SIMD128_BOTH(f) a.lo = f(a.lo, b.lo), a.hi = f(a.hi, b.hi)
static inline laned laned_add(laned a, laned b) { SIMD128_BOTH(wasm_f64x2_add); return a; }
static inline laned laned_sub(laned a, laned b) { SIMD128_BOTH(wasm_f64x2_sub); return a; }
static inline laned laned_mul(laned a, laned b) { SIMD128_BOTH(wasm_f64x2_mul); return a; }
static inline laned laned_div(laned a, laned b) { SIMD128_BOTH(wasm_f64x2_div); return a; }
#undef SIMD128_BOTH
static inline laned laned_splat(double a) { laned r; r.lo = r.hi = wasm_f64x2_splat(a); return r; }
static inline laned laned_from(lane a)
{
    laned r;
    r.lo = wasm_f64x2_promote_low_f32x4(a);
    r.hi = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(a, a, 2, 3, 2, 3));
    return r;
}
static inline laned laned_from_int(lanei a)
{
    laned r;
    r.lo = wasm_f64x2_convert_low_i32x4(a);
    r.hi = wasm_f64x2_convert_low_i32x4(wasm_i32x4_shuffle(a, a, 2, 3, 2, 3));
    return r;
}
static inline lane lane_from_double(laned a)
{
    return wasm_i32x4_shuffle(wasm_f32x4_demote_f64x2_zero(a.lo), wasm_f32x4_demote_f64x2_zero(a.hi), 0, 1, 4, 5);
}
static inline laned laned_load(const double *p)
{
    laned r;
    r.lo = wasm_v128_load(p);
    r.hi = wasm_v128_load(p + 2);
    return r;
}
static inline void laned_store(double *p, laned a)
{
    wasm_v128_store(p, a.lo);
    wasm_v128_store(p + 2, a.hi);
}

static inline lane lane_gather_f32(const float *p, lanei at)
{
    return wasm_f32x4_make(p[wasm_i32x4_extract_lane(at, 0)], p[wasm_i32x4_extract_lane(at, 1)],
                           p[wasm_i32x4_extract_lane(at, 2)], p[wasm_i32x4_extract_lane(at, 3)]);
}
static inline lane lane_gather_u16(const uint16_t *p, lanei at)
{
    return wasm_f32x4_convert_i32x4(
        wasm_i32x4_make(p[wasm_i32x4_extract_lane(at, 0)], p[wasm_i32x4_extract_lane(at, 1)],
                        p[wasm_i32x4_extract_lane(at, 2)], p[wasm_i32x4_extract_lane(at, 3)]));
}
static inline lane lane_table(const float *p, lanei at) { return lane_gather_f32(p, at); }

static inline lane lane_load_rows(const float *p, int32_t step) { (void)step; return lane_load(p); }
static inline void lane_store_rows(float *p, int32_t step, lane a) { (void)step; lane_store(p, a); }
static inline lane lane_load_u16(const uint16_t *p, int32_t step)
{
    (void)step;
    return wasm_f32x4_convert_i32x4(wasm_u32x4_load16x4(p));
}
static inline void lane_store_u16(uint16_t *p, int32_t step, lane a)
{
    v128_t code = wasm_i32x4_trunc_sat_f32x4(a);
    (void)step;
    wasm_v128_store64_lane(p, wasm_u16x8_narrow_i32x4(code, code), 0);
}
static inline void lane_raise_u16(uint16_t *p, lane a, lane b)
{
    v128_t code = wasm_u16x8_narrow_i32x4(wasm_i32x4_trunc_sat_f32x4(a), wasm_i32x4_trunc_sat_f32x4(b));
    wasm_v128_store(p, wasm_u16x8_max(wasm_v128_load(p), code));
}
static inline void lane_put_u16(uint16_t *p, int32_t step, uint32_t id, lane_mask m)
{
    v128_t narrow = wasm_i16x8_narrow_i32x4(m, m);
    (void)step;
    wasm_v128_store64_lane(p, wasm_v128_bitselect(wasm_i16x8_splat((int16_t)id), wasm_v128_load64_zero(p), narrow), 0);
}
static inline void lane_put_u32(uint32_t *p, int32_t step, uint32_t id, lane_mask m)
{
    (void)step;
    wasm_v128_store(p, wasm_v128_bitselect(wasm_i32x4_splat((int32_t)id), wasm_v128_load(p), m));
}

/* Products are signed, so rows are stored 32768 lower. The fourth value, which is 0, is shifted too and so sums to the
 * correction for the others. */
typedef v128_t lane_pair;
typedef v128_t lane_sums;
static inline lane_pair pair_load(const uint16_t *first, const uint16_t *second)
{
    const v128_t a = wasm_v128_load64_zero(first), b = wasm_v128_load64_zero(second);
    return wasm_v128_xor(wasm_i16x8_shuffle(a, b, 0, 8, 1, 9, 2, 10, 3, 11), wasm_i16x8_splat((int16_t)-32768));
}
static inline lane_sums sums_zero(void) { return wasm_i32x4_splat(0); }
static inline lane_sums sums_add(lane_sums s, lane_pair p, uint32_t weights)
{
    return wasm_i32x4_add(s, wasm_i32x4_dot_i16x8(p, wasm_i32x4_splat((int32_t)weights)));
}
static inline void sums_store(int32_t out[3], lane_sums s)
{
    int32_t v[4];
    wasm_v128_store(v, wasm_i32x4_sub(s, wasm_i32x4_shuffle(s, s, 3, 3, 3, 3)));
    out[0] = v[0];
    out[1] = v[1];
    out[2] = v[2];
}

#endif
