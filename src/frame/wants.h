/* wants.h: what a frame asks for. Floor 10. */
#ifndef LMB_FRAME_WANTS_H
#define LMB_FRAME_WANTS_H

#include <lambent/render.h>

#include <string.h>

static inline int is_whole(const lmb_surface *s, const lmb_view *v)
{
    return s->data != NULL && s->width == v->frame_width && s->height == v->frame_height;
}

static inline int wants_direct(const lmb_frame *f) { return f->show == LMB_SHOW_FULL || f->show == LMB_SHOW_DIRECT; }

static inline int wants_many(const lmb_frame *f) { return wants_direct(f) && f->many != NULL; }

static inline int wants_cut(const lmb_frame *f)
{
    return f->show != LMB_SHOW_DIRECT && f->grouping.method == LMB_GROUP_CUT && f->tree.texel != NULL;
}

static inline int wants_groups(const lmb_frame *f)
{
    return f->show != LMB_SHOW_DIRECT && f->grouping.method != LMB_GROUP_CUT && f->points.data != NULL &&
           f->groups != NULL;
}

static inline int wants_bounce(const lmb_frame *f) { return wants_cut(f) || wants_groups(f); }

/* What is left out and what is kept; nothing in builds without plan. */
static inline int omits(const lmb_render *r, uint32_t what) { return LMB_PLAN && (r->omits & what) != 0; }
static inline int keeps(const lmb_render *r, uint32_t what) { return LMB_PLAN && (r->keeps & what) != 0; }
static inline int light_is(const lmb_render *r, uint32_t light, uint32_t what)
{
    return LMB_PLAN && (r->light_state[light] & what) != 0;
}

/* How many of a light's faces have first points. */
static inline uint32_t faces_that_bounce(const lmb_render *r, uint32_t light)
{
    uint32_t n = 0;
    for (uint32_t bits = light_is(r, light, LMB_LIGHT_DIM) ? 0 : r->maps[light].drawn; bits != 0; bits &= bits - 1) {
        ++n;
    }
    return n;
}

/* Is all light that of many lights, which comes from all sides? */
static inline int wants_even_light(const lmb_frame *f)
{
    return LMB_TREES && f->many != NULL && f->many->lights >= LMB_MANY_EVEN && f->scene != NULL &&
           f->scene->light_count == 0 && !lmb_scene_shines(f->scene);
}

/* Do many lights bounce? */
static inline int wants_many_bounce(const lmb_frame *f)
{
    return LMB_TREES && f->many != NULL && f->many->lights > 0 && wants_cut(f) && f->elements.data != NULL;
}

/* Does light come from elements too? */
static inline int wants_elements(const lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    return !omits(r, LMB_OMIT_BOUNCE) && wants_cut(f) && f->elements.data != NULL &&
           (f->bounces > 1 || r->shines || wants_many_bounce(f));
}

/* Do lobes count? */
static inline int wants_gloss(const lmb_render *r) { return r->is_glossy && r->frame.show != LMB_SHOW_IRRADIANCE; }

/* Do elements receive direct light first, of what shines by itself or of many lights? */
static inline int sends_direct(const lmb_render *r) { return LMB_TREES && (r->shines || wants_many_bounce(&r->frame)); }

/* How often elements receive. The first reflection of a lamp's light is that of its map's texels; what shines by itself
 * and many lights are reflected by elements alone, and so is their first light. */
static inline uint32_t exchanges(const lmb_render *r)
{
    return (uint32_t)r->frame.bounces - (sends_direct(r) ? 0u : 1u);
}

/* Is there another pass of elements to go? */
static inline int has_bounces(const lmb_render *r)
{
    return wants_elements(r) && !keeps(r, LMB_KEEP_BOUNCES) && r->light < exchanges(r);
}

/* Many lights want them whatever is shown: another picture by the same light may show what this one does not. */
static inline int wants_blockers(const lmb_frame *f)
{
    return (wants_cut(f) && f->occlusion == LMB_OCCLUSION_EXACT) || (f->many != NULL && f->blockers.triangle != NULL);
}

/* The depth map that occludes, or NULL. */
static inline const lmb_surface *occluding_depth(const lmb_frame *f)
{
    if (f->occlusion == LMB_OCCLUSION_NONE || f->occlusion == LMB_OCCLUSION_EXACT || !wants_groups(f)) {
        return NULL;
    }
    return is_whole(&f->eye.depth, &f->view) ? &f->eye.depth : &f->eye_depth;
}

static inline lmb_cutting cutting_of(const lmb_frame *f, lmb_stats *stats)
{
    lmb_cutting c;
    memset(&c, 0, sizeof c);
    c.error = f->error;
    c.visible = f->visible;
    c.proven = f->proven;
    c.floor = f->least * 9.42477796f; /* 3 channels x pi: the irradiance that a white surface shows as that radiance */
    c.blockers = f->occlusion == LMB_OCCLUSION_EXACT ? &f->blockers : NULL;
    c.stats = stats;
    return c;
}

#endif
