/* mutate.c: seeded damage to a file's bytes. */
#include "mutate.h"

#include <string.h>

#include "../../tools/common/io_bytes.h"
#include "../test.h"

typedef struct patient {
    uint8_t *data;
    size_t size, cap;
    test_rng rng;
} patient;

/* 0 .. n - 1; files are under 4 GiB. */
static size_t below(patient *p, size_t n) { return test_random(&p->rng) % (n < UINT32_MAX ? n : UINT32_MAX); }

/* Half of the positions are uniform; the others are uniform over powers of two, because headers come first. */
static size_t place(patient *p)
{
    size_t within = p->size;
    if (test_random(&p->rng) % 2 == 0) {
        within >>= below(p, 20);
    }
    return below(p, within > 0 ? within : 1);
}

/* Pieces are short, or a large part of the file. */
static size_t piece(patient *p, size_t at)
{
    size_t max = p->size - at, n = 1 + below(p, test_random(&p->rng) % 4 == 0 ? max : 16);
    return n < max ? n : max;
}

static void flip_bit(patient *p)
{
    size_t at = place(p);
    p->data[at] ^= (uint8_t)(1u << below(p, 8));
}

static void set_byte(patient *p)
{
    static const uint8_t telling[] = {0, 255, 0x7F, 0x80, 1, ' ', '\n', '"'};
    size_t at = place(p), pick = below(p, 2 * sizeof telling);
    p->data[at] = pick < sizeof telling ? telling[pick] : (uint8_t)test_random(&p->rng);
}

/* Half of the words are aligned, as words of binary formats mostly are. 0x7FC00000 is a NaN. */
static void set_word(patient *p)
{
    static const uint32_t telling[] = {0x80000000u, 0xFFFFFFFFu, 0, 0x7FFFFFFFu, 0x7FC00000u, 0x10000000u, 0xFFFFu, 1};
    size_t at = place(p);
    uint32_t value = telling[below(p, sizeof telling / sizeof telling[0])];
    if (test_random(&p->rng) % 2 == 0) {
        at -= at % 4;
    }
    if (p->size < 4 || at > p->size - 4) {
        return;
    }
    (test_random(&p->rng) % 4 == 0 ? put_u32_be : put_u32_le)(p->data + at, value);
}

static void cut_piece(patient *p)
{
    size_t at = place(p), n = piece(p, at);
    if (n == p->size) {
        return;
    }
    memmove(p->data + at, p->data + at + n, p->size - at - n);
    p->size -= n;
}

/* Makes room for n bytes at `at`; returns 0 if there is none. */
static int open_gap(patient *p, size_t at, size_t n)
{
    if (n > p->cap - p->size) {
        return 0;
    }
    memmove(p->data + at + n, p->data + at, p->size - at);
    p->size += n;
    return 1;
}

/* Copies a piece in front of itself, or over bytes elsewhere. */
static void copy_piece(patient *p)
{
    size_t from = place(p), n = piece(p, from), to = place(p);
    if (test_random(&p->rng) % 2 == 0 && open_gap(p, from, n)) {
        memcpy(p->data + from, p->data + from + n, n);
    } else {
        memmove(p->data + to, p->data + from, n < p->size - to ? n : p->size - to);
    }
}

/* Changes the next number of a text: one digit, or the whole to an unusual number. */
static void change_number(patient *p)
{
    static const char *const odd[] = {"-", ".", "e", "e99", "2147483648", "4294967295", "99999999999999999999", "nan"};
    size_t at = place(p), end = p->size - at > 4096 ? at + 4096 : p->size, n;
    const char *text = odd[below(p, sizeof odd / sizeof odd[0])];
    while (at < end && (p->data[at] < '0' || p->data[at] > '9')) {
        ++at;
    }
    if (at == end) {
        return;
    }
    if (test_random(&p->rng) % 2 == 0) {
        p->data[at] = (uint8_t)('0' + below(p, 10));
        return;
    }
    n = strlen(text);
    if (open_gap(p, at, n)) {
        memcpy(p->data + at, text, n);
    }
}

size_t mutate(uint8_t *data, size_t size, size_t cap, uint64_t seed)
{
    static void (*const ways[])(patient *p) = {flip_bit,   set_byte,      set_byte,     set_word,
                                               cut_piece, copy_piece, change_number, change_number};
    patient p = {data, size, cap, {seed * UINT64_C(0x9E3779B97F4A7C15)}};
    test_random(&p.rng); /* the first number of a small state is not random enough */
    for (size_t left = 1 + below(&p, 1 + below(&p, 8)) * below(&p, 2); left > 0 && p.size > 0; --left) {
        ways[below(&p, sizeof ways / sizeof ways[0])](&p);
    }
    return p.size;
}
