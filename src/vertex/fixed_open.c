/* fixed_open.c: a blob in place: checked once, so that no later access leaves it and nothing overflows. Layer 8. */
#include <lambent/fixed.h>

#include "fixed_part.h"
#include "number.h"

#define FIXED_MAGIC   (0x4c4d4600u | LMB_FIXED_VERSION)
#define MAGIC_SWAPPED (0x00464d4cu | (uint32_t)LMB_FIXED_VERSION << 24)

enum { MAGIC_AT, WORDS_AT, UNITS_AT, VERTICES_AT, TRIANGLES_AT, ELEMENTS_AT, LINK_WORDS_AT, PLACES_AT, FIRST_AT = 10,
       SPACING_AT = 13, ORIGIN_AT, HULL_AT = 17, ZEROS_AT };

static int is_fixed_place(int32_t v) { return v >= -LMB_FIXED_REACH && v <= LMB_FIXED_REACH; }

/* Reads only the numbers of the header. */
static int take_header(lmb_fixed *s, const uint32_t *word, size_t words)
{
    uint32_t places = 1;
    if (words < LMB_FIXED_HEADER_WORDS || word[WORDS_AT] != words || word[UNITS_AT] > 16 || word[VERTICES_AT] < 3 ||
        word[VERTICES_AT] > LMB_FIXED_MAX_VERTICES || word[TRIANGLES_AT] > LMB_FIXED_MAX_TRIANGLES ||
        word[ELEMENTS_AT] > LMB_FIXED_MAX_ELEMENTS || word[HULL_AT] > word[TRIANGLES_AT] ||
        (word[ZEROS_AT] | word[ZEROS_AT + 1]) != 0 ||
        word[SPACING_AT] < 16 || word[SPACING_AT] > 2 * LMB_FIXED_REACH) {
        return 0;
    }
    s->units_log2 = (int32_t)word[UNITS_AT];
    s->vertices = word[VERTICES_AT];
    s->triangles = word[TRIANGLES_AT];
    s->hull = word[HULL_AT];
    s->elements = word[ELEMENTS_AT];
    s->spacing = (int32_t)word[SPACING_AT];
    for (int i = 0; i < 3; ++i) {
        const uint32_t n = word[PLACES_AT + i];
        s->first[i] = (int32_t)word[FIRST_AT + i];
        s->origin[i] = (int32_t)word[ORIGIN_AT + i];
        if (n < 1 || n > LMB_FIXED_MAX_PLACES || !is_fixed_place(s->first[i]) ||
            (n > 1 && n - 1 > (uint32_t)(2 * LMB_FIXED_REACH) / word[SPACING_AT])) {
            return 0;
        }
        s->places[i] = (int32_t)n;
        places *= n;
        if (places > LMB_FIXED_MAX_PLACES) {
            return 0;
        }
    }
    s->place_words = (places + 31) / 32;
    return 1;
}

static int check_receivers(const lmb_fixed *s)
{
    for (uint32_t i = 0; i < s->vertices + s->elements; ++i) {
        fixed_receiver r;
        fixed_receiver_at(&r, s, i);
        const int32_t *n = r.normal;
        if (!is_fixed_place(r.at[0]) || !is_fixed_place(r.at[1]) || !is_fixed_place(r.at[2]) ||
            n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 129 * 129) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < s->triangles; ++i) {
        const uint32_t *t = s->triangle + 2 * i;
        if ((t[0] & 0xffffu) >= s->vertices || t[0] >> 16 >= s->vertices || t[1] >= s->vertices) {
            return 0;
        }
    }
    return 1;
}

/* A row's weights times its scale are at most 1, so no bounce is brighter than the brightest sender. */
static int check_rows(const lmb_fixed *s, uint32_t link_words)
{
    for (uint32_t i = 0; i < s->vertices + s->elements; ++i) {
        const uint32_t *row = s->row + LMB_FIXED_ROW_WORDS * i, first = row[0] & 0xffffffu, count = row[0] >> 24;
        uint32_t sum = 0;
        if (count % 2 != 0 || first > link_words || count / 2 > link_words - first) {
            return 0;
        }
        for (uint32_t k = 0; k < count; ++k) {
            const uint32_t link = s->link[first + k / 2] >> (16 * (k & 1u));
            sum += link >> 8 & 255u;
            if ((link & 255u) >= s->elements) {
                return 0;
            }
        }
        if (sum > LMB_FIXED_MAX_SUM || (uint64_t)sum * row[1] > (uint64_t)1 << LMB_FIXED_SCALE) {
            return 0;
        }
    }
    return 1;
}

lmb_status lmb_fixed_open(lmb_fixed *out, const void *data, size_t bytes)
{
    static const lmb_fixed nothing = {0};
    const uint32_t *word = (const uint32_t *)data;
    lmb_fixed s = nothing;
    if (out == NULL) {
        return LMB_ERR_ARG;
    }
    *out = nothing;
    if (data == NULL) {
        return LMB_ERR_ARG;
    }
    if (((uintptr_t)data & 3u) != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < 4) {
        return LMB_ERR_FORMAT;
    }
    if (word[0] == MAGIC_SWAPPED) {
        return LMB_ERR_BUILD;
    }
    if (word[0] != FIXED_MAGIC || bytes % 4 != 0 || !take_header(&s, word, bytes / 4)) {
        return LMB_ERR_FORMAT;
    }
    const uint32_t receivers = s.vertices + s.elements, links = word[LINK_WORDS_AT];
    const uint32_t others = LMB_FIXED_HEADER_WORDS + receivers * (LMB_FIXED_RECEIVER_WORDS + LMB_FIXED_ROW_WORDS) +
                            2 * s.triangles + s.place_words * (1 + receivers);
    if (links > 0xffffffu || word[WORDS_AT] != others + links) {
        return LMB_ERR_FORMAT;
    }
    s.receiver = word + LMB_FIXED_HEADER_WORDS;
    s.triangle = s.receiver + LMB_FIXED_RECEIVER_WORDS * receivers;
    s.row = s.triangle + 2 * s.triangles;
    s.link = s.row + LMB_FIXED_ROW_WORDS * receivers;
    s.valid = s.link + links;
    s.seen = s.valid + s.place_words;
    if (!check_receivers(&s) || !check_rows(&s, links)) {
        return LMB_ERR_FORMAT;
    }
    *out = s;
    return LMB_OK;
}

static size_t groups_of(uint32_t seen_cap) { return (seen_cap + LMB_FIXED_GROUP - 1) / LMB_FIXED_GROUP; }

size_t lmb_fixed_memory(const lmb_fixed *scene, uint32_t seen_cap)
{
    if (scene == NULL || scene->receiver == NULL || seen_cap > LMB_FIXED_MAX_TRIANGLES) {
        return 0;
    }
    return sizeof(uint32_t[3]) * scene->elements + (sizeof(lmb_fixed_vertex) * scene->vertices + 3) / 4 * 4 +
           sizeof(lmb_fixed_rows) * groups_of(seen_cap) + sizeof(lmb_fixed_seen) * seen_cap;
}

lmb_status lmb_fixed_lay(lmb_fixed_frame *frame, const lmb_fixed *scene, uint32_t seen_cap, void *memory, size_t bytes)
{
    const size_t needed = lmb_fixed_memory(scene, seen_cap);
    unsigned char *at = (unsigned char *)memory;
    if (frame == NULL || memory == NULL || needed == 0) {
        return LMB_ERR_ARG;
    }
    if (((uintptr_t)memory & 3u) != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < needed) {
        return LMB_ERR_CAPACITY;
    }
    frame->scene = scene;
    frame->direct = (uint32_t(*)[3])(void *)at;
    at += sizeof(uint32_t[3]) * scene->elements;
    frame->vertex = (lmb_fixed_vertex *)(void *)at;
    at += (sizeof(lmb_fixed_vertex) * scene->vertices + 3) / 4 * 4;
    frame->group = (lmb_fixed_rows *)(void *)at;
    at += sizeof(lmb_fixed_rows) * groups_of(seen_cap);
    frame->seen = (lmb_fixed_seen *)(void *)at;
    frame->seen_cap = seen_cap;
    frame->seen_count = 0;
    frame->ready = NULL;
    frame->ready_cap = frame->ready_count = 0;
    return LMB_OK;
}
