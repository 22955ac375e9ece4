/* plan_survey.c: picks a frame's tiles to sample: evenly, along a Z curve. Layer 8. */
#include <lambent/plan.h>

#include <string.h>

#include "../base/vec.h"
#include "stages.h"
#include "requires.h"
#include "plan_sample.h"

#if LMB_PLAN && LMB_TREES

static uint32_t even_bits(uint32_t v)
{
    uint32_t out = 0;
    for (int i = 0; i < 16; ++i) {
        out |= (v >> (2 * i) & 1u) << i;
    }
    return out;
}

/* The i-th position to visit, of `all` along the curve: any number of first positions is evenly spread. */
static uint32_t spread(uint32_t i, uint32_t all)
{
    uint64_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) {
        reversed |= (uint64_t)(i >> bit & 1u) << (31 - bit);
    }
    return (uint32_t)(reversed * all >> 32);
}

lmb_status lmb_survey_even(lmb_survey *out, const lmb_render *r, int32_t wanted)
{
    if (out == NULL || !lmb_can_sample(r) || wanted < 1 || wanted > LMB_SAMPLE_TILES) {
        return LMB_ERR_ARG;
    }
    const lmb_view *v = &r->frame.view;
    const uint32_t across = ((uint32_t)v->frame_width + LMB_TILE - 1) / LMB_TILE, down = (uint32_t)band_count(v),
                   all = across * down;
    memset(out, 0, sizeof *out);
    out->count = (uint32_t)wanted < all / 2 ? wanted : (int32_t)((all + 1) / 2); /* so that no two are equal */
    uint32_t met = 0;
    for (uint32_t code = 0; met < all; ++code) {
        const uint32_t x = even_bits(code), y = even_bits(code >> 1);
        for (int32_t i = 0; x < across && y < down && i < out->count; ++i) {
            if (spread((uint32_t)i, all) == met) {
                out->x[i] = (uint16_t)(x * LMB_TILE);
                out->y[i] = (uint16_t)(y * LMB_TILE);
            }
        }
        met += x < across && y < down;
    }
    return LMB_OK;
}

#endif
