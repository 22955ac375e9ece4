/* bake_file.c: bake results -> the bytes of a .lmt. */
#include "bake.h"

#include <stdlib.h>
#include <string.h>

#include "../common/checksum.h"

/* Writes the index of the first link, their number and unit. */
static int put_links(bake_words *to, bake_words *links, const bake_target *t, uint32_t words_each, report *r)
{
    const uint32_t first = (uint32_t)(links->count / words_each);
    for (size_t k = 0; k < t->link.count; ++k) {
        if (!bake_put(links, t->link.data[k], r)) {
            return 0;
        }
    }
    return bake_put(to, first, r) && bake_put(to, t->links, r) && bake_put_float(to, t->scale, r);
}

static int put_receivers(bake *b, report *r)
{
    bake_words *w = &b->section[LMB_TRANSFER_RECEIVERS];
    for (uint32_t i = 0; i < b->receiver_count; ++i) {
        const bake_target *t = &b->receiver[i].target;
        for (int k = 0; k < 2; ++k) {
            if (!bake_put(w, t->share[k] > 0.0f ? t->parent[k] : LMB_TRANSFER_NONE, r)) {
                return 0;
            }
        }
        if (!put_links(w, &b->section[LMB_TRANSFER_LINKS], t, 1, r)) {
            return 0;
        }
    }
    return 1;
}

/* Writes up to four parents and their weights, which sum to 255. */
static int put_clusters(bake *b, report *r)
{
    bake_words *w = &b->section[LMB_TRANSFER_CLUSTERS];
    for (uint32_t i = 0; i < b->cluster_count; ++i) {
        const bake_target *t = &b->cluster[i].target;
        uint32_t weights = 0;
        for (int k = 0; k < BAKE_PARENTS; ++k) {
            weights |= (uint32_t)(t->share[k] * 255.0f + 0.5f) << 8 * k;
        }
        if (!bake_put(w, t->parent[0] | t->parent[1] << 16, r) || !bake_put(w, t->parent[2] | t->parent[3] << 16, r) ||
            !bake_put(w, weights, r) ||
            !put_links(w, &b->section[LMB_TRANSFER_CLUSTER_LINKS], t, LMB_TRANSFER_CLUSTER_LINK_WORDS, r)) {
            return 0;
        }
    }
    return 1;
}

static void swap_words(uint8_t *data, size_t bytes)
{
    for (size_t i = 4; i + 4 <= bytes; i += 4) { /* after `LMT` and the version */
        const uint8_t word[4] = {data[i], data[i + 1], data[i + 2], data[i + 3]};
        for (size_t k = 0; k < 4; ++k) {
            data[i + k] = word[3 - k];
        }
    }
}

int bake_file(file_bytes *out, bake *b, report *r)
{
    static const uint8_t words_each[LMB_TRANSFER_SECTIONS] = LMB_TRANSFER_WORDS_EACH;
    uint32_t head[LMB_TRANSFER_HEADER_WORDS] = {0, 0x01020304u};
    uint64_t words = LMB_TRANSFER_HEADER_WORDS;
    lmb_transfer own;
    b->section[LMB_TRANSFER_RECEIVERS].count = b->section[LMB_TRANSFER_LINKS].count = 0;
    b->section[LMB_TRANSFER_CLUSTERS].count = b->section[LMB_TRANSFER_CLUSTER_LINKS].count = 0;
    memset(out, 0, sizeof *out);
    if (!put_receivers(b, r) || !put_clusters(b, r)) {
        return 0;
    }
    memcpy(head, "LMT", 3);
    ((uint8_t *)head)[3] = LMB_TRANSFER_VERSION;
    lmb_transfer_fingerprint(head + 3, b->scene, b->section[LMB_TRANSFER_MOVING].data,
                             (uint32_t)b->section[LMB_TRANSFER_MOVING].count / LMB_TRANSFER_MOVING_WORDS);
    head[5] = b->leaves;
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        head[6 + s] = (uint32_t)(b->section[s].count / words_each[s]);
        words += b->section[s].count;
    }
    head[2] = (uint32_t)(4 * words);
    out->data = words < 0x3fffffffu ? malloc((size_t)(4 * words)) : NULL;
    if (out->data == NULL) {
        return report_fail(r, "a file of %.0f MB is too large; try a larger --error", (double)words * 4e-6);
    }
    out->size = (size_t)(4 * words);
    uint8_t *at = out->data;
    memcpy(at, head, sizeof head);
    at += sizeof head;
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        if (b->section[s].count > 0) {
            memcpy(at, b->section[s].data, 4 * b->section[s].count);
            at += 4 * b->section[s].count;
        }
    }
    if (lmb_transfer_open(&own, out->data, out->size) != LMB_OK) {
        return report_fail(r, "what was baked does not open");
    }
    if (b->set.is_swapped) {
        swap_words(out->data, out->size);
    }
    checksum_put(out, LMB_TRANSFER_HEADER_WORDS);
    return 1;
}

void bake_free(bake *b)
{
    for (uint32_t i = 0; i < b->receiver_count; ++i) {
        free(b->receiver[i].target.row);
        free(b->receiver[i].directions);
        free(b->receiver[i].target.link.data);
    }
    for (uint32_t i = 0; i < b->cluster_count; ++i) {
        free(b->cluster[i].target.row);
        free(b->cluster[i].target.link.data);
    }
    free(b->cluster);
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        free(b->section[s].data);
    }
    free(b->receiver);
    free(b->element);
    free(b->part);
    free(b->cut);
    free(b->cut_root);
    free(b->node_zone);
    free(b->small_open);
    free(b->bvh_memory);
}
