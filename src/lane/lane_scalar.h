/* lane_scalar.h: the lane verbs in plain C; the definition that every other backend equals. Layer 2.
 *
 * lane     LANES floats               lane_mask  all ones or all zeros per lane
 * lanei    LANES int32                 laned      LANES doubles
 * min and max are SSE's rule: min(a, b) is a < b ? a : b, so a NaN in either operand gives b. */
#ifndef LMB_LANE_SCALAR_H
#define LMB_LANE_SCALAR_H

#include "../base/vec.h"

#include <string.h>

#include "backends.h"

/* 1 if a file defines LANE_ONE, to run a kernel's formula for a single value. */
#if defined(LANE_ONE)
#define LANES 1
#else
#define LANES LMB_PLAIN_LANES
#endif
/* Masks are not instructions here: if no lane needs the work, a branch around it is faster. */
#define LANE_PLAIN 1

#if LANES == 1
#define EACH(...) \
    do { \
        enum { i = 0 }; \
        __VA_ARGS__; \
    } while (0)
#else
/* Unrolled: gcc keeps a struct in registers only if it accesses the members with constant indices. */
#define EACH(...) \
    do { \
        { enum { i = 0 }; __VA_ARGS__; } \
        { enum { i = 1 }; __VA_ARGS__; } \
        { enum { i = 2 }; __VA_ARGS__; } \
        { enum { i = 3 }; __VA_ARGS__; } \
    } while (0)
#endif

typedef struct lane {
    float v[LANES];
} lane;
typedef struct lanei {
    int32_t v[LANES];
} lanei;
typedef struct laned {
    double v[LANES];
} laned;
typedef struct lane_mask {
    uint32_t v[LANES];
} lane_mask;

static inline lane lane_splat(float a) { lane r; EACH(r.v[i] = a); return r; }
static inline lane lane_load(const float *p) { lane r; EACH(r.v[i] = p[i]); return r; }
static inline void lane_store(float *p, lane a) { EACH(p[i] = a.v[i]); }
static inline lane lane_add(lane a, lane b) { EACH(a.v[i] = a.v[i] + b.v[i]); return a; }
static inline lane lane_sub(lane a, lane b) { EACH(a.v[i] = a.v[i] - b.v[i]); return a; }
static inline lane lane_mul(lane a, lane b) { EACH(a.v[i] = a.v[i] * b.v[i]); return a; }
static inline lane lane_div(lane a, lane b) { EACH(a.v[i] = a.v[i] / b.v[i]); return a; }
static inline lane lane_sqrt(lane a) { EACH(a.v[i] = sqrtf(a.v[i])); return a; }
static inline lane lane_min(lane a, lane b) { EACH(a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline lane lane_max(lane a, lane b) { EACH(a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i]); return a; }
/* lane_min(lane_max(a, low), high), but in full: gcc stops inlining those in large functions, and fills with ids took
 * up to 1.8 times as long. */
#if defined(__GNUC__) && !defined(__clang__) && LANES > 1
#define LANE_HAS_HOLD
static inline __attribute__((always_inline)) lane lane_hold(lane a, lane low, lane high)
{
    EACH(a.v[i] = a.v[i] > low.v[i] ? a.v[i] : low.v[i]);
    EACH(a.v[i] = a.v[i] < high.v[i] ? a.v[i] : high.v[i]);
    return a;
}
#endif
static inline lane_mask lane_lt(lane a, lane b) { lane_mask r; EACH(r.v[i] = a.v[i] < b.v[i] ? ~0u : 0u); return r; }
static inline lane_mask lane_le(lane a, lane b) { lane_mask r; EACH(r.v[i] = a.v[i] <= b.v[i] ? ~0u : 0u); return r; }
static inline lane lane_pick(lane_mask m, lane a, lane b) { EACH(a.v[i] = m.v[i] ? a.v[i] : b.v[i]); return a; }
static inline lane lane_keep(lane_mask m, lane a) { EACH(a.v[i] = m.v[i] ? a.v[i] : 0.0f); return a; }
static inline lane_mask mask_and(lane_mask a, lane_mask b) { EACH(a.v[i] &= b.v[i]); return a; }
static inline lane_mask mask_or(lane_mask a, lane_mask b) { EACH(a.v[i] |= b.v[i]); return a; }
static inline lane_mask mask_not(lane_mask a) { EACH(a.v[i] = ~a.v[i]); return a; }
/* Bit i is lane i; bits past LANES are 0, or ignored. */
static inline uint32_t mask_bits(lane_mask a) { uint32_t r = 0; EACH(r |= (a.v[i] & 1u) << i); return r; }
static inline lane_mask mask_of_bits(uint32_t b) { lane_mask r; EACH(r.v[i] = (b >> i) & 1u ? ~0u : 0u); return r; }

static inline lanei lanei_splat(int32_t a) { lanei r; EACH(r.v[i] = a); return r; }
static inline lanei lanei_load(const int32_t *p) { lanei r; EACH(r.v[i] = p[i]); return r; }
/* Sums and products wrap around, as in registers. */
static inline lanei lanei_add(lanei a, lanei b)
{
    EACH(a.v[i] = (int32_t)((uint32_t)a.v[i] + (uint32_t)b.v[i]));
    return a;
}
static inline lanei lanei_or(lanei a, lanei b) { EACH(a.v[i] = a.v[i] | b.v[i]); return a; }
static inline lanei lanei_and(lanei a, lanei b) { EACH(a.v[i] = a.v[i] & b.v[i]); return a; }
static inline lanei lanei_mul(lanei a, lanei b)
{
    EACH(a.v[i] = (int32_t)((uint32_t)a.v[i] * (uint32_t)b.v[i]));
    return a;
}
static inline lanei lanei_sub(lanei a, lanei b)
{
    EACH(a.v[i] = (int32_t)((uint32_t)a.v[i] - (uint32_t)b.v[i]));
    return a;
}
static inline lanei lanei_min(lanei a, lanei b) { EACH(a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline lanei lanei_max(lanei a, lanei b) { EACH(a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline lanei lanei_pick(lane_mask m, lanei a, lanei b) { EACH(a.v[i] = m.v[i] ? a.v[i] : b.v[i]); return a; }
static inline lane_mask lanei_lt(lanei a, lanei b) { lane_mask r; EACH(r.v[i] = a.v[i] < b.v[i] ? ~0u : 0u); return r; }
/* floor(a / 2^n). */
static inline lanei lanei_shift(lanei a, int n) { EACH(a.v[i] = a.v[i] >> n); return a; }
static inline lane_mask lanei_not_negative(lanei a) { lane_mask r; EACH(r.v[i] = a.v[i] >= 0 ? ~0u : 0u); return r; }
static inline lane_mask lanei_equal(lanei a, lanei b)
{
    lane_mask r;
    EACH(r.v[i] = a.v[i] == b.v[i] ? ~0u : 0u);
    return r;
}
/* Truncates; the caller clamps to the int32 range first. */
static inline lanei lane_to_int(lane a) { lanei r; EACH(r.v[i] = (int32_t)a.v[i]); return r; }
static inline lane lane_from_int(lanei a) { lane r; EACH(r.v[i] = (float)a.v[i]); return r; }
/* Toward zero, within the int32 range. */
static inline lane lane_trunc(lane a) { EACH(a.v[i] = (float)(int32_t)a.v[i]); return a; }
static inline void lanei_store(int32_t *p, lanei a) { EACH(p[i] = a.v[i]); }

/* binary64, for the depth plane of a triangle. */
static inline laned laned_splat(double a) { laned r; EACH(r.v[i] = a); return r; }
static inline laned laned_from(lane a) { laned r; EACH(r.v[i] = (double)a.v[i]); return r; }
static inline laned laned_from_int(lanei a) { laned r; EACH(r.v[i] = (double)a.v[i]); return r; }
/* Rounded to nearest. */
static inline lane lane_from_double(laned a) { lane r; EACH(r.v[i] = (float)a.v[i]); return r; }
static inline laned laned_load(const double *p) { laned r; EACH(r.v[i] = p[i]); return r; }
static inline void laned_store(double *p, laned a) { EACH(p[i] = a.v[i]); }
static inline laned laned_add(laned a, laned b) { EACH(a.v[i] = a.v[i] + b.v[i]); return a; }
static inline laned laned_sub(laned a, laned b) { EACH(a.v[i] = a.v[i] - b.v[i]); return a; }
static inline laned laned_mul(laned a, laned b) { EACH(a.v[i] = a.v[i] * b.v[i]); return a; }
static inline laned laned_div(laned a, laned b) { EACH(a.v[i] = a.v[i] / b.v[i]); return a; }

static inline lane lane_gather_f32(const float *p, lanei at) { lane r; EACH(r.v[i] = p[at.v[i]]); return r; }
static inline lane lane_gather_u16(const uint16_t *p, lanei at) { lane r; EACH(r.v[i] = (float)p[at.v[i]]); return r; }
/* Lookup in a table of 16 values in memory; `at` is 0 .. 15. */
static inline lane lane_table(const float *p, lanei at) { return lane_gather_f32(p, at); }

/* Sums of 16-bit values times weights, modulo 2^32: exact in any order. A pair is two rows of four values. `weights`
 * has the weight of the first row in the low half and of the second in the high half, both signed. The fourth value of
 * each row is 0, so there are three totals. */
typedef struct lane_pair {
    const uint16_t *first, *second;
} lane_pair;
typedef struct lane_sums {
    uint32_t v[3];
} lane_sums;
static inline lane_pair pair_load(const uint16_t *first, const uint16_t *second)
{
    lane_pair r;
    r.first = first;
    r.second = second;
    return r;
}
static inline lane_sums sums_zero(void) { lane_sums r = {{0, 0, 0}}; return r; }
/* Unrolled, as EACH. Only the high half of `weight` counts. */
static inline lane_sums sums_add_row(lane_sums s, const uint16_t *row, uint32_t weight)
{
    const uint32_t w = (uint32_t)((int32_t)weight >> 16);
    s.v[0] += w * row[0];
    s.v[1] += w * row[1];
    s.v[2] += w * row[2];
    return s;
}
static inline lane_sums sums_add(lane_sums s, lane_pair p, uint32_t weights)
{
    return sums_add_row(sums_add_row(s, p.first, weights << 16), p.second, weights);
}
#define LANE_ADDS_LINKS
static inline lane_sums sums_add_links(lane_sums s, uint16_t (*row)[4], const uint32_t *link)
{
    for (int i = 0; i < 4; ++i) {
        s = sums_add_row(s, row[link[i] & 0xffffu], link[i]);
    }
    return s;
}
static inline void sums_add_directed(lane_sums s[3], uint16_t (*row)[4], const uint32_t *link)
{
    for (int i = 0; i < 8; i += 2) {
        const uint16_t *of = row[link[i] & 0xffffu];
        s[0] = sums_add_row(s[0], of, link[i]);
        s[1] = sums_add_row(s[1], of, link[i + 1] << 16);
        s[2] = sums_add_row(s[2], of, link[i + 1]);
    }
}
static inline void sums_store(int32_t out[3], lane_sums s)
{
    for (int c = 0; c < 3; ++c) {
        out[c] = (int32_t)s.v[c];
    }
}

/* Memory of surfaces. If a backend is wider than a tile's row, it also covers the next row, `step` values further on.
 * 16-bit values are integers 0 .. 65535. */
static inline lane lane_load_rows(const float *p, int32_t step) { (void)step; return lane_load(p); }
static inline void lane_store_rows(float *p, int32_t step, lane a) { (void)step; lane_store(p, a); }
static inline lane lane_load_u16(const uint16_t *p, int32_t step)
{
    lane r;
    (void)step;
    EACH(r.v[i] = (float)p[i]);
    return r;
}
static inline void lane_store_u16(uint16_t *p, int32_t step, lane a) { (void)step; EACH(p[i] = (uint16_t)a.v[i]); }
/* Writes `id` if the mask is set. Other memory keeps the old value but may be rewritten. */
static inline void lane_put_u16(uint16_t *p, int32_t step, uint32_t id, lane_mask m)
{
    (void)step;
    EACH(if (m.v[i]) p[i] = (uint16_t)id);
}
static inline void lane_put_u32(uint32_t *p, int32_t step, uint32_t id, lane_mask m)
{
    (void)step;
    EACH(if (m.v[i]) p[i] = id);
}
/* Raises 2 LANES codes from p on: those at even places to `even`, the others to `odd` (LANE_PAIRS; other backends take
 * the first half, then the second). Compilers then join two codes by a shift, in place of six shuffles. The codes are
 * below 65536 and are truncated; negative ones count as 0. */
#define LANE_PAIRS
static inline void lane_raise_u16(uint16_t *p, lane even, lane odd)
{
    static const uint16_t one = 1;
    const int shift = *(const uint8_t *)&one == 1 ? 0 : 16; /* of the code that is first in memory */
    uint32_t pair[LANES];
    uint16_t code[2 * LANES];
    for (int i = 0; i < LANES; ++i) { /* loops, because gcc makes branches of EACH */
        const int32_t a = (int32_t)(even.v[i] > 0.0f ? even.v[i] : 0.0f);
        const int32_t b = (int32_t)(odd.v[i] > 0.0f ? odd.v[i] : 0.0f);
        pair[i] = (uint32_t)a << shift | (uint32_t)b << (16 - shift);
    }
    memcpy(code, pair, sizeof code);
    for (int i = 0; i < 2 * LANES; ++i) {
        p[i] = p[i] > code[i] ? p[i] : code[i];
    }
}
/* Replaces smaller depths by d, and their ids by `id`. Only in this backend: if two stores share a mask, gcc does not
 * merge the lanes into vectors, so each store compares again. */
static inline void lane_put_larger_u32(float *p, uint32_t *ids, uint32_t id, lane d)
{
    const lane was = lane_load(p);
    lanei r;
    EACH(r.v[i] = (int32_t)(was.v[i] < d.v[i] ? id : ids[i]));
    EACH(d.v[i] = was.v[i] < d.v[i] ? d.v[i] : was.v[i]);
    EACH(ids[i] = (uint32_t)r.v[i]);
    EACH(p[i] = d.v[i]);
}
/* Replaces smaller 16-bit codes by those of `code`, which are 0 .. 65535 and are truncated, and their ids by `id`, if
 * the mask is set. Without branches, which cost more. */
static inline void lane_put_larger_u16(uint16_t *p, uint16_t *ids, uint32_t id, lane code, lane_mask m)
{
    lanei was, named, now;
    EACH(was.v[i] = p[i]);
    EACH(named.v[i] = ids[i]);
    EACH(now.v[i] = (int32_t)((uint32_t)(int32_t)code.v[i] & m.v[i]));
    EACH(named.v[i] = now.v[i] > was.v[i] ? (int32_t)id : named.v[i]);
    EACH(was.v[i] = now.v[i] > was.v[i] ? now.v[i] : was.v[i]);
    EACH(p[i] = (uint16_t)was.v[i]);
    EACH(ids[i] = (uint16_t)named.v[i]);
}

#undef EACH
#endif
