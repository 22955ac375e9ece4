/* accuracy.c: compares the library with the slow rasterizers on one scene, pixel by pixel.
 *
 * A picture shows only the front surfaces, and inside a hall every pixel is covered. So each triangle is also drawn
 * separately and compared in all pixels that it covers. Another check counts bytes of the picture that differ from the
 * separate triangles merged in order. */
#include "accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reference.h"

enum { BACKENDS = 8 };

/* Depth and ids in plain rows of `step` px. */
typedef struct canvas {
    lmb_target target;
    float *depth;
    uint32_t *id;
} canvas;

/* A pixel of the current triangle. */
typedef struct fragment {
    size_t at;
    ref_pixel pixel;
} fragment;

typedef struct contest {
    accuracy *result;
    const lmb_view *view;
    const lmb_scene *scene;
    const lmb_kernels *kernels[BACKENDS];
    uint32_t flags;
    int cull, backends;
    size_t step, count;      /* px from row to row; px with the padding */
    canvas alone[BACKENDS];  /* the current triangle, by each backend; otherwise empty */
    canvas picture, another; /* of all, by the first backend; by one of the others, or without ids */
    float *together;         /* the separate triangles, merged */
    uint32_t *together_id;
    double *best, *drawn;    /* the reference's nearest depth; the reference's depth of the triangle in the picture */
    uint32_t *best_id;
    uint32_t *slot;          /* index in `fragments` at which a pixel may be */
    fragment *fragments;
    size_t fragment_count;
    uint32_t exact_id;       /* of the current triangle of the exact rasterizer */
} contest;

/* --- memory ------------------------------------------------------------------------------------------------------- */

static int make_canvas(canvas *c, const lmb_view *v)
{
    const size_t bytes = lmb_surface_bytes(LMB_DEPTH32F, v->frame_width, v->frame_height);
    memset(c, 0, sizeof *c);
    c->depth = calloc(1, bytes);
    c->id = calloc(1, bytes);
    if (c->depth == NULL || c->id == NULL) {
        return 0;
    }
    lmb_surface_init(&c->target.depth, LMB_DEPTH32F, v->frame_width, v->frame_height, c->depth, bytes);
    lmb_surface_init(&c->target.id, LMB_ID32, v->frame_width, v->frame_height, c->id, bytes);
    c->target.depth.layout = c->target.id.layout = LMB_LINEAR;
    c->target.depth.stride_bytes /= LMB_TILE;
    c->target.id.stride_bytes /= LMB_TILE;
    return 1;
}

static void free_canvas(canvas *c)
{
    free(c->depth);
    free(c->id);
}

static int make_contest(contest *c)
{
    int made = make_canvas(&c->picture, c->view) && make_canvas(&c->another, c->view);
    for (int i = 0; i < c->backends && made; ++i) {
        made = make_canvas(&c->alone[i], c->view);
    }
    c->step = ((size_t)c->view->frame_width + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    c->count = lmb_surface_bytes(LMB_DEPTH32F, c->view->frame_width, c->view->frame_height) / 4;
    c->together = calloc(c->count, sizeof *c->together);
    c->together_id = calloc(c->count, sizeof *c->together_id);
    c->best = calloc(c->count, sizeof *c->best);
    c->drawn = calloc(c->count, sizeof *c->drawn);
    c->best_id = calloc(c->count, sizeof *c->best_id);
    c->slot = calloc(c->count, sizeof *c->slot);
    c->fragments = calloc(c->count, sizeof *c->fragments);
    return made && c->together && c->together_id && c->best && c->drawn && c->best_id && c->slot && c->fragments;
}

static void free_contest(contest *c)
{
    for (int i = 0; i < c->backends; ++i) {
        free_canvas(&c->alone[i]);
    }
    free_canvas(&c->picture);
    free_canvas(&c->another);
    free(c->together);
    free(c->together_id);
    free(c->best);
    free(c->drawn);
    free(c->best_id);
    free(c->slot);
    free(c->fragments);
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

static void get_corners(float out[3][3], const lmb_mesh *m, uint32_t triangle)
{
    for (uint32_t k = 0; k < 3; ++k) {
        const size_t i = 3 * (size_t)triangle + k;
        const size_t vertex = m->indices != NULL ? ((const uint32_t *)m->indices)[i] : i;
        memcpy(out[k], (const float *)m->positions + 3 * vertex, sizeof out[k]);
    }
}

/* Pixels of the last tiles beyond the frame's edge are undefined. */
static int in_frame(const contest *c, size_t at)
{
    return at % c->step < (size_t)c->view->frame_width && at / c->step < (size_t)c->view->frame_height;
}

static void draw(const contest *c, const canvas *to, int backend, int ids, uint32_t first, uint32_t count)
{
    lmb_target t = to->target;
    if (!ids) {
        t.id.data = NULL;
    }
    lmb_draw(&t, c->kernels[backend], c->view, c->scene, first, count, c->flags, NULL);
}

/* --- single triangles --------------------------------------------------------------------------------------------- */

/* Pieces of a clipped triangle may overlap after snapping: takes the nearer depth and the union of the ranges. */
static void keep_fragment(void *user, const ref_pixel *p)
{
    contest *c = user;
    const size_t at = (size_t)p->y * c->step + (size_t)p->x;
    fragment *f = &c->fragments[c->slot[at]];
    if (c->slot[at] >= c->fragment_count || f->at != at) {
        f = &c->fragments[c->fragment_count];
        f->at = at;
        f->pixel = *p;
        c->slot[at] = (uint32_t)c->fragment_count++;
        return;
    }
    f->pixel.d = fmax(f->pixel.d, p->d);
    f->pixel.low = fminf(f->pixel.low, p->low);
    f->pixel.high = fmaxf(f->pixel.high, p->high);
    f->pixel.slope = fmax(f->pixel.slope, p->slope);
}

static double ulps(double off, double d)
{
    int exponent;
    frexp(d, &exponent);
    return fabs(off) * ldexp(1.0, 24 - exponent);
}

static void count_error(error_count *n, float ours, double theirs)
{
    const double error = ulps((double)ours - theirs, theirs);
    ++n->pixels;
    n->none += ours == (float)theirs;
    n->one += error <= 1.0;
    n->two += error <= 2.0;
    n->four += error <= 4.0;
    n->worst = fmax(n->worst, error);
}

/* Bound of the rounding error, in halves of an ulp of 1. Let h be the nearest corner's depth and s the plane's slope a
 * px. A corner's depth takes four operations (orthographic; two in perspective): 4 h. The plane's value at a tile's
 * first pixel, up to 7 px away either way, and the two sums are under h + 7 s, slopes and products under 7 s: 3 h + 35
 * s. (Corners on the guard band round some more; no case showed it.) The term 35 s is small beside the effect of
 * snapping: half of 1/256 px is s / 512, or 32768 s. */
static double step_bound(const ref_pixel *p) { return ldexp(7.0 * (double)p->high + 35.0 * p->slope, -24); }

/* Checks for the same bytes in every backend, then clears the pixel. */
static void take_alone(contest *c, const fragment *f)
{
    const uint32_t id = c->alone[0].id[f->at];
    const float d = c->alone[0].depth[f->at];
    for (int i = 0; i < c->backends; ++i) {
        float *depth = &c->alone[i].depth[f->at];
        c->result->unlike += memcmp(depth, &d, sizeof d) != 0 || c->alone[i].id[f->at] != id;
        *depth = 0.0f;
        c->alone[i].id[f->at] = 0;
    }
    if (d > c->together[f->at]) {
        c->together[f->at] = d;
        c->together_id[f->at] = id;
    }
}

static void compare_fragment(contest *c, const fragment *f, uint32_t id)
{
    accuracy *r = c->result;
    const float d = c->alone[0].depth[f->at];
    if (c->alone[0].id[f->at] != id) {
        ++r->alone.only_one;
    } else {
        count_error(&r->alone, d, f->pixel.d);
        r->past_bound += fabs((double)d - f->pixel.d) > step_bound(&f->pixel);
        r->outside += !(d >= f->pixel.low && d <= f->pixel.high);
    }
    take_alone(c, f);
    if (f->pixel.d > c->best[f->at]) {
        c->best[f->at] = f->pixel.d;
        c->best_id[f->at] = id;
    }
    if (c->picture.id[f->at] == id) {
        c->drawn[f->at] = f->pixel.d;
    }
}

static void compare_triangles(contest *c)
{
    const lmb_mesh *mesh = c->scene->meshes;
    float corners[3][3];
    for (uint32_t k = 0; k < mesh->triangle_count; ++k) {
        for (int i = 0; i < c->backends; ++i) {
            draw(c, &c->alone[i], i, 1, k + 1, 1);
        }
        get_corners(corners, mesh, k);
        c->fragment_count = 0;
        ref_draw_snapped(c->view, (const float(*)[3])corners, c->cull, keep_fragment, c);
        for (size_t i = 0; i < c->fragment_count; ++i) {
            compare_fragment(c, &c->fragments[i], k + 1);
        }
    }
    /* The remaining pixels were covered only by the library. */
    for (int i = 0; i < c->backends; ++i) {
        for (size_t at = 0; at < c->count; ++at) {
            c->result->alone.only_one += in_frame(c, at) && c->alone[i].id[at] != 0;
        }
    }
}

/* --- the picture -------------------------------------------------------------------------------------------------- */

/* All backends and kinds of target must give the first backend's bytes. */
static void compare_backends(contest *c)
{
    for (int run = 1; run < 2 * c->backends; ++run) {
        const int ids = run < c->backends;
        memset(c->another.depth, 0, c->count * 4);
        memset(c->another.id, 0, c->count * 4);
        draw(c, &c->another, run % c->backends, ids, 1, c->scene->meshes->triangle_count);
        for (size_t at = 0; at < c->count; ++at) {
            c->result->unlike += in_frame(c, at) && (memcmp(&c->another.depth[at], &c->picture.depth[at], 4) != 0 ||
                                                     (ids && c->another.id[at] != c->picture.id[at]));
        }
    }
}

static void compare_picture(contest *c)
{
    accuracy *r = c->result;
    for (size_t at = 0; at < c->count; ++at) {
        const float d = c->picture.depth[at];
        if (!in_frame(c, at)) {
            continue;
        }
        r->unlike += memcmp(&d, &c->together[at], sizeof d) != 0 || c->picture.id[at] != c->together_id[at];
        if ((c->picture.id[at] != 0) != (c->best_id[at] != 0)) {
            ++r->frame.only_one;
        } else if (c->best_id[at] != 0) {
            count_error(&r->frame, d, c->best[at]);
            if (c->picture.id[at] != c->best_id[at]) {
                ++r->fights;
                r->fight_gap = fmax(r->fight_gap, ulps(c->best[at] - c->drawn[at], c->best[at]));
            }
        }
    }
}

static void keep_exact(void *user, const ref_pixel *p)
{
    contest *c = user;
    const size_t at = (size_t)p->y * c->step + (size_t)p->x;
    if (p->d > c->best[at]) {
        c->best[at] = p->d;
        c->best_id[at] = c->exact_id;
    }
}

static void compare_exact(contest *c)
{
    const lmb_mesh *mesh = c->scene->meshes;
    accuracy *r = c->result;
    float corners[3][3];
    memset(c->best, 0, c->count * sizeof *c->best);
    memset(c->best_id, 0, c->count * sizeof *c->best_id);
    for (uint32_t k = 0; k < mesh->triangle_count; ++k) {
        get_corners(corners, mesh, k);
        c->exact_id = k + 1;
        ref_draw_exact(c->view, (const float(*)[3])corners, c->cull, keep_exact, c);
    }
    for (size_t at = 0; at < c->count; ++at) {
        const uint32_t ours = in_frame(c, at) ? c->picture.id[at] : 0, theirs = c->best_id[at];
        if ((ours != 0) != (theirs != 0)) {
            ++r->exact_only_one;
        } else if (ours != theirs) {
            ++r->exact_other;
        } else if (ours != 0) {
            const double off = fabs((double)c->picture.depth[at] - c->best[at]) / c->best[at];
            ++r->exact_same;
            r->exact_mean += off;
            r->exact_max = fmax(r->exact_max, off);
        }
    }
    r->exact_mean /= r->exact_same > 0 ? (double)r->exact_same : 1.0;
}

int accuracy_measure(accuracy *out, const lmb_view *view, const lmb_scene *scene, int cull)
{
    contest c;
    memset(out, 0, sizeof *out);
    memset(&c, 0, sizeof c);
    c.result = out;
    c.view = view;
    c.scene = scene;
    c.cull = cull;
    c.flags = cull ? LMB_CULL_BACK : 0;
    while (c.backends < BACKENDS && lmb_kernels_at(c.backends) != NULL) {
        c.kernels[c.backends] = lmb_kernels_at(c.backends);
        ++c.backends;
    }
    out->backends = c.backends;
    const int made = make_contest(&c);
    if (made) {
        draw(&c, &c.picture, 0, 1, 1, scene->meshes->triangle_count);
        compare_backends(&c);
        compare_triangles(&c);
        compare_picture(&c);
        compare_exact(&c);
    }
    free_contest(&c);
    return made;
}
