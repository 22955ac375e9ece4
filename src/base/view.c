/* view.c: a camera from position and target, and the sample positions in a pixel. Layer 1. */
#include "poly.h"
#include "vec.h"

#define DEFAULT_NEAR_M 0.01f
#define DEFAULT_FAR_M 1000.0f
#define MIN_HALF 1e-30f /* limit of lmb_view */

/* The cross product of nearly parallel vectors has few significant bits, so its remaining component along `back` is
 * removed. */
static int look_axes(lmb_view *v, lmb_vec3 along, lmb_vec3 up)
{
    if (!(dot3(along, along) > 1e-12f && dot3(up, up) > 1e-37f))
        return 0;
    v->back = normalize3(along);
    v->right = cross3(normalize3(up), v->back);
    if (!(dot3(v->right, v->right) > 1e-10f)) /* under 1e-5 rad apart */
        return 0;
    v->right = normalize3(v->right);
    v->right = normalize3(sub3(v->right, mul3(v->back, dot3(v->right, v->back))));
    v->up = normalize3(cross3(v->back, v->right));
    return 1;
}

lmb_status lmb_view_look_at(lmb_view *out, lmb_vec3 eye, lmb_vec3 target, lmb_vec3 up, float vfov_rad, int32_t width,
                            int32_t height)
{
    lmb_view v;
    if (!out || !is_place(eye) || !is_place(target) || !is_place(up) || !(vfov_rad > 0.0f && vfov_rad < LMB_PI))
        return LMB_ERR_ARG;
    if (width < 1 || width > LMB_MAX_FRAME || height < 1 || height > LMB_MAX_FRAME)
        return LMB_ERR_ARG;
    if (!look_axes(&v, sub3(eye, target), up))
        return LMB_ERR_ARG;
    v.eye = eye;
    v.half_height = lmb_tan(0.5f * vfov_rad);
    v.half_width = v.half_height * ((float)width / (float)height);
    if (!(minf(v.half_width, v.half_height) > MIN_HALF)) /* the tangent near pi / 2 may even be negative */
        return LMB_ERR_ARG;
    v.near_m = DEFAULT_NEAR_M;
    v.far_m = DEFAULT_FAR_M;
    v.kind = LMB_PERSPECTIVE;
    v.frame_width = width;
    v.frame_height = height;
    v.sample_x = v.sample_y = 0;
    *out = v;
    return LMB_OK;
}

#if LMB_MULTISAMPLE

lmb_status lmb_view_sample(lmb_view *inout, int32_t samples, int32_t i)
{
    /* Offsets from the middle, right and down, in 1/16 px. */
    static const int8_t by_4[][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    static const int8_t by_8[][2] = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
    static const int8_t by_16[][2] = {{1, 1},  {-1, -3}, {-3, 2},  {4, -1}, {-5, -2}, {2, 5},  {5, 3}, {3, -5},
                                      {-2, 6}, {0, -7},  {-4, -6}, {-6, 4}, {-8, 0},  {7, -4}, {6, 7}, {-7, -8}};
    static const int8_t middle[][2] = {{0, 0}};
    const int8_t(*at)[2] = samples == 1 ? middle : samples == 4 ? by_4 : samples == 8 ? by_8 : by_16;
    if (inout == NULL || i < 0 || i >= samples || (samples != 1 && samples != 4 && samples != 8 && samples != 16)) {
        return LMB_ERR_ARG;
    }
    inout->sample_x = at[i][0] * 16;
    inout->sample_y = at[i][1] * 16;
    return LMB_OK;
}

#endif
