/* glb_write.c: a scene with baked light -> GLB. */
#include "glb_write.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_bytes.h"
#include "../picture/image.h"
#include "glb_parts.h"

enum { ARRAY_BUFFER = 34962, ELEMENT_BUFFER = 34963 };

/* --- bytes -------------------------------------------------------------------------------------------------------- */

uint32_t glb_end_view(glb_writer *w, size_t from, int target)
{
    static const uint8_t zeros[4] = {0, 0, 0, 0};
    text_buffer_add(&w->views, "%s{\"buffer\":0,\"byteOffset\":%lu,\"byteLength\":%lu", w->view_count > 0 ? "," : "",
                    (unsigned long)from, (unsigned long)(w->bytes.size - from));
    if (target != 0) {
        text_buffer_add(&w->views, ",\"target\":%d", target);
    }
    text_buffer_plain(&w->views, "}");
    byte_put(&w->bytes, zeros, (4 - w->bytes.size % 4) % 4);
    return w->view_count++;
}

static uint32_t end_accessor(glb_writer *w, size_t from, int target, uint32_t count, int component, const char *type,
                             const char *more)
{
    const uint32_t view = glb_end_view(w, from, target);
    text_buffer_add(&w->accessors, "%s{\"bufferView\":%u,\"count\":%u,\"componentType\":%d,\"type\":\"%s\"%s}",
                    w->accessor_count > 0 ? "," : "", (unsigned)view, (unsigned)count, component, type, more);
    return w->accessor_count++;
}

/* --- meshes ------------------------------------------------------------------------------------------------------- */

static uint32_t put_positions(glb_writer *w, const glb_mesh *m)
{
    const size_t from = w->bytes.size;
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    char range[256];
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        byte_put_floats(&w->bytes, m->vertex[i].position, 3);
        for (int c = 0; c < 3; ++c) {
            low[c] = fminf(low[c], m->vertex[i].position[c]);
            high[c] = fmaxf(high[c], m->vertex[i].position[c]);
        }
    }
    snprintf(range, sizeof range, ",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]", (double)low[0], (double)low[1],
             (double)low[2], (double)high[0], (double)high[1], (double)high[2]);
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5126, "VEC3", range);
}

static uint32_t put_floats(glb_writer *w, const glb_mesh *m, size_t at, size_t count, const char *type)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        float v[3];
        memcpy(v, (const char *)&m->vertex[i] + at, count * sizeof *v);
        byte_put_floats(&w->bytes, v, count);
    }
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5126, type, "");
}

static uint32_t put_colours(glb_writer *w, const glb_mesh *m)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        byte_put(&w->bytes, m->vertex[i].colour, 4);
    }
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5121, "VEC4", ",\"normalized\":true");
}

static uint32_t put_light(glb_writer *w, const glb_mesh *m)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        for (int c = 0; c < 4; ++c) {
            const uint8_t bytes[2] = {(uint8_t)m->vertex[i].light[c], (uint8_t)(m->vertex[i].light[c] >> 8)};
            byte_put(&w->bytes, bytes, 2);
        }
    }
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5123, "VEC4", ",\"normalized\":true");
}

static uint32_t put_indices(glb_writer *w, const glb_mesh *m)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->index_count; ++i) {
        byte_put_int(&w->bytes, (int32_t)m->index[i]);
    }
    return end_accessor(w, from, ELEMENT_BUFFER, m->index_count, 5125, "SCALAR", "");
}

static uint32_t put_tangents(glb_writer *w, const glb_mesh *m)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        byte_put_floats(&w->bytes, m->vertex[i].tangent, 4);
    }
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5126, "VEC4", "");
}

static int is_coloured(const glb_mesh *m)
{
    uint32_t i = 0;
    while (i < m->vertex_count && memcmp(m->vertex[i].colour, "\377\377\377\377", 4) == 0) {
        ++i;
    }
    return i < m->vertex_count;
}

/* Sets that the vertices have no room for are zeros, as glTF wants each set up to the last. */
static void put_sets(glb_writer *w, const glb_mesh *m)
{
    const size_t light_at = offsetof(glb_vertex, light_uv);
    const int has_light = w->light->picture != NULL;
    const uint32_t material = w->scene->instances[m->instance].material;
    const int is_bare = w->loaded->source == NULL && !has_light && w->scene->materials[material].texture < 0;
    for (uint32_t set = 0; !is_bare && set < w->uv_sets + (uint32_t)has_light; ++set) {
        const size_t own = offsetof(glb_vertex, uv) + sizeof m->vertex->uv[0] * (set < MODEL_UV_SETS ? set : 0);
        text_buffer_add(&w->json, ",\"TEXCOORD_%u\":%u", (unsigned)set,
                        (unsigned)put_floats(w, m, set == w->uv_sets ? light_at : own, 2, "VEC2"));
    }
}

void glb_put_primitive(glb_writer *w, const glb_mesh *m)
{
    text_buffer *p = &w->json;
    const lmb_instance *own = &w->scene->instances[m->instance];
    const model_source *source = w->loaded->source;
    text_buffer_add(p, "{\"attributes\":{\"POSITION\":%u", (unsigned)put_positions(w, m));
    text_buffer_add(p, ",\"NORMAL\":%u", (unsigned)put_floats(w, m, offsetof(glb_vertex, normal), 3, "VEC3"));
    if (source != NULL && source->tangent[own->mesh] != NULL) {
        text_buffer_add(p, ",\"TANGENT\":%u", (unsigned)put_tangents(w, m));
    }
    put_sets(w, m);
    if (is_coloured(m) || w->light->picture == NULL) {
        text_buffer_add(p, ",\"COLOR_0\":%u", (unsigned)put_colours(w, m));
    }
    if (w->light->picture == NULL) {
        text_buffer_add(p, ",\"COLOR_1\":%u", (unsigned)put_light(w, m));
    }
    text_buffer_add(p, "},\"indices\":%u,\"material\":%u", (unsigned)put_indices(w, m), (unsigned)own->material);
}

void glb_light_slot(char out[GLB_SLOT], const glb_writer *w, uint32_t texture)
{
    snprintf(out, GLB_SLOT, "\"index\":%u,\"texCoord\":%u", (unsigned)texture, (unsigned)w->uv_sets);
}

/* --- looks -------------------------------------------------------------------------------------------------------- */

static void put_name(text_buffer *p, const char *name)
{
    if (name != NULL && name[0] != '\0') {
        text_buffer_plain(p, "\"name\":");
        text_buffer_json(p, name);
        text_buffer_plain(p, ",");
    }
}

void glb_put_material(text_buffer *p, const lmb_material *m, const char *name, const char *light_slot, int is_first)
{
    text_buffer_plain(p, is_first ? "{" : ",{");
    put_name(p, name);
    text_buffer_add(p, "\"pbrMetallicRoughness\":{\"baseColorFactor\":[%.9g,%.9g,%.9g,%.9g],\"metallicFactor\":0",
                    (double)m->albedo[0], (double)m->albedo[1], (double)m->albedo[2], (double)m->alpha);
    if (m->texture >= 0) {
        text_buffer_add(p, ",\"baseColorTexture\":{\"index\":%d}", (int)m->texture);
    }
    text_buffer_plain(p, "}");
    if (m->flags & (LMB_ALPHA_MASK | LMB_ALPHA_BLEND)) {
        text_buffer_add(
            p, m->flags & LMB_ALPHA_BLEND ? ",\"alphaMode\":\"BLEND\"" : ",\"alphaMode\":\"MASK\",\"alphaCutoff\":%.9g",
            (double)m->alpha_cutoff);
    }
    const float peak = fmaxf(m->emission[0], fmaxf(m->emission[1], m->emission[2]));
    if (peak > 0.0f) {
        text_buffer_add(p,
                        ",\"emissiveFactor\":[%.9g,%.9g,%.9g],\"extensions\":{\"KHR_materials_emissive_strength\":"
                        "{\"emissiveStrength\":%.9g}}",
                        (double)(m->emission[0] / peak), (double)(m->emission[1] / peak),
                        (double)(m->emission[2] / peak), (double)peak);
        if (m->emission_map > 0) {
            text_buffer_add(p, ",\"emissiveTexture\":{\"index\":%u}", (unsigned)m->emission_map - 1);
        }
    }
    if (light_slot != NULL) { /* of strength 0: it changes no engine's picture, and no tool drops it */
        text_buffer_add(p, ",\"occlusionTexture\":{%s,\"strength\":0}", light_slot);
    }
    text_buffer_plain(p, "}");
}

static void put_picture(glb_writer *w, text_buffer *images, const file_bytes *file, const char *name, int is_first)
{
    const size_t from = w->bytes.size;
    byte_put(&w->bytes, file->data, file->size);
    text_buffer_plain(images, is_first ? "{" : ",{");
    put_name(images, name);
    text_buffer_add(images, "\"mimeType\":\"image/png\",\"bufferView\":%u}", (unsigned)glb_end_view(w, from, 0));
}

/* The scene's, then the picture of light. */
static int put_pictures(glb_writer *w, text_buffer *images)
{
    for (uint32_t i = 0; i < w->scene->texture_count; ++i) {
        const lmb_texture *t = &w->scene->textures[i];
        file_bytes file;
        if (t->format != LMB_TEXELS_RGBA8) {
            return report_fail(w->r, "textures in few colours cannot be written; bake from the file before it was packed");
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

/* --- lights and cameras ------------------------------------------------------------------------------------------- */

static void put_light_source(text_buffer *p, const lmb_light *l, int is_first)
{
    static const char *const kinds[] = {"point", "spot", "directional"};
    const float peak = fmaxf(fmaxf(l->intensity[0], fmaxf(l->intensity[1], l->intensity[2])), 1e-30f);
    text_buffer_add(p, "%s{\"type\":\"%s\",\"intensity\":%.9g,\"color\":[%.9g,%.9g,%.9g]", is_first ? "" : ",",
                    kinds[l->kind], (double)peak, (double)(l->intensity[0] / peak), (double)(l->intensity[1] / peak),
                    (double)(l->intensity[2] / peak));
    if (l->kind == LMB_LIGHT_SPOT) {
        const double outer = acos((double)l->cos_outer), inner = acos((double)l->cos_inner);
        text_buffer_add(p, ",\"spot\":{\"innerConeAngle\":%.9g,\"outerConeAngle\":%.9g}",
                        inner < outer ? inner : 0.999 * outer, outer);
    }
    text_buffer_plain(p, "}");
}

/* Turned so that -Z is its direction. */
static void put_light_node(text_buffer *p, const lmb_light *l, uint32_t number)
{
    const double d[3] = {(double)l->direction.x, (double)l->direction.y, (double)l->direction.z};
    double q[4] = {d[1], -d[0], 0.0, 1.0 - d[2]};
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[3] * q[3]);
    if (length > 1e-6) {
        for (int c = 0; c < 4; ++c) {
            q[c] /= length;
        }
    } else {
        q[0] = 1.0;
        q[1] = q[3] = 0.0;
    }
    text_buffer_add(p,
                    ",{\"translation\":[%.9g,%.9g,%.9g],\"rotation\":[%.9g,%.9g,%.9g,%.9g],\"extensions\":"
                    "{\"KHR_lights_punctual\":{\"light\":%u}}}",
                    (double)l->position.x, (double)l->position.y, (double)l->position.z, q[0], q[1], q[2], q[3],
                    (unsigned)number);
}

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

void glb_put_lights(text_buffer *p, const lmb_scene *scene)
{
    text_buffer_plain(p, "\"KHR_lights_punctual\":{\"lights\":[");
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        put_light_source(p, &scene->lights[i], i == 0);
    }
    text_buffer_plain(p, "]}");
}

void glb_put_light_nodes(text_buffer *p, const lmb_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; ++i) {
        put_light_node(p, &scene->lights[i], i);
    }
}

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
    put_name(p, material_name(w, own->material)); /* formats without nodes have an object a material */
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

void glb_put_version(text_buffer *p)
{
    text_buffer_add(p, "\"version\":\"2.0\",\"generator\":\"lambent %d.%d.%d\"", LMB_VERSION / 10000,
                    LMB_VERSION / 100 % 100, LMB_VERSION % 100);
}

void glb_put_extras(glb_writer *w)
{
    text_buffer_add(&w->json, "\"lambent\":{\"light\":\"%s\",\"scale\":%.9g,\"unit\":\"W/m2\"", w->light->form,
                    (double)w->light->scale);
    if (w->light->picture != NULL) {
        text_buffer_add(&w->json, ",\"texCoord\":%u", (unsigned)w->uv_sets);
    }
    text_buffer_plain(&w->json, "}");
}

static void put_materials(glb_writer *w)
{
    char slot[GLB_SLOT];
    glb_light_slot(slot, w, w->scene->texture_count);
    text_buffer_plain(&w->json, ",\"materials\":[");
    for (uint32_t i = 0; i < w->scene->material_count; ++i) {
        glb_put_material(&w->json, &w->scene->materials[i], material_name(w, i), w->light->picture != NULL ? slot : NULL,
                         i == 0);
    }
    text_buffer_plain(&w->json, "]");
}

static void put_meshes(glb_writer *w)
{
    text_buffer *p = &w->json;
    text_buffer_plain(p, ",\"meshes\":[");
    for (uint32_t i = 0; i < w->mesh_count; ++i) {
        text_buffer_plain(p, i == 0 ? "{" : ",{");
        put_name(p, material_name(w, w->scene->instances[w->mesh[i].instance].material));
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
    w.uv_sets = w.uv_sets == 0 && light->picture != NULL ? 1 : w.uv_sets; /* the second set wants a first */
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
