/* world.h: one texel of the world, and all of it for the kernels. Layer 6. */
#ifndef LMB_PROBE_WORLD_H
#define LMB_PROBE_WORLD_H

#include "../lane/kernels.h"

#define LMB_WORLD_LOG2_10 3.32192809f

/* The log code e of radiance c, and back. c is clamped to 0 .. 99.899, e to 0 .. 1. */
float lmb_world_encode(float c);
float lmb_world_decode(float e);

/* RGB radiance and alpha of texel `at`. */
void lmb_world_texel(float out[4], const lmb_world *world, size_t at);
void lmb_world_put(const lmb_world *world, size_t at, const float rgba[4]);

/* The place of face texel (x, y) of a level, from -1 to its width: its border. */
size_t lmb_world_face_texel(const lmb_world_level *level, int32_t face, int32_t x, int32_t y);

/* The world's peaks, of its first level. Returns how many. */
int32_t lmb_world_find_peaks(lmb_world *inout);

/* As lmb_world_texel of the first level, without its part of peaks. */
void lmb_world_calm_texel(float out[4], const lmb_world *world, int32_t face, int32_t x, int32_t y);

/* The first texel of a peak's 32nd by 32nd, and the first past it, by column and row. */
void lmb_world_peak_texels(int32_t from[2], int32_t to[2], const lmb_world *world, const lmb_world_peak *peak);

enum { LMB_WORLD_NARROW = 32 /* parts of a face each way; smaller faces have no peaks */ };

enum { LMB_WORLD_ALL = 0, LMB_WORLD_CALM = 1 };

/* What kernels ask of the world, or of its calm levels, for rays so wide, rad. */
void lmb_world_ask(lmb_world_job *out, const lmb_world *world, int32_t of, float ray_width, int32_t blend);

/* What `at` sees of a peak: its direction, and what its flux is times: 0 behind the ground. */
float lmb_world_see_peak(lmb_vec3 *to, const lmb_world_job *job, const lmb_world *world, const lmb_world_peak *peak,
                         lmb_vec3 at);

/* All peaks' light into a map, each by the four texels around it. */
void lmb_world_add_peaks(float *map, const lmb_probe_table *table, const lmb_world_job *job, const lmb_world *world,
                         lmb_vec3 at);

#endif
