/* render_exposure.c: automatic exposure from the light that surfaces reflect. */
#include "render_exposure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../picture/picture.h"
#include "background.h"
#include "unlit.h"

#define GROUND_EV 1.25f
#define NOTHING   1e-4f /* light without emission counts from this share of it on: less is rounding */

static int short_of_memory(report *r)
{
    return report_fail(r, "not enough memory to expose the picture; give --exposure");
}

/* --- facts about the view ----------------------------------------------------------------------------------------- */

static int is_in(const exposure_view *v, int32_t x, int32_t y) { return x < v->eye_width && y < v->height; }

/* Stores the emission of surfaces in a tile of the eye drawn last. */
static void put_emitted(exposure_view *v, const render_job *j, int32_t x, int32_t y)
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
        for (int c = 0; c < 3 && is_in(v, px, py); ++c) {
            v->emitted[3 * ((size_t)py * (size_t)v->eye_width + (size_t)px) + (size_t)c] = own->rgb[c][k];
        }
    }
}

/* Marks the pixels of the scene's own surfaces. */
static void put_own(exposure_view *v, const render_job *j, int32_t x, int32_t y)
{
    const lmb_frame *f = &j->render->frame;
    lmb_tile *tile = &j->frame.scratch->tile;
    const int shows = lmb_resolve_albedo(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) == LMB_OK;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        if (is_in(v, px, py)) {
            v->own[(size_t)py * (size_t)v->eye_width + (size_t)px] =
                shows && tile->id[k] != 0 && tile->id[k] < j->around.ground_id;
        }
    }
}

static void look_at_tiles(exposure_view *v, const render_job *j,
                          void (*look)(exposure_view *v, const render_job *j, int32_t x, int32_t y))
{
    for (int32_t y = 0; y < v->height; y += LMB_TILE) {
        for (int32_t x = 0; x < v->eye_width; x += LMB_TILE) {
            look(v, j, x, y);
        }
    }
}

int exposure_look(exposure_view *out, const render_job *j, report *r)
{
    const int32_t show = j->frame.show;
    const size_t pixels = (size_t)j->o.view.width * (size_t)j->linear.height;
    const int glows = lmb_scene_emits(&j->scene) && (show == LMB_SHOW_FULL || show == LMB_SHOW_DIRECT);
    memset(out, 0, sizeof *out);
    out->width = j->linear.width;
    out->height = j->linear.height;
    out->eye_width = j->o.view.width;
    out->samples = j->frame.samples;
    out->tone = j->o.tone;
    out->emitted = glows ? calloc(pixels, 3 * sizeof *out->emitted) : NULL;
    out->own = j->around.has_ground ? calloc(pixels, 1) : NULL;
    int ok = ((!glows || out->emitted != NULL) && (!j->around.has_ground || out->own != NULL)) || short_of_memory(r);
    ok = ok && unlit_colours(&out->unlit, j, r);
    if (ok && glows) {
        look_at_tiles(out, j, put_emitted);
    }
    ok = ok && (j->frame.background == NULL || (out->cover = background_cover(j, r)) != NULL);
    if (ok && out->own != NULL) {
        look_at_tiles(out, j, put_own);
    }
    if (!ok) {
        exposure_view_free(out);
    }
    return ok;
}

void exposure_view_free(exposure_view *v)
{
    free(v->emitted);
    free(v->unlit);
    free(v->cover);
    free(v->own);
    memset(v, 0, sizeof *v);
}

/* --- which light counts ------------------------------------------------------------------------------------------- */

static float emitted_at(const exposure_view *v, int32_t x, int32_t y, int c)
{
    const int is_inside = x >= 0 && y >= 0 && x < v->eye_width && y < v->height;
    return is_inside ? v->emitted[3 * ((size_t)y * (size_t)v->eye_width + (size_t)x) + (size_t)c] : 0.0f;
}

/* With several samples, a pixel may show an emitter from the pixel beside it. */
static int is_beside_emitted(const exposure_view *v, int32_t x, int32_t y)
{
    float brightest = 0.0f;
    for (int i = 0; i < 27; ++i) {
        const float e = emitted_at(v, x + i % 3 - 1, y + i / 3 % 3 - 1, i / 9);
        brightest = e > brightest ? e : brightest;
    }
    return brightest > 0.0f;
}

/* Writes the image without emitted light. Returns 1 if anything is left. */
static int put_reflected(image *out, const exposure_view *v, const image *linear)
{
    int any = 0;
    for (int32_t y = 0; y < out->height; ++y) {
        for (int32_t x = 0; x < out->width; ++x) {
            const size_t from = (size_t)y * (size_t)linear->width + (size_t)(linear->width - out->width + x);
            const int mixed = v->samples > 1 && is_beside_emitted(v, x, y);
            for (int c = 0; c < 3; ++c) {
                const float emits = emitted_at(v, x, y, c), rest = linear->pixels[3 * from + (size_t)c] - emits;
                const int is_light = !mixed && rest > NOTHING * emits;
                out->pixels[3 * ((size_t)y * (size_t)out->width + (size_t)x) + (size_t)c] = is_light ? rest : 0.0f;
                any |= is_light;
            }
        }
    }
    return any;
}

static int covers_any(const exposure_view *v)
{
    const size_t pixels = (size_t)v->width * (size_t)v->height;
    size_t i = 0;
    while (i < pixels && v->cover[i] < 1.0f) {
        ++i;
    }
    return i < pixels;
}

/* Removes the world behind surfaces from `inout`, if there are any. The image has all eyes, or only the last. */
static void leave_background(image *inout, const exposure_view *v)
{
    const size_t left = (size_t)(v->width - inout->width);
    for (int32_t y = 0; covers_any(v) && y < inout->height; ++y) {
        for (int32_t x = 0; x < inout->width; ++x) {
            if (v->cover[(size_t)y * (size_t)v->width + left + (size_t)x] < 1.0f) {
                memset(inout->pixels + 3 * ((size_t)y * (size_t)inout->width + (size_t)x), 0, 3 * sizeof(float));
            }
        }
    }
}

/* Removes unlit colours from the picture `inout`, unless nothing would be left. The picture has all eyes, or only the
 * last. */
static void leave_unlit(image *inout, const exposure_view *v)
{
    const size_t left = (size_t)(v->width - inout->width), values = 3 * (size_t)inout->width;
    float peak = 0.0f;
    for (int pass = 0; pass < 2 && (pass == 0 || peak > 0.0f); ++pass) {
        for (int32_t y = 0; y < inout->height; ++y) {
            float *to = inout->pixels + values * (size_t)y;
            const float *unlit = v->unlit + 3 * ((size_t)y * (size_t)v->width + left);
            for (size_t i = 0; i < values; ++i) {
                const float rest = unlit_rest(to[i], unlit[i]);
                peak = fmaxf(peak, rest);
                to[i] = pass == 0 ? to[i] : rest;
            }
        }
    }
}

/* Removes the added ground from `inout`. Returns 1 if anything is left. */
static int leave_ground(image *inout, const exposure_view *v)
{
    int any = 0;
    for (int32_t y = 0; y < inout->height; ++y) {
        for (int32_t x = 0; x < inout->width; ++x) {
            float *rgb = inout->pixels + 3 * ((size_t)y * (size_t)inout->width + (size_t)x);
            if (x >= v->eye_width || !v->own[(size_t)y * (size_t)v->eye_width + (size_t)x]) {
                memset(rgb, 0, 3 * sizeof *rgb);
            }
            any |= rgb[0] + rgb[1] + rgb[2] > 0.0f;
        }
    }
    return any;
}

/* Exposes for objects on the ground, with the ground at most GROUND_EV above white: a black object on snow stays
 * dark. */
static float exposure_with_ground(image *inout, const exposure_view *v)
{
    const float all = picture_auto_exposure(inout, v->tone);
    return leave_ground(inout, v) ? fminf(picture_auto_exposure(inout, v->tone), all + GROUND_EV) : all;
}

int exposure_of(float *ev, const exposure_view *v, const image *linear, report *r)
{
    image by = {v->eye_width, v->height, 3, NULL};
    const size_t bytes = (size_t)v->width * (size_t)v->height * 3 * sizeof(float);
    by.pixels = malloc(bytes);
    if (by.pixels == NULL) {
        return short_of_memory(r);
    }
    if (v->emitted == NULL || !put_reflected(&by, v, linear)) {
        by.width = v->width;
        memcpy(by.pixels, linear->pixels, bytes);
    }
    if (v->unlit != NULL) {
        leave_unlit(&by, v);
    }
    if (v->cover != NULL) {
        leave_background(&by, v);
    }
    const float stops = v->own != NULL ? exposure_with_ground(&by, v) : picture_auto_exposure(&by, v->tone);
    *ev = stops + 0.0f; /* avoids minus zero */
    image_free(&by);
    return 1;
}

int render_exposure(float *ev, const render_job *j, report *r)
{
    exposure_view v;
    const int ok = exposure_look(&v, j, r) && exposure_of(ev, &v, &j->linear, r);
    exposure_view_free(&v);
    return ok;
}
