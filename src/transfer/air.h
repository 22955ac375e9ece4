/* air.h: light on moving objects, from points in the air around them. Layer 7. */
#ifndef LMB_TRANSFER_AIR_H
#define LMB_TRANSFER_AIR_H

#include <lambent/transfer.h>

/* May the triangle move? True for LMB_TRANSFER_NONE, which names no triangle. */
int lmb_transfer_moves(const lmb_transfer *t, uint32_t id);

/* Adds the light that arrives at pixel k of a tile. */
void lmb_transfer_air_pixel(lmb_irradiance *inout, const lmb_transfer_light *light, const lmb_transfer *t,
                        const lmb_tile *tile, int k);

#endif
