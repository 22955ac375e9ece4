/* world.h: one texel of the world. Floor 6. */
#ifndef LMB_PROBE_WORLD_H
#define LMB_PROBE_WORLD_H

#include <lambent/probe.h>

/* RGB radiance and alpha of texel `at`. */
void lmb_world_texel(float out[4], const lmb_world *world, size_t at);

#endif
