/* draw_case.h: a small target with a guard around it, and what tests draw into it. */
#ifndef DRAW_CASE_H
#define DRAW_CASE_H

#include "test.h"

#include <lambent/draw.h>

#include <string.h>

#if LMB_DRAW
enum { CASE_WIDE = 40, CASE_HIGH = 32, CASE_TILED = 40 * 32 };

/* Colours, depth and stencil of CASE_WIDE x CASE_HIGH pixels. */
static struct {
    uint32_t before[64];
    uint8_t colour[CASE_HIGH][CASE_WIDE][4];
    uint32_t between[64];
    float depth[CASE_TILED];
    uint8_t stencil[CASE_HIGH][CASE_WIDE];
    uint32_t after[64];
} drawn;
static lmb_draw_target drawn_on;
static lmb_draw_state state;

static inline void case_begin(void)
{
    memset(&drawn, 0, sizeof drawn);
    memset(&drawn_on, 0, sizeof drawn_on);
    CHECK(lmb_surface_init(&drawn_on.colour, LMB_RGBA8, CASE_WIDE, CASE_HIGH, drawn.colour, sizeof drawn.colour) ==
          LMB_OK);
    CHECK(lmb_surface_init(&drawn_on.depth, LMB_DEPTH32F, CASE_WIDE, CASE_HIGH, drawn.depth, sizeof drawn.depth) ==
          LMB_OK);
    drawn_on.stencil = &drawn.stencil[0][0];
    drawn_on.stencil_stride = CASE_WIDE;
    CHECK(lmb_draw_state_init(&state, CASE_WIDE, CASE_HIGH) == LMB_OK && lmb_draw_pixels(&state) == LMB_OK);
}

static inline int case_guard_is_whole(void)
{
    static const uint32_t zeros[64];
    return memcmp(drawn.before, zeros, sizeof zeros) == 0 && memcmp(drawn.between, zeros, sizeof zeros) == 0 &&
           memcmp(drawn.after, zeros, sizeof zeros) == 0;
}

/* Primitives of plain positions; colours NULL: the state's. */
static inline lmb_status case_draw(int32_t primitive, const float (*corners)[3], const uint8_t *colours, uint32_t count)
{
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    v.positions = corners;
    v.colours = colours;
    v.count = count;
    return lmb_draw_list(&drawn_on, &state, &v, primitive, NULL, NULL);
}

/* A rectangle of pixels x0 .. x1 - 1, y0 .. y1 - 1. */
static inline lmb_status case_rectangle(float x0, float y0, float x1, float y1, float d)
{
    const float c[4][3] = {{x0, y0, d}, {x0, y1, d}, {x1, y1, d}, {x1, y0, d}};
    return case_draw(LMB_DRAW_QUADS, c, NULL, 4);
}

/* Counts how often each pixel is drawn, in the stencil. */
static inline void case_count(void)
{
    memset(drawn.stencil, 0, sizeof drawn.stencil);
    state.flags |= LMB_DRAW_STENCIL;
    state.stencil_func = LMB_DRAW_ALWAYS;
    state.stencil_op[2] = LMB_DRAW_INCREASE;
}

static inline int case_counted(int low, int high)
{
    int n = 0;
    for (int y = 0; y < CASE_HIGH; ++y) {
        for (int x = 0; x < CASE_WIDE; ++x) {
            n += drawn.stencil[y][x] >= low && drawn.stencil[y][x] <= high;
        }
    }
    return n;
}
#endif

#endif
