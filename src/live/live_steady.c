/* live_steady.c: targets that change little while lights or receivers move. Layer 5.                    [ours]
 *
 * Strata are ranges of one running sum. If the light of one node changes, all later strata shift, and most segments
 * end somewhere else in the next frame. Here each node has a fixed threshold, from the cell of the world. If a node has
 * less than one stratum of light and this share exceeds the threshold, the node is a target. The weight of a target
 * starts at 0 at the threshold. The mean weight over all thresholds is the share. From half a stratum on, the weight
 * fades to the share. From one stratum on, the parts of the node replace the node.
 *
 * In fine cells the key comes from a box around the lit points, which moves with the light. So these targets are not
 * steady. */
#include "live_part.h"

#if LMB_LIVE

typedef struct waiting_node {
    const lmb_live_chunk *chunk;
    int32_t lane;
    float share, fade; /* strata; 0 .. 1: the part of the parent's weight that its parts have */
} waiting_node;

enum { WAITING = 64 };

static void add_target(lmb_live_scratch *s, const waiting_node *n, float weight)
{
    if (weight > 0.0f && s->picks < LMB_LIVE_PICKS) {
        s->pick[s->picks].chunk = n->chunk;
        s->pick[s->picks].lane = n->lane;
        s->pick[s->picks++].weight = weight;
    }
}

static float weight_of(float share, float threshold)
{
    const float fading = threshold < share ? 2.0f * (1.0f - threshold / share) : 0.0f;
    const float on = clampf(2.0f * share - 1.0f, 0.0f, 1.0f);
    return (1.0f - on) * fading + on * share;
}

/* Adds a node of over one stratum. Returns the number of parts that wait next. */
static int add_parts(lmb_live_scratch *s, const lmb_live *live, const waiting_node *n, waiting_node *out, int room)
{
    const uint32_t first = n->chunk->first[n->lane], count = n->chunk->count[n->lane];
    const float on = minf(n->share - 1.0f, 1.0f);
    float sum = 0.0f;
    if (count == 0 || (count & LMB_LIVE_LEAF) != 0 || count > (uint32_t)room) {
        add_target(s, n, n->fade * n->share);
        return 0;
    }
    for (uint32_t i = first; i < first + count; ++i) {
        sum += live->chunk[i / LMB_LIVE_NODES].power[i % LMB_LIVE_NODES];
    }
    add_target(s, n, n->fade * n->share * (1.0f - on));
    for (uint32_t i = 0; i < count && sum > 0.0f; ++i) {
        waiting_node *part = &out[count - 1 - i]; /* the last one is next */
        part->chunk = &live->chunk[(first + i) / LMB_LIVE_NODES];
        part->lane = (int32_t)((first + i) % LMB_LIVE_NODES);
        part->share = n->share * (part->chunk->power[part->lane] / sum);
        part->fade = n->fade * on;
    }
    return sum > 0.0f ? (int)count : 0;
}

static void pick_node(lmb_live_scratch *s, const lmb_live *live, const lmb_live_chunk *chunk, int lane, float share)
{
    waiting_node waiting[WAITING];
    int count = 1;
    waiting[0].chunk = chunk;
    waiting[0].lane = lane;
    waiting[0].share = share;
    waiting[0].fade = 1.0f;
    while (count > 0) {
        const waiting_node n = waiting[--count];
        if (n.share < 1.0f) {
            add_target(s, &n, n.fade * weight_of(n.share, n.chunk->threshold[n.lane]));
        } else {
            count += add_parts(s, live, &n, waiting + count, WAITING - count);
        }
    }
}

void lmb_live_pick_steady(lmb_live_scratch *s, const lmb_live *live, float all)
{
    const float per = 2.0f * (float)live->strata / all;
    s->picks = 0;
    for (int32_t e = 0; e < s->count; ++e) {
        for (int i = 0; i < LMB_LIVE_NODES && s->sum[e] > 0.0f; ++i) {
            if (s->value[e][i] > 0.0f) {
                pick_node(s, live, s->chunk[e], i, s->value[e][i] * per);
            }
        }
    }
}

/* As crossed_per. */
static float steady_per(float d) { return absf(d) > 1e-20f ? 1.0f / d : d < 0.0f ? -1e20f : 1e20f; }

void lmb_live_put_steady(lmb_live_scratch *s, int32_t first)
{
    lmb_live_rays *r = &s->rays;
    const float at[3] = {r->segments.at.x, r->segments.at.y, r->segments.at.z};
    int32_t k = 0;
    for (; k < LMB_TILE_PIXELS && first + k < s->picks; ++k) {
        const lmb_live_pick *p = &s->pick[first + k];
        const lmb_live_target *t = &p->chunk->target[p->lane];
        for (int h = 0; h < 3; ++h) {
            r->to[h][k] = t->at[h] - at[h];
            r->facet[h][k] = t->facet[h];
            r->colour[h][k] = t->colour[h] * p->weight;
        }
        r->id[k] = t->id;
    }
    s->targets = k;
    for (; k % LMB_LIVE_NODES != 0; ++k) { /* padding that the sums include */
        for (int h = 0; h < 3; ++h) {
            r->to[h][k] = r->facet[h][k] = r->colour[h][k] = 0.0f;
        }
        r->id[k] = 0;
    }
    for (int32_t i = 0; i < k; ++i) {
        for (int h = 0; h < 3; ++h) {
            r->segments.per[h][i] = steady_per(r->to[h][i]);
        }
    }
}

#endif
