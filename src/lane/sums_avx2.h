/* sums_avx2.h: sums of 16-bit values times weights by AVX2, four rows at a time; see sums_sse2.h. Layer 2.
 *
 * Each half of the sums holds a pair. */
#ifndef LMB_SUMS_AVX2_H
#define LMB_SUMS_AVX2_H

typedef __m128i lane_pair;
typedef __m256i lane_sums;

static inline __m128i avx2_rows(const uint16_t *first, const uint16_t *second)
{
    return _mm_unpacklo_epi16(_mm_loadl_epi64((const __m128i *)(const void *)first),
                              _mm_loadl_epi64((const __m128i *)(const void *)second));
}
static inline lane_pair pair_load(const uint16_t *first, const uint16_t *second)
{
    return _mm_xor_si128(avx2_rows(first, second), _mm_set1_epi16(-32768));
}
static inline lane_sums sums_zero(void) { return _mm256_setzero_si256(); }
static inline lane_sums sums_add(lane_sums s, lane_pair p, uint32_t weights)
{
    const __m128i products = _mm_madd_epi16(p, _mm_set1_epi32((int32_t)weights));
    return _mm256_add_epi32(s, _mm256_inserti128_si256(_mm256_setzero_si256(), products, 0));
}
static inline void sums_store(int32_t out[3], lane_sums s)
{
    int32_t v[4];
    const __m128i both = _mm_add_epi32(_mm256_castsi256_si128(s), _mm256_extracti128_si256(s, 1));
    _mm_storeu_si128((__m128i *)(void *)v, _mm_sub_epi32(both, _mm_shuffle_epi32(both, _MM_SHUFFLE(3, 3, 3, 3))));
    out[0] = v[0];
    out[1] = v[1];
    out[2] = v[2];
}

#define LANE_ADDS_LINKS 1
static inline __m256i avx2_four_rows(const uint16_t *a, const uint16_t *b, const uint16_t *c, const uint16_t *d)
{
    return _mm256_xor_si256(_mm256_inserti128_si256(_mm256_castsi128_si256(avx2_rows(a, b)), avx2_rows(c, d), 1),
                            _mm256_set1_epi16(-32768));
}
/* Adds the rows times weights: two bytes at `low` and two at `high` of each half of the words. */
static inline __m256i avx2_weigh(__m256i s, __m256i rows, __m256i words, int low, int high)
{
    const int pair = low | (low + 1) << 8 | high << 16 | (high + 1) << 24;
    return _mm256_add_epi32(s, _mm256_madd_epi16(rows, _mm256_shuffle_epi8(words, _mm256_set1_epi32(pair))));
}
static inline lane_sums sums_add_links(lane_sums s, uint16_t (*row)[4], const uint32_t *link)
{
    const __m256i rows = avx2_four_rows(row[(uint16_t)link[0]], row[(uint16_t)link[1]], row[(uint16_t)link[2]],
                                        row[(uint16_t)link[3]]);
    const __m256i words =
        _mm256_permute4x64_epi64(_mm256_castsi128_si256(_mm_loadu_si128((const __m128i *)(const void *)link)), 0x50);
    return avx2_weigh(s, rows, words, 2, 6);
}
static inline void sums_add_directed(lane_sums s[3], uint16_t (*row)[4], const uint32_t *link)
{
    const __m256i rows = avx2_four_rows(row[(uint16_t)link[0]], row[(uint16_t)link[2]], row[(uint16_t)link[4]],
                                        row[(uint16_t)link[6]]);
    const __m256i words = _mm256_loadu_si256((const __m256i *)(const void *)link);
    s[0] = avx2_weigh(s[0], rows, words, 2, 10);
    s[1] = avx2_weigh(s[1], rows, words, 4, 12);
    s[2] = avx2_weigh(s[2], rows, words, 6, 14);
}

#endif
