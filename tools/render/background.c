/* background.c: the share of each pixel that surfaces cover, and the background behind them. */
#include "background.h"

#include <stdlib.h>

#include "../picture/image.h"

static void add_tile(float *cover, const render_job *j, const lmb_frame *f, const lmb_view *view, int32_t x0, int32_t x,
                     int32_t y)
{
    lmb_tile *tile = &f->scratch->tile;
    if (lmb_resolve_albedo(tile, f->kernels, view, f->scene, &f->eye, x, y) != LMB_OK) {
        return;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        if (px < view->frame_width && py < view->frame_height && tile->id[k] != 0) {
            cover[(size_t)py * (size_t)j->linear.width + (size_t)(x0 + px)] += 1.0f / (float)f->samples;
        }
    }
}

static lmb_status add_sample(float *cover, const render_job *j, lmb_frame *f, int32_t x0, int32_t sample)
{
    lmb_view view = f->view;
    lmb_view_sample(&view, f->samples, sample);
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    const lmb_status status =
        lmb_draw(&f->eye, f->kernels, &view, f->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK | LMB_BLEND, NULL);
    for (int32_t y = 0; y < view.frame_height && status == LMB_OK; y += LMB_TILE) {
        for (int32_t x = 0; x < view.frame_width; x += LMB_TILE) {
            add_tile(cover, j, f, &view, x0, x, y);
        }
    }
    return status;
}

float *background_cover(const render_job *j, report *r)
{
    lmb_frame f = j->frame;
    lmb_status status = LMB_OK;
    float *cover = calloc((size_t)j->linear.width * (size_t)j->linear.height, sizeof *cover);
    if (cover == NULL) {
        report_fail(r, "%s: not enough memory for the background; try a smaller --size", j->o.out);
        return NULL;
    }
    for (int32_t eye = 0; eye < j->eyes && status == LMB_OK; ++eye) {
        render_job_eye(j, &f, &j->linear, eye);
        for (int32_t i = 0; i < f.samples && status == LMB_OK; ++i) {
            status = add_sample(cover, j, &f, eye * j->o.view.width, i);
        }
    }
    const blended *b = &j->blended;
    for (size_t i = 0; b->mark != NULL && i < (size_t)b->width * (size_t)b->height; ++i) {
        cover[i] = b->mark[i] != 0 ? b->cover[i] : cover[i];
    }
    if (status != LMB_OK) {
        report_fail(r, "%s: drawing stopped: %s", j->o.scene, lmb_status_name(status));
        free(cover);
        return NULL;
    }
    return cover;
}

void background_colour(image *inout, const uint8_t rgb[3], const float *cover)
{
    const size_t pixels = (size_t)inout->width * (size_t)inout->height;
    for (int c = 0; c < 3; ++c) {
        const float light = (float)srgb_decode(rgb[c]);
        for (size_t i = 0; i < pixels; ++i) {
            inout->pixels[3 * i + (size_t)c] += (1.0f - cover[i]) * light;
        }
    }
}
