/* codes_wide.inl: the verbs of 8-bit codes by AVX2 and AVX-512. Layer 2.
 *
 * Included by lane_avx2.h and lane_avx512.h, which define WIDE(add_epi16), the instruction of their width;
 * WIDE_BITS(xor), the same for whole registers; WIDE_FOURS, 128 bits in all places; and WIDE_SHUFFLE. */

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
/* Corners along x by 16 bits: at most 255 x 256. Along y by 32 bits, from 2^15 less, because products are signed. */
static inline lanei wide_between_x(lanei a, lanei b, lanei x)
{
    return WIDE(add_epi16)(WIDE(slli_epi16)(a, 8), WIDE(mullo_epi16)(WIDE(sub_epi16)(b, a), x));
}
static inline lanei wide_between_y(lanei pair, lanei y)
{
    return WIDE(srli_epi32)(WIDE(add_epi32)(WIDE(madd_epi16)(pair, y), WIDE(set1_epi32)((1 << 23) + (1 << 15))),
                             16);
}
static inline lanei codes_between(const lanei corner[4], lanei x, lanei y)
{
    const lanei zero = WIDE_BITS(setzero)(), sign = WIDE(set1_epi16)(-32768);
    const lanei shares = WIDE_BITS(or)(WIDE(sub_epi32)(WIDE(set1_epi32)(256), y), WIDE(slli_epi32)(y, 16));
    const lanei xx = WIDE_BITS(or)(x, WIDE(slli_epi32)(x, 16)), x_low = WIDE(unpacklo_epi32)(xx, xx),
                x_high = WIDE(unpackhi_epi32)(xx, xx);
    lanei half[2];
    for (int i = 0; i < 2; ++i) {
        const lanei upper = wide_between_x(
            i ? WIDE(unpackhi_epi8)(corner[0], zero) : WIDE(unpacklo_epi8)(corner[0], zero),
            i ? WIDE(unpackhi_epi8)(corner[1], zero) : WIDE(unpacklo_epi8)(corner[1], zero), i ? x_high : x_low);
        const lanei lower = wide_between_x(
            i ? WIDE(unpackhi_epi8)(corner[2], zero) : WIDE(unpacklo_epi8)(corner[2], zero),
            i ? WIDE(unpackhi_epi8)(corner[3], zero) : WIDE(unpacklo_epi8)(corner[3], zero), i ? x_high : x_low);
        const lanei p = WIDE_BITS(xor)(upper, sign), q = WIDE_BITS(xor)(lower, sign);
        half[i] =
            WIDE(packs_epi32)(wide_between_y(WIDE(unpacklo_epi16)(p, q), i ? WIDE_SHUFFLE(shares, 0xaa)
                                                                             : WIDE_SHUFFLE(shares, 0x00)),
                               wide_between_y(WIDE(unpackhi_epi16)(p, q), i ? WIDE_SHUFFLE(shares, 0xff)
                                                                             : WIDE_SHUFFLE(shares, 0x55)));
    }
    return WIDE(packus_epi16)(half[0], half[1]);
}
