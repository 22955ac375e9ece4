/* draw_state.c: a state's defaults, matrices for views and pixels, and checks of all numbers. Layer 4. */
#include "draw_part.h"

#include <string.h>

#include "../base/surface_check.h"
#include "../raster/target.h"

#if LMB_DRAW
enum { STATE_FAR = 2 * LMB_MAX_FRAME }; /* px: largest offset of rectangles */

static int state_is_finite(float v) { return v > -1e30f && v < 1e30f; }

static int state_are_finite(const float *v, int n)
{
    int good = 1;
    for (int i = 0; i < n; ++i) {
        good &= state_is_finite(v[i]);
    }
    return good;
}

static int state_is_size(int32_t width, int32_t height)
{
    return width >= 1 && height >= 1 && width <= LMB_MAX_FRAME && height <= LMB_MAX_FRAME;
}

lmb_status lmb_draw_state_init(lmb_draw_state *out, int32_t width, int32_t height)
{
    if (out == NULL || !state_is_size(width, height)) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 4; ++i) {
        out->to_clip.m[5 * i] = 1.0f;
        out->colour[i] = 255;
    }
    out->viewport[2] = out->scissor[2] = width;
    out->viewport[3] = out->scissor[3] = height;
    out->depth_range[1] = 1.0f;
    out->depth_func = LMB_DRAW_GREATER;
    out->alpha_func = out->stencil_func = LMB_DRAW_ALWAYS;
    out->colour_mask = 15;
    out->stencil_mask = out->stencil_write = 255;
    out->blend_source[0] = out->blend_source[1] = LMB_DRAW_ONE;
    out->logic_op = 3;
    out->line_px = out->point_px = 1;
    out->fog_end = 1.0f;
    out->line_pattern = 0xffff;
    out->line_repeat = 1;
    return LMB_OK;
}

/* Sets a row of to_clip: axis . (to_world . p - eye), scaled. */
static void state_set_row(lmb_mat4 *to_clip, int row, lmb_vec3 axis, const lmb_mat4 *t, lmb_vec3 eye)
{
    const float *m = t->m;
    for (int c = 0; c < 3; ++c) {
        to_clip->m[4 * c + row] = dot3(axis, vec3(m[4 * c], m[4 * c + 1], m[4 * c + 2]));
    }
    to_clip->m[12 + row] = dot3(axis, sub3(vec3(m[12], m[13], m[14]), eye));
}

lmb_status lmb_draw_view(lmb_draw_state *inout, const lmb_view *view, const lmb_mat4 *to_world)
{
    if (inout == NULL || view == NULL || to_world == NULL || !lmb_view_is_valid(view) ||
        !state_are_finite(to_world->m, 16)) {
        return LMB_ERR_ARG;
    }
    lmb_mat4 *m = &inout->to_clip;
    state_set_row(m, 0, mul3(view->right, 1.0f / view->half_width), to_world, view->eye);
    state_set_row(m, 1, mul3(view->up, 1.0f / view->half_height), to_world, view->eye);
    state_set_row(m, 3, mul3(view->back, -1.0f), to_world, view->eye);
    for (int c = 0; c < 4; ++c) {
        inout->fog_axis[c] = m->m[4 * c + 3];
        m->m[4 * c + 2] = 0.0f;
    }
    m->m[14] = view->near_m;
    if (view->kind == LMB_ORTHOGRAPHIC) {
        const float scale = 1.0f / (view->far_m - view->near_m);
        for (int c = 0; c < 4; ++c) {
            m->m[4 * c + 2] = -inout->fog_axis[c] * scale;
            m->m[4 * c + 3] = c == 3 ? 1.0f : 0.0f;
        }
        m->m[14] += view->far_m * scale;
    }
    inout->viewport[0] = inout->viewport[1] = 0;
    inout->viewport[2] = view->frame_width;
    inout->viewport[3] = view->frame_height;
    return LMB_OK;
}

lmb_status lmb_draw_pixels(lmb_draw_state *inout)
{
    if (inout == NULL || !state_is_size(inout->viewport[2], inout->viewport[3])) {
        return LMB_ERR_ARG;
    }
    memset(&inout->to_clip, 0, sizeof inout->to_clip);
    inout->to_clip.m[0] = 2.0f / (float)inout->viewport[2];
    inout->to_clip.m[5] = -2.0f / (float)inout->viewport[3];
    inout->to_clip.m[10] = inout->to_clip.m[13] = inout->to_clip.m[15] = 1.0f;
    inout->to_clip.m[12] = -1.0f;
    return LMB_OK;
}

/* --- checks ------------------------------------------------------------------------------------------------------- */

static int state_is_place(int32_t v) { return v >= -STATE_FAR && v <= STATE_FAR; }

/* Checks the size against the one so far, or sets it. */
static int state_has_size(const lmb_surface *s, int32_t *width, int32_t *height)
{
    if (*width == 0) {
        *width = s->width;
        *height = s->height;
    }
    return s->width == *width && s->height == *height;
}

lmb_status lmb_draw_check_target(const lmb_draw_target *t)
{
    int32_t width = 0, height = 0;
    if (t->x0 < 0 || t->y0 < 0 || t->x0 > LMB_MAX_FRAME || t->y0 > LMB_MAX_FRAME || t->x0 % LMB_TILE != 0 ||
        t->y0 % LMB_TILE != 0 || (t->colour.data == NULL && t->depth.data == NULL)) {
        return LMB_ERR_ARG;
    }
    if (t->colour.data != NULL) {
        if (!is_colour_format(t->colour.format) || t->colour.format == LMB_RGB32F) {
            return LMB_ERR_FORMAT;
        }
        if (t->colour.layout != LMB_LINEAR || !lmb_surface_is_valid(&t->colour) ||
            !state_has_size(&t->colour, &width, &height)) {
            return LMB_ERR_ARG;
        }
    }
    if (t->depth.data != NULL) {
        if (t->depth.format != LMB_DEPTH32F && t->depth.format != LMB_DEPTH16) {
            return LMB_ERR_FORMAT;
        }
        if (!lmb_surface_is_valid(&t->depth) || !state_has_size(&t->depth, &width, &height) ||
            !(t->depth_far >= 0.0f && t->depth_far <= 0.999f)) {
            return LMB_ERR_ARG;
        }
    }
    return t->stencil != NULL && t->stencil_stride < width ? LMB_ERR_ARG : LMB_OK;
}

static int state_combines(const lmb_draw_combine *c)
{
    int good = c->func[0] <= LMB_DRAW_DOT4 && c->func[1] <= LMB_DRAW_DIFFERENCE;
    for (int i = 0; i < 2; ++i) {
        good &= c->shift[i] <= 2;
        for (int k = 0; k < 3; ++k) {
            good &= c->source[i][k] < LMB_DRAW_FROM_STAGE + LMB_DRAW_STAGES &&
                    c->operand[i][k] <= LMB_DRAW_TAKE_INVERSE_ALPHA;
        }
    }
    return good;
}

static lmb_status state_check_stage(const lmb_draw_stage *s)
{
    const lmb_texture *t = s->texture;
    if (s->mode > LMB_DRAW_COMBINE || !state_combines(&s->combine) ||
        !(s->level_bias >= -16.0f && s->level_bias <= 16.0f)) {
        return LMB_ERR_ARG;
    }
    if (t == NULL) {
        return LMB_OK;
    }
    if (t->format > (LMB_TEXTURE_FORMATS ? LMB_TEXELS_PALETTE4 : LMB_TEXELS_RGBA8) || t->wrap_s > LMB_WRAP_MIRROR ||
        t->wrap_t > LMB_WRAP_MIRROR || t->filter > LMB_TRILINEAR) {
        return LMB_ERR_FORMAT;
    }
    if (t->texels == NULL || t->width > LMB_MAX_SIDE || t->height > LMB_MAX_SIDE || t->width == 0 || t->height == 0 ||
        t->levels == 0 || t->levels > lmb_texture_level_count(t->width, t->height)) {
        return LMB_ERR_ARG;
    }
    return t->format == LMB_TEXELS_RGB565 && (uintptr_t)t->texels % 2 != 0 ? LMB_ERR_ALIGN : LMB_OK;
}

static int state_has_good_places(const lmb_draw_state *s)
{
    return state_is_place(s->viewport[0]) && state_is_place(s->viewport[1]) &&
           state_is_size(s->viewport[2], s->viewport[3]) && state_is_place(s->scissor[0]) &&
           state_is_place(s->scissor[1]) && s->scissor[2] >= 0 && s->scissor[3] >= 0 && s->scissor[2] <= STATE_FAR &&
           s->scissor[3] <= STATE_FAR && s->line_px >= 1 && s->point_px >= 1 && s->line_repeat >= 1 &&
           s->line_repeat <= 256;
}

static int state_has_good_numbers(const lmb_draw_state *s)
{
    return state_are_finite(s->to_clip.m, 16) && state_are_finite(&s->plane[0][0], 4 * LMB_DRAW_PLANES) &&
           state_are_finite(s->fog_axis, 4) && state_is_finite(s->offset_slope) && state_is_finite(s->offset_units) &&
           s->depth_range[0] >= 0.0f && s->depth_range[0] <= 1.0f && s->depth_range[1] >= 0.0f &&
           s->depth_range[1] <= 1.0f && state_is_finite(s->fog_start) && state_is_finite(s->fog_end) &&
           s->fog_density >= 0.0f && s->fog_density < 1e15f &&
           (s->fog != LMB_DRAW_FOG_LINEAR || s->fog_start != s->fog_end);
}

static int state_has_good_choices(const lmb_draw_state *s)
{
    int good = s->flags <= LMB_DRAW_FLAGS && s->planes < 1u << LMB_DRAW_PLANES && s->fog <= LMB_DRAW_FOG_EXP2 &&
               s->depth_func <= LMB_DRAW_ALWAYS && s->alpha_func <= LMB_DRAW_ALWAYS && s->colour_mask <= 15 &&
               s->stencil_func <= LMB_DRAW_ALWAYS && s->logic_op <= 15 &&
               s->polygon_mode[0] <= LMB_DRAW_CORNERS && s->polygon_mode[1] <= LMB_DRAW_CORNERS;
    for (int i = 0; i < 3; ++i) {
        good &= s->stencil_op[i] <= LMB_DRAW_DECREASE_WRAP;
    }
    for (int i = 0; i < 2; ++i) {
        good &= s->blend_source[i] <= LMB_DRAW_INVERSE_CONSTANT_ALPHA &&
                s->blend_target[i] <= LMB_DRAW_INVERSE_CONSTANT_ALPHA && s->blend_target[i] != LMB_DRAW_SATURATE &&
                s->blend_equation[i] <= LMB_DRAW_MAX;
    }
    return good;
}

/* 1 if this build supports the state. */
static int state_is_here(const lmb_draw_state *s)
{
    const uint32_t flags = LMB_DRAW_STENCIL | LMB_DRAW_LOGIC | LMB_DRAW_DISCARDS;
    return DRAW_FULL || ((s->flags & flags) == 0 && s->fog == LMB_DRAW_FOG_NONE && s->planes == 0 &&
                         s->offset_slope == 0.0f && s->offset_units == 0.0f && s->area_pattern == NULL &&
                         s->shader == NULL && s->passed == NULL &&
                         (s->polygon_mode[0] | s->polygon_mode[1]) == LMB_DRAW_FILL &&
                         s->stage[0].mode < LMB_DRAW_COMBINE && s->stage[1].mode < LMB_DRAW_COMBINE);
}

lmb_status lmb_draw_check_state(const lmb_draw_state *s, const lmb_draw_target *t)
{
    if (!state_is_here(s) || !state_has_good_choices(s) || !state_has_good_numbers(s) || !state_has_good_places(s) ||
        ((s->flags & LMB_DRAW_DEPTH_TEST) != 0 && t->depth.data == NULL) ||
        ((s->flags & LMB_DRAW_STENCIL) != 0 && t->stencil == NULL)) {
        return LMB_ERR_ARG;
    }
    for (int i = 0; i < LMB_DRAW_STAGES; ++i) {
        const lmb_status status = state_check_stage(&s->stage[i]);
        if (status != LMB_OK) {
            return status;
        }
    }
    return LMB_OK;
}
#endif
