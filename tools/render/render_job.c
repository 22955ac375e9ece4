/* render_job.c: a picture's scene, lights and memory. */
#include "render_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/area_light.h"
#include "../demo/demo_scene.h"
#include "../model/io_lmt.h"
#include "../model/scene_hash.h"
#include "../picture/picture.h"
#include "own_light.h"
#include "render_view.h"

#define HALF_STEP   0.00015f /* of black in 8 bits: radiance at exposure 0 */
#define SKY_ERROR   0.01f   /* of a sky's light: error limit of a node */
#define FEW_SAMPLES 65536   /* fewer pixels: sampling light gains no time */
#define SIZE_SAMPLES 64     /* lights that replace one with a size */
#define MAX_MAPPED  32 /* most lights with maps that bounce, by default: 100 take 160 times as long as in a tree */

void render_job_free(render_job *j)
{
    free(j->block);
    free(j->owner_memory);
    free(j->render);
    image_free(&j->linear);
    blended_free(&j->blended);
    light_stream_free(&j->many_lights);
    world_free(&j->around);
    free(j->with_sun);
    free(j->wide);
    model_free(&j->loaded);
    file_free(&j->transfer_file);
}

static void *take(render_job *j, size_t bytes, report *r)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    j->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted; try a smaller --size or --shadow-map",
                    (double)bytes / 1048576.0);
    }
    return p;
}

/* --- scene and lights --------------------------------------------------------------------------------------------- */

static int load_scene(render_job *j, report *r)
{
    if (strcmp(j->o.scene, "demo") == 0) {
        j->scene = *demo_scene();
        return !j->o.glossy || report_fail_usage(r, "--glossy: the demo's materials have no lobe; give a glTF scene");
    }
    if (!model_load_as(&j->loaded, j->o.scene, &j->o.choice, &j->notes, r)) {
        return 0;
    }
    if (j->o.glossy && !model_make_glossy(&j->loaded)) {
        return report_fail_usage(r, "--glossy: %s: only glTF's materials have a lobe", j->o.scene);
    }
    j->scene = j->loaded.scene;
    return 1;
}

/* Loads the baked light transfer, if the options name one. */
static int load_transfer(render_job *j, report *r)
{
    if (j->o.transfer == NULL) {
        return 1;
    }
    if (has_budget(&j->o.budget, j->o.budget_ms)) {
        return report_fail_usage(r, "--transfer: light is as exact as it was baked: no --budget goes with it");
    }
    if (!file_read(&j->transfer_file, j->o.transfer, r) ||
        !lmt_open(&j->transfer, &j->transfer_file, j->o.transfer, r)) {
        return 0;
    }
    return lmb_transfer_fits(&j->transfer, &j->scene) == LMB_OK ||
           report_fail(r, "%s: baked from another scene than %s; bake it again", j->o.transfer, j->o.scene);
}

/* Returns whether light by direction was baked; all leaves of a triangle are alike. */
static int keeps_direction(const lmb_transfer *t, uint32_t root)
{
    const uint32_t *node = t->section[LMB_TRANSFER_DIVISIONS];
    while ((node[root] & LMB_TRANSFER_LEAF) == 0) {
        root = lmt_halving_of(t, root).first;
    }
    return (node[root] & ~LMB_TRANSFER_LEAF) >= t->leaves;
}

/* Counts triangles with a normal map or a lobe that were baked without direction: all light comes along the normal. */
static uint32_t without_direction(const render_job *j)
{
    const lmb_transfer *t = &j->transfer;
    uint32_t count = 0;
    for (uint32_t id = 1; id <= t->count[LMB_TRANSFER_SURFACES]; ++id) {
        const uint32_t *root = t->section[LMB_TRANSFER_SURFACES] + LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1) + 2;
        lmb_triangle own;
        if (!lmb_triangle_fetch(&own, &j->scene, id)) {
            continue;
        }
        const lmb_material *m = own.material;
        const int takes_direction =
            m->normal_scale != 0.0f || m->specular[0] > 0.0f || m->specular[1] > 0.0f || m->specular[2] > 0.0f;
        count += takes_direction && ((root[0] != LMB_TRANSFER_NONE && !keeps_direction(t, root[0])) ||
                                     (root[1] != LMB_TRANSFER_NONE && !keeps_direction(t, root[1])));
    }
    return count;
}

int render_job_load(render_job *j, report *r)
{
    if (!load_scene(j, r) || !load_transfer(j, r)) {
        return 0;
    }
    if (j->o.slice.count > 0) { /* includes the files beside the scene file */
        const uint64_t scene = scene_hash(&j->scene);
        j->o.slice_job = slice_hash(j->o.slice_job, &scene, sizeof scene);
    }
    const uint32_t left_out = j->o.transfer != NULL ? without_direction(j) : 0;
    if (left_out > 0) {
        report_note(j->o.view.is_quiet,
                    "%s: keeps no directions for %u triangles with a normal map or a lobe, which bounced light leaves "
                    "out; bake it again%s",
                    j->o.transfer, (unsigned)left_out, j->o.glossy ? " with --glossy" : "");
    }
    if (j->o.transfer != NULL && j->o.glossy && j->transfer.count[LMB_TRANSFER_MOVING] > 0) {
        report_note(j->o.view.is_quiet, "%s: lobes of objects that move reflect no bounced light", j->o.transfer);
    }
    return 1;
}

/* Called when only memory can still fail, because an error should be the only line. */
static void tell_notes(const render_job *j)
{
    model_tell(&j->notes, j->o.scene, j->hides | (j->o.glossy ? MODEL_NOTE_GLOSSY : 0));
}

/* Returns whether light is emitted without lights. */
static int emits_itself(const render_job *j)
{
    return j->o.grouping.method == LMB_GROUP_CUT && lmb_scene_emits(&j->scene);
}

/* Programs export switched-off lamps with zero power; those are no light. Lights of the command line always count. */
static int has_lights(const render_job *j)
{
    int any = j->o.light_count > 0;
    for (uint32_t i = 0; i < j->scene.light_count && !any; ++i) {
        const float *rgb = j->scene.lights[i].intensity;
        any = rgb[0] > 0.0f || rgb[1] > 0.0f || rgb[2] > 0.0f;
    }
    return any;
}

/* Returns 1 if the scene has lights, or if emissive surfaces light it; 0 if not; -1 with `r` set: out of memory. */
static int is_lit(const render_job *j, report *r)
{
    if (has_lights(j)) {
        return 1;
    }
    const float own = emits_itself(j) ? own_light(&j->scene, r) : 0.0f;
    return own < 0.0f ? -1 : own >= OWN_LIGHT;
}

/* Fixed groups cannot bounce light of a sky. */
static int can_bounce_many(const render_job *j)
{
    return j->o.transfer != NULL || j->o.show == LMB_SHOW_DIRECT || j->o.grouping.method == LMB_GROUP_CUT;
}

/* Appends the sun of the sky to the scene's lights. */
static int add_sun(render_job *j, report *r)
{
    const uint32_t count = j->scene.light_count;
    if (!j->around.has_sun && !j->o.world_changes) {
        return 1;
    }
    j->with_sun = take(j, (count + RENDER_SUNS) * sizeof *j->with_sun, r);
    if (j->with_sun == NULL) {
        return 0;
    }
    if (count > 0) {
        memcpy(j->with_sun, j->scene.lights, count * sizeof *j->with_sun);
    }
    j->with_sun[count] = j->around.sun;
    j->scene.lights = j->with_sun;
    j->scene.light_count = count + (uint32_t)j->around.has_sun;
    j->own_lights = count;
    return 1;
}

/* A cut-out object has no ground, and a bake does not contain it. */
static int wants_ground(const render_job *j)
{
    return !j->o.no_ground && j->o.background.kind == BACKGROUND_WORLD && j->o.transfer == NULL;
}

/* A sky is the default only in `render` without a budget: cost estimates do not include the light of a sky. */
static int wants_sky(const render_job *j)
{
    return j->o.has_sky && can_bounce_many(j) && !has_budget(&j->o.budget, j->o.budget_ms);
}

static void tell_world(const render_job *j)
{
    const world *w = &j->around;
    if (j->o.world == NULL) {
        report_note(j->o.view.is_quiet, "no light in %s: a clear sky%s; --world and --light set others%s", j->o.scene,
                    w->has_ground ? " and a ground below" : "", w->has_ground ? ", --ground none leaves it alone" : "");
    }
    if (w->count == 0 && !w->has_sun) {
        report_note(j->o.view.is_quiet, "note: %s gives no light", j->o.world);
    }
    if (j->o.glossy && lmb_scene_is_glossy(&j->scene)) {
        report_note(j->o.view.is_quiet, "note: lobes mirror the sun and what bounces, but not the sky");
    }
}

static int set_world(render_job *j, int lit, report *r)
{
    const int is_sky = j->o.world == NULL || strcmp(j->o.world, "sky") == 0;
    world *w = &j->around;
    if (!can_bounce_many(j)) {
        return report_fail_usage(r, "--world: a sky's light bounces by --group method=cut only; or use --world none");
    }
    if (has_budget(&j->o.budget, j->o.budget_ms)) {
        return report_fail_usage(r, "--world: settings for a budget are reckoned without a sky's light; use --quality");
    }
    if (!(is_sky ? world_sky(w, r) : world_read(w, j->o.world, j->o.view.is_quiet, r)) ||
        (!lit && wants_ground(j) && !world_put_ground(w, &j->scene, j->middle.eye, r)) || !world_light(w, r) ||
        !add_sun(j, r)) {
        return 0;
    }
    if (shows_map(j->o.show) && j->scene.light_count == 0) {
        return report_fail_usage(r, "--show: %s has no sun, and no other light has a map; add one by --light",
                                 j->o.world);
    }
    tell_world(j);
    return 1;
}

/* Lights of the command line, with or without a size. */
static int take_lights(render_job *j, report *r)
{
    uint32_t count = 0, wide = 0;
    for (uint32_t i = 0; i < j->o.light_count; ++i) {
        wide += j->o.light_size[i] > 0.0f;
    }
    j->scene.lights = j->o.lights;
    j->scene.light_count = j->o.light_count;
    if (wide == 0) {
        return 1;
    }
    j->wide = take(j, ((size_t)j->o.light_count + wide * (SIZE_SAMPLES - 1)) * sizeof *j->wide, r);
    for (uint32_t i = 0; j->wide != NULL && i < j->o.light_count; ++i) {
        j->wide[count] = j->o.lights[i];
        if (j->o.light_size[i] > 0.0f) {
            area_light(j->wide + count, SIZE_SAMPLES, &j->o.lights[i], j->o.light_size[i]);
        }
        count += j->o.light_size[i] > 0.0f ? SIZE_SAMPLES : 1;
    }
    j->scene.lights = j->wide;
    j->scene.light_count = count;
    return j->wide != NULL;
}

/* Lights of the command line or the scene, and of the world around. */
static int set_lights(render_job *j, report *r)
{
    static const lmb_light sun = {{0, 0, 0}, {0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f,
                                  LMB_LIGHT_DIRECTIONAL, 0, 0};
    if (j->o.light_count > 0 && !take_lights(j, r)) {
        return 0;
    }
    const int lit = is_lit(j, r);
    const int wants_none = j->o.world != NULL && strcmp(j->o.world, "none") == 0;
    if (lit < 0) {
        return 0;
    }
    if (j->o.world == NULL ? !lit && wants_sky(j) : !wants_none) {
        return set_world(j, lit, r);
    }
    if (!lit && j->scene.light_count == 0) {
        j->sun = sun;
        j->scene.lights = &j->sun;
        j->scene.light_count = 1;
        report_note(j->o.view.is_quiet, "no light in %s: a sun of 3 W/m2 from the upper left; --light sets others",
                    j->o.scene);
    }
    return 1;
}

/* The cost of maps for bounced light grows with each light by about a picture. Lobes mirror only lights with maps. */
static uint32_t most_mapped(const render_job *j)
{
    const int bounces =
        j->o.show == LMB_SHOW_FULL || j->o.show == LMB_SHOW_INDIRECT || j->o.show == LMB_SHOW_IRRADIANCE;
    const int mirrors = j->o.glossy && lmb_scene_is_glossy(&j->scene);
    const int by_cuts = j->o.transfer != NULL || j->o.grouping.method == LMB_GROUP_CUT;
    return bounces && !mirrors && by_cuts ? MAX_MAPPED : LMB_MAX_LIGHTS;
}

/* Lights with a size make a shadow of many edges. The shadow tests of the tree place them exactly; maps do not. */
static int is_soft(const render_job *j)
{
    const int mirrors = j->o.glossy && lmb_scene_is_glossy(&j->scene);
    return j->wide != NULL && can_bounce_many(j) && !mirrors && !shows_map(j->o.show);
}

/* The tree of the sky's lights and, if they are too many for maps, of the scene's. */
static int take_tree(render_job *j, const lmb_light *lights, uint32_t count, report *r)
{
    const uint32_t cells = j->o.many_lights_cells > 0 ? (uint32_t)j->o.many_lights_cells : LIGHT_STREAM_CELLS;
    const light_list lists[2] = {{lights, j->too_many ? count : 0}, {j->around.lights, j->around.count}};
    const uint32_t all = lists[0].count + lists[1].count;
    if (all > 0 && !can_bounce_many(j)) {
        return report_fail_usage(r, "--group method: %u lights of %s bounce by cut only; or use --show direct",
                           (unsigned)all, j->o.scene);
    }
    j->gathers_sky = all > 0 && !j->too_many && j->o.show != LMB_SHOW_DIRECT;
    j->in_tree = lists[0].count;
    j->scene.light_count = count - lists[0].count;
    return all == 0 || light_stream_take(&j->many_lights, lists, cells, r);
}

/* Lights go into a tree if they are too many for maps, or if an option selects it; lights of a sky always do. */
static int set_light_stream(render_job *j, report *r)
{
    j->too_many = j->o.many_lights_cells > 0 || is_soft(j) || j->scene.light_count > most_mapped(j);
    if (!take_tree(j, j->scene.lights, j->scene.light_count, r)) {
        return 0;
    }
    if (j->too_many && j->many_lights.tree.node != NULL) {
        report_note(j->o.view.is_quiet, "%u lights in %u cells (--many-lights)", (unsigned)j->many_lights.tree.lights,
                    (unsigned)j->many_lights.tree.cell_count);
    }
    return 1;
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

/* Owner of each texel's light; allocated only if it is shown. */
static int take_owners(render_job *j, report *r)
{
    const lmb_frame *f = &j->frame;
    lmb_points *p = &j->frame.points;
    const uint64_t texels = (uint64_t)f->shadow_map * (uint64_t)f->shadow_map *
                            (f->map_bytes / lmb_shadow_map_bytes(1, f->shadow_map, f->id_format));
    if (texels > UINT32_MAX / 16) {
        return report_fail(r, "%.0f texels are too many to show; use a smaller --shadow-map", (double)texels);
    }
    p->owner = j->owner_memory = take(j, (size_t)texels * sizeof *p->owner, r);
    p->owner_cap = (uint32_t)texels;
    return p->owner != NULL;
}

/* The part of a picture for one eye. */
static lmb_surface eye_surface(const render_job *j, const image *whole, int32_t eye)
{
    lmb_surface s;
    memset(&s, 0, sizeof s);
    s.data = whole->pixels + (size_t)eye * (size_t)(j->o.view.width * whole->channels);
    s.width = j->o.view.width;
    s.height = whole->height;
    s.stride_bytes = whole->width * whole->channels * (int32_t)sizeof(float);
    s.format = whole->channels == 1 ? LMB_R32F : LMB_RGB32F;
    return s;
}

void render_job_eye(const render_job *j, lmb_frame *f, const image *whole, int32_t eye)
{
    const float right_m = j->o.stereo_m * ((float)eye - 0.5f * (float)(j->eyes - 1));
    f->view = view_from(&j->middle, right_m, &j->scene);
    f->out = eye_surface(j, whole, eye);
}

int render_job_picture(render_job *j, image *out, report *r)
{
    size_t bytes = (size_t)(j->o.view.width * j->eyes) * (size_t)j->o.view.height * 3 * sizeof(float);
    out->pixels = take(j, bytes, r);
    out->width = j->o.view.width * j->eyes;
    out->height = j->o.view.height;
    out->channels = 3;
    if (out->pixels != NULL) {
        memset(out->pixels, 0, bytes);
    }
    return out->pixels != NULL;
}

/* Pictures for displays are antialiased. Linear ones are for measuring, and depth and ids have no mean. */
static int32_t samples_of(const render_options *o)
{
    const int shows_light = o->show <= LMB_SHOW_IRRADIANCE;
    const int is_for_display = o->out != NULL && !picture_is_linear(picture_format(o->out));
    return !shows_light ? 1 : o->samples != 0 ? o->samples : is_for_display ? 4 : 1;
}

/* The default of --gather. Draft, and `play` by default, use light of single points: a tenth of the time; pictures of
 * 64x48 lose up to .11 of trim. So does `default` under a sky, with less error than cuts of the sky, and if many lights
 * are all the light: .02 of trim, .03 by cuts; but not if they make a soft shadow: .19, .12. A budget makes a choice of
 * its own. */
static int32_t gather_of(const render_job *j)
{
    const render_options *o = &j->o;
    const int is_cut = o->grouping.method == LMB_GROUP_CUT && j->transfer_file.data == NULL && !o->conservative;
    const int is_small = o->view.width * o->view.height < FEW_SAMPLES;
    const int is_asked = o->error > 0.0f || o->visibility > 0.0f || o->tree > 0; /* single points use none of these */
    const int is_even = j->many_lights.tree.lights >= LMB_MANY_LIGHTS_EVEN && j->scene.light_count == 0 &&
                        j->wide == NULL && !j->gathers_sky;
    const int is_quick =
        o->quality == LMB_QUALITY_DRAFT ||
        ((o->is_moving || is_even || j->gathers_sky) && o->quality == LMB_QUALITY_DEFAULT);
    const int is_live =
        LMB_LIVE && is_cut && !is_asked && !has_budget(&o->budget, o->budget_ms) && is_quick && !is_small;
    return o->gather_step != 0 ? o->gather_step : is_live || o->is_steady ? LMB_GATHER_LIVE : 0;
}

/* The settings that determine the frame's memory. `bare`: the scene without lights, for attributes. */
static lmb_frame_settings settings_of(const render_job *j, const lmb_scene *bare)
{
    const render_options *o = &j->o;
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.kernels = o->kernels;
    s.scene = shows_attribute(o->show) ? bare : &j->scene;
    s.many_lights = j->many_lights.tree.node != NULL ? &j->many_lights.tree : NULL;
    s.transfer = j->transfer_file.data != NULL ? &j->transfer : NULL;
    s.view = j->middle;
    s.view.frame_width = o->view.width;
    s.view.frame_height = o->view.height;
    s.out = eye_surface(j, &j->linear, 0);
    s.show = shows_attribute(o->show) || o->show == SHOW_LIGHT_DISTANCE ? LMB_SHOW_DIRECT
             : o->show == SHOW_OCCLUSION                                ? LMB_SHOW_IRRADIANCE
             : shows_map(o->show)                                       ? LMB_SHOW_FULL
                                                                        : o->show;
    s.quality = o->grouping.method == LMB_GROUP_CUT ? o->quality : LMB_QUALITY_FIXED;
    s.grouping = o->grouping;
    s.bounces = o->bounces;
    s.threads = j->workers.threads;
    s.shadow_map = o->shadow_map;
    s.tree = o->tree;
    s.error = o->error;
    s.visibility = o->visibility;
    s.elements = (uint32_t)o->elements;
    s.gather_step = gather_of(j);
    s.samples = samples_of(o);
#if LMB_LIVE
    s.steady = o->is_steady;
#endif
    s.id_format = LMB_ID32;
    return s;
}

/* Reports options that the library would refuse. */
static int refuse(const lmb_frame_settings *s, report *r)
{
    if (s->gather_step == LMB_GATHER_LIVE && (!LMB_LIVE || s->quality == LMB_QUALITY_FIXED)) {
        return report_fail_usage(r, LMB_LIVE ? "--gather live needs --group method=cut"
                                             : "--gather live: this build leaves it out (LMB_LIVE=0)");
    }
    return s->quality == LMB_QUALITY_FIXED
               ? report_fail(
                     r, "more first points than can be counted; use a larger --group block or a smaller --shadow-map")
               : report_fail_usage(r, "--group method=cut: --shadow-map must be a power of two, not %d",
                                   (int)s->shadow_map);
}

/* Sets the members that need no memory. */
static void set_numbers(render_job *j)
{
    lmb_frame *f = &j->frame;
    f->scene = &j->scene;
    f->show = j->o.show < SHOW_DEPTH ? j->o.show : j->o.show == SHOW_OCCLUSION ? LMB_SHOW_IRRADIANCE : LMB_SHOW_FULL;
    f->many_lights_error = j->o.light_error > 0.0f ? j->o.light_error : j->gathers_sky ? SKY_ERROR : 0.0f;
    f->gather_many_lights = j->gathers_sky;
    f->background =
        j->around.env.texels != NULL && j->o.background.kind == BACKGROUND_WORLD ? &j->around.env : NULL;
    f->occlusion = j->o.occlusion;
    f->steps = j->o.steps;
    f->conservative = j->o.conservative;
    f->bounces = j->o.bounces;
    f->truncated = j->o.truncated;
    f->gather_step = gather_of(j) != 0 ? gather_of(j) : f->gather_step;
    f->stats = &j->stats;
    f->run_all = shows_map(j->o.show); /* also maps of lights without power */
    const int shows_steps = j->o.out != NULL && !picture_is_linear(picture_format(j->o.out)) && !j->o.exposure_auto;
    f->error_floor = shows_steps ? HALF_STEP * exp2f(-j->o.exposure_ev) : 0.0f;
}

int render_job_refit(render_job *j, report *r)
{
    lmb_scene bare = j->scene;
    bare.light_count = 0;
    const lmb_frame_settings s = settings_of(j, &bare);
    const size_t bytes = lmb_frame_bytes(&s);
    free(j->block);
    j->block = NULL;
    j->bytes -= j->block_bytes;
    j->block_bytes = bytes;
    if (bytes == 0) {
        return refuse(&s, r);
    }
    j->block = take(j, bytes, r);
    if (j->block == NULL) {
        return 0;
    }
    const lmb_status status = lmb_frame_init(&j->frame, &s, j->block, bytes);
    if (status != LMB_OK) {
        return report_fail(r, "%s: %s", j->o.scene, lmb_status_name(status));
    }
    j->workers.scratches = j->frame.scratch;
    set_numbers(j);
    render_job_eye(j, &j->frame, &j->linear, 0);
    return 1;
}

int render_job_change_world(render_job *j, lmb_light *lights, report *r)
{
    const world *w = &j->around;
    uint32_t past = j->own_lights;
    if (w->has_fading) {
        lights[past++] = w->fading;
    }
    if (w->has_sun) {
        lights[past++] = w->sun;
    }
    memcpy(j->with_sun + j->own_lights, lights + j->own_lights, (past - j->own_lights) * sizeof *lights);
    light_stream_free(&j->many_lights);
    if (!take_tree(j, j->with_sun, past, r) || !render_job_refit(j, r)) {
        return 0;
    }
    memset(j->render, 0, sizeof *j->render);
    return 1;
}

int render_job_take(render_job *j, report *r)
{
    j->render = take(j, sizeof *j->render, r);
    if (j->render == NULL || !render_job_picture(j, &j->linear, r) || !render_job_refit(j, r)) {
        return 0;
    }
    memset(j->render, 0, sizeof *j->render);
    return !shows_map(j->o.show) || j->frame.points.data == NULL || take_owners(j, r);
}

int render_job_set(render_job *j, report *r)
{
    if (!render_view(&j->middle, &j->o, &j->loaded, &j->scene, r)) {
        return 0;
    }
    j->eyes = j->o.stereo_m > 0.0f ? 2 : 1;
    if (j->o.view.width * j->eyes > LMB_MAX_SIDE) {
        return report_fail_usage(r, "--stereo: two views of %d px are wider than %d; try a smaller --size",
                           (int)j->o.view.width, LMB_MAX_SIDE);
    }
    tell_notes(j);
    if (!shows_attribute(j->o.show) && (!set_lights(j, r) || !set_light_stream(j, r))) {
        return 0;
    }
    j->workers.threads = pool_threads(j->o.threads);
    if (j->o.show == SHOW_POINTS && j->o.grouping.join <= 0.0f) {
        j->o.grouping.join = 1e-30f; /* first points unchanged: none are closer than this */
    }
    return render_job_take(j, r);
}

void render_job_apply(render_job *j, const ladder_settings *s)
{
    j->o.shadow_map = s->shadow_map;
    j->o.tree = s->tree;
    j->o.error = s->error;
    j->o.visibility = s->visibility;
    j->o.gather_step = 1;
    j->o.occlusion = s->occlusion;
}
