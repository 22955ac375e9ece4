/* sums_sse2.h: sums of 16-bit values times weights by SSE2. lane_scalar.h defines each verb. Layer 2.
 *
 * Products are signed, so rows are stored 32768 lower. The fourth value, which is 0, is shifted too and so sums to the
 * correction for the others. */
#ifndef LMB_SUMS_SSE2_H
#define LMB_SUMS_SSE2_H

#include <emmintrin.h>

typedef __m128i lane_pair;
typedef __m128i lane_sums;

static inline lane_pair pair_load(const uint16_t *first, const uint16_t *second)
{
    const __m128i a = _mm_loadl_epi64((const __m128i *)(const void *)first),
                  b = _mm_loadl_epi64((const __m128i *)(const void *)second);
    return _mm_xor_si128(_mm_unpacklo_epi16(a, b), _mm_set1_epi16(-32768));
}
static inline lane_sums sums_zero(void) { return _mm_setzero_si128(); }
static inline lane_sums sums_add(lane_sums s, lane_pair p, uint32_t weights)
{
    return _mm_add_epi32(s, _mm_madd_epi16(p, _mm_set1_epi32((int32_t)weights)));
}
static inline void sums_store(int32_t out[3], lane_sums s)
{
    int32_t v[4];
    _mm_storeu_si128((__m128i *)(void *)v, _mm_sub_epi32(s, _mm_shuffle_epi32(s, _MM_SHUFFLE(3, 3, 3, 3))));
    out[0] = v[0];
    out[1] = v[1];
    out[2] = v[2];
}

#endif
