/* fuzz_pool.h: what fuzz_calls.c hands to public calls: slots of each public struct, memory that ends where it is said
 * to end, odd numbers, scenes. All of it is as new for each input. */
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
       POOL_CLUSTERS = 8, POOL_BINS = 3 }; /* of a slot that is an array */
enum { POOL_ARRAY = 1 << 17 }; /* bytes: no plain array of a call is longer */

/* pool_begin: everything is zeros, but the scenes. pool_end: frees blocks, and checks what stands around them and the
 * slots, and that no call wrote to a scene. */
void pool_begin(void);
void pool_end(void);

/* pool_slot: slot i of a struct; aborts where there is no such type. A scene's are read-only. */
void *pool_slot(const char *type, int i);
size_t pool_slot_bytes(const char *type);

/* pool_block: memory of exactly so many bytes, zeros, until pool_end. */
void *pool_block(size_t bytes);

/* pool_float: 256 numbers, most of them odd; 0 .. 255. pool_vector: three of them. */
float pool_float(uint8_t i);
lmb_vec3 pool_vector(uint8_t i);
int64_t pool_whole(uint8_t i);

/* pool_raw: POOL_ARRAY bytes, from which plain arrays are filled, and into which they are kept. */
extern float pool_raw[POOL_ARRAY / sizeof(float)];

/* pool_nearest: of `count` names, `step` bytes apart, the one whose hash is next to a number: names that are added take
 * no more than their share of the numbers of others. */
int pool_nearest(const char *const *name, size_t step, int count, uint16_t wanted);

/* What a program does between calls, by 12 bytes of an input each:
 * pool_fill: a slot of a struct becomes one that calls accept, by pointers into slots 0; some in several ways.
 * pool_poke: one number of a struct becomes an odd one. Numbers that say how long memory is stay.
 * pool_link: a pointer of a struct goes to a slot, or nowhere; or a struct within it becomes a copy of a slot.
 * pool_change: one number of the last scene but two changes, if lmb_scene_check takes it. */
void pool_fill(const uint8_t b[12]);
void pool_poke(const uint8_t b[12]);
void pool_link(const uint8_t b[12]);
void pool_change(const uint8_t b[12]);

/* pool_make_scenes, pool_scene: fuzz_pool_scene.c: room; a room with all that materials and lights have; the same,
 * which pool_change changes; no scene; a relief's. */
void pool_make_scenes(void);
void pool_check_scenes(void);
const lmb_scene *pool_scene(int i);

/* pool_transfer, pool_relief, pool_pack: the files' words, for a copy. */
const uint32_t *pool_transfer(size_t *bytes);
const uint32_t *pool_relief(size_t *bytes);
const uint32_t *pool_pack(size_t *bytes);

/* pool_say: printed where the environment has LMB_FUZZ_SAY: what an input does. */
extern int pool_says;
void pool_say(const char *format, ...);

#endif
