/* relief_rooms.c: uses photos with depth as a relief's views and draws from cameras between them. [P5 P11 P12]
 *
 * Four posed frames of ICL-NUIM's living room (Handa et al. 2014); the simple model is made of blocks around the
 * surfaces. Each photo in turn is left out and drawn from the other three. Only pixels with a surface that one of these
 * shows count, by the photo's depth. The relief's PSNR is printed beside that of a lookup at the exact place of the
 * best photo: the rest of the error is glossy reflection and grain of the photos. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/codec.h"
#include "../../src/base/vec.h"
#include "../../tools/relief/relief_photos.h"
#include "../shared_file.h"
#include "relief_stage.h"

enum { PHOTOS = 4, ALL = -1 };

#define BLOCK_M 0.25f
#define SAME    0.01f /* of the distance: tolerance for one surface in two photos' depths */
#define NEAR_M  0.05f

typedef struct room {
    triangle_mesh blocks;
    relief_bake bake;
    file_bytes file;
    lmb_relief relief;
} room;

/* A picture as planes. */
typedef struct shown {
    int32_t width, height;
    float *rgb, *depth;
    uint8_t *hit; /* 1: a photo shows the pixel; 0: nothing, or the blocks' own colour */
} shown;

/* --- rooms -------------------------------------------------------------------------------------------------------- */

/* Returns 0 if a file is missing. */
static int load_photos(relief_photo photo[PHOTOS], report *r)
{
    for (int i = 0; i < PHOTOS; ++i) {
        char name[64], path[SHARED_PATH];
        snprintf(name, sizeof name, "data/rgbd/icl_living_%d.json", i + 1);
        if (!shared_file(path, name)) {
            return 0;
        }
        path[strlen(path) - strlen(".json")] = '\0';
        if (!relief_photo_read(&photo[i], path, r)) {
            give_up(r);
        }
    }
    return 1;
}

static room *room_make(const relief_photo photo[PHOTOS], int without, report *r)
{
    room *m = calloc(1, sizeof *m);
    relief_photo some[PHOTOS];
    int32_t n = 0;
    for (int i = 0; i < PHOTOS; ++i) {
        if (i != without) {
            some[n++] = photo[i];
        }
    }
    int ok = m != NULL && relief_blocks(&m->blocks, some, n, BLOCK_M, r);
    for (int32_t i = 0; i < n && ok; ++i) {
        ok = relief_add_planes(&m->bake, &some[i].view, some[i].depth, some[i].normal, some[i].colour, 0, r);
    }
    ok = ok && relief_encode(&m->file, &m->bake, &m->blocks, r);
    if (!ok || lmb_relief_open(&m->relief, m->file.data, m->file.size) != LMB_OK) {
        report_fail(r, "no relief of a room");
        give_up(r);
    }
    return m;
}

static void room_free(room *m)
{
    triangle_mesh_free(&m->blocks);
    relief_bake_free(&m->bake);
    file_free(&m->file);
    free(m);
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static void *take(size_t bytes)
{
    void *p = calloc(bytes, 1);
    if (p == NULL) {
        printf("FAIL: out of memory\n");
        exit(1);
    }
    return p;
}

static void store(shown *out, const lmb_tile *t, const float *before)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const size_t at = (size_t)(t->y + k / LMB_TILE) * (size_t)out->width + (size_t)(t->x + k % LMB_TILE);
        out->depth[at] = t->depth[k];
        out->hit[at] = t->id[k] != 0 && t->depth[k] != before[k];
        for (size_t c = 0; c < 3; ++c) {
            out->rgb[3 * at + c] = t->albedo[c][k];
        }
    }
}

/* Width and height are multiples of a tile. */
static shown draw(const lmb_relief *relief, const lmb_view *view, const lmb_relief_how *how)
{
    static lmb_tile tile;
    const lmb_kernels *kernels = lmb_kernels_pick();
    const size_t pixels = (size_t)view->frame_width * (size_t)view->frame_height;
    shown out = {view->frame_width, view->frame_height, take(12 * pixels), take(4 * pixels), take(pixels)};
    float *depth = take(4 * pixels), before[LMB_TILE_PIXELS];
    uint32_t *id = take(4 * pixels);
    lmb_scene blocks;
    lmb_target target;
    memset(&target, 0, sizeof target);
    lmb_relief_scene(&blocks, relief);
    lmb_surface_init(&target.depth, LMB_DEPTH32F, out.width, out.height, depth, 4 * pixels);
    lmb_surface_init(&target.id, LMB_ID32, out.width, out.height, id, 4 * pixels);
    lmb_draw(&target, kernels, view, &blocks, 1, lmb_scene_triangles(&blocks), 0, NULL);
    for (int32_t y = 0; y < out.height; y += LMB_TILE) {
        for (int32_t x = 0; x < out.width; x += LMB_TILE) {
            lmb_resolve_tile(&tile, kernels, view, &blocks, &target, x, y);
            memcpy(before, tile.depth, sizeof before);
            lmb_relief_tile(&tile, kernels, relief, view, how, NULL);
            store(&out, &tile, before);
        }
    }
    free(depth);
    free(id);
    return out;
}

static void shown_free(shown *s)
{
    free(s->rgb);
    free(s->depth);
    free(s->hit);
}

/* --- the best possible result ------------------------------------------------------------------------------------- */

/* Interpolates the colour between a photo's pixels, in sRGB codes. */
static void codes_at(double out[3], const relief_photo *p, float u, float v)
{
    const int32_t w = p->view.frame_width, h = p->view.frame_height;
    const int32_t x = mini((int32_t)u, w - 2), y = mini((int32_t)v, h - 2);
    const double fu = (double)(u - (float)x), fv = (double)(v - (float)y);
    for (int c = 0; c < 3; ++c) {
        out[c] = 0.0;
        for (int k = 0; k < 4; ++k) {
            const int32_t at = (y + (k >> 1)) * w + x + (k & 1);
            const double share = (k & 1 ? fu : 1.0 - fu) * (k >> 1 ? fv : 1.0 - fv);
            out[c] += share * (double)lmb_srgb_encode(p->colour[3 * at + c]);
        }
    }
}

/* If the photo shows the point, returns 1 and the colour there. */
static int shows(double out[3], const relief_photo *p, lmb_vec3 at)
{
    const lmb_view *v = &p->view;
    const lmb_vec3 d = sub3(at, v->eye);
    const float w = -dot3(d, v->back);
    const float x = (dot3(d, v->right) / (w * v->half_width) * 0.5f + 0.5f) * (float)v->frame_width - 0.5f,
                y = (0.5f - dot3(d, v->up) / (w * v->half_height) * 0.5f) * (float)v->frame_height - 0.5f;
    if (!(w > 0.0f && x >= 0.0f && y >= 0.0f && x <= (float)(v->frame_width - 1) &&
          y <= (float)(v->frame_height - 1))) {
        return 0;
    }
    const float there = p->depth[(int32_t)(y + 0.5f) * v->frame_width + (int32_t)(x + 0.5f)];
    codes_at(out, p, x, y);
    return fabsf(there - w) <= SAME * w;
}

static lmb_vec3 point_of(const relief_photo *p, int32_t k)
{
    const lmb_view *v = &p->view;
    const int32_t w = v->frame_width;
    const float sx = ((float)(2 * (k % w) + 1) / (float)w - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * (k / w) + 1) / (float)v->frame_height) * v->half_height;
    return add3(v->eye, mul3(sub3(add3(mul3(v->right, sx), mul3(v->up, sy)), v->back), p->depth[k]));
}

/* Of the photos that show a pixel's point, takes the one with the most similar direction, at the exact place. */
static int best_look(double out[3], const relief_photo photo[PHOTOS], int without, int32_t k)
{
    const lmb_vec3 at = point_of(&photo[without], k), ray = normalize3(sub3(at, photo[without].view.eye));
    float best = -2.0f;
    for (int i = 0; i < PHOTOS; ++i) {
        double codes[3];
        const float alike = dot3(ray, normalize3(sub3(at, photo[i].view.eye)));
        if (i != without && alike > best && shows(codes, &photo[i], at)) {
            best = alike;
            memcpy(out, codes, sizeof codes);
        }
    }
    return best > -2.0f;
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

static double decibel(double sum, long long n)
{
    return n > 0 && sum > 0.0 ? 10.0 * log10(255.0 * 255.0 * 3.0 * (double)n / sum) : 99.0;
}

static int rising(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Draws the photo that is left out from the others. */
static void leave_out(const relief_photo photo[PHOTOS], int which, report *r)
{
    static const lmb_relief_how usual = {0, 0, 0, 0, 0};
    room *m = room_make(photo, which, r);
    const relief_photo *truth = &photo[which];
    lmb_view view = truth->view;
    view.near_m = NEAR_M;
    shown got = draw(&m->relief, &view, &usual);
    const int32_t pixels = got.width * got.height;
    float *off = take((size_t)pixels * sizeof *off);
    double sum = 0.0, ideal = 0.0;
    long long valid = 0, n = 0;
    char name[64];
    for (int32_t k = 0; k < pixels; ++k) {
        double look[3];
        if (truth->depth[k] <= 0.0f || !best_look(look, photo, which, k)) {
            continue;
        }
        ++valid;
        if (got.hit[k]) {
            off[n++] = fabsf(got.depth[k] - truth->depth[k]) / truth->depth[k];
            for (int c = 0; c < 3; ++c) {
                const double t = (double)lmb_srgb_encode(truth->colour[3 * k + c]);
                sum += pow((double)lmb_srgb_encode(got.rgb[3 * k + c]) - t, 2.0);
                ideal += pow(look[c] - t, 2.0);
            }
        }
    }
    qsort(off, (size_t)n, sizeof *off, rising);
    printf("photo %d from the others: they show %.1f %% of it, and %.1f %% of that comes out; PSNR %.2f dB (the right "
           "place looked up: %.2f); depth off by %.3f %% (median), %.2f %% (95 of 100)\n", which + 1,
           100.0 * (double)valid / pixels, 100.0 * (double)n / (double)valid, decibel(sum, n), decibel(ideal, n),
           100.0 * (double)off[n / 2], 100.0 * (double)off[n * 95 / 100]);
    snprintf(name, sizeof name, "room_%d_left_out", which + 1);
    relief_show(name, got.rgb, got.width, got.height, r);
    free(off);
    shown_free(&got);
    room_free(m);
}

/* From a photo's own camera: the stored codes must be reproduced. */
static void own(const room *m, const relief_photo *photo, int which)
{
    const lmb_relief_how as_is = {0, LMB_RELIEF_EYE_RAY, 1, 0, 0};
    lmb_view view = photo->view;
    view.near_m = NEAR_M;
    shown got = draw(&m->relief, &view, &as_is);
    const int32_t pixels = got.width * got.height;
    long long colour = 0, hits = 0;
    double depth = 0.0;
    for (int32_t k = 0; k < pixels; ++k) {
        if (photo->depth[k] > 0.0f && got.hit[k]) {
            ++hits;
            for (int c = 0; c < 3; ++c) {
                colour += lmb_srgb_encode(got.rgb[3 * k + c]) != lmb_srgb_encode(photo->colour[3 * k + c]);
            }
            depth = fmax(depth, fabs((double)got.depth[k] - (double)photo->depth[k]));
        }
    }
    printf("photo %d from its own camera: %.2f %% of its pixels, %lld codes differ, depth within %.2g m\n", which + 1,
           100.0 * (double)hits / pixels, colour, depth);
    bar("room", "a photo's own camera gives the photo", hits == pixels && colour == 0 && depth <= 1e-5);
    shown_free(&got);
}

/* From half-way between the cameras of two photos. */
static void between(const room *m, const relief_photo *a, const relief_photo *b, const char *name, report *r)
{
    static const lmb_relief_how usual = {0, 0, 0, 0, 0};
    const lmb_vec3 eye = mul3(add3(a->view.eye, b->view.eye), 0.5f), back = add3(a->view.back, b->view.back),
                   up = add3(a->view.up, b->view.up);
    lmb_view view = a->view;
    view.eye = eye;
    view.back = normalize3(back);
    view.right = normalize3(cross3(up, view.back));
    view.up = cross3(view.back, view.right);
    view.near_m = NEAR_M;
    shown got = draw(&m->relief, &view, &usual);
    long long hits = 0;
    for (int32_t k = 0; k < got.width * got.height; ++k) {
        hits += got.hit[k];
    }
    printf("%s: %.2f %% of the pixels by some photo\n", name, 100.0 * (double)hits / (got.width * got.height));
    relief_show(name, got.rgb, got.width, got.height, r);
    shown_free(&got);
}

void relief_rooms(report *r)
{
    relief_photo photo[PHOTOS];
    memset(photo, 0, sizeof photo);
    if (load_photos(photo, r)) {
        room *m = room_make(photo, ALL, r);
        printf("room of %d photos: blocks of %g m, %u triangles, %.1f MiB\n", PHOTOS, (double)BLOCK_M,
               (unsigned)m->blocks.triangle_count, (double)m->file.size / 1048576.0);
        for (int i = 0; i < PHOTOS; ++i) {
            own(m, &photo[i], i);
        }
        between(m, &photo[0], &photo[3], "room_between_1_4", r);
        between(m, &photo[0], &photo[2], "room_between_1_3", r);
        room_free(m);
        for (int i = 0; i < PHOTOS; ++i) {
            leave_out(photo, i, r);
        }
    }
    for (int i = 0; i < PHOTOS; ++i) {
        relief_photo_free(&photo[i]);
    }
}
