/* light_mesh.c: a scene's triangles as meshes that carry their light. */
#include "light_export.h"

#include <stdlib.h>
#include <string.h>

#include "../../src/raster/triangle.h"

static lmb_vec3 unit_or(lmb_vec3 v, lmb_vec3 other)
{
    const float length = length3(v);
    return length > 1e-20f ? mul3(v, 1.0f / length) : other;
}

/* By the inverse transpose, as far as signs and directions go. */
static lmb_vec3 to_world(const lmb_mat4 *m, lmb_vec3 n)
{
    const lmb_vec3 x = vec3(m->m[0], m->m[1], m->m[2]), y = vec3(m->m[4], m->m[5], m->m[6]),
                   z = vec3(m->m[8], m->m[9], m->m[10]);
    const lmb_vec3 sum = add3(add3(mul3(cross3(y, z), n.x), mul3(cross3(z, x), n.y)), mul3(cross3(x, y), n.z));
    return dot3(cross3(x, y), z) < 0.0f ? mul3(sum, -1.0f) : sum;
}

int light_corners(light_corner out[3], lmb_vec3 *face, const lmb_scene *scene, uint32_t id, uint32_t back)
{
    lmb_triangle t;
    float area;
    if (!lmb_triangle_fetch(&t, scene, id) || !lmb_triangle_shape(face, &area, &t)) {
        return 0;
    }
    const lmb_vec3 across = cross3(sub3(t.corner[1], t.corner[0]), sub3(t.corner[2], t.corner[0]));
    const int is_mirrored = dot3(across, *face) < 0.0f; /* its front is the clockwise side */
    *face = back ? mul3(*face, -1.0f) : *face;
    for (int k = 0; k < 3; ++k) {
        const int from = (back != 0) != is_mirrored ? 2 - k : k;
        light_corner *c = &out[k];
        c->at = t.corner[from];
        const lmb_vec3 n = t.mesh->normals != NULL
                               ? unit_or(to_world(&t.instance->to_world, mesh_normal(t.mesh, t.vertex[from])), *face)
                               : *face;
        c->normal = dot3(n, *face) < 0.0f ? mul3(n, -1.0f) : n;
        mesh_uv(t.mesh, t.vertex[from], c->uv);
        for (int i = 0; i < 4; ++i) {
            c->colour[i] =
                t.mesh->colours != NULL ? (float)t.mesh->colours[4 * (size_t)t.vertex[from] + (size_t)i] : 255.0f;
        }
    }
    return 1;
}

light_corner light_between(const light_corner *a, const light_corner *b)
{
    light_corner c;
    c.at = mul3(add3(a->at, b->at), 0.5f);
    c.normal = unit_or(add3(a->normal, b->normal), a->normal);
    for (int i = 0; i < 2; ++i) {
        c.uv[i] = 0.5f * (a->uv[i] + b->uv[i]);
    }
    for (int i = 0; i < 4; ++i) {
        c.colour[i] = 0.5f * (a->colour[i] + b->colour[i]);
    }
    return c;
}

void light_vertex_of(glb_vertex *v, const light_corner *c)
{
    memset(v, 0, sizeof *v);
    v->position[0] = c->at.x;
    v->position[1] = c->at.y;
    v->position[2] = c->at.z;
    v->normal[0] = c->normal.x;
    v->normal[1] = c->normal.y;
    v->normal[2] = c->normal.z;
    memcpy(v->uv, c->uv, sizeof v->uv);
    for (int i = 0; i < 4; ++i) {
        v->colour[i] = (uint8_t)(c->colour[i] + 0.5f);
        v->light[i] = 65535;
    }
}

int light_mesh_begin(light_mesh *m, uint32_t material, report *r)
{
    memset(m, 0, sizeof *m);
    m->mesh.material = material;
    m->slot = malloc(LIGHT_SLOTS * sizeof *m->slot);
    for (int i = 0; m->slot != NULL && i < LIGHT_SLOTS; ++i) {
        m->slot[i] = -1;
    }
    return m->slot != NULL || report_fail(r, "not enough memory for a mesh");
}

void light_mesh_end(light_mesh *m)
{
    free(m->slot);
    free(m->next);
    m->slot = m->next = NULL;
}

static int grow(light_mesh *m, report *r)
{
    glb_mesh *g = &m->mesh;
    if (g->vertex_count == g->vertex_cap) {
        const uint32_t cap = 2 * g->vertex_cap + 256;
        glb_vertex *v = realloc(g->vertex, cap * sizeof *v);
        g->vertex = v != NULL ? v : g->vertex;
        int32_t *next = realloc(m->next, cap * sizeof *next);
        m->next = next != NULL ? next : m->next;
        if (v == NULL || next == NULL) {
            return report_fail(r, "not enough memory for %u vertices", (unsigned)cap);
        }
        g->vertex_cap = cap;
    }
    if (g->index_count == g->index_cap) {
        const uint32_t cap = 2 * g->index_cap + 256;
        uint32_t *index = realloc(g->index, cap * sizeof *index);
        if (index == NULL) {
            return report_fail(r, "not enough memory for %u corners", (unsigned)cap);
        }
        g->index = index;
        g->index_cap = cap;
    }
    return 1;
}

int light_mesh_put(light_mesh *m, const glb_vertex *v, report *r)
{
    glb_mesh *g = &m->mesh;
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < sizeof *v; ++i) {
        hash = (hash ^ ((const uint8_t *)v)[i]) * 16777619u;
    }
    hash ^= hash >> 16;
    int32_t at = m->slot[hash % LIGHT_SLOTS];
    while (at >= 0 && memcmp(&g->vertex[at], v, sizeof *v) != 0) {
        at = m->next[at];
    }
    if (!grow(m, r)) {
        return 0;
    }
    if (at < 0) {
        at = (int32_t)g->vertex_count++;
        g->vertex[at] = *v;
        m->next[at] = m->slot[hash % LIGHT_SLOTS];
        m->slot[hash % LIGHT_SLOTS] = at;
    }
    g->index[g->index_count++] = (uint32_t)at;
    return 1;
}
