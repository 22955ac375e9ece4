/* transfer_send.c: light that elements send: reflected, reflected again, and emitted. Layer 7. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/vec.h"
#include "links.h"

#if LMB_TRANSFER

enum { MAX_SENT_LEVELS = 8 }; /* 4^7 elements */
enum { SEND_ALL = LMB_TRANSFER_SEND_RECEIVED + 1 };

/* --- light that an element sends ---------------------------------------------------------------------------------- */

/* Iterates over elements and the coarse element that contains each. */
typedef struct cursor {
    const lmb_transfer_light *light;
    const lmb_transfer *t;
    int what;
    uint32_t coarse, past; /* first element of the next coarse element */
} cursor;

/* First element of a coarse element; past the last: the number of elements. */
static uint32_t first_of_coarse(const lmb_transfer *t, uint32_t coarse)
{
    return coarse < t->count[LMB_TRANSFER_COARSE]
               ? t->section[LMB_TRANSFER_COARSE][LMB_TRANSFER_COARSE_WORDS * (size_t)coarse]
               : t->count[LMB_TRANSFER_AREAS];
}

static cursor cursor_at(const lmb_transfer_light *light, const lmb_transfer *t, int what, uint32_t coarse)
{
    const cursor w = {light, t, what, coarse, first_of_coarse(t, coarse + 1)};
    return w;
}

static float no_infinity(float v) { return v < 1e30f ? v : 0.0f; }

/* Light that the next element sends, W/m2; returns the element's area, m2. */
static float element_sent(float sent[3], cursor *w, uint32_t i)
{
    const lmb_transfer_light *light = w->light;
    const lmb_transfer_coarse *coarse = NULL;
    float area;
    memcpy(&area, w->t->section[LMB_TRANSFER_AREAS] + i, sizeof area);
    if (w->t->count[LMB_TRANSFER_COARSE] > 0) {
        if (i == w->past) {
            w->past = first_of_coarse(w->t, ++w->coarse + 1);
        }
        coarse = &light->coarse[w->coarse];
    }
    const int collected = w->what == LMB_TRANSFER_SEND_COLLECTED || w->what == SEND_ALL,
              emits = w->what == LMB_TRANSFER_SEND_EMITTED || w->what == SEND_ALL;
    const float per = collected && area > 0.0f ? 1.0f / area : 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float came = coarse == NULL || w->what == LMB_TRANSFER_SEND_EMITTED ? 0.0f
                           : w->what == SEND_ALL ? coarse->all[c] : coarse->came[c];
        sent[c] = no_infinity(light->albedo[i][c] * (per * light->power[i][c] + came) +
                              (emits ? light->emission[i][c] : 0.0f));
    }
    return area;
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

/* In a damaged file, means of areas near 1e30 m2 may overflow binary32. */
static void put_sent_node(lmb_transfer_light *light, uint32_t node, const float sent[3], float per)
{
    for (int c = 0; c < 3; ++c) {
        light->node[node][c] = (uint16_t)clampf(sent[c] * per + 0.5f, 0.0f, 65535.0f);
    }
}

/* Area-weighted means over 4, 16, .. elements; each level has one pending sum. */
typedef struct level_sum {
    float sent[3], area;
    int count;
} level_sum;

/* Nodes are stored level by level: first the elements, then groups of four. */
static void put_nodes(lmb_transfer_light *light, const lmb_transfer *t, int what, float per)
{
    level_sum level[MAX_SENT_LEVELS];
    uint32_t next[MAX_SENT_LEVELS], of = t->count[LMB_TRANSFER_AREAS], at = 0;
    cursor w = cursor_at(light, t, what, 0);
    memset(level, 0, sizeof level);
    for (int l = 0; l < MAX_SENT_LEVELS; ++l) {
        next[l] = at;
        at += of;
        of /= 4;
    }
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_AREAS]; ++i) {
        float sent[3], area = element_sent(sent, &w, i);
        put_sent_node(light, i, sent, per);
        for (int l = 1; l < MAX_SENT_LEVELS && next[l] < t->nodes; ++l) {
            level_sum *s = &level[l];
            for (int c = 0; c < 3; ++c) {
                s->sent[c] += sent[c] * area;
            }
            s->area += area;
            if (++s->count < 4) {
                break;
            }
            for (int c = 0; c < 3; ++c) {
                sent[c] = s->area > 0.0f ? s->sent[c] / s->area : 0.0f;
            }
            area = s->area;
            put_sent_node(light, next[l]++, sent, per);
            memset(s, 0, sizeof *s);
        }
    }
}

/* Sets all nodes, in units of 1/65,535 of the largest. */
static void send(lmb_transfer_light *light, const lmb_transfer *t, int what)
{
    float max = 0.0f, sent[3] = {0.0f, 0.0f, 0.0f};
    cursor w = cursor_at(light, t, what, 0);
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_AREAS]; ++i) {
        (void)element_sent(sent, &w, i);
        max = maxf(max, largest3(vec3(sent[0], sent[1], sent[2])));
    }
    light->step = max > 1e-30f ? max / 65535.0f : 0.0f;
    put_nodes(light, t, what, light->step > 0.0f ? 65534.5f / max : 0.0f);
}

lmb_status lmb_transfer_send(lmb_transfer_light *light, const lmb_transfer *t)
{
    if (!transfer_is_laid_out(light, t)) {
        return LMB_ERR_ARG;
    }
    send(light, t, SEND_ALL);
    return LMB_OK;
}

/* --- between elements, and coarse ones ---------------------------------------------------------------------------- */

/* Area-weighted mean of the light that the elements of a coarse element send. */
static void set_element_sent(lmb_transfer_light *light, const lmb_transfer *t, uint32_t i, int what)
{
    float sum[3] = {0.0f, 0.0f, 0.0f}, sent[3] = {0.0f, 0.0f, 0.0f};
    cursor w = cursor_at(light, t, what, i);
    for (uint32_t e = first_of_coarse(t, i), past = w.past; e < past; ++e) {
        const float area = element_sent(sent, &w, e);
        for (int c = 0; c < 3; ++c) {
            sum[c] += area * sent[c];
        }
    }
    lmb_transfer_coarse *to = &light->coarse[i];
    for (int c = 0; c < 3; ++c) {
        to->sent[c] = to->area > 0.0f ? no_infinity(sum[c] / to->area) : 0.0f;
    }
}

static void receive_coarse(lmb_transfer_light *light, const lmb_transfer *t, uint32_t i)
{
    const uint32_t *own = t->section[LMB_TRANSFER_COARSE] + LMB_TRANSFER_COARSE_WORDS * (size_t)i;
    const uint32_t *link = t->section[LMB_TRANSFER_COARSE_LINKS] + own[1];
    const float scale = link_scale(own[3], light->step);
    lmb_transfer_coarse *to = &light->coarse[i];
    int32_t sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < own[2]; ++k) {
        const uint16_t *node = light->node[link[k] & 0xffffu];
        const int32_t weight = link_weight(link[k] >> 16);
        sum[0] += weight * (int32_t)node[0];
        sum[1] += weight * (int32_t)node[1];
        sum[2] += weight * (int32_t)node[2];
    }
    for (int c = 0; c < 3; ++c) {
        to->came[c] = no_infinity(maxf(scale * (float)sum[c], 0.0f));
        to->all[c] = no_infinity(to->all[c] + to->came[c]);
    }
}

lmb_status lmb_transfer_bounce(lmb_transfer_light *light, const lmb_transfer *t, int what)
{
    if (!transfer_is_laid_out(light, t) || what < LMB_TRANSFER_SEND_EMITTED || what > LMB_TRANSFER_SEND_RECEIVED) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_COARSE]; ++i) {
        set_element_sent(light, t, i, what);
    }
    send(light, t, what);
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_COARSE]; ++i) {
        receive_coarse(light, t, i);
    }
    return LMB_OK;
}

/* Share of a channel's light that survived the last reflection. With B sent and B' reflected next this is sum of A B'
 * B' / sum of A B' B. It weights each place by the light still there, because light that left into the open does not
 * represent the rest. If lights send to few places, B' lies elsewhere than B; then the ratio is the sum of all B' over
 * the sum of all B. */
static float kept_by_coarse(const lmb_transfer_light *light, uint32_t count, int what, int channel)
{
    float kept = 0.0f, before = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        const lmb_transfer_coarse *c = &light->coarse[i];
        const float next = c->albedo[channel] * c->came[channel];
        const float weight = c->area * (what == LMB_TRANSFER_SEND_RECEIVED ? next : 1.0f);
        kept += weight * next;
        before += weight * c->sent[channel];
    }
    return kept >= before ? (before > 0.0f ? 1.0f : 0.0f) : kept / before;
}

lmb_status lmb_transfer_rest(lmb_transfer_light *light, const lmb_transfer *t, int what, int32_t bounces)
{
    if (!transfer_is_laid_out(light, t) || bounces < 0 || bounces > LMB_MAX_BOUNCES) {
        return LMB_ERR_ARG;
    }
    for (int c = 0; c < 3; ++c) {
        const float kept = kept_by_coarse(light, t->count[LMB_TRANSFER_COARSE], what, c);
        float more = 0.0f;
        for (int32_t i = 0; i < bounces; ++i) {
            more = (more + 1.0f) * kept;
        }
        for (uint32_t i = 0; i < t->count[LMB_TRANSFER_COARSE]; ++i) {
            light->coarse[i].all[c] = no_infinity(light->coarse[i].all[c] + more * light->coarse[i].came[c]);
        }
    }
    return LMB_OK;
}

#endif
