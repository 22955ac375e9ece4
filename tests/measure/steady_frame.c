/* steady_frame.c: draws a frame with two settings and finds points of one frame in another. */
#include "steady_frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"

int steady_frame_make(steady_frame *f, int32_t width, int32_t height, int with_best)
{
    const size_t n = (size_t)width * (size_t)height;
    memset(f, 0, sizeof *f);
    f->width = width;
    f->height = height;
    f->light = calloc(3 * n, sizeof *f->light);
    f->best = with_best ? calloc(3 * n, sizeof *f->best) : NULL;
    f->place = calloc(n, sizeof *f->place);
    f->id = calloc(n, sizeof *f->id);
    return f->light != NULL && (f->best != NULL || !with_best) && f->place != NULL && f->id != NULL;
}

void steady_frame_free(steady_frame *f)
{
    free(f->light);
    free(f->best);
    free(f->place);
    free(f->id);
    memset(f, 0, sizeof *f);
}

/* Finds places and ids of the pixels of the last view. */
static int find_places(steady_frame *out, const render_job *j)
{
    const lmb_frame *f = &j->render->frame;
    lmb_tile *tile = &j->frame.scratch->tile;
    for (int32_t y = 0; y < out->height; y += LMB_TILE) {
        for (int32_t x = 0; x < out->width; x += LMB_TILE) {
            if (lmb_resolve_tile(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) != LMB_OK) {
                return 0;
            }
            for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
                const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
                if (px < out->width && py < out->height) {
                    const size_t to = (size_t)py * (size_t)out->width + (size_t)px;
                    out->place[to] = vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]);
                    out->id[to] = tile->id[k];
                }
            }
        }
    }
    out->view = f->view;
    return 1;
}

int steady_draw(steady_frame *out, steady_stage *s, report *r)
{
    const size_t bytes = 3 * sizeof(float) * (size_t)out->width * (size_t)out->height;
    render_job *j = &s->job;
    metrics unused;
    int32_t stage;
    render_job_eye(j, &j->frame, &j->linear, 0);
    const lmb_status status = workers_reuse(&j->workers, &stage, j->render, &j->frame);
    if (status != LMB_OK) {
        return report_fail(r, "drawing stopped: %s", lmb_status_name(status));
    }
    if (out->best != NULL) {
        if (!play_check_frame(&unused, &s->check, j, 0, r)) {
            return 0;
        }
        memcpy(out->best, s->check.best.linear.pixels, bytes);
    }
    memcpy(out->light, j->linear.pixels, bytes);
    return find_places(out, j) || report_fail(r, "a view could not be resolved");
}

static float grey(const float *rgb) { return (rgb[0] + rgb[1] + rgb[2]) / 3.0f; }

/* Projects a point to column and row, relative to the middle of the first pixel. Returns 0
 * if it lies behind the eye. */
static int project(float *x, float *y, const steady_frame *f, lmb_vec3 at)
{
    const lmb_vec3 d = sub3(at, f->view.eye);
    const float w = f->view.kind == LMB_PERSPECTIVE ? -dot3(d, f->view.back) : 1.0f;
    if (!(w > 1e-6f)) {
        return 0;
    }
    *x = (dot3(d, f->view.right) / (w * f->view.half_width) + 1.0f) * 0.5f * (float)f->width - 0.5f;
    *y = (1.0f - dot3(d, f->view.up) / (w * f->view.half_height)) * 0.5f * (float)f->height - 0.5f;
    return 1;
}

int steady_look(float *light, float *best, const steady_frame *f, const steady_frame *of, int32_t i)
{
    float x, y;
    *light = *best = 0.0f;
    if (of->id[i] == 0 || !project(&x, &y, f, of->place[i]) || !(x > -0.01f && y > -0.01f)) {
        return 0;
    }
    if (f == of || (absf(x - floorf(x + 0.5f)) < 2e-3f && absf(y - floorf(y + 0.5f)) < 2e-3f)) {
        x = floorf(x + 0.5f); /* the pixel itself except for rounding */
        y = floorf(y + 0.5f);
    }
    const int32_t x0 = (int32_t)floorf(x), y0 = (int32_t)floorf(y);
    const float u = x - (float)x0, v = y - (float)y0;
    for (int k = 0; k < 4; ++k) {
        const float share = (k & 1 ? u : 1.0f - u) * (k & 2 ? v : 1.0f - v);
        const int32_t px = x0 + (k & 1), py = y0 + k / 2;
        if (share == 0.0f) {
            continue;
        }
        if (px < 0 || py < 0 || px >= f->width || py >= f->height || f->id[py * f->width + px] != of->id[i]) {
            return 0;
        }
        *light += share * grey(f->light + 3 * (py * f->width + px));
        *best += f->best != NULL ? share * grey(f->best + 3 * (py * f->width + px)) : 0.0f;
    }
    return 1;
}
