/* fuzz_calls.h: one argument of a public call, and the lengths of plain arrays. */
#ifndef FUZZ_CALLS_H
#define FUZZ_CALLS_H

#include "fuzz_pool.h"

typedef struct argument {
    const char *type, *name;
    void *memory;
    size_t bytes;   /* of a plain array */
    int is_ready, is_plain;
    int64_t whole;
    uint8_t byte;
} argument;

/* fuzz_length: size in bytes that `call` needs for the plain array or memory `name`, from the other arguments. Returns
 * 0 if the table has no such array. */
int fuzz_length(size_t *bytes, const argument *a, const char *call, const char *name);

#endif
