/* mutate.h: seeded damage to a file's bytes: the same seed and bytes give the same damage everywhere. */
#ifndef MUTATE_H
#define MUTATE_H

#include <stddef.h>
#include <stdint.h>

/* mutate: `data` holds `size` bytes and has room for `cap`; one to eight changes at places of which half are near its
 * beginning: bits flipped, bytes and 32-bit words set to what counts and lengths go wrong with, digits changed, pieces
 * cut out or copied. Returns the new size, at most `cap`. */
size_t mutate(uint8_t *data, size_t size, size_t cap, uint64_t seed);

/* mutate_cap: room that leaves most copied pieces whole. */
static inline size_t mutate_cap(size_t size) { return size + size / 2 + 64; }

#endif
