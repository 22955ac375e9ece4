/* vertex_light_sight.c: visibility between points, points inside solids, and valid lamp places. */
#include "vertex_light.h"

#include <stdlib.h>
#include <string.h>

int vl_sight_begin(vl_sight *s, const vl_mesh *m, report *r)
{
    memset(s, 0, sizeof *s);
    s->kernels = lmb_kernels_pick();
    s->positions = calloc(3 * (size_t)m->places, sizeof *s->positions);
    s->indices = calloc(3 * (size_t)m->triangles, sizeof *s->indices);
    s->two_sided = calloc(m->triangles, sizeof *s->two_sided);
    s->tile = calloc(1, sizeof *s->tile);
    if (s->positions == NULL || s->indices == NULL || s->two_sided == NULL || s->tile == NULL) {
        return report_fail(r, "not enough memory for a mesh");
    }
    for (uint32_t i = 0; i < m->places; ++i) {
        dvec_write(s->positions + 3 * i, m->place[i]);
    }
    for (uint32_t i = 0; i < m->triangles; ++i) {
        memcpy(s->indices + 3 * i, m->triangle[i].p, sizeof m->triangle[i].p);
        s->two_sided[i] = m->triangle[i].is_two_sided;
    }
    s->mesh.positions = s->positions;
    s->mesh.indices = s->indices;
    s->mesh.index_format = LMB_INDEX_U32;
    s->mesh.vertex_count = m->places;
    s->mesh.triangle_count = m->triangles;
    s->material.texture = -1;
    s->material.alpha = 1.0f;
    s->material.flags = LMB_DOUBLE_SIDED;
    for (int i = 0; i < 4; ++i) {
        s->instance.to_world.m[5 * i] = 1.0f;
    }
    s->instance.first_id = 1;
    s->scene.meshes = &s->mesh;
    s->scene.materials = &s->material;
    s->scene.instances = &s->instance;
    s->scene.mesh_count = s->scene.material_count = s->scene.instance_count = 1;
    lmb_scene_bounds(&s->scene.bounds_min, &s->scene.bounds_max, &s->scene);
    const size_t bytes = lmb_bvh_bytes(m->triangles);
    s->bvh_memory = bytes > 0 ? malloc(bytes) : NULL;
    if (s->bvh_memory == NULL || lmb_bvh_init(&s->bvh, m->triangles, s->bvh_memory, bytes) != LMB_OK ||
        lmb_bvh_build(&s->bvh, &s->scene) != LMB_OK) {
        return report_fail(r, "not enough memory for %u triangles", (unsigned)m->triangles);
    }
    s->tile->hits = 1;
    s->tile->id[0] = 1;
    s->tile->depth[0] = 1.0f;
    return 1;
}

void vl_sight_end(vl_sight *s)
{
    free(s->positions);
    free(s->indices);
    free(s->two_sided);
    free(s->bvh_memory);
    free(s->tile);
    memset(s, 0, sizeof *s);
}

static lmb_vec3 narrowed(dvec v)
{
    lmb_vec3 out = {dvec_narrow(v.x), dvec_narrow(v.y), dvec_narrow(v.z)};
    return out;
}

int vl_sees(vl_sight *s, dvec from, dvec to)
{
    const lmb_vec3 a = narrowed(from), b = narrowed(to);
    s->tile->position[0][0] = a.x;
    s->tile->position[1][0] = a.y;
    s->tile->position[2][0] = a.z;
    const float noise = lmb_place_noise(a, 0.0f) + lmb_place_noise(b, 0.0f);
    return lmb_occluded_tile(s->kernels, &s->traversal, &s->bvh, s->tile, 1, b, noise) == 0;
}

enum met { MET_FRONT, MET_BACK, MET_TWO_SIDED };

/* The distance of the nearest triangle along a ray, 1e30 if there is none, and which side is hit. */
static double meets(enum met *out, const vl_sight *s, dvec at, dvec way)
{
    double nearest = 1e30;
    *out = MET_FRONT;
    for (uint32_t i = 0; i < s->mesh.triangle_count; ++i) {
        const uint32_t *p = s->indices + 3 * i;
        const dvec a = dvec_read(s->positions + 3 * p[0]), e = dvec_sub(dvec_read(s->positions + 3 * p[1]), a),
                   f = dvec_sub(dvec_read(s->positions + 3 * p[2]), a), h = dvec_cross(way, f);
        const double det = dvec_dot(e, h);
        if (fabs(det) < 1e-12) {
            continue;
        }
        const dvec o = dvec_sub(at, a), q = dvec_cross(o, e);
        const double u = dvec_dot(o, h) / det, v = dvec_dot(way, q) / det, t = dvec_dot(f, q) / det;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-6 && t < nearest) {
            nearest = t;
            *out = s->two_sided[i] ? MET_TWO_SIDED : det < 0.0 ? MET_BACK : MET_FRONT;
        }
    }
    return nearest;
}

#define NARROW 1.5 /* of the spacing: a slab of half this width can contain no lamp place */

/* Uniform directions on the sphere, the first half of them upwards. */
enum { WAYS = 32 };
static dvec way_of(int i)
{
    const double z = 1.0 - (2.0 * i + 1.0) / WAYS, turn = 2.399963229728653 * i, ring = sqrt(1.0 - z * z);
    return dvec_of(ring * cos(turn), z, ring * sin(turn));
}

double vl_buried(const vl_sight *s, dvec at, dvec up)
{
    int backs = 0;
    for (int i = 0; i < WAYS; ++i) {
        dvec way = way_of(i);
        enum met met;
        if (dvec_dot(way, up) < 0.0) {
            way = dvec_mul(way, -1.0);
        }
        meets(&met, s, at, way);
        backs += met == MET_BACK;
    }
    return (double)backs / WAYS;
}

/* Are most chords through a point between two-sided surfaces shorter than `limit`? This holds everywhere between the
 * sides of a slab, but not in the corner of a room. One-sided surfaces are recognized by back faces. */
static int is_enclosed(const vl_sight *s, dvec at, double limit)
{
    int narrow = 0;
    for (int i = 0; i < WAYS / 2; ++i) {
        const dvec way = way_of(i);
        enum met ahead, behind;
        const double width = meets(&ahead, s, at, way) + meets(&behind, s, at, dvec_mul(way, -1.0));
        narrow += ahead == MET_TWO_SIDED && behind == MET_TWO_SIDED && width < limit;
    }
    return 4 * narrow > WAYS;
}

dvec vl_lattice_place(const vl_lattice *l, uint32_t i)
{
    const uint32_t x = i % (uint32_t)l->count[0], y = i / (uint32_t)l->count[0] % (uint32_t)l->count[1],
                   z = i / (uint32_t)l->count[0] / (uint32_t)l->count[1];
    return dvec_of(l->first[0] + x * l->spacing, l->first[1] + y * l->spacing, l->first[2] + z * l->spacing);
}

int vl_lattice_make(vl_lattice *l, const vl_mesh *m, const vl_sight *s, uint32_t places, report *r)
{
    double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
    memset(l, 0, sizeof *l);
    for (uint32_t i = 0; i < m->places; ++i) {
        const double at[3] = {m->place[i].x, m->place[i].y, m->place[i].z};
        for (int k = 0; k < 3; ++k) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    /* the finest lattice with few enough places; the outer places are a third of the spacing off the walls */
    double widest = high[0] - low[0];
    for (int k = 1; k < 3; ++k) {
        widest = high[k] - low[k] > widest ? high[k] - low[k] : widest;
    }
    for (double spacing = widest / 100.0;; spacing *= 1.01) {
        double all = 1.0;
        for (int k = 0; k < 3; ++k) {
            const double inner = high[k] - low[k] - 0.66 * spacing;
            l->count[k] = inner > 0.0 ? 1 + (int32_t)floor(inner / spacing + 0.5) : 1;
            all *= l->count[k];
        }
        if (all <= places) {
            l->spacing = spacing;
            l->all = (uint32_t)all;
            break;
        }
    }
    for (int k = 0; k < 3; ++k) {
        l->first[k] = 0.5 * (low[k] + high[k]) - 0.5 * l->spacing * (l->count[k] - 1);
    }
    l->valid = calloc(l->all, 1);
    if (l->valid == NULL) {
        return report_fail(r, "not enough memory for a lattice of %u places", (unsigned)l->all);
    }
    for (uint32_t i = 0; i < l->all; ++i) {
        const dvec at = vl_lattice_place(l, i);
        l->valid[i] = vl_buried(s, at, dvec_of(0, 0, 0)) < 0.25 && !is_enclosed(s, at, NARROW * l->spacing);
    }
    return 1;
}
