/* io_gltf_morph.c: morph targets: shapes a mesh by the default weights, or by those of a node. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

static const char *const names[MODEL_MORPH_STREAMS] = {"POSITION", "NORMAL", "TANGENT"};

/* Reads `targets` weights from the node, or from the mesh if the node has none or is JSON_NONE. Weights missing in the
 * file are 0. Returns NULL with the report set on failure. */
static double *read_weights(gltf *g, uint32_t mesh, uint32_t node, uint32_t targets)
{
    const uint32_t own = json_member(&g->doc, node, "weights"),
                   list = own != JSON_NONE ? own : json_member(&g->doc, mesh, "weights");
    double *weights = (double *)build_scratch(g->b, targets, sizeof *weights);
    uint32_t at = json_first(&g->doc, list), i;
    for (i = 0; weights && i < targets && at != JSON_NONE; ++i, at = json_next(&g->doc, at))
        if (!json_read_double(&weights[i], &g->doc, at, g->b->r))
            return NULL;
    return weights;
}

/* Reads the offsets that a target adds to one stream. *out is NULL if there are none. */
static int read_stream(const float **out, gltf *g, uint32_t reference, uint32_t vertices)
{
    gltf_accessor a;
    uint32_t index;
    *out = NULL;
    if (!gltf_attribute(&a, &index, g, reference, 3, 3, vertices))
        return 0;
    return index == JSON_NONE || (*out = gltf_floats(g, &a)) != NULL;
}

/* Targets may also change colours and texture coordinates. Support for that is optional in glTF. */
static int has_more(const gltf *g, uint32_t target)
{
    uint32_t known = 0;
    for (int i = 0; i < MODEL_MORPH_STREAMS; ++i)
        known += json_member(&g->doc, target, names[i]) != JSON_NONE;
    return json_count(&g->doc, target) > known;
}

int gltf_morph_read(model_morph *out, gltf *g, uint32_t primitive, const lmb_mesh *mesh, const double *weights)
{
    const uint32_t targets = json_member(&g->doc, primitive, "targets");
    uint32_t target = json_first(&g->doc, targets), i;
    int more = 0;
    memset(out, 0, sizeof *out);
    out->vertices = mesh->vertex_count;
    out->targets = json_count(&g->doc, targets);
    out->positions = (const float *)mesh->positions;
    out->normals = mesh->normals;
    out->tangents = mesh->tangents;
    for (int k = 0; k < MODEL_MORPH_STREAMS; ++k) {
        out->add[k] = (const float **)build_scratch(g->b, out->targets, sizeof *out->add[k]);
        if (!out->add[k])
            return 0;
    }
    for (i = 0; i < out->targets; ++i, target = json_next(&g->doc, target)) {
        if (weights && weights[i] == 0)
            continue;
        more |= has_more(g, target);
        for (int k = 0; k < MODEL_MORPH_STREAMS; ++k)
            if ((k != MODEL_MORPH_NORMAL || out->normals) && (k != MODEL_MORPH_TANGENT || out->tangents) &&
                !read_stream(&out->add[k][i], g, json_member(&g->doc, target, names[k]), out->vertices))
                return 0;
    }
    g->left_out.odd_morphs += (uint32_t)more;
    return 1;
}

/* Gives the mesh new streams and applies the targets to them. */
static int shape(lmb_mesh *m, gltf *g, const model_morph *morph, const double *weights)
{
    const uint64_t n = morph->vertices;
    float *positions = (float *)build_keep(g->b, 3 * n, sizeof *positions);
    int16_t *normals = morph->normals ? (int16_t *)build_keep(g->b, 2 * n, sizeof *normals) : NULL;
    int16_t *tangents = morph->tangents ? (int16_t *)build_keep(g->b, 2 * n, sizeof *tangents) : NULL;
    if (!positions || (morph->normals && !normals) || (morph->tangents && !tangents))
        return 0;
    model_morph_pose(positions, normals, tangents, morph, weights);
    m->positions = positions;
    m->normals = normals;
    m->tangents = tangents;
    return 1;
}

static int is_any(const double *weights, uint32_t count)
{
    uint32_t i;
    for (i = 0; i < count && weights[i] == 0; ++i)
        continue;
    return i < count;
}

int gltf_morph(lmb_mesh *inout, gltf *g, uint32_t mesh, uint32_t primitive, uint32_t node)
{
    const uint32_t targets = json_count(&g->doc, json_member(&g->doc, primitive, "targets"));
    model_morph morph;
    double *weights;
    if (targets == 0)
        return 1;
    weights = read_weights(g, mesh, node, targets);
    if (!weights)
        return 0;
    if (!is_any(weights, targets))
        return 1;
    return gltf_morph_read(&morph, g, primitive, inout, weights) && shape(inout, g, &morph, weights);
}
