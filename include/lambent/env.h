/* env.h: an environment cube with mip levels: RGBA half floats in your memory; a clear sky; the cube as lights.
 *                                                                                                         [M14 M19 M22]
 *
 * Six faces of n x n texels in GL order (+x -x +y -y +z -z), rows from the top: with s, t in -1 .. 1 the direction is
 * (1,-t,-s) (-1,-t,s) (s,1,t) (s,-1,-t) (s,-t,1) (-s,-t,-1). Each level has half the side of the one before, down to
 * one texel.
 *
 * Stability: experimental. Tags like [M14] are requirements in src/SOURCES.md. */
#ifndef LMB_ENV_H
#define LMB_ENV_H

#include "scene.h"

#define LMB_ENV_LEVELS 12 /* for the largest faces, of 2048 texels a side */

typedef struct lmb_env {
    uint16_t *texels;            /* R, G, B radiance, W/(m2 sr), and A = 1, as binary16; level after level */
    int32_t size, levels;        /* texels of a face's side: a power of two */
    uint32_t at[LMB_ENV_LEVELS]; /* the first texel of each level; face f begins f n n texels later */
} lmb_env;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_env_bytes: memory of a cube; 0 for a size that is no power of two in 1 .. 2048. */
size_t lmb_env_bytes(int32_t size);

/* lmb_env_init: an unlit cube in `memory`. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_env_init(lmb_env *out, int32_t size, void *memory, size_t bytes);

/* lmb_env_set: set a texel of level 0. Values are clamped to 0 .. 65504; NaN becomes 0. */
void lmb_env_set(const lmb_env *env, int32_t face, int32_t x, int32_t y, const float rgb[3]);

/* lmb_env_mips: compute the other levels, each texel the mean of four. [M19] */
void lmb_env_mips(const lmb_env *env);

/* lmb_env_dim: set `out`, of the same size, to `from` times a share by channel, all levels; a share of 1 keeps the
 * bits. */
void lmb_env_dim(const lmb_env *out, const lmb_env *from, const float share[3]);

/* lmb_env_sample: radiance from `direction` (any length; 0 counts as -z) within a cone; tan_half is the tangent of the
 * half angle. Interpolates the two levels with texels nearest to that width, bilinearly across the faces' edges. */
void lmb_env_sample(float out[3], const lmb_env *env, lmb_vec3 direction, float tan_half);

/* lmb_env_sky: fill level 0 with a clear daylight sky with +Y up, and a ground of constant radiance below the horizon.
 * Source: Preetham, Shirley, Smits: A Practical Analytic Model for Daylight, 1999. The sun's disc is not included.
 *
 *   to_sun     towards the sun, any length; clamped to 85 degrees from the zenith
 *   turbidity  haziness of the air: 2 very clear .. 10 hazy; clamped to this range; NaN counts as 2
 *   scale      W/(m2 sr) of 1 kcd/m2: 0.025 with a sun of 3 W/m2
 * Cost: about 0.3 us a texel. Returns LMB_OK or LMB_ERR_ARG.
 * Missing, like the next two, in builds without trees. */
lmb_status lmb_env_sky(const lmb_env *env, lmb_vec3 to_sun, float turbidity, float scale, const float ground[3]);

/* lmb_env_take_sun: move a small and strong source into a directional light, so that it can have a shadow map and sharp
 * shadows. The excess over 8 times the mean in texels within 3 degrees of the brightest one is removed from level 0,
 * and becomes *out with one direction. Returns 1; or 0, with both unchanged, if that is less than a tenth of all
 * light. */
int lmb_env_take_sun(lmb_light *out, const lmb_env *env);

/* lmb_env_lights: one directional light for each texel of a level that is not black; at most 6 n n with faces of n x n.
 * Returns their number; 0 if more than `cap` are needed, or there is no such level. */
uint32_t lmb_env_lights(lmb_light *out, uint32_t cap, const lmb_env *env, int32_t level);

#ifdef __cplusplus
}
#endif
#endif
