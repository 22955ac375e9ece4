/* world.h: access to single texels of the world, and to the whole for the kernels. Layer 5. */
#ifndef LMB_PROBE_WORLD_H
#define LMB_PROBE_WORLD_H

#include "../lane/kernels.h"

#define LMB_WORLD_LOG2_10 3.32192809f

/* Converts radiance c to the log code e, and back. c is clamped to 0 .. 99.899, e to 0 .. 1. */
float lmb_world_encode(float c);
float lmb_world_decode(float e);

/* RGB radiance and alpha of texel `at`. */
void lmb_world_texel(float out[4], const lmb_world *world, size_t at);
void lmb_world_put(const lmb_world *world, size_t at, const float rgba[4]);

/* Index of face texel (x, y) of a level; the border has coordinates -1 and the face's width. */
size_t lmb_world_face_texel(const lmb_world_level *level, int32_t face, int32_t x, int32_t y);

/* Finds the peaks in the world's first level. Returns their number. */
int32_t lmb_world_find_peaks(lmb_world *inout);

/* Like lmb_world_texel for the first level, without the light of peaks. */
void lmb_world_calm_texel(float out[4], const lmb_world *world, int32_t face, int32_t x, int32_t y);

/* First texel of a peak's 32nd by 32nd, and the first past it, by column and row. */
void lmb_world_peak_texels(int32_t from[2], int32_t to[2], const lmb_world *world, const lmb_world_peak *peak);

enum { LMB_WORLD_NARROW = 32 /* parts along a face's side; smaller faces have no peaks */ };

enum { LMB_WORLD_ALL = 0, LMB_WORLD_CALM = 1 };

/* Sets up a kernel job for the world, or for the calm levels, if you trace rays of this width, rad. */
void lmb_world_ask(lmb_world_job *out, const lmb_world *world, int32_t of, float ray_width, int32_t blend);

/* Direction from `at` to a peak, and the factor on the peak's flux: 0 behind the ground. */
float lmb_world_see_peak(lmb_vec3 *to, const lmb_world_job *job, const lmb_world *world, const lmb_world_peak *peak,
                         lmb_vec3 at);

/* Adds the light of all peaks to a map, each to the four texels around it. */
void lmb_world_add_peaks(float *map, const lmb_probe_table *table, const lmb_world_job *job, const lmb_world *world,
                         lmb_vec3 at);

#endif
