/* transfer_light.c: light from shadow maps to elements, and by links from nodes to receivers. Layer 9. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../map/footprint.h"
#include "../raster/target.h"
#include "blend.h"
#include "halvings.h"
#include "links.h"

#if LMB_TRANSFER

/* --- memory ------------------------------------------------------------------------------------------------------- */

size_t lmb_transfer_light_bytes(const lmb_transfer *t)
{
    return t == NULL || t->section[0] == NULL
               ? 0
               : t->count[LMB_TRANSFER_AREAS] * (size_t)36 + t->nodes * (size_t)8 +
                     t->count[LMB_TRANSFER_RECEIVERS] * (size_t)12 + t->count[LMB_TRANSFER_CLUSTERS] * (size_t)36 +
                     t->count[LMB_TRANSFER_COARSE] * sizeof(lmb_transfer_coarse);
}

lmb_status lmb_transfer_light_init(lmb_transfer_light *out, const lmb_transfer *t, void *memory, size_t bytes)
{
    const size_t needed = lmb_transfer_light_bytes(t);
    if (out == NULL || needed == 0) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, needed);
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
    out->node = (uint16_t(*)[4])(void *)at;
    out->step = 0.0f;
    return LMB_OK;
}

/* --- shadow maps -> elements -------------------------------------------------------------------------------------- */

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

static uint32_t id_of(const lmb_target *face, int32_t x, int32_t y)
{
    const lmb_fill_tile t = lmb_target_tile(face, x / LMB_TILE, y / LMB_TILE);
    const int32_t at = (y % LMB_TILE) * t.id_step + x % LMB_TILE;
    return t.id_format == LMB_ID16 ? ((const uint16_t *)t.id)[at] : ((const uint32_t *)t.id)[at];
}

/* Triangles met lately, by the low bits of their ids: walls and floors come back in every row. */
enum { KEPT = 32 };
typedef struct triangles {
    transfer_triangle kept[KEPT]; /* id 0: none */
} triangles;

static const transfer_triangle *triangle_of(triangles *all, const lmb_scene *scene, uint32_t id)
{
    transfer_triangle *t = &all->kept[id % KEPT];
    if (t->id != id && !transfer_triangle_of(t, scene, id)) {
        t->id = 0;
        return NULL;
    }
    return t;
}

/* The element that a texel shows: its middle on the triangle, on the side to the light. */
static uint32_t element_at(const lmb_transfer *t, const transfer_triangle *triangle, const lmb_view *v, float sx,
                           float sy)
{
    const lmb_vec3 ray = v->kind == LMB_PERSPECTIVE ? sub3(triangle->corner, v->eye) : mul3(v->back, -1.0f);
    const int back = dot3(triangle->normal, ray) > 0.0f;
    const uint32_t root =
        t->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (triangle->id - 1) + (uint32_t)back];
    float w[3];
    if (root == LMB_TRANSFER_NONE) {
        return LMB_TRANSFER_NONE;
    }
    transfer_weights(w, triangle, footprint_over(v, triangle->corner, triangle->normal, sx, sy));
    return halvings_find(t->section[LMB_TRANSFER_PIECES], root, w);
}

lmb_status lmb_transfer_collect(const lmb_transfer_light *light, const lmb_transfer *t, const lmb_scene *scene,
                                const lmb_light *from, const lmb_shadow_map *map, int32_t face, int32_t each,
                                int32_t first, int32_t past)
{
    if (!transfer_is_laid_out(light, t) || scene == NULL || from == NULL || map == NULL || each < 1 ||
        (uint32_t)face >= (uint32_t)map->faces || map->size % each != 0 || first < 0 || past < first ||
        past > map->size / each) {
        return LMB_ERR_ARG;
    }
    const lmb_view *v = &map->view[face];
    lmb_shadow_map coarse = *map;
    triangles all;
    coarse.size = map->size / each;
    memset(&all, 0, sizeof all);
    for (int32_t i = first * coarse.size; i < past * coarse.size; ++i) {
        const int32_t x = i % coarse.size, y = i / coarse.size;
        const uint32_t id = id_of(&map->face[face], x * each + each / 2, y * each + each / 2);
        const transfer_triangle *triangle =
            id == 0 || id > t->count[LMB_TRANSFER_SURFACES] ? NULL : triangle_of(&all, scene, id);
        float power[3];
        if (triangle == NULL) {
            continue;
        }
        const float px = 2.0f * v->half_width / (float)coarse.size, py = 2.0f * v->half_height / (float)coarse.size;
        const float sx = ((float)(2 * x + 1 - coarse.size) * 0.5f) * px,
                    sy = ((float)(coarse.size - 2 * y - 1) * 0.5f) * py;
        const uint32_t element = element_at(t, triangle, v, sx, sy);
        lmb_light_texel_power(power, from, &coarse, face, x, y);
        for (int c = 0; c < 3 && element != LMB_TRANSFER_NONE; ++c) {
            light->power[element][c] += power[c];
        }
    }
    return LMB_OK;
}

/* --- nodes -> receivers ------------------------------------------------------------------------------------------- */

static void receive(const lmb_transfer_light *light, const lmb_transfer *t, uint32_t i)
{
    const uint32_t *r = t->section[LMB_TRANSFER_RECEIVERS] + LMB_TRANSFER_RECEIVER_WORDS * (size_t)i;
    const uint32_t *link = t->section[LMB_TRANSFER_LINKS] + r[2];
    const float scale = link_scale(r[4], light->step);
    int32_t sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < r[3]; ++k) {
        const uint16_t *node = light->node[link[k] & 0xffffu];
        const int32_t weight = link_weight(link[k] >> 16);
        sum[0] += weight * (int32_t)node[0];
        sum[1] += weight * (int32_t)node[1];
        sum[2] += weight * (int32_t)node[2];
    }
    for (int c = 0; c < 3; ++c) {
        const float mean =
            r[0] == LMB_TRANSFER_NONE ? 0.0f : 0.5f * (light->receiver[r[0]][c] + light->receiver[r[1]][c]);
        light->receiver[i][c] = mean + scale * (float)sum[c];
    }
}

static void receive_cluster(const lmb_transfer_light *light, const lmb_transfer *t, uint32_t i)
{
    const uint32_t *cluster = t->section[LMB_TRANSFER_CLUSTERS] + LMB_TRANSFER_CLUSTER_WORDS * (size_t)i;
    const uint32_t *link =
        t->section[LMB_TRANSFER_CLUSTER_LINKS] + LMB_TRANSFER_CLUSTER_LINK_WORDS * (size_t)cluster[3];
    const float scale = link_scale(cluster[5], light->step);
    int32_t sum[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    for (uint32_t k = 0; k < cluster[4]; ++k, link += LMB_TRANSFER_CLUSTER_LINK_WORDS) {
        const uint16_t *node = light->node[link[0] & 0xffffu];
        const int32_t weight[3] = {link_weight(link[0] >> 16), link_weight(link[1]), link_weight(link[1] >> 16)};
        for (int c = 0; c < 9; ++c) {
            sum[c] += weight[c % 3] * (int32_t)node[c / 3];
        }
    }
    float parents[9];
    transfer_blend(parents, light, cluster);
    for (int c = 0; c < 9; ++c) {
        light->cluster[i][c] = parents[c] + scale * (float)sum[c];
    }
}

lmb_status lmb_transfer_receivers(const lmb_transfer_light *light, const lmb_transfer *t, uint32_t first, uint32_t past)
{
    const uint32_t receivers = transfer_is_laid_out(light, t) ? t->count[LMB_TRANSFER_RECEIVERS] : 0;
    if (!transfer_is_laid_out(light, t) || past < first || past > receivers + t->count[LMB_TRANSFER_CLUSTERS]) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = first; i < past; ++i) {
        if (i < receivers) {
            receive(light, t, i);
        } else {
            receive_cluster(light, t, i - receivers);
        }
    }
    return LMB_OK;
}

#endif
