/* relight_figures.c: copies of an object at several places, as a scene. */
#include "relight_figures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PLAIN_F0 0.04f       /* of glass, plastic, skin */
#define PLAIN_ROUGHNESS 0.4f /* default */

/* --- materials ---------------------------------------------------------------------------------------------------- */

static void set_lobe(lmb_material *m, const relight_options *o, int has_lobe)
{
    if (!has_lobe) {
        m->specular[0] = m->specular[1] = m->specular[2] = PLAIN_F0;
        m->roughness = PLAIN_ROUGHNESS;
    }
    if (o->f0 >= 0.0f) {
        m->specular[0] = m->specular[1] = m->specular[2] = o->f0;
    }
    m->roughness = o->roughness >= 0.0f ? o->roughness : m->roughness;
}

static uint16_t glossy_of(figures *f, float roughness)
{
    int32_t nearest = 0;
    for (int32_t i = 0; i < f->glossy_cubes; ++i) {
        nearest = fabsf(f->roughness[i] - roughness) < fabsf(f->roughness[nearest] - roughness) ? i : nearest;
    }
    if (f->glossy_cubes < RELIGHT_GLOSSY_CUBES && (f->glossy_cubes == 0 || f->roughness[nearest] != roughness)) {
        nearest = f->glossy_cubes++;
        f->roughness[nearest] = roughness;
    }
    return (uint16_t)nearest;
}

static int take_materials(figures *f, const relight_options *o, report *r)
{
    const lmb_scene *s = &f->loaded.scene;
    const int has_lobes = f->is_many || model_make_glossy(&f->loaded);
    f->materials = malloc((s->material_count > 0 ? s->material_count : 1) * sizeof *f->materials);
    f->glossy_of = malloc((s->instance_count > 0 ? s->instance_count : 1) * sizeof *f->glossy_of);
    if (f->materials == NULL || f->glossy_of == NULL) {
        return report_fail(r, "%s: out of memory", o->object);
    }
    memcpy(f->materials, s->materials, s->material_count * sizeof *f->materials);
    for (uint32_t i = 0; i < s->material_count; ++i) {
        set_lobe(&f->materials[i], o, f->is_many ? f->joined.has_lobe[i] : has_lobes);
    }
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        f->glossy_of[i] = glossy_of(f, f->materials[s->instances[i].material].roughness);
    }
    return 1;
}

/* --- places ------------------------------------------------------------------------------------------------------- */

void figures_stand(figures *f, uint32_t figure, lmb_vec3 at)
{
    for (uint32_t i = 0; i < f->parts; ++i) {
        lmb_instance *to = &f->instances[figure * f->parts + i];
        figures_place(&to->to_world, &f->loaded.scene.instances[i].to_world, f->low, f->high, f->scale, at);
        ++to->revision;
    }
}

lmb_vec3 figures_foot(const figures *f)
{
    return (lmb_vec3){0.5f * (f->low.x + f->high.x), f->low.y, 0.5f * (f->low.z + f->high.z)};
}

void figures_bounds(figures *f) { lmb_scene_bounds(&f->scene.bounds_min, &f->scene.bounds_max, &f->scene); }

uint32_t figures_owner(const figures *f, uint32_t instance)
{
    uint32_t object = 0;
    if (!f->is_many || f->owners > RELIGHT_OBJECTS || f->object_first[f->owners] != f->parts) {
        return f->owners == f->count ? instance / f->parts : instance;
    }
    while (f->object_first[object + 1] <= instance) {
        ++object;
    }
    return object;
}

/* The middle of the box of all instances of the owner. */
lmb_vec3 figures_middle(const figures *f, uint32_t owner)
{
    lmb_scene own = f->scene;
    lmb_vec3 low, high;
    uint32_t first = 0, end = 0;
    for (uint32_t i = 0; i < own.instance_count; ++i) {
        const int is_own = figures_owner(f, i) == owner;
        first = is_own && end == 0 ? i : first;
        end = is_own ? i + 1 : end;
    }
    own.instances = f->instances + first;
    own.instance_count = end - first;
    lmb_scene_bounds(&low, &high, &own);
    return (lmb_vec3){0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
}

uint32_t figures_owners_each(const figures *f) { return f->owners / f->count; }

lmb_vec3 figures_middle_at(figures *f, uint32_t i, lmb_vec3 at)
{
    figures_stand(f, 0, at);
    return figures_middle(f, i);
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

static int take_instances(figures *f, const relight_options *o, report *r)
{
    const lmb_scene *s = &f->loaded.scene;
    uint32_t id = 1;
    f->instances = malloc((size_t)f->count * f->parts * sizeof *f->instances);
    if (f->instances == NULL) {
        return report_fail(r, "%s: out of memory", o->object);
    }
    for (uint32_t i = 0; i < f->count * f->parts; ++i) {
        f->instances[i] = s->instances[i % f->parts];
        f->instances[i].first_id = id;
        id += s->meshes[f->instances[i].mesh].triangle_count;
    }
    return 1;
}

static float set_scale(const figures *f, float longest_m)
{
    const float x = f->high.x - f->low.x, y = f->high.y - f->low.y, z = f->high.z - f->low.z;
    return longest_m > 0.0f ? longest_m / fmaxf(fmaxf(x, y), z) : 1.0f;
}

int figures_load(figures *f, const relight_options *o, uint32_t count, report *r)
{
    memset(f, 0, sizeof *f);
    f->is_many = o->objects > 1;
    if (!(f->is_many ? figures_load_many(f, o, r) : figures_load_model(&f->loaded, o->object, o, r))) {
        return 0;
    }
    f->count = count;
    f->parts = f->loaded.scene.instance_count;
    f->owners = o->per_part ? count * f->parts : f->is_many ? (uint32_t)o->objects : count;
    lmb_scene_bounds(&f->low, &f->high, &f->loaded.scene);
    f->scale = f->is_many ? 1.0f : set_scale(f, o->scale_of[0]);
    if (lmb_scene_triangles(&f->loaded.scene) == 0 || !(f->scale > 0.0f && f->scale < 1e6f)) {
        return report_fail(r, "%s: nothing to draw: no triangles, or no extent", o->object);
    }
    if ((uint64_t)lmb_scene_triangles(&f->loaded.scene) * count > LMB_MAX_TRIANGLES ||
        (uint64_t)count * f->parts > 65536u) {
        return report_fail(r, "%s: too many triangles or parts for %u of it", o->object, (unsigned)count);
    }
    if (!take_materials(f, o, r) || !take_instances(f, o, r)) {
        return 0;
    }
    f->scene = f->loaded.scene;
    f->scene.instances = f->instances;
    f->scene.instance_count = count * f->parts;
    f->scene.materials = f->materials;
    f->scene.lights = o->lights;
    f->scene.light_count = (uint32_t)o->light_count;
    return 1;
}

void figures_free(figures *f)
{
    free(f->instances);
    free(f->materials);
    free(f->glossy_of);
    free(f->joined.meshes);
    free(f->joined.materials);
    free(f->joined.textures);
    free(f->joined.instances);
    free(f->joined.has_lobe);
    for (int i = 0; i < RELIGHT_OBJECTS; ++i) {
        model_free(&f->object[i]);
    }
    model_free(&f->loaded);
}
