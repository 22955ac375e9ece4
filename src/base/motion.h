/* motion.h: transforms of a .lmp's animations at a time. Layer 1. */
#ifndef LMB_BASE_MOTION_H
#define LMB_BASE_MOTION_H

#include <lambent/pack.h>

/* Moves a camera that has such a node; any other stays unchanged. Returns 0 if the node has no valid transform. */
int lmb_pack_place_camera(lmb_view *inout, const lmb_pack *pack, uint32_t i, float time_s);

#endif
