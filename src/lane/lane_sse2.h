/* lane_sse2.h: the lane verbs by SSE2, four wide. lane_scalar.h defines each verb. Layer 2. */
#ifndef LMB_LANE_SSE2_H
#define LMB_LANE_SSE2_H

#include "../base/vec.h"
#include "sums_sse2.h"

#include <emmintrin.h>

#define LANES 4

typedef __m128 lane;
typedef __m128i lanei;
typedef __m128 lane_mask;
typedef struct laned {
    __m128d lo, hi;
} laned;

static inline lane lane_splat(float a) { return _mm_set1_ps(a); }
static inline lane lane_load(const float *p) { return _mm_loadu_ps(p); }
static inline void lane_store(float *p, lane a) { _mm_storeu_ps(p, a); }
static inline lane lane_add(lane a, lane b) { return _mm_add_ps(a, b); }
static inline lane lane_sub(lane a, lane b) { return _mm_sub_ps(a, b); }
static inline lane lane_mul(lane a, lane b) { return _mm_mul_ps(a, b); }
static inline lane lane_div(lane a, lane b) { return _mm_div_ps(a, b); }
static inline lane lane_sqrt(lane a) { return _mm_sqrt_ps(a); }
static inline lane lane_min(lane a, lane b) { return _mm_min_ps(a, b); }
static inline lane lane_max(lane a, lane b) { return _mm_max_ps(a, b); }
static inline lane_mask lane_lt(lane a, lane b) { return _mm_cmplt_ps(a, b); }
static inline lane_mask lane_le(lane a, lane b) { return _mm_cmple_ps(a, b); }
static inline lane lane_pick(lane_mask m, lane a, lane b) { return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)); }
static inline lane lane_keep(lane_mask m, lane a) { return _mm_and_ps(m, a); }
static inline lane_mask mask_and(lane_mask a, lane_mask b) { return _mm_and_ps(a, b); }
static inline lane_mask mask_or(lane_mask a, lane_mask b) { return _mm_or_ps(a, b); }
static inline lane_mask mask_not(lane_mask a) { return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1))); }
static inline uint32_t mask_bits(lane_mask a) { return (uint32_t)_mm_movemask_ps(a); }
static inline lane_mask mask_of_bits(uint32_t b)
{
    const __m128i own = _mm_setr_epi32(1, 2, 4, 8);
    return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32((int32_t)b), own), own));
}

static inline lanei lanei_splat(int32_t a) { return _mm_set1_epi32(a); }
static inline lanei lanei_load(const int32_t *p) { return _mm_loadu_si128((const __m128i *)(const void *)p); }
static inline void lanei_store(int32_t *p, lanei a) { _mm_storeu_si128((__m128i *)(void *)p, a); }
static inline lanei lanei_add(lanei a, lanei b) { return _mm_add_epi32(a, b); }
static inline lanei lanei_or(lanei a, lanei b) { return _mm_or_si128(a, b); }
static inline lanei lanei_and(lanei a, lanei b) { return _mm_and_si128(a, b); }
/* Interleaves the low halves of the products of even and of odd lanes. */
static inline lanei lanei_mul(lanei a, lanei b)
{
    __m128i even = _mm_mul_epu32(a, b), odd = _mm_mul_epu32(_mm_srli_epi64(a, 32), _mm_srli_epi64(b, 32));
    return _mm_unpacklo_epi32(_mm_shuffle_epi32(even, _MM_SHUFFLE(0, 0, 2, 0)),
                              _mm_shuffle_epi32(odd, _MM_SHUFFLE(0, 0, 2, 0)));
}
static inline lanei lanei_sub(lanei a, lanei b) { return _mm_sub_epi32(a, b); }
static inline lane_mask lanei_lt(lanei a, lanei b) { return _mm_castsi128_ps(_mm_cmplt_epi32(a, b)); }
static inline lanei lanei_pick(lane_mask m, lanei a, lanei b)
{
    __m128i bits = _mm_castps_si128(m);
    return _mm_or_si128(_mm_and_si128(bits, a), _mm_andnot_si128(bits, b));
}
static inline lanei lanei_min(lanei a, lanei b) { return lanei_pick(lanei_lt(a, b), a, b); }
static inline lanei lanei_max(lanei a, lanei b) { return lanei_pick(lanei_lt(b, a), a, b); }
static inline lanei lanei_shift(lanei a, int n) { return _mm_srai_epi32(a, n); }
static inline lane_mask lanei_not_negative(lanei a) { return _mm_castsi128_ps(_mm_cmpgt_epi32(a, _mm_set1_epi32(-1))); }
static inline lane_mask lanei_equal(lanei a, lanei b) { return _mm_castsi128_ps(_mm_cmpeq_epi32(a, b)); }
static inline lanei lane_to_int(lane a) { return _mm_cvttps_epi32(a); }
static inline lane lane_from_int(lanei a) { return _mm_cvtepi32_ps(a); }
static inline lane lane_trunc(lane a) { return _mm_cvtepi32_ps(_mm_cvttps_epi32(a)); }

#define SSE2_BOTH(f) a.lo = f(a.lo, b.lo), a.hi = f(a.hi, b.hi)
static inline laned laned_add(laned a, laned b) { SSE2_BOTH(_mm_add_pd); return a; }
static inline laned laned_sub(laned a, laned b) { SSE2_BOTH(_mm_sub_pd); return a; }
static inline laned laned_mul(laned a, laned b) { SSE2_BOTH(_mm_mul_pd); return a; }
static inline laned laned_div(laned a, laned b) { SSE2_BOTH(_mm_div_pd); return a; }
#undef SSE2_BOTH
static inline laned laned_splat(double a) { laned r; r.lo = r.hi = _mm_set1_pd(a); return r; }
static inline laned laned_from(lane a)
{
    laned r;
    r.lo = _mm_cvtps_pd(a);
    r.hi = _mm_cvtps_pd(_mm_movehl_ps(a, a));
    return r;
}
static inline laned laned_from_int(lanei a)
{
    laned r;
    r.lo = _mm_cvtepi32_pd(a);
    r.hi = _mm_cvtepi32_pd(_mm_shuffle_epi32(a, _MM_SHUFFLE(3, 2, 3, 2)));
    return r;
}
static inline lane lane_from_double(laned a) { return _mm_movelh_ps(_mm_cvtpd_ps(a.lo), _mm_cvtpd_ps(a.hi)); }
static inline laned laned_load(const double *p)
{
    laned r;
    r.lo = _mm_loadu_pd(p);
    r.hi = _mm_loadu_pd(p + 2);
    return r;
}
static inline void laned_store(double *p, laned a)
{
    _mm_storeu_pd(p, a.lo);
    _mm_storeu_pd(p + 2, a.hi);
}

static inline lane lane_gather_f32(const float *p, lanei at)
{
    int32_t i[4];
    lanei_store(i, at);
    return _mm_setr_ps(p[i[0]], p[i[1]], p[i[2]], p[i[3]]);
}
static inline lane lane_gather_u16(const uint16_t *p, lanei at)
{
    int32_t i[4];
    lanei_store(i, at);
    return _mm_cvtepi32_ps(_mm_setr_epi32(p[i[0]], p[i[1]], p[i[2]], p[i[3]]));
}
static inline lane lane_table(const float *p, lanei at) { return lane_gather_f32(p, at); }

/* Sixteen-bit products of codes, of the first and the last two pixels. (t + 128) 257 / 2^16 is t / 255 to nearest, for
 * t = 0 .. 255 x 255. */
#define LANE_HAS_CODES 1
static inline lanei sse2_255ths(lanei low, lanei high)
{
    const lanei half = _mm_set1_epi16(128), by = _mm_set1_epi16(257);
    return _mm_packus_epi16(_mm_mulhi_epu16(_mm_add_epi16(low, half), by),
                            _mm_mulhi_epu16(_mm_add_epi16(high, half), by));
}
static inline lanei codes_times(lanei x, lanei y)
{
    const lanei zero = _mm_setzero_si128();
    return sse2_255ths(_mm_mullo_epi16(_mm_unpacklo_epi8(x, zero), _mm_unpacklo_epi8(y, zero)),
                       _mm_mullo_epi16(_mm_unpackhi_epi8(x, zero), _mm_unpackhi_epi8(y, zero)));
}
/* The share of two pixels in all their places. */
static inline lanei sse2_shares(lanei two) { return _mm_shufflehi_epi16(_mm_shufflelo_epi16(two, 0xff), 0xff); }
static inline lanei codes_plus(lanei x, lanei y)
{
    const lanei zero = _mm_setzero_si128(), low = _mm_unpacklo_epi8(x, zero), high = _mm_unpackhi_epi8(x, zero);
    return _mm_adds_epu8(sse2_255ths(_mm_mullo_epi16(low, sse2_shares(low)), _mm_mullo_epi16(high, sse2_shares(high))),
                         y);
}
static inline lanei sse2_between(lanei x, lanei y)
{
    const lanei share = sse2_shares(x);
    return _mm_add_epi16(_mm_mullo_epi16(x, share), _mm_mullo_epi16(y, _mm_sub_epi16(_mm_set1_epi16(255), share)));
}
static inline lanei codes_over(lanei x, lanei y)
{
    const lanei zero = _mm_setzero_si128();
    return sse2_255ths(sse2_between(_mm_unpacklo_epi8(x, zero), _mm_unpacklo_epi8(y, zero)),
                       sse2_between(_mm_unpackhi_epi8(x, zero), _mm_unpackhi_epi8(y, zero)));
}
static inline lanei codes_same(lanei x, lanei y) { return codes_over(x, y); }

/* Corners along x by 16 bits: at most 255 x 256. Along y by 32 bits, from 2^15 less, because products are signed. */
static inline lanei sse2_between_x(lanei a, lanei b, lanei x)
{
    return _mm_add_epi16(_mm_slli_epi16(a, 8), _mm_mullo_epi16(_mm_sub_epi16(b, a), x));
}
static inline lanei sse2_between_y(lanei pair, lanei y)
{
    return _mm_srli_epi32(_mm_add_epi32(_mm_madd_epi16(pair, y), _mm_set1_epi32((1 << 23) + (1 << 15))), 16);
}
static inline lanei codes_between(const lanei corner[4], lanei x, lanei y)
{
    const lanei zero = _mm_setzero_si128(), sign = _mm_set1_epi16(-32768), byte = _mm_set1_epi32(255);
    x = _mm_and_si128(x, byte);
    y = _mm_and_si128(y, byte);
    const lanei shares = _mm_or_si128(_mm_sub_epi32(_mm_set1_epi32(256), y), _mm_slli_epi32(y, 16));
    const lanei xx = _mm_or_si128(x, _mm_slli_epi32(x, 16)), x_low = _mm_unpacklo_epi32(xx, xx),
                x_high = _mm_unpackhi_epi32(xx, xx);
    lanei half[2];
    for (int i = 0; i < 2; ++i) {
        const lanei upper = sse2_between_x(i ? _mm_unpackhi_epi8(corner[0], zero) : _mm_unpacklo_epi8(corner[0], zero),
                                           i ? _mm_unpackhi_epi8(corner[1], zero) : _mm_unpacklo_epi8(corner[1], zero),
                                           i ? x_high : x_low);
        const lanei lower = sse2_between_x(i ? _mm_unpackhi_epi8(corner[2], zero) : _mm_unpacklo_epi8(corner[2], zero),
                                           i ? _mm_unpackhi_epi8(corner[3], zero) : _mm_unpacklo_epi8(corner[3], zero),
                                           i ? x_high : x_low);
        const lanei p = _mm_xor_si128(upper, sign), q = _mm_xor_si128(lower, sign);
        half[i] = _mm_packs_epi32(sse2_between_y(_mm_unpacklo_epi16(p, q),
                                                 i ? _mm_shuffle_epi32(shares, 0xaa) : _mm_shuffle_epi32(shares, 0x00)),
                                  sse2_between_y(_mm_unpackhi_epi16(p, q), i ? _mm_shuffle_epi32(shares, 0xff)
                                                                             : _mm_shuffle_epi32(shares, 0x55)));
    }
    return _mm_packus_epi16(half[0], half[1]);
}

static inline lane lane_load_rows(const float *p, int32_t step) { (void)step; return lane_load(p); }
static inline void lane_store_rows(float *p, int32_t step, lane a) { (void)step; lane_store(p, a); }
static inline lane lane_load_u16(const uint16_t *p, int32_t step)
{
    __m128i code = _mm_loadl_epi64((const __m128i *)(const void *)p);
    (void)step;
    return _mm_cvtepi32_ps(_mm_unpacklo_epi16(code, _mm_setzero_si128()));
}
/* SSE2 packs with signed saturation only: shift down by 32768 and back. */
static inline void lane_store_u16(uint16_t *p, int32_t step, lane a)
{
    __m128i code = _mm_sub_epi32(_mm_cvttps_epi32(a), _mm_set1_epi32(32768));
    (void)step;
    _mm_storel_epi64((__m128i *)(void *)p, _mm_xor_si128(_mm_packs_epi32(code, code), _mm_set1_epi16(-32768)));
}
/* Maximum: subtract with saturation, then add again. */
static inline void lane_raise_u16(uint16_t *p, lane a, lane b)
{
    const __m128 zero = _mm_setzero_ps();
    const __m128i middle = _mm_set1_epi32(32768);
    const __m128i low = _mm_sub_epi32(_mm_cvttps_epi32(_mm_max_ps(a, zero)), middle),
                  high = _mm_sub_epi32(_mm_cvttps_epi32(_mm_max_ps(b, zero)), middle);
    const __m128i code = _mm_xor_si128(_mm_packs_epi32(low, high), _mm_set1_epi16(-32768));
    __m128i *at = (__m128i *)(void *)p;
    const __m128i old = _mm_loadu_si128(at);
    _mm_storeu_si128(at, _mm_add_epi16(_mm_subs_epu16(code, old), old));
}
static inline __m128i sse2_blend(__m128i m, __m128i a, __m128i b)
{
    return _mm_or_si128(_mm_and_si128(m, a), _mm_andnot_si128(m, b));
}
static inline void lane_put_u16(uint16_t *p, int32_t step, uint32_t id, lane_mask m)
{
    __m128i narrow = _mm_packs_epi32(_mm_castps_si128(m), _mm_castps_si128(m));
    __m128i old = _mm_loadl_epi64((const __m128i *)(const void *)p);
    (void)step;
    _mm_storel_epi64((__m128i *)(void *)p, sse2_blend(narrow, _mm_set1_epi16((short)id), old));
}
static inline void lane_put_u32(uint32_t *p, int32_t step, uint32_t id, lane_mask m)
{
    __m128i *at = (__m128i *)(void *)p;
    (void)step;
    _mm_storeu_si128(at, sse2_blend(_mm_castps_si128(m), _mm_set1_epi32((int32_t)id), _mm_loadu_si128(at)));
}

#endif
