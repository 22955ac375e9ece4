/* render_exposure.c: a picture's stops, by the light that surfaces reflect. */
#include "render_exposure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../picture/picture.h"
#include "background.h"

#define GROUND_EV 1.25f
#define NOTHING   1e-4f /* what is left of a glow's light counts from this share of it on: less is rounding */

/* What the surfaces of a tile of the eye drawn last emit. */
static void put_emitted(image *out, const render_job *j, int32_t x, int32_t y)
{
    const lmb_frame *f = &j->render->frame;
    lmb_tile *tile = &j->frame.scratch->tile;
    lmb_radiance *own = &j->frame.scratch->radiance;
    memset(own, 0, sizeof *own);
    if (lmb_resolve_albedo(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) == LMB_OK) {
        lmb_compose_emission(own, f->scene, &f->view, tile);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        for (int c = 0; c < 3 && px < out->width && py < out->height; ++c) {
            out->pixels[3 * ((size_t)py * (size_t)out->width + (size_t)px) + (size_t)c] = own->rgb[c][k];
        }
    }
}

static float emitted_at(const image *emitted, int32_t x, int32_t y, int c)
{
    const int is_inside = x >= 0 && y >= 0 && x < emitted->width && y < emitted->height;
    return is_inside ? emitted->pixels[3 * ((size_t)y * (size_t)emitted->width + (size_t)x) + (size_t)c] : 0.0f;
}

/* Samples of a pixel may show what emits in a pixel beside it. */
static int is_beside_emitted(const image *emitted, int32_t x, int32_t y)
{
    float brightest = 0.0f;
    for (int i = 0; i < 27; ++i) {
        const float e = emitted_at(emitted, x + i % 3 - 1, y + i / 3 % 3 - 1, i / 9);
        brightest = e > brightest ? e : brightest;
    }
    return brightest > 0.0f;
}

/* The picture without what is emitted. 1 where anything is left. */
static int put_reflected(image *out, const render_job *j, const image *emitted)
{
    int any = 0;
    for (int32_t y = 0; y < out->height; ++y) {
        for (int32_t x = 0; x < out->width; ++x) {
            const size_t from = (size_t)y * (size_t)j->linear.width + (size_t)(j->linear.width - out->width + x);
            const int mixed = j->frame.samples > 1 && is_beside_emitted(emitted, x, y);
            for (int c = 0; c < 3; ++c) {
                const float emits = emitted_at(emitted, x, y, c);
                const float rest = j->linear.pixels[3 * from + (size_t)c] - emits;
                const int is_light = !mixed && rest > NOTHING * emits;
                out->pixels[3 * ((size_t)y * (size_t)out->width + (size_t)x) + (size_t)c] = is_light ? rest : 0.0f;
                any |= is_light;
            }
        }
    }
    return any;
}

static int covers_any(const float *cover, const render_job *j)
{
    const size_t pixels = (size_t)j->linear.width * (size_t)j->linear.height;
    size_t i = 0;
    while (i < pixels && cover[i] < 1.0f) {
        ++i;
    }
    return i < pixels;
}

/* The picture without the world behind its surfaces, where there are any, in `inout`'s place: of all eyes, or of the last. */
static int leave_background(image *inout, const render_job *j, report *r)
{
    float *cover = background_cover(j, r);
    const size_t left = (size_t)(j->linear.width - inout->width);
    for (int32_t y = 0; cover != NULL && covers_any(cover, j) && y < inout->height; ++y) {
        for (int32_t x = 0; x < inout->width; ++x) {
            if (cover[(size_t)y * (size_t)j->linear.width + left + (size_t)x] < 1.0f) {
                memset(inout->pixels + 3 * ((size_t)y * (size_t)inout->width + (size_t)x), 0, 3 * sizeof(float));
            }
        }
    }
    free(cover);
    return cover != NULL;
}

/* A pixel as it is, or black. 1 where it is inside and has any light. */
static int keep(image *inout, int32_t x, int32_t y, int is_kept)
{
    if (x >= inout->width || y >= inout->height) {
        return 0;
    }
    float *rgb = inout->pixels + 3 * ((size_t)y * (size_t)inout->width + (size_t)x);
    for (int c = 0; c < 3 && !is_kept; ++c) {
        rgb[c] = 0.0f;
    }
    return rgb[0] + rgb[1] + rgb[2] > 0.0f;
}

/* The picture without the ground that was put below the scene, in `inout`'s place. 1 where anything is left. */
static int leave_ground(image *inout, const render_job *j)
{
    const lmb_frame *f = &j->render->frame;
    lmb_tile *tile = &j->frame.scratch->tile;
    int any = 0;
    for (int32_t y = 0; y < inout->height; y += LMB_TILE) {
        for (int32_t x = 0; x < inout->width; x += LMB_TILE) {
            const int shows = lmb_resolve_albedo(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) == LMB_OK;
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                const int is_own = shows && tile->id[k] != 0 && tile->id[k] < j->around.ground_id;
                any |= keep(inout, x + k % LMB_TILE, y + k / LMB_TILE, is_own);
            }
        }
    }
    return any;
}

/* By what stands on the ground, but with the ground at most so far over white: a black thing on snow is still dark. */
static float exposure_with_ground(image *inout, const render_job *j)
{
    const float all = picture_auto_exposure(inout, j->o.tone);
    return leave_ground(inout, j) ? fminf(picture_auto_exposure(inout, j->o.tone), all + GROUND_EV) : all;
}

static int take_copy(image *out, const image *from)
{
    const size_t bytes = (size_t)from->width * (size_t)from->height * 3 * sizeof(float);
    *out = *from;
    out->pixels = malloc(bytes);
    if (out->pixels != NULL) {
        memcpy(out->pixels, from->pixels, bytes);
    }
    return out->pixels != NULL;
}

static int short_of_memory(const render_job *j, report *r)
{
    return report_fail(r, "%s: not enough memory to expose the picture; give --exposure", j->o.out);
}

/* What surfaces reflect and do not emit, in *out; 0 with `r` set, or with *any 0 where nothing is left. */
static int take_reflected(image *out, int *any, const render_job *j, report *r)
{
    image emitted = *out;
    const size_t pixels = (size_t)out->width * (size_t)out->height;
    out->pixels = calloc(pixels, 3 * sizeof(float));
    emitted.pixels = calloc(pixels, 3 * sizeof(float));
    const int ok = out->pixels != NULL && emitted.pixels != NULL;
    for (int32_t y = 0; ok && y < out->height; y += LMB_TILE) {
        for (int32_t x = 0; x < out->width; x += LMB_TILE) {
            put_emitted(&emitted, j, x, y);
        }
    }
    *any = ok && put_reflected(out, j, &emitted);
    image_free(&emitted);
    return ok || short_of_memory(j, r);
}

int render_exposure(float *ev, const render_job *j, report *r)
{
    const int32_t show = j->frame.show;
    const int glows = lmb_scene_emits(&j->scene) && (show == LMB_SHOW_FULL || show == LMB_SHOW_DIRECT);
    image by = {j->o.view.width, j->linear.height, 3, NULL};
    int any = 0;
    int ok = !glows || take_reflected(&by, &any, j, r);
    if (ok && !any) {
        image_free(&by);
        ok = take_copy(&by, &j->linear) || short_of_memory(j, r);
    }
    ok = ok && (j->frame.background == NULL || leave_background(&by, j, r));
    if (ok) {
        const float stops = j->around.has_ground ? exposure_with_ground(&by, j) : picture_auto_exposure(&by, j->o.tone);
        *ev = stops + 0.0f; /* no minus zero */
    }
    image_free(&by);
    return ok;
}
