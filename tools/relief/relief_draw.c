/* relief_draw.c: pictures of a relief, of ordinary geometry, and of both together. [P1 P7 P11] */
#include "relief_draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../common/binned.h"
#include "../common/fvec.h"
#include "../common/progress.h"
#include "relief_bounce.h"
#include "relief_crowd.h"
#include "relief_sky.h"

/* One kind of geometry, with the target for resolving pixels and the shadow map. */
typedef struct layer {
    const lmb_scene *scene;
    lmb_target target;
    lmb_shadow_map map;
    void *depth_memory, *id_memory, *map_memory;
} layer;

struct work;

/* The memory one thread draws a tile in. */
typedef struct pen {
    struct work *of;
    lmb_tile tile, other;
    lmb_irradiance direct, open, indirect;
    relief_bounce bounce; /* the work's, with a separate cut */
    relief_sky_scratch sky;
    crowd_band band;
    int32_t band_row; /* the band's first tile row */
    lmb_radiance radiance, open_radiance;
    lmb_relief_stats stats;
    lmb_status failed;
} pen;

typedef struct work {
    relief_frame *out;
    const relief_shot *shot;
    lmb_view view;       /* the shot's, for the current sample */
    int32_t samples, drawn; /* per pixel; number already drawn */
    lmb_scene simple;
    layer plain, relief; /* scene NULL: none */
    lmb_tile tile;       /* of shadow maps */
    relief_seen *seen;   /* placements of a crowd in the view */
    uint32_t seen_count;
    relief_bounce bounce;
    pen *pens;
    binned bins;
    int threads;
} work;

static void *take(work *w, size_t bytes, report *r)
{
    void *p = calloc(bytes > 0 ? bytes : 1, 1);
    w->out->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted", (double)bytes / 1048576.0);
    }
    return p;
}

static int take_layer(work *w, layer *l, report *r)
{
    const int32_t width = w->shot->view.frame_width, height = w->shot->view.frame_height;
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, width, height),
                 id = lmb_surface_bytes(LMB_ID32, width, height);
    l->depth_memory = take(w, depth, r);
    l->id_memory = take(w, id, r);
    if (l->depth_memory == NULL || l->id_memory == NULL) {
        return 0;
    }
    lmb_surface_init(&l->target.depth, LMB_DEPTH32F, width, height, l->depth_memory, depth);
    lmb_surface_init(&l->target.id, LMB_ID32, width, height, l->id_memory, id);
    return 1;
}

/* --- the shadow map ---------------------------------------------------------------------------------------------- */

#define FINEST        0.75f /* of a view's texel */
#define FINEST_PIXELS 0.5f  /* of a pixel at the nearest point of the bounds */

/* Side of a pixel where the eye is nearest to the bounds, m. */
static float nearest_pixel(const lmb_view *v, const lmb_scene *s)
{
    const lmb_vec3 near = max3(s->bounds_min, min3(s->bounds_max, v->eye));
    const float side = 2.0f * maxf(v->half_width / (float)v->frame_width, v->half_height / (float)v->frame_height);
    return v->kind == LMB_PERSPECTIVE ? side * length3(sub3(near, v->eye)) : side;
}

/* m, or m at a view's near plane. */
static float coarsest_texel(const lmb_relief *r)
{
    float texel = 0.0f;
    for (int32_t i = 0; i < r->views; ++i) {
        const lmb_relief_view *v = &r->view[i];
        texel = maxf(texel, v->perspective ? v->texel * v->near_m : v->texel);
    }
    return texel;
}

/* Texels per side of a layer's map. A relief's map need not be much finer than the coarsest texels of the views,
 * because the views show no finer detail, nor than the picture's pixels, and the cost is proportional to warped
 * texels. */
static int32_t map_side(const work *w, const layer *l, const lmb_scene *bounds, const lmb_scene *all)
{
    const float across = length3(sub3(bounds->bounds_max, bounds->bounds_min));
    float texel = 0.0f;
    if (l != &w->relief) {
        return w->shot->shadow_map;
    }
    const relief_crowd *crowd = w->shot->crowd;
    if (crowd == NULL) {
        texel = coarsest_texel(w->shot->relief);
    }
    for (uint32_t i = 0; crowd != NULL && i < crowd->count; ++i) {
        const float own = coarsest_texel(crowd->placed[i].relief) * crowd->placed[i].scale;
        texel = i == 0 ? own : minf(texel, own);
    }
    texel = maxf(FINEST * texel, FINEST_PIXELS * nearest_pixel(&w->shot->view, all));
    const float wanted = texel > 0.0f ? ceilf(across / (8.0f * texel)) * 8.0f : 1e9f;
    return wanted < (float)w->shot->shadow_map ? (int32_t)fmaxf(wanted, 8.0f) : w->shot->shadow_map;
}

/* Faces of a crowd's map, drawn by bands. */
typedef struct crowd_map {
    const work *of;
    const lmb_shadow_map *map;
    int32_t face;
    relief_seen *seen;
    uint32_t count;
    crowd_band band[POOL_MAX];
    lmb_status failed[POOL_MAX];
} crowd_map;

/* Converts a distance along the axis to a shadow map's depth. */
static float map_depth(const lmb_view *v, float z)
{
    const float d =
        v->kind == LMB_PERSPECTIVE ? v->near_m / maxf(z, v->near_m) : (v->far_m - z) / (v->far_m - v->near_m);
    return clampf(d, 0.0f, 1.0f);
}

static void store_map_tile(const lmb_surface *depth, const lmb_view *v, const crowd_tile *tile, int32_t x, int32_t y)
{
    uint8_t *row = (uint8_t *)depth->data + (ptrdiff_t)y * depth->stride_bytes;
    float *to = (float *)(void *)(row + (size_t)x * LMB_TILE_PIXELS * sizeof(float));
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        to[k] = tile->depth[k] > 0.0f ? map_depth(v, tile->depth[k]) : 0.0f;
    }
}

static void draw_map_band(void *user, int index, int thread)
{
    crowd_map *m = user;
    crowd_band *b = &m->band[thread];
    const lmb_view *v = &m->map->view[m->face];
    const int32_t rows = m->map->size / LMB_TILE, first = index * CROWD_ROWS,
                  past = first + CROWD_ROWS < rows ? first + CROWD_ROWS : rows;
    if (m->failed[thread] != LMB_OK) {
        return;
    }
    m->failed[thread] =
        crowd_band_draw(b, m->seen, m->count, v, m->of->shot->kernels, &m->of->shot->how, first, past, NULL);
    for (int32_t i = 0; i < rows * (past - first) && m->failed[thread] == LMB_OK; ++i) {
        store_map_tile(&m->map->face[m->face].depth, v, &b->tiles[i / rows * b->columns + i % rows], i % rows,
                       first + i / rows);
    }
}

static lmb_status draw_crowd_map(work *w, const lmb_shadow_map *map)
{
    crowd_map *m = calloc(1, sizeof *m);
    lmb_status status = m != NULL ? LMB_OK : LMB_ERR_CAPACITY;
    if (status == LMB_OK) {
        m->of = w;
        m->map = map;
        m->seen = w->seen;
        for (int i = 0; i < w->threads; ++i) {
            status = crowd_band_take(&m->band[i], map->size) > 0 ? status : LMB_ERR_CAPACITY;
        }
    }
    for (int32_t f = 0; f < map->faces && status == LMB_OK; ++f) {
        if ((map->drawn >> f & 1u) != 0) {
            m->face = f;
            m->count = relief_crowd_see(m->seen, w->shot->crowd, &map->view[f]);
            pool_run(w->threads, (map->size / LMB_TILE + CROWD_ROWS - 1) / CROWD_ROWS, draw_map_band, m);
        }
    }
    for (int i = 0; m != NULL && i < w->threads; ++i) {
        status = status != LMB_OK ? status : m->failed[i];
        crowd_band_free(&m->band[i]);
    }
    free(m);
    return status;
}

/* The map is fitted to `bounds`; `all` has receivers too. */
static int draw_map(work *w, layer *l, const lmb_scene *bounds, const lmb_scene *all, report *r)
{
    const relief_shot *s = w->shot;
    const int32_t side = map_side(w, l, bounds, all);
    const size_t bytes = lmb_shadow_map_bytes(lmb_shadow_map_faces(s->light, bounds), side, LMB_ID32);
    w->out->map_side = side;
    l->map_memory = take(w, bytes, r);
    if (l->map_memory == NULL) {
        return 0;
    }
    lmb_status status = lmb_shadow_map_init(&l->map, s->light, bounds, side, LMB_ID32, l->map_memory, bytes);
    if (status == LMB_OK) {
        lmb_shadow_map_clear(&l->map);
    }
    if (status == LMB_OK && l == &w->relief && s->crowd != NULL) {
        status = draw_crowd_map(w, &l->map);
    } else if (status == LMB_OK) {
        status = lmb_shadow_map_draw(&l->map, s->kernels, l->scene, 1, lmb_scene_triangles(l->scene), NULL);
    }
    if (status == LMB_OK && l == &w->relief && s->crowd == NULL) {
        status = lmb_relief_shadow_rows(&l->map, s->kernels, &w->tile, s->relief, &s->how, 0,
                                        l->map.faces * (l->map.size / LMB_TILE));
    }
    return status == LMB_OK || report_fail(r, "--light: its map cannot be drawn: %s", lmb_status_name(status));
}

/* A sun's map is fitted to the relief's bounds. Points beside the map are lit. */
static int draw_maps(work *w, report *r)
{
    lmb_scene bounds = w->plain.scene != NULL ? *w->plain.scene : w->simple;
    const int is_sun = w->shot->light->kind == LMB_LIGHT_DIRECTIONAL;
    if (w->plain.scene != NULL && w->relief.scene != NULL) {
        bounds.bounds_min = min3(bounds.bounds_min, w->simple.bounds_min);
        bounds.bounds_max = max3(bounds.bounds_max, w->simple.bounds_max);
    }
    return (w->plain.scene == NULL || draw_map(w, &w->plain, &bounds, &bounds, r)) &&
           (w->relief.scene == NULL || draw_map(w, &w->relief, is_sun ? &w->simple : &bounds, &bounds, r));
}

/* --- a tile ------------------------------------------------------------------------------------------------------- */

/* Resolves both layers and keeps the nearer surface. */
static lmb_status resolve(pen *w, int32_t x, int32_t y)
{
    const relief_shot *s = w->of->shot;
    lmb_status status = LMB_OK;
    if (w->of->plain.scene != NULL) {
        status = lmb_resolve_tile(&w->tile, s->kernels, &w->of->view, w->of->plain.scene, &w->of->plain.target, x, y);
    }
    if (status == LMB_OK && w->of->relief.scene != NULL) {
        lmb_tile *t = w->of->plain.scene != NULL ? &w->other : &w->tile;
        if (s->crowd != NULL) {
            crowd_band_tile(t, &w->band, x / LMB_TILE, y / LMB_TILE - w->band_row, x, y);
        } else {
            status = lmb_resolve_tile(t, s->kernels, &w->of->view, w->of->relief.scene, &w->of->relief.target, x, y);
        }
        if (status == LMB_OK && s->crowd == NULL) {
            status = lmb_relief_tile(t, s->kernels, s->relief, &w->of->view, &s->how, &w->stats);
        }
        if (status == LMB_OK && w->of->plain.scene != NULL) {
            lmb_relief_nearer(&w->tile, t);
        }
    }
    return status;
}

/* Ordinary geometry casts shadows by triangles, the relief by depth. */
static lmb_status light_tile(pen *w)
{
    const relief_shot *s = w->of->shot;
    const int shadows = s->shadow_map > 0;
    const lmb_shadow_map *map = shadows && w->of->plain.scene != NULL ? &w->of->plain.map : NULL;
    const lmb_scene *scene = w->of->plain.scene != NULL ? w->of->plain.scene : w->of->relief.scene;
    memset(&w->direct, 0, sizeof w->direct);
    memset(&w->open, 0, sizeof w->open);
    if (s->light == NULL) {
        return LMB_OK;
    }
    lmb_status status = lmb_direct_tile(&w->open, s->kernels, &w->tile, &w->of->view, scene, s->light, NULL);
    if (status != LMB_OK || map == NULL) {
        w->direct = w->open;
    } else {
        status = lmb_direct_tile(&w->direct, s->kernels, &w->tile, &w->of->view, scene, s->light, map);
    }
    if (status == LMB_OK && shadows && w->of->relief.scene != NULL) {
        const uint64_t lit = lmb_relief_lit(&w->of->relief.map, s->light, &w->tile);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            for (int c = 0; c < 3 && (lit >> k & 1u) == 0; ++c) {
                w->direct.rgb[c][k] = 0.0f;
            }
        }
    }
    return status;
}

/* Adds bounced and ambient light, and the sky's. */
static lmb_status bounce_tile(pen *w)
{
    uint64_t of_relief = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int is_relief = w->of->plain.scene == NULL || w->tile.id[k] == LMB_MAX_TRIANGLES;
        of_relief |= (uint64_t)(w->of->relief.scene != NULL && is_relief) << k;
        for (int c = 0; c < 3; ++c) {
            w->indirect.rgb[c][k] = w->of->shot->ambient;
        }
    }
    lmb_status status = LMB_OK;
    if (w->of->shot->bounce > 0 && w->of->shot->light != NULL) {
        status = relief_bounce_tile(&w->indirect, &w->bounce, w->of->shot->kernels, &w->tile, of_relief);
    }
    if (status == LMB_OK && w->of->shot->sky != NULL) {
        status = relief_sky_tile(&w->indirect, &w->sky, w->of->shot->sky, w->of->shot->kernels, &w->tile, of_relief,
                                 &w->bounce.plain, &w->bounce.both);
    }
    return status;
}

/* Adds the sky to an empty pixel. */
static void store_behind(pen *w, int32_t x, int32_t y, float rgb[3])
{
    float behind[3];
    relief_sky_behind(behind, w->of->shot->sky, &w->of->view, x, y);
    for (int c = 0; c < 3; ++c) {
        rgb[c] += behind[c] / (float)w->of->samples;
    }
}

static void store(pen *w)
{
    relief_frame *f = w->of->out;
    const int has_sky = w->of->shot->sky != NULL && w->of->shot->shows_sky;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = w->tile.x + k % LMB_TILE, y = w->tile.y + k / LMB_TILE;
        if (x >= f->width || y >= f->height) {
            continue;
        }
        const size_t at = (size_t)y * (size_t)f->width + (size_t)x;
        f->depth[at] = w->tile.depth[k];
        f->lit[at] = w->direct.rgb[0][k] + w->direct.rgb[1][k] + w->direct.rgb[2][k] > 0.0f;
        for (size_t c = 0; c < 3; ++c) {
            f->normal[3 * at + c] = w->tile.normal[c][k];
            f->albedo[3 * at + c] = w->tile.albedo[c][k];
            f->rgb[3 * at + c] += w->radiance.rgb[c][k] / (float)w->of->samples;
            f->open[3 * at + c] = w->open_radiance.rgb[c][k];
        }
        f->cover[at] += w->tile.id[k] != 0 ? 1.0f / (float)w->of->samples : 0.0f;
        if (has_sky && w->tile.id[k] == 0) {
            store_behind(w, x, y, f->rgb + 3 * at);
        }
    }
}

static lmb_status draw_tile(pen *w, int32_t x, int32_t y)
{
    const relief_shot *s = w->of->shot;
    lmb_status status = resolve(w, x, y);
    if (status == LMB_OK && (s->light != NULL || s->sky != NULL)) {
        status = light_tile(w);
        if (status == LMB_OK) {
            status = bounce_tile(w);
        }
        if (status == LMB_OK) {
            status = lmb_compose_tile(&w->radiance, s->kernels, &w->tile, &w->direct, &w->indirect);
        }
        if (status == LMB_OK) {
            status = lmb_compose_tile(&w->open_radiance, s->kernels, &w->tile, &w->open, &w->indirect);
        }
    }
    store(w);
    return status;
}

/* --- a frame ------------------------------------------------------------------------------------------------------ */

static lmb_status draw_layer(work *w, layer *l)
{
    if (l == &w->relief && w->shot->crowd != NULL) {
        w->seen_count = relief_crowd_see(w->seen, w->shot->crowd, &w->view);
        return LMB_OK; /* by bands */
    }
    if (l->scene == NULL) {
        return LMB_OK;
    }
    const binned_draw all = {&l->target, w->shot->kernels, &w->view, l->scene, 1, lmb_scene_triangles(l->scene), 0,
                             w->threads};
    const size_t before = w->bins.bytes;
    const lmb_status status = binned_run(&w->bins, &all);
    w->out->bytes += w->bins.bytes - before;
    return status;
}

static void draw_row(void *user, int row, int thread)
{
    work *w = user;
    pen *p = &w->pens[thread];
    for (int32_t x = 0; x < w->out->width && p->failed == LMB_OK; x += LMB_TILE) {
        p->failed = draw_tile(p, x, row * LMB_TILE);
    }
    if (thread == 0) {
        progress_tell("picture", (w->drawn + row * LMB_TILE / (double)w->out->height) / (double)w->samples);
    }
}

/* A band of a crowd. */
static void draw_band(void *user, int index, int thread)
{
    work *w = user;
    pen *p = &w->pens[thread];
    const int32_t rows = (w->out->height + LMB_TILE - 1) / LMB_TILE, first = index * CROWD_ROWS,
                  past = first + CROWD_ROWS < rows ? first + CROWD_ROWS : rows;
    if (p->failed == LMB_OK) {
        p->band_row = first;
        p->failed = crowd_band_draw(&p->band, w->seen, w->seen_count, &w->view, w->shot->kernels, &w->shot->how, first,
                                    past, &p->stats);
    }
    for (int32_t row = first; row < past && p->failed == LMB_OK; ++row) {
        draw_row(user, row, thread);
    }
}

static void add_stats(lmb_relief_stats *sum, const lmb_relief_stats *more)
{
    sum->pixels += more->pixels;
    sum->hits += more->hits;
    sum->missed += more->missed;
    sum->holes += more->holes;
}

static lmb_status draw_rows(work *w)
{
    lmb_status status = LMB_OK;
    memset(&w->out->stats, 0, sizeof w->out->stats);
    for (int i = 0; i < w->threads; ++i) {
        memset(&w->pens[i].stats, 0, sizeof w->pens[i].stats);
    }
    const int32_t rows = (w->out->height + LMB_TILE - 1) / LMB_TILE;
    if (w->shot->crowd != NULL) {
        pool_run(w->threads, (rows + CROWD_ROWS - 1) / CROWD_ROWS, draw_band, w);
    } else {
        pool_run(w->threads, rows, draw_row, w);
    }
    for (int i = 0; i < w->threads; ++i) {
        add_stats(&w->out->stats, &w->pens[i].stats);
        status = status != LMB_OK ? status : w->pens[i].failed;
    }
    return status;
}

/* Threads share the trees of bounced light, but each has a separate cut. */
static int take_pens(work *w, report *r)
{
    for (int i = 0; i < w->threads; ++i) {
        pen *p = &w->pens[i];
        p->of = w;
        p->bounce = w->bounce;
        if (w->shot->crowd != NULL) {
            const size_t bytes = crowd_band_take(&p->band, w->out->width);
            w->out->bytes += bytes;
            if (bytes == 0) {
                return report_fail(r, "not enough memory for a crowd");
            }
        }
        if (w->bounce.cut != NULL && i > 0 && (p->bounce.cut = take(w, sizeof *p->bounce.cut, r)) == NULL) {
            return 0;
        }
    }
    return 1;
}

static lmb_status draw_sample(work *w, int32_t i)
{
    relief_frame *f = w->out;
    double since = host_cpu_seconds(), now;
    lmb_status status = w->samples > 1 ? lmb_view_sample(&w->view, w->samples, i) : LMB_OK;
    w->drawn = i;
    if (status == LMB_OK) {
        status = draw_layer(w, &w->plain);
    }
    if (status == LMB_OK) {
        status = draw_layer(w, &w->relief);
    }
    now = host_cpu_seconds();
    f->draw_s += now - since;
    if (status == LMB_OK) {
        status = draw_rows(w);
    }
    f->band_s += host_cpu_seconds() - now;
    return status;
}

static int draw(work *w, report *r)
{
    relief_frame *f = w->out;
    double since = host_cpu_seconds(), now;
    if (w->shot->light != NULL && w->shot->shadow_map > 0 && !draw_maps(w, r)) {
        return 0;
    }
    const int32_t bounce = w->shot->light != NULL ? w->shot->bounce : 0;
    const int occludes = w->shot->sky != NULL && w->plain.scene != NULL && w->relief.scene != NULL;
    if ((bounce > 0 || occludes) && !relief_bounce_make(&w->bounce, w->shot->kernels, w->plain.scene, w->relief.scene,
                                                        w->shot->light, bounce, r)) {
        return 0;
    }
    if (!take_pens(w, r)) {
        return 0;
    }
    now = host_cpu_seconds();
    f->light_s = now - since;
    lmb_status status = LMB_OK;
    for (int32_t i = 0; i < w->samples && status == LMB_OK; ++i) {
        status = draw_sample(w, i);
    }
    return status == LMB_OK || report_fail(r, "drawing stopped: %s", lmb_status_name(status));
}

static int begin(work *w, report *r)
{
    relief_frame *f = w->out;
    const relief_shot *s = w->shot;
    const size_t pixels = (size_t)s->view.frame_width * (size_t)s->view.frame_height;
    f->width = s->view.frame_width;
    f->height = s->view.frame_height;
    f->depth = take(w, pixels * sizeof(float), r);
    f->normal = take(w, 3 * pixels * sizeof(float), r);
    f->albedo = take(w, 3 * pixels * sizeof(float), r);
    f->rgb = take(w, 3 * pixels * sizeof(float), r);
    f->open = take(w, 3 * pixels * sizeof(float), r);
    f->cover = take(w, pixels * sizeof(float), r);
    f->lit = take(w, pixels, r);
    w->threads = s->threads > 1 ? s->threads : 1;
    w->pens = take(w, (size_t)w->threads * sizeof *w->pens, r);
    w->plain.scene = s->scene;
    if (s->crowd != NULL) {
        w->simple = s->crowd->scene;
        w->relief.scene = &w->simple;
        w->seen = take(w, s->crowd->count * sizeof *w->seen, r);
    } else if (s->relief != NULL) {
        lmb_relief_scene(&w->simple, s->relief);
        w->relief.scene = &w->simple;
    }
    return r->text[0] == '\0' && (w->plain.scene == NULL || take_layer(w, &w->plain, r)) &&
           (w->relief.scene == NULL || s->crowd != NULL || take_layer(w, &w->relief, r));
}

static void layer_free(layer *l)
{
    free(l->depth_memory);
    free(l->id_memory);
    free(l->map_memory);
}

int relief_shoot(relief_frame *out, const relief_shot *shot, report *r)
{
    work *w = calloc(1, sizeof *w);
    memset(out, 0, sizeof *out);
    if (w == NULL) {
        return report_fail(r, "not enough memory");
    }
    w->out = out;
    w->shot = shot;
    w->view = shot->view;
    w->samples = shot->samples > 1 ? shot->samples : 1;
    const int ok = begin(w, r) && draw(w, r);
    layer_free(&w->plain);
    layer_free(&w->relief);
    binned_free(&w->bins);
    for (int i = 0; w->pens != NULL && i < w->threads; ++i) {
        crowd_band_free(&w->pens[i].band);
        free(i > 0 ? w->pens[i].bounce.cut : NULL);
    }
    free(w->seen);
    free(w->pens);
    relief_bounce_free(&w->bounce);
    free(w);
    if (!ok) {
        relief_frame_free(out);
    }
    return ok;
}

void relief_frame_free(relief_frame *f)
{
    free(f->depth);
    free(f->normal);
    free(f->albedo);
    free(f->rgb);
    free(f->open);
    free(f->cover);
    free(f->lit);
    f->depth = f->normal = f->albedo = f->rgb = f->open = f->cover = NULL;
    f->lit = NULL;
}
