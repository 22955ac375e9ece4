/* transfer_light.c: memory of the light, and light through links from nodes to receivers. Layer 7. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../lane/kernels.h"
#include "blend.h"
#include "links.h"

#if LMB_TRANSFER

/* --- memory ------------------------------------------------------------------------------------------------------- */

size_t lmb_transfer_light_bytes(const lmb_transfer *t)
{
    if (t == NULL || t->section[0] == NULL) {
        return 0;
    }
    return size_or_none((uint64_t)36 * t->count[LMB_TRANSFER_AREAS] + (uint64_t)8 * t->nodes +
                        (uint64_t)12 * t->count[LMB_TRANSFER_RECEIVERS] +
                        (uint64_t)36 * t->count[LMB_TRANSFER_CLUSTERS] +
                        (uint64_t)sizeof(lmb_transfer_coarse) * t->count[LMB_TRANSFER_COARSE] +
                        LMB_TRANSFER_PARTS * sizeof(lmb_transfer_part));
}

lmb_status lmb_transfer_light_init(lmb_transfer_light *out, const lmb_transfer *t, void *memory, size_t bytes)
{
    const size_t needed = lmb_transfer_light_bytes(t);
    const lmb_status status = check_array(out, memory, bytes, needed);
    if (status != LMB_OK) {
        return status;
    }
    float *at = (float *)memory;
    memset(memory, 0, needed);
    out->power = (float(*)[3])(void *)at;
    at += 3 * (size_t)t->count[LMB_TRANSFER_AREAS];
    out->albedo = (float(*)[3])(void *)at;
    at += 3 * (size_t)t->count[LMB_TRANSFER_AREAS];
    out->emission = (float(*)[3])(void *)at;
    at += 3 * (size_t)t->count[LMB_TRANSFER_AREAS];
    out->coarse = (lmb_transfer_coarse *)(void *)at;
    at += t->count[LMB_TRANSFER_COARSE] * (sizeof(lmb_transfer_coarse) / sizeof *at);
    out->receiver = (float(*)[3])(void *)at;
    at += 3 * (size_t)t->count[LMB_TRANSFER_RECEIVERS];
    out->cluster = (float(*)[9])(void *)at;
    at += 9 * (size_t)t->count[LMB_TRANSFER_CLUSTERS];
    out->part = (lmb_transfer_part *)(void *)at;
    at += LMB_TRANSFER_PARTS * (sizeof *out->part / sizeof *at);
    out->node = (uint16_t(*)[4])(void *)at;
    out->place = NULL;
    out->step = 0.0f;
    return LMB_OK;
}

int32_t lmb_transfer_tiles(const lmb_transfer *t)
{
    const uint32_t elements = t == NULL ? 0 : t->count[LMB_TRANSFER_AREAS];
    return (int32_t)((elements + LMB_TILE_PIXELS - 1) / LMB_TILE_PIXELS);
}

lmb_status lmb_transfer_clear(lmb_transfer_light *light, const lmb_transfer *t)
{
    if (!transfer_is_laid_out(light, t)) {
        return LMB_ERR_ARG;
    }
    memset(light->power, 0, t->count[LMB_TRANSFER_AREAS] * sizeof *light->power);
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_COARSE]; ++i) {
        lmb_transfer_coarse *c = &light->coarse[i];
        c->came[0] = c->came[1] = c->came[2] = 0.0f;
        c->all[0] = c->all[1] = c->all[2] = 0.0f;
    }
    light->step = 0.0f;
    return LMB_OK;
}

/* --- nodes -> receivers ------------------------------------------------------------------------------------------- */

static void receive_links(const lmb_transfer_light *light, const lmb_kernels *kernels, const lmb_transfer *t,
                          uint32_t i)
{
    const uint32_t *r = t->section[LMB_TRANSFER_RECEIVERS] + LMB_TRANSFER_RECEIVER_WORDS * (size_t)i;
    const float scale = link_scale(r[4], light->step);
    int32_t sum[3];
    kernels->transfer_links(sum, t->section[LMB_TRANSFER_LINKS] + r[2], r[3], light->node);
    for (int c = 0; c < 3; ++c) {
        const float mean =
            r[0] == LMB_TRANSFER_NONE ? 0.0f : 0.5f * (light->receiver[r[0]][c] + light->receiver[r[1]][c]);
        light->receiver[i][c] = mean + scale * (float)sum[c];
    }
}

static void receive_cluster(const lmb_transfer_light *light, const lmb_kernels *kernels, const lmb_transfer *t,
                            uint32_t i)
{
    const uint32_t *cluster = t->section[LMB_TRANSFER_CLUSTERS] + LMB_TRANSFER_CLUSTER_WORDS * (size_t)i;
    const uint32_t *link =
        t->section[LMB_TRANSFER_CLUSTER_LINKS] + LMB_TRANSFER_CLUSTER_LINK_WORDS * (size_t)cluster[3];
    const float scale = link_scale(cluster[5], light->step);
    int32_t sum[3][3]; /* along x, y, z, of R, G, B */
    float parents[9];
    kernels->transfer_directed_links(sum, link, cluster[4], light->node);
    transfer_blend(parents, light, cluster);
    for (int c = 0; c < 9; ++c) {
        light->cluster[i][c] = parents[c] + scale * (float)sum[c % 3][c / 3];
    }
}

lmb_status lmb_transfer_receivers(const lmb_transfer_light *light, const lmb_kernels *kernels, const lmb_transfer *t,
                                  uint32_t first, uint32_t past)
{
    const uint32_t receivers = transfer_is_laid_out(light, t) ? t->count[LMB_TRANSFER_RECEIVERS] : 0;
    if (!transfer_is_laid_out(light, t) || kernels == NULL || past < first ||
        past > receivers + t->count[LMB_TRANSFER_CLUSTERS]) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = first; i < past; ++i) {
        if (i < receivers) {
            receive_links(light, kernels, t, i);
        } else {
            receive_cluster(light, kernels, t, i - receivers);
        }
    }
    return LMB_OK;
}

#endif
