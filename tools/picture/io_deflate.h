/* io_deflate.h: constants shared by both directions of zlib streams (RFC 1950, RFC 1951). */
#ifndef IO_DEFLATE_H
#define IO_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

enum {
    DEFLATE_STORED = 0, /* block types */
    DEFLATE_FIXED = 1,
    DEFLATE_DYNAMIC = 2,
    DEFLATE_END = 256,       /* the symbol that closes a block */
    DEFLATE_LENGTH_0 = 257,  /* the first length symbol */
    DEFLATE_LITLENS = 286,   /* symbols in use; the fixed code has two more that must not occur */
    DEFLATE_FIXED_LITLENS = 288,
    DEFLATE_DISTS = 30,
    DEFLATE_METAS = 19,      /* symbols of the code that codes code lengths */
    DEFLATE_MAX_BITS = 15,
    DEFLATE_META_BITS = 7,
    DEFLATE_WINDOW = 32768,
    DEFLATE_MIN_MATCH = 3,
    DEFLATE_MAX_MATCH = 258
};

/* A length or distance symbol covers base .. base + 2^extra - 1. */
typedef struct deflate_span {
    uint32_t base, extra;
} deflate_span;

/* Lengths 3..257 form a small float format with two mantissa bits; 258 has a separate symbol. `i` is 0 .. 28. */
static inline deflate_span deflate_length_span(uint32_t i)
{
    deflate_span s = {DEFLATE_MAX_MATCH, 0};
    if (i == 28) return s;
    s.extra = i < 8 ? 0 : i / 4 - 1;
    s.base = DEFLATE_MIN_MATCH + (i < 8 ? i : (4 + i % 4) << s.extra);
    return s;
}

/* Distances likewise, with one mantissa bit. `i` is 0 .. 29. */
static inline deflate_span deflate_dist_span(uint32_t i)
{
    deflate_span s;
    s.extra = i < 4 ? 0 : i / 2 - 1;
    s.base = 1 + (i < 4 ? i : (2 + i % 2) << s.extra);
    return s;
}

/* Code lengths of the fixed literal/length code, RFC 1951 3.2.6. */
static inline uint8_t deflate_fixed_bits(uint32_t symbol)
{
    return symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8;
}

/* The order of the meta code lengths in a dynamic block. */
static inline uint32_t deflate_meta_order(uint32_t i)
{
    static const uint8_t order[DEFLATE_METAS] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    return order[i];
}

static inline uint32_t deflate_reverse(uint32_t code, uint32_t bits)
{
    uint32_t turned = 0;
    for (; bits > 0; --bits, code >>= 1) turned = turned << 1 | (code & 1u);
    return turned;
}

static inline uint32_t zlib_adler32(const uint8_t *data, size_t size)
{
    /* b grows by at most n * 65520 + 255 n (n + 1) / 2 over n bytes: 5000 of them stay under 2^32. */
    uint32_t a = 1, b = 0;
    size_t i = 0;
    while (i < size) {
        size_t stop = size - i > 5000 ? i + 5000 : size;
        for (; i < stop; ++i) {
            a += data[i];
            b += a;
        }
        a %= 65521u;
        b %= 65521u;
    }
    return b << 16 | a;
}

#endif
