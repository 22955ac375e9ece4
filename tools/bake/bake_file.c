/* bake_file.c: what was baked -> the bytes of a .lmt. */
#include "bake.h"

#include <stdlib.h>
#include <string.h>

#include "../../src/transfer/sections.h"

static int put_receivers(bake *b, report *r)
{
    bake_words *w = &b->section[LMB_TRANSFER_RECEIVERS];
    for (uint32_t i = 0; i < b->receiver_count; ++i) {
        const bake_receiver *v = &b->receiver[i];
        if (!bake_put(w, v->parent[0], r) || !bake_put(w, v->parent[1], r) || !bake_put(w, v->first_link, r) ||
            !bake_put(w, v->links, r) || !bake_put_float(w, v->scale, r)) {
            return 0;
        }
    }
    return 1;
}

int bake_file(file_bytes *out, const bake *baked, report *r)
{
    bake b = *baked;
    uint32_t head[LMB_TRANSFER_HEADER_WORDS] = {0, 0x01020304u};
    uint64_t words = LMB_TRANSFER_HEADER_WORDS;
    lmb_transfer own;
    memset(&b.section[LMB_TRANSFER_RECEIVERS], 0, sizeof b.section[0]);
    memset(out, 0, sizeof *out);
    if (!put_receivers(&b, r)) {
        free(b.section[LMB_TRANSFER_RECEIVERS].data);
        return 0;
    }
    memcpy(head, "LMT\1", 4);
    lmb_transfer_fingerprint(head + 3, b.scene, b.section[LMB_TRANSFER_MOVING].data,
                             (uint32_t)b.section[LMB_TRANSFER_MOVING].count / LMB_TRANSFER_MOVING_WORDS);
    head[5] = b.leaves;
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        head[6 + s] = (uint32_t)(b.section[s].count / transfer_words_each[s]);
        words += b.section[s].count;
    }
    head[2] = (uint32_t)(4 * words);
    out->data = words < 0x3fffffffu ? malloc((size_t)(4 * words)) : NULL;
    if (out->data == NULL) {
        free(b.section[LMB_TRANSFER_RECEIVERS].data);
        return report_fail(r, "a file of %.0f MB is too large; try a larger --error", (double)words * 4e-6);
    }
    out->size = (size_t)(4 * words);
    uint8_t *at = out->data;
    memcpy(at, head, sizeof head);
    at += sizeof head;
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        if (b.section[s].count > 0) {
            memcpy(at, b.section[s].data, 4 * b.section[s].count);
            at += 4 * b.section[s].count;
        }
    }
    free(b.section[LMB_TRANSFER_RECEIVERS].data);
    return lmb_transfer_open(&own, out->data, out->size) == LMB_OK || report_fail(r, "what was baked does not open");
}

void bake_free(bake *b)
{
    for (uint32_t i = 0; i < b->receiver_count; ++i) {
        free(b->receiver[i].row);
    }
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        free(b->section[s].data);
    }
    free(b->receiver);
    free(b->element);
    free(b->bvh_memory);
}
