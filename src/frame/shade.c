/* shade.c: direct light of a tile, and the radiance of the pixels towards the viewer. Layer 8. */
#include <string.h>

#include "../base/light_kind.h"
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

/* Returns those pixels that the light does not reach. */
static uint64_t trace_pixels(lmb_traversal *t, const lmb_frame *f, const lmb_light *light, const lmb_tile *tile,
                             uint64_t asked)
{
    return light_kind_is(light->kind, LIGHT_FAR)
               ? lmb_occluded_sun(f->kernels, t, &f->bvh, tile, asked, normalize3(mul3(light->direction, -1.0f)))
               : lmb_occluded_tile(f->kernels, t, &f->bvh, tile, asked, light->position,
                                   lmb_tile_noise(tile, asked) + lmb_place_noise(light->position, 0.0f));
}

/* The same for pixels whose position lies outside the triangle that they show, from positions in the triangle: past the
 * foot of a wall, a position is outside the room. */
NOINLINE uint64_t trace_moved(lmb_band_scratch *s, const lmb_frame *f, const lmb_light *light, const lmb_tile *tile,
                              uint64_t asked)
{
    lmb_tile *moved = &s->together;
    uint64_t out = 0;
    for (uint64_t bits = asked; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 at = tile_vec(tile->position, k), on = lmb_place_onto_triangle(f->scene, tile->id[k], at);
        if (on.x != at.x || on.y != at.y || on.z != at.z) {
            tile_put_pixel(moved, k, tile, k);
            tile_set_vec(moved->position, k, on);
            out |= (uint64_t)1 << k;
        }
    }
    if (out != 0) {
        out = trace_pixels(&s->gather.cut.use.traversal, f, light, moved, out);
        memset(moved, 0, sizeof *moved);
    }
    return out;
}

/* The corner of a room, or triangles of walls, may be smaller than a texel of a shadow map. This traces segments to the
 * light from the lit pixels that the texels around them do not decide. Returns those that are in shadow. */
NOINLINE uint64_t find_leaks(lmb_band_scratch *s, const lmb_frame *f, const lmb_light *light, const light_tile *on,
                             uint64_t asked)
{
    lmb_traversal *t = &s->gather.cut.use.traversal;
    const lmb_view *view = on->view;
    s->counts.corner_segments += (uint64_t)count_bits_64(asked);
    traversal_bound(t);
    t->eye_kind = view->kind == LMB_PERSPECTIVE ? LMB_EYE_PLACE : LMB_EYE_FAR;
    t->eye = view->kind == LMB_PERSPECTIVE ? view->eye : view->back;
    const uint64_t dark = trace_pixels(t, f, light, on->tile, asked);
    return dark | trace_moved(s, f, light, on->tile, asked & ~dark);
}

/* lmb_light_tile_add without leaks. */
static lmb_status add_tight(lmb_glossy *glossy, lmb_band_scratch *s, const lmb_render *r, const light_tile *on,
                            uint32_t i)
{
    const lmb_light *light = &r->frame.scene->lights[i];
    uint64_t lit;
    const uint64_t unsure =
        lmb_direct_find(&s->indirect, &lit, on, light, &r->maps[i], !requires_full_bvh(&r->frame));
    if (unsure != 0) {
        lit &= ~find_leaks(s, &r->frame, light, on, unsure);
    }
    lmb_direct_add(&s->direct, on->kernels, &s->indirect, lit);
    if (glossy == NULL) {
        return LMB_OK;
    }
    for (uint64_t bits = ~lit; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        s->indirect.rgb[0][k] = s->indirect.rgb[1][k] = s->indirect.rgb[2][k] = 0.0f;
    }
    return lmb_glossy_direct(glossy, on->kernels, on->tile, &s->indirect, light);
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
        if (requires_traced(f)) {
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
