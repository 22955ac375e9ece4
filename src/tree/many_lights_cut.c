/* many_lights_cut.c: a surface's own cut through the tree of many lights. Layer 6.                              [V3]
 *
 * A node represents its lights in two ways, and each limits how far the tree is refined. As a position: I cos / d^2
 * from the mean of the lights errs by about the node's bound x R^2 / d^2, because the first-order terms cancel. I cos /
 * d^2 is harmonic, so lights spread evenly to all sides err even less. As a shadow: two tests decide for all lights of
 * a node, so a node's light is the error of one wrong test. On 100, 1,000 and 10,000 lights in a room with boxes the
 * second limit mattered more: with it, a quarter of the shadow tests give the same error. The nodes are in a heap with
 * the worst on top. The key is first the bound, until the sum of bounds is small, then the light, until no node
 * contributes much. Both limits lie on the measured front of speed and error. Spots are refined by the light that a
 * node gives if its representative cone contains the pixels.
 *
 * Entries that can still be refined are in a heap at the front of `entry`, cells at the back. */
#include "many_lights_cut.h"

#if LMB_TREES

/* The sum of the bounds assumes that each is reached and that all errors have one sign, which does not happen with
 * hundreds of nodes: at 16 times the requested error the actual error is below that of the shadow tests. */
#define SUM_OF_BOUNDS 16.0f

static void sift_down(lmb_many_lights_scratch *s, lmb_many_lights_entry e)
{
    int32_t i = 0;
    for (int32_t child = 1; child < s->open; child = 2 * i + 1) {
        child += child + 1 < s->open && s->entry[child + 1].key > s->entry[child].key;
        if (s->entry[child].key <= e.key) {
            break;
        }
        s->entry[i] = s->entry[child];
        i = child;
    }
    s->entry[i] = e;
}

static void push(lmb_many_lights_scratch *s, lmb_many_lights_entry e)
{
    int32_t i = s->open++;
    while (i > 0 && s->entry[(i - 1) / 2].key < e.key) {
        s->entry[i] = s->entry[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    s->entry[i] = e;
}

static lmb_many_lights_entry pop(lmb_many_lights_scratch *s)
{
    const lmb_many_lights_entry top = s->entry[0], last = s->entry[--s->open];
    if (s->open > 0) {
        sift_down(s, last);
    }
    return top;
}

/* Nodes too near for a bound are refined anyway, and would only make the sums inaccurate. */
static void count_in_lights(lmb_many_lights_scratch *s, const lmb_many_lights_entry *e, float sign)
{
    if (e->error < LMB_MANY_LIGHTS_NEAR) {
        s->error += sign * e->error;
        s->light += sign * e->light;
    }
}

static float key_of_entry(const lmb_many_lights_scratch *s, const lmb_many_lights_entry *e)
{
    return s->by_light ? e->inside : e->error;
}

static void add_nodes(lmb_many_lights_scratch *s, const lmb_kernels *kernels, const lmb_many_lights *many_lights,
                      uint32_t first, uint32_t count, const lmb_many_lights_job *job)
{
    float error[16], light[16], inside[16];
    kernels->many_lights_bounds(error, light, inside, many_lights, first, count, job);
    for (uint32_t k = 0; k < count; ++k) {
        const int parts = many_lights->node[first + k].children > 0;
        lmb_many_lights_entry e;
        e.error = parts ? error[k] : 0.0f;
        e.light = light[k];
        e.inside = inside[k];
        e.key = key_of_entry(s, &e);
        e.node = first + k;
        if (error[k] < 0.0f) {
            continue;
        }
        count_in_lights(s, &e, 1.0f);
        if (parts) {
            push(s, e);
        } else {
            s->entry[LMB_MANY_LIGHTS_CUT - ++s->closed] = e;
        }
    }
}

/* Adds one root for each kind of light. */
static void add_roots(lmb_many_lights_scratch *s, const lmb_kernels *kernels, const lmb_many_lights *many_lights,
                      const lmb_many_lights_job *job)
{
    const lmb_many_lights_node *root = &many_lights->node[0];
    if (root->kind != LMB_MANY_LIGHTS_MIXED) {
        add_nodes(s, kernels, many_lights, 0, 1, job);
        return;
    }
    for (uint32_t k = 0; k < root->children; ++k) {
        add_nodes(s, kernels, many_lights, root->first + k, 1, job);
    }
}

static int is_fine(const lmb_many_lights_scratch *s)
{
    if (s->by_light) {
        return s->entry[0].inside <= s->allowed * s->light;
    }
    return s->entry[0].error < LMB_MANY_LIGHTS_NEAR && s->error <= SUM_OF_BOUNDS * s->allowed * s->light;
}

static void divide_node(lmb_many_lights_scratch *s, const lmb_kernels *kernels, const lmb_many_lights_query *query,
                        const lmb_many_lights_job *job)
{
    while (s->open > 0 && s->open + s->closed + 7 <= LMB_MANY_LIGHTS_CUT && !is_fine(s)) {
        const lmb_many_lights_entry e = pop(s);
        const lmb_many_lights_node *node = &query->many_lights->node[e.node];
        count_in_lights(s, &e, -1.0f);
        add_nodes(s, kernels, query->many_lights, node->first, node->children, job);
    }
}

/* Rebuilds the heap with another key. */
static void order_by_light(lmb_many_lights_scratch *s)
{
    const int32_t count = s->open;
    s->by_light = 1;
    s->open = 0;
    for (int32_t i = 0; i < count; ++i) {
        lmb_many_lights_entry e = s->entry[i];
        e.key = key_of_entry(s, &e);
        push(s, e);
    }
}

void lmb_many_lights_cut(lmb_many_lights_scratch *s, const lmb_kernels *kernels, const lmb_many_lights_query *query,
                         const lmb_many_lights_job *job)
{
    s->allowed = query->error > 0.0f ? query->error : 0.02f;
    s->open = s->closed = s->by_light = 0;
    s->error = s->light = 0.0f;
    add_roots(s, kernels, query->many_lights, job);
    divide_node(s, kernels, query, job);
    order_by_light(s);
    divide_node(s, kernels, query, job);
}

#endif
