/* io_gltf.c: reads glTF 2.0: version and extensions, the node tree, instances, cameras, punctual lights, notes. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

/* Column-major, as glTF's; composed in double, so that deep trees lose nothing before binary32. */
typedef struct matrix {
    double m[16];
} matrix;

/* The part of the document that is drawn: nodes in drawing order, each with its way to the world. */
typedef struct tree {
    uint32_t *order; /* parents before children */
    uint32_t count;
    uint32_t *parent; /* by node; JSON_NONE: a root */
    matrix *world;    /* by node */
} tree;

static int check_version(gltf *g)
{
    const uint32_t asset = json_member(&g->doc, 0, "asset");
    char version[16];
    json_string(version, sizeof version, &g->doc, json_member(&g->doc, asset, "version"));
    if (strncmp(version, "2.", 2) == 0)
        return 1;
    return json_fail(&g->doc, asset, g->b->r, "version is not 2.x; export as glTF 2.0");
}

/* MODEL_EXTENSION_: what becomes of the extension of this name. */
static int extension_use(const gltf *g, uint32_t name)
{
    static const struct {
        const char *name;
        int use;
    } known[] = {{"KHR_lights_punctual", MODEL_EXTENSION_READ},
                 {"KHR_texture_transform", MODEL_EXTENSION_FOLDED},
                 {"KHR_materials_unlit", MODEL_EXTENSION_FOLDED},
                 {"KHR_mesh_quantization", MODEL_EXTENSION_READ}};
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i)
        if (json_equals(&g->doc, name, known[i].name))
            return known[i].use;
    return MODEL_EXTENSION_IGNORED;
}

/* Each name of a list once among the facts: of the required ones, which come first, and of those used. */
static void list_extensions(gltf *g, uint32_t list, int required)
{
    model_facts *facts = &g->b->out->facts;
    const uint32_t room = sizeof facts->extensions / sizeof facts->extensions[0];
    model_extension one;
    uint32_t i, k;
    for (i = json_first(&g->doc, list); i != JSON_NONE; i = json_next(&g->doc, i)) {
        memset(&one, 0, sizeof one);
        json_string(one.name, sizeof one.name, &g->doc, i);
        one.use = extension_use(g, i);
        one.required = required;
        for (k = 0; k < facts->extension_count && strcmp(facts->extensions[k].name, one.name) != 0; ++k)
            continue;
        if (k == room)
            ++facts->extension_more;
        else if (k == facts->extension_count)
            facts->extensions[facts->extension_count++] = one;
    }
}

/* Required and unknown is an error; used and unknown a note. */
static int check_extensions(gltf *g)
{
    const uint32_t required = json_member(&g->doc, 0, "extensionsRequired"),
                   used = json_member(&g->doc, 0, "extensionsUsed");
    char name[64];
    uint32_t i;
    for (i = json_first(&g->doc, required); i != JSON_NONE; i = json_next(&g->doc, i)) {
        if (extension_use(g, i) != MODEL_EXTENSION_IGNORED)
            continue;
        json_string(name, sizeof name, &g->doc, i);
        return json_fail(&g->doc, i, g->b->r, "requires %s, which lambent does not read; export without it", name);
    }
    for (i = json_first(&g->doc, used); i != JSON_NONE; i = json_next(&g->doc, i)) {
        if (extension_use(g, i) != MODEL_EXTENSION_IGNORED)
            continue;
        json_string(name, sizeof name, &g->doc, i);
        build_note(g->b, "extension %s is ignored", name);
    }
    list_extensions(g, required, 1);
    list_extensions(g, used, 0);
    return 1;
}

/* Fill parent[] from everyone's children; two parents are an error. */
static int find_parents(tree *t, gltf *g)
{
    uint32_t i, c, child;
    for (i = 0; i < g->nodes.count; ++i)
        t->parent[i] = JSON_NONE;
    for (i = 0; i < g->nodes.count; ++i) {
        const uint32_t children = json_member(&g->doc, g->nodes.items[i], "children");
        for (c = json_first(&g->doc, children); c != JSON_NONE; c = json_next(&g->doc, c)) {
            if (!gltf_index(&child, g, &g->nodes, c))
                return 0;
            if (t->parent[child] != JSON_NONE)
                return json_fail(&g->doc, c, g->b->r, "node %u already is a child of node %u; a node has one parent",
                                 (unsigned)child, (unsigned)t->parent[child]);
            t->parent[child] = i;
        }
    }
    return 1;
}

/* Append a node, once: with one parent each, only a root named twice could come again. */
static int push_root(uint32_t *stack, uint32_t *depth, const tree *t, const gltf *g, uint32_t reference, uint8_t *seen)
{
    uint32_t root;
    if (!gltf_index(&root, g, &g->nodes, reference))
        return 0;
    if (t->parent[root] != JSON_NONE)
        return json_fail(&g->doc, reference, g->b->r, "node %u is a child of node %u, not a root; export again",
                         (unsigned)root, (unsigned)t->parent[root]);
    if (seen[root])
        return json_fail(&g->doc, reference, g->b->r, "node %u stands there twice", (unsigned)root);
    seen[root] = 1;
    stack[(*depth)++] = root;
    return 1;
}

/* The stack's part from `from` on, turned round, so that the first comes off first. */
static void reverse(uint32_t *stack, uint32_t from, uint32_t to)
{
    while (to - from > 1) {
        const uint32_t swap = stack[from];
        stack[from++] = stack[--to];
        stack[to] = swap;
    }
}

/* The roots of the default scene, else of the first, else all there are. */
static int push_roots(uint32_t *stack, uint32_t *depth, const tree *t, gltf *g, uint8_t *seen)
{
    gltf_list scenes;
    uint32_t scene, i;
    if (!gltf_list_of(&scenes, g, json_member(&g->doc, 0, "scenes")) ||
        !gltf_item(&scene, g, &scenes, json_member(&g->doc, 0, "scene")))
        return 0;
    if (scenes.count == 0) {
        for (i = 0; i < g->nodes.count; ++i)
            if (t->parent[i] == JSON_NONE)
                stack[(*depth)++] = i;
    } else {
        const uint32_t nodes = json_member(&g->doc, scene == JSON_NONE ? scenes.items[0] : scene, "nodes");
        for (i = json_first(&g->doc, nodes); i != JSON_NONE; i = json_next(&g->doc, i))
            if (!push_root(stack, depth, t, g, i, seen))
                return 0;
    }
    reverse(stack, 0, *depth);
    return 1;
}

/* A node on a cycle has a parent, and so has every other one on it: no root leads there. Walk up from each node with
 * a mark; meeting the own mark again is a cycle, whether it is drawn or not. */
static int refuse_cycles(const tree *t, gltf *g)
{
    uint32_t *mark = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *mark), i, up;
    if (!mark)
        return 0;
    for (i = 0; i < g->nodes.count; ++i) {
        for (up = i; up != JSON_NONE && mark[up] == 0; up = t->parent[up])
            mark[up] = i + 1;
        if (up != JSON_NONE && mark[up] == i + 1)
            return json_fail(&g->doc, g->nodes.items[up], g->b->r, "is its own ancestor; export the file again");
    }
    return 1;
}

/* Depth first, children in their order. Each node is pushed once, so the stack needs one slot a node. */
static int walk(tree *t, gltf *g)
{
    uint32_t *stack = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *stack), depth = 0, from, c, child;
    uint8_t *seen = (uint8_t *)build_scratch(g->b, g->nodes.count, 1);
    if (!stack || !seen || !find_parents(t, g) || !refuse_cycles(t, g) || !push_roots(stack, &depth, t, g, seen))
        return 0;
    while (depth > 0) {
        const uint32_t node = stack[--depth];
        const uint32_t children = json_member(&g->doc, g->nodes.items[node], "children");
        t->order[t->count++] = node;
        from = depth;
        for (c = json_first(&g->doc, children); c != JSON_NONE; c = json_next(&g->doc, c)) {
            if (!gltf_index(&child, g, &g->nodes, c))
                return 0;
            stack[depth++] = child;
        }
        reverse(stack, from, depth);
    }
    return 1;
}

/* Translation * rotation * scale; the quaternion x, y, z, w is normalised first. */
static int compose(matrix *out, const double t[3], const double q[4], const double s[3])
{
    const double d = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double x, y, z, w;
    int i;
    if (!(d > 1e-12))
        return 0;
    x = q[0] / d, y = q[1] / d, z = q[2] / d, w = q[3] / d;
    out->m[0] = 1 - 2 * (y * y + z * z), out->m[1] = 2 * (x * y + z * w), out->m[2] = 2 * (x * z - y * w);
    out->m[4] = 2 * (x * y - z * w), out->m[5] = 1 - 2 * (x * x + z * z), out->m[6] = 2 * (y * z + x * w);
    out->m[8] = 2 * (x * z + y * w), out->m[9] = 2 * (y * z - x * w), out->m[10] = 1 - 2 * (x * x + y * y);
    for (i = 0; i < 3; ++i) {
        out->m[i] *= s[0];
        out->m[4 + i] *= s[1];
        out->m[8 + i] *= s[2];
        out->m[12 + i] = t[i];
    }
    out->m[3] = out->m[7] = out->m[11] = 0;
    out->m[15] = 1;
    return 1;
}

static int local_matrix(matrix *out, gltf *g, uint32_t node)
{
    const json *doc = &g->doc;
    const uint32_t whole = json_member(doc, node, "matrix");
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (whole != JSON_NONE) {
        if (!json_read_doubles(out->m, 16, doc, whole, g->b->r))
            return 0;
        if (out->m[3] != 0 || out->m[7] != 0 || out->m[11] != 0 || out->m[15] != 1)
            return json_fail(doc, whole, g->b->r, "the last row must be 0 0 0 1");
        return 1;
    }
    if (!json_read_doubles(t, 3, doc, json_member(doc, node, "translation"), g->b->r) ||
        !json_read_doubles(q, 4, doc, json_member(doc, node, "rotation"), g->b->r) ||
        !json_read_doubles(s, 3, doc, json_member(doc, node, "scale"), g->b->r))
        return 0;
    if (!compose(out, t, q, s))
        return json_fail(doc, node, g->b->r, "rotation is no quaternion (its length is 0)");
    return 1;
}

static void multiply(matrix *out, const matrix *a, const matrix *b)
{
    int row, column;
    for (column = 0; column < 4; ++column)
        for (row = 0; row < 4; ++row)
            out->m[4 * column + row] = a->m[row] * b->m[4 * column] + a->m[4 + row] * b->m[4 * column + 1] +
                                       a->m[8 + row] * b->m[4 * column + 2] + a->m[12 + row] * b->m[4 * column + 3];
}

/* The world matrix of every drawn node; each must fit binary32. */
static int place_nodes(tree *t, gltf *g)
{
    uint32_t i, k;
    for (i = 0; i < t->count; ++i) {
        const uint32_t node = t->order[i], up = t->parent[node];
        matrix local;
        if (!local_matrix(&local, g, g->nodes.items[node]))
            return 0;
        if (up == JSON_NONE)
            t->world[node] = local;
        else
            multiply(&t->world[node], &t->world[up], &local);
        for (k = 0; k < 16; ++k)
            if (!(fabs(t->world[node].m[k]) <= (double)FLT_MAX))
                return json_fail(&g->doc, g->nodes.items[node], g->b->r, "its place in the world is not finite");
    }
    return 1;
}

static lmb_vec3 to_vec3(double x, double y, double z)
{
    lmb_vec3 v;
    v.x = (float)x;
    v.y = (float)y;
    v.z = (float)z;
    return v;
}

/* v to length 1; 0 where it has none. */
static int normalize(double v[3])
{
    const double d = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(d > 1e-30 && d < 1e30))
        return 0;
    v[0] /= d;
    v[1] /= d;
    v[2] /= d;
    return 1;
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Make the meshes that drawn nodes show, then one instance a node and primitive. */
static int add_instances(const tree *t, gltf *g)
{
    uint64_t total = 0;
    uint32_t i, k, c, mesh;
    lmb_instance *to;
    for (i = 0; i < t->count; ++i) {
        const uint32_t node = g->nodes.items[t->order[i]];
        if (!gltf_index(&mesh, g, &g->meshes, json_member(&g->doc, node, "mesh")))
            return 0;
        if (mesh == JSON_NONE)
            continue;
        if (!gltf_mesh(g, mesh))
            return 0;
        total += g->mesh_size[mesh];
        g->left_out.skins += json_member(&g->doc, node, "skin") != JSON_NONE;
    }
    if (total > UINT32_MAX / sizeof *to)
        return report_fail(g->b->r, "%s: too many instances", g->b->path);
    to = g->b->instances = (lmb_instance *)build_keep(g->b, total, sizeof *to);
    if (!to)
        return 0;
    for (i = 0; i < t->count; ++i) {
        const matrix *world = &t->world[t->order[i]];
        if (!gltf_index(&mesh, g, &g->meshes, json_member(&g->doc, g->nodes.items[t->order[i]], "mesh")))
            return 0;
        for (k = 0; mesh != JSON_NONE && k < g->mesh_size[mesh]; ++k, ++to) {
            for (c = 0; c < 16; ++c)
                to->to_world.m[c] = (float)world->m[c];
            to->mesh = g->mesh_first[mesh] + k;
            to->material = g->mesh_material[to->mesh];
        }
    }
    g->b->instance_count = (uint32_t)total;
    return 1;
}

static int spot_cone(lmb_light *out, gltf *g, uint32_t light)
{
    const json *doc = &g->doc;
    const uint32_t spot = json_member(doc, light, "spot");
    double inner = 0, outer = 0.78539816339744831; /* pi / 4 */
    if (!json_read_double(&inner, doc, json_member(doc, spot, "innerConeAngle"), g->b->r) ||
        !json_read_double(&outer, doc, json_member(doc, spot, "outerConeAngle"), g->b->r))
        return 0;
    if (!(inner >= 0 && inner <= outer && outer > 0 && outer < 1.5709))
        return json_fail(doc, spot, g->b->r, "needs 0 <= innerConeAngle <= outerConeAngle <= pi / 2");
    out->kind = LMB_LIGHT_SPOT;
    out->cos_inner = (float)cos(inner);
    out->cos_outer = (float)cos(outer);
    return 1;
}

static int light_kind(lmb_light *out, gltf *g, uint32_t light)
{
    const uint32_t type = json_member(&g->doc, light, "type");
    out->kind = LMB_LIGHT_POINT;
    out->cos_inner = 1.0f;
    out->cos_outer = 0.0f;
    if (json_equals(&g->doc, type, "spot"))
        return spot_cone(out, g, light);
    if (json_equals(&g->doc, type, "directional")) {
        out->kind = LMB_LIGHT_DIRECTIONAL;
        return 1;
    }
    return json_equals(&g->doc, type, "point") ||
           json_fail(&g->doc, light, g->b->r, "type must be point, spot or directional");
}

/* A light of the document placed by a node: it shines along the node's -Z. */
static int read_light(lmb_light *out, gltf *g, uint32_t light, const matrix *world, uint32_t node)
{
    const json *doc = &g->doc;
    double colour[3] = {1, 1, 1}, intensity = 1, way[3];
    int i;
    memset(out, 0, sizeof *out);
    if (!light_kind(out, g, light) || !json_read_doubles(colour, 3, doc, json_member(doc, light, "color"), g->b->r) ||
        !json_read_double(&intensity, doc, json_member(doc, light, "intensity"), g->b->r))
        return 0;
    for (i = 0; i < 3; ++i) {
        const double value = colour[i] * intensity;
        if (!(value >= 0 && value <= 1e30))
            return json_fail(doc, light, g->b->r, "color x intensity is no intensity");
        out->intensity[i] = (float)value;
        way[i] = -world->m[8 + i];
    }
    if (!normalize(way)) {
        if (out->kind != LMB_LIGHT_POINT)
            return json_fail(doc, node, g->b->r, "its light has no direction: the node's scale is 0");
        way[2] = -1; /* a point light has no use for it; the scene wants unit length */
        way[0] = way[1] = 0;
    }
    out->direction = to_vec3(way[0], way[1], way[2]);
    out->position = to_vec3(world->m[12], world->m[13], world->m[14]);
    g->left_out.ranges += json_member(doc, light, "range") != JSON_NONE;
    return 1;
}

static uint32_t light_reference(const gltf *g, uint32_t node)
{
    const uint32_t extensions = json_member(&g->doc, node, "extensions");
    return json_member(&g->doc, json_member(&g->doc, extensions, "KHR_lights_punctual"), "light");
}

static int add_lights(const tree *t, gltf *g)
{
    const uint32_t extensions = json_member(&g->doc, 0, "extensions");
    uint32_t i, light, total = 0;
    if (!gltf_list_of(&g->lights, g,
                      json_member(&g->doc, json_member(&g->doc, extensions, "KHR_lights_punctual"), "lights")))
        return 0;
    for (i = 0; i < t->count; ++i)
        total += light_reference(g, g->nodes.items[t->order[i]]) != JSON_NONE;
    g->b->lights = (lmb_light *)build_keep(g->b, total, sizeof *g->b->lights);
    if (!g->b->lights)
        return 0;
    for (i = 0; i < t->count; ++i) {
        const uint32_t index = t->order[i], node = g->nodes.items[index];
        if (!gltf_item(&light, g, &g->lights, light_reference(g, node)))
            return 0;
        if (light == JSON_NONE)
            continue;
        if (!read_light(&g->b->lights[g->b->light_count++], g, light, &t->world[index], node))
            return 0;
    }
    return 1;
}

/* Orthonormal axes of a node: back along its Z, up as near its Y as that allows; scale and mirroring drop out. */
static int camera_axes(model_camera *out, gltf *g, const matrix *world, uint32_t node)
{
    double right[3], up[3], back[3];
    int i;
    for (i = 0; i < 3; ++i) {
        up[i] = world->m[4 + i];
        back[i] = world->m[8 + i];
    }
    cross(right, up, back);
    if (!normalize(back) || !normalize(right))
        return json_fail(&g->doc, node, g->b->r, "its camera has no direction: the node's scale is 0");
    cross(up, back, right);
    out->eye = to_vec3(world->m[12], world->m[13], world->m[14]);
    out->right = to_vec3(right[0], right[1], right[2]);
    out->up = to_vec3(up[0], up[1], up[2]);
    out->back = to_vec3(back[0], back[1], back[2]);
    return 1;
}

/* Above 0, and so in binary32. */
static int is_length(double v) { return v > 1e-30 && v < 1e30; }

static int read_perspective(model_camera *out, gltf *g, uint32_t camera)
{
    const json *doc = &g->doc;
    double yfov = 0, aspect = 0, near_m = 0, far_m = 0;
    if (!json_read_double(&yfov, doc, json_member(doc, camera, "yfov"), g->b->r) ||
        !json_read_double(&aspect, doc, json_member(doc, camera, "aspectRatio"), g->b->r) ||
        !json_read_double(&near_m, doc, json_member(doc, camera, "znear"), g->b->r) ||
        !json_read_double(&far_m, doc, json_member(doc, camera, "zfar"), g->b->r))
        return 0;
    if (!(yfov > 1e-6 && yfov < 3.14159) || !is_length(near_m) || (aspect != 0 && !is_length(aspect)) ||
        (far_m != 0 && !(is_length(far_m) && far_m > near_m)))
        return json_fail(doc, camera, g->b->r, "needs 0 < yfov < pi, znear > 0, zfar > znear, aspectRatio > 0");
    out->yfov_rad = (float)yfov;
    out->aspect = (float)aspect;
    out->near_m = (float)near_m;
    out->far_m = (float)far_m;
    return 1;
}

static int read_orthographic(model_camera *out, gltf *g, uint32_t camera)
{
    const json *doc = &g->doc;
    double xmag = 0, ymag = 0, near_m = 0, far_m = 0;
    if (!json_read_double(&xmag, doc, json_member(doc, camera, "xmag"), g->b->r) ||
        !json_read_double(&ymag, doc, json_member(doc, camera, "ymag"), g->b->r) ||
        !json_read_double(&near_m, doc, json_member(doc, camera, "znear"), g->b->r) ||
        !json_read_double(&far_m, doc, json_member(doc, camera, "zfar"), g->b->r))
        return 0;
    if (!is_length(fabs(xmag)) || !is_length(fabs(ymag)) || !(near_m >= 0) || !is_length(far_m) || !(far_m > near_m))
        return json_fail(doc, camera, g->b->r, "needs xmag and ymag other than 0, 0 <= znear < zfar");
    out->orthographic = 1;
    out->half_width = (float)fabs(xmag);
    out->half_height = (float)fabs(ymag);
    out->aspect = (float)fabs(xmag / ymag);
    out->near_m = (float)near_m;
    out->far_m = (float)far_m;
    return 1;
}

/* Named as the node that places it, else as the camera itself, else by its number. */
static int read_camera(model_camera *out, gltf *g, uint32_t camera, const matrix *world, uint32_t node)
{
    const json *doc = &g->doc;
    const uint32_t flat = json_member(doc, camera, "orthographic"), deep = json_member(doc, camera, "perspective");
    if (json_string(out->name, sizeof out->name, doc, json_member(doc, node, "name")) == 0 &&
        json_string(out->name, sizeof out->name, doc, json_member(doc, camera, "name")) == 0)
        snprintf(out->name, sizeof out->name, "camera %u", (unsigned)g->b->out->camera_count);
    if (!camera_axes(out, g, world, node))
        return 0;
    if (json_equals(doc, json_member(doc, camera, "type"), "orthographic") && flat != JSON_NONE)
        return read_orthographic(out, g, flat);
    if (json_equals(doc, json_member(doc, camera, "type"), "perspective") && deep != JSON_NONE)
        return read_perspective(out, g, deep);
    return json_fail(doc, camera, g->b->r, "type must be perspective or orthographic, with the object of that name");
}

static int add_cameras(const tree *t, gltf *g)
{
    uint32_t i, camera, total = 0;
    model *out = g->b->out;
    for (i = 0; i < t->count; ++i)
        total += json_member(&g->doc, g->nodes.items[t->order[i]], "camera") != JSON_NONE;
    out->cameras = (model_camera *)build_keep(g->b, total, sizeof *out->cameras);
    if (!out->cameras)
        return 0;
    for (i = 0; i < t->count; ++i) {
        const uint32_t index = t->order[i], node = g->nodes.items[index];
        if (!gltf_item(&camera, g, &g->cameras, json_member(&g->doc, node, "camera")))
            return 0;
        if (camera == JSON_NONE)
            continue;
        if (!read_camera(&out->cameras[out->camera_count], g, camera, &t->world[index], node))
            return 0;
        ++out->camera_count;
    }
    return 1;
}

static void note_count(gltf *g, const char *what, uint32_t count)
{
    if (count)
        build_note(g->b, "%s: %u", what, (unsigned)count);
}

/* What a reader of the picture should know. */
static void tell_left_out(gltf *g)
{
    const gltf_counts *n = &g->left_out;
    if (n->textures)
        build_note(g->b, "textures left out, plain colour instead: %u (first: %.120s)", (unsigned)n->textures,
                   g->texture_error.text);
    note_count(g, "primitives of points or lines skipped", n->points_lines);
    note_count(g, "primitives without POSITION skipped", n->without_positions);
    note_count(g, "primitives with vertices left over, which are dropped", n->ragged);
    note_count(g, "primitives without a material, drawn white", n->bare);
    note_count(g, "normals without length, set to +Y", n->zero_normals);
    note_count(g, "BLEND materials drawn as MASK with cutoff 0.5", n->blends);
    note_count(g, "metallic materials, nearly black without a glossy lobe", n->metals);
    note_count(g, "metallic maps used by their mean, 0 where one cannot be read", n->metal_maps);
    note_count(g, "unlit materials treated as Lambertian", n->unlit);
    note_count(g, "emissive materials, which do not emit", n->emissive);
    note_count(g, "materials with normal or occlusion maps, which are ignored", n->other_maps);
    note_count(g, "light ranges ignored", n->ranges);
    note_count(g, "skinned nodes in their bind pose", n->skins);
    note_count(g, "primitives with morph targets, which are ignored", n->morphs);
    note_count(g, "animations ignored", json_count(&g->doc, json_member(&g->doc, 0, "animations")));
}

/* The tables by accessor, buffer and mesh. A primitive makes at most one lambent mesh. */
static int make_tables(gltf *g)
{
    uint64_t primitives = 0;
    uint32_t i;
    for (i = 0; i < g->meshes.count; ++i)
        primitives += json_count(&g->doc, json_member(&g->doc, g->meshes.items[i], "primitives"));
    g->b->meshes = (lmb_mesh *)build_keep(g->b, primitives, sizeof *g->b->meshes);
    g->mesh_material = (uint32_t *)build_scratch(g->b, primitives, sizeof *g->mesh_material);
    g->mesh_first = (uint32_t *)build_scratch(g->b, g->meshes.count, sizeof *g->mesh_first);
    g->mesh_size = (uint32_t *)build_scratch(g->b, g->meshes.count, sizeof *g->mesh_size);
    g->positions = (const void **)build_scratch(g->b, g->accessors.count, sizeof *g->positions);
    g->uvs = (const void **)build_scratch(g->b, g->accessors.count, sizeof *g->uvs);
    g->normals = (const int16_t **)build_scratch(g->b, g->accessors.count, sizeof *g->normals);
    g->colours = (const uint8_t **)build_scratch(g->b, g->accessors.count, sizeof *g->colours);
    g->uv_owner = (uint32_t *)build_scratch(g->b, g->accessors.count, sizeof *g->uv_owner);
    g->buffer_bytes = (gltf_bytes *)build_scratch(g->b, g->buffers.count, sizeof *g->buffer_bytes);
    g->files = (file_bytes *)build_scratch(g->b, g->buffers.count, sizeof *g->files);
    if (!g->b->meshes || !g->mesh_material || !g->mesh_first || !g->mesh_size || !g->positions || !g->uvs ||
        !g->normals || !g->colours || !g->uv_owner || !g->buffer_bytes || !g->files)
        return 0;
    for (i = 0; i < g->meshes.count; ++i)
        g->mesh_first[i] = JSON_NONE;
    return 1;
}

static int make_tree(tree *t, gltf *g)
{
    memset(t, 0, sizeof *t);
    t->order = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *t->order);
    t->parent = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *t->parent);
    t->world = (matrix *)build_scratch(g->b, g->nodes.count, sizeof *t->world);
    return t->order && t->parent && t->world && walk(t, g) && place_nodes(t, g);
}

/* Counts as the document has them. */
static void count_facts(gltf *g)
{
    model_facts *facts = &g->b->out->facts;
    uint32_t i;
    facts->nodes = g->nodes.count;
    facts->meshes = g->meshes.count;
    facts->materials = g->materials.count;
    facts->textures = g->textures.count;
    facts->images = g->images.count;
    facts->lights = g->lights.count;
    facts->cameras = g->cameras.count;
    facts->animations = json_count(&g->doc, json_member(&g->doc, 0, "animations"));
    facts->skins = json_count(&g->doc, json_member(&g->doc, 0, "skins"));
    for (i = 0; i < g->meshes.count; ++i)
        facts->primitives += json_count(&g->doc, json_member(&g->doc, g->meshes.items[i], "primitives"));
}

static int load_document(gltf *g)
{
    tree t;
    if (!check_version(g) || !check_extensions(g) || !gltf_lists(g) || !make_tables(g) || !make_tree(&t, g) ||
        !gltf_materials(g) || !add_instances(&t, g) || !add_lights(&t, g) || !add_cameras(&t, g))
        return 0;
    tell_left_out(g);
    count_facts(g);
    return 1;
}

int gltf_load(model_build *b, const uint8_t *data, size_t size)
{
    gltf g;
    uint32_t i;
    int ok;
    memset(&g, 0, sizeof g);
    g.b = b;
    b->out->facts.format = size >= 4 && memcmp(data, "glTF", 4) == 0 ? "GLB" : "glTF";
    if (!gltf_container(&g, data, size))
        return 0;
    ok = load_document(&g);
    for (i = 0; g.files && i < g.buffers.count; ++i)
        file_free(&g.files[i]);
    json_free(&g.doc);
    return ok;
}
