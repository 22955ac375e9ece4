/* world.h: one texel of the world, and all of it for the kernels. Layer 6. */
#ifndef LMB_PROBE_WORLD_H
#define LMB_PROBE_WORLD_H

#include "../lane/kernels.h"

/* RGB radiance and alpha of texel `at`. */
void lmb_world_texel(float out[4], const lmb_world *world, size_t at);

/* What kernels ask of the world for rays so wide, rad. */
void lmb_world_ask(lmb_world_job *out, const lmb_world *world, float ray_width, int32_t blend);

#endif
