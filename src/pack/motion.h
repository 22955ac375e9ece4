/* motion.h: where a .lmp's animations put things at a time. Layer 2. */
#ifndef LMB_PACK_MOTION_H
#define LMB_PACK_MOTION_H

#include <lambent/pack.h>

/* The node that moves instance, light or camera i of a kind; LMB_PACK_NONE: none does. */
uint32_t lmb_pack_node_of(const lmb_pack *pack, int kind, uint32_t i);

/* What has such a node is put to its place; nothing else changes. 0: it has no place there. */
int lmb_pack_place_instance(lmb_instance *inout, const lmb_pack *pack, uint32_t i, float time_s);
int lmb_pack_place_light(lmb_light *inout, const lmb_pack *pack, uint32_t i, float time_s);
int lmb_pack_place_camera(lmb_view *inout, const lmb_pack *pack, uint32_t i, float time_s);

#endif
