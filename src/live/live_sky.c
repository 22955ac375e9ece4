/* live_sky.c: a receiver's light from infinity: sum, strata, segments that leave the scene, share. Layer 5.     [ours]
 *
 * Suns do not come nearer, so every receiver uses the same nodes. Which suns the strata contain depends only on the
 * normal: the segments of a plane's points would be parallel, and their shadows would end in steps. The receivers'
 * `turn` shifts them. */
#include "live_part.h"

#include <string.h>

#include "../base/memory_check.h"
#include "../lane/kernels.h"

#if LMB_LIVE

#define MANY_SUNS (1u << 22)

/* --- memory ------------------------------------------------------------------------------------------------------- */

size_t lmb_live_sky_bytes(uint32_t suns)
{
    const uint64_t nodes = LMB_LIVE_SKY * (uint64_t)sizeof(lmb_live_suns);
    return suns < 1 || suns > MANY_SUNS ? 0 : size_or_none(nodes + suns * (uint64_t)sizeof(lmb_live_sun) + CACHE_LINE);
}

lmb_status lmb_live_sky_init(lmb_live_sky *out, uint32_t suns, void *memory, size_t bytes)
{
    const lmb_status status = check_room(out, memory, bytes, lmb_live_sky_bytes(suns));
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    const uintptr_t past = (uintptr_t)memory % CACHE_LINE;
    out->chunk = (lmb_live_suns *)(void *)((uint8_t *)memory + (CACHE_LINE - past) % CACHE_LINE);
    out->sun = (lmb_live_sun *)(void *)(out->chunk + LMB_LIVE_SKY);
    out->sun_cap = suns;
    out->strata = LMB_LIVE_STRATA;
    return LMB_OK;
}

/* --- the light ---------------------------------------------------------------------------------------------------- */

/* The sun at a fraction of a node's light. Suns of a node are about equal, so the search starts in proportion. */
static inline const lmb_live_sun *sun_at(const lmb_live_sky *sky, const lmb_live_suns *c, int i, float fraction)
{
    const float at = fraction * c->power[i];
    const lmb_live_sun *sun = &sky->sun[c->first[i]];
    const int32_t last = (int32_t)c->count[i] - 1;
    int32_t k = mini((int32_t)(fraction * (float)c->count[i]), last);
    while (k > 0 && at < sun[k - 1].upto) {
        --k;
    }
    while (k < last && !(at < sun[k].upto)) {
        ++k;
    }
    return &sun[k];
}

/* Stores the targets of the picked nodes. */
static void put_picked_suns(lmb_live_scratch *s, const lmb_live_sky *sky, const lmb_live_picks *picks)
{
    lmb_live_rays *r = &s->rays;
    s->targets = picks->count;
    for (int32_t k = 0; k < picks->count; ++k) {
        const int32_t e = picks->node[k] / LMB_LIVE_NODES;
        const int i = picks->node[k] % LMB_LIVE_NODES;
        const lmb_live_suns *c = &sky->chunk[e];
        const lmb_live_sun *sun = sun_at(sky, c, i, 1.0f - clampf(picks->rest[k] / s->value[e][i], 0.0f, 1.0f));
        r->to[0][k] = sun->toward.x * sky->reach;
        r->to[1][k] = sun->toward.y * sky->reach;
        r->to[2][k] = sun->toward.z * sky->reach;
        r->colour[0][k] = c->colour[0][i];
        r->colour[1][k] = c->colour[1][i];
        r->colour[2][k] = c->colour[2][i];
    }
}

/* Places of the packets in the strata, before the receiver's turn. */
static float place_of(int packet, float turn)
{
    static const float place[LIVE_SKY_PACKETS] = {0.0f, 0.5f, 0.25f, 0.75f, 0.125f, 0.625f, 0.375f, 0.875f};
    const float at = turn + place[packet];
    return at < 1.0f ? at : at - 1.0f;
}

/* Sums over segments: colours of all and of the free ones, and their numbers. */
typedef struct sky_share {
    float all[3], some[3];
    int32_t targets, seen;
} sky_share;

static void set_sky_shares(float out[3], const sky_share *s)
{
    const float mean = (float)s->seen / (float)maxi(s->targets, 1);
    for (int h = 0; h < 3; ++h) {
        out[h] = s->seen == s->targets || !(s->all[h] > 0.0f) ? mean : s->some[h] / s->all[h];
    }
}

/* The less of the sky the first packet sees, the more segments follow: times those of the first. */
static int32_t times_of(const sky_share *s)
{
    if (s->seen == s->targets && s->targets > 0) {
        return 0;
    }
    return s->seen * 2 >= s->targets ? 1 : s->seen * 8 >= s->targets ? 3 : 7;
}

/* Share of the first packet in the result. It must not depend on the number of further segments: otherwise a first
 * packet that sees too much by chance would count for more than one that sees too little (3 % too bright). */
#define FIRST 0.25f

void lmb_live_add_sky(float light[3], const lmb_kernels *kernels, lmb_live_scratch *s, const lmb_live_sky *sky,
                      const lmb_bvh *bvh, const lmb_live_job *job, const lmb_live_receiver *at)
{
    const float turn = clampf(at->turn, 0.0f, 0.999999f);
    float first[3] = {0, 0, 0};
    int32_t strata = sky->strata;
    int packets = 1;
    sky_share sums;
    const float sum = kernels->live_sky(s->sky_whole, s, sky, job);
    s->rays.segments.at = at->position;
    memset(s->rays.id, 0, sizeof s->rays.id);
    memset(&sums, 0, sizeof sums);
    if (!(sum > 0.0f && sum < 1e30f)) {
        memset(s->sky_whole, 0, sizeof s->sky_whole);
        return;
    }
    for (int packet = 0; packet < packets; ++packet) {
        lmb_live_picks picks;
        kernels->live_picks(&picks, s, strata, place_of(packet, turn), sum);
        put_picked_suns(s, sky, &picks);
        const uint64_t asked = kernels->live_above(s, at),
                       clear = asked & ~lmb_live_blocked(kernels, s, bvh, at, asked);
        s->segments += (uint64_t)count_bits_64(asked);
        kernels->live_share(sums.all, sums.some, &s->rays, s->targets, clear);
        sums.seen += count_bits_64(clear);
        sums.targets += count_bits_64(asked);
        if (packet == 0) {
            const int32_t more = strata * times_of(&sums);
            packets += (more + LMB_LIVE_STRATA - 1) / LMB_LIVE_STRATA;
            strata = mini(more, LMB_LIVE_STRATA);
            set_sky_shares(first, &sums);
            if (more > 0) {
                memset(&sums, 0, sizeof sums);
            }
        }
    }
    set_sky_shares(s->sky_seen, &sums);
    for (int h = 0; h < 3; ++h) {
        s->sky_seen[h] = packets > 1 ? FIRST * first[h] + (1.0f - FIRST) * s->sky_seen[h] : first[h];
        light[h] += s->sky_whole[h] * s->sky_seen[h];
    }
}

#endif
