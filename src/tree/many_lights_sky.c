/* many_lights_sky.c: many suns -> the sky of light at single points. Layer 6.                              [ours V3]
 *
 * The sky's nodes are a cut of the tree of many lights, in the order of its cells, so strata of light are patches of
 * the sky. A node is divided if its share of the light, times the mean square of its extent, exceeds a limit, which is
 * the lowest with nodes that fit. */
#include <lambent/many_lights.h>

#include <string.h>

#include "../base/vec.h"

#if LMB_LIVE

enum { NODES = LMB_LIVE_SKY * LMB_LIVE_NODES };

static float power_of(const lmb_many_lights_node *n)
{
    return (n->intensity[0] + n->intensity[1] + n->intensity[2]) * (1.0f / 3.0f);
}

/* The node of the cut that begins at cell `from`. */
static const lmb_many_lights_node *sky_node_at(const lmb_many_lights *m, uint32_t from, float limit)
{
    const lmb_many_lights_node *n = &m->node[0];
    while (n->children > 0 && power_of(n) * n->spread > limit) {
        const lmb_many_lights_node *child = &m->node[n->first];
        while (child->past <= from) {
            ++child;
        }
        n = child;
    }
    return n;
}

/* Number of nodes of a cut; more than NODES: at least that many. */
static uint32_t nodes_of(const lmb_many_lights *m, float limit)
{
    uint32_t count = 0;
    for (uint32_t from = 0; from < m->cell_count && count <= NODES; from = sky_node_at(m, from, limit)->past) {
        ++count;
    }
    return count;
}

static float sky_limit_of(const lmb_many_lights *m)
{
    enum { HALVINGS = 48 };
    float limit = power_of(&m->node[0]);
    for (int i = 0; i < HALVINGS && nodes_of(m, limit * 0.25f) <= NODES; ++i) {
        limit *= 0.25f;
    }
    return nodes_of(m, limit * 0.5f) <= NODES ? limit * 0.5f : limit;
}

/* Stores the suns in the order of the cells. */
static void put_sky_suns(lmb_live_sky *out, const lmb_many_lights *m)
{
    for (uint32_t i = 0; i < m->node_count; ++i) {
        const lmb_many_lights_node *n = &m->node[i];
        if (n->children == 0) {
            lmb_live_sun *sun = &out->sun[n->from];
            sun->toward = n->position;
            sun->upto = power_of(n);
        }
    }
}

static void put_sky_node(lmb_live_sky *out, uint32_t slot, const lmb_many_lights_node *n)
{
    lmb_live_suns *c = &out->chunk[slot / LMB_LIVE_NODES];
    const uint32_t i = slot % LMB_LIVE_NODES;
    lmb_vec3 toward = vec3(0, 0, 0);
    float sum = 0.0f;
    for (uint32_t k = n->from; k < n->past; ++k) {
        lmb_live_sun *sun = &out->sun[k];
        toward = add3(toward, mul3(sun->toward, sun->upto));
        sum += sun->upto;
        sun->upto = sum;
    }
    const float per = sum > 0.0f ? 1.0f / sum : 0.0f;
    c->toward[0][i] = toward.x * per;
    c->toward[1][i] = toward.y * per;
    c->toward[2][i] = toward.z * per;
    c->power[i] = sum;
    for (int h = 0; h < 3; ++h) {
        c->colour[h][i] = n->intensity[h] * per;
    }
    c->first[i] = n->from;
    c->count[i] = n->past - n->from;
}

lmb_status lmb_many_lights_sky(lmb_live_sky *out, const lmb_many_lights *m, const lmb_scene *scene)
{
    uint32_t slots = 0;
    if (out == NULL || out->chunk == NULL || m == NULL || m->node == NULL || scene == NULL || m->node_count == 0 ||
        m->node[0].kind != LMB_LIGHT_DIRECTIONAL) {
        return LMB_ERR_ARG;
    }
    if (m->cell_count > out->sun_cap) {
        return LMB_ERR_CAPACITY;
    }
    const float limit = sky_limit_of(m);
    put_sky_suns(out, m);
    memset(out->chunk, 0, LMB_LIVE_SKY * sizeof *out->chunk);
    for (uint32_t from = 0; from < m->cell_count && slots < NODES; ++slots) {
        const lmb_many_lights_node *n = sky_node_at(m, from, limit);
        put_sky_node(out, slots, n);
        from = n->past;
    }
    out->chunks = (slots + LMB_LIVE_NODES - 1) / LMB_LIVE_NODES;
    out->reach = maxf(2.0f * length3(sub3(scene->bounds_max, scene->bounds_min)), 1e-3f);
    return LMB_OK;
}

#endif
