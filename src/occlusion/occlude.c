/* occlude.c: prepares the viewer's depth map for the gather's march. Layer 4. [V24 V26] */
#include "occlude.h"

#include "../raster/target.h"

int32_t lmb_march_setup(lmb_march_job *m, const lmb_occluder *o)
{
    if (o == NULL || o->kind == LMB_OCCLUSION_NONE) {
        return 0;
    }
    const lmb_view *v = o->view;
    const lmb_surface *d = o->depth;
    if (v == NULL || d == NULL || d->data == NULL || o->steps < 1 || o->steps > 64 || d->width != v->frame_width ||
        d->height != v->frame_height || o->kind < LMB_OCCLUSION_NONE || o->kind > LMB_OCCLUSION_VIEW_WORLD) {
        return LMB_ERR_ARG;
    }
    if (d->format != LMB_DEPTH32F && d->format != LMB_DEPTH16) {
        return LMB_ERR_FORMAT;
    }
    m->depth_32 = d->format == LMB_DEPTH32F ? (const float *)d->data : NULL;
    m->depth_16 = d->format == LMB_DEPTH16 ? (const uint16_t *)d->data : NULL;
    m->tiled = d->layout == LMB_TILED;
    m->row_step = d->stride_bytes / lmb_pixel_bytes(d->format);
    m->last_x = (float)(d->width - 1);
    m->last_y = (float)(d->height - 1);
    m->eye = v->eye;
    m->right = v->right;
    m->up = v->up;
    m->back = v->back;
    m->middle_x = 0.5f * (float)v->frame_width;
    m->middle_y = 0.5f * (float)v->frame_height;
    m->scale_x = m->middle_x / v->half_width;
    m->scale_y = m->middle_y / v->half_height;
    m->near_m = v->near_m;
    m->far_m = v->far_m;
    m->kind = o->kind;
    m->steps = o->steps;
    m->perspective = v->kind == LMB_PERSPECTIVE;
    m->slack = 1e-4f;
    m->d16_scale = m->d16_bias = 0.0f;
    if (d->format == LMB_DEPTH16) {
        float scale, bias;
        lmb_depth16_coding(&scale, &bias, v);
        m->d16_scale = 1.0f / scale; /* codes are truncated, so this is the far end: it occludes less, not more */
        m->d16_bias = -bias / scale;
        m->slack = 1e-3f;
    }
    return 1;
}
