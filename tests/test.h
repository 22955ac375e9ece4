/* test.h: the checks that every test uses: a failure prints where and why, and the run goes on. */
#ifndef TEST_H
#define TEST_H

#include <lambent/raster.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* Counters live in the test program's main. */
extern int test_passed, test_failed, test_skipped;

#define CHECK(cond) \
    do { \
        if (cond) { \
            ++test_passed; \
        } else { \
            ++test_failed; \
            printf("FAIL %s:%d: %s\n", __FILE__, __LINE__, #cond); \
        } \
    } while (0)

#define CHECK_MSG(cond, ...) \
    do { \
        if (cond) { \
            ++test_passed; \
        } else { \
            ++test_failed; \
            printf("FAIL %s:%d: %s: ", __FILE__, __LINE__, #cond); \
            printf(__VA_ARGS__); \
            printf("\n"); \
        } \
    } while (0)

#define SKIP(...) \
    do { \
        ++test_skipped; \
        printf("skipped: "); \
        printf(__VA_ARGS__); \
        printf("\n"); \
    } while (0)

/* The value of LMB_LONG: 0 in make check, 1 in make check-all, 2 in make nightly. */
static inline int test_length(void)
{
    const char *set = getenv("LMB_LONG");
    return set != NULL ? atoi(set) : 0;
}

/* How many random tries: `few` in make check, `many` in make nightly. make check-all makes a quarter of `many`, or `few`
 * if that is more. If `many` is less than `few`, it is a step, and make check-all uses `many` too. */
static inline int tries(int few, int many)
{
    const int quarter = (many + 3) / 4;
    switch (test_length()) {
    case 0: return few;
    case 1: return many < few ? many : quarter > few ? quarter : few;
    default: return many;
    }
}

/* Repeatable 32-bit random numbers (PCG XSH-RR, O'Neill 2014). */
typedef struct test_rng {
    uint64_t state;
} test_rng;

static inline uint32_t test_random(test_rng *r)
{
    uint64_t s = r->state;
    uint32_t x = (uint32_t)(((s >> 18) ^ s) >> 27), turn = (uint32_t)(s >> 59);
    r->state = s * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (x >> turn) | (x << ((32u - turn) & 31u));
}

/* Uniform in [lo, hi). */
static inline float test_uniform(test_rng *r, float lo, float hi)
{
    return lo + (hi - lo) * ((float)(test_random(r) >> 8) * (1.0f / 16777216.0f));
}

/* The fastest kernels here, asked for once: in a virtual machine each question takes as long as a small picture. */
static inline const lmb_kernels *picked_kernels(void)
{
    static const lmb_kernels *kernels;
    if (kernels == NULL) {
        kernels = lmb_kernels_pick();
    }
    return kernels;
}

/* The kernels that lmb_kernels_at(0 to 7) returned first. */
static inline const lmb_kernels *listed_kernels(int32_t i)
{
    static const lmb_kernels *kernels[8];
    static int is_asked;
    for (int32_t k = 0; !is_asked && k < 8; ++k) {
        kernels[k] = lmb_kernels_at(k);
    }
    is_asked = 1;
    return 0 <= i && i < 8 ? kernels[i] : NULL;
}

#endif
