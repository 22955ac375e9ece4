/* io_gltf_motion.c: reads animations of nodes: translation, rotation, scale and morph weights with STEP, LINEAR or
 * CUBICSPLINE. All animations of the document play together. If two move the same property, the first one counts. */
#include <math.h>
#include <string.h>

#include "io_gltf.h"

/* State of the reader. */
typedef struct reading {
    gltf *g;
    const gltf_tree *tree;
    uint32_t *place;  /* by node of the document: node of the motion; MODEL_NONE: not in the scene */
    uint8_t *taken;   /* by node of the motion: bits of properties with a track */
    model_track *track, *weight_track; /* weight_track: of morph weights */
    uint32_t tracks, weight_tracks;
    double end_s;
} reading;

/* --- one channel -------------------------------------------------------------------------------------------------- */

/* Reads the floats of an accessor and checks that they are finite. `components`: 1, 3 or 4. has_codes: normalized
 * integers are allowed too. */
static const float *read_floats(uint32_t *count, gltf *g, uint32_t reference, uint32_t components, int has_codes)
{
    gltf_accessor a;
    uint32_t index, i;
    float *values;
    if (!gltf_attribute(&a, &index, g, reference, components, components, 0))
        return NULL;
    if (index == JSON_NONE) {
        json_fail(&g->doc, reference, g->b->r, "an animation's sampler needs input and output");
        return NULL;
    }
    if (a.component != GLTF_F32 && (!has_codes || !a.normalized)) {
        json_fail(&g->doc, reference, g->b->r, "accessor %u is of no type that an animation takes", (unsigned)index);
        return NULL;
    }
    values = (float *)build_keep(g->b, (uint64_t)a.count * components, sizeof *values);
    if (!values || !gltf_accessor_floats(values, g, &a))
        return NULL;
    for (i = 0; i < a.count * components; ++i)
        if (!(fabsf(values[i]) <= 1e30f)) {
            json_fail(&g->doc, reference, g->b->r, "accessor %u has a value that is no number", (unsigned)index);
            return NULL;
        }
    *count = a.count;
    return values;
}

static int read_times(model_track *t, gltf *g, uint32_t reference)
{
    uint32_t i;
    t->time = read_floats(&t->count, g, reference, 1, 0);
    if (!t->time)
        return 0;
    for (i = 0; i < t->count; ++i)
        if (!(t->time[i] >= 0) || (i > 0 && !(t->time[i] > t->time[i - 1])))
            return json_fail(&g->doc, reference, g->b->r, "an animation's times must rise from 0 on; key %u does not",
                             (unsigned)i);
    return t->count > 0 || json_fail(&g->doc, reference, g->b->r, "an animation without keys");
}

static int read_between(model_track *t, gltf *g, uint32_t sampler)
{
    static const char *const names[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const uint32_t word = json_member(&g->doc, sampler, "interpolation");
    t->between = MODEL_LINEAR;
    for (int i = 0; i < 3 && word != JSON_NONE; ++i)
        if (json_equals(&g->doc, word, names[i])) {
            t->between = i;
            return 1;
        }
    return word == JSON_NONE || json_fail(&g->doc, word, g->b->r, "interpolation must be LINEAR, STEP or CUBICSPLINE");
}

/* `targets`: numbers per key of a track of weights. */
static int read_sampler(model_track *t, gltf *g, uint32_t sampler, uint32_t targets)
{
    const uint32_t output = json_member(&g->doc, sampler, "output"),
                   components = t->what == MODEL_ROTATION ? 4 : t->what == MODEL_WEIGHTS ? 1 : 3;
    uint32_t values;
    if (!read_between(t, g, sampler) || !read_times(t, g, json_member(&g->doc, sampler, "input")))
        return 0;
    t->value = read_floats(&values, g, output, components, components != 3);
    if (!t->value)
        return 0;
    if (values != (t->between == MODEL_CUBIC ? 3 : 1) * (components == 1 ? (uint64_t)targets : 1) * t->count)
        return json_fail(&g->doc, output, g->b->r, "%u values for %u keys", (unsigned)values, (unsigned)t->count);
    return 1;
}

/* The property that a channel animates; -1: not supported. */
static int target_of(const gltf *g, uint32_t target)
{
    static const char *const names[] = {"translation", "rotation", "scale", "weights"};
    for (int i = 0; i < 4; ++i)
        if (json_equals(&g->doc, json_member(&g->doc, target, "path"), names[i]))
            return i;
    return -1;
}

static int read_channel(reading *m, const gltf_list *samplers, uint32_t channel)
{
    gltf *g = m->g;
    const uint32_t target = json_member(&g->doc, channel, "target");
    const int what = target_of(g, target), is_weights = what == MODEL_WEIGHTS;
    uint32_t node, sampler, targets;
    model_track *t = is_weights ? &m->weight_track[m->weight_tracks] : &m->track[m->tracks];
    t->what = what;
    if (!gltf_index(&node, g, &g->nodes, json_member(&g->doc, target, "node")))
        return 0;
    targets = is_weights && node != JSON_NONE ? gltf_targets(g, g->nodes.items[node]) : 0;
    if (node == JSON_NONE || what < 0 || m->place[node] == MODEL_NONE || (is_weights && targets == 0)) {
        ++g->b->out->idle_channels;
        return 1;
    }
    if ((m->taken[m->place[node]] & 1u << what) != 0)
        return 1;
    if (!is_weights && json_member(&g->doc, g->nodes.items[node], "matrix") != JSON_NONE)
        return json_fail(&g->doc, channel, g->b->r, "node %u has a matrix, which cannot be animated", (unsigned)node);
    t->node = m->place[node];
    if (!gltf_item(&sampler, g, samplers, json_member(&g->doc, channel, "sampler")))
        return 0;
    if (sampler == JSON_NONE)
        return json_fail(&g->doc, channel, g->b->r, "a channel without a sampler");
    if (!read_sampler(t, g, sampler, targets))
        return 0;
    m->taken[t->node] |= (uint8_t)(1u << what);
    m->end_s = fmax(m->end_s, (double)t->time[t->count - 1]);
    ++*(is_weights ? &m->weight_tracks : &m->tracks);
    return 1;
}

/* --- all of them -------------------------------------------------------------------------------------------------- */

static uint64_t count_channels(const gltf *g, uint32_t animations)
{
    uint64_t count = 0;
    for (uint32_t a = json_first(&g->doc, animations); a != JSON_NONE; a = json_next(&g->doc, a))
        count += json_count(&g->doc, json_member(&g->doc, a, "channels"));
    return count;
}

static int read_channels(reading *m, uint32_t animations)
{
    const json *doc = &m->g->doc;
    for (uint32_t a = json_first(doc, animations); a != JSON_NONE; a = json_next(doc, a)) {
        const uint32_t channels = json_member(doc, a, "channels");
        gltf_list samplers;
        if (!gltf_list_of(&samplers, m->g, json_member(doc, a, "samplers")))
            return 0;
        for (uint32_t c = json_first(doc, channels); c != JSON_NONE; c = json_next(doc, c))
            if (!read_channel(m, &samplers, c))
                return 0;
    }
    return 1;
}

/* Sorts tracks by node, keeping their order, with a counting sort. */
static model_track *sorted(const reading *m)
{
    const uint32_t nodes = m->tree->count;
    model_track *out = (model_track *)build_keep(m->g->b, m->tracks, sizeof *out);
    uint32_t *next = (uint32_t *)build_scratch(m->g->b, (uint64_t)nodes + 1, sizeof *next), i;
    if (!out || !next)
        return NULL;
    for (i = 0; i < m->tracks; ++i)
        ++next[m->track[i].node + 1];
    for (i = 0; i < nodes; ++i)
        next[i + 1] += next[i];
    for (i = 0; i < m->tracks; ++i)
        out[next[m->track[i].node]++] = m->track[i];
    return out;
}

/* Makes the nodes of the motion from those of the scene. */
static int make_nodes(struct model_motion *out, const reading *m)
{
    const gltf_tree *t = m->tree;
    const uint64_t nodes = (uint64_t)t->count + (GLTF_HAS_CROWDS ? m->g->places : 0);
    uint32_t *parent = (uint32_t *)build_keep(m->g->b, nodes, sizeof *parent), i;
    model_local *rest = (model_local *)build_keep(m->g->b, nodes, sizeof *rest);
    out->moves = (uint8_t *)build_keep(m->g->b, nodes, 1);
    out->world = (double(*)[16])build_keep(m->g->b, nodes, sizeof *out->world);
    out->turn = (double(*)[16])build_keep(m->g->b, nodes, sizeof *out->turn);
    if (!parent || !rest || !out->moves || !out->world || !out->turn)
        return 0;
    for (i = 0; i < t->count; ++i) {
        const uint32_t up = t->parent[t->order[i]];
        parent[i] = up == JSON_NONE ? MODEL_NONE : m->place[up];
        out->moves[i] = (m->taken[i] & ~(1u << MODEL_WEIGHTS)) != 0 ||
                        (parent[i] != MODEL_NONE && out->moves[parent[i]]);
        if (!gltf_local(&rest[i], m->g, m->g->nodes.items[t->order[i]]))
            return 0;
    }
    if (GLTF_HAS_CROWDS)
        gltf_crowd_motion(parent, rest, out->moves, t, m->g);
    out->parent = parent;
    out->rest = rest;
    out->nodes = (uint32_t)nodes;
    return 1;
}

static int take(reading *m, uint32_t animations)
{
    const uint32_t nodes = m->g->nodes.count;
    const uint64_t channels = count_channels(m->g, animations) + 1;
    m->place = (uint32_t *)build_scratch(m->g->b, nodes, sizeof *m->place);
    m->taken = (uint8_t *)build_scratch(m->g->b, nodes, 1);
    m->track = (model_track *)build_scratch(m->g->b, channels, sizeof *m->track);
    m->weight_track = (model_track *)build_keep(m->g->b, channels, sizeof *m->weight_track);
    for (uint32_t i = 0; m->place && i < nodes; ++i)
        m->place[i] = MODEL_NONE;
    for (uint32_t i = 0; m->place && i < m->tree->count; ++i)
        m->place[m->tree->order[i]] = i;
    return m->place && m->taken && m->track && m->weight_track;
}

static int read_motion(reading *m)
{
    gltf *g = m->g;
    const uint32_t animations = json_member(&g->doc, 0, "animations");
    struct model_motion *out = (struct model_motion *)build_keep(g->b, 1, sizeof *out);
    if (!out || !take(m, animations) || !read_channels(m, animations))
        return 0;
    if (m->tracks + m->weight_tracks == 0)
        return 1;
    out->track = sorted(m);
    out->tracks = m->tracks;
    out->end_s = m->end_s;
    out->of_instance = g->instance_node;
    out->of_light = g->light_node;
    out->of_camera = g->camera_node;
    if (!out->track || !make_nodes(out, m) ||
        !gltf_shapes(out, m->tree, g, m->place, m->weight_track, m->weight_tracks))
        return 0;
    g->b->out->motion = out;
    return 1;
}

/* Most pictures do not use animations, so an error here does not stop loading; it is reported on use. */
void gltf_motion(const gltf_tree *t, gltf *g)
{
    report *const others = g->b->r;
    reading m;
    memset(&m, 0, sizeof m);
    m.g = g;
    m.tree = t;
    g->b->r = &g->b->out->motion_problem;
    if (!read_motion(&m))
        g->b->out->motion = NULL;
    g->b->r = others;
}
