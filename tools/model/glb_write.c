/* glb_write.c: a scene with baked light -> GLB. */
#include "glb_write.h"

#include <stdlib.h>
#include <string.h>

#include "../picture/image.h"
#include "glb_parts.h"

/* --- textures ----------------------------------------------------------------------------------------------------- */

static void put_picture(glb_writer *w, text_buffer *images, const file_bytes *file, const char *name, int is_first)
{
    const size_t from = w->bytes.size;
    byte_put(&w->bytes, file->data, file->size);
    text_buffer_plain(images, is_first ? "{" : ",{");
    glb_put_name(images, name);
    text_buffer_add(images, "\"mimeType\":\"image/png\",\"bufferView\":%u}", (unsigned)glb_end_view(w, from, 0));
}

/* Writes the images of the scene, then the lightmap. */
static int put_pictures(glb_writer *w, text_buffer *images)
{
    for (uint32_t i = 0; i < w->scene->texture_count; ++i) {
        const lmb_texture *t = &w->scene->textures[i];
        file_bytes file;
        if (t->format != LMB_TEXELS_RGBA8) {
            return report_fail(w->r,
                               "textures in few colours cannot be written; bake from the file before it was packed");
        }
        if (!png_encode_alpha(&file, t->texels, t->width, t->height, w->r)) {
            return 0;
        }
        put_picture(w, images, &file, NULL, i == 0);
        file_free(&file);
    }
    if (w->light->picture != NULL) {
        put_picture(w, images, w->light->picture, MODEL_LIGHT_NAME, w->scene->texture_count == 0);
    }
    return 1;
}

static void put_textures(text_buffer *p, const lmb_scene *scene, const glb_light *light)
{
    static const int wraps[] = {10497, 33071, 33648}, filters[] = {9728, 9729, 9987};
    text_buffer_plain(p, ",\"samplers\":[");
    for (uint32_t i = 0; i < scene->texture_count; ++i) {
        const lmb_texture *t = &scene->textures[i];
        text_buffer_add(p, "%s{\"wrapS\":%d,\"wrapT\":%d,\"magFilter\":%d,\"minFilter\":%d}", i > 0 ? "," : "",
                        wraps[t->wrap_s], wraps[t->wrap_t], t->filter == LMB_NEAREST ? 9728 : 9729, filters[t->filter]);
    }
    const uint32_t count = scene->texture_count + (light->picture != NULL);
    if (light->picture != NULL) {
        text_buffer_add(p, "%s" GLB_LIGHT_SAMPLER, count > 1 ? "," : "");
    }
    text_buffer_plain(p, "],\"textures\":[");
    for (uint32_t i = 0; i < count; ++i) {
        text_buffer_add(p, "%s{\"source\":%u,\"sampler\":%u}", i > 0 ? "," : "", (unsigned)i, (unsigned)i);
    }
    text_buffer_plain(p, "]");
}

/* --- cameras ------------------------------------------------------------------------------------------------------ */

static void put_camera(text_buffer *p, const model_camera *c, int is_first)
{
    const double near_m = c->near_m > 0.0f ? (double)c->near_m : 0.01, far_m = (double)c->far_m;
    text_buffer_plain(p, is_first ? "{\"name\":" : ",{\"name\":");
    text_buffer_json(p, c->name);
    if (c->orthographic) {
        text_buffer_add(
            p,
            ",\"type\":\"orthographic\",\"orthographic\":{\"xmag\":%.9g,\"ymag\":%.9g,\"znear\":%.9g,\"zfar\":%.9g}}",
            (double)c->half_width, (double)c->half_height, near_m, far_m > near_m ? far_m : 1000.0 * near_m);
        return;
    }
    text_buffer_add(p, ",\"type\":\"perspective\",\"perspective\":{\"yfov\":%.9g,\"znear\":%.9g", (double)c->yfov_rad,
                    near_m);
    if (c->aspect > 0.0f) {
        text_buffer_add(p, ",\"aspectRatio\":%.9g", (double)c->aspect);
    }
    if (far_m > near_m) {
        text_buffer_add(p, ",\"zfar\":%.9g", far_m);
    }
    text_buffer_plain(p, "}}");
}

static void put_camera_node(text_buffer *p, const model_camera *c, uint32_t number)
{
    const lmb_vec3 axis[4] = {c->right, c->up, c->back, c->eye};
    text_buffer_plain(p, ",{\"name\":");
    text_buffer_json(p, c->name);
    text_buffer_add(p, ",\"camera\":%u,\"matrix\":[", (unsigned)number);
    for (int k = 0; k < 4; ++k) {
        text_buffer_add(p, "%s%.9g,%.9g,%.9g,%d", k > 0 ? "," : "", (double)axis[k].x, (double)axis[k].y,
                        (double)axis[k].z, k == 3);
    }
    text_buffer_plain(p, "]}");
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

static const char *material_name(const glb_writer *w, uint32_t material)
{
    return w->loaded->material_names != NULL ? w->loaded->material_names[material] : NULL;
}

static void put_object_node(glb_writer *w, uint32_t number)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const lmb_instance *own = &w->scene->instances[w->mesh[number].instance];
    text_buffer *p = &w->json;
    text_buffer_plain(p, ",{");
    glb_put_name(p, material_name(w, own->material)); /* formats without nodes have one object for each material */
    text_buffer_add(p, "\"mesh\":%u", (unsigned)number);
    if (memcmp(&own->to_world, &unit, sizeof unit) != 0) {
        for (int k = 0; k < 16; ++k) {
            text_buffer_add(p, "%s%.9g", k > 0 ? "," : ",\"matrix\":[", (double)own->to_world.m[k]);
        }
        text_buffer_plain(p, "]");
    }
    text_buffer_plain(p, "}");
}

static void put_nodes(glb_writer *w)
{
    text_buffer *p = &w->json;
    const uint32_t all = 1 + w->mesh_count + w->scene->light_count + w->loaded->camera_count;
    text_buffer_plain(p,
                      ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":\"lambent bake\",\"children\":[");
    for (uint32_t i = 1; i < all; ++i) {
        text_buffer_add(p, "%s%u", i > 1 ? "," : "", (unsigned)i);
    }
    text_buffer_plain(p, "]}");
    for (uint32_t i = 0; i < w->mesh_count; ++i) {
        put_object_node(w, i);
    }
    glb_put_light_nodes(p, w->scene);
    for (uint32_t i = 0; i < w->loaded->camera_count; ++i) {
        put_camera_node(p, &w->loaded->cameras[i], i);
    }
    text_buffer_plain(p, "]");
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

static void put_materials(glb_writer *w)
{
    char slot[GLB_SLOT];
    glb_light_slot(slot, w, w->scene->texture_count);
    text_buffer_plain(&w->json, ",\"materials\":[");
    for (uint32_t i = 0; i < w->scene->material_count; ++i) {
        glb_put_material(&w->json, &w->scene->materials[i], material_name(w, i),
                         w->light->picture != NULL ? slot : NULL, i == 0);
    }
    text_buffer_plain(&w->json, "]");
}

static void put_meshes(glb_writer *w)
{
    text_buffer *p = &w->json;
    text_buffer_plain(p, ",\"meshes\":[");
    for (uint32_t i = 0; i < w->mesh_count; ++i) {
        text_buffer_plain(p, i == 0 ? "{" : ",{");
        glb_put_name(p, material_name(w, w->scene->instances[w->mesh[i].instance].material));
        text_buffer_plain(p, "\"primitives\":[");
        glb_put_primitive(w, &w->mesh[i]);
        text_buffer_plain(p, "}]}");
    }
    text_buffer_plain(p, "]");
}

/* A scene without a source. */
static int put_scene(glb_writer *w)
{
    text_buffer *p = &w->json, images;
    memset(&images, 0, sizeof images);
    text_buffer_plain(p, "{\"asset\":{");
    glb_put_version(p);
    text_buffer_plain(p, ",\"extras\":{");
    glb_put_extras(w);
    text_buffer_plain(p, "}},\"extensionsUsed\":[\"KHR_materials_emissive_strength\",\"KHR_lights_punctual\"]");
    put_nodes(w);
    put_meshes(w);
    put_materials(w);
    if (w->loaded->camera_count > 0) {
        text_buffer_plain(p, ",\"cameras\":[");
        for (uint32_t i = 0; i < w->loaded->camera_count; ++i) {
            put_camera(p, &w->loaded->cameras[i], i == 0);
        }
        text_buffer_plain(p, "]");
    }
    if (w->scene->light_count > 0) {
        text_buffer_plain(p, ",\"extensions\":{");
        glb_put_lights(p, w->scene);
        text_buffer_plain(p, "}");
    }
    const int ok = put_pictures(w, &images);
    if (ok && w->scene->texture_count + (w->light->picture != NULL) > 0) {
        text_buffer_add(p, ",\"images\":[%s]", images.data != NULL ? images.data : "");
        put_textures(p, w->scene, w->light);
    }
    p->is_short |= images.is_short;
    text_buffer_free(&images);
    return ok;
}

static int put_all(glb_writer *w)
{
    text_buffer *p = &w->json;
    if (!(w->loaded->source != NULL ? glb_copy(w) : put_scene(w))) {
        return 0;
    }
    text_buffer_add(p, ",\"bufferViews\":[%s],\"accessors\":[%s],\"buffers\":[{\"byteLength\":%lu}]}",
                    w->views.data != NULL ? w->views.data : "", w->accessors.data != NULL ? w->accessors.data : "",
                    (unsigned long)w->bytes.size);
    return !(p->is_short || w->views.is_short || w->accessors.is_short || w->bytes.is_short) ||
           report_fail(w->r, "not enough memory for the scene with its light");
}

int glb_write(const char *path, const lmb_scene *scene, const model *loaded, const glb_mesh *mesh, uint32_t mesh_count,
              const glb_light *light, report *r)
{
    glb_writer w;
    byte_buffer file = {NULL, 0, 0, 0};
    memset(&w, 0, sizeof w);
    w.scene = scene;
    w.loaded = loaded;
    w.mesh = mesh;
    w.mesh_count = mesh_count;
    w.light = light;
    w.r = r;
    w.uv_sets = loaded->source != NULL ? loaded->source->uv_sets : 1;
    w.uv_sets = w.uv_sets == 0 && light->picture != NULL ? 1 : w.uv_sets; /* the second set requires a first */
    int ok = put_all(&w);
    if (ok) {
        while (w.json.size % 4 != 0) {
            text_buffer_plain(&w.json, " ");
        }
        const uint64_t all = 28 + (uint64_t)w.json.size + w.bytes.size;
        ok = all <= UINT32_MAX || report_fail(r, "%s: a GLB holds 4 GiB at peak", path);
        byte_put(&file, "glTF", 4);
        byte_put_int(&file, 2);
        byte_put_int(&file, (int32_t)(uint32_t)all);
        byte_put_int(&file, (int32_t)w.json.size);
        byte_put(&file, "JSON", 4);
        byte_put(&file, w.json.data, w.json.size);
        byte_put_int(&file, (int32_t)w.bytes.size);
        byte_put(&file, "BIN", 4);
        byte_put(&file, w.bytes.data, w.bytes.size);
        ok = ok && (!file.is_short || report_fail(r, "%s: not enough memory", path)) &&
             file_write(path, file.data, file.size, r);
    }
    text_buffer_free(&w.json);
    text_buffer_free(&w.views);
    text_buffer_free(&w.accessors);
    free(w.bytes.data);
    free(file.data);
    return ok;
}
