/* strips.h: the memory of a picture of 160x120 in RGB565, drawn by strips of 24 rows. Include it in one file. */
#ifndef LMB_CORTEX_M_STRIPS_H
#define LMB_CORTEX_M_STRIPS_H

#include <lambent/render.h>

enum { WIDTH = 160, HEIGHT = 120, STRIP = 24 };

/* Words, for alignment to 4. Depth and id consist of whole tiles: sides are multiples of 8. */
static uint32_t picture[WIDTH * HEIGHT / 2];
static uint32_t strip_depth[WIDTH * STRIP];
static uint32_t strip_id[WIDTH * STRIP / 2];

static lmb_status place_strips(lmb_frame *frame)
{
    lmb_status s = lmb_surface_init(&frame->out, LMB_RGB565, WIDTH, HEIGHT, picture, sizeof picture);
    if (s == LMB_OK)
        s = lmb_surface_init(&frame->eye.depth, LMB_DEPTH32F, WIDTH, STRIP, strip_depth, sizeof strip_depth);
    if (s == LMB_OK)
        s = lmb_surface_init(&frame->eye.id, LMB_ID16, WIDTH, STRIP, strip_id, sizeof strip_id);
    return s;
}

#endif
