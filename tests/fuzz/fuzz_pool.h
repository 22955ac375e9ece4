/* fuzz_pool.h: arguments for the public calls of fuzz_calls.c: slots of each public struct, memory with an exact end,
 * odd numbers, scenes. All are reset for each input. */
#ifndef FUZZ_POOL_H
#define FUZZ_POOL_H

#include <lambent/lambent.h>

#include "fuzz.h"

#define FUZZ_CALLS \
    (LMB_TREES && LMB_PROBES && LMB_VOXELS && LMB_MIXED && LMB_RELIEF && LMB_PLAN && LMB_TRANSFER && LMB_MULTISAMPLE && \
     LMB_CULLING && LMB_DRAW)

/* Good numbers are small, so that a call takes well under a millisecond. */
enum { POOL_WIDE = 24, POOL_HIGH = 16, POOL_MAP = 32, POOL_SMALL = 8, POOL_SLOTS = 2, POOL_SCENES = 5 };
enum { POOL_LIGHTS = 16, POOL_TEXELS = 128, POOL_PLACES = 64, POOL_PARTS = 2, POOL_MAPS = 4,
       POOL_CLUSTERS = 8, POOL_BINS = 3 }; /* elements of a slot that is an array */
enum { POOL_ARRAY = 1 << 17 }; /* bytes: maximum length of a plain array */

/* pool_begin: clears everything except the scenes. pool_end: frees blocks, and checks the guard bytes around blocks and
 * slots, and that no call wrote to a scene. */
void pool_begin(void);
void pool_end(void);

/* pool_slot: slot i of a struct; aborts if the type does not exist. Slots of scenes are read-only. */
void *pool_slot(const char *type, int i);
size_t pool_slot_bytes(const char *type);

/* pool_block: zeroed memory of exactly this size, until pool_end. */
void *pool_block(size_t bytes);

/* pool_float: number 0 .. 255 of a table; the first 32 are mostly odd ones. pool_vector: three of them. */
float pool_float(uint8_t i);
lmb_vec3 pool_vector(uint8_t i);
int64_t pool_whole(uint8_t i);

/* pool_raw: POOL_ARRAY bytes that fill plain arrays and receive their contents. */
extern float pool_raw[POOL_ARRAY / sizeof(float)];

/* pool_nearest: of `count` names, `step` bytes apart, the one with the hash nearest to a number. A new name therefore
 * takes over only few numbers of other names. */
int pool_nearest(const char *const *name, size_t step, int count, uint16_t wanted);

/* Actions of a program between calls, each driven by 12 bytes of an input:
 * pool_fill: sets a slot of a struct to a valid value, with pointers to slots 0; some structs in several ways.
 * pool_poke: sets one number of a struct to an odd one, except for numbers that give the length of memory.
 * pool_link: sets a pointer of a struct to a slot or NULL, or sets a struct within it to a copy of a slot.
 * pool_change: changes one number of the last scene but two, if lmb_scene_check accepts the result. */
void pool_fill(const uint8_t b[12]);
void pool_poke(const uint8_t b[12]);
void pool_link(const uint8_t b[12]);
void pool_change(const uint8_t b[12]);

/* pool_make_scenes, pool_scene: fuzz_pool_scene.c: a room; a room with every property of materials and lights; the
 * same, changed by pool_change; no scene; a relief's. */
void pool_make_scenes(void);
void pool_check_scenes(void);
const lmb_scene *pool_scene(int i);

/* pool_transfer, pool_relief, pool_pack: the words of the files, for a copy. */
const uint32_t *pool_transfer(size_t *bytes);
const uint32_t *pool_relief(size_t *bytes);
const uint32_t *pool_pack(size_t *bytes);

/* pool_say: prints an input's actions if LMB_FUZZ_SAY is set in the environment. */
extern int pool_says;
void pool_say(const char *format, ...);

#endif
