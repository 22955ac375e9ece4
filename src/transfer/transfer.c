/* transfer.c: opens a .lmt in place: checks the whole file once, then trusts it. Layer 7. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/vec.h"
#include "../raster/triangle.h"
#include "halvings.h"

#if LMB_TRANSFER

/* Header words. */
enum {
    TRANSFER_MAGIC,
    TRANSFER_ORDER,
    TRANSFER_SIZE,
    SCENE,
    LEAVES = 5,
    COUNTS,
    TRANSFER_RESERVED = COUNTS + LMB_TRANSFER_SECTIONS
};

#define TRANSFER_OWN_ORDER 0x01020304u
#define LOW_BITS  ((1u << LMB_TRANSFER_EDGE_BIT) - 1u)
/* entries of a section: products fit 64 bits, indices fit the bits of a halving */
#define MAX_SECTION_ENTRIES 0x10000000u

static float as_float(uint32_t word)
{
    float v;
    memcpy(&v, &word, sizeof v);
    return v;
}

static int is_scale(uint32_t word) { return as_float(word) >= 0.0f && as_float(word) < 1e30f; }

/* --- checks of words ---------------------------------------------------------------------------------------------- */

/* Children lie behind their parent, two in a row, so every descent ends. Leaves name one of `places`. */
static int are_halvings(const lmb_transfer *t, int section, uint32_t places)
{
    const uint32_t *node = t->section[section], count = t->count[section];
    for (uint32_t i = 0; i < count; ++i) {
        const int is_leaf = (node[i] & LMB_TRANSFER_LEAF) != 0;
        const int is_cut = !is_leaf && node[i] >> LMB_TRANSFER_EDGE_BIT == LMB_TRANSFER_CUT;
        if (is_leaf ? (node[i] & ~LMB_TRANSFER_LEAF) >= places
                    : is_cut && (node[i] & LOW_BITS) >= t->count[LMB_TRANSFER_CUTS]) {
            return 0;
        }
        const uint32_t first = is_leaf ? i + 1 : halving_of(t, node[i]).first;
        if (!is_leaf && (first <= i || first >= count - 1)) {
            return 0;
        }
    }
    return 1;
}

static int are_cuts(const lmb_transfer *t)
{
    const uint32_t *cut = t->section[LMB_TRANSFER_CUTS];
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_CUTS]; ++i, cut += LMB_TRANSFER_CUT_WORDS) {
        const float part = as_float(cut[1]);
        if ((cut[0] >> LMB_TRANSFER_EDGE_BIT & 3u) == LMB_TRANSFER_CUT ||
            !(part >= LMB_TRANSFER_LEAST_CUT && part <= 1.0f - LMB_TRANSFER_LEAST_CUT)) {
            return 0;
        }
    }
    return 1;
}

static int are_surfaces(const lmb_transfer *t)
{
    const uint32_t *root = t->section[LMB_TRANSFER_SURFACES];
    for (uint32_t i = 0; i < LMB_TRANSFER_SURFACE_WORDS * t->count[LMB_TRANSFER_SURFACES]; ++i) {
        const uint32_t nodes = t->count[i % 4 < 2 ? LMB_TRANSFER_PIECES : LMB_TRANSFER_DIVISIONS];
        if (root[i] != LMB_TRANSFER_NONE && root[i] >= nodes) {
            return 0;
        }
    }
    return 1;
}

static int are_areas(const lmb_transfer *t)
{
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_AREAS]; ++i) {
        if (!is_scale(t->section[LMB_TRANSFER_AREAS][i])) {
            return 0;
        }
    }
    return 1;
}

/* Three words per place: receivers for leaves, blends for the places after them. */
static int are_corners(const lmb_transfer *t)
{
    const uint32_t *corner = t->section[LMB_TRANSFER_CORNERS];
    for (uint32_t i = 0; i < LMB_TRANSFER_CORNER_WORDS * t->count[LMB_TRANSFER_CORNERS]; ++i) {
        const int is_leaf = i / LMB_TRANSFER_CORNER_WORDS < t->leaves;
        if (corner[i] >= t->count[is_leaf ? LMB_TRANSFER_RECEIVERS : LMB_TRANSFER_BLENDS]) {
            return 0;
        }
    }
    return t->leaves <= t->count[LMB_TRANSFER_CORNERS];
}

/* Takes a range of links. `left`: links not taken so far; shared ranges would make a short file slow. */
static int take_range(uint32_t *left, uint32_t first, uint32_t count, uint32_t all)
{
    const int is_range = first <= all && count <= all - first && count <= *left;
    *left -= is_range ? count : 0;
    return is_range;
}

static uint32_t size_of_coarse(uint32_t code) { return code & 0x8000u ? 0x10000u - code : code; }

static int are_links(const lmb_transfer *t, int section, uint32_t first, uint32_t count)
{
    uint32_t sum = 0;
    for (uint32_t i = first; i < first + count; ++i) {
        const uint32_t link = t->section[section][i];
        sum += size_of_coarse(link >> 16);
        if ((link & 0xffffu) >= t->nodes || sum > LMB_TRANSFER_MAX_SUM) {
            return 0;
        }
    }
    return 1;
}

/* Parents lie before their child, so one pass in order computes all light. */
static int are_receivers(const lmb_transfer *t)
{
    uint32_t left = t->count[LMB_TRANSFER_LINKS];
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_RECEIVERS]; ++i) {
        const uint32_t *r = t->section[LMB_TRANSFER_RECEIVERS] + LMB_TRANSFER_RECEIVER_WORDS * (size_t)i;
        const int is_root = r[0] == LMB_TRANSFER_NONE && r[1] == LMB_TRANSFER_NONE;
        if ((!is_root && (r[0] >= i || r[1] >= i)) || !is_scale(r[4]) ||
            !take_range(&left, r[2], r[3], t->count[LMB_TRANSFER_LINKS]) ||
            !are_links(t, LMB_TRANSFER_LINKS, r[2], r[3])) {
            return 0;
        }
    }
    return 1;
}

static int are_cluster_links(const lmb_transfer *t, uint32_t first, uint32_t count)
{
    uint32_t sum[3] = {0, 0, 0};
    for (uint32_t i = first; i < first + count; ++i) {
        const uint32_t *link = t->section[LMB_TRANSFER_CLUSTER_LINKS] + LMB_TRANSFER_CLUSTER_LINK_WORDS * (size_t)i;
        sum[0] += size_of_coarse(link[0] >> 16);
        sum[1] += size_of_coarse(link[1] & 0xffffu);
        sum[2] += size_of_coarse(link[1] >> 16);
        if ((link[0] & 0xffffu) >= t->nodes || sum[0] > LMB_TRANSFER_MAX_SUM || sum[1] > LMB_TRANSFER_MAX_SUM ||
            sum[2] > LMB_TRANSFER_MAX_SUM) {
            return 0;
        }
    }
    return 1;
}

/* Up to four clusters, 16 bits each, out of the first `clusters`, and four weights of 8 bits that sum to at most 255. A
 * weight of 0 marks an unused cluster. */
static int is_blend(const uint32_t *b, uint32_t clusters)
{
    uint32_t sum = 0;
    for (int k = 0; k < 4; ++k) {
        const uint32_t weight = b[2] >> 8 * k & 255u, cluster = b[k / 2] >> 16 * (k % 2) & 0xffffu;
        sum += weight;
        if (cluster >= clusters && (cluster > 0 || weight > 0)) {
            return 0;
        }
    }
    return sum <= 255;
}

/* A cluster blends only clusters before it. */
static int are_clusters(const lmb_transfer *t)
{
    uint32_t left = t->count[LMB_TRANSFER_CLUSTER_LINKS];
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_CLUSTERS]; ++i) {
        const uint32_t *c = t->section[LMB_TRANSFER_CLUSTERS] + LMB_TRANSFER_CLUSTER_WORDS * (size_t)i;
        if (!is_blend(c, i) || !is_scale(c[5]) ||
            !take_range(&left, c[3], c[4], t->count[LMB_TRANSFER_CLUSTER_LINKS]) || !are_cluster_links(t, c[3], c[4])) {
            return 0;
        }
    }
    return 1;
}

static int are_blends(const lmb_transfer *t)
{
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_BLENDS]; ++i) {
        if (t->count[LMB_TRANSFER_CLUSTERS] == 0 ||
            !is_blend(t->section[LMB_TRANSFER_BLENDS] + LMB_TRANSFER_BLEND_WORDS * (size_t)i,
                      t->count[LMB_TRANSFER_CLUSTERS])) {
            return 0;
        }
    }
    return 1;
}

/* Runs of elements, starting at element 0. */
static int are_coarse(const lmb_transfer *t)
{
    const uint32_t count = t->count[LMB_TRANSFER_COARSE];
    uint32_t left = t->count[LMB_TRANSFER_COARSE_LINKS];
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t *c = t->section[LMB_TRANSFER_COARSE] + LMB_TRANSFER_COARSE_WORDS * (size_t)i;
        if ((i == 0 ? c[0] != 0 : c[0] <= c[-LMB_TRANSFER_COARSE_WORDS]) || c[0] >= t->count[LMB_TRANSFER_AREAS] ||
            !is_scale(c[3]) || !take_range(&left, c[1], c[2], t->count[LMB_TRANSFER_COARSE_LINKS]) ||
            !are_links(t, LMB_TRANSFER_COARSE_LINKS, c[1], c[2])) {
            return 0;
        }
    }
    return count <= LMB_TRANSFER_MAX_COARSE;
}

/* Ranges of ids: not empty, sorted, disjoint. */
static int are_moving(const lmb_transfer *t)
{
    const uint32_t *range = t->section[LMB_TRANSFER_MOVING];
    uint32_t past = 1;
    for (uint32_t i = 0; i < t->count[LMB_TRANSFER_MOVING]; ++i, range += LMB_TRANSFER_MOVING_WORDS) {
        if (range[0] < past || range[1] <= range[0] || range[1] - 1 > t->count[LMB_TRANSFER_SURFACES]) {
            return 0;
        }
        past = range[1];
    }
    return 1;
}

/* Each place has all receivers in a row, or none at all. */
static int is_air(const lmb_transfer *t)
{
    const uint32_t *grid = t->section[LMB_TRANSFER_GRID], *air = t->section[LMB_TRANSFER_AIR];
    const uint32_t count = t->count[LMB_TRANSFER_AIR], receivers = t->count[LMB_TRANSFER_RECEIVERS];
    if (t->count[LMB_TRANSFER_GRID] == 0) {
        return count == 0;
    }
    for (int k = 0; k < 3; ++k) {
        if (!(absf(as_float(grid[k])) < 1e30f) || grid[4 + k] == 0 || grid[4 + k] > LMB_TRANSFER_MAX_AIR) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        if (air[i] != LMB_TRANSFER_NONE &&
            (receivers < LMB_TRANSFER_AIR_RECEIVERS || air[i] > receivers - LMB_TRANSFER_AIR_RECEIVERS)) {
            return 0;
        }
    }
    return t->count[LMB_TRANSFER_GRID] == 1 && is_scale(grid[3]) && (uint64_t)grid[4] * grid[5] * grid[6] == count;
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

/* Counts elements and their means by fours, up to the root; 0 if `elements` is not a power of 4. */
static uint32_t nodes_of_elements(uint32_t elements)
{
    uint32_t nodes = 1, level = 1;
    while (level < elements && level < LMB_TRANSFER_MAX_ELEMENTS) {
        level *= 4;
        nodes += level;
    }
    return level == elements ? nodes : 0;
}

static int are_zeros(const uint32_t *word, int count)
{
    uint32_t all = 0;
    for (int i = 0; i < count; ++i) {
        all |= word[i];
    }
    return all == 0;
}

/* Sets the positions of sections. Returns 0 if the word count does not match. */
static int lay_out_sections(lmb_transfer *out, const uint32_t *word, uint64_t words)
{
    static const uint8_t words_each[LMB_TRANSFER_SECTIONS] = LMB_TRANSFER_WORDS_EACH;
    uint64_t at = LMB_TRANSFER_HEADER_WORDS;
    for (int s = 0; s < LMB_TRANSFER_SECTIONS; ++s) {
        out->count[s] = word[COUNTS + s];
        out->section[s] = word + at;
        if (out->count[s] >= MAX_SECTION_ENTRIES || (uint64_t)out->count[s] * words_each[s] > words - at) {
            return 0;
        }
        at += (uint64_t)out->count[s] * words_each[s];
    }
    return at == words;
}

lmb_status lmb_transfer_open(lmb_transfer *out, const void *data, size_t bytes)
{
    lmb_transfer t;
    const uint32_t *word = (const uint32_t *)data;
    if (out == NULL || data == NULL) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    if ((uintptr_t)data % 4 != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < 4 * LMB_TRANSFER_HEADER_WORDS || memcmp(data, "LMT", 3) != 0 ||
        ((const uint8_t *)data)[3] != LMB_TRANSFER_VERSION || word[TRANSFER_ORDER] != TRANSFER_OWN_ORDER ||
        word[TRANSFER_SIZE] != bytes || bytes % 4 != 0 ||
        !are_zeros(word + TRANSFER_RESERVED, LMB_TRANSFER_HEADER_WORDS - 1 - TRANSFER_RESERVED) ||
        !lay_out_sections(&t, word, bytes / 4)) {
        return LMB_ERR_FORMAT;
    }
    t.scene[0] = word[SCENE];
    t.scene[1] = word[SCENE + 1];
    t.leaves = word[LEAVES];
    t.nodes = nodes_of_elements(t.count[LMB_TRANSFER_AREAS]);
    if (t.nodes == 0 || t.count[LMB_TRANSFER_CLUSTERS] > LMB_TRANSFER_MAX_CLUSTERS || !are_surfaces(&t) ||
        !are_areas(&t) || !are_corners(&t) || !are_receivers(&t) ||
        !are_clusters(&t) || !are_blends(&t) || !are_coarse(&t) || !are_moving(&t) || !is_air(&t) ||
        !are_cuts(&t) || !are_halvings(&t, LMB_TRANSFER_PIECES, t.count[LMB_TRANSFER_AREAS]) ||
        !are_halvings(&t, LMB_TRANSFER_DIVISIONS, t.count[LMB_TRANSFER_CORNERS])) {
        return LMB_ERR_FORMAT;
    }
    *out = t;
    return LMB_OK;
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

/* FNV-1a over a word's four bytes, lowest first. */
static uint64_t hash_word(uint64_t hash, uint32_t word)
{
    for (int i = 0; i < 4; ++i) {
        hash = (hash ^ (word >> 8 * i & 255u)) * UINT64_C(0x100000001b3);
    }
    return hash;
}

static uint64_t hash_float(uint64_t hash, float v)
{
    uint32_t word;
    v = v == 0.0f ? 0.0f : v; /* +0 and -0 hash alike */
    memcpy(&word, &v, sizeof word);
    return hash_word(hash, word);
}

void lmb_transfer_fingerprint(uint32_t out[2], const lmb_scene *scene, const uint32_t *moving, uint32_t count)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    const uint32_t all = scene != NULL ? lmb_scene_triangles(scene) : 0;
    lmb_triangle t;
    if (out == NULL) {
        return;
    }
    count = moving != NULL ? count : 0;
    for (uint32_t id = 1, range = 0; id <= all; ++id) {
        range += range < count && id >= moving[2 * range + 1];
        if ((range < count && id >= moving[2 * range]) || !lmb_triangle_fetch(&t, scene, id)) {
            hash = hash_word(hash, id);
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            hash = hash_float(hash, t.corner[k].x);
            hash = hash_float(hash, t.corner[k].y);
            hash = hash_float(hash, t.corner[k].z);
        }
        hash = hash_word(hash, (t.material->flags & (LMB_DOUBLE_SIDED | LMB_ALPHA_MASK)) |
                                   (uint32_t)is_mirrored(&t.instance->to_world) << 31);
    }
    out[0] = (uint32_t)(hash & 0xffffffffu);
    out[1] = (uint32_t)(hash >> 32);
}

lmb_status lmb_transfer_fits(const lmb_transfer *transfer, const lmb_scene *scene)
{
    uint32_t own[2];
    if (transfer == NULL || scene == NULL || transfer->section[0] == NULL) {
        return LMB_ERR_ARG;
    }
    lmb_transfer_fingerprint(own, scene, transfer->section[LMB_TRANSFER_MOVING], transfer->count[LMB_TRANSFER_MOVING]);
    return transfer->count[LMB_TRANSFER_SURFACES] == lmb_scene_triangles(scene) && own[0] == transfer->scene[0] &&
                   own[1] == transfer->scene[1]
               ? LMB_OK
               : LMB_ERR_SCENE;
}

#endif
