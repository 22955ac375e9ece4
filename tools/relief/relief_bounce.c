/* relief_bounce.c: bounced light between ordinary geometry and a relief's simple model. */
#include "relief_bounce.h"

#include <stdlib.h>
#include <string.h>

/* --- both in one scene -------------------------------------------------------------------------------------------- */

/* Skips empty arrays, which may be NULL. */
static void copy(void *to, const void *from, size_t bytes)
{
    if (bytes > 0) {
        memcpy(to, from, bytes);
    }
}

static void append(relief_bounce *b, const lmb_scene *s)
{
    const uint32_t mesh = b->scene.mesh_count, material = b->scene.material_count, first = b->scene.instance_count;
    const uint32_t next = 1 + (first > 0 ? lmb_scene_triangles(&b->scene) : 0);
    copy(b->meshes + mesh, s->meshes, s->mesh_count * sizeof *b->meshes);
    copy(b->materials + material, s->materials, s->material_count * sizeof *b->materials);
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        lmb_instance *to = &b->instances[first + i];
        *to = s->instances[i];
        to->mesh += mesh;
        to->material += material;
        to->first_id += next - 1;
    }
    b->scene.mesh_count += s->mesh_count;
    b->scene.material_count += s->material_count;
    b->scene.instance_count += s->instance_count;
}

/* Only the ordinary geometry has textures. */
static int join(relief_bounce *b, const lmb_scene *plain, const lmb_scene *simple, report *r)
{
    const lmb_scene none = {0}, *p = plain != NULL ? plain : &none, *s = simple != NULL ? simple : &none;
    b->meshes = calloc(p->mesh_count + s->mesh_count + 1, sizeof *b->meshes);
    b->materials = calloc(p->material_count + s->material_count + 1, sizeof *b->materials);
    b->instances = calloc(p->instance_count + s->instance_count + 1, sizeof *b->instances);
    if (b->meshes == NULL || b->materials == NULL || b->instances == NULL) {
        return report_fail(r, "not enough memory for bounced light");
    }
    b->scene.meshes = b->meshes;
    b->scene.materials = b->materials;
    b->scene.instances = b->instances;
    b->scene.textures = p->textures;
    b->scene.texture_count = p->texture_count;
    append(b, p);
    append(b, s);
    lmb_scene_bounds(&b->scene.bounds_min, &b->scene.bounds_max, &b->scene);
    const lmb_status status = lmb_scene_check(&b->scene);
    return status == LMB_OK || report_fail(r, "bounced light: %s", lmb_status_name(status));
}

/* --- first points ------------------------------------------------------------------------------------------------- */

static void *take(relief_bounce *b, int which, size_t bytes)
{
    return b->memory[which] = bytes > 0 ? malloc(bytes) : NULL;
}

static lmb_status make_bvh(lmb_bvh *out, relief_bounce *b, int which, const lmb_scene *scene)
{
    const uint32_t n = scene != NULL ? lmb_scene_triangles(scene) : 0;
    const size_t bytes = lmb_bvh_bytes(n);
    if (scene == NULL) {
        return LMB_OK;
    }
    if (take(b, which, bytes) == NULL) {
        return LMB_ERR_CAPACITY;
    }
    const lmb_status status = lmb_bvh_init(out, n, b->memory[which], bytes);
    return status != LMB_OK ? status : lmb_bvh_build(out, scene);
}

static lmb_status grow_tree(relief_bounce *b, const lmb_kernels *kernels, const lmb_light *light,
                            const lmb_shadow_map *map)
{
    lmb_status status = LMB_OK;
    for (int32_t f = 0; f < map->faces && status == LMB_OK; ++f) {
        if ((map->drawn >> f & 1u) != 0) {
            status = lmb_tree_texels(&b->tree, kernels, &b->tile, &b->scene, light, map, f, b->tree.faces, 0,
                                     map->size / LMB_TILE);
            status = status == LMB_OK ? lmb_tree_sum(&b->tree, b->tree.faces) : status;
            ++b->tree.faces;
        }
    }
    return status;
}

static lmb_status find_points(relief_bounce *b, const lmb_kernels *kernels, const lmb_light *light, int32_t size)
{
    const int32_t faces = lmb_shadow_map_faces(light, &b->scene);
    const size_t tree = lmb_tree_bytes((uint32_t)faces, size), bytes = lmb_shadow_map_bytes(faces, size, LMB_ID32);
    lmb_shadow_map map;
    if (take(b, 0, tree) == NULL || take(b, 1, bytes) == NULL) {
        return LMB_ERR_CAPACITY;
    }
    lmb_status status = lmb_tree_init(&b->tree, (uint32_t)faces, size, b->memory[0], tree);
    if (status == LMB_OK) {
        status = lmb_shadow_map_init(&map, light, &b->scene, size, LMB_ID32, b->memory[1], bytes);
    }
    if (status == LMB_OK) {
        lmb_shadow_map_clear(&map);
        status = lmb_shadow_map_draw(&map, kernels, &b->scene, 1, lmb_scene_triangles(&b->scene), NULL);
    }
    return status != LMB_OK ? status : grow_tree(b, kernels, light, &map);
}

int relief_bounce_make(relief_bounce *out, const lmb_kernels *kernels, const lmb_scene *plain, const lmb_scene *simple,
                       const lmb_light *light, int32_t size, report *r)
{
    memset(out, 0, sizeof *out);
    int ok = join(out, plain, simple, r);
    out->cut = ok && size > 0 ? calloc(1, sizeof *out->cut) : NULL;
    if (ok) {
        lmb_status status = size == 0          ? LMB_OK
                            : out->cut != NULL ? find_points(out, kernels, light, size)
                                               : LMB_ERR_CAPACITY;
        if (status == LMB_OK) {
            status = make_bvh(&out->plain, out, 2, plain);
        }
        if (status == LMB_OK) {
            status = make_bvh(&out->both, out, 3, &out->scene);
        }
        ok = status == LMB_OK || report_fail(r, "bounced light: %s", lmb_status_name(status));
    }
    if (!ok) {
        relief_bounce_free(out);
    }
    return ok;
}

void relief_bounce_free(relief_bounce *b)
{
    free(b->meshes);
    free(b->materials);
    free(b->instances);
    free(b->cut);
    for (int i = 0; i < 4; ++i) {
        free(b->memory[i]);
    }
    memset(b, 0, sizeof *b);
}

/* --- a tile ------------------------------------------------------------------------------------------------------- */

lmb_status relief_bounce_tile(lmb_irradiance *inout, relief_bounce *b, const lmb_kernels *kernels, const lmb_tile *tile,
                              uint64_t of_relief)
{
    lmb_cut_params how = {0};
    lmb_status status = LMB_OK;
    how.error = 0.02f;
    how.visibility = 0.015f;
    for (int relief = 0; relief < 2 && status == LMB_OK; ++relief) {
        b->tile = *tile;
        b->tile.hits = 0;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            b->tile.id[k] = (int)(of_relief >> k & 1u) == relief ? tile->id[k] : 0;
            b->tile.hits += b->tile.id[k] != 0;
        }
        how.bvh = relief ? &b->plain : &b->both;
        if (b->tile.hits > 0) {
            status = lmb_gather_cut(inout, kernels, b->cut, &b->tile, &b->tree, &how);
        }
    }
    return status;
}
