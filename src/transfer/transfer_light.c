/* transfer_light.c: light from shadow maps to elements, and by links from nodes to receivers. Layer 9. */
#include <lambent/transfer.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../map/texel.h"
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

enum { CHUNK = 64, PADDED = CHUNK + 16 }; /* texels at once; with what whole vectors reach past them */

/* Part of a row of a map's blocks: of each block the id of the texel beside its middle. */
typedef struct chunk {
    uint32_t id[CHUNK];
    float sx[PADDED], power[PADDED];
    uint32_t element[PADDED];
    int32_t count;
} chunk;

static void read_ids(chunk *c, const lmb_target *face, const lmb_view *v, int32_t x0, int32_t y, int32_t each)
{
    const lmb_fill_window w = lmb_target_window(face, v);
    const uint8_t *row = (const uint8_t *)w.first.id + (ptrdiff_t)(y / LMB_TILE) * w.id_row;
    const int32_t step = (y % LMB_TILE) * w.first.id_step, is_16 = w.first.id_format == LMB_ID16;
    for (int32_t i = 0; i < c->count; ++i) {
        const int32_t x = (x0 + i) * each + each / 2, at = step + x % LMB_TILE;
        const void *tile = row + (ptrdiff_t)(x / LMB_TILE) * w.id_tile;
        c->id[i] = is_16 ? ((const uint16_t *)tile)[at] : ((const uint32_t *)tile)[at];
    }
}

/* How the weights of a triangle's corners run along a row. In perspective the ray at sx meets its plane at
 * n.(corner - eye) / n.ray, and weights are linear in that times the ray; for suns they are linear in sx. */
static void set_run(lmb_texel_run *run, const lmb_transfer_triangle *t, const lmb_view *v, float sy)
{
    const lmb_vec3 from = sub3(v->eye, t->corner);
    const lmb_vec3 middle = sub3(mul3(v->up, sy), v->back);
    const float back = dot3(t->normal, v->back);
    const int is_far = v->kind != LMB_PERSPECTIVE;
    /* A sun's ray begins at eye + right sx + up sy: it goes on by what that lies over the plane. */
    const lmb_vec3 start = add3(from, mul3(v->up, sy));
    const float on = dot3(t->normal, start) / back, on_by = dot3(t->normal, v->right) / back;
    for (int i = 0; i < 2; ++i) {
        const lmb_vec3 a = t->along[i];
        run->to[i] = is_far ? 0.0f : dot3(a, from);
        run->from[i] = is_far ? dot3(a, sub3(start, mul3(v->back, on))) : dot3(a, middle);
        run->by[i] = is_far ? dot3(a, sub3(v->right, mul3(v->back, on_by))) : dot3(a, v->right);
    }
    run->d = is_far ? 1.0f : -dot3(t->normal, from);
    run->n = is_far ? 1.0f : dot3(t->normal, middle);
    run->n_by = is_far ? 0.0f : dot3(t->normal, v->right);
}

/* Among pieces, the root of the triangle's side to the light. */
static uint32_t root_of(const lmb_transfer *t, uint32_t id, const lmb_transfer_triangle *triangle, const lmb_view *v)
{
    const lmb_vec3 ray = v->kind == LMB_PERSPECTIVE ? sub3(triangle->corner, v->eye) : mul3(v->back, -1.0f);
    const uint32_t back = dot3(triangle->normal, ray) > 0.0f;
    return t->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1) + back];
}

/* What a collection is about. */
typedef struct collection {
    const lmb_transfer_light *light;
    const lmb_kernels *kernels;
    const lmb_transfer *transfer;
    const lmb_scene *scene;
    const lmb_light *from;
    const lmb_view *view;
    lmb_transfer_kept *kept;
} collection;

static void add_texels(const collection *c, const chunk *k, int32_t first, int32_t past)
{
    for (int32_t i = first; i < past; ++i) {
        float *power = k->element[i] == LMB_TRANSFER_NONE ? NULL : c->light->power[k->element[i]];
        for (int p = 0; p < 3 && power != NULL; ++p) {
            power[p] += texel_flux(c->from->intensity[p], k->power[i]);
        }
    }
}

/* Runs of texels of one triangle. */
static void collect_chunk(collection *c, chunk *k, float sy)
{
    for (int32_t i = 0, past; i < k->count; i = past) {
        const uint32_t id = k->id[i];
        lmb_texel_run run;
        for (past = i + 1; past < k->count && k->id[past] == id;) {
            ++past;
        }
        const lmb_transfer_triangle *triangle = id == 0 || id > c->transfer->count[LMB_TRANSFER_SURFACES]
                                                    ? NULL
                                                    : transfer_triangle_kept(c->kept, c->scene, id);
        run.root = triangle != NULL ? root_of(c->transfer, id, triangle, c->view) : LMB_TRANSFER_NONE;
        if (run.root != LMB_TRANSFER_NONE) {
            run.node = c->transfer->section[LMB_TRANSFER_PIECES];
            set_run(&run, triangle, c->view, sy);
            c->kernels->texel_leaves(k->element + i, k->sx + i, past - i, &run);
            add_texels(c, k, i, past);
        }
    }
}

static void collect_row(collection *c, const lmb_shadow_map *coarse, int32_t face, int32_t each, int32_t y)
{
    chunk k;
    lmb_texel_row row;
    memset(&k, 0, sizeof k);
    lmb_texel_row_of(&row, c->from, coarse, face, y);
    for (int32_t x = 0; x < coarse->size; x += CHUNK) {
        k.count = mini(CHUNK, coarse->size - x);
        for (int32_t i = 0; i < k.count; ++i) {
            k.sx[i] = texel_sx(c->view, coarse->size, x + i);
        }
        read_ids(&k, &coarse->face[face], c->view, x, y * each + each / 2, each);
        c->kernels->texel_powers(k.power, k.sx, k.count, &row);
        collect_chunk(c, &k, row.sy);
    }
}

lmb_status lmb_transfer_collect(const lmb_transfer_light *light, const lmb_kernels *kernels,
                                lmb_transfer_scratch *scratch, const lmb_transfer *t, const lmb_scene *scene,
                                const lmb_light *from, const lmb_shadow_map *map, int32_t face, int32_t each,
                                int32_t first, int32_t past)
{
    if (!transfer_is_laid_out(light, t) || kernels == NULL || scratch == NULL || scene == NULL || from == NULL ||
        map == NULL || each < 1 || (uint32_t)face >= (uint32_t)map->faces || map->size % each != 0 ||
        first < 0 || past < first || past > map->size / each) {
        return LMB_ERR_ARG;
    }
    collection c = {light, kernels, t, scene, from, &map->view[face], &scratch->kept};
    lmb_shadow_map coarse = *map;
    coarse.size = map->size / each;
    for (int32_t y = first; y < past; ++y) {
        collect_row(&c, &coarse, face, each, y);
    }
    return LMB_OK;
}

/* --- nodes -> receivers ------------------------------------------------------------------------------------------- */

static void receive(const lmb_transfer_light *light, const lmb_kernels *kernels, const lmb_transfer *t, uint32_t i)
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
            receive(light, kernels, t, i);
        } else {
            receive_cluster(light, kernels, t, i - receivers);
        }
    }
    return LMB_OK;
}

#endif
