/* wants.h: what a frame asks for. Floor 8. */
#ifndef LMB_PLAN_WANTS_H
#define LMB_PLAN_WANTS_H

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

/* Does light come from elements too? */
static inline int wants_elements(const lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    return wants_cut(f) && f->elements.data != NULL && (f->bounces > 1 || r->shines);
}

/* Do lobes count? */
static inline int wants_gloss(const lmb_render *r) { return r->is_glossy && r->frame.show != LMB_SHOW_IRRADIANCE; }

/* Is there another bounce to go, of those by elements? */
static inline int has_bounces(const lmb_render *r)
{
    return wants_elements(r) && r->light + 1 < (uint32_t)r->frame.bounces;
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
    c.blockers = f->occlusion == LMB_OCCLUSION_EXACT ? &f->blockers : NULL;
    c.stats = stats;
    return c;
}

#endif
