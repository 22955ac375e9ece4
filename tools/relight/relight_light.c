/* relight_light.c: a world, and the light at places in it by any filter. */
#include "relight_light.h"

#include <stdlib.h>
#include <string.h>

#include "../common/frame_name.h"
#include "../demo/demo_field.h"
#include "../picture/picture.h"

#define DARK 0.1 /* share of a world's area above which black texels are reported */

/* --- once --------------------------------------------------------------------------------------------------------- */

/* The share of black, blank or missing texels. */
static double dark_share(const lmb_world_pictures *p)
{
    const size_t texels = (size_t)p->face_size * (size_t)p->face_size;
    size_t dark = 0;
    for (int f = 0; f < 6; ++f) {
        for (size_t i = 0; i < texels; ++i) {
            const float *rgb = p->face[f] != NULL ? p->face[f] + 3 * i : NULL;
            dark +=
                rgb == NULL || (p->alpha[f] != NULL && !(p->alpha[f][i] > 0.0f)) || !(rgb[0] + rgb[1] + rgb[2] > 0.0f);
        }
    }
    return (double)dark / (6.0 * (double)texels);
}

static int read_pictures(relight_light *w, relight_options *o, const char *name, report *r)
{
#if !defined(OPTIONS_WITHOUT_HELP)
    if (w->series.count > 0) {
        return world_series_read(&o->place, &w->pictures, &w->series, w->moment, r);
    }
#endif
    return strcmp(name, "demo") == 0 ? demo_field_pictures(&o->place, &w->pictures, r)
                                     : world_read_cube(&o->place, &w->pictures, name, r);
}

/* Reads a world. All worlds share the memory for the pictures of one. */
static int make_world(relight_light *w, relight_options *o, int32_t i, report *r)
{
    const char *name = o->world[i];
    o->place.centre = o->centre[i];
    world_pictures_free(&w->pictures);
    if (!read_pictures(w, o, name, r)) {
        return 0;
    }
    world_tell_not_finite(&w->pictures, name, o->view.is_quiet);
    const int is_told = o->view.is_quiet || w->moment.index > 0 || w->moment.share > 0.0f; /* once in a series */
    const double dark = strcmp(name, "demo") == 0 || is_told ? 0.0 : dark_share(&o->place);
    report_note(is_told || dark < DARK, "note: %s: %.0f %% of it is black or blank: no light comes from there",
                name, 100.0 * dark);
    if (o->ground != NULL && !world_read_ground(&o->place, &w->pictures, o->ground, r)) {
        return 0;
    }
    world_tell_not_finite(&w->pictures, o->ground, o->view.is_quiet || i > 0); /* all have the same ground */
    const size_t bytes = lmb_world_bytes(&o->place, o->format);
    if ((w->world_memory[i] = malloc(bytes)) == NULL) {
        return report_fail(r, "%s: out of memory", name);
    }
    return lmb_world_init(&w->world[i], &o->place, o->format, w->world_memory[i], bytes) == LMB_OK ||
           report_fail(
               r, "--world-centre: lies outside the far world or under the --floor, or numbers are over 1,000,000 m");
}

static int make_table(relight_light *w, int i, report *r)
{
    const int32_t width = RELIGHT_WIDTH >> i, height = RELIGHT_HEIGHT >> i;
    const size_t bytes = lmb_probe_table_bytes(width, height);
    w->table_memory[i] = malloc(bytes);
    return (w->table_memory[i] != NULL &&
            lmb_probe_table_init(&w->table[i], width, height, -180.0f, w->table_memory[i], bytes) == LMB_OK) ||
           report_fail(r, "out of memory");
}

static int make_blur(relight_light *w, int32_t terms, report *r)
{
    const size_t bytes = lmb_probe_blur_bytes(&w->table[2], terms);
    w->blur_memory = malloc(bytes);
    return (w->blur_memory != NULL &&
            lmb_probe_blur_init(&w->blur, &w->table[2], terms, w->blur_memory, bytes) == LMB_OK) ||
           report_fail(r, "out of memory");
}

int relight_light_make(relight_light *w, relight_options *o, report *r)
{
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page draws one picture */
    if (frame_digits(o->world[0]) > 0 && !world_series_find(&w->series, o->world[0], r)) {
        return 0;
    }
#endif
    for (int32_t i = 0; i < o->worlds; ++i) {
        if (!make_world(w, o, i, r)) {
            return 0;
        }
    }
    o->place.centre = o->centre[0];
    for (int i = 0; i < 3; ++i) {
        if (!make_table(w, i, r)) {
            return 0;
        }
    }
    return o->filter < FILTER_BLUR || make_blur(w, o->filter - FILTER_BLUR, r);
}

int relight_light_change(relight_light *w, relight_options *o, const char *name, report *r)
{
    free(w->world_memory[0]);
    w->world_memory[0] = NULL;
    o->world[0] = name;
    return make_world(w, o, 0, r);
}

#if !defined(OPTIONS_WITHOUT_HELP)
int relight_light_next(relight_light *w, int *changed, relight_options *o, int32_t k, report *r)
{
    const world_moment at = world_series_at(&w->series, k, o->world_every > 0 ? o->world_every : 1);
    *changed = at.index != w->moment.index || at.share != w->moment.share;
    w->moment = at;
    return !*changed || relight_light_change(w, o, o->world[0], r);
}
#endif

/* --- per place ---------------------------------------------------------------------------------------------------- */

int relight_light_filter(relight_light *w, const relight_options *o, int32_t n)
{
    static const int32_t terms[] = {0, LMB_SH_9, LMB_SH_16, LMB_SH_25};
    float harmonics[3][LMB_SH_25];
    if (o->filter >= FILTER_BLUR) {
        lmb_probe_halve(w->half, w->map, &w->table[0]);
        lmb_probe_halve(w->half, w->half, &w->table[1]);
        lmb_probe_blur_map(w->half, o->kernels, w->line, w->half, &w->blur);
        return lmb_probe_map_cube(w->cube, n, w->half, &w->table[2]) == LMB_OK;
    }
    if (o->filter == FILTER_COSINE) {
        lmb_probe_reduce(&w->lights, o->kernels, w->map, &w->table[0]);
        return lmb_probe_cosine(w->cube, n, o->kernels, &w->lights, &w->table[0]) == LMB_OK;
    }
    lmb_probe_sh(harmonics, w->map, &w->table[0]);
    return lmb_probe_sh_cube(w->cube, n, (const float (*)[LMB_SH_25])harmonics, terms[o->filter]) == LMB_OK;
}

int relight_light_at(relight_light *w, const relight_options *o, lmb_vec3 at, int32_t n, report *r)
{
    return (relight_light_see(w, o, at) && relight_light_filter(w, o, n)) ||
           report_fail(r, "--at: numbers over 1,000,000 m");
}

void relight_light_free(relight_light *w)
{
    world_pictures_free(&w->pictures);
    for (int i = 0; i < RELIGHT_WORLDS; ++i) {
        free(w->world_memory[i]);
    }
    for (int i = 0; i < 3; ++i) {
        free(w->table_memory[i]);
    }
    free(w->blur_memory);
}

int relight_write_planes(const char *path, const float *planes, int32_t width, int32_t height, report *r)
{
    const size_t pixels = (size_t)width * (size_t)height;
    image out = {width, height, 3, malloc(3 * pixels * sizeof(float))};
    if (out.pixels == NULL) {
        return report_fail(r, "%s: out of memory", path);
    }
    for (size_t i = 0; i < 3 * pixels; ++i) {
        out.pixels[i] = planes[i % 3 * pixels + i / 3];
    }
    const int ok = picture_write(path, &out, picture_auto_exposure(&out, PICTURE_CLIPPED), PICTURE_CLIPPED, r);
    image_free(&out);
    return ok;
}
