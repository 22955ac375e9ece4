/* relight.c: a band of objects in the world's light. Layer 8.                                    [S15-S17, S21-S24] */
#include <lambent/relight.h>

#include <string.h>

#include "../base/surface_check.h"
#include "../direct/light_tile.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"

#if LMB_PROBES

static lmb_world_query look_of(const lmb_relight *r)
{
    const lmb_view *v = &r->view;
    lmb_world_query query;
    query.world = r->world;
    query.ray_width = v->kind == LMB_PERSPECTIVE ? 2.0f * v->half_height / (float)v->frame_height : 0.0f;
    query.blend = r->blend;
    return query;
}

/* Mask of the remaining pixels that share the first one's probe. */
static uint64_t with_same_probe(uint16_t *probe, const lmb_relight *r, const lmb_tile *tile, uint64_t left)
{
    uint64_t same = 0;
    uint32_t id = 0;
    uint16_t of_id = 0;
    *probe = r->probe_of[lmb_instance_of(r->scene, tile->id[lowest_bit_64(left)]) - r->scene->instances];
    for (uint64_t bits = left; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        if (tile->id[k] != id) {
            id = tile->id[k];
            of_id = r->probe_of[lmb_instance_of(r->scene, id) - r->scene->instances];
        }
        same |= (uint64_t)(of_id == *probe) << k;
    }
    return same;
}

/* Adds a probe's light to the probe's pixels. A mirror without a world is dark. */
static lmb_status add_probe(const lmb_relight *r, lmb_relight_scratch *s, uint64_t pixels, const lmb_probe *probe,
                            int is_glossy)
{
    const lmb_world_query query = look_of(r);
    const int looks = probe->glossy.texel == NULL;
    lmb_status status = LMB_OK;
    if (r->show != LMB_RELIGHT_GLOSSY) {
        status = lmb_probe_light_tile(&s->light, r->kernels, &s->rays, &s->tile, pixels, &probe->irradiance);
    }
    if (status == LMB_OK && is_glossy && r->show != LMB_RELIGHT_NORMAL && !(looks && r->world == NULL)) {
        status = lmb_probe_glossy_tile(&s->glossy, r->kernels, &s->rays, &s->tile, pixels,
                                       looks ? NULL : &probe->glossy, &query);
    }
    return status;
}

static lmb_status add_probes(const lmb_relight *r, lmb_relight_scratch *s, int is_glossy)
{
    lmb_status status = LMB_OK;
    for (uint64_t left = tile_pixels(&s->tile); left != 0 && status == LMB_OK;) {
        uint16_t probe;
        const uint64_t pixels = with_same_probe(&probe, r, &s->tile, left);
        status = add_probe(r, s, pixels, &r->probes[probe], is_glossy);
        left &= ~pixels;
    }
    return status;
}

/* Adds the scene's own lights, then clears the part that is not shown. So the shown part is exact to the bit. */
static lmb_status add_lights(const lmb_relight *r, lmb_relight_scratch *s, lmb_glossy *glossy)
{
    const light_tile lit = {r->kernels, r->scene, &r->view, &s->tile};
    lmb_status status = LMB_OK;
    for (uint32_t i = 0; i < r->scene->light_count && status == LMB_OK; ++i) {
        status = lmb_light_tile_add(&s->light, glossy, &s->one, &lit, i, r->maps != NULL ? &r->maps[i] : NULL);
    }
    if (r->show == LMB_RELIGHT_GLOSSY) {
        memset(&s->light, 0, sizeof s->light);
    }
    if (r->show == LMB_RELIGHT_NORMAL && glossy != NULL) {
        memset(glossy->rgb, 0, sizeof glossy->rgb);
    }
    return status;
}

/* Does every instance have a probe with light? */
static int has_probes(const lmb_relight *r)
{
    int valid = 1;
    for (uint32_t i = 0; i < r->scene->instance_count && valid; ++i) {
        valid = r->probe_of[i] < r->probe_count && r->probes[r->probe_of[i]].irradiance.texel != NULL;
    }
    return valid;
}

static lmb_status relight_tile(const lmb_relight *r, lmb_relight_scratch *s)
{
    const lmb_world_query query = look_of(r);
    lmb_glossy *glossy = lmb_glossy_tile(&s->glossy, &s->tile, &r->view, r->scene) ? &s->glossy : NULL;
    memset(&s->light, 0, sizeof s->light);
    lmb_status status = add_lights(r, s, glossy);
    if (status == LMB_OK) {
        status = add_probes(r, s, glossy != NULL);
    }
    if (status == LMB_OK) {
        status = lmb_compose_tile(&s->radiance, r->kernels, &s->tile, &s->light, NULL);
    }
    if (status == LMB_OK && glossy != NULL) {
        status = lmb_compose_glossy(&s->radiance, glossy);
    }
    if (status == LMB_OK && r->show != LMB_RELIGHT_GLOSSY) {
        status = lmb_compose_emission(&s->radiance, r->scene, &r->view, &s->tile);
    }
    return status == LMB_OK && r->world != NULL
               ? lmb_probe_background(s->radiance.rgb, r->kernels, &s->rays, &s->tile, &r->view, &query)
               : status;
}

lmb_status lmb_relight_band(const lmb_relight *r, lmb_relight_scratch *scratch, const lmb_surface *out, int32_t band)
{
    if (r == NULL || scratch == NULL || r->kernels == NULL || r->scene == NULL || r->probes == NULL ||
        r->probe_of == NULL || band < 0 || band >= (r->view.frame_height + LMB_TILE - 1) / LMB_TILE ||
        r->show < LMB_RELIGHT_BOTH || r->show > LMB_RELIGHT_GLOSSY || !has_probes(r)) {
        return LMB_ERR_ARG;
    }
    if (!lmb_surface_is_valid(out)) {
        return LMB_ERR_FORMAT;
    }
    const int32_t y = band * LMB_TILE, y0 = out->height >= r->view.frame_height ? 0 : y;
    lmb_status status = LMB_OK;
    for (int32_t x = 0; x < r->view.frame_width && status == LMB_OK; x += LMB_TILE) {
        status = lmb_resolve_tile(&scratch->tile, r->kernels, &r->view, r->scene, &r->eye, x, y);
        if (status == LMB_OK) {
            status = relight_tile(r, scratch);
        }
        if (status == LMB_OK) {
            status = lmb_store_tile(out, r->kernels, 0, y0, &scratch->radiance, x, y, r->exposure_ev);
        }
    }
    return status;
}

#endif
