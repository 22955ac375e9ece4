/* isa_pick.c: picks a backend's kernels, and tests that they compute exact results. Layer 9.
 *
 * On x86 this queries the processor and the system: registers that the system does not save across threads are
 * unusable. Each call queries again, because a cached answer would be writable data. A call costs a few hundred cycles,
 * but over ten thousand in a virtual machine, where the query traps. Call it once a frame, not once a tile. */
#include "../base/exact.h"
#include "../lane/kernels.h"

#if LMB_HAVE_AVX2 || LMB_HAVE_AVX512
#include <cpuid.h>

/* XCR0: the register sets that the system saves. */
static uint32_t saved_registers(void)
{
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

/* Feature bits of leaf 7, and in `saved` the registers they need: 2 SSE, 4 AVX, 0xe0 AVX-512. */
static int processor_has(uint32_t leaf_7, uint32_t saved)
{
    const uint32_t osxsave_avx = 1u << 27 | 1u << 28;
    uint32_t a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & osxsave_avx) != osxsave_avx || (saved_registers() & saved) != saved) {
        return 0;
    }
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & leaf_7) == leaf_7;
}
#endif

#if LMB_HAVE_AVX2
static int has_avx2(void) { return processor_has(1u << 5, 0x06); }
#endif
#if LMB_HAVE_AVX512
static int has_avx512(void) { return processor_has(1u << 5 | 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31, 0xe6); }
#endif
static int has_always(void) { return 1; }
#define has_sse2    has_always
#define has_neon    has_always
#define has_simd128 has_always
#define has_scalar  has_always

static const struct backend {
    const lmb_kernels *kernels;
    int (*is_here)(void);
} backends[] = {
#if defined(LMB_PICK_SSE2) /* in `make demo` */
    {&lmb_kernels_sse2, has_sse2},
#else
#define MACHINE_OF(upper, lower) LMB_IF(LMB_HAVE_##upper, {&lmb_kernels_##lower, has_##lower}, )
    LMB_BACKENDS(MACHINE_OF)
#endif
};
enum { BACKENDS = sizeof backends / sizeof backends[0] };

const lmb_kernels *lmb_kernels_at(int32_t i)
{
    for (int m = 0; i >= 0 && m < BACKENDS; ++m) {
        if (backends[m].is_here() && i-- == 0) {
            return backends[m].kernels;
        }
    }
    return NULL;
}

const char *lmb_kernels_built(int32_t i) { return i >= 0 && i < BACKENDS ? backends[i].kernels->name : NULL; }

const lmb_kernels *lmb_kernels_pick(void) { return lmb_kernels_at(0); }

static int same_text(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

const lmb_kernels *lmb_kernels_named(const char *name)
{
    const lmb_kernels *k = lmb_kernels_pick();
    for (int32_t i = 1; k != NULL && (name == NULL || !same_text(name, k->name)); ++i) {
        k = lmb_kernels_at(i);
    }
    return k;
}

const char *lmb_kernels_name(const lmb_kernels *kernels) { return kernels != NULL ? kernels->name : "?"; }

lmb_status lmb_build_check(void)
{
    volatile float one_and_bit = 1.000244140625f; /* 1 + 2^-12 */
    int exact = lmb_base_is_exact();
    const lmb_kernels *k;
    for (int32_t i = 0; (k = lmb_kernels_at(i)) != NULL; ++i) {
        exact = exact && k->probe(one_and_bit) == 0.0f;
    }
    return exact ? LMB_OK : LMB_ERR_BUILD;
}
