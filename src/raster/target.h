/* target.h: memory layout of a window's tiles, and 16-bit depth codes. Layer 3. */
#ifndef LMB_RASTER_TARGET_H
#define LMB_RASTER_TARGET_H

#include "../lane/kernels.h"

/* Sample position of the frame's pixel (0, 0), from the frame's centre to the right and down, 1/256 px. */
static inline int32_t view_origin_x(const lmb_view *v)
{
    return 128 - v->frame_width * 128 + (LMB_MULTISAMPLE ? v->sample_x : 0);
}
static inline int32_t view_origin_y(const lmb_view *v)
{
    return 128 - v->frame_height * 128 + (LMB_MULTISAMPLE ? v->sample_y : 0);
}

/* Sets the view's sample position, and the window's pixels in the frame. */
static inline void job_window(lmb_setup_job *job, const lmb_view *view, const lmb_target *target)
{
    job->origin_x = view_origin_x(view);
    job->origin_y = view_origin_y(view);
    job->x0 = target->x0;
    job->y0 = target->y0;
    job->x1 = target->x0 + target->depth.width - 1;
    job->y1 = target->y0 + target->depth.height - 1;
}

/* 1 if the view can be drawn. */
int lmb_view_is_valid(const lmb_view *view);

/* LMB_OK if a scene of this many triangles can be drawn into the window; otherwise the error of lmb_draw. */
lmb_status lmb_target_check(const lmb_target *target, const lmb_view *view, uint32_t triangles);

/* lmb_target_rows: the window of tile rows first .. first + count - 1 of a target, in the same memory; fewer if the
 * target ends before. 0 <= first < tile rows of the target, count >= 1. */
void lmb_target_rows(lmb_target *out, const lmb_target *target, int32_t first, int32_t count);

/* Address one tile of a window. */
lmb_fill_tile lmb_target_tile(const lmb_target *target, int32_t tile_x, int32_t tile_y);

/* The window in the form the fill kernels use. */
lmb_fill_window lmb_target_window(const lmb_target *target, const lmb_view *view);

/* 16-bit depth codes: code = d * scale + bias. */
void lmb_depth16_coding(float *scale, float *bias, const lmb_view *view);

#endif
