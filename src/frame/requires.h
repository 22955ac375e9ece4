/* requires.h: the stages and memory that a frame requires. Layer 8. */
#ifndef LMB_FRAME_REQUIRES_H
#define LMB_FRAME_REQUIRES_H

#include <lambent/render.h>

#include <string.h>

static inline int is_whole(const lmb_surface *s, const lmb_view *v)
{
    return s->data != NULL && s->width == v->frame_width && s->height == v->frame_height;
}

static inline int requires_direct(const lmb_frame *f) { return f->show == LMB_SHOW_FULL || f->show == LMB_SHOW_DIRECT; }

static inline int requires_many_lights(const lmb_frame *f)
{
    return requires_direct(f) && f->many_lights != NULL && f->gather_many_lights == 0;
}

static inline int requires_multisample(const lmb_frame *f) { return LMB_MULTISAMPLE && f->samples > 1; }

/* Is bounced light baked? */
static inline int requires_transfer(const lmb_frame *f)
{
    return LMB_TRANSFER && f->show != LMB_SHOW_DIRECT && f->transfer != NULL;
}

static inline int requires_cut(const lmb_frame *f)
{
    return LMB_TREES && f->transfer == NULL && f->show != LMB_SHOW_DIRECT && f->grouping.method == LMB_GROUP_CUT &&
           f->tree.texel != NULL;
}

static inline int requires_groups(const lmb_frame *f)
{
    return LMB_BOUNCE && f->transfer == NULL && f->show != LMB_SHOW_DIRECT && f->grouping.method != LMB_GROUP_CUT &&
           f->points.data != NULL && f->groups != NULL;
}

static inline int requires_bounce(const lmb_frame *f)
{
    return requires_cut(f) || requires_groups(f) || requires_transfer(f);
}

/* Does bounced light of the maps come from the tree of single points? */
static inline int requires_live(const lmb_frame *f)
{
    return LMB_LIVE && f->gather_step == LMB_GATHER_LIVE && f->live != NULL && requires_cut(f);
}

/* Does a thread's scratch lack the memory for single points that the frame needs? */
static inline int lacks_live(const lmb_frame *f, const lmb_band_scratch *s)
{
    return requires_live(f) && s->live == NULL;
}

/* Flags for skipped and reused work; always 0 if you build without plan. */
static inline int skips(const lmb_render *r, uint32_t what) { return LMB_PLAN && (r->skips & what) != 0; }
static inline int reuses(const lmb_render *r, uint32_t what) { return LMB_PLAN && (r->reuses & what) != 0; }
static inline int light_is(const lmb_render *r, uint32_t light, uint32_t what)
{
    return LMB_PLAN && (r->light_state[light] & what) != 0;
}

/* Number of a light's faces with first points. */
static inline uint32_t faces_that_bounce(const lmb_render *r, uint32_t light)
{
    uint32_t n = 0;
    for (uint32_t bits = light_is(r, light, LMB_LIGHT_DIM) ? 0 : r->maps[light].drawn; bits != 0; bits &= bits - 1) {
        ++n;
    }
    return n;
}

/* Do only many lights light the scene? Their light comes from all sides. */
static inline int wants_even_light(const lmb_frame *f)
{
    return LMB_TREES && f->many_lights != NULL && f->many_lights->lights >= LMB_MANY_LIGHTS_EVEN && f->scene != NULL &&
           f->scene->light_count == 0 && !lmb_scene_emits(f->scene);
}

/* Does the light of many lights bounce? */
static inline int requires_many_lights_bounce(const lmb_frame *f)
{
    return LMB_TREES && f->many_lights != NULL && f->many_lights->lights > 0 && requires_cut(f) &&
           f->elements.data != NULL;
}

/* Do many lights light the elements of baked light? */
static inline int requires_many_lights_transfer(const lmb_frame *f)
{
    return LMB_TREES && requires_transfer(f) && f->many_lights != NULL && f->many_lights->lights > 0;
}

/* Does the gather of bounced light also add the light of many lights? */
static inline int gathers_many_lights(const lmb_frame *f)
{
    return LMB_TREES && f->many_lights != NULL && f->gather_many_lights != 0 && f->show != LMB_SHOW_DIRECT;
}

/* Do many lights have only suns, and does the tree of single points have room for them? */
static inline int has_live_sky(const lmb_frame *f)
{
    return requires_live(f) && f->live_sky != NULL && f->many_lights != NULL && f->many_lights->node_count > 0 &&
           f->many_lights->node[0].kind == LMB_LIGHT_DIRECTIONAL && f->many_lights->cell_count <= f->live_sky->sun_cap;
}

/* Does the gather light single points by many lights? */
static inline int gathers_live_sky(const lmb_frame *f) { return gathers_many_lights(f) && has_live_sky(f); }

/* Does light also come from elements? */
static inline int requires_elements(const lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    return !skips(r, LMB_SKIP_BOUNCE) && requires_cut(f) && f->elements.data != NULL &&
           (f->bounces > 1 || r->emits || requires_many_lights_bounce(f));
}

/* Is bounced light interpolated between single points? */
static inline int requires_samples(const lmb_render *r)
{
    return !skips(r, LMB_SKIP_BOUNCE) && requires_live(&r->frame) &&
           (!gathers_many_lights(&r->frame) || gathers_live_sky(&r->frame));
}

/* Do lobes contribute? */
static inline int requires_glossy(const lmb_render *r) { return r->is_glossy && r->frame.show != LMB_SHOW_IRRADIANCE; }

/* Does a frame take the maps' light from the tree of texels? */
static inline int requires_texels(const lmb_render *r)
{
    return requires_cut(&r->frame) && (!requires_live(&r->frame) || requires_glossy(r));
}

/* Do elements first receive direct light, from emissive surfaces or many lights? */
static inline int sends_direct(const lmb_render *r)
{
    return LMB_TREES && (r->emits || requires_many_lights_bounce(&r->frame));
}

/* Number of passes in which elements receive light. The first reflection of a light with a shadow map comes from the
 * map's texels. Light from emissive surfaces and from many lights is reflected only by elements, which takes one more
 * pass. */
static inline uint32_t radiosity_bounces(const lmb_render *r)
{
    return (uint32_t)r->frame.bounces - (sends_direct(r) ? 0u : 1u);
}

/* Is another pass of elements left? */
static inline int has_bounces(const lmb_render *r)
{
    return requires_elements(r) && !reuses(r, LMB_REUSE_BOUNCES) && r->light < radiosity_bounces(r);
}

/* Many lights require the BVH even if this picture does not show them, because you may reuse the solution for a view
 * that does. */
static inline int requires_full_bvh(const lmb_frame *f)
{
    return (requires_cut(f) && f->occlusion == LMB_OCCLUSION_EXACT) ||
           (f->many_lights != NULL && f->bvh.triangle != NULL);
}

/* Is there memory for a BVH of few triangles? */
static inline int has_small_bvh(const lmb_frame *f)
{
    return LMB_FACETS && f->bvh.triangle != NULL && f->bvh.triangle_cap <= LMB_TRACED_TRIANGLES;
}

/* Is a BVH built? If it is small, also for a frame that does not use it, because the next picture of the same light may
 * show only direct light. */
static inline int requires_bvh(const lmb_frame *f) { return requires_full_bvh(f) || has_small_bvh(f); }

/* In lmb_render.reuses: the BVH is that of has_small_bvh, built fast. LMB_OCCLUSION_EXACT needs the other one. */
#define BUILT_FAST 0x80000000u

/* Are lit pixels traced around which shadow maps show other triangles? */
static inline int requires_traced(const lmb_frame *f)
{
    return (requires_full_bvh(f) || ((f->show == LMB_SHOW_DIRECT || requires_transfer(f)) && has_small_bvh(f))) &&
           f->bvh.node_count > 0;
}

/* The BVH that occludes light of single points, or NULL; and the counts of a thread. */
static inline const lmb_bvh *live_bvh(const lmb_frame *f)
{
    return f->occlusion == LMB_OCCLUSION_EXACT ? &f->bvh : NULL;
}

static inline void count_live(lmb_stats *stats, lmb_live_scratch *s)
{
    if (stats != NULL) {
        stats->segments += s->segments;
        stats->pairs += s->pairs;
        stats->full_cuts += s->full;
    }
    s->segments = s->pairs = s->full = 0;
}

/* The depth map that occludes, or NULL. */
static inline const lmb_surface *occluding_depth(const lmb_frame *f)
{
    if (f->occlusion == LMB_OCCLUSION_NONE || f->occlusion == LMB_OCCLUSION_EXACT || !requires_groups(f)) {
        return NULL;
    }
    return is_whole(&f->eye.depth, &f->view) ? &f->eye.depth : &f->eye_depth;
}

static inline lmb_cut_params cut_params_of(const lmb_frame *f, lmb_stats *stats)
{
    lmb_cut_params c;
    memset(&c, 0, sizeof c);
    c.error = f->error;
    c.visibility = f->visibility;
    c.conservative = f->conservative;
    c.floor =
        f->error_floor * 9.42477796f; /* 3 channels x pi: irradiance at which a white surface shows this radiance */
    c.bvh = f->occlusion == LMB_OCCLUSION_EXACT ? &f->bvh : NULL;
    c.stats = stats;
    return c;
}

/* A query for elements, which a pixel sees many of: their errors may be larger. */
static inline lmb_many_lights_query elements_query(const lmb_frame *f, lmb_stats *stats)
{
    enum { PIXEL_ERROR_FACTOR = 2 }; /* a pixel's error; with 4 spots lose 1 % of light */
    const float error = (f->many_lights_error > 0.0f ? f->many_lights_error : 0.02f) * (float)PIXEL_ERROR_FACTOR;
    const lmb_many_lights_query query = {f->many_lights, f->bvh.triangle != NULL ? &f->bvh : NULL, error, 1, 0,
                                         stats};
    return query;
}

/* Adds the cut counts of a scratch; builds without trees have none. */
static inline void add_counts(lmb_stats *stats, const lmb_stats *counts)
{
    if (LMB_TREES && stats != NULL) {
        stats->pairs += counts->pairs;
        stats->segments += counts->segments;
        stats->corner_segments += counts->corner_segments;
        stats->full_cuts += counts->full_cuts;
        stats->tiles += counts->tiles;
        stats->coarse_tiles += counts->coarse_tiles;
    }
}

#endif
