/* lane_avx2.h: the lane verbs by AVX2, eight wide: a row of a tile. lane_scalar.h defines each verb. Layer 2.
 *
 * Include after target_avx2.h. Gathers are single loads: AVX2's gather has no 16-bit form, and the 32-bit form measured
 * no faster. */
#ifndef LMB_LANE_AVX2_H
#define LMB_LANE_AVX2_H

#include "../base/vec.h"
#include "sums_avx2.h"

#define LANES 8

typedef __m256 lane;
typedef __m256i lanei;
typedef __m256 lane_mask;
typedef struct laned {
    __m256d lo, hi;
} laned;

static inline lane lane_splat(float a) { return _mm256_set1_ps(a); }
static inline lane lane_load(const float *p) { return _mm256_loadu_ps(p); }
static inline void lane_store(float *p, lane a) { _mm256_storeu_ps(p, a); }
static inline lane lane_add(lane a, lane b) { return _mm256_add_ps(a, b); }
static inline lane lane_sub(lane a, lane b) { return _mm256_sub_ps(a, b); }
static inline lane lane_mul(lane a, lane b) { return _mm256_mul_ps(a, b); }
static inline lane lane_div(lane a, lane b) { return _mm256_div_ps(a, b); }
static inline lane lane_sqrt(lane a) { return _mm256_sqrt_ps(a); }
#define LANE_GUESSES_ROOTS 1
static inline lane lane_root_guess(lane a) { return _mm256_mul_ps(a, _mm256_rsqrt_ps(a)); }
static inline lane lane_min(lane a, lane b) { return _mm256_min_ps(a, b); }
static inline lane lane_max(lane a, lane b) { return _mm256_max_ps(a, b); }
static inline lane_mask lane_lt(lane a, lane b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
static inline lane_mask lane_le(lane a, lane b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
static inline lane lane_pick(lane_mask m, lane a, lane b) { return _mm256_blendv_ps(b, a, m); }
static inline lane lane_keep(lane_mask m, lane a) { return _mm256_and_ps(m, a); }
static inline lane_mask mask_and(lane_mask a, lane_mask b) { return _mm256_and_ps(a, b); }
static inline lane_mask mask_or(lane_mask a, lane_mask b) { return _mm256_or_ps(a, b); }
static inline lane_mask mask_not(lane_mask a) { return _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1))); }
static inline uint32_t mask_bits(lane_mask a) { return (uint32_t)_mm256_movemask_ps(a); }
static inline lane_mask mask_of_bits(uint32_t b)
{
    const __m256i own = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((int32_t)b), own), own));
}

static inline lanei lanei_splat(int32_t a) { return _mm256_set1_epi32(a); }
static inline lanei lanei_load(const int32_t *p) { return _mm256_loadu_si256((const __m256i *)(const void *)p); }
static inline void lanei_store(int32_t *p, lanei a) { _mm256_storeu_si256((__m256i *)(void *)p, a); }
static inline lanei lanei_add(lanei a, lanei b) { return _mm256_add_epi32(a, b); }
static inline lanei lanei_or(lanei a, lanei b) { return _mm256_or_si256(a, b); }
static inline lanei lanei_and(lanei a, lanei b) { return _mm256_and_si256(a, b); }
static inline lanei lanei_mul(lanei a, lanei b) { return _mm256_mullo_epi32(a, b); }
#define LANE_ADDS_HALVES 1
static inline lanei lanei_add_halves(lanei a, lanei b) { return _mm256_madd_epi16(a, b); }
static inline lanei lanei_sub(lanei a, lanei b) { return _mm256_sub_epi32(a, b); }
static inline lanei lanei_min(lanei a, lanei b) { return _mm256_min_epi32(a, b); }
static inline lanei lanei_max(lanei a, lanei b) { return _mm256_max_epi32(a, b); }
static inline lanei lanei_pick(lane_mask m, lanei a, lanei b)
{
    return _mm256_blendv_epi8(b, a, _mm256_castps_si256(m));
}
static inline lane_mask lanei_lt(lanei a, lanei b) { return _mm256_castsi256_ps(_mm256_cmpgt_epi32(b, a)); }
static inline lanei lanei_shift(lanei a, int n) { return _mm256_srai_epi32(a, n); }
static inline lane_mask lanei_not_negative(lanei a)
{
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(a, _mm256_set1_epi32(-1)));
}
static inline lane_mask lanei_equal(lanei a, lanei b) { return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b)); }
static inline lanei lane_to_int(lane a) { return _mm256_cvttps_epi32(a); }
static inline lane lane_from_int(lanei a) { return _mm256_cvtepi32_ps(a); }
static inline lane lane_trunc(lane a) { return _mm256_cvtepi32_ps(_mm256_cvttps_epi32(a)); }

#define AVX2_BOTH(f) a.lo = f(a.lo, b.lo), a.hi = f(a.hi, b.hi)
static inline laned laned_add(laned a, laned b) { AVX2_BOTH(_mm256_add_pd); return a; }
static inline laned laned_sub(laned a, laned b) { AVX2_BOTH(_mm256_sub_pd); return a; }
static inline laned laned_mul(laned a, laned b) { AVX2_BOTH(_mm256_mul_pd); return a; }
static inline laned laned_div(laned a, laned b) { AVX2_BOTH(_mm256_div_pd); return a; }
#undef AVX2_BOTH
static inline laned laned_splat(double a) { laned r; r.lo = r.hi = _mm256_set1_pd(a); return r; }
static inline laned laned_from(lane a)
{
    laned r;
    r.lo = _mm256_cvtps_pd(_mm256_castps256_ps128(a));
    r.hi = _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1));
    return r;
}
static inline laned laned_from_int(lanei a)
{
    laned r;
    r.lo = _mm256_cvtepi32_pd(_mm256_castsi256_si128(a));
    r.hi = _mm256_cvtepi32_pd(_mm256_extracti128_si256(a, 1));
    return r;
}
static inline lane lane_from_double(laned a)
{
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(a.lo)), _mm256_cvtpd_ps(a.hi), 1);
}
static inline laned laned_load(const double *p)
{
    laned r;
    r.lo = _mm256_loadu_pd(p);
    r.hi = _mm256_loadu_pd(p + 4);
    return r;
}
static inline void laned_store(double *p, laned a)
{
    _mm256_storeu_pd(p, a.lo);
    _mm256_storeu_pd(p + 4, a.hi);
}

static inline lane lane_gather_f32(const float *p, lanei at)
{
    int32_t i[8];
    lanei_store(i, at);
    return _mm256_setr_ps(p[i[0]], p[i[1]], p[i[2]], p[i[3]], p[i[4]], p[i[5]], p[i[6]], p[i[7]]);
}
static inline lane lane_gather_u16(const uint16_t *p, lanei at)
{
    int32_t i[8];
    lanei_store(i, at);
    return _mm256_cvtepi32_ps(
        _mm256_setr_epi32(p[i[0]], p[i[1]], p[i[2]], p[i[3]], p[i[4]], p[i[5]], p[i[6]], p[i[7]]));
}
static inline lanei avx2_less_u16(lanei a, lanei b)
{
    const lanei sign = _mm256_set1_epi16(-32768);
    return _mm256_cmpgt_epi16(_mm256_xor_si256(b, sign), _mm256_xor_si256(a, sign));
}
/* Codes of four pixels in each 128 bits. */
#define LANE_HAS_CODES 1
#define WIDE(verb) _mm256_##verb
#define WIDE_BITS(verb) _mm256_##verb##_si256
#define WIDE_FOURS(a) _mm256_broadcastsi128_si256(a)
#define WIDE_LESS_IF(v, by, a, b) _mm256_sub_epi16(v, _mm256_and_si256(by, avx2_less_u16(a, b)))
#include "codes_wide.inl"
#undef WIDE
#undef WIDE_BITS
#undef WIDE_FOURS
#undef WIDE_LESS_IF
#define LANE_HAS_SOME 1
static inline lanei avx2_first(int n)
{
    return _mm256_cmpgt_epi32(_mm256_set1_epi32(n), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}
static inline lanei lanei_load_some(const uint8_t *p, int n)
{
    return _mm256_maskload_epi32((const int *)(const void *)p, avx2_first(n));
}
static inline void lanei_store_some(uint8_t *p, int n, lanei a)
{
    _mm256_maskstore_epi32((int *)(void *)p, avx2_first(n), a);
}
#define LANE_GATHERS_RGBA 1
static inline lanei lanei_gather_rgba(const uint8_t *p, lanei at)
{
    return _mm256_i32gather_epi32((const int *)(const void *)p, at, 4);
}
/* The pairs of codes_between_pairs: words at, at + 1 and, `below` bytes further, the same. */
#define LANE_GATHERS_PAIRS 1
static inline void lanei_gather_pairs(lanei pair[4], const uint8_t *p, ptrdiff_t below, lanei at)
{
    const __m256i all = _mm256_permute4x64_epi64(at, 0xd8);
    const __m128i a = _mm256_castsi256_si128(all), b = _mm256_extracti128_si256(all, 1);
    const long long *upper = (const long long *)(const void *)p, *lower = (const long long *)(const void *)(p + below);
    pair[0] = _mm256_i32gather_epi64(upper, a, 4);
    pair[1] = _mm256_i32gather_epi64(lower, a, 4);
    pair[2] = _mm256_i32gather_epi64(upper, b, 4);
    pair[3] = _mm256_i32gather_epi64(lower, b, 4);
}
#define LANE_GATHERS_I32 1
static inline lanei lanei_gather_i32(const int32_t *p, lanei at)
{
    return _mm256_i32gather_epi32((const int *)p, at, 4);
}
/* Eight rows of four, transposed. */
#define LANE_GATHERS_RGBA_F32 1
static inline __m256 lane_two_rows(const float *low, const float *high)
{
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}
static inline void lane_gather_rgba_f32(lane out[4], const float *p, lanei at)
{
    int32_t i[8];
    lanei_store(i, _mm256_slli_epi32(at, 2));
    const __m256 a = lane_two_rows(p + i[0], p + i[4]), b = lane_two_rows(p + i[1], p + i[5]),
                 c = lane_two_rows(p + i[2], p + i[6]), d = lane_two_rows(p + i[3], p + i[7]);
    const __m256 ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d), ab_high = _mm256_unpackhi_ps(a, b),
                 cd_high = _mm256_unpackhi_ps(c, d);
    out[0] = _mm256_shuffle_ps(ab, cd, 0x44);
    out[1] = _mm256_shuffle_ps(ab, cd, 0xee);
    out[2] = _mm256_shuffle_ps(ab_high, cd_high, 0x44);
    out[3] = _mm256_shuffle_ps(ab_high, cd_high, 0xee);
}
/* Rows of three, each read with the following number. */
#define LANE_GATHERS_CORNERS 1
static inline __m256 lane_two_corners(const float *p, const uint32_t *vertex)
{
    return lane_two_rows(p + (size_t)vertex[0] * 3, p + (size_t)vertex[12] * 3);
}
static inline void lane_gather_corners(lane out[3], const float *p, const uint32_t *vertex)
{
    const __m256 a = lane_two_corners(p, vertex), b = lane_two_corners(p, vertex + 3),
                 c = lane_two_corners(p, vertex + 6), d = lane_two_corners(p, vertex + 9);
    const __m256 ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
    out[0] = _mm256_shuffle_ps(ab, cd, 0x44);
    out[1] = _mm256_shuffle_ps(ab, cd, 0xee);
    out[2] = _mm256_shuffle_ps(_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d), 0x44);
}
/* Looks up both halves of the table; bit 3 of `at` selects one. */
static inline lane lane_table(const float *p, lanei at)
{
    return _mm256_blendv_ps(_mm256_permutevar8x32_ps(_mm256_loadu_ps(p), at),
                            _mm256_permutevar8x32_ps(_mm256_loadu_ps(p + 8), at),
                            _mm256_castsi256_ps(_mm256_slli_epi32(at, 28)));
}

static inline lane lane_load_rows(const float *p, int32_t step) { (void)step; return lane_load(p); }
static inline void lane_store_rows(float *p, int32_t step, lane a) { (void)step; lane_store(p, a); }
static inline lane lane_load_u16(const uint16_t *p, int32_t step)
{
    (void)step;
    return _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)(const void *)p)));
}
static inline __m128i avx2_narrow(__m256i a) /* 0 .. 65535 */
{
    return _mm_packus_epi32(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
}
static inline void lane_store_u16(uint16_t *p, int32_t step, lane a)
{
    (void)step;
    _mm_storeu_si128((__m128i *)(void *)p, avx2_narrow(_mm256_cvttps_epi32(a)));
}
static inline void lane_raise_u16(uint16_t *p, lane a, lane b)
{
    const __m256i mixed = _mm256_packus_epi32(_mm256_cvttps_epi32(a), _mm256_cvttps_epi32(b));
    const __m256i code = _mm256_permute4x64_epi64(mixed, _MM_SHUFFLE(3, 1, 2, 0));
    __m256i *at = (__m256i *)(void *)p;
    _mm256_storeu_si256(at, _mm256_max_epu16(_mm256_loadu_si256(at), code));
}
/* The same for left halves of rows and right ones, which narrowing puts side by side. */
static inline void lane_raise_u16_halves(uint16_t *p, lane left, lane right)
{
    const __m256i code = _mm256_packus_epi32(_mm256_cvttps_epi32(left), _mm256_cvttps_epi32(right));
    __m256i *at = (__m256i *)(void *)p;
    _mm256_storeu_si256(at, _mm256_max_epu16(_mm256_loadu_si256(at), code));
}
static inline void lane_put_u16(uint16_t *p, int32_t step, uint32_t id, lane_mask m)
{
    __m128i *at = (__m128i *)(void *)p;
    __m256i wide = _mm256_castps_si256(m);
    __m128i narrow = _mm_packs_epi32(_mm256_castsi256_si128(wide), _mm256_extracti128_si256(wide, 1));
    (void)step;
    _mm_storeu_si128(at, _mm_blendv_epi8(_mm_loadu_si128(at), _mm_set1_epi16((short)id), narrow));
}
static inline void lane_put_u32(uint32_t *p, int32_t step, uint32_t id, lane_mask m)
{
    __m256i *at = (__m256i *)(void *)p;
    __m256i ids = _mm256_set1_epi32((int32_t)id);
    (void)step;
    _mm256_storeu_si256(at, _mm256_blendv_epi8(_mm256_loadu_si256(at), ids, _mm256_castps_si256(m)));
}

#endif
