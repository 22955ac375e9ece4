/* reuse.c: starts the next frame of an animation and reuses unchanged results. Layer 8. [V33 V34]
 *
 * A caller who changes the scene raises the scene's revisions. Changed settings show in the frame, and memory is the
 * same if the pointers are. A result is reused if all its inputs are unchanged: shadow maps depend on triangles and a
 * light; first points on a map and the materials; the BVH on triangles; groups on all first points; bounces on all of
 * these. */
#include <string.h>

#include "../base/vec.h"
#include "stages.h"
#include "requires.h"

#if LMB_PLAN

/* State taken over from the last frame before r is reset. */
typedef struct old_frame {
    lmb_frame frame;
    uint32_t kept;
    uint8_t light_state[LMB_MAX_LIGHTS];
    uint8_t faces[LMB_MAX_LIGHTS]; /* that bounced */
    uint8_t map_faces[LMB_MAX_LIGHTS];
} old_frame;

static int same_scene(const lmb_render *r, const lmb_frame *f)
{
    return f->scene != NULL && r->frame.scene == f->scene && r->revision == f->scene->revision && !f->run_all &&
           !r->frame.run_all;
}

static int same_appearance(const lmb_render *r, const lmb_frame *f)
{
    return r->appearance_revision == f->scene->appearance_revision;
}

/* Do maps exist for the same lights at the same addresses? A light may have changed. */
static int same_maps(const lmb_render *r, const lmb_frame *f)
{
    const lmb_frame *old = &r->frame;
    const int32_t ids = f->id_format != 0 ? f->id_format : LMB_ID32;
    return old->map_memory == f->map_memory && old->map_bytes == f->map_bytes && old->shadow_map == f->shadow_map &&
           old->id_format == ids && r->lights_revision == f->scene->lights_revision &&
           f->scene->light_count <= LMB_MAX_LIGHTS;
}

static int same_surface(const lmb_surface *a, const lmb_surface *b)
{
    return a->data == b->data && a->width == b->width && a->height == b->height && a->stride_bytes == b->stride_bytes &&
           a->format == b->format && a->layout == b->layout;
}

static int same_view(const lmb_frame *a, const lmb_frame *b)
{
    return memcmp(&a->view, &b->view, sizeof a->view) == 0 && same_surface(&a->eye.depth, &b->eye.depth) &&
           same_surface(&a->eye.id, &b->eye.id) && is_whole(&b->eye.depth, &b->view);
}

static int same_bvh(const lmb_frame *was, const lmb_frame *f)
{
    const lmb_bvh *a = &was->bvh, *b = &f->bvh;
    return requires_bvh(was) && requires_full_bvh(was) == requires_full_bvh(f) &&
           a->scene == was->scene && a->triangle == b->triangle && a->node == b->node && a->small == b->small &&
           a->triangle_cap == b->triangle_cap && a->node_cap == b->node_cap;
}

/* Has it been built since lmb_live_init, with its present settings? */
static int is_built(const lmb_live *live)
{
#if LMB_LIVE
    return live != NULL && live->built == 1 + live->steady;
#else
    (void)live;
    return 0;
#endif
}

static int same_tree(const lmb_frame *a, const lmb_frame *b)
{
    const int live = requires_live(a) || requires_live(b);
    if (live && (a->live != b->live || !is_built(b->live) || a->gather_step != b->gather_step || a->show != b->show ||
                 a->bounces != b->bounces || a->many_lights != b->many_lights)) {
        return 0; /* texels of the required tree may not have been collected */
    }
    return requires_cut(a) && requires_cut(b) && a->tree.texel == b->tree.texel && a->tree.node == b->tree.node &&
           a->tree.view == b->tree.view && a->tree.size == b->tree.size && a->tree.face_cap == b->tree.face_cap;
}

static int same_points(const lmb_frame *a, const lmb_frame *b)
{
    const lmb_points *p = &a->points, *q = &b->points;
    return requires_groups(a) && requires_groups(b) && p->data == q->data && p->cap == q->cap && p->cells == q->cells &&
           p->cell_cap == q->cell_cap && p->owner == q->owner && p->owner_cap == q->owner_cap &&
           a->groups == b->groups && memcmp(&a->grouping, &b->grouping, sizeof a->grouping) == 0;
}

/* Same memory of elements, and same settings of the light between them? */
static int same_elements(const lmb_frame *a, const lmb_frame *b)
{
    return a->elements.data == b->elements.data && a->elements.cap == b->elements.cap &&
           a->elements.tree.texel == b->elements.tree.texel && a->bounces == b->bounces &&
           a->truncated == b->truncated && a->error == b->error && a->visibility == b->visibility &&
           a->conservative == b->conservative && a->occlusion == b->occlusion && a->many_lights == NULL &&
           b->many_lights == NULL;
}

/* Finds the reusable shadow maps and first points. Returns 1 if all are. */
static int reuse_lights(old_frame *old, const lmb_render *r, const lmb_frame *f)
{
    const int solved =
        same_appearance(r, f) && same_tree(&r->frame, f) && r->frame.dim == f->dim && !skips(r, LMB_SKIP_BOUNCE);
    int all = same_maps(r, f);
    for (uint32_t i = 0; i < f->scene->light_count && same_maps(r, f); ++i) {
        if (r->light_revision[i] == f->scene->lights[i].revision) {
            old->light_state[i] = (uint8_t)(LMB_SHADOW_MAP_REUSED | (solved ? LMB_LIGHT_TEXELS_REUSED : 0));
        } else {
            all = 0;
        }
        old->faces[i] = (uint8_t)faces_that_bounce(r, i);
        old->map_faces[i] = (uint8_t)r->maps[i].faces;
    }
    return all;
}

/* Reads from r before r is reset. */
static void find_reused(old_frame *old, const lmb_render *r, const lmb_frame *f)
{
    const lmb_frame *was = &r->frame;
    memset(old, 0, sizeof *old);
    if (r->failed != LMB_OK || r->stage < LMB_STAGE_VIEW || !same_scene(r, f)) {
        return;
    }
    old->frame = *was;
    if (reuse_lights(old, r, f) && same_appearance(r, f) && was->dim == f->dim && !skips(r, LMB_SKIP_BOUNCE)) {
        old->kept |= same_points(was, f) ? LMB_REUSE_POINTS : 0;
        old->kept |= same_tree(was, f) ? LMB_REUSE_BOUNCES : 0;
    }
    old->kept |= same_bvh(was, f) ? LMB_REUSE_BVH : 0;
    old->kept |= r->stage >= LMB_STAGE_BANDS && same_view(was, f) ? LMB_REUSE_VIEW : 0;
}

/* A shadow map and the tree faces for it stay in place if the counts of their faces, and of those of all earlier
 * lights, are unchanged. */
static void keep_places(lmb_render *r, const old_frame *old)
{
    int maps = 1, texels = 1;
    for (uint32_t i = 0; i < r->frame.scene->light_count; ++i) {
        maps = maps && r->maps[i].faces == old->map_faces[i];
        texels = texels && maps && faces_that_bounce(r, i) == old->faces[i];
        r->light_state[i] |= !maps ? 0 : texels ? old->light_state[i] : old->light_state[i] & LMB_SHADOW_MAP_REUSED;
    }
}

lmb_status lmb_render_reuse(lmb_render *r, const lmb_frame *frame)
{
    old_frame old;
    if (r == NULL || frame == NULL) {
        return LMB_ERR_ARG;
    }
    find_reused(&old, r, frame);
    const lmb_status status = lmb_render_begin(r, frame);
    if (status != LMB_OK) {
        return status;
    }
    lmb_frame *f = &r->frame;
    r->reuses = old.kept;
    keep_places(r, &old);
    if (reuses(r, LMB_REUSE_POINTS)) {
        f->points = old.frame.points;
    }
    if (reuses(r, LMB_REUSE_BVH)) {
        f->bvh = old.frame.bvh;
    }
    if (reuses(r, LMB_REUSE_BOUNCES) && same_elements(&old.frame, f)) {
        f->elements = old.frame.elements;
    } else {
        r->reuses &= ~(uint32_t)LMB_REUSE_BOUNCES;
    }
    return LMB_OK;
}

#endif
