/* shade.c: direct light of a tile, and the radiance of the pixels towards the viewer. Layer 8. */
#include <string.h>

#include "../base/vec.h"
#include "../direct/light_tile.h"
#include "../occlusion/traversal.h"
#include "../raster/plane.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "stages.h"
#include "requires.h"

/* SHOW_IRRADIANCE shows the irradiance, without albedo. */
static void show_irradiance(lmb_radiance *out, const lmb_irradiance *e) { memcpy(out->rgb, e->rgb, sizeof out->rgb); }

#if LMB_FACETS

enum { MAX_ALONE = 2 /* pixels of a tile that a light reaches on their own */ };

/* The corner of a room may be smaller than a texel of a shadow map, and the texel then shows a surface behind the room.
 * This traces segments to the light from the pixels where that is so, and from all lit ones if they are few.
 * lit: the light of this light alone. */
NOINLINE void leave_out_leaks(lmb_irradiance *lit, lmb_band_scratch *s, const lmb_frame *f, const lmb_light *light,
                              const light_tile *on, uint64_t doubtful)
{
    lmb_traversal *t = &s->gather.cut.use.traversal;
    const lmb_view *view = on->view;
    uint64_t asked = 0, dark;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        asked |= (uint64_t)(lit->rgb[0][k] != 0.0f || lit->rgb[1][k] != 0.0f || lit->rgb[2][k] != 0.0f) << k;
    }
    asked = count_bits_64(asked) > MAX_ALONE ? doubtful : asked;
    if (asked == 0) {
        return;
    }
    s->counts.corner_segments += (uint64_t)count_bits_64(asked);
    traversal_bound(t);
    t->eye_kind = view->kind == LMB_PERSPECTIVE ? LMB_EYE_PLACE : LMB_EYE_FAR;
    t->eye = view->kind == LMB_PERSPECTIVE ? view->eye : view->back;
    dark = light->kind == LMB_LIGHT_DIRECTIONAL
               ? lmb_occluded_sun(f->kernels, t, &f->bvh, on->tile, asked, normalize3(mul3(light->direction, -1.0f)))
               : lmb_occluded_tile(f->kernels, t, &f->bvh, on->tile, asked, light->position,
                                   lmb_tile_noise(on->tile, asked) + lmb_place_noise(light->position, 0.0f));
    for (uint64_t bits = dark; bits != 0; bits &= bits - 1) {
        for (int c = 0; c < 3; ++c) {
            lit->rgb[c][lowest_bit_64(bits)] = 0.0f;
        }
    }
}

/* lmb_light_tile_add without leaks. */
static lmb_status add_tight(lmb_glossy *glossy, lmb_band_scratch *s, const lmb_render *r, const light_tile *on,
                            uint32_t i)
{
    const lmb_light *light = &r->frame.scene->lights[i];
    uint64_t doubtful;
    memset(&s->indirect, 0, sizeof s->indirect);
    lmb_status status = lmb_direct_doubtful(&s->indirect, &doubtful, on, light, &r->maps[i]);
    if (status == LMB_OK) {
        leave_out_leaks(&s->indirect, s, &r->frame, light, on, doubtful);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            for (int c = 0; c < 3; ++c) {
                s->direct.rgb[c][k] += s->indirect.rgb[c][k];
            }
        }
        if (glossy != NULL) {
            status = lmb_glossy_direct(glossy, on->kernels, on->tile, &s->indirect, light);
        }
    }
    return status;
}

#endif

lmb_status lmb_render_direct(const lmb_render *r, lmb_glossy *glossy, lmb_band_scratch *s, const lmb_tile *tile,
                             const lmb_view *view)
{
    const lmb_frame *f = &r->frame;
    const light_tile lit = {f->kernels, f->scene, view, tile};
    lmb_many_lights_query query;
    lmb_status status = LMB_OK;
    memset(&s->direct, 0, sizeof s->direct);
    for (uint32_t i = 0; requires_direct(f) && i < f->scene->light_count && status == LMB_OK; ++i) {
        if (light_is(r, i, LMB_LIGHT_DARK)) {
            continue;
        }
#if LMB_FACETS
        if (requires_bvh(f) && f->bvh.node_count > 0) {
            status = add_tight(glossy, s, r, &lit, i);
            continue;
        }
#endif
        status = lmb_light_tile_add(&s->direct, glossy, &s->indirect, &lit, i, &r->maps[i]);
    }
    if (requires_many_lights(f) && status == LMB_OK) {
        query.many_lights = f->many_lights;
        query.bvh = f->bvh.triangle != NULL ? &f->bvh : NULL;
        query.error = f->many_lights_error;
        query.each = query.by_seen = 0;
        query.stats = &s->counts;
        status = lmb_many_lights_direct_tile(&s->direct, f->kernels, &s->many_lights, tile, &query);
    }
    return status;
}

/* Pixels of LMB_UNLIT materials show the albedo instead of light. */
static void show_unlit(lmb_radiance *inout, const lmb_scene *scene, const lmb_tile *tile)
{
    const lmb_material *m = NULL;
    uint32_t id = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != id) {
            id = tile->id[k];
            m = lmb_material_of(scene, id);
        }
        for (int c = 0; c < 3 && m != NULL && (m->flags & LMB_UNLIT) != 0; ++c) {
            inout->rgb[c][k] = tile->albedo[c][k];
        }
    }
}

#if LMB_TREES

/* Adds the background to pixels without a surface. */
static void show_background(lmb_radiance *inout, const lmb_frame *f, const lmb_view *view, const lmb_tile *tile)
{
    lmb_rays rays;
    const float pixel = view->kind == LMB_PERSPECTIVE ? view->half_height / (float)view->frame_height : 0.0f;
    lmb_resolve_rays(&rays, view, tile->x, tile->y);
    for (uint64_t bits = ~tile_pixels(tile); bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 across = mul3(rays.rx, (float)(k % LMB_TILE)), down = mul3(rays.ry, (float)(k / LMB_TILE));
        float rgb[3];
        lmb_env_sample(rgb, f->background, add3(rays.direction, add3(across, down)), pixel);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] = rgb[c];
        }
    }
}

#endif

lmb_status lmb_render_radiance(const lmb_render *r, const lmb_glossy *glossy, lmb_band_scratch *s, const lmb_tile *tile,
                               const lmb_view *view, const lmb_irradiance *indirect)
{
    const lmb_frame *f = &r->frame;
    if (f->show == LMB_SHOW_IRRADIANCE) {
        show_irradiance(&s->radiance, indirect);
        return LMB_OK;
    }
    lmb_status status = lmb_compose_tile(&s->radiance, f->kernels, tile, &s->direct, indirect);
    if (status == LMB_OK && glossy != NULL) {
        status = lmb_compose_glossy(&s->radiance, glossy);
    }
    if (status == LMB_OK && r->emits && requires_direct(f)) {
        status = lmb_compose_emission(&s->radiance, f->scene, view, tile);
    }
    if (status == LMB_OK && r->is_unlit && requires_direct(f)) {
        show_unlit(&s->radiance, f->scene, tile);
    }
#if LMB_TREES
    if (f->background != NULL && requires_direct(f) && tile_pixels(tile) != UINT64_MAX) {
        show_background(&s->radiance, f, view, tile);
    }
#endif
    return status;
}
