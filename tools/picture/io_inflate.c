/* io_inflate.c: decodes zlib streams (RFC 1950, RFC 1951). Uses no memory except the caller's and 6 KiB of stack. */
#include "../common/io_bytes.h"
#include "image.h"
#include "io_deflate.h"

#include <string.h>

/* Codes up to QUICK_BITS are one table look-up; a longer one is found by comparing with the last code of each length.
 * A table for all 15 bits would let a file of tiny blocks cost 64 KiB of writes for each 20 bytes read. */
enum { QUICK_BITS = 10, NO_SYMBOL = 0xffff };

typedef struct decode_table {
    uint16_t quick[1 << QUICK_BITS];       /* symbol * 16 + bits; 0 if the code is longer, or invalid */
    uint32_t limit[DEFLATE_MAX_BITS + 1];  /* first 15-bit value above all codes of this length or shorter */
    uint16_t first[DEFLATE_MAX_BITS + 1];  /* start of this length in `symbol` */
    uint16_t symbol[DEFLATE_FIXED_LITLENS]; /* by length, then by value: the order of the codes */
} decode_table;

typedef struct inflater {
    const uint8_t *in;
    size_t in_size, in_pos;
    uint64_t hold;  /* the next `count` bits, lowest first; above them, bits that will be read again or zeros */
    uint32_t count;
    int bad;        /* set once, by the call that ran out of input */
    uint8_t *out;
    size_t out_size, out_pos;
    decode_table litlen, dist;
    int is_fixed; /* both hold the fixed codes: empty blocks of these take ten bits, too few to build them again */
} inflater;

/* After a refill at least 56 bits are there, or all that are left: enough for one length and distance, 48 bits. */
static void refill(inflater *s)
{
    if (s->in_size - s->in_pos >= 8) {
        const uint8_t *p = s->in + s->in_pos;
        uint32_t taken = (63u - s->count) / 8;
        s->hold |= ((uint64_t)get_u32_le(p + 4) << 32 | get_u32_le(p)) << s->count;
        s->in_pos += taken;
        s->count += 8 * taken;
        return;
    }
    while (s->count <= 56 && s->in_pos < s->in_size) {
        s->hold |= (uint64_t)s->in[s->in_pos++] << s->count;
        s->count += 8;
    }
}

/* The next `bits` <= 15 bits, which a refill has made ready. */
static uint32_t take_ready(inflater *s, uint32_t bits)
{
    uint32_t value = (uint32_t)s->hold & ((1u << bits) - 1u);
    if (bits > s->count) {
        s->bad = 1;
        return 0;
    }
    s->hold >>= bits;
    s->count -= bits;
    return value;
}

static uint32_t take(inflater *s, uint32_t bits)
{
    refill(s);
    return take_ready(s, bits);
}

/* Decodes one symbol from bits that a refill prepared; NO_SYMBOL, with bad set, if no code fits. */
static uint32_t take_symbol(inflater *s, const decode_table *t)
{
    uint32_t entry = t->quick[s->hold & ((1u << QUICK_BITS) - 1u)], bits, code;
    if (entry) {
        take_ready(s, entry & 15u);
        return s->bad ? NO_SYMBOL : entry >> 4;
    }
    code = deflate_reverse((uint32_t)s->hold & 0x7fffu, DEFLATE_MAX_BITS);
    for (bits = QUICK_BITS + 1; bits <= DEFLATE_MAX_BITS; ++bits) {
        if (code < t->limit[bits]) {
            uint32_t above = (code - t->limit[bits - 1]) >> (DEFLATE_MAX_BITS - bits);
            take_ready(s, bits);
            return s->bad ? NO_SYMBOL : t->symbol[t->first[bits] + above];
        }
    }
    s->bad = 1;
    return NO_SYMBOL;
}

static void fill_quick(decode_table *t, uint32_t symbol, uint32_t code, uint32_t bits)
{
    uint32_t at = deflate_reverse(code, bits);
    for (; at < 1u << QUICK_BITS; at += 1u << bits) t->quick[at] = (uint16_t)(symbol << 4 | bits);
}

/* Code lengths must fill the code space exactly. RFC 1951 excepts distances with a single code of one bit, or none.
 * Allowing that for every code is harmless: bits without a code make the stream bad when they are met. */
static int lengths_fill(const uint16_t used[DEFLATE_MAX_BITS + 1])
{
    uint32_t bits, space = 0, codes = 0;
    for (bits = 1; bits <= DEFLATE_MAX_BITS; ++bits) {
        space += (uint32_t)used[bits] << (DEFLATE_MAX_BITS - bits);
        codes += used[bits];
    }
    return space == 1u << DEFLATE_MAX_BITS || codes == 0 || (codes == 1 && used[1] == 1);
}

static int build_table(decode_table *t, const uint8_t *lengths, uint32_t n)
{
    uint16_t used[DEFLATE_MAX_BITS + 1] = {0}, next[DEFLATE_MAX_BITS + 1];
    uint32_t code[DEFLATE_MAX_BITS + 1], i, bits;

    for (i = 0; i < n; ++i) ++used[lengths[i]];
    if (!lengths_fill(used)) return 0;
    memset(t->quick, 0, sizeof t->quick);
    t->limit[0] = 0;
    t->first[0] = next[0] = 0;
    used[0] = 0;
    for (bits = 1; bits <= DEFLATE_MAX_BITS; ++bits) {
        t->first[bits] = next[bits] = (uint16_t)(t->first[bits - 1] + used[bits - 1]);
        code[bits] = t->limit[bits - 1] >> (DEFLATE_MAX_BITS - bits);
        t->limit[bits] = t->limit[bits - 1] + ((uint32_t)used[bits] << (DEFLATE_MAX_BITS - bits));
    }
    for (i = 0; i < n; ++i) {
        bits = lengths[i];
        if (!bits) continue;
        t->symbol[next[bits]++] = (uint16_t)i;
        if (bits <= QUICK_BITS) fill_quick(t, i, code[bits]++, bits);
    }
    return 1;
}

static int fixed_tables(inflater *s)
{
    uint8_t lengths[DEFLATE_FIXED_LITLENS];
    uint32_t i;
    if (s->is_fixed) return 1;
    s->is_fixed = 1;
    for (i = 0; i < DEFLATE_FIXED_LITLENS; ++i) lengths[i] = deflate_fixed_bits(i);
    if (!build_table(&s->litlen, lengths, DEFLATE_FIXED_LITLENS)) return 0;
    memset(lengths, 5, 32); /* 32 codes fill the space; the last two must not occur */
    return build_table(&s->dist, lengths, 32);
}

/* The lengths of both codes, run-length coded by a third. */
static int read_lengths(inflater *s, uint8_t *lengths, uint32_t n)
{
    uint32_t i = 0;
    while (i < n) {
        uint32_t symbol, run = 1;
        uint8_t value;
        refill(s);
        symbol = take_symbol(s, &s->dist);
        if (symbol == 16) run = 3 + take_ready(s, 2);
        if (symbol == 17) run = 3 + take_ready(s, 3);
        if (symbol == 18) run = 11 + take_ready(s, 7);
        if (s->bad || run > n - i || (symbol == 16 && i == 0)) return 0;
        value = symbol < 16 ? (uint8_t)symbol : symbol == 16 ? lengths[i - 1] : 0;
        memset(lengths + i, value, run);
        i += run;
    }
    return 1;
}

/* A missing end symbol is not checked: such a block reaches the end of the input or of the output. */
static int dynamic_tables(inflater *s)
{
    uint8_t lengths[DEFLATE_FIXED_LITLENS + 32] = {0};
    uint32_t litlens = 257 + take(s, 5), dists = 1 + take(s, 5), metas = 4 + take(s, 4), i;

    s->is_fixed = 0;
    if (s->bad || litlens > DEFLATE_LITLENS || dists > DEFLATE_DISTS) return 0;
    for (i = 0; i < metas; ++i) lengths[deflate_meta_order(i)] = (uint8_t)take(s, 3);
    if (s->bad || !build_table(&s->dist, lengths, DEFLATE_METAS)) return 0; /* used here until it is read itself */
    if (!read_lengths(s, lengths, litlens + dists)) return 0;
    return build_table(&s->litlen, lengths, litlens) && build_table(&s->dist, lengths + litlens, dists);
}

static int stored_block(inflater *s)
{
    const uint8_t *p;
    uint32_t size;

    s->in_pos -= s->count / 8; /* whole bytes go back, the rest of a begun one is dropped */
    s->hold = 0;
    s->count = 0;
    if (s->in_size - s->in_pos < 4) return 0;
    p = s->in + s->in_pos;
    size = p[0] | (uint32_t)p[1] << 8;
    if ((p[2] | (uint32_t)p[3] << 8) != (size ^ 0xffffu)) return 0;
    s->in_pos += 4;
    if (size > s->in_size - s->in_pos || size > s->out_size - s->out_pos) return 0;
    if (size > 0) memcpy(s->out + s->out_pos, s->in + s->in_pos, size);
    s->in_pos += size;
    s->out_pos += size;
    return 1;
}

/* The distance half of a match, after its length symbol was read. */
static int copy_match(inflater *s, uint32_t length_symbol)
{
    deflate_span span = deflate_length_span(length_symbol - DEFLATE_LENGTH_0);
    uint32_t length = span.base + take_ready(s, span.extra), symbol = take_symbol(s, &s->dist), distance, i;
    uint8_t *to;
    const uint8_t *from;

    if (s->bad || symbol >= DEFLATE_DISTS) return 0;
    span = deflate_dist_span(symbol);
    distance = span.base + take_ready(s, span.extra);
    if (s->bad || distance > s->out_pos || length > s->out_size - s->out_pos) return 0;
    to = s->out + s->out_pos;
    from = to - distance;
    if (distance >= length) {
        memcpy(to, from, length);
    } else if (distance == 1) {
        memset(to, *from, length);
    } else {
        for (i = 0; i < length; ++i) to[i] = from[i]; /* overlapping: the run repeats itself */
    }
    s->out_pos += length;
    return 1;
}

static int coded_block(inflater *s)
{
    for (;;) {
        uint32_t symbol;
        refill(s);
        symbol = take_symbol(s, &s->litlen);
        if (s->bad) return 0;
        if (symbol < DEFLATE_END) {
            if (s->out_pos == s->out_size) return 0;
            s->out[s->out_pos++] = (uint8_t)symbol;
        } else if (symbol == DEFLATE_END) {
            return 1;
        } else if (symbol >= DEFLATE_LITLENS || !copy_match(s, symbol)) {
            return 0;
        }
    }
}

static int read_block(inflater *s, uint32_t type)
{
    switch (type) {
    case DEFLATE_STORED: return stored_block(s);
    case DEFLATE_FIXED: return fixed_tables(s) && coded_block(s);
    case DEFLATE_DYNAMIC: return dynamic_tables(s) && coded_block(s);
    default: return 0;
    }
}

/* Two bytes: method 8, window at most 32 KiB, no preset dictionary, and a multiple of 31. */
static int zlib_header_fits(const uint8_t *in)
{
    return (in[0] & 15) == 8 && in[0] >> 4 <= 7 && (in[1] & 32) == 0 && (in[0] * 256 + in[1]) % 31 == 0;
}

int inflate_zlib(uint8_t *out, size_t out_size, const uint8_t *in, size_t in_size)
{
    inflater s;
    uint32_t last;

    if (in_size < 6 || !zlib_header_fits(in)) return 0;
    memset(&s, 0, sizeof s);
    s.in = in;
    s.in_size = in_size - 4;
    s.in_pos = 2;
    s.out = out;
    s.out_size = out_size;
    do {
        last = take(&s, 1);
        if (!read_block(&s, take(&s, 2)) || s.bad) return 0;
    } while (!last);
    if (s.in_pos - s.count / 8 != s.in_size || s.out_pos != out_size) return 0;
    return get_u32_be(in + s.in_size) == zlib_adler32(out, out_size);
}
