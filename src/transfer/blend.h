/* blend.h: light blended from up to four clusters. Layer 7. */
#ifndef LMB_TRANSFER_BLEND_H
#define LMB_TRANSFER_BLEND_H

#include <lambent/transfer.h>

#include <string.h>

/* Words 0 and 1 hold two cluster indices each, word 2 the weights in 255ths. */
static inline void transfer_blend(float out[9], const lmb_transfer_light *light, const uint32_t *b)
{
    memset(out, 0, 9 * sizeof *out);
    for (int k = 0; k < 4; ++k) {
        const float *cluster = light->cluster[b[k / 2] >> 16 * (k % 2) & 0xffffu];
        const float share = (float)(b[2] >> 8 * k & 255u) * (1.0f / 255.0f);
        for (int c = 0; share > 0.0f && c < 9; ++c) {
            out[c] += share * cluster[c];
        }
    }
}

#endif
