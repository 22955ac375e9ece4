/* live_receive.c: the light of one receiver: cut, sums, strata, packet, share. Layer 5.                       [ours] */
#include "live_part.h"

#include <string.h>

#include "../lane/kernels.h"
#include "../raster/triangle.h"

#if LMB_LIVE

/* --- the light ---------------------------------------------------------------------------------------------------- */

/* Starts with the nodes of the first level and replaces near ones by their parts. */
static void cut(lmb_live_scratch *s, const lmb_kernels *kernels, const lmb_live *live, const lmb_live_job *job)
{
    s->count = s->done = s->near_count = s->leaves = s->is_full = 0;
    s->near_lane = LMB_LIVE_NODES;
    s->lift = 0.0f;
    for (uint32_t at = 0; at < live->top; at += LMB_LIVE_NODES) {
        const uint32_t left = live->top - at;
        s->chunk[s->count] = &live->chunk[at / LMB_LIVE_NODES];
        s->asked[s->count++] = (uint16_t)(left < LMB_LIVE_NODES ? 0xffffu >> (LMB_LIVE_NODES - left) : 0xffffu);
    }
    do {
        kernels->live_values(s, live, job);
    } while (lmb_live_come_near(s, kernels, live));
    s->pairs += (uint64_t)s->count * LMB_LIVE_NODES;
}

/* Like crossed_per. */
static float per_of(float d) { return absf(d) > 1e-20f ? 1.0f / d : d < 0.0f ? -1e20f : 1e20f; }

#define RISE 0.125f /* of twice the offset */

/* Is the segment from the receiver to twice the offset free, and does it stay on the receiver's triangle? If not,
 * another thin object is there, or the surface bends. The segment rises from the surface: a wall that ends on the
 * surface would not block a segment along the wall's lower edge. */
static int is_free(lmb_live_scratch *s, const lmb_kernels *kernels, const lmb_live *live, const lmb_bvh *bvh,
                   const lmb_live_receiver *at)
{
    lmb_live_rays *r = &s->rays;
    const lmb_vec3 past = add3(at->position, mul3(s->off, 2.0f)),
                   on = sub3(lmb_place_onto_triangle(live->scene, at->id, past), past);
    if (at->id != 0 && dot3(on, on) > 0.01f * dot3(s->off, s->off)) {
        return 0;
    }
    const lmb_vec3 up = mul3(at->face, RISE * sqrtf(dot3(s->off, s->off)));
    const float to[3] = {2.0f * (s->off.x + up.x), 2.0f * (s->off.y + up.y), 2.0f * (s->off.z + up.z)};
    r->segments.at = at->position;
    for (int h = 0; h < 3; ++h) {
        r->to[h][0] = to[h];
        r->segments.per[h][0] = per_of(to[h]);
    }
    r->id[0] = 0;
    return lmb_live_blocked(kernels, s, bvh, at, 1) == 0;
}

/* If little light is visible, noise is a large part of it, so more segments are used. */
static int packets_of(int32_t seen, int32_t targets)
{
    return seen * 5 >= targets * 2 ? 1 : seen * 5 >= targets || seen == 0 ? 2 : 3;
}

/* Sets the light of the tree: the cut's sum times the share of it that is seen. */
static void light_of_tree(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s, const lmb_live *live,
                          const lmb_bvh *bvh, const lmb_live_receiver *at)
{
    static const float place[3] = {0.5f, 0.16666667f, 0.83333333f}; /* within the strata; all have equal spacing */
    float all[3] = {0, 0, 0}, some[3] = {0, 0, 0};
    int32_t seen = 0, targets = 0;
    int packets = 1;
    const float sum = kernels->live_sums(light, s);
    s->rays.segments.at = at->position;
    if (!(sum > 0.0f && sum < 1e30f)) {
        light[0] = light[1] = light[2] = 0.0f;
        return;
    }
    if (live->steady) {
        lmb_live_pick_steady(s, live, sum);
        packets = (s->picks + LMB_TILE_PIXELS - 1) / LMB_TILE_PIXELS;
    }
    for (int packet = 0; packet < packets; ++packet) {
        if (live->steady) {
            lmb_live_put_steady(s, packet * LMB_TILE_PIXELS);
        } else {
            kernels->live_targets(s, live, live->strata, place[packet], sum);
        }
        const uint64_t asked = kernels->live_ahead(&s->rays, s->targets, at),
                       clear = asked & ~lmb_live_blocked(kernels, s, bvh, at, asked);
        s->segments += (uint64_t)count_bits_64(asked);
        kernels->live_share(all, some, &s->rays, s->targets, clear);
        seen += count_bits_64(clear);
        targets += s->targets;
        packets = packet == 0 && !live->steady ? packets_of(seen, targets) : packets;
    }
    for (int h = 0; h < 3; ++h) {
        s->seen[h] = seen == targets ? 1.0f : all[h] > 0.0f ? some[h] / all[h] : (float)seen / (float)maxi(targets, 1);
        s->whole[h] = light[h];
        light[h] *= s->seen[h];
    }
}

/* Lights a receiver by the tree and by the sky. */
static lmb_status light_receiver(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s, const lmb_live *live,
                                 const lmb_bvh *bvh, const lmb_live_receiver *receiver)
{
    lmb_live_job job;
    lmb_live_receiver at;
    at = *receiver;
    memset(&job, 0, sizeof job);
    job.position = receiver->position;
    job.face = receiver->face;
    job.normal = receiver->normal;
    job.split = live->split;
    job.is_bent = job.face.x != job.normal.x || job.face.y != job.normal.y || job.face.z != job.normal.z;
    job.can_move = 1;
    cut(s, kernels, live, &job);
    /* A corner has two walls. */
    for (int wall = 0; wall < 2 && s->lift > 0.0f && is_free(s, kernels, live, bvh, &at); ++wall) {
        at.position = job.position = add3(job.position, s->off);
        job.can_move = wall == 0;
        cut(s, kernels, live, &job);
    }
    s->full += (uint32_t)s->is_full;
    for (int h = 0; h < 3; ++h) {
        s->whole[h] = s->sky_whole[h] = 0.0f;
        s->seen[h] = s->sky_seen[h] = -1.0f;
    }
    light_of_tree(light, kernels, s, live, bvh, &at);
    if (live->sky != NULL && live->sky->chunks > 0) {
        lmb_live_add_sky(light, kernels, s, live->sky, bvh, &job, &at);
    }
    return LMB_OK;
}

static int is_valid(const float light[3], const lmb_kernels *kernels, const lmb_live_scratch *s, const lmb_live *live,
                    const lmb_live_receiver *receiver)
{
    return light != NULL && kernels != NULL && s != NULL && live != NULL && live->face != NULL && receiver != NULL &&
           live->strata >= 1 && live->strata <= LMB_LIVE_STRATA &&
           (live->sky == NULL || (live->sky->strata >= 1 && live->sky->strata <= LMB_LIVE_STRATA));
}

lmb_status lmb_live_receive_again(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s,
                                  const lmb_live *live, const lmb_bvh *bvh, const lmb_live_receiver *receiver)
{
    if (!is_valid(light, kernels, s, live, receiver)) {
        return LMB_ERR_ARG;
    }
    s->keeps = 1;
    ++s->number;
    return light_receiver(light, kernels, s, live, bvh, receiver);
}

lmb_status lmb_live_receive(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s, const lmb_live *live,
                            const lmb_bvh *bvh, const lmb_live_receiver *receiver)
{
    if (!is_valid(light, kernels, s, live, receiver)) {
        return LMB_ERR_ARG;
    }
    for (int i = 0; i < LMB_LIVE_FACETS; ++i) {
        s->facet[i].id = 0;
    }
    for (int i = 0; i < LMB_LIVE_KNOWN; ++i) {
        s->known[i].id = 0;
    }
    s->keeps = 0;
    return light_receiver(light, kernels, s, live, bvh, receiver);
}

#endif
