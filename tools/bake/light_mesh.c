/* light_mesh.c: a scene's triangles as meshes with light. */
#include "light_export.h"

#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

static lmb_vec3 unit_or(lmb_vec3 v, lmb_vec3 other)
{
    const float length = length3(v);
    return length > 1e-20f ? mul3(v, 1.0f / length) : other;
}

/* Applies the inverse transpose, up to sign and length. */
static lmb_vec3 to_world(const lmb_mat4 *m, lmb_vec3 n)
{
    const lmb_vec3 x = vec3(m->m[0], m->m[1], m->m[2]), y = vec3(m->m[4], m->m[5], m->m[6]),
                   z = vec3(m->m[8], m->m[9], m->m[10]);
    const lmb_vec3 sum = add3(add3(mul3(cross3(y, z), n.x), mul3(cross3(z, x), n.y)), mul3(cross3(x, y), n.z));
    return dot3(cross3(x, y), z) < 0.0f ? mul3(sum, -1.0f) : sum;
}

static int is_mirror(const lmb_mat4 *m)
{
    const lmb_vec3 x = vec3(m->m[0], m->m[1], m->m[2]), y = vec3(m->m[4], m->m[5], m->m[6]),
                   z = vec3(m->m[8], m->m[9], m->m[10]);
    return dot3(cross3(x, y), z) < 0.0f;
}

/* Reads the texture coordinates of a corner from the file, or from the scene. On the back of a triangle the tangent is
 * negated like the normal. */
static void read_streams(light_corner *c, const lmb_triangle *t, const model_source *source, uint32_t vertex,
                         uint32_t back)
{
    const uint32_t mesh = t->instance->mesh;
    memset(c->uv, 0, sizeof c->uv);
    memset(c->tangent, 0, sizeof c->tangent);
    if (source == NULL) {
        lmb_vertex own;
        if (lmb_mesh_vertex(&own, t->mesh, vertex)) {
            memcpy(c->uv[0], own.uv, sizeof c->uv[0]);
        }
        return;
    }
    for (int set = 0; set < MODEL_UV_SETS; ++set) {
        if (source->uv[set][mesh] != NULL) {
            memcpy(c->uv[set], source->uv[set][mesh] + 2 * (size_t)vertex, sizeof c->uv[set]);
        }
    }
    for (int i = 0; i < 4 && source->tangent[mesh] != NULL; ++i) {
        const float v = source->tangent[mesh][4 * (size_t)vertex + (size_t)i];
        c->tangent[i] = back ? -v : v;
    }
}

int light_corners(light_corner out[3], lmb_vec3 *face, const lmb_scene *scene, const model_source *source, uint32_t id,
                  uint32_t back)
{
    lmb_triangle t;
    float area;
    if (!lmb_triangle_fetch(&t, scene, id) || !lmb_triangle_shape(face, &area, &t)) {
        return 0;
    }
    const lmb_vec3 across = cross3(sub3(t.corner[1], t.corner[0]), sub3(t.corner[2], t.corner[0]));
    const int is_mirrored = dot3(across, *face) < 0.0f; /* the front is the clockwise side */
    lmb_vertex own[3];
    for (int k = 0; k < 3; ++k) {
        if (!lmb_mesh_vertex(&own[k], t.mesh, t.vertex[k])) {
            return 0;
        }
    }
    const lmb_vec3 first = own[0].position;
    const lmb_vec3 flat = unit_or(cross3(sub3(own[1].position, first), sub3(own[2].position, first)), *face);
    *face = back ? mul3(*face, -1.0f) : *face;
    for (int k = 0; k < 3; ++k) {
        const int from = (back != 0) != is_mirrored ? 2 - k : k;
        light_corner *c = &out[k];
        c->at = t.corner[from];
        c->own_at = own[from].position;
        c->own_normal = t.mesh->normals != NULL ? own[from].normal : back ? mul3(flat, -1.0f) : flat;
        c->normal = t.mesh->normals != NULL ? unit_or(to_world(&t.instance->to_world, c->own_normal), *face) : *face;
        if (dot3(c->normal, *face) < 0.0f) {
            c->normal = mul3(c->normal, -1.0f);
            c->own_normal = mul3(c->own_normal, -1.0f);
        }
        read_streams(c, &t, source, t.vertex[from], back);
        for (int i = 0; i < 4; ++i) {
            c->colour[i] = own[from].colour[i];
        }
        c->has_wide_colour = t.mesh->colour_format == LMB_COLOUR_RGBA16;
    }
    return 1;
}

static void mix(float *out, const float *a, const float *b, float part, int count)
{
    for (int i = 0; i < count; ++i) {
        out[i] = (1.0f - part) * a[i] + part * b[i];
    }
}

static lmb_vec3 mix3(lmb_vec3 a, lmb_vec3 b, float part) { return add3(mul3(a, 1.0f - part), mul3(b, part)); }

/* The last component of a tangent is a sign. */
light_corner light_along(const light_corner *a, const light_corner *b, float part)
{
    light_corner c;
    c.at = mix3(a->at, b->at, part);
    c.normal = unit_or(mix3(a->normal, b->normal, part), a->normal);
    c.own_at = mix3(a->own_at, b->own_at, part);
    c.own_normal = unit_or(mix3(a->own_normal, b->own_normal, part), a->own_normal);
    const lmb_vec3 ta = vec3(a->tangent[0], a->tangent[1], a->tangent[2]),
                   t = unit_or(mix3(ta, vec3(b->tangent[0], b->tangent[1], b->tangent[2]), part), ta);
    c.tangent[0] = t.x;
    c.tangent[1] = t.y;
    c.tangent[2] = t.z;
    c.tangent[3] = a->tangent[3];
    mix(c.uv[0], a->uv[0], b->uv[0], part, 2 * MODEL_UV_SETS);
    mix(c.colour, a->colour, b->colour, part, 4);
    c.has_wide_colour = a->has_wide_colour;
    return c;
}

light_corner light_between(const light_corner *a, const light_corner *b) { return light_along(a, b, 0.5f); }

static void put_vec3(float out[3], lmb_vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

void light_vertex_of(glb_vertex *v, const light_corner *c)
{
    memset(v, 0, sizeof *v);
    put_vec3(v->position, c->own_at);
    put_vec3(v->normal, c->own_normal);
    memcpy(v->uv, c->uv, sizeof v->uv);
    memcpy(v->tangent, c->tangent, sizeof v->tangent);
    for (int i = 0; i < 4; ++i) {
        v->colour[i] = c->has_wide_colour ? (uint16_t)(c->colour[i] * 65535.0f + 0.5f)
                                          : (uint16_t)(257 * (int)(c->colour[i] * 255.0f + 0.5f));
        v->light[i] = 65535;
    }
}

int light_mesh_begin(light_mesh *m, const lmb_scene *scene, uint32_t instance, report *r)
{
    memset(m, 0, sizeof *m);
    m->mesh.instance = instance;
    m->is_mirrored = is_mirror(&scene->instances[instance].to_world);
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

static int put_vertex(light_mesh *m, const glb_vertex *v, report *r)
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

int light_mesh_put(light_mesh *m, const glb_vertex triangle[3], report *r)
{
    int ok = 1;
    for (int k = 0; ok && k < 3; ++k) {
        ok = put_vertex(m, &triangle[m->is_mirrored ? 2 - k : k], r);
    }
    return ok;
}
