/* laid_surface.h: a test's surface in its memory, tiled or in rows. */
#ifndef LAID_SURFACE_H
#define LAID_SURFACE_H

#include <lambent/lambent.h>

static inline lmb_surface surface_of(int32_t format, int32_t layout, int32_t width, int32_t height, void *data)
{
    lmb_surface s;
    lmb_surface_init(&s, format, width, height, data, lmb_surface_bytes(format, width, height));
    if (layout == LMB_LINEAR) {
        s.layout = LMB_LINEAR;
        s.stride_bytes /= LMB_TILE;
    }
    return s;
}

#endif
