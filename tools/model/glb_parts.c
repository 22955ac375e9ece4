/* glb_parts.c: writes parts of a GLB: bytes, primitives, materials, lights and the asset object. */
#include "glb_parts.h"

#include <math.h>
#include <string.h>

#include "../common/io_bytes.h"

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

/* Writes 4 numbers a vertex as 16-bit codes. */
static uint32_t put_shorts(glb_writer *w, const glb_mesh *m, size_t at)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        uint16_t v[4];
        memcpy(v, (const char *)&m->vertex[i] + at, sizeof v);
        for (int c = 0; c < 4; ++c) {
            const uint8_t bytes[2] = {(uint8_t)v[c], (uint8_t)(v[c] >> 8)};
            byte_put(&w->bytes, bytes, 2);
        }
    }
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5123, "VEC4", ",\"normalized\":true");
}

/* Bytes if all colours are bytes. */
static uint32_t put_colours(glb_writer *w, const glb_mesh *m)
{
    const size_t from = w->bytes.size;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        const uint16_t *v = m->vertex[i].colour;
        if (v[0] % 257 || v[1] % 257 || v[2] % 257 || v[3] % 257) {
            return put_shorts(w, m, offsetof(glb_vertex, colour));
        }
    }
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        const uint16_t *v = m->vertex[i].colour;
        const uint8_t bytes[4] = {(uint8_t)v[0], (uint8_t)v[1], (uint8_t)v[2], (uint8_t)v[3]}; /* v is 257 x byte */
        byte_put(&w->bytes, bytes, 4);
    }
    return end_accessor(w, from, ARRAY_BUFFER, m->vertex_count, 5121, "VEC4", ",\"normalized\":true");
}

static uint32_t put_light(glb_writer *w, const glb_mesh *m) { return put_shorts(w, m, offsetof(glb_vertex, light)); }

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
    while (i < m->vertex_count && memcmp(m->vertex[i].colour, "\377\377\377\377\377\377\377\377", 8) == 0) {
        ++i;
    }
    return i < m->vertex_count;
}

/* glTF requires all texture coordinate sets up to the last one. Sets that do not fit into glb_vertex are zeros. */
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

void glb_put_name(text_buffer *p, const char *name)
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
    glb_put_name(p, name);
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
    if (light_slot != NULL) { /* strength 0: no engine renders it, and no tool drops it */
        text_buffer_add(p, ",\"occlusionTexture\":{%s,\"strength\":0}", light_slot);
    }
    text_buffer_plain(p, "}");
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

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
    if (l->range > 0.0f && l->kind != LMB_LIGHT_DIRECTIONAL) {
        text_buffer_add(p, ",\"range\":%.9g", (double)l->range);
    }
    text_buffer_plain(p, "}");
}

/* Turns the node so that -Z is the direction of the light. */
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

/* --- the asset ---------------------------------------------------------------------------------------------------- */

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
