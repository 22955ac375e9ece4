/* glossy.c: finds the pixels of a tile with a glossy lobe, and adds what the lobes reflect of lights. Layer 4. */
#include <string.h>

#include "../lane/kernels.h"
#include "../raster/paint.h"
#include "../raster/tile.h"
#include "glossy.h"

#if LMB_LOBES

#define LANE_ONE
#include "../lane/lane_scalar.h"
#include "../lane/lane.h"
#include "lobe.inl"

/* No lobes: values that are safe in the formulas. */
static void clear(lmb_glossy *out)
{
    memset(out, 0, sizeof *out);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out->alpha2[k] = out->facing[k] = 1.0f;
    }
}

/* F0 and roughness of pixel k: from the material, or per texel if there is a metal map. */
static void set_lobe_look(lmb_glossy *out, float *roughness, int k, const lmb_material *m, lmb_painter *painter)
{
    float metallic = 0.0f, base[3] = {0.0f, 0.0f, 0.0f};
    *roughness = m->roughness;
    if (m->metal_map > 0) {
        lmb_painter_metal(&metallic, roughness, painter, k);
        lmb_painter_base(base, painter, k);
    }
    for (int c = 0; c < 3; ++c) {
        out->specular[c][k] = m->specular[c] + (base[c] - m->specular[c]) * metallic;
    }
}

static void set_lobe_pixel(lmb_glossy *out, int k, float roughness, lmb_vec3 normal, lmb_vec3 towards)
{
    const float alpha = maxf(roughness * roughness, LMB_MIN_ALPHA);
    out->alpha2[k] = alpha * alpha;
    tile_set_vec(out->towards, k, towards);
    out->facing[k] = maxf(dot3(normal, towards), LOBE_MIN);
    out->pixels |= (uint64_t)1 << k;
}

int lmb_glossy_tile(lmb_glossy *out, const lmb_tile *tile, const lmb_view *view, const lmb_scene *scene)
{
    const lmb_material *m = NULL;
    lmb_painter painter;
    uint32_t id = 0;
    if (out == NULL) {
        return 0;
    }
    out->pixels = 0;
    if (tile == NULL || view == NULL || scene == NULL) {
        return 0;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != id) {
            id = tile->id[k];
            m = lmb_material_of(scene, id);
        }
        if (m != NULL && (m->specular[0] > 0.0f || m->specular[1] > 0.0f || m->specular[2] > 0.0f)) {
            float roughness;
            if (out->pixels == 0) {
                clear(out);
                lmb_painter_begin(&painter, scene, view, tile);
            }
            set_lobe_look(out, &roughness, k, m, &painter);
            set_lobe_pixel(out, k, roughness, tile_vec(tile->normal, k),
                           view->kind == LMB_PERSPECTIVE ? normalize3(sub3(view->eye, tile_vec(tile->position, k)))
                                                         : view->back);
        }
    }
    return out->pixels != 0;
}

lmb_status lmb_glossy_direct(lmb_glossy *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                             const lmb_irradiance *lit, const lmb_light *light)
{
    if (inout == NULL || kernels == NULL || tile == NULL || lit == NULL || light == NULL) {
        return LMB_ERR_ARG;
    }
    kernels->glossy_direct(inout, tile, lit, light);
    return LMB_OK;
}

static lobe_pixels lobe_of_pixel(const lmb_glossy *glossy, const lmb_tile *tile, int k)
{
    lobe_pixels p;
    p.n = lane3_of(tile_vec(tile->normal, k));
    p.v = lane3_of(tile_vec(glossy->towards, k));
    p.specular = lane3_of(tile_vec(glossy->specular, k));
    p.facing = lane_splat(glossy->facing[k]);
    p.a2 = lane_splat(glossy->alpha2[k]);
    return p;
}

static lane3 unit(lmb_vec3 to)
{
    return lane3_of(mul3(to, 1.0f / sqrtf(maxf(dot3(to, to), 1e-24f))));
}

void lmb_glossy_add(lmb_glossy *inout, const lmb_tile *tile, int k, lmb_vec3 to, float angle, lmb_vec3 light)
{
    const lobe_pixels p = lobe_of_pixel(inout, tile, k);
    lane3 sum = lane3_splat(inout->rgb[0][k], inout->rgb[1][k], inout->rgb[2][k]);
    sum = lobe_add(sum, &p, unit(to), lane_splat(angle), lane3_of(light));
    lobe_store(inout, k, sum);
}

float lmb_glossy_factor(const lmb_glossy *glossy, const lmb_tile *tile, int k, lmb_vec3 to, float angle)
{
    const lobe_pixels p = lobe_of_pixel(glossy, tile, k);
    float factor;
    lane rise;
    const lane value = lobe_value(&rise, &p, unit(to), lane_splat(angle));
    lane_store(&factor, lobe_light(lane_splat(1.0f), value,
                                   lane_max(lane_max(p.specular.x, p.specular.y), p.specular.z), rise));
    return factor;
}

#endif
