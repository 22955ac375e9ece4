/* relief_bake.c: bakes a complex scene and a simple model to a .lmr: draws and packs. [P10 P11] */
#include "relief_bake.h"

#include <lambent/numbers.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/checksum.h"
#include "../common/fvec.h"
#include "../common/progress.h"

void relief_bake_free(relief_bake *bake)
{
    for (int32_t i = 0; i < bake->views; ++i) {
        free(bake->picture[i].texels);
    }
    bake->views = 0;
}

/* --- texels ------------------------------------------------------------------------------------------------------- */

static void put_16(uint8_t *p, uint32_t v)
{
    p[0] = (uint8_t)(v & 255u);
    p[1] = (uint8_t)(v >> 8 & 255u);
}

static void put_32(uint8_t *p, uint32_t v)
{
    put_16(p, v & 0xffffu);
    put_16(p + 2, v >> 16);
}

static uint32_t depth_code(const lmb_view *v, float z, double max)
{
    const double n = (double)v->near_m, f = (double)v->far_m;
    const double min = v->kind == LMB_PERSPECTIVE ? n / f : 0.0;
    const double d = v->kind == LMB_PERSPECTIVE ? n / (double)z : (f - (double)z) / (f - n);
    const double code = floor((d - min) / (1.0 - min) * max + 0.5);
    return z > 0.0f ? (uint32_t)(code < 1.0 ? 1.0 : code > max ? max : code) : 0;
}

static uint32_t octahedral_byte(int16_t code)
{
    return (uint32_t)(int32_t)lrint((double)code * (127.0 / 32767.0)) & 255u;
}

typedef struct texel {
    uint32_t depth;
    uint8_t rgb[3];
    int16_t normal[2];
} texel;

static void put_full(uint8_t *texels, size_t count, size_t i, const texel *t)
{
    uint8_t *colour = texels + 4 * (count + i), *normal = texels + 4 * (2 * count + i);
    put_32(texels + 4 * i, t->depth);
    memcpy(colour, t->rgb, 3);
    colour[3] = t->depth != 0 ? 255 : 0;
    put_16(normal, (uint16_t)t->normal[0]);
    put_16(normal + 2, (uint16_t)t->normal[1]);
}

static void put_packed(uint8_t *texels, size_t count, size_t i, const texel *t)
{
    const uint32_t red = (t->rgb[0] * 31u + 127u) / 255u, green = (t->rgb[1] * 63u + 127u) / 255u,
                   blue = (t->rgb[2] * 31u + 127u) / 255u;
    put_32(texels + 4 * i, t->depth | red << 16 | green << 21 | blue << 27);
    put_16(texels + 4 * count + 2 * i, octahedral_byte(t->normal[0]) | octahedral_byte(t->normal[1]) << 8);
}

static void set_texel(texel *t, const float *normal, const float *colour, int codes)
{
    for (int c = 0; c < 3; ++c) {
        t->rgb[c] = codes ? (uint8_t)lrintf(clampf(colour[c], 0.0f, 1.0f) * 255.0f) : lmb_srgb_encode(colour[c]);
    }
    lmb_octahedral_encode(t->normal, vec3(normal[0], normal[1], normal[2]));
}

/* Packs a view's picture. */
static int pack(relief_picture *p, int32_t format, const lmb_view *view, const float *depth, const float *normal,
                const float *colour, int codes, report *r)
{
    const size_t count = (size_t)view->frame_width * (size_t)view->frame_height;
    const int full = format == LMB_RELIEF_FULL;
    p->view = *view;
    p->bytes = full ? 12 * count : 4 * count + (count + 1) / 2 * 4;
    p->texels = calloc(p->bytes, 1);
    if (p->texels == NULL) {
        return report_fail(r, "not enough memory for a view of %.0f texels", (double)count);
    }
    for (size_t i = 0; i < count; ++i) {
        texel t = {0, {0, 0, 0}, {0, 0}};
        t.depth = depth_code(view, depth[i], full ? 16777215.0 : 65535.0);
        if (t.depth != 0) {
            set_texel(&t, normal + 3 * i, colour + 3 * i, codes);
            (full ? put_full : put_packed)(p->texels, count, i, &t);
        }
    }
    return 1;
}

static int has_room(const relief_bake *bake, int32_t count, report *r)
{
    return bake->views + count <= LMB_RELIEF_VIEWS || report_fail(r, "more than %d views", LMB_RELIEF_VIEWS);
}

int relief_add_planes(relief_bake *bake, const lmb_view *view, const float *depth, const float *normal,
                      const float *colour, int codes, report *r)
{
    if (!has_room(bake, 1, r)) {
        return 0;
    }
    const int ok = pack(&bake->picture[bake->views], bake->format, view, depth, normal, colour, codes, r);
    bake->views += ok;
    return ok;
}

/* --- drawing ------------------------------------------------------------------------------------------------------ */

/* The memory of one view's picture. */
typedef struct canvas {
    void *depth_memory, *id_memory;
    lmb_target target;
    lmb_tile tile;
    lmb_surface depth, normal, albedo;
} canvas;

static void canvas_free(canvas *c)
{
    if (c != NULL) {
        free(c->depth_memory);
        free(c->id_memory);
        free(c->depth.data);
        free(c->normal.data);
        free(c->albedo.data);
        free(c);
    }
}

static int take(lmb_surface *s, int32_t format, const lmb_view *v, void **memory)
{
    const size_t bytes = lmb_surface_bytes(format, v->frame_width, v->frame_height);
    *memory = malloc(bytes);
    return *memory != NULL &&
           lmb_surface_init(s, format, v->frame_width, v->frame_height, *memory, bytes) == LMB_OK &&
           lmb_surface_clear(s) == LMB_OK;
}

static canvas *canvas_make(const lmb_view *v, report *r)
{
    canvas *c = calloc(1, sizeof *c);
    void *plane[3] = {NULL, NULL, NULL};
    const int ok = c != NULL && take(&c->target.depth, LMB_DEPTH32F, v, &c->depth_memory) &&
                   take(&c->target.id, LMB_ID32, v, &c->id_memory) && take(&c->depth, LMB_R32F, v, &plane[0]) &&
                   take(&c->normal, LMB_RGB32F, v, &plane[1]) && take(&c->albedo, LMB_RGB32F, v, &plane[2]);
    if (!ok) {
        canvas_free(c);
        report_fail(r, "not enough memory for a view of %d x %d texels", (int)v->frame_width, (int)v->frame_height);
        return NULL;
    }
    return c;
}

static int draw(relief_picture *out, int32_t format, const lmb_scene *scene, const lmb_view *view, report *r)
{
    const lmb_kernels *kernels = lmb_kernels_pick();
    canvas *c = canvas_make(view, r);
    if (c == NULL) {
        return 0;
    }
    lmb_status status = lmb_draw(&c->target, kernels, view, scene, 1, lmb_scene_triangles(scene), 0, NULL);
    for (int32_t band = 0; status == LMB_OK && band < (view->frame_height + 7) / 8; ++band) {
        status = lmb_gbuffer_band(&c->depth, &c->normal, &c->albedo, kernels, &c->tile, view, scene, &c->target, band);
    }
    const int ok = status == LMB_OK
                       ? pack(out, format, view, c->depth.data, c->normal.data, c->albedo.data, 0, r)
                       : report_fail(r, "a view could not be drawn: %s; is the model a point?",
                                     lmb_status_name(status));
    canvas_free(c);
    return ok;
}

/* Views drawn by several threads. */
typedef struct drawing {
    relief_bake *bake;
    const lmb_scene *scene;
    const lmb_view *view;
    int32_t count;
    report failed[LMB_RELIEF_VIEWS]; /* by view */
} drawing;

static void draw_one(void *user, int i, int thread)
{
    drawing *d = user;
    draw(&d->bake->picture[d->bake->views + i], d->bake->format, d->scene, &d->view[i], &d->failed[i]);
    if (thread == 0) {
        progress_tell("views", (double)i / (double)d->count);
    }
}

int relief_add_views(relief_bake *bake, const lmb_scene *scene, const lmb_view *view, int32_t count, int threads,
                     report *r)
{
    static drawing d;
    if (!has_room(bake, count, r)) {
        return 0;
    }
    memset(&d, 0, sizeof d);
    d.bake = bake;
    d.scene = scene;
    d.view = view;
    d.count = count;
    pool_run(threads, count, draw_one, &d);
    bake->views += count;
    for (int32_t i = 0; i < count; ++i) {
        if (d.failed[i].text[0] != '\0') {
            return report_fail(r, "%s", d.failed[i].text);
        }
    }
    return 1;
}

int relief_add(relief_bake *bake, const lmb_scene *scene, const lmb_view *view, report *r)
{
    return relief_add_views(bake, scene, view, 1, 1, r);
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

typedef struct writer {
    uint8_t *data;
    size_t at;
} writer;

static void put_words(writer *w, const void *words, size_t count)
{
    if (w->data != NULL) {
        memcpy(w->data + w->at, words, 4 * count);
    }
    w->at += 4 * count;
}

static uint32_t float_word(float v)
{
    uint32_t u;
    memcpy(&u, &v, sizeof u);
    return u;
}

static void put_record(writer *w, const lmb_view *v, uint32_t texels)
{
    const lmb_vec3 axis[4] = {v->eye, v->right, v->up, v->back};
    uint32_t word[LMB_RELIEF_VIEW_WORDS];
    for (int i = 0; i < 4; ++i) {
        word[3 * i] = float_word(axis[i].x);
        word[3 * i + 1] = float_word(axis[i].y);
        word[3 * i + 2] = float_word(axis[i].z);
    }
    word[12] = float_word(v->half_width);
    word[13] = float_word(v->half_height);
    word[14] = float_word(v->near_m);
    word[15] = float_word(v->far_m);
    word[16] = (uint32_t)v->kind;
    word[17] = (uint32_t)v->frame_width;
    word[18] = (uint32_t)v->frame_height;
    word[19] = texels;
    put_words(w, word, LMB_RELIEF_VIEW_WORDS);
}

/* Packs two 16-bit numbers into a word, the first at the lower address. */
static uint32_t pair(uint16_t a, uint16_t b)
{
    const uint16_t both[2] = {a, b};
    uint32_t word;
    memcpy(&word, both, sizeof word);
    return word;
}

static void put_normals(writer *w, const triangle_mesh *m)
{
    for (size_t v = 0; v < m->vertex_count; ++v) {
        int16_t code[2];
        lmb_octahedral_encode(code, vec3(m->normals[3 * v], m->normals[3 * v + 1], m->normals[3 * v + 2]));
        const uint32_t word = pair((uint16_t)code[0], (uint16_t)code[1]);
        put_words(w, &word, 1);
    }
}

static void put_colours(writer *w, const triangle_mesh *m)
{
    for (size_t v = 0; v < m->vertex_count; ++v) {
        uint8_t rgba[4] = {255, 255, 255, 255};
        for (size_t c = 0; c < 3; ++c) {
            rgba[c] = (uint8_t)lrintf(clampf(m->colours[3 * v + c], 0.0f, 1.0f) * 255.0f);
        }
        put_words(w, rgba, 1);
    }
}

static void put_indices(writer *w, const triangle_mesh *m)
{
    const size_t n = 3 * (size_t)m->triangle_count;
    if (m->vertex_count > 65536u) {
        put_words(w, m->indices, n);
        return;
    }
    for (size_t i = 0; i < n; i += 2) {
        const uint32_t word = pair((uint16_t)m->indices[i], i + 1 < n ? (uint16_t)m->indices[i + 1] : 0);
        put_words(w, &word, 1);
    }
}

/* Lays out the file. If w->data is NULL, only counts bytes. */
static void put_file(writer *w, const relief_bake *bake, const triangle_mesh *m, size_t total)
{
    const uint32_t views = (uint32_t)bake->views, records = 4 * LMB_RELIEF_HEADER_WORDS;
    uint32_t head[LMB_RELIEF_HEADER_WORDS] = {0, 0x01020304u, (uint32_t)total, (uint32_t)bake->format, views, records};
    uint32_t at = records + 4 * LMB_RELIEF_VIEW_WORDS * views;
    memcpy(head, "LMR\1", 4);
    head[6] = m->vertex_count;
    head[7] = m->triangle_count;
    head[8] = at;
    head[9] = head[8] + 12 * m->vertex_count;
    head[10] = m->colours != NULL ? head[9] + 4 * m->vertex_count : 0;
    head[11] = head[9] + (m->colours != NULL ? 8 : 4) * m->vertex_count;
    head[12] = m->vertex_count > 65536u ? LMB_INDEX_U32 : LMB_INDEX_U16;
    at = head[11] + (m->vertex_count > 65536u ? 12 * m->triangle_count : (3 * m->triangle_count + 1) / 2 * 4);
    put_words(w, head, LMB_RELIEF_HEADER_WORDS);
    for (int32_t i = 0; i < bake->views; ++i) {
        put_record(w, &bake->picture[i].view, at);
        at += (uint32_t)bake->picture[i].bytes;
    }
    put_words(w, m->positions, 3 * (size_t)m->vertex_count);
    put_normals(w, m);
    if (m->colours != NULL) {
        put_colours(w, m);
    }
    put_indices(w, m);
    for (int32_t i = 0; i < bake->views; ++i) {
        put_words(w, bake->picture[i].texels, bake->picture[i].bytes / 4);
    }
}

/* Opens the result to test whether the library accepts the sizes. */
static int opens(const file_bytes *file, report *r)
{
    lmb_relief own;
    return lmb_relief_open(&own, file->data, file->size) == LMB_OK ||
           report_fail(r, "the model or its views are too small or too large for a relief: 1e-6 to 1e5 m is safe");
}

int relief_encode(file_bytes *out, const relief_bake *bake, const triangle_mesh *simple, report *r)
{
    writer w = {NULL, 0};
    double texels = 0.0;
    for (int32_t i = 0; i < bake->views; ++i) {
        texels += (double)bake->picture[i].bytes;
    }
    if (texels + 40.0 * simple->vertex_count + 12.0 * simple->triangle_count > 2e9) {
        return report_fail(r, "over 2 GB: fewer or smaller views");
    }
    put_file(&w, bake, simple, 0);
    out->size = w.at;
    out->data = w.data = malloc(w.at);
    w.at = 0;
    if (out->data == NULL) {
        return report_fail(r, "not enough memory for a file of %.0f bytes", (double)out->size);
    }
    put_file(&w, bake, simple, out->size);
    checksum_put(out, LMB_RELIEF_HEADER_WORDS);
    return opens(out, r);
}
