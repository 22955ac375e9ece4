/* target.h: where a window's tiles lie in memory, and how 16 bits encode depth. Layer 3. */
#ifndef LMB_RASTER_TARGET_H
#define LMB_RASTER_TARGET_H

#include "../lane/kernels.h"

/* Where the frame's pixel (0, 0) is seen, from the frame's middle to the right and down, 1/256 px. */
static inline int32_t view_origin_x(const lmb_view *v)
{
    return 128 - v->frame_width * 128 + (LMB_MULTISAMPLE ? v->sample_x : 0);
}
static inline int32_t view_origin_y(const lmb_view *v)
{
    return 128 - v->frame_height * 128 + (LMB_MULTISAMPLE ? v->sample_y : 0);
}

/* Where the view's samples lie, and the window's pixels of the frame. */
static inline void job_window(lmb_setup_job *job, const lmb_view *view, const lmb_target *target)
{
    job->origin_x = view_origin_x(view);
    job->origin_y = view_origin_y(view);
    job->x0 = target->x0;
    job->y0 = target->y0;
    job->x1 = target->x0 + target->depth.width - 1;
    job->y1 = target->y0 + target->depth.height - 1;
}

/* Can a frame be seen this way? */
int lmb_view_is_valid(const lmb_view *view);

/* LMB_OK where a scene of so many triangles can be drawn into the window; else what lmb_draw returns. */
lmb_status lmb_target_check(const lmb_target *target, const lmb_view *view, uint32_t triangles);

/* lmb_target_rows: the window of tile rows first .. first + count - 1 of a target, in the target's own memory; fewer
 * where it ends before. 0 <= first < its tile rows, count >= 1. */
void lmb_target_rows(lmb_target *out, const lmb_target *target, int32_t first, int32_t count);

/* Address one tile of a window. */
lmb_fill_tile lmb_target_tile(const lmb_target *target, int32_t tile_x, int32_t tile_y);

/* The window as the fill kernels address it. */
lmb_fill_window lmb_target_window(const lmb_target *target, const lmb_view *view);

/* 16-bit depth codes: code = d * scale + bias. */
void lmb_depth16_coding(float *scale, float *bias, const lmb_view *view);

#endif
