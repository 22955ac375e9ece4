/* mix_lobes.c: objects that reflect as metals do, by a narrow cone along the mirror direction in the field with them. [M20] */
#include "mix_lobes.h"
#include "mix_sources.h"

#include <math.h>
#include <string.h>

#define MATT 0.08f /* reflectance of what is no metal, at most */

/* --- metals ------------------------------------------------------------------------------------------------------- */

/* Of what is no metal the weak lobe stays out, as in `render` without --glossy: mix has one way to draw it. */
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

int mix_lobes_bounces(mix_job *j, report *r)
{
    lmb_material *m;
    lmb_scene *scene;
    j->bounces = &j->scene;
    if (!lmb_scene_is_glossy(&j->scene)) {
        return 1;
    }
    scene = mix_copy_scene(&m, j, r);
    for (uint32_t i = 0; scene != NULL && i < scene->material_count; ++i) {
        for (int c = 0; c < 3; ++c) {
            m[i].albedo[c] = fminf(m[i].albedo[c] + m[i].specular[c], 1.0f);
        }
    }
    j->bounces = scene != NULL ? scene : j->bounces;
    return scene != NULL;
}

static void add_light(lmb_irradiance *inout, const mix_job *j, const lmb_view *view, const lmb_tile *object, int32_t i)
{
    if (i >= j->light_count - j->lamp_count) {
        mix_sources_tile(inout, j, view, object, i, 0);
    } else {
        lmb_direct_tile(inout, j->o.kernels, object, view, &j->scene, &j->lights[i], &j->maps[i][1]);
    }
}

void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object)
{
    const int is_glossy = lmb_glossy_tile(&out->lobes, object, view, &j->scene);
    for (int32_t i = 0; i < j->light_count; ++i) {
        if (!is_glossy) {
            add_light(inout, j, view, object, i);
            continue;
        }
        memset(&out->one, 0, sizeof out->one);
        add_light(&out->one, j, view, object, i);
        lmb_glossy_direct(&out->lobes, j->o.kernels, object, &out->one, &j->lights[i]);
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            inout->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] += out->one.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
        }
    }
}

/* Of what comes from everywhere the lobe of pixel k reflects so much: lmb_compose_glossy takes as much from the rest. */
static float reflected(const lmb_glossy *lobes, int c, int k)
{
    const float low = fmaxf(1.0f - lobes->facing[k], 0.0f), smooth = fmaxf(1.0f - sqrtf(sqrtf(lobes->alpha2[k])), 0.0f),
                f0 = lobes->specular[c][k];
    return fminf(f0 + (1.0f - f0) * low * low * low * low * low * smooth * smooth * smooth, 1.0f);
}

/* The lobes of one roughness after the other, of those in `left`: most tiles have one. */
static uint64_t see_one(mix_lobes *s, const mix_job *j, const lmb_view *view, const lmb_tile *object, uint64_t left)
{
    const lmb_cone_trace trace = {j->o.kernels, &j->voxels, LMB_VOXEL_WITH, LMB_VOXEL_WITH, &j->env[1], j->scratch, 1};
    int first = 0;
    while ((left >> first & 1u) == 0) {
        ++first;
    }
    const float alpha2 = s->lobes.alpha2[first];
    if (lmb_cone_width_init(&s->width, &j->voxels, lmb_cone_tangent(sqrtf(sqrtf(alpha2)))) != LMB_OK ||
        lmb_cones_glossy(&s->seen, &trace, &s->width, object, view->eye) != LMB_OK) {
        return 0;
    }
    for (int k = first; k < LMB_TILE_PIXELS; ++k) {
        if ((left >> k & 1u) != 0 && fabsf(s->lobes.alpha2[k] - alpha2) <= 0.25f * alpha2) {
            for (int c = 0; c < 3; ++c) {
                s->lobes.rgb[c][k] += reflected(&s->lobes, c, k) * s->seen.rgb[c][k];
            }
            left &= ~((uint64_t)1 << k);
        }
    }
    return left;
}

void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view, const lmb_tile *object)
{
    for (uint64_t left = s->lobes.pixels; left != 0;) {
        left = see_one(s, j, view, object, left);
    }
    if (s->lobes.pixels != 0) {
        lmb_compose_glossy(inout, &s->lobes);
    }
    if (lmb_scene_emits(&j->scene)) {
        lmb_compose_emission(inout, &j->scene, view, object);
    }
}
