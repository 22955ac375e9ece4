/* io_gltf_shape.c: meshes that animations reshape: by moving joints, and by morph weights. Each instance gets a
 * separate mesh with separate streams. They have the shape of the file until model_pose_shapes fills them. */
#include <stdlib.h>
#include <string.h>

#include "io_gltf.h"
#include "model_shape.h"

/* The node of the current instance, the motion of that node's meshes, and the next primitive. */
typedef struct moved_node {
    uint32_t order, node, mesh; /* place in the tree's order; JSON node; index in g->meshes */
    uint32_t next;
    const model_track *track; /* NULL: the weights are not animated */
    int has_skin, moves;
    model_shape skin; /* joints of the skin, once they are read */
} moved_node;

typedef struct shaping {
    gltf *g;
    const gltf_tree *tree;
    const struct model_motion *motion;
    const uint32_t *place;
    const model_track **track_of; /* by place in the tree's order; NULL: none */
    moved_node at;                /* the node of the current instance */
    uint32_t targets, joints;     /* largest count of any shape */
} shaping;

uint32_t gltf_targets(const gltf *g, uint32_t node)
{
    uint32_t mesh, primitive;
    if (!gltf_item(&mesh, g, &g->meshes, json_member(&g->doc, node, "mesh")) || mesh == JSON_NONE)
        return 0;
    primitive = json_first(&g->doc, json_member(&g->doc, mesh, "primitives"));
    return json_count(&g->doc, json_member(&g->doc, primitive, "targets"));
}

/* Returns 1 if any joint of the skin moves. The joints were checked when the skin was posed. */
static int skin_moves(const shaping *s, uint32_t skin)
{
    const json *doc = &s->g->doc;
    uint32_t at, joint;
    for (at = json_first(doc, json_member(doc, skin, "joints")); at != JSON_NONE; at = json_next(doc, at))
        if (gltf_index(&joint, s->g, &s->g->nodes, at) && s->motion->moves[s->place[joint]])
            return 1;
    return 0;
}

/* Moves to the node of an instance. The instances of one node follow each other. */
static int come_to(shaping *s, uint32_t instance)
{
    gltf *g = s->g;
    moved_node *n = &s->at;
    const uint32_t order = g->instance_shown[instance];
    uint32_t skin;
    if (instance > 0 && order == n->order) {
        ++n->next;
        return 1;
    }
    memset(n, 0, sizeof *n);
    n->order = order;
    n->node = g->nodes.items[s->tree->order[order]];
    n->track = s->track_of[order];
    if (!gltf_index(&n->mesh, g, &g->meshes, json_member(&g->doc, n->node, "mesh")) ||
        !gltf_item(&skin, g, &g->skins, json_member(&g->doc, n->node, "skin")))
        return 0;
    n->has_skin = skin != JSON_NONE;
    n->moves = n->track != NULL || (n->has_skin && skin_moves(s, skin));
    return 1;
}

/* --- skins -------------------------------------------------------------------------------------------------------- */

static int read_bind(double (*bind)[16], gltf *g, uint32_t skin, uint32_t joints)
{
    gltf_accessor a;
    uint32_t accessor, i;
    const float *values = NULL;
    if (!gltf_item(&accessor, g, &g->accessors, json_member(&g->doc, skin, "inverseBindMatrices")))
        return 0;
    if (accessor != JSON_NONE && (!gltf_accessor_open(&a, g, accessor) || !(values = gltf_floats(g, &a))))
        return 0;
    for (i = 0; i < 16 * joints; ++i)
        bind[i / 16][i % 16] = values ? (double)values[i] : i % 16 % 5 == 0;
    return 1;
}

/* Reads the joints of the skin, once for all primitives of a node. */
static int read_skin(shaping *s)
{
    gltf *g = s->g;
    model_shape *out = &s->at.skin;
    uint32_t skin, joints, at, i = 0, joint, *node;
    double(*bind)[16];
    if (!s->at.has_skin || out->joints > 0)
        return 1;
    if (!gltf_item(&skin, g, &g->skins, json_member(&g->doc, s->at.node, "skin")))
        return 0;
    joints = json_member(&g->doc, skin, "joints");
    out->joints = json_count(&g->doc, joints);
    node = (uint32_t *)build_keep(g->b, out->joints, sizeof *node);
    bind = (double(*)[16])build_keep(g->b, out->joints, sizeof *bind);
    if (!node || !bind || !read_bind(bind, g, skin, out->joints))
        return 0;
    for (at = json_first(&g->doc, joints); at != JSON_NONE; at = json_next(&g->doc, at)) {
        if (!gltf_index(&joint, g, &g->nodes, at))
            return 0;
        node[i++] = s->place[joint];
    }
    out->joint_node = node;
    out->bind = (const double(*)[16])bind;
    s->joints = out->joints > s->joints ? out->joints : s->joints;
    return 1;
}

/* Keeps the joints and weights of a primitive, with the same number of influences for each vertex. */
static int keep_influences(model_shape *out, gltf *g, const gltf_influences *in)
{
    const uint64_t count = 4 * (uint64_t)in->sets;
    uint16_t *joint = (uint16_t *)build_keep(g->b, count * out->vertices, sizeof *joint);
    float *weight = (float *)build_keep(g->b, count * out->vertices, sizeof *weight);
    if (!joint || !weight)
        return 0;
    for (uint64_t i = 0; i < count * out->vertices; ++i) {
        const size_t from = (size_t)(i / count * 4 + i % 4), set = (size_t)(i % count / 4);
        joint[i] = (uint16_t)in->joints[set][from];
        weight[i] = in->weights[set][from];
    }
    out->influences = (uint32_t)count;
    out->joint = joint;
    out->weight = weight;
    return 1;
}

/* --- morph targets ------------------------------------------------------------------------------------------------ */

static int read_add(const float **out, gltf *g, uint32_t reference, uint32_t vertices)
{
    gltf_accessor a;
    uint32_t index;
    float *values;
    if (!gltf_attribute(&a, &index, g, reference, 3, 3, vertices))
        return 0;
    if (index == JSON_NONE)
        return 1;
    values = (float *)build_keep(g->b, 3 * (uint64_t)a.count, sizeof *values);
    *out = values;
    return values && gltf_accessor_floats(values, g, &a);
}

/* Reads the weights of the node without animation, else those of the mesh. Weights missing in the file are 0. */
static double *rest_weights(const shaping *s, uint32_t targets)
{
    gltf *g = s->g;
    const uint32_t own = json_member(&g->doc, s->at.node, "weights"), mesh = g->meshes.items[s->at.mesh];
    uint32_t at = json_first(&g->doc, own != JSON_NONE ? own : json_member(&g->doc, mesh, "weights")), i;
    double *weights = (double *)build_keep(g->b, targets, sizeof *weights);
    for (i = 0; weights && i < targets && at != JSON_NONE; ++i, at = json_next(&g->doc, at))
        if (!json_read_double(&weights[i], &g->doc, at, g->b->r))
            return NULL;
    return weights;
}

static int read_targets(model_shape *out, shaping *s, uint32_t primitive)
{
    static const char *const names[SHAPE_STREAMS] = {"POSITION", "NORMAL", "TANGENT"};
    const void *const streams[SHAPE_STREAMS] = {out->rest_positions, out->rest_normals, out->rest_tangents};
    gltf *g = s->g;
    const uint32_t targets = json_member(&g->doc, primitive, "targets");
    uint32_t target = json_first(&g->doc, targets), i;
    const uint32_t own = json_count(&g->doc, targets), all = gltf_targets(g, s->at.node);
    out->targets = all;
    if (own > all)
        return json_fail(&g->doc, primitive, g->b->r, "%u morph targets, but the mesh's first primitive has %u",
                         (unsigned)own, (unsigned)all);
    out->weights = rest_weights(s, out->targets);
    out->track = s->at.track;
    for (int k = 0; k < SHAPE_STREAMS; ++k)
        if (!(out->add[k] = (const float **)build_keep(g->b, out->targets, sizeof *out->add[k])))
            return 0;
    for (i = 0; i < own; ++i, target = json_next(&g->doc, target))
        for (int k = 0; k < SHAPE_STREAMS; ++k)
            if (streams[k] && !read_add(&out->add[k][i], g, json_member(&g->doc, target, names[k]), out->vertices))
                return 0;
    s->targets = out->targets > s->targets ? out->targets : s->targets;
    return out->weights != NULL;
}

/* --- meshes ------------------------------------------------------------------------------------------------------- */

/* Returns the stream to write: the stream of the mesh if the mesh was made for this node (as for a skin), else a
 * copy. */
static void *own_stream(gltf *g, const void *mesh, int is_own, uint64_t count, size_t size)
{
    void *copy;
    if (is_own)
        return (void *)(uintptr_t)mesh;
    copy = build_keep(g->b, count, size);
    if (copy && count > 0)
        memcpy(copy, mesh, (size_t)count * size);
    return copy;
}

static int take_streams(model_shape *out, gltf *g, lmb_mesh *mesh, const lmb_mesh *rest, int is_own)
{
    const uint64_t n = rest->vertex_count;
    out->vertices = rest->vertex_count;
    out->rest_positions = (const float *)rest->positions;
    out->rest_normals = mesh->normals ? rest->normals : NULL;
    out->rest_tangents = mesh->tangents ? rest->tangents : NULL;
    out->positions = (float *)own_stream(g, mesh->positions, is_own, 3 * n, sizeof(float));
    out->normals = out->rest_normals
                       ? (int16_t *)own_stream(g, mesh->normals, is_own, 2 * n, sizeof(int16_t))
                       : NULL;
    out->tangents = out->rest_tangents
                        ? (int16_t *)own_stream(g, mesh->tangents, is_own, 2 * n, sizeof(int16_t))
                        : NULL;
    if (!out->positions || (!out->normals && out->rest_normals) || (!out->tangents && out->rest_tangents))
        return 0; /* the mesh is unchanged */
    mesh->positions = out->positions;
    mesh->normals = out->normals;
    mesh->tangents = out->tangents;
    return 1;
}

/* Makes the shape of an instance. No other instance shares the mesh. */
static int make_shape(model_shape *out, shaping *s, uint32_t instance)
{
    gltf *g = s->g;
    const uint32_t next = GLTF_HAS_CROWDS ? s->at.next % g->mesh_size[s->at.mesh] : s->at.next, /* all at each place */
                   from = g->mesh_first[s->at.mesh] + next;
    lmb_mesh *mesh = &g->b->meshes[g->b->instances[instance].mesh];
    if (!read_skin(s))
        return 0;
    *out = s->at.skin;
    return take_streams(out, g, mesh, &g->mesh_rest[from], s->at.has_skin) &&
           read_targets(out, s, g->mesh_primitive[from]) &&
           (!s->at.has_skin || keep_influences(out, g, &g->mesh_influences[from]));
}

static void *longer(model_build *b, const void *from, uint32_t count, uint32_t more, size_t size)
{
    void *to = build_keep(b, (uint64_t)count + more, size);
    if (to && count > 0)
        memcpy(to, from, count * size);
    return to;
}

/* Makes room for `more` meshes. */
static int add_room(model_build *b, uint32_t more)
{
    model_light *l = &b->out->light;
    lmb_mesh *meshes = (lmb_mesh *)longer(b, b->meshes, b->mesh_count, more, sizeof *meshes);
    float **colour = l->colour ? (float **)longer(b, l->colour, b->mesh_count, more, sizeof *colour) : NULL,
          **uv = l->colour ? (float **)longer(b, l->uv, b->mesh_count, more, sizeof *uv) : NULL;
    if (!meshes || (l->colour && (!colour || !uv)))
        return 0;
    b->meshes = meshes;
    l->colour = colour;
    l->uv = uv;
    return 1;
}

/* Gives an instance a separate mesh, because several nodes may show one mesh without a skin. */
static void add_mesh(model_build *b, uint32_t instance)
{
    const uint32_t from = b->instances[instance].mesh, to = b->mesh_count++;
    b->meshes[to] = b->meshes[from];
    if (b->out->light.colour) {
        b->out->light.colour[to] = b->out->light.colour[from];
        b->out->light.uv[to] = b->out->light.uv[from];
    }
    b->instances[instance].mesh = to;
}

/* Counts the instances that change their shape, and those of them without a skin. */
static int count_shapes(uint32_t *bare, struct model_shapes *out, uint8_t *reshapes, shaping *s)
{
    *bare = 0;
    for (uint32_t i = 0; i < s->g->b->instance_count; ++i) {
        if (!come_to(s, i))
            return 0;
        reshapes[i] = (uint8_t)s->at.moves;
        out->count += (uint32_t)s->at.moves;
        *bare += s->at.moves && !s->at.has_skin;
    }
    return 1;
}

static int make_shapes(struct model_shapes *out, shaping *s, const uint8_t *reshapes)
{
    uint32_t to = 0;
    for (uint32_t i = 0; i < s->g->b->instance_count; ++i) {
        if (!come_to(s, i))
            return 0;
        if (!reshapes[i])
            continue;
        if (!s->at.has_skin)
            add_mesh(s->g->b, i);
        if (!make_shape(&out->shape[to++], s, i))
            return 0;
    }
    out->weights = (double *)build_keep(s->g->b, s->targets, sizeof *out->weights);
    out->matrices = (double(*)[16])build_keep(s->g->b, s->joints, sizeof *out->matrices);
    return out->weights && out->matrices;
}

static int find_tracks(shaping *s, const model_track *weight_track, uint32_t count)
{
    s->track_of = (const model_track **)build_scratch(s->g->b, s->tree->count, sizeof *s->track_of);
    for (uint32_t i = 0; s->track_of && i < count; ++i)
        s->track_of[weight_track[i].node] = &weight_track[i];
    return s->track_of != NULL;
}

int gltf_shapes(struct model_motion *inout, const gltf_tree *t, gltf *g, const uint32_t *place,
                const model_track *weight_track, uint32_t weight_tracks)
{
    struct model_shapes *out = (struct model_shapes *)build_keep(g->b, 1, sizeof *out);
    uint8_t *reshapes = (uint8_t *)build_keep(g->b, g->b->instance_count, 1);
    shaping s;
    uint32_t bare;
    memset(&s, 0, sizeof s);
    s.g = g;
    s.tree = t;
    s.motion = inout;
    s.place = place;
    if (!out || !reshapes || !find_tracks(&s, weight_track, weight_tracks) || !count_shapes(&bare, out, reshapes, &s))
        return 0;
    if (out->count == 0)
        return 1;
    out->shape = (model_shape *)build_keep(g->b, out->count, sizeof *out->shape);
    if (!out->shape || (bare > 0 && !add_room(g->b, bare)) || !make_shapes(out, &s, reshapes))
        return 0;
    inout->shapes = out;
    inout->reshapes = reshapes;
    return 1;
}
