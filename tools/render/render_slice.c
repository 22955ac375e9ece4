/* render_slice.c: bands of light -> a slice's file -> the picture. */
#include "render_slice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_bytes.h"
#include "../picture/picture.h"
#include "../picture/world_read.h"

/* Data in a slice besides the light. */
enum { HAS_EMITTED = 1, HAS_COVER = 2, HAS_OWN = 4, HAS_UNLIT = 8 };

int render_options_job(render_options *inout, const option_table *t, int argc, char **argv, report *r)
{
    const char *around = inout->world;
    const int is_file = around != NULL && strcmp(around, "sky") != 0 && strcmp(around, "none") != 0;
    return inout->slice.count == 0 ||
           (slice_job(&inout->slice_job, inout, t, argc, argv, r) &&
            (!is_file || world_hash(&inout->slice_job, around, r)));
}

static int rows_of(const exposure_view *v, int32_t band)
{
    return v->height - LMB_TILE * band < LMB_TILE ? v->height - LMB_TILE * band : LMB_TILE;
}

static int32_t bands_of(const exposure_view *v) { return (v->height + LMB_TILE - 1) / LMB_TILE; }

static int what_it_has(const exposure_view *v)
{
    return (v->emitted != NULL ? HAS_EMITTED : 0) | (v->cover != NULL ? HAS_COVER : 0) |
           (v->own != NULL ? HAS_OWN : 0) | (v->unlit != NULL ? HAS_UNLIT : 0);
}

/* --- out ---------------------------------------------------------------------------------------------------------- */

static void put_head(byte_buffer *b, const render_finish *f)
{
    const exposure_view *v = &f->view;
    byte_put_int(b, f->format);
    byte_put_int(b, f->background.kind);
    byte_put(b, f->background.rgb, 3);
    byte_put_int(b, f->tone);
    byte_put_int(b, f->exposure_auto);
    byte_put_float(b, f->exposure_ev);
    byte_put_int(b, v->width);
    byte_put_int(b, v->height);
    byte_put_int(b, v->eye_width);
    byte_put_int(b, v->samples);
    byte_put_int(b, v->tone);
    byte_put_int(b, what_it_has(v));
}

static void put_band(byte_buffer *b, const exposure_view *v, const image *linear, int32_t band)
{
    const size_t rows = (size_t)rows_of(v, band), first = (size_t)band * LMB_TILE;
    const size_t wide = (size_t)v->width, eye = (size_t)v->eye_width;
    byte_put_floats(b, linear->pixels + 3 * wide * first, 3 * wide * rows);
    byte_put_floats(b, v->emitted != NULL ? v->emitted + 3 * eye * first : NULL,
                    v->emitted != NULL ? 3 * eye * rows : 0);
    byte_put_floats(b, v->cover != NULL ? v->cover + wide * first : NULL, v->cover != NULL ? wide * rows : 0);
    byte_put(b, v->own != NULL ? v->own + eye * first : NULL, v->own != NULL ? eye * rows : 0);
    byte_put_floats(b, v->unlit != NULL ? v->unlit + 3 * wide * first : NULL, v->unlit != NULL ? 3 * wide * rows : 0);
}

int render_slice_write(const render_job *j, const render_finish *f, report *r)
{
    char name[SLICE_NAME], about[SLICE_ABOUT];
    byte_buffer b = {NULL, 0, 0, 0};
    const int32_t bands = slice_items(j->o.slice, bands_of(&f->view));
    snprintf(about, sizeof about, "render %.100s, %d x %d", j->o.scene, (int)f->view.width, (int)f->view.height);
    put_head(&b, f);
    for (int32_t k = 0; k < bands; ++k) {
        put_band(&b, &f->view, &j->linear, slice_item(j->o.slice, k));
    }
    const int ok = slice_name(name, j->o.out, j->o.slice, r) &&
                   slice_write(name, j->o.slice, SLICE_RENDER, j->o.slice_job, about, &b, r);
    free(b.data);
    return ok;
}

/* --- back --------------------------------------------------------------------------------------------------------- */

/* Returns the flags of that data, or -1. */
static int get_head(render_finish *f, byte_reader *s)
{
    exposure_view *v = &f->view;
    memset(f, 0, sizeof *f);
    f->format = byte_get_int(s);
    f->background.kind = byte_get_int(s);
    const uint8_t *rgb = byte_get(s, 3);
    if (rgb == NULL) {
        return -1;
    }
    memcpy(f->background.rgb, rgb, 3);
    f->tone = byte_get_int(s);
    f->exposure_auto = byte_get_int(s);
    f->exposure_ev = byte_get_float(s);
    v->width = byte_get_int(s);
    v->height = byte_get_int(s);
    v->eye_width = byte_get_int(s);
    v->samples = byte_get_int(s);
    v->tone = byte_get_int(s);
    const int has = byte_get_int(s);
    const int ok = !s->is_short && v->width > 0 && v->height > 0 && v->eye_width > 0 && v->eye_width <= v->width &&
                   picture_fits((uint64_t)v->width, (uint64_t)v->height) && has >= 0 && has < 16 &&
                   ((has & HAS_COVER) != 0 || f->background.kind == BACKGROUND_WORLD);
    return ok ? has : -1;
}

/* Allocates the whole picture. */
static int take(render_finish *f, image *linear, int has, report *r)
{
    exposure_view *v = &f->view;
    const size_t pixels = (size_t)v->width * (size_t)v->height, eye = (size_t)v->eye_width * (size_t)v->height;
    linear->width = v->width;
    linear->height = v->height;
    linear->channels = 3;
    linear->pixels = calloc(pixels, 3 * sizeof(float));
    v->emitted = has & HAS_EMITTED ? calloc(eye, 3 * sizeof(float)) : NULL;
    v->cover = has & HAS_COVER ? calloc(pixels, sizeof(float)) : NULL;
    v->own = has & HAS_OWN ? calloc(eye, 1) : NULL;
    v->unlit = has & HAS_UNLIT ? calloc(pixels, 3 * sizeof(float)) : NULL;
    return (linear->pixels != NULL && (!(has & HAS_EMITTED) || v->emitted != NULL) &&
            (!(has & HAS_COVER) || v->cover != NULL) && (!(has & HAS_OWN) || v->own != NULL) &&
            (!(has & HAS_UNLIT) || v->unlit != NULL)) ||
           report_fail(r, "not enough memory for %d x %d pixels", (int)v->width, (int)v->height);
}

static void get_band(const exposure_view *v, image *linear, byte_reader *s, int32_t band)
{
    const size_t rows = (size_t)rows_of(v, band), first = (size_t)band * LMB_TILE;
    const size_t wide = (size_t)v->width, eye = (size_t)v->eye_width;
    byte_get_floats(linear->pixels + 3 * wide * first, s, 3 * wide * rows);
    if (v->emitted != NULL) {
        byte_get_floats(v->emitted + 3 * eye * first, s, 3 * eye * rows);
    }
    if (v->cover != NULL) {
        byte_get_floats(v->cover + wide * first, s, wide * rows);
    }
    const uint8_t *own = v->own != NULL ? byte_get(s, eye * rows) : NULL;
    if (own != NULL) {
        memcpy(v->own + eye * first, own, eye * rows);
    }
    if (v->unlit != NULL) {
        byte_get_floats(v->unlit + 3 * wide * first, s, 3 * wide * rows);
    }
}

/* Copies the bands of a slice into the picture; the first slice allocates it. */
static int add(render_finish *f, image *linear, int32_t i, slice_file *file, report *r)
{
    render_finish own;
    const int has = get_head(&own, &file->says);
    if (has < 0) {
        return report_fail(r, "damaged");
    }
    if (i == 0) {
        *f = own;
        if (!take(f, linear, has, r)) {
            return 0;
        }
    }
    const exposure_view *a = &own.view, *b = &f->view;
    if (a->width != b->width || a->height != b->height || a->eye_width != b->eye_width ||
        has != what_it_has(b)) {
        return report_fail(r, "another picture than the first slice's");
    }
    for (int32_t k = 0; k < slice_items(file->slice, bands_of(b)); ++k) {
        get_band(b, linear, &file->says, slice_item(file->slice, k));
    }
    return (!file->says.is_short && file->says.at == file->says.end) || report_fail(r, "damaged");
}

int render_slice_merge(const char *path, const slice_set *set, int is_quiet, report *r)
{
    render_finish f;
    image linear = {0, 0, 0, NULL};
    int ok = 1;
    memset(&f, 0, sizeof f);
    for (int32_t i = 0; ok && i < set->count; ++i) {
        slice_file file;
        report own = {""};
        ok = slice_read(&file, set->path[i], r);
        if (ok && !add(&f, &linear, i, &file, &own)) {
            ok = report_fail(r, "%s: %s", set->path[i], own.text);
        }
        slice_file_free(&file);
    }
    if (ok && picture_format(path) != f.format) {
        static const char *const endings[] = {"", ".png", ".ppm", ".pfm", ".hdr"};
        ok = report_fail(r, "-o %s: the slices were made for a *%s", path,
                         f.format > 0 && f.format < 5 ? endings[f.format] : "");
    }
    ok = ok && finish_write(&f, path, &linear, is_quiet, r);
    finish_free(&f);
    image_free(&linear);
    return ok;
}
