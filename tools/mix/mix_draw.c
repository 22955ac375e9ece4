/* mix_draw.c: the photo as the object changes it, and the object over it, tile by tile. */
#include "mix_again.h"
#include "mix_cones.h"
#include "mix_front.h"
#include "mix_carry.h"
#include "mix_labels.h"
#include "mix_lights.h"
#include "mix_lobes.h"
#include "mix_near.h"
#include "mix_world.h"

#include <stdlib.h>
#include <string.h>

#include "../common/binned.h"
#include "../common/progress.h"
#include "../picture/picture.h"

enum { MIX_SAMPLES = 16 }; /* maximum */

/* The memory that one tile is drawn in. */
typedef struct drawing {
    lmb_view view[MIX_SAMPLES]; /* by sample */
    int32_t x0, y0;              /* the photo's origin in the views' frame */
    lmb_target eye[MIX_SAMPLES]; /* the object's, by sample */
    int32_t samples;             /* per pixel, of the object */
    mix_batch batch;
    lmb_tile there;          /* a tile in voxel space */
    lmb_tile object, before; /* before: real surfaces that hide it */
    mix_near near;
    lmb_irradiance lit;
    mix_lobes lobes;
    lmb_radiance light, photo;
    lmb_radiance bare; /* the photo before the object */
    lmb_radiance over; /* radiance and coverage of the object's part of the pixels */
    float covered[LMB_TILE_PIXELS];
    lmb_cone_seen seen[2];
} drawing;

int mix_image(image *out, int32_t width, int32_t height, report *r)
{
    out->width = width;
    out->height = height;
    out->channels = 3;
    out->pixels = calloc(3 * (size_t)width * (size_t)height, sizeof(float));
    return out->pixels != NULL || report_fail(r, "out of memory");
}

/* --- the object's depth and ids ----------------------------------------------------------------------------------- */

static int draw_sample(drawing *d, mix_job *j, binned *bins, int32_t i, report *r)
{
    const int32_t w = (j->frame.camera.width + LMB_TILE - 1) / LMB_TILE * LMB_TILE,
                  h = (j->frame.camera.height + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    const size_t depth_bytes = lmb_surface_bytes(LMB_DEPTH32F, w, h), id_bytes = lmb_surface_bytes(LMB_ID32, w, h);
    void *depth = mix_take(j, depth_bytes, r), *id = mix_take(j, id_bytes, r);
    if (depth == NULL || id == NULL) {
        return 0;
    }
    lmb_target *eye = &d->eye[i];
    lmb_surface_init(&eye->depth, LMB_DEPTH32F, w, h, depth, depth_bytes);
    lmb_surface_init(&eye->id, LMB_ID32, w, h, id, id_bytes);
    eye->x0 = d->x0;
    eye->y0 = d->y0;
    d->view[i] = d->view[0];
    lmb_status status = d->samples > 1 ? lmb_view_sample(&d->view[i], d->samples, i) : LMB_OK;
    if (status == LMB_OK && j->object_triangles > 0) {
        const binned_draw object = {eye, j->o.kernels, &d->view[i], &j->scene, j->real_triangles + 1,
                                    j->object_triangles, LMB_CULL_BACK | LMB_BLEND, pool_threads(j->o.threads)};
        status = binned_run(bins, &object);
    }
    return status == LMB_OK || report_fail(r, "the object cannot be drawn: %s", lmb_status_name(status));
}

/* Differences, and the object without the photo, are for measuring: one sample. */
static int32_t samples_of(const mix_options *o)
{
    const int is_linear = picture_is_linear(picture_format(o->out));
    return o->show != MIX_FINAL ? 1 : o->samples != 0 ? o->samples : is_linear ? 1 : 4;
}

static int draw_object(drawing *d, mix_job *j, report *r)
{
    d->samples = samples_of(&j->o);
    if (lmb_photo_view(&d->view[0], &d->x0, &d->y0, &j->frame.camera, &j->axes) != LMB_OK) {
        return report_fail(r, "intrinsics: the camera's axis is too far outside the photo");
    }
    binned bins;
    memset(&bins, 0, sizeof bins);
    int32_t i = d->samples;
    while (i > 0 && draw_sample(d, j, &bins, i - 1, r)) { /* the first one last: the others' views derive from it */
        --i;
    }
    binned_free(&bins);
    return i == 0;
}

/* --- tiles -------------------------------------------------------------------------------------------------------- */

static void get_photo(lmb_radiance *out, const image *p, int32_t x, int32_t y)
{
    memset(out, 0, sizeof *out);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        for (int c = 0; c < 3 && px < p->width && py < p->height; ++c) {
            out->rgb[c][k] = p->pixels[3 * ((size_t)py * (size_t)p->width + (size_t)px) + (size_t)c];
        }
    }
}

static void put_tile(image *p, const lmb_radiance *in, int32_t x, int32_t y)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        for (int c = 0; c < 3 && px < p->width && py < p->height; ++c) {
            p->pixels[3 * ((size_t)py * (size_t)p->width + (size_t)px) + (size_t)c] = in->rgb[c][k];
        }
    }
}

static void light_object(drawing *d, const mix_job *j, const lmb_view *view, int32_t sample)
{
    memset(&d->lit, 0, sizeof d->lit);
    if (j->kept != NULL) {
        mix_cones_near(&d->lit, j, &d->object, &d->near);
    } else {
        mix_cones_tile(&d->lit, j, &d->object);
    }
    mix_lobes_lights(&d->lobes, &d->lit, j, view, &d->object, sample, d->samples);
    lmb_compose_tile(&d->light, j->o.kernels, &d->object, &d->lit, NULL);
    mix_lobes_finish(&d->light, &d->lobes, j, view, &d->object);
}

/* Replaces the picture by the one that --show selects: differences of real pixels, or the object before black. */
static void choose(drawing *d, const mix_job *j, const lmb_tile *real, uint64_t shown)
{
    lmb_radiance before;
    if (j->o.show == MIX_FINAL) {
        return;
    }
    get_photo(&before, &j->frame.light, real->x, real->y);
    /* Relative to middle grey if the format cannot hold negative values. */
    const float zero = j->o.show == MIX_DELTA && !picture_is_linear(picture_format(j->o.out)) ? 0.2140411f : 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int is_object = (int)(shown >> k & 1);
        for (int c = 0; c < 3; ++c) {
            const float v = d->photo.rgb[c][k];
            d->photo.rgb[c][k] = j->o.show == MIX_OBJECT ? (is_object ? v : 0.0f)
                                 : is_object             ? zero
                                                         : zero + v - before.rgb[c][k];
        }
    }
}

/* Does a tile show the varnished plane? */
static int is_varnished(const mix_job *j, const lmb_tile *real)
{
    for (int k = 0; k < LMB_TILE_PIXELS && j->o.specular > 0.0f && j->world != NULL; ++k) {
        const int32_t at = (real->y + k / LMB_TILE) * j->frame.camera.width + real->x + k % LMB_TILE;
        if (real->id[k] != 0 && j->planes.label[at] != 0 && (j->floor < 0 || j->planes.label[at] == j->floor + 1)) {
            return 1;
        }
    }
    return 0;
}

static void mirror(drawing *d, const mix_job *j, const lmb_tile *real)
{
    const lmb_vec3 eye = {0, 0, 0};
    for (int32_t world = 0; world < 2; ++world) {
        const lmb_cone_trace trace = mix_trace(j, world);
        lmb_cones_glossy(&d->seen[world], &trace, &j->world->glossy, mix_tile_there(&d->there, j, real),
                         mix_point_there(j, eye));
    }
    lmb_mirror_tile(&d->photo, real, &j->planes, &j->frame.camera, j->floor, &d->seen[0], &d->seen[1], j->o.specular);
}

/* Draws one sample of the object over the photo. Returns the pixels that show it. */
static uint64_t put_sample(drawing *d, mix_job *j, const lmb_tile *real, int32_t sample)
{
    const lmb_view *view = &d->view[sample];
    if (lmb_resolve_tile(&d->object, j->o.kernels, view, &j->scene, &d->eye[sample], d->x0 + real->x,
                         d->y0 + real->y) != LMB_OK || d->object.hits == 0) {
        return 0;
    }
    light_object(d, j, view, sample);
    mix_front_tile(&d->before, real, &d->object, j->front, &j->cloud, (float)view->sample_x * (1.0f / 256.0f),
                   (float)view->sample_y * (1.0f / 256.0f));
    return lmb_object_tile(&d->photo, &d->light, &d->object, &d->before, &j->cloud);
}

static void add_part(drawing *d, uint64_t shown, float weight)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int c = 0; c < 3 && (shown >> k & 1u) != 0; ++c) {
            d->over.rgb[c][k] += weight * d->light.rgb[c][k];
        }
        d->covered[k] += (shown >> k & 1u) != 0 ? weight : 0.0f;
    }
}

/* Draws the mean of the object's samples over the photo. */
static uint64_t put_object(drawing *d, mix_job *j, const lmb_tile *real, int is_kept)
{
    uint64_t all = 0;
    d->bare = d->photo;
    memset(d->near.tile.id, 0, sizeof d->near.tile.id);
    memset(&d->over, 0, sizeof d->over);
    memset(d->covered, 0, sizeof d->covered);
    for (int32_t i = 0; i < d->samples && !is_kept; ++i) {
        const uint64_t shown = put_sample(d, j, real, i);
        add_part(d, shown, 1.0f / (float)d->samples);
        mix_labels_sample(j, real, &d->object, shown);
        all |= shown;
    }
    mix_again_object(&d->over, d->covered, j, real);
    mix_labels_cover(j, real, &d->over, d->covered);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int c = 0; c < 3; ++c) {
            d->photo.rgb[c][k] = mix_over(d->bare.rgb[c][k], d->over.rgb[c][k], d->covered[k]);
        }
    }
    mix_labels_grain(&d->photo, j, real, d->covered);
    return all;
}

static void draw_tile(drawing *d, mix_job *j, int32_t i)
{
    const lmb_tile *real = &d->batch.real[i];
    get_photo(&d->photo, &j->frame.light, real->x, real->y);
    const int is_kept = mix_again_light(&d->batch.light[0][i], &d->batch.light[1][i], j, real);
    if (!is_kept) {
        mix_lights_tile(&d->batch.light[0][i], &d->batch.light[1][i], &d->batch.direct[i], j, &d->view[0], real);
        mix_carry_put_direct(j, real, &d->batch.direct[i]);
    }
    mix_again_light(&d->batch.light[0][i], &d->batch.light[1][i], j, real); /* already includes the lights */
    lmb_delta_tile(&d->photo, real, &d->batch.light[0][i],
                   mix_soften(&d->lit, &d->batch.light[1][i], &d->batch.light[0][i], j->softens));
    if (is_varnished(j, real)) {
        mirror(d, j, real);
    }
    const uint64_t shown = put_object(d, j, real, is_kept);
    mix_again_keep(j, real, &d->batch.light[0][i], &d->batch.light[1][i], &d->over, d->covered);
    choose(d, j, real, shown);
    put_tile(&j->picture, &d->photo, real->x, real->y);
}

/* Draws tiles of one row, from x on. */
static void draw_batch(drawing *d, mix_job *j, int32_t x, int32_t y)
{
    mix_batch *b = &d->batch;
    for (b->count = 0; b->count < MIX_BATCH && x < j->picture.width; x += LMB_TILE) {
        lmb_real_tile(&b->real[b->count++], &j->cloud, &j->planes, &j->real, &j->axes, x, y);
    }
    mix_cones_batch(b, j);
    for (int32_t i = 0; i < b->count; ++i) {
        draw_tile(d, j, i);
    }
}

/* Rows of tiles that several threads draw, each with separate memory. */
typedef struct rows {
    mix_job *jobs; /* by thread: the job, with separate scratch for cones */
    drawing *drawings;
    int threads;
} rows;

static void draw_row(void *user, int row, int thread)
{
    const rows *all = user;
    mix_job *j = &all->jobs[thread];
    for (int32_t x = 0; x < j->picture.width; x += MIX_BATCH * LMB_TILE) {
        draw_batch(&all->drawings[thread], j, x, row * LMB_TILE);
    }
    if (thread == 0) {
        progress_tell("picture", (double)(row * LMB_TILE) / (double)j->picture.height);
    }
}

static int find_front(mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.camera.width * (size_t)j->frame.camera.height;
    mix_way *way = mix_take(j, pixels * sizeof *way, r);
    j->front = mix_take(j, pixels * sizeof *j->front, r);
    if (way == NULL || j->front == NULL) {
        return 0;
    }
    if (j->object_triangles > 0) {
        mix_front_refine(j->front, way, &j->cloud, &j->planes, j->frame.light.pixels, j->box_px);
    }
    return 1;
}

static int take_rows(rows *out, mix_job *j, report *r)
{
    out->threads = pool_threads(j->o.threads);
    const size_t n = (size_t)out->threads;
    out->jobs = mix_take(j, n * sizeof *out->jobs, r);
    out->drawings = mix_take(j, n * sizeof *out->drawings, r);
    lmb_cone_scratch *scratch = mix_take(j, n * sizeof *scratch, r);
    if (out->jobs == NULL || out->drawings == NULL || scratch == NULL ||
        !mix_image(&j->picture, j->frame.light.width, j->frame.light.height, r) ||
        !draw_object(&out->drawings[0], j, r)) {
        return 0;
    }
    for (size_t i = 0; i < n; ++i) {
        out->jobs[i] = *j;
        out->jobs[i].scratch = &scratch[i];
        out->drawings[i] = out->drawings[0];
    }
    return 1;
}

int mix_draw(mix_job *j, report *r)
{
    rows all;
    mix_lights_begin(j);
    if (!mix_lobes_take(j, r) || !mix_labels_take(j, r) || !mix_again_take(j, r) || !mix_carry_take(j, r) ||
        !find_front(j, r) || !take_rows(&all, j, r)) {
        return 0;
    }
    mix_run_rows(j, all.threads, (j->picture.height + LMB_TILE - 1) / LMB_TILE, draw_row, &all);
    return 1;
}
