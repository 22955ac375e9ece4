/* links.h: a link's weight, a list's unit of weight, and a check that light is initialized. Layer 7. */
#ifndef LMB_TRANSFER_LINKS_H
#define LMB_TRANSFER_LINKS_H

#include <lambent/transfer.h>

#include <string.h>

static inline int transfer_is_laid_out(const lmb_transfer_light *light, const lmb_transfer *t)
{
    return light != NULL && light->power != NULL && t != NULL && t->section[0] != NULL;
}

static inline float link_scale(uint32_t word, float step)
{
    float scale;
    memcpy(&scale, &word, sizeof scale);
    return scale * step;
}

/* Weight in the low 16 bits of a link. */
static inline int32_t link_weight(uint32_t code)
{
    return (int32_t)(code & 0xffffu) - (int32_t)((code & 0x8000u) << 1);
}

#endif
