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

/* Where little is seen, noise is a large part of it: more segments. */
static int packets_of(int32_t seen, int32_t targets)
{
    return seen * 5 >= targets * 2 ? 1 : seen * 5 >= targets || seen == 0 ? 2 : 3;
}

lmb_status lmb_live_receive(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s, const lmb_live *live,
                            const lmb_bvh *bvh, const lmb_live_receiver *receiver)
{
    static const float place[3] = {0.5f, 0.16666667f, 0.83333333f}; /* of the strata; all three are as far apart */
    float all[3] = {0, 0, 0}, some[3] = {0, 0, 0};
    int32_t seen = 0, targets = 0;
    int packets = 1;
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
    const float sum = kernels->live_sums(light, s);
    s->rays.segments.at = receiver->position;
    if (!(sum > 0.0f && sum < 1e30f)) {
        light[0] = light[1] = light[2] = 0.0f;
        s->seen[0] = s->seen[1] = s->seen[2] = -1.0f;
        return LMB_OK;
    }
    for (int packet = 0; packet < packets; ++packet) {
        kernels->live_targets(s, live, live->strata, place[packet], sum);
        const uint64_t asked = kernels->live_ahead(&s->rays, s->targets, receiver),
                       clear = asked & ~lmb_live_blocked(kernels, s, bvh, receiver, asked);
        s->segments += (uint64_t)count_bits_64(asked);
        kernels->live_share(all, some, &s->rays, s->targets, clear);
        seen += count_bits_64(clear);
        targets += s->targets;
        packets = packet == 0 ? packets_of(seen, targets) : packets;
    }
    for (int h = 0; h < 3; ++h) {
        s->seen[h] = seen == targets ? 1.0f : all[h] > 0.0f ? some[h] / all[h] : (float)seen / (float)maxi(targets, 1);
        s->whole[h] = light[h];
        light[h] *= s->seen[h];
    }
    return LMB_OK;
}

#endif
