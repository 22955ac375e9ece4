/* mix_lobes.c: objects that reflect like metal, by rays about the mirror direction. [M20] */
#include "mix_lobes.h"
#include "mix_sources.h"

#include "mix_world.h"

#include <math.h>
#include <string.h>

enum { PARTS = 4 /* of a guessed sun's samples, one for each sample of the picture */ };

#define THROWN 0.75f /* share of light reflected by metal that is treated as diffuse: the rest is directional */
#define MATT   0.08f /* maximum reflectance of a non-metal */
#define RIM    0.15f /* the environment has no surfaces directly behind the object's rim */
#define SMOOTH 0.7f  /* roughness from which on a non-metal has no visible highlight */

/* --- metals ------------------------------------------------------------------------------------------------------- */

/* Drops the weak lobe of non-metals, as `render` does without --glossy: mix has one way to draw it. */
void mix_lobes_read(mix_job *j)
{
    lmb_material *m = (lmb_material *)(uintptr_t)j->object.scene.materials;
    (void)model_make_glossy(&j->object);
    for (uint32_t i = 0; i < j->object.scene.material_count; ++i) {
        if (m[i].metal_map == 0 && fmaxf(m[i].specular[0], fmaxf(m[i].specular[1], m[i].specular[2])) <= MATT) {
            memset(m[i].specular, 0, sizeof m[i].specular);
        }
    }
}

int mix_lobes_sheen(lmb_material *m, const model *object, uint32_t i)
{
    const model_lobe *lobe = object->lobes != NULL ? &object->lobes[i] : NULL;
    if (lobe == NULL || m->metal_map != 0 || m->roughness > SMOOTH || m->specular[0] > 0.0f ||
        !(fmaxf(lobe->specular[0], fmaxf(lobe->specular[1], lobe->specular[2])) > 0.0f)) {
        return 0;
    }
    memcpy(m->specular, lobe->specular, sizeof m->specular);
    return 1;
}

int mix_lobes_take(mix_job *j, report *r)
{
    lmb_material *m;
    int any = 0;
    j->shiny = &j->scene;
    for (uint32_t i = 1; i < j->scene.material_count; ++i) {
        lmb_material one = j->scene.materials[i];
        any |= mix_lobes_sheen(&one, &j->object, i - 1);
    }
    if (!any) {
        return 1;
    }
    j->shiny = mix_copy_scene(&m, j, r);
    for (uint32_t i = 1; j->shiny != NULL && i < j->shiny->material_count; ++i) {
        mix_lobes_sheen(&m[i], &j->object, i - 1);
    }
    return j->shiny != NULL;
}

int mix_lobes_bounces(mix_job *j, report *r)
{
    lmb_material *m;
    lmb_scene *scene;
    j->bounces = &j->scene;
    if (!lmb_scene_is_glossy(&j->scene)) {
        return 1;
    }
    mix_mirror_planes(j);
    scene = mix_copy_scene(&m, j, r);
    for (uint32_t i = 0; scene != NULL && i < scene->material_count; ++i) {
        for (int c = 0; c < 3; ++c) {
            m[i].albedo[c] = fminf(m[i].albedo[c] + THROWN * m[i].specular[c], 1.0f);
        }
    }
    j->bounces = scene != NULL ? scene : j->bounces;
    return scene != NULL;
}

static void add_light(lmb_irradiance *inout, const mix_job *j, const lmb_view *view, const lmb_tile *object, int32_t i)
{
    if (i >= j->light_count - j->lamp_count) {
        mix_sources_tile(inout, j, object, i, 0);
    } else {
        lmb_direct_tile(inout, j->o.kernels, object, view, &j->scene, &j->lights[i], &j->maps[i][1]);
    }
}

/* Widening of lobes, so that samples of a guessed sun make one highlight and no dots: alpha2 of half vectors for the
 * part of the sun that a sample represents. */
static float sun_spread(const mix_job *j)
{
    const float reach = j->sun_size * 0.00872664626f;
    return reach * reach * (1.0f / MIX_SUN_SAMPLES);
}

static void widen(lmb_glossy *lobes, float by)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        lobes->alpha2[k] = fminf(lobes->alpha2[k] + by, 1.0f);
    }
}

/* Pixels with the lobe of a non-metal. */
static uint64_t plastics_of(const lmb_glossy *lobes)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float reflectance = fmaxf(lobes->specular[0][k], fmaxf(lobes->specular[1][k], lobes->specular[2][k]));
        out |= (uint64_t)((lobes->pixels >> k & 1) != 0 && reflectance <= MATT) << k;
    }
    return out;
}

/* The environment, with the object, in the mirrored direction of plastics. */
static void mirror_env(lmb_glossy *lobes, const mix_job *j, const lmb_tile *object, uint64_t pixels)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((pixels >> k & 1) == 0) {
            continue;
        }
        const lmb_vec3 n = {object->normal[0][k], object->normal[1][k], object->normal[2][k]};
        const float x = lobes->towards[0][k], y = lobes->towards[1][k], z = lobes->towards[2][k],
                    twice = 2.0f * (n.x * x + n.y * y + n.z * z);
        const lmb_vec3 to = {twice * n.x - x, twice * n.y - y, twice * n.z - z};
        const float alpha = sqrtf(lobes->alpha2[k]), dull = 1.0f - alpha,
                    edge = 1.0f - fminf(fmaxf(lobes->facing[k], RIM), 1.0f),
                    rise = dull * dull * dull * edge * edge * edge * edge * edge;
        float rgb[3];
        lmb_env_sample(rgb, &j->env[1], to, lmb_cone_tangent(sqrtf(alpha)));
        for (int c = 0; c < 3; ++c) {
            const float f = lobes->specular[c][k];
            lobes->rgb[c][k] += rgb[c] * (f + (1.0f - f) * rise);
        }
    }
}

void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object, int32_t sample, int32_t samples)
{
    const int is_glossy = lmb_glossy_tile(&out->lobes, object, view, j->shiny);
    out->plastic = is_glossy ? plastics_of(&out->lobes) : 0;
    const int32_t told = j->light_count - j->lamp_count,
                  parts = j->o.light_count == 0 && told == MIX_SUN_SAMPLES && samples > 1 ? PARTS : 1;
    for (int32_t i = 0; i < j->light_count; ++i) {
        if (i < told && i % parts != sample % parts) {
            continue;
        }
        memset(&out->one, 0, sizeof out->one);
        add_light(&out->one, j, view, object, i);
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            out->one.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] *= i < told ? (float)parts : 1.0f;
        }
        if (is_glossy) {
            float own[LMB_TILE_PIXELS];
            memcpy(own, out->lobes.alpha2, sizeof own);
            widen(&out->lobes, parts > 1 && i < told ? sun_spread(j) : 0.0f);
            lmb_glossy_direct(&out->lobes, j->o.kernels, object, &out->one, &j->lights[i]);
            memcpy(out->lobes.alpha2, own, sizeof own);
        }
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            inout->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] +=
                out->one.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
        }
    }
}

void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view, const lmb_tile *object)
{
    if (s->lobes.pixels != 0) {
        const uint64_t all = s->lobes.pixels;
        mirror_env(&s->lobes, j, object, s->plastic);
        s->lobes.pixels &= ~s->plastic;
        if (s->lobes.pixels != 0) {
            mix_mirror_tile(s->seen, &s->mirror, j, view, object, &s->lobes);
        }
        for (int32_t k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            const int32_t c = k / LMB_TILE_PIXELS, i = k % LMB_TILE_PIXELS;
            s->lobes.rgb[c][i] += (s->lobes.pixels >> i & 1u) != 0 ? s->seen[c][i] : 0.0f;
        }
        s->lobes.pixels = all;
        lmb_compose_glossy(inout, &s->lobes);
    }
    if (lmb_scene_emits(&j->scene)) {
        lmb_compose_emission(inout, &j->scene, view, object);
    }
}
