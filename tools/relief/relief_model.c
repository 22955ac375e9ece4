/* relief_model.c: a scene flattened to one mesh in world space, as input for reliefs. */
#include "relief_model.h"

#include <lambent/lookup.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

/* --- flattening --------------------------------------------------------------------------------------------------- */

static int take(triangle_mesh *m, uint32_t vertices, uint32_t triangles, report *r)
{
    const size_t n = vertices > 0 ? vertices : 1, t = triangles > 0 ? triangles : 1;
    memset(m, 0, sizeof *m);
    m->positions = malloc(3 * n * sizeof(float));
    m->normals = malloc(3 * n * sizeof(float));
    m->colours = malloc(3 * n * sizeof(float));
    m->indices = malloc(3 * t * sizeof(uint32_t));
    m->vertex_count = vertices;
    m->triangle_count = triangles;
    if (m->positions == NULL || m->normals == NULL || m->colours == NULL || m->indices == NULL) {
        triangle_mesh_free(m);
        return report_fail(r, "not enough memory for %u triangles", (unsigned)triangles);
    }
    return 1;
}

static void put(float *at, lmb_vec3 v)
{
    at[0] = v.x;
    at[1] = v.y;
    at[2] = v.z;
}

static lmb_vec3 get(const float *at) { return vec3(at[0], at[1], at[2]); }

static lmb_vec3 in_world(const lmb_mat4 *t, lmb_vec3 p)
{
    const float *m = t->m;
    return vec3(m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]);
}

/* Reflectance at a vertex: material x texture x vertex colour. */
static void vertex_albedo(float out[3], const lmb_scene *scene, const lmb_instance *of, const lmb_vertex *v)
{
    const lmb_material *material = &scene->materials[of->material];
    float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    if (material->texture >= 0) {
        lmb_texture_sample(texel, &scene->textures[material->texture], v->uv[0], v->uv[1], 0.0f);
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = material->albedo[c] * v->colour[c] * texel[c];
    }
}

static void add_instance(triangle_mesh *out, uint32_t *vertex, uint32_t *triangle, const lmb_scene *scene,
                         const lmb_instance *of)
{
    const lmb_mesh *mesh = &scene->meshes[of->mesh];
    const float *m = of->to_world.m;
    const lmb_vec3 x = vec3(m[0], m[1], m[2]), y = vec3(m[4], m[5], m[6]), z = vec3(m[8], m[9], m[10]);
    const float side = is_mirrored(&of->to_world) ? -1.0f : 1.0f;
    const lmb_vec3 cofactor[3] = {cross3(y, z), cross3(z, x), cross3(x, y)};
    for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
        const size_t at = 3 * (size_t)(*vertex + v);
        lmb_vertex own;
        lmb_mesh_vertex(&own, mesh, v);
        put(out->positions + at, in_world(&of->to_world, own.position));
        vertex_albedo(out->colours + at, scene, of, &own);
        if (mesh->normals != NULL) {
            const lmb_vec3 n = own.normal;
            put(out->normals + at, normalize3(mul3(add3(add3(mul3(cofactor[0], n.x), mul3(cofactor[1], n.y)),
                                                        mul3(cofactor[2], n.z)), side)));
        }
    }
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        const uint32_t corner[3] = {lmb_mesh_index(mesh, 3 * t), lmb_mesh_index(mesh, 3 * t + 1),
                                    lmb_mesh_index(mesh, 3 * t + 2)};
        if (corner[0] < mesh->vertex_count && corner[1] < mesh->vertex_count && corner[2] < mesh->vertex_count) {
            uint32_t *to = out->indices + 3 * (size_t)(*triangle)++;
            to[0] = *vertex + corner[0];
            to[1] = *vertex + corner[side < 0.0f ? 2 : 1];
            to[2] = *vertex + corner[side < 0.0f ? 1 : 2];
        }
    }
    *vertex += mesh->vertex_count;
}

/* --- smooth normals ----------------------------------------------------------------------------------------------- */

/* Finds the slot that vertices at one position share. The table is at least twice as large as the number of
 * vertices. */
static uint32_t slot_of(const triangle_mesh *m, uint32_t *slots, uint32_t mask, uint32_t v)
{
    uint32_t bits[3], at;
    lmb_vec3 p = get(m->positions + 3 * (size_t)v);
    p = add3(p, vec3(0.0f, 0.0f, 0.0f)); /* -0 becomes 0 */
    memcpy(bits, &p, sizeof bits);
    if (!is_place(p)) {
        return v; /* not equal to anything */
    }
    at = bits[0] * 0x9E3779B1u ^ bits[1] * 0x85EBCA77u ^ bits[2] * 0xC2B2AE3Du;
    at = (at ^ at >> 16) * 0x85EBCA6Bu; /* floats of whole numbers differ only in the upper bits */
    at = (at ^ at >> 13) & mask;
    for (;; at = (at + 1) & mask) {
        if (slots[at] == UINT32_MAX) {
            slots[at] = v;
        }
        const lmb_vec3 q = get(m->positions + 3 * (size_t)slots[at]);
        if (q.x == p.x && q.y == p.y && q.z == p.z) {
            return slots[at];
        }
    }
}

static void sum_normals(triangle_mesh *m, uint32_t *slots, uint32_t mask)
{
    memset(m->normals, 0, 3 * (size_t)m->vertex_count * sizeof(float));
    for (uint32_t t = 0; t < m->triangle_count; ++t) {
        const uint32_t *i = m->indices + 3 * (size_t)t;
        const lmb_vec3 a = get(m->positions + 3 * (size_t)i[0]), b = get(m->positions + 3 * (size_t)i[1]),
                       c = get(m->positions + 3 * (size_t)i[2]), n = cross3(sub3(b, a), sub3(c, a));
        for (int k = 0; k < 3; ++k) {
            float *to = m->normals + 3 * (size_t)slot_of(m, slots, mask, i[k]);
            put(to, add3(get(to), n));
        }
    }
    for (uint32_t v = m->vertex_count; v-- > 0;) {
        put(m->normals + 3 * (size_t)v, get(m->normals + 3 * (size_t)slot_of(m, slots, mask, v)));
    }
    for (uint32_t v = 0; v < m->vertex_count; ++v) {
        const lmb_vec3 n = get(m->normals + 3 * (size_t)v);
        const float length = length3(n);
        put(m->normals + 3 * (size_t)v, length > 0.0f ? mul3(n, 1.0f / length) : vec3(0.0f, 1.0f, 0.0f));
    }
}

static int smooth(triangle_mesh *m, report *r)
{
    uint32_t size = 16;
    while (size / 2 < m->vertex_count) {
        size *= 2;
    }
    uint32_t *slots = malloc((size_t)size * sizeof *slots);
    if (slots == NULL) {
        return report_fail(r, "not enough memory for normals");
    }
    memset(slots, 0xff, (size_t)size * sizeof *slots);
    sum_normals(m, slots, size - 1);
    free(slots);
    return 1;
}

int relief_flatten(triangle_mesh *out, const lmb_scene *scene, report *r)
{
    uint64_t vertices = 0, triangles = lmb_scene_triangles(scene);
    uint32_t vertex = 0, triangle = 0;
    int has_normals = 1;
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        const lmb_mesh *m = &scene->meshes[scene->instances[i].mesh];
        vertices += m->vertex_count;
        has_normals &= m->normals != NULL;
    }
    if (vertices > 0x10000000u) {
        return report_fail(r, "%.0f vertices are too many", (double)vertices);
    }
    if (!take(out, (uint32_t)vertices, (uint32_t)triangles, r)) {
        return 0;
    }
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        add_instance(out, &vertex, &triangle, scene, &scene->instances[i]);
    }
    out->triangle_count = triangle;
    if (!has_normals && !smooth(out, r)) {
        triangle_mesh_free(out);
        return 0;
    }
    return 1;
}

/* --- drawing ------------------------------------------------------------------------------------------------------ */

static uint8_t linear_byte(float v)
{
    return (uint8_t)(clampf(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

static void point_scene(relief_scene *s, const triangle_mesh *m)
{
    s->mesh.positions = m->positions;
    s->mesh.normals = s->normals;
    s->mesh.colours = s->colours;
    s->mesh.indices = m->indices;
    s->mesh.index_format = LMB_INDEX_U32;
    s->mesh.vertex_count = m->vertex_count;
    s->mesh.triangle_count = m->triangle_count;
    s->material.albedo[0] = s->material.albedo[1] = s->material.albedo[2] = s->material.alpha = 1.0f;
    s->material.texture = -1;
    s->material.roughness = 1.0f;
    for (int i = 0; i < 4; ++i) {
        s->instance.to_world.m[5 * i] = 1.0f;
    }
    s->instance.first_id = 1;
    s->scene.meshes = &s->mesh;
    s->scene.materials = &s->material;
    s->scene.instances = &s->instance;
    s->scene.mesh_count = s->scene.material_count = s->scene.instance_count = 1;
    lmb_scene_bounds(&s->scene.bounds_min, &s->scene.bounds_max, &s->scene);
}

int relief_scene_of(relief_scene *out, const triangle_mesh *mesh, report *r)
{
    const size_t n = mesh->vertex_count > 0 ? mesh->vertex_count : 1;
    memset(out, 0, sizeof *out);
    out->normals = malloc(n * 2 * sizeof(int16_t));
    out->colours = malloc(n * 4);
    if (out->normals == NULL || out->colours == NULL) {
        relief_scene_free(out);
        return report_fail(r, "not enough memory for a mesh of %u vertices", (unsigned)mesh->vertex_count);
    }
    for (size_t v = 0; v < mesh->vertex_count; ++v) {
        lmb_octahedral_encode(out->normals + 2 * v, get(mesh->normals + 3 * v));
        for (size_t c = 0; c < 3; ++c) {
            out->colours[4 * v + c] = mesh->colours != NULL ? linear_byte(mesh->colours[3 * v + c]) : 255;
        }
        out->colours[4 * v + 3] = 255;
    }
    point_scene(out, mesh);
    return lmb_scene_check(&out->scene) == LMB_OK || report_fail(r, "a mesh that cannot be drawn");
}

void relief_scene_free(relief_scene *s)
{
    free(s->normals);
    free(s->colours);
    s->normals = NULL;
    s->colours = NULL;
}

/* --- more triangles ----------------------------------------------------------------------------------------------- */

static uint32_t middle(triangle_mesh *out, uint32_t a, uint32_t b)
{
    const uint32_t v = out->vertex_count++;
    const lmb_vec3 n = add3(get(out->normals + 3 * (size_t)a), get(out->normals + 3 * (size_t)b));
    for (size_t c = 0; c < 3; ++c) {
        out->positions[3 * (size_t)v + c] =
            0.5f * (out->positions[3 * (size_t)a + c] + out->positions[3 * (size_t)b + c]);
        out->colours[3 * (size_t)v + c] = 0.5f * (out->colours[3 * (size_t)a + c] + out->colours[3 * (size_t)b + c]);
    }
    put(out->normals + 3 * (size_t)v, normalize3(n));
    return v;
}

/* Middles are not shared, so each triangle adds three vertices. */
int relief_divide(triangle_mesh *out, const triangle_mesh *in, report *r)
{
    static const int part[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    if (!take(out, in->vertex_count + 3 * in->triangle_count, 4 * in->triangle_count, r)) {
        return 0;
    }
    const size_t floats = 3 * (size_t)in->vertex_count;
    memcpy(out->positions, in->positions, floats * sizeof(float));
    memcpy(out->normals, in->normals, floats * sizeof(float));
    memcpy(out->colours, in->colours, floats * sizeof(float));
    out->vertex_count = in->vertex_count;
    for (uint32_t t = 0; t < in->triangle_count; ++t) {
        const uint32_t *i = in->indices + 3 * (size_t)t;
        const uint32_t corner[6] = {i[0], i[1], i[2], middle(out, i[0], i[1]), middle(out, i[1], i[2]),
                                    middle(out, i[2], i[0])};
        for (int k = 0; k < 12; ++k) {
            out->indices[12 * (size_t)t + (size_t)k] = corner[part[k / 3][k % 3]];
        }
    }
    return 1;
}
