/* io_gltf_skin.c: poses skinned meshes once, with the joints as the nodes place them: the state before any animation,
 * which is the bind pose if the nodes still have it. The transform of the skinned node itself does not count (glTF 2.0,
 * 3.7.3), so posed meshes are in world metres. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

enum { MAX_SETS = 8 }; /* of four joints: limits the posing time, which stream bytes do not */

/* The joints of a skin: world x inverse bind, column-major. */
typedef struct skin {
    gltf_matrix *joints;
    uint32_t count;
} skin;

static int read_bind(skin *s, gltf *g, uint32_t node)
{
    const uint32_t reference = json_member(&g->doc, node, "inverseBindMatrices");
    gltf_accessor a;
    float *values;
    uint32_t accessor, i, k;
    if (reference == JSON_NONE)
        return 1;
    if (!gltf_item(&accessor, g, &g->accessors, reference) || !gltf_accessor_open(&a, g, accessor))
        return 0;
    if (a.components != 16 || a.component != GLTF_F32 || a.count < s->count)
        return json_fail(&g->doc, reference, g->b->r, "needs a MAT4 of floats for each of the %u joints",
                         (unsigned)s->count);
    values = gltf_floats(g, &a);
    if (!values)
        return 0;
    for (i = 0; i < s->count; ++i) {
        const gltf_matrix world = s->joints[i];
        gltf_matrix bind;
        for (k = 0; k < 16; ++k)
            bind.m[k] = (double)values[16 * (size_t)i + k];
        gltf_multiply(&s->joints[i], &world, &bind);
    }
    return 1;
}

static int read_skin(skin *s, gltf *g, const gltf_tree *t, uint32_t node)
{
    const uint32_t joints = json_member(&g->doc, node, "joints");
    uint32_t at, joint;
    s->count = 0;
    s->joints = (gltf_matrix *)build_scratch(g->b, json_count(&g->doc, joints), sizeof *s->joints);
    if (!s->joints)
        return 0;
    for (at = json_first(&g->doc, joints); at != JSON_NONE; at = json_next(&g->doc, at)) {
        if (!gltf_index(&joint, g, &g->nodes, at))
            return 0;
        if (!t->placed[joint])
            return json_fail(&g->doc, at, g->b->r, "joint %u is not in the scene that it moves", (unsigned)joint);
        s->joints[s->count++] = t->world[joint];
    }
    if (s->count == 0)
        return json_fail(&g->doc, node, g->b->r, "a skin without joints; export the file again");
    return read_bind(s, g, node);
}

/* Reads JOINTS_n and WEIGHTS_n from 0 on, until one is missing; once per primitive. */
static int read_influences(gltf_influences *out, gltf *g, uint32_t attributes, uint32_t vertices)
{
    if (out->joints)
        return 1;
    out->joints = (float **)build_scratch(g->b, MAX_SETS, sizeof *out->joints);
    out->weights = (float **)build_scratch(g->b, MAX_SETS, sizeof *out->weights);
    if (!out->joints || !out->weights)
        return 0;
    for (out->sets = 0;; ++out->sets) {
        char joints[24], weights[24];
        gltf_accessor j, w;
        uint32_t has_joints, has_weights;
        snprintf(joints, sizeof joints, "JOINTS_%u", (unsigned)out->sets);
        snprintf(weights, sizeof weights, "WEIGHTS_%u", (unsigned)out->sets);
        if (!gltf_attribute(&j, &has_joints, g, json_member(&g->doc, attributes, joints), 4, 4, vertices) ||
            !gltf_attribute(&w, &has_weights, g, json_member(&g->doc, attributes, weights), 4, 4, vertices))
            return 0;
        if (has_joints == JSON_NONE || has_weights == JSON_NONE)
            return 1;
        if (out->sets == MAX_SETS)
            return json_fail(&g->doc, attributes, g->b->r, "more than %d joints at a vertex; export with fewer",
                             4 * MAX_SETS);
        j.normalized = 0;
        out->joints[out->sets] = gltf_floats(g, &j);
        out->weights[out->sets] = gltf_floats(g, &w);
        if (!out->joints[out->sets] || !out->weights[out->sets])
            return 0;
    }
    return 1;
}

/* Two skins may share a primitive, so the joints are checked for each. */
static int check_joints(const gltf *g, const gltf_influences *in, uint32_t primitive, const skin *s, uint32_t vertices)
{
    uint32_t set;
    uint64_t i;
    for (set = 0; set < in->sets; ++set)
        for (i = 0; i < 4 * (uint64_t)vertices; ++i) {
            const float joint = in->joints[set][i];
            if (!(joint >= 0.0f && joint < (float)s->count))
                return json_fail(&g->doc, primitive, g->b->r,
                                 "joint %g at vertex %u, but the skin has %u; export again", (double)joint,
                                 (unsigned)(i / 4), (unsigned)s->count);
        }
    return 1;
}

/* The weighted mean of the joint matrices at a vertex; without weights, the first joint. */
static gltf_matrix blend(const gltf_influences *in, const skin *s, uint32_t vertex)
{
    gltf_matrix sum = {{0}};
    double total = 0;
    uint32_t set, i, k;
    for (set = 0; set < in->sets; ++set)
        for (i = 0; i < 4; ++i) {
            const size_t at = 4 * (size_t)vertex + i;
            const double weight = (double)in->weights[set][at];
            const gltf_matrix *joint = &s->joints[(uint32_t)in->joints[set][at]];
            if (!(weight > 0 && weight < 1e30))
                continue;
            total += weight;
            for (k = 0; k < 16; ++k)
                sum.m[k] += weight * joint->m[k];
        }
    if (!(total > 0))
        return s->joints[0];
    for (k = 0; k < 16; ++k)
        sum.m[k] /= total;
    return sum;
}

/* Cofactors of the upper 3x3, for normals: correct if a joint scales unevenly. */
static gltf_matrix cofactors(const gltf_matrix *a)
{
    gltf_matrix c = {{0}};
    int i;
    for (i = 0; i < 3; ++i) {
        const double *p = a->m + 4 * ((i + 1) % 3), *q = a->m + 4 * ((i + 2) % 3);
        c.m[4 * i] = p[1] * q[2] - p[2] * q[1];
        c.m[4 * i + 1] = p[2] * q[0] - p[0] * q[2];
        c.m[4 * i + 2] = p[0] * q[1] - p[1] * q[0];
    }
    return c;
}

/* The upper 3x3 times v, normalized; v if the product has no length. */
static lmb_vec3 turn(const gltf_matrix *a, lmb_vec3 v)
{
    const double x = (double)v.x, y = (double)v.y, z = (double)v.z, *m = a->m;
    const double rx = m[0] * x + m[4] * y + m[8] * z, ry = m[1] * x + m[5] * y + m[9] * z,
                 rz = m[2] * x + m[6] * y + m[10] * z, d = sqrt(rx * rx + ry * ry + rz * rz);
    if (!(d > 1e-30 && d < 1e30))
        return v;
    v.x = (float)(rx / d);
    v.y = (float)(ry / d);
    v.z = (float)(rz / d);
    return v;
}

/* A new stream with each octahedral vector turned by the matrix of the vertex; NULL with the report set. */
static int16_t *pose_vectors(gltf *g, const int16_t *from, const gltf_influences *in, const skin *s, uint32_t count,
                             int normals)
{
    int16_t *to = (int16_t *)build_keep(g->b, (uint64_t)count * 2, sizeof *to);
    uint32_t i;
    for (i = 0; to && i < count; ++i) {
        gltf_matrix joint = blend(in, s, i);
        if (from[2 * (size_t)i] == BUILD_NO_NORMAL) {
            memcpy(to + 2 * (size_t)i, from + 2 * (size_t)i, 2 * sizeof *to);
            continue;
        }
        if (normals)
            joint = cofactors(&joint);
        lmb_octahedral_encode(to + 2 * (size_t)i, turn(&joint, lmb_octahedral_decode(from + 2 * (size_t)i)));
        if (!normals)
            model_set_side(to + 2 * (size_t)i, model_side_of(from + 2 * (size_t)i));
    }
    return to;
}

static float *pose_positions(gltf *g, const float *from, const gltf_influences *in, const skin *s, uint32_t count)
{
    float *to = (float *)build_keep(g->b, (uint64_t)count * 3, sizeof *to);
    uint32_t i, k;
    for (i = 0; to && i < count; ++i) {
        const gltf_matrix joint = blend(in, s, i);
        const float *p = from + 3 * (size_t)i;
        for (k = 0; k < 3; ++k)
            to[3 * (size_t)i + k] = (float)(joint.m[k] * (double)p[0] + joint.m[4 + k] * (double)p[1] +
                                            joint.m[8 + k] * (double)p[2] + joint.m[12 + k]);
    }
    return to;
}

/* A primitive without influences follows the first joint. `in` is read once for all meshes of the primitive. */
static int pose_mesh(gltf *g, lmb_mesh *out, gltf_influences *in, uint32_t primitive, const skin *s)
{
    const uint32_t n = out->vertex_count;
    if (!read_influences(in, g, json_member(&g->doc, primitive, "attributes"), n) ||
        !check_joints(g, in, primitive, s, n))
        return 0;
    out->positions = pose_positions(g, (const float *)out->positions, in, s, n);
    if (!out->positions)
        return 0;
    if (out->normals && !(out->normals = pose_vectors(g, out->normals, in, s, n, 1)))
        return 0;
    return !out->tangents || (out->tangents = pose_vectors(g, out->tangents, in, s, n, 0));
}

int gltf_pose(gltf *g, const gltf_tree *t, uint32_t node, uint32_t mesh, uint32_t first)
{
    skin s;
    uint32_t i, index;
    if (!gltf_item(&index, g, &g->skins, json_member(&g->doc, node, "skin")) || !read_skin(&s, g, t, index))
        return 0;
    for (i = 0; i < g->mesh_size[mesh]; ++i) {
        const uint32_t from = g->mesh_first[mesh] + i;
        if (!pose_mesh(g, &g->b->meshes[first + i], &g->mesh_influences[from], g->mesh_primitive[from], &s))
            return 0;
    }
    return 1;
}
