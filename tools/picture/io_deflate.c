/* io_deflate.c: bytes into a zlib stream (RFC 1950, RFC 1951): matches found by hash chains, dynamic Huffman codes. */
#include "../common/io_bytes.h"
#include "image.h"
#include "io_deflate.h"

#include <stdlib.h>
#include <string.h>

enum {
    HASH_BITS = 15,
    BLOCK_TOKENS = 16384, /* long enough to pay for a block's header, short enough to follow the picture */
    CHAIN_TRIES = 128,    /* candidates tried for one match */
    POOR_TRIES = 8,       /* tries if the block before had few matches, like a photo's noise: half the time for 1.5 % */
    QUICK_TRIES = 2,      /* if time matters more than size */
    POOR_TOKEN = 3,       /* bytes per token, below which a block had few matches */
    GOOD_MATCH = 8,       /* with a match this long, only a quarter of the tries */
    LAZY_MATCH = 16,      /* shorter ones wait: the next byte may start a longer one */
    NICE_MATCH = 128,     /* long enough to stop looking */
    NEAR_3 = 4096,        /* a match of three further away costs more than three literals */
    STORED_MAX = 65535
};

/* Output bytes; grown before each block by the size that was counted for the block. */
typedef struct bit_writer {
    uint8_t *data;
    size_t size, cap;
    uint64_t hold;
    uint32_t count;
} bit_writer;

typedef struct code_table {
    uint8_t bits[DEFLATE_FIXED_LITLENS];
    uint16_t code[DEFLATE_FIXED_LITLENS]; /* reversed, as it is written */
} code_table;

/* A dynamic block's header: both codes' lengths as one list, run-length coded in meta symbols. */
typedef struct block_header {
    uint32_t litlens, dists, metas, run_count;
    uint8_t run_symbol[DEFLATE_LITLENS + DEFLATE_DISTS], run_extra[DEFLATE_LITLENS + DEFLATE_DISTS];
    code_table meta;
} block_header;

/* Positions are kept modulo 2^32: a stale one only costs a comparison, since each candidate's bytes are compared. */
typedef struct deflater {
    const uint8_t *in;
    size_t size;
    size_t inserted;    /* positions below are in the chains */
    size_t block_start; /* first byte of the open block */
    size_t covered;     /* first byte that no token holds yet */
    uint32_t head[1 << HASH_BITS], prev[DEFLATE_WINDOW];
    uint32_t tokens[BLOCK_TOKENS]; /* distance * 512 + length, or only a literal */
    uint32_t token_count;
    uint32_t litlen_freq[DEFLATE_LITLENS], dist_freq[DEFLATE_DISTS];
    uint64_t extra_bits; /* that the open block's lengths and distances carry */
    code_table litlen, dist;
    block_header header;
    bit_writer w;
    int tries, most_tries;
    int failed; /* memory was short */
} deflater;

typedef struct match {
    uint32_t length, distance; /* length 0: none */
} match;

/* --- bits --- */

static int reserve(bit_writer *w, uint64_t more)
{
    size_t cap;
    uint8_t *grown;
    if (more <= w->cap - w->size) return 1;
    if (w->cap > SIZE_MAX / 4 || more > SIZE_MAX / 4) return 0; /* so that the sum below cannot wrap */
    cap = w->size + (size_t)more + w->cap / 2;
    grown = realloc(w->data, cap);
    if (!grown) return 0;
    w->data = grown;
    w->cap = cap;
    return 1;
}

static void put(bit_writer *w, uint32_t value, uint32_t bits)
{
    w->hold |= (uint64_t)value << w->count;
    w->count += bits;
    while (w->count >= 8) {
        w->data[w->size++] = (uint8_t)w->hold;
        w->hold >>= 8;
        w->count -= 8;
    }
}

static void put_to_byte(bit_writer *w)
{
    if (w->count > 0) put(w, 0, 8 - w->count);
}

/* --- codes --- */

static uint32_t floor_log2(uint32_t v)
{
    uint32_t n = 0;
    while (v >>= 1) ++n;
    return n;
}

/* The inverse of deflate_length_span: index of the length symbol. */
static uint32_t length_index(uint32_t length)
{
    uint32_t v = length - DEFLATE_MIN_MATCH, shift;
    if (v < 8) return v;
    if (length == DEFLATE_MAX_MATCH) return 28;
    shift = floor_log2(v) - 2;
    return 4 * shift + (v >> shift);
}

static uint32_t dist_index(uint32_t distance)
{
    uint32_t v = distance - 1, shift;
    if (v < 4) return v;
    shift = floor_log2(v) - 1;
    return 2 * shift + (v >> shift);
}

static int compare_u32(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* The used symbols from rare to frequent, as frequency * 512 + symbol; at least two, so that codes are complete. */
static uint32_t sort_symbols(uint32_t *sorted, const uint32_t *freq, uint32_t n)
{
    uint32_t i, used = 0;
    for (i = 0; i < n; ++i) {
        if (freq[i]) sorted[used++] = freq[i] << 9 | i;
    }
    for (i = 0; i < n && used < 2; ++i) {
        if (!freq[i]) sorted[used++] = i;
    }
    qsort(sorted, used, sizeof *sorted, compare_u32);
    return used;
}

/* Lengths of the best prefix code with no word longer than max_bits: package-merge (Larmore and Hirschberg 1990).
 * Level k's list holds the n leaves merged with the pairs of level k - 1's list. The 2n - 2 lightest items of the
 * last level, with pairs expanded, contain each symbol once per bit of the code. Only "leaf or pair" needs storing:
 * the leaves among the first items of a list are always the lightest ones. n <= 2^max_bits. */
static void limited_lengths(uint8_t *bits, const uint32_t *freq, uint32_t symbols, uint32_t max_bits)
{
    uint32_t sorted[DEFLATE_LITLENS], weight[2][2 * DEFLATE_LITLENS];
    uint8_t is_leaf[DEFLATE_MAX_BITS][2 * DEFLATE_LITLENS];
    uint32_t n = sort_symbols(sorted, freq, symbols), below_count = 0, level, need, i;

    for (level = 0; level < max_bits; ++level) {
        const uint32_t *below = weight[(level + 1) & 1];
        uint32_t *here = weight[level & 1], leaf = 0, pair = 0, count = 0;
        while (leaf < n || 2 * pair + 1 < below_count) {
            uint32_t pair_weight = 2 * pair + 1 < below_count ? below[2 * pair] + below[2 * pair + 1] : UINT32_MAX;
            int leaf_next = leaf < n && sorted[leaf] >> 9 <= pair_weight;
            is_leaf[level][count] = (uint8_t)leaf_next;
            here[count++] = leaf_next ? sorted[leaf++] >> 9 : pair_weight;
            if (!leaf_next) ++pair;
        }
        below_count = count;
    }
    memset(bits, 0, symbols);
    for (need = 2 * n - 2; level-- > 0;) {
        uint32_t leaves = 0;
        for (i = 0; i < need; ++i) leaves += is_leaf[level][i];
        for (i = 0; i < leaves; ++i) ++bits[sorted[i] & 511u];
        need = 2 * (need - leaves);
    }
}

/* Canonical code words from lengths: by length, then by symbol. */
static void assign_codes(code_table *t, uint32_t n)
{
    uint32_t bits, i, code = 0;
    for (bits = 1; bits <= DEFLATE_MAX_BITS; ++bits, code <<= 1) {
        for (i = 0; i < n; ++i) {
            if (t->bits[i] == bits) t->code[i] = (uint16_t)deflate_reverse(code++, bits);
        }
    }
}

static void fixed_codes(deflater *d)
{
    uint32_t i;
    for (i = 0; i < DEFLATE_FIXED_LITLENS; ++i) d->litlen.bits[i] = deflate_fixed_bits(i);
    assign_codes(&d->litlen, DEFLATE_FIXED_LITLENS);
    memset(d->dist.bits, 5, DEFLATE_DISTS);
    assign_codes(&d->dist, DEFLATE_DISTS);
}

/* --- a dynamic block's header --- */

static uint32_t run_extra_bits(uint32_t symbol)
{
    return symbol == 16 ? 2 : symbol == 17 ? 3 : symbol == 18 ? 7 : 0;
}

static void add_run(block_header *h, uint32_t symbol, uint32_t extra, uint32_t *freq)
{
    h->run_symbol[h->run_count] = (uint8_t)symbol;
    h->run_extra[h->run_count++] = (uint8_t)extra;
    ++freq[symbol];
}

/* One stretch of `n` equal lengths. Zeros: 18 takes 11..138, 17 takes 3..10. Others: once as is, then 16 for 3..6. */
static void code_stretch(block_header *h, uint32_t value, uint32_t n, uint32_t *freq)
{
    uint32_t max = value ? 6 : 138;
    if (value) {
        add_run(h, value, 0, freq);
        --n;
    }
    while (n >= 3) {
        uint32_t run = n < max ? n : max;
        if (value) add_run(h, 16, run - 3, freq);
        else if (run < 11) add_run(h, 17, run - 3, freq);
        else add_run(h, 18, run - 11, freq);
        n -= run;
    }
    for (; n > 0; --n) add_run(h, value, 0, freq);
}

static void plan_header(block_header *h, const code_table *litlen, const code_table *dist)
{
    uint8_t all[DEFLATE_LITLENS + DEFLATE_DISTS];
    uint32_t freq[DEFLATE_METAS] = {0}, i, end, n;

    for (h->litlens = DEFLATE_LITLENS; h->litlens > 257 && !litlen->bits[h->litlens - 1];) --h->litlens;
    for (h->dists = DEFLATE_DISTS; h->dists > 1 && !dist->bits[h->dists - 1];) --h->dists;
    memcpy(all, litlen->bits, h->litlens);
    memcpy(all + h->litlens, dist->bits, h->dists);
    n = h->litlens + h->dists;
    h->run_count = 0;
    for (i = 0; i < n; i = end) {
        for (end = i + 1; end < n && all[end] == all[i];) ++end;
        code_stretch(h, all[i], end - i, freq);
    }
    limited_lengths(h->meta.bits, freq, DEFLATE_METAS, DEFLATE_META_BITS);
    assign_codes(&h->meta, DEFLATE_METAS);
    for (h->metas = DEFLATE_METAS; h->metas > 4 && !h->meta.bits[deflate_meta_order(h->metas - 1)];) --h->metas;
}

static uint32_t header_bits(const block_header *h)
{
    uint32_t i, total = 5 + 5 + 4 + 3 * h->metas;
    for (i = 0; i < h->run_count; ++i) total += h->meta.bits[h->run_symbol[i]] + run_extra_bits(h->run_symbol[i]);
    return total;
}

static void put_header(bit_writer *w, const block_header *h)
{
    uint32_t i;
    put(w, h->litlens - 257, 5);
    put(w, h->dists - 1, 5);
    put(w, h->metas - 4, 4);
    for (i = 0; i < h->metas; ++i) put(w, h->meta.bits[deflate_meta_order(i)], 3);
    for (i = 0; i < h->run_count; ++i) {
        uint32_t symbol = h->run_symbol[i];
        put(w, h->meta.code[symbol], h->meta.bits[symbol]);
        put(w, h->run_extra[i], run_extra_bits(symbol));
    }
}

/* --- blocks --- */

static uint64_t body_bits(const deflater *d)
{
    uint64_t total = d->extra_bits;
    uint32_t i;
    for (i = 0; i < DEFLATE_LITLENS; ++i) total += (uint64_t)d->litlen_freq[i] * d->litlen.bits[i];
    for (i = 0; i < DEFLATE_DISTS; ++i) total += (uint64_t)d->dist_freq[i] * d->dist.bits[i];
    return total;
}

static void put_match(deflater *d, uint32_t length, uint32_t distance)
{
    uint32_t at = length_index(length), symbol = DEFLATE_LENGTH_0 + at;
    deflate_span span = deflate_length_span(at);
    put(&d->w, d->litlen.code[symbol], d->litlen.bits[symbol]);
    put(&d->w, length - span.base, span.extra);
    at = dist_index(distance);
    span = deflate_dist_span(at);
    put(&d->w, d->dist.code[at], d->dist.bits[at]);
    put(&d->w, distance - span.base, span.extra);
}

static void put_tokens(deflater *d)
{
    uint32_t i;
    for (i = 0; i < d->token_count; ++i) {
        uint32_t token = d->tokens[i];
        if (token >> 9) put_match(d, token & 511u, token >> 9);
        else put(&d->w, d->litlen.code[token], d->litlen.bits[token]);
    }
    put(&d->w, d->litlen.code[DEFLATE_END], d->litlen.bits[DEFLATE_END]);
}

static void put_stored(deflater *d, uint32_t last)
{
    size_t at = d->block_start;
    do {
        size_t left = d->covered - at;
        uint32_t n = left < STORED_MAX ? (uint32_t)left : STORED_MAX;
        put(&d->w, last && n == left, 1);
        put(&d->w, DEFLATE_STORED, 2);
        put_to_byte(&d->w);
        put(&d->w, n, 16);
        put(&d->w, n ^ 0xffffu, 16);
        if (n > 0) memcpy(d->w.data + d->w.size, d->in + at, n);
        d->w.size += n;
        at += n;
    } while (at < d->covered);
}

static void put_coded(deflater *d, uint32_t last, uint32_t type)
{
    put(&d->w, last, 1);
    put(&d->w, type, 2);
    if (type == DEFLATE_DYNAMIC) put_header(&d->w, &d->header);
    put_tokens(d);
}

static void open_block(deflater *d)
{
    d->block_start = d->covered;
    d->token_count = 0;
    d->extra_bits = 0;
    memset(d->litlen_freq, 0, sizeof d->litlen_freq);
    memset(d->dist_freq, 0, sizeof d->dist_freq);
}

/* Write the open block in the cheapest of the three ways. */
static void close_block(deflater *d, uint32_t last)
{
    uint64_t raw = d->covered - d->block_start;
    uint64_t stored = 8 * raw + 40 * (raw / STORED_MAX + 1), fixed, dynamic, best; /* at most 5 bytes a piece */

    d->tries = raw < POOR_TOKEN * (uint64_t)d->token_count ? POOR_TRIES : CHAIN_TRIES;
    d->tries = d->tries < d->most_tries ? d->tries : d->most_tries;
    ++d->litlen_freq[DEFLATE_END];
    fixed_codes(d);
    fixed = 3 + body_bits(d);
    limited_lengths(d->litlen.bits, d->litlen_freq, DEFLATE_LITLENS, DEFLATE_MAX_BITS);
    limited_lengths(d->dist.bits, d->dist_freq, DEFLATE_DISTS, DEFLATE_MAX_BITS);
    plan_header(&d->header, &d->litlen, &d->dist);
    dynamic = 3 + header_bits(&d->header) + body_bits(d);
    best = fixed < dynamic ? fixed : dynamic;
    if (stored < best) best = stored;
    if (d->failed || !reserve(&d->w, best / 8 + 8)) { /* 7 bits held, one byte begun, the last pad */
        d->failed = 1;
    } else if (best == stored) {
        put_stored(d, last);
    } else if (best == fixed) {
        fixed_codes(d);
        put_coded(d, last, DEFLATE_FIXED);
    } else {
        assign_codes(&d->litlen, DEFLATE_LITLENS);
        assign_codes(&d->dist, DEFLATE_DISTS);
        put_coded(d, last, DEFLATE_DYNAMIC);
    }
    open_block(d);
}

/* --- matches --- */

static void add_literal(deflater *d)
{
    uint8_t byte = d->in[d->covered++];
    d->tokens[d->token_count++] = byte;
    ++d->litlen_freq[byte];
    if (d->token_count == BLOCK_TOKENS) close_block(d, 0);
}

static void add_match(deflater *d, match m)
{
    uint32_t length_at = length_index(m.length), dist_at = dist_index(m.distance);
    d->tokens[d->token_count++] = m.distance << 9 | m.length;
    ++d->litlen_freq[DEFLATE_LENGTH_0 + length_at];
    ++d->dist_freq[dist_at];
    d->extra_bits += deflate_length_span(length_at).extra + deflate_dist_span(dist_at).extra;
    d->covered += m.length;
    if (d->token_count == BLOCK_TOKENS) close_block(d, 0);
}

/* Of the three bytes at p; the multiplier is 2^32 over the golden ratio. */
static uint32_t hash3(const uint8_t *p)
{
    uint32_t v = p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
    return (v * 2654435761u) >> (32 - HASH_BITS);
}

/* Put all positions below `end` into the chains. */
static void insert_below(deflater *d, size_t end)
{
    if (d->size < DEFLATE_MIN_MATCH) return;
    if (end > d->size - (DEFLATE_MIN_MATCH - 1)) end = d->size - (DEFLATE_MIN_MATCH - 1);
    for (; d->inserted < end; ++d->inserted) {
        uint32_t *head = &d->head[hash3(d->in + d->inserted)];
        d->prev[d->inserted % DEFLATE_WINDOW] = *head;
        *head = (uint32_t)d->inserted;
    }
}

static uint32_t common_length(const uint8_t *a, const uint8_t *b, uint32_t max)
{
    uint32_t n = 0;
    while (max - n >= 8 && memcmp(a + n, b + n, 8) == 0) n += 8;
    while (n < max && a[n] == b[n]) ++n;
    return n;
}

/* The longest match at `pos` of more than `best` >= 2 bytes; of equally long ones the nearest. */
static match longest_match(deflater *d, size_t pos, uint32_t best)
{
    const uint8_t *here = d->in + pos;
    uint32_t max = d->size - pos < DEFLATE_MAX_MATCH ? (uint32_t)(d->size - pos) : DEFLATE_MAX_MATCH;
    uint32_t reach = pos < DEFLATE_WINDOW ? (uint32_t)pos : DEFLATE_WINDOW, before = 0, distance;
    int tries = best >= GOOD_MATCH ? d->tries / 4 : d->tries;
    match m = {0, 0};

    if (max <= best) return m;
    insert_below(d, pos);
    distance = (uint32_t)pos - d->head[hash3(here)];
    while (tries-- > 0 && distance > before && distance <= reach) { /* a live chain leads ever further back */
        const uint8_t *there = here - distance;
        if (there[best] == here[best]) {
            uint32_t length = common_length(here, there, max);
            if (length > best && !(length == DEFLATE_MIN_MATCH && distance > NEAR_3)) {
                m.length = best = length;
                m.distance = distance;
                if (length >= NICE_MATCH || length == max) break;
            }
        }
        before = distance;
        distance = (uint32_t)pos - d->prev[(pos - distance) % DEFLATE_WINDOW];
    }
    return m;
}

static void find_tokens(deflater *d)
{
    while (d->covered < d->size && !d->failed) {
        match m = longest_match(d, d->covered, DEFLATE_MIN_MATCH - 1);
        while (m.length > 0 && m.length < LAZY_MATCH) { /* ends: each turn finds a longer one */
            match next = longest_match(d, d->covered + 1, m.length);
            if (!next.length) break;
            add_literal(d);
            m = next;
        }
        if (m.length) add_match(d, m);
        else add_literal(d);
    }
}

static int deflate_by(uint8_t **out, size_t *out_size, const uint8_t *in, size_t in_size, int most_tries)
{
    deflater *d = calloc(1, sizeof *d);
    uint8_t *data = NULL;

    *out = NULL;
    *out_size = 0;
    if (!d) return 0;
    d->in = in;
    d->size = in_size;
    d->tries = d->most_tries = most_tries;
    if (reserve(&d->w, 2 + in_size / 4 + 64)) {
        put(&d->w, 0x78, 8); /* deflate, 32 KiB window */
        put(&d->w, 0x9c, 8); /* default effort; makes the pair a multiple of 31 */
        find_tokens(d);
        close_block(d, 1);
        put_to_byte(&d->w);
        if (!d->failed && reserve(&d->w, 4)) {
            put_u32_be(d->w.data + d->w.size, zlib_adler32(in, in_size));
            *out_size = d->w.size + 4;
            data = realloc(d->w.data, *out_size);
            *out = data ? data : d->w.data;
            d->w.data = NULL;
        }
    }
    free(d->w.data);
    free(d);
    return *out != NULL;
}

int deflate_zlib(uint8_t **out, size_t *out_size, const uint8_t *in, size_t in_size)
{
    return deflate_by(out, out_size, in, in_size, CHAIN_TRIES);
}

int deflate_zlib_quick(uint8_t **out, size_t *out_size, const uint8_t *in, size_t in_size)
{
    return deflate_by(out, out_size, in, in_size, QUICK_TRIES);
}
