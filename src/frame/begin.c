/* begin.c: the start of a frame, or of another picture by the same light. Floor 10.                        [V31 V33] */
#include <string.h>

#include "stages.h"
#include "wants.h"

#define STEPS 12
#define ERROR   0.02f  /* the tool's presets' `default` */
#define VISIBLE 0.015f
#define EVEN_ERROR   0.1f /* where light comes from all sides */
#define EVEN_VISIBLE 0.2f

/* Share the map memory out: one light's map after another. */
static lmb_status place_maps(lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    uint8_t *place = (uint8_t *)f->map_memory;
    size_t left = f->map_bytes;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        const lmb_light *light = &f->scene->lights[i];
        size_t need = lmb_light_map_bytes(lmb_light_map_faces(light, f->scene), f->light_map, f->id_format);
        lmb_status status = lmb_light_map_init(&r->maps[i], light, f->scene, f->light_map, f->id_format, place, left);
        if (status != LMB_OK) {
            return status;
        }
        place += need;
        left -= need;
    }
    return LMB_OK;
}

/* Where a picture's numbers are 0. */
void lmb_render_defaults(lmb_frame *f)
{
    const int even = (f->error == 0.0f || f->visible == 0.0f) && wants_even_light(f);
    f->bounces = f->bounces != 0 ? f->bounces : 1;
    f->steps = f->steps != 0 ? f->steps : STEPS;
    f->error = f->error != 0.0f ? f->error : even ? EVEN_ERROR : ERROR;
    f->visible = f->visible != 0.0f ? f->visible : even ? EVEN_VISIBLE : VISIBLE;
    f->gather_step = f->gather_step != 0 && wants_bounce(f) ? f->gather_step : 1;
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
    f->points.count = 0;
    f->points.faces = 0;
    f->points.owner_count = 0;
    lmb_status status = lmb_render_check(f);
    if (status == LMB_OK) {
        status = place_maps(r);
    }
    r->triangles = status == LMB_OK ? lmb_scene_triangles(f->scene) : 0;
    r->shines = status == LMB_OK && lmb_scene_shines(f->scene);
    r->is_glossy = LMB_TREES && status == LMB_OK && lmb_scene_is_glossy(f->scene);
#if LMB_PLAN
    if (status == LMB_OK) {
        lmb_render_omit(r);
    }
#endif
    r->stage = status == LMB_OK ? LMB_STAGE_LIGHT_MAP : LMB_STAGE_DONE;
    r->failed = status;
    return status;
}

/* What belongs to the picture, not to the light. */
static void set_picture(lmb_frame *f, const lmb_frame *from)
{
    f->kernels = from->kernels;
    f->view = from->view;
    f->show = from->show;
    f->occlusion = from->occlusion;
    f->steps = from->steps;
    f->error = from->error;
    f->visible = from->visible;
    f->proven = from->proven;
    f->many_error = from->many_error;
    f->gather_step = from->gather_step;
    f->exposure_ev = from->exposure_ev;
    f->eye = from->eye;
    f->eye_depth = from->eye_depth;
    f->scratch = from->scratch;
    f->out = from->out;
    f->callback = from->callback;
    f->user = from->user;
    f->stats = from->stats;
}

/* Was what the picture asks for solved with the light? Groups or a tree; the tree of blockers; and bounces between
 * elements, by the same rules. */
static int is_solved(const lmb_frame *f, const lmb_render *r)
{
    const lmb_frame *before = &r->frame;
    const int exact = wants_cut(f) && f->occlusion == LMB_OCCLUSION_EXACT;
    const int same = f->occlusion == before->occlusion && f->error == before->error && f->visible == before->visible &&
                     f->proven == before->proven && f->many_error == before->many_error;
    return (!wants_bounce(f) || wants_bounce(before)) && (same || !wants_bounce(f) || !wants_elements(r)) &&
           (!exact || before->occlusion == LMB_OCCLUSION_EXACT || before->blockers.node_count > 0);
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
        r->keeps &= ~(uint32_t)LMB_KEEP_VIEW;
        r->stage = LMB_STAGE_VIEW;
        r->light = r->face = r->place = 0;
    }
    return status;
}
