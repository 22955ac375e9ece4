/* memory.c: the four memory functions, for systems without a libc. Aligned memory is processed by words, because a
 * frame clears depth, ids and tiles; other memory byte by byte, which keeps the code small.
 *
 * Compile with -fno-builtin, or the compiler turns a loop into a call of the same function. */
#include <stdint.h>
#include <string.h>

#if defined(__GNUC__)
typedef uint32_t __attribute__((may_alias)) word;
#else
typedef unsigned char word; /* the only type that may alias all others */
#endif

enum { WORD = sizeof(word), BLOCK = 4 * WORD };

/* From the first byte on: also right for overlapping memory if it moves down. */
static void copy_up(unsigned char *t, const unsigned char *f, size_t n)
{
    if (((uintptr_t)t | (uintptr_t)f) % WORD == 0)
        for (; n >= BLOCK; n -= BLOCK, t += BLOCK, f += BLOCK) {
            word *w = (word *)(void *)t;
            const word *v = (const word *)(const void *)f;
            const word a = v[0], b = v[1], c = v[2], d = v[3];
            w[0] = a, w[1] = b, w[2] = c, w[3] = d;
        }
    while (n--)
        *t++ = *f++;
}

void *memcpy(void *restrict to, const void *restrict from, size_t n)
{
    copy_up(to, from, n);
    return to;
}

void *memmove(void *to, const void *from, size_t n)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    if ((uintptr_t)t <= (uintptr_t)f) {
        copy_up(t, f, n);
        return to;
    }
    while (n--)
        t[n] = f[n];
    return to;
}

/* Aligned memory by 32 bytes, if one instruction stores many registers: takes half the time. */
#if defined(__arm__) && !defined(__thumb__)
static size_t fill_lines(unsigned char *to, uint32_t all, size_t n)
{
    register uint32_t a __asm__("r3") = all, b __asm__("r4") = all, c __asm__("r5") = all, d __asm__("r6") = all;
    size_t left = n;
    for (; left >= 32; left -= 32)
        __asm__ volatile("stmia %0!, {r3, r4, r5, r6}\n\tstmia %0!, {r3, r4, r5, r6}"
                         : "+r"(to)
                         : "r"(a), "r"(b), "r"(c), "r"(d)
                         : "memory");
    return n - left;
}
#else
static size_t fill_lines(unsigned char *to, uint32_t all, size_t n)
{
    (void)to, (void)all, (void)n;
    return 0;
}
#endif

void *memset(void *to, int value, size_t n)
{
    unsigned char *t = to;
    const word all = (word)((unsigned char)value * (word)0x01010101u);
    if ((uintptr_t)t % WORD == 0) {
        const size_t filled = fill_lines(t, (uint32_t)all, n);
        t += filled, n -= filled;
        for (; n >= BLOCK; n -= BLOCK, t += BLOCK) {
            word *w = (word *)(void *)t;
            w[0] = w[1] = w[2] = w[3] = all;
        }
    }
    while (n--)
        *t++ = (unsigned char)value;
    return to;
}

int memcmp(const void *a, const void *b, size_t n)
{
    const unsigned char *p = a, *q = b;
    for (; n; --n, ++p, ++q)
        if (*p != *q)
            return *p < *q ? -1 : 1;
    return 0;
}
