/* io_gltf_tree.c: the nodes of one scene of a glTF document in drawing order, with world transforms, and instances. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io_gltf.h"

/* Sets parents from all lists of children; two parents are an error. */
static int find_parents(gltf_tree *t, gltf *g)
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

/* State of a node and its ancestors while roots are searched. */
enum { UNKNOWN, NAMED, BELOW_NAMED, ALONE };

/* Returns whether the scene names an ancestor of this node. Each node is visited once. */
static int is_below_named(uint8_t *known, const gltf_tree *t, uint32_t node)
{
    uint32_t up = t->parent[node], i;
    while (up != JSON_NONE && known[up] == UNKNOWN)
        up = t->parent[up];
    const int below = up != JSON_NONE && known[up] != ALONE;
    for (i = t->parent[node]; i != up; i = t->parent[i])
        known[i] = below ? BELOW_NAMED : ALONE;
    return below;
}

/* Pushes the nodes that a scene names, each once. It should name only roots: a child of a named node stays below
 * that one, and any other child becomes a root. */
static int push_named(uint32_t *stack, uint32_t *depth, gltf_tree *t, gltf *g, uint32_t nodes, uint8_t *known)
{
    uint32_t i, root;
    for (i = json_first(&g->doc, nodes); i != JSON_NONE; i = json_next(&g->doc, i)) {
        if (!gltf_index(&root, g, &g->nodes, i))
            return 0;
        if (known[root] == NAMED) {
            ++g->left_out.no_roots;
        } else {
            known[root] = NAMED;
            stack[(*depth)++] = root;
        }
    }
    const uint32_t named = *depth;
    for (i = *depth = 0; i < named; ++i) {
        root = stack[i];
        const int below = t->parent[root] != JSON_NONE && is_below_named(known, t, root);
        g->left_out.no_roots += t->parent[root] != JSON_NONE;
        if (!below) {
            t->parent[root] = JSON_NONE;
            stack[(*depth)++] = root;
        }
    }
    return 1;
}

/* Reverses the stack from `from` on, so that the first is popped first. */
static void reverse(uint32_t *stack, uint32_t from, uint32_t to)
{
    while (to - from > 1) {
        const uint32_t swap = stack[from];
        stack[from++] = stack[--to];
        stack[to] = swap;
    }
}

/* The scene that the user selected, by name or number; otherwise the default one, or the first. */
static int find_scene(uint32_t *out, gltf *g, const gltf_list *scenes)
{
    const char *wanted = g->b->scene;
    char name[64], *end;
    unsigned long number;
    if (!wanted) {
        if (!gltf_index(out, g, scenes, json_member(&g->doc, 0, "scene")))
            return 0;
        *out = *out == JSON_NONE ? 0 : *out;
        return 1;
    }
    for (*out = 0; *out < scenes->count; ++*out) {
        json_string(name, sizeof name, &g->doc, json_member(&g->doc, scenes->items[*out], "name"));
        if (strcmp(name, wanted) == 0)
            return 1;
    }
    number = strtoul(wanted, &end, 10);
    if (*wanted < '0' || *wanted > '9' || *end != '\0' || number >= scenes->count)
        return report_fail_usage(g->b->r, "%s: no scene `%.60s`; it has %u, numbered from 0", g->b->path, wanted,
                           (unsigned)scenes->count);
    *out = (uint32_t)number;
    return 1;
}

/* Pushes the roots of the scene; without scenes, all roots. */
static int push_roots(uint32_t *stack, uint32_t *depth, gltf_tree *t, gltf *g, uint8_t *known)
{
    model_facts *facts = &g->b->out->facts;
    gltf_list scenes;
    uint32_t i;
    if (!gltf_list_of(&scenes, g, json_member(&g->doc, 0, "scenes")) || !find_scene(&facts->scene, g, &scenes))
        return 0;
    facts->scenes = scenes.count;
    if (scenes.count == 0) {
        for (i = 0; i < g->nodes.count; ++i)
            if (t->parent[i] == JSON_NONE)
                stack[(*depth)++] = i;
    } else {
        const uint32_t scene = scenes.items[facts->scene], nodes = json_member(&g->doc, scene, "nodes");
        json_string(facts->scene_name, sizeof facts->scene_name, &g->doc, json_member(&g->doc, scene, "name"));
        if (!push_named(stack, depth, t, g, nodes, known))
            return 0;
    }
    reverse(stack, 0, *depth);
    return 1;
}

/* All nodes on a cycle have parents, so no root leads to them. Goes up from each node with a mark; meeting the same
 * mark again is a cycle, drawn or not. */
static int refuse_cycles(const gltf_tree *t, gltf *g)
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

/* Depth first, children in order. Each node is pushed once, so the stack needs one slot per node. */
static int traversal(gltf_tree *t, gltf *g)
{
    uint32_t *stack = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *stack), depth = 0, from, c, child;
    uint8_t *known = (uint8_t *)build_scratch(g->b, g->nodes.count, 1);
    if (!stack || !known || !find_parents(t, g) || !refuse_cycles(t, g) || !push_roots(stack, &depth, t, g, known))
        return 0;
    while (depth > 0) {
        const uint32_t node = stack[--depth];
        const uint32_t children = json_member(&g->doc, g->nodes.items[node], "children");
        t->order[t->count++] = node;
        t->placed[node] = 1;
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

/* The transform of a node relative to the parent, as stored. */
int gltf_local(model_local *out, gltf *g, uint32_t node)
{
    const json *doc = &g->doc;
    const uint32_t whole = json_member(doc, node, "matrix");
    memset(out, 0, sizeof *out);
    out->q[3] = out->s[0] = out->s[1] = out->s[2] = 1;
    out->is_matrix = whole != JSON_NONE;
    if (out->is_matrix) {
        const double *m = out->matrix;
        if (!json_read_doubles(out->matrix, 16, doc, whole, g->b->r))
            return 0;
        return (m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1) ||
               json_fail(doc, whole, g->b->r, "the last row must be 0 0 0 1");
    }
    return json_read_doubles(out->t, 3, doc, json_member(doc, node, "translation"), g->b->r) &&
           json_read_doubles(out->q, 4, doc, json_member(doc, node, "rotation"), g->b->r) &&
           json_read_doubles(out->s, 3, doc, json_member(doc, node, "scale"), g->b->r);
}

static int local_matrix(gltf_matrix *out, gltf_matrix *turn, gltf *g, uint32_t node)
{
    model_local l;
    if (!gltf_local(&l, g, node))
        return 0;
    if (!model_compose(out->m, &l) || !model_compose_turn(turn->m, &l))
        return json_fail(&g->doc, node, g->b->r, "rotation is no quaternion (its length is 0)");
    return 1;
}

void gltf_multiply(gltf_matrix *out, const gltf_matrix *a, const gltf_matrix *b) { model_multiply(out->m, a->m, b->m); }

/* KHR_node_visibility: descendants of a hidden node are hidden too. */
static int read_visibility(uint8_t *hidden, gltf *g, uint32_t node)
{
    const uint32_t own = json_member(&g->doc, json_member(&g->doc, node, "extensions"), "KHR_node_visibility");
    int visible = 1;
    if (!json_read_bool(&visible, &g->doc, json_member(&g->doc, own, "visible"), g->b->r))
        return 0;
    *hidden = !visible;
    return 1;
}

/* Computes the world matrix of every drawn node; each must fit binary32. */
static int place_nodes(gltf_tree *t, gltf *g)
{
    uint32_t i, k;
    for (i = 0; i < t->count; ++i) {
        const uint32_t node = t->order[i], up = t->parent[node];
        gltf_matrix local, turn;
        if (!local_matrix(&local, &turn, g, g->nodes.items[node]) ||
            !read_visibility(&t->hidden[node], g, g->nodes.items[node]))
            return 0;
        t->world[node] = local;
        t->turn[node] = turn;
        if (up != JSON_NONE) {
            gltf_multiply(&t->world[node], &t->world[up], &local);
            gltf_multiply(&t->turn[node], &t->turn[up], &turn);
            t->hidden[node] |= t->hidden[up];
        }
        for (k = 0; k < 16; ++k)
            if (!(fabs(t->world[node].m[k]) <= (double)FLT_MAX))
                return json_fail(&g->doc, g->nodes.items[node], g->b->r, "its place in the world is not finite");
    }
    return 1;
}
int gltf_make_tree(gltf_tree *t, gltf *g)
{
    memset(t, 0, sizeof *t);
    t->order = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *t->order);
    t->parent = (uint32_t *)build_scratch(g->b, g->nodes.count, sizeof *t->parent);
    t->world = (gltf_matrix *)build_scratch(g->b, g->nodes.count, sizeof *t->world);
    t->turn = (gltf_matrix *)build_scratch(g->b, g->nodes.count, sizeof *t->turn);
    t->hidden = (uint8_t *)build_scratch(g->b, g->nodes.count, 1);
    t->placed = (uint8_t *)build_scratch(g->b, g->nodes.count, 1);
    return t->order && t->parent && t->world && t->turn && t->hidden && t->placed && traversal(t, g) &&
           place_nodes(t, g);
}

void gltf_add_instances(gltf *g, const gltf_tree *t, const gltf_placing *p)
{
    const uint32_t size = g->mesh_size[p->mesh];
    for (uint32_t k = 0; k < size; ++k) {
        const uint32_t n = g->b->instance_count++;
        lmb_instance *to = &g->b->instances[n];
        g->instance_node[n] = p->mover;
        g->instance_shown[n] = p->order;
        g->instance_from[n] = t->order[p->order];
        for (int c = 0; c < 16; ++c)
            to->to_world.m[c] = (float)p->world->m[c];
        to->mesh = p->first + k;
        to->material = g->mesh_material[to->mesh];
    }
}
