/* air.h: light on what moves, from places in the air around it. Layer 9. */
#ifndef LMB_TRANSFER_AIR_H
#define LMB_TRANSFER_AIR_H

#include <lambent/transfer.h>

/* May the triangle move? LMB_TRANSFER_NONE, of no triangle, may. */
int lmb_transfer_moves(const lmb_transfer *t, uint32_t id);

/* Add the light that arrives at pixel k of a tile. */
void lmb_transfer_air_pixel(lmb_irradiance *inout, const lmb_transfer_light *light, const lmb_transfer *t,
                        const lmb_tile *tile, int k);

#endif
