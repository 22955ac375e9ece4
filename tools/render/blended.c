/* blended.c: the layers of BLEND materials at each pixel, sorted, and mixed from back to front.
 *
 * Each sample of a pixel is drawn separately. Every triangle that blends is drawn into a window of its own, which gives
 * the pixels and depths that lmb_draw gives it anywhere. Pixels keep those in front of the opaque surface in a list.
 * The frame then lights one layer of all pixels at a time, from ids. Rejected: to add a depth limit to the fill
 * kernels and to peel layers off; each of seven backends, and every draw without layers, would pay for it. */
#include "blended.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

enum { MIN_LIST = 1 << 16, MAX_LIST = 1 << 26 }; /* layers of all pixels: 1 MiB, at most 1 GiB */

/* A layer of one pixel. */
typedef struct fragment {
    uint32_t next; /* 1 + index in the list; 0: none */
    uint32_t id;
    float depth, alpha;
} fragment;

typedef struct work {
    const lmb_frame *frame;
    lmb_frame how;         /* the frame with one sample, own ids and an own picture */
    lmb_scene solid;       /* the scene; its blending materials have no holes */
    lmb_material *materials;
    void *eye_memory[2];   /* depth and ids of opaque surfaces, then of a layer */
    float *depth;          /* of opaque surfaces, linear rows, as all below */
    uint32_t *opaque;      /* ids of opaque surfaces */
    float *window_depth;
    uint32_t *window_id;
    uint32_t *first;       /* of each pixel: 1 + index of a fragment; 0: none */
    fragment *list;
    uint32_t count, cap;
    float *light, *mixed, *open, *unlit; /* of a layer; of the sample; share that shows the background; unlit light */
    int32_t wide;          /* of rows: the frame's width in whole tiles */
    size_t pixels, bytes;
    int failed;            /* out of memory */
} work;

static int is_blended(const lmb_material *m) { return (m->flags & LMB_ALPHA_BLEND) != 0; }

int blended_is_any(const lmb_scene *s)
{
    int any = 0;
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        any = any || (is_blended(&s->materials[s->instances[i].material]) &&
                      s->meshes[s->instances[i].mesh].triangle_count > 0);
    }
    return any;
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static void *take(work *w, size_t bytes)
{
    void *p = calloc(bytes, 1);
    w->failed |= p == NULL;
    w->bytes += bytes;
    return p;
}

static void close_work(work *w)
{
    free(w->materials);
    free(w->eye_memory[0]);
    free(w->eye_memory[1]);
    free(w->depth);
    free(w->opaque);
    free(w->window_depth);
    free(w->window_id);
    free(w->first);
    free(w->list);
    free(w->light);
    free(w->mixed);
    free(w->open);
    free(w->unlit);
}

static void take_eye(work *w, lmb_surface *out, int32_t format, int i)
{
    const int32_t width = w->frame->view.frame_width, height = w->frame->view.frame_height;
    const size_t bytes = lmb_surface_bytes(format, width, height);
    w->eye_memory[i] = take(w, bytes);
    w->failed |= w->eye_memory[i] == NULL ||
                 lmb_surface_init(out, format, width, height, w->eye_memory[i], bytes) != LMB_OK;
}

/* Returns 1, or 0 if memory is short. */
static int open_work(work *w, const lmb_frame *f)
{
    const lmb_scene *s = f->scene;
    const int32_t high = (f->view.frame_height + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    memset(w, 0, sizeof *w);
    w->frame = f;
    w->wide = (f->view.frame_width + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    w->pixels = (size_t)w->wide * (size_t)high;
    w->how = *f;
    w->how.samples = 1;
    w->how.stats = NULL;
    w->how.callback = NULL;
    take_eye(w, &w->how.eye.depth, LMB_DEPTH32F, 0);
    take_eye(w, &w->how.eye.id, LMB_ID32, 1);
    w->depth = take(w, w->pixels * sizeof *w->depth);
    w->opaque = take(w, w->pixels * sizeof *w->opaque);
    w->window_depth = take(w, w->pixels * sizeof *w->window_depth);
    w->window_id = take(w, w->pixels * sizeof *w->window_id);
    w->first = take(w, w->pixels * sizeof *w->first);
    w->light = take(w, 3 * w->pixels * sizeof *w->light);
    w->mixed = take(w, 3 * w->pixels * sizeof *w->mixed);
    w->open = take(w, w->pixels * sizeof *w->open);
    w->unlit = take(w, 3 * w->pixels * sizeof *w->unlit);
    w->materials = take(w, (size_t)s->material_count * sizeof *w->materials);
    if (w->failed) {
        return 0;
    }
    memset(&w->how.out, 0, sizeof w->how.out);
    w->how.out.data = w->light;
    w->how.out.width = f->view.frame_width;
    w->how.out.height = f->view.frame_height;
    w->how.out.stride_bytes = w->wide * 3 * (int32_t)sizeof(float);
    w->how.out.format = LMB_RGB32F;
    memcpy(w->materials, s->materials, (size_t)s->material_count * sizeof *w->materials);
    for (uint32_t i = 0; i < s->material_count; ++i) {
        w->materials[i].flags &= is_blended(&w->materials[i]) ? ~(uint32_t)(LMB_ALPHA_MASK | LMB_ALPHA_BLEND) : ~0u;
    }
    w->solid = *s;
    w->solid.materials = w->materials;
    return 1;
}

static lmb_surface rows_of(const work *w, void *data, int32_t format, int32_t width, int32_t height)
{
    lmb_surface s;
    memset(&s, 0, sizeof s);
    s.data = data;
    s.width = width;
    s.height = height;
    s.stride_bytes = w->wide * 4;
    s.format = (uint8_t)format;
    s.layout = LMB_LINEAR;
    return s;
}

/* --- opaque surfaces ---------------------------------------------------------------------------------------------- */

/* Draws the instances without a BLEND material into depth and opaque. */
static lmb_status draw_opaque(work *w)
{
    const lmb_scene *s = w->frame->scene;
    const int32_t width = w->wide, height = (int32_t)(w->pixels / (size_t)w->wide);
    lmb_target t;
    lmb_status status = LMB_OK;
    memset(&t, 0, sizeof t);
    t.depth = rows_of(w, w->depth, LMB_DEPTH32F, width, height);
    t.id = rows_of(w, w->opaque, LMB_ID32, width, height);
    memset(w->depth, 0, w->pixels * sizeof *w->depth);
    memset(w->opaque, 0, w->pixels * sizeof *w->opaque);
    for (uint32_t i = 0; i < s->instance_count && status == LMB_OK; ++i) {
        const lmb_instance *own = &s->instances[i];
        const uint32_t triangles = s->meshes[own->mesh].triangle_count;
        if (triangles > 0 && !is_blended(&s->materials[own->material])) {
            status = lmb_draw(&t, w->how.kernels, &w->how.view, s, own->first_id, triangles, LMB_CULL_BACK, NULL);
        }
    }
    return status;
}

/* --- layers ------------------------------------------------------------------------------------------------------- */

/* The first and one past the last pixel of the whole tiles that contain low .. high, within 0 .. size. */
static void tiles_of(int32_t span[2], double low, double high, int32_t size)
{
    low = low > 0.0 ? low : 0.0;
    high = high < size - 1 ? high : size - 1;
    span[0] = low < size ? (int32_t)low / LMB_TILE * LMB_TILE : size;
    span[1] = high >= 0.0 ? ((int32_t)high / LMB_TILE + 1) * LMB_TILE : 0;
}

/* Sets the tiles that a triangle may cover: first and past of x, then of y. All tiles if it reaches behind the eye. */
static void set_box(int32_t box[2][2], const work *w, const lmb_triangle *t)
{
    const lmb_view *v = &w->how.view;
    const int32_t size[2] = {w->wide, (int32_t)(w->pixels / (size_t)w->wide)};
    double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
    int whole = 0;
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 d = sub3(t->corner[k], v->eye);
        const double ahead = -(double)dot3(v->back, d), by = v->kind == LMB_ORTHOGRAPHIC ? 1.0 : ahead;
        whole = whole || (v->kind != LMB_ORTHOGRAPHIC && !(ahead > (double)v->near_m));
        const double at[2] = {0.5 * v->frame_width * (1.0 + (double)dot3(v->right, d) / (by * (double)v->half_width)),
                              0.5 * v->frame_height * (1.0 - (double)dot3(v->up, d) / (by * (double)v->half_height))};
        for (int c = 0; c < 2; ++c) {
            low[c] = at[c] < low[c] ? at[c] : low[c];
            high[c] = at[c] > high[c] ? at[c] : high[c];
        }
    }
    for (int c = 0; c < 2; ++c) { /* 2 px for samples and rounding */
        tiles_of(box[c], whole ? 0.0 : low[c] - 2.0, whole ? (double)size[c] : high[c] + 2.0, size[c]);
    }
}

static int add_fragment(work *w, size_t pixel, uint32_t id, float depth, float alpha)
{
    if (w->count == w->cap) {
        const uint32_t cap = w->cap == 0 ? MIN_LIST : w->cap < MAX_LIST ? 2 * w->cap : 0;
        fragment *list = cap != 0 ? realloc(w->list, (size_t)cap * sizeof *list) : NULL;
        if (list == NULL) {
            return 0;
        }
        w->list = list;
        w->cap = cap;
    }
    fragment *f = &w->list[w->count++];
    f->next = w->first[pixel];
    f->id = id;
    f->depth = depth;
    f->alpha = alpha;
    w->first[pixel] = w->count;
    return 1;
}

/* Takes the pixels of a triangle that was drawn into the window `box`. */
static int take_pixels(work *w, int32_t box[2][2], const lmb_triangle *t)
{
    const lmb_view *v = &w->how.view;
    int ok = 1;
    for (int32_t y = box[1][0]; y < box[1][1] && y < v->frame_height; ++y) {
        for (int32_t x = box[0][0]; x < box[0][1] && x < v->frame_width && ok; ++x) {
            const size_t at = (size_t)(y - box[1][0]) * (size_t)w->wide + (size_t)(x - box[0][0]);
            const size_t pixel = (size_t)y * (size_t)w->wide + (size_t)x;
            const float depth = w->window_depth[at];
            if (w->window_id[at] != t->id || depth < w->depth[pixel] ||
                (depth == w->depth[pixel] && w->opaque[pixel] != 0 && w->opaque[pixel] < t->id)) {
                continue;
            }
            const float a = lmb_triangle_alpha(v, &w->solid, t->id, x, y);
            ok = !(a > 0.0f) || add_fragment(w, pixel, t->id, depth, a < 1.0f ? a : 1.0f);
        }
    }
    return ok;
}

static lmb_status draw_layer_of(work *w, uint32_t id)
{
    lmb_triangle t;
    lmb_target window;
    int32_t box[2][2];
    if (!lmb_triangle_fetch(&t, &w->solid, id) || !is_place(t.corner[0]) || !is_place(t.corner[1]) ||
        !is_place(t.corner[2])) {
        return LMB_OK;
    }
    set_box(box, w, &t);
    const int32_t width = box[0][1] - box[0][0], height = box[1][1] - box[1][0];
    if (width <= 0 || height <= 0) {
        return LMB_OK;
    }
    memset(&window, 0, sizeof window);
    window.depth = rows_of(w, w->window_depth, LMB_DEPTH32F, width, height);
    window.id = rows_of(w, w->window_id, LMB_ID32, width, height);
    window.x0 = box[0][0];
    window.y0 = box[1][0];
    lmb_surface_clear(&window.depth);
    lmb_surface_clear(&window.id);
    const lmb_status status = lmb_draw(&window, w->how.kernels, &w->how.view, &w->solid, id, 1, LMB_CULL_BACK, NULL);
    return status != LMB_OK ? status : take_pixels(w, box, &t) ? LMB_OK : LMB_ERR_CAPACITY;
}

/* Lists the layers of all pixels in front of opaque surfaces. */
static lmb_status draw_layers(work *w)
{
    const lmb_scene *s = w->frame->scene;
    lmb_status status = LMB_OK;
    w->count = 0;
    memset(w->first, 0, w->pixels * sizeof *w->first);
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        const lmb_instance *own = &s->instances[i];
        const uint32_t triangles = is_blended(&s->materials[own->material]) ? s->meshes[own->mesh].triangle_count : 0;
        for (uint32_t k = 0; k < triangles && status == LMB_OK; ++k) {
            status = draw_layer_of(w, own->first_id + k);
        }
    }
    return status;
}

/* Returns whether `a` is in front of `b`. */
static int is_nearer(const fragment *a, const fragment *b)
{
    return a->depth > b->depth || (a->depth == b->depth && a->id < b->id);
}

/* Sorts the pixel's list, the farthest layer first, and leaves out layers behind one of alpha 1 and layers beyond the
 * maximum. Returns 1 if layers were left out for the maximum. */
static int sort_pixel(work *w, size_t pixel)
{
    uint32_t near_first[BLENDED_MAX_LAYERS + 1];
    int count = 0, kept = 0;
    for (uint32_t i = w->first[pixel]; i != 0; i = w->list[i - 1].next) {
        int at = count < BLENDED_MAX_LAYERS ? count++ : BLENDED_MAX_LAYERS;
        for (; at > 0 && is_nearer(&w->list[i - 1], &w->list[near_first[at - 1] - 1]); --at) {
            near_first[at] = near_first[at - 1];
        }
        near_first[at] = i;
    }
    while (kept < count && w->list[near_first[kept++] - 1].alpha < 1.0f) {
    }
    int over = 0;
    const fragment *last = kept > 0 ? &w->list[near_first[kept - 1] - 1] : NULL;
    const int is_full = kept == BLENDED_MAX_LAYERS && last->alpha < 1.0f;
    for (uint32_t i = is_full ? w->first[pixel] : 0; i != 0; i = w->list[i - 1].next) {
        over |= is_nearer(last, &w->list[i - 1]);
    }
    w->first[pixel] = 0;
    for (int k = 0; k < kept; ++k) {
        w->list[near_first[k] - 1].next = w->first[pixel];
        w->first[pixel] = near_first[k];
    }
    return over;
}

/* --- the sample --------------------------------------------------------------------------------------------------- */

static void put_pixel(const work *w, int32_t x, int32_t y, uint32_t id, float depth)
{
    const lmb_surface *s[2] = {&w->how.eye.id, &w->how.eye.depth};
    const size_t tile = (size_t)(y / LMB_TILE) * (size_t)(w->wide / LMB_TILE) + (size_t)(x / LMB_TILE);
    const size_t at = tile * LMB_TILE_PIXELS + (size_t)(y % LMB_TILE * LMB_TILE + x % LMB_TILE);
    ((uint32_t *)s[0]->data)[at] = id;
    ((float *)s[1]->data)[at] = depth;
}

/* The pixels of the eye, row by row. mark: of the eye's first pixel. */
typedef struct place {
    int32_t x, y;
    size_t pixel;        /* in work's rows */
    const uint8_t *mark;
} place;

static int next(place *p, const work *w, const blended *b, int32_t x0)
{
    do {
        if (++p->x == w->frame->view.frame_width) {
            p->x = 0;
            ++p->y;
        }
        if (p->y == w->frame->view.frame_height) {
            return 0;
        }
        p->pixel = (size_t)p->y * (size_t)w->wide + (size_t)p->x;
        p->mark = &b->mark[(size_t)p->y * (size_t)b->width + (size_t)(x0 + p->x)];
    } while (*p->mark == 0);
    return 1;
}

static place begin(void)
{
    const place p = {-1, 0, 0, NULL};
    return p;
}

/* The pixel's light in the finished picture. */
static float *light_at(const work *w, const place *p)
{
    const lmb_surface *out = &w->frame->out;
    return (float *)(void *)((uint8_t *)out->data + (ptrdiff_t)p->y * out->stride_bytes) + 3 * (ptrdiff_t)p->x;
}

static int is_unlit(const work *w, uint32_t id)
{
    lmb_triangle t;
    return lmb_triangle_fetch(&t, w->frame->scene, id) && (t.material->flags & LMB_UNLIT) != 0;
}

/* Lights the opaque surfaces and the background of the marked pixels, into mixed. */
static lmb_status light_opaque(work *w, const blended *b, workers *c, int32_t *stage, lmb_render *r, int32_t x0)
{
    lmb_surface_clear(&w->how.eye.id);
    for (int32_t y = 0; y < w->frame->view.frame_height; ++y) { /* depth of all pixels: views occlude by it */
        for (int32_t x = 0; x < w->frame->view.frame_width; ++x) {
            put_pixel(w, x, y, 0, w->depth[(size_t)y * (size_t)w->wide + (size_t)x]);
        }
    }
    for (place p = begin(); next(&p, w, b, x0);) {
        put_pixel(w, p.x, p.y, w->opaque[p.pixel], w->depth[p.pixel]);
    }
    const lmb_status status = workers_again_drawn(c, stage, r, &w->how);
    for (place p = begin(); status == LMB_OK && next(&p, w, b, x0);) {
        const int unlit = is_unlit(w, w->opaque[p.pixel]);
        w->open[p.pixel] = w->opaque[p.pixel] == 0 ? 1.0f : 0.0f;
        for (size_t k = 3 * p.pixel; k < 3 * p.pixel + 3; ++k) {
            w->mixed[k] = w->light[k];
            w->unlit[k] = unlit ? w->light[k] : 0.0f;
        }
    }
    return status;
}

/* Lights the farthest layer of each pixel, mixes it in and takes it off the list. *any: whether there was one. */
static lmb_status light_layer(int *any, work *w, const blended *b, workers *c, int32_t *stage, lmb_render *r,
                              int32_t x0)
{
    *any = 0;
    for (place p = begin(); next(&p, w, b, x0);) {
        const uint32_t i = w->first[p.pixel];
        put_pixel(w, p.x, p.y, i != 0 ? w->list[i - 1].id : 0, w->depth[p.pixel]);
        *any |= i != 0;
    }
    const lmb_status status = *any ? workers_again_drawn(c, stage, r, &w->how) : LMB_OK;
    for (place p = begin(); *any && status == LMB_OK && next(&p, w, b, x0);) {
        const uint32_t i = w->first[p.pixel];
        if (i != 0) {
            const fragment *f = &w->list[i - 1];
            const int unlit = is_unlit(w, f->id);
            const float behind = 1.0f - f->alpha;
            w->first[p.pixel] = f->next;
            w->open[p.pixel] *= behind;
            for (size_t k = 3 * p.pixel; k < 3 * p.pixel + 3; ++k) {
                w->mixed[k] = f->alpha * w->light[k] + behind * w->mixed[k];
                w->unlit[k] = f->alpha * (unlit ? w->light[k] : 0.0f) + behind * w->unlit[k];
            }
        }
    }
    return status;
}

static lmb_status draw_sample(work *w, int32_t sample)
{
    w->how.view = w->frame->view;
    if (w->frame->samples > 1) {
        lmb_view_sample(&w->how.view, w->frame->samples, sample);
    }
    const lmb_status status = draw_opaque(w);
    return status == LMB_OK ? draw_layers(w) : status;
}

static lmb_status add_sample(work *w, blended *b, workers *c, int32_t *stage, lmb_render *r, int32_t x0)
{
    const float weight = 1.0f / (float)w->frame->samples;
    int any = 1;
    for (place p = begin(); next(&p, w, b, x0);) {
        b->mark[p.mark - b->mark] |= sort_pixel(w, p.pixel) ? BLENDED_OVER : 0;
    }
    lmb_status status = light_opaque(w, b, c, stage, r, x0);
    while (status == LMB_OK && any) {
        status = light_layer(&any, w, b, c, stage, r, x0);
    }
    for (place p = begin(); status == LMB_OK && next(&p, w, b, x0);) {
        const size_t at = (size_t)(p.mark - b->mark);
        float *to = light_at(w, &p);
        b->cover[at] += weight * (1.0f - w->open[p.pixel]);
        for (size_t k = 0; k < 3; ++k) {
            to[k] += weight * w->mixed[3 * p.pixel + k];
            b->unlit[3 * at + k] += weight * w->unlit[3 * p.pixel + k];
        }
    }
    return status;
}

/* Marks the pixels with a layer in any sample, and clears their light. */
static lmb_status mark_pixels(work *w, blended *b, int32_t x0)
{
    lmb_status status = LMB_OK;
    for (int32_t i = 0; i < w->frame->samples && status == LMB_OK; ++i) {
        status = draw_sample(w, i);
        for (int32_t y = 0; y < w->frame->view.frame_height; ++y) {
            for (int32_t x = 0; x < w->frame->view.frame_width; ++x) {
                b->mark[(size_t)y * (size_t)b->width + (size_t)(x0 + x)] |=
                    w->first[(size_t)y * (size_t)w->wide + (size_t)x] != 0 ? BLENDED_SHOWN : 0;
            }
        }
    }
    for (place p = begin(); status == LMB_OK && next(&p, w, b, x0);) {
        const size_t at = (size_t)(p.mark - b->mark);
        memset(light_at(w, &p), 0, 3 * sizeof(float));
        b->cover[at] = 0.0f;
        memset(&b->unlit[3 * at], 0, 3 * sizeof *b->unlit);
    }
    return status;
}

static int open_result(blended *b, int32_t width, int32_t height)
{
    const size_t pixels = (size_t)width * (size_t)height;
    if (b->mark == NULL) {
        b->width = width;
        b->height = height;
        b->mark = calloc(pixels, 1);
        b->cover = calloc(pixels, sizeof *b->cover);
        b->unlit = calloc(pixels, 3 * sizeof *b->unlit);
    }
    return b->mark != NULL && b->cover != NULL && b->unlit != NULL;
}

lmb_status blended_draw(blended *b, workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame, int32_t width,
                        int32_t height, int32_t x0)
{
    work w;
    lmb_frame finished = *frame;
    finished.samples = frame->samples > 0 ? frame->samples : 1;
    lmb_render *before = malloc(sizeof *before);
    int ok = open_work(&w, &finished) && before != NULL && open_result(b, width, height);
    lmb_status status = ok ? LMB_OK : LMB_ERR_CAPACITY;
    if (ok) {
        *before = *r;
        status = mark_pixels(&w, b, x0);
        for (int32_t i = 0; i < finished.samples && status == LMB_OK; ++i) {
            if (finished.samples > 1 || i > 0) { /* one sample was drawn already */
                status = draw_sample(&w, i);
            }
            status = status == LMB_OK ? add_sample(&w, b, c, stage, r, x0) : status;
        }
        *r = *before;
    }
    const size_t bytes = w.bytes + w.cap * sizeof *w.list;
    b->bytes = bytes > b->bytes ? bytes : b->bytes;
    free(before);
    close_work(&w);
    return status;
}

uint32_t blended_over(const blended *b)
{
    uint32_t count = 0;
    for (size_t i = 0; b->mark != NULL && i < (size_t)b->width * (size_t)b->height; ++i) {
        count += (b->mark[i] & BLENDED_OVER) != 0;
    }
    return count;
}

void blended_free(blended *b)
{
    free(b->mark);
    free(b->cover);
    free(b->unlit);
    memset(b, 0, sizeof *b);
}
