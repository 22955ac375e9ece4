/* cache.c: finds objects with valid cubes, and slots for new ones. Layer 5.                      [S18-S20] */
#include <string.h>

#include "../base/vec.h"
#include <lambent/probe.h>

lmb_status lmb_probe_cache_init(lmb_probe_cache *out, int32_t slots, const lmb_probe_policy *policy)
{
    if (out == NULL || policy == NULL || slots < 1 || slots > LMB_MAX_PROBES || !(policy->radius_m >= 0.0f) ||
        !is_sane(policy->radius_m) || policy->every < 0) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    out->count = slots;
    out->policy = *policy;
    return LMB_OK;
}

int32_t lmb_probe_cache_name(lmb_probe_cache *inout, lmb_vec3 place)
{
    int32_t named = 0;
    while (inout != NULL && named < inout->count && inout->slot[named].kind == LMB_PROBE_NAMED) {
        ++named;
    }
    if (inout == NULL || !is_place(place) || named + 1 >= inout->count) {
        return -1;
    }
    /* The previous object of this slot gets another slot and new cubes. */
    memset(&inout->slot[named], 0, sizeof *inout->slot);
    inout->slot[named].kind = LMB_PROBE_NAMED;
    inout->slot[named].place = place;
    return named;
}

/* Nearest named place within reach; -1 if none. */
static int32_t find_named(const lmb_probe_cache *c, lmb_vec3 at)
{
    float nearest = c->policy.radius_m;
    int32_t found = -1;
    for (int32_t i = 0; i < c->count && c->slot[i].kind == LMB_PROBE_NAMED; ++i) {
        const float d = length3(sub3(at, c->slot[i].place));
        if (d < nearest || (d <= nearest && found < 0)) {
            nearest = d;
            found = i;
        }
    }
    return found;
}

/* The owner's slot; else a free slot, or the least recently used. Frame numbers may wrap. */
static int32_t find_owned(const lmb_probe_cache *c, uint32_t owner, uint32_t frame)
{
    int32_t best = -1;
    uint32_t oldest = 0;
    for (int32_t i = 0; i < c->count; ++i) {
        const lmb_probe_slot *s = &c->slot[i];
        const uint32_t age = s->kind == LMB_PROBE_FREE ? UINT32_MAX : frame - s->used;
        if (s->kind == LMB_PROBE_OWNED && s->owner == owner) {
            return i;
        }
        if (s->kind != LMB_PROBE_NAMED && (best < 0 || age > oldest)) {
            best = i;
            oldest = age;
        }
    }
    return best;
}

static int is_stale(const lmb_probe_cache *c, const lmb_probe_slot *s, lmb_vec3 at, uint32_t world, uint32_t frame)
{
    if (!s->known || s->world != world) {
        return 1;
    }
    const float moved = length3(sub3(at, s->place));
    return s->kind == LMB_PROBE_OWNED &&
           (moved > c->policy.radius_m ||
            (moved > 0.0f && c->policy.every > 0 && frame - s->frame >= (uint32_t)c->policy.every));
}

static void claim_slot(lmb_probe_slot *s, uint32_t owner)
{
    memset(s, 0, sizeof *s);
    s->kind = LMB_PROBE_OWNED;
    s->owner = owner;
}

lmb_status lmb_probe_cache_ask(lmb_probe_answer *out, lmb_probe_cache *inout, uint32_t owner, lmb_vec3 at,
                               uint32_t world_revision, uint32_t frame)
{
    if (out == NULL || inout == NULL || inout->count < 1 || !is_place(at)) {
        return LMB_ERR_ARG;
    }
    const int32_t named = find_named(inout, at), i = named >= 0 ? named : find_owned(inout, owner, frame);
    lmb_probe_slot *s = &inout->slot[i];
    if (named < 0 && (s->kind != LMB_PROBE_OWNED || s->owner != owner)) {
        claim_slot(s, owner);
    }
    out->slot = i;
    out->compute = is_stale(inout, s, at, world_revision, frame);
    if (out->compute) {
        s->place = named < 0 ? at : s->place;
        s->world = world_revision;
        s->frame = frame;
        s->known = 1;
    }
    s->used = frame;
    out->place = s->place;
    inout->computed += (uint32_t)out->compute;
    inout->kept += (uint32_t)!out->compute;
    return LMB_OK;
}
