/* setup.h: three screen vertices -> edge functions and a depth plane. Layer 3. */
#ifndef LMB_RASTER_SETUP_H
#define LMB_RASTER_SETUP_H

#include "../lane/kernels.h"

/* 24.8 fixed point, from the centre of the frame, y down. */
typedef struct lmb_screen_vertex {
    int32_t x_24_8, y_24_8;
    float d;
} lmb_screen_vertex;

/* Twice the area, 24.8 squared: positive if clockwise in the picture, because y points down. */
static inline int64_t setup_area(const lmb_screen_vertex *a, const lmb_screen_vertex *b, const lmb_screen_vertex *c)
{
    return (int64_t)(b->x_24_8 - a->x_24_8) * (c->y_24_8 - a->y_24_8) -
           (int64_t)(c->x_24_8 - a->x_24_8) * (b->y_24_8 - a->y_24_8);
}

/* Returns 1, or 0 for a triangle without area. */
int lmb_setup_triangle(lmb_setup *out, const lmb_screen_vertex *a, const lmb_screen_vertex *b,
                       const lmb_screen_vertex *c);

/* Edge i at the centre of pixel (x, y) of the frame: floor(E / 256), exact. */
static inline int64_t setup_edge(const lmb_setup *s, int i, int64_t x_24_8, int64_t y_24_8)
{
    return (s->e_origin[i] + s->ex[i] * x_24_8 + s->ey[i] * y_24_8) >> 8;
}

#endif
