/* relight_many.c: several objects as one scene, each in place. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "relight_figures.h"

/* Allocates the arrays of all objects. */
static int take_arrays(figures *f, uint32_t objects)
{
    uint32_t meshes = 1, materials = 1, textures = 1, instances = 1;
    for (uint32_t i = 0; i < objects; ++i) {
        const lmb_scene *s = &f->object[i].scene;
        meshes += s->mesh_count;
        materials += s->material_count;
        textures += s->texture_count;
        instances += s->instance_count;
    }
    f->joined.meshes = malloc(meshes * sizeof *f->joined.meshes);
    f->joined.materials = malloc(materials * sizeof *f->joined.materials);
    f->joined.textures = malloc(textures * sizeof *f->joined.textures);
    f->joined.instances = malloc(instances * sizeof *f->joined.instances);
    f->joined.has_lobe = malloc(materials * sizeof *f->joined.has_lobe);
    return f->joined.meshes != NULL && f->joined.materials != NULL && f->joined.textures != NULL &&
           f->joined.instances != NULL && f->joined.has_lobe != NULL;
}

/* Appends one object's arrays, with the instances in place. */
static void join(figures *f, uint32_t i, float scale, lmb_vec3 at, int has_lobes)
{
    const lmb_scene *from = &f->object[i].scene;
    lmb_scene *to = &f->loaded.scene;
    lmb_vec3 low, high;
    lmb_scene_bounds(&low, &high, from);
    f->object_first[i] = to->instance_count;
    for (uint32_t k = 0; k < from->material_count; ++k) {
        lmb_material *m = &f->joined.materials[to->material_count + k];
        *m = from->materials[k];
        m->texture += m->texture >= 0 ? (int32_t)to->texture_count : 0;
        m->normal_map += to->texture_count;
        m->emission_map += m->emission_map > 0 ? to->texture_count : 0;
        m->metal_map += m->metal_map > 0 ? to->texture_count : 0;
        f->joined.has_lobe[to->material_count + k] = (uint8_t)has_lobes;
    }
    for (uint32_t k = 0; k < from->instance_count; ++k) {
        lmb_instance *in = &f->joined.instances[to->instance_count + k];
        *in = from->instances[k];
        figures_place(&in->to_world, &from->instances[k].to_world, low, high, scale, at);
        in->mesh += to->mesh_count;
        in->material += to->material_count;
        in->first_id = from->instances[k].first_id + lmb_scene_triangles(to);
    }
    if (from->mesh_count > 0) {
        memcpy(f->joined.meshes + to->mesh_count, from->meshes, from->mesh_count * sizeof *from->meshes);
    }
    if (from->texture_count > 0) {
        memcpy(f->joined.textures + to->texture_count, from->textures, from->texture_count * sizeof *from->textures);
    }
    to->meshes = f->joined.meshes;
    to->materials = f->joined.materials;
    to->textures = f->joined.textures;
    to->instances = f->joined.instances;
    to->mesh_count += from->mesh_count;
    to->material_count += from->material_count;
    to->texture_count += from->texture_count;
    to->instance_count += from->instance_count;
}

int figures_load_many(figures *f, const relight_options *o, report *r)
{
    uint64_t triangles = 0;
    for (int32_t i = 0; i < o->objects; ++i) {
        if (!figures_load_model(&f->object[i], o->object_of[i], o, r)) {
            return 0;
        }
        triangles += lmb_scene_triangles(&f->object[i].scene);
    }
    if (triangles > LMB_MAX_TRIANGLES) {
        return report_fail(r, "--object: too many triangles in all of them");
    }
    if (!take_arrays(f, (uint32_t)o->objects)) {
        return report_fail(r, "%s: out of memory", o->object);
    }
    for (int32_t i = 0; i < o->objects; ++i) {
        lmb_vec3 low, high;
        lmb_scene_bounds(&low, &high, &f->object[i].scene);
        const float longest = fmaxf(fmaxf(high.x - low.x, high.y - low.y), high.z - low.z),
                    wanted = o->scales > 1 ? o->scale_of[i] : o->scale_of[0],
                    scale = wanted > 0.0f ? wanted / longest : 1.0f;
        if (lmb_scene_triangles(&f->object[i].scene) == 0 || !(scale > 0.0f && scale < 1e6f)) {
            return report_fail(r, "%s: nothing to draw: no triangles, or no extent", o->object_of[i]);
        }
        join(f, (uint32_t)i, scale, o->at[i], model_make_glossy(&f->object[i]));
    }
    f->object_first[o->objects] = f->loaded.scene.instance_count;
    return 1;
}
