/* scene_hash.h: a hash of everything that a scene draws, as a key for cached results. */
#ifndef SCENE_HASH_H
#define SCENE_HASH_H

#include <lambent/lambent.h>

/* 64-bit FNV-1a of the numbers in the order of the structs, without padding. It is the same for little- and
 * big-endian machines only if the numbers are bytes. The hash includes the library version. */
uint64_t scene_hash(const lmb_scene *scene);
uint64_t scene_hash_bytes(uint64_t hash, const void *data, size_t size);
uint64_t scene_hash_view(uint64_t hash, const lmb_view *view);

#endif
