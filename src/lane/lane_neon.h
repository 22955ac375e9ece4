/* lane_neon.h: the lane verbs by AArch64's NEON, four wide. lane_scalar.h defines each verb. Layer 2.
 *
 * NEON's min and max return a NaN if either operand is a NaN, so these compare and pick instead. */
#ifndef LMB_LANE_NEON_H
#define LMB_LANE_NEON_H

#include "../base/vec.h"

#include <arm_neon.h>

#define LANES 4

typedef float32x4_t lane;
typedef int32x4_t lanei;
typedef uint32x4_t lane_mask;
typedef struct laned {
    float64x2_t lo, hi;
} laned;

static inline lane lane_splat(float a) { return vdupq_n_f32(a); }
static inline lane lane_load(const float *p) { return vld1q_f32(p); }
static inline void lane_store(float *p, lane a) { vst1q_f32(p, a); }
static inline lane lane_add(lane a, lane b) { return vaddq_f32(a, b); }
static inline lane lane_sub(lane a, lane b) { return vsubq_f32(a, b); }
static inline lane lane_mul(lane a, lane b) { return vmulq_f32(a, b); }
static inline lane lane_div(lane a, lane b) { return vdivq_f32(a, b); }
static inline lane lane_sqrt(lane a) { return vsqrtq_f32(a); }
static inline lane lane_min(lane a, lane b) { return vbslq_f32(vcltq_f32(a, b), a, b); }
static inline lane lane_max(lane a, lane b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
static inline lane_mask lane_lt(lane a, lane b) { return vcltq_f32(a, b); }
static inline lane_mask lane_le(lane a, lane b) { return vcleq_f32(a, b); }
static inline lane lane_pick(lane_mask m, lane a, lane b) { return vbslq_f32(m, a, b); }
static inline lane lane_keep(lane_mask m, lane a)
{
    return vreinterpretq_f32_u32(vandq_u32(m, vreinterpretq_u32_f32(a)));
}
static inline lane_mask mask_and(lane_mask a, lane_mask b) { return vandq_u32(a, b); }
static inline lane_mask mask_or(lane_mask a, lane_mask b) { return vorrq_u32(a, b); }
static inline lane_mask mask_not(lane_mask a) { return vmvnq_u32(a); }
static inline uint32x4_t neon_own_bit(void)
{
    static const uint32_t own[4] = {1, 2, 4, 8};
    return vld1q_u32(own);
}
static inline uint32_t mask_bits(lane_mask a) { return vaddvq_u32(vandq_u32(a, neon_own_bit())); }
static inline lane_mask mask_of_bits(uint32_t b) { return vtstq_u32(vdupq_n_u32(b), neon_own_bit()); }

static inline lanei lanei_splat(int32_t a) { return vdupq_n_s32(a); }
static inline lanei lanei_load(const int32_t *p) { return vld1q_s32(p); }
static inline void lanei_store(int32_t *p, lanei a) { vst1q_s32(p, a); }
static inline lanei lanei_add(lanei a, lanei b) { return vaddq_s32(a, b); }
static inline lanei lanei_or(lanei a, lanei b) { return vorrq_s32(a, b); }
static inline lanei lanei_and(lanei a, lanei b) { return vandq_s32(a, b); }
static inline lanei lanei_mul(lanei a, lanei b) { return vmulq_s32(a, b); }
static inline lanei lanei_sub(lanei a, lanei b) { return vsubq_s32(a, b); }
static inline lanei lanei_min(lanei a, lanei b) { return vminq_s32(a, b); }
static inline lanei lanei_max(lanei a, lanei b) { return vmaxq_s32(a, b); }
static inline lanei lanei_pick(lane_mask m, lanei a, lanei b) { return vbslq_s32(m, a, b); }
static inline lane_mask lanei_lt(lanei a, lanei b) { return vcltq_s32(a, b); }
static inline lanei lanei_shift(lanei a, int n) { return vshlq_s32(a, vdupq_n_s32(-n)); }
static inline lane_mask lanei_not_negative(lanei a) { return vcgezq_s32(a); }
static inline lane_mask lanei_equal(lanei a, lanei b) { return vceqq_s32(a, b); }
static inline lanei lane_to_int(lane a) { return vcvtq_s32_f32(a); }
static inline lane lane_from_int(lanei a) { return vcvtq_f32_s32(a); }
static inline lane lane_trunc(lane a) { return vcvtq_f32_s32(vcvtq_s32_f32(a)); }

#define NEON_BOTH(f) a.lo = f(a.lo, b.lo), a.hi = f(a.hi, b.hi)
static inline laned laned_add(laned a, laned b) { NEON_BOTH(vaddq_f64); return a; }
static inline laned laned_sub(laned a, laned b) { NEON_BOTH(vsubq_f64); return a; }
static inline laned laned_mul(laned a, laned b) { NEON_BOTH(vmulq_f64); return a; }
static inline laned laned_div(laned a, laned b) { NEON_BOTH(vdivq_f64); return a; }
#undef NEON_BOTH
static inline laned laned_splat(double a) { laned r; r.lo = r.hi = vdupq_n_f64(a); return r; }
static inline laned laned_from(lane a)
{
    laned r;
    r.lo = vcvt_f64_f32(vget_low_f32(a));
    r.hi = vcvt_high_f64_f32(a);
    return r;
}
static inline laned laned_from_int(lanei a)
{
    laned r;
    r.lo = vcvtq_f64_s64(vmovl_s32(vget_low_s32(a)));
    r.hi = vcvtq_f64_s64(vmovl_high_s32(a));
    return r;
}
static inline lane lane_from_double(laned a) { return vcvt_high_f32_f64(vcvt_f32_f64(a.lo), a.hi); }
static inline laned laned_load(const double *p)
{
    laned r;
    r.lo = vld1q_f64(p);
    r.hi = vld1q_f64(p + 2);
    return r;
}
static inline void laned_store(double *p, laned a)
{
    vst1q_f64(p, a.lo);
    vst1q_f64(p + 2, a.hi);
}

static inline lane lane_gather_f32(const float *p, lanei at)
{
    lane r = vdupq_n_f32(p[vgetq_lane_s32(at, 0)]);
    r = vsetq_lane_f32(p[vgetq_lane_s32(at, 1)], r, 1);
    r = vsetq_lane_f32(p[vgetq_lane_s32(at, 2)], r, 2);
    return vsetq_lane_f32(p[vgetq_lane_s32(at, 3)], r, 3);
}
static inline lane lane_gather_u16(const uint16_t *p, lanei at)
{
    uint32x4_t r = vdupq_n_u32(p[vgetq_lane_s32(at, 0)]);
    r = vsetq_lane_u32(p[vgetq_lane_s32(at, 1)], r, 1);
    r = vsetq_lane_u32(p[vgetq_lane_s32(at, 2)], r, 2);
    return vcvtq_f32_u32(vsetq_lane_u32(p[vgetq_lane_s32(at, 3)], r, 3));
}
static inline lane lane_table(const float *p, lanei at) { return lane_gather_f32(p, at); }

static inline lane lane_load_rows(const float *p, int32_t step) { (void)step; return lane_load(p); }
static inline void lane_store_rows(float *p, int32_t step, lane a) { (void)step; lane_store(p, a); }
static inline lane lane_load_u16(const uint16_t *p, int32_t step)
{
    (void)step;
    return vcvtq_f32_u32(vmovl_u16(vld1_u16(p)));
}
static inline void lane_store_u16(uint16_t *p, int32_t step, lane a)
{
    (void)step;
    vst1_u16(p, vmovn_u32(vcvtq_u32_f32(a)));
}
static inline void lane_raise_u16(uint16_t *p, lane a, lane b)
{
    const uint16x8_t code = vcombine_u16(vqmovn_u32(vcvtq_u32_f32(a)), vqmovn_u32(vcvtq_u32_f32(b)));
    vst1q_u16(p, vmaxq_u16(vld1q_u16(p), code));
}
static inline void lane_put_u16(uint16_t *p, int32_t step, uint32_t id, lane_mask m)
{
    (void)step;
    vst1_u16(p, vbsl_u16(vmovn_u32(m), vdup_n_u16((uint16_t)id), vld1_u16(p)));
}
static inline void lane_put_u32(uint32_t *p, int32_t step, uint32_t id, lane_mask m)
{
    (void)step;
    vst1q_u32(p, vbslq_u32(m, vdupq_n_u32(id), vld1q_u32(p)));
}

/* Products are signed, so rows are stored 32768 lower. The fourth value, which is 0, is shifted too and so sums to the
 * correction for the others. */
typedef struct lane_pair {
    int16x4_t first, second;
} lane_pair;
typedef int32x4_t lane_sums;
static inline lane_pair pair_load(const uint16_t *first, const uint16_t *second)
{
    const uint16x4_t low = vdup_n_u16(0x8000);
    lane_pair r;
    r.first = vreinterpret_s16_u16(veor_u16(vld1_u16(first), low));
    r.second = vreinterpret_s16_u16(veor_u16(vld1_u16(second), low));
    return r;
}
static inline lane_sums sums_zero(void) { return vdupq_n_s32(0); }
static inline lane_sums sums_add(lane_sums s, lane_pair p, uint32_t weights)
{
    const int16x4_t w = vreinterpret_s16_u32(vdup_n_u32(weights));
    return vmlal_lane_s16(vmlal_lane_s16(s, p.first, w, 0), p.second, w, 1);
}
static inline void sums_store(int32_t out[3], lane_sums s)
{
    int32_t v[4];
    vst1q_s32(v, vsubq_s32(s, vdupq_laneq_s32(s, 3)));
    out[0] = v[0];
    out[1] = v[1];
    out[2] = v[2];
}

#endif
