/* seed.h: random seeds of a run. To repeat a failed seed, run LANES_SEED=7 build/default/tests lanes */
#ifndef TEST_SEED_H
#define TEST_SEED_H

#include <stdint.h>
#include <stdlib.h>

#include "../test.h"

/* Seeds first .. first + count - 1; if LANES_SEED is set in the environment, only that seed. */
typedef struct seed_range {
    uint32_t first, count;
} seed_range;

static inline seed_range seeds(uint32_t count)
{
    const char *one = getenv("LANES_SEED");
    seed_range r = {1, count};
    if (one != NULL) {
        r.first = (uint32_t)strtoul(one, NULL, 10);
        r.count = 1;
    }
    return r;
}

static inline test_rng seed_rng(uint32_t seed)
{
    test_rng r = {(uint64_t)seed * UINT64_C(0x9e3779b97f4a7c15) + 1};
    test_random(&r);
    return r;
}

/* Bits of floats that often break formulas: zeros, ones and their neighbours, the ends of the denormal, normal, integer
 * and 16-bit ranges, infinities, quiet and signalling NaNs. */
static const uint32_t hard_bits[] = {
    0x00000000, 0x80000000, 0x3f800000, 0xbf800000, 0x3f800001, 0x3f7fffff, 0x3f000000, 0xbf000000, 0x00000001,
    0x80000001, 0x007fffff, 0x807fffff, 0x00800000, 0x80800000, 0x00800001, 0x7f7fffff, 0xff7fffff, 0x7f800000,
    0xff800000, 0x7fc00000, 0xffc00000, 0x7fc12345, 0x7f812345, 0xffa00001, 0x4b000000, 0x4b800001, 0xcb7fffff,
    0x4effffff, 0x4f000000, 0xcf000000, 0x477fff00, 0x47800000, 0x1f800000, 0x5f000000, 0x34000000, 0x3eaaaaab,
};
enum { HARD_COUNT = sizeof hard_bits / sizeof *hard_bits };

#endif
