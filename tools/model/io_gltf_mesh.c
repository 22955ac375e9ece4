/* io_gltf_mesh.c: turns glTF primitives into lambent meshes: streams converted once, strips and fans unrolled. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

int gltf_attribute(gltf_accessor *a, uint32_t *index, gltf *g, uint32_t reference, uint32_t components, uint32_t other,
                   uint32_t count)
{
    if (!gltf_index(index, g, &g->accessors, reference))
        return 0;
    if (*index == JSON_NONE)
        return 1;
    if (!gltf_accessor_open(a, g, g->accessors.items[*index]))
        return 0;
    if ((a->components != components && a->components != other) || a->component == GLTF_U32)
        return json_fail(&g->doc, reference, g->b->r, "accessor %u has a type that this attribute does not take",
                         (unsigned)*index);
    if (count && a->count != count)
        return json_fail(&g->doc, reference, g->b->r, "%u elements, but POSITION has %u; all must have as many",
                         (unsigned)a->count, (unsigned)count);
    return 1;
}

float *gltf_floats(gltf *g, const gltf_accessor *a)
{
    float *values = (float *)build_scratch(g->b, (uint64_t)a->count * a->components, sizeof *values);
    return values && gltf_accessor_floats(values, g, a) ? values : NULL;
}

static int read_positions(lmb_mesh *out, gltf *g, uint32_t reference)
{
    gltf_accessor a;
    uint32_t index;
    float *values;
    if (!gltf_attribute(&a, &index, g, reference, 3, 3, 0))
        return 0;
    if (!g->positions[index]) {
        values = (float *)build_keep(g->b, (uint64_t)a.count * 3, sizeof *values);
        if (!values || !gltf_accessor_floats(values, g, &a))
            return 0;
        g->positions[index] = values;
    }
    out->positions = g->positions[index];
    out->position_format = LMB_POSITION_F32;
    out->vertex_count = a.count;
    return 1;
}

/* Normalizes vectors and encodes them as octahedral codes. Vectors of four numbers keep the sign of the fourth. Normals
 * without length are marked for mend_normals. Returns NULL with the report set on failure. */
static int16_t *encode_vectors(gltf *g, const gltf_accessor *a)
{
    const float *values = gltf_floats(g, a);
    int16_t *codes = (int16_t *)build_keep(g->b, (uint64_t)a->count * 2, sizeof *codes);
    uint32_t i, zeros = 0;
    for (i = 0; values && codes && i < a->count; ++i) {
        const float *v = values + (size_t)i * a->components;
        const double wide[3] = {(double)v[0], (double)v[1], (double)v[2]};
        if (a->components == 3) {
            build_normal_code(g->b, codes + 2 * (size_t)i, wide);
        } else {
            lmb_octahedral_encode(codes + 2 * (size_t)i, build_normal(wide, &zeros));
            model_set_side(codes + 2 * (size_t)i, v[3] < 0.0f);
        }
    }
    return values ? codes : NULL;
}

static int read_normals(lmb_mesh *out, gltf *g, uint32_t reference)
{
    gltf_accessor a;
    uint32_t index;
    if (!gltf_attribute(&a, &index, g, reference, 3, 3, out->vertex_count))
        return 0;
    if (index == JSON_NONE)
        return 1;
    if (!g->normals[index])
        g->normals[index] = encode_vectors(g, &a);
    out->normals = g->normals[index];
    return out->normals != NULL;
}

/* Reads tangents only if the material has a normal map. Tangents without normals are ignored (glTF 2.0, 3.7.2.1). */
static int read_tangents(lmb_mesh *out, gltf *g, uint32_t reference, uint32_t material)
{
    gltf_accessor a;
    uint32_t index;
    if (g->b->materials[material].normal_scale == 0.0f || !out->normals)
        return 1;
    if (!gltf_attribute(&a, &index, g, reference, 4, 4, out->vertex_count))
        return 0;
    if (index == JSON_NONE)
        return 1;
    if (!g->tangents[index])
        g->tangents[index] = encode_vectors(g, &a);
    out->tangents = g->tangents[index];
    out->tangent_format = LMB_TANGENT_SIDED;
    return out->tangents != NULL;
}

static void move_uvs(float *uv, uint32_t count, const gltf_uv *how)
{
    uint32_t i;
    for (i = 0; i < count; ++i, uv += 2) {
        const double u = (double)uv[0], v = (double)uv[1], *m = how->m;
        uv[0] = how->moved ? build_uv(m[0] * u + m[1] * v + m[2]) : build_uv(u);
        uv[1] = how->moved ? build_uv(m[3] * u + m[4] * v + m[5]) : build_uv(v);
    }
}

/* Reads the set that the material's texture uses. Primitives share a stream if their materials transform it alike. */
static int read_uvs(lmb_mesh *out, gltf *g, uint32_t attributes, uint32_t material)
{
    const gltf_uv *how = &g->material_uv[material];
    const gltf_uv *owner;
    char key[32];
    gltf_accessor a;
    uint32_t index, reference;
    float *values;
    if (how->set == JSON_NONE)
        return 1;
    snprintf(key, sizeof key, "TEXCOORD_%u", (unsigned)how->set);
    reference = json_member(&g->doc, attributes, key);
    if (!gltf_attribute(&a, &index, g, reference, 2, 2, out->vertex_count))
        return 0;
    if (index == JSON_NONE) {
        ++g->left_out.without_uvs;
        return 1;
    }
    owner = g->uvs[index] ? &g->material_uv[g->uv_owner[index]] : NULL;
    if (!owner || owner->moved != how->moved || (how->moved && memcmp(owner->m, how->m, sizeof how->m) != 0)) {
        values = (float *)build_keep(g->b, (uint64_t)a.count * 2, sizeof *values);
        if (!values || !gltf_accessor_floats(values, g, &a))
            return 0;
        move_uvs(values, a.count, how);
        g->uvs[index] = values;
        g->uv_owner[index] = material;
    }
    out->uvs = g->uvs[index];
    out->uv_format = LMB_UV_F32;
    return 1;
}

static int read_colours(lmb_mesh *out, gltf *g, uint32_t reference)
{
    gltf_accessor a;
    uint32_t index, i, c;
    float *values;
    uint16_t *codes;
    if (!gltf_attribute(&a, &index, g, reference, 3, 4, out->vertex_count))
        return 0;
    if (index == JSON_NONE)
        return 1;
    if (!g->colours[index]) {
        values = gltf_floats(g, &a);
        codes = (uint16_t *)build_keep(g->b, a.count, 4 * sizeof *codes);
        if (!values || !codes)
            return 0;
        for (i = 0; i < a.count; ++i)
            for (c = 0; c < 4; ++c) {
                const double v = c < a.components ? (double)values[(size_t)i * a.components + c] : 1;
                codes[4 * (size_t)i + c] = c < 3 ? build_linear(v) : build_share(v);
            }
        g->colour_formats[index] = build_narrow(codes, a.count);
        g->colours[index] = (const uint8_t *)codes;
    }
    out->colours = g->colours[index];
    out->colour_format = g->colour_formats[index];
    return 1;
}

/* Corner k of triangle t of a strip or fan: index in the order of vertices (glTF 2.0, 3.7.2.1). */
static uint32_t unrolled(uint32_t mode, uint32_t t, uint32_t k)
{
    if (mode == MODE_TRIANGLES)
        return 3 * t + k;
    if (mode == MODE_FAN)
        return k == 2 ? 0 : t + 1 + k;
    return k == 0 ? t : k == 1 ? t + 1 + t % 2 : t + 2 - t % 2;
}

/* Stores the vertices of corners: `order` maps an index to a vertex (NULL: the index itself). */
static int store_indices(lmb_mesh *out, gltf *g, uint32_t mode, const uint32_t *order)
{
    const int small = out->vertex_count <= 65536;
    const uint64_t corners = (uint64_t)out->triangle_count * 3;
    void *indices = build_keep(g->b, corners, small ? 2 : 4);
    uint32_t t, k;
    if (!indices)
        return 0;
    for (t = 0; t < out->triangle_count; ++t)
        for (k = 0; k < 3; ++k) {
            const uint32_t place = unrolled(mode, t, k), vertex = order ? order[place] : place;
            if (small)
                ((uint16_t *)indices)[3 * (size_t)t + k] = (uint16_t)vertex;
            else
                ((uint32_t *)indices)[3 * (size_t)t + k] = vertex;
        }
    out->indices = indices;
    out->index_format = small ? LMB_INDEX_U16 : LMB_INDEX_U32;
    return 1;
}

/* Reads the vertex numbers of an accessor, each under vertex_count; *count of them. NULL with the report set. */
static uint32_t *read_order(uint32_t *count, const lmb_mesh *mesh, gltf *g, uint32_t accessor)
{
    gltf_accessor a;
    uint32_t *order, i;
    if (!gltf_accessor_open(&a, g, accessor))
        return NULL;
    order = (uint32_t *)build_scratch(g->b, a.count, sizeof *order);
    if (!order || !gltf_accessor_indices(order, g, &a))
        return NULL;
    for (i = 0; i < a.count; ++i)
        if (order[i] >= mesh->vertex_count) {
            json_fail(&g->doc, accessor, g->b->r, "index %u at entry %u, but there are %u vertices; export again",
                      (unsigned)order[i], (unsigned)i, (unsigned)mesh->vertex_count);
            return NULL;
        }
    *count = a.count;
    return order;
}

static int read_triangles(lmb_mesh *out, gltf *g, uint32_t primitive, uint32_t mode)
{
    uint32_t accessor, places = out->vertex_count, *order = NULL;
    if (!gltf_item(&accessor, g, &g->accessors, json_member(&g->doc, primitive, "indices")))
        return 0;
    if (accessor != JSON_NONE) {
        order = read_order(&places, out, g, accessor);
        if (!order)
            return 0;
    }
    g->left_out.ragged += mode == MODE_TRIANGLES ? places % 3 != 0 : places < 3;
    out->triangle_count = mode == MODE_TRIANGLES ? places / 3 : places < 3 ? 0 : places - 2;
    if (out->triangle_count > LMB_MAX_TRIANGLES)
        return json_fail(&g->doc, primitive, g->b->r, "more than %u triangles", (unsigned)LMB_MAX_TRIANGLES);
    if (!order && mode == MODE_TRIANGLES) {
        out->index_format = LMB_INDEX_NONE;
        return 1;
    }
    return store_indices(out, g, mode, order);
}

static int primitive_material(uint32_t *out, gltf *g, uint32_t primitive)
{
    if (!gltf_index(out, g, &g->materials, json_member(&g->doc, primitive, "material")))
        return 0;
    if (*out != JSON_NONE)
        return 1;
    gltf_default_material(g);
    *out = g->default_material;
    ++g->left_out.bare;
    return 1;
}

/* Geometry that only a Draco decoder can read has accessors without bytes, which would count as zeros. */
static int refuse_draco(gltf *g, uint32_t primitive, uint32_t position)
{
    const uint32_t draco =
        json_member(&g->doc, json_member(&g->doc, primitive, "extensions"), "KHR_draco_mesh_compression");
    uint32_t accessor;
    if (!gltf_item(&accessor, g, &g->accessors, position))
        return 0;
    if (draco == JSON_NONE || json_member(&g->doc, accessor, "bufferView") != JSON_NONE)
        return 1;
    return json_fail(&g->doc, draco, g->b->r, "Draco geometry without a plain copy; %s", GLTF_UNDO_DRACO);
}

/* Reads `keeps` components per vertex; *out is NULL if there is no such attribute. */
static int read_baked_values(float **out, gltf *g, uint32_t reference, uint32_t keeps, uint32_t vertices)
{
    gltf_accessor a;
    uint32_t index;
    *out = NULL;
    if (!gltf_attribute(&a, &index, g, reference, keeps, keeps == 3 ? 4 : keeps, vertices)) {
        return 0;
    }
    if (index == JSON_NONE) {
        return 1;
    }
    float *all = gltf_floats(g, &a);
    *out = build_keep(g->b, (uint64_t)a.count * keeps, sizeof **out);
    if (all == NULL || *out == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < a.count; ++i) {
        for (uint32_t c = 0; c < keeps; ++c) {
            (*out)[keeps * (size_t)i + c] = all[a.components * (size_t)i + c];
        }
    }
    return 1;
}

/* Reads the light of the next mesh from a file that `lambent bake --to` wrote: COLOR_1, or lightmap coordinates. */
static int read_baked(gltf *g, const lmb_mesh *m, uint32_t attributes, uint32_t material)
{
    model_light *l = &g->b->out->light;
    const uint32_t mesh = g->b->mesh_count;
    char key[32];
    if (!(l->scale > 0.0f)) {
        return 1;
    }
    const gltf_uv *how = &g->light_uv[material < g->materials.count ? material : g->materials.count];
    snprintf(key, sizeof key, "TEXCOORD_%u", (unsigned)how->set);
    if (!read_baked_values(&l->colour[mesh], g, json_member(&g->doc, attributes, "COLOR_1"), 3, m->vertex_count) ||
        !read_baked_values(&l->uv[mesh], g, json_member(&g->doc, attributes, key), 2, m->vertex_count)) {
        return 0;
    }
    if (l->uv[mesh] != NULL) {
        move_uvs(l->uv[mesh], m->vertex_count, how);
    }
    return 1;
}

/* Reads a primitive into the next free mesh; none for points, lines and primitives without triangles. */
static int read_primitive(gltf *g, uint32_t primitive)
{
    lmb_mesh *out = &g->b->meshes[g->b->mesh_count];
    const uint32_t attributes = json_member(&g->doc, primitive, "attributes"),
                   position = json_member(&g->doc, attributes, "POSITION");
    uint32_t mode = MODE_TRIANGLES, material;
    if (!json_read_uint(&mode, &g->doc, json_member(&g->doc, primitive, "mode"), g->b->r))
        return 0;
    if (mode > MODE_FAN)
        return json_fail(&g->doc, primitive, g->b->r, "mode %u; glTF has 0 to 6", (unsigned)mode);
    if (mode < MODE_TRIANGLES || position == JSON_NONE) {
        ++*(mode < MODE_TRIANGLES ? &g->left_out.points_lines : &g->left_out.without_positions);
        return 1;
    }
    memset(out, 0, sizeof *out);
    if (!refuse_draco(g, primitive, position) || !primitive_material(&material, g, primitive) ||
        !read_positions(out, g, position) || !read_triangles(out, g, primitive, mode) ||
        !read_normals(out, g, json_member(&g->doc, attributes, "NORMAL")) || !read_uvs(out, g, attributes, material) ||
        !read_tangents(out, g, json_member(&g->doc, attributes, "TANGENT"), material) ||
        !read_colours(out, g, json_member(&g->doc, attributes, "COLOR_0")) ||
        !read_baked(g, out, attributes, material))
        return 0;
    if (out->triangle_count == 0)
        return 1;
    g->mesh_rest[g->b->mesh_count] = *out;
    g->mesh_primitive[g->b->mesh_count] = primitive;
    g->mesh_material[g->b->mesh_count++] = material;
    return 1;
}

int gltf_mesh(gltf *g, uint32_t mesh)
{
    const uint32_t node = g->meshes.items[mesh];
    gltf_list primitives;
    uint32_t i;
    if (g->mesh_first[mesh] != JSON_NONE)
        return 1;
    if (!gltf_list_of(&primitives, g, json_member(&g->doc, node, "primitives")))
        return 0;
    g->mesh_first[mesh] = g->b->mesh_count;
    for (i = 0; i < primitives.count; ++i)
        if (!read_primitive(g, primitives.items[i]))
            return 0;
    g->mesh_size[mesh] = g->b->mesh_count - g->mesh_first[mesh];
    return 1;
}
