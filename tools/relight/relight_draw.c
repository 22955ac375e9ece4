/* relight_draw.c: draws objects in a world's light, with cubes from a cache. */
#include "relight_draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/binned.h"
#include "../common/progress.h"
#include "../common/view_frame.h"
#include "../picture/picture.h"
#include "../picture/world_read.h"
#include "relight_contact.h"
#include "relight_path.h"
#include "relight_way.h"

enum { SHADOW_MAP = 2048 };

/* The cubes of one slot of the cache. */
typedef struct slot_cubes {
    void *irradiance, *glossy[RELIGHT_GLOSSY_CUBES];
    float *planes, *glossy_planes[RELIGHT_GLOSSY_CUBES]; /* the same, if a path blends them */
    lmb_vec3 place; /* the place of the light */
    int is_known[RELIGHT_GLOSSY_CUBES]; /* valid for the slot's place */
} slot_cubes;

typedef struct stage {
    relight_light *light;
    relight_options *o;
    figures figures;
    place_list path;
    lmb_probe_cache cache;
    uint32_t worlds;        /* changes of the world along the path */
    slot_cubes cubes[LMB_MAX_PROBES];
    lmb_probe *probes;      /* by slot, or along a path by owner, then by roughness */
    way *ways;              /* by owner; NULL: no path, or the light changes at once */
    float step;             /* the largest change of light between two pictures */
    uint16_t *probe_of;     /* by instance */
    float *planes;          /* of the largest glossy reflection cube */
    lmb_probe_rays rays;
    lmb_shadow_map maps[RELIGHT_LIGHTS];
    void *map_memory[RELIGHT_LIGHTS], *depth_memory, *id_memory;
    lmb_relight relight;
    contact contact;
    ground_lights ground; /* for given lights */
    lmb_relight_scratch *scratch; /* by thread */
    int threads;
    binned bins;
    lmb_surface out;
    lmb_status failed[POOL_MAX]; /* by thread */
    image picture, both; /* both: of --stereo; without pixels otherwise */
    lmb_view middle;     /* between the eyes */
    float *one;       /* one sample of each pixel, if there are several */
    float *rows;      /* by thread: eight rows of the picture */
    int32_t samples;
    double done, all; /* places of the path */
} stage;

/* Metres between the eyes; 0: one eye. */
static float eyes_apart(const stage *s)
{
#if defined(OPTIONS_WITHOUT_HELP) /* the web page draws one */
    return (void)s, 0.0f;
#else
    return s->o->stereo_m;
#endif
}

static void *take(size_t bytes, report *r)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    if (p == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted; try a smaller --size", (double)bytes / 1048576.0);
    }
    return p;
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static int keep_planes(float **to, const float *from, int32_t side, report *r)
{
    const size_t bytes = 18 * (size_t)side * (size_t)side * sizeof *from;
    if (*to == NULL && (*to = take(bytes, r)) == NULL) {
        return 0;
    }
    memcpy(*to, from, bytes);
    return 1;
}

/* Computes a slot's irradiance for a new place; glossy cubes of the old place become invalid. */
static int light_slot(stage *s, int32_t slot, lmb_vec3 at, report *r)
{
    slot_cubes *c = &s->cubes[slot];
    const int32_t side = s->o->faces;
    const size_t bytes = lmb_probe_cube_bytes(side);
    memset(c->is_known, 0, sizeof c->is_known);
    c->place = at;
    if (!relight_light_at(s->light, s->o, at, side, r) ||
        (c->irradiance == NULL && (c->irradiance = take(bytes, r)) == NULL)) {
        return 0;
    }
    if (s->ways != NULL) {
        return keep_planes(&c->planes, s->light->cube, side, r);
    }
    for (int32_t i = 0; i < s->figures.glossy_cubes; ++i) {
        lmb_probe_cube_init(&s->probes[slot * RELIGHT_GLOSSY_CUBES + i].irradiance, s->light->cube, side, c->irradiance,
                            bytes);
    }
    return 1;
}

static int mirror_slot(stage *s, int32_t slot, int32_t glossy, report *r)
{
    slot_cubes *c = &s->cubes[slot];
    const float roughness = s->figures.roughness[glossy];
    const int32_t n = lmb_probe_glossy_side(roughness);
    if (n == 0 || c->is_known[glossy]) {
        return 1;
    }
    const size_t bytes = lmb_probe_cube_bytes(n);
    if (c->glossy[glossy] == NULL && (c->glossy[glossy] = take(bytes, r)) == NULL) {
        return 0;
    }
    c->is_known[glossy] = 1;
    if (!relight_light_reflect(s->light, s->o, s->planes, n, &s->rays, c->place, roughness)) {
        return report_fail(r, "--at: numbers over 1,000,000 m");
    }
    return s->ways != NULL ? keep_planes(&c->glossy_planes[glossy], s->planes, n, r) :
           lmb_probe_cube_init(&s->probes[slot * RELIGHT_GLOSSY_CUBES + glossy].glossy, s->planes, n, c->glossy[glossy],
                               bytes) == LMB_OK;
}

/* Blends a slot's cubes for an owner. */
static int show_way(stage *s, uint32_t owner, int32_t slot, uint16_t glossy, report *r)
{
    way *w = &s->ways[owner];
    const slot_cubes *c = &s->cubes[slot];
    lmb_probe *p = &s->probes[owner * RELIGHT_GLOSSY_CUBES + glossy];
    const int32_t n = lmb_probe_glossy_side(s->figures.roughness[glossy]);
    return way_show(&p->irradiance, &s->step, &w->irradiance, w, c->planes, s->o->faces, r) &&
           (n == 0 || way_show(&p->glossy, &s->step, &w->glossy[glossy], w, c->glossy_planes[glossy], n, r));
}

/* Computes the light for the place at which the owner will be when it is blended in. */
static int light_owner(stage *s, lmb_probe_answer *answer, uint32_t owner, uint32_t frame, report *r)
{
    const float radius = s->o->policy.radius_m;
    const lmb_vec3 at = figures_middle(&s->figures, owner);
    if (lmb_probe_cache_ask(answer, &s->cache, owner, at, s->worlds, frame) != LMB_OK) {
        return report_fail(r, "--at: numbers over 1,000,000 m");
    }
    lmb_vec3 place = answer->place;
    if (s->ways != NULL) {
        const lmb_vec3 ahead = way_move(&s->ways[owner], at, radius);
        way_turn(&s->ways[owner], answer->slot, answer->compute, radius);
        if (s->cache.slot[answer->slot].kind == LMB_PROBE_OWNED) {
            place = (lmb_vec3){place.x + radius * ahead.x, place.y + radius * ahead.y, place.z + radius * ahead.z};
        }
    }
    return !answer->compute || light_slot(s, answer->slot, place, r);
}

/* Updates the cubes of all owners for one picture. */
static int light_figures(stage *s, uint32_t frame, report *r)
{
    figures *f = &s->figures;
    lmb_probe_answer answer;
    memset(&answer, 0, sizeof answer);
    for (uint32_t i = 0, last = f->owners; i < f->scene.instance_count; ++i) {
        const uint32_t owner = figures_owner(f, i);
        const uint16_t glossy = f->glossy_of[i % f->parts];
        if (owner != last && !light_owner(s, &answer, owner, frame, r)) {
            return 0;
        }
        last = owner;
        if (!mirror_slot(s, answer.slot, glossy, r) ||
            (s->ways != NULL && !show_way(s, owner, answer.slot, glossy, r))) {
            return 0;
        }
        s->probe_of[i] = (uint16_t)((s->ways != NULL ? (int32_t)owner : answer.slot) * RELIGHT_GLOSSY_CUBES + glossy);
    }
    return 1;
}

static int draw_shadows(stage *s, report *r)
{
    const lmb_scene *scene = &s->figures.scene;
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        const size_t bytes =
            lmb_shadow_map_bytes(lmb_shadow_map_faces(&scene->lights[i], scene), SHADOW_MAP, LMB_ID32);
        if (s->map_memory[i] == NULL && (s->map_memory[i] = take(bytes, r)) == NULL) {
            return 0;
        }
        if (lmb_shadow_map_init(&s->maps[i], &scene->lights[i], scene, SHADOW_MAP, LMB_ID32, s->map_memory[i], bytes) !=
                LMB_OK ||
            lmb_shadow_map_clear(&s->maps[i]) != LMB_OK ||
            lmb_shadow_map_draw(&s->maps[i], s->o->kernels, scene, 1, lmb_scene_triangles(scene), NULL) != LMB_OK) {
            return report_fail(r, "--light: number %u cannot be drawn", (unsigned)i + 1);
        }
    }
    return 1;
}

/* --- a picture ---------------------------------------------------------------------------------------------------- */

static void draw_band(void *user, int band, int thread)
{
    stage *s = user;
    lmb_relight_scratch *scratch = &s->scratch[thread];
    lmb_status status = LMB_OK;
    if (s->o->contact) {
        status = contact_band(&s->contact, &s->figures, &s->ground, &s->relight, scratch,
                              s->rows + 3 * LMB_TILE * (size_t)thread * (size_t)s->out.width, &s->out, band);
    } else {
        status = lmb_relight_band(&s->relight, scratch, &s->out, band);
        if (status == LMB_OK && s->o->show != LMB_RELIGHT_GLOSSY) {
            status = ground_band(&s->ground, NULL, &s->relight, scratch, &s->out, band);
        }
    }
    s->failed[thread] = status != LMB_OK ? status : s->failed[thread];
    if (thread == 0) {
        progress_tell("pictures",
                      (s->done + (double)(band * LMB_TILE) / ((double)s->out.height * s->samples)) / s->all);
    }
}

/* Draws one sample of each pixel into `pixels`. */
static lmb_status draw_sample(stage *s, float *pixels)
{
    lmb_relight *l = &s->relight;
    const lmb_scene *scene = l->scene;
    memset(s->failed, 0, sizeof s->failed);
    memset(&s->out, 0, sizeof s->out);
    s->out.data = pixels;
    s->out.width = s->picture.width;
    s->out.height = s->picture.height;
    s->out.stride_bytes = s->out.width * 3 * (int32_t)sizeof(float);
    s->out.format = LMB_RGB32F;
    const binned_draw eye = {
        &l->eye, l->kernels, &l->view, scene, 1, lmb_scene_triangles(scene), LMB_CULL_BACK | LMB_BLEND, s->threads};
    lmb_status status = binned_run(&s->bins, &eye);
    if (status == LMB_OK) {
        pool_run(s->threads, (s->out.height + LMB_TILE - 1) / LMB_TILE, draw_band, s);
    }
    for (int i = 0; i < s->threads; ++i) {
        status = status != LMB_OK ? status : s->failed[i];
    }
    return status;
}

/* Updates contact and ground lights, because a path may move the figure. */
static int touch(stage *s, report *r)
{
    return ground_lights_take(&s->ground, &s->figures, s->light, s->o, r) &&
           (!s->o->contact || contact_make(&s->contact, &s->figures, s->light, s->o, r));
}

static int draw_eye(stage *s, report *r)
{
    const size_t numbers = 3 * (size_t)s->picture.width * (size_t)s->picture.height;
    const float weight = 1.0f / (float)s->samples;
    lmb_status status = LMB_OK;
    for (int32_t i = 0; i < s->samples && status == LMB_OK; ++i) {
        status = lmb_view_sample(&s->relight.view, s->samples, i);
        if (status == LMB_OK) {
            status = draw_sample(s, s->one != NULL ? s->one : s->picture.pixels);
        }
        for (size_t k = 0; s->one != NULL && k < numbers; ++k) {
            s->picture.pixels[k] = (i > 0 ? s->picture.pixels[k] : 0.0f) + weight * s->one[k];
        }
        s->done += (eyes_apart(s) > 0.0f ? 0.5 : 1.0) / (double)s->samples;
    }
    return status == LMB_OK || report_fail(r, "%s: drawing stopped: %s", s->o->object, lmb_status_name(status));
}

/* Draws the picture, or both eyes side by side with the same light. [S27] */
static int draw(stage *s, report *r)
{
    if (!touch(s, r)) {
        return 0;
    }
    const size_t row = 3 * (size_t)s->picture.width;
    for (int eye = 0; eye < 2 && eyes_apart(s) > 0.0f; ++eye) {
        s->relight.view = view_from(&s->middle, eyes_apart(s) * ((float)eye - 0.5f), &s->figures.scene);
        if (!draw_eye(s, r)) {
            return 0;
        }
        for (size_t y = 0; y < (size_t)s->picture.height; ++y) {
            memcpy(s->both.pixels + (2 * y + (size_t)eye) * row, s->picture.pixels + y * row, row * sizeof(float));
        }
    }
    return eyes_apart(s) > 0.0f || draw_eye(s, r);
}

/* Writes a picture. All pictures use the exposure of the first. */
static int write(stage *s, const char *path, report *r)
{
    image *picture = eyes_apart(s) > 0.0f ? &s->both : &s->picture;
    if (s->o->into != NULL) {
        *s->o->into = *picture;
        picture->pixels = NULL;
        return 1;
    }
    if (isnan(s->o->exposure_ev) && !picture_is_linear(picture_format(path))) {
        s->o->exposure_ev = picture_auto_exposure(picture, s->o->tone) + 0.0f; /* no minus zero */
        report_note(s->o->view.is_quiet, "exposure %+.3g EV (auto)", (double)s->o->exposure_ev);
    }
    return picture_write(path, picture, s->o->exposure_ev, s->o->tone, r);
}

#if !defined(OPTIONS_WITHOUT_HELP) /* the web page has no paths */
/* A path may name another world, or the world may be a series, for example if clouds move. The light in the new world
 * is not blended with that in the old one. [S20 S28] */
static int change_world(stage *s, int32_t i, report *r)
{
    const char *name = s->path.world[i];
    int changed = name != NULL;
    if (s->light->series.count > 0 ? !relight_light_next(s->light, &changed, s->o, i, r)
                                   : changed && !relight_light_change(s->light, s->o, name, r)) {
        return 0;
    }
    if (!changed) {
        return 1;
    }
    ++s->worlds;
    for (uint32_t k = 0; k < s->figures.owners; ++k) {
        way_free(&s->ways[k]);
        memset(&s->ways[k], 0, sizeof s->ways[k]);
    }
    return 1;
}

#endif

static int draw_place(void *user, int32_t i, const char *name, report *r)
{
    stage *s = user;
#if !defined(OPTIONS_WITHOUT_HELP)
    if (!change_world(s, i, r)) {
        return 0;
    }
#endif
    const uint32_t kept = s->cache.kept;
    figures_stand(&s->figures, 0, s->path.place[i]);
    return light_figures(s, (uint32_t)i, r) && draw_shadows(s, r) && draw(s, r) && write(s, name, r) &&
           place_tell(&s->path, i, name, s->cache.kept - kept == s->figures.owners, s->o->view.is_quiet);
}

/* --- before the first picture ------------------------------------------------------------------------------------- */

static int take_cache(stage *s, report *r)
{
    const relight_options *o = s->o;
    const figures *f = &s->figures; /* not placed yet */
    const uint32_t kept = (uint32_t)o->keep_count * figures_owners_each(f);
    if (f->owners + kept > LMB_MAX_PROBES ||
        lmb_probe_cache_init(&s->cache, LMB_MAX_PROBES, &o->policy) != LMB_OK) {
        return report_fail(r, "%u objects or parts and %u of --keep are over the %d places this build keeps",
                           (unsigned)f->owners, (unsigned)kept, LMB_MAX_PROBES);
    }
    /* --keep names places of the object's foot; light is stored for the middles of the object or of the parts there. */
    for (uint32_t i = 0; i < kept; ++i) {
        const uint32_t each = figures_owners_each(f);
        if (lmb_probe_cache_name(&s->cache, figures_middle_at(&s->figures, i % each, o->keep[i / each])) < 0) {
            return report_fail(r, "--keep: numbers over 1,000,000 m, or too many");
        }
    }
    const size_t probes = LMB_MAX_PROBES * RELIGHT_GLOSSY_CUBES * sizeof *s->probes;
    s->probes = take(probes, r);
    s->probe_of = take(f->scene.instance_count * sizeof *s->probe_of, r);
    s->threads = pool_threads(o->threads);
    s->scratch = take((size_t)s->threads * sizeof *s->scratch, r);
    s->planes = take(3 * 6 * 64 * 64 * sizeof *s->planes, r);
    if (s->probes != NULL) {
        memset(s->probes, 0, probes);
    }
    if (o->path != NULL && (s->ways = calloc(f->owners, sizeof *s->ways)) == NULL) {
        return report_fail(r, "%s: out of memory", o->object);
    }
    return s->probes != NULL && s->probe_of != NULL && s->planes != NULL && s->scratch != NULL;
}

/* The box of all places of a path, for a camera that shows them all. */
static void frame_path(stage *s)
{
    lmb_vec3 low = {1e30f, 1e30f, 1e30f}, high = {-1e30f, -1e30f, -1e30f};
    for (int32_t i = 0; i < s->path.count; ++i) {
        figures_stand(&s->figures, 0, s->path.place[i]);
        figures_bounds(&s->figures);
        const lmb_vec3 a = s->figures.scene.bounds_min, b = s->figures.scene.bounds_max;
        low = (lmb_vec3){a.x < low.x ? a.x : low.x, a.y < low.y ? a.y : low.y, a.z < low.z ? a.z : low.z};
        high = (lmb_vec3){b.x > high.x ? b.x : high.x, b.y > high.y ? b.y : high.y, b.z > high.z ? b.z : high.z};
    }
    s->figures.scene.bounds_min = low;
    s->figures.scene.bounds_max = high;
}

static int take_view(stage *s, report *r)
{
    view_options *v = &s->o->view;
    lmb_relight *l = &s->relight;
    const lmb_scene *scene = &s->figures.scene;
    const lmb_status valid = lmb_scene_check(scene);
    if (valid != LMB_OK) {
        return report_fail(r, "%s: %s where it stands, or a --light that is none", s->o->object,
                           lmb_status_name(valid));
    }
    memset(&l->view, 0, sizeof l->view);
    const int is_quiet = v->is_quiet;
    v->is_quiet = 1; /* no note about a camera of the object, which relight does not use */
    const int ok = v->has_eye ? view_look(&l->view, v, r) : view_frame(&l->view, v, scene, s->o->object, r);
    v->is_quiet = is_quiet;
    if (!ok) {
        return 0;
    }
    report_note(is_quiet || v->has_eye, "framing the objects from %.4g,%.4g,%.4g; --eye sets another place",
                (double)l->view.eye.x, (double)l->view.eye.y, (double)l->view.eye.z);
    l->view.near_m = v->near_m;
    if (eyes_apart(s) > 0.0f) {
        s->middle = l->view;
    }
    l->view = view_from(&l->view, 0.0f, scene);
    return 1;
}

static int take_frame(stage *s, report *r)
{
    lmb_relight *l = &s->relight;
    const int32_t w = s->o->view.width, h = s->o->view.height;
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, w, h), id = lmb_surface_bytes(LMB_ID32, w, h);
    s->depth_memory = take(depth, r);
    s->id_memory = take(id, r);
    s->picture.pixels = take((size_t)w * (size_t)h * 3 * sizeof(float), r);
    s->samples = s->o->samples != 0 ? s->o->samples : picture_is_linear(picture_format(s->o->out)) ? 1 : 4;
    s->rows = s->o->contact ? take((size_t)s->threads * (size_t)w * 3 * LMB_TILE * sizeof(float), r) : NULL;
    s->one = s->samples > 1 ? take((size_t)w * (size_t)h * 3 * sizeof(float), r) : NULL;
    if (s->depth_memory == NULL || s->id_memory == NULL || s->picture.pixels == NULL ||
        (s->samples > 1 && s->one == NULL) || (s->o->contact && s->rows == NULL)) {
        return 0;
    }
    s->picture.width = w;
    s->picture.height = h;
    s->picture.channels = 3;
    if (eyes_apart(s) > 0.0f) {
        s->both = s->picture;
        s->both.width = 2 * w;
        s->both.pixels = take(2 * (size_t)w * (size_t)h * 3 * sizeof(float), r);
        if (s->both.pixels == NULL) {
            return 0;
        }
    }
    lmb_surface_init(&l->eye.depth, LMB_DEPTH32F, w, h, s->depth_memory, depth);
    lmb_surface_init(&l->eye.id, LMB_ID32, w, h, s->id_memory, id);
    l->kernels = s->o->kernels;
    l->scene = &s->figures.scene;
    l->maps = s->maps;
    l->world = relight_light_nearest(s->light, s->o, l->view.eye);
    l->blend = s->o->blend;
    l->probes = s->probes;
    l->probe_of = s->probe_of;
    l->probe_count = LMB_MAX_PROBES * RELIGHT_GLOSSY_CUBES;
    l->show = s->o->show;
    return 1;
}

static int tell_step(const stage *s, report *r)
{
    if (!s->o->view.is_quiet) {
        report_say("largest step of light %.2f %%%s\n", 100.0 * (double)s->step,
                   s->worlds > 0 ? ", without changes of the world" : "");
    }
    return report_flush(r);
}

/* Tries to read all worlds of a path before the first picture. Each is read again when the path reaches it. */
static int check_worlds(const stage *s, report *r)
{
#if !defined(OPTIONS_WITHOUT_HELP)
    int32_t side = 0;
    for (int32_t i = 0; i < s->path.count; ++i) {
        const char *name = s->path.world[i];
        if (name != NULL && s->o->worlds > 1) {
            return report_fail(r, "%s: names a world, which needs a single --world; %d are given", s->o->path,
                               (int)s->o->worlds);
        }
        if (name != NULL && s->light->series.count > 0) {
            return report_fail(r, "%s: names a world, and a numbered --world already changes", s->o->path);
        }
        if (name != NULL && !world_check(name, &side, r)) {
            return 0;
        }
    }
    const int32_t every = s->o->world_every > 0 ? s->o->world_every : 1;
    if (s->light->series.count > 0 &&
        !world_series_check(&s->light->series, 0, s->path.count, every, every > 1, r)) {
        return 0;
    }
    world_series_tell(&s->light->series, (int32_t)s->path.count - 1, every, s->o->view.is_quiet);
#else
    (void)s, (void)r;
#endif
    return 1;
}

static int run(stage *s, report *r)
{
    const relight_options *o = s->o;
    s->all = 1.0;
    if (eyes_apart(s) > 0.0f && 2 * o->view.width > LMB_MAX_SIDE) {
        return report_fail_usage(r, "--stereo: two views of %d px are wider than %d; try a smaller --size",
                                 (int)o->view.width, LMB_MAX_SIDE);
    }
    if ((o->path != NULL && (!place_list_read(&s->path, o->path, r) || !check_worlds(s, r))) ||
        !figures_load(&s->figures, o, o->path != NULL || o->objects > 1 ? 1 : (uint32_t)o->at_count, r) ||
        !take_cache(s, r)) {
        return 0;
    }
    for (int32_t i = 0; i < o->at_count && o->objects == 1; ++i) {
        figures_stand(&s->figures, (uint32_t)i, o->at[i]);
    }
    if (o->objects > 1) {
        figures_stand(&s->figures, 0, figures_foot(&s->figures));
    }
    if (o->path != NULL) {
        s->all = (double)s->path.count;
        frame_path(s);
    } else {
        figures_bounds(&s->figures);
    }
    if (!take_view(s, r) || !take_frame(s, r)) {
        return 0;
    }
    if (o->path == NULL) {
        return light_figures(s, 0, r) && draw_shadows(s, r) && draw(s, r) && write(s, o->out, r);
    }
    return place_list_walk(&s->path, o->out, draw_place, s, &s->cache, o->view.is_quiet, r) && tell_step(s, r);
}

static void stage_free(stage *s)
{
    for (int i = 0; i < LMB_MAX_PROBES; ++i) {
        free(s->cubes[i].irradiance);
        free(s->cubes[i].planes);
        for (int k = 0; k < RELIGHT_GLOSSY_CUBES; ++k) {
            free(s->cubes[i].glossy[k]);
            free(s->cubes[i].glossy_planes[k]);
        }
    }
    for (uint32_t i = 0; s->ways != NULL && i < s->figures.owners; ++i) {
        way_free(&s->ways[i]);
    }
    free(s->ways);
    for (int i = 0; i < RELIGHT_LIGHTS; ++i) {
        free(s->map_memory[i]);
    }
    binned_free(&s->bins);
    free(s->probes);
    free(s->probe_of);
    free(s->planes);
    free(s->scratch);
    free(s->one);
    free(s->rows);
    free(s->depth_memory);
    free(s->id_memory);
    image_free(&s->picture);
    if (eyes_apart(s) > 0.0f) {
        image_free(&s->both);
    }
    contact_free(&s->contact);
    ground_lights_free(&s->ground);
    place_list_free(&s->path);
    figures_free(&s->figures);
    free(s);
}

int relight_draw(lmb_vec3 *middle, relight_light *w, relight_options *o, report *r)
{
    stage *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return report_fail(r, "out of memory");
    }
    s->light = w;
    s->o = o;
    const int ok = run(s, r);
    if (ok) {
        *middle = figures_middle(&s->figures, 0);
    }
    stage_free(s);
    return ok;
}
