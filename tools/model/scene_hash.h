/* scene_hash.h: one number for all that a scene draws: what was drawn of it may be kept by that name. */
#ifndef SCENE_HASH_H
#define SCENE_HASH_H

#include <lambent/lambent.h>

/* FNV-1a of 64 bits, of the numbers in the order of their structs, never of what lies between them; the same for
 * little- and big-endian machines only where numbers are bytes. It begins with the library's version. */
uint64_t scene_hash(const lmb_scene *scene);
uint64_t scene_hash_bytes(uint64_t hash, const void *data, size_t size);
uint64_t scene_hash_view(uint64_t hash, const lmb_view *view);

#endif
