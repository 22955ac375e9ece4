/* begin.c: starts a frame, or another picture with the same light. Layer 8. [V31 V33] */
#include <string.h>

#include "stages.h"
#include "requires.h"

#define DEFAULT_SEGMENT_STEPS 12
#define DEFAULT_ERROR         0.02f /* the `default` of the tool's presets */
#define DEFAULT_VISIBILITY    0.015f
#define EVEN_ERROR   0.1f /* for light from all sides */
#define EVEN_VISIBLE 0.2f

/* Divides the map memory: one shadow map after another. */
static lmb_status place_frame_maps(lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    uint8_t *place = (uint8_t *)f->map_memory;
    size_t left = f->map_bytes;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        const lmb_light *light = &f->scene->lights[i];
        size_t need = lmb_shadow_map_bytes(lmb_shadow_map_faces(light, f->scene), f->shadow_map, f->id_format);
        lmb_status status = lmb_shadow_map_init(&r->maps[i], light, f->scene, f->shadow_map, f->id_format, place, left);
        if (status != LMB_OK) {
            return status;
        }
        place += need;
        left -= need;
    }
    return LMB_OK;
}

/* Replaces a picture's zeros by defaults. */
void lmb_render_defaults(lmb_frame *f)
{
    const int even = (f->error == 0.0f || f->visibility == 0.0f) && wants_even_light(f);
    f->bounces = f->bounces != 0 ? f->bounces : 1;
    f->steps = f->steps != 0 ? f->steps : DEFAULT_SEGMENT_STEPS;
    f->samples += f->samples == 0;
    f->error = f->error != 0.0f ? f->error : even ? EVEN_ERROR : DEFAULT_ERROR;
    f->visibility = f->visibility != 0.0f ? f->visibility : even ? EVEN_VISIBLE : DEFAULT_VISIBILITY;
    f->gather_step = f->gather_step != 0 && requires_bounce(f) ? f->gather_step : 1;
    if (f->gather_step == LMB_GATHER_LIVE && requires_transfer(f)) {
        f->gather_step = 1; /* baked light costs less per pixel than a sample */
    }
}

static int has_unlit(const lmb_scene *scene)
{
    uint32_t flags = 0;
    for (uint32_t i = 0; i < scene->material_count; ++i) {
        flags |= scene->materials[i].flags;
    }
    return (flags & LMB_UNLIT) != 0;
}

lmb_status lmb_render_begin(lmb_render *r, const lmb_frame *frame)
{
    if (r == NULL || frame == NULL) {
        return LMB_ERR_ARG;
    }
    memset(r, 0, sizeof *r);
    r->frame = *frame;
    lmb_frame *f = &r->frame;
    f->id_format = f->id_format != 0 ? f->id_format : LMB_ID32;
    lmb_render_defaults(f);
    f->tree.faces = 0;
    f->tree.tests = f->occlusion == LMB_OCCLUSION_EXACT && !f->conservative;
    f->points.count = 0;
    f->points.faces = 0;
    f->points.owner_count = 0;
    lmb_status status = lmb_render_check(f);
    if (status == LMB_OK) {
        status = place_frame_maps(r);
    }
    r->triangles = status == LMB_OK ? lmb_scene_triangles(f->scene) : 0;
    r->emits = status == LMB_OK && lmb_scene_emits(f->scene);
    r->is_unlit = status == LMB_OK && has_unlit(f->scene);
    r->is_glossy = LMB_TREES && status == LMB_OK && lmb_scene_is_glossy(f->scene);
#if LMB_PLAN
    if (status == LMB_OK) {
        lmb_render_skip(r);
    }
#endif
    r->stage = status == LMB_OK ? LMB_STAGE_SHADOW_MAP : LMB_STAGE_DONE;
    r->failed = status;
    return status;
}

/* Copies the settings of the picture, not those of the light. */
static void set_picture(lmb_frame *f, const lmb_frame *from)
{
    f->kernels = from->kernels;
    f->view = from->view;
    f->show = from->show;
    f->occlusion = from->occlusion;
    f->steps = from->steps;
    f->error = from->error;
    f->visibility = from->visibility;
    f->conservative = from->conservative;
    f->many_lights_error = from->many_lights_error;
    f->gather_many_lights = from->gather_many_lights;
    f->background = from->background;
    f->gather_step = from->gather_step;
    f->lattice = from->lattice;
    f->samples = from->samples;
    f->exposure_ev = from->exposure_ev;
    f->eye = from->eye;
    f->eye_depth = from->eye_depth;
    f->scratch = from->scratch;
    f->out = from->out;
    f->callback = from->callback;
    f->user = from->user;
    f->stats = from->stats;
}

/* Did the old frame solve all that the new picture needs? That is groups or a tree, the BVH, and bounces between
 * elements with the same settings. */
static int is_solved(const lmb_frame *f, const lmb_render *r)
{
    const lmb_frame *before = &r->frame;
    const int exact = requires_cut(f) && f->occlusion == LMB_OCCLUSION_EXACT;
    const int same = f->occlusion == before->occlusion && f->error == before->error &&
                     f->visibility == before->visibility && f->conservative == before->conservative &&
                     f->many_lights_error == before->many_lights_error;
    const int texels = LMB_TREES && (!requires_live(f) || (r->is_glossy && f->show != LMB_SHOW_IRRADIANCE));
    if (LMB_TREES && requires_cut(f) &&
        ((requires_live(f) && !requires_live(before)) || (texels && !requires_texels(r)))) {
        return 0; /* texels of the required tree were not collected */
    }
    if (LMB_TREES && requires_cut(f) && requires_elements(r) && requires_live(f) != requires_live(before)) {
        return 0; /* elements were lit by the other tree */
    }
    return (!requires_bounce(f) || requires_bounce(before)) && (same || !requires_bounce(f) || !requires_elements(r)) &&
           (!exact || before->occlusion == LMB_OCCLUSION_EXACT ||
            (before->bvh.node_count > 0 && !(LMB_FACETS && (r->reuses & BUILT_FAST) != 0)));
}

lmb_status lmb_render_again(lmb_render *r, const lmb_frame *frame)
{
    lmb_frame f;
    if (r == NULL || frame == NULL || (r->failed == LMB_OK && r->stage < LMB_STAGE_VIEW)) {
        return LMB_ERR_ARG;
    }
    if (r->failed != LMB_OK) {
        return r->failed;
    }
    f = r->frame;
    set_picture(&f, frame);
    lmb_render_defaults(&f);
    lmb_status status = lmb_render_check(&f);
    if (status == LMB_OK && !is_solved(&f, r)) {
        status = LMB_ERR_ARG;
    }
    if (status == LMB_OK) {
        r->frame = f;
        if (requires_live(&f)) {
            f.live->sky = gathers_live_sky(&f) ? f.live_sky : NULL;
        }
        r->reuses &= ~(uint32_t)LMB_REUSE_VIEW;
        r->stage = LMB_STAGE_VIEW;
        r->light = r->face = r->progress = 0;
    }
    return status;
}
