/* draw_stencil.c: stencil tests of whole tiles, eight pixels in a word, with the depth test by lanes. Layer 4.
 *
 * Values are those of draw_tile.c. Pixel i of a row is byte i of a word, the lowest one first. */
#include "draw_part.h"

#include <string.h>

#if LMB_DRAW && LMB_DRAW_LANES
#define STENCIL_ONES UINT64_C(0x0101010101010101) /* 1 in each byte */
#define STENCIL_HIGH UINT64_C(0x8080808080808080)

/* Bytes of 255 for the bits that are 1. */
static uint64_t stencil_bytes(uint32_t bits)
{
    const uint64_t own = bits * STENCIL_ONES & UINT64_C(0x8040201008040201);
    return ((own + ~STENCIL_HIGH) >> 7 & STENCIL_ONES) * 255u;
}

/* A bit for each byte with the highest bit set. */
static uint32_t stencil_bits(uint64_t bytes)
{
    return (uint32_t)((bytes >> 7 & STENCIL_ONES) * UINT64_C(0x0102040810204080) >> 56);
}

/* Sets the highest bits of the bytes with a < b. */
static uint64_t stencil_less(uint64_t a, uint64_t b)
{
    const uint64_t low = (a | STENCIL_HIGH) - (b & ~STENCIL_HIGH); /* high: the low seven bits of a are at least b's */
    return ~((a & ~b) | (~(a ^ b) & low)) & STENCIL_HIGH;
}

/* draw_passes of value and the bytes. */
static uint32_t stencil_passing(int func, uint64_t value, uint64_t bytes)
{
    const uint64_t less = stencil_less(value, bytes), greater = stencil_less(bytes, value);
    return stencil_bits(((func & LMB_DRAW_LESS) != 0 ? less : 0) | ((func & LMB_DRAW_GREATER) != 0 ? greater : 0) |
                        ((func & LMB_DRAW_EQUAL) != 0 ? ~(less | greater) & STENCIL_HIGH : 0));
}

/* Adds 1 to each byte, without carries between them. */
static uint64_t stencil_more(uint64_t v) { return ((v & ~STENCIL_HIGH) + STENCIL_ONES) ^ (v & STENCIL_HIGH); }
static uint64_t stencil_fewer(uint64_t v) { return ((v | STENCIL_HIGH) - STENCIL_ONES) ^ (~v & STENCIL_HIGH); }

/* Bytes of 255 where v is `of`. */
static uint64_t stencil_is(uint64_t v, uint64_t of)
{
    const uint64_t other = stencil_less(v, of) | stencil_less(of, v);
    return ((other ^ STENCIL_HIGH) >> 7) * 255u;
}

static uint64_t stencil_changed(const lmb_draw_state *s, uint64_t was, int op)
{
    switch (op) {
    case LMB_DRAW_CLEAR: return 0;
    case LMB_DRAW_PUT: return s->stencil_value * STENCIL_ONES;
    case LMB_DRAW_INCREASE: return stencil_more(was) | stencil_is(was, ~(uint64_t)0);
    case LMB_DRAW_DECREASE: return stencil_fewer(was) & ~stencil_is(was, 0);
    case LMB_DRAW_INVERT: return ~was;
    case LMB_DRAW_INCREASE_WRAP: return stencil_more(was);
    case LMB_DRAW_DECREASE_WRAP: return stencil_fewer(was);
    default: return was;
    }
}

/* Applies an operation to the pixels of the mask. */
static void stencil_apply(const lmb_draw_state *s, uint8_t *at, int32_t stride, uint64_t mask, int op)
{
    if (op == LMB_DRAW_KEEP || s->stencil_write == 0) {
        return;
    }
    for (; mask != 0; mask >>= LMB_TILE, at += stride) {
        const uint64_t written = stencil_bytes((uint32_t)mask & 0xffu) & s->stencil_write * STENCIL_ONES;
        uint64_t v;
        if (written != 0) {
            memcpy(&v, at, sizeof v);
            v = (v & ~written) | (stencil_changed(s, v, op) & written);
            memcpy(at, &v, sizeof v);
        }
    }
}

uint64_t lmb_draw_stencil(const tile_job *j, uint64_t mask)
{
    const lmb_draw_state *s = j->pass->state;
    const lmb_draw_target *t = j->pass->target;
    const uint64_t kept = s->stencil_mask * STENCIL_ONES, value = s->stencil_value * STENCIL_ONES & kept;
    uint8_t *const first = t->stencil + (ptrdiff_t)(j->y - t->y0) * t->stencil_stride + (j->x - t->x0);
    uint64_t passing = 0;
    for (int i = 0; i < LMB_TILE; ++i) {
        uint64_t v;
        if ((mask >> (LMB_TILE * i) & 0xffu) != 0) {
            memcpy(&v, first + (ptrdiff_t)i * t->stencil_stride, sizeof v);
            passing |= (uint64_t)stencil_passing(s->stencil_func, value, v & kept) << (LMB_TILE * i);
        }
    }
    passing &= mask;
    const int tests = (s->flags & LMB_DRAW_DEPTH_TEST) != 0;
    const uint64_t shown = tests && passing != 0 ? lmb_draw_rows_test(j, passing) : passing;
    stencil_apply(s, first, t->stencil_stride, mask & ~passing, s->stencil_op[0]);
    stencil_apply(s, first, t->stencil_stride, passing & ~shown, s->stencil_op[1]);
    stencil_apply(s, first, t->stencil_stride, shown, s->stencil_op[2]);
    return shown;
}
#endif
