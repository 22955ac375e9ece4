/* render_exposure.c: a picture's stops, by the light that surfaces reflect. */
#include "render_exposure.h"

#include <stdlib.h>
#include <string.h>

#include "../picture/picture.h"

#define NOTHING 1e-4f /* what is left of a glow's light counts from this share of it on: less is rounding */

/* A tile of the eye drawn last, without what its surfaces emit. 1 where anything is left. */
static int put_reflected(image *out, const render_job *j, int32_t x, int32_t y)
{
    const lmb_frame *f = &j->render->frame;
    lmb_tile *tile = &j->frame.scratch->tile;
    lmb_radiance *own = &j->frame.scratch->radiance;
    int any = 0;
    memset(own, 0, sizeof *own);
    if (lmb_resolve_albedo(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) == LMB_OK) {
        lmb_compose_emission(own, f->scene, &f->view, tile);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        for (int c = 0; c < 3 && px < out->width && py < out->height; ++c) {
            const size_t from = (size_t)py * (size_t)j->linear.width + (size_t)(j->linear.width - out->width + px);
            const float rest = j->linear.pixels[3 * from + (size_t)c] - own->rgb[c][k];
            const int is_light = rest > NOTHING * own->rgb[c][k];
            out->pixels[3 * ((size_t)py * (size_t)out->width + (size_t)px) + (size_t)c] = is_light ? rest : 0.0f;
            any |= is_light;
        }
    }
    return any;
}

int render_exposure(float *ev, const render_job *j, report *r)
{
    const int32_t show = j->frame.show;
    const int glows = lmb_scene_emits(&j->scene) && (show == LMB_SHOW_FULL || show == LMB_SHOW_DIRECT);
    image reflected = {j->o.view.width, j->linear.height, 3, NULL};
    int any = 0;
    if (glows) {
        reflected.pixels = calloc((size_t)reflected.width * (size_t)reflected.height, 3 * sizeof(float));
        if (reflected.pixels == NULL) {
            return report_fail(r, "%s: not enough memory to expose the picture; give --exposure", j->o.out);
        }
    }
    for (int32_t y = 0; glows && y < reflected.height; y += LMB_TILE) {
        for (int32_t x = 0; x < reflected.width; x += LMB_TILE) {
            any |= put_reflected(&reflected, j, x, y);
        }
    }
    *ev = picture_auto_exposure(any ? &reflected : &j->linear) + 0.0f; /* no minus zero */
    image_free(&reflected);
    return 1;
}
