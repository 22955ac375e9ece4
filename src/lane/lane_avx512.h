/* lane_avx512.h: the lane verbs by AVX-512, sixteen wide: two rows of a tile; see lane_scalar.h. Layer 2.
 *
 * Include after target_avx512.h. Masks are bits. Verbs that load and store surfaces process eight values of a row at a
 * time, so that linear targets, with rows far apart, need no special case. */
#ifndef LMB_LANE_AVX512_H
#define LMB_LANE_AVX512_H

#include "../base/vec.h"
#include "sums_avx2.h"

#define LANES 16

typedef __m512 lane;
typedef __m512i lanei;
typedef __mmask16 lane_mask;
typedef struct laned {
    __m512d lo, hi;
} laned;

static inline lane lane_splat(float a) { return _mm512_set1_ps(a); }
static inline lane lane_load(const float *p) { return _mm512_loadu_ps(p); }
static inline void lane_store(float *p, lane a) { _mm512_storeu_ps(p, a); }
static inline lane lane_add(lane a, lane b) { return _mm512_add_ps(a, b); }
static inline lane lane_sub(lane a, lane b) { return _mm512_sub_ps(a, b); }
static inline lane lane_mul(lane a, lane b) { return _mm512_mul_ps(a, b); }
static inline lane lane_div(lane a, lane b) { return _mm512_div_ps(a, b); }
static inline lane lane_sqrt(lane a) { return _mm512_sqrt_ps(a); }
#define LANE_GUESSES_ROOTS 1
static inline lane lane_root_guess(lane a) { return _mm512_mul_ps(a, _mm512_rsqrt14_ps(a)); }
static inline lane lane_min(lane a, lane b) { return _mm512_min_ps(a, b); }
static inline lane lane_max(lane a, lane b) { return _mm512_max_ps(a, b); }
static inline lane_mask lane_lt(lane a, lane b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
static inline lane_mask lane_le(lane a, lane b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
static inline lane lane_pick(lane_mask m, lane a, lane b) { return _mm512_mask_blend_ps(m, b, a); }
static inline lane lane_keep(lane_mask m, lane a) { return _mm512_maskz_mov_ps(m, a); }
static inline lane_mask mask_and(lane_mask a, lane_mask b) { return (lane_mask)(a & b); }
static inline lane_mask mask_or(lane_mask a, lane_mask b) { return (lane_mask)(a | b); }
static inline lane_mask mask_not(lane_mask a) { return (lane_mask)(a ^ 0xffffu); }
static inline uint32_t mask_bits(lane_mask a) { return a; }
static inline lane_mask mask_of_bits(uint32_t b) { return (lane_mask)b; }

static inline lanei lanei_splat(int32_t a) { return _mm512_set1_epi32(a); }
static inline lanei lanei_load(const int32_t *p) { return _mm512_loadu_si512(p); }
static inline void lanei_store(int32_t *p, lanei a) { _mm512_storeu_si512(p, a); }
static inline lanei lanei_add(lanei a, lanei b) { return _mm512_add_epi32(a, b); }
static inline lanei lanei_or(lanei a, lanei b) { return _mm512_or_si512(a, b); }
static inline lanei lanei_and(lanei a, lanei b) { return _mm512_and_si512(a, b); }
static inline lanei lanei_mul(lanei a, lanei b) { return _mm512_mullo_epi32(a, b); }
#define LANE_ADDS_HALVES 1
static inline lanei lanei_add_halves(lanei a, lanei b) { return _mm512_madd_epi16(a, b); }
static inline lanei lanei_sub(lanei a, lanei b) { return _mm512_sub_epi32(a, b); }
static inline lanei lanei_min(lanei a, lanei b) { return _mm512_min_epi32(a, b); }
static inline lanei lanei_max(lanei a, lanei b) { return _mm512_max_epi32(a, b); }
static inline lanei lanei_pick(lane_mask m, lanei a, lanei b) { return _mm512_mask_blend_epi32(m, b, a); }
static inline lane_mask lanei_lt(lanei a, lanei b) { return _mm512_cmplt_epi32_mask(a, b); }
static inline lanei lanei_shift(lanei a, int n) { return _mm512_srai_epi32(a, (unsigned)n); }
static inline lane_mask lanei_not_negative(lanei a) { return _mm512_cmpge_epi32_mask(a, _mm512_setzero_si512()); }
static inline lane_mask lanei_equal(lanei a, lanei b) { return _mm512_cmpeq_epi32_mask(a, b); }
static inline lanei lane_to_int(lane a) { return _mm512_cvttps_epi32(a); }
static inline lane lane_from_int(lanei a) { return _mm512_cvtepi32_ps(a); }
#define LANE_HAS_PART 1
static inline lane lane_part(lane a) { return _mm512_reduce_ps(a, 3); }
static inline lane lane_trunc(lane a) { return _mm512_cvtepi32_ps(_mm512_cvttps_epi32(a)); }

#define AVX512_BOTH(f) a.lo = f(a.lo, b.lo), a.hi = f(a.hi, b.hi)
static inline laned laned_add(laned a, laned b) { AVX512_BOTH(_mm512_add_pd); return a; }
static inline laned laned_sub(laned a, laned b) { AVX512_BOTH(_mm512_sub_pd); return a; }
static inline laned laned_mul(laned a, laned b) { AVX512_BOTH(_mm512_mul_pd); return a; }
static inline laned laned_div(laned a, laned b) { AVX512_BOTH(_mm512_div_pd); return a; }
#undef AVX512_BOTH
static inline laned laned_splat(double a) { laned r; r.lo = r.hi = _mm512_set1_pd(a); return r; }
static inline laned laned_from(lane a)
{
    laned r;
    r.lo = _mm512_cvtps_pd(_mm512_castps512_ps256(a));
    r.hi = _mm512_cvtps_pd(_mm512_extractf32x8_ps(a, 1));
    return r;
}
static inline laned laned_from_int(lanei a)
{
    laned r;
    r.lo = _mm512_cvtepi32_pd(_mm512_castsi512_si256(a));
    r.hi = _mm512_cvtepi32_pd(_mm512_extracti32x8_epi32(a, 1));
    return r;
}
static inline lane lane_from_double(laned a)
{
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.lo)), _mm512_cvtpd_ps(a.hi), 1);
}
static inline laned laned_load(const double *p)
{
    laned r;
    r.lo = _mm512_loadu_pd(p);
    r.hi = _mm512_loadu_pd(p + 8);
    return r;
}
static inline void laned_store(double *p, laned a)
{
    _mm512_storeu_pd(p, a.lo);
    _mm512_storeu_pd(p + 8, a.hi);
}

#define LANE_HAS_LOWEST 1
static inline float lane_lowest(lane a)
{
    const __m256 b = _mm256_min_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1));
    const __m128 c = _mm_min_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
    const __m128 d = _mm_min_ps(c, _mm_movehl_ps(c, c));
    return _mm_cvtss_f32(_mm_min_ss(d, _mm_movehdup_ps(d)));
}

#define LANE_HAS_SUM16 1
static inline float lane_sum16(const float v[16])
{
    const __m512 all = _mm512_loadu_ps(v);
    const __m256 a = _mm256_add_ps(_mm512_castps512_ps256(all), _mm512_extractf32x8_ps(all, 1));
    const __m128 b = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 c = _mm_add_ps(b, _mm_movehl_ps(b, b));
    return _mm_cvtss_f32(_mm_add_ss(c, _mm_movehdup_ps(c)));
}

#define LANE_HAS_SCAN16 1
static inline __m512 lane_add_before(__m512 a, __m512i before) { return _mm512_add_ps(a, _mm512_castsi512_ps(before)); }
static inline void lane_scan16(float out[16], const float v[16], float base)
{
    const __m512i zero = _mm512_setzero_si512();
    __m512 a = _mm512_loadu_ps(v);
    a = lane_add_before(a, _mm512_alignr_epi32(_mm512_castps_si512(a), zero, 15));
    a = lane_add_before(a, _mm512_alignr_epi32(_mm512_castps_si512(a), zero, 14));
    a = lane_add_before(a, _mm512_alignr_epi32(_mm512_castps_si512(a), zero, 12));
    a = lane_add_before(a, _mm512_alignr_epi32(_mm512_castps_si512(a), zero, 8));
    _mm512_storeu_ps(out, _mm512_add_ps(a, _mm512_set1_ps(base)));
}

#define LANE_GATHERS_I32 1
static inline lanei lanei_gather_i32(const int32_t *p, lanei at) { return _mm512_i32gather_epi32(at, p, 4); }
static inline lane lane_gather_f32(const float *p, lanei at) { return _mm512_i32gather_ps(at, p, 4); }
/* One by one: the instruction gathers at least 32 bits and would read past the end. */
static inline lane lane_gather_u16(const uint16_t *p, lanei at)
{
    int32_t i[16];
    lanei_store(i, at);
    for (int k = 0; k < 16; ++k) {
        i[k] = p[i[k]];
    }
    return _mm512_cvtepi32_ps(lanei_load(i));
}
/* Codes of four pixels in each 128 bits. */
#define LANE_HAS_CODES 1
#define WIDE(verb) _mm512_##verb
#define WIDE_BITS(verb) _mm512_##verb##_si512
#define WIDE_FOURS(a) _mm512_broadcast_i32x4(a)
#define WIDE_LESS_IF(v, by, a, b) _mm512_mask_sub_epi16(v, _mm512_cmplt_epu16_mask(a, b), v, by)
#include "codes_wide.inl"
#undef WIDE
#undef WIDE_BITS
#undef WIDE_FOURS
#undef WIDE_LESS_IF
#define LANE_HAS_SOME 1
static inline lanei lanei_load_some(const uint8_t *p, int n)
{
    return _mm512_maskz_loadu_epi32((__mmask16)((1u << n) - 1u), p);
}
static inline void lanei_store_some(uint8_t *p, int n, lanei a)
{
    _mm512_mask_storeu_epi32(p, (__mmask16)((1u << n) - 1u), a);
}
#define LANE_GATHERS_RGBA 1
static inline lanei lanei_gather_rgba(const uint8_t *p, lanei at) { return _mm512_i32gather_epi32(at, p, 4); }
/* The pairs of codes_between_pairs: words at, at + 1 and, `below` bytes further, the same. */
#define LANE_GATHERS_PAIRS 1
static inline void lanei_gather_pairs(lanei pair[4], const uint8_t *p, ptrdiff_t below, lanei at)
{
    const __m512i all = _mm512_permutexvar_epi64(_mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7), at);
    const __m256i a = _mm512_castsi512_si256(all), b = _mm512_extracti64x4_epi64(all, 1);
    pair[0] = _mm512_i32gather_epi64(a, p, 4);
    pair[1] = _mm512_i32gather_epi64(a, p + below, 4);
    pair[2] = _mm512_i32gather_epi64(b, p, 4);
    pair[3] = _mm512_i32gather_epi64(b, p + below, 4);
}
#define LANE_HAS_WITHIN 1
static inline lane_mask lanei_within(lanei a, int32_t n) { return _mm512_cmplt_epu32_mask(a, _mm512_set1_epi32(n)); }
/* Loads, or stores, the lanes of the mask. */
static inline lanei lanei_load_rows_some(const uint8_t *p, int32_t step, lane_mask m)
{
    return _mm512_inserti32x8(_mm512_castsi256_si512(_mm256_maskz_loadu_epi32((__mmask8)m, p)),
                              _mm256_maskz_loadu_epi32((__mmask8)(m >> 8), p + step), 1);
}
static inline void lane_store_rows_some(float *p, int32_t step, lane_mask m, lane a)
{
    _mm256_mask_storeu_ps(p, (__mmask8)m, _mm512_castps512_ps256(a));
    _mm256_mask_storeu_ps(p + step, (__mmask8)(m >> 8), _mm512_extractf32x8_ps(a, 1));
}
static inline void lanei_store_rows_some(uint8_t *p, int32_t step, lane_mask m, lanei a)
{
    _mm256_mask_storeu_epi32(p, (__mmask8)m, _mm512_castsi512_si256(a));
    _mm256_mask_storeu_epi32(p + step, (__mmask8)(m >> 8), _mm512_extracti32x8_epi32(a, 1));
}
/* Sixteen rows of four, transposed. */
#define LANE_GATHERS_RGBA_F32 1
static inline __m512 lane_four_rows(const float *p, const int32_t *at)
{
    const __m512 a = _mm512_castps128_ps512(_mm_loadu_ps(p + at[0]));
    const __m512 b = _mm512_insertf32x4(a, _mm_loadu_ps(p + at[4]), 1);
    return _mm512_insertf32x4(_mm512_insertf32x4(b, _mm_loadu_ps(p + at[8]), 2), _mm_loadu_ps(p + at[12]), 3);
}
static inline void lane_gather_rgba_f32(lane out[4], const float *p, lanei at)
{
    int32_t i[16];
    lanei_store(i, _mm512_slli_epi32(at, 2));
    const __m512 a = lane_four_rows(p, i), b = lane_four_rows(p, i + 1), c = lane_four_rows(p, i + 2),
                 d = lane_four_rows(p, i + 3);
    const __m512 ab = _mm512_unpacklo_ps(a, b), cd = _mm512_unpacklo_ps(c, d), ab_high = _mm512_unpackhi_ps(a, b),
                 cd_high = _mm512_unpackhi_ps(c, d);
    out[0] = _mm512_shuffle_ps(ab, cd, 0x44);
    out[1] = _mm512_shuffle_ps(ab, cd, 0xee);
    out[2] = _mm512_shuffle_ps(ab_high, cd_high, 0x44);
    out[3] = _mm512_shuffle_ps(ab_high, cd_high, 0xee);
}
/* Rows of three, each read with the following number. */
#define LANE_GATHERS_CORNERS 1
static inline __m128 lane_row_of_three(const float *p, const uint32_t *vertex, int k)
{
    return _mm_loadu_ps(p + (size_t)vertex[3 * k] * 3);
}
static inline __m512 lane_four_corners(const float *p, const uint32_t *vertex)
{
    const __m512 a = _mm512_castps128_ps512(lane_row_of_three(p, vertex, 0));
    const __m512 b = _mm512_insertf32x4(a, lane_row_of_three(p, vertex, 4), 1);
    return _mm512_insertf32x4(_mm512_insertf32x4(b, lane_row_of_three(p, vertex, 8), 2),
                              lane_row_of_three(p, vertex, 12), 3);
}
static inline void lane_gather_corners(lane out[3], const float *p, const uint32_t *vertex)
{
    const __m512 a = lane_four_corners(p, vertex), b = lane_four_corners(p, vertex + 3),
                 c = lane_four_corners(p, vertex + 6), d = lane_four_corners(p, vertex + 9);
    const __m512 ab = _mm512_unpacklo_ps(a, b), cd = _mm512_unpacklo_ps(c, d);
    out[0] = _mm512_shuffle_ps(ab, cd, 0x44);
    out[1] = _mm512_shuffle_ps(ab, cd, 0xee);
    out[2] = _mm512_shuffle_ps(_mm512_unpackhi_ps(a, b), _mm512_unpackhi_ps(c, d), 0x44);
}
static inline lane lane_table(const float *p, lanei at) { return _mm512_permutexvar_ps(at, _mm512_loadu_ps(p)); }

/* Rows of a tiled surface are contiguous: one access. If `step` is a constant, the branch is too. */
static inline lane lane_load_rows(const float *p, int32_t step)
{
    if (step == 8) {
        return lane_load(p);
    }
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(p)), _mm256_loadu_ps(p + step), 1);
}
/* The same for pixels; step in bytes. */
static inline lanei lanei_load_rows(const uint8_t *p, int32_t step)
{
    const __m256i upper = _mm256_loadu_si256((const __m256i *)(const void *)p),
                  lower = _mm256_loadu_si256((const __m256i *)(const void *)(p + step));
    return _mm512_inserti32x8(_mm512_castsi256_si512(upper), lower, 1);
}
static inline void lanei_store_rows(uint8_t *p, int32_t step, lanei a)
{
    _mm256_storeu_si256((__m256i *)(void *)p, _mm512_castsi512_si256(a));
    _mm256_storeu_si256((__m256i *)(void *)(p + step), _mm512_extracti32x8_epi32(a, 1));
}
static inline void lane_store_rows(float *p, int32_t step, lane a)
{
    if (step == 8) {
        lane_store(p, a);
        return;
    }
    _mm256_storeu_ps(p, _mm512_castps512_ps256(a));
    _mm256_storeu_ps(p + step, _mm512_extractf32x8_ps(a, 1));
}
static inline __m256i avx512_rows_u16(const uint16_t *p, int32_t step)
{
    __m128i upper = _mm_loadu_si128((const __m128i *)(const void *)p);
    __m128i lower = _mm_loadu_si128((const __m128i *)(const void *)(p + step));
    return _mm256_inserti128_si256(_mm256_castsi128_si256(upper), lower, 1);
}
static inline void avx512_put_rows_u16(uint16_t *p, int32_t step, __m256i code)
{
    _mm_storeu_si128((__m128i *)(void *)p, _mm256_castsi256_si128(code));
    _mm_storeu_si128((__m128i *)(void *)(p + step), _mm256_extracti128_si256(code, 1));
}
static inline lane lane_load_u16(const uint16_t *p, int32_t step)
{
    return _mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(avx512_rows_u16(p, step)));
}
static inline void lane_store_u16(uint16_t *p, int32_t step, lane a)
{
    avx512_put_rows_u16(p, step, _mm512_cvtepi32_epi16(_mm512_cvttps_epi32(a)));
}
static inline void lane_raise_u16(uint16_t *p, lane a, lane b)
{
    const __m512i mixed = _mm512_packus_epi32(_mm512_cvttps_epi32(a), _mm512_cvttps_epi32(b));
    const __m512i code = _mm512_permutexvar_epi64(_mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7), mixed);
    _mm512_storeu_si512(p, _mm512_max_epu16(_mm512_loadu_si512(p), code));
}
/* The same for left halves of rows and right ones, which narrowing puts side by side. */
static inline void lane_raise_u16_halves(uint16_t *p, lane left, lane right)
{
    const __m512i code = _mm512_packus_epi32(_mm512_cvttps_epi32(left), _mm512_cvttps_epi32(right));
    _mm512_storeu_si512(p, _mm512_max_epu16(_mm512_loadu_si512(p), code));
}
static inline void lane_put_u16(uint16_t *p, int32_t step, uint32_t id, lane_mask m)
{
    avx512_put_rows_u16(p, step, _mm256_mask_blend_epi16(m, avx512_rows_u16(p, step), _mm256_set1_epi16((short)id)));
}
/* Words of 8 columns and 4 rows, of an array with rows of `step` bytes. Word 8 r + c is that of row r and column c. */
#define LANE_HAS_BLOCKS 1
typedef struct lanei_block {
    __m512i upper, lower;
} lanei_block;
static inline lanei_block lanei_block_of(const uint8_t *first, size_t step)
{
    const __m256i a = _mm256_loadu_si256((const __m256i *)(const void *)first),
                  b = _mm256_loadu_si256((const __m256i *)(const void *)(first + step)),
                  c = _mm256_loadu_si256((const __m256i *)(const void *)(first + 2 * step)),
                  d = _mm256_loadu_si256((const __m256i *)(const void *)(first + 3 * step));
    lanei_block r;
    r.upper = _mm512_inserti64x4(_mm512_castsi256_si512(a), b, 1);
    r.lower = _mm512_inserti64x4(_mm512_castsi256_si512(c), d, 1);
    return r;
}
static inline lanei lanei_block_at(lanei_block b, lanei at) { return _mm512_permutex2var_epi32(b.upper, at, b.lower); }
/* The least of the lanes in a mask. */
static inline int32_t lanei_lowest_of(lane_mask m, lanei a) { return _mm512_mask_reduce_min_epi32(m, a); }

/* Ids of a tile are not read back while the tile is drawn, so a masked store is faster. Other stores blend all 16
 * lanes, because clang 14 splits the upper half of a mask through memory. */
static inline void lane_put_u32(uint32_t *p, int32_t step, uint32_t id, lane_mask m)
{
    if (step == 8) {
        _mm512_mask_storeu_epi32(p, m, _mm512_set1_epi32((int32_t)id));
        return;
    }
    __m256i *upper = (__m256i *)(void *)p, *lower = (__m256i *)(void *)(p + step);
    __m512i old = _mm512_inserti32x8(_mm512_castsi256_si512(_mm256_loadu_si256(upper)), _mm256_loadu_si256(lower), 1);
    __m512i now = _mm512_mask_blend_epi32(m, old, _mm512_set1_epi32((int32_t)id));
    _mm256_storeu_si256(upper, _mm512_castsi512_si256(now));
    _mm256_storeu_si256(lower, _mm512_extracti32x8_epi32(now, 1));
}

#endif
