/* codes_wide.inl: the verbs of 8-bit codes by AVX2 and AVX-512. Layer 2.
 *
 * Included by lane_avx2.h and lane_avx512.h, which define WIDE(add_epi16), the instruction of their width;
 * WIDE_BITS(xor), the same for whole registers; WIDE_FOURS, 128 bits in all places; and WIDE_LESS_IF(v, by, a, b), v
 * less `by` in the 16-bit places where a < b. */

/* Sixteen-bit products of codes, in the low and the high halves of 128 bits. (t + 128) 257 / 2^16 is t / 255 to
 * nearest, for t = 0 .. 255 x 255. */
static inline lanei wide_255ths(lanei low, lanei high)
{
    const lanei half = WIDE(set1_epi16)(128), by = WIDE(set1_epi16)(257);
    return WIDE(packus_epi16)(WIDE(mulhi_epu16)(WIDE(add_epi16)(low, half), by),
                               WIDE(mulhi_epu16)(WIDE(add_epi16)(high, half), by));
}
static inline lanei codes_times(lanei x, lanei y)
{
    const lanei zero = WIDE_BITS(setzero)();
    return wide_255ths(WIDE(mullo_epi16)(WIDE(unpacklo_epi8)(x, zero), WIDE(unpacklo_epi8)(y, zero)),
                       WIDE(mullo_epi16)(WIDE(unpackhi_epi8)(x, zero), WIDE(unpackhi_epi8)(y, zero)));
}
/* The share in all 16-bit places of the first, or last, two pixels of 128 bits. */
static inline lanei wide_shares_low(lanei x)
{
    return WIDE(shuffle_epi8)(
        x, WIDE_FOURS(_mm_setr_epi8(3, -1, 3, -1, 3, -1, 3, -1, 7, -1, 7, -1, 7, -1, 7, -1)));
}
static inline lanei wide_shares_high(lanei x)
{
    return WIDE(shuffle_epi8)(
        x, WIDE_FOURS(_mm_setr_epi8(11, -1, 11, -1, 11, -1, 11, -1, 15, -1, 15, -1, 15, -1, 15, -1)));
}
static inline lanei codes_plus(lanei x, lanei y)
{
    const lanei zero = WIDE_BITS(setzero)(),
                low = WIDE(mullo_epi16)(WIDE(unpacklo_epi8)(x, zero), wide_shares_low(x)),
                high = WIDE(mullo_epi16)(WIDE(unpackhi_epi8)(x, zero), wide_shares_high(x));
    return WIDE(adds_epu8)(wide_255ths(low, high), y);
}
/* Bytes 255 - a and a, times the bytes y - 128 and x - 128: the sum is 255 x 128 too small. */
static inline lanei codes_over(lanei x, lanei y)
{
    const lanei sign = WIDE(set1_epi8)(-128), rest = WIDE(set1_epi16)(255), more = WIDE(set1_epi16)(-32768),
                by = WIDE(set1_epi16)(257);
    const lanei low = WIDE(shuffle_epi8)(
                    x, WIDE_FOURS(_mm_setr_epi8(3, 3, 3, 3, 3, 3, 3, 3, 7, 7, 7, 7, 7, 7, 7, 7))),
                high = WIDE(shuffle_epi8)(x, WIDE_FOURS(_mm_setr_epi8(
                                                  11, 11, 11, 11, 11, 11, 11, 11, 15, 15, 15, 15, 15, 15, 15, 15)));
    const lanei a = WIDE_BITS(xor)(x, sign), b = WIDE_BITS(xor)(y, sign);
    const lanei p = WIDE(maddubs_epi16)(WIDE_BITS(xor)(low, rest), WIDE(unpacklo_epi8)(b, a)),
                q = WIDE(maddubs_epi16)(WIDE_BITS(xor)(high, rest), WIDE(unpackhi_epi8)(b, a));
    return WIDE(packus_epi16)(WIDE(mulhi_epu16)(WIDE_BITS(xor)(p, more), by),
                               WIDE(mulhi_epu16)(WIDE_BITS(xor)(q, more), by));
}
/* Compilers move all of x out of loops. */
static inline lanei codes_same(lanei x, lanei y)
{
    const lanei zero = WIDE_BITS(setzero)(), all = WIDE(set1_epi16)(255), half = WIDE(set1_epi16)(128),
                by = WIDE(set1_epi16)(257);
    const lanei low = wide_shares_low(x), high = wide_shares_high(x);
    const lanei p = WIDE(add_epi16)(WIDE(mullo_epi16)(WIDE(unpacklo_epi8)(x, zero), low), half),
                q = WIDE(add_epi16)(WIDE(mullo_epi16)(WIDE(unpackhi_epi8)(x, zero), high), half);
    const lanei r = WIDE(add_epi16)(WIDE(mullo_epi16)(WIDE(unpacklo_epi8)(y, zero), WIDE(sub_epi16)(all, low)), p),
                t = WIDE(add_epi16)(WIDE(mullo_epi16)(WIDE(unpackhi_epi8)(y, zero), WIDE(sub_epi16)(all, high)), q);
    return WIDE(packus_epi16)(WIDE(mulhi_epu16)(r, by), WIDE(mulhi_epu16)(t, by));
}
/* Two pixels of 128 bits, left and right texel each, along x: at most 255 x 256. x: the share in 16-bit places.
 * 0x01ff: the bytes -1 and 1, so a pair gives right - left. */
static inline lanei wide_between_x(lanei pair, lanei x)
{
    const lanei left = WIDE(shuffle_epi8)(
                    pair, WIDE_FOURS(_mm_setr_epi8(-1, 0, -1, 1, -1, 2, -1, 3, -1, 8, -1, 9, -1, 10, -1, 11))),
                both = WIDE(shuffle_epi8)(
                    pair, WIDE_FOURS(_mm_setr_epi8(0, 4, 1, 5, 2, 6, 3, 7, 8, 12, 9, 13, 10, 14, 11, 15)));
    return WIDE(add_epi16)(left, WIDE(mullo_epi16)(WIDE(maddubs_epi16)(both, WIDE(set1_epi16)(0x01ff)), x));
}
/* The same along y, rounded. The difference has 17 bits: the product of its low 16 is too large by y if it is negative.
 * y: the share x 256. */
static inline lanei wide_between_y(lanei upper, lanei lower, lanei y)
{
    const lanei more = WIDE(mulhi_epu16)(WIDE(sub_epi16)(lower, upper), y);
    const lanei sum = WIDE(add_epi16)(WIDE(add_epi16)(upper, WIDE(set1_epi16)(128)), more);
    return WIDE(srli_epi16)(WIDE_LESS_IF(sum, y, lower, upper), 8);
}
/* codes_between; pair: upper and lower texels of the first two pixels of 128 bits, then of the others. */
static inline lanei codes_between_pairs(const lanei pair[4], lanei x, lanei y)
{
    const __m128i low0 = _mm_setr_epi8(0, -1, 0, -1, 0, -1, 0, -1, 4, -1, 4, -1, 4, -1, 4, -1),
                  low1 = _mm_setr_epi8(8, -1, 8, -1, 8, -1, 8, -1, 12, -1, 12, -1, 12, -1, 12, -1),
                  high0 = _mm_setr_epi8(-1, 0, -1, 0, -1, 0, -1, 0, -1, 4, -1, 4, -1, 4, -1, 4),
                  high1 = _mm_setr_epi8(-1, 8, -1, 8, -1, 8, -1, 8, -1, 12, -1, 12, -1, 12, -1, 12);
    const lanei x0 = WIDE(shuffle_epi8)(x, WIDE_FOURS(low0)), x1 = WIDE(shuffle_epi8)(x, WIDE_FOURS(low1));
    const lanei y0 = WIDE(shuffle_epi8)(y, WIDE_FOURS(high0)), y1 = WIDE(shuffle_epi8)(y, WIDE_FOURS(high1));
    return WIDE(packus_epi16)(wide_between_y(wide_between_x(pair[0], x0), wide_between_x(pair[1], x0), y0),
                               wide_between_y(wide_between_x(pair[2], x1), wide_between_x(pair[3], x1), y1));
}
static inline void lanei_pair_corners(lanei out[4], const lanei corner[4])
{
    out[0] = WIDE(unpacklo_epi32)(corner[0], corner[1]);
    out[1] = WIDE(unpacklo_epi32)(corner[2], corner[3]);
    out[2] = WIDE(unpackhi_epi32)(corner[0], corner[1]);
    out[3] = WIDE(unpackhi_epi32)(corner[2], corner[3]);
}
static inline lanei codes_between(const lanei corner[4], lanei x, lanei y)
{
    lanei pair[4];
    lanei_pair_corners(pair, corner);
    return codes_between_pairs(pair, x, y);
}
