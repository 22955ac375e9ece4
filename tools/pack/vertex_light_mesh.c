/* vertex_light_mesh.c: a scene's triangles with few vertices, divided where light is nonlinear, without T-junctions. */
#include "vertex_light.h"

#include <stdlib.h>
#include <string.h>

#include "../mesh/simplify.h"

enum { FINE = 300 };          /* minimum triangles of a smooth mesh that is simplified */
#define SMOOTH_SHARE 0.26     /* of the vertices: for such meshes */
#define WELD 1e-4             /* m */

static dvec widened(lmb_vec3 v) { return dvec_of((double)v.x, (double)v.y, (double)v.z); }

static void *grown(void *data, uint32_t count, uint32_t *cap, size_t size, report *r)
{
    if (count < *cap) {
        return data;
    }
    *cap = *cap > 0 ? 2 * *cap : 1024;
    void *more = realloc(data, *cap * size);
    if (more == NULL) {
        free(data);
        report_fail(r, "not enough memory for a divided mesh");
    }
    return more;
}

static int add_place(uint32_t *out, vl_mesh *m, dvec at, report *r)
{
    for (uint32_t i = 0; i < m->places; ++i) {
        const dvec d = dvec_sub(m->place[i], at);
        if (dvec_dot(d, d) < WELD * WELD) {
            *out = i;
            return 1;
        }
    }
    m->place = grown(m->place, m->places, &m->place_cap, sizeof *m->place, r);
    if (m->place == NULL) {
        m->places = m->place_cap = 0;
        return 0;
    }
    *out = m->places;
    m->place[m->places++] = at;
    return 1;
}

int vl_triangle_face(vl_triangle *t, const vl_mesh *m)
{
    const dvec n = dvec_turn(m->place[t->p[0]], m->place[t->p[1]], m->place[t->p[2]]);
    t->face = dvec_unit(n);
    return dvec_length(n) > 1e-10;
}

static int add_triangle(vl_mesh *m, const vl_triangle *t, report *r)
{
    m->triangle = grown(m->triangle, m->triangles, &m->triangle_cap, sizeof *m->triangle, r);
    if (m->triangle == NULL) {
        m->triangles = m->triangle_cap = 0;
        return 0;
    }
    m->triangle[m->triangles++] = *t;
    return 1;
}

/* Adds a triangle and, if it is two-sided, the other side. */
static int add_sides(vl_mesh *m, vl_triangle *t, report *r)
{
    if (t->p[0] == t->p[1] || t->p[1] == t->p[2] || t->p[2] == t->p[0] || !vl_triangle_face(t, m)) {
        return 1;
    }
    for (int i = 0; i < 3; ++i) {
        if (dvec_dot(t->n[i], t->n[i]) < 0.25) {
            t->n[i] = t->face;
        } else if (dvec_dot(t->n[i], t->face) < 0.0) {
            t->n[i] = dvec_mul(t->n[i], -1.0);
        }
    }
    t->is_two_sided = (t->material->flags & LMB_DOUBLE_SIDED) != 0;
    if (!add_triangle(m, t, r)) {
        return 0;
    }
    if (t->is_two_sided) {
        vl_triangle back = *t;
        for (int i = 0; i < 3; ++i) {
            const int from = i == 0 ? 0 : 3 - i;
            back.p[i] = t->p[from];
            back.n[i] = dvec_mul(t->n[from], -1.0);
            memcpy(back.uv[i], t->uv[from], sizeof back.uv[i]);
            memcpy(back.colour[i], t->colour[from], sizeof back.colour[i]);
        }
        back.face = dvec_mul(t->face, -1.0);
        return add_triangle(m, &back, r);
    }
    return 1;
}

/* A vertex normal of an instance in world space; 0: it has none. */
static dvec normal_of(const lmb_triangle *t, int i)
{
    const float *m = t->instance->to_world.m;
    const dvec x = dvec_of((double)m[0], (double)m[1], (double)m[2]),
               y = dvec_of((double)m[4], (double)m[5], (double)m[6]),
               z = dvec_of((double)m[8], (double)m[9], (double)m[10]);
    lmb_vertex vertex;
    if (t->mesh->normals == NULL || !lmb_mesh_vertex(&vertex, t->mesh, t->vertex[i])) {
        return dvec_of(0, 0, 0);
    }
    const lmb_vec3 own = vertex.normal;
    return dvec_unit(
        dvec_add(dvec_add(dvec_mul(dvec_cross(y, z), (double)own.x), dvec_mul(dvec_cross(z, x), (double)own.y)),
                 dvec_mul(dvec_cross(x, y), (double)own.z)));
}

static int is_fine(const lmb_scene *s, const lmb_instance *in)
{
    const lmb_mesh *m = &s->meshes[in->mesh];
    return m->normals != NULL && m->triangle_count >= FINE;
}

static double area_of(const lmb_scene *s, const lmb_instance *in)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < s->meshes[in->mesh].triangle_count; ++i) {
        lmb_triangle t;
        lmb_vec3 n;
        float area;
        if (lmb_triangle_fetch(&t, s, in->first_id + i) && lmb_triangle_shape(&n, &area, &t)) {
            sum += (double)area;
        }
    }
    return sum;
}

static int add_plain(vl_mesh *m, const lmb_instance *in, report *r)
{
    for (uint32_t i = 0; i < m->scene->meshes[in->mesh].triangle_count; ++i) {
        lmb_triangle t;
        vl_triangle own;
        memset(&own, 0, sizeof own);
        if (!lmb_triangle_fetch(&t, m->scene, in->first_id + i)) {
            continue;
        }
        own.material = t.material;
        for (int k = 0; k < 3; ++k) {
            lmb_vertex v;
            lmb_mesh_vertex(&v, t.mesh, t.vertex[k]);
            own.n[k] = normal_of(&t, k);
            for (int c = 0; c < 3; ++c) {
                own.colour[k][c] = (double)v.colour[c];
            }
            own.uv[k][0] = (double)v.uv[0], own.uv[k][1] = (double)v.uv[1];
            if (!add_place(&own.p[k], m, widened(t.corner[k]), r)) {
                return 0;
            }
        }
        if (!add_sides(m, &own, r)) {
            return 0;
        }
    }
    return 1;
}

static int add_simplified(vl_mesh *m, const lmb_instance *in, uint32_t triangles, report *r)
{
    const uint32_t all = m->scene->meshes[in->mesh].triangle_count;
    triangle_mesh whole = {3 * all, 0, NULL, NULL, NULL, NULL}, few = {0, 0, NULL, NULL, NULL, NULL};
    simplify_facts facts;
    int ok = 1;
    whole.positions = calloc((size_t)all * 9, sizeof(float));
    whole.normals = calloc((size_t)all * 9, sizeof(float));
    whole.colours = calloc((size_t)all * 9, sizeof(float));
    whole.indices = calloc((size_t)all * 3, sizeof(uint32_t));
    if (whole.positions == NULL || whole.normals == NULL || whole.colours == NULL || whole.indices == NULL) {
        ok = report_fail(r, "not enough memory for a mesh of %u triangles", (unsigned)all);
    }
    for (uint32_t i = 0; ok && i < all; ++i) {
        lmb_triangle t;
        if (!lmb_triangle_fetch(&t, m->scene, in->first_id + i)) {
            continue;
        }
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t at = 3 * whole.triangle_count + k;
            lmb_vertex v;
            dvec_write(whole.positions + 3 * at, widened(t.corner[k]));
            dvec_write(whole.normals + 3 * at, normal_of(&t, (int)k));
            lmb_mesh_vertex(&v, t.mesh, t.vertex[k]);
            memcpy(whole.colours + 3 * at, v.colour, 3 * sizeof(float));
            whole.indices[at] = at;
        }
        whole.triangle_count += 1;
    }
    ok = ok && simplify_mesh(&few, &whole, triangles, SIMPLIFY_NEAR, &facts, r);
    for (uint32_t i = 0; ok && i < few.triangle_count; ++i) {
        vl_triangle own;
        memset(&own, 0, sizeof own);
        own.material = &m->scene->materials[in->material];
        for (int k = 0; k < 3 && ok; ++k) {
            const uint32_t v = few.indices[3 * i + (uint32_t)k];
            own.n[k] = dvec_unit(dvec_read(few.normals + 3 * v));
            own.uv[k][0] = own.uv[k][1] = -1e9; /* the texture's mean */
            for (int c = 0; c < 3; ++c) {
                own.colour[k][c] = few.colours != NULL ? (double)few.colours[3 * v + (uint32_t)c] : 1.0;
            }
            ok = add_place(&own.p[k], m, dvec_read(few.positions + 3 * v), r);
        }
        ok = ok && add_sides(m, &own, r);
    }
    free(whole.positions);
    free(whole.normals);
    free(whole.colours);
    free(whole.indices);
    triangle_mesh_free(&few);
    return ok;
}

int vl_mesh_build(vl_mesh *m, const lmb_scene *scene, uint32_t vertices, report *r)
{
    double sizes = 0.0;
    memset(m, 0, sizeof *m);
    m->scene = scene;
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        if (is_fine(scene, &scene->instances[i])) {
            sizes += sqrt(area_of(scene, &scene->instances[i]));
        }
    }
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        const lmb_instance *in = &scene->instances[i];
        const double share = sizes > 0.0 ? sqrt(area_of(scene, in)) / sizes : 0.0;
        if (!(is_fine(scene, in) ? add_simplified(m, in, (uint32_t)(2.0 * SMOOTH_SHARE * vertices * share), r)
                                 : add_plain(m, in, r))) {
            return 0;
        }
    }
    return m->triangles > 0 || report_fail(r, "the scene has no triangle to draw");
}

void vl_mesh_free(vl_mesh *m)
{
    free(m->place);
    free(m->triangle);
    memset(m, 0, sizeof *m);
}

void vl_albedo(double out[3], const vl_mesh *m, const vl_triangle *t, const double weight[3])
{
    float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    if (t->material->texture >= 0) {
        const lmb_texture *own = &m->scene->textures[t->material->texture];
        const int is_mean = t->uv[0][0] < -1e8;
        lmb_texture one = *own;
        float uv[2] = {0.5f, 0.5f};
        for (int k = 0; k < 2 && !is_mean; ++k) {
            uv[k] = (float)(t->uv[0][k] * weight[0] + t->uv[1][k] * weight[1] + t->uv[2][k] * weight[2]);
        }
        one.filter = LMB_TRILINEAR;
        lmb_texture_sample(texel, &one, uv[0], uv[1], is_mean ? (float)(own->levels - 1) : 0.0f);
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = (double)t->material->albedo[c] * (double)texel[c] *
                 (t->colour[0][c] * weight[0] + t->colour[1][c] * weight[1] + t->colour[2][c] * weight[2]);
    }
}

/* --- division ----------------------------------------------------------------------------------------------------- */

enum { LAMPS = 40, MOST_TRIANGLES = 30000 };
#define SHORTEST 0.06 /* m */
#define EVEN     0.12 /* weight of length relative to the bend, per m */

typedef struct edge {
    uint32_t a, b; /* places, a < b */
    double length, score;
} edge;

typedef struct dividing {
    vl_mesh *m;
    vl_sight *sight;
    dvec lamp[LAMPS];
    int lamps;
    edge *edge;
    uint32_t edges, cap;
} dividing;

static int is_less(const edge *x, const edge *y)
{
    return x->length != y->length ? x->length < y->length : x->a != y->a ? x->a < y->a : x->b < y->b;
}

static edge *find_edge(dividing *d, uint32_t a, uint32_t b)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    for (uint32_t i = 0; i < d->edges; ++i) {
        if (d->edge[i].a == low && d->edge[i].b == high) {
            return &d->edge[i];
        }
    }
    return NULL;
}

/* Light at a point from each of several lamps all over the room. */
static void light_at(double out[LAMPS], dividing *d, dvec at, dvec normal)
{
    const dvec over = dvec_add(at, dvec_mul(normal, 0.01));
    for (int i = 0; i < d->lamps; ++i) {
        const dvec way = dvec_sub(d->lamp[i], at);
        const double far2 = dvec_dot(way, way), cosine = dvec_dot(way, normal) / sqrt(far2);
        out[i] = cosine > 0.0 && vl_sees(d->sight, over, d->lamp[i]) ? cosine / (far2 + 0.05) : 0.0;
    }
}

/* Nonlinearity of light along an edge: the difference between the middle and the mean of the ends, relative to all
 * light. */
static double bend(dividing *d, const vl_triangle *t, int from)
{
    const int to = (from + 1) % 3;
    const dvec a = d->m->place[t->p[from]], b = d->m->place[t->p[to]], c = d->m->place[t->p[(to + 1) % 3]];
    double ea[LAMPS], em[LAMPS], eb[LAMPS], off = 0.0, all = 1e-6;
    /* slightly inside the triangle, because walls and objects hide the edge */
    const dvec normal = dvec_unit(dvec_add(t->n[from], t->n[to]));
    light_at(ea, d, dvec_mix(a, dvec_mix(c, b, 0.5), 0.05), t->n[from]);
    light_at(eb, d, dvec_mix(b, dvec_mix(c, a, 0.5), 0.05), t->n[to]);
    light_at(em, d, dvec_mix(dvec_mix(a, b, 0.5), c, 0.05), normal);
    for (int i = 0; i < d->lamps; ++i) {
        off += fabs(em[i] - 0.5 * (ea[i] + eb[i])) + 0.35 * fabs(ea[i] - eb[i]);
        all += 0.25;
    }
    return off / all;
}

static int add_edge(dividing *d, const vl_triangle *t, int from, report *r)
{
    const uint32_t a = t->p[from], b = t->p[(from + 1) % 3];
    edge *e = find_edge(d, a, b);
    if (e == NULL) {
        d->edge = grown(d->edge, d->edges, &d->cap, sizeof *d->edge, r);
        if (d->edge == NULL) {
            return 0;
        }
        e = &d->edge[d->edges++];
        e->a = a < b ? a : b;
        e->b = a < b ? b : a;
        e->length = dvec_length(dvec_sub(d->m->place[a], d->m->place[b]));
        e->score = 0.0;
    }
    if (e->length > SHORTEST) {
        const double s = e->length * sqrt(e->length) * (bend(d, t, from) + EVEN * sqrt(e->length));
        e->score = e->score > s ? e->score : s;
    }
    return 1;
}

static int has_edge(const vl_triangle *t, const edge *e)
{
    for (int i = 0; i < 3; ++i) {
        const uint32_t a = t->p[i], b = t->p[(i + 1) % 3];
        if ((a == e->a && b == e->b) || (a == e->b && b == e->a)) {
            return i;
        }
    }
    return VL_NONE;
}

static edge *longest_of(dividing *d, const vl_triangle *t)
{
    edge *best = NULL;
    for (int i = 0; i < 3; ++i) {
        edge *e = find_edge(d, t->p[i], t->p[(i + 1) % 3]);
        if (best == NULL || is_less(best, e)) {
            best = e;
        }
    }
    return best;
}

/* Walks from an edge to one that is the longest of all triangles at it. The choice depends only on lengths, so
 * neighbours agree. */
static edge *terminal(dividing *d, edge *e)
{
    for (;;) {
        edge *longer = e;
        for (uint32_t i = 0; i < d->m->triangles; ++i) {
            if (has_edge(&d->m->triangle[i], e) >= 0) {
                edge *own = longest_of(d, &d->m->triangle[i]);
                longer = is_less(longer, own) ? own : longer;
            }
        }
        if (longer == e) {
            return e;
        }
        e = longer;
    }
}

static int halve(dividing *d, edge *which, report *r)
{
    const edge e = *which;
    vl_mesh *m = d->m;
    uint32_t middle;
    const uint32_t before = m->triangles;
    *which = d->edge[--d->edges];
    if (!add_place(&middle, m, dvec_mix(m->place[e.a], m->place[e.b], 0.5), r)) {
        return 0;
    }
    for (uint32_t i = 0; i < before; ++i) {
        const int from = has_edge(&m->triangle[i], &e);
        if (from < 0) {
            continue;
        }
        vl_triangle first = m->triangle[i], second = first;
        const int to = (from + 1) % 3;
        const dvec n = dvec_unit(dvec_add(first.n[from], first.n[to]));
        first.p[to] = second.p[from] = middle;
        first.n[to] = second.n[from] = n;
        for (int k = 0; k < 2; ++k) {
            first.uv[to][k] = second.uv[from][k] = 0.5 * (second.uv[to][k] + first.uv[from][k]);
        }
        for (int k = 0; k < 3; ++k) {
            first.colour[to][k] = second.colour[from][k] = 0.5 * (second.colour[to][k] + first.colour[from][k]);
        }
        m->triangle[i] = first;
        if (!add_triangle(m, &second, r)) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < m->triangles; ++i) {
        const vl_triangle t = m->triangle[i];
        for (int k = 0; k < 3; ++k) {
            if ((t.p[k] == middle || t.p[(k + 1) % 3] == middle) && !add_edge(d, &t, k, r)) {
                return 0;
            }
        }
    }
    return 1;
}

/* The number of final vertices: places with distinct normals. */
static uint32_t vertices_of(const vl_mesh *m)
{
    uint32_t count = 0;
    dvec(*met)[8] = calloc(m->places, sizeof *met);
    unsigned char *many = calloc(m->places, 1);
    for (uint32_t i = 0; met != NULL && many != NULL && i < m->triangles; ++i) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t p = m->triangle[i].p[k];
            int is_new = 1;
            for (int j = 0; j < many[p]; ++j) {
                is_new &= dvec_dot(met[p][j], m->triangle[i].n[k]) < 0.999;
            }
            if (is_new && many[p] < 8) {
                met[p][many[p]++] = m->triangle[i].n[k];
                count += 1;
            }
        }
    }
    free(met);
    free(many);
    return count;
}

int vl_mesh_divide(vl_mesh *m, vl_sight *s, const vl_lattice *l, uint32_t vertices, report *r)
{
    dividing d;
    memset(&d, 0, sizeof d);
    d.m = m;
    d.sight = s;
    uint32_t valid = 0, met = 0;
    for (uint32_t i = 0; i < l->all; ++i) {
        valid += l->valid[i];
    }
    for (uint32_t i = 0; i < l->all && d.lamps < LAMPS; ++i) {
        met += l->valid[i];
        if (l->valid[i] && (uint64_t)met * LAMPS >= (uint64_t)(d.lamps + 1) * valid) {
            d.lamp[d.lamps++] = vl_lattice_place(l, i);
        }
    }
    int ok = 1;
    for (uint32_t i = 0; i < m->triangles && ok; ++i) {
        for (int k = 0; k < 3 && ok; ++k) {
            const vl_triangle t = m->triangle[i];
            ok = add_edge(&d, &t, k, r);
        }
    }
    while (ok && m->triangles < MOST_TRIANGLES && vertices_of(m) < vertices) {
        edge *best = NULL;
        for (uint32_t i = 0; i < d.edges; ++i) {
            if (best == NULL || d.edge[i].score > best->score) {
                best = &d.edge[i];
            }
        }
        if (best == NULL || best->score <= 0.0) {
            break;
        }
        ok = halve(&d, terminal(&d, best), r);
    }
    free(d.edge);
    return ok;
}
