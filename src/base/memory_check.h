/* memory_check.h: checks the memory that a caller provides for arrays. Layer 1. */
#ifndef LMB_BASE_MEMORY_CHECK_H
#define LMB_BASE_MEMORY_CHECK_H

#include <lambent/types.h>

/* A 64-bit sum of bytes as a size_t; 0 if this target cannot address so many. */
static inline size_t size_or_none(uint64_t bytes) { return bytes <= SIZE_MAX ? (size_t)bytes : 0; }

/* For arrays of 32-bit numbers. Pass needed = 0 if the size exceeds this target's address space. */
static inline lmb_status check_memory(const void *memory, size_t bytes, size_t needed)
{
    if (memory == NULL) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)memory % 4 != 0) {
        return LMB_ERR_ALIGN;
    }
    return needed == 0 || bytes < needed ? LMB_ERR_CAPACITY : LMB_OK;
}

/* The same for the object that owns the arrays. Pass needed = 0 if the size is impossible: LMB_ERR_ARG. */
static inline lmb_status check_array(const void *out, const void *memory, size_t bytes, size_t needed)
{
    return out == NULL || needed == 0 ? LMB_ERR_ARG : check_memory(memory, bytes, needed);
}

/* For an object laid out in memory that is aligned as for a uint64_t. Pass needed = 0 if its size is impossible. */
static inline lmb_status check_room(const void *out, const void *memory, size_t bytes, size_t needed)
{
    if (out == NULL || memory == NULL || needed == 0) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)memory % sizeof(uint64_t) != 0) {
        return LMB_ERR_ALIGN;
    }
    return bytes < needed ? LMB_ERR_CAPACITY : LMB_OK;
}

#endif
