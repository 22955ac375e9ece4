/* surface_check.h: checks that a surface's numbers describe memory. Layer 1. */
#ifndef LMB_BASE_SURFACE_CHECK_H
#define LMB_BASE_SURFACE_CHECK_H

#include <lambent/surface.h>

/* 1 if the surface has data, a known format, a valid size, a stride of at least a row, and data and stride aligned to
 * the values. */
int lmb_surface_is_valid(const lmb_surface *surface);

/* 1 for formats of a finished picture's colours. */
static inline int is_colour_format(int32_t format)
{
    return format >= LMB_RGB565 && format <= LMB_RGB32F && format != LMB_R32F;
}

#endif
