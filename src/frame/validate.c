/* validate.c: checks whether a frame can be drawn: numbers, surfaces, settings. Layer 8. */
#include <string.h>

#include "../base/surface_check.h"
#include "../raster/target.h"
#include "stages.h"
#include "requires.h"

static lmb_status check_eye(const lmb_frame *f)
{
    const lmb_surface *d = &f->eye.depth;
    lmb_status status = lmb_target_check(&f->eye, &f->view, lmb_scene_triangles(f->scene));
    if (status != LMB_OK) {
        return status;
    }
    if (f->eye.id.data == NULL || f->eye.x0 != 0 || f->eye.y0 != 0 || d->width != f->view.frame_width ||
        (d->height != f->view.frame_height && d->height % LMB_TILE != 0)) {
        return LMB_ERR_ARG;
    }
    const lmb_surface *map = occluding_depth(f);
    if (map == NULL || map == d) {
        return LMB_OK;
    }
    lmb_target whole = f->eye;
    whole.depth = *map;
    memset(&whole.id, 0, sizeof whole.id);
    return is_whole(map, &f->view) ? lmb_target_check(&whole, &f->view, 0) : LMB_ERR_ARG;
}

lmb_status lmb_render_check_out(const lmb_surface *out, const lmb_view *v)
{
    if (out->data == NULL || out->width != v->frame_width ||
        (out->height != v->frame_height && out->height != LMB_TILE)) {
        return LMB_ERR_ARG;
    }
    if (!is_colour_format(out->format) || out->layout != LMB_LINEAR) {
        return LMB_ERR_FORMAT;
    }
    return lmb_surface_is_valid(out) ? LMB_OK : LMB_ERR_ARG;
}

/* A tree takes one texel out of 1 x 1, 2 x 2, 4 x 4 or 8 x 8 texels of the shadow maps. */
static int fits_tree(const lmb_frame *f)
{
    const int32_t each = f->shadow_map / f->tree.size;
    return each * f->tree.size == f->shadow_map && (each == 1 || each == 2 || each == 4 || each == 8);
}

/* Does the frame have the memory for further reflections? */
static int reflects_again(const lmb_frame *f)
{
    return requires_transfer(f) ? f->transfer->count[LMB_TRANSFER_COARSE] > 0
                                : requires_cut(f) && f->elements.data != NULL;
}

static int has_lattice(const lmb_frame *f)
{
    return f->lattice.tile != NULL && f->lattice.width == f->view.frame_width &&
           f->lattice.height == f->view.frame_height;
}

/* Does the frame have the memory for light of single points? */
static int has_live(const lmb_frame *f)
{
    return requires_live(f) && f->live->face != NULL && f->live->strata >= 1 && f->live->strata <= LMB_LIVE_STRATA &&
           f->live->element_cap >= f->elements.cap && (f->live_sky == NULL || f->live_sky->chunk != NULL) &&
           f->scratch->live != NULL;
}

/* Does a stage that needs large nodes have small ones? */
static int has_wrong_bvh(const lmb_frame *f)
{
    return f->bvh.small != NULL && requires_full_bvh(f) &&
           (!requires_live(f) || f->many_lights != NULL || lmb_scene_is_glossy(f->scene));
}

lmb_status lmb_render_check(const lmb_frame *f)
{
    if (f->kernels == NULL || f->scene == NULL || f->scratch == NULL || f->show < LMB_SHOW_FULL ||
        f->show > LMB_SHOW_IRRADIANCE || f->steps < 0 || f->steps > 64 || f->view.frame_width < 1 ||
        f->view.frame_height < 1 || f->occlusion < LMB_OCCLUSION_NONE || f->occlusion > LMB_OCCLUSION_EXACT ||
        !(f->error > 0.0f) || !(f->visibility > 0.0f)) {
        return LMB_ERR_ARG;
    }
    if (!LMB_TRANSFER && f->transfer != NULL) {
        return LMB_ERR_ARG;
    }
    if (!LMB_TREES && (f->grouping.method == LMB_GROUP_CUT || f->many_lights != NULL)) {
        return LMB_ERR_ARG;
    }
    if (requires_many_lights_transfer(f) && f->transfer_light.place == NULL) {
        return LMB_ERR_ARG;
    }
    if (f->bounces < 1 || f->bounces > LMB_MAX_BOUNCES ||
        (f->bounces > 1 && requires_bounce(f) && !reflects_again(f))) {
        return LMB_ERR_ARG;
    }
    if ((f->gather_step != 1 && !(has_lattice(f) && has_live(f))) || has_wrong_bvh(f)) {
        return LMB_ERR_ARG;
    }
    if (f->scene->light_count > LMB_MAX_LIGHTS) {
        return LMB_ERR_CAPACITY;
    }
    if (requires_cut(f) ? !fits_tree(f) || f->occlusion % LMB_OCCLUSION_EXACT != 0
                        : requires_groups(f) && f->occlusion == LMB_OCCLUSION_EXACT) {
        return LMB_ERR_ARG;
    }
    if (f->id_format == LMB_ID16 && lmb_scene_triangles(f->scene) > 65535u) {
        return LMB_ERR_SCENE;
    }
    lmb_status status = check_eye(f);
    if (status == LMB_OK) {
        status = lmb_multisample_check(f, f->scratch);
    }
    return status != LMB_OK ? status : lmb_render_check_out(&f->out, &f->view);
}
