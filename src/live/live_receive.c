/* live_receive.c: the light of one receiver: cut, sums, strata, packet, share. Layer 6.                       [ours] */
#include "live_part.h"

#include <string.h>

#include "../lane/kernels.h"

#if LMB_LIVE

/* --- the light ---------------------------------------------------------------------------------------------------- */

/* The nodes of the first level; then what near ones are made of. */
static void cut(lmb_live_scratch *s, const lmb_kernels *kernels, const lmb_live *live, const lmb_live_job *job)
{
    s->count = s->done = s->near_count = s->leaves = s->is_full = 0;
    s->near_lane = LMB_LIVE_NODES;
    for (uint32_t at = 0; at < live->top; at += LMB_LIVE_NODES) {
        const uint32_t left = live->top - at;
        s->chunk[s->count] = &live->chunk[at / LMB_LIVE_NODES];
        s->asked[s->count++] = (uint16_t)(left < LMB_LIVE_NODES ? 0xffffu >> (LMB_LIVE_NODES - left) : 0xffffu);
    }
    do {
        kernels->live_values(s, live, job);
    } while (lmb_live_come_near(s, live));
    s->full += (uint32_t)s->is_full;
    s->pairs += (uint64_t)s->count * LMB_LIVE_NODES;
}

/* Targets that count: over the receiver's horizon, and with the receiver in front of their own facet by more than
 * rounding. A node's target may be neither, though its middle is. */
static uint64_t targets_ahead(const lmb_live_rays *r, int32_t targets, const lmb_live_receiver *at)
{
    uint64_t out = 0;
    for (int32_t k = 0; k < targets; ++k) {
        const lmb_vec3 to = vec3(r->to[0][k], r->to[1][k], r->to[2][k]),
                       facet = vec3(r->facet[0][k], r->facet[1][k], r->facet[2][k]);
        out |= (uint64_t)(r->id[k] != at->id && dot3(at->face, to) > 0.0f && dot3(facet, to) < -at->noise) << k;
    }
    return out;
}

/* Of each channel, the share that is seen. */
static void set_seen(float light[3], const lmb_live_rays *r, int32_t targets, uint64_t seen)
{
    for (int h = 0; h < 3; ++h) {
        float all = 0.0f, some = 0.0f;
        for (int32_t k = 0; k < targets; ++k) {
            all += r->colour[h][k];
            some += seen >> k & 1u ? r->colour[h][k] : 0.0f;
        }
        light[h] = all > 0.0f ? light[h] * (some / all) : 0.0f;
    }
}

lmb_status lmb_live_receive(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s, const lmb_live *live,
                            const lmb_bvh *bvh, const lmb_live_receiver *receiver)
{
    lmb_live_job job;
    if (light == NULL || kernels == NULL || s == NULL || live == NULL || live->face == NULL || receiver == NULL ||
        live->strata < 1 || live->strata > LMB_LIVE_STRATA) {
        return LMB_ERR_ARG;
    }
    memset(&job, 0, sizeof job);
    job.position = receiver->position;
    job.face = receiver->face;
    job.normal = receiver->normal;
    job.split = live->split;
    job.is_bent = job.face.x != job.normal.x || job.face.y != job.normal.y || job.face.z != job.normal.z;
    cut(s, kernels, live, &job);
    const float all = kernels->live_sums(light, s);
    if (!(all > 0.0f && all < 1e30f)) {
        light[0] = light[1] = light[2] = 0.0f;
        return LMB_OK;
    }
    s->rays.segments.at = receiver->position;
    kernels->live_targets(s, live, live->strata, all);
    const uint64_t targets = s->targets < 64 ? ((uint64_t)1 << s->targets) - 1 : ~(uint64_t)0,
                   asked = targets_ahead(&s->rays, s->targets, receiver),
                   seen = asked & ~lmb_live_blocked(kernels, s, bvh, receiver, asked);
    s->segments += (uint64_t)count_bits_64(asked);
    if (seen != targets) {
        set_seen(light, &s->rays, s->targets, seen);
    }
    return LMB_OK;
}

#endif
