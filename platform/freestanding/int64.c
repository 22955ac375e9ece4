/* int64.c: functions that compilers call for 64-bit integers and for counting zeros, if their own library was built for
 * another processor of the family: MIPS I and III. */
#include <stdint.h>

typedef union pair {
    uint64_t all;
    struct {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
        uint32_t high, low;
#else
        uint32_t low, high;
#endif
    } half;
} pair;

uint64_t __ashldi3(uint64_t a, int n);
uint64_t __lshrdi3(uint64_t a, int n);
int64_t __ashrdi3(int64_t a, int n);
int64_t __muldi3(int64_t a, int64_t b);
uint64_t __udivdi3(uint64_t a, uint64_t b);
uint64_t __umoddi3(uint64_t a, uint64_t b);
int64_t __divdi3(int64_t a, int64_t b);
int64_t __moddi3(int64_t a, int64_t b);
int __clzsi2(uint32_t a);
int __ctzsi2(uint32_t a);
int __clzdi2(uint64_t a);
int __ctzdi2(uint64_t a);
int __popcountsi2(uint32_t a);
int __popcountdi2(uint64_t a);
uint32_t __bswapsi2(uint32_t a);

/* --- shifts, 0 <= n < 64 ------------------------------------------------------------------------------------------ */

uint64_t __ashldi3(uint64_t a, int n)
{
    pair from, to;
    from.all = a;
    if (n == 0)
        return a;
    to.half.high = n >= 32 ? from.half.low << (n - 32) : from.half.high << n | from.half.low >> (32 - n);
    to.half.low = n >= 32 ? 0 : from.half.low << n;
    return to.all;
}

uint64_t __lshrdi3(uint64_t a, int n)
{
    pair from, to;
    from.all = a;
    if (n == 0)
        return a;
    to.half.low = n >= 32 ? from.half.high >> (n - 32) : from.half.low >> n | from.half.high << (32 - n);
    to.half.high = n >= 32 ? 0 : from.half.high >> n;
    return to.all;
}

int64_t __ashrdi3(int64_t a, int n)
{
    pair from, to;
    from.all = (uint64_t)a;
    if (n == 0)
        return a;
    const int32_t high = (int32_t)from.half.high;
    to.half.low = n >= 32 ? (uint32_t)(high >> (n - 32)) : from.half.low >> n | from.half.high << (32 - n);
    to.half.high = (uint32_t)(n >= 32 ? high >> 31 : high >> n);
    return (int64_t)to.all;
}

/* --- products and quotients --------------------------------------------------------------------------------------- */

int64_t __muldi3(int64_t a, int64_t b)
{
    pair x, y, to;
    x.all = (uint64_t)a, y.all = (uint64_t)b;
    to.all = (uint64_t)x.half.low * y.half.low;
    to.half.high += x.half.low * y.half.high + x.half.high * y.half.low;
    return (int64_t)to.all;
}

/* Bit by bit, from the dividend's highest bit; uses the processor's division if both have 32 bits. */
static uint64_t divide(uint64_t a, uint64_t b, uint64_t *rest)
{
    uint64_t quotient = 0, left = 0;
    if (((a | b) >> 32) == 0 && (uint32_t)b != 0) {
        *rest = (uint32_t)a % (uint32_t)b;
        return (uint32_t)a / (uint32_t)b;
    }
    for (int i = 63 - (a ? __clzdi2(a) : 63); i >= 0; --i) {
        left = left << 1 | (a >> i & 1);
        quotient <<= 1;
        if (left >= b)
            left -= b, quotient |= 1;
    }
    *rest = left;
    return quotient;
}

static uint64_t size_of(int64_t a) { return a < 0 ? 0 - (uint64_t)a : (uint64_t)a; }

uint64_t __udivdi3(uint64_t a, uint64_t b)
{
    uint64_t rest;
    return divide(a, b, &rest);
}

uint64_t __umoddi3(uint64_t a, uint64_t b)
{
    uint64_t rest;
    divide(a, b, &rest);
    return rest;
}

int64_t __divdi3(int64_t a, int64_t b)
{
    uint64_t rest;
    const uint64_t q = divide(size_of(a), size_of(b), &rest);
    return (int64_t)((a ^ b) < 0 ? 0 - q : q);
}

int64_t __moddi3(int64_t a, int64_t b)
{
    uint64_t rest;
    divide(size_of(a), size_of(b), &rest);
    return (int64_t)(a < 0 ? 0 - rest : rest);
}

/* --- bits --------------------------------------------------------------------------------------------------------- */

int __clzsi2(uint32_t a)
{
    int n = 0;
    if (!(a >> 16))
        n += 16, a <<= 16;
    if (!(a >> 24))
        n += 8, a <<= 8;
    if (!(a >> 28))
        n += 4, a <<= 4;
    if (!(a >> 30))
        n += 2, a <<= 2;
    return n + !(a >> 31);
}

int __ctzsi2(uint32_t a) { return 31 - __clzsi2(a & (0 - a)); }
int __clzdi2(uint64_t a) { return a >> 32 ? __clzsi2((uint32_t)(a >> 32)) : 32 + __clzsi2((uint32_t)a); }
int __ctzdi2(uint64_t a) { return (uint32_t)a ? __ctzsi2((uint32_t)a) : 32 + __ctzsi2((uint32_t)(a >> 32)); }

int __popcountsi2(uint32_t a)
{
    a -= a >> 1 & 0x55555555u;
    a = (a & 0x33333333u) + (a >> 2 & 0x33333333u);
    a = (a + (a >> 4)) & 0x0f0f0f0fu;
    a += a >> 8;
    return (int)((a + (a >> 16)) & 63u);
}

int __popcountdi2(uint64_t a) { return __popcountsi2((uint32_t)a) + __popcountsi2((uint32_t)(a >> 32)); }

uint32_t __bswapsi2(uint32_t a) { return a << 24 | (a & 0xff00u) << 8 | (a >> 8 & 0xff00u) | a >> 24; }

#if defined(__mips_hard_float)
double __floatdidf(int64_t a);

/* Both halves are exact, so only the sum is rounded. */
double __floatdidf(int64_t a)
{
    const uint32_t low = (uint32_t)a;
    const double of_low = (double)(int32_t)(low >> 1) * 2.0 + (double)(int32_t)(low & 1u);
    return (double)(int32_t)(a >> 32) * 4294967296.0 + of_low;
}
#endif
