/* mutate.h: seeded damage to a file's bytes: the same seed and bytes give the same damage everywhere. */
#ifndef MUTATE_H
#define MUTATE_H

#include <stddef.h>
#include <stdint.h>

/* mutate: `data` holds `size` bytes and has room for `cap`. Makes one to eight changes, half of them near the
 * beginning: flips bits, sets bytes and 32-bit words to values that break counts and lengths, changes digits, cuts out
 * or copies pieces. Returns the new size, at most `cap`. */
size_t mutate(uint8_t *data, size_t size, size_t cap, uint64_t seed);

/* mutate_cap: room that is enough for most copied pieces. */
static inline size_t mutate_cap(size_t size) { return size + size / 2 + 64; }

#endif
