/* many_lights.c: a few lights that stand for many, for those who want a map of each. Floor 5.                   [V3] */
#include <lambent/many.h>

#include <string.h>

#include "../base/vec.h"

/* What may be wrong by standing at one place: all of the light, moved by about the size of the node. */
static float harm_of(const lmb_many_node *node)
{
    return node->children == 0 ? 0.0f
                               : (node->intensity[0] + node->intensity[1] + node->intensity[2]) * node->spread;
}

/* The node to part next: the most harmful one whose parts fit; `count` where there is none. */
static uint32_t worst_of(const uint32_t *taken, uint32_t count, uint32_t cap, const lmb_many *many)
{
    uint32_t worst = count;
    float most = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        const lmb_many_node *node = &many->node[taken[i]];
        if (harm_of(node) > most && count - 1 + node->children <= cap) {
            most = harm_of(node);
            worst = i;
        }
    }
    return worst;
}

static lmb_light light_of(const lmb_many_node *node)
{
    lmb_light l;
    memset(&l, 0, sizeof l);
    l.kind = LMB_LIGHT_POINT;
    l.position = node->median;
    l.direction = vec3(0.0f, -1.0f, 0.0f);
    memcpy(l.intensity, node->intensity, sizeof l.intensity);
    l.cos_inner = l.cos_outer = 1.0f;
    return l;
}

uint32_t lmb_many_lights(lmb_light *out, uint32_t cap, const lmb_many *many)
{
    uint32_t taken[LMB_MAX_LIGHTS], count = 1;
    if (out == NULL || many == NULL || many->node_count == 0 || cap == 0) {
        return 0;
    }
    cap = cap < LMB_MAX_LIGHTS ? cap : LMB_MAX_LIGHTS;
    taken[0] = 0;
    for (uint32_t i = worst_of(taken, count, cap, many); i < count; i = worst_of(taken, count, cap, many)) {
        const lmb_many_node *node = &many->node[taken[i]];
        taken[i] = node->first;
        for (uint32_t k = 1; k < node->children; ++k) {
            taken[count++] = node->first + k;
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        out[i] = light_of(&many->node[taken[i]]);
    }
    return count;
}
