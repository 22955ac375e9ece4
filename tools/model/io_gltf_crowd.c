/* io_gltf_crowd.c: EXT_mesh_gpu_instancing: a node that shows the mesh at many places. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "io_gltf.h"

/* Most places of a file. Nodes can share accessors, so a small file could describe billions. */
enum { MAX_PLACES = 1 << 22 };

int gltf_crowd_use(const gltf *g, uint32_t name)
{
    return json_equals(&g->doc, name, "EXT_mesh_gpu_instancing") ? MODEL_EXTENSION_READ : MODEL_EXTENSION_IGNORED;
}

/* The attributes of a node, by JSON node; JSON_NONE: not given. */
typedef struct crowd_keys {
    uint32_t t, q, s;
} crowd_keys;

/* Returns 0 if the node has no attributes of places. */
static int find_keys(crowd_keys *out, const gltf *g, uint32_t node)
{
    const uint32_t own = json_member(&g->doc, json_member(&g->doc, node, "extensions"), "EXT_mesh_gpu_instancing"),
                   all = json_member(&g->doc, own, "attributes");
    out->t = json_member(&g->doc, all, "TRANSLATION");
    out->q = json_member(&g->doc, all, "ROTATION");
    out->s = json_member(&g->doc, all, "SCALE");
    return out->t != JSON_NONE || out->q != JSON_NONE || out->s != JSON_NONE;
}

/* Opens one attribute. Sets *count, or requires it if it is not 0. */
static int open_attribute(gltf_accessor *out, uint32_t *count, gltf *g, uint32_t reference, uint32_t components)
{
    uint32_t index;
    if (reference == JSON_NONE)
        return 1;
    if (!gltf_attribute(out, &index, g, reference, components, components, 0))
        return 0;
    if (*count != 0 && out->count != *count)
        return json_fail(&g->doc, reference, g->b->r, "%u places, but another attribute has %u", (unsigned)out->count,
                         (unsigned)*count);
    *count = out->count;
    return 1;
}

/* Sets the translation (which = 0), rotation (1) or scale (2) of each place, if the attribute is given. */
static int read_attribute(model_local *to, gltf *g, uint32_t reference, const gltf_accessor *a, int which)
{
    const size_t size = which == 1 ? 4 : 3;
    const float *values = reference == JSON_NONE ? NULL : gltf_floats(g, a);
    if (values == NULL)
        return reference == JSON_NONE;
    for (uint32_t i = 0; i < a->count; ++i) {
        double *v = which == 0 ? to[i].t : which == 1 ? to[i].q : to[i].s;
        for (size_t k = 0; k < size; ++k)
            v[k] = (double)values[size * i + k];
    }
    return 1;
}

static int open_all(gltf_accessor a[3], uint32_t *count, gltf *g, const crowd_keys *keys)
{
    *count = 0;
    return open_attribute(&a[0], count, g, keys->t, 3) && open_attribute(&a[1], count, g, keys->q, 4) &&
           open_attribute(&a[2], count, g, keys->s, 3);
}

/* The places of one node, from g->place[first] on. */
static int read_places(gltf *g, uint32_t node, uint32_t first)
{
    crowd_keys keys;
    gltf_accessor a[3];
    uint32_t count;
    model_local *to = g->place + first;
    if (!find_keys(&keys, g, node) || !open_all(a, &count, g, &keys))
        return 0;
    for (uint32_t i = 0; i < count; ++i)
        to[i].q[3] = to[i].s[0] = to[i].s[1] = to[i].s[2] = 1;
    return read_attribute(to, g, keys.t, &a[0], 0) && read_attribute(to, g, keys.q, &a[1], 1) &&
           read_attribute(to, g, keys.s, &a[2], 2);
}

/* Skins are posed in the world, where places have no meaning. */
static int is_crowd(crowd_keys *keys, uint32_t *skins, const gltf_tree *t, const gltf *g, uint32_t i)
{
    const uint32_t node = g->nodes.items[t->order[i]];
    if (t->hidden[t->order[i]] || !find_keys(keys, g, node))
        return 0;
    const int has_skin = json_member(&g->doc, node, "skin") != JSON_NONE;
    *skins += (uint32_t)has_skin;
    return !has_skin;
}

int gltf_crowds(const gltf_tree *t, gltf *g)
{
    uint64_t total = 0;
    uint32_t skins = 0;
    g->crowd = (gltf_crowd *)build_scratch(g->b, t->count, sizeof *g->crowd);
    for (uint32_t i = 0; g->crowd && i < t->count; ++i) {
        crowd_keys keys;
        gltf_accessor a[3];
        gltf_crowd *c = &g->crowd[i];
        if (!is_crowd(&keys, &skins, t, g, i))
            continue;
        if (!open_all(a, &c->count, g, &keys))
            return 0;
        c->first = (uint32_t)total;
        total += c->count;
        if (total > MAX_PLACES)
            return report_fail(g->b->r, "%s: over %d places of instances (EXT_mesh_gpu_instancing)", g->b->path,
                               (int)MAX_PLACES);
    }
    build_note_count(g->b, "skinned nodes with instances (EXT_mesh_gpu_instancing), drawn once", skins);
    if (g->b->keeps_source && total > 0)
        build_note(g->b, "EXT_mesh_gpu_instancing: a baked GLB has new nodes, without names of nodes and other maps");
    g->places = (uint32_t)total;
    g->place = (model_local *)build_scratch(g->b, total, sizeof *g->place);
    g->place_owner = (uint32_t *)build_scratch(g->b, total, sizeof *g->place_owner);
    if (!g->crowd || !g->place || !g->place_owner)
        return 0;
    for (uint32_t i = 0; i < t->count; ++i) {
        const gltf_crowd c = g->crowd[i];
        if (c.count > 0 && !read_places(g, g->nodes.items[t->order[i]], c.first))
            return 0;
        for (uint32_t k = 0; k < c.count; ++k)
            g->place_owner[c.first + k] = i;
    }
    return 1;
}

/* The transform of a place of a JSON node. */
static int crowd_world(gltf_matrix *out, gltf *g, const gltf_matrix *world, uint32_t node, uint32_t place)
{
    gltf_matrix local;
    if (!model_compose(local.m, &g->place[place]))
        return json_fail(&g->doc, node, g->b->r,
                         "an instance's rotation is no quaternion (its length is 0 or not finite)");
    gltf_multiply(out, world, &local);
    for (int k = 0; k < 16; ++k) {
        if (!(fabs(out->m[k]) <= (double)FLT_MAX))
            return json_fail(&g->doc, node, g->b->r, "an instance's place in the world is not finite");
    }
    return 1;
}

int gltf_add_crowd(gltf *g, const gltf_tree *t, const gltf_placing *node)
{
    const gltf_crowd c = g->crowd[node->order];
    for (uint32_t p = c.first; p < c.first + c.count; ++p) {
        gltf_matrix world;
        gltf_placing at = *node;
        at.mover = t->count + p;
        at.world = &world;
        if (!crowd_world(&world, g, node->world, g->nodes.items[t->order[node->order]], p))
            return 0;
        gltf_add_instances(g, t, &at);
    }
    return 1;
}

void gltf_crowd_motion(uint32_t *parent, model_local *rest, uint8_t *moves, const gltf_tree *t, const gltf *g)
{
    for (uint32_t i = 0; i < g->places; ++i) {
        parent[t->count + i] = g->place_owner[i];
        rest[t->count + i] = g->place[i];
        moves[t->count + i] = moves[g->place_owner[i]];
    }
}
