/* lines_n64.h: the data cache of the Nintendo 64: 512 lines of 16 bytes, direct-mapped. */
#ifndef LINES_N64_H
#define LINES_N64_H

#include <stddef.h>
#include <stdint.h>

/* On other MIPS processors, used for counting the cost, cache operations are privileged, so another
 * instruction replaces them. */
#ifdef N64_NO_CACHE_OPERATIONS
#define CACHE_LINE(operation, p) __asm__ volatile("nop" : : "r"(p) : "memory")
#else
#define CACHE_LINE(operation, p) __asm__ volatile("cache %0, 0(%1)" : : "i"(operation), "r"(p) : "memory")
#endif
enum { WRITE_BACK_INVALIDATE_ANY = 0x01, CREATE_DIRTY = 0x0d, N64_LINE = 16, N64_CACHE = 8192 /* bytes */ };

/* Allocates lines without fetching them, if you write all of their bytes. `p` is aligned to N64_LINE. */
static inline void n64_make_lines(void *p, size_t bytes)
{
    for (unsigned char *at = p, *past = at + bytes; at < past; at += N64_LINE)
        CACHE_LINE(CREATE_DIRTY, at);
}

/* Writes all modified lines back to memory. */
static inline void n64_write_back(void)
{
    for (uintptr_t at = 0x80000000u; at < 0x80000000u + N64_CACHE; at += N64_LINE)
        CACHE_LINE(WRITE_BACK_INVALIDATE_ANY, at);
}

#endif
