/* unlit.c: unlit colours: sampled like the picture, and removed before the exposure. */
#include "unlit.h"

#include <stdlib.h>
#include <string.h>

#include "../picture/picture.h"

#define NOTHING 1e-4f /* below this share, light is rounding error */

/* Depth and ids of one sample, separate from those of the frame, which the next picture may use again. */
typedef struct sight {
    lmb_frame f;
    void *memory[2];
} sight;

static int sight_open(sight *s, const render_job *j)
{
    const lmb_surface *eye[2] = {&j->frame.eye.depth, &j->frame.eye.id};
    lmb_surface *own[2] = {&s->f.eye.depth, &s->f.eye.id};
    int ok = 1;
    s->f = j->frame;
    for (int i = 0; i < 2; ++i) {
        const size_t bytes = lmb_surface_bytes(eye[i]->format, eye[i]->width, eye[i]->height);
        s->memory[i] = malloc(bytes);
        ok = ok && s->memory[i] != NULL &&
             lmb_surface_init(own[i], eye[i]->format, eye[i]->width, eye[i]->height, s->memory[i], bytes) == LMB_OK;
    }
    return ok;
}

static void sight_close(sight *s)
{
    free(s->memory[0]);
    free(s->memory[1]);
}

static void add_tile(float *to, const render_job *j, const lmb_frame *f, const lmb_view *view, int32_t x0, int32_t x,
                     int32_t y)
{
    lmb_tile *tile = &f->scratch->tile;
    if (lmb_resolve_albedo(tile, f->kernels, view, f->scene, &f->eye, x, y) != LMB_OK) {
        return;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        lmb_triangle shown;
        const int is_shown = px < view->frame_width && py < view->frame_height && tile->id[k] != 0 &&
                             lmb_triangle_fetch(&shown, &j->scene, tile->id[k]);
        const lmb_material *m = is_shown ? shown.material : NULL;
        for (int c = 0; c < 3 && m != NULL && (m->flags & LMB_UNLIT) != 0; ++c) {
            to[3 * ((size_t)py * (size_t)j->linear.width + (size_t)(x0 + px)) + (size_t)c] +=
                tile->albedo[c][k] / (float)f->samples;
        }
    }
}

static lmb_status add_sample(float *to, const render_job *j, lmb_frame *f, int32_t x0, int32_t sample)
{
    lmb_view view = f->view;
    lmb_view_sample(&view, f->samples, sample);
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    const lmb_status status =
        lmb_draw(&f->eye, f->kernels, &view, f->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK | LMB_BLEND, NULL);
    for (int32_t y = 0; y < view.frame_height && status == LMB_OK; y += LMB_TILE) {
        for (int32_t x = 0; x < view.frame_width; x += LMB_TILE) {
            add_tile(to, j, f, &view, x0, x, y);
        }
    }
    return status;
}

static int is_any(const lmb_scene *s)
{
    uint32_t flags = 0;
    for (uint32_t i = 0; i < s->material_count; ++i) {
        flags |= s->materials[i].flags;
    }
    return (flags & LMB_UNLIT) != 0;
}

int unlit_colours(float **out, const render_job *j, report *r)
{
    const int32_t show = j->frame.show;
    lmb_status status = LMB_OK;
    sight s;
    *out = NULL;
    if ((show != LMB_SHOW_FULL && show != LMB_SHOW_DIRECT) || !is_any(&j->scene)) {
        return 1;
    }
    *out = calloc((size_t)j->linear.width * (size_t)j->linear.height, 3 * sizeof **out);
    const int ok = *out != NULL && sight_open(&s, j);
    for (int32_t eye = 0; ok && eye < j->eyes && status == LMB_OK; ++eye) {
        render_job_eye(j, &s.f, &j->linear, eye);
        for (int32_t i = 0; i < s.f.samples && status == LMB_OK; ++i) {
            status = add_sample(*out, j, &s.f, eye * j->o.view.width, i);
        }
    }
    const blended *b = &j->blended;
    for (size_t i = 0; ok && b->mark != NULL && i < 3 * (size_t)b->width * (size_t)b->height; ++i) {
        (*out)[i] = b->mark[i / 3] != 0 ? b->unlit[i] : (*out)[i];
    }
    if (*out != NULL) {
        sight_close(&s);
    }
    if (ok && status == LMB_OK) {
        return 1;
    }
    free(*out);
    *out = NULL;
    return ok ? report_fail(r, "%s: drawing stopped: %s", j->o.scene, lmb_status_name(status))
              : report_fail(r, "not enough memory for the colours of unlit materials; try a smaller --size");
}

float unlit_rest(float light, float unlit)
{
    const float rest = light - unlit;
    return rest > NOTHING * unlit ? rest : 0.0f;
}

void unlit_expose(image *inout, const float *unlit, float exposure_ev, int tone)
{
    const size_t values = 3 * (size_t)inout->width * (size_t)inout->height;
    for (size_t i = 0; i < values; ++i) {
        inout->pixels[i] = unlit_rest(inout->pixels[i], unlit[i]);
    }
    picture_expose(inout, exposure_ev, tone);
    for (size_t i = 0; i < values; ++i) {
        inout->pixels[i] += unlit[i];
    }
}
